/* gvi.h - v0.1.0 - Galerkin variational integrators for mechanical systems
   SPDX-License-Identifier: MIT OR Unlicense              (texts at the end)

   Integrates M q'' = -dV/dq + f, or any Lagrangian L(t,q,v) with forces
   f(t,q,v), in steps that keep momentum maps exactly, are symplectic, and do
   not let the energy of a conservative system drift.  The order is
   min(2s, u): polynomials of degree s, a quadrature rule of order u.  One
   file, C99 or C++11, no dependency but libm, no heap, no globals.

   In ONE source file:          #define GVI_IMPLEMENTATION
                                #include "gvi.h"
   In all others:               #include "gvi.h"


   SYNOPSIS

   A planet on an ellipse of eccentricity 0.6, for 100 revolutions:

     #define GVI_IMPLEMENTATION
     #include "gvi.h"
     #include <math.h>
     #include <stdio.h>

     static int attraction(const gvi_points *x, void *user)
     {
         const double *X = x->q, *Y = X + x->stride;
         double *fx = x->f, *fy = fx + x->stride;
         for (int k = 0; k < x->count; ++k) {
             double d2 = X[k]*X[k] + Y[k]*Y[k], w = -1/(d2*sqrt(d2));
             fx[k] += w*X[k];  fy[k] += w*Y[k];
         }
         return (void)user, 0;
     }

     int main(void)
     {
         static double memory[GVI_LENGTH(2, 8, 8)];
         const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
         const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 };
         gvi_stepper st;
         gvi_init(&st, &desc, memory, sizeof memory);
         gvi_start(&st, 0, (double[]){ 0.4, 0 }, (double[]){ 0, 2 });
         for (int k = 0; k < 4000 && st.status == GVI_OK; ++k)
             gvi_step(&st, 3.14159265358979323846/20);
         printf("%s: q = %.9f %.9f\n", gvi_status_text(st.status), st.q[0], st.q[1]);
     }

   prints

     ok: q = 0.400000000 -0.000000000

   Adding drag is one more row in effects[].  Taking it out again takes its
   whole cost away.


   CONTENTS             (search for the names)

     CONVENTIONS          memory, threads, errors, arrays, units, rounding
     OPTIONS              the macros
     HOW IT WORKS         the method in 70 lines, with the notation
     TYPES                effects, mass, rule, description, stepper
     FUNCTIONS            stepper first, then the building blocks
     -- implementation, a course in seven lessons --
     SUPPORT              real functions, twofold arithmetic
     DENSE LU
     QUADRATURE           Gauss and Lobatto nodes, order of a rule
     INTERPOLATION        barycentric
     SCENE                asking the effects, Legendre transform
     TABLES               what the rule and the degree have to say
     STEPPER: SET-UP      the choice of a formulation, the memory
     STEPPER: STEP        explicit, fixed point, Newton
     QUERIES              velocity, energy, curve, discrete Lagrangian
     LICENCE


   CONVENTIONS

   memory     Nothing is allocated, ever.  The caller hands gvi_init one array
              and keeps it as long as the stepper is used; there is nothing to
              free.  The stepper points into that array, never into itself: it
              may be moved.  Copy of stepper and array = checkpoint.
   threads    No mutable static data.  Different steppers are independent.
   errors     0 (GVI_OK) or a negative gvi_status; also kept in st->status,
              with st->fault naming the effect, coordinate and point.  A call
              that fails leaves t, q, p, the last curve and everything that
              the queries read bit for bit as they were: halve h and go on.
   arrays     Row-major, A[i*n + j].  Values of one coordinate at the points
              of a step are contiguous: coordinate i at point k is
              [i*stride + k].  Inputs are const.  Arrays of one call do not
              overlap unless it is said that they may.
   units      None: time, lengths and masses are the caller's, and no
              tolerance or test of the library depends on them.
   rounding   Round to nearest, subnormals kept; -ffast-math is refused.
              q, p and t carry compensation terms, so 1e9 steps of t + h are
              as exact as one.  Same bits on every IEEE machine when compiled
              with -ffp-contract=off and the callbacks give the same bits.
   work       A step evaluates each effect at most max_iterations*(r+1) times
              r points in the fixed point, plus, where Newton is used, 2n+1
              times r points for each of at most max_iterations/4 + 2 Jacobians,
              and the same again once when a value was not finite, to name the
              effect.  Nothing in it waits for anything else.

   gvi.h does not: choose or adapt the step, treat constraints or contact,
   run in parallel, or read or write anything.


   OPTIONS

     GVI_IMPLEMENTATION  [one file]    the code, besides the declarations
     GVI_STATIC          [that file]   everything static: private copy
     GVI_REAL            [everywhere]  float, double (default), long double
     GVI_EFFECTS         [everywhere]  most effects a scene may list: 16, to 32
*/
/* ------------------------------------------------------------- HOW IT WORKS

   A mechanical system moves so that its action, the integral of L(t, q, q'),
   is stationary.  A variational integrator approximates the action, not the
   equation of motion [1]; whatever the step does is then stationary action
   again, which is why symmetry means exact momentum and why the map is
   symplectic.  The Galerkin kind [2] takes

     curve        q(t0 + h tau) = q0 + h sum_k Phi_k(tau) y_k     0 <= tau <= 1
                  k = 0..s-1, phi_k = Legendre polynomial P_k(2 tau - 1),
                  Phi_k(tau) = integral of phi_k from 0 to tau
     quadrature   nodes c_i, weights b_i, i = 1..r, of order u on [0,1]
     at the nodes Q_i = q0 + h sum_k Phi_k(c_i) y_k      V_i = sum_k phi_k(c_i) y_k
                  t_i = t0 + c_i h
                  F_i = dL/dq + f     P_i = dL/dv        at (t_i, Q_i, V_i)

   A polynomial of degree s through q0, by its velocity's Legendre modes y_k:
   the same curves as with control points [2, sec. 2.2], but well conditioned
   at any degree, and with ends that are simply q0 and q1 = q0 + h y_0.  The
   action h sum_i b_i L(t_i, Q_i, V_i) is stationary, with the forces acting
   by the Lagrange-d'Alembert principle, when for k = 0..s-1

     sum_i b_i phi_k(c_i) P_i  =  [k=0] p0 + h sum_i b_i W_k(c_i) F_i       (1)
                 W_k(tau) = [k=0] - Phi_k(tau) = integral of phi_k from tau to 1
     p1 = p0 + h sum_i b_i F_i                                              (2)

   (1) gives y from (q0, p0), then q1 = q0 + h y_0 and (2) end the step.  With
   y_0 = (q1 - q0)/h known and p0 unknown, the rows k >= 1 of (1) are the
   boundary-value problem of the discrete Lagrangian L_d(q0, q1).

   Constant mass.  P_i = M V_i turns (1) into y = Gamma^-1 (...) with the s*s
   matrix Gamma_kl = sum_i b_i phi_k(c_i) phi_l(c_i), which is 1/(2k+1) on the
   diagonal if u >= 2s - 1.  Put into Q and V,

     Q_i = q0 + h c_i v0 + h M^-1 sum_j (c_i - S_ij) h b_j F_j              (3)
     V_i = v0 + M^-1 sum_j (1 - T_ij) h b_j F_j                             (4)
     S = Phi Gamma^-1 Phi'      T = phi Gamma^-1 Phi'      N = phi Gamma^-1 phi'

   so for effects that read only q the unknowns are the forces: put F in, get
   Q out, ask the effects at all r points at once, repeat.  No velocity, no
   matrix.  S is symmetric: that is what symplecticity asks of (3), and it
   survives rounding, since S and c are rounded to one grid.

   r = s.  Then V_i is free at each node, Gamma^-1 phi' diag(b) = phi^-1, and
   (1) is the partitioned Runge-Kutta method

     Q_i = q0 + sum_j T_ji h b_j V_j       P_i = p0 + sum_j (1 - T_ij) h b_j F_j   (5)

   with V_i from dL/dv(Q_i, V_i) = P_i: Gauss collocation for Gauss nodes, the
   Lobatto IIIA-IIIB pair for Lobatto's [3, II.1, VI.6], [4].

   FORMULATIONS.  One step, five ways to find it; the scene decides which:

     explicit     s = 1, Lobatto 2, constant mass, effects read only t and q:
                  Stoermer-Verlet, one evaluation a step, no iteration
     positions    constant mass, effects read only t and q: (3) as fixed point
     velocities   constant mass, any effects: (3) and (4) as fixed point
     momenta      M(q), or velocity from momentum given, and r = s: (5)
     Newton       anything: (1) by Newton's method, dense LU of size s*n

   The fixed points contract like (h omega)^2 or h omega; where they do not,
   GVI_AUTO goes over to Newton.  All solve the same equations, and all stop
   at round-off.

   Order.  |q1 - exact| = O(h^(min(2s,u)+1)) a step: twice the degree, which
   is the superconvergence theorem [2, thm. 4.1].  The curve in between is
   less exact, min(s, u/2) + 1 in the maximum norm [2, sec. 5].  r < s cannot
   work: the kinetic term would not see every mode.

   NOTATION       n degrees of freedom   s degree   r points   h step
                  q, v, p, t, F, P, V, Q, c, b, S, T, N   as above
   REFERENCES
   [1] Marsden, West: Discrete mechanics and variational integrators, 2001
   [2] Ober-Bloebaum, Vermeeren: Superconvergence of Galerkin variational
       integrators, 2021
   [3] Hairer, Lubich, Wanner: Geometric numerical integration, 2nd ed., 2006
   [4] Ober-Bloebaum: Galerkin variational integrators and modified symplectic
       Runge-Kutta methods, IMA J. Numer. Anal. 37, 2017
   [5] Antonana, Makazaga, Murua: Reducing and monitoring round-off error
       propagation for symplectic implicit Runge-Kutta schemes, 2017
   [6] Berrut, Trefethen: Barycentric Lagrange interpolation, SIAM Rev. 46, 2004
   [7] Higham: Accuracy and stability of numerical algorithms, 2nd ed., 2002  */

