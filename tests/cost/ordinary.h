/* ordinary.h - problems of `make cost` with callbacks as a user writes them: libm, no vectors by hand

   Toda's lattice, Arenstorf's orbit, a magnetic bottle, seven atoms, relativistic Kepler; and P1, P4, P5
   once more.  One formula for one point serves the rivals, and by GVI_POINTS gvi.h.  Included by problems.c.
   References: tests/gen/references.c.                                                         */
#define ACCELERATED(name, n, acceleration)                          \
    GVI_POINTS(name, n, f)(const gvi_points *x, void *user)         \
    {                                                               \
        double a[n];                                                \
        acceleration(x->q, a);                                      \
        GVI_UNROLL for (int i = 0; i < (n); ++i) x->f[i] += a[i];     \
        return (void)user, 0;                                       \
    }

/* ------------------------------------------------------ P1, P4, P5 again */

INLINE void plain_kepler_acceleration(const double *q, double *a)
{
    const double d2 = q[0]*q[0] + q[1]*q[1], w = -1/(d2*GVI_SQRT(d2));
    a[0] = w*q[0];
    a[1] = w*q[1];
}
ACCELERATED(plain_kepler, 2, plain_kepler_acceleration)

static void plain_solar_acceleration(const double *q, double *a)
{
    for (int i = 0; i < 18; ++i) a[i] = 0;
    for (int i = 1; i < 6; ++i)
        for (int j = 0; j < i; ++j) {
            const double x = q[3*j] - q[3*i], y = q[3*j+1] - q[3*i+1], z = q[3*j+2] - q[3*i+2];
            const double d2 = x*x + y*y + z*z, w = 1/(d2*GVI_SQRT(d2)), to = gm[j]*w, from = gm[i]*w;
            a[3*i] += to*x;  a[3*i+1] += to*y;  a[3*i+2] += to*z;
            a[3*j] -= from*x;  a[3*j+1] -= from*y;  a[3*j+2] -= from*z;
        }
}

GVI_POINTS(plain_solar, 18, f)(const gvi_points *x, void *user)
{
    GVI_UNROLL for (int i = 1; i < 6; ++i)
        GVI_UNROLL for (int j = 0; j < i; ++j) {
            const double *a = x->q + 3*i, *c = x->q + 3*j, u = c[0] - a[0], v = c[1] - a[1], w = c[2] - a[2];
            const double r2 = u*u + v*v + w*w, s = gm[i]*gm[j]/(r2*GVI_SQRT(r2));
            double *f = x->f + 3*i, *g = x->f + 3*j;
            f[0] += s*u;  f[1] += s*v;  f[2] += s*w;
            g[0] -= s*u;  g[1] -= s*v;  g[2] -= s*w;
        }
    return (void)user, 0;
}

static void plain_pendulum_slope(const double *y, double *dy)
{
    const double c = cos(y[0] - y[1]), s = sin(y[0] - y[1]), d = 1/(1 + s*s);
    const double u = (y[2] - c*y[3])*d, v = (2*y[3] - c*y[2])*d, f = s*u*v;
    dy[0] = u;
    dy[1] = v;
    dy[2] = -2*G*sin(y[0]) - f;
    dy[3] = f - G*sin(y[1]);
}

static void plain_pendulum_law(const double *q, const double *v, double *a)
{
    const double s[2] = { sin(q[0]), sin(q[1]) };
    pendulum_accelerate(s, cos(q[0] - q[1]), sin(q[0] - q[1]), v, a);
}

GVI_POINTS(plain_pendulum_mass, 2, mass)(const gvi_points *x, void *user)
{
    x->mass[0] = 2;
    x->mass[2] = cos(x->q[0] - x->q[1]);
    x->mass[3] = 1;
    return (void)user, 0;
}

GVI_POINTS(plain_pendulum_gradient, 2, v, f)(const gvi_points *x, void *user)
{
    const double w = sin(x->q[0] - x->q[1])*x->v[0]*x->v[1];
    x->f[0] -= w;
    x->f[1] += w;
    return (void)user, 0;
}

GVI_POINTS(plain_pendulum_weight, 2, f)(const gvi_points *x, void *user)
{
    x->f[0] -= 2*G*sin(x->q[0]);
    x->f[1] -= G*sin(x->q[1]);
    return (void)user, 0;
}

/* --------------------------------------------------------- Toda's lattice */

/* V = sum exp(q_i - q_(i+1)), a ring of 16                                                    */
static const double toda_q[16] = { 0 }, toda_v[16] = { 1, -0.5, 0.25, 0, 0.5, -1, 0.75, 0, -0.25, 0.5, -0.75, 0, 0, 0.25, -0.5, -0.25 };

