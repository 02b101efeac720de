/* scenes.h - the scenes of the playground: to add one, write thirty lines here

   A scene is a list of effects (examples/tools/effects.h), initial values, and what to draw; add it to
   scenes[] at the end, then `make playground`.  elastic_pendulum is the shortest.

   SHOWN(name, text)    the text as C and, for the program that the page writes, as a string: it
                        shows only what the effects in use need
   ADD(s, name, what, on, effect)    a switch on the page; on = 1: on at first.  A clock is the last
   INSTEAD(s, effect)   the same as a force, for integrators that know no Lagrangian terms; { 0 }: nothing
   MASS(s, mass)        if it is not the unit mass

   A row may be of any kind that gvi.h has; the page breaks a constraint with gvi_switch.      */
#ifndef SCENES_H
#define SCENES_H

#include "clocks.h"
#include "tools/body.h"
#include <string.h>

enum { SCENE_MOST = 96,        /* degrees of freedom                                       */
       SCENE_BODIES = 40, SCENE_PARAMETERS = 3, SCENE_QUANTITIES = 2, SCENE_EFFECTS = 10,
       SCENE_ROWS = 24 };      /* of constraints                                           */

typedef struct scene_row {
    const char *name, *what, *text;
    gvi_effect  effect, force;         /* force: instead, for the rivals                   */
    int         on;
} scene_row;

typedef struct scene_setup {
    scene_row   row[SCENE_EFFECTS];
    int         rows;
    gvi_mass    mass;
    const char *mass_text;
    double      q[SCENE_MOST], v[SCENE_MOST];
    double      value[SCENE_PARAMETERS];          /* in: as the sliders stand              */
    int         momenta;                          /* v and y hold q, p: the scene is H(t,q,p) */
    void      (*slope)(double t, const double *y, double *dy);         /* NULL, or for the    */
    double    (*energy)(double t, const double *q, const double *v);   /* rivals instead of rows */
} scene_setup;

typedef struct scene {
    const char *name, *title, *about;  /* name: in the address of the page                 */
    int         n, degree;
    double      h, span;               /* a step that suits; how long the runs for "Cost" are */
    double      speed;                 /* scene time in a second                           */
    const char *time_unit, *error_unit, *length_unit;   /* of time, coordinates, the picture */
    struct { const char *name, *unit; double low, high, step, value; } parameter[SCENE_PARAMETERS];
    struct { const char *name, *unless; } quantity[SCENE_QUANTITIES];   /* kept, unless these act */
    const char *text, *make;           /* from SHOWN; a call that fills its tables         */
    void      (*build)(scene_setup *s);
    void      (*quantities)(const double *q, const double *v, const double *p, double *out);

    /* The picture: bodies in space (NaN: not there), rods between bodies first, first + step, ...;
       a radius in pixels and a trail for each.  space: seen from the side, can be turned.  */
    int         bodies, space;
    double      view;                  /* half the width of what is seen                   */
    double      centre[3];
    void      (*place)(const double *q, unsigned on, double (*x)[3]);
    struct { int first, step, count; } rod[16];
    const double *radius;              /* below 0: hollow                                  */
    unsigned    trails, fixed;         /* bit b: of body b                                 */
} scene;

#define SHOWN(name, ...) __VA_ARGS__ static const char name[] = #__VA_ARGS__;
#define ADD(s, name, what, on, effect) scene_add(s, name, what, #effect, on, effect)
#define INSTEAD(s, effect) ((s)->row[(s)->rows - 1].force = (effect))
#define MASS(s, given) ((s)->mass = (given), (s)->mass_text = #given)

static inline void scene_add(scene_setup *s, const char *name, const char *what, const char *text,
                             int on, gvi_effect effect)
{
    s->row[s->rows++] = (scene_row){ name, what, text, effect, effect, on };
}

/* g or A v + a, Jacobian and rate of the constraints in `on` at one point; their rows, -1: too many. */
static inline int scene_hold(const scene_setup *s, unsigned on, int n, double t, const double *q, const double *v,
                             double *g, double *G, double *rate)
{
    int m = 0;
    for (int e = 0; e < s->rows; ++e) {
        const gvi_effect *a = &s->row[e].effect;
        if (!(on >> e & 1) || a->kind < GVI_CONSTRAINT) continue;
        if (m + a->rows > SCENE_ROWS) return -1;
        for (int i = 0; i < a->rows*n; ++i) G[m*n+i] = 0;
        for (int i = 0; i < a->rows; ++i) g[m+i] = rate[m+i] = 0;
        a->points(&(gvi_points){ .n = n, .count = 1, .stride = 1, .t = &t, .q = q, .g = g + m,
                                 .jacobian = G + m*n, .rate = rate + m }, a->user);
        for (int i = 0; i < a->rows && a->kind == GVI_NONHOLONOMIC; ++i) {
            g[m+i] = rate[m+i];
            for (int j = 0; j < n; ++j) g[m+i] += G[(m+i)*n+j]*v[j];
        }
        m += a->rows;
    }
    return m;
}

static double scene_push[2];           /* the ground's force, where something rolls            */

static inline void scene_point(double *x, double a, double b, double c)
{
    x[0] = a;
    x[1] = b;
    x[2] = c;
}

/* Angular momentum about the third axis of particles in dim dimensions.                   */
static inline double scene_angular(int count, int dim, const double *q, const double *p)
{
    double sum = 0;
    for (int i = 0; i < count; ++i, q += dim, p += dim) sum += q[0]*p[1] - q[1]*p[0];
    return sum;
}

/* ------------------------------------------------------------------ a planet */