#ifndef GVI_H
#define GVI_H

#include <stddef.h>

#define GVI_VERSION "0.1.0"

#ifndef GVI_REAL
#define GVI_REAL double
#endif
/* The preprocessor must see which type it is: paste the first word on a prefix.
   For "long double" that leaves (1 || double), which is true unevaluated.   */
#define GVI__PASTE2(a, b) a##b
#define GVI__PASTE(a, b) GVI__PASTE2(a, b)
#define GVI__LONG_float  0
#define GVI__LONG_double 0
#define GVI__LONG_long   1 ||
#define GVI__KIND_float  1
#define GVI__KIND_double 2
#if GVI__PASTE(GVI__LONG_, GVI_REAL)
#define GVI__KIND 3
#elif GVI__PASTE(GVI__KIND_, GVI_REAL) == 1
#define GVI__KIND 1
#elif GVI__PASTE(GVI__KIND_, GVI_REAL) == 2
#define GVI__KIND 2
#else
#error "GVI_REAL must be float, double or long double"
#endif

#ifndef GVI_EFFECTS
#define GVI_EFFECTS 16
#endif

#ifdef GVI_STATIC
#if defined(__GNUC__)
#define GVI_DEF static __attribute__((unused))
#else
#define GVI_DEF static
#endif
#else
#define GVI_DEF extern
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ----------------------------------------------------------------- TYPES */

