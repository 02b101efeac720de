/* 16 - What a tolerance buys, and costs

   The same orbit three times: iterated to round-off, the default, and with two
   tolerances.  A tolerance saves iterations; what it leaves out is not symplectic,
   and shows as a drift of the energy over 1000 revolutions.

   prints

     tolerance 0      iterations a step below 5   energy error below 1e-12
     tolerance 1e-10  iterations a step below 3   energy error below 1e-06
     tolerance 1e-08  iterations a step below 3   energy error below 1e-05
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

/* Force and potential: what is not wanted is not computed.                    */
GVI_EACH(attraction, 2, f, value)
{
    double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, d = GVI_SQRT(d2);
    x->value[0] -= 1/d;
    x->f[0] -= X/(d2*d);
    x->f[1] -= Y/(d2*d);
}

int main(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    static const double tolerance[] = { 0, 1e-10, 1e-8 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction } };
    for (int i = 0; i < 3; ++i) {
        const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1, .tolerance = tolerance[i] };
        double e0 = 0, e = 0;
        gvi_stepper st;
        gvi_init(&st, &desc, memory, sizeof memory);
        gvi_start(&st, 0, (double[]){ 0.4, 0 }, (double[]){ 0, 2 });
        gvi_energy(&st, &e0);
        for (int k = 0; k < 24000 && st.status == GVI_OK; ++k) gvi_step(&st, 3.14159265358979323846/12);
        if (st.status != GVI_OK || gvi_energy(&st, &e)) return puts(gvi_why(&st)), 1;
        printf("tolerance %-6g iterations a step below %.0f   energy error below %.0e\n", tolerance[i],
               ceil((double)st.counters.iterations/24000), pow(10, ceil(log10(fmax(fabs((e - e0)/e0), 2e-13)))));
    }
    return 0;
}
