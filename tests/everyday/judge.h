/* judge.h - runs of one scene compared: status, end, cost

   Ends.  Each step rounds what it adds to q and p, and what it rounds is kept (q_low): N steps end within sqrt(N) roundings of
   the largest |q| and |v| period/2 pi, and the map there and back, of n terms, within 4.  The motion stretches that by `growth`, which is
   measured on runs whose starts differ by sqrt(eps); a part of the period, by that power of it.  An origin and a speed
   add their own roundings to the force.  Two runs, and four times that, since roundings are not the least there are:
   8 eps (4 + sqrt(N)) growth (1 + origin/size); by the root of the ratio of two masses more, since a light coordinate settles
   to the roundings of the heaviest, |q| sqrt(m).
   Ends by other equations (other coordinates, degrees, rules): each may be off by what half of its h changes.
   By the dial: 10 times the worst st.resolution for each step, as the header says, and once 190 times, the worst
   that `make hard-dial` knows of one step; or the dial in its place, where the measure is rounding of q over h v.
   Cost.  At most 1.5 times the points of the best fixed point that is pinned, or one iteration a step more, as a coordinate that
   is exactly 0 saves.  Where Newton's method takes over, its matrices counted as points, 1.2 times the best that is pinned
   and the attempt that failed.  By the dial, at most twice the steps of the best, and three.           */
#ifndef EVERYDAY_JUDGE_H
#define EVERYDAY_JUDGE_H

#include "known.h"

static const char *shown_scene, *shown_way;

/* ---- tallies, a line for each relation */

typedef int fault;
static const char *const fault_names[] = { "refused", "wrong", "dear", "unlike" };

typedef struct relation { const char *name; long runs, faults[FAULTS], known; double worst; } relation;
static relation relations[128];
static int relation_count;

static relation *relation_of(const char *name)
{
    for (int k = 0; k < relation_count; ++k) if (!strcmp(relations[k].name, name)) return relations + k;
    relations[relation_count].name = name;
    return relations + relation_count++;
}

/* What is run now */
typedef struct subject {
    const scene *s;
    state  start;
    double growth, size;                /* of a change of the start in a period; of the motion             */
    double share;                       /* of the period that is run                                       */
    char   how[100];                    /* degree, rule, length or dial                                    */
    const char *ways;                   /* those drawn, or NULL                                            */
} subject;
static subject now;

static int is_shown(const char *name)
{
    return shown_scene && strstr(now.s->name, shown_scene) && strstr(name, shown_way);
}

static void count_run(const char *name, const outcome *a)
{
    ++relation_of(name)->runs;
    if (a && is_shown(name))
        printf("  %s, %s, %s: %s, %ld steps, cost %.0f, newton %ld, formulation %d, q %.17g v %.17g\n", now.s->name, name, now.how, a->why,
               a->steps, a->cost, a->newton, a->formulation, (double)a->q[0], (double)a->v[0]);
}

/* The row of known.h that it is, or NULL */
static const known *fails(const char *name, fault what, const char *detail)
{
    relation *r = relation_of(name);
    const char *way_ = now.ways ? now.ways : name;
    known *k = known_fault(now.s->name, way_, now.how, detail, (int)what);
    if (k) ++k->seen, ++r->known;
    else ++r->faults[what];
    if (k && !shown_scene) return k;
    printf("  %s%s: %s, %s, %s: %s\n", k ? "known, " : "", fault_names[what], now.s->name, way_, now.how, detail);
    fflush(stdout);
    return k;
}

static int verdict(int all)
{
    long runs = 0, faults = all ? print_known() : 0, accepted = 0;
    printf("%-34s %7s %7s %7s %7s %7s %7s   %s\n", "the same motion by", "runs", "refused", "wrong", "dear", "unlike", "known",
           "farthest off of allowed");
    for (int k = 0; k < relation_count; ++k) {
        const relation *r = relations + k;
        printf("%-34s %7ld %7ld %7ld %7ld %7ld %7ld   %.2g\n", r->name, r->runs, r->faults[REFUSED], r->faults[WRONG],
               r->faults[DEAR], r->faults[UNLIKE], r->known, r->worst);
        runs += r->runs;
        accepted += r->known;
        for (int e = 0; e < FAULTS; ++e) faults += r->faults[e];
    }
    printf("everyday: %ld passed, %ld failed, %ld known, %.1f s\n", runs - faults - accepted, faults, accepted,
           (double)clock()/CLOCKS_PER_SEC);
    return faults > 0;
}

