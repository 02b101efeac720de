/* test_why.c - what went wrong, in one sentence: gvi_why for each status and cause; a force that is infinite where
   a step starts; two slips that are found at the first start; GVI_EACH.  In all types. */
#include "gvi_test.h"

static real memory[6000];
static int calls;                                      /* of the callbacks below */

/* sound: a spring, and a sheet that drags along x; each counted */
AT_POINTS(spring)
{
    ++calls;
    FOR_EACH(x, a) if (x->f) x->f[a] -= x->q[a];
    for (int k = 0; x->value && k < x->count; ++k)
        for (int i = 0; i < x->n; ++i) x->value[k] += x->q[i*x->stride + k]*x->q[i*x->stride + k]/2;
    return 0;
}
AT_EACH(drag) { x->f[a] -= x->v[a]/8; }
AT_EACH(magnet) { x->dldv[a] += x->q[a]/4, x->f[a] += x->v[a]/4; }
AT_POINTS(nothing) { return 0; }
AT_POINT(nothing_at) { return 0; }
static int refuses_hessian(real t, const real *q, const real *v, real *fq, real *fv, real *pv, void *user) { return 1; }
AT_POINTS(refuses) { return 1; }
AT_EACH(turns_to_nan) { x->f[a] += x->t[0] > 0 ? (real)NAN : 0; }
AT_EACH(inverse_cube)                                /* -1/q^3, infinite at 0 */
{
    if (x->f) x->f[a] -= 1/(x->q[a]*x->q[a]*x->q[a]);
}
AT_POINTS(clock_1) { for (int k = 0; k < x->count; ++k) x->value[k] += *(real *)user; return 0; }
AT_POINTS(timed)
{
    FOR_EACH(x, a) if (x->f) x->f[a] += 1;
    for (int k = 0; x->value && k < x->count; ++k) x->value[k] -= x->q[k]*x->t[k];
    return 0;
}
AT_POINTS(wall)                                        /* the row twice, or none, as user says */
{
    const int rows = *(int *)user;
    for (int k = 0; k < x->count; ++k)
        for (int r = 0; r < rows; ++r) x->g[r*x->stride + k] = x->q[k] - 1, x->jacobian[r*2*x->stride + k] = 1;
    return 0;
}
AT_POINTS(without_gradient) { for (int k = 0; k < x->count; ++k) x->g[k] = 0; return 0; }
AT_POINTS(velocity_nan) { FOR_EACH(x, a) x->velocity[a] = x->q[a] > (real)0.75L ? (real)NAN : x->p[a]; return 0; }
AT_POINT(light) { return dldv[0] += v[0]/1024, 0; }
AT_POINT(jumps) { return dldv[0] += v[0] + (v[0] > 1 ? 2 : 0), 0; }             /* never 2 */
AT_POINTS(massless) { FOR_EACH(x, a) x->velocity[a] = 0; return 1; }
AT_POINTS(no_mass) { for (int k = 0; k < x->count; ++k) x->mass[k] = 0; return 0; }
AT_POINTS(mass_nan) { for (int k = 0; k < x->count; ++k) x->mass[k] = (real)NAN; return 0; }

/* M(q), and what the force needs of it: at the same points it is called next */
static real weight_there[64];
AT_POINTS(mass_and_weight)
{
    for (int k = 0; k < x->count; ++k) {
        x->mass[k] = 2 + x->q[k]*x->q[k];
        weight_there[k] = x->q[k];
    }
    return 0;
}
AT_POINTS(mass_gradient) { for (int k = 0; k < x->count; ++k) x->f[k] += x->q[k]*x->v[k]*x->v[k]; return 0; }
AT_POINTS(weight) { for (int k = 0; k < x->count; ++k) x->f[k] -= weight_there[k]; return 0; }

/* slips */
AT_POINTS(first_alone) { x->f[0] -= 1 + x->q[0]; return 0; }
AT_POINTS(first_alone_of_v) { x->f[0] -= x->v[0]; return 0; }
AT_EACH(sets) { x->f[a] = -x->q[a]; }
AT_EACH(sets_of_v) { x->f[a] = -x->v[a]; }
AT_EACH(sets_dldv) { x->dldv[a] = x->q[a]/4, x->f[a] += x->v[a]/4; }

static void says(const gvi_stepper *st, gvi_status status, const char *words)
{
    assert_int_equal(st->status, status);
    assert_non_null(strstr(gvi_why(st), words));
}

static gvi_desc scene_of(const gvi_effect *effects, int count)
{
    return (gvi_desc){ .n = 1, .degree = 3, .effects = effects, .effect_count = count };
}

TEST(a_stepper_that_is_not_ready_says_what_comes_first)
{
    static const gvi_effect e[] = { { .points = spring, .value = spring } };
    static gvi_stepper st;                             // zero
    const gvi_desc d = scene_of(e, 1);
    real x[3] = { 1, 1, 1 };
    for (int k = 0; k < 8; ++k) {
        memset(&st, 0, sizeof st);
        assert_string_equal(gvi_why(&st), "ok");
        assert_string_equal(gvi_formulation_text(&st), "not set up");
        switch (k) {
        case 0: gvi_start(&st, 0, x, x); break;
        case 1: gvi_step(&st, 1); break;
        case 2: gvi_energy(&st, x); break;
        case 3: gvi_switch(&st, 0, 0); break;
        case 4: gvi_curve(&st, 0, x, x); break;
        case 5: gvi_state_at(&st, 0, x, x, x); break;
        case 6: gvi_discrete_lagrangian(&st, 0, 1, x, x, &(gvi_discrete){ .p0 = x }); break;
        default: gvi_restore(&st, &st, memory); break;
        }
        says(&st, GVI_E_STATE, "not initialised");
        assert_int_equal(st.fault.effect, GVI_FAULT_NONE);
        assert_int_equal(st.fault.coordinate, GVI_FAULT_NONE);
        assert_int_equal(st.fault.point, GVI_FAULT_NONE);
    }
    st = new_stepper(&d);
    assert_status(gvi_step(&st, 1), GVI_E_STATE);
    says(&st, GVI_E_STATE, "not started");
    st = new_stepper(&d);
    assert_ok(gvi_start(&st, 0, x, x));
    assert_status(gvi_curve(&st, 0, x, x), GVI_E_STATE);
    says(&st, GVI_E_STATE, "no step yet");
    assert_ok(gvi_step(&st, (real)0.25));
    assert_status(gvi_state_at(&st, 9, x, x, x), GVI_E_STATE);
    says(&st, GVI_E_STATE, "outside the last step");
    assert_ok(gvi_step(&st, (real)0.25));
    assert_string_equal(gvi_why(&st), "ok");
    assert_null(st.fault.argument);
    assert_string_equal(gvi_formulation_text(NULL), "no stepper");
    assert_string_equal(gvi_why(NULL), "the stepper is NULL");
    assert_true(gvi_stepper_size() == sizeof st);
}