typedef GVI_REAL gvi_real;

typedef enum gvi_status {
    GVI_OK            =  0,
    GVI_E_ARGUMENT    = -1,  /* null pointer, size out of range, h = 0, NaN or Inf given */
    GVI_E_MEMORY      = -2,  /* the memory is smaller than gvi_size(desc)               */
    GVI_E_NODES       = -3,  /* own rule: a node outside [0,1], or two that coincide    */
    GVI_E_ORDER       = -4,  /* own rule: the weights do not sum to 1 (order 0)         */
    GVI_E_POINTS      = -5,  /* r < s, or a rule that does not see every mode           */
    GVI_E_FORMULATION = -6,  /* the pinned formulation does not cover this scene        */
    GVI_E_SINGULAR    = -7,  /* singular matrix: massless coordinate (fault.coordinate) */
    GVI_E_CONVERGENCE = -8,  /* the iteration did not converge: h too large             */
    GVI_E_CALLBACK    = -9,  /* a callback refused (fault.effect)                       */
    GVI_E_NON_FINITE  = -10, /* NaN or Inf came out of an effect (fault.effect)         */
    GVI_E_VALUE       = -11, /* energy or action wanted, but fault.effect has no value  */
    GVI_E_STATE       = -12, /* not started; no step yet; time outside the last step    */
    GVI_E_CONJUGATE   = -13  /* boundary values do not determine the curve              */
} gvi_status;

