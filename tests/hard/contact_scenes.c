/* contact_scenes.c - random contact scenes, each step judged from outside

   Balls of random radii and masses in a box, with or without weight; chains of rods over a floor and beside a wall; boards on
   up to five legs.  Random restitution, degree and length of step; one scene in three by the dial.  400 steps of each.  After
   each step the judge, with the scene's own formulas and contact_force alone:

     inside    a gap below -1e-10 of the scene
     tension   a contact that presses with lambda < 0 by more than a part of 1e-6 of the largest, or of 1, which is the scenes'
               unit: what presses is decided by the next 1/64 of the step, and where it begins lambda may be that much below 0
     energy    kinetic and potential energy and what impacts took differ from the start's by 1e-9, or they gave some
     refused   any status but CONTACT_E_PILE_UP with rest = 0, which bounces without end deserve

   Fails if one of these is seen.  Scenes that once failed come first.  contact_scenes [steps, 200000 [seed]]: scene i is
   number 1000000 seed + i; contact_scenes 1 NUMBER plays one of them again                                          */
#include "hard.h"
#include "tools/contact.h"

static double part(void) { return (uniform() + 1)/2; }
static int of(int many) { return (int)(part()*many); }                 /* 0 .. many - 1 */

enum { BALLS = 5, MOST_N = 2*BALLS, WALLS = 4*BALLS, MOST = WALLS + BALLS*(BALLS - 1)/2, SLOTS = 10 };
static const double BOX = 2;
typedef struct scene {
    int    kind, bodies, n, contacts;             /* 0: balls; 1: a chain from the origin; 2: a board on legs             */
    double radius[BALLS], mass[MOST_N], weight, e[MOST], legs[2*BALLS], floor;
} scene;

/* Walls first, 4 to a ball (a chain: floor and right wall, 2 to a bob); legs of a board at X: y + X sin(angle) */
static void gap(int a, double t, const double *q, double *phi, double *G, double *rate, void *user)
{
    const scene *s = (const scene *)user;
    (void)t, (void)rate;
    if (s->kind == 2) {
        *phi = q[1] + s->legs[a]*sin(q[2]) - s->floor, G[1] = 1, G[2] = s->legs[a]*cos(q[2]);
    } else if (s->kind == 1) {
        const int i = a;
        *phi = i % 2 ? q[i] + s->floor : 1.2 - q[i], G[i] = i % 2 ? 1 : -1;
    } else if (a < 4*s->bodies) {
        const int i = a/2;
        const double r = s->radius[i/2];
        *phi = a % 2 ? BOX - r - q[i] : BOX - r + q[i], G[i] = a % 2 ? -1 : 1;
    } else {
        int i = 0, j = 1;
        for (int k = a - 4*s->bodies; k > 0; --k) if (++j == s->bodies) ++i, j = i + 1;
        const double X = q[2*j] - q[2*i], Y = q[2*j + 1] - q[2*i + 1], d = hypot(X, Y);
        *phi = d - s->radius[i] - s->radius[j];
        G[2*j] = X/d, G[2*j + 1] = Y/d, G[2*i] = -X/d, G[2*i + 1] = -Y/d;
    }
}

static int weight(const gvi_points *x, void *user)
{
    const scene *s = (const scene *)user;
    for (int i = 1; i < (s->kind == 2 ? 2 : s->n); i += 2)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= s->weight*s->mass[i];
    return 0;
}

static int rods(const gvi_points *x, void *user)
{
    const scene *s = (const scene *)user;
    const int S = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int a = 0; a < s->bodies; ++a) {
            const double *q = x->q + 2*a*S + k, X = q[0] - (a ? q[-2*S] : 0), Y = q[S] - (a ? q[-S] : 0);
            double *G = x->jacobian + (a*s->n + 2*a)*S + k;
            x->g[a*S + k] = (X*X + Y*Y - s->radius[a]*s->radius[a])/2;
            G[0] = X, G[S] = Y;
            if (a) G[-2*S] = -X, G[-S] = -Y;
        }
    return 0;
}

static long double energy(const scene *s, const gvi_stepper *st)
{
    long double E = 0;
    for (int i = 0; i < s->n; ++i) {
        E += (long double)st->p[i]*st->p[i]/s->mass[i]/2;
        if (i % 2 && (s->kind < 2 || i == 1)) E += (long double)s->weight*s->mass[i]*st->q[i];
    }
    return E;
}

