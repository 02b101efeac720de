/* 51 - What does a block do that is tipped? It rocks, ever faster, and stands

   A block, .4 wide and 2 high, stands on one corner, tipped by .1, and is let go. It rolls over the corner; the other one
   strikes, with e = 0, and the one that it stood on lifts: both are decided at once, since impulses push and never pull.
   On a smooth floor each impact leaves the part (h^2 - 2 b^2)/(h^2 + 4 b^2) of the rate, for a width of 2 b and a height of
   2 h. So it rocks infinitely often in a finite time; below c.rest both corners stay, and it stands.

   51_rocking_block --svg file writes that as a film.

   prints

     37 impacts, each leaves 0.793103 of the rate: to 1e-07
     stands at t = 1.672: 4.905 N on each corner, tipped by 0e+00
     energy and what the impacts took: within 1e-12 of the start
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/contact.h"
#include "tools/animate.h"

enum { SAMPLES = 401, POINTS = 6 };
static const double B = 0.2, H = 1, g = 9.81, tip = 0.1;
static double memory[60000];
static struct { double rate, off, stands; int impacts; } seen;
static double way[SAMPLES][POINTS][2], times[SAMPLES], angle[SAMPLES], taken[SAMPLES];

GVI_EACH(weight, 3, f) { x->f[1] -= g; }

/* Height of a lower corner; q is the middle and the angle */
static void corner(int which, double t, const double *q, double *phi, double *gradient, double *rate, void *user)
{
    const double X = which ? B : -B, s = sin(q[2]), c = cos(q[2]);
    (void)t, (void)rate, (void)user;
    *phi = q[1] + s*X - c*H, gradient[1] = 1, gradient[2] = c*X + s*H;
}

static void told(contact *c, contact_kind kind, int which)
{
    (void)which;
    if (kind == CONTACT_CAPTURED) seen.stands = c->st.t;
    if (kind != CONTACT_IMPACT) return;
    const double w = fabs(c->st.p[2]);                                 // still that before the impact
    if (seen.impacts++ > 0) seen.off = fmax(seen.off, fabs(w/seen.rate/((H*H - 2*B*B)/(H*H + 4*B*B)) - 1));
    seen.rate = w;
}

static void keep(const contact *c, int k)
{
    const double *q = c->st.q, s = sin(q[2]), C = cos(q[2]);
    for (int i = 0; i < 4; ++i) {
        const double X = i == 1 || i == 2 ? B : -B, Y = i > 1 ? H : -H;
        way[k][i][0] = q[0] + C*X - s*Y, way[k][i][1] = q[1] + s*X + C*Y;
    }
    way[k][4][0] = -1, way[k][5][0] = 1;
    times[k] = c->st.t, angle[k] = q[2], taken[k] = c->energy;
}

static int film(const char *path)
{
    static const double none[POINTS] = { 0 };
    const animate_line lines[] = { { 0, 1, 4 }, { 0, 3, 2 }, { 4, 1, 2 } };
    const svg_line tipped = { "angle", times, angle, SAMPLES }, lost = { "taken", times, taken, SAMPLES };
    const animation a = { .title = "A block that is tipped", .caption = "e = 0, no friction", .points = POINTS, .samples = SAMPLES,
                          .xy = &way[0][0][0], .t = times, .every = 2, .seconds = 8, .sizes = none, .lines = lines, .line_count = 3,
                          .plots = { { .title = "angle", .x_label = "t", .lines = &tipped, .line_count = 1 },
                                     { .title = "energy taken by impacts", .x_label = "t", .lines = &lost, .line_count = 1 } } };
    return animate_write(path, &a);
}

int main(int argc, char **argv)
{
    const double I = (B*B + H*H)/3, m[] = { 1, 1, I }, q[] = { 0, H*cos(tip) + B*sin(tip), tip }, v[] = { 0, 0, 0 };
    contact c = { .count = 2, .slots = 2, .gap = corner, .told = told, .rest = 1e-4 };
    gvi_effect scene[3] = { { .kind = GVI_POTENTIAL, .points = weight } };
    contact_rows(&c, scene + 1);
    const gvi_desc desc = { .n = 3, .degree = 4, .effects = scene, .effect_count = 3,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    gvi_status status = contact_init(&c, &desc, memory, sizeof memory);
    if (!status) status = contact_start(&c, 0, q, v);
    for (int k = 0; k < SAMPLES && !status; ++k) {
        keep(&c, k);
        status = contact_step(&c, 0.005);
    }
    if (status) return puts(contact_why(&c, status)), 1;
    if (argc > 2) return film(argv[2]);
    double E = g*(c.st.q[1] - q[1]) + c.energy;
    for (int i = 0; i < 3; ++i) E += c.st.p[i]*c.st.p[i]/m[i]/2;
    printf("%d impacts, each leaves %.6f of the rate: to %.0e\n", seen.impacts, (H*H - 2*B*B)/(H*H + 4*B*B),
           pow(10, ceil(log10(seen.off))));
    printf("stands at t = %.3f: %.3f N on each corner, tipped by %.0e\n", seen.stands, contact_force(&c, 0),
           fabs(c.st.q[2]) < 1e-14 ? 0 : fabs(c.st.q[2]));
    printf("energy and what the impacts took: within %.0e of the start\n", pow(10, ceil(log10(fabs(E) + 1e-13))));
    return 0;
}
