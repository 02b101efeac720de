/* A heavy symmetric top (Lagrange's): it nods while it goes round

   A toy: 0.1 kg, centre of mass 4 cm above the tip; moments of inertia about the
   tip 2e-4 across and 8e-5 kg m^2 along the axis; spun with 150 rad/s, tilted by
   0.5 rad and let go: the axis stops at each top of its cusps.  Steady
   precession at rate w is across w^2 cos a - along spin w + m g l = 0.         */
#include "scene.h"

static const struct top toy_top = { 2e-4, 8e-5 };
static const gvi_real toy_lever[] = { -0.1*9.81*0.04 };                       /* stands */
static const struct weights toy_weight = { 0, 1, toy_lever };

static void lagrange_top_build(scene_setup *s)
{
    s->q[0] = 0.5;
    s->v[2] = 150;
    s->desc.mass = top(&toy_top);
    scene_add(s, "weight", weights(&toy_weight));
}

/* Tip and axis of unit length; under it the path of its end, on the table.    */
static void lagrange_top_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    const double a = (double)q[0], w = (double)q[1];
    const double x = sin(a)*sin(w), y = -sin(a)*cos(w), z = cos(a);
    xy[0][0] = xy[0][1] = 0;
    scene_project(x, y, z, 0, 0.6, xy[1]);
    scene_project(x*0.6, y*0.6, z*0.6, 0, 0.6, xy[2]);
    (void)v;
}

static void lagrange_top_quantities(const gvi_real *q, const gvi_real *v, const gvi_real *p, gvi_real *out)
{
    out[0] = p[1];
    out[1] = p[2];
    (void)q, (void)v;
}

static void lagrange_top_curves(const gvi_real *q, const gvi_real *v, double *out)
{
    out[0] = (double)q[0]*57.29577951308232;
    (void)v;
}

static const double top_sizes[] = { 3, 4, 16 };

static const scene lagrange_top = {
    .name = "lagrange_top", .title = "Lagrange's top, nodding", .n = 3, .degree = 8,
    .h = 0.005, .duration = 2, .build = lagrange_top_build,
    .energy_unit = "mJ", .energy_scale = 1000, .time_unit = "s", .time_scale = 1,
    .conserved = { "p of precession", "p of spin" }, .quantities = lagrange_top_quantities,
    .caption = "the axis, seen from 34 degrees above", .points = 3, .trail_first = 1, .trails = 1,
    .samples = 2, .place = lagrange_top_place, .sizes = top_sizes, .lines = { { 0, 1, 2 } }, .seconds = 16,
    .view = { -0.9, 0.9, -0.6, 1.2 },
    .curves_title = "tilt, degrees", .curve_names = { "tilt" }, .curves = lagrange_top_curves,
};
