/* random.c - random scenes of all kinds: is a step that says ok right?

   Each scene is drawn from its number: coordinates, masses, effects, constraints, rule, degree, formulation, length of a
   step.  Three questions, whose answers come from random.h:

     equations   any degree and length: does the step solve its equations, to rounding?
     motion      degree 6 on, short steps: is its end the motion's, to rounding?  So v, H, a state in between, multipliers
     dial        any dial: is an accepted step as accurate as the dial says, to a factor of 10?

   What rounding may do is measured by the magnitudes of the terms (equations), or by what the motion makes of a change of
   1e-9 at its start (motion, dial).  The factors are a choice, not derived: an iteration may end at 32 eps of the largest
   amplitude, and a row is one of many sums; 7,600 scenes in double stayed below .8 of them.

     random [SECONDS [FIRST]]       random -1 NUMBER: one scene, with all its steps                         */
#include "random.h"

enum { EQUATIONS, MOTION, DIAL, QUESTIONS };
static const char *const question_names[] = { "equations", "motion", "dial" };
static const double allowed[] = { 200, 200, 10 };              /* roundings, roundings, times the dial */

typedef struct tally { long scenes, refused_scenes, steps, refused, unknown, wrong; double worst; } tally;
static tally found[QUESTIONS];
static int verbose;
static gvi_real memory[GVI_CONSTRAINED_LENGTH(N, S, S + 1, 2*M)], saved_memory[COUNT(memory)], again_memory[COUNT(memory)];
static gvi_stepper saved, again;                   /* before the step; a second stepper of the same scene */
static unsigned long number;

static double between(double lo, double hi) { return lo + (hi - lo)*(uniform() + 1)/2; }
static double sometimes(double share, double size) { return between(0, 1) < share ? size*uniform() : 0; }
static int one_of(int n) { return (int)between(0, n - 1e-9); }

/* ------------------------------------------------------------- a scene */

static void draw_rows(scene *z, L t, const L *q)
{
    for (int a = 0; a < rows_of(z); ++a) {
        row *c = z->rows + a;
        const int rolls = a >= z->holonomic;
        for (int i = 0; i < z->n; ++i) {
            c->w[i] = rolls ? 0 : sometimes(0.7, 2);
            c->x[i] = sometimes(0.7, 1.5);
            c->y[i] = rolls ? sometimes(0.7, 1) : 0;
            c->z[i] = rolls ? sometimes(0.5, 1) : 0;
        }
        c->r = z->timed ? sometimes(0.5, 0.5) : 0;
        c->r0 = sometimes(0.3, 1);
        c->level = 0;
        if (rolls) continue;
        L g, G[N], rate;
        row_at(z, c, 0, t, q, &g, G, &rate);
        c->level = (double)g;
    }
}

