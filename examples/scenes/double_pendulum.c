/* A double pendulum with friction in its joints and a motor at the shoulder

   Two rods without mass, 1 m long, with 1 kg at each end; the angles are those
   to the vertical.  Friction 0.05 N m s in both joints; the motor gives
   8 N m cos(2.4 t), near the lower resonance.                                 */
#include "scene.h"

static const struct two_links pendulum_links = { 2, 1, 1 };                   /* kg m^2 */
static const gvi_real pendulum_levers[] = { 2*9.81, 9.81 };                   /* N m    */
static const joint pendulum_joints[] = { { -1, 0 }, { 0, 1 } };
static const struct weights pendulum_weights = { 0, 2, pendulum_levers };
static const struct joint_friction pendulum_friction = { pendulum_joints, 2, 0.05 };
static const struct motor pendulum_motor = { { -1, 0 }, 0, 8, 2.4, 0 };

static void double_pendulum_build(scene_setup *s)
{
    s->q[0] = 0.5;
    s->q[1] = -0.8;
    s->desc.mass = two_links(&pendulum_links);
    scene_add(s, "weight", weights(&pendulum_weights));
    scene_add(s, "friction", joint_friction(&pendulum_friction));
    scene_add(s, "motor", motor(&pendulum_motor));
}

static void double_pendulum_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    const double a = (double)q[0], b = (double)q[1];
    xy[0][0] = xy[0][1] = 0;
    xy[1][0] = sin(a);
    xy[1][1] = -cos(a);
    xy[2][0] = sin(a) + sin(b);
    xy[2][1] = -cos(a) - cos(b);
    (void)v;
}

static const double pendulum_sizes[] = { 4, 9, 9 };

static const scene double_pendulum = {
    .name = "double_pendulum", .title = "Double pendulum with friction and a motor", .n = 2, .degree = 8,
    .h = 1.0/64, .duration = 20, .build = double_pendulum_build,
    .energy_unit = "J", .energy_scale = 1, .time_unit = "s", .time_scale = 1,
    .caption = "", .unit = "m", .points = 3, .trail_first = 2, .trails = 1, .samples = 3,
    .place = double_pendulum_place, .sizes = pendulum_sizes, .lines = { { 0, 1, 3 } }, .seconds = 20,
    .view = { -2.1, 2.1, -2.1, 2.1 },
};
