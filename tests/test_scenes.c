/* The scenes of examples/scenes: every one runs, its energy changes by the work
   of its forces and by nothing else, and it obeys what is known of it from
   elsewhere: closed forms, first-order theory, published periods, other methods.
   And a scene pays for what it lists: an effect that is off, or not listed, is
   not asked, takes no memory, and leaves no trace in the result.              */
#include "gvi_test.h"
#include "scenes/scenes.c"

static scene_setup made, other;
static gvi_stepper st;
static double *memory, *spare;
static const double pi = 3.14159265358979323846;

enum { ROOM = 4000000 };

static int get_memory(void **state)
{
    memory = malloc(ROOM*sizeof *memory);
    spare = malloc(ROOM*sizeof *spare);
    return memory && spare ? 0 : -1;
}

static int free_memory(void **state)
{
    free(memory);
    free(spare);
    return 0;
}

static const scene *build(const char *name, const char *without)
{
    const scene *a = scene_find(name);
    assert_non_null(a);
    scene_build(a, &made, without);
    return a;
}

static void start(void)
{
    assert_true(gvi_size(&made.desc) <= ROOM*sizeof *memory);
    assert_ok(gvi_init(&st, &made.desc, memory, ROOM*sizeof *memory));
    assert_ok(gvi_start(&st, 0, made.q, made.v));
}

static void steps(long count, double h)
{
    for (long k = 0; k < count; ++k) assert_ok(gvi_step(&st, h));
}

static void velocity(double *v) { assert_ok(gvi_velocity(&st, v)); }

/* --------------------------------------------------------- energy and balance */

typedef struct balance { double gained, missing, kinetic; } balance;

/* Runs a scene; the most that the energy changed, that it did so without work
   being done, and that the kinetic energy was.                               */
static balance run_balance(const scene *a, const char *without)
{
    balance b = { 0, 0, 0 };
    double e0, e, work[GVI_EFFECTS] = { 0 };
    build(a->name, without);
    start();
    assert_ok(gvi_energy(&st, &e0));
    for (long k = 0; k < lround(a->duration/a->h); ++k) {
        double sum = 0;
        steps(1, a->h);
        assert_ok(gvi_energy(&st, &e));
        assert_int_equal(scene_work(&st, &made, 0, work), 0);
        for (int i = 0; i < made.desc.effect_count; ++i) sum += work[i];
        b.gained = fmax(b.gained, fabs(e - e0));
        b.missing = fmax(b.missing, fabs(e - e0 - sum));
        b.kinetic = fmax(b.kinetic, e - scene_potential(&made, 0, st.t, st.q));
    }
    return b;
}

/* All forces of a scene, for leaving them out.                                */
static int list_forces(const scene *a, char *names, size_t size)
{
    int count = 0;
    build(a->name, NULL);
    names[0] = 0;
    for (int e = 0; e < made.desc.effect_count; ++e) {
        if (made.effects[e].kind != GVI_FORCE) continue;
        if (count++) strncat(names, ",", size - strlen(names) - 1);
        strncat(names, made.names[e], size - strlen(names) - 1);
    }
    return count;
}

/* Over its whole duration each scene keeps its energy, or changes it by the work
   of its forces, to rounding: 1e-12 of the kinetic energy, in 80 to 16384 steps. */
TEST(test_energy_balance)
{
    char names[256];
    int forced = 0;
    for (int i = 0; i < scene_count; ++i) {
        const balance b = run_balance(scenes[i], NULL);
        assert_true(b.kinetic > 0);
        const int forces = list_forces(scenes[i], names, sizeof names);
        print_message("  %-20s gained %8.1e  not accounted for %8.1e\n", scenes[i]->name,
                      b.gained/b.kinetic, b.missing/b.kinetic);
        assert_true(b.missing <= 1e-12*b.kinetic);
        if (forces) assert_true(b.gained > 0.01*b.kinetic);
        else assert_true(b.gained <= 5e-14*b.kinetic);
        forced += forces > 0;
    }
    assert_int_equal(scene_count, 14);
    assert_int_equal(forced, 7);
}

