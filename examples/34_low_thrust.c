/* 34 - How to get there with the least thrust? Optimal control

   A spacecraft on a circular orbit of radius 1 is to be on one of radius 1.2 after one and
   a half revolutions. Its engine pushes with u along e, the direction of a circular flight:

     q'' = F(q) + u e(q)          the integral of u^2/2 over the time is to be least

   With a costate l for each coordinate the best u is -e.l, and l obeys the equation that
   lesson 33 steps back, l'' = F'(q) l + u d(e.l)/dq. Together that is a scene of four
   coordinates like any other. Unknown at the start: l and l', four numbers. Known of the
   end: radius, radial velocity, angular momentum, and that turning it gains nothing, for any
   place on the circle is good: four equations. Lesson 31 gives the derivative, and Newton's
   method finds the start from l = 0 in half a dozen flights (tools/shooting.h). As a step of
   the costates is the transposed step, this is also the least cost of the discrete problem,
   which a direct search over the thrust at every node would find.

   34_low_thrust [--svg file]
   prints

     degree 6, 24 steps: cost 0.000437423053, first thrust 0.00802622811
     the error of the cost at half the step, degree 2, 3, 4: smaller by 2^4, 2^6, 2^8
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include "tools/shooting.h"
#include <string.h>

enum { FLIGHT = 4, MOST_STEPS = 48, MOST_NODES = 6 };
static const double flight_time = 9.42477796076937971539;          // 3 pi

/* Rows 0, 1: q. Rows 2, 3: l. With radial and transverse unit vectors (X, Y), (-Y, X) and l = (R, S)
   along them u = -S; the forces along them are A, B on q and C, D on l.        */
static int flight(const gvi_points *x, void *user)
{
    for (int k = 0, s = x->stride; k < x->count; ++k) {
        const double *q = x->q + k, d = sqrt(q[0]*q[0] + q[s]*q[s]), X = q[0]/d, Y = q[s]/d, d3 = d*d*d;
        const double R = X*q[2*s] + Y*q[3*s], S = X*q[3*s] - Y*q[2*s];
        const double A = -1/(d*d), B = -S, C = 2*R/d3, D = S*(R/d - 1/d3);
        double *f = x->f + k;
        f[0] += A*X - B*Y, f[s] += A*Y + B*X, f[2*s] += C*X - D*Y, f[3*s] += C*Y + D*X;
    }
    return (void)user, 0;
}

/* Its derivative in a direction z: r along the radius, w the angle by which the unit vectors
   turn.                                                                        */
static int flight_product(const gvi_points *x, const gvi_points *dir, int parameter, void *user)
{
    for (int k = 0, s = x->stride; k < x->count; ++k) {
        const double *q = x->q + k, d = sqrt(q[0]*q[0] + q[s]*q[s]), X = q[0]/d, Y = q[s]/d;
        const double d3 = d*d*d, d4 = d3*d;
        const double R = X*q[2*s] + Y*q[3*s], S = X*q[3*s] - Y*q[2*s];
        const double A = -1/(d*d), B = -S, C = 2*R/d3, D = S*(R/d - 1/d3), *z = dir->q + k;
        const double r = X*z[0] + Y*z[s], w = (X*z[s] - Y*z[0])/d;
        const double dR = X*z[2*s] + Y*z[3*s] + w*S, dS = X*z[3*s] - Y*z[2*s] - w*R;
        const double a = 2*r/d3 - w*B, b = w*A - dS, c = 2*dR/d3 - 6*R*r/d4 - w*D;
        const double e = dS*(R/d - 1/d3) + S*(dR/d - R*r/(d*d) + 3*r/d4) + w*C;
        double *f = dir->f + k;
        f[0] += a*X - b*Y, f[s] += a*Y + b*X, f[2*s] += c*X - e*Y, f[3*s] += c*Y + e*X;
    }
    return (void)parameter, (void)user, 0;
}

/* Four equations at the end, q = (q, l) and p = (q', l'), each quadratic but for a constant: half a
   pairing of the end with itself; their derivative, the pairing with a direction.   */
static void arrival(const double *q, const double *p, const double *dq, const double *dp,
                    double *c, void *user)
{
    const double *a = dq ? dq : q, *b = dq ? dp : p, half = dq ? 1 : 0.5;
    c[0] = half*(q[0]*a[0] + q[1]*a[1]) - (dq ? 0 : 0.72);                            // radius
    c[1] = half*(q[0]*b[0] + q[1]*b[1] + a[0]*p[0] + a[1]*p[1]);                      // radial velocity
    c[2] = half*(q[0]*b[1] - q[1]*b[0] + a[0]*p[1] - a[1]*p[0]) - (dq ? 0 : sqrt(1.2));
    c[3] = half*(q[1]*b[2] - q[0]*b[3] + q[3]*b[0] - q[2]*b[1]
               + a[1]*p[2] - a[0]*p[3] + a[3]*p[0] - a[2]*p[1]);                      // turning it
    (void)user;
}

