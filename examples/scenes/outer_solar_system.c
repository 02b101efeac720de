/* The outer solar system: gravity between all pairs

   On 5 September 1994, 0 h; from Hairer, Lubich, Wanner, Geometric numerical
   integration, table I.2.2 (after Ahnerts Kalender fuer Sternfreunde 1994):
   solar masses, AU, days; heliocentric, equatorial; the inner planets are added
   to the Sun.  The same numbers as examples/outer_solar_system.txt.           */
#include "scene.h"

static const gvi_real planet_mass[] = {
    1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449,
    7.6923076923076926e-9
};
static const struct pair_gravity planet_gravity = { { 0, 6, 3 }, planet_mass, 0.000295912208286 };

static void outer_solar_system_build(scene_setup *s)
{
    static const gvi_real q[18] = {
          0,            0,            0,              -3.5023653,  -3.8169847,  -1.5507963,
          9.0755314,   -3.0458353,   -1.6483708,       8.310142,  -16.2901086,  -7.2521278,
         11.4707666,  -25.7294829,  -10.8169456,     -15.5387357, -25.2225594,  -3.1902382 };
    static const gvi_real v[18] = {
          0,            0,            0,               0.00565429, -0.0041249,  -0.00190589,
          0.00168318,   0.00483525,   0.00192462,      0.00354178,  0.00137102,  0.00055029,
          0.0028893,    0.00114527,   0.00039677,      0.00276725, -0.00170702, -0.00136504 };
    static gvi_real mass[18];
    for (int i = 0; i < 18; ++i) mass[i] = planet_mass[i/3];
    memcpy(s->q, q, sizeof q);
    memcpy(s->v, v, sizeof v);
    s->desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = mass };
    scene_add(s, "gravity", pair_gravity(&planet_gravity));
}

/* From the Sun, turned into the ecliptic (23.44 degrees), seen from 40 degrees above. */
static void outer_solar_system_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    for (int i = 0; i < 6; ++i) {
        double x = (double)(q[3*i] - q[0]), y = (double)(q[3*i+1] - q[1]), z = (double)(q[3*i+2] - q[2]);
        scene_project(x, 0.917482*y + 0.397777*z, 0.917482*z - 0.397777*y, 0, 0.7, xy[i]);
    }
    (void)v;
}

static void outer_solar_system_quantities(const gvi_real *q, const gvi_real *v, const gvi_real *p,
                                          gvi_real *out)
{
    scene_momenta(6, 3, q, p, out);
    (void)v;
}

static const double planet_sizes[] = { 6, 4.5, 4, 3.5, 3.5, 2.5 };

static const scene outer_solar_system = {
    .name = "outer_solar_system", .title = "Outer solar system, 250 years", .n = 18, .degree = 8,
    .h = 200, .duration = 91200, .build = outer_solar_system_build,
    .energy_unit = "1e35 J", .energy_scale = 5.96113e7, .time_unit = "years", .time_scale = 1/365.25,
    .conserved = { "momentum x", "angular momentum z" }, .quantities = outer_solar_system_quantities,
    .caption = "seen from 40 degrees above the ecliptic", .unit = "AU", .points = 6,
    .trail_first = 1, .trails = 5, .samples = 3,
    .place = outer_solar_system_place, .sizes = planet_sizes, .seconds = 20,
};
