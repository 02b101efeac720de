/* The promise behind the price list of examples/scenes/price.c: what a scene does not list
   is not asked, not once, takes no byte, and leaves no trace. Instructions are counted by make
   prices; results to the bit and switching are in test_scenes.c. */
#include "gvi_test.h"
#include "scenes/scenes.c"

static scene_setup made;
static gvi_stepper st;

/* In the place of an effect that is not listed: whoever asks it is counted. */
static int asked;

static int trap_points(const gvi_points *x, void *user) { return ++asked, 0; }

static int trap_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                        gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    return ++asked, 0;
}

/* Puts effect e at the end of the array and leaves it out of the count, its callbacks trapped. */
static gvi_effect unlist(int e)
{
    const gvi_effect was = made.effects[e];
    const int last = --made.desc.effect_count;
    if (!last) made.desc.effects = NULL;
    for (int k = e; k < last; ++k) made.effects[k] = made.effects[k+1];
    made.effects[last] = (gvi_effect){ .kind = was.kind, .points = trap_points, .value = trap_points,
                                       .hessian = trap_hessian };
    return was;
}

/* Every scene, every effect: the rest of the scene is all that is asked, in steps
   and in all queries, and it has no counter. */
TEST(unlisted_effects_are_never_asked)
{
    int seen = 0;
    for (int a = 0; a < scene_count; ++a) {
        scene_build(scenes[a], &made, NULL);
        for (int e = 0, all = made.desc.effect_count; e < all; ++e, ++seen) {
            double energy, q[SCENE_MAX], v[SCENE_MAX], action;
            scene_build(scenes[a], &made, NULL);
            unlist(e);
            double *memory = malloc(gvi_size(&made.desc));
            assert_non_null(memory);
            asked = 0;
            assert_ok(gvi_init(&st, &made.desc, memory, gvi_size(&made.desc)));
            assert_ok(gvi_start(&st, 0, made.q, made.v));
            for (int k = 0; k < 20; ++k) assert_ok(gvi_step(&st, scenes[a]->h));
            assert_ok(gvi_energy(&st, &energy));
            assert_ok(gvi_velocity(&st, v));
            assert_ok(gvi_action(&st, &action));
            assert_ok(gvi_curve(&st, 0.3, q, v));
            assert_ok(gvi_state_at(&st, st.t - 0.4*scenes[a]->h, q, v, NULL));
            assert_int_equal(asked, 0);
            for (int k = 0; k < GVI_EFFECTS; ++k)
                assert_true((st.counters.effect[k] > 0) == (k < made.desc.effect_count));
            free(memory);
        }
    }
    assert_int_equal(seen, 35);
}

/* Memory depends on what the list as a whole asks for, not on its length: for every
   scene and effect, leaving it out gives the bytes of a scene with whatever other
   effect of the kinds that are left; and as many as the scene with all of them
   unless the formulation is another, which then is smaller. */
TEST(unlisted_effects_take_no_bytes)
{
    int less = 0;
    for (int a = 0; a < scene_count; ++a) {
        scene_build(scenes[a], &made, NULL);
        const size_t all = gvi_size(&made.desc);
        for (int e = 0, count = made.desc.effect_count; e < count; ++e) {
            scene_build(scenes[a], &made, NULL);
            // what a constraint refuses, Newton's method, has memory without it
            if (unlist(e).kind == GVI_CONSTRAINT) continue;
            const size_t without = gvi_size(&made.desc);
            assert_true(without > 0 && without <= all);
            less += without < all;
            // what is left, each twice: no more
            gvi_effect twice[2*GVI_EFFECTS];
            const int left = made.desc.effect_count;
            if (left == 0 || 2*left > GVI_EFFECTS) continue;
            int rows = 0;                       // twice a constraint is two constraints
            for (int k = 0; k < left; ++k) rows += made.effects[k].rows;
            if (rows > 0) continue;
            for (int k = 0; k < 2*left; ++k) twice[k] = made.effects[k % left];
            made.desc.effects = twice;
            made.desc.effect_count = 2*left;
            assert_true(gvi_size(&made.desc) == without);
        }
    }
    assert_true(less >= 3);
}

RUN_TESTS(NULL, NULL)
