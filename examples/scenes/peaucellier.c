/* Peaucellier's linkage of 1864: seven bars that turn a circle into a straight line

   It hangs. x points down: two bars of 0.5 m from O = (0, 0) to A and B, a rhombus A P B Q of bars
   of 0.2 m, and a crank of 0.2 m from C = (0.2, 0) to P. P swings on a circle through O, so Q,
   its inverse, on a straight line: x = (0.5^2 - 0.2^2)/0.4 = 0.525 m. Each joint carries 0.1 kg;
   bearings brake. Eight coordinates, seven constraints, three closed loops.    */
#include "scene.h"

enum { INVERSOR_BARS = 7 };
static gvi_real inversor_mass[8];
static const struct rod inversor_bar[INVERSOR_BARS] = {
    { 0, -1, 0.5, { 0, 0, 0 } }, { 1, -1, 0.5, { 0, 0, 0 } }, { 2, -1, 0.2, { 0.2, 0, 0 } },
    { 0, 2, 0.2, { 0, 0, 0 } }, { 2, 1, 0.2, { 0, 0, 0 } }, { 1, 3, 0.2, { 0, 0, 0 } }, { 3, 0, 0.2, { 0, 0, 0 } }
};
static const struct uniform_field inversor_weight = { { 0, 4, 2 }, inversor_mass, { 9.81, 0, 0 } };
static const struct rods inversor_bars = { { 0, 4, 2 }, inversor_bar, INVERSOR_BARS };
static const struct linear_drag inversor_bearings = { 0, 8, 0.02, 0 };

/* P at an angle of the crank; A and B across O P, Q on the far side. */
static void inversor_at(gvi_real angle, gvi_real *q)
{
    const gvi_real P[2] = { (1 + cos(angle))/5, sin(angle)/5 };
    const gvi_real p = sqrt(P[0]*P[0] + P[1]*P[1]), u = P[0]/p, w = P[1]/p;
    const gvi_real far = (gvi_real)0.21/p, along = (p + far)/2, across = sqrt((gvi_real)0.25 - along*along);
    q[0] = along*u - across*w; q[1] = along*w + across*u;
    q[2] = along*u + across*w; q[3] = along*w - across*u;
    q[4] = P[0]; q[5] = P[1];
    q[6] = far*u; q[7] = far*w;
}

static void peaucellier_build(scene_setup *s)
{
    for (int i = 0; i < 8; ++i) inversor_mass[i] = (gvi_real)0.1;
    inversor_at((gvi_real)1.2, s->q);
    s->desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = inversor_mass };
    scene_add(s, "weight", uniform_field(&inversor_weight));
    scene_add(s, "bearings", linear_drag(&inversor_bearings));
    scene_add(s, "bars", rods(&inversor_bars));
}

static void peaucellier_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    static const int joints[10] = { 0, 2, 1, 3, 0, 0, -1, 1, -1, 2 };         // A P B Q A, A O B, C P
    for (int i = 0; i < 10; ++i) {
        xy[i][0] = joints[i] < 0 ? 0 : (double)q[2*joints[i] + 1];
        xy[i][1] = joints[i] < 0 ? (i == 8 ? -0.2 : 0) : -(double)q[2*joints[i]];
    }
    (void)v;
}

static const double inversor_sizes[] = { 6, 6, 6, 8, 6, 6, 5, 6, 5, 6 };

static const scene peaucellier = {
    .name = "peaucellier", .title = "Peaucellier's linkage: seven bars and a straight line", .n = 8, .degree = 6,
    .h = 0.005, .duration = 6, .build = peaucellier_build,
    .energy_unit = "J", .energy_scale = 1, .time_unit = "s", .time_scale = 1,
    .caption = "", .unit = "m", .points = 10, .trail_first = 3, .trails = 1, .samples = 1,
    .place = peaucellier_place, .sizes = inversor_sizes, .lines = { { 0, 1, 5 }, { 5, 1, 3 }, { 8, 1, 2 } },
    .seconds = 12,
};