/* Descriptions that gvi_init refuses: each cause its own sentence */
TEST(each_refused_description_has_its_sentence)
{
    static int rows = 1;
    static real one = 1, half[2] = { 0.5L, 0.5L }, ends[2] = { 0, 1 }, twos[2] = { 1, 1 }, far[2] = { 0, 2 };
    static const real mid[3] = { 0.25L, 0.5L, 0.75L }, even[3] = { 1/(real)3, 1/(real)3, 1/(real)3 };
    static const gvi_effect e[] = { { .points = spring, .value = spring } },
        reads[] = { { .kind = GVI_FORCE, .points = drag } }, term[] = { { .kind = GVI_LAGRANGIAN, .points = nothing } },
        clock[] = { { .points = spring, .value = spring }, { .kind = GVI_CLOCK, .points = clock_1, .user = &one } },
        held[] = { { .kind = GVI_CONSTRAINT, .points = wall, .rows = 1, .user = &rows } },
        crowd[] = { { .kind = GVI_CONSTRAINT, .points = wall, .rows = 16384, .user = &rows } };
    /* Gauss's three points and two that say nothing, or next to nothing */
    static const real five[] = { (real)0.112701665379258311482L, 0.5L, (real)0.887298334620741688518L, 0.25L, 0.75L },
        three[] = { 5/(real)18, 4/(real)9, 5/(real)18, 0, 0 }, faint[] = { 5/(real)18, 4/(real)9, 5/(real)18, EPS, EPS };
    static const real not_finite[4] = { 1, 0, (real)NAN, 1 };
    static const gvi_effect slips[][2] = {
        { { .points = spring }, { .kind = GVI_FORCE } }, { { .points = spring }, { .kind = (gvi_kind)9, .points = nothing } },
        { { .points = spring }, { .kind = GVI_FORCE, .points = nothing, .point = nothing_at } },
        { { .kind = GVI_CLOCK, .points = nothing }, { .kind = GVI_CLOCK, .points = nothing } },
        { { .points = spring }, { .kind = GVI_CLOCK, .point = nothing_at } } };
    static const struct { gvi_desc d; size_t size; gvi_status status; const char *words; } cases[] = {
        { { .n = 1, .effects = e, .effect_count = 1 }, 8, GVI_E_MEMORY, "gvi_size(desc)" },
        { { .n = 1, .degree = 2000 }, 1, GVI_E_ARGUMENT, "degree is not 0 to 1024" },
        { { .n = 524288 }, 1, GVI_E_ARGUMENT, "n is not 1 to 524,287" },
        { { .n = 1, .rule = { .points = 4001 } }, 1, GVI_E_ARGUMENT, "rule.points is not 0 to 4000" },
        { { .n = 32768, .formulation = GVI_NEWTON }, 1, GVI_E_ARGUMENT, "n is above 32,767" },
        { { .n = 32768, .mass = { .kind = GVI_MASS_DENSE, .matrix = ends } }, 1, GVI_E_ARGUMENT, "n is above 32,767" },
        { { .n = 524287 }, 1, GVI_E_MEMORY, "gvi_size(desc)" },
        { { .n = 1, .degree = 1, .rule = { .points = 4000 } }, 1, GVI_E_MEMORY, "gvi_size(desc)" },
        { { .n = 32767, .formulation = GVI_NEWTON }, 1, GVI_E_MEMORY, "gvi_size(desc)" },
        { { .n = 32767, .mass = { .kind = GVI_MASS_DENSE, .matrix = ends } }, 1, GVI_E_MEMORY, "gvi_size(desc)" },
        { { .n = 1, .degree = 2, .rule = { GVI_OWN, 2, far, half } }, 1, GVI_E_NODES, "in [0,1]" },
        { { .n = 1, .degree = 2, .rule = { GVI_OWN, 2, ends, twos } }, 1, GVI_E_ORDER, "do not sum to 1" },
        { { .n = 1, .degree = 3, .rule = { GVI_OWN, 3, mid, even } }, 1, GVI_E_ORDER, "below the degree" },
        { { .n = 1, .rule = { GVI_KICKS, 2, ends, twos } }, 1, GVI_E_ORDER, "do not sum to 1" },
        { { .n = 1, .degree = 3, .rule = { .points = 2 } }, 1, GVI_E_POINTS, "fewer points than the degree" },
        { { .n = 1, .degree = 5, .rule = { GVI_OWN, 5, five, three } }, 1, GVI_E_POINTS, "does not see every mode" },
        { { .n = 1, .degree = 5, .rule = { GVI_OWN, 5, five, faint } }, 1, GVI_E_POINTS, "does not see every mode" },
        { { .n = 16384, .effects = crowd, .effect_count = 1 }, 1, GVI_E_ARGUMENT, "too large together" },
        { { .n = 1, .effects = reads, .effect_count = 1, .formulation = GVI_POSITIONS }, 1, GVI_E_FORMULATION,
          "pinned formulation" },
        { { .n = 1, .effects = term, .effect_count = 1, .formulation = GVI_VELOCITIES }, 1, GVI_E_FORMULATION,
          "GVI_MOMENTA does" },
        { { .n = 1, .effects = reads, .effect_count = 1, .rule = { GVI_KICKS, 2, ends, half } }, 1, GVI_E_FORMULATION,
          "kicks are for" },
        { { .n = 1, .effects = clock, .effect_count = 2, .degree = 2, .rule = { .points = 3 } }, 1, GVI_E_FORMULATION,
          "a clock needs r = s" },
        { { .n = 1, .formulation = GVI_NEWTON, .iterations = 3 }, 1, GVI_E_FORMULATION, "iterations is given" },
        { { .n = 1, .effects = held, .effect_count = 1, .rule = { GVI_KICKS, 2, ends, half } }, 1, GVI_E_FORMULATION, "constraints go with" },
        { { .n = 1, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = ends } }, 1, GVI_E_SINGULAR, "has no mass" },
        { { .n = 0 }, 1, GVI_E_ARGUMENT, "n is not 1 to 524,287" },
        { { .n = -1 }, 1, GVI_E_ARGUMENT, "n is not 1 to 524,287" },
        { { .n = 1, .degree = -1 }, 1, GVI_E_ARGUMENT, "degree is not 0 to 1024" },
        { { .n = 1, .rule = { .points = -1 } }, 1, GVI_E_ARGUMENT, "rule.points is not 0 to 4000" },
        { { .n = 1, .rule = { .kind = (gvi_rule_kind)7 } }, 1, GVI_E_ARGUMENT, "rule.kind is not in its enum" },
        { { .n = 1, .rule = { .kind = GVI_OWN, .points = 8 } }, 1, GVI_E_ARGUMENT, "rule: this kind needs points, nodes and weights" },
        { { .n = 1, .rule = { .kind = GVI_OWN, .points = 2, .nodes = ends } }, 1, GVI_E_ARGUMENT, "rule: this kind needs points, nodes and weights" },
        { { .n = 1, .degree = 1, .rule = { .kind = GVI_LOBATTO, .points = 1 } }, 1, GVI_E_ARGUMENT, "Lobatto's rule has 2 or more" },
        { { .n = 1, .rule = { .points = 8, .nodes = ends, .weights = half } }, 1, GVI_E_ARGUMENT, "rule: this kind takes no nodes" },
        { { .n = 1, .effects = e, .effect_count = -1 }, 1, GVI_E_ARGUMENT, "effect_count is not 0 to GVI_EFFECTS" },
        { { .n = 1, .effects = e, .effect_count = GVI_EFFECTS + 1 }, 1, GVI_E_ARGUMENT, "effect_count is not 0 to GVI_EFFECTS" },
        { { .n = 1, .effect_count = 1 }, 1, GVI_E_ARGUMENT, "effects is NULL" },
        { { .n = 1, .effects = e }, 1, GVI_E_ARGUMENT, "effect_count is 0" },
        { { .n = 1, .max_iterations = -1 }, 1, GVI_E_ARGUMENT, "max_iterations is not" },
        { { .n = 1, .tries = 65 }, 1, GVI_E_ARGUMENT, "tries is not" },
        { { .n = 1, .iterations = -1 }, 1, GVI_E_ARGUMENT, "iterations is not" },
        { { .n = 1, .iterations = 1000001 }, 1, GVI_E_ARGUMENT, "iterations is not" },
        { { .n = 1, .formulation = (gvi_formulation)9 }, 1, GVI_E_ARGUMENT, "formulation is not in its enum" },
        { { .n = 1, .tolerance = -1 }, 1, GVI_E_ARGUMENT, "tolerance is not 0 to 1" },
        { { .n = 1, .tolerance = 1 }, 1, GVI_E_ARGUMENT, "tolerance is not 0 to 1" },
        { { .n = 1, .tolerance = (real)NAN }, 1, GVI_E_ARGUMENT, "tolerance is not 0 to 1" },
        { { .n = 1, .mass = { .kind = (gvi_mass_kind)9 } }, 1, GVI_E_ARGUMENT, "mass.kind is not in its enum" },
        { { .n = 1, .mass = { .matrix = ends } }, 1, GVI_E_ARGUMENT, "mass: matrix or points is given" },
        { { .n = 1, .mass = { .points = no_mass, .gradient = nothing } }, 1, GVI_E_ARGUMENT, "mass: matrix or points is given" },
        { { .n = 1, .mass = { .kind = GVI_MASS_POSITION } }, 1, GVI_E_ARGUMENT, "mass: points is missing" },
        { { .n = 1, .mass = { .kind = GVI_MASS_POSITION, .points = no_mass } }, 1, GVI_E_ARGUMENT, "mass: gradient is missing" },
        { { .n = 1, .mass = { .kind = GVI_MASS_NONE } }, 1, GVI_E_ARGUMENT, "mass: none, and no Lagrangian term" },
        { { .n = 1, .mass = { .kind = GVI_MASS_DENSE } }, 1, GVI_E_ARGUMENT, "mass: matrix is missing" },
        { { .n = 1, .mass = { .kind = GVI_MASS_DIAGONAL } }, 1, GVI_E_ARGUMENT, "mass: matrix is missing" },
        { { .n = 2, .mass = { .kind = GVI_MASS_DENSE, .matrix = not_finite } }, 1, GVI_E_ARGUMENT, "mass.matrix is not finite" },
        { { .n = 1, .effects = slips[0], .effect_count = 2 }, 1, GVI_E_ARGUMENT, "effect: points, or point, is missing" },
        { { .n = 1, .effects = slips[1], .effect_count = 2 }, 1, GVI_E_ARGUMENT, "effect: kind is not in its enum" },
        { { .n = 1, .effects = slips[2], .effect_count = 2 }, 1, GVI_E_ARGUMENT, "effect: points and point, one is too many" },
        { { .n = 1, .effects = slips[3], .effect_count = 2 }, 1, GVI_E_ARGUMENT, "effect: a second clock" },
        { { .n = 1, .effects = slips[4], .effect_count = 2 }, 1, GVI_E_ARGUMENT, "effect: this kind needs points, not point" },
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        gvi_stepper st;
        gvi_init(&st, &cases[k].d, memory, cases[k].size == 1 ? sizeof memory : cases[k].size);
        says(&st, cases[k].status, cases[k].words);
        if (cases[k].status != GVI_E_ARGUMENT) continue;
        if (!strncmp(cases[k].words, "effect: ", 8)) assert_int_equal(st.fault.effect, 1);
        else if (!strncmp(cases[k].words, "mass", 4) && !strstr(cases[k].words, "kind is not")) assert_int_equal(st.fault.effect, GVI_FAULT_MASS);
        else assert_int_equal(st.fault.effect, GVI_FAULT_NONE);
        if (strstr(cases[k].words, "finite")) continue;                      /* gvi_init's to read */
        assert_int_equal(gvi_size(&cases[k].d), 0);
    }
}

