/* corners.c - tops and oscillators of all sizes, in double and in float

   Oscillators: masses over 12 decades, every constant different, each against its cosine.  Top: a heavy symmetric
   top by its three Euler angles; upright ("sleeping") it is stable if it spins faster than 2 sqrt(m g l I1)/I3, and
   there Euler angles are singular: the start is 0.05 beside it.

   Functions of the type of their argument: <tgmath.h>.                                         */
#include "hard.h"

#include <tgmath.h>
#undef I                                          // of <complex.h>, which it includes

static const int single = sizeof(real) < sizeof(double);
enum { MANY = 32 };
static real arena[GVI_LENGTH(MANY, 8, 8)];

/* -------------------------------------------------------------- oscillators */

/* Frequencies from 0.5 to 2, to t = 100 in 800 steps of degree 8: an error of 800 roundings */
static void oscillators(gvi_formulation formulation)
{
    static real stiff[MANY], m[MANY], q[MANY], v[MANY];
    const int n = single ? 18 : MANY;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = stiff } };
    const gvi_desc desc = { .n = n, .degree = 8, .effects = scene, .effect_count = 1, .formulation = formulation,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    gvi_stepper st;
    double worst = 0;
    for (int i = 0; i < n; ++i) {
        m[i] = (real)pow(10, 12.0*((7*i) % n)/(n - 1) - 6);
        stiff[i] = (real)((double)m[i]*pow(4, 2*i/(n - 1.0) - 1));
        q[i] = (real)pow(10.0, (i*5) % 13 - 6);
    }
    must(gvi_init(&st, &desc, arena, sizeof arena));
    must(gvi_start(&st, 0, q, v));
    for (int k = 0; k < 800; ++k) must(gvi_step(&st, (real)0.125));
    for (int i = 0; i < n; ++i) {
        const long double exact = sqrt((long double)stiff[i]/(long double)m[i]);
        worst = fmax(worst, (double)fabs((long double)st.q[i]/(long double)q[i] - cos(exact*100)));
    }
    expect(formulation == GVI_NEWTON ? "oscillators by Newton: error in EPS sqrt(steps)"
                                     : "oscillators: error in EPS sqrt(steps)", 0, worst/(sqrt(800.0)*(double)EPS), 8);
}

/* ---------------------------------------------------------------------- top */

/* I1 = 1, I3 = 1/2, m g l = 1; q = (theta, phi, psi).  M from
     T = (th'^2 + sin^2 th ph'^2)/2 + I3 (ps' + cos th ph')^2/2
   No velocity is given, so M is factored at the points.                                    */
static const real I3 = (real)0.5;

static int top_mass(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = cos(x->q[k]), s = sin(x->q[k]);
        for (int e = 0; e < 9; ++e) x->mass[e*d + k] = 0;
        x->mass[k] = 1;
        x->mass[4*d + k] = s*s + I3*c*c;
        x->mass[7*d + k] = I3*c;
        x->mass[8*d + k] = I3;
    }
    return 0;
}

static int top_gradient(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = cos(x->q[k]), s = sin(x->q[k]), ph = x->v[d + k], ps = x->v[2*d + k];
        x->f[k] += s*c*ph*ph - I3*(ps + c*ph)*s*ph;
    }
    return 0;
}

static int top_weight(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] += sin(x->q[k]);
    return 0;
}

static long double top_energy(const gvi_stepper *st)
{
    long double q[3], p[3];
    read_state(st, q, p);
    const long double c = cos(q[0]), s = sin(q[0]), along = p[1] - p[2]*c;
    return p[0]*p[0]/2 + along*along/(2*s*s) + p[2]*p[2]/(2*(long double)I3) + c;
}

/* Started at an angle beside the vertical, with the momenta of an upright top of that spin, or with phi' = 0: then
   the vertical is never reached.  In float it must not be, since within sqrt(EPS) of it there is no velocity.
   phi' = (p_phi - p_psi c)/s^2 is wrong by EPS p/s^2, a torque on theta by p s times that: the walk.  */
typedef struct top { double lowest, energy, walk, momenta; gvi_status status; } top;

static top spin(real speed, real angle, int steps)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = top_weight } };
    const gvi_desc desc = { .n = 3, .degree = 8, .effects = scene, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_POSITION, .points = top_mass, .gradient = top_gradient } };
    const real q[3] = { angle }, p[3] = { 0, I3*speed*(single ? cos(angle) : 1), I3*speed }, h = 1/(real)128;
    top z = { .status = GVI_OK };
    gvi_stepper st;
    must(gvi_init(&st, &desc, arena, sizeof arena));
    must(gvi_start_momentum(&st, 0, q, p));
    const long double E0 = top_energy(&st);
    for (int k = 0; k < steps; ++k) {
        z.status = gvi_step(&st, h);
        if (z.status != GVI_OK) break;
        z.lowest = fmax(z.lowest, fabs((double)st.q[0]));
        z.energy = fmax(z.energy, (double)fabs(top_energy(&st)/E0 - 1));
        z.walk += pow((double)(st.p[0]*h*st.p[2]*st.p[2]*EPS)/sin((double)st.q[0]), 2)/12;
    }
    z.walk = sqrt(z.walk)/(double)fabs(E0);
    z.momenta = fabs((double)(st.p[1] - p[1])) + fabs((double)(st.p[2] - p[2]));
    return z;
}

static void sleeping_top(void)
{
    const real critical = 2/I3;                              // 2 sqrt(m g l I1)/I3
    const top fast = spin((real)1.25*critical, (real)0.05, 12800), slow = spin((real)0.8*critical, (real)0.05, 12800);
    must(fast.status);
    must(slow.status);
    expect("fast: stays upright, largest angle", 0.04, fast.lowest, single ? 0.15 : 0.1);
    expect("slow: falls, largest angle", 0.5, slow.lowest, 3.2);
    printf("  energy error %.1e, %.1e\n", fast.energy, slow.energy);
    expect("energy error, in walks of the rounding of phi'", 0, fmax(fast.energy/fast.walk, slow.energy/slow.walk), 4);
    expect("momenta of the two symmetries: change", 0, fast.momenta + slow.momenta, 0);
    expect("at the vertical itself M is singular: status", GVI_E_SINGULAR,
           spin((real)1.25*critical, 0, 1).status, GVI_E_SINGULAR);
}

int main(void)
{
    printf("Oscillators\n");
    oscillators(GVI_AUTO);
    oscillators(GVI_NEWTON);
    printf("Sleeping top\n");
    sleeping_top();
    return verdict("corners");
}