/* A scene, and where it starts: no gap is below 0 */
static void invent(scene *s, double *q, double *v)
{
    double phi, G[MOST_N], rate = 0;
    memset(s, 0, sizeof *s);
    s->kind = of(3);
    s->bodies = 2 + of(s->kind == 1 ? 2 : BALLS - 1);
    s->n = s->kind == 2 ? 3 : 2*s->bodies;
    s->contacts = s->kind == 2 ? 2 + of(4) : s->kind == 1 ? s->n : 4*s->bodies + s->bodies*(s->bodies - 1)/2;
    s->weight = of(4) ? 1 : 0;
    s->floor = s->kind == 1 ? 1.1 : uniform();
    for (int i = 0; i < s->contacts; ++i) s->e[i] = of(2) ? part() : (double)(of(2));
    for (int i = 0; i < s->bodies; ++i) s->radius[i] = s->kind == 1 ? 0.4 + 0.4*part() : 0.15 + 0.25*part();
    for (int i = 0; i < s->n; i += 2) s->mass[i] = s->mass[i + 1] = pow(10, uniform()/2);
    for (int i = 0; i < s->contacts && s->kind == 2; ++i) s->legs[i] = i < 2 ? 1 - 2*i : uniform();
    for (int again = 1; again; ) {
        again = 0;
        for (int i = 0; i < s->n; ++i) q[i] = (BOX - 0.5)*uniform(), v[i] = uniform();
        for (int a = 0; a < s->bodies && s->kind == 1; ++a) {
            const double w = 3*uniform();
            q[2*a] = (a ? q[2*a - 2] : 0) + s->radius[a]*sin(w), q[2*a + 1] = (a ? q[2*a - 1] : 0) - s->radius[a]*cos(w);
            v[2*a] = v[2*a + 1] = 0;
        }
        if (s->kind == 2) q[1] = s->floor + 1.2 + part(), q[2] = uniform()/2;
        for (int a = 0; a < s->contacts; ++a) {
            memset(G, 0, sizeof G);
            gap(a, 0, q, &phi, G, &rate, s);
            again |= phi < 0;
        }
    }
}

static struct { long steps, scenes, inside, tension, gain, refused, piled; long double deepest, most, pull; unsigned long long events; } all;

static void judge(const scene *s, contact *c, long double E0)
{
    double phi, G[MOST_N], rate = 0, force[MOST], largest = 1, E = (double)(energy(s, &c->st) - E0);
    for (int a = 0; a < s->contacts; ++a) {
        memset(G, 0, sizeof G);
        gap(a, 0, c->st.q, &phi, G, &rate, (void *)s);
        if (phi < -(double)all.deepest) all.deepest = -phi;
        all.inside += phi < -1e-10;
        largest = fmax(largest, fabs(force[a] = contact_force(c, a)));
    }
    for (int a = 0; a < s->contacts; ++a) {
        if (-force[a]/largest > (double)all.pull) all.pull = -force[a]/largest;
        all.tension += force[a] < -1e-6*largest;
    }
    if (fabs(E + c->energy) > (double)all.most) all.most = fabs(E + c->energy);
    all.gain += fabs(E + c->energy) > 1e-9*(1 + fabs((double)E0)) || c->energy < -1e-9;
}

static void play(long steps, uint64_t number)
{
    static double memory[1 << 20];
    scene s;
    double q[MOST_N], v[MOST_N];
    seed = number;
    invent(&s, q, v);
    contact c = { .count = s.contacts, .slots = s.n < SLOTS ? s.kind == 1 ? s.bodies : s.n : SLOTS, .gap = gap, .user = &s, .e = s.e,
                  .rest = of(8) ? 1e-3 : 0, .in_turn = of(4) == 0 };
    gvi_effect list[2 + SLOTS] = { { .kind = GVI_FORCE, .points = weight, .user = &s } };
    list[0].kind = GVI_POTENTIAL;
    const int others = 1 + (s.kind == 1);
    if (s.kind == 1) list[1] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = rods, .rows = s.bodies, .user = &s };
    contact_rows(&c, list + others);
    const int dial = of(3) == 0;
    const gvi_desc desc = { .n = s.n, .degree = 6 + of(3), .effects = list, .effect_count = others + c.slots,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = s.mass }, .resolution = dial ? 1e-11 : 0 };
    const double h = (s.kind == 1 ? 0.3 : 1)*(0.01 + 0.03*part());
    gvi_status status = contact_size(&c, &desc) > sizeof memory ? GVI_E_MEMORY : contact_init(&c, &desc, memory, sizeof memory);
    if (!status) status = contact_start(&c, 0, q, v);
    const long double E0 = status ? 0 : energy(&s, &c.st);
    for (long k = 0; k < steps && !status; ++k, ++all.steps) {
        status = dial ? contact_advance(&c, c.st.t + 4*h) : contact_step(&c, h);
        if (!status) judge(&s, &c, E0);
    }
    ++all.scenes;
    for (int k = 0; k < CONTACT_KINDS; ++k) all.events += c.seen[k];
    if ((int)status == CONTACT_E_PILE_UP && !(c.rest > 0)) ++all.piled;
    else if (status) {
        ++all.refused;
        printf("scene %llu, kind %d, t = %.17g: %s (contact %d)\n", (unsigned long long)number, s.kind, c.st.t, contact_why(&c, status), c.fault);
    }
}

int main(int argc, char **argv)
{
    const long steps = argc > 1 ? atol(argv[1]) : 200000;
    const uint64_t once[] = { 1000532, 1000552, 11000187, 11000566, 11001012, 11002331, 14000400 },
                   first = argc > 2 ? (uint64_t)atol(argv[2])*(steps > 1 ? 1000000 : 1) : 1000000;
    for (size_t i = 0; i < sizeof once/sizeof *once && steps > 1; ++i) play(400, once[i]);
    for (uint64_t i = 0; all.steps < steps; ++i) play(400, first + i);
    printf("%ld scenes, %ld steps, %llu events: inside %ld (deepest %.1Le), tension %ld (%.1Le), energy %ld (%.1Le), "
           "refused %ld, piled up with rest = 0 %ld\n", all.scenes, all.steps, all.events, all.inside, all.deepest, all.tension,
           all.pull, all.gain, all.most, all.refused, all.piled);
    return all.inside + all.tension + all.gain + all.refused > 0;
}