/* Calls that fail, after a good start; 0 is `before` the start already */
TEST(each_call_that_fails_has_its_sentence)
{
    static int one_row = 1;
    static real one = 1, minus = -1;
    static const real ends[2] = { 0, 1 }, half[2] = { 0.5L, 0.5L };
    static const gvi_effect e[] = { { .points = spring }, { .points = refuses } },
        bad[] = { { .points = spring }, { .points = turns_to_nan } }, flawed[] = { { .points = spring, .hessian = refuses_hessian } },
        slow[] = { { .points = spring, .value = spring }, { .kind = GVI_CLOCK, .points = clock_1, .user = &one } },
        back[] = { { .points = spring, .value = spring }, { .kind = GVI_CLOCK, .points = clock_1, .user = &minus } },
        late[] = { { .points = timed, .value = timed }, { .kind = GVI_CLOCK, .points = clock_1, .user = &one } },
        flat[] = { { .points = spring }, { .kind = GVI_CONSTRAINT, .points = without_gradient, .rows = 1 } },
        slight[] = { { .kind = GVI_LAGRANGIAN, .point = light } },
        jumpy[] = { { .kind = GVI_LAGRANGIAN, .point = jumps } },
        held[] = { { .points = spring }, { .kind = GVI_CONSTRAINT, .points = wall, .rows = 1, .user = &one_row } };
    const real q[2] = { 0.5L, 0 }, on[2] = { 1, 0 }, v[2] = { 0, 0 }, two[2] = { 2, 0 }, most[2] = { MAX, 0 };
    real E;
    gvi_stepper st;
#define SET_UP(list, count, coordinates, s, ...) do { const gvi_desc d_ = { .n = coordinates, .degree = s, \
        .effects = list, .effect_count = count, __VA_ARGS__ }; st = new_stepper(&d_); } while (0)