/* ---- distances */

static double norm_of(int n, const real *q, const real *v, double tau)
{
    double most = 0;
    for (int i = 0; i < n; ++i) most = fmax(most, fmax(fabs((double)q[i]), tau*fabs((double)v[i])));
    return most;
}

static double tau_of(const scene *s) { return (double)s->period/6.283185307179586; }

/* the farthest copy of a from b's first */
static double distance(const outcome *a, int copies, const outcome *b)
{
    const int n = now.s->n;
    double most = 0;
    real q[N], v[N];
    for (int c = 0; c < copies; ++c) {
        for (int i = 0; i < n; ++i) q[i] = a->q[c*n + i] - b->q[i], v[i] = a->v[c*n + i] - b->v[i];
        most = fmax(most, norm_of(n, q, v, tau_of(now.s)));
    }
    return most;
}

static double shift_of(const written *w)
{
    double most = 0;
    for (int i = 0; i < now.s->n; ++i)
        most = fmax(most, fabs((double)w->origin[i])
                              + fabs((double)w->speed[i])*((double)now.s->period + fabs((double)(w->date/w->time))));
    return most/now.size;
}

static double masses_of(const scene *s)
{
    double least = 1, most = 1;
    for (int i = 0; i < s->n; ++i) {
        if (!(s->m[i] > 0)) continue;
        least = fmin(least, (double)s->m[i]);
        most = fmax(most, (double)s->m[i]);
    }
    return sqrt(most/least);
}

static double roundings(const written *w, long steps)
{
    return 8*(double)EPS*(4 + sqrt((double)steps))*pow(now.growth, now.share)*now.size*(1 + shift_of(w))*masses_of(now.s);
}

/* ---- a scene's start, and how much its motion stretches a change */

static state state_on_rows(const scene *s, state a)
{
    gvi_stepper st;
    written w = plainly(s);
    if (has_rows(s) && set_up(&st, &w) == GVI_OK) gvi_project(&st, 0, a.q, a.v, NULL);
    return a;
}

static state start_of(const scene *s)
{
    state a;
    memcpy(a.q, s->q, sizeof a.q);
    memcpy(a.v, s->v, sizeof a.v);
    return state_on_rows(s, a);
}

static unsigned long long dice = 1;
static unsigned drawn(void)                                        /* Knuth's MMIX */
{
    dice = dice*6364136223846793005u + 1442695040888963407u;
    return (unsigned)(dice >> 33);
}
static int one_of(int n) { return (int)(drawn()%(unsigned)n); }

static plan steps_of(const scene *s, real of_period, void (*drive)(gvi_stepper *, const plan *))
{
    plan p = { .h = of_period*s->period, .drive = drive };
    const double all = floor(1/(double)of_period + .5);
    p.count = all > 512 ? 20 : (int)all;
    now.share = fmin(1, (double)of_period*p.count);
    return p;
}

static void measure_growth(void)
{
    const scene *s = now.s;
    const written w = plainly(s);
    const plan p = steps_of(s, R(1)/32, by_step);
    const double tau = tau_of(s);
    now.size = norm_of(s->n, now.start.q, now.start.v, tau);
    now.growth = 1;
    const outcome a = run_from(&w, &p, &now.start);
    if (a.status != GVI_OK) return;
    now.size = fmax(now.size, norm_of(s->n, a.q, a.v, tau));
    for (int k = 0; k < 4; ++k) {
        const double by = sqrt((double)EPS)*now.size;
        state other = now.start;
        for (int i = 0; i < s->n; ++i) {
            other.q[i] += (real)(drawn() & 256 ? by : -by);
            other.v[i] += (real)((drawn() & 256 ? by : -by)/tau);
        }
        other = state_on_rows(s, other);
        const outcome b = run_from(&w, &p, &other);
        if (b.status == GVI_OK) now.growth = fmax(now.growth, distance(&b, 1, &a)/by);
    }
}

/* ---- the best that is pinned */

