/* One step of every formulation against a 50-digit solution of the equations in
   control points (tests/gen/oracle.py): q1, p1, the curve and the action, for
   seven problems, degrees 1 to 5 and 8, Gauss and Lobatto rules. */
#include "gvi_test.h"
#include "problems.h"
#include "data/oracle.h"

enum { N_MAX = 3, TERMS = 3, FORMULATIONS = 6 };

/* The largest error allowed, in eps of the magnitudes of q, p and the action. */
#define LIMIT 4

/* the problems
   Constants are quotients of integers, so that they are exact in any gvi_real. */

typedef gvi_real value_fn(gvi_real t, const gvi_real *q, const gvi_real *v);

/* An effect; also the user pointer of its callbacks. */
struct term {
    gvi_kind        kind;
    gvi_point_fn   *point;
    value_fn       *value;
    gvi_hessian_fn *hessian;
};

struct problem {
    gvi_mass    mass;
    int         count;
    struct term terms[TERMS];
};

#define VALUE(name) static gvi_real name(gvi_real t, const gvi_real *q, const gvi_real *v)

/* separable */
static const gvi_real two_masses[] = { 5/(gvi_real)4, 3/(gvi_real)4 };

AT_POINT(separable_point)
{
    gvi_real x = q[0], y = q[1];
    f[0] -= x + 5*x*y/2 + 5*x*x*x/2 + y/4;
    f[1] -= 3*y/2 + 5*x*x/4 - 9*y*y/8 + x/4;
    return 0;
}

VALUE(separable_value)
{
    gvi_real x = q[0], y = q[1];
    return x*x/2 + 3*y*y/4 + 5*x*x*y/4 - 3*y*y*y/8 + 5*x*x*x*x/8 + x*y/4;
}

HESSIAN(separable_hessian)
{
    gvi_real x = q[0], y = q[1], xy = 5*x/2 + 1/(gvi_real)4;
    fq[0] -= 1 + 5*y/2 + 15*x*x/2;  fq[1] -= xy;
    fq[2] -= xy;                    fq[3] -= (6 - 9*y)/4;
    return 0;
}

/* pendulum: T = (11/4 v0^2 + 7/8 v1^2)/2 + 9/8 v0 v1 cos(q0 - q1) */

VALUE(pendulum_value)
{
    return -11*cos(q[0])/2 - 7*cos(q[1])/4;
}

/* magnetic: a potential, and A(q).v with a field that is not uniform */
AT_POINT(trap_point)
{
    gvi_real x = q[0], y = q[1];
    f[0] -= 2*x + x*y*y;
    f[1] -= 3*y/2 + x*x*y;
    return 0;
}

VALUE(trap_value)
{
    gvi_real x = q[0], y = q[1];
    return x*x + 3*y*y/4 + x*x*y*y/2;
}

HESSIAN(trap_hessian)
{
    gvi_real x = q[0], y = q[1];
    fq[0] -= 2 + y*y;  fq[1] -= 2*x*y;
    fq[2] -= 2*x*y;    fq[3] -= 3/(gvi_real)2 + x*x;
    return 0;
}

AT_POINT(curved_point)
{
    gvi_real x = q[0], y = q[1];
    f[0] += v[0]*y*y/4 + v[1]*(2 + 3*x)/4;
    f[1] += v[0]*(2*x*y - 3)/4;
    dldv[0] += (x*y*y - 3*y)/4;
    dldv[1] += (4*x + 3*x*x)/8;
    return 0;
}

VALUE(curved_value)
{
    gvi_real x = q[0], y = q[1];
    return v[0]*(x*y*y - 3*y)/4 + v[1]*(4*x + 3*x*x)/8;
}

HESSIAN(curved_hessian)
{
    gvi_real x = q[0], y = q[1];
    fq[0] += 3*v[1]/4;        fq[1] += y*v[0]/2;
    fq[2] += y*v[0]/2;        fq[3] += x*v[0]/2;
    fv[0] += y*y/4;           fv[1] += (2 + 3*x)/4;
    fv[2] += (2*x*y - 3)/4;
    return 0;
}

/* relativistic: m = 3/4, c = 5/4 */
static gvi_real slowness(const gvi_real *v) { return sqrt(1 - 16*(v[0]*v[0] + v[1]*v[1])/25); }