/* Without its forces every scene is conservative.                             */
TEST(test_energy_without_forces)
{
    char names[256];
    for (int i = 0; i < scene_count; ++i) {
        if (!list_forces(scenes[i], names, sizeof names)) continue;
        const balance b = run_balance(scenes[i], names);
        print_message("  %-20s without %s: kept to %.1e\n", scenes[i]->name, names, b.gained/b.kinetic);
        assert_true(b.kinetic > 0 && b.gained <= 1e-10*b.kinetic);
        assert_true(b.missing == b.gained);
    }
}

/* What the scenes say they conserve, in units of the momentum or angular momentum
   that there is; the satellite without its air.                              */
TEST(test_conserved_quantities)
{
    int seen = 0;
    for (int i = 0; i < scene_count; ++i) {
        const scene *a = scenes[i];
        double v[SCENE_MAX], first[SCENE_CURVES], now[SCENE_CURVES], size = 0, reach = 1;
        if (!a->quantities) continue;
        build(a->name, "air");
        start();
        velocity(v);
        a->quantities(st.q, v, st.p, first);
        for (int j = 0; j < st.n; ++j) size += fabs(st.p[j]), reach = fmax(reach, fabs(st.q[j]));
        size *= reach;
        for (int k = 0; k < 80; ++k) {
            steps(1, a->h);
            velocity(v);
            a->quantities(st.q, v, st.p, now);
            for (int j = 0; j < SCENE_CURVES && a->conserved[j]; ++j, ++seen)
                assert_close(now[j], first[j], 1e-14*size);
        }
    }
    assert_int_equal(seen, 80*9);
}

/* ------------------------------------------------------------- the sky's laws */

/* Against the 25-digit end state of examples/outer_solar_system_reference.txt. */
static double solar_system_error(int degree)
{
    char line[512], name[16];
    double q[3], m, v, worst = 0;
    int body = 0;
    FILE *file = fopen("examples/outer_solar_system_reference.txt", "r");
    assert_non_null(file);
    build("outer_solar_system", NULL);
    made.desc.degree = degree;
    start();
    steps(1000, 200);
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%15s %lf %lf %lf %lf %lf", name, &m, q, q + 1, q + 2, &v) != 6) continue;
        for (int c = 0; c < 3; ++c) worst = fmax(worst, fabs(st.q[3*body+c] - q[c]));
        ++body;
    }
    fclose(file);
    assert_int_equal(body, 6);
    return worst;
}

TEST(test_solar_system_against_reference)
{
    assert_between(0, solar_system_error(8), 1e-11);
    assert_between(1e-7, solar_system_error(4), 1e-3);
}

static void cross(const double *a, const double *b, double *c)
{
    for (int i = 0; i < 3; ++i) c[i] = a[(i+1)%3]*b[(i+2)%3] - a[(i+2)%3]*b[(i+1)%3];
}

static double dot(const double *a, const double *b) { return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]; }

/* Node and argument of perigee of the orbit through (q, v).                   */
static void orbit_angles(double mu, const double *q, const double *v, double *angle)
{
    double h[3], e[3], across[3], r = sqrt(dot(q, q));
    cross(q, v, h);
    cross(v, h, e);
    for (int i = 0; i < 3; ++i) e[i] = e[i]/mu - q[i]/r;
    const double node[3] = { -h[1], h[0], 0 };
    cross(h, node, across);
    angle[0] = atan2(node[1], node[0]);
    angle[1] = atan2(dot(e, across)/sqrt(dot(across, across)), dot(e, node)/sqrt(dot(node, node)));
}

/* Rates of both over 100 orbits, by least squares.                            */
static void orbit_rates(double j2, double *rate)
{
    enum { COUNT_ = 2400 };
    const double mu = 398600.4418, a = (6378.137 + 380)/0.94, period = 2*pi*sqrt(a*a*a/mu);
    double v[3], angle[2], last[2] = { 0, 0 }, x[2] = { 0, 0 }, xt[2] = { 0, 0 }, t = 0, tt = 0;
    const double was = satellite_bulge.j2;
    satellite_bulge.j2 = j2;
    build("satellite", "air");
    start();
    for (int k = 0; k < COUNT_; ++k) {
        steps(1, period/24);
        velocity(v);
        orbit_angles(mu, st.q, v, angle);
        for (int i = 0; i < 2; ++i) {
            last[i] += remainder(angle[i] - last[i], 2*pi);
            x[i] += last[i];
            xt[i] += last[i]*st.t;
        }
        t += st.t;
        tt += st.t*st.t;
    }
    for (int i = 0; i < 2; ++i) rate[i] = (COUNT_*xt[i] - t*x[i])/(COUNT_*tt - t*t);
    satellite_bulge.j2 = was;
}

