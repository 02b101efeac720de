/* The scenes of examples/scenes: every one runs, its energy changes by the work
   of its forces and by nothing else; four come to published ends and periods.
   And a scene pays for what it lists: an effect that is off, or not listed, is
   not asked and leaves no trace in the result; nor memory (test_prices.c). */
#include "gvi_test.h"
#include "scenes/scenes.c"

static scene_setup made, other;
static gvi_stepper st;
static double *memory, *spare;

enum { ROOM = 4000000 };

static int get_memory(void **state)
{
    memory = malloc(ROOM*sizeof *memory);
    spare = malloc(ROOM*sizeof *spare);
    return memory && spare ? 0 : -1;
}

static int free_memory(void **state)
{
    free(memory);
    free(spare);
    return 0;
}

static const scene *build(const char *name, const char *without)
{
    const scene *a = scene_find(name);
    assert_non_null(a);
    scene_build(a, &made, without);
    return a;
}

static void start(void)
{
    assert_true(gvi_size(&made.desc) <= ROOM*sizeof *memory);
    assert_ok(gvi_init(&st, &made.desc, memory, ROOM*sizeof *memory));
    assert_ok(gvi_start(&st, 0, made.q, made.v));
}

static void steps(long count, double h)
{
    for (long k = 0; k < count; ++k) assert_ok(gvi_step(&st, h));
}

static void velocity(double *v) { assert_ok(gvi_velocity(&st, v)); }

typedef struct balance { double gained, missing, kinetic; } balance;

/* Runs a scene; the most that the energy changed, that it did so without work
   being done, and that the kinetic energy was. */
static balance run_balance(const scene *a, const char *without)
{
    balance b = { 0, 0, 0 };
    double e0, e, work[GVI_EFFECTS] = { 0 };
    build(a->name, without);
    start();
    assert_ok(gvi_energy(&st, &e0));
    for (long k = 0; k < lround(a->duration/a->h); ++k) {
        double sum = 0;
        steps(1, a->h);
        assert_ok(gvi_energy(&st, &e));
        assert_int_equal(scene_work(&st, &made, 0, work), 0);
        for (int i = 0; i < made.desc.effect_count; ++i) sum += work[i];
        b.gained = fmax(b.gained, fabs(e - e0));
        b.missing = fmax(b.missing, fabs(e - e0 - sum));
        b.kinetic = fmax(b.kinetic, e - scene_potential(&made, 0, st.t, st.q));
    }
    return b;
}

/* All forces of a scene, for leaving them out. */
static int list_forces(const scene *a, char *names, size_t size)
{
    int count = 0;
    build(a->name, NULL);
    names[0] = 0;
    for (int e = 0; e < made.desc.effect_count; ++e) {
        if (made.effects[e].kind != GVI_FORCE) continue;
        if (count++) strncat(names, ",", size - strlen(names) - 1);
        strncat(names, made.names[e], size - strlen(names) - 1);
    }
    return count;
}

/* Over its whole duration each scene keeps its energy, or changes it by the work
   of its forces, to rounding: 1e-12 of the kinetic energy, in 80 to 16384 steps. */
TEST(energy_changes_by_the_work_of_forces_alone)
{
    char names[256];
    int forced = 0;
    for (int i = 0; i < scene_count; ++i) {
        const balance b = run_balance(scenes[i], NULL);
        assert_true(b.kinetic > 0);
        const int forces = list_forces(scenes[i], names, sizeof names);
        assert_true(b.missing <= 1e-12*b.kinetic);
        if (forces) assert_true(b.gained > 0.01*b.kinetic);
        else assert_true(b.gained <= 5e-14*b.kinetic);
        forced += forces > 0;
    }
    assert_int_equal(scene_count, 14);
    assert_int_equal(forced, 7);
}

/* What the scenes say they conserve, in units of the momentum or angular momentum
   that there is; the satellite without its air. */