AT_POINT(relativistic_point)
{
    gvi_real w = slowness(v);
    for (int i = 0; i < 2; ++i) dldv[i] += 3*v[i]/(4*w);
    return 0;
}

VALUE(relativistic_value)
{
    return -75*slowness(v)/64;
}

HESSIAN(relativistic_hessian)
{
    gvi_real w = slowness(v);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            pv[2*i + j] += 3*((i == j) + 16*v[i]*v[j]/(25*w*w))/(4*w);
    return 0;
}

GVI_EACH(relativistic_velocity, 2, p, velocity)
{
    gvi_real a = x->p[0], b = x->p[1], w = sqrt(9/(gvi_real)16 + 16*(a*a + b*b)/25);
    x->velocity[0] = a/w;
    x->velocity[1] = b/w;
}

AT_POINT(bowl_point)
{
    gvi_real x = q[0], y = q[1];
    f[0] -= (5*x + 3*y*y)/4;
    f[1] -= (9*y + 6*x*y)/4;
    return 0;
}

VALUE(bowl_value)
{
    gvi_real x = q[0], y = q[1];
    return (5*x*x + 9*y*y + 6*x*y*y)/8;
}

HESSIAN(bowl_hessian)
{
    fq[0] -= 5/(gvi_real)4;  fq[1] -= 3*q[1]/2;
    fq[2] -= 3*q[1]/2;       fq[3] -= (9 + 6*q[0])/4;
    return 0;
}

/* driven.  Only the lower triangle may be read: the upper one lies. */

static const gvi_real driven_mass[] = {
     3/(gvi_real)2,  99,            99,
     1/(gvi_real)4,  1,             99,
    -1/(gvi_real)8,  1/(gvi_real)2, 5/(gvi_real)4
};

AT_POINT(driven_point)
{
    gvi_real x = q[0], y = q[1], z = q[2], d = x - y, w = cos(5*t/2);
    f[0] -= x + 3*y*z/8 + d*z*z + 11*w/8;
    f[1] -= 7*y/4 + 3*x*z/8 - d*z*z + 7*y*w/4 - 5*t/8;
    f[2] -= 3*z/4 + 3*x*y/8 + d*d*z + 5*t/16;
    return 0;
}

VALUE(driven_value)
{
    gvi_real x = q[0], y = q[1], z = q[2], d = x - y;
    return x*x/2 + 7*y*y/8 + 3*z*z/8 + 3*x*y*z/8 + d*d*z*z/2
         + (11*x + 7*y*y)*cos(5*t/2)/8 - 5*t*(2*y - z)/16;
}

/* damped */
static const gvi_real damped_mass[] = { 3/(gvi_real)2, 99, 3/(gvi_real)8, 5/(gvi_real)8 };

AT_POINT(swing_point)
{
    f[0] -= (9*sin(q[0]) + q[1])/4;
    f[1] -= (9*sin(q[1]) + 2*q[0])/8;
    return 0;
}

VALUE(swing_value)
{
    return (q[0]*q[1] - 9*cos(q[0]))/4 - 9*cos(q[1])/8;
}

HESSIAN(swing_hessian)
{
    fq[0] -= 9*cos(q[0])/4;   fq[1] -= 1/(gvi_real)4;
    fq[2] -= 1/(gvi_real)4;   fq[3] -= 9*cos(q[1])/8;
    return 0;
}

AT_POINT(drag_point)
{
    gvi_real w = sqrt(v[0]*v[0] + v[1]*v[1]);
    f[0] += (6*cos(3*t/2) - (3 + 2*w)*v[0])/8;
    f[1] += (4*cos(q[0] + 3*t) - (5 + w)*v[1])/8;
    return 0;
}

HESSIAN(drag_hessian)
{
    gvi_real w = sqrt(v[0]*v[0] + v[1]*v[1]), xy = v[0]*v[1]/w;
    fq[2] -= sin(q[0] + 3*t)/2;
    fv[0] -= (3 + 2*w + 2*v[0]*v[0]/w)/8;  fv[1] -= xy/4;
    fv[2] -= xy/8;                         fv[3] -= (5 + w + v[1]*v[1]/w)/8;
    return 0;
}

