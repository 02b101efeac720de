/* 31 - A top without angles: does its quaternion precess as the textbook says?

   Orientation is a quaternion q, four numbers with |q| = 1: no angle, so no position in which
   the description fails. Kinetic energy T = 2 sum_i I_i (conj(q) v)_i^2, a mass M(q) = 4 L'IL
   with L = the matrix of v -> conj(q) v; conj(q) v is (0, half the body's angular velocity) while
   |q| = 1. The fourth inertia I_0 belongs to no rotation, but makes M(q) regular: take it near the
   others. Weight: V = m g l (q0^2 - q1^2 - q2^2 + q3^2), the height of the body's axis.

   A top with spin w3, tilted by a, precesses steadily with the small root of
   I1 W^2 cos a - I3 w3 W + m g l = 0. It starts so, and keeps its tilt; after 100 revolutions
   the azimuth is compared. The multiplier: T and V have degree 2 in q, so lambda = 2V - 4T.

   prints

     precession 0.7052541, 100 revolutions in 890.9 s
     azimuth as predicted, to 1e-10: yes
     tilt kept to 1e-12: yes
     |q| = 1 to 1e-15: yes
     lambda = 2V - 4T, to 1e-11: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static const double I[4] = { 1, 1, 1, 0.5 }, mgl = 1;

/* Column j of L: conj(q) e_j. */
static void columns(const double *q, double L[4][4])
{
    const double a = q[0], b = q[1], c = q[2], d = q[3];
    const double rows[4][4] = { { a, -b, -c, -d }, { b, a, -d, c }, { c, d, a, -b }, { d, -c, b, a } };
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) L[j][i] = rows[j][i];
}

GVI_EACH(mass, 4, mass)
{
    double L[4][4];
    columns(x->q, L);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = 0;
            for (int a = 0; a < 4; ++a) sum += I[a]*L[i][a]*L[j][a];
            x->mass[4*i + j] = 4*sum;
        }
}

/* dT/dq: conj(q) v = conj(conj(v) q), so T is the same with q and v exchanged, but for signs. */
GVI_EACH(mass_gradient, 4, v, f)
{
    double Q[4][4], V[4][4];
    columns(x->q, Q);
    columns(x->v, V);
    for (int a = 0; a < 4; ++a) {
        double w = 0;                             // (conj(q) v)_a
        for (int j = 0; j < 4; ++j) w += Q[j][a]*x->v[j];
        for (int j = 0; j < 4; ++j) x->f[j] += 4*I[a]*w*(a ? -V[j][a] : V[j][a]);
    }
}

GVI_EACH(weight, 4, f, value)
{
    const double *q = x->q;
    x->f[0] -= 2*mgl*q[0];
    x->f[1] += 2*mgl*q[1];
    x->f[2] += 2*mgl*q[2];
    x->f[3] -= 2*mgl*q[3];
    x->value[0] += mgl*(q[0]*q[0] - q[1]*q[1] - q[2]*q[2] + q[3]*q[3]);
}

GVI_EACH(unit, 4, rows(1))
{
    x->g[0] = -0.5;
    for (int i = 0; i < 4; ++i) {
        x->g[0] += x->q[i]*x->q[i]/2;
        x->jacobian[i] = x->q[i];
    }
}

/* The body's third axis in space. */
static void axis(const double *q, double *d)
{
    d[0] = 2*(q[1]*q[3] + q[0]*q[2]);
    d[1] = 2*(q[2]*q[3] - q[0]*q[1]);
    d[2] = q[0]*q[0] - q[1]*q[1] - q[2]*q[2] + q[3]*q[3];
}

static const char *yes(int is) { return is ? "yes" : "no"; }

int main(void)
{
    static double memory[GVI_CONSTRAINED_LENGTH(4, 8, 8, 1)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_CONSTRAINT, .points = unit, .rows = 1 } };
    const gvi_desc desc = { .n = 4, .degree = 8, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient } };
    const double turn = 6.28318530717958648, a = 0.6, spin = 4, b = I[3]*spin;
    const double W = 2*mgl/(b + sqrt(b*b - 4*I[1]*mgl*cos(a))), T = 100*turn/W;

    // turned by a about x; body angular velocity (0, W sin a, spin); v = q w/2
    const double c = cos(a/2), s = sin(a/2), w2 = W*sin(a)/2, w3 = spin/2;
    const double q[4] = { c, s, 0, 0 }, v[4] = { 0, 0, c*w2 - s*w3, c*w3 + s*w2 };
    double d[3], lambda, e, kinetic = 0, now[4];
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 12000 && st.status == GVI_OK; ++k) gvi_step(&st, T/12000);
    gvi_multipliers(&st, &lambda);
    gvi_energy(&st, &e);
    gvi_velocity(&st, now);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    for (int i = 0; i < 4; ++i) kinetic += st.p[i]*now[i]/2;
    axis(st.q, d);
    printf("precession %.7f, 100 revolutions in %.1f s\n", W, T);
    printf("azimuth as predicted, to 1e-10: %s\n", yes(fabs(atan2(d[0], -d[1])) < 1e-10));
    printf("tilt kept to 1e-12: %s\n", yes(fabs(d[2] - cos(a)) < 1e-12));
    printf("|q| = 1 to 1e-15: %s\n", yes(fabs(hypot(hypot(st.q[0], st.q[1]), hypot(st.q[2], st.q[3])) - 1) < 1e-15));
    printf("lambda = 2V - 4T, to 1e-11: %s\n", yes(fabs(lambda - (2*(e - kinetic) - 4*kinetic)) < 1e-11));
    return 0;
}
