/* encounters.h - problems of `make cost` whose steps must change, and a rope: callbacks as a user writes them

   Comets of eccentricity 0.99 and 0.9999, Burrau's three bodies, a flyby; five balls on four rods, thrown.
   References: tests/gen/references.c and tests/gen/pythagorean.c. Included by problems.c.        */

/* ------------------------------------------------------- comets, a flyby */

/* From far to far: a comet begins and ends at its aphelion, half-axis 1; the flyby comes in at speed 1 from a distance
   of 100, with 0.2 between the asymptote and the centre, and ends as far away.                  */
static const double comet2_q[] = { -1.99, 0 }, comet2_v[] = { 0, -0.070888120500833 };
static const double comet4_q[] = { -1.9999, 0 }, comet4_v[] = { 0, -0.0070712445851 };
static const double flyby_q[] = { -100, 0.2 }, flyby_v[] = { 1.01, 0 };

/* ------------------------------------------------------ three bodies */

/* Masses 3, 4, 5 at rest at the corners of a triangle of sides 3, 4, 5 [Burrau 1913]            */
static const double burrau_q[] = { 1, 3, -2, -1, 1, -1 }, burrau_v[6] = { 0 }, burrau_mass[] = { 3, 3, 4, 4, 5, 5 };

INLINE void burrau_forces(const double *q, double *f)
{
    UNROLL for (int i = 0; i < 6; ++i) f[i] = 0;
    UNROLL for (int i = 1; i < 3; ++i)
        UNROLL for (int j = 0; j < i; ++j) {
            const double x = q[2*j] - q[2*i], y = q[2*j+1] - q[2*i+1], d2 = x*x + y*y;
            const double w = burrau_mass[2*i]*burrau_mass[2*j]/(d2*sqrt(d2));
            f[2*i] += w*x;
            f[2*i+1] += w*y;
            f[2*j] -= w*x;
            f[2*j+1] -= w*y;
        }
}
ACCELERATED(burrau, 6, burrau_forces)

static void burrau_acceleration(const double *q, double *a)
{
    burrau_forces(q, a);
    UNROLL for (int i = 0; i < 6; ++i) a[i] *= 1/burrau_mass[i];
}

static long double burrau_energy(const double *q, const double *v)
{
    long double e = 0;
    for (int i = 0; i < 6; ++i) e += burrau_mass[i]*v[i]*(long double)v[i]/2;
    for (int i = 1; i < 3; ++i)
        for (int j = 0; j < i; ++j)
            e -= burrau_mass[2*i]*burrau_mass[2*j]/hypotl((long double)q[2*i] - q[2*j], (long double)q[2*i+1] - q[2*j+1]);
    return e;
}

/* ------------------------------------------------------------- a rope */

/* Five balls of mass 1 on four rods of length 1, which begin in a line and tumble freely in the plane */
enum { BALLS = 5, RODS_OF_ROPE = BALLS - 1, ROPE = 2*BALLS };
static const double rope_q[ROPE] = { -2, 0, -1, 0, 0, 0, 1, 0, 2, 0 };
static const double rope_v[ROPE] = { 0, -2, 0, -1.2, 0, 0.2, 0, 1, 0, 2 };

GVI_POINTS(rods_of_rope, ROPE, rows(RODS_OF_ROPE))(const gvi_points *x, void *user)
{
    for (int a = 0; a < RODS_OF_ROPE; ++a) {
        const double u = x->q[2*a+2] - x->q[2*a], w = x->q[2*a+3] - x->q[2*a+1];
        double *row = x->jacobian + ROPE*a + 2*a;
        x->g[a] = (u*u + w*w - 1)/2;
        row[0] = -u;
        row[1] = -w;
        row[2] = u;
        row[3] = w;
    }
    return (void)user, 0;
}

/* The equations of index 1: G G' lambda = -|rates|^2, a tridiagonal matrix of the rods d; q'' = G' lambda.
   Rods 0 and BALLS are of length 0.                                                            */
static void rope_law(const double *q, const double *v, double *a)
{
    double d[BALLS+1][2] = { { 0 } }, beside[BALLS+1] = { 0 }, over[BALLS+1] = { 0 }, lambda[BALLS+1] = { 0 };
    for (int i = 1; i < BALLS; ++i) {
        const double u = v[2*i] - v[2*i-2], w = v[2*i+1] - v[2*i-1];
        d[i][0] = q[2*i] - q[2*i-2];
        d[i][1] = q[2*i+1] - q[2*i-1];
        beside[i] = -(d[i][0]*d[i-1][0] + d[i][1]*d[i-1][1]);
        const double factor = beside[i]*over[i-1];
        over[i] = 1/(2*(d[i][0]*d[i][0] + d[i][1]*d[i][1]) - factor*beside[i]);
        lambda[i] = -(u*u + w*w) - factor*lambda[i-1];
    }
    for (int i = BALLS - 1; i > 0; --i) lambda[i] = (lambda[i] - beside[i+1]*lambda[i+1])*over[i];
    for (int i = 0; i < BALLS; ++i)
        for (int k = 0; k < 2; ++k) a[2*i+k] = lambda[i]*d[i][k] - lambda[i+1]*d[i+1][k];
}

static void rope_slope(const double *y, double *dy)
{
    for (int i = 0; i < ROPE; ++i) dy[i] = y[ROPE+i];
    rope_law(y, y + ROPE, dy + ROPE);
}

static long double rope_energy(const double *q, const double *v)
{
    long double e = 0;
    for (int i = 0; i < ROPE; ++i) e += (long double)v[i]*v[i]/2;
    return (void)q, e;
}

static const gvi_effect burrau_scene[] = { { .kind = GVI_POTENTIAL, .points = burrau } };
static const gvi_effect rope_scene[] = { { .kind = GVI_CONSTRAINT, .points = rods_of_rope, .rows = RODS_OF_ROPE } };