/* Precession of node and perigee against first-order theory: they differ by a
   relative O(J2), so ten times less for a tenth of J2.                        */
TEST(test_oblateness_turns_the_orbit)
{
    const double e = 0.06, a = (6378.137 + 380)/(1 - e), n = sqrt(398600.4418/(a*a*a)), c = cos(50*pi/180);
    const double per_j2 = n*pow(6378.137/(a*(1 - e*e)), 2), j2 = 1.08262668e-3;
    const double theory[2] = { -1.5*per_j2*c, 0.75*per_j2*(5*c*c - 1) };
    double whole[2], tenth[2];
    orbit_rates(j2, whole);
    orbit_rates(j2/10, tenth);
    for (int i = 0; i < 2; ++i) {
        const double far = whole[i]/(theory[i]*j2) - 1, near = tenth[i]/(theory[i]*j2/10) - 1;
        print_message("  %s: off first order by %.2e, with J2/10 by %.2e\n",
                      i ? "perigee" : "node", far, near);
        assert_between(1e-3, fabs(far), 1e-2);
        assert_between(7, far/near, 14);
    }
}

/* On a circle, drag c v^2 lets sqrt(a) shrink at the rate c sqrt(gm), to first
   order in c (energy -gm/2a, power -c v^3).                                   */
static double decay(double c)
{
    static const double mass[3] = { 1, 1, 1 };
    const struct central_gravity sun = { { 0, 1, 2 }, mass, 1, { 0, 0, 0 } };
    const struct air_drag air = { { 0, 1, 2 }, c, 0 };
    const gvi_effect both[] = { central_gravity(&sun), air_drag(&air) };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = both, .effect_count = 2 };
    double e;
    assert_ok(gvi_init(&st, &desc, memory, ROOM*sizeof *memory));
    assert_ok(gvi_start(&st, 0, (double[]){ 1, 0 }, (double[]){ 0, 1 }));
    steps(1000, 2*pi/10);
    assert_ok(gvi_energy(&st, &e));
    return (1 - sqrt(-1/(2*e)))/(c*st.t);
}

TEST(test_air_drag_lowers_the_orbit)
{
    assert_between(0.999, decay(1e-5), 1.001);
    assert_between(0.99999, decay(1e-7), 1.00001);
}

/* The three bodies come back after Simo's period, and after a third of it each
   stands where another began; to the 8 digits that the data have.            */
TEST(test_figure_eight_period)
{
    const double period = 6.32591398;
    double v[6], miss = 0, far = 0, along = 0, speed = 0;
    build("figure_eight", NULL);
    start();
    steps(20, period/60);
    for (int i = 0; i < 6; ++i) miss = fmax(miss, fabs(st.q[i] - made.q[(i + 4) % 6]));
    assert_between(1e-10, miss, 1e-7);
    steps(40, period/60);
    velocity(v);
    for (int i = 0; i < 6; ++i) {
        far = fmax(far, fabs(st.q[i] - made.q[i]));
        along += (made.q[i] - st.q[i])*v[i];
        speed += v[i]*v[i];
    }
    print_message("  closes to %.1e; period %.9f\n", far, period + along/speed);
    assert_between(1e-10, far, 1e-7);
    assert_close(period + along/speed, period, 5e-8);
}

/* Arenstorf's orbit closes, though a perturbation of its start grows 1e4-fold.  */
TEST(test_arenstorf_closes)
{
    const scene *a = build("arenstorf", NULL);
    double nudged;
    start();
    steps(16384, a->h);
    assert_close(st.q[0], made.q[0], 1e-11);
    assert_close(st.q[1], 0, 1e-11);
    made.q[0] += 1e-10;
    start();
    steps(16384, a->h);
    nudged = hypot(st.q[0] - made.q[0], st.q[1]);
    assert_between(1e-8, nudged, 1e-4);
}

