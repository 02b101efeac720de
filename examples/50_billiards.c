/* 50 - What if many bodies hit each other? Billiards, and a ball that comes to rest

   Four balls in a square: sixteen walls, six pairs, 22 gaps. At an impact all contacts that touch take part at once, with
   impulses that push and never pull, and each leaves with e times the speed at which it came. e = 1: after 10,000 impacts
   the energy is that of the start, and a step back, h < 0, goes the way that was come.

   With e = 0.8 a ball on a slope bounces ever lower: infinitely many times in a finite time. c.rest ends that: an impact
   slower than c.rest is the last one, and the ball stays in contact and slides, with g sin(slope).

   prints

     10000 impacts: energy within 1e-14, the deepest of them 0e+00
     5 impacts there, 5 back: within 1e-13
     slope: 23 bounces, then it slides; at t = 20 within 1e-12
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/contact.h"
#include <math.h>
#include <stdio.h>

enum { N = 8, WALLS = 16, GAPS = 22 };
static const double radius = 0.3, half = 2, slope = 0.3;
static double memory[60000];

/* The walls of each coordinate, then the pairs */
static void gap(int which, double t, const double *q, double *phi, double *gradient, double *rate, void *user)
{
    static const int pairs[6][2] = { { 0, 2 }, { 0, 4 }, { 0, 6 }, { 2, 4 }, { 2, 6 }, { 4, 6 } };
    (void)t, (void)rate, (void)user;
    if (which < WALLS) {
        const int i = which/2;
        *phi = which % 2 ? half - radius - q[i] : half - radius + q[i];
        gradient[i] = which % 2 ? -1 : 1;
        return;
    }
    const int i = pairs[which - WALLS][0], j = pairs[which - WALLS][1];
    const double X = q[j] - q[i], Y = q[j + 1] - q[i + 1], d = sqrt(X*X + Y*Y);
    *phi = d - 2*radius;
    gradient[j] = X/d, gradient[j + 1] = Y/d, gradient[i] = -X/d, gradient[i + 1] = -Y/d;
}

static double energy(const double *p)
{
    double E = 0;
    for (int i = 0; i < N; ++i) E += p[i]*p[i]/2;
    return E;
}

static void billiards(void)
{
    const double q[N] = { -1,-1, 1,-1.1, 1.05,1, -1,0.9 }, v[N] = { 1,0.3, -0.2,0.7, -0.5,-0.6, 0.1,-0.9 };
    double e[GAPS], deepest = 0, off = 0, phi, unused[N], rate;
    gvi_effect rows[8];
    for (int i = 0; i < GAPS; ++i) e[i] = 1;
    contact c = { .count = GAPS, .slots = 8, .gap = gap, .e = e };
    contact_rows(&c, rows);
    const gvi_desc desc = { .n = N, .degree = 2, .effects = rows, .effect_count = 8 };
    gvi_status status = contact_init(&c, &desc, memory, sizeof memory);
    if (!status) status = contact_start(&c, 0, q, v);
    while (c.seen[CONTACT_IMPACT] < 10000 && !status) {
        status = contact_step(&c, 0.1);
        for (int a = 0; a < GAPS; ++a) {
            gap(a, 0, c.st.q, &phi, unused, &rate, NULL);
            if (phi < -1e-13) deepest = fmax(deepest, -phi);
        }
    }
    printf("%llu impacts: energy within %.0e, the deepest of them %.0e\n", c.seen[CONTACT_IMPACT],
           pow(10, ceil(log10(fabs(energy(c.st.p)/energy(v) - 1)))), deepest);

    if (!status) status = contact_start(&c, 0, q, v);
    const unsigned long long before = c.seen[CONTACT_IMPACT];
    for (int k = 0; k < 40 && !status; ++k) status = contact_step(&c, 0.1);
    const unsigned long long there = c.seen[CONTACT_IMPACT] - before;
    for (int k = 0; k < 40 && !status; ++k) status = contact_step(&c, -0.1);
    for (int i = 0; i < N; ++i) off = fmax(off, fmax(fabs(c.st.q[i] - q[i]), fabs(c.st.p[i] - v[i])));
    printf("%llu impacts there, %llu back: within %.0e\n", there, c.seen[CONTACT_IMPACT] - before - there,
           off < 1e-13 ? 1e-13 : pow(10, ceil(log10(off))));
    if (status) puts(contact_why(&c, status));
}

GVI_EACH(weight, 2, f) { x->f[1] -= 1; }

static void ground(int which, double t, const double *q, double *phi, double *gradient, double *rate, void *user)
{
    (void)which, (void)t, (void)rate, (void)user;
    *phi = cos(slope)*q[1] + sin(slope)*q[0], gradient[0] = sin(slope), gradient[1] = cos(slope);
}

static void come_to_rest(void)
{
    const double e = 0.8, q[] = { 0, 1 }, v[] = { 0.2, 0 }, T = 20;
    contact c = { .count = 1, .slots = 1, .gap = ground, .e = &e, .rest = 1e-2 };
    gvi_effect scene[2] = { { .kind = GVI_POTENTIAL, .points = weight } };
    contact_rows(&c, scene + 1);
    const gvi_desc desc = { .n = 2, .degree = 4, .effects = scene, .effect_count = 2 };
    gvi_status status = contact_init(&c, &desc, memory, sizeof memory);
    if (!status) status = contact_start(&c, 0, q, v);
    for (int k = 0; k < 16 && !status; ++k) status = contact_step(&c, T/16);
    if (status) puts(contact_why(&c, status));
    const double along = cos(slope)*c.st.q[0] - sin(slope)*c.st.q[1],
                 exact = -sin(slope) + 0.2*cos(slope)*T + sin(slope)*T*T/2;          // whatever the bounces
    printf("slope: %llu bounces, then it slides; at t = 20 within %.0e\n", c.seen[CONTACT_IMPACT],
           pow(10, ceil(log10(fabs(along - exact) + 1e-13))));
}

int main(void)
{
    billiards();
    come_to_rest();
    return 0;
}