SHOWN(kepler_text,
static const gvi_real planet_mass[] = { 1 };
static const struct central_gravity sun = { { 0, 1, 3 }, planet_mass, 39.4784176, { 0, 0, 0 } };
static const struct oblateness bulge = { { 0, 1, 3 }, planet_mass, 39.4784176, 0.2, 0.1 };
static const struct central_gravity star = { { 0, 1, 3 }, planet_mass, 2, { -1.8, 1, 0 } };
static const struct magnetic planet_field = { { 0, 1, 3 }, planet_mass, { 0, 0, 0.6 } };
static const struct linear_drag dust = { 0, 3, 0.012, 3 };
static const struct motor push = { { -1, 0 }, 0, 0.4, 8, 0 };
static const struct distance_clock planet_clock = { { 0, 1, 3 } };
)

static void kepler_build(scene_setup *s)
{
    const double e = s->value[0], i = s->value[1]/57.29577951308232;
    const double v = sqrt(39.4784176*(1 + e)/(1 - e));
    s->q[0] = 1 - e;
    s->v[1] = v*cos(i);
    s->v[2] = v*sin(i);
    ADD(s, "gravity", "potential of the star", 1, central_gravity(&sun));
    ADD(s, "oblateness", "the star is flattened", 1, oblateness(&bulge));
    ADD(s, "third body", "a dwarf star, fixed", 0, central_gravity(&star));
    ADD(s, "magnetic field", "Lagrangian term, reads v", 0, magnetic_field(&planet_field));
    INSTEAD(s, magnetic_force(&planet_field));
    ADD(s, "drag", "force, reads v: dust", 0, linear_drag(&dust));
    ADD(s, "drive", "force that swings in time", 0, motor(&push));
    ADD(s, "clock", "dt = |q| d\xcf\x84", 0, distance_clock(&planet_clock));
}

static void kepler_place(const double *q, unsigned on, double (*x)[3])
{
    scene_point(x[0], 0, 0, 0);
    memcpy(x[1], q, sizeof x[1]);
    scene_point(x[2], on & 4 ? -1.8 : NAN, 1, 0);
}

static void kepler_quantities(const double *q, const double *v, const double *p, double *out)
{
    out[0] = scene_angular(1, 3, q, p);
    (void)v;
}

static const double kepler_radius[] = { 11, 6, 7 };

static const scene kepler = {
    .name = "kepler", .title = "Planet", .about = "A planet on an ellipse of 1 AU about a star like the "
    "Sun: it goes round in a year.", .n = 3, .degree = 8, .h = 0.02, .span = 10, .speed = 0.32,
    .time_unit = "yr", .error_unit = "AU", .length_unit = "AU",
    .parameter = { { "eccentricity", "", 0, 0.99, 0.01, 0.6 }, { "inclination", "\xc2\xb0", 0, 85, 5, 25 } },
    .quantity = { { "angular momentum", "third body,drag,drive" } }, .text = kepler_text,
    .build = kepler_build, .quantities = kepler_quantities,
    .bodies = 3, .space = 1, .view = 1.35, .centre = { -0.6, 0, 0 }, .place = kepler_place,
    .radius = kepler_radius, .trails = 2, .fixed = 5,
};

/* ------------------------------------------------------------- three bodies */

SHOWN(eight_text,
static const gvi_real eight_mass[] = { 1, 1, 1 };
static const struct pair_gravity eight_gravity = { { 0, 3, 2 }, eight_mass, 1 };
static const struct uniform_field eight_tide = { { 0, 3, 2 }, eight_mass, { 0.002, 0, 0 } };
static const struct linear_drag eight_drag = { 0, 6, 0.002, 6 };
static const struct pair_clock eight_clock = { { 0, 3, 2 } };
)

/* Chenciner, Montgomery, Annals of Mathematics 152, 2000; initial data by C. Simo         */
static void eight_build(scene_setup *s)
{
    const double x = 0.97000436, y = -0.24308753, u = -0.93240737, w = -0.86473146;
    const double q[] = { x, y, -x, -y, 0, 0 }, v[] = { -u/2, -w/2, -u/2, -w/2, u, w };
    memcpy(s->q, q, sizeof q);
    memcpy(s->v, v, sizeof v);
    s->q[0] += s->value[0];
    ADD(s, "gravity", "potential, of all pairs", 1, pair_gravity(&eight_gravity));
    ADD(s, "outer field", "potential, uniform", 0, uniform_field(&eight_tide));
    ADD(s, "drag", "force, reads v", 0, linear_drag(&eight_drag));
    ADD(s, "clock", "slow where bodies are close", 0, pair_clock(&eight_clock));
}

static void three_place(const double *q, unsigned on, double (*x)[3])
{
    for (int i = 0; i < 3; ++i) scene_point(x[i], q[2*i], q[2*i+1], 0);
    (void)on;
}

static void eight_quantities(const double *q, const double *v, const double *p, double *out)
{
    out[0] = scene_angular(3, 2, q, p);
    out[1] = p[0] + p[2] + p[4];
    (void)v;
}

static const double three_radius[] = { 7, 7, 7 };

static const scene figure_eight = {
    .name = "eight", .title = "Figure eight", .about = "Three equal masses follow each other on one curve. "
    "G = m = 1.", .n = 6, .degree = 8, .h = 0.2, .span = 63.2591398, .speed = 1.5,
    .time_unit = "", .error_unit = "length units",
    .parameter = { { "first body moved by", "", -0.1, 0.1, 0.01, 0 } },
    .quantity = { { "angular momentum", "drag,outer field" }, { "momentum x", "drag,outer field" } },
    .text = eight_text, .build = eight_build, .quantities = eight_quantities,
    .bodies = 3, .view = 1.3, .place = three_place, .radius = three_radius, .trails = 7,
};

