/* 17 - Weak effects, asked in some iterations only

   A satellite 710 km above the Earth, for a day.  Gravity and J2 hold the orbit and cost
   little; the rest of the field is a few thousandths of J2 and costs most of the time, the
   more the higher its degree.  Marked as weak, it stands still while the iteration of a
   step closes in, and is asked again only as often as the step needs it.

   prints

     not marked   iterations a step 6   the field asked 6 times
     weak         iterations a step 6   the field asked 2 times
     apart by less than 0.01 mm; without the field by 0.9 km
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

/* km, s; J2 to J6 of EGM96 (Lemoine et al., NASA/TP-1998-206861), J0 = -1       */
static const double GM = 398600.4418, R = 6378.137;
static const double J[] = { -1, 0, 1.0826267e-3, -2.5327e-6, -1.6196e-6, -2.2730e-7, 5.4068e-7 };

/* V = sum_n J_n GM/R (R/r)^(n+1) P_n(z/r), n from first to last: -dV/dq is added, by
   recurrences of P_n and P_n', with grad r^-(n+1) P_n = r^-(n+2) (P_n' e_z - P_(n+1)' x/r).  */
static void zonal(const gvi_points *x, int first, int last)
{
    const double *X = x->q, *Y = X + x->stride, *Z = Y + x->stride;
    double *fx = x->f, *fy = fx + x->stride, *fz = fy + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double u = 1/sqrt(X[k]*X[k] + Y[k]*Y[k] + Z[k]*Z[k]), t = Z[k]*u;
        double before = 0, P = 1, d_before = 0, d = 0, power = GM*u*u, radial = 0, axial = 0;
        for (int n = 0; n <= last; ++n, power *= R*u) {
            const double next = ((2*n + 1)*t*P - n*before)/(n + 1), d_next = d_before + (2*n + 1)*P;
            const double w = n < first ? 0 : J[n]*power;
            radial += w*d_next;
            axial -= w*d;
            before = P;  P = next;
            d_before = d;  d = d_next;
        }
        fx[k] += radial*u*X[k];
        fy[k] += radial*u*Y[k];
        fz[k] += radial*u*Z[k] + axial;
    }
}

static int leading(const gvi_points *x, void *user) { return zonal(x, 0, 2), (void)user, 0; }
static int field(const gvi_points *x, void *user) { return zonal(x, 3, 6), (void)user, 0; }

/* A day with `count` effects, the second of them marked or not                  */
static void day(int count, int weak, double *q)
{
    static double memory[GVI_LENGTH(3, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = leading },
                                 { .kind = GVI_POTENTIAL, .points = field, .weak = weak } };
    const gvi_desc desc = { .n = 3, .effects = scene, .effect_count = count };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ R + 710, 0, 0 }, (double[]){ 0, 4.7, 5.9 });
    for (int k = 0; k < 144 && st.status == GVI_OK; ++k) gvi_step(&st, 600);
    for (int i = 0; i < 3; ++i) q[i] = st.q[i];
    if (st.status != GVI_OK) puts(gvi_status_text(st.status));
    if (count > 1)
        printf("%-10s   iterations a step %.0f   the field asked %.0f times\n", weak ? "weak" : "not marked",
               (double)st.counters.iterations/144, (double)st.counters.effect[1]/(144*st.r));
}

static double distance(const double *a, const double *b)
{
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

int main(void)
{
    double plain[3], marked[3], none[3];
    day(2, 0, plain);
    day(2, 1, marked);
    day(1, 0, none);
    printf("apart by less than %g mm; without the field by %.1f km\n",
           distance(plain, marked) < 1e-8 ? 0.01 : 1e6*distance(plain, marked), distance(plain, none));
    return 0;
}
