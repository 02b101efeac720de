/* 18 - Close encounters: a clock that slows down where it matters

   A comet on an ellipse of eccentricity 0.99 is 200 times faster at the perihelion than
   far out.  With a fixed step the perihelion is stepped over: the comet is thrown out,
   and every single step "converged".  It shows all the same: a fixed point contracts
   slowly, and with desc.resolution the step is refused.  A clock g = |q| makes time run as
   dt = g dtau, h being a step in tau: 80 of them a revolution are enough.  gvi_state_at
   gives the state at a wanted time, here after 100 periods of 2 pi.

   Or let the steps follow an accuracy (02_comet.c).  That needs no clock, but steps that change are not
   symplectic: the error of the energy grows, slowly.  The picture has all three at e = 0.8, where a fixed step
   can follow, with 1,500 evaluations a revolution at most: 63 steps, 20 by the clock, a dial of 1e-10.

   18_close_encounters [--svg file]
   prints

     fixed step, 400 a revolution: thrown out, worst contraction above 1/4: yes
     the same with a limit of 1e-3: refused
     clock, 80 a revolution: energy kept to 1e-13: yes, position after 100 to 1e-10: yes
     dial, 1e-14: energy kept to 1e-12: yes, position after 100 to 1e-10: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"

/* Force and potential in one function: with a clock a step wants both         */
GVI_EACH(attraction, 2, f, value)
{
    double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, d = GVI_SQRT(d2), w = -1/(d2*d);
    x->value[0] -= 1/d;
    x->f[0] += w*X;
    x->f[1] += w*Y;
}

/* g = |q| and its gradient                                                    */
GVI_EACH(distance, 2, f, value)
{
    double d = GVI_SQRT(x->q[0]*x->q[0] + x->q[1]*x->q[1]);
    x->value[0] += d;
    x->f[0] += x->q[0]/d;
    x->f[1] += x->q[1]/d;
}

enum { FIXED, CLOCK, DIAL };
static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                    { .kind = GVI_CLOCK, .points = distance } };
static double memory[GVI_LENGTH(2, 8, 8)];

/* From the aphelion, which a comet of half-axis 1 passes every 2 pi                   */
static void begin(gvi_stepper *st, int how, double e, double dial)
{
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = how == CLOCK ? 2 : 1,
                            .resolution = dial };
    gvi_init(st, &desc, memory, sizeof memory);
    gvi_start(st, 0, (double[]){ 1 + e, 0 }, (double[]){ 0, sqrt((1 - e)/(1 + e)) });
}

/* The largest error of the energy until then, over revolutions, each 1.05 times the last */
enum { REVOLUTIONS = 3000, MOST = 400 };
static int watch(int how, double h, double dial, double *x, double *y)
{
    const double turn = 2*acos(-1), end = REVOLUTIONS*turn;
    double e0 = 0, energy = 0, worst = 0;
    int count = 0;
    gvi_stepper st;
    begin(&st, how, 0.8, how == DIAL ? dial : 0);
    gvi_energy(&st, &e0);
    while (st.t < end && st.status == GVI_OK) {
        if (how == DIAL) gvi_advance(&st, end);
        else gvi_step(&st, h);
        gvi_energy(&st, &energy);
        worst = fmax(worst, fabs(energy/e0 - 1));
        if (st.t < 1.01*turn || count == MOST || (count > 0 && st.t < 1.05*turn*x[count-1])) continue;
        x[count] = st.t/turn;
        y[count++] = worst;
    }
    return count;
}

static int draw(const char *path)
{
    static const char *const names[] = { "one step for all, 63 a revolution", "a clock, 20 a revolution", "the dial, 1e-10" };
    static double x[3][MOST], y[3][MOST];
    const double turn = 2*acos(-1), h[3] = { 0.1, turn/20, 0 };
    svg_line lines[3];
    for (int how = FIXED; how <= DIAL; ++how)
        lines[how] = (svg_line){ names[how], x[how], y[how], watch(how, h[how], 1e-10, x[how], y[how]) };
    const svg_plot plot = { .title = "Largest error of the energy, eccentricity 0.8", .x_label = "revolutions",
                            .y_label = "relative error so far", .log_x = 1, .log_y = 1, .lines = lines, .line_count = 3 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    const double turn = 2*acos(-1), e = 0.99;
    gvi_stepper st;
    double e0 = 0, energy = 0, farthest = 0, q[2];
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;
    begin(&st, FIXED, e, 0);
    for (int k = 0; k < 20*400 && st.status == GVI_OK; ++k) {
        gvi_step(&st, turn/400);
        farthest = fmax(farthest, hypot(st.q[0], st.q[1]));
    }
    printf("fixed step, 400 a revolution: %s, worst contraction above 1/4: %s\n",
           farthest > 10 ? "thrown out" : "bound", st.counters.worst_contraction > 0.25 ? "yes" : "no");

    begin(&st, FIXED, e, 1e-3);
    while (st.t < turn && st.status == GVI_OK) gvi_step(&st, turn/400);
    printf("the same with a limit of 1e-3: %s\n", st.status == GVI_E_RESOLUTION ? "refused" : "not seen");

    begin(&st, CLOCK, e, 0);
    gvi_energy(&st, &e0);
    while (st.t < 100*turn)
        if (gvi_step(&st, turn/80) != GVI_OK) return puts(gvi_why(&st)), 1;
    gvi_energy(&st, &energy);
    gvi_state_at(&st, 100*turn, q, NULL, NULL);
    printf("clock, 80 a revolution: energy kept to 1e-13: %s, position after 100 to 1e-10: %s\n",
           fabs(energy/e0 - 1) < 1e-13 ? "yes" : "no", hypot(q[0] - (1 + e), q[1]) < 1e-10 ? "yes" : "no");

    begin(&st, DIAL, e, 1e-14);
    while (st.t < 100*turn)
        if (gvi_advance(&st, 100*turn) != GVI_OK) return puts(gvi_status_text(st.status)), 1;
    gvi_energy(&st, &energy);
    printf("dial, 1e-14: energy kept to 1e-12: %s, position after 100 to 1e-10: %s\n",
           fabs(energy/e0 - 1) < 1e-12 ? "yes" : "no", hypot(st.q[0] - (1 + e), st.q[1]) < 1e-10 ? "yes" : "no");
    return 0;
}
