/* 35 - How to swing a pole up with the least effort? Optimal control with M(q)

   A cart of 1 kg carries a pole of 0.5 m, hanging, with 0.3 kg at its end. A motor pushes the
   cart with u newtons. In 2 s the cart is to move by 1 m and the pole to stand up, all at rest,
   with the least integral of u^2 (a problem of M. Kelly, SIAM Review 59, 2017). As in lesson 34
   states and costates are one scene, (x, a; l, m) with u = -l. The mass depends on the angle a,
   so velocities follow from momenta: M (x', a') = p, M (l', m') = (p_l, p_m) - dM (x', a'), dM
   being M's derivative along the costate. What the tangent scene needs is not worked out by
   hand: tools/complex_step.h takes it from functions of complex numbers.

   Newton's method finds a small swing at once, half a turn not at all. So the end moves: part
   of the way, then more, in steps that shrink where it fails. It leads to a local minimum.

   35_swing_up [--svg file]
   prints

     integral of u^2: 57.944780
     first push: -6.86115 N, the other way at first
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include "tools/complex_step.h"
#include "tools/shooting.h"
#include <string.h>

enum { CART = 4, SWING_STEPS = 40, SWING_DEGREE = 6 };
typedef complex_number number;
static const double both = 1.3, arm = 0.15, inertia = 0.075, gravity = 9.81, length = 0.5;
static const double swing_time = 2, half_turn = 3.14159265358979323846;

/* M v = (p, r) with M = [both, arm cos a; arm cos a, inertia].                   */
static void cart_solve(number angle, number p, number r, number *v)
{
    const number c = arm*ccos(angle), det = both*inertia - c*c;
    v[0] = (inertia*p - c*r)/det;
    v[1] = (both*r - c*p)/det;
}

static void cart_velocity(const number *q, const number *p, number *v)
{
    const number dm = -arm*csin(q[1])*q[3];              // what dM has off the diagonal, and nothing on it
    cart_solve(q[1], p[0], p[1], v);
    cart_solve(q[1], p[2] - dm*v[1], p[3] - dm*v[0], v + 2);
}

/* The kinetic energy's derivative by the angle, and the derivative of that along the costate.   */
static void cart_gradient(const number *q, const number *v, number *f)
{
    f[1] = -arm*csin(q[1])*v[0]*v[1];
    f[3] = -arm*(ccos(q[1])*q[3]*v[0]*v[1] + csin(q[1])*(v[2]*v[1] + v[0]*v[3]));
}

/* The motor, and the weight likewise.                                            */
static void cart_forces(const number *q, const number *v, number *f)
{
    f[0] = -q[2];
    f[1] = -arm*gravity*csin(q[1]);
    f[3] = -arm*gravity*ccos(q[1])*q[3];
    (void)v;
}

static complex_effect cart_mass = { .force = cart_gradient, .velocity = cart_velocity };
static complex_effect cart_rest = { .force = cart_forces };
static const gvi_effect cart_scene[] = { { GVI_POTENTIAL, .points = complex_points, .user = &cart_rest } };
static double swing_memory[GVI_LENGTH(20, SWING_DEGREE, SWING_DEGREE)], swing_room[TANGENT_ROOM(CART, CART)];
static tangent swing = {
    .plain = { .n = CART, .effects = cart_scene, .effect_count = 1, .formulation = GVI_MOMENTA,
               .mass = { .kind = GVI_MASS_POSITION, .points = tangent_no_matrix, .gradient = complex_points,
                         .velocity = complex_points, .user = &cart_mass } },
    .product = { complex_product }, .gradient = complex_product, .velocity = complex_product,
    .directions = CART, .room = swing_room, .room_length = TANGENT_ROOM(CART, CART) };

