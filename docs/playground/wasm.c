/* wasm.c - the playground's program: gvi.h, the scenes and the rivals behind a dozen functions

   Compiled to WebAssembly for the page, and natively for tests/playground, which compares every
   number to the bit.  Nothing is imported; sines are its own, the same everywhere.

   There are three worlds: 0 is what one sees move, 1 runs the races for "Cost", 2 tries
   settings out.                                                                           */
#include <math.h>
#include <tgmath.h>

/* Sine (turns = 0) and cosine (1), to about an ulp for |x| below 8000; NaN beyond, which ends in a
   status.  Without branches or integers, so that loops over points become vectors.  Of the pieces
   of pi/2 the first two have 8 and 11 bits: their products with n are exact.              */
static double bounded_sine(double x, double turns)
{
    const double n = __builtin_floor(x*0.63661977236758134308 + 0.5), k = n + turns;
    const double half = __builtin_floor(k/2), odd = k - 2*half, lower = half - 2*__builtin_floor(half/2);
    const double r = ((x - n*1.5703125) - n*4.83751296997070312e-4) - n*7.54978995489188211e-8, z = r*r;
    const double s = r + r*z*(-1/6.0 + z*(1/120.0 + z*(-1/5040.0 + z*(1/362880.0 + z*(-1/39916800.0
                   + z*(1/6227020800.0 + z*(-1/1307674368000.0 + z/355687428096000.0)))))));
    const double c = 1 + z*(-1/2.0 + z*(1/24.0 + z*(-1/720.0 + z*(1/40320.0 + z*(-1/3628800.0
                   + z*(1/479001600.0 + z*(-1/87178291200.0 + z/20922789888000.0)))))));
    const double y = odd > 0 ? c : s, signed_y = lower > 0 ? -y : y;
    return x > -8000 && x < 8000 ? signed_y : NAN;
}
#undef sin
#undef cos
#define sin(x) bounded_sine(x, 0)
#define cos(x) bounded_sine(x, 1)

#define GVI_NO_RULES
#define GVI_NO_BOUNDARY
#define GVI_NO_RESTORE
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#include "gvi.h"
#include "rivals.h"
#include "own.h"

#ifdef __wasm__
#define EXPORT(name) __attribute__((export_name(#name))) name
#else
#define EXPORT(name) name
#endif

enum { ARENA = 1 << 17,                /* numbers that a stepper may use: 1 MB             */
       WORLDS = 3 };
enum { RULE_GAUSS, RULE_GAUSS_MORE, RULE_LOBATTO, RULE_VERLET, RULE_KICKS8, RULES };

typedef struct world {
    const scene *scene;
    scene_setup  setup;
    gvi_effect   effects[SCENE_EFFECTS];
    int          listed[SCENE_EFFECTS];              /* row of each                        */
    unsigned     on;
    gvi_desc     desc;
    gvi_stepper  st;
    int          open, pinned, chosen[2];             /* degree and rule given to world_open */
    const char  *call, *wrong;                       /* that world_open made last; what it refused itself */
    double       dial, from;                         /* desc.resolution; where world_open began */
    double       t, q[SCENE_MOST], v[SCENE_MOST], p[SCENE_MOST], before[SCENE_MOST];
    double       total[SCENE_EFFECTS], steps, iterations, evaluations;
    lagrangian   L;                                  /* of the visitor's scene             */
    hamiltonian  H;
    rival        rival;
    int          method;                             /* of a race; 0: gvi.h                */
    double       step, end, done, count;             /* of a race                          */
    double       memory[ARENA];
} world;

static world worlds[WORLDS];
static double out[3*SCENE_BODIES + 2*SCENE_MOST];
static double values[SCENE_PARAMETERS + 1];          /* the last one: the dial, 0 for none */
static double kick_table[36];                        /* 18 nodes, 18 weights               */

enum { SCENES = sizeof scenes/sizeof *scenes };

/* The visitor's own is the last one.                                                      */
static const scene *scene_at(int i)
{
    return i >= 0 && i < SCENES ? scenes[i] : i == SCENES ? &own_scene : NULL;
}