typedef struct best { int have; outcome end; double fixed, any, steps; int by; unsigned served; gvi_status status; } best;

static best best_pinned(const written *as, const plan *p, const char *name)
{
    best b = { 0, { 0 }, INFINITY, INFINITY, INFINITY, 0, 0, GVI_OK };
    for (int form = GVI_EXPLICIT; form <= GVI_NEWTON; ++form) {
        written w = *as;
        w.formulation = (gvi_formulation)form;
        const outcome a = run_from(&w, p, &now.start);
        b.status = a.status;
        if (a.status == GVI_E_FORMULATION || (has_clock(now.s) && form == GVI_NEWTON)) continue;
        if (name) count_run(name, &a);
        if (a.status || a.stuck) {
            if (name && b.have && form == GVI_NEWTON) fails(name, REFUSED, a.why);
            continue;
        }
        if (b.have && name && w.dial == 0 && distance(&a, as->copies, &b.end) > 2*roundings(as, a.steps)) {
            char text[80];
            snprintf(text, sizeof text, "formulation %d, off by %.1e, %.1e is rounding", form, distance(&a, as->copies, &b.end),
                     roundings(as, a.steps));
            fails(name, WRONG, text);
        }
        if (!b.have) b.end = a;
        b.have = 1;
        b.served |= 1u << form;
        b.any = fmin(b.any, a.cost);
        if (form < GVI_NEWTON || b.fixed == INFINITY) b.fixed = fmin(b.fixed, a.cost), b.by = form;
        b.steps = fmin(b.steps, (double)a.steps);
    }
    return b;
}

/* ---- one run against the best */

static int is_off(const char *name, const outcome *a, double off, double allowed)
{
    char text[120];
    relation *r = relation_of(name);
    if (off <= allowed) { r->worst = fmax(r->worst, off/allowed); return 0; }
    snprintf(text, sizeof text, "off by %.2e, %.2e is allowed, %ld steps, growth %.1e", off, allowed, a->steps, now.growth);
    fails(name, WRONG, text);
    return 1;
}

/* by: how the plain one is written, went */
static int is_refused(const char *name, const outcome *a, gvi_status as)
{
    if (!a->stuck && a->status == as) return a->status != GVI_OK;
    fails(name, REFUSED, a->stuck ? "never ends" : a->status ? a->why : "ok where the other is refused");
    return 1;
}

static void judge_cost(const char *name, const outcome *a, const best *b)
{
    char text[120];
    const int turned = a->newton > 0 && b->fixed > 0 && b->by < GVI_NEWTON;
    const double cost = turned ? b->any : b->fixed, one_more = (double)a->steps*a->iteration;
    const double allowed = turned ? 1.2*cost + 60*a->points : fmax(1.5*cost, cost + one_more);
    if (a->cost <= allowed + 20) return;
    snprintf(text, sizeof text, "%.2f of the best pinned, %.0f, newton %ld, formulation %d", a->cost/cost, cost, a->newton, a->formulation);
    fails(name, DEAR, text);
}

static void judge_steps(const char *name, const outcome *a, double steps)
{
    char text[80];
    if ((double)a->steps <= 2*steps + 3) return;
    snprintf(text, sizeof text, "%ld steps, the best takes %.0f", a->steps, steps);
    fails(name, DEAR, text);
}

static void describe(const written *w, const char *text, double at)
{
    static const char *const rules[] = { "gauss", "lobatto", "own", "kicks" };
    const char *more = w->points > w->degree && w->rule == GVI_GAUSS ? " r > s" : "";
    snprintf(now.how, sizeof now.how, "degree %d %s%s, %s %.3g", w->degree, rules[w->rule], more, text, at);
}

static outcome written_run(const char *name, const written *w, const plan *p)
{
    const outcome a = run_from(w, p, &now.start);
    count_run(name, &a);
    return a;
}

static int fits(const way *x, const scene *s) { return !x->fits || x->fits(s); }

/* ---- steps of one length */

typedef struct method { int degree; gvi_rule_kind rule; int points; } method;

static written written_by(const scene *s, const method *m)
{
    written w = plainly(s);
    w.degree = m->degree;
    w.rule = m->rule;
    w.points = m->points;
    return w;
}

