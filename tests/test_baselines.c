/* The integrators that `make cost` compares gvi.h with: each has the order that it is published
   with, no less and no more.

   The system for q'' = a(q) is Kepler's, eccentricity 0.3, up to t = 20 and a little more; the exact
   state comes from Kepler's equation in long double.  The order is the slope of log error over
   log steps, by least squares over the errors between 1e-10 and 1e-4. */
#define GVI_REAL double
#include "gvi_test.h"
#include "cost/problems.h"
#include "cost/baselines.c"

static const double ellipse_q[] = { 0.7, 0 }, ellipse_v[] = { 0, 1.36277028773849 };  /* sqrt(1.3/0.7) */

static void ellipse_acceleration(const double *q, double *a)
{
    double d2 = q[0]*q[0] + q[1]*q[1], w = -1/(d2*sqrt(d2));
    a[0] = w*q[0];
    a[1] = w*q[1];
}

static void ellipse_slope(const double *y, double *dy)
{
    ellipse_acceleration(y, dy + 2);
    dy[0] = y[2];
    dy[1] = y[3];
}

/* For explicit methods for y' = f(y): three equations with known solutions, and the time; all
   errors stay where they are made.  (On an ellipse the drift of a dissipative method's energy,
   one order higher, grows with t^2 in the phase and covers the order looked for.) */
static const double known_q[] = { 1, 1 }, known_v[] = { 1, 0 };

static void known_slope(const double *y, double *dy)
{
    dy[0] = -y[0]*y[0]*y[0]/2;
    dy[1] = y[1]/4*(1 - y[1]/20);
    dy[2] = y[2]*cos(y[3]);
    dy[3] = 1;
}

static void known(long double t, long double *y)
{
    y[0] = 1/sqrtl(1 + t);
    y[1] = 20/(1 + 19*expl(-t/4));
    y[2] = expl(sinl(t));
}

/* Here nobody watches; the functions of problems.c that the baselines refer to. */
void watch_look(watch *w, const double *q, const double *v) { (void)w, (void)q, (void)v; }

/* From the elements that belong to the rounded start, which is at an apsis. */
static void exact(long double t, long double *q)
{
    long double r = ellipse_q[0], v = ellipse_v[1], a = 1/(2/r - v*v), e = 1 - r/a, n = 1/(a*sqrtl(a));
    long double E = n*t;
    for (int k = 0; k < 30; ++k) E -= (E - e*sinl(E) - n*t)/(1 - e*cosl(E));
    q[0] = a*(cosl(E) - e);
    q[1] = a*sqrtl(1 - e*e)*sinl(E);
}

static problem problem_for(const baseline *b, double end, long double *reference)
{
    problem p = { .key = "test", .n = 2, .end = end, .q = ellipse_q, .v = ellipse_v, .reference = reference };
    exact(end, reference);
    if (!b->first_order) p.acceleration = ellipse_acceleration;
    else p.slope = ellipse_slope;
    if (!b->first_order || b->structure) return p;
    known(end, reference);
    p.q = known_q;
    p.v = known_v;
    p.slope = known_slope;
    return p;
}

static long double error_at(const problem *p, const outcome *o)
{
    long double e = fmaxl(fabsl(o->q[0] - p->reference[0]), fabsl(o->q[1] - p->reference[1]));
    return p->slope == known_slope ? fmaxl(e, fabsl(o->v[0] - p->reference[2])) : e;
}

typedef struct fit { int count; long double x, y, xx, xy; } fit;

static void add_point(fit *f, long double x, long double y)
{
    ++f->count;
    f->x += x;
    f->y += y;
    f->xx += x*x;
    f->xy += x*y;
}

static long double slope_of(const fit *f)
{
    return (f->count*f->xy - f->x*f->y)/(f->count*f->xx - f->x*f->x);
}

/* The largest error at four times, which no zero of the error function can hide; *failed where
   an iteration did not converge. */
static long double errors_of(const baseline *b, double parameter, int *failed)
{
    static const double ends[] = { 20, 21.3, 22.9, 24.1 };
    static outcome o;
    long double worst = 0, reference[3];
    *failed = 0;
    for (int i = 0; i < COUNT(ends); ++i) {
        problem p = problem_for(b, ends[i], reference);
        b->run(&p, b, b->adaptive ? parameter : floor(parameter*ends[i]/20), NULL, &o);
        if (o.failed) *failed = 1;
        else worst = fmaxl(worst, error_at(&p, &o));
    }
    return worst;
}

