/* own.h - the visitor's own L or H: a list of operations instead of a C function

   The page (lagrangian.js) turns what is typed into operations on numbered values: t, q, v (of H: p),
   then one more for each operation.  tools/lagrangian.h finds out what L is and makes the effect and
   the mass of it, as in the C program that the page writes.  Only the derivatives come by another
   way: one sweep forwards and one back give all of them, exact to rounding; along a direction, the
   second ones too, for the rivals, which need accelerations.                             */
#ifndef OWN_H
#define OWN_H

#include "scenes.h"

/* exp to an ulp: x = n log 2 + r, the series of r.                                        */
static double own_exp(double x)
{
    const double n = __builtin_floor(x*1.4426950408889634074 + 0.5);
    const double r = (x - n*0.693147180369123816490) - n*1.90821492927058770002e-10;
    union { uint64_t bits; double value; } power;
    double sum = 1;
    if (!(n < 1024)) return x < INFINITY ? INFINITY : x;
    if (n < -1022) return 0;
    for (int k = 14; k > 0; --k) sum = 1 + sum*r/k;
    power.bits = (uint64_t)(int64_t)(1023 + n) << 52;
    return sum*power.value;
}

/* log of a positive normal number: x = 2^n m, m near 1, and the series of (m - 1)/(m + 1).   */
static double own_log(double x)
{
    union { double value; uint64_t bits; } u = { x };
    double n = (double)(u.bits >> 52) - 1023, sum = 0;
    if (!(x > 2.3e-308 && x < INFINITY)) return NAN;
    u.bits = (u.bits & 0xFFFFFFFFFFFFFu) | (uint64_t)1023 << 52;
    if (u.value > 1.4142135623730951) u.value /= 2, n += 1;
    const double s = (u.value - 1)/(u.value + 1), z = s*s;
    for (int k = 25; k > 1; k -= 2) sum = (sum + 1.0/k)*z;
    return n*0.693147180369123816490 + (2*s + (2*s*sum + n*1.90821492927058770002e-10));
}

/* x^a: products for whole a, a root for halves, exp(a log x) for the rest.                  */
static double own_pow(double x, double a)
{
    const double size = fabs(a), whole = __builtin_floor(size);
    const int half = size - whole <= 0.5 && size - whole >= 0.5;
    if (!(size <= 64) || (size > whole && !half)) return own_exp(a*own_log(x));
    double y = half ? __builtin_sqrt(x) : 1, square = x;
    for (int k = (int)whole; k; k /= 2, square *= square)
        if (k & 1) y *= square;
    return a < 0 ? 1/y : y;
}
/* atan: from |x| <= 1 to a quarter of the angle, below 0.2, and the series there.              */
static double own_atan(double x)
{
    if (fabs(x) > 1) return (x < 0 ? -1.5707963267948966 : 1.5707963267948966) - own_atan(1/x);
    double y = x/(1 + __builtin_sqrt(1 + x*x)), sum = 0;
    y = y/(1 + __builtin_sqrt(1 + y*y));
    for (int k = 27; k > 1; k -= 2) sum = (1.0/k - sum)*y*y;
    return 4*(y - y*sum);
}
#define own_sin(x) bounded_sine(x, 0)
#define own_cos(x) bounded_sine(x, 1)

#define LAGRANGIAN_MOST 8
#include <stdio.h>
#define snprintf own_sentence
static int own_sentence(char *to, size_t room, const char *form, ...);
#include "tools/lagrangian.h"
#undef snprintf
#include <stdarg.h>

/* What the sentences of lagrangian.h need of snprintf: %s, %d of one digit; numbers are left out. */
static int own_sentence(char *to, size_t room, const char *form, ...)
{
    va_list list;
    char *end = to + room - 1;
    va_start(list, form);
    for (; *form && to < end; ++form) {
        if (*form != '%') { *to++ = *form; continue; }
        if (*++form == 's') {
            for (const char *s = va_arg(list, const char *); *s && to < end; ++s) *to++ = *s;
        } else if (*form == 'd') {
            *to++ = (char)('0' + va_arg(list, int));
        } else {
            (void)va_arg(list, double);
            form += 2;                                         /* of %.6g                  */
        }
    }
    *to = 0;
    va_end(list);
    return 0;
}