#define BEGIN(...) do { SET_UP(__VA_ARGS__); assert_ok(gvi_start(&st, 0, q, v)); } while (0)
    SET_UP(e, 2, 1, 3, .tolerance = 0);                    // told by a first start; after it, by the step
    gvi_start(&st, 0, q, v);
    says(&st, GVI_E_CALLBACK, "an effect (fault.effect) did not return 0");
    assert_int_equal(st.fault.effect, 1);
    assert_ok(gvi_switch(&st, 1, 0));
    assert_ok(gvi_start(&st, 0, q, v));
    assert_ok(gvi_switch(&st, 1, 1));
    gvi_step(&st, 1);
    for (int k = 0; k < 2; ++k) {                          // a query that succeeds does not hide it
        says(&st, GVI_E_CALLBACK, "an effect (fault.effect) did not return 0");
        assert_int_equal(st.fault.effect, 1);
        assert_ok(gvi_velocity(&st, &E));
    }
    BEGIN(flawed, 1, 1, 3, .formulation = GVI_NEWTON);
    gvi_step(&st, (real)0.25);
    says(&st, GVI_E_CALLBACK, "an effect (fault.effect) did not return 0");
    BEGIN(e, 1, 1, 20, .tolerance = 0);
    gvi_energy(&st, &E);
    says(&st, GVI_E_VALUE, "no value callback");
    gvi_step(&st, 0);
    says(&st, GVI_E_ARGUMENT, "h is 0");
    gvi_discrete_lagrangian(&st, 0, (real)3.14159265358979323846264L, v, v, &(gvi_discrete){ .lagrangian = NULL });
    says(&st, GVI_E_CONJUGATE, "conjugate");
    BEGIN(e, 1, 1, 3, .formulation = GVI_POSITIONS);
    gvi_discrete_lagrangian(&st, 0, 1, q, v, &(gvi_discrete){ .lagrangian = NULL });
    says(&st, GVI_E_FORMULATION, "needs GVI_NEWTON");
    assert_string_equal(gvi_formulation_text(&st), "pinned by the description");
    SET_UP(NULL, 0, 1, 3, .tolerance = 0);
    assert_ok(gvi_start(&st, MAX, q, v));
    gvi_step(&st, MAX);
    says(&st, GVI_E_ARGUMENT, "t + h is not finite");
    BEGIN(e, 1, 1, 3, .resolution = (real)1e-6L);
    gvi_step(&st, 1);
    says(&st, GVI_E_RESOLUTION, "not as accurate as desc.resolution");
    BEGIN(e, 1, 1, 3, .iterations = 4);
    gvi_step(&st, 6);
    says(&st, GVI_E_CONVERGENCE, "desc.iterations");
    BEGIN(bad, 2, 1, 3, .tolerance = 0);
    gvi_step(&st, 1);
    says(&st, GVI_E_NON_FINITE, "gave NaN or Inf");
    assert_int_equal(st.fault.effect, 1);
    BEGIN(e, 1, 1, 3, .formulation = GVI_POSITIONS);
    gvi_step(&st, 30);
    says(&st, GVI_E_CONVERGENCE, "no solution found: halve h");
    BEGIN(slow, 2, 1, 3, .tolerance = 0);
    assert_ok(gvi_step(&st, (real)0.25));
    gvi_action(&st, &E);
    says(&st, GVI_E_FORMULATION, "clocks no action");
    BEGIN(back, 2, 1, 3, .tolerance = 0);
    gvi_step(&st, (real)0.25);
    says(&st, GVI_E_CLOCK, "must be positive");
    SET_UP(late, 2, 1, 3, .tolerance = 0);
    gvi_start(&st, 0, q, v);
    says(&st, GVI_E_FORMULATION, "list it as a force");
    BEGIN(e, 1, 1, 1, .rule = { GVI_KICKS, 2, ends, half });
    assert_ok(gvi_step(&st, (real)0.25));
    gvi_curve(&st, 0, &E, NULL);
    says(&st, GVI_E_FORMULATION, "kicks have no curve");
    SET_UP(held, 2, 2, 3, .tolerance = 0);
    gvi_start(&st, 0, q, v);
    says(&st, GVI_E_CONSTRAINT, "not on a constraint");
    SET_UP(flat, 2, 2, 3, .tolerance = 0);
    gvi_start(&st, 0, on, v);
    says(&st, GVI_E_SINGULAR, "has no gradient");
    BEGIN(e, 1, 1, 3, .mass = { .kind = GVI_MASS_POSITION, .points = no_mass, .gradient = nothing });
    gvi_step(&st, 1);
    says(&st, GVI_E_SINGULAR, "has no mass");
    SET_UP(e, 1, 1, 3, .mass = { .kind = GVI_MASS_POSITION, .points = refuses, .gradient = nothing });
    gvi_start(&st, 0, q, v);
    says(&st, GVI_E_CALLBACK, "of the mass did not return 0");
    SET_UP(e, 1, 1, 3, .mass = { .kind = GVI_MASS_POSITION, .points = mass_nan, .gradient = nothing });
    gvi_start(&st, 0, q, v);
    says(&st, GVI_E_NON_FINITE, "of the mass gave NaN");
    for (int k = 0; k < 2; ++k) {                          // the first coordinate, be it of q or of v
        real none[2][2] = { { 0 }, { 0 } };
        none[k][0] = none[1 - k][1] = (real)NAN;
        SET_UP(e, 1, 2, 3, .tolerance = 0);
        gvi_start(&st, 0, none[0], none[1]);
        says(&st, GVI_E_ARGUMENT, "q, v or p is not finite");
        assert_int_equal(st.fault.coordinate, 0);
    }
    SET_UP(jumpy, 1, 1, 3, .mass = { .kind = GVI_MASS_NONE });
    if (gvi_start_momentum(&st, 0, q, two) == GVI_OK) gvi_velocity(&st, &E);
    says(&st, GVI_E_CONVERGENCE, "no velocity found");
    SET_UP(slight, 1, 1, 3, .mass = { .kind = GVI_MASS_NONE });
    if (gvi_start_momentum(&st, 0, q, most) == GVI_OK) gvi_velocity(&st, &E);
    says(&st, GVI_E_CONVERGENCE, "no velocity found");
    SET_UP(e, 1, 1, 3, .formulation = GVI_MOMENTA, .mass = { .velocity = velocity_nan });
    assert_ok(gvi_start_momentum(&st, 0, q, on));
    gvi_step(&st, 1);
    says(&st, GVI_E_NON_FINITE, "of the mass gave NaN");
    SET_UP(e, 1, 1, 3, .mass = { .velocity = massless });
    gvi_start_momentum(&st, 0, q, on);
    says(&st, GVI_E_CALLBACK, "of the mass did not return 0");
}

