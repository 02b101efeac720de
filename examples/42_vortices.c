/* 42 - Vortices: a Hamiltonian as it stands

   Two vortices that turn against each other run straight ahead together, as a smoke ring does. Two such pairs on
   one line leapfrog: the front pair widens and slows down, the rear one narrows, passes through it, and so on.

   A vortex of strength c at (x, y) has no kinetic energy: its Lagrangian is linear in the velocity, and its equations
   are of first order. lagrangian_init refuses it. It has canonical coordinates, q = x and p = c y, and the
   Hamiltonian

         H = -1/(4 pi) sum over pairs of c_i c_j log r_ij^2

   so this is a scene of HAMILTONIAN. The integrator is Gauss collocation of Hamilton's equations, symplectic, of
   order 2s. Its start is q and p.

   The pairs start 1/2 apart. Farther apart, 0.7 or 1, the same motion is unstable: half of the step then gives another
   place at t = 100.

   42_vortices [--svg file]
   prints

     L of the same: L is linear in v: its equations are of first order; give H(t,q,p) by HAMILTONIAN
     the pairs change places 48 times in 100
     x of the first at t = 100: 31.49
     the same with half of the step, below 1e-11: yes
     H, sum of c x, sum of c y kept to 1e-13: yes yes yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include "tools/svg.h"

enum { N = 4, STEPS = 2000 };
static const double strength[N] = { 1, -1, 1, -1 };

HAMILTONIAN(vortices, N)
{
    number sum = 0;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < i; ++j) {
            const number x = q[i] - q[j], y = p[i]/strength[i] - p[j]/strength[j];
            sum += strength[i]*strength[j]*log(x*x + y*y);
        }
    return -sum/(16*atan(1.0));
}

/* The same for one vortex at (x, y) of strength 1 and one at rest in the middle. */
LAGRANGIAN(first_order, 2)
{
    return q[1]*v[0] + log(q[0]*q[0] + q[1]*q[1])/(8*atan(1.0));
}

static double x[N][STEPS], y[N][STEPS];

static int draw(const char *path)
{
    svg_line lines[N];
    const svg_plot plot = { .title = "Two pairs of vortices leapfrog", .x_label = "x", .y_label = "y", .equal = 1,
                            .lines = lines, .line_count = N };
    for (int i = 0; i < N; ++i)
        lines[i] = (svg_line){ i < 2 ? i ? "first, below" : "first, above" : i > 2 ? "second, below" : "second, above",
                               x[i], y[i], STEPS/4 };
    return svg_write(path, &plot);
}

/* H, sum of c x, sum of c y; the last two move the vortices along as their momenta do */
static void sums(gvi_stepper *st, double *sum)
{
    gvi_energy(st, sum);
    sum[1] = sum[2] = 0;
    for (int i = 0; i < N; ++i) {
        sum[1] += strength[i]*st->q[i];
        sum[2] += st->p[i];
    }
}

int main(int argc, char **argv)
{
    static double memory[2][GVI_LENGTH(N, 8, 8)];
    static hamiltonian H[2];
    static gvi_effect effect[2];
    static lagrangian L;
    const double q[N] = { 0, 0, 0.5, 0.5 }, p[N] = { 0.5, 0.5, 0.5, 0.5 };       // y = 1/2, -1/2, 1/2, -1/2
    double start[3], now[3], worst[3] = { 0, 0, 0 };
    int passed = 0;
    gvi_stepper st[2];
    for (int k = 0; k < 2; ++k) {
        const char *wrong = hamiltonian_init(H + k, vortices, NULL, 0, q, p);
        if (wrong) return puts(wrong), 1;
        effect[k] = hamiltonian_effect(H + k);
        const gvi_desc desc = { .n = N, .degree = 8, .mass = hamiltonian_mass(H + k), .effects = effect + k, .effect_count = 1,
                                .formulation = GVI_MOMENTA };
        gvi_init(st + k, &desc, memory[k], sizeof memory[k]);
        gvi_start_momentum(st + k, 0, q, p);
        sums(st + k, start);
        for (int i = 0; i < STEPS << k && st[k].status == GVI_OK; ++i) {
            const int behind = st[k].q[0] < st[k].q[2];
            gvi_step(st + k, 0.05/(1 + k));
            sums(st + k, now);
            for (int j = 0; j < 3; ++j) worst[j] = fmax(worst[j], fabs(now[j] - start[j]));
            passed += !k && behind != (st->q[0] < st->q[2]);
            for (int j = 0; j < N && !k; ++j) {
                x[j][i] = st->q[j];
                y[j][i] = st->p[j]/strength[j];
            }
        }
        if (st[k].status != GVI_OK) return puts(gvi_why(st + k)), 1;
    }
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;

    double off = 0;
    for (int i = 0; i < N; ++i) off = fmax(off, fmax(fabs(st[0].q[i] - st[1].q[i]), fabs(st[0].p[i] - st[1].p[i])));
    printf("L of the same: %s\n", lagrangian_init(&L, first_order, NULL, 0, (double[]){ 1, 2 }, (double[]){ 1, 1 }));
    printf("the pairs change places %d times in %g\n", passed, st->t);
    printf("x of the first at t = %g: %.2f\n", st->t, st->q[0]);
    printf("the same with half of the step, below 1e-11: %s\n", off < 1e-11 ? "yes" : "no");
    printf("H, sum of c x, sum of c y kept to 1e-13: %s %s %s\n", worst[0] < 1e-13 ? "yes" : "no", worst[1] < 1e-13 ? "yes" : "no",
           worst[2] < 1e-13 ? "yes" : "no");
    return 0;
}
