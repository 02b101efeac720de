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

   A planet on an ellipse of eccentricity 0.6, for 159 revolutions:

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
         for (int k = 0; k < 10000 && st.status == GVI_OK; ++k)
             gvi_step(&st, 0.1);
         printf("%s: q = %.9f %.9f\n", gvi_status_text(st.status), st.q[0], st.q[1]);
     }

   prints

     ok: q = -0.602737580 0.799997002

   Adding drag is one more row in effects[].  Taking it out of the list again
   takes its whole cost away.


   CONTENTS             (search for the names)

     CONVENTIONS          memory, threads, errors, arrays, units, rounding
     OPTIONS              the macros
     HOW IT WORKS         the method on a page, with the notation
     TYPES                effects, mass, rule, description, stepper
     FUNCTIONS            stepper first, then the building blocks
     -- implementation, to be read as a course --
     SUPPORT              real functions, twofold arithmetic
     DENSE LU
     QUADRATURE           Gauss and Lobatto nodes, order of a rule
     INTERPOLATION        barycentric
     SCENE                asking the effects, Legendre transform
     TABLES               what the rule and the degree have to say
     STEPPER: SET-UP      the choice of a formulation, the memory
     STEPPER: STEP        explicit, fixed point, Newton, start
     QUERIES              velocity, energy, curve, discrete Lagrangian
     LICENCE


   CONVENTIONS

   memory     Nothing is allocated, ever.  The caller hands gvi_init one array
              and keeps it as long as the stepper is used; there is nothing to
              free.  The stepper points into that array, never into itself: it
              may be moved.  Copy of stepper and array = checkpoint, see
              gvi_restore.
   threads    No mutable static data.  Different steppers are independent.  A callback
              must not call a function with the stepper that called it.
   errors     0 (GVI_OK) or a negative gvi_status; also kept in st->status,
              with st->fault naming the effect, coordinate and point.  A call
              that fails, other than gvi_init, leaves t, q, p, the last curve and everything that
              the queries read bit for bit as they were: halve h and go on.
   arrays     Row-major, A[i*n + j].  Values of one coordinate at the points
              of a step are contiguous: coordinate i at point k is
              [i*stride + k].  Inputs are const.  Arrays of one call do not
              overlap unless it is said that they may.
   units      None: time, lengths and masses are the caller's, coordinate by
              coordinate; no tolerance or test of the library depends on them.
   rounding   Round to nearest, subnormals kept; -ffast-math is refused.
              q, p and t carry compensation terms, so 1e9 steps of t + h are
              as exact as one.  Same bits on every IEEE machine when compiled
              with -ffp-contract=off, as far as callbacks do, and sin and cos
              with stiffness, and products stay between 1e-290 and 1e299 (float:
              1e-30 and 1e34), beyond which their rests depend on FMA.
   work       Points at which a step evaluates an effect, at most; m = max_iterations:
                explicit               r
                pinned fixed point     3(m+2) r
                fixed point, clock     2(m+2) r, and 1 for the clock
                Newton, AUTO with it   3(m+2) r, then three attempts of (m+1) r, each with
                                       m/4 + 2 Jacobians of (2n+1) r + n+1 points and
                                       one LU of size s n, or (s+1)/2 complex ones of n
              All of it once more when a value was not finite, to name the effect.
              gvi_velocity, gvi_energy: 1, with Lagrangian terms 40(12n+1).
              gvi_state_at: as a step; with a clock, 60 of them.
              Floating-point operations of a step of N iterations, callbacks apart:
              (N+2)(K n R (2r+18) + 30) + 30 K n r + 120 n at most, R = r below 5 points,
              else the next multiple of 8, K = 1 for positions, 2 for velocities and
              momenta; full M: 2n^2 ((N+2) K R + 3) more; M(q): (N+1) R (n^3/2 + 6n^2 + 4n),
              and as much again where one of its pivots is hardly more than rounding.
              A new h: 6r^3 + 4(r+10)rR + 70r + 60 more, in its step and the next two; without
              desc.iterations, where steps take six rounds, in two of a thousand as well, and
              after one whose extrapolated start led nowhere.
              With stiffness: n (30R + 200) more, and for each k/m at a new h
              r (16p (12s + 70) + 4r (s + 20)) + 3r^2 R + 200, sines counted as one,
              p = 1 + (h omega + s + s^2/32)/6.  Twice that where the extrapolated start leads
              nowhere, four times where the step fails.
              Explicit: 10n(r+1) + 32n + 8r + 16, a new h 1800r more; with stiffness
              23n(r+1) more, a new h 2300n(r+1) more.
              Without a clock, Lagrangian terms or marks; counted by make bound.

   gvi.h does not: choose or adapt the step, treat constraints or contact,
   run in parallel, or read or write anything.


   OPTIONS

     GVI_IMPLEMENTATION  [one file]    the code, besides the declarations
     GVI_STATIC          [that file]   everything static: private copy
     GVI_REAL            [everywhere]  float, double (default), long double
     GVI_EFFECTS         [everywhere]  most effects a scene may list: 16, to 32

   Less code, for small machines (docs/embedded.md), all in [that file]:

     GVI_ONLY_EXPLICIT, GVI_ONLY_POSITIONS, GVI_ONLY_VELOCITIES, GVI_ONLY_MOMENTA,
     GVI_ONLY_NEWTON      these formulations and no others (see HOW IT WORKS)
     GVI_NO_LAGRANGIAN    no effects of kind GVI_LAGRANGIAN, no GVI_MASS_NONE
     GVI_NO_CLOCK         no effects of kind GVI_CLOCK
     GVI_NO_DENSE         no GVI_MASS_DENSE
     GVI_NO_OWN           no GVI_OWN
     GVI_NO_POINT         no effects that are given as .point
     GVI_NO_RULES         no rule but Gauss with r = s <= 4, and in GVI_EXPLICIT those
                          that it takes; no Lagrangian terms.  Nodes and tables
                          then are constants, not code
     GVI_NO_TOLERANCE     no fixed point without desc.iterations
     GVI_NO_DIAGNOSIS     where a value is not finite, st->fault names no effect
     GVI_NO_RESTS         h v is rounded: other last bits, and where h has a short period
                          in binary, as 0.1 has, energy can drift by 0.03 eps a step

   A description that asks for what was left out is refused: GVI_E_FORMULATION.
   Without diagnosis a step that came to NaN or Inf is not repeated to find the effect.
   With GVI_STATIC, functions that are not called vanish as well.

     GVI_SQRT(x) GVI_ABS(x) GVI_FLOOR(x) GVI_LDEXP(x, e) GVI_FREXP(x, &e)
                          given all, in gvi_real: <math.h> is not included
     GVI_SIN(x) GVI_COS(x)  then, for desc.stiffness, which is not heeded without them
*/
/* ------------------------------------------------------------- HOW IT WORKS

   A mechanical system moves so that its action, the integral of L(t, q, q'),
   is stationary.  A variational integrator approximates the action, not the
   equation of motion [1]; whatever the step does is then stationary action
   again, which is why symmetry means exact momentum and why the map is
   symplectic.  The Galerkin kind [2] takes

     curve        q(t0 + h tau) = q0 + h sum_k Phi_k(tau) y_k     0 <= tau <= 1
                  k = 0..s-1, phi_k = Legendre polynomial P_k(1 - 2 tau),
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
   matrix Gamma_kl = sum_i b_i phi_k(c_i) phi_l(c_i), which is diagonal,
   1/(2k+1), if u >= 2s - 1.  Put into Q and V,

     Q_i = q0 + h c_i v0 + h M^-1 sum_j (c_i - S_ij) h b_j F_j              (3)
     V_i = v0 + M^-1 sum_j (1 - T_ij) h b_j F_j                             (4)
     S = Phi Gamma^-1 Phi'      T = phi Gamma^-1 Phi'      N = phi Gamma^-1 phi'

   with phi_ik = phi_k(c_i), Phi_ik = Phi_k(c_i), and ' for the transpose.  So for
   effects that read only q the unknowns are the forces: put F in, get Q out, ask
   the effects at all r points at once, repeat.  No velocity, no matrix.  S is
   symmetric: that is what symplecticity asks of (3), and it survives rounding, since
   S and c are rounded to one grid.  A Lagrangian term adds A_i = dL/dv to P_i:
   h M^-1 sum_j T_ji b_j A_j is then taken from (3), M^-1 sum_j N_ij b_j A_j from (4).

   r = s.  Then V_i is free at each node, Gamma^-1 phi' diag(b) = phi^-1, and
   (1) is the partitioned Runge-Kutta method

     Q_i = q0 + sum_j T_ji h b_j V_j       P_i = p0 + sum_j (1 - T_ij) h b_j F_j   (5)

   with V_i from dL/dv(Q_i, V_i) = P_i: Gauss collocation for Gauss nodes, the
   Lobatto IIIA-IIIB pair for Lobatto's [3, II.1, VI.6], [4].

   Kicks.  On a broken line with corners Q_j at t0 + c_j h, c_1 = 0, c_r = 1, the
   action sum_j |Q_(j+1) - Q_j|^2/(2 (c_(j+1) - c_j) h) - h sum_j b_j V(Q_j) is
   stationary when the momentum jumps by h b_j F_j at each corner [1, 2.5]: kick,
   drift, kick ...  Stoermer-Verlet has c = 0, 1 and b = 1/2, 1/2; every
   composition of it, and every kick-drift splitting, is such a table; where c_1 is not
   0 or c_r not 1 it begins or ends with a drift.

   FORMULATIONS.  One step, five ways to find it; the scene decides which:

     explicit     s = 1, Lobatto with r = 2 or kicks, constant mass, effects read only
                  t and q: Stoermer-Verlet and splittings, no iteration
     positions    constant mass, effects read only t and q: (3) as fixed point
     velocities   constant mass, any effects: (3) and (4) as fixed point
     momenta      M(q), or velocity from momentum given, and r = s: (5)
     Newton       anything: (1) by Newton's method, dense LU of size s*n, or
                  for Gauss with r = s complex ones of size n

   The fixed points contract like (h omega)^2 or h omega; where they do not,
   GVI_AUTO goes over to Newton, except where stiffness is heeded.  All solve the same equations, and all stop
   at round-off.

   WEAK EFFECTS.  A force that hardly changes while an iteration closes in need not
   be asked in each of its rounds: one that is marked as weak stands still while the
   others iterate, and is asked again when the change that it would bring is greater
   than a tenth of the one that the others bring next: twice a step at least, and a step
   then takes a round or two more (a round: one iteration).  So it pays from about five
   rounds a step on, where a force that is smaller by 1000 is asked half to two thirds as
   often.  The equations, and so the step, are the same; a mark on an effect that is not
   weak costs rounds, or the turn to Newton's method, but no more digits than any
   iteration that stops at a predicted change.
   Marks take (n + 2) R more numbers of memory.  They are for potentials and forces in the
   fixed points, without a clock or desc.iterations, at degree 1 with no rule but Gauss's,
   and not in code compiled for size: elsewhere a marked effect is asked as any other.

   STIFF SPRINGS.  A spring of frequency omega lets a fixed point contract like (h omega)^2
   or not at all, and asks polynomials to follow its oscillation, although nothing about it
   is unknown.  desc.stiffness tells it: k_i > 0 is the constant part of d2V/dq_i^2; the
   effects give all of the force, as ever.  Free motion of that coordinate then is an arc,
   the oscillation by -k_i q_i, in place of a straight line, and polynomials describe what is
   left of the force, g = F + k Q.  With omega^2 = k/m, nu = h omega, S(x) = sin(nu x)/nu,
   C(x) = cos(nu x) the positions of such a coordinate are

     Q_i = C(c_i) q0 + h S(c_i) v0 + h M^-1 sum_j (K_ij/b_j) h b_j g_j
     q1  = C(1) q0 + h S(1) v0     + h M^-1 sum_j S(1 - c_j) h b_j g_j
     p1  = C(1) p0 - k h S(1) q0   +        sum_j C(1 - c_j) h b_j g_j
     K_ij/b_j = (A_ij + A_ji + S(c_i - c_j))/2       A = Psi Gamma^-1 phi'
                Psi_ik = integral of S(c_i - tau) phi_k(tau) from 0 to c_i

   (V_i: the derivative of the first, with A_ij, C for S in it, in place of h K_ij/b_j), and g
   is what iterates: h is bounded by it alone.  b_i K_ij - b_j K_ji = b_i b_j S(c_i - c_j):
   so the step is symplectic for any k, beside any other coordinates, and of the same order.
   The right k is the best: where the spring is all there is, a step of any h is the exact
   rotation.  Another k is another step.
   Explicit, the drifts are arcs, and the kicks are by g: of Stoermer-Verlet that makes Deuflhard's
   method [3, XIII.1], and splittings keep their order, for g is of q alone.
   [3, XIII] is about methods of this kind.  Their limits: near nu = pi, 2 pi ... steps can
   resonate with g; a momentum map stays exact where k is the same multiple of m for all
   coordinates that the symmetry mixes, and not if it shifts one with a k.  Newton's method and
   boundary values solve other equations: rounds that do not contract end in
   GVI_E_CONVERGENCE, gvi_discrete_lagrangian and gvi_start_configurations in
   GVI_E_FORMULATION.  It pays from h omega = 1/2 or so, and takes at most (2r + 3) R + 8 numbers of
   memory for each k_i/m_i that is not that of the stiff coordinate before, and (R + 2) n + 14,
   with velocities (2R + 2) n + 14; explicit (5r + 7) n + r + 16, n in whole eights from 8 on.
   A new h, as of gvi_state_at, costs as much as some steps.  It is for explicit, positions and
   velocities with unit or diagonal mass and without Lagrangian terms; elsewhere, compiled for size,
   with GVI_NO_RULES and for k_i <= 0 it is not heeded.

   CLOCK.  An effect g(q) > 0 makes time run as dt = g dtau, and h is a step in
   tau: t moves fast or slow, and the map is as symplectic as with fixed steps
   [3, VIII.2].  The curves of energy E are the zero-energy curves of
   g L(q, q'/g) + g E, a Lagrangian like any other, so momenta takes

     V_i = g v        F_i = g (dL/dq + f) - dg/dq (H - E)        t' = g

   with v = M^-1 p as before.  E is what the energy was at the start, plus the
   work of forces, so every potential and Lagrangian term needs its value; and
   none of them may depend on t: what does is to be listed as a force.  Without a
   mass it needs mass.velocity.

   Order.  |q1 - exact| = O(h^(min(2s,u)+1)) a step: twice the degree, which
   is the superconvergence theorem [2, thm. 4.1].  It holds for u >= 2s - 2; a
   weaker rule does not see its highest modes properly, and their error enters
   squared: order min(u, 2(u-s+1)) is what the tests find.  The curve in between
   is less exact, min(s, u/2) + 1 in the maximum norm [2, sec. 5].  r < s or
   u < s cannot work: a mode without kinetic energy, or free motion not exact.

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
    GVI_E_ARGUMENT    = -1,  /* null pointer, memory not aligned as a gvi_real is, size out
                                of range, h = 0, NaN or Inf given; a matrix, points or
                                nodes where the kind takes none: it was forgotten   */
    GVI_E_MEMORY      = -2,  /* the memory is smaller than gvi_size(desc)               */
    GVI_E_NODES       = -3,  /* own rule: a node outside [0,1], or two that coincide    */
    GVI_E_ORDER       = -4,  /* own rule of order u < s, so also weights that do not sum
                                to 1: not even free motion would come out           */
    GVI_E_POINTS      = -5,  /* r < s, or a rule that does not see every mode           */
    GVI_E_FORMULATION = -6,  /* no formulation, or not the pinned one, covers this scene */
    GVI_E_SINGULAR    = -7,  /* singular matrix: massless coordinate (fault.coordinate) */
    GVI_E_CONVERGENCE = -8,  /* the iteration diverges or creeps, or the state overflows: h too large, f jumps */
    GVI_E_CALLBACK    = -9,  /* a callback refused (fault.effect)                       */
    GVI_E_NON_FINITE  = -10, /* NaN or Inf came out of an effect (fault.effect)         */
    GVI_E_VALUE       = -11, /* energy or action wanted, or a clock on, but fault.effect
                                has no value                                        */
    GVI_E_STATE       = -12, /* not started; no step yet; time outside the last step; a
                                clock was switched on since                         */
    GVI_E_CONJUGATE   = -13, /* boundary values do not determine the curve              */
    GVI_E_CLOCK       = -14  /* a clock's g is not positive (fault.effect, fault.point) */
} gvi_status;

/* What a callback gets: `count` points.  Coordinate i of point k is at
   [i*stride + k].  Inputs that the callback's kind may not read, and outputs
   that are not its to give, are NULL.  Outputs are ADDED to (f, dldv, value)
   or WRITTEN (mass, velocity); they do not overlap the inputs or each other.
   From count to stride rows go on, with t and q of the start of the step and with
   any v and p: a callback may compute whole vectors, on to stride.  What it
   leaves there changes nothing, be it NaN.                                   */
typedef struct gvi_points {
    int             n;         /* degrees of freedom                           */
    int             count;     /* points in this call, >= 1                    */
    int             stride;    /* distance of two coordinates, >= count        */
    const gvi_real *t;         /* [count]   time                               */
    const gvi_real *q;         /* [n][count] configuration                     */
    const gvi_real *v;         /* [n][count] velocity; NULL for a potential    */
    const gvi_real *p;         /* [n][count] momentum; for mass.velocity only  */
    gvi_real       *f;         /* [n][count] add dL/dq: -dV/dq or the force.  It
                                  holds others' already, and in kicks momentum too */
    gvi_real       *dldv;      /* [n][count] add dL/dv; Lagrangian terms only  */
    gvi_real       *value;     /* [count]    add V, or L of a Lagrangian term; g.
                                  A function given as points and as value fills
                                  what is not NULL of f and value              */
    gvi_real       *mass;      /* [n*n][count] write M_ij, i >= j, row i*n + j */
    gvi_real       *velocity;  /* [n][count] write v                           */
} gvi_points;

/* All points at once.  Returns 0, or anything else for "cannot be evaluated
   here": an extrapolated start is then given up for a plain one; refused again, the
   step ends with GVI_E_CALLBACK.                                            */
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
    GVI_LAGRANGIAN = 2,  /* L(t,q,v): reads t, q, v; adds dL/dq to f, dL/dv to dldv */
    GVI_CLOCK      = 3   /* g(q) > 0: adds g to value and dg/dq to f; at most one   */
} gvi_kind;

/* One thing that acts in a scene.  Give exactly one of points and point; for a clock, points. */
typedef struct gvi_effect {
    gvi_kind        kind;
    gvi_points_fn  *points;   /* the effect at all points of a step at once     */
    gvi_point_fn   *point;    /* or one point a call                            */
    gvi_points_fn  *value;    /* V or L, for energy and action, and every step of a
                                 clock; NULL: unknown                           */
    gvi_hessian_fn *hessian;  /* for Newton; NULL: differences of f and dldv over sqrt(eps) of
                                 the motion: they are to be exact nearly to rounding */
    void           *user;     /* handed to the callbacks                        */
    int             weak;     /* not 0: asked in some iterations only (WEAK EFFECTS) */
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
                                  points, or velocity, at the same x->q       */
    gvi_points_fn  *velocity;  /* optional: writes x->velocity, the v at which
                                  dL/dv(t,q,v) = p, L being ALL of the scene.
                                  No system is solved then, but Q and P change
                                  in turn: up to twice the iterations          */
    void           *user;
} gvi_mass;

typedef enum gvi_rule_kind {
    GVI_GAUSS   = 0,   /* order 2r                                             */
    GVI_LOBATTO = 1,   /* order 2r - 2, r >= 2, nodes at both ends             */
    GVI_OWN     = 2,   /* nodes and weights of the caller                      */
    GVI_KICKS   = 3    /* degree 1, the curve a broken line with its corners at
                          the nodes, in the order given: explicit              */
} gvi_rule_kind;

typedef struct gvi_rule {
    gvi_rule_kind   kind;
    int             points;    /* r, to 4000.  0: s for Gauss, s+1 for Lobatto */
    const gvi_real *nodes;     /* GVI_OWN: distinct, in [0,1]; GVI_KICKS: any   */
    const gvi_real *weights;   /* sum to 1; both are read by gvi_init only     */
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
    int               n;               /* degrees of freedom, 1 to 524,287; to 32,767 where
                                          matrices may be needed: Newton's method, also as
                                          the fall-back of GVI_AUTO, Lagrangian terms, full
                                          masses                                */
    int               degree;          /* s, to 1024.  0: 8, with GVI_KICKS 1  */
    gvi_rule          rule;            /* zero: Gauss with s points            */
    gvi_mass          mass;            /* zero: unit mass                      */
    const gvi_effect *effects;
    int               effect_count;    /* 0 to GVI_EFFECTS                     */
    gvi_formulation   formulation;     /* pinned: no fall-back and no memory for one */
    gvi_real          tolerance;       /* below 1.  Stop when the change of q yet to come,
                                          as the last two changes predict it, is
                                          below tolerance*|q|: the step then is
                                          symplectic to that, and takes K r R
                                          numbers more.  Beside stiffness, above
                                          32 eps, the sums of a step are rounded,
                                          too: by about eps of their terms' sizes.
                                          0: at round-off.
                                          Explicit (not small code, full mass or
                                          stiffness): any but 0 rounds q and p at
                                          each kick; areas may drift by eps r/2 a
                                          step, and p/(h b_j) must not overflow */
    int               max_iterations;  /* to 1,000,000.  0: 60                 */
    int               iterations;      /* N: exactly N of the fixed point in every step, for
                                          a loop with a deadline, and no Newton.  A step fails
                                          unless its last change is rounding, or less than half
                                          of that two iterations before (N = 2: less than the
                                          first).  N = 1: no such test, see counters.worst_change.
                                          0: as many as it takes               */
    const gvi_real   *stiffness;       /* [n] k_i, or NULL: the constant part of d2V/dq_i^2,
                                          whose oscillation becomes the free motion: another
                                          method (STIFF SPRINGS).  Read by gvi_init only */
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
    unsigned long long iterations;        /* of the fixed point, also in gvi_state_at */
    unsigned long long newton_iterations;
    unsigned long long factorizations;    /* LU of s*n or of n, or of M at a point */
    unsigned long long velocities;        /* points at which v was formed       */
    unsigned long long mass;              /* points given to mass.points, mass.velocity */
    unsigned long long effect[GVI_EFFECTS]; /* points given to each effect      */
    int                most_iterations;   /* in one step or gvi_state_at        */
    gvi_real           worst_contraction; /* of the iteration, mean of two; where Newton's
                                             method followed, also of what it replaced */
    gvi_real           worst_change;      /* largest last change of a fixed point, relative */
} gvi_counters;

struct gvi__rows { gvi_real *Q, *V, *F, *P, *A; };   /* [n][stride] each     */

/* What gvi__learn remembers: steps counted and their iterations, those of the eight steps before;
   what it does now; is the extrapolation that for long steps?                 */
struct gvi__learned { short steps, rounds, before; signed char stage, lengthy; };

/* What most functions name comes first: on small machines an offset below 128 takes
   fewer bytes.                                                                */
struct gvi__private {
    gvi_formulation  chosen;          /* by the scene, or pinned                */
    unsigned char    diagnose;        /* repeated, to find what is not finite   */
    unsigned char    newton_left;     /* steps until the fixed point is tried   */
    unsigned char    whole_left;      /* steps until blocks are tried again     */
    int              stride, flags;   /* of the rows; what the scene needs      */
    unsigned         off;             /* effects switched off, one bit each     */
    /* parts of the caller's memory, handed out by gvi__layout; R = stride */
    struct gvi__rows work, last;      /* at the points of the next step, the last */
    gvi_real *c, *hb, *b, *t;         /* [R] nodes, h b, weights; times, at set-up rest of c */
    gvi_real *change, *one;           /* [3n], [6n] scratch                     */
    gvi_real *q, *p, *dq, *dp, *dqe;  /* [n] state, its increments, what rounding left of them */
    gvi_real *phi, *Phi;              /* [s][R] modes at the nodes              */
    gvi_real *row, *z, *less;         /* [6R], [R], [R] scratch; row 9R where there is E */
    gvi_real *dpe, *qe, *pe;          /* [n] what rounding left, likewise       */
    gvi_real *q0, *p0, *zeros;        /* [n] start of the last step, its (no) rest */
    gvi_real *start;                  /* [n] velocity that a start was given    */
    gvi_real *v0, *ve;                /* [n] M^-1 p, M^-1 pe of the step at work */
    gvi_real *scale;                  /* [2n] 1/unit of changes, of two sets of rows */
    gvi_real *low;                    /* [s][R] rest of phi                     */
    gvi_real *inv_gamma, *own;        /* [s] 1/Gamma_kk; LU of Gamma if full    */
    gvi_real *eigen;                  /* [(s+1)/2][2s] of integration, Gauss with r = s */
    gvi_real *drift;                  /* [4][r+1] explicit: see gvi__drifting          */
    gvi_real *g, *m, *T, *N;          /* [r][R] c_i - S_ij, 1 - T_ij, T_ji, N_ij */
    gvi_real *E;                      /* [r or 2r][R] extrapolation; at set-up rest of Phi */
    gvi_real *rate;                   /* [3][R] clock: g; f'v; H, then H - E    */
    gvi_real *slope;                  /* [n][R] clock: dg/dq                    */
    gvi_real *over;                   /* [n] 1/m of a diagonal mass             */
    gvi_real *weak;                   /* [n+2][R] weak forces, as last asked; gvi__answers */
    gvi_real *springs;                /* stiffness: see gvi__arc, gvi__shears   */
    gvi_real *folded;                 /* [r][R] for each stage: its table times h b; gvi__folds */
    gvi_real *mass, *point_mass, *Z;  /* M; M at the points [n*n][R]; [n][R] scratch */
    gvi_real *y, *dy, *J, *pivot;     /* Newton: [s*n] twice; two matrices of s*n */
    gvi_real *hess, *dF;              /* scratch; F and P, moved and not, [4][n][R] */
    gvi_real *older_F, *older_V, *older_A;  /* rows of the step before the last   */
    gvi_real *memory;                 /* from its first aligned number on       */
    size_t           size, skip;      /* numbers in use; left out for alignment */
    gvi_desc         desc;
    gvi_real         te, t0, dt;      /* compensation of t; start of last step; its length */
    gvi_real         H, He, dH, H0;   /* clock: energy, its rest, increment; at the start */
    gvi_real         h_weights;       /* h for which hb holds                   */
    gvi_real         ratio;           /* h/h_last for which E holds             */
    gvi_real         h_matrix;        /* h for which J was made, 0: none        */
    unsigned         marks;           /* effects marked as weak, one bit each   */
    signed char      clock, single;   /* effect that is one; the only one; or -1 */
    signed char      alike, E_is;     /* last steps of the same length: 0, 1, 2; see GVI__OF_TWO */
    signed char      started, stepped;  /* stepped: 2 by a clock               */
    signed char      usual;           /* see gvi__usual_step                   */
    signed char      turns;           /* of the rows since gvi_init, modulo 6: gvi__rotate_rows */
    signed char      has_rate;        /* rate holds                             */
    signed char      has_force;       /* last.F ends with the force at (t, q)   */
    signed char      has_velocity;    /* last.V holds                           */
    signed char      has_factor;      /* point_mass holds a factored M          */
    signed char      blocks;          /* Newton's J as blocks: 1 can be, 0 not, -1 see eigen */
    signed char      has_blocks;      /* J holds blocks                         */
    struct gvi__learned learned;
};

/* The stepper, to be read; x is private, and near its beginning: see there.   */
typedef struct gvi_stepper {
    int             n, s, r;          /* as resolved from the description       */
    gvi_status      status;           /* of the last call                       */
    gvi_formulation formulation;      /* used by the last step, or the next     */
    struct gvi__private x;
    gvi_real        t;                /* time                                   */
    const gvi_real *q, *p;            /* [n] configuration and momentum at t    */
    gvi_real        h;                /* last step, 0 before the first          */
    gvi_fault       fault;
    int             order;            /* u of the rule; 0 for GVI_KICKS         */
    int             iterations;       /* in the last step                       */
    gvi_counters    counters;
} gvi_stepper;

/* The discrete Lagrangian and what belongs to it; pointers may be NULL for what
   is not wanted.  lagrangian and negative: one number, all others of length n. */
typedef struct gvi_discrete {
    gvi_real *lagrangian;             /* L_d(q0,q1;t,h); needs value callbacks  */
    gvi_real *d1, *d2;                /* its derivatives by q0 and q1           */
    gvi_real *minus, *plus;           /* discrete forces F-, F+                 */
    gvi_real *p0, *p1;                /* -d1 - minus and d2 + plus              */
    int      *negative;               /* negative eigenvalues of the action's second
                                         variation over the interior, forces left
                                         out: 0, the curve is a minimum; as many as
                                         conjugate points lie inside (Morse), up to
                                         what n (s - 1) modes can show          */
} gvi_discrete;

/* ------------------------------------------------------------- FUNCTIONS */

/* Set-up.  Bytes of memory that desc needs; 0 if the description is faulty:
   gvi_init, even with a NULL memory, then returns why.  A chain of calls after a
   failure keeps its first status.  GVI_LENGTH: array length, a constant expression, that
   is enough for every scene of n degrees of freedom, degree s, r points.      */
GVI_DEF size_t     gvi_size(const gvi_desc *desc);
GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size);

/* Start at time t from velocities, momenta, or two configurations: q0 at t and
   q1 at t + h (solves the boundary-value problem; conjugate points: below).   */
GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v);
GVI_DEF gvi_status gvi_start_momentum(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p);
GVI_DEF gvi_status gvi_start_configurations(gvi_stepper *st, gvi_real t, gvi_real h,
                                            const gvi_real *q0, const gvi_real *q1);

/* One step to t + h (with a clock: to tau + h); h < 0 steps back; h may differ
   from step to step (which keeps the map symplectic but not the energy's
   long-time bound).  If what an effect reads through `user` changes between
   steps, call gvi_switch(st, i, 1): the explicit formulation keeps the force at
   the end of a step for the next.                                            */
GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h);

/* Switches effect `index` off (on = 0) or on again, between steps.  What is off is not
   asked; the formulation stays that of the whole list.  gvi_start leaves the switches
   as they are.                                                               */
GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on);

/* At the present state: velocity (inverse Legendre transform), v[n];
   energy p'v - L, which needs every effect's value but a force's.            */
GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v);
GVI_DEF gvi_status gvi_energy(gvi_stepper *st, gvi_real *energy);

/* In the last step.  gvi_curve: the polynomial at tau in [0,1] and its
   derivative, error O(h^(min(s,u/2)+1)) and one order less; with a clock tau is
   its own time, and v still dq/dt.
   gvi_state_at: the state at time t (a time, not tau) inside it, at the full
   order, by a partial step from the nearer end.
   Beside stiffness the curve is made of arcs, and its end is off q1 by the error of a step.
   gvi_action: the quadrature of L over it; beside stiffness the generating function of the
   step, dS = p1 dq1 - p0 dq0.  This and gvi_state_at use the effects that
   are on now.
   A broken line has neither curve nor action, a clock no action: GVI_E_FORMULATION.
   q, v, p of length n, or NULL.
   None of them changes what later steps compute, to the bit.                 */
GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v);
GVI_DEF gvi_status gvi_state_at(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p);
GVI_DEF gvi_status gvi_action(gvi_stepper *st, gvi_real *action);

/* L_d(q0, q1; t, h): boundary values given, rows k >= 1 of (1) solved by
   Newton's method.  GVI_E_CONJUGATE where they do not determine the curve
   (oscillator: h omega = k pi).  Needs GVI_AUTO or GVI_NEWTON if s > 1, and is
   not for kicks, a clock or where stiffness is heeded.
   Forced systems: d1, d2 are total derivatives, and F-, F+ are
   h sum b_i f_i dQ_i/dq0, dQ_i/dq1 with the curve's own dependence on its
   ends, as the exact discrete forces are [1, sec. 3.2]; how they share p0 and
   p1 is as exact as the Hessians (sqrt(eps), where differences stand in for
   them), p0 and p1 themselves are exact.  State untouched.                    */
GVI_DEF gvi_status gvi_discrete_lagrangian(gvi_stepper *st, gvi_real t, gvi_real h,
                                           const gvi_real *q0, const gvi_real *q1,
                                           const gvi_discrete *out);

/* Restart from a checkpoint, a copy of a stepper and of its memory, in a
   stepper that was set up by gvi_init for the same description, in this
   process or another.  What follows is the same to the bit.  GVI_E_ARGUMENT if
   sizes, the number of effects, what they read together, the kind of mass or the
   formulation differ, or, where it iterates, if only one of the two has a tolerance.
   A rule of as many points and stiffness are not compared: those saved are used, and callbacks,
   tolerance and limits are those of st.                                       */
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
   -1: nodes outside [0,1], or not distinct, or not finite.  Its time grows like n^3, and
   gvi_size and gvi_init ask it of GVI_OWN: a quarter of a second at n = 250.   */
GVI_DEF int        gvi_rule_order(int n, const gvi_real *c, const gvi_real *b);

/* Barycentric interpolation [6] through n distinct nodes x in any order.
   gvi_barycentric: the weights w, scaled so that max |w| = 1; GVI_E_NODES if two
   nodes coincide, or if the smallest weight leaves the range of gvi_real.  Then,
   at any t, also at and near a node, inside and outside:
     gvi_interpolate             sum_j f[j] l_j(t)
     gvi_interpolate_derivative  its derivative; exactly 0 for a constant
     gvi_basis                   l[j] = l_j(t)
     gvi_basis_derivative        l[j] = l_j'(t)                               */
GVI_DEF gvi_status gvi_barycentric(int n, const gvi_real *x, gvi_real *w);
GVI_DEF gvi_real   gvi_interpolate(int n, const gvi_real *x, const gvi_real *w,
                                   const gvi_real *f, gvi_real t);
GVI_DEF gvi_real   gvi_interpolate_derivative(int n, const gvi_real *x, const gvi_real *w,
                                              const gvi_real *f, gvi_real t);
GVI_DEF void       gvi_basis(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *l);
GVI_DEF void       gvi_basis_derivative(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *l);

/* Dense LU with partial pivoting on equilibrated rows [7, ch. 9]:  P A = L U.
   a      n*n row-major, in: A, out: unit lower L below the diagonal, U on and
          above
   pivot  out, length n + 1: row pivot[k] was exchanged with row k; pivot[n] is
          the 1-norm of A, for gvi_lu_rcond
   Returns GVI_E_SINGULAR, scale-free: a pivot is nothing but the rounding of the
   terms that made it; GVI_E_NON_FINITE if an entry is.
   gvi_lu_solve: x in: right-hand side, out: solution, length n.
   gvi_lu_rcond: estimate of 1/(|A| |A^-1|), 1-norm [7, sec. 15.3], usually
   within a factor 3 and never below the truth; work of length 3n.             */
GVI_DEF gvi_status gvi_lu_factor(int n, gvi_real *a, gvi_real *pivot);
GVI_DEF void       gvi_lu_solve(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *x);
GVI_DEF gvi_real   gvi_lu_rcond(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *work);

/* Rows are padded to a multiple of 8 from 5 points on, for vector registers.
   Terms: state, rule and tables, two sets of rows, mass, Newton.              */
#define GVI__ROW(r) ((r) < 5 ? (r) : ((r) + 7)/8*8)
#define GVI__SIZE(a) ((size_t)(a))
#define GVI__SLACK (63/sizeof(gvi_real))
#define GVI_LENGTH(n, s, r) (                                                    \
    (31 + 4*GVI__SIZE(s) + 20*GVI__SIZE(GVI__ROW(r))                             \
     + (6 + GVI__SIZE(GVI__ROW(r)) + 2*GVI__SIZE(s)*GVI__SIZE(s))*GVI__SIZE(n))*GVI__SIZE(n) \
    + (20 + 9*GVI__SIZE(r) + 3*GVI__SIZE(s))*GVI__SIZE(GVI__ROW(r))              \
    + ((r) > (n) ? GVI__SIZE((r) - (n))*GVI__SIZE(GVI__ROW(r))*GVI__SIZE(n) : 0) \
    + (GVI__SIZE(s) + 2)*GVI__SIZE(s) + 3 + GVI__SLACK + ((n) < 8 ? 0 : 126))

#ifdef __cplusplus
}
#endif
#endif /* GVI_H */


#if defined(GVI_IMPLEMENTATION) && !defined(GVI_IMPLEMENTED)
#define GVI_IMPLEMENTED

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) \
    || (defined(__ASSOCIATIVE_MATH__) && __ASSOCIATIVE_MATH__)
#error "gvi.h relies on IEEE arithmetic: no -ffast-math, no part of it that changes sums"
#endif

/* --------------------------------------------------------------- SUPPORT */

#include <float.h>
#include <stdint.h>

#ifndef GVI_SQRT
#include <math.h>
#if GVI__KIND == 1
#define GVI__MATH(name) name##f
#elif GVI__KIND == 2
#define GVI__MATH(name) name
#else
#define GVI__MATH(name) name##l
#endif
#define GVI_SQRT(x)      GVI__MATH(sqrt)(x)
#define GVI_ABS(x)       GVI__MATH(fabs)(x)
#define GVI_FLOOR(x)     GVI__MATH(floor)(x)
#define GVI_LDEXP(x, e)  GVI__MATH(ldexp)(x, e)
#define GVI_FREXP(x, pe) GVI__MATH(frexp)(x, pe)
#define GVI_SIN(x)       GVI__MATH(sin)(x)
#define GVI_COS(x)       GVI__MATH(cos)(x)
#endif
#if defined(GVI_SIN) && defined(GVI_COS)
#define GVI__TURNS 1                                  // arcs can be made
#define GVI__SIN(x) GVI_SIN(x)
#define GVI__COS(x) GVI_COS(x)
#else
#define GVI__TURNS 0
#define GVI__SIN(x) (x)
#define GVI__COS(x) (x)
#endif

#if GVI__KIND == 1
#define GVI__EPS FLT_EPSILON
#define GVI__MAX FLT_MAX
#define GVI__MIN FLT_MIN
#define GVI__DIG FLT_MANT_DIG
#elif GVI__KIND == 2
#define GVI__EPS DBL_EPSILON
#define GVI__MAX DBL_MAX
#define GVI__MIN DBL_MIN
#define GVI__DIG DBL_MANT_DIG
#else
#define GVI__EPS LDBL_EPSILON
#define GVI__MAX LDBL_MAX
#define GVI__MIN LDBL_MIN
#define GVI__DIG LDBL_MANT_DIG
#endif

#define GVI__BEYOND_FLOAT (GVI__DIG > 24)             // not where double is no more than float, as on AVR

/* What is compiled.  Whatever was left out stands behind a constant 0, and so no
   compiler keeps it.                                                         */
#if defined(GVI_ONLY_EXPLICIT) || defined(GVI_ONLY_POSITIONS) || defined(GVI_ONLY_VELOCITIES) \
    || defined(GVI_ONLY_MOMENTA) || defined(GVI_ONLY_NEWTON)
#define GVI__ONLY(yes) yes
#else
#define GVI__ONLY(yes) 1
#endif
#ifdef GVI_ONLY_EXPLICIT
#define GVI__EXPLICIT 1
#else
#define GVI__EXPLICIT GVI__ONLY(0)
#endif
#ifdef GVI_ONLY_POSITIONS
#define GVI__POSITIONS 1
#else
#define GVI__POSITIONS GVI__ONLY(0)
#endif
#ifdef GVI_ONLY_VELOCITIES
#define GVI__VELOCITIES 1
#else
#define GVI__VELOCITIES GVI__ONLY(0)
#endif
#ifdef GVI_ONLY_MOMENTA
#define GVI__MOMENTA 1
#else
#define GVI__MOMENTA GVI__ONLY(0)
#endif
#ifdef GVI_ONLY_NEWTON
#define GVI__NEWTON 1
#else
#define GVI__NEWTON GVI__ONLY(0)
#endif
#define GVI__READS_V (GVI__VELOCITIES || GVI__MOMENTA || GVI__NEWTON)
#ifdef GVI_NO_RULES
#define GVI__RULES 0
#if GVI__KIND == 3
#error "GVI_NO_RULES is for float and double"
#endif
#else
#define GVI__RULES 1
#endif
#if defined(GVI_NO_LAGRANGIAN) || defined(GVI_NO_RULES)
#define GVI__LAGRANGIAN 0
#else
#define GVI__LAGRANGIAN GVI__READS_V
#endif
#ifdef GVI_NO_CLOCK
#define GVI__CLOCK 0
#else
#define GVI__CLOCK GVI__MOMENTA
#endif
#ifdef GVI_NO_DENSE
#define GVI__DENSE 0
#else
#define GVI__DENSE 1
#endif
#if defined(GVI_NO_OWN) || defined(GVI_NO_RULES)
#define GVI__OWN 0
#else
#define GVI__OWN 1
#endif
#ifdef GVI_NO_POINT
#define GVI__POINT 0
#else
#define GVI__POINT 1
#endif
#ifdef GVI_NO_TOLERANCE
#define GVI__TOLERANCE 0
#else
#define GVI__TOLERANCE 1
#endif
#define GVI__WEAK (GVI__TOLERANCE && !GVI__SMALL && (GVI__POSITIONS || GVI__VELOCITIES || GVI__MOMENTA))
#ifdef GVI_NO_RESTS
#define GVI__RESTS 0
#else
#define GVI__RESTS 1
#endif
#define GVI__PATH (GVI__RESTS || !GVI__SMALL)         // h v is kept
#define GVI__STIFF (GVI__TURNS && GVI__RULES && !GVI__SMALL                      \
                    && (GVI__EXPLICIT || GVI__POSITIONS || GVI__VELOCITIES))
#ifdef GVI_NO_DIAGNOSIS
#define GVI__DIAGNOSIS 0
#else
#define GVI__DIAGNOSIS 1
#endif

/* Compiled for size: one loop in place of several for the usual lengths, scratch in
   the caller's memory in place of registers, and GVI__APART, a function of its own:
   called once, so that what it needs of the stack is not held by those that call it,
   or short and called often.                                                  */
#ifdef __OPTIMIZE_SIZE__
#define GVI__SMALL 1
#else
#define GVI__SMALL 0
#endif
#if GVI__SMALL && defined(__GNUC__)
#define GVI__APART static __attribute__((noinline))
#else
#define GVI__APART static
#endif

// the same, where Newton's method or a clock makes the stack deep; elsewhere a copy is shorter
#if GVI__NEWTON || GVI__CLOCK
#define GVI__DEEP GVI__APART
#else
#define GVI__DEEP static
#endif

// a loop whose lengths, a struct whose members, or a question whose answer is known where it is called:
// always a copy
#if defined(__GNUC__)
#define GVI__COPY static inline __attribute__((always_inline))
#else
#define GVI__COPY static inline
#endif

// what is so nearly always, for code without a jump where it is
#if defined(__GNUC__)
#define GVI__OFTEN(question) __builtin_expect(!!(question), 1)
#else
#define GVI__OFTEN(question) (question)
#endif

// arrays that do not overlap
#if defined(__GNUC__) || defined(_MSC_VER)
#define GVI__RESTRICT __restrict
#elif !defined(__cplusplus)
#define GVI__RESTRICT restrict
#else
#define GVI__RESTRICT
#endif

#if GVI__KIND == 3 && LDBL_MANT_DIG == 106
#error "gvi.h needs IEEE arithmetic: this long double is a pair of doubles"
#endif

typedef char gvi__effects_fit_a_word[GVI_EFFECTS >= 1 && GVI_EFFECTS <= 32
                                     && GVI_EFFECTS <= 8*sizeof(unsigned) ? 1 : -1];

GVI__APART int gvi__finite(gvi_real x) { return GVI_ABS(x) <= GVI__MAX; }

// true for every x but 0 and NaN
GVI__APART int gvi__nonzero(gvi_real x) { return x < 0 || x > 0; }

static int gvi__all_finite(int n, const gvi_real *x)
{
    int finite = 1;
    for (int i = 0; i < n; ++i) finite &= gvi__finite(x[i]);
    return finite;
}

static void gvi__zero(size_t n, gvi_real *x)
{
    for (size_t i = 0; i < n; ++i) x[i] = 0;
}

static void gvi__copy(size_t n, const gvi_real *x, gvi_real *y)
{
    for (size_t i = 0; i < n; ++i) y[i] = x[i];
}

static void gvi__swap(gvi_real *a, gvi_real *b)
{
    const gvi_real was = *a;
    *a = *b;
    *b = was;
}

/* Twofold arithmetic: an unevaluated sum hi + lo, |lo| <= ulp(hi)/2, carries
   twice the digits of gvi_real (Dekker, Numer. Math. 18, 1971; Joldes, Muller,
   Popescu, ACM Trans. Math. Softw. 44, 2017).  Used for tables, where the rounding
   of a coefficient would act in every step in the same direction.             */
typedef struct gvi__two { gvi_real hi, lo; } gvi__two;

static gvi__two gvi__two_of(gvi_real hi, gvi_real lo) { gvi__two z; z.hi = hi; z.lo = lo; return z; }

#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16    // 16: as 0, and _Float16 in its own range
#define GVI__EXACT_TYPES
#endif
#ifdef GVI__EXACT_TYPES
typedef gvi_real gvi__stored;
#else
typedef volatile gvi_real gvi__stored;     // registers are wider: round for certain
#endif

// x + y exactly, whichever is larger (Knuth, The art of computer programming 2, 4.2.2)
static gvi__two gvi__sum(gvi_real x, gvi_real y)
{
    gvi__stored a = x, b = y, hi = a + b, bb = hi - a, aa = hi - bb, da = a - aa, db = b - bb;
    return gvi__two_of(hi, da + db);
}

// (x + xe) + (y + ye): what is lost of x + y goes to the low parts
static gvi__two gvi__join(gvi_real x, gvi_real xe, gvi_real y, gvi_real ye)
{
    const gvi__two sum = gvi__sum(x, y);
    return gvi__two_of(sum.hi, (xe + ye) + sum.lo);
}

/* a b + c with one rounding, where it is an instruction.  newlib's <math.h> does not say so, gcc does; clang,
   and gcc after a pragma that names the processor, say so only by what the processor has.  */
#if defined(__GNUC__) && ((defined(__FMA__) && defined(__SSE2_MATH__)) || defined(__aarch64__))
#define GVI__FUSES
#endif
#if GVI__KIND == 1 && (defined(GVI__FUSES) || defined(__FP_FAST_FMAF))
#define GVI__FMA __builtin_fmaf
#elif GVI__KIND == 2 && (defined(GVI__FUSES) || defined(__FP_FAST_FMA))
#define GVI__FMA __builtin_fma
#elif GVI__KIND == 1 && defined(FP_FAST_FMAF) && defined(GVI__MATH)
#define GVI__FMA fmaf
#elif GVI__KIND == 2 && defined(FP_FAST_FMA) && defined(GVI__MATH)
#define GVI__FMA fma
#endif

#ifdef GVI__FMA
GVI__COPY gvi__two gvi__product(gvi_real a, gvi_real b)          // a*b exactly
{
    return gvi__two_of(a*b, GVI__FMA(a, b, -(a*b)));  // a*b is used twice: gcc and clang do not fuse it into a sum
}
#else
// 2^k + 1, k half the digits: x times it shows where to cut x in two (Veltkamp; Dekker)
#define GVI__CUT ((gvi_real)(1ULL << (GVI__DIG + 1)/2) + 1)

// x = hi + lo, half of the digits each: their products are exact
static inline gvi__two gvi__split(gvi_real x)
{
    gvi__stored a = x, s = GVI__CUT*a, d = s - a, hi = s - d, lo = a - hi;
    return gvi__two_of(hi, lo);
}

static inline gvi__two gvi__product(gvi_real a, gvi_real b)      // a*b exactly
{
    const gvi__two x = gvi__split(a), y = gvi__split(b);
    const gvi__stored hi = a*b;
    return gvi__two_of(hi, ((x.hi*y.hi - hi) + x.hi*y.lo + x.lo*y.hi) + x.lo*y.lo);
}
#endif

static gvi__two gvi__real2(gvi_real a) { return gvi__two_of(a, 0); }

// a + b to 3 (eps/2)^2 of the sum (Joldes et al., algorithm 6)
static gvi__two gvi__add2(gvi__two a, gvi__two b)
{
    gvi__two s = gvi__sum(a.hi, b.hi), t = gvi__sum(a.lo, b.lo);
    s = gvi__sum(s.hi, s.lo + t.hi);
    return gvi__sum(s.hi, s.lo + t.lo);
}

static gvi__two gvi__sub2(gvi__two a, gvi__two b) { return gvi__add2(a, gvi__two_of(-b.hi, -b.lo)); }

// a b, without the product of the low parts (Joldes et al., algorithm 10)
static gvi__two gvi__mul2(gvi__two a, gvi__two b)
{
    gvi__two z = gvi__product(a.hi, b.hi);
    return gvi__sum(z.hi, z.lo + (a.hi*b.lo + a.lo*b.hi));
}

static gvi__two gvi__scale2(gvi_real a, gvi__two b) { return gvi__mul2(gvi__real2(a), b); }

static gvi__two gvi__div2(gvi__two a, gvi__two b)
{
    // one correction of the rounded quotient doubles its digits
    gvi_real q = a.hi/b.hi;
    gvi__two rest = gvi__add2(a, gvi__scale2(-q, b));
    return gvi__sum(q, rest.hi/b.hi);
}

// a/k; the quotient 1/k need not wait for a.  1 - q k is exact but for the last rounding
static gvi__two gvi__over2(gvi__two a, int k)
{
    const gvi_real d = (gvi_real)k, q = 1/d;
    const gvi__two p = gvi__product(q, d);
    const gvi__stored rest = (1 - p.hi) - p.lo;
    return gvi__mul2(a, gvi__sum(q, rest/d));
}

// nearest multiple of `unit`, a power of 2: sums of such numbers are exact
static gvi_real gvi__grid(gvi__two a, gvi_real unit)
{
    const gvi_real whole = GVI_FLOOR(a.hi/unit);      // the sum with 1/2 would round once more
    return (whole + GVI_FLOOR((a.hi/unit - whole) + (a.lo/unit + (gvi_real)0.5)))*unit;
}

/* -------------------------------------------------------------- DENSE LU */

// pivot[0..n-1]: row scales 1/max_j |a_ij|; pivot[n]: 1-norm of A
static gvi_status gvi__lu_scales(int n, const gvi_real *a, gvi_real *pivot, int *at)
{
    gvi_status status = GVI_OK;
    size_t N = (size_t)n;
    for (size_t i = 0; i < N; ++i) {
        gvi_real big = 0;
        for (size_t j = 0; j < N; ++j) {
            gvi_real x = GVI_ABS(a[i*N + j]);
            if (!(x <= GVI__MAX)) return GVI_E_NON_FINITE;
            if (x > big) big = x;
        }
        if (!(big > 0)) {
            status = GVI_E_SINGULAR;
            *at = (int)i;
        }
        pivot[i] = big > 0 ? 1/big : 0;
        if (!gvi__finite(pivot[i])) pivot[i] = GVI__MAX;      // subnormal row
    }
    pivot[n] = 0;
    for (size_t j = 0; j < N; ++j) {
        gvi_real sum = 0;
        for (size_t i = 0; i < N; ++i) sum += GVI_ABS(a[i*N + j]);
        if (sum > pivot[n]) pivot[n] = sum;
    }
    return status;
}

// at: the row of zeros or the column in which elimination ended, if it is singular
static gvi_status gvi__lu_factor(int n, gvi_real *a, gvi_real *pivot, int *at)
{
    size_t N = (size_t)n;
    *at = -1;
    gvi_status status = gvi__lu_scales(n, a, pivot, at);
    if (status != GVI_OK) return status;

    for (size_t k = 0; k < N; ++k) {
        // find pivot: largest in column k, each row measured by its own scale
        size_t m = k;
        gvi_real big = -1;
        for (size_t i = k; i < N; ++i) {
            gvi_real x = GVI_ABS(a[i*N + k])*pivot[i];
            if (x > big) { big = x; m = i; }
        }

        // swap rows k and m, all columns; the scale of row k moves along
        if (m != k)
            for (size_t j = 0; j < N; ++j) gvi__swap(a + k*N + j, a + m*N + j);
        pivot[m] = pivot[k];
        pivot[k] = (gvi_real)m;

        // check singularity: of the terms that made this pivot only rounding, n eps |L||U|, is
        // left [7, thm. 9.3]
        gvi_real terms = 0;
        for (size_t j = 0; j < k; ++j) terms += GVI_ABS(a[k*N + j]*a[j*N + k]);
        if (!(GVI_ABS(a[k*N + k]) > (gvi_real)n*GVI__EPS*terms)) {
            *at = (int)k;
            return GVI_E_SINGULAR;
        }

        // eliminate column k from the rows below
        for (size_t i = k + 1; i < N; ++i) {
            gvi_real l = a[i*N + k]/a[k*N + k], *row = a + i*N;
            const gvi_real *top = a + k*N;
            row[k] = l;
            if (gvi__nonzero(l))
                for (size_t j = k + 1; j < N; ++j) row[j] -= l*top[j];
        }
    }
    return GVI_OK;
}

GVI_DEF gvi_status gvi_lu_factor(int n, gvi_real *a, gvi_real *pivot)
{
    int at;
    if (n < 1 || !a || !pivot) return GVI_E_ARGUMENT;
    return gvi__lu_factor(n, a, pivot, &at);
}

GVI_DEF void gvi_lu_solve(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *x)
{
    size_t N = (size_t)n;

    // x = P x, then forward substitution: solve L*y = x
    for (size_t k = 0; k < N; ++k) gvi__swap(x + k, x + (size_t)pivot[k]);
    for (size_t i = 1; i < N; ++i)
        for (size_t j = 0; j < i; ++j) x[i] -= lu[i*N + j]*x[j];

    // back substitution: solve U*x = y
    for (size_t i = N; i-- > 0; ) {
        for (size_t j = i + 1; j < N; ++j) x[i] -= lu[i*N + j]*x[j];
        x[i] /= lu[i*N + i];
    }
}

// solves A' x = b: U'*y = b, L'*z = y, x = P' z; rows are used as columns
static void gvi__lu_solve_transposed(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *x)
{
    size_t N = (size_t)n;
    for (size_t i = 0; i < N; ++i) {
        x[i] /= lu[i*N + i];
        for (size_t j = i + 1; j < N; ++j) x[j] -= lu[i*N + j]*x[i];
    }
    for (size_t i = N; i-- > 0; )
        for (size_t j = 0; j < i; ++j) x[j] -= lu[i*N + j]*x[i];
    for (size_t k = N; k-- > 0; ) gvi__swap(x + k, x + (size_t)pivot[k]);
}

/* Complex numbers: <complex.h> is not C++, and from C11 on not in every C.      */
typedef struct gvi__complex { gvi_real re, im; } gvi__complex;

static gvi__complex gvi__complex_of(gvi_real re, gvi_real im)
{
    gvi__complex z;
    z.re = re;
    z.im = im;
    return z;
}

// |re| + |im|, which is the modulus up to a factor of sqrt(2) (as in LAPACK's zgetrf)
static gvi_real gvi__cabs1(gvi_real re, gvi_real im) { return GVI_ABS(re) + GVI_ABS(im); }

static gvi__complex gvi__times_complex(gvi__complex a, gvi__complex b)
{
    return gvi__complex_of(a.re*b.re - a.im*b.im, a.re*b.im + a.im*b.re);
}

// 1/(re + i im); no square leaves the range of gvi_real
static gvi__complex gvi__inverse(gvi_real re, gvi_real im)
{
    const gvi_real size = gvi__cabs1(re, im), a = re/size, b = im/size, d = (a*a + b*b)*size;
    return gvi__complex_of(a/d, -b/d);
}

// row += z top from column k on; a row of a complex matrix, and a complex vector, is n real
// parts, then n imaginary ones
static void gvi__add_row(size_t n, size_t k, gvi__complex z, const gvi_real *GVI__RESTRICT top,
                         gvi_real *GVI__RESTRICT row)
{
    for (size_t j = k; j < n; ++j) {
        row[j] += z.re*top[j] - z.im*top[n + j];
        row[n + j] += z.re*top[n + j] + z.im*top[j];
    }
}

// of the rows from k on, that with the largest entry in column k, each measured by its scale
static size_t gvi__pivot_row(size_t n, size_t k, const gvi_real *a, const gvi_real *scale)
{
    size_t m = k;
    gvi_real big = -1;
    for (size_t i = k; i < n; ++i) {
        const gvi_real x = gvi__cabs1(a[2*i*n + k], a[(2*i + 1)*n + k])*scale[i];
        if (x > big) { big = x; m = i; }
    }
    return m;
}

/* The same as gvi__lu_factor for a complex matrix, with |re| + |im| as size; of a
   pivot its inverse is kept.  GVI_E_SINGULAR also where an entry is not finite. */
static gvi_status gvi__lu_factor_complex(int count, gvi_real *a, gvi_real *pivot)
{
    const size_t n = (size_t)count;
    for (size_t i = 0; i < n; ++i) {
        gvi_real big = 0;
        for (size_t j = 0; j < n; ++j) {
            const gvi_real x = gvi__cabs1(a[2*i*n + j], a[(2*i + 1)*n + j]);
            if (!(x <= big)) big = x;
        }
        pivot[i] = 1/big;
        if (!gvi__finite(big) || !gvi__finite(pivot[i])) return GVI_E_SINGULAR;
    }
    for (size_t k = 0; k < n; ++k) {
        const size_t m = gvi__pivot_row(n, k, a, pivot);
        gvi_real *top = a + 2*k*n, terms = 0;
        for (size_t j = 0; m != k && j < 2*n; ++j) gvi__swap(top + j, a + 2*m*n + j);
        pivot[m] = pivot[k];
        pivot[k] = (gvi_real)m;
        for (size_t j = 0; j < k; ++j)
            terms += gvi__cabs1(top[j], top[n + j])*gvi__cabs1(a[2*j*n + k], a[(2*j + 1)*n + k]);
        if (!(gvi__cabs1(top[k], top[n + k]) > (gvi_real)n*GVI__EPS*terms)) return GVI_E_SINGULAR;
        const gvi__complex inverse = gvi__inverse(top[k], top[n + k]);
        top[k] = inverse.re;
        top[n + k] = inverse.im;
        for (size_t i = k + 1; i < n; ++i) {
            gvi_real *row = a + 2*i*n;
            const gvi__complex l = gvi__times_complex(gvi__complex_of(row[k], row[n + k]), inverse);
            row[k] = l.re;
            row[n + k] = l.im;
            if (gvi__cabs1(l.re, l.im) > 0) gvi__add_row(n, k + 1, gvi__complex_of(-l.re, -l.im), top, row);
        }
    }
    return GVI_OK;
}

// x_i := x_i - sum over columns j0..j1 - 1 of row i times x
static void gvi__take_row(size_t n, size_t i, size_t j0, size_t j1, const gvi_real *lu, gvi_real *x)
{
    const gvi_real *re = lu + 2*i*n, *im = re + n;
    gvi_real a = 0, b = 0, c = 0, d = 0;              // four sums, none waits for another
    for (size_t j = j0; j < j1; ++j) {
        a += re[j]*x[j];
        b += im[j]*x[n + j];
        c += re[j]*x[n + j];
        d += im[j]*x[j];
    }
    x[i] -= a - b;
    x[n + i] -= c + d;
}

static void gvi__lu_solve_complex(int count, const gvi_real *lu, const gvi_real *pivot, gvi_real *x)
{
    const size_t n = (size_t)count;
    for (size_t k = 0; k < n; ++k) {
        const size_t m = (size_t)pivot[k];
        gvi__swap(x + k, x + m);
        gvi__swap(x + n + k, x + n + m);
    }
    for (size_t i = 1; i < n; ++i) gvi__take_row(n, i, 0, i, lu, x);
    for (size_t i = n; i-- > 0; ) {
        gvi__take_row(n, i, i + 1, n, lu, x);
        const gvi__complex y = gvi__times_complex(gvi__complex_of(x[i], x[n + i]),
                                                  gvi__complex_of(lu[2*i*n + i], lu[(2*i + 1)*n + i]));
        x[i] = y.re;
        x[n + i] = y.im;
    }
}

static gvi_real gvi__norm1(int n, const gvi_real *x)
{
    gvi_real sum = 0;
    for (int i = 0; i < n; ++i) sum += GVI_ABS(x[i]);
    return sum;
}

GVI_DEF gvi_real gvi_lu_rcond(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *work)
{
    gvi_real *x = work, *z = work + n, *sign = work + 2*n, best = 0;

    // climb |A^-1 x| over the corners of |x| = 1, at most 5 of them
    for (int i = 0; i < n; ++i) x[i] = 1/(gvi_real)n, sign[i] = 0;
    for (int step = 0, corner = -1; step < 5; ++step) {
        gvi_lu_solve(n, lu, pivot, x);
        gvi_real norm = gvi__norm1(n, x);
        int same = step > 0;
        if (norm > best) best = norm;
        else if (step > 0) break;
        for (int i = 0; i < n; ++i) {
            z[i] = x[i] < 0 ? -1 : 1;
            if (gvi__nonzero(z[i] - sign[i])) same = 0;
            sign[i] = z[i];
        }
        if (same) break;
        gvi__lu_solve_transposed(n, lu, pivot, z);
        int next = 0;
        for (int i = 1; i < n; ++i)
            if (GVI_ABS(z[i]) > GVI_ABS(z[next])) next = i;
        if (next == corner) break;
        corner = next;
        gvi__zero((size_t)n, x);
        x[next] = 1;
    }

    // a vector of alternating signs catches what the climb may miss
    for (int i = 0; i < n; ++i) {
        gvi_real a = 1 + (n > 1 ? (gvi_real)i/(gvi_real)(n - 1) : 0);
        x[i] = i % 2 ? -a : a;
    }
    gvi_lu_solve(n, lu, pivot, x);
    gvi_real other = 2*gvi__norm1(n, x)/(3*(gvi_real)n);
    if (other > best) best = other;
    return 1/best/pivot[n];
}

/* ------------------------------------------------------------ QUADRATURE */

/* Legendre polynomials by the three-term recurrence (k+1) P_(k+1) = (2k+1) x P_k -
   k P_(k-1), always at x = 1 - 2c for c in [0,1]: P_(k+1)(x) from P_k and P_(k-1).  */
static gvi_real gvi__legendre_next(int k, gvi_real x, gvi_real P, gvi_real before)
{
    return ((gvi_real)(2*k + 1)*x*P - (gvi_real)k*before)/(gvi_real)(k + 1);
}

// P_m(x)
static gvi_real gvi__legendre(int m, gvi_real c)
{
    gvi_real P = 1, before = 0;
    for (int k = 0; k < m; ++k) {
        const gvi_real next = gvi__legendre_next(k, 1 - 2*c, P, before);
        before = P;
        P = next;
    }
    return P;
}

/* Nodes are taken four at a time, where speed counts: a recurrence waits for itself at each
   of them, but no node for another.                                            */
enum { GVI__NODES = GVI__SMALL ? 1 : 4 };
typedef struct gvi__nodes { gvi_real hi[GVI__NODES], lo[GVI__NODES]; } gvi__nodes;

GVI__COPY gvi__two gvi__node(const gvi__nodes *x, int i) { return gvi__two_of(x->hi[i], x->lo[i]); }
GVI__COPY void gvi__set_node(gvi__nodes *x, int i, gvi__two z) { x->hi[i] = z.hi; x->lo[i] = z.lo; }

// x = 1 - 2c in twofold arithmetic
static gvi__two gvi__argument2(gvi__two c) { return gvi__sub2(gvi__real2(1), gvi__scale2(2, c)); }

// gvi__legendre_next in twofold arithmetic: P_k, P_(k-1) become P_(k+1), P_k
GVI__APART void gvi__legendre2(int k, const gvi__nodes *GVI__RESTRICT x, gvi__nodes *GVI__RESTRICT P,
                               gvi__nodes *GVI__RESTRICT before)
{
    for (int i = 0; i < GVI__NODES; ++i) {
        const gvi__two was = gvi__node(P, i), less = gvi__scale2(-(gvi_real)k, gvi__node(before, i));
        const gvi__two next = gvi__scale2((gvi_real)(2*k + 1), gvi__mul2(gvi__node(x, i), was));
        gvi__set_node(P, i, gvi__over2(gvi__add2(next, less), k + 1));
        gvi__set_node(before, i, was);
    }
}

/* Newton's correction of node c on [0,1], and the weight that belongs to c.  With
   m = n for Gauss, n - 1 for Lobatto, P = P_m, d = P_(m-1) - x P_m,
   (1 - x^2) P_m' = m d and ((1 - x^2) P_m')' = -m (m+1) P_m:

     Gauss     P_m = 0     c += P_m 2c(1-c) / (m d)    b = 4c(1-c) / (m d)^2
     Lobatto   P_m' = 0    c -= d / (2(m+1) P_m)       b = 1 / (m (m+1) P_m^2)  */
GVI__APART gvi__two gvi__node_newton(int lobatto, int m, gvi__two c, gvi__two P, gvi__two d, gvi_real *b)
{
    if (lobatto) {
        P = gvi__div2(gvi__real2(1), P);
        d = gvi__over2(gvi__mul2(d, P), -2*(m + 1));
        P = gvi__over2(gvi__mul2(P, P), m);
        *b = gvi__over2(P, m + 1).hi;
        return d;
    }
    d = gvi__scale2((gvi_real)m, d);
    c = gvi__mul2(c, gvi__sub2(gvi__real2(1), c));
    c = gvi__div2(c, d);
    *b = 4*gvi__div2(c, d).hi;
    c = gvi__mul2(P, c);
    return gvi__two_of(2*c.hi, 2*c.lo);
}

// P = P_m and d of it
GVI__APART void gvi__node_values(int m, const gvi__nodes *c, gvi__nodes *P, gvi__nodes *d)
{
    gvi__nodes x;
    for (int i = 0; i < GVI__NODES; ++i) {
        gvi__set_node(&x, i, gvi__argument2(gvi__node(c, i)));
        gvi__set_node(P, i, gvi__real2(1));
        gvi__set_node(d, i, gvi__real2(0));
    }
    for (int k = 0; k < m; ++k) gvi__legendre2(k, &x, P, d);
    for (int i = 0; i < GVI__NODES; ++i)
        gvi__set_node(d, i, gvi__sub2(gvi__node(d, i), gvi__mul2(gvi__node(&x, i), gvi__node(P, i))));
}

/* Where Newton's method for node j of the lower half starts,
   c = (1 - cos theta)/2 = sin^2(theta/2):  Gauss theta = pi (4j+3)/(4m+2), Lobatto
   from the zeros of J_1; both are well within its quadratic range.            */
GVI__APART gvi_real gvi__node_guess(int lobatto, int n, int j)
{
    const gvi_real pi = (gvi_real)3.14159265358979323846L, m = (gvi_real)(n - lobatto);
    const gvi_real a = (gvi_real)j + (lobatto ? (gvi_real)0.25 : (gvi_real)0.75);
    const gvi_real theta = lobatto ? pi*a/m - 3/(8*pi*m*a) : pi*a/(m + (gvi_real)0.5);
    const gvi_real y = theta*theta/4, sine = theta/2*(1 - y/6*(1 - y/20*(1 - y/42)));      // to 3e-7
    return sine*sine;
}

/* Newton's method in working precision, in place of the first corrections, where speed
   counts; the recurrence has its quotients first, so that nothing waits for them.
   Where `wanted` is 0 the node is known.                                       */
static void gvi__node_start(int lobatto, int m, const gvi_real *wanted, gvi_real *c)
{
    gvi_real P[GVI__NODES], before[GVI__NODES];
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < GVI__NODES; ++i) P[i] = 1, before[i] = 0;
        for (int j = 0; j < m; ++j) {
            const gvi_real w = 1/(gvi_real)(j + 1);
            for (int i = 0; i < GVI__NODES; ++i) {
                const gvi_real next = (2 - w)*(1 - 2*c[i])*P[i] - (1 - w)*before[i];
                before[i] = P[i];
                P[i] = next;
            }
        }
        for (int i = 0; i < GVI__NODES; ++i) {
            const gvi_real d = before[i] - (1 - 2*c[i])*P[i];
            const gvi_real dc = lobatto ? -d/(2*(gvi_real)(m + 1)*P[i]) : P[i]*2*c[i]*(1 - c[i])/((gvi_real)m*d);
            c[i] += wanted[i] > 0 ? dc : 0;
        }
    }
}

/* Nodes and weights; ce, if given, gets what rounding left of c.  After a
   correction below eps the next one would be below its square: c is then accurate
   relative to itself, even next to the end of the interval.  Nodes are symmetric
   about 1/2: one half is computed, by no more than 12 corrections each.  From `first`
   on; the last of the half stands in for those that are missing of a block.   */
static void gvi__rule_part(int lobatto, int n, int first, gvi_real *c, gvi_real *ce, gvi_real *b)
{
    const int m = n - lobatto, most = (n - 1)/2;
    gvi__nodes z, P, d;
    gvi_real last[GVI__NODES], weight[GVI__NODES];    // last: correction; 0, where the node is known
    for (int i = 0; i < GVI__NODES; ++i) {
        const int j = first + i < most ? first + i : most, middle = 2*j + 1 == n;
        const int known = middle || (lobatto && j == 0);
        const gvi_real start = middle ? (gvi_real)0.5 : known ? 0 : gvi__node_guess(lobatto, n, j);
        gvi__set_node(&z, i, gvi__real2(start));
        last[i] = known ? 0 : 1;
    }
    if (!GVI__SMALL) gvi__node_start(lobatto, m, last, z.hi);
    for (int k = 0, more = 1; more; ++k) {
        gvi__node_values(m, &z, &P, &d);
        more = 0;
        for (int i = 0; i < GVI__NODES; ++i) {
            const gvi__two x = gvi__node(&z, i);
            const gvi__two dx = gvi__node_newton(lobatto, m, x, gvi__node(&P, i), gvi__node(&d, i), weight + i);
            if (!(last[i] > GVI__EPS*x.hi) || k == 12) continue;
            gvi__set_node(&z, i, gvi__add2(x, dx));
            last[i] = GVI_ABS(dx.hi);
            more = 1;
        }
    }
    for (int i = 0, j = first; i < GVI__NODES && j <= most; ++i, ++j) {
        const gvi__two mirror = gvi__sub2(gvi__real2(1), gvi__node(&z, i));
        c[j] = z.hi[i];
        c[n-1-j] = mirror.hi;
        if (ce) ce[j] = z.lo[i], ce[n-1-j] = mirror.lo;
        b[j] = b[n-1-j] = weight[i];
    }
}

static void gvi__rule_make(int lobatto, int n, gvi_real *c, gvi_real *ce, gvi_real *b)
{
    for (int j = 0; j <= (n - 1)/2; j += GVI__NODES) gvi__rule_part(lobatto, n, j, c, ce, b);
}

GVI_DEF gvi_status gvi_gauss(int n, gvi_real *c, gvi_real *b)
{
    if (n < 1 || !c || !b) return GVI_E_ARGUMENT;
    gvi__rule_make(0, n, c, NULL, b);
    return GVI_OK;
}

GVI_DEF gvi_status gvi_lobatto(int n, gvi_real *c, gvi_real *b)
{
    if (n < 2 || !c || !b) return GVI_E_ARGUMENT;
    gvi__rule_make(1, n, c, NULL, b);
    return GVI_OK;
}

GVI_DEF int gvi_rule_order(int n, const gvi_real *c, const gvi_real *b)
{
    if (n < 1 || !c || !b) return -1;
    gvi_real size = 0;
    for (int i = 0; i < n; ++i) {
        if (!(c[i] >= 0 && c[i] <= 1) || !gvi__finite(b[i])) return -1;
        for (int j = 0; j < i; ++j)
            if (!gvi__nonzero(c[i] - c[j])) return -1;
        size += GVI_ABS(b[i]);
    }

    // exact for degree u if sum b P_u = [u = 0]; no rule is exact for degree 2n.
    // The rounding of c moves P_u by |P_u'| eps <= u^2 eps at the very end only
    for (int u = 0; u < 2*n; ++u) {
        gvi_real sum = u > 0 ? 0 : -1;
        for (int i = 0; i < n; ++i) sum += b[i]*gvi__legendre(u, c[i]);
        if (GVI_ABS(sum) > 4*(gvi_real)(u + 2)*GVI__EPS*size) return u;
    }
    return 2*n;
}

/* --------------------------------------------------------- INTERPOLATION */

/* w_j = 1/prod_(k != j) (x_j - x_k), common factors left out.  The product is
   kept as mantissa and exponent: it leaves the range of double at n = 1000.   */
GVI_DEF gvi_status gvi_barycentric(int n, const gvi_real *x, gvi_real *w)
{
    if (n < 1 || !x || !w || !gvi__all_finite(n, x)) return GVI_E_ARGUMENT;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j)
            if (!gvi__nonzero(x[i] - x[j])) return GVI_E_NODES;

    // twice over: first the smallest exponent, then the weights scaled by it
    int least = 0;
    gvi_real big = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (int j = 0; j < n; ++j) {
            gvi_real mantissa = 1;
            int exponent = 0, e;
            for (int k = 0; k < n; ++k)
                if (k != j) {
                    mantissa *= GVI_FREXP(x[j] - x[k], &e);
                    exponent += e;
                    mantissa = GVI_FREXP(mantissa, &e);
                    exponent += e;
                }
            if (pass == 0 && (j == 0 || exponent < least)) least = exponent;
            if (pass == 1) {
                w[j] = GVI_LDEXP(1/mantissa, least - exponent);
                if (GVI_ABS(w[j]) > big) big = GVI_ABS(w[j]);
            }
        }
    for (int j = 0; j < n; ++j) {
        w[j] /= big;
        if (!gvi__nonzero(w[j])) return GVI_E_NODES;
    }
    return GVI_OK;
}

static int gvi__nearest(int n, const gvi_real *x, gvi_real t)
{
    int i = 0;
    for (int j = 1; j < n; ++j)
        if (GVI_ABS(t - x[j]) < GVI_ABS(t - x[i])) i = j;
    return i;
}

/* l_j(t) = (w_j/(t - x_j)) / sum_k w_k/(t - x_k).  Both sides multiplied by the
   distance d to the nearest node i, so that t = x_i is no exception; and the
   sum, which may cancel, by what it is equal to: w_i prod_(k != i)
   (x_i - x_k)/(t - x_k), factors in (0,2] [6, sec. 3, the first form].  Returns i. */
static int gvi__term(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *d, gvi_real *sum)
{
    int i = gvi__nearest(n, x, t);
    *d = t - x[i];
    *sum = w[i];
    for (int k = 0; k < n; ++k)
        if (k != i) *sum *= (x[i] - x[k])/(t - x[k]);
    return i;
}

GVI_DEF void gvi_basis(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *l)
{
    gvi_real d, sum;
    int i = gvi__term(n, x, w, t, &d, &sum);
    for (int j = 0; j < n; ++j) l[j] = (j == i ? w[i] : w[j]*(d/(t - x[j])))/sum;
}

GVI_DEF gvi_real gvi_interpolate(int n, const gvi_real *x, const gvi_real *w, const gvi_real *f, gvi_real t)
{
    gvi_real d, sum, value = 0;
    int i = gvi__term(n, x, w, t, &d, &sum);

    // f_i + sum l_j (f_j - f_i): exact at nodes, exact for constants
    for (int j = 0; j < n; ++j)
        if (j != i) value += w[j]*(d/(t - x[j]))*(f[j] - f[i]);
    return f[i] + value/sum;
}

/* For j != i, i the node next to t:  l_j' = l_j sum_(k != j) 1/(t - x_k).  The term
   k = i, which has no bound, is never formed: l_j/(t - x_i) has one.          */
static gvi_real gvi__slope(int n, const gvi_real *x, const gvi_real *w, gvi_real t,
                           int i, gvi_real d, gvi_real sum, int j)
{
    gvi_real l = w[j]/(t - x[j])/sum, rest = 0;       // l_j/d
    for (int k = 0; k < n; ++k)
        if (k != i && k != j) rest += 1/(t - x[k]);
    return l + l*d*rest;
}

GVI_DEF void gvi_basis_derivative(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *l)
{
    gvi_real d, sum, others = 0;
    int i = gvi__term(n, x, w, t, &d, &sum);
    for (int j = 0; j < n; ++j)
        if (j != i) {
            l[j] = gvi__slope(n, x, w, t, i, d, sum, j);
            others += l[j];
        }
    l[i] = -others;                                   // sum l_j' = 0
}

GVI_DEF gvi_real gvi_interpolate_derivative(int n, const gvi_real *x, const gvi_real *w,
                                            const gvi_real *f, gvi_real t)
{
    gvi_real d, sum, value = 0;
    int i = gvi__term(n, x, w, t, &d, &sum);
    for (int j = 0; j < n; ++j)
        if (j != i) value += gvi__slope(n, x, w, t, i, d, sum, j)*(f[j] - f[i]);
    return value;
}

/* ----------------------------------------------------------------- SCENE */

#define GVI__HAS_VELOCITIES 1    /* an effect reads v                          */
#define GVI__HAS_LAGRANGIAN 2    /* an effect adds to dL/dv                    */
#define GVI__HAS_NEWTON     4    /* Newton is used, or ready as the fall-back  */
#define GVI__HAS_OWN        8    /* Gamma is a full matrix                     */
#define GVI__POSSIBLE ((GVI__READS_V ? GVI__HAS_VELOCITIES : 0)                                        \
                       | (GVI__LAGRANGIAN ? GVI__HAS_LAGRANGIAN : 0) | (GVI__NEWTON ? GVI__HAS_NEWTON : 0) \
                       | (GVI__OWN ? GVI__HAS_OWN : 0))

GVI__COPY int gvi__flag(int flags, int flag) { return (flags & GVI__POSSIBLE & flag) != 0; }
GVI__COPY int gvi__has(const gvi_stepper *st, int flag) { return gvi__flag(st->x.flags, flag); }

GVI__COPY int gvi__compiled(gvi_formulation f)
{
    return f == GVI_EXPLICIT ? GVI__EXPLICIT : f == GVI_POSITIONS ? GVI__POSITIONS
         : f == GVI_VELOCITIES ? GVI__VELOCITIES : f == GVI_MOMENTA ? GVI__MOMENTA
         : f == GVI_NEWTON ? GVI__NEWTON : 0;
}

// the only formulation that is compiled, else GVI_AUTO
GVI__COPY gvi_formulation gvi__only(void)
{
    const int several = GVI__EXPLICIT + GVI__POSITIONS + GVI__VELOCITIES + GVI__MOMENTA + GVI__NEWTON > 1;
    return several ? GVI_AUTO : GVI__EXPLICIT ? GVI_EXPLICIT : GVI__POSITIONS ? GVI_POSITIONS
         : GVI__VELOCITIES ? GVI_VELOCITIES : GVI__MOMENTA ? GVI_MOMENTA : GVI_NEWTON;
}

GVI__COPY int gvi__chosen_is(gvi_formulation chosen, gvi_formulation f)
{
    return gvi__compiled(f) && (gvi__only() == f || chosen == f);
}

GVI__COPY int gvi__has_mass(const gvi_desc *d, gvi_mass_kind kind)
{
    return (kind != GVI_MASS_DENSE || GVI__DENSE) && (kind != GVI_MASS_NONE || GVI__LAGRANGIAN)
        && (kind != GVI_MASS_POSITION || GVI__MOMENTA || GVI__NEWTON) && d->mass.kind == kind;
}

GVI__COPY int gvi__has_rule(const gvi_desc *d, gvi_rule_kind kind)
{
    return (kind != GVI_OWN || GVI__OWN) && (kind != GVI_KICKS || GVI__EXPLICIT) && d->rule.kind == kind;
}

// is f the formulation of this scene?  and the same of its mass and its rule
GVI__COPY int gvi__uses(const gvi_stepper *st, gvi_formulation f)
{
    return gvi__chosen_is(st->x.chosen, f);
}

GVI__COPY int gvi__mass_is(const gvi_stepper *st, gvi_mass_kind kind)
{
    return gvi__has_mass(&st->x.desc, kind);
}

GVI__COPY int gvi__rule_is(const gvi_stepper *st, gvi_rule_kind kind)
{
    return gvi__has_rule(&st->x.desc, kind);
}

// was it Newton's method that made the step, or is it now?
GVI__COPY int gvi__by_newton(const gvi_stepper *st) { return GVI__NEWTON && st->formulation == GVI_NEWTON; }

// does a step, or a start, look for the effect whose values are not finite?
GVI__COPY int gvi__diagnoses(const gvi_stepper *st) { return GVI__DIAGNOSIS && st->x.diagnose; }

// is the number of iterations given, and not a matter of a tolerance?
GVI__COPY int gvi__counts(const gvi_stepper *st) { return !GVI__TOLERANCE || st->x.desc.iterations > 0; }

// 64 bits, which take a small machine several instructions
GVI__APART void gvi__count(unsigned long long *counter, int more) { *counter += (unsigned long long)more; }

static gvi_status gvi__fail(gvi_stepper *st, gvi_status status, int effect, int coordinate, int point)
{
    st->fault.effect = effect;
    st->fault.coordinate = coordinate;
    st->fault.point = point;
    return st->status = status;
}

// an effect is to blame, or the mass, but no coordinate or point; or none of them
GVI__DEEP gvi_status gvi__blame(gvi_stepper *st, gvi_status status, int effect)
{
    return gvi__fail(st, status, effect, GVI_FAULT_NONE, GVI_FAULT_NONE);
}

GVI__DEEP gvi_status gvi__give(gvi_stepper *st, gvi_status status)
{
    return gvi__blame(st, status, GVI_FAULT_NONE);
}

/* Of a stepper that is not set up or not started: the first failure stands, so
   that a chain of calls ends with its cause.                                  */
GVI__DEEP gvi_status gvi__unready(gvi_stepper *st)
{
    return st->status != GVI_OK ? st->status : (st->status = GVI_E_STATE);
}

static gvi_status gvi__done(gvi_stepper *st, gvi_status status)
{
    return status == GVI_OK ? gvi__give(st, GVI_OK) : (st->status = status);
}

// the first entry of rows [n][count] that is not finite is the fault
static gvi_status gvi__check_rows(gvi_stepper *st, const gvi_points *x, const gvi_real *rows, int effect)
{
    // one point is one row: all numbers at a time
    if (!GVI__SMALL && rows && x->stride == 1 && gvi__all_finite(x->n, rows)) return GVI_OK;
    for (int i = 0; rows && i < x->n; ++i)
        for (int k = 0; k < x->count; ++k)
            if (!gvi__finite(rows[i*x->stride + k])) return gvi__fail(st, GVI_E_NON_FINITE, effect, i, k);
    return GVI_OK;
}

// a column of rows [n][stride]
static void gvi__gather(int n, int stride, const gvi_real *rows, gvi_real *out)
{
    for (; n > 0; --n, rows += stride) *out++ = *rows;
}

// q and v at point k to `one`, and no f and dldv behind them
static void gvi__take_point(const gvi_points *x, int k, gvi_real *one)
{
    const int n = x->n;
    gvi__gather(n, x->stride, x->q + k, one);
    if (GVI__READS_V && x->v) gvi__gather(n, x->stride, x->v + k, one + n);
    gvi__zero(2*(size_t)n, one + 2*n);
}

// what was added to them goes to the rows
static void gvi__give_point(const gvi_points *x, int k, const gvi_real *one)
{
    const int n = x->n;
    gvi_real *dldv = GVI__LAGRANGIAN ? x->dldv : NULL;
    for (int i = 0; i < n; ++i, k += x->stride) {
        x->f[k] += one[2*n + i];
        if (dldv) dldv[k] += one[3*n + i];
    }
}

// the one-point form: gather, call, scatter.  Returns 0, or 1 + the point that was refused
static inline int gvi__point_by_point(gvi_stepper *st, const gvi_effect *e, const gvi_points *x)
{
    for (int k = 0; k < x->count; ++k) {
        gvi__take_point(x, k, st->x.one);
        const int n = x->n;
        gvi_real *one = st->x.one;
        if (e->point(x->t[k], one, GVI__READS_V && x->v ? one + n : NULL, one + 2*n,
                     GVI__LAGRANGIAN && x->dldv ? one + 3*n : NULL, e->user)) return 1 + k;
        gvi__give_point(x, k, st->x.one);
    }
    return 0;
}

/* In the diagnosing repetition: were the points finite that the effects will get?
   If not the step itself has run away.                                        */
static gvi_status gvi__check_points(gvi_stepper *st, const gvi_points *x)
{
    if (!gvi__diagnoses(st)) return GVI_OK;
    if (gvi__check_rows(st, x, x->q, GVI_FAULT_NONE) == GVI_OK
        && (!GVI__READS_V || gvi__check_rows(st, x, x->v, GVI_FAULT_NONE) == GVI_OK)) return GVI_OK;
    return gvi__give(st, GVI_E_CONVERGENCE);
}

// without diagnosis: are f and dldv finite, which gvi__at has put side by side?
static inline gvi_status gvi__finite_here(gvi_stepper *st, const gvi_points *x)
{
    return GVI__DIAGNOSIS || gvi__all_finite(2*x->n, x->f) ? GVI_OK : gvi__give(st, GVI_E_NON_FINITE);
}

// the value callback of effect e: adds to `value` at the points; x->value is NULL before and after
GVI__DEEP gvi_status gvi__value(gvi_stepper *st, gvi_points *x, int e, gvi_real *value)
{
    const gvi_effect *effect = st->x.desc.effects + e;
    if (!effect->value) return gvi__blame(st, GVI_E_VALUE, e);
    gvi_real *f = x->f, *dldv = x->dldv;
    x->f = x->dldv = NULL;
    x->value = value;
    const int refused = effect->value(x, effect->user);
    x->f = f;
    x->dldv = dldv;
    x->value = NULL;
    return refused ? gvi__blame(st, GVI_E_CALLBACK, e) : GVI_OK;
}

/* Asks effect e where it is not one call for all points and no more: one point a
   call; with x->value (clock) V goes there and L to x.less, in the same call if it
   can be; and in the diagnosing repetition what it added is looked at.        */
GVI__DEEP gvi_status gvi__effect(gvi_stepper *st, gvi_points *x, int e)
{
    const gvi_effect *effect = st->x.desc.effects + e;
    gvi_real *value = GVI__CLOCK ? x->value : NULL;
    gvi_real *own = value && effect->kind == GVI_LAGRANGIAN ? st->x.less
                  : effect->kind == GVI_FORCE ? NULL : value;
    const int whole = !GVI__POINT || effect->points;
    gvi__count(&st->counters.effect[e], x->count);
    x->value = whole && effect->value == effect->points ? own : NULL;
    const int refused = whole ? effect->points(x, effect->user) : gvi__point_by_point(st, effect, x);
    gvi_status status = !refused ? GVI_OK : gvi__fail(st, GVI_E_CALLBACK, e, GVI_FAULT_NONE,
                                                      whole ? GVI_FAULT_NONE : refused - 1);
    if (gvi__diagnoses(st) && status == GVI_OK) {
        status = gvi__check_rows(st, x, x->f, e);
        if (status == GVI_OK && GVI__LAGRANGIAN) status = gvi__check_rows(st, x, x->dldv, e);
    }
    if (status == GVI_OK && own && !x->value) status = gvi__value(st, x, e, own);
    x->value = value;
    for (int k = 0; own && gvi__diagnoses(st) && status == GVI_OK && k < x->count; ++k)
        if (!gvi__finite(own[k])) status = gvi__fail(st, GVI_E_NON_FINITE, e, GVI_FAULT_NONE, k);
    return status;
}

static unsigned gvi__clock_bit(const gvi_stepper *st)
{
    return GVI__CLOCK && st->x.clock >= 0 ? 1u << st->x.clock : 0;
}

// is there a clock, and is it on?
static int gvi__has_clock(const gvi_stepper *st) { return (gvi__clock_bit(st) & ~st->x.off) != 0; }

// an effect that takes all points in a call
static inline gvi_status gvi__call(gvi_stepper *st, const gvi_points *x, int e)
{
    const gvi_effect *effect = st->x.desc.effects + e;
    gvi__count(&st->counters.effect[e], x->count);
    const int refused = effect->points(x, effect->user);
    return refused ? gvi__blame(st, GVI_E_CALLBACK, e) : GVI_OK;
}

/* Every effect that is on, but the clock and what has its bit in `skip`: adds to
   x->f and x->dldv.  An effect sees only what its kind may read.  Fields of x are
   lent and taken back one by one: a copied struct would have to wait for its stores. */
static gvi_status gvi__effects(gvi_stepper *st, gvi_points *x, unsigned skip)
{
    const gvi_real *v = x->v;
    gvi_real *dldv = x->dldv;
    gvi_status status = GVI_OK;
    skip |= st->x.off | gvi__clock_bit(st);
    for (int e = 0; e < st->x.desc.effect_count && status == GVI_OK; ++e) {
        const gvi_effect *effect = st->x.desc.effects + e;
        if (skip >> e & 1u) continue;
        x->v = GVI__READS_V && effect->kind != GVI_POTENTIAL ? v : NULL;
        x->dldv = GVI__LAGRANGIAN && effect->kind == GVI_LAGRANGIAN ? dldv : NULL;
        const int plain = !(GVI__CLOCK && x->value) && !gvi__diagnoses(st);
        status = plain && (!GVI__POINT || effect->points) ? gvi__call(st, x, e) : gvi__effect(st, x, e);
    }
    x->v = v;
    x->dldv = dldv;
    return status;
}

/* The only effect that is on, if it takes all points in a call and is neither a
   Lagrangian term nor beside a clock; or -1, as always where size counts.      */
static signed char gvi__single(const gvi_stepper *st)
{
    signed char single = -1;
    for (int e = 0; !GVI__SMALL && e < st->x.desc.effect_count; ++e) {
        const gvi_effect *effect = st->x.desc.effects + e;
        if (st->x.off >> e & 1u) continue;
        if (single >= 0 || !effect->points || effect->kind > GVI_FORCE) return -1;
        single = (signed char)e;
    }
    return single;
}

// the bits of the effects that are marked as weak and may stand still for a while
static unsigned gvi__marks(const gvi_desc *d)
{
    unsigned bits = 0;
    if (d->degree == 1 && d->rule.kind != GVI_GAUSS) return 0;     // the rows do not see a force at the end
    for (int e = 0; GVI__WEAK && d->iterations == 0 && e < d->effect_count; ++e) {
        if (d->effects[e].kind == GVI_CLOCK) return 0;
        if (d->effects[e].weak && d->effects[e].kind <= GVI_FORCE) bits |= 1u << e;
    }
    return bits;
}

// all effects that are on; nothing stands between a step and its only effect
static inline gvi_status gvi__all_effects(gvi_stepper *st, gvi_points *x)
{
    const int e = GVI__SMALL ? -1 : st->x.single;
    if (e < 0 || gvi__diagnoses(st)) return gvi__effects(st, x, 0);
    const gvi_effect *effect = st->x.desc.effects + e;
    const gvi_real *v = x->v;
    gvi_real *dldv = x->dldv;
    if (effect->kind == GVI_POTENTIAL) x->v = NULL;
    x->dldv = NULL;
    const gvi_status status = gvi__call(st, x, e);
    x->v = v;
    x->dldv = dldv;
    return status;
}

// the bits of all effects of a kind
static unsigned gvi__of_kind(const gvi_stepper *st, gvi_kind kind)
{
    unsigned bits = 0;
    for (int e = 0; e < st->x.desc.effect_count; ++e)
        if (st->x.desc.effects[e].kind == kind) bits |= 1u << e;
    return bits;
}

// the bits of those that are on and bring no Hessian
static unsigned gvi__without_hessian(const gvi_stepper *st)
{
    unsigned bits = 0;
    for (int e = 0; e < st->x.desc.effect_count; ++e)
        if (!st->x.desc.effects[e].hessian) bits |= 1u << e;
    return bits & ~st->x.off;
}

// eight points as one to four vectors for the compiler: of wider ones than its registers it
// keeps sums in memory
#if defined(__GNUC__) && GVI__KIND < 3 && defined(GVI__EXACT_TYPES) \
    && (defined(__SSE2__) || defined(__ARM_NEON) || defined(__ALTIVEC__) || defined(__riscv_vector))
#define GVI__VECTORS
#if defined(__AVX512F__) || (defined(__AVX__) && GVI__KIND == 1)
#define GVI__LANES 8
#elif defined(__AVX__) || GVI__KIND == 1
#define GVI__LANES 4
#else
#define GVI__LANES 2
#endif
typedef gvi_real gvi__vector
    __attribute__((vector_size(GVI__LANES*sizeof(gvi_real)), aligned(sizeof(gvi_real)), may_alias));
#define GVI__AT(p) (*(const gvi__vector *)(p))
#if !defined(__clang__) && __GNUC__ >= 8
#define GVI__EACH _Pragma("GCC unroll 8")             // with -O2, too: else vectors are arrays
#define GVI__BY_FOUR _Pragma("GCC unroll 4")          // the compiler's vectors of a loop of any length
#define GVI__ROLLED _Pragma("GCC unroll 1")
#else
#define GVI__EACH
#endif
#endif
#ifndef GVI__BY_FOUR
#define GVI__BY_FOUR
#define GVI__ROLLED
#endif

// there are vectors, and room for the code that they want.  What few steps call is apart then, so
// that what every step calls has fewer vectors to save
#if defined(GVI__VECTORS) && !GVI__SMALL
#define GVI__WIDE 1
#define GVI__SELDOM static __attribute__((noinline))
#define GVI__FITTED GVI__COPY                         // a copy for each of the usual sizes
#else
#define GVI__WIDE 0
#define GVI__SELDOM static
#define GVI__FITTED GVI__APART
#endif

#define GVI__PIECES (GVI__WIDE && GVI__POSITIONS)     // steps of two or three coordinates in one piece

/* L D L' of a symmetric matrix at each of `count` points, in place: entry (i,j), i >= j,
   of point k at [(i*n + j)*stride + k].  L below the diagonal, 1/D on it, and above
   it D L', which the rest of the matrix is made with.  A pivot that is nothing but
   rounding of its diagonal entry is a coordinate without mass.                */
GVI__APART gvi_status gvi__ldl_factor(gvi_stepper *st, int n, int stride, int count, gvi_real *m)
{
    const size_t N = (size_t)n, R = (size_t)stride;
    for (size_t j = 0; j < N; ++j) {
        gvi_real *d = m + (j*N + j)*R;
        for (size_t k = 0; k < (size_t)count; ++k) {
            const gvi_real was = GVI_ABS(d[k]);
            gvi_real rest = d[k];
            for (size_t l = 0; l < j; ++l) rest -= m[(j*N + l)*R + k]*m[(l*N + j)*R + k];
            const gvi_status status = !(was <= GVI__MAX) || !gvi__finite(rest) ? GVI_E_NON_FINITE
                : !(GVI_ABS(rest) > (gvi_real)n*GVI__EPS*was) || !gvi__finite(d[k] = 1/rest) ? GVI_E_SINGULAR : GVI_OK;
            if (status != GVI_OK) return gvi__fail(st, status, GVI_FAULT_MASS, (int)j, (int)k);
        }
        for (size_t i = j + 1; i < N; ++i) {
            gvi_real *a = m + (i*N + j)*R, *b = m + (j*N + i)*R;
            for (size_t l = 0; l < j; ++l) {
                const gvi_real *x = m + (j*N + l)*R, *y = m + (l*N + i)*R;
                for (int k = 0; k < count; ++k) a[k] -= x[k]*y[k];
            }
            for (int k = 0; k < count; ++k) {
                b[k] = a[k];
                a[k] *= d[k];
            }
        }
    }
    return GVI_OK;
}

// solves in rows z [n][stride]; each entry of the matrix is `width` numbers, one a point, or one for all
static void gvi__ldl_solve(int n, const gvi_real *m, int width, gvi_real *z, int stride, int count)
{
    const int each = width > 1;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            const gvi_real *a = m + (size_t)(i*n + j)*(size_t)width;
            for (int k = 0; k < count; ++k) z[i*stride + k] -= a[k*each]*z[j*stride + k];
        }
    for (int i = n; i-- > 0; ) {
        const gvi_real *d = m + (size_t)(i*n + i)*(size_t)width;
        for (int k = 0; k < count; ++k) z[i*stride + k] *= d[k*each];
        for (int j = i + 1; j < n; ++j) {
            const gvi_real *a = m + (size_t)(j*n + i)*(size_t)width;
            for (int k = 0; k < count; ++k) z[i*stride + k] -= a[k*each]*z[j*stride + k];
        }
    }
}

#ifdef GVI__VECTORS
/* The same, a vector of points at a time.  Returns whether all pivots D are sure: the squares of
   what they were in units of what they are, and of what rounding leaves of D/D - 1, do not
   add up to (1/(n eps))^2.  If they do, gvi__ldl_factor has to decide.  (That l < N follows
   from l < j; gcc -O1, with n known, does not see it and warns.)              */
GVI__COPY int gvi__ldl_factor_vector(int n, size_t R, gvi_real *m)
{
    const size_t N = (size_t)n;
    const gvi_real most = 1/((gvi_real)n*GVI__EPS);
    gvi__vector sum = { 0 };
    for (size_t j = 0; j < N; ++j) {
        gvi_real *at = m + (j*N + j)*R;
        gvi__vector rest = GVI__AT(at);
        for (size_t l = 0; l < j && l < N; ++l) rest -= GVI__AT(m + (j*N + l)*R)*GVI__AT(m + (l*N + j)*R);
        const gvi__vector inverse = 1/rest, loss = GVI__AT(at)*inverse, off = rest*inverse - 1;
        sum += loss*loss + off*off;
        *(gvi__vector *)at = inverse;
        for (size_t i = j + 1; i < N; ++i) {
            gvi_real *a = m + (i*N + j)*R;
            rest = GVI__AT(a);
            for (size_t l = 0; l < j && l < N; ++l) rest -= GVI__AT(m + (j*N + l)*R)*GVI__AT(m + (l*N + i)*R);
            *(gvi__vector *)(m + (j*N + i)*R) = rest;
            *(gvi__vector *)a = rest*inverse;
        }
    }
    gvi_real all = 0;
    for (int k = 0; k < GVI__LANES; ++k) all += sum[k];
    return all < most*most;
}

// z := M^-1 from, which may be z
GVI__COPY void gvi__ldl_solve_vector(int n, size_t R, const gvi_real *m, const gvi_real *from, gvi_real *z)
{
    const size_t N = (size_t)n;
    for (size_t i = 0; i < N; ++i) {
        gvi__vector rest = GVI__AT(from + i*R);
        for (size_t j = 0; j < i; ++j) rest -= GVI__AT(m + (i*N + j)*R)*GVI__AT(z + j*R);
        *(gvi__vector *)(z + i*R) = rest;
    }
    for (size_t i = N; i-- > 0; ) {
        gvi__vector rest = GVI__AT(z + i*R)*GVI__AT(m + (i*N + i)*R);
        for (size_t j = i + 1; j < N; ++j) rest -= GVI__AT(m + (j*N + i)*R)*GVI__AT(z + j*R);
        *(gvi__vector *)(z + i*R) = rest;
    }
}

static int gvi__ldl_factor_eights(int n, int R, gvi_real *m)
{
    int sure = 1;
    for (int o = 0; o < R; o += GVI__LANES)
        sure &= n == 2 && R == 8 ? gvi__ldl_factor_vector(2, 8, m + o)
              : n == 2 ? gvi__ldl_factor_vector(2, (size_t)R, m + o) : gvi__ldl_factor_vector(n, (size_t)R, m + o);
    return sure;
}

static void gvi__ldl_solve_eights(int n, int R, const gvi_real *m, const gvi_real *from, gvi_real *z)
{
    for (int o = 0; o < R; o += GVI__LANES)
        if (n == 2 && R == 8) gvi__ldl_solve_vector(2, 8, m + o, from + o, z + o);
        else if (n == 2) gvi__ldl_solve_vector(2, (size_t)R, m + o, from + o, z + o);
        else gvi__ldl_solve_vector(n, (size_t)R, m + o, from + o, z + o);
}
#endif

static int gvi__mass_is_constant(const gvi_desc *d)
{
    return !(GVI__MOMENTA || GVI__NEWTON || GVI__LAGRANGIAN) || d->mass.kind <= GVI_MASS_DENSE;
}

// rows z := M^-1 z, constant mass
static void gvi__over_mass(const gvi_stepper *st, gvi_real *z, int stride, int count)
{
    int n = st->n;
    if (gvi__mass_is(st, GVI_MASS_DENSE)) gvi__ldl_solve(n, st->x.mass, 1, z, stride, count);
    if (st->x.desc.mass.kind == GVI_MASS_DIAGONAL)
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < count; ++k) z[i*stride + k] *= st->x.over[i];
}

// v := M^-1 p at one point, constant mass
static void gvi__over_constant_mass(const gvi_stepper *st, const gvi_real *GVI__RESTRICT p,
                                    gvi_real *GVI__RESTRICT v)
{
    const int diagonal = st->x.desc.mass.kind == GVI_MASS_DIAGONAL;
    for (int i = 0; i < st->n; ++i) v[i] = diagonal ? p[i]*st->x.over[i] : p[i];
    if (gvi__mass_is(st, GVI_MASS_DENSE)) gvi__over_mass(st, v, 1, 1);
}

/* Asks mass.points for M(q) at the points, or mass.velocity, which reads p, for v.   */
static gvi_status gvi__ask_mass(gvi_stepper *st, gvi_points *x, const gvi_real *p, gvi_real *v)
{
    const gvi_mass *mass = &st->x.desc.mass;
    const gvi_real *reads = x->v;
    gvi_real *f = x->f, *dldv = x->dldv;
    x->v = NULL;
    x->f = x->dldv = NULL;
    x->p = p;
    x->velocity = v;
    x->mass = v ? NULL : st->x.point_mass;
    gvi__count(&st->counters.mass, x->count);
    const int refused = v ? mass->velocity(x, mass->user) : mass->points(x, mass->user);
    x->p = NULL;
    x->mass = x->velocity = NULL;
    x->v = reads;
    x->f = f;
    x->dldv = dldv;
    return refused ? gvi__blame(st, GVI_E_CALLBACK, GVI_FAULT_MASS) : GVI_OK;
}

#ifdef GVI__VECTORS
// M(q) at the points, and behind the last as at the first, factored; not where a pivot is doubtful
static int gvi__factor_eights(gvi_stepper *st, const gvi_points *x)
{
    const int n = st->n, R = x->stride;
    gvi_real *m = st->x.point_mass;
    if (R % 8 != 0) return 0;
    for (size_t i = 0; i < (size_t)n && x->count < R; ++i)
        for (size_t j = 0; j <= i; ++j) {
            gvi_real *entry = m + (i*(size_t)n + j)*(size_t)R;
            for (int k = x->count; k < R; ++k) entry[k] = entry[0];
        }
    return gvi__ldl_factor_eights(n, R, m);
}
#endif

// M(q) at the points, factored
static gvi_status gvi__factor_at(gvi_stepper *st, gvi_points *x)
{
    gvi_status status = gvi__ask_mass(st, x, NULL, NULL);
    if (status != GVI_OK) return status;
    gvi__count(&st->counters.factorizations, x->count);
#ifdef GVI__VECTORS
    if (gvi__factor_eights(st, x)) return GVI_OK;
    if (x->stride % 8 == 0) {
        // once more, one by one, and once counted; what is behind the last point is to stay finite
        const unsigned long long asked = st->counters.mass;
        gvi__zero((size_t)x->n*(size_t)x->n*(size_t)x->stride, st->x.point_mass);
        status = gvi__ask_mass(st, x, NULL, NULL);
        st->counters.mass = asked;
        if (status != GVI_OK) return status;
    }
#endif
    return gvi__ldl_factor(st, x->n, x->stride, x->count, st->x.point_mass);
}

// x->f += v' dM/dq v / 2
static gvi_status gvi__mass_gradient(gvi_stepper *st, gvi_points *x)
{
    const gvi_mass *mass = &st->x.desc.mass;
    gvi_real *dldv = x->dldv;
    x->dldv = NULL;
    const int refused = mass->gradient(x, mass->user);
    x->dldv = dldv;
    if (refused) return gvi__blame(st, GVI_E_CALLBACK, GVI_FAULT_MASS);
    return gvi__diagnoses(st) ? gvi__check_rows(st, x, x->f, GVI_FAULT_MASS) : GVI_OK;
}

// x->dldv += M v, each entry of a full matrix `width` numbers; width 0: of a diagonal one, or 1 if m is NULL
GVI__DEEP void gvi__add_momenta(const gvi_points *x, const gvi_real *m, int width)
{
    const int n = x->n, R = x->stride, each = width > 1;
    for (int i = 0; i < n; ++i) {
        gvi_real *p = x->dldv + i*R;
        if (width == 0)
            for (int k = 0; k < x->count; ++k) p[k] += (m ? m[i] : 1)*x->v[i*R + k];
        for (int j = 0; width > 0 && j < n; ++j) {
            const gvi_real *a = m + (size_t)(i >= j ? i*n + j : j*n + i)*(size_t)width;
            for (int k = 0; k < x->count; ++k) p[k] += a[k*each]*x->v[j*R + k];
        }
    }
}

/* The kinetic energy's share: x->dldv += M v, and for M(q) the gradient.      */
static gvi_status gvi__kinetic(gvi_stepper *st, gvi_points *x)
{
    const size_t nn = (size_t)x->n*(size_t)x->n;
    if (gvi__mass_is(st, GVI_MASS_NONE)) return GVI_OK;
    if (gvi__mass_is(st, GVI_MASS_DENSE)) gvi__add_momenta(x, st->x.mass + nn, 1);
    else if (gvi__mass_is(st, GVI_MASS_POSITION)) {
        gvi_status status = gvi__ask_mass(st, x, NULL, NULL);
        if (status == GVI_OK) status = gvi__mass_gradient(st, x);
        if (status != GVI_OK) return status;
        gvi__add_momenta(x, st->x.point_mass, x->stride);
    } else gvi__add_momenta(x, st->x.mass, 0);
    return gvi__diagnoses(st) ? gvi__check_rows(st, x, x->dldv, GVI_FAULT_MASS) : GVI_OK;
}

/* F and P at the points from scratch: everything (plain = 0), or what has no
   Hessian (plain = 1: those effects, and M(q)).                               */
static gvi_status gvi__evaluate(gvi_stepper *st, gvi_points *x, int plain)
{
    size_t length = (size_t)x->n*(size_t)x->stride;
    gvi_status status = gvi__check_points(st, x);
    if (status != GVI_OK) return status;
    gvi__zero(length, x->f);
    gvi__zero(length, x->dldv);
    if (!plain || !gvi__mass_is_constant(&st->x.desc)) status = gvi__kinetic(st, x);
    return status == GVI_OK ? gvi__effects(st, x, plain ? ~gvi__without_hessian(st) : 0) : status;
}

// one point, as gvi_points; f and dldv go to scratch
static void gvi__at(gvi_points *x, const gvi_stepper *st, const gvi_real *t, const gvi_real *q)
{
    x->n = st->n;
    x->count = x->stride = 1;
    x->t = t;
    x->q = q;
    x->v = x->p = NULL;
    x->f = st->x.one + 4*st->n;
    x->dldv = x->f + st->n;
    x->value = x->mass = x->velocity = NULL;
}

// the difference for v_j to begin with
GVI__APART gvi_real gvi__first_difference(int n, const gvi_real *v, int j)
{
    const gvi_real root = GVI_SQRT(GVI__EPS);
    const gvi_real d = root*(gvi__nonzero(v[j]) ? GVI_ABS(v[j]) : gvi__norm1(n, v)/(gvi_real)n);
    return d > GVI__MIN/GVI__EPS ? d : root;
}

// less than d where that leaves the domain of L, more where P_j, which need not be 0 with v, hides it;
// 0: d will do
GVI__APART gvi_real gvi__other_difference(gvi_real d, gvi_real moved, gvi_real base)
{
    const gvi_real root = GVI_SQRT(GVI__EPS);
    if (!gvi__finite(moved)) return d*root;
    return GVI_ABS(moved - base) < root*GVI_ABS(base)/2 ? d/GVI_SQRT(root) : 0;
}

GVI__APART void gvi__velocity_column(const gvi_stepper *st, const gvi_points *x, int j, gvi_real d)
{
    const int n = st->n;
    const gvi_real *base = st->x.hess;
    gvi_real *W = st->x.hess + 3*n;
    for (int i = 0; i < n; ++i) W[i*n + j] = (x->dldv[i] - base[i])/d;
}

// d(dL/dv)/dv at one point, n*n, by differences, to x.hess + 3n.  x has been evaluated; x->v is v
static gvi_status gvi__velocity_hessian(gvi_stepper *st, gvi_points *x, gvi_real *v)
{
    const int n = st->n;
    gvi__copy((size_t)n, x->dldv, st->x.hess);
    for (int j = 0; j < n; ++j) {
        const gvi_real was = v[j];
        gvi_real d = 0, next = gvi__first_difference(n, v, j);
        for (int k = 0; k < 12 && next > 0; ++k) {
            v[j] = was + next;
            gvi_status status = gvi__evaluate(st, x, 0);
            d = v[j] - was;
            v[j] = was;
            if (status != GVI_OK) return status;
            next = gvi__other_difference(d, x->dldv[j], st->x.hess[j]);
        }
        gvi__velocity_column(st, x, j, d);
    }
    gvi__copy((size_t)n, st->x.hess, x->dldv);
    return GVI_OK;
}

/* General Legendre transform at one point: Newton's method for dL/dv(v) = p
   from the v given.  Ends when the correction stops shrinking.                */
static gvi_status gvi__legendre_newton(gvi_stepper *st, gvi_points *x, const gvi_real *p, gvi_real *v)
{
    int n = st->n;
    gvi_real *W = st->x.hess + 3*n, *pivot = W + n*n, *dv = st->x.hess + 2*n;
    x->v = v;
    const gvi_real *P = x->dldv;
    gvi_real last = GVI__MAX;
    gvi__count(&st->counters.velocities, 1);
    for (int k = 0; k < 40; ++k) {
        gvi_real change = 0;
        gvi_status status = gvi__evaluate(st, x, 0);

        // beyond the domain of L (faster than light): half the way
        if (k > 0 && status == GVI_OK && !gvi__all_finite(n, P)) {
            for (int i = 0; i < n; ++i) {
                dv[i] /= 2;
                v[i] -= dv[i];
            }
            continue;
        }
        if (status == GVI_OK) status = gvi__velocity_hessian(st, x, v);
        if (status != GVI_OK) return status;
        int at;
        status = gvi__lu_factor(n, W, pivot, &at);
        gvi__count(&st->counters.factorizations, 1);
        if (status != GVI_OK) return gvi__fail(st, status, GVI_FAULT_MASS, at, GVI_FAULT_NONE);
        for (int i = 0; i < n; ++i) dv[i] = p[i] - P[i];
        gvi_lu_solve(n, W, pivot, dv);
        for (int i = 0; i < n; ++i) {
            v[i] += dv[i];
            if (gvi__nonzero(dv[i])) change += GVI_ABS(dv[i])/(GVI_ABS(dv[i]) + GVI_ABS(v[i]));
        }
        if (!(change <= GVI__MAX)) break;
        if (!(change > 2*GVI__EPS) || (change >= last/2 && change <= GVI_SQRT(GVI__EPS))) return GVI_OK;
        last = change;
    }
    return gvi__blame(st, GVI_E_CONVERGENCE, GVI_FAULT_MASS);
}

// velocities near the present ones: those at the end of the last step, or the start's
static void gvi__velocity_guess(const gvi_stepper *st, gvi_real *v)
{
    const struct gvi__private *x = &st->x;
    if (GVI__READS_V && x->has_velocity) gvi__gather(st->n, x->stride, x->last.V + st->r - 1, v);
    else gvi__copy((size_t)st->n, x->start, v);
}

/* v from p at one point.  v holds a guess on entry.                           */
static gvi_status gvi__velocity(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p,
                                gvi_real *v)
{
    gvi_points x;
    gvi__at(&x, st, &t, q);
    if (st->x.desc.mass.velocity) {
        const gvi_status status = gvi__ask_mass(st, &x, p, v);
        return status == GVI_OK ? gvi__check_rows(st, &x, v, GVI_FAULT_MASS) : status;
    }
    if (gvi__mass_is(st, GVI_MASS_NONE) || gvi__has(st, GVI__HAS_LAGRANGIAN))
        return gvi__legendre_newton(st, &x, p, v);
    gvi__copy((size_t)st->n, p, v);
    if (gvi__mass_is(st, GVI_MASS_POSITION)) {
        gvi_status status = gvi__factor_at(st, &x);
        if (status != GVI_OK) return status;
        gvi__ldl_solve(st->n, st->x.point_mass, 1, v, 1, 1);
        gvi__count(&st->counters.velocities, 1);
    } else gvi__over_mass(st, v, 1, 1);
    return GVI_OK;
}

/* ---------------------------------------------------------------- TABLES */

/* phi_k = P_k(x) and Phi_k = (P_(k-1) - P_(k+1))(x) / (2(2k+1)), P_(-1) = 1, at
   `count` nodes from `first` on, x = 1 - 2c, in twofold arithmetic: [k*stride + node].
   The low parts of Phi go to E, which is not yet in use; phi is skipped where
   nobody needs it.                                                            */
GVI__APART void gvi__modes_at(gvi_stepper *st, int first, int count)
{
    struct gvi__private *x = &st->x;
    gvi__nodes X, P, before, Phi;
    for (int i = 0; i < GVI__NODES; ++i) {
        const int at = first + (i < count ? i : 0);
        gvi__set_node(&X, i, gvi__argument2(gvi__two_of(x->c[at], x->t[at])));
        gvi__set_node(&P, i, gvi__real2(1));
        gvi__set_node(&before, i, gvi__real2(1));
    }
    for (int k = 0; k < st->s; ++k) {
        Phi = before;
        gvi__legendre2(k, &X, &P, &before);
        for (int i = 0; i < GVI__NODES; ++i)
            gvi__set_node(&Phi, i, gvi__over2(gvi__sub2(gvi__node(&Phi, i), gvi__node(&P, i)), 4*k + 2));
        for (int i = 0, at = k*x->stride + first; i < count; ++i, ++at) {
            x->Phi[at] = Phi.hi[i];
            x->E[at] = Phi.lo[i];
            if (!x->phi) continue;
            x->phi[at] = before.hi[i];
            x->low[at] = before.lo[i];
        }
    }
}

// the same at node i, which is 1 - c of another: P_k(-x) = (-1)^k P_k(x)
static void gvi__modes_mirrored(gvi_stepper *st, int i)
{
    struct gvi__private *x = &st->x;
    const int back = st->r - 1 - 2*i;
    x->Phi[i] = x->c[i];
    x->E[i] = x->t[i];
    for (int k = 0, at = i; k < st->s; ++k, at += x->stride) {
        const gvi_real sign = k % 2 ? -(gvi_real)1 : (gvi_real)1;
        if (k > 0) x->Phi[at] = 0 - sign*x->Phi[at + back];
        if (k > 0) x->E[at] = 0 - sign*x->E[at + back];
        if (x->phi) {
            x->phi[at] = sign*x->phi[at + back];
            x->low[at] = sign*x->low[at + back];
        }
    }
}

// the same at all nodes, which then go to the grid of S, see gvi__tables
static void gvi__modes_at_nodes(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    const int r = st->r, whole = GVI__SMALL || gvi__rule_is(st, GVI_OWN), made = whole ? r : (r + 1)/2;
    for (int i = 0; i < made; i += GVI__NODES)
        gvi__modes_at(st, i, made - i < GVI__NODES ? made - i : GVI__NODES);
    for (int i = made; i < r; ++i) gvi__modes_mirrored(st, i);
    for (int i = 0; i < r; ++i) x->c[i] = gvi__grid(gvi__sum(x->c[i], x->t[i]), GVI__EPS/2);
}

// sum_i a_i b_i c_i, one after the other
static gvi_real gvi__dot3(int r, const gvi_real *a, const gvi_real *b, const gvi_real *c)
{
    gvi_real sum = 0;
    for (int i = 0; i < r; ++i) sum += a[i]*b[i]*c[i];
    return sum;
}

/* 1/Gamma_kk = 2k + 1 while the rule is exact for phi_k^2; Lobatto with r = s
   gives s - 1 for the last.  A rule of order u < 2s - 2 makes Gamma full: its
   LU is kept in x->own.                                                      */
static gvi_status gvi__gamma(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    int s = st->s, r = st->r, R = x->stride;
    for (int k = 0; k < s; ++k) x->inv_gamma[k] = (gvi_real)(2*k + 1);
    if (st->order == 2*s - 2) {
        const gvi_real *last = x->phi + (s - 1)*R, sum = gvi__dot3(r, x->b, last, last);
        if (!(GVI_ABS(sum) > (gvi_real)s*GVI__EPS)) return GVI_E_POINTS;
        x->inv_gamma[s-1] = x->desc.rule.kind == GVI_LOBATTO ? (gvi_real)(s - 1) : 1/sum;
    }
    if (!gvi__has(st, GVI__HAS_OWN)) return GVI_OK;
    for (int k = 0; k < s; ++k)
        for (int l = 0; l < s; ++l) x->own[k*s + l] = gvi__dot3(r, x->b, x->phi + k*R, x->phi + l*R);
    return gvi_lu_factor(s, x->own, x->own + s*s) == GVI_OK ? GVI_OK : GVI_E_POINTS;
}

// y[k] := (Gamma^-1 y)[k]
static void gvi__over_gamma(const gvi_stepper *st, gvi_real *y)
{
    const struct gvi__private *x = &st->x;
    if (gvi__has(st, GVI__HAS_OWN)) gvi_lu_solve(st->s, x->own, x->own + st->s*st->s, y);
    else for (int k = 0; k < st->s; ++k) y[k] *= GVI__RULES ? x->inv_gamma[k] : (gvi_real)(2*k + 1);
}

enum { GVI__OF_S, GVI__OF_T, GVI__OF_N };

/* Without other rules: what Gauss has with r = s = 1..4, one after the other, from
   tests/gen/few.py: b; Phi and phi; S_ij, i <= j, and T_ij, i < j.  To be on their
   grids in any type, Phi_0 and S below 1/2 are there less 1, T plus 1/2.       */
#if !GVI__RULES
#if GVI__KIND == 1
#define GVI__C(x) x##f
#else
#define GVI__C(x) x
#endif
static const gvi_real gvi__few_b[] = {
    GVI__C(1.0), GVI__C(0.5), GVI__C(0.5), GVI__C(0.277777777777777777778), GVI__C(0.444444444444444444444),
    GVI__C(0.277777777777777777778), GVI__C(0.173927422568726928687), GVI__C(0.326072577431273071313),
    GVI__C(0.326072577431273071313), GVI__C(0.173927422568726928687)
};
static const gvi_real gvi__few_Phi[] = {
    GVI__C(0.5), GVI__C(-0.788675134594812882255), GVI__C(0.788675134594812882255),
    GVI__C(0.166666666666666666667), GVI__C(0.166666666666666666667), GVI__C(-0.887298334620741688518),
    GVI__C(0.5), GVI__C(0.887298334620741688518), GVI__C(0.1), GVI__C(0.25), GVI__C(0.1),
    GVI__C(0.0774596669241483377036), GVI__C(0.0), GVI__C(-0.0774596669241483377036),
    GVI__C(-0.930568155797026287612), GVI__C(-0.669990521792428132401), GVI__C(0.669990521792428132401),
    GVI__C(0.930568155797026287612), GVI__C(0.0646110632135476980776), GVI__C(0.221103222500738016208),
    GVI__C(0.221103222500738016208), GVI__C(0.0646110632135476980776), GVI__C(0.055638932663884638435),
    GVI__C(0.0751709043257755838678), GVI__C(-0.0751709043257755838678), GVI__C(-0.055638932663884638435),
    GVI__C(0.0437381157656224151096), GVI__C(-0.0233299525003162926606), GVI__C(-0.0233299525003162926606),
    GVI__C(0.0437381157656224151096)
};
static const gvi_real gvi__few_phi[] = {
    GVI__C(1.0), GVI__C(1.0), GVI__C(1.0), GVI__C(0.577350269189625764509), GVI__C(-0.577350269189625764509),
    GVI__C(1.0), GVI__C(1.0), GVI__C(1.0), GVI__C(0.774596669241483377036), GVI__C(0.0),
    GVI__C(-0.774596669241483377036), GVI__C(0.4), GVI__C(-0.5), GVI__C(0.4), GVI__C(1.0), GVI__C(1.0),
    GVI__C(1.0), GVI__C(1.0), GVI__C(0.861136311594052575224), GVI__C(0.339981043584856264803),
    GVI__C(-0.339981043584856264803), GVI__C(-0.861136311594052575224), GVI__C(0.612333620718713811535),
    GVI__C(-0.326619335004428097249), GVI__C(-0.326619335004428097249), GVI__C(0.612333620718713811535),
    GVI__C(0.304746984955206190874), GVI__C(-0.411727999672899573875), GVI__C(0.411727999672899573875),
    GVI__C(-0.304746984955206190874)
};
static const gvi_real gvi__few_S[] = {
    GVI__C(-0.75), GVI__C(-0.872008467928146215588), GVI__C(-0.75), GVI__C(0.705341801261479548921),
    GVI__C(-0.927298334620741688518), GVI__C(-0.868649167310370844259), GVI__C(-0.5625), GVI__C(-0.9),
    GVI__C(0.518649167310370844259), GVI__C(0.847298334620741688518), GVI__C(-0.953785837006848454724),
    GVI__C(-0.920460403188975796283), GVI__C(-0.712370508221089930304), GVI__C(-0.938679181179479062757),
    GVI__C(-0.656680189998734829357), GVI__C(0.627610535363766334498), GVI__C(-0.924952463062489660438),
    GVI__C(-0.678101547174880907547), GVI__C(0.68009827440047862373), GVI__C(0.9073504745872041205)
};
static const gvi_real gvi__few_T[] = {
    GVI__C(1.57735026918962576451), GVI__C(1.58094750193111253278), GVI__C(1.46475800154489002622),
    GVI__C(1.58094750193111253278), GVI__C(1.58158975003227987256), GVI__C(1.46127407343211423994),
    GVI__C(1.58550375141051935117), GVI__C(1.52044042068404064243), GVI__C(1.46127407343211423994),
    GVI__C(1.58158975003227987256)
};

static gvi_real gvi__few(gvi_real x) { return x < 0 ? 1 + x : x; }

// the constants in place of gvi__rule_make and gvi__modes_at_nodes
static void gvi__few_modes(gvi_stepper *st, size_t r)
{
    struct gvi__private *x = &st->x;
    const size_t at = (r - 1)*r*(2*r - 1)/6;
    gvi__copy(r, gvi__few_b + (r - 1)*r/2, x->b);
    gvi__copy(r*r, gvi__few_Phi + at, x->Phi);
    if (GVI__READS_V && x->phi) gvi__copy(r*r, gvi__few_phi + at, x->phi);
    for (size_t i = 0; i < r; ++i) x->c[i] = gvi__few(x->Phi[i]);
}

static gvi_real gvi__S(const gvi_stepper *st, int i, int j)
{
    const int r = st->r;
    return gvi__few(gvi__few_S[(r - 1)*r*(r + 1)/6 + j*(j + 1)/2 + i]);
}

static gvi_real gvi__T(const gvi_stepper *st, int i, int j)
{
    const int r = st->r;
    return gvi__few_T[(r - 2)*(r - 1)*r/6 + (j - 1)*j/2 + i] - (gvi_real)0.5;
}

// constants: there is nothing to be made
static void gvi__column(gvi_stepper *st, int which, int j) { (void)st, (void)which, (void)j; }
#else
/* z_i := sum_k a[k][i] w_k, twofold, low parts R further, at all points: fit for
   vectors.  A product does not wait for the sum, whose rounding is added up apart. */
static void gvi__twofold_sums(int s, int R, const gvi_real *GVI__RESTRICT a,
                              const gvi_real *GVI__RESTRICT low, const gvi_real *GVI__RESTRICT w,
                              gvi_real *GVI__RESTRICT z)
{
    gvi__zero(2*(size_t)R, z);
    for (int k = 0; k < s; ++k)
        for (int i = 0; i < R; ++i) {
            gvi__two x = gvi__two_of(a[k*R + i], low[k*R + i]), y = gvi__two_of(w[k], w[s + k]);
            x = gvi__mul2(x, y);
            y = gvi__sum(z[i], x.hi);
            z[i] = y.hi;
            z[R + i] += y.lo + x.lo;
        }
}

// row[i] := sum_k a[k][i] b[k][j]/Gamma_kk at all points i, a and b being Phi for S, phi for N,
// phi and Phi for T; S and T on their grids
static void gvi__column(gvi_stepper *st, int which, int j)
{
    const struct gvi__private *x = &st->x;
    const int s = st->s, R = x->stride;
    const gvi_real *b = which == GVI__OF_N ? x->phi : x->Phi, *b_low = which == GVI__OF_N ? x->low : x->E;
    const gvi_real unit = which == GVI__OF_S ? GVI__EPS/2 : GVI__EPS;
    gvi_real *z = x->row, *w = z + 2*R;
    for (int k = 0; k < s; ++k) {
        gvi__two a = gvi__two_of(b[k*R + j], b_low[k*R + j]);
        a = gvi__scale2(x->inv_gamma[k], a);
        w[k] = a.hi;
        w[s + k] = a.lo;
    }
    if (which == GVI__OF_S) gvi__twofold_sums(s, R, x->Phi, x->E, w, z);
    else gvi__twofold_sums(s, R, x->phi, x->low, w, z);
    for (int i = 0; i < st->r; ++i) {
        const gvi__two sum = gvi__sum(z[i], z[R + i]);
        z[i] = which == GVI__OF_N ? sum.hi : gvi__grid(sum, unit);
    }
}

// from the column that was made last
static gvi_real gvi__S(const gvi_stepper *st, int i, int j) { return (void)j, st->x.row[i]; }
static gvi_real gvi__T(const gvi_stepper *st, int i, int j) { return (void)j, st->x.row[i]; }
#endif

/* S and T on grids of eps/2 and eps (|S| <= 1, |T| < 2): what they must fulfil
   for the step to be symplectic then holds exactly in the rounded numbers,
   S_ij = S_ji, and for Gauss with r = s  T_ij + T_ji = 1.  Stored by columns,
   [j*stride + i]:  g = c_i - S_ij,  m = 1 - T_ij,  T = T_ji,  N = N_ij.       */
GVI__APART void gvi__tables(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    const int r = st->r, R = x->stride, gauss = !GVI__RULES || (x->desc.rule.kind == GVI_GAUSS && r == st->s);
    const int has_g = (GVI__POSITIONS || GVI__VELOCITIES) && x->g;
    const int has_m = (GVI__VELOCITIES || GVI__MOMENTA) && x->m;
    for (int j = 0; j < r; ++j) {
        if (has_g) gvi__column(st, GVI__OF_S, j);
        for (int i = 0; has_g && i <= j; ++i) {
            const gvi_real S = gvi__S(st, i, j);
            x->g[j*R + i] = x->c[i] - S;
            x->g[i*R + j] = x->c[j] - S;
        }
        if (has_m) gvi__column(st, GVI__OF_T, j);
        for (int i = 0; has_m && i < (gauss ? j + 1 : r); ++i) {
            const gvi_real T = gauss && i == j ? (gvi_real)0.5 : gvi__T(st, i, j);
            x->m[j*R + i] = 1 - T;
            if (gauss) x->m[i*R + j] = T;
            if (x->T) x->T[i*R + j] = T;
            if (x->T && gauss) x->T[j*R + i] = 1 - T;
        }
        if (GVI__VELOCITIES && GVI__LAGRANGIAN && x->N) {
            gvi__column(st, GVI__OF_N, j);
            gvi__copy((size_t)r, x->row, x->N + j*R);
        }
    }
}

// the same in working precision, for an own rule that makes Gamma full
static void gvi__tables_own(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    int s = st->s, r = st->r, R = x->stride;
    gvi_real *y = x->row, *w = x->row + R;
    for (int j = 0; j < r; ++j) {
        for (int k = 0; k < s; ++k) {
            y[k] = x->Phi[k*R + j];
            w[k] = x->phi[k*R + j];
        }
        gvi__over_gamma(st, y);
        gvi__over_gamma(st, w);
        for (int i = 0; i < r; ++i) {
            gvi_real S = 0, T = 0, N = 0;
            for (int k = 0; k < s; ++k) {
                S += x->Phi[k*R + i]*y[k];
                T += x->phi[k*R + i]*y[k];
                N += x->phi[k*R + i]*w[k];
            }
            if (x->g) x->g[j*R + i] = x->c[i] - S;
            if (x->m) x->m[j*R + i] = 1 - T;
            if (x->T) x->T[i*R + j] = T;
            if (x->N) x->N[j*R + i] = N;
        }
    }
}

#define GVI__STAGES (GVI__VELOCITIES || GVI__MOMENTA ? 2 : 1)       // of an iteration, at most

/* What an iteration computes, in this order: positions (3), by g; or these, and velocities (4),
   by m; or momenta, by m, and positions (5), by T.                            */
static int gvi__stage_count(const gvi_stepper *st)
{
    return GVI__STAGES == 1 || gvi__uses(st, GVI_POSITIONS) ? 1 : 2;
}

static inline const gvi_real *gvi__stage_table(const gvi_stepper *st, int stage)
{
    const struct gvi__private *x = &st->x;
    const int momenta = gvi__uses(st, GVI_MOMENTA);
    if (GVI__STAGES == 1 || stage == momenta) return momenta ? x->T : x->g;
    return x->m;
}

/* With a tolerance rows are made by tables times h b, each product rounded once: that is as little
   symplectic as what the iteration leaves undone, and F need not be weighed.   */
static inline int gvi__folds(const gvi_stepper *st) { return GVI__TOLERANCE && st->x.folded; }

/* Kicks with a tolerance: each number in their tables is rounded once, the same way in every step.
   Small code goes without.                                                    */
static inline int gvi__rounds(const gvi_stepper *st)
{
    return GVI__TOLERANCE && !GVI__SMALL && st->x.desc.tolerance > 0;
}

// so are p and q at every kick, as in a loop by hand; with a full mass or arcs they are not
static inline int gvi__is_rounded(const gvi_stepper *st)
{
    return gvi__rounds(st) && !gvi__mass_is(st, GVI_MASS_DENSE) && !(GVI__STIFF && st->x.springs);
}

/* Beside stiffness, with a tolerance far above rounding, the sums of a step's increments are rounded,
   too, and what they lose is not carried: little beside what the iteration leaves undone.  Elsewhere
   they are exact: a total momentum is kept however early the iteration ends.  */
static inline int gvi__is_coarse(const gvi_stepper *st)
{
    const struct gvi__private *x = &st->x;
    return GVI__TOLERANCE && GVI__STIFF && x->springs && x->desc.tolerance > 32*GVI__EPS && !x->desc.iterations;
}

// what f is weighed with in a stage, or NULL
static inline const gvi_real *gvi__stage_weights(const gvi_stepper *st)
{
    return gvi__folds(st) ? NULL : st->x.hb;
}

static void gvi__fold(gvi_stepper *st, int stage)
{
    const int R = st->x.stride;
    const gvi_real *table = gvi__stage_table(st, stage);
    gvi_real *folded = st->x.folded + stage*st->r*R;
    for (int j = 0; j < st->r; ++j)
        for (int k = 0; k < R; ++k) folded[j*R + k] = table[j*R + k]*st->x.hb[j];
}

// the exact product overflows before a*b does: then there is no rest
static gvi_real gvi__rest(gvi_real x) { return gvi__finite(x) ? x : 0; }

/* Two numbers whose product is x to EPS/750 in the mean, at worst to EPS/17: one rounded number would
   err by up to EPS/2, and the same in every step.  lo has no round digits, so that products with it are
   rounded evenly; hi is x/lo, rounded: the best of three runs of pairs.  One run would not do: where
   x/lo^2 is next to a ratio of small numbers, all of its pairs err alike.     */
static gvi__two gvi__two_factors(gvi__two x)
{
    const gvi_real unit = GVI__EPS/2;
    gvi_real first = (gvi_real)0.80901699437494742410L, least = GVI_ABS(x.hi);     // (1 + sqrt(5))/4
    gvi__two best = gvi__two_of(x.hi, 1);
    for (int run = 0; run < 3; ++run) {
        const gvi__two whole = gvi__div2(x, gvi__real2(first));
        const gvi_real slope = whole.hi/first*unit;
        gvi_real lo = first, less = -whole.lo;                // x/lo is whole.hi - less
        for (int i = 0; i < 85; ++i) {
            const gvi__stored hi = whole.hi - less;
            const gvi_real off = GVI_ABS((whole.hi - hi) - less);
            if (off < least) {
                least = off;
                best = gvi__two_of(hi, lo);
            }
            less += slope;
            lo += unit;
        }
        first -= (gvi_real)0.125;
    }
    return best;
}

/* Explicit: rows of gvi__drifting_of behind the times.  A kick of weight 0 is left out, and the weight
   of the one before goes on.                                                  */
static void gvi__drifts(gvi_stepper *st, gvi_real h)
{
    const int r = st->r;
    const gvi_real *hb = st->x.hb;
    gvi_real *weight = st->x.drift + r + 1, *ratio = weight + r + 1, *factor = ratio + r + 1;
    gvi__two w = gvi__real2(gvi__nonzero(hb[0]) ? hb[0] : h);     // what F is over, as exactly as F is scaled
    for (int j = 0; j <= r; ++j) {
        weight[j] = w.hi;
        ratio[j] = factor[j] = 1;
        if (j == 0 || j > r - 2 || !gvi__nonzero(hb[j])) continue;
        if (gvi__is_rounded(st)) {
            ratio[j] = w.hi/hb[j];
            w.hi = hb[j];
            continue;
        }
        const gvi__two by = gvi__two_factors(gvi__div2(w, gvi__real2(hb[j])));
        ratio[j] = by.hi;
        factor[j] = by.lo;
        w = gvi__div2(w, gvi__product(by.hi, by.lo));
    }
}

/* Weights h b_j whose sum is h exactly: rounded to multiples of ulp(h), what is
   left over goes to the largest weight and its mirror image.                 */
GVI__APART void gvi__weights(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *x = &st->x;
    x->h_weights = h;
    x->ratio = 0;                                  // E may hold sums with the old ones
    if (GVI__PIECES) x->usual = 0;

    int e, r = st->r, most = 0;
    gvi_real mantissa = GVI_FREXP(h, &e), rest = mantissa;
    for (int j = 0; j < r; ++j) {
        x->hb[j] = gvi__grid(gvi__product(x->b[j], mantissa), GVI__EPS/2);
        rest -= x->hb[j];
        if (x->b[j] > x->b[most]) most = j;
    }
    int mirror = gvi__nonzero(x->b[r - 1 - most] - x->b[most]) ? most : r - 1 - most;
    x->hb[most] += mirror == most ? rest : rest/2;
    if (mirror != most) x->hb[mirror] += rest/2;
    for (int j = 0; j < r; ++j) x->hb[j] = GVI_LDEXP(x->hb[j], e);
    for (int k = 0; gvi__folds(st) && k < gvi__stage_count(st); ++k) gvi__fold(st, k);
    if (!gvi__uses(st, GVI_EXPLICIT)) return;

    // the drifts sum to h exactly as well: differences of numbers on that grid
    gvi_real at = 0;
    for (int j = 0; j <= r; ++j) {
        gvi_real next = j < r ? gvi__grid(gvi__product(x->c[j], mantissa), GVI__EPS/2) : mantissa;
        x->drift[j] = GVI_LDEXP(next - at, e);
        at = next;
    }
    if (!GVI__STIFF || !x->springs) gvi__drifts(st, h);
}

/* -------------------------------------------------------- STEPPER: SET-UP */

/* What a description comes to: enough to lay out the memory, so that gvi_size needs no
   stepper.                                                                   */
typedef struct gvi__scene {
    const gvi_desc *desc;             /* its defaults filled in                 */
    int             order, flags;
    int             clock;            /* the effect that is one, or -1          */
    gvi_formulation chosen;
    int             springs;          /* gvi__springs, where GVI__STIFF         */
} gvi__scene;

// the kinds of effects, and what they read
static gvi_status gvi__read_effects(gvi__scene *x)
{
    enum { V = GVI__HAS_VELOCITIES, L = GVI__HAS_LAGRANGIAN };
    static const unsigned char reads[] = { 0, V, V | L, 0 };     // potential, force, Lagrangian, clock
    const gvi_desc *d = x->desc;
    x->flags = 0;
    x->clock = -1;
    for (int e = 0; e < d->effect_count; ++e) {
        const gvi_effect *effect = d->effects + e;
        if ((unsigned)effect->kind > GVI_CLOCK || !effect->points == !effect->point) return GVI_E_ARGUMENT;
        x->flags |= reads[effect->kind];
        if (effect->kind != GVI_CLOCK) continue;
        if (x->clock >= 0 || !effect->points) return GVI_E_ARGUMENT;
        x->clock = e;
    }
    return GVI_OK;
}

// k_i/m_i, or 0 where there is no spring to be told of
static gvi_real gvi__spring(const gvi_desc *d, int i)
{
    const gvi_real k = d->stiffness[i], w = d->mass.kind == GVI_MASS_UNIT ? k : k/d->mass.matrix[i];
    return k > 0 && w > 0 && gvi__finite(w) ? w : 0;
}

/* desc.stiffness, where it is heeded.  Coordinates of the same k/m as the last one before
   share its tables.  Returns how many sets there are; k, if not NULL, becomes [n] k_i,
   [n] the set of each.                                                        */
static int gvi__springs(const gvi__scene *x, gvi_real *k)
{
    const gvi_desc *d = x->desc;
    const int heeded = GVI__STIFF && d->stiffness && d->mass.kind <= GVI_MASS_DIAGONAL
        && (gvi__chosen_is(x->chosen, GVI_EXPLICIT) || gvi__chosen_is(x->chosen, GVI_POSITIONS)
            || gvi__chosen_is(x->chosen, GVI_VELOCITIES))
        && !gvi__flag(x->flags, GVI__HAS_LAGRANGIAN);
    int tables = 0;
    gvi_real last = 0;
    for (int i = 0; heeded && i < d->n; ++i) {
        const gvi_real w = gvi__spring(d, i);
        if (!gvi__nonzero(w)) continue;
        if (tables == 0 || gvi__nonzero(w - last)) ++tables;
        last = w;
        if (!k) continue;
        k[i] = d->stiffness[i];
        k[d->n + i] = (gvi_real)(tables - 1);
    }
    return tables;
}

// in long: an int may have 16 bits
static int gvi__within(long x, long most) { return x >= 0 && x <= most; }

static gvi_status gvi__check_desc(const gvi_desc *d)
{
    if (!d || d->n < 1 || !gvi__within(d->n, 0x7FFFF) || !gvi__within(d->degree, 1024)) return GVI_E_ARGUMENT;
    if (!gvi__within(d->rule.points, 4000) || !gvi__within(d->effect_count, GVI_EFFECTS)
        || (d->effect_count && !d->effects) || !gvi__within(d->max_iterations, 1000000)
        || !gvi__within(d->iterations, 1000000)
        || (unsigned)d->formulation > GVI_NEWTON || (unsigned)d->mass.kind > GVI_MASS_NONE
        || !(d->tolerance >= 0 && d->tolerance < 1))
        return GVI_E_ARGUMENT;
    if (d->rule.kind == GVI_OWN || d->rule.kind == GVI_KICKS)
        return d->rule.points > 0 && d->rule.nodes && d->rule.weights ? GVI_OK : GVI_E_ARGUMENT;
    // nodes where none are taken: the kind was forgotten
    return (unsigned)d->rule.kind <= GVI_LOBATTO && !d->rule.nodes ? GVI_OK : GVI_E_ARGUMENT;
}

/* Is what the kind of mass needs there, and nothing that says that the kind was forgotten?
   Without a mass, Lagrangian terms.                                           */
static int gvi__mass_given(const gvi_desc *d, int lagrangian)
{
    const gvi_mass *m = &d->mass;
    if (m->kind == GVI_MASS_UNIT) return !m->matrix && !m->points;
    if (gvi__has_mass(d, GVI_MASS_POSITION)) return m->points && m->gradient;
    if (gvi__has_mass(d, GVI_MASS_NONE)) return lagrangian;
    return m->matrix != NULL;
}

// finite, and weights that sum to 1
static gvi_status gvi__check_kicks(int r, const gvi_real *c, const gvi_real *b)
{
    gvi_real sum = 0, size = 0;
    for (int j = 0; j < r; ++j) {
        sum += b[j];
        size += GVI_ABS(b[j]);
    }
    if (!gvi__all_finite(r, c) || !gvi__all_finite(r, b)) return GVI_E_NODES;
    const gvi_real error = 4*(gvi_real)(r + 2)*GVI__EPS*size;
    return GVI_ABS(sum - 1) <= error && error < 1 ? GVI_OK : GVI_E_ORDER;       // beyond 1 no digit is sure
}

// does the description ask for what is not compiled?
static int gvi__left_out(const gvi__scene *x)
{
    const gvi_desc *d = x->desc;
    for (int e = 0; !GVI__POINT && e < d->effect_count; ++e)
        if (d->effects[e].point) return 1;
    return (x->flags & GVI__HAS_LAGRANGIAN && !GVI__LAGRANGIAN) || (x->clock >= 0 && !GVI__CLOCK)
        || (d->mass.kind > GVI_MASS_DIAGONAL && !gvi__has_mass(d, d->mass.kind))
        || !gvi__has_rule(d, d->rule.kind);
}

// the order of the rule: will it do?
static gvi_status gvi__measure(gvi__scene *x)
{
    const gvi_rule *rule = &x->desc->rule;
    const int s = x->desc->degree, r = rule->points;
    const int own = gvi__has_rule(x->desc, GVI_OWN);
    x->order = rule->kind == GVI_LOBATTO ? 2*r - 2 : 2*r;
    if (own) x->order = gvi_rule_order(r, rule->nodes, rule->weights);
    if (gvi__has_rule(x->desc, GVI_KICKS)) {
        x->order = 0;
        return s == 1 ? gvi__check_kicks(r, rule->nodes, rule->weights) : GVI_E_ARGUMENT;
    }
    if (rule->kind == GVI_LOBATTO && r < 2) return s > 1 ? GVI_E_POINTS : GVI_E_ARGUMENT;
    if (own && x->order < 0) return GVI_E_NODES;
    if (r < s) return GVI_E_POINTS;
    if (!own) return GVI_OK;                       // r >= s points of Gauss or Lobatto are good enough
    if (x->order < s) return GVI_E_ORDER;
    if (x->order < 2*s - 2) x->flags |= GVI__HAS_OWN;
    return GVI_OK;
}

// what a scene may ask for that not every formulation can do
enum { GVI__READS = 1, GVI__TIMED = 2, GVI__KICKED = 4, GVI__NOT_KICKED = 8, GVI__MORE_POINTS = 16,
       GVI__VARIES = 32, GVI__NO_VELOCITY = 64 };

GVI__DEEP int gvi__asks(const gvi__scene *x)
{
    const gvi_desc *d = x->desc;
    const int s = d->degree, r = d->rule.points, kicks = d->rule.kind == GVI_KICKS;
    const int verlet = s == 1 && r == 2 && d->rule.kind == GVI_LOBATTO, constant = gvi__mass_is_constant(d);
    const int v_of_p = constant || d->mass.velocity || d->mass.kind == GVI_MASS_POSITION;
    return (x->flags & GVI__HAS_VELOCITIES ? GVI__READS : 0) | (x->clock >= 0 ? GVI__TIMED : 0)
        | (kicks ? GVI__KICKED : verlet ? 0 : GVI__NOT_KICKED) | (r != s ? GVI__MORE_POINTS : 0)
        | (constant ? 0 : GVI__VARIES) | (v_of_p ? 0 : GVI__NO_VELOCITY);
}

// the first formulation that can do what is asked, or the one pinned; Newton's method as a fall-back
static gvi_status gvi__choose(gvi__scene *x)
{
    static const unsigned char cannot[] = {
        255,                                                             // GVI_AUTO
        GVI__READS | GVI__TIMED | GVI__NOT_KICKED | GVI__VARIES,         // GVI_EXPLICIT
        GVI__READS | GVI__TIMED | GVI__KICKED | GVI__VARIES,             // GVI_POSITIONS
        GVI__TIMED | GVI__KICKED | GVI__VARIES,                          // GVI_VELOCITIES
        GVI__KICKED | GVI__MORE_POINTS | GVI__NO_VELOCITY,               // GVI_MOMENTA
        GVI__TIMED | GVI__KICKED                                         // GVI_NEWTON
    };
    const gvi_desc *d = x->desc;
    const int pinned = d->formulation != GVI_AUTO, given = d->iterations > 0, asked = gvi__asks(x);
    const gvi_formulation only = gvi__only();
    if (pinned && only && d->formulation != only) return GVI_E_FORMULATION;
    int f = only ? (int)only : pinned ? (int)d->formulation : GVI_EXPLICIT;
    while (!gvi__compiled((gvi_formulation)f) || (asked & cannot[f]))
        if (pinned || only || f++ == GVI_NEWTON) return GVI_E_FORMULATION;
    x->chosen = (gvi_formulation)f;
    if (f == GVI_NEWTON && given) return GVI_E_FORMULATION;
    if (f == GVI_NEWTON || (GVI__NEWTON && !pinned && f != GVI_EXPLICIT && x->clock < 0 && !given))
        x->flags |= GVI__HAS_NEWTON;
    if (gvi__chosen_is(x->chosen, GVI_EXPLICIT)) return GVI_OK;
    if (!GVI__RULES && (d->rule.kind != GVI_GAUSS || d->rule.points != d->degree || d->degree > 4))
        return GVI_E_FORMULATION;
    return GVI__TOLERANCE || given || gvi__chosen_is(x->chosen, GVI_NEWTON) ? GVI_OK : GVI_E_FORMULATION;
}

// fills in the defaults (d: a copy of desc), measures the rule, chooses the formulation
static gvi_status gvi__resolve(gvi__scene *x, gvi_desc *d, const gvi_desc *desc)
{
    gvi_status status = gvi__check_desc(desc);
    x->desc = desc;
    if (status == GVI_OK) status = gvi__read_effects(x);
    if (status != GVI_OK) return status;
    if (gvi__left_out(x)) return GVI_E_FORMULATION;
    if (!gvi__mass_given(desc, x->flags & GVI__HAS_LAGRANGIAN)) return GVI_E_ARGUMENT;
    *d = *desc;
    x->desc = d;
    if (d->degree == 0) d->degree = d->rule.kind == GVI_KICKS ? 1 : 8;
    if (d->rule.points == 0) d->rule.points = d->rule.kind == GVI_LOBATTO ? d->degree + 1 : d->degree;
    if (d->max_iterations == 0) d->max_iterations = 60;
    status = gvi__measure(x);
    if (status == GVI_OK) status = gvi__choose(x);
    if (status != GVI_OK) return status;
    x->springs = GVI__STIFF ? gvi__springs(x, NULL) : 0;
    if (GVI__STIFF && x->springs) x->flags &= ~GVI__HAS_NEWTON;          // it solves other equations
    const int wanted = gvi__flag(x->flags, GVI__HAS_NEWTON | GVI__HAS_LAGRANGIAN);
    const int matrices = wanted || d->mass.kind >= GVI_MASS_DENSE;
    return matrices && d->n > 0x7FFF ? GVI_E_ARGUMENT : GVI_OK;          // indices are int: n*n and s*n
}

/* Extrapolation from two steps saves iterations up to nine points; with more of
   them, and in float, it would amplify rounding too much.  gvi__fit. */
static int gvi__fits_two(const gvi__scene *x)
{
    const int iterates = x->chosen >= GVI_POSITIONS && x->chosen <= GVI_MOMENTA;
    return x->desc->rule.points < 10 && GVI__BEYOND_FLOAT && iterates && !(GVI__STIFF && x->springs);
}

// what E makes: of two steps, not of one; the sums of (3), not the row itself; for long steps
enum { GVI__OF_TWO = 1, GVI__SUMS = 2, GVI__LONG = 4 };

/* What gvi__learn, which chooses between the two kinds of E, does now.         */
enum { GVI__MEASURES, GVI__TRIES, GVI__IDLES };
#define GVI__LEARNS (!GVI__SMALL && GVI__BEYOND_FLOAT)

// does E extrapolate from two steps now?
static inline int gvi__two_now(const gvi_stepper *st) { return GVI__BEYOND_FLOAT && (st->x.E_is & GVI__OF_TWO); }

// does the step after two of equal length have a choice of E?  Of two steps, or from ten points on of one
static inline int gvi__fits_long(const gvi_stepper *st)
{
    const int one = st->r >= 10 && st->r <= 32 && !(GVI__STIFF && st->x.springs);
    return GVI__LEARNS && (one || st->x.older_F);
}

static inline int gvi__learns(const gvi_stepper *st)
{
    return gvi__fits_long(st) && st->x.alike == 2 && !gvi__nonzero(st->x.ratio - 1);
}

/* Is Newton's matrix of s*n to be b = (s+1)/2 complex ones of n?  Where that is less
   work, in real multiplications for one factorisation and twelve solutions, about
   as many as a step takes:

     whole    s^3 n^3/3 + 12 s^2 n^2      blocks    4 b n^3/3 + 12 (4 b n^2 + 4 b s n)

   Beyond degree 16 the eigenvectors are too nearly parallel.                   */
static int gvi__falls_apart(const gvi_desc *d)
{
    const gvi_real n = (gvi_real)d->n, s = (gvi_real)d->degree, b = (gvi_real)((d->degree + 1)/2);
    const gvi_real whole = s*s*s*n*n/3 + 12*s*s*n, blocks = 4*b*n*n/3 + 48*b*(n + s);      // over n
    return !GVI__SMALL && gvi__has_rule(d, GVI_GAUSS) && d->rule.points == d->degree
        && d->degree > 1 && d->degree <= 16 && blocks < whole;
}

typedef struct gvi__arena { struct gvi__private *to; gvi_real *base; size_t used; } gvi__arena;

// a*b reals, or NULL for none; with base NULL it only counts
static gvi_real *gvi__take(gvi__arena *arena, size_t a, size_t b)
{
    const size_t most = (size_t)-1/sizeof(gvi_real) - 64;      // more than anyone has, with slack
    const int sure = !GVI__SMALL && (a | b) < (size_t)1 << 4*sizeof a;    // a quotient takes longer
    if (a == 0) return NULL;
    size_t count = !sure && a > most/b ? most : a*b, at = arena->used;
    arena->used = count > most - at ? most : at + count;
    return arena->base ? arena->base + at : NULL;
}

/* The one layout: gvi_size counts with it, gvi_init hands out by it, and
   GVI_LENGTH is its sum with everything wanted.  A part of the memory has rows and
   columns out of these lengths, which gvi__lengths fills in; no row, no part.  Of
   what a scene may do without, the length is named after it.                  */
enum {
    GVI__1, GVI__2, GVI__3, GVI__6, GVI__n, GVI__N, GVI__R, GVI__s,      // N: n, in whole vectors if n >= 8
    GVI__STATE, GVI__POINTS, GVI__V, GVI__P, GVI__A_, GVI__OLDER_F, GVI__OLDER_V, GVI__OLDER_A,
    GVI__SLOPE, GVI__RATE, GVI__G, GVI__M, GVI__T, GVI__NN, GVI__FOLDED, GVI__E, GVI__PHI, GVI__MODES,
    GVI__SCRATCH, GVI__DRIFT, GVI__GAMMA, GVI__DIAGONAL, GVI__TWO_MASSES, GVI__STILL, GVI__Z,
    GVI__AT_POINTS, GVI__nR, GVI__SPRINGS, GVI__HESS, GVI__HESSIANS, GVI__sn, GVI__PIVOT,
    GVI__DIFFERENCES, GVI__J, GVI__EIGEN, GVI__LENGTHS
};

enum { GVI__ARC_HEAD = 8, GVI__ARC_TAIL = 8 };                            // see gvi__arc_of

static inline size_t gvi__whole(size_t n) { return (n + 7)/8*8; }
static inline size_t gvi__padded(size_t n) { return n < 8 ? n : gvi__whole(n); }

// for loops over whole vectors, where behind n is 0
static inline int gvi__all_of(const gvi_stepper *st)
{
    return GVI__SMALL ? st->n : (int)gvi__padded((size_t)st->n);
}

/* x->springs: see gvi__arc.  Explicit: shears of each drift, and its half turns */
static size_t gvi__springs_length(const gvi__scene *x, size_t R)
{
    const size_t n = (size_t)x->desc->n, r = (size_t)x->desc->rule.points;
    if (!GVI__STIFF || !x->springs) return 0;
    const int lines = gvi__chosen_is(x->chosen, GVI_EXPLICIT);
    const size_t rows = gvi__chosen_is(x->chosen, GVI_VELOCITIES) ? 2 : 1;
    const size_t count = lines ? r + 1 : (size_t)x->springs;
    const size_t each = lines ? 5*gvi__padded(n) + 1 : (2*r + 3)*R + GVI__ARC_TAIL;
    const size_t others = GVI__ARC_HEAD + gvi__whole(2*n) + (lines ? 0 : rows*R*n);
    return count > ((size_t)-1 - others)/each ? (size_t)-1 : others + count*each;    // gvi__take ends there
}

static void gvi__lengths(const gvi__scene *x, size_t *length)
{
    const gvi_desc *d = x->desc;
    const size_t n = (size_t)d->n, s = (size_t)d->degree, r = (size_t)d->rule.points, R = (size_t)GVI__ROW(r);
    const gvi_formulation f = x->chosen;
    const int newton = gvi__flag(x->flags, GVI__HAS_NEWTON), two = gvi__fits_two(x);
    const int lagrangian = gvi__flag(x->flags, GVI__HAS_LAGRANGIAN), clock = GVI__CLOCK && x->clock >= 0;
    const int momenta = gvi__chosen_is(f, GVI_MOMENTA), velocities = gvi__chosen_is(f, GVI_VELOCITIES);
    const int positions = gvi__chosen_is(f, GVI_POSITIONS) || velocities, kicks = gvi__has_rule(d, GVI_KICKS);
    const int iterates = !gvi__chosen_is(f, GVI_EXPLICIT);
    const int reads_v = velocities || momenta || newton, A = lagrangian && (velocities || momenta);
    const int two_stages = velocities || momenta, dense = gvi__has_mass(d, GVI_MASS_DENSE);
    const int folds = GVI__TOLERANCE && d->tolerance > 0 && !d->iterations && !x->springs;
    length[GVI__1] = 1;
    length[GVI__2] = 2;
    length[GVI__3] = 3;
    length[GVI__6] = 6;
    length[GVI__n] = n;
    length[GVI__N] = gvi__padded(n);
    length[GVI__R] = R;
    length[GVI__s] = s;
    length[GVI__nR] = n*R;
    length[GVI__STATE] = kicks ? length[GVI__N] : n;
    length[GVI__POINTS] = kicks ? 1 : R;
    length[GVI__SPRINGS] = gvi__springs_length(x, R);
    length[GVI__HESSIANS] = (newton ? 4*n : n) + 5;

    // what a scene may do without is 0 until here
    if (!kicks) length[GVI__PHI] = s;
    if (iterates) {
        length[GVI__E] = two ? 2*r : r;
        length[GVI__SCRATCH] = 9;
        if (gvi__marks(d)) length[GVI__STILL] = n + 2;
    } else {
        length[GVI__SCRATCH] = 6;
        length[GVI__DRIFT] = 4*r + 4;
    }
    if (reads_v) length[GVI__V] = n;
    if (reads_v || (iterates && x->order <= 2*d->degree - 2)) length[GVI__MODES] = s;
    if (momenta || newton) length[GVI__P] = n;
    if (A) length[GVI__A_] = n;
    if (two) length[GVI__OLDER_F] = n;
    if (two && momenta) length[GVI__OLDER_V] = n;
    if (two && A) length[GVI__OLDER_A] = n;
    if (clock) {
        length[GVI__SLOPE] = n;
        length[GVI__RATE] = 3;
    }
    if (positions) {
        length[GVI__G] = r;
        if (folds) length[GVI__FOLDED] = r;
        if (dense) length[GVI__Z] = n;
    }
    if (two_stages) {
        length[GVI__M] = r;
        if (folds) length[GVI__FOLDED] = 2*r;
    }
    if (momenta || (velocities && lagrangian)) length[GVI__T] = r;
    if (velocities && lagrangian) length[GVI__NN] = r;
    if (gvi__flag(x->flags, GVI__HAS_OWN)) length[GVI__GAMMA] = s*s + s + 1;
    if (d->mass.kind == GVI_MASS_DIAGONAL) length[GVI__DIAGONAL] = length[GVI__N];
    if (dense) length[GVI__TWO_MASSES] = 2*n;                  // factored, and as it is
    if (gvi__has_mass(d, GVI_MASS_POSITION)) length[GVI__AT_POINTS] = n;
    if (newton || lagrangian) length[GVI__HESS] = n;
    if (newton) {
        length[GVI__sn] = s*n;
        length[GVI__PIVOT] = s*n + 1;
        length[GVI__DIFFERENCES] = 4*n;
        length[GVI__J] = 2*s*n;
        if (gvi__falls_apart(d)) length[GVI__EIGEN] = (s + 1)/2*2;       // never beside an own rule
    }
}

// which pointer of gvi__private, and which lengths make the part
typedef struct gvi__part { unsigned char pointer, rows, columns; } gvi__part;
#define GVI__PART(member, rows, columns) \
    { offsetof(struct gvi__private, member)/sizeof(gvi_real *), GVI__##rows, GVI__##columns }

// what is not there stays NULL
GVI__APART void gvi__place(gvi__arena *a, const size_t *length, const gvi__part *part, size_t count)
{
    for (; count > 0; --count, ++part) {
        gvi_real *place = gvi__take(a, length[part->rows], length[part->columns]);
        if (place) ((gvi_real **)(void *)a->to)[part->pointer] = place;
    }
}

static void gvi__layout_vectors(gvi__arena *a, const size_t *length)
{
    static const gvi__part parts[] = {
        GVI__PART(q, 1, N), GVI__PART(qe, 1, N), GVI__PART(p, 1, N), GVI__PART(pe, 1, N), GVI__PART(q0, 1, N),
        GVI__PART(p0, 1, N), GVI__PART(zeros, 1, N), GVI__PART(start, 1, N), GVI__PART(v0, 1, N),
        GVI__PART(ve, 1, N), GVI__PART(dq, 1, N), GVI__PART(dp, 1, N), GVI__PART(dqe, 1, N),
        GVI__PART(dpe, 1, N), GVI__PART(mass, DIAGONAL, 1), GVI__PART(over, DIAGONAL, 1)
    };
    gvi__place(a, length, parts, sizeof parts/sizeof *parts);
}

static void gvi__layout_rows(gvi__arena *a, const size_t *length)
{
    static const gvi__part parts[] = {
        GVI__PART(last.Q, STATE, POINTS), GVI__PART(last.F, STATE, POINTS), GVI__PART(last.V, V, R),
        GVI__PART(last.P, P, R), GVI__PART(last.A, A_, R), GVI__PART(work.Q, STATE, POINTS),
        GVI__PART(work.F, STATE, POINTS), GVI__PART(work.V, V, R), GVI__PART(work.P, P, R),
        GVI__PART(work.A, A_, R), GVI__PART(older_F, OLDER_F, R), GVI__PART(older_V, OLDER_V, R),
        GVI__PART(older_A, OLDER_A, R), GVI__PART(weak, STILL, R), GVI__PART(slope, SLOPE, R),
        GVI__PART(rate, RATE, R), GVI__PART(z, 1, R), GVI__PART(less, 1, R), GVI__PART(hb, 1, R),
        GVI__PART(c, 1, R), GVI__PART(g, G, R), GVI__PART(m, M, R), GVI__PART(T, T, R), GVI__PART(N, NN, R),
        GVI__PART(folded, FOLDED, R), GVI__PART(E, E, R), GVI__PART(Phi, PHI, R),
        GVI__PART(phi, MODES, R), GVI__PART(low, MODES, R), GVI__PART(Z, Z, R),
        GVI__PART(point_mass, AT_POINTS, nR), GVI__PART(b, 1, R), GVI__PART(t, 1, R),
        GVI__PART(row, SCRATCH, R), GVI__PART(springs, SPRINGS, 1), GVI__PART(drift, DRIFT, 1),
        GVI__PART(inv_gamma, 1, s), GVI__PART(own, GAMMA, 1), GVI__PART(eigen, EIGEN, s)
    };
    gvi__place(a, length, parts, sizeof parts/sizeof *parts);
}

// J and pivots twice: queries must not touch what the steps keep.  J comes last
static void gvi__layout_scratch(gvi__arena *a, const size_t *length)
{
    static const gvi__part parts[] = {
        GVI__PART(mass, TWO_MASSES, n), GVI__PART(scale, 2, n), GVI__PART(change, 3, n), GVI__PART(one, 6, n),
        GVI__PART(hess, HESS, HESSIANS), GVI__PART(y, sn, 1), GVI__PART(dy, sn, 1),
        GVI__PART(pivot, PIVOT, 2), GVI__PART(dF, DIFFERENCES, R), GVI__PART(J, J, sn)
    };
    gvi__place(a, length, parts, sizeof parts/sizeof *parts);
}

// pointers into the memory at base; with base NULL it only counts
static size_t gvi__layout(const gvi__scene *x, struct gvi__private *to, gvi_real *base)
{
    size_t length[GVI__LENGTHS] = { 0 };
    gvi__arena a;
    a.to = to;
    a.base = base;
    a.used = 0;
    gvi__lengths(x, length);
    if (x->desc->n >= 8) gvi__layout_vectors(&a, length);     // what is not in whole vectors comes last
    gvi__layout_rows(&a, length);
    if (x->desc->n < 8) gvi__layout_vectors(&a, length);
    gvi__layout_scratch(&a, length);
    return a.used;
}

/* Whole vectors are to start where a cache line does: up to this many numbers are
   left out at the beginning of the memory.                                    */
static size_t gvi__slack(const gvi_desc *d) { return d->rule.points > 4 || d->n >= 8 ? GVI__SLACK : 0; }

GVI_DEF size_t gvi_size(const gvi_desc *desc)
{
    gvi_desc d;
    gvi__scene scene;
    if (gvi__resolve(&scene, &d, desc) != GVI_OK) return 0;
    return (gvi__layout(&scene, NULL, NULL) + gvi__slack(&d))*sizeof(gvi_real);
}

// mass matrix into the memory, factored
static gvi_status gvi__set_mass(gvi_stepper *st, const gvi_mass *mass)
{
    int n = st->n;
    gvi_real *m = st->x.mass;
    if (mass->kind == GVI_MASS_DIAGONAL)
        for (int i = 0; i < n; ++i) {
            m[i] = mass->matrix[i];
            const gvi_status status = !gvi__finite(m[i]) ? GVI_E_ARGUMENT
                : !gvi__nonzero(m[i]) || !gvi__finite(st->x.over[i] = 1/m[i]) ? GVI_E_SINGULAR : GVI_OK;
            if (status != GVI_OK) return gvi__fail(st, status, GVI_FAULT_MASS, i, GVI_FAULT_NONE);
        }
    if (gvi__mass_is(st, GVI_MASS_DENSE)) {
        size_t nn = (size_t)n*(size_t)n;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j) {
                m[i*n + j] = m[nn + (size_t)(i*n + j)] = mass->matrix[i*n + j];
                if (!gvi__finite(m[i*n + j]))
                    return gvi__fail(st, GVI_E_ARGUMENT, GVI_FAULT_MASS, i, GVI_FAULT_NONE);
            }
        return gvi__ldl_factor(st, n, 1, 1, m);
    }
    return GVI_OK;
}

/* Where stiffness is heeded x->springs begins with h, for which the tables hold, and their
   count; [n] k, [n] its set of tables, in whole eights.  Explicit, gvi__shears follow; else the
   tables of each k/m, and behind them [n][R] rows of the free motion, of velocities as well
   where they are rows.                                                        */
typedef struct gvi__arc {
    gvi_real *K, *E;                  /* [r][R] h K_aj/b_j; gvi__fit_sums with it, or for V */
    gvi_real *cosine, *sine, *slope;  /* [R] cos nu (1 - c), sin nu (1 - c)/omega, times omega^2 */
    gvi_real *turn;                   /* tan(nu'/2)/omega, omega sin nu', sign  */
} gvi__arc;

static inline gvi_real *gvi__stiffness(const gvi_stepper *st) { return st->x.springs + GVI__ARC_HEAD; }

static inline gvi_real *gvi__spring_tables(const gvi_stepper *st)
{
    return gvi__stiffness(st) + gvi__whole(2*(size_t)st->n);
}

static inline gvi__arc gvi__arc_of(const gvi_stepper *st, int which)
{
    const int R = st->x.stride, table = st->r*R;
    gvi_real *at = gvi__spring_tables(st) + (size_t)which*(size_t)(2*table + 3*R + GVI__ARC_TAIL);
    gvi__arc arc;
    arc.K = at;
    arc.E = at + table;
    arc.cosine = at + 2*table;
    arc.sine = arc.cosine + R;
    arc.slope = arc.sine + R;
    arc.turn = arc.slope + R;
    return arc;
}

static inline gvi_real *gvi__free_rows(const gvi_stepper *st)
{
    return gvi__arc_of(st, (int)st->x.springs[1]).K;
}

static gvi_status gvi__check_stiffness(gvi_stepper *st, const gvi_real *stiffness)
{
    for (int i = 0; stiffness && i < st->n; ++i)
        if (!gvi__finite(stiffness[i]))
            return gvi__fail(st, GVI_E_ARGUMENT, GVI_FAULT_NONE, i, GVI_FAULT_NONE);
    return GVI_OK;
}

// where number stands: the alignment of a gvi_real
typedef struct gvi__aligned { char byte; gvi_real number; } gvi__aligned;

// the scene into the stepper, the memory in parts
static gvi_status gvi__hand_out(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    struct gvi__private *x = &st->x;
    gvi__scene scene;
    gvi_status status = gvi__resolve(&scene, &x->desc, desc);
    if (status != GVI_OK) return status;
    if (!memory || (uintptr_t)memory % offsetof(gvi__aligned, number)) return GVI_E_ARGUMENT;
    st->n = x->desc.n;
    st->s = x->desc.degree;
    st->r = x->desc.rule.points;
    st->order = scene.order;
    st->formulation = x->chosen = scene.chosen;
    x->stride = GVI__ROW(st->r);
    x->flags = scene.flags;
    x->clock = (signed char)scene.clock;
    x->single = gvi__single(st);
    if (GVI__WEAK) x->marks = gvi__marks(&x->desc);
    x->size = gvi__layout(&scene, NULL, NULL);
    const size_t slack = gvi__slack(&x->desc);
    if (size < (x->size + slack)*sizeof(gvi_real)) return GVI_E_MEMORY;

    if (slack) x->skip = (size_t)(-(uintptr_t)memory & 63)/sizeof(gvi_real);
    memory += x->skip;
    gvi__layout(&scene, x, memory);
    gvi__zero(GVI__NEWTON && x->J ? (size_t)(x->J - memory) : x->size, memory);    // J is written first
    if (GVI__STIFF && x->springs) {
        x->springs[1] = (gvi_real)scene.springs;
        gvi__springs(&scene, gvi__stiffness(st));
    }
    return GVI_OK;
}

// nodes, what rounding left of them, weights
static void gvi__set_rule(gvi_stepper *st, const gvi_desc *desc)
{
    struct gvi__private *x = &st->x;
    if (gvi__rule_is(st, GVI_OWN) || gvi__rule_is(st, GVI_KICKS)) {
        gvi__copy((size_t)st->r, desc->rule.nodes, x->c);
        gvi__copy((size_t)st->r, desc->rule.weights, x->b);
    } else if (gvi__uses(st, GVI_EXPLICIT)) {                // Stoermer-Verlet: c = 0, 1
        x->c[1] = 1;
        x->b[0] = x->b[1] = (gvi_real)0.5;
    }
#if GVI__RULES
    else gvi__rule_make(x->desc.rule.kind == GVI_LOBATTO, st->r, x->c, x->t, x->b);
#else
    else gvi__few_modes(st, (size_t)desc->degree);           // r = s, and known if the description is
#endif
}

GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    if (!st) return GVI_E_ARGUMENT;
    struct gvi__private *x = &st->x;
    unsigned char *bytes = (unsigned char *)st;
    for (size_t i = 0; i < sizeof *st; ++i) bytes[i] = 0;
    gvi__done(st, GVI_OK);
    gvi_status status = gvi__hand_out(st, desc, memory, size);
    if (status != GVI_OK) return st->status = status;
    memory += x->skip;
    st->q = x->q;
    st->p = x->p;
    status = gvi__set_mass(st, &desc->mass);
    if (status == GVI_OK) status = gvi__check_stiffness(st, desc->stiffness);
    if (status != GVI_OK) return status;

    // the rule, the modes at its nodes as exactly as they can be had, then the grid
    gvi__set_rule(st, desc);
    if (!gvi__uses(st, GVI_EXPLICIT)) {
        if (GVI__RULES) {
            gvi__modes_at_nodes(st);
            status = gvi__gamma(st);
            if (status != GVI_OK) return st->status = status;
        }
        if (gvi__has(st, GVI__HAS_OWN)) gvi__tables_own(st);
        else gvi__tables(st);
        if (GVI__NEWTON && x->eigen) x->blocks = -1;        // most scenes never need Newton's method
    }
    if (x->Phi) gvi__copy((size_t)st->r, x->c, x->Phi);     // Phi_0 = c on its grid: 1 - Phi_0 is exact
    x->memory = memory;                                     // from here on it can be used
    return gvi__done(st, GVI_OK);
}

/* --------------------------------------------------------- STEPPER: STEP */

// where a step, or a query's partial step, starts
typedef struct gvi__from {
    gvi_real t, te;
    const gvi_real *q, *qe, *p, *pe;
    gvi_real E;                       /* clock: energy                          */
    const gvi_real *v;                /* M^-1 p, where M is constant            */
} gvi__from;

// rows of the Lagrangian terms' dL/dv, where there are any
static inline gvi_real *gvi__A(const struct gvi__rows *rows) { return GVI__LAGRANGIAN ? rows->A : NULL; }

static void gvi__rows_as_points(gvi_points *x, const gvi_stepper *st, const struct gvi__rows *rows,
                                gvi_real *dldv)
{
    gvi__at(x, st, st->x.t, rows->Q);
    x->v = rows->V;
    x->f = rows->F;
    x->dldv = dldv;
    x->count = st->r;
    x->stride = st->x.stride;
}

// out := t + (te + c h)
static inline void gvi__times(int R, gvi_real t, gvi_real te, gvi_real h, const gvi_real *GVI__RESTRICT c,
                              gvi_real *GVI__RESTRICT out)
{
    for (int k = 0; k < R; ++k) out[k] = t + (te + c[k]*h);
}

// velocities where the mass is constant; weights and times of the points
static inline void gvi__begin(gvi_stepper *st, gvi__from *from, gvi_real h)
{
    struct gvi__private *x = &st->x;
    const int R = x->stride;
    if (gvi__nonzero(h - x->h_weights)) gvi__weights(st, h);
    x->dt = h;
    if (GVI__CLOCK) x->dH = 0;
    if (!gvi__uses(st, GVI_EXPLICIT)) gvi__times(R, from->t, from->te, h, x->c, x->t);
    from->v = from->p;
    if (x->desc.mass.kind == GVI_MASS_UNIT || !gvi__mass_is_constant(&x->desc)) return;
    const int carried = gvi__uses(st, GVI_POSITIONS) || gvi__uses(st, GVI_VELOCITIES);     // ve is read
    if (!carried || gvi__mass_is(st, GVI_MASS_DENSE)) {
        gvi__over_constant_mass(st, from->p, x->v0);
        if (carried) gvi__over_constant_mass(st, from->pe, x->ve);
    } else {
        // v is rounded, too: as much is left of it as of p
        for (int i = 0; i < st->n; ++i) {
            const gvi__two v = gvi__product(from->p[i], x->over[i]);
            x->v0[i] = v.hi;
            x->ve[i] = gvi__rest(v.lo + from->pe[i]*x->over[i]);
        }
    }
    from->v = x->v0;
}

// M^-1 pe, where M is constant
static inline const gvi_real *gvi__ve(const gvi_stepper *st, const gvi__from *from)
{
    return from->v == from->p ? from->pe : st->x.ve;
}

/* ---- explicit ---- */

/* The explicit formulation: kicks h b_j F_j at the nodes, and drifts from each to the
   next.  Between the kicks F is not 0: it holds the momentum that the step has gained,
   over the weight of the kick to come, dp/(h b_j).  Effects add to F, and that is the
   kick; no momentum is stored beside it.  A long loop takes as long as its stores: three
   are left, of F, dq and Q.  Before the last kick dp is put aside and F is 0, for the force
   there may be wanted again.
     Its loops are short and wait for each other.  A zero that the compiler does not know
   keeps it from calling memset and memcpy: they take as long as the rest, and write
   blocks of other widths than the next loads, which then wait.                */

/* One drift: its time, the weight of the kick before, and two factors of what F is multiplied
   with for the next kick.  Products of three, of F and two numbers, are two products, each with
   a rounding of its own; that of the two numbers, the same in every step, would make the map no
   longer symplectic and let the energy drift.                                 */
typedef struct gvi__drifting { gvi_real time, weight, ratio, factor; } gvi__drifting;

static inline gvi__drifting gvi__drifting_of(const gvi_real *drift, size_t row)
{
    gvi__drifting by;
    by.time = drift[0];
    by.weight = drift[row];
    by.ratio = drift[2*row];
    by.factor = drift[3*row];
    return by;
}

/* What a drift is to do.  At the start of a step dp is pe, and the kick by the force that the last
   step ended with, if it is known.  Before the last kick dp gets its place.
     By default F holds what the step has gained, and q moves by a sum of its own: what is rounded
   away at the end is kept.  Rounded, with a tolerance: F holds the whole momentum, and Q moves at once,
   as in a loop by hand: one array and two additions less.                     */
enum { GVI__START = 1, GVI__KNOWN = 2, GVI__BEFORE_LAST = 4, GVI__ROUNDED = 8 };

/* What a step of kicks works on: callbacks could change what is behind pointers, for all the
   compiler knows, so it is read once.                                         */
typedef struct gvi__kicks {
    const gvi__from *from;
    const gvi_real  *drift, *m, *known;           // m, known: or NULL
    gvi_real        *F, *dp, *dq, *Q, zero;
    size_t           row;
    int              dense;
} gvi__kicks;

/* dq += time (v + dp/m), Q = q + dq, F to the next scale.  What does not depend on F is
   added up first, so that little waits for F.  z: F/M, where M is full.       */
GVI__COPY void gvi__drift_of(int n, int todo, gvi__drifting by, gvi_real zero, const gvi_real *m,
                             const gvi_real *z, const gvi__from *from, const gvi_real *GVI__RESTRICT known,
                             gvi_real *GVI__RESTRICT F, gvi_real *GVI__RESTRICT dp,
                             gvi_real *GVI__RESTRICT dq, gvi_real *GVI__RESTRICT Q)
{
    const gvi_real *GVI__RESTRICT v = from->v, *GVI__RESTRICT q = from->q, *GVI__RESTRICT qe = from->qe;
    const gvi_real *GVI__RESTRICT pe = todo & GVI__ROUNDED ? from->p : from->pe;
    const int start = todo & GVI__START, last = todo & GVI__BEFORE_LAST;
    const gvi_real over = start ? 1/by.weight : 0, push = by.time*by.weight;
    GVI__BY_FOUR for (int i = 0; i < n; ++i) {
        gvi_real f = start ? over*pe[i] : F[i];
        if (todo & GVI__KNOWN) f += known[i];
        const gvi_real u = z ? z[i] : m ? f*m[i] : f;
        if (todo & GVI__ROUNDED) Q[i] = (start ? q[i] : Q[i]) + push*u;
        else {
            const gvi_real d = ((start ? qe[i] : dq[i]) + by.time*v[i]) + by.time*(by.weight*u);
            dq[i] = d;
            Q[i] = q[i] + d;
        }
        if (last) dp[i] = by.weight*f;
        F[i] = last ? zero : todo & GVI__ROUNDED ? by.ratio*f : by.ratio*(by.factor*f);
    }
}

#if GVI__WIDE
// gvi__drift_of in whole vectors, for a mass that is a number for each: with -O2 gcc makes none of loops of any length
GVI__COPY void gvi__drift_vectors(int n, int todo, gvi__drifting by, gvi_real zero, const gvi_real *m,
                                  const gvi__from *from, const gvi_real *known, gvi_real *F, gvi_real *dp,
                                  gvi_real *dq, gvi_real *Q)
{
    const gvi_real *pe = todo & GVI__ROUNDED ? from->p : from->pe, *v = from->v, *q = from->q, *qe = from->qe;
    const int start = todo & GVI__START, last = todo & GVI__BEFORE_LAST;
    const gvi_real over = start ? 1/by.weight : 0, push = by.time*by.weight;
    gvi__vector none = { 0 };
    none += zero;
    GVI__BY_FOUR for (int i = 0; i < n; i += GVI__LANES) {
        gvi__vector f = GVI__AT((start ? pe : F) + i);
        if (start) f = over*f;
        if (todo & GVI__KNOWN) f += GVI__AT(known + i);
        gvi__vector u = f, next = by.ratio*(by.factor*f);
        if (m) u = f*GVI__AT(m + i);
        if (todo & GVI__ROUNDED) *(gvi__vector *)(Q + i) = GVI__AT((start ? q : Q) + i) + push*u;
        else {
            const gvi__vector way = GVI__AT((start ? qe : dq) + i) + by.time*GVI__AT(v + i);
            *(gvi__vector *)(dq + i) = u = way + by.time*(by.weight*u);
            *(gvi__vector *)(Q + i) = GVI__AT(q + i) + u;
        }
        if (last) *(gvi__vector *)(dp + i) = by.weight*f;
        if (todo & GVI__ROUNDED) next = by.ratio*f;
        *(gvi__vector *)(F + i) = last ? none : next;
    }
}
#endif

// where size counts: what F and dq are at the start of a step, in a loop of its own
static void gvi__begin_kicks(int n, gvi_real over, const gvi__kicks *x)
{
    for (int i = 0; i < n; ++i) {
        const gvi_real f = over*x->from->pe[i];
        x->F[i] = x->known ? f + x->known[i] : f;
        x->dq[i] = x->from->qe[i];
    }
}

// M is full: M^-1 of what F is, or will be at the start of a step
static const gvi_real *gvi__over_dense(gvi_stepper *st, const gvi__kicks *x, int j, int start)
{
    gvi_real *z = st->x.change, *f = z + st->n;
    const gvi_real over = start ? 1/gvi__drifting_of(x->drift + j, x->row).weight : 0;
    for (int i = 0; start && i < st->n; ++i) f[i] = over*x->from->pe[i] + (x->known ? x->known[i] : 0);
    gvi__over_constant_mass(st, start ? f : x->F, z);
    return z;
}

// m and z are seen to be NULL, lest the compiler load from them under a mask: that takes 50 ns
GVI__COPY void gvi__drift_as(int n, int todo, const gvi__kicks *x, int j)
{
    const gvi__drifting by = gvi__drifting_of(x->drift + j, x->row);
#if GVI__WIDE
    if (n >= 8 && x->m) gvi__drift_vectors(n, todo, by, x->zero, x->m, x->from, x->known, x->F, x->dp, x->dq, x->Q);
    else if (n >= 8) gvi__drift_vectors(n, todo, by, x->zero, NULL, x->from, x->known, x->F, x->dp, x->dq, x->Q);
    if (n >= 8) return;
#endif
    if (x->m) gvi__drift_of(n, todo, by, x->zero, x->m, NULL, x->from, x->known, x->F, x->dp, x->dq, x->Q);
    else gvi__drift_of(n, todo, by, x->zero, NULL, NULL, x->from, x->known, x->F, x->dp, x->dq, x->Q);
}

// each kind of drift is a loop of its own
GVI__COPY void gvi__drift_when(int n, int rounded, int todo, const gvi__kicks *x, int j)
{
    const int both = GVI__START | GVI__KNOWN;
    if (todo == 0) gvi__drift_as(n, rounded, x, j);
    else if (todo == GVI__START) gvi__drift_as(n, rounded | GVI__START, x, j);
    else if (todo == both) gvi__drift_as(n, rounded | both, x, j);
    else if (todo == GVI__BEFORE_LAST) gvi__drift_as(n, rounded | GVI__BEFORE_LAST, x, j);
    else if (todo == (both | GVI__BEFORE_LAST)) gvi__drift_as(n, rounded | both | GVI__BEFORE_LAST, x, j);
    else gvi__drift_as(n, rounded | todo, x, j);
}

GVI__COPY void gvi__drift(gvi_stepper *st, int n, int todo, const gvi__kicks *x, int j)
{
    if (GVI__SMALL || x->dense) {
        const gvi_real *z = x->dense ? gvi__over_dense(st, x, j, todo & GVI__START) : NULL;
        gvi__drift_of(n, todo, gvi__drifting_of(x->drift + j, x->row), x->zero, x->m, z, x->from, x->known,
                      x->F, x->dp, x->dq, x->Q);
    } else if (todo & GVI__ROUNDED) gvi__drift_when(n, GVI__ROUNDED, todo & ~GVI__ROUNDED, x, j);
    else gvi__drift_when(n, 0, todo, x, j);
}

// the drift to the end: dq += a (v + dp/m)
GVI__COPY void gvi__last_drift_of(int n, gvi_real a, const gvi_real *m, const gvi_real *z,
                                  const gvi_real *GVI__RESTRICT v, const gvi_real *GVI__RESTRICT q,
                                  const gvi_real *GVI__RESTRICT dp, gvi_real *GVI__RESTRICT dq,
                                  gvi_real *GVI__RESTRICT Q)
{
    for (int i = 0; i < n; ++i) {
        dq[i] += a*(v[i] + (z ? z[i] : m ? dp[i]*m[i] : dp[i]));
        Q[i] = q[i] + dq[i];
    }
}

// rounded: what p and q have become, as increments; and are they finite?
GVI__COPY int gvi__last_rounded(int n, gvi_real b, gvi_real a, const gvi_real *m, const gvi__from *from,
                                const gvi_real *GVI__RESTRICT F, const gvi_real *GVI__RESTRICT Q,
                                gvi_real *GVI__RESTRICT dp, gvi_real *GVI__RESTRICT dq)
{
    const gvi_real *GVI__RESTRICT q = from->q, *GVI__RESTRICT p = from->p;
    int none = 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real to_p = dp[i] + b*F[i], to_q = Q[i] + a*(m ? m[i]*to_p : to_p);
        const gvi__stored by_p = to_p - p[i], by_q = to_q - q[i];         // not in wide registers
        dp[i] = by_p;
        dq[i] = by_q;
        none |= !(0*by_p + 0*by_q >= 0);          // 0 x is 0 or NaN
    }
    return !none;
}

#if GVI__WIDE
// gvi__last_rounded in whole vectors
GVI__COPY int gvi__last_vectors(int n, gvi_real b, gvi_real a, const gvi_real *m, const gvi__from *from,
                                const gvi_real *F, const gvi_real *Q, gvi_real *dp, gvi_real *dq)
{
    gvi__vector none = { 0 };
    for (int i = 0; i < n; i += GVI__LANES) {
        const gvi__vector to_p = GVI__AT(dp + i) + b*GVI__AT(F + i);
        gvi__vector v = to_p;
        if (m) v = GVI__AT(m + i)*to_p;
        const gvi__vector by_p = to_p - GVI__AT(from->p + i);
        const gvi__vector by_q = (GVI__AT(Q + i) + a*v) - GVI__AT(from->q + i);
        *(gvi__vector *)(dp + i) = by_p;
        *(gvi__vector *)(dq + i) = by_q;
        none += 0*by_p + 0*by_q;
    }
    gvi_real sum = 0;
    for (int k = 0; k < GVI__LANES; ++k) sum += none[k];
    return sum >= 0;
}
#endif

// the last kick, dp += b F, and the drift behind it, if there is one
GVI__COPY int gvi__last_kick(gvi_stepper *st, int n, const gvi__kicks *x, int rounded)
{
    const gvi_real b = st->x.hb[st->r - 1], a = st->x.drift[st->r], *z = NULL, *m = x->m;
    const gvi__from *from = x->from;
    gvi_real *GVI__RESTRICT dp = x->dp, *GVI__RESTRICT F = x->F;
#if GVI__WIDE
    if (rounded && n >= 8) {
        return m ? gvi__last_vectors(n, b, a, m, from, F, x->Q, dp, x->dq)
                 : gvi__last_vectors(n, b, a, NULL, from, F, x->Q, dp, x->dq);
    }
#endif
    if (rounded) {
        return m ? gvi__last_rounded(n, b, a, m, from, F, x->Q, dp, x->dq)
                 : gvi__last_rounded(n, b, a, NULL, from, F, x->Q, dp, x->dq);
    }
    int i = 0;
#if GVI__WIDE
    for (; n >= 8 && !x->dense && i < n; i += GVI__LANES) *(gvi__vector *)(dp + i) += b*GVI__AT(F + i);
#endif
    for (; i < n; ++i) dp[i] += b*F[i];
    if (!gvi__nonzero(a)) return 1;
    if (x->dense) {
        gvi__over_constant_mass(st, dp, st->x.change);
        z = st->x.change;
    }
    if (z || m || GVI__SMALL) gvi__last_drift_of(n, a, m, z, from->v, from->q, dp, x->dq, x->Q);
    else gvi__last_drift_of(n, a, NULL, NULL, from->v, from->q, dp, x->dq, x->Q);
    return 1;
}

static inline gvi_status gvi__kick_force(gvi_stepper *st, gvi_points *y, int only)
{
    if (only) return gvi__call(st, y, st->x.single);
    const gvi_status status = gvi__check_points(st, y);
    return status == GVI_OK ? gvi__effects(st, y, 0) : status;
}

/* One evaluation a kick; none, where a weight is 0, but for the last.  `force` is that at the
   start, if it is known: after a step whose last node was 1.  What callbacks could change, for
   all the compiler knows, is read once.  dqe and dpe are never anything but 0 here. */
static inline gvi_status gvi__explicit_of(gvi_stepper *st, const gvi__from *from, gvi_real h,
                                          const gvi_real *force, int n)
{
    struct gvi__private *x = &st->x;
    const int r = st->r, only = !GVI__SMALL && x->single >= 0 && !x->diagnose;
    const int rounded = gvi__is_rounded(st) ? GVI__ROUNDED : 0;
    gvi_real t = from->t;
    gvi__kicks k;
    k.from = from;
    k.drift = x->drift;
    k.row = (size_t)r + 1;
    k.m = x->desc.mass.kind == GVI_MASS_DIAGONAL ? x->over : NULL;
    k.dense = gvi__mass_is(st, GVI_MASS_DENSE);
    k.known = gvi__nonzero(x->hb[0]) ? force : NULL;
    k.zero = h - h;
    k.F = x->work.F;
    k.Q = x->work.Q;
    k.dp = x->dp;
    k.dq = x->dq;
    gvi_points y;
    gvi__at(&y, st, &t, k.Q);
    y.f = k.F;
    y.dldv = NULL;
    const int first = k.known != NULL;
    int todo = rounded | GVI__START | (first ? GVI__KNOWN : 0);
    if (GVI__SMALL) {
        gvi__begin_kicks(n, 1/gvi__drifting_of(k.drift + first, k.row).weight, &k);
        todo = 0;
    }
    for (int j = first; j < r; ++j, todo = rounded) {
        const int last = j == r - 1;
        gvi__drift(st, n, last ? todo | GVI__BEFORE_LAST : todo, &k, j);
        t = from->t + (from->te + x->c[j]*h);
        const gvi_status status = last || gvi__nonzero(x->hb[j]) ? gvi__kick_force(st, &y, only) : GVI_OK;
        if (status != GVI_OK) return status;
    }
    return gvi__last_kick(st, n, &k, rounded) ? GVI_OK : gvi__give(st, GVI_E_NON_FINITE);
}

GVI__APART gvi_status gvi__explicit_lines(gvi_stepper *st, const gvi__from *from, gvi_real h,
                                          const gvi_real *force)
{
    const int n = st->n, whole = !gvi__mass_is(st, GVI_MASS_DENSE);                // what is behind n is 0
    return n == 2 && !GVI__SMALL ? gvi__explicit_of(st, from, h, force, 2)
                                 : gvi__explicit_of(st, from, h, force, whole ? gvi__all_of(st) : n);
}

/* ---- fixed point ---- */

// four sums, so that none need wait for another; what is left over goes to the first
static gvi_real gvi__dot(int r, const gvi_real *a, const gvi_real *b)
{
    gvi_real sum[4] = { 0, 0, 0, 0 };
    const int whole = r & ~3;
    for (int j = 0; j < r; ++j) sum[j < whole ? j & 3 : 0] += a[j]*b[j];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/* One set of rows of (3), (4) or (5):
   row_i := base_i + (extra_i + c (path_i + rest_i) + factor*(M^-1 (table (h b f_i) - minus (b a_i))))
   path and minus may be NULL; M^-1 if over_mass; h b is in the table already where gvi__folds.  */
struct gvi__stage;
typedef gvi_real gvi__kernel(gvi_stepper *st, const struct gvi__stage *y);   // returns the change: below
typedef struct gvi__stage {
    const gvi_real *base, *extra, *path, *rest, *table, *f, *minus;
    gvi_real        factor, *rows, *scale;
    int             over_mass;
    gvi__kernel    *kernel;
} gvi__stage;

/* The products of r*r table and row are what an iteration consists of.  Rows go in
   blocks of eight points, or of r below 5.  Where there are vector registers a
   block is one to four vectors for the compiler; the loops for the rest add in the
   same order, so that both give the same bits.                                */
#ifdef GVI__VECTORS
// z := sum_j table[j][0..] L_j, one vector, in four sums, so that none need wait for another; r > 4
GVI__COPY void gvi__sum_vector(int r, int R, const gvi_real *table, const gvi_real *L, gvi__vector *z)
{
    gvi__vector a = GVI__AT(table)*L[0], b = GVI__AT(table + R)*L[1];
    gvi__vector c = GVI__AT(table + 2*R)*L[2], d = GVI__AT(table + 3*R)*L[3];
    int j = 4;
    for (; j + 3 < r; j += 4) {
        a += GVI__AT(table + j*R)*L[j];
        b += GVI__AT(table + (j + 1)*R)*L[j + 1];
        c += GVI__AT(table + (j + 2)*R)*L[j + 2];
        d += GVI__AT(table + (j + 3)*R)*L[j + 3];
    }
    if (j < r) a += GVI__AT(table + j*R)*L[j];
    if (j + 1 < r) b += GVI__AT(table + (j + 1)*R)*L[j + 1];
    if (j + 2 < r) c += GVI__AT(table + (j + 2)*R)*L[j + 2];
    *z = (a + b) + (c + d);
}

/* The same for up to four vectors beside each other, where registers are few: L_j is loaded once for all,
   and no sum waits in a register for longer than it has to.                   */
GVI__COPY void gvi__sums_in_turn(int r, int R, int vectors, const gvi_real *table, const gvi_real *L, gvi__vector *z)
{
    gvi__vector sum[4][4];
    GVI__EACH for (int m = 0; m < 4; ++m) {
        GVI__EACH for (int v = 0; v < vectors; ++v) sum[m][v] = GVI__AT(table + m*R + v*GVI__LANES)*L[m];
        for (int j = m + 4; j < r; j += 4)
            GVI__EACH for (int v = 0; v < vectors; ++v)
                sum[m][v] += GVI__AT(table + j*R + v*GVI__LANES)*L[j];
        if (m & 1) GVI__EACH for (int v = 0; v < vectors; ++v) sum[m - 1][v] += sum[m][v];
    }
    GVI__EACH for (int v = 0; v < vectors; ++v) z[v] = sum[0][v] + sum[2][v];
}

// the same for `vectors` of them
GVI__COPY void gvi__sum_vectors(int r, int R, int vectors, const gvi_real *table, const gvi_real *L, gvi__vector *z)
{
    if (GVI__LANES == 8) GVI__EACH for (int v = 0; v < vectors; ++v) gvi__sum_vector(r, R, table + v*8, L, z + v);
    else GVI__EACH for (int v = 0; v < vectors; v += 4)
        gvi__sums_in_turn(r, R, vectors - v < 4 ? vectors - v : 4, table + v*GVI__LANES, L, z + v);
}
#endif

// the same for `block` points, by loops, any r
static inline void gvi__sum_block(int r, int R, int block, const gvi_real *table, const gvi_real *L,
                                  gvi_real *z)
{
    for (int k = 0; k < block; ++k) {
        const gvi_real *t = table + k, none = -(gvi_real)0;          // x + -0 is x, also for -0
        gvi_real a = t[0]*L[0], b = r > 1 ? t[R]*L[1] : none;
        gvi_real c = r > 2 ? t[2*R]*L[2] : none, d = r > 3 ? t[3*R]*L[3] : none;
        int j = 4;
        for (; j + 3 < r; j += 4) {
            a += t[j*R]*L[j];
            b += t[(j + 1)*R]*L[j + 1];
            c += t[(j + 2)*R]*L[j + 2];
            d += t[(j + 3)*R]*L[j + 3];
        }
        if (j < r) a += t[j*R]*L[j];
        if (j + 1 < r) b += t[(j + 1)*R]*L[j + 1];
        if (j + 2 < r) c += t[(j + 2)*R]*L[j + 2];
        z[k] = (a + b) + (c + d);
    }
}

// the same in less code, for all R points
static void gvi__sum_small(int r, int R, const gvi_real *table, const gvi_real *L, gvi_real *z)
{
    for (int k = 0; k < R; ++k) {
        const gvi_real none = -(gvi_real)0;
        gvi_real a = none, b = none, c = none, d = none;
        for (int j = 0, o = k; j < r; j += 4, o += 4*R) {
            a += table[o]*L[j];
            if (j + 1 < r) b += table[o + R]*L[j + 1];
            if (j + 2 < r) c += table[o + 2*R]*L[j + 2];
            if (j + 3 < r) d += table[o + 3*R]*L[j + 3];
        }
        z[k] = (a + b) + (c + d);
    }
}

// z := sum_j table[j][.] L_j, all R points
static inline void gvi__sum_row(int r, int R, const gvi_real *table, const gvi_real *L, gvi_real *z)
{
#ifdef GVI__VECTORS
    for (int o = 0; R % 8 == 0 && o < R; o += GVI__LANES)
        gvi__sum_vector(r, R, table + o, L, (gvi__vector *)(z + o));
    if (R % 8 == 0) return;
#endif
    if (GVI__SMALL) gvi__sum_small(r, R, table, L, z);
    else gvi__sum_block(r, R, R, table, L, z);
}

// L := w f, element by element
static inline void gvi__weigh(int R, const gvi_real *GVI__RESTRICT w, const gvi_real *GVI__RESTRICT f,
                              gvi_real *GVI__RESTRICT L)
{
    for (int j = 0; j < R; ++j) L[j] = w[j]*f[j];
}

static void gvi__weigh_row(int R, const gvi_real *w, const gvi_real *f, gvi_real *L)
{
    gvi__weigh(R, w, f, L);
}

// z := sum_j table[j][.] w_j f_j, by way of x->z; w NULL: 1
GVI__APART void gvi__weighted_sums(const gvi_stepper *st, const gvi_real *table, const gvi_real *w,
                                   const gvi_real *f, gvi_real *z)
{
    const int weighs = !GVI__TOLERANCE || w;
    if (weighs) gvi__weigh_row(st->x.stride, w, f, st->x.z);
    gvi__sum_row(st->r, st->x.stride, table, weighs ? st->x.z : f, z);
}

/* 1/unit in which changes of a row are measured: |base| + the displacements at the
   last point, before and after; 0 where these have no sure digit.  Made when it is
   0, as gvi__fixed_point and gvi__judge leave it: as a rule nothing waits for a quotient. */
static inline void gvi__rescale(gvi_real base, gvi_real was, gvi_real is, gvi_real *scale)
{
    if (GVI__OFTEN(*scale > 0)) return;
    const gvi_real size = GVI_ABS(base) + GVI_ABS(was - base) + GVI_ABS(is - base);
    *scale = size > GVI__MIN/GVI__EPS ? 1/size : 0;
}

// the lanes of a vector of eight, added up in one order everywhere
static inline gvi_real gvi__sum_lanes(const gvi_real *z)
{
    if (!GVI__RULES) return (z[0] + z[1]) + (z[2] + z[3]);           // no more than four points
    return ((z[0] + z[4]) + (z[1] + z[5])) + ((z[2] + z[6]) + (z[3] + z[7]));
}

/* What gvi__stage_rows_of puts into a row: row := base + (((extra + c rest) + c a) + b (m z)),
   so that little waits for z.  b m is two products: h times 1/m, rounded once, would be the
   inverse of another mass in every step than the one that makes v of p, the map no
   longer symplectic, and energy would drift.  So it would without the rest of a = h v, if
   h has a short period in binary, as 0.1 has.                                 */
typedef struct gvi__affine { gvi_real base, extra, rest, a, b, m; } gvi__affine;

// 1/m of a stage over a diagonal mass, else NULL
static inline const gvi_real *gvi__diagonal(const gvi_stepper *st, const gvi__stage *y)
{
    return y->over_mass && st->x.desc.mass.kind == GVI_MASS_DIAGONAL ? st->x.over : NULL;
}

GVI__COPY gvi__affine gvi__affine_of(const gvi__stage *y, const gvi_real *diagonal, int i)
{
    gvi__affine p;
    p.base = y->base[i];
    p.extra = y->extra[i];
    p.a = !y->path ? 0 : GVI__PATH ? y->path[i] : y->factor*y->path[i];
    p.rest = GVI__RESTS && y->path ? y->rest[i] : 0;
    p.b = y->factor;
    p.m = diagonal ? diagonal[i] : 1;
    return p;
}

// row := base + (((extra + c rest) + c a) + b (m row))
GVI__APART void gvi__affine_row(const gvi_stepper *st, const gvi__stage *y, int i, gvi_real *row)
{
    const struct gvi__private *x = &st->x;
    const gvi__affine p = gvi__affine_of(y, gvi__diagonal(st, y), i);
    const gvi_real *c = x->c;
    for (int k = 0; k < x->stride; ++k)
        row[k] = p.base + (((GVI__RESTS ? p.extra + c[k]*p.rest : p.extra) + c[k]*p.a) + row[k]*p.m*p.b);
}

/* Up to four points are no vector: eight coordinates are, and loops over them are inside.  The terms are
   the same and in the same order, number by number.                           */
typedef gvi_real gvi__abreast[4][8];                  // of point k of coordinate i + l at [k][l]

// z := sum_j table[j][.] L_j of eight rows
GVI__COPY void gvi__sums_abreast(int r, const gvi_real *table, const gvi_real *L, gvi__abreast z)
{
    for (int l = 0; l < 8; ++l)
        for (int k = 0; k < r; ++k) gvi__sum_block(r, r, 1, table + k, L + l*r, &z[k][l]);
}

// gvi__affine_row of coordinates i to i + 7
GVI__COPY void gvi__affine_abreast(const gvi_stepper *st, const gvi__stage *y, int i, int r, gvi__abreast z)
{
    const gvi_real *diagonal = gvi__diagonal(st, y), *c = st->x.c, *base = y->base + i, *extra = y->extra + i;
    gvi_real a[8], rest[8], m[8];
    for (int l = 0; l < 8; ++l) a[l] = y->path ? y->path[i + l] : 0;
    for (int l = 0; l < 8; ++l) rest[l] = y->path ? y->rest[i + l] : 0;
    for (int l = 0; l < 8; ++l) m[l] = diagonal ? diagonal[i + l] : 1;
    for (int l = 0; l < 8; ++l)
        for (int k = 0; k < r; ++k)
            z[k][l] = base[l] + (((extra[l] + c[k]*rest[l]) + c[k]*a[l]) + z[k][l]*m[l]*y->factor);
}

// gvi__stage_rows_of without minus, of all whole eights of coordinates; returns how many these are
GVI__COPY int gvi__rows_abreast(const gvi_stepper *st, const gvi__stage *y, int r, gvi_real *lane)
{
    const gvi_real *weights = gvi__stage_weights(st);
    const int whole = st->n & ~7;
    for (int i = 0; i < whole; i += 8) {
        const gvi_real *GVI__RESTRICT f = y->f + i*r;
        gvi_real *GVI__RESTRICT row = y->rows + i*r, *GVI__RESTRICT scale = y->scale + i, L[8*4];
        gvi__abreast next, square;
        for (int l = 0; l < 8; ++l)
            for (int k = 0; k < r; ++k) L[l*r + k] = weights ? weights[k]*f[l*r + k] : f[l*r + k];
        gvi__sums_abreast(r, y->table, L, next);
        gvi__affine_abreast(st, y, i, r, next);
        for (int l = 0; l < 8; ++l) gvi__rescale(y->base[i + l], row[l*r + r - 1], next[r - 1][l], scale + l);
        for (int l = 0; l < 8; ++l)
            for (int k = 0; k < r; ++k) {
                const gvi_real moved = (next[k][l] - row[l*r + k])*scale[l];
                square[k][l] = moved*moved;
                row[l*r + k] = next[k][l];
            }
        for (int l = 0; l < 8; ++l)
            for (int k = 0; k < r; ++k) lane[k] += square[k][l];
    }
    return whole;
}

#ifdef GVI__VECTORS
// gvi__affine_row of `vectors` vectors of sums; m is 1 where there is no diagonal
GVI__COPY void gvi__affine_vectors(const gvi__affine *p, const gvi_real *diagonal, int vectors,
                                   const gvi__vector *c, gvi__vector *z)
{
    GVI__EACH for (int v = 0; v < vectors; ++v) {
        if (diagonal) z[v] *= p->m;
        z[v] = p->base + (((p->extra + c[v]*p->rest) + c[v]*p->a) + z[v]*p->b);
    }
}

// eight points of a row := next, their changes to squares; its last point is at `last`, if among them
GVI__COPY void gvi__replace(gvi_real base, int last, const gvi__vector *next, gvi_real *row, gvi_real *scale,
                            gvi__vector *squares)
{
    if (last < 8) gvi__rescale(base, row[last], next[last/GVI__LANES][last % GVI__LANES], scale);
    const gvi_real unit = *scale;                     // what is stored below might be there, for all gcc knows
    GVI__EACH for (int v = 0; v < 8/GVI__LANES; ++v) {
        const gvi__vector moved = (next[v] - GVI__AT(row + v*GVI__LANES))*unit;
        squares[v] += moved*moved;
        *(gvi__vector *)(row + v*GVI__LANES) = next[v];
    }
}

GVI__COPY gvi_real gvi__sum_squares(const gvi__vector *squares)
{
    gvi_real lane[8];
    GVI__EACH for (int v = 0; v < 8/GVI__LANES; ++v) *(gvi__vector *)(lane + v*GVI__LANES) = squares[v];
    return gvi__sum_lanes(lane);
}
#endif

/* The rows of a stage, M^-1 being a number for each.  Returns the sum of the squares
   of the changes, scaled.  r and R are constants where this is inlined for the
   usual sizes.                                                                */
GVI__COPY gvi_real gvi__stage_rows_of(const gvi_stepper *st, const gvi__stage *y, int r, int R)
{
    const struct gvi__private *x = &st->x;
    const gvi_real *diagonal = gvi__diagonal(st, y);
    const gvi_real *c = x->c, *weights = gvi__stage_weights(st), *minus = GVI__LAGRANGIAN ? y->minus : NULL;
    const int n = st->n;
#ifdef GVI__VECTORS
    if (R % 8 == 0) {
        // h b F of a few rows ahead of their sums, which would have to wait for it
        enum { VECTORS = 8/GVI__LANES };              // in a block
        gvi_real ahead[64], *L = R == 8 ? ahead : x->z;
        const int few = R == 8 ? 8 : 1;
        gvi__vector squares[VECTORS] = { { 0 } };
        for (int i = 0; i < n; ++i) {
            const gvi__affine p = gvi__affine_of(y, diagonal, i);
            const gvi_real *f = weights ? L + i % few*R : y->f + i*R;
            if (i % few == 0 && weights)
                for (int o = 0; o < few*R && i*R + o < n*R; o += GVI__LANES)
                    *(gvi__vector *)(L + o) = GVI__AT(weights + o % R)*GVI__AT(y->f + i*R + o);
            if (minus) gvi__weigh(R, x->b, x->work.A + i*R, x->less);
            for (int o = R - 8; o >= 0; o -= 8) {
                gvi__vector next[VECTORS], less;
                GVI__EACH for (int k = 0; k < VECTORS; ++k) {
                    const int at = o + k*GVI__LANES;
                    gvi__sum_vector(r, R, y->table + at, f, next + k);
                    if (!minus) continue;
                    gvi__sum_vector(r, R, minus + at, x->less, &less);
                    next[k] -= less;
                }
                gvi__affine_vectors(&p, diagonal, VECTORS, &GVI__AT(c + o), next);
                gvi__replace(p.base, r - 1 - o, next, y->rows + i*R + o, y->scale + i, squares);
            }
        }
        return gvi__sum_squares(squares);
    }
#endif
    gvi_real lane[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    const int block = R < 8 ? R : 8, done = GVI__WIDE && R < 5 && !minus ? gvi__rows_abreast(st, y, r, lane) : 0;
    for (int i = done; i < n; ++i) {
        const gvi__affine p = gvi__affine_of(y, diagonal, i);
        gvi_real few[8], *weighed = R > 8 ? x->z : few;
        const gvi_real *L = weights ? weighed : y->f + i*R;
        if (weights) gvi__weigh(R, weights, y->f + i*R, weighed);
        if (minus) gvi__weigh(R, x->b, x->work.A + i*R, x->less);
        for (int o = R - block; o >= 0; o -= block) {
            const int last = r - 1 - o;
            gvi_real *row = y->rows + i*R + o, z[8], less[8];
            gvi__sum_block(r, R, block, y->table + o, L, z);
            if (minus) gvi__sum_block(r, R, block, minus + o, x->less, less);
            for (int k = 0; k < block; ++k)
                z[k] = p.base + (((p.extra + c[k + o]*p.rest) + c[k + o]*p.a)
                                 + (minus ? z[k] - less[k] : z[k])*p.m*p.b);
            if (last < block) gvi__rescale(p.base, row[last], z[last], y->scale + i);
            for (int k = 0; k < block; ++k) {
                const gvi_real moved = (z[k] - row[k])*y->scale[i];
                lane[k] += moved*moved;
                row[k] = z[k];
            }
        }
    }
    return gvi__sum_lanes(lane);
}

#ifdef GVI__VECTORS
#define GVI__KEPT (GVI__LANES == 8)                   // eight vectors of the table stay in registers

GVI__COPY const gvi_real *gvi__keep(int r, const gvi_real *table, gvi__vector *kept)
{
    if (!GVI__KEPT) return table;
    // not in a loop of r, which would become a copy in memory
    for (int j = 0; j < 4; ++j) kept[j] = GVI__AT(table + 8*j);
    if (r > 4) kept[4] = GVI__AT(table + 32);
    if (r > 5) kept[5] = GVI__AT(table + 40);
    if (r > 6) kept[6] = GVI__AT(table + 48);
    if (r > 7) kept[7] = GVI__AT(table + 56);
    return (const gvi_real *)kept;
}

// gvi__stage_rows_8, with what is NULL of path and diagonal known; y: nothing that is stored may be in it.
// kept_rows: the new rows once more, for a caller that wants them in registers, or NULL
GVI__COPY gvi_real gvi__rows_of_8(const gvi_stepper *st, const gvi__stage *y, const gvi_real *diagonal,
                                  int r, int n, int folded, gvi__vector *kept_rows)
{
    enum { VECTORS = 8/GVI__LANES };
    const struct gvi__private *x = &st->x;
    const gvi_real *f = y->f;
    gvi_real ahead[64];
    gvi__vector kept[8], c[VECTORS], hb[VECTORS], squares[VECTORS] = { { 0 } };
    const gvi_real *table = gvi__keep(r, y->table, kept);
    GVI__EACH for (int k = 0; k < VECTORS; ++k) {
        c[k] = GVI__AT(x->c + k*GVI__LANES);
        hb[k] = GVI__AT(x->hb + k*GVI__LANES);
    }
    for (int i = 0; i < n; ++i) {
        if (i % 8 == 0 && !folded)
            for (int o = 0; o < 64 && o < 8*(n - i); o += GVI__LANES, f += GVI__LANES)
                *(gvi__vector *)(ahead + o) = hb[o/GVI__LANES % VECTORS]*GVI__AT(f);
        const gvi_real *L = folded ? y->f + 8*i : ahead + i % 8*8;
        const gvi__affine p = gvi__affine_of(y, diagonal, i);
        gvi__vector next[VECTORS];
        gvi__sum_vectors(r, 8, VECTORS, table, L, next);
        gvi__affine_vectors(&p, diagonal, VECTORS, c, next);
        if (kept_rows) GVI__EACH for (int k = 0; k < VECTORS; ++k) kept_rows[i*VECTORS + k] = next[k];
        gvi__replace(p.base, r - 1, next, y->rows + 8*i, y->scale + i, squares);
    }
    return gvi__sum_squares(squares);
}

/* The same for five to eight points and no Lagrangian terms.                   */
GVI__COPY gvi_real gvi__stage_rows_8(const gvi_stepper *st, const gvi__stage *y, int r, int n, int folded)
{
    gvi__stage own = *y;                              // what is stored might be in y, for all gcc knows
    const gvi_real *diagonal = gvi__diagonal(st, y);
    if (diagonal) return gvi__rows_of_8(st, &own, diagonal, r, n, folded, NULL);
    if (own.path) return gvi__rows_of_8(st, &own, NULL, r, n, folded, NULL);
    own.path = NULL;                                  // momenta
    own.factor = 1;
    return gvi__rows_of_8(st, &own, NULL, r, n, folded, NULL);
}
#endif

#ifdef GVI__VECTORS
/* gvi__sum_vector of two rows at once, and of `vectors` vectors of each, so that what is loaded of the
   table is used twice.  The loop stays one: unrolled, gcc loads the table far ahead and has no registers
   left for it.                                                                */
GVI__COPY void gvi__sum_two(int r, int R, int vectors, const gvi_real *table, const gvi_real *L,
                            const gvi_real *M, gvi__vector *y, gvi__vector *z)
{
    gvi__vector sum[4][2], other[4][2];
    GVI__EACH for (int m = 0; m < 4; ++m)
        GVI__EACH for (int v = 0; v < vectors; ++v) {
            const gvi__vector t = GVI__AT(table + m*R + v*GVI__LANES);
            sum[m][v] = t*L[m];
            other[m][v] = t*M[m];
        }
    int j = 4;
    GVI__ROLLED for (; j + 3 < r; j += 4)
        GVI__EACH for (int m = 0; m < 4; ++m)
            GVI__EACH for (int v = 0; v < vectors; ++v) {
                const gvi__vector t = GVI__AT(table + (j + m)*R + v*GVI__LANES);
                sum[m][v] += t*L[j + m];
                other[m][v] += t*M[j + m];
            }
    GVI__EACH for (int m = 0; m < 3; ++m)
        if (j + m < r) GVI__EACH for (int v = 0; v < vectors; ++v) {
            const gvi__vector t = GVI__AT(table + (j + m)*R + v*GVI__LANES);
            sum[m][v] += t*L[j + m];
            other[m][v] += t*M[j + m];
        }
    GVI__EACH for (int v = 0; v < vectors; ++v) {
        y[v] = (sum[0][v] + sum[1][v]) + (sum[2][v] + sum[3][v]);
        z[v] = (other[0][v] + other[1][v]) + (other[2][v] + other[3][v]);
    }
}

// row i of a stage from its sums, sixteen points; their changes go to squares, the last eight first
GVI__COPY void gvi__put_16(const gvi_stepper *st, const gvi__stage *y, int r, int i, const gvi_real *diagonal,
                           gvi__vector *next, gvi__vector *squares)
{
    enum { EIGHT = 8/GVI__LANES };
    const gvi__affine p = gvi__affine_of(y, diagonal, i);
    gvi_real *row = y->rows + 16*i;
    gvi__affine_vectors(&p, diagonal, 2*EIGHT, &GVI__AT(st->x.c), next);
    gvi__replace(p.base, r - 9, next + EIGHT, row + 8, y->scale + i, squares);
    gvi__replace(p.base, r - 1, next, row, y->scale + i, squares);
}

/* The same for nine to sixteen points.  h b F of two rows is made ahead of their sums, which would have to wait
   for it; where registers suffice both sums are made at once, of an odd number the last alone, twice.  */
GVI__COPY gvi_real gvi__stage_rows_16(const gvi_stepper *st, const gvi__stage *y, int r, int n)
{
    enum { MOST = 16/GVI__LANES };
    const gvi_real *diagonal = gvi__diagonal(st, y), *weights = gvi__stage_weights(st);
    gvi_real ahead[32];
    gvi__vector next[MOST], other[MOST], squares[MOST/2] = { { 0 } };
    for (int i = 0; i < n; i += 2) {
        const int also = i + 1 < n ? i + 1 : i;
        const gvi_real *f = y->f + 16*i, *L = weights ? ahead : f;
        for (int o = 0; weights && o < 16*(also - i + 1); o += GVI__LANES)
            *(gvi__vector *)(ahead + o) = GVI__AT(weights + o % 16)*GVI__AT(f + o);
        if (GVI__KEPT) gvi__sum_two(r, 16, MOST, y->table, L, L + 16*(also - i), next, other);
        for (int k = i; k <= also; ++k, L += 16) {
            if (!GVI__KEPT) gvi__sum_vectors(r, 16, MOST, y->table, L, next);
            gvi__put_16(st, y, r, k, diagonal, GVI__KEPT && k > i ? other : next, squares);
        }
    }
    return gvi__sum_squares(squares);
}
#endif

// z := table (h b f_i) - minus (b a_i)
static void gvi__row_sums(const gvi_stepper *st, const gvi__stage *y, int i, gvi_real *z)
{
    const struct gvi__private *x = &st->x;
    const int R = x->stride;
    gvi__weighted_sums(st, y->table, gvi__stage_weights(st), y->f + i*R, z);
    if (!GVI__LAGRANGIAN || !y->minus) return;
    gvi__weighted_sums(st, y->minus, x->b, x->work.A + i*R, x->less);
    for (int k = 0; k < R; ++k) z[k] -= x->less[k];
}

/* phi_k(tau) and Phi_k(tau), k < s, multiplied by Gamma^-1, at any tau.        */
static void gvi__modes(const gvi_stepper *st, gvi_real tau, gvi_real *phi, gvi_real *Phi)
{
    const gvi_real X = 1 - 2*tau;
    gvi_real P = 1, before = 1;
    for (int k = 0; k < st->s; ++k) {
        const gvi_real next = gvi__legendre_next(k, X, P, before);
        phi[k] = P;
        Phi[k] = (before - next)/(gvi_real)(4*k + 2);
        before = P;
        P = next;
    }
    gvi__over_gamma(st, phi);
    gvi__over_gamma(st, Phi);
}

/* ---- arcs: coordinates with a spring that was told ---- */

/* With nu = omega h, S(x) = sin(nu x)/nu, C(x) = cos(nu x) and g = F + k Q, what is left of
   the force, the step of such a coordinate is

     Q_a = C(c_a) q + h S(c_a) v + h M^-1 sum_j (K_aj/b_j) h b_j g_j
     q1  = C(1) q + h S(1) v     + h M^-1 sum_j S(1 - c_j) h b_j g_j
     p1  = the derivative of that, with C(1 - c_j) h b_j g_j

   symplectic for any k, and beside any other coordinate of the same b, if
   b_a K_aj - b_j K_ja = b_a b_j S(c_a - c_j).  Half of it comes from that, and the other,
   symmetric, half from K_aj = int_0^c_a S(c_a - x) l_j(x) dx, the arc that follows the
   polynomial through g: with modes, l_j = b_j sum_k phi_k(c_j) phi_k/Gamma_kk.    */

// sin nu x, cos nu x
static void gvi__turn(gvi__two nu, gvi_real x, gvi_real *sine, gvi_real *cosine)
{
    const gvi__two a = gvi__scale2(x, nu);
    const gvi_real s = GVI__SIN(a.hi), c = GVI__COS(a.hi);
    *sine = s + a.lo*c;
    *cosine = c - a.lo*s;
}

/* M_k = int_0^tau sin(nu (tau - x)) phi_k(x) dx and N_k, the same with the cosine, by parts:
   Phi_k = (phi_(k-1) - phi_(k+1))/(2(2k+1)) makes

     M_(k+1) = M_(k-1) - 2(2k+1)/nu (Phi_k(tau) - N_k)      N_(k+1) = N_(k-1) - 2(2k+1)/nu M_k

   with phi_(-1) = phi_0.  Errors are those of spherical Bessel functions of nu/2: they do
   not grow while 2k < nu.                                                     */
static void gvi__moments_by_parts(int s, gvi__two nu, gvi_real tau, gvi_real *M, gvi_real *N)
{
    gvi_real sine, cosine, P = 1, before = 1;
    gvi__turn(nu, tau, &sine, &cosine);
    M[0] = (1 - cosine)/nu.hi;
    N[0] = sine/nu.hi;
    for (int k = 0; k + 1 < s; ++k) {
        const gvi_real next = gvi__legendre_next(k, 1 - 2*tau, P, before), w = 2*(gvi_real)(2*k + 1)/nu.hi;
        const int last = k > 0 ? k - 1 : 0;
        M[k + 1] = M[last] - w*((before - next)/(gvi_real)(4*k + 2) - N[k]);
        N[k + 1] = N[last] - w*M[k];
        before = P;
        P = next;
    }
}

/* The same at tau from those at `from`, by a turn and what lies between: quadrature on pieces, unless
   nu is far above 2s.  Gauss's rule of 16 points is exact to degree 31; on a piece phi_k and the sine
   turn by 6 at most, but phi_k by more at the ends, where its zeros are denser like s s.  */
static void gvi__moments_by_rule(int s, gvi__two nu, gvi_real from, gvi_real tau, gvi_real *M, gvi_real *N)
{
    static const gvi_real rule[8][2] = {             // nodes below 1/2, weights
        { (gvi_real)0.00529953250417503370192291327483369L, (gvi_real)0.0135762297058770474258902862280090L },
        { (gvi_real)0.0277124884633837119610057922326958L, (gvi_real)0.0311267619693239464314219184971888L },
        { (gvi_real)0.0671843988060841280597660511438034L, (gvi_real)0.0475792558412463924049625538011231L },
        { (gvi_real)0.122297795822498483052449402576279L, (gvi_real)0.0623144856277669360262381410960082L },
        { (gvi_real)0.191061877798678125776664117975604L, (gvi_real)0.0747979944082883660407508652737393L },
        { (gvi_real)0.270991611171386306828790278508211L, (gvi_real)0.0845782596975012690946560395151800L },
        { (gvi_real)0.359198224610370543384769749269752L, (gvi_real)0.0913017075224617944333818339846100L },
        { (gvi_real)0.452493745081181279907340332287521L, (gvi_real)0.0947253052275342481426983616041416L }
    };
    const gvi_real size = GVI_ABS(nu.hi), way = tau - from;
    const int pieces = 1 + (int)((size + (gvi_real)(s + s*s/32))*way/6);
    const gvi_real part = way/(gvi_real)pieces;
    gvi_real sine, cosine;
    gvi__turn(nu, way, &sine, &cosine);
    for (int k = 0; k < s; ++k) {
        const gvi_real was = M[k];
        M[k] = cosine*was + sine*N[k];
        N[k] = cosine*N[k] - sine*was;
    }
    for (int m = 0; m < 16*pieces; ++m) {
        const gvi_real *at = rule[m & 7];
        const gvi_real rest = part*((gvi_real)(m/16) + (m & 8 ? 1 - at[0] : at[0])), X = 1 - 2*(tau - rest);
        gvi_real P = 1, before = 0;
        gvi__turn(nu, rest, &sine, &cosine);
        for (int k = 0; k < s; ++k) {
            const gvi_real w = 1/(gvi_real)(k + 1), next = (2 - w)*X*P - (1 - w)*before;
            M[k] += part*at[1]*sine*P;
            N[k] += part*at[1]*cosine*P;
            before = P;
            P = next;
        }
    }
}

// M and N at tau, from those at `from`, which are not read if that is 0
static void gvi__moments(int s, gvi__two nu, gvi_real from, gvi_real tau, gvi_real *M, gvi_real *N)
{
    if (GVI_ABS(nu.hi) > (gvi_real)(4*s + 16)) {
        gvi__moments_by_parts(s, nu, tau, M, N);
        return;
    }
    if (!gvi__nonzero(from)) {
        gvi__zero((size_t)s, M);
        gvi__zero((size_t)s, N);
    }
    gvi__moments_by_rule(s, nu, from, tau, M, N);
}

/* K/b: the part S(c_a - c_j)/2 is made of the rounded weights of the end, so that it belongs
   to them.                                                                    */
static void gvi__arc_table(const gvi_stepper *st, const gvi__arc *arc, gvi__two omega, gvi__two nu)
{
    const struct gvi__private *x = &st->x;
    const int r = st->r, R = x->stride, s = st->s;
    gvi_real *M = x->row, *N = M + R, *mode = x->E;           // to be made anew for this h
    for (int j = 0; j < R; ++j) {                             // behind the points: the start, c = 0
        gvi__turn(nu, 1 - x->c[j], arc->sine + j, arc->cosine + j);
        arc->slope[j] = arc->sine[j]*omega.hi;
        arc->sine[j] /= omega.hi;
        if (j < r) gvi__modes(st, x->c[j], mode + j*R, M);
    }
    for (int a = 0; a < r; ++a) {
        const gvi_real from = a > 0 && x->c[a - 1] < x->c[a] ? x->c[a - 1] : 0;
        gvi__moments(s, nu, from, x->c[a], M, N);
        for (int j = 0; j < r; ++j) arc->K[j*R + a] = gvi__dot(s, mode + j*R, M)/omega.hi;
        for (int j = 0; j < r && gvi__uses(st, GVI_VELOCITIES); ++j)
            arc->E[j*R + a] = gvi__dot(s, mode + j*R, N);
    }
    for (int a = 0; a < r; ++a)
        for (int j = 0; j <= a; ++j) {
            const gvi_real mean = (arc->K[j*R + a] + arc->K[a*R + j])/2;
            const gvi_real half = gvi__sub2(gvi__product(arc->sine[j], arc->cosine[a]),
                                            gvi__product(arc->sine[a], arc->cosine[j])).hi/2;
            arc->K[a*R + j] = mean - half;
            arc->K[j*R + a] = mean + half;
        }
}

/* Free motion as three shears, which keep areas as rounded: a rotation by a rounded sine
   and cosine does not, and energy would drift.  Half turns are exact.          */
static void gvi__arc_turn(gvi__two omega, gvi__two nu, gvi_real *turn)
{
    const gvi_real pi = (gvi_real)3.14159265358979323846264338327950288L;
    const gvi_real halves = GVI_FLOOR(nu.hi/pi + (gvi_real)0.5);
    const gvi__two rest = gvi__sub2(nu, gvi__scale2(halves, gvi__two_of(pi, GVI__SIN(pi))));
    gvi_real sine, cosine;
    gvi__turn(rest, 1, &sine, &cosine);
    turn[0] = sine/(1 + cosine)/omega.hi;
    turn[1] = sine*omega.hi;
    turn[2] = gvi__nonzero(halves - 2*GVI_FLOOR(halves/2)) ? -1 : 1;
}

// sqrt(k/m) with its rest
static gvi__two gvi__frequency(gvi_real k, gvi_real m)
{
    const gvi__two square = gvi__div2(gvi__real2(k), gvi__real2(m));
    const gvi_real root = GVI_SQRT(square.hi);
    return gvi__sum(root, gvi__sub2(square, gvi__product(root, root)).hi/(2*root));
}

// the tables for a step of length h; where omega h has lost its digits there are none
GVI__APART gvi_status gvi__make_arcs(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *x = &st->x;
    const gvi_real *stiffness = gvi__stiffness(st);
    x->springs[0] = x->ratio = 0;
    for (int i = 0, made = 0; i < st->n; ++i) {
        if (!gvi__nonzero(stiffness[i]) || (int)stiffness[st->n + i] != made) continue;
        const gvi__arc arc = gvi__arc_of(st, made++);
        const gvi__two omega = gvi__frequency(stiffness[i], x->over ? x->mass[i] : 1);
        const gvi__two nu = gvi__scale2(h, omega);
        if (!(GVI_ABS(nu.hi) < 1/GVI__EPS) || !(GVI_ABS(nu.hi) > GVI__MIN/GVI__EPS))
            return gvi__give(st, GVI_E_CONVERGENCE);
        gvi__arc_turn(omega, nu, arc.turn);
        gvi__arc_table(st, &arc, omega, nu);
    }
    x->springs[0] = h;
    return GVI_OK;
}

// (x + xe) += a (y + ye), the product carried with its rounding
GVI__COPY gvi__two gvi__shear(gvi__two x, gvi_real a, gvi__two y)
{
    const gvi__two z = gvi__product(a, y.hi);
    return gvi__join(x.hi, x.lo, z.hi, z.lo + a*y.lo);
}

/* Free motion to the end of the step, its increments to dq, dqe, dp, dpe; and from there
   back to the points: Q = C(1 - c) q1 - S(1 - c) v1, and V, its derivative.    */
static void gvi__free_motion(gvi_stepper *st, const gvi__from *from)
{
    struct gvi__private *x = &st->x;
    const int n = st->n, R = x->stride;
    const gvi_real *stiffness = gvi__stiffness(st), *over = x->over, *mass = x->mass;
    const int velocities = gvi__uses(st, GVI_VELOCITIES);
    gvi_real *row = gvi__free_rows(st), *dq = x->dq, *dqe = x->dqe, *dp = x->dp, *dpe = x->dpe;
    for (int i = 0; i < n; ++i, row += R) {
        if (!gvi__nonzero(stiffness[i])) continue;
        const gvi__arc arc = gvi__arc_of(st, (int)stiffness[n + i]);
        const gvi_real m = over ? over[i] : 1, sign = arc.turn[2];
        const gvi_real along = arc.turn[0]*m, kick = -arc.turn[1]*(over ? mass[i] : 1);
        gvi__two q = gvi__two_of(from->q[i], from->qe[i]), p = gvi__two_of(from->p[i], from->pe[i]);
        q = gvi__shear(q, along, p);
        p = gvi__shear(p, kick, q);
        q = gvi__shear(q, along, p);
        const gvi_real q1 = sign*q.hi, q1e = sign*q.lo, p1 = sign*p.hi, p1e = sign*p.lo;
        const gvi__two v1 = gvi__product(m, p1);
        const gvi_real v1e = v1.lo + m*p1e, *cosine = arc.cosine, *sine = arc.sine;
        for (int a = 0; a < R; ++a)
            row[a] = (cosine[a]*q1 - sine[a]*v1.hi) + (cosine[a]*q1e - sine[a]*v1e);
        for (int a = 0; a < R && velocities; ++a) row[n*R + a] = cosine[a]*v1.hi + arc.slope[a]*q1;
        const gvi__two to_q = gvi__sum(q1, -from->q[i]), to_p = gvi__sum(p1, -from->p[i]);
        dq[i] = to_q.hi;
        dqe[i] = to_q.lo + q1e;
        dp[i] = to_p.hi;
        dpe[i] = to_p.lo + p1e;
    }
}

// row of coordinate i := at, of free motion, + M^-1 sum_j table[j][.] L_j
GVI__COPY void gvi__arc_row(const gvi_stepper *st, int i, int r, int R, const gvi_real *at,
                            const gvi_real *table, const gvi_real *L, gvi_real *row)
{
    const gvi_real m = st->x.over ? st->x.over[i] : 1;
#ifdef GVI__VECTORS
    for (int o = 0; R % 8 == 0 && o < R; o += GVI__LANES) {
        gvi__vector z;
        gvi__sum_vector(r, R, table + o, L, &z);
        *(gvi__vector *)(row + o) = GVI__AT(at + o) + z*m;
    }
    if (R % 8 == 0) return;
#endif
    gvi__sum_row(r, R, table, L, row);
    for (int k = 0; k < R; ++k) row[k] = at[k] + row[k]*m;
}

// row i of a stage := next; the squares of its changes go to lane, from the last point on
static inline void gvi__replace_row(const gvi__stage *y, int i, int r, int R, const gvi_real *next, gvi_real *lane)
{
    gvi_real *row = y->rows + i*R;
    gvi__rescale(y->base[i], row[r - 1], next[r - 1], y->scale + i);
    for (int k = R; k-- > 0; ) {
        const gvi_real moved = (next[k] - row[k])*y->scale[i];
        lane[k & 7] += moved*moved;
        row[k] = next[k];
    }
}

/* F := F + k Q, what is left of the force, and from it the rows; then those of V.  */
GVI__COPY gvi_real gvi__arc_rows_of(const gvi_stepper *st, const gvi__stage *y, int r, int R, int velocities)
{
    const struct gvi__private *x = &st->x;
    const gvi_real *stiffness = gvi__stiffness(st);
    gvi_real lane[8] = { 0, 0, 0, 0, 0, 0, 0, 0 }, own[2*16], *L = R > 16 ? x->row : own, *next = L + R;
    const gvi_real *at = gvi__free_rows(st) + velocities*st->n*R;
    for (int i = 0; i < st->n; ++i, at += R) {
        const gvi_real k = stiffness[i];
        gvi_real *row = y->rows + i*R, *F = x->work.F + i*R;
        for (int j = 0; j < R && gvi__nonzero(k) && !velocities; ++j) F[j] += k*row[j];
        gvi__weigh(R, x->hb, F, L);
        if (gvi__nonzero(k)) {
            const gvi__arc arc = gvi__arc_of(st, (int)stiffness[st->n + i]);
            gvi__arc_row(st, i, r, R, at, velocities ? arc.E : arc.K, L, next);
        } else {
            gvi__sum_row(r, R, y->table, L, next);
            gvi__affine_row(st, y, i, next);
        }
        gvi__replace_row(y, i, r, R, next, lane);
    }
    return gvi__sum_lanes(lane);
}

#ifdef GVI__VECTORS
// F := F + k Q of a few coordinates, and h b F ahead of their sums, which would have to wait for it
GVI__COPY void gvi__remainders_ahead(const gvi_stepper *st, const gvi__stage *y, const gvi_real *stiffness,
                                     int i, int few, int R, const gvi__vector *hb, gvi_real *ahead,
                                     int velocities)
{
    const int vectors = R/GVI__LANES, end = i + few < st->n ? i + few : st->n;
    gvi_real *F = st->x.work.F + i*R;
    const gvi_real *Q = y->rows + i*R;
    for (; i < end; ++i, F += R, Q += R, ahead += R)
        GVI__EACH for (int v = 0; v < vectors; ++v) {
            gvi__vector f = GVI__AT(F + v*GVI__LANES);
            if (!velocities && gvi__nonzero(stiffness[i])) {
                f += stiffness[i]*GVI__AT(Q + v*GVI__LANES);
                *(gvi__vector *)(F + v*GVI__LANES) = f;
            }
            *(gvi__vector *)(ahead + v*GVI__LANES) = hb[v]*f;
        }
}

/* The same for five to sixteen points.                                         */
GVI__COPY gvi_real gvi__arc_rows_vector(const gvi_stepper *st, const gvi__stage *y, int r, int R,
                                        int velocities)
{
    enum { MOST = 16/GVI__LANES, EIGHT = 8/GVI__LANES };
    const struct gvi__private *x = &st->x;
    const gvi_real *diagonal = gvi__diagonal(st, y), *stiffness = gvi__stiffness(st);
    const int n = st->n, vectors = R/GVI__LANES, few = 64/R, apart = R == 16 && !GVI__KEPT;
    const gvi__stage own = *y;
    const gvi_real *at = gvi__free_rows(st) + velocities*n*R;
    gvi_real *row = own.rows, ahead[64];
    gvi__vector kept[8], c[MOST], hb[MOST], squares[EIGHT] = { { 0 } };
    const gvi_real *table = R == 8 ? gvi__keep(r, y->table, kept) : y->table;
    GVI__EACH for (int v = 0; v < vectors; ++v) {
        c[v] = GVI__AT(x->c + v*GVI__LANES);
        hb[v] = GVI__AT(x->hb + v*GVI__LANES);
    }
    for (int i = 0; i < n; ++i, row += R, at += R) {
        if (i % few == 0) gvi__remainders_ahead(st, y, stiffness, i, few, R, hb, ahead, velocities);
        const gvi_real *L = ahead + i % few*R, *K = table;
        const int stiff = gvi__nonzero(stiffness[i]);
        gvi__vector next[MOST];
        if (stiff) {
            const gvi__arc arc = gvi__arc_of(st, (int)stiffness[n + i]);
            K = velocities ? arc.E : arc.K;
        }
        if (apart || stiff) gvi__sum_vectors(r, R, vectors, K, L, next);
        if (stiff) {
            GVI__EACH for (int v = 0; v < vectors; ++v) {
                if (diagonal) next[v] *= diagonal[i];
                next[v] = GVI__AT(at + v*GVI__LANES) + next[v];
            }
        } else {
            const gvi__affine p = { own.base[i], own.extra[i], velocities ? 0 : own.rest[i],
                                    velocities ? 0 : own.path[i], own.factor, diagonal ? diagonal[i] : 1 };
            if (!apart) gvi__sum_vectors(r, R, vectors, table, L, next);
            gvi__affine_vectors(&p, diagonal, vectors, c, next);
        }
        if (R == 16) gvi__replace(own.base[i], r - 9, next + EIGHT, row + 8, own.scale + i, squares);
        gvi__replace(own.base[i], r - 1, next, row, own.scale + i, squares);
    }
    return gvi__sum_squares(squares);
}
#endif

// F := F + k Q, where no rows follow
static void gvi__remainders(gvi_stepper *st)
{
    const gvi_real *stiffness = gvi__stiffness(st);
    const int R = st->x.stride;
    for (int i = 0; i < st->n; ++i)
        for (int j = 0; j < R && gvi__nonzero(stiffness[i]); ++j)
            st->x.work.F[i*R + j] += stiffness[i]*st->x.work.Q[i*R + j];
}

/* Before the first rows F is what is left of the force, extrapolated: that at Q = 0.  If
   there is none springs are taken to be at rest where they are.                */
static void gvi__spring_guess(const gvi_stepper *st, const gvi__from *from, int extrapolate)
{
    const int R = st->x.stride;
    for (int i = 0; i < st->n*R; ++i) st->x.work.Q[i] = extrapolate ? 0 : from->q[i/R];
}

/* gvi__stage_rows_of in less code and without blocks, squares added up from the last
   point on, as there.  Also where M is a full matrix: all sums first, then M^-1 of them. */
GVI__APART gvi_real gvi__stage_rows_plain(gvi_stepper *st, const gvi__stage *y)
{
    const struct gvi__private *x = &st->x;
    const int n = st->n, R = x->stride;
    const int dense = y->over_mass && gvi__mass_is(st, GVI_MASS_DENSE);
    gvi_real lane[8] = { 0, 0, 0, 0, 0, 0, 0, 0 }, *z = dense ? x->Z : x->row;
    for (int i = 0; dense && i < n; ++i) gvi__row_sums(st, y, i, z + i*R);
    if (dense) gvi__over_mass(st, z, R, R);
    for (int i = 0; i < n; ++i) {
        if (dense) z = x->Z + i*R;
        else gvi__row_sums(st, y, i, z);
        gvi__affine_row(st, y, i, z);
        gvi__replace_row(y, i, st->r, R, z, lane);
    }
    return gvi__sum_lanes(lane);
}

/* One function for each usual number of points.                                */
#define GVI__ROWS(name, call) static gvi_real name(gvi_stepper *st, const gvi__stage *y) { return call; }
GVI__ROWS(gvi__rows_1, gvi__stage_rows_of(st, y, 1, 1))
GVI__ROWS(gvi__rows_2, gvi__stage_rows_of(st, y, 2, 2))
GVI__ROWS(gvi__rows_3, gvi__stage_rows_of(st, y, 3, 3))
GVI__ROWS(gvi__rows_4, gvi__stage_rows_of(st, y, 4, 4))
GVI__ROWS(gvi__rows_any, gvi__stage_rows_of(st, y, st->r, st->x.stride))
GVI__ROWS(gvi__arc_rows, gvi__arc_rows_of(st, y, st->r, st->x.stride, 0))
GVI__ROWS(gvi__arc_rows_4, gvi__arc_rows_of(st, y, 4, 4, 0))
GVI__ROWS(gvi__arc_slopes, gvi__arc_rows_of(st, y, st->r, st->x.stride, 1))
#ifdef GVI__VECTORS
GVI__ROWS(gvi__rows_6, gvi__stage_rows_8(st, y, 6, st->n, gvi__folds(st)))
GVI__ROWS(gvi__rows_8, gvi__stage_rows_8(st, y, 8, st->n, 0))
GVI__ROWS(gvi__rows_8_folded, gvi__stage_rows_8(st, y, 8, st->n, 1))
GVI__ROWS(gvi__rows_5_to_8, gvi__stage_rows_8(st, y, st->r, st->n, gvi__folds(st)))
GVI__ROWS(gvi__rows_8_less, gvi__stage_rows_of(st, y, 8, 8))
GVI__ROWS(gvi__rows_16, gvi__stage_rows_16(st, y, 16, st->n))
GVI__ROWS(gvi__rows_9_to_15, gvi__stage_rows_16(st, y, st->r, st->n))
GVI__ROWS(gvi__rows_16_less, gvi__stage_rows_of(st, y, st->r, 16))
GVI__ROWS(gvi__arc_rows_8, gvi__arc_rows_vector(st, y, 8, 8, 0))
GVI__ROWS(gvi__arc_rows_to_8, gvi__arc_rows_vector(st, y, st->r, 8, 0))
GVI__ROWS(gvi__arc_rows_to_16, gvi__arc_rows_vector(st, y, st->r, 16, 0))
GVI__ROWS(gvi__arc_rows_16, gvi__arc_rows_vector(st, y, 16, 16, 0))
GVI__ROWS(gvi__arc_slopes_to_8, gvi__arc_rows_vector(st, y, st->r, 8, 1))
#endif

static gvi__kernel *gvi__arc_kernel(const gvi_stepper *st, int velocities)
{
#ifdef GVI__VECTORS
    if (velocities && st->x.stride == 8) return gvi__arc_slopes_to_8;
    if (!velocities && st->r == 8) return gvi__arc_rows_8;
    if (!velocities && st->x.stride == 8) return gvi__arc_rows_to_8;
    if (!velocities && st->r == 16) return gvi__arc_rows_16;
    if (!velocities && st->x.stride == 16) return gvi__arc_rows_to_16;
#endif
    return velocities ? gvi__arc_slopes : st->r == 4 ? gvi__arc_rows_4 : gvi__arc_rows;
}

static gvi__kernel *gvi__kernel_of(const gvi_stepper *st, const gvi__stage *y)
{
    if (y->over_mass && gvi__mass_is(st, GVI_MASS_DENSE)) return gvi__stage_rows_plain;
    switch (st->r) {
    case 1:  return gvi__rows_1;
    case 2:  return gvi__rows_2;
    case 3:  return gvi__rows_3;
    case 4:  return gvi__rows_4;
#ifdef GVI__VECTORS
    case 5:
    case 7:  return y->minus ? gvi__rows_any : gvi__rows_5_to_8;
    case 6:  return y->minus ? gvi__rows_any : gvi__rows_6;
    case 8:
        if (y->minus) return gvi__rows_8_less;
        return gvi__folds(st) ? gvi__rows_8_folded : gvi__rows_8;
    case 16: return y->minus ? gvi__rows_16_less : gvi__rows_16;
    default:
        if (st->x.stride != 16) return gvi__rows_any;
        return y->minus ? gvi__rows_16_less : gvi__rows_9_to_15;
#else
    default: return gvi__rows_any;
#endif
    }
}

// the new rows of a stage and their change
static inline gvi_real gvi__stage_rows(gvi_stepper *st, const gvi__stage *y)
{
    return GVI__SMALL ? gvi__stage_rows_plain(st, y) : y->kernel(st, y);
}

// V := M^-1 (P - A), with the constant mass or the factored M(Q)
static void gvi__velocity_rows(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    struct gvi__rows *w = &x->work;
    const gvi_real *GVI__RESTRICT P = w->P, *GVI__RESTRICT A = gvi__A(w);
    gvi_real *GVI__RESTRICT V = w->V;
    int n = st->n, R = x->stride;
#ifdef GVI__VECTORS
    if (R % 8 == 0 && !gvi__mass_is_constant(&x->desc)) {
        for (int k = 0; A && k < n*R; k += GVI__LANES)
            *(gvi__vector *)(V + k) = GVI__AT(P + k) - GVI__AT(A + k);
        gvi__ldl_solve_eights(n, R, x->point_mass, A ? V : P, V);
        return;
    }
#endif
    for (int k = 0; k < n*R; ++k) V[k] = P[k] - (A ? A[k] : 0);
    if (gvi__mass_is_constant(&x->desc)) gvi__over_mass(st, V, R, st->r);
    else gvi__ldl_solve(n, x->point_mass, R, V, R, st->r);
}

#define GVI__MADE (GVI__SMALL && GVI__TOLERANCE)                    // each time anew: gvi__stage_made

// h (v + ve) of a step, where the increments of q will be
GVI__APART void gvi__path(gvi_stepper *st, const gvi__from *from, gvi_real h)
{
    struct gvi__private *x = &st->x;
    const gvi_real *ve = gvi__ve(st, from);
    for (int i = 0; i < st->n; ++i) {
        const gvi__two path = gvi__product(h, from->v[i]);
        x->dq[i] = path.hi;
        x->dqe[i] = GVI__RESTS ? gvi__rest(path.lo + h*ve[i]) : 0;
    }
}

// stage y of an iteration, fixed for a step; positions with gvi__path
static void gvi__plan(gvi_stepper *st, const gvi__from *from, gvi_real h, int stage, gvi__stage *y)
{
    struct gvi__private *x = &st->x;
    struct gvi__rows *w = &x->work;
    const int momenta = gvi__uses(st, GVI_MOMENTA);
    y->path = y->minus = NULL;
    y->rest = x->dqe;
    y->f = w->F;
    y->factor = 1;
    y->scale = x->scale + stage*st->n;
    y->over_mass = !momenta;
    y->table = gvi__folds(st) ? x->folded + stage*st->r*x->stride : gvi__stage_table(st, stage);
    if (GVI__STAGES == 1 || stage == momenta) {
        y->base = from->q;
        y->extra = from->qe;
        y->rows = w->Q;
        if (momenta) y->f = w->V;
        else {
            y->path = GVI__PATH ? x->dq : from->v;
            y->minus = gvi__A(w) ? x->T : NULL;
            y->factor = h;
        }
    } else {
        y->base = momenta ? from->p : from->v;
        y->extra = momenta ? from->pe : gvi__ve(st, from);
        y->rows = momenta ? w->P : w->V;
        if (!momenta && gvi__A(w)) y->minus = x->N;
    }
    if (GVI__SMALL) y->kernel = NULL;
    else if (GVI__STIFF && x->springs) y->kernel = gvi__arc_kernel(st, stage);
    else y->kernel = gvi__kernel_of(st, y);
}

// row := a row, element by element
static inline void gvi__scale_row(int R, const gvi_real *GVI__RESTRICT a, gvi_real *GVI__RESTRICT row)
{
    for (int k = 0; k < R; ++k) row[k] *= a[k];
}

/* V from the new P, with the old M(Q) and dL/dv.  Where Lagrangian terms make V it
   contracts alike at any h, also when Q and P, a short step away, feel no more of it:
   returns the squares of its relative changes at the last point, as of all points. */
GVI__DEEP gvi_real gvi__velocity_change(gvi_stepper *st, int clock)
{
    struct gvi__private *x = &st->x;
    const int n = st->n, R = x->stride, made = gvi__A(&x->work) != NULL;
    const gvi_real *V = x->work.V + st->r - 1;
    gvi_real *was = x->change + 2*n, sum = 0;
    if (made) gvi__gather(n, R, V, was);
    gvi__velocity_rows(st);
    for (int i = 0; clock && i < n; ++i) gvi__scale_row(R, x->rate, x->work.V + i*R);
    for (int i = 0; made && i < n; ++i) {
        const gvi_real size = GVI_ABS(V[i*R]) + GVI_ABS(was[i]), moved = V[i*R] - was[i];
        if (size > GVI__MIN/GVI__EPS) sum += moved/size*(moved/size);
    }
    return (gvi_real)st->r*sum;
}

/* Compiled for size: a stage is made where it is needed, and not on the stack while
   effects are asked.                                                          */
GVI__APART gvi_real gvi__stage_made(gvi_stepper *st, const gvi__from *from, gvi_real h, int stage)
{
    gvi__stage y;
    gvi__plan(st, from, h, stage, &y);
    return gvi__stage_rows(st, &y);
}

/* The rows of the next iteration from the F, V and A of this one; returns the
   sum of squares of their relative changes.                                   */
static gvi_real gvi__stages(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi__stage *y,
                               int count)
{
    struct gvi__private *x = &st->x;
    gvi_real sum = GVI__MADE ? gvi__stage_made(st, from, h, 0) : gvi__stage_rows(st, y);
    if ((GVI__MADE ? gvi__stage_count(st) : count) == 1) return sum;
    const int clock = gvi__has_clock(st), factor = x->has_factor || gvi__mass_is_constant(&x->desc);
    if (gvi__uses(st, GVI_MOMENTA) && factor && !x->desc.mass.velocity && (!clock || x->has_rate))
        sum += gvi__velocity_change(st, clock);         // contracts twice as fast
    gvi__count(&st->counters.velocities, st->r);
    return sum + (GVI__MADE ? gvi__stage_made(st, from, h, 1) : gvi__stage_rows(st, y + 1));
}

// momenta: V from dL/dv(Q, V) = P
GVI__APART gvi_status gvi__legendre_rows(gvi_stepper *st, gvi_points *y)
{
    struct gvi__private *x = &st->x;
    gvi__count(&st->counters.velocities, st->r);
    if (x->desc.mass.velocity) {
        const gvi_status status = gvi__ask_mass(st, y, x->work.P, x->work.V);
        if (status != GVI_OK || !gvi__diagnoses(st)) return status;
        return gvi__check_rows(st, y, x->work.V, GVI_FAULT_MASS);
    }
    const gvi_status status = gvi__mass_is_constant(&x->desc) ? GVI_OK : gvi__factor_at(st, y);
    if (status != GVI_OK) return status;
    x->has_factor = !gvi__mass_is_constant(&x->desc);
    gvi__velocity_rows(st);
    return GVI_OK;
}

// the clock's g and dg/dq at the points
static gvi_status gvi__rate(gvi_stepper *st, const gvi_points *x, gvi_real *rate, gvi_real *slope)
{
    gvi_points y;
    gvi__at(&y, st, x->t, x->q);                  // a copy of x would have to wait for its stores
    y.count = x->count;
    y.stride = x->stride;
    y.f = slope;
    y.dldv = NULL;
    y.value = rate;
    gvi__zero((size_t)x->n*(size_t)x->stride, slope);
    gvi__zero((size_t)x->stride, rate);
    const gvi_status status = gvi__call(st, &y, st->x.clock);
    if (status != GVI_OK) return status;
    for (int k = 0; k < x->count; ++k) {
        const gvi_status verdict = rate[k] <= 0 ? GVI_E_CLOCK
            : gvi__diagnoses(st) && !gvi__finite(rate[k]) ? GVI_E_NON_FINITE : GVI_OK;
        if (verdict != GVI_OK) return gvi__fail(st, verdict, st->x.clock, GVI_FAULT_NONE, k);
    }
    return gvi__diagnoses(st) ? gvi__check_rows(st, x, slope, st->x.clock) : GVI_OK;
}

// sum += a b/2
static inline void gvi__add_products(int R, const gvi_real *GVI__RESTRICT a, const gvi_real *GVI__RESTRICT b,
                                     gvi_real *GVI__RESTRICT sum)
{
    for (int k = 0; k < R; ++k) sum[k] += a[k]*b[k]/2;
}

// F := g F - dg/dq (H - E)
static inline void gvi__transform_row(int R, const gvi_real *GVI__RESTRICT g,
                                      const gvi_real *GVI__RESTRICT slope,
                                      const gvi_real *GVI__RESTRICT excess, gvi_real *GVI__RESTRICT F)
{
    for (int k = 0; k < R; ++k) F[k] = g[k]*F[k] - slope[k]*excess[k];
}

/* What a clock makes of F and V:  F := g F - dg/dq (H - E),  V := g v, with
   H = (P + A)'V/2 + V_pot - L, and E and the times by the rule of Q: sums with T. */
static void gvi__transform(gvi_stepper *st, const gvi__from *from, int lagrangian)
{
    struct gvi__private *x = &st->x;
    struct gvi__rows *w = &x->work;
    const int n = st->n, R = x->stride;
    const gvi_real E = from->E;
    gvi_real *power = x->rate + R, *level = power + R;
    for (int k = 0; k < R; ++k) level[k] -= x->less[k] + E;
    if (gvi__has(st, GVI__HAS_VELOCITIES)) {
        gvi__scale_row(R, x->rate, power);
        gvi__weighted_sums(st, x->T, x->hb, power, x->less);
        for (int k = 0; k < R; ++k) level[k] -= x->less[k];
    }
    for (int i = 0; i < n; ++i) {
        gvi__add_products(R, w->P + i*R, w->V + i*R, level);
        if (lagrangian) gvi__add_products(R, w->A + i*R, w->V + i*R, level);
    }
    for (int i = 0; i < n; ++i) {
        gvi__transform_row(R, x->rate, x->slope + i*R, level, w->F + i*R);
        gvi__scale_row(R, x->rate, w->V + i*R);
    }
    gvi__weigh(R, x->hb, x->rate, x->less);
    if (st->r == 8 && !GVI__SMALL) gvi__sum_row(8, 8, x->T, x->less, x->z);
    else gvi__sum_row(st->r, R, x->T, x->less, x->z);
    for (int k = 0; k < R; ++k) x->t[k] = from->t + (from->te + x->z[k]);
    x->has_rate = 1;
}

// with a clock: forces first, for their power; then all else, with values
GVI__APART gvi_status gvi__ask_clock(gvi_stepper *st, const gvi__from *from, gvi_points *y)
{
    struct gvi__private *x = &st->x;
    const unsigned forces = gvi__has(st, GVI__HAS_VELOCITIES) ? gvi__of_kind(st, GVI_FORCE) : 0;
    const int R = x->stride;
    gvi_real *power = x->rate + R, *level = power + R;
    gvi_status status = forces & ~x->off ? gvi__effects(st, y, ~forces) : GVI_OK;
    gvi__zero((size_t)R, power);
    for (int i = 0; i < st->n && forces; ++i)
        for (int k = 0; k < st->r; ++k) power[k] += y->f[i*R + k]*y->v[i*R + k];
    gvi__zero((size_t)R, level);
    gvi__zero((size_t)R, x->less);
    if (status == GVI_OK && gvi__mass_is(st, GVI_MASS_POSITION)) status = gvi__mass_gradient(st, y);
    y->value = level;
    if (status == GVI_OK) status = gvi__effects(st, y, forces);
    y->value = NULL;
    if (status == GVI_OK) status = gvi__rate(st, y, x->rate, x->slope);
    if (status == GVI_OK) gvi__transform(st, from, y->dldv != NULL);
    return status;
}

/* rows [n][stride] := zero, in whole vectors where they are.  A zero that the compiler
   does not know keeps it from calling memset, which takes longer.             */
static inline void gvi__zero_rows(int n, int R, gvi_real zero, gvi_real *rows)
{
    const int length = n*R;
    if (GVI__SMALL) {
        gvi__zero((size_t)length, rows);
        return;
    }
#ifdef GVI__VECTORS
    gvi__vector none = { 0 };
    none += zero;
    for (int k = 0; R % 8 == 0 && k < length; k += GVI__LANES) *(gvi__vector *)(rows + k) = none;
    if (R % 8 == 0) return;
#endif
    for (int k = 0; k < length; ++k) rows[k] = zero;
}

// the weak effects that are not to be asked in each iteration
static inline unsigned gvi__seldom(const gvi_stepper *st)
{
    return GVI__WEAK && !st->x.diagnose ? st->x.marks & ~st->x.off : 0;
}

// what asking them anew changes, over what the rows had changed, squared: learned in the last
// step, and in this one
static inline gvi_real *gvi__answers(gvi_stepper *st) { return st->x.weak + st->n*st->x.stride; }

// y->f := the weak forces, asked anew or as they were
static gvi_status gvi__ask_weak(gvi_stepper *st, gvi_real zero, gvi_points *y, int anew)
{
    struct gvi__private *x = &st->x;
    gvi_real *f = y->f;
    gvi_status status = GVI_OK;
    if (anew) {
        gvi__zero_rows(st->n, st->x.stride, zero, y->f = x->weak);
        status = gvi__effects(st, y, ~gvi__seldom(st));
        y->f = f;
    }
    gvi__copy((size_t)st->n*(size_t)x->stride, x->weak, f);
    return status;
}

// F (and A, V) at the rows of this iteration, all points in one call an effect; the weak ones
// only if they are wanted anew
GVI__APART gvi_status gvi__ask(gvi_stepper *st, const gvi__from *from, gvi_real zero, gvi_points *y, int anew)
{
    gvi_points own;
    if (GVI__SMALL) gvi__rows_as_points(y = &own, st, &st->x.work, gvi__A(&st->x.work));
    gvi_status status = gvi__check_points(st, y);
    gvi__zero_rows(st->n, st->x.stride, zero, y->f);
    if (status == GVI_OK && gvi__uses(st, GVI_MOMENTA)) status = gvi__legendre_rows(st, y);
    if (GVI__LAGRANGIAN && y->dldv) gvi__zero_rows(st->n, st->x.stride, zero, y->dldv);
    if (status != GVI_OK) return status;
    if (gvi__has_clock(st)) return gvi__ask_clock(st, from, y);
    const unsigned some = gvi__seldom(st);
    if (some) status = gvi__ask_weak(st, zero, y, anew);
    if (status == GVI_OK) status = some ? gvi__effects(st, y, some) : gvi__all_effects(st, y);
    // last: it waits for V, as few effects do
    const int gradient = status == GVI_OK && gvi__uses(st, GVI_MOMENTA) && gvi__mass_is(st, GVI_MASS_POSITION);
    return gradient ? gvi__mass_gradient(st, y) : status;
}

// one effect of f alone is all that an iteration asks
static inline int gvi__asks_only(const gvi_stepper *st)
{
    return !GVI__SMALL && st->x.single >= 0 && !st->x.diagnose && !gvi__seldom(st)
        && !gvi__uses(st, GVI_MOMENTA) && !gvi__A(&st->x.work);
}

static inline gvi_status gvi__ask_only(gvi_stepper *st, gvi_real zero, gvi_points *y)
{
    gvi__zero_rows(st->n, st->x.stride, zero, y->f);
    return gvi__call(st, y, st->x.single);
}

/* Beyond h omega = 1.5 or so polynomials foretell little.  E then is the best guess at a random
   function whose values d steps apart are correlated like C(d) = 1/(1 + (a d)^2), a spectrum of
   exp(-h omega/a), and seen with errors of variance e = 64 EPS (Wiener 1949; kriging):

     E' = (C(x_i - x_j) + e I)^-1 C(x_i - y)     x and y from the middle of the nodes that are seen

   of two steps a = 0.4, x = c and c - 1, y = 1 + c, of one a = 0.7, x = c - 1/2, y = c + 1/2.
   Where c is symmetric -x are the same nodes, and the system falls in two: sums of the weights
   of x_j and -x_j have the matrix C(x_i - x_j) + C(x_i + x_j), differences that with a minus.  */
static gvi_real gvi__correlation(int two, gvi_real d)
{
    return 1/(1 + (two ? (gvi_real)0.16 : (gvi_real)0.49)*d*d);
}

// z [count][R] := sums of the weights, sign = 1, or differences, -1; 0: c is not symmetric, or K is singular
static int gvi__fit_half(gvi_stepper *st, int count, gvi_real sign, gvi_real *z)
{
    struct gvi__private *x = &st->x;
    const int r = st->r, R = x->stride, two = gvi__two_now(st);
    const gvi_real *c = x->c, middle = two ? 0 : (gvi_real)0.5;
    gvi_real *K = x->row;                         // count^2 is no more than its 9R: gvi__fits_long
    for (int i = 0; i < count; ++i) {
        const gvi_real a = c[i] - middle;
        if (GVI_ABS((c[i] - 1) + c[r - 1 - i]) > 8*GVI__EPS) return 0;
        for (int j = 0; j < count; ++j) {
            const gvi_real b = c[j] - middle;
            K[i*count + j] = gvi__correlation(two, a - b) + sign*gvi__correlation(two, a + b);
        }
        K[i*count + i] += 64*GVI__EPS*(gvi_real)(1 + (!two && 2*i + 1 == r));    // the middle is its own mirror image
        for (int k = 0; k < r; ++k) {
            const gvi_real y = 1 - middle + c[k];
            z[i*R + k] = gvi__correlation(two, y - a) + sign*gvi__correlation(two, y + a);
        }
    }
    const gvi_status status = gvi__ldl_factor(st, count, 1, 1, K);
    gvi__ldl_solve(count, K, 1, z, R, r);
    return status == GVI_OK;
}

static int gvi__fit_long(gvi_stepper *st)
{
    const int r = st->r, R = st->x.stride, two = gvi__two_now(st);
    const int sums = two ? r : (r + 1)/2, pairs = two ? r : r/2;
    gvi_real *sum = st->x.E, *difference = sum + sums*R;
    gvi__zero((size_t)((sums + pairs)*R), sum);
    if (!gvi__fit_half(st, sums, 1, sum) || !gvi__fit_half(st, pairs, -1, difference)) return 0;
    // weights of x_j and -x_j; the latter is node r-1-j, of the step before if there are two
    for (int j = 0; j < (pairs + 1)/2; ++j)
        for (int k = 0; k < r; ++k) {
            gvi_real *a = sum + k, *b = difference + k;
            const int m = (pairs - 1 - j)*R, l = j*R;
            const gvi_real near = a[l], far = b[l], other = a[m], rest = b[m];
            a[l] = (near + far)/2;
            a[m] = (other + rest)/2;
            b[m] = (near - far)/2;
            b[l] = (other - rest)/2;
        }
    return 1;
}

/* Least squares through the rows of one step or two, with polynomials p_k that are
   orthonormal on the nodes x_j = c, and c - 1 for the step before (Forsythe 1957):
   E_ij = sum_k p_k(y_i) p_k(x_j) at the targets y_i = alpha + beta c_i.  row holds
   p_k and p_(k-1) at c, c - 1 and y.  Degree: r - 1, through all of one step's; of
   two, what tests/cost found to be best; no more than amplifies rounding, by about
   5.8^degree at the end of the step, to 1e-4 in double; and none that only points
   tell apart that nearly coincide, as 0 and 1 - 1 do in two steps of Lobatto's: its
   coupling is then small, elsewhere it is above 0.1.                          */
GVI__SELDOM void gvi__fit(gvi_stepper *st, gvi_real alpha, gvi_real beta)
{
    struct gvi__private *x = &st->x;
    if (GVI__LEARNS && (x->E_is & GVI__LONG) && gvi__fit_long(st)) return;
    const int r = st->r, R = x->stride, two = gvi__two_now(st), nodes = two ? 2*R : R, most = GVI__DIG*2/7;
    const int wanted = two ? r + r/2 - r/8 : r - 1, degree = wanted < most ? wanted : most;
    gvi_real *p = x->row, *before = p + 3*R, *at = before + 3*R;
    gvi_real coupling = 0, norm = 1/GVI_SQRT((gvi_real)(two ? 2*r : r));
    for (int m = 0; m < 3*R; ++m) {
        const gvi_real c = x->c[m % R];
        at[m] = m < R ? c : m < 2*R ? c - 1 : alpha + beta*c;
        p[m] = m % R < r ? norm : 0;
        before[m] = 0;
    }
    gvi__zero((size_t)(two ? 2*r*R : r*R), x->E);
    for (int k = 0; k <= degree; ++k) {
        for (int j = 0; j < r; ++j)
            for (int i = 0; i < r; ++i) {
                x->E[j*R + i] += p[2*R + i]*p[j];
                if (two) x->E[(r + j)*R + i] += p[2*R + i]*p[R + j];
            }

        // p_(k+1) ~ (x - <x p_k, p_k>) p_k - coupling p_(k-1), over its norm
        gvi_real middle = 0, size = 0;
        for (int m = 0; m < nodes; ++m) middle += at[m]*p[m]*p[m];
        for (int m = 0; m < 3*R; ++m) {
            gvi_real next = (at[m] - middle)*p[m] - coupling*before[m];
            before[m] = p[m];
            p[m] = next;
            if (m < nodes) size += next*next;
        }
        coupling = GVI_SQRT(size);
        if (coupling < (gvi_real)0.015625) break;
        for (int m = 0; m < 3*R; ++m) p[m] /= coupling;
    }
}

/* The sums of (3) over what E extrapolates, in place: E := g h b E.  Where the rows
   of Q are all that the first forces are for, they come from the last ones at once. */
GVI__SELDOM void gvi__fit_sums(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    const int R = x->stride, rows = gvi__two_now(st) ? 2*st->r : st->r;
    for (int m = 0; GVI__STIFF && x->springs && m < (int)x->springs[1]; ++m) {
        const gvi__arc arc = gvi__arc_of(st, m);
        for (int j = 0; j < rows; ++j) gvi__weighted_sums(st, arc.K, x->hb, x->E + j*R, arc.E + j*R);
    }
    for (int j = 0; j < rows; ++j) gvi__weighted_sums(st, x->g, x->hb, x->E + j*R, x->E + j*R);
}

// gvi__extrapolate_rows of eight coordinates or more; the last eight may be some of those before
GVI__COPY void gvi__extrapolate_abreast(const gvi_stepper *st, int r, const gvi_real *last,
                                        const gvi_real *older, const gvi__stage *y,
                                        gvi_real *GVI__RESTRICT out)
{
    const int most = st->n - 8;
    for (int o = 0; o < st->n; o += 8) {
        const int i = o < most ? o : most;
        gvi__abreast z, before;
        gvi__sums_abreast(r, st->x.E, last + i*r, z);
        if (older) {
            gvi__sums_abreast(r, st->x.E + r*r, older + i*r, before);
            for (int k = 0; k < r; ++k)
                for (int l = 0; l < 8; ++l) z[k][l] += before[k][l];
        }
        if (y) gvi__affine_abreast(st, y, i, r, z);
        for (int l = 0; l < 8; ++l)
            for (int k = 0; k < r; ++k) out[(i + l)*r + k] = z[k][l];
    }
}

// up to four points and without stiffness; returns whether it was done
static int gvi__extrapolate_few(const gvi_stepper *st, const gvi_real *last, const gvi_real *older,
                                const gvi__stage *y, gvi_real *out)
{
    if (!GVI__WIDE || st->n < 8 || (GVI__STIFF && st->x.springs)) return 0;
    switch (st->r) {
    case 1:  gvi__extrapolate_abreast(st, 1, last, older, y, out); break;
    case 2:  gvi__extrapolate_abreast(st, 2, last, older, y, out); break;
    case 3:  gvi__extrapolate_abreast(st, 3, last, older, y, out); break;
    case 4:  gvi__extrapolate_abreast(st, 4, last, older, y, out); break;
    default: return 0;
    }
    return 1;
}

/* Extrapolates rows of the last step, or of the last two, to the points of the
   next:  out_i = sum_j E_ij last_j (+ sum_j E_i,r+j older_j).  y, if not NULL: E is
   gvi__fit_sums', and what it gives is put into that stage's row.  two, arcs: of two
   steps, and beside stiffness; constants for eight points.                     */
GVI__COPY void gvi__extrapolate_rows(const gvi_stepper *st, int n, int r, int R, int two, int arcs,
                                     const gvi_real *last, const gvi_real *older, const gvi__stage *y,
                                     gvi_real *out)
{
    const struct gvi__private *x = &st->x;
#ifdef GVI__VECTORS
    enum { VECTORS = GVI__SMALL ? 1 : 8/GVI__LANES };           // at once
    gvi__vector kept[2][8];
    const gvi_real *E = R == 8 ? gvi__keep(r, x->E, kept[0]) : x->E, *older_E = x->E + r*R;
    if (R == 8 && two) older_E = gvi__keep(r, older_E, kept[1]);
#endif
    const gvi_real *stiffness = arcs ? gvi__stiffness(st) : NULL;
    for (int i = 0; i < n; ++i, last += R) {
        gvi_real *row = out + i*R;
        if (arcs && gvi__nonzero(stiffness[i])) {
            gvi__arc_row(st, i, r, R, gvi__free_rows(st) + i*R,
                         gvi__arc_of(st, (int)stiffness[n + i]).E, last, row);
            continue;
        }
#ifdef GVI__VECTORS
        gvi__affine p = { 0, 0, 0, 0, 1, 1 };
        if (y) p = gvi__affine_of(y, gvi__diagonal(st, y), i);
        for (int o = 0; R % 8 == 0 && o < R; o += VECTORS*GVI__LANES) {
            gvi__vector z[VECTORS];
            gvi__sum_vectors(r, R, VECTORS, E + o, last, z);
            if (two) {
                gvi__vector before[VECTORS];
                gvi__sum_vectors(r, R, VECTORS, older_E + o, older + i*R, before);
                GVI__EACH for (int v = 0; v < VECTORS; ++v) z[v] += before[v];
            }
            GVI__EACH for (int v = 0; v < VECTORS; ++v) {
                const gvi__vector c = GVI__AT(x->c + o + v*GVI__LANES);
                if (y) z[v] = p.base + (((p.extra + c*p.rest) + c*p.a) + z[v]*p.m*p.b);
                *(gvi__vector *)(row + o + v*GVI__LANES) = z[v];
            }
        }
        if (R % 8 == 0) continue;
#endif
        gvi__sum_row(r, R, x->E, last, row);
        if (two) gvi__sum_row(r, R, x->E + r*R, older + i*R, x->z);
        for (int k = 0; two && k < R; ++k) row[k] += x->z[k];
        if (y) gvi__affine_row(st, y, i, row);
    }
}

GVI__APART void gvi__extrapolate(gvi_stepper *st, const gvi_real *last, const gvi_real *older,
                                 const gvi__stage *y, gvi_real *out)
{
    const int n = st->n, r = st->r, R = st->x.stride;
    const int two = gvi__two_now(st), arcs = GVI__STIFF && y && st->x.springs;
    if (gvi__extrapolate_few(st, last, two ? older : NULL, y, out)) return;
    if (GVI__SMALL) gvi__extrapolate_rows(st, n, r, R, two, arcs, last, older, y, out);
    else if (r == 8 && y && two) gvi__extrapolate_rows(st, n, 8, 8, 1, 0, last, older, y, out);    // never with arcs
    else if (r == 8 && y) gvi__extrapolate_rows(st, n, 8, 8, 0, arcs, last, NULL, y, out);
    else if (r == 8) gvi__extrapolate_rows(st, n, 8, 8, two, 0, last, older, NULL, out);
    else if (r == 4) gvi__extrapolate_rows(st, n, 4, 4, two, arcs, last, older, y, out);
#ifdef GVI__VECTORS
    else if (R == 8) gvi__extrapolate_rows(st, n, r, 8, two, arcs, last, older, y, out);
    else if (r == 16) gvi__extrapolate_rows(st, n, 16, 16, 0, arcs, last, NULL, y, out);
    else if (R == 16) gvi__extrapolate_rows(st, n, r, 16, two, arcs, last, older, y, out);
#endif
    else gvi__extrapolate_rows(st, n, r, R, two, arcs, last, older, y, out);
}

/* Which E is better for this motion and h?  Where eight steps take six rounds in the mean, from ten points
   on eight, the next eight are made with the other, and the one with fewer rounds stays, for a thousand.
   At once where E led nowhere: GVI__LOST rounds.                              */
enum { GVI__LOST = 3000 };

static void gvi__learn(gvi_stepper *st, int used)
{
    struct gvi__learned *y = &st->x.learned;
    const int lost = used >= GVI__LOST, many = gvi__two_now(st) ? 48 : 64;
    if (gvi__counts(st)) return;
    if (y->stage != GVI__IDLES) y->rounds = (short)(y->rounds + (lost ? GVI__LOST : used));
    y->steps = (short)(y->steps + 1);
    if (!lost && y->steps < (y->stage == GVI__IDLES ? 1024 : 8)) return;
    const int tries = y->stage != GVI__TRIES && (lost || (y->stage == GVI__MEASURES && y->rounds >= many));
    if (tries || (y->stage == GVI__TRIES && y->rounds >= y->before)) {
        y->lengthy = !y->lengthy;
        st->x.usual = 0;                              // E is to change
    }
    y->before = lost ? 8*GVI__LOST : y->rounds;
    y->stage = (signed char)(tries ? GVI__TRIES : y->stage == GVI__IDLES ? GVI__MEASURES : GVI__IDLES);
    y->rounds = y->steps = 0;
}

// what is solved: a step, or for a query a part of the last one, from its start or its end
enum { GVI__STEP, GVI__FROM_START, GVI__FROM_END };

/* E for this step, if it is not that already: the rows of the last one are at alpha + beta c
   of theirs, c being the nodes of this.                                       */
GVI__APART void gvi__prepare_guess(gvi_stepper *st, gvi_real h, int query)
{
    struct gvi__private *x = &st->x;
    const gvi_real alpha = query != GVI__FROM_START, beta = h/st->h;
    const int step = !query && !gvi__by_newton(st);   // Newton's method wants V, of the last step alone
    const int again = GVI__BEYOND_FLOAT && step && x->alike == 2 && !gvi__nonzero(beta - 1);
    const int two = again && x->older_F;
    const int sums = step && gvi__uses(st, GVI_POSITIONS) && !gvi__mass_is(st, GVI_MASS_DENSE)
                     && !gvi__A(&x->work);
    const int lengthy = again && gvi__fits_long(st) && x->learned.lengthy;
    const signed char is = (signed char)((two ? GVI__OF_TWO : 0) + (sums ? GVI__SUMS : 0)
                                         + (lengthy ? GVI__LONG : 0));
    if (!query && !gvi__nonzero(beta - x->ratio) && is == x->E_is) return;
    x->ratio = query ? 0 : beta;
    x->E_is = is;
    if (GVI__PIECES) x->usual = 0;
    gvi__fit(st, alpha, beta);
    if (sums) gvi__fit_sums(st);
}

// the same as gvi__stage_made, of the first rows
GVI__APART void gvi__extrapolate_made(gvi_stepper *st, const gvi__from *from, gvi_real h)
{
    gvi__stage y;
    gvi__plan(st, from, h, 0, &y);
    gvi__extrapolate(st, st->x.last.F, st->x.older_F, &y, st->x.work.Q);
}

/* Starting values: what the last step had, extrapolated; without one, or if
   that led nowhere, no force and constant velocity; `rate` is the clock's.     */
static void gvi__guess(gvi_stepper *st, int extrapolate, gvi_real rate)
{
    struct gvi__private *x = &st->x;
    struct gvi__rows *w = &x->work, *l = &x->last;
    size_t length = (size_t)st->n*(size_t)x->stride;
    x->has_factor = x->has_rate = 0;
    if (extrapolate) {
        gvi__extrapolate(st, l->F, x->older_F, NULL, w->F);
        if (gvi__A(l) && w->A) gvi__extrapolate(st, l->A, x->older_A, NULL, w->A);
        if (gvi__uses(st, GVI_MOMENTA)) gvi__extrapolate(st, l->V, x->older_V, NULL, w->V);
    } else {
        gvi__zero(length, w->F);
        if (gvi__A(w)) gvi__zero(length, w->A);
        if (gvi__uses(st, GVI_MOMENTA)) gvi__velocity_guess(st, x->one);
        for (int i = 0; gvi__uses(st, GVI_MOMENTA) && i < st->n; ++i)
            for (int k = 0; k < st->r; ++k) w->V[i*x->stride + k] = rate*x->one[i];
    }
}

/* sum_j a_j b_j + rest, the sum carried with its rounding: an increment is what
   errors add up in, step by step.  Eight partial sums, then these by halves;
   z: scratch for them, of two rows.                                           */
GVI__APART gvi__two gvi__exact_dot(int r, const gvi_real *a, const gvi_real *b, gvi_real rest, gvi_real *z)
{
    const int lanes = r < 8 ? r : 8;
    gvi_real own[16], *hi = GVI__SMALL ? z : own, *lo = hi + lanes;
    gvi__two sum;
    for (int j = 0; j < r; ++j) {
        const int k = GVI__RULES ? j & 7 : j;
        sum = gvi__product(a[j], b[j]);
        if (GVI__RULES && j >= 8) sum = gvi__join(hi[k], lo[k], sum.hi, sum.lo);
        hi[k] = sum.hi;
        lo[k] = sum.lo;
    }
    for (int half = r > 4 ? 4 : r > 2 ? 2 : 1; half > 0; half /= 2)
        for (int k = 0; k + half < lanes && k < half; ++k) {
            sum = gvi__join(hi[k], lo[k], hi[k + half], lo[k + half]);
            hi[k] = sum.hi;
            lo[k] = sum.lo;
        }
    return gvi__two_of(hi[0], gvi__rest(lo[0] + rest));
}

// sum_j (1 - c_j) h b_j F_j: what (3) is at tau = 1, where S_j = c_j
static gvi_real gvi__lever_sum(int r, const gvi_real *c, const gvi_real *hb, const gvi_real *F)
{
    gvi_real sum[4];
    sum[0] = sum[1] = sum[2] = sum[3] = 0;        // an initialiser would be a call of memset
    for (int j = 0; j < r; ++j) sum[j & 3] += (1 - c[j])*(hb[j]*F[j]);
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

#ifdef GVI__VECTORS
typedef gvi_real gvi__half
    __attribute__((vector_size(4*sizeof(gvi_real)), aligned(sizeof(gvi_real)), may_alias));
typedef gvi_real gvi__pair
    __attribute__((vector_size(2*sizeof(gvi_real)), aligned(sizeof(gvi_real)), may_alias));
#define GVI__HALF(p) (*(const gvi__half *)(p))
#define GVI__PAIR(p) (*(const gvi__pair *)(p))

// both sums in vectors of points: the same terms in the same order
static inline gvi__two gvi__exact_sum_vector(int R, const gvi_real *a, const gvi_real *b)
{
    gvi_real hi[8], lo[8];
    GVI__ROLLED for (int k = 0; k < 8; ++k) {         // unrolled, gcc would store them one by one
        const gvi__two term = gvi__product(a[k], b[k]);
        hi[k] = term.hi;
        lo[k] = term.lo;
    }
    for (int o = 8; o < R; o += 8)
        for (int k = 0; k < 8; ++k) {
            const gvi__two term = gvi__product(a[o + k], b[o + k]);
            const gvi__two sum = gvi__join(hi[k], lo[k], term.hi, term.lo);
            hi[k] = sum.hi;
            lo[k] = sum.lo;
        }
    const gvi__half x = GVI__HALF(hi), y = GVI__HALF(hi + 4), s = x + y, z = s - x;
    *(gvi__half *)hi = s;
    *(gvi__half *)lo = (GVI__HALF(lo) + GVI__HALF(lo + 4)) + ((x - (s - z)) + (y - z));
    const gvi__pair u = GVI__PAIR(hi), v = GVI__PAIR(hi + 2), t = u + v, w = t - u;
    *(gvi__pair *)hi = t;
    *(gvi__pair *)lo = (GVI__PAIR(lo) + GVI__PAIR(lo + 2)) + ((u - (t - w)) + (v - w));
    return gvi__join(hi[0], lo[0], hi[1], lo[1]);
}

static inline gvi__two gvi__exact_dot_vector(int R, const gvi_real *a, const gvi_real *b, gvi_real rest)
{
    const gvi__two sum = gvi__exact_sum_vector(R, a, b);
    return gvi__two_of(sum.hi, gvi__rest(sum.lo + rest));
}

// gvi__exact_dot_vector without what rounding leaves: its hi
static inline gvi_real gvi__coarse_dot_vector(int R, const gvi_real *a, const gvi_real *b)
{
    gvi_real z[8];
    for (int k = 0; k < 8; ++k) z[k] = a[k]*b[k];
    for (int o = 8; o < R; o += 8)
        for (int k = 0; k < 8; ++k) z[k] += a[o + k]*b[o + k];
    const gvi__half s = GVI__HALF(z) + GVI__HALF(z + 4);
    return (s[0] + s[2]) + (s[1] + s[3]);
}

static inline gvi_real gvi__lever_vector(int R, const gvi_real *c, const gvi_real *hb, const gvi_real *F)
{
    gvi__half sum = { 0 };
    for (int o = 0; o < R; o += 4) sum += (1 - GVI__HALF(c + o))*(GVI__HALF(hb + o)*GVI__HALF(F + o));
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}
#endif

/* Both sums of eight coordinates at once, where eight are one register and the compiler can move
   its lanes: again the same terms in the same order.                           */
#if defined(GVI__VECTORS) && defined(GVI__FMA) && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector) && GVI__KEPT
#define GVI__EIGHTS
#endif
#endif
#ifdef GVI__EIGHTS
typedef gvi_real gvi__eight
    __attribute__((vector_size(8*sizeof(gvi_real)), aligned(sizeof(gvi_real)), may_alias));
typedef struct gvi__eights { gvi__eight hi, lo; } gvi__eights;
#define GVI__EIGHT(p) (*(const gvi__eight *)(p))
#define GVI__LOW_HALVES(a, b)  __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11)
#define GVI__HIGH_HALVES(a, b) __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15)
#define GVI__LOW_PAIRS(a, b)   __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13)
#define GVI__HIGH_PAIRS(a, b)  __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15)
#define GVI__EVEN(a, b)        __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14)
#define GVI__ODD(a, b)         __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15)

GVI__COPY gvi__eights gvi__product_lanes(gvi__eight a, gvi__eight b)
{
    const gvi__eight hi = a*b;
    gvi__eights z;
    gvi__eight lo;
    for (int l = 0; l < 8; ++l) lo[l] = GVI__FMA(a[l], b[l], -hi[l]);
    z.hi = hi;
    z.lo = lo;
    return z;
}

GVI__COPY gvi__eights gvi__join_lanes(gvi__eights x, gvi__eights y)
{
    const gvi__eight sum = x.hi + y.hi, b = sum - x.hi;
    gvi__eights z;
    z.lo = (x.lo + y.lo) + ((x.hi - (sum - b)) + (y.hi - b));
    z.hi = sum;
    return z;
}

// pair[k] := elements 2k and 2k + 1 of a, b, c and d
GVI__COPY void gvi__pairs(gvi__eight a, gvi__eight b, gvi__eight c, gvi__eight d, gvi__eight pair[4])
{
    const gvi__eight ab = GVI__LOW_HALVES(a, b), cd = GVI__LOW_HALVES(c, d);
    const gvi__eight AB = GVI__HIGH_HALVES(a, b), CD = GVI__HIGH_HALVES(c, d);
    pair[0] = GVI__LOW_PAIRS(ab, cd);
    pair[1] = GVI__HIGH_PAIRS(ab, cd);
    pair[2] = GVI__LOW_PAIRS(AB, CD);
    pair[3] = GVI__HIGH_PAIRS(AB, CD);
}

// the terms h b F of eight points of four rows, in pairs, and the sums of (1 - c) h b F
GVI__COPY void gvi__terms_of_four(int o, const gvi_real *c, const gvi_real *hb, const gvi_real *const F[4],
                                  gvi__eights term[4], gvi__eight lever[2])
{
    const gvi__eight w = GVI__EIGHT(hb + o), far = 1 - GVI__EIGHT(c + o);
    const gvi__eights p = gvi__product_lanes(w, GVI__EIGHT(F[0] + o));
    const gvi__eights q = gvi__product_lanes(w, GVI__EIGHT(F[1] + o));
    const gvi__eights u = gvi__product_lanes(w, GVI__EIGHT(F[2] + o));
    const gvi__eights v = gvi__product_lanes(w, GVI__EIGHT(F[3] + o));
    gvi__eight hi[4], lo[4], arm[4];
    gvi__pairs(p.hi, q.hi, u.hi, v.hi, hi);
    gvi__pairs(p.lo, q.lo, u.lo, v.lo, lo);
    gvi__pairs(far, far, far, far, arm);
    for (int k = 0; k < 4; ++k) {
        term[k].hi = hi[k];
        term[k].lo = lo[k];
        lever[k & 1] += arm[k]*hi[k];
    }
}

// two partial sums of h b F for each of four rows, and of (1 - c) h b F
GVI__COPY gvi__eights gvi__four_rows(int R, const gvi_real *c, const gvi_real *hb, const gvi_real *const F[4],
                                     gvi__eight *lever)
{
    gvi__eights sum[4], more[4];
    gvi__eight arms[2] = { { 0 }, { 0 } };
    gvi__terms_of_four(0, c, hb, F, sum, arms);
    for (int o = 8; o < R; o += 8) {
        gvi__terms_of_four(o, c, hb, F, more, arms);
        for (int k = 0; k < 4; ++k) sum[k] = gvi__join_lanes(sum[k], more[k]);
    }
    *lever = arms[0] + arms[1];
    return gvi__join_lanes(gvi__join_lanes(sum[0], sum[2]), gvi__join_lanes(sum[1], sum[3]));
}

// sum + left := sum h b F of all n coordinates, lever: of (1 - c) h b F, may be NULL; the last
// coordinate stands in for those that are missing of eight
GVI__COPY void gvi__sums_of_eight(int n, int R, const gvi_real *c, const gvi_real *hb, const gvi_real *F,
                                  gvi_real *sum, gvi_real *left, gvi_real *lever)
{
    for (int i = 0; i < n; i += 8) {
        const gvi_real *row[8];
        for (int k = 0; k < 8; ++k) row[k] = F + (i + k < n ? i + k : n - 1)*R;
        gvi__eight a, b;
        gvi__eights x = gvi__four_rows(R, c, hb, row, &a), even, odd;
        const gvi__eights y = gvi__four_rows(R, c, hb, row + 4, &b);
        even.hi = GVI__EVEN(x.hi, y.hi);
        even.lo = GVI__EVEN(x.lo, y.lo);
        odd.hi = GVI__ODD(x.hi, y.hi);
        odd.lo = GVI__ODD(x.lo, y.lo);
        x = gvi__join_lanes(even, odd);
        a = GVI__EVEN(a, b) + GVI__ODD(a, b);
        if (n >= 8) {                             // in whole vectors, as gvi__lengths has it
            *(gvi__eight *)(sum + i) = x.hi;
            *(gvi__eight *)(left + i) = x.lo;
            if (lever) *(gvi__eight *)(lever + i) = a;
        } else for (int k = 0; k < n; ++k) {
            sum[k] = x.hi[k];
            left[k] = x.lo[k];
            if (lever) lever[k] = a[k];
        }
    }
}

GVI__APART void gvi__increments_by_eight(gvi_stepper *st, const gvi__from *from, int R, int momenta)
{
    struct gvi__private *x = &st->x;
    const int n = st->n;
    const gvi_real *F = x->work.F, *V = x->work.V;
    gvi_real *lever = momenta ? NULL : x->dq;
    if (R == 8) gvi__sums_of_eight(n, 8, x->c, x->hb, F, x->dp, x->dpe, lever);
    else gvi__sums_of_eight(n, R, x->c, x->hb, F, x->dp, x->dpe, lever);
    for (int i = 0; i < n; ++i) x->dpe[i] = gvi__rest(x->dpe[i] + from->pe[i]);
    if (!momenta) return;
    gvi__sums_of_eight(n, R, x->c, x->hb, V, x->dq, x->dqe, NULL);
    for (int i = 0; i < n; ++i) x->dqe[i] = gvi__rest(x->dqe[i] + from->qe[i]);
}
#endif

/* Both sums of all n coordinates, up to four points, in a loop over coordinates; terms and order as in
   gvi__exact_dot and gvi__lever_sum.                                          */
GVI__COPY void gvi__exact_sums_of(int n, int r, const gvi_real *c, const gvi_real *hb,
                                  const gvi_real *GVI__RESTRICT F, const gvi_real *GVI__RESTRICT rest,
                                  gvi_real *GVI__RESTRICT sum, gvi_real *GVI__RESTRICT left,
                                  gvi_real *GVI__RESTRICT lever)
{
    for (int i = 0; i < n; ++i) {
        const gvi_real *f = F + i*r;
        gvi__two a = gvi__product(hb[0], f[0]), b = a;
        gvi_real arm = (1 - c[0])*(hb[0]*f[0]), other = 0;
        if (r > 1) {
            b = gvi__product(hb[1], f[1]);
            other += (1 - c[1])*(hb[1]*f[1]);
        }
        if (r > 2) {
            const gvi__two d = gvi__product(hb[2], f[2]);
            a = gvi__join(a.hi, a.lo, d.hi, d.lo);
            arm += (1 - c[2])*(hb[2]*f[2]);
        }
        if (r > 3) {
            const gvi__two d = gvi__product(hb[3], f[3]);
            b = gvi__join(b.hi, b.lo, d.hi, d.lo);
            other += (1 - c[3])*(hb[3]*f[3]);
        }
        if (r > 1) a = gvi__join(a.hi, a.lo, b.hi, b.lo);
        sum[i] = a.hi;
        left[i] = gvi__rest(a.lo + rest[i]);
        if (lever) lever[i] = arm + other;
    }
}

static void gvi__exact_sums(const gvi_stepper *st, const gvi_real *F, const gvi_real *rest,
                            gvi_real *sum, gvi_real *left, gvi_real *lever)
{
    const struct gvi__private *x = &st->x;
    switch (st->r) {
    case 1:  gvi__exact_sums_of(st->n, 1, x->c, x->hb, F, rest, sum, left, lever); break;
    case 2:  gvi__exact_sums_of(st->n, 2, x->c, x->hb, F, rest, sum, left, lever); break;
    case 3:  gvi__exact_sums_of(st->n, 3, x->c, x->hb, F, rest, sum, left, lever); break;
    default: gvi__exact_sums_of(st->n, 4, x->c, x->hb, F, rest, sum, left, lever); break;
    }
}

// sums are made of whole vectors, and behind the points a callback may have left anything.  0 is stored in
// whole vectors, too: a vector that is loaded from where single numbers were just stored waits for them
static inline void gvi__clear_behind(const gvi_stepper *st, gvi_real *rows)
{
#ifdef GVI__VECTORS
    typedef __typeof__(GVI__AT(rows) < GVI__AT(rows)) lanes;
    static const gvi_real place[8] = { 0, 1, 2, 3, 4, 5, 6, 7 };
    const int R = st->x.stride, last = R - 8;         // the eight that the end of a row is in
    for (int i = 0; st->r < R && i < st->n; ++i)
        GVI__EACH for (int o = 0; o < 8; o += GVI__LANES) {
            gvi_real *at = rows + i*R + last + o;
            const lanes stays = GVI__AT(place + o) < (gvi_real)(st->r - last);
            *(gvi__vector *)at = (gvi__vector)((lanes)GVI__AT(at) & stays);
        }
#else
    (void)st, (void)rows;
#endif
}

// in vectors, where there are any
static inline gvi__two gvi__increment(int r, int R, const gvi_real *a, const gvi_real *b, int coarse,
                                      gvi_real rest, gvi_real *z)
{
#ifdef GVI__VECTORS
    if (!GVI__SMALL && R % 8 == 0 && coarse) return gvi__two_of(gvi__coarse_dot_vector(R, a, b), rest);
    if (!GVI__SMALL && R % 8 == 0) return gvi__exact_dot_vector(R, a, b, rest);
#endif
    (void)R;
    const gvi__two sum = gvi__exact_dot(r, a, b, rest, z);
    return gvi__two_of(sum.hi, coarse ? rest : sum.lo);
}

// sum_j a_j b_j, in the same order with vectors and without
static inline gvi_real gvi__plain_dot(int r, int R, const gvi_real *a, const gvi_real *b)
{
#ifdef GVI__VECTORS
    gvi__half half = { 0 };
    for (int o = 0; R % 8 == 0 && o < R; o += 4) half += GVI__HALF(a + o)*GVI__HALF(b + o);
    if (R % 8 == 0) return (half[0] + half[2]) + (half[1] + half[3]);
#endif
    gvi_real sum[4] = { 0, 0, 0, 0 };
    (void)R;
    for (int j = 0; j < r; ++j) sum[j & 3] += a[j]*b[j];
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

static inline gvi_real gvi__lever(int r, int R, const gvi_real *c, const gvi_real *hb, const gvi_real *F)
{
#ifdef GVI__VECTORS
    if (!GVI__SMALL && R % 8 == 0) return gvi__lever_vector(R, c, hb, F);
#endif
    (void)R;
    return gvi__lever_sum(r, c, hb, F);
}

// h (v + ve + dq) + qe, both products exactly: see gvi__affine
static inline gvi__two gvi__with_path(gvi_real h, gvi_real v, gvi_real ve, gvi_real qe, gvi_real dq)
{
    const gvi__two path = gvi__product(h, v);
    const gvi__two bend = GVI__RESTS ? gvi__product(h, dq) : gvi__two_of(h*dq, 0);
    const gvi__two q = gvi__sum(path.hi, bend.hi);
    return gvi__two_of(q.hi, (q.lo + (path.lo + bend.lo)) + (h*ve + qe));
}

// dq + dqe := that, for each coordinate
static inline void gvi__add_path(int n, gvi_real h, const gvi_real *GVI__RESTRICT v,
                                 const gvi_real *GVI__RESTRICT ve, const gvi_real *GVI__RESTRICT qe,
                                 gvi_real *GVI__RESTRICT dq, gvi_real *GVI__RESTRICT dqe)
{
    for (int i = 0; i < n; ++i) {
        const gvi__two q = gvi__with_path(h, v[i], ve[i], qe[i], dq[i]);
        dq[i] = q.hi;
        dqe[i] = gvi__rest(q.lo);
    }
}

/* Beside stiffness: what the remainders add to free motion, which dq, dqe, dp, dpe hold.
   The weights are those that made the free rows, so that one is the adjoint of the other
   as rounded.                                                                 */
GVI__COPY void gvi__arc_increments(gvi_stepper *st, int i, int which, int coarse, int r, int R)
{
    struct gvi__private *x = &st->x;
    const gvi__arc arc = gvi__arc_of(st, which);
    const gvi_real *F = x->work.F + i*R;
    gvi_real own[16], *kicks = R > 16 ? x->row + 2*R : own;
#ifdef GVI__VECTORS
    for (int o = 0; R % 8 == 0 && o < R; o += GVI__LANES)
        *(gvi__vector *)(kicks + o) = GVI__AT(x->hb + o)*GVI__AT(F + o);
    if (R % 8 != 0)
#endif
        gvi__weigh(R, x->hb, F, kicks);
    const gvi_real bend = gvi__plain_dot(r, R, arc.sine, kicks);
    const gvi__two p = gvi__increment(r, R, arc.cosine, kicks, coarse, x->dpe[i], x->row);
    const gvi__two dp = gvi__sum(x->dp[i], p.hi), dq = gvi__sum(x->dq[i], x->over ? bend*x->over[i] : bend);
    x->dp[i] = dp.hi;
    x->dpe[i] = gvi__rest(dp.lo + p.lo);
    x->dq[i] = dq.hi;
    x->dqe[i] = gvi__rest(dq.lo + x->dqe[i]);
}

// gvi__add_path for the others
static void gvi__add_paths(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi_real *stiffness)
{
    struct gvi__private *x = &st->x;
    for (int i = 0; i < st->n; ++i) {
        if (gvi__nonzero(stiffness[i])) continue;
        if (x->over) x->dq[i] *= x->over[i];
        gvi__add_path(1, h, from->v + i, gvi__ve(st, from) + i, from->qe + i, x->dq + i, x->dqe + i);
    }
}

// sums of h b times rows, exactly; the rests of before go on, and what is left takes their place
static void gvi__row_increments(const gvi_stepper *st, const gvi_real *rows, const gvi_real *rest,
                                gvi_real *sum, gvi_real *left)
{
    const int R = st->x.stride;
    for (int i = 0; i < st->n; ++i, rows += R) {
        const gvi__two z = gvi__increment(st->r, R, st->x.hb, rows, 0, rest[i], st->x.row);
        sum[i] = z.hi;
        left[i] = z.lo;
    }
}

/* gvi__increments_of in less code                                              */
static void gvi__increments_plain(gvi_stepper *st, const gvi__from *from, gvi_real h)
{
    struct gvi__private *x = &st->x;
    const struct gvi__rows *w = &x->work;
    const int r = st->r, R = x->stride;
    gvi__row_increments(st, w->F, from->pe, x->dp, x->dpe);
    if (gvi__uses(st, GVI_MOMENTA)) {
        gvi__row_increments(st, w->V, from->qe, x->dq, x->dqe);
        return;
    }
    for (int i = 0; i < st->n; ++i)
        x->dq[i] = gvi__lever(r, R, x->c, x->hb, w->F + i*R) - (gvi__A(w) ? gvi__dot(r, x->b, w->A + i*R) : 0);
    gvi__over_mass(st, x->dq, 1, 1);
    gvi__add_path(st->n, h, from->v, gvi__ve(st, from), from->qe, x->dq, x->dqe);
}

/* Increments of q and p from the F, V and A at the end of the iteration, what is
   left of them going to dqe and dpe.  r, R: constants for the usual sizes.     */
GVI__FITTED void gvi__increments_of(gvi_stepper *st, const gvi__from *from, gvi_real h, int r, int R)
{
    struct gvi__private *x = &st->x;
    struct gvi__rows *w = &x->work;
    const int n = st->n, momenta = gvi__uses(st, GVI_MOMENTA), coarse = gvi__is_coarse(st);
    const gvi_real *stiffness = GVI__STIFF && x->springs ? gvi__stiffness(st) : NULL;
    int done = 0;
    if (GVI__WIDE && R < 5 && !gvi__A(w) && !stiffness) {
        gvi__exact_sums(st, w->F, from->pe, x->dp, x->dpe, momenta ? NULL : x->dq);
        if (momenta) gvi__exact_sums(st, w->V, from->qe, x->dq, x->dqe, NULL);
        done = n;
    }
#ifdef GVI__EIGHTS
    if (!GVI__SMALL && R % 8 == 0 && n > 3 && !gvi__A(w) && !stiffness) {
        gvi__increments_by_eight(st, from, R, momenta);
        done = n;
    }
#endif
    for (int i = done; i < n; ++i) {
        const gvi_real *F = w->F + i*R;
        if (GVI__STIFF && stiffness && gvi__nonzero(stiffness[i])) {
            gvi__arc_increments(st, i, (int)stiffness[n + i], coarse, r, R);
            continue;
        }
        const gvi__two p = gvi__increment(r, R, x->hb, F, coarse, from->pe[i], x->row);
        x->dp[i] = p.hi;
        x->dpe[i] = p.lo;
        if (momenta) {
            const gvi__two q = gvi__increment(r, R, x->hb, w->V + i*R, 0, from->qe[i], x->row);    // no stiffness
            x->dq[i] = q.hi;
            x->dqe[i] = q.lo;
        }
        else x->dq[i] = gvi__lever(r, R, x->c, x->hb, F) - (gvi__A(w) ? gvi__dot(r, x->b, w->A + i*R) : 0);
    }
    if (momenta) return;
    if (GVI__STIFF && stiffness) gvi__add_paths(st, from, h, stiffness);
    else {
        gvi__over_mass(st, x->dq, 1, 1);
        gvi__add_path(n, h, from->v, gvi__ve(st, from), from->qe, x->dq, x->dqe);
    }
}

GVI__DEEP void gvi__increments(gvi_stepper *st, const gvi__from *from, gvi_real h)
{
    struct gvi__private *x = &st->x;
    gvi__clear_behind(st, x->work.F);
    if (gvi__uses(st, GVI_MOMENTA)) gvi__clear_behind(st, x->work.V);
    if (gvi__has_clock(st)) {
        x->dt = gvi__dot(st->r, x->hb, x->rate);
        x->dH = gvi__dot(st->r, x->hb, x->rate + x->stride);
    }
    if (GVI__SMALL) gvi__increments_plain(st, from, h);
    else if (st->r == 8) gvi__increments_of(st, from, h, 8, 8);
    else if (st->r == 4) gvi__increments_of(st, from, h, 4, 4);
    else if (st->r == 16) gvi__increments_of(st, from, h, 16, 16);
    else gvi__increments_of(st, from, h, st->r, x->stride);
}

/* A change at the last point as energy, so that coordinates of any units may be added up:
   what is beyond a few units of the last place of q, times force; beside it force times q,
   and force times path and p v, what the step moves.                           */
typedef struct gvi__worth { gvi_real beyond, place, moved; } gvi__worth;

/* Where Lagrangian terms make V, it can go astray while Q, a short step away, does not
   feel it: in a fixed point v times the change of dL/dv counts as well.        */
static gvi__worth gvi__worth_of_change(const gvi_stepper *st, const gvi__from *from)
{
    const struct gvi__private *x = &st->x;
    const gvi_real r = (gvi_real)st->r;
    int R = x->stride, last = st->r - 1;
    gvi__worth w = { 0, 0, 0 };
    for (int i = 0; i < st->n; ++i) {
        gvi_real most = 0, Q = x->work.Q[i*R + last];
        const int by_v = GVI__READS_V && (x->chosen > GVI_POSITIONS || gvi__by_newton(st));
        gvi_real v = by_v ? x->work.V[i*R + last] : from->v[i];
        for (int k = 0; k < st->r; ++k) {
            gvi_real F = GVI_ABS(x->work.F[i*R + k]);
            if (F > most) most = F;
            w.moved += F*GVI_ABS(x->work.Q[i*R + k] - from->q[i]);
            w.place += F*GVI_ABS(x->work.Q[i*R + k]);
        }
        gvi_real beyond = GVI_ABS(Q - x->change[i]) - 4*GVI__EPS*GVI_ABS(Q);
        if (!(beyond <= 0)) w.beyond += r*beyond*most;
        w.moved += r*GVI_ABS(from->p[i]*v);
        if (!gvi__A(&x->work) || gvi__by_newton(st)) continue;
        const gvi_real A = x->work.A[i*R + last];
        const gvi_real more = GVI_ABS(A - x->change[st->n + i]) - 4*GVI__EPS*GVI_ABS(A);
        if (!(more <= 0)) w.beyond += r*more*GVI_ABS(v);
        w.moved += r*GVI_ABS(A*v);
    }
    return w;
}

/* Is the change that does not shrink any more nothing but rounding?  It is as far
   as it is within a few units of the last place of q.  What is beyond that must
   have been idle for longer, and is measured against what the step moves, or against
   force times q, where everything is at rest and nothing but rounding is left to be
   compared.  A change that is large beside q has to be so twice in a row: rows that jump
   to and fro between where a force acts and where it is 0 have no energy on one side. */
static int gvi__is_rounding(const gvi__worth *w, int idle)
{
    return w->beyond <= 0
        || (idle > 4 && w->moved + w->place <= GVI__MAX
            && w->beyond <= 1000*GVI__EPS*w->moved + 4*GVI__EPS*w->place);
}

// g at one configuration; slope of length n gets dg/dq
GVI__APART gvi_status gvi__rate_at(gvi_stepper *st, gvi_real t, const gvi_real *q, gvi_real *rate,
                                   gvi_real *slope)
{
    gvi_points y;
    gvi__at(&y, st, &t, q);
    return gvi__rate(st, &y, rate, slope);
}

// with a clock: g at the start, and times of the points as if it stayed
static gvi_status gvi__clock_guess(gvi_stepper *st, const gvi__from *from, gvi_real h, gvi_real *rate)
{
    struct gvi__private *x = &st->x;
    gvi_status status = gvi__rate_at(st, from->t, from->q, rate, x->one);
    for (int k = 0; k < st->r && status == GVI_OK; ++k) x->t[k] = from->t + (from->te + x->c[k]*h* *rate);
    return status;
}

// contraction over two iterations, as long as it is not about rounding; squares of changes
static void gvi__watch(gvi_stepper *st, gvi_real change, gvi_real earlier)
{
    if (!(earlier > 0) || change <= (1000*GVI__EPS)*(1000*GVI__EPS) || !gvi__finite(change)) return;
    const gvi_real worst = st->counters.worst_contraction*st->counters.worst_contraction;
    if (change > worst*worst*earlier) st->counters.worst_contraction = GVI_SQRT(GVI_SQRT(change/earlier));
}

static void gvi__watch_last(gvi_stepper *st, gvi_real change)
{
    const gvi_real worst = st->counters.worst_change;
    if (change > worst*worst) st->counters.worst_change = GVI_SQRT(change);
}

/* A change that is not finite: of an iteration that was growing, or whose effects
   have all been looked at, it is divergence; else gvi__solve looks at them.    */
static gvi_status gvi__not_finite(gvi_stepper *st, int grows)
{
    gvi_status status = grows || gvi__diagnoses(st) ? GVI_E_CONVERGENCE : GVI_E_NON_FINITE;
    return gvi__give(st, status);
}

/* Where an iteration stands: squares of the last changes, the tolerance and what is
   rounding; the least change, and how often they were poor or without a new least; was the
   last one rounding by its worth?                                             */
typedef struct gvi__progress {
    gvi_real before, earlier, tolerance, rounding, least;
    int      poor, idle, grows, rests;
} gvi__progress;

/* The weak effects: asked last time, or next, and how often; the way of the rows since
   then; how the others contract, at worst; the change that asking would bring; the
   least change when they were asked, that of gvi__progress being when they were not.
   Not there, NULL, where none is ever weak.                                    */
typedef struct gvi__still {
    int      anew, asked;
    gvi_real way, steady, pending, least;
} gvi__still;

/* Beside weak effects: has the iteration ended?  And are they to be asked next?  `lead`
   is the next change that the others bring, as the last one and their rate foretell it;
   `pending` that of asking the weak ones: the way that the rows went since they were
   asked, times `learned`, the answer to such a way before.  They are asked when ten
   times that is more than lead, or when the others are done.  A change that may be the
   others' own, no more than four times what they contract to, can only lower what is
   learned.  Nothing learned is taken on trust: where anything moves, no step ends
   before they were asked twice.  All of it in squares.                         */
GVI__APART int gvi__settled(gvi_stepper *st, const gvi__progress *p, gvi__still *w, gvi_real change)
{
    gvi_real *learned = gvi__answers(st) + 1;
    const gvi_real sure = (1000*GVI__EPS)*(1000*GVI__EPS), before = p->before > 1 ? 1 : p->before;
    gvi_real rate = before > 0 ? change/before : 1;
    if (w->anew) {
        const gvi_real answer = w->way > 1 ? change : w->way > sure ? change/w->way : *learned;
        if (answer < *learned || change > 16*w->steady*before) *learned = answer;
        if (rate > w->steady) rate = w->steady;
        w->asked += 1;
        w->way = change;
    } else {
        const gvi_real seen = change > p->rounding ? rate : p->rounding/before;  // below it no more is known
        if (before > sure && (w->steady >= 1 || seen > w->steady)) w->steady = seen;
        if (change > w->way) w->way = change;
    }
    const gvi_real lead = change*rate, guess = *learned*w->way, enough = p->tolerance;
    w->pending = w->asked > 1 ? guess : w->way;
    w->anew = 100*guess >= lead || (lead*rate <= enough && w->pending > enough);
    return lead <= enough && w->pending <= enough;
}

enum { GVI__GO_ON, GVI__DONE, GVI__ASK_ONCE_MORE, GVI__BEYOND, GVI__NOT_FINITE, GVI__LOOK };

// may a step that does not converge turn to Newton's method?
static int gvi__may_turn(const gvi_stepper *st)
{
    return st->x.desc.formulation == GVI_AUTO && gvi__has(st, GVI__HAS_NEWTON);
}

static inline gvi__progress gvi__progress_of(const gvi_stepper *st, int numbers)
{
    const gvi_real wanted = st->x.desc.tolerance, tolerance = GVI__TOLERANCE && wanted > 0 ? wanted : GVI__EPS/65536;
    const gvi_real rounding = 16*GVI__EPS*GVI__EPS*(gvi_real)numbers;
    const gvi__progress p = { 0, 0, tolerance*tolerance, rounding, GVI__MAX, 0, 0, 0, 0 };
    return p;
}

#define GVI__FAR ((gvi_real)0.0625)                   // a change by a quarter, in squares

// the next change is to be compared with this one, in new units if these were those of an overshoot
static inline void gvi__advance(gvi_stepper *st, gvi__progress *p, gvi_real change)
{
    p->grows = p->before > 0 && change >= p->before/4;
    if (change > GVI__FAR || p->grows) {
        const gvi_real zero = change - change;       // no call of memset: what that stores has to wait
        if (GVI__SMALL) gvi__zero(2*(size_t)st->n, st->x.scale);
        else GVI__ROLLED for (int i = 0; i < 2*st->n; ++i) st->x.scale[i] = zero;
    }
    p->earlier = p->before;
    p->before = change;
}

static inline void gvi__tally(gvi__progress *p, gvi_real change, gvi_real *least)
{
    p->poor = p->grows ? p->poor + 1 : 0;
    p->idle = change < (gvi_real)0.81**least ? 0 : p->idle + 1;
    if (change < *least) *least = change;
}

// of a change that did not fall as it should: the first and the second of these are no reason to look closer
GVI__SELDOM int gvi__judge_poor(gvi_stepper *st, gvi__progress *p, gvi_real change)
{
    if (!gvi__finite(change) || p->poor > 1 || p->idle > 0) return GVI__LOOK;
    gvi__watch(st, change, p->earlier);
    gvi__advance(st, p, change);
    gvi__tally(p, change, &p->least);
    p->rests = 0;
    return GVI__GO_ON;
}

/* Most verdicts: the next change is within the tolerance, or this one fell as it should.  Else gvi__judge
   has to look.                                                                */
GVI__COPY int gvi__judge_most(gvi_stepper *st, gvi__progress *p, gvi_real change)
{
    const gvi_real before = p->before, last = before > 0 ? before : change, known = last < 1 ? last : 1;
    const gvi_real quarter = before/4 < GVI__FAR ? before/4 : GVI__FAR, usual = before > 0 ? quarter : GVI__FAR;
    const int ends = change*change <= p->tolerance*known;
    if (GVI__SMALL || ends) return ends ? GVI__DONE : GVI__LOOK;
    if (GVI__OFTEN(change < usual && !p->idle)) {
        gvi__watch(st, change, p->earlier);
        p->earlier = before;
        p->before = p->least = change;
        p->poor = p->grows = p->rests = 0;
        return GVI__GO_ON;
    }
    return gvi__judge_poor(st, p, change);
}

/* The verdict on a change D.  The iteration ends when the next change, D^2/D_before,
   is within the tolerance, or without one far below rounding; or when D is rounding:
   small, or without a new least by a tenth for some iterations, and of no energy.  Three
   changes in a row that fall by less than half are poor, five while they are as large
   as the motion: terms of a cosine grow at first; so is a descent to
   rounding by factors of less than 4: such an iteration lets errors grow before
   they shrink, so that the rounding of the forces is left some tenfold, and more.
   All of it in squares of changes: no root or quotient between an iteration and
   the next.  A given number of iterations ends there, if the change is half of
   that two before.                                                            */
GVI__DEEP int gvi__judge(gvi_stepper *st, const gvi__from *from, gvi__progress *p, gvi__still *weak,
                         gvi_real change, int used)
{
    struct gvi__private *x = &st->x;
    const gvi_real rounding = p->rounding, before = p->before;
    const int given = gvi__counts(st), some = gvi__seldom(st) != 0, moved = some && weak->anew;
    gvi_real *least = moved ? &weak->least : &p->least;
    if (some && gvi__settled(st, p, weak, change)) return GVI__DONE;
    const int verdict = some || given ? GVI__LOOK : gvi__judge_most(st, p, change);
    if (verdict != GVI__LOOK) return verdict;
    if (given && used == x->desc.iterations) {
        const int falls = p->earlier > 0 ? change < p->earlier/4 : before <= 0 || change < before;
        return falls || change <= 65536*rounding ? GVI__DONE : GVI__BEYOND;
    }
    // what asking the weak effects brings is no contraction, nor is what follows measured by what was before
    if (!moved || (change < before/4 && change < p->earlier)) gvi__watch(st, change, p->earlier);
    gvi__advance(st, p, change);
    if (some && p->grows) p->earlier = 0;
    if (given) return GVI__GO_ON;
    gvi__tally(p, change, least);
    int ends = p->idle > 2 && change <= rounding, rests = 0;
    if (!ends && (p->idle > 1 || p->poor > 2)) {
        const gvi__worth worth = gvi__worth_of_change(st, from);
        rests = gvi__is_rounding(&worth, p->idle);
        ends = rests && (p->rests || change <= 65536*rounding);
    }
    p->rests = rests;
    if (ends) {
        if (!some || moved || weak->pending <= rounding)
            return used - p->idle > GVI__DIG/2 && gvi__may_turn(st) ? GVI__BEYOND : GVI__ASK_ONCE_MORE;
        p->idle = p->poor = 0;
        weak->anew = 1;
        return GVI__GO_ON;
    }
    // nearer to rounding idle decides
    if (p->poor <= (change > GVI__FAR ? 4 : 2) || change <= 65536*rounding) return GVI__GO_ON;
    return gvi__may_turn(st) ? GVI__BEYOND : GVI__GO_ON;
}

/* The units of a step's changes, as gvi__rescale makes them, from extrapolated rows: where the last
   point is foretold stands for where it will be.  Where that is far too little, and a change
   overflows, gvi__attempt begins again from plain rows: not where a deadline has given the rounds. */
static inline gvi_real gvi__scale_of(gvi_real base, gvi_real end)
{
    const gvi_real size = GVI_ABS(base) + 2*GVI_ABS(end - base);
    return size > GVI__MIN/GVI__EPS ? 1/size : 0;
}

static inline void gvi__scales(gvi_stepper *st, const gvi__stage *y, int count)
{
    const int R = st->x.stride;
    for (int k = 0; k < count; ++k) {
        const gvi_real *GVI__RESTRICT base = y[k].base, *GVI__RESTRICT end = y[k].rows + st->r - 1;
        gvi_real *GVI__RESTRICT scale = y[k].scale;
        GVI__ROLLED for (int i = 0; i < st->n; ++i, end += R) scale[i] = gvi__scale_of(base[i], *end);
    }
}

// what the first iteration begins with: rows, or F, V and A to make them of
static gvi_status gvi__first_rows(gvi_stepper *st, const gvi__from *from, gvi_real h, int extrapolate,
                                     const gvi__stage *y)
{
    struct gvi__private *x = &st->x;
    const int sums = extrapolate && (x->E_is & GVI__SUMS), springs = GVI__STIFF && x->springs;
    gvi_real rate = 1;
    if (gvi__has_clock(st)) {
        gvi_status status = gvi__clock_guess(st, from, h, &rate);
        if (status != GVI_OK) return status;
    }
    if (springs) gvi__free_motion(st, from);
    if (sums && GVI__MADE) gvi__extrapolate_made(st, from, h);
    else if (sums) gvi__extrapolate(st, x->last.F, x->older_F, y, x->work.Q);
    else gvi__guess(st, extrapolate, rate);
    if (springs && !sums) gvi__spring_guess(st, from, extrapolate);
    return GVI_OK;
}

/* Fixed point on the rows: F, V and A make the rows, the effects are asked there.
   plain: see gvi__is_plain; a constant.                                       */
GVI__COPY gvi_status gvi__fixed_point_of(gvi_stepper *st, const gvi__from *from, gvi_real h, int extrapolate,
                                         int plain, int *used)
{
    struct gvi__private *x = &st->x;
    const int counts = !plain && gvi__counts(st), most = counts ? x->desc.iterations : x->desc.max_iterations;
    gvi__progress p = gvi__progress_of(st, st->n*st->r);
    gvi__still weak = { 1, 0, 0, 1, 0, GVI__MAX };
    gvi__stage y[GVI__STAGES];
    gvi_points at;
    if (GVI__PATH && (plain || !gvi__uses(st, GVI_MOMENTA))) gvi__path(st, from, h);
    const int count = plain ? 1 : gvi__stage_count(st);
    for (int k = 0; k < count && !GVI__MADE; ++k) gvi__plan(st, from, h, k, y + k);
    // where size counts, gvi__ask makes them: no longer on the stack than needed
    if (!GVI__SMALL) gvi__rows_as_points(&at, st, &x->work, gvi__A(&x->work));
    const int only = plain || gvi__asks_only(st);
    if (only && x->desc.effects[x->single].kind == GVI_POTENTIAL) at.v = NULL;
    const int simple = plain || (!counts && !gvi__seldom(st));         // gvi__judge would say the same
    const int sums = plain || (extrapolate && (x->E_is & GVI__SUMS)), springs = !plain && GVI__STIFF && x->springs;
    if (plain && st->r == 8 && gvi__two_now(st))
        gvi__extrapolate_rows(st, st->n, 8, 8, 1, 0, x->last.F, x->older_F, y, x->work.Q);
    else if (plain) gvi__extrapolate(st, x->last.F, x->older_F, y, x->work.Q);
    else {
        const gvi_status first = gvi__first_rows(st, from, h, extrapolate, y);
        if (first != GVI_OK) return first;
    }
    for (*used = 0; ; ) {
        if (GVI__TOLERANCE && p.idle + p.poor > 0)
            gvi__gather(st->n, x->stride, x->work.Q + st->r - 1, x->change);
        gvi_real change = p.before;                      // 0, where there are rows and no change yet
        if (*used > 0 || !sums) change = plain ? gvi__stage_rows(st, y) : gvi__stages(st, from, h, y, count);
        int verdict = GVI__GO_ON;
        if (*used > 0) {
            verdict = simple ? gvi__judge_most(st, &p, change) : GVI__LOOK;
            if (verdict == GVI__LOOK) {
                if (!gvi__finite(change)) return gvi__not_finite(st, p.grows || p.before > (gvi_real)st->n);
                verdict = gvi__judge(st, from, &p, GVI__WEAK ? &weak : NULL, change, *used);
            }
            if (verdict == GVI__GO_ON && GVI__TOLERANCE && *used == most) verdict = GVI__BEYOND;
            if (verdict == GVI__BEYOND) break;
            if (verdict != GVI__GO_ON) gvi__watch_last(st, change);
            if (verdict == GVI__DONE) return GVI_OK;
        } else if (extrapolate && !GVI__SMALL && !counts) gvi__scales(st, y, count);
        else gvi__zero(2*(size_t)st->n, x->scale);        // of rows of another step

        // rows that go to and fro in their last places end with their own F, not that of
        // the side that they came from, which would be a bias
        int last = 0;
        if (GVI__TOLERANCE && verdict == GVI__ASK_ONCE_MORE) last = 1;
        const int anew = weak.anew || last;
        *used += !last;
        if (GVI__TOLERANCE && !plain && gvi__A(&x->work) && p.idle + p.poor > 0)
            gvi__gather(st->n, x->stride, x->work.A + st->r - 1, x->change + st->n);
        gvi_status status = only ? gvi__ask_only(st, h - h, &at)
                                 : gvi__ask(st, from, h - h, GVI__SMALL ? NULL : &at, anew);
        if (springs && last && status == GVI_OK) gvi__remainders(st);
        if (status != GVI_OK || last) return status;
    }
    return gvi__give(st, GVI_E_CONVERGENCE);
}

/* Positions, rows that come from the last step's at once, one effect and nothing beside it: so much is
   known then that a step of eight points and two coordinates takes a twentieth less.  */
static inline int gvi__is_plain(const gvi_stepper *st)
{
    return GVI__WIDE && st->x.stride > 4 && gvi__uses(st, GVI_POSITIONS) && (st->x.E_is & GVI__SUMS)
        && gvi__asks_only(st) && gvi__clock_bit(st) == 0 && !(GVI__STIFF && st->x.springs) && !gvi__counts(st);
}

GVI__APART gvi_status gvi__fixed_point(gvi_stepper *st, const gvi__from *from, gvi_real h, int extrapolate,
                                       int *used)
{
    if (extrapolate && gvi__is_plain(st)) return gvi__fixed_point_of(st, from, h, 1, 1, used);
    return gvi__fixed_point_of(st, from, h, extrapolate, 0, used);
}

/* ---- Newton's method ---- */

/* Newton on (1).  Unknowns y[k*n + i]; the rows are those of (1) times 2k + 1,
   from k0 on: k0 = 0 for a step, 1 for the boundary-value problem.            */

static void gvi__newton_rows(gvi_stepper *st, const gvi__from *from, gvi_real h)
{
    struct gvi__private *x = &st->x;
    int n = st->n, R = x->stride;
    for (int i = 0; i < n; ++i) {
        gvi_real *V = x->work.V + i*R, *Q = x->work.Q + i*R;
        gvi__zero((size_t)R, V);
        gvi__zero((size_t)R, Q);
        for (int k = 0; k < st->s; ++k)
            for (int j = 0; j < R; ++j) {
                V[j] += x->phi[k*R + j]*x->y[k*n + i];
                Q[j] += x->Phi[k*R + j]*x->y[k*n + i];
            }
        for (int j = 0; j < R; ++j) Q[j] = from->q[i] + (from->qe[i] + h*Q[j]);
    }
    gvi__count(&st->counters.velocities, st->r);
}

// F and P at the rows of y
GVI__APART gvi_status gvi__newton_ask(gvi_stepper *st, const gvi__from *from, gvi_real h)
{
    gvi_points y;
    gvi__newton_rows(st, from, h);
    gvi__rows_as_points(&y, st, &st->x.work, st->x.work.P);
    return gvi__evaluate(st, &y, 0);
}

// dy before it is solved for, in scratch behind that of gvi__solve_blocks; y before the last change, behind that
static inline gvi_real *gvi__newton_rest(const gvi_stepper *st) { return st->x.dF + st->n*st->x.stride; }
static inline gvi_real *gvi__last_y(const gvi_stepper *st) { return st->x.dF + 2*st->n*st->x.stride; }

/* Where Newton's method stands: the last changes and the least; rho, the contraction seen; what
   is left of the error, once a change was rounding; the residual, and once its change is made the
   work that does in it, or -1 where either is rounding in its own units; how often no change was
   less than half of the least; is there a matrix that will do; is it new, 1, and was the last one,
   2; how often was the last change halved, or -1: there is none to take back?           */
typedef struct gvi__descent {
    gvi_real    before, earlier, least, rho, left, work;
    signed char idle, have, fresh, halves;
} gvi__descent;

enum { GVI__HALVES = 6 };          // of a change, at most

// the residual's norm at the last y that stayed, behind the units of gvi__residual
static inline gvi_real *gvi__last_norm(const gvi_stepper *st) { return st->x.scale + st->n; }

// M_ii where F was asked last, at the first point
GVI__APART gvi_real gvi__inertia(const gvi_stepper *st, int i)
{
    const struct gvi__private *x = &st->x;
    const size_t n = (size_t)st->n, ii = (size_t)i*(n + 1);
    const gvi_real m = x->desc.mass.kind == GVI_MASS_DIAGONAL ? x->mass[i]
        : gvi__mass_is(st, GVI_MASS_DENSE) ? x->mass[n*n + ii]
        : gvi__mass_is(st, GVI_MASS_POSITION) ? x->point_mass[ii*(size_t)x->stride] : 1;
    return gvi__nonzero(m) ? GVI_ABS(m) : 1;
}

/* dy := -residual, and the same to gvi__newton_rest.  The weights of P are h b_i/h, those
   that F has, and Phi_0 = c is on its grid: then the rows are exactly those of a discrete
   action, also as rounded.  p->work: the largest in units of its own terms.  Returns the
   norm, the sum of magnitudes over sqrt M_ii: rows of (1) are momenta, so that has one unit
   for all coordinates.  M is that of the first y.                             */
GVI__APART gvi_real gvi__residual(gvi_stepper *st, const gvi__from *from, int k0, gvi__descent *p)
{
    struct gvi__private *x = &st->x;
    int n = st->n, R = x->stride;
    gvi_real norm = 0, worst = 0, h = x->h_weights, *rest = gvi__newton_rest(st);
    const int first = !(*gvi__last_norm(st) < GVI__MAX);
    for (int i = 0; i < n; ++i) {
        const gvi_real *P = x->work.P + i*R, *F = x->work.F + i*R;
        gvi_real length = 0;
        for (int k = k0; k < st->s; ++k) {
            // P - p is summed where p is asked for: the rounding of P then is not in the sum
            const gvi_real base = k == 0 ? from->p[i] : 0;
            gvi_real momentum = k == 0 ? -(h*from->pe[i]) : 0, force = 0, size = 0;
            for (int j = 0; j < st->r; ++j) {
                gvi_real W = (k == 0 ? 1 : 0) - x->Phi[k*R + j];
                gvi_real a = x->phi[k*R + j]*(x->hb[j]*(P[j] - base)), b = W*(x->hb[j]*F[j]);
                momentum += a;
                force += b;
                size += GVI_ABS(x->phi[k*R + j]*(x->b[j]*P[j])) + GVI_ABS(b);
            }
            gvi_real sum = momentum/h - force;
            x->dy[(k - k0)*n + i] = rest[(k - k0)*n + i] = -(gvi_real)(2*k + 1)*sum;
            length += (gvi_real)(2*k + 1)*GVI_ABS(sum);
            if (size > 0 && GVI_ABS(sum)/size > worst) worst = GVI_ABS(sum)/size;
        }
        if (first) x->scale[i] = 1/GVI_SQRT(gvi__inertia(st, i));
        norm += length*x->scale[i];
    }
    p->work = worst;
    return norm;
}

// where the derivatives of the residual go, of a step of length h_weights
typedef struct gvi__matrix {
    gvi_real *square;      /* rows and columns k0..s-1, row-major               */
    gvi_real *ends;        /* k0 = 1: columns y_0 and q0, 2n a row, behind square; or NULL */
    gvi_real *pivot;       /* of square's LU, or of the blocks'                 */
    signed char k0;
    signed char scaled;    /* rows by their largest entry, for a condition without units */
    signed char blocks;    /* in place of square: matrices of n, derivatives at one point */
    signed char halves;    /* are changes taken back?  By a second attempt          */
} gvi__matrix;

// Is it in blocks?  Never in the boundary-value problem, which is there without Newton's
// steps as well; and not where size counts: the whole matrix is needed besides
static inline int gvi__in_blocks(const gvi__matrix *J) { return GVI__NEWTON && !GVI__SMALL && J->blocks; }

/* Points at which derivatives are taken: all those of the rule, or one.       */
typedef struct gvi__sites { const gvi_real *t; gvi_real *q, *v; int count, stride; } gvi__sites;

/* Gauss, r = s.  In Legendre modes integration from 0 to tau, which makes Q from V
   and P from F, is a matrix with three diagonals (Hairer, Wanner, Solving ordinary
   differential equations II, IV.5): Phi_0 = (phi_0 - phi_1)/2 and Phi_k =
   (phi_(k-1) - phi_(k+1))/(2(2k+1)), phi_s being 0 at the nodes.  Its eigenvectors
   are (2k+1) z_k from the right and (-1)^k z_k from the left,

     z_(-1) = -1    z_0 = 1    z_(k+1) = 2(2k+1) lambda z_k + z_(k-1)

   and lambda is where z_s = 0: z_k = (-1)^k y_k(-2 lambda), y_k the Bessel
   polynomials (Krall and Frink 1949), whose zeros are simple, real for odd s once.  */

/* z_0..z_s at lambda = a + i b to re and im, rounded once: eigenvalues of a matrix with
   such eigenvectors are ill-conditioned, and what twofold arithmetic loses is not missed. */
static void gvi__bessel(int s, gvi__two a, gvi__two b, gvi_real *re, gvi_real *im)
{
    gvi__two x = gvi__real2(1), y = gvi__real2(0), last_x = gvi__real2(-1), last_y = y;
    for (int k = 0; k <= s; ++k) {
        const gvi_real w = (gvi_real)(4*k + 2);
        const gvi__two u = gvi__sub2(gvi__mul2(a, x), gvi__mul2(b, y));
        const gvi__two v = gvi__add2(gvi__mul2(a, y), gvi__mul2(b, x));
        const gvi__two next_x = gvi__add2(gvi__scale2(w, u), last_x);
        const gvi__two next_y = gvi__add2(gvi__scale2(w, v), last_y);
        re[k] = x.hi;
        im[k] = y.hi;
        last_x = x;
        last_y = y;
        x = next_x;
        y = next_y;
    }
}

// the eigenvector of block m: s real parts, then s imaginary ones, scaled to z_(s-1) = 2 lambda
static gvi_real *gvi__eigenvector(const gvi_stepper *st, int m) { return st->x.eigen + (size_t)(2*m*st->s); }

static gvi__complex gvi__eigenvalue(const gvi_stepper *st, int m)
{
    const gvi_real *z = gvi__eigenvector(st, m);
    return gvi__complex_of(z[st->s - 1]/2, z[2*st->s - 1]/2);
}

/* Newton's correction u = z_s/z_s' with z_s' = ((2 s lambda + 1) z_s + z_(s-1))/(2 lambda^2),
   then u/(1 - u sum 1/(lambda - zero)), which keeps away from the zeros of the
   blocks from m on, and their mirror images (Maehly 1954).                    */
static gvi__complex gvi__bessel_correction(const gvi_stepper *st, int m, const gvi__two lambda[2])
{
    const int s = st->s;
    const gvi_real a = 2*(gvi_real)s;
    const gvi__complex l = gvi__complex_of(lambda[0].hi, lambda[1].hi);
    gvi_real *re = st->x.row, *im = re + s + 1;
    gvi__bessel(s, lambda[0], lambda[1], re, im);
    const gvi__complex z = gvi__complex_of(re[s], im[s]), square = gvi__times_complex(l, l);
    const gvi__complex slope = gvi__times_complex(gvi__complex_of(a*l.re + 1, a*l.im), z);
    const gvi__complex top = gvi__times_complex(gvi__complex_of(2*square.re, 2*square.im), z);
    const gvi__complex u = gvi__times_complex(top, gvi__inverse(slope.re + re[s - 1], slope.im + im[s - 1]));
    gvi__complex sum = gvi__complex_of(0, 0);
    for (; m < (s + 1)/2; ++m) {
        const gvi__complex zero = gvi__eigenvalue(st, m);
        for (int side = gvi__nonzero(zero.im) ? -1 : 1; side < 2; side += 2) {
            const gvi__complex pole = gvi__inverse(l.re - zero.re, l.im - (gvi_real)side*zero.im);
            sum.re += pole.re;
            sum.im += pole.im;
        }
    }
    sum = gvi__times_complex(u, sum);
    return gvi__times_complex(u, gvi__inverse(1 - sum.re, -sum.im));
}

// lambda of block m, those of the blocks behind it being known; 0 if it is not found
static int gvi__bessel_zero(const gvi_stepper *st, int m, gvi__two lambda[2])
{
    const int s = st->s, all = (s + 1)/2;
    int near = 0;
    lambda[0] = gvi__real2(1/(gvi_real)s);
    lambda[1] = gvi__real2(2*m + 1 == s ? 0 : 1/(gvi_real)(2*s));        // a real start stays real
    for (int k = 0; k < 100 && near < 4; ++k) {       // three times more among all zeros
        const gvi__complex d = gvi__bessel_correction(st, near ? all : m + 1, lambda);
        lambda[0] = gvi__add2(lambda[0], gvi__real2(-d.re));
        lambda[1] = gvi__add2(lambda[1], gvi__real2(-d.im));
        const gvi_real size = gvi__cabs1(lambda[0].hi, lambda[1].hi);
        near += near || gvi__cabs1(d.re, d.im) <= GVI_SQRT(GVI__EPS)*size;
    }
    return near == 4;
}

/* One eigenvector of each conjugate pair, and last, for odd s, the real one.  With
   z_(s-1) = 2 lambda the product of both sides, sum (-1)^k (2k+1) z_k^2 =
   (-1)^(s-1) z_(s-1)^2/(4 lambda^2) (Christoffel and Darboux), is 1 or -1.  Returns
   the largest product of their lengths: what a change of basis costs in digits.  */
static gvi_real gvi__eigenvectors(gvi_stepper *st)
{
    const int s = st->s;
    gvi_real *re = st->x.row, *im = re + s + 1, worst = 0;
    for (int m = (s + 1)/2; m-- > 0; ) {
        gvi__two l[2];
        if (!gvi__bessel_zero(st, m, l)) return GVI__MAX;
        gvi__bessel(s, l[0], l[1], re, im);
        const gvi__complex scale = gvi__times_complex(gvi__complex_of(2*l[0].hi, 2*l[1].hi),
                                                      gvi__inverse(re[s - 1], im[s - 1]));
        gvi_real *z = gvi__eigenvector(st, m), size = 0;
        for (int k = 0; k < s; ++k) {
            const gvi__complex y = gvi__times_complex(scale, gvi__complex_of(re[k], im[k]));
            z[k] = y.re;
            z[s + k] = y.im;
            size += (gvi_real)(2*k + 1)*(y.re*y.re + y.im*y.im);
        }
        if (size > worst) worst = size;
    }
    return worst;
}

/* With the derivatives at one point, and integration as a matrix X, the Jacobian is

     dP/dv + h X (dP/dq - dF/dv) - h^2 X^2 dF/dq

   n*n times s*s.  In the basis of X's eigenvectors it falls apart into blocks, X
   being lambda in each; of a conjugate pair one is enough.  Adds f and p as below. */
static void gvi__add_to_blocks(const gvi_stepper *st, const gvi__matrix *J, int i, int j,
                               gvi_real f, gvi_real p, int by_v)
{
    const size_t n = (size_t)st->n;
    const gvi_real h = st->x.h_weights;
    gvi_real *a = J->square + 2*n*(size_t)i + (size_t)j;
    for (int m = 0; m < (st->s + 1)/2; ++m, a += 2*n*n) {
        const gvi__complex l = gvi__eigenvalue(st, m);
        const gvi__complex x = gvi__complex_of(h*l.re, h*l.im);
        const gvi__complex y = gvi__complex_of(p - x.re*f, -x.im*f);
        const gvi__complex z = by_v ? y : gvi__times_complex(x, y);
        a[0] += z.re;
        a[n] += z.im;
    }
}

static gvi_status gvi__factor_blocks(gvi_stepper *st, const gvi__matrix *J)
{
    const size_t n = (size_t)st->n;
    gvi_status status = GVI_OK;
    for (int m = 0; m < (st->s + 1)/2 && status == GVI_OK; ++m)
        status = gvi__lu_factor_complex(st->n, J->square + 2*n*n*(size_t)m, J->pivot + n*(size_t)m);
    gvi__count(&st->counters.factorizations, (st->s + 1)/2);
    return status == GVI_OK ? GVI_OK : gvi__give(st, status);
}

/* x->dy := J^-1 x->dy by blocks: each gets the share (-1)^(s-1-k) z_k of row k, and
   gives (2k+1) z_k of what it solves, a pair twice the real part.             */
static void gvi__solve_blocks(gvi_stepper *st, const gvi__matrix *J)
{
    struct gvi__private *x = &st->x;
    const int n = st->n, s = st->s;
    gvi_real *sum = x->dF, *u = x->hess;              // at least s*n and 2n long
    gvi__zero((size_t)(s*n), sum);
    for (int m = 0; m < (s + 1)/2; ++m) {
        const gvi_real *re = gvi__eigenvector(st, m), *im = re + s;
        gvi__zero(2*(size_t)n, u);
        for (int k = 0; k < s; ++k) {
            const gvi_real a = (s - k) % 2 ? re[k] : -re[k], b = (s - k) % 2 ? im[k] : -im[k];
            for (int i = 0; i < n; ++i) {
                u[i] += a*x->dy[k*n + i];
                u[n + i] += b*x->dy[k*n + i];
            }
        }
        gvi__lu_solve_complex(n, J->square + 2*(size_t)(n*n)*(size_t)m, J->pivot + (size_t)n*(size_t)m, u);
        for (int k = 0; k < s; ++k) {
            const gvi_real w = (gvi_real)((2*m + 1 == s ? 1 : 2)*(2*k + 1));
            for (int i = 0; i < n; ++i) sum[k*n + i] += w*(re[k]*u[i] - im[k]*u[n + i]);
        }
    }
    gvi__copy((size_t)(s*n), sum, x->dy);
}

/* Adds what dF_i/du_j = f and dP_i/du_j = p at one point contribute, u = q or v:
   du = h Phi_l dy_l or phi_l dy_l.                                           */
static void gvi__add(const gvi_stepper *st, const gvi__matrix *J, int i, int j, int point,
                     gvi_real f, gvi_real p, int by_v)
{
    const struct gvi__private *x = &st->x;
    int n = st->n, R = x->stride, s = st->s, k0 = J->k0;
    size_t size = (size_t)(s - k0)*(size_t)n;
    const gvi_real h = x->h_weights;
    if (f <= 0 && f >= 0 && p <= 0 && p >= 0) return;
    if (gvi__in_blocks(J)) {
        gvi__add_to_blocks(st, J, i, j, f, p, by_v);
        return;
    }
    for (int k = k0; k < s; ++k) {
        gvi_real W = (k == 0 ? 1 : 0) - x->Phi[k*R + point];
        gvi_real a = (gvi_real)(2*k + 1)*(x->b[point]*x->phi[k*R + point]*p - x->hb[point]*W*f);
        size_t row = (size_t)((k - k0)*n + i);
        for (int l = k0; l < s; ++l)
            J->square[row*size + (size_t)((l - k0)*n + j)]
                += a*(by_v ? x->phi[l*R + point] : h*x->Phi[l*R + point]);
        if (J->ends) {
            J->ends[row*2*(size_t)n + (size_t)j] += a*(by_v ? 1 : h*x->Phi[point]);
            if (!by_v) J->ends[row*2*(size_t)n + (size_t)(n + j)] += a;
        }
    }
}

// all points; compiled for size, made where they are needed
static gvi__sites gvi__all_points(const gvi_stepper *st)
{
    const struct gvi__private *x = &st->x;
    const gvi__sites at = { x->t, x->work.Q, x->work.V, st->r, x->stride };
    return at;
}

// effects that bring their Hessians, and the constant mass
GVI__APART gvi_status gvi__jacobian_exact(gvi_stepper *st, const gvi__matrix *J, const gvi__sites *at)
{
    struct gvi__private *x = &st->x;
    const gvi_desc *d = &x->desc;
    gvi__sites all;
    if (GVI__SMALL) all = gvi__all_points(st), at = &all;
    int n = st->n, R = at->stride;
    size_t nn = (size_t)n*(size_t)n;
    gvi_real *fq = x->hess, *fv = fq + nn, *own = fv + nn, *pv = own + nn, *q = x->one, *v = q + n;
    for (int k = 0; k < at->count; ++k) {
        gvi__gather(n, R, at->q + k, q);
        gvi__gather(n, R, at->v + k, v);
        for (int i = 0; i < n && gvi__mass_is_constant(d); ++i)
            for (int j = 0; j < n; ++j) {
                gvi_real m = i != j ? 0 : d->mass.kind == GVI_MASS_DIAGONAL ? x->mass[i] : 1;
                if (gvi__mass_is(st, GVI_MASS_DENSE)) m = x->mass[nn + (size_t)(i > j ? i*n + j : j*n + i)];
                gvi__add(st, J, i, j, k, 0, m, 1);
            }
        for (int e = 0; e < d->effect_count; ++e) {
            const gvi_effect *effect = d->effects + e;
            if ((x->off >> e & 1u) || !effect->hessian) continue;
            int reads_v = effect->kind != GVI_POTENTIAL, term = effect->kind == GVI_LAGRANGIAN;
            gvi__zero(4*nn, fq);
            if (effect->hessian(at->t[k], q, reads_v ? v : NULL, fq, reads_v ? fv : NULL, term ? pv : NULL,
                                effect->user))
                return gvi__fail(st, GVI_E_CALLBACK, e, GVI_FAULT_NONE,
                                 gvi__in_blocks(J) ? GVI_FAULT_NONE : k);
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {       // d(dL/dv)/dq is the transpose of d(dL/dq)/dv
                    gvi__add(st, J, i, j, k, fq[i*n + j], term ? fv[j*n + i] : 0, 0);
                    gvi__add(st, J, i, j, k, fv[i*n + j], pv[i*n + j], 1);
                }
        }
    }
    return GVI_OK;
}

// F and P of what has no Hessian, one behind the other
GVI__APART gvi_status gvi__ask_sites(gvi_stepper *st, const gvi__sites *at, gvi_real *F)
{
    gvi_points y;
    gvi__at(&y, st, at->t, at->q);
    y.v = at->v;
    y.f = F;
    y.dldv = F + st->n*at->stride;
    y.count = at->count;
    y.stride = at->stride;
    return gvi__evaluate(st, &y, 1);
}

/* The difference for coordinate j: sqrt(eps) of what it moves in a step, but no less
   than eps^(3/4) of itself; or for its velocity, that over h.                 */
static gvi_real gvi__nudge(const gvi__sites *at, int j, gvi_real h, int by_v)
{
    const gvi_real root = GVI_SQRT(GVI__EPS), small = GVI_SQRT(root);
    const gvi_real *Q = at->q + j*at->stride, *V = at->v + j*at->stride;
    gvi_real q = 0, v = 0;
    for (int k = 0; k < at->count; ++k) {
        if (GVI_ABS(Q[k]) > q) q = GVI_ABS(Q[k]);
        if (GVI_ABS(V[k]) > v) v = GVI_ABS(V[k]);
    }
    const gvi_real path = h*v > small*q ? h*v : small*q;
    const gvi_real step = root*path > GVI__MIN/GVI__EPS ? root*path
                        : h < 1 ? root*h : root;              // at rest at 0
    if (!by_v) return step;
    return v > 0 && step/h > small*v ? small*v : step/h;      // short steps: no velocity beyond all others
}

// moves row j of Q, k = 2j, or of V, k = 2j + 1, at all points at once; x->z gets what it was
GVI__APART void gvi__move_row(gvi_stepper *st, const gvi__sites *at, int k)
{
    const int j = k/2, by_v = k % 2;
    const size_t R = (size_t)at->stride;
    gvi_real *row = (by_v ? at->v : at->q) + (size_t)j*R;
    const gvi_real d = gvi__nudge(at, j, GVI_ABS(st->x.h_weights), by_v);
    gvi__copy(R, row, st->x.z);
    for (int i = 0; i < at->count; ++i) row[i] += d;
}

// forward differences by that row, which goes back; x->dF holds F and P, moved and not
GVI__APART void gvi__add_differences(const gvi_stepper *st, const gvi__matrix *J, const gvi__sites *at, int k)
{
    const int j = k/2, by_v = k % 2, n = st->n, R = at->stride;
    gvi_real *row = (by_v ? at->v : at->q) + j*R;
    const gvi_real *dF = st->x.dF, *dP = dF + n*R, *bF = dP + n*R, *bP = bF + n*R;
    for (int m = 0; m < at->count; ++m) {
        const gvi_real step = row[m] - st->x.z[m];
        for (int i = 0, o = m; i < n; ++i, o += R)
            gvi__add(st, J, i, j, m, (dF[o] - bF[o])/step, (dP[o] - bP[o])/step, by_v);
    }
    gvi__copy((size_t)R, st->x.z, row);
}

// derivatives of what has no Hessian
GVI__APART gvi_status gvi__jacobian_differences(gvi_stepper *st, const gvi__matrix *J, const gvi__sites *at)
{
    gvi__sites all;
    if (GVI__SMALL) all = gvi__all_points(st), at = &all;
    const unsigned plain = gvi__without_hessian(st);
    const int varies = !gvi__mass_is_constant(&st->x.desc);
    const int reads_v = varies || (plain & ~gvi__of_kind(st, GVI_POTENTIAL)) != 0;
    if (!varies && !plain) return GVI_OK;
    gvi_status status = gvi__ask_sites(st, at, st->x.dF + 2*st->n*at->stride);
    for (int k = 0; k < 2*st->n && status == GVI_OK; k += 2 - reads_v) {       // of each coordinate q, then v
        gvi__move_row(st, at, k);
        status = gvi__ask_sites(st, at, st->x.dF);
        if (status == GVI_OK) gvi__add_differences(st, J, at, k);
    }
    return status;
}

/* A Lagrangian whose d2L/dv2 is singular (linear in v, a coordinate without mass)
   would make (1) solvable all the same, and its solution worthless.           */
GVI__APART gvi_status gvi__check_regular(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    const int n = st->n;
    if (gvi__mass_is_constant(&x->desc) && !gvi__has(st, GVI__HAS_LAGRANGIAN)) return GVI_OK;
    gvi_real *q = x->hess + 4*n + n*n + 1, *v = q + n;              // behind the matrix and its pivots
    gvi__gather(n, x->stride, x->work.Q, q);
    gvi__gather(n, x->stride, x->work.V, v);
    gvi_points y;
    gvi__at(&y, st, x->t, q);
    y.v = v;
    if (!gvi__has(st, GVI__HAS_LAGRANGIAN)) return gvi__factor_at(st, &y);
    gvi_status status = gvi__evaluate(st, &y, 0);
    if (status == GVI_OK) status = gvi__velocity_hessian(st, &y, v);
    if (status != GVI_OK) return status;
    gvi_real *W = x->hess + 3*st->n;
    int *at = &st->fault.coordinate;                    // -1, GVI_FAULT_NONE, but where it is singular
    status = gvi__lu_factor(st->n, W, W + st->n*st->n, at);
    return status == GVI_E_SINGULAR ? gvi__fail(st, status, GVI_FAULT_MASS, *at, GVI_FAULT_NONE) : GVI_OK;
}

static void gvi__scale_rows(int n, int size, const gvi__matrix *J)
{
    for (int row = 0; row < size; ++row) {
        gvi_real *a = J->square + (size_t)row*(size_t)size, *ends = J->ends + (size_t)row*2*(size_t)n;
        gvi_real big = 0;
        for (int j = 0; j < size; ++j)
            if (GVI_ABS(a[j]) > big) big = GVI_ABS(a[j]);
        for (int j = 0; big > 0 && j < size; ++j) a[j] /= big;
        for (int j = 0; big > 0 && j < 2*n; ++j) ends[j] /= big;
    }
}

// the middle of the step, between the two points next to it
static gvi__sites gvi__middle(gvi_stepper *st, gvi_real *t)
{
    struct gvi__private *x = &st->x;
    const int a = (st->r - 1)/2, b = st->r/2;
    gvi__sites at = { t, x->change, x->change + st->n, 1, 1 };
    *t = (x->t[a] + x->t[b])/2;
    for (int i = 0; i < st->n; ++i) {
        const gvi_real *Q = x->work.Q + i*x->stride, *V = x->work.V + i*x->stride;
        at.q[i] = (Q[a] + Q[b])/2;
        at.v[i] = (V[a] + V[b])/2;
    }
    return at;
}

static gvi_status gvi__jacobian_fill(gvi_stepper *st, const gvi__matrix *J)
{
    const size_t n = (size_t)st->n, size = (size_t)(st->s - J->k0)*n;
    const size_t whole = size*(size + (J->ends ? 2*n : 0)), blocks = (size_t)(st->s + 1)*n*n;
    gvi__zero(gvi__in_blocks(J) ? blocks : whole, J->square);
    if (GVI__SMALL) {
        const gvi_status status = gvi__jacobian_exact(st, J, NULL);
        return status == GVI_OK ? gvi__jacobian_differences(st, J, NULL) : status;
    }
    gvi_real t;
    const gvi__sites at = gvi__in_blocks(J) ? gvi__middle(st, &t) : gvi__all_points(st);
    const gvi_status status = gvi__jacobian_exact(st, J, &at);
    return status == GVI_OK ? gvi__jacobian_differences(st, J, &at) : status;
}

GVI__APART gvi_status gvi__jacobian_factor(gvi_stepper *st, const gvi__matrix *J)
{
    int n = st->n, size = (st->s - J->k0)*n, at;
    if (gvi__in_blocks(J)) return gvi__factor_blocks(st, J);
    if (J->scaled) gvi__scale_rows(n, size, J);
    gvi_status status = gvi__lu_factor(size, J->square, J->pivot, &at);
    gvi__count(&st->counters.factorizations, 1);
    if (status == GVI_OK) return GVI_OK;
    return gvi__fail(st, status, GVI_FAULT_NONE, at < 0 ? GVI_FAULT_NONE : at % n, GVI_FAULT_NONE);
}

static gvi_status gvi__jacobian(gvi_stepper *st, const gvi__matrix *J)
{
    gvi_status status = gvi__check_regular(st);
    if (status == GVI_OK) status = gvi__jacobian_fill(st, J);
    return status == GVI_OK ? gvi__jacobian_factor(st, J) : status;
}

// y := modes of the extrapolated V, or constant velocity
GVI__APART void gvi__newton_guess(gvi_stepper *st, int extrapolate)
{
    struct gvi__private *x = &st->x;
    int n = st->n, s = st->s, R = x->stride;
    gvi__zero((size_t)(s*n), x->y);
    if (!extrapolate) {
        gvi__velocity_guess(st, x->y);
        return;
    }
    gvi__extrapolate(st, x->last.V, NULL, NULL, x->work.V);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < s; ++k) x->row[k] = gvi__dot3(st->r, x->phi + k*R, x->b, x->work.V + i*R);
        gvi__over_gamma(st, x->row);
        for (int k = 0; k < s; ++k) x->y[k*n + i] = x->row[k];
    }
}

/* y += dy from row k0 on; returns the sum over coordinates of the relative change.  p->work: its
   work, or -1 where all of it is within a few units of the last place of q, or the residual was
   rounding already                                                              */
GVI__APART gvi_real gvi__newton_update(gvi_stepper *st, const gvi__from *from, const gvi__matrix *J,
                                      gvi__descent *p)
{
    struct gvi__private *x = &st->x;
    const int n = st->n;
    const gvi_real h = GVI_ABS(x->h_weights);
    const gvi_real *rest = gvi__newton_rest(st);
    gvi_real sum = 0, *last = gvi__last_y(st);
    const int halves = !GVI__SMALL && J->halves;
    const int solved = p->work <= 16*GVI__EPS;
    int still = 1;
    p->work = 0;
    for (int i = 0; i < n; ++i) {
        gvi_real change = 0, size = 0;
        for (int k = 0; k < st->s; ++k) {
            if (halves) last[k*n + i] = x->y[k*n + i];
            if (k >= J->k0) {
                const int at = (k - J->k0)*n + i;
                x->y[k*n + i] += x->dy[at];
                change += GVI_ABS(x->dy[at]);
                p->work += GVI_ABS(x->dy[at]*rest[at]);
            }
            size += GVI_ABS(x->y[k*n + i]);
        }
        const gvi_real least = GVI__EPS*change;                       // y may land on 0
        if (!(size <= GVI__MIN/GVI__EPS && change <= GVI__MIN/GVI__EPS))  // as gvi__rescale; a NaN goes on
            sum += change/(size < least ? least : size);
        if (!(h*change <= 4*GVI__EPS*GVI_ABS(from->q[i]))) still = 0;
        x->change[i] = x->work.Q[i*x->stride + st->r - 1] - h*change;     // for gvi__worth_of_change
    }
    if (still || solved) p->work = -1;
    return sum;
}

/* Is a change that does not shrink rounding?  It is at the rounding of y, q, the residual or
   the energy that the step moves (and is no jump, whose work is that of the motion), or
   small and the Jacobian new.  Then p->left is what it can
   hide of the error: no more than the change before, nor than its own worth as energy, where
   a coordinate that hardly moves makes all of the noise.                      */
static int gvi__newton_rests(const gvi_stepper *st, const gvi__from *from, int size, gvi__descent *p,
                                 gvi_real change)
{
    const gvi__worth w = gvi__worth_of_change(st, from);
    // by an older matrix that has not contracted here the next change may be the same, whatever it is
    const int fresh = p->fresh & 1, proven = fresh | (p->rho < (gvi_real)0.25);
    const int fine = proven & (w.moved + w.place <= GVI__MAX) & (w.beyond <= 4*GVI__EPS*w.moved);
    const gvi_real small = fresh ? GVI_SQRT(GVI__EPS) : 0, enough = 64*GVI__EPS*(gvi_real)size;
    const int sure = (p->work < 0) | (proven & (change <= (enough > small ? enough : small)));
    const int falls = (gvi_real)st->r*p->work <= GVI__EPS*(w.moved + w.place);
    const int rests = fine | gvi__is_rounding(&w, p->idle);
    if (!(sure | (falls & rests))) return 0;
    p->left = p->before;
    if (fine && w.beyond + 4*GVI__EPS*w.place < p->before*w.moved)
        p->left = (w.beyond + 4*GVI__EPS*w.place)/w.moved;
    return 1;
}

/* The verdict on a change.  Where it is rounding, what is left of the error shrinks on by the
   contraction seen before.  Not to be less than half of the least so far is not to shrink: what
   is rounded to a grid may go round a few points of it, and fall in every round.  Nor is it
   contraction to fall from an overshoot far beyond the size of y.  Gives up blocks that contract
   by no more than 1/2 when they are new: derivatives at one point are not enough.  */
GVI__APART int gvi__newton_judge(gvi_stepper *st, const gvi__from *from, const gvi__matrix *J,
                                 gvi__descent *p, gvi_real change)
{
    const gvi_real before = p->before, all = (gvi_real)st->n;         // all coordinates anew
    const gvi_real ratio = before > 0 ? change/(before > all ? all : before) : 1;
    const gvi_real wanted = st->x.desc.tolerance;
    if (!gvi__finite(change)) return GVI__NOT_FINITE;
    gvi__watch(st, change*change, p->earlier*p->earlier);
    const int stagnant = (before > 0) & (change > p->least/2);
    p->idle = (signed char)(!stagnant ? 0 : p->idle < 100 ? p->idle + 1 : 100);
    const gvi_real noise = 64*GVI__EPS*(gvi_real)((st->s - J->k0)*st->n);
    if (before > 0 && !stagnant && !(p->left < GVI__MAX) && (change > noise || change < p->rho*p->least))
        p->rho = change/p->least;
    if (change < p->least) p->least = change;
    const int rounding = p->left < GVI__MAX
        || (stagnant && gvi__newton_rests(st, from, (st->s - J->k0)*st->n, p, change));
    if (rounding) p->left *= p->rho;

    const gvi_real enough = wanted > 0 ? wanted : GVI__EPS/4096;
    if (change*ratio <= enough || p->left <= GVI__EPS/65536 || p->left <= enough) return GVI__DONE;
    const int hidden = p->work < 0 && p->rho < (gvi_real)0.25;        // rounding, by a matrix that has contracted here
    if (!rounding && !hidden && before > 0 && ratio > (gvi_real)0.25) {
        if (gvi__in_blocks(J) && p->fresh & 2 && ratio > (gvi_real)0.5) return GVI__BEYOND;
        p->have = 0;
    }
    p->earlier = before;
    p->before = change;
    return GVI__GO_ON;
}

// dy := J^-1 dy
GVI__APART void gvi__solve_for_change(gvi_stepper *st, const gvi__matrix *J)
{
    if (gvi__in_blocks(J)) gvi__solve_blocks(st, J);
    else gvi_lu_solve((st->s - J->k0)*st->n, J->square, J->pivot, st->x.dy);
    gvi__count(&st->counters.newton_iterations, 1);
}

/* Where a change that is not small has not made the residual less: back to where it began, for a new
   matrix; or if it was new, half of the way.  Where six halves have not helped all of the change
   stands: across a kink, or from one curve to the next, the way down may lead up first.       */
GVI__APART void gvi__take_back(gvi_stepper *st, gvi__descent *p)
{
    const int size = st->s*st->n, halves = p->halves, most = GVI__HALVES;
    const gvi_real *last = gvi__last_y(st);
    gvi_real *y = st->x.y;
    const gvi_real part = !(p->fresh & 1) ? 0 : halves < most ? (gvi_real)0.5 : (gvi_real)(1 << most);
    for (int i = 0; i < size; ++i) y[i] = last[i] + part*(y[i] - last[i]);
    if (p->fresh & 1) p->halves = (signed char)(halves + 1);
    else p->have = 0, p->halves = -1;
    gvi__count(&st->counters.newton_iterations, 1);
}

// Does y stay, of that norm?  Where what was at rest grows again, that was no rounding
GVI__APART int gvi__newton_stays(gvi_stepper *st, const gvi__matrix *J, gvi__descent *p, gvi_real norm)
{
    gvi_real *last = gvi__last_norm(st);
    const int rests = p->left < GVI__MAX;
    if (!GVI__SMALL && J->halves && p->halves >= 0 && p->halves <= GVI__HALVES && !(norm < *last) && !rests
        && p->before > GVI_SQRT(GVI__EPS)) {
        gvi__take_back(st, p);
        return 0;
    }
    if (p->halves > 0) p->have = 0;                // another place: another matrix
    if (rests && norm/16 > *last) {
        p->before = 0;
        p->least = p->left = GVI__MAX;
        p->rho = (gvi_real)0.25;
    }
    if (!(p->left < GVI__MAX)) *last = norm;
    return 1;
}

// the matrix of the steps comes first, that of queries behind it
static inline int gvi__is_kept(const gvi_stepper *st, const gvi__matrix *J) { return J->pivot == st->x.pivot; }

/* Solves rows k0..s-1 of (1) from the y at hand and leaves F, P, Q, V at the
   solution.  Keeps the factorisation while it contracts by 1/4 or better, over
   iterations and, the one that is for steps, over these.                      */
GVI__APART gvi_status gvi__newton(gvi_stepper *st, const gvi__from *from, const gvi__matrix *J)
{
    struct gvi__private *x = &st->x;
    gvi__descent p = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    p.rho = (gvi_real)0.25;
    p.least = p.left = *gvi__last_norm(st) = GVI__MAX;
    p.halves = -1;
    p.have = gvi__is_kept(st, J) && !gvi__nonzero(x->h_matrix - x->h_weights)
          && x->has_blocks == gvi__in_blocks(J);
    for (int k = 0, made = 0, verdict = GVI__GO_ON; k <= x->desc.max_iterations; ++k) {
        gvi_status status = gvi__newton_ask(st, from, x->h_weights);
        if (status != GVI_OK || verdict == GVI__DONE) return status;        // one more evaluation, then done
        if (!gvi__newton_stays(st, J, &p, gvi__residual(st, from, J->k0, &p))) continue;
        p.fresh = (signed char)((p.fresh & 1) << 1 | !p.have);
        if (p.fresh & 1) {
            if (++made > x->desc.max_iterations/4 + 2) break;
            status = gvi__jacobian(st, J);
            if (status != GVI_OK) return status;
            p.have = 1;
            if (gvi__is_kept(st, J)) {
                x->h_matrix = x->h_weights;
                x->has_blocks = (signed char)gvi__in_blocks(J);
            }
            gvi__copy((size_t)((st->s - J->k0)*st->n), x->dy, gvi__newton_rest(st));  // differences overwrote it
        }
        gvi__solve_for_change(st, J);
        verdict = gvi__newton_judge(st, from, J, &p, gvi__newton_update(st, from, J, &p));
        if (verdict == GVI__NOT_FINITE) return gvi__not_finite(st, 0);
        if (verdict == GVI__BEYOND) break;
        p.halves = 0;
    }
    return gvi__give(st, GVI_E_CONVERGENCE);
}

// eigenvectors at first use; blocks may cost all digits of J but eight bits, enough for
// Newton's method to contract
static signed char gvi__use_blocks(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    if (GVI__SMALL) return 0;
    if (x->blocks < 0) x->blocks = gvi__eigenvectors(st) < 1/(256*GVI__EPS);
    return (signed char)(x->blocks && x->whole_left == 0);
}

// dq and dp of a step that y solves
GVI__APART void gvi__newton_increments(gvi_stepper *st, const gvi__from *from)
{
    struct gvi__private *x = &st->x;
    gvi__clear_behind(st, x->work.F);
    if (gvi__A(&x->work)) gvi__zero((size_t)(st->n*x->stride), x->work.A);     // it made none to go on from
    for (int i = 0; i < st->n; ++i) {
        const gvi__two q = gvi__product(x->h_weights, x->y[i]);
        x->dq[i] = q.hi;
        x->dqe[i] = gvi__rest(q.lo + from->qe[i]);
    }
    gvi__row_increments(st, x->work.F, from->pe, x->dp, x->dpe);
}

// how Newton's method begins: at constant velocity, at the last step's modes; or as the first, and takes back changes
enum { GVI__PLAIN, GVI__EXTRAPOLATED, GVI__HALVED };

// by blocks, if they may be used; where they fail the whole matrix starts anew, and stays.
// Of length h_weights, as gvi__begin has left it
GVI__APART gvi_status gvi__newton_step(gvi_stepper *st, const gvi__from *from, int how, int query)
{
    struct gvi__private *x = &st->x;
    size_t sn = (size_t)(st->s*st->n), offset = query ? sn*sn : 0;
    gvi__matrix J = { x->J + offset, NULL, x->pivot + (query ? sn + 1 : 0), 0, 0, 0, how == GVI__HALVED };
    if (how != GVI__HALVED) J.blocks = gvi__use_blocks(st);
    gvi__newton_guess(st, how == GVI__EXTRAPOLATED);
    const unsigned long long count = st->counters.newton_iterations;
    gvi_status status = gvi__newton(st, from, &J);
    // a callback that refused the first points would refuse them with any matrix
    const int refused = status == GVI_E_CALLBACK && st->counters.newton_iterations == count;
    if (gvi__in_blocks(&J) && status != GVI_OK && !refused) {
        J.blocks = 0;
        if (!query) x->whole_left = 64;
        gvi__newton_guess(st, how == GVI__EXTRAPOLATED);
        status = gvi__newton(st, from, &J);
    }
    gvi__newton_increments(st, from);
    return status;
}

// may another way lead to where this one did not?
static int gvi__tries_again(const gvi_stepper *st, gvi_status status)
{
    return status == GVI_E_CONVERGENCE || status == GVI_E_SINGULAR
        || (status == GVI_E_NON_FINITE && !st->x.diagnose && !GVI__SMALL);
}

/* ---- explicit, beside stiffness: kicks by what is left of the force, arcs between ---- */

/* Rows of drift j: turn[0]/m, turn[1] m, turn[2] of gvi__arc_turn, and what the kick before it moves q
   by, over its force, as two factors; behind the last drift, of each: has it odd half turns? */
static inline gvi_real *gvi__shears(const gvi_stepper *st, int j)
{
    return gvi__spring_tables(st) + (size_t)j*5*gvi__padded((size_t)st->n);
}

// the shears q += a p, p -= back q, q += a p as they are, and turned by half for sign = -1: q += push p
static gvi__two gvi__shears_push(gvi_real b, gvi_real a, gvi_real back, gvi_real sign)
{
    const gvi__two twice = gvi__sub2(gvi__real2(2*a), gvi__scale2(back, gvi__product(a, a)));
    return gvi__scale2(sign*b, twice);
}

// where there is no spring a = tau/2, s = 0
static gvi_status gvi__make_shears(gvi_stepper *st, int j)
{
    struct gvi__private *x = &st->x;
    const size_t row = gvi__padded((size_t)st->n);
    const gvi_real tau = x->drift[j], *stiffness = gvi__stiffness(st), b = j > 0 ? x->hb[j - 1] : 0;
    gvi_real *odd = gvi__shears(st, st->r + 1) + j, turn[3] = { 0, 0, 0 };
    *odd = 0;
    for (int i = 0, made = 0; i < st->n; ++i) {
        gvi_real *by = gvi__shears(st, j) + i;
        const gvi_real m = x->over ? x->mass[i] : 1;
        const int stiff = gvi__nonzero(stiffness[i]);
        if (stiff && (int)stiffness[st->n + i] == made) {
            const gvi__two omega = gvi__frequency(stiffness[i], m), nu = gvi__scale2(tau, omega);
            if (!(GVI_ABS(nu.hi) < 1/GVI__EPS)) return gvi__give(st, GVI_E_CONVERGENCE);
            turn[0] = tau/2;                      // what does not turn would lose its digits in nu
            turn[1] = 0;
            turn[2] = 1;
            if (GVI_ABS(nu.hi) > GVI__MIN/GVI__EPS) gvi__arc_turn(omega, nu, turn);
            if (turn[2] < 0) *odd = 1;
            ++made;
        }
        const gvi_real along = (stiff ? turn[0] : tau/2)/m, back = stiff ? turn[1]*m : 0;
        const gvi_real sign = stiff ? turn[2] : 1;
        by[0] = along;
        by[row] = back;
        by[2*row] = sign;
        if (i > 0 && !gvi__nonzero(along - by[-1]) && !gvi__nonzero(back - by[row - 1])
            && !gvi__nonzero(sign - by[2*row - 1])) {                    // as the one before
            by[3*row] = by[3*row - 1];
            by[4*row] = by[4*row - 1];
            continue;
        }
        gvi__two push = gvi__shears_push(b, along, back, sign);
        push = gvi__rounds(st) ? gvi__two_of(push.hi, 1) : gvi__two_factors(push);
        by[3*row] = push.hi;
        by[4*row] = push.lo;
    }
    return GVI_OK;
}

static gvi_status gvi__make_drifts(gvi_stepper *st, gvi_real h)
{
    gvi_status status = GVI_OK;
    st->x.springs[0] = 0;
    for (int j = 0; j <= st->r && status == GVI_OK; ++j) status = gvi__make_shears(st, j);
    if (status == GVI_OK) st->x.springs[0] = h;
    return status;
}

/* p += b (F + k Q), then the shears.  Little waits for F: what a kick moves q by is a product with a
   number that is known.  p, for which nobody waits, goes through the shears, and the kick beside it. */
GVI__COPY void gvi__kick_arc_of(int n, int odd, int last, gvi_real b, const gvi_real *GVI__RESTRICT k,
                                const gvi_real *GVI__RESTRICT shears, const gvi__from *from, gvi_real zero,
                                gvi_real *GVI__RESTRICT F, gvi_real *GVI__RESTRICT dp,
                                gvi_real *GVI__RESTRICT dq, gvi_real *GVI__RESTRICT Q)
{
    const gvi_real *GVI__RESTRICT p0 = from->p, *GVI__RESTRICT q0 = from->q;
    const size_t row = gvi__padded((size_t)n);
    const gvi_real *along = shears, *back = along + row, *sign = back + row, *push = sign + row;
    const gvi_real *factor = push + row;
    for (int i = 0; i < n; ++i) {
        const gvi_real f = F[i], spring = k[i]*Q[i], kick = b*f + b*spring, a = along[i], p = p0[i] + dp[i];
        const gvi_real d = dq[i] + a*p, pull = back[i]*(q0[i] + d);
        gvi_real to_q = d + a*(p - pull), to_p = (dp[i] - pull) + (kick - back[i]*(a*kick));
        if (odd) {
            to_q = sign[i]*to_q + (sign[i] - 1)*q0[i];
            to_p = sign[i]*to_p + (sign[i] - 1)*p0[i];
        }
        to_q = (to_q + push[i]*(factor[i]*spring)) + push[i]*(factor[i]*f);
        dq[i] = to_q;
        dp[i] = to_p;
        Q[i] = q0[i] + to_q;
        if (!last) F[i] = zero;
    }
}

// n as a constant halves what addresses cost; of 6, two bodies in space, the compiler makes two vectors
static void gvi__kick_arc(const gvi_stepper *st, int j, gvi_real b, const gvi__from *from, gvi_real zero)
{
    const struct gvi__private *x = &st->x;
    const int n = st->n, last = j == st->r, odd = gvi__nonzero(gvi__shears(st, st->r + 1)[j]);
    const gvi_real *k = gvi__stiffness(st), *shears = gvi__shears(st, j);
    gvi_real *F = x->work.F, *dp = x->dp, *dq = x->dq, *Q = x->work.Q;
    if (last && !gvi__nonzero(x->drift[j]))                  // a table that ends with a kick
        for (int i = 0; i < n; ++i) dp[i] += b*F[i] + b*(k[i]*Q[i]);
    else if (n == 6 && !last && !odd) gvi__kick_arc_of(6, 0, 0, b, k, shears, from, zero, F, dp, dq, Q);
    else if (n == 6 && !last) gvi__kick_arc_of(6, 1, 0, b, k, shears, from, zero, F, dp, dq, Q);
    else if (odd && last) gvi__kick_arc_of(n, 1, 1, b, k, shears, from, zero, F, dp, dq, Q);
    else if (odd) gvi__kick_arc_of(n, 1, 0, b, k, shears, from, zero, F, dp, dq, Q);
    else if (last) gvi__kick_arc_of(n, 0, 1, b, k, shears, from, zero, F, dp, dq, Q);
    else gvi__kick_arc_of(n, 0, 0, b, k, shears, from, zero, F, dp, dq, Q);
}

// as gvi__explicit_of; a force that is not known kicks by 0 before the first drift
static gvi_status gvi__explicit_arcs(gvi_stepper *st, const gvi__from *from, gvi_real h,
                                     const gvi_real *force)
{
    struct gvi__private *x = &st->x;
    const int only = x->single >= 0 && !x->diagnose, r = st->r;
    const gvi_real zero = h - h;
    gvi_real t = from->t;
    gvi_points y;
    gvi_status status = gvi__nonzero(h - x->springs[0]) ? gvi__make_drifts(st, h) : GVI_OK;
    if (status != GVI_OK) return status;
    gvi__at(&y, st, &t, x->work.Q);
    y.f = x->work.F;
    y.dldv = NULL;
    for (int i = 0; i < st->n; ++i) {
        x->dp[i] = from->pe[i] + zero;
        x->dq[i] = from->qe[i] + zero;
        x->work.Q[i] = from->q[i] + zero;
        x->work.F[i] = force ? force[i] + zero : zero;
    }
    int j = force != NULL;
    gvi__kick_arc(st, j, force ? x->hb[0] : 0, from, zero);
    for (; j < r; ++j) {
        t = from->t + (from->te + x->c[j]*h);
        status = gvi__kick_force(st, &y, only);
        if (status != GVI_OK) return status;
        gvi__kick_arc(st, j + 1, x->hb[j], from, zero);
    }
    return GVI_OK;
}

static inline gvi_status gvi__explicit(gvi_stepper *st, const gvi__from *from, gvi_real h,
                                       const gvi_real *force)
{
    return GVI__STIFF && st->x.springs ? gvi__explicit_arcs(st, from, h, force)
                                       : gvi__explicit_lines(st, from, h, force);
}

/* ---- a step from its start to dq and dp, nothing of it kept yet ---- */

// the force at the start, if the last step ended there and it is known
static inline const gvi_real *gvi__known_force(const gvi_stepper *st, int query)
{
    return st->x.has_force && query != GVI__FROM_START ? st->x.last.F : NULL;
}

static gvi_status gvi__attempt(gvi_stepper *st, gvi__from *from, gvi_real h, int query)
{
    struct gvi__private *x = &st->x;
    gvi__begin(st, from, h);
    if (GVI__NEWTON) st->formulation = x->chosen;
    if (gvi__uses(st, GVI_EXPLICIT)) return gvi__explicit(st, from, h, gvi__known_force(st, query));

    // what a step of another length has learned of weak effects is not taken over
    if (GVI__WEAK && x->weak) gvi__answers(st)[1] = gvi__nonzero(h - st->h) ? 1 : *gvi__answers(st);
    const int usable = x->stepped && h/st->h > -2 && h/st->h < 8;   // farther out the last rows say nothing
    int used = 0, lost = 0;
    gvi_status status = GVI_E_CONVERGENCE;
    if (!gvi__uses(st, GVI_NEWTON) && (!gvi__has(st, GVI__HAS_NEWTON) || x->newton_left == 0 || query)) {
        if (GVI__STIFF && x->springs && gvi__nonzero(h - x->springs[0])) {
            status = gvi__make_arcs(st, h);
            if (status != GVI_OK) return status;
        }
        if (usable) gvi__prepare_guess(st, h, query);
        for (int plain = !usable; plain < 2; ++plain) {
            status = gvi__fixed_point(st, from, h, !plain, &used);
            gvi__count(&st->counters.iterations, used);
            if (!query) st->iterations = used;
            if (used > st->counters.most_iterations) st->counters.most_iterations = used;
            // the extrapolation may be to blame.  Where rounds are given, only a refusal at its values
            // themselves is worth a second try
            if (status == GVI_OK || (gvi__counts(st) && (used > 1 || status == GVI_E_CONVERGENCE))) break;
            lost = 1;
        }
        if (status == GVI_OK) gvi__increments(st, from, h);
        if (status == GVI_OK && usable && !query && gvi__learns(st)) gvi__learn(st, lost ? GVI__LOST : used);
        if (status == GVI_OK || !gvi__may_turn(st)) return status;
        if (!query && status == GVI_E_CONVERGENCE) x->newton_left = 64;
    }
    const unsigned count = (unsigned)st->counters.newton_iterations;
    st->formulation = GVI_NEWTON;
    if (usable) gvi__prepare_guess(st, h, query);
    const int how = usable && x->has_velocity ? GVI__EXTRAPOLATED : GVI__PLAIN;
    status = gvi__newton_step(st, from, how, query);
    if (gvi__tries_again(st, status) && (how == GVI__EXTRAPOLATED || !GVI__SMALL)) {
        if (!query) x->h_matrix = 0;              // the extrapolation may be to blame
        status = gvi__newton_step(st, from, GVI__HALVED, query);
    }
    if (!query) st->iterations = used + (int)((unsigned)st->counters.newton_iterations - count);
    return status;
}

// are q + dq and p + dp finite?  0 x is 0 or NaN
static int gvi__finite_end(const gvi_stepper *st, const gvi__from *from)
{
    const struct gvi__private *x = &st->x;
    const gvi_real *q = from->q, *p = from->p, *dq = x->dq, *dp = x->dp;
    gvi_real none = 0;
    int i = 0, n = st->n;
#ifdef GVI__VECTORS
    gvi__vector nones = { 0 };
    n = gvi__all_of(st);
    for (; i + GVI__LANES <= n; i += GVI__LANES)
        nones += 0*(GVI__AT(q + i) + GVI__AT(dq + i)) + 0*(GVI__AT(p + i) + GVI__AT(dp + i));
    for (int k = 0; i > 0 && k < GVI__LANES; ++k) none += nones[k];
#endif
    for (; i < n; ++i) {
        const gvi__stored a = q[i] + dq[i], b = p[i] + dp[i];   // as it will be kept, not in wide registers
        none += 0*a + 0*b;
    }
    return none >= 0;
}

/* An attempt; and one at which something was not finite once more with every effect
   looked at, to say which one it was: what is not finite then is divergence.  look:
   the first has been made.                                                    */
static gvi_status gvi__solve(gvi_stepper *st, gvi__from *from, gvi_real h, int query, int look)
{
    struct gvi__private *x = &st->x;
    for (;; look = 1) {
        if (look && !query) x->h_matrix = 0;
        if (look) x->diagnose = 1;
        gvi_status status = gvi__attempt(st, from, h, query);
        if (look) {
            x->diagnose = 0;
            const int explained = GVI__SMALL || status != GVI_E_NON_FINITE || st->fault.effect != GVI_FAULT_NONE;
            return status != GVI_OK && explained ? status : gvi__give(st, GVI_E_CONVERGENCE);
        }
        if (status == GVI_OK && !gvi__finite_end(st, from)) status = gvi__give(st, GVI_E_NON_FINITE);
        const int unexplained = status == GVI_E_NON_FINITE && st->fault.effect == GVI_FAULT_NONE;
        if (!GVI__DIAGNOSIS || !unexplained) return status;
    }
}

// work becomes last, last becomes older (where rows are kept that long), and the
// oldest are free for the next step
static void gvi__rotate(gvi_real **older, gvi_real **last, gvi_real **work)
{
    if (!GVI__BEYOND_FLOAT) older = NULL;         // in float no extrapolation reads it
    gvi_real *free = older && *older ? *older : *last;
    if (older && *older) *older = *last;
    *last = *work;
    *work = free;
}

GVI__FITTED void gvi__rotate_rows(gvi_stepper *st)
{
    struct gvi__private *x = &st->x;
    x->turns = x->turns < 5 ? (signed char)(x->turns + 1) : 0;
    if (gvi__uses(st, GVI_EXPLICIT)) {            // no more is kept
        gvi__rotate(NULL, &x->last.F, &x->work.F);
        return;
    }
    gvi__rotate(NULL, &x->last.Q, &x->work.Q);
    gvi__rotate(&x->older_F, &x->last.F, &x->work.F);
    if (GVI__MOMENTA || GVI__NEWTON) gvi__rotate(NULL, &x->last.P, &x->work.P);
    if (GVI__READS_V) gvi__rotate(&x->older_V, &x->last.V, &x->work.V);
    if (GVI__LAGRANGIAN) gvi__rotate(&x->older_A, &x->last.A, &x->work.A);
}

// was := x, x + rest := x + dx + dxe; dxe may be NULL, for 0; the rest is kept or not
static inline void gvi__move_of(int n, int keeps, gvi_real zero, const gvi_real *GVI__RESTRICT dx,
                                const gvi_real *GVI__RESTRICT dxe, gvi_real *GVI__RESTRICT x,
                                gvi_real *GVI__RESTRICT rest, gvi_real *GVI__RESTRICT was)
{
    for (int i = 0; i < n; ++i) {
        gvi__two sum = gvi__sum(x[i], dx[i]);
        if (dxe) sum = gvi__sum(sum.hi, sum.lo + dxe[i]);
        was[i] = x[i] - zero;                         // x, but no call of memmove, which takes longer
        x[i] = sum.hi;
        if (keeps) rest[i] = sum.lo;
    }
}

#if GVI__WIDE
typedef struct gvi__vectors { gvi__vector hi, lo; } gvi__vectors;

// gvi__sum, number by number
GVI__COPY gvi__vectors gvi__exact_vectors(gvi__vector x, gvi__vector y)
{
    const gvi__vector hi = x + y, b = hi - x;
    gvi__vectors z;
    z.hi = hi;
    z.lo = (x - (hi - b)) + (y - b);
    return z;
}

// gvi__move_of in whole vectors
GVI__COPY void gvi__move_vectors(int n, int keeps, gvi_real zero, const gvi_real *dx, const gvi_real *dxe,
                                 gvi_real *x, gvi_real *rest, gvi_real *was)
{
    for (int i = 0; i < n; i += GVI__LANES) {
        const gvi__vector a = GVI__AT(x + i);
        gvi__vectors sum = gvi__exact_vectors(a, GVI__AT(dx + i));
        if (dxe) sum = gvi__exact_vectors(sum.hi, sum.lo + GVI__AT(dxe + i));
        *(gvi__vector *)(was + i) = a - zero;
        *(gvi__vector *)(x + i) = sum.hi;
        if (keeps) *(gvi__vector *)(rest + i) = sum.lo;
    }
}
#endif

static void gvi__move(int n, gvi_real zero, const gvi_real *dx, const gvi_real *dxe, gvi_real *x,
                      gvi_real *rest, gvi_real *was)
{
    const int two = n == 2 && !GVI__SMALL;
#if GVI__WIDE
    if (n >= 8) {
        if (dxe) gvi__move_vectors(n, 1, zero, dx, dxe, x, rest, was);
        else if (rest) gvi__move_vectors(n, 1, zero, dx, NULL, x, rest, was);
        else gvi__move_vectors(n, 0, zero, dx, NULL, x, NULL, was);
        return;
    }
#endif
    if (two && dxe) gvi__move_of(2, 1, zero, dx, dxe, x, rest, was);
    else if (dxe || GVI__SMALL) gvi__move_of(n, 1, zero, dx, dxe, x, rest, was);
    else if (two && rest) gvi__move_of(2, 1, zero, dx, NULL, x, rest, was);
    else if (two) gvi__move_of(2, 0, zero, dx, NULL, x, NULL, was);
    else if (rest) gvi__move_of(n, 1, zero, dx, NULL, x, rest, was);
    else gvi__move_of(n, 0, zero, dx, NULL, x, NULL, was);
}

static inline void gvi__move_time(gvi_stepper *st)
{
    const gvi__two t = gvi__sum(st->t, st->x.dt + st->x.te);
    st->x.t0 = st->t;
    st->t = t.hi;
    st->x.te = t.lo;
}

// the step is done: state and compensation move on, rows become those of the last step
static void gvi__commit(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *x = &st->x;
    const int explicit_one = gvi__uses(st, GVI_EXPLICIT);    // its increments have no rest
    const int n = gvi__all_of(st), rounded = explicit_one && gvi__is_rounded(st);
    const gvi_real zero = GVI__SMALL ? 0 : h - h;
    gvi__move(n, zero, x->dq, explicit_one ? NULL : x->dqe, x->q, rounded ? NULL : x->qe, x->q0);
    gvi__move(n, zero, x->dp, explicit_one ? NULL : x->dpe, x->p, rounded ? NULL : x->pe, x->p0);
    if (GVI__BEYOND_FLOAT) x->alike = x->stepped && !gvi__nonzero(h - st->h) ? 2 : 1;
    if (GVI__LEARNS && x->alike < 2)
        x->learned.rounds = x->learned.steps = x->learned.stage = x->learned.lengthy = 0;
    gvi__move_time(st);
    if (GVI__CLOCK && x->clock >= 0) {
        const gvi__two H = gvi__sum(x->H, x->dH + x->He);
        x->H0 = x->H;
        x->H = H.hi;
        x->He = H.lo;
    }
    st->h = h;
    gvi__rotate_rows(st);
    x->stepped = gvi__has_clock(st) ? 2 : 1;
    if (GVI__WEAK && x->weak) *gvi__answers(st) = gvi__answers(st)[1];
    x->has_force = explicit_one && !gvi__nonzero(x->c[0]) && !gvi__nonzero(x->c[st->r - 1] - 1);
    x->has_velocity = GVI__READS_V && st->formulation > GVI_POSITIONS;
    if (GVI__NEWTON && x->newton_left > 0) x->newton_left = (unsigned char)(x->newton_left - 1);
    if (GVI__NEWTON && x->whole_left > 0) x->whole_left = (unsigned char)(x->whole_left - 1);
    gvi__count(&st->counters.steps, 1);
}

// the explicit formulation has no more to do; what is not finite is looked into
static gvi_status gvi__solve_explicit(gvi_stepper *st, gvi__from *from, gvi_real h)
{
    gvi__begin(st, from, h);
    gvi_status status = gvi__explicit(st, from, h, gvi__known_force(st, GVI__STEP));
    if (status == GVI_OK && !gvi__is_rounded(st) && !gvi__finite_end(st, from))
        status = gvi__give(st, GVI_E_NON_FINITE);
    const int unexplained = status == GVI_E_NON_FINITE && st->fault.effect == GVI_FAULT_NONE;
    return GVI__DIAGNOSIS && unexplained ? gvi__solve(st, from, h, GVI__STEP, 1) : status;
}

/* ---- a step in one piece ---- */

/* With two or three coordinates what a step asks, and hands from function to function through memory, takes
   as long as three or four iterations.  What most such steps are is therefore here once more, in one piece: the
   same terms in the same order, and so the same bits.  Where anything is out of the ordinary nothing has
   moved, and gvi__solve makes the step from its beginning.                    */
#if GVI__PIECES
enum { GVI__GENERAL, GVI__OF_POSITIONS, GVI__OF_MOMENTA };

// momenta of M(q), one effect and nothing beside it
static int gvi__is_plain_momenta(const gvi_stepper *st)
{
    const struct gvi__private *x = &st->x;
    return GVI__MOMENTA && gvi__uses(st, GVI_MOMENTA) && gvi__mass_is(st, GVI_MASS_POSITION)
        && !x->desc.mass.velocity && x->single >= 0 && !gvi__A(&x->work) && !gvi__seldom(st)
        && gvi__clock_bit(st) == 0 && !gvi__counts(st);
}

// is the next step one of these, if it is as long as this one?
static signed char gvi__is_usual(const gvi_stepper *st)
{
    const struct gvi__private *x = &st->x;
    const int kind = st->n == 2 && gvi__is_plain_momenta(st) ? GVI__OF_MOMENTA
        : (st->n == 2 || st->n == 3) && x->desc.mass.kind <= GVI_MASS_DIAGONAL && gvi__is_plain(st) ? GVI__OF_POSITIONS
        : GVI__GENERAL;
    const int is = (st->r == 8 && GVI__BEYOND_FLOAT ? GVI__OF_TWO : 0) + (kind == GVI__OF_POSITIONS ? GVI__SUMS : 0)
                   + (GVI__LEARNS && x->learned.lengthy ? GVI__LONG : 0);
    const int all = (st->r == 8 || st->r == 16) && (x->alike == 2 || !GVI__BEYOND_FLOAT) && x->E_is == is
        && !gvi__nonzero(x->ratio - 1) && x->newton_left == 0 && x->whole_left == 0 && !gvi__by_newton(st);
    return (signed char)(all ? kind : GVI__GENERAL);
}

#endif

// of any kind
GVI__SELDOM gvi_status gvi__any_step(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *x = &st->x;
    if (!x->started) return gvi__unready(st);
    gvi__done(st, GVI_OK);
    if (!gvi__nonzero(h) || !gvi__finite(h)) return st->status = GVI_E_ARGUMENT;

    const gvi_formulation was = st->formulation;
    const unsigned char left = x->newton_left, whole = x->whole_left;
    gvi__from from = { st->t, x->te, x->q, x->qe, x->p, x->pe, x->H + x->He, NULL };
    if (GVI__NEWTON && x->stepped && gvi__nonzero(h - st->h)) x->newton_left = x->whole_left = 0;
    gvi_status status = gvi__uses(st, GVI_EXPLICIT) && !GVI__SMALL ? gvi__solve_explicit(st, &from, h)
                                                                   : gvi__solve(st, &from, h, GVI__STEP, 0);
    if (status == GVI_OK && !gvi__finite(st->t + x->dt)) status = gvi__give(st, GVI_E_ARGUMENT);
    if (status != GVI_OK) {
        gvi__count(&st->counters.failures, 1);
        if (GVI__NEWTON) {
            st->formulation = was;
            x->newton_left = left;
            x->whole_left = whole;
            x->h_matrix = 0;
        }
        return st->status = status;
    }
    gvi__commit(st, h);
#if GVI__PIECES
    x->usual = gvi__is_usual(st);
#endif
    return gvi__done(st, GVI_OK);
}

#if GVI__PIECES
// go on, done or ask once more, as gvi__fixed_point_of has it; GVI__BEYOND: anything else
GVI__COPY int gvi__usual_verdict(gvi_stepper *st, const gvi__from *from, gvi__progress *p, gvi_real change,
                                 int used, int n, int R)
{
    struct gvi__private *x = &st->x;
    const int more = used < x->desc.max_iterations;
    int verdict = gvi__judge_most(st, p, change);
    if (GVI__OFTEN(verdict == GVI__GO_ON && more && p->idle + p->poor == 0)) return GVI__GO_ON;
    if (verdict == GVI__LOOK && gvi__finite(change)) verdict = gvi__judge(st, from, p, NULL, change, used);
    gvi__gather(n, R, x->work.Q + R - 1, x->change);
    if (verdict == GVI__GO_ON && more) return GVI__GO_ON;
    if (verdict != GVI__DONE && verdict != GVI__ASK_ONCE_MORE) return GVI__BEYOND;
    gvi__watch_last(st, change);
    return verdict;
}

// the fixed point; returns the number of iterations, or 0; how often the effect was asked: that, or once more
GVI__COPY int gvi__usual_rounds(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi__stage *y,
                                gvi_real *F, int n, int R, int *asked)
{
    struct gvi__private *x = &st->x;
    const int folded = gvi__folds(st);
    const gvi_effect *effect = x->desc.effects + x->single;
    gvi__progress p = gvi__progress_of(st, n*R);
    gvi_points at;
    gvi__at(&at, st, x->t, y->rows);
    if (effect->kind != GVI_POTENTIAL) at.v = x->work.V;
    at.f = F;
    at.dldv = NULL;
    at.count = st->r;
    at.stride = R;
    for (int used = 1; ; ++used) {
        gvi__zero_rows(n, R, h - h, F);
        *asked = used;
        if (!GVI__OFTEN(effect->points(&at, effect->user) == 0)) return 0;
        const gvi_real change = R == 8 ? gvi__rows_of_8(st, y, gvi__diagonal(st, y), 8, n, folded, NULL)
                                       : gvi__stage_rows_16(st, y, 16, n);
        const int verdict = gvi__usual_verdict(st, from, &p, change, used, n, R);
        if (GVI__OFTEN(verdict == GVI__GO_ON)) continue;
        if (verdict == GVI__BEYOND) return 0;
        if (verdict == GVI__DONE) return used;
        *asked = used + 1;
        gvi__zero_rows(n, R, h - h, F);
        return effect->points(&at, effect->user) ? 0 : used;
    }
}

/* Where coordinate i goes, as gvi__increments_of and gvi__move have it.  The numbers stay in registers: a pair
   that is loaded from where two numbers were just stored would have to wait for both to leave for the cache.  */
typedef struct gvi__moved { gvi__two q, p; } gvi__moved;

GVI__COPY gvi__moved gvi__moved_of(const gvi_stepper *st, const gvi__two *v, gvi_real h, int i, int R)
{
    const struct gvi__private *x = &st->x;
    const gvi_real *F = x->work.F + i*R, bend = gvi__lever_vector(R, x->c, x->hb, F);
    const gvi__two dp = gvi__exact_sum_vector(R, x->hb, F);
    const gvi__two dq = gvi__with_path(h, v->hi, v->lo, x->qe[i], x->over ? bend*x->over[i] : bend);
    const gvi__two q = gvi__sum(x->q[i], dq.hi), p = gvi__sum(x->p[i], dp.hi);
    gvi__moved z;
    z.q = gvi__sum(q.hi, q.lo + dq.lo);
    z.p = gvi__sum(p.hi, p.lo + (dp.lo + x->pe[i]));
    return z;
}

// the same of momenta: both are x + sum h b rows
GVI__COPY gvi__moved gvi__moved_by(const gvi_stepper *st, int i, int R)
{
    const struct gvi__private *x = &st->x;
    const gvi__two dq = gvi__exact_sum_vector(R, x->hb, x->work.V + i*R), q = gvi__sum(x->q[i], dq.hi);
    const gvi__two dp = gvi__exact_sum_vector(R, x->hb, x->work.F + i*R), p = gvi__sum(x->p[i], dp.hi);
    gvi__moved z;
    z.q = gvi__sum(q.hi, q.lo + (dq.lo + x->qe[i]));
    z.p = gvi__sum(p.hi, p.lo + (dp.lo + x->pe[i]));
    return z;
}

// as gvi__commit, of two coordinates as pairs, and a third beside them; v NULL: of momenta; 0: the end is not finite
GVI__COPY int gvi__usual_end(gvi_stepper *st, const gvi__two *v, gvi_real h, int n, int R)
{
    struct gvi__private *x = &st->x;
    const gvi__moved a = v ? gvi__moved_of(st, v, h, 0, R) : gvi__moved_by(st, 0, R);
    const gvi__moved b = v ? gvi__moved_of(st, v + 1, h, 1, R) : gvi__moved_by(st, 1, R);
    const gvi__moved c = n > 2 ? gvi__moved_of(st, v + 2, h, 2, R) : a;
    const gvi__pair q = { a.q.hi, b.q.hi }, qe = { a.q.lo, b.q.lo };
    const gvi__pair p = { a.p.hi, b.p.hi }, pe = { a.p.lo, b.p.lo }, none = 0*q + 0*qe + 0*p + 0*pe;
    gvi_real last = 0*(st->t + h);
    if (n > 2) last += (0*c.q.hi + 0*c.q.lo) + (0*c.p.hi + 0*c.p.lo);
    if (!(none[0] + none[1] + last >= 0)) return 0;
    *(gvi__pair *)x->q0 = GVI__PAIR(x->q);
    *(gvi__pair *)x->p0 = GVI__PAIR(x->p);
    *(gvi__pair *)x->q = q;
    *(gvi__pair *)x->qe = qe;
    *(gvi__pair *)x->p = p;
    *(gvi__pair *)x->pe = pe;
    if (n == 2) return 1;
    x->q0[2] = x->q[2];
    x->p0[2] = x->p[2];
    x->q[2] = c.q.hi;
    x->qe[2] = c.q.lo;
    x->p[2] = c.p.hi;
    x->pe[2] = c.p.lo;
    return 1;
}

// gvi__extrapolate_rows of one step, two rows of sixteen points at a time
GVI__COPY void gvi__extrapolate_two_16(const gvi_stepper *st, const gvi__stage *y)
{
    enum { MOST = 16/GVI__LANES };
    const gvi_real *last = st->x.last.F, *diagonal = gvi__diagonal(st, y);
    gvi__vector next[2][MOST];
    if (GVI__KEPT) gvi__sum_two(16, 16, MOST, st->x.E, last, last + 16, next[0], next[1]);
    for (int i = 0; i < 2; ++i) {
        if (!GVI__KEPT) gvi__sum_vectors(16, 16, MOST, st->x.E, last + 16*i, next[i]);
        const gvi__affine p = gvi__affine_of(y, diagonal, i);
        gvi__affine_vectors(&p, diagonal, MOST, &GVI__AT(st->x.c), next[i]);
        GVI__EACH for (int v = 0; v < MOST; ++v) *(gvi__vector *)(y->rows + 16*i + v*GVI__LANES) = next[i][v];
    }
}

GVI__COPY int gvi__usual_of(gvi_stepper *st, gvi_real h, int n, int R, int two, int *asked)
{
    struct gvi__private *x = &st->x;
    gvi_real path[3], rest[3], *const Q = x->work.Q, *const F = x->work.F;    // just stored, each by itself: not in pairs
    gvi__two v[3];
    const gvi__from from = { st->t, x->te, x->q, x->qe, x->p, x->pe, 0, x->over ? x->v0 : x->p };
    const gvi__stage y = { x->q, x->qe, path, rest, gvi__folds(st) ? x->folded : x->g, F,
                           NULL, h, Q, x->scale, 1, NULL };
    x->dt = h;
    gvi__times(R, st->t, x->te, h, x->c, x->t);
    for (int i = 0; i < n; ++i) {
        v[i] = gvi__two_of(x->p[i], x->pe[i]);
        if (x->over) {
            v[i] = gvi__product(x->p[i], x->over[i]);
            v[i].lo += x->pe[i]*x->over[i];
            x->v0[i] = v[i].hi;
        }
        const gvi__two way = gvi__product(h, v[i].hi);
        path[i] = way.hi;
        rest[i] = GVI__RESTS ? way.lo + h*v[i].lo : 0;
    }
    if (R == 16 && n == 2) gvi__extrapolate_two_16(st, &y);
    else gvi__extrapolate_rows(st, n, R, R, two, 0, x->last.F, x->older_F, &y, Q);
    for (int i = 0; i < n; ++i) x->scale[i] = gvi__scale_of(y.base[i], y.rows[i*R + R - 1]);
    const int used = gvi__usual_rounds(st, &from, h, &y, F, n, R, asked);
    return used > 0 && gvi__usual_end(st, v, h, n, R) ? used : 0;
}

// r: a constant, too
GVI__COPY int gvi__usual_as(gvi_stepper *st, gvi_real h, int n, int *asked)
{
    return st->r == 8 ? gvi__usual_of(st, h, n, 8, GVI__BEYOND_FLOAT, asked) : gvi__usual_of(st, h, n, 16, 0, asked);
}

// apart: of four copies in one function those of two coordinates took 3 % longer
GVI__SELDOM int gvi__usual_of_three(gvi_stepper *st, gvi_real h, int *asked) { return gvi__usual_as(st, h, 3, asked); }

/* Momenta of two coordinates with M(q): the same once more, with three callbacks in place of one.  */

// what is asked in a round, in this order, and how often the first two were
typedef struct gvi__asked { gvi_points mass, effect, gradient; int masses, effects; } gvi__asked;

// each by itself: a copy would have to wait for what was just stored
GVI__COPY void gvi__points_of(const gvi_stepper *st, gvi_points *at, const gvi_real *v, gvi_real *f, int R)
{
    gvi__at(at, st, st->x.t, st->x.work.Q);
    at->v = v;
    at->f = f;
    at->dldv = NULL;
    at->count = at->stride = R;
}

GVI__COPY void gvi__asked_of(const gvi_stepper *st, gvi__asked *z, int R)
{
    const struct gvi__private *x = &st->x;
    const int potential = x->desc.effects[x->single].kind == GVI_POTENTIAL;
    gvi__points_of(st, &z->mass, NULL, NULL, R);
    z->mass.mass = x->point_mass;
    gvi__points_of(st, &z->effect, potential ? NULL : x->work.V, x->work.F, R);
    gvi__points_of(st, &z->gradient, x->work.V, x->work.F, R);
    z->masses = z->effects = 0;
}

// M := its factors, V := M^-1 P, as gvi__ldl_factor_vector and gvi__ldl_solve_vector have them, but with nothing
// loaded that was just stored; 0: a pivot is doubtful
GVI__COPY int gvi__momenta_factor(int R, gvi_real *m, const gvi_real *P, gvi_real *V)
{
    const gvi_real most = 1/(2*GVI__EPS);
    gvi__vector sum = { 0 };
    GVI__EACH for (int o = 0; o < R; o += GVI__LANES, m += GVI__LANES) {
        const gvi__vector a = GVI__AT(m), b = GVI__AT(m + 2*R), c = GVI__AT(m + 3*R), p = GVI__AT(P + o);
        const gvi__vector over_a = 1/a, low = b*over_a, rest = c - low*b, over = 1/rest;
        const gvi__vector loss = a*over_a, off = loss - 1, lost = c*over, rests = rest*over - 1;
        const gvi__vector v = (GVI__AT(P + R + o) - low*p)*over;
        sum += (loss*loss + off*off) + (lost*lost + rests*rests);
        *(gvi__vector *)m = over_a;
        *(gvi__vector *)(m + 2*R) = low;
        *(gvi__vector *)(m + 3*R) = over;
        *(gvi__vector *)(V + R + o) = v;
        *(gvi__vector *)(V + o) = p*over_a - low*v;
    }
    gvi_real all = 0;
    for (int k = 0; k < GVI__LANES; ++k) all += sum[k];
    return all < most*most;
}

// V and F at the rows; 0: something was refused, or a pivot is doubtful
GVI__COPY int gvi__momenta_ask(gvi_stepper *st, gvi__asked *z, gvi_real zero, int R)
{
    struct gvi__private *x = &st->x;
    const gvi_mass *mass = &x->desc.mass;
    const gvi_effect *effect = x->desc.effects + x->single;
    gvi__zero_rows(2, R, zero, x->work.F);
    z->masses += 1;
    if (mass->points(&z->mass, mass->user)) return 0;
    if (!gvi__momenta_factor(R, x->point_mass, x->work.P, x->work.V)) return 0;
    z->effects += 1;
    return effect->points(&z->effect, effect->user) == 0 && mass->gradient(&z->gradient, mass->user) == 0;
}

// P, V of it and Q; returns the change.  V is made of the rows of P while they are in registers
GVI__COPY gvi_real gvi__momenta_rows(gvi_stepper *st, const gvi__stage *y, int R, int folded)
{
    enum { VECTORS = 8/GVI__LANES };
    struct gvi__private *x = &st->x;
    gvi__vector P[2*VECTORS];
    if (R == 16) {
        const gvi_real change = gvi__stage_rows_16(st, y, 16, 2);
        gvi__ldl_solve_eights(2, 16, x->point_mass, x->work.P, x->work.V);
        return change + gvi__stage_rows_16(st, y + 1, 16, 2);
    }
    const gvi_real change = gvi__rows_of_8(st, y, NULL, 8, 2, folded, P);
    GVI__EACH for (int v = 0; v < VECTORS; ++v) {                     // as gvi__ldl_solve_vector
        const gvi_real *m = x->point_mass + v*GVI__LANES;
        const gvi__vector low = GVI__AT(m + 16), b = (P[VECTORS + v] - low*P[v])*GVI__AT(m + 24);
        *(gvi__vector *)(x->work.V + 8 + v*GVI__LANES) = b;
        *(gvi__vector *)(x->work.V + v*GVI__LANES) = P[v]*GVI__AT(m) - low*b;
    }
    return change + gvi__rows_of_8(st, y + 1, NULL, 8, 2, folded, NULL);
}

GVI__COPY int gvi__momenta_rounds(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi__stage *y,
                                  gvi__asked *z, int R)
{
    const int folded = gvi__folds(st);
    gvi__progress p = gvi__progress_of(st, 2*R);
    for (int used = 1; ; ++used) {
        if (!GVI__OFTEN(gvi__momenta_ask(st, z, h - h, R))) return 0;
        const gvi_real change = gvi__momenta_rows(st, y, R, folded);
        const int verdict = gvi__usual_verdict(st, from, &p, change, used, 2, R);
        if (GVI__OFTEN(verdict == GVI__GO_ON)) continue;
        if (verdict == GVI__BEYOND) return 0;
        return verdict == GVI__DONE || gvi__momenta_ask(st, z, h - h, R) ? used : 0;
    }
}

GVI__COPY int gvi__momenta_of(gvi_stepper *st, gvi_real h, int R, int two, gvi__asked *z)
{
    struct gvi__private *x = &st->x;
    const int folded = gvi__folds(st);
    gvi_real *const F = x->work.F, *const V = x->work.V;
    const gvi_real *of_F = folded ? x->folded : gvi__stage_table(st, 0);
    const gvi_real *of_V = folded ? x->folded + R*R : gvi__stage_table(st, 1);
    const gvi__from from = { st->t, x->te, x->q, x->qe, x->p, x->pe, 0, NULL };
    const gvi__stage y[2] = { { x->p, x->pe, NULL, NULL, of_F, F, NULL, 1, x->work.P, x->scale, 0, NULL },
                              { x->q, x->qe, NULL, NULL, of_V, V, NULL, 1, x->work.Q, x->scale + 2, 0, NULL } };
    x->dt = h;
    gvi__times(R, st->t, x->te, h, x->c, x->t);
    gvi__extrapolate_rows(st, 2, R, R, two, 0, x->last.F, x->older_F, NULL, F);
    gvi__extrapolate_rows(st, 2, R, R, two, 0, x->last.V, x->older_V, NULL, V);
    for (int k = 0; k < 2; ++k) {
        if (R == 8) gvi__rows_of_8(st, y + k, NULL, 8, 2, folded, NULL);
        else gvi__stage_rows_16(st, y + k, 16, 2);
    }
    for (int k = 0; k < 4; ++k)
        x->scale[k] = gvi__scale_of(y[k/2].base[k & 1], y[k/2].rows[(k & 1)*R + R - 1]);
    gvi__asked_of(st, z, R);
    const int used = gvi__momenta_rounds(st, &from, h, y, z, R);
    return used > 0 && gvi__usual_end(st, NULL, h, 2, R) ? used : 0;
}

// the effect is counted where positions' is
GVI__COPY int gvi__momenta_as(gvi_stepper *st, gvi_real h, int *asked)
{
    gvi__asked z;
    const int r = st->r, used = r == 8 ? gvi__momenta_of(st, h, 8, GVI__BEYOND_FLOAT, &z)
                                       : gvi__momenta_of(st, h, 16, 0, &z);
    gvi__count(&st->counters.mass, z.masses*r);
    *asked = z.effects;
    if (used == 0) return 0;
    gvi__count(&st->counters.factorizations, z.masses*r);
    gvi__count(&st->counters.velocities, (z.masses + used + 1)*r);
    return used;
}

// the end of a step in one piece, or the step from its beginning
GVI__COPY gvi_status gvi__usual_done(gvi_stepper *st, gvi_real h, int used, int asked)
{
    struct gvi__private *x = &st->x;
    gvi__count(&st->counters.effect[x->single], asked*st->r);
    if (used == 0) return gvi__any_step(st, h);
    st->iterations = used;
    gvi__count(&st->counters.iterations, used);
    if (used > st->counters.most_iterations) st->counters.most_iterations = used;
    if (gvi__learns(st)) gvi__learn(st, used);
    gvi__move_time(st);
    gvi__rotate_rows(st);
    gvi__count(&st->counters.steps, 1);
    return gvi__done(st, GVI_OK);
}

GVI__SELDOM gvi_status gvi__usual_step(gvi_stepper *st, gvi_real h)
{
    int asked = 0;
    const int used = st->n == 2 ? gvi__usual_as(st, h, 2, &asked) : gvi__usual_of_three(st, h, &asked);
    return gvi__usual_done(st, h, used, asked);
}

GVI__SELDOM gvi_status gvi__usual_step_of_momenta(gvi_stepper *st, gvi_real h)
{
    int asked = 0;
    const int used = gvi__momenta_as(st, h, &asked);
    return gvi__usual_done(st, h, used, asked);
}
#endif

GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h)
{
    if (!st) return GVI_E_ARGUMENT;
#if GVI__PIECES
    if (st->x.usual && h >= st->h && h <= st->h)
        return st->x.usual == GVI__OF_POSITIONS ? gvi__usual_step(st, h) : gvi__usual_step_of_momenta(st, h);
#endif
    return gvi__any_step(st, h);
}

/* ---- starting ---- */

/* At one point: V and L, the sums of the potentials and of the Lagrangian terms, and
   the kinetic energy T = v'Mv/2.  Forces have no value.                       */
static gvi_status gvi__values(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v,
                              gvi_real *V, gvi_real *L, gvi_real *T)
{
    const gvi_desc *d = &st->x.desc;
    gvi_points y;
    gvi__at(&y, st, &t, q);
    *V = *L = *T = 0;
    for (int e = 0; e < d->effect_count; ++e) {
        const gvi_kind kind = d->effects[e].kind;
        gvi_real *value = kind == GVI_POTENTIAL ? V : L;
        if ((st->x.off >> e & 1u) || kind == GVI_FORCE || kind == GVI_CLOCK) continue;
        y.v = kind == GVI_POTENTIAL ? NULL : v;
        gvi_status status = gvi__value(st, &y, e, value);
        if (status != GVI_OK) return status;
        if (!gvi__finite(*value)) return gvi__blame(st, GVI_E_NON_FINITE, e);
    }
    y.v = v;
    gvi__zero(2*(size_t)st->n, y.f);              // and y.dldv
    gvi_status status = gvi__kinetic(st, &y);
    *T = gvi__dot(st->n, y.dldv, v)/2;
    return status;
}

/* H = p'v - L, v being a guess on entry and the velocity on return.  Without
   Lagrangian terms the kinetic energy is p'v/2.                               */
static gvi_status gvi__energy(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p,
                              gvi_real *v, gvi_real *energy)
{
    gvi_real V, L, T;
    gvi_status status = gvi__velocity(st, t, q, p, v);
    if (status == GVI_OK) status = gvi__values(st, t, q, v, &V, &L, &T);
    if (status != GVI_OK) return status;
    gvi_real pv = gvi__dot(st->n, p, v);
    *energy = gvi__has(st, GVI__HAS_LAGRANGIAN) ? (pv - T) - L + V : pv/2 + V;
    return GVI_OK;
}

// from q, p in dq, dp and a velocity v, all of them seen to be good
static gvi_status gvi__start(gvi_stepper *st, gvi_real t, const gvi_real *v)
{
    struct gvi__private *x = &st->x;
    size_t n = (size_t)st->n;
    if (gvi__has_clock(st)) {                     // its level
        gvi_real E, *V = x->change;
        gvi__copy(n, v, V);
        gvi_status status = gvi__energy(st, t, x->dq, x->dp, V, &E);
        if (status != GVI_OK) return status;
        x->H = E;
        x->He = 0;
    }
    if (GVI__READS_V) gvi__copy(n, v, x->start);
    gvi__copy(n, x->dq, x->q);
    gvi__copy(n, x->dp, x->p);
    gvi__zero(n, x->qe);
    gvi__zero(n, x->pe);
    st->t = t;
    st->h = 0;
    x->te = 0;
    x->started = 1;
    x->stepped = x->has_force = x->has_velocity = x->alike = x->E_is = 0;
    if (GVI__PIECES) x->usual = 0;
    x->newton_left = x->whole_left = 0;
    x->h_matrix = x->ratio = 0;
    if (GVI__WEAK && x->weak) *gvi__answers(st) = 1;
    st->formulation = x->chosen;
    return gvi__done(st, GVI_OK);
}

// everything a start needs is there and finite
static gvi_status gvi__check_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *w)
{
    if (!st) return GVI_E_ARGUMENT;
    if (!st->x.memory) return gvi__unready(st);
    gvi__done(st, GVI_OK);
    if (!q || !w || !gvi__finite(t)) return st->status = GVI_E_ARGUMENT;
    if (!GVI__SMALL && gvi__all_finite(st->n, q) && gvi__all_finite(st->n, w)) return GVI_OK;
    for (int i = 0; i < st->n; ++i)
        if (!gvi__finite(q[i]) || !gvi__finite(w[i]))
            return gvi__fail(st, GVI_E_ARGUMENT, GVI_FAULT_NONE, i, GVI_FAULT_NONE);
    return GVI_OK;
}

GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_status status = gvi__check_start(st, t, q, v);
    if (status != GVI_OK) return status;
    struct gvi__private *x = &st->x;
    size_t n = (size_t)(unsigned)st->n;           // n > 0, which not every compiler sees

    // p = dL/dv: of the kinetic energy, and of Lagrangian terms where there are any
    gvi_points y;
    gvi__at(&y, st, &t, q);
    y.v = v;
    x->diagnose = 1;
    if (gvi__has(st, GVI__HAS_LAGRANGIAN)) status = gvi__evaluate(st, &y, 0);
    else {
        gvi__zero(2*n, y.f);                      // and y.dldv
        status = gvi__kinetic(st, &y);
    }
    x->diagnose = 0;
    if (status == GVI_OK) status = gvi__finite_here(st, &y);
    if (status != GVI_OK) return status;
    gvi_real *start = x->change + n;              // v may be st->q or st->p, which change first
    gvi__copy(n, y.dldv, x->dp);
    gvi__copy(n, q, x->dq);
    if (GVI__READS_V) gvi__copy(n, v, start);
    return gvi__start(st, t, start);
}

GVI_DEF gvi_status gvi_start_momentum(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p)
{
    gvi_status status = gvi__check_start(st, t, q, p);
    if (status != GVI_OK) return status;
    struct gvi__private *x = &st->x;
    size_t n = (size_t)st->n;
    gvi__copy(n, p, x->dp);                       // p may be dq
    gvi__copy(n, q, x->dq);
    // a velocity to start the first iteration from; where there is none, the step says so
    gvi_real *v = x->change;
    gvi__zero(n, v);
    status = gvi__velocity(st, t, x->dq, x->dp, v);
    if (status == GVI_E_SINGULAR || status == GVI_E_CONVERGENCE) gvi__zero(n, v);
    else if (status != GVI_OK) return status;
    return gvi__start(st, t, v);
}

GVI_DEF gvi_status gvi_start_configurations(gvi_stepper *st, gvi_real t, gvi_real h,
                                            const gvi_real *q0, const gvi_real *q1)
{
    gvi_status status = gvi__check_start(st, t, q0, q1);
    if (status != GVI_OK) return status;
    static const gvi_discrete out = { NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL };
    status = gvi_discrete_lagrangian(st, t, h, q0, q1, &out);             // p0 is in dq then
    return status == GVI_OK ? gvi_start_momentum(st, t, q0, st->x.dq) : status;
}

GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on)
{
    if (!st) return GVI_E_ARGUMENT;
    if (!st->x.memory) return gvi__unready(st);
    gvi__done(st, GVI_OK);
    if (index < 0 || index >= st->x.desc.effect_count) return st->status = GVI_E_ARGUMENT;
    const unsigned bit = 1u << index, was = st->x.off;
    st->x.off = on ? was & ~bit : was | bit;
    if (gvi__has_clock(st) && st->x.started && st->x.off != was) {      // another energy, also at the start
        struct gvi__private *x = &st->x;
        gvi_real E, E0 = x->H0, *v = x->change + st->n;
        gvi_status status = gvi_energy(st, &E);
        if (status == GVI_OK && x->stepped) status = gvi__energy(st, x->t0, x->q0, x->p0, v, &E0);
        if (status != GVI_OK) return x->off = was, st->status = status;
        x->H = E;
        x->He = 0;
        x->H0 = E0;
    }
    st->x.single = gvi__single(st);
    st->x.has_force = 0;
    if (GVI__PIECES) st->x.usual = 0;
    st->x.h_matrix = 0;
    if (GVI__WEAK && st->x.weak) *gvi__answers(st) = 1;
    return gvi__done(st, GVI_OK);
}

/* --------------------------------------------------------------- QUERIES */

static gvi_status gvi__ready(gvi_stepper *st, int stepped)
{
    if (!st) return GVI_E_ARGUMENT;
    if (!st->x.started) return gvi__unready(st);
    gvi__done(st, GVI_OK);
    return stepped && !st->x.stepped ? (st->status = GVI_E_STATE) : GVI_OK;
}

GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v)
{
    gvi_status status = gvi__ready(st, 0);
    if (status != GVI_OK) return status;
    if (!v) return st->status = GVI_E_ARGUMENT;
    struct gvi__private *x = &st->x;

    // the guess: velocity at the last point of the last step, or at the start
    gvi_real *guess = x->change;
    gvi__velocity_guess(st, guess);
    status = gvi__velocity(st, st->t, x->q, x->p, guess);
    if (status == GVI_OK) gvi__copy((size_t)st->n, guess, v);
    return gvi__done(st, status);
}

GVI_DEF gvi_status gvi_energy(gvi_stepper *st, gvi_real *energy)
{
    gvi_status status = gvi__ready(st, 0);
    if (status != GVI_OK) return status;
    if (!energy) return st->status = GVI_E_ARGUMENT;
    struct gvi__private *x = &st->x;
    gvi_real E, *v = x->change + st->n;
    gvi__velocity_guess(st, v);
    status = gvi__energy(st, st->t, x->q, x->p, v, &E);
    if (status == GVI_OK) *energy = E;
    return gvi__done(st, status);
}

/* Beside stiffness: C(tau) q0 + h S(tau) v0 + h M^-1 sum_j h b_j g_j int_0^tau S(tau - x) l_j/b_j dx,
   and its derivative.                                                         */
static void gvi__arcs_at(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *x = &st->x;
    const int s = st->s, R = x->stride;
    const gvi_real *stiffness = gvi__stiffness(st);
    gvi_real *M = x->row, *N = M + R, *mode = N + R, *scratch = mode + R, sine, cosine;
    for (int i = 0; i < st->n; ++i) {
        if (!gvi__nonzero(stiffness[i])) continue;
        const gvi_real over = x->over ? x->over[i] : 1;
        const gvi__two omega = gvi__frequency(stiffness[i], x->over ? x->mass[i] : 1);
        const gvi__two nu = gvi__scale2(st->h, omega);
        gvi__turn(nu, tau, &sine, &cosine);
        gvi__moments(s, nu, 0, tau, M, N);
        const gvi_real v0 = over*x->p0[i];
        gvi_real bend = 0, turn = 0;
        for (int j = 0; j < st->r; ++j) {
            const gvi_real kick = x->hb[j]*x->last.F[i*R + j];
            gvi__modes(st, x->c[j], mode, scratch);
            bend += gvi__dot(s, mode, M)*kick;
            turn += gvi__dot(s, mode, N)*kick;
        }
        q[i] = cosine*x->q0[i] + sine/omega.hi*v0 + over*(bend/omega.hi);
        v[i] = cosine*v0 - omega.hi*sine*x->q0[i] + over*turn;
    }
}

/* Stoermer-Verlet beside stiffness: the arc that ends at q1 with the momentum before the last kick */
static void gvi__arc_to_end(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *x = &st->x;
    const gvi_real *stiffness = gvi__stiffness(st);
    for (int i = 0; i < st->n; ++i) {
        if (!gvi__nonzero(stiffness[i])) continue;
        const gvi__two omega = gvi__frequency(stiffness[i], x->over ? x->mass[i] : 1);
        const gvi_real kick = x->hb[1]*(x->last.F[i] + stiffness[i]*x->q[i]);
        const gvi_real v1 = (x->over ? x->over[i] : 1)*(x->p[i] - kick);
        gvi_real sine, cosine;
        gvi__turn(gvi__scale2(st->h, omega), 1 - tau, &sine, &cosine);
        q[i] = cosine*x->q[i] - sine/omega.hi*v1;
        v[i] = cosine*v1 + omega.hi*sine*x->q[i];
    }
}

/* Curve and velocity of the last step by the same formulas as at its points,
   with the table row that belongs to tau.                                     */
static void gvi__curve(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *x = &st->x;
    int n = st->n, R = x->stride, by_forces = x->chosen <= GVI_POSITIONS && !gvi__by_newton(st);
    gvi_real *a = x->row, *b = a + R;               // at tau: phi, Phi over Gamma
    if (gvi__uses(st, GVI_EXPLICIT)) {              // a straight line
        for (int i = 0; i < n; ++i) {
            gvi_real way = (x->q[i] - x->q0[i]) + x->qe[i];
            q[i] = tau < (gvi_real)0.5 ? x->q0[i] + tau*way : x->q[i] - (1 - tau)*way;
            v[i] = way/st->h;
        }
        if (GVI__STIFF && x->springs) gvi__arc_to_end(st, tau, q, v);
        return;
    }
    gvi__modes(st, tau, a, b);
    gvi__zero((size_t)n, q);
    gvi__zero((size_t)n, v);
    const gvi_real *modes = by_forces ? x->Phi : x->phi, *weight = by_forces ? x->hb : x->b;
    const gvi_real *rows = by_forces ? x->last.F : x->last.V;
    for (int j = 0; j < st->r; ++j) {
        gvi_real S = 0, T = 0;
        for (int k = 0; k < st->s; ++k) {
            S += b[k]*modes[k*R + j];
            T += a[k]*modes[k*R + j];
        }
        if (by_forces) S = tau - S, T = 1 - T;
        for (int i = 0; i < n; ++i) {
            const gvi_real L = weight[j]*rows[i*R + j];
            q[i] += S*L;
            v[i] += T*L;
        }
    }
    if (by_forces) {
        // F of springs that were told is what is left of it: their arcs follow
        gvi__over_mass(st, q, 1, 1);
        gvi__over_mass(st, v, 1, 1);
        gvi__over_constant_mass(st, x->p0, x->v0);
        for (int i = 0; i < n; ++i) {
            q[i] += tau*x->v0[i];
            v[i] += x->v0[i];
        }
    }
    for (int i = 0; i < n; ++i) q[i] = x->q0[i] + st->h*q[i];
    if (GVI__STIFF && x->springs) gvi__arcs_at(st, tau, q, v);
}

// what was asked for
static void gvi__hand_over(int n, const gvi_real *from, gvi_real *to)
{
    if (to) gvi__copy((size_t)n, from, to);
}

GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    gvi_status status = gvi__ready(st, 1);
    if (status != GVI_OK) return status;
    if (!(tau >= 0 && tau <= 1)) return st->status = GVI_E_ARGUMENT;
    if (gvi__rule_is(st, GVI_KICKS)) return st->status = GVI_E_FORMULATION;
    gvi_real *Q = st->x.change, *V = Q + st->n;
    gvi__weights(st, st->h);
    gvi__curve(st, tau, Q, V);
    if (GVI__CLOCK && st->x.stepped == 2) {       // v = q'/g
        gvi_real rate;
        status = gvi__rate_at(st, st->t, Q, &rate, st->x.one);
        if (status != GVI_OK) return st->status = status;
        for (int i = 0; i < st->n; ++i) V[i] /= rate;
    }
    gvi__hand_over(st->n, Q, q);
    gvi__hand_over(st->n, V, v);
    return GVI_OK;
}

/* With a clock: the h of a partial step for a time dt, by Newton's method, the derivative
   being g, kept inside the step by bisection.  h is the next to try, or 0 for no more.  */
typedef struct gvi__bracket { gvi_real dt, h, near, far; } gvi__bracket;

GVI__APART gvi_status gvi__closer(gvi_stepper *st, const gvi__from *from, gvi__bracket *b)
{
    struct gvi__private *x = &st->x;
    gvi_real rate, *q = x->change;
    const gvi_real h = b->h;
    b->h = 0;
    if (!gvi__has_clock(st) || GVI_ABS(x->dt - b->dt) <= 2*GVI__EPS*GVI_ABS(b->dt)) return GVI_OK;
    if (GVI_ABS(x->dt) > GVI_ABS(b->dt)) b->far = h;
    else b->near = h;
    for (int i = 0; i < st->n; ++i) q[i] = from->q[i] + x->dq[i];
    const gvi_status status = gvi__rate_at(st, from->t, q, &rate, x->one);
    if (status != GVI_OK) return status;
    gvi_real next = h - (x->dt - b->dt)/rate;
    if (!((next - b->near)*(b->far - next) > 0)) next = b->near + (b->far - b->near)/2;
    if (!(GVI_ABS(next - h) <= GVI__EPS*GVI_ABS(st->h))) b->h = next;
    return GVI_OK;
}

// dq and dp of a partial step for a time dt from one end of the last step
static gvi_status gvi__partial(gvi_stepper *st, gvi__from *from, int query, gvi_real dt)
{
    const gvi_real far = query == GVI__FROM_END ? -st->h : st->h;
    gvi__bracket b = { dt, dt, 0, far };
    if (gvi__has_clock(st)) {
        b.h = st->h*(dt/(st->t - st->x.t0));
        if (!(GVI_ABS(b.h) <= GVI_ABS(far))) b.h = far/2;      // t did not move, or less than it should
    }
    gvi_status status = GVI_OK;
    for (int k = 0; k < 60 && status == GVI_OK && (k == 0 || gvi__nonzero(b.h)); ++k) {
        status = gvi__solve(st, from, b.h, query, 0);
        if (status == GVI_OK) status = gvi__closer(st, from, &b);
    }
    return status;
}

GVI_DEF gvi_status gvi_state_at(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p)
{
    gvi_status status = gvi__ready(st, 1);
    if (status != GVI_OK) return status;
    struct gvi__private *x = &st->x;
    size_t n = (size_t)st->n;
    if (!gvi__finite(t)) return st->status = GVI_E_ARGUMENT;
    gvi_real ahead = t - x->t0, back = t - st->t;            // one of each sign, or 0
    if (!((ahead >= 0 && back <= 0) || (ahead <= 0 && back >= 0))) return st->status = GVI_E_STATE;
    if (gvi__has_clock(st) && x->stepped != 2) return st->status = GVI_E_STATE;

    // partial step of length h from the nearer end, or none for a rounding of the whole
    int end = GVI_ABS(back) <= GVI_ABS(ahead);
    gvi_real h = end ? back - x->te : ahead;
    gvi__from from = { st->t, x->te, x->q, x->qe, x->p, x->pe, x->H + x->He, NULL };
    if (!end) {
        const gvi__from first = { x->t0, 0, x->q0, x->zeros, x->p0, x->zeros, x->H0, NULL };
        from = first;
    }
    gvi_formulation was = st->formulation;
    if (GVI_ABS(h) > GVI__EPS*(GVI_ABS(ahead) + GVI_ABS(back)))
        status = gvi__partial(st, &from, end ? GVI__FROM_END : GVI__FROM_START, h);
    else {
        gvi__copy(n, from.qe, x->dq);
        gvi__copy(n, from.pe, x->dp);
        gvi__zero(n, x->dqe);
        gvi__zero(n, x->dpe);
    }
    st->formulation = was;
    if (status != GVI_OK) return st->status = status;
    gvi_real *Q = x->change, *P = Q + n, *V = P + n;
    for (size_t i = 0; i < n; ++i) {
        Q[i] = from.q[i] + (x->dq[i] + x->dqe[i]);
        P[i] = from.p[i] + (x->dp[i] + x->dpe[i]);
    }
    gvi__velocity_guess(st, V);
    if (v) status = gvi__velocity(st, t, Q, P, V);
    if (status != GVI_OK) return st->status = status;
    gvi__hand_over(st->n, Q, q);
    gvi__hand_over(st->n, V, v);
    gvi__hand_over(st->n, P, p);
    return gvi__done(st, GVI_OK);
}

// L at one point, with the kinetic energy
static gvi_status gvi__lagrangian(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v,
                                  gvi_real *value)
{
    gvi_real V, L, T;
    const gvi_status status = gvi__values(st, t, q, v, &V, &L, &T);
    if (status == GVI_OK) *value = T - V + L;
    return status;
}

/* Beside stiffness: the generating function of the step.  Sums of h b Q F and of h b M V V are
   p1 q1 - p0 q0 together, so that kinetic energy needs no curve, and k drops out:

     (p1 q1 - p0 q0)/2 - sum_j h b_j (Q_j F_j/2 + V(Q_j))

   On arcs Q is measured from 0, where k has its centre, elsewhere from q0.  F is asked
   again: that of the step is of the rows before the last.                      */
static gvi_status gvi__arc_action(gvi_stepper *st, gvi_real *action)
{
    struct gvi__private *x = &st->x;
    const gvi_real *stiffness = gvi__stiffness(st);
    const int n = st->n, R = x->stride;
    gvi_real sum = 0, V, L, T, *q = x->change, *v = q + n;
    gvi_points y;
    gvi__zero((size_t)n, v);
    for (int i = 0; i < n; ++i) {
        const gvi_real way = x->p[i]*((x->q[i] - x->q0[i]) + x->qe[i]);
        sum += (gvi__nonzero(stiffness[i]) ? way + (x->p[i] - x->p0[i])*x->q0[i] : way)/2;
    }
    for (int j = 0; j < st->r; ++j) {
        if (gvi__uses(st, GVI_EXPLICIT)) gvi__copy((size_t)n, j > 0 ? x->q : x->q0, q);
        else gvi__gather(n, R, x->last.Q + j, q);
        if (gvi__uses(st, GVI_VELOCITIES)) gvi__gather(n, R, x->last.V + j, v);
        const gvi_real t = x->t0 + x->c[j]*st->h;
        gvi_status status = gvi__values(st, t, q, v, &V, &L, &T);
        gvi__at(&y, st, &t, q);
        y.v = v;
        if (status == GVI_OK) status = gvi__evaluate(st, &y, 0);
        if (status != GVI_OK) return status;
        gvi_real virial = 0;
        for (int i = 0; i < n; ++i)
            virial += (gvi__nonzero(stiffness[i]) ? q[i] : q[i] - x->q0[i])*y.f[i];
        sum -= x->hb[j]*(virial/2 + V);
    }
    *action = sum;
    return GVI_OK;
}

// the action along the curve of the last step, from NULL; or along that between boundary values, at its rows
GVI__APART gvi_status gvi__curve_action(gvi_stepper *st, const gvi__from *from, gvi_real h,
                                        const gvi_real *q1, gvi_real *action)
{
    struct gvi__private *x = &st->x;
    const int n = st->n, R = x->stride;
    gvi_real L, *q = x->change, *v = q + n;
    gvi_status status = GVI_OK;
    *action = 0;
    for (int j = 0; j < st->r && status == GVI_OK; ++j) {
        if (!from) gvi__curve(st, x->c[j], q, v);
        for (int i = 0; from && i < n; ++i) {
            q[i] = x->work.Q[i*R + j];
            v[i] = x->work.V ? x->work.V[i*R + j] : (q1[i] - from->q[i])/h;
        }
        status = gvi__lagrangian(st, from ? x->t[j] : x->t0 + x->c[j]*st->h, q, v, &L);
        if (status == GVI_OK) *action += x->hb[j]*L;
    }
    return status;
}

GVI_DEF gvi_status gvi_action(gvi_stepper *st, gvi_real *action)
{
    gvi_status status = gvi__ready(st, 1);
    if (status != GVI_OK) return status;
    if (!action) return st->status = GVI_E_ARGUMENT;
    if (gvi__rule_is(st, GVI_KICKS) || st->x.stepped == 2) return st->status = GVI_E_FORMULATION;
    gvi__weights(st, st->h);
    if (GVI__STIFF && st->x.springs) return gvi__done(st, gvi__arc_action(st, action));
    gvi_real sum;
    status = gvi__curve_action(st, NULL, 0, NULL, &sum);
    if (status == GVI_OK) *action = sum;
    return status;
}

/* Discrete forces h sum b_i f_i dQ_i/dq0, dQ_i/dq1 with the curve's dependence on
   its ends.  The interior rows R = 0 give dy/dq = -J^-1 dR/dq, so the part of y is
   -lambda' dR/dq with J' lambda = g, g_k = h sum h b_i Phi_k f_i: one transposed
   solve for all of it.                                                        */
GVI__APART gvi_status gvi__discrete_forces(gvi_stepper *st, const gvi__matrix *J, gvi_real *minus,
                                           gvi_real *plus)
{
    struct gvi__private *x = &st->x;
    int n = st->n, s = st->s, R = x->stride, size = (s - 1)*n;
    gvi_real *f = x->work.F;                // not needed any more

    // the forces alone, at the points of the curve
    const unsigned forces = gvi__of_kind(st, GVI_FORCE);
    gvi_points y;
    gvi__rows_as_points(&y, st, &x->work, NULL);
    y.f = f;
    gvi__zero((size_t)n*(size_t)R, f);
    gvi_status status = gvi__effects(st, &y, ~forces);

    // at fixed y_k, k >= 1:  dQ_i/dq1 = c_i, dQ_i/dq0 = 1 - c_i  (Phi_0 = c)
    for (int i = 0; i < n; ++i) {
        plus[i] = gvi__dot3(st->r, x->hb, x->Phi, f + i*R);
        minus[i] = 0;
        for (int j = 0; j < st->r; ++j) minus[i] += x->hb[j]*(1 - x->Phi[j])*f[i*R + j];
    }
    if (status != GVI_OK || size == 0 || !(forces & ~x->off)) return status;

    // the interior: J is that of the solution, with the columns of both ends
    gvi_real *lambda = x->dy;
    for (int i = 0; i < n; ++i)
        for (int k = 1; k < s; ++k)
            lambda[(k - 1)*n + i] = x->h_weights*gvi__dot3(st->r, x->hb, x->Phi + k*R, f + i*R);
    gvi__lu_solve_transposed(size, J->square, J->pivot, lambda);
    const gvi_real *ends = J->ends;
    for (int row = 0; row < size; ++row, ends += 2*n)
        for (int i = 0; i < n; ++i) {
            gvi_real by_y0 = ends[i]/x->h_weights, by_q0 = ends[n + i];
            plus[i] -= lambda[row]*by_y0;                 // y_0 = (q1 - q0)/h
            minus[i] -= lambda[row]*(by_q0 - by_y0);
        }
    return GVI_OK;
}

// the Jacobian's own relative error: no smaller reciprocal condition means anything
static gvi_real gvi__jacobian_error(const gvi_stepper *st)
{
    const int exact = gvi__mass_is_constant(&st->x.desc) && !gvi__without_hessian(st);
    return 16*(exact ? GVI__EPS : GVI_SQRT(GVI__EPS));
}

/* The curve between the boundary values: F at its points in work.F, and the sum
   of b_i P_i in p.  Degree 1 is a chord, point by point: nothing to solve.     */
GVI__APART gvi_status gvi__chord(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi_real *q1,
                                 gvi_real *p)
{
    struct gvi__private *x = &st->x;
    int n = st->n, R = x->stride;
    gvi_real *q = x->change, *v = q + n;
    gvi_status status = GVI_OK;
    gvi__zero((size_t)n, p);
    for (int j = 0; j < R && status == GVI_OK; ++j) {
        for (int i = 0; i < n; ++i) {
            v[i] = (q1[i] - from->q[i])/h;
            q[i] = x->work.Q[i*R + j] = from->q[i] + x->c[j]*(q1[i] - from->q[i]);
            if (x->work.V) x->work.V[i*R + j] = v[i];
        }
        if (j >= st->r) continue;
        gvi_points y;
        gvi__at(&y, st, x->t + j, q);
        y.v = v;
        x->diagnose = 1;
        status = gvi__evaluate(st, &y, 0);
        x->diagnose = 0;
        if (status == GVI_OK) status = gvi__finite_here(st, &y);
        for (int i = 0; i < n; ++i) {
            x->work.F[i*R + j] = y.f[i];
            p[i] += x->b[j]*y.dldv[i];
        }
    }
    return status;
}

static gvi_status gvi__interior(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi_real *q1,
                                gvi__matrix *J, gvi_real *p)
{
    struct gvi__private *x = &st->x;
    int n = st->n, size = (st->s - 1)*n;
    if (size == 0) return gvi__chord(st, from, h, q1, p);
    gvi_status status = GVI_E_NON_FINITE;         // once more to see why, as in gvi__solve
    for (int look = 0; look < 1 + GVI__DIAGNOSIS && status == GVI_E_NON_FINITE; ++look) {
        x->diagnose = (unsigned char)look;
        for (int halves = 0; halves < 2; ++halves) {
            gvi__zero((size_t)(st->s*n), x->y);
            for (int i = 0; i < n; ++i) x->y[i] = (q1[i] - from->q[i])/h;
            if (!GVI__SMALL) J->halves = (signed char)halves;
            status = gvi__newton(st, from, J);
            if (GVI__SMALL || !gvi__tries_again(st, status)) break;
        }
        x->diagnose = 0;
    }
    if (status != GVI_OK && status != GVI_E_CONVERGENCE) return status;

    // the Jacobian where it ended says whether there was anything to find
    J->scaled = 1;
    gvi_status second = gvi__jacobian(st, J);
    if (second != GVI_OK) return second;
    if (gvi_lu_rcond(size, J->square, J->pivot, x->dF) < gvi__jacobian_error(st)) status = GVI_E_CONJUGATE;
    for (int i = 0; i < n; ++i) p[i] = gvi__dot(st->r, x->b, x->work.P + i*x->stride);
    return status;
}

// rows and columns i and j of a symmetric matrix change places
static void gvi__exchange(size_t n, gvi_real *a, size_t i, size_t j)
{
    for (size_t k = 0; k < n; ++k) gvi__swap(a + i*n + k, a + j*n + k);
    for (size_t k = 0; k < n; ++k) gvi__swap(a + k*n + i, a + k*n + j);
}

/* Negative eigenvalues of a symmetric matrix, which is overwritten: by Sylvester's
   law those of D in L D L', D with blocks of 1 or 2, complete pivoting (Bunch and
   Parlett, SIAM J. Numer. Anal. 8, 1971; their alpha, (1 + sqrt 17)/8 = 0.6404, says
   when a block of 1 is large enough).  A block of 2 has one of each sign.     */
static int gvi__negative(size_t n, gvi_real *a)
{
    int count = 0;
    for (size_t k = 0, width = 1; k < n; k += width) {
        size_t p = k, q = k, r = k;
        gvi_real diagonal = -1, off = -1;
        for (size_t i = k; i < n; ++i) {
            if (GVI_ABS(a[i*n + i]) > diagonal) diagonal = GVI_ABS(a[i*n + i]), p = i;
            for (size_t j = k; j < i; ++j)
                if (GVI_ABS(a[i*n + j]) > off) off = GVI_ABS(a[i*n + j]), q = j, r = i;
        }
        width = diagonal >= (gvi_real)0.6404*off ? 1 : 2;
        if (width == 1 && !(diagonal > 0)) break;
        gvi__exchange(n, a, k, width == 1 ? p : q);
        if (width == 2) gvi__exchange(n, a, k + 1, r == k ? q : r);        // k has just gone to q
        count += width == 2 || a[k*n + k] < 0;
        const int two = width == 2;
        gvi_real d = a[k*n + k], e = two ? a[(k + 1)*n + k] : 0, f = two ? a[(k + 1)*n + k + 1] : 1;
        for (size_t i = k + width; i < n; ++i) {
            gvi_real x = a[i*n + k], y = two ? a[i*n + k + 1] : 0, det = d*f - e*e;
            gvi_real u = (f*x - e*y)/det, v = (d*y - e*x)/det;          // the block's inverse
            for (size_t j = k + width; j < n; ++j) a[i*n + j] -= u*a[k*n + j] + (two ? v*a[(k + 1)*n + j] : 0);
        }
    }
    return count;
}

// the second variation is h J without the factors 2k + 1 of its rows
GVI__APART gvi_status gvi__count_negative(gvi_stepper *st, const gvi__matrix *J, int *negative)
{
    struct gvi__private *x = &st->x;
    const size_t n = (size_t)st->n, size = (size_t)(st->s - 1)*n;
    const unsigned off = x->off;
    *negative = 0;
    if (size == 0) return GVI_OK;
    x->off |= gvi__of_kind(st, GVI_FORCE);
    gvi_status status = gvi__check_regular(st);
    if (status == GVI_OK) status = gvi__jacobian_fill(st, J);
    x->off = off;
    if (status != GVI_OK) return status;
    gvi_real *a = J->square;
    for (size_t i = 0; i < size; ++i)
        for (size_t j = 0; j <= i; ++j) {
            const gvi_real lower = a[i*size + j]/(gvi_real)(2*(i/n) + 3);
            const gvi_real upper = a[j*size + i]/(gvi_real)(2*(j/n) + 3);
            a[i*size + j] = a[j*size + i] = (lower + upper)/2*x->h_weights;
        }
    *negative = gvi__negative(size, a);
    return GVI_OK;
}

static gvi_status gvi__boundary_value(gvi_stepper *st, const gvi__from *from, gvi_real h, const gvi_real *q1,
                                      const gvi_discrete *out)
{
    struct gvi__private *x = &st->x;
    int n = st->n, s = st->s, R = x->stride;
    size_t size = (size_t)(s - 1)*(size_t)n, sn = (size_t)s*(size_t)n;
    gvi_real *square = s > 1 ? x->J + sn*sn : NULL, *pivot = s > 1 ? x->pivot + sn + 1 : NULL;
    gvi__matrix J = { square, s > 1 ? square + size*size : NULL, pivot, 1, 0, 0, 0 };
    gvi_real *p0 = x->dq, *p1 = x->dp, *minus = x->change, *plus = minus + n, action = 0;
    int negative = 0;
    gvi_status status = gvi__interior(st, from, h, q1, &J, p0);
    if (status == GVI_E_CONJUGATE || (status == GVI_E_SINGULAR && st->fault.effect == GVI_FAULT_NONE))
        return gvi__give(st, GVI_E_CONJUGATE);
    if (status == GVI_OK && out->lagrangian) status = gvi__curve_action(st, from, h, q1, &action);
    if (status != GVI_OK) return status;

    // row 0 of (1) for p0, then (2)
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < st->r; ++j) p0[i] -= x->hb[j]*(1 - x->Phi[j])*x->work.F[i*R + j];
        p1[i] = p0[i] + gvi__dot(st->r, x->hb, x->work.F + i*R);
    }
    status = gvi__discrete_forces(st, &J, minus, plus);
    if (status == GVI_OK && out->negative) status = gvi__count_negative(st, &J, &negative);
    if (status != GVI_OK) return status;
    if (out->negative) *out->negative = negative;
    if (out->lagrangian) *out->lagrangian = action;
    for (int i = 0; i < n; ++i) {
        if (out->d1) out->d1[i] = -p0[i] - minus[i];
        if (out->d2) out->d2[i] = p1[i] - plus[i];
    }
    gvi__hand_over(n, minus, out->minus);
    gvi__hand_over(n, plus, out->plus);
    gvi__hand_over(n, p0, out->p0);
    gvi__hand_over(n, p1, out->p1);
    return GVI_OK;
}

GVI_DEF gvi_status gvi_discrete_lagrangian(gvi_stepper *st, gvi_real t, gvi_real h,
                                           const gvi_real *q0, const gvi_real *q1, const gvi_discrete *out)
{
    if (!st) return GVI_E_ARGUMENT;
    struct gvi__private *x = &st->x;
    if (!x->memory) return gvi__unready(st);
    gvi__done(st, GVI_OK);
    if (!q0 || !q1 || !out || !gvi__all_finite(st->n, q0) || !gvi__all_finite(st->n, q1)
        || !gvi__finite(t) || !gvi__finite(h) || !gvi__nonzero(h)) return st->status = GVI_E_ARGUMENT;
    if ((st->s > 1 && !gvi__has(st, GVI__HAS_NEWTON)) || gvi__rule_is(st, GVI_KICKS) || x->clock >= 0
        || (GVI__STIFF && x->springs))
        return st->status = GVI_E_FORMULATION;
    gvi__from from = { t, 0, q0, x->zeros, x->zeros, x->zeros, 0, NULL };
    gvi__begin(st, &from, h);
    if (gvi__uses(st, GVI_EXPLICIT)) gvi__times(st->r, t, 0, h, x->c, x->t);     // its steps need none
    return gvi__done(st, gvi__boundary_value(st, &from, h, q1, out));
}

/* ---- checkpoints ---- */

GVI_DEF gvi_status gvi_restore(gvi_stepper *st, const gvi_stepper *saved, const gvi_real *memory)
{
    if (!st) return GVI_E_ARGUMENT;
    if (!st->x.memory) return gvi__unready(st);
    gvi__done(st, GVI_OK);
    if (!saved || !memory || saved->n != st->n || saved->s != st->s || saved->r != st->r
        || saved->x.size != st->x.size || saved->x.flags != st->x.flags || saved->x.chosen != st->x.chosen
        || saved->x.clock != st->x.clock || saved->x.desc.effect_count != st->x.desc.effect_count
        || saved->x.desc.mass.kind != st->x.desc.mass.kind
        || !saved->x.folded != !st->x.folded || !saved->x.weak != !st->x.weak)
        return st->status = GVI_E_ARGUMENT;
    gvi_desc desc = st->x.desc;
    gvi_real *own = st->x.memory;
    size_t skip = st->x.skip;
    gvi__copy(st->x.size, memory + saved->x.skip, own);
    const int springs = GVI__STIFF && st->x.springs ? (int)st->x.springs[1] : 0;     // saved's may be gone
    *st = *saved;
    st->x.skip = skip;
    st->x.desc = desc;
    st->x.memory = own;
    const gvi__scene scene = { &st->x.desc, st->order, st->x.flags, st->x.clock, st->x.chosen, springs };
    gvi__layout(&scene, &st->x, own);
    for (int turns = st->x.turns; turns > 0; --turns) gvi__rotate_rows(st);
    st->x.turns = saved->x.turns;
    st->x.single = gvi__single(st);               // the effects need not have the same callbacks, or marks
    if (GVI__WEAK) st->x.marks = gvi__marks(&st->x.desc);
    if (GVI__PIECES) st->x.usual = 0;
    st->q = st->x.q;
    st->p = st->x.p;
    if (gvi__uses(st, GVI_EXPLICIT) && gvi__is_rounded(st)) {            // it carries no rests
        gvi__zero((size_t)st->n, st->x.qe);
        gvi__zero((size_t)st->n, st->x.pe);
    }
    if (gvi__rounds(st) == gvi__rounds(saved)) return gvi__done(st, GVI_OK);
    st->x.h_weights = 0;                          // their tables are not the same
    if (GVI__STIFF && st->x.springs) st->x.springs[0] = 0;
    return gvi__done(st, GVI_OK);
}

/* ---- texts ---- */

GVI_DEF const char *gvi_status_text(gvi_status status)
{
    switch (status) {
    case GVI_OK:            return "ok";
    case GVI_E_ARGUMENT:    return "bad argument: null pointer, size out of range, zero step, NaN or Inf, "
                                   "or what its kind does not take";
    case GVI_E_MEMORY:      return "memory too small: see gvi_size";
    case GVI_E_NODES:       return "rule: a node is outside [0,1], or two coincide";
    case GVI_E_ORDER:       return "rule: its order is below the degree (0: the weights do not sum to 1)";
    case GVI_E_POINTS:      return "rule: too few points, r >= degree is needed";
    case GVI_E_FORMULATION: return "no formulation, or not the one asked for, covers this scene";
    case GVI_E_SINGULAR:    return "singular matrix: a coordinate has no mass";
    case GVI_E_CONVERGENCE: return "no convergence: the step is too large, or a force jumps or is noisy";
    case GVI_E_CALLBACK:    return "a callback refused";
    case GVI_E_NON_FINITE:  return "an effect gave NaN or Inf";
    case GVI_E_VALUE:       return "an effect has no value callback";
    case GVI_E_STATE:       return "not started, no step yet, or time outside the last step";
    case GVI_E_CONJUGATE:   return "conjugate points: the two configurations do not determine the curve";
    case GVI_E_CLOCK:       return "a clock must be positive: g <= 0";
    default:                return "unknown status";
    }
}

GVI_DEF const char *gvi_formulation_text(const gvi_stepper *st)
{
    if (!st) return "no stepper";
    if (st->x.desc.formulation != GVI_AUTO) return "pinned by the description";
    if (st->formulation == GVI_NEWTON && st->x.chosen != GVI_NEWTON)
        return "Newton: the fixed point contracted badly";
    switch (st->formulation) {
    case GVI_EXPLICIT:   return "explicit: Lobatto 2 or kicks, constant mass, effects read only t and q";
    case GVI_POSITIONS:  return "positions: constant mass, effects read only t and q";
    case GVI_VELOCITIES: return "velocities: constant mass, an effect reads v";
    case GVI_MOMENTA:    return "momenta: r = s, velocity from momentum at each point";
    case GVI_NEWTON:     return "Newton: no fixed point covers this mass, degree and rule";
    case GVI_AUTO: default: return "not set up";
    }
}

#endif /* GVI_IMPLEMENTATION */

/* --------------------------------------------------------------- LICENCE

   This software is available under two licences: choose the one you prefer.

   A. MIT
   Copyright (c) 2026 the gvi.h authors

   Permission is hereby granted, free of charge, to any person obtaining a copy
   of this software and associated documentation files (the "Software"), to deal
   in the Software without restriction, including without limitation the rights
   to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
   copies of the Software, and to permit persons to whom the Software is
   furnished to do so, subject to the following conditions:

   The above copyright notice and this permission notice shall be included in
   all copies or substantial portions of the Software.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
   IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
   FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
   AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
   LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
   OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
   SOFTWARE.

   B. Public domain (unlicense.org)
   This is free and unencumbered software released into the public domain.

   Anyone is free to copy, modify, publish, use, compile, sell, or distribute
   this software, either in source code form or as a compiled binary, for any
   purpose, commercial or non-commercial, and by any means.

   In jurisdictions that recognize copyright laws, the author or authors of this
   software dedicate any and all copyright interest in the software to the
   public domain. We make this dedication for the benefit of the public at large
   and to the detriment of our heirs and successors. We intend this dedication
   to be an overt act of relinquishment in perpetuity of all present and future
   rights to this software under copyright law.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
   IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
   FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
   AUTHORS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN
   ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION
   WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.             */