static void judge_way(const way *x, const written *base, const plan *p, const best *b, gvi_status plain_status)
{
    written w = *base;
    x->change(&w);
    const outcome a = written_run(x->name, &w, p);
    if (is_refused(x->name, &a, plain_status)) return;
    is_off(x->name, &a, distance(&a, w.copies, &b->end), roundings(&w, a.steps));
    if (x->frame) judge_cost(x->name, &a, b);
    else {
        const best own = best_pinned(&w, p, NULL);
        judge_cost(x->name, &a, &own);
    }
}

/* Each formulation that serves the plain scene serves it elsewhere */
static void judge_pinned_elsewhere(const written *base, const plan *p, const best *b)
{
    static void (*const frames[])(written *) = { planets, all_of_it };
    for (int k = 0; k < 2; ++k)
        for (int form = GVI_EXPLICIT; form <= GVI_NEWTON; ++form) {
            written w = *base;
            if (!(b->served >> form & 1)) continue;
            frames[k](&w);
            w.formulation = (gvi_formulation)form;
            const outcome a = written_run("pinned, other frames", &w, p);
            if (is_refused("pinned, other frames", &a, GVI_OK)) continue;
            is_off("pinned, other frames", &a, distance(&a, 1, &b->end), roundings(&w, a.steps));
        }
}

/* Ways of driving: the same steps; back again; half of it and the rest */
static void judge_drives(const written *w, const plan *p, const outcome *plain)
{
    static const struct { const char *name; void (*drive)(gvi_stepper *, const plan *); int back; } drives[] = {
        { "gvi_steps", by_steps, 0 }, { "queries in between", by_pairs, 0 }, { "saved and restored", restored, 0 },
        { "there and back", there_and_back, 1 } };
    for (int k = 0; k < COUNT(drives); ++k) {
        plan q = *p;
        q.drive = drives[k].drive;
        q.back = drives[k].back;
        const outcome a = written_run(drives[k].name, w, &q);
        if (is_refused(drives[k].name, &a, GVI_OK)) continue;
        outcome to = *plain;
        for (int i = 0; q.back && i < now.s->n; ++i) to.q[i] = now.start.q[i], to.v[i] = now.start.v[i];
        is_off(drives[k].name, &a, distance(&a, 1, &to), q.back ? 2*roundings(w, a.steps) : 0);
    }
}

/* Half of h changes an end by D: it was off by about D */
static double change_by_half(const written *w, const plan *p, outcome *fine)
{
    plan half = *p;
    half.h /= 2;
    half.count *= 2;
    const outcome a = run_from(w, p, &now.start);
    *fine = run_from(w, &half, &now.start);
    return a.status || fine->status ? -1 : distance(&a, 1, fine);
}

static const scene *scene_named(const char *name)
{
    for (int k = 0; k < SCENES; ++k) if (!strcmp(scenes[k].name, name)) return scenes + k;
    printf("no scene is called %s\n", name);
    exit(1);
}

static void in_other_coordinates(const scene *s, outcome *a)
{
    real Q[N] = { 0 }, V[N] = { 0 };
    if (!s->to) return;
    s->to(a->q, a->v, Q, V);
    memcpy(a->q, Q, sizeof Q);
    memcpy(a->v, V, sizeof V);
}

static void judge_like(const method *m, const plan *p, const outcome *plain)
{
    const char *name = "other coordinates";
    const scene *s = now.s, *other = scene_named(s->like);
    const written w = written_by(s, m), v = written_by(other, m);
    const state from = now.start, to = start_of(other);
    const int same = (s->tags & EXACT) && m->rule == GVI_GAUSS && !m->points;
    outcome a = *plain, fine, other_fine, b;
    const double mine = change_by_half(&w, p, &fine);
    in_other_coordinates(s, &a);
    in_other_coordinates(s, &fine);
    now.start = to;
    b = run_from(&v, p, &now.start);
    const double others = change_by_half(&v, p, &other_fine);
    count_run(name, &b);
    now.s = other;                                                 /* its coordinates */
    const double off = distance(&a, 1, &b), stretch = 1 + distance(&a, 1, &a);
    now.s = s;
    now.start = from;
    if (mine < 0 || others < 0) return;
    is_off(name, &a, off, 2*roundings(&w, a.steps)*stretch + (same ? 0 : 4*(mine + others)));
}