/* mixed: the pendulum, with the drag and this, which reads t, q and v */

AT_POINT(extra_point)
{
    gvi_real w = v[0]*v[0] + 2*v[1]*v[1];
    f[0] += 3*q[1]*v[1]/8;
    f[1] += (2*t*v[0] + 3*q[0]*v[1])/8;
    dldv[0] += t*q[1]/4 + w*v[0]/32;
    dldv[1] += 3*q[0]*q[1]/8 + w*v[1]/16;
    return 0;
}

VALUE(extra_value)
{
    gvi_real w = v[0]*v[0] + 2*v[1]*v[1];
    return (2*t*q[1]*v[0] + 3*q[0]*q[1]*v[1])/8 + w*w/128;
}

/* In the order of oracle_problems. */
static struct problem problems[] = {
    { { .kind = GVI_MASS_DIAGONAL, .matrix = two_masses }, 1,
      { { GVI_POTENTIAL, separable_point, separable_value, separable_hessian } } },
    { { .kind = GVI_MASS_POSITION, .points = absolute_mass, .gradient = absolute_gradient }, 1,
      { { GVI_POTENTIAL, absolute_weight, pendulum_value, NULL } } },
    { { .kind = GVI_MASS_UNIT }, 2,
      { { GVI_POTENTIAL, trap_point, trap_value, trap_hessian },
        { GVI_LAGRANGIAN, curved_point, curved_value, curved_hessian } } },
    { { .kind = GVI_MASS_NONE, .velocity = relativistic_velocity }, 2,
      { { GVI_LAGRANGIAN, relativistic_point, relativistic_value, relativistic_hessian },
        { GVI_POTENTIAL, bowl_point, bowl_value, bowl_hessian } } },
    { { .kind = GVI_MASS_DENSE, .matrix = driven_mass }, 1,
      { { GVI_POTENTIAL, driven_point, driven_value, NULL } } },
    { { .kind = GVI_MASS_DENSE, .matrix = damped_mass }, 2,
      { { GVI_POTENTIAL, swing_point, swing_value, swing_hessian },
        { GVI_FORCE, drag_point, NULL, drag_hessian } } },
    { { .kind = GVI_MASS_POSITION, .points = absolute_mass, .gradient = absolute_gradient }, 3,
      { { GVI_POTENTIAL, absolute_weight, pendulum_value, NULL },
        { GVI_FORCE, drag_point, NULL, drag_hessian },
        { GVI_LAGRANGIAN, extra_point, extra_value, NULL } } }
};

/* A term's functions of one point as callbacks for all points. */

static const gvi_real *gather(const gvi_points *x, const gvi_real *rows, int k, gvi_real *one)
{
    if (!rows) return NULL;
    for (int i = 0; i < x->n; ++i) one[i] = rows[i*x->stride + k];
    return one;
}

static int all_points(const gvi_points *x, void *user)
{
    const struct term *term = user;
    assert_true(!x->v == (term->kind == GVI_POTENTIAL) && !x->dldv == (term->kind != GVI_LAGRANGIAN));
    for (int k = 0; k < x->count; ++k) {
        gvi_real q[N_MAX], v[N_MAX], f[N_MAX] = { 0 }, dldv[N_MAX] = { 0 };
        term->point(x->t[k], gather(x, x->q, k, q), gather(x, x->v, k, v), f, dldv, NULL);
        for (int i = 0; i < x->n; ++i) x->f[i*x->stride + k] += f[i];
        for (int i = 0; x->dldv && i < x->n; ++i) x->dldv[i*x->stride + k] += dldv[i];
    }
    return 0;
}

static int all_values(const gvi_points *x, void *user)
{
    const struct term *term = user;
    for (int k = 0; k < x->count; ++k) {
        gvi_real q[N_MAX], v[N_MAX];
        x->value[k] += term->value(x->t[k], gather(x, x->q, k, q), gather(x, x->v, k, v));
    }
    return 0;
}

enum { ONE_POINT = 1, WITH_HESSIAN = 2, WITH_VELOCITY = 4 };

struct work { unsigned long long newton, points; int failed; };

// effects up to this kind: GVI_POTENTIAL, GVI_FORCE, GVI_LAGRANGIAN
static int only(const struct problem *a, gvi_kind kind)
{
    for (int e = 0; e < a->count; ++e)
        if (a->terms[e].kind > kind) return 0;
    return 1;
}

