/* contact.h - bodies that strike, rest on each other, slide and part, without friction.  For gvi.h

   One function gives the gap of each contact, phi_a(t, q) >= 0, its gradient dphi/dq [n] and rate dphi/dt,
   which both are 0 before:

     contact c = { .count = 2, .slots = 2, .gap = gap, .rest = 1e-3 };
     gvi_effect scene[1 + 2] = { { .kind = GVI_POTENTIAL, .points = weight } };
     contact_rows(&c, scene + 1);               fills the last `slots` effects of the scene
     contact_init(&c, &desc, memory, size);     contact_size(&c, &desc) bytes; c must not be moved any more
     contact_start(&c, t, q, v);
     contact_step(&c, h);                       c.st is a gvi_stepper, to be read

   Between events the contacts that press are rows of GVI_CONSTRAINT, so a step is one of gvi.h and keeps order 2s.
   An event is found on the step's curve, and the step is made again to end there, to rounding:

     impact     a gap closes.  Impulses of all touching contacts at once, Lambda >= 0 and v+ >= -e v-, one of them
                an equality: a linear complementarity problem (LCP).  Where different e would gain energy, the least
                of them counts, else 0.  Or pair by pair, the fastest first (in_turn: Newton's cradle)
     captured   if all that approach are slower than `rest`, e is 0, and what would leave slower stays: that ends
                bounces that get ever shorter
     closed     presses from here on: no normal speed, lambda >= 0, gap'' >= 0, again an LCP
     opened     presses no more, where its lambda changes sign.  At this instant the LCP is undecided: what presses
                then is its solution 1/64 of the step later, on the motion as it was.  Of contacts that depend on
                each other, as the legs of a table, as many press as are independent
     grazed     a gap that turns within its rounding

   contact_step     to t + h, with as many events in between as there are.  h < 0: back, by the same law of impact
   contact_advance  a step by desc.resolution towards t_end, to the first event at most
   contact_force    lambda of a contact: its force is lambda times the gradient; 0 where it does not press
   contact_why      a sentence about the last status
   fails            the state and what presses are as before the call, to the bit; c.fault is the contact to blame,
                    or -1.  A gvi_status, or one of CONTACT_E_..; the first start compares gradient and rate of
                    each contact with differences, as gvi.h does
   scenes           T quadratic in v; other constraints, M(q), forces as in gvi.h.  GVI_EFFECTS limits the slots
   not seen         a lambda that changes its sign twice in a step, a gap that turns twice in 1/(s + 1) of one: take
                    shorter steps.  Friction: docs/hard-cases.md

   Sources: Moreau: Unilateral contact and dry friction in finite freedom dynamics, 1988; Pfeiffer, Glocker:
   Multibody dynamics with unilateral contacts, 1996; Cottle, Pang, Stone: The linear complementarity problem, 1992,
   sec. 4.4 (Lemke's method).                                                                                    */
#ifndef CONTACT_H
#define CONTACT_H

#include "gvi.h"
#include <float.h>
#include <string.h>

#ifndef CONTACT_TOUCH
#define CONTACT_TOUCH 32                   /* contacts that touch at the same time, at most               */
#endif

enum {
    CONTACT_E_PENETRATES = -1001,          /* a gap is negative where the motion starts                   */
    CONTACT_E_JAMMED     = -1002,          /* no impulses part the contacts                               */
    CONTACT_E_PILE_UP    = -1003,          /* more events in a step than `most`                           */
    CONTACT_E_TOO_MANY   = -1004           /* more contacts press than slots, or touch than CONTACT_TOUCH */
};

typedef enum contact_kind {
    CONTACT_IMPACT, CONTACT_CAPTURED, CONTACT_CLOSED, CONTACT_OPENED, CONTACT_GRAZED, CONTACT_KINDS
} contact_kind;

struct contact;
typedef void contact_fn(int which, gvi_real t, const gvi_real *q, gvi_real *phi, gvi_real *gradient,
                        gvi_real *rate, void *user);
typedef void contact_told_fn(struct contact *c, contact_kind kind, int which);

typedef struct contact_row {               /* a slot: which contact it holds, lambda where the step starts */
    struct contact *c;
    int             which, on;
    gvi_real        lambda;
} contact_row;

typedef struct contact_set {               /* contacts that touch, at one state: normal speeds and impulses */
    int      k, which[CONTACT_TOUCH];
    gvi_real speed[CONTACT_TOUCH], tiny[CONTACT_TOUCH], z[CONTACT_TOUCH], W[CONTACT_TOUCH*CONTACT_TOUCH];
} contact_set;

typedef struct contact__samples { gvi_real *phi, *slope, *noise; } contact__samples;

typedef struct contact {
    int              count, slots;         /* contacts; rows for those that press at the same time        */
    contact_fn      *gap;
    contact_told_fn *told;                 /* of each event, c->st being there; or NULL                   */
    void            *user;                 /* handed to gap                                               */
    const gvi_real  *e;                    /* [count] restitution, or NULL: 0                             */
    gvi_real         rest, touch;          /* speed of a gap below which nothing bounces; gap that counts as 0,
                                              besides the rounding of its own terms                       */
    int              in_turn, most;        /* pair by pair; events a step, 0: 1000                        */

    gvi_stepper      st;                   /* from here on to be read                                     */
    int              fault;
    unsigned long long seen[CONTACT_KINDS], trials;                 /* events; steps made again           */
    gvi_real        *impulse;              /* [count] of the last impact                                  */
    gvi_real         energy;               /* that impacts have taken                                     */

    gvi_stepper      probe;                /* private: of degree 1, for M^-1                              */
    gvi_desc         probe_desc;
    contact_row      row[CONTACT_TOUCH];
    struct { gvi_stepper st; contact_row row[CONTACT_TOUCH]; gvi_real *memory; } saved[2];
    gvi_real        *memory, *probe_memory, *size, *left, *q, *v, *u, *w, *at, *G, *R, *touches, *lambda, h, way;
    contact__samples sample[2];
    size_t           bytes;                /* of memory, size and left                                    */
    const char      *why;
    int              first, before, fresh, at_once;  /* effect and row of slot 0; has no step been made?  */
} contact;

#if GVI__KIND == 1
static const gvi_real contact__eps = FLT_EPSILON;
#elif GVI__KIND == 2
static const gvi_real contact__eps = DBL_EPSILON;
#else
static const gvi_real contact__eps = LDBL_EPSILON;
#endif