/* Each halving of h makes the change at least 2^(order - 1) times smaller, until it is rounding */
static void judge_halves(const written *w, const plan *p, int order)
{
    outcome fine, finest;
    plan half = *p;
    half.h /= 2;
    half.count *= 2;
    const double first = change_by_half(w, p, &fine), second = change_by_half(w, &half, &finest);
    count_run("halves", &fine);
    if (first < 0 || second < 0) return;
    is_off("halves", &finest, second, ldexp(first, 1 - order) + roundings(w, 4*p->count));
}

static void fixed_steps(const method *m, real of_period, int thorough)
{
    const scene *s = now.s;
    const written w = written_by(s, m);
    const plan p = steps_of(s, of_period, by_step);
    describe(&w, "h", (double)of_period);
    const best b = best_pinned(&w, &p, "pinned");
    const outcome plain = run_from(&w, &p, &now.start);
    const char *why = plain.status ? plain.why : b.have ? NULL : "ok where all that are pinned are refused";
    const known *k = why ? fails("plain", REFUSED, why) : NULL;
    if (why && !(k && k->right)) return;               /* of a fault, its ways tell no more */
    for (int e = 0; e < WAYS; ++e)
        if (fits(ways + e, s) && (thorough || ways[e].frame)) judge_way(ways + e, &w, &p, &b, plain.status);
    if (plain.status) return;
    if (thorough) judge_drives(&w, &p, &plain);
    if (thorough) judge_pinned_elsewhere(&w, &p, &b);
    if (s->like) judge_like(m, &p, &plain);
}

/* ---- by the dial */

static outcome reference_of(const scene *s)
{
    written w = plainly(s);
    const plan p = { .h = s->period/512, .count = 512, .drive = by_step };
    outcome a = run_from(&w, &p, &now.start);
    for (int form = GVI_POSITIONS; form <= GVI_NEWTON && a.status; ++form) {
        w.formulation = (gvi_formulation)form;
        a = run_from(&w, &p, &now.start);
    }
    return a;
}

/* Modes that are rounding of q in h v count as no error (gvi__modes_end), so a step may be off by that, or by the dial */
static double resolution_of(const written *w, const outcome *a)
{
    const double steps = (double)a->steps, rounding = 4*(double)EPS*(1 + shift_of(w))*steps*tau_of(now.s)/(double)now.s->period;
    return fmax(a->resolution, fmin((double)w->dial, rounding));
}

static double allowed_by_dial(const written *w, const outcome *a)
{
    const double time = (double)EPS*fabs((double)(w->date/w->time))/tau_of(now.s);   /* the end is rounded to t's places */
    return (10*(double)a->steps + 190)*resolution_of(w, a)*now.growth*now.size*(1 + shift_of(w)) + roundings(w, a->steps + 512) + 4*time*now.size;
}

/* One run by the dial against the reference and the steps of the best that is pinned; how far it is off, or -1 */
static double judge_dial(const char *name, const written *w, const plan *p, const outcome *ref, double steps)
{
    const outcome a = written_run(name, w, p);
    if (is_refused(name, &a, GVI_OK)) return -1;
    judge_steps(name, &a, steps);
    if (ref->status) return -1;
    const double off = distance(&a, w->copies, ref);
    is_off(name, &a, off, allowed_by_dial(w, &a));
    return off;
}

static plan whole_period(const scene *s)
{
    const plan p = { .h = s->period, .count = 1, .drive = by_dial };
    now.share = 1;
    return p;
}

static void by_the_dial(int degree, double dial, int thorough, double *last)
{
    static char names[WAYS][48];
    const scene *s = now.s;
    const plan p = whole_period(s);
    written w = plainly(s);
    w.degree = degree;
    w.dial = (real)dial;
    describe(&w, "dial", dial);
    const outcome ref = reference_of(s);
    const best b = best_pinned(&w, &p, NULL);
    for (int k = 0; k < WAYS; ++k) {
        written x = w;
        if (!fits(ways + k, s) || !(thorough || ways[k].frame)) continue;
        snprintf(names[k], sizeof names[k], "%s, dial", ways[k].name);
        ways[k].change(&x);
        const double off = judge_dial(names[k], &x, &p, &ref, b.steps);
        if (k || off < 0) continue;
        const double rounding = allowed_by_dial(&w, &ref), promised = dial*now.growth*now.size;
        count_run("stricter dial", NULL);
        if (*last >= 0 && off > promised) is_off("stricter dial", &ref, off, 2**last + rounding);
        *last = off;
    }
}