/* Which formulations the library must accept; it must refuse the others. */
static int covered(const struct problem *a, int options, const struct oracle_case *o, gvi_formulation how)
{
    int constant = a->mass.kind <= GVI_MASS_DENSE, simple = constant && only(a, GVI_POTENTIAL);
    switch (how) {
    case GVI_EXPLICIT:   return simple && o->lobatto && o->s == 1 && o->r == 2;
    case GVI_POSITIONS:  return simple;
    case GVI_VELOCITIES: return constant && only(a, GVI_FORCE);
    case GVI_MOMENTA:    return o->s == o->r && (a->mass.kind != GVI_MASS_NONE || options & WITH_VELOCITY);
    default:             return 1;
    }
}

static void describe(gvi_desc *desc, gvi_effect *effects, int options,
                     const struct oracle_case *o, gvi_formulation how)
{
    struct problem *a = &problems[o->problem];
    memset(desc, 0, sizeof *desc);
    desc->n = oracle_problems[o->problem].n;
    desc->degree = o->s;
    desc->rule.kind = o->lobatto ? GVI_LOBATTO : GVI_GAUSS;
    desc->rule.points = o->r;
    desc->mass = a->mass;
    if (!(options & WITH_VELOCITY)) desc->mass.velocity = NULL;
    desc->effects = effects;
    desc->effect_count = a->count;
    desc->formulation = how;
    if (DIG > 64) desc->max_iterations = 120;    /* 60, the default, leave 3^-60 = 2e-29 where they contract by 1/3 */
    for (int e = 0; e < a->count; ++e) {
        struct term *term = &a->terms[e];
        memset(&effects[e], 0, sizeof effects[e]);
        effects[e].kind = term->kind;
        if (options & ONE_POINT) effects[e].point = term->point;
        else effects[e].points = all_points;
        if (options & WITH_HESSIAN) effects[e].hessian = term->hessian;
        if (term->value) effects[e].value = all_values;
        effects[e].user = term;
    }
}

/* The largest difference, in eps of magnitude; infinite for a NaN. */
static long double difference(int n, const gvi_real *x, const long double *exact, double magnitude)
{
    long double worst = 0;
    for (int i = 0; i < n; ++i) {
        long double e = fabsl((long double)x[i] - exact[i])/((long double)magnitude*EPS);
        if (!(e <= worst)) worst = e == e ? e : HUGE_VALL;
    }
    return worst;
}

static long double larger(long double a, long double b) { return a > b ? a : b; }

/* The error of a step, infinite if it fails. */
static long double step_error(gvi_stepper *st, const struct oracle_case *o)
{
    const struct oracle_problem *a = &oracle_problems[o->problem];
    gvi_real t0 = (gvi_real)a->t0, h = (gvi_real)a->h, q[N_MAX], p[N_MAX], curve[N_MAX], action;
    long double e;
    for (int i = 0; i < a->n; ++i) q[i] = (gvi_real)a->q0[i], p[i] = (gvi_real)a->p0[i];
    if (gvi_start_momentum(st, t0, q, p) != GVI_OK || gvi_step(st, h) != GVI_OK) return HUGE_VALL;
    assert_true(st->t == t0 + h);
    e = larger(difference(a->n, st->q, o->q1, a->q), difference(a->n, st->p, o->p1, a->p));
    assert_ok(gvi_curve(st, 1/(gvi_real)4, curve, NULL));
    e = larger(e, difference(a->n, curve, o->quarter, a->q));
    assert_ok(gvi_curve(st, 3/(gvi_real)4, curve, NULL));
    e = larger(e, difference(a->n, curve, o->three_quarters, a->q));
    assert_ok(gvi_action(st, &action));
    return larger(e, difference(1, &action, &o->action, a->action));
}

static const char *const formulation_names[] = {
    "auto", "explicit", "positions", "velocities", "momenta", "newton"
};

