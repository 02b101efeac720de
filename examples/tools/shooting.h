/* shooting.h - which start leads to the end that is wanted? For gvi.h; needs tangent.h

   Newton's method on the map from m unknown numbers at the start to m equations at the
   end. The unknowns are the directions of a tangent scene, dq and dp: the start moves by
   sum_j x_j (dq_j, dp_j). The scene gives the end and its derivative along each of them,
   by one run, and so a run is an iteration:

     c(q, p) = 0        M_ij = dc_i/d(q, p) . column j        start -= sum_j (M^-1 c)_j (dq_j, dp_j)

   end      with dq == NULL gives the m equations c at (q, p); else their derivative
            along (dq, dp), which is linear in these
   units    each equation is done when |c_i| <= tolerance: scale it so that this makes sense.
            One more correction follows, without a run: what is left is about its square
   errors   GVI_E_CONVERGENCE after `most` runs, GVI_E_SINGULAR where the end does not
            depend on some combination of the unknowns, GVI_E_NON_FINITE where c, M or the
            next start is not finite, or what a step ends with; q and p then are the last
            start. GVI_E_ARGUMENT: a NULL, no unknowns, steps below 0
   limits   no damping: from far off, move the end in parts (35_swing_up.c)

   Source: multiple-shooting textbooks, with one interval; Stoer and Bulirsch, 7.3.1.   */
#ifndef SHOOTING_H
#define SHOOTING_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "tangent.h"

typedef void shooting_fn(const gvi_real *q, const gvi_real *p, const gvi_real *dq, const gvi_real *dp,
                         gvi_real *c, void *user);

typedef struct shooting {
    const tangent  *scene;       /* after tangent_scene; its directions are the unknowns */
    const gvi_real *dq, *dp;     /* [m][n] the directions; NULL: as in tangent_start    */
    gvi_real        t, h;        /* steps of h from t on                                */
    int             steps;
    shooting_fn    *end;
    void           *user;        /* handed to end                                       */
    gvi_real        tolerance;
    int             most;        /* runs                                                */
    gvi_real       *room;        /* [SHOOTING_ROOM(n, m)]                               */
} shooting;

#define SHOOTING_ROOM(n, m) ((size_t)(m)*((size_t)(m) + 3) + 1 + 2*(size_t)(n))

/* Corrects q and p, [n] the start, so that the end is as wanted.  st: from gvi_init for
   the scene's desc.                                                            */
static inline gvi_status shoot(const shooting *S, gvi_stepper *st, gvi_real *q, gvi_real *p)
{
    if (!S || !S->scene || !S->end || !S->room || S->steps < 0 || !st || !q || !p) return GVI_E_ARGUMENT;
    const int n = S->scene->plain.n, m = S->scene->directions;
    gvi_real *M = S->room, *c = M + m*m, *column = c + m, *pivot = column + m;
    gvi_real *dq = pivot + m + 1, *dp = dq + n;
    for (int run = 0; run < S->most; ++run) {
        int done = 1;
        if (tangent_start(S->scene, st, S->t, q, p, S->dq, S->dp)) return st->status;
        for (int k = 0; k < S->steps; ++k)
            if (gvi_step(st, S->h)) return st->status;
        S->end(st->q, st->p, NULL, NULL, c, S->user);
        for (int j = 0; j < m; ++j) {
            tangent_column(S->scene, st, j, dq, dp);
            S->end(st->q, st->p, dq, dp, column, S->user);
            for (int i = 0; i < m; ++i) M[i*m + j] = column[i];
            done = done && c[j] <= S->tolerance && -c[j] <= S->tolerance;
        }
        const gvi_status status = gvi_lu_factor(m, M, pivot);
        if (status) return status;
        gvi_lu_solve(m, M, pivot, c);
        for (int i = 0; i < n; ++i) {
            dq[i] = q[i], dp[i] = p[i];
            for (int j = 0; j < m; ++j) {
                dq[i] -= (S->dq ? S->dq[j*n + i] : (gvi_real)(i == j))*c[j];
                dp[i] -= (S->dp ? S->dp[j*n + i] : (gvi_real)(i + n == j))*c[j];
            }
        }
        for (int i = 0; i < 2*n; ++i)                          // as where c is not
            if (!(dq[i] - dq[i] >= 0)) return GVI_E_NON_FINITE;
        for (int i = 0; i < n; ++i) q[i] = dq[i], p[i] = dp[i];
        if (done) return GVI_OK;
    }
    return GVI_E_CONVERGENCE;
}

#endif