enum { OWN_MOST = 600,                 /* operations                                       */
       OWN_INPUTS = 1 + 2*LAGRANGIAN_MOST, OWN_POINTS = 12, OWN_ROWS = 4 };
enum { OWN_CONSTANT, OWN_ADD, OWN_SUBTRACT, OWN_MULTIPLY, OWN_DIVIDE, OWN_POWER,
       OWN_SQRT, OWN_EXP, OWN_LOG, OWN_SIN, OWN_COS, OWN_TAN, OWN_ATAN };

/* What the page writes: operation, operands, constant; q and v at the start; x, y of the picture; where
   the force on each coordinate is, -1 for none; how many constraints there are, how many of them on
   velocities, and where they are, those last; -1 for H, whose v is p, or L.kind if it is set. */
static double own_typed[4*OWN_MOST + 3*LAGRANGIAN_MOST + 2*OWN_POINTS + 2 + OWN_ROWS + 1];

static struct own {
    int        n, length, whole, points;          /* operations of L, and of the picture as well */
    struct { int op, a, b; double c; } step[OWN_MOST];
    int        at[2*OWN_POINTS], force[LAGRANGIAN_MOST], forced, row[OWN_ROWS], holds, rolls;
    double     value[OWN_INPUTS + OWN_MOST], tangent[OWN_INPUTS + OWN_MOST];
    double     adjoint[OWN_INPUTS + OWN_MOST], bent[OWN_INPUTS + OWN_MOST];  /* bent: its tangent */
    double     slope[OWN_MOST][2], turn[OWN_MOST][2];    /* dy/da, dy/db and their tangents   */
    double     time, p[LAGRANGIAN_MOST];          /* that the picture is of                   */
    int        momenta;                           /* H, not L                                 */
    lagrangian L;
    hamiltonian H;
} own;

/* Values, slopes and their tangents of the first `count` operations.                       */
static void own_forward(int count)
{
    double *value = own.value, *tangent = own.tangent;
    for (int k = 0, at = 1 + 2*own.n; k < count; ++k, ++at) {
        const int op = own.step[k].op;
        const double a = value[own.step[k].a], b = value[own.step[k].b], c = own.step[k].c;
        const double da = tangent[own.step[k].a], db = tangent[own.step[k].b];
        double y = c, to_a = 0, to_b = 0, turn_a = 0, turn_b = 0, second = 0;
        switch (op) {
        case OWN_ADD: y = a + b, to_a = to_b = 1; break;
        case OWN_SUBTRACT: y = a - b, to_a = 1, to_b = -1; break;
        case OWN_MULTIPLY: y = a*b, to_a = b, to_b = a, turn_a = db, turn_b = da; break;
        case OWN_DIVIDE:
            y = a/b, to_a = 1/b, to_b = -y/b;
            turn_a = -db/(b*b), turn_b = -(to_a*da + to_b*db)/b + y*db/(b*b);
            break;
        case OWN_POWER:
            y = own_pow(a, c), to_a = c*own_pow(a, c - 1), second = c*(c - 1)*own_pow(a, c - 2);
            break;
        case OWN_SQRT: y = __builtin_sqrt(a), to_a = 0.5/y, second = -to_a/(2*a); break;
        case OWN_EXP: y = to_a = second = own_exp(a); break;
        case OWN_LOG: y = own_log(a), to_a = 1/a, second = -to_a*to_a; break;
        case OWN_SIN: y = own_sin(a), to_a = own_cos(a), second = -y; break;
        case OWN_COS: y = own_cos(a), to_a = -own_sin(a), second = -y; break;
        case OWN_ATAN: y = own_atan(a), to_a = 1/(1 + a*a), second = -2*a*to_a*to_a; break;
        case OWN_TAN: y = own_sin(a)/own_cos(a), to_a = 1 + y*y, second = 2*y*to_a; break;
        default: break;
        }
        if (op >= OWN_POWER) turn_a = second*da;
        value[at] = y;
        tangent[at] = to_a*da + to_b*db;
        own.slope[k][0] = to_a, own.slope[k][1] = to_b;
        own.turn[k][0] = turn_a, own.turn[k][1] = turn_b;
    }
}