/* What a callback gets: `count` points.  Coordinate i of point k is at
   [i*stride + k].  Inputs that the callback's kind may not read, and outputs
   that are not its to give, are NULL.  Outputs are ADDED to (f, dldv, value)
   or WRITTEN (mass, velocity); they do not overlap the inputs or each other. */
typedef struct gvi_points {
    int             n;         /* degrees of freedom                           */
    int             count;     /* points in this call, >= 1                    */
    int             stride;    /* distance of two coordinates, >= count        */
    const gvi_real *t;         /* [count]   time                               */
    const gvi_real *q;         /* [n][count] configuration                     */
    const gvi_real *v;         /* [n][count] velocity; NULL for a potential    */
    const gvi_real *p;         /* [n][count] momentum; for mass.velocity only  */
    gvi_real       *f;         /* [n][count] add dL/dq: -dV/dq or the force    */
    gvi_real       *dldv;      /* [n][count] add dL/dv; Lagrangian terms only  */
    gvi_real       *value;     /* [count]    add V, or L of a Lagrangian term  */
    gvi_real       *mass;      /* [n*n][count] write M_ij, i >= j, row i*n + j */
    gvi_real       *velocity;  /* [n][count] write v                           */
} gvi_points;

/* All points at once.  Returns 0, or anything else for "cannot be evaluated
   here", which ends the step with GVI_E_CALLBACK.                           */
typedef int gvi_points_fn(const gvi_points *x, void *user);

/* One point: q, v, f, dldv of length n; v is NULL for a potential, dldv for
   anything but a Lagrangian term.  Adds to f and dldv.  Returns as above.    */
typedef int gvi_point_fn(gvi_real t, const gvi_real *q, const gvi_real *v,
                         gvi_real *f, gvi_real *dldv, void *user);

/* Second derivatives at one point, n*n row-major, added to:
   fq[i*n+j] += d f_i/d q_j     fv[i*n+j] += d f_i/d v_j      (f as above)
   pv[i*n+j] += d (dL/dv_i)/d v_j
   fv and pv are NULL for a potential, pv for a force.                        */
typedef int gvi_hessian_fn(gvi_real t, const gvi_real *q, const gvi_real *v,
                           gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user);

typedef enum gvi_kind {
    GVI_POTENTIAL  = 0,  /* V(t,q):   reads t, q;    adds -dV/dq to f              */
    GVI_FORCE      = 1,  /* f(t,q,v): reads t, q, v; adds f to f                   */
    GVI_LAGRANGIAN = 2   /* L(t,q,v): reads t, q, v; adds dL/dq to f, dL/dv to dldv */
} gvi_kind;

/* One thing that acts in a scene.  Give one of points and point.             */
typedef struct gvi_effect {
    gvi_kind        kind;
    gvi_points_fn  *points;   /* the effect at all points of a step at once     */
    gvi_point_fn   *point;    /* or one point a call                            */
    gvi_points_fn  *value;    /* V or L, for energy and action; NULL: unknown   */
    gvi_hessian_fn *hessian;  /* for Newton; NULL: differences of f and dldv    */
    void           *user;     /* handed to the callbacks                        */
} gvi_effect;

typedef enum gvi_mass_kind {
    GVI_MASS_UNIT     = 0,  /* kinetic energy v'v/2                             */
    GVI_MASS_DIAGONAL = 1,  /* sum m_i v_i^2/2, matrix = m, length n            */
    GVI_MASS_DENSE    = 2,  /* v'Mv/2, matrix = M, n*n, its lower triangle read */
    GVI_MASS_POSITION = 3,  /* v'M(q)v/2, by points and gradient                */
    GVI_MASS_NONE     = 4   /* all of it comes from Lagrangian terms            */
} gvi_mass_kind;

