/* 46 - A robot on two wheels that finds its way: rolling rows, a Lagrangian and two motors

   Lesson 41 rolls along a line. Here the plane is open: x and y of the axle, yaw, pitch of the body, and the angle of each
   wheel. L is kinetic energy less weight, as if all six were free; that both wheels roll is three rows: no slip across, and
   none along at either wheel. The motors turn wheels against the body. A controller a hundred times a second keeps the
   body up and steers to a target; between two of these times torques are constant.

   Is it right? The motors' work, torque times the angle of a wheel against the body, is the energy gained, since rolling
   takes none; in the end it is what it takes to raise the body, m g h (1 - cos 0.1) = 0.0147 J. And the wheels have
   turned as the yaw says, (right - left) radius = yaw track.

   46_balance [--svg file]
   prints

     at the target 2.0, 1.5 after 20 s: off by 0.00 m, lean 0.000
     work of the motors 0.0147 J, energy gained the same to 1e-10: yes
     wheels and yaw agree to 1e-12: yes
     largest sideways force on the wheels 0.16 N
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include "tools/svg.h"

enum { STEPS = 2000 };
static const double height = 0.3, radius = 0.1, half = 0.2;           // of the body above the axle; half of the track. m

/* x, y, yaw, pitch, left wheel, right wheel.  A body of 1 kg, wheels of 0.2 kg                        */
LAGRANGIAN(robot, 6)
{
    const number c = cos(q[2]), s = sin(q[2]), up = cos(q[3]), lean = sin(q[3]);
    const number X = v[0] + height*(up*v[3]*c - lean*s*v[2]), Y = v[1] + height*(up*v[3]*s + lean*c*v[2]), Z = -height*lean*v[3];
    return (X*X + Y*Y + Z*Z)/2 + 0.01*(v[3]*v[3] + v[2]*v[2])/2                        // the body
           + 0.2*(v[0]*v[0] + v[1]*v[1] + half*half*v[2]*v[2]) + 0.001*(v[4]*v[4] + v[5]*v[5])/2 - 9.81*height*up;
}

GVI_EACH(rolls, 6, rows(3))
{
    const double c = cos(x->q[2]), s = sin(x->q[2]);
    double *A = x->jacobian;
    A[0] = s, A[1] = -c;                                              // across
    A[6] = A[12] = c, A[7] = A[13] = s;                               // along, left and right
    A[8] = -half, A[10] = -radius;
    A[14] = half, A[17] = -radius;
}

GVI_EACH(motors, 6, v, f)
{
    const double *torque = user;
    x->f[3] -= torque[0] + torque[1];
    x->f[4] += torque[0];
    x->f[5] += torque[1];
}

/* Lean against the speed that is wanted, turn to where the target is. */
static void control(gvi_stepper *st, const double *target, double *torque)
{
    double v[6];
    gvi_velocity(st, v);
    const double X = target[0] - st->q[0], Y = target[1] - st->q[1], c = cos(st->q[2]), s = sin(st->q[2]);
    const double ahead = c*X + s*Y, side = c*Y - s*X, speed = c*v[0] + s*v[1];
    const double wanted = fmax(-0.5, fmin(0.5, 0.5*ahead)), bearing = hypot(X, Y) > 0.1 ? atan2(side, ahead) : 0;
    const double both = 9*st->q[3] + 1.6*v[3] + 1.1*(speed - wanted), turn = 0.05*(bearing - v[2]);
    torque[0] = both/2 - turn;
    torque[1] = both/2 + turn;
}

static double x[STEPS + 1], y[STEPS + 1];

static int draw(const char *path)
{
    const svg_line line = { "axle", x, y, STEPS + 1 };
    const svg_plot plot = { .title = "The way of a robot on two wheels", .x_label = "x, in m", .y_label = "y, in m",
                            .lines = &line, .line_count = 1 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    static double memory[GVI_CONSTRAINED_LENGTH(6, 4, 4, 3)], torque[2];
    static lagrangian L;
    const double q[6] = { 0, 0, 0, 0.1, 0, 0 }, v[6] = { 0 }, moving[6] = { 0.1, 0.2, 0.3, 0.1, 1, 1 }, target[] = { 2, 1.5 };
    const char *wrong = lagrangian_init(&L, robot, NULL, 0, q, moving);
    if (wrong) return puts(wrong), 1;
    const gvi_effect scene[] = { lagrangian_effect(&L), { .kind = GVI_FORCE, .points = motors, .user = torque },
                                 { .kind = GVI_NONHOLONOMIC, .points = rolls, .rows = 3 } };
    const gvi_desc desc = { .n = 6, .degree = 4, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 3 };
    double start, end, work = 0, most = 0, force[3];
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    gvi_energy(&st, &start);
    for (int k = 0; k < STEPS && st.status == GVI_OK; ++k) {
        const double left = st.q[4] - st.q[3], right = st.q[5] - st.q[3];
        control(&st, target, torque);
        gvi_step(&st, 0.01);
        work += torque[0]*(st.q[4] - st.q[3] - left) + torque[1]*(st.q[5] - st.q[3] - right);
        if (gvi_multipliers(&st, force) == GVI_OK) most = fmax(most, fabs(force[0]));
        x[k + 1] = st.q[0], y[k + 1] = st.q[1];
    }
    gvi_energy(&st, &end);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    printf("at the target %.1f, %.1f after 20 s: off by %.2f m, lean %.3f\n", target[0], target[1],
           hypot(st.q[0] - target[0], st.q[1] - target[1]), fabs(st.q[3]));
    printf("work of the motors %.4f J, energy gained the same to 1e-10: %s\n", work, fabs(end - start - work) < 1e-10 ? "yes" : "no");
    printf("wheels and yaw agree to 1e-12: %s\n", fabs((st.q[5] - st.q[4])*radius - 2*half*st.q[2]) < 1e-12 ? "yes" : "no");
    printf("largest sideways force on the wheels %.2f N\n", most);
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;
    return 0;
}