INLINE void toda_acceleration(const double *q, double *a)
{
    double before = exp(q[15] - q[0]);
    for (int i = 0; i < 16; ++i) {
        const double next = exp(q[i] - q[(i + 1)%16]);
        a[i] = before - next;
        before = next;
    }
}
ACCELERATED(toda, 16, toda_acceleration)

static long double toda_energy(const double *q, const double *v)
{
    long double e = 0;
    for (int i = 0; i < 16; ++i) e += (long double)v[i]*v[i]/2 + expl((long double)q[i] - q[(i + 1)%16]);
    return e;
}

/* ------------------------------------------------------------ seven atoms */

/* Lennard and Jones, V = sum 4 (r^-12 - r^-6), in a plane: one in the middle, six around it   */
static const double atoms_q[14] = { 0, 0, 1.12, 0.02, 0.55, 0.98, -0.56, 0.97, -1.11, 0.01, -0.57, -0.96, 0.56, -0.98 },
                    atoms_v[14] = { 0.1, -0.2, -0.3, 0.1, 0.2, 0.2, -0.1, -0.3, 0.3, 0.1, -0.2, 0.2, 0, -0.1 };

INLINE void atoms_acceleration(const double *q, double *a)
{
    GVI_UNROLL for (int i = 0; i < 14; ++i) a[i] = 0;
    GVI_UNROLL for (int i = 1; i < 7; ++i)
        GVI_UNROLL for (int j = 0; j < i; ++j) {
            const double x = q[2*i] - q[2*j], y = q[2*i+1] - q[2*j+1], u = 1/(x*x + y*y), u3 = u*u*u;
            const double w = (48*u3 - 24)*u3*u;
            a[2*i] += w*x;
            a[2*i+1] += w*y;
            a[2*j] -= w*x;
            a[2*j+1] -= w*y;
        }
}
ACCELERATED(atoms, 14, atoms_acceleration)

static long double atoms_energy(const double *q, const double *v)
{
    long double e = 0;
    for (int i = 0; i < 14; ++i) e += (long double)v[i]*v[i]/2;
    for (int i = 1; i < 7; ++i)
        for (int j = 0; j < i; ++j) {
            const long double x = (long double)q[2*i] - q[2*j], y = (long double)q[2*i+1] - q[2*j+1], u = 1/(x*x + y*y), u3 = u*u*u;
            e += 4*(u3*u3 - u3);
        }
    return e;
}

/* -------------------------------------------------------- Arenstorf's orbit */

/* The plane turns with Earth and Moon: L = |v|^2/2 + x v_y - y v_x + (x^2 + y^2)/2 - V; p = (v_x - y, v_y + x) */
#define MOON 0.012277471
static const double arenstorf_q[] = { 0.994, 0 }, arenstorf_p[] = { 0, 0.994 - 2.0015851063790825 };

INLINE void arenstorf_pull(const double *q, double *f)
{
    const double x = q[0] + MOON, z = q[0] - (1 - MOON), y = q[1], d = x*x + y*y, e = z*z + y*y;
    const double earth = (1 - MOON)/(d*GVI_SQRT(d)), moon = MOON/(e*GVI_SQRT(e));
    f[0] = -earth*x - moon*z;
    f[1] = -earth*y - moon*y;
}
ACCELERATED(arenstorf, 2, arenstorf_pull)

GVI_POINTS(turning, 2, v, f, dldv)(const gvi_points *x, void *user)
{
    x->f[0] += x->v[1] + x->q[0];
    x->f[1] += x->q[1] - x->v[0];
    x->dldv[0] -= x->q[1];
    x->dldv[1] += x->q[0];
    return (void)user, 0;
}

static void arenstorf_slope(const double *y, double *dy)
{
    double f[2];
    arenstorf_pull(y, f);
    dy[0] = y[2] + y[1];
    dy[1] = y[3] - y[0];
    dy[2] = f[0] + y[3];
    dy[3] = f[1] - y[2];
}

static void arenstorf_law(const double *q, const double *v, double *a)
{
    arenstorf_pull(q, a);
    a[0] += q[0] + 2*v[1];
    a[1] += q[1] - 2*v[0];
}

static void arenstorf_momentum(const double *q, const double *v, double *p)
{
    const double u = v[0], w = v[1];
    p[0] = u - q[1];
    p[1] = w + q[0];
}

static long double arenstorf_energy(const double *q, const double *p)
{
    const long double x = q[0], y = q[1], u = p[0], v = p[1], m = MOON;
    return (u*u + v*v)/2 + u*y - v*x - (1 - m)/hypotl(x + m, y) - m/hypotl(x - (1 - m), y);
}

/* ---------------------------------------------------------- magnetic bottle */

/* f = v x B, B = (-x z, -y z, 10 + z^2 - (x^2 + y^2)/2)/10                                    */
static const double bottle_q[] = { 0.5, 0, 0 }, bottle_v[] = { 0, 0.5, 0.25 };