/* The kinetic energy.  M must be definite.  matrix is read by gvi_init only.  */
typedef struct gvi_mass {
    gvi_mass_kind   kind;
    const gvi_real *matrix;
    gvi_points_fn  *points;    /* GVI_MASS_POSITION: writes x->mass from x->q   */
    gvi_points_fn  *gradient;  /* and adds v' dM/dq v / 2 to x->f, called after
                                  points at the same x->q                     */
    gvi_points_fn  *velocity;  /* optional: writes x->velocity, the v at which
                                  dL/dv(t,q,v) = p, L being ALL of the scene   */
    void           *user;
} gvi_mass;

typedef enum gvi_rule_kind {
    GVI_GAUSS   = 0,   /* order 2r                                             */
    GVI_LOBATTO = 1,   /* order 2r - 2, r >= 2, nodes at both ends             */
    GVI_OWN     = 2    /* nodes and weights of the caller                      */
} gvi_rule_kind;

typedef struct gvi_rule {
    gvi_rule_kind   kind;
    int             points;    /* r.  0: s for Gauss, s + 1 for Lobatto        */
    const gvi_real *nodes;     /* GVI_OWN: distinct, in [0,1]; read by gvi_init */
    const gvi_real *weights;   /* GVI_OWN: sum to 1                            */
} gvi_rule;

typedef enum gvi_formulation {
    GVI_AUTO       = 0,   /* the cheapest that covers the scene; Newton when it
                             contracts badly                                   */
    GVI_EXPLICIT   = 1,
    GVI_POSITIONS  = 2,
    GVI_VELOCITIES = 3,
    GVI_MOMENTA    = 4,
    GVI_NEWTON     = 5
} gvi_formulation;

/* A scene and how it is to be integrated.  Zero-initialise; then only n and
   the effects must be set.  The effects array is not copied: it must live as
   long as the stepper.                                                       */
typedef struct gvi_desc {
    int               n;               /* degrees of freedom, >= 1             */
    int               degree;          /* s.  0: 8                             */
    gvi_rule          rule;            /* zero: Gauss with s points            */
    gvi_mass          mass;            /* zero: unit mass                      */
    const gvi_effect *effects;
    int               effect_count;    /* 0 to GVI_EFFECTS                     */
    gvi_formulation   formulation;     /* pinned: no fall-back and no memory for one */
    gvi_real          tolerance;       /* iterate until the change in q is below
                                          tolerance*|q|.  0: until round-off   */
    int               max_iterations;  /* 0: 60                                */
} gvi_desc;

#define GVI_FAULT_NONE (-1)
#define GVI_FAULT_MASS (-2)            /* the callbacks of desc.mass            */

typedef struct gvi_fault {             /* where the last failure came from      */
    int effect;                        /* index in effects, or GVI_FAULT_...    */
    int coordinate;                    /* or GVI_FAULT_NONE                     */
    int point;                         /* quadrature point, or GVI_FAULT_NONE   */
} gvi_fault;

/* Work done, counted since gvi_init.  The caller may set any of it to 0.      */
typedef struct gvi_counters {
    unsigned long long steps;             /* that succeeded                     */
    unsigned long long failures;          /* steps that did not                 */
    unsigned long long iterations;        /* of the fixed point                 */
    unsigned long long newton_iterations;
    unsigned long long factorizations;    /* LU of s*n, or of M at a point      */
    unsigned long long velocities;        /* points at which v was formed       */
    unsigned long long mass;              /* points given to mass callbacks     */
    unsigned long long effect[GVI_EFFECTS]; /* points given to each effect      */
    int                most_iterations;   /* in one step                        */
    gvi_real           worst_contraction; /* largest ratio of two changes       */
    gvi_real           worst_change;      /* largest last change, relative to q */
} gvi_counters;

struct gvi__rows { gvi_real *Q, *V, *F, *P, *A; };   /* [n][stride] each     */

