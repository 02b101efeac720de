/* Duffing's oscillator, driven into chaos

   x'' + 0.3 x' - x + x^3 = F cos(1.2 t): two wells, friction and a drive.  For
   F = 0.2, 0.28, 0.29, 0.37, 0.65 the motion settles to 1, 2, 4, 5, 2 periods of
   the drive, for F = 0.5 to a chaotic attractor (Jordan, Smith, Nonlinear
   ordinary differential equations).  A step is 1/32 of the drive's period.    */
#include "scene.h"

static struct motor duffing_drive;
static const struct quartic_well duffing_well = { 0, 1, -1, 1, 1 };
static const struct linear_drag duffing_friction = { 0, 1, 0.3, 1 };

static void duffing_build(scene_setup *s)
{
    duffing_drive = (struct motor){ { -1, 0 }, 0, 0.5, 1.2, 0 };
    s->q[0] = 1.25;
    scene_add(s, "well", quartic_well(&duffing_well));
    scene_add(s, "friction", linear_drag(&duffing_friction));
    scene_add(s, "drive", motor(&duffing_drive));
}

/* Position and velocity.                                                      */
static void duffing_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    xy[0][0] = (double)q[0];
    xy[0][1] = (double)v[0];
}

static const double duffing_sizes[] = { 6 };

static const scene duffing = {
    .name = "duffing", .title = "Duffing's oscillator", .n = 1, .degree = 8,
    .h = 5.235987755982989/32, .duration = 37*5.235987755982989, .build = duffing_build,
    .energy_unit = "", .energy_scale = 1, .time_unit = "", .time_scale = 1,
    .caption = "position and velocity", .unit = "", .points = 1, .trails = 1, .samples = 4,
    .place = duffing_place, .sizes = duffing_sizes, .seconds = 40,
};