static void by_hand(double dial)
{
    written w = plainly(now.s);
    const plan p = { .h = now.s->period, .count = 1, .drive = halving };
    w.dial = (real)dial;
    describe(&w, "dial", dial);
    const outcome ref = reference_of(now.s), a = written_run("halved where it fails", &w, &p);
    if (!ref.status && !is_refused("halved where it fails", &a, GVI_OK))
        is_off("halved where it fails", &a, distance(&a, 1, &ref), allowed_by_dial(&w, &a));
}

static int alike(double a, double b, double rounding)
{
    return fmax(a, b) < rounding || (a <= 2*b && b <= 2*a);
}

/* The measure of a step and the contraction are the same in other units */
static void judge_measures(real of_period)
{
    const plan p = steps_of(now.s, of_period, by_step);
    written w = plainly(now.s);
    w.dial = R(.9);
    describe(&w, "measures at h", (double)of_period);
    const outcome plain = run_from(&w, &p, &now.start);
    if (plain.status) return;
    for (int k = 1; k < WAYS; ++k) {
        written x = w;
        if (!ways[k].frame || !fits(ways + k, now.s)) continue;
        ways[k].change(&x);
        if (shift_of(&x) > 0 || x.R[0][0] != 1) continue;
        const outcome a = written_run("measures", &x, &p);
        char text[120];
        const int counted = a.contraction > 0 && plain.contraction > 0;       /* 0: no mean of two */
        if (a.status || (alike(a.resolution, plain.resolution, 100*(double)EPS)
                         && (!counted || alike(a.contraction, plain.contraction, .01)))) continue;
        snprintf(text, sizeof text, "%s: resolution %.1e for %.1e, contraction %.1e for %.1e", ways[k].name, a.resolution,
                 plain.resolution, a.contraction, plain.contraction);
        fails("measures", UNLIKE, text);
    }
}

/* ---- everything of a scene */

static int covers(const scene *s, const method *m)
{
    if (m->rule == GVI_KICKS)
        return !s->mass && !s->massless && !has_rows(s) && !has_clock(s) && !has_kind(s, GVI_FORCE) && !has_kind(s, GVI_LAGRANGIAN);
    return !has_clock(s) || (m->rule == GVI_GAUSS && !m->points);                 /* a clock needs r = s */
}

static void begin_scene(const scene *s)
{
    now.s = s;
    now.start = start_of(s);
    snprintf(now.how, sizeof now.how, "growth");
    measure_growth();
}

/* Float has 7 digits */
static double dial_of(int digits) { return pow(10, KIND == 1 ? -digits/2 : -digits); }

/* Of the other types less: they have the same code, and long double is slow */
static void all_ways_of(const scene *s)
{
    static const real parts[] = { R(1)/8, R(1)/32, R(1)/256, R(1e-4), R(1e-6) };
    static const method methods[] = { { 3, GVI_GAUSS, 0 }, { 4, GVI_LOBATTO, 0 }, { 6, GVI_GAUSS, 7 }, { 12, GVI_GAUSS, 0 },
                                      { 1, GVI_LOBATTO, 0 }, { 1, GVI_KICKS, 3 } };
    static const method usual = { 8, GVI_GAUSS, 0 };
    if (shown_scene && !strstr(s->name, shown_scene)) return;
    begin_scene(s);
    for (int k = 0; k < COUNT(parts); ++k) if (KIND == 2 || k%2) fixed_steps(&usual, parts[k], k == 1 || k == 3);
    for (int k = 0; k < COUNT(methods); ++k)
        if (covers(s, methods + k) && (KIND == 2 || k < 2)) fixed_steps(methods + k, R(1)/32, 0);
    const written third = written_by(s, methods);
    const plan p = steps_of(s, R(1)/64, by_step);
    describe(&third, "h", 1/64.0);
    judge_halves(&third, &p, 6);
    if (has_clock(s)) return;
    judge_measures(R(1)/32);
    double last = -1;
    for (int k = 0; k < 4; ++k) if (KIND == 2 || k == 1) by_the_dial(8, dial_of(3*(k + 1)), k == 1, &last);
    last = -1;
    if (KIND == 2) by_the_dial(4, dial_of(5), 0, &last);
    by_hand(dial_of(6));
}