struct gvi__private {
    gvi_desc         desc;
    gvi_formulation  chosen;          /* by the scene, or pinned                */
    size_t           size;
    gvi_real         te, t0;          /* compensation of t; start of last step  */
    gvi_real         h_weights;       /* h for which hb holds                   */
    gvi_real         ratio;           /* h/h_last for which E holds             */
    gvi_real         h_matrix;        /* h for which the Jacobian was made      */
    unsigned         off;             /* effects switched off, one bit each     */
    int              stride, flags;   /* of the rows; what the scene needs      */
    int              started, stepped, diagnose, lu_valid, newton_left;
    struct gvi__rows last, work;      /* at the points of the last step, the next */
    gvi_real        *memory;
    gvi_real        *q, *qe, *p, *pe, *q0, *p0, *v0, *ve, *dq, *dp, *change, *one;
    gvi_real        *c, *ce, *b, *hb, *t, *row, *gend, *E, *gamma, *W;
    gvi_real        *g, *m, *T, *N, *mass, *point_mass;
    gvi_real        *phi, *Phi, *y, *dy, *J, *pivot, *hess, *dF, *dP;
};

/* The stepper.  Read what stands before x; x is private.                      */
typedef struct gvi_stepper {
    int             n, s, r;          /* as resolved from the description       */
    gvi_real        t;                /* time                                   */
    const gvi_real *q, *p;            /* [n] configuration and momentum at t    */
    gvi_real        h;                /* last step, 0 before the first          */
    gvi_status      status;           /* of the last call                       */
    gvi_fault       fault;
    gvi_formulation formulation;      /* used by the last step, or the next     */
    int             order;            /* u of the rule                          */
    int             iterations;       /* in the last step                       */
    gvi_counters    counters;
    struct gvi__private x;
} gvi_stepper;

/* The discrete Lagrangian and what belongs to it; pointers may be NULL for
   what is not wanted, each but the first of length n.                        */
typedef struct gvi_discrete {
    gvi_real *lagrangian;             /* L_d(q0,q1;t,h); needs value callbacks  */
    gvi_real *d1, *d2;                /* its derivatives by q0 and q1           */
    gvi_real *minus, *plus;           /* discrete forces F-, F+                 */
    gvi_real *p0, *p1;                /* -d1 - minus and d2 + plus              */
} gvi_discrete;

/* ------------------------------------------------------------- FUNCTIONS */

/* Set-up.  Bytes of memory that desc needs; 0 if the description is faulty
   (gvi_init says how).  GVI_LENGTH: array length, a constant expression, that
   is enough for every scene of n degrees of freedom, degree s, r points.      */
GVI_DEF size_t     gvi_size(const gvi_desc *desc);
GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size);

/* Start at time t from velocities, momenta, or two configurations: q0 at t and
   q1 at t + h (solves the boundary-value problem; conjugate points: below).   */
GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v);
GVI_DEF gvi_status gvi_start_momentum(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p);
GVI_DEF gvi_status gvi_start_configurations(gvi_stepper *st, gvi_real t, gvi_real h,
                                            const gvi_real *q0, const gvi_real *q1);

/* One step to t + h; h < 0 steps back; h may differ from step to step (which
   keeps the map symplectic but not the energy's long-time bound).             */
GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h);

/* Switches effect `index` off (on = 0) or on again, between steps.           */
GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on);

/* At the present state: velocity (inverse Legendre transform), v[n];
   energy p'v - L, which needs every effect's value but a force's.            */
GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v);
GVI_DEF gvi_status gvi_energy(gvi_stepper *st, gvi_real *energy);

/* In the last step.  gvi_curve: the polynomial at tau in [0,1] and its
   derivative, error O(h^(min(s,u/2)+1)) and one order less.  gvi_state_at: the
   state at time t, at the full order, by a partial step from the nearer end.
   gvi_action: the quadrature of L over it.  q, v, p of length n, or NULL.
   None of them changes what later steps compute, to the bit.                 */
GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v);
GVI_DEF gvi_status gvi_state_at(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p);
GVI_DEF gvi_status gvi_action(gvi_stepper *st, gvi_real *action);

/* L_d(q0, q1; t, h): boundary values given, rows k >= 1 of (1) solved by
   Newton's method.  GVI_E_CONJUGATE where they do not determine the curve
   (oscillator: h omega = k pi).  Needs GVI_AUTO or GVI_NEWTON if s > 1.
   Forced systems: d1, d2 are total derivatives, and F-, F+ are
   h sum b_i f_i dQ_i/dq0, dQ_i/dq1 with the curve's own dependence on its
   ends, as the exact discrete forces are [1, sec. 3.2].  State untouched.     */