/* A step from where the force is infinite: told as such, at rest or not, in every formulation; not where it is finite */
TEST(a_force_that_is_infinite_at_the_start_is_told)
{
    static const gvi_effect e[] = { { .points = spring }, { .points = inverse_cube }, { .kind = GVI_FORCE, .points = drag } };
    for (int f = GVI_AUTO; f <= GVI_NEWTON; ++f)
        for (int moving = 0; moving < 2; ++moving) {
            const real q[2] = { 1, 0 }, near[2] = { 1, (real)1e-3 }, v[2] = { 0, (real)moving };
            gvi_desc d = { .n = 2, .degree = 3, .effects = e, .effect_count = f == GVI_VELOCITIES ? 3 : 2,
                           .formulation = (gvi_formulation)f };
            if (f == GVI_EXPLICIT) d.degree = 1, d.rule.kind = GVI_LOBATTO;
            gvi_stepper st = new_stepper(&d);
            gvi_start(&st, 0, q, v);                       // by a first start, and by the step after another
            says(&st, GVI_E_NON_FINITE, "where the step starts");
            assert_int_equal(st.fault.effect, 1);
            assert_int_equal(st.fault.coordinate, 1);
            assert_ok(gvi_start(&st, 0, near, v));
            assert_ok(gvi_start(&st, 0, q, v));
            SAME_STATE(&st) gvi_step(&st, (real)0.1);
            says(&st, GVI_E_NON_FINITE, "where the step starts");
            assert_int_equal(st.fault.effect, 1);
            assert_int_equal(st.fault.coordinate, 1);
            assert_int_equal(st.fault.point, GVI_FAULT_NONE);
            assert_int_equal(st.counters.failures, 1);
            assert_ok(gvi_start(&st, 0, near, v));
            if (f != GVI_EXPLICIT) {                       // which is content with anything finite
                assert_true(gvi_step(&st, (real)0.1) != GVI_OK);
                assert_null(strstr(gvi_why(&st), "where the step starts"));
            }
        }
}

