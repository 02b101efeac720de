/* peers_odeint.cpp - Boost.odeint's Bulirsch-Stoer for peers.c, with the size a constant: the
   fastest state that it can be given is an array.                                             */
#include <boost/array.hpp>
#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <exception>

namespace {

struct gave_up : std::exception {};

typedef void (*rate_fn)(const double *, double *);

template<std::size_t size> struct system_of {
    rate_fn rate;
    const long long *calls;
    long long most_calls;
    void operator()(const boost::array<double, size> &y, boost::array<double, size> &dy, double) const
    {
        if (*calls > most_calls) throw gave_up();
        rate(y.data(), dy.data());
    }
};

template<std::size_t size>
long long run(rate_fn rate, const long long *calls, long long most_calls, double *y, double from, double to,
              double tolerance)
{
    namespace odeint = boost::numeric::odeint;
    typedef boost::array<double, size> state;
    odeint::bulirsch_stoer<state> stepper(tolerance, tolerance);
    system_of<size> f = { rate, calls, most_calls };
    state x;
    std::copy(y, y + size, x.begin());
    long long steps = 0;
    try {
        steps = (long long)odeint::integrate_adaptive(stepper, f, x, from, to, (to - from)*1e-3);
    } catch (const std::exception &) {
        steps = -1;
    }
    std::copy(x.begin(), x.end(), y);
    return steps;
}

}

extern "C" long long odeint_bulirsch_stoer(int size, rate_fn rate, const long long *calls,
                                           long long most_calls, double *y, double from, double to,
                                           double tolerance)
{
    switch (size) {
    case 4:   return run<4>(rate, calls, most_calls, y, from, to, tolerance);
    case 12:  return run<12>(rate, calls, most_calls, y, from, to, tolerance);
    case 36:  return run<36>(rate, calls, most_calls, y, from, to, tolerance);
    case 200: return run<200>(rate, calls, most_calls, y, from, to, tolerance);
    default:  return -1;
    }
}
