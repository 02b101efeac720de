/* Arenstorf's orbit: to the Moon and back, in the frame that turns with both

   The restricted three-body problem: unit distance, mass and time as usual,
   a massless (here: unit) third body.  Initial data and period from Hairer,
   Norsett, Wanner, Solving ODEs I, section II.0.  The orbit closes; it passes the
   Moon at 0.006.  In the turning frame gravity is two potentials, and the frame
   itself is an effect.                                                       */
#include "scene.h"

static const gvi_real arenstorf_mass[] = { 1 };
#define ARENSTORF_MOON 0.012277471L

static const struct central_gravity arenstorf_earth =
    { { 0, 1, 2 }, arenstorf_mass, (gvi_real)(1 - ARENSTORF_MOON), { (gvi_real)-ARENSTORF_MOON, 0, 0 } };
static const struct central_gravity arenstorf_moon =
    { { 0, 1, 2 }, arenstorf_mass, (gvi_real)ARENSTORF_MOON, { (gvi_real)(1 - ARENSTORF_MOON), 0, 0 } };
static const struct rotating_frame arenstorf_frame = { { 0, 1, 2 }, arenstorf_mass, 1 };

static void arenstorf_build(scene_setup *s)
{
    s->q[0] = (gvi_real)0.994L;
    s->v[1] = (gvi_real)-2.00158510637908252240537862224L;
    scene_add(s, "Earth", central_gravity(&arenstorf_earth));
    scene_add(s, "Moon", central_gravity(&arenstorf_moon));
    scene_add(s, "frame", rotating_frame(&arenstorf_frame));
}

static void arenstorf_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    xy[0][0] = (double)-ARENSTORF_MOON;
    xy[1][0] = (double)(1 - ARENSTORF_MOON);
    xy[0][1] = xy[1][1] = 0;
    scene_place_plane(1, q, xy + 2);
    (void)v;
}

static const double arenstorf_sizes[] = { 9, 4, 3.5 };

static const scene arenstorf = {
    .name = "arenstorf", .title = "Arenstorf's orbit between Earth and Moon", .n = 2, .degree = 10,
    .h = 17.0652165601579625588917206249/16384, .duration = 17.0652165601579625588917206249,
    .build = arenstorf_build,
    .energy_unit = "", .energy_scale = 1, .time_unit = "month/2 pi", .time_scale = 1,
    .caption = "in the turning frame", .unit = "Earth-Moon distance", .points = 3,
    .trail_first = 2, .trails = 1, .samples = -16, .place = arenstorf_place,
    .sizes = arenstorf_sizes, .seconds = 16,
};
