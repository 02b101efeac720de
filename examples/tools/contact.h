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
   fails            t, q, p and what presses are as before the call, to the bit; c.fault is the contact to blame,
                    or -1.  A gvi_status, or one of CONTACT_E_..; the first start compares gradient and rate of
                    each contact with differences, as gvi.h does
   scenes           T quadratic in v; other constraints, M(q), forces as in gvi.h.  GVI_EFFECTS limits the slots
   not seen         a lambda that changes its sign twice in a step, a gap that turns twice in 1/(s + 1) of one: take
                    shorter steps.  Friction: friction.h

   Sources: Moreau: Unilateral contact and dry friction in finite freedom dynamics, 1988; Pfeiffer, Glocker:
   Multibody dynamics with unilateral contacts, 1996; Lawson, Hanson: Solving least squares problems, 1974, ch. 23
   (active sets).                                                                                                */
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

typedef struct contact_row { struct contact *c; int which; } contact_row;         /* which contact a slot holds */

typedef struct contact_gap { gvi_real phi, rate, noise, tiny; } contact_gap;      /* and the rounding of both */

typedef struct contact_set {               /* contacts that touch, at one state: normal speeds along h, impulses z */
    int      k, which[CONTACT_TOUCH];
    gvi_real speed[CONTACT_TOUCH], after[CONTACT_TOUCH], tiny[CONTACT_TOUCH], z[CONTACT_TOUCH],
             W[CONTACT_TOUCH*CONTACT_TOUCH], size;
} contact_set;

typedef struct contact_state {             /* what a step starts from; x: q, p                            */
    gvi_real t, t_low, next, energy, *x;
    int      fresh, on, which[CONTACT_TOUCH];
    unsigned long long seen[CONTACT_KINDS];
} contact_state;

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

    gvi_stepper      probe;                /* private: of degree 1 and never started, for M^-1            */
    gvi_desc         probe_desc;
    contact_row      row[CONTACT_TOUCH];
    contact_state    saved[3];             /* before the call; before the step; before a look ahead       */
    contact_gap     *sample[2];            /* [count] at two places of the step, sample[last] the later   */
    gvi_real        *memory, *probe_memory, *q, *v, *u, *w, *at, *G, *R, *touches, *refused, *size, *unit, *lambda, h, way;
    const char      *why;
    int              first, before, on;    /* effect and row of slot 0; the first `on` slots press        */
    int              fresh, last;          /* has no step been made?                                      */
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

static inline gvi_status contact__said(contact *c, const gvi_stepper *st, gvi_status status)
{
    if (status) c->why = gvi_why(st);
    return status;
}

