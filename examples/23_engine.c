/* 23 - What do the bearings of an engine bear? A crank, a rod and a piston over a turn

   Crank of 40 mm about the origin with a flywheel, rod of 140 mm (at each end the part of its mass
   that its centre of gravity gives), piston along x. Coordinates: crank pin (x, y), piston (u, w);
   the cylinder is the row w = 0. Air is compressed to a ninth of its volume and expands again, p V^1.4
   constant, with the surrounding air behind the piston: the gas of an engine that is turned, not fired.
   The flywheel is given 3000 turns a minute.

   Rows are lengths here, so the multipliers are forces in N at once: along the crank, along the rod (on
   both of its pins), and of the cylinder's wall; they are drawn over a turn. The check takes nothing from
   them: by the crank's angle a alone, u = r cos a + sqrt(l^2 - r^2 sin^2 a), one equation of motion gives
   u'', the piston S cos b = m u'' - F of the rod, b its angle, and S sin b of the wall.

   23_engine [--svg file]

   prints

     speed 3000 turns a minute, over a turn within 2.0 %
     rod: 6792 N of push at most, 355 N at least; wall: 532 N at most
     the same by the angle of the crank: to 1e-9: yes
     energy over 50 turns to 1e-10: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double crank = 0.04, rod = 0.14, bore = 0.08, piston = 0.55, ratio = 9, outside = 1.01325e5;
// kg m^2, kg; a third of the rod goes with the piston
static const double wheel = 0.06, rod_mass = 0.6, pi = 3.14159265358979;

/* |pin| - r, |piston - pin| - l, w */
GVI_POINTS(joints, 4, rows(3))(const gvi_points *x, void *user)
{
    const double X = x->q[0], Y = x->q[1], a = x->q[2] - X, b = x->q[3] - Y, r = sqrt(X*X + Y*Y), l = sqrt(a*a + b*b);
    double *G1 = x->jacobian, *G2 = G1 + 4, *G3 = G2 + 4;
    x->g[0] = r - crank;
    x->g[1] = l - rod;
    x->g[2] = x->q[3];
    G1[0] = X/r, G1[1] = Y/r;
    G2[0] = -a/l, G2[1] = -b/l, G2[2] = a/l, G2[3] = b/l;
    G3[3] = 1;
    return (void)user, 0;
}

/* Force of the gas on the piston, along x, and its potential: what is left above the piston is V */
static double gas(double u, double *potential)
{
    const double area = pi*bore*bore/4, full = 2*crank*ratio/(ratio - 1), left = full - (u - (rod - crank));
    const double push = area*outside*pow(full/left, 1.4);
    if (potential) *potential = push*left/0.4 - area*outside*u;
    return area*outside - push;
}

static int pressure(const gvi_points *x, void *user)
{
    const double *u = x->q + 2*x->stride;
    for (int k = 0; k < x->count; ++k) {
        double V;
        if (x->f) x->f[2*x->stride + k] += gas(u[k], NULL);
        if (x->value) gas(u[k], &V), x->value[k] += V;
    }
    return (void)user, 0;
}

enum { TURNS = 50, STEPS = 200, DRAWN = STEPS + 1 };
static double angle[DRAWN], force[3][DRAWN];

static int draw(const char *path)
{
    const svg_line lines[] = { { "crank", angle, force[0], DRAWN }, { "rod", angle, force[1], DRAWN },
                               { "cylinder wall", angle, force[2], DRAWN } };
    const svg_plot plot = { .title = "Forces in the joints of a crank drive at 3000 turns a minute", .x_label = "angle of the crank, degrees",
                            .y_label = "N, push", .lines = lines, .line_count = 3, .x_step = 90 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    static double memory[GVI_CONSTRAINED_LENGTH(4, 6, 6, 3)];
    const double moved = piston + rod_mass/3, turning = wheel/(crank*crank) + 2*rod_mass/3, w = 100*pi;
    const double mass[4] = { turning, turning, moved, moved };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pressure, .value = pressure },
                                 { .kind = GVI_CONSTRAINT, .points = joints, .rows = 3 } };
    const gvi_desc desc = { .n = 4, .degree = 6, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
    gvi_stepper st;
    double E, E0, push = 0, least = HUGE_VAL, wall = 0, miss = 0, drift = 0, slow = w, fast = w;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0, crank, sqrt(rod*rod - crank*crank), 0 }, (double[]){ -crank*w, 0, -crank*w, 0 });
    gvi_energy(&st, &E0);
    for (int k = 0; k < TURNS*STEPS && st.status == GVI_OK; ++k) {
        double lambda[3], v[4];
        gvi_step(&st, 2*pi/w/STEPS);
        gvi_multipliers(&st, lambda);
        gvi_velocity(&st, v);
        const double X = st.q[0], Y = st.q[1], speed = (X*v[1] - Y*v[0])/(crank*crank), a = atan2(Y, X);
        const double c = sqrt(rod*rod - Y*Y), F = gas(st.q[2], NULL);
        // the same by the angle alone: u' = slope w, and w' from the energy of turning parts and piston
        const double slope = -Y - X*Y/c, bend = -X - (X*X - Y*Y)/c - X*X*Y*Y/(c*c*c);
        const double gain = (F*slope - moved*slope*bend*speed*speed)/(turning*crank*crank + moved*slope*slope);
        const double S = (moved*(bend*speed*speed + slope*gain) - F)*rod/c;
        miss = fmax(miss, fabs(lambda[1] - S) + fabs(lambda[2] - S*Y/rod));
        push = fmax(push, S), least = fmin(least, S), wall = fmax(wall, fabs(lambda[2]));
        slow = fmin(slow, speed), fast = fmax(fast, speed);
        gvi_energy(&st, &E);
        drift = fmax(drift, fabs(E - E0)/E0);
        const int at = k - (TURNS - 1)*STEPS + 1;
        if (at < 0) continue;
        angle[at] = at == 0 ? a*180/pi : angle[at - 1] + remainder(a*180/pi - angle[at - 1], 360);
        force[0][at] = lambda[0] + wheel/crank*speed*speed;       // the flywheel bears its own inertia
        force[1][at] = S;
        force[2][at] = lambda[2];
    }
    if (st.status != GVI_OK) return puts(gvi_status_text(st.status)), 1;
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;
    printf("speed %.0f turns a minute, over a turn within %.1f %%\n", 30*w/pi, 100*(fast - slow)/w);
    printf("rod: %.0f N of push at most, %.0f N at least; wall: %.0f N at most\n", push, least, wall);
    printf("the same by the angle of the crank: to 1e-9: %s\n", miss < 1e-9*push ? "yes" : "no");
    printf("energy over 50 turns to 1e-10: %s\n", drift < 1e-10 ? "yes" : "no");
    return 0;
}
