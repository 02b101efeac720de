/* 44 - C++ callables with a state, and exceptions

   A struct with operator(), or a lambda that captures, cannot be a callback of a C
   library: it is handed over through the user pointer, and a function without a
   state calls it (a trampoline).  No exception may cross the library, which is C:
   the trampoline catches it and returns 1, the step fails and leaves the state as it
   was, and what was caught is thrown again after it.

   A probe falls towards a planet with an atmosphere, given by a table up to 1.5
   radii.  It starts above the table's end, which throws; at 1.4 radii it does not.

   prints

     std::out_of_range: no density at 1.600; t is 0, the table was asked 1 time
     at 1.4 radii: ok, energy lost by drag: yes
     a planet without air: x = 0.400000000, v = 2.000000000
     the same by std::function, one point a call: x = 0.400000000
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/* What the callbacks of one stepper caught. */
class caught {
    std::exception_ptr first;

public:
    template <class F> int guard(F &&call) noexcept
    {
        if (first) return 1;                      // the library tries again: not again
        try {
            call();
            return 0;
        } catch (...) {
            first = std::current_exception();
            return 1;
        }
    }
    void raise()
    {
        std::exception_ptr it;
        std::swap(it, first);
        if (it) std::rethrow_exception(it);
    }
};

/* A callable of a gvi_points, as an effect; it must not move while a stepper uses it. */
template <class F> class callable {
    F f;
    caught &errors;

    static int trampoline(const gvi_points *x, void *user)
    {
        callable &self = *static_cast<callable *>(user);
        return self.errors.guard([&] { self.f(*x); });
    }

public:
    callable(F given, caught &where) : f(std::move(given)), errors(where) {}
    callable(const callable &) = delete;
    callable &operator=(const callable &) = delete;

    gvi_effect effect(gvi_kind kind)
    {
        gvi_effect e = {};
        e.kind = kind;
        e.points = trampoline;
        e.user = this;
        return e;
    }
};

/* The same for one point a call. */
using force = std::function<void(double t, const double *q, const double *v, double *f)>;

static int point_trampoline(double t, const double *q, const double *v, double *f, double *, void *user)
{
    try {
        (*static_cast<const force *>(user))(t, q, v, f);
        return 0;
    } catch (...) {
        return 1;
    }
}

class stepper {
    std::vector<double> memory;
    gvi_stepper st;
    caught &errors;

    void check(gvi_status status)
    {
        errors.raise();
        if (status != GVI_OK) throw std::runtime_error(gvi_why(&st));
    }

public:
    stepper(const gvi_desc &desc, caught &where) : memory(gvi_size(&desc)/sizeof(double)), st(), errors(where)
    {
        check(gvi_init(&st, &desc, memory.data(), memory.size()*sizeof(double)));
    }
    stepper(const stepper &) = delete;            // st.q points into the memory
    stepper &operator=(const stepper &) = delete;

    void start(const double *q, const double *v) { check(gvi_start(&st, 0, q, v)); }
    void step(double h) { check(gvi_step(&st, h)); }
    const gvi_stepper *operator->() const { return &st; }
};

/* Potentials and forces in the plane: a struct with operator(). */
struct attraction {
    double gm;

    void operator()(const gvi_points &x) const
    {
        const double *X = x.q, *Y = X + x.stride;
        double *fx = x.f, *fy = fx + x.stride;
        for (int k = 0; k < x.count; ++k) {
            const double d2 = X[k]*X[k] + Y[k]*Y[k], w = -gm/(d2*std::sqrt(d2));
            fx[k] += w*X[k];
            fy[k] += w*Y[k];
        }
    }
};

struct atmosphere {
    std::vector<double> density;                  // at 1, 1.1, ... 1.5 radii
    int *asked;

    double at(double r) const
    {
        ++*asked;
        const double place = (r - 1)*10;
        if (!(place >= 0 && place < 5)) throw std::out_of_range("no density at " + std::to_string(r).substr(0, 5));
        const std::size_t i = static_cast<std::size_t>(place);
        return density[i] + (place - static_cast<double>(i))*(density[i+1] - density[i]);
    }
    void operator()(const gvi_points &x) const
    {
        const double *X = x.q, *Y = X + x.stride, *U = x.v, *V = U + x.stride;
        for (int k = 0; k < x.count; ++k) {
            const double rho = at(std::hypot(X[k], Y[k])), speed = std::hypot(U[k], V[k]);
            x.f[k] -= rho*speed*U[k];
            x.f[x.stride + k] -= rho*speed*V[k];
        }
    }
};

static gvi_desc plane(const gvi_effect *effects, int count)
{
    gvi_desc desc = {};
    desc.n = 2;
    desc.degree = 8;
    desc.effects = effects;
    desc.effect_count = count;
    return desc;
}

static double energy(const stepper &s)
{
    return (s->p[0]*s->p[0] + s->p[1]*s->p[1])/2 - 1/std::hypot(s->q[0], s->q[1]);
}

int main()
{
    caught errors;
    int asked = 0;
    callable<attraction> gravity({ 1 }, errors);
    callable<atmosphere> air({ { 1e-2, 8e-3, 5e-3, 3e-3, 1e-3, 0 }, &asked }, errors);
    const gvi_effect both[] = { gravity.effect(GVI_POTENTIAL), air.effect(GVI_FORCE) };

    stepper probe(plane(both, 2), errors);
    const double high[] = { 1.6, 0 }, low[] = { 1.4, 0 }, v[] = { 0, 0.8 };
    try {
        probe.start(high, v);
        probe.step(0.01);
    } catch (const std::out_of_range &e) {
        std::printf("std::out_of_range: %s; t is %g, the table was asked %d time\n", e.what(), probe->t, asked);
    }
    probe.start(low, v);
    const double before = energy(probe);
    for (int k = 0; k < 50; ++k) probe.step(0.01);
    std::printf("at 1.4 radii: %s, energy lost by drag: %s\n", gvi_why(probe.operator->()), energy(probe) < before ? "yes" : "no");

    stepper planet(plane(both, 1), errors);
    const double q[] = { 0.4, 0 }, w[] = { 0, 2 };
    planet.start(q, w);
    for (int k = 0; k < 4000; ++k) planet.step(3.14159265358979323846/20);
    std::printf("a planet without air: x = %.9f, v = %.9f\n", planet->q[0], planet->p[1]);

    const double gm = 1;
    force pull = [gm](double, const double *X, const double *, double *f) {
        const double a = -gm/std::pow(std::hypot(X[0], X[1]), 3);
        f[0] += a*X[0];
        f[1] += a*X[1];
    };
    gvi_effect by_point = {};
    by_point.kind = GVI_POTENTIAL;
    by_point.point = point_trampoline;
    by_point.user = &pull;
    stepper again(plane(&by_point, 1), errors);
    again.start(q, w);
    for (int k = 0; k < 4000; ++k) again.step(3.14159265358979323846/20);
    std::printf("the same by std::function, one point a call: x = %.9f\n", again->q[0]);
}
