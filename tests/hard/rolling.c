/* rolling.c - a million steps of what rolls: slip, energy, momenta; and coarse steps, where only symmetry keeps the energy

   A disc that falls and rises, Chaplygin's ball on a plane, a ball in a bowl and a rattleback, at degree 8: slip and rows of
   position stay at rounding.  Two things move the energy E:

     rounding    forces and velocities at a point are wrong by EPS of themselves (a dozen roundings of EPS/sqrt(12)), a step's
                 work by s = EPS sqrt(2 sum_i (h v_i)^2 (F_i^2 + C_i^2) sum_j b_j^2), C what the constraints pull.  That of N
                 steps walks, were these errors independent: 4 s sqrt(N) at most (four standard deviations), and 4 EPS E for
                 reading.  An angle x that grows (the disc's yaw) is rounded itself, by EPS x/4, and with it what reads it.
                 With 16 iterations a step that is all
     iterations  end by default where they stagnate.  What that leaves is measured in one step of 16 against the same step with
                 16 iterations; its mean, within four standard errors, has to be what the energy drifts by

   Angular momentum about the ground: forces wrong by EPS to one side, with levers of 1, sum h F EPS at most.

   Then coarse steps at degree 1 and 2.  The map is symmetric, so where the motion is reversible (v to -v) the energy's error is
   the same in each tenth of a run, of the size h^2s.  It is not symplectic: a magnetic force, which is odd in v and does no
   work, is enough for the error to wander.

     rolling [steps of the long runs, 1048576]                                                                  */
#include "hard.h"
#include "tools/body.h"

static real memory[60000], other_memory[60000];

/* ---- disc in angles, as in test_rolling.c: x, y, yaw, tilt, spin ---- */

GVI_EACH(disc_mass, 5, mass)
{
    const real c = cos(x->q[3]), s = sin(x->q[3]);
    x->mass[0] = x->mass[6] = 1;
    x->mass[12] = s*s/4 + c*c/2;
    x->mass[18] = (real)0.25 + c*c;
    x->mass[22] = c/2;
    x->mass[24] = (real)0.5;
}

GVI_EACH(disc_slope, 5, v, f)
{
    const real c = cos(x->q[3]), s = sin(x->q[3]), *v = x->v;
    x->f[3] += -c*s*v[3]*v[3] + v[2]*v[2]*s*c/4 - (v[4] + c*v[2])*s*v[2]/2;
}

GVI_EACH(disc_weight, 5, f, value)
{
    x->f[3] -= cos(x->q[3]);
    x->value[0] += sin(x->q[3]);
}

GVI_EACH(disc_rolls, 5, rows(2))
{
    const real cf = cos(x->q[2]), sf = sin(x->q[2]), c = cos(x->q[3]), s = sin(x->q[3]);
    real *A = x->jacobian, *B = A + 5;
    A[0] = 1, A[2] = c*cf, A[3] = -s*sf, A[4] = cf;
    B[1] = 1, B[2] = c*sf, B[3] = s*cf, B[4] = sf;
}

/* ---- bodies: weight along z; the bowl z = (x^2 + y^2)/2 - 1 for the centre of a ball of radius 1/4 ---- */

GVI_EACH(weight, 7, f, value)
{
    x->f[2] -= 1;
    x->value[0] += x->q[2];
}

static int bowl(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[R + k];
        x->g[k] = x->q[2*R + k] + 1 - (X*X + Y*Y)/2;
        x->jacobian[k] = -X;
        x->jacobian[R + k] = -Y;
        x->jacobian[2*R + k] = 1;
    }
    return (void)user, 0;
}

/* two directions across the normal (-X, -Y, 1): (1, 0, X), (0, 1, Y) */
static int in_the_bowl(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        real q[7], from[3];
        body_take(x, x->q, 0, 7, k, q);
        const real size = (real)0.25/sqrt(1 + q[0]*q[0] + q[1]*q[1]);
        from[0] = q[0]*size, from[1] = q[1]*size, from[2] = -size;
        for (int j = 0; j < 2; ++j) {
            const real along[3] = { j == 0, j == 1, q[j] };
            real row[7] = { 0 };
            body_contact_row(q, from, along, row);
            for (int i = 0; i < 7; ++i) x->jacobian[(j*7 + i)*x->stride + k] = row[i];
        }
    }
    return (void)user, 0;
}

