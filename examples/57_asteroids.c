/* 57 - Asteroids among planets, and short runs: what many motions share is computed once

   Asteroids feel the planets, not each other.  Jupiter and Saturn go on circles here, known functions
   of t, so an effect needs their places at the times of its points.  All asteroids make the same steps:
   these times are the same for each of them, and in each iteration.  So the effect keeps the places that
   it computed last with their times, and looks there first.  The steps of all asteroids go side by side.
   Where steppers run on threads each thread has its own `shared`.

   A short run has a price before its first step: gvi_init makes the tables of rule and degree.
   gvi_start on a stepper that is there begins another motion, of the same scene, without it.

   With gcc -O2 shared places take 2.3 to 2.7 times less CPU time, short runs with one gvi_init 2.0 to 2.5
   times less (five runs of each).

   57_asteroids [anything: with these ratios]
   prints

     100 asteroids, 200 steps: places computed once in 100 evaluations or less: yes
     the same ends to the last bit: yes
     400 runs of 10 steps, gvi_init once for all of them: the same ends to the last bit: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { ASTEROIDS = 100, STEPS = 200, PLANETS = 2, POINTS = 8, RUNS = 400 };

/* AU, years: radius, radians a year, mass over the Sun's, angle at t = 0 */
static const double planet[PLANETS][4] = { { 5.203, 0.5297, 9.547e-4, 1 }, { 9.537, 0.2133, 2.858e-4, 3 } };
static const double Sun = 39.4784176;

typedef struct shared {
    int on, count;                        /* on 0: every evaluation computes the places */
    long computed, evaluations;
    double t[POINTS], x[PLANETS][POINTS], y[PLANETS][POINTS];
} shared;

static void places(const gvi_points *x, shared *s)
{
    s->evaluations += 1;
    if (s->on && s->count == x->count && memcmp(s->t, x->t, sizeof *x->t*(size_t)x->count) == 0) return;
    s->computed += 1;
    s->count = x->count;
    memcpy(s->t, x->t, sizeof *x->t*(size_t)x->count);
    for (int p = 0; p < PLANETS; ++p)
        for (int k = 0; k < x->count; ++k) {
            const double angle = planet[p][3] + planet[p][1]*x->t[k];
            s->x[p][k] = planet[p][0]*cos(angle);
            s->y[p][k] = planet[p][0]*sin(angle);
        }
}

static int pull(const gvi_points *x, void *user)
{
    shared *s = user;
    const double *X = x->q, *Y = x->q + x->stride;
    double *fx = x->f, *fy = x->f + x->stride;
    places(x, s);
    for (int k = 0; k < x->count; ++k) {
        const double r2 = X[k]*X[k] + Y[k]*Y[k], w = Sun/(r2*sqrt(r2));
        fx[k] -= w*X[k];
        fy[k] -= w*Y[k];
    }
    for (int p = 0; p < PLANETS; ++p)
        for (int k = 0; k < x->count; ++k) {
            const double dx = s->x[p][k] - X[k], dy = s->y[p][k] - Y[k], r2 = dx*dx + dy*dy,
                         w = Sun*planet[p][2]/(r2*sqrt(r2));
            fx[k] += w*dx;
            fy[k] += w*dy;
        }
    return 0;
}

/* asteroid k on a circle of 2 to 3.5 AU */
static void begin(int k, double *q, double *v)
{
    const double r = 2 + 1.5*k/ASTEROIDS, angle = 2.4*k, speed = sqrt(Sun/r);
    q[0] = r*cos(angle), q[1] = r*sin(angle);
    v[0] = -speed*sin(angle), v[1] = speed*cos(angle);
}

/* all of them, step by step; returns the CPU time, or -1 */
static double together(shared *s, double end[][2])
{
    static double memory[ASTEROIDS][GVI_LENGTH(2, POINTS, POINTS)];
    static gvi_stepper st[ASTEROIDS];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pull, .user = s } };
    const gvi_desc desc = { .n = 2, .degree = POINTS, .effects = scene, .effect_count = 1 };
    const clock_t from = clock();
    double q[2], v[2];
    for (int k = 0; k < ASTEROIDS; ++k) {
        begin(k, q, v);
        if (gvi_init(st + k, &desc, memory[k], sizeof memory[k]) || gvi_start(st + k, 0, q, v)) return -1;
    }
    for (int step = 0; step < STEPS; ++step)
        for (int k = 0; k < ASTEROIDS; ++k)
            if (gvi_step(st + k, 0.25)) return printf("%s\n", gvi_why(st + k)), -1;
    for (int k = 0; k < ASTEROIDS; ++k) memcpy(end[k], st[k].q, sizeof end[k]);
    return (double)(clock() - from)/CLOCKS_PER_SEC;
}

/* many short runs, with gvi_init before each or before the first alone */
static double short_runs(int once, double end[][2])
{
    static double memory[GVI_LENGTH(2, POINTS, POINTS)];
    static shared s;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pull, .user = &s } };
    const gvi_desc desc = { .n = 2, .degree = POINTS, .effects = scene, .effect_count = 1 };
    const clock_t from = clock();
    gvi_stepper st;
    double q[2], v[2];
    for (int k = 0; k < RUNS; ++k) {
        begin(k % ASTEROIDS, q, v);
        if ((k == 0 || !once) && gvi_init(&st, &desc, memory, sizeof memory)) return -1;
        if (gvi_start(&st, 0, q, v)) return -1;
        for (int step = 0; step < 10; ++step)
            if (gvi_step(&st, 0.25)) return -1;
        memcpy(end[k], st.q, sizeof end[k]);
    }
    return (double)(clock() - from)/CLOCKS_PER_SEC;
}

int main(int count, char **words)
{
    static double alone[RUNS][2], same[RUNS][2];
    static shared every, once = { .on = 1 };
    const double slow = together(&every, alone), fast = together(&once, same);
    (void)words;
    if (slow < 0 || fast < 0) return 1;
    printf("%d asteroids, %d steps: places computed once in 100 evaluations or less: %s\n", ASTEROIDS, STEPS,
           100*once.computed <= once.evaluations ? "yes" : "no");
    printf("the same ends to the last bit: %s\n", memcmp(alone, same, ASTEROIDS*sizeof *same) ? "no" : "yes");
    if (count > 1) printf("  %ld for %ld; CPU time %.1f times less\n", once.computed, once.evaluations, slow/fast);
    const double each = short_runs(0, alone), first = short_runs(1, same);
    if (each < 0 || first < 0) return 1;
    printf("%d runs of 10 steps, gvi_init once for all of them: the same ends to the last bit: %s\n", RUNS,
           memcmp(alone, same, sizeof same) ? "no" : "yes");
    if (count > 1) printf("  CPU time %.1f times less\n", each/first);
    return 0;
}