static inline gvi_real contact__abs(gvi_real a) { return a < 0 ? -a : a; }
static inline gvi_real contact__most(gvi_real a, gvi_real b) { return a > b ? a : b; }

static inline gvi_real contact__dot(int n, const gvi_real *a, const gvi_real *b)
{
    gvi_real sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i]*b[i];
    return sum;
}

static inline gvi_status contact__fail(contact *c, int which, int status)
{
    c->fault = which;
    return (gvi_status)status;
}

/* ---- rows of the scene ---- */

static inline int contact__row(const gvi_points *x, void *user)
{
    const contact_row *row = (const contact_row *)user;
    gvi_real *q = row->c->at, *G = q + x->n;
    for (int k = 0; k < x->count; ++k) {
        gvi_real rate = 0;
        for (int i = 0; i < x->n; ++i) q[i] = x->q[i*x->stride + k], G[i] = 0;
        row->c->gap(row->which, x->t[k], q, &x->g[k], G, &rate, row->c->user);
        x->rate[k] = rate;
        for (int i = 0; i < x->n; ++i) x->jacobian[i*x->stride + k] = G[i];
    }
    return 0;
}

static inline void contact_rows(contact *c, gvi_effect *list)
{
    const gvi_effect empty = { GVI_CONSTRAINT, contact__row, NULL, NULL, NULL, NULL, 1 };
    for (int k = 0; k < c->slots && k < CONTACT_TOUCH; ++k) {
        c->row[k].c = c;
        list[k] = empty;
        list[k].user = &c->row[k];
    }
}

static inline int contact__on(const contact *c, int a)          /* its slot, or -1 */
{
    for (int k = 0; k < c->slots; ++k) if (c->row[k].on && c->row[k].which == a) return k;
    return -1;
}

/* All rows off, then on for the first `on` slots; the first status that is not ok.  */
static inline gvi_status contact__switch(contact *c, gvi_stepper *st, int on)
{
    gvi_status status = GVI_OK;
    for (int k = 0; k < c->slots && !status; ++k) status = gvi_switch(st, c->first + k, 0);
    for (int k = 0; k < on && !status; ++k) status = gvi_switch(st, c->first + k, 1);
    if (status) c->why = gvi_why(st);
    return status;
}

/* Gap and its rate of change; returns what of the gap is rounding.  The gradient is then in c->at + n.  */
static inline gvi_real contact__gap(contact *c, int a, gvi_real t, const gvi_real *q, const gvi_real *v,
                                    gvi_real *phi, gvi_real *rate)
{
    const int n = c->st.n;
    gvi_real *G = c->at + n, r = 0, terms;
    for (int i = 0; i < n; ++i) G[i] = 0;
    c->gap(a, t, q, phi, G, &r, c->user);
    terms = contact__abs(r)*(contact__abs(t) + c->h) + c->size[a];
    *rate = r + contact__dot(n, G, v);
    for (int i = 0; i < n; ++i) terms += contact__abs(G[i])*(contact__abs(q[i]) + contact__abs(c->h*v[i]));
    return 64*contact__eps*terms + c->touch;
}

static inline void contact__tell(contact *c, contact_kind kind, int a)
{
    ++c->seen[kind];
    if (c->told) c->told(c, kind, a);
}

/* ---- set-up ---- */

static inline gvi_desc contact__probe(const gvi_desc *desc)
{
    gvi_desc d = *desc;
    d.degree = d.rule.points = 1;
    d.rule.kind = GVI_GAUSS;
    d.resolution = 0;
    return d;
}

static inline gvi_real *contact__take(gvi_real *memory, size_t *used, size_t count)
{
    *used += count;
    return memory ? memory + (*used - count) : NULL;
}

/* Numbers in use, 0: gvi.h refuses the scene.  With memory, hands it out.  */
static inline size_t contact__layout(contact *c, const gvi_desc *desc, gvi_real *m)
{
    const gvi_desc probe = contact__probe(desc);
    const size_t one = sizeof(gvi_real), a = gvi_size(desc)/one, b = gvi_size(&probe)/one, n = (size_t)desc->n,
                 count = (size_t)c->count, touch = CONTACT_TOUCH;
    size_t used = 0, rows = 0;
    if (!a || !b || c->count < 0) return 0;
    for (int i = 0; i < desc->effect_count; ++i) rows += (size_t)desc->effects[i].rows;
    const struct { gvi_real **to; size_t count; } list[] = {
        { &c->memory, a }, { &c->size, count }, { &c->left, count },                 // what is saved comes first
        { &c->saved[0].memory, a + 2*count }, { &c->saved[1].memory, a + 2*count }, { &c->probe_memory, b },
        { &c->q, n }, { &c->v, n }, { &c->u, n }, { &c->w, n }, { &c->at, 2*n }, { &c->G, touch*n }, { &c->R, touch*n },
        { &c->impulse, count }, { &c->touches, count }, { &c->lambda, rows },
        { &c->sample[0].phi, count }, { &c->sample[0].slope, count }, { &c->sample[0].noise, count },
        { &c->sample[1].phi, count }, { &c->sample[1].slope, count }, { &c->sample[1].noise, count }
    };
    for (size_t i = 0; i < sizeof list/sizeof *list; ++i) *list[i].to = contact__take(m, &used, list[i].count);
    c->bytes = (a + 2*count)*one;
    return used;
}

static inline size_t contact_size(const contact *c, const gvi_desc *desc)
{
    contact copy = *c;
    return contact__layout(&copy, desc, NULL)*sizeof(gvi_real);
}

static inline gvi_status contact_init(contact *c, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    c->probe_desc = contact__probe(desc);
    c->first = desc->effect_count - c->slots;
    c->why = gvi_status_text(GVI_E_ARGUMENT);
    if (!c->gap || c->slots < 1 || c->slots > CONTACT_TOUCH || c->first < 0) return contact__fail(c, -1, GVI_E_ARGUMENT);
    c->why = gvi_status_text(GVI_E_MEMORY);
    if (!memory || size < contact_size(c, desc)) return contact__fail(c, -1, GVI_E_MEMORY);
    memset(memory, 0, contact__layout(c, desc, memory)*sizeof *memory);
    memset(c->seen, 0, sizeof c->seen);
    c->before = 0, c->trials = 0, c->energy = c->h = 0, c->way = 1;
    for (int i = 0; i < c->first; ++i) c->before += desc->effects[i].rows;
    gvi_status status = gvi_init(&c->st, desc, c->memory, gvi_size(desc));
    c->why = gvi_why(&c->st);
    if (!status) status = gvi_init(&c->probe, &c->probe_desc, c->probe_memory, gvi_size(&c->probe_desc));
    if (!status) status = contact__switch(c, &c->probe, 0);
    return contact__fail(c, -1, status);
}

