/* Mass matrix of a double pendulum with relative angles, all lengths and masses 1:
     M = (3 + 2 cos q2, 1 + cos q2; 1 + cos q2, 1)
   for tests whose `real` is defined and which include <tgmath.h>.             */
static int pendulum_mass(const gvi_points *x, void *user)
{
    int N = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        real c = cos(x->q[N + k]);
        x->mass[0*N + k] = 3 + 2*c;
        x->mass[2*N + k] = 1 + c;
        x->mass[3*N + k] = 1;
    }
    return 0;
}

/* v' dM/dq2 v / 2; M does not depend on q1 */
static int pendulum_mass_gradient(const gvi_points *x, void *user)
{
    int N = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k)
        x->f[N + k] -= sin(x->q[N + k])*x->v[k]*(x->v[k] + x->v[N + k]);
    return 0;
}