SHOWN(pythagoras_text,
static const gvi_real pythagoras_mass[] = { 3, 4, 5 };
static const gvi_real pythagoras_masses[] = { 3, 3, 4, 4, 5, 5 };
static const struct pair_gravity pythagoras_gravity = { { 0, 3, 2 }, pythagoras_mass, 1 };
static const struct linear_drag pythagoras_drag = { 0, 6, 0.01, 6 };
static const struct pair_clock pythagoras_clock = { { 0, 3, 2 } };
)

/* Burrau's problem: at rest in the corners of a triangle of sides 3, 4, 5                 */
static void pythagoras_build(scene_setup *s)
{
    const double q[] = { 1, 3, -2, -1, 1, -1 };
    memcpy(s->q, q, sizeof q);
    MASS(s, ((gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = pythagoras_masses }));
    ADD(s, "gravity", "potential, of all pairs", 1, pair_gravity(&pythagoras_gravity));
    ADD(s, "drag", "force, reads v", 0, linear_drag(&pythagoras_drag));
    ADD(s, "clock", "slow where bodies are close", 1, pair_clock(&pythagoras_clock));
}

static const double pythagoras_radius[] = { 6, 7.5, 9 };

static const scene pythagoras = {
    .name = "pythagoras", .title = "Pythagorean", .about = "Masses 3, 4, 5 fall from rest in the corners of "
    "a triangle; near encounters throw one out. A clock lets the step shrink there.", .n = 6, .degree = 8,
    .h = 0.025, .span = 10, .speed = 1, .time_unit = "", .error_unit = "length units",
    .quantity = { { "angular momentum", "drag" }, { "momentum x", "drag" } },
    .text = pythagoras_text, .build = pythagoras_build, .quantities = eight_quantities,
    .bodies = 3, .view = 4, .place = three_place, .radius = pythagoras_radius, .trails = 7,
};

/* ---------------------------------------------------------- double pendulum */

SHOWN(pendulum_text,
static const struct two_links pendulum_links = { 2, 1, 1 };
static const gvi_real pendulum_levers[] = { 2*9.81, 9.81 };
static const joint pendulum_joints[] = { { -1, 0 }, { 0, 1 } };
static const struct weights pendulum_weights = { 0, 2, pendulum_levers };
static const struct joint_friction pendulum_friction = { pendulum_joints, 2, 0.05 };
static const struct motor pendulum_motor = { { -1, 0 }, 0, 8, 2.4, 0 };
)

static void pendulum_build(scene_setup *s)
{
    s->q[0] = s->value[0]/57.29577951308232;
    s->q[1] = s->value[1]/57.29577951308232;
    MASS(s, two_links(&pendulum_links));
    ADD(s, "gravity", "potential, in angles", 1, weights(&pendulum_weights));
    ADD(s, "friction", "torque, reads v", 0, joint_friction(&pendulum_friction));
    ADD(s, "drive", "torque that swings in time", 0, motor(&pendulum_motor));
}

static void links_place(const double *q, double upper, double lower, double (*x)[3])
{
    scene_point(x[0], 0, 0, 0);
    scene_point(x[1], upper*sin(q[0]), -upper*cos(q[0]), 0);
    scene_point(x[2], x[1][0] + lower*sin(q[1]), x[1][1] - lower*cos(q[1]), 0);
}

static void pendulum_place(const double *q, unsigned on, double (*x)[3])
{
    links_place(q, 1, 1, x);
    (void)on;
}

static void pendulum_quantities(const double *q, const double *v, const double *p, double *out)
{
    out[0] = p[0] + p[1];
    (void)q, (void)v;
}

static const double pendulum_radius[] = { 4, 8, 8 };

static const scene double_pendulum = {
    .name = "pendulum", .title = "Double pendulum", .about = "Two rods of 1 m with 1 kg at each end, in "
    "angles: the mass matrix depends on the position. Chaotic.", .n = 2, .degree = 8, .h = 0.04, .span = 10,
    .speed = 1, .time_unit = "s", .error_unit = "rad", .length_unit = "m",
    .parameter = { { "upper angle", "\xc2\xb0", -180, 180, 5, 90 }, { "lower angle", "\xc2\xb0", -180, 180, 5, 120 } },
    .quantity = { { "angular momentum", "gravity,friction,drive" } },
    .text = pendulum_text, .build = pendulum_build, .quantities = pendulum_quantities,
    .bodies = 3, .view = 2.2, .place = pendulum_place, .rod = { { 0, 1, 3 } }, .radius = pendulum_radius,
    .trails = 4, .fixed = 1,
};

/* ------------------------------------------------- the same as rods: constraints */

SHOWN(rods_text,
static const gvi_real rods_mass[] = { 1, 1 };
static const struct uniform_field rods_weight = { { 0, 2, 2 }, rods_mass, { 0, -9.81 } };
static const struct rod upper_rod[] = { { 0, -1, 1, { 0, 0 } } };
static const struct rod lower_rod[] = { { 1, 0, 1, { 0, 0 } } };
static const struct rods rods_upper = { { 0, 2, 2 }, upper_rod, 1 };
static const struct rods rods_lower = { { 0, 2, 2 }, lower_rod, 1 };
static const struct air_drag rods_air = { { 0, 2, 2 }, 0.02, 4 };
)

static void rods_build(scene_setup *s)
{
    const double angle[] = { s->value[0]/57.29577951308232, s->value[1]/57.29577951308232 };
    double x[3][3];
    links_place(angle, 1, 1, x);
    for (int i = 0; i < 2; ++i) memcpy(s->q + 2*i, x[i+1], 2*sizeof(double));
    ADD(s, "gravity", "potential, uniform", 1, uniform_field(&rods_weight));
    ADD(s, "upper rod", "constraint, to the pivot", 1, rods(&rods_upper));
    ADD(s, "lower rod", "constraint, between the bobs", 1, rods(&rods_lower));
    ADD(s, "drag", "force, reads v: air", 0, air_drag(&rods_air));
}