/* A start in the probe, set up anew so that it compares the derivatives of each contact with differences.  The first
   step decides what becomes of contacts that touch already.  */
static inline gvi_status contact_start(contact *c, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_real phi, rate;
    gvi_status status = contact__switch(c, &c->st, 0);
    for (int k = 0; k < c->slots; ++k) c->row[k].on = 0;
    if (!status && (status = gvi_start(&c->st, t, q, v))) c->why = gvi_why(&c->st);
    if (status) return contact__fail(c, -1, status);
    memset(c->size, 0, 2*(size_t)c->count*sizeof *c->size);
    c->fresh = 1;
    for (int a = 0; a < c->count; ++a) {
        const gvi_real noise = contact__gap(c, a, t, q, v, &phi, &rate);
        if (!(phi >= -noise)) return contact__fail(c, a, CONTACT_E_PENETRATES);
        memcpy(c->u, q, (size_t)c->st.n*sizeof *c->u);
        memcpy(c->w, v, (size_t)c->st.n*sizeof *c->w);
        c->row[0].which = a;
        status = gvi_init(&c->probe, &c->probe_desc, c->probe_memory, gvi_size(&c->probe_desc));
        if (!status) status = contact__switch(c, &c->probe, 1);
        if (!status) status = gvi_project(&c->probe, t, c->u, c->w, NULL);
        c->why = gvi_why(&c->probe);
        if (status == GVI_E_ARGUMENT) return contact__fail(c, a, status);
    }
    return contact__fail(c, -1, GVI_OK);
}

/* ---- linear complementarity ---- */

enum { CONTACT__COLUMNS = 2*CONTACT_TOUCH + 2 };

/* The row that leaves when column `in` enters: the least ratio, of ties the artificial variable, 2k.  */
static inline int contact__leaves(int k, gvi_real (*T)[CONTACT__COLUMNS], const int *basis, int in, gvi_real small)
{
    int out = -1;
    for (int i = 0; i < k; ++i) {
        if (!(T[i][in] > small)) continue;
        const gvi_real a = out < 0 ? -1 : T[i][2*k + 1]*T[out][in], b = out < 0 ? 1 : T[out][2*k + 1]*T[i][in],
                       tie = small*(contact__abs(a) + contact__abs(b));
        const int better = out < 0 || (basis[out] != 2*k && (basis[i] == 2*k || T[i][in] > T[out][in]));
        if (a - b < -tie || (a - b <= tie && better)) out = i;
    }
    return out;
}

static inline void contact__pivot(int k, gvi_real (*T)[CONTACT__COLUMNS], int out, int in)
{
    const gvi_real p = T[out][in];
    for (int j = 0; j < 2*k + 2; ++j) T[out][j] /= p;
    for (int i = 0; i < k; ++i) {
        const gvi_real f = T[i][in];
        for (int j = 0; j < 2*k + 2 && i != out; ++j) T[i][j] -= f*T[out][j];
    }
}

/* Lemke's method on W scaled to a diagonal of 1, with this for zero in its pivots.  0: no z.  */
static inline int contact__lemke(int k, const gvi_real *W, const gvi_real *b, gvi_real *z, gvi_real small)
{
    gvi_real T[CONTACT_TOUCH][CONTACT__COLUMNS], d[CONTACT_TOUCH];
    int basis[CONTACT_TOUCH], out = -1, in = 2*k;
    for (int i = 0; i < k; ++i) d[i] = 1/GVI_SQRT(W[i*k + i]), z[i] = 0;
    for (int i = 0; i < k; ++i) {
        for (int j = 0; j < k; ++j) T[i][j] = i == j, T[i][k + j] = -W[i*k + j]*d[i]*d[j];
        T[i][2*k] = -1, T[i][2*k + 1] = b[i]*d[i], basis[i] = i;
        if (T[i][2*k + 1] < 0 && (out < 0 || T[i][2*k + 1] < T[out][2*k + 1])) out = i;
    }
    if (out < 0) return 1;
    for (int pass = 0; pass < 50*k + 50 && out >= 0; ++pass) {
        const int left = basis[out];
        contact__pivot(k, T, out, in);
        basis[out] = in;
        in = left < k ? left + k : left - k;
        if (left < 2*k) out = contact__leaves(k, T, basis, in, small);
        for (int i = 0; i < k && left == 2*k; ++i)
            if (basis[i] >= k && basis[i] < 2*k) z[basis[i] - k] = contact__most(T[i][2*k + 1], 0)*d[basis[i] - k];
        if (left == 2*k) return 1;
    }
    return 0;
}

/* z >= 0 with y = W z + b >= 0 and z'y = 0, W [k][k]; with another zero where rounding has led astray.  0: none.  */
static inline int contact__lcp(int k, const gvi_real *W, const gvi_real *b, gvi_real *z)
{
    const gvi_real root = GVI_SQRT(contact__eps);
    for (gvi_real small = 1000*contact__eps; small < root; small *= 30) {
        int wrong = !contact__lemke(k, W, b, z, small);
        gvi_real size = 0;
        for (int i = 0; i < k; ++i) size = contact__most(size, contact__abs(b[i])/GVI_SQRT(W[i*k + i]));
        for (int i = 0; i < k && !wrong; ++i) {
            const gvi_real y = (b[i] + contact__dot(k, W + i*k, z))/GVI_SQRT(W[i*k + i]);
            wrong = y < -root*size || (z[i] > 0 && y > root*size);
        }
        if (!wrong) return 1;
    }
    return 0;
}

/* ---- at one state: c->q, c->v ---- */

static inline gvi_status contact__load(contact *c)
{
    memcpy(c->q, c->st.q, (size_t)c->st.n*sizeof *c->q);
    const gvi_status status = gvi_velocity(&c->st, c->v);
    if (status) c->why = gvi_why(&c->st);
    return status;
}

/* What presses, `closed`, and all whose gap is 0.  */
static inline gvi_status contact__touching(contact *c, int closed, contact_set *s)
{
    gvi_real phi, rate;
    s->k = 0;
    for (int a = 0; a < c->count; ++a) {
        const gvi_real noise = contact__gap(c, a, c->st.t, c->q, c->v, &phi, &rate);
        if (a != closed && contact__on(c, a) < 0 && phi > noise) continue;
        if (s->k == CONTACT_TOUCH) return contact__fail(c, a, CONTACT_E_TOO_MANY);
        s->which[s->k++] = a;
    }
    return GVI_OK;
}