/* The value at `last`, its gradient in adjoint (t, q, v), and in bent the change of that along the direction in tangent. */
static double own_sweep(int last)
{
    const int inputs = 1 + 2*own.n;
    own_forward(last + 1 - inputs);
    memset(own.adjoint, 0, sizeof(double)*(size_t)last);
    memset(own.bent, 0, sizeof(double)*(size_t)(last + 1));
    own.adjoint[last] = 1;
    for (int k = last - inputs; k >= 0; --k) {
        const double y = own.adjoint[inputs + k], dy = own.bent[inputs + k];
        const int operand[2] = { own.step[k].a, own.step[k].b };
        for (int i = 0; i < 2; ++i) {
            own.adjoint[operand[i]] += own.slope[k][i]*y;
            own.bent[operand[i]] += own.slope[k][i]*dy + own.turn[k][i]*y;
        }
    }
    return own.value[last];
}

static void own_state(double t, const double *q, const double *v)
{
    own.value[0] = t;
    memcpy(own.value + 1, q, sizeof(double)*(size_t)own.n);
    memcpy(own.value + 1 + own.n, v, sizeof(double)*(size_t)own.n);
    memset(own.tangent, 0, sizeof(double)*(size_t)(1 + 2*own.n));
}

static int own_last(void) { return 2*own.n + own.length; }

/* lagrangian_function.add of what is at `last`, as row r                                  */
static void own_add_row(const lagrangian_wanted *a, int last, int r)
{
    const gvi_points *x = a->x;
    const int n = own.n, R = x->stride;
    double q[LAGRANGIAN_MOST], w[LAGRANGIAN_MOST];
    for (int k = 0; k < x->count; ++k) {
        if (lagrangian_rests(a, k)) continue;
        for (int i = 0; i < n; ++i) {
            q[i] = x->q[i*R + k];
            w[i] = a->times*(a->w ? a->w[i*R + k] : i == a->one);
        }
        own_state(x->t[k], q, w);
        const double L = own_sweep(last), *slope = own.adjoint + 1;
        for (int i = 0; i < n && a->by_q; ++i)
            if (!(fabs(slope[i]) <= a->least*fabs(L))) a->by_q[(r*n + i)*R + k] += a->scale*slope[i];
        for (int i = a->first; i < a->end && a->by_w; ++i)
            a->by_w[(r*n + i)*a->apart + k] += a->scale*slope[n + i];
        for (int d = 0; d < 2*n && a->along; ++d) a->by_along[k] += a->scale*a->along[d]*slope[d];
        if (a->by_t) a->by_t[r*R + k] += a->scale*own.adjoint[0];
        if (a->value) a->value[r*R + k] += a->scale*L;
    }
}

static void own_add(const lagrangian_wanted *a) { own_add_row(a, own_last(), 0); }

static void own_add_holds(const lagrangian_wanted *a)
{
    for (int r = 0; r < own.holds; ++r) own_add_row(a, own.row[r], r);
}

static void own_add_rolls(const lagrangian_wanted *a)
{
    for (int r = 0; r < own.rolls; ++r) own_add_row(a, own.row[own.holds + r], r);
}

/* As HOLDS and ROLLS make them                                                            */
static int own_holds(const gvi_points *x, void *user)
{
    const lagrangian_function f = { own.n, own_add_holds };
    double room[4*LAGRANGIAN_MOST + 2*OWN_ROWS];
    return lagrangian_holds(&f, own.holds, room, x, user);
}

static int own_rolls(const gvi_points *x, void *user)
{
    const lagrangian_function f = { own.n, own_add_rolls };
    double room[4*LAGRANGIAN_MOST + 2*OWN_ROWS];
    return lagrangian_rolls(&f, own.rolls, room, x, user);
}