/* -------------------------------------------------------- pendulums and tops */

/* Small swings take 2 pi sqrt(l/g), small bounces 2 pi sqrt(m/k): half of it.   */
static double period_of(int coordinate, double from, double centre)
{
    double before, first = 0;
    int crossings = 0;
    build("elastic_pendulum", NULL);
    made.q[0] = 0;
    made.q[1] = -1;
    made.q[coordinate] += from;
    start();
    while (crossings < 21) {
        before = st.q[coordinate] - centre;
        steps(1, 0.05);
        if ((before > 0) == (st.q[coordinate] - centre > 0)) continue;
        double lo = st.t - 0.05, hi = st.t, q[2];
        for (int k = 0; k < 50; ++k) {
            assert_ok(gvi_state_at(&st, (lo + hi)/2, q, NULL, NULL));
            if ((q[coordinate] - centre > 0) == (before > 0)) lo = (lo + hi)/2;
            else hi = (lo + hi)/2;
        }
        if (crossings++ == 0) first = lo;
        else if (crossings == 21) return (lo - first)/10;
    }
    return 0;
}

TEST(test_elastic_pendulum_periods)
{
    assert_close(period_of(0, 1e-4, 0), 2*pi*sqrt(1/9.81), 2e-8);
    assert_close(period_of(1, 1e-4, -1), 2*pi*sqrt(1/(4*9.81)), 1e-11);     // bounces without swing: linear

    // in resonance the energy goes over from bounce to swing, and back
    double v[2], curve[2], least = 1, most = 0, last = 0;
    const scene *a = build("elastic_pendulum", NULL);
    start();
    for (int k = 0; k < 190; ++k) {
        steps(1, a->h);
        velocity(v);
        elastic_pendulum_curves(st.q, v, curve);
        last = curve[1]/(curve[0] + curve[1]);
        if (k < 120) least = fmin(least, last);
        else most = fmax(most, last);
    }
    assert_between(0, least, 0.05);
    assert_between(0.9, most, 1);
}

/* Steady precession: across w^2 cos a - along spin w + m g l = 0, two rates.    */
TEST(test_top_precesses_steadily)
{
    const double across = 2e-4, along = 8e-5, lever = 0.1*9.81*0.04, spin = 150, c = cos(0.5), b = along*spin;
    for (int fast = 0; fast < 2; ++fast) {
        const double root = sqrt(b*b - 4*across*lever*c), w = (b + (fast ? root : -root))/(2*across*c);
        build("lagrange_top", NULL);
        made.v[1] = w;
        made.v[2] = spin - w*c;
        start();
        for (int k = 0; k < 400; ++k) {
            steps(1, 0.005);
            assert_close(st.q[0], 0.5, 1e-13);
            assert_close(st.q[1], w*st.t, 1e-13*w*st.t + 1e-15);
        }
        assert_close(w, fast ? 64.926 : 3.443, 1e-3);

        // 0.1 % faster it nods: the law is not met by any rate
        made.v[1] = 1.001*w;
        start();
        double most = 0;
        for (int k = 0; k < 100; ++k) {
            steps(1, 0.005);
            most = fmax(most, fabs(st.q[0] - 0.5));
        }
        assert_true(most > 1e-5);
    }
}

/* Two links by Newton and Euler: accelerations of the angles from the balance of
   torques about both joints, each link with mass, centre and inertia.  Written
   for angles from the vertical, solved by Cramer's rule, integrated by the
   classical Runge-Kutta method: nothing of this is in gvi.h or effects.h.      */
typedef struct links { double m1, m2, l1, c1, c2, i1, i2, friction; int arm; } links;