/* ---- a rattleback: an ellipsoid whose axes of inertia are turned by `skew` about the upright from those of its shape */

static const real semi[3] = { 4, 1, 1 }, skew = (real)0.1;

static void ellipsoid_contact(const real *q, real *from)
{
    const real up[3] = { 0, 0, 1 }, c = cos(skew), s = sin(skew);
    real n[3], own[3], size = 0;
    body_rotate(q + 3, 1, up, n);
    const real m[3] = { c*n[0] + s*n[1], -s*n[0] + c*n[1], n[2] };
    for (int i = 0; i < 3; ++i) own[i] = -semi[i]*semi[i]*m[i], size -= own[i]*m[i];
    size = sqrt(size);
    for (int i = 0; i < 3; ++i) own[i] /= size;
    const real back[3] = { c*own[0] - s*own[1], s*own[0] + c*own[1], own[2] };
    body_rotate(q + 3, 0, back, from);
}

static int ellipsoid_rows(const gvi_points *x, int first, int count)
{
    for (int k = 0; k < x->count; ++k) {
        real q[7], from[3];
        body_take(x, x->q, 0, 7, k, q);
        ellipsoid_contact(q, from);
        if (first == 2) x->g[k] = q[2] + from[2];
        for (int j = 0; j < count; ++j) {
            const real along[3] = { first + j == 0, first + j == 1, first + j == 2 };
            real row[7] = { 0 };
            body_contact_row(q, from, along, row);
            for (int i = 0; i < 7; ++i) x->jacobian[(j*7 + i)*x->stride + k] = row[i];
        }
    }
    return 0;
}

static int ellipsoid_touches(const gvi_points *x, void *user) { return (void)user, ellipsoid_rows(x, 2, 1); }
static int ellipsoid_rolls(const gvi_points *x, void *user) { return (void)user, ellipsoid_rows(x, 0, 2); }

/* ---- what is measured ---- */

typedef struct scene {
    const char *name;
    gvi_desc    desc;
    real        q[8], v[8], h;
    int         turns;               // the coordinate that is an angle and grows, or -1
} scene;

/* the worst of the rows: g, and A v over the size of its terms, in EPS */
static double off_rows(gvi_stepper *st, gvi_kind kind)
{
    real v[8], g[8] = { 0 }, A[64], rate[8], worst = 0;
    must(gvi_velocity(st, v));
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        const gvi_effect *effect = st->in.desc.effects + e;
        if (effect->kind != kind) continue;
        memset(A, 0, sizeof A);
        memset(rate, 0, sizeof rate);
        gvi_points at = { .n = st->n, .count = 1, .stride = 1, .t = &st->t, .q = st->q, .g = g, .jacobian = A, .rate = rate };
        effect->points(&at, effect->user);
        for (int a = 0; a < effect->rows; ++a) {
            real sum = kind == GVI_CONSTRAINT ? g[a] : rate[a], size = kind == GVI_CONSTRAINT;
            for (int i = 0; kind != GVI_CONSTRAINT && i < st->n; ++i)
                sum += A[a*st->n + i]*v[i], size += fabs(A[a*st->n + i]*v[i]);
            worst = fmax(worst, fabs(sum)/(size + (real)1e-3));
        }
    }
    return (double)(worst/EPS);
}

static void begin(gvi_stepper *st, const scene *a, int iterations)
{
    gvi_desc desc = a->desc;
    desc.iterations = iterations;
    must(gvi_init(st, &desc, memory, sizeof memory));
    must(gvi_start(st, 0, a->q, a->v));
}

/* dL/dq: minus the gradient of the energy by q */
static void slope_at(gvi_stepper *st, const real *v, real *f)
{
    const gvi_desc *d = &st->in.desc;
    real value = 0;
    const gvi_points at = { .n = st->n, .count = 1, .stride = 1, .t = &st->t, .q = st->q, .f = f, .value = &value };
    gvi_points moving = at;
    memset(f, 0, (size_t)st->n*sizeof *f);
    moving.v = v;
    d->mass.gradient(&moving, d->mass.user);
    for (int e = 0; e < d->effect_count; ++e)
        if (d->effects[e].kind == GVI_POTENTIAL) d->effects[e].points(&at, d->effects[e].user);
}

