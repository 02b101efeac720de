/* measure.c - steps that smooth modes would not tell to be wrong (docs/hard-cases.md)

   Forces that jump, bend or begin at a time or a place, slow motion on stiff forces, passages near a body inside one
   step: at random, degrees 3 to 16, lengths over eight octaves.  Each step is compared with the motion itself, in closed
   form or by extrapolation in long double.  Where its points show that something is there, the error is to be within a
   hundred times st.resolution.  They show it if the two highest modes of the velocity, as the forces at the points give
   them, are at least a hundredth of the error: where they are not, no measure by modes can tell.  No theory says how many
   of the others are missed: one in ten is the bound, and none of the jumps.                             */
#include "hard.h"
#include "../gauss.h"

typedef long double L;
typedef L real_;
#define real real_
#include "extrapolate.h"
#undef real

enum { STIFF, JUMP, CONTACT, TIMES, PASSAGE, KINDS, MOST = 16 };
static const char *const names[] = { "stiff, slow motion", "jumps", "contacts", "forces that begin", "passages" };

/* STIFF: q'' = w^2 (cos t - q).   JUMP: q'' = -1, below q = 0 +1.   CONTACT: q'' = -1 - w q below q = 0.
   TIMES: q'' = 1 + w t^power from t = 0 on.   PASSAGE: q'' = -w q/|q|^3 - pull q.                      */
typedef struct scene { int kind, n, power, after; L w, pull; double f[2*MOST]; } scene;

static void force(const scene *z, int after, L t, const L *q, L *f)
{
    f[0] = 1;
    switch (z->kind) {
    case STIFF:   f[0] = z->w*z->w*(cosl(t) - q[0]); break;
    case JUMP:    f[0] = after ? 1 : -1; break;
    case CONTACT: f[0] = -1 - (after ? z->w*q[0] : 0); break;
    case TIMES:   f[0] += after ? z->w*powl(t, z->power) : 0; break;
    default: {
        const L d2 = q[0]*q[0] + q[1]*q[1], w = -z->w/(d2*sqrtl(d2)) - z->pull;
        f[0] = w*q[0];
        f[1] = w*q[1];
    } }
}

static int after(const scene *z, L t, const L *q)
{
    return z->kind == TIMES ? t > 0 : (z->kind == JUMP || z->kind == CONTACT) && q[0] < 0;
}

static int forces(const gvi_points *x, void *user)
{
    scene *z = user;
    for (int k = 0; k < x->count; ++k) {
        L q[2], f[2];
        for (int i = 0; i < x->n; ++i) q[i] = x->q[i*x->stride + k];
        force(z, after(z, x->t[k], q), x->t[k], q, f);
        for (int i = 0; i < x->n; ++i) x->f[i*x->stride + k] += z->f[i*MOST + k] = (double)f[i];
    }
    return 0;
}

/* ------------------------------------------------------------- the motion itself */

static void rates(L t, const L *y, L *dy, void *user)
{
    const scene *z = user;
    force(z, z->after, t, y, dy + z->n);
    for (int i = 0; i < z->n; ++i) dy[i] = y[z->n + i];
}

static void advance(const motion *a, L t, L H, L *y)
{
    L d[4];
    extrapolate(a, t, H, y, d);
    for (int i = 0; i < a->n; ++i) y[i] += d[i];
}

/* From t over h; each side of a jump as if there was no other, up to where it is */
static void move(scene *z, L t, L h, L *y)
{
    const motion a = { 2*z->n, rates, z };
    const L end = t + h;
    z->after = z->kind == TIMES ? t >= 0 : y[0] < 0;
    while (t < end) {
        L H = fminl(end - t, h/64), to[4];
        if (z->kind == PASSAGE) {
            const L d = hypotl(y[0], y[1]);
            H = fminl(H, d/8/(hypotl(y[2], y[3]) + sqrtl(z->w/d)));
        }
        if (z->kind == CONTACT) H = fminl(H, 1/(4*sqrtl(z->w)));
        memcpy(to, y, sizeof to);
        advance(&a, t, H, to);
        if (after(z, t + H, to) == z->after || z->kind == PASSAGE) {
            memcpy(y, to, sizeof to);
            t += H;
            continue;
        }
        L before = 0;
        for (int k = 0; k < 70; ++k) {
            const L half = (before + H)/2;
            memcpy(to, y, sizeof to);
            advance(&a, t, half, to);
            if (after(z, t + half, to) == z->after) before = half; else H = half;
        }
        advance(&a, t, H, y);
        t += H;
        z->after = !z->after;
    }
}

static void exact(scene *z, L t, L h, L *y)
{
    if (z->kind != STIFF) { move(z, t, h, y); return; }
    const L w = z->w, A = w*w/(w*w - 1), Q = y[0] - A*cosl(t), V = y[1] + A*sinl(t);
    y[0] = A*cosl(t + h) + Q*cosl(w*h) + V/w*sinl(w*h);
    y[1] = -A*sinl(t + h) - Q*w*sinl(w*h) + V*cosl(w*h);
}

/* ------------------------------------------------------------- a step */

static struct { long steps, shown, hidden, bad; double worst; } found[MOST + 1][KINDS];

