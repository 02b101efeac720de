/* 40 - A Lagrangian as it stands: the double pendulum of lesson 09, and friction in its joints

   Lesson 09 derives M(q) and its gradient by hand. Here L is typed as on paper, with numbers in place of
   doubles, and its derivatives are exact to rounding. lagrangian_init finds out what L is, here v'M(q)v/2 - V(q),
   so that steps are as in lesson 09. Friction has no Lagrangian: it is a row of its own, which is
   switched off for the first half of the run.

   Does it come out right? Without friction the motion agrees with 25 digits, and the energy stays; with
   friction the energy falls, by what the joints take.

   40_lagrangian [--svg file]
   prints

     L is v'M(t,q)v/2 - V(t,q); momenta: r = s, velocity from momentum at each point
     t = 100: a = 0.631257632, b = 0.436538384
     against 25 digits, below 1e-11: yes
     energy kept to 1e-13: yes
     with friction, t = 200: energy from -22.2785 to -28.3190, at rest -29.43
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include "tools/svg.h"

static const double g = 9.81;

LAGRANGIAN(pendulum, 2)
{
    const number a = q[0], b = q[1], u = v[0], w = v[1];
    return u*u + w*w/2 + u*w*cos(a - b) + 2*g*cos(a) + g*cos(b);
}

GVI_EACH(joints, 2, v, f)                          // each in proportion to the speed at which it turns
{
    const double k = 0.1, upper = k*x->v[0], lower = k*(x->v[1] - x->v[0]);
    x->f[0] += lower - upper;
    x->f[1] -= lower;
}

enum { HALF = 1600 };
static double t[2*HALF], energy[2*HALF];

static int draw(const char *path)
{
    const svg_line line = { "energy", t, energy, 2*HALF };
    const svg_plot plot = { .title = "A double pendulum, with friction from t = 100 on", .x_label = "t, in s",
                            .y_label = "energy, in J", .lines = &line, .line_count = 1 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    const double a = 0.63125763155384497, b = 0.43653838426081101;  // at t = 100
    const double q[] = { 0.8, 0.5 }, v[] = { 0, 0 };
    static double memory[GVI_LENGTH(2, 8, 8)];
    static lagrangian L;
    const char *wrong = lagrangian_init(&L, pendulum, NULL, 0, q, v);
    if (wrong) return puts(wrong), 1;
    const gvi_effect scene[] = { lagrangian_effect(&L), { .kind = GVI_FORCE, .points = joints } };
    const gvi_desc desc = { .n = 2, .degree = 8, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 2 };
    double start = 0, off = 0, worst = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    gvi_switch(&st, 1, 0);
    gvi_energy(&st, &start);
    for (int k = 0; k < 2*HALF && st.status == GVI_OK; ++k) {
        if (k == HALF) {
            off = fmax(fabs(st.q[0] - a), fabs(st.q[1] - b));
            printf("L is %s; %s\n", lagrangian_text(&L), gvi_formulation_text(&st));
            printf("t = %g: a = %.9f, b = %.9f\n", st.t, st.q[0], st.q[1]);
            gvi_switch(&st, 1, 1);
        }
        gvi_step(&st, 1.0/16);
        gvi_energy(&st, energy + k);
        t[k] = st.t;
        if (k < HALF) worst = fmax(worst, fabs(energy[k]/start - 1));
    }
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;

    printf("against 25 digits, below 1e-11: %s\n", off < 1e-11 ? "yes" : "no");
    printf("energy kept to 1e-13: %s\n", worst < 1e-13 ? "yes" : "no");
    printf("with friction, t = %g: energy from %.4f to %.4f, at rest %.2f\n", st.t, start, energy[2*HALF - 1], -3*g);
    return 0;
}