/* The error of one case; -1, and a status checked, where it is not covered. */
static long double run_case(const struct oracle_case *o, int options, gvi_formulation how, struct work *work)
{
    static gvi_real memory[GVI_LENGTH(N_MAX, 8, 11)];
    gvi_effect effects[TERMS];
    gvi_desc desc;
    gvi_stepper st;
    long double e;
    describe(&desc, effects, options, o, how);
    if (!covered(&problems[o->problem], options, o, how)) {
        assert_status(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_FORMULATION);
        return -1;
    }
    st = new_stepper(&desc);
    e = step_error(&st, o);
    work->newton += st.counters.newton_iterations;
    work->points += st.counters.effect[0];
    if (e > LIMIT && !work->failed++)
        print_error("\n%s %s s=%d r=%d: %.3Lg eps, %s\n", formulation_names[how],
                    o->lobatto ? "lobatto" : "gauss", o->s, o->r, e, gvi_why(&st));
    return e;
}

/* All cases of a problem in all formulations: prints the worst errors and the
   first that is too large, returns the work of Newton and all failures. */
static struct work run(int problem, int options, const char *with)
{
    struct work work[FORMULATIONS] = { { 0, 0, 0 } };
    print_message("  %-12s %-14s", oracle_problems[problem].name, with);
    for (int how = 0; how < FORMULATIONS; ++how) {
        long double worst = -1;
        for (int k = 0; k < COUNT(oracle_cases); ++k)
            if (oracle_cases[k].problem == problem)
                worst = larger(worst, run_case(&oracle_cases[k], options, (gvi_formulation)how, &work[how]));
        if (worst < 0) print_message("          -");
        else print_message(" %10.2Lf", worst);
        if (how != GVI_NEWTON) work[GVI_NEWTON].failed += work[how].failed;
    }
    print_message("\n");
    return work[GVI_NEWTON];
}

TEST(all_points_at_once_to_4_eps)
{
    int failed = 0;
    print_message("  worst errors in eps          ");
    for (int how = 0; how < FORMULATIONS; ++how) print_message(" %10s", formulation_names[how]);
    print_message("\n");
    for (int k = 0; k < COUNT(problems); ++k) failed += run(k, 0, "").failed;
    assert_int_equal(failed, 0);
}

TEST(one_point_a_call_to_4_eps)
{
    int failed = 0;
    for (int k = 0; k < COUNT(problems); ++k) failed += run(k, ONE_POINT, "one point").failed;
    assert_int_equal(failed, 0);
}

/* Second derivatives change the work of Newton's method and nothing else: no
   more iterations, fewer evaluations. */
TEST(hessians_save_evaluations_and_change_nothing_else)
{
    int failed = 0;
    for (int k = 0; k < COUNT(problems); ++k)
        if (problems[k].terms[0].hessian) {
            struct work with = run(k, WITH_HESSIAN, "hessian"), without = run(k, 0, "");
            failed += with.failed + (with.points >= without.points)
                    + (with.newton > without.newton + without.newton/10);
        }
    assert_int_equal(failed, 0);
}

TEST(a_velocity_callback_changes_nothing)
{
    int failed = run(3, WITH_VELOCITY, "velocity").failed;
    failed += run(3, WITH_VELOCITY | WITH_HESSIAN | ONE_POINT, "velocity, all").failed;
    assert_int_equal(failed, 0);
}

/* Far out the term of fourth order in v outweighs M(q), and the fixed point of
   the momenta diverges, to infinity: whatever it says there, never "ok". */
TEST(what_diverges_is_never_ok)
{
    for (int k = 0; k < COUNT(oracle_cases); ++k)
        for (int scale = 4; scale <= 4096; scale *= 4) {
            const struct oracle_case *o = &oracle_cases[k];
            const gvi_real q[] = { 1/(gvi_real)2, -1/(gvi_real)4 }, p[] = { (gvi_real)scale, -(gvi_real)scale };
            gvi_effect effects[TERMS];
            gvi_desc desc;
            if (o->problem != 6 || o->r != o->s) continue;
            describe(&desc, effects, 0, o, GVI_MOMENTA);
            gvi_stepper st = new_stepper(&desc);
            assert_ok(gvi_start_momentum(&st, 0, q, p));
            assert_true(gvi_step(&st, 1/(gvi_real)8) != GVI_OK);
            assert_true(st.q[0] == q[0] && st.p[1] == p[1] && st.t == 0);
        }
}

RUN_TESTS(NULL, NULL)