/* At the end: x = part, a = part of half a turn, at rest.                        */
static void arrive(const double *q, const double *p, const double *dq, const double *dp,
                   double *c, void *user)
{
    const double part = *(const double *)user;
    for (int i = 0; i < 2; ++i) {
        c[i] = dq ? dq[i] : q[i] - part*(i ? half_turn : 1);
        c[2 + i] = dq ? dp[i] : p[i];
    }
}

/* Corrects the start, l and m in q[2], q[3], p_l and p_m in p[2], p[3].          */
static gvi_status swing_to(double part, int degree, int steps, double *q, double *p)
{
    static double work[SHOOTING_ROOM(CART, CART)];
    static const double dq[16] = { [2] = 1, [7] = 1 }, dp[16] = { [10] = 1, [15] = 1 };
    const shooting S = { .scene = &swing, .dq = dq, .dp = dp, .h = swing_time/steps, .steps = steps,
                         .end = arrive, .user = &part, .tolerance = 1e-8, .most = 10, .room = work };
    gvi_stepper st;
    swing.plain.degree = degree;
    if (tangent_scene(&swing) || gvi_init(&st, &swing.desc, swing_memory, sizeof swing_memory)) return 1;
    return shoot(&S, &st, q, p);
}

/* The integral of u^2 from that start, and (x, a) after each step.               */
static double effort(int degree, int steps, const double *q, const double *p, double way[][2])
{
    double node[SWING_DEGREE], weight[SWING_DEGREE], z[CART], sum = 0;
    gvi_stepper st;
    if (gvi_init(&st, &swing.plain, swing_memory, sizeof swing_memory)) return HUGE_VAL;
    gvi_start_momentum(&st, 0, q, p);
    gvi_gauss(degree, node, weight);
    for (int k = 0; k < steps; ++k) {
        if (st.status || gvi_step(&st, swing_time/steps)) return HUGE_VAL;
        for (int i = 0; i < degree; ++i) gvi_curve(&st, node[i], z, NULL), sum += st.h*weight[i]*z[2]*z[2];
        if (way) way[k][0] = st.q[0], way[k][1] = st.q[1];
    }
    return sum;
}

static int draw_swing(const char *path, double way[][2])
{
    double x[2][3*SWING_STEPS], y[2][3*SWING_STEPS];
    const svg_line line[] = { { "pole", x[0], y[0], 3*SWING_STEPS }, { "its end", x[1], y[1], SWING_STEPS } };
    const svg_plot plot = { .title = "Up with the least effort: every 0.05 s",
                            .x_label = "m", .y_label = "m", .equal = 1, .lines = line, .line_count = 2 };
    for (int k = 0; k < 3*SWING_STEPS; ++k) {            // cart, end of the pole, and a gap
        const double *w = way[k/3], at = k % 3 == 2 ? HUGE_VAL : k % 3*length;
        x[0][k] = w[0] + at*sin(w[1]), y[0][k] = -at*cos(w[1]);
        if (k % 3 == 1) x[1][k/3] = x[0][k], y[1][k/3] = y[0][k];
    }
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    double q[CART] = { 0 }, p[CART] = { 0 }, good[2*CART] = { 0 }, way[SWING_STEPS][2];
    for (double part = 0, more = 0.25; part < 1 && more > 1e-4; ) {
        const double next = part + more < 1 ? part + more : 1;
        const int failed = swing_to(next, 4, 20, q, p);
        memcpy(failed ? q : good, failed ? good : q, sizeof q);
        memcpy(failed ? p : good + CART, failed ? good + CART : p, sizeof p);
        if (!failed) part = next;
        more *= failed ? 0.5 : 1.5;
    }
    if (swing_to(1, SWING_DEGREE, SWING_STEPS, q, p)) return puts("no way found"), 1;
    const double least = effort(SWING_DEGREE, SWING_STEPS, q, p, way);
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw_swing(argv[2], way) ? perror(argv[2]), 1 : 0;
    printf("integral of u^2: %.6f\n", least);
    printf("first push: %.5f N, %s\n", -q[2], q[2] > 0 ? "the other way at first" : "forward");
    return 0;
}