static void draw_scene(scene *z, L t, const L *q)
{
    const scene none = { 0 };
    const double wide = between(0, 1) < 0.3 ? 100 : 1;
    *z = none;
    z->n = 1 + one_of(N);
    z->mass = one_of(5);
    z->clock = between(0, 1) < 0.1;
    z->timed = !z->clock && between(0, 1) < 0.4;
    z->potential = between(0, 1) < 0.85;
    z->terms = z->mass == GVI_MASS_NONE || between(0, 1) < 0.35;
    z->force = between(0, 1) < 0.4;
    if (!z->clock && z->n > 1 && between(0, 1) < 0.4) z->holonomic = 1 + (z->n > 2 && between(0, 1) < 0.4);
    if (!z->clock && z->n > 1 + z->holonomic && between(0, 1) < 0.15) z->rolling = 1;
    z->listed = z->holonomic;
    z->w = between(0.3, 3);
    z->soft = between(0.2, 1);
    z->pull = sometimes(0.3, 1);
    for (int i = 0; i < z->n; ++i) {
        z->m[i] = (gvi_real)pow(10, (wide > 1 ? 3 : 1)*between(-0.7, 0.7));
        z->k[i] = sometimes(0.7, 3*wide);
        z->a[i] = sometimes(0.5, 2);
        z->phase[i] = uniform();
        z->push[i] = z->timed ? sometimes(0.5, 1) : 0;
        z->c[i] = sometimes(0.5, 1);
        z->b[i] = sometimes(0.5, 1);
        z->e[i] = sometimes(0.3, 0.7);
        z->d[i] = z->timed ? sometimes(0.4, 1) : 0;
        z->own[i] = z->mass == GVI_MASS_NONE ? 0.7 + (double)z->m[i] : 0;
        z->r[i] = between(0, 1) < 0.3 ? 0.5*uniform()*(z->mass == GVI_MASS_NONE ? z->own[i] : (double)z->m[i]/2) : 0;
        z->drag[i] = sometimes(0.5, 0.5);
        z->air[i] = sometimes(0.3, 0.3);
        z->turn[i] = sometimes(0.3, 0.7);
        z->drive[i] = z->timed ? sometimes(0.5, 1) : 0;
        z->wave[i] = uniform();
    }
    if (z->terms && between(0, 1) < 0.2) for (int i = 0; i < z->n; ++i) z->u[i] = between(0.02, 0.3);
    if (z->mass == GVI_MASS_UNIT) for (int i = 0; i < z->n; ++i) z->r[i] *= 0.5/(double)z->m[i];
    double least = 10;
    for (int i = 0; i < z->n; ++i) least = fmin(least, (double)z->m[i]);
    z->side = 0.2*least*uniform();
    for (int i = 0; i < z->n; ++i)
        for (int j = 0; j <= i; ++j)
            z->full[i*z->n + j] = z->full[j*z->n + i] = i == j ? z->m[i] : (gvi_real)(0.2*least*uniform());
    draw_rows(z, t, q);
}

/* ------------------------------------------------------------- what it may be wrong by */

static L norm(int n, const L *x) { L y = 0; for (int i = 0; i < n; ++i) y = fmaxl(y, fabsl(x[i])); return y; }

/* Below the least inertia, at most 1 */
static double lightest(const scene *z)
{
    double least = 1;
    for (int i = 0; i < z->n; ++i)
        least = fmin(least, (z->mass == GVI_MASS_NONE ? z->own[i] : z->mass == GVI_MASS_UNIT ? 1 : (double)z->m[i])/2);
    return least;
}

/* About the fastest frequency at speed v and distance q */
static double frequency(const scene *z, double q, double v)
{
    double square = 0, field = 0, least = lightest(z);
    for (int i = 0; i < z->n; ++i) {
        square += fabs(z->k[i]) + 2*fabs(z->a[i]) + fabs(z->turn[i]);
        field += fabs(z->c[i])*q + fabs(z->b[i]) + fabs(z->e[i])*q + fabs(z->d[i]) + fabs(z->r[i])*v + fabs(z->drag[i])
               + 2*fabs(z->air[i])*(1 + v);
    }
    if (z->potential) square += fabs(z->pull)/pow(z->soft, 3);
    else square = 0;
    if (!z->terms && !z->force) field = 0;
    return 1 + z->w*z->timed + sqrt(square/least) + 2*field/least + v*(1 + (rows_of(z) > 0) + (z->potential && fabs(z->pull) > 0)/z->soft);
}

/* The motion from y0 over h to y1, steps of the reference of half a radian over `finer`, and by how much it stretches
   a change of the start */
static L motion_of(const scene *z, L t0, L h, const L *y0, L *y1, L *stretch, int finer)
{
    const motion a = { 2*z->n, rates_of, (void *)(size_t)z };
    const int n = z->n;
    L V[N];
    velocity_of(z, t0, y0, y0 + n, V);
    const L H = fminl(0.5L/(L)frequency(z, (double)norm(n, y0), (double)norm(n, V)), fabsl(h)/1.5L)/finer;
    L z1[2*N], size = norm(n, y0) + norm(n, y0 + n);
    worst_rank = 1;
    finer_by = 3 + finer;
    memcpy(y1, y0, sizeof *y1*(size_t)(2*n));
    flow(&a, t0, t0 + h, H, y1);
    if (finer > 1) return 0;
    *stretch = 1;
    {
        for (int i = 0; i < 2*n; ++i) z1[i] = y0[i] + 1e-9L*size*(L)uniform();
        flow(&a, t0, t0 + h, H, z1);
        for (int i = 0; i < 2*n; ++i) *stretch = fmaxl(*stretch, fabsl(z1[i] - y1[i])/(1e-9L*size));
    }
    size = fmaxl(size, norm(n, y1) + norm(n, y1 + n));
    return size;
}