/* Copies of c->q, to c->u, and v projected with a as the only contact, or none: gvi.h's way to M^-1.  */
static inline gvi_status contact__project(contact *c, int a, gvi_real *v, gvi_real *moved)
{
    const int was = c->row[0].which;
    memcpy(c->u, c->q, (size_t)c->st.n*sizeof *c->u);
    if (a >= 0) c->row[0].which = a;
    gvi_status status = contact__switch(c, &c->probe, a >= 0);
    if (!status) status = gvi_project(&c->probe, c->st.t, c->u, v, moved);
    if (status) c->why = gvi_why(&c->probe);
    c->row[0].which = was;
    return status;
}

/* R = M^-1 G' as far as other constraints let it through, and G R; 0 where nothing is let through, or < 0: gvi.h's
   status.  What gvi_project adds to a velocity is d = R z, and sqrt(d'M d) = sqrt(G R) z.  */
static inline gvi_real contact__response(contact *c, int a, gvi_real rate, const gvi_real *G, gvi_real *R)
{
    const int n = c->st.n;
    gvi_real moved[2], terms = 0, sum = 0;
    for (int i = 0; i < n; ++i) R[i] = rate < 0 ? -G[i] : G[i];       // so that G R and the rate do not cancel
    gvi_status status = contact__project(c, -1, R, NULL);
    memcpy(c->w, R, (size_t)n*sizeof *R);
    if (!status) status = contact__project(c, a, c->w, moved);
    if (status) return status == GVI_E_CONSTRAINT ? 0 : (gvi_real)status;
    for (int i = 0; i < n; ++i) {
        R[i] = c->w[i] - R[i];
        sum += G[i]*R[i];
        terms += contact__abs(G[i]*R[i]);
    }
    if (!(moved[1] > 0 && contact__abs(sum) > 256*contact__eps*terms)) return 0;
    for (int i = 0; i < n; ++i) R[i] *= sum/(moved[1]*moved[1]);
    return sum*sum/(moved[1]*moved[1]);
}

/* Gradients, responses and normal speeds as seen along h.  What cannot respond is left out, if it does not approach. */
static inline gvi_status contact__measure(contact *c, contact_set *s)
{
    const int n = c->st.n, touch = s->k;
    gvi_real phi, rate, w;
    s->k = 0;
    for (int i = 0; i < touch; ++i) {
        const int k = s->k, a = s->which[i];
        gvi_real *G = c->G + k*n, terms;
        (void)contact__gap(c, a, c->st.t, c->q, c->v, &phi, &rate);
        memcpy(G, c->at + n, (size_t)n*sizeof *G);
        const gvi_real own = rate - contact__dot(n, G, c->v);
        if ((w = contact__response(c, a, own, G, c->R + k*n)) < 0) return contact__fail(c, a, (int)w);
        terms = contact__abs(own);
        for (int j = 0; j < n; ++j) terms += contact__abs(G[j]*c->v[j]);
        s->which[k] = a, s->speed[k] = c->way*rate, s->tiny[k] = 256*contact__eps*terms, s->z[k] = 0;
        if (w > 0) ++s->k;
        else if (s->speed[k] < -s->tiny[k]) return contact__fail(c, a, CONTACT_E_JAMMED);
    }
    for (int i = 0; i < s->k; ++i)
        for (int j = 0; j <= i; ++j)
            s->W[i*s->k + j] = s->W[j*s->k + i] = (contact__dot(n, c->G + i*n, c->R + j*n)
                                                   + contact__dot(n, c->G + j*n, c->R + i*n))/2;
    return GVI_OK;
}

/* ---- impacts ---- */

/* Is all that approaches slower than `rest`?  Then nothing bounces.  */
static inline int contact__slow(const contact *c, const contact_set *s)
{
    for (int i = 0; i < s->k; ++i) if (s->speed[i] <= -c->rest) return 0;
    return 1;
}

/* Speeds after the impulses z, and the energy that they take; in *size what it is measured by.  */
static inline gvi_real contact__after(const contact_set *s, gvi_real *after, gvi_real *size)
{
    gvi_real taken = 0;
    *size = 0;
    for (int i = 0; i < s->k; ++i) {
        after[i] = s->speed[i] + contact__dot(s->k, s->W + i*s->k, s->z);
        taken -= s->z[i]*(after[i] + s->speed[i])/2;
        *size += s->speed[i]*s->speed[i]/s->W[i*s->k + i];
    }
    return taken;
}

/* By their own e, by the least of them, by 0: the first that gains nothing.  */
static inline gvi_status contact__together(contact *c, contact_set *s, gvi_real *after, gvi_real *taken, gvi_real *size)
{
    gvi_real b[CONTACT_TOUCH], e[CONTACT_TOUCH], least = 1;
    for (int i = 0; i < s->k; ++i) {
        e[i] = c->e && !contact__slow(c, s) && s->speed[i] < -s->tiny[i] ? c->e[s->which[i]] : 0;
        if (s->speed[i] < -s->tiny[i] && e[i] < least) least = e[i];
    }
    for (int pass = 0; pass < 3; ++pass) {
        for (int i = 0; i < s->k; ++i) b[i] = s->speed[i]*(1 + (pass == 0 ? e[i] : pass == 1 && e[i] > 0 ? least : 0));
        if (!contact__lcp(s->k, s->W, b, s->z)) return contact__fail(c, s->which[0], CONTACT_E_JAMMED);
        *taken = contact__after(s, after, size);
        if (*taken >= -1000*contact__eps**size) break;
    }
    return GVI_OK;
}

static inline gvi_status contact__in_turn(contact *c, contact_set *s, gvi_real *after, gvi_real *taken, gvi_real *size)
{
    for (int pass = 0; pass < 10000; ++pass) {
        int f = -1;
        *taken = contact__after(s, after, size);
        for (int i = 0; i < s->k; ++i) {
            const gvi_real tiny = s->tiny[i] + 256*contact__eps*GVI_SQRT(*size*s->W[i*s->k + i]);
            if (after[i] < -tiny && (f < 0 || after[i] < after[f])) f = i;
        }
        if (f < 0) return GVI_OK;
        s->z[f] -= (1 + (c->e && after[f] < -c->rest ? c->e[s->which[f]] : 0))*after[f]/s->W[f*s->k + f];
    }
    return contact__fail(c, s->which[0], CONTACT_E_JAMMED);
}