static void link_rates(const links *p, double t, const double *x, double *dx)
{
    const double g = 9.81, d = x[0] - x[1], relative = x[3] - x[2];
    const double a11 = p->i1 + p->m1*p->c1*p->c1 + p->m2*p->l1*p->l1, a12 = p->m2*p->l1*p->c2*cos(d);
    const double a22 = p->i2 + p->m2*p->c2*p->c2;
    double shoulder = 8*cos(2.4*t) - p->friction*x[2], elbow = -p->friction*relative;
    if (p->arm) {
        shoulder = 8 - p->friction*x[2] + 120*(1.4 + 0.7*cos(2*t) - x[0]) + 8*(-1.4*sin(2*t) - x[2]);
        elbow += 60*(0.9 - 0.8*cos(4*t + 0.5) - (x[1] - x[0])) + 3*(3.2*sin(4*t + 0.5) - relative);
    }
    const double whirl = p->m2*p->l1*p->c2*sin(d);
    const double b1 = shoulder - elbow - (p->m1*p->c1 + p->m2*p->l1)*g*sin(x[0]) - whirl*x[3]*x[3];
    const double b2 = elbow - p->m2*p->c2*g*sin(x[1]) + whirl*x[2]*x[2];
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = (b1*a22 - b2*a12)/(a11*a22 - a12*a12);
    dx[3] = (b2*a11 - b1*a12)/(a11*a22 - a12*a12);
}

static void runge_kutta(const links *p, double t, double h, double *x)
{
    double k[4][4], y[4];
    for (int s = 0; s < 4; ++s) {
        const double part = s == 0 ? 0 : s == 3 ? h : h/2;
        for (int i = 0; i < 4; ++i) y[i] = x[i] + (s ? part*k[s-1][i] : 0);
        link_rates(p, t + part, y, k[s]);
    }
    for (int i = 0; i < 4; ++i) x[i] += h*(k[0][i] + 2*k[1][i] + 2*k[2][i] + k[3][i])/6;
}

static void check_links(const char *name, const links *p, double until)
{
    const scene *a = build(name, NULL);
    double x[4] = { made.q[0], made.q[1], made.v[0], made.v[1] }, v[2];
    const long count = lround(until/a->h);
    start();
    steps(count, a->h);
    for (long k = 0; k < 64*count; ++k) runge_kutta(p, a->h/64*(double)k, a->h/64, x);
    velocity(v);
    for (int i = 0; i < 2; ++i) {
        assert_close(st.q[i], x[i], 1e-9);
        assert_close(v[i], x[i+2], 1e-8);
    }
}

TEST(test_links_by_newton_and_euler)
{
    const links pendulum = { 1, 1, 1, 1, 1, 0, 0, 0.05, 0 };
    const links arm = { 2, 1.2, 0.5, 0.25, 0.2, 2*0.25/12, 1.2*0.16/12, 0.2, 1 };
    check_links("double_pendulum", &pendulum, 3);
    check_links("robot_arm", &arm, 4);
}

/* -------------------------------------------------------------- other fields */

/* In crossed fields the motion is a circle that drifts by E/B: known in closed
   form for the speed relative to the drift.                                  */
TEST(test_crossed_fields_drift)
{
    const scene *a = build("crossed_fields", NULL);
    const double E = 100, B = 0.01, rate = 1.602176634e-19*B/1.67262192369e-27, drift = E/B;
    start();
    for (int k = 0; k < 100; ++k) {
        steps(1, a->h);
        const double u = -2e4 - drift, w = rate*st.t;         // u: speed against the drift at first
        assert_close(st.q[0], drift*st.t + u*sin(w)/rate, 1e-14);
        assert_close(st.q[1], u*(cos(w) - 1)/rate, 1e-14);
        assert_close(st.q[2], 3e3*st.t, 1e-15);
    }
    assert_close(drift, 1e4, 1e-9);

    // after whole turns, whatever the step: displacement over time
    start();
    steps(64, 8*2*pi/rate/64);
    assert_close(st.q[0]/st.t, E/B, 1e-8);
    assert_close(st.q[1], 0, 1e-14);
}

