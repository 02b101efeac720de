/* gvi.h - v0.2.0 - Galerkin variational integrators for mechanical systems
   SPDX-License-Identifier: MIT OR Unlicense              (texts at the end)

   Computes how mechanical systems move: M q'' = -dV/dq + f, or any Lagrangian
   L(t,q,v) with forces f(t,q,v).  Steps conserve momenta to rounding, are
   symplectic, and do not let the energy of a conservative system drift.  The
   order is min(2s, u), for polynomials of degree s and a quadrature rule of order
   u >= 2s - 2, such as Gauss's or Lobatto's.
   One file, C99 or C++11, no dependency but libm, no heap, no globals.

   In ONE source file:          #define GVI_IMPLEMENTATION
                                #include "gvi.h"
   In all others:               #include "gvi.h"

   The two lines come first in the ONE file, before other headers' macros can touch
   the library's names, or in a file of their own.


   SYNOPSIS

   A planet on an ellipse of eccentricity 0.6, for 159 revolutions:

     #define GVI_IMPLEMENTATION
     #include "gvi.h"
     #include <stdio.h>

     GVI_EACH(attraction, 2, f)
     {
         double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2));
         x->f[0] += w*X;  x->f[1] += w*Y;
     }

     int main(void)
     {
         static double memory[GVI_LENGTH(2, 8, 8)];
         const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
         const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 };
         const double q[] = { 0.4, 0 }, v[] = { 0, 2 };
         gvi_stepper st;
         gvi_init(&st, &desc, memory, sizeof memory);
         gvi_start(&st, 0, q, v);
         for (int k = 0; k < 10000 && st.status == GVI_OK; ++k)
             gvi_step(&st, 0.1);
         printf("%s: q = %.9f %.9f\n", gvi_why(&st), st.q[0], st.q[1]);
     }

   prints

     ok: q = -0.602737580 0.799997002

   To add drag, add one row to scene[] and set effect_count = 2.  Removing the row
   removes its whole cost.


   QUICK NOTES          (enough for most programs)

     describe    gvi_desc: n and the effects; all else has a default, degree 8
     effect      one row for each thing that acts.  GVI_POTENTIAL reads t and q,
                 GVI_FORCE also v (friction, motors), GVI_LAGRANGIAN adds to L
                 (magnetic fields), GVI_CONSTRAINT holds g = 0 (rods, joints)
     memory      gvi_size(&desc) bytes, or an array of GVI_LENGTH(n, s, r) numbers
     run         gvi_init once; gvi_start with q and v; gvi_step(&st, h) as often
                 as you like: an eighth of the fastest period is a good first h
     accuracy    or set desc.resolution, 1e-12 say, and gvi_advance chooses each h
     read        st.t, st.q, st.p; gvi_velocity, gvi_energy; gvi_state_at between steps
     status      0, or negative, kept in st.status; a step that fails changes nothing,
                 and gvi_why(&st) is a sentence that says what to do
     angles      their mass depends on q: desc.mass.kind = GVI_MASS_POSITION


   CONTENTS             (search for the names)

     CONVENTIONS          memory, threads, errors, arrays, units, rounding
     OPTIONS              the macros
     HOW IT WORKS         the method on a page, with the notation
     TYPES                effects, mass, rule, description, stepper
     FUNCTIONS            stepper first, then the building blocks
     -- implementation, to be read as a course --
     SUPPORT              what is compiled, lanes, double-word arithmetic
     TOLERANCES           every constant of judgement
     LINEAR ALGEBRA       dense LU, its condition; L D L' at many points
     QUADRATURE           Gauss and Lobatto nodes, order of a rule
     INTERPOLATION        barycentric
     SCENE                what formulations differ in; effects, mass, Legendre transform
     TABLES               what depends on rule, degree and h alone; predictor
     ENGINE               free motion, stages, predictor; clock
     CONSTRAINTS          multipliers, RATTLE, the hidden constraint, forces
     SET-UP               checks, choice of a formulation, memory
     NEWTON'S METHOD      where the fixed point does not contract
     STEP                 in seven parts, from the fixed point to gvi_step; kicks; the dial
     STATE                start, switch, restore
     QUERIES              velocity, energy, curve, state at a time, action
     BOUNDARY VALUES      discrete Lagrangian, forces, conjugate points
     TEXTS, LICENCE


   CONVENTIONS

   memory     Nothing is allocated, ever.  The caller hands gvi_init one array
              and keeps it as long as the stepper is used; there is nothing to
              free.  The stepper points into that array, never into itself, so
              the stepper may be moved.  A copy of stepper and array is a
              checkpoint: see gvi_restore.
   threads    No mutable static data.  Different steppers are independent.  A callback
              must not call a function with the stepper that called it.
   errors     0 (GVI_OK) or a negative gvi_status; also kept in st->status,
              with st->fault naming the effect, coordinate and point.  A call
              that fails leaves t, q, p, the last curve and everything that the
              queries read unchanged to the bit (except gvi_init): halve h and
              go on.
   arrays     Row-major, A[i*n + j].  Values of one coordinate at the points
              of a step are contiguous: coordinate i at point k is
              [i*stride + k].  Inputs are const.  Arrays of one call must not
              overlap unless stated otherwise.
   units      None: time, lengths and masses are the caller's, coordinate by
              coordinate; no tolerance or test of the library depends on them.
              Magnitudes below 1e-307 (float: 1e-31) count as 0.
   rounding   Needs round to nearest and subnormals; -ffast-math and its parts are
              refused, or have no effect.  q, p and t carry compensation terms,
              so 1e9 steps of t + h are as exact as one.  Compiled with
              -ffp-contract=off, it gives the same bits on every IEEE machine but x87, if
              the callbacks give the same bits and products stay between 1e-290
              and 1e299 (float: 1e-30 and 1e34); beyond, their low words depend
              on FMA.
   work       Bounded: docs/embedded.md has the bound, but not that of constraints.
   converged  A step ends when every coordinate has converged, each measured by
              its own size.  Where large forces cancel, a coordinate may never
              settle: its changes then count as rounding below 32 eps of the
              largest |q_i| sqrt(M_ii).

   gvi.h does not: treat contact, run in parallel, or read or write anything.


   OPTIONS

     GVI_IMPLEMENTATION  [one file]    the code, besides the declarations
     GVI_STATIC          [that file]   everything static: private copy
     GVI_REAL            [everywhere]  float, double (default), long double
     GVI_EFFECTS         [everywhere]  most effects a scene may list: 16, to 32
                                       (files that differ in these two do not link)

   Less code, for small machines (docs/embedded.md), all in [that file]:

     GVI_ONLY_EXPLICIT, GVI_ONLY_POSITIONS, GVI_ONLY_VELOCITIES, GVI_ONLY_MOMENTA,
     GVI_ONLY_NEWTON      these formulations and no others (see HOW IT WORKS)
     GVI_NO_CLOCK         no effects of kind GVI_CLOCK
     GVI_NO_CONSTRAINTS   none of kind GVI_CONSTRAINT; GVI_NO_RULES implies it
     GVI_NO_RULES         no rule but Gauss with r = s, and those that GVI_EXPLICIT
                          takes; no Lagrangian terms, no constraints

   A description that needs what was left out is refused: GVI_E_FORMULATION.
   With GVI_STATIC, functions that are not called vanish as well.

     GVI_SQRT(x) GVI_ABS(x) GVI_FLOOR(x) GVI_LDEXP(x, e) GVI_FREXP(x, &e)
                          given all, in gvi_real: <math.h> is not included
*/
/* ------------------------------------------------------------- HOW IT WORKS

   A mechanical system moves so that its action, the integral of L(t, q, q'),
   is stationary.  A variational integrator approximates the action, not the
   equation of motion [1]; each step then has a stationary action of its own, which
   is why symmetries conserve momentum exactly and why the map is
   symplectic.  The Galerkin kind [2] takes

     curve        q(t0 + h tau) = q0 + h sum_k Phi_k(tau) y_k     0 <= tau <= 1
                  k = 0..s-1, phi_k = Legendre polynomial P_k(1 - 2 tau),
                  Phi_k(tau) = integral of phi_k from 0 to tau
     quadrature   nodes c_i, weights b_i, i = 1..r, of order u on [0,1]
     at the nodes Q_i = q0 + h sum_k Phi_k(c_i) y_k      V_i = sum_k phi_k(c_i) y_k
                  t_i = t0 + c_i h
                  F_i = dL/dq + f     P_i = dL/dv        at (t_i, Q_i, V_i)

   The curve is a polynomial of degree s through q0, given by its velocity's Legendre
   modes y_k: the same curves as with control points [2, sec. 2.2], but well conditioned
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
   1/(2k+1), if u >= 2s - 1.  Inserted into Q and V, this gives

     Q_i = q0 + h c_i v0 + h M^-1 sum_j (c_i - S_ij) h b_j F_j              (3)
     V_i = v0 + M^-1 sum_j (1 - T_ij) h b_j F_j                             (4)
     S = Phi Gamma^-1 Phi'      T = phi Gamma^-1 Phi'      N = phi Gamma^-1 phi'

   with phi_ik = phi_k(c_i), Phi_ik = Phi_k(c_i), and ' for the transpose.  So for
   effects that read only q the unknowns are the forces: put F in, get Q out,
   evaluate the effects at all r points at once, repeat.  No velocity, no matrix.  S is
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
     velocities   constant mass, any effects but a clock: (3) and (4) as fixed point
     momenta      M(q), or velocity from momentum given, and r = s: (5)
     Newton       all but a clock and kicks: (1) by Newton's method, dense LU of size s*n

   Each iteration of a fixed point makes the error smaller by (rho h omega)^2 (positions) or
   rho h omega: omega the fastest frequency, rho 1/2 at degree 1, 0.29 at 2, less above.  Where
   that is no gain, GVI_AUTO goes over to Newton.  All solve the same equations, to rounding.

   CONSTRAINTS.  Effects g(t,q) = 0 hold at Lobatto's s + 1 points of the step, where their
   multipliers act; Lagrangian and forces keep the rule's points [8], [9] (equations: CONSTRAINTS).
   The step ends on g = 0 and on the hidden constraint G v + dg/dt = 0, G = dg/dq.  q and p are of
   order min(2s, u) for u >= 2s - 2, symplectic on the constraint manifold; degree 1 with Lobatto's
   two points is RATTLE.  Second derivatives are not needed.  Zeros in G cost nothing: list rows
   that share coordinates near each other.  A row that depends on those before it and
   agrees with them is left out, step by step: its multiplier is 0.  The rank must not change
   within a step, as it does at a change point, where the motion branches.  Newton has lambda among
   its unknowns, s (n + m) of them for m constraints; the fixed points solve for it as they go.

   CLOCK.  An effect g(q) > 0 makes time run as dt = g dtau, and h is a step in
   tau: t moves fast or slow, and the map is as symplectic as with fixed steps
   [3, VIII.2].  The curves of energy E are the zero-energy curves of
   g L(q, q'/g) + g E, a Lagrangian like any other, so momenta takes

     V_i = g v        F_i = g (dL/dq + f) - dg/dq (H - E)        t' = g

   with v = M^-1 p as before.  E is the energy at the start plus the work of forces,
   so every potential and Lagrangian term needs its value.  None of them may depend
   on t: list what does as a force (a value that changes with t is refused at the
   start, GVI_E_FORMULATION).  Without a mass, a clock needs mass.velocity.

   Order.  |q1 - exact| = O(h^(min(2s,u)+1)) a step: twice the degree, which
   is the superconvergence theorem [2, thm. 4.1].  It needs u >= 2s - 2: a weaker
   rule does not see its highest modes properly, and their error enters squared,
   which leaves order min(u, 2(u-s+1)) (docs/theory.md).  The curve in between is
   less exact, min(s, u - s + 1) + 1 in the maximum norm [2, sec. 5].  r < s and
   u < s are refused: with too few points one mode has no kinetic energy, and with
   too low an order not even free motion is exact.

   NOTATION       n degrees of freedom   s degree   r points   h step
                  q, v, p, t, F, P, V, Q, c, b, S, T, N   as above

   GLOSSARY       point         a quadrature node: where in the step effects are evaluated
                  stage values  Q, V, P, F at the points of a step
                  modes         y_k, the Legendre coefficients of the curve's velocity
                  iteration     one pass of the fixed point, or one of Newton's corrections
                  predictor     the stage values an iteration starts from, extrapolated
                  increments    dq, dp, dt: what a step adds to the state
                  compensation  the low word of a number: what rounding took from it
                  multiplier    lambda: how hard a constraint pulls
                  commit        the end of a step that succeeded: the state moves on
                  query         a question that leaves later steps as they are, to the bit
                  explicit      without iteration
                  symplectic    dp ^ dq is conserved, which keeps energy errors bounded
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
   [7] Higham: Accuracy and stability of numerical algorithms, 2nd ed., 2002
   [8] Wenger, Ober-Bloebaum, Leyendecker: Construction and analysis of higher order
       variational integrators for dynamical systems with holonomic constraints, 2017
   [9] Jay: Symplectic partitioned Runge-Kutta methods for constrained Hamiltonian
       systems, 1996; specialized partitioned additive Runge-Kutta methods, 2007 */

/* Macros that programs and <windows.h> often have are set aside while this file is read. */
#ifdef __GNUC__
#define GVI__PRAGMA(text) _Pragma(#text)
#define GVI__MACROS(do)                                                                         \
    GVI__PRAGMA(do("E")) GVI__PRAGMA(do("K")) GVI__PRAGMA(do("N")) GVI__PRAGMA(do("R"))         \
    GVI__PRAGMA(do("T")) GVI__PRAGMA(do("far")) GVI__PRAGMA(do("g")) GVI__PRAGMA(do("h"))       \
    GVI__PRAGMA(do("m")) GVI__PRAGMA(do("small"))
GVI__MACROS(push_macro)
#undef E
#undef K
#undef N
#undef R
#undef T
#undef far
#undef g
#undef h
#undef m
#undef small
#endif

#ifndef GVI_H
#define GVI_H

#include <stddef.h>
#if !defined(__GNUC__) && !defined(GVI_SQRT)
#include <math.h>
#endif

#define GVI_VERSION "0.2.0"

#ifndef GVI_REAL
#define GVI_REAL double
#endif
/* The preprocessor must see which type it is: paste the first word on a prefix.
   For "long double" that leaves (1 ? 3 : double), which is 3 unevaluated.   */
#define GVI__PASTE2(a, b) a##b
#define GVI__PASTE(a, b) GVI__PASTE2(a, b)
#define GVI__KIND_float  1
#define GVI__KIND_double 2
#define GVI__KIND_long   1 ? 3 :
#define GVI__KIND (GVI__PASTE(GVI__KIND_, GVI_REAL))
#if GVI__KIND == 1
#define GVI__MATH(name) name##f
#elif GVI__KIND == 2
#define GVI__MATH(name) name
#elif GVI__KIND == 3
#define GVI__MATH(name) name##l
#else
#error "GVI_REAL must be float, double or long double"
#endif

#ifndef GVI_EFFECTS
#define GVI_EFFECTS 16
#endif

#ifdef GVI_STATIC
#define GVI_DEF static inline
#else
#define GVI_DEF extern
#endif
/* Linked names say the type and GVI_EFFECTS where they are not the defaults (gvi_init_float_16):
   files that differ in them do not link, and libraries of several types fit in one program.  */
#if GVI__KIND == 1
#define GVI__TYPE float
#elif GVI__KIND == 2
#define GVI__TYPE double
#else
#define GVI__TYPE long
#endif
#if GVI__KIND != 2 || GVI_EFFECTS != 16
#define GVI__LINKED(name)                                                                       \
    GVI__PASTE(GVI__PASTE(name##_, GVI__TYPE), GVI__PASTE(_, GVI_EFFECTS))
#define gvi_size GVI__LINKED(gvi_size)
#define gvi_init GVI__LINKED(gvi_init)
#define gvi_start GVI__LINKED(gvi_start)
#define gvi_start_momentum GVI__LINKED(gvi_start_momentum)
#define gvi_start_configurations GVI__LINKED(gvi_start_configurations)
#define gvi_step GVI__LINKED(gvi_step)
#define gvi_advance GVI__LINKED(gvi_advance)
#define gvi_project GVI__LINKED(gvi_project)
#define gvi_switch GVI__LINKED(gvi_switch)
#define gvi_velocity GVI__LINKED(gvi_velocity)
#define gvi_energy GVI__LINKED(gvi_energy)
#define gvi_multipliers GVI__LINKED(gvi_multipliers)
#define gvi_curve GVI__LINKED(gvi_curve)
#define gvi_state_at GVI__LINKED(gvi_state_at)
#define gvi_action GVI__LINKED(gvi_action)
#define gvi_discrete_lagrangian GVI__LINKED(gvi_discrete_lagrangian)
#define gvi_restore GVI__LINKED(gvi_restore)
#define gvi_stepper_size GVI__LINKED(gvi_stepper_size)
#define gvi_why GVI__LINKED(gvi_why)
#define gvi_status_text GVI__LINKED(gvi_status_text)
#define gvi_formulation_text GVI__LINKED(gvi_formulation_text)
#define gvi_gauss GVI__LINKED(gvi_gauss)
#define gvi_lobatto GVI__LINKED(gvi_lobatto)
#define gvi_rule_order GVI__LINKED(gvi_rule_order)
#define gvi_barycentric GVI__LINKED(gvi_barycentric)
#define gvi_interpolate GVI__LINKED(gvi_interpolate)
#define gvi_interpolate_derivative GVI__LINKED(gvi_interpolate_derivative)
#define gvi_basis GVI__LINKED(gvi_basis)
#define gvi_basis_derivative GVI__LINKED(gvi_basis_derivative)
#define gvi_lu_factor GVI__LINKED(gvi_lu_factor)
#define gvi_lu_solve GVI__LINKED(gvi_lu_solve)
#define gvi_lu_rcond GVI__LINKED(gvi_lu_rcond)
#endif

// a body whose sizes are constants where it is called, copied there; arrays that do not overlap
#if defined(__GNUC__)
#define GVI__BODY static inline __attribute__((always_inline))
#define GVI__RESTRICT __restrict
#define GVI__UNUSED __attribute__((unused))
#else
#define GVI__BODY static inline
#define GVI__RESTRICT
#define GVI__UNUSED
#endif
// gcc at -O2 makes vectors only of loops of known length; clang warns where it makes none
#if defined(__clang__) && defined(__GNUC__) && !defined(__OPTIMIZE_SIZE__)
#define GVI__CHUNK 0
#define GVI__LOOP(text)
#define GVI__INDEPENDENT GVI__PRAGMA(clang loop vectorize(assume_safety))
#define GVI__WARNINGS(do) GVI__PRAGMA(clang diagnostic do)
#define GVI_UNROLL GVI__PRAGMA(clang loop unroll(full))
#elif defined(__GNUC__) && __GNUC__ >= 8 && !defined(__OPTIMIZE_SIZE__)
#define GVI__CHUNK 8
#define GVI__LOOP(text) GVI__PRAGMA(text)
#define GVI__INDEPENDENT GVI__PRAGMA(GCC ivdep)
#define GVI__WARNINGS(do)
#define GVI_UNROLL GVI__PRAGMA(GCC unroll 64)
#else
#define GVI__CHUNK 0
#define GVI__LOOP(text)
#define GVI__INDEPENDENT
#define GVI__WARNINGS(do)
#define GVI_UNROLL
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ----------------------------------------------------------------- TYPES */

typedef GVI_REAL gvi_real;

/* GVI_SQRT(x): the same bits as sqrt, but errno is never set.  A compiler that must set it does not
   vectorise square roots unless given -fno-math-errno.                                        */
#if defined(__GNUC__) && !defined(GVI_SQRT)
gvi_real GVI__MATH(__builtin_sqrt)(gvi_real x) __attribute__((const));
#define GVI_SQRT(x) GVI__MATH(__builtin_sqrt)(x)
#elif !defined(GVI_SQRT)
#define GVI_SQRT(x) GVI__MATH(sqrt)(x)
#endif

typedef enum gvi_status {
    GVI_OK            =  0,
    GVI_E_ARGUMENT    = -1,  /* of a call, in desc, or an effect's callback: gvi_why    */
    GVI_E_MEMORY      = -2,  /* the memory is smaller than gvi_size(desc)               */
    GVI_E_NODES       = -3,  /* own rule: a node outside [0,1], or two that coincide;
                                kicks: not finite                                   */
    GVI_E_ORDER       = -4,  /* own rule of order u < s, weights that do not sum to 1   */
    GVI_E_POINTS      = -5,  /* r < s, or a rule that does not see every mode           */
    GVI_E_FORMULATION = -6,  /* no formulation, or not the pinned one, covers this scene */
    GVI_E_SINGULAR    = -7,  /* singular matrix, and no h helps: massless coordinate
                                (fault.coordinate), or a constraint (fault.effect, its row in
                                fault.coordinate) that depends on the others in a part of the
                                step, or has G = 0                                  */
    GVI_E_CONVERGENCE = -8,  /* no solution found: halve h; or a jacobian is not the derivative
                                of its g (fault.effect, its row in fault.coordinate) */
    GVI_E_CALLBACK    = -9,  /* a callback did not return 0 (fault.effect): halve h     */
    GVI_E_NON_FINITE  = -10, /* NaN or Inf came out of an effect (fault.effect); fault.point
                                is GVI_FAULT_NONE: already where the step starts    */
    GVI_E_VALUE       = -11, /* an effect (fault.effect) has no value                   */
    GVI_E_STATE       = -12, /* called too early, or for a time outside the last step   */
    GVI_E_CONJUGATE   = -13, /* boundary values do not determine the curve              */
    GVI_E_CLOCK       = -14, /* a clock's g is not positive (fault.effect, fault.point) */
    GVI_E_CONSTRAINT  = -15, /* the state given is not on a constraint (fault.effect, its row in
                                fault.coordinate), or that row contradicts others   */
    GVI_E_RESOLUTION  = -16  /* st.resolution is above desc.resolution: halve h         */
} gvi_status;

/* What a callback gets: `count` points.  Coordinate i of point k is at [i*stride + k].  Inputs that
   the callback's kind may not read, and outputs that its kind does not have, are NULL.  Outputs do
   not overlap the inputs or each other; "add" is +=, to what other effects have added.  Rows are
   padded from count to stride, with t and q of the start of the step and any v and p, so a callback
   may loop to stride; what it computes in the padding is ignored, even if it is NaN.          */
typedef struct gvi_points {
    int             n;         /* degrees of freedom                           */
    int             count;     /* points in this call, >= 1                    */
    int             stride;    /* distance of two coordinates, >= count        */
    const gvi_real *t;         /* [count]   time                               */
    const gvi_real *q;         /* [n][stride] configuration                    */
    const gvi_real *v;         /* [n][stride] velocity; NULL for a potential   */
    const gvi_real *p;         /* [n][stride] momentum; for mass.velocity only */
    gvi_real       *f;         /* [n][stride] add dL/dq: -dV/dq or the force   */
    gvi_real       *dldv;      /* [n][stride] add dL/dv; Lagrangian terms only */
    gvi_real       *value;     /* [count]    add V, or L of a Lagrangian term; g.
                                  If one function is both points and value, it
                                  fills whichever of f and value is not NULL   */
    gvi_real       *mass;      /* [n*n][stride] write M_ij, i >= j, row i*n + j: what is not 0 */
    gvi_real       *velocity;  /* [n][stride] write v                          */
    gvi_real       *g;         /* [rows][stride] write g(t,q); constraints only */
    gvi_real       *jacobian;  /* [rows*n][stride] write dg_a/dq_i, row a*n + i: what is not 0 */
    gvi_real       *rate;      /* [rows][stride] write dg_a/dt where g reads t; it is 0 before */
} gvi_points;

/* All points at once.  Returns 0, or anything else if it cannot be evaluated
   here.  A step that is not explicit is then tried without its predictor, nearer to its
   start, and by Newton's method; if all fail, it ends with GVI_E_CALLBACK.    */
typedef int gvi_points_fn(const gvi_points *x, void *user);

/* The same, written for one point.  GVI_POINTS(name, n, ...) stands for `static int name`;
   n is a constant.  The list names the arrays that the body uses (t and q are always there): v, p,
   f, dldv, and one of value, mass, velocity; or rows(m), m a constant, for the g, jacobian and
   rate of m constraints.  With f and value, `name` serves as points and as value.  Listing an array
   that the effect's kind does not have gives GVI_E_CALLBACK, with a fault.argument.

     GVI_POINTS(drag, 2, v, f)(const gvi_points *x, void *user)
     {
         x->f[0] -= x->v[0];
         x->f[1] -= x->v[1];
         return (void)user, 0;
     }

   Here count and stride are 1: coordinate i is [i].  GVI_EACH(name, n, ...) { } has no head and no
   return: a body of x and user that cannot fail.  It is copied into a loop over points, which
   gcc and clang vectorise from -O2 on if it is arithmetic and GVI_SQRT without branches.
   Its loops must have constant lengths, and GVI_UNROLL before each, as here over pairs of bodies:

     GVI_UNROLL for (int i = 1; i < 6; ++i)
         GVI_UNROLL for (int j = 0; j < i; ++j) {

   That pays off up to 64 coordinates and 90 pairs with gcc, about 20 of either with clang; beyond,
   loop over rows.  The results are, to the bit, those of a loop written by hand.             */
#define GVI_POINTS(name, n, ...) GVI__POINTS(name, n, GVI__USES(__VA_ARGS__, , , , ))
#define GVI__USES(a, b, c, d, ...)                                                              \
    (GVI__USES_##a | GVI__USES_##b | GVI__USES_##c | GVI__USES_##d)
enum { GVI__USES_, GVI__USES_v, GVI__USES_p, GVI__USES_f = 4, GVI__USES_dldv = 8,
       GVI__USES_value = 16, GVI__USES_mass = 32, GVI__USES_velocity = 64, GVI__ROWS = 128,
       GVI__MISSING = 0x7656 };
#define GVI__USES_rows(m) (m)*GVI__ROWS
#define GVI__POINTS(name, n, uses)                                                              \
    GVI__BODY int gvi__at_##name(const gvi_points *x, void *user);                              \
    GVI__WARNINGS(push) GVI__WARNINGS(ignored "-Wpass-failed")                                  \
    static int name(const gvi_points *x, void *user)                                            \
    {                                                                                           \
        gvi_real a[(n)*(5 + ((uses) & GVI__USES_mass ? (n) : 1))                                \
                   + (uses)/GVI__ROWS*((n) + 2)];                                               \
        const int all = uses, both = all & GVI__USES_f && all & GVI__USES_value,                \
                  value = all & ~(GVI__USES_f | GVI__USES_dldv), rest = all & ~GVI__USES_value; \
        return both && !x->f     ? gvi__in_chunks(gvi__at_##name, x, user, n, all, value, a)    \
             : both && !x->value ? gvi__in_chunks(gvi__at_##name, x, user, n, all, rest, a)     \
                                 : gvi__in_chunks(gvi__at_##name, x, user, n, all, all, a);     \
    }                                                                                           \
    GVI__WARNINGS(pop)                                                                          \
    GVI__BODY int gvi__at_##name

#define GVI_EACH(name, n, ...)                                                                  \
    GVI__BODY void gvi__each_##name(const gvi_points *x, void *user);                           \
    GVI_POINTS(name, n, __VA_ARGS__)(const gvi_points *x, void *user)                           \
    { return gvi__each_##name(x, user), 0; }                                                    \
    GVI__BODY void gvi__each_##name(GVI__UNUSED const gvi_points *x, GVI__UNUSED void *user)

// points k..to-1: a column of what is wanted to a, the body, and back
GVI__BODY int gvi__each_point(gvi_points_fn *at, const gvi_points *x, void *user, int n, int uses,
                              int wanted, gvi_real *a, int k, int to, gvi_real *GVI__RESTRICT f)
{
    const int s = x->stride, value = uses & GVI__USES_value, mass = uses & GVI__USES_mass;
    const int m = value ? 1 : mass ? n*n : n, any = ~0, last = 112, rows = uses/GVI__ROWS;
    gvi_real *other = value ? x->value : mass ? x->mass : x->velocity;
    gvi_real *g = rows ? a + 6*n : NULL, *G = g ? g + rows : NULL, *dg = g ? G + m*rows : NULL;
    int failed = 0;
#define GVI__COLUMN(name, o) uses & GVI__USES_##name ? a + (o)*n : NULL
#define GVI__MOVE(mask, m, to, from)                                                            \
    if (wanted & (mask)) GVI__LOOP(GCC unroll 64) for (int i = 0; i < (m); ++i) to = from
    GVI__INDEPENDENT for (; k < to; ++k) {
        gvi_points y = { n, 1, 1, x->t + k, a, GVI__COLUMN(v, 1), GVI__COLUMN(p, 2),
                         GVI__COLUMN(f, 3), GVI__COLUMN(dldv, 4), GVI__COLUMN(value, 5),
                         GVI__COLUMN(mass, 5), GVI__COLUMN(velocity, 5), g, G, dg };
        GVI__MOVE(any, n, a[i], x->q[i*s + k]);
        GVI__MOVE(GVI__USES_v, n, a[n + i], x->v[i*s + k]);
        GVI__MOVE(GVI__USES_p, n, a[2*n + i], x->p[i*s + k]);
        GVI__MOVE(GVI__USES_f, n, a[3*n + i], f[i*s + k]);
        GVI__MOVE(GVI__USES_dldv, n, a[4*n + i], x->dldv[i*s + k]);
        GVI__MOVE(last, m, if (!mass || i%n <= i/n) a[5*n + i], other[i*s + k]);  // of M, i >= j
        GVI__MOVE(any, rows*(n + 1), G[i], 0);                                 // and dg
        failed |= (at(&y, user) != 0) & (k < x->count);
        GVI__MOVE(any, rows, x->g[i*s + k], g[i]);
        GVI__MOVE(any, rows*n, x->jacobian[i*s + k], G[i]);
        GVI__MOVE(any, rows, x->rate[i*s + k], dg[i]);
        GVI__MOVE(GVI__USES_f, n, f[i*s + k], a[3*n + i]);
        GVI__MOVE(GVI__USES_dldv, n, x->dldv[i*s + k], a[4*n + i]);
        GVI__MOVE(last, m, if (!mass || i%n <= i/n) other[i*s + k], a[5*n + i]);
    }
    return failed;
}

// is an array listed that is not there?
GVI__BODY int gvi__missing(const gvi_points *x, int wanted)
{
    const gvi_real *const arrays[] = { x->v, x->p, x->f, x->dldv, x->value, x->mass, x->velocity };
    int missing = wanted >= GVI__ROWS && !x->g;
    for (int k = 0; k < 7; ++k) missing |= (wanted >> k & 1) && !arrays[k];
    return missing;
}

GVI__BODY int gvi__in_chunks(gvi_points_fn *at, const gvi_points *x, void *user, int n, int uses,
                             int wanted, gvi_real *a)
{
    int failed = 0, k = 0;
    if (gvi__missing(x, wanted)) return GVI__MISSING;
    for (; GVI__CHUNK && k + GVI__CHUNK <= x->stride; k += GVI__CHUNK)
        failed |= gvi__each_point(at, x, user, n, uses, wanted, a, k, k + GVI__CHUNK, x->f);
    return failed | gvi__each_point(at, x, user, n, uses, wanted, a, k, x->count, x->f);
}

/* One point: q, v, f, dldv of length n; v is NULL for a potential, dldv for
   anything but a Lagrangian term.  Adds to f and dldv.  Returns as above.    */
typedef int gvi_point_fn(gvi_real t, const gvi_real *q, const gvi_real *v,
                         gvi_real *f, gvi_real *dldv, void *user);

/* Second derivatives at one point, n*n row-major, added to:
   fq[i*n+j] += d f_i/d q_j     fv[i*n+j] += d f_i/d v_j      (f as above)
   pv[i*n+j] += d (dL/dv_i)/d v_j
   For a potential fv and pv are NULL, for a force pv is.                     */
typedef int gvi_hessian_fn(gvi_real t, const gvi_real *q, const gvi_real *v,
                           gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user);

typedef enum gvi_kind {
    GVI_POTENTIAL  = 0,  /* V(t,q):   reads t, q;    adds -dV/dq to f, or any f(t,q) */
    GVI_FORCE      = 1,  /* f(t,q,v): reads t, q, v; adds f to f                   */
    GVI_LAGRANGIAN = 2,  /* L(t,q,v): reads t, q, v; adds dL/dq to f, dL/dv to dldv */
    GVI_CLOCK      = 3,  /* g(q) > 0: adds g to value and dg/dq to f; at most one   */
    GVI_CONSTRAINT = 4   /* g(t,q) = 0, `rows` of them: writes g, jacobian, rate     */
} gvi_kind;

/* One thing that acts in a scene.  Give exactly one of points and point; for a clock or a
   constraint, points.                                                         */
typedef struct gvi_effect {
    gvi_kind        kind;
    gvi_points_fn  *points;   /* the effect at all points of a step at once     */
    gvi_point_fn   *point;    /* or one point a call                            */
    gvi_points_fn  *value;    /* V or L, for energy and action, and every step of a
                                 clock; NULL: unknown                           */
    gvi_hessian_fn *hessian;  /* for Newton; NULL: differences of f and dldv, which must
                                 then be exact nearly to rounding               */
    void           *user;     /* handed to the callbacks                        */
    int             rows;     /* of a constraint; all together at most n        */
} gvi_effect;

typedef enum gvi_mass_kind {
    GVI_MASS_UNIT     = 0,  /* kinetic energy v'v/2                             */
    GVI_MASS_DIAGONAL = 1,  /* sum m_i v_i^2/2, matrix = m, length n            */
    GVI_MASS_DENSE    = 2,  /* v'Mv/2, matrix = M, n*n, its lower triangle read */
    GVI_MASS_POSITION = 3,  /* v'M(q)v/2, by points and gradient                */
    GVI_MASS_NONE     = 4   /* all of it comes from Lagrangian terms            */
} gvi_mass_kind;

/* The kinetic energy.  M need not be definite, but no leading minor may be 0 (dense, M(q)), nor any
   m_i (diagonal).  M(q) may be singular somewhere, as at the pole of Euler's angles (gimbal lock).
   A step that fails there ends in GVI_E_SINGULAR, one with a point there in GVI_E_CONVERGENCE; a
   step that passes over it without a point there may be wrong, and says GVI_OK.  matrix is read
   by gvi_init only.                                                                           */
typedef struct gvi_mass {
    gvi_mass_kind   kind;
    const gvi_real *matrix;
    gvi_points_fn  *points;    /* GVI_MASS_POSITION: writes x->mass from x->q   */
    gvi_points_fn  *gradient;  /* and adds v' dM/dq v / 2 to x->f, called after
                                  points, or velocity, at the same x->q       */
    gvi_points_fn  *velocity;  /* optional: writes x->velocity, the v at which
                                  dL/dv(t,q,v) = p, L being ALL of the scene.
                                  No linear system is solved then; needed in steps
                                  near the speed of light (gamma > 1e3)        */
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
    GVI_AUTO       = 0,   /* the cheapest that covers the scene; Newton if that
                             contracts badly and s n <= 1024, since Newton's memory
                             grows like (s n)^2: above that, pin GVI_NEWTON.
                             With m constraints, read n + m for n               */
    GVI_EXPLICIT   = 1,
    GVI_POSITIONS  = 2,
    GVI_VELOCITIES = 3,
    GVI_MOMENTA    = 4,
    GVI_NEWTON     = 5    /* last: GVI_AUTO takes the first that covers the scene */
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
    int               effect_count;    /* to GVI_EFFECTS; 0 only where effects is NULL */
    gvi_formulation   formulation;     /* pinned: no fall-back and no memory for one */
    gvi_real          tolerance;       /* 0 to eps/65536: iterate to rounding.  Else, below 1, the
                                          iteration ends when the change yet to come, as the last
                                          two changes predict it, is below tolerance*|q|: faster,
                                          but the energy may drift.  No effect where explicit */
    int               max_iterations;  /* to 1,000,000.  0: 60                 */
    int               iterations;      /* N: exactly N iterations in every step, for a loop with
                                          a deadline; never Newton.  A step fails unless its last
                                          change is rounding, or less than half of the change two
                                          iterations before (N = 2: less than the first change),
                                          and less than a quarter of the motion.
                                          N = 1 has no such test: see counters.worst_change.
                                          0: as many as it takes               */
    gvi_real          resolution;      /* the dial: the relative accuracy wanted of a step, below 1;
                                          less than eps is eps.  A step whose st.resolution is above
                                          it is refused: GVI_E_RESOLUTION.  Needs degree 3 or more,
                                          a rule of order 2 degree or more, and steps that are not
                                          explicit.  0: none is refused, nothing is measured    */
} gvi_desc;

#define GVI_FAULT_NONE (-1)
#define GVI_FAULT_MASS (-2)            /* the callbacks of desc.mass            */

typedef struct gvi_fault {             /* where the last failure came from      */
    int effect;                        /* index in effects, or GVI_FAULT_...    */
    int coordinate;                    /* or GVI_FAULT_NONE                     */
    int point;                         /* quadrature point, or GVI_FAULT_NONE   */
    const char *argument;              /* GVI_E_ARGUMENT, GVI_E_CALLBACK of a GVI_POINTS that
                                          lists too much, GVI_E_CONVERGENCE by a wrong
                                          jacobian: a sentence, else NULL       */
} gvi_fault;

/* Work of steps and queries since gvi_init.  The caller may set any of it to 0. */
typedef struct gvi_counters {
    unsigned long long steps;             /* that succeeded                     */
    unsigned long long failures;          /* steps that did not                 */
    unsigned long long iterations;        /* of the fixed point, also in gvi_state_at */
    unsigned long long newton_iterations;
    unsigned long long factorizations;    /* LU of s*n, or of a matrix at a point */
    unsigned long long velocities;        /* points at which v was formed       */
    unsigned long long mass;              /* points given to mass.points, mass.velocity */
    unsigned long long effect[GVI_EFFECTS]; /* points given to each effect      */
    int                most_iterations;   /* of the fixed point, in one attempt */
    gvi_real           worst_contraction; /* of the iteration, mean of two; where Newton's
                                             method followed, also of what it replaced */
    gvi_real           worst_change;      /* largest last change of a fixed point, relative */
    gvi_real           worst_resolution;  /* largest st.resolution of a step that succeeded */
} gvi_counters;

/* stage values, [n][R]; kicks: [n]; or NULL */
struct gvi__values { gvi_real *Q, *F, *V, *P, *A; };
struct gvi__phase { gvi_real *q, *q_low, *p, *p_low; }; /* [n] each                       */

struct gvi__tables {                  /* rule and degree; R = stride of rows        */
    gvi_real *c, *b;                  /* [R] nodes on their grid, weights           */
    gvi_real *phi, *Phi, *phi_low;    /* [s][R] modes at the nodes                  */
    gvi_real *inv_gamma, *gamma;      /* [s] 1/Gamma_kk; LU of Gamma if full        */
    gvi_real *K, *U, *T, *N;          /* [r][R] see gvi__make_tables                */
    gvi_real *high;                   /* [r][4] sources to the highest modes, with a limit */
};

struct gvi__sized {                   /* valid for a step of length h, the key      */
    gvi_real  h, ratio;               /* h/h_last for which E holds                 */
    gvi_real *hb, *drift, *E;         /* [R] h b; [r+1] between kicks; [2r][R] predictor */
    int       steps, sums;            /* what E makes: see gvi__prepare_predictor   */
};

struct gvi__time {                    /* clock: at the points, and the state's      */
    gvi_real *rate, *power, *level, *lagrangian, *slope;
    gvi_real  H, H_low, dH;           /* energy, compensation, increment            */
};

struct gvi__newton {
    gvi_real *y, *dy, *residual, *last;   /* [s*(n+m)] unknowns, change, rows, before */
    gvi_real *found, *branch, *guess, *slope;  /* [s*(n+m)] see gvi__newton_connected */
    gvi_real  bend;                   /* worst contraction on the way to the last solution */
    gvi_real *J, *pivot;              /* two matrices of s*(n+m): of steps, of queries */
    gvi_real *hessian, *column, *moved;   /* scratch                                */
    gvi_real  h;                      /* for which J was made, 0: none              */
    int       left;                   /* steps until the fixed point is tried       */
};

struct gvi__holonomic {               /* constraints; C = stride of D_0..D_s         */
    gvi_real *d, *w, *hw, *t;         /* [R + C], [s+1] Lobatto's nodes, weights; [R] h w; [C] */
    gvi_real *Phi, *Phi_low;          /* [s][R] modes at D_1..D_s                    */
    gvi_real *K, *U, *by_force, *by_impulse, *lu, *X, *E; /* see gvi__set_constraints; predictor */
    gvi_real *D, *free, *P;           /* [n][R] stage values, free motion; a trial's momenta */
    gvi_real *force, *rho, *last;     /* [n+m][R] G' lambda, -lambda; residual; [n+m][C] last */
    gvi_real *at, *g, *G, *A, *W, *y; /* [.][C] D, g and rate, G, its matrix; scratch; [m] */
    gvi_real *G1, *A1;                /* [2][m][n], [m][m] at one point                 */
    gvi_real *column, *first, *drops; /* see gvi__find_columns, gvi__factor_constraints */
    int       m, C, made, kept, linear; /* rows on; kept: last for the curve, 2 to predict */
    gvi_real *doubt;                  /* [1+3m] see gvi__check_jacobian                 */
    gvi_real *unit;                   /* [2][s*m] of multipliers, see gvi__jacobian      */
    int       settled, again;         /* steps since the start; see gvi__find_columns    */
    unsigned  bits;                   /* the effects                                 */
};

struct gvi_stepper;
struct gvi__stage;
typedef gvi_real gvi__kernel(const struct gvi_stepper *st, const struct gvi__stage *stage,
                             int rescale);

struct gvi__private {
    gvi_desc            desc;         /* with its defaults filled in                */
    gvi_formulation     chosen;       /* by the scene, or pinned                    */
    int                 R, facts;     /* stride of rows; see gvi__has               */
    int                 clock;        /* effect that is one, or -1                  */
    unsigned            off, apart;   /* effects switched off, one bit each; clock, constraints */
    struct gvi__tables  table;
    struct gvi__sized   sized;
    struct gvi__values  work, last, older;  /* of the next step, the last two        */
    struct gvi__phase   state, step;  /* now; increments of the step at work        */
    struct { gvi_real *q, *p, H; } began;                  /* start of the last step */
    struct { gvi_real *v, *v_low, *path, *path_low, *rows; } free; /* M^-1 p; h times it; stages' */
    struct { gvi_real *matrix, *factor, *inverse, *at_points, *sums; } mass;
    struct { gvi_real *scale, *change, *before;   /* [2n] of the rows of stages     */
             gvi_real ratio, found; } watch;      /* contraction: last step, that at work */
    struct gvi__time    time;
    struct gvi__newton  newton;
    struct gvi__holonomic con;
    gvi_real           *t;            /* [R] times of the points                    */
    gvi_real           *row, *point, *result;     /* scratch: [9R], [6n], [3n]           */
    gvi_real           *zeros, *start;                     /* [n]; start: its velocity */
    gvi_real            dt;           /* increment of t                             */
    gvi_real            reach;        /* rung of the longest step that the dial allowed last */
    gvi_real           *memory;       /* from its first aligned number on           */
    size_t              size, skip;   /* numbers in use; left out for alignment     */
    gvi__kernel        *kernel;       /* for n and r                                */
    struct { gvi_status status; gvi_fault fault; } failed;  /* the last step, if it did  */
    int started, stepped;             /* stepped: 2 by a clock                      */
    int kept;                         /* valid steps in last and older, equally long */
    int has_force, has_velocity;      /* last.F ends with the force at (t, q); last.V holds */
    int has_factor, diagnose;         /* at_points is factored; look for what is not finite */
};

/* The stepper, to be read; in is private.                                     */
typedef struct gvi_stepper {
    int             n, s, r;          /* as resolved from the description       */
    gvi_status      status;           /* of the last call, queries included; but status and fault of
                                         a step that failed stay until the next step or start     */
    gvi_formulation formulation;      /* used by the last step, or the next     */
    gvi_real        t, t_low;         /* time and its compensation: t + t_low   */
    const gvi_real *q, *p;            /* [n] configuration and momentum at t    */
    const gvi_real *q_low, *p_low;    /* [n] compensation: the state is q + q_low */
    gvi_real        h;                /* last step, 0 before the first          */
    gvi_real        t0;               /* time at which the last step began      */
    gvi_fault       fault;
    int             order;            /* u of the rule; 0 for GVI_KICKS         */
    int             iterations;       /* in the last step                       */
    gvi_real        resolution;       /* of the last step that was tried, with desc.resolution:
                                         the largest relative error of a coordinate and its velocity
                                         together, as the curve's modes show it (STEP); the true
                                         error is usually far smaller, rarely 10 times as large */
    gvi_real        next;             /* the length that gvi_advance will try; may be set  */
    gvi_counters    counters;
    struct gvi__private in;
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
    const gvi_real *guess;            /* in: velocity at q0 of a motion near the one wanted;
                                         NULL: the curve near the chord         */
} gvi_discrete;

/* ------------------------------------------------------------- FUNCTIONS */

/* Set-up.  Bytes of memory that desc needs; 0 if its sizes, kinds or callbacks are refused:
   gvi_init, even with a NULL memory, then returns why.  A chain of calls after a failure keeps
   its first status; st.q and st.p then point at zeros, n of them or 64 where there is no memory
   for them.  GVI_LENGTH: array length, a constant expression, that is enough for every scene
   without constraints of n degrees of freedom, degree s, r points.                            */
GVI_DEF size_t     gvi_size(const gvi_desc *desc);
GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size);

/* Start at time t from velocities, momenta, or two configurations: q0 at t and
   q1 at t + h (solves the boundary-value problem; conjugate points: below; no constraints).
   GVI_E_CONSTRAINT where q or v is off a constraint: q by more than 4096 roundings of g, v if the
   part that G v + dg/dt = 0 removes has more than (4096 eps)^2 of the kinetic energy.         */
GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v);
GVI_DEF gvi_status gvi_start_momentum(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p);
GVI_DEF gvi_status gvi_start_configurations(gvi_stepper *st, gvi_real t, gvi_real h,
                                            const gvi_real *q0, const gvi_real *q1);

/* q and v [n], in place, to the nearest that fulfil the constraints that are on, at t, to rounding:
   q such that (q' - q)'M(q' - q) is least, then v likewise, M that there (with Lagrangian terms
   d2L/dv2).  For coordinates from a file; then gvi_start takes them.  moved, or NULL: the lengths
   sqrt(dq'M dq), sqrt(dv'M dv) of what was added to q and v.  The state and the switches stay (last
   places of later steps may not): for a constraint to come, where the state is off it, gvi_init,
   this, gvi_start.  GVI_E_CONVERGENCE: too far off (an effect and row that is left, if any); q and
   v are then as they were.                                                                    */
GVI_DEF gvi_status gvi_project(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v,
                               gvi_real *moved);

/* One step to t + h (with a clock: to tau + h); h < 0 steps back; h may differ from step to step
   (which keeps the map symplectic but not the energy's long-time bound).  Let a step end where a
   force jumps in time.  If what an effect reads through `user` changes between steps, call
   gvi_switch(st, i, 1): the explicit formulation reuses the force at the end of a step.       */
GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h);

/* One step towards t_end, which may be before or after t: as long as desc.resolution allows, but
   never past t_end, and the last one ends on it to the bit:

     while (st.status == GVI_OK && st.t < t_end) gvi_advance(&st, t_end);

   The length is st.next, found at first from short steps, kept while the accuracy stays within
   a band; what is left is divided so that the last step is no shorter than half of it.  A step
   that fails is tried again, shorter, 64 times at most or until t would not move: then its status
   is returned.  With
   a clock the length is in tau, and the step may pass t_end: gvi_state_at has the state there. */
GVI_DEF gvi_status gvi_advance(gvi_stepper *st, gvi_real t_end);

/* Switches effect `index` off (on = 0) or on again, between steps.  An effect that is off is
   not evaluated; the formulation stays that of the whole list.  gvi_start leaves the switches
   as they are.  A constraint can be switched on where the state fulfils it, to rounding:
   GVI_E_CONSTRAINT elsewhere.                                                                 */
GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on);

/* At the present state: velocity (inverse Legendre transform), v[n];
   energy p'v - L, which needs the value of each potential and Lagrangian term that is on. */
GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v);
GVI_DEF gvi_status gvi_energy(gvi_stepper *st, gvi_real *energy);

/* The constraints' multipliers at the present state, one for each row in the order of the list,
   0 where it is off: the force of constraint is G' lambda.  They follow from the acceleration that
   keeps G v + dg/dt = 0, so they are as exact as the state; second derivatives of g are differences
   along v, good to some 100 eps.  Of rows that depend on each other the first ones carry the
   force, the last have 0.                                                     */
GVI_DEF gvi_status gvi_multipliers(gvi_stepper *st, gvi_real *lambda);

/* In the last step; q, v, p of length n, or NULL.  What later steps compute stays the same, to the
   bit.  A broken line has neither curve nor action, a clock no action: GVI_E_FORMULATION.
     gvi_curve      the polynomial at tau in [0,1] and its derivative, error O(h^(min(s,u-s+1)+1))
                    and one order less; with a clock tau is its own time, and v still dq/dt
     gvi_state_at   the state at time t (a time, not tau), at the full order, by a partial step from
                    the nearer end; up to 2 ulp outside the step, t counts as its end
     gvi_action     the quadrature of L; like gvi_state_at with the effects that are on now   */
GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v);
GVI_DEF gvi_status gvi_state_at(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p);
GVI_DEF gvi_status gvi_action(gvi_stepper *st, gvi_real *action);

/* L_d(q0, q1; t, h): boundary values given, rows k >= 1 of (1) solved by Newton's method.
   The curve is the one near the chord, followed from short h; or, with a guess, the one near the
   motion that the guess starts; gvi_start_momentum(st, t, q0, p0) starts it.  If `negative` is
   wanted without a guess, it is whatever Newton's method finds from the chord.  GVI_E_CONJUGATE
   where the ends do not determine the curve (oscillator: h omega = k pi; a half circle about the
   Sun, whose chord goes through it, or past another conjugate point).  Needs GVI_NEWTON, or
   GVI_AUTO with s n <= 1024 and no given iterations, if s > 1; not for kicks, a clock or
   constraints.  Forced systems: d1, d2 are total derivatives, and F-, F+ are
   h sum b_i f_i dQ_i/dq0, dQ_i/dq1 with the curve's own dependence on its ends, as the exact
   discrete forces are [1, sec. 3.2]; how they share p0 and p1 is as exact as the Hessians
   (sqrt(eps), where these are differences), p0 and p1 themselves are exact.  State untouched. */
GVI_DEF gvi_status gvi_discrete_lagrangian(gvi_stepper *st, gvi_real t, gvi_real h,
                                           const gvi_real *q0, const gvi_real *q1,
                                           const gvi_discrete *out);

/* Restart from a checkpoint, a copy of a stepper and of its memory, in a stepper that gvi_init set
   up for the same description, in this process or another.  What follows is the same to the bit.
   GVI_E_ARGUMENT if sizes, the number of effects, what they read together, the kind of mass or the
   formulation differ.  Rules of equally many points are not compared: the saved one is used;
   callbacks, tolerance and limits are those of st.                                            */
GVI_DEF gvi_status gvi_restore(gvi_stepper *st, const gvi_stepper *saved, const gvi_real *memory);

/* In this order: what went wrong in the last call, "ok" if nothing; the same, as far as a status
   alone can say; why st uses its formulation; sizeof(gvi_stepper), for other languages.       */
GVI_DEF const char *gvi_why(const gvi_stepper *st);
GVI_DEF const char *gvi_status_text(gvi_status status);
GVI_DEF const char *gvi_formulation_text(const gvi_stepper *st);
GVI_DEF size_t      gvi_stepper_size(void);

/* Rules on [0,1]:  integral_0^1 f  =  sum_i b[i] f(c[i]).  c ascending, c and b of length n,
   c[i] + c[n-1-i] = 1, relative errors a few eps (tests/test_quadrature.c).  Gauss: n >= 1, exact
   to degree 2n - 1.  Lobatto: n >= 2, c[0] = 0, c[n-1] = 1, exact to degree 2n - 3.           */
GVI_DEF gvi_status gvi_gauss(int n, gvi_real *c, gvi_real *b);
GVI_DEF gvi_status gvi_lobatto(int n, gvi_real *c, gvi_real *b);

/* The measured order of a rule: the largest u such that polynomials of degree < u are integrated
   exactly, to rounding.  0: the weights do not sum to 1.  -1: nodes outside [0,1], not distinct, or
   not finite.  Takes a quarter of a second at n = 250, like n^3, also in gvi_size and gvi_init
   with GVI_OWN.                                                                               */
GVI_DEF int        gvi_rule_order(int n, const gvi_real *c, const gvi_real *b);

/* Barycentric interpolation [6] through n distinct nodes x in any order, at any t: inside, outside,
   at and near a node.
     gvi_barycentric             the weights w, scaled so that max |w| = 1; GVI_E_NODES if two nodes
                                 coincide or the smallest weight leaves the range of gvi_real
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
GVI_DEF void gvi_basis_derivative(int n, const gvi_real *x, const gvi_real *w, gvi_real t,
                                  gvi_real *l);

/* Dense LU with partial pivoting on equilibrated rows [7, ch. 9]:  P A = L U.
     gvi_lu_factor   a: n*n row-major, in: A, out: unit lower L below the diagonal, U on and above;
                     pivot: out, length n + 1: rows pivot[k] and k were exchanged, pivot[n] = |A|.
                     GVI_E_SINGULAR, scale-free: a pivot is nothing but the rounding of the terms
                     that made it; GVI_E_NON_FINITE if an entry is
     gvi_lu_solve    x: length n, in: right-hand side, out: solution
     gvi_lu_rcond    estimate of 1/(|A| |A^-1|), 1-norm [7, sec. 15.3], usually within a factor 3
                     and never below the truth; work of length 2n                              */
GVI_DEF gvi_status gvi_lu_factor(int n, gvi_real *a, gvi_real *pivot);
GVI_DEF void       gvi_lu_solve(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *x);
GVI_DEF gvi_real   gvi_lu_rcond(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *work);

/* Rows are padded to a multiple of 8 from 5 points on, for vector registers.
   Terms: vectors, stage values, mass and Newton; tables; what exceeds n.      */
#define GVI__ROW(r) ((r) < 5 ? (r) : ((r) + 7)/8*8)
#define GVI__SIZE(a) ((size_t)(a))
#define GVI__SLACK (63/sizeof(gvi_real))
#define GVI_LENGTH(n, s, r) (                                                    \
    (42 + 10*GVI__SIZE(s) + 20*GVI__SIZE(GVI__ROW(r))                             \
     + (6 + GVI__SIZE(GVI__ROW(r)) + 2*GVI__SIZE(s)*GVI__SIZE(s))*GVI__SIZE(n))*GVI__SIZE(n) \
    + (22 + 7*GVI__SIZE(r) + 3*GVI__SIZE(s))*GVI__SIZE(GVI__ROW(r))              \
    + (GVI__SIZE(s) + 2)*GVI__SIZE(s) + GVI__SIZE(r) + 5 + GVI__SLACK)

/*  The same with constraints, m rows in all.                                  */
#define GVI_CONSTRAINED_LENGTH(n, s, r, m) (GVI_LENGTH(n, s, r)                  \
    + (6*GVI__SIZE(n) + 3*GVI__SIZE(m) + 2*GVI__SIZE(r) + 5*GVI__SIZE(s) + 4 + (4 + GVI__SIZE(m)) \
       *(GVI__SIZE(n) + GVI__SIZE(m)))*(GVI__SIZE(GVI__ROW(r)) + GVI__SIZE(GVI__ROW((s) + 1)))    \
    + (GVI__SIZE(s) + 3)*(GVI__SIZE(s) + 1) + (2*GVI__SIZE(n) + 9)*GVI__SIZE(m) \
    + (12 + 2*GVI__SIZE(s)*(2*GVI__SIZE(n) + GVI__SIZE(m)))*GVI__SIZE(s)*GVI__SIZE(m))

#ifdef __cplusplus
}
#endif
#endif /* GVI_H */

#if defined(GVI_IMPLEMENTATION) && !defined(GVI_IMPLEMENTED)
#define GVI_IMPLEMENTED

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) \
    || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "gvi.h relies on IEEE arithmetic: compile it without -ffast-math and its parts"
#endif
#if defined(__clang__) && __clang_major__ >= 12      // does not say which parts are on
#pragma clang fp reassociate(off)
#endif

/* NAMES, their usual meaning in what follows:

     st, in        the stepper; its internals, st->in
     from          where a step, or a query's partial step, starts
     at            points that are handed to a callback
     stage         one of the sums that make new stage values (gvi__stage)
     Q V P F A     stage values, rows [n][R]: row i at point k is [i*R + k]
     R, C          length of a row at quadrature points, at constraints' points
     n s r m       degrees of freedom, degree, points, rows of constraints
     i; j, k       a coordinate; points (k also an iteration or a mode)
     e; a, b       an effect, or a source of constraints; rows of constraints
     y, dy         modes of the curve and their correction, [k*n + i]
     z             a right-hand side on the way to a solution
     ..._low       compensation: what rounding took from the name before      */

/* --------------------------------------------------------------- SUPPORT */

#include <float.h>
#include <stdint.h>

#if GVI__KIND == 1
#define GVI__LIMIT(name) FLT_##name
#elif GVI__KIND == 2
#define GVI__LIMIT(name) DBL_##name
#else
#define GVI__LIMIT(name) LDBL_##name
#endif
#define GVI__EPS GVI__LIMIT(EPSILON)
#define GVI__MAX GVI__LIMIT(MAX)
#define GVI__MIN GVI__LIMIT(MIN)
#define GVI__DIG GVI__LIMIT(MANT_DIG)
// amplitudes below this count as 0: in float, forces that cancel leave noise down there
#define GVI__NOTHING (GVI__DIG > FLT_MANT_DIG ? GVI__MIN : GVI__MIN/GVI__EPS)

#ifndef GVI_ABS
#include <math.h>
#define GVI_ABS(x)       GVI__MATH(fabs)(x)
#define GVI_FLOOR(x)     GVI__MATH(floor)(x)
#define GVI_LDEXP(x, e)  GVI__MATH(ldexp)(x, e)
#define GVI_FREXP(x, pe) GVI__MATH(frexp)(x, pe)
#endif

/* What is compiled.  The formulations as bits, all of them where none is named; what is left out
   stands behind a constant 0, so that no compiler keeps it.                                  */
enum {
    GVI__LISTED = 0
#ifdef GVI_ONLY_EXPLICIT
    | 1 << GVI_EXPLICIT
#endif
#ifdef GVI_ONLY_POSITIONS
    | 1 << GVI_POSITIONS
#endif
#ifdef GVI_ONLY_VELOCITIES
    | 1 << GVI_VELOCITIES
#endif
#ifdef GVI_ONLY_MOMENTA
    | 1 << GVI_MOMENTA
#endif
#ifdef GVI_ONLY_NEWTON
    | 1 << GVI_NEWTON
#endif
    , GVI__COMPILED = GVI__LISTED ? GVI__LISTED : (2 << GVI_NEWTON) - 2,
#ifdef GVI_NO_RULES
    GVI__RULES = 0,
#else
    GVI__RULES = 1,
#endif
#ifdef GVI_NO_CLOCK
    GVI__CLOCK = 0,
#else
    GVI__CLOCK = GVI__COMPILED >> GVI_MOMENTA & 1,
#endif
#ifdef GVI_NO_CONSTRAINTS
    GVI__CONSTRAINTS = 0,
#else
    GVI__CONSTRAINTS = GVI__RULES && GVI__COMPILED != 1 << GVI_NEWTON,
#endif
    GVI__EXPLICIT = GVI__COMPILED >> GVI_EXPLICIT & 1,
    GVI__POSITIONS = GVI__COMPILED >> GVI_POSITIONS & 1,
    GVI__VELOCITIES = GVI__COMPILED >> GVI_VELOCITIES & 1,
    GVI__MOMENTA = GVI__COMPILED >> GVI_MOMENTA & 1,
    GVI__NEWTON = GVI__COMPILED >> GVI_NEWTON & 1,
    GVI__READS_V = GVI__VELOCITIES | GVI__MOMENTA | GVI__NEWTON,
    GVI__LAGRANGIAN = GVI__READS_V & GVI__RULES,
    GVI__VARIES = GVI__MOMENTA | GVI__NEWTON | GVI__LAGRANGIAN
};
#if GVI__KIND == 3 && LDBL_MANT_DIG == 106
#error "gvi.h: long double must be one IEEE number, not two doubles"
#endif

typedef char gvi__effects_fit_a_word[GVI_EFFECTS >= 1 && GVI_EFFECTS <= 32
                                     && GVI_EFFECTS <= 8*sizeof(unsigned) ? 1 : -1];

/* GVI__APART: where size counts, never a part of its caller, whose stack stays small.
   GVI__CALLED: never a part of its caller, whose registers are for scenes without it.
   GVI__COLD: set-up and queries, compiled for size.                                          */
#if defined(__GNUC__)
#define GVI__COLD static __attribute__((noinline, cold))
#define GVI__CALLED static __attribute__((noinline))
#else
#define GVI__COLD static
#define GVI__CALLED static
#endif
#if defined(__GNUC__) && defined(__OPTIMIZE_SIZE__)
#define GVI__APART GVI__CALLED
#define GVI__SMALL 1
#else
#define GVI__APART static
#define GVI__SMALL 0
#endif

/* Registers that hold more than one type's digits round twice: values are stored to round them. */
#if FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16
typedef gvi_real gvi__rounded;
#else
typedef volatile gvi_real gvi__rounded;
#endif

/* A lane is GVI__LANES numbers that one instruction handles: as many as a register holds, up to 32
   bytes (wider ones are slower here: callbacks write narrower), or one where the compiler has no
   vectors or code is to be small.                                                            */
#if !defined(__GNUC__) || GVI__KIND == 3 || GVI__SMALL                                          \
    || !(FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 16)                                         \
    || !(defined(__SSE2__) || defined(__ARM_NEON) || defined(__ALTIVEC__)                       \
         || defined(__riscv_vector) || defined(__wasm_simd128__))
#define GVI__LANES 1
#elif defined(__AVX__) && GVI__KIND == 1
#define GVI__LANES 8
#elif defined(__AVX__) || GVI__KIND == 1
#define GVI__LANES 4
#else
#define GVI__LANES 2
#endif
#if GVI__LANES > 1
typedef gvi_real gvi__lane
    __attribute__((vector_size(GVI__LANES*sizeof(gvi_real)), aligned(sizeof(gvi_real)), may_alias));
#define GVI__ENTRY(lane, k) (lane)[k]
#else
typedef gvi_real gvi__lane;
#define GVI__ENTRY(lane, k) (lane)
#endif
#define GVI__LOAD(p) (*(const gvi__lane *)(p))
#define GVI__STORE(p) (*(gvi__lane *)(p))
#define GVI__UNROLL GVI__LOOP(GCC unroll 8)             // a loop's lanes stay in registers with -O2

static int gvi__finite(gvi_real x) { return GVI_ABS(x) <= GVI__MAX; }

// true for every x but 0 and NaN
static int gvi__nonzero(gvi_real x) { return x < 0 || x > 0; }

static gvi_real gvi__smaller(gvi_real a, gvi_real b) { return a < b ? a : b; }
static gvi_real gvi__larger(gvi_real a, gvi_real b) { return a > b ? a : b; }

// the first entry that is not finite, or -1
static int gvi__first_non_finite(int n, const gvi_real *x)
{
    for (int i = 0; i < n; ++i)
        if (!gvi__finite(x[i])) return i;
    return -1;
}

/* GVI__ALONG(n, body): the body for n numbers, GVI__LANES of them at a time and what is left one by
   one; in it GVI__AT(x), GVI__TO(x) to write, are those of x, and gvi__number is their type.    */
#define GVI__AT(x) (*(const gvi__number *)((x) + gvi__at))
#define GVI__TO(x) (*(gvi__number *)((x) + gvi__at))
#define GVI__ALONG(n, ...) GVI__ALONG_BY(, n, __VA_ARGS__)
#define GVI__ALONG_BY(loop, n, ...)                                                             \
    {                                                                                           \
        const int gvi__whole = GVI__LANES > 1 ? (n) - (n) % GVI__LANES : 0;                     \
        int gvi__at = 0;                                                                        \
        loop for (; gvi__at < gvi__whole; gvi__at += GVI__LANES) {                              \
            typedef gvi__lane gvi__number;                                                      \
            __VA_ARGS__;                                                                        \
        }                                                                                       \
        for (; gvi__at < (n); ++gvi__at) {                                                      \
            typedef gvi__rounded gvi__number;                                                   \
            __VA_ARGS__;                                                                        \
        }                                                                                       \
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

// sum_j a_j b_j in four chains, so that no sum waits for another
static gvi_real gvi__dot(int n, const gvi_real *a, const gvi_real *b)
{
    gvi_real s = 0, t = 0, u = 0, v = 0;
    int j = 0;
    for (; j + 3 < n; j += 4) {
        s += a[j]*b[j];
        t += a[j + 1]*b[j + 1];
        u += a[j + 2]*b[j + 2];
        v += a[j + 3]*b[j + 3];
    }
    for (; j < n; ++j) s += a[j]*b[j];
    return (s + u) + (t + v);
}

// sum_i a_i b_i c_i
static gvi_real gvi__dot3(int n, const gvi_real *a, const gvi_real *b, const gvi_real *c)
{
    gvi_real sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i]*b[i]*c[i];
    return sum;
}

// z := y + a x
static void gvi__add_scaled(int n, gvi_real a, const gvi_real *x, const gvi_real *y, gvi_real *z)
{
    GVI__ALONG(n, GVI__TO(z) = GVI__AT(y) + a*GVI__AT(x))
}

/* Double-word arithmetic: an unevaluated sum hi + lo, |lo| <= ulp(hi)/2, carries twice the digits
   of gvi_real (Dekker, Numer. Math. 18, 1971; Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44,
   2017).  Tables are made in it, since the rounding of a coefficient would act in every step in the
   same direction; state and increments carry their low words as compensation.                */
typedef struct gvi__two { gvi_real hi, lo; } gvi__two;

GVI__BODY gvi__two gvi__two_of(gvi_real hi, gvi_real lo)
{
    gvi__two z;
    z.hi = hi;
    z.lo = lo;
    return z;
}

// x + y exactly, whichever is larger (Knuth, The art of computer programming 2, 4.2.2)
GVI__BODY gvi__two gvi__two_sum(gvi_real x, gvi_real y)
{
    gvi__rounded a = x, b = y, hi = a + b, bb = hi - a, aa = hi - bb, da = a - aa, db = b - bb;
    return gvi__two_of(hi, da + db);
}

// (x + x_low) + (y + y_low): what is lost of x + y goes to the low word
GVI__BODY gvi__two gvi__add_low(gvi_real x, gvi_real x_low, gvi_real y, gvi_real y_low)
{
    const gvi__two sum = gvi__two_sum(x, y);
    return gvi__two_of(sum.hi, (x_low + y_low) + sum.lo);
}

/* a b exactly: by one fused multiply-add where it is an instruction (newlib's <math.h> does not say
   so, gcc does; clang, and gcc after a pragma, only by what the processor has).              */
#if defined(__GNUC__) && GVI__KIND < 3                                                            \
    && ((defined(__FMA__) && defined(__SSE2_MATH__)) || defined(__aarch64__)                      \
    || (GVI__KIND == 1 && defined(__FP_FAST_FMAF)) || (GVI__KIND == 2 && defined(__FP_FAST_FMA)))
GVI__BODY gvi__two gvi__two_prod(gvi_real a, gvi_real b)
{
    return gvi__two_of(a*b, GVI__MATH(__builtin_fma)(a, b, -(a*b)));
}
#else
// x = hi + lo of half the digits each, whose products are exact (Veltkamp; Dekker)
GVI__BODY gvi__two gvi__split(gvi_real x)
{
    const gvi_real cut = (gvi_real)(1ULL << (GVI__DIG + 1)/2) + 1;
    gvi__rounded a = x, s = cut*a, d = s - a, hi = s - d, lo = a - hi;
    return gvi__two_of(hi, lo);
}

GVI__BODY gvi__two gvi__two_prod(gvi_real a, gvi_real b)
{
    const gvi__two x = gvi__split(a), y = gvi__split(b);
    const gvi__rounded hi = a*b;
    return gvi__two_of(hi, ((x.hi*y.hi - hi) + x.hi*y.lo + x.lo*y.hi) + x.lo*y.lo);
}
#endif

// the exact product overflows before a*b does: then it has no low word
static gvi_real gvi__low(gvi_real x)
{
    if (!gvi__finite(x)) return 0;
    return x;
}

// a + b to 3 (eps/2)^2 of the sum (Joldes et al., algorithm 6)
static gvi__two gvi__add2(gvi__two a, gvi__two b)
{
    gvi__two s = gvi__two_sum(a.hi, b.hi), t = gvi__two_sum(a.lo, b.lo);
    s = gvi__two_sum(s.hi, s.lo + t.hi);
    return gvi__two_sum(s.hi, s.lo + t.lo);
}

static gvi__two gvi__sub2(gvi__two a, gvi__two b)
{
    return gvi__add2(a, gvi__two_of(-b.hi, -b.lo));
}

// a b, without the product of the low words (Joldes et al., algorithm 10)
static gvi__two gvi__mul2(gvi__two a, gvi__two b)
{
    const gvi__two z = gvi__two_prod(a.hi, b.hi);
    return gvi__two_sum(z.hi, z.lo + (a.hi*b.lo + a.lo*b.hi));
}

static gvi__two gvi__scale2(gvi_real a, gvi__two b) { return gvi__mul2(gvi__two_of(a, 0), b); }

// a/b: one correction of the rounded quotient doubles its digits
static gvi__two gvi__div2(gvi__two a, gvi__two b)
{
    const gvi_real q = a.hi/b.hi;
    const gvi__two rest = gvi__add2(a, gvi__scale2(-q, b));
    return gvi__two_sum(q, rest.hi/b.hi);
}

static gvi__two gvi__div2_by(gvi__two a, int k)
{
    return gvi__div2(a, gvi__two_of((gvi_real)k, 0));
}

// nearest multiple of `unit`, a power of 2: sums of such numbers are exact
static gvi_real gvi__grid(gvi__two a, gvi_real unit)
{
    const gvi_real whole = GVI_FLOOR(a.hi/unit);      // the sum with 1/2 would round once more
    return (whole + GVI_FLOOR((a.hi/unit - whole) + (a.lo/unit + (gvi_real)0.5)))*unit;
}

/* ------------------------------------------------------------ TOLERANCES

   The constants of judgement that decide most; those of one place stand there, with their reason.
   `make tolerances` halves and doubles each, and counts the iterations of fixed runs and the tests
   that then fail.  But for GVI__LEAST, which has to be below 1, none changes the iterations by
   1 %; what each does is in docs/design.md.                                                   */

// rounding, in eps
#define GVI__PLACE ((gvi_real)4)           // of a value: its last places
#define GVI__SOLVED ((gvi_real)16)         // of the terms of a sum that is to be 0
#define GVI__NOISE ((gvi_real)32)          // of the largest amplitude: forces that cancel
#define GVI__GRAIN ((gvi_real)64)          // for each unknown of a linear system: its solution
#define GVI__SURE ((gvi_real)1024)         // more than any rounding: ratios are contraction
#define GVI__HELD ((gvi_real)4096)         // of a constraint's terms: off it where a motion starts

// the change yet to come when an iteration ends, relative; more is a drift of energy
#define GVI__ENOUGH (GVI__EPS/65536)
#define GVI__NEWTON_ENOUGH (GVI__EPS/4096)  // after Newton's change: the next one falls faster

// fixed point: contraction of an iteration; how many in a row say what one cannot
#define GVI__POOR ((gvi_real)0.5)          // it gains less than a bit
#define GVI__SLOW (GVI__DIG/2)             // to rounding by less than 2 bits: errors grew first
#define GVI__FAR ((gvi_real)0.25)          // of the motion, a change: the units are an overshoot's
#define GVI__LEAST ((gvi_real)0.9)         // of the least change so far: a new one
#define GVI__FEW_POOR 2                    // iterations that are poor: diverges
#define GVI__MANY_POOR 4                   // the same while changes are far: a cosine's terms grow
#define GVI__STAGNANT 4                    // iterations without a new least: rounding
#define GVI__STILL 3                       // iterations without less noise: that is its level
#define GVI__NEARER 6                      // halvings, where a domain or Newton's residual wants it
#define GVI__BY_NEWTON 64                  // steps until the fixed point is tried again

// predictor: how many last steps, ahead or back, an extrapolation is still better than nothing
#define GVI__AHEAD 8
#define GVI__BACK 2
#define GVI__SEEN ((gvi_real)0.015625)     // coupling of a polynomial that its nodes see

// Newton's method: contraction
#define GVI__CONTRACTS ((gvi_real)0.25)    // keeps its matrix; a curve is near
#define GVI__LINEAR ((gvi_real)0.015625)   // the equations are all but linear
#define GVI__CLOSE ((gvi_real)0.03125)     // of a curve, from its prediction: on the same branch
#define GVI__SHORT 64                      // h over this: free motion leads to the motion
#define GVI__LOST 4                        // of a pivot's entry what is left: rank may be changing
#define GVI__WRONG 512                     // of a move, what g misses times this: G is wrong

// the dial, in rungs, four an octave
#define GVI__BAND 4                        // room at which h stays; and the most that it grows
#define GVI__FALL 8                        // the most that it shrinks, and after a failure
#define GVI__RESTS 4096                    // times slower than the fastest: judged with it
#define GVI__PULLED 64                     // eps of the motion: rounding of forces of constraint
#define GVI__DEEP (GVI__DIG/2)             // degree whose modes reach rounding

/* -------------------------------------------------------- LINEAR ALGEBRA */

// pivot[0..n-1]: row scales 1/max_j |a_ij|; pivot[n]: 1-norm of A
GVI__COLD gvi_status gvi__lu_scales(int n, const gvi_real *a, gvi_real *pivot, int *at)
{
    gvi_status status = GVI_OK;
    const size_t N = (size_t)n;
    for (size_t i = 0; i < N; ++i) {
        gvi_real big = 0;
        for (size_t j = 0; j < N; ++j) {
            const gvi_real x = GVI_ABS(a[i*N + j]);
            if (!(x <= GVI__MAX)) return GVI_E_NON_FINITE;
            if (x > big) big = x;
        }
        if (big > 0) {
            pivot[i] = 1/big;
            if (!gvi__finite(pivot[i])) pivot[i] = GVI__MAX;      // subnormal row
        } else {
            pivot[i] = 0;
            status = GVI_E_SINGULAR;
            *at = (int)i;
        }
    }
    pivot[n] = 0;
    for (size_t j = 0; j < N; ++j) {
        gvi_real sum = 0;
        for (size_t i = 0; i < N; ++i) sum += GVI_ABS(a[i*N + j]);
        if (sum > pivot[n]) pivot[n] = sum;
    }
    return status;
}

// row -= a top, `count` numbers, a being `width` numbers: one for each, or one for all
GVI__BODY void gvi__subtract_at(int width, int count, const gvi_real *GVI__RESTRICT a,
                                const gvi_real *GVI__RESTRICT top, gvi_real *GVI__RESTRICT row)
{
    if (width > 1) GVI__ALONG(count, GVI__TO(row) = GVI__AT(row) - GVI__AT(a)*GVI__AT(top))
    else GVI__ALONG(count, GVI__TO(row) = GVI__AT(row) - a[0]*GVI__AT(top))
}

static void gvi__subtract_row(size_t count, gvi_real l, const gvi_real *top, gvi_real *row)
{
    gvi__subtract_at(1, (int)count, &l, top, row);
}

// at: the row of zeros or the column at which elimination ended, if A is singular
static gvi_status gvi__lu_factor(int n, gvi_real *a, gvi_real *pivot, int *at)
{
    const size_t N = (size_t)n;
    *at = -1;
    const gvi_status status = gvi__lu_scales(n, a, pivot, at);
    if (status != GVI_OK) return status;

    for (size_t k = 0; k < N; ++k) {
        // find pivot: largest in column k, each row measured by its own scale
        size_t m = k;
        gvi_real big = -1;
        for (size_t i = k; i < N; ++i) {
            const gvi_real x = GVI_ABS(a[i*N + k])*pivot[i];
            if (x > big) {
                big = x;
                m = i;
            }
        }

        // swap rows k and m, all columns; the scale of row k moves along
        if (m != k)
            for (size_t j = 0; j < N; ++j) gvi__swap(a + k*N + j, a + m*N + j);
        pivot[m] = pivot[k];
        pivot[k] = (gvi_real)m;

        // check singularity: of the terms that made this pivot only their rounding,
        // n eps |L||U|, is left [7, thm. 9.3]
        gvi_real terms = 0;
        for (size_t j = 0; j < k; ++j) terms += GVI_ABS(a[k*N + j]*a[j*N + k]);
        if (!(GVI_ABS(a[k*N + k]) > (gvi_real)n*GVI__EPS*terms)) {
            *at = (int)k;
            return GVI_E_SINGULAR;
        }

        // eliminate column k from the rows below
        for (size_t i = k + 1; i < N; ++i) {
            gvi_real *row = a + i*N + k;
            row[0] /= a[k*N + k];
            if (gvi__nonzero(row[0]))
                gvi__subtract_row(N - k - 1, row[0], a + k*N + k + 1, row + 1);
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
    const size_t N = (size_t)n;

    // x = P x, then forward substitution: solve L*y = x
    for (size_t k = 0; k < N; ++k) gvi__swap(x + k, x + (size_t)pivot[k]);
    for (int i = 1; i < n; ++i) x[i] -= gvi__dot(i, lu + (size_t)i*N, x);

    // back substitution: solve U*x = y
    for (int i = n; i-- > 0; ) {
        const gvi_real *row = lu + (size_t)i*N + i;
        x[i] = (x[i] - gvi__dot(n - 1 - i, row + 1, x + i + 1))/row[0];
    }
}

// solves A' x = b: U'*y = b, L'*z = y, x = P' z; rows are used as columns
GVI__COLD void gvi__lu_solve_transposed(int n, const gvi_real *lu, const gvi_real *pivot,
                                        gvi_real *x)
{
    const size_t N = (size_t)n;
    for (size_t i = 0; i < N; ++i) {
        x[i] /= lu[i*N + i];
        gvi__subtract_row(N - i - 1, x[i], lu + i*N + i + 1, x + i + 1);
    }
    for (size_t i = N; i-- > 0; ) gvi__subtract_row(i, x[i], lu + i*N, x);
    for (size_t k = N; k-- > 0; ) gvi__swap(x + k, x + (size_t)pivot[k]);
}

static gvi_real gvi__norm1(int n, const gvi_real *x)
{
    gvi_real sum = 0;
    for (int i = 0; i < n; ++i) sum += GVI_ABS(x[i]);
    return sum;
}

GVI_DEF gvi_real gvi_lu_rcond(int n, const gvi_real *lu, const gvi_real *pivot, gvi_real *work)
{
    gvi_real *x = work, *z = work + n, best = 0;

    // climb |A^-1 x| over the corners of |x| = 1, at most 5 of them
    for (int i = 0; i < n; ++i) x[i] = 1/(gvi_real)n;
    for (int step = 0, corner = -1; step < 5; ++step) {
        gvi_lu_solve(n, lu, pivot, x);
        const gvi_real norm = gvi__norm1(n, x);
        int next = 0;
        if (norm > best) best = norm;
        else if (step > 0) break;
        for (int i = 0; i < n; ++i) {
            z[i] = 1;
            if (x[i] < 0) z[i] = -1;
        }
        gvi__lu_solve_transposed(n, lu, pivot, z);
        for (int i = 1; i < n; ++i)
            if (GVI_ABS(z[i]) > GVI_ABS(z[next])) next = i;
        if (next == corner) break;
        corner = next;
        gvi__zero((size_t)n, x);
        x[next] = 1;
    }

    // a vector of alternating signs, 1 to 2 in size, catches what the climb may miss
    gvi_real sign = 1;
    x[0] = 1;
    for (int i = 1; i < n; ++i) {
        sign = -sign;
        x[i] = sign*(1 + (gvi_real)i/(gvi_real)(n - 1));
    }
    gvi_lu_solve(n, lu, pivot, x);
    best = gvi__larger(best, 2*gvi__norm1(n, x)/(3*(gvi_real)n));
    if (!(best > 0)) return 0;
    return 1/best/pivot[n];
}

/* L D L' of a symmetric matrix at each of `count` points, in place: entry (i,j), i >= j, of point k
   at [(i*n + j)*R + k].  L goes below the diagonal, 1/D on it, and D L' above it, where the rest of
   the matrix is made.  A pivot that is nothing but the rounding of its diagonal entry, n eps of
   it, belongs to a coordinate without mass: GVI_E_SINGULAR, at[0] the coordinate and at[1] the
   point.                                                                                      */
static gvi_status gvi__ldl_factor(int n, int R, int count, gvi_real *m, int *at)
{
    const size_t N = (size_t)n, S = (size_t)R;
    const gvi_real least = (gvi_real)n*GVI__EPS;
    for (size_t j = 0; j < N; ++j) {
        gvi_real *d = m + (j*N + j)*S;
        for (int k = 0; k < count; ++k) {
            const gvi_real was = GVI_ABS(d[k]);
            gvi_real rest = d[k];
            for (size_t l = 0; l < j; ++l)
                rest -= m[(j*N + l)*S + (size_t)k]*m[(l*N + j)*S + (size_t)k];
            d[k] = 1/rest;
            at[0] = (int)j;
            at[1] = k;
            if (!(was <= GVI__MAX) || !gvi__finite(rest)) return GVI_E_NON_FINITE;
            if (!(GVI_ABS(rest) > least*was) || !gvi__finite(d[k]))
                return GVI_E_SINGULAR;
        }
        for (size_t i = j + 1; i < N; ++i) {
            gvi_real *a = m + (i*N + j)*S, *b = m + (j*N + i)*S;
            for (size_t l = 0; l < j; ++l)
                gvi__subtract_at(R, count, m + (j*N + l)*S, m + (l*N + i)*S, a);
            for (int k = 0; k < count; ++k) {
                b[k] = a[k];
                a[k] *= d[k];
            }
        }
    }
    return GVI_OK;
}

// rows z [n][R] := M^-1 z; an entry of the matrix is `width` numbers
static void gvi__ldl_solve(int n, const gvi_real *m, int width, gvi_real *z, int R, int count)
{
    const size_t w = (size_t)width, N = (size_t)n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j)
            gvi__subtract_at(width, count, m + ((size_t)i*N + (size_t)j)*w, z + j*R, z + i*R);
    for (int i = n; i-- > 0; ) {
        const gvi_real *d = m + (size_t)i*(N + 1)*w;
        gvi_real *row = z + i*R;
        if (width > 1) for (int k = 0; k < count; ++k) row[k] *= d[k];
        else GVI__ALONG(count, GVI__TO(row) = GVI__AT(row)*d[0])
        for (int j = i + 1; j < n; ++j)
            gvi__subtract_at(width, count, m + ((size_t)j*N + (size_t)i)*w, z + j*R, z + i*R);
    }
}

/* The same for whole lanes of points.  Returns whether all pivots D are sure: the squares of
   (diagonal entry before elimination)/D, and of what rounding leaves of D/D - 1, add up to less
   than 1/(n eps)^2.  Otherwise gvi__ldl_factor has to decide, from the matrix made anew.     */
GVI__BODY int gvi__ldl_factor_lane(int n, int R, gvi_real *m)
{
    const size_t N = (size_t)n, S = (size_t)R;
    const gvi_real most = 1/((gvi_real)n*GVI__EPS);
    gvi__lane sum = { 0 };
    gvi_real all = 0;
    for (size_t j = 0; j < N; ++j) {
        gvi_real *d = m + (j*N + j)*S;
        gvi__lane rest = GVI__LOAD(d);
        for (size_t l = 0; l < j; ++l)
            rest -= GVI__LOAD(m + (j*N + l)*S)*GVI__LOAD(m + (l*N + j)*S);
        const gvi__lane inverse = 1/rest, loss = GVI__LOAD(d)*inverse, off = rest*inverse - 1;
        sum += loss*loss + off*off;
        GVI__STORE(d) = inverse;
        for (size_t i = j + 1; i < N; ++i) {
            gvi_real *a = m + (i*N + j)*S;
            rest = GVI__LOAD(a);
            for (size_t l = 0; l < j; ++l)
                rest -= GVI__LOAD(m + (j*N + l)*S)*GVI__LOAD(m + (l*N + i)*S);
            GVI__STORE(m + (j*N + i)*S) = rest;
            GVI__STORE(a) = rest*inverse;
        }
    }
    for (int k = 0; k < GVI__LANES; ++k) all += GVI__ENTRY(sum, k);
    return all < most*most;
}

// z := M^-1 from, which may be z
GVI__BODY void gvi__ldl_solve_lane(int n, int R, const gvi_real *m, const gvi_real *from,
                                   gvi_real *z)
{
    const size_t N = (size_t)n, S = (size_t)R;
    for (size_t i = 0; i < N; ++i) {
        gvi__lane rest = GVI__LOAD(from + i*S);
        for (size_t j = 0; j < i; ++j) rest -= GVI__LOAD(m + (i*N + j)*S)*GVI__LOAD(z + j*S);
        GVI__STORE(z + i*S) = rest;
    }
    for (size_t i = N; i-- > 0; ) {
        gvi__lane rest = GVI__LOAD(z + i*S)*GVI__LOAD(m + (i*N + i)*S);
        for (size_t j = i + 1; j < N; ++j) rest -= GVI__LOAD(m + (j*N + i)*S)*GVI__LOAD(z + j*S);
        GVI__STORE(z + i*S) = rest;
    }
}

/* ------------------------------------------------------------ QUADRATURE */

/* Legendre polynomials by (k+1) P_(k+1) = (2k+1) x P_k - k P_(k-1), always at x = 1 - 2c for c in
   [0,1]: P_k and P_(k-1) become P_(k+1) and P_k.                                             */
static void gvi__legendre(int k, gvi_real x, gvi_real *P, gvi_real *before)
{
    const gvi_real was = *P;
    *P = ((gvi_real)(2*k + 1)*x*was - (gvi_real)k**before)/(gvi_real)(k + 1);
    *before = was;
}

// the same in double-word arithmetic
GVI__COLD void gvi__legendre2(int k, gvi__two x, gvi__two *P, gvi__two *before)
{
    const gvi__two was = *P, next = gvi__scale2((gvi_real)(2*k + 1), gvi__mul2(x, was));
    *P = gvi__div2_by(gvi__add2(next, gvi__scale2(-(gvi_real)k, *before)), k + 1);
    *before = was;
}

// x = 1 - 2c
static gvi__two gvi__argument2(gvi__two c)
{
    return gvi__sub2(gvi__two_of(1, 0), gvi__two_of(2*c.hi, 2*c.lo));
}

/* Newton's correction of node c on [0,1], and the weight that belongs to c.  With m = n for Gauss,
   n - 1 for Lobatto, P = P_m and d = P_(m-1) - x P_m,

     (1 - x^2) P_m' = m d          ((1 - x^2) P_m')' = -m (m+1) P_m

     Gauss     P_m = 0     c += P_m 2c(1-c) / (m d)    b = 4c(1-c) / (m d)^2
     Lobatto   P_m' = 0    c -= d / (2(m+1) P_m)       b = 1 / (m (m+1) P_m^2)                */
GVI__COLD gvi__two gvi__node_correction(int lobatto, int m, gvi__two c, gvi_real *b)
{
    const gvi__two x = gvi__argument2(c), one = gvi__two_of(1, 0);
    gvi__two P = one, d = gvi__two_of(0, 0);
    for (int k = 0; k < m; ++k) gvi__legendre2(k, x, &P, &d);
    d = gvi__sub2(d, gvi__mul2(x, P));
    if (lobatto) {
        P = gvi__div2(one, P);
        *b = gvi__div2_by(gvi__div2_by(gvi__mul2(P, P), m), m + 1).hi;
        return gvi__div2_by(gvi__mul2(d, P), -2*(m + 1));
    }
    d = gvi__scale2((gvi_real)m, d);
    c = gvi__div2(gvi__mul2(c, gvi__sub2(one, c)), d);
    *b = 4*gvi__div2(c, d).hi;
    c = gvi__mul2(P, c);
    return gvi__two_of(2*c.hi, 2*c.lo);
}

/* Where Newton's method for node j of the lower half starts, c = (1 - cos theta)/2 =
   sin^2(theta/2): Gauss theta = pi (4j+3)/(4m+2), Lobatto from the zeros of J_1.  Both are well
   within its quadratic range, and the series of the sine is good to 3e-7.                     */
static gvi_real gvi__node_guess(int lobatto, int m, int j)
{
    const gvi_real pi = (gvi_real)3.14159265358979323846L;
    const gvi_real k = (gvi_real)m;
    gvi_real theta = pi*((gvi_real)j + (gvi_real)0.75)/(k + (gvi_real)0.5);
    if (lobatto) {
        const gvi_real a = (gvi_real)j + (gvi_real)0.25;
        theta = pi*a/k - 3/(8*pi*k*a);
    }
    const gvi_real y = theta*theta/4, sine = theta/2*(1 - y/6*(1 - y/20*(1 - y/42)));
    return sine*sine;
}

/* Nodes and weights; c_low, if given, gets the low words of c.  Nodes are symmetric about 1/2: one
   half is computed.  After a correction below eps the next one would be below its square: c is then
   accurate relative to itself, even next to the end of the interval.                         */
GVI__COLD gvi_status gvi__rule(int lobatto, int n, gvi_real *c, gvi_real *c_low, gvi_real *b)
{
    if (n < 1 + lobatto || !c || !b) return GVI_E_ARGUMENT;
    const int m = n - lobatto;
    for (int j = 0; 2*j < n; ++j) {
        gvi_real start = 0, last = 0;                  // Lobatto's first node is 0, known exactly
        if (2*j + 1 == n) start = (gvi_real)0.5;       // and so is the middle
        else if (j > 0 || !lobatto) {
            start = gvi__node_guess(lobatto, m, j);
            last = 1;
        }
        gvi__two x = gvi__two_of(start, 0);
        for (int k = 0; k < 12; ++k) {
            const gvi__two dx = gvi__node_correction(lobatto, m, x, b + j);
            if (!(last > GVI__EPS*x.hi)) break;
            x = gvi__add2(x, dx);
            last = GVI_ABS(dx.hi);
        }
        const gvi__two mirror = gvi__sub2(gvi__two_of(1, 0), x);
        c[j] = x.hi;
        c[n - 1 - j] = mirror.hi;
        b[n - 1 - j] = b[j];
        if (!c_low) continue;
        c_low[j] = x.lo;
        c_low[n - 1 - j] = mirror.lo;
    }
    return GVI_OK;
}

GVI_DEF gvi_status gvi_gauss(int n, gvi_real *c, gvi_real *b)
{
    return gvi__rule(0, n, c, NULL, b);
}

GVI_DEF gvi_status gvi_lobatto(int n, gvi_real *c, gvi_real *b)
{
    return gvi__rule(1, n, c, NULL, b);
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
    gvi_real sum = -1;
    for (int u = 0; u < 2*n; ++u) {
        for (int i = 0; i < n; ++i) {
            gvi_real P = 1, before = 0;
            for (int k = 0; k < u; ++k) gvi__legendre(k, 1 - 2*c[i], &P, &before);
            sum += b[i]*P;
        }
        if (GVI_ABS(sum) > 4*(gvi_real)(u + 2)*GVI__EPS*size) return u;
        sum = 0;
    }
    return 2*n;
}

/* --------------------------------------------------------- INTERPOLATION */

/* w_j = 1/prod_(k != j) (x_j - x_k), common factors left out.  The product is
   kept as mantissa and exponent: it leaves the range of double at n = 1000.   */
GVI_DEF gvi_status gvi_barycentric(int n, const gvi_real *x, gvi_real *w)
{
    if (n < 1 || !x || !w || gvi__first_non_finite(n, x) >= 0) return GVI_E_ARGUMENT;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j)
            if (!gvi__nonzero(x[i] - x[j])) return GVI_E_NODES;

    // twice over: first the smallest exponent, then the weights scaled by it
    int least = 0;
    gvi_real big = 0;
    for (int pass = 0; pass < 2; ++pass)
        for (int j = 0; j < n; ++j) {
            gvi_real mantissa = 1;
            int exponent = 0, e, f;
            for (int k = 0; k < n; ++k)
                if (k != j) {
                    const gvi_real factor = GVI_FREXP(x[j] - x[k], &e);
                    mantissa = GVI_FREXP(mantissa*factor, &f);
                    exponent += e + f;
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

/* l_j(t) = (w_j/(t - x_j)) / sum_k w_k/(t - x_k).  Both sides multiplied by the
   distance d to the nearest node i, so that t = x_i is no exception; and the
   sum, which may cancel, by what it is equal to: w_i prod_(k != i)
   (x_i - x_k)/(t - x_k), factors in (0,2] [6, sec. 3, the first form].  Returns i. */
static int gvi__term(int n, const gvi_real *x, const gvi_real *w, gvi_real t, gvi_real *d,
                     gvi_real *sum)
{
    int i = 0;
    for (int j = 1; j < n; ++j)
        if (GVI_ABS(t - x[j]) < GVI_ABS(t - x[i])) i = j;
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
    for (int j = 0; j < n; ++j)
        if (j != i) l[j] = w[j]*(d/(t - x[j]))/sum;
    l[i] = w[i]/sum;
}

GVI_DEF gvi_real gvi_interpolate(int n, const gvi_real *x, const gvi_real *w, const gvi_real *f,
                                 gvi_real t)
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

GVI_DEF void gvi_basis_derivative(int n, const gvi_real *x, const gvi_real *w, gvi_real t,
                                  gvi_real *l)
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

/* Facts about a scene, found once by gvi_init, as bits: gvi__has(in, fact).  The first five are all
   that the formulations differ in.                                                            */
enum {
    GVI__ITERATES    = 1,         /* has stage values and tables; otherwise kicks and drifts  */
    GVI__FIXED_POINT = 2,         /* finds the stage values by (3) to (5); Newton's does not  */
    GVI__BY_FORCES   = 4,         /* has no V: the forces alone make the curve                */
    GVI__TWO_STAGES  = 8,         /* Q and V by (3) and (4), or P and Q by (5)                */
    GVI__BY_MOMENTA  = 16,        /* V from P = dL/dv, (5)                                    */

    GVI__OF_EXPLICIT   = GVI__BY_FORCES,
    GVI__OF_POSITIONS  = GVI__ITERATES | GVI__FIXED_POINT | GVI__BY_FORCES,
    GVI__OF_VELOCITIES = GVI__ITERATES | GVI__FIXED_POINT | GVI__TWO_STAGES,
    GVI__OF_MOMENTA    = GVI__ITERATES | GVI__FIXED_POINT | GVI__TWO_STAGES | GVI__BY_MOMENTA,
    GVI__OF_NEWTON     = GVI__ITERATES,

    GVI__HAS_VELOCITIES = 32,     /* an effect reads v                                        */
    GVI__HAS_LAGRANGIAN = 64,     /* an effect adds to dL/dv                                  */
    GVI__HAS_NEWTON     = 128,    /* Newton's method is used, or ready as the fall-back       */
    GVI__HAS_GAMMA      = 256,    /* Gamma is a full matrix                                   */

    // what is true of a formulation that is compiled; what is false of one
    GVI__POSSIBLE = GVI__EXPLICIT*GVI__OF_EXPLICIT | GVI__POSITIONS*GVI__OF_POSITIONS
                  | GVI__VELOCITIES*GVI__OF_VELOCITIES | GVI__MOMENTA*GVI__OF_MOMENTA
                  | GVI__NEWTON*(GVI__OF_NEWTON | GVI__HAS_NEWTON)
                  | GVI__LAGRANGIAN*GVI__HAS_LAGRANGIAN
                  | GVI__RULES*GVI__HAS_GAMMA,
    GVI__DOUBTFUL = GVI__EXPLICIT*~GVI__OF_EXPLICIT | GVI__POSITIONS*~GVI__OF_POSITIONS
                  | GVI__VELOCITIES*~GVI__OF_VELOCITIES | GVI__MOMENTA*~GVI__OF_MOMENTA
                  | GVI__NEWTON*~GVI__OF_NEWTON
};

// a constant where all formulations that are compiled agree
GVI__BODY int gvi__has(const struct gvi__private *in, int fact)
{
    return (fact & GVI__POSSIBLE & (in->facts | ~GVI__DOUBTFUL)) != 0;
}

GVI__BODY int gvi__mass_is(const struct gvi__private *in, gvi_mass_kind kind)
{
    if (kind == GVI_MASS_NONE && !GVI__LAGRANGIAN) return 0;
    if (kind == GVI_MASS_POSITION && !GVI__VARIES) return 0;
    return in->desc.mass.kind == kind;
}

GVI__BODY int gvi__mass_is_constant(const struct gvi__private *in)
{
    return GVI__VARIES == 0 || in->desc.mass.kind <= GVI_MASS_DENSE;
}

GVI__BODY int gvi__rule_is(const struct gvi__private *in, gvi_rule_kind kind)
{
    return (kind != GVI_OWN || GVI__RULES > 0) && (kind != GVI_KICKS || GVI__EXPLICIT > 0)
           && in->desc.rule.kind == kind;
}

// does M^-1 couple all coordinates?
static int gvi__full_mass(const struct gvi__private *in)
{
    return in->desc.mass.kind == GVI_MASS_DENSE || !gvi__mass_is_constant(in)
           || gvi__has(in, GVI__HAS_LAGRANGIAN);
}

// is a constraint on?
GVI__BODY int gvi__constrained(const gvi_stepper *st)
{
    return GVI__CONSTRAINTS && st->in.con.m > 0;
}

static int gvi__clock_is_on(const gvi_stepper *st)
{
    return GVI__CLOCK && st->in.clock >= 0 && !(st->in.off >> st->in.clock & 1u);
}

/* Status and fault of a call.  gvi__report_effect: an effect or the mass is at fault, but no
   one coordinate or point; gvi__report_status: none of them.                                  */
static gvi_status gvi__report(gvi_stepper *st, gvi_status status, int effect, int coordinate,
                              int point)
{
    const gvi_fault fault = { effect, coordinate, point, NULL };
    st->fault = fault;
    return st->status = status;
}

// an argument is at fault: a row of effects or the mass, a coordinate, and a sentence
static gvi_status gvi__refuse(gvi_fault *fault, int effect, int coordinate, const char *argument)
{
    const gvi_fault found = { effect, coordinate, GVI_FAULT_NONE, argument };
    *fault = found;
    return GVI_E_ARGUMENT;
}

// constraints are there, on or off, and cannot be: the fault is the first of them
GVI__COLD gvi_status gvi__refuse_constraints(gvi_stepper *st)
{
    int e = 0;
    while (!(st->in.con.bits >> e & 1u)) ++e;
    return gvi__report(st, GVI_E_FORMULATION, e, 0, GVI_FAULT_NONE);
}

GVI__APART gvi_status gvi__report_effect(gvi_stepper *st, gvi_status status, int effect)
{
    return gvi__report(st, status, effect, GVI_FAULT_NONE, GVI_FAULT_NONE);
}

GVI__APART gvi_status gvi__report_status(gvi_stepper *st, gvi_status status)
{
    return gvi__report(st, status, GVI_FAULT_NONE, GVI_FAULT_NONE, GVI_FAULT_NONE);
}

// the end of a call; a step that failed stays in sight
static gvi_status gvi__done(gvi_stepper *st, gvi_status status)
{
    if (status == GVI_OK) gvi__report_status(st, GVI_OK);
    st->status = status;
    if (st->in.failed.status != GVI_OK) {
        st->status = st->in.failed.status;
        st->fault = st->in.failed.fault;
    }
    return status;
}

static gvi_status gvi__refuse_call(gvi_stepper *st, const char *argument)
{
    return gvi__done(st, gvi__refuse(&st->fault, GVI_FAULT_NONE, GVI_FAULT_NONE, argument));
}

// a callback returned `failed`
GVI__COLD gvi_status gvi__report_callback(gvi_stepper *st, int failed, int effect)
{
    gvi__report_effect(st, GVI_E_CALLBACK, effect);
    if (failed == GVI__MISSING)
        st->fault.argument = "GVI_POINTS lists what this kind does not have, as v: is .kind set?";
    return GVI_E_CALLBACK;
}

// may a call go on?  A chain of calls to a stepper that is not ready keeps its first failure
static gvi_status gvi__ready(gvi_stepper *st, int ready)
{
    if (!st) return GVI_E_ARGUMENT;
    if (ready) return gvi__report_status(st, GVI_OK);
    if (st->status == GVI_OK) return gvi__report_status(st, GVI_E_STATE);
    return st->status;
}

static void gvi__count(unsigned long long *counter, int more)
{
    *counter += (unsigned long long)more;
}

// the bits of all effects of a kind
static unsigned gvi__of_kind(const struct gvi__private *in, gvi_kind kind)
{
    unsigned bits = 0;
    for (int e = 0; e < in->desc.effect_count; ++e)
        if (in->desc.effects[e].kind == kind) bits |= 1u << e;
    return bits;
}

// `count` points at q, to which f and dldv are added; v, value and the like are set by the caller
static gvi_points gvi__points_at(const gvi_stepper *st, int count, int R, const gvi_real *t,
                                 const gvi_real *q, gvi_real *f, gvi_real *dldv)
{
    const gvi_points at = { st->n, count, R,    t,    q,    NULL, NULL, f,
                           dldv,  NULL,  NULL, NULL, NULL, NULL, NULL };
    return at;
}

// one point, f and dldv in scratch
static gvi_points gvi__one_point(const gvi_stepper *st, const gvi_real *t, const gvi_real *q)
{
    gvi_real *f = st->in.point + 4*st->n;
    return gvi__points_at(st, 1, 1, t, q, f, f + st->n);
}

// a column of rows [n][R]
static void gvi__gather(int n, int R, const gvi_real *rows, gvi_real *out)
{
    for (; n > 0; --n, rows += R) *out++ = *rows;
}

// the first entry of rows [n][count] that is not finite is the fault
static gvi_status gvi__check_rows(gvi_stepper *st, const gvi_points *at, const gvi_real *rows,
                                  int effect)
{
    if (!rows) return GVI_OK;
    for (int i = 0; i < at->n; ++i) {
        const int k = gvi__first_non_finite(at->count, rows + i*at->stride);
        if (k >= 0) return gvi__report(st, GVI_E_NON_FINITE, effect, i, k);
    }
    return GVI_OK;
}

// the value callback of effect e, added to `value`
static gvi_status gvi__value(gvi_stepper *st, gvi_points *x, int e, gvi_real *value)
{
    const gvi_effect *effect = st->in.desc.effects + e;
    gvi_points at = *x;
    if (!effect->value) return gvi__report_effect(st, GVI_E_VALUE, e);
    if (effect->kind == GVI_POTENTIAL) at.v = NULL;
    at.f = at.dldv = NULL;
    at.value = value;
    const int failed = effect->value(&at, effect->user);
    if (failed) return gvi__report_callback(st, failed, e);
    return GVI_OK;
}

// the one-point form: gather, call, scatter.  Returns 0, or 1 + the point whose callback failed
static int gvi__point_by_point(gvi_stepper *st, const gvi_effect *e, const gvi_points *at)
{
    const int n = at->n;
    gvi_real *q = st->in.point, *v = NULL, *f = q + 2*n, *dldv = NULL;
    if (at->v) v = q + n;
    if (at->dldv) dldv = f + n;
    for (int k = 0; k < at->count; ++k) {
        gvi__gather(n, at->stride, at->q + k, q);
        if (v) gvi__gather(n, at->stride, at->v + k, v);
        gvi__zero(2*(size_t)n, f);
        if (e->point(at->t[k], q, v, f, dldv, e->user)) return 1 + k;
        for (int i = 0; i < n; ++i) {
            at->f[i*at->stride + k] += f[i];
            if (dldv) at->dldv[i*at->stride + k] += dldv[i];
        }
    }
    return 0;
}

/* One effect at all points; it sees only what its kind may read.  `value`, if not NULL, gets V
   or L, in the same call where one function gives both.                                       */
GVI__BODY gvi_status gvi__effect(gvi_stepper *st, gvi_points *at, int e, gvi_real *value)
{
    const gvi_effect *effect = st->in.desc.effects + e;
    const gvi_real *v = at->v;
    gvi_real *dldv = at->dldv;
    const int both = value && effect->points && effect->value == effect->points;
    int failed;
    if (!GVI__READS_V || effect->kind == GVI_POTENTIAL) at->v = NULL;
    if (!GVI__LAGRANGIAN || effect->kind != GVI_LAGRANGIAN) at->dldv = NULL;
    if (both) at->value = value;
    gvi__count(&st->counters.effect[e], at->count);
    if (effect->points) failed = effect->points(at, effect->user);
    else failed = gvi__point_by_point(st, effect, at);
    at->value = NULL;
    at->v = v;
    at->dldv = dldv;
    if (failed && effect->points) return gvi__report_callback(st, failed, e);
    if (failed) return gvi__report(st, GVI_E_CALLBACK, e, GVI_FAULT_NONE, failed - 1);
    if (!value || both) return GVI_OK;
    return gvi__value(st, at, e, value);
}

// what an effect, no force, adds its value to, with a clock, which needs V (level) and L; else NULL
static gvi_real *gvi__value_row(const gvi_stepper *st, int e, gvi_real *level)
{
    if (level && st->in.desc.effects[e].kind == GVI_LAGRANGIAN) return st->in.time.lagrangian;
    return level;
}

// in the repetition of a step that came to NaN or Inf: each effect alone, which gave it?
GVI__COLD gvi_status gvi__diagnose(gvi_stepper *st, gvi_points *at, unsigned skip, gvi_real *level)
{
    const size_t length = (size_t)at->n*(size_t)at->stride;
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        gvi_real *value = gvi__value_row(st, e, level);
        if (skip >> e & 1u) continue;
        gvi__zero(length, at->f);
        if (at->dldv) gvi__zero(length, at->dldv);
        if (value) gvi__zero((size_t)at->stride, value);
        gvi_status status = gvi__effect(st, at, e, value);
        // to look at it is no step's work
        st->counters.effect[e] -= (unsigned long long)at->count;
        if (status == GVI_OK) status = gvi__check_rows(st, at, at->f, e);
        if (status == GVI_OK) status = gvi__check_rows(st, at, at->dldv, e);
        if (status != GVI_OK) return status;
        if (!value) continue;
        const int k = gvi__first_non_finite(at->count, value);
        if (k >= 0) return gvi__report(st, GVI_E_NON_FINITE, e, GVI_FAULT_NONE, k);
    }
    return gvi__report_status(st, GVI_E_NON_FINITE);
}

/* Every effect that is on, but clock, constraints and those with a bit in `skip`: adds to at->f and
   at->dldv, and with a level (a clock) to the values.                                          */
static gvi_status gvi__effects(gvi_stepper *st, gvi_points *at, unsigned skip, gvi_real *level)
{
    const int diagnose = st->in.diagnose;
    skip |= st->in.off | st->in.apart;

    // points that are not finite: the iteration has diverged, and no effect is to blame
    if (diagnose
        && (gvi__check_rows(st, at, at->q, 0) != GVI_OK
            || gvi__check_rows(st, at, at->v, 0) != GVI_OK))
        return gvi__report_status(st, GVI_E_CONVERGENCE);
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        if (skip >> e & 1u) continue;
        const gvi_status status = gvi__effect(st, at, e, gvi__value_row(st, e, level));
        if (status != GVI_OK) return status;
    }
    if (!diagnose) return GVI_OK;
    const int finite = gvi__check_rows(st, at, at->f, 0) == GVI_OK
                       && gvi__check_rows(st, at, at->dldv, 0) == GVI_OK
                       && (!level
                           || (gvi__first_non_finite(at->count, level) < 0
                               && gvi__first_non_finite(at->count, st->in.time.lagrangian) < 0));
    if (finite) return gvi__report_status(st, GVI_OK);
    return gvi__diagnose(st, at, skip, level);
}

/* Evaluates mass.points, or with `v` mass.velocity, which reads p.                           */
static gvi_status gvi__evaluate_mass(gvi_stepper *st, const gvi_points *x, const gvi_real *p,
                                     gvi_real *v)
{
    const gvi_mass *mass = &st->in.desc.mass;
    gvi_points at = gvi__points_at(st, x->count, x->stride, x->t, x->q, NULL, NULL);
    gvi_points_fn *callback = mass->velocity;
    at.p = p;
    at.velocity = v;
    if (!v) {
        at.mass = st->in.mass.at_points;
        callback = mass->points;
        gvi__zero((size_t)(x->n*x->n)*(size_t)x->stride, at.mass);
    }
    gvi__count(&st->counters.mass, x->count);
    const int failed = callback(&at, mass->user);
    if (failed) return gvi__report_callback(st, failed, GVI_FAULT_MASS);
    return GVI_OK;
}

/* M(q) at the points, factored.  In whole lanes, with the first point behind the last, unless a
   pivot is doubtful: then once more, one by one.                                              */
static gvi_status gvi__factor_mass(gvi_stepper *st, const gvi_points *x)
{
    const int n = st->n, R = x->stride;
    gvi_real *m = st->in.mass.at_points;
    gvi_status status = gvi__evaluate_mass(st, x, NULL, NULL);
    if (status != GVI_OK) return status;
    gvi__count(&st->counters.factorizations, x->count);
    if (GVI__LANES > 1 && R % 8 == 0) {
        int sure = 1;
        for (size_t i = 0, S = (size_t)R; i < (size_t)n*(size_t)n; ++i)
            for (size_t k = (size_t)x->count; k < S; ++k) m[i*S + k] = m[i*S];
        for (int o = 0; o < R; o += GVI__LANES)
            if (n == 2) sure &= gvi__ldl_factor_lane(2, R, m + o);
            else sure &= gvi__ldl_factor_lane(n, R, m + o);
        if (sure) return GVI_OK;
        status = gvi__evaluate_mass(st, x, NULL, NULL);
        st->counters.mass -= (unsigned long long)x->count;
        if (status != GVI_OK) return status;
    }
    int at[2] = { 0, 0 };
    status = gvi__ldl_factor(n, R, x->count, m, at);
    if (status == GVI_OK) return GVI_OK;
    return gvi__report(st, status, GVI_FAULT_MASS, at[0], at[1]);
}

// x->f += v' dM/dq v / 2
static gvi_status gvi__mass_gradient(gvi_stepper *st, const gvi_points *x)
{
    const gvi_mass *mass = &st->in.desc.mass;
    gvi_points at = *x;
    at.dldv = NULL;
    const int failed = mass->gradient(&at, mass->user);
    if (failed) return gvi__report_callback(st, failed, GVI_FAULT_MASS);
    if (!st->in.diagnose) return GVI_OK;
    return gvi__check_rows(st, x, x->f, GVI_FAULT_MASS);
}

// where entry (i,j) of a symmetric matrix stands, of which only i >= j is there
static int gvi__lower(int n, int i, int j) { return i >= j ? i*n + j : j*n + i; }

/* at->dldv += M v.  Entry (i,j) is `width` numbers: one for each point, one for all, or, 0, only
   those of the diagonal are there.                                                            */
static void gvi__add_momenta(const gvi_points *at, const gvi_real *m, int width)
{
    const int n = at->n, R = at->stride, each = width > 1;
    for (int i = 0; i < n; ++i) {
        gvi_real *p = at->dldv + i*R;
        if (width == 0) {
            for (int k = 0; k < at->count; ++k) p[k] += m[i]*at->v[i*R + k];
            continue;
        }
        for (int j = 0; j < n; ++j) {
            const gvi_real *a = m + (size_t)gvi__lower(n, i, j)*(size_t)width;
            for (int k = 0; k < at->count; ++k) p[k] += a[k*each]*at->v[j*R + k];
        }
    }
}

/* F and P = dL/dv at the points from scratch, of everything but the effects with a bit in `skip`;
   the kinetic energy is left out on demand, too.                                             */
static gvi_status gvi__evaluate(gvi_stepper *st, gvi_points *at, unsigned skip, int kinetic)
{
    const struct gvi__private *in = &st->in;
    const size_t length = (size_t)at->n*(size_t)at->stride;
    gvi_status status = GVI_OK;
    gvi__zero(length, at->f);
    gvi__zero(length, at->dldv);
    if (!kinetic || gvi__mass_is(in, GVI_MASS_NONE)) return gvi__effects(st, at, skip, NULL);
    if (gvi__mass_is(in, GVI_MASS_POSITION)) {
        status = gvi__evaluate_mass(st, at, NULL, NULL);
        if (status == GVI_OK) status = gvi__mass_gradient(st, at);
        if (status == GVI_OK) gvi__add_momenta(at, in->mass.at_points, at->stride);
    } else gvi__add_momenta(at, in->mass.matrix, in->desc.mass.kind == GVI_MASS_DENSE);
    if (status == GVI_OK && in->diagnose)
        status = gvi__check_rows(st, at, at->dldv, GVI_FAULT_MASS);
    if (status != GVI_OK) return status;
    return gvi__effects(st, at, skip, NULL);
}

// rows z [n][R] := M^-1 z, M constant
static void gvi__over_mass(const gvi_stepper *st, gvi_real *z, int R, int count)
{
    const struct gvi__private *in = &st->in;
    if (in->desc.mass.kind == GVI_MASS_DENSE)
        gvi__ldl_solve(st->n, in->mass.factor, 1, z, R, count);
    if (in->desc.mass.kind != GVI_MASS_DIAGONAL) return;
    for (int i = 0; i < st->n; ++i)
        for (int k = 0; k < count; ++k) z[i*R + k] *= in->mass.inverse[i];
}

/* d(dL/dv)/dv at one point, n*n, by differences of dL/dv, to `hessian`.  x has been evaluated, and
   x->v is v.  The difference is shortened where it leaves the domain of L, and made longer where
   P_j, which need not be 0 with v, hides it.                                                 */
static gvi_status gvi__velocity_hessian(gvi_stepper *st, gvi_points *at, gvi_real *v,
                                        gvi_real *hessian)
{
    const int n = st->n;
    const gvi_real root = GVI_SQRT(GVI__EPS);
    gvi_real *base = st->in.newton.column;
    gvi__copy((size_t)n, at->dldv, base);
    for (int j = 0; j < n; ++j) {
        const gvi_real was = v[j], push = GVI_ABS(st->in.sized.h*at->f[j])*root;
        const int rests = !gvi__nonzero(was);
        gvi_real d = 0, next = root*GVI_ABS(was);
        if (rests) next = root*(gvi__norm1(n, v)/(gvi_real)n);
        if (!(next > GVI__MIN/GVI__EPS)) next = root;
        for (int k = 0; k < 12; ++k) {
            v[j] = was + next;
            const gvi_status status = gvi__evaluate(st, at, 0, 1);
            d = v[j] - was;
            v[j] = was;
            if (status != GVI_OK && (status != GVI_E_CALLBACK || k == 11)) return status;
            const gvi_real moved = GVI_ABS(at->dldv[j] - base[j]);
            if (status != GVI_OK || !gvi__finite(at->dldv[j])) {
                // out of the domain: nearer, and at the last place back towards 0
                next = d*root;
                if (GVI_ABS(d)*root < 2*GVI__EPS*GVI_ABS(was)) next = -2*GVI__EPS*was;
            } else if (rests && push > 0 && moved > 16*push) {
                next = d*(push/moved);                     // from rest, as f takes it
            } else if (moved < root*GVI_ABS(base[j])/2) {
                next = d/GVI_SQRT(root);
            } else break;
            if (!gvi__nonzero(next)) break;
        }
        for (int i = 0; i < n; ++i) hessian[i*n + j] = (at->dldv[i] - base[i])/d;
    }
    gvi__copy((size_t)n, base, at->dldv);
    return GVI_OK;
}

/* General Legendre transform at one point: Newton's method for dL/dv(v) = p from the v given.  Ends
   when the correction stops shrinking and dL/dv misses p by no more than rounding of v explains.
   A correction out of the domain of L (faster than light), refused or not a number, is halved. */
static gvi_status gvi__legendre_newton(gvi_stepper *st, gvi_points *x, const gvi_real *p,
                                       gvi_real *v)
{
    const int n = st->n;
    gvi_real *W = st->in.newton.hessian, *pivot = W + n*n, *dv = st->in.newton.column + n,
             last = GVI__MAX;
    int at;
    x->v = v;
    gvi__count(&st->counters.velocities, 1);
    for (int k = 0, halves = 0; k < 60; ++k) {
        gvi_real change = 0, miss = 0;
        int almost = 1;
        gvi_status status = gvi__evaluate(st, x, 0, 1);
        if (status == GVI_OK && gvi__first_non_finite(n, x->dldv) >= 0) status = GVI_E_NON_FINITE;
        if (status == GVI_OK) status = gvi__velocity_hessian(st, x, v, W);
        if (status == GVI_OK) {
            for (int i = 0; i < n; ++i) {
                gvi_real rounding = GVI_ABS(p[i]);
                for (int j = 0; j < n; ++j) rounding += GVI_ABS(W[i*n + j]*v[j]);
                dv[n + i] = p[i] - x->dldv[i];
                almost &= GVI_ABS(dv[n + i]) <= GVI_SQRT(GVI__EPS)*GVI_ABS(p[i]);
                if (GVI_ABS(dv[n + i]) > miss*rounding) miss = GVI_ABS(dv[n + i])/rounding;
            }
            status = gvi__lu_factor(n, W, pivot, &at);
            gvi__count(&st->counters.factorizations, 1);
            if (status == GVI_E_SINGULAR)
                return gvi__report(st, status, GVI_FAULT_MASS, at, GVI_FAULT_NONE);
        }
        const int beyond = status == GVI_E_CALLBACK || status == GVI_E_NON_FINITE;
        if (k > 0 && beyond && halves < 400) {
            for (int i = 0; i < n; ++i) {
                dv[i] /= 2;
                v[i] -= dv[i];
            }
            k -= 1;
            halves += 1;
            continue;
        }
        if (status == GVI_E_NON_FINITE) return gvi__report_effect(st, status, GVI_FAULT_MASS);
        if (status != GVI_OK) return status;
        gvi__copy((size_t)n, dv + n, dv);
        gvi_lu_solve(n, W, pivot, dv);
        for (int i = 0; i < n; ++i) {
            v[i] += dv[i];
            if (gvi__nonzero(dv[i])) change += GVI_ABS(dv[i])/(GVI_ABS(dv[i]) + GVI_ABS(v[i]));
        }
        if (!(change <= GVI__MAX)) break;
        // from beyond the root corrections grow threefold, be they of the last place
        const gvi_real small = GVI_SQRT(GVI__EPS);
        const int rests = k > 4 || (change <= GVI__EPS*GVI__PLACE/2 && (last <= small || almost)),
                  still = change >= last/2 && change <= 2*last && change <= small;
        if (miss <= 2*GVI__PLACE*GVI__EPS*(gvi_real)n && (rests || still)) return GVI_OK;
        last = change;
    }
    return gvi__report_effect(st, GVI_E_CONVERGENCE, GVI_FAULT_MASS);
}

// a velocity near the present one: that at the end of the last step, or of the start
static void gvi__velocity_guess(const gvi_stepper *st, gvi_real *v)
{
    const struct gvi__private *in = &st->in;
    if (GVI__READS_V && in->has_velocity) gvi__gather(st->n, in->R, in->last.V + st->r - 1, v);
    else gvi__copy((size_t)st->n, in->start, v);
}

// v from p at one point; v holds a guess on entry
static gvi_status gvi__velocity(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p,
                                gvi_real *v)
{
    gvi_points at = gvi__one_point(st, &t, q);
    if (st->in.desc.mass.velocity) {
        const gvi_status status = gvi__evaluate_mass(st, &at, p, v);
        if (status != GVI_OK) return status;
        return gvi__check_rows(st, &at, v, GVI_FAULT_MASS);
    }
    if (gvi__mass_is(&st->in, GVI_MASS_NONE) || gvi__has(&st->in, GVI__HAS_LAGRANGIAN))
        return gvi__legendre_newton(st, &at, p, v);
    gvi__copy((size_t)st->n, p, v);
    if (gvi__mass_is(&st->in, GVI_MASS_POSITION)) {
        const gvi_status status = gvi__factor_mass(st, &at);
        if (status != GVI_OK) return status;
        gvi__ldl_solve(st->n, st->in.mass.at_points, 1, v, 1, 1);
        gvi__count(&st->counters.velocities, 1);
    } else gvi__over_mass(st, v, 1, 1);
    return GVI_OK;
}

/* At one point: V and L, the sums of the potentials and of the Lagrangian terms, and the kinetic
   energy T = v'Mv/2.  Forces have no value.                                                  */
GVI__COLD gvi_status gvi__value_sums(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                     const gvi_real *v, gvi_real *V, gvi_real *L, gvi_real *T)
{
    const gvi_desc *d = &st->in.desc;
    gvi_points at = gvi__one_point(st, &t, q);
    at.v = v;
    *V = *L = *T = 0;
    for (int e = 0; e < d->effect_count; ++e) {
        const gvi_kind kind = d->effects[e].kind;
        gvi_real *value = L;
        if (kind == GVI_POTENTIAL) value = V;
        if (((st->in.off | st->in.apart) >> e & 1u) || kind == GVI_FORCE) continue;
        const gvi_status status = gvi__value(st, &at, e, value);
        if (status != GVI_OK) return status;
        if (!gvi__finite(*value)) return gvi__report_effect(st, GVI_E_NON_FINITE, e);
    }
    const gvi_status status = gvi__evaluate(st, &at, ~0u, 1);
    *T = gvi__dot(st->n, at.dldv, v)/2;
    return status;
}

/* H = p'v - L, v being a guess on entry and the velocity on return.  Without Lagrangian terms the
   kinetic energy is p'v/2.                                                                   */
GVI__COLD gvi_status gvi__hamiltonian(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p, gvi_real *v, gvi_real *energy)
{
    gvi_real V, L, T;
    gvi_status status = gvi__velocity(st, t, q, p, v);
    if (status == GVI_OK) status = gvi__value_sums(st, t, q, v, &V, &L, &T);
    if (status != GVI_OK) return status;
    const gvi_real pv = gvi__dot(st->n, p, v);
    if (gvi__has(&st->in, GVI__HAS_LAGRANGIAN)) *energy = (pv - T) - L + V;
    else *energy = pv/2 + V;
    return GVI_OK;
}

/* ---------------------------------------------------------------- TABLES */

/* phi_k = P_k(x) and Phi_k = (P_(k-1) - P_(k+1))(x)/(2(2k+1)), P_(-1) = 1, at the nodes, x = 1
   - 2c, in double-word arithmetic: [k*R + node].  Then the nodes go to the grid of S.         */
GVI__COLD void gvi__modes_of(const gvi_stepper *st, int count, gvi_real *c, const gvi_real *c_low,
                             gvi_real *phi, gvi_real *phi_low, gvi_real *Phi, gvi_real *Phi_low)
{
    for (int i = 0; i < count; ++i) {
        const gvi__two X = gvi__argument2(gvi__two_of(c[i], c_low[i]));
        gvi__two P = gvi__two_of(1, 0), before = P;
        for (int k = 0, at = i; k < st->s; ++k, at += st->in.R) {
            gvi__two z = before;
            if (phi) {
                phi[at] = P.hi;
                phi_low[at] = P.lo;
            }
            gvi__legendre2(k, X, &P, &before);
            z = gvi__div2_by(gvi__sub2(z, P), 4*k + 2);
            Phi[at] = z.hi;
            Phi_low[at] = z.lo;
        }
        c[i] = gvi__grid(gvi__two_sum(c[i], c_low[i]), GVI__EPS/2);
    }
}

// the low words of modes a: phi, Phi, or Phi at constraints' points
static const gvi_real *gvi__low_words(const gvi_stepper *st, const gvi_real *a)
{
    if (a == st->in.table.phi) return st->in.table.phi_low;
    if (a == st->in.con.Phi) return st->in.con.Phi_low;
    return st->in.sized.E;                         // gvi__set_rule puts those of Phi there
}

/* 1/Gamma_kk = 2k + 1 while the rule is exact for phi_k^2; Lobatto with r = s gives s - 1 for the
   last.  A rule of order u < 2s - 2 makes Gamma full: its LU is kept.  Of a mode that the rule all
   but misses, half of the digits would be left.                                               */
GVI__COLD gvi_status gvi__make_gamma(gvi_stepper *st)
{
    const struct gvi__tables *table = &st->in.table;
    const int s = st->s, r = st->r, R = st->in.R;
    for (int k = 0; k < s; ++k) table->inv_gamma[k] = (gvi_real)(2*k + 1);
    if (GVI__RULES && st->order == 2*s - 2) {
        const gvi_real *last = table->phi + (s - 1)*R, sum = gvi__dot3(r, table->b, last, last);
        if (!(GVI_ABS(sum) > GVI_SQRT(GVI__EPS))) return GVI_E_POINTS;
        table->inv_gamma[s - 1] = 1/sum;
        if (st->in.desc.rule.kind == GVI_LOBATTO) table->inv_gamma[s - 1] = (gvi_real)(s - 1);
    }
    if (!gvi__has(&st->in, GVI__HAS_GAMMA)) return GVI_OK;
    for (int k = 0; k < s; ++k)
        for (int l = 0; l < s; ++l)
            table->gamma[k*s + l] = gvi__dot3(r, table->b, table->phi + k*R, table->phi + l*R);
    if (gvi_lu_factor(s, table->gamma, table->gamma + s*s) != GVI_OK) return GVI_E_POINTS;
    if (!(gvi_lu_rcond(s, table->gamma, table->gamma + s*s, st->in.row) > GVI_SQRT(GVI__EPS)))
        return GVI_E_POINTS;
    return GVI_OK;
}

// y := Gamma^-1 y
static void gvi__over_gamma(const gvi_stepper *st, gvi_real *y)
{
    const struct gvi__tables *table = &st->in.table;
    if (gvi__has(&st->in, GVI__HAS_GAMMA))
        gvi_lu_solve(st->s, table->gamma, table->gamma + st->s*st->s, y);
    else for (int k = 0; k < st->s; ++k) y[k] *= table->inv_gamma[k];
}

// w := Gamma^-1 b(c_j) as double words, low words s further, for gvi__coupling; b: phi or Phi
GVI__COLD void gvi__prepare_column(gvi_stepper *st, const gvi_real *b, int j)
{
    const struct gvi__tables *table = &st->in.table;
    const gvi_real *low = gvi__low_words(st, b);
    const int s = st->s, R = st->in.R, full = gvi__has(&st->in, GVI__HAS_GAMMA);
    gvi_real *w = st->in.row;
    for (int k = 0; k < s; ++k) {
        gvi__two z = gvi__two_of(b[k*R + j], 0);
        if (!full) z = gvi__scale2(table->inv_gamma[k], gvi__two_of(z.hi, low[k*R + j]));
        w[k] = z.hi;
        w[s + k] = z.lo;
    }
    if (full) gvi__over_gamma(st, w);
}

// sum_k a_k(c_i) (Gamma^-1 b(c_j))_k; a: phi or Phi.  Products do not wait for the sum
GVI__COLD gvi__two gvi__coupling(const gvi_stepper *st, const gvi_real *a, int i)
{
    const gvi_real *low = gvi__low_words(st, a), *w = st->in.row;
    gvi__two sum = gvi__two_of(0, 0);
    for (int k = 0, at = i; k < st->s; ++k, at += st->in.R) {
        const gvi__two z = gvi__mul2(gvi__two_of(a[at], low[at]), gvi__two_of(w[k], w[st->s + k]));
        sum = gvi__add_low(sum.hi, sum.lo, z.hi, z.lo);
    }
    return gvi__two_sum(sum.hi, sum.lo);
}

// S_ij and T_ij of the column that was prepared last; Phi: at the nodes i
static gvi_real gvi__S(const gvi_stepper *st, const gvi_real *Phi, int i)
{
    return gvi__grid(gvi__coupling(st, Phi, i), GVI__EPS/2);
}

static gvi_real gvi__T(const gvi_stepper *st, int i)
{
    return gvi__grid(gvi__coupling(st, st->in.table.phi, i), GVI__EPS);
}

/* S and T on grids of eps/2 and eps (|S| <= 1, |T| < 2): what they must fulfil for the step to
   be symplectic then holds exactly in the rounded numbers, S_ij = S_ji, and for Gauss with r =
   s T_ij + T_ji = 1.  Stored by columns, [j*R + i]: K = c_i - S_ij, U = 1 - T_ij, T = T_ji, and
   where Lagrangian terms are taken away, in the velocities formulation, -T_ji and -N_ij.      */
GVI__COLD void gvi__make_tables(gvi_stepper *st)
{
    const struct gvi__tables *table = &st->in.table;
    const int r = st->r, R = st->in.R;
    const int gauss = !GVI__RULES || (st->in.desc.rule.kind == GVI_GAUSS && r == st->s);
    gvi_real sign = 1;
    if (!gvi__has(&st->in, GVI__BY_MOMENTA)) sign = -1;
    for (int j = 0; j < r; ++j) {
        int to = r;
        gvi__prepare_column(st, table->Phi, j);
        if (table->K)
            for (int i = 0; i <= j; ++i) {
                const gvi_real S = gvi__S(st, table->Phi, i);
                table->K[j*R + i] = table->c[i] - S;
                table->K[i*R + j] = table->c[j] - S;
            }
        if (!table->U) continue;
        if (gauss) to = j + 1;                    // the others by T_ij + T_ji = 1
        for (int i = 0; i < to; ++i) {
            gvi_real T = (gvi_real)0.5;
            if (!gauss || i != j) T = gvi__T(st, i);
            table->U[j*R + i] = 1 - T;
            if (gauss) table->U[i*R + j] = T;
            if (table->T) table->T[i*R + j] = sign*T;
            if (table->T && gauss) table->T[j*R + i] = sign*(1 - T);
        }
        if (!GVI__LAGRANGIAN || !table->N) continue;
        gvi__prepare_column(st, table->phi, j);
        for (int i = 0; i < r; ++i) table->N[j*R + i] = -gvi__coupling(st, table->phi, i).hi;
    }
}

/* The tables of constraints, on the same grids, by columns: K = c_i - S(c_i, d_e), U = 1 - T(c_i,
   d_e); for D d_a - S(d_a, c_j), or with momenta T(c_j, d_a), and d_a - S(d_a, d_e), with LU. */
GVI__COLD gvi_status gvi__set_constraints(gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int s = st->s, r = st->r, R = in->R, momenta = gvi__has(in, GVI__BY_MOMENTA);
    gvi_real *d = in->con.d, *low = in->row, *lu = in->con.lu;
    gvi__rule(1, s + 1, d, gvi__has(in, GVI__ITERATES) ? low : NULL, in->con.w);
    if (!gvi__has(in, GVI__ITERATES)) return GVI_OK;
    gvi__modes_of(st, s, d + 1, low + 1, NULL, NULL, in->con.Phi, in->con.Phi_low);
    gvi__zero(2*(size_t)s, in->row);               // the column of d_0: Phi(d_0) = 0
    for (int e = 0; e <= s; ++e) {
        if (e > 0) gvi__prepare_column(st, in->con.Phi, e - 1);
        for (int i = 0; i < r; ++i) {
            const gvi_real S = gvi__S(st, in->table.Phi, i), T = in->con.U ? gvi__T(st, i) : 0;
            if (e < s) in->con.K[e*R + i] = in->table.c[i] - S;
            if (e < s && in->con.U) in->con.U[e*R + i] = 1 - T;
            if (e > 0) in->con.by_force[i*R + e - 1] = momenta ? T : d[e] - S;
        }
        for (int a = e > 1 ? e : 1; a <= s; ++a) {
            const gvi_real S = gvi__S(st, in->con.Phi, a - 1);
            if (e < s) in->con.by_impulse[e*R + a - 1] = lu[(a - 1)*s + e] = d[a] - S;
            if (a < s && e > 0) in->con.by_impulse[a*R + e - 1] = lu[(e - 1)*s + a] = d[e] - S;
        }
    }
    if (gvi_lu_factor(s, lu, lu + s*s) != GVI_OK) return GVI_E_POINTS;
    for (int a = 0; a < s; ++a) {
        in->con.X[a*R + a] = 1;
        gvi_lu_solve(s, lu, lu + s*s, in->con.X + a*R);
    }
    return GVI_OK;
}

// phi_k(tau) and Phi_k(tau), k < s, multiplied by Gamma^-1, at any tau
static void gvi__modes(const gvi_stepper *st, gvi_real tau, gvi_real *phi, gvi_real *Phi)
{
    gvi_real P = 1, before = 1;
    for (int k = 0; k < st->s; ++k) {
        const gvi_real last = before;
        phi[k] = P;
        gvi__legendre(k, 1 - 2*tau, &P, &before);
        Phi[k] = (last - P)/(gvi_real)(4*k + 2);
    }
    gvi__over_gamma(st, phi);
    gvi__over_gamma(st, Phi);
}

/* What a step of length h needs, if it is not there already: weights h b_j whose sum is h exactly.
   They are rounded to multiples of ulp(h); what is left over goes to the largest weight and its
   mirror image.  Explicit, the drifts between the nodes sum to h as well.                    */
static void gvi__weights_for(gvi_stepper *st, gvi_real h)
{
    struct gvi__sized *sized = &st->in.sized;
    const gvi_real *b = st->in.table.b;
    const int r = st->r;
    int e, most = 0;
    if (!gvi__nonzero(sized->h - h)) return;
    sized->h = h;
    sized->ratio = 0;                                  // E may hold sums with the old weights

    gvi_real mantissa = GVI_FREXP(h, &e), rest = mantissa, at = 0;
    for (int j = 0; j < r; ++j) {
        sized->hb[j] = gvi__grid(gvi__two_prod(b[j], mantissa), GVI__EPS/2);
        rest -= sized->hb[j];
        if (b[j] > b[most]) most = j;
    }
    const int mirror = r - 1 - most;
    if (mirror == most || gvi__nonzero(b[mirror] - b[most])) sized->hb[most] += rest;
    else {
        sized->hb[most] += rest/2;
        sized->hb[mirror] += rest/2;
    }
    for (int j = 0; j < r; ++j) sized->hb[j] = GVI_LDEXP(sized->hb[j], e);
    if (gvi__has(&st->in, GVI__ITERATES)) return;
    for (int j = 0; j < r; ++j) {
        const gvi_real next = gvi__grid(gvi__two_prod(st->in.table.c[j], mantissa), GVI__EPS/2);
        sized->drift[j] = GVI_LDEXP(next - at, e);
        at = next;
    }
    sized->drift[r] = GVI_LDEXP(mantissa - at, e);
}

/* The predictor: least squares through the stage values of the last step or the last two, by
   polynomials p_k that are orthonormal on the nodes x_j = c, and c - 1 for the step before
   (Forsythe 1957): E_ij = sum_k p_k(y_i) p_k(x_j) at the points y_i = alpha + beta c_i of the
   next; those are `to`, which are the same nodes but for constraints.

   Degree: for one step r - 1, through all values; for two, what `make cost` found best.  It stops
   before rounding, amplified by about 5.8^degree at the end of the step, exceeds 1e-4 in double,
   and before a polynomial that only distinguishes points that nearly coincide, as 0 and 1 - 1 do
   in two steps of Lobatto's: its coupling is then small, elsewhere it is above 0.1.           */
static void gvi__fit(gvi_stepper *st, int r, const gvi_real *from, const gvi_real *to,
                     gvi_real alpha, gvi_real beta, int steps, gvi_real *E)
{
    struct gvi__private *in = &st->in;
    const int R = in->R, nodes = steps*R, all = nodes + R, most = GVI__DIG*2/7;
    int degree = r - 1;
    if (steps == 2) degree = r + r/2 - r/8;
    if (degree > most) degree = most;
    gvi_real *p = in->row, *before = p + 3*R, *at = before + 3*R;
    gvi_real coupling = 0;
    const gvi_real norm = 1/GVI_SQRT((gvi_real)(steps*r));
    gvi__zero(6*(size_t)R, p);                     // and before, which is behind it
    for (int m = 0; m < R; ++m) {
        at[m] = from[m];
        at[R + m] = from[m] - 1;
        at[nodes + m] = alpha + beta*to[m];
        if (m < r) p[m] = p[R + m] = p[nodes + m] = norm;
    }
    gvi__zero((size_t)(steps*r*R), E);
    for (int k = 0; k <= degree; ++k) {
        for (int j = 0; j < r; ++j) {
            gvi_real *last = E + j*R;
            gvi__add_scaled(R, p[j], p + nodes, last, last);
            if (steps == 1) continue;
            gvi_real *older = E + (r + j)*R;
            gvi__add_scaled(R, p[R + j], p + nodes, older, older);
        }

        // p_(k+1) ~ (x - <x p_k, p_k>) p_k - coupling p_(k-1), over its norm
        const gvi_real middle = gvi__dot3(nodes, at, p, p);
        gvi_real size = 0;
        for (int m = 0; m < all; ++m) {
            const gvi_real next = (at[m] - middle)*p[m] - coupling*before[m];
            before[m] = p[m];
            p[m] = next;
            if (m < nodes) size += next*next;
        }
        coupling = GVI_SQRT(size);
        if (coupling < GVI__SEEN) break;
        for (int m = 0; m < all; ++m) p[m] /= coupling;
    }
}

/* ---------------------------------------------------------------- ENGINE */

/* Where a step, or a query's partial step, starts; E: the energy, with a clock.              */
typedef struct gvi__origin { gvi_real t, t_low; const gvi_real *q, *q_low, *p, *p_low; gvi_real E; }
    gvi__origin;

// Newton's method begins at: constant velocity; extrapolated modes; constant velocity, with halving
enum { GVI__PLAIN, GVI__EXTRAPOLATED, GVI__HALVED };

// what is solved: a step, or for a query a part of the last one, from its start or its end
enum { GVI__STEP, GVI__FROM_START, GVI__FROM_END };

/* ---- free motion ---- */

// out := t + (t_low + c h)
static void gvi__times(int count, gvi_real t, gvi_real t_low, gvi_real h, const gvi_real *c,
                       gvi_real *out)
{
    GVI__ALONG(count, GVI__TO(out) = t + (t_low + GVI__AT(c)*h))
}

// 1) tables for h, times of the points; for a constant mass v = M^-1 p and h v in double words
static void gvi__free_motion(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const gvi_real *GVI__RESTRICT p = from->p, *GVI__RESTRICT p_low = from->p_low;
    const gvi_real *GVI__RESTRICT inverse = in->mass.inverse;
    gvi_real *GVI__RESTRICT v = in->free.v, *GVI__RESTRICT v_low = in->free.v_low;
    gvi__weights_for(st, h);
    in->dt = h;
    if (GVI__CLOCK) in->time.dH = 0;
    if (!gvi__has(in, GVI__ITERATES)) return;
    gvi__times(in->R, from->t, from->t_low, h, in->table.c, in->t);
    if (!gvi__mass_is_constant(in)) return;
    for (int i = 0; i < st->n; ++i) {
        gvi__two z = gvi__two_of(p[i], 0);
        if (in->desc.mass.kind == GVI_MASS_DIAGONAL) z = gvi__two_prod(p[i], inverse[i]);
        v[i] = z.hi;
        v_low[i] = gvi__low(z.lo + p_low[i]*inverse[i]);
    }
    if (in->desc.mass.kind == GVI_MASS_DENSE) {
        gvi__over_mass(st, v, 1, 1);
        for (int i = 0; i < st->n; ++i) {         // p - M v
            gvi__two left = gvi__two_of(p[i], p_low[i]);
            for (int j = 0; j < st->n; ++j) {
                const gvi__two z = gvi__two_prod(-in->mass.matrix[gvi__lower(st->n, i, j)], v[j]);
                left = gvi__add_low(left.hi, left.lo, z.hi, z.lo);
            }
            v_low[i] = gvi__low(left.hi + left.lo);
        }
        gvi__over_mass(st, v_low, 1, 1);
    }
    for (int i = 0; i < st->n; ++i) {
        const gvi__two path = gvi__two_prod(h, v[i]);
        in->free.path[i] = path.hi;
        in->free.path_low[i] = gvi__low(path.lo + h*v_low[i]);
    }
}

/* ---- stages ---- */

/* One stage of an iteration is data: rows of stage values, made of sums over sources,

     row_i := base_i + (free_i + factor (z_i/m_i))
     z_i    = sum_j table_j (weight_j source_ij)       of one or two tables and sources

   with free motion, the same in all iterations, in rows of its own.  factor and 1/m multiply one by
   one: h/m, rounded once, would belong to another mass than v = p/m, and energy would drift.

   A stage with a scale is measured, in squares of changes times scale_i: all of them are added
   up and returned, and change_i := those of row i at the last point and the middle.  One point
   would not do: where eigenvalues are complex, changes rotate and may be 0 at one, not at both. */
typedef struct gvi__sum { const gvi_real *table, *weight, *source; } gvi__sum;

typedef struct gvi__stage {
    gvi__sum        sum[2];        /* [1] with table NULL: none; [0]: z is the source itself */
    const gvi_real *base, *free;   /* [n] and [n][R]; free NULL: rows are z                  */
    const gvi_real *inverse;       /* [n] 1/m, or NULL where it is 1                         */
    gvi_real        factor, *rows;
    gvi_real       *scale, *change;                             /* [n], or NULL             */
    int             dense;         /* over the full M as well                               */
} gvi__stage;

// L := w source, or the source itself where there is no weight
GVI__BODY const gvi_real *gvi__weighted(int R, const gvi_real *GVI__RESTRICT w,
                                        const gvi_real *source, gvi_real *GVI__RESTRICT L)
{
    if (!w) return source;
    GVI__ALONG_BY(GVI__UNROLL, R, GVI__TO(L) = GVI__AT(w)*GVI__AT(source))
    return L;
}

// 1/(|base| and the last point's displacements, before and after); 0 where these have no sure digit
GVI__BODY gvi_real gvi__scale_of(gvi_real base, gvi_real was, gvi_real is)
{
    const gvi_real size = GVI_ABS(base) + GVI_ABS(was - base) + GVI_ABS(is - base);
    return size > GVI__NOTHING ? 1/size : 0;
}

// the squares at eight points, added up in one order everywhere
GVI__BODY gvi_real gvi__sum_squares(const gvi_real *z)
{
    return ((z[0] + z[4]) + (z[1] + z[5])) + ((z[2] + z[6]) + (z[3] + z[7]));
}

/* sum_j table_j L_j at one point, in four chains: the order of gvi__row_sums                 */
GVI__BODY gvi_real gvi__point_sum(int r, int R, const gvi_real *table, const gvi_real *L)
{
    gvi_real a = 0, b = 0, c = 0, d = 0;
    for (int j = 0; j < r; j += 4) {
        a += table[j*R]*L[j];
        if (j + 1 < r) b += table[(j + 1)*R]*L[j + 1];
        if (j + 2 < r) c += table[(j + 2)*R]*L[j + 2];
        if (j + 3 < r) d += table[(j + 3)*R]*L[j + 3];
    }
    return (a + b) + (c + d);
}

/* A stage, point by point; from the last on, where its unit is made.                         */
GVI__BODY gvi_real gvi__stage_by_points(const gvi_stepper *st, const gvi__stage *stage, int n,
                                        int r, int R, int rescale)
{
    gvi_real square[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    for (int i = 0; i < n; ++i) {
        const gvi_real *first =
            gvi__weighted(R, stage->sum[0].weight, stage->sum[0].source + i*R, st->in.row);
        const gvi_real *second = !stage->sum[1].table ? NULL
            : gvi__weighted(R, stage->sum[1].weight, stage->sum[1].source + i*R, st->in.row + R);
        gvi_real *GVI__RESTRICT row = stage->rows + i*R, scale = 0, two = 0;
        if (stage->scale) scale = stage->scale[i];
        for (int k = R - 1; k >= 0; --k) {
            gvi_real z =
                !stage->sum[0].table ? first[k]
                                     : gvi__point_sum(r, R, stage->sum[0].table + k, first);
            if (second) z += gvi__point_sum(r, R, stage->sum[1].table + k, second);
            if (stage->inverse) z *= stage->inverse[i];
            if (stage->free) z = stage->base[i] + (stage->free[i*R + k] + z*stage->factor);
            if (rescale && k == r - 1) scale = gvi__scale_of(stage->base[i], row[k], z);
            const gvi_real moved = (z - row[k])*scale;
            square[k & 7] += moved*moved;
            if (k == r - 1) two += moved*moved;
            if (k == (r - 1)/2) two += moved*moved;
            row[k] = z;
        }
        if (!stage->scale) continue;
        stage->scale[i] = scale;
        stage->change[i] = two;
    }
    return gvi__sum_squares(square);
}

enum { GVI__BLOCK = 8/GVI__LANES };                  // lanes that hold eight points

/* z := sum_j table_j L_j at `lanes` lanes of points.  Four chains, so that no sum waits for
   another, one chain after the other, so that registers suffice; one order for every width: the
   same bits.  r > 3.                                                                          */
GVI__BODY void gvi__row_sums(int r, int R, int lanes, const gvi_real *table, const gvi_real *L,
                             gvi__lane *z)
{
    const gvi__lane none = { 0 };
    gvi__lane sum[4][GVI__BLOCK] = { { none } };
    GVI__UNROLL for (int m = 0; m < 4; ++m) {
        GVI__UNROLL for (int v = 0; v < lanes; ++v) sum[m][v] =
            GVI__LOAD(table + m*R + v*GVI__LANES)*L[m];
        for (int j = m + 4; j < r; j += 4)
            GVI__UNROLL for (int v = 0; v < lanes; ++v) sum[m][v] +=
                GVI__LOAD(table + j*R + v*GVI__LANES)*L[j];
        if (m & 1) GVI__UNROLL for (int v = 0; v < lanes; ++v) sum[m - 1][v] += sum[m][v];
    }
    GVI__UNROLL for (int v = 0; v < lanes; ++v) z[v] = sum[0][v] + sum[2][v];
}

// a stage in lanes of points, R being 4 or a multiple of 8; point by point where no lane fits
GVI__BODY gvi_real gvi__stage_by_lanes(const gvi_stepper *st, const gvi__stage *GVI__RESTRICT stage,
                                       int n, int r, int R, int rescale)
{
    const int block = R < 8 ? R : 8, lanes = block/GVI__LANES, last = r - 1, middle = (r - 1)/2;
    const gvi__lane none = { 0 };
    if (GVI__LANES == 1 || (GVI__LANES == 8 && R == 4))
        return gvi__stage_by_points(st, stage, n, r, R, rescale);
    gvi_real few[32], *L = R <= 16 ? few : st->in.row, total[8];
    gvi__lane square[GVI__BLOCK] = { none };
    for (int i = 0; i < n; ++i) {
        const gvi_real *first =
            gvi__weighted(R, stage->sum[0].weight, stage->sum[0].source + i*R, L);
        const gvi_real *second = !stage->sum[1].table ? NULL
            : gvi__weighted(R, stage->sum[1].weight, stage->sum[1].source + i*R, L + R);
        gvi_real *row = stage->rows + i*R, scale = stage->scale ? stage->scale[i] : 0;
        const gvi_real base = stage->base[i], was = row[last], half = row[middle];
        for (int o = R - block; o >= 0; o -= block) {
            const gvi_real *free = stage->free ? stage->free + i*R + o : NULL;
            gvi__lane z[GVI__BLOCK] = { none }, w[GVI__BLOCK];
            if (stage->sum[0].table) gvi__row_sums(r, R, lanes, stage->sum[0].table + o, first, z);
            else
                GVI__UNROLL for (int v = 0; v < lanes; ++v) z[v] =
                    GVI__LOAD(first + o + v*GVI__LANES);
            if (second) {
                gvi__row_sums(r, R, lanes, stage->sum[1].table + o, second, w);
                GVI__UNROLL for (int v = 0; v < lanes; ++v) z[v] += w[v];
            }
            if (stage->inverse)
                GVI__UNROLL for (int v = 0; v < lanes; ++v) z[v] *= stage->inverse[i];
            if (free) GVI__UNROLL for (int v = 0; v < lanes; ++v)
                z[v] = base + (GVI__LOAD(free + v*GVI__LANES) + z[v]*stage->factor);
            if (rescale && last - o < block)
                scale = gvi__scale_of(base, was, GVI__ENTRY(z[(last - o)/GVI__LANES],
                                                         (last - o) % GVI__LANES));
            GVI__UNROLL for (int v = 0; v < lanes; ++v) {
                gvi_real *at = row + o + v*GVI__LANES;
                const gvi__lane moved = (z[v] - GVI__LOAD(at))*scale;
                square[v] += moved*moved;
                GVI__STORE(at) = z[v];
            }
        }
        if (!stage->scale) continue;
        const gvi_real a = (row[last] - was)*scale, b = (row[middle] - half)*scale;
        stage->scale[i] = scale;
        stage->change[i] = a*a + b*b;
    }
    GVI__UNROLL for (int v = 0; v < GVI__BLOCK; ++v) GVI__STORE(total + v*GVI__LANES) = square[v];
    return gvi__sum_squares(total);
}

// the sizes that deserve a copy of their own (n = 2 also in gvi__factor_mass, gvi__velocity_rows)
#define GVI__KERNEL(name, by, n, r, R)                                                          \
    static gvi_real name(const gvi_stepper *st, const gvi__stage *GVI__RESTRICT y, int rescale) \
    {                                                                                           \
        return gvi__stage_##by(st, y, n, r, R, rescale);                                        \
    }
GVI__KERNEL(gvi__rows_any,   by_points, st->n, st->r, st->in.R)
GVI__KERNEL(gvi__rows_2,     by_points, st->n, 2, 2)
GVI__KERNEL(gvi__rows_3,     by_points, st->n, 3, 3)
GVI__KERNEL(gvi__rows_4,     by_lanes,  st->n, 4, 4)
GVI__KERNEL(gvi__rows_6,     by_lanes,  st->n, 6, 8)
GVI__KERNEL(gvi__rows_2_8,   by_lanes,  2, 8, 8)
GVI__KERNEL(gvi__rows_8,     by_lanes,  st->n, 8, 8)
GVI__KERNEL(gvi__rows_to_8,  by_lanes,  st->n, st->r, 8)
GVI__KERNEL(gvi__rows_12,    by_lanes,  st->n, 12, 16)
GVI__KERNEL(gvi__rows_16,    by_lanes,  st->n, 16, 16)
GVI__KERNEL(gvi__rows_to_16, by_lanes,  st->n, st->r, 16)
GVI__KERNEL(gvi__rows_many,  by_lanes,  st->n, st->r, st->in.R)

static gvi__kernel *gvi__kernel_for(int n, int r)
{
    if (GVI__SMALL || r == 1) return gvi__rows_any;
    if (r == 2) return gvi__rows_2;
    if (r == 3) return gvi__rows_3;
    if (r == 4) return gvi__rows_4;
    if (GVI__LANES == 1) return gvi__rows_any;
    if (r == 8) return n == 2 ? gvi__rows_2_8 : gvi__rows_8;
    if (r == 6) return gvi__rows_6;
    if (r == 12) return gvi__rows_12;
    if (r == 16) return gvi__rows_16;
    if (r < 8) return gvi__rows_to_8;
    return r < 16 ? gvi__rows_to_16 : gvi__rows_many;
}

// row := low + (c path_low + c path), one coordinate's free motion over its base
GVI__BODY void gvi__free_row(int R, gvi_real low, gvi_real path, gvi_real path_low,
                             const gvi_real *GVI__RESTRICT c, gvi_real *GVI__RESTRICT row)
{
    GVI__ALONG(R, GVI__TO(row) = (low + GVI__AT(c)*path_low) + GVI__AT(c)*path)
}

// a stage that is the sum over one table and nothing else
GVI__BODY void gvi__set_stage(const gvi_stepper *st, gvi__stage *stage, gvi_real *rows,
                              const gvi_real *table, const gvi_real *weight, const gvi_real *source)
{
    const gvi__stage sum = { { { table, weight, source }, { NULL, NULL, NULL } }, st->in.zeros,
                             NULL,
                             NULL, 1, rows, NULL, NULL, 0 };
    *stage = sum;
}

/* The rows of a stage where M is full: all sums first, then M^-1 of them.                    */
static gvi_real gvi__dense_rows(const gvi_stepper *st, const gvi__stage *stage, int rescale)
{
    const struct gvi__private *in = &st->in;
    gvi__stage y = *stage, sums;
    gvi__set_stage(st, &sums, in->mass.sums, y.sum[0].table, y.sum[0].weight, y.sum[0].source);
    sums.sum[1] = y.sum[1];
    in->kernel(st, &sums, 0);
    gvi__over_mass(st, in->mass.sums, in->R, in->R);
    y.sum[0].table = y.sum[0].weight = y.sum[1].table = NULL;
    y.sum[0].source = in->mass.sums;
    return in->kernel(st, &y, rescale);
}

/* V := M^-1 (P - A), with the constant mass or the factored M(Q)                             */
static void gvi__velocity_rows(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    const gvi_real *P = in->work.P, *A = in->work.A;
    gvi_real *V = in->work.V;
    if (GVI__LAGRANGIAN && A) {
        for (int k = 0; k < n*R; ++k) V[k] = P[k] - A[k];
        P = V;
    }
    if (GVI__LANES > 1 && R % 8 == 0 && !gvi__mass_is_constant(in)) {
        for (int o = 0; o < R; o += GVI__LANES)
            if (n == 2) gvi__ldl_solve_lane(2, R, in->mass.at_points + o, P + o, V + o);
            else gvi__ldl_solve_lane(n, R, in->mass.at_points + o, P + o, V + o);
        return;
    }
    if (P != V) gvi__copy((size_t)(n*R), P, V);
    if (gvi__mass_is_constant(in)) gvi__over_mass(st, V, R, st->r);
    else gvi__ldl_solve(n, in->mass.at_points, R, V, R, st->r);
}

/* ---- predictor ---- */

// in place of a stage's own sums: E over the values of one or two steps
GVI__BODY void gvi__set_predictor(const gvi_stepper *st, gvi__stage *stage, const gvi_real *last,
                                  const gvi_real *older)
{
    const gvi_real *E = st->in.sized.E;
    const gvi__sum one = { E, NULL, last };
    gvi__sum two = { NULL, NULL, older };
    if (st->in.sized.steps == 2) two.table = E + st->r*st->in.R;
    stage->sum[0] = one;
    stage->sum[1] = two;
    stage->scale = NULL;
}

/* E takes the stage values of the last step (of two, if they are as long as this one) to the nodes
   of this step, at alpha + beta c in the last step's tau.  In the positions formulation forces only
   serve to make positions: E := K h b E does both, for steps as long as the last.            */
static void gvi__prepare_predictor(gvi_stepper *st, gvi_real h, int query)
{
    struct gvi__private *in = &st->in;
    const int newton = GVI__NEWTON && st->formulation == GVI_NEWTON, r = st->r, R = in->R;
    const int two = !query && !newton && in->kept == 2 && in->older.F && !gvi__nonzero(h - st->h);
    const gvi_real beta = h/st->h;
    const int sums = !gvi__nonzero(beta - 1) && gvi__has(in, GVI__BY_FORCES) && !newton
                     && in->desc.mass.kind != GVI_MASS_DENSE && !gvi__constrained(st);
    if (!query && !gvi__nonzero(beta - in->sized.ratio) && in->sized.steps == two + 1
        && in->sized.sums == sums) return;
    in->sized.ratio = beta;
    if (query) in->sized.ratio = 0;                // another start: not to be used again
    in->sized.steps = two + 1;
    in->sized.sums = sums;
    gvi__fit(st, r, in->table.c, in->table.c, query != GVI__FROM_START, beta, two + 1, in->sized.E);
    if (gvi__constrained(st))
        gvi__fit(st, st->s, in->con.d + 1, in->con.d, query != GVI__FROM_START, beta, 1, in->con.E);
    if (!sums) return;
    for (int m = 0; m < in->sized.steps*r; ++m) {
        const gvi_real *L = gvi__weighted(R, in->sized.hb, in->sized.E + m*R, in->row);
        for (int k = 0; k < r; ++k) in->row[R + k] = gvi__point_sum(r, R, in->table.K + k, L);
        gvi__copy((size_t)r, in->row + R, in->sized.E + m*R);
    }
}

/* ---- a clock ---- */

// the clock's g and dg/dq at the points
static gvi_status gvi__rate(gvi_stepper *st, const gvi_points *x, gvi_real *rate, gvi_real *slope)
{
    const gvi_effect *clock = st->in.desc.effects + st->in.clock;
    gvi_points at = gvi__points_at(st, x->count, x->stride, x->t, x->q, slope, NULL);
    at.value = rate;
    gvi__zero((size_t)x->n*(size_t)x->stride, slope);
    gvi__zero((size_t)x->stride, rate);
    gvi__count(&st->counters.effect[st->in.clock], x->count);
    const int failed = clock->points(&at, clock->user);
    if (failed) return gvi__report_callback(st, failed, st->in.clock);
    for (int k = 0; k < x->count; ++k) {
        if (rate[k] <= 0) return gvi__report(st, GVI_E_CLOCK, st->in.clock, GVI_FAULT_NONE, k);
        if (st->in.diagnose && !gvi__finite(rate[k]))
            return gvi__report(st, GVI_E_NON_FINITE, st->in.clock, GVI_FAULT_NONE, k);
    }
    if (!st->in.diagnose) return GVI_OK;
    return gvi__check_rows(st, x, slope, st->in.clock);
}

// g at one configuration; slope of length n gets dg/dq
static gvi_status gvi__clock_at(gvi_stepper *st, gvi_real t, const gvi_real *q, gvi_real *rate,
                                gvi_real *slope)
{
    const gvi_points at = gvi__one_point(st, &t, q);
    return gvi__rate(st, &at, rate, slope);
}

// z := sum_j T_j h b_j source_j at all points: the rule of Q
static void gvi__time_sums(const gvi_stepper *st, const gvi_real *source, gvi_real *z)
{
    const struct gvi__private *in = &st->in;
    const gvi_real *L = gvi__weighted(in->R, in->sized.hb, source, in->row);
    for (int k = 0; k < in->R; ++k) z[k] = gvi__point_sum(st->r, in->R, in->table.T + k, L);
}

/* H - E for a coordinate whose force is F: unchanged, unless its rounding, within `none`, would
   push a light body by more than 1024 eps of F; then 0 up to `none`, unchanged from 2 none on. */
static gvi_real gvi__sure_level(gvi_real level, gvi_real none, gvi_real slope, gvi_real F)
{
    const gvi_real limit = GVI__SURE*GVI__EPS*F, push = GVI_ABS(slope)*none, size = GVI_ABS(level);
    if (push <= limit) return level;
    if (push < 2*limit) none *= push/limit - 1;
    gvi_real sure = size;
    if (size < 2*none) sure = 2*(size - none);
    if (size <= none) sure = 0;
    if (level < 0) return -sure;
    return sure;
}

/* With a clock: forces first, for their power f'v; then all else, with values.  What it makes
   of F and V: F := g F - dg/dq (H - E), V := g v, with H = (P + A)'v/2 + V_pot - L, and E, with
   the work of the forces, and the times by the rule of Q.                                     */
static gvi_status gvi__evaluate_with_clock(gvi_stepper *st, const gvi__origin *from, gvi_points *y)
{
    struct gvi__private *in = &st->in;
    const struct gvi__values *w = &in->work;
    const int n = st->n, r = st->r, R = in->R;
    const unsigned forces = gvi__of_kind(in, GVI_FORCE);
    gvi_real *g = in->time.rate, *power = in->time.power, *level = in->time.level,
             *L = in->time.lagrangian, *noise = in->row + R;
    gvi_status status = gvi__effects(st, y, ~forces, NULL);
    gvi__zero((size_t)R, power);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < r; ++k) power[k] += w->F[i*R + k]*w->V[i*R + k];
    gvi__zero((size_t)R, level);
    gvi__zero((size_t)R, L);
    if (status == GVI_OK && gvi__mass_is(in, GVI_MASS_POSITION)) status = gvi__mass_gradient(st, y);
    if (status == GVI_OK) status = gvi__effects(st, y, forces, level);
    if (status == GVI_OK) status = gvi__rate(st, y, g, in->time.slope);
    if (status != GVI_OK) return status;

    // level := H - E; noise: what rounding makes of it
    for (int k = 0; k < R; ++k) {
        noise[k] = GVI_ABS(level[k]) + GVI_ABS(L[k]) + GVI_ABS(from->E);
        level[k] -= L[k] + from->E;
        power[k] *= g[k];
    }
    if (forces & ~in->off) {
        gvi__time_sums(st, power, L);
        for (int k = 0; k < R; ++k) level[k] -= L[k];
    }
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < R; ++k) {
            const int at = i*R + k;
            gvi_real P = w->P[at];
            if (w->A) P += w->A[at];
            const gvi_real twice = P*w->V[at];
            level[k] += twice/2;
            noise[k] += GVI_ABS(twice)/2;
        }

    for (int i = 0; i < n; ++i) {
        gvi_real *F = w->F + i*R, *V = w->V + i*R, largest = 0;
        const gvi_real *slope = in->time.slope + i*R;
        for (int k = 0; k < R; ++k) {
            F[k] *= g[k];
            V[k] *= g[k];
            if (k < r && GVI_ABS(F[k]) > largest) largest = GVI_ABS(F[k]);
        }
        for (int k = 0; k < r; ++k) {
            const gvi_real none = GVI__SOLVED*GVI__EPS*noise[k];
            F[k] -= slope[k]*gvi__sure_level(level[k], none, slope[k], largest);
        }
    }
    gvi__time_sums(st, g, L);
    for (int k = 0; k < R; ++k) in->t[k] = from->t + (from->t_low + L[k]);
    return GVI_OK;
}

/* ---- velocities, increments ---- */

/* Momenta: V from the new P with the old M(Q) and dL/dv, so that an iteration contracts twice
   as fast.  Where Lagrangian terms make V it can diverge while Q and P hardly change: returns its
   squared relative change at the last point, times r as if summed over all.                   */
static gvi_real gvi__velocities_again(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, clock = gvi__clock_is_on(st),
              made = GVI__LAGRANGIAN && in->work.A;
    const gvi_real *V = in->work.V + st->r - 1;
    gvi_real *was = in->result, sum = 0;
    // before the first evaluation Q, g and M(Q) are those of another step
    if (!in->has_factor && (clock || in->desc.mass.velocity || !gvi__mass_is_constant(in)))
        return 0;
    if (made) gvi__gather(n, R, V, was);
    gvi__count(&st->counters.velocities, st->r);
    const gvi_points at = gvi__points_at(st, st->r, R, in->t, in->work.Q, NULL, NULL);
    // where that fails it does so again with the new Q
    if (in->desc.mass.velocity) (void)gvi__evaluate_mass(st, &at, in->work.P, in->work.V);
    else gvi__velocity_rows(st);
    if (clock)
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < R; ++k) in->work.V[i*R + k] *= in->time.rate[k];
    if (!made) return 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real moved = V[i*R] - was[i], size = GVI_ABS(V[i*R]) + GVI_ABS(was[i]);
        if (size > GVI__NOTHING) sum += (moved/size)*(moved/size);
    }
    return (gvi_real)st->r*sum;
}

// the sums k and k + half of double words, to k; a constant `half` makes vectors of it
GVI__BODY void gvi__fold(int half, gvi_real *hi, gvi_real *lo)
{
    for (int k = 0; k < half; ++k) {
        const gvi__two s = gvi__add_low(hi[k], lo[k], hi[k + half], lo[k + half]);
        hi[k] = s.hi;
        lo[k] = s.lo;
    }
}

/* sum_j a_j b_j with its low word, since the errors of increments add up over the steps.  Eight
   partial sums, then these by halves; past the last point the numbers are 0.                  */
GVI__BODY gvi__two gvi__exact_dot(int R, const gvi_real *a, const gvi_real *b)
{
    gvi_real hi[8] = { 0 }, lo[8] = { 0 };
    for (int k = 0; k < 8 && k < R; ++k) {
        const gvi__two z = gvi__two_prod(a[k], b[k]);
        hi[k] = z.hi;
        lo[k] = z.lo;
    }
    for (int o = 8; o < R; o += 8)
        for (int k = 0; k < 8; ++k) {
            const gvi__two z = gvi__two_prod(a[o + k], b[o + k]),
                           s = gvi__add_low(hi[k], lo[k], z.hi, z.lo);
            hi[k] = s.hi;
            lo[k] = s.lo;
        }
    if (R >= 8) gvi__fold(4, hi, lo);
    gvi__fold(2, hi, lo);
    gvi__fold(1, hi, lo);
    return gvi__two_of(hi[0], lo[0]);
}

// increments := sums of h b times rows, their low words with those of the start
static void gvi__sum_rows(const gvi_stepper *st, gvi_real *rows, const gvi_real *low, gvi_real *sum,
                          gvi_real *sum_low)
{
    const int R = st->in.R;
    for (int i = 0; i < st->n; ++i, rows += R) {
        // a callback may have left anything there
        for (int k = st->r; k < R; ++k) rows[k] = 0;
        gvi__two z;
        if (R == 8) z = gvi__exact_dot(8, st->in.sized.hb, rows);
        else if (R == 4) z = gvi__exact_dot(4, st->in.sized.hb, rows);
        else z = gvi__exact_dot(R, st->in.sized.hb, rows);
        sum[i] = z.hi;
        sum_low[i] = gvi__low(z.lo + low[i]);
    }
}

// sum_j (1 - c_j) w_j F_j with its low word
GVI__CALLED gvi__two gvi__moment(int count, const gvi_real *c, const gvi_real *w, const gvi_real *F)
{
    gvi__two sum = gvi__two_of(0, 0);
    for (int j = 0; j < count; ++j) {
        const gvi__two push = gvi__two_prod(w[j], F[j]), z = gvi__two_prod(1 - c[j], push.hi);
        sum = gvi__add_low(sum.hi, sum.lo, z.hi, z.lo + (1 - c[j])*push.lo);
    }
    return sum;
}

// dp from the F at the points and the forces of constraint at theirs
static void gvi__momentum_increment(gvi_stepper *st, const gvi__origin *from)
{
    struct gvi__private *in = &st->in;
    gvi__sum_rows(st, in->work.F, from->p_low, in->step.p, in->step.p_low);
    if (!gvi__constrained(st)) return;
    for (int i = 0; i < st->n; ++i) {
        const gvi__two z = gvi__exact_dot(in->R, in->con.hw, in->con.force + i*in->R),
                       p = gvi__add_low(in->step.p[i], in->step.p_low[i], z.hi, z.lo);
        in->step.p[i] = p.hi;
        in->step.p_low[i] = p.lo;
    }
}

enum { GVI__GO_ON, GVI__DONE, GVI__ONCE_MORE, GVI__DIVERGES, GVI__NOT_FINITE };

// M_ii, or p_i/v_i where the effects alone make the mass, where F was evaluated last: first point
static gvi_real gvi__inertia(const gvi_stepper *st, int i)
{
    const struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n, ii = (size_t)i*(n + 1);
    const size_t iR = (size_t)i*(size_t)in->R;
    gvi_real m;
    if (in->desc.mass.kind == GVI_MASS_DENSE) m = in->mass.matrix[ii];
    else if (gvi__mass_is(in, GVI_MASS_POSITION)) m = in->mass.at_points[ii*(size_t)in->R];
    else if (gvi__mass_is(in, GVI_MASS_NONE)) m = in->work.P[iR]/in->work.V[iR];
    else m = in->mass.matrix[i];
    if (!gvi__nonzero(m) || !gvi__finite(m)) return 1;
    // the momenta formulation factors M(q) in place: 1/D_i is there
    if (gvi__mass_is(in, GVI_MASS_POSITION) && st->formulation == GVI_MOMENTA && in->has_factor
        && !in->desc.mass.velocity) m = 1/m;
    return GVI_ABS(m);
}

/* ----------------------------------------------------------- CONSTRAINTS */

/* g(t,q) = 0 at Lobatto's points d_0 = 0 .. d_s = 1, weights w_e.  What makes h sum_i b_i L_i
   + h sum_e w_e lambda_e . g(D_e) stationary acts by impulses at these points, one more source of
   the same tables, and D_a = q(d_a h) is one more stage (for P_i in (5) as for V_i in (4)):

     R_e = w_e h G(D_e)' lambda_e                              e = 0..s-1
     Q_i += h M^-1 sum_e (c_i - S(c_i, d_e)) R_e               S(x, y) = Phi(x)' Gamma^-1 Phi(y)
     V_i += M^-1 sum_e (1 - T(c_i, d_e)) R_e                   T(x, y) = phi(x)' Gamma^-1 Phi(y)
     D_a  = q0 + h d_a v0 + h M^-1 (sum_j K(d_a, c_j) h b_j F_j + sum_e K(d_a, d_e) R_e)
     p1   = p0 + h sum_i b_i F_i + sum_e R_e + G(q1)' y        K(x, y) = x - S(x, y)

   y from G(q1) v1 + dg/dt = 0.  Every iteration has one simplified Newton step for lambda: G at the
   last D, D' what the new forces and the old lambda make, X the inverse of K(d_a, d_e), a > 0,

     rho_a = g(D_a) + G_a (D'_a - D_a)   lambda_e -= (G_e M^-1 G_e')^-1 sum_a X_ea rho_a/(h^2 w_e)

   Sources e = 0..s-1 and D_1..D_s are rows of R, as forces and stage values; what is evaluated at
   D_0..D_s, rows of C; at one point, numbers at the beginning of these.  Rows that are off are left
   out.                                                                                        */

static unsigned gvi__constraints_on(const gvi_stepper *st) { return st->in.con.bits & ~st->in.off; }

static int gvi__count_rows(const struct gvi__private *in, unsigned bits)
{
    int rows = 0;
    for (int e = 0; e < in->desc.effect_count; ++e)
        if (bits >> e & 1u) rows += in->desc.effects[e].rows;
    return rows;
}

// row `row` of those that are on is at fault: which effect, and which row of it?
GVI__COLD gvi_status gvi__report_row(gvi_stepper *st, gvi_status status, int row, int point)
{
    const gvi_effect *effects = st->in.desc.effects;
    int e = 0;
    for (; !(gvi__constraints_on(st) >> e & 1u) || row >= effects[e].rows; ++e)
        if (gvi__constraints_on(st) >> e & 1u) row -= effects[e].rows;
    return gvi__report(st, status, e, row, point);
}

// of the columns of row a that are read and cleared, the first from i on; n: there is none
GVI__BODY int gvi__column(const gvi_stepper *st, int a, int i)
{
    return (int)st->in.con.column[a*(st->n + 1) + i];
}

// g and dg/dt to con.g, and G, at `count` points
static gvi_status gvi__evaluate_constraints(gvi_stepper *st, int S, int count, const gvi_real *t,
                                            const gvi_real *q, gvi_real *G)
{
    gvi_points at = gvi__points_at(st, count, S, t, q, NULL, NULL);
    gvi_status status = GVI_OK;
    at.g = st->in.con.g;
    at.rate = at.g + st->in.con.m*S;
    at.jacobian = G;
    gvi__zero((size_t)(st->in.con.m*S), at.rate);
    for (int a = 0; a < st->in.con.m; ++a)
        for (int i = gvi__column(st, a, 0), to; i < st->n; i = gvi__column(st, a, to)) {
            for (to = i + 1; gvi__column(st, a, to) == to && to < st->n; ++to) { }
            gvi__zero((size_t)((to - i)*S), G + (size_t)(a*st->n + i)*(size_t)S);
        }
    if (st->in.diagnose && gvi__check_rows(st, &at, q, 0) != GVI_OK)
        return gvi__report_status(st, GVI_E_CONVERGENCE);
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        const gvi_effect *effect = st->in.desc.effects + e;
        if (!(gvi__constraints_on(st) >> e & 1u)) continue;
        gvi__count(&st->counters.effect[e], count);
        const int failed = effect->points(&at, effect->user);
        if (failed) return gvi__report_callback(st, failed, e);
        if (st->in.diagnose) {
            gvi_points rows = at;
            rows.n = effect->rows;
            status = gvi__check_rows(st, &rows, at.g, e);
            if (status == GVI_OK) status = gvi__check_rows(st, &rows, at.rate, e);
            if (status != GVI_OK) return status;
            rows.n *= st->n;
            status = gvi__check_rows(st, &rows, at.jacobian, e);
            if (status != GVI_OK) {
                st->fault.coordinate /= st->n;
                return status;
            }
        }
        at.g += effect->rows*S;
        at.rate += effect->rows*S;
        at.jacobian += effect->rows*st->n*S;
    }
    return GVI_OK;
}

/* z := M^-1 z.  M(q) is that of the stage values, one for one, or of the one point, where with
   Lagrangian terms M is d2L/dv2, of which gvi__constraints_at has made the LU.               */
static void gvi__over_inertia(const gvi_stepper *st, gvi_real *z, int S, int count)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n;
    const gvi_real *lu = in->newton.hessian;
    if (S == 1 && gvi__has(in, GVI__HAS_LAGRANGIAN)) gvi_lu_solve(n, lu, lu + n*n, z);
    else if (!gvi__mass_is(in, GVI_MASS_POSITION)) gvi__over_mass(st, z, S, count);
    else gvi__ldl_solve(n, in->mass.at_points, S > 1 ? in->R : 1, z, S, count);
}

static int gvi__all_zero(const gvi_real *x)
{
    const gvi_real a = GVI_ABS(x[0]) + GVI_ABS(x[4]), b = GVI_ABS(x[1]) + GVI_ABS(x[5]),
                   c = GVI_ABS(x[2]) + GVI_ABS(x[6]), d = GVI_ABS(x[3]) + GVI_ABS(x[7]);
    return (a + b) + (c + d) <= 0;
}

/* The columns of each row in which G has had an entry other than 0.  They are looked for at the
   ends of steps, and within the first step after a start; a step at whose end there are new ones
   is done again.  An entry that is 0 at both ends of a later step counts as 0
   inside.  first[a]: the first row that shares a coordinate with row a, where L begins; all rows
   do through a full M.                                                                        */
static int gvi__find_columns(gvi_stepper *st, int S, int count, const gvi_real *G)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *const top = in->point;
    int grown = 0;
    for (int a = 0; a < m; ++a) {
        gvi_real *column = in->con.column + a*(n + 1);
        const gvi_real *row = G + (size_t)(a*n)*(size_t)S;
        for (int i = 0; i < n; ++i) {
            while (S == 1 && i + 8 <= n && gvi__all_zero(row + i)) i += 8;
            if (i == n || (int)column[i] == i || gvi__norm1(count, row + i*S) <= 0) continue;
            for (int j = i; j >= 0 && (int)column[j] > i; --j) column[j] = (gvi_real)i;
            grown = 1;
        }
    }
    if (!grown) return 0;
    for (int i = 0; i < n; ++i) top[i] = (gvi_real)m;
    for (int a = 0; a < m; ++a) {
        gvi_real first = gvi__full_mass(in) ? 0 : (gvi_real)a;
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1)) {
            top[i] = gvi__smaller((gvi_real)a, top[i]);
            first = gvi__smaller(top[i], first);
        }
        in->con.first[a] = first;
    }
    return 1;
}

// G_a z at one point
static gvi_real gvi__row_dot(const gvi_stepper *st, const gvi_real *G, int a, const gvi_real *z)
{
    gvi_real sum = 0;
    for (int i = gvi__column(st, a, 0); i < st->n; i = gvi__column(st, a, i + 1))
        sum += G[a*st->n + i]*z[i];
    return sum;
}

/* A := L D L' of G M^-1 G' in its envelope, L below the diagonal, 1/D on it and D L' above it; M(q)
   is that of the stage values, one for one, or of the one point.  A pivot of 64 m roundings says
   that a row depends on those before it.  At the first point it is then left out: 1/D and its L
   are 0, and so is its multiplier; drops[a] is what the diagonal entry was, or 0 for a row that is
   kept.  At the other points the same rows are left out, and the rest has to have full rank.    */
static gvi_status gvi__factor_constraints(gvi_stepper *st, int S, int count, const gvi_real *G,
                                          gvi_real *A, gvi_real *drops)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, full = gvi__full_mass(in);
    const gvi_real *first = in->con.first, least = GVI__GRAIN*(gvi_real)m*GVI__EPS;
    gvi_real *W = in->con.W;
    gvi__zero((size_t)(n*S), W);
    for (int i = 0; i < m; ++i) {
        const int from = (int)first[i];
        gvi_real *d = A + (i*m + i)*S;
        // W = - M^-1 G_i'
        for (int j = gvi__column(st, i, 0); j < n; j = gvi__column(st, i, j + 1)) {
            const gvi_real *g = G + (i*n + j)*S, inverse = full ? 1 : in->mass.inverse[j];
            for (int k = 0; k < count; ++k) W[j*S + k] = -(g[k]*inverse);
        }
        if (full) gvi__over_inertia(st, W, S, count);
        for (int j = from; j <= i; ++j) {
            gvi_real *u = A + (j*m + i)*S;
            for (int k = 0; k < count; ++k) u[k] = 0;
            for (int l = gvi__column(st, j, 0); l < n; l = gvi__column(st, j, l + 1))
                gvi__subtract_at(S, count, G + (j*n + l)*S, W + l*S, u);
            if (j == i) break;
            int l = (int)first[j];
            if (l < from) l = from;
            for (; l < j; ++l) gvi__subtract_at(S, count, A + (j*m + l)*S, A + (l*m + i)*S, u);
        }
        if (full) gvi__zero((size_t)(n*S), W);
        for (int j = gvi__column(st, i, 0); j < n; j = gvi__column(st, i, j + 1))
            for (int k = 0; k < count; ++k) W[j*S + k] = 0;
        for (int k = 0; k < count; ++k) {
            const gvi_real was = GVI_ABS(d[k]);
            gvi_real rest = d[k];
            for (int j = from; j < i; ++j) {
                const gvi_real u = A[(j*m + i)*S + k], l = u*A[(j*m + j)*S + k];
                A[(i*m + j)*S + k] = l;
                rest -= l*u;
            }
            const int depends = !(GVI_ABS(rest) > least*was);
            if (!(was <= GVI__MAX) || !gvi__finite(rest))
                return gvi__report_status(st, GVI_E_NON_FINITE);
            if (k == 0) drops[i] = depends ? was : 0;
            d[k] = drops[i] > 0 ? 0 : 1/rest;
            if (!gvi__finite(d[k]) || (depends && !(drops[i] > 0)))
                return gvi__report_row(st, GVI_E_SINGULAR, i, k);
        }
    }
    return GVI_OK;
}

// rows z [m][R] := A^-1 z, at points or at one; 0 for rows that are left out
static void gvi__solve_constraints(const gvi_stepper *st, const gvi_real *A, int S, int count,
                                   gvi_real *z, int R)
{
    const int m = st->in.con.m;
    const gvi_real *first = st->in.con.first;
    for (int i = 0; i < m; ++i)
        for (int j = (int)first[i]; j < i; ++j)
            gvi__subtract_at(S, count, A + (i*m + j)*S, z + j*R, z + i*R);
    for (int i = m; i-- > 0; ) {
        gvi_real *row = z + i*R;
        for (int k = 0; k < count; ++k) row[k] *= A[(i*m + i)*S + k];
    }
    for (int i = m; i-- > 0; )
        for (int j = (int)first[i]; j < i; ++j)
            gvi__subtract_at(S, count, A + (i*m + j)*S, z + i*R, z + j*R);
}

// g, dg/dt, G and A at one configuration; where M depends on v, at that which p makes of v
static gvi_status gvi__constraints_at(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p, gvi_real *v, gvi_real *drops)
{
    const int n = st->n;
    gvi_real *G = st->in.con.G1, *H = st->in.newton.hessian;
    gvi_points at = gvi__one_point(st, &t, q);
    gvi_status status = gvi__evaluate_constraints(st, 1, 1, &t, q, G);
    if (status == GVI_OK && (drops != st->in.con.drops || !st->in.con.settled))
        st->in.con.again |= gvi__find_columns(st, 1, 1, G);
    if (status == GVI_OK && gvi__has(&st->in, GVI__HAS_LAGRANGIAN)) {
        if (p) status = gvi__velocity(st, t, q, p, v);
        at.v = v;
        if (status == GVI_OK) status = gvi__evaluate(st, &at, 0, 1);
        if (status == GVI_OK) status = gvi__velocity_hessian(st, &at, v, H);
        if (status == GVI_OK && gvi_lu_factor(n, H, H + n*n) != GVI_OK)
            return gvi__report_effect(st, GVI_E_SINGULAR, GVI_FAULT_MASS);
    } else if (status == GVI_OK && gvi__mass_is(&st->in, GVI_MASS_POSITION))
        status = gvi__factor_mass(st, &at);
    return status == GVI_OK ? gvi__factor_constraints(st, 1, 1, G, st->in.con.A1, drops) : status;
}

// z += G' y at one point
static void gvi__add_force(const gvi_stepper *st, const gvi_real *y, gvi_real *z)
{
    for (int a = 0; a < st->in.con.m; ++a)
        for (int i = gvi__column(st, a, 0); i < st->n; i = gvi__column(st, a, i + 1))
            z[i] += y[a]*st->in.con.G1[a*st->n + i];
}

// sum of |G_ai q_i| and |t dg_a/dt|: what is known of the size of g_a's terms, at one point
static gvi_real gvi__terms(const gvi_stepper *st, int S, gvi_real t, const gvi_real *q,
                           const gvi_real *G, const gvi_real *rate, int a)
{
    gvi_real size = GVI_ABS(rate[a*S]*t);
    for (int i = gvi__column(st, a, 0); i < st->n; i = gvi__column(st, a, i + 1))
        size += GVI_ABS(G[(a*st->n + i)*S]*q[i*S]);
    return size;
}

/* ---- in the iteration ---- */

// h w and the times of D, for a step of length h
static void gvi__constraint_points(const gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    const struct gvi__private *in = &st->in;
    for (int e = 0; e < in->R; ++e) in->con.hw[e] = e < st->s ? h*in->con.w[e] : 0;
    gvi__times(in->con.C, from->t, from->t_low, h, in->con.d, in->con.t);
}

/* One more sum in the stages; free motion and times of D.  P or V is not judged: lambda turns the
   rounding of D into X eps/h, across the constraints, where no motion feels it.              */
GVI__CALLED void gvi__constraint_stages(const gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                   gvi__stage *stage, int stages)
{
    const struct gvi__private *in = &st->in;
    const int R = in->R, momenta = gvi__has(in, GVI__BY_MOMENTA);
    gvi__constraint_points(st, from, h);
    for (int k = 0; k < (momenta ? 1 : stages); ++k) {
        stage[k].sum[1].table = momenta || k == 1 ? in->con.U : in->con.K;
        stage[k].sum[1].weight = in->con.hw;
        stage[k].sum[1].source = in->con.force;
    }
    if (stages == 2) {
        stage[!momenta].scale = NULL;
        gvi__zero((size_t)st->n, in->watch.change + !momenta*st->n);
        gvi__zero((size_t)st->n, in->watch.before + !momenta*st->n);
    }
    for (int i = 0; i < st->n; ++i)
        gvi__free_row(R, from->q_low[i], momenta ? 0 : in->free.path[i],
                      momenta ? 0 : in->free.path_low[i], in->con.d + 1, in->con.free + i*R);
}

// D, from the stage that makes Q
GVI__CALLED void gvi__constraint_rows(const gvi_stepper *st, const gvi__stage *stage)
{
    const struct gvi__private *in = &st->in;
    gvi__stage z = stage[gvi__has(in, GVI__BY_MOMENTA)];
    z.sum[0].table = in->con.by_force;
    z.sum[1].table = gvi__has(in, GVI__BY_MOMENTA) ? NULL : in->con.by_impulse;
    z.rows = in->con.D;
    z.base = in->zeros;
    z.free = in->con.free;
    z.scale = z.change = NULL;
    if (z.dense) gvi__dense_rows(st, &z, 0);
    else in->kernel(st, &z, 0);
}

// G' lambda at the sources; the rows behind the forces hold -lambda
static void gvi__constraint_forces(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, C = in->con.C;
    gvi__zero((size_t)(n*R), in->con.force);
    for (int a = 0; a < in->con.m; ++a)
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            gvi__subtract_at(C, st->s, in->con.G + (a*n + i)*C, in->con.force + (n + a)*R,
                             in->con.force + i*R);
}

// sum_a |G_a z_a| at the sources, to rows of S numbers; z [m][R]
static void gvi__force_sizes(const gvi_stepper *st, const gvi_real *z, int S, gvi_real *sum)
{
    const int n = st->n, C = st->in.con.C;
    gvi__zero((size_t)(n*S), sum);
    for (int a = 0; a < st->in.con.m; ++a, z += st->in.R)
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            for (int e = 0; e < st->s; ++e)
                sum[i*S + e] += GVI_ABS(st->in.con.G[(a*n + i)*C + e]*z[e]);
}

/* Is row a of G the derivative of g?  A move dD of D changes g by (G + G') dD/2, from both ends,
   to third order.  Any further change of g, `missed`, shows a wrong entry where it is above
   1/512 of size = sum |G' dD| and above twice bend = |(G' - G) dD|, and keeps its share of size in
   four iterations in a row that each move less; eight, but by Newton's method, where G is
   constant and that share is above 1/8.  Rounding does not: it is at most EPS terms from known
   terms, and about EPS size^2/bend from those that G q does not show.                         */
static int gvi__beyond_rounding(gvi_real missed, gvi_real bend, gvi_real size)
{
    return bend > GVI__SOLVED*GVI__EPS*size && missed*bend > GVI__GRAIN*GVI__EPS*size*size;
}

GVI__CALLED gvi_status gvi__check_jacobian(gvi_stepper *st, int a, gvi_real missed,
                                           gvi_real changed, gvi_real bend, gvi_real size,
                                           gvi_real terms)
{
    gvi_real *wrong = st->in.con.doubt, *was = wrong + 1 + 3*a;   // a row or -1; share, size, times
    const gvi_real share = missed/size;
    if (size < was[1] && share < 2*was[0] && was[0] < 2*share) was[2] += 1;
    else was[2] = 1;
    // where g has not changed at all, it was its rounding that hid the move
    if (!(missed > size/GVI__WRONG && missed > 2*bend && missed > GVI__GRAIN*GVI__EPS*terms)
        || !(changed*GVI__SURE > size)
        || (bend > GVI__SOLVED*GVI__EPS*size && !gvi__beyond_rounding(missed, bend, size)))
        was[2] = 0;
    was[0] = share;
    was[1] = size;
    // moves that are rounding alone may shrink a few times, to a share that is not small
    const int constant = bend <= GVI__EPS*size && st->formulation != GVI_NEWTON;
    if (!(was[2] > (constant && share*8 > 1 ? 7 : 3))) return GVI_OK;
    if (wrong[0] < 0) wrong[0] = (gvi_real)a;
    return gvi__report_status(st, GVI_E_CONVERGENCE);
}

// in steps 1, 2, 3, 5, 9 .. after a start, and after 8 iterations: so it costs nothing
static int gvi__looks_at_jacobian(const gvi_stepper *st)
{
    const int steps = st->in.con.settled;
    return st->in.con.made > 0 && (st->in.con.made > 8 || (steps & (steps - 1)) == 0);
}

// suspected now and, after the second iteration, in the last: what row a misses is no rounding
static int gvi__doubted(const gvi_stepper *st, int a)
{
    return gvi__looks_at_jacobian(st) && st->in.con.doubt[3*a + 3] > (st->in.con.made > 2);
}

/* The constraints at D, padded with q0.  After a move along which G changed by less than EPS of it,
   or one of EPS^(3/4) (not in float, where a step across a bifurcation would end on the wrong
   branch), g is linearised from the last D: its rounding would change lambda for ever, and is not
   that of D where g has terms that G q does not show.                                        */
static gvi_status gvi__evaluate_at_D(gvi_stepper *st, const gvi__origin *from)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R, C = in->con.C;
    const int linear = in->con.linear, looks = gvi__looks_at_jacobian(st),
              rows = looks || st->formulation != GVI_NEWTON ? m : 0;         // to compare
    const gvi_real *G = in->con.G + 1, *moved = in->con.W;
    gvi_real *along = in->con.rho + m*R;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < C; ++k) {
            gvi_real *at = in->con.at + i*C + k;
            const gvi_real D = from->q[i] + (k > 0 && k <= s ? in->con.D[i*R + k - 1] : 0);
            if (k > 0) in->con.W[i*C + k - 1] = *at - D;
            *at = D;
        }
    gvi__zero((size_t)(m*C), along);              // by the old G
    for (int a = 0; a < rows; ++a) {
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            gvi__subtract_at(C, s, G + (a*n + i)*C, moved + i*C, along + a*C);
        for (int k = 0; k < s; ++k) in->con.rho[a*R + k] = in->con.g[a*C + k + 1] + along[a*C + k];
    }
    gvi_status status =
        gvi__evaluate_constraints(st, C, s + 1, in->con.t, in->con.at, in->con.G);
    if (!in->con.settled && gvi__find_columns(st, C, s + 1, in->con.G)) in->con.made = 0;
    in->con.linear = in->con.made > 0;
    for (int a = 0; a < rows; ++a) {
        gvi_real missed = 0, changed = 0, bend = 0, all = 0, terms = 0;
        for (int k = 0; k < s; ++k) {
            gvi_real change = along[a*C + k], size = 0;
            if (!in->con.linear && !looks) break;
            for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1)) {
                const gvi_real z = G[(a*n + i)*C + k]*moved[i*C + k];
                change += z;
                size += GVI_ABS(z);
            }
            if (!(GVI_ABS(change) <= GVI__EPS*size)) in->con.linear = 0;
            const gvi_real beyond = in->con.g[a*C + k + 1] - in->con.rho[a*R + k];
            missed += GVI_ABS(beyond + change/2);
            changed += GVI_ABS(beyond + along[a*C + k]);
            bend += GVI_ABS(change);
            all += size;
            if (looks)
                terms += gvi__terms(st, C, in->con.t[k + 1], in->con.at + k + 1, G + k,
                                    in->con.g + m*C + k + 1, a);
        }
        if (looks && status == GVI_OK)
            status = gvi__check_jacobian(st, a, missed, changed, bend, all, terms);
        if (linear && !gvi__doubted(st, a)) {
            gvi__copy((size_t)s, in->con.rho + a*R, in->con.g + a*C + 1);
            in->con.doubt[3*a + 3] = 0;
        }
    }
    in->con.made += 1;
    return status;
}

// the same, and A in the first iteration
GVI__CALLED gvi_status gvi__constraint_values(gvi_stepper *st, const gvi__origin *from)
{
    const gvi_status status = gvi__evaluate_at_D(st, from);
    if (status != GVI_OK || st->in.con.made > 1) return status;
    return gvi__factor_constraints(st, st->in.con.C, st->s, st->in.con.G, st->in.con.A,
                                   st->in.con.drops);
}

// the new lambda, and forces.  With momenta D' needs the P and V of the new F
GVI__CALLED void gvi__constrain(gvi_stepper *st, const gvi__stage *stage, const gvi_real *q0)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R, C = in->con.C;
    gvi_real *lambda = in->con.force + n*R, *rho = in->con.rho, *moved = in->con.W;
    gvi__constraint_forces(st);
    if (gvi__has(in, GVI__BY_MOMENTA)) {
        gvi_real *const P = in->work.P;
        gvi__stage z = stage[0];
        z.rows = in->work.P = in->con.P;
        z.scale = z.change = NULL;
        in->kernel(st, &z, 0);
        gvi__velocities_again(st);
        in->work.P = P;
    }
    gvi__constraint_rows(st, stage);
    for (int i = 0; i < n; ++i) {                 // D - D'
        gvi_real *GVI__RESTRICT z = moved + i*C;
        const gvi_real *at = in->con.at + i*C + 1, *D = in->con.D + i*R;
        for (int e = 0; e < s; ++e) z[e] = (at[e] - q0[i]) - D[e];
    }
    gvi__zero((size_t)(m*R), rho);
    for (int a = 0; a < m; ++a) {
        gvi_real *g = rho + m*R + a*C;             // gvi__constraints_moved reads it
        gvi__copy((size_t)s, in->con.g + a*C + 1, g);
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            gvi__subtract_at(C, s, in->con.G + (a*n + i)*C + 1, moved + i*C, g);
        for (int b = 0; b < s; ++b) gvi__subtract_row((size_t)R, -g[b], in->con.X + b*R, rho + a*R);
    }
    gvi__solve_constraints(st, in->con.A, C, s, rho, R);
    for (int a = 0; a < m; ++a)
        for (int e = 0; e < s; ++e) lambda[a*R + e] += rho[a*R + e]/(in->sized.h*in->con.hw[e]);
    gvi__constraint_forces(st);
}

// |G|'|rho| of lambda's last change, or 0 if that was not all rounding, 8 eps of the known terms
GVI__CALLED void gvi__constraints_moved(const gvi_stepper *st, gvi_real *moved)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, R = in->R, C = in->con.C;
    gvi__zero((size_t)(n*C), moved);
    for (int a = 0; a < m; ++a)
        for (int k = 1; k <= st->s; ++k) {
            const gvi_real terms = gvi__terms(st, C, in->con.t[k], in->con.at + k, in->con.G + k,
                                              in->con.g + m*C + k, a);
            if (!(GVI_ABS(in->con.rho[m*R + a*C + k - 1]) <= 8*GVI__EPS*terms)) return;
        }
    gvi__force_sizes(st, in->con.rho, C, moved);
}

// forces and lambda to begin with: those of the last step, extrapolated, or none
GVI__CALLED void gvi__predict_constraints(const gvi_stepper *st, int extrapolate)
{
    const struct gvi__private *in = &st->in;
    const int R = in->R, rows = st->n + in->con.m;
    gvi__zero((size_t)(rows*R), in->con.force);
    if (!extrapolate || in->con.kept < 2) return;
    for (int i = 0; i < rows; ++i)
        for (int e = 0; e < st->s; ++e)
            in->con.force[i*R + e] = gvi__point_sum(st->s, R, in->con.E + e,
                                                   in->con.last + i*in->con.C + 1);
}

// what the pivot of a row has lost at a point, in units of what is left of it
GVI__COLD gvi_real gvi__loss(const gvi_stepper *st, int row, int point)
{
    const int m = st->in.con.m, C = st->in.con.C;
    const gvi_real *A = st->in.con.A + point;
    gvi_real lost = 0;
    for (int l = (int)st->in.con.first[row]; l < row; ++l)
        lost += A[(row*m + l)*C]*A[(l*m + row)*C];
    return lost*A[(row*m + row)*C];
}

/* RATTLE: the drift from p to g(q1) = 0 by impulses G0' mu, from a simplified Newton iteration.  A
   row is rounding if it exceeds by a quarter what its last correction, and the change of G along
   it, should have left.  An error four times the least so far is divergence.                  */
GVI__CALLED gvi_status gvi__constrained_drift(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real before = 0, least = GVI__MAX, *Q = in->work.Q, *z = in->con.rho, *left = in->con.y,
             *d = in->con.W, *unit = d + n, *g = in->con.g,
             *G = in->con.G1 + m*n;                  // G0 is before it
    const gvi_real t = from->t + (from->t_low + h);
    gvi_status status = gvi__constraints_at(st, from->t, from->q, NULL, NULL, in->con.drops);
    gvi__zero((size_t)n, in->step.p_low);
    in->con.again = 0;
    for (int k = 0; ; ++k) {
        gvi_real size = 0;
        int finite = 1;
        if (status == GVI_OK) status = gvi__evaluate_constraints(st, 1, 1, &t, Q, G);
        in->con.made = k;
        if (status != GVI_OK) return status;
        if (k == 0 && !in->con.settled) (void)gvi__find_columns(st, 1, 1, G);
        for (int a = 0; a < m; ++a) {
            const gvi_real terms = gvi__terms(st, 1, t, Q, G, g + m, a);
            gvi_real change = -z[a], all = 0;
            for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1)) {
                change += h*(G[a*n + i]*d[i]);
                all += GVI_ABS(h*(G[a*n + i]*d[i]));
            }
            const gvi_real missed = GVI_ABS(g[a] - left[a] - change/2), bend = GVI_ABS(change);
            if (gvi__looks_at_jacobian(st))
                status = gvi__check_jacobian(st, a, missed, GVI_ABS(g[a] - left[a] + z[a]), bend,
                                             all, terms);
            if (status != GVI_OK) return status;
            const int rounding = k > 0 && !gvi__doubted(st, a)
                                 && !gvi__beyond_rounding(missed/64, bend, all)
                                 && GVI_ABS(g[a]) > (gvi_real)1.25*(GVI_ABS(left[a]) + bend);
            if (k == 0 || terms > unit[a]) unit[a] = terms;
            if (!rounding && GVI_ABS(g[a]) > size*GVI__EPS*unit[a])
                size = GVI_ABS(g[a])/(GVI__EPS*unit[a]);
            finite &= gvi__finite(g[a]);
        }
        if (finite && size <= GVI__GRAIN && k > 0 && !(size < before/2))
            return gvi__report_status(st, GVI_OK);
        if (size < least) least = size;
        // far off already, it was on its way to infinity
        if (!finite && !in->diagnose && before*GVI__EPS < (gvi_real)0.125)
            return gvi__report_status(st, GVI_E_NON_FINITE);
        if (!finite || k > 64 || size > 4*(least + 256))
            return gvi__report_status(st, GVI_E_CONVERGENCE);
        before = size;
        for (int a = 0; a < m; ++a) z[a] = -g[a]/h;
        gvi__solve_constraints(st, in->con.A1, 1, 1, z, 1);
        gvi__zero((size_t)n, d);
        gvi__add_force(st, z, d);
        gvi__add_scaled(n, 1, d, in->step.p, in->step.p);
        gvi__over_mass(st, d, 1, 1);
        gvi__add_scaled(n, h, d, in->step.q, in->step.q);
        gvi__add_scaled(n, 1, in->step.q, from->q, Q);
        for (int a = 0; a < m; ++a) z[a] = h*gvi__row_dot(st, G, a, d), left[a] = g[a] + z[a];
    }
}

/* ---- at the end of a step, and at the start ---- */

/* Is each g_a within 4096 roundings, of its known terms or as measured?  To measure, take a part of
   Newton's correction: it should remove that part of g_a, but for the change of G along it.  Not
   all of it, nor a half, since that may hit g = 0 exactly and show no rounding.               */
GVI__COLD gvi_status gvi__fulfilled(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                    const gvi_real *p, gvi_real *v)
{
    const gvi_real part = (gvi_real)0.618034, units = GVI__HELD;
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *g = in->con.g, *was = in->con.rho, *z = in->con.y, *d = in->con.W, *G = in->con.G1;
    gvi_real *next = d + n;
    int off = -1;
    for (int a = 0; a < m; ++a) {
        const gvi_real rounding = GVI__EPS*gvi__terms(st, 1, t, q, G, g + m, a);
        if (off < 0 && !(GVI_ABS(g[a]) <= units*rounding)) off = a;
        was[a] = g[a];
        z[a] = -part*g[a];
    }
    if (off < 0) return GVI_OK;
    gvi__solve_constraints(st, in->con.A1, 1, 1, z, 1);
    gvi__zero((size_t)n, d);
    gvi__add_force(st, z, d);
    gvi__over_inertia(st, d, 1, 1);
    gvi__add_scaled(n, 1, d, q, next);
    int fulfilled = gvi__evaluate_constraints(st, 1, 1, &t, next, G + m*n) == GVI_OK;
    for (int a = 0; a < m; ++a) {
        const gvi_real bend = gvi__row_dot(st, G + m*n, a, d) - gvi__row_dot(st, G, a, d),
            rounding = GVI_ABS(g[a] - (1 - part)*was[a]) - GVI_ABS(bend),
            seen = GVI__EPS*gvi__terms(st, 1, t, q, G, g + m, a);
        // what is left of a row that is left out may be a contradiction
        const int proves = rounding > seen && !(in->con.drops[m + a] > 0);
        fulfilled &= GVI_ABS(was[a]) <= units*(proves ? rounding : seen);
    }
    return fulfilled ? gvi__constraints_at(st, t, q, p, v, in->con.drops + m)
                     : gvi__report_row(st, GVI_E_CONSTRAINT, off, GVI_FAULT_NONE);
}

/* step.p += G' y such that G v + dg/dt = 0 at the end: once, and once more for the rounding of
   that, or with Lagrangian terms until that is left.  At a start, what is farther off than
   rounding is refused; for v by the kinetic energy in it, r' A^-1 r/2, r = G v + dg/dt.      */
GVI__CALLED gvi_status gvi__project(gvi_stepper *st, const gvi__origin *from, int start)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, passes = gvi__has(in, GVI__HAS_LAGRANGIAN) ? 40 : 2;
    const gvi_real t = from->t + (from->t_low + in->dt), far = GVI__HELD*GVI__EPS;
    gvi_real *q = in->result, *p = q + n, *v = p + n, *r = in->con.g, *z = in->con.rho,
             *drops = in->con.drops + m, energy = 0, size = 0, before = GVI__MAX;
    int redundant = 0;
    for (int i = 0; i < n; ++i) {
        q[i] = from->q[i] + (in->step.q[i] + in->step.q_low[i]);
        p[i] = from->p[i] + (in->step.p[i] + in->step.p_low[i]);
    }
    gvi__velocity_guess(st, v);
    in->diagnose |= start;
    gvi_status status = gvi__constraints_at(st, t, q, p, v, drops);
    if (start) in->diagnose = 0;
    for (int a = 0; a < m; ++a) {
        redundant |= drops[a] > 0;
        if (!start && status == GVI_OK && (drops[a] > 0) != (in->con.drops[a] > 0))
            status = gvi__report_row(st, GVI_E_SINGULAR, a, GVI_FAULT_NONE);
    }
    if ((start || redundant) && status == GVI_OK) status = gvi__fulfilled(st, t, q, p, v);
    if (status != GVI_OK) return status;
    gvi__zero((size_t)m, in->con.y);
    for (int pass = 0; pass < passes; ++pass) {
        int row = 0;
        size = 0;
        for (int i = 0; i < n; ++i) p[i] = from->p[i] + (in->step.p[i] + in->step.p_low[i]);
        status = gvi__velocity(st, t, q, p, v);
        if (status != GVI_OK) return status;
        energy = GVI_ABS(gvi__dot(n, p, v));
        for (int a = 0; a < m; ++a) r[a] = z[a] = -(r[m + a] + gvi__row_dot(st, in->con.G1, a, v));
        gvi__solve_constraints(st, in->con.A1, 1, 1, z, 1);
        for (int a = 0; a < m; ++a) {
            size += r[a]*z[a];
            if (r[a]*z[a] > r[row]*z[row]) row = a;
            in->con.y[a] += z[a];
        }
        if (start && pass == 0 && !(size <= GVI__MAX && size <= far*far*energy))
            return gvi__report_row(st, GVI_E_CONSTRAINT, row, GVI_FAULT_NONE);
        gvi__zero((size_t)n, p);
        gvi__add_force(st, z, p);
        for (int i = 0; i < n; ++i) {
            const gvi__two sum = gvi__add_low(in->step.p[i], in->step.p_low[i], p[i], 0);
            in->step.p[i] = sum.hi;
            in->step.p_low[i] = sum.lo;
        }
        if (pass > 0 && !(size < before/4)) break;
        before = size;
    }
    if (passes > 2 && !(size <= far*far*energy))
        return gvi__report_status(st, GVI_E_CONVERGENCE);
    // rows that are left out had no part in this; later their g shows what is wrong
    if (!start) return GVI_OK;
    for (int a = 0; a < m; ++a)
        if (drops[a] > 0 && !(r[a]*r[a] <= far*far*drops[a]*energy))
            return gvi__report_row(st, GVI_E_CONSTRAINT, a, GVI_FAULT_NONE);
    return GVI_OK;
}

// the rows are others now
GVI__COLD void gvi__forget_columns(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const size_t m = (size_t)gvi__count_rows(in, in->con.bits), C = (size_t)in->con.C;
    for (size_t k = 0; k < m*(size_t)(st->n + 1); ++k) in->con.column[k] = (gvi_real)st->n;
    gvi__zero(2*m*(size_t)st->n, in->con.G1);
    gvi__zero(m*m, in->con.A1);
    if (in->con.G) gvi__zero(m*(size_t)st->n*C, in->con.G);
    if (in->con.A) gvi__zero(m*m*C, in->con.A);
    in->con.settled = 0;
}

// are q and p, which may be those of the state, on the constraints?  Then in step.q, step.p
GVI__COLD gvi_status gvi__project_start(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                        const gvi_real *p)
{
    struct gvi__private *in = &st->in;
    const gvi__origin from = { t, 0, in->zeros, in->zeros, in->zeros, in->zeros, 0 };
    const size_t n = (size_t)st->n;
    if (q != in->step.q) gvi__copy(n, q, in->step.q);
    if (p != in->step.p) gvi__copy(n, p, in->step.p);
    gvi__zero(n, in->step.q_low);
    gvi__zero(n, in->step.p_low);
    in->dt = 0;
    return gvi__project(st, &from, 1);
}

// forces and lambda of the step, with those at its end, for the curve and the next prediction
GVI__CALLED void gvi__commit_constraints(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, C = in->con.C, rows = n + in->con.m;
    if (in->con.settled < 0x4001) in->con.settled += 1;
    in->con.kept = gvi__constrained(st) && gvi__has(in, GVI__ITERATES) ? 2 : 0;
    if (in->con.kept == 0) return;
    for (int a = n; a < rows; ++a) in->con.y[a - n] /= h*in->con.w[s];
    gvi__zero((size_t)n, in->result);
    gvi__add_force(st, in->con.y, in->result);
    for (int i = 0; i < rows; ++i) {
        gvi__copy((size_t)s, in->con.force + i*in->R, in->con.last + i*C);
        in->con.last[i*C + s] = i < n ? in->result[i] : -in->con.y[i - n];
    }
}

/* Newton's method for the lambda with which G v + dg/dt stays 0 along the motion, its matrix A.
   d/de at (t + e, q + e v, p + e (F + G' lambda)) by differences of order 8, which are halved in
   every iteration: the least change is where truncation and rounding meet.                   */
GVI_DEF gvi_status gvi_multipliers(gvi_stepper *st, gvi_real *lambda)
{
    static const gvi_real weight[] = {
        (gvi_real)4/5, -(gvi_real)1/5, (gvi_real)4/105, -(gvi_real)1/280
    };
    gvi_status trial = GVI_OK, status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (!lambda) return gvi__refuse_call(st, "lambda is NULL");
    if (!GVI__CONSTRAINTS || !st->in.con.bits) return gvi__done(st, GVI_E_FORMULATION);
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *q = in->result, *p = q + n, *u = p + n, *v = in->con.W, *force = v + n;
    gvi_real *z = in->con.rho, *rate = z + m, *sum = in->con.y, *best = in->con.g + 2*m;
    gvi_real *F = in->step.p, least = GVI__MAX, size = 0, delta = 1;
    gvi_points at = gvi__one_point(st, &st->t, st->q);
    gvi__velocity_guess(st, u);
    if (m > 0) status = gvi__constraints_at(st, st->t, st->q, st->p, u, in->con.drops + m);
    gvi__velocity_guess(st, v);
    if (status == GVI_OK) status = gvi__velocity(st, st->t, st->q, st->p, v);
    at.v = v;
    if (status == GVI_OK) status = gvi__evaluate(st, &at, 0, 1);
    gvi__copy((size_t)n, at.f, F);
    gvi__zero((size_t)m, sum);

    // a time in which much changes: |p||q|/p'v
    for (int i = 0; i < n; ++i) size += GVI_ABS(st->p[i]*st->q[i]);
    if (size > 0) delta = size/GVI_ABS(gvi__dot(n, st->p, v));
    if (!gvi__finite(delta)) delta = 1;
    for (int k = 0; k < GVI__DIG && m > 0 && status == GVI_OK; ++k) {
        delta /= k == 0 ? 8 : 2;
        gvi__zero((size_t)n, q);
        gvi__add_force(st, sum, q);                // of all of it: what rounding took is seen
        gvi__add_scaled(n, 1, q, F, force);
        gvi__copy((size_t)n, q, p);
        gvi__over_inertia(st, p, 1, 1);
        const gvi_real whole = GVI_ABS(gvi__dot(n, q, p));
        gvi__zero((size_t)m, rate);
        trial = GVI_OK;
        for (int j = 0; j < 8 && trial == GVI_OK; ++j) {
            const gvi_real sign = j % 2 ? -1 : 1, e = sign*delta*(gvi_real)(j/2 + 1), t = st->t + e;
            gvi__add_scaled(n, e, v, st->q, q);
            gvi__add_scaled(n, e, force, st->p, p);
            gvi__copy((size_t)n, v, u);
            trial = gvi__velocity(st, t, q, p, u);
            if (trial == GVI_OK)
                trial = gvi__evaluate_constraints(st, 1, 1, &t, q, in->con.G1 + m*n);
            if (trial == GVI_OK) (void)gvi__find_columns(st, 1, 1, in->con.G1 + m*n);
            for (int a = 0; a < m; ++a)
                rate[a] += (in->con.g[m + a] + gvi__row_dot(st, in->con.G1 + m*n, a, u))
                           *(sign*weight[j/2]/delta);
        }
        for (int a = 0; a < m; ++a) z[a] = -rate[a];
        gvi__solve_constraints(st, in->con.A1, 1, 1, z, 1);
        size = -gvi__dot(m, rate, z);
        if (trial != GVI_OK || !gvi__finite(size)) continue;      // beyond a domain: nearer
        if (!(size < least) && size <= GVI__EPS*whole) break;
        gvi__add_scaled(m, 1, z, sum, sum);
        if (size < least) least = size, gvi__copy((size_t)m, sum, best);
    }
    if (status == GVI_OK && m > 0 && !(least < GVI__MAX))
        status = trial != GVI_OK ? trial : gvi__report_status(st, GVI_E_NON_FINITE);
    if (status != GVI_OK) return gvi__done(st, status);
    for (int e = 0; e < in->desc.effect_count; ++e)
        for (int a = 0; a < in->desc.effects[e].rows; ++a)
            *lambda++ = gvi__constraints_on(st) >> e & 1u ? *best++ : 0;
    return gvi__done(st, GVI_OK);
}

/* ---------------------------------------------------------------- SET-UP */

// in long: an int may have 16 bits
static int gvi__within(long x, long most) { return x >= 0 && x <= most; }

// what is wrong with a description's own members, or NULL
GVI__COLD const char *gvi__wrong_in_desc(const gvi_desc *d)
{
    if (!d) return "desc is NULL";
    if (!gvi__within(d->n, 0x7FFFF) || d->n < 1) return "n is not 1 to 524,287";
    if (!gvi__within(d->degree, 1024)) return "degree is not 0 to 1024";
    if (!gvi__within(d->rule.points, 4000)) return "rule.points is not 0 to 4000";
    if (!gvi__within(d->effect_count, GVI_EFFECTS)) return "effect_count is not 0 to GVI_EFFECTS";
    if (d->effect_count && !d->effects) return "effect_count is given, effects is NULL";
    if (d->effects && !d->effect_count) return "effects is given, effect_count is 0";
    if (!gvi__within(d->max_iterations, 1000000)) return "max_iterations is not 0 to 1,000,000";
    if (!gvi__within(d->iterations, 1000000)) return "iterations is not 0 to 1,000,000";
    if ((unsigned)d->formulation > GVI_NEWTON) return "formulation is not in its enum";
    if ((unsigned)d->mass.kind > GVI_MASS_NONE) return "mass.kind is not in its enum";
    if ((unsigned)d->rule.kind > GVI_KICKS) return "rule.kind is not in its enum";
    if (!(d->tolerance >= 0 && d->tolerance < 1)) return "tolerance is not 0 to 1";
    if (!(d->resolution >= 0 && d->resolution < 1)) return "resolution is not 0 to 1";
    if (d->rule.kind < GVI_OWN && d->rule.nodes) return "rule: this kind takes no nodes";
    if (d->rule.kind < GVI_OWN) return NULL;
    if (!d->rule.points || !d->rule.nodes || !d->rule.weights)
        return "rule: this kind needs points, nodes and weights";
    return NULL;
}

// what is wrong with an effect, or NULL; `in` knows those before it
GVI__COLD const char *gvi__wrong_in_effect(const struct gvi__private *in, const gvi_effect *effect)
{
    const int holds = effect->kind == GVI_CONSTRAINT, clock = effect->kind == GVI_CLOCK;
    if ((unsigned)effect->kind > GVI_CONSTRAINT) return "effect: kind is not in its enum";
    if (!effect->points && !effect->point) return "effect: points, or point, is missing";
    if (effect->points && effect->point) return "effect: points and point, one is too many";
    if (!holds && effect->rows != 0) return "effect: rows is for constraints";
    if (GVI__CONSTRAINTS && holds && (effect->rows < 1 || effect->rows > in->desc.n - in->con.m))
        return "effect: rows is not 1 to what is left of n";
    if (!effect->points && ((GVI__CLOCK && clock) || (GVI__CONSTRAINTS && holds)))
        return "effect: this kind needs points, not point";
    if (GVI__CLOCK && clock && in->clock >= 0) return "effect: a second clock";
    return NULL;
}

// what is wrong with the mass, or NULL
GVI__COLD const char *gvi__wrong_in_mass(const struct gvi__private *in)
{
    const gvi_mass *m = &in->desc.mass;
    if (m->kind == GVI_MASS_UNIT && (m->matrix || m->points))
        return "mass: matrix or points is given, kind is GVI_MASS_UNIT";
    if (m->kind == GVI_MASS_POSITION && !m->points) return "mass: points is missing";
    if (m->kind == GVI_MASS_POSITION && !m->gradient) return "mass: gradient is missing";
    if (m->kind == GVI_MASS_NONE && !(in->facts & GVI__HAS_LAGRANGIAN))
        return "mass: none, and no Lagrangian term";
    if ((m->kind == GVI_MASS_DIAGONAL || m->kind == GVI_MASS_DENSE) && !m->matrix)
        return "mass: matrix is missing";
    return NULL;
}

/* Are all sizes in range, is everything there that the kinds need, and nothing that suggests a
   forgotten kind?  Fills in the defaults, and finds the clock and what the effects read.      */
GVI__COLD gvi_status gvi__check(struct gvi__private *in, const gvi_desc *desc, gvi_fault *fault)
{
    enum { V = GVI__HAS_VELOCITIES, L = GVI__HAS_LAGRANGIAN };
    // potential, force, Lagrangian, clock, constraint
    static const unsigned char reads[] = { 0, V, V | L, 0, 0 };
    const char *wrong = gvi__wrong_in_desc(desc);
    if (wrong) return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE, wrong);
    gvi_desc *d = &in->desc;
    *d = *desc;
    const gvi_rule_kind rule = d->rule.kind;
    if (d->degree == 0) {
        d->degree = 8;
        if (rule == GVI_KICKS) d->degree = 1;
    }
    if (d->rule.points == 0) d->rule.points = d->degree + (rule == GVI_LOBATTO);
    if (d->max_iterations == 0) d->max_iterations = 60;
    if (d->resolution > 0 && d->degree < 3)
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE, "resolution: degree is below 3");
    if (d->resolution > 0 && d->resolution < GVI__EPS) d->resolution = GVI__EPS;

    in->facts = 0;
    in->clock = -1;
    in->apart = in->con.bits = 0;
    in->con.m = 0;
    for (int e = 0; e < d->effect_count; ++e) {
        const gvi_effect *effect = d->effects + e;
        wrong = gvi__wrong_in_effect(in, effect);
        if (wrong) return gvi__refuse(fault, e, GVI_FAULT_NONE, wrong);
        in->facts |= reads[effect->kind];
        if (effect->kind < GVI_CLOCK) continue;
        in->apart |= 1u << e;
        in->con.m += effect->rows;
        if (effect->kind == GVI_CONSTRAINT) in->con.bits |= 1u << e;
        else in->clock = e;
    }
    const gvi_mass *m = &d->mass;
    if ((in->facts & L && !GVI__LAGRANGIAN) || (in->clock >= 0 && !GVI__CLOCK)
        || (in->con.bits && (!GVI__CONSTRAINTS || in->clock >= 0 || rule == GVI_KICKS))
        || (m->kind > GVI_MASS_DENSE && !gvi__mass_is(in, m->kind)) || !gvi__rule_is(in, rule))
        return GVI_E_FORMULATION;
    wrong = gvi__wrong_in_mass(in);
    if (wrong) return gvi__refuse(fault, GVI_FAULT_MASS, GVI_FAULT_NONE, wrong);
    return GVI_OK;
}

/* The order of the rule: will it do? Weights given must be finite and sum to 1, and their rounding
   must leave half of the sum's digits.                                                        */
GVI__COLD gvi_status gvi__check_rule(struct gvi__private *in, int *order, gvi_fault *fault)
{
    const gvi_rule *rule = &in->desc.rule;
    const int s = in->desc.degree, r = rule->points;
    gvi_real sum = -1, error = 0;
    *order = 2*r;
    if (rule->kind == GVI_LOBATTO) *order = 2*r - 2;
    if (rule->weights)
        for (int j = 0; j < r; ++j) {
            sum += rule->weights[j];
            error += 4*(gvi_real)(r + 2)*GVI__EPS*GVI_ABS(rule->weights[j]);
        }
    const int sums = GVI_ABS(sum) <= error && error < GVI_SQRT(GVI__EPS);
    if (gvi__rule_is(in, GVI_KICKS)) {
        *order = 0;
        if (s != 1)
            return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE, "degree: kicks have 1");
        for (int j = 0; j < r; ++j)
            if (!gvi__finite(rule->nodes[j]) || !gvi__finite(rule->weights[j])) return GVI_E_NODES;
        if (!sums) return GVI_E_ORDER;
        return GVI_OK;
    }
    if (rule->kind == GVI_LOBATTO && r < 2 && s == 1)
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE,
                           "rule.points: Lobatto's rule has 2 or more");
    if (gvi__rule_is(in, GVI_OWN)) {
        *order = gvi_rule_order(r, rule->nodes, rule->weights);
        if (*order < 0) return GVI_E_NODES;
        if (r >= s && (*order < s || !sums)) return GVI_E_ORDER;
        if (*order < 2*s - 2) in->facts |= GVI__HAS_GAMMA;
    }
    // r >= s points of Gauss or Lobatto are good enough
    if (r < s) return GVI_E_POINTS;
    if (GVI__COMPILED != 1 << GVI_EXPLICIT && in->desc.resolution > 0 && *order < 2*s)
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE,
                           "resolution: the order of the rule is below twice the degree");
    return GVI_OK;
}

// the first formulation that covers the scene, or the pinned one; Newton's method as a fall-back
GVI__COLD gvi_status gvi__choose(struct gvi__private *in, gvi_fault *fault)
{
    enum { READS = 1, TIMED = 2, KICKED = 4, NOT_KICKED = 8, MORE_POINTS = 16, VARIES = 32,
          NO_VELOCITY = 64 };
    static const unsigned char cannot[] = {
        255,                                            // GVI_AUTO
        READS | TIMED | NOT_KICKED | VARIES,            // GVI_EXPLICIT
        READS | TIMED | KICKED | VARIES,                // GVI_POSITIONS
        TIMED | KICKED | VARIES,                        // GVI_VELOCITIES
        KICKED | MORE_POINTS | NO_VELOCITY,             // GVI_MOMENTA
        TIMED | KICKED                                  // GVI_NEWTON
    };
    static const unsigned char facts[] = { 0, GVI__OF_EXPLICIT, GVI__OF_POSITIONS,
                                           GVI__OF_VELOCITIES, GVI__OF_MOMENTA, GVI__OF_NEWTON };
    const gvi_desc *d = &in->desc;
    const int s = d->degree, r = d->rule.points, kicks = d->rule.kind == GVI_KICKS;
    const int verlet = s == 1 && r == 2 && d->rule.kind == GVI_LOBATTO,
              constant = gvi__mass_is_constant(in), holds = in->con.bits != 0,
              lacks = !constant && d->mass.kind != GVI_MASS_POSITION;   // M, if it is wanted
    const int pinned = d->formulation != GVI_AUTO, given = d->iterations > 0;
    int scene = 0, f = GVI_EXPLICIT;
    if (in->facts & GVI__HAS_VELOCITIES) scene |= READS;
    if (in->clock >= 0) scene |= TIMED;
    if (kicks) scene |= KICKED;
    if (!kicks && !verlet) scene |= NOT_KICKED;
    if (r != s) scene |= MORE_POINTS;
    if (!constant || (holds && in->facts & GVI__HAS_LAGRANGIAN)) scene |= VARIES;
    if ((d->mass.velocity && holds) || (!d->mass.velocity && lacks)) scene |= NO_VELOCITY;
    if (pinned) f = (int)d->formulation;
    while (!(GVI__COMPILED >> f & 1) || (scene & cannot[f]))
        if (pinned || f++ == GVI_NEWTON) return GVI_E_FORMULATION;
    in->chosen = (gvi_formulation)f;
    in->facts |= facts[f];
    if (f == GVI_NEWTON && given) return GVI_E_FORMULATION;
    if (!GVI__RULES && f != GVI_EXPLICIT && (d->rule.kind != GVI_GAUSS || r != s))
        return GVI_E_FORMULATION;
    // as a fall-back only where its matrices are small
    if (f == GVI_NEWTON
        || (GVI__NEWTON && !pinned && f != GVI_EXPLICIT && in->clock < 0 && !given
            && s <= 1024/(d->n + in->con.m)))
        in->facts |= GVI__HAS_NEWTON;
    const int matrices =
        gvi__has(in, GVI__HAS_NEWTON | GVI__HAS_LAGRANGIAN) || d->mass.kind >= GVI_MASS_DENSE;
    if (matrices && d->n > 0x7FFF)                // indices are int: n*n and s*n
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE,
                           "n is above 32,767, and matrices may be needed");
    if (GVI__CONSTRAINTS && in->con.m > 0x7FFFFFFF/(GVI__ROW(s + 1)*d->n))        // of G
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE,
                           "n, degree and rows of constraints are too large together");
    return GVI_OK;
}

GVI__COLD gvi_status gvi__resolve(struct gvi__private *in, const gvi_desc *desc, int *order,
                                  gvi_fault *fault)
{
    gvi_status status = gvi__check(in, desc, fault);
    if (status == GVI_OK) status = gvi__check_rule(in, order, fault);
    if (status == GVI_OK) status = gvi__choose(in, fault);
    return status;
}

/* The caller's memory: a base, or NULL to count only, and the numbers handed out so far.     */
typedef struct gvi__arena { gvi_real *base; size_t used; } gvi__arena;

GVI__COLD gvi_real *gvi__take(gvi__arena *arena, size_t a, size_t b)
{
    const size_t most = (size_t)-1/sizeof(gvi_real) - 64;      // more than anyone has, with slack
    const size_t at = arena->used;
    if (a == 0) return NULL;
    arena->used = most;
    if (b <= (most - at)/a) arena->used = at + a*b;
    if (!arena->base) return NULL;
    return arena->base + at;
}

// that of constraints: rows of R, then of C
GVI__COLD void gvi__layout_constraints(struct gvi__private *in, gvi__arena *a)
{
    struct gvi__holonomic *con = &in->con;
    const size_t n = (size_t)in->desc.n, s = (size_t)in->desc.degree,
                 r = (size_t)in->desc.rule.points,
                 R = (size_t)GVI__ROW(r), C = (size_t)GVI__ROW(s + 1),
                 m = (size_t)gvi__count_rows(in, con->bits),
                 on = m > 0, i = on && gvi__has(in, GVI__ITERATES),
                 newton = on && gvi__has(in, GVI__HAS_NEWTON),
                 u = i && !gvi__has(in, GVI__BY_FORCES);
    const struct { gvi_real **to; size_t rows, width; } list[] = {
        { &con->D, i*n, R }, { &con->free, i*n, R }, { &con->P, u*n, R },
        { &con->force, i*(n + m), R },
        { &con->K, i*r, R }, { &con->U, u*r, R }, { &con->by_force, i*r, R },
        { &con->by_impulse, i*r, R },
        { &con->X, i*s, R },
        { &con->E, i*s, R }, { &con->Phi, i*s, R }, { &con->Phi_low, i*s, R }, { &con->hw, on, R },
        { &con->last, i*(n + m), C }, { &con->at, i*n, C }, { &con->t, i, C }, { &con->W, on*n, C },
        { &con->g, 2*m, C }, { &con->G, i*m*n, C }, { &con->A, i*m*m, C }, { &con->d, on, R + C },
        { &con->w, on, s + 1 }, { &con->rho, m, R + C }, { &con->lu, i*(s + 1), s + 1 },
        { &con->y, on, m },
        { &con->G1, 2*m, n }, { &con->A1, m, m }, { &con->column, m, n + 1 },
        { &con->first, on, m }, { &con->drops, 2*on, m }, { &con->doubt, on, 3*m + 1 },
        { &con->unit, 2*newton, s*m }
    };
    con->C = (int)C;
    for (size_t k = 0; k < sizeof list/sizeof *list; ++k)
        *list[k].to = gvi__take(a, list[k].rows, list[k].width);
}

/* The one layout: gvi_size counts with it, gvi_init hands out by it, and GVI_LENGTH is no less than
   its sum with everything wanted.  Stage values of two steps back make the predictor better up to
   nine points; with more of them, and in float, they would amplify rounding too much.         */
GVI__COLD size_t gvi__layout(struct gvi__private *in, int order, gvi_real *base)
{
    const gvi_desc *d = &in->desc;
    const size_t n = (size_t)d->n, s = (size_t)d->degree, r = (size_t)d->rule.points,
                 R = (size_t)GVI__ROW(r);
    const size_t iterates = gvi__has(in, GVI__ITERATES) != 0,
                 fixed = gvi__has(in, GVI__FIXED_POINT) != 0,
                 stages = gvi__has(in, GVI__TWO_STAGES) != 0,
                 momenta = gvi__has(in, GVI__BY_MOMENTA) != 0,
                 newton = gvi__has(in, GVI__HAS_NEWTON) != 0,
                 lagrangian = gvi__has(in, GVI__HAS_LAGRANGIAN) != 0,
                 full = gvi__has(in, GVI__HAS_GAMMA) != 0,
                 kicks = gvi__rule_is(in, GVI_KICKS) != 0,
                 velocities = stages && !momenta, reads_v = stages || newton,
                 legendre = newton || lagrangian, A = lagrangian && fixed,
                 two = fixed && r < 10 && GVI__DIG > 24,
                 modes = iterates && (reads_v || order <= 2*d->degree - 2),
                 clock = GVI__CLOCK && in->clock >= 0, dense = d->mass.kind == GVI_MASS_DENSE,
                 limited = d->resolution > 0;
    const size_t rows = kicks ? n : n*R, nn = n*n,
                 N = s*(n + (size_t)gvi__count_rows(in, in->con.bits));
    gvi__arena memory = { base, 0 }, *a = &memory;
    struct gvi__values *const values[] = { &in->work, &in->last, &in->older };
    gvi_real **const rows_of_R[] = {
        &in->table.c, &in->table.b, &in->sized.hb, &in->t,
        &in->time.rate, &in->time.power, &in->time.level, &in->time.lagrangian
    };
    gvi_real **const vectors[] = {
        &in->state.q, &in->state.p, &in->state.q_low, &in->state.p_low, &in->step.q, &in->step.p,
        &in->step.q_low, &in->step.p_low, &in->began.q, &in->began.p, &in->free.v, &in->zeros,
        &in->start,
        &in->mass.inverse, &in->free.v_low, &in->free.path, &in->free.path_low
    };
    gvi_real **const modes_of_newton[] = {
        &in->newton.y, &in->newton.dy, &in->newton.residual, &in->newton.last,
        &in->newton.found, &in->newton.branch, &in->newton.guess, &in->newton.slope
    };

    // rows first: they start on a whole lane
    for (int k = 0; k < 3; ++k) {
        struct gvi__values *v = values[k];
        const size_t kept = k < 2 || two, at_work = k == 0;
        v->F = gvi__take(a, kept, rows);
        v->V = gvi__take(a, kept && reads_v && (k < 2 || momenta), n*R);
        v->A = gvi__take(a, kept && A, n*R);
        v->Q = gvi__take(a, at_work, rows);
        v->P = gvi__take(a, at_work && (momenta || newton), n*R);
    }
    for (int k = 0; k < 8; ++k) *rows_of_R[k] = gvi__take(a, k < 4 || clock, R);
    in->free.rows = gvi__take(a, fixed + stages, n*R);
    in->table.Phi = gvi__take(a, (1 - kicks)*s, R);
    in->table.phi = gvi__take(a, modes*s, R);
    in->table.phi_low = gvi__take(a, modes*s, R);
    in->table.high = gvi__take(a, 4*limited, R);
    in->table.K = gvi__take(a, (fixed && !momenta)*r, R);
    in->table.U = gvi__take(a, stages*r, R);
    in->table.T = gvi__take(a, (momenta || (velocities && lagrangian))*r, R);
    in->table.N = gvi__take(a, (velocities && lagrangian)*r, R);
    in->sized.E = gvi__take(a, iterates*(1 + two)*r, R);
    in->row = gvi__take(a, 9*iterates, R);
    in->mass.at_points = gvi__take(a, (d->mass.kind == GVI_MASS_POSITION)*nn, R);
    in->mass.sums = gvi__take(a, (dense && fixed && !momenta)*n, R);
    in->time.slope = gvi__take(a, clock, n*R);
    in->table.inv_gamma = gvi__take(a, 1, s);
    in->table.gamma = gvi__take(a, full, s*s + s + 1);
    in->sized.drift = gvi__take(a, 1 - iterates, r + 1);
    for (size_t k = 0; k < sizeof vectors/sizeof *vectors; ++k)
        *vectors[k] = gvi__take(a, k < 14 || iterates, n);

    in->mass.matrix = gvi__take(a, 1 - dense + dense*n, n);
    in->mass.factor = gvi__take(a, dense*n, n);
    in->watch.scale = gvi__take(a, 2*iterates, n);
    in->watch.change = gvi__take(a, 2*iterates, n);
    in->watch.before = gvi__take(a, 2*iterates, n);
    in->point = gvi__take(a, 6, n);
    in->result = gvi__take(a, 3, n);
    in->newton.column = gvi__take(a, 4*legendre, n);
    in->newton.hessian = gvi__take(a, legendre, (1 + 3*newton)*nn + n + 1);
    for (int k = 0; k < 8; ++k) *modes_of_newton[k] = gvi__take(a, newton, N);
    in->newton.pivot = gvi__take(a, newton*2, N + 1);            // twice: queries must not touch
    in->newton.moved = gvi__take(a, newton*4*n, R);
    if (GVI__CONSTRAINTS) gvi__layout_constraints(in, a);
    // what the steps keep.  J comes last
    in->newton.J = gvi__take(a, newton*2*N, N);
    return memory.used;
}

// pointers into the memory, also those of the state that the caller reads
static void gvi__hand_out(gvi_stepper *st, gvi_real *memory)
{
    gvi__layout(&st->in, st->order, memory);
    st->q = st->in.state.q;
    st->p = st->in.state.p;
    st->q_low = st->in.state.q_low;
    st->p_low = st->in.state.p_low;
}

// stage values start where a cache line does: up to so many numbers are left out at the beginning
static size_t gvi__slack(const gvi_desc *d) { return d->rule.points > 4 ? GVI__SLACK : 0; }

GVI_DEF size_t gvi_size(const gvi_desc *desc)
{
    struct gvi__private x;
    gvi_fault fault;
    int order;
    if (gvi__resolve(&x, desc, &order, &fault) != GVI_OK) return 0;
    return (gvi__layout(&x, order, NULL) + gvi__slack(&x.desc))*sizeof(gvi_real);
}

// mass matrix into the memory, factored; inverse is 1 where M is no diagonal
GVI__COLD gvi_status gvi__set_mass(gvi_stepper *st, const gvi_mass *mass)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, dense = mass->kind == GVI_MASS_DENSE;
    const int given = dense || mass->kind == GVI_MASS_DIAGONAL;
    gvi_real *m = in->mass.matrix;
    int at[2] = { 0, 0 };
    for (int i = 0; i < n; ++i) {
        int first = i, width = 1;                 // of a diagonal; dense: of row i up to M_ii
        if (dense) {
            first = i*n;
            width = i + 1;
        }
        gvi_real *row = m + first;
        if (given) gvi__copy((size_t)width, mass->matrix + first, row);
        else row[0] = 1;
        if (gvi__first_non_finite(width, row) >= 0)
            return gvi__refuse(&st->fault, GVI_FAULT_MASS, i, "mass.matrix is not finite");
        if (dense) {
            gvi__copy((size_t)width, row, in->mass.factor + first);
            in->mass.inverse[i] = 1;
            continue;
        }
        in->mass.inverse[i] = 1/row[0];
        if (!gvi__finite(in->mass.inverse[i]))
            return gvi__report(st, GVI_E_SINGULAR, GVI_FAULT_MASS, i, GVI_FAULT_NONE);
    }
    if (!dense) return GVI_OK;
    const gvi_status status =
        gvi__ldl_factor(n, 1, 1, in->mass.factor, at);
    if (status == GVI_OK) return GVI_OK;
    return gvi__report(st, status, GVI_FAULT_MASS, at[0], at[1]);
}

// the rule, the modes at its nodes as exactly as they can be had, then the tables
GVI__COLD gvi_status gvi__set_rule(gvi_stepper *st, const gvi_rule *rule)
{
    struct gvi__private *in = &st->in;
    if (gvi__rule_is(in, GVI_OWN) || gvi__rule_is(in, GVI_KICKS)) {
        gvi__copy((size_t)st->r, rule->nodes, in->table.c);
        gvi__copy((size_t)st->r, rule->weights, in->table.b);
    } else if (!gvi__has(in, GVI__ITERATES)) {                 // Stoermer-Verlet: c = 0, 1
        in->table.c[1] = 1;
        in->table.b[0] = in->table.b[1] = (gvi_real)0.5;
    }
    else gvi__rule(GVI__RULES && rule->kind == GVI_LOBATTO, st->r, in->table.c, in->t, in->table.b);
    if (gvi__has(in, GVI__ITERATES)) {
        // the low words of Phi go to E, which is not yet in use
        gvi__modes_of(st, st->r, in->table.c, in->t, in->table.phi, in->table.phi_low,
                      in->table.Phi,
                      in->sized.E);
        const gvi_status status = gvi__make_gamma(st);
        if (status != GVI_OK) return status;
        gvi__make_tables(st);
    }
    if (in->table.high) {                                     // see gvi__resolution
        const int pair = 1 + (st->s > 4);
        const gvi_real *modes = in->table.phi;
        if (gvi__has(in, GVI__BY_FORCES)) modes = in->table.Phi;
        for (int m = 0; m < 2*pair; ++m) {
            const int k = st->s - 1 - m;
            for (int j = 0; j < st->r; ++j)
                in->table.high[4*j + m*2/pair] =
                    in->table.inv_gamma[k]*modes[k*in->R + j]*in->table.b[j];
        }
    }
    if (GVI__CONSTRAINTS && in->con.bits && gvi__set_constraints(st) != GVI_OK) return GVI_E_POINTS;
    // Phi_0 = c on its grid
    if (in->table.Phi) gvi__copy((size_t)st->r, in->table.c, in->table.Phi);
    return GVI_OK;
}

// where number stands: the alignment of a gvi_real
typedef struct gvi__aligned { char byte; gvi_real number; } gvi__aligned;

GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    if (!st) return GVI_E_ARGUMENT;
    struct gvi__private *in = &st->in;
    unsigned char *bytes = (unsigned char *)st;
    // to be read after a failure; eight where an int has 16 bits, and RAM is short
    static const gvi_real zeros[sizeof(int) > 2 ? 64 : 8] = { 0 };
    int order = 0;
    for (size_t i = 0; i < sizeof *st; ++i) bytes[i] = 0;
    gvi__report_status(st, GVI_OK);
    st->q = st->p = st->q_low = st->p_low = zeros;
    gvi_status status = gvi__resolve(in, desc, &order, &st->fault);
    st->order = order;
    if (GVI__CONSTRAINTS && status == GVI_E_FORMULATION && in->con.bits)
        return gvi__refuse_constraints(st);
    if (status != GVI_OK) return st->status = status;
    if (!memory) return gvi__refuse_call(st, "memory is NULL");
    if ((uintptr_t)memory % offsetof(gvi__aligned, number))
        return gvi__refuse_call(st, "memory is not aligned");
    st->n = in->desc.n;
    st->s = in->desc.degree;
    st->r = in->desc.rule.points;
    st->formulation = in->chosen;
    in->R = GVI__ROW(st->r);
    in->size = gvi__layout(in, order, NULL);
    const size_t slack = gvi__slack(&in->desc);
    if (size < (in->size + slack)*sizeof(gvi_real)) {
        if (size/sizeof(gvi_real) < (size_t)st->n) return st->status = GVI_E_MEMORY;
        gvi__zero((size_t)st->n, memory);
        st->q = st->p = st->q_low = st->p_low = memory;
        return st->status = GVI_E_MEMORY;
    }
    if (slack) in->skip = (size_t)(-(uintptr_t)memory & 63)/sizeof(gvi_real);
    memory += in->skip;
    gvi__hand_out(st, memory);
    size_t cleared = in->size;
    if (in->newton.J) cleared = (size_t)(in->newton.J - memory);      // J is written first
    gvi__zero(cleared, memory);
    in->kernel = gvi__kernel_for(st->n, st->r);
    status = gvi__set_mass(st, &desc->mass);
    if (status == GVI_OK) status = gvi__set_rule(st, &desc->rule);
    if (status != GVI_OK) return st->status = status;
    in->memory = memory;                                      // from here on it can be used
    return GVI_OK;
}

/* ------------------------------------------------------ NEWTON'S METHOD */

/* Newton's method on (1).  Unknowns y[k*n + i]; the rows are those of (1) times 2k + 1, from k0 on:
   k0 = 0 for a step, 1 for the boundary-value problem.  The matrix of the derivatives is kept while
   the iteration contracts by 1/4 or better, over iterations and over steps.

   With constraints, y[s*n + e*m + a] is -lambda_a at D_e, e = 0..s-1, and the rows behind those of
   (1) are -g_a at D_(e+1).  So signed, the determinant of free motion is positive.           */
typedef struct gvi__matrix {
    gvi_real *square;      /* rows and columns k0..s-1, row-major, then its LU              */
    gvi_real *pivot;
    gvi_real *ends;        /* k0 = 1: columns y_0 and q0, 2n a row; or NULL                 */
    int       k0;
    int       scaled;      /* columns over sqrt M_ii, rows by their largest entry: the condition
                              then has no units                                      */
    int       halves;      /* are changes taken back that make the residual larger?         */
    gvi_real *unit;        /* of the multipliers, in which the LU has their columns         */
} gvi__matrix;

static size_t gvi__unknowns(const gvi_stepper *st, int k0)
{
    return (size_t)(st->s - k0)*(size_t)st->n
           + (gvi__constrained(st) ? (size_t)st->s*(size_t)st->in.con.m : 0);
}

// g and G at the D that y makes, and the forces of its multipliers
GVI__CALLED gvi_status gvi__newton_constraints(gvi_stepper *st, const gvi__origin *from)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R;
    gvi__constraint_points(st, from, in->sized.h);
    for (int i = 0; i < n; ++i)
        for (int e = 0; e < s; ++e) {
            gvi_real D = 0;
            for (int k = 0; k < s; ++k) D += in->con.Phi[k*R + e]*in->newton.y[k*n + i];
            in->con.D[i*R + e] = from->q_low[i] + in->sized.h*D;
        }
    for (int k = 0; k < s*m; ++k) in->con.force[(n + k % m)*R + k/m] = in->newton.y[s*n + k];
    in->con.linear = 0;
    const gvi_status status = gvi__evaluate_at_D(st, from);
    gvi__constraint_forces(st);
    gvi__force_sizes(st, in->con.force + n*R, R, in->con.D);      // nearly dependent rows cancel
    return status;
}

// Q and V from y; then F and P at these
static gvi_status gvi__newton_values(gvi_stepper *st, const gvi__origin *from)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    for (int i = 0; i < n; ++i) {
        gvi_real *GVI__RESTRICT V = in->work.V + i*R, *GVI__RESTRICT Q = in->work.Q + i*R;
        gvi__zero((size_t)R, V);
        gvi__zero((size_t)R, Q);
        for (int k = 0; k < st->s; ++k) {
            const gvi_real y = in->newton.y[k*n + i];
            for (int j = 0; j < R; ++j) {
                V[j] += in->table.phi[k*R + j]*y;
                Q[j] += in->table.Phi[k*R + j]*y;
            }
        }
        for (int j = 0; j < R; ++j) Q[j] = from->q[i] + (from->q_low[i] + in->sized.h*Q[j]);
    }
    gvi__count(&st->counters.velocities, st->r);
    gvi_points at = gvi__points_at(st, st->r, R, in->t, in->work.Q, in->work.F, in->work.P);
    at.v = in->work.V;
    const gvi_status status = gvi__evaluate(st, &at, 0, 1);
    return status == GVI_OK && gvi__constrained(st) ? gvi__newton_constraints(st, from) : status;
}

/* Where Newton's method stands: the last changes and the least; rho, the contraction seen; what
   is left of the error, once a change was rounding; the residual in units of its own terms, and
   once its change is made the work that does in it, or -1 where either is rounding; the
   residual's norm at the last y that stayed; the last change by each coordinate's size, and what
   rounding makes of one, see gvi__newton_update; how often no change was less than half of the
   least; is there a matrix that will do, is it new (1) and was the last one (2); how often was
   the last change halved, or -1: none to take back; did that change move the residual by half of
   itself, or is the residual rounding?                                                        */
typedef struct gvi__descent {
    gvi_real before, earlier, least, rho, left, work, norm, each, grain;
    int      stagnant, have, fresh, halves, holds;
} gvi__descent;

/* dy and residual := -(1).  The weights of P are h b_i/h, those that F has, and Phi_0 = c is on
   its grid: then the rows are exactly those of a discrete action, also as rounded.  Returns the
   norm, the sum of magnitudes over sqrt M_ii: rows of (1) are momenta, so that has one unit for
   all coordinates.  M is that of the first y.                                                 */
static gvi_real gvi__residual(gvi_stepper *st, const gvi__origin *from, int k0, gvi__descent *p)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, first = !(p->norm < GVI__MAX),
              held = gvi__constrained(st) ? st->s : 0;
    const gvi_real h = in->sized.h;
    gvi_real norm = 0, moved = 0, before = 0;
    p->work = 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real *P = in->work.P + i*R, *F = in->work.F + i*R;
        gvi_real length = 0, change = 0, was = 0;
        for (int k = k0; k < st->s; ++k) {
            // P - p is summed where p occurs: the rounding of P then is not in the sum
            const gvi_real base = k == 0 ? from->p[i] : 0;
            gvi_real momentum = k == 0 ? -(h*from->p_low[i]) : 0, force = 0, size = 0;
            for (int j = 0; j < st->r; ++j) {
                const gvi_real phi = in->table.phi[k*R + j],
                               W = (k == 0 ? 1 : 0) - in->table.Phi[k*R + j];
                const gvi_real b = W*(in->sized.hb[j]*F[j]);
                momentum += phi*(in->sized.hb[j]*(P[j] - base));
                force += b;
                size += GVI_ABS(phi*(in->table.b[j]*P[j])) + GVI_ABS(b);
            }
            for (int e = 0; e < held; ++e) {
                const gvi_real W = (k == 0 ? 1 : 0) - (e > 0 ? in->con.Phi[k*R + e - 1] : 0);
                force += W*(in->con.hw[e]*in->con.force[i*R + e]);
                size += GVI_ABS(W*(in->con.hw[e]*in->con.D[i*R + e]));
            }
            const gvi_real sum = momentum/h - force;
            gvi_real *rest = in->newton.residual + (k - k0)*n + i;
            const gvi_real now = -(gvi_real)(2*k + 1)*sum;
            change += GVI_ABS(now - *rest);
            was += GVI_ABS(*rest);
            length += GVI_ABS(now);
            in->newton.dy[(k - k0)*n + i] = *rest = now;
            if (size > 0 && GVI_ABS(sum)/size > p->work) p->work = GVI_ABS(sum)/size;
        }
        if (first) in->watch.scale[i] = 1/GVI_SQRT(gvi__inertia(st, i));
        norm += length*in->watch.scale[i];
        moved += change*in->watch.scale[i];
        before += was*in->watch.scale[i];
    }
    for (int k = 0; k < held*in->con.m; ++k) {     // g, as the momentum that would undo it
        const int a = k % in->con.m, e = k/in->con.m + 1, C = in->con.C;
        const gvi_real now = in->con.g[a*C + e];
        gvi_real *rest = in->newton.residual + st->s*n + k, size = 0, inertia = 0;
        if (in->con.drops[a] > 0) {
            in->newton.dy[st->s*n + k] = 0;
            continue;
        }
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1)) {
            const gvi_real G = in->con.G[(a*n + i)*C + e];
            size += GVI_ABS(G*in->con.at[i*C + e]);
            inertia += G*in->watch.scale[i]*(G*in->watch.scale[i]);
        }
        const gvi_real unit = GVI_ABS(h)*GVI_SQRT(inertia);
        norm += GVI_ABS(now)/unit;
        moved += GVI_ABS(now - *rest)/unit;
        before += GVI_ABS(*rest)/unit;
        in->newton.dy[st->s*n + k] = *rest = now;
        if (size > 0 && GVI_ABS(now)/size > p->work) p->work = GVI_ABS(now)/size;
    }
    p->holds = p->work <= GVI__SOLVED*GVI__EPS || (!first && moved >= before/2);
    return norm;
}

// adds dF_i/du_j = f and dP_i/du_j = p of one point, u = q or v: du = h Phi_l dy_l or phi_l dy_l
static void gvi__add_derivative(const gvi_stepper *st, const gvi__matrix *J, int i, int j,
                                int point, gvi_real f, gvi_real p, int by_v)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, s = st->s, k0 = J->k0;
    const size_t size = gvi__unknowns(st, k0);
    const gvi_real *phi = in->table.phi + point, *Phi = in->table.Phi + point, *u = phi;
    gvi_real unit = 1;
    if (f <= 0 && f >= 0 && p <= 0 && p >= 0) return;
    if (!by_v) {
        u = Phi;
        unit = in->sized.h;
    }
    for (int k = k0; k < s; ++k) {
        const gvi_real W = (k == 0 ? 1 : 0) - Phi[k*R];
        const gvi_real a = (gvi_real)(2*k + 1)
                           * (in->table.b[point]*phi[k*R]*p - in->sized.hb[point]*W*f);
        const size_t row = (size_t)((k - k0)*n + i);
        gvi_real *square = J->square + row*size + j;
        for (int l = k0; l < s; ++l, square += n) *square += a*(unit*u[l*R]);
        if (!J->ends) continue;
        gvi_real *ends = J->ends + row*2*(size_t)n + j;
        ends[0] += a*(unit*u[0]);
        if (!by_v) ends[n] += a;
    }
}

// the bits of the effects that are on and bring a Hessian, or none
static unsigned gvi__with_hessian(const struct gvi__private *in, int with)
{
    unsigned bits = 0;
    for (int e = 0; e < in->desc.effect_count; ++e)
        if ((in->desc.effects[e].hessian != NULL) == with) bits |= 1u << e;
    return bits & ~in->off;
}

// derivatives of the constant mass, and of the effects that bring their Hessians
static gvi_status gvi__jacobian_exact(gvi_stepper *st, const gvi__matrix *J)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    const size_t nn = (size_t)n*(size_t)n;
    gvi_real *fq = in->newton.hessian, *fv = fq + nn, *pv = fv + nn, *q = in->point, *v = q + n;
    for (int k = 0; k < st->r; ++k) {
        gvi__gather(n, R, in->work.Q + k, q);
        gvi__gather(n, R, in->work.V + k, v);
        if (gvi__mass_is_constant(in))
            for (int i = 0; i < n; ++i) {
                if (in->desc.mass.kind != GVI_MASS_DENSE) {
                    gvi__add_derivative(st, J, i, i, k, 0, in->mass.matrix[i], 1);
                    continue;
                }
                for (int j = 0; j < n; ++j)
                    gvi__add_derivative(st, J, i, j, k, 0, in->mass.matrix[gvi__lower(n, i, j)], 1);
            }
        for (int e = 0; e < in->desc.effect_count; ++e) {
            const gvi_effect *effect = in->desc.effects + e;
            if ((in->off >> e & 1u) || !effect->hessian) continue;
            const int reads_v = effect->kind != GVI_POTENTIAL,
                      term = effect->kind == GVI_LAGRANGIAN;
            gvi__zero(3*nn, fq);
            if (effect->hessian(in->t[k], q, reads_v ? v : NULL, fq, reads_v ? fv : NULL,
                                term ? pv : NULL, effect->user))
                return gvi__report(st, GVI_E_CALLBACK, e, GVI_FAULT_NONE, k);
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {       // d(dL/dv)/dq is the transpose of d(dL/dq)/dv
                    gvi__add_derivative(st, J, i, j, k, fq[i*n + j], term ? fv[j*n + i] : 0, 0);
                    gvi__add_derivative(st, J, i, j, k, fv[i*n + j], pv[i*n + j], 1);
                }
        }
    }
    return GVI_OK;
}

// F and P of what has no Hessian, one behind the other
static gvi_status gvi__evaluate_plain(gvi_stepper *st, gvi_real *F)
{
    struct gvi__private *in = &st->in;
    gvi_points at = gvi__points_at(st, st->r, in->R, in->t, in->work.Q, F, F + st->n*in->R);
    at.v = in->work.V;
    return gvi__evaluate(st, &at, ~gvi__with_hessian(in, 0), !gvi__mass_is_constant(in));
}

/* What coordinate i moves in a step: h v, or eps^(1/4) of its position where that is more, or where
   it is at rest at 0, h^2 f/M_ii.  For its velocity h v or h^2 f/M_ii, whichever is more.  (f
   near a pole takes positions too far.)                                                       */
static gvi_real gvi__reach(const gvi_stepper *st, int i, int by_v)
{
    const struct gvi__private *in = &st->in;
    const gvi_real h = GVI_ABS(in->sized.h), small = by_v ? 0 : GVI_SQRT(GVI_SQRT(GVI__EPS)),
                   hw = h*in->watch.scale[i];
    gvi_real most = 0, push = 0;
    for (int k = i*in->R; k < i*in->R + st->r; ++k) {
        const gvi_real lengths[] = { h*GVI_ABS(in->work.V[k]), small*GVI_ABS(in->work.Q[k]) },
                       f = hw*GVI_ABS(in->work.F[k])*hw;
        for (int l = 0; l < 2; ++l) if (lengths[l] > most) most = lengths[l];
        if (f > push && gvi__finite(f)) push = f;
    }
    return push > most && (by_v || !(most > GVI__MIN/GVI__EPS)) ? push : most;
}

/* The difference for coordinate j: sqrt(eps) of its reach, or of the largest where it has none,
   each times sqrt(M_ii); or for its velocity, that over h.                                    */
static gvi_real gvi__difference(const gvi_stepper *st, int j, int by_v)
{
    const struct gvi__private *in = &st->in;
    const gvi_real root = GVI_SQRT(GVI__EPS), none = GVI__MIN/GVI__EPS, h = GVI_ABS(in->sized.h);
    gvi_real step = root*gvi__reach(st, j, by_v);
    if (!(step > none))
        for (int i = 0; i < st->n; ++i) {
            const gvi_real other = root*gvi__reach(st, i, by_v)
                                   * (in->watch.scale[j]/in->watch.scale[i]);
            if (other > step && gvi__finite(other)) step = other;
        }
    if (!(step > none)) step = root*gvi__smaller(h, 1);         // all of it is at rest at 0
    if (by_v) return step/h;
    return step;
}

// derivatives of what has no Hessian, by forward differences at all points at once
static gvi_status gvi__jacobian_differences(gvi_stepper *st, const gvi__matrix *J)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, nR = n*R, varies = !gvi__mass_is_constant(in);
    const unsigned plain = gvi__with_hessian(in, 0);
    const int reads_v = varies || (plain & ~gvi__of_kind(in, GVI_POTENTIAL)) != 0;
    gvi_real *F = in->newton.moved, *P = F + nR, *base_F = P + nR, *base_P = base_F + nR;
    if (!varies && !plain) return GVI_OK;
    gvi_status status = gvi__evaluate_plain(st, base_F);
    if (status != GVI_OK) return status;
    // of each coordinate q, then v
    for (int k = 0; k < 2*n; k += 2 - reads_v) {
        const int j = k/2, by_v = k % 2;
        gvi_real *row = in->work.Q + j*R, *was = in->row;
        if (by_v) row = in->work.V + j*R;
        const gvi_real d = gvi__difference(st, j, by_v);
        gvi__copy((size_t)R, row, was);
        for (int m = 0; m < st->r; ++m) row[m] += d;
        status = gvi__evaluate_plain(st, F);
        if (status == GVI_OK)
            for (int m = 0; m < st->r; ++m)
                for (int i = 0, o = m; i < n; ++i, o += R)
                    gvi__add_derivative(st, J, i, j, m, (F[o] - base_F[o])/(row[m] - was[m]),
                                        (P[o] - base_P[o])/(row[m] - was[m]), by_v);
        gvi__copy((size_t)R, was, row);
        if (status != GVI_OK) return status;
    }
    return GVI_OK;
}

// multipliers, constraints, and by differences of G the forces G' lambda, which move with D
GVI__CALLED gvi_status gvi__jacobian_constraints(gvi_stepper *st, const gvi__matrix *J)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R, C = in->con.C, moves = s > 1 ? n : 0;
    const gvi_real *const Phi = in->con.Phi - 1, *const t = in->con.t;      // at D_e: [e]
    const gvi_real h = in->sized.h;
    gvi_real *force = in->con.force, *base = in->con.free, *at = in->con.at, *was = in->row;
    const size_t size = gvi__unknowns(st, 0), sn = (size_t)(s*n);
    gvi_status status = GVI_OK;
    for (int l = 0; l < s*m; ++l) {
        const int a = l % m, e = l/m;
        const size_t z = sn + (size_t)l;
        if (in->con.drops[a] > 0) {                // its multiplier stays 0
            J->square[z*(size + 1)] = 1;
            continue;
        }
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            for (int k = 0; k < s; ++k) {
                const gvi_real *G = in->con.G + (a*n + i)*C + e,
                    W = (k == 0 ? 1 : 0) - (e > 0 ? Phi[k*R + e] : 0);
                const size_t y = (size_t)(k*n + i);
                J->square[y*size + z] = (gvi_real)(2*k + 1)*W*(in->con.hw[e]*G[0]);
                J->square[z*size + y] = -h*Phi[k*R + e + 1]*G[1];
            }
    }
    gvi__copy((size_t)(n*R), force, base);
    for (int j = 0; j < moves && status == GVI_OK; ++j) {
        gvi_real *row = at + j*C, d = gvi__difference(st, j, 0);
        gvi__copy((size_t)C, row, was);
        for (int e = 1; e < s; ++e) row[e] += d;
        status = gvi__evaluate_constraints(st, C, s + 1, t, at, in->con.G);
        gvi__constraint_forces(st);
        for (int e = 1; e < s; ++e)
            for (int i = 0; i < n; ++i) {
                d = in->con.hw[e]*(force[i*R + e] - base[i*R + e])/(row[e] - was[e]);
                for (int kl = 0; kl < s*s; ++kl) {
                    const int k = kl/s, l = kl % s;
                    const gvi_real W = (k == 0 ? 1 : 0) - Phi[k*R + e];
                    J->square[(size_t)(k*n + i)*size + (size_t)(l*n + j)] -=
                        (gvi_real)(2*k + 1)*W*d*(h*Phi[l*R + e]);
                }
            }
        gvi__copy((size_t)C, was, row);
    }
    if (status == GVI_OK) status = gvi__evaluate_constraints(st, C, s + 1, t, at, in->con.G);
    gvi__constraint_forces(st);
    return status;
}

/* A Lagrangian whose d2L/dv2 is singular (linear in v, a coordinate without mass) would make (1)
   solvable all the same, and its solution worthless.                                         */
static gvi_status gvi__check_regular(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    gvi_real *q = in->newton.column + 2*n, *v = q + n, *W = in->newton.hessian;
    if (gvi__mass_is_constant(in) && !gvi__has(in, GVI__HAS_LAGRANGIAN)) return GVI_OK;
    gvi__gather(n, in->R, in->work.Q, q);
    gvi__gather(n, in->R, in->work.V, v);
    gvi_points y = gvi__one_point(st, in->t, q);
    y.v = v;
    if (!gvi__has(in, GVI__HAS_LAGRANGIAN)) return gvi__factor_mass(st, &y);
    gvi_status status = gvi__evaluate(st, &y, 0, 1);
    if (status == GVI_OK) status = gvi__velocity_hessian(st, &y, v, W);
    if (status != GVI_OK) return status;
    for (int i = 0; i < n; ++i)                                      // p/v does not tell the mass
        if (gvi__mass_is(&st->in, GVI_MASS_NONE) && !gvi__nonzero(v[i]) && gvi__nonzero(W[i*n + i]))
            st->in.watch.scale[i] = 1/GVI_SQRT(GVI_ABS(W[i*n + i]));
    int at;
    status = gvi__lu_factor(n, W, W + n*n, &at);
    return status == GVI_E_SINGULAR ? gvi__report(st, status, GVI_FAULT_MASS, at, GVI_FAULT_NONE)
                                    : GVI_OK;
}

static gvi_status gvi__jacobian_fill(gvi_stepper *st, const gvi__matrix *J)
{
    const size_t n = (size_t)st->n, size = gvi__unknowns(st, J->k0);
    gvi__zero(size*(size + (J->ends ? 2*n : 0)), J->square);
    gvi_status status = gvi__check_regular(st);
    if (status == GVI_OK) status = gvi__jacobian_exact(st, J);
    if (status == GVI_OK && gvi__constrained(st)) status = gvi__jacobian_constraints(st, J);
    return status == GVI_OK ? gvi__jacobian_differences(st, J) : status;
}

static gvi_status gvi__jacobian(gvi_stepper *st, const gvi__matrix *J)
{
    const int n = st->n, size = (int)gvi__unknowns(st, J->k0), modes = (st->s - J->k0)*n;
    int at;
    gvi_status status = gvi__jacobian_fill(st, J);
    if (status != GVI_OK) return status;
    for (int row = 0; row < J->scaled*size; ++row) {
        gvi_real *a = J->square + (size_t)row*(size_t)size,
                 *ends = J->ends + (size_t)row*2*(size_t)n, big = 0;
        for (int j = 0; j < size; ++j) {
            a[j] *= st->in.watch.scale[j % n];
            big = gvi__larger(GVI_ABS(a[j]), big);
        }
        if (!(big > 0)) continue;
        for (int j = 0; j < size; ++j) a[j] /= big;
        for (int j = 0; j < 2*n; ++j) ends[j] /= big;
    }
    // columns of multipliers that would hide the modes': in units that make them as large
    for (int z = modes; z < size; ++z) {
        gvi_real column = 0, diagonal = 0;
        for (int i = 0; i < modes; ++i) {
            column = gvi__larger(GVI_ABS(J->square[(size_t)i*(size_t)size + (size_t)z]), column);
            diagonal = gvi__larger(GVI_ABS(J->square[(size_t)i*((size_t)size + 1)]), diagonal);
        }
        J->unit[z - modes] = 1;
        if (diagonal > 0 && column*GVI_SQRT(GVI__EPS) > diagonal)
            J->unit[z - modes] = diagonal/column;
        for (int i = 0; i < size; ++i)
            J->square[(size_t)i*(size_t)size + (size_t)z] *= J->unit[z - modes];
    }
    status = gvi__lu_factor(size, J->square, J->pivot, &at);
    gvi__count(&st->counters.factorizations, 1);
    if (status == GVI_OK) return GVI_OK;
    if (GVI__CONSTRAINTS && at >= modes)
        return gvi__report_row(st, status, (at - modes) % st->in.con.m, GVI_FAULT_NONE);
    return gvi__report(st, status, GVI_FAULT_NONE, at < 0 ? GVI_FAULT_NONE : at % n,
                       GVI_FAULT_NONE);
}

// y := modes of V as the predictor continues it; rows get that V
static void gvi__newton_modes(gvi_stepper *st, const gvi_real *V, gvi_real *rows)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, R = in->R;
    gvi__stage stage;
    gvi__set_stage(st, &stage, rows, NULL, NULL, NULL);
    gvi__set_predictor(st, &stage, V, NULL);
    in->kernel(st, &stage, 0);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < s; ++k)
            in->row[k] = gvi__dot3(st->r, in->table.phi + k*R, in->table.b, rows + i*R);
        gvi__over_gamma(st, in->row);
        for (int k = 0; k < s; ++k) in->newton.y[k*n + i] = in->row[k];
    }
}

// y := modes of the extrapolated V, and multipliers; or constant velocity
static void gvi__newton_guess(gvi_stepper *st, int extrapolate)
{
    struct gvi__private *in = &st->in;
    gvi_real *y = in->newton.y;
    gvi__zero(gvi__unknowns(st, 0), y);
    if (!extrapolate) {
        gvi__velocity_guess(st, y);
        return;
    }
    gvi__newton_modes(st, in->last.V, in->work.V);
    if (!gvi__constrained(st)) return;
    gvi__predict_constraints(st, 1);
    for (int k = 0, m = in->con.m; k < st->s*m; ++k)
        y[st->s*st->n + k] = in->con.force[(st->n + k % m)*in->R + k/m];
}

/* y += dy from row k0 on; returns the sum of the coordinates' relative changes, to p->each as well;
   but with constraints, which give each coordinate the rounding of all q, the sum of changes over
   the largest coordinate, each times sqrt(M_ii), and to p->grain that rounding.  p->work: the work
   of the change, or -1 where all of it is a few last places of q, or the residual was rounding. */
static gvi_real gvi__newton_update(gvi_stepper *st, const gvi__origin *from, const gvi__matrix *J,
                                   gvi__descent *p)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, solved = p->work <= GVI__SOLVED*GVI__EPS,
              sure = p->holds || p->rho < GVI__CONTRACTS;
    const gvi_real h = GVI_ABS(in->sized.h), none = GVI__MIN/GVI__EPS;
    gvi_real sum = 0, largest = 0, noise = 0, all = 0, length = 0;
    p->work = 0;
    for (int i = 0; i < n; ++i) {
        gvi_real change = 0, size = 0, miss = 0;
        const gvi_real q = GVI_ABS(from->q[i]), unit = in->watch.scale[i];
        for (int k = 0; k < st->s; ++k) {
            gvi_real *y = in->newton.y + k*n + i;
            const int at = (k - J->k0)*n + i;
            in->newton.last[k*n + i] = *y;
            if (k >= J->k0) {
                *y += in->newton.dy[at];
                change += GVI_ABS(in->newton.dy[at]);
                miss += GVI_ABS(in->newton.residual[at]);
                p->work += GVI_ABS(in->newton.dy[at]*in->newton.residual[at]);
            }
            size += GVI_ABS(*y);
        }
        const gvi_real least = GVI__EPS*change;                       // y may land on 0
        if (!(size <= none && change <= none)) sum += change/(size < least ? least : size);
        all += change/unit;
        if (size > length*unit) length = size/unit;
        if (q + h*size > largest*unit) largest = (q + h*size)/unit;
        // a wrong matrix may make the change small, not the residual
        const gvi_real moved = change/unit > miss*unit ? change/unit : miss*unit;
        if (!(h*change <= GVI__PLACE*GVI__EPS*q) && h*moved > noise) noise = h*moved;
    }
    for (size_t k = (size_t)(st->s*n); k < gvi__unknowns(st, 0); ++k) {   // multipliers
        in->newton.last[k] = in->newton.y[k];
        in->newton.y[k] += in->newton.dy[k];
    }
    // see gvi__noise
    const gvi_real place = p->stagnant > 1 ? GVI__NOISE*GVI__EPS*largest : 0;
    if ((noise <= place && sure) || solved) p->work = -1;
    p->each = sum;
    p->grain = GVI__EPS;
    if (!gvi__constrained(st) || !(length > none)) return sum;
    if (largest > h*length) p->grain *= largest/(h*length);
    return all/length;
}

/* The verdict on a change.  One that does not shrink is rounding if y, q or the residual is, or if
   it is small and its matrix is new or has contracted here: an older one can repeat any change.  It
   then hides no more of the error, p->left, than the change before, which shrinks on by the
   contraction seen.  To shrink is to be at most half of the least so far: what is rounded to
   a grid may circle among a few of its points, and fall in every iteration.  Nor is a fall from an
   overshoot far beyond the size of y a contraction.  One ratio by an old matrix may
   be luck: unless the change is rounding, the one before must agree.                          */
static int gvi__newton_converged(gvi_stepper *st, const gvi__matrix *J, gvi__descent *p,
                                 gvi_real change)
{
    const int size = (st->s - J->k0)*st->n;
    const gvi_real before = p->before, all = (gvi_real)st->n, quarter = GVI__CONTRACTS;
    gvi_real ratio = 1, other = 1;
    if (before > 0) ratio = change/gvi__smaller(before, all);
    if (p->earlier > 0) other = before/gvi__smaller(p->earlier, all);
    const gvi_real noise = GVI__GRAIN*p->grain*(gvi_real)size;
    if (!gvi__finite(change)) return GVI__NOT_FINITE;
    if (p->earlier > 0 && change > GVI__SURE*GVI__EPS) {
        const gvi_real contraction = GVI_SQRT(change/p->earlier);
        if (contraction > st->counters.worst_contraction)
            st->counters.worst_contraction = contraction;
    }
    const int stagnant = before > 0 && change > p->least/2;
    p->stagnant = !stagnant ? 0 : p->stagnant + 1;
    if (before > 0 && !stagnant && !(p->left < GVI__MAX)
        && (change > noise || change < p->rho*p->least))
        p->rho = change/p->least;
    if (change < p->least) p->least = change;
    const int felt = !gvi__constrained(st) || p->work >= 0;   // not the rounding of g
    if (before > 0 && change > noise && felt && change > st->in.newton.bend*before)
        st->in.newton.bend = change/before;
    const int fresh = p->fresh & 1, proven = (fresh && p->holds) || p->rho < quarter;
    const int small = change <= noise || (fresh && change <= GVI_SQRT(GVI__EPS));
    if (stagnant && !(p->left < GVI__MAX) && (p->work < 0 || (proven && small))) p->left = before;
    const int rounding = p->left < GVI__MAX;
    if (rounding) p->left *= p->rho < quarter ? p->rho : quarter;

    const gvi_real enough = gvi__larger(st->in.desc.tolerance, GVI__NEWTON_ENOUGH);
    const int confirmed = (fresh && p->holds) || change <= noise || change*other <= enough;
    const int done = (p->each*ratio <= enough && confirmed) || p->left <= enough;
    if (done && (p->holds || p->rho < quarter)) return GVI__DONE;
    // rounding, by a matrix that has contracted here
    const int hidden = p->work < 0 && p->rho < quarter;
    if (!rounding && !hidden && before > 0 && ratio > quarter) p->have = 0;
    p->earlier = before;
    p->before = change;
    return GVI__GO_ON;
}

/* Does y, whose residual has that norm, stay?  A change that is not small and has not reduced the
   residual is taken back, for a new matrix; or halved, if the matrix was new.  Where six halvings
   have not helped, the whole change stands: across a kink, or from one curve to the next, the way
   down may lead up first.  And what seemed to be rounding but grows again was no rounding.    */
static int gvi__newton_stays(gvi_stepper *st, const gvi__matrix *J, gvi__descent *p, gvi_real norm)
{
    enum { HALVES = GVI__NEARER };
    const int rests = p->left < GVI__MAX, fresh = p->fresh & 1;
    if (J->halves && p->halves >= 0 && p->halves <= HALVES && !(norm < p->norm) && !rests
        && p->before > GVI_SQRT(GVI__EPS)) {
        gvi_real *y = st->in.newton.y, *last = st->in.newton.last;
        const gvi_real part = !fresh               ? 0
                              : p->halves < HALVES ? (gvi_real)0.5
                                                   : (gvi_real)(1 << HALVES);
        for (size_t i = 0, all = gvi__unknowns(st, 0); i < all; ++i)
            y[i] = last[i] + part*(y[i] - last[i]);
        if (fresh) p->halves += 1;
        else p->have = 0, p->halves = -1;
        gvi__count(&st->counters.newton_iterations, 1);
        return 0;
    }
    if (p->halves > 0) p->have = 0;                // another place: another matrix
    if (rests && norm/16 > p->norm) {
        p->before = 0;
        p->least = p->left = GVI__MAX;
        p->rho = GVI__CONTRACTS;
    }
    if (!(p->left < GVI__MAX)) p->norm = norm;
    return 1;
}

/* Solves rows k0..s-1 of (1) from the y at hand and leaves F, P, Q, V at the solution.       */
static gvi_status gvi__newton_solve(gvi_stepper *st, const gvi__origin *from, const gvi__matrix *J)
{
    struct gvi__private *in = &st->in;
    // that of steps, not of queries
    const int size = (int)gvi__unknowns(st, J->k0), modes = (st->s - J->k0)*st->n,
              kept = J->pivot == in->newton.pivot;
    gvi__descent p = {
        0, 0, GVI__MAX, GVI__CONTRACTS, GVI__MAX, 0, GVI__MAX, 0, 0, 0, 0, 0, -1, 0
    };
    p.have = kept && !gvi__nonzero(in->newton.h - in->sized.h);
    in->newton.bend = 0;
    in->con.made = 0;
    for (int k = 0, made = 0, verdict = GVI__GO_ON; k <= in->desc.max_iterations; ++k) {
        gvi_status status = gvi__newton_values(st, from);
        // one more evaluation, then done
        if (status != GVI_OK || verdict == GVI__DONE) return status;
        if (!gvi__newton_stays(st, J, &p, gvi__residual(st, from, J->k0, &p))) continue;
        p.fresh = (p.fresh & 1) << 1 | !p.have;
        if (!p.have) {
            if (++made > in->desc.max_iterations/4 + 2) break;
            status = gvi__jacobian(st, J);
            if (status != GVI_OK) return status;
            p.have = 1;
            // by the masses that are known now
            if (k == 0 && gvi__mass_is(in, GVI_MASS_NONE))
                p.norm = gvi__residual(st, from, J->k0, &p);
            if (kept) in->newton.h = in->sized.h;
        }
        // a matrix of differences alone is right
        if (made) p.holds |= !gvi__with_hessian(in, 1);
        gvi_lu_solve(size, J->square, J->pivot, in->newton.dy);
        for (int z = modes; z < size; ++z) in->newton.dy[z] *= J->unit[z - modes];
        gvi__count(&st->counters.newton_iterations, 1);
        verdict = gvi__newton_converged(st, J, &p, gvi__newton_update(st, from, J, &p));
        if (verdict == GVI__NOT_FINITE)
            return gvi__report_status(st, st->in.diagnose ? GVI_E_CONVERGENCE : GVI_E_NON_FINITE);
        p.halves = 0;
    }
    return gvi__report_status(st, GVI_E_CONVERGENCE);
}

/* The sign of the determinant of a matrix.  Where the iteration contracts, that of the solution
   has the same sign; along a branch of solutions it changes where they turn back in h.       */
static int gvi__orientation(const gvi__matrix *J, size_t size)
{
    int sign = 1;
    for (size_t k = 0; k < size; ++k)
        if ((J->square[k*(size + 1)] < 0) != (J->pivot[k] > (gvi_real)k)) sign = -sign;
    return sign;
}

// y := modes of the first `part` of its curve, and `slope` times what that leaves out
static void gvi__newton_shorten(gvi_stepper *st, gvi_real part, const gvi_real *slope)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, R = in->R;
    for (int i = 0; i < n; ++i) {
        gvi__zero((size_t)s, in->row);
        for (int j = 0; j < st->r; ++j) {
            gvi_real V = 0, P = 1, before = 1;
            for (int k = 0; k < s; ++k) {
                V += in->newton.y[k*n + i]*P;
                gvi__legendre(k, 1 - 2*part*in->table.c[j], &P, &before);
            }
            for (int k = 0; k < s; ++k) in->row[k] += in->table.phi[k*R + j]*(in->table.b[j]*V);
        }
        gvi__over_gamma(st, in->row);
        for (int k = 0; k < s; ++k)
            in->newton.y[k*n + i] = in->row[k] + (1 - part)*slope[k*n + i];
    }
}

/* How far is y from `other`? The largest distance of a coordinate, in units of its own size there
   and at h, but no less than 1/64 of the largest, each times sqrt(M_ii).                     */
static gvi_real gvi__newton_apart(const gvi_stepper *st, const gvi_real *other)
{
    const struct gvi__private *in = &st->in;
    gvi_real apart = 0, most = 0, *moved = in->result, *size = moved + st->n;
    for (int i = 0; i < st->n; ++i) {
        moved[i] = size[i] = 0;
        for (int k = i; k < st->s*st->n; k += st->n) {
            moved[i] += GVI_ABS(in->newton.y[k] - other[k])/in->watch.scale[i];
            size[i] += (GVI_ABS(in->newton.found[k]) + GVI_ABS(other[k]))/in->watch.scale[i];
        }
        most = gvi__larger(size[i], most);
    }
    if (!(most > 0)) return 0;
    for (int i = 0; i < st->n; ++i)
        if (!(moved[i]/(size[i] + most/64) <= apart)) apart = moved[i]/(size[i] + most/64);
    return apart;
}

/* Is the solution y the motion's, the one that free motion turns into as h grows from 0? It is
   followed back to shorter steps, from length to length by a prediction: the same curve, changed
   as it changed last.  From a continuous branch the prediction is not far when the lengths are
   close; where it is however close they are, the branch has turned back.  A length is enough
   where the iteration contracts well from constant velocity, h/64 in any case.  If it then comes
   to the same solution, or to none, y is accepted.                                           */
static gvi_status gvi__newton_connected(gvi_stepper *st, const gvi__origin *from,
                                        const gvi__matrix *J)
{
    struct gvi__newton *newton = &st->in.newton;
    const size_t all = gvi__unknowns(st, 0), modes = (size_t)(st->s*st->n);
    const gvi_real h = st->in.sized.h, close = GVI__CLOSE;
    const unsigned count = (unsigned)st->counters.newton_iterations,
                   enough = 32*(unsigned)st->in.desc.max_iterations;
    const int sign = gvi__orientation(J, all);
    // that of queries
    gvi__matrix K = { newton->J + all*all, newton->pivot + all + 1, NULL, 0, 0, 0,
                      st->in.con.unit };
    if (K.unit) K.unit += all - modes;
    gvi_real part = 1, factor = (gvi_real)0.5;
    int right = -1;                                                  // not known
    gvi__copy(all, newton->y, newton->found);
    gvi__copy(all, newton->y, newton->branch);
    gvi__zero(all, newton->slope);
    while (right < 0) {
        if ((unsigned)st->counters.newton_iterations - count > enough) right = 0;
        gvi__copy(all, newton->branch, newton->y);
        gvi__newton_shorten(st, factor, newton->slope);
        gvi__copy(all, newton->y, newton->guess);
        gvi__free_motion(st, from, h*(part*factor));
        const int found =
            gvi__newton_solve(st, from, &K) == GVI_OK && gvi__orientation(&K, all) == sign;
        const gvi_real apart = found ? gvi__newton_apart(st, newton->guess) : 1;
        if (!(apart <= close)) {
            factor = GVI_SQRT(factor);
            if (factor > (gvi_real)0.9998) right = 0;
            continue;
        }
        part *= factor;
        gvi__copy(all, newton->y, newton->branch);
        for (size_t k = 0; k < modes; ++k)
            newton->slope[k] += (newton->y[k] - newton->guess[k])/(1 - factor);
        if (factor > (gvi_real)0.5) {
            if (apart < close/4) factor *= factor;
            continue;
        }
        gvi__newton_guess(st, 0);
        const int other = gvi__newton_solve(st, from, &K) == GVI_OK;
        if ((other && newton->bend <= close) || part < 1/(gvi_real)GVI__SHORT)
            right = !other || gvi__newton_apart(st, newton->branch) <= close;
    }
    gvi__free_motion(st, from, h);
    gvi__copy(all, newton->found, newton->y);
    return right ? gvi__newton_values(st, from) : gvi__report_status(st, GVI_E_CONVERGENCE);
}

/* Did the rank of G change between two points of the step?  What those before row j leave of it is
   c G, c the row of L^-1: where that is a small part of row j at a point, has it turned by more
   than 25 degrees at the next, or almost vanished?  It passes 0 where the motion branches,
   and has another direction on each branch: the step must not choose.                        */
GVI__CALLED gvi_status gvi__newton_crossing(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, C = in->con.C;
    gvi_real *c = in->con.y, *now = in->result, *next = now + n;
    const gvi_points at = gvi__points_at(st, st->r, in->R, in->t, in->work.Q, NULL, NULL);
    gvi_status status = GVI_OK;
    if (gvi__mass_is(in, GVI_MASS_POSITION)) status = gvi__factor_mass(st, &at);
    if (status == GVI_OK)
        status = gvi__factor_constraints(st, C, st->s, in->con.G, in->con.A, in->con.drops);
    if (status != GVI_OK) return status;
    for (int ej = 0; ej < st->s*m; ++ej) {
        const int e = ej/m, j = ej % m;
        const gvi_real *A = in->con.A + e;
        gvi_real all = 0;
        if (!(gvi__loss(st, j, e) > GVI__LOST*GVI__LOST - 1)) continue;
        gvi__zero(2*(size_t)n, now);
        for (int l = j; l >= 0; --l) {
            const gvi_real *G = in->con.G + l*n*C + e;
            c[l] = (gvi_real)(l == j);
            for (int i = l + 1; i <= j; ++i) c[l] -= A[(i*m + l)*C]*c[i];
            for (int i = gvi__column(st, l, 0); i < n; i = gvi__column(st, l, i + 1)) {
                now[i] += c[l]*G[i*C];
                next[i] += c[l]*G[i*C + 1];
                if (l == j) all += G[i*C]*G[i*C];
            }
        }
        const gvi_real part = gvi__dot(n, now, now), there = gvi__dot(n, next, next);
        const int goes_on = 256*there > part
            && gvi__dot(n, now, next) > (gvi_real)0.9*GVI_SQRT(part)*GVI_SQRT(there);
        if (GVI__LOST*GVI__LOST*part < all && !goes_on)
            return gvi__report_row(st, GVI_E_SINGULAR, j, e);
    }
    return GVI_OK;
}

/* Newton's method for a step.  A solution is taken for the motion's where the iteration contracts
   well from its start and the orientation is that of free motion; or else it is followed back. */
static gvi_status gvi__newton_step(gvi_stepper *st, const gvi__origin *from, int how, int query)
{
    struct gvi__private *in = &st->in;
    const size_t all = gvi__unknowns(st, 0);
    gvi__matrix J = { in->newton.J + (query ? all*all : 0),
                      in->newton.pivot + (query ? all + 1 : 0),
                      NULL, 0, 0, how == GVI__HALVED, in->con.unit };
    if (query && J.unit) J.unit += all - (size_t)(st->s*st->n);
    // few points see little of what is between
    const gvi_real far = st->s > 2 ? GVI__CONTRACTS : GVI__LINEAR;
    int old = !query && !gvi__nonzero(in->newton.h - in->sized.h);
    gvi_real *v = in->result + 2*st->n;
    gvi_status status = GVI_OK;
    gvi__velocity_guess(st, v);
    if (gvi__constrained(st))                     // which rows depend on others at the start?
        status = gvi__constraints_at(st, from->t, from->q, NULL, v, in->con.drops);
    if (status != GVI_OK) return status;
    for (;;) {
        gvi__newton_guess(st, how == GVI__EXTRAPOLATED);
        status = gvi__newton_solve(st, from, &J);
        if (!old || status != GVI_OK || !(in->newton.bend > far)) break;
        in->newton.h = 0;                          // that may be the old matrix's fault
        old = 0;
    }
    if (status == GVI_OK
        && (J.halves || in->newton.bend > far || gvi__orientation(&J, all) < 0)) {
        J.halves = 0;
        status = gvi__newton_connected(st, from, &J);
    }
    if (status == GVI_OK && gvi__constrained(st)) status = gvi__newton_crossing(st);
    if (status != GVI_OK) return status;
    // it made none to go on from
    if (GVI__LAGRANGIAN && in->work.A) gvi__zero((size_t)(st->n*in->R), in->work.A);
    for (int i = 0; i < st->n; ++i) {
        const gvi__two q = gvi__two_prod(in->sized.h, in->newton.y[i]);
        in->step.q[i] = q.hi;
        in->step.q_low[i] = gvi__low(q.lo + from->q_low[i]);
    }
    gvi__momentum_increment(st, from);
    return GVI_OK;
}

/* ------------------------------------------------------------------ STEP

   A step of length h takes (q, p, t) to (q + dq, p + dp, t + dt), in double words.  In this order:

     1) free motion   v = M^-1 p and h c_i v, the terms of (3) and (4) without forces
     2) predictor     F (V, A) at the points, extrapolated from the last step
     3) stages        Q by (3) from F; V by (4), or P and Q by (5)
     4) effects       F(Q), at all points in one call
     5) verdict       3) once more, then again from 4), until all rows converge: gvi__iterate
     6) increments    dp by (2), dq by (3) at tau = 1 or by (5); then G v + dg/dt = 0
     7) commit        the state moves on

   gvi__iterate is 2) to 5), gvi__attempt 1) to 6), with Newton's method (1) where the fixed point
   fails, gvi__solve one attempt and a second that names the effect where NaN came up, and gvi_step
   all of it.  Where explicit, gvi__kicks stands for 2) to 6).                                 */

/* What an iteration computes, in this order: positions (3); or these, and velocities (4); or
   momenta and positions (5).  Returns the number of stages.                                  */
static int gvi__stages(const gvi_stepper *st, const gvi__origin *from, gvi_real h,
                       gvi__stage *stage)
{
    const struct gvi__private *in = &st->in;
    const struct gvi__values *w = &in->work;
    const gvi_real *low[2], *hb = in->sized.hb;
    const int n = st->n, R = in->R, momenta = gvi__has(in, GVI__BY_MOMENTA);
    const int count = 1 + gvi__has(in, GVI__TWO_STAGES);
    if (momenta) {
        gvi__set_stage(st, stage, w->P, in->table.U, hb, w->F);
        gvi__set_stage(st, stage + 1, w->Q, in->table.T, hb, w->V);
        stage[0].base = from->p;
        stage[1].base = from->q;
        low[0] = from->p_low;
        low[1] = from->q_low;
    } else {
        gvi__set_stage(st, stage, w->Q, in->table.K, hb, w->F);
        stage[0].base = from->q;
        low[0] = from->q_low;
        stage[0].factor = h;
        if (count == 2) {
            gvi__set_stage(st, stage + 1, w->V, in->table.U, hb, w->F);
            stage[1].base = in->free.v;
            low[1] = in->free.v_low;
        }
        for (int k = 0; k < count; ++k) {
            gvi__sum A = { in->table.T, in->table.b, w->A };
            if (k == 1) A.table = in->table.N;
            if (GVI__LAGRANGIAN && w->A) stage[k].sum[1] = A;
            if (in->desc.mass.kind == GVI_MASS_DIAGONAL) stage[k].inverse = in->mass.inverse;
            stage[k].dense = in->desc.mass.kind == GVI_MASS_DENSE;
        }
    }
    for (int k = 0; k < count; ++k) {
        gvi_real *free = in->free.rows + k*n*R;
        const int moves = !momenta && k == 0;
        stage[k].free = free;
        stage[k].scale = in->watch.scale + k*n;
        stage[k].change = in->watch.change + k*n;
        for (int i = 0; i < n; ++i, free += R) {
            gvi_real path = 0, path_low = 0;
            if (moves) {
                path = in->free.path[i];
                path_low = in->free.path_low[i];
            }
            gvi__free_row(R, low[k][i], path, path_low, in->table.c, free);
        }
    }
    return count;
}

// 2) F (V, A) of the last step, extrapolated; or no force and constant velocity
static gvi_status gvi__predict_sources(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                       int extrapolate)
{
    struct gvi__private *in = &st->in;
    struct gvi__values *w = &in->work;
    const int momenta = gvi__has(in, GVI__BY_MOMENTA);
    gvi_real *to[3] = { w->F, NULL, NULL };
    if (momenta) to[1] = w->V;
    if (GVI__LAGRANGIAN) to[2] = w->A;
    const gvi_real *const last[3] = { in->last.F, in->last.V, in->last.A };
    const gvi_real *const older[3] = { in->older.F, in->older.V, in->older.A };
    gvi_real rate = 1;
    if (gvi__clock_is_on(st)) {                   // times of the points as if g stayed as it is
        const gvi_status status = gvi__clock_at(st, from->t, from->q, &rate, in->result);
        if (status != GVI_OK) return status;
        gvi__times(st->r, from->t, from->t_low, h*rate, in->table.c, in->t);
    }
    if (gvi__constrained(st)) gvi__predict_constraints(st, extrapolate);
    for (int k = 0; k < 3; ++k) {
        gvi__stage stage;
        if (!to[k]) continue;
        gvi__set_stage(st, &stage, to[k], NULL, NULL, NULL);
        gvi__set_predictor(st, &stage, last[k], older[k]);
        if (extrapolate) in->kernel(st, &stage, 0);
        else gvi__zero((size_t)st->n*(size_t)in->R, to[k]);
    }
    if (!momenta || extrapolate) return GVI_OK;
    gvi__velocity_guess(st, in->result);
    for (int i = 0; i < st->n; ++i)
        for (int k = 0; k < st->r; ++k) w->V[i*in->R + k] = rate*in->result[i];
    return GVI_OK;
}

// x := zero, a 0 that the compiler does not know: it would call memset, and wait for it, every time
static void gvi__clear(int n, gvi_real zero, gvi_real *x)
{
    GVI__ALONG(n, const gvi__number none = { 0 }; GVI__TO(x) = none + zero)
}

// 4) F (and A, V) at the stage values, all points in one call an effect
static gvi_status gvi__evaluate_stages(gvi_stepper *st, const gvi__origin *from, gvi_points *at)
{
    struct gvi__private *in = &st->in;
    const int length = st->n*in->R, momenta = gvi__has(in, GVI__BY_MOMENTA);
    gvi_status status = GVI_OK;
    gvi__clear(length, in->zeros[0], at->f);
    if (momenta) {                                // V from dL/dv(Q, V) = P
        gvi__count(&st->counters.velocities, st->r);
        if (in->desc.mass.velocity) status = gvi__evaluate_mass(st, at, in->work.P, in->work.V);
        else if (!gvi__mass_is_constant(in)) status = gvi__factor_mass(st, at);
        if (status != GVI_OK) return status;
        in->has_factor = 1;
        if (!in->desc.mass.velocity) gvi__velocity_rows(st);
        else if (in->diagnose) status = gvi__check_rows(st, at, in->work.V, GVI_FAULT_MASS);
        if (status != GVI_OK) return status;
    }
    if (GVI__LAGRANGIAN && at->dldv) gvi__clear(length, in->zeros[0], at->dldv);
    if (gvi__clock_is_on(st)) return gvi__evaluate_with_clock(st, from, at);
    status = gvi__effects(st, at, 0, NULL);
    if (status == GVI_OK && gvi__constrained(st)) status = gvi__constraint_values(st, from);
    if (status == GVI_OK && momenta && gvi__mass_is(in, GVI_MASS_POSITION))
        status = gvi__mass_gradient(st, at);
    return status;
}

// 3) new stage values from F, V, A; returns the squares of their changes
GVI__BODY gvi_real gvi__new_rows(gvi_stepper *st, const gvi__stage *stage, int stages, int rescale)
{
    const struct gvi__private *in = &st->in;
    gvi_real sum = 0;
    if (gvi__constrained(st) && in->con.made > 0)
        gvi__constrain(st, stage, stage[gvi__has(in, GVI__BY_MOMENTA)].base);
    for (int k = 0; k < stages; ++k) {
        if (k == 1 && gvi__has(in, GVI__BY_MOMENTA)) sum += gvi__velocities_again(st);
        if (stage[k].dense) sum += gvi__dense_rows(st, stage + k, rescale);
        else sum += in->kernel(st, stage + k, rescale);
    }
    if (gvi__constrained(st)) {
        st->in.con.linear |=
            GVI__DIG > FLT_MANT_DIG && in->con.made > 0 && sum < GVI__EPS*GVI_SQRT(GVI__EPS);
        gvi__constraint_rows(st, stage);
    }
    if (stages == 2 && !gvi__has(in, GVI__BY_MOMENTA)) gvi__count(&st->counters.velocities, st->r);
    return sum;
}

// may a step that does not converge turn to Newton's method?
static int gvi__may_turn(const gvi_stepper *st)
{
    return st->in.desc.formulation == GVI_AUTO && gvi__has(&st->in, GVI__HAS_NEWTON);
}

/* Where an iteration stands, in squares: the changes of the last two iterations, of all rows,
   and the least so far; the contraction of the last step, 1 if there is none, or 2 if no ratio
   counts; gvi__noise when it was last made, and its least; how often no new least was seen, of
   change or noise, or no good contraction; are units to be made anew?                         */
typedef struct gvi__progress {
    gvi_real before, earlier, least, ratio, noise, quiet;
    int      used, stagnant, still, growing, rescale;
} gvi__progress;

/* The largest change of a row that is beyond a few units of the last place of its largest
   value, in units of 32 eps of the largest amplitude; 0: there is none.  An amplitude is |Q_i|
   times sqrt(M_ii), with h V_i or h P_i/M_ii in place of Q_i for those rows.  Up to 1 a row
   that does not settle is nothing but noise, where large forces cancel: a light body midway
   between two heavy ones.  So, whatever the amplitude, is a move due to the rounding of a force of
   constraint, 32 eps of it, or to its last change where that came from the rounding of g, which
   nearly dependent rows make large: such a move counts next to nothing.                        */
static gvi_real gvi__noise(const gvi_stepper *st, gvi_real h, const gvi__stage *stage, int stages)
{
    const int R = st->in.R, C = st->in.con.C, held = gvi__constrained(st)*st->s,
              momenta = gvi__has(&st->in, GVI__BY_MOMENTA);
    gvi_real largest = 0, noise = 0, *moved = st->in.con.W;       // n sums for each source
    if (held) gvi__constraints_moved(st, moved);
    for (int k = 0; k < stages; ++k) {
        if (!stage[k].scale) continue;
        for (int i = 0; i < st->n; ++i) {
            const gvi_real m = gvi__inertia(st, i), *row = stage[k].rows + i*R;
            gvi_real size = GVI_ABS(stage[k].base[i]), push = 0, unit = 1, change = 0;
            if (stages == 2 && k != momenta) unit = GVI_ABS(h);                  // V or P
            if (momenta && k == 0) unit /= m;                                    // P
            unit *= GVI_SQRT(m);
            for (int j = 0; j < st->r; ++j) size = gvi__larger(GVI_ABS(row[j]), size);
            for (int e = 0; e < held; ++e) {
                const gvi_real force = GVI__NOISE*GVI__EPS*GVI_ABS(h*st->in.con.force[i*R + e])
                                       + moved[i*C + e]/GVI_ABS(st->in.con.hw[e]);
                push = gvi__larger(GVI_ABS(h)*force/m, push);
            }
            if (stage[k].scale[i] > 0) change = GVI_SQRT(stage[k].change[i])/stage[k].scale[i];
            largest = gvi__larger(unit*size, largest);
            if (!(change > GVI__PLACE*GVI__EPS*size)) continue;
            if (change <= push) change *= GVI__EPS;
            noise = gvi__larger(unit*change, noise);
        }
    }
    if (!(noise > 0)) return 0;
    return noise/(GVI__NOISE*GVI__EPS*largest);
}

/* 5) The verdict on a change D of all rows; what ends an iteration is listed at gvi__iterate.  One
   ratio may be luck: unless D is rounding, the one before, or that of the last step, must agree;
   after an attempt that failed D itself must be within the tolerance.  All in squares, so that
   nothing waits for a root.                                                                   */
static int gvi__converged(gvi_stepper *st, gvi__progress *p, gvi_real D, gvi_real h,
                          const gvi__stage *stage, int stages)
{
    const gvi_desc *d = &st->in.desc;
    const gvi_real wanted = gvi__larger(d->tolerance, GVI__ENOUGH), tolerance = wanted*wanted;
    const gvi_real eps2 = GVI__EPS*GVI__EPS, all = eps2*(gvi_real)(st->n*st->r),
                   rounding = GVI__PLACE*GVI__PLACE*all, sure = GVI__SURE*GVI__SURE*all;
    const gvi_real before = p->before, earlier = p->earlier, worst = st->counters.worst_contraction;
    const int grows = before > 0 && D >= before*(GVI__POOR*GVI__POOR);
    const int alone = p->used == 1 || p->ratio > 1;
    gvi_real last = D;
    if (!alone) last = gvi__smaller(before, 1);
    int settled = D*D <= tolerance*last && d->iterations == 0;
    if (settled && !alone && D > rounding) {
        gvi_real other = p->ratio;
        if (earlier > 0) other = before/gvi__smaller(earlier, 1);
        settled = D*other <= tolerance;
        if (settled) st->in.watch.found = D/last;
    }
    if (settled) {
        int rows = 0;                             // no row hides behind a larger one
        for (; rows < stages*st->n; ++rows) {
            const gvi_real Di = st->in.watch.change[rows];
            gvi_real before_i = Di;
            if (!alone) before_i = gvi__smaller(st->in.watch.before[rows], 1);
            if (Di > 2*eps2 && Di*Di > tolerance*before_i) break;
        }
        if (rows == stages*st->n) return GVI__DONE;
    }
    if (!gvi__finite(D)) return GVI__NOT_FINITE;

    // contraction over two iterations, as long as it is not about rounding
    if (earlier > 0 && D > GVI__SURE*GVI__SURE*eps2 && D > worst*worst*worst*worst*earlier)
        st->counters.worst_contraction = GVI_SQRT(GVI_SQRT(D/earlier));
    p->rescale = D > GVI__FAR*GVI__FAR || grows;  // those were the units of an overshoot
    p->earlier = before;
    p->before = D;
    if (d->iterations > 0) {
        if (p->used < d->iterations) return GVI__GO_ON;
        int falls = before <= 0 || D < before;
        if (earlier > 0) falls = D < earlier*(GVI__POOR*GVI__POOR);
        if (before > 0 && D > GVI__FAR*GVI__FAR) falls = 0;         // its units may grow with it
        if (falls || D <= sure || gvi__noise(st, h, stage, stages) <= 1) return GVI__DONE;
        return GVI__DIVERGES;
    }
    p->growing += 1;
    if (!grows) p->growing = 0;
    p->stagnant += 1;
    if (D < GVI__LEAST*GVI__LEAST*p->least) p->stagnant = 0;
    p->least = gvi__smaller(p->least, D);
    const gvi_real grain = GVI__GRAIN*GVI__GRAIN*all;
    if (gvi__constrained(st) && D > 16*p->least && D > grain) {
        // near a bifurcation it would be leaving the motion, perhaps for that of another branch
        const int m = st->in.con.m;
        gvi_real loss = 0;
        for (int k = 0; k < st->s*m; ++k) loss = gvi__larger(gvi__loss(st, k % m, k/m), loss);
        if (loss > GVI__LOST - 1 && D > grain*loss*loss*loss) return GVI__DIVERGES;
    }
    int allowed = GVI__FEW_POOR;
    if (D > GVI__FAR*GVI__FAR) allowed = GVI__MANY_POOR;
    const int poor = p->growing > allowed && D > sure;
    const int wait = !gvi__constrained(st);                  // the rounding of g is in every D
    if (p->stagnant > wait || poor) {
        const gvi_real noise = gvi__noise(st, h, stage, stages);
        p->still += 1;
        if (noise < p->quiet) p->still = 0;       // a new minimum still converges, perhaps to 0
        const int level = noise <= GVI__EPS || (p->still > GVI__STILL && noise <= p->noise);
        int rests = p->stagnant > 1;
        if (wait) rests = p->stagnant > GVI__STAGNANT && level;
        if (p->stagnant > wait && (noise <= 0 || (noise <= 1 && rests))) {
            const int slow = p->used - p->stagnant >= GVI__SLOW;
            if (slow && gvi__may_turn(st)) return GVI__DIVERGES;
            return GVI__ONCE_MORE;
        }
        // a row that tends to 0 changes by its whole size: does its amplitude fall?
        if (poor && noise > 1 && noise > p->noise/2 && gvi__may_turn(st)) return GVI__DIVERGES;
        p->noise = noise;
        if (p->still == 0) p->quiet = noise;
    }
    if (p->used < d->max_iterations) return GVI__GO_ON;
    return GVI__DIVERGES;
}

/* The fixed point.  It ends where
     - the next change, D times the ratio of the last two, is within the tolerance, or far below
       rounding, of all rows and of each whose own D is not in its last place: done;
     - D stagnates at rounding: F once more, so that rows that go to and fro in their last places
       end with their own F, not that of the side they came from, which is a bias: done;
     - iterations are given and made: done if D falls, or is rounding;
     - D falls by less than GVI__POOR too often, or reached rounding slowly, which lets errors grow
       before they shrink; constraints lose rank; max_iterations are made: no convergence, and
       gvi__attempt goes on from plain values or by Newton's method;
     - D is not finite: no convergence, or an effect's fault.                                  */
GVI__APART gvi_status gvi__iterate(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                   int extrapolate, int *used)
{
    struct gvi__private *in = &st->in;
    gvi__stage stage[2], first;
    gvi__progress p = { 0, 0, GVI__MAX, 1, GVI__MAX, GVI__MAX, 0, 0, 0, 0, 1 };
    gvi_points at = gvi__points_at(st, st->r, in->R, in->t, in->work.Q, in->work.F,
                                   GVI__LAGRANGIAN ? in->work.A : NULL);
    const int stages = gvi__stages(st, from, h, stage);
    gvi_status status = GVI_OK;
    if (gvi__constrained(st)) gvi__constraint_stages(st, from, h, stage, stages);
    if (GVI__CONSTRAINTS) in->con.made = in->con.linear = 0;
    at.v = in->work.V;
    if (*used > 0) p.ratio = 2;                   // the attempt before this one failed
    else if (extrapolate && GVI_ABS(h) <= GVI_ABS(st->h)) p.ratio = in->watch.ratio;
    in->watch.found = gvi__smaller(p.ratio, 1);
    *used = 0;
    in->has_factor = 0;

    // 2) what the predictor makes: stage values at once, or F (V, A), and of these stage values
    if (extrapolate && in->sized.sums) {
        first = stage[0];
        gvi__set_predictor(st, &first, in->last.F, in->older.F);
        in->kernel(st, &first, 0);
    } else {
        status = gvi__predict_sources(st, from, h, extrapolate);
        if (status != GVI_OK) return status;
        gvi__new_rows(st, stage, stages, 0);
    }
    p.used = *used = 1;
    for (int shorter = 0, last = 0; ; ) {
        status = gvi__evaluate_stages(st, from, &at);                                        // 4)
        // free motion may leave a callback's domain though the motion does not: halve the way
        if (status == GVI_E_CALLBACK && p.used == 1 && !extrapolate && shorter++ < GVI__NEARER) {
            for (int i = 0; i < st->n; ++i)
                for (int k = 0; k < in->R; ++k)
                    in->work.Q[i*in->R + k] = (in->work.Q[i*in->R + k] + from->q[i])/2;
            continue;
        }
        if (last && status == GVI_OK && gvi__constrained(st)) gvi__constrain(st, stage, from->q);
        if (last || status != GVI_OK) return status;
        const int diverged = p.growing > 0 || p.before > (gvi_real)st->n;
        const gvi_real change = gvi__new_rows(st, stage, stages, p.rescale);                  // 3)
        const int verdict = gvi__converged(st, &p, change, h, stage, stages);                 // 5)
        if (verdict == GVI__GO_ON) {
            gvi_real *spare = in->watch.before;
            in->watch.before = in->watch.change;
            in->watch.change = spare;
            for (int k = 0; k < stages; ++k) stage[k].change = spare + k*st->n;
            p.used = *used += 1;
            continue;
        }
        if (verdict == GVI__NOT_FINITE && !diverged && !in->diagnose)  // the effects are looked at
            return gvi__report_status(st, GVI_E_NON_FINITE);
        if (verdict == GVI__NOT_FINITE || verdict == GVI__DIVERGES)
            return gvi__report_status(st, GVI_E_CONVERGENCE);
        const gvi_real worst = st->counters.worst_change;
        if (change > worst*worst) st->counters.worst_change = GVI_SQRT(change);
        if (verdict == GVI__DONE) return GVI_OK;
        last = 1;
    }
}

/* 6) Increments of q and p from the F, V and A at the end of the iteration, by (2) and by (3) at
   tau = 1, where S_j = c_j: dq = h (v + M^-1 (sum_j (1 - c_j) h b_j F_j - sum_j b_j A_j)).    */
static void gvi__increments(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    struct gvi__private *in = &st->in;
    struct gvi__values *w = &in->work;
    const gvi_real *c = in->table.c, *hb = in->sized.hb;
    const int R = in->R, r = st->r;
    if (gvi__clock_is_on(st)) {
        in->dt = gvi__dot(r, hb, in->time.rate);
        in->time.dH = gvi__dot(r, hb, in->time.power);
    }
    gvi__momentum_increment(st, from);
    if (gvi__has(in, GVI__BY_MOMENTA)) {
        gvi__sum_rows(st, w->V, from->q_low, in->step.q, in->step.q_low);
        return;
    }
    for (int i = 0; i < st->n; ++i) {
        const gvi_real *F = w->F + i*R;
        gvi_real sum[4] = { 0, 0, 0, 0 };
        for (int o = 0; o + 3 < R; o += 4)
            for (int k = 0; k < 4; ++k) sum[k] += (1 - c[o + k])*(hb[o + k]*F[o + k]);
        for (int k = R & ~3; k < R; ++k) sum[k & 3] += (1 - c[k])*(hb[k]*F[k]);
        in->step.q[i] = (sum[0] + sum[2]) + (sum[1] + sum[3]);
        if (gvi__constrained(st)) {
            const gvi__two a = gvi__moment(r, c, hb, F),
                           z = gvi__moment(st->s, in->con.d, in->con.hw, in->con.force + i*R);
            in->step.q[i] = (a.hi + z.hi) + (a.lo + z.lo);
        }
        if (GVI__LAGRANGIAN && w->A) in->step.q[i] -= gvi__dot(r, in->table.b, w->A + i*R);
    }
    gvi__over_mass(st, in->step.q, 1, 1);
    for (int i = 0; i < st->n; ++i) {
        const gvi__two bend = gvi__two_prod(h, in->step.q[i]),
                       q = gvi__two_sum(in->free.path[i], bend.hi);
        in->step.q[i] = q.hi;
        in->step.q_low[i] = gvi__low((q.lo + bend.lo) + (in->free.path_low[i] + from->q_low[i]));
    }
}

/* ---- kicks ---- */

/* dp += b F, then the drift dq += a (v + M^-1 dp), Q = q + dq; F := 0 for the next force.  First
   in a step, dp and dq are the low words of the state, and F is `first`.                      */
GVI__BODY void gvi__drift(gvi_stepper *st, const gvi__origin *from, const gvi_real *GVI__RESTRICT v,
                          const gvi_real *first, gvi_real b, gvi_real a)
{
    struct gvi__private *in = &st->in;
    const gvi_real *GVI__RESTRICT q = from->q, *GVI__RESTRICT m = in->mass.inverse;
    gvi_real *GVI__RESTRICT F = in->work.F, *GVI__RESTRICT Q = in->work.Q;
    gvi_real *GVI__RESTRICT dp = in->step.p, *GVI__RESTRICT dq = in->step.q, *z = in->result;
    const gvi_real *p0 = dp, *q0 = dq, *f = F;
    if (first) {
        p0 = from->p_low;
        q0 = from->q_low;
        f = first;
    }
    const int n = st->n;
    if (in->desc.mass.kind == GVI_MASS_DENSE) {
        for (int i = 0; i < n; ++i) z[i] = dp[i] = p0[i] + b*f[i];
        gvi__over_mass(st, z, 1, 1);
        for (int i = 0; i < n; ++i) {
            F[i] = 0;
            dq[i] = q0[i] + a*(v[i] + z[i]);
            Q[i] = q[i] + dq[i];
        }
        return;
    }
    GVI__ALONG(n,
        const gvi__number p = GVI__AT(p0) + b*GVI__AT(f), none = { 0 };
        const gvi__number d = GVI__AT(q0) + a*(GVI__AT(v) + p*GVI__AT(m));
        GVI__TO(dp) = p;
        GVI__TO(F) = none;
        GVI__TO(dq) = d;
        GVI__TO(Q) = GVI__AT(q) + d)
}

/* Kicks h b_j F_j at the nodes, drifts between them: one evaluation a kick; none where a weight is
   0, but for the last, whose F the next step may begin with.  `force`: F at the start, or NULL. */
static gvi_status gvi__kicks(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                             const gvi_real *force)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, r = st->r, known = force && gvi__nonzero(in->sized.hb[0]);
    const int held = gvi__constrained(st) ? 1 : -1;
    const gvi_real *hb = in->sized.hb, *v = in->free.v;
    if (in->desc.mass.kind == GVI_MASS_UNIT) v = from->p;
    gvi_real t = from->t, b = 0;
    gvi_points at = gvi__points_at(st, 1, 1, &t, in->work.Q, in->work.F, NULL);
    if (v != from->p) {
        gvi__copy((size_t)n, from->p, in->free.v);
        gvi__over_mass(st, in->free.v, 1, 1);
    }
    if (known) b = hb[0];
    for (int j = known; j < r; ++j) {
        if (j == known) gvi__drift(st, from, v, known ? force : in->zeros, b, in->sized.drift[j]);
        else gvi__drift(st, from, v, NULL, b, in->sized.drift[j]);
        if (j == held) {
            const gvi_status status = gvi__constrained_drift(st, from, h);
            if (status != GVI_OK) return status;
        }
        t = from->t + (from->t_low + in->table.c[j]*h);
        b = hb[j];
        if (j < r - 1 && !gvi__nonzero(b)) continue;
        const gvi_status status = gvi__effects(st, &at, 0, NULL);
        if (status != GVI_OK) return status;
    }

    // the last kick, and the drift behind it, if there is one
    gvi_real *last = in->result + n;
    if (gvi__nonzero(in->sized.drift[r])) {
        gvi__copy((size_t)n, in->work.F, last);
        gvi__drift(st, from, v, NULL, b, in->sized.drift[r]);
        gvi__copy((size_t)n, last, in->work.F);
    } else gvi__add_scaled(n, b, in->work.F, in->step.p, in->step.p);
    return GVI_OK;
}

/* ---- an attempt, and the step ---- */

/* One attempt at a step or a partial step, to its increments; nothing of it is kept yet.  The
   fixed point from extrapolated values, then from plain ones, then Newton's method, likewise.  */
static gvi_status gvi__attempt(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    struct gvi__private *in = &st->in;
    gvi__free_motion(st, from, h);                                                           // 1)
    st->formulation = in->chosen;
    if (!gvi__has(in, GVI__ITERATES)) {
        const gvi_real *F = NULL;                 // the force at the start, if it is known
        if (in->has_force && query != GVI__FROM_START) F = in->last.F;
        const gvi_status status = gvi__kicks(st, from, h, F);
        if (status != GVI_OK || !gvi__constrained(st)) return status;
        return gvi__project(st, from, 0);
    }

    // an extrapolation any farther is no better than no force
    const int usable = in->kept > 0 && h/st->h > -GVI__BACK && h/st->h < GVI__AHEAD;
    int used = 0;
    gvi_status status = GVI_E_CONVERGENCE;
    if (gvi__has(in, GVI__FIXED_POINT) && (in->newton.left == 0 || query)) {
        if (usable) gvi__prepare_predictor(st, h, query);
        for (int plain = !usable; plain < 2; ++plain) {
            status = gvi__iterate(st, from, h, !plain, &used);                           // 2) to 5)
            gvi__count(&st->counters.iterations, used);
            if (!query) st->iterations = used;
            if (used > st->counters.most_iterations) st->counters.most_iterations = used;
            // iterations given: only what failed in the first one is tried again
            if (status == GVI_OK
                || (in->desc.iterations > 0 && (used > 1 || status == GVI_E_CONVERGENCE)))
                break;
        }
        if (status == GVI_OK) gvi__increments(st, from, h);                                  // 6)
        if (status == GVI_OK && gvi__constrained(st)) status = gvi__project(st, from, 0);
        if (status == GVI_OK || !gvi__may_turn(st)) return status;
        if (!query && (status == GVI_E_CONVERGENCE || gvi__constrained(st)))
            in->newton.left = GVI__BY_NEWTON;
    }
    if (!GVI__NEWTON) return status;
    const unsigned count = (unsigned)st->counters.newton_iterations;
    st->formulation = GVI_NEWTON;
    if (usable) gvi__prepare_predictor(st, h, query);
    const int extrapolated = usable && in->has_velocity;
    int how = GVI__PLAIN;
    if (extrapolated) how = GVI__EXTRAPOLATED;
    status = gvi__newton_step(st, from, how, query);
    if (status == GVI_E_CONVERGENCE || status == GVI_E_SINGULAR
        || (status == GVI_E_CALLBACK && extrapolated)
        || (status == GVI_E_NON_FINITE && !in->diagnose)) {
        if (!query) in->newton.h = 0;              // the extrapolation may be to blame
        status = gvi__newton_step(st, from, GVI__HALVED, query);
    }
    if (!query) st->iterations = used + (int)((unsigned)st->counters.newton_iterations - count);
    return status == GVI_OK && gvi__constrained(st) ? gvi__project(st, from, 0) : status;
}

// are q + dq and p + dp finite?  0 x is 0 or NaN
static int gvi__finite_end(const gvi_stepper *st, const gvi__origin *from)
{
    const struct gvi__phase *d = &st->in.step;
    gvi_real none = 0;
    for (int i = 0; i < st->n; ++i) {
        // rounded, as the commit will store them
        const gvi__rounded q = from->q[i] + d->q[i], p = from->p[i] + d->p[i];
        none += 0*q + 0*p;
    }
    return none >= 0;
}

/* One attempt.  If it met NaN or Inf, the same once more, now looking at what every effect
   returns: that names the effect.  If none is to blame, the iteration diverged.               */
static gvi_status gvi__solve(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    struct gvi__private *in = &st->in;
    if (gvi__constrained(st)) in->con.doubt[0] = -1;
    for (int look = 0; ; look = 1) {
        in->diagnose = look;
        gvi_status status;
        do {
            if (GVI__CONSTRAINTS) in->con.again = 0;
            status = gvi__attempt(st, from, h, query);
        } while (GVI__CONSTRAINTS && in->con.again);
        if (gvi__constrained(st) && in->con.doubt[0] >= 0) {
            const int row = (int)in->con.doubt[0];
            status = gvi__report_row(st, GVI_E_CONVERGENCE, row, GVI_FAULT_NONE);
            st->fault.argument = "a jacobian is not the derivative of g, in fault.coordinate's row";
            return status;
        }
        in->diagnose = 0;
        if (status == GVI_OK && !look && !gvi__finite_end(st, from))
            status = gvi__report_status(st, GVI_E_NON_FINITE);
        const int explained = status != GVI_E_NON_FINITE || st->fault.effect != GVI_FAULT_NONE;
        if (look && (status == GVI_OK || !explained))
            return gvi__report_status(st, GVI_E_CONVERGENCE);
        if (look || explained) return status;
        if (!query) in->newton.h = 0;
    }
}

// work becomes last, last becomes older if two steps are kept, and the oldest is the next work
static void gvi__rotate_values(gvi_stepper *st)
{
    struct gvi__values *a = &st->in.older, *b = &st->in.last, *c = &st->in.work;
    gvi_real **const rows[3][3] = { { &a->F, &b->F, &c->F }, { &a->V, &b->V, &c->V },
                                    { &a->A, &b->A, &c->A } };
    GVI__UNROLL for (int k = 0; k < 1 + (GVI__READS_V > 0) + (GVI__LAGRANGIAN > 0); ++k) {
        gvi_real **older = rows[k][0], **last = rows[k][1], **work = rows[k][2];
        gvi_real *spare = *last;
        if (*older) {
            spare = *older;
            *older = *last;
        }
        *last = *work;
        *work = spare;
    }
}

// was := x, x + x_low := x + dx + dx_low; dx_low NULL: 0
static void gvi__move(int n, const gvi_real *GVI__RESTRICT dx, const gvi_real *GVI__RESTRICT dx_low,
                      gvi_real *GVI__RESTRICT x, gvi_real *GVI__RESTRICT x_low,
                      gvi_real *GVI__RESTRICT was)
{
    // gvi__two_sum, twice
    GVI__ALONG(n,
        const gvi__number a = GVI__AT(x), d = GVI__AT(dx), s = a + d, b = s - a;
        const gvi__number da = s - b, e = (a - da) + (d - b);
        GVI__TO(was) = a;
        GVI__TO(x) = s;
        GVI__TO(x_low) = e)
    if (!dx_low) return;
    GVI__ALONG(n,
        const gvi__number s = GVI__AT(x), e = GVI__AT(x_low) + GVI__AT(dx_low), t = s + e;
        const gvi__number f = t - s, ds = t - f;
        GVI__TO(x) = t;
        GVI__TO(x_low) = (s - ds) + (e - f))
}

// 7) the state moves on, and work's stage values become those of the last step
static void gvi__commit(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const gvi__two t = gvi__two_sum(st->t, in->dt + st->t_low);
    const gvi_real *dq_low = in->step.q_low, *dp_low = in->step.p_low;
    if (!gvi__has(in, GVI__ITERATES)) dq_low = dp_low = NULL;   // kicks make no low words
    gvi__move(st->n, in->step.q, dq_low, in->state.q, in->state.q_low, in->began.q);
    gvi__move(st->n, in->step.p, dp_low, in->state.p, in->state.p_low, in->began.p);
    st->t0 = st->t;
    st->t = t.hi;
    st->t_low = t.lo;
    if (GVI__CLOCK) {
        const gvi__two H = gvi__two_sum(in->time.H, in->time.dH + in->time.H_low);
        in->began.H = in->time.H;
        in->time.H = H.hi;
        in->time.H_low = H.lo;
    }
    if (GVI__CONSTRAINTS && in->con.bits) gvi__commit_constraints(st, h);
    in->kept = 1 + (in->kept > 0 && !gvi__nonzero(h - st->h));
    st->h = h;
    gvi__rotate_values(st);
    in->stepped = 1 + gvi__clock_is_on(st);
    in->has_force = !gvi__has(in, GVI__ITERATES) && !gvi__nonzero(in->table.c[0])
                   && !gvi__nonzero(in->table.c[st->r - 1] - 1);
    in->has_velocity = st->formulation == GVI_NEWTON || !gvi__has(in, GVI__BY_FORCES);
    if (st->formulation != GVI_NEWTON) in->watch.ratio = in->watch.found;
    if (in->newton.left > 0) in->newton.left -= 1;
    gvi__count(&st->counters.steps, 1);
}

/* ---- resolution ---- */

/* The error of a step relative to the motion, as Legendre modes y_k of its velocity tell it.  Of a
   coordinate, with two modes each (at degrees 3 and 4 with one),

     high = |y_(s-1)| + |y_(s-2)|                    push = |change of v| + high + low
     low  = |y_(s-3)| + |y_(s-4)|                    all  = |v| at both ends + high + low
     (s high/push high/max(high, low))^2 push/all

   high^2/low is about the pair that the curve lacks.  Of push, the forces' doing, the step lacks
   the square of that share, since with a rule of order u >= 2s its error is of second order in the
   curve's [2, thm. 4.1].  In positions the modes are those of M v, from the forces.  Where
   motion is far below max |v| + max |q|/h, each times sqrt(M_ii), an error below s^2 eps of that
   sum is rounding, and relative to it.                                                        */
static gvi_real gvi__resolution(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int s = st->s, R = in->R, forces = gvi__has(in, GVI__BY_FORCES), pair = 1 + (s > 4),
              held = forces && gvi__constrained(st);
    const gvi_real *row = in->work.V;
    const gvi_real h = GVI_ABS(in->sized.h);
    gvi_real *missed = in->result, *size = missed + st->n, unit = 1;
    gvi_real fastest = 0, farthest = 0, worst = 0;
    if (forces) {
        row = in->work.F;
        unit = h;
    }
    for (int i = 0; i < st->n; ++i, row += R) {
        const gvi_real *a = in->table.high, *force = in->con.force + i*R;
        gvi_real y[4] = { 0, 0, 0, 0 }, start = row[0], end = row[st->r - 1];
        for (int j = 0; j < st->r; ++j, a += 4)
            GVI__UNROLL for (int m = 0; m < 4; ++m) y[m] += a[m]*row[j];
        for (int m = 0; m < held*2*pair; ++m) {
            const int k = s - 1 - m;
            for (int e = 1; e < s; ++e)
                y[m*2/pair] +=
                    in->table.inv_gamma[k]*in->con.Phi[k*R + e - 1]*(in->con.w[e]*force[e]);
        }
        if (forces) {
            start = in->state.p[i];
            end = start + in->step.p[i];
        }
        gvi_real high = unit*(GVI_ABS(y[0]) + GVI_ABS(y[1])),
                 low = unit*(GVI_ABS(y[2]) + GVI_ABS(y[3]));
        const gvi_real all = GVI_ABS(start) + GVI_ABS(end) + high + low,
                       push = GVI_ABS(end - start) + high + low;
        // one mode alone may pass 0; one that is rounding is 0: a force as simple as the curve
        if (pair == 1 && high > GVI__SURE*GVI__EPS*low) high += low*(low/all)/4;
        const gvi_real most = gvi__larger(high, low);
        const gvi_real mass = GVI_SQRT(gvi__inertia(st, i));
        gvi_real share = 0, scale = mass;
        if (most > 0) share = high/(push + GVI__NOISE*GVI__EPS*all)*(high/most);
        if (forces) scale = 1/mass;               // p over M
        missed[i] = share*share*push*scale;
        size[i] = all*scale;
        fastest = gvi__larger(size[i], fastest);
        farthest = gvi__larger(GVI_ABS(in->state.q[i])*mass, farthest);
    }
    const gvi_real whole = fastest + farthest/h;
    if (!(whole > 0)) return 0;
    for (int i = 0; i < st->n; ++i) {
        // forces of constraint bring more of it, to every coordinate, and no h makes it smaller
        if (held && missed[i] <= GVI__PULLED*GVI__EPS*whole) continue;
        if (missed[i] <= GVI__EPS*whole && size[i] < whole/GVI__RESTS) size[i] = whole;
        worst = gvi__larger(missed[i]/size[i], worst);
    }
    return (gvi_real)(s*s)*worst;
}

/* All points of a step at one state, at rows [n][R] for f and, behind them, dldv; of kicks one.  */
GVI__COLD gvi_points gvi__all_points_at(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                        const gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    int R = in->R, count = st->r;
    gvi_real *rows = in->work.F;
    if (gvi__rule_is(in, GVI_KICKS)) R = count = 1;
    if (in->newton.moved) rows = in->newton.moved;
    if (in->free.rows) rows = in->free.rows;
    gvi_points at = gvi__points_at(st, count, R, in->t, in->work.Q, rows, rows + n*R);
    at.v = in->work.V;
    for (int k = 0; k < R; ++k) in->t[k] = t;
    for (int i = 0; i < n*R; ++i) {
        in->work.Q[i] = q[i/R];
        if (in->work.V) in->work.V[i] = v[i/R];
    }
    return at;
}

/* Why did a step fail?  What is singular, NaN or infinite already where it starts is reported as
   that: no h helps.  All else is the step's own, and a shorter one may do.                    */
GVI__COLD gvi_status gvi__explain(gvi_stepper *st, gvi_status status)
{
    struct gvi__private *in = &st->in;
    const gvi_counters counters = st->counters;
    const gvi_fault fault = st->fault;
    gvi_real *v = in->result;
    gvi_status start = GVI_OK;
    gvi__velocity_guess(st, v);
    if (gvi__has(in, GVI__ITERATES) && !in->desc.mass.velocity)
        start = gvi__velocity(st, st->t, st->q, st->p, v);
    if (start == GVI_OK && gvi__constrained(st)) {
        gvi_real *drops = in->con.drops + in->con.m;
        start = gvi__constraints_at(st, st->t, st->q, st->p, v, drops);
        if (start == GVI_OK && status == GVI_E_SINGULAR)
            for (int a = 0; a < in->con.m; ++a)           // left out at the start, and cannot be
                if (drops[a] > 0) return status;
    }
    if (start == GVI_OK) {
        gvi_points at = gvi__all_points_at(st, st->t, st->q, v);
        gvi__zero((size_t)(st->n*at.stride), at.f);
        if (gvi__has(in, GVI__HAS_LAGRANGIAN)) gvi__zero((size_t)(st->n*at.stride), at.dldv);
        else at.dldv = NULL;
        in->diagnose = 1;
        start = gvi__effects(st, &at, 0, NULL);
        in->diagnose = 0;
        if (start == GVI_E_NON_FINITE) {                 // of the state, if it is so at all points
            const int row = st->fault.coordinate*at.stride;
            for (int k = row; k < row + at.count; ++k)
                if (gvi__finite(at.f[k]) && (!at.dldv || gvi__finite(at.dldv[k]))) start = GVI_OK;
            st->fault.point = GVI_FAULT_NONE;
        }
    }
    st->counters = counters;
    if (start == GVI_E_SINGULAR || start == GVI_E_NON_FINITE) return start;
    st->fault = fault;
    if (status == GVI_E_SINGULAR) status = GVI_E_CONVERGENCE;
    return st->status = status;
}

GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h)
{
    const gvi_status ready = gvi__ready(st, st && st->in.started);
    if (ready != GVI_OK) return ready;
    st->in.failed.status = GVI_OK;
    if (!gvi__nonzero(h) || !gvi__finite(h))
        return gvi__refuse_call(st, "h is 0, NaN or infinite");
    struct gvi__private *in = &st->in;
    const gvi_formulation was = st->formulation;
    const int left = in->newton.left;
    const gvi__origin from = {
        st->t, st->t_low, st->q, st->q_low, st->p, st->p_low, in->time.H + in->time.H_low
    };
    if (in->stepped && gvi__nonzero(h - st->h)) in->newton.left = 0;
    gvi_status status = gvi__solve(st, &from, h, GVI__STEP);
    if (status == GVI_OK && !gvi__finite(st->t + in->dt))
        status = gvi__refuse_call(st, "t + h is not finite");
    st->resolution = 0;
    if (status == GVI_E_CONVERGENCE || status == GVI_E_SINGULAR || status == GVI_E_NON_FINITE)
        status = gvi__explain(st, status);
    if (status == GVI_OK && in->desc.resolution > 0) {
        st->resolution = gvi__resolution(st);
        if (st->resolution > in->desc.resolution)
            status = gvi__report_status(st, GVI_E_RESOLUTION);
    }
    if (status != GVI_OK) {
        in->failed.status = status;
        in->failed.fault = st->fault;
        gvi__count(&st->counters.failures, 1);
        st->formulation = was;
        in->newton.left = left;
        in->newton.h = 0;
        return st->status = status;
    }
    if (st->resolution > st->counters.worst_resolution)
        st->counters.worst_resolution = st->resolution;
    gvi__commit(st, h);                                                                      // 7)
    return gvi__report_status(st, GVI_OK);
}

/* ---- the dial ---- */

/* Lengths have a ladder of four rungs an octave, at 4, 5, 6 and 7 eighths of a power of two: where
   x stands on it, linear between these; and the rung below k.                                 */
static gvi_real gvi__rungs(gvi_real x)
{
    int e;
    const gvi_real mantissa = GVI_FREXP(x, &e);
    return (gvi_real)(4*e) + 8*mantissa;
}

static gvi_real gvi__length(gvi_real k)
{
    const gvi_real octave = GVI_FLOOR(k/4) - 1;
    return GVI_LDEXP((GVI_FLOOR(k) - 4*octave)/8, (int)octave);
}

/* st.next after a step of length h.  `room`: how many rungs up the resolution, of order 2s - 1 in
   h, would reach its limit, by this step, less what was lost since the last.  From 0 to 4 rungs
   h stays as it is.                                                                           */
static void gvi__set_next(gvi_stepper *st, gvi_status status, gvi_real h)
{
    const gvi_real seen = st->resolution > GVI__MIN ? st->resolution : GVI__MIN, at = gvi__rungs(h);
    const gvi_real most = gvi__rungs(st->in.desc.resolution) - gvi__rungs(seen);
    // the modes end at rounding: above GVI__DEEP the resolution falls no faster than there
    int degree = GVI__DEEP;
    if (st->s < degree) degree = st->s;
    gvi_real room = most/(gvi_real)(2*degree - 1), up = 0;
    if (status == GVI_OK && room < 2*GVI__BAND) {
        const gvi_real loss = st->in.reach - (at + room);
        st->in.reach = at + room;
        if (loss > 0) room -= loss;
    }
    if (room > GVI__BAND) up = gvi__smaller(room - (gvi_real)1.5, GVI__BAND);
    if (room < 0) up = gvi__larger(room - 1, -GVI__FALL);
    if (status != GVI_OK && status != GVI_E_RESOLUTION) up = -GVI__FALL;
    const gvi_real next = gvi__length(at + up);
    if (up < 0 || (up > 0 && h >= st->next)) st->next = next;
}

/* A first length: 1/16 of the time in which the forces would make the kinetic energy that there is;
   1/1024 of the way where that is less, or from rest.                                         */
GVI__COLD gvi_real gvi__first_length(gvi_stepper *st, gvi_real left)
{
    gvi_real *v = st->in.result, *a = v + st->n;
    gvi_points at = gvi__one_point(st, &st->t, st->q);
    gvi__velocity_guess(st, v);
    gvi_status status = gvi__velocity(st, st->t, st->q, st->p, v);
    at.v = v;
    if (status == GVI_OK) status = gvi__evaluate(st, &at, 0, 1);
    gvi__copy((size_t)st->n, at.f, a + st->n);
    gvi__copy((size_t)st->n, v, a);
    if (status == GVI_OK) status = gvi__velocity(st, st->t, st->q, a + st->n, a);
    const gvi_real moving = GVI_ABS(gvi__dot(st->n, st->p, v)),
                   pushing = GVI_ABS(gvi__dot(st->n, a + st->n, a)),
                   time = GVI_SQRT(moving/pushing)/16, longest = left/1024;
    return status == GVI_OK && time > 0 && time < longest ? time : longest;
}

GVI_DEF gvi_status gvi_advance(gvi_stepper *st, gvi_real t_end)
{
    const gvi_status ready = gvi__ready(st, st && st->in.started);
    if (ready != GVI_OK) return ready;
    if (!(st->in.desc.resolution > 0))
        return gvi__refuse_call(st, "gvi_advance needs desc.resolution");
    if (!gvi__finite(t_end) || !gvi__nonzero(t_end - st->t))
        return gvi__refuse_call(st, "t_end is t, NaN or infinite");
    const gvi_real way = (t_end - st->t) - st->t_low, left = GVI_ABS(way);
    const int clock = gvi__clock_is_on(st);
    if (!(st->next > 0) || !gvi__finite(st->next)) st->next = gvi__first_length(st, left);
    for (int tries = 1; ; ++tries) {
        gvi_real h = st->next;
        if (!clock && left < h*2) h = left/2;
        if (!clock && left < st->next*(gvi_real)1.0625) h = left;
        const gvi_status status = gvi_step(st, way > 0 ? h : -h);
        gvi__set_next(st, status, h);
        if (status == GVI_OK) {
            if (!clock && h >= left) {
                st->t_low += st->t - t_end;
                st->t = t_end;
            }
            return status;
        }
        if (status == GVI_E_ARGUMENT || tries == 64 || !gvi__nonzero(st->t + st->next - st->t))
            return status;
    }
}

/* ----------------------------------------------------------------- STATE */

/* ---- starting ---- */

/* The energy for a clock, under which values may not change with t: they are looked at twice.  */
GVI__COLD gvi_status gvi__clock_energy(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                       const gvi_real *p, gvi_real *v, gvi_real *E)
{
    const gvi_real later = t + (gvi_real)0.739085133215160642;
    const gvi_status status = gvi__hamiltonian(st, t, q, p, v, E);
    if (status != GVI_OK) return status;
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        const gvi_kind kind = st->in.desc.effects[e].kind;
        gvi_real now = 0, then = 0;
        gvi_points at = gvi__one_point(st, &t, q);
        at.v = v;
        if ((st->in.off >> e & 1u) || kind == GVI_FORCE || kind == GVI_CLOCK) continue;
        (void)gvi__value(st, &at, e, &now);        // as it has just been
        at.t = &later;
        if (gvi__value(st, &at, e, &then) == GVI_OK && gvi__nonzero(then - now))
            return gvi__report_effect(st, GVI_E_FORMULATION, e);
    }
    return gvi__report_status(st, GVI_OK);
}

/* At a first start, finds callbacks that fill only their first point, or set f and dldv with =
   instead of adding to them.  All points are a little past q, where a force 0 at the start is not.
   From 0 an effect shows which points it fills; from the largest number, whether it adds.     */
GVI__COLD gvi_status gvi__probe(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const gvi_counters counters = st->counters;          // a probe is no step's work
    gvi_points at = gvi__all_points_at(st, t, q, v);
    const int n = st->n, R = at.stride, count = at.count;
    gvi_real *rows = at.f;
    for (int i = 0; i < n*R; ++i)
        if (i % R < count) in->work.Q[i] += GVI_SQRT(GVI__EPS)*v[i/R];
    // effects may use what M(q) has computed: it comes first, as in a step
    if (gvi__mass_is(in, GVI_MASS_POSITION)) gvi__evaluate_mass(st, &at, NULL, NULL);
    const char *slip = NULL;
    for (int e = 0; e < in->desc.effect_count; ++e) {
        int all = n*R, first = 0, others = 0, huge = 0, set = 0;
        if ((in->off | in->apart) >> e & 1u) continue;
        if (in->desc.effects[e].kind == GVI_LAGRANGIAN) all = 2*n*R;
        gvi__zero((size_t)all, rows);
        if (gvi__effect(st, &at, e, NULL) != GVI_OK) continue;
        for (int i = 0; i < all; ++i) {
            const int k = i % R, filled = k < count && gvi__nonzero(rows[i]);
            first |= filled && k == 0;
            others |= filled && k > 0;
            huge |= filled && GVI_ABS(rows[i]) > GVI__MAX/4;
        }
        if (first && !others && count > 1)
            slip = "effect: fills its first point alone, not x->count of them";
        for (int i = 0; i < all; ++i) rows[i] = GVI__MAX;
        if (gvi__effect(st, &at, e, NULL) != GVI_OK) continue;
        for (int i = 0; i < all; ++i) set |= i % R < count && GVI_ABS(rows[i]) < GVI__MAX/2;
        if (set && !huge) slip = "effect: sets f or dldv with =, where it has to add with +=";
        if (!slip) continue;
        st->counters = counters;
        return st->status = gvi__refuse(&st->fault, e, GVI_FAULT_NONE, slip);
    }
    st->counters = counters;
    return gvi__report_status(st, GVI_OK);
}

// from q, p in in->step and a velocity v, all of them seen to be good
GVI__COLD gvi_status gvi__begin_at(gvi_stepper *st, gvi_real t, const gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n;
    if (!in->started && gvi__probe(st, t, in->step.q, v) != GVI_OK)
        return st->status;
    if (gvi__constrained(st)) {
        gvi__forget_columns(st);
        const gvi_status status = gvi__project_start(st, t, in->step.q, in->step.p);
        if (status != GVI_OK) return status;
        v = in->result + 2*n;
    }
    if (gvi__clock_is_on(st)) {                   // its energy
        gvi_real E, *V = in->result;
        gvi__copy(n, v, V);
        const gvi_status status = gvi__clock_energy(st, t, in->step.q, in->step.p, V, &E);
        if (status != GVI_OK) return status;
        in->time.H = E;
        in->time.H_low = 0;
    }
    gvi__copy(n, v, in->start);
    gvi__copy(n, in->step.q, in->state.q);
    gvi__copy(n, in->step.p, in->state.p);
    gvi__zero(n, in->state.q_low);
    gvi__zero(n, in->state.p_low);
    st->t = st->t0 = t;
    st->h = st->t_low = st->resolution = st->next = 0;
    in->reach = -GVI__MAX;
    in->started = 1;
    in->stepped = in->kept = in->con.kept = in->has_force = in->has_velocity = in->newton.left = 0;
    in->newton.h = in->sized.ratio = 0;
    in->watch.ratio = in->watch.found = 1;
    st->formulation = in->chosen;
    return gvi__report_status(st, GVI_OK);
}

// is everything there that a start needs, and finite?
GVI__COLD gvi_status gvi__check_start(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *w)
{
    const gvi_status ready = gvi__ready(st, st && st->in.memory);
    if (ready != GVI_OK) return ready;
    st->in.failed.status = GVI_OK;
    if (!q || !w) return gvi__refuse_call(st, "q, v or p is NULL");
    if (!gvi__finite(t)) return gvi__refuse_call(st, "t is not finite");
    const int j = gvi__first_non_finite(st->n, w);
    int i = gvi__first_non_finite(st->n, q);
    if (i < 0 && j < 0) return GVI_OK;
    if (i < 0 || (j >= 0 && j < i)) i = j;
    return st->status = gvi__refuse(&st->fault, GVI_FAULT_NONE, i, "q, v or p is not finite");
}

// p = dL/dv, of the kinetic energy and of Lagrangian terms where there are any, to in->point + 5n
static gvi_status gvi__momentum(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_points at = gvi__one_point(st, &t, q);
    unsigned skip = ~0u;
    if (gvi__has(&st->in, GVI__HAS_LAGRANGIAN)) skip = 0;
    at.v = v;
    return gvi__evaluate(st, &at, skip, 1);
}

GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_status status = gvi__check_start(st, t, q, v);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n;

    in->diagnose = 1;
    status = gvi__momentum(st, t, q, v);
    in->diagnose = 0;
    if (status != GVI_OK) return status;
    gvi_real *start = in->result + n;              // v may be st->q or st->p, which change first
    gvi__copy(n, v, start);
    gvi__copy(n, in->point + 5*n, in->step.p);
    gvi__copy(n, q, in->step.q);
    return gvi__begin_at(st, t, start);
}

GVI_DEF gvi_status gvi_start_momentum(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p)
{
    gvi_status status = gvi__check_start(st, t, q, p);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n;
    gvi_real *v = in->result;
    gvi__copy(n, p, in->step.p);                   // p may be in->step.q
    gvi__copy(n, q, in->step.q);
    // a velocity to start the first iteration from; where there is none, the step says so
    gvi__zero(n, v);
    status = gvi__velocity(st, t, in->step.q, in->step.p, v);
    if (status == GVI_E_SINGULAR || status == GVI_E_CONVERGENCE) gvi__zero(n, v);
    else if (status != GVI_OK) return status;
    return gvi__begin_at(st, t, v);
}

GVI_DEF gvi_status gvi_start_configurations(gvi_stepper *st, gvi_real t, gvi_real h,
                                            const gvi_real *q0, const gvi_real *q1)
{
    static const gvi_discrete out = { NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL };
    gvi_status status = gvi__check_start(st, t, q0, q1);
    // p0 is in step.q then
    if (status == GVI_OK) status = gvi_discrete_lagrangian(st, t, h, q0, q1, &out);
    if (status != GVI_OK) return status;
    return gvi_start_momentum(st, t, q0, st->in.step.q);
}

/* The iteration q' = q + e, e = M^-1 G'z with g + G(e_new - e) = 0: (G M^-1 G') z = G e - g at the
   last q'.  So e is normal to the constraints where it ends, and e'M e is z'(G e - g).  What moves
   along the constraints is damped, by `share`, where changes grow; g is taken to 0 in any case. */
GVI_DEF gvi_status gvi_project(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v,
                               gvi_real *moved)
{
    gvi_status status = gvi__check_start(st, t, q, v);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *e = in->step.q, *f = in->step.p, *next = in->result, *d = next + n, *u = d + n,
             *push = in->point, *z = in->con.rho, *r = z + m, *back = r + m,
             *drops = in->con.drops + m, far[2] = { 0, 0 }, change = GVI__MAX, before, share = 1;
    if (!moved) moved = far;
    moved[0] = moved[1] = 0;
    if (!gvi__constrained(st)) return gvi__report_status(st, GVI_OK);
    gvi__zero((size_t)n, e);
    gvi__zero((size_t)n, f);
    gvi__copy((size_t)n, q, next);
    gvi__copy((size_t)n, v, u);
    gvi__forget_columns(st);
    in->diagnose = 1;
    for (int k = 0; ; ++k) {
        status = gvi__constraints_at(st, t, next, NULL, u, drops);
        if (k > 1 && !(change < before*(gvi_real)0.9) && status == GVI_OK) {
            if (gvi__fulfilled(st, t, next, NULL, u) == GVI_OK) break;
            status = k > 100 ? GVI_E_CONVERGENCE
                             : gvi__constraints_at(st, t, next, NULL, u, drops);
        }
        if (status != GVI_OK) break;
        for (int a = 0; a < m; ++a) {
            back[a] = -in->con.g[a];
            z[a] = r[a] = gvi__row_dot(st, in->con.G1, a, e) - in->con.g[a];
        }
        gvi__solve_constraints(st, in->con.A1, 1, 1, z, 1);
        gvi__solve_constraints(st, in->con.A1, 1, 1, back, 1);
        far[0] = gvi__dot(m, r, z);
        for (int a = 0; a < m; ++a) z[a] = share*z[a] + (1 - share)*back[a];
        gvi__zero((size_t)n, push);
        gvi__add_force(st, z, push);
        gvi__copy((size_t)n, push, d);
        gvi__over_inertia(st, d, 1, 1);
        before = change;
        change = 0;
        for (int i = 0; i < n; ++i) {
            change += (push[i] - share*f[i])*(d[i] - share*e[i]);
            f[i] = push[i] + (1 - share)*f[i];
            e[i] = d[i] + (1 - share)*e[i];
            next[i] = q[i] + e[i];
        }
        change = GVI_SQRT(GVI_ABS(change));
        if (change > before && share > (gvi_real)0.02) share /= 2;
    }
    in->diagnose = 0;
    const int passes = 2*(status == GVI_OK);
    for (int pass = 0; pass < passes; ++pass) {
        for (int a = 0; a < m; ++a)
            z[a] = r[a] = -(in->con.g[m + a] + gvi__row_dot(st, in->con.G1, a, u));
        gvi__solve_constraints(st, in->con.A1, 1, 1, z, 1);
        gvi__zero((size_t)n, d);
        gvi__add_force(st, z, d);
        gvi__over_inertia(st, d, 1, 1);
        gvi__add_scaled(n, 1, d, u, u);
        if (pass == 0) far[1] = gvi__dot(m, r, z);
    }
    gvi__forget_columns(st);
    if (status != GVI_OK) return st->status = status;
    gvi__copy((size_t)n, next, q);
    gvi__copy((size_t)n, u, v);
    for (int k = 0; k < 2; ++k) moved[k] = GVI_SQRT(GVI_ABS(far[k]));
    return gvi__report_status(st, GVI_OK);
}

GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on)
{
    const gvi_status ready = gvi__ready(st, st && st->in.memory);
    if (ready != GVI_OK) return ready;
    struct gvi__private *in = &st->in;
    if (index < 0 || index >= in->desc.effect_count)
        return gvi__refuse_call(st, "there is no such effect");
    const unsigned bit = 1u << index, was = in->off;
    in->off = was | bit;
    if (on) in->off = was & ~bit;
    // another energy, also at the start
    if (gvi__clock_is_on(st) && in->started && in->off != was) {
        gvi_real E, E0 = in->began.H, *v = in->result + st->n;
        gvi__velocity_guess(st, v);
        gvi_status status = gvi__clock_energy(st, st->t, st->q, st->p, v, &E);
        if (status == GVI_OK && in->stepped)
            status = gvi__hamiltonian(st, st->t0, in->began.q, in->began.p, v, &E0);
        if (status != GVI_OK) {
            in->off = was;
            return gvi__done(st, status);
        }
        in->time.H = E;
        in->time.H_low = 0;
        in->began.H = E0;
    }
    if (GVI__CONSTRAINTS && (in->con.bits >> index & 1u)) {
        gvi_status status = GVI_OK;
        in->con.m = gvi__count_rows(in, gvi__constraints_on(st));
        gvi__forget_columns(st);
        if (in->started && (was & ~in->off)) status = gvi__project_start(st, st->t, st->q, st->p);
        if (status != GVI_OK) {
            in->off = was;
            in->con.m = gvi__count_rows(in, gvi__constraints_on(st));
            gvi__forget_columns(st);
            return gvi__done(st, status);
        }
        in->con.kept = in->con.kept > 0;
        in->sized.ratio = 0;
    }
    in->has_force = 0;
    in->newton.h = 0;
    in->watch.ratio = 1;                           // another scene may contract otherwise
    return gvi__done(st, GVI_OK);
}

// pointers into the memory are those of st: the layout again, values rotated as they were saved
GVI_DEF gvi_status gvi_restore(gvi_stepper *st, const gvi_stepper *saved, const gvi_real *memory)
{
    const gvi_status ready = gvi__ready(st, st && st->in.memory);
    if (ready != GVI_OK) return ready;
    struct gvi__private *in = &st->in;
    if (!saved || !memory || !saved->in.memory || saved->n != st->n || saved->s != st->s
        || saved->r != st->r || saved->in.size != in->size || saved->in.facts != in->facts
        || saved->in.clock != in->clock || saved->in.con.bits != in->con.bits
        || saved->in.desc.effect_count != in->desc.effect_count
        || saved->in.desc.mass.kind != in->desc.mass.kind)
        return gvi__refuse_call(st, "saved or memory is NULL, not set up, or of another scene");
    const gvi_desc desc = in->desc;
    gvi_real *const own = in->memory;
    gvi__kernel *const kernel = in->kernel;
    const size_t skip = in->skip;
    const uintptr_t base = (uintptr_t)saved->in.memory;
    const uintptr_t F = (uintptr_t)saved->in.work.F - base, V = (uintptr_t)saved->in.work.V - base;
    gvi__copy(in->size, memory + saved->in.skip, own);
    *st = *saved;
    in->desc = desc;
    in->memory = own;
    in->kernel = kernel;
    in->skip = skip;
    in->failed.status = GVI_OK;
    gvi__hand_out(st, own);
    for (int k = 0; k < 6; ++k) {                 // each goes round in 2 or 3
        const int F_fits = (uintptr_t)in->work.F - (uintptr_t)own == F,
                  V_fits = !in->work.V || (uintptr_t)in->work.V - (uintptr_t)own == V;
        if (F_fits && V_fits) break;
        gvi__rotate_values(st);
    }
    return gvi__report_status(st, GVI_OK);
}

/* --------------------------------------------------------------- QUERIES */

GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v)
{
    gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (!v) return gvi__refuse_call(st, "v is NULL");
    gvi_real *V = st->in.result;
    gvi__velocity_guess(st, V);
    status = gvi__velocity(st, st->t, st->q, st->p, V);
    if (status == GVI_OK) gvi__copy((size_t)st->n, V, v);
    return gvi__done(st, status);
}

GVI_DEF gvi_status gvi_energy(gvi_stepper *st, gvi_real *energy)
{
    gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (!energy) return gvi__refuse_call(st, "energy is NULL");
    gvi_real E, *v = st->in.result + st->n;
    gvi__velocity_guess(st, v);
    status = gvi__hamiltonian(st, st->t, st->q, st->p, v, &E);
    if (status == GVI_OK) *energy = E;
    return gvi__done(st, status);
}

// the last step's curve and velocity, by the formulas of its points with the table row of tau
static void gvi__curve_at(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    const int by_forces = gvi__has(in, GVI__BY_FORCES) && st->formulation != GVI_NEWTON;
    if (!gvi__has(in, GVI__ITERATES)) {               // a straight line
        for (int i = 0; i < n; ++i) {
            const gvi_real path = (in->state.q[i] - in->began.q[i]) + in->state.q_low[i];
            if (tau < (gvi_real)0.5) q[i] = in->began.q[i] + tau*path;
            else q[i] = in->state.q[i] - (1 - tau)*path;
            v[i] = path/st->h;
        }
        return;
    }
    gvi_real *a = in->row, *b = a + R;               // at tau: phi, Phi over Gamma
    gvi__modes(st, tau, a, b);
    gvi__zero((size_t)n, q);
    gvi__zero((size_t)n, v);
    const gvi_real *modes = in->table.phi, *weight = in->table.b, *rows = in->last.V;
    int held = 0;                                   // sources of constraints, behind the points
    if (by_forces) {
        modes = in->table.Phi;
        weight = in->sized.hb;
        rows = in->last.F;
        if (GVI__CONSTRAINTS && in->con.kept) held = st->s;
    }
    for (int j = 0; j < st->r + held; ++j) {
        const gvi_real *Phi = modes + j, *source = rows + j;
        gvi_real S = 0, T = 0, w = 0;
        int stride = R;
        if (j < st->r) w = weight[j];
        else {
            const int e = j - st->r;
            Phi = in->con.Phi + e - 1;
            source = in->con.last + e;
            stride = in->con.C;
            w = st->h*in->con.w[e];
        }
        if (j != st->r)                             // Phi(d_0) = 0
            for (int k = 0; k < st->s; ++k) {
                S += b[k]*Phi[k*R];
                T += a[k]*Phi[k*R];
            }
        if (by_forces) {
            S = tau - S;
            T = 1 - T;
        }
        for (int i = 0; i < n; ++i) {
            const gvi_real L = w*source[i*stride];
            q[i] += S*L;
            v[i] += T*L;
        }
    }
    if (by_forces) {
        gvi_real *v0 = in->free.v;
        gvi__over_mass(st, q, 1, 1);
        gvi__over_mass(st, v, 1, 1);
        gvi__copy((size_t)n, in->began.p, v0);
        gvi__over_mass(st, v0, 1, 1);
        for (int i = 0; i < n; ++i) {
            q[i] += tau*v0[i];
            v[i] += v0[i];
        }
    }
    for (int i = 0; i < n; ++i) q[i] = in->began.q[i] + st->h*q[i];
}

// what was requested
static void gvi__hand_over(int n, const gvi_real *from, gvi_real *to)
{
    if (to) gvi__copy((size_t)n, from, to);
}

// is there a last step to look into?
static gvi_status gvi__stepped(gvi_stepper *st)
{
    const gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (!st->in.stepped) return gvi__done(st, GVI_E_STATE);
    return GVI_OK;
}

GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    gvi_status status = gvi__stepped(st);
    if (status != GVI_OK) return status;
    if (!(tau >= 0 && tau <= 1)) return gvi__refuse_call(st, "tau is not in [0,1]");
    if (gvi__rule_is(&st->in, GVI_KICKS)) return gvi__done(st, GVI_E_FORMULATION);
    gvi_real *Q = st->in.result, *V = Q + st->n, rate;
    gvi__weights_for(st, st->h);
    gvi__curve_at(st, tau, Q, V);
    if (GVI__CLOCK && st->in.stepped == 2) {       // v = q'/g
        st->in.diagnose = 1;
        status = gvi__clock_at(st, st->t, Q, &rate, V + st->n);
        st->in.diagnose = 0;
        if (status != GVI_OK) return gvi__done(st, status);
        for (int i = 0; i < st->n; ++i) V[i] /= rate;
    }
    gvi__hand_over(st->n, Q, q);
    gvi__hand_over(st->n, V, v);
    return gvi__done(st, GVI_OK);
}

/* Increments of a partial step for a time dt from one end of the last step.  With a clock its h is
   found by Newton's method, the derivative being g, kept inside the step by bisection.       */
static gvi_status gvi__partial_step(gvi_stepper *st, const gvi__origin *from, int query,
                                    gvi_real dt)
{
    if (!gvi__clock_is_on(st)) return gvi__solve(st, from, dt, query);
    struct gvi__private *in = &st->in;
    gvi_real h = st->h*(dt/(st->t - st->t0)), rate, *q = in->result;
    gvi_real near_end = 0, far_end = st->h;
    if (query == GVI__FROM_END) far_end = -st->h;
    for (int k = 0; k < 60; ++k) {
        gvi_status status = gvi__solve(st, from, h, query);
        if (status != GVI_OK || GVI_ABS(in->dt - dt) <= 2*GVI__EPS*GVI_ABS(dt)) return status;
        if (GVI_ABS(in->dt) > GVI_ABS(dt)) far_end = h;
        else near_end = h;
        for (int i = 0; i < st->n; ++i) q[i] = from->q[i] + in->step.q[i];
        status = gvi__clock_at(st, from->t, q, &rate, q + st->n);
        if (status != GVI_OK) return status;
        gvi_real next = h - (in->dt - dt)/rate;
        if (!((next - near_end)*(far_end - next) > 0)) next = near_end + (far_end - near_end)/2;
        if (!gvi__nonzero(next) || GVI_ABS(next - h) <= GVI__EPS*GVI_ABS(st->h)) return GVI_OK;
        h = next;
    }
    return gvi__report_status(st, GVI_E_CONVERGENCE);
}

GVI_DEF gvi_status gvi_state_at(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p)
{
    gvi_status status = gvi__stepped(st);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n;
    if (!gvi__finite(t)) return gvi__refuse_call(st, "t is not finite");
    gvi_real ahead = t - st->t0, back = t - st->t;        // one of each sign, or 0
    const gvi_real edge = 2*GVI__EPS*gvi__larger(GVI_ABS(st->t), GVI_ABS(st->t0));
    if ((ahead > 0) == (back > 0) && gvi__nonzero(ahead) && gvi__nonzero(back)) {
        // outside by rounding, as st.t - st.h may be
        if (GVI_ABS(ahead) <= edge) t = st->t0;
        else if (GVI_ABS(back) <= edge) t = st->t;
        else return gvi__done(st, GVI_E_STATE);
        ahead = t - st->t0;
        back = t - st->t;
    }
    if (gvi__clock_is_on(st) && in->stepped != 2) return gvi__done(st, GVI_E_STATE);

    // partial step of length h from the nearer end, or none for a rounding of the whole
    const gvi__origin end = { st->t, st->t_low, st->q, st->q_low, st->p, st->p_low,
                              in->time.H + in->time.H_low };
    gvi__origin from = { st->t0, 0, in->began.q, in->zeros, in->began.p, in->zeros, in->began.H };
    gvi_real h = ahead;
    int query = GVI__FROM_START;
    if (GVI_ABS(back) <= GVI_ABS(ahead)) {
        from = end;
        query = GVI__FROM_END;
        h = 0;
        if (gvi__nonzero(back)) h = back - st->t_low;
    }
    const gvi_formulation was = st->formulation;
    if (GVI_ABS(h) > GVI__EPS*(GVI_ABS(ahead) + GVI_ABS(back)))
        status = gvi__partial_step(st, &from, query, h);
    else {
        gvi__copy(n, from.q_low, in->step.q);
        gvi__copy(n, from.p_low, in->step.p);
        gvi__zero(n, in->step.q_low);
        gvi__zero(n, in->step.p_low);
    }
    st->formulation = was;
    if (status != GVI_OK) return gvi__done(st, status);
    gvi_real *Q = in->result, *P = Q + n, *V = P + n;
    for (size_t i = 0; i < n; ++i) {
        Q[i] = from.q[i] + (in->step.q[i] + in->step.q_low[i]);
        P[i] = from.p[i] + (in->step.p[i] + in->step.p_low[i]);
    }
    gvi__velocity_guess(st, V);
    if (v) status = gvi__velocity(st, t, Q, P, V);
    if (status != GVI_OK) return gvi__done(st, status);
    gvi__hand_over(st->n, Q, q);
    gvi__hand_over(st->n, V, v);
    gvi__hand_over(st->n, P, p);
    return gvi__done(st, GVI_OK);
}

// the action along the last step's curve, `from` NULL; or between boundary values, at stage values
GVI__COLD gvi_status gvi__curve_action(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                    const gvi_real *q1, gvi_real *action)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    gvi_real V, L, T, *q = in->result, *v = q + n;
    *action = 0;
    for (int j = 0; j < st->r; ++j) {
        gvi_real t = st->t0 + in->table.c[j]*st->h;
        if (from) {
            t = in->t[j];
            for (int i = 0; i < n; ++i) {
                q[i] = in->work.Q[i*R + j];
                if (in->work.V) v[i] = in->work.V[i*R + j];
                else v[i] = (q1[i] - from->q[i])/h;           // a chord
            }
        } else gvi__curve_at(st, in->table.c[j], q, v);
        const gvi_status status = gvi__value_sums(st, t, q, v, &V, &L, &T);
        if (status != GVI_OK) return status;
        *action += in->sized.hb[j]*(T - V + L);
    }
    return GVI_OK;
}

GVI_DEF gvi_status gvi_action(gvi_stepper *st, gvi_real *action)
{
    gvi_status status = gvi__stepped(st);
    if (status != GVI_OK) return status;
    if (!action) return gvi__refuse_call(st, "action is NULL");
    if (gvi__rule_is(&st->in, GVI_KICKS) || st->in.stepped == 2)
        return gvi__done(st, GVI_E_FORMULATION);
    gvi_real sum;
    gvi__weights_for(st, st->h);
    status = gvi__curve_action(st, NULL, 0, NULL, &sum);
    if (status == GVI_OK) *action = sum;
    return gvi__done(st, status);
}

/* ------------------------------------------------------- BOUNDARY VALUES */

/* The curve between the boundary values by degree 1: a chord, point by point, nothing to solve.
   F at its points goes to work.F, and the sum of b_i P_i to p.                                */
GVI__COLD gvi_status gvi__chord(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                const gvi_real *q1, gvi_real *p)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    gvi_real *q = in->result, *v = q + n;
    gvi__zero((size_t)n, p);
    for (int j = 0; j < R; ++j) {
        for (int i = 0; i < n; ++i) {
            v[i] = (q1[i] - from->q[i])/h;
            q[i] = in->work.Q[i*R + j] = from->q[i] + in->table.c[j]*(q1[i] - from->q[i]);
            if (in->work.V) in->work.V[i*R + j] = v[i];
        }
        if (j >= st->r) continue;
        gvi_points at = gvi__one_point(st, in->t + j, q);
        at.v = v;
        in->diagnose = 1;
        const gvi_status status = gvi__evaluate(st, &at, 0, 1);
        in->diagnose = 0;
        if (status != GVI_OK) return status;
        for (int i = 0; i < n; ++i) {
            in->work.F[i*R + j] = at.f[i];
            p[i] += in->table.b[j]*at.dldv[i];
        }
    }
    return GVI_OK;
}

/* Newton's method for a curve of length h from that of length h/grow at hand: the same polynomial
   followed on; between ends, modes k >= 1 that grow like it.  Two corrections by one matrix first:
   where a curve is near, the second is no more than a quarter of the first, and all but the `last`
   piece need no more.  `bent`: the largest of these ratios so far.
   `bow`: first mode 1 becomes as large as half the chord in all coordinates, by sqrt M_ii.  What is
   linear does not mind; what is not shows it, also where forces cancel on the chord.         */
GVI__COLD gvi_status gvi__bend(gvi_stepper *st, const gvi__origin *from, gvi_real h, gvi_real grow,
                               const gvi__matrix *J, int last, int bow, gvi_real *bent)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, size = (st->s - J->k0)*n;
    gvi__descent p = { 0, 0, GVI__MAX, 0, GVI__MAX, 0, GVI__MAX, 0, 0, 0, 0, 0, 0, 0 };
    gvi_real *y = in->newton.y, before = 0, length = 0;
    if (grow > 1 && J->k0 == 0) {
        in->sized.ratio = 0;
        in->sized.steps = 1;
        gvi__fit(st, st->r, in->table.c, in->table.c, 0, grow, 1, in->sized.E);
        gvi__newton_modes(st, in->work.V, in->work.P);
    }
    if (J->k0)
        for (int k = n; k < st->s*n; ++k) y[k] *= grow;
    gvi__weights_for(st, h);
    gvi__times(in->R, from->t, 0, h, in->table.c, in->t);
    for (int k = -bow; k < 2; ++k) {
        gvi_status status = gvi__newton_values(st, from);
        if (status != GVI_OK) return status;
        gvi__residual(st, from, J->k0, &p);
        if (k < 0) {
            for (int i = 0; i < n; ++i) length += GVI_ABS(y[i])/in->watch.scale[i];
            for (int i = 0; i < n; ++i) y[n + i] = length*in->watch.scale[i]/2;
            continue;
        }
        if (k == 0) status = gvi__jacobian(st, J);
        if (status != GVI_OK) return status;
        gvi_lu_solve(size, J->square, J->pivot, in->newton.dy);
        const gvi_real change = gvi__newton_update(st, from, J, &p);
        if (!gvi__finite(change)) return gvi__report_status(st, GVI_E_NON_FINITE);
        if (k == 1 && change > *bent*before && change > GVI__GRAIN*GVI__EPS*(gvi_real)size)
            *bent = change/before;
        before = change;
    }
    if (*bent > GVI__CONTRACTS) return gvi__report_status(st, GVI_E_CONVERGENCE);
    if (!last) return GVI_OK;
    return gvi__newton_solve(st, from, J);
}

/* The motion from q0 with velocity v, in pieces of length h, followed until it leaves q1, by M_ii,
   between the first `pieces`/2 and three times as many.  Returns for how long.               */
GVI__COLD gvi_real gvi__aim(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                            const gvi_real *q1, const gvi_real *v, const gvi__matrix *J,
                            int pieces, gvi_real *bent, gvi_status *status)
{
    struct gvi__private *in = &st->in;
    gvi_real last = GVI__MAX, at = 0, grow = 1;
    gvi__copy((size_t)st->n, v, in->newton.y);
    for (int k = 1; k <= pieces*3/2; ++k) {
        gvi_real miss = 0;
        at = h*(gvi_real)k;
        *status = gvi__bend(st, from, at, grow, J, 0, 0, bent);
        grow = (gvi_real)(k + 1)/(gvi_real)k;
        for (int i = 0; i < st->n; ++i) {
            const gvi_real d = (from->q[i] + at*in->newton.y[i] - q1[i])/in->watch.scale[i];
            miss += d*d;
        }
        if (*status != GVI_OK || (k > pieces/2 && miss > last)) break;
        last = miss;
    }
    return at;
}

/* A curve of degree 2 or more, followed from where it is known, in as many pieces as it takes: from
   h = 0, where it is the chord, run through in no time; or, with a guess v, from the motion that v
   starts, where between h/2 and 3h/2 it begins to leave q1.  Linear equations need none of that:
   the bowed chord will do.  Returns whether they are all but linear.  `any`: any curve will do. */
GVI__COLD int gvi__follow(gvi_stepper *st, const gvi__origin *from, gvi_real h, const gvi_real *q1,
                          const gvi_real *v, int any, const gvi__matrix *J, gvi_status *status)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    const gvi__matrix motion = { J->square, J->pivot, NULL, 0, 0, 0, NULL };
    gvi_real *y = in->newton.y, *end = in->step.q_low;
    gvi_status bowed = GVI_E_NON_FINITE;
    int first = 0, left = 2 + in->desc.max_iterations*2/3;         // pieces, in all
    if (v) {
        first = 4;
        left = 1000;
    } else if (any) {
        // whoever wants the index judges for himself: straight from the chord, then with halving
        for (int halves = 0; halves < 2; ++halves) {
            const gvi__matrix plain = { J->square, J->pivot, J->ends, 1, 0, halves, NULL };
            gvi__zero((size_t)(st->s*n), y);
            for (int i = 0; i < n; ++i) y[i] = (q1[i] - from->q[i])/h;
            *status = gvi__newton_solve(st, from, &plain);
            if (*status == GVI_OK) break;
        }
        return 0;
    }
    for (int attempt = first; attempt < 9; ++attempt) {
        const int pieces = 1 << attempt >> (attempt > 0), linear = attempt == 0;
        gvi_real bent = 0, at = 0;
        *status = GVI_OK;
        gvi__zero((size_t)(st->s*n), y);
        if (v)
            at = gvi__aim(st, from, h/(gvi_real)pieces, q1, v, &motion, pieces, &bent, status);
        gvi__copy((size_t)n, y, end);
        for (int k = 1; k <= pieces; ++k) {
            const gvi_real part = (gvi_real)k/(gvi_real)pieces, length = at + part*(h - at),
                           last = length - (h - at)/(gvi_real)pieces;
            gvi_real grow = 1;
            if (*status != GVI_OK) break;
            for (int i = 0; i < n; ++i) {
                gvi_real way = q1[i] - from->q[i];
                if (v && k < pieces) way = part*way + (1 - part)*at*end[i];
                y[i] = way/length;
            }
            if (left-- == 0) *status = gvi__report_status(st, GVI_E_CONVERGENCE);
            if (v) grow = last/length;
            else if (k > 1) grow = length/last;
            if (*status == GVI_OK)
                *status = gvi__bend(st, from, length, grow, J, k == pieces, linear, &bent);
        }
        if (*status == GVI_OK && (!linear || bent < GVI__LINEAR)) return linear;
        if (linear) bowed = *status;
        if ((*status == GVI_E_NON_FINITE && in->diagnose) || left <= 0) break;
    }
    // there is nothing wrong with the effects, but with the chord
    if (*status == GVI_E_NON_FINITE && bowed != GVI_E_NON_FINITE) *status = GVI_E_CONJUGATE;
    return 0;
}

/* Negative eigenvalues of a symmetric matrix, which is overwritten; v: 2n numbers.  Householder's
   reflections make it tridiagonal; by Sylvester's law there are as many as negative pivots then. */
GVI__COLD int gvi__count_negative(int n, gvi_real *a, gvi_real *v)
{
    int count = 0;
    gvi_real pivot = 1, off = 0, *z = v + n;
    for (int k = 0; k < n; ++k) {
        gvi_real *row = a + (size_t)k*(size_t)n + k + 1, big = 0;       // right of the diagonal
        const int m = n - 1 - k;
        pivot = row[-1] - off/pivot*off;
        count += pivot < 0;
        if (!gvi__nonzero(pivot)) pivot = GVI__MIN;
        for (int i = 0; i < m; ++i) big = gvi__larger(GVI_ABS(row[i]), big);
        off = 0;
        if (!(big > 0)) continue;
        for (int i = 0; i < m; ++i) v[i] = row[i]/big;

        // I - v v'/half takes that to (norm, 0, ...); then B -= v z' + z v', B the rest
        gvi_real norm = GVI_SQRT(gvi__dot(m, v, v));
        if (v[0] > 0) norm = -norm;
        v[0] -= norm;
        off = norm*big;
        const gvi_real half = -norm*v[0];
        for (int i = 0; i < m; ++i) z[i] = gvi__dot(m, row + (size_t)(i + 1)*(size_t)n, v)/half;
        const gvi_real share = gvi__dot(m, v, z)/(2*half);
        for (int i = 0; i < m; ++i) z[i] -= share*v[i];
        for (int i = 0; i < m; ++i) {
            gvi_real *rest = row + (size_t)(i + 1)*(size_t)n;
            gvi__subtract_row((size_t)m, v[i], z, rest);
            gvi__subtract_row((size_t)m, z[i], v, rest);
        }
    }
    return count;
}

/* The Morse index: the second variation is h J without the factors 2k + 1 of its rows, forces
   left out.                                                                                   */
GVI__COLD gvi_status gvi__morse_index(gvi_stepper *st, const gvi__matrix *J, int *negative)
{
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n, size = (size_t)(st->s - 1)*n;
    const unsigned off = in->off;
    *negative = 0;
    in->off |= gvi__of_kind(in, GVI_FORCE);
    const gvi_status status = gvi__jacobian_fill(st, J);
    in->off = off;
    if (status != GVI_OK) return status;
    gvi_real *a = J->square;
    for (size_t i = 0; i < size; ++i)
        for (size_t j = 0; j <= i; ++j) {
            const gvi_real lower = a[i*size + j]/(gvi_real)(2*(i/n) + 3);
            const gvi_real upper = a[j*size + i]/(gvi_real)(2*(j/n) + 3);
            a[i*size + j] = a[j*size + i] = (lower + upper)/2*in->sized.h;
        }
    *negative = gvi__count_negative((int)size, a, J->ends);
    return GVI_OK;
}

/* The curve by any degree: rows k >= 1 of (1).  The matrix where it ended shows whether the ends
   determine it: a reciprocal condition below its own relative error is a conjugate point.
   One inside a curve found from the chord is refused too, unless the equations were all but linear
   there: a half circle is not near its diameter.                                             */
GVI__COLD gvi_status gvi__interior(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                   const gvi_real *q1, const gvi_discrete *out, gvi__matrix *J,
                                   gvi_real *p, int *negative)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, size = (st->s - 1)*n;
    if (size == 0) return gvi__chord(st, from, h, q1, p);
    int linear = 0;
    gvi_status status = GVI_OK;
    for (int look = 0; look < 2; ++look) {        // once more to see why, as in gvi__solve
        in->diagnose = look;
        linear = gvi__follow(st, from, h, q1, out->guess, out->negative != NULL, J, &status);
        in->diagnose = 0;
        if (status != GVI_E_NON_FINITE) break;
    }
    if (status == GVI_E_NON_FINITE && st->fault.effect == GVI_FAULT_NONE)      // h, q1 - q0 or M
        return gvi__report_status(st, GVI_E_CONVERGENCE);
    if (status != GVI_OK && status != GVI_E_CONVERGENCE) return status;
    if (out->negative || (!out->guess && !linear)) {
        const gvi_status index = gvi__morse_index(st, J, negative);
        if (index != GVI_OK) return index;
        if (*negative && !out->negative) return GVI_E_CONJUGATE;
    }
    J->scaled = 1;
    const gvi_status second = gvi__jacobian(st, J);
    if (second != GVI_OK) return second;
    gvi_real error = GVI__SOLVED*GVI_SQRT(GVI__EPS);       // that of differences
    if (gvi__mass_is_constant(in) && !gvi__with_hessian(in, 0)) error = GVI__SOLVED*GVI__EPS;
    if (gvi_lu_rcond(size, J->square, J->pivot, in->newton.moved) < error) status = GVI_E_CONJUGATE;
    for (int i = 0; i < n; ++i) p[i] = gvi__dot(st->r, in->table.b, in->work.P + i*in->R);
    return status;
}

/* Discrete forces h sum b_i f_i dQ_i/dq0, dQ_i/dq1 with the curve's dependence on its ends.  The
   interior rows R = 0 give dy/dq = -J^-1 dR/dq, so the part of y is -lambda' dR/dq with J'
   lambda = g, g_k = h sum h b_i Phi_k f_i: one transposed solve for all of it.                */
GVI__COLD gvi_status gvi__discrete_forces(gvi_stepper *st, const gvi__matrix *J, gvi_real *minus,
                                          gvi_real *plus)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, R = in->R, size = (s - 1)*n;
    const unsigned forces = gvi__of_kind(in, GVI_FORCE);
    const gvi_real *hb = in->sized.hb, *Phi = in->table.Phi, h = in->sized.h;
    gvi_real *f = in->work.F;                // not needed any more

    // the forces alone, at the points of the curve
    gvi_points at = gvi__points_at(st, st->r, R, in->t, in->work.Q, f, NULL);
    at.v = in->work.V;
    gvi__zero((size_t)n*(size_t)R, f);
    const gvi_status status = gvi__effects(st, &at, ~forces, NULL);

    // at fixed y_k, k >= 1:  dQ_i/dq1 = c_i, dQ_i/dq0 = 1 - c_i  (Phi_0 = c)
    for (int i = 0; i < n; ++i) {
        plus[i] = gvi__dot3(st->r, hb, Phi, f + i*R);
        minus[i] = 0;
        for (int j = 0; j < st->r; ++j) minus[i] += hb[j]*(1 - Phi[j])*f[i*R + j];
    }
    if (status != GVI_OK || size == 0 || !(forces & ~in->off)) return status;

    // the interior: J is that of the solution, with the columns of both ends
    gvi_real *lambda = in->newton.dy;
    for (int i = 0; i < n; ++i)
        for (int k = 1; k < s; ++k)
            lambda[(k - 1)*n + i] = h*in->watch.scale[i]*gvi__dot3(st->r, hb, Phi + k*R, f + i*R);
    gvi__lu_solve_transposed(size, J->square, J->pivot, lambda);
    const gvi_real *ends = J->ends;
    for (int row = 0; row < size; ++row, ends += 2*n)
        for (int i = 0; i < n; ++i) {
            const gvi_real by_y0 = ends[i]/h, by_q0 = ends[n + i];
            plus[i] -= lambda[row]*by_y0;                 // y_0 = (q1 - q0)/h
            minus[i] -= lambda[row]*(by_q0 - by_y0);
        }
    return GVI_OK;
}

GVI_DEF gvi_status gvi_discrete_lagrangian(gvi_stepper *st, gvi_real t, gvi_real h,
                                           const gvi_real *q0, const gvi_real *q1,
                                           const gvi_discrete *out)
{
    gvi_status status = gvi__ready(st, st && st->in.memory);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, R = in->R;
    const size_t size = (size_t)(s - 1)*(size_t)n, sn = (size_t)s*(size_t)n;
    if (!q0 || !q1 || !out) return gvi__refuse_call(st, "q0, q1 or out is NULL");
    if (gvi__first_non_finite(n, q0) >= 0 || gvi__first_non_finite(n, q1) >= 0 || !gvi__finite(t)
        || (out->guess && gvi__first_non_finite(n, out->guess) >= 0))
        return gvi__refuse_call(st, "t, q0, q1 or the guess is not finite");
    if (!gvi__finite(h) || !gvi__nonzero(h))
        return gvi__refuse_call(st, "h is 0, NaN or infinite");
    if (GVI__CONSTRAINTS && in->con.bits) return gvi__done(st, gvi__refuse_constraints(st));
    if ((s > 1 && !gvi__has(in, GVI__HAS_NEWTON)) || gvi__rule_is(in, GVI_KICKS) || in->clock >= 0)
        return gvi__done(st, GVI_E_FORMULATION);
    gvi__origin from = { t, 0, q0, in->zeros, in->zeros, in->zeros, 0 };
    gvi__matrix J = { NULL, NULL, NULL, 1, 0, 0, NULL };
    if (out->guess && s > 1) {
        status = gvi__momentum(st, t, q0, out->guess);
        if (status != GVI_OK) return gvi__done(st, status);
        gvi__copy((size_t)n, in->point + 5*n, in->step.p);
        from.p = in->step.p;
    }
    if (s > 1) {
        J.square = in->newton.J + sn*sn;
        J.ends = J.square + size*size;
        J.pivot = in->newton.pivot + sn + 1;
    }
    gvi__free_motion(st, &from, h);
    gvi__times(st->r, t, 0, h, in->table.c, in->t);     // explicit steps need none

    gvi_real *p0 = in->step.q, *p1 = in->step.p, *minus = in->result, *plus = minus + n, action = 0;
    const gvi_real *F = in->work.F, *hb = in->sized.hb;
    int negative = 0;
    status = gvi__interior(st, &from, h, q1, out, &J, p0, &negative);
    if (status == GVI_E_CONJUGATE
        || (status == GVI_E_SINGULAR && st->fault.effect == GVI_FAULT_NONE))
        return gvi__done(st, gvi__report_status(st, GVI_E_CONJUGATE));
    if (status == GVI_OK && out->lagrangian) status = gvi__curve_action(st, &from, h, q1, &action);
    if (status != GVI_OK) return gvi__done(st, status);

    // row 0 of (1) for p0, then (2)
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < st->r; ++j) p0[i] -= hb[j]*(1 - in->table.Phi[j])*F[i*R + j];
        p1[i] = p0[i] + gvi__dot(st->r, hb, F + i*R);
    }
    status = gvi__discrete_forces(st, &J, minus, plus);
    if (status != GVI_OK) return gvi__done(st, status);
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
    return gvi__done(st, GVI_OK);
}

/* ----------------------------------------------------------------- TEXTS */

GVI_DEF const char *gvi_status_text(gvi_status status)
{
    switch (status) {
    case GVI_OK:            return "ok";
    case GVI_E_ARGUMENT:    return "bad argument (a sentence: fault.argument)";
    case GVI_E_MEMORY:      return "memory too small: gvi_size(desc) bytes; GVI_LENGTH(n, s, r) "
                                   "or, with constraints, GVI_CONSTRAINED_LENGTH(n, s, r, m)";
    case GVI_E_NODES:       return "rule: nodes are not distinct and in [0,1], or not finite";
    case GVI_E_ORDER:       return "rule: its order is below the degree";
    case GVI_E_POINTS:      return "rule: it does not see every mode";
    case GVI_E_FORMULATION: return "no formulation, or not the pinned one, covers this scene";
    case GVI_E_SINGULAR:    return "singular matrix: a coordinate (fault.coordinate) has no mass";
    case GVI_E_CONVERGENCE: return "no solution found: halve h; if no h works, a force jumps, "
                                   "is noisy, or has a wrong derivative";
    case GVI_E_CALLBACK:    return "an effect (fault.effect) did not return 0: halve h";
    case GVI_E_NON_FINITE:  return "an effect (fault.effect) gave NaN or Inf: halve h";
    case GVI_E_VALUE:       return "an effect (fault.effect) has no value callback";
    case GVI_E_STATE:       return "too early, outside the last step, or a clock is on since";
    case GVI_E_CONJUGATE:   return "conjugate points: the ends do not determine the curve";
    case GVI_E_CLOCK:       return "a clock (fault.effect) must be positive: g <= 0";
    case GVI_E_CONSTRAINT:  return "the state is not on a constraint: g(t,q) or its rate is not 0";
    case GVI_E_RESOLUTION:  return "the step is not as accurate as desc.resolution wants it: "
                                   "halve h";
    default:                return "unknown status";
    }
}

// with a description or a call that no formulation covers
GVI__COLD const char *gvi__why_no_formulation(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int kicks = gvi__rule_is(in, GVI_KICKS), clock = GVI__CLOCK && in->clock >= 0,
              ready = in->memory != 0;
    if (GVI__CONSTRAINTS && in->con.bits)
        return "constraints go with no clock, kicks or boundary values; with a formulation "
               "pinned or iterations given, what that covers (GVI_NEWTON: all)";
    if (ready && st->fault.effect >= 0)
        return "under a clock this value (fault.effect) must not change with t: list it as a force";
    if (ready && (kicks || clock)) return "kicks have no curve and no action, clocks no action";
    if (ready) return "needs GVI_NEWTON, or GVI_AUTO with s n <= 1024 and no given iterations";
    if (in->chosen == GVI_NEWTON) return "iterations is given, and this takes Newton's method";
    if (kicks) return "kicks are for constant mass and effects that read only t and q";
    if (clock) return "a clock needs r = s, and a mass or mass.velocity";
    if (in->desc.formulation != GVI_AUTO) 
        return "the pinned formulation does not cover this scene, or a macro leaves it out";
    return "what this scene needs is left out by a macro GVI_ONLY_... or GVI_NO_...";
}

GVI_DEF const char *gvi_why(const gvi_stepper *st)
{
    if (!st) return "the stepper is NULL";
    const struct gvi__private *in = &st->in;
    const int why = st->status, mass = st->fault.effect == GVI_FAULT_MASS;
    if (st->fault.argument) return st->fault.argument;
    if (why == GVI_E_FORMULATION) return gvi__why_no_formulation(st);
    if (why == GVI_E_ORDER && st->order == 0) return "rule: the weights do not sum to 1";
    if (why == GVI_E_POINTS && in->desc.rule.points < in->desc.degree)
        return "rule: fewer points than the degree";
    if (why == GVI_E_SINGULAR && st->fault.effect >= 0)
        return "a constraint (fault.effect) depends on the others, or has no gradient";
    if (why == GVI_E_CONVERGENCE && mass) return "no velocity found that has this momentum";
    if (why == GVI_E_CONVERGENCE && in->desc.iterations > 0)
        return "desc.iterations are too few: halve h, or give more";
    if (why == GVI_E_CALLBACK && mass) return "a callback of the mass did not return 0: halve h";
    if (why == GVI_E_NON_FINITE && mass) return "a callback of the mass gave NaN or Inf: halve h";
    if (why == GVI_E_NON_FINITE && st->fault.point < 0)
        return "an effect (fault.effect) is NaN or Inf where the step starts: no h will do";
    if (why == GVI_E_STATE && !in->memory) return "not initialised: gvi_init comes first";
    if (why == GVI_E_STATE && !in->started) return "not started: gvi_start comes first";
    if (why == GVI_E_STATE && !in->stepped) return "no step yet";
    return gvi_status_text(st->status);
}

GVI_DEF size_t gvi_stepper_size(void) { return sizeof(gvi_stepper); }

GVI_DEF const char *gvi_formulation_text(const gvi_stepper *st)
{
    if (!st) return "no stepper";
    if (st->in.desc.formulation != GVI_AUTO) return "pinned by the description";
    if (st->formulation == GVI_NEWTON && st->in.chosen != GVI_NEWTON)
        return "Newton: the fixed point contracted badly";
    switch (st->formulation) {
    case GVI_EXPLICIT:
        return "explicit: Lobatto 2 or kicks, constant mass, effects read only t and q";
    case GVI_POSITIONS:  return "positions: constant mass, effects read only t and q";
    case GVI_VELOCITIES: return "velocities: constant mass, an effect reads v";
    case GVI_MOMENTA:    return "momenta: r = s, velocity from momentum at each point";
    case GVI_NEWTON:     return "Newton: no fixed point covers this mass, degree and rule";
    case GVI_AUTO: default: return "not set up";
    }
}

#endif /* GVI_IMPLEMENTATION */

#ifdef __GNUC__
GVI__MACROS(pop_macro)
#endif

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