/* The energy of a over that of b, two states that differ by roundings, to first order */
static double apart(gvi_stepper *a, const gvi_stepper *b)
{
    real v[8], f[8];
    long double q[2][8], p[2][8], sum = 0;
    must(gvi_velocity(a, v));
    slope_at(a, v, f);
    read_state(a, q[0], p[0]);
    read_state(b, q[1], p[1]);
    for (int i = 0; i < a->n; ++i) sum += v[i]*(p[0][i] - p[1][i]) - f[i]*(q[0][i] - q[1][i]);
    return (double)sum;
}

/* The square of a step's work's rounding: 2 sum_i (h v_i)^2 (F_i^2 + C_i^2) sum_j b_j^2, F the largest force of the step, C that
   of constraint, whose work is 0 but for rounding, h b the weights; and the push, sum_i h F_i */
static double rounding_of(gvi_stepper *st, double *push)
{
    real v[8];
    double sum = 0, weights = 0;
    *push = 0;
    must(gvi_velocity(st, v));
    for (int j = 0; j < st->r; ++j) weights += pow((double)st->in.sized.hb[j], 2);
    for (int i = 0; i < st->n; ++i) {
        double F = 0, C = 0;
        for (int j = 0; j < st->r; ++j) F = fmax(F, fabs((double)st->in.work.F[i*st->in.R + j]));
        for (int j = 0; j < st->s; ++j) C = fmax(C, fabs((double)st->in.con.force[i*st->in.R + j]));
        sum += pow((double)v[i], 2)*(F*F + C*C);
        *push += fabs((double)st->h)*F;
    }
    return 2*sum*weights;
}

/* angular momentum about the point on the ground, in space */
static void about_ground(gvi_stepper *st, const body *b, real radius, real *M)
{
    real v[7], w[3], from[3] = { 0, 0, radius }, L[3];
    must(gvi_velocity(st, v));
    body_spin(st->q + 3, v + 3, w);
    for (int i = 0; i < 3; ++i) w[i] *= b->inertia[i];
    body_rotate(st->q + 3, 0, w, L);
    body_cross(from, v, M);
    for (int i = 0; i < 3; ++i) M[i] = L[i] + b->mass*M[i];
}

/* By default, with iterations = 0, or with as many a step */
static void run(const scene *a, const body *ball, int iterations, long steps)
{
    enum { SOME = 16, ENOUGH = 16 };
    double slip = 0, rows = 0, late = 0, moment = 0, walk = 0, left = 0, square = 0, off = 0, push, pushed = 0;
    long samples = 0;
    real E0, E, M0[3] = { 0 }, M[3];
    gvi_stepper st, other;
    printf("%s, %s\n", a->name, iterations ? "16 iterations a step" : "by default");
    must(gvi_init(&other, &a->desc, other_memory, sizeof other_memory));
    begin(&st, a, iterations);
    must(gvi_energy(&st, &E0));
    if (ball) about_ground(&st, ball, 1, M0);
    for (long k = 1; k <= steps; ++k) {
        const int sample = k % SOME == 0;
        if (sample && !iterations) {
            other.in.desc.iterations = 0;
            must(gvi_restore(&other, &st, memory));
            other.in.desc.iterations = ENOUGH;
            must(gvi_step(&other, a->h));
        }
        must(gvi_step(&st, a->h));
        if (!sample) continue;
        if (!iterations) {
            const double one = apart(&st, &other)/(double)E0/(double)EPS;
            left += one, square += one*one, ++samples;
        }
        const double angle = a->turns < 0 ? 0 : (double)st.q[a->turns]/4;
        walk += SOME*rounding_of(&st, &push)*(1 + angle*angle)/(double)(E0*E0);
        pushed += SOME*push;
        must(gvi_energy(&st, &E));
        off = (double)(E/E0 - 1)/(double)EPS;
        late = fmax(late, fabs(off));
        slip = fmax(slip, off_rows(&st, GVI_NONHOLONOMIC));
        rows = fmax(rows, off_rows(&st, GVI_CONSTRAINT));
        if (ball) about_ground(&st, ball, 1, M);
        for (int i = 0; i < 3 && ball; ++i) moment = fmax(moment, fabs((double)(M[i] - M0[i]))/(double)EPS);
        if (k % 4096 == 0) progress(a->name, k, steps);
    }
    const double N = (double)steps, n = (double)samples, mean = n > 0 ? left/n : 0;
    const double error = n > 0 ? sqrt(square/n - mean*mean)*N/sqrt(n) : 0;
    printf("  iterations a step: %.2f; energy off by %.0f EPS at most\n", (double)st.counters.iterations/N, late);
    expect("largest slip, in EPS of its terms", 0, slip, 32);
    expect("rows of position, in EPS", 0, rows, 16);
    if (ball) expect("angular momentum about the ground, in EPS", 0, moment, pushed + 16);
    if (!iterations) printf("  ends of iterations leave %.5f EPS a step\n", mean);
    expect(iterations ? "energy, in EPS" : "energy less what ends of iterations leave, in EPS", -4*sqrt(walk) - 4 - 4*error,
           off - N*mean, 4*sqrt(walk) + 4 + 4*error);
}