/* f += the forces that are typed                                                          */
static void own_force(double t, const double *q, const double *v, double *f, int stride)
{
    own_state(t, q, v);
    own_forward(own.whole);
    for (int i = 0; i < own.n; ++i)
        if (own.force[i] >= 0) f[i*stride] += own.value[own.force[i]];
}

static int own_forces(const gvi_points *x, void *user)
{
    double q[LAGRANGIAN_MOST], v[LAGRANGIAN_MOST];
    for (int k = 0; k < x->count; ++k) {
        for (int i = 0; i < x->n; ++i) q[i] = x->q[i*x->stride + k], v[i] = x->v[i*x->stride + k];
        own_force(x->t[k], q, v, x->f + k, x->stride);
    }
    return (void)user, 0;
}

/* From d/dt dL/dv = dL/dq + F: (d2L/dv2) a = dL/dq - d2L/dvdq v - d2L/dvdt + F              */
static void own_slope_of_L(double t, const double *q, double *dq)
{
    const int n = own.n;
    const double *v = q + n;
    double *a = dq + n;
    double M[LAGRANGIAN_MOST*LAGRANGIAN_MOST], pivot[LAGRANGIAN_MOST + 1];
    memcpy(dq, v, sizeof(double)*(size_t)n);
    own_state(t, q, v);
    for (int j = 0; j < n; ++j) {
        own.tangent[1 + n + j] = 1;
        own_sweep(own_last());
        own.tangent[1 + n + j] = 0;
        for (int i = 0; i < n; ++i) M[i*n + j] = own.bent[1 + n + i];
    }
    own.tangent[0] = 1;
    memcpy(own.tangent + 1, v, sizeof(double)*(size_t)n);
    own_sweep(own_last());
    for (int i = 0; i < n; ++i) a[i] = own.adjoint[1 + i] - own.bent[1 + n + i];
    if (own.forced) own_force(t, q, v, a, 1);
    if (gvi_lu_factor(n, M, pivot) == GVI_OK) gvi_lu_solve(n, M, pivot, a);
    else a[0] = NAN;
}

static void own_slope_of_H(double t, const double *q, double *dq)
{
    const int n = own.n;
    own_state(t, q, q + n);
    own_sweep(own_last());
    for (int i = 0; i < n; ++i) dq[i] = own.adjoint[1 + n + i], dq[n + i] = -own.adjoint[1 + i];
}

/* v dL/dv - L, or H                                                                       */
static double own_energy(double t, const double *q, const double *v)
{
    own_state(t, q, v);
    if (own.momenta) return own_sweep(own_last());
    double E = -own_sweep(own_last());
    for (int i = 0; i < own.n; ++i) E += v[i]*own.adjoint[1 + own.n + i];
    return E;
}

static void own_build(scene_setup *s)
{
    const double *start = own_typed + 4*OWN_MOST;
    memcpy(s->q, start, sizeof(double)*(size_t)own.n);
    memcpy(s->v, start + own.n, sizeof(double)*(size_t)own.n);
    s->momenta = own.momenta;
    s->energy = own_energy;
    if (own.momenta) {
        scene_add(s, "H", "Hamilton's equations", "hamiltonian_effect(&H)", 1, hamiltonian_effect(&own.H));
        INSTEAD(s, ((gvi_effect){ 0 }));
        s->mass = hamiltonian_mass(&own.H);
        s->mass_text = "hamiltonian_mass(&H)";
        s->slope = own_slope_of_H;
        return;
    }
    const char *what = own.n ? lagrangian_text(&own.L) : "";
    scene_add(s, "L", what, "lagrangian_effect(&L)", 1, lagrangian_effect(&own.L));
    INSTEAD(s, ((gvi_effect){ 0 }));
    if (own.forced)
        scene_add(s, "F", "forces as typed", "{ .kind = GVI_FORCE, .points = force }", 1,
                  (gvi_effect){ .kind = GVI_FORCE, .points = own_forces });
    if (own.holds)
        scene_add(s, "constraints", "0 = g(t,q)", "{ .kind = GVI_CONSTRAINT, .points = holds, .rows = ROWS }", 1,
                  (gvi_effect){ .kind = GVI_CONSTRAINT, .points = own_holds, .rows = own.holds });
    if (own.rolls)
        scene_add(s, "rolling", "0 = A(t,q)v + a(t,q)", "{ .kind = GVI_NONHOLONOMIC, .points = rolls, .rows = ROWS }", 1,
                  (gvi_effect){ .kind = GVI_NONHOLONOMIC, .points = own_rolls, .rows = own.rolls });
    s->mass = lagrangian_mass(&own.L);
    s->mass_text = "lagrangian_mass(&L)";
    s->slope = own_slope_of_L;
}