/* Each slip in a list of sound effects: the row and the slip are named, whatever the kind, degree and rule */
TEST(slips_are_found_at_the_first_start)
{
    static const gvi_effect slips[] = { { .points = first_alone }, { .kind = GVI_FORCE, .points = first_alone_of_v },
        { .points = sets }, { .kind = GVI_FORCE, .points = sets_of_v }, { .kind = GVI_LAGRANGIAN, .points = sets_dldv } };
    static const real q[2] = { 0, 0.5L }, v[2] = { 1, 0 };
    for (int k = 0; k < COUNT(slips); ++k)
        for (int degree = 1; degree <= 9; ++degree)
            for (int row = 0; row < 2; ++row) {
                const gvi_effect sound = { .points = spring };
                const gvi_effect list[] = { row ? sound : slips[k], row ? slips[k] : sound };
                gvi_desc d = { .n = 2, .degree = degree, .effects = list, .effect_count = 2 };
                if (degree == 1 && k < 2) continue;    // one point is all that there is
                gvi_stepper st = new_stepper(&d);
                gvi_start(&st, 0, q, v);
                says(&st, GVI_E_ARGUMENT, k < 2 ? "fills not all points" : "add with +=");
                assert_int_equal(st.fault.effect, row);
                    assert_status(gvi_step(&st, (real)0.1), GVI_E_ARGUMENT);       // the chain keeps it
            }
}

/* Written as if for one point, with n of 1 to 8, or with a loop that is one short */
static int no_loop(const gvi_points *x, void *user)
{
    for (int i = 0; i < x->n; ++i) x->f[i] -= x->q[i];
    return (void)user, 0;
}

static int one_short(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count - (x->count > 1); ++k)
        for (int i = 0; i < x->n; ++i) x->f[i*x->stride + k] -= x->q[i*x->stride + k];
    return (void)user, 0;
}

/* A loop over points that reads the first of them in each turn: q, v, and v for dL/dv */
static int first_q(const gvi_points *x, void *user)
{
    for (int j = 0; j < x->n*x->stride; ++j) x->f[j] -= x->q[j - j % x->stride];
    return (void)user, 0;
}

static int first_v(const gvi_points *x, void *user)
{
    for (int j = 0; j < x->n*x->stride; ++j) x->f[j] -= x->v[j - j % x->stride];
    return (void)user, 0;
}

static int first_momentum(const gvi_points *x, void *user)
{
    for (int j = 0; j < x->n*x->stride; ++j) x->dldv[j] += x->v[j - j % x->stride]/4;
    return (void)user, 0;
}

TEST(a_loop_that_reads_one_point_is_found)
{
    static const gvi_effect slips[] = { { .points = first_q }, { .kind = GVI_FORCE, .points = first_v },
                                        { .kind = GVI_LAGRANGIAN, .points = first_momentum } };
    static const real q[3] = { 0, 0.5L, 1 }, v[3] = { 1, 0, -0.25L };
    for (int k = 0; k < 3; ++k)
        for (int n = 1; n <= 3; ++n)
            for (int degree = 2; degree <= 12; ++degree)
                for (int by_p = 0; by_p < 2; ++by_p) {
                    const gvi_desc d = { .n = n, .degree = degree, .effects = slips + k, .effect_count = 1 };
                    gvi_stepper st = new_stepper(&d);
                    if (by_p) gvi_start_momentum(&st, 0, q, v);
                    else gvi_start(&st, 0, q, v);
                    says(&st, GVI_E_ARGUMENT, "fills not all points");
                    assert_int_equal(st.fault.effect, 0);
                }
}

/* Rods from the origin and from body to body, written as if for one point, or with a loop one short */
static int rod_alone(const gvi_points *x, void *user)
{
    const real *q = x->q;
    x->g[0] = (q[0]*q[0] + q[1]*q[1] - 1)/2;
    x->jacobian[0] = q[0];
    x->jacobian[1] = q[1];
    return (void)user, 0;
}

static int rod_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count - *(const int *)user*(x->count > 1); ++k) {
        const real X = x->q[k], Y = x->q[s + k];
        x->g[k] = (X*X + Y*Y - 1)/2;
        x->jacobian[k] = X;
        x->jacobian[s + k] = Y;
    }
    return 0;
}

TEST(a_constraint_without_its_loop_is_found)
{
    int fewer[] = { 1, 0 };
    const gvi_effect slips[] = { { .kind = GVI_CONSTRAINT, .points = rod_alone, .rows = 1 },
                                 { .kind = GVI_CONSTRAINT, .points = rod_loop, .rows = 1, .user = fewer },
                                 { .kind = GVI_CONSTRAINT, .points = rod_loop, .rows = 1, .user = fewer + 1 } };
    for (int k = 0; k < 3; ++k)
        for (int degree = 2; degree <= 9; ++degree)
            for (int start = 0; start < 3; ++start) {
                const gvi_desc d = { .n = 2, .degree = degree, .effects = slips + k, .effect_count = 1 };
                gvi_stepper st = new_stepper(&d);
                real q[] = { 0, 1 }, v[] = { 1, 0 };
                if (start == 0) gvi_start(&st, 0, q, v);
                if (start == 1) gvi_project(&st, 0, q, v, NULL);
                if (start == 2) {
                    assert_ok(gvi_switch(&st, 0, 0));
                    assert_ok(gvi_start(&st, 0, q, v));
                    gvi_switch(&st, 0, 1);
                }
                if (k == 2) {
                    assert_ok(st.status);
                    continue;
                }
                says(&st, GVI_E_ARGUMENT, "constraint: fills not all points");
                assert_int_equal(st.fault.effect, 0);
                assert_int_equal(st.fault.coordinate, 0);
            }
}