static inline gvi_status contact__impact(contact *c, contact_set *s)
{
    const int n = c->st.n, slow = contact__slow(c, s);
    gvi_real after[CONTACT_TOUCH], taken, size;
    const gvi_status status = (c->in_turn ? contact__in_turn : contact__together)(c, s, after, &taken, &size);
    if (status) return status;
    c->energy += taken;
    memset(c->impulse, 0, (size_t)c->count*sizeof *c->impulse);
    for (int i = 0; i < s->k; ++i) {
        const int a = s->which[i], bounces = c->e && c->e[a] > 0 && s->speed[i] < -s->tiny[i];
        for (int j = 0; j < n; ++j) c->v[j] += c->way*c->R[i*n + j]*s->z[i];
        c->impulse[a] = s->z[i];
        if (s->z[i] > 0) contact__tell(c, CONTACT_IMPACT, a);
        s->tiny[i] += 256*contact__eps*GVI_SQRT(size*s->W[i*s->k + i]);
        s->speed[i] = slow && after[i] < c->rest ? 0 : after[i];
        if (slow && (bounces || s->speed[i] < after[i])) contact__tell(c, CONTACT_CAPTURED, a);
    }
    return GVI_OK;
}

/* ---- what presses ---- */

/* lambda of each row now, to c->lambda + c->before.  */
static inline gvi_status contact__lambda(contact *c)
{
    const gvi_status status = gvi_multipliers(&c->st, c->lambda);
    if (status) c->why = gvi_why(&c->st);
    return status;
}

/* Acceleration of the gap with no contact: -lambda G M^-1 G', lambda that of its row alone.  Starts c->st anew.  */
static inline gvi_status contact__free(contact *c, int a, gvi_real w, gvi_real *b)
{
    const int was = c->row[0].which;
    memcpy(c->w, c->v, (size_t)c->st.n*sizeof *c->w);
    gvi_status status = contact__project(c, a, c->w, NULL);
    if (!status) status = contact__switch(c, &c->st, 0);
    c->row[0].which = a;
    if (!status && (status = gvi_start(&c->st, c->st.t, c->u, c->w))) c->why = gvi_why(&c->st);
    if (!status) status = contact__switch(c, &c->st, 1);
    if (!status) status = contact__lambda(c);
    c->row[0].which = was;
    *b = -w*c->lambda[c->before];
    return status;
}

/* z: forces of those that touch without normal speed.  */
static inline gvi_status contact__forces(contact *c, contact_set *s)
{
    gvi_real b[CONTACT_TOUCH] = { 0 }, z[CONTACT_TOUCH], W[CONTACT_TOUCH*CONTACT_TOUCH] = { 0 }, most = 0;
    int in[CONTACT_TOUCH], k = 0;
    gvi_status status = GVI_OK;
    for (int i = 0; i < s->k; ++i) {
        s->z[i] = 0;
        if (s->speed[i] <= s->tiny[i]) in[k++] = i;
    }
    for (int i = 0; i < k; ++i) {
        const gvi_real w = s->W[in[i]*s->k + in[i]];
        if ((status = contact__free(c, s->which[in[i]], w, &b[i]))) return contact__fail(c, s->which[in[i]], status);
        for (int j = 0; j < k; ++j) W[i*k + j] = s->W[in[i]*s->k + in[j]];
    }
    if (!contact__lcp(k, W, b, z)) return contact__fail(c, s->which[in[0]], CONTACT_E_JAMMED);
    for (int i = 0; i < k; ++i) most = contact__most(most, z[i]*GVI_SQRT(W[i*k + i]));
    for (int i = 0; i < k; ++i) {
        gvi_real terms = contact__abs(b[i]);
        for (int j = 0; j < k; ++j) terms += contact__abs(W[i*k + j]*z[j]);
        c->size[s->which[in[i]]] = c->h*c->h*terms;
        if (z[i]*GVI_SQRT(W[i*k + i]) > 1000*contact__eps*most) s->z[in[i]] = z[i];
    }
    return GVI_OK;
}

/* Rows for those with z > 0, from c->q and c->v, which they project, on.  */
static inline gvi_status contact__hold(contact *c, const contact_set *s)
{
    contact_row was[CONTACT_TOUCH];
    gvi_real moved[2];
    int on = 0;
    gvi_status status = contact__switch(c, &c->st, 0);
    if (status) return status;
    memcpy(was, c->row, sizeof was);
    for (int k = 0; k < c->slots; ++k) c->row[k].on = 0;
    for (int i = 0; i < s->k; ++i) {
        if (!(s->z[i] > 0)) continue;
        if (on == c->slots) return contact__fail(c, s->which[i], CONTACT_E_TOO_MANY);
        c->row[on].which = s->which[i], c->row[on].lambda = s->z[i], c->row[on++].on = 1;
    }
    if (!(status = contact__switch(c, &c->probe, on))) status = gvi_project(&c->probe, c->st.t, c->q, c->v, moved);
    if (status) c->why = gvi_why(&c->probe);
    else c->energy += moved[1]*moved[1]/2;                // of those that were captured as they left
    if (status) return status == GVI_E_CONSTRAINT ? contact__fail(c, s->which[0], CONTACT_E_JAMMED) : status;
    if ((status = gvi_start(&c->st, c->st.t, c->q, c->v))) c->why = gvi_why(&c->st);
    if (status || (status = contact__switch(c, &c->st, on))) return status;

    for (int k = 0; k < c->slots; ++k) {
        if (!was[k].on || contact__on(c, was[k].which) >= 0) continue;
        c->left[was[k].which] = 3;
        contact__tell(c, CONTACT_OPENED, was[k].which);
    }
    for (int k = 0, old; k < on; ++k) {
        for (old = 0; old < c->slots && !(was[old].on && was[old].which == c->row[k].which); ++old) { }
        if (old == c->slots) contact__tell(c, CONTACT_CLOSED, c->row[k].which);
    }
    return GVI_OK;
}

/* At the present state, where a gap has closed, or -1: impact, and what presses after it.  One that closes at once
   has left by less than rounding shows: it is captured.  */
static inline gvi_status contact__resolve(contact *c, int closed, int at_once)
{
    contact_set s;
    int hit = 0;
    gvi_status status = contact__load(c);
    s.k = 0;
    if (!status) status = contact__touching(c, closed, &s);
    if (!status) status = contact__measure(c, &s);
    for (int i = 0; !status && i < s.k; ++i) {
        hit |= s.speed[i] < -s.tiny[i] && contact__on(c, s.which[i]) < 0;
        if (!at_once || s.which[i] != closed || s.speed[i] <= s.tiny[i]) continue;
        s.speed[i] = 0;
        contact__tell(c, CONTACT_CAPTURED, closed);
    }
    if (!status && hit) status = contact__impact(c, &s);
    if (!status) status = contact__forces(c, &s);
    return status ? status : contact__hold(c, &s);
}

