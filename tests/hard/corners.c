/* corners.c - units, tops and oscillators of all sizes

   Units: a planet whose lengths are measured in units of 1e-30 to 1e30 moves alike to the
   bit, where the factors are powers of two.  Oscillators: 32 of them, masses over 12 decades,
   every constant different, each against its cosine.  Top: a heavy symmetric top by its
   three Euler angles; upright ("sleeping") it is stable if it spins faster than
   2 sqrt(m g l I1)/I3, and there Euler angles are singular: the start is 0.05 beside it. */
#include "corners.h"

/* -------------------------------------------------------------------- units */

static double end_in_units(int length, int time, gvi_formulation formulation, double *q)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    units a = { ldexp(1, length), ldexp(1, time) };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction_in_units, .user = &a } };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1, .formulation = formulation };
    const double q0[2] = { 0.4*a.length, 0 }, v0[2] = { 0, 2*a.length/a.time };
    gvi_stepper st;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q0, v0));
    for (int k = 0; k < 2000; ++k) must(gvi_step(&st, 0.0625*a.time));
    for (int i = 0; i < 2; ++i) q[i] = st.q[i]/a.length;
    return st.t/a.time;
}

static void any_unit(void)
{
    static const gvi_formulation pins[] = { GVI_AUTO, GVI_POSITIONS, GVI_VELOCITIES, GVI_MOMENTA,
                                            GVI_NEWTON };
    int differ = 0, runs = 0;
    double apart = 0;
    for (int f = 0; f < COUNT(pins); ++f) {
        double one[2], q[2];
        end_in_units(0, 0, pins[f], one);
        for (int length = -100; length <= 100; length += 50)
            for (int time = -100; time <= 100; time += 50) {
                end_in_units(length, time, pins[f], q);
                differ += memcmp(one, q, sizeof q) != 0;
                apart = fmax(apart, hypot(q[0] - one[0], q[1] - one[1]));
                ++runs;
            }
    }
    printf("  %d runs, 2^-100 to 2^100 (1e-30 to 1e30) in length and in time\n", runs);
    expect("runs that differ in a bit", 0, differ, 0);
    expect("largest distance", 0, apart, 0);
}

/* -------------------------------------------------------------- oscillators */

enum { MANY = 32 };
/* Frequencies from 0.5 to 2, to t = 100 in 800 steps of degree 8: an error of 800 roundings */
static void oscillators(gvi_formulation formulation)
{
    static double memory[GVI_LENGTH(MANY, 8, 8)];
    static double stiff[MANY], m[MANY], q[MANY], v[MANY];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = stiff } };
    const gvi_desc desc = { .n = MANY, .effects = scene, .effect_count = 1, .formulation = formulation,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    gvi_stepper st;
    double worst = 0;
    for (int i = 0; i < MANY; ++i) {
        m[i] = pow(10, 12.0*((7*i) % MANY)/(MANY - 1) - 6);
        stiff[i] = m[i]*pow(4, 2*i/(MANY - 1.0) - 1);
        q[i] = pow(10, (i*5) % 13 - 6);
        v[i] = 0;
    }
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q, v));
    for (int k = 0; k < 800; ++k) must(gvi_step(&st, 0.125));
    for (int i = 0; i < MANY; ++i) {
        const long double exact = sqrtl((long double)stiff[i]/m[i]);
        worst = fmax(worst, (double)fabsl(st.q[i]/q[i] - cosl(exact*100)));
    }
    expect(formulation == GVI_NEWTON ? "32 oscillators by Newton" : "32 oscillators, masses over 12 decades",
           0, worst,
           sqrt(800)*8*DBL_EPSILON);
}

/* ---------------------------------------------------------------------- top */

typedef struct top { double lowest, energy, p_phi, p_psi; gvi_status status; } top;

/* Started at an angle beside the vertical, with the momenta of an upright top of that spin */
static top spin(double speed, double angle, double t)
{
    static double memory[GVI_LENGTH(3, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = top_weight, .value = top_weight } };
    const gvi_desc desc = { .n = 3, .effects = scene, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_POSITION, .points = top_mass,
                                      .gradient = top_gradient } };
    const double q[3] = { angle, 0, 0 }, p[3] = { 0, I3*speed, I3*speed };
    top z = { 0, 0, 0, 0, GVI_OK };
    gvi_stepper st;
    double E0 = 0, E = 0;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start_momentum(&st, 0, q, p));
    z.status = gvi_energy(&st, &E0);
    while (st.t < t && z.status == GVI_OK) {
        z.status = gvi_step(&st, 1.0/128);
        if (z.status != GVI_OK) break;
        must(gvi_energy(&st, &E));
        z.lowest = fmax(z.lowest, fabs(st.q[0]));
        z.energy = fmax(z.energy, fabs(E/E0 - 1));
    }
    z.p_phi = fabs(st.p[1] - p[1]);
    z.p_psi = fabs(st.p[2] - p[2]);
    return z;
}

static void sleeping_top(void)
{
    const double critical = 2/I3;                            // 2 sqrt(m g l I1)/I3
    const top fast = spin(1.25*critical, 0.05, 100), slow = spin(0.8*critical, 0.05, 100);
    printf("  beside the vertical by 0.05: fast %s, at most %.3f; slow %s, to %.3f\n",
           gvi_status_text(fast.status),
           fast.lowest, gvi_status_text(slow.status), slow.lowest);
    expect("fast: stays upright, largest angle", 0.04, fast.lowest, 0.1);
    expect("slow: falls, largest angle", 0.5, slow.lowest, 3.2);
    expect("energy error", 0, fmax(fast.energy, slow.energy), 1e-9);
    expect("momenta of the two symmetries", 0, fmax(fmax(fast.p_phi, fast.p_psi), fmax(slow.p_phi,
                                                                                       slow.p_psi)), 0);
    const top upright = spin(1.25*critical, 0, 1);
    printf("  at the vertical itself M is singular: %s\n", gvi_status_text(upright.status));
    expect("status there", GVI_E_SINGULAR, upright.status, GVI_E_SINGULAR);
}

int main(void)
{
    printf("Units\n");
    any_unit();
    printf("Oscillators\n");
    oscillators(GVI_AUTO);
    oscillators(GVI_NEWTON);
    printf("Sleeping top\n");
    sleeping_top();
    return verdict("corners");
}