/* A stepper's own copy of L or H.                                                         */
static void own_mount(scene_setup *s, lagrangian *L, hamiltonian *H)
{
    *L = own.L;
    *H = own.H;
    s->row[0].effect = own.momenta ? hamiltonian_effect(H) : lagrangian_effect(L);
    s->mass = own.momenta ? hamiltonian_mass(H) : lagrangian_mass(L);
}

static void own_place(const double *q, unsigned on, double (*x)[3])
{
    own_state(own.time, q, own.p);
    own_forward(own.whole);
    for (int i = 0; i < own.points; ++i)
        scene_point(x[i], own.value[own.at[2*i]], own.value[own.at[2*i+1]], 0);
    (void)on;
}

static const double own_radius[OWN_POINTS] = { 0 };

static scene own_scene = {
    .name = "own", .title = "Your L or H",
    .about = "Change L, H or the start: the motion and what it costs follow.",
    .degree = 8, .h = 0.1, .span = 10, .speed = 1, .time_unit = "", .error_unit = "", .text = "",
    .build = own_build, .view = 1, .place = own_place, .radius = own_radius,
};

/* At the start; a row on velocities has to be linear in them.                              */
static const char *own_refused(const double *q)
{
    double t = 0, A[OWN_ROWS*LAGRANGIAN_MOST], a[OWN_ROWS];
    const char *why = NULL;
    if (own.rolls)
        own_rolls(&(gvi_points){ .n = own.n, .count = 1, .stride = 1, .t = &t, .q = q, .jacobian = A, .rate = a, .why = &why }, NULL);
    return why ? "a constraint with velocities is not linear in them" : NULL;
}

/* Takes over what is in own_typed: NULL, or why lagrangian.h refuses it.                   */
static const char *own_set(int n, int length, int whole, int points, double span)
{
    const double *in = own_typed, *start = in + 4*OWN_MOST, *rows = start + 3*LAGRANGIAN_MOST + 2*OWN_POINTS;
    own_scene.n = own.n = n;
    own.length = length;
    own.whole = whole;
    own_scene.bodies = own.points = points;
    own_scene.span = span;
    for (int k = 0; k < whole; ++k, in += 4) {
        own.step[k].op = (int)in[0];
        own.step[k].a = (int)in[1];
        own.step[k].b = (int)in[2];
        own.step[k].c = in[3];
    }
    for (int i = 0; i < 2*points; ++i) own.at[i] = (int)start[2*LAGRANGIAN_MOST + i];
    for (int i = own.forced = 0; i < n; ++i) {
        own.force[i] = (int)start[2*LAGRANGIAN_MOST + 2*OWN_POINTS + i];
        own.forced |= own.force[i] >= 0;
    }
    own.rolls = (int)rows[1];
    own.holds = (int)rows[0] - own.rolls;
    for (int i = 0; i < own.holds + own.rolls; ++i) own.row[i] = (int)rows[2 + i];
    const int kind = (int)rows[2 + OWN_ROWS];
    own.momenta = kind < 0;
    memset(own.p, 0, sizeof own.p);
    const lagrangian_function typed = { n, own_add };
    if (own.momenta) return hamiltonian_init(&own.H, typed, NULL, 0, start, start + n);
    const char *wrong = lagrangian_init(&own.L, typed, NULL, 0, start, start + n);
    if (!wrong && kind > 0) own.L.kind = (lagrangian_kind)kind;
    return wrong ? wrong : own_refused(start);
}

#endif