static void scene_ready(const scene *a, scene_setup *s, const double *value)
{
    memset(s, 0, sizeof *s);
    for (int i = 0; i < SCENE_PARAMETERS; ++i) s->value[i] = value ? value[i] : a->parameter[i].value;
    a->build(s);
}

/* ------------------------------------------------ what the page asks about scenes */

int EXPORT(scene_count)(void) { return SCENES + 1; }

const char *EXPORT(scene_text)(int scene, int field, int i)
{
    static scene_setup s;
    const struct scene *a = scene_at(scene);
    if (!a) return "";
    scene_ready(a, &s, NULL);
    switch (field) {
    case 0: return a->name;
    case 1: return a->title;
    case 2: return a->about;
    case 3: return a->time_unit;
    case 4: return a->error_unit;
    case 5: return a->text;
    case 6: return a->make ? a->make : "";
    case 7: return s.mass_text ? s.mass_text : "";
    case 8: return a->length_unit ? a->length_unit : "";
    case 10: return i < s.rows ? s.row[i].name : "";
    case 11: return i < s.rows ? s.row[i].what : "";
    case 12: return i < s.rows ? s.row[i].text : "";
    case 20: return i < SCENE_PARAMETERS && a->parameter[i].name ? a->parameter[i].name : "";
    case 21: return i < SCENE_PARAMETERS && a->parameter[i].unit ? a->parameter[i].unit : "";
    case 30: return i < SCENE_QUANTITIES && a->quantity[i].name ? a->quantity[i].name : "";
    case 31: return i < SCENE_QUANTITIES && a->quantity[i].unless ? a->quantity[i].unless : "";
    default: return "";
    }
}

double EXPORT(scene_number)(int scene, int field, int i)
{
    static scene_setup s;
    const struct scene *a = scene_at(scene);
    if (!a) return 0;
    scene_ready(a, &s, NULL);
    switch (field) {
    case 0: return a->n;
    case 1: return a->degree;
    case 2: return a->h;
    case 3: return a->span;
    case 4: return a->speed;
    case 5: return a->bodies;
    case 6: return a->space;
    case 7: return a->view;
    case 8: return a->centre[i];
    case 9: return a->trails;
    case 10: return a->fixed;
    case 11: return a->radius[i];
    case 20: return s.rows;
    case 21: return s.row[i].on;
    case 22: return s.row[i].effect.kind;
    case 30: return a->parameter[i].low;
    case 31: return a->parameter[i].high;
    case 32: return a->parameter[i].step;
    case 33: return a->parameter[i].value;
    case 40: return a->rod[i].first;
    case 41: return a->rod[i].step;
    case 42: return a->rod[i].count;
    default: return 0;
    }
}

/* ------------------------------------------------------------------ a world */

/* The visitor's L or H, own.h: to be filled before own_take, which says what is wrong or nothing. */
double *EXPORT(own_room)(void) { return own_typed; }

const char *EXPORT(own_take)(int n, int length, int whole, int points, double span)
{
    const char *wrong = own_set(n, length, whole, points, span);
    return wrong ? wrong : "";
}

/* To be filled before world_open.                                                         */
double *EXPORT(parameters)(void) { return values; }

/* Kahan and Li's composition of 17 Stoermer-Verlet steps, order 8, as kicks               */
static void kicks_of_order_8(void)
{
    double gamma[17], middle = 1, at = 0;
    for (int i = 0; i < 8; ++i) gamma[i] = gamma[16-i] = kahan_li8[i], middle -= 2*kahan_li8[i];
    gamma[8] = middle;
    for (int i = 0; i < 18; ++i) {
        kick_table[i] = i < 17 ? at : 1;
        kick_table[18+i] = ((i > 0 ? gamma[i-1] : 0) + (i < 17 ? gamma[i] : 0))/2;
        at += i < 17 ? gamma[i] : 0;
    }
}

double *EXPORT(kicks)(void)
{
    kicks_of_order_8();
    return kick_table;
}

