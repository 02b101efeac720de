/* 19 - How to get there with the least thrust? Optimal control

   A spacecraft on a circular orbit of radius 1 is to be on one of radius 1.2 after one and
   a half revolutions. Its engine pushes with u along e, the direction of a circular flight:

     q'' = F(q) + u e(q)          the integral of u^2/2 over the time is to be least

   With a costate l for each coordinate the best u is -e.l, and l obeys the equation that
   lesson 18 steps back, l'' = F'(q) l + u d(e.l)/dq. Together that is a scene of four
   coordinates like any other. Unknown at the start: l and l', four numbers. Known of the end:
   radius, radial velocity, angular momentum, and that turning it gains nothing, for any place
   on the circle is good: four equations. Lesson 17 gives the derivative, Newton's method the
   solution, from l = 0. A step of the costates being the transposed step, it is also the
   minimum of the discrete problem, which a direct search over all controls would find.

   19_low_thrust [--svg file]
   prints

     degree 6, 24 steps: cost 0.000437423053, first thrust 0.00802622811
     Newton's method, from no thrust at all: 8 flights or less
     the error of the cost at half the step, degree 2, 3, 4: smaller by 2^4, 2^6, 2^8
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "svg.h"
#include "tools/tangent.h"
#include <string.h>

enum { FLIGHT = 4, MOST_STEPS = 48, MOST_NODES = 6 };
static const double flight_time = 9.42477796076937971539, far = 1.2;

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

/* Its derivative in a direction z: r along the radius, w the angle by which the unit vectors turn.  */
static int flight_product(const gvi_points *x, const gvi_points *dir, int parameter, void *user)
{
    for (int k = 0, s = x->stride; k < x->count; ++k) {
        const double *q = x->q + k, d = sqrt(q[0]*q[0] + q[s]*q[s]), X = q[0]/d, Y = q[s]/d, d3 = d*d*d, d4 = d3*d;
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

/* The four equations at the end z = (q, l, q', l') are pairs(z, z)/2 = wanted, bilinear and symmetric,
   so that pairs(z, d) is their derivative along d.                             */
static const double wanted[] = { 0.72, 0, 1.09544511501033222691, 0 };       // far^2/2, sqrt(far)

static void pairs(const double *z, const double *d, double *c)
{
    c[0] = z[0]*d[0] + z[1]*d[1];
    c[1] = z[0]*d[4] + z[1]*d[5] + d[0]*z[4] + d[1]*z[5];
    c[2] = z[0]*d[5] - z[1]*d[4] + d[0]*z[5] - d[1]*z[4];
    c[3] = z[1]*d[6] - z[0]*d[7] + z[3]*d[4] - z[2]*d[5] + d[1]*z[6] - d[0]*z[7] + d[3]*z[4] - d[2]*z[5];
}

/* The best flight: its cost, l and l' at the start, and (q, push) at each node, or NULL.  Returns the
   number of flights that Newton's method took, -1 for a failure.               */
static int best_flight(int degree, int steps, double *cost, double *start, double way[][4])
{
    static double memory[GVI_LENGTH(20, MOST_NODES, MOST_NODES)], room[TANGENT_ROOM(FLIGHT, FLIGHT)];
    static const double dq[4][4] = { { 0, 0, 1 }, { 0, 0, 0, 1 } }, dp[4][4] = { { 0 }, { 0 }, { 0, 0, 1 }, { 0, 0, 0, 1 } };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = flight } };
    tangent T = { .plain = { .n = FLIGHT, .degree = degree, .effects = scene, .effect_count = 1 }, .product = { flight_product },
                  .directions = FLIGHT, .room = room, .room_length = TANGENT_ROOM(FLIGHT, FLIGHT) };
    double node[MOST_NODES], weight[MOST_NODES], q[20], z[8], d[8], c[4], miss[4], M[16], pivot[5];
    gvi_stepper st;
    if (tangent_scene(&T) || gvi_init(&st, &T.desc, memory, sizeof memory) || gvi_gauss(degree, node, weight)) return -1;
    memset(start, 0, 4*sizeof *start);
    for (int iteration = 0, done = 0; iteration < 20; ++iteration) {
        const double q0[] = { 1, 0, start[0], start[1] }, p0[] = { 0, 1, start[2], start[3] }, h = flight_time/steps;
        tangent_start(&T, &st, 0, q0, p0, dq[0], dp[0]);
        *cost = 0;
        for (int k = 0; k < steps; ++k) {
            if (gvi_step(&st, h)) return -1;
            for (int i = 0; i < degree; ++i) {
                gvi_curve(&st, node[i], q, NULL);
                const double u = (q[1]*q[2] - q[0]*q[3])/sqrt(q[0]*q[0] + q[1]*q[1]);
                *cost += h*weight[i]*u*u/2;
                if (way) memcpy(way[k*degree + i], (double[]){ q[0], q[1], -q[1]*u, q[0]*u }, 4*sizeof(double));
            }
        }
        if (done) return iteration + 1;
        for (int i = 0; i < 4; ++i) z[i] = st.q[i], z[4 + i] = st.p[i];
        pairs(z, z, miss);
        for (int i = 0; i < 4; ++i) miss[i] = miss[i]/2 - wanted[i];
        for (int j = 0; j < 4; ++j) {
            tangent_column(&T, &st, j, d, d + 4);
            pairs(z, d, c);
            for (int i = 0; i < 4; ++i) M[4*i + j] = c[i];
        }
        if (gvi_lu_factor(4, M, pivot)) return -1;
        gvi_lu_solve(4, M, pivot, miss);
        for (int i = 0; i < 4; ++i) start[i] -= miss[i];
        done = fabs(miss[0]) + fabs(miss[1]) + fabs(miss[2]) + fabs(miss[3]) < 1e-9;      // its square is rounding
    }
    return -1;
}