static void report(int question, double error, const char *what, const gvi_stepper *st, const scene *z)
{
    tally *a = found + question;
    const double bad = error/allowed[question];
    if (!(bad <= a->worst)) a->worst = bad;
    if (bad <= 1 && !verbose) return;
    if (bad > 1 || !(bad >= 0)) ++a->wrong;
    if (verbose || a->wrong <= 40)
        printf("  %s scene %lu: %s off by %.3g; n %d degree %d r %d h %.17g mass %d effects %d%d%d%d rows %d+%d u %g formulation %d "
               "iterations %d resolution %.1e t0 %.3g step %llu\n",
               question_names[question], number, what, error, st->n, st->s, st->r, (double)st->h, z->mass, z->potential, z->terms,
               z->force, z->clock, z->holonomic, z->rolling, z->u[0], st->formulation, st->iterations, (double)st->resolution, (double)st->t0,
               st->counters.steps);
    fflush(stdout);
}

static void read_ends(const gvi_stepper *st, L *y)
{
    read_state(st, y, y + st->n);
}

/* ------------------------------------------------------------- equations */

static void ask_equations(gvi_stepper *st, const scene *z, const rule *r, const L *before, L t0)
{
    step a = { z, r, st->s, t0, st->h, { 0 }, { 0 } };
    outcome end;
    L now[2*N], y[UNKNOWNS] = { 0 }, phi[S], Phi[S], gc[S + 2], gb[S + 2];
    const int n = z->n, s = st->s;
    memcpy(a.q0, before, sizeof *before*(size_t)n);
    memcpy(a.p0, before + n, sizeof *before*(size_t)n);
    read_ends(st, now);
    if (st->in.desc.rule.kind == GVI_KICKS || (st->formulation == GVI_EXPLICIT && !z->holonomic)) kicks_by_hand(&a, &end);
    else {
        gauss_nodes(s, gc, gb);
        for (int j = 0; j < s; ++j) {
            gvi_real q[N], v[N];
            if (gvi_curve(st, (gvi_real)gc[j], q, v) != GVI_OK) { report(EQUATIONS, NAN, "gvi_curve", st, z); return; }
            modes(s, gc[j], phi, Phi);
            for (int k = 0; k < s; ++k) for (int i = 0; i < n; ++i) y[k*n + i] += (2*k + 1)*gb[j]*phi[k]*v[i];
        }
        if (!solve_step(&a, y, &end)) { report(EQUATIONS, INFINITY, "no solution near", st, z); return; }
    }
    L worst = 0, qs = norm(n, end.qs), ps = norm(n, end.ps), explained = 1 + norm(n, end.qr)/qs + norm(n, end.pr)/ps;
    for (int i = 0; i < n; ++i)
        worst = fmaxl(worst, fmaxl(fabsl(now[i] - end.q[i])/qs, fabsl(now[n + i] - end.p[i])/ps)/(EPS*explained));
    report(EQUATIONS, (double)worst, "q, p", st, z);
}

/* ------------------------------------------------------------- motion, dial */

static L far_off(int n, const L *x, const L *y)
{
    L worst = 0;
    for (int i = 0; i < n; ++i) worst = fmaxl(worst, fabsl(x[i] - y[i]));
    return worst;
}

