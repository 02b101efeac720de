/* constraints.c - a million steps on constraints: g, G v, and how the energy walks

   Spherical pendulum, rods with and without friction, four-bar linkage, the top in directors and in a
   quaternion, a pendulum on a moving pivot, and three cranks with one bar too many, at degree 8: g and
   the hidden constraint are 0 to rounding, whatever the number of steps.  The energy of 32 starts of the
   rods walks; its mean drift was measured as -0.00007 EPS a step, a third of the walk after 30,000 steps.
   For float the rods and the cranks.                                                                       */
#include "hard.h"
#include "linkages.h"

enum { STEPS = 1 << 20, STARTS = 32, SHORT = 1 << 15 };
static real memory[60000];

/* The largest |g_a| in eps sum |G_ai| max |q|, since all terms of d_a . d_b can pass 0 together; or
   |G v + dg/dt| in eps (|v| + 1/100): at rest there is nothing to measure by */
static double off(const gvi_stepper *st, const linkage *a, const real *v)
{
    real g[MOST_M], G[MOST_M*MOST_N] = { 0 }, rate[MOST_M] = { 0 };
    real largest = 0;
    double worst = 0;
    constraint_of_state(st, a, g, G, rate);
    for (int i = 0; i < a->n; ++i) largest = (real)fmax((double)largest, fabs((double)st->q[i]));
    for (int b = 0; b < a->m; ++b) {
        double size = v ? 0.01 : fabs((double)(rate[b]*st->t)), sum = (double)(v ? rate[b] : g[b]);
        for (int i = 0; i < a->n; ++i) {
            size += fabs((double)(v ? v[i] : G[b*a->n + i]*largest));
            if (v) sum += (double)(G[b*a->n + i]*v[i]);
        }
        worst = fmax(worst, fabs(sum)/(EPS*size));
    }
    return worst;
}

static void begin(gvi_stepper *st, const linkage *a, const gvi_desc *desc, const real *q)
{
    must(gvi_init(st, desc, memory, sizeof memory));
    must(gvi_start(st, 0, q, a->v));
}

static void million(linkage_id id, const char *name, real h)
{
    static real down[6] = { 0, -1, 0, -1, 0, -1 };
    linkage a = make_linkage(id == LINKAGES ? RODS : id);
    if (id == LINKAGES) {                         // the cranks, hanging, 1/2 rad aside
        const linkage loop = { .n = 6, .m = 6, .count = 2, .effects = {
            { .kind = GVI_POTENTIAL, .points = constant, .value = constant, .user = down },
            { .kind = GVI_CONSTRAINT, .points = cranks, .rows = 6 } } };
        a = loop;
        for (int k = 0; k < 3; ++k) {
            a.q[2*k] = (real)(k*(k + 1)/2) + (real)sin(0.5);
            a.q[2*k + 1] = -(real)cos(0.5);
        }
    }
    const gvi_desc desc = linkage_desc(&a, 8);
    double early = 0, late = 0, hidden = 0, worst = 0;
    real v[MOST_N], E0, E;
    gvi_stepper st;
    printf("%s\n", name);
    begin(&st, &a, &desc, a.q);
    must(gvi_energy(&st, &E0));
    for (int k = 0; k < STEPS; ++k) {
        must(gvi_step(&st, h));
        const double g = off(&st, &a, NULL);
        if (k < STEPS/10) early = fmax(early, g);
        if (k >= STEPS - STEPS/10) late = fmax(late, g);
        if (k % 64) continue;
        must(gvi_velocity(&st, v));
        must(gvi_energy(&st, &E));
        hidden = fmax(hidden, off(&st, &a, v));
        worst = fmax(worst, fabs((double)(E - E0)/(1 + fabs((double)E0))));
    }
    expect("largest |g|, in units of its terms' rounding, first tenth", 0, early, 6);
    expect("the same, last tenth", 0, late, 6);
    expect("largest G v + dg/dt, in units of EPS |v|", 0, hidden, 6);
    if (id != PIVOT && id != FRICTION) expect("max |dE| in EPS", 0, worst/EPS, 4000);
}

/* Starts of the rods from below the horizontal, where degree 8 at h = 1/32 errs by less than rounding */
static void ensemble(void)
{
    const linkage a = make_linkage(RODS);
    const gvi_desc desc = linkage_desc(&a, 8);
    double squares[2] = { 0 }, mean = 0;
    puts("rods, 32 starts");
    for (int j = 0; j < STARTS; ++j) {
        const double angle = -0.3 - 0.02*j;
        const real c = (real)cos(angle), s = (real)sin(angle), q[4] = { c, s, c + (real)0.6, s + (real)0.8 };
        gvi_stepper st;
        real E0, E;
        begin(&st, &a, &desc, q);
        must(gvi_energy(&st, &E0));
        for (int k = 1; k <= SHORT; ++k) {
            must(gvi_step(&st, (real)0.03125));
            if (k != SHORT && k != SHORT/16) continue;
            must(gvi_energy(&st, &E));
            squares[k == SHORT] += (double)(E - E0)*(double)(E - E0)/STARTS;
            if (k == SHORT) mean += (double)(E - E0)/STARTS;
        }
    }
    printf("  rms of dE after %d and %d steps: %.2f and %.2f EPS\n", SHORT/16, SHORT, sqrt(squares[0])/EPS,
           sqrt(squares[1])/EPS);
    expect("their ratio; a walk has 4, a drift 16", 0, sqrt(squares[1]/squares[0]), 6);
    expect("mean drift, in EPS a step", -0.0003, mean/EPS/SHORT, 0.0003);
}

int main(void)
{
    ensemble();
    million(LINKAGES, "cranks with a redundant row, h = 1/16", (real)0.0625);
    million(RODS, "rods, h = 1/32", (real)0.03125);
    if (sizeof(real) > sizeof(float)) {
        million(SPHERE, "spherical pendulum, h = 1/16", (real)0.0625);
        million(FOUR_BAR, "four-bar linkage, h = 1/32", (real)0.03125);
        million(DIRECTORS, "top in directors, h = 1/25", (real)0.04);
        million(QUATERNION, "top in a quaternion, h = 1/25", (real)0.04);
        million(PIVOT, "pendulum on a moving pivot, h = 1/16", (real)0.0625);
        million(FRICTION, "rods with friction, h = 1/32", (real)0.03125);
    }
    return verdict("constraints");
}
