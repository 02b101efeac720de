/* packages.cpp - gvi.h by its dial against integrators as packages have them (make cost-packages)

   GSL's rk8pd (Prince and Dormand, order 8) by its driver, and Boost.Odeint's runge_kutta_fehlberg78 by integrate_adaptive:
   what a user finds first.  All choose their steps; settings are half a decade apart, absolute and relative tolerance being
   the same.  For a wanted error the least time of the settings that reach it, the best of some turns.  The right-hand sides
   are those of `make cost`: the same formulas for all.                                                */
#define GVI_IMPLEMENTATION
extern "C" {
#include "problems.h"
}

#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_version.h>
#include <vector>

namespace odeint = boost::numeric::odeint;

enum { TURNS = 5, WANTED = 3 };

struct run { double ms, error; };
typedef run method(const problem &p, double setting);

static double clock_ms()
{
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e3 + (double)t.tv_nsec*1e-6;
}

/* y = (q, v), or (q, p) where the mass depends on q                                                   */
static void slope(const problem &p, const double *y, double *dy)
{
    if (p.slope) return p.slope(y, dy);
    for (int i = 0; i < p.n; ++i) dy[i] = y[p.n + i];
    p.acceleration(y, dy + p.n);
}

static std::vector<double> start(const problem &p)
{
    std::vector<double> y(p.q, p.q + p.n);
    y.insert(y.end(), p.v, p.v + p.n);
    return y;
}

static run by_dial(const problem &p, double dial)
{
    static double memory[100000];
    gvi_desc desc = {};
    gvi_stepper st;
    desc.n = p.n;
    desc.degree = 8;
    desc.mass = p.mass;
    desc.effects = p.effects;
    desc.effect_count = p.effect_count;
    desc.formulation = p.slope ? GVI_MOMENTA : GVI_POSITIONS;
    desc.resolution = dial;
    if (gvi_init(&st, &desc, memory, sizeof memory)) std::exit(1);
    if (p.slope ? gvi_start_momentum(&st, 0, p.q, p.v) : gvi_start(&st, 0, p.q, p.v)) std::exit(1);

    const double began = clock_ms();
    while (st.t < p.end && gvi_advance(&st, p.end) == GVI_OK) continue;
    const double ms = clock_ms() - began;
    return { ms, st.status == GVI_OK ? problem_error(&p, st.q) : HUGE_VAL };
}

static int gsl_slope(double, const double *y, double *dy, void *user)
{
    slope(*static_cast<const problem *>(user), y, dy);
    return GSL_SUCCESS;
}

static run by_gsl(const problem &p, double tolerance)
{
    gsl_odeiv2_system system = { gsl_slope, nullptr, (size_t)(2*p.n), const_cast<problem *>(&p) };
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, p.end*1e-6, tolerance, tolerance);
    std::vector<double> y = start(p);
    double t = 0;

    const double began = clock_ms();
    const int status = gsl_odeiv2_driver_apply(driver, &t, p.end, y.data());
    const double ms = clock_ms() - began;
    gsl_odeiv2_driver_free(driver);
    return { ms, status == GSL_SUCCESS ? problem_error(&p, y.data()) : HUGE_VAL };
}

static run by_boost(const problem &p, double tolerance)
{
    typedef std::vector<double> state;
    state y = start(p);
    const auto rhs = [&p](const state &x, state &dx, double) { slope(p, x.data(), dx.data()); };

    const double began = clock_ms();
    odeint::integrate_adaptive(
        odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<state>()), rhs, y, 0.0, p.end,
        p.end*1e-6);
    return { clock_ms() - began, problem_error(&p, y.data()) };
}

static void least(method *by, const problem &p, const double *wanted, double *ms)
{
    for (int w = 0; w < WANTED; ++w) ms[w] = HUGE_VAL;
    for (double setting = 1e-3; setting > 3e-15; setting *= std::sqrt(0.1)) {
        run best = by(p, setting);
        for (int k = 1; k < TURNS; ++k) best.ms = std::fmin(best.ms, by(p, setting).ms);
        for (int w = 0; w < WANTED; ++w)
            if (best.error <= wanted[w]) ms[w] = std::fmin(ms[w], best.ms);
    }
}

static void put(FILE *f, const double *ms, const double *unit)
{
    for (int w = 0; w < WANTED; ++w) {
        const double x = unit ? ms[w]/unit[w] : ms[w];
        if (x < HUGE_VAL) std::fprintf(f, "%s%.2g", w ? "; " : " ", x);
        else std::fprintf(f, "%s-", w ? "; " : " ");
    }
    std::fputs(" |", f);
}

int main(int argc, char **argv)
{
    static const char *const keys[] = { "P1", "P2", "P3", "P4", "P5", "P9", "P13" };
    static const double wanted[WANTED] = { 1e-4, 1e-7, 1e-10 };
    FILE *out = argc > 1 ? std::fopen(argv[1], "w") : nullptr;
    if (!out) return std::fprintf(stderr, "packages TABLE: the file for the table\n"), 1;
    gsl_set_error_handler_off();
    problems_begin();

    std::fprintf(out, "| time to 1e-4; 1e-7; 1e-10 | by the dial, ms | GSL %s, rk8pd | Boost %d.%d, rkf78 |\n|---|---|---|---|\n",
                 GSL_VERSION, BOOST_VERSION/100000, BOOST_VERSION/100%1000);
    for (const char *key : keys) {
        const problem &p = *problem_named(key);
        double own[WANTED], gsl[WANTED], boost[WANTED];
        least(by_dial, p, wanted, own);
        least(by_gsl, p, wanted, gsl);
        least(by_boost, p, wanted, boost);
        std::fprintf(out, "| %s |", p.key);
        put(out, own, nullptr);
        put(out, gsl, own);
        put(out, boost, own);
        std::fputs("\n", out);
        std::fflush(out);
    }
    return std::fclose(out);
}
