/* 45 - Can it be parked? A car with a trailer, steered by the clock

   Wheels do not slip sideways: a row for the rear axle, one for the front axle, whose direction the steering turns as time
   goes by, one for the trailer's axle. A fourth row is the driver's foot: the speed along the car is u(t). So A and
   a depend on time, A(t, q) v + a(t) = 0, and the four rows leave no freedom at all: the way is given, and what is to be
   known are the forces, the rows' multipliers.

   The slot is at the origin, along x. Going out of it forwards, into the lane at its side, is easy. Rolling knows no
   direction of time, so the same steering from the end to the start, backwards, parks car and trailer. It is as hard
   as in life: the angle at the hitch grows like e^(way/length of the trailer), and with it every error.

   Is the trailer right? Behind a car that drives straight on, the angle a at the hitch falls by
   tan(a/2) = tan(a0/2) e^(-way/length).

   45_trailer [--svg file]
   prints

     straight on for 8 m, hitch from 1 to 0.075882 rad, by the formula 0.075882
     out of the slot: axle at 7.25, 2.99, car turned by 0.00, trailer by 0.32
     and back: off by less than 1e-10: yes
     sideways on the trailer's tyres at most 159 N, by the engine 1621 N
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include "tools/svg.h"

enum { STEPS = 160 };
static const double pi = 3.141592653589793, base = 2.7, tow = 3, whole = 8;

/* the steering at time t, and the speed; back: the same from the end to the start */
typedef struct driver { double turn, speed; int back; } driver;

static double wheel(const driver *d, double t) { return d->turn*sin(2*pi*(d->back ? whole - t : t)/whole); }

static double speed(const driver *d, double t)
{
    const double s = sin(pi*t/whole);
    return (d->back ? -1 : 1)*d->speed*s*s;
}

/* x, y of the rear axle, directions of car and trailer; the centre of mass of the car is half way to the front axle, that of
   the trailer at two thirds of the way to its axle. kg, m */
LAGRANGIAN(car_and_trailer, 4)
{
    const number c = cos(q[2]), s = sin(q[2]), C = cos(q[3]), S = sin(q[3]);
    const number X = v[0] - base/2*s*v[2], Y = v[1] + base/2*c*v[2], U = v[0] + tow*2/3*S*v[3], W = v[1] - tow*2/3*C*v[3];
    return 1200*(X*X + Y*Y)/2 + 1800*v[2]*v[2]/2 + 600*(U*U + W*W)/2 + 500*v[3]*v[3]/2;
}

GVI_EACH(rolls, 4, rows(4))
{
    const driver *d = user;
    const double a = x->q[2], b = x->q[3], f = a + wheel(d, x->t[0]);
    double *A = x->jacobian;
    A[0] = -sin(a), A[1] = cos(a);                                    // rear axle
    A[4] = -sin(f), A[5] = cos(f), A[6] = base*cos(f - a);            // front axle
    A[8] = -sin(b), A[9] = cos(b), A[11] = -tow;                      // trailer
    A[12] = cos(a), A[13] = sin(a);                                   // forwards, with speed u
    x->rate[3] = -speed(d, x->t[0]);
}

static double x[2*STEPS + 2], y[2*STEPS + 2], tail[2][2*STEPS + 2], most[4];

/* The state after `whole` seconds with this driver; the way of axle and trailer from number `at` on. */
static int drive(const driver *d, double *q, int at)
{
    static double memory[GVI_CONSTRAINED_LENGTH(4, 6, 6, 4)];
    static lagrangian L;
    const double rest[4] = { 0, 0, 0, 0 }, moving[4] = { 1, 0, 0, 0.5 };
    double force[4];
    const char *wrong = lagrangian_init(&L, car_and_trailer, NULL, 0, q, moving);
    if (wrong) return puts(wrong), 0;
    const gvi_effect scene[] = { lagrangian_effect(&L),
                                 { .kind = GVI_NONHOLONOMIC, .points = rolls, .rows = 4, .user = (void *)d } };
    const gvi_desc desc = { .n = 4, .degree = 6, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 2 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, rest);
    for (int k = 0; k <= STEPS && st.status == GVI_OK; ++k) {
        x[at + k] = st.q[0], y[at + k] = st.q[1];
        tail[0][at + k] = st.q[0] - tow*cos(st.q[3]), tail[1][at + k] = st.q[1] - tow*sin(st.q[3]);
        if (k == STEPS) break;
        gvi_step(&st, whole/STEPS);
        if (gvi_multipliers(&st, force) == GVI_OK)
            for (int i = 0; i < 4; ++i) most[i] = fmax(most[i], fabs(force[i]));
    }
    for (int i = 0; i < 4; ++i) q[i] = st.q[i];
    return st.status == GVI_OK || (puts(gvi_why(&st)), 0);
}

static int draw(const char *path)
{
    const svg_line lines[] = { { "rear axle of the car", x, y, STEPS + 1 }, { "axle of the trailer", tail[0], tail[1], STEPS + 1 } };
    const svg_plot plot = { .title = "Out of the slot, and back the same way", .x_label = "x, in m", .y_label = "y, in m",
                            .lines = lines, .line_count = 2 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    driver d = { .turn = 0, .speed = 2 };
    double q[4] = { 0, 0, 0, -1 }, off = 0;
    if (!drive(&d, q, 0)) return 1;
    printf("straight on for %.0f m, hitch from 1 to %.6f rad, by the formula %.6f\n", q[0], -q[3], 2*atan(tan(0.5)*exp(-q[0]/tow)));

    double slot[4] = { 0, 0, 0, 0 };
    d.turn = 0.6;
    for (int i = 0; i < 4; ++i) most[i] = 0;
    if (!drive(&d, slot, 0)) return 1;
    printf("out of the slot: axle at %.2f, %.2f, car turned by %.2f, trailer by %.2f\n", slot[0], slot[1], fabs(slot[2]), slot[3]);
    d.back = 1;
    if (!drive(&d, slot, STEPS + 1)) return 1;
    for (int i = 0; i < 4; ++i) off = fmax(off, fabs(slot[i]));
    printf("and back: off by less than 1e-10: %s\n", off < 1e-10 ? "yes" : "no");
    printf("sideways on the trailer's tyres at most %.0f N, by the engine %.0f N\n", most[2], most[3]);
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;
    return 0;
}
