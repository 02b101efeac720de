/* newton.c - a step by Newton's method, its Jacobian as one matrix of s n and as complex ones of n

   A stiff double pendulum with M(q) and no Hessian (tests/hard/stiff.c), the Fermi-Pasta-Ulam chain of
   that file at h omega = 5, and chains of 20 and 100 masses between stiff and soft springs in turn, with
   a Hessian, at h omega = 2.  CPU time of a step, the best of five runs of each, taken in turn; iterations and
   Jacobians a step; how far apart both end.

     newton [problem degree blocks]     that run alone, for callgrind: problem 0 to 3, blocks 0 or 1   */
#include "../hard/pendulum.h"

enum { MOST = 100, MOST_DEGREE = 8 };
static double memory[GVI_LENGTH(MOST, MOST_DEGREE, MOST_DEGREE)];
static const double omega = 50;
#include "../fermi_pasta_ulam.h"
#include "../springs.h"

/* Even springs stiff, odd ones u + u^3 */
static double tension(int i, double u) { return i % 2 ? u + u*u*u : omega*omega*u; }
static double stiffness_of(int i, double u) { return i % 2 ? 1 + 3*u*u : omega*omega; }

static int chain(const gvi_points *x, void *user)
{
    const int d = x->stride, n = x->n;
    (void)user;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < x->count; ++k)
            add_tension(n, i, d, tension(i, stretch(n, i, d, x->q + k)), x->f + k);
    return 0;
}

static int chain_hessian(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *fq, gvi_real *fv,
                           gvi_real *pv, void *user)
{
    const int n = *(const int *)user;
    (void)t, (void)v, (void)fv, (void)pv;
    for (int i = 0; i < n; ++i) add_stiffness(n, i, stiffness_of(i, stretch(n, i, 1, q)), fq);
    return 0;
}

typedef struct problem {
    const char *name;
    int n, steps;
    double h;
    gvi_effect effect;
    gvi_mass mass;
} problem;

static int sizes[] = { 20, 100 };

static const problem problems[] = {
    { "pendulum", 2, 4000, 1.0/128, { .kind = GVI_POTENTIAL, .points = pendulum_forces },
      { GVI_MASS_POSITION, NULL, pendulum_mass, pendulum_gradient, pendulum_velocity, NULL } },
    { "Fermi-Pasta-Ulam", 6, 2000, 0.1, { .kind = GVI_POTENTIAL, .points = fermi_pasta_ulam_forces },
      { GVI_MASS_UNIT, NULL, NULL, NULL, NULL, NULL } },
    { "springs", 20, 400, 0.04, { .kind = GVI_POTENTIAL, .points = chain, .hessian = chain_hessian, .user = sizes },
      { GVI_MASS_UNIT, NULL, NULL, NULL, NULL, NULL } },
    { "springs", 100, 40, 0.04, { .kind = GVI_POTENTIAL, .points = chain, .hessian = chain_hessian, .user = sizes + 1 },
      { GVI_MASS_UNIT, NULL, NULL, NULL, NULL, NULL } },
};

typedef struct cost { double time, iterations, jacobians, q; } cost;

static void begin(const problem *a, int degree, int blocks, gvi_stepper *st)
{
    double q[MOST], p[MOST];
    const gvi_desc desc = { .n = a->n, .degree = degree, .effects = &a->effect, .effect_count = 1,
                            .mass = a->mass, .formulation = GVI_NEWTON };
    for (int i = 0; i < a->n; ++i) {
        q[i] = a->n > 6 ? 0.5*sin(0.7*i) : i == 0 ? 1 : i == 3 ? 1/omega : 0;
        p[i] = a->n > 6 ? 0.5*cos(1.3*i) : i == 0 || i == 3;
    }
    if (a->n > 6)                       // stiff springs hardly stretched
        for (int i = 0; i + 1 < a->n; i += 2) q[i + 1] = q[i] + 0.3/omega;
    if (a->n == 2) {
        stiffness = 32*32;
        q[0] = 1.1;
        q[1] = -1.1/sqrt(1 + 100*stiffness);
        p[0] = p[1] = 2.7746;
    }
    must(gvi_init(st, &desc, memory, sizeof memory));
    must(gvi_start_momentum(st, 0, q, p));
    if (!blocks) st->x.blocks = 0;
}

static void run_steps(gvi_stepper *st, const problem *a)
{
    for (int k = 0; k < a->steps; ++k) must(gvi_step(st, a->h));
}

/* Adds a run: the best time */
static void run(const problem *a, int degree, int blocks, cost *z)
{
    gvi_stepper st;
    begin(a, degree, blocks, &st);
    const long double E = pendulum_energy(st.q, st.p);
    const clock_t from = clock();
    run_steps(&st, a);
    const double time = (double)(clock() - from)/CLOCKS_PER_SEC/a->steps;
    if (z->time <= 0 || time < z->time) z->time = time;
    z->iterations = (double)st.counters.newton_iterations/a->steps;
    z->jacobians = (double)st.counters.factorizations/a->steps/(st.x.has_blocks ? (degree + 1)/2 : 1);
    z->q = st.q[0];
    if (a->n == 2 && fabsl(pendulum_energy(st.q, st.p)/E - 1) > (degree < 4 ? 1e-2L : 1e-6L)) must(GVI_E_CONVERGENCE);
}

int main(int argc, char **argv)
{
    static const int degrees[] = { 2, 3, 4, 6, 8 };
    cost z[2] = { { 0, 0, 0, 0 }, { 0, 0, 0, 0 } };
    if (argc > 3) {
        run(problems + atoi(argv[1]), atoi(argv[2]), atoi(argv[3]), z);
        return 0;
    }
    printf("%-18s%4s %6s   %-28s   %-28s\n%30s   %8s %9s %9s   %8s %9s %9s %7s %8s\n", "", "n", "degree", "one matrix",
           "blocks", "", "us", "iterations", "Jacobians", "us", "iterations", "Jacobians", "ratio", "apart");
    for (int i = 0; i < COUNT(problems); ++i)
        for (int d = 0; d < COUNT(degrees); ++d) {
            const problem *a = problems + i;
            memset(z, 0, sizeof z);
            for (int k = 0; k < 10; ++k) run(a, degrees[d], k % 2, z + k % 2);
            printf("%-18s%4d %6d", a->name, a->n, degrees[d]);
            for (int k = 0; k < 2; ++k) printf("   %8.1f %10.1f %9.2f", 1e6*z[k].time, z[k].iterations, z[k].jacobians);
            printf(" %7.2f %8.1e\n", z[0].time/z[1].time, fabs(z[0].q - z[1].q));
            fflush(stdout);
        }
    return 0;
}