/* Over steps; for adaptive methods over their tolerance, from 1e-3 to 1e-11. */
static long double order_of(const baseline *b)
{
    fit f = { 0, 0, 0, 0, 0 };
    for (int k = 0; k < 80; ++k) {
        long double e;
        int failed;
        double parameter = b->adaptive ? 1e-3*pow(0.6, k) : 4*pow(1.15, k);
        e = errors_of(b, parameter, &failed);
        if (failed || (!b->adaptive && !(e < 1e-4L))) continue;
        if (b->adaptive ? parameter < 1e-11 : e < 1e-10L) break;
        add_point(&f, logl(parameter), b->adaptive ? logl(e) : -logl(e));
    }
    assert_true(f.count >= 4);
    return slope_of(&f);
}

static void check_orders(const char *const *names, double order, double allowed)
{
    for (; *names; ++names) {
        const long double measured = order_of(baseline_named(*names));
        print_message("    %-24s %5.2f: %.2Lf\n", *names, order, measured);
        assert_close(measured, order, allowed);
    }
}
#define ORDER(order, allowed, ...) check_orders((const char *const[]){ __VA_ARGS__, NULL }, order, allowed)

TEST(compositions_and_splittings_have_their_orders)
{
    ORDER(2, 0.1, "Stoermer-Verlet");
    ORDER(8, 0.5, "Yoshida 8", "Yoshida 8 c", "Kahan-Li 8", "Kahan-Li 8 c", "Splitting 8");
    ORDER(10, 0.7, "Sofroniou-Spaletta 10", "Sofroniou-Spaletta 10 c");
    ORDER(6, 0.5, "Blanes-Moan SRKN11", "Blanes-Moan SRKN11 c", "Blanes-Moan SRKN14");
}

/* Its eight points integrate c^m exactly to m = 14, twice to m = 13, and no further: order 15. */
TEST(gauss_radau_has_order_15)
{
    for (int m = 0; m <= 15; ++m) {
        double k[RADAU], v = 0, q = 0;
        for (int i = 0; i < RADAU; ++i) {
            k[i] = i > 0 ? radau.d[i][0]*(pow(radau.c[i], m) - k[0]) : m == 0;
            for (int j = 1; j < i; ++j) k[i] += radau.d[i][j]*k[j];
        }
        for (int i = 0; i < RADAU; ++i) {
            v += radau.v[0][i]*k[i];
            q += radau.q[0][i]*k[i];
        }
        assert_true((fabs(v - 1.0/(m + 1)) < 1e-15) == (m <= 14));
        assert_true((fabs(q - 1.0/((m + 1)*(m + 2))) < 1e-15) == (m <= 13));
    }
}

TEST(gauss_radau_follows_its_tolerance)
{
    static const struct { const char *name; double coarse, fine; } runs[] = {
        { "Gauss-Radau 15", 1, 1e-3 }, { "Gauss-Radau 15 Everhart", 1e-4, 1e-9 }, { "Gauss-Radau 15 Everhart c", 1e-4, 1e-9 } };
    for (int i = 0; i < COUNT(runs); ++i) {
        int failed[2];
        const baseline *b = baseline_named(runs[i].name);
        const double coarse = (double)errors_of(b, runs[i].coarse, failed), fine = (double)errors_of(b, runs[i].fine, failed + 1);
        print_message("    %-26s %.1e, %.1e\n", runs[i].name, coarse, fine);
        assert_true(!failed[0] && !failed[1] && coarse < 1e-2 && coarse > 1e-9 && fine < 1e-10);
    }
}

TEST(pairs_and_gauss_methods_have_their_orders)
{
    ORDER(8, 0.5, "RKN8(6) fixed", "RKN8(6) fixed c", "DOP853 fixed", "DOP853 fixed c", "Gauss 4");
    ORDER(12, 0.8, "RKN12(10) fixed", "RKN12(10) fixed c", "Gauss 6");
    ORDER(4, 0.5, "RK4");
}

/* An error per step of order q, held at the tolerance, and the global one of order p of the solution that is carried on:
   p/q, which is between 1 and 8/7. */
TEST(adaptive_methods_follow_their_tolerance)
{
    ORDER(8/7.0, 0.2, "RKN8(6)", "RKN8(6) c");
    ORDER(12/11.0, 0.2, "RKN12(10)", "RKN12(10) c");
    ORDER(1, 0.2, "DOP853", "DOP853 c");
}

static int tables(void **state)
{
    baselines_begin();
    return 0;
}

RUN_TESTS(tables, NULL)