/* Largest share of energy in mode 1 between 100 and 170 of its periods, and when. */
static double recurrence(int degree, gvi_rule_kind rule, double h, double *share)
{
    const double period = 64.02570931921777;                              // pi/sin(pi/64)
    double v[FPUT_BONDS], when = 0;
    build("fput", NULL);
    made.desc.degree = degree;
    made.desc.rule.kind = rule;
    start();
    const double first = fput_mode(made.q, made.v, 1);
    *share = 0;
    while (st.t < 170*period) {
        steps(1, h);
        if (st.t < 100*period) continue;
        velocity(v);
        const double now = fput_mode(st.q, v, 1)/first;
        if (now > *share) *share = now, when = st.t/period;
    }
    return when;
}

/* The energy of the FPUT chain returns after 146.4 periods of mode 1.  The 157 of
   the literature belong to the step of the report itself, leapfrog with h^2 = 1/8,
   whose error weakens the dispersion by 1/8 and so delays the return by
   sqrt(8/7) = 1.069; Stoermer-Verlet is that method.                          */
TEST(test_fput_recurrence)
{
    double share, exact = recurrence(6, GVI_GAUSS, 1, &share), leapfrog, fine;
    assert_between(0.975, share, 0.985);
    assert_between(146, exact, 147);
    leapfrog = recurrence(1, GVI_LOBATTO, sqrt(1/8.0), &share);
    assert_int_equal(st.formulation, GVI_EXPLICIT);
    print_message("  exact %.2f periods, with the step of the report %.2f\n", exact, leapfrog);
    assert_between(156, leapfrog, 158);
    assert_between(0.97, share, 0.985);
    assert_close(leapfrog/exact, sqrt(8/7.0), 0.005);
    fine = recurrence(1, GVI_LOBATTO, sqrt(1/512.0), &share);
    assert_close(fine, exact, 0.5);

    // in between it was elsewhere
    double v[FPUT_BONDS], least = 1;
    build("fput", NULL);
    start();
    const double first = fput_mode(made.q, made.v, 1);
    for (int k = 0; k < 100*64; ++k) {
        steps(1, 1);
        velocity(v);
        least = fmin(least, fput_mode(st.q, v, 1)/first);
    }
    assert_between(0.01, least, 0.15);
}

/* Duffing's oscillator settles to as many periods of the drive as the book says;
   for F = 0.5 to none.  The map is taken once a period of the drive.          */
TEST(test_duffing_attractors)
{
    static const struct { double strength; int periods; } known[] = {
        { 0.2, 1 }, { 0.28, 2 }, { 0.29, 4 }, { 0.37, 5 }, { 0.65, 2 }, { 0.5, 0 } };
    const double h = 2*pi/1.2/32;
    for (int i = 0; i < COUNT(known); ++i) {
        double x[40], y[40], v;
        build("duffing", NULL);
        duffing_drive.b = known[i].strength;
        start();
        steps(32*600, h);
        for (int k = 0; k < 40; ++k, steps(32, h)) {
            velocity(&v);
            x[k] = st.q[0], y[k] = v;
        }
        for (int p = 1; p <= 12; ++p) {
            double miss = 0;
            for (int k = 0; k < 20; ++k) miss = fmax(miss, hypot(x[k+p] - x[k], y[k+p] - y[k]));
            if (known[i].periods && p % known[i].periods == 0) assert_true(miss < 1e-10);
            else assert_true(miss > 0.05);
        }
    }
}

/* A net on no hooks and in no air: its centre falls freely, it does not start to
   turn; and the hooks, once all has come to rest, carry its weight.           */