/* ---- events within a step: fractions x of it ---- */

static inline void contact__save(contact *c, int k)
{
    c->saved[k].st = c->st;
    memcpy(c->saved[k].row, c->row, sizeof c->row);
    memcpy(c->saved[k].memory, c->memory, c->bytes);
}

static inline void contact__back(contact *c, int k)
{
    const size_t a = c->bytes/sizeof *c->size - 2*(size_t)c->count;
    gvi_restore(&c->st, &c->saved[k].st, c->saved[k].memory);
    memcpy(c->size, c->saved[k].memory + a, 2*(size_t)c->count*sizeof *c->size);
    memcpy(c->row, c->saved[k].row, sizeof c->row);
}

/* The step that was saved, made again with length h.  */
static inline gvi_status contact__again(contact *c, int k, gvi_real h)
{
    contact__back(c, k);
    ++c->trials;
    const gvi_status status = contact__abs(h) > 0 ? gvi_step(&c->st, h) : GVI_OK;
    if (status) c->why = gvi_why(&c->st);
    return status ? status : contact__load(c);
}

/* Gap of a on the curve, its slope by x, and its rounding.  */
static inline gvi_real contact__curve(contact *c, gvi_real x, int a, gvi_real *phi, gvi_real *slope)
{
    (void)gvi_curve(&c->st, x, c->q, c->v);
    const gvi_real noise = contact__gap(c, a, c->st.t0 + x*c->st.h, c->q, c->v, phi, slope);
    *slope *= c->st.h;
    return noise;
}

/* The lowest point between x and *to, where the slopes s0 < 0 < s1; or the first found that is below 0.  */
static inline gvi_real contact__lowest(contact *c, int a, gvi_real x, gvi_real *to, gvi_real s0, gvi_real s1,
                                       gvi_real noise)
{
    gvi_real l = x, r = *to, phi = 0, slope;
    for (int j = 0; j < 40 && r - l > GVI_SQRT(contact__eps); ++j) {
        *to = j % 3 == 2 ? (l + r)/2 : l + (r - l)*(s0/(s0 - s1));
        (void)contact__curve(c, *to, a, &phi, &slope);
        if (phi < -noise) break;
        if (slope < 0) l = *to, s0 = slope; else r = *to, s1 = slope;
    }
    return phi;
}

/* Does gap a close on the curve between x[0] and x[1], where the samples 1 - k and k are?  Then x is around that, or
   c->at_once: it has not been open before x[1].  */
static inline int contact__closes(contact *c, int a, gvi_real *x, int k)
{
    const gvi_real p0 = c->sample[1 - k].phi[a], p1 = c->sample[k].phi[a], s0 = c->sample[1 - k].slope[a],
                   s1 = c->sample[k].slope[a], begin = x[0];
    gvi_real noise = c->sample[k].noise[a], low = p1, y, unused;
    if (!(p1 < -noise)) {                                  // does it turn in between, and below 0?
        if (c->touches[a] > 0 || !(s0 < 0 && s1 > 0)) return 0;
        if (p0 + s0*((p0 - p1 + s1*(x[1] - begin))/(s1 - s0)) >= noise) return 0;
        low = contact__lowest(c, a, begin, &x[1], s0, s1, noise);
        if (low <= noise && low >= -noise) contact__tell(c, CONTACT_GRAZED, a);
        return low < -noise;
    }
    c->at_once = c->touches[a] > 0;
    for (int j = 0; c->at_once && j < 40; ++j) {           // it leaves first: where is it open?
        y = begin + (x[1] - begin)/2;
        noise = contact__curve(c, y, a, &low, &unused);
        if (low > noise) x[0] = y, c->at_once = 0;
        else if (low < -noise) x[1] = y;
        else break;
    }
    return 1;
}

/* Gaps of what does not press at x, their slopes and rounding, to sample[k].  */
static inline void contact__sample(contact *c, gvi_real x, int k)
{
    contact__samples *y = &c->sample[k];
    (void)gvi_curve(&c->st, x, c->q, c->v);
    for (int a = 0; a < c->count; ++a) {
        y->noise[a] = contact__gap(c, a, c->st.t0 + x*c->st.h, c->q, c->v, &y->phi[a], &y->slope[a]);
        y->slope[a] *= c->st.h;
    }
}

/* Would each gap have to change four times as fast inside each half of the step as at its ends, to reach 0 there?  */
static inline int contact__far(contact *c)
{
    contact__sample(c, 0, 0);
    for (int k = 1; k <= 2; ++k) {
        contact__samples *const l = &c->sample[1 - k % 2], *const r = &c->sample[k % 2];
        contact__sample(c, (gvi_real)k/2, k % 2);
        for (int a = 0; a < c->count; ++a) {
            const gvi_real speed = contact__most(contact__abs(l->slope[a]), contact__abs(r->slope[a]));
            if (contact__on(c, a) >= 0) continue;
            if (!(l->phi[a] > l->noise[a] && r->phi[a] > r->noise[a] && l->phi[a] + r->phi[a] > 2*speed)) return 0;
        }
    }
    return 1;
}

/* The first gap that closes on the curve after x[0]: which, between x[0] and x[1], or -1.  One that has opened, or
   left an impact, is to be open before it can close.  */
static inline int contact__closing(contact *c, gvi_real *x)
{
    const int points = c->st.s < 3 ? 4 : c->st.s + 1;
    gvi_real from = x[0];
    int which = -1;
    if (!(from > 0) && contact__far(c)) return -1;
    contact__sample(c, from, 0);
    for (int a = 0; a < c->count; ++a) c->touches[a] = c->sample[0].phi[a] <= c->sample[0].noise[a];
    for (int k = 1; k <= points && which < 0; ++k) {
        const gvi_real to = (gvi_real)k/(gvi_real)points;
        if (!(to > from)) continue;
        contact__sample(c, to, k % 2);
        for (int a = 0; a < c->count; ++a) {
            gvi_real y[2] = { from, to };
            const int waits = c->left[a] > 0 && c->touches[a] > 0 && k < points;
            if (contact__on(c, a) < 0 && !waits && contact__closes(c, a, y, k % 2) && (which < 0 || y[1] < x[1]))
                which = a, x[0] = y[0], x[1] = y[1];
            if (c->sample[k % 2].phi[a] > c->sample[k % 2].noise[a]) c->touches[a] = 0;
        }
        from = to;
    }
    return which;
}