static void world_rule(gvi_desc *desc, int degree, int rule)
{
    static const double verlet_nodes[] = { 0, 1 }, verlet_weights[] = { 0.5, 0.5 };
    desc->degree = degree;
    if (rule == RULE_GAUSS_MORE) desc->rule.points = degree + 2;
    if (rule == RULE_LOBATTO) desc->rule.kind = GVI_LOBATTO;
    if (rule == RULE_VERLET) desc->rule = (gvi_rule){ GVI_KICKS, 2, verlet_nodes, verlet_weights };
    if (rule == RULE_KICKS8) {
        kicks_of_order_8();
        desc->rule = (gvi_rule){ GVI_KICKS, 18, kick_table, kick_table + 18 };
    }
    if (desc->rule.kind == GVI_KICKS) desc->degree = 1;
}

static void world_remember(world *w)
{
    w->t = w->st.t;
    memcpy(w->q, w->st.q, sizeof(double)*(size_t)w->st.n);
    memcpy(w->p, w->st.p, sizeof(double)*(size_t)w->st.n);
    if (w->setup.momenta) memcpy(w->v, w->p, sizeof w->v);
    else gvi_velocity(&w->st, w->v);
}

static int world_start(world *w, double t, const double *q, const double *v)
{
    return w->setup.momenta ? gvi_start_momentum(&w->st, t, q, v) : gvi_start(&w->st, t, q, v);
}

/* Where nothing changed but constraints that the stepper lists: breaks or mounts them.  1: no.  */
static int world_switch(world *w, unsigned changed)
{
    unsigned listed = 0;
    for (int e = 0; e < w->desc.effect_count; ++e)
        if (w->effects[e].kind >= GVI_CONSTRAINT) listed |= 1u << w->listed[e];
    if (!changed || changed & ~listed) return 1;
    for (int e = 0; e < w->desc.effect_count; ++e) {
        const unsigned bit = 1u << w->listed[e];
        const int status = changed & bit ? gvi_switch(&w->st, e, !(w->on & bit)) : GVI_OK;
        if (status != GVI_OK) return status;
        w->on ^= changed & bit;
    }
    return GVI_OK;
}

/* Sets a scene up with the effects in `on` and starts it, or goes on from where it is.  Effects
   that are off are not in the list: the library chooses its formulation by what is left.  */
int EXPORT(world_open)(int which, int index, unsigned on, int degree, int rule, double tolerance, int keep)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    const scene *a = scene_at(index);
    int reads = 0;
    w->wrong = NULL;
    if (!a) return GVI_E_ARGUMENT;
    if (w->open && keep) world_remember(w);
    keep = keep && w->scene == a;
    w->steps = w->iterations = w->evaluations = 0;
    memset(w->total, 0, sizeof w->total);
    w->call = "gvi_switch";
    const double dial = values[SCENE_PARAMETERS];
    if (keep && w->open && w->chosen[0] == degree && w->chosen[1] == rule && !(w->desc.tolerance < tolerance)
        && !(w->desc.tolerance > tolerance) && !(w->dial < dial) && !(w->dial > dial)) {
        w->from = w->st.t;
        const int status = world_switch(w, on ^ w->on);
        if (status <= 0) return status;
    }
    w->call = "gvi_init";
    w->open = w->pinned = 0;
    w->scene = a;
    w->on = on;
    w->chosen[0] = degree;
    w->chosen[1] = rule;
    w->dial = dial;
    scene_ready(a, &w->setup, values);
    if (a == &own_scene) own_mount(&w->setup, &w->L, &w->H);
    if (!keep) {                                     /* to be seen even if it does not start */
        w->t = 0;
        memcpy(w->q, w->setup.q, sizeof w->q);
        memcpy(w->v, w->setup.v, sizeof w->v);
    }
    if (degree < 1) w->wrong = "degree is not 1 or more";
    if (rule < 0 || rule >= RULES) w->wrong = "rule is not one of the list";
    else if (w->setup.momenta && rule != RULE_GAUSS) w->wrong = "for H the rule is Gauss, with as many points as degrees";
    if (w->wrong) return GVI_E_ARGUMENT;
    w->desc = (gvi_desc){ .n = a->n, .mass = w->setup.mass, .tolerance = tolerance, .resolution = dial };
    for (int i = 0; i < w->setup.rows; ++i) {
        if (!(on >> i & 1)) continue;
        reads |= w->setup.row[i].effect.kind;
        w->listed[w->desc.effect_count] = i;
        w->effects[w->desc.effect_count++] = w->setup.row[i].effect;
    }
    if (w->desc.effect_count > 0) w->desc.effects = w->effects;
    world_rule(&w->desc, degree, rule);
    if (reads & GVI_CONSTRAINT) w->desc.mass.velocity = NULL;
    /* Newton's method needs the square of s n: for a large scene the formulation is pinned */
    if (a->n > 12 && gvi_size(&w->desc) > sizeof w->memory && a->n*degree > 300) {
        w->desc.formulation = reads ? GVI_VELOCITIES : GVI_POSITIONS;
        w->pinned = 1;
    }
    if (w->setup.momenta) w->desc.formulation = GVI_MOMENTA;
    int status = gvi_init(&w->st, &w->desc, w->memory, sizeof w->memory);
    if (status == GVI_OK)
        w->call = "gvi_start", status = keep ? world_start(w, w->t, w->q, w->v) : world_start(w, 0, w->setup.q, w->setup.v);
    w->open = status == GVI_OK;
    if (w->open) {
        world_remember(w);
        w->from = w->t;
        memcpy(w->before, w->q, sizeof w->before);
    }
    return status;
}

