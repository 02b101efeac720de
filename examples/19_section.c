/* 19 - Where does the orbit pass a plane? Events, and output at given times

   The star of Henon and Heiles, V = (x^2 + y^2)/2 + x^2 y - y^3/3, at energy 1/8. Its orbits
   fill a surface of three dimensions, which cannot be drawn; so mark (y, y') each time the star passes
   x = 0 to the right. A regular orbit draws a closed curve, or some islands; a chaotic one fills an area
   with dots. The steps do not meet x = 0: tools/event.h finds the passages, at the order of the steps.

   Its output_at gives states at times of your own: steps of h, and the state inside the last one.

   19_section [--svg file]
   prints

     2400 passages, x there 0 to the rounding of t: yes
     energy there and at the start agree to 1e-14: yes
     with steps of 0.4 and of 0.3 the same passages, to 1e-10: yes
     states at t = 10, 20 ... 200, with both steps, agree to 1e-10: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include "tools/event.h"
#include <string.h>

enum { ORBITS = 6, PASSAGES = 400 };

GVI_EACH(potential, 2, f)
{
    const double X = x->q[0], Y = x->q[1];
    x->f[0] -= X + 2*X*Y;
    x->f[1] -= Y + X*X - Y*Y;
}

static double energy(const double *q, const double *p)
{
    const double x = q[0], y = q[1];
    return (p[0]*p[0] + p[1]*p[1] + x*x + y*y)/2 + x*x*y - y*y*y/3;
}

static double plane(double t, const double *q, const double *v, void *user)
{
    return (void)t, (void)v, (void)user, q[0];
}

typedef struct passage { double t, q[2], p[2]; } passage;

/* From (0, y) with y' = py and energy 1/8.                                       */
static void begin(gvi_stepper *st, double *memory, size_t size, double y, double py)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = potential } };
    static const gvi_desc star = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 };
    gvi_init(st, &star, memory, size);
    gvi_start(st, 0, (double[]){ 0, y }, (double[]){ sqrt(0.25 - y*y + 2*y*y*y/3 - py*py), py });
}

/* The first `count` passages to the right.                                       */
static gvi_status section(double y, double py, double h, int count, passage *out)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    double q[2], v[2], p[2];
    event e = { .g = plane, .q = q, .v = v, .p = p };
    gvi_stepper st;
    begin(&st, memory, sizeof memory, y, py);
    for (int k = 0; k < count; ) {
        int found;
        if (gvi_step(&st, h)) return st.status;
        while ((found = event_next(&e, &st)) > 0)
            if (e.rising && k < count) {
                out[k].t = e.t;
                memcpy(out[k].q, q, sizeof q);
                memcpy(out[k++].p, p, sizeof p);
            }
        if (found < 0) return (gvi_status)found;
    }
    return GVI_OK;
}

static int draw(const char *path, passage at[][PASSAGES])
{
    static const char *const names[] = { "-0.15, 0", "0.1, 0", "0.2, 0", "0.55, 0", "-0.3, 0", "0, 0.28" };
    static double x[ORBITS][3*PASSAGES], y[ORBITS][3*PASSAGES];
    svg_line lines[ORBITS];
    for (int i = 0; i < ORBITS; ++i) {
        for (int k = 0; k < 3*PASSAGES; ++k) {                       // a dot is a short line, and a gap
            const passage *z = &at[i][k/3];
            x[i][k] = k % 3 < 2 ? z->q[1] + 0.004*(k % 3) : HUGE_VAL;
            y[i][k] = z->p[1];
        }
        lines[i] = (svg_line){ names[i], x[i], y[i], 3*PASSAGES };
    }
    const svg_plot plot = { .title = "Where six orbits of energy 1/8 pass x = 0, by their first y, y'", .x_label = "y", .y_label = "y'",
                            .equal = 1, .lines = lines, .line_count = ORBITS };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    static const double start[ORBITS][2] = { { -0.15, 0 }, { 0.1, 0 }, { 0.2, 0 }, { 0.55, 0 }, { -0.3, 0 }, { 0, 0.28 } };
    static passage at[ORBITS][PASSAGES], other[100];
    static double memory[2][GVI_LENGTH(2, 8, 8)];
    double aside = 0, gained = 0, apart = 0, off = 0, a[2], b[2];
    gvi_stepper st[2];
    for (int i = 0; i < ORBITS; ++i) {
        const gvi_status status = section(start[i][0], start[i][1], 0.4, PASSAGES, at[i]);
        if (status) return puts(gvi_status_text(status)), 1;
        for (int k = 0; k < PASSAGES; ++k) {
            aside = fmax(aside, fabs(at[i][k].q[0])/at[i][k].t);
            gained = fmax(gained, fabs(energy(at[i][k].q, at[i][k].p) - 0.125));
        }
    }
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2], at) ? perror(argv[2]), 1 : 0;
    printf("%d passages, x there 0 to the rounding of t: %s\n", ORBITS*PASSAGES, aside < 1e-16 ? "yes" : "no");
    printf("energy there and at the start agree to 1e-14: %s\n", gained < 1e-14 ? "yes" : "no");

    if (section(start[1][0], start[1][1], 0.3, 100, other)) return 1;
    for (int k = 0; k < 100; ++k)
        apart = fmax(apart, fmax(fabs(at[1][k].t - other[k].t), fabs(at[1][k].p[1] - other[k].p[1])));
    printf("with steps of 0.4 and of 0.3 the same passages, to 1e-10: %s\n", apart < 1e-10 ? "yes" : "no");

    for (int i = 0; i < 2; ++i) begin(&st[i], memory[i], sizeof memory[i], 0.1, 0);
    for (int k = 1; k <= 20; ++k) {
        if (output_at(&st[0], 0.4, 10*k, a, NULL, NULL)) return puts(gvi_why(&st[0])), 1;
        if (output_at(&st[1], 0.3, 10*k, b, NULL, NULL)) return puts(gvi_why(&st[1])), 1;
        for (int i = 0; i < 2; ++i) off = fmax(off, fabs(a[i] - b[i]));
    }
    printf("states at t = 10, 20 ... 200, with both steps, agree to 1e-10: %s\n", off < 1e-10 ? "yes" : "no");
    return 0;
}