/* The best flight: its cost, its start, l in q[2], q[3] and l' in p[2], p[3], and, unless NULL,
   (q, push) at each node.                                                      */
static gvi_status best_flight(int degree, int steps, double *cost, double *q, double *p, double way[][4])
{
    static double memory[GVI_LENGTH(20, MOST_NODES, MOST_NODES)];
    static double room[TANGENT_ROOM(FLIGHT, FLIGHT)], work[SHOOTING_ROOM(FLIGHT, FLIGHT)];
    static const double dq[16] = { [2] = 1, [7] = 1 }, dp[16] = { [10] = 1, [15] = 1 };       // l, l'
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = flight } };
    tangent T = { .plain = { .n = FLIGHT, .degree = degree, .effects = scene, .effect_count = 1 },
                  .product = { flight_product }, .directions = FLIGHT,
                  .room = room, .room_length = TANGENT_ROOM(FLIGHT, FLIGHT) };
    const shooting S = { .scene = &T, .dq = dq, .dp = dp, .h = flight_time/steps, .steps = steps,
                         .end = arrival, .tolerance = 1e-9, .most = 8, .room = work };
    double node[MOST_NODES], weight[MOST_NODES], z[FLIGHT];
    gvi_stepper st;
    for (int i = 0; i < FLIGHT; ++i) q[i] = i == 0, p[i] = i == 1;
    if (tangent_scene(&T) || gvi_init(&st, &T.desc, memory, sizeof memory) || shoot(&S, &st, q, p)) return 1;

    // once more, without derivatives: what it costs
    if (gvi_init(&st, &T.plain, memory, sizeof memory) || gvi_start(&st, 0, q, p)) return st.status;
    *cost = 0;
    gvi_gauss(degree, node, weight);
    for (int k = 0; k < steps*degree; ++k) {
        if (k % degree == 0 && gvi_step(&st, S.h)) break;
        gvi_curve(&st, node[k % degree], z, NULL);
        const double u = (z[1]*z[2] - z[0]*z[3])/sqrt(z[0]*z[0] + z[1]*z[1]);
        *cost += S.h*weight[k % degree]*u*u/2;
        if (way) memcpy(way[k], (double[]){ z[0], z[1], -z[1]*u, z[0]*u }, sizeof z);
    }
    return st.status;
}

static int draw(const char *path, double way[][4], int steps, int degree)
{
    static double x[4][MOST_NODES*MOST_STEPS], y[4][MOST_NODES*MOST_STEPS];
    const svg_line line[] = { { "push x 30", x[3], y[3], 3*steps }, { "flight", x[2], y[2], steps*degree },
                              { "wanted", x[1], y[1], 181 }, { "start", x[0], y[0], 181 } };
    const svg_plot plot = { .title = "From radius 1 to 1.2 with the least thrust",
                            .x_label = "x, radii of the first orbit", .y_label = "y", .equal = 1, .lines = line, .line_count = 4 };
    for (int k = 0; k <= 180; ++k) {
        x[0][k] = cos(k*flight_time/270), x[1][k] = 1.2*x[0][k];
        y[0][k] = sin(k*flight_time/270), y[1][k] = 1.2*y[0][k];
    }
    for (int k = 0; k < steps*degree; ++k) x[2][k] = way[k][0], y[2][k] = way[k][1];
    for (int k = 0; k < 3*steps; ++k) {                  // from the flight to the tip of the push, and a gap
        const double *w = way[k/3*degree], far = k % 3 == 2 ? HUGE_VAL : 30*(k % 3);
        x[3][k] = w[0] + far*w[2], y[3][k] = w[1] + far*w[3];
    }
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    static double way[MOST_NODES*MOST_STEPS][4];
    double cost, best, q[FLIGHT], p[FLIGHT], error[2] = { 0, 0 };
    if (best_flight(6, 24, &best, q, p, way)) return puts("no flight found"), 1;
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2], way, 24, 6) ? perror(argv[2]), 1 : 0;
    printf("degree 6, 24 steps: cost %.12f, first thrust %.11f\n", best, -q[3]);
    printf("the error of the cost at half the step, degree 2, 3, 4: smaller by");
    for (int s = 2; s <= 4; ++s) {
        for (int i = 0; i < 2; ++i) {
            if (best_flight(s, (s < 4 ? 24 : 12) << i, &cost, q, p, NULL)) return 1;
            error[i] = fabs(cost - best);
        }
        printf(" 2^%.0f%s", log2(error[0]/error[1]), s < 4 ? "," : "\n");
    }
    return 0;
}
