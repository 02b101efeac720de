/* refused.c - what desc.resolution refuses of a rope: of the steps that are wrong, and of those that are right

   The rope of rope.c, at 240 Hz, halved where no solution is found.  Each step that is found is compared with 64 parts
   of it and with 32, of degree 4.  It is wrong where these agree to 2 % and it is off by more than 10: of the longest
   way of a bead, or of the largest velocity.  From there on the motion is that of the parts.  A second stepper, with a
   dial of .999, takes the same steps for the measure; what it refuses is above any dial.  A dial of .1 has to refuse
   what is off by twice that, and at most 10 % of what is off by less than half of it.

     refused [seconds, 10] [degree, all]                                                                           */
#include "rope.h"

enum { PARTS = 64, N = 2*MOST, LIMITS = 3 };
static const double limits[LIMITS] = { .1, .03, .01 };
typedef struct tally { long steps, refused[LIMITS], small[LIMITS], needless[LIMITS]; double off[LIMITS]; } tally;

static gvi_stepper step, measured, parts;
static tally right, wrong;                /* small: off by below half the limit; off: most that is not refused */
static long unknown, failed;

static double farthest(const real *x, const real *y, double scale)
{
    double most = 0;
    for (int i = 0; i < 2*beads; ++i) most = fmax(most, fabs((double)(x[i] - y[i])));
    return most/scale;
}

/* The state after h in `count` parts */
static int finely(real h, int count, const real *q, const real *v, real *q1, real *v1)
{
    if (gvi_start(&parts, 0, q, v) != GVI_OK || gvi_steps(&parts, h/(real)count, count) != GVI_OK) return 0;
    memcpy(q1, parts.q, sizeof *q*(size_t)(2*beads));
    return gvi_velocity(&parts, v1) == GVI_OK;
}

static void restart(gvi_stepper *st, const real *q, const real *v) { must(gvi_start(st, step.t, q, v)); }

/* The step that `step` has taken from q, v */
static void judge(real h, const real *q, const real *v)
{
    real coarse[N], rate[N], exact[N], velocity[N], now[N];
    static const real none[N];
    double resolution = 1;
    must(gvi_velocity(&step, now));
    if (gvi_step(&measured, h) == GVI_OK) resolution = (double)measured.resolution;
    else restart(&measured, step.q, now);

    if (!finely(h, PARTS/2, q, v, coarse, rate) || !finely(h, PARTS, q, v, exact, velocity)) { ++unknown; return; }
    const double way = farthest(exact, q, 1), speed = farthest(velocity, none, 1),
                 off = fmax(farthest(step.q, exact, way), farthest(now, velocity, speed));
    if (fmax(farthest(coarse, exact, way), farthest(rate, velocity, speed)) > .02) { ++unknown; return; }
    tally *t = off > .1 ? &wrong : &right;
    ++t->steps;
    for (int k = 0; k < LIMITS; ++k) {
        const int refused = resolution > limits[k], small = off < limits[k]/2;
        t->refused[k] += refused;
        t->small[k] += small;
        t->needless[k] += refused && small;
        if (!refused) t->off[k] = fmax(off, t->off[k]);
    }
    if (t == &right) return;
    restart(&step, exact, velocity);
    restart(&measured, exact, velocity);
}

static int go(real h, int deep)
{
    real q[N], v[N];
    memcpy(q, step.q, sizeof q);
    must(gvi_velocity(&step, v));
    if (gvi_step(&step, h) == GVI_OK) return judge(h, q, v), 1;
    ++failed;
    return deep < DEEPEST && go(h/2, deep + 1) && go(h/2, deep + 1);
}

static void study(int degree, double seconds, real *room)
{
    static const tally none;
    right = wrong = none;
    unknown = failed = 0;
    hang(&step, degree, 0, room);
    hang(&measured, degree, (real).999, room + ROOM/sizeof *room);
    hang(&parts, 4, 0, room + 2*(ROOM/sizeof *room));
    int goes_on = 1;
    for (int k = 0; k < (int)(seconds*RATE) && goes_on; ++k) {
        goes_on = go((real)1/RATE, 0);
        progress("refused", k, (long)(seconds*RATE));
    }
    for (int k = 0; k < LIMITS; ++k) {
        const double share = (double)right.refused[k]/(double)right.steps, off = fmax(right.off[k], wrong.off[k]),
                     needless = right.small[k] ? (double)right.needless[k]/(double)right.small[k] : 0;
        if (k == 0) printf("  %d %9ld %8ld %8ld %8ld", degree, right.steps, wrong.steps, unknown, failed);
        printf("%*s %4g %6ld %7.1f %% %9.1f %% %9.2g\n", k ? 38 : 0, "", limits[k], wrong.refused[k], 100*share,
               100*needless, off);
        if (k == 0) misses += off > 2*limits[k] || needless > .1;
    }
    if (!goes_on) printf("      stopped: %s\n", gvi_why(&step));
    misses += !goes_on;
    fflush(stdout);
}

int main(int count, char **words)
{
    const double seconds = count > 1 ? atof(words[1]) : 10;
    real *room = malloc(3*(size_t)ROOM);
    if (!room) return 1;
    printf("  %g s                                  refused: of    of right   off by less    most that\n"
           "  degree  right    wrong  unknown   failed above wrong              than half     is not\n", seconds);
    for (int degree = 1; degree <= 4; degree *= 2)
        if (count < 3 || degree == atoi(words[2])) study(degree, seconds, room);
    free(room);
    return verdict("refused");
}