/* Pivot, bobs, and the upper end of each rod while it holds                               */
static void rods_place(const double *q, unsigned on, double (*x)[3])
{
    scene_point(x[0], 0, 0, 0);
    scene_point(x[1], q[0], q[1], 0);
    scene_point(x[2], q[2], q[3], 0);
    scene_point(x[3], on & 2 ? 0 : NAN, 0, 0);
    scene_point(x[4], on & 4 ? q[0] : NAN, q[1], 0);
}

static void rods_quantities(const double *q, const double *v, const double *p, double *out)
{
    out[0] = scene_angular(2, 2, q, p);
    out[1] = p[0] + p[2];
    (void)v;
}

static const double rods_radius[] = { 4, 8, 8, 0, 0 };

static const scene pendulum_rods = {
    .name = "rods", .title = "Pendulum of rods", .about = "The double pendulum again, in x and y: each rod "
    "is a constraint. Break one, and the bob flies off.", .n = 4, .degree = 8, .h = 0.04, .span = 10,
    .speed = 1, .time_unit = "s", .error_unit = "m", .length_unit = "m",
    .parameter = { { "upper angle", "\xc2\xb0", -180, 180, 5, 90 }, { "lower angle", "\xc2\xb0", -180, 180, 5, 120 } },
    .quantity = { { "angular momentum", "gravity,drag" }, { "momentum x", "upper rod,drag" } },
    .text = rods_text, .build = rods_build, .quantities = rods_quantities,
    .bodies = 5, .view = 2.2, .place = rods_place, .rod = { { 3, -2, 2 }, { 4, -2, 2 } }, .radius = rods_radius,
    .trails = 4, .fixed = 1,
};

/* ------------------------------------- a frame with one rod more than it needs */

SHOWN(frame_text,
static const gvi_real frame_mass[] = { 1, 1, 1, 1 };
static const struct uniform_field frame_weight = { { 0, 4, 2 }, frame_mass, { 0, -9.81 } };
static const struct rod hanger_rod[] = { { 0, -1, 0.6, { 0, 0 } } };
static const struct rod side_rods[] = {
    { 0, 1, 1.05, { 0, 0 } }, { 1, 2, 0.65, { 0, 0 } }, { 2, 3, 0.55, { 0, 0 } }, { 3, 0, 0.65, { 0, 0 } } };
static const struct rod brace_rod[] = { { 0, 2, 1, { 0, 0 } } };
static const struct rod spare_rod[] = { { 1, 3, 1, { 0, 0 } } };
static const struct rods frame_hanger = { { 0, 4, 2 }, hanger_rod, 1 };
static const struct rods frame_sides = { { 0, 4, 2 }, side_rods, 4 };
static const struct rods frame_brace = { { 0, 4, 2 }, brace_rod, 1 };
static const struct rods frame_spare = { { 0, 4, 2 }, spare_rod, 1 };
static const struct air_drag frame_air = { { 0, 4, 2 }, 0.02, 8 };
)

static void frame_build(scene_setup *s)
{
    static const double corner[4][2] = { { 0, 0 }, { 1.05, 0 }, { 0.8, -0.6 }, { 0.25, -0.6 } };
    const double a = s->value[0]/57.29577951308232, b = s->value[1]/57.29577951308232;
    for (int i = 0; i < 4; ++i) {
        s->q[2*i] = 0.6*sin(a) + cos(b)*corner[i][0] - sin(b)*corner[i][1];
        s->q[2*i+1] = -0.6*cos(a) + sin(b)*corner[i][0] + cos(b)*corner[i][1];
    }
    ADD(s, "gravity", "potential, uniform", 1, uniform_field(&frame_weight));
    ADD(s, "hanger", "constraint, to the pivot", 1, rods(&frame_hanger));
    ADD(s, "sides", "four constraints", 1, rods(&frame_sides));
    ADD(s, "diagonal", "constraint, keeps the shape", 1, rods(&frame_brace));
    ADD(s, "second diagonal", "constraint, redundant", 1, rods(&frame_spare));
    ADD(s, "drag", "force, reads v: air", 0, air_drag(&frame_air));
}

/* Pivot, corners, then the ends of what holds                                             */
static void frame_place(const double *q, unsigned on, double (*x)[3])
{
    scene_point(x[0], 0, 0, 0);
    for (int i = 0; i < 5; ++i) {
        const double *p = q + i%4*2;
        scene_point(x[5+i], on & 4 ? p[0] : NAN, p[1], 0);
        if (i < 4) scene_point(x[1+i], p[0], p[1], 0);
    }
    scene_point(x[10], on & 8 ? q[0] : NAN, q[1], 0);
    scene_point(x[11], on & 16 ? q[2] : NAN, q[3], 0);
    scene_point(x[12], on & 2 ? 0 : NAN, 0, 0);
}

static const double frame_radius[13] = { 4, 7, 7, 7, 7 };

static const scene braced_frame = {
    .name = "frame", .title = "Braced frame", .about = "One diagonal keeps the frame in shape, the second is "
    "redundant. Switch it off: the motion stays the same. Switch both off: the frame folds.",
    .n = 8, .degree = 8, .h = 0.02, .span = 10, .speed = 1, .time_unit = "s", .error_unit = "m", .length_unit = "m",
    .parameter = { { "hanger", "\xc2\xb0", -180, 180, 5, 90 }, { "frame", "\xc2\xb0", -180, 180, 5, 0 } },
    .text = frame_text, .build = frame_build,
    .bodies = 13, .view = 1.9, .centre = { 0, -0.4, 0 }, .place = frame_place,
    .rod = { { 5, 1, 5 }, { 10, -7, 2 }, { 11, -7, 2 }, { 12, -11, 2 } }, .radius = frame_radius,
    .trails = 8, .fixed = 1,
};

