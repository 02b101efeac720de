/* 18 - Stiff springs: their oscillation is the free motion

   A plucked steel string by its first 24 modes, for a tenth of a second.  Each mode is a spring, the
   highest 24 times as fast as the lowest; pulled out, the string is longer, its tension is
   greater, and so all modes are coupled (Kirchhoff and Carrier):

     q_m'' = -w_m^2 (1 + a S) q_m       w_m = 2 pi f m       S = sum_j (j pi)^2 q_j^2/2

   Nearly all of that force is -w_m^2 q_m.  Told so, each mode moves on an arc, and polynomials have
   only the rest to follow.  Against steps of a quarter of the length,

   prints

     not told   does not contract: Newton's method, of matrices; wrong by 2e-06 mm
     told       9 rounds a step, no matrices; wrong by 3e-09 mm
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

/* Length 1 m, diameter 1 mm, tension 700 N: a = E A/(2 T); 110 Hz                */
enum { MODES = 24 };
static const double pi = 3.14159265358979323846, a = 200e9*7.854e-7/(2*700), f = 110;
static double stiffness[MODES];

static int string(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        double S = 0;
        for (int m = 0; m < MODES; ++m) S += pow((m + 1)*pi*x->q[m*x->stride + k], 2)/2;
        for (int m = 0; m < MODES && x->f; ++m)
            x->f[m*x->stride + k] -= stiffness[m]*(1 + a*S)*x->q[m*x->stride + k];
        if (x->value) x->value[k] += 4*f*f*(S + a*S*S/2);
    }
    return (void)user, 0;
}

enum { STEPS = 276 };

static void play(const double *told, int parts, double *q)
{
    static double memory[GVI_LENGTH(MODES, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = string, .value = string } };
    const gvi_desc desc = { .n = MODES, .effects = scene, .effect_count = 1, .stiffness = told };
    const double h = 16/44100.0;                  // sixteen samples; gvi_curve has those in between
    double rest[MODES] = { 0 };
    gvi_stepper st;

    // 5 mm at a fifth of the length
    for (int m = 0; m < MODES; ++m) q[m] = 0.01*sin((m + 1)*pi/5)/(0.2*0.8*pow((m + 1)*pi, 2));
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, rest);
    for (int k = 0; k < STEPS*parts && st.status == GVI_OK; ++k) gvi_step(&st, h/parts);
    for (int m = 0; m < MODES; ++m) q[m] = st.q[m];
    if (st.status != GVI_OK) puts(gvi_status_text(st.status));
    if (parts > 1) return;
    if (told) printf("told       %d rounds a step, no matrices", (int)(st.counters.iterations/STEPS));
    else if (st.formulation == GVI_NEWTON) printf("not told   does not contract: Newton's method, of matrices");
}

static void compare(const double *q, const double *fine)
{
    double worst = 0;
    for (int m = 0; m < MODES; ++m) worst = fmax(worst, 1e3*fabs(q[m] - fine[m]));
    printf("; wrong by %.0e mm\n", worst);
}

int main(void)
{
    double fine[MODES], q[MODES];
    for (int m = 0; m < MODES; ++m) stiffness[m] = pow(2*pi*f*(m + 1), 2);
    play(stiffness, 4, fine);
    play(NULL, 1, q);
    compare(q, fine);
    play(stiffness, 1, q);
    compare(q, fine);
    return 0;
}
