/* Steps whose last bits, the compensation, a compiler may optimise away: headers.sh compiles it with parts of -ffast-math. */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <stdio.h>

static int spring(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= x->q[k];
    return (void)user, 0;
}

int main(void)
{
    static double memory[GVI_LENGTH(1, 4, 5)];
    static const double m = 3;
    const gvi_effect scene[] = { { .points = spring } };
    for (int kind = 0; kind < 4; ++kind) {
        const gvi_desc desc = { .n = 1, .degree = kind & 1 ? 1 : 4, .effects = scene, .effect_count = 1,
                                .rule = { .kind = kind & 1 ? GVI_LOBATTO : GVI_GAUSS },
                                .mass = { .kind = kind & 2 ? GVI_MASS_DIAGONAL : GVI_MASS_UNIT, .matrix = kind & 2 ? &m : NULL } };
        const double q = 1, v = 0;
        gvi_stepper st;
        gvi_init(&st, &desc, memory, sizeof memory);
        gvi_start(&st, 0, &q, &v);
        for (int k = 0; k < 20000; ++k) gvi_step(&st, 0.1);
        printf("%d %a %a %a %a %a %a\n", st.status, st.t, st.t_low, st.q[0], st.q_low[0], st.p[0], st.p_low[0]);
    }
    return 0;
}
