/* 01 - A planet on an ellipse of eccentricity 0.6, for 159 revolutions

   The shortest complete program: one effect, its force at all points of a step
   at once; a description that names n, the degree and the effects; an array on
   which everything stands; 10000 steps, 63 a revolution.

   prints

     ok: q = -0.602737580 0.799997002
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <stdio.h>

GVI_EACH(attraction, 2, f)
{
    double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2));
    x->f[0] += w*X;  x->f[1] += w*Y;
}

int main(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 };
    const double q[] = { 0.4, 0 }, v[] = { 0, 2 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 10000 && st.status == GVI_OK; ++k)
        gvi_step(&st, 0.1);
    printf("%s: q = %.9f %.9f\n", gvi_why(&st), st.q[0], st.q[1]);
}