/* A step of h; with the dial as long as it allows, back to where world_open began at most. */
static int one_step(world *w, double h, double end)
{
    return w->dial > 0 ? gvi_advance(&w->st, end) : gvi_step(&w->st, h);
}

/* Points at which effects were evaluated; without any, the mass matrix.                    */
static double world_points(const world *w)
{
    const gvi_counters *c = &w->st.counters;
    double most = w->desc.effect_count > 0 ? 0 : (double)c->mass;
    for (int e = 0; e < w->desc.effect_count; ++e)
        if ((double)c->effect[e] > most) most = (double)c->effect[e];
    return most;
}

/* Steps, counted for what they are: queries leave no mark.                                */
static int world_step(world *w, double h)
{
    gvi_counters *c = &w->st.counters;
    memset(c, 0, sizeof *c);
    memcpy(w->before, w->st.q, sizeof(double)*(size_t)w->st.n);
    const int status = one_step(w, h, h < 0 ? w->from : w->st.t + w->scene->span);
    for (int e = 0; e < w->desc.effect_count; ++e) w->total[w->listed[e]] += (double)c->effect[e];
    w->evaluations += world_points(w);
    w->iterations += (double)(c->iterations + c->newton_iterations);
    w->steps += status == GVI_OK;
    return status;
}

int EXPORT(world_advance)(int which, double h, int count)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    if (!w->open) return GVI_E_STATE;
    for (int k = 0; k < count; ++k) {
        const int status = world_step(w, h);
        if (status != GVI_OK) return status;
    }
    return GVI_OK;
}

/* The largest |g| or slip of the constraints that act.                                    */
static double world_gap(const world *w, double t, const double *q, const double *v)
{
    static double g[SCENE_ROWS], rate[SCENE_ROWS], G[SCENE_ROWS*SCENE_MOST];
    const int m = scene_hold(&w->setup, w->on, w->scene->n, t, q, v, g, G, rate);
    double most = m < 0 ? NAN : 0;
    for (int a = 0; a < m; ++a) most = fabs(g[a]) > most || g[a] != g[a] ? fabs(g[a]) : most;
    return most;
}

double EXPORT(world_number)(int which, int field, int i)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    double E = 0, kept[SCENE_QUANTITIES] = { 0 };
    switch (field) {
    case 0: return w->open ? w->st.t : w->t;
    case 1: return w->steps;
    case 2: return w->iterations;
    case 3: return i >= 0 && i < SCENE_EFFECTS ? w->total[i] : 0;
    case 4: return w->st.formulation;
    case 5: return w->st.h;
    case 6: return w->pinned;
    case 7: return w->st.s;
    case 8: return w->st.r;
    case 9: return w->st.n;
    case 10: return (double)gvi_size(&w->desc);
    case 11: return w->st.fault.effect >= 0 && w->st.fault.effect < w->desc.effect_count
                  ? w->listed[w->st.fault.effect] : -1;
    case 12: return w->evaluations;
    case 20: return w->open && gvi_energy(&w->st, &E) == GVI_OK ? E : NAN;
    case 21:
        if (!w->open || !w->scene->quantities) return NAN;
        world_remember(w);
        w->scene->quantities(w->q, w->v, w->p, kept);
        return kept[i];
    case 22:
        if (!w->open) return NAN;
        world_remember(w);
        return world_gap(w, w->t, w->q, w->v);
    case 30: return w->open ? w->st.q[i] : w->q[i];
    case 31: return w->open ? w->st.p[i] : w->p[i];
    case 32: return w->setup.q[i];
    case 33: return w->setup.v[i];
    case 40: return w->rival.t;
    case 41: return w->rival.evaluations;
    case 42: return rival_energy(&w->rival);
    case 43: return w->rival.y[i];
    case 44: return world_gap(w, w->rival.t, w->rival.y, w->rival.y + w->rival.n);
    default: return 0;
    }
}