static void ask_queries(gvi_stepper *st, const scene *z, const L *y0, L t0, const L *y1, L unit)
{
    const int n = z->n;
    gvi_real v[N], q[N], p[N], energy, lambda[2*M];
    L V[N], Y[2*N], Z[2*N], x[N], stretch;
    sums s;
    velocity_of(z, (L)st->t + st->t_low, y1, y1 + n, V);
    if (gvi_velocity(st, v) != GVI_OK) report(MOTION, NAN, "gvi_velocity", st, z);
    for (int i = 0; i < n; ++i) x[i] = v[i];
    report(MOTION, (double)(far_off(n, x, V)/unit/(1/lightest(z) + norm(n, V))), "velocity", st, z);      /* p over M */
    if (gvi_energy(st, &energy) != GVI_OK) report(MOTION, NAN, "gvi_energy", st, z);
    all_sums(z, (L)st->t + st->t_low, y1, V, &s);
    L H = 0, size = 1, kinetic = 0, matrix[N*N];
    for (int i = 0; i < n; ++i) { H += s.P[i]*V[i]; size += s.Ps[i]*fabsl(V[i]); }
    mass_at(z, y1, matrix);
    for (int i = 0; i < n; ++i) for (int j = 0; j < n; ++j) kinetic += V[i]*matrix[i*n + j]*V[j]/2;
    const sums none = { { 0 }, { 0 }, { 0 }, { 0 }, 0 };
    sums parts = none;
    if (z->potential) { potential_at(z, (L)st->t + st->t_low, y1, &parts); H += parts.value; size += fabsl(parts.value); }
    parts = none;
    if (z->terms) { terms_at(z, (L)st->t + st->t_low, y1, V, &parts); H -= parts.value; size += fabsl(parts.value); }
    H -= kinetic;
    report(MOTION, (double)(fabsl((L)energy - H)/unit/size), "energy", st, z);
    const L part = between(0, 1);
    const gvi_real at = st->t0 + (gvi_real)part*(st->t - st->t0);
    if (gvi_state_at(st, at, q, v, p) != GVI_OK) { report(MOTION, NAN, gvi_why(st), st, z); return; }
    motion_of(z, t0, (L)at - t0, y0, Y, &stretch, 2);
    L rates[2*N];
    rates_of(at, Y, rates, (void *)(size_t)z);
    const L late = EPS*fabsl((L)at)*norm(2*n, rates);              /* what an ulp of t is worth */
    for (int i = 0; i < n; ++i) { Z[i] = q[i]; Z[n + i] = p[i]; }
    report(MOTION, (double)(far_off(2*n, Y, Z)/(unit + late)), "gvi_state_at", st, z);
    if (rows_of(z)) {
        L g[2*M], G[2*M*N], rate[2*M], lam[2*M], off = 0, big = 1;
        rows_at(z, (L)st->t + st->t_low, y1, g, G, rate);
        L least = 1e300L, rank = 1;
        for (int k = 0; k < 8; ++k) {              /* truncation and rounding meet where they change least */
            L one[2*M], two[2*M];
            rank = multipliers_of(z, (L)st->t + st->t_low, y1, y1 + n, V, s.f, G, k, one);
            multipliers_of(z, (L)st->t + st->t_low, y1, y1 + n, V, s.f, G, k + 1, two);
            if (far_off(rows_of(z), one, two) > least) continue;
            least = far_off(rows_of(z), one, two);
            memcpy(lam, two, sizeof lam);
        }
        if (gvi_multipliers(st, lambda) != GVI_OK) report(MOTION, NAN, gvi_why(st), st, z);
        for (int a = 0; a < rows_of(z); ++a) {
            off = fmaxl(off, fabsl(lambda[a] - lam[a]));
            big = fmaxl(big, fabsl(lam[a]));
        }
        report(MOTION, (double)(off/unit/big*rank/10), "gvi_multipliers", st, z);
    }
}

