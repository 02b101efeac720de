/* The chain of Fermi, Pasta, Ulam and Tsingou: energy that comes back

   32 bonds, 31 moving particles, unit masses; bonds d + d^2/4; all energy in the
   lowest mode at first, amplitude 1 (Los Alamos report LA-1940, 1955, figure 1).
   It spreads to a few modes, and 98 % of it returns after 146.4 periods of the
   lowest.  The 157 periods of the literature are those of that report's own step:
   leapfrog with h^2 = 1/8 gives 156.8, tests/test_scenes.c, and less with less h.
   The step here is 1/64 of that period; the film shows the chain once a period. */
#include "scene.h"

enum { FPUT_BONDS = 32 };
static const struct chain fput_bonds = { 0, FPUT_BONDS - 1, 1, 0.25, 0, FPUT_BONDS - 1 };

static const double fput_pi = 3.14159265358979323846;

static void fput_build(scene_setup *s)
{
    for (int i = 0; i < FPUT_BONDS - 1; ++i) s->q[i] = sin((gvi_real)fput_pi*(i + 1)/FPUT_BONDS);
    scene_add(s, "bonds", chain(&fput_bonds));
}

/* Energy in mode m of the chain with linear bonds.                            */
static double fput_mode(const gvi_real *q, const gvi_real *v, int m)
{
    double a = 0, b = 0, w = 2*sin(m*fput_pi/(2*FPUT_BONDS));
    for (int i = 1; i < FPUT_BONDS; ++i) {
        double s = sin(m*i*fput_pi/FPUT_BONDS);
        a += s*(double)q[i-1];
        b += s*(double)v[i-1];
    }
    return (b*b + w*w*a*a)/FPUT_BONDS;
}

static void fput_curves(const gvi_real *q, const gvi_real *v, double *out)
{
    for (int m = 1; m <= 4; ++m) out[m-1] = fput_mode(q, v, m);
}

/* The displacements, drawn upwards; walls at both ends.                       */
static void fput_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    for (int i = 0; i <= FPUT_BONDS; ++i) {
        xy[i][0] = i;
        xy[i][1] = i > 0 && i < FPUT_BONDS ? 8*(double)q[i-1] : 0;
    }
    (void)v;
}

static const double fput_sizes[FPUT_BONDS + 1] = {
    4, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4 };

/* The period of mode 1 is pi/sin(pi/64) = 64.0257...                          */
static const scene fput = {
    .name = "fput", .title = "Fermi, Pasta, Ulam, Tsingou: the energy returns",
    .n = FPUT_BONDS - 1, .degree = 6, .h = 64.02570931921777/64,
    .duration = 165*64.02570931921777, .build = fput_build,
    .energy_unit = "", .energy_scale = 1, .time_unit = "periods of mode 1",
    .time_scale = 1/64.02570931921777,
    .caption = "displacement x 8, once a period of mode 1", .points = FPUT_BONDS + 1, .samples = -64,
    .place = fput_place, .sizes = fput_sizes, .lines = { { 0, 1, FPUT_BONDS + 1 } }, .seconds = 20,
    .view = { 0, 32, -16, 16 },
    .curves_title = "energy in modes 1 to 4", .curve_names = { "1", "2", "3", "4" }, .curves = fput_curves,
};