/* One that is off at the first start is looked at when it is first on; looks are no step's work */
TEST(a_constraint_is_looked_at_once_and_when_it_is_on)
{
    int fewer = 0;
    const gvi_effect e[] = { { .kind = GVI_CONSTRAINT, .points = rod_loop, .rows = 1, .user = &fewer },
                             { .kind = GVI_CONSTRAINT, .points = rod_alone, .rows = 1 } };
    const gvi_desc d = { .n = 2, .degree = 4, .effects = e, .effect_count = 2 };
    const real q[] = { 0, 1 }, v[] = { 1, 0 };
    gvi_stepper st = new_stepper(&d);
    assert_ok(gvi_switch(&st, 1, 0));
    assert_ok(gvi_start(&st, 0, q, v));
    const unsigned long long calls_of_a_start = st.counters.effect[0];
    assert_ok(gvi_start(&st, 0, q, v));
    assert_int_equal(st.counters.effect[0], 2*calls_of_a_start);
    gvi_switch(&st, 1, 1);
    says(&st, GVI_E_ARGUMENT, "constraint: fills not all points");
    assert_int_equal(st.fault.effect, 1);
}

GVI_EACH(of_three, 3, f) { x->f[2] -= x->q[2]; }

TEST(a_loop_over_points_that_is_missing_is_found)
{
    static const real q[8] = { 0.5L, 0.125L, 0.25L, 0.375L, 0.5L, 0.625L, 0.75L, 0.875L }, v[8] = { 0, 2 };
    for (int n = 1; n <= 8; ++n)
        for (int degree = 2; degree <= 9; ++degree)
            for (int k = 0; k < 2; ++k) {
                const gvi_effect e = { .points = k ? one_short : no_loop };
                const gvi_desc d = { .n = n, .degree = degree, .effects = &e, .effect_count = 1 };
                gvi_stepper st = new_stepper(&d);
                gvi_start(&st, 0, q, v);
                says(&st, GVI_E_ARGUMENT, "fills not all points");
            }
    static const real origin[8], away[8] = { 1, 1, 1, 1, 1, 1, 1, 1 };       // a force that is 0 where it starts
    const gvi_effect e = { .points = no_loop };
    const gvi_desc d = { .n = 8, .degree = 4, .effects = &e, .effect_count = 1 };
    gvi_stepper st = new_stepper(&d);
    gvi_start(&st, 0, origin, away);
    says(&st, GVI_E_ARGUMENT, "fills not all points");
    for (int n = 1; n <= 4; ++n) {
        const gvi_effect third = { .points = of_three };
        const gvi_desc desc = { .n = n, .effects = &third, .effect_count = 1 };
        st = new_stepper(&desc);
        gvi_start(&st, 0, q, v);
        if (n < 3) says(&st, GVI_E_CALLBACK, "larger n");
        else assert_ok(gvi_step(&st, (real)0.1));
    }
}

GVI_EACH(lists_no_f, 2, v) { x->f[0] -= x->v[0]; }
GVI_EACH(lists_no_v, 2, f) { x->f[0] -= x->v[0]; }
GVI_EACH(lists_no_value, 2, f) { x->f[0] -= x->q[0]; x->value[0] += 1; }
GVI_EACH(beyond_2, 2, f) { x->f[2] -= x->q[2]; }
GVI_EACH(lists_no_dldv, 2, v, f) { x->dldv[1] += x->q[0]; }

TEST(what_a_macro_does_not_list_is_told_by_the_start)
{
    static const struct { gvi_effect e; gvi_status status; } cases[] = {
        { { .kind = GVI_FORCE, .points = lists_no_f }, GVI_E_CALLBACK },
        { { .kind = GVI_FORCE, .points = lists_no_v }, GVI_E_NON_FINITE },
        { { .kind = GVI_POTENTIAL, .points = lists_no_value }, GVI_E_CALLBACK },
        { { .kind = GVI_POTENTIAL, .points = beyond_2 }, GVI_E_CALLBACK },
        { { .kind = GVI_LAGRANGIAN, .points = lists_no_dldv }, GVI_E_CALLBACK } };
    static const real q[3] = { 1, 0, 2 }, v[3] = { 1, 1, 0 };
    for (int k = 0; k < COUNT(cases); ++k)
        for (int n = 2; n <= 3; ++n)
            for (int degree = 1; degree <= 9; degree += 4) {
                const gvi_desc d = { .n = n, .degree = degree, .effects = &cases[k].e, .effect_count = 1 };
                gvi_stepper st = new_stepper(&d);
                assert_int_equal(gvi_start(&st, 0, q, v), cases[k].status);
                assert_int_equal(st.fault.effect, 0);
                if (cases[k].status == GVI_E_CALLBACK) says(&st, GVI_E_CALLBACK, "not in its list");
            }
}

/* The reason is this call's, not an older one's, nor one that speaks of an h where there is none */
static int off_by_one(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        x->g[k] = x->q[k]*x->q[k] + 1;
        x->jacobian[k] = 2*x->q[k];
    }
    return (void)user, 0;
}

TEST(reasons_are_those_of_the_last_call)
{
    const gvi_effect e = { .points = spring }, never = { .kind = GVI_CONSTRAINT, .points = off_by_one, .rows = 1 };
    const gvi_desc d = { .n = 2, .degree = 4, .effects = &e, .effect_count = 1, .resolution = (gvi_real)1e-6 },
                   held = { .n = 2, .degree = 4, .effects = &never, .effect_count = 1 };
    const real q[2] = { 1, 0 }, v[2] = { 0, 1 };
    real far[2] = { (real)0.3, 0 }, u[2] = { 0, 0 }, lambda;
    gvi_stepper st = new_motion(&d, 0, q, v);
    gvi_multipliers(&st, &lambda);
    says(&st, GVI_E_FORMULATION, "no constraint");
    for (int k = 0; k < 2; ++k) {
        gvi_step(&st, 30);
        assert_true(st.status != GVI_OK);
        gvi_advance(&st, k ? (real)NAN : st.t);
        says(&st, GVI_E_ARGUMENT, "t_end");
    }
    st = new_stepper(&held);
    gvi_project(&st, 0, far, u, NULL);
    says(&st, GVI_E_CONVERGENCE, "too far off");
    assert_null(strstr(gvi_why(&st), "halve h"));
}