static void ask_motion(gvi_stepper *st, const scene *z, const L *before, L t0, L dial)
{
    const int n = z->n, question = dial > 0 ? DIAL : MOTION;
    L now[2*N], exact[2*N], stretch;
    read_ends(st, now);
    const L size = motion_of(z, t0, (L)st->t + st->t_low - t0, before, exact, &stretch, 1);
    if (!(worst_rank > 1e-3L) || !(stretch < 1e3L) || !(size < 1e3L)) { ++found[question].unknown; return; }
    const L rounding = EPS*stretch*size*(1 + fabsl(st->t)*z->timed);
    const L unit = dial > 0 ? dial*stretch*size + 20*rounding : rounding, error = far_off(2*n, now, exact);
    if (error > allowed[question]*unit) {                        /* is it the reference? */
        L finer[2*N];
        motion_of(z, t0, (L)st->t + st->t_low - t0, before, finer, NULL, 3);
        if (far_off(2*n, finer, exact) > error/100) { ++found[question].unknown; return; }
    }
    if (question == MOTION && error > allowed[MOTION]*unit) {    /* is it the length of the step? */
        L parts[2*N];
        must(gvi_restore(&again, &saved, saved_memory));
        if (gvi_steps(&again, st->h/16, 16) == GVI_OK) {
            read_ends(&again, parts);
            if (far_off(2*n, parts, exact) < error/100) { ++found[MOTION].unknown; return; }
        }
    }
    if (dial > 0) {
        report(DIAL, (double)(error/unit), "q, p", st, z);
        return;
    }
    report(MOTION, (double)(error/rounding), "q, p", st, z);
    if (between(0, 1) < 0.3) ask_queries(st, z, before, t0, exact, rounding);
}

/* ------------------------------------------------------------- a run */

static void draw_rule(int question, int s, gvi_desc *desc, rule *r, gvi_real *c, gvi_real *b)
{
    const double x = between(0, 1);
    int points = s;
    r->r = s;
    if (x < 0.2) desc->rule.kind = GVI_LOBATTO, points = s + 1;
    else if (x < 0.35) points = s + 1;
    else if (x < 0.4) desc->rule.kind = GVI_OWN;
    if (desc->rule.kind == GVI_LOBATTO) lobatto_nodes(points, r->c, r->b);
    else gauss_nodes(points, r->c, r->b);
    if (question == EQUATIONS && x > 0.9) {
        desc->rule.kind = GVI_KICKS;
        points = 1 + one_of(5);
        double sum = 0;
        for (int j = 0; j < points; ++j) { c[j] = (gvi_real)between(-0.3, 1.3); b[j] = (gvi_real)between(-0.2, 1); sum += (double)b[j]; }
        for (int j = 0; j < points; ++j) b[j] = (gvi_real)((double)b[j]/sum);
    } else for (int j = 0; j < points; ++j) { c[j] = (gvi_real)r->c[j]; b[j] = (gvi_real)r->b[j]; }
    if (desc->rule.kind == GVI_KICKS) for (int j = 0; j < points; ++j) { r->c[j] = c[j]; r->b[j] = b[j]; }
    r->r = desc->rule.points = points;
    if (desc->rule.kind >= GVI_OWN) desc->rule.nodes = c, desc->rule.weights = b;
}

/* Potential, forces or constraints off or on again */
static void switch_one(gvi_stepper *st, scene *z, const scene *all, const gvi_effect *list, int count)
{
    const int e = one_of(count), kind = (int)list[e].kind;
    int *on = kind == GVI_POTENTIAL ? &z->potential : kind == GVI_FORCE ? &z->force : kind == GVI_CONSTRAINT ? &z->holonomic : NULL;
    if (!on || (kind == GVI_CONSTRAINT && (all->rolling || !*on))) return;
    *on = *on ? 0 : 1;
    if (gvi_switch(st, e, *on) != GVI_OK) report(MOTION, NAN, gvi_why(st), st, z);
}

