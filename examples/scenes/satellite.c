/* A balloon satellite in low orbit: an oblate Earth, and air

   km, s, kg.  GM, J2 and equatorial radius of the Earth as in WGS 84/EGM96.  Air
   1.916e-11 kg/m^3 at 300 km, 2.803e-12 at 400 km (US Standard Atmosphere 1976),
   exponential with height 52 km between; drag coefficient 2.2; 10 m^2/kg, as the
   balloon Echo 1 had (30 m, 66 kg).  Without
   "air" the node moves by -3/2 J2 (R/p)^2 n cos i and the perigee by
   3/4 J2 (R/p)^2 n (5 cos^2 i - 1), to first order in J2.                     */
#include "scene.h"

static const gvi_real satellite_mass[] = { 66, 66, 66 };
static const struct central_gravity satellite_earth =
    { { 0, 1, 3 }, satellite_mass, 398600.4418, { 0, 0, 0 } };
static struct oblateness satellite_bulge =
    { { 0, 1, 3 }, satellite_mass, 398600.4418, 6378.137, 1.08262668e-3 };
/* c = rho Cd A/2 in kg/km                                                     */
static const struct atmosphere satellite_air =
    { { 0, 1, 3 }, 1000*1.916e-11*2.2*660/2, 6378.137 + 300, 52 };

/* Perigee 380 km up, over the equator; eccentricity 0.06, inclined by 50 degrees. */
static void satellite_build(scene_setup *s)
{
    const double e = 0.06, i = 50/57.29577951308232, perigee = 6378.137 + 380;
    const double speed = sqrt(398600.4418*(1 + e)/perigee);
    s->q[0] = perigee;
    s->v[1] = speed*cos(i);
    s->v[2] = speed*sin(i);
    s->desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = satellite_mass };
    scene_add(s, "gravity", central_gravity(&satellite_earth));
    scene_add(s, "oblateness", oblateness(&satellite_bulge));
    scene_add(s, "air", atmosphere(&satellite_air));
}

static void satellite_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    xy[0][0] = xy[0][1] = 0;
    scene_project((double)q[0]/1000, (double)q[1]/1000, (double)q[2]/1000, 0.4, 1.1, xy[1]);
    (void)v;
}

static void satellite_quantities(const gvi_real *q, const gvi_real *v, const gvi_real *p, gvi_real *out)
{
    gvi_real both[2];
    scene_momenta(1, 3, q, p, both);
    out[0] = both[1];
    (void)v;
}

static const double satellite_sizes[] = { -6.378, 4 };

static const scene satellite = {
    .name = "satellite", .title = "Satellite: oblate Earth, thin air, 30 orbits", .n = 3, .degree = 8,
    .h = 200, .duration = 177000, .build = satellite_build,
    .energy_unit = "GJ", .energy_scale = 1e-3, .time_unit = "hours", .time_scale = 1/3600.0,
    .conserved = { "angular momentum z (without air)" }, .quantities = satellite_quantities,
    .caption = "", .unit = "thousand km", .points = 2, .trail_first = 1, .trails = 1, .samples = 6,
    .place = satellite_place, .sizes = satellite_sizes, .seconds = 30,
};
