/* A square net, held at its corners, falls through and comes to rest in the air

   8 x 8 knots of 5 g, 10 cm apart, joined by springs of 40 N/m (rest length
   10 cm) along both threads.  The corners are tethered to fixed hooks where they
   stand; at first the net stands in the air as a dome.  Air drag 0.5 * 1.2 kg/m^3 *
   1.1 * 60 cm^2 a knot.  192 coordinates.                                     */
#include "scene.h"

enum { NET_SIDE = 8, NET_KNOTS = NET_SIDE*NET_SIDE, NET_SPRINGS = 2*NET_SIDE*(NET_SIDE - 1) };
#define NET_PITCH ((gvi_real)0.1)

static const gvi_real net_angle = 3.14159265358979323846/(NET_SIDE - 1);
static gvi_real net_mass[3*NET_KNOTS];
static struct spring net_spring[NET_SPRINGS];
static struct tether net_hook[4];
static const struct uniform_field net_weight = { { 0, NET_KNOTS, 3 }, net_mass, { 0, 0, -9.81 } };
static const struct springs net_threads = { { 0, NET_KNOTS, 3 }, net_spring, NET_SPRINGS, 3*NET_KNOTS };
static const struct tethers net_hooks = { { 0, NET_KNOTS, 3 }, net_hook, 4, 3*NET_KNOTS };
static const struct air_drag net_air = { { 0, NET_KNOTS, 3 }, 0.5*1.2*1.1*60e-4, 3*NET_KNOTS };

static void net_build(scene_setup *s)
{
    struct spring *next = net_spring;
    struct tether *hook = net_hook;
    for (int i = 0; i < NET_KNOTS; ++i) {
        const int column = i % NET_SIDE, line = i/NET_SIDE, last = NET_SIDE - 1;
        const gvi_real x = NET_PITCH*column, y = NET_PITCH*line;
        s->q[3*i] = x;
        s->q[3*i+1] = y;
        s->q[3*i+2] = sin(net_angle*column)*sin(net_angle*line)*3/20;
        for (int c = 0; c < 3; ++c) net_mass[3*i+c] = 0.005;
        if (column < last) *next++ = (struct spring){ i, i + 1, 40, NET_PITCH };
        if (line < last) *next++ = (struct spring){ i, i + NET_SIDE, 40, NET_PITCH };
        if (column % last == 0 && line % last == 0) *hook++ = (struct tether){ i, 100, 0, { x, y, 0 } };
    }
    s->desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = net_mass };
    scene_add(s, "weight", uniform_field(&net_weight));
    scene_add(s, "threads", springs(&net_threads));
    scene_add(s, "hooks", tethers(&net_hooks));
    scene_add(s, "air", air_drag(&net_air));
}

static void net_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    for (int i = 0; i < NET_KNOTS; ++i)
        scene_project((double)q[3*i], (double)q[3*i+1], (double)q[3*i+2], 0.5, 0.45, xy[i]);
    (void)v;
}

static const double net_sizes[NET_KNOTS] = { 0 };

static const scene net = {
    .name = "net", .title = "A net of 64 knots in air", .n = 3*NET_KNOTS, .degree = 6,
    .h = 0.005, .duration = 4, .build = net_build,
    .energy_unit = "J", .energy_scale = 1, .time_unit = "s", .time_scale = 1,
    .caption = "", .unit = "m", .points = NET_KNOTS, .samples = -10, .place = net_place, .sizes = net_sizes,
    .lines = { { 0, 1, 8 }, { 8, 1, 8 }, { 16, 1, 8 }, { 24, 1, 8 }, { 32, 1, 8 }, { 40, 1, 8 }, { 48, 1, 8 },
               { 56, 1, 8 }, { 0, 8, 8 }, { 1, 8, 8 }, { 2, 8, 8 }, { 3, 8, 8 }, { 4, 8, 8 }, { 5, 8, 8 },
               { 6, 8, 8 }, { 7, 8, 8 } },
    .seconds = 8,
};