static inline void contact__tell(contact *c, contact_kind kind, int a)
{
    ++c->seen[kind];
    if (c->told) c->told(c, kind, a);
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

static inline int contact__slot(const contact *c, int a)          /* the slot that holds it, or -1 */
{
    for (int k = 0; k < c->on; ++k) if (c->row[k].which == a) return k;
    return -1;
}

/* All rows off, then on for the first `on` slots.  */
static inline gvi_status contact__switch(contact *c, gvi_stepper *st, int on)
{
    gvi_status status = GVI_OK;
    for (int k = 0; k < c->slots && !status; ++k) status = gvi_switch(st, c->first + k, 0);
    for (int k = 0; k < on && !status; ++k) status = gvi_switch(st, c->first + k, 1);
    return contact__said(c, st, status);
}

/* Gap and its rate of change, with what of them is rounding.  The gradient is then in c->at + n.  */
static inline contact_gap contact__gap(contact *c, int a, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const int n = c->st.n;
    gvi_real *G = c->at + n, own = 0, lies = 0, moves;
    contact_gap g;
    for (int i = 0; i < n; ++i) G[i] = 0;
    c->gap(a, t, q, &g.phi, G, &own, c->user);
    g.rate = own;
    moves = contact__abs(own);
    for (int i = 0; i < n; ++i) {
        g.rate += G[i]*v[i];
        moves += contact__abs(G[i]*v[i]);
        lies += contact__abs(G[i]*q[i]);
    }
    g.noise = 64*contact__eps*(lies + contact__abs(own*t) + c->h*moves + c->size[a]);
    g.tiny = 256*contact__eps*moves + (c->h > 0 ? g.noise/(16*c->h) : 0);
    g.noise += c->touch;
    return g;
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

/* Numbers in use, 0: gvi.h refuses the scene.  With memory, hands it out.  */
static inline size_t contact__layout(contact *c, const gvi_desc *desc, gvi_real *memory)
{
    const gvi_desc probe = contact__probe(desc);
    const size_t one = sizeof(gvi_real), a = gvi_size(desc)/one, b = gvi_size(&probe)/one, n = (size_t)desc->n,
                 count = (size_t)c->count;
    gvi_real *gap[2];
    size_t used = 0, rows = 0;
    if (!a || !b || c->count < 0) return 0;
    for (int i = 0; i < desc->effect_count; ++i) rows += (size_t)desc->effects[i].rows;
    struct { gvi_real **to; size_t count; } list[] = {
        { &c->memory, a }, { &c->probe_memory, b }, { &c->lambda, rows },
        { &c->q, n }, { &c->v, n }, { &c->u, n }, { &c->w, n }, { &c->at, 2*n },
        { &c->G, CONTACT_TOUCH*n }, { &c->R, CONTACT_TOUCH*n },
        { &c->impulse, count }, { &c->touches, count }, { &c->refused, count }, { &c->size, count }, { &c->unit, count },
        { &c->saved[0].x, 2*n }, { &c->saved[1].x, 2*n }, { &c->saved[2].x, 2*n },
        { &gap[0], 4*count }, { &gap[1], 4*count }
    };
    for (size_t i = 0; i < sizeof list/sizeof *list; ++i) {
        *list[i].to = memory ? memory + used : NULL;
        used += list[i].count;
    }
    for (int i = 0; i < 2; ++i) c->sample[i] = (contact_gap *)(void *)gap[i];
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
    c->before = c->on = c->last = 0, c->trials = 0, c->energy = c->h = 0, c->way = 1;
    for (int i = 0; i < c->first; ++i) c->before += desc->effects[i].rows;
    gvi_status status = contact__said(c, &c->st, gvi_init(&c->st, desc, c->memory, gvi_size(desc)));
    if (!status) status = gvi_init(&c->probe, &c->probe_desc, c->probe_memory, gvi_size(&c->probe_desc));
    return contact__fail(c, -1, status);
}

/* Contact a at the start: is it open, and are its derivatives those of phi?  gvi_project compares them with
   differences, once after each gvi_init.  */
static inline gvi_status contact__check(contact *c, int a, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const contact_gap g = contact__gap(c, a, t, q, v);
    const int was = c->row[0].which;
    if (g.phi < -g.noise) return contact__fail(c, a, CONTACT_E_PENETRATES);
    memcpy(c->u, q, (size_t)c->st.n*sizeof *c->u);
    memcpy(c->w, v, (size_t)c->st.n*sizeof *c->w);
    c->row[0].which = a;
    gvi_status status = gvi_init(&c->probe, &c->probe_desc, c->probe_memory, gvi_size(&c->probe_desc));
    if (!status) status = contact__switch(c, &c->probe, 1);
    if (!status) status = contact__said(c, &c->probe, gvi_project(&c->probe, t, c->u, c->w, NULL));
    c->row[0].which = was;
    return status == GVI_E_ARGUMENT ? contact__fail(c, a, status) : GVI_OK;
}

/* The first step decides what becomes of contacts that touch already.  */
static inline gvi_status contact_start(contact *c, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_status status = GVI_OK;
    for (int a = 0; a < c->count && !status; ++a) status = contact__check(c, a, t, q, v);
    if (status) return status;
    status = contact__switch(c, &c->st, 0);
    if (!status) status = contact__said(c, &c->st, gvi_start(&c->st, t, q, v));
    if (status) return (void)contact__switch(c, &c->st, c->on), contact__fail(c, -1, status);
    memset(c->size, 0, (size_t)c->count*sizeof *c->size);
    c->on = 0, c->fresh = 1, c->fault = -1;
    return status;
}

/* ---- linear complementarity ---- */

/* How fast y_i = b_i + (W z)_i grows with z_i where the y of the set `in` stay 0, and how fast their z grow, d:
   Gauss's elimination.  0: i depends on the set.  */
static inline gvi_real contact__direction(int k, const gvi_real *W, const int *in, int i, gvi_real *d)
{
    gvi_real A[CONTACT_TOUCH*CONTACT_TOUCH];
    memcpy(A, W, (size_t)(k*k)*sizeof *A);
    for (int p = 0; p < k; ++p) {
        for (int r = 0; r < k && in[p] > 0; ++r) {
            const gvi_real f = A[r*k + p]/A[p*k + p];
            for (int j = 0; j < k && r != p && (in[r] > 0 || r == i); ++j) A[r*k + j] -= f*A[p*k + j];
        }
    }
    for (int p = 0; p < k; ++p) d[p] = in[p] > 0 ? -A[p*k + i]/A[p*k + p] : p == i;
    return A[i*k + i] > 1000*contact__eps*W[i*k + i] ? A[i*k + i] : 0;
}

/* z_i grows until y_i is 0 or, again and again, a z of the set falls to 0 and leaves it.  0: nothing stops it.  */
static inline int contact__raise(int k, const gvi_real *W, int *in, int i, gvi_real y, gvi_real *z)
{
    gvi_real d[CONTACT_TOUCH];
    for (int out = 0; out >= 0; ) {
        const gvi_real w = contact__direction(k, W, in, i, d);
        gvi_real way = w > 0 ? -y/w : -1;
        out = -1;
        for (int j = 0; j < k; ++j)
            if (in[j] > 0 && d[j] < 0 && (way < 0 || z[j] < -way*d[j])) way = -z[j]/d[j], out = j;
        if (way < 0) return 0;
        for (int j = 0; j < k; ++j) z[j] = contact__most(z[j] + way*d[j], 0);
        y += way*w;
        if (out >= 0) z[out] = 0, in[out] = 0;
    }
    return in[i] = 1;
}

/* z >= 0 with y = W z + b >= 0 and z'y = 0, W [k][k]: the minimum of z'W z/2 + b'z, by active sets.  0: none.  */
static inline int contact__lcp(int k, const gvi_real *W, const gvi_real *b, gvi_real *z)
{
    int in[CONTACT_TOUCH] = { 0 };                         // -1: depends on the set, and y is rounding
    gvi_real size = 0;
    for (int i = 0; i < k; ++i) {
        z[i] = 0;
        size = contact__most(size, contact__abs(b[i])/GVI_SQRT(W[i*k + i]));
    }
    for (int pass = 0; pass < 50*k + 50; ++pass) {
        gvi_real least = -32*contact__eps*size, speed = 0;
        int i = -1;
        for (int j = 0; j < k; ++j) {
            const gvi_real unit = GVI_SQRT(W[j*k + j]), y = b[j] + contact__dot(k, W + j*k, z);
            if (!in[j] && y/unit < least) least = y/unit, speed = y, i = j;
        }
        if (i < 0) return 1;
        if (contact__raise(k, W, in, i, speed, z)) continue;
        if (least < -GVI_SQRT(contact__eps)*size) return 0;
        in[i] = -1;
    }
    return 0;
}

/* ---- at one state: c->q, c->v ---- */

static inline gvi_status contact__load(contact *c)
{
    memcpy(c->q, c->st.q, (size_t)c->st.n*sizeof *c->q);
    return contact__said(c, &c->st, gvi_velocity(&c->st, c->v));
}

/* c->q, to c->u, and v projected with a as the only contact, or none: gvi.h's way to M^-1.  */
static inline gvi_status contact__project(contact *c, int a, gvi_real *v, gvi_real *moved)
{
    const int was = c->row[0].which;
    memcpy(c->u, c->q, (size_t)c->st.n*sizeof *c->u);
    if (a >= 0) c->row[0].which = a;
    gvi_status status = contact__switch(c, &c->probe, a >= 0);
    if (!status) status = contact__said(c, &c->probe, gvi_project(&c->probe, c->st.t, c->u, v, moved));
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

/* What presses, `closed`, and all whose gap is 0.  */
static inline gvi_status contact__touching(contact *c, int closed, contact_set *s)
{
    s->k = 0;
    for (int a = 0; a < c->count; ++a) {
        const contact_gap g = contact__gap(c, a, c->st.t, c->q, c->v);
        if (a != closed && contact__slot(c, a) < 0 && g.phi > g.noise) continue;
        if (s->k == CONTACT_TOUCH) return contact__fail(c, a, CONTACT_E_TOO_MANY);
        s->which[s->k++] = a;
    }
    return GVI_OK;
}

/* Gradients, responses and normal speeds.  What cannot respond is left out, if it does not approach.  */
static inline gvi_status contact__measure(contact *c, contact_set *s)
{
    const int n = c->st.n, touch = s->k;
    s->k = 0;
    for (int i = 0; i < touch; ++i) {
        const int k = s->k, a = s->which[i];
        const contact_gap g = contact__gap(c, a, c->st.t, c->q, c->v);
        gvi_real *G = c->G + k*n;
        memcpy(G, c->at + n, (size_t)n*sizeof *G);
        const gvi_real w = contact__response(c, a, g.rate - contact__dot(n, G, c->v), G, c->R + k*n);
        if (w < 0) return contact__fail(c, a, (int)w);
        if (!(w > 0) && c->way*g.rate < -g.tiny) return contact__fail(c, a, CONTACT_E_JAMMED);
        s->which[k] = a, s->speed[k] = c->way*g.rate, s->tiny[k] = g.tiny, s->z[k] = 0;
        c->unit[a] = GVI_SQRT(w);
        s->k += w > 0;
    }
    for (int i = 0; i < s->k; ++i)
        for (int j = 0; j <= i; ++j)
            s->W[i*s->k + j] = s->W[j*s->k + i] = (contact__dot(n, c->G + i*n, c->R + j*n)
                                                   + contact__dot(n, c->G + j*n, c->R + i*n))/2;
    return GVI_OK;
}

/* ---- impacts ---- */

/* Speeds after the impulses z; the energy that they take.  */
static inline gvi_real contact__after(contact_set *s)
{
    gvi_real taken = 0;
    for (int i = 0; i < s->k; ++i) {
        s->after[i] = s->speed[i] + contact__dot(s->k, s->W + i*s->k, s->z);
        taken -= s->z[i]*(s->after[i] + s->speed[i])/2;
    }
    return taken;
}

/* By their own e, by the least of them, by 0: the first that gains nothing.  */
static inline gvi_status contact__together(contact *c, contact_set *s, int slow)
{
    gvi_real b[CONTACT_TOUCH], e[CONTACT_TOUCH], least = 1;
    for (int i = 0; i < s->k; ++i) {
        const int hits = s->speed[i] < -s->tiny[i];
        e[i] = c->e && !slow && hits ? c->e[s->which[i]] : 0;
        if (hits && e[i] < least) least = e[i];
    }
    for (int pass = 0; pass < 3; ++pass) {
        for (int i = 0; i < s->k; ++i) b[i] = s->speed[i]*(1 + (pass == 0 ? e[i] : pass == 1 && e[i] > 0 ? least : 0));
        if (!contact__lcp(s->k, s->W, b, s->z)) return contact__fail(c, s->which[0], CONTACT_E_JAMMED);
        if (contact__after(s) >= -1000*contact__eps*s->size) break;
    }
    return GVI_OK;
}

static inline gvi_status contact__in_turn(contact *c, contact_set *s)
{
    for (int pass = 0; pass < 10000; ++pass) {
        int f = -1;
        (void)contact__after(s);
        for (int i = 0; i < s->k; ++i)
            if (s->after[i] < -s->tiny[i] && (f < 0 || s->after[i] < s->after[f])) f = i;
        if (f < 0) return GVI_OK;
        s->z[f] -= (1 + (c->e && s->after[f] < -c->rest ? c->e[s->which[f]] : 0))*s->after[f]/s->W[f*s->k + f];
    }
    return contact__fail(c, s->which[0], CONTACT_E_JAMMED);
}

/* Where all that approaches is slower than `rest`, nothing bounces, and what would leave slower stays.  */
static inline gvi_status contact__impact(contact *c, contact_set *s)
{
    int slow = 1;
    s->size = 0;
    for (int i = 0; i < s->k; ++i) {
        slow &= s->speed[i] > -c->rest;
        s->size += s->speed[i]*s->speed[i]/s->W[i*s->k + i];
    }
    const gvi_status status = c->in_turn ? contact__in_turn(c, s) : contact__together(c, s, slow);
    if (status) return status;
    c->energy += contact__after(s);
    memset(c->impulse, 0, (size_t)c->count*sizeof *c->impulse);

    for (int i = 0; i < s->k; ++i) {
        const int a = s->which[i], bounces = c->e && c->e[a] > 0 && s->speed[i] < -s->tiny[i];
        for (int j = 0; j < c->st.n; ++j) c->v[j] += c->way*c->R[i*c->st.n + j]*s->z[i];
        c->impulse[a] = s->z[i];
        if (s->z[i] > 0) contact__tell(c, CONTACT_IMPACT, a);
        s->speed[i] = slow && s->after[i] < c->rest ? 0 : s->after[i];
        if (slow && (bounces || s->speed[i] < s->after[i])) contact__tell(c, CONTACT_CAPTURED, a);
    }
    return contact__project(c, -1, c->v, NULL);            // what is left may be rounding of what was
}

/* ---- what presses ---- */

/* z: which of those without normal speed have to push, over the next 1/64 of the step without them.  */
static inline gvi_status contact__pressing(contact *c, contact_set *s)
{
    gvi_real b[CONTACT_TOUCH] = { 0 }, z[CONTACT_TOUCH], W[CONTACT_TOUCH*CONTACT_TOUCH], most = 0;
    int in[CONTACT_TOUCH], k = 0;
    gvi_status status = contact__switch(c, &c->st, 0);
    if (!status) status = contact__said(c, &c->st, gvi_start(&c->st, c->st.t, c->q, c->v));
    if (!status) status = contact__said(c, &c->st, gvi_step(&c->st, c->way*c->h/64));
    if (!status) status = contact__said(c, &c->st, gvi_velocity(&c->st, c->w));
    if (status) return status;

    for (int i = 0; i < s->k; ++i) {
        s->z[i] = 0;
        if (s->speed[i] > s->tiny[i]) continue;
        const contact_gap now = contact__gap(c, s->which[i], c->st.t0, c->q, c->v),
                          then = contact__gap(c, s->which[i], c->st.t, c->st.q, c->w);
        b[k] = c->way*(then.rate - now.rate);
        if (contact__abs(b[k]) <= then.tiny) b[k] = 0;
        c->size[s->which[i]] = 64*c->h*contact__abs(b[k]);              // gap'' h^2
        in[k++] = i;
    }
    for (int i = 0; i < k*k; ++i) W[i] = s->W[in[i/k]*s->k + in[i % k]];
    if (!contact__lcp(k, W, b, z)) return contact__fail(c, s->which[in[0]], CONTACT_E_JAMMED);
    for (int i = 0; i < k; ++i) most = contact__most(most, z[i]*GVI_SQRT(W[i*k + i]));
    for (int i = 0; i < k; ++i) if (z[i]*GVI_SQRT(W[i*k + i]) > 1000*contact__eps*most) s->z[in[i]] = z[i];
    return GVI_OK;
}

/* What presses no more, and what presses now.  */
static inline void contact__tell_changes(contact *c, int was_on, const int *was)
{
    for (int k = 0; k < was_on; ++k) {
        if (contact__slot(c, was[k]) >= 0) continue;
        contact__tell(c, CONTACT_OPENED, was[k]);
    }
    for (int k = 0, old; k < c->on; ++k) {
        for (old = 0; old < was_on && was[old] != c->row[k].which; ++old) { }
        if (old == was_on) contact__tell(c, CONTACT_CLOSED, c->row[k].which);
    }
}

/* Starts at t from c->q and c->v, projected on the first `on` slots, which are switched on.  */
static inline gvi_status contact__place(contact *c, gvi_real t, gvi_real t_low)
{
    gvi_real moved[2];
    gvi_status status = contact__switch(c, &c->probe, c->on);
    if (!status) status = contact__said(c, &c->probe, gvi_project(&c->probe, t, c->q, c->v, moved));
    if (!status) status = contact__switch(c, &c->st, 0);
    if (!status) status = contact__said(c, &c->st, gvi_start(&c->st, t, c->q, c->v));
    if (status) return status;
    c->st.t_low = t_low;
    c->energy += moved[1]*moved[1]/2;                     // of what was captured as it left
    return contact__switch(c, &c->st, c->on);
}

/* Rows for those with z > 0, from c->q and c->v at t.  */
static inline gvi_status contact__hold(contact *c, const contact_set *s, gvi_real t, gvi_real t_low)
{
    const int was_on = c->on;
    int was[CONTACT_TOUCH];
    for (int k = 0; k < was_on; ++k) was[k] = c->row[k].which;
    c->on = 0;
    for (int i = 0; i < s->k; ++i) {
        if (!(s->z[i] > 0)) continue;
        if (c->on == c->slots) return contact__fail(c, s->which[i], CONTACT_E_TOO_MANY);
        c->row[c->on++].which = s->which[i];
    }
    const gvi_status status = contact__place(c, t, t_low);
    if (!status) contact__tell_changes(c, was_on, was);
    return status == GVI_E_CONSTRAINT ? contact__fail(c, s->which[0], CONTACT_E_JAMMED) : status;
}

/* ---- back ---- */

static inline void contact__save(contact *c, contact_state *s)
{
    const size_t n = (size_t)c->st.n, one = sizeof *s->x;
    s->t = c->st.t, s->t_low = c->st.t_low, s->next = c->st.next, s->energy = c->energy;
    s->fresh = c->fresh, s->on = c->on;
    for (int k = 0; k < c->on; ++k) s->which[k] = c->row[k].which;
    memcpy(s->seen, c->seen, sizeof c->seen);
    memcpy(s->x, c->st.q, n*one);
    memcpy(s->x + n, c->st.p, n*one);
}

/* The state that was saved, to the bit; projected again where all that a row measures it by is rounding.  */
static inline gvi_status contact__back(contact *c, const contact_state *s)
{
    const size_t n = (size_t)c->st.n;
    gvi_status status = contact__switch(c, &c->st, 0);
    if (!status) status = contact__said(c, &c->st, gvi_start_momentum(&c->st, s->t, s->x, s->x + n));
    if (status) return status;
    c->st.t_low = s->t_low, c->energy = s->energy, c->fresh = s->fresh, c->on = s->on;
    for (int k = 0; k < c->on; ++k) c->row[k].which = s->which[k];
    memcpy(c->seen, s->seen, sizeof c->seen);
    status = contact__switch(c, &c->st, c->on);
    if (status == GVI_E_CONSTRAINT && !(status = contact__load(c))) status = contact__place(c, s->t, s->t_low);
    c->st.next = s->next;
    return status;
}

/* The step that was saved, made again with length h.  */
static inline gvi_status contact__again(contact *c, const contact_state *from, gvi_real h)
{
    gvi_status status = contact__back(c, from);
    ++c->trials;
    if (!status && contact__abs(h) > 0) status = contact__said(c, &c->st, gvi_step(&c->st, h));
    return status ? status : contact__load(c);
}

/* What presses where that is undecided: 1/64 of the step later, on the motion as it was.  If that is nothing new, not the
   rows of `bits`, or `closed`.  */
static inline gvi_status contact__look_ahead(contact *c, int closed, unsigned bits, contact_set *s)
{
    contact__save(c, &c->saved[2]);
    gvi_status status = contact__said(c, &c->st, gvi_step(&c->st, c->way*c->h/64));
    if (!status) status = contact__load(c);
    if (!status) status = contact__measure(c, s);
    for (int i = 0; i < s->k; ++i) s->speed[i] = 0;
    if (!status) status = contact__pressing(c, s);
    if (!status) status = contact__back(c, &c->saved[2]);
    if (!status) status = contact__load(c);

    int same = 1;
    for (int i = 0; i < s->k; ++i) same &= (s->z[i] > 0) == (contact__slot(c, s->which[i]) >= 0);
    for (int i = 0; i < s->k && same; ++i) {
        const int row = contact__slot(c, s->which[i]);
        if (row >= 0 && (bits >> row & 1u)) s->z[i] = 0;
        if (s->which[i] == closed) s->z[i] = 1;
    }
    return status;
}

/* At the present state, where gap `closed` has closed, or -1: impact, and what presses after it.  Undecided: it has not
   been open before, or the lambda of the rows of `bits` is 0.  */
static inline gvi_status contact__resolve(contact *c, int closed, int undecided, unsigned bits)
{
    const gvi_real t = c->st.t, t_low = c->st.t_low;
    contact_set s;
    int hit = 0;
    s.k = 0;
    gvi_status status = contact__load(c);
    if (!status) status = contact__touching(c, closed, &s);
    if (!status) status = contact__measure(c, &s);
    for (int i = 0; i < s.k && !status; ++i) hit |= s.speed[i] < -s.tiny[i] && contact__slot(c, s.which[i]) < 0;
    if (!status && hit) status = contact__impact(c, &s);
    if (!status) status = undecided && !hit ? contact__look_ahead(c, closed, bits, &s) : contact__pressing(c, &s);
    return status ? status : contact__hold(c, &s, t, t_low);
}

/* ---- events within a step: fractions x of it ---- */

/* All gaps on the step's curve at x, at x = 1 those of the state, to sample[last].  */
static inline gvi_status contact__sample(contact *c, gvi_real x)
{
    const gvi_status status = x < 1 ? contact__said(c, &c->st, gvi_curve(&c->st, x, c->q, c->v)) : contact__load(c);
    const gvi_real t = x < 1 ? c->st.t0 + x*c->st.h : c->st.t;
    c->last = !c->last;
    for (int a = 0; a < c->count && !status; ++a) c->sample[c->last][a] = contact__gap(c, a, t, c->q, c->v);
    return status;
}

/* Would each gap have to change four times as fast between the last two samples, the part d of the step apart, as at
   its ends, to reach 0 there?  */
static inline int contact__far(const contact *c, gvi_real d)
{
    for (int a = 0; a < c->count; ++a) {
        const contact_gap *l = &c->sample[!c->last][a], *r = &c->sample[c->last][a];
        const gvi_real way = contact__most(contact__abs(l->rate), contact__abs(r->rate))*contact__abs(d*c->st.h);
        if (contact__slot(c, a) >= 0) continue;
        if (!(l->phi > l->noise && r->phi > r->noise && l->phi + r->phi > 4*way)) return 0;
    }
    return 1;
}

/* The lowest gap of a between the last two samples, which are at x[0] and x[1]; or the first that is found below 0, at
   x[1] then.  */
static inline gvi_real contact__lowest(contact *c, int a, gvi_real *x, gvi_real noise)
{
    gvi_real l = x[0], r = x[1], s0 = c->sample[!c->last][a].rate*c->st.h, s1 = c->sample[c->last][a].rate*c->st.h;
    gvi_real phi = c->sample[c->last][a].phi;
    for (int j = 0; j < 40 && r - l > GVI_SQRT(contact__eps) && !(phi < -noise); ++j) {
        x[1] = j % 3 == 2 ? (l + r)/2 : l + (r - l)*(s0/(s0 - s1));
        (void)gvi_curve(&c->st, x[1], c->q, c->v);
        const contact_gap g = contact__gap(c, a, c->st.t0 + x[1]*c->st.h, c->q, c->v);
        phi = g.phi;
        if (g.rate*c->st.h < 0) l = x[1], s0 = g.rate*c->st.h; else r = x[1], s1 = g.rate*c->st.h;
    }
    return phi;
}

/* Does gap a close between the last two samples, at x[0] and x[1]?  Either it is closed at x[1], or it turns in between,
   below 0: then x[1] is there.  */
static inline int contact__closes(contact *c, int a, gvi_real *x)
{
    const contact_gap *l = &c->sample[!c->last][a], *r = &c->sample[c->last][a];
    const gvi_real s0 = l->rate*c->st.h, s1 = r->rate*c->st.h;
    if (r->phi < -r->noise) return 1;
    if (c->touches[a] > 0 || !(s0 < 0 && s1 > 0)) return 0;
    if (l->phi + s0*((l->phi - r->phi + s1*(x[1] - x[0]))/(s1 - s0)) >= r->noise) return 0;      // tangents meet above
    const gvi_real low = contact__lowest(c, a, x, r->noise);
    if (low <= r->noise && low >= -r->noise) contact__tell(c, CONTACT_GRAZED, a);
    return low < -r->noise;
}

/* Of the gaps that close between the last two samples, at from and to, the first: *which, between x[0] and x[1].  */
static inline void contact__first(contact *c, gvi_real from, gvi_real to, gvi_real *x, int *which)
{
    for (int a = 0; a < c->count; ++a) {
        const contact_gap *now = &c->sample[c->last][a];
        gvi_real y[2] = { from, to };
        if (contact__slot(c, a) < 0 && contact__closes(c, a, y) && y[1] > c->refused[a] && (*which < 0 || y[1] < x[1]))
            *which = a, x[0] = y[0], x[1] = y[1];
        if (now->phi > now->noise) c->touches[a] = 0;
    }
}

/* The first gap that closes on the curve after x[0], or from the start on, whose sample is the last, where x[0] < 0:
   *which, or -1.  s + 1 intervals; five in a row need no look inside where all gaps are far, since a step of s = 5 m has
   no more than m periods in it.  */
static inline gvi_status contact__find(contact *c, gvi_real *x, int *which)
{
    const int points = c->st.s < 3 ? 4 : c->st.s + 1;
    gvi_real from = contact__most(x[0], 0), to;
    int look = 0;
    gvi_status status = x[0] < 0 ? GVI_OK : contact__sample(c, from);
    *which = -1;
    for (int a = 0; a < c->count; ++a) c->touches[a] = c->sample[c->last][a].phi <= c->sample[c->last][a].noise;
    for (int k = (int)(from*(gvi_real)points), next; k < points && *which < 0 && !status; k = next, from = to) {
        next = k < look ? k + 1 : k + 5 < points ? k + 5 : points;
        to = (gvi_real)next/(gvi_real)points;
        status = contact__sample(c, to);
        if (!status && next > k + 1 && !contact__far(c, to - from)) {
            look = next, next = k + 1, c->last = !c->last;
            to = (gvi_real)next/(gvi_real)points;
            status = contact__sample(c, to);
        }
        if (!status) contact__first(c, from, to, x, which);
    }
    return status;
}

/* The step of length h made again to end where gap a closes, between x[0] and x[1] of it: at *at, or -1: it does not.
   Newton's method, by halves where that leads out.  */
static inline gvi_status contact__land(contact *c, const contact_state *from, int a, gvi_real h, const gvi_real *x,
                                       gvi_real *at)
{
    gvi_real lo = x[0], hi = x[1], y = hi, least = -1;
    for (int j = 0; j < 60; ++j) {
        const gvi_status status = contact__again(c, from, y*h);
        if (status) return status;
        const contact_gap g = contact__gap(c, a, c->st.t, c->q, c->v);
        const gvi_real size = contact__abs(g.phi), rate = g.rate*h;
        *at = y;
        if ((j == 0 && c->touches[a] > 0 && g.phi >= -g.noise) || (g.phi > 0 && rate >= 0)) return *at = -1, GVI_OK;
        if (size <= g.noise/64 || (least >= 0 && j > 3 && size >= least && size <= g.noise)) break;
        least = size;
        if (g.phi > 0) lo = contact__most(lo, y); else if (y < hi) hi = y;
        y -= rate < 0 ? g.phi/rate : 0;
        if (g.phi > 0 && y >= hi) hi += (hi - lo)/16, y = y < hi ? y : hi;     // the curve is less exact than the step
        if (!(y > lo && y < hi)) y = (lo + hi)/2;
        if (contact__abs(y - *at) <= contact__eps*y) break;
    }
    return GVI_OK;
}

/* The step of length h made again to end at *part of it, where the first gap closes: *which, or -1.  *undecided: that
   has not been open in the step by more than its rounding; if it strikes, it has never left, at *part = 0.  */
static inline gvi_status contact__closing(contact *c, const contact_state *from, gvi_real h, gvi_real *part, int *which,
                                          int *undecided)
{
    gvi_real x[2] = { -1, 1 }, at = 0;
    gvi_status status = GVI_OK;
    memset(c->refused, 0, (size_t)c->count*sizeof *c->refused);
    for (int a = 0; *part > 0 && !(status = contact__find(c, x, &a)) && a >= 0; ) {
        if (x[0] < 0) x[0] = 0;
        if ((status = contact__land(c, from, a, *part*h, x, &at))) break;
        if (at < 0) {                                      // a does not close; another may, in the same interval
            c->refused[a] = x[1] + (gvi_real)1e-3;
            if ((status = contact__again(c, from, *part*h))) break;
            continue;
        }
        const contact_gap g = contact__gap(c, a, c->st.t, c->q, c->v);
        *part *= at, *which = a, x[0] = 0;
        memset(c->refused, 0, (size_t)c->count*sizeof *c->refused);
        *undecided = c->touches[a] > 0 && contact__abs(g.rate**part*h) <= 4*g.noise;
        if (!*undecided) continue;
        *part = 0;
        status = contact__again(c, from, 0);
    }
    return status;
}

/* lambda of each row now, to c->lambda + c->before.  */
static inline gvi_status contact__lambda(contact *c)
{
    return contact__said(c, &c->st, gvi_multipliers(&c->st, c->lambda));
}

/* The least lambda in parts of the scales, and the rows in which it is below 0 by more than rounding.  A row whose scale is
   rounding of another's has no sign.  */
static inline gvi_real contact__part(const contact *c, const gvi_real *scale, unsigned *below)
{
    gvi_real least = 1, most = 0;
    *below = 0;
    for (int k = 0; k < c->on; ++k) most = contact__most(most, scale[k]*c->unit[c->row[k].which]);
    for (int k = 0; k < c->on; ++k) {
        const int counts = scale[k]*c->unit[c->row[k].which] > 1000*contact__eps*most;
        const gvi_real part = counts ? c->lambda[c->before + k]/scale[k] : 1;
        if (part < least) least = part;
        if (part < -1000*contact__eps) *below |= 1u << k;
    }
    return least;
}

/* The same for the multipliers that the step has kept, at x.  */
static inline gvi_real contact__kept(contact *c, gvi_real x, const gvi_real *scale)
{
    unsigned unused;
    return gvi_curve_multipliers(&c->st, x, c->lambda) ? 0 : contact__part(c, scale, &unused);
}

/* Where they are least: *at, by parabolas.  Scales: the largest of each row.  0: not known.  */
static inline gvi_real contact__least(contact *c, gvi_real *scale, gvi_real *at)
{
    const int points = 2*c->st.s;
    gvi_real least = 1, step = 1/(gvi_real)points;
    for (int k = 0; k <= points; ++k) {
        if (gvi_curve_multipliers(&c->st, (gvi_real)k*step, c->lambda)) return 0;
        for (int i = 0; i < c->on; ++i) scale[i] = contact__most(scale[i], contact__abs(c->lambda[c->before + i]));
    }
    for (int k = 0; k <= points; ++k) {
        const gvi_real x = (gvi_real)k/(gvi_real)points, part = contact__kept(c, x, scale);
        if (part <= least) least = part, *at = x;
    }
    for (int j = 0; j < 4 && *at > 0 && *at < 1; ++j) {
        step = -contact__most(-step/4, contact__most(-*at, *at - 1));
        const gvi_real l = contact__kept(c, *at - step, scale), r = contact__kept(c, *at + step, scale),
                       bend = l + r - 2*contact__kept(c, *at, scale);
        if (bend > 0) *at -= step*((r - l)/(2*bend));
    }
    return least;
}

/* The step made again with length h, its multipliers and the least of them.  */
static inline gvi_status contact__try(contact *c, const contact_state *from, gvi_real h, const gvi_real *scale,
                                      gvi_real *least, unsigned *below)
{
    gvi_status status = contact__again(c, from, h);
    if (!status) status = contact__lambda(c);
    if (!status) *least = contact__part(c, scale, below);
    return status;
}

/* Does a lambda change its sign in the step of *x h that has been made?  Then the step ends there; *bits: whose.  */
static inline gvi_status contact__opening(contact *c, const contact_state *from, gvi_real h, gvi_real *x, unsigned *bits)
{
    gvi_real scale[CONTACT_TOUCH] = { 0 }, at = 1, a = 0, fa = 0, b = *x, fb;
    unsigned unused;
    if (!c->on || !(*x > 0)) return GVI_OK;
    if (contact__least(c, scale, &at) > (gvi_real)0.125 && c->st.s > 1) return GVI_OK;     // by more than its own error
    gvi_status status = contact__lambda(c);
    for (int k = 0; k < c->on; ++k) scale[k] = contact__most(scale[k], contact__abs(c->lambda[c->before + k]));
    fb = contact__part(c, scale, bits);
    if (!status && !*bits && at > 0 && at < 1) {                      // below 0 inside, and not at the end?
        status = contact__try(c, from, (b = at**x)*h, scale, &fb, bits);
        if (!status && !*bits) status = contact__again(c, from, *x*h);
    }
    if (status || !*bits) return status;

    status = contact__try(c, from, 0, scale, &fa, &unused);
    *x = fa > 1000*contact__eps ? b : 0;                              // from the start on
    for (int j = 0, side = 0; j < 60 && *x > 0 && !status; ++j) {     // Illinois's method
        gvi_real f = 0;
        *x = a + (b - a)*(fa/(fa - fb));
        if (!(*x > a && *x < b)) *x = a + (b - a)/2;
        status = contact__try(c, from, *x*h, scale, &f, &unused);
        if (contact__abs(f) <= 1000*contact__eps || b - a <= 4*contact__eps*b) break;
        if (f > 0) { a = *x, fa = f; if (side < 0) fb /= 2; side = -1; }
        else { b = *x, fb = f; if (side > 0) fa /= 2; side = 1; }
    }
    return status;
}

/* ---- steps ---- */

/* A step of h, or by the dial towards t_end, to the first event at most.  */
static inline gvi_status contact__once(contact *c, const contact_state *from, gvi_real h, gvi_real t_end, int dial,
                                       gvi_real *made)
{
    gvi_real part = 1;
    unsigned bits = 0;
    int closes = -1, undecided = 0;
    gvi_status status = contact__sample(c, 1);
    if (!status) status = contact__said(c, &c->st, dial ? gvi_advance(&c->st, t_end) : gvi_step(&c->st, h));
    if (status) return status;
    const gvi_real next = c->st.next, whole = c->st.h;
    c->h = contact__abs(whole);
    status = contact__closing(c, from, whole, &part, &closes, &undecided);
    if (!status) status = contact__opening(c, from, whole, &part, &bits);
    *made = part*whole;
    if (status) return status;
    if (bits) status = contact__resolve(c, -1, 1, bits);
    else if (closes >= 0) status = contact__resolve(c, closes, undecided, 0);
    c->st.next = next;
    return status;
}

static inline gvi_status contact__run(contact *c, gvi_real h, gvi_real t_end, int dial)
{
    const int most = c->most > 0 ? c->most : 1000;
    gvi_real left = h, made = 0;
    gvi_status status = GVI_OK;
    const contact_state *from = c->saved;
    c->fault = -1;
    contact__save(c, &c->saved[0]);
    c->way = (dial ? t_end < c->st.t : h < 0) ? -1 : 1;
    c->h = contact__abs(!dial ? h : c->st.next > 0 || c->st.next < 0 ? c->st.next : (t_end - c->st.t)/64);
    if (c->fresh && !(status = contact__resolve(c, -1, 0, 0))) {
        c->fresh = 0;
        contact__save(c, &c->saved[1]);
        from = c->saved + 1;
    }
    for (int i = 0; !status; ++i) {
        status = i == most ? contact__fail(c, -1, CONTACT_E_PILE_UP) : contact__once(c, from, left, t_end, dial, &made);
        left -= made;
        if (status || dial || contact__abs(left) <= 8*contact__eps*contact__abs(h)) break;
        contact__save(c, &c->saved[1]);
        from = c->saved + 1;
    }
    if (status) (void)contact__back(c, c->saved);
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
    const int k = contact__slot(c, a);
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
