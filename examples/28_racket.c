/* 28 - Why does a racket turn over when it is thrown? Rigid bodies

   Throw a tennis racket so that it turns about the axis that lies in its face, across the handle. When you
   catch it, the other side faces you. That axis has the middle one of the three moments of inertia, and
   a spin about it is unstable: it stays for a while, flips quickly, stays again. About the other two axes
   the racket just spins.

   tools/body.h describes a body by its place and a quaternion of any length, with a mass matrix that needs
   no constraint and has no singular angle. A body is then its moments of inertia. The weight does not turn
   it, so only the rotation about the centre of mass is computed. By Euler's equations in elliptic
   functions the time between two flips is, with A < B < C, energy E and angular momentum M,

     2 K(k) sqrt(A B C/((C - B)(M^2 - 2EA))),   k^2 = (B - A)(2EC - M^2)/((C - B)(M^2 - 2EA))

   and K(k) = pi/(2 agm(1, sqrt(1 - k^2))). A flip is where the spin about B passes 0: tools/event.h.

   28_racket [--svg file]
   prints

     spin about the handle: 0 flips in 10 s
     spin across the handle: 7 flips in 10 s
     between two flips 1.438 s, by elliptic functions 1.438 s
     spin across the face: 0 flips in 10 s
     angular momentum in space kept to 1e-15: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include "tools/body.h"
#include "tools/event.h"
#include <string.h>

enum { OUTLINE = 35, FRAMES = 40 };

/* Axes: the handle, across it in the face, across the face; in kg m^2.             */
static const body racket = { .inertia = { 0.0014, 0.0164, 0.0178 } };
static const double rate = 10, pi = 3.141592653589793;
static double memory[GVI_LENGTH(4, 8, 8)];

/* The handle along x, the face up; 10 rad/s about one axis, and a little about the last.    */
static void throw_it(gvi_stepper *st, int axis, double *w)
{
    static const bodies thrown = { &racket, 1 };
    const gvi_desc desc = { .n = 4, .mass = body_mass(&thrown) };
    const double e[4] = { 1, 0, 0, 0 };
    double v[4];
    w[0] = w[1] = 0;
    w[2] = 0.005*rate;
    w[axis] = rate;
    gvi_init(st, &desc, memory, sizeof memory);
    body_turn(e, w, v);
    gvi_start(st, 0, e, v);
}

static double spin_about(double t, const double *e, const double *v, void *user)
{
    double w[3];
    body_spin(e, v, w);
    return (void)t, w[*(const int *)user];
}

static double between_flips(const double *w)
{
    const double A = racket.inertia[0], B = racket.inertia[1], C = racket.inertia[2];
    const double EE = A*w[0]*w[0] + B*w[1]*w[1] + C*w[2]*w[2];
    const double MM = A*A*w[0]*w[0] + B*B*w[1]*w[1] + C*C*w[2]*w[2], s = (C - B)*(MM - EE*A);
    double a = 1, b = sqrt(1 - (B - A)*(EE*C - MM)/s);
    for (int k = 0; k < 8; ++k) {
        const double mean = (a + b)/2;
        b = sqrt(a*b);
        a = mean;
    }
    return pi/a*sqrt(A*B*C/s);
}

/* A turn about the axis is a line of eight pictures: those with the front to us, and those with the back.  */
static int draw(const char *path)
{
    static double x[2][FRAMES*OUTLINE], y[2][FRAMES*OUTLINE];
    const svg_line lines[] = { { "front", x[0], y[0], FRAMES*OUTLINE }, { "back", x[1], y[1], FRAMES*OUTLINE } };
    const svg_plot plot = { .title = "A racket thrown so that it turns across its handle",
                            .x_label = "eighths of a turn", .y_label = "turns", .lines = lines, .line_count = 2 };
    double w[3];
    gvi_stepper st;
    throw_it(&st, 1, w);
    for (int frame = 0; frame < FRAMES; ++frame) {
        double normal[3];
        body_rotate(st.q, 0, (double[]){ 0, 0, 1 }, normal);
        for (int k = 0; k < OUTLINE; ++k) {                          // the end of the handle, the head, a gap
            const double angle = pi/16*(k - 1) - pi;
            const double at[3] = { k ? 0.17 + 0.17*cos(angle) : -0.34, k ? 0.13*sin(angle) : 0, 0 };
            double z[3];
            body_rotate(st.q, 0, at, z);
            for (int side = 0; side < 2; ++side) {
                const int shown = (normal[2] < 0) == side && k < OUTLINE - 1, i = frame*OUTLINE + k;
                x[side][i] = shown ? frame % 8 + z[1] : HUGE_VAL;    // seen from above, the handle upwards
                y[side][i] = (double)(frame/8) + z[0];
            }
        }
        if (gvi_step(&st, pi/4/rate)) return -1;
    }
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    static const char *const names[] = { "about the handle", "across the handle", "across the face" };
    double first = 0, last = 0, kept = 0, w[3], v[4], q[4], p[4], own[3], M[2][3];
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
        event e = { .g = spin_about, .user = &axis, .q = q, .v = v, .p = p };
        int flips = 0;
        gvi_stepper st;
        throw_it(&st, axis, w);
        for (int k = 0; k <= 200; ++k) {
            body_momentum(st.q, st.p, own);
            body_rotate(st.q, 0, own, M[k > 0]);
            for (int i = 0; i < 3 && k; ++i) kept = fmax(kept, fabs(M[1][i] - M[0][i]));
            if (gvi_step(&st, 0.05)) return puts(gvi_why(&st)), 1;
            for (; event_next(&e, &st) > 0; ++flips) {
                if (!flips) first = e.t;
                last = e.t;
            }
        }
        printf("spin %s: %d flips in 10 s\n", names[axis], flips);
        if (axis == 1) printf("between two flips %.3f s, by elliptic functions %.3f s\n", (last - first)/(flips - 1), between_flips(w));
    }
    printf("angular momentum in space kept to 1e-15: %s\n", kept < 1e-15 ? "yes" : "no");
    return 0;
}