/* ---------------------------------------------------------------------- top */

SHOWN(top_text,
static const struct top toy_top = { 2e-4, 8e-5 };
static const gvi_real toy_lever[] = { -0.1*9.81*0.04 };
static const struct weights toy_weight = { 0, 1, toy_lever };
static const struct linear_drag toy_friction = { 1, 2, 1e-5, 3 };
static const struct motor toy_motor = { { -1, 2 }, 2e-3, 0, 0, 0 };
)

static void top_build(scene_setup *s)
{
    s->q[0] = s->value[0]/57.29577951308232;
    s->v[1] = s->value[2];
    s->v[2] = s->value[1];
    MASS(s, top(&toy_top));
    ADD(s, "gravity", "potential, of the tilt", 1, weights(&toy_weight));
    ADD(s, "friction", "torque, reads v", 0, linear_drag(&toy_friction));
    ADD(s, "drive", "torque on the spin", 0, motor(&toy_motor));
}

/* Tip, end of the axis, and a rim of twelve points that shows the spin; columns: its axes in space */
static void top_points(const double (*axis)[3], double w, double (*x)[3])
{
    for (int c = 0; c < 3; ++c) {
        x[0][c] = 0;
        x[1][c] = axis[2][c];
        x[15][c] = 0.62*axis[2][c];
        for (int i = 0; i <= 12; ++i) {
            const double a = w + i*0.5235987755982988;
            x[2+i][c] = x[15][c] + 0.42*(cos(a)*axis[0][c] + sin(a)*axis[1][c]);
        }
    }
}

static void top_place(const double *q, unsigned on, double (*x)[3])
{
    const double s = sin(q[0]), c = cos(q[0]), a = sin(q[1]), b = cos(q[1]);
    const double axis[3][3] = { { b, a, 0 }, { -c*a, c*b, s }, { s*a, -s*b, c } };
    top_points(axis, fmod(q[2], 6.283185307179586), x);
    (void)on;
}

static void top_quantities(const double *q, const double *v, const double *p, double *out)
{
    out[0] = p[1];
    out[1] = p[2];
    (void)q, (void)v;
}

static const double top_radius[16] = { 3, 5, 4 };

static const scene spinning_top = {
    .name = "top", .title = "Spinning top", .about = "A toy of 0.1 kg in Euler's angles: it nods while it "
    "goes round. Drag the picture to turn it.", .n = 3, .degree = 8, .h = 0.02, .span = 2, .speed = 0.12,
    .time_unit = "s", .error_unit = "rad",
    .parameter = { { "tilt", "\xc2\xb0", 5, 85, 5, 30 }, { "spin", " rad/s", 60, 300, 10, 150 },
                   { "push sideways", " rad/s", -10, 10, 0.5, 0 } },
    .quantity = { { "p of precession", "friction" }, { "p of spin", "friction,drive" } },
    .text = top_text, .build = top_build, .quantities = top_quantities,
    .bodies = 16, .space = 1, .view = 1.25, .centre = { 0, 0, 0.45 }, .place = top_place,
    .rod = { { 0, 1, 2 }, { 2, 1, 13 }, { 2, 13, 2 }, { 5, 10, 2 }, { 8, 7, 2 }, { 11, 4, 2 } },
    .radius = top_radius, .trails = 2, .fixed = 1,
};

/* --------------------------------------- the same as a quaternion: a constraint */

SHOWN(turn_text,
static const body turn_body[] = { { 0, { 2e-4, 2e-4, 8e-5 } } };
static const bodies turn_bodies = { turn_body, 1 };
static const struct linear_drag turn_drag = { 0, 4, 4e-5, 4 };
GVI_POINTS(turn_weight, 4, f, value)(const gvi_points *x, void *user) {
    const gvi_real centre[] = { 0, 0, 0.04 };
    const gvi_real weight[] = { 0, 0, -0.1*9.81 };
    gvi_real own[3];
    body_rotate(x->q, 1, weight, own);
    body_force_about(x->q, centre, own, x->f);
    x->value[0] -= centre[2]*own[2];
    return (void)user, 0;
}
)

static void turn_build(scene_setup *s)
{
    const double a = s->value[0]/57.29577951308232;
    const double w[] = { 0, s->value[2]*sin(a), s->value[1] + s->value[2]*cos(a) };
    s->q[0] = cos(a/2);
    s->q[1] = sin(a/2);
    body_turn(s->q, w, s->v);
    MASS(s, body_mass(&turn_bodies));
    ADD(s, "gravity", "potential", 1, ((gvi_effect){ .points = turn_weight, .value = turn_weight }));
    ADD(s, "friction", "torque, reads v", 0, linear_drag(&turn_drag));
    ADD(s, "unit length", "constraint, |q| = 1", 1, body_unit(&turn_bodies));
    INSTEAD(s, ((gvi_effect){ 0 }));                 /* its force is 0: nothing acts on |q| */
}

static void turn_place(const double *q, unsigned on, double (*x)[3])
{
    double axis[3][3];
    for (int i = 0; i < 3; ++i) body_rotate(q, 0, (double[3]){ i == 0, i == 1, i == 2 }, axis[i]);
    top_points((const double (*)[3])axis, 0, x);
    (void)on;
}

/* Along the vertical in space, and along the axis: q turned from the left and from the right */
static void turn_quantities(const double *q, const double *v, const double *p, double *out)
{
    const double a = p[3]*q[0] - p[0]*q[3], b = p[2]*q[1] - p[1]*q[2];
    out[0] = (a + b)/2;
    out[1] = (a - b)/2;
    (void)v;
}

