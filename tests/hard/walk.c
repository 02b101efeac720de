/* walk.c - the energy error of 10,000 orbits of e = 0.9 by the dial, against Brouwer's law (brouwer.c)

   16 starts, each moved by about 1e-5 of itself: relative energy error, read in long double, after 10,000/64,
   10,000/32, ... 10,000 orbits.  Brouwer's law: EPS sqrt(steps), one independent rounding of the energy in each
   step.  Nothing is symplectic about steps that change: their own error, though near rounding, adds up in the end.
   The exponent in the number of steps is therefore printed without a bound (about 0.7 at dial 1e-15, 0.9 at 1e-14;
   a random walk has 1/2).                                                                                    */
#include "hard.h"
#include "../problems.h"

enum { STARTS = 16, TIMES = 7, ORBITS = 10000 };

static long double energy_of(const gvi_stepper *st)
{
    long double q[2], p[2];
    read_state(st, q, p);
    return (p[0]*p[0] + p[1]*p[1])/2 - 1/sqrtl(q[0]*q[0] + q[1]*q[1]);
}

static void study(real dial)
{
    static const gvi_effect orbit = { .kind = GVI_POTENTIAL, .points = attraction };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = &orbit, .effect_count = 1, .resolution = dial };
    static real memory[GVI_LENGTH(2, 8, 8)];
    double squares[TIMES] = { 0 }, steps[TIMES] = { 0 }, x[TIMES], y[TIMES];
    const real turn = (real)6.283185307179586476925286766559;
    for (int s = 0; s < STARTS; ++s) {
        gvi_stepper st;
        const real q[2] = { (real)(0.1*(1 + 1e-5*uniform())), 0 }, v[2] = { 0, sqrt((real)19) };
        must(gvi_init(&st, &desc, memory, sizeof memory));
        must(gvi_start(&st, 0, q, v));
        const long double E0 = energy_of(&st);
        for (int k = 0; k < TIMES; ++k) {
            const real end = turn*ORBITS/64*(real)(1 << k);
            while (st.t < end) must(gvi_advance(&st, end));
            const double error = (double)(energy_of(&st)/E0 - 1);
            squares[k] += error*error/STARTS;
            steps[k] += (double)st.counters.steps/STARTS;
        }
    }
    printf("dial %.0e\n  orbits  steps      root mean square of dE/E, in EPS; over sqrt(steps)\n", (double)dial);
    for (int k = 0; k < TIMES; ++k) {
        x[k] = log(steps[k]);
        y[k] = log(sqrt(squares[k]));
        const double size = sqrt(squares[k])/(double)EPS;
        printf("  %-6d  %-9.0f  %.3g  %.3g\n", ORBITS/64 << k, steps[k], size, size/sqrt(steps[k]));
    }
    printf("  exponent %.2f\n", slope_of(TIMES, x, y, NULL));
    expect("over Brouwer's law", 0, exp(y[TIMES - 1])/(double)EPS/sqrt(steps[TIMES - 1]), 10);
}

int main(void)
{
    study((real)1e-15);
    study((real)1e-14);
    return verdict("walk");
}
