/* chapter.c - the chapter of chapter.h has counted what the counters say: steps; evaluations, one in each iteration; stages,
   once in each step that goes by the first attempt */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <stdio.h>

GVI_EACH(attraction, 2, f)
{
    const double d2 = x->q[0]*x->q[0] + x->q[1]*x->q[1], w = -1/(d2*GVI_SQRT(d2));
    x->f[0] += w*x->q[0];
    x->f[1] += w*x->q[1];
}

GVI_EACH(drag, 2, v, f)
{
    x->f[0] -= x->v[0]/100;
    x->f[1] -= x->v[1]/100;
}

static int differs(const gvi_stepper *st, int what, unsigned long long counted)
{
    const double tally = st->in.tally.count[what];
    static const char *const name[] = { "  steps", ", stages", ", evaluations" };
    printf("%s %.0f of %llu", name[what], tally, counted);
    return tally < (double)counted || tally > (double)counted;
}

int main(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction },
                                        { .kind = GVI_FORCE, .points = drag } };
    static const double q[] = { 0.4, 0 }, v[] = { 0, 2 };
    int wrong = 0;
    for (int effects = 1; effects <= 2; ++effects) {          // positions, velocities
        const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = effects };
        gvi_stepper st;
        if (gvi_init(&st, &desc, memory, sizeof memory) != GVI_OK) return 1;
        if (gvi_start(&st, 0, q, v) != GVI_OK) return 1;
        st.counters.effect[0] = 0;                            // without those of the start
        for (int k = 0; k < 1000; ++k)
            if (gvi_step(&st, 0.05) != GVI_OK) return 1;
        wrong |= st.counters.steps != 1000;
        wrong |= differs(&st, GVI__TALLY_STEPS, st.counters.steps);
        wrong |= st.counters.effect[0] != 8*st.counters.iterations;
        wrong |= differs(&st, GVI__TALLY_STAGES, st.counters.steps);
        wrong |= differs(&st, GVI__TALLY_EVALUATIONS, st.counters.iterations);
        printf("\n");
    }
    return wrong;
}