static const scene quaternion_top = {
    .name = "quaternion", .title = "Top as a quaternion", .about = "The same toy without angles: four "
    "numbers, in which no tilt is singular. |q| = 1 is a constraint; without it |q| is left to rounding.",
    .n = 4, .degree = 8, .h = 0.005, .span = 2, .speed = 0.12, .time_unit = "s", .error_unit = "",
    .parameter = { { "tilt", "\xc2\xb0", 0, 180, 5, 30 }, { "spin", " rad/s", 60, 300, 10, 150 },
                   { "push sideways", " rad/s", -10, 10, 0.5, 0 } },
    .quantity = { { "vertical ang. momentum", "friction" }, { "axial ang. momentum", "friction" } },
    .text = turn_text, .build = turn_build, .quantities = turn_quantities,
    .bodies = 16, .space = 1, .view = 1.25, .centre = { 0, 0, 0.45 }, .place = turn_place,
    .rod = { { 0, 1, 2 }, { 2, 1, 13 }, { 2, 13, 2 }, { 5, 10, 2 }, { 8, 7, 2 }, { 11, 4, 2 } },
    .radius = top_radius, .trails = 2, .fixed = 1,
};

/* ---------------------------------------------------------------------- net */

SHOWN(net_text,
enum { SIDE = 5, KNOTS = SIDE*SIDE };
static gvi_real net_mass[3*KNOTS];
static struct spring net_spring[2*SIDE*(SIDE - 1)];
static struct tether net_hook[4];
static const struct uniform_field net_weight = { { 0, KNOTS, 3 }, net_mass, { 0, 0, -9.81 } };
static const struct springs net_threads = { { 0, KNOTS, 3 }, net_spring, 2*SIDE*(SIDE - 1), 3*KNOTS };
static const struct tethers net_hooks = { { 0, KNOTS, 3 }, net_hook, 4, 3*KNOTS };
static const struct air_drag net_air = { { 0, KNOTS, 3 }, 0.006, 3*KNOTS };
static const struct motor net_shake = { { -1, 38 }, 0, 0.5, 20, 0 };
static void net_make(void) {
    struct spring *next = net_spring;
    struct tether *hook = net_hook;
    for (int i = 0; i < KNOTS; ++i) {
        const int x = i%SIDE, y = i/SIDE, last = SIDE - 1;
        for (int c = 0; c < 3; ++c) net_mass[3*i+c] = 0.01;
        if (x < last) *next++ = (struct spring){ i, i + 1, 100, 0.2 };
        if (y < last) *next++ = (struct spring){ i, i + SIDE, 100, 0.2 };
        if (x%last == 0 && y%last == 0) *hook++ = (struct tether){ i, 500, 0, { 0.2*x, 0.2*y, 0 } };
    }
}
)

static void net_build(scene_setup *s)
{
    static const double bell[] = { 0, 0.7071067811865476, 1, 0.7071067811865476, 0 };
    net_make();
    for (int i = 0; i < KNOTS; ++i)
        scene_point(s->q + 3*i, 0.2*(i%SIDE), 0.2*(i/SIDE), bell[i%SIDE]*bell[i/SIDE]*s->value[0]);
    MASS(s, ((gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = net_mass }));
    ADD(s, "springs", "potential, 40 threads", 1, springs(&net_threads));
    ADD(s, "hooks", "potential, at the corners", 1, tethers(&net_hooks));
    ADD(s, "gravity", "potential, uniform", 1, uniform_field(&net_weight));
    ADD(s, "drag", "force, reads v: air", 0, air_drag(&net_air));
    ADD(s, "drive", "shakes the middle knot", 0, motor(&net_shake));
}

static void net_place(const double *q, unsigned on, double (*x)[3])
{
    memcpy(x, q, sizeof(double)*3*KNOTS);
    (void)on;
}

static const double net_radius[KNOTS] = { 5, 2.5, 2.5, 2.5, 5, 2.5, 2.5, 2.5, 2.5, 2.5, 2.5, 2.5, 4, 2.5, 2.5,
                                          2.5, 2.5, 2.5, 2.5, 2.5, 5, 2.5, 2.5, 2.5, 5 };

static const scene spring_net = {
    .name = "net", .title = "Net of springs", .about = "25 knots of 10 g on threads of 100 N/m, hung by the "
    "corners. 75 coordinates. Drag the picture to turn it.", .n = 3*KNOTS, .degree = 6, .h = 0.005, .span = 0.4,
    .speed = 0.25, .time_unit = "s", .error_unit = "m", .length_unit = "m",
    .parameter = { { "dome", " m", -0.3, 0.3, 0.02, 0.1 } },
    .text = net_text, .make = "net_make();", .build = net_build,
    .bodies = KNOTS, .space = 1, .view = 0.75, .centre = { 0.4, 0.4, -0.05 }, .place = net_place,
    .rod = { { 0, 1, 5 }, { 5, 1, 5 }, { 10, 1, 5 }, { 15, 1, 5 }, { 20, 1, 5 },
             { 0, 5, 5 }, { 1, 5, 5 }, { 2, 5, 5 }, { 3, 5, 5 }, { 4, 5, 5 } },
    .radius = net_radius, .trails = 1u << 12,
};

/* ---------------------------------------------------------- charged particle */

SHOWN(charge_text,
static const gvi_real charge_mass[] = { 1 };
static const struct magnetic charge_field = { { 0, 1, 3 }, charge_mass, { 0, 0, 1 } };
static const struct uniform_field charge_electric = { { 0, 1, 3 }, charge_mass, { 0, 0.1, 0 } };
static const struct central_gravity charge_centre = { { 0, 1, 3 }, charge_mass, 0.6, { 0, 0, 0 } };
static const struct linear_drag charge_drag = { 0, 3, 0.01, 3 };
static const struct motor charge_drive = { { -1, 0 }, 0, 0.05, 1, 0 };
)