TEST(test_net)
{
    double v[SCENE_MAX], centre = 0, turn[2] = { 0, 0 }, e0, e1;
    build("net", "hooks,air");
    for (int i = 0; i < NET_KNOTS; ++i) centre += made.q[3*i+2]/NET_KNOTS;
    start();
    for (int k = 0; k < 200; ++k) {
        double z = 0, x = 0;
        steps(1, 0.005);
        for (int i = 0; i < NET_KNOTS; ++i) z += st.q[3*i+2]/NET_KNOTS, x += st.q[3*i]/NET_KNOTS;
        assert_close(z, centre - 9.81*st.t*st.t/2, 2e-14);
        assert_close(x, 0.35, 1e-14);
    }
    scene_momenta(NET_KNOTS, 3, st.q, st.p, turn);
    assert_close(turn[0], 0, 1e-15);
    assert_close(turn[1], 0, 1e-15);

    // oil instead of air brings it to rest within seconds; pinned, since near rest
    // rounding is all that is left to judge a contraction by
    const struct linear_drag oil = { 0, 3*NET_KNOTS, 0.05, 0 };
    build("net", "air");
    scene_add(&made, "oil", linear_drag(&oil));
    made.desc.formulation = GVI_VELOCITIES;
    start();
    assert_ok(gvi_energy(&st, &e0));
    steps(2000, 0.005);
    velocity(v);
    for (int i = 0; i < 3*NET_KNOTS; ++i) assert_close(v[i], 0, 1e-9);
    double f[3*NET_KNOTS] = { 0 }, pull = 0;
    const gvi_points x = { .n = 3*NET_KNOTS, .count = 1, .stride = 1, .q = st.q, .f = f };
    const gvi_effect *hooks = &made.effects[scene_effect(&made, "hooks")];
    assert_int_equal(hooks->points(&x, hooks->user), 0);
    for (int i = 0; i < NET_KNOTS; ++i) pull += f[3*i+2];
    assert_close(pull, 64*0.005*9.81, 1e-9);

    // what it lost is what oil takes, and it hangs as symmetrically as it started
    assert_ok(gvi_energy(&st, &e1));
    assert_true(e1 < e0 - 0.1);
    for (int i = 0; i < NET_KNOTS; ++i) assert_close(st.q[3*i+2], st.q[3*(NET_KNOTS-1-i)+2], 1e-9);
}

/* ------------------------------------------------------- pay for what is listed */

/* Runs `count` steps of scene a with effect e switched off (in st) and not listed
   (in bare); the two steppers stay for comparison.  Do both have the same
   formulation, as chosen from the list?                                      */
static int off_and_unlisted(const scene *a, int e, long count, gvi_stepper *bare)
{
    const char *name;
    build(a->name, NULL);
    name = made.names[e];
    scene_build(a, &other, name);
    assert_int_equal(other.desc.effect_count, made.desc.effect_count - 1);
    assert_int_equal(scene_effect(&other, name), -1);
    assert_ok(gvi_init(&st, &made.desc, memory, ROOM*sizeof *memory));
    assert_ok(gvi_switch(&st, e, 0));
    assert_ok(gvi_start(&st, 0, made.q, made.v));
    assert_ok(gvi_init(bare, &other.desc, spare, ROOM*sizeof *spare));
    assert_ok(gvi_start(bare, 0, other.q, other.v));
    const int same = st.formulation == bare->formulation;
    for (long k = 0; k < count; ++k) {
        assert_ok(gvi_step(&st, a->h));
        assert_ok(gvi_step(bare, a->h));
    }
    return same;
}

/* Off is as if it were not listed: not one evaluation, and the same work and the
   same bits as long as the formulation is the same.  Where it was the effect that
   asked for velocities, the formulation differs, both steppers say so, and the
   results agree as two ways of computing the same numbers do.                */
TEST(test_off_is_unlisted)
{
    static gvi_stepper bare;
    int same = 0;
    char changed[256] = "";
    for (int i = 0; i < scene_count; ++i) {
        build(scenes[i]->name, NULL);
        for (int e = 0, count = made.desc.effect_count; e < count; ++e) {
            const int alike = off_and_unlisted(scenes[i], e, 40, &bare);
            assert_true(st.counters.effect[e] == 0);
            if (alike) {
                ++same;
                assert_memory_equal(st.q, bare.q, (size_t)st.n*sizeof *st.q);
                assert_memory_equal(st.p, bare.p, (size_t)st.n*sizeof *st.p);
                assert_true(st.counters.iterations == bare.counters.iterations);
                assert_true(st.counters.newton_iterations == bare.counters.newton_iterations);
                for (int k = 0; k < other.desc.effect_count; ++k)
                    assert_true(st.counters.effect[k < e ? k : k + 1] == bare.counters.effect[k]);
                continue;
            }
            snprintf(changed + strlen(changed), sizeof changed - strlen(changed), "%s:%s ", scenes[i]->name,
                     made.names[e]);
            assert_int_equal(st.formulation, GVI_VELOCITIES);
            assert_int_equal(bare.formulation, GVI_POSITIONS);
            assert_string_not_equal(gvi_formulation_text(&st), gvi_formulation_text(&bare));
            for (int k = 0; k < st.n; ++k) assert_close(st.q[k], bare.q[k], 1e-11*(1e-3 + fabs(bare.q[k])));
        }
    }
    assert_string_equal(changed, "satellite:air arenstorf:frame net:air crossed_fields:magnetic hanging_chain:air "
                                 "peaucellier:bearings ");
    assert_int_equal(same, 29);
}