/* The step of length h made again to end where gap a closes, at a fraction between x[0] and x[1].  *x: that, or -1: it
   does not close, a graze.  */
static inline gvi_status contact__land(contact *c, int k, int a, gvi_real h, gvi_real *x)
{
    gvi_real lo = x[0], hi = x[1], y = hi, phi, rate, least = -1;
    for (int j = 0; j < 60; ++j) {
        const gvi_status status = contact__again(c, k, y*h);
        if (status) return status;
        const gvi_real noise = contact__gap(c, a, c->st.t, c->q, c->v, &phi, &rate), size = contact__abs(phi);
        if (c->at_once) return phi < -noise ? contact__again(c, k, lo*h) : (x[0] = -1, GVI_OK);
        x[0] = y;
        if (size <= noise/64 || (least >= 0 && j > 3 && size >= least && size <= noise)) break;
        least = size;
        rate *= h;
        if (phi > 0 && rate >= 0) return x[0] = -1, GVI_OK;
        if (phi > 0) lo = contact__most(lo, y); else if (y < hi) hi = y;
        y -= rate < 0 ? phi/rate : 0;
        if (phi > 0 && y >= hi) hi += (hi - lo)/16, y = y < hi ? y : hi;       // the curve is less exact than the step
        if (!(y > lo && y < hi)) y = (lo + hi)/2;
        if (contact__abs(y - x[0]) <= contact__eps*y) break;
    }
    return GVI_OK;
}

/* The multiplier of a row in the step, as it has kept it.  */
static inline gvi_real contact__kept(contact *c, gvi_real x, int row)
{
    return gvi_curve_multipliers(&c->st, x, c->lambda) ? 0 : c->lambda[c->before + row];
}

/* The least multiplier of a row in the step, in parts of the row's largest; *x: where, by parabolas.  0: not known.  */
static inline gvi_real contact__least(contact *c, gvi_real *x)
{
    const int points = 2*c->st.s;
    gvi_real low[CONTACT_TOUCH], most[CONTACT_TOUCH] = { 0 }, at[CONTACT_TOUCH], least = 1, step = 1/(gvi_real)points;
    int row = -1;
    for (int k = 0; k <= points; ++k) {
        const gvi_real y = (gvi_real)k/(gvi_real)points;
        if (gvi_curve_multipliers(&c->st, y, c->lambda)) return 0;
        for (int i = 0; i < c->slots; ++i) {
            const gvi_real l = c->lambda[c->before + i];
            if (k == 0 || l < low[i]) low[i] = l, at[i] = y;
            most[i] = contact__most(most[i], contact__abs(l));
            c->row[i].lambda = l;
        }
    }
    for (int i = 0; i < c->slots; ++i)
        if (c->row[i].on && low[i] <= least*most[i]) least = most[i] > 0 ? low[i]/most[i] : 0, *x = at[i], row = i;
    for (int j = 0; j < 4 && row >= 0 && *x > 0 && *x < 1; ++j) {
        step = -contact__most(-step/4, contact__most(-*x, *x - 1));
        const gvi_real l = contact__kept(c, *x - step, row), r = contact__kept(c, *x + step, row),
                       bend = l + r - 2*contact__kept(c, *x, row);
        if (bend > 0) *x -= step*((r - l)/(2*bend));
    }
    return least;
}

/* Which rows have a negative lambda, bits, with lambda as it is there to `end`.  */
static inline gvi_status contact__negative(contact *c, gvi_real *end, unsigned *bits)
{
    gvi_real most = 0;
    const gvi_status status = contact__lambda(c);
    *bits = 0;
    for (int i = 0; i < c->slots && !status; ++i) {
        end[i] = c->lambda[c->before + i];
        most = contact__most(most, contact__abs(end[i]));
    }
    for (int i = 0; i < c->slots && !status; ++i)
        if (c->row[i].on && end[i] < -1000*contact__eps*contact__most(most, c->row[i].lambda)) *bits |= 1u << i;
    return status;
}

/* Illinois's method on lambda(x), the least of these rows' in parts of what it is at *x: to *x.  */
static inline gvi_status contact__zero(contact *c, int k, gvi_real h, const gvi_real *end, unsigned bits, gvi_real *x)
{
    gvi_real a = 0, b = *x, fa = 1, fb = -1, y, f;
    for (int i = 0; i < c->slots; ++i) {
        const gvi_real part = contact__abs(c->saved[k].row[i].lambda/end[i]);
        if ((bits >> i & 1u) && part < fa) fa = part;
    }
    for (int j = 0, side = 0; j < 60; ++j) {
        y = a + (b - a)*(fa/(fa - fb));
        if (!(y > a && y < b)) y = a + (b - a)/2;
        gvi_status status = contact__again(c, k, y*h);
        if (!status) status = contact__lambda(c);
        if (status) return status;
        f = 1;
        for (int i = 0; i < c->slots; ++i) {
            const gvi_real part = c->lambda[c->before + i]/contact__abs(end[i]);
            if ((bits >> i & 1u) && part < f) f = part;
        }
        *x = y;
        if (contact__abs(f) <= 1000*contact__eps || b - a <= 4*contact__eps*b) break;
        if (f > 0) { a = y, fa = f; if (side < 0) fb /= 2; side = -1; }
        else { b = y, fb = f; if (side > 0) fa /= 2; side = 1; }
    }
    return GVI_OK;
}

