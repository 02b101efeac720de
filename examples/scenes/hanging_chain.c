/* A chain of twenty links, let go where it is stretched out, 30 degrees above the horizontal

   Links of 5 cm without mass join beads of 10 g; the first hangs on a nail. Twenty constraints
   hold the links' lengths; what moves are forty Cartesian coordinates, with a diagonal mass. The
   air brakes each bead with 1e-3 N s/m.                                        */
#include "scene.h"

enum { BEADS = 20 };
static gvi_real bead_mass[2*BEADS];
static struct rod chain_link[BEADS];
static const struct uniform_field bead_weight = { { 0, BEADS, 2 }, bead_mass, { 0, -9.81, 0 } };
static const struct rods chain_links = { { 0, BEADS, 2 }, chain_link, BEADS };
static const struct linear_drag bead_air = { 0, 2*BEADS, 1e-3, 0 };

static void hanging_chain_build(scene_setup *s)
{
    const gvi_real link = (gvi_real)0.05;
    for (int i = 0; i < BEADS; ++i) {
        s->q[2*i] = link*(i + 1)*sqrt((gvi_real)3)/2;
        s->q[2*i + 1] = link*(i + 1)/2;
        bead_mass[2*i] = bead_mass[2*i + 1] = (gvi_real)0.01;
        chain_link[i] = (struct rod){ i, i - 1, link, { 0, 0, 0 } };
    }
    s->desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = bead_mass };
    scene_add(s, "weight", uniform_field(&bead_weight));
    scene_add(s, "air", linear_drag(&bead_air));
    scene_add(s, "links", rods(&chain_links));
}

static void hanging_chain_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    xy[0][0] = xy[0][1] = 0;
    for (int i = 0; i < 2*BEADS; ++i) xy[1 + i/2][i % 2] = (double)q[i];
    (void)v;
}

static const double bead_sizes[BEADS + 1] = { 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5 };

static const scene hanging_chain = {
    .name = "hanging_chain", .title = "A chain of twenty links: twenty constraints",
    .n = 2*BEADS, .degree = 8, .h = 0.001, .duration = 1.4, .build = hanging_chain_build,
    .energy_unit = "J", .energy_scale = 1, .time_unit = "s", .time_scale = 1,
    .caption = "", .unit = "m", .points = BEADS + 1, .trail_first = BEADS, .trails = 1, .samples = -2,
    .place = hanging_chain_place, .sizes = bead_sizes, .lines = { { 0, 1, BEADS + 1 } }, .seconds = 7,
    .view = { -1.05, 1.05, -1.05, 0.6 },
};