const char *EXPORT(world_formulation)(int which) { return gvi_formulation_text(&worlds[(unsigned)which%WORLDS].st); }

/* What is behind a status of the world's last call; of an earlier one, what a status alone says. */
const char *EXPORT(status_text)(int which, int status)
{
    const gvi_stepper *st = &worlds[(unsigned)which%WORLDS].st;
    if (status == GVI_E_ARGUMENT && worlds[(unsigned)which%WORLDS].wrong) return worlds[(unsigned)which%WORLDS].wrong;
    return (int)st->status == status ? gvi_why(st) : gvi_status_text((gvi_status)status);
}

const char *EXPORT(world_call)(int which) { return worlds[(unsigned)which%WORLDS].call; }

static double *world_picture(const world *w, double t, const double *q, const double *p)
{
    own.time = t;
    if (w->setup.momenta) memcpy(own.p, p, sizeof own.p);
    w->scene->place(q, w->on, (double (*)[3])(void *)out);
    return out;
}

/* Of H the momenta are seen as well: q and p at time t of the last step.                   */
static double *world_picture_of_H(world *w, double t)
{
    double q[SCENE_MOST] = { 0 }, p[SCENE_MOST] = { 0 };
    if (!w->open || gvi_state_at(&w->st, t, q, NULL, p) != GVI_OK) {
        memcpy(q, w->open ? w->st.q : w->q, sizeof(double)*(size_t)w->scene->n);
        memcpy(p, w->open ? w->st.p : w->v, sizeof(double)*(size_t)w->scene->n);
    }
    return world_picture(w, t, q, p);
}

/* Where the bodies are at time t of the last step.                                        */
double *EXPORT(world_place)(int which, double t)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    static double q[SCENE_MOST];
    const double h = w->st.h, left = w->open ? t - w->st.t : 0;
    const int clock = w->open && w->on && w->setup.rows > 0
                   && w->setup.row[w->setup.rows - 1].effect.kind == GVI_CLOCK
                   && (w->on >> (w->setup.rows - 1) & 1);
    if (w->setup.momenta) return world_picture_of_H(w, t);
    memcpy(q, w->open ? w->st.q : w->q, sizeof(double)*(size_t)w->scene->n);
    scene_push[0] = scene_push[1] = 0;
    if (w->scene->place == coin_place && w->open && w->on & 2 && w->steps > 0) gvi_multipliers(&w->st, scene_push);
    if ((left > 0 || left < 0) && (h > 0 || h < 0)) {
        double tau = 1 + left/h;
        tau = tau < 0 ? 0 : tau > 1 ? 1 : tau;
        if (clock) {
            if (gvi_state_at(&w->st, t, q, NULL, NULL) != GVI_OK)
                memcpy(q, w->st.q, sizeof(double)*(size_t)w->scene->n);
        } else if (gvi_curve(&w->st, tau, q, NULL) != GVI_OK)
            for (int i = 0; i < w->scene->n; ++i) q[i] = w->before[i] + tau*(w->st.q[i] - w->before[i]);
    }
    return world_picture(w, t, q, NULL);
}

/* And on its curve, tau from 0 to 1.                                                      */
double *EXPORT(world_curve)(int which, double tau)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    static double q[SCENE_MOST];
    if (w->setup.momenta) return world_picture_of_H(w, w->st.t - (1 - tau)*w->st.h);
    if (!w->open || gvi_curve(&w->st, tau, q, NULL) != GVI_OK)
        for (int i = 0; i < w->scene->n; ++i)
            q[i] = w->open ? w->before[i] + tau*(w->st.q[i] - w->before[i]) : w->q[i];
    return world_picture(w, w->st.t - (1 - tau)*w->st.h, q, NULL);
}