/* Does a lambda change its sign in the step of length x h that has been made?  Then the step ends there; *bits: whose. */
static inline gvi_status contact__opening(contact *c, int k, gvi_real h, gvi_real *x, unsigned *bits)
{
    gvi_real end[CONTACT_TOUCH], at = 1;
    int on = 0;
    gvi_status status;
    *bits = 0;
    for (int i = 0; i < c->slots; ++i) on |= c->row[i].on;
    if (!on || !(*x > 0)) return GVI_OK;
    if (contact__least(c, &at) > (gvi_real)0.125 && c->st.s > 1) return GVI_OK;       // by more than its own error
    if ((status = contact__negative(c, end, bits))) return status;
    if (!*bits && at < 1 && at > 0) {                                 // below 0 inside, and not at the end?
        status = contact__again(c, k, at**x*h);
        if (!status) status = contact__negative(c, end, bits);
        if (!status && *bits) *x *= at;
        else if (!status) status = contact__again(c, k, *x*h);
        if (!status && !*bits) status = contact__lambda(c);
    }
    if (status) return status;
    for (int i = 0; i < c->slots && !*bits; ++i) c->row[i].lambda = c->lambda[c->before + i];
    if (!*bits) return GVI_OK;
    status = contact__again(c, k, 0);
    if (!status) status = contact__lambda(c);
    for (int i = 0; i < c->slots; ++i) c->saved[k].row[i].lambda = c->lambda[c->before + i];
    for (int i = 0; i < c->slots; ++i)
        if ((*bits >> i & 1u) && !(c->saved[k].row[i].lambda > 1000*contact__eps*-end[i])) *x = 0;   // from the start on
    if (status) return status;
    return *x > 0 ? contact__zero(c, k, h, end, *bits, x) : contact__again(c, k, 0);
}

/* What presses where a lambda is 0, at fraction x: what the forces 1/64 of the step later say; if that is nothing new,
   all but the rows of `bits`.  */
static inline gvi_status contact__reopen(contact *c, int k, gvi_real h, gvi_real x, unsigned bits)
{
    contact_set s;
    gvi_status status = contact__load(c);
    s.k = 0;
    if (!status) status = contact__touching(c, -1, &s);
    if (!status && (status = gvi_step(&c->st, h/64))) c->why = gvi_why(&c->st);
    if (!status) status = contact__load(c);
    if (!status) status = contact__measure(c, &s);
    for (int i = 0; i < s.k; ++i) s.speed[i] = 0;
    if (!status) status = contact__forces(c, &s);
    if (!status) status = contact__again(c, k, x*h);
    if (status) return status;
    int same = 1;
    for (int i = 0; i < s.k; ++i) same &= (s.z[i] > 0) == (contact__on(c, s.which[i]) >= 0);
    for (int i = 0; i < s.k && same; ++i) {
        const int row = contact__on(c, s.which[i]);
        if (row >= 0 && (bits >> row & 1u)) s.z[i] = 0;
    }
    return contact__load(c) ? c->st.status : contact__hold(c, &s);
}

/* ---- steps ---- */

/* A step of h, or by the dial towards t_end, to the first event at most.  */
static inline gvi_status contact__once(contact *c, int k, gvi_real h, gvi_real t_end, int dial, gvi_real *made)
{
    gvi_real x[2] = { 0, 1 }, part = 1;
    unsigned bits = 0;
    int closes = -1, at_once = 0, which;
    gvi_status status = dial ? gvi_advance(&c->st, t_end) : gvi_step(&c->st, h);
    if (status) c->why = gvi_why(&c->st);
    const gvi_real next = c->st.next, whole = c->st.h;
    c->h = contact__abs(whole);
    while (!status && (which = contact__closing(c, x)) >= 0) {
        const gvi_real after = x[1] + (gvi_real)1e-3;
        x[0] *= part, x[1] *= part;
        if ((status = contact__land(c, k, which, whole, x))) break;
        if (x[0] >= 0) closes = which, part = x[0], x[0] = 0, at_once = c->at_once;
        else if (!(status = contact__again(c, k, part*whole))) x[0] = after < 1 ? after : 1;
        if (!(part > 0)) break;
        x[1] = 1;
    }
    if (!status) status = contact__opening(c, k, whole, &part, &bits);
    *made = part*whole;
    if (status) return status;
    for (int a = 0; a < c->count && part > 0; ++a) c->left[a] -= c->left[a] > 0;
    if (bits) status = contact__reopen(c, k, whole, part, bits);
    else if (closes >= 0) status = contact__resolve(c, closes, at_once);
    c->st.next = next;
    return status;
}

static inline gvi_status contact__run(contact *c, gvi_real h, gvi_real t_end, int dial)
{
    const int most = c->most > 0 ? c->most : 1000, fresh = c->fresh;
    const gvi_real energy = c->energy;
    unsigned long long seen[CONTACT_KINDS];
    gvi_real left = h, made = 0;
    gvi_status status = GVI_OK;
    int k = 0;
    c->fault = -1;
    c->why = gvi_status_text(GVI_OK);
    memcpy(seen, c->seen, sizeof seen);
    contact__save(c, 0);
    c->way = (dial ? t_end < c->st.t : h < 0) ? -1 : 1;
    c->h = contact__abs(!dial ? h : c->st.next > 0 || c->st.next < 0 ? c->st.next : (t_end - c->st.t)/64);
    if (c->fresh && !(status = contact__resolve(c, -1, 0))) c->fresh = 0, contact__save(c, k = 1);
    for (int i = 0; !status; ++i) {
        status = i == most ? contact__fail(c, -1, CONTACT_E_PILE_UP) : contact__once(c, k, left, t_end, dial, &made);
        left -= made;
        if (status || dial || contact__abs(left) <= 8*contact__eps*contact__abs(h)) break;
        contact__save(c, k = 1);
    }
    if (!status) return GVI_OK;
    contact__back(c, 0);
    memcpy(c->seen, seen, sizeof seen);
    c->fresh = fresh, c->energy = energy;
    return status;
}

static inline gvi_status contact_step(contact *c, gvi_real h) { return contact__run(c, h, 0, 0); }

/* A step made again may miss, by the rounding of its measure, what the dial has let pass: shorter, then.  */
static inline gvi_status contact_advance(contact *c, gvi_real t_end)
{
    gvi_status status = contact__run(c, 0, t_end, 1);
    for (int k = 0; k < 10 && status == GVI_E_RESOLUTION; ++k) {
        c->st.next = c->way*c->h/2;
        status = contact__run(c, 0, t_end, 1);
    }
    return status;
}

static inline gvi_real contact_force(contact *c, int a)
{
    const int k = contact__on(c, a);
    return k < 0 || contact__lambda(c) ? 0 : c->lambda[c->before + k];
}

static inline const char *contact_why(const contact *c, gvi_status status)
{
    switch ((int)status) {
    case CONTACT_E_PENETRATES: return "a gap is negative where the motion starts: move the bodies apart";
    case CONTACT_E_JAMMED: return "no impulses or forces part the contacts: they are jammed, or a gradient is wrong";
    case CONTACT_E_PILE_UP: return "too many events in a step: set rest, a shorter step, or e = 0";
    case CONTACT_E_TOO_MANY: return "more contacts press than there are slots, or touch than CONTACT_TOUCH";
    default: return status ? c->why : "ok";
    }
}

#endif
