/* The figure-eight choreography: three equal masses follow each other

   Chenciner, Montgomery, A remarkable periodic solution of the three-body problem
   in the case of equal masses, Annals of Mathematics 152, 2000; initial data by
   C. Simo, to 8 digits there: period 6.32591398, G = m = 1.                    */
#include "scene.h"

static const gvi_real eight_mass[] = { 1, 1, 1 };
static const struct pair_gravity eight_gravity = { { 0, 3, 2 }, eight_mass, 1 };

static void figure_eight_build(scene_setup *s)
{
    const gvi_real x = 0.97000436, y = -0.24308753, u = -0.93240737, v = -0.86473146;
    const gvi_real q[] = { x, y, -x, -y, 0, 0 }, w[] = { -u/2, -v/2, -u/2, -v/2, u, v };
    memcpy(s->q, q, sizeof q);
    memcpy(s->v, w, sizeof w);
    scene_add(s, "gravity", pair_gravity(&eight_gravity));
}

static void figure_eight_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    scene_place_plane(3, q, xy);
    (void)v;
}

static void figure_eight_quantities(const gvi_real *q, const gvi_real *v, const gvi_real *p, gvi_real *out)
{
    scene_momenta(3, 2, q, p, out);
    (void)v;
}

static const double eight_sizes[] = { 7, 7, 7 };

static const scene figure_eight = {
    .name = "figure_eight", .title = "Three bodies on a figure eight", .n = 6, .degree = 8,
    .h = 6.32591398/80, .duration = 6.32591398, .build = figure_eight_build,
    .energy_unit = "", .energy_scale = 1, .time_unit = "", .time_scale = 1,
    .conserved = { "momentum x", "angular momentum" }, .quantities = figure_eight_quantities,
    .caption = "G = m = 1", .unit = "", .points = 3, .trails = 3, .samples = 3, .place = figure_eight_place,
    .sizes = eight_sizes, .seconds = 8,
};
