/* 49 - When does a body leave what it slides on? A bead on a sphere, a cam and its follower

   A bead slides down a smooth sphere. As long as it presses it is held by a constraint; where the force of constraint,
   lambda, changes its sign, it leaves. For a sphere of radius 1 that is where cos = 2/3 of the energy, not at the
   equator. Then it falls on the floor, and slides on.

   tools/contact.h finds all of that. One function says how wide each gap is, and its gradient; a step may have as many
   events in it as happen. Each is met to rounding, so the order stays that of the steps, 2s: here at 64 steps in all.

   A cam pushes a valve, a spring pushes it back. Too fast, and the valve flies: with m = 1, k = 2, a preload of 3 and a
   lift of 1 - cos wt the push is w^2 cos wt + 3 + 2 (1 - cos wt), first 0 at the top of the cam at w^2 = 7.

   49_lift_off --svg file draws the valve over the cam at 1.3 times that speed.

   prints

     degree 1: leaves within 1e-04, lands within 1e-03
     degree 2: leaves within 1e-07, lands within 1e-07
     degree 3: leaves within 1e-11, lands within 1e-11
     degree 4: leaves within 1e-14, lands within 1e-14
     cam at 0.999999 of the critical speed: never lifts
     cam at 1.000001 of the critical speed: lifts
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/contact.h"
#include "tools/svg.h"

static double memory[20000];

GVI_EACH(weight, 2, f) { x->f[1] -= 1; }

/* Of sphere and floor, which is at y = -1 */
static void gap(int which, double t, const double *q, double *phi, double *gradient, double *rate, void *user)
{
    const double r = sqrt(q[0]*q[0] + q[1]*q[1]);
    (void)t, (void)rate, (void)user;
    if (which == 0) *phi = r - 1, gradient[0] = q[0]/r, gradient[1] = q[1]/r;
    else *phi = q[1] + 1, gradient[1] = 1;
}

typedef struct place { double left, landed; } place;

static void told(contact *c, contact_kind kind, int which)
{
    place *p = (place *)c->user;
    if (kind == CONTACT_OPENED && which == 0) p->left = c->st.q[1];
    if (kind == CONTACT_IMPACT) p->landed = c->st.q[0];
}

/* From rest at angle 0.3: the height at which the bead leaves, and where it lands */
static place slide(int degree, int steps)
{
    place p = { 0, 0 };
    contact c = { .count = 2, .slots = 2, .gap = gap, .told = told, .user = &p };
    gvi_effect scene[3] = { { .kind = GVI_POTENTIAL, .points = weight } };
    contact_rows(&c, scene + 1);
    const gvi_desc desc = { .n = 2, .degree = degree, .effects = scene, .effect_count = 3 };
    const double q[] = { sin(0.3), cos(0.3) }, v[] = { 0, 0 };
    gvi_status status = contact_init(&c, &desc, memory, sizeof memory);
    if (!status) status = contact_start(&c, 0, q, v);
    for (int k = 0; k < steps && !status; ++k) status = contact_step(&c, 4.0/steps);
    if (status) puts(contact_why(&c, status));
    return p;
}

static double omega;
GVI_EACH(spring, 1, f) { x->f[0] -= 3 + 2*x->q[0]; }

static void cam(int which, double t, const double *q, double *phi, double *gradient, double *rate, void *user)
{
    (void)which, (void)user;
    *phi = q[0] - (1 - cos(omega*t)), gradient[0] = 1, *rate = -omega*sin(omega*t);
}

/* How often the valve lifts in 40 s; with arrays, its way and the cam's over 4 s */
static unsigned long long turn(double speed, int steps, double h, double *t, double *valve, double *lift)
{
    contact c = { .count = 1, .slots = 1, .gap = cam };
    gvi_effect scene[2] = { { .kind = GVI_POTENTIAL, .points = spring } };
    contact_rows(&c, scene + 1);
    const gvi_desc desc = { .n = 1, .degree = 5, .effects = scene, .effect_count = 2 };
    const double q = 0, v = 0;
    omega = speed*sqrt(7);
    gvi_status status = contact_init(&c, &desc, memory, sizeof memory);
    if (!status) status = contact_start(&c, 0, &q, &v);
    for (int k = 0; k < steps && !status; ++k) {
        if (t) t[k] = c.st.t, valve[k] = c.st.q[0], lift[k] = 1 - cos(omega*c.st.t);
        status = contact_step(&c, h);
    }
    if (status) puts(contact_why(&c, status));
    return c.seen[CONTACT_OPENED];
}

static int draw(const char *path)
{
    enum { SAMPLES = 401 };
    static double t[SAMPLES], valve[SAMPLES], lift[SAMPLES];
    turn(1.3, SAMPLES, 0.01, t, valve, lift);
    const svg_line lines[] = { { "valve", t, valve, SAMPLES }, { "cam", t, lift, SAMPLES } };
    const svg_plot plot = { .title = "A valve that leaves its cam", .x_label = "t", .y_label = "lift", .lines = lines, .line_count = 2 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    if (argc > 2) return draw(argv[2]);
    const double C = 2*cos(0.3)/3, S = sqrt(1 - C*C), speed = sqrt(2*(cos(0.3) - C)), fall = speed*S,
                 landed = S + speed*C*(sqrt(fall*fall + 2*(C + 1)) - fall);
    for (int degree = 1; degree <= 4; ++degree) {
        const place p = slide(degree, 64);
        printf("degree %d: leaves within %.0e, lands within %.0e\n", degree, pow(10, ceil(log10(fabs(p.left - C) + 1e-15))),
               pow(10, ceil(log10(fabs(p.landed - landed) + 1e-15))));
    }
    for (int k = 0; k < 2; ++k) {
        const double part = k ? 1.000001 : 0.999999;
        const unsigned long long times = turn(part, 400, 0.1, NULL, NULL, NULL);
        printf("cam at %.6f of the critical speed: %s\n", part, times ? "lifts" : "never lifts");
    }
    return 0;
}