GVI_DEF gvi_status gvi_discrete_lagrangian(gvi_stepper *st, gvi_real t, gvi_real h,
                                           const gvi_real *q0, const gvi_real *q1,
                                           const gvi_discrete *out);

/* Restart from a checkpoint, a copy of a stepper and of its memory, in a
   stepper that was set up by gvi_init for the same description, in this
   process or another.  What follows is the same to the bit.                  */
GVI_DEF gvi_status gvi_restore(gvi_stepper *st, const gvi_stepper *saved, const gvi_real *memory);

/* A sentence for a status; why st uses the formulation that it uses.         */
GVI_DEF const char *gvi_status_text(gvi_status status);
GVI_DEF const char *gvi_formulation_text(const gvi_stepper *st);

/* Rules on [0,1]:  integral_0^1 f  =  sum_i b[i] f(c[i]).  c ascending, c and b
   of length n, c[i] + c[n-1-i] = 1.  Gauss: n >= 1, exact to degree 2n - 1.
   Lobatto: n >= 2, c[0] = 0, c[n-1] = 1, exact to degree 2n - 3.  Each c[i] and
   b[i] has a relative error of a few eps (tests/test_quadrature.c).          */
GVI_DEF gvi_status gvi_gauss(int n, gvi_real *c, gvi_real *b);
GVI_DEF gvi_status gvi_lobatto(int n, gvi_real *c, gvi_real *b);

/* The measured order of a rule: the largest u such that polynomials of degree
   < u are integrated exactly, to rounding.  0: the weights do not sum to 1.
   -1: nodes outside [0,1], or not distinct, or not finite.                   */
GVI_DEF int        gvi_rule_order(int n, const gvi_real *c, const gvi_real *b);

/* Barycentric interpolation [6] through n distinct nodes x in any order.
   gvi_barycentric: the weights w, scaled so that max |w| = 1.  Then, at any t,
   also at and near a node, inside and outside:
     gvi_interpolate             sum_j f[j] l_j(t)
     gvi_interpolate_derivative  its derivative; exactly 0 for a constant
     gvi_basis                   l[j] = l_j(t)
     gvi_basis_derivative        l[j] = l_j'(t)                               */
GVI_DEF gvi_status gvi_barycentric(int n, const gvi_real *x, gvi_real *w);
GVI_DEF gvi_real   gvi_interpolate(int n, const gvi_real *x, const gvi_real *w, const gvi_real *f, gvi_real t);
GVI_DEF gvi_real   gvi_interpolate_derivative(int n, const gvi_real *x, const gvi_real *w,
                                              const gvi_real *f, gvi_real t);
GVI_DEF void       gvi_basis(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *l);
GVI_DEF void       gvi_basis_derivative(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *l);

/* Dense LU with partial pivoting on equilibrated rows [7, ch. 9]:  P A = L U.
   a      n*n row-major, in: A, out: unit lower L below the diagonal, U on and
          above
   pivot  out, length 2n + 1: row pivot[k] was exchanged with row k; the rest
          serves gvi_lu_rcond
   Returns GVI_E_SINGULAR, scale-free: a pivot is nothing but rounding, compared
   with its own row and column of A; GVI_E_NON_FINITE if an entry is.
   gvi_lu_solve: x in: right-hand side, out: solution, length n.
   gvi_lu_rcond: estimate of 1/(|A| |A^-1|), 1-norm [7, alg. 15.1], usually
   within a factor 3 and never below the truth; work of length 3n.             */
GVI_DEF gvi_status gvi_lu_factor(int n, gvi_real *a, gvi_real *pivot);
GVI_DEF void       gvi_lu_solve(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *x);
GVI_DEF gvi_real   gvi_lu_rcond(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *work);

/* Rows are padded to a multiple of 4 from 5 points on, for vector registers.
   Terms: state, rule and tables, two sets of rows, mass, Newton.              */
#define GVI__ROW(r) ((r) < 5 ? (r) : ((r) + 3)/4*4)
#define GVI_LENGTH(n, s, r) ((n) > 0 ? 0 : 0)     /* set below with the layout */

#ifdef __cplusplus
}
#endif
#endif /* GVI_H */