static void charge_build(scene_setup *s)
{
    s->q[0] = 1;
    s->v[1] = s->value[0];
    s->v[2] = s->value[1];
    ADD(s, "magnetic field", "Lagrangian term, reads v", 1, magnetic_field(&charge_field));
    INSTEAD(s, magnetic_force(&charge_field));
    ADD(s, "electric field", "potential, uniform", 0, uniform_field(&charge_electric));
    ADD(s, "centre", "an opposite charge, fixed", 1, central_gravity(&charge_centre));
    ADD(s, "drag", "force, reads v", 0, linear_drag(&charge_drag));
    ADD(s, "drive", "at the resonance", 0, motor(&charge_drive));
}

static void charge_place(const double *q, unsigned on, double (*x)[3])
{
    scene_point(x[0], on & 4 ? 0 : NAN, 0, 0);
    memcpy(x[1], q, sizeof x[1]);
}

static const double charge_radius[] = { 8, 6 };

static const scene charged_particle = {
    .name = "charge", .title = "Charged particle", .about = "A charge in a magnetic field along the vertical. "
    "Units in which charge, mass and field are 1.", .n = 3, .degree = 8, .h = 0.25, .span = 100, .speed = 2,
    .time_unit = "", .error_unit = "gyroradii",
    .parameter = { { "speed across", "", 0.1, 2, 0.05, 1.1 }, { "speed along", "", 0, 0.5, 0.05, 0.1 } },
    .quantity = { { "angular momentum", "electric field,drag,drive" } },
    .text = charge_text, .build = charge_build, .quantities = kepler_quantities,
    .bodies = 2, .space = 1, .view = 2.2, .place = charge_place, .radius = charge_radius, .trails = 2, .fixed = 1,
};

/* ----------------------------------------------------------------- robot arm */

SHOWN(arm_text,
static const struct two_links arm_links = { 2*0.25/3 + 1.2*0.25, 1.2*0.16/3, 1.2*0.5*0.4/2 };
static const gvi_real arm_levers[] = { (2/2.0 + 1.2)*9.81*0.5, 1.2/2*9.81*0.4 };
static const joint arm_joints[] = { { -1, 0 }, { 0, 1 } };
static const struct weights arm_weight = { 0, 2, arm_levers };
static const struct joint_friction arm_gears = { arm_joints, 2, 0.2 };
static const struct motor arm_lift = { { -1, 0 }, 8, 0, 0, 0 };
static const struct servo arm_shoulder = { { -1, 0 }, 120, 8, 1.4, 0.7, 2, 0 };
static const struct servo arm_elbow = { { 0, 1 }, 60, 3, 0.9, -0.8, 4, 0.5 };
)

static void arm_build(scene_setup *s)
{
    s->q[0] = s->value[0]/57.29577951308232;
    s->q[1] = s->value[1]/57.29577951308232;
    MASS(s, two_links(&arm_links));
    ADD(s, "gravity", "potential, in angles", 1, weights(&arm_weight));
    ADD(s, "friction", "torque, of the gears", 1, joint_friction(&arm_gears));
    ADD(s, "lift", "torque, constant", 1, motor(&arm_lift));
    ADD(s, "shoulder", "servo, swings with time", 1, servo(&arm_shoulder));
    ADD(s, "elbow", "servo, swings with time", 1, servo(&arm_elbow));
}

static void arm_place(const double *q, unsigned on, double (*x)[3])
{
    links_place(q, 0.5, 0.4, x);
    (void)on;
}

static const double arm_radius[] = { 9, 7, 5 };

static const scene robot_arm = {
    .name = "arm", .title = "Robot arm", .about = "Two links, 2 kg and 1.2 kg, with a servo in each joint; "
    "the gears rub.", .n = 2, .degree = 8, .h = 0.03, .span = 4, .speed = 1, .time_unit = "s",
    .error_unit = "rad", .length_unit = "m",
    .parameter = { { "shoulder", "\xc2\xb0", -180, 180, 5, 120 }, { "elbow", "\xc2\xb0", -180, 180, 5, 130 } },
    .quantity = { { "angular momentum", "gravity,friction,lift,shoulder,elbow" } },
    .text = arm_text, .build = arm_build, .quantities = pendulum_quantities,
    .bodies = 3, .view = 1.05, .place = arm_place, .rod = { { 0, 1, 3 } }, .radius = arm_radius,
    .trails = 4, .fixed = 1,
};

/* -- a pendulum on a spring: the shortest */

SHOWN(elastic_text,
static const gvi_real bob_mass[] = { 1 };
static const struct tether bob_spring[] = { { 0, 40, 1, { 0, 0, 0 } } };
static const struct tethers bob_springs = { { 0, 1, 2 }, bob_spring, 1, 2 };
static const struct uniform_field bob_weight = { { 0, 1, 2 }, bob_mass, { 0, -9.81 } };
static const struct air_drag bob_air = { { 0, 1, 2 }, 0.02, 2 };
)

static void elastic_build(scene_setup *s)
{
    const double a = s->value[0]/57.29577951308232;
    s->q[0] = sin(a)*s->value[1];
    s->q[1] = -cos(a)*s->value[1];
    ADD(s, "spring", "potential, 40 N/m", 1, tethers(&bob_springs));
    ADD(s, "gravity", "potential, uniform", 1, uniform_field(&bob_weight));
    ADD(s, "drag", "force, reads v: air", 0, air_drag(&bob_air));
}

