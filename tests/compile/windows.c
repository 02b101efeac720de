/* A program for Windows: <windows.h> before gvi.h (BEFORE) or after it. */
#ifdef BEFORE
#include <windows.h>
#endif
#define GVI_IMPLEMENTATION
#include "gvi.h"
#ifndef BEFORE
#include <windows.h>
#endif

GVI_EACH(spring, 1, f) { x->f[0] -= x->q[0]; }

int main(void)
{
    static double memory[GVI_LENGTH(1, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    const gvi_desc desc = { .n = 1, .effects = scene, .effect_count = 1 };
    const double q[] = { 1 }, v[] = { 0 };
    LARGE_INTEGER begin, end;
    gvi_stepper st;
    QueryPerformanceCounter(&begin);
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 100 && st.status == GVI_OK; ++k) gvi_step(&st, 3.14159265358979323846/50);
    QueryPerformanceCounter(&end);
    return !(st.status == GVI_OK && st.q[0] > 0.999999 && st.q[0] < 1.000001 && end.QuadPart >= begin.QuadPart);
}