TEST(what_scenes_say_they_conserve_is_conserved)
{
    int seen = 0;
    for (int i = 0; i < scene_count; ++i) {
        const scene *a = scenes[i];
        double v[SCENE_MAX], first[SCENE_CURVES], now[SCENE_CURVES], size = 0, reach = 1;
        if (!a->quantities) continue;
        build(a->name, "air");
        start();
        velocity(v);
        a->quantities(st.q, v, st.p, first);
        for (int j = 0; j < st.n; ++j) size += fabs(st.p[j]), reach = fmax(reach, fabs(st.q[j]));
        size *= reach;
        for (int k = 0; k < 80; ++k) {
            steps(1, a->h);
            velocity(v);
            a->quantities(st.q, v, st.p, now);
            for (int j = 0; j < SCENE_CURVES && a->conserved[j]; ++j, ++seen)
                assert_close(now[j], first[j], 1e-14*size);
        }
    }
    assert_int_equal(seen, 80*9);
}

/* Against the 25-digit end state of examples/outer_solar_system_reference.txt. */
static double solar_system_error(int degree, int parts)
{
    char line[512], name[16];
    double q[3], m, v, worst = 0;
    int body = 0;
    FILE *file = fopen("examples/outer_solar_system_reference.txt", "r");
    assert_non_null(file);
    build("outer_solar_system", NULL);
    made.desc.degree = degree;
    start();
    steps(1000*parts, 200.0/parts);
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%15s %lf %lf %lf %lf %lf", name, &m, q, q + 1, q + 2, &v) != 6) continue;
        for (int c = 0; c < 3; ++c) worst = fmax(worst, fabs(st.q[3*body+c] - q[c]));
        ++body;
    }
    fclose(file);
    assert_int_equal(body, 6);
    return worst;
}

TEST(the_solar_system_ends_where_the_reference_does)
{
    assert_between(0, solar_system_error(8, 1), 1e-11);
    assert_between(7.5, log2(solar_system_error(4, 1)/solar_system_error(4, 2)), 8.5);
}

/* The three bodies come back after Simo's period, and after a third of it each
   stands where another began; to the 8 digits that the data have. */
TEST(the_figure_eight_closes_after_its_period)
{
    const double period = 6.32591398;
    double v[6], miss = 0, far = 0, along = 0, speed = 0;
    build("figure_eight", NULL);
    start();
    steps(20, period/60);
    for (int i = 0; i < 6; ++i) miss = fmax(miss, fabs(st.q[i] - made.q[(i + 4) % 6]));
    assert_between(1e-10, miss, 1e-7);
    steps(40, period/60);
    velocity(v);
    for (int i = 0; i < 6; ++i) {
        far = fmax(far, fabs(st.q[i] - made.q[i]));
        along += (made.q[i] - st.q[i])*v[i];
        speed += v[i]*v[i];
    }
    assert_between(1e-10, far, 1e-7);
    assert_close(period + along/speed, period, 5e-8);
}

/* Arenstorf's orbit closes, though a perturbation of its start grows 1e4-fold. */
TEST(arenstorfs_orbit_closes)
{
    const scene *a = build("arenstorf", NULL);
    double nudged;
    start();
    steps(16384, a->h);
    assert_close(st.q[0], made.q[0], 1e-11);
    assert_close(st.q[1], 0, 1e-11);
    made.q[0] += 1e-10;
    start();
    steps(16384, a->h);
    nudged = hypot(st.q[0] - made.q[0], st.q[1]);
    assert_between(1e-8, nudged, 1e-4);
}

/* Largest share of energy in mode 1 between 100 and 170 of its periods, and when. */
static double recurrence(int degree, gvi_rule_kind rule, double h, double *share)
{
    const double period = 64.02570931921777;                              // pi/sin(pi/64)
    double v[FPUT_BONDS], when = 0;
    build("fput", NULL);
    made.desc.degree = degree;
    made.desc.rule.kind = rule;
    start();
    const double first = fput_mode(made.q, made.v, 1);
    *share = 0;
    while (st.t < 170*period) {
        steps(1, h);
        if (st.t < 100*period) continue;
        velocity(v);
        const double now = fput_mode(st.q, v, 1)/first;
        if (now > *share) *share = now, when = st.t/period;
    }
    return when;
}

/* The energy of the FPUT chain returns after 146.4 periods of mode 1.  The 157 of
   the literature belong to the step of the report itself, leapfrog with h^2 = 1/8,
   whose error weakens the dispersion by 1/8 and so delays the return by
   sqrt(8/7) = 1.069; Stoermer-Verlet is that method. */