/* Off and on again between steps: its counter stands still while it is off, and
   the others' does not.                                                      */
TEST(test_switching_between_steps)
{
    unsigned long long before[GVI_EFFECTS];
    for (int i = 0; i < scene_count; ++i) {
        build(scenes[i]->name, NULL);
        for (int e = 0; e < made.desc.effect_count; ++e) {
            if (made.effects[e].kind == GVI_CONSTRAINT) continue;       // the way back is not open
            start();
            for (int part = 0; part < 3; ++part) {
                memcpy(before, st.counters.effect, sizeof before);
                assert_ok(gvi_switch(&st, e, part != 1));
                steps(4, scenes[i]->h/2);
                for (int k = 0; k < made.desc.effect_count; ++k)
                    assert_true((st.counters.effect[k] > before[k]) == (k != e || part != 1));
            }
        }
    }
}

/* Bytes: a net without "air" takes as many as a net written down by someone who
   never heard of drag, and its counters are the same; with it, more.           */
TEST(test_unlisted_costs_nothing)
{
    build("net", NULL);
    const size_t with_air = gvi_size(&made.desc);
    const gvi_effect plain[] = { uniform_field(&net_weight), springs(&net_threads), tethers(&net_hooks) };
    const gvi_desc desc = { .n = 3*NET_KNOTS, .degree = 6, .effects = plain, .effect_count = 3,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = net_mass } };
    static gvi_stepper bare;
    build("net", "air");
    assert_true(gvi_size(&made.desc) == gvi_size(&desc));
    assert_true(gvi_size(&desc) < with_air);
    start();
    assert_ok(gvi_init(&bare, &desc, spare, gvi_size(&desc)));
    assert_ok(gvi_start(&bare, 0, made.q, made.v));
    steps(50, 0.005);
    for (int k = 0; k < 50; ++k) assert_ok(gvi_step(&bare, 0.005));
    assert_memory_equal(st.q, bare.q, (size_t)st.n*sizeof *st.q);
    assert_memory_equal(&st.counters, &bare.counters, sizeof st.counters);

    // the same with a pinned formulation, where it is the rows of velocities that go
    build("satellite", "air");
    made.desc.formulation = GVI_POSITIONS;
    const size_t without = gvi_size(&made.desc);
    build("satellite", NULL);
    made.desc.formulation = GVI_VELOCITIES;
    assert_true(without < gvi_size(&made.desc));
    assert_true(gvi_formulation_text(&st) != NULL && st.formulation == GVI_POSITIONS);
}

/* The names on the command line and in `without` mean what they say.           */
TEST(test_lists)
{
    assert_true(scene_lists("air,hooks", "air") && scene_lists("air,hooks", "hooks"));
    assert_false(scene_lists("air,hooks", "hook"));
    assert_false(scene_lists("airy", "air"));
    assert_false(scene_lists("", "air"));
    assert_false(scene_lists(NULL, "air"));
    assert_null(scene_find("no such scene"));
    build("net", "threads,air");
    assert_int_equal(made.desc.effect_count, 2);
    assert_int_equal(scene_effect(&made, "hooks"), 1);
    for (int i = 0; i < scene_count; ++i) {
        scene_build(scenes[i], &made, NULL);
        assert_true(scenes[i]->n <= SCENE_MAX && scenes[i]->points <= SCENE_BODIES);
        assert_true(made.desc.effect_count > 0);
        assert_ptr_equal(scene_find(scenes[i]->name), scenes[i]);
    }
}

RUN_TESTS(get_memory, free_memory)
