/* A robot arm of two links, moved by a servo in each joint

   Uniform links, 2 kg and 0.5 m, 1.2 kg and 0.4 m; angles from the vertical down.
   The servos pull towards target angles that swing with the time; the first
   carries a constant torque against most of the weight; gears rub.            */
#include "scene.h"

/* m1 l1^2/3 + m2 l1^2, m2 l2^2/3, m2 l1 l2/2 in kg m^2; levers in N m          */
static const struct two_links arm_links = { 2*0.25/3 + 1.2*0.25, 1.2*0.16/3, 1.2*0.5*0.4/2 };
static const gvi_real arm_levers[] = { (2/2.0 + 1.2)*9.81*0.5, 1.2/2*9.81*0.4 };
static const joint arm_joints[] = { { -1, 0 }, { 0, 1 } };
static const struct weights arm_weight = { 0, 2, arm_levers };
static const struct joint_friction arm_gears = { arm_joints, 2, 0.2 };
static const struct motor arm_lift = { { -1, 0 }, 8, 0, 0, 0 };
static const struct servo arm_shoulder = { { -1, 0 }, 120, 8, 1.4, 0.7, 2, 0 };
static const struct servo arm_elbow = { { 0, 1 }, 60, 3, 0.9, -0.8, 4, 0.5 };

static void robot_arm_build(scene_setup *s)
{
    s->q[0] = 2.1;
    s->q[1] = 2.3;
    s->v[1] = 1.5;
    s->desc.mass = two_links(&arm_links);
    scene_add(s, "weight", weights(&arm_weight));
    scene_add(s, "gears", joint_friction(&arm_gears));
    scene_add(s, "lift", motor(&arm_lift));
    scene_add(s, "shoulder", servo(&arm_shoulder));
    scene_add(s, "elbow", servo(&arm_elbow));
}

static void robot_arm_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    const double a = (double)q[0], b = (double)q[1];
    xy[0][0] = xy[0][1] = 0;
    xy[1][0] = 0.5*sin(a);
    xy[1][1] = -0.5*cos(a);
    xy[2][0] = xy[1][0] + 0.4*sin(b);
    xy[2][1] = xy[1][1] - 0.4*cos(b);
    (void)v;
}

static const double arm_sizes[] = { 9, 7, 5 };

static const scene robot_arm = {
    .name = "robot_arm", .title = "Robot arm: motors against weight and gears", .n = 2, .degree = 8,
    .h = 0.01, .duration = 8, .build = robot_arm_build,
    .energy_unit = "J", .energy_scale = 1, .time_unit = "s", .time_scale = 1,
    .caption = "", .unit = "m", .points = 3, .trail_first = 2, .trails = 1, .samples = 3,
    .place = robot_arm_place, .sizes = arm_sizes, .lines = { { 0, 1, 3 } }, .seconds = 12,
};