static void elastic_place(const double *q, unsigned on, double (*x)[3])
{
    scene_point(x[0], 0, 0, 0);
    scene_point(x[1], q[0], q[1], 0);
    (void)on;
}

static const double elastic_radius[] = { 4, 9 };

static const scene elastic_pendulum = {
    .name = "elastic", .title = "Pendulum on a spring", .about = "1 kg on a spring of 1 m and 40 N/m.",
    .n = 2, .degree = 8, .h = 0.1, .span = 20, .speed = 1,
    .time_unit = "s", .error_unit = "m", .length_unit = "m",
    .parameter = { { "angle", "°", -170, 170, 5, 60 }, { "length", " m", 0.5, 1.6, 0.05, 1.2 } },
    .text = elastic_text, .build = elastic_build,
    .bodies = 2, .view = 1.9, .centre = { 0, -0.7, 0 }, .place = elastic_place,
    .rod = { { 0, 1, 2 } }, .radius = elastic_radius, .trails = 2, .fixed = 1,
};

/* ------------------------------------------------------ a coin that rolls: rows on velocities */

SHOWN(coin_text,
static const struct linear_drag coin_drag = { 2, 3, 0.05, 5 };
static const struct motor coin_motor = { { -1, 4 }, -0.4, 0, 0, 0 };
GVI_EACH(coin_mass, 5, mass) {
    const gvi_real c = cos(x->q[3]);
    const gvi_real s = sin(x->q[3]);
    x->mass[0] = x->mass[6] = 1;
    x->mass[12] = s*s/4 + c*c/2;
    x->mass[18] = 0.25 + c*c;
    x->mass[22] = c/2;
    x->mass[24] = 0.5;
}
GVI_EACH(coin_slope, 5, v, f) {
    const gvi_real c = cos(x->q[3]);
    const gvi_real s = sin(x->q[3]);
    const gvi_real *v = x->v;
    x->f[3] += -c*s*v[3]*v[3] + v[2]*v[2]*s*c/4 - (v[4] + c*v[2])*s*v[2]/2;
}
GVI_EACH(coin_weight, 5, f, value) {
    x->f[3] -= 9.81*cos(x->q[3]);
    x->value[0] += 9.81*sin(x->q[3]);
}
GVI_EACH(coin_rolls, 5, rows(2)) {
    const gvi_real c = cos(x->q[3]);
    const gvi_real s = sin(x->q[3]);
    gvi_real *A = x->jacobian;
    A[0] = A[6] = 1;
    A[4] = cos(x->q[2]);
    A[9] = sin(x->q[2]);
    A[2] = c*A[4];
    A[3] = -s*A[9];
    A[7] = c*A[9];
    A[8] = s*A[4];
}
)

/* The velocity of the centre from the others, so that the point on the ground is at rest   */
static void coin_build(scene_setup *s)
{
    const double a = s->value[0]/57.29577951308232;
    s->q[3] = a;
    s->v[2] = s->value[1];
    s->v[4] = s->value[2];
    s->v[0] = -(cos(a)*s->v[2] + s->v[4]);
    MASS(s, ((gvi_mass){ .kind = GVI_MASS_POSITION, .points = coin_mass, .gradient = coin_slope }));
    ADD(s, "gravity", "potential, of the tilt", 1, ((gvi_effect){ .points = coin_weight, .value = coin_weight }));
    ADD(s, "rolling", "nonholonomic, two rows", 1, ((gvi_effect){ .kind = GVI_NONHOLONOMIC, .points = coin_rolls, .rows = 2 }));
    ADD(s, "friction", "torque, reads v", 0, linear_drag(&coin_drag));
    ADD(s, "drive", "torque on the spin", 0, motor(&coin_motor));
}

/* From above: where it touches, the end of the ground's push, and the rim from a mark on   */
static void coin_place(const double *q, unsigned on, double (*x)[3])
{
    const double a = cos(q[2]), b = sin(q[2]), c = cos(q[3]), spin = fmod(q[4], 6.283185307179586);
    scene_point(x[0], q[0] + c*b, q[1] - c*a, 0);
    scene_point(x[1], on & 2 ? x[0][0] + 0.3*scene_push[0] : NAN, x[0][1] + 0.3*scene_push[1], 0);
    for (int i = 0; i <= 16; ++i) {
        const double u = cos(spin + i*0.39269908169872414), w = c*sin(spin + i*0.39269908169872414);
        scene_point(x[2+i], q[0] + u*a - w*b, q[1] + u*b + w*a, 0);
    }
}

static const double coin_radius[19] = { 4, 0, 4 };

static const scene rolling_coin = {
    .name = "coin", .title = "Rolling coin", .about = "A coin of 1 m and 1 kg, from above: two conditions on velocities "
    "keep it from slipping. The line is the ground's push. Without rolling it slides, as on ice.",
    .n = 5, .degree = 8, .h = 0.05, .span = 10, .speed = 1, .time_unit = "s", .error_unit = "m, rad", .length_unit = "m",
    .parameter = { { "tilt", "\xc2\xb0", 30, 85, 5, 60 }, { "turn", " rad/s", -3, 3, 0.1, 1.5 },
                   { "spin", " rad/s", -8, 8, 0.1, -4 } },
    .text = coin_text, .build = coin_build,
    .bodies = 19, .view = 4.6, .centre = { 0, 3.2, 0 }, .place = coin_place, .rod = { { 0, 1, 2 }, { 2, 1, 17 } },
    .radius = coin_radius, .trails = 1,
};

static const scene *const scenes[] = {
    &kepler, &figure_eight, &pythagoras, &double_pendulum, &pendulum_rods, &braced_frame,
    &spinning_top, &quaternion_top, &spring_net, &charged_particle, &robot_arm, &elastic_pendulum, &rolling_coin,
};

#endif
