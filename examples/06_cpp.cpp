/* 06 - From C++11: the planet of the first example

   The same header.  A description is declared with {} and its fields are set
   one by one, which every C++ accepts; a callback is a lambda without capture;
   the memory is a std::vector.  What a capture would have held goes through the
   user pointer.

   prints

     ok: x = 0.400000000, v = 2.000000000
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <cmath>
#include <cstdio>
#include <vector>

struct sun { double gm; };

int main()
{
    sun centre = { 1.0 };

    gvi_effect attraction = {};
    attraction.kind = GVI_POTENTIAL;
    attraction.user = &centre;
    attraction.points = [](const gvi_points *x, void *user) {
        const double *X = x->q, *Y = X + x->stride, gm = static_cast<sun *>(user)->gm;
        double *fx = x->f, *fy = fx + x->stride;
        for (int k = 0; k < x->count; ++k) {
            double d2 = X[k]*X[k] + Y[k]*Y[k], w = -gm/(d2*std::sqrt(d2));
            fx[k] += w*X[k];
            fy[k] += w*Y[k];
        }
        return 0;
    };

    gvi_desc desc = {};
    desc.n = 2;
    desc.degree = 8;
    desc.effects = &attraction;
    desc.effect_count = 1;

    std::vector<double> memory(gvi_size(&desc)/sizeof(double));
    const double q[] = { 0.4, 0 }, v[] = { 0, 2 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory.data(), memory.size()*sizeof(double));
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 4000 && st.status == GVI_OK; ++k)
        gvi_step(&st, 3.14159265358979323846/20);
    std::printf("%s: x = %.9f, v = %.9f\n", gvi_why(&st), st.q[0], st.p[1]);
}