/* --------------------------------------- Runge-Kutta 4, next to what one sees */

int EXPORT(ghost_open)(int which)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    if (!w->open) return GVI_E_STATE;
    world_remember(w);
    return rival_begin(&w->rival, RIVAL_RK4, w->scene->n, &w->setup, w->on, w->t, w->q, w->v, w->p);
}

int EXPORT(ghost_advance)(int which, double h, int count)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    for (int k = 0; k < count; ++k)
        if (rival_step(&w->rival, h, 0)) return GVI_E_CONVERGENCE;
    return GVI_OK;
}

double *EXPORT(ghost_place)(int which)
{
    const world *w = &worlds[(unsigned)which%WORLDS];
    return world_picture(w, w->rival.t, w->rival.y, w->rival.y + w->rival.n);
}

/* -------------------------------------------------------------------- races */

/* From the start to the end of the scene's span: method 0 is gvi.h with steps of at most
   `parameter`, or by the dial, the others rivals.h with steps of it, DOP853 with it as tolerance.  Follows
   world_open without keep.                                                                */
int EXPORT(race_begin)(int which, int method, double parameter, double span)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    if (!w->open || !(parameter > 0) || !(span > 0)) return GVI_E_ARGUMENT;
    const double steps = ceil(span/parameter - 1e-9);
    const int status = world_start(w, 0, w->setup.q, w->setup.v);
    if (status != GVI_OK) return status;
    w->method = method;
    w->end = span;
    w->done = 0;
    memset(&w->st.counters, 0, sizeof w->st.counters);
    w->count = steps;
    w->step = span/steps;
    if (method == 0) {
        if (w->dial > 0) w->count = 0;
        for (int e = 0; e < w->desc.effect_count; ++e)
            if (w->effects[e].kind == GVI_CLOCK) w->count = 0, w->step = parameter;
        return GVI_OK;
    }
    if (rival_begin(&w->rival, method, w->scene->n, &w->setup, w->on, 0, w->st.q, w->setup.v, w->st.p))
        return GVI_E_FORMULATION;
    w->rival.tolerance = parameter;
    w->rival.h = span/1000;
    return GVI_OK;
}

/* At most so many steps.  1: there, 0: not yet, below 0: a status.                        */
int EXPORT(race_steps)(int which, int count)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    for (int k = 0; k < count; ++k) {
        if (w->method == RIVAL_DOP853 ? w->rival.t >= w->end
            : w->method || w->count > 0 ? w->done >= w->count : w->st.t >= w->end) return 1;
        if (w->method) {
            if (rival_step(&w->rival, w->step, w->end)) return GVI_E_CONVERGENCE;
        } else {
            const int status = one_step(w, w->step, w->end);
            if (status != GVI_OK) return status;
        }
        w->done += 1;
    }
    return 0;
}

/* The whole race again and again, so that a clock of coarse ticks can time it.            */
int EXPORT(race_repeat)(int which, int times, double parameter)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    for (int k = 0; k < times; ++k) {
        int status = race_begin(which, w->method, parameter, w->end);
        while (status == 0) status = race_steps(which, 1 << 20);
        if (status < 0) return status;
    }
    return 1;
}

/* q at the end; NaN where there is none.  After race_number: it may evaluate once more.    */
double *EXPORT(race_end)(int which)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    const int n = w->scene->n;
    for (int i = 0; i < n; ++i) out[i] = w->method ? w->rival.y[i] : w->st.q[i];
    if (!w->method && !(w->count > 0) && gvi_state_at(&w->st, w->end, out, NULL, NULL) != GVI_OK)
        for (int i = 0; i < n; ++i) out[i] = NAN;
    return out;
}

double EXPORT(race_number)(int which, int field)
{
    world *w = &worlds[(unsigned)which%WORLDS];
    const gvi_counters *c = &w->st.counters;
    switch (field) {
    case 0: return w->done;
    case 1: return w->method ? w->rival.evaluations : world_points(w);
    case 2: return w->step;
    case 3: return (double)(c->iterations + c->newton_iterations);
    default: return 0;
    }
}