/* The two highest modes of the velocity, from the forces */
static double high_modes(const scene *z, int s, double h)
{
    L c[MOST], b[MOST], P[LEGENDRE_MOST + 1];
    double most = 0;
    gauss_nodes(s, c, b);
    for (int i = 0; i < z->n; ++i) {
        L high = 0, low = 0;
        for (int j = 0; j < s; ++j) {
            legendre(s, 1 - 2*c[j], P);
            high += b[j]*P[s - 1]*z->f[i*MOST + j];
            low += b[j]*P[s - 2]*z->f[i*MOST + j];
        }
        most = fmax(most, (double)(fabsl(high) + fabsl(low))*h/2);
    }
    return most;
}

static void look(scene *z, int degree, double t, const double *q, const double *v, double h)
{
    static real memory[GVI_LENGTH(2, MOST, MOST)];
    const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = forces, .user = z } };
    const gvi_desc desc = { .n = z->n, .degree = degree, .effects = effects, .effect_count = 1, .resolution = 0.999 };
    gvi_stepper st;
    L y[4];
    double error = 0, fastest = 0;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, t, q, v));
    if (gvi_step(&st, h) != GVI_OK) return;
    for (int i = 0; i < z->n; ++i) { y[i] = q[i]; y[z->n + i] = v[i]; }
    exact(z, t, (L)st.t + st.t_low - t, y);
    for (int i = 0; i < z->n; ++i) fastest = fmax(fastest, fmax(fabs(v[i]), fabs((double)y[z->n + i])));
    for (int i = 0; i < z->n; ++i)
        error = fmax(error, fmax(fabs((double)(st.q[i] - y[i]))/h, fabs((double)(st.p[i] - y[z->n + i])))/fastest);
    found[degree][z->kind].steps += 1;
    if (error < 1e-11) return;
    if (high_modes(z, degree, h)/fastest < error/100) { found[degree][z->kind].hidden += 1; return; }
    found[degree][z->kind].shown += 1;
    found[degree][z->kind].bad += error > 100*st.resolution;
    found[degree][z->kind].worst = fmax(found[degree][z->kind].worst, error/st.resolution);
}

static double between(double lo, double hi) { return lo + (hi - lo)*(uniform() + 1)/2; }
static double decades(double lo, double hi) { return exp(between(log(lo), log(hi))); }

int main(void)
{
    static const int degrees[] = { 3, 4, 5, 6, 8, 10, 12, 16 };
    for (int kind = 0; kind < KINDS; ++kind)
        for (int run = 0; run < 40; ++run) {
            progress(names[kind], run, 40);
            scene z = { .kind = kind, .n = kind == PASSAGE ? 2 : 1, .w = decades(1, 400), .power = run % 3 };
            double t = -decades(0.01, 0.7), H = 1, q[2] = { between(0.02, 0.5) }, v[2] = { -between(0.1, 2) };
            if (kind == STIFF) {
                const double w = decades(10, 1e4), fast = run % 5 ? decades(1e-10, 1e-3) : 0, phase = between(0, 6);
                z.w = w;
                t = between(0, 6);
                q[0] = w*w/(w*w - 1)*cos(t) + fast*cos(phase);
                v[0] = -w*w/(w*w - 1)*sin(t) - fast*w*sin(phase);
            }
            if (kind == PASSAGE) {
                const double speed = decades(0.3, 5), angle = between(0, 6.28), near = decades(1e-3, 0.3), part = between(0.05, 0.95);
                H = decades(0.05, 2);
                z.w = decades(1e-6, 1);
                z.pull = run % 3 ? decades(0.01, 4) : 0;
                q[0] = -part*H*speed*cos(angle) - near*sin(angle);
                q[1] = -part*H*speed*sin(angle) + near*cos(angle);
                v[0] = speed*cos(angle);
                v[1] = speed*sin(angle);
            }
            for (int d = 0; d < COUNT(degrees); ++d)
                for (double h = H/128; h < 3*H; h *= 1.19) look(&z, degrees[d], t, q, v, h);
        }
    for (int d = 0; d < COUNT(degrees); ++d) {
        long shown = 0, bad = 0;
        printf("degree %2d:%26s %9s %9s %9s %12s\n", degrees[d], "steps", "wrong", "hidden", "above 100", "worst");
        for (int kind = 0; kind < KINDS; ++kind) {
            printf("  %-20s %12ld %9ld %9ld %9ld %12.3g\n", names[kind], found[degrees[d]][kind].steps,
                   found[degrees[d]][kind].shown + found[degrees[d]][kind].hidden, found[degrees[d]][kind].hidden,
                   found[degrees[d]][kind].bad, found[degrees[d]][kind].worst);
            shown += found[degrees[d]][kind].shown;
            bad += found[degrees[d]][kind].bad;
        }
        expect("jumps above 100 times the resolution", 0, (double)found[degrees[d]][JUMP].bad, 0);
        expect("wrong steps that the points show", 100, (double)shown, 1e6);
        expect("of these above 100 times the resolution, their share", 0, (double)bad/(double)shown, 0.1);
    }
    return verdict("measure");
}