TEST(the_fput_chain_returns_when_it_should)
{
    double share, exact = recurrence(6, GVI_GAUSS, 1, &share), leapfrog, fine;
    assert_between(0.975, share, 0.985);
    assert_between(146, exact, 147);
    leapfrog = recurrence(1, GVI_LOBATTO, sqrt(1/8.0), &share);
    assert_int_equal(st.formulation, GVI_EXPLICIT);
    assert_between(156, leapfrog, 158);
    assert_between(0.97, share, 0.985);
    assert_close(leapfrog/exact, sqrt(8/7.0), 0.005);
    fine = recurrence(1, GVI_LOBATTO, sqrt(1/512.0), &share);
    assert_close(fine, exact, 0.5);

}

/* Runs `count` steps of scene a with effect e switched off (in st) and not listed (in bare); the
   two steppers stay for comparison. Do both have the same formulation, as chosen from the list? */
static int off_and_unlisted(const scene *a, int e, long count, gvi_stepper *bare)
{
    const char *name;
    build(a->name, NULL);
    name = made.names[e];
    scene_build(a, &other, name);
    assert_int_equal(other.desc.effect_count, made.desc.effect_count - 1);
    assert_int_equal(scene_effect(&other, name), -1);
    assert_ok(gvi_init(&st, &made.desc, memory, ROOM*sizeof *memory));
    assert_ok(gvi_switch(&st, e, 0));
    assert_ok(gvi_start(&st, 0, made.q, made.v));
    assert_ok(gvi_init(bare, &other.desc, spare, ROOM*sizeof *spare));
    assert_ok(gvi_start(bare, 0, other.q, other.v));
    const int same = st.formulation == bare->formulation;
    for (long k = 0; k < count; ++k) {
        assert_ok(gvi_step(&st, a->h));
        assert_ok(gvi_step(bare, a->h));
    }
    return same;
}

/* Off is as if it were not listed: not one evaluation, and the same work and the
   same bits as long as the formulation is the same.  Where it was the effect that
   asked for velocities, the formulation differs, both steppers say so, and the
   results agree as two ways of computing the same numbers do. */
TEST(off_is_as_if_not_listed)
{
    static gvi_stepper bare;
    int same = 0;
    char changed[256] = "";
    for (int i = 0; i < scene_count; ++i) {
        build(scenes[i]->name, NULL);
        for (int e = 0, count = made.desc.effect_count; e < count; ++e) {
            const int alike = off_and_unlisted(scenes[i], e, 40, &bare);
            assert_true(st.counters.effect[e] == 0);
            if (alike) {
                ++same;
                assert_memory_equal(st.q, bare.q, (size_t)st.n*sizeof *st.q);
                assert_memory_equal(st.p, bare.p, (size_t)st.n*sizeof *st.p);
                assert_true(st.counters.iterations == bare.counters.iterations);
                assert_true(st.counters.newton_iterations == bare.counters.newton_iterations);
                for (int k = 0; k < other.desc.effect_count; ++k)
                    assert_true(st.counters.effect[k < e ? k : k + 1] == bare.counters.effect[k]);
                continue;
            }
            snprintf(changed + strlen(changed), sizeof changed - strlen(changed), "%s:%s ", scenes[i]->name,
                     made.names[e]);
            assert_int_equal(st.formulation, made.desc.effects[e].kind == GVI_LAGRANGIAN ? GVI_MOMENTA : GVI_VELOCITIES);
            assert_int_equal(bare.formulation, GVI_POSITIONS);
            assert_string_not_equal(gvi_formulation_text(&st), gvi_formulation_text(&bare));
            for (int k = 0; k < st.n; ++k) assert_close(st.q[k], bare.q[k], 1e-13*(1e-3 + fabs(bare.q[k])));
        }
    }
    assert_string_equal(changed, "satellite:air arenstorf:frame net:air crossed_fields:magnetic hanging_chain:air "
                                 "peaucellier:bearings ");
    assert_int_equal(same, 29);
}

RUN_TESTS(get_memory, free_memory)