INLINE void bottle_force(const double *q, const double *v, double *f)
{
    const double bx = -0.1*q[0]*q[2], by = -0.1*q[1]*q[2], bz = 1 + 0.1*(q[2]*q[2] - (q[0]*q[0] + q[1]*q[1])/2);
    f[0] = v[1]*bz - v[2]*by;
    f[1] = v[2]*bx - v[0]*bz;
    f[2] = v[0]*by - v[1]*bx;
}

GVI_POINTS(bottle, 3, v, f)(const gvi_points *x, void *user)
{
    double f[3];
    bottle_force(x->q, x->v, f);
    x->f[0] += f[0];
    x->f[1] += f[1];
    x->f[2] += f[2];
    return (void)user, 0;
}

static void bottle_slope(const double *y, double *dy)
{
    for (int i = 0; i < 3; ++i) dy[i] = y[3+i];
    bottle_force(y, y + 3, dy + 3);
}

static void bottle_law(const double *q, const double *v, double *a) { bottle_force(q, v, a); }

static long double bottle_energy(const double *q, const double *v)
{
    return (void)q, ((long double)v[0]*v[0] + (long double)v[1]*v[1] + (long double)v[2]*v[2])/2;
}

/* ----------------------------------------------------- relativistic Kepler */

/* L = -c^2 GVI_SQRT(1 - v^2/c^2) + 1/|q|, c = 5: v = p/GVI_SQRT(1 + p^2/c^2); the ellipse turns by 5 degrees a revolution */
static const double relativistic_p[] = { 0, 2 };

GVI_POINTS(relativistic_term, 2, v, f, dldv)(const gvi_points *x, void *user)
{
    const double w = 1/GVI_SQRT(1 - (x->v[0]*x->v[0] + x->v[1]*x->v[1])/25);
    x->dldv[0] += w*x->v[0];
    x->dldv[1] += w*x->v[1];
    return (void)user, 0;
}

GVI_POINTS(relativistic_velocity, 2, p, velocity)(const gvi_points *x, void *user)
{
    const double w = 1/GVI_SQRT(1 + (x->p[0]*x->p[0] + x->p[1]*x->p[1])/25);
    x->velocity[0] = w*x->p[0];
    x->velocity[1] = w*x->p[1];
    return (void)user, 0;
}

static void relativistic_slope(const double *y, double *dy)
{
    const double w = 1/GVI_SQRT(1 + (y[2]*y[2] + y[3]*y[3])/25);
    dy[0] = w*y[2];
    dy[1] = w*y[3];
    plain_kepler_acceleration(y, dy + 2);
}

/* d(w v)/dt = f: a = (f - v (v f)/25)/w, w = 1/sqrt(1 - v^2/25)                               */
static void relativistic_law(const double *q, const double *v, double *a)
{
    double f[2];
    plain_kepler_acceleration(q, f);
    const double root = sqrt(1 - (v[0]*v[0] + v[1]*v[1])/25), s = (v[0]*f[0] + v[1]*f[1])/25;
    a[0] = root*(f[0] - s*v[0]);
    a[1] = root*(f[1] - s*v[1]);
}

static void relativistic_momentum(const double *q, const double *v, double *p)
{
    const double u = v[0], x = v[1], w = 1/sqrt(1 - (u*u + x*x)/25);
    p[0] = w*u;
    p[1] = w*x;
}

static long double relativistic_energy(const double *q, const double *p)
{
    const long double x = q[0], y = q[1], u = p[0], v = p[1];
    return 25*(sqrtl(1 + (u*u + v*v)/25) - 1) - 1/sqrtl(x*x + y*y);
}

static const gvi_effect plain_kepler_scene[] = { { .kind = GVI_POTENTIAL, .points = plain_kepler } };
static const gvi_effect plain_solar_scene[] = { { .kind = GVI_POTENTIAL, .points = plain_solar } };
static const gvi_effect plain_pendulum_scene[] = { { .kind = GVI_POTENTIAL, .points = plain_pendulum_weight } };
static const gvi_effect toda_scene[] = { { .kind = GVI_POTENTIAL, .points = toda } };
static const gvi_effect atoms_scene[] = { { .kind = GVI_POTENTIAL, .points = atoms } };
static const gvi_effect arenstorf_scene[] = { { .kind = GVI_POTENTIAL, .points = arenstorf },
                                              { .kind = GVI_LAGRANGIAN, .points = turning } };
static const gvi_effect bottle_scene[] = { { .kind = GVI_FORCE, .points = bottle } };
static const gvi_effect relativistic_scene[] = { { .kind = GVI_POTENTIAL, .points = plain_kepler },
                                                 { .kind = GVI_LAGRANGIAN, .points = relativistic_term } };