static void million(const scene *a, const body *ball, long steps)
{
    run(a, ball, 0, steps);
    run(a, ball, 16, steps/8);
}

/* ---- coarse steps: a particle in three springs with z' = y x', in a field B (1 + x) across x and y ---- */

GVI_EACH(three_springs, 3, f, value)
{
    const real *q = x->q, z3 = q[2]*q[2]*q[2];
    x->f[0] -= q[0];
    x->f[1] -= 2*q[1];
    x->f[2] -= (real)1.5*q[2] + (real)0.3*z3;
    x->value[0] += q[0]*q[0]/2 + q[1]*q[1] + (real)0.75*q[2]*q[2] + (real)0.075*z3*q[2];
}

static int magnetic(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real field = *(const real *)user*(1 + x->q[k]);
        x->f[k] += field*x->v[R + k];
        x->f[R + k] -= field*x->v[k];
    }
    return 0;
}

GVI_EACH(contact, 3, rows(1))
{
    x->jacobian[0] = -x->q[1];
    x->jacobian[2] = 1;
}

/* the mean error of the energy in the first tenth, and the spread of the tenths' means in units of it */
static double coarse(int s, real h, real field, int rows, long steps, double *spread)
{
    const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = three_springs, .value = three_springs },
                                   { .kind = GVI_FORCE, .points = magnetic, .user = &field },
                                   { .kind = GVI_NONHOLONOMIC, .points = contact, .rows = 1 } };
    const scene a = { .desc = { .n = 3, .degree = s, .effects = effects, .effect_count = 2 + rows },
                      .q = { (real)0.5, (real)0.6, (real)0.1 }, .v = { (real)0.4, (real)0.3, (real)0.24 } };
    double mean[10] = { 0 }, lo = 0, hi = 0;
    real E0, E;
    gvi_stepper st;
    begin(&st, &a, 0);
    must(gvi_energy(&st, &E0));
    for (long k = 0; k < steps; ++k) {
        must(gvi_step(&st, h));
        must(gvi_energy(&st, &E));
        mean[k*10/steps] += 10*(double)(E - E0)/(double)steps;
    }
    for (int k = 0; k < 10; ++k) {
        lo = k ? fmin(lo, mean[k]) : mean[0];
        hi = k ? fmax(hi, mean[k]) : mean[0];
    }
    *spread = (hi - lo)/fabs(mean[0]);
    return mean[0];
}

static void symmetric(long steps)
{
    for (int s = 1; s <= 2; ++s) {
        const real h = s == 1 ? (real)0.2 : (real)0.4;
        double level[2], spread;
        printf("degree %d\n", s);
        for (int half = 0; half < 2; ++half) {
            level[half] = coarse(s, h/(real)(1 + half), 0, 1, steps, &spread);
            printf("  h = %.1f, energy off by %.3g\n", (double)h/(1 + half), level[half]);
            expect("reversible: the tenths of the run differ by, of that", 0, spread, 0.02);
        }
        expect("exponent of h", 2*s - 0.1, log(level[0]/level[1])/log(2), 2*s + 0.1);
        coarse(s, h/2, (real)0.5, 0, steps, &spread);
        expect("free, in a magnetic field", 0, spread, 0.02);
        coarse(s, h/2, (real)0.5, 1, steps, &spread);
        expect("rolling, in a magnetic field", 1, spread, 1e4);        // or this study would not see it
    }
}