static int draw(const char *path, double way[][4], int steps, int degree)
{
    static double x[4][MOST_NODES*MOST_STEPS], y[4][MOST_NODES*MOST_STEPS];
    const svg_line line[] = { { "start", x[0], y[0], 181 }, { "wanted", x[1], y[1], 181 },
                              { "flight", x[2], y[2], steps*degree }, { "push x 30", x[3], y[3], 3*steps } };
    const svg_plot plot = { .title = "From radius 1 to 1.2 with the least thrust", .x_label = "x", .y_label = "y",
                            .equal = 1, .lines = line, .line_count = 4 };
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k <= 180; ++k) x[i][k] = (i ? far : 1)*cos(k*flight_time/270), y[i][k] = (i ? far : 1)*sin(k*flight_time/270);
    for (int k = 0; k < steps*degree; ++k) x[2][k] = way[k][0], y[2][k] = way[k][1];
    for (int k = 0; k < 3*steps; ++k) {                  // from the flight to the tip of the push, and a gap
        const double *w = way[k/3*degree], gap = k % 3 == 2 ? HUGE_VAL : 30*(k % 3);
        x[3][k] = w[0] + gap*w[2], y[3][k] = w[1] + gap*w[3];
    }
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    static double way[MOST_NODES*MOST_STEPS][4];
    double cost, best, start[4], error[2] = { 0, 0 };
    const int flights = best_flight(6, 24, &best, start, way);
    if (flights < 0) return 1;
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2], way, 24, 6) ? perror(argv[2]), 1 : 0;
    printf("degree 6, 24 steps: cost %.12f, first thrust %.11f\n", best, -start[1]);
    printf("Newton's method, from no thrust at all: %s\n", flights <= 8 ? "8 flights or less" : "more than 8 flights");
    printf("the error of the cost at half the step, degree 2, 3, 4: smaller by");
    for (int s = 2; s <= 4; ++s) {
        for (int i = 0; i < 2 && best_flight(s, (s < 4 ? 24 : 12) << i, &cost, start, NULL) > 0; ++i) error[i] = fabs(cost - best);
        printf(" 2^%.0f%s", log2(error[0]/error[1]), s < 4 ? "," : "\n");
    }
}