/* What is no slip passes; the look is no step's work, and not repeated */
TEST(sound_effects_pass_and_are_looked_at_once)
{
    static const gvi_effect e[] = { { .points = spring }, { .kind = GVI_FORCE, .points = drag }, { .points = nothing },
                                    { .kind = GVI_LAGRANGIAN, .points = magnet } };
    static const real rest[2] = { 0, 0 }, v[2] = { 1, -1 };
    for (int count = 0; count <= 4; ++count)
        for (int degree = 1; degree <= 9; ++degree) {
            const gvi_desc d = { .n = 2, .degree = degree, .effects = count ? e : NULL, .effect_count = count };
            gvi_stepper st = new_stepper(&d);
            calls = 0;
            assert_ok(gvi_start(&st, 0, rest, v));
            assert_int_equal(calls, (count ? 5 + (degree > 1) : 0) + (count == 4));      // the last for dL/dv
            assert_int_equal(st.counters.effect[0], count == 4);
            calls = 0;
            assert_ok(gvi_start(&st, 0, rest, v));
            assert_int_equal(calls, count == 4);
            assert_ok(gvi_step(&st, (real)0.1));
        }
}

TEST(a_force_uses_what_the_mass_computed)
{
    static const gvi_effect e[] = { { .points = weight } };
    const gvi_desc d = { .n = 1, .degree = 4, .effects = e, .effect_count = 1,
                         .mass = { .kind = GVI_MASS_POSITION, .points = mass_and_weight, .gradient = mass_gradient } };
    static const real q[1] = { 1 }, v[1] = { 0 };
    gvi_stepper st;
    for (int k = 0; k < COUNT(weight_there); ++k) weight_there[k] = 0;
    assert_ok(gvi_init(&st, &d, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, q, v));
    assert_ok(gvi_step(&st, (real)0.1));
}

/* GVI_EACH is GVI_POINTS without its head and return: the same bits */
GVI_POINTS(by_points, 2, v, f, value)(const gvi_points *x, void *user)
{
    x->f[0] -= x->q[0]*x->q[1] + x->v[1];
    x->f[1] -= x->q[0]*x->q[0]/2 - x->v[0];
    x->value[0] += x->q[0]*x->q[0]*x->q[1]/2;
    return (void)user, 0;
}
GVI_EACH(by_each, 2, v, f, value)
{
    x->f[0] -= x->q[0]*x->q[1] + x->v[1];
    x->f[1] -= x->q[0]*x->q[0]/2 - x->v[0];
    x->value[0] += x->q[0]*x->q[0]*x->q[1]/2;
}
GVI_EACH(scaled, 1, f) { x->f[0] -= *(const real *)user*x->q[0]; }

TEST(gvi_each_has_the_bits_of_gvi_points)
{
    static const real q[2] = { 1, 0.25L }, v[2] = { 0, 0.5L }, four = 4;
    const gvi_effect a = { .kind = GVI_FORCE, .points = by_points }, b = { .kind = GVI_FORCE, .points = by_each };
    const gvi_desc one = { .n = 2, .degree = 5, .effects = &a, .effect_count = 1 },
                   two = { .n = 2, .degree = 5, .effects = &b, .effect_count = 1 };
    gvi_stepper st, st2;
    st = new_stepper(&one);
    st2 = new_stepper(&two);
    assert_ok(gvi_start(&st, 0, q, v));
    assert_ok(gvi_start(&st2, 0, q, v));
    move_alike(&st, &st2, 20, (real)0.125L);
    const gvi_effect c = { .points = scaled, .user = (void *)&four };
    const gvi_desc d = scene_of(&c, 1);
    st = new_motion(&d, 0, q, v);
    for (int k = 0; k < 8; ++k) assert_ok(gvi_step(&st, (real)3.14159265358979323846264L/16));
    assert_close(st.q[0], -1, 1e-5L);                       // half a period of omega = 2, error 3e-6 at degree 3
}

/* a sentence from a callback: effect and mass; it does not outlive its call */
static const char *road_ends(const gvi_points *x) { return x->q[x->count - 1] > 1 ? "the road ends here" : NULL; }
AT_POINTS(on_the_road) { return road_ends(x) ? gvi_fail(x, road_ends(x)) : 0; }
AT_POINTS(on_the_road_mute) { return road_ends(x) != NULL; }
GVI_POINTS(on_the_road_each, 1, f)(const gvi_points *x, void *user) { return road_ends(x) ? gvi_fail(x, road_ends(x)) : 0; }
AT_POINTS(heavy_road)
{
    for (int k = 0; k < x->count; ++k) x->mass[k] = 1;
    return on_the_road(x, user);
}

TEST(a_callback_says_why)
{
    gvi_points_fn *effects[] = { on_the_road, on_the_road_each, on_the_road_mute, NULL };
    for (int k = 0; k < 4; ++k) {
        const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = effects[k] ? effects[k] : nothing };
        gvi_desc desc = { .n = 1, .degree = 3, .effects = &effect, .effect_count = 1 };
        if (k == 3) desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = heavy_road, .gradient = nothing };
        const real q[] = { 0 }, v[] = { 1 };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        assert_ok(gvi_step(&st, R(0.5)));
        assert_status(gvi_step(&st, 1), GVI_E_CALLBACK);
        says(&st, GVI_E_CALLBACK, k == 2 ? "an effect (fault.effect) did not return 0" : "the road ends here");
        assert_ok(gvi_step(&st, R(0.25)));
        assert_null(st.fault.argument);
    }
}

RUN_TESTS(NULL, NULL)