/* ---- drawn */

static double between(double lo, double hi) { return lo + (hi - lo)*drawn()/2147483648.0; }

/* One to three ways that fit, in w; in bare those of them that are not of the frame */
static void draw_ways(const scene *s, written *w, written *bare, char *name, size_t size)
{
    const int count = 1 + one_of(3);
    snprintf(name, size, "drawn: ");
    for (int k = count, tries = 0; k && tries < 20; ++tries) {
        const way *x = ways + 1 + one_of(WAYS - 1);
        const size_t end = strlen(name);
        if (!fits(x, s) || strstr(name, x->name) || (w->rule == GVI_KICKS && !x->frame)) continue;
        snprintf(name + end, size - end, "%s%s", k < count ? " + " : "", x->name);
        x->change(w);
        if (!x->frame) x->change(bare);
        --k;
    }
}

static plan draw_plan(const scene *s)
{
    static void (*const drives[])(gvi_stepper *, const plan *) = { by_step, by_steps, by_pairs, restored };
    const real usual = (real)(1/floor(pow(2, between(5, 8)))), tiny = (real)pow(10, between(-7, -3));
    return steps_of(s, one_of(3) ? usual : tiny, drives[one_of(COUNT(drives))]);
}

static void judge_drawn(const written *w, const written *bare, const plan *p)
{
    const best b = best_pinned(bare, p, "drawn, pinned");
    if (!b.have) {                                     /* nothing to compare with */
        const outcome plain = run_from(bare, p, &now.start);
        if (plain.status) fails("drawn", REFUSED, plain.why);
        return;
    }
    const outcome a = written_run("drawn", w, p);
    if (is_refused("drawn", &a, GVI_OK)) return;
    is_off("drawn", &a, distance(&a, w->copies, &b.end), roundings(w, a.steps));
    judge_cost("drawn", &a, &b);
}

static void draw_dial(void)
{
    const scene *s = scenes + one_of(SCENES);
    char name[160];
    if (has_clock(s)) return;
    begin_scene(s);
    const plan p = whole_period(s);
    written w = plainly(s), bare;
    w.degree = 3 + one_of(8);
    w.dial = (real)pow(10, between(KIND == 1 ? -6 : -13, -2));
    bare = w;
    draw_ways(s, &w, &bare, name, sizeof name);
    describe(&w, "dial", (double)w.dial);
    now.ways = name;
    const outcome ref = reference_of(s);
    judge_dial("drawn, dial", &w, &p, &ref, best_pinned(&bare, &p, NULL).steps);
    now.ways = NULL;
}

static void draw_one(void)
{
    const scene *s = scenes + one_of(SCENES);
    const int degree = 1 + one_of(10);
    const method drawn_from[] = { { degree, GVI_GAUSS, 0 }, { degree, GVI_GAUSS, degree + 1 }, { degree, GVI_LOBATTO, 0 }, { 1, GVI_KICKS, 3 } };
    const method m = drawn_from[one_of(COUNT(drawn_from))];
    char name[160];
    if (!covers(s, &m)) return;
    begin_scene(s);
    written w = written_by(s, &m), bare = w;
    const plan p = draw_plan(s);
    draw_ways(s, &w, &bare, name, sizeof name);
    describe(&w, "h", (double)(p.h/s->period));
    now.ways = name;
    judge_drawn(&w, &bare, &p);
    now.ways = NULL;
}

static int draw_for(double seconds, unsigned long number)
{
    if (!number) number = (unsigned long)time(NULL);
    printf("everyday: drawn by the seed %lu\n", number);
    dice = number*2862933555777941757u + 3037000493u;
    while ((double)clock()/CLOCKS_PER_SEC < seconds) one_of(4) ? draw_one() : draw_dial();
    return verdict(0);
}

#endif
