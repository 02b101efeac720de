/* tools.c - the smallest use of each tool, as docs/tools.md shows it, with the headers that `make install` puts under
   gvi/.  C99 and C++20.  Runs: a planet on an ellipse; returns the number of the tool that fails. */
#define GVI_IMPLEMENTATION
#include <gvi.h>
#include <gvi/advise.h>
#include <gvi/animate.h>
#include <gvi/body.h>
#include <gvi/check.h>
#include <gvi/damped.h>
#include <gvi/effects.h>
#include <gvi/ensemble.h>
#include <gvi/event.h>
#include <gvi/lagrangian.h>
#include <gvi/shooting.h>
#include <gvi/svg.h>
#include <gvi/adjoint.h>
#ifndef __cplusplus
#include <gvi/complex_step.h>
#endif

static const double one[1] = { 1 };
static const struct central_gravity sun = { { 0, 1, 2 }, one, 1, { 0, 0, 0 } };
static double memory[GVI_LENGTH(4, 8, 8)];

static int checked(gvi_desc desc, const double *q, const double *v)
{
    check_finding list[10];
    check_report report = { .list = list, .room = 10 };
    char line[300];
    if (check_scene(&desc, 0, q, v, &report) < 0) puts("gvi_init refuses it");
    for (int i = 0; i < report.count && i < 10; ++i) puts(check_line(&list[i], line, sizeof line));
    return report.count;
}

LAGRANGIAN(by_l, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + 1/sqrt(q[0]*q[0] + q[1]*q[1]); }
HAMILTONIAN(by_h, 2) { return (p[0]*p[0] + p[1]*p[1])/2 - 1/sqrt(q[0]*q[0] + q[1]*q[1]); }
LAGRANGIAN(free_arm, 2)
{
    const number a = q[0], b = q[1];
    return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*cos(a - b) + exp(sin(a)) - log(2 + b*b) - tan(b/4) - pow(2 + a, 1.5) + fabs(a + 3)
           - pow(2 + b, 2 + a) - 0.25*a/(2 + b) - 3/(2 + a) + (-a)*2 - b/3 + (1 - a) + (a - 1);
}
LAGRANGIAN(first_order, 2) { return q[0]*v[1] - q[0]*q[0]; }

// the planet from L and from H, after 10 units of time; how far from the ellipse x = 2.06 and more
static int typed(const double *q, const double *v)
{
    static double room[2][GVI_LENGTH(2, 8, 8)];
    static lagrangian L;
    static hamiltonian H;
    gvi_stepper a, b;
    double energy = 0;
    if (lagrangian_init(&L, by_l, NULL, 0, q, v) || hamiltonian_init(&H, by_h, NULL, 0, q, v)) return 0;
    const gvi_effect from_l = lagrangian_effect(&L), from_h = hamiltonian_effect(&H);
    gvi_desc desc = { .n = 2, .mass = lagrangian_mass(&L), .effects = &from_l, .effect_count = 1 };
    if (L.kind != LAGRANGIAN_POTENTIAL || checked(desc, q, v)) return 0;
    gvi_init(&a, &desc, room[0], sizeof room[0]);
    gvi_start(&a, 0, q, v);
    desc.effects = &from_h;
    desc.mass = hamiltonian_mass(&H);
    desc.formulation = GVI_MOMENTA;
    gvi_init(&b, &desc, room[1], sizeof room[1]);
    gvi_start_momentum(&b, 0, q, v);
    for (int k = 0; k < 100; ++k) gvi_step(&a, 0.1), gvi_step(&b, 0.1);
    if (a.status || b.status || !(fabs(a.q[0] - b.q[0]) < 1e-11)) return 0;
    if (gvi_energy(&b, &energy) || !(fabs(energy + 0.5) < 1e-14)) return 0;
    // numbers of this language, and both kinds of refusal
    return !lagrangian_init(&L, free_arm, NULL, 0, q, v) && L.kind == LAGRANGIAN_MASS
           && strstr(lagrangian_init(&L, first_order, NULL, 0, q, v), "HAMILTONIAN");
}

// a wheel that rolls upright and straight on
static int rolled(void)
{
    static const body disc = { 2, { 0.045, 0.045, 0.09 } };
    static const bodies bicycle = { &disc, 1 };
    static const body_round tyre = { .at = 0, .radius = 0.3, .axis = { 0, 0, 1 } };         // no axis: a ball
    const gvi_effect scene[] = { body_touches(&tyre), body_rolls(&tyre) };
    static double room[GVI_CONSTRAINED_LENGTH(7, 8, 8, 3)];
    gvi_desc desc = { .n = 7, .mass = body_mass(&bicycle), .effects = scene, .effect_count = 2 };
    const double half = sqrt(0.5), q[7] = { 0, 0, 0.3, half, half, 0, 0 }, w[3] = { 0, 0, 2 };
    double v[7] = { -0.6, 0, 0, 0, 0, 0, 0 };                                // its axis is -y
    gvi_stepper st;
    desc.mass.velocity = NULL;
    body_turn(q + 3, w, v + 3);
    if (gvi_init(&st, &desc, room, sizeof room)) return 0;
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 10 && st.status == GVI_OK; ++k) gvi_step(&st, 0.1);
    return st.status == GVI_OK && fabs(st.q[0] + 0.6) < 1e-13 && fabs(st.q[1]) < 1e-13;
}

static double height(double t, const double *q, const double *v, void *user) { return (void)t, (void)v, (void)user, q[1]; }

// one run of many: k revolutions of a step each
static void run(int k, void *result, void *user)
{
    double mine[GVI_LENGTH(2, 8, 8)], *angle = (double *)result;
    const gvi_desc *desc = (const gvi_desc *)user;
    const double q[] = { 1, 0 }, v[] = { 0, 1 + 0.01*k };
    gvi_stepper st;
    gvi_init(&st, desc, mine, sizeof mine);
    gvi_start(&st, 0, q, v);
    for (int i = 0; i < 10 && st.status == GVI_OK; ++i) gvi_step(&st, 0.1);
    *angle = atan2(st.q[1], st.q[0]);
}

int main(void)
{
    const gvi_effect scene[] = { central_gravity(&sun) };
    gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1 };
    const double q[] = { 0.4, 0 }, v[] = { 0, 2 };
    double at[3][2], x[100], y[100], angles[4];
    event passage = { .g = height, .q = at[0], .v = at[1], .p = at[2] };
    gvi_stepper st;
    int found = 0;

    if (checked(desc, q, v)) return 1;
    if (!typed(q, v)) return 5;
    if (!rolled()) return 6;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 100 && st.status == GVI_OK; ++k) {
        gvi_step(&st, 0.1);
        x[k] = st.q[0];
        y[k] = st.q[1];
        while (event_next(&passage, &st) > 0) found += passage.rising;
    }
    // three passages before t = 10, at 0 (not counted), 2 pi
    if (st.status || found != 1 || !(passage.t > 9.42 && passage.t < 9.43)) return 2;

    const svg_line line = { .name = "planet", .x = x, .y = y, .count = 100 };
    const svg_plot plot = { .title = "An orbit", .lines = &line, .line_count = 1 };
    if (svg_write("build/tools.svg", &plot)) return 3;

    ensemble_run(4, 2, sizeof angles[0], run, &desc, angles);
    return angles[0] > 0.999999 && angles[0] < 1.000001 && angles[3] > angles[0] ? 0 : 4;
}