int main(int argc, char **argv)
{
    const long steps = argc > 1 ? atol(argv[1]) : 1L << 20;
    static const body ball = { 2, { 0.5, 0.75, 1 } }, marble = { 1, { 0.025, 0.025, 0.025 } }, stone = { 1, { 0.4, 3.4, 3.4 } };
    static const bodies balls = { &ball, 1 }, marbles = { &marble, 1 }, stones = { &stone, 1 };
    static const body_round round = { .at = 0, .radius = 1 };
    const gvi_effect disc[] = { { .kind = GVI_POTENTIAL, .points = disc_weight, .value = disc_weight },
                                { .kind = GVI_NONHOLONOMIC, .points = disc_rolls, .rows = 2 } };
    const gvi_effect plane[] = { body_touches(&round), body_rolls(&round), body_unit(&balls) };
    const gvi_effect in_bowl[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                   { .kind = GVI_CONSTRAINT, .points = bowl, .rows = 1 },
                                   { .kind = GVI_NONHOLONOMIC, .points = in_the_bowl, .rows = 2 } };
    const gvi_effect rattle[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                  { .kind = GVI_CONSTRAINT, .points = ellipsoid_touches, .rows = 1 },
                                  { .kind = GVI_NONHOLONOMIC, .points = ellipsoid_rolls, .rows = 2 } };
    scene a = { .name = "falling disc, h = 1/16", .h = (real)0.0625, .q = { 0, 0, 0, (real)1.2, 0 }, .turns = 2,
                .desc = { .n = 5, .degree = 8, .effects = disc, .effect_count = 2,
                          .mass = { .kind = GVI_MASS_POSITION, .points = disc_mass, .gradient = disc_slope } } };
    const real tilt[] = { cos(a.q[3]), sin(a.q[3]) };
    a.v[2] = (real)0.6, a.v[3] = (real)0.1, a.v[4] = -1;
    a.v[0] = -(tilt[0]*a.v[2] + a.v[4]);
    a.v[1] = -tilt[1]*a.v[3];
    million(&a, NULL, steps);

    scene b = { .name = "Chaplygin's ball, h = 1/8", .h = (real)0.125, .q = { 0, 0, 1, 1, 0, 0, 0 }, .turns = -1,
                .desc = { .n = 7, .degree = 8, .effects = plane, .effect_count = 3, .mass = body_mass(&balls) } };
    const real w[3] = { 1, (real)-0.5, (real)0.75 };
    b.desc.mass.velocity = NULL;
    b.v[0] = w[1], b.v[1] = -w[0];
    body_turn(b.q + 3, w, b.v + 3);
    million(&b, &ball, steps);

    scene c = { .name = "ball in a bowl, h = 1/8", .h = (real)0.125, .q = { 1, 0, (real)-0.5, 1, 0, 0, 0 }, .turns = -1,
                .desc = { .n = 7, .degree = 8, .effects = in_bowl, .effect_count = 3, .mass = body_mass(&marbles) } };
    const real turn[3] = { -1, 0, 2 }, from[3] = { (real)0.25/sqrt((real)2), 0, -(real)0.25/sqrt((real)2) };
    c.desc.mass.velocity = NULL;
    body_cross(from, turn, c.v);
    body_turn(c.q + 3, turn, c.v + 3);
    million(&c, NULL, steps);

    scene d = { .name = "rattleback, h = 1/16", .h = (real)0.0625, .q = { 0, 0, 1, 1, 0, 0, 0 }, .turns = -1,
                .desc = { .n = 7, .degree = 8, .effects = rattle, .effect_count = 3, .mass = body_mass(&stones) } };
    const real spin[3] = { (real)0.01, (real)0.02, (real)0.5 };
    real at[3];
    d.desc.mass.velocity = NULL;
    ellipsoid_contact(d.q, at);
    body_cross(at, spin, d.v);
    body_turn(d.q + 3, spin, d.v + 3);
    million(&d, NULL, steps);
    symmetric(1L << 17);
    return verdict("rolling");
}