static void run_scene(void)
{
    gvi_effect list[8];
    scene z, all;
    rule r;
    gvi_real c[S + 2], b[S + 2], q[N], v[N];
    L at[N];
    gvi_stepper st;
    seed = number*2862933555777941757u + 3037000493u;
    for (int i = 0; i < 4; ++i) uniform();
    const int question = one_of(QUESTIONS);
    const double t = between(0, 1) < 0.5 ? 0 : 3*uniform();
    for (int i = 0; i < N; ++i) { q[i] = (gvi_real)(1.5*uniform()); v[i] = (gvi_real)(1.5*uniform()); at[i] = q[i]; }
    draw_scene(&z, (gvi_real)t, at);
    all = z;
    const int s = question == EQUATIONS ? 1 + one_of(6) : question == MOTION ? 7 + one_of(4) : 3 + one_of(8);
    double h = question == EQUATIONS ? pow(10, between(-3, 0.4)) : pow(10, between(-2, -0.6))/frequency(&z, 1.5, 1.5);
    if (between(0, 1) < 0.3) h = -h;
    const double dial = question == DIAL ? pow(10, between(-13, -3)) : 0;
    gvi_desc desc = { .n = z.n, .degree = s, .effects = list, .mass = { .kind = (gvi_mass_kind)z.mass }, .resolution = (gvi_real)dial };
    desc.effect_count = list_effects(&z, list);
    if (!desc.effect_count) desc.effects = NULL;
    if (z.mass == GVI_MASS_DIAGONAL) desc.mass.matrix = z.m;
    if (z.mass == GVI_MASS_DENSE) desc.mass.matrix = z.full;
    if (z.mass == GVI_MASS_POSITION) desc.mass.points = the_mass, desc.mass.gradient = the_gradient, desc.mass.user = &z;
    if (between(0, 1) < 0.3) desc.formulation = (gvi_formulation)(1 + one_of(5));
    draw_rule(question, s, &desc, &r, c, b);
    if (desc.rule.kind == GVI_KICKS) desc.degree = 1;
    ++found[question].scenes;
    const int change_h = between(0, 1) < 0.3, switches = between(0, 1) < 0.2, forced = question == EQUATIONS && (z.clock || z.rolling);
    if (forced || gvi_init(&st, &desc, memory, sizeof memory) != GVI_OK) {
        if (verbose) printf("  refused: %s\n", forced ? "has no equations here" : gvi_why(&st));
        ++found[question].refused_scenes;
        return;
    }
    must(gvi_init(&again, &desc, again_memory, sizeof again_memory));
    if (rows_of(&z) && gvi_project(&st, (gvi_real)t, q, v, NULL) != GVI_OK) { if (verbose) puts(gvi_why(&st)); ++found[question].refused_scenes; return; }
    if (gvi_start(&st, (gvi_real)t, q, v) != GVI_OK) {
        if (verbose || rows_of(&z) || st.status == GVI_E_ARGUMENT || st.status == GVI_E_CONSTRAINT) printf("  %s scene %lu: start: %s\n", question_names[question], number, gvi_why(&st));
        ++found[question].refused_scenes;
        return;
    }
    for (int k = 0; k < 6; ++k) {
        L before[2*N];
        const L t0 = (L)st.t + st.t_low;
        read_ends(&st, before);
        if (desc.effect_count && switches && between(0, 1) < 0.4) switch_one(&st, &z, &all, list, desc.effect_count);
        if (change_h) h *= between(0.5, 1.5);
        ++found[question].steps;
        saved = st;
        memcpy(saved_memory, memory, sizeof memory);
        const gvi_status status = question == DIAL ? gvi_advance(&st, (gvi_real)(t + 4)) : gvi_step(&st, (gvi_real)h);
        if (status != GVI_OK) {
            if (verbose) printf("  step: %s\n", gvi_why(&st));
            ++found[question].refused;
            break;
        }
        if (!(norm(2*z.n, before) < 100)) break;
        if (question == EQUATIONS) ask_equations(&st, &z, &r, before, t0);
        else ask_motion(&st, &z, before, t0, dial);
    }
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 20;
    const time_t end = time(NULL) + (time_t)seconds;
    number = argc > 2 ? strtoul(argv[2], NULL, 10) : 1;
    verbose = seconds < 0;
    do run_scene(); while (++number && time(NULL) < end);
    printf("%-10s %9s %9s %10s %9s %9s %7s   %s\n", "", "scenes", "refused", "steps", "refused", "left out", "wrong", "worst of allowed");
    for (int k = 0; k < QUESTIONS; ++k) {
        const tally *a = found + k;
        printf("%-10s %9ld %9ld %10ld %9ld %9ld %7ld   %.2g\n", question_names[k], a->scenes, a->refused_scenes, a->steps, a->refused,
               a->unknown, a->wrong, a->worst);
        misses += a->wrong > 0;
    }
    return verdict("random");
}
