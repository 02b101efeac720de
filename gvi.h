/* gvi.h - v0.4.0 - Galerkin variational integrators for mechanical systems
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
                 (magnetic fields), GVI_CONSTRAINT holds g = 0 (rods, joints),
                 GVI_NONHOLONOMIC A v + a = 0 (wheels, blades)
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
     PART I: THE INTEGRATOR, to be read as a course
     NUMBERS              lanes, sums, double-word arithmetic
     TOLERANCES           every constant of judgement
     BLOCKS               LU and L D L'; Gauss and Lobatto; interpolation
     PARTS                which chapters of PART II are at work, and where they plug in
     SCENE                status and fault; effects at points; mass
     TABLES               what depends on rule, degree and h alone; predictor
     SET-UP               checks, choice of a formulation, memory
     STEP                 in seven parts, from the stages to gvi_step
     STATE                start, switch, restore; velocity, energy, curve
     PART II: CHAPTERS, each by itself, any of which may be left out
     LAGRANGIAN TERMS     what else depends on v; Legendre transform
     MOMENTA              M(q), formulation (5)
     CLOCK                time that runs fast and slow
     KICKS                Stoermer-Verlet and splittings
     NEWTON'S METHOD      where no fixed point contracts
     CONSTRAINTS          multipliers, RATTLE, projection; rolling; by Newton's method
     OWN RULES            other nodes and weights
     OUTPUT               the state at any time, the action
     THE DIAL             as accurate as asked for
     BOUNDARY VALUES      discrete Lagrangian, forces, conjugate points
     DIAGNOSIS, SENTENCES which effect was it, and what to do
     SWITCHBOARD          what happens at each place, in which order
     LICENCE


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
              refused or have no effect.  Do not use clang's -fno-honor-nans,
              -fno-honor-infinities and -freciprocal-math: no macro shows them.  q, p and
              t carry compensation terms, so 1e9 steps of t + h are as exact as one.
              Compiled with -ffp-contract=off, it gives the same bits on every IEEE
              machine but x87, if the callbacks give the same bits and products stay
              between 1e-290 and 1e299 (float: 1e-30 and 1e34); beyond, their low words
              depend on FMA.
   work       Bounded: docs/embedded.md has the bound, but not that of constraints.
   converged  A step ends when every coordinate has converged, each measured by
              its own size.  Where large forces cancel, a coordinate may never
              settle: its changes then count as rounding below 32 eps of the
              largest |q_i| sqrt(M_ii).

   gvi.h does not: find contacts (examples/tools/contact.h does), run in parallel, or read or
   write anything.


   OPTIONS

     GVI_IMPLEMENTATION  [one file]    the code, besides the declarations
     GVI_STATIC          [that file]   everything static: private copy
     GVI_REAL            [everywhere]  float, double (default), long double
     GVI_EFFECTS         [everywhere]  most effects a scene may list: 16, to 32
                                       (files that differ in these two do not link)

   Less code, for small machines (docs/embedded.md), all in [that file].  Chapters:

     GVI_NO_LAGRANGIAN    effects of kind GVI_LAGRANGIAN       GVI_NO_MOMENTA  M(q), clocks
     GVI_NO_CLOCK         effects of kind GVI_CLOCK            GVI_NO_KICKS    explicit steps
     GVI_NO_CONSTRAINTS   constraints of both kinds            GVI_NO_RULES    GVI_OWN
     GVI_NO_NEWTON        Newton's method, boundary values     GVI_NO_DIAL     gvi_advance
     GVI_NO_OUTPUT        gvi_state_at, gvi_action, boundary values
     GVI_NO_BOUNDARY      gvi_discrete_lagrangian, gvi_start_configurations
     GVI_NO_RESTORE       gvi_restore
     GVI_NO_EXPLAIN       the search for the effect that is at fault
     GVI_NO_TEXTS         sentences: gvi_why and the like return ""
     GVI_CORE             leaves out all of these
     GVI_ONLY_EXPLICIT    kicks and Stoermer-Verlet alone: no iteration

   A description that needs what was left out is refused: GVI_E_FORMULATION.  A function of it is
   not there: a call does not link.  With GVI_STATIC, functions that are not called vanish as well.

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
   modes y_k: the same curves as with control points [2, sec. 2.4], but well conditioned
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
     S = Phi Gamma^-1 Phi'      T = phi Gamma^-1 Phi'

   with phi_ik = phi_k(c_i), Phi_ik = Phi_k(c_i), and ' for the transpose.  So for
   effects that read only q the unknowns are the forces: put F in, get Q out,
   evaluate the effects at all r points at once, repeat.  No velocity, no matrix.  S is
   symmetric: that is what symplecticity asks of (3), and it survives rounding, since
   S and c are rounded to one grid.

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
     velocities   constant mass, forces that read v: (3) and (4) as fixed point
     momenta      M(q), Lagrangian terms, or velocity from momentum given, and r = s: (5)
     Newton       all but a clock and kicks: (1) by Newton's method, dense LU of size s*n

   Each iteration of a fixed point makes the error smaller by (rho h omega)^2 (positions) or
   rho h omega: omega the fastest frequency, rho 1/2 at degree 1, 0.29 at 2, less above.  Where
   that is no gain, GVI_AUTO goes over to Newton.  All solve the same equations, to rounding.

   CONSTRAINTS.  Effects g(t,q) = 0 hold at Lobatto's s + 1 points of the step, where their
   multipliers act; Lagrangian and forces keep the rule's points [8], [9] (equations: CONSTRAINTS).
   The step ends on g = 0 and on the hidden constraint G v + dg/dt = 0, G = dg/dq.  q and p are of
   order min(2s, u) for u >= 2s - 2, symplectic on the constraint manifold; degree 1 with Lobatto's
   two points is RATTLE.  Second derivatives are not needed.  Zeros in G cost nothing: list rows
   that share coordinates near each other.  Of rows that depend on each other and agree, one is
   left out, step by step: its multiplier is 0.  The rank must not change within a step, as it does
   at a change point, where the motion branches.  Newton has lambda among its unknowns, s (n + m) of
   them for m constraints; the fixed points solve for it as they go.

   CLOCK.  An effect g(q) > 0 makes time run as dt = g dtau, and h is a step in
   tau: t moves fast or slow, and the map is as symplectic as with fixed steps
   [3, VIII.2].  The curves of energy E are the zero-energy curves of
   g L(q, q'/g) + g E, a Lagrangian like any other, so momenta takes

     V_i = g v        F_i = g (dL/dq + f) - dg/dq (H - E)        t' = g

   with v = M^-1 p as before.  E is the energy at the start plus the work of forces,
   so every potential and Lagrangian term needs its value.  None of them may depend
   on t: list what does as a force (a value that changes with t is refused at the
   start, GVI_E_FORMULATION).  Without a mass, a clock needs mass.velocity.

   Order.  min(2s, u, 2(u - s + 1)) for a rule of order u, forces included: twice the degree if
   u >= 2s - 2, which [2, thm. 4.1] does not ask for (docs/theory.md: proof, constant).  L_d is
   exact to one power more; the curve in between has order min(s, u - s + 1) + 1.  Refused: r < s
   and a singular Gamma (a mode without kinetic energy), u < s (free motion is not exact).

   NOTATION       n degrees of freedom   s degree   r points   h step
                  q, v, p, t, F, P, V, Q, c, b, S, T   as above

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

#define GVI_VERSION "0.4.0"

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
#define gvi_steps GVI__LINKED(gvi_steps)
#define gvi_advance GVI__LINKED(gvi_advance)
#define gvi_project GVI__LINKED(gvi_project)
#define gvi_switch GVI__LINKED(gvi_switch)
#define gvi_velocity GVI__LINKED(gvi_velocity)
#define gvi_energy GVI__LINKED(gvi_energy)
#define gvi_multipliers GVI__LINKED(gvi_multipliers)
#define gvi_curve GVI__LINKED(gvi_curve)
#define gvi_curve_multipliers GVI__LINKED(gvi_curve_multipliers)
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

/* Chapters that are left out, and what needs them.                                            */
#ifdef GVI_CORE
#define GVI_NO_RULES
#define GVI_NO_LAGRANGIAN
#define GVI_NO_MOMENTA
#define GVI_NO_KICKS
#define GVI_NO_NEWTON
#define GVI_NO_CONSTRAINTS
#define GVI_NO_OUTPUT
#define GVI_NO_DIAL
#define GVI_NO_RESTORE
#define GVI_NO_EXPLAIN
#define GVI_NO_TEXTS
#endif
#ifdef GVI_ONLY_EXPLICIT
#undef GVI_NO_KICKS
#define GVI_NO_RULES
#define GVI_NO_LAGRANGIAN
#define GVI_NO_MOMENTA
#define GVI_NO_NEWTON
#define GVI_NO_CONSTRAINTS
#define GVI_NO_DIAL
#endif
#if defined(GVI_NO_MOMENTA) && !defined(GVI_NO_CLOCK)
#define GVI_NO_CLOCK
#endif
#if defined(GVI_NO_MOMENTA) && defined(GVI_NO_NEWTON) && !defined(GVI_NO_LAGRANGIAN)
#define GVI_NO_LAGRANGIAN
#endif
#if (defined(GVI_NO_NEWTON) || defined(GVI_NO_OUTPUT)) && !defined(GVI_NO_BOUNDARY)
#define GVI_NO_BOUNDARY
#endif

/* GVI__BODY: copied to where it is called, since its sizes are constants there.
   GVI__COPIED: so, too, unless code is to be small.
   GVI__RESTRICT: arrays that do not overlap.                                                    */
#if defined(__GNUC__)
#define GVI__BODY static inline __attribute__((always_inline))
#define GVI__RESTRICT __restrict
#define GVI__UNUSED __attribute__((unused))
#else
#define GVI__BODY static inline
#define GVI__RESTRICT
#define GVI__UNUSED
#endif
#if defined(__OPTIMIZE_SIZE__)
#define GVI__COPIED static inline
#else
#define GVI__COPIED GVI__BODY
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

/* The bits of sqrt, but errno is never set.  A compiler that must set it does not
   vectorise square roots unless given -fno-math-errno.                                        */
#if defined(__GNUC__) && !defined(GVI_SQRT)
gvi_real GVI__MATH(__builtin_sqrt)(gvi_real x) __attribute__((const));
#define GVI_SQRT(x) GVI__MATH(__builtin_sqrt)(x)
#elif !defined(GVI_SQRT)
#define GVI_SQRT(x) GVI__MATH(sqrt)(x)
#endif

typedef enum gvi_status {
    GVI_OK            =  0,
    GVI_E_ARGUMENT    = -1,  /* an argument of a call, desc, or a callback: gvi_why      */
    GVI_E_MEMORY      = -2,  /* the memory is smaller than gvi_size(desc)               */
    GVI_E_NODES       = -3,  /* own rule: a node outside [0,1], or two that coincide;
                                kicks: not finite                                   */
    GVI_E_ORDER       = -4,  /* own rule of order u < s, weights that do not sum to 1   */
    GVI_E_POINTS      = -5,  /* r < s, or a rule that does not see every mode           */
    GVI_E_FORMULATION = -6,  /* no formulation, or not the pinned one, covers this scene */
    GVI_E_SINGULAR    = -7,  /* singular matrix, and no h helps: massless coordinate
                                (fault.coordinate), or a constraint (fault.effect, its row in
                                fault.coordinate) that depends on the others in a part of the
                                step, or is about to, or has G = 0                  */
    GVI_E_CONVERGENCE = -8,  /* no solution found: halve h                          */
    GVI_E_CALLBACK    = -9,  /* a callback did not return 0 (fault.effect): halve h     */
    GVI_E_NON_FINITE  = -10, /* NaN or Inf came out of an effect (fault.effect); fault.point
                                is GVI_FAULT_NONE: already where the step starts    */
    GVI_E_VALUE       = -11, /* an effect (fault.effect) has no value                   */
    GVI_E_STATE       = -12, /* not started, no step yet, or a time outside the last step: ask
                                for it after the step that passes it                */
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
    gvi_real       *rate;      /* [rows][stride] write dg_a/dt where g reads t; it is 0 before;
                                  nonholonomic: A to jacobian, a to rate, g stays as it is */
    const char    **why;       /* for gvi_fail; may be NULL                    */
} gvi_points;

/* All points at once.  Returns 0, or anything else if it cannot be evaluated
   here.  A step that is not explicit is then tried without its predictor, nearer to its
   start, and by Newton's method; if all fail, it ends with GVI_E_CALLBACK.    */
typedef int gvi_points_fn(const gvi_points *x, void *user);

/* A callback that knows why it cannot be evaluated says so by `return gvi_fail(x, "beyond the
   road's end")`: gvi_why gives this sentence, which has to stay where it is.  Returns 1.     */
static inline int gvi_fail(const gvi_points *x, const char *why)
{
    if (x->why) *x->why = why;
    return 1;
}

/* A gvi_points_fn written for one point.  GVI_POINTS(name, n, ...) means `static int name`;
   n is a constant.  The list names the arrays that the body uses (t and q are always there): v, p,
   f, dldv, and one of value, mass, velocity; or rows(m), m a constant, for the g, jacobian and
   rate of m constraints.  With f and value, `name` serves as points and as value.  Listing an array
   that the effect's kind does not have, an n larger than the scene's, and filling an array that is
   not listed give GVI_E_CALLBACK, with a fault.argument; an input that is not listed is NaN.

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
       GVI__MISSING = 0x7656, GVI__OTHER_N, GVI__UNLISTED };
#ifdef __GNUC__
#define GVI__NAN ((gvi_real)__builtin_nanf(""))
#else
#define GVI__NAN ((gvi_real)3e38f)                     // as far off as NaN, and known everywhere
#endif
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
    GVI__BODY void gvi__body_##name(const gvi_points *x, void *user);                           \
    GVI_POINTS(name, n, __VA_ARGS__)(const gvi_points *x, void *user)                           \
    { return gvi__body_##name(x, user), 0; }                                                    \
    GVI__BODY void gvi__body_##name(GVI__UNUSED const gvi_points *x, GVI__UNUSED void *user)

/* Many coordinates under one law: GVI_ROWS(x, from, to, j, body) runs body for each place j of the
   rows `from` to `to` - 1.  Coordinate i has its points at j = i*stride, i*stride + 1, ...; at the
   same point, coordinate i + 1 is at j + stride.  A chain of springs, without its ends:

     const int d = x->stride;
     GVI_ROWS(x, 1, n - 1, j, f[j] += q[j + d] - 2*q[j] + q[j - d];)

   gcc and clang vectorise it from -O2 on, by points or, where a step has one, as kicks have, by
   coordinates.  No j may write what the body for another j reads or writes.                  */
#define GVI_ROWS(x, from, to, j, ...)                                                           \
    GVI__WARNINGS(push) GVI__WARNINGS(ignored "-Wpass-failed")                                  \
    {                                                                                           \
        int gvi__j = (from)*(x)->stride;                                                        \
        const int gvi__end = (to)*(x)->stride;                                                  \
        for (; gvi__end - gvi__j >= 8; gvi__j += 8)                                             \
            GVI__INDEPENDENT for (int j = gvi__j; j < gvi__j + 8; ++j) { __VA_ARGS__ }          \
        for (; gvi__j < gvi__end; ++gvi__j) { const int j = gvi__j; __VA_ARGS__ }               \
    }                                                                                           \
    GVI__WARNINGS(pop)

// points k..to-1: a column of what is wanted to a, the body, and back
GVI__BODY int gvi__each_point(gvi_points_fn *at, const gvi_points *x, void *user, int n, int uses,
                              int wanted, gvi_real *a, int k, int to, gvi_real *GVI__RESTRICT f)
{
    const int s = x->stride, value = uses & GVI__USES_value, mass = uses & GVI__USES_mass;
    const int m = value ? 1 : mass ? n*n : n, any = ~0, last = 112, rows = uses/GVI__ROWS;
    gvi_real *other = value ? x->value : mass ? x->mass : x->velocity;
    gvi_real *g = rows ? a + 6*n : NULL, *G = g ? g + rows : NULL, *dg = g ? G + m*rows : NULL;
    const int single = !(mass || uses & GVI__USES_velocity), from = (value ? 5*n + 1 : 5*n);
    int failed = 0;
    // what is not listed: inputs are NaN, and outputs are seen to be 0 behind the loop
    GVI__LOOP(GCC unroll 64) for (int i = 0; i < n; ++i) {
        if (!(uses & GVI__USES_v)) a[n + i] = GVI__NAN;
        if (!(uses & GVI__USES_p)) a[2*n + i] = GVI__NAN;
        if (!(uses & GVI__USES_f)) a[3*n + i] = 0;
        if (!(uses & GVI__USES_dldv)) a[4*n + i] = 0;
        if (single && 5*n + i >= from) a[5*n + i] = 0;
    }
#define GVI__COLUMN(name, o) uses & GVI__USES_##name ? a + (o)*n : NULL
#define GVI__MOVE(mask, m, to, from)                                                            \
    if (wanted & (mask)) GVI__LOOP(GCC unroll 64) for (int i = 0; i < (m); ++i) to = from
    GVI__INDEPENDENT for (; k < to; ++k) {
        gvi_points y = { n, 1, 1, x->t + k, a, a + n, a + 2*n, a + 3*n, a + 4*n,
                         single ? a + 5*n : NULL,
                         GVI__COLUMN(mass, 5), GVI__COLUMN(velocity, 5), g, G, dg, x->why };
        GVI__MOVE(any, n, a[i], x->q[i*s + k]);
        GVI__MOVE(GVI__USES_v, n, a[n + i], x->v[i*s + k]);
        GVI__MOVE(GVI__USES_p, n, a[2*n + i], x->p[i*s + k]);
        GVI__MOVE(GVI__USES_f, n, a[3*n + i], f[i*s + k]);
        GVI__MOVE(GVI__USES_dldv, n, a[4*n + i], x->dldv[i*s + k]);
        GVI__MOVE(last, m, if (!mass || i%n <= i/n) a[5*n + i], other[i*s + k]);  // of M, i >= j
        GVI__MOVE(any, rows*(n + 2), g[i], 0);                          // and G and dg
        failed |= (at(&y, user) != 0) & (k < x->count);
        GVI__MOVE(any, rows, x->g[i*s + k], g[i]);
        GVI__MOVE(any, rows*n, x->jacobian[i*s + k], G[i]);
        GVI__MOVE(any, rows, x->rate[i*s + k], dg[i]);
        GVI__MOVE(GVI__USES_f, n, f[i*s + k], a[3*n + i]);
        GVI__MOVE(GVI__USES_dldv, n, x->dldv[i*s + k], a[4*n + i]);
        GVI__MOVE(last, m, if (!mass || i%n <= i/n) other[i*s + k], a[5*n + i]);
    }
    int unlisted = 0;
    GVI__LOOP(GCC unroll 64) for (int i = 0; i < n; ++i) {
        if (!(uses & GVI__USES_f)) unlisted |= !(a[3*n + i] >= 0 && a[3*n + i] <= 0);
        if (!(uses & GVI__USES_dldv)) unlisted |= !(a[4*n + i] >= 0 && a[4*n + i] <= 0);
        if (single && 5*n + i >= from) unlisted |= !(a[5*n + i] >= 0 && a[5*n + i] <= 0);
    }
    if (unlisted) return GVI__UNLISTED;
    return failed;
}

// is an array listed that is not there?
GVI__BODY int gvi__missing(const gvi_points *x, int wanted)
{
    const gvi_real *const arrays[] = { x->v, x->p, x->f, x->dldv, x->value, x->mass, x->velocity };
    int missing = wanted >= GVI__ROWS && !x->g;
    GVI_UNROLL for (int k = 0; k < 7; ++k) missing |= (wanted >> k & 1) && !arrays[k];
    return missing;
}

GVI__BODY int gvi__in_chunks(gvi_points_fn *at, const gvi_points *x, void *user, int n, int uses,
                             int wanted, gvi_real *a)
{
    int failed = 0, k = 0;
    // of fewer coordinates, the first ones
    if (x->n < n || (x->n > n && (uses & GVI__USES_mass || uses >= GVI__ROWS))) return GVI__OTHER_N;
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
    GVI_CONSTRAINT = 4,  /* g(t,q) = 0, `rows` of them: writes g, jacobian, rate     */
    GVI_NONHOLONOMIC = 5 /* A(t,q) v + a(t,q) = 0, `rows` of them: writes A to jacobian, a to
                            rate */
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
    int             rows;     /* of constraints of both kinds; they may depend on each other */
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
                             With m constraints if s (n + m)^3 <= 2880 n        */
    GVI_EXPLICIT   = 1,
    GVI_POSITIONS  = 2,
    GVI_VELOCITIES = 3,   /* forces that read v; Lagrangian terms take momenta or Newton */
    GVI_MOMENTA    = 4,   /* r = s                                                    */
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
                                          it is refused: GVI_E_RESOLUTION.  Needs a rule of order 2
                                          degree or more.  0: none is refused, nothing measured */
    int               tries;           /* lengths a call of gvi_advance tries.  0: 64, the most */
} gvi_desc;

#define GVI_FAULT_NONE (-1)            /* no effect, coordinate or point        */
#define GVI_FAULT_MASS (-2)            /* the callbacks of desc.mass            */

typedef struct gvi_fault {             /* where the last failure came from      */
    int effect;                        /* index in effects, or GVI_FAULT_...    */
    int coordinate;                    /* or GVI_FAULT_NONE                     */
    int point;                         /* quadrature point, or GVI_FAULT_NONE   */
    const char *argument;              /* GVI_E_ARGUMENT, GVI_E_CALLBACK of a GVI_POINTS that
                                          lists too much or by gvi_fail, and where a call
                                          knows more than its status: a sentence, else NULL */
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

/* ---- private: the core's own.  What a chapter needs stands in a struct of its own ---- */

struct gvi__phase { gvi_real *q, *q_low, *p, *p_low; };     /* [n] each                        */
struct gvi__values { gvi_real *Q, *F, *V; };                /* stage values, [n][R]            */

struct gvi__tables {                  /* rule and degree; R = stride of rows                   */
    gvi_real *c, *b;                  /* [R] nodes on their grid, weights                      */
    gvi_real *phi, *Phi;              /* [s][R] modes at the nodes                             */
    gvi_real *phi_low, *Phi_low;      /* [s][R] their low words; Phi_low: during set-up alone  */
    gvi_real *inv_gamma;              /* [s] 1/Gamma_kk                                        */
    gvi_real *K, *U;                  /* [r][R] see gvi__make_tables                           */
};

struct gvi__sized {                   /* valid for a step of length h, the key                 */
    gvi_real  h;
    gvi_real *hb;                     /* [R] h b                                               */
};

struct gvi__predictor {               /* see gvi__prepare_predictor                            */
    gvi_real *equal, *one;            /* [steps r][R] by steps as long; [r][R] by the last     */
    gvi_real *weights;                /* [R] barycentric, of the nodes                         */
    gvi_real  ratio;                  /* h/h_last for which `one` holds                        */
    int       made;                   /* `equal` is: 1, or 2 with K and b in it                */
    int       steps, sums;            /* what serves this step: steps kept in `equal`, or 0    */
                                      /* for `one`; with K and b in it?                        */
};

#ifndef GVI_NO_RULES
struct gvi__rules {
    gvi_real *gamma;                  /* [s*s + s + 1] LU of a full Gamma, or NULL             */
};
#endif

#ifndef GVI_NO_LAGRANGIAN
struct gvi__lagrangian {
    gvi_real *A, *last_A, *older_A;   /* [n][R] dL/dv of the effects: stage values             */
    gvi_real *hessian;                /* [n*n + n + 1] d2L/dv2 at one point, with its LU       */
    gvi_real *column;                 /* [4n] scratch of the Legendre transform                */
};
#endif

#ifndef GVI_NO_MOMENTA
struct gvi__momenta {
    gvi_real *P, *T;                  /* [n][R] stage values; [r][R] table of Q                */
    gvi_real *ones;                   /* [n] rows of P and Q are over no mass                  */
    gvi_real *was;                    /* [n] velocities of the iteration before                */
    gvi_real *mass;                   /* [n*n][R] M(q) at the points, or its factors           */
    int       has_factor;             /* mass is that of this iteration, factored              */
    int       moves;                  /* V still does: see gvi__place_between                  */
};
#endif

#ifndef GVI_NO_CLOCK
struct gvi__time {
    gvi_real *rate, *slope;           /* [R], [n][R] g and dg/dq at the points                 */
    gvi_real *power, *level;          /* [R] f'v g; H - E                                      */
    gvi_real *lagrangian, *noise;     /* [R] values of Lagrangian terms; rounding of level     */
    gvi_real  H, H_low, dH, began;    /* energy, compensation, increment; at the step's start  */
    int       effect;                 /* that is the clock                                     */
};
#endif

#ifndef GVI_NO_KICKS
struct gvi__kicks {
    gvi_real *drift;                  /* [r + 1] between the kicks, for a step of length h     */
    gvi_real  h;
    int       has_force;              /* last.F ends with the force at (t, q)                  */
};
#endif

#ifndef GVI_NO_NEWTON
struct gvi__newton {                  /* N = s (n + m) unknowns                                */
    gvi_real *y, *dy, *residual;      /* [N] unknowns, change, rows of (1)                     */
    gvi_real *last;                   /* [N] y before the change                               */
    gvi_real *found, *branch;         /* [N] see gvi__newton_connected                         */
    gvi_real *guess, *slope;          /* [N] the same                                          */
    gvi_real *P;                      /* [n][R] stage values                                   */
    gvi_real *J, *pivot;              /* two matrices of N: of steps, of queries               */
    gvi_real *unit;                   /* [2][s*m] of multipliers, see gvi__jacobian            */
    gvi_real *scale;                  /* [2][n] see gvi__matrix                                */
    gvi_real *hessian;                /* [3 n*n] of one effect at one point                    */
    gvi_real *moved;                  /* [4n][R] F and P, moved and not                        */
    gvi_real  bend;                   /* worst contraction on the way to the last solution     */
    gvi_real  noise;                  /* relative, of its modes, of the rounding of g          */
    gvi_real  h;                      /* for which J was made, 0: none                         */
    int       covers;                 /* solves the scene, by itself or where others fail      */
    int       left, next_left;        /* steps until the fixed point is tried; after this one  */
};
#endif

#ifndef GVI_NO_CONSTRAINTS
struct gvi__holonomic {               /* m rows on; C = stride of D_0..D_s                     */
    gvi_real *d, *w, *hw;             /* [R + C], [s+1] Lobatto's nodes, weights; [R] h w      */
    gvi_real *t;                      /* [C] times of D                                        */
    gvi_real *Phi, *Phi_low;          /* [s][R] modes at D_1..D_s                              */
    gvi_real *K, *U;                  /* [r][R] of the impulses, to Q and to V or P            */
    gvi_real *by_force, *by_impulse;  /* [r][R] to D                                           */
    gvi_real *lu, *X;                 /* K(d_a, d_e), its LU; [s][R] its inverse               */
    gvi_real *E, alpha, beta;         /* [s][R] predictor, for times alpha + beta d_e          */
    gvi_real *D, *free, *plus;        /* [n][R] stage values, free motion; [2n][R] to stages   */
    gvi_real *P;                      /* [n][R] momenta of a trial                             */
    gvi_real *force, *last;           /* [n+m][R] G' lambda, -lambda; [n+m][C] last step's     */
    gvi_real *rho;                    /* [m][R + C] residual of the multipliers                */
    gvi_real *at, *g, *G;             /* [n][C] D; [2m][C] g and rate; [m][n][C]               */
    gvi_real *gram;                   /* [m][m][C] G M^-1 G', factored                         */
    gvi_real *scratch, *y;            /* [n][C] scratch; [7][m]                                */
    gvi_real *G1, *gram1;              /* [2][m][n], [m][m] at one point                        */
    gvi_real *column, *first;         /* [m][n+1], [m] where G is not 0: gvi__find_columns     */
    gvi_real *drops;                  /* [2][m] rows left out: gvi__factor_constraints         */
    gvi_real *noise;                  /* [m] |g| at ends of steps: gvi__constraint_shift       */
    int       m, C;
    int       Q;                      /* the stage that makes Q                                */
    int       made;                   /* iterations                                            */
    int       kept;                   /* last is there: for the curve; 2: to predict as well   */
    int       linear;                 /* g is linearised from the last D                       */
    gvi_real  near_start;             /* see gvi__check_rank                                   */
    int       margin;                 /* of that: 1, or GVI__FADES once a step has failed      */
    int       settled, again;         /* steps since the start; see gvi__find_columns          */
    unsigned  bits;                   /* the effects                                           */
    unsigned  checked;                /* those with derivatives that were seen to be right     */
};
#endif

#ifndef GVI_NO_CONSTRAINTS
struct gvi__rolling {                 /* rows of GVI_NONHOLONOMIC, of m in all                 */
    gvi_real *A, *a;                  /* [m*n][R] at the points; [2m][R] g, not used, and a    */
    gvi_real *T;                      /* [r][R] T(c_j, d_a)                                    */
    unsigned  bits;                   /* the effects                                           */
};
#endif

#ifndef GVI_NO_DIAL
struct gvi__dial {
    gvi_real *high;                   /* [r][6] sources to the highest modes                   */
    gvi_real *now, *before;           /* [n] y_(K-1), and that of the step before              */
    gvi_real  span;                   /* h of that step; 0: there is none                      */
    int       top;                    /* the highest of the modes: K of gvi__resolution        */
    gvi_real  reach;                  /* rung up to which the last measured step would do      */
    gvi_real  barrier;                /* rung of the last length that failed                   */
    int       wait, again;            /* steps below that; failures near it, one after another */
    int       put_off;                /* shorter lengths come before Newton's method           */
};
#endif

#ifndef GVI_NO_EXPLAIN
struct gvi__explain {
    int looks;                        /* at what every effect returns                          */
};
#endif

struct gvi_stepper;
struct gvi__stage;
typedef gvi_real gvi__kernel(const struct gvi_stepper *st, const struct gvi__stage *stage,
                             int rescale);

struct gvi__private {
    gvi_desc            desc;         /* with its defaults filled in                           */
    gvi_formulation     chosen;       /* by the scene, or pinned                               */
    int                 R;            /* stride of rows                                        */
    int                 stages;       /* of an iteration: Q; Q and V; P and Q; 0: none         */
    int                 reads_v;      /* an effect does                                        */
    int                 adds_p;       /* an effect adds to dL/dv                               */
    int                 fallback;     /* where the fixed point fails, another solver follows   */
    unsigned            parts;        /* chapters at work in this scene: bits GVI__IN_...      */
    unsigned            off;          /* effects switched off                                  */
    unsigned            separate;     /* effects that a chapter evaluates                      */
    struct gvi__tables  table;
    struct gvi__sized   sized;
    struct gvi__predictor predictor;
    struct gvi__values  work, last, older;  /* of the next step, the last two                  */
    struct gvi__phase   state, step;  /* now; increments of the step at work                   */
    gvi_real            dt;           /* and that of t                                         */
    struct { gvi_real *q, *p; } began;      /* start of the last step                          */
    struct {                          /* M^-1 p; h times it; stages'                           */
        gvi_real *v, *v_low, *path, *path_low, *values;
    } free;
    struct { gvi_real *matrix, *factor, *inverse, *sums; } mass;
    struct {                          /* changes of the rows of stages, [2n]; contraction      */
        gvi_real *scale, *change, *before;
        gvi_real  ratio, found;       /* of the last step, of that at work                     */
    } watch;
    gvi_real           *t;            /* [R] times of the points                               */
    gvi_real           *set_up;       /* [9R] scratch of tables, predictor and curve           */
    gvi_real           *weighted;     /* [R] sources times weights                             */
    gvi_real           *point;        /* [6n] one point: q, v, -, -, f, dldv                   */
    gvi_real           *answer;       /* [3n] what a call returns, until it succeeds           */
    gvi_real           *zeros;        /* [n]                                                   */
    gvi_real           *start;        /* [n] velocity of the start                             */
    gvi_real           *memory;       /* from its first aligned number on                      */
    size_t              size, skip;   /* numbers in use; left out for alignment                */
    size_t              cleared;      /* numbers that gvi_init sets to 0: the first            */
    gvi__kernel        *kernel;       /* for n and r                                           */
    struct { gvi_status status; gvi_fault fault; } failed;  /* the last step, if it did        */
    int                 started;
    int                 stepped;      /* 2: by a clock                                         */
    int                 kept;         /* valid steps in last and older, equally long           */
    int                 has_velocity; /* last.V holds                                          */
    const char         *why;          /* of gvi_fail, until it is reported                     */
#ifndef GVI_NO_RULES
    struct gvi__rules      rules;
#endif
#ifndef GVI_NO_LAGRANGIAN
    struct gvi__lagrangian lagrangian;
#endif
#ifndef GVI_NO_MOMENTA
    struct gvi__momenta    momenta;
#endif
#ifndef GVI_NO_CLOCK
    struct gvi__time       time;
#endif
#ifndef GVI_NO_KICKS
    struct gvi__kicks      kicks;
#endif
#ifndef GVI_NO_NEWTON
    struct gvi__newton     newton;
#endif
#ifndef GVI_NO_CONSTRAINTS
    struct gvi__holonomic  con;
    struct gvi__rolling    rolling;
#endif
#ifndef GVI_NO_DIAL
    struct gvi__dial       dial;
#endif
#ifndef GVI_NO_EXPLAIN
    struct gvi__explain    explain;
#endif
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
                                         together, as the curve's modes show it (THE DIAL); the true
                                         error is usually far smaller, rarely 10 times as large.
                                         At degrees 1 and 2 all coordinates together, by forces */
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

/* Set-up comes first.
     gvi_size   bytes of memory that desc needs; 0 if its sizes, kinds or callbacks are refused:
                gvi_init, even with a NULL memory, then returns why
     gvi_init   makes st a stepper for desc that works in memory, size bytes of the caller's
   A chain of calls after a failure keeps its first status; st.q and st.p then point at zeros, n of
   them or 64 where there is no memory for them.                                               */
GVI_DEF size_t     gvi_size(const gvi_desc *desc);
GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size);

/* These start at time t; where that is st->t, st->t_low stays, so that a loop which corrects the
   state at each step loses no time.
     gvi_start                  starts from configuration and velocity
     gvi_start_momentum         starts from configuration and momentum
     gvi_start_configurations   starts from q0 at t and q1 at t + h (solves the boundary-value
                                problem; see gvi_discrete_lagrangian; no constraints)
   The first start with a constraint, and gvi_project before it, see that it fills all points, and
   compare its jacobian and rate with differences of g next to (t, q).  An entry that is off by more
   than 1/512 of itself, and more than rounding hides (in float most of 1 %), is refused:
   GVI_E_ARGUMENT, its row in fault.coordinate.  Later starts do not look again.
   GVI_E_CONSTRAINT where q or v is off a constraint: q by more than 4096 roundings of g's
   terms and 4 of the largest |q_i| sqrt(M_ii), v if the part that G v + dg/dt = 0 removes has more
   than (4096 eps)^2 of the kinetic energy.                                                    */
GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v);
GVI_DEF gvi_status gvi_start_momentum(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p);
#ifndef GVI_NO_BOUNDARY
GVI_DEF gvi_status gvi_start_configurations(gvi_stepper *st, gvi_real t, gvi_real h,
                                            const gvi_real *q0, const gvi_real *q1);
#endif

/* Moves q and v [n] to the nearest that fulfil the constraints that are on, at t, to rounding: q
   such that (q' - q)'M(q' - q) is least, then v likewise, M that there (with Lagrangian terms
   d2L/dv2).  For coordinates from a file; then gvi_start takes them.  moved, or NULL: the lengths
   sqrt(dq'M dq), sqrt(dv'M dv) of what was added to q and v.  The state and the switches stay (last
   places of later steps may not): for a constraint to come, where the state is off it, gvi_init,
   this, gvi_start.  GVI_E_CONVERGENCE: too far off (an effect and row that is left, if any);
   GVI_E_CONSTRAINT: rows contradict each other; q and v are then as they were.                 */
#ifndef GVI_NO_CONSTRAINTS
GVI_DEF gvi_status gvi_project(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v,
                               gvi_real *moved);
#endif

/* One step to t + h (with a clock: to tau + h); h < 0 steps back; h may differ from step to step
   (which keeps the map symplectic but not the energy's long-time bound).  Let a step end where a
   force jumps in time.  If what an effect reads through `user` changes between steps, call
   gvi_switch(st, i, 1): the explicit formulation reuses the force at the end of a step.       */
GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h);

/* `count` steps of h, or as many as succeed: st.counters.steps tells.  What st and its queries say
   is of the last one; 0 steps do nothing.  Explicit steps in a row cost less than by gvi_step. */
GVI_DEF gvi_status gvi_steps(gvi_stepper *st, gvi_real h, int count);

/* One step towards t_end, which may be before or after t: as long as desc.resolution allows, but
   never past t_end, and the last one ends on it to the bit:

     while (st.status == GVI_OK && st.t < t_end) gvi_advance(&st, t_end);

   The length is st.next, kept while the accuracy stays within a band; what is left is divided so
   that the last step is no shorter than half of it.  A step that fails is tried again, shorter,
   desc.tries times at most or until t would not move: then its status is returned, and the next
   call goes on with a shorter one.  With a clock h is in tau, and may pass t_end: gvi_state_at. */
#ifndef GVI_NO_DIAL
GVI_DEF gvi_status gvi_advance(gvi_stepper *st, gvi_real t_end);
#endif

/* Switches effect `index` off (on = 0) or on again, between steps.  An effect that is off is
   not evaluated; the formulation stays that of the whole list.  gvi_start leaves the switches
   as they are.  A constraint can be switched on where the state fulfils it, to rounding:
   GVI_E_CONSTRAINT elsewhere.                                                                 */
GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on);

/* These ask about the present state.
     gvi_velocity   v[n], by the inverse Legendre transform
     gvi_energy     p'v - L, which needs the value of each potential and Lagrangian term
                    that is on                                                               */
GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v);
GVI_DEF gvi_status gvi_energy(gvi_stepper *st, gvi_real *energy);

/* The constraints' multipliers at the present state, one for each row in the order of the list,
   0 where it is off: the force of constraint is G' lambda.  They follow from the acceleration that
   keeps G v + dg/dt = 0, so they are as exact as the state; second derivatives of g are differences
   along v, good to some 100 eps.  Of rows that depend on each other the first ones carry the
   force, the last have 0.                                                     */
#ifndef GVI_NO_CONSTRAINTS
GVI_DEF gvi_status gvi_multipliers(gvi_stepper *st, gvi_real *lambda);
#endif

/* These ask about the last step; q, v, p have length n or are NULL.  What later steps compute stays
   the same, to the bit.  A broken line has neither curve nor action, a clock no action:
   GVI_E_FORMULATION.
     gvi_curve      the polynomial at tau in [0,1] and its derivative, error O(h^(min(s,u-s+1)+1))
                    and one order less; with a clock tau is its own time, and v still dq/dt
     gvi_curve_multipliers
                    the polynomial through the multipliers of the step at Lobatto's points, error
                    O(h^s); laid out as by gvi_multipliers, and at a tenth of its cost.  Not of
                    explicit steps, which keep none, or once a row has been switched:
                    GVI_E_FORMULATION
     gvi_state_at   the state at time t (a time, not tau), at the full order, by a partial step from
                    the nearer end; up to 2 ulp outside the step, t counts as its end
     gvi_action     the quadrature of L; like gvi_state_at with the effects that are on now   */
GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v);
#ifndef GVI_NO_CONSTRAINTS
GVI_DEF gvi_status gvi_curve_multipliers(gvi_stepper *st, gvi_real tau, gvi_real *lambda);
#endif
#ifndef GVI_NO_OUTPUT
GVI_DEF gvi_status gvi_state_at(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p);
GVI_DEF gvi_status gvi_action(gvi_stepper *st, gvi_real *action);
#endif

/* L_d(q0, q1; t, h): boundary values given, rows k >= 1 of (1) solved by Newton's method.
   The curve is the one near the chord, followed from short h; or, with a guess, the one near the
   motion that the guess starts; gvi_start_momentum(st, t, q0, p0) starts it.  If `negative` is
   wanted without a guess, it is whatever Newton's method finds from the chord.  GVI_E_CONJUGATE
   where the ends do not determine the curve (oscillator: h omega = k pi; a half circle about the
   Sun, whose chord goes through it, or past another conjugate point), GVI_E_RESOLUTION where it is
   not as accurate as desc.resolution wants it.  Needs GVI_NEWTON, or
   GVI_AUTO with s n <= 1024 and no given iterations, if s > 1; not for kicks, a clock or
   constraints.  Forced systems: d1, d2 are total derivatives, and F-, F+ are
   h sum b_i f_i dQ_i/dq0, dQ_i/dq1 with the curve's own dependence on its ends, as the exact
   discrete forces are [1, sec. 3.2] (at fixed control points, as (dLdA3) of [2] is printed, they
   would act as another force); how they share p0 and p1 is as exact as the Hessians (sqrt(eps),
   where these are differences), p0 and p1 themselves are exact.  State untouched.             */
#ifndef GVI_NO_BOUNDARY
GVI_DEF gvi_status gvi_discrete_lagrangian(gvi_stepper *st, gvi_real t, gvi_real h,
                                           const gvi_real *q0, const gvi_real *q1,
                                           const gvi_discrete *out);
#endif

/* Restart from a checkpoint, a copy of a stepper and of its memory, in a stepper that gvi_init set
   up for the same description, in this process or another.  What follows is the same to the bit.
   GVI_E_ARGUMENT if sizes, the number of effects, what they read together, the kind of mass or the
   formulation differ.  Rules of equally many points are not compared: the saved one is used;
   callbacks, tolerance and limits are those of st.                                            */
#ifndef GVI_NO_RESTORE
GVI_DEF gvi_status gvi_restore(gvi_stepper *st, const gvi_stepper *saved, const gvi_real *memory);
#endif

/* These strings are not the caller's to free.
     gvi_why                what went wrong in the last call and what to do, "ok" if nothing did
     gvi_status_text        what gvi_why says, as far as a status alone can say it
     gvi_formulation_text   why st uses its formulation
     gvi_stepper_size       sizeof(gvi_stepper), for other languages                           */
GVI_DEF const char *gvi_why(const gvi_stepper *st);
GVI_DEF const char *gvi_status_text(gvi_status status);
GVI_DEF const char *gvi_formulation_text(const gvi_stepper *st);
GVI_DEF size_t      gvi_stepper_size(void);

/* Rules on [0,1]:  integral_0^1 f  =  sum_i b[i] f(c[i]).  c ascending, c and b of length n,
   c[i] + c[n-1-i] = 1, relative errors a few eps (tests/test_quadrature.c).
     gvi_gauss     n >= 1, exact to degree 2n - 1
     gvi_lobatto   n >= 2, c[0] = 0, c[n-1] = 1, exact to degree 2n - 3                        */
GVI_DEF gvi_status gvi_gauss(int n, gvi_real *c, gvi_real *b);
GVI_DEF gvi_status gvi_lobatto(int n, gvi_real *c, gvi_real *b);

/* The measured order of a rule: the largest u such that polynomials of degree < u are integrated
   exactly, to rounding.  0: the weights do not sum to 1.  -1: nodes outside [0,1], not distinct, or
   not finite.  Takes a quarter of a second at n = 250, like n^3, also in gvi_size and gvi_init
   with GVI_OWN.                                                                               */
GVI_DEF int        gvi_rule_order(int n, const gvi_real *c, const gvi_real *b);

/* These interpolate [6] through n distinct nodes x in any order, at any t: inside, outside, at and
   near a node.
     gvi_barycentric             the weights w, scaled so that max |w| = 1; GVI_E_NODES if two nodes
                                 coincide or the smallest weight leaves the range of gvi_real
     gvi_interpolate             sum_j f[j] l_j(t)
     gvi_interpolate_derivative  sum_j f[j] l_j'(t); exactly 0 for a constant
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

/* Rows are padded to a multiple of 8 from 5 points on, for vector registers.                  */
#define GVI__ROW(r) ((r) < 5 ? (r) : ((r) + 7)/8*8)
#define GVI__SIZE(a) ((size_t)(a))
#define GVI__SLACK (63/sizeof(gvi_real))

/* Length of an array, a constant expression, that suffices for every scene without constraints of
   n degrees of freedom, degree s, r points: what the core takes, and each chapter compiled.   */
#define GVI_LENGTH(n, s, r)                                                                     \
    GVI__LENGTH(GVI__SIZE(n), GVI__SIZE(s), GVI__SIZE(r), GVI__SIZE(GVI__ROW(r)))
#define GVI__LENGTH(n, s, r, R) (GVI__CORE_LENGTH(n, s, r, R) + GVI__RULES_LENGTH(s)            \
    + GVI__LAGRANGIAN_LENGTH(n, r, R) + GVI__MOMENTA_LENGTH(n, r, R) + GVI__CLOCK_LENGTH(n, R)  \
    + GVI__KICKS_LENGTH(r) + GVI__NEWTON_LENGTH(n, s, R) + GVI__DIAL_LENGTH(n, R)               \
    + ((r) > 4 ? GVI__SLACK : 0))

#ifdef GVI_ONLY_EXPLICIT
#define GVI__CORE_LENGTH(n, s, r, R) ((29 + 2*(n))*(n) + 5*(R) + (s))
#else
#define GVI__CORE_LENGTH(n, s, r, R)                                                            \
    ((32 + 10*(R) + 2*(n))*(n) + (15 + 3*(s) + 5*(r))*(R) + (s))
#endif
#ifdef GVI_NO_RULES
#define GVI__RULES_LENGTH(s) 0
#else
#define GVI__RULES_LENGTH(s) (((s) + 1)*(s) + 1)
#endif
#ifdef GVI_NO_LAGRANGIAN
#define GVI__LAGRANGIAN_LENGTH(n, r, R) 0
#else
#define GVI__LAGRANGIAN_LENGTH(n, r, R) ((5 + 3*(R) + (n))*(n) + 1)
#endif
#ifdef GVI_NO_MOMENTA
#define GVI__MOMENTA_LENGTH(n, r, R) 0
#else
#define GVI__MOMENTA_LENGTH(n, r, R) ((2 + (1 + (n))*(R))*(n) + (r)*(R))
#endif
#ifdef GVI_NO_CLOCK
#define GVI__CLOCK_LENGTH(n, R) 0
#else
#define GVI__CLOCK_LENGTH(n, R) ((5 + (n))*(R))
#endif
#ifdef GVI_NO_KICKS
#define GVI__KICKS_LENGTH(r) 0
#else
#define GVI__KICKS_LENGTH(r) ((r) + 1)
#endif
#ifdef GVI_NO_NEWTON
#define GVI__NEWTON_LENGTH(n, s, R) 0
#else
#define GVI__NEWTON_LENGTH(n, s, R) ((2 + 10*(s) + 5*(R) + (3 + 2*(s)*(s))*(n))*(n) + 2)
#endif
#ifdef GVI_NO_DIAL
#define GVI__DIAL_LENGTH(n, R) 0
#else
#define GVI__DIAL_LENGTH(n, R) (2*(n) + 6*(R))
#endif

/* GVI_LENGTH with constraints, m rows in all.                                 */
#define GVI_CONSTRAINED_LENGTH(n, s, r, m) (GVI_LENGTH(n, s, r)                  \
    + (GVI__SIZE(m)*(GVI__SIZE(n) + 2) + GVI__SIZE(r))*GVI__SIZE(GVI__ROW(r))     \
    + (6*GVI__SIZE(n) + 3*GVI__SIZE(m) + 2*GVI__SIZE(r) + 5*GVI__SIZE(s) + 4 + (4 + GVI__SIZE(m)) \
       *(GVI__SIZE(n) + GVI__SIZE(m)))*(GVI__SIZE(GVI__ROW(r)) + GVI__SIZE(GVI__ROW((s) + 1)))    \
    + (GVI__SIZE(s) + 3)*(GVI__SIZE(s) + 1) + (2*GVI__SIZE(n) + 16)*GVI__SIZE(m) \
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

/* ========================================================================== PART I: THE INTEGRATOR

   For constant mass and effects that read t, q and v.  What a scene uses beyond that are chapters
   of PART II, which plug in at PLACES: see PARTS.                                             */

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

/* --------------------------------------------------------------- NUMBERS */

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
#if GVI__KIND == 3 && LDBL_MANT_DIG == 106
#error "gvi.h: long double must be one IEEE number, not two doubles"
#endif

typedef char gvi__effects_fit_a_word[GVI_EFFECTS >= 1 && GVI_EFFECTS <= 32
                                     && GVI_EFFECTS <= 8*sizeof(unsigned) ? 1 : -1];

/* GVI__APART: where size counts, never a part of its caller, whose stack stays small.
   GVI__CALLED: never a part of its caller, whose registers are for scenes without it.
   GVI__COLD: set-up and queries, compiled for size.
   GVI__OFFERED: to other chapters, which may be left out.
   GVI__IS: is x the constant k, for which code of its own may be made?                           */
#if defined(__GNUC__)
#define GVI__COLD static __attribute__((noinline, cold))
#define GVI__CALLED static __attribute__((noinline))
#else
#define GVI__COLD static
#define GVI__CALLED static
#endif
#define GVI__OFFERED static inline          // no warning where nobody asks
#if defined(__GNUC__) && defined(__OPTIMIZE_SIZE__)
#define GVI__APART GVI__CALLED
#define GVI__SMALL 1
#else
#define GVI__APART static
#define GVI__SMALL 0
#endif
#define GVI__IS(x, k) (!GVI__SMALL && (x) == (k))

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
        for (int gvi__rest = GVI__LANES > 1 ? (n) % GVI__LANES : (n); gvi__rest > 0;            \
             --gvi__rest, ++gvi__at) {                                                          \
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
GVI__COPIED gvi__two gvi__two_prod(gvi_real a, gvi_real b)
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

GVI__COPIED gvi__two gvi__two_prod(gvi_real a, gvi_real b)
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
   `make tolerances` halves and doubles all of them, and counts the iterations of fixed runs and
   the tests that then fail.  But for GVI__LEAST, which has to be below 1, none changes the
   iterations by 1 %; what each does is in docs/design.md.                                     */

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
#define GVI__FAR ((gvi_real)0.25)          // of the motion, a change: the units are an overshoot's
#define GVI__LEAST ((gvi_real)0.9)         // of the least change so far: a new one
#define GVI__DEEP (GVI__DIG/2)             // falls by 2 bits, of changes or modes, to rounding
#define GVI__PATIENCE 3                    // changes that do not fall: diverges
#define GVI__NEARER 6                      // halvings, where a domain or Newton's residual wants it
#define GVI__NEVER 1000                    // of what ends by itself, but for broken callbacks
#define GVI__BY_NEWTON 64                  // steps until the fixed point is tried again

// predictor: how many last steps, ahead or back, an extrapolation is still better than nothing
#define GVI__AHEAD 8
#define GVI__BACK 2
#define GVI__DEGREE (GVI__DIG*2/7)         // its polynomials'; more would amplify rounding
#define GVI__SEEN ((gvi_real)0.015625)     // coupling of a polynomial that its nodes see

// Newton's method: contraction
#define GVI__CONTRACTS ((gvi_real)0.25)    // keeps its matrix; a curve is near
#define GVI__CLOSE ((gvi_real)0.03125)     // near a prediction, a line; so much of h is free motion
#define GVI__FADES (1 << GVI__DIG/6)       // a third of the digits: where a step failed, a row ends
#define GVI__LOST 4                        // of a pivot's entry what is left: rank may be changing
#define GVI__WRONG 512                     // of an entry of G, what it is off times this: wrong

// the dial, in rungs, four an octave
#define GVI__BAND 2                        // room at which h stays, and that growth leaves
#define GVI__GROWS 4                       // the most that it grows; it shrinks by up to twice that
#define GVI__MANY (4 + GVI__DIG/4)         // iterations from which on a longer step does not pay
#define GVI__WAIT 4                        // steps until a length that failed is tried again
#define GVI__SHORTER 16                    // below what the resolution allows: Newton's method
#define GVI__STEADY ((gvi_real)0.64)       // of a fall of modes, squared, that one pair alone shows
#define GVI__MARGIN 10                     // of what high modes tell: a tail may be flatter
#define GVI__AT_REST 4096                  // times slower than the fastest: judged with it
#define GVI__PULLED 256                    // roundings of g, of forces that cancel or constrain

/* ---------------------------------------------------------------- BLOCKS */

/* ---- linear algebra ---- */

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

/* ---- quadrature ---- */

/* Legendre polynomials by (k+1) P_(k+1) = (2k+1) x P_k - k P_(k-1), always at x = 1 - 2c for c in
   [0,1]: P_k and P_(k-1) become P_(k+1) and P_k.                                             */
static void gvi__legendre(int k, gvi_real x, gvi_real *P, gvi_real *before)
{
    const gvi_real was = *P;
    *P = ((gvi_real)(2*k + 1)*x*was - (gvi_real)k**before)/(gvi_real)(k + 1);
    *before = was;
}

// what a force at tau, times its weight, gives to the velocity's Legendre mode k > 0: P_(k-1)/2
GVI__OFFERED gvi_real gvi__mode_of_force(int k, gvi_real tau)
{
    gvi_real P = 1, before = 1;
    for (int p = 0; p < k - 1; ++p) gvi__legendre(p, 1 - 2*tau, &P, &before);
    return P/2;
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

// a correction in one word; three of these, and one or two in double words are left
GVI__COLD gvi_real gvi__node_nearer(int lobatto, int m, gvi_real c)
{
    gvi_real P = 1, d = 0;
    for (int k = 0; k < m; ++k) gvi__legendre(k, 1 - 2*c, &P, &d);
    d -= (1 - 2*c)*P;
    return lobatto ? c - d/(2*(gvi_real)(m + 1)*P) : c + 2*P*c*(1 - c)/((gvi_real)m*d);
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
            for (int k = 0; k < 3; ++k) start = gvi__node_nearer(lobatto, m, start);
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

/* ---- interpolation ---- */

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

/* ----------------------------------------------------------------- PARTS

   The chapters of PART II plug in at PLACES: functions gvi__place_..., which PART I calls, each
   declared in the section that calls it.  Where one chapter alone acts at a place, it defines the
   function; else the SWITCHBOARD at the end of the file does, and says in which order they act.
   Newton's method calls constraints by functions of its own, gvi__con_...  In a step the places
   stand behind gvi__parts(in), a bit for each chapter at work in this scene: a chapter that is not
   compiled leaves nothing, and one that is compiled but not used costs a test.                */

enum {
    GVI__IN_RULES = 1,                // Gamma is full
    GVI__IN_LAGRANGIAN = 2,           // an effect adds to dL/dv
    GVI__IN_MASS = 4,                 // the mass is not constant
    GVI__IN_MOMENTA = 8,              // formulation (5)
    GVI__IN_CLOCK = 16,
    GVI__IN_KICKS = 32,
    GVI__IN_NEWTON = 64,              // in place of the fixed point
    GVI__IN_CONSTRAINTS = 128,
    GVI__CHAPTERS = 0
#ifndef GVI_NO_RULES
    | GVI__IN_RULES
#endif
#ifndef GVI_NO_LAGRANGIAN
    | GVI__IN_LAGRANGIAN
#endif
#ifndef GVI_NO_MOMENTA
    | GVI__IN_MASS | GVI__IN_MOMENTA
#endif
#ifndef GVI_NO_CLOCK
    | GVI__IN_CLOCK
#endif
#ifndef GVI_NO_KICKS
    | GVI__IN_KICKS
#endif
#ifndef GVI_NO_NEWTON
    | GVI__IN_NEWTON
#endif
#ifndef GVI_NO_CONSTRAINTS
    | GVI__IN_CONSTRAINTS
#endif
};

// a constant 0 where GVI_ONLY_EXPLICIT leaves the iteration out
#ifdef GVI_ONLY_EXPLICIT
enum { GVI__ITERATION = 0 };
#else
enum { GVI__ITERATION = 1 };
#endif
static int gvi__iterates(const struct gvi__private *in) { return GVI__ITERATION && in->stages > 0; }

// a constant 0 where no chapter is compiled
GVI__BODY unsigned gvi__parts(const struct gvi__private *in) { return GVI__CHAPTERS & in->parts; }

// what an iteration and a step start from
typedef struct gvi__origin {
    gvi_real t, t_low;
    const gvi_real *q, *q_low, *p, *p_low;
} gvi__origin;

// what is solved: a step, or for a query a part of the last one, from its start or its end
enum { GVI__STEP, GVI__FROM_START, GVI__FROM_END };

#ifndef GVI_NO_EXPLAIN
// a step or its points that came to NaN or Inf, or failed; callbacks at a first start
static gvi_status gvi__explain_failure(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                       int query, gvi_status status);
static gvi_status gvi__explain_effects(gvi_stepper *st, gvi_points *at, unsigned skip,
                                       gvi_real *const *value);
static gvi_status gvi__probe(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v);
#define GVI__LOOKS(st) ((st)->in.explain.looks)
#define GVI__LOOK(st, on) ((st)->in.explain.looks = (on))
#else
#define gvi__explain_failure(st, from, h, query, status) (status)
#define gvi__explain_effects(st, at, skip, value) GVI_OK
#define gvi__probe(st, t, q, v) GVI_OK
#define GVI__LOOKS(st) 0
#define GVI__LOOK(st, on) ((void)0)
#endif

// a clock changes what others do, too
#ifndef GVI_NO_CLOCK
static int gvi__clock_is_on(const gvi_stepper *st);
static void gvi__clock_velocities(const gvi_stepper *st);
static gvi_real gvi__clock_rate(const gvi_stepper *st);
#else
#define gvi__clock_is_on(st) 0
#define gvi__clock_velocities(st) ((void)0)
#define gvi__clock_rate(st) ((void)(st), (gvi_real)1)
#endif

/* ----------------------------------------------------------------- SCENE */

/* PLACES of the mass: v from p, v a guess on entry; M_ii, for amplitudes; F and P of M(q).     */
static gvi_status gvi__place_velocity(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p, gvi_real *v);
static gvi_real gvi__place_inertia(const gvi_stepper *st, int i);
#ifndef GVI_NO_MOMENTA
static gvi_status gvi__place_kinetic(gvi_stepper *st, gvi_points *at);
#else
#define gvi__place_kinetic(st, at) GVI_OK
#endif

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
    st->fault.argument = st->in.why;
    st->in.why = NULL;
    if (failed == GVI__MISSING)
        st->fault.argument = "GVI_POINTS lists what this kind does not have, as v: is .kind set?";
    if (failed == GVI__OTHER_N)
        st->fault.argument = "GVI_POINTS or GVI_EACH is written for a larger n than the scene's";
    if (failed == GVI__UNLISTED)
        st->fault.argument = "GVI_POINTS or GVI_EACH fills an array that is not in its list, or "
                             "beyond its n";
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
static gvi_points gvi__points_at(gvi_stepper *st, int count, int R, const gvi_real *t,
                                 const gvi_real *q, gvi_real *f, gvi_real *dldv)
{
    const gvi_points at = { st->n, count, R,    t,    q,    NULL, NULL,        f,
                           dldv,  NULL,  NULL, NULL, NULL, NULL, NULL, &st->in.why };
    return at;
}

// one point, f and dldv in scratch
static gvi_points gvi__one_point(gvi_stepper *st, const gvi_real *t, const gvi_real *q)
{
    gvi_real *f = st->in.point + 4*st->n;
    return gvi__points_at(st, 1, 1, t, q, f, f + st->n);
}

// a column of values [n][R]
static void gvi__gather(int n, int R, const gvi_real *values, gvi_real *out)
{
    for (; n > 0; --n, values += R) *out++ = *values;
}

// the first entry of values [n][count] that is not finite is the fault
static gvi_status gvi__check_rows(gvi_stepper *st, const gvi_points *at, const gvi_real *values,
                                  int effect)
{
    if (!values) return GVI_OK;
    for (int i = 0; i < at->n; ++i) {
        const int k = gvi__first_non_finite(at->count, values + i*at->stride);
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
GVI__COPIED gvi_status gvi__effect(gvi_stepper *st, gvi_points *at, int e, gvi_real *value)
{
    const gvi_effect *effect = st->in.desc.effects + e;
    const gvi_real *v = at->v;
    gvi_real *dldv = at->dldv;
    const int both = value && effect->points && effect->value == effect->points;
    int failed;

    if (effect->kind == GVI_POTENTIAL) at->v = NULL;
    if (effect->kind != GVI_LAGRANGIAN) at->dldv = NULL;
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

/* Every effect that is on, but those with a bit in `skip` or that a chapter evaluates itself: adds
   to at->f and at->dldv, and its value to value[kind], if there is one.                       */
GVI__COPIED gvi_status gvi__each_effect(gvi_stepper *st, gvi_points *at, unsigned skip,
                                        gvi_real *const *value)
{
    const int count = st->in.desc.effect_count;
    skip |= st->in.off | st->in.separate;
    for (int e = 0; e < count; ++e) {
        if (skip >> e & 1u) continue;
        gvi_real *V = value ? value[st->in.desc.effects[e].kind] : NULL;
        const gvi_status status = gvi__effect(st, at, e, V);
        if (status != GVI_OK) return status;
    }
    return GVI_OK;
}

static gvi_status gvi__effects(gvi_stepper *st, gvi_points *at, unsigned skip,
                               gvi_real *const *value)
{
    if (GVI__LOOKS(st)) return gvi__explain_effects(st, at, skip, value);
    return gvi__each_effect(st, at, skip, value);
}

// where entry (i,j) of a symmetric matrix stands, of which only i >= j is there
static int gvi__lower(int n, int i, int j) { return i >= j ? i*n + j : j*n + i; }

/* at->dldv += M v.  Entry (i,j) is `width` numbers: one for each point, one for all, or, 0, only
   those of the diagonal are there.                                                            */
static void gvi__add_kinetic(const gvi_points *at, const gvi_real *m, int width)
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
    if (kinetic && in->desc.mass.kind > GVI_MASS_DENSE) status = gvi__place_kinetic(st, at);
    else if (kinetic)
        gvi__add_kinetic(at, in->mass.matrix, in->desc.mass.kind == GVI_MASS_DENSE);
    if (status == GVI_OK && kinetic && GVI__LOOKS(st))
        status = gvi__check_rows(st, at, at->dldv, GVI_FAULT_MASS);
    return status == GVI_OK ? gvi__effects(st, at, skip, NULL) : status;
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

// a velocity near the present one: that at the end of the last step, or of the start
static void gvi__velocity_guess(const gvi_stepper *st, gvi_real *v)
{
    const struct gvi__private *in = &st->in;
    if (in->has_velocity) gvi__gather(st->n, in->R, in->last.V + st->r - 1, v);
    else gvi__copy((size_t)st->n, in->start, v);
}

// v from p at one point; v holds a guess on entry
static gvi_status gvi__velocity(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p,
                                gvi_real *v)
{
    (void)t, (void)q;
    if (gvi__parts(&st->in)) return gvi__place_velocity(st, t, q, p, v);
    gvi__copy((size_t)st->n, p, v);
    gvi__over_mass(st, v, 1, 1);
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
        if (((st->in.off | st->in.separate) >> e & 1u) || kind == GVI_FORCE) continue;
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
    *energy = pv/2 + V;
    if (st->in.adds_p) *energy = (pv - T) - L + V;
    return GVI_OK;
}

/* ---------------------------------------------------------------- TABLES */

/* PLACES of the modes: what they need before the tables; y := Gamma^-1 y, 1 if Gamma is full.  */
#ifndef GVI_NO_RULES
static gvi_status gvi__place_modes(gvi_stepper *st);
static int gvi__place_gamma(const gvi_stepper *st, gvi_real *y);
#else
#define gvi__place_modes(st) GVI_OK
#define gvi__place_gamma(st, y) 0
#endif

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

// y := Gamma^-1 y
static void gvi__over_gamma(const gvi_stepper *st, gvi_real *y)
{
    if (gvi__parts(&st->in) && gvi__place_gamma(st, y)) return;
    for (int k = 0; k < st->s; ++k) y[k] *= st->in.table.inv_gamma[k];
}

// w := Gamma^-1 b(c_j) as double words, low words s further, for gvi__coupling
GVI__COLD void gvi__prepare_column(gvi_stepper *st, const gvi_real *b, const gvi_real *low, int j)
{
    const int s = st->s, R = st->in.R;
    gvi_real *w = st->in.set_up;
    gvi__zero((size_t)s, w + s);
    for (int k = 0; k < s; ++k) w[k] = b[k*R + j];
    if (gvi__parts(&st->in) && gvi__place_gamma(st, w)) return;
    for (int k = 0; k < s; ++k) {
        const gvi__two z = gvi__scale2(st->in.table.inv_gamma[k], gvi__two_of(w[k], low[k*R + j]));
        w[k] = z.hi;
        w[s + k] = z.lo;
    }
}

// sum_k a_k(c_i) w_k; a: phi or Phi.  Products do not wait for the sum
GVI__COLD gvi__two gvi__coupling(const gvi_stepper *st, const gvi_real *a, const gvi_real *low,
                                 int i)
{
    const gvi_real *w = st->in.set_up;
    gvi__two sum = gvi__two_of(0, 0);
    for (int k = 0, at = i; k < st->s; ++k, at += st->in.R) {
        const gvi__two z = gvi__mul2(gvi__two_of(a[at], low[at]), gvi__two_of(w[k], w[st->s + k]));
        sum = gvi__add_low(sum.hi, sum.lo, z.hi, z.lo);
    }
    return gvi__two_sum(sum.hi, sum.lo);
}

// S_ij and T_ij of the column that was prepared last, on their grids
GVI__COLD gvi_real gvi__S(const gvi_stepper *st, const gvi_real *Phi, const gvi_real *low, int i)
{
    return gvi__grid(gvi__coupling(st, Phi, low, i), GVI__EPS/2);
}

GVI__COLD gvi_real gvi__T(const gvi_stepper *st, int i)
{
    return gvi__grid(gvi__coupling(st, st->in.table.phi, st->in.table.phi_low, i), GVI__EPS);
}

/* S and T on grids of eps/2 and eps (|S| <= 1, |T| < 2): what they must fulfil for the step to
   be symplectic then holds exactly in the rounded numbers, S_ij = S_ji, and for Gauss with r =
   s T_ij + T_ji = 1.  Stored by columns, [j*R + i]: K = c_i - S_ij, U = 1 - T_ij.            */
GVI__COLD void gvi__make_tables(gvi_stepper *st)
{
    const struct gvi__tables *table = &st->in.table;
    const gvi_real *Phi_low = table->Phi_low;
    const int r = st->r, R = st->in.R, gauss = st->in.desc.rule.kind == GVI_GAUSS && r == st->s;

    for (int j = 0; j < r; ++j) {
        gvi__prepare_column(st, table->Phi, Phi_low, j);
        for (int i = 0; i <= j; ++i) {
            const gvi_real S = gvi__S(st, table->Phi, Phi_low, i);
            table->K[j*R + i] = table->c[i] - S;
            table->K[i*R + j] = table->c[j] - S;
        }
        if (!table->U) continue;
        for (int i = 0; i < (gauss ? j + 1 : r); ++i) {           // the others by T_ij + T_ji = 1
            gvi_real T = (gvi_real)0.5;
            if (!gauss || i != j) T = gvi__T(st, i);
            table->U[j*R + i] = 1 - T;
            if (gauss) table->U[i*R + j] = T;
        }
    }
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
   mirror image.                                                                               */
static void gvi__weights_for(gvi_stepper *st, gvi_real h)
{
    struct gvi__sized *sized = &st->in.sized;
    const gvi_real *b = st->in.table.b;
    const int r = st->r;
    int e, most = 0;

    if (!gvi__nonzero(sized->h - h)) return;
    sized->h = h;

    const gvi_real mantissa = GVI_FREXP(h, &e);
    gvi_real rest = mantissa;
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

    const gvi_real half = GVI_LDEXP(1, e - 1);     // 2^e may be too large
    for (int j = 0; j < r; ++j) sized->hb[j] = 2*sized->hb[j]*half;
}

/* The predictor: least squares through the stage values of the last step or the last two, by
   polynomials p_k that are orthonormal on the nodes x_j = c, and c - 1 for the step before
   (Forsythe 1957): E_ij = sum_k p_k(y_i) p_k(x_j) at the points y_i = alpha + beta c_i of the next.

   Degree: for one step r - 1, through all values; for two, what `make cost` found best.  It stops
   before rounding, amplified by about 5.8^degree at the end of the step, exceeds 1e-4 in double,
   and before a polynomial that only distinguishes points that nearly coincide, as 0 and 1 - 1 do
   in two steps of Lobatto's: its coupling is then small, elsewhere it is above 0.1.           */
static void gvi__fit(gvi_stepper *st, int r, const gvi_real *c, const gvi_real *to, gvi_real alpha,
                     gvi_real beta, int steps, gvi_real *E)
{
    struct gvi__private *in = &st->in;
    const int R = in->R, nodes = steps*R, all = nodes + R;
    int degree = r - 1;

    if (steps == 2) degree = r + r/2 - r/8;
    if (degree > GVI__DEGREE) degree = GVI__DEGREE;
    gvi_real *p = in->set_up, *before = p + 3*R, *at = before + 3*R, coupling = 0;
    const gvi_real norm = 1/GVI_SQRT((gvi_real)(steps*r));
    gvi__zero(6*(size_t)R, p);                     // and before, which is behind it
    for (int m = 0; m < R; ++m) {
        at[m] = c[m];
        at[R + m] = c[m] - 1;
        at[nodes + m] = alpha + beta*to[m];
        if (m < r) p[m] = p[R + m] = p[nodes + m] = norm;
    }

    gvi__zero((size_t)(steps*r*R), E);
    for (int k = 0; k <= degree; ++k) {
        for (int j = 0; j < r; ++j) {
            gvi_real *last = E + j*R, *older = E + (r + j)*R;
            gvi__add_scaled(R, p[j], p + nodes, last, last);
            if (steps == 2) gvi__add_scaled(R, p[R + j], p + nodes, older, older);
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

// barycentric weights of the nodes, for gvi__lagrange
GVI__COLD void gvi__set_predictor(const gvi_stepper *st)
{
    const gvi_real *c = st->in.table.c;
    for (int j = 0; j < st->r; ++j) {
        gvi_real product = 1;
        for (int m = 0; m < st->r; ++m)
            if (m != j) product *= c[j] - c[m];
        st->in.predictor.weights[j] = 1/product;
    }
}

/* gvi__fit for one step of degree r - 1: Lagrange's polynomials at y = alpha + beta c, as products
   of what stands before and behind, all points y in lanes.                                    */
static void gvi__lagrange(const gvi_stepper *st, gvi_real alpha, gvi_real beta, gvi_real *E)
{
    const int R = st->in.R, r = st->r;
    const gvi_real *c = st->in.table.c, *weights = st->in.predictor.weights;
    gvi_real *y = st->in.set_up, *behind = y + R;

    for (int k = 0; k < R; ++k) {
        y[k] = alpha + beta*c[k];
        behind[k] = E[k] = 1;
    }

    for (int j = 1; j < r; ++j) {
        const gvi_real *before = E + (j - 1)*R, at = c[j - 1];
        gvi_real *to = E + j*R;
        GVI__ALONG(R, GVI__TO(to) = GVI__AT(before)*(GVI__AT(y) - at))
    }

    for (int j = r - 1; j >= 0; --j) {
        const gvi_real at = c[j], weight = weights[j];
        gvi_real *to = E + j*R;
        GVI__ALONG(R,
            GVI__TO(to) = GVI__AT(to)*(GVI__AT(behind)*weight);
            GVI__TO(behind) = GVI__AT(behind)*(GVI__AT(y) - at))
    }
}

/* ---------------------------------------------------------------- SET-UP */

/* The caller's memory: a base, or NULL to count only, and the numbers handed out so far.     */
typedef struct gvi__arena { gvi_real *base; size_t used; } gvi__arena;

/* PLACES of set-up, in this order: an effect or a mass that PART I does not know, 1 if a chapter
   does, *wrong what is missing; a rule that is not Gauss's or Lobatto's; may formulation f solve
   the scene?  What the chosen one needs; memory; nodes, 1 if they are made; tables.           */
static int gvi__place_effect(struct gvi__private *in, int e, const char **wrong);
static int gvi__place_mass(struct gvi__private *in, const char **wrong);
static gvi_status gvi__place_rule(struct gvi__private *in, int *order, gvi_fault *fault);
static int gvi__place_covers(struct gvi__private *in, gvi_formulation f);
static gvi_status gvi__place_chosen(struct gvi__private *in, int order, gvi_fault *fault);
static void gvi__place_layout(struct gvi__private *in, gvi__arena *a);
static int gvi__place_nodes(gvi_stepper *st);
static gvi_status gvi__place_tables(gvi_stepper *st);

// in long: an int may have 16 bits
static int gvi__within(long x, long most) { return x >= 0 && x <= most; }

GVI__COLD const char *gvi__wrong_in_rule(const gvi_rule *rule)
{
    if (!gvi__within(rule->points, 4000)) return "rule.points is not 0 to 4000";
    if ((unsigned)rule->kind > GVI_KICKS) return "rule.kind is not in its enum";
    if (rule->kind < GVI_OWN) return rule->nodes ? "rule: this kind takes no nodes" : NULL;
    if (!rule->points || !rule->nodes || !rule->weights)
        return "rule: this kind needs points, nodes and weights";
    return NULL;
}

// what is wrong with a description's own members, or NULL
GVI__COLD const char *gvi__wrong_in_desc(const gvi_desc *d)
{
    if (!d) return "desc is NULL";
    if (!gvi__within(d->n, 0x7FFFF) || d->n < 1) return "n is not 1 to 524,287";
    if (!gvi__within(d->degree, 1024)) return "degree is not 0 to 1024";
    if (!gvi__within(d->effect_count, GVI_EFFECTS)) return "effect_count is not 0 to GVI_EFFECTS";
    if (d->effect_count && !d->effects) return "effect_count is given, effects is NULL";
    if (d->effects && !d->effect_count) return "effects is given, effect_count is 0";
    if (!gvi__within(d->max_iterations, 1000000)) return "max_iterations is not 0 to 1,000,000";
    if (!gvi__within(d->tries, 64)) return "tries is not 0 to 64";
    if (!gvi__within(d->iterations, 1000000)) return "iterations is not 0 to 1,000,000";
    if ((unsigned)d->formulation > GVI_NEWTON) return "formulation is not in its enum";
    if ((unsigned)d->mass.kind > GVI_MASS_NONE) return "mass.kind is not in its enum";
    if (!(d->tolerance >= 0 && d->tolerance < 1)) return "tolerance is not 0 to 1";
    if (!(d->resolution >= 0 && d->resolution < 1)) return "resolution is not 0 to 1";
    return gvi__wrong_in_rule(&d->rule);
}

// what is wrong with an effect that PART I knows, or NULL
GVI__COLD const char *gvi__wrong_in_effect(const gvi_effect *effect)
{
    if ((unsigned)effect->kind > GVI_NONHOLONOMIC) return "effect: kind is not in its enum";
    if (!effect->points && !effect->point) return "effect: points, or point, is missing";
    if (effect->points && effect->point) return "effect: points and point, one is too many";
    if (effect->kind < GVI_CONSTRAINT && effect->rows != 0)
        return "effect: rows is for constraints";
    return NULL;
}

// what is wrong with a constant mass, or NULL
GVI__COLD const char *gvi__wrong_in_mass(const gvi_mass *m)
{
    if (m->kind == GVI_MASS_UNIT && (m->matrix || m->points))
        return "mass: matrix or points is given, kind is GVI_MASS_UNIT";
    if ((m->kind == GVI_MASS_DIAGONAL || m->kind == GVI_MASS_DENSE) && !m->matrix)
        return "mass: matrix is missing";
    return NULL;
}

// do weights that are given sum to 1?  Their rounding must leave half of the sum's digits
GVI__COLD int gvi__sums_to_1(const gvi_rule *rule)
{
    const int r = rule->points;
    gvi_real sum = -1, error = 0;
    for (int j = 0; j < r; ++j) {
        sum += rule->weights[j];
        error += 4*(gvi_real)(r + 2)*GVI__EPS*GVI_ABS(rule->weights[j]);
    }
    return GVI_ABS(sum) <= error && error < GVI_SQRT(GVI__EPS);
}

/* Are all sizes in range, is everything there that the kinds need, and nothing that suggests a
   forgotten kind?  Fills in the defaults, and finds what the effects read.  `in` is all 0.    */
GVI__COLD gvi_status gvi__check(struct gvi__private *in, const gvi_desc *desc, gvi_fault *fault)
{
    const char *wrong = gvi__wrong_in_desc(desc);
    int unknown = 0;
    if (wrong) return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE, wrong);
    gvi_desc *d = &in->desc;
    *d = *desc;
    if (d->degree == 0) d->degree = d->rule.kind == GVI_KICKS ? 1 : 8;
    if (d->rule.points == 0) d->rule.points = d->degree + (d->rule.kind == GVI_LOBATTO);
    if (d->max_iterations == 0) d->max_iterations = 60;
    if (d->tries == 0) d->tries = 64;

    for (int e = 0; e < d->effect_count; ++e) {
        const gvi_kind kind = d->effects[e].kind;
        wrong = gvi__wrong_in_effect(d->effects + e);
        if (!wrong && kind > GVI_FORCE) unknown |= !gvi__place_effect(in, e, &wrong);
        if (wrong) return gvi__refuse(fault, e, GVI_FAULT_NONE, wrong);
        in->reads_v |= kind == GVI_FORCE || kind == GVI_LAGRANGIAN || kind == GVI_NONHOLONOMIC;
        in->adds_p |= kind == GVI_LAGRANGIAN;
    }

    wrong = gvi__wrong_in_mass(&d->mass);
    if (!wrong && (d->mass.kind > GVI_MASS_DENSE || d->mass.velocity))
        unknown |= !gvi__place_mass(in, &wrong);
    if (unknown) return GVI_E_FORMULATION;
    if (wrong) return gvi__refuse(fault, GVI_FAULT_MASS, GVI_FAULT_NONE, wrong);
    return GVI_OK;
}

// will the rule do?  r >= s points of Gauss or Lobatto are good enough
GVI__COLD gvi_status gvi__check_rule(struct gvi__private *in, int *order, gvi_fault *fault)
{
    const gvi_rule *rule = &in->desc.rule;
    const int s = in->desc.degree, r = rule->points, lobatto = rule->kind == GVI_LOBATTO;
    if (rule->kind > GVI_LOBATTO) return gvi__place_rule(in, order, fault);
    *order = 2*r - 2*lobatto;
    if (lobatto && r < 2 && s == 1)
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE,
                           "rule.points: Lobatto's rule has 2 or more");
    return r < s ? GVI_E_POINTS : GVI_OK;
}

// the first formulation that covers the scene, or the pinned one
GVI__COLD gvi_status gvi__choose(struct gvi__private *in, int order, gvi_fault *fault)
{
    const gvi_desc *d = &in->desc;
    const int pinned = d->formulation != GVI_AUTO;
    int f = pinned ? (int)d->formulation : GVI_AUTO + 1;
    while (!gvi__place_covers(in, (gvi_formulation)f))
        if (pinned || f++ == GVI_NEWTON) return GVI_E_FORMULATION;
    in->chosen = (gvi_formulation)f;
    in->stages = 1 + (f > GVI_POSITIONS);
    if (d->mass.kind >= GVI_MASS_DENSE && d->n > 0x7FFF)          // indices are int: n*n
        return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE,
                           "n is above 32,767, and matrices may be needed");
    return gvi__place_chosen(in, order, fault);
}

// constraints are there, on or off, and cannot be: the fault is the first of them
GVI__COLD void gvi__unsolved(const struct gvi__private *in, gvi_fault *fault)
{
    for (int e = in->desc.effect_count - 1; e >= 0; --e) {
        const gvi_fault found = { e, 0, GVI_FAULT_NONE, NULL };
        if (in->desc.effects[e].kind >= GVI_CONSTRAINT) *fault = found;
    }
}

GVI__COLD gvi_status gvi__resolve(struct gvi__private *in, const gvi_desc *desc, int *order,
                                  gvi_fault *fault)
{
    gvi_status status = gvi__check(in, desc, fault);
    if (status == GVI_OK) status = gvi__check_rule(in, order, fault);
    if (status == GVI_OK) status = gvi__choose(in, *order, fault);
    if (status == GVI_E_FORMULATION) gvi__unsolved(in, fault);
    return status;
}

// of the caller's memory, or if base is NULL counted only
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

/* The one layout: gvi_size counts with it, gvi_init hands out by it, and GVI_LENGTH is no less than
   its sum with everything wanted.  Stage values of two steps back make the predictor better up to
   nine points; with more of them, and in float, they would amplify rounding too much.  Rows first:
   they start on a whole lane.                                                                 */
GVI__COLD size_t gvi__layout(struct gvi__private *in, int order, gvi_real *base)
{
    const gvi_desc *d = &in->desc;
    const size_t n = (size_t)d->n, s = (size_t)d->degree, r = (size_t)d->rule.points,
                 R = (size_t)GVI__ROW(r);
    const size_t it = in->stages > 0, V = in->stages == 2, two = it && r < 10 && GVI__DIG > 24,
                 two_V = two && V, phi = it && (V || in->fallback || order <= 2*d->degree - 2),
                 dense = d->mass.kind == GVI_MASS_DENSE,
                 sums = dense && it && in->chosen <= GVI_VELOCITIES;
    const struct { gvi_real **to; size_t rows, width; } list[] = {
        { &in->work.F, it*n, R },     { &in->work.Q, it*n, R },     { &in->work.V, V*n, R },
        { &in->last.F, it*n, R },     { &in->last.V, V*n, R },
        { &in->older.F, two*n, R },   { &in->older.V, two_V*n, R },
        { &in->free.values, (it + V)*n, R }, { &in->mass.sums, sums*n, R },
        { &in->table.c, 1, R },       { &in->table.b, 1, R },
        { &in->sized.hb, 1, R },      { &in->t, 1, R },
        { &in->table.phi, phi*s, R }, { &in->table.phi_low, phi*s, R },
        { &in->table.Phi, it*s, R },
        { &in->table.K, it*r, R },    { &in->table.U, V*r, R },
        { &in->predictor.equal, (it + two)*r, R }, { &in->predictor.one, it*r, R },
        { &in->predictor.weights, it, R },
        { &in->set_up, 9*it, R },     { &in->weighted, it, R },
        { &in->table.inv_gamma, 1, s },
        { &in->state.q, 1, n },       { &in->state.p, 1, n },
        { &in->state.q_low, 1, n },   { &in->state.p_low, 1, n },
        { &in->step.q, 1, n },        { &in->step.p, 1, n },
        { &in->step.q_low, 1, n },    { &in->step.p_low, 1, n },
        { &in->began.q, 1, n },       { &in->began.p, 1, n },
        { &in->free.v, 1, n },        { &in->free.v_low, it, n },
        { &in->free.path, it, n },    { &in->free.path_low, it, n },
        { &in->zeros, 1, n },         { &in->start, 1, n },
        { &in->mass.inverse, 1, n },  { &in->mass.factor, dense*n, n },
        { &in->mass.matrix, dense ? n : 1, n },
        { &in->watch.scale, 2*it, n }, { &in->watch.change, 2*it, n },
        { &in->watch.before, 2*it, n },
        { &in->point, 6, n },         { &in->answer, 3, n }
    };
    gvi__arena memory = { base, 0 }, *a = &memory;
    for (size_t k = 0; k < sizeof list/sizeof *list; ++k)
        *list[k].to = gvi__take(a, list[k].rows, list[k].width);
    in->cleared = 0;
    gvi__place_layout(in, a);
    if (in->cleared == 0) in->cleared = memory.used;
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

static void gvi__blank(size_t size, void *at)
{
    unsigned char *bytes = (unsigned char *)at;
    for (size_t i = 0; i < size; ++i) bytes[i] = 0;
}

GVI_DEF size_t gvi_size(const gvi_desc *desc)
{
    struct gvi__private x;
    gvi_fault fault;
    int order;
    gvi__blank(sizeof x, &x);
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

/* The rule, the modes at its nodes as exactly as they can be had, then the tables.  1/Gamma_kk =
   2k + 1 while the rule is exact for phi_k^2; Lobatto with r = s gives s - 1 for the last.    */
GVI__COLD gvi_status gvi__set_rule(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    struct gvi__tables *table = &in->table;
    const int s = st->s, lobatto = in->desc.rule.kind == GVI_LOBATTO;
    gvi_real *c_low = in->t;
    gvi_status status = GVI_OK;

    table->Phi_low = in->predictor.one;            // not yet in use, as are the times
    if (!gvi__place_nodes(st) && GVI__ITERATION)
        gvi__rule(lobatto, st->r, table->c, c_low, table->b);
    if (gvi__iterates(in)) {
        gvi__modes_of(st, st->r, table->c, c_low, table->phi, table->phi_low, table->Phi,
                      table->Phi_low);
        for (int k = 0; k < s; ++k) table->inv_gamma[k] = (gvi_real)(2*k + 1);
        if (lobatto && st->r == s) table->inv_gamma[s - 1] = (gvi_real)(s - 1);
        status = gvi__place_modes(st);
        if (status == GVI_OK) gvi__make_tables(st);
        gvi__set_predictor(st);
    }

    if (status == GVI_OK) status = gvi__place_tables(st);
    if (table->Phi) gvi__copy((size_t)st->r, table->c, table->Phi);        // Phi_0 = c on its grid
    return status;
}

// where number stands: the alignment of a gvi_real
typedef struct gvi__aligned { char byte; gvi_real number; } gvi__aligned;
static gvi__kernel *gvi__kernel_for(const gvi_stepper *st);

GVI_DEF gvi_status gvi_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    if (!st) return GVI_E_ARGUMENT;
    struct gvi__private *in = &st->in;

    // to be read after a failure; eight where an int has 16 bits, and RAM is short
    static const gvi_real zeros[sizeof(int) > 2 ? 64 : 8] = { 0 };
    int order = 0;
    gvi__blank(sizeof *st, st);
    gvi__report_status(st, GVI_OK);
    st->q = st->p = st->q_low = st->p_low = zeros;
    gvi_status status = gvi__resolve(in, desc, &order, &st->fault);
    st->order = order;
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
    gvi__zero(in->cleared, memory);
    if (gvi__iterates(in)) in->kernel = gvi__kernel_for(st);
    status = gvi__set_mass(st, &desc->mass);
    if (status == GVI_OK) status = gvi__set_rule(st);
    if (status != GVI_OK) return st->status = status;
    in->memory = memory;                                      // from here on it can be used
    return GVI_OK;
}

/* ------------------------------------------------------------------ STEP

   A step of length h takes (q, p, t) to (q + dq, p + dp, t + dt), in double words.  In this order:

     1) stages        what an iteration computes, as data: Q by (3), and V by (4); free motion
     2) predict       F at the points, extrapolated from the last step; stage values of these
     3) new rows      of the stages, from F
     4) evaluate      F(Q, V), at all points in one call
     5) verdict       again from 4), until all rows converge
     6) increments    dp by (2), dq by (3) at tau = 1
     7) commit        the state moves on

   gvi__iterate is 1) to 5), gvi__fixed_point that from extrapolated values, then from plain ones,
   gvi__attempt 1) to 6) by the fixed point or another solver, and gvi_step all of it.         */

/* PLACES of the fixed point: 1) stages; 2) sources, and tables of the predictor; 3) before, between
   and behind the new rows, `between` adds a change; 4) F in place of the effects, and once it is
   the last F; 5) is there a change that the rows do not show?  Do rows roll?  The move of
   coordinate i that constraints add to the floor.                                             */
static void gvi__place_stages(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                              struct gvi__stage *stage);
static gvi_status gvi__place_predict(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                     int extrapolate);
static gvi_status gvi__place_evaluate(gvi_stepper *st, const gvi__origin *from, gvi_points *at);
static int gvi__place_moves(const gvi_stepper *st);
static int gvi__place_rolls(const gvi_stepper *st);
#ifndef GVI_NO_MOMENTA
static gvi_real gvi__place_between(gvi_stepper *st);
#else
#define gvi__place_between(st) (gvi__count(&(st)->counters.velocities, (st)->r), (gvi_real)0)
#endif
#ifndef GVI_NO_CONSTRAINTS
static void gvi__place_predictor(gvi_stepper *st, gvi_real alpha, gvi_real beta);
static void gvi__place_before_rows(gvi_stepper *st, const struct gvi__stage *stage);
static void gvi__place_behind_rows(gvi_stepper *st, const struct gvi__stage *stage, gvi_real sum);
static void gvi__place_last(gvi_stepper *st, const gvi__origin *from,
                            const struct gvi__stage *stage);
static gvi_real gvi__place_floor(const gvi_stepper *st, gvi_real h, int i, gvi_real m,
                                gvi_real eps, int moves);
#else
#define gvi__place_predictor(st, alpha, beta) ((void)(alpha))
#define gvi__place_before_rows(st, stage) ((void)0)
#define gvi__place_behind_rows(st, stage, sum) ((void)0)
#define gvi__place_last(st, from, stage) ((void)0)
#define gvi__place_floor(st, h, i, m, eps, moves) ((void)(moves), (gvi_real)0)
#endif

/* PLACES of the solvers: in place of the fixed point, 1 if *status is the result; where that has
   failed; as many of `count` steps as one makes in a row, 0 if none does.                     */
static int gvi__place_solve(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query,
                            gvi_status *status);
static gvi_status gvi__place_fallback(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                      int query, gvi_status status);
#ifndef GVI_NO_KICKS
static int gvi__place_steps(gvi_stepper *st, gvi_real h, int count);
#else
#define gvi__place_steps(st, h, count) 0
#endif

/* PLACES of a step's end: 6) increments, 1 if dq is made; sum_j (1 - c_j) h b_j F_j and what else
   bends coordinate i; the end of a step or partial step, by any solver; once more?  7) Is the step
   accepted?  Commit; values of steps; it failed.                                              */
static int gvi__place_increments(gvi_stepper *st, const gvi__origin *from);
static gvi_status gvi__place_accept(gvi_stepper *st);
static void gvi__place_commit(gvi_stepper *st, gvi_real h);
static void gvi__place_failed(gvi_stepper *st);
#ifndef GVI_NO_LAGRANGIAN
static void gvi__place_rotate(gvi_stepper *st);
#else
#define gvi__place_rotate(st) ((void)0)
#endif
#ifndef GVI_NO_CONSTRAINTS
static gvi_real gvi__place_bow(const gvi_stepper *st, int i);
static gvi_status gvi__place_finish(gvi_stepper *st, const gvi__origin *from);
static int gvi__place_again(gvi_stepper *st);
#else
#define gvi__place_bow(st, i) 0
#define gvi__place_finish(st, from) GVI_OK
#define gvi__place_again(st) 0
#endif

/* ---- 1) stages ---- */

/* One stage of an iteration is data: rows of stage values, made of sums over sources,

     row_i := base_i + (free_i + factor (z_i/m_i))
     z_i    = sum_j table_j (h b_j source_ij) + plus_i

   with free motion, the same in all iterations, in rows of its own.  factor and 1/m multiply one by
   one: h/m, rounded once, would belong to another mass than v = p/m, and energy would drift.

   Changes of rows are measured in squares, times scale_i: all of them are added up and returned,
   and change_i := those of row i at the last point and the middle.  One point would not do: where
   eigenvalues are complex, changes rotate and may be 0 at one, not at both.                   */
enum { GVI__OF_Q, GVI__OF_V, GVI__OF_P };

typedef struct gvi__stage {
    const gvi_real *table, *source;    /* [r][R]; [n][R]                                       */
    const gvi_real *base, *free;       /* [n]; [n][R]                                          */
    const gvi_real *inverse;           /* [n] 1/m                                              */
    gvi_real        factor, *values;
    gvi_real       *scale, *change;    /* [n]                                                  */
    const gvi_real *plus;              /* [n][R] what chapters add to z, or NULL               */
    int             of, quiet;         /* GVI__OF_...; not judged                              */
} gvi__stage;

/* GVI__FOR_ROW(R, body): GVI__ALONG for a row, unrolled where it is the most frequent one.    */
#define GVI__FOR_ROW(R, ...)                                                                    \
    if (GVI__IS(R, 8)) GVI__ALONG_BY(GVI__UNROLL, 8, __VA_ARGS__) else GVI__ALONG(R, __VA_ARGS__)

// row := low + (c path_low + c path), one coordinate's free motion over its base
GVI__BODY void gvi__free_row(int R, gvi_real low, gvi_real path, gvi_real path_low,
                             const gvi_real *GVI__RESTRICT c, gvi_real *GVI__RESTRICT row)
{
    GVI__FOR_ROW(R, GVI__TO(row) = (low + GVI__AT(c)*path_low) + GVI__AT(c)*path)
}

// free motion v = M^-1 p and h v in double words, M constant, and its values
static void gvi__free_motion(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const gvi_real *GVI__RESTRICT p = from->p, *GVI__RESTRICT p_low = from->p_low;
    const gvi_real *GVI__RESTRICT inverse = in->mass.inverse;
    gvi_real *GVI__RESTRICT v = in->free.v, *GVI__RESTRICT v_low = in->free.v_low;
    const int diagonal = in->desc.mass.kind == GVI_MASS_DIAGONAL;

    for (int i = 0; i < st->n; ++i) {
        const gvi__two z = diagonal ? gvi__two_prod(p[i], inverse[i]) : gvi__two_of(p[i], 0);
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

    const int R = in->R;
    gvi_real *values = in->free.values;
    for (int i = 0; i < st->n; ++i, values += R)
        gvi__free_row(R, from->q_low[i], in->free.path[i], in->free.path_low[i], in->table.c,
                      values);
    for (int i = 0; in->stages == 2 && i < st->n; ++i, values += R)
        gvi__free_row(R, v_low[i], 0, 0, in->table.c, values);
}

// out := t + (t_low + c h)
static void gvi__times(int R, gvi_real t, gvi_real t_low, gvi_real h, const gvi_real *c,
                       gvi_real *out)
{
    GVI__FOR_ROW(R, GVI__TO(out) = t + (t_low + GVI__AT(c)*h))
}

static void gvi__stages(gvi_stepper *st, const gvi__origin *from, gvi_real h, gvi__stage *stage)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, two = in->stages == 2;
    gvi_real *free = in->free.values;
    const gvi_real *inverse = in->mass.inverse;
    const gvi__stage Q = { in->table.K, in->work.F, from->q, free, inverse, h, in->work.Q,
                           in->watch.scale, in->watch.change, NULL, GVI__OF_Q, 0 };
    const gvi__stage V = { in->table.U, in->work.F, in->free.v, free + n*R, inverse, 1, in->work.V,
                           in->watch.scale + n, in->watch.change + n, NULL, GVI__OF_V, 0 };
    stage[0] = Q;
    if (two) stage[1] = V;
    gvi__free_motion(st, from, h);
    if (gvi__parts(in)) gvi__place_stages(st, from, h, stage);
}

/* ---- 3) new rows ---- */

// 1/(|base| and the last point's displacements, before and after); 0 where these have no sure digit
GVI__BODY gvi_real gvi__scale_of(gvi_real base, gvi_real was, gvi_real is)
{
    const gvi_real size = GVI_ABS(base) + GVI_ABS(was - base) + GVI_ABS(is - base);
    return size > GVI__NOTHING ? 1/size : 0;
}

// the squares at eight points, in the order that lanes add them up
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

// L := w source
GVI__BODY void gvi__weigh(int R, const gvi_real *GVI__RESTRICT w,
                          const gvi_real *GVI__RESTRICT source, gvi_real *GVI__RESTRICT L)
{
    GVI__ALONG_BY(GVI__UNROLL, R, GVI__TO(L) = GVI__AT(w)*GVI__AT(source))
}

// sum_j table_j (h b_j source_ij) + plus_i, to z
static void gvi__sum_row(const gvi_stepper *st, const gvi__stage *y, int i, gvi_real *z)
{
    const int R = st->in.R;
    gvi__weigh(R, st->in.sized.hb, y->source + i*R, st->in.weighted);
    for (int k = 0; k < R; ++k) z[k] = gvi__point_sum(st->r, R, y->table + k, st->in.weighted);
    for (int k = 0; GVI__CHAPTERS != 0 && y->plus && k < R; ++k) z[k] += y->plus[i*R + k];
}

// point by point; where M is full, all sums first, then M^-1 of them
static gvi_real gvi__rows_by_points(const gvi_stepper *st, const gvi__stage *y, int rescale)
{
    const int n = st->n, R = st->in.R, last = st->r - 1, middle = last/2;
    gvi_real *sums = st->in.mass.sums, square[8] = { 0, 0, 0, 0, 0, 0, 0, 0 };
    for (int i = 0; sums && i < n; ++i) gvi__sum_row(st, y, i, sums + i*R);
    if (sums) gvi__over_mass(st, sums, R, R);
    for (int i = 0; i < n; ++i) {
        const gvi_real base = y->base[i], inverse = y->inverse[i], factor = y->factor;
        gvi_real *row = y->values + i*R, *z = sums ? sums + i*R : st->in.set_up;
        const gvi_real *free = y->free + i*R;
        if (!sums) gvi__sum_row(st, y, i, z);
        GVI__ALONG(R, GVI__TO(z) = base + (GVI__AT(free) + GVI__AT(z)*inverse*factor))
        if (rescale) y->scale[i] = gvi__scale_of(base, row[last], z[last]);
        const gvi_real scale = y->scale[i];
        gvi_real two = 0;
        for (int k = R - 1; k >= 0; --k) {
            const gvi_real moved = (z[k] - row[k])*scale, part = moved*moved;
            square[k & 7] += part;
            if (k == last) two += part;
            if (k == middle) two += part;
            row[k] = z[k];
        }
        y->change[i] = two;
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

// in lanes of points, R being 4 or a multiple of 8
GVI__BODY gvi_real gvi__rows_by_lanes(const gvi_stepper *st, const gvi__stage *GVI__RESTRICT y,
                                      int n, int r, int R, int rescale)
{
    const int block = R < 8 ? R : 8, lanes = block/GVI__LANES, last = r - 1, middle = (r - 1)/2;
    const gvi__lane none = { 0 };
    gvi_real few[16], *L = R <= 16 ? few : st->in.weighted, total[8];
    gvi__lane square[GVI__BLOCK] = { none };

    GVI__LOOP(GCC unroll 2) for (int i = 0; i < n; ++i) {
        gvi_real *row = y->values + i*R, scale = y->scale[i];
        const gvi_real base = y->base[i], inverse = y->inverse[i], factor = y->factor;
        const gvi_real was = row[last], half = row[middle];
        gvi__weigh(R, st->in.sized.hb, y->source + i*R, L);
        for (int o = R - block; o >= 0; o -= block) {
            const gvi_real *free = y->free + i*R + o;
            gvi__lane z[GVI__BLOCK] = { none };
            gvi__row_sums(r, R, lanes, y->table + o, L, z);
            if (GVI__CHAPTERS != 0 && y->plus)
                GVI__UNROLL for (int v = 0; v < lanes; ++v)
                    z[v] += GVI__LOAD(y->plus + i*R + o + v*GVI__LANES);
            GVI__UNROLL for (int v = 0; v < lanes; ++v)
                z[v] = base + (GVI__LOAD(free + v*GVI__LANES) + z[v]*inverse*factor);
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
        const gvi_real a = (row[last] - was)*scale, b = (row[middle] - half)*scale;
        y->scale[i] = scale;
        y->change[i] = a*a + b*b;
    }

    GVI__UNROLL for (int v = 0; v < GVI__BLOCK; ++v) GVI__STORE(total + v*GVI__LANES) = square[v];
    return gvi__sum_squares(total);
}

// the sizes that deserve a copy of their own
#define GVI__KERNEL(name, n, r, R)                                                              \
    static gvi_real name(const gvi_stepper *st, const gvi__stage *GVI__RESTRICT y, int rescale) \
    {                                                                                           \
        return gvi__rows_by_lanes(st, y, n, r, R, rescale);                                     \
    }
#if GVI__LANES > 1
#if GVI__LANES < 8
GVI__KERNEL(gvi__rows_4,     st->n, 4, 4)
#else
#define gvi__rows_4 gvi__rows_by_points
#endif
GVI__KERNEL(gvi__rows_6,     st->n, 6, 8)
GVI__KERNEL(gvi__rows_2_8,   2, 8, 8)
GVI__KERNEL(gvi__rows_8,     st->n, 8, 8)
GVI__KERNEL(gvi__rows_to_8,  st->n, st->r, 8)
GVI__KERNEL(gvi__rows_12,    st->n, 12, 16)
GVI__KERNEL(gvi__rows_16,    st->n, 16, 16)
GVI__KERNEL(gvi__rows_to_16, st->n, st->r, 16)
GVI__KERNEL(gvi__rows_many,  st->n, st->r, st->in.R)
#endif

static gvi__kernel *gvi__kernel_for(const gvi_stepper *st)
{
    if (st->in.mass.sums) return gvi__rows_by_points;
#if GVI__LANES > 1
    if (st->r == 4) return gvi__rows_4;
    if (st->r == 8) return st->n == 2 ? gvi__rows_2_8 : gvi__rows_8;
    if (st->r == 6) return gvi__rows_6;
    if (st->r == 12) return gvi__rows_12;
    if (st->r == 16) return gvi__rows_16;
    if (st->r > 4)
        return st->r < 8 ? gvi__rows_to_8 : st->r < 16 ? gvi__rows_to_16 : gvi__rows_many;
#endif
    return gvi__rows_by_points;
}

// all stages; returns the squares of their changes
GVI__BODY gvi_real gvi__new_rows(gvi_stepper *st, const gvi__stage *stage, int rescale)
{
    gvi__kernel *kernel = st->in.kernel;
    const int parts = gvi__parts(&st->in) != 0;
    if (parts) gvi__place_before_rows(st, stage);
    gvi_real sum = kernel(st, stage, rescale && !stage[0].quiet);
    if (st->in.stages == 2) {
        if (parts) sum += gvi__place_between(st);
        else gvi__count(&st->counters.velocities, st->r);
        sum += kernel(st, stage + 1, rescale && !stage[1].quiet);
    }
    if (parts) gvi__place_behind_rows(st, stage, sum);
    return sum;
}

/* ---- 2) predict ---- */

/* The stage values of the last step go to the nodes of this step, at alpha + beta c in the last
   step's tau; where steps are as long as the last, by a table that never changes, from two steps
   where two are kept.  Where forces only serve to make positions, that table has K and b in it,
   and makes both at once.  `plain`: by one step's values as they are, whatever its length.    */
static void gvi__prepare_predictor(gvi_stepper *st, gvi_real h, int query, int plain)
{
    struct gvi__private *in = &st->in;
    struct gvi__predictor *predictor = &in->predictor;
    const int r = st->r, R = in->R, steps = in->older.F ? 2 : 1;
    const int equal = !query && !plain && in->kept >= steps && !gvi__nonzero(h - st->h);
    const int sums = equal && in->stages == 1 && in->desc.mass.kind != GVI_MASS_DENSE
                     && !gvi__parts(in);
    const gvi_real alpha = query != GVI__FROM_START, beta = h/st->h, ratio = query ? 0 : beta;

    if (gvi__parts(in)) gvi__place_predictor(st, alpha, beta);
    predictor->steps = equal ? steps : 0;
    predictor->sums = sums;
    if (!equal) {
        if (!query && !gvi__nonzero(ratio - predictor->ratio)) return;
        predictor->ratio = ratio;                  // a query has another start
        if (r - 1 <= GVI__DEGREE) gvi__lagrange(st, alpha, beta, predictor->one);
        else gvi__fit(st, r, in->table.c, in->table.c, alpha, beta, 1, predictor->one);
        return;
    }

    if (predictor->made == 1 + sums) return;
    predictor->made = 1 + sums;
    gvi__fit(st, r, in->table.c, in->table.c, 1, 1, steps, predictor->equal);
    for (int m = 0; m < sums*steps*r; ++m) {
        gvi_real *E = predictor->equal + m*R, *row = in->set_up;
        gvi__weigh(R, in->table.b, E, in->weighted);
        for (int k = 0; k < r; ++k) row[k] = gvi__point_sum(r, R, in->table.K + k, in->weighted);
        gvi__copy((size_t)r, row, E);
    }
}

// z := sum_j table_j source_j, or added to what is there, row by row
GVI__BODY void gvi__sums_at(int n, int r, int R, const gvi_real *table, const gvi_real *source,
                            gvi_real *values, int add)
{
    const int block = R < 8 ? R : 8, lanes = block/GVI__LANES;
    const gvi__lane none = { 0 };
    for (int i = 0; i < n; ++i, source += R, values += R)
        for (int o = 0; o < R; o += block) {
            gvi__lane z[GVI__BLOCK] = { none };
            gvi__row_sums(r, R, lanes, table + o, source, z);
            GVI__UNROLL for (int v = 0; v < lanes; ++v) {
                gvi_real *at = values + o + v*GVI__LANES;
                if (add) z[v] += GVI__LOAD(at);
                GVI__STORE(at) = z[v];
            }
        }
}

static void gvi__sums(const gvi_stepper *st, const gvi_real *table, const gvi_real *source,
                      gvi_real *values, int add)
{
    const int n = st->n, r = st->r, R = st->in.R;
    if (GVI__LANES > 1 && r == 8) gvi__sums_at(n, 8, 8, table, source, values, add);
    else if (GVI__LANES > 1 && r > 4 && R == 8) gvi__sums_at(n, r, 8, table, source, values, add);
    else if (GVI__LANES > 1 && R == 16) gvi__sums_at(n, r, 16, table, source, values, add);
    else if (GVI__LANES > 1 && r > 4) gvi__sums_at(n, r, R, table, source, values, add);
    else for (int i = 0; i < n; ++i, source += R, values += R)
        for (int k = 0; k < R; ++k) {
            const gvi_real z = gvi__point_sum(r, R, table + k, source);
            values[k] = add ? values[k] + z : z;
        }
}

// stage values by the predictor
static void gvi__extrapolate(const gvi_stepper *st, const gvi_real *last, const gvi_real *older,
                             gvi_real *values)
{
    const struct gvi__predictor *predictor = &st->in.predictor;
    const gvi_real *E = predictor->steps ? predictor->equal : predictor->one;
    gvi__sums(st, E, last, values, 0);
    if (predictor->steps == 2) gvi__sums(st, E + st->r*st->in.R, older, values, 1);
}

// stage values to begin with: of extrapolated sources, or of no force
static gvi_status gvi__predict(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                               const gvi__stage *stage, int extrapolate)
{
    struct gvi__private *in = &st->in;
    const int R = in->R;
    if (extrapolate && in->predictor.sums) {
        const gvi__stage *y = stage;
        gvi__extrapolate(st, in->last.F, in->older.F, y->values);
        for (int i = 0; i < st->n; ++i) {
            const gvi_real *free = y->free + i*R, base = y->base[i], inverse = y->inverse[i],
                           factor = h*y->factor;
            gvi_real *row = y->values + i*R;
            GVI__FOR_ROW(R, GVI__TO(row) = base + (GVI__AT(free) + GVI__AT(row)*inverse*factor))
        }
        return GVI_OK;
    }

    if (extrapolate) gvi__extrapolate(st, in->last.F, in->older.F, in->work.F);
    else gvi__zero((size_t)st->n*(size_t)R, in->work.F);
    if (gvi__parts(in)) {
        const gvi_status status = gvi__place_predict(st, from, h, extrapolate);
        if (status != GVI_OK) return status;
    }

    gvi__new_rows(st, stage, 0);
    return GVI_OK;
}

/* ---- 4) evaluate ---- */

// x := zero, a 0 that the compiler does not know: it would call memset, and wait for it, every time
static void gvi__clear(int n, int R, gvi_real zero, gvi_real *x)
{
    for (int i = 0; i < n; ++i, x += R)
        GVI__FOR_ROW(R, const gvi__number none = { 0 }; GVI__TO(x) = none + zero)
}

static gvi_status gvi__evaluate_stages(gvi_stepper *st, const gvi__origin *from, gvi_points *at)
{
    gvi__clear(st->n, st->in.R, st->in.zeros[0], at->f);
    if (gvi__parts(&st->in)) return gvi__place_evaluate(st, from, at);
    if (GVI__LOOKS(st)) return gvi__effects(st, at, 0, NULL);
    return gvi__each_effect(st, at, 0, NULL);
}

/* ---- 5) verdict ---- */

enum { GVI__GO_ON, GVI__DONE, GVI__ONCE_MORE, GVI__DIVERGES, GVI__NOT_FINITE };

/* Where an iteration stands, in squares: the changes of all rows in the last two iterations; the
   contraction of the last step, 1 if there is none, or 2 if no ratio counts; the least change so
   far.  The excess over the floor when it was last made; how many changes in a row were no new
   least; how many were poor, and the excess with them; are units to be made anew?             */
typedef struct gvi__progress {
    gvi_real before, earlier, ratio, least, excess;
    int      used, idle, poor, rescale;
} gvi__progress;

// the largest of row i and its base
static gvi_real gvi__size_of_row(const gvi_stepper *st, const gvi__stage *stage, int i)
{
    gvi_real size = GVI_ABS(stage->base[i]);
    for (int j = 0; j < st->r; ++j)
        size = gvi__larger(GVI_ABS(stage->values[i*st->in.R + j]), size);
    return size;
}

// what makes an amplitude of row i: |Q_i| sqrt(M_ii), with h V_i or h P_i/M_ii in place of Q_i
static gvi_real gvi__amplitude_of(const gvi_stepper *st, gvi_real h, const gvi__stage *stage,
                                  gvi_real m)
{
    gvi_real unit = GVI_SQRT(m);
    if (stage->of != GVI__OF_Q) unit *= GVI_ABS(h);
    if (stage->of == GVI__OF_P) unit *= gvi__clock_rate(st)/m;
    return unit;
}

/* THE FLOOR: what rounding alone changes of a row from one iteration to the next, and how far the
   changes exceed it, the largest of all rows.  A row's own floor is 4 eps of its largest value.
   With `all` it is 32 eps of the largest amplitude: where the iteration contracts, h^2 dF/dQ
   between amplitudes is below 1, so the rounding of one coordinate makes no more of another: a
   light body midway between two heavy ones.  To both comes what constraints add: to Q the rounding
   of g as well, to V and P only where iterations are given, since an iteration that went on for
   less would leave its last change there.                                                     */
GVI__CALLED gvi_real gvi__excess(const gvi_stepper *st, gvi_real h, const gvi__stage *stage,
                                 int all)
{
    const int parts = gvi__parts(&st->in) != 0;
    const gvi_real eps = GVI__EPS*(all ? GVI__NOISE : GVI__PLACE);
    gvi_real largest = 0, excess = 0;

    for (const gvi__stage *y = stage; all && y < stage + st->in.stages; ++y)
        for (int i = 0; i < st->n && !y->quiet; ++i) {
            const gvi_real unit = gvi__amplitude_of(st, h, y, gvi__place_inertia(st, i));
            largest = gvi__larger(unit*gvi__size_of_row(st, y, i), largest);
        }

    for (const gvi__stage *y = stage; y < stage + st->in.stages; ++y)
        for (int i = 0; i < st->n && !y->quiet; ++i) {
            const int moves = all && (y->of == GVI__OF_Q || st->in.desc.iterations > 0);
            const gvi_real m = gvi__place_inertia(st, i), unit = gvi__amplitude_of(st, h, y, m),
                           size = all ? largest : unit*gvi__size_of_row(st, y, i),
                           added = parts ? gvi__place_floor(st, h, i, m, eps, moves) : 0;
            if (!(y->scale[i] > 0) || !(y->change[i] > 0)) continue;
            const gvi_real change = unit*(GVI_SQRT(y->change[i])/y->scale[i]);
            excess = gvi__larger(change/(eps*size + GVI_SQRT(m)*added), excess);
        }
    return excess;
}

/* Settled: the next change, D times the ratio of the last two, is within the tolerance: of all
   rows, and of each, so that none hides behind a larger one.  One ratio may be luck: the one
   before, or that of the last step, must agree; after an attempt that failed there is none, and D
   itself must be within the tolerance.  All in squares, so that nothing waits for a root.     */
static int gvi__settled(gvi_stepper *st, const gvi__progress *p, gvi_real D)
{
    const gvi_real wanted = gvi__larger(st->in.desc.tolerance, GVI__ENOUGH), limit = wanted*wanted,
                   place = GVI__EPS*GVI__EPS*(gvi_real)(16*st->n*st->r);
    const int alone = p->used == 1 || p->ratio > 1, rows = st->in.stages*st->n;
    const gvi_real last = alone ? D : gvi__smaller(p->before, 1);

    if (!(D*D <= limit*last)) return 0;           // NaN as well
    if (!alone && D > place) {
        const gvi_real other = p->earlier > 0 ? p->before/gvi__smaller(p->earlier, 1) : p->ratio;
        if (!(D*other <= limit)) return 0;
        st->in.watch.found = D/last;
    }

    for (int row = 0; row < rows; ++row) {
        const gvi_real Di = st->in.watch.change[row];
        const gvi_real was = alone ? Di : gvi__smaller(st->in.watch.before[row], 1);
        if (Di > 2*GVI__EPS*GVI__EPS && Di*Di > limit*was) return 0;
    }

    return 1;
}

// it falls by less than a bit
static int gvi__is_poor(const gvi__progress *p)
{
    return p->earlier > 0 && p->before >= p->earlier*(GVI__POOR*GVI__POOR);
}

// what later verdicts need of this change
static void gvi__note(gvi_stepper *st, gvi__progress *p, gvi_real D)
{
    const gvi_real worst = st->counters.worst_contraction, sure = GVI__SURE*GVI__EPS;
    if (p->earlier > 0 && D > sure*sure && D > worst*worst*worst*worst*p->earlier)
        st->counters.worst_contraction = GVI_SQRT(GVI_SQRT(D/p->earlier));

    p->earlier = p->before;
    p->before = D;
    p->idle = D < GVI__LEAST*GVI__LEAST*p->least ? 0 : p->idle + 1;
    p->least = gvi__smaller(p->least, D);

    // those were the units of an overshoot
    p->rescale = D > GVI__FAR*GVI__FAR || gvi__is_poor(p);
}

/* What falls goes on.  What makes no new least is rounding below the floor: below a row's own at
   once, below that of all rows after a while, which as a rule is above what a row can reach.
   What is above it and falls by less than a bit, time after time, does not converge.  Under rows
   that roll the rounding of P is in every D, and shows sooner.                                */
static int gvi__at_floor(gvi_stepper *st, gvi__progress *p, gvi_real h, const gvi__stage *stage)
{
    const int rolls = gvi__parts(&st->in) && gvi__place_rolls(st),
              long_since = p->idle > 4 - 3*rolls, poor = gvi__is_poor(p),
              still = p->idle > 1 - rolls && !(gvi__parts(&st->in) && gvi__place_moves(st)),
              slow = st->in.fallback && p->used - p->idle >= GVI__DEEP,
              end = slow ? GVI__DIVERGES : GVI__ONCE_MORE;

    if (still && gvi__excess(st, h, stage, 0) <= 1) return end;
    if (!poor) p->poor = 0;
    if (!poor && !long_since) return GVI__GO_ON;

    const gvi_real excess = gvi__excess(st, h, stage, 1);
    if (still && long_since && excess <= 1) return end;

    // a row that tends to 0 changes by its whole size: does its amplitude fall?  (make everyday)
    p->poor = excess > 1 && excess > p->excess/2 ? p->poor + poor : 0;
    p->excess = excess;
    return st->in.fallback && p->poor > GVI__PATIENCE ? GVI__DIVERGES : GVI__GO_ON;
}

static int gvi__verdict(gvi_stepper *st, gvi__progress *p, gvi_real D, gvi_real h,
                        const gvi__stage *stage)
{
    const gvi_desc *d = &st->in.desc;
    const int given = d->iterations > 0;

    if (!given && gvi__settled(st, p, D)) return GVI__DONE;
    if (!gvi__finite(D)) {                        // far off already, it was on its way to infinity
        const int far = p->poor > 0 || p->before > (gvi_real)st->n || GVI__LOOKS(st);
        return far ? GVI__DIVERGES : GVI__NOT_FINITE;
    }

    gvi__note(st, p, D);
    if (given) {
        const int first = !(p->earlier > 0), falls = D < p->earlier && !(D > GVI__FAR*GVI__FAR);
        if (p->used < d->iterations) return GVI__GO_ON;
        return first || falls || gvi__excess(st, h, stage, 1) <= 1 ? GVI__DONE : GVI__DIVERGES;
    }

    const int verdict = gvi__at_floor(st, p, h, stage);
    return verdict == GVI__GO_ON && p->used >= d->max_iterations ? GVI__DIVERGES : verdict;
}

/* The iteration.  It ends where
     - the next change is within the tolerance: done;
     - D does not fall, and all is below the floor: F once more, so that rows that go to and fro in
       their last places end with their own F, not that of the side they came from, which is a
       bias: done;
     - iterations are given and made: done if D falls, or is below the floor;
     - there is another solver, and neither D nor the excess falls, too often: no convergence;
     - max_iterations are made, or D is not finite: no convergence.                            */
GVI__APART gvi_status gvi__iterate(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                   int extrapolate, gvi__progress *p)
{
    struct gvi__private *in = &st->in;
    gvi__stage stage[2];
    gvi_points at = gvi__points_at(st, st->r, in->R, in->t, in->work.Q, in->work.F, NULL);

    at.v = in->work.V;
    gvi__stages(st, from, h, stage);                                                         // 1)
    gvi_status status = gvi__predict(st, from, h, stage, extrapolate);                       // 2)
    if (status != GVI_OK) return status;
    in->watch.found = gvi__smaller(p->ratio, 1);
    for (int shorter = 0, last = 0; ; ) {
        status = gvi__evaluate_stages(st, from, &at);                                        // 4)
        // free motion may leave a callback's domain though the motion does not: halve the way
        if (status == GVI_E_CALLBACK && p->used == 1 && !extrapolate && shorter++ < GVI__NEARER) {
            for (int i = 0; i < st->n; ++i)
                for (int k = 0; k < in->R; ++k)
                    in->work.Q[i*in->R + k] = (in->work.Q[i*in->R + k] + from->q[i])/2;
            continue;
        }
        if (last && status == GVI_OK && gvi__parts(in)) gvi__place_last(st, from, stage);
        if (last || status != GVI_OK) return status;
        const gvi_real change = gvi__new_rows(st, stage, p->rescale);                        // 3)
        const int verdict = gvi__verdict(st, p, change, h, stage);                           // 5)
        if (verdict == GVI__GO_ON) {
            gvi_real *spare = in->watch.before;
            in->watch.before = in->watch.change;
            in->watch.change = spare;
            for (int k = 0; k < in->stages; ++k) stage[k].change = spare + k*st->n;
            p->used += 1;
            continue;
        }
        if (verdict == GVI__NOT_FINITE) return gvi__report_status(st, GVI_E_NON_FINITE);
        if (verdict == GVI__DIVERGES) return gvi__report_status(st, GVI_E_CONVERGENCE);
        const gvi_real worst = st->counters.worst_change;
        if (change > worst*worst) st->counters.worst_change = GVI_SQRT(change);
        if (verdict == GVI__DONE) return GVI_OK;
        last = 1;
    }
}

/* ---- 6) increments ---- */

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
GVI__COPIED gvi__two gvi__exact_dot(int R, const gvi_real *a, const gvi_real *b)
{
    gvi_real hi[8], lo[8];
    for (int k = 0; k < 8; ++k) {
        const gvi__two z = k < R ? gvi__two_prod(a[k], b[k]) : gvi__two_of(0, 0);
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

// increments := sums of h b times values, their low words with those of the start
static void gvi__sum_rows(const gvi_stepper *st, gvi_real *values, const gvi_real *low,
                          gvi_real *sum, gvi_real *sum_low)
{
    const int R = st->in.R;
    for (int i = 0; i < st->n; ++i, values += R) {
        // a callback may have left anything there
        if (st->r < R) gvi__zero((size_t)(R - st->r), values + st->r);
        gvi__two z;
        if (GVI__IS(R, 8)) z = gvi__exact_dot(8, st->in.sized.hb, values);
        else if (GVI__IS(R, 4)) z = gvi__exact_dot(4, st->in.sized.hb, values);
        else if (GVI__IS(R, 16)) z = gvi__exact_dot(16, st->in.sized.hb, values);
        else z = gvi__exact_dot(R, st->in.sized.hb, values);
        sum[i] = z.hi;
        sum_low[i] = gvi__low(z.lo + low[i]);
    }
}

// sum_j (1 - c_j) h b_j F_j
GVI__BODY gvi_real gvi__bow(int R, const gvi_real *c, const gvi_real *hb, const gvi_real *F)
{
    gvi_real sum[4] = { 0, 0, 0, 0 };
    GVI__UNROLL for (int o = 0; o + 3 < R; o += 4)
        GVI__UNROLL for (int k = 0; k < 4; ++k) sum[k] += (1 - c[o + k])*(hb[o + k]*F[o + k]);
    for (int k = R & ~3; k < R; ++k) sum[k & 3] += (1 - c[k])*(hb[k]*F[k]);
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

/* Increments of q and p from the F at the end of the iteration, by (2) and by (3) at tau = 1,
   where S_j = c_j: dq = h (v + M^-1 sum_j (1 - c_j) h b_j F_j).                               */
static void gvi__increments(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const gvi_real *c = in->table.c, *hb = in->sized.hb, *F = in->work.F;
    const int R = in->R;

    gvi__sum_rows(st, in->work.F, from->p_low, in->step.p, in->step.p_low);
    if (gvi__parts(in) && gvi__place_increments(st, from)) return;
    for (int i = 0; i < st->n; ++i, F += R) {
        in->step.q[i] = gvi__parts(in) & GVI__IN_CONSTRAINTS && in->separate & ~in->off
                            ? gvi__place_bow(st, i)
                            : GVI__IS(R, 8) ? gvi__bow(8, c, hb, F) : gvi__bow(R, c, hb, F);
    }

    gvi__over_mass(st, in->step.q, 1, 1);
    for (int i = 0; i < st->n; ++i) {
        const gvi__two bend = gvi__two_prod(h, in->step.q[i]),
                       q = gvi__two_sum(in->free.path[i], bend.hi);
        in->step.q[i] = q.hi;
        in->step.q_low[i] = gvi__low((q.lo + bend.lo) + (in->free.path_low[i] + from->q_low[i]));
    }
}

// are q + dq and p + dp finite?  0 x is 0 or NaN
static int gvi__finite_end(const gvi_stepper *st, const gvi__origin *from)
{
    const struct gvi__phase *d = &st->in.step;
    const gvi_real *q = from->q, *p = from->p, *dq = d->q, *dp = d->p;
    gvi_real none[GVI__LANES] = { 0 }, all = 0;
    GVI__ALONG(st->n,
        // rounded, as the commit will store them
        const gvi__number x = GVI__AT(q) + GVI__AT(dq), y = GVI__AT(p) + GVI__AT(dp);
        *(gvi__number *)none += 0*x + 0*y)
    for (int k = 0; k < GVI__LANES; ++k) all += none[k];
    return all >= 0;
}

/* The fixed point, from extrapolated values, then from plain ones, to its increments.          */
static gvi_status gvi__fixed_point(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    struct gvi__private *in = &st->in;
    gvi_status status = GVI_E_CONVERGENCE;
    // an extrapolation any farther is no better than no force
    const int usable = in->kept > 0 && h/st->h > -GVI__BACK && h/st->h < GVI__AHEAD;
    gvi_real ratio = usable && GVI_ABS(h) <= GVI_ABS(st->h) ? in->watch.ratio : 1;

    if (usable) gvi__prepare_predictor(st, h, query, 0);
    for (int plain = !usable; plain < 2; ++plain) {
        gvi__progress p = { 0, 0, ratio, GVI__MAX, GVI__MAX, 1, 0, 0, 1 };
        status = gvi__iterate(st, from, h, !plain, &p);                               // 1) to 5)
        gvi__count(&st->counters.iterations, p.used);
        if (!query) st->iterations = p.used;
        if (p.used > st->counters.most_iterations) st->counters.most_iterations = p.used;
        // iterations given: only what failed in the first one is tried again
        if (status == GVI_OK
            || (in->desc.iterations > 0 && (p.used > 1 || status == GVI_E_CONVERGENCE))) break;
        ratio = 2;                                 // the next attempt: no ratio counts
    }

    if (status == GVI_OK) gvi__increments(st, from, h);                                      // 6)
    return status;
}

/* One attempt at a step or a partial step, to its increments; nothing of it is kept yet.  By the
   fixed point; by another solver in its place, or after it.                                   */
static gvi_status gvi__attempt(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    struct gvi__private *in = &st->in;
    gvi_status status = GVI_OK;
    in->dt = h;
    st->formulation = in->chosen;
    gvi__weights_for(st, h);
    const int solved = gvi__parts(in) && gvi__place_solve(st, from, h, query, &status);
    if (!solved && gvi__iterates(in)) {
        gvi__times(in->R, from->t, from->t_low, h, in->table.c, in->t);
        status = gvi__fixed_point(st, from, h, query);
        if (status != GVI_OK && in->fallback)
            status = gvi__place_fallback(st, from, h, query, status);
    }

    if (status == GVI_OK && gvi__parts(in)) status = gvi__place_finish(st, from);
    if (status != GVI_OK) return status;
    return gvi__finite_end(st, from) ? GVI_OK : gvi__report_status(st, GVI_E_NON_FINITE);
}

/* Attempts until one needs no other; where the last fails, why.                               */
static gvi_status gvi__solve(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    gvi_status status;
    do status = gvi__attempt(st, from, h, query);
    while (gvi__parts(&st->in) && gvi__place_again(st));
    return status == GVI_OK ? GVI_OK : gvi__explain_failure(st, from, h, query, status);
}

/* ---- 7) commit, and the step ---- */

// work becomes last, last becomes older if two steps are kept, and the oldest is the next work
static void gvi__rotate(gvi_real **older, gvi_real **last, gvi_real **work)
{
    gvi_real *spare = *last;
    if (*older) {
        spare = *older;
        *older = *last;
    }
    *last = *work;
    *work = spare;
}

static void gvi__rotate_values(gvi_stepper *st)
{
    struct gvi__values *older = &st->in.older, *last = &st->in.last, *work = &st->in.work;
    gvi__rotate(&older->F, &last->F, &work->F);
    gvi__rotate(&older->V, &last->V, &work->V);
    if (gvi__parts(&st->in)) gvi__place_rotate(st);
}

// was := x, x + x_low := x + dx + dx_low
static void gvi__move(int n, const gvi_real *GVI__RESTRICT dx, const gvi_real *GVI__RESTRICT dx_low,
                      gvi_real *GVI__RESTRICT x, gvi_real *GVI__RESTRICT x_low,
                      gvi_real *GVI__RESTRICT was)
{
    // gvi__two_sum, twice
    GVI__ALONG(n,
        const gvi__number a = GVI__AT(x), d = GVI__AT(dx), s = a + d, b = s - a;
        const gvi__number da = s - b, e = ((a - da) + (d - b)) + GVI__AT(dx_low);
        const gvi__number z = s + e, f = z - s, ds = z - f;
        GVI__TO(was) = a;
        GVI__TO(x) = z;
        GVI__TO(x_low) = (s - ds) + (e - f))
}

static void gvi__commit(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const gvi__two t = gvi__two_sum(st->t, in->dt + st->t_low);
    // p stands behind q
    gvi__move(2*st->n, in->step.q, in->step.q_low, in->state.q, in->state.q_low, in->began.q);
    st->t0 = st->t;
    st->t = t.hi;
    st->t_low = t.lo;
    in->kept = 1 + (in->kept > 0 && !gvi__nonzero(h - st->h));
    st->h = h;
    in->stepped = 1;
    in->has_velocity = in->stages == 2;
    in->watch.ratio = in->watch.found;
    gvi__rotate_values(st);
    if (gvi__parts(in)) gvi__place_commit(st, h);
    gvi__count(&st->counters.steps, 1);
}

GVI_DEF gvi_status gvi_step(gvi_stepper *st, gvi_real h)
{
    gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    in->failed.status = GVI_OK;
    if (!gvi__nonzero(h) || !gvi__finite(h))
        return gvi__refuse_call(st, "h is 0, NaN or infinite");
    if (gvi__parts(in) && gvi__place_steps(st, h, 1)) return GVI_OK;

    const gvi_formulation was = st->formulation;
    const gvi__origin from = { st->t, st->t_low, st->q, st->q_low, st->p, st->p_low };
    st->resolution = 0;
    status = gvi__solve(st, &from, h, GVI__STEP);                                     // 1) to 6)
    if (status == GVI_OK && !gvi__finite(st->t + in->dt))
        status = gvi__refuse_call(st, "t + h is not finite");
    if (status == GVI_OK) status = gvi__place_accept(st);
    if (status != GVI_OK) {
        in->failed.status = status;
        in->failed.fault = st->fault;
        gvi__count(&st->counters.failures, 1);
        gvi__place_failed(st);
        st->formulation = was;
        return st->status = status;
    }

    gvi__commit(st, h);                                                                      // 7)
    return gvi__report_status(st, GVI_OK);
}

GVI_DEF gvi_status gvi_steps(gvi_stepper *st, gvi_real h, int count)
{
    if (st && st->in.started && count == 0) return GVI_OK;       // st says what it said
    gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (count < 0) return gvi__refuse_call(st, "count is negative");
    const int known = gvi__parts(&st->in) && gvi__nonzero(h) && gvi__finite(h);
    while (status == GVI_OK && count > 0) {
        if (known) count -= gvi__place_steps(st, h, count);
        if (count > 0) status = gvi_step(st, h);
        count -= 1;
    }
    return status;
}

/* ----------------------------------------------------------------- STATE */

/* PLACES of a start: from q and p in in->step with velocity v, before they are taken; behind that;
   a switch of effects from `was`, which it restores if it fails.                              */
static gvi_status gvi__place_start(gvi_stepper *st, gvi_real t, gvi_real *v);
static void gvi__place_started(gvi_stepper *st);
static gvi_status gvi__place_switch(gvi_stepper *st, unsigned was);

/* PLACES of the last step's curve: 1 if it is made here; what else bends it; its v.            */
#ifndef GVI_NO_KICKS
static int gvi__place_line(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v);
#else
#define gvi__place_line(st, tau, q, v) 0
#endif
#ifndef GVI_NO_CONSTRAINTS
static void gvi__place_reactions(const gvi_stepper *st, gvi_real tau, const gvi_real *phi,
                                 const gvi_real *Phi, gvi_real *q, gvi_real *v);
#else
#define gvi__place_reactions(st, tau, phi, Phi, q, v) ((void)0)
#endif
#ifndef GVI_NO_CLOCK
static gvi_status gvi__place_curve(gvi_stepper *st, const gvi_real *q, gvi_real *v);
#else
#define gvi__place_curve(st, q, v) GVI_OK
#endif

// from q, p in in->step and a velocity v, all of them seen to be good
GVI__COLD gvi_status gvi__begin_at(gvi_stepper *st, gvi_real t, gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n;
    gvi_status status = GVI_OK;

    if (!in->started) status = gvi__probe(st, t, in->step.q, v);
    if (status == GVI_OK) status = gvi__place_start(st, t, v);
    if (status != GVI_OK) return status;

    gvi__copy(n, v, in->start);
    gvi__copy(n, in->step.q, in->state.q);
    gvi__copy(n, in->step.p, in->state.p);
    gvi__zero(n, in->state.q_low);
    gvi__zero(n, in->state.p_low);
    if (!in->started || gvi__nonzero(t - st->t)) st->t_low = 0;
    st->t = st->t0 = t;
    st->h = st->resolution = st->next = 0;
    in->started = 1;
    in->stepped = in->kept = in->has_velocity = 0;
    in->predictor.ratio = 0;
    in->watch.ratio = in->watch.found = 1;
    st->formulation = in->chosen;
    gvi__place_started(st);
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
    if (st->in.adds_p) skip = 0;
    at.v = v;
    return gvi__evaluate(st, &at, skip, 1);
}

GVI_DEF gvi_status gvi_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_status status = gvi__check_start(st, t, q, v);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    const size_t n = (size_t)st->n;

    GVI__LOOK(st, 1);
    status = gvi__momentum(st, t, q, v);
    GVI__LOOK(st, 0);
    if (status != GVI_OK) return status;
    gvi_real *start = in->answer + n;              // v may be st->q or st->p, which change first
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
    gvi_real *v = in->answer;
    gvi__copy(n, p, in->step.p);                   // p may be in->step.q
    gvi__copy(n, q, in->step.q);
    // a velocity to start the first iteration from; where there is none, the step says so
    gvi__zero(n, v);
    status = gvi__velocity(st, t, in->step.q, in->step.p, v);
    if (status == GVI_E_SINGULAR || status == GVI_E_CONVERGENCE) gvi__zero(n, v);
    else if (status != GVI_OK) return status;
    return gvi__begin_at(st, t, v);
}

GVI_DEF gvi_status gvi_switch(gvi_stepper *st, int index, int on)
{
    gvi_status status = gvi__ready(st, st && st->in.memory);
    if (status != GVI_OK) return status;
    struct gvi__private *in = &st->in;
    if (index < 0 || index >= in->desc.effect_count)
        return gvi__refuse_call(st, "there is no such effect");
    const unsigned bit = 1u << index, was = in->off;
    in->off = was | bit;
    if (on) in->off = was & ~bit;
    status = gvi__place_switch(st, was);
    if (status == GVI_OK) in->watch.ratio = 1;     // another scene may contract otherwise
    return gvi__done(st, status);
}

#ifndef GVI_NO_RESTORE
// pointers into the memory are those of st: the layout again, values rotated as they were saved
GVI_DEF gvi_status gvi_restore(gvi_stepper *st, const gvi_stepper *saved, const gvi_real *memory)
{
    const gvi_status ready = gvi__ready(st, st && st->in.memory);
    if (ready != GVI_OK) return ready;
    struct gvi__private *in = &st->in;
    if (!saved || !memory || !saved->in.memory || saved->n != st->n || saved->s != st->s
        || saved->r != st->r || saved->in.size != in->size || saved->in.chosen != in->chosen
        || saved->in.reads_v != in->reads_v || saved->in.adds_p != in->adds_p
        || saved->in.separate != in->separate
        || saved->in.desc.effect_count != in->desc.effect_count
        || saved->in.desc.mass.kind != in->desc.mass.kind)
        return gvi__refuse_call(st, "saved or memory is NULL, not set up, or of another scene");
    const struct gvi__private own = *in;
    const ptrdiff_t F = saved->in.work.F - saved->in.memory;
    gvi__copy(in->size, memory + saved->in.skip, own.memory);
    *st = *saved;
    in->desc = own.desc;
    in->memory = own.memory;
    in->kernel = own.kernel;
    in->skip = own.skip;
    in->failed.status = GVI_OK;
    gvi__hand_out(st, own.memory);

    // it goes round in two or three, and V with it
    while (in->work.F - in->memory != F) gvi__rotate_values(st);
    return gvi__report_status(st, GVI_OK);
}
#endif

GVI_DEF gvi_status gvi_velocity(gvi_stepper *st, gvi_real *v)
{
    gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (!v) return gvi__refuse_call(st, "v is NULL");
    gvi_real *V = st->in.answer;
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
    gvi_real E, *v = st->in.answer + st->n;
    gvi__velocity_guess(st, v);
    status = gvi__hamiltonian(st, st->t, st->q, st->p, v, &E);
    if (status == GVI_OK) *energy = E;
    return gvi__done(st, status);
}

/* The last step's curve and velocity, by the formulas of its points with the table row of tau: from
   F by (3) and its derivative where no V is kept, else from V.                                */
static void gvi__curve_at(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, by_forces = in->stages == 1 && !in->has_velocity;
    const gvi_real *modes = by_forces ? in->table.Phi : in->table.phi,
                   *weight = by_forces ? in->sized.hb : in->table.b,
                   *values = by_forces ? in->last.F : in->last.V;
    gvi_real *v0 = in->free.v;

    if (gvi__parts(in) && gvi__place_line(st, tau, q, v)) return;
    if (!gvi__iterates(in)) return;
    gvi_real *phi = in->set_up, *Phi = phi + R;                      // at tau, over Gamma
    gvi__modes(st, tau, phi, Phi);
    gvi__zero((size_t)n, q);
    gvi__zero((size_t)n, v);
    for (int j = 0; j < st->r; ++j) {
        gvi_real S = 0, T = 0;
        for (int k = 0; k < st->s; ++k) {
            S += Phi[k]*modes[k*R + j];
            T += phi[k]*modes[k*R + j];
        }
        if (by_forces) {
            S = tau - S;
            T = 1 - T;
        }
        for (int i = 0; i < n; ++i) {
            const gvi_real L = weight[j]*values[i*R + j];
            q[i] += S*L;
            v[i] += T*L;
        }
    }

    if (gvi__parts(in)) gvi__place_reactions(st, tau, phi, Phi, q, v);
    if (by_forces) {
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

// kicks' broken line has none of degree s
static int gvi__has_curve(const gvi_stepper *st) { return st->in.desc.rule.kind != GVI_KICKS; }

GVI_DEF gvi_status gvi_curve(gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    gvi_status status = gvi__stepped(st);
    if (status != GVI_OK) return status;
    if (!(tau >= 0 && tau <= 1)) return gvi__refuse_call(st, "tau is not in [0,1]");
    if (!gvi__has_curve(st)) return gvi__done(st, GVI_E_FORMULATION);
    gvi_real *Q = st->in.answer, *V = Q + st->n;
    gvi__weights_for(st, st->h);
    gvi__curve_at(st, tau, Q, V);
    if (gvi__parts(&st->in)) status = gvi__place_curve(st, Q, V);
    if (status != GVI_OK) return gvi__done(st, status);
    gvi__hand_over(st->n, Q, q);
    gvi__hand_over(st->n, V, v);
    return gvi__done(st, GVI_OK);
}

GVI_DEF size_t gvi_stepper_size(void) { return sizeof(gvi_stepper); }

/* ========================================================================== PART II: CHAPTERS

   Each by itself, behind the places that PART I calls: what it adds to the method, then how.  Any
   of them can be left out, and then leaves nothing.                                           */

#ifndef GVI_NO_LAGRANGIAN
/* ------------------------------------------------------ LAGRANGIAN TERMS

   L may have terms that depend on v in any way: they add dL/dq to F and A_i = dL/dv to P_i.

   With momenta (5), V_i = M^-1 (P_i - A_i).  v from p at one point takes Newton's method: the
   Legendre transform.                                                                         */

GVI__OFFERED gvi_real *gvi__rows_of_A(const struct gvi__private *in) { return in->lagrangian.A; }

/* d(dL/dv)/dv at one point, n*n, by differences of dL/dv, to `hessian`.  x has been evaluated, and
   x->v is v.  A difference moves P_j by sqrt(eps) of what there is of momentum: P_j itself, which
   need not be 0 with v, and from rest p_j that is wanted, or in a step, where p is NULL, h f_j.
   It is sqrt(eps) of v_j where that moves P_j more, and shorter where it leaves L's domain.
   (test_newton has rest and a large P.)                                                       */
static gvi_status gvi__velocity_hessian(gvi_stepper *st, gvi_points *at, gvi_real *v,
                                        const gvi_real *p, gvi_real *hessian)
{
    const int n = st->n;
    const gvi_real root = GVI_SQRT(GVI__EPS);
    gvi_real *base = st->in.lagrangian.column;

    gvi__copy((size_t)n, at->dldv, base);
    for (int j = 0; j < n; ++j) {
        const gvi_real was = v[j];
        const int at_rest = !gvi__nonzero(was);
        const gvi_real wanted = at_rest ? GVI_ABS(p ? p[j] : st->in.sized.h*at->f[j]) : 0,
                       target = root*gvi__larger(wanted, GVI_ABS(base[j]));
        gvi_real d = 0, edge = GVI__MAX, next = root*GVI_ABS(was);
        if (at_rest) next = root*(gvi__norm1(n, v)/(gvi_real)n);
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
                edge = GVI_ABS(d);
                next = d*root;
                if (GVI_ABS(d)*root < 2*GVI__EPS*GVI_ABS(was)) next = -2*GVI__EPS*was;
            } else if (at_rest && target > 0 && moved > 16*target) {
                next = d*(target/moved);
            } else if (moved < target/2 && GVI_ABS(d)/GVI_SQRT(root) < edge) {
                next = d/GVI_SQRT(root);
            } else break;
            if (!gvi__nonzero(next)) break;
        }
        for (int i = 0; i < n; ++i) hessian[i*n + j] = (at->dldv[i] - base[i])/d;
    }

    gvi__copy((size_t)n, base, at->dldv);
    return GVI_OK;
}

/* left := p - dL/dv; returns the largest over what rounding of v and p makes of it: of each, and
   *all of that of the largest amplitude, momenta over sqrt M_ii, since terms may cancel in dL/dv */
static gvi_real gvi__legendre_miss(int n, const gvi_real *hessian, const gvi_real *v,
                                   const gvi_real *p, const gvi_real *P, gvi_real *left,
                                   gvi_real *all)
{
    gvi_real miss = 0, most = 0, largest = 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real unit = GVI_SQRT(GVI_ABS(hessian[i*n + i]));
        gvi_real terms = GVI_ABS(p[i]);
        for (int j = 0; j < n; ++j) terms += GVI_ABS(hessian[i*n + j]*v[j]);
        left[i] = p[i] - P[i];
        if (GVI_ABS(left[i]) > miss*terms) miss = GVI_ABS(left[i])/terms;
        if (terms > largest*unit) largest = terms/unit;
        if (GVI_ABS(left[i]) > most*unit) most = GVI_ABS(left[i])/unit;
    }
    *all = most > 0 ? most/largest : 0;
    return miss;
}

/* General Legendre transform at one point: Newton's method for dL/dv(v) = p from the v given.  What
   falls goes on; what does not is rounding, at once where each p_i is, after a while where all are.
   A correction out of the domain of L (faster than light), refused or not a number, is halved. */
static gvi_status gvi__legendre_newton(gvi_stepper *st, gvi_points *x, const gvi_real *p,
                                       gvi_real *v)
{
    const int n = st->n;
    const gvi_real rounding = 2*GVI__PLACE*GVI__EPS*(gvi_real)n;
    gvi_real *hessian = st->in.lagrangian.hessian, *pivot = hessian + n*n,
             *dv = st->in.lagrangian.column + n,
             least = GVI__MAX, last = GVI__MAX;
    int at;

    x->v = v;
    gvi__count(&st->counters.velocities, 1);
    for (int k = 0, halves = 0, idle = 0; k < 60; ++k) {
        gvi_real miss = 0, all = 0, change = 0;
        gvi_status status = gvi__evaluate(st, x, 0, 1);
        if (status == GVI_OK && gvi__first_non_finite(n, x->dldv) >= 0) status = GVI_E_NON_FINITE;
        if (status == GVI_OK) status = gvi__velocity_hessian(st, x, v, p, hessian);
        if (status == GVI_OK) {
            miss = gvi__legendre_miss(n, hessian, v, p, x->dldv, dv + n, &all);
            status = gvi__lu_factor(n, hessian, pivot, &at);
            gvi__count(&st->counters.factorizations, 1);
            if (status == GVI_E_SINGULAR)
                return gvi__report(st, status, GVI_FAULT_MASS, at, GVI_FAULT_NONE);
        }
        const int beyond = status == GVI_E_CALLBACK || status == GVI_E_NON_FINITE;
        if (k > 0 && beyond && halves < GVI__NEVER) {
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
        gvi_lu_solve(n, hessian, pivot, dv);
        for (int i = 0; i < n; ++i) {
            v[i] += dv[i];
            if (gvi__nonzero(dv[i])) change += GVI_ABS(dv[i])/(GVI_ABS(dv[i]) + GVI_ABS(v[i]));
        }
        if (gvi__first_non_finite(n, v) >= 0) break;
        // from beyond the root corrections grow threefold, be they of the last place
        idle = miss < least/2 || (idle == 0 && change > 2*last) ? 0 : idle + 1;
        last = change;
        least = gvi__smaller(miss, least);
        if (!(miss > 0) || (idle > 0 && miss <= rounding) || (idle > 2 && all <= rounding))
            return GVI_OK;
    }

    return gvi__report_effect(st, GVI_E_CONVERGENCE, GVI_FAULT_MASS);
}

/* d2L/dv2 at one point and its LU, to lagrangian.hessian; symmetric, which its differences are not.
   What effects add to the mass, which may grow with v, is known now, at rest as well.         */
GVI__OFFERED gvi_status gvi__factor_hessian(gvi_stepper *st, gvi_points *at, gvi_real *v)
{
    const int n = st->n;
    gvi_real *H = st->in.lagrangian.hessian;
    int column;
    at->v = v;
    gvi_status status = gvi__evaluate(st, at, 0, 1);
    if (status == GVI_OK) status = gvi__velocity_hessian(st, at, v, NULL, H);
    if (status != GVI_OK) return status;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < i; ++j) H[i*n + j] = H[j*n + i] = H[i*n + j]/2 + H[j*n + i]/2;
        if (gvi__nonzero(H[i*n + i])) st->in.watch.scale[i] = 1/GVI_SQRT(GVI_ABS(H[i*n + i]));
    }
    status = gvi__lu_factor(n, H, H + n*n, &column);
    if (status == GVI_E_SINGULAR)
        return gvi__report(st, status, GVI_FAULT_MASS, column, GVI_FAULT_NONE);
    return gvi__report_status(st, status);
}

// z := (d2L/dv2)^-1 z
GVI__OFFERED void gvi__over_hessian(const gvi_stepper *st, gvi_real *z)
{
    const gvi_real *lu = st->in.lagrangian.hessian;
    gvi_lu_solve(st->n, lu, lu + st->n*st->n, z);
}

GVI__COLD void gvi__lagrangian_layout(struct gvi__private *in, gvi__arena *a)
{
    struct gvi__lagrangian *l = &in->lagrangian;
    const size_t n = (size_t)in->desc.n, r = (size_t)in->desc.rule.points, R = (size_t)GVI__ROW(r),
                 fixed = in->chosen != GVI_NEWTON,
                 older = fixed && r < 10 && GVI__DIG > 24;
    l->A = gvi__take(a, fixed*n, R);
    l->last_A = gvi__take(a, fixed*n, R);
    l->older_A = gvi__take(a, older*n, R);
    l->hessian = gvi__take(a, 1, n*n + n + 1);
    l->column = gvi__take(a, 4, n);
}

static void gvi__place_rotate(gvi_stepper *st)
{
    struct gvi__lagrangian *l = &st->in.lagrangian;
    if (gvi__parts(&st->in) & GVI__IN_LAGRANGIAN) gvi__rotate(&l->older_A, &l->last_A, &l->A);
}

// A of the last step, extrapolated, or none
static void gvi__lagrangian_predict(const gvi_stepper *st, int extrapolate)
{
    const struct gvi__lagrangian *l = &st->in.lagrangian;
    if (extrapolate) gvi__extrapolate(st, l->last_A, l->older_A, l->A);
    else gvi__zero((size_t)st->n*(size_t)st->in.R, l->A);
}

#else
#define gvi__factor_hessian(st, at, v) ((void)(at), (void)(v), GVI_OK)
#define gvi__over_hessian(st, z) ((void)(z))
#define gvi__rows_of_A(in) ((gvi_real *)0)
#endif /* GVI_NO_LAGRANGIAN */

#ifndef GVI_NO_MOMENTA
/* --------------------------------------------------------------- MOMENTA

   Formulation (5), for r = s: stages P and Q in place of Q and V, and V from dL/dv(Q, V) = P
   between and behind them.  So M may depend on q, Lagrangian terms may be there, or the caller
   makes the velocity from the momentum.                                                       */

/* ---- the mass at the points ---- */

/* The same for whole lanes of points.  Returns the squares of (diagonal entry before
   elimination)/D, and of what rounding leaves of D/D - 1: all pivots D are sure if they add up to
   less than 1/(n eps)^2.  Otherwise gvi__ldl_factor has to decide, from the matrix made anew. */
GVI__BODY gvi__lane gvi__ldl_factor_lane(int n, int R, gvi_real *m)
{
    const size_t N = (size_t)n, S = (size_t)R;
    gvi__lane sum = { 0 };

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

    return sum;
}

// z := M^-1 from, which may be z
GVI__BODY void gvi__ldl_solve_lane(int n, int R, const gvi_real *m, const gvi_real *from,
                                   gvi_real *z)
{
    const size_t N = (size_t)n, S = (size_t)R;
    GVI__LOOP(GCC unroll 2) for (size_t i = 0; i < N; ++i) {
        gvi__lane rest = GVI__LOAD(from + i*S);
        GVI__LOOP(GCC unroll 2) for (size_t j = 0; j < i; ++j)
            rest -= GVI__LOAD(m + (i*N + j)*S)*GVI__LOAD(z + j*S);
        GVI__STORE(z + i*S) = rest;
    }
    GVI__LOOP(GCC unroll 2) for (size_t i = N; i-- > 0; ) {
        gvi__lane rest = GVI__LOAD(z + i*S)*GVI__LOAD(m + (i*N + i)*S);
        GVI__LOOP(GCC unroll 2) for (size_t j = i + 1; j < N; ++j)
            rest -= GVI__LOAD(m + (j*N + i)*S)*GVI__LOAD(z + j*S);
        GVI__STORE(z + i*S) = rest;
    }
}

GVI__BODY void gvi__solve_lanes(int n, int R, const gvi_real *m, const gvi_real *P, gvi_real *V)
{
    GVI__LOOP(GCC unroll 4) for (int o = 0; o < R; o += GVI__LANES)
        gvi__ldl_solve_lane(n, R, m + o, P + o, V + o);
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
        at.mass = st->in.momenta.mass;
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
    gvi_real *m = st->in.momenta.mass;
    gvi_status status = gvi__evaluate_mass(st, x, NULL, NULL);

    if (status != GVI_OK) return status;
    gvi__count(&st->counters.factorizations, x->count);
    if (GVI__LANES > 1 && R % 8 == 0) {
        const gvi_real most = 1/((gvi_real)n*GVI__EPS);
        gvi__lane sum = { 0 };
        gvi_real all = 0;
        for (size_t i = 0, S = (size_t)R; x->count < R && i < (size_t)n*(size_t)n; ++i)
            for (size_t k = (size_t)x->count; k < S; ++k) m[i*S + k] = m[i*S];
        for (int o = 0; o < R; o += GVI__LANES)
            if (n == 2) sum += gvi__ldl_factor_lane(2, R, m + o);
            else sum += gvi__ldl_factor_lane(n, R, m + o);
        for (int k = 0; k < GVI__LANES; ++k) all += GVI__ENTRY(sum, k);
        if (all < most*most) return GVI_OK;
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
    if (!GVI__LOOKS(st)) return GVI_OK;
    return gvi__check_rows(st, x, x->f, GVI_FAULT_MASS);
}

/* ---- Legendre transform at one point ---- */

// v from p with M(q), or by the caller's own transform
static gvi_status gvi__momenta_velocity(gvi_stepper *st, gvi_points *at, const gvi_real *p,
                                        gvi_real *v)
{
    if (st->in.desc.mass.velocity) {
        const gvi_status status = gvi__evaluate_mass(st, at, p, v);
        return status == GVI_OK ? gvi__check_rows(st, at, v, GVI_FAULT_MASS) : status;
    }
    const gvi_status status = gvi__factor_mass(st, at);
    if (status != GVI_OK) return status;
    gvi__copy((size_t)st->n, p, v);
    gvi__ldl_solve(st->n, st->in.momenta.mass, 1, v, 1, 1);
    gvi__count(&st->counters.velocities, 1);
    return GVI_OK;
}

// F and P of v'M(q)v/2
static gvi_status gvi__place_kinetic(gvi_stepper *st, gvi_points *at)
{
    if (st->in.desc.mass.kind != GVI_MASS_POSITION) return GVI_OK;
    gvi_status status = gvi__evaluate_mass(st, at, NULL, NULL);
    if (status == GVI_OK) status = gvi__mass_gradient(st, at);
    if (status == GVI_OK) gvi__add_kinetic(at, st->in.momenta.mass, at->stride);
    return status;
}

/* ---- set-up ---- */

// what is missing of a mass that is not constant, or NULL
GVI__COLD const char *gvi__wrong_in_varying_mass(const gvi_mass *m)
{
    if (m->kind == GVI_MASS_POSITION && !m->points) return "mass: points is missing";
    if (m->kind == GVI_MASS_POSITION && !m->gradient) return "mass: gradient is missing";
    return NULL;
}

GVI__COLD int gvi__momenta_cover(const struct gvi__private *in, int holds)
{
    const gvi_desc *d = &in->desc;
    if (d->rule.points != d->degree) return 0;
    if (d->mass.velocity) return !holds;
    return d->mass.kind != GVI_MASS_NONE;
}

GVI__COLD void gvi__momenta_layout(struct gvi__private *in, gvi__arena *a)
{
    struct gvi__momenta *m = &in->momenta;
    const size_t n = (size_t)in->desc.n, r = (size_t)in->desc.rule.points, R = (size_t)GVI__ROW(r),
                 on = in->chosen == GVI_MOMENTA, varies = in->desc.mass.kind == GVI_MASS_POSITION;
    m->P = gvi__take(a, on*n, R);
    m->T = gvi__take(a, on*r, R);
    m->ones = gvi__take(a, on, n);
    m->was = gvi__take(a, on, n);
    m->mass = gvi__take(a, varies*n*n, R);
}

// T by columns: T_ji at [j*R + i], of U
GVI__COLD void gvi__momenta_tables(gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    if (in->chosen != GVI_MOMENTA) return;
    for (int j = 0; j < st->r; ++j)
        for (int i = 0; i < st->r; ++i)
            in->momenta.T[i*in->R + j] = 1 - in->table.U[j*in->R + i];
    for (int i = 0; i < st->n; ++i) in->momenta.ones[i] = 1;
}

/* ---- step ---- */

// P := p0 + sum_j U_ij h b_j F_j,  Q := q0 + sum_j T_ji h b_j V_j
static void gvi__momenta_stages(gvi_stepper *st, const gvi__origin *from, gvi__stage *stage)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    stage[1].table = in->momenta.T;
    stage[1].source = in->work.V;
    stage[1].base = from->q;
    stage[1].values = in->work.Q;
    stage[1].of = GVI__OF_Q;
    stage[0].table = in->table.U;
    stage[0].base = from->p;
    stage[0].factor = 1;
    stage[0].values = in->momenta.P;
    stage[0].of = GVI__OF_P;
    stage[0].inverse = stage[1].inverse = in->momenta.ones;
    in->momenta.has_factor = 0;
    for (int i = 0; i < n; ++i) {
        gvi__free_row(R, from->p_low[i], 0, 0, in->table.c, in->free.values + i*R);
        gvi__free_row(R, from->q_low[i], 0, 0, in->table.c, in->free.values + (n + i)*R);
    }
}

// V of the last step, extrapolated, or constant; `rate`: of a clock, or 1
static void gvi__momenta_predict(gvi_stepper *st, int extrapolate, gvi_real rate)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    if (extrapolate) {
        gvi__extrapolate(st, in->last.V, in->older.V, in->work.V);
        return;
    }
    gvi__velocity_guess(st, in->momenta.was);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < st->r; ++k) in->work.V[i*R + k] = rate*in->momenta.was[i];
}

/* V := M^-1 (P - A), with the constant mass or the factored M(Q); V may be P                 */
static void gvi__velocity_rows(const gvi_stepper *st, const gvi_real *P, gvi_real *V)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    const gvi_real *A = gvi__rows_of_A(in);

    if (A) {
        for (int k = 0; k < n*R; ++k) V[k] = P[k] - A[k];
        P = V;
    }

    if (GVI__LANES > 1 && R % 8 == 0 && in->momenta.mass) {
        if (n == 2 && R == 8) gvi__solve_lanes(2, 8, in->momenta.mass, P, V);
        else gvi__solve_lanes(n, R, in->momenta.mass, P, V);
        return;
    }

    if (P != V) gvi__copy((size_t)(n*R), P, V);
    if (!in->momenta.mass) gvi__over_mass(st, V, R, st->r);
    else gvi__ldl_solve(n, in->momenta.mass, R, V, R, st->r);
}

/* Momenta: V from the new P with the old M(Q) and dL/dv, so that an iteration contracts twice
   as fast.  Where Lagrangian terms make V it can diverge while Q and P hardly change: returns its
   squared relative change at the last point, times r as if summed over all.  V moves as long as
   that is more than half of the digits of what M V is the difference of: no noise ends then.  */
static gvi_real gvi__place_between(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, clock = gvi__clock_is_on(st),
              made = gvi__rows_of_A(in) != NULL;
    const gvi_real *V = in->work.V + st->r - 1;
    gvi_real *was = in->momenta.was, sum = 0;
    if (!(gvi__parts(in) & GVI__IN_MOMENTA)) {    // stages are Q and V
        gvi__count(&st->counters.velocities, st->r);
        return 0;
    }
    in->momenta.moves = 0;

    // before the first evaluation Q, g and M(Q) are those of another step
    if (!in->momenta.has_factor && (clock || in->desc.mass.velocity || in->momenta.mass))
        return 0;
    if (made) gvi__gather(n, R, V, was);
    gvi__count(&st->counters.velocities, st->r);
    const gvi_points at = gvi__points_at(st, st->r, R, in->t, in->work.Q, NULL, NULL);

    // where that fails it does so again with the new Q
    if (in->desc.mass.velocity) (void)gvi__evaluate_mass(st, &at, in->momenta.P, in->work.V);
    else gvi__velocity_rows(st, in->momenta.P, in->work.V);
    if (clock) gvi__clock_velocities(st);
    if (!made) return 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real moved = V[i*R] - was[i], size = GVI_ABS(V[i*R]) + GVI_ABS(was[i]);
        const int last = i*R + st->r - 1;
        const gvi_real terms = GVI_ABS(in->momenta.P[last]) + GVI_ABS(gvi__rows_of_A(in)[last]),
                       half = GVI_SQRT(GVI__EPS), inertia = gvi__place_inertia(st, i);
        if (size > GVI__NOTHING) sum += (moved/size)*(moved/size);
        in->momenta.moves |= GVI_ABS(moved) > half*size && GVI_ABS(moved)*inertia > half*terms;
    }
    return (gvi_real)st->r*sum;
}

/* Before the effects: V from dL/dv(Q, V) = P.  A new M moved V: of three and more coordinates,
   where M(q) and F are dearer than rows, Q once more from that V, so that fewer iterations do. */
static gvi_status gvi__momenta_evaluate(gvi_stepper *st, const gvi__origin *from, gvi_points *at)
{
    struct gvi__private *in = &st->in;
    gvi_status status = GVI_OK;
    gvi__count(&st->counters.velocities, st->r);
    if (in->desc.mass.velocity) status = gvi__evaluate_mass(st, at, in->momenta.P, in->work.V);
    else if (in->momenta.mass) status = gvi__factor_mass(st, at);
    if (status != GVI_OK) return status;
    in->momenta.has_factor = 1;
    if (!in->desc.mass.velocity) gvi__velocity_rows(st, in->momenta.P, in->work.V);
    else if (GVI__LOOKS(st)) status = gvi__check_rows(st, at, in->work.V, GVI_FAULT_MASS);
    const int others = (gvi__parts(in) & (GVI__IN_CLOCK | GVI__IN_CONSTRAINTS)) != 0;
    if (st->n > 2 && in->momenta.mass && !others) {
        const gvi__stage Q = { in->momenta.T, in->work.V, from->q, in->free.values + st->n*in->R,
                               in->momenta.ones, 1, in->work.Q, in->watch.scale + st->n,
                               in->momenta.was, NULL, GVI__OF_Q, 1 };
        in->kernel(st, &Q, 0);
    }
    return status;
}

// M_ii of M(q) where F was evaluated last: first point
static gvi_real gvi__momenta_inertia(const gvi_stepper *st, int i)
{
    const struct gvi__private *in = &st->in;
    const size_t ii = (size_t)i*((size_t)st->n + 1);
    const gvi_real m = in->momenta.mass[ii*(size_t)in->R];
    // the iteration factors M(q) in place: 1/D_i is there
    const int factored = st->formulation == GVI_MOMENTA && in->momenta.has_factor
                         && !in->desc.mass.velocity;
    return factored && gvi__nonzero(m) ? 1/m : m;
}

GVI__OFFERED gvi_real *gvi__mass_at_points(const struct gvi__private *in)
{
    return in->momenta.mass;
}
#else
#define gvi__mass_at_points(in) ((gvi_real *)0)
#define gvi__evaluate_mass(st, x, p, v) GVI_OK
#define gvi__factor_mass(st, x) ((void)(x), GVI_OK)
#endif /* GVI_NO_MOMENTA */

#ifndef GVI_NO_CLOCK
/* ----------------------------------------------------------------- CLOCK

   g(q) > 0 makes time run as dt = g dtau.  On top of MOMENTA: it changes what F, V and t are at the
   points, and keeps the energy of the start with the work of forces.                         */

static int gvi__clock_is_on(const gvi_stepper *st)
{
    return (gvi__parts(&st->in) & GVI__IN_CLOCK) && !(st->in.off >> st->in.time.effect & 1u);
}

// the clock's g and dg/dq at the points
static gvi_status gvi__rate(gvi_stepper *st, const gvi_points *x, gvi_real *rate, gvi_real *slope)
{
    const gvi_effect *clock = st->in.desc.effects + st->in.time.effect;
    gvi_points at = gvi__points_at(st, x->count, x->stride, x->t, x->q, slope, NULL);
    at.value = rate;
    gvi__zero((size_t)x->n*(size_t)x->stride, slope);
    gvi__zero((size_t)x->stride, rate);
    gvi__count(&st->counters.effect[st->in.time.effect], x->count);
    const int failed = clock->points(&at, clock->user);
    if (failed) return gvi__report_callback(st, failed, st->in.time.effect);
    for (int k = 0; k < x->count; ++k) {
        if (rate[k] <= 0)
            return gvi__report(st, GVI_E_CLOCK, st->in.time.effect, GVI_FAULT_NONE, k);
        if (GVI__LOOKS(st) && !gvi__finite(rate[k]))
            return gvi__report(st, GVI_E_NON_FINITE, st->in.time.effect, GVI_FAULT_NONE, k);
    }

    if (!GVI__LOOKS(st)) return GVI_OK;
    return gvi__check_rows(st, x, slope, st->in.time.effect);
}

// g at one configuration; slope of length n gets dg/dq
static gvi_status gvi__clock_at(gvi_stepper *st, gvi_real t, const gvi_real *q, gvi_real *rate,
                                gvi_real *slope)
{
    const gvi_points at = gvi__one_point(st, &t, q);
    return gvi__rate(st, &at, rate, slope);
}

// the largest rate of the step's points; 1 without a clock
static gvi_real gvi__clock_rate(const gvi_stepper *st)
{
    if (!gvi__clock_is_on(st)) return 1;
    gvi_real rate = st->in.time.rate[0];
    for (int k = 1; k < st->r; ++k) rate = gvi__larger(st->in.time.rate[k], rate);
    return rate;
}

// z := sum_j T_j h b_j source_j at all points: the rule of Q
static void gvi__time_sums(const gvi_stepper *st, const gvi_real *source, gvi_real *z)
{
    const struct gvi__private *in = &st->in;
    const gvi_real *L = in->weighted;
    gvi__weigh(in->R, in->sized.hb, source, in->weighted);
    for (int k = 0; k < in->R; ++k) z[k] = gvi__point_sum(st->r, in->R, in->momenta.T + k, L);
}

/* H - E for a coordinate whose force is F: unchanged, unless its rounding, within `none`, would
   move a light body by more than 1024 eps of F; then 0 up to `none`, unchanged from 2 none on. */
static gvi_real gvi__sure_level(gvi_real level, gvi_real none, gvi_real slope, gvi_real F)
{
    const gvi_real limit = GVI__SURE*GVI__EPS*F, force = GVI_ABS(slope)*none, size = GVI_ABS(level);
    if (force <= limit) return level;
    if (force < 2*limit) none *= force/limit - 1;
    gvi_real sure = size;
    if (size < 2*none) sure = 2*(size - none);
    if (size <= none) sure = 0;
    if (level < 0) return -sure;
    return sure;
}

/* With a clock: forces first, for their power f'v; then all else, with values.  What it makes
   of F and V: F := g F - dg/dq (H - E), V := g v, with H = (P + A)'v/2 + V_pot - L, and E, with
   the work of the forces, and the times by the rule of Q.                                     */
static gvi_status gvi__clock_evaluate(gvi_stepper *st, const gvi__origin *from, gvi_points *y)
{
    struct gvi__private *in = &st->in;
    const struct gvi__values *w = &in->work;
    const int n = st->n, r = st->r, R = in->R;
    const gvi_real *A = gvi__rows_of_A(in);
    const unsigned forces = gvi__of_kind(in, GVI_FORCE);
    const gvi_real E = from->q == st->q ? in->time.H + in->time.H_low : in->time.began;
    gvi_real *g = in->time.rate, *power = in->time.power, *level = in->time.level,
             *L = in->time.lagrangian, *noise = in->time.noise;
    gvi_real *const values[] = { level, NULL, L };         // by kind
    gvi_status status = gvi__effects(st, y, ~forces, NULL);

    gvi__zero((size_t)R, power);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < r; ++k) power[k] += w->F[i*R + k]*w->V[i*R + k];
    gvi__zero((size_t)R, level);
    gvi__zero((size_t)R, L);
    if (status == GVI_OK && in->momenta.mass) status = gvi__mass_gradient(st, y);
    if (status == GVI_OK) status = gvi__effects(st, y, forces, values);
    if (status == GVI_OK) status = gvi__rate(st, y, g, in->time.slope);
    if (status != GVI_OK) return status;

    // level := H - E; noise: what rounding makes of it
    for (int k = 0; k < R; ++k) {
        noise[k] = GVI_ABS(level[k]) + GVI_ABS(L[k]) + GVI_ABS(E);
        level[k] -= L[k] + E;
        power[k] *= g[k];
    }

    if (forces & ~in->off) {
        gvi__time_sums(st, power, L);
        for (int k = 0; k < R; ++k) level[k] -= L[k];
    }

    for (int i = 0; i < n; ++i)
        for (int k = 0; k < R; ++k) {
            const int at = i*R + k;
            gvi_real P = in->momenta.P[at];
            if (A) P += A[at];
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

static void gvi__clock_velocities(const gvi_stepper *st)
{
    for (int i = 0; i < st->n; ++i)
        for (int k = 0; k < st->in.R; ++k) st->in.work.V[i*st->in.R + k] *= st->in.time.rate[k];
}

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

GVI__COLD const char *gvi__wrong_in_clock(const struct gvi__private *in, int e)
{
    if (!in->desc.effects[e].points) return "effect: this kind needs points, not point";
    return in->parts & GVI__IN_CLOCK ? "effect: a second clock" : NULL;
}

GVI__COLD void gvi__clock_layout(struct gvi__private *in, gvi__arena *a)
{
    struct gvi__time *t = &in->time;
    const size_t n = (size_t)in->desc.n, R = (size_t)GVI__ROW(in->desc.rule.points);
    gvi_real **const tables[] = { &t->rate, &t->power, &t->level, &t->lagrangian, &t->noise };
    for (int k = 0; k < 5; ++k) *tables[k] = gvi__take(a, 1, R);
    t->slope = gvi__take(a, n, R);
}

GVI__COLD gvi_status gvi__clock_start(gvi_stepper *st, gvi_real t, gvi_real *v)
{
    struct gvi__private *in = &st->in;
    gvi_real E, *V = in->answer;
    if (!gvi__clock_is_on(st)) return GVI_OK;
    if (V != v) gvi__copy((size_t)st->n, v, V);
    const gvi_status status = gvi__clock_energy(st, t, in->step.q, in->step.p, V, &E);
    in->time.H = E;
    in->time.H_low = 0;
    return status;
}

// another energy, also at the start of the last step
GVI__COLD gvi_status gvi__clock_switch(gvi_stepper *st, unsigned was)
{
    struct gvi__private *in = &st->in;
    gvi_real E, E0 = in->time.began, *v = in->answer + st->n;
    if (!gvi__clock_is_on(st)) return GVI_OK;
    gvi__velocity_guess(st, v);
    gvi_status status = gvi__clock_energy(st, st->t, st->q, st->p, v, &E);
    if (status == GVI_OK && in->stepped)
        status = gvi__hamiltonian(st, st->t0, in->began.q, in->began.p, v, &E0);
    if (status != GVI_OK) {
        in->off = was;
        return status;
    }

    in->time.H = E;
    in->time.H_low = 0;
    in->time.began = E0;
    return GVI_OK;
}

// times of the points as if g stayed as it is
static gvi_status gvi__clock_predict(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                     gvi_real *rate)
{
    struct gvi__private *in = &st->in;
    const gvi_status status = gvi__clock_at(st, from->t, from->q, rate, in->momenta.was);
    if (status == GVI_OK) gvi__times(in->R, from->t, from->t_low, h**rate, in->table.c, in->t);
    return status;
}

static void gvi__clock_increments(gvi_stepper *st)
{
    st->in.dt = gvi__dot(st->r, st->in.sized.hb, st->in.time.rate);
    st->in.time.dH = gvi__dot(st->r, st->in.sized.hb, st->in.time.power);
}

static void gvi__clock_commit(gvi_stepper *st)
{
    struct gvi__time *time = &st->in.time;
    const int on = gvi__clock_is_on(st);
    const gvi__two H = gvi__two_sum(time->H, (on ? time->dH : 0) + time->H_low);
    time->began = time->H;
    time->H = H.hi;
    time->H_low = H.lo;
    st->in.stepped = 1 + on;
}

// v = q'/g on the last step's curve
static gvi_status gvi__place_curve(gvi_stepper *st, const gvi_real *q, gvi_real *v)
{
    gvi_real rate;
    if (st->in.stepped != 2) return GVI_OK;
    GVI__LOOK(st, 1);
    const gvi_status status = gvi__clock_at(st, st->t, q, &rate, v + st->n);
    GVI__LOOK(st, 0);
    if (status == GVI_OK) for (int i = 0; i < st->n; ++i) v[i] /= rate;
    return status;
}
#endif /* GVI_NO_CLOCK */

#ifndef GVI_NO_KICKS
/* ----------------------------------------------------------------- KICKS

   Explicit steps: on a broken line with corners Q_j at t0 + c_j h the momentum jumps by h b_j F_j
   at each corner, and the motion is free between two.  Stoermer-Verlet, Lobatto's rule with two
   points and s = 1, is the simplest table; GVI_KICKS takes any.  It is a solver of its own, without
   an iteration.                                                                               */

GVI__COLD int gvi__kicks_cover(const struct gvi__private *in, int constant)
{
    const gvi_rule *rule = &in->desc.rule;
    const int verlet = rule->kind == GVI_LOBATTO && rule->points == 2 && in->desc.degree == 1;
    return constant && !in->reads_v && (verlet || rule->kind == GVI_KICKS);
}

GVI__COLD gvi_status gvi__check_kicks(const gvi_rule *rule)
{
    for (int j = 0; j < rule->points; ++j)
        if (!gvi__finite(rule->nodes[j]) || !gvi__finite(rule->weights[j])) return GVI_E_NODES;
    return GVI_OK;
}

GVI__COLD void gvi__kicks_layout(struct gvi__private *in, gvi__arena *a)
{
    const size_t n = (size_t)in->desc.n, r = (size_t)in->desc.rule.points, R = (size_t)GVI__ROW(r),
                 lobatto = in->desc.rule.kind == GVI_LOBATTO, width = lobatto ? R : 1;
    in->work.F = gvi__take(a, n, width);
    in->work.Q = gvi__take(a, n, width);
    in->last.F = gvi__take(a, n, width);
    in->table.Phi = gvi__take(a, lobatto, R);
    in->kicks.drift = gvi__take(a, 1, r + 1);
}

// c and b: the caller's, or Stoermer-Verlet's
GVI__COLD void gvi__kicks_nodes(gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const gvi_rule *rule = &in->desc.rule;
    if (rule->kind == GVI_KICKS) {
        gvi__copy((size_t)st->r, rule->nodes, in->table.c);
        gvi__copy((size_t)st->r, rule->weights, in->table.b);
        return;
    }
    in->table.c[1] = 1;
    in->table.b[0] = in->table.b[1] = (gvi_real)0.5;
}

// drifts between the nodes, whose sum is h
static void gvi__drifts_for(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *in = &st->in;
    int e;
    if (!gvi__nonzero(in->kicks.h - h)) return;
    in->kicks.h = h;
    const gvi_real mantissa = GVI_FREXP(h, &e);
    gvi_real at = 0;
    for (int j = 0; j < st->r; ++j) {
        const gvi_real next = gvi__grid(gvi__two_prod(in->table.c[j], mantissa), GVI__EPS/2);
        in->kicks.drift[j] = GVI_LDEXP(next - at, e);
        at = next;
    }
    in->kicks.drift[st->r] = GVI_LDEXP(mantissa - at, e);
}

/* dp += b F, then the drift dq += a (v + M^-1 dp), Q = q + dq; F := 0 for the next force.  First
   in a step, dp and dq are the low words of the state, and F is `first`.                      */
GVI__COPIED void gvi__drift(gvi_stepper *st, const gvi__origin *from,
                            const gvi_real *GVI__RESTRICT v, const gvi_real *first, gvi_real b,
                            gvi_real a)
{
    struct gvi__private *in = &st->in;
    const gvi_real *GVI__RESTRICT q = from->q, *GVI__RESTRICT m = in->mass.inverse;
    gvi_real *GVI__RESTRICT F = in->work.F, *GVI__RESTRICT Q = in->work.Q;
    gvi_real *GVI__RESTRICT dp = in->step.p, *GVI__RESTRICT dq = in->step.q, *z = in->answer;
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

#ifndef GVI_NO_CONSTRAINTS
static gvi_status gvi__constrained_drift(gvi_stepper *st, const gvi__origin *from, gvi_real h);
#else
#define gvi__constrained_drift(st, from, h) GVI_OK
#endif

/* Kicks h b_j F_j at the nodes, drifts between them: one evaluation a kick; none where a weight is
   0, but for the last, whose F the next step may begin with.  `force`: F at the start, or NULL. */
static gvi_status gvi__kick(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                             const gvi_real *force)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, r = st->r, known = force && gvi__nonzero(in->sized.hb[0]);
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
        if (j == known) gvi__drift(st, from, v, known ? force : in->zeros, b, in->kicks.drift[j]);
        else gvi__drift(st, from, v, NULL, b, in->kicks.drift[j]);
        if (j == 1 && gvi__parts(in) & GVI__IN_CONSTRAINTS) {
            const gvi_status status = gvi__constrained_drift(st, from, h);
            if (status != GVI_OK) return status;
        }
        t = from->t + (from->t_low + in->table.c[j]*h);
        b = hb[j];
        if (j < r - 1 && !gvi__nonzero(b)) continue;
        const gvi_status status = GVI__LOOKS(st) ? gvi__effects(st, &at, 0, NULL)
                                                 : gvi__each_effect(st, &at, 0, NULL);
        if (status != GVI_OK) return status;
    }

    // the last kick, and the drift behind it, if there is one
    gvi_real *last = in->answer + n;
    if (gvi__nonzero(in->kicks.drift[r])) {
        gvi__copy((size_t)n, in->work.F, last);
        gvi__drift(st, from, v, NULL, b, in->kicks.drift[r]);
        gvi__copy((size_t)n, last, in->work.F);
    } else gvi__add_scaled(n, b, in->work.F, in->step.p, in->step.p);
    return GVI_OK;
}

static gvi_status gvi__kicks_solve(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    const struct gvi__private *in = &st->in;
    const gvi_real *force = NULL;                 // at the start, if it is known
    gvi__drifts_for(st, h);
    if (in->kicks.has_force && query != GVI__FROM_START) force = in->last.F;
    return gvi__kick(st, from, h, force);
}

static void gvi__kicks_commit(gvi_stepper *st)
{
    const gvi_real *c = st->in.table.c;
    st->in.kicks.has_force = !gvi__nonzero(c[0]) && !gvi__nonzero(c[st->r - 1] - 1);
}

// gvi__move for q and p, whose increments have no low words
static void gvi__kicks_move(struct gvi__private *in)
{
    gvi_real *GVI__RESTRICT q = in->state.q, *GVI__RESTRICT p = in->state.p;
    gvi_real *GVI__RESTRICT q_low = in->state.q_low, *GVI__RESTRICT p_low = in->state.p_low;
    gvi_real *GVI__RESTRICT q_was = in->began.q, *GVI__RESTRICT p_was = in->began.p;
    const gvi_real *GVI__RESTRICT dq = in->step.q, *GVI__RESTRICT dp = in->step.p;
    GVI__ALONG(in->desc.n,
        const gvi__number a = GVI__AT(q), d = GVI__AT(dq), s = a + d, b = s - a, da = s - b;
        const gvi__number u = GVI__AT(p), w = GVI__AT(dp), z = u + w, y = z - u, du = z - y;
        GVI__TO(q_was) = a;
        GVI__TO(p_was) = u;
        GVI__TO(q) = s;
        GVI__TO(p) = z;
        GVI__TO(q_low) = (a - da) + (d - b);
        GVI__TO(p_low) = (u - du) + (w - y))
}

/* As many steps as kicks alone can make: up to `count`, or to one that fails, which gvi_step then
   looks at.  What only iterations and queries need is done once, behind them all.             */
static int gvi__place_steps(gvi_stepper *st, gvi_real h, int count)
{
    struct gvi__private *in = &st->in;
    const gvi__origin from = { 0, 0, st->q, st->q_low, st->p, st->p_low };
    gvi_real t0 = st->t0;
    int made = 0;

    if (!(gvi__parts(in) & GVI__IN_KICKS) || in->separate) return 0;      // separate: constraints
#ifndef GVI_NO_DIAL
    if (in->dial.high) return 0;                   // each step is measured
#endif
    gvi__weights_for(st, h);
    gvi__drifts_for(st, h);
    for (; made < count; ++made) {
        gvi__origin now = from;
        now.t = st->t;
        now.t_low = st->t_low;
        const gvi__two t = gvi__two_sum(st->t, h + st->t_low);
        const gvi_real *force = in->kicks.has_force ? in->last.F : NULL;
        if (gvi__kick(st, &now, h, force) != GVI_OK) break;
        if (!gvi__finite(t.hi) || !gvi__finite_end(st, &now)) break;
        gvi__kicks_move(in);
        gvi__rotate(&in->older.F, &in->last.F, &in->work.F);
        gvi__kicks_commit(st);
        t0 = st->t;
        st->t = t.hi;
        st->t_low = t.lo;
    }

    if (made == 0) return 0;
    st->t0 = t0;
    st->h = in->dt = h;
    st->resolution = 0;
    st->iterations = 0;
    st->formulation = in->chosen;
    in->stepped = 1;
    in->failed.status = GVI_OK;
    gvi__count(&st->counters.steps, made);
    gvi__report_status(st, GVI_OK);
    return made;
}

// the last step's curve: a straight line
static int gvi__place_line(const gvi_stepper *st, gvi_real tau, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *in = &st->in;
    if (!(gvi__parts(in) & GVI__IN_KICKS)) return 0;
    for (int i = 0; i < st->n; ++i) {
        const gvi_real path = (in->state.q[i] - in->began.q[i]) + in->state.q_low[i];
        if (tau < (gvi_real)0.5) q[i] = in->began.q[i] + tau*path;
        else q[i] = in->state.q[i] - (1 - tau)*path;
        v[i] = path/st->h;
    }
    return 1;
}
#endif /* GVI_NO_KICKS */

#ifndef GVI_NO_NEWTON
/* ------------------------------------------------------- NEWTON'S METHOD

   Equations (1) by Newton's method: for scenes that no fixed point covers, and where one contracts
   badly.  A solver of its own, with dense LU of size s n.                                     */

/* Unknowns y[k*n + i]; the rows are those of (1) times 2k + 1, from k0 on:
   k0 = 0 for a step, 1 for the boundary-value problem.  The matrix of the derivatives is kept while
   the iteration contracts by 1/4 or better, over iterations and over steps.

   Behind them stand the s m unknowns and rows of what is held: CONSTRAINTS BY NEWTON'S METHOD.  */
typedef struct gvi__matrix {
    gvi_real *square;      /* rows and columns k0..s-1, row-major, then its LU              */
    gvi_real *pivot;
    gvi_real *ends;        /* k0 = 1: columns y_0 and q0, 2n a row; or NULL                 */
    int       k0;
    int       scaled;      /* columns over sqrt M_ii, rows by their largest entry: the condition
                              then has no units                                      */
    int       halves;      /* are changes taken back that make the residual larger?         */
    gvi_real *unit;        /* of the multipliers, in which the LU has their columns         */
    gvi_real *scale;       /* 1/sqrt M_ii of a mass that terms of L make, once known; or NULL */
} gvi__matrix;

/* Where Newton's method stands: the last changes and the least; rho, the contraction seen; what
   is left of the error, once a change was rounding; the residual in units of its own terms, and
   once its change is made the work that does in it, or -1 where either is rounding; the
   residual's norm at the last y that stayed; the last change by each coordinate's size, and what
   rounding makes of one, see gvi__newton_update; how often no change was less than half of the
   least; is there a matrix that will do, is it new (1) and was the last one (2); how often was
   the last change halved, or -1: none to take back; did that change move the residual by half of
   itself, or is the residual rounding?  Since a change was taken for rounding, did one fall (1),
   one rise (2), and was one a few last places (4)?                                            */
typedef struct gvi__descent {
    gvi_real before, earlier, least, rho, left, work, norm, each, grain;
    int      stagnant, have, fresh, halves, holds, ways;
} gvi__descent;

/* What is held plugs in here: its count of unknowns; g and forces at y; what they add to row k of
   coordinate i; its own rows; its part of the matrix; the row of it that is singular; unknowns to
   begin with; the start of a step, its end, and the momenta that it brings.                   */
#ifndef GVI_NO_CONSTRAINTS
static size_t gvi__con_unknowns(const gvi_stepper *st);
static int gvi__con_rows(const struct gvi__private *in);        // on or off
static gvi_status gvi__con_values(gvi_stepper *st, const gvi__origin *from);
static void gvi__con_force(const gvi_stepper *st, int i, int k, gvi_real *force, gvi_real *size);
static gvi_real gvi__con_residual(gvi_stepper *st, gvi__descent *p, gvi_real *moved,
                                   gvi_real *before);
static gvi_status gvi__con_matrix(gvi_stepper *st, const gvi__matrix *J);
static gvi_status gvi__con_report(gvi_stepper *st, gvi_status status, int at);
static void gvi__con_guess(const gvi_stepper *st, gvi_real *y);
static gvi_status gvi__con_begin(gvi_stepper *st, const gvi__origin *from, gvi_real *v);
static gvi_status gvi__con_end(gvi_stepper *st);
static void gvi__constraint_momenta(gvi_stepper *st);
#else
#define gvi__con_unknowns(st) ((size_t)0)
#define gvi__con_rows(in) 0
#define gvi__con_values(st, from) GVI_OK
#define gvi__con_force(st, i, k, force, size) ((void)0)
#define gvi__con_residual(st, p, moved, before) 0
#define gvi__con_matrix(st, J) GVI_OK
#define gvi__con_report(st, status, at) (status)
#define gvi__con_guess(st, y) ((void)0)
#define gvi__con_begin(st, from, v) GVI_OK
#define gvi__con_end(st) GVI_OK
#define gvi__constraint_momenta(st) ((void)0)
#endif

static size_t gvi__unknowns(const gvi_stepper *st, int k0)
{
    return (size_t)(st->s - k0)*(size_t)st->n + gvi__con_unknowns(st);
}

// that of steps; that of queries, which must not touch what steps keep
static gvi__matrix gvi__newton_matrix(const gvi_stepper *st, int query, int halves)
{
    const struct gvi__newton *newton = &st->in.newton;
    const size_t all = gvi__unknowns(st, 0), n = (size_t)st->n, second = query ? 1 : 0;
    const gvi__matrix J = { newton->J + second*all*all, newton->pivot + second*(all + 1), NULL, 0,
                            0, halves, newton->unit + second*(all - (size_t)st->s*n),
                            newton->scale + second*n };
    return J;
}

// what a solution of length h needs: weights and times of the points
static void gvi__newton_points(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    gvi__weights_for(st, h);
    gvi__times(st->in.R, from->t, from->t_low, h, st->in.table.c, st->in.t);
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
    gvi_points at = gvi__points_at(st, st->r, R, in->t, in->work.Q, in->work.F, in->newton.P);
    at.v = in->work.V;
    const gvi_status status = gvi__evaluate(st, &at, 0, 1);
    return status == GVI_OK && gvi__con_unknowns(st) > 0 ? gvi__con_values(st, from) : status;
}

/* dy and residual := -(1).  The weights of P are h b_i/h, those that F has, and Phi_0 = c is on
   its grid: then the rows are exactly those of a discrete action, also as rounded.  Returns the
   norm, the sum of magnitudes over sqrt M_ii: rows of (1) are momenta, so that has one unit for
   all coordinates.  M is that of the first y.                                                 */
static gvi_real gvi__residual(gvi_stepper *st, const gvi__origin *from, const gvi__matrix *J,
                              gvi__descent *p)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, k0 = J->k0, first = !(p->norm < GVI__MAX),
              none = st->in.desc.mass.kind == GVI_MASS_NONE,
              constrained = gvi__con_unknowns(st) > 0;
    const gvi_real h = in->sized.h;
    gvi_real norm = 0, moved = 0, before = 0;

    p->work = 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real *P = in->newton.P + i*R, *F = in->work.F + i*R;
        gvi_real length = 0, change = 0, was = 0, momenta = 0;
        for (int k = k0; k < st->s; ++k) {
            // P - p is summed where p occurs: the rounding of P then is not in the sum
            const gvi_real base = k == 0 ? from->p[i] : 0;
            gvi_real momentum = k == 0 ? -(h*from->p_low[i]) : 0, force = 0, size = 0, forces = 0;
            for (int j = 0; j < st->r; ++j) {
                const gvi_real phi = in->table.phi[k*R + j],
                               w = (k == 0 ? 1 : 0) - in->table.Phi[k*R + j];
                const gvi_real b = w*(in->sized.hb[j]*F[j]);
                momentum += phi*(in->sized.hb[j]*(P[j] - base));
                force += b;
                size += GVI_ABS(phi*(in->table.b[j]*P[j]));
                forces += GVI_ABS(b);
            }
            momenta = gvi__larger(size, momenta);
            if (constrained) gvi__con_force(st, i, k, &force, &forces);
            size += forces;
            const gvi_real sum = momentum/h - force;
            gvi_real *rest = in->newton.residual + (k - k0)*n + i;
            const gvi_real now = -(gvi_real)(2*k + 1)*sum;
            change += GVI_ABS(now - *rest);
            was += GVI_ABS(*rest);
            length += GVI_ABS(now);
            in->newton.dy[(k - k0)*n + i] = *rest = now;
            if (size > 0 && GVI_ABS(sum)/size > p->work) p->work = GVI_ABS(sum)/size;
        }
        in->watch.change[i] = momenta;
        if (first) {
            gvi_real *unit = in->watch.scale + i;
            *unit = none && J->scale ? J->scale[i] : 0;
            if (!(*unit > 0)) *unit = 1/GVI_SQRT(gvi__place_inertia(st, i));
        }
        norm += length*in->watch.scale[i];
        moved += change*in->watch.scale[i];
        before += was*in->watch.scale[i];
    }

    if (constrained) norm += gvi__con_residual(st, p, &moved, &before);
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
        const gvi_real w = (k == 0 ? 1 : 0) - Phi[k*R];
        const gvi_real a = (gvi_real)(2*k + 1)
                           * (in->table.b[point]*phi[k*R]*p - in->sized.hb[point]*w*f);
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
        if ((in->desc.mass.kind <= GVI_MASS_DENSE))
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
    return gvi__evaluate(st, &at, ~gvi__with_hessian(in, 0), in->desc.mass.kind > GVI_MASS_DENSE);
}

/* What coordinate i moves in a step: h v or h p/M_ii, which differences of p have to show beside a
   term A.v; or eps^(1/4) of its position where that is more; or where it is at rest at 0,
   h^2 f/M_ii.  For its velocity h v, h p/M_ii or h^2 f/M_ii, whichever is more.  (f near a pole
   takes positions too far.)                                                                   */
static gvi_real gvi__move_of(const gvi_stepper *st, int i, int by_v)
{
    const struct gvi__private *in = &st->in;
    const gvi_real h = GVI_ABS(in->sized.h), small = by_v ? 0 : GVI_SQRT(GVI_SQRT(GVI__EPS)),
                   hw = h*in->watch.scale[i];
    gvi_real most = 0, by_force = 0;
    for (int k = i*in->R; k < i*in->R + st->r; ++k) {
        const gvi_real lengths[] = { h*GVI_ABS(in->work.V[k]), small*GVI_ABS(in->work.Q[k]),
                                     hw*GVI_ABS(in->newton.P[k])*in->watch.scale[i] },
                       f = hw*GVI_ABS(in->work.F[k])*hw;
        for (int l = 0; l < 3; ++l) if (lengths[l] > most) most = lengths[l];
        if (f > by_force && gvi__finite(f)) by_force = f;
    }
    return by_force > most && (by_v || !(most > GVI__MIN/GVI__EPS)) ? by_force : most;
}

/* The difference for coordinate j: sqrt(eps) of its reach, or of the largest where it has none,
   each times sqrt(M_ii); or for its velocity, that over h.                                    */
static gvi_real gvi__difference(const gvi_stepper *st, int j, int by_v)
{
    const struct gvi__private *in = &st->in;
    const gvi_real root = GVI_SQRT(GVI__EPS), none = GVI__MIN/GVI__EPS, h = GVI_ABS(in->sized.h);
    gvi_real step = root*gvi__move_of(st, j, by_v);
    if (!(step > none))
        for (int i = 0; i < st->n; ++i) {
            const gvi_real other = root*gvi__move_of(st, i, by_v)
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
    const int n = st->n, R = in->R, nR = n*R, varies = in->desc.mass.kind > GVI_MASS_DENSE;
    const unsigned plain = gvi__with_hessian(in, 0);
    const int reads_v = varies || (plain & ~gvi__of_kind(in, GVI_POTENTIAL)) != 0;
    gvi_real *F = in->newton.moved, *P = F + nR, *base_F = P + nR, *base_P = base_F + nR;

    if (!varies && !plain) return GVI_OK;
    gvi_status status = gvi__evaluate_plain(st, base_F);
    if (status != GVI_OK) return status;

    // of each coordinate q, then v
    for (int k = 0; k < 2*n; k += 2 - reads_v) {
        const int j = k/2, by_v = k % 2;
        gvi_real *row = in->work.Q + j*R, *was = in->set_up;
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

/* A Lagrangian whose d2L/dv2 is singular (linear in v, a coordinate without mass) would make (1)
   solvable all the same, and its solution worthless.                                         */
static gvi_status gvi__check_regular(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    gvi_real *q = in->answer, *v = q + n;
    if (in->desc.mass.kind <= GVI_MASS_DENSE && !in->adds_p) return GVI_OK;
    gvi__gather(n, in->R, in->work.Q, q);
    gvi__gather(n, in->R, in->work.V, v);
    gvi_points y = gvi__one_point(st, in->t, q);
    return in->adds_p ? gvi__factor_hessian(st, &y, v) : gvi__factor_mass(st, &y);
}

static gvi_status gvi__jacobian_fill(gvi_stepper *st, const gvi__matrix *J)
{
    const size_t n = (size_t)st->n, size = gvi__unknowns(st, J->k0);
    gvi__zero(size*(size + (J->ends ? 2*n : 0)), J->square);
    gvi_status status = gvi__check_regular(st);
    if (status == GVI_OK) status = gvi__jacobian_exact(st, J);
    if (status == GVI_OK && gvi__con_unknowns(st) > 0) status = gvi__con_matrix(st, J);
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

    if (J->scale) gvi__copy((size_t)n, st->in.watch.scale, J->scale);
    status = gvi__lu_factor(size, J->square, J->pivot, &at);
    gvi__count(&st->counters.factorizations, 1);
    if (status == GVI_OK) return GVI_OK;
    if (at >= modes) return gvi__con_report(st, status, at - modes);
    return gvi__report(st, status, GVI_FAULT_NONE, at < 0 ? GVI_FAULT_NONE : at % n,
                       GVI_FAULT_NONE);
}

// y := modes of V as the predictor continues it; values get that V
static void gvi__newton_modes(gvi_stepper *st, const gvi_real *V, gvi_real *values)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, R = in->R;
    gvi__sums(st, in->predictor.one, V, values, 0);
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < s; ++k)
            in->set_up[k] = gvi__dot3(st->r, in->table.phi + k*R, in->table.b, values + i*R);
        gvi__over_gamma(st, in->set_up);
        for (int k = 0; k < s; ++k) in->newton.y[k*n + i] = in->set_up[k];
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
    if (gvi__con_unknowns(st) > 0) gvi__con_guess(st, y + st->s*st->n);
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
        // y may land on 0, or be small beside a term A.v
        const gvi_real terms = in->adds_p ? in->watch.change[i]*unit*unit : 0,
                       least = gvi__larger(terms, GVI__EPS*change);
        if (!(size <= none && change <= none)) sum += change/gvi__larger(size, least);
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
    if (gvi__con_unknowns(st) == 0 || !(length > none)) return sum;
    if (largest > h*length) p->grain *= largest/(h*length);
    return all/length;
}

// what later verdicts ask of this change: the contraction, and whether it still shrinks
static void gvi__newton_note(gvi_stepper *st, gvi__descent *p, gvi_real change, gvi_real noise)
{
    const gvi_real before = p->before;
    const int sure = p->work >= 0;                 // not rounding
    if (sure && p->earlier > 0 && change > GVI__SURE*GVI__EPS) {
        const gvi_real contraction = GVI_SQRT(change/p->earlier);
        st->counters.worst_contraction = gvi__larger(contraction, st->counters.worst_contraction);
    }

    const int stagnant = before > 0 && change > p->least/2, at_floor = p->left < GVI__MAX;
    p->stagnant = stagnant ? p->stagnant + 1 : 0;
    if (before > 0 && !stagnant && !at_floor && (sure || change < p->rho*p->least))
        p->rho = change/p->least;
    p->least = gvi__smaller(change, p->least);

    if (before > 0 && change > noise && sure)
        st->in.newton.bend = gvi__larger(change/before, st->in.newton.bend);
}

/* Is it rounding?  It is if y, q or the residual is, once the contraction was seen or it does not
   shrink; and if it does not, though small, with a matrix that is new or has contracted here: an
   older one can repeat any change.  What is left of the error, p->left, was no more than the change
   before times the contraction then, and shrinks on by that.  What is more than the rounding of y
   has to rise and to fall: only falling, it converges, if slowly; only rising, it diverges.  And
   once it is not small it was no rounding, unless one was a few last places.                  */
static int gvi__newton_at_floor(gvi__descent *p, gvi_real change, gvi_real noise)
{
    const gvi_real quarter = GVI__CONTRACTS, rho = gvi__smaller(p->rho, quarter);
    const int fresh = p->fresh & 1, contracts = p->rho < quarter, still = p->stagnant > 0,
              last_places = change <= noise || p->work < 0,
              small = last_places || change <= GVI_SQRT(GVI__EPS),
              proven = (last_places || (small && fresh)) && ((fresh && p->holds) || contracts),
              rounding = p->work < 0 ? still || contracts : still && proven;

    if (!small && p->ways < 4) {
        p->left = GVI__MAX;
        p->ways = 0;
    } else if (!(p->left < GVI__MAX) && rounding) p->left = gvi__smaller(change, p->before*rho);
    if (!(p->left < GVI__MAX)) return 0;

    const int falls = change <= p->before, rises = change >= p->before;
    p->ways |= last_places ? 7 : falls | rises << 1;
    p->left *= rho;
    return 1;
}

/* The verdict on a change.  To shrink is to be at most half of the least so far: what is rounded to
   a grid may circle among a few of its points, and fall in every iteration.  Nor is a fall from an
   overshoot far beyond the size of y a contraction.  One ratio by an old matrix may be luck: unless
   the change is rounding, the one before must agree (make everyday, in long double).          */
static int gvi__newton_converged(gvi_stepper *st, const gvi__matrix *J, gvi__descent *p,
                                 gvi_real change)
{
    const gvi_real all = (gvi_real)st->n, quarter = GVI__CONTRACTS,
                   noise = GVI__GRAIN*p->grain*(gvi_real)((st->s - J->k0)*st->n),
                   enough = gvi__larger(st->in.desc.tolerance, GVI__NEWTON_ENOUGH);
    gvi_real ratio = 1, other = 1;

    if (!gvi__finite(change)) return GVI__NOT_FINITE;
    st->in.newton.noise = noise;
    if (p->before > 0) ratio = change/gvi__smaller(p->before, all);
    if (p->earlier > 0) other = p->before/gvi__smaller(p->earlier, all);
    gvi__newton_note(st, p, change, noise);
    const int at_floor = gvi__newton_at_floor(p, change, noise), contracts = p->rho < quarter;

    const int confirmed = (p->fresh & 1 && p->holds) || change <= noise || change*other <= enough;
    const int done = (p->each*ratio <= enough && confirmed) || (p->left <= enough && p->ways >= 3);
    if (done && (p->holds || contracts)) return GVI__DONE;

    // rounding by a matrix that has contracted here asks for no other
    if (!at_floor && !(p->work < 0 && contracts) && p->before > 0 && ratio > quarter) p->have = 0;
    p->earlier = p->before;
    p->before = change;
    return GVI__GO_ON;
}

/* Does y, whose residual has that norm, stay?  A change that is not small and has not reduced the
   residual is taken back, for a new matrix; or halved, if the matrix was new.  Where six halvings
   have not helped, the whole change stands: across a kink, or from one curve to the next, the way
   down may lead up first.                                                                     */
static int gvi__newton_stays(gvi_stepper *st, const gvi__matrix *J, gvi__descent *p, gvi_real norm)
{
    enum { HALVES = GVI__NEARER };
    const int at_floor = p->left < GVI__MAX, fresh = p->fresh & 1;
    if (J->halves && p->halves >= 0 && p->halves <= HALVES && !(norm < p->norm) && !at_floor
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
    if (!at_floor) p->norm = norm;
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
        0, 0, GVI__MAX, GVI__CONTRACTS, GVI__MAX, 0, GVI__MAX, 0, 0, 0, 0, 0, -1, 0, 0
    };
    p.have = kept && !gvi__nonzero(in->newton.h - in->sized.h);
    in->newton.bend = 0;
    for (int k = 0, made = 0, verdict = GVI__GO_ON; k <= in->desc.max_iterations; ++k) {
        gvi_status status = gvi__newton_values(st, from);
        // one more evaluation, then done
        if (status != GVI_OK || verdict == GVI__DONE) return status;
        if (!gvi__newton_stays(st, J, &p, gvi__residual(st, from, J, &p))) continue;
        p.fresh = (p.fresh & 1) << 1 | !p.have;
        if (!p.have) {
            // without that, hopeless steps of an orbit by a dial of 1e-3 take twice as long
            if (++made > in->desc.max_iterations/4 + 2) break;
            status = gvi__jacobian(st, J);
            if (status != GVI_OK) return status;
            p.have = 1;
            if (kept) in->newton.h = in->sized.h;
        }
        // a matrix of differences alone is right
        if (made) p.holds |= !gvi__with_hessian(in, 1);
        gvi_lu_solve(size, J->square, J->pivot, in->newton.dy);
        for (int z = modes; z < size; ++z) in->newton.dy[z] *= J->unit[z - modes];
        gvi__count(&st->counters.newton_iterations, 1);
        verdict = gvi__newton_converged(st, J, &p, gvi__newton_update(st, from, J, &p));
        if (verdict == GVI__NOT_FINITE)
            return gvi__report_status(st, GVI__LOOKS(st) ? GVI_E_CONVERGENCE : GVI_E_NON_FINITE);
        p.halves = 0;
    }

    return gvi__report_status(st, GVI_E_CONVERGENCE);
}

/* The sign of the determinant of a matrix.  Where the iteration contracts, that of the solution
   has the same sign; along a branch of solutions it changes where they turn back in h.  (make
   hard-roots)                                                                                 */
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
        gvi__zero((size_t)s, in->set_up);
        for (int j = 0; j < st->r; ++j) {
            gvi_real V = 0, P = 1, before = 1;
            for (int k = 0; k < s; ++k) {
                V += in->newton.y[k*n + i]*P;
                gvi__legendre(k, 1 - 2*part*in->table.c[j], &P, &before);
            }
            for (int k = 0; k < s; ++k) in->set_up[k] += in->table.phi[k*R + j]*(in->table.b[j]*V);
        }
        gvi__over_gamma(st, in->set_up);
        for (int k = 0; k < s; ++k)
            in->newton.y[k*n + i] = in->set_up[k] + (1 - part)*slope[k*n + i];
    }
}

/* How far is y from `other`? The largest distance of a coordinate, in units of its own size there
   and at h, but no less than 1/32 of the largest, each times sqrt(M_ii).                     */
static gvi_real gvi__newton_distance(const gvi_stepper *st, const gvi_real *other)
{
    const struct gvi__private *in = &st->in;
    gvi_real distance = 0, most = 0, *moved = in->answer, *size = moved + st->n;
    for (int i = 0; i < st->n; ++i) {
        moved[i] = size[i] = 0;
        for (int k = i; k < st->s*st->n; k += st->n) {
            moved[i] += GVI_ABS(in->newton.y[k] - other[k])/in->watch.scale[i];
            size[i] += (GVI_ABS(in->newton.found[k]) + GVI_ABS(other[k]))/in->watch.scale[i];
        }
        most = gvi__larger(size[i], most);
    }

    if (!(most > 0)) return 0;
    for (int i = 0; i < st->n; ++i) {
        const gvi_real far = moved[i]/(size[i] + GVI__CLOSE*most);
        if (!(far <= distance)) distance = far;
    }
    return distance;
}

/* Is the solution y the motion's, the one that free motion turns into as h grows from 0? It is
   followed back to shorter steps, from length to length by a prediction: the same curve, changed
   as it changed last.  From a continuous branch the prediction is not far when the lengths are
   close; where it is however close they are, the branch has turned back.  A length is enough
   where the iteration contracts well from constant velocity, h/32 in any case.  If it then comes
   to the same solution, or to none, y is accepted.  Under constraints rounding of g is in every
   solution, and all of it where a step moves by roundings of q: what it makes counts as not far. */
static gvi_status gvi__newton_connected(gvi_stepper *st, const gvi__origin *from,
                                        const gvi__matrix *J)
{
    struct gvi__newton *newton = &st->in.newton;
    const size_t all = gvi__unknowns(st, 0), modes = (size_t)(st->s*st->n);
    const gvi_real h = st->in.sized.h, close = GVI__CLOSE;
    const unsigned count = (unsigned)st->counters.newton_iterations,
                   enough = 32*(unsigned)st->in.desc.max_iterations;
    const int sign = gvi__orientation(J, all);
    const gvi__matrix K = gvi__newton_matrix(st, 1, 0);
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
        gvi__newton_points(st, from, h*(part*factor));
        const int found =
            gvi__newton_solve(st, from, &K) == GVI_OK && gvi__orientation(&K, all) == sign;
        const gvi_real distance = found ? gvi__newton_distance(st, newton->guess) : 1,
                       within = gvi__larger(close, newton->noise);
        if (!found || !(distance <= within)) {
            factor = GVI_SQRT(factor);
            if (factor > (gvi_real)0.9998) right = 0;            // 2^(-1/4096)
            continue;
        }
        part *= factor;
        gvi__copy(all, newton->y, newton->branch);
        for (size_t k = 0; k < modes; ++k)
            newton->slope[k] += (newton->y[k] - newton->guess[k])/(1 - factor);
        if (factor > (gvi_real)0.5) {
            if (distance < within/4) factor *= factor;     // twice as far, a square of that
            continue;
        }
        gvi__newton_guess(st, 0);
        const int other = gvi__newton_solve(st, from, &K) == GVI_OK;
        if ((other && newton->bend <= close) || part < close)
            right = !other || gvi__newton_distance(st, newton->branch) <= within;
    }

    gvi__newton_points(st, from, h);
    gvi__copy(all, newton->found, newton->y);
    return right ? gvi__newton_values(st, from) : gvi__report_status(st, GVI_E_CONVERGENCE);
}

// Newton's method begins at: constant velocity; extrapolated modes; constant velocity, with halving
enum { GVI__PLAIN, GVI__EXTRAPOLATED, GVI__HALVED };

/* Newton's method for a step.  A solution is taken for the motion's where the iteration contracts
   well from its start and the orientation is that of free motion; or else it is followed back. */
static gvi_status gvi__newton_step(gvi_stepper *st, const gvi__origin *from, int how, int query)
{
    struct gvi__private *in = &st->in;
    const size_t all = gvi__unknowns(st, 0);
    gvi__matrix J = gvi__newton_matrix(st, query, how == GVI__HALVED);

    // few points see little of what is between
    const gvi_real far = st->s > 2 ? GVI__CONTRACTS : GVI__CLOSE;
    int old = !query && !gvi__nonzero(in->newton.h - in->sized.h);
    gvi_real *v = in->answer + 2*st->n;
    gvi_status status = GVI_OK;
    gvi__velocity_guess(st, v);
    if (gvi__con_unknowns(st) > 0) status = gvi__con_begin(st, from, v);
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

    if (status == GVI_OK && gvi__con_unknowns(st) > 0) status = gvi__con_end(st);
    if (status != GVI_OK) return status;

    // it made none to go on from
    if (gvi__rows_of_A(in)) gvi__zero((size_t)(st->n*in->R), gvi__rows_of_A(in));
    for (int i = 0; i < st->n; ++i) {
        const gvi__two q = gvi__two_prod(in->sized.h, in->newton.y[i]);
        in->step.q[i] = q.hi;
        in->step.q_low[i] = gvi__low(q.lo + from->q_low[i]);
    }

    gvi__sum_rows(st, in->work.F, from->p_low, in->step.p, in->step.p_low);
    if (gvi__con_unknowns(st) > 0) gvi__constraint_momenta(st);
    return GVI_OK;
}

/* ---- as a solver ---- */

/* After a fixed point, if nothing is pinned and there is no clock: where its matrices are small,
   s n <= 1024.  Under constraints a step mostly fails because rows turn far in it, and a shorter
   one has no need of Newton: there LU, (s (n + m))^3/3, may cost as much as halving h four times,
   16 steps of 60 iterations of s^2 n.                                                          */
GVI__COLD int gvi__newton_follows(const struct gvi__private *in, int m)
{
    const gvi_desc *d = &in->desc;
    const gvi_real n = (gvi_real)d->n, all = n + (gvi_real)m;
    if (d->formulation != GVI_AUTO || in->stages == 0 || in->chosen == GVI_NEWTON) return 0;
    if (d->iterations > 0 || gvi__of_kind(in, GVI_CLOCK) || d->degree > 1024/d->n) return 0;
    return m == 0 || (gvi_real)d->degree*(all*all*all) <= 3*16*60*n;
}

GVI__COLD void gvi__newton_layout(struct gvi__private *in, int m, gvi__arena *a)
{
    struct gvi__newton *newton = &in->newton;
    const size_t n = (size_t)in->desc.n, s = (size_t)in->desc.degree,
                 R = (size_t)GVI__ROW(in->desc.rule.points), sm = s*(size_t)m, N = s*n + sm;
    gvi_real **const unknowns[] = {
        &newton->y, &newton->dy, &newton->residual, &newton->last,
        &newton->found, &newton->branch, &newton->guess, &newton->slope
    };
    if (in->stages == 1) {                        // V, from the modes
        in->work.V = gvi__take(a, n, R);
        in->last.V = gvi__take(a, n, R);
        in->older.V = gvi__take(a, (in->desc.rule.points < 10 && GVI__DIG > 24)*n, R);
    }

    newton->P = gvi__take(a, n, R);
    newton->moved = gvi__take(a, 4*n, R);
    newton->hessian = gvi__take(a, 3*n, n);
    for (int k = 0; k < 8; ++k) *unknowns[k] = gvi__take(a, 1, N);
    newton->pivot = gvi__take(a, 2, N + 1);                      // twice: queries must not touch
    newton->unit = gvi__take(a, 2, sm);                          // what the steps keep
    newton->scale = gvi__take(a, 2, n);
    in->cleared = a->used;                                       // J is written first
    newton->J = gvi__take(a, 2*N, N);
}

// the scene's solver, extrapolated first; then from constant velocity with halving
static gvi_status gvi__by_newton(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query)
{
    struct gvi__private *in = &st->in;
    const unsigned count = (unsigned)st->counters.newton_iterations;
    const int usable = in->kept > 0 && h/st->h > -GVI__BACK && h/st->h < GVI__AHEAD,
              extrapolated = usable && in->has_velocity;

    st->formulation = GVI_NEWTON;
    gvi__newton_points(st, from, h);
    if (usable) gvi__prepare_predictor(st, h, query, 1);
    gvi_status status =
        gvi__newton_step(st, from, extrapolated ? GVI__EXTRAPOLATED : GVI__PLAIN, query);
    if (status == GVI_E_CONVERGENCE || status == GVI_E_SINGULAR
        || (status == GVI_E_CALLBACK && extrapolated)
        || (status == GVI_E_NON_FINITE && !GVI__LOOKS(st))) {
        if (!query) in->newton.h = 0;              // the extrapolation may be to blame
        status = gvi__newton_step(st, from, GVI__HALVED, query);
    }

    in->watch.found = in->watch.ratio;
    if (!query) st->iterations += (int)((unsigned)st->counters.newton_iterations - count);
    return status;
}

// in place of the fixed point, if it is the only solver or the fixed point has failed lately
static int gvi__newton_instead(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query,
                               gvi_status *status)
{
    struct gvi__newton *newton = &st->in.newton;
    if (st->in.chosen != GVI_NEWTON) {
        int left = newton->left;
        if (query || (st->in.stepped && gvi__nonzero(h - st->h))) left = 0;
        newton->next_left = left - (left > 0);
        if (left == 0) return 0;
    }
    if (!query) st->iterations = 0;
    *status = gvi__by_newton(st, from, h, query);
    return 1;
}

// where the fixed point has failed: for this step, and some more if that was no callback's doing
static gvi_status gvi__newton_turn(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query,
                                   gvi_status status)
{
    if (!query) {
        st->in.newton.next_left = 0;
        if (status == GVI_E_CONVERGENCE || gvi__con_unknowns(st) > 0)
            st->in.newton.next_left = GVI__BY_NEWTON - 1;
        st->in.parts |= GVI__IN_NEWTON;
    }
    return gvi__by_newton(st, from, h, query);
}

// is it evaluated in the next step?
static void gvi__newton_listen(struct gvi__private *in)
{
    in->parts &= ~(unsigned)GVI__IN_NEWTON;
    if (in->chosen == GVI_NEWTON || in->newton.left > 0) in->parts |= GVI__IN_NEWTON;
}

static void gvi__newton_commit(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    if (st->formulation == GVI_NEWTON) in->has_velocity = 1;
    in->newton.left = in->newton.next_left;
    gvi__newton_listen(in);
}

// a step failed, or the scene has changed
static void gvi__newton_forget(gvi_stepper *st)
{
    st->in.newton.h = 0;
    gvi__newton_listen(&st->in);
}
#endif /* GVI_NO_NEWTON */

#ifndef GVI_NO_CONSTRAINTS
/* ----------------------------------------------------------- CONSTRAINTS

   g(t,q) = 0 at Lobatto's points d_0 = 0 .. d_s = 1, weights w_e.  What makes h sum_i b_i L_i
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
   D_0..D_s, rows of C; at one point, numbers at their beginning.  Rows off are left out.      */

// is a constraint on?
GVI__BODY int gvi__constrained(const gvi_stepper *st)
{
    return (gvi__parts(&st->in) & GVI__IN_CONSTRAINTS) && st->in.con.m > 0;
}

// does M^-1 couple all coordinates?
static int gvi__full_mass(const struct gvi__private *in)
{
    return in->desc.mass.kind >= GVI_MASS_DENSE || in->adds_p;
}

static unsigned gvi__constraints_on(const gvi_stepper *st) { return st->in.con.bits & ~st->in.off; }

// ROLLING plugs in here: does a row roll?  Its residual in place of g(D)
static int gvi__rolls(const gvi_stepper *st) { return st->in.rolling.bits != 0; }
static gvi_status gvi__rolling_values(gvi_stepper *st);

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
    if (gvi__rolls(st)) gvi__zero((size_t)(st->in.con.m*S), at.g);
    for (int a = 0; a < st->in.con.m; ++a)
        for (int i = gvi__column(st, a, 0), to; i < st->n; i = gvi__column(st, a, to)) {
            for (to = i + 1; gvi__column(st, a, to) == to && to < st->n; ++to) { }
            gvi__zero((size_t)((to - i)*S), G + (size_t)(a*st->n + i)*(size_t)S);
        }
    if (GVI__LOOKS(st) && gvi__check_rows(st, &at, q, 0) != GVI_OK)
        return gvi__report_status(st, GVI_E_CONVERGENCE);
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        const gvi_effect *effect = st->in.desc.effects + e;
        if (!(gvi__constraints_on(st) >> e & 1u)) continue;
        gvi__count(&st->counters.effect[e], count);
        const int failed = effect->points(&at, effect->user);
        if (failed) return gvi__report_callback(st, failed, e);
        if (GVI__LOOKS(st)) {
            gvi_points points = at;
            points.n = effect->rows;
            status = gvi__check_rows(st, &points, at.g, e);
            if (status == GVI_OK) status = gvi__check_rows(st, &points, at.rate, e);
            if (status != GVI_OK) return status;
            points.n *= st->n;
            status = gvi__check_rows(st, &points, at.jacobian, e);
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
    if (S == 1 && in->adds_p) gvi__over_hessian(st, z);
    else if (in->desc.mass.kind != GVI_MASS_POSITION) gvi__over_mass(st, z, S, count);
    else gvi__ldl_solve(n, gvi__mass_at_points(in), S > 1 ? in->R : 1, z, S, count);
}

static int gvi__all_zero(const gvi_real *x)
{
    const gvi_real a = GVI_ABS(x[0]) + GVI_ABS(x[4]), b = GVI_ABS(x[1]) + GVI_ABS(x[5]),
                   c = GVI_ABS(x[2]) + GVI_ABS(x[6]), d = GVI_ABS(x[3]) + GVI_ABS(x[7]);
    return (a + b) + (c + d) <= 0;
}

/* The columns of each row in which G has had an entry other than 0.  They are looked for at the
   ends of steps, and within the first step after a start; a step at whose end there are new ones
   is done again.  An entry that is 0 at both ends of a later step counts as 0 inside.  first[a]:
   the first row that shares a coordinate with row a, where L begins; with a full M all rows do. */
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

// G_j M^-1 G_j' of a row that is kept; 0 of one that is left out
static gvi_real gvi__entry(const gvi_stepper *st, int S, int j, const gvi_real *A)
{
    const int m = st->in.con.m;
    if (!gvi__nonzero(A[(j*m + j)*S])) return 0;
    gvi_real entry = 1/A[(j*m + j)*S];
    for (int k = (int)st->in.con.first[j]; k < j; ++k) entry += A[(j*m + k)*S]*A[(k*m + j)*S];
    return entry;
}

/* c := row i of L^-1, to con.y: of all c G with c_i = 1 that of the rows before i which leaves the
   least.  Returns what these put into it, the sum of c_l^2 G_l M^-1 G_l', l < i.              */
GVI__COLD gvi_real gvi__combine(const gvi_stepper *st, int S, int i, const gvi_real *A)
{
    const int m = st->in.con.m;
    gvi_real *c = st->in.con.y, sum = 0;
    gvi__zero((size_t)i, c);
    c[i] = 1;
    for (int j = i; j >= 0; --j) {
        for (int l = (int)st->in.con.first[j]; l < j; ++l) c[l] -= A[(j*m + l)*S]*c[j];
        if (j < i) sum += c[j]*c[j]*gvi__entry(st, S, j, A);
    }
    return sum;
}

/* Row i depends: c G = 0.  The row to leave out is the one with the largest part in that: without
   one whose part is 0, as at some angles of a linkage, the others still depend.  The last, unless
   another's is twice as large: rows that change often cost digits.                            */
GVI__COLD int gvi__spare(const gvi_stepper *st, int S, int i, gvi_real entry, const gvi_real *A)
{
    const gvi_real *c = st->in.con.y;
    gvi_real most = 4*entry;
    int spare = i;
    (void)gvi__combine(st, S, i, A);
    for (int l = i; l-- > 0; ) {
        const gvi_real part = c[l]*c[l]*gvi__entry(st, S, l, A);
        if (!(part > most)) continue;
        most = part;
        spare = l;
    }
    return spare;
}

/* Column i of D L': G_j M^-1 G_i', less what the rows before j make of it, for j up to i.  scratch,
   here - M^-1 G_i', is 0 before and behind.                                                   */
static void gvi__gram_column(const gvi_stepper *st, int S, int count, const gvi_real *G,
                             gvi_real *A, int i)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, full = gvi__full_mass(in), from = (int)in->con.first[i];
    gvi_real *scratch = in->con.scratch;

    for (int j = gvi__column(st, i, 0); j < n; j = gvi__column(st, i, j + 1)) {
        const gvi_real *g = G + (i*n + j)*S, inverse = full ? 1 : in->mass.inverse[j];
        for (int k = 0; k < count; ++k) scratch[j*S + k] = -(g[k]*inverse);
    }
    if (full) gvi__over_inertia(st, scratch, S, count);
    for (int j = from; j <= i; ++j) {
        gvi_real *u = A + (j*m + i)*S;
        for (int k = 0; k < count; ++k) u[k] = 0;
        for (int l = gvi__column(st, j, 0); l < n; l = gvi__column(st, j, l + 1))
            gvi__subtract_at(S, count, G + (j*n + l)*S, scratch + l*S, u);
        if (j == i) break;
        int l = (int)in->con.first[j];
        if (l < from) l = from;
        for (; l < j; ++l) gvi__subtract_at(S, count, A + (j*m + l)*S, A + (l*m + i)*S, u);
    }
    if (full) gvi__zero((size_t)(n*S), scratch);
    for (int j = gvi__column(st, i, 0); j < n; j = gvi__column(st, i, j + 1))
        for (int k = 0; k < count; ++k) scratch[j*S + k] = 0;
}

/* Row i of L and its pivot at point k.  Does the row depend?  A pivot of 64 m roundings, its own
   and those of the rows that it is made of, says so.                                          */
static int gvi__gram_pivot(const gvi_stepper *st, int S, gvi_real *A, int i, gvi_real *pivot)
{
    const int m = st->in.con.m, from = (int)st->in.con.first[i];
    const gvi_real was = GVI_ABS(A[(i*m + i)*S]);
    gvi_real rest = A[(i*m + i)*S], size = was;
    for (int j = from; j < i; ++j) {
        const gvi_real u = A[(j*m + i)*S], l = u*A[(j*m + j)*S];
        A[(i*m + j)*S] = l;
        rest -= l*u;
    }
    for (int j = from; j < i && GVI_ABS(rest)*(GVI__LOST*GVI__LOST) < was; ++j) {
        const gvi_real l = A[(i*m + j)*S];
        size += l*l*gvi__entry(st, S, j, A);
    }
    *pivot = rest;
    return !(GVI_ABS(rest) > GVI__GRAIN*(gvi_real)m*GVI__EPS*size);
}

/* A := L D L' of G M^-1 G' in its envelope, L below the diagonal, 1/D on it and D L' above it; M(q)
   is that of the stage values, one for one, or of the one point.  At one point a row that depends
   on those before it, or the spare one of these, is left out: 1/D and its L are 0, and so is its
   multiplier; drops[a] is what the diagonal entry was, or 0 for a row that is kept.  At more points
   the same rows are left out, and the rest has to have full rank.                             */
static gvi_status gvi__factor_rows(gvi_stepper *st, int S, int count, const gvi_real *G,
                                   gvi_real *A, gvi_real *drops)
{
    const int m = st->in.con.m;
    gvi__zero((size_t)(st->n*S), st->in.con.scratch);
    gvi__zero((size_t)(count == 1 ? m : 0), drops);
    for (int i = 0; i < m; ++i) {
        int spare = i;
        gvi_real *d = A + (i*m + i)*S, rest;
        gvi__gram_column(st, S, count, G, A, i);
        for (int k = 0; k < count; ++k) {
            const gvi_real was = GVI_ABS(d[k]);
            const int depends = gvi__gram_pivot(st, S, A + k, i, &rest);
            if (!(was <= GVI__MAX) || !gvi__finite(rest))
                return gvi__report_status(st, GVI_E_NON_FINITE);
            if (count == 1 && depends && !(drops[i] > 0)) spare = gvi__spare(st, S, i, was, A);
            if (count == 1 && (depends || drops[i] > 0)) drops[spare] = was;
            if (spare < i) break;
            d[k] = drops[i] > 0 ? 0 : 1/rest;
            if (!gvi__finite(d[k]) || (depends && !(drops[i] > 0)))
                return gvi__report_row(st, GVI_E_SINGULAR, i, k);
        }
        if (spare < i) i = spare - 1;              // again from there, without it
    }

    return GVI_OK;
}

// the first of the points says which rows are left out
static gvi_status gvi__factor_constraints(gvi_stepper *st, int S, int count, const gvi_real *G,
                                          gvi_real *A, gvi_real *drops)
{
    const gvi_status status = gvi__factor_rows(st, S, 1, G, A, drops);
    if (status != GVI_OK || count == 1) return status;
    return gvi__factor_rows(st, S, count, G, A, drops);
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
    gvi_real *G = st->in.con.G1;
    gvi_points at = gvi__one_point(st, &t, q);
    gvi_status status = gvi__evaluate_constraints(st, 1, 1, &t, q, G);
    if (status == GVI_OK && (drops != st->in.con.drops || !st->in.con.settled))
        st->in.con.again |= gvi__find_columns(st, 1, 1, G);
    if (status == GVI_OK && st->in.adds_p) {
        if (p) status = gvi__velocity(st, t, q, p, v);
        if (status == GVI_OK) status = gvi__factor_hessian(st, &at, v);
    } else if (status == GVI_OK && st->in.desc.mass.kind == GVI_MASS_POSITION)
        status = gvi__factor_mass(st, &at);
    if (status != GVI_OK) return status;
    return gvi__factor_constraints(st, 1, 1, G, st->in.con.gram1, drops);
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

/* Free motion and times of D; what impulses add to the stages.  P or V is not judged: lambda turns
   the rounding of D into X eps/h, across the constraints, where no motion feels it.           */
GVI__CALLED void gvi__constraint_stages(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                        gvi__stage *stage)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R, Q = in->con.Q;
    in->con.made = in->con.linear = 0;
    if (!gvi__constrained(st)) return;
    gvi__constraint_points(st, from, h);
    for (int k = 0; k < in->stages - Q; ++k) stage[k].plus = in->con.plus + k*n*R;
    if (in->stages == 2 && !gvi__rolls(st)) {
        gvi__stage *y = stage + !Q;
        y->quiet = 1;
        gvi__zero((size_t)n, y->scale);
        gvi__zero((size_t)n, y->change);
        gvi__zero((size_t)n, in->watch.before + !Q*n);
    }

    for (int i = 0; i < n; ++i)                   // the path is in V, where Q is made of that
        gvi__free_row(R, from->q_low[i], Q ? 0 : in->free.path[i], Q ? 0 : in->free.path_low[i],
                      in->con.d + 1, in->con.free + i*R);
}

// values := sum over sources and their weights, or added to what is there
static void gvi__weighted_sums(const gvi_stepper *st, const gvi_real *table, const gvi_real *weight,
                               const gvi_real *source, gvi_real *scratch, gvi_real *values, int add)
{
    const int R = st->in.R;
    for (int i = 0; i < st->n; ++i) gvi__weigh(R, weight, source + i*R, scratch + i*R);
    gvi__sums(st, table, scratch, values, add);
}

// D, from what makes Q
GVI__CALLED void gvi__constraint_rows(const gvi_stepper *st, const gvi__stage *stage,
                                      const gvi_real *source)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    gvi_real *D = in->con.D, *scratch = in->con.plus;
    gvi__weighted_sums(st, in->con.by_force, in->sized.hb, source, scratch, D, 0);
    if (in->con.Q == 0) {
        gvi__weighted_sums(st, in->con.by_impulse, in->con.hw, in->con.force, scratch, D, 1);
        gvi__over_mass(st, D, R, R);
    }
    for (int i = 0; i < n*R; ++i) D[i] = in->con.free[i] + D[i]*stage[in->con.Q].factor;
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

/* The constraints at D, padded with q0.  g is linearised from the last D after a move along which G
   changed by less than EPS of it, or g by less than its rounding, which is what g is off the
   trapezoid of G; or after a move of EPS^(3/4) (not in float, where a step across a bifurcation
   would end on the wrong branch).  That rounding would change lambda for ever, and is not that of D
   where g has terms that G q does not show.                                                   */
static gvi_status gvi__evaluate_at_D(gvi_stepper *st, const gvi__origin *from)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R, C = in->con.C;
    const int linear = in->con.linear, rows = st->formulation != GVI_NEWTON ? m : 0;
    const gvi_real *G = in->con.G + 1, *moved = in->con.scratch;
    gvi_real *along = in->con.rho + m*R;

    for (int i = 0; i < n; ++i)
        for (int k = 0; k < C; ++k) {
            gvi_real *at = in->con.at + i*C + k;
            const gvi_real D = from->q[i] + (k > 0 && k <= s ? in->con.D[i*R + k - 1] : 0);
            if (k > 0) in->con.scratch[i*C + k - 1] = *at - D;
            *at = D;
        }
    gvi__zero((size_t)(m*C), along);              // by the old G
    for (int a = 0; a < rows; ++a) {
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            gvi__subtract_at(C, s, G + (a*n + i)*C, moved + i*C, along + a*C);
        for (int k = 0; k < s; ++k) in->con.rho[a*R + k] = in->con.g[a*C + k + 1] + along[a*C + k];
    }

    const gvi_status status =
        gvi__evaluate_constraints(st, C, s + 1, in->con.t, in->con.at, in->con.G);
    if (!in->con.settled && gvi__find_columns(st, C, s + 1, in->con.G)) in->con.made = 0;
    in->con.linear = in->con.made > 0;
    for (int a = 0; a < rows; ++a) {
        for (int k = 0; k < s && in->con.linear; ++k) {
            gvi_real change = along[a*C + k], size = 0;
            for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1)) {
                const gvi_real z = G[(a*n + i)*C + k]*moved[i*C + k];
                change += z;
                size += GVI_ABS(z);
            }
            const gvi_real off = in->con.g[a*C + k + 1] - (in->con.rho[a*R + k] - change/2);
            if (!(GVI_ABS(change) <= gvi__larger(GVI__EPS*size, GVI_ABS(off)))) in->con.linear = 0;
        }
        if (linear) gvi__copy((size_t)s, in->con.rho + a*R, in->con.g + a*C + 1);
    }

    in->con.made += 1;
    return status == GVI_OK && gvi__rolls(st) ? gvi__rolling_values(st) : status;
}

// the same, and A in the first iteration
GVI__CALLED gvi_status gvi__constraint_values(gvi_stepper *st, const gvi__origin *from)
{
    const struct gvi__private *in = &st->in;
    gvi_status status = gvi__evaluate_at_D(st, from);
    if (status != GVI_OK || in->con.made > 1) return status;
    status = gvi__factor_constraints(st, in->con.C, st->s, in->con.G, in->con.gram, in->con.drops);
    for (int a = 0; a < in->con.m; ++a)            // the guess is that of the rows of the last step
        if (in->con.drops[a] > 0) gvi__zero((size_t)in->R, in->con.force + (st->n + a)*in->R);
    return status;
}

// V of the P that F and lambda make, not of the step's own
static const gvi_real *gvi__pushed_velocities(gvi_stepper *st, const gvi__stage *stage)
{
    gvi_real *z = st->in.con.P;
#ifndef GVI_NO_MOMENTA
    struct gvi__private *in = &st->in;
    gvi_real *scratch = in->con.plus;
    gvi__weighted_sums(st, stage->table, in->sized.hb, stage->source, scratch, z, 0);
    gvi__weighted_sums(st, in->con.U, in->con.hw, in->con.force, scratch, z, 1);
    for (int i = 0; i < st->n; ++i)
        for (int k = i*in->R; k < (i + 1)*in->R; ++k)
            z[k] = stage->base[i] + (stage->free[k] + z[k]);
    gvi__velocity_rows(st, z, z);
    gvi__count(&st->counters.velocities, st->r);
#else
    (void)stage;
#endif
    return z;
}

// the new lambda, and forces.  With momenta D' needs the P and V of the new F
static void gvi__constrain(gvi_stepper *st, const gvi__stage *stage, const gvi_real *q0)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R, C = in->con.C;
    gvi_real *lambda = in->con.force + n*R, *rho = in->con.rho, *moved = in->con.scratch;

    gvi__constraint_forces(st);
    const gvi_real *source =
        in->con.Q > 0 ? gvi__pushed_velocities(st, stage) : stage[0].source;
    gvi__constraint_rows(st, stage, source);
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

    gvi__solve_constraints(st, in->con.gram, C, s, rho, R);
    for (int a = 0; a < m; ++a)
        for (int e = 0; e < s; ++e) lambda[a*R + e] += rho[a*R + e]/(in->sized.h*in->con.hw[e]);
    gvi__constraint_forces(st);
}

// after the last F: the lambda of that, and where V makes the end of q, the V of both
GVI__CALLED void gvi__place_last(gvi_stepper *st, const gvi__origin *from, const gvi__stage *stage)
{
    struct gvi__private *in = &st->in;
    if (!gvi__constrained(st)) return;
    gvi__constrain(st, stage, from->q);
    if (in->con.Q == 0) return;
    gvi__copy((size_t)(st->n*in->R), gvi__pushed_velocities(st, stage), in->work.V);
}

// before the rows: lambda, and what the impulses add to them
static void gvi__place_before_rows(gvi_stepper *st, const gvi__stage *stage)
{
    struct gvi__private *in = &st->in;
    if (!gvi__constrained(st)) return;
    const int Q = in->con.Q, nR = st->n*in->R;
    gvi_real *plus = in->con.plus, *scratch = in->con.D;
    if (in->con.made > 0) gvi__constrain(st, stage, stage[Q].base);
    gvi__weighted_sums(st, Q ? in->con.U : in->con.K, in->con.hw, in->con.force, scratch,
                       plus, 0);
    if (in->stages - Q == 2)
        gvi__weighted_sums(st, in->con.U, in->con.hw, in->con.force, scratch, plus + nR, 0);
}

static void gvi__place_behind_rows(gvi_stepper *st, const gvi__stage *stage, gvi_real sum)
{
    if (!gvi__constrained(st)) return;
    st->in.con.linear |=
        GVI__DIG > FLT_MANT_DIG && st->in.con.made > 0 && sum < GVI__EPS*GVI_SQRT(GVI__EPS);
    gvi__constraint_rows(st, stage, stage[st->in.con.Q].source);
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
            if (!(GVI_ABS(in->con.rho[m*R + a*C + k - 1]) <= 2*GVI__PLACE*GVI__EPS*terms))
                return;
        }
    gvi__force_sizes(st, in->con.rho, C, moved);
}

// E takes forces and lambda of the last step to alpha + beta d_e
static void gvi__place_predictor(gvi_stepper *st, gvi_real alpha, gvi_real beta)
{
    struct gvi__holonomic *con = &st->in.con;
    if (!gvi__constrained(st)) return;
    if (!gvi__nonzero(alpha - con->alpha) && !gvi__nonzero(beta - con->beta)) return;
    con->alpha = alpha;
    con->beta = beta;
    gvi__fit(st, st->s, con->d + 1, con->d, alpha, beta, 1, con->E);
}

// forces and lambda to begin with: those of the last step, extrapolated, or none
GVI__CALLED void gvi__predict_constraints(const gvi_stepper *st, int extrapolate)
{
    const struct gvi__private *in = &st->in;
    const int R = in->R, rows = st->n + in->con.m;
    gvi__zero((size_t)(rows*R), in->con.force);
    if (!extrapolate || in->con.kept < 2) return;
    for (int i = 0; i < rows; ++i)
        for (int e = 0; e < st->s && (i < st->n || !(in->con.drops[i - st->n] > 0)); ++e)
            in->con.force[i*R + e] = gvi__point_sum(st->s, R, in->con.E + e,
                                                   in->con.last + i*in->con.C + 1);
}

/* Under rows that roll, a P or V that is nothing but rounding is in every D: does another row still
   fall to a quarter, above its last places?                                                   */
GVI__CALLED int gvi__a_row_falls(const gvi_stepper *st)
{
    const gvi_real *change = st->in.watch.change, *before = st->in.watch.before,
                   place = GVI__PLACE*GVI__EPS, fall = GVI__CONTRACTS*GVI__CONTRACTS;
    for (int row = 0; row < st->in.stages*st->n; ++row)
        if (change[row] > place*place && change[row] < fall*before[row]) return 1;
    return 0;
}

/* What constraints add to the floor of coordinate i, whatever its amplitude, as a length: h^2/m
   times eps of the forces of its rows; and for `moves`, their last change where that came from the
   rounding of g, which nearly dependent rows make large.                                      */
static gvi_real gvi__place_floor(const gvi_stepper *st, gvi_real h, int i, gvi_real m,
                                gvi_real eps, int moves)
{
    const struct gvi__private *in = &st->in;
    gvi_real most = 0;
    if (!gvi__constrained(st)) return 0;
    if (i == 0) gvi__force_sizes(st, in->con.force + st->n*in->R, in->R, in->con.plus);
    if (i == 0 && moves) gvi__constraints_moved(st, in->con.scratch);
    for (int e = 0; e < st->s; ++e) {
        gvi_real force = eps*GVI_ABS(h*in->con.plus[i*in->R + e]);
        if (moves) force += in->con.scratch[i*in->con.C + e]/GVI_ABS(in->con.hw[e]);
        most = gvi__larger(GVI_ABS(h)*force/m, most);
    }
    return most;
}

// dp of the forces of constraint
static void gvi__constraint_momenta(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    for (int i = 0; i < st->n; ++i) {
        const gvi__two z = gvi__exact_dot(in->R, in->con.hw, in->con.force + i*in->R),
                       p = gvi__add_low(in->step.p[i], in->step.p_low[i], z.hi, z.lo);
        in->step.p[i] = p.hi;
        in->step.p_low[i] = p.lo;
    }
}

// sum_j (1 - c_j) w_j F_j with its low word
GVI__CALLED gvi__two gvi__moment(int count, const gvi_real *c, const gvi_real *w, const gvi_real *F)
{
    gvi__two sum = gvi__two_of(0, 0);
    for (int j = 0; j < count; ++j) {
        const gvi__two term = gvi__two_prod(w[j], F[j]), z = gvi__two_prod(1 - c[j], term.hi);
        sum = gvi__add_low(sum.hi, sum.lo, z.hi, z.lo + (1 - c[j])*term.lo);
    }
    return sum;
}

// sum_j (1 - c_j) h b_j F_j and that of the impulses, in double words: large forces may cancel
static gvi_real gvi__place_bow(const gvi_stepper *st, int i)
{
    const struct gvi__private *in = &st->in;
    const gvi__two a = gvi__moment(st->r, in->table.c, in->sized.hb, in->work.F + i*in->R),
                   z = gvi__moment(st->s, in->con.d, in->con.hw, in->con.force + i*in->R);
    return (a.hi + z.hi) + (a.lo + z.lo);
}

#ifndef GVI_NO_KICKS
// path += h M^-1 |G|'|z|: how far each impulse alone would move the coordinates, at one point
static void gvi__add_path(const gvi_stepper *st, gvi_real h, const gvi_real *z, gvi_real *impulse,
                          gvi_real *path)
{
    const int n = st->n;
    gvi__zero((size_t)n, impulse);
    for (int a = 0; a < st->in.con.m; ++a)
        for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
            impulse[i] += GVI_ABS(z[a]*st->in.con.G1[a*n + i]);
    gvi__over_mass(st, impulse, 1, 1);
    for (int i = 0; i < n; ++i) path[i] += GVI_ABS(h*impulse[i]);
}

// the largest |g_a| in eps of its terms, the most so far, in `unit`; more than all where not finite
static gvi_real gvi__drift_miss(const gvi_stepper *st, gvi_real t, const gvi_real *path,
                                const gvi_real *G, gvi_real *unit)
{
    const gvi_real *g = st->in.con.g, *rate = g + st->in.con.m;
    gvi_real size = 0;
    for (int a = 0; a < st->in.con.m; ++a) {
        unit[a] = gvi__larger(gvi__terms(st, 1, t, path, G, rate, a), unit[a]);
        if (!gvi__finite(g[a])) return 2*GVI__MAX;
        if (GVI_ABS(g[a]) > size*GVI__EPS*unit[a]) size = GVI_ABS(g[a])/(GVI__EPS*unit[a]);
    }
    return size;
}

// Q, step.q and step.p moved by the impulses G0' z
static void gvi__drift_move(gvi_stepper *st, const gvi__origin *from, gvi_real h, gvi_real *path)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    gvi_real *z = in->con.rho, *d = in->con.scratch;
    for (int a = 0; a < in->con.m; ++a) z[a] = -in->con.g[a]/h;
    gvi__solve_constraints(st, in->con.gram1, 1, 1, z, 1);
    gvi__add_path(st, h, z, d, path);
    gvi__zero((size_t)n, d);
    gvi__add_force(st, z, d);
    gvi__add_scaled(n, 1, d, in->step.p, in->step.p);
    gvi__over_mass(st, d, 1, 1);
    gvi__add_scaled(n, h, d, in->step.q, in->step.q);
    gvi__add_scaled(n, 1, in->step.q, from->q, in->work.Q);
}

/* RATTLE: the drift from p to g(q1) = 0 by impulses G0' mu, from a simplified Newton iteration.  A
   row is rounding by what q1 was added up from, q0 and the paths, which cancel where q1 is near 0.
   An error four times the least so far, and well above rounding, is divergence.               */
GVI__CALLED gvi_status gvi__constrained_drift(gvi_stepper *st, const gvi__origin *from, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    if (!gvi__constrained(st)) return GVI_OK;
    gvi_real before = 0, least = GVI__MAX, *unit = in->con.rho + m, *path = in->answer,
             *G = in->con.G1 + m*n;                  // G0 is before it
    const gvi_real t = from->t + (from->t_low + h);
    gvi_status status = gvi__constraints_at(st, from->t, from->q, NULL, NULL, in->con.drops);
    gvi__zero((size_t)n, in->step.p_low);
    gvi__zero((size_t)m, unit);
    in->con.again = 0;
    for (int i = 0; i < n; ++i) path[i] = GVI_ABS(from->q[i]) + GVI_ABS(in->step.q[i]);
    for (int k = 0; ; ++k) {
        if (status == GVI_OK) status = gvi__evaluate_constraints(st, 1, 1, &t, in->work.Q, G);
        in->con.made = k;
        if (status != GVI_OK) return status;
        if (k == 0 && !in->con.settled) (void)gvi__find_columns(st, 1, 1, G);
        const gvi_real size = gvi__drift_miss(st, t, path, G, unit);
        if (size <= GVI__GRAIN && k > 0 && !(size < before/2))
            return gvi__report_status(st, GVI_OK);

        // far off already, it was on its way to infinity
        if (!gvi__finite(size) && !GVI__LOOKS(st) && before*GVI__EPS < GVI__FAR)
            return gvi__report_status(st, GVI_E_NON_FINITE);
        least = gvi__smaller(size, least);
        if (!gvi__finite(size) || k > in->desc.max_iterations || size > 4*(least + GVI__GRAIN))
            return gvi__report_status(st, GVI_E_CONVERGENCE);
        before = size;
        gvi__drift_move(st, from, h, path);
    }
}
#endif

/* ---- at the end of a step, and at the start ---- */

// the largest |q_i| sqrt(m_i), 1/m_i = (M^-1)_ii: what a coordinate near 0 may be the difference of
GVI__COLD gvi_real gvi__amplitude(const gvi_stepper *st, const gvi_real *q, gvi_real *column)
{
    const int n = st->n;
    gvi_real largest = 0;
    for (int i = 0; i < n; ++i) {
        gvi__zero((size_t)n, column);
        column[i] = 1;
        gvi__over_inertia(st, column, 1, 1);
        const gvi_real size = GVI_ABS(q[i])/GVI_SQRT(GVI_ABS(column[i]));
        if (gvi__finite(size)) largest = gvi__larger(size, largest);
    }
    return largest;
}

/* Is g_a, or what is left of a row that is left out, more than 4096 roundings of its known terms,
   and 4 of the amplitude along the row?  That is < 0 as long as it is not known.              */
GVI__COLD int gvi__doubtful(const gvi_stepper *st, const gvi_real *q, int a, gvi_real left,
                            gvi_real terms, gvi_real *amplitude)
{
    const gvi_real dropped = st->in.con.drops[st->in.con.m + a];
    if (GVI_ABS(left) <= GVI__HELD*GVI__EPS*terms) return 0;
    if (*amplitude < 0) *amplitude = gvi__amplitude(st, q, st->in.con.scratch);
    const gvi_real entry = dropped > 0 ? dropped : gvi__entry(st, 1, a, st->in.con.gram1);
    return !(GVI_ABS(left) <= GVI__PLACE*GVI__EPS**amplitude*GVI_SQRT(GVI_ABS(entry)));
}

/* Is each g_a within 4096 roundings, as far as these are known, or as measured?  To measure, take
   1/4096 of Newton's correction, forwards and back, and less, down to eps of that: if g_a follows
   both, to a quarter of the change that G at both ends tells, its rounding is below that, and g_a
   is none.  Of a row that is left out, what those before it do not explain (A = L D L': L^-1 g) may
   be a contradiction, which no move shows.  In a step (`start` 0) the others are as exact as its
   iteration.                                                                                  */
GVI__COLD gvi_status gvi__fulfilled(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                    const gvi_real *p, gvi_real *v, int start)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    const gvi_real *A = in->con.gram1;
    gvi_real *g = in->con.g, *was = in->con.rho, *doubt = was + m, *ahead = in->con.y,
             *d = in->con.scratch, *next = d + n, *G = in->con.G1, amplitude = -1;
    int off = -1, refused = -1;

    for (int a = 0; a < m; ++a) {
        const int left_out = in->con.drops[m + a] > 0;
        gvi_real terms = gvi__terms(st, 1, t, q, G, g + m, a);
        was[a] = ahead[a] = g[a];
        for (int l = (int)in->con.first[a]; l < a; ++l) {
            ahead[a] -= A[a*m + l]*ahead[l];
            if (left_out) terms += GVI_ABS(A[a*m + l])*gvi__terms(st, 1, t, q, G, g + m, l);
        }
        doubt[a] = (gvi_real)((start || left_out)
            && gvi__doubtful(st, q, a, left_out ? ahead[a] : g[a], terms, &amplitude));
        if (doubt[a] > 0) off = a;
        if (doubt[a] > 0 && left_out) refused = a;
    }

    if (off < 0) return GVI_OK;
    for (int a = 0; a < m; ++a) ahead[a] = -was[a];
    gvi__solve_constraints(st, A, 1, 1, ahead, 1);
    gvi__zero((size_t)n, d);
    gvi__add_force(st, ahead, d);
    gvi__over_inertia(st, d, 1, 1);
    if (!gvi__finite(gvi__norm1(n, d))) refused = off;
    gvi__zero((size_t)m, ahead);
    gvi_real part = 1/GVI__HELD;
    for (int k = 0; part > GVI__EPS/GVI__HELD && refused < 0; ++k) {
        const gvi_real step = k % 2 ? -part : part;
        gvi__add_scaled(n, step, d, q, next);
        if (k % 2) part /= 8;
        if (gvi__evaluate_constraints(st, 1, 1, &t, next, G + m*n) != GVI_OK) continue;
        gvi__add_scaled(n, -1, q, next, next);     // as rounded
        for (int a = 0; a < m; ++a) {
            const gvi_real predicted =
                (gvi__row_dot(st, G, a, next) + gvi__row_dot(st, G + m*n, a, next))/2;
            const int follows = gvi__nonzero(predicted)
                                && GVI_ABS((g[a] - was[a]) - predicted) <= GVI_ABS(predicted)/4;
            if (follows && ahead[a] > 0 && doubt[a] > 0) refused = a;
            ahead[a] = (gvi_real)follows;
        }
    }

    return refused < 0 ? gvi__constraints_at(st, t, q, p, v, in->con.drops + m)
                       : gvi__report_row(st, GVI_E_CONSTRAINT, refused, GVI_FAULT_NONE);
}

/* Rows are about to depend where of the terms of a combination less than half of the digits are
   left, and more than rounding: a change point of a linkage.  Its multiplier is noise over what is
   left, the more so the shorter a step is, so no h mends it.  Held against all its terms, not those
   of one row, a position is as near in every frame; before a failure m times those of one row are
   looked at first, which is cheaper.  Rows that were that near where the motion started may stay
   so.  `margin`: where a step has failed, earlier by a third of the digits; 0: a start, to be
   remembered.  From gram1.                                                                    */
GVI__CALLED gvi_status gvi__check_rank(gvi_stepper *st, int margin)
{
    const int m = st->in.con.m;
    const gvi_real *A = st->in.con.gram1, root = GVI_SQRT(GVI__EPS);
    gvi_real most = 1/(root*GVI__FADES*GVI__FADES);              // of a start: less has no effect
    if (margin > 0) most = gvi__larger(1/root/(gvi_real)margin, GVI__FADES*st->in.con.near_start);
    for (int a = 0; a < m; ++a) {
        const gvi_real own = gvi__entry(st, 1, a, A);
        if (margin == 1 && !(own*A[a*m + a]*(gvi_real)m > most)) continue;
        const gvi_real all = (own + gvi__combine(st, 1, a, A))*A[a*m + a];
        if (!(all > most)) continue;
        if (margin > 0) return gvi__report_row(st, GVI_E_SINGULAR, a, GVI_FAULT_NONE);
        most = all;
    }
    if (margin == 0) {
        st->in.con.near_start = most;
        st->in.con.margin = 1;
    }
    return GVI_OK;
}

// what rows are off by at an end is rounding of g; that of earlier ends fades (make hard-rest)
static void gvi__keep_noise(gvi_stepper *st, int start)
{
    gvi_real *noise = st->in.con.noise;
    for (int a = 0; a < st->in.con.m; ++a) {
        const gvi_real before = start ? 0 : noise[a]*(gvi_real)0.75;
        noise[a] = gvi__larger(GVI_ABS(st->in.con.g[a]), before);
    }
}

/* Is G v + dg/dt of each row within 4096 roundings of its terms, those of dg/dt as each coordinate
   moves it?  Of bodies at rest on rows that move no energy tells how large these are.         */
GVI__COLD int gvi__rates_are_rounding(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *v)
{
    const int n = st->n, m = st->in.con.m;
    const gvi_real root = GVI_SQRT(GVI__EPS), *rate = st->in.con.g + m;
    gvi_real *terms = st->in.con.rho + m, *was = terms + m, *G = st->in.con.G1,
             *next = st->in.con.scratch;
    gvi_status status = GVI_OK;
    int within = 1;

    gvi__copy((size_t)m, rate, was);
    for (int a = 0; a < m; ++a) terms[a] = gvi__terms(st, 1, 0, v, G, rate, a);
    for (int i = 0; i <= n && status == GVI_OK; ++i) {           // G and rates as they were, last
        gvi__copy((size_t)n, q, next);
        if (i < n) next[i] += root*q[i];
        status = gvi__evaluate_constraints(st, 1, 1, &t, next, G);
        for (int a = 0; a < m; ++a) terms[a] += GVI_ABS(rate[a] - was[a])/root;
    }
    for (int a = 0; a < m; ++a)
        within &= GVI_ABS(rate[a] + gvi__row_dot(st, G, a, v)) <= GVI__HELD*GVI__EPS*terms[a];
    return status == GVI_OK && within;
}

// does the end lie on the constraints, with the rank of the start?  start: of a motion
static gvi_status gvi__check_end(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *p,
                                 gvi_real *v, int start)
{
    struct gvi__private *in = &st->in;
    const int m = in->con.m;
    gvi_real *drops = in->con.drops + m;
    int redundant = 0, more = 0, row = 0;

    if (start) GVI__LOOK(st, 1);
    gvi_status status = gvi__constraints_at(st, t, q, p, v, drops);
    if (start) GVI__LOOK(st, 0);
    if (status != GVI_OK) return status;
    gvi__keep_noise(st, start);
    for (int a = 0; a < m; ++a) {
        redundant |= drops[a] > 0;
        more += (drops[a] > 0) - (in->con.drops[a] > 0);
        if ((drops[a] > 0) != (in->con.drops[a] > 0)) row = a;
    }

    if (!start && more != 0) return gvi__report_row(st, GVI_E_SINGULAR, row, GVI_FAULT_NONE);
    status = gvi__check_rank(st, start ? 0 : in->con.margin);
    if ((start || redundant) && status == GVI_OK)
        status = gvi__fulfilled(st, t, q, p, v, start);
    return status;
}

/* step.p += G'z, y += z such that r = G v + dg/dt is 0 with the last G.  Returns r' A^-1 r, twice
   the kinetic energy in it, and in *row the one that has most of it.                          */
static gvi_real gvi__project_momentum(gvi_stepper *st, const gvi_real *v, gvi_real *impulse,
                                      int *row)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *r = in->con.g, *z = in->con.rho, size = 0;

    for (int a = 0; a < m; ++a) r[a] = z[a] = -(r[m + a] + gvi__row_dot(st, in->con.G1, a, v));
    gvi__solve_constraints(st, in->con.gram1, 1, 1, z, 1);
    *row = 0;
    for (int a = 0; a < m; ++a) {
        size += r[a]*z[a];
        if (r[a]*z[a] > r[*row]*z[*row]) *row = a;
        in->con.y[a] += z[a];
    }

    gvi__zero((size_t)n, impulse);
    gvi__add_force(st, z, impulse);
    for (int i = 0; i < n; ++i) {
        const gvi__two sum = gvi__add_low(in->step.p[i], in->step.p_low[i], impulse[i], 0);
        in->step.p[i] = sum.hi;
        in->step.p_low[i] = sum.lo;
    }
    return size;
}

/* P' M^-1 P, twice the kinetic energy of what p at the end was added up from: rounding of v is
   rounding of that, also where p or v is next to 0 there (make everyday).                     */
GVI__COLD gvi_real gvi__energy_of_terms(const gvi_stepper *st, const gvi__origin *from,
                                        gvi_real *P, gvi_real *z)
{
    const int n = st->n;
    for (int i = 0; i < n; ++i)
        P[i] = z[i] = GVI_ABS(from->p[i]) + GVI_ABS(st->in.step.p[i]);
    gvi__over_inertia(st, z, 1, 1);
    return GVI_ABS(gvi__dot(n, P, z));
}

/* step.p += G' y such that G v + dg/dt = 0 at the end: once, and once more for the rounding of
   that, or with Lagrangian terms until that is left.  At a start, what is farther off than
   rounding is refused; for v by the kinetic energy in it, r' A^-1 r/2, r = G v + dg/dt, or by r. */
GVI__CALLED gvi_status gvi__project(gvi_stepper *st, const gvi__origin *from, int start)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, passes = in->adds_p ? GVI__NEVER : 2;
    const gvi_real t = from->t + (from->t_low + in->dt), far = GVI__HELD*GVI__EPS;
    gvi_real *q = in->answer, *p = q + n, *v = p + n, *r = in->con.g, *drops = in->con.drops + m,
             energy = 0, size = 0, before = GVI__MAX;
    int row = 0, slow = 0;

    for (int i = 0; i < n; ++i) {
        // rounded as the commit will: A v is to be 0 there
        const gvi__two end = gvi__add_low(from->q[i], 0, in->step.q[i], in->step.q_low[i]);
        q[i] = end.hi + end.lo;
        p[i] = from->p[i] + (in->step.p[i] + in->step.p_low[i]);
    }

    gvi__velocity_guess(st, v);
    gvi_status status = gvi__check_end(st, t, q, p, v, start);
    if (status != GVI_OK) return status;
    gvi__zero((size_t)m, in->con.y);
    for (int pass = 0; pass < passes; ++pass) {
        for (int i = 0; i < n; ++i) p[i] = from->p[i] + (in->step.p[i] + in->step.p_low[i]);
        // slow: inertia is far from where v was
        status = slow ? gvi__constraints_at(st, t, q, p, v, drops) : gvi__velocity(st, t, q, p, v);
        if (status != GVI_OK) return status;
        energy = GVI_ABS(gvi__dot(n, p, v));
        size = gvi__project_momentum(st, v, p, &row);
        if (start && pass == 0 && !(size <= GVI__MAX && size <= far*far*energy)
            && !gvi__rates_are_rounding(st, t, q, v))
            return gvi__report_row(st, GVI_E_CONSTRAINT, row, GVI_FAULT_NONE);
        if (pass > 0 && !(size < before)) break;
        slow = !(size < before/64);
        before = size;
    }

    if (passes > 2 && !(size <= far*far*energy) && !gvi__rates_are_rounding(st, t, q, v)
        && !(size <= far*far*gvi__energy_of_terms(st, from, p, in->con.scratch)))
        return gvi__report_status(st, GVI_E_CONVERGENCE);

    // rows that are left out had no part in this; later g shows what is wrong, where they have one
    if (!start && !gvi__rolls(st)) return GVI_OK;
    for (int a = 0; a < m; ++a)
        if (drops[a] > 0 && !(r[a]*r[a] <= far*far*drops[a]*energy))
            return gvi__report_row(st, GVI_E_CONSTRAINT, a, GVI_FAULT_NONE);
    return GVI_OK;
}

static gvi_status gvi__place_finish(gvi_stepper *st, const gvi__origin *from)
{
    return gvi__constrained(st) ? gvi__project(st, from, 0) : GVI_OK;
}

// with columns that were found
static int gvi__place_again(gvi_stepper *st)
{
    const int again = st->in.con.again;
    st->in.con.again = 0;
    return again;
}

// the rows are others now
GVI__COLD void gvi__forget_columns(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const size_t m = (size_t)gvi__count_rows(in, in->con.bits), C = (size_t)in->con.C;
    for (size_t k = 0; k < m*(size_t)(st->n + 1); ++k) in->con.column[k] = (gvi_real)st->n;
    gvi__zero(2*m*(size_t)st->n, in->con.G1);
    gvi__zero(m*m, in->con.gram1);
    if (in->con.G) gvi__zero(m*(size_t)st->n*C, in->con.G);
    if (in->con.gram) gvi__zero(m*m*C, in->con.gram);
    in->con.settled = 0;
}

// the size of a coordinate, or of t; of the largest, or 1, where it is next to nothing
static gvi_real gvi__size_of(gvi_real x, gvi_real largest)
{
    if (GVI_ABS(x)*GVI__SURE > largest) return GVI_ABS(x);
    return largest > 0 ? largest : 1;
}

/* Does a callback fill all points?  At s + 1 that are one state, which has to be where con.G1 is,
   each row is, to 1/1024 of its terms, that of the one.  Explicit steps have one point.  Returns a
   row that is not so, or -1.                                                                  */
GVI__COLD int gvi__unfilled_row(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *g,
                                const gvi_real *rate)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, C = in->con.C, count = st->s + 1;
    const gvi_real *G = in->con.G1;
    int wrong = -1;
    if (!in->con.G) return -1;
    for (int k = 0; k < C; ++k) in->con.t[k] = t;
    for (int k = 0; k < n*C; ++k) in->con.at[k] = q[k/C];
    for (int k = 0; k < m*C; ++k) in->con.g[k] = GVI__MAX;
    if (gvi__evaluate_constraints(st, C, count, in->con.t, in->con.at, in->con.G) != GVI_OK)
        return -1;

    for (int a = m; a-- > 0; ) {
        const gvi_real terms = gvi__terms(st, 1, t, q, G, rate, a) + GVI_ABS(g[a]),
                       steepest = gvi__norm1(n, G + a*n);
        for (int k = 0; k < count; ++k) {
            const gvi_real slope = in->con.g[(m + a)*C + k];
            int unlike = GVI_ABS(in->con.g[a*C + k] - g[a]) > terms/GVI__SURE
                         || GVI_ABS(slope - rate[a])*GVI__SURE > GVI_ABS(slope) + GVI_ABS(rate[a]);
            for (int i = 0; i < n; ++i)
                unlike |= GVI_ABS(in->con.G[(a*n + i)*C + k] - G[a*n + i]) > steepest/GVI__SURE;
            if (unlike) wrong = a;
        }
    }

    return wrong;
}

/* The row whose derivative by coordinate i, or by t for i = n, is not the one written, or -1: from
   differences to both sides by d, d/8, d/64 ... until all rows agree.  An entry is wrong where,
   twice in a row, the slopes to both sides, their mean at the last d, and what is written at both
   ends agree to 1/64, and the entry misses them by four times that, the rounding of g's known
   terms, and 1/512; and where it agrees at no shorter d that rounding leaves.  So kinks, noise,
   waves shorter than d, and moves that the rounding of g hides prove nothing.                  */
GVI__COLD int gvi__wrong_derivative(gvi_stepper *st, gvi_real from_t, int i, gvi_real d)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, next = i < n ? n : 1;
    gvi_real *g = in->con.g, *G = in->con.G1, *at = in->con.scratch, *was = in->con.rho,
             *rate = was + m, *mean = rate + m, *ahead = in->con.y, *turn = g + 2*m,
             now = from_t, off = 0, *moved = i < n ? at + i : &now;
    const gvi_real x = *moved, *from = at + n, *written = i < n ? G + i : rate,
                   *there = i < n ? G + m*n + i : g + m, least = GVI__SURE*GVI__EPS*GVI_ABS(x);
    int wrong = -1;

    for (int k = 0, known = 0, agree = 0, suspect = -1; k < GVI__DIG && d > least && !agree; ++k) {
        int doubted = -1;
        *moved = x + d;
        gvi_status status = gvi__evaluate_constraints(st, 1, 1, &now, at, G + m*n);
        for (int a = 0; a < m; ++a) {
            ahead[a] = (g[a] - was[a])/(*moved - x);
            turn[a] = GVI_ABS(there[a*next] - written[a*next]);
        }

        *moved = x - d;
        if (status == GVI_OK) status = gvi__evaluate_constraints(st, 1, 1, &now, at, G + m*n);
        agree = status == GVI_OK;
        for (int a = 0; a < m && status == GVI_OK; ++a) {
            const gvi_real entry = written[a*next], back = (g[a] - was[a])/(*moved - x),
                middle = ahead[a]/2 + back/2, miss = GVI_ABS(entry - middle),
                bend = GVI_ABS(ahead[a] - back) + GVI_ABS(middle - mean[a]),
                spread = gvi__larger(bend, turn[a]/2 + GVI_ABS(there[a*next] - entry)/2),
                terms = gvi__terms(st, 1, from_t, from, G, rate, a) + GVI_ABS(was[a]),
                noise = GVI__SOLVED*GVI__EPS*(terms/d),
                none = (GVI_ABS(entry)/2 + GVI_ABS(middle)/2)/GVI__WRONG + noise;
            if (!(miss <= none)) agree = 0;
            if (a == wrong && miss <= none && noise < off/2) wrong = -1;
            if (known && doubted < 0 && 64*spread < GVI_ABS(middle) && miss > none + 4*spread)
                doubted = a;
            if (a == doubted && a == suspect && wrong < 0) {
                wrong = a;
                off = miss;
            }
            mean[a] = middle;
        }
        suspect = doubted;
        known = status == GVI_OK;
        d /= 8;
    }

    *moved = x;
    return wrong;
}

/* Are G and dg/dt the derivatives of g?  When a constraint is first started with, next to the
   state, where an entry that is 0 there is not.                                               */
GVI__COLD gvi_status gvi__check_derivatives(gvi_stepper *st, gvi_real t, const gvi_real *q)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    const gvi_counters counters = st->counters;          // no step's work
    gvi_real *g = in->con.g, *at = in->con.scratch, *from = at + n, *was = in->con.rho,
             *rate = was + m, largest = 0, from_t = t;
    const gvi_real root = GVI_SQRT(GVI_SQRT(GVI__EPS));
    const char *slip = NULL;
    gvi_status status = GVI_OK;
    int row = -1;

    for (int i = 0; i < n; ++i) largest = gvi__larger(GVI_ABS(q[i]), largest);
    for (gvi_real part = 1/(gvi_real)64; ; part = 0) {           // at the state, if not next to it
        from_t = t + part*gvi__size_of(t, 1);
        for (int i = 0; i < n; ++i)
            from[i] = q[i] + part*gvi__size_of(q[i], largest)*(1 + (gvi_real)i/(gvi_real)n);
        status = gvi__evaluate_constraints(st, 1, 1, &from_t, from, in->con.G1);
        if (!(part > 0) || (status == GVI_OK && gvi__first_non_finite(m, g) < 0)) break;
    }

    (void)gvi__find_columns(st, 1, 1, in->con.G1);
    gvi__copy((size_t)m, g, was);
    gvi__copy((size_t)m, g + m, rate);
    gvi__copy((size_t)n, from, at);
    if (status == GVI_OK) {
        row = gvi__unfilled_row(st, from_t, from, was, rate);
        slip = "constraint: fills not all points: row a of point k < x->count is at "
               "[a*x->stride + k]";
    }
    for (int i = 0; i <= n && status == GVI_OK && row < 0; ++i) {
        const gvi_real size = i < n ? gvi__size_of(from[i], largest) : gvi__size_of(from_t, 1);
        row = gvi__wrong_derivative(st, from_t, i, root*size);
        slip = i < n ? "constraint: a jacobian is not dg/dq, in fault.coordinate's row; if it is, "
                       "start once where that shows"
                     : "constraint: a rate is not dg/dt, in fault.coordinate's row; if it is, "
                       "start once where that shows";
    }

    st->counters = counters;
    if (row >= 0) {
        gvi__report_row(st, GVI_E_ARGUMENT, row, GVI_FAULT_NONE);
        st->fault.argument = slip;
        return GVI_E_ARGUMENT;
    }
    gvi__forget_columns(st);
    return gvi__report_status(st, GVI_OK);
}

// are q and p, which may be those of the state, on the constraints?  Then in step.q, step.p
GVI__COLD gvi_status gvi__project_start(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                        const gvi_real *p)
{
    struct gvi__private *in = &st->in;
    const gvi__origin from = { t, 0, in->zeros, in->zeros, in->zeros, in->zeros };
    const size_t n = (size_t)st->n;

    if (q != in->step.q) gvi__copy(n, q, in->step.q);
    if (p != in->step.p) gvi__copy(n, p, in->step.p);
    gvi__zero(n, in->step.q_low);
    gvi__zero(n, in->step.p_low);
    in->dt = 0;
    if (gvi__constraints_on(st) & ~in->con.checked) {
        const gvi_status status = gvi__check_derivatives(st, t, in->step.q);
        if (status != GVI_OK) return status;
    }

    const gvi_status status = gvi__project(st, &from, 1);
    if (status == GVI_OK) in->con.checked |= gvi__constraints_on(st);
    return status;
}

// forces and lambda of the step, with those at its end, for the curve and the next prediction
GVI__CALLED void gvi__commit_constraints(gvi_stepper *st, gvi_real h)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, s = st->s, C = in->con.C, rows = n + in->con.m;
    if (in->con.settled < 0x4001) in->con.settled += 1;
    in->con.kept = gvi__constrained(st) && in->stages > 0 ? 2 : 0;
    if (in->con.kept == 0) return;
    for (int a = n; a < rows; ++a) in->con.y[a - n] /= h*in->con.w[s];
    gvi__zero((size_t)n, in->answer);
    gvi__add_force(st, in->con.y, in->answer);
    for (int i = 0; i < rows; ++i) {
        gvi__copy((size_t)s, in->con.force + i*in->R, in->con.last + i*C);
        in->con.last[i*C + s] = i < n ? in->answer[i] : -in->con.y[i - n];
    }
}

// what the forces of constraint add to the last step's curve, made of forces
static void gvi__place_reactions(const gvi_stepper *st, gvi_real tau, const gvi_real *phi,
                                 const gvi_real *Phi, gvi_real *q, gvi_real *v)
{
    const struct gvi__private *in = &st->in;
    if (in->stages != 1 || in->has_velocity || !in->con.kept) return;
    for (int e = 0; e < st->s; ++e) {
        gvi_real S = 0, T = 0;                     // Phi(d_0) = 0
        for (int k = 0; e > 0 && k < st->s; ++k) {
            S += Phi[k]*in->con.Phi[k*in->R + e - 1];
            T += phi[k]*in->con.Phi[k*in->R + e - 1];
        }
        for (int i = 0; i < st->n; ++i) {
            const gvi_real L = st->h*in->con.w[e]*in->con.last[i*in->con.C + e];
            q[i] += (tau - S)*L;
            v[i] += (1 - T)*L;
        }
    }
}

// mode k of what the forces of constraint do to coordinate i
GVI__OFFERED gvi_real gvi__constraint_mode(const gvi_stepper *st, int i, int k)
{
    const struct gvi__private *in = &st->in;
    gvi_real sum = 0;
    for (int e = 1; e < st->s; ++e)
        sum += in->con.Phi[k*in->R + e - 1]*(in->con.w[e]*in->con.force[i*in->R + e]);
    return sum;
}

// z := G(q1)' y, the impulse at the end of the step at work
GVI__OFFERED void gvi__end_impulse(const gvi_stepper *st, gvi_real *z)
{
    gvi__zero((size_t)st->n, z);
    if (gvi__constrained(st)) gvi__add_force(st, st->in.con.y, z);
}

/* Mode s + 1 of what the forces of constraint do to coordinate i, `end` that impulse over h.
   Lobatto's s + 1 points square P_s to 1/s, not to 1/(2s + 1).                                */
GVI__OFFERED gvi_real gvi__high_constraint_mode(const gvi_stepper *st, int i, gvi_real end)
{
    const struct gvi__private *in = &st->in;
    const int s = st->s;
    gvi_real sum = gvi__mode_of_force(s + 1, 1)*end;
    for (int e = 0; e < s; ++e)
        sum += gvi__mode_of_force(s + 1, in->con.d[e])*(in->con.w[e]*in->con.force[i*in->R + e]);
    return sum*(gvi_real)s/(gvi_real)(2*s + 1);
}

/* How far the rounding of g moves the coordinates: M^-1 G' A^-1 of what ends of steps were off by,
   or of eps of its known terms, once with one sign and once with signs that alternate, added.  To
   con.scratch; NULL where nothing holds.  All is that of the end, which was projected last.   */
GVI__OFFERED const gvi_real *gvi__constraint_shift(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const gvi_effect *effects = in->desc.effects;
    const int n = st->n, m = in->con.m;
    gvi_real *shift = in->con.scratch, *z = in->con.rho;

    if (!gvi__constrained(st)) return NULL;
    gvi_real *moved = shift + n;
    gvi__zero((size_t)n, shift);
    for (int alternate = 0; alternate < 2; ++alternate) {
        for (int a = 0; a < m; ++a) {
            z[a] = GVI__EPS*gvi__terms(st, 1, st->t, in->state.q, in->con.G1, in->con.g + m, a);
            z[a] = gvi__larger(in->con.noise[a], z[a]);
            if (alternate && a % 2) z[a] = -z[a];
        }
        for (int e = 0, a = 0; e < in->desc.effect_count; ++e) {
            if (!(gvi__constraints_on(st) >> e & 1u)) continue;
            if (in->rolling.bits >> e & 1u) gvi__zero((size_t)effects[e].rows, z + a);
            a += effects[e].rows;
        }
        gvi__solve_constraints(st, in->con.gram1, 1, 1, z, 1);
        gvi__zero((size_t)n, moved);
        gvi__add_force(st, z, moved);
        gvi__over_inertia(st, moved, 1, 1);
        for (int i = 0; i < n; ++i) shift[i] += GVI_ABS(moved[i]);
    }
    return shift;
}

/* ---- set-up, start and switch ---- */

GVI__COLD const char *gvi__wrong_in_constraint(const struct gvi__private *in, int e)
{
    const gvi_effect *effect = in->desc.effects + e;
    if (effect->rows < 1 || effect->rows > 0x7FFF - in->con.m)
        return "effect: rows is below 1, or all rows are more than 32,767";
    if (!effect->points) return "effect: this kind needs points, not point";
    return NULL;
}

/* The tables of constraints, on the same grids, by columns: K = c_i - S(c_i, d_e), U = 1 - T(c_i,
   d_e); for D d_a - S(d_a, c_j), or with momenta T(c_j, d_a), and d_a - S(d_a, d_e), with LU. */
GVI__COLD gvi_status gvi__set_constraints(gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int s = st->s, r = st->r, R = in->R, Q = in->con.Q;
    gvi_real *d = in->con.d, *low = in->stages > 0 ? in->set_up : NULL, *lu = in->con.lu;

    gvi__rule(1, s + 1, d, low, in->con.w);
    if (in->stages == 0) return GVI_OK;
    gvi__modes_of(st, s, d + 1, low + 1, NULL, NULL, in->con.Phi, in->con.Phi_low);
    gvi__zero(2*(size_t)s, in->set_up);               // the column of d_0: Phi(d_0) = 0
    for (int e = 0; e <= s; ++e) {
        if (e > 0) gvi__prepare_column(st, in->con.Phi, in->con.Phi_low, e - 1);
        for (int i = 0; i < r; ++i) {
            const gvi_real S = gvi__S(st, in->table.Phi, in->table.Phi_low, i),
                           T = in->con.U ? gvi__T(st, i) : 0;
            if (e < s) in->con.K[e*R + i] = in->table.c[i] - S;
            if (e < s && in->con.U) in->con.U[e*R + i] = 1 - T;
            if (e > 0) in->con.by_force[i*R + e - 1] = Q ? T : d[e] - S;
            if (e > 0 && gvi__rolls(st)) in->rolling.T[i*R + e - 1] = T;
        }
        for (int a = e > 1 ? e : 1; a <= s; ++a) {
            const gvi_real S = gvi__S(st, in->con.Phi, in->con.Phi_low, a - 1);
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

// that of constraints: rows of R, then of C
GVI__COLD void gvi__layout_constraints(struct gvi__private *in, gvi__arena *a)
{
    struct gvi__holonomic *con = &in->con;
    const size_t n = (size_t)in->desc.n, s = (size_t)in->desc.degree,
                 r = (size_t)in->desc.rule.points,
                 R = (size_t)GVI__ROW(r), C = (size_t)GVI__ROW(s + 1),
                 m = (size_t)gvi__count_rows(in, con->bits),
                 on = m > 0, i = on && in->stages > 0, u = in->stages == 2;
    const struct { gvi_real **to; size_t rows, width; } list[] = {
        { &con->D, i*n, R }, { &con->free, i*n, R }, { &con->P, on*u*n, R },
        { &con->plus, i*(1 + u)*n, R }, { &con->force, i*(n + m), R },
        { &con->K, i*r, R }, { &con->U, on*u*r, R }, { &con->by_force, i*r, R },
        { &con->by_impulse, i*r, R },
        { &con->X, i*s, R }, { &con->E, i*s, R }, { &con->Phi, i*s, R }, { &con->Phi_low, i*s, R },
        { &con->hw, on, R }, { &con->last, i*(n + m), C }, { &con->at, i*n, C }, { &con->t, i, C },
        { &con->scratch, on*n, C }, { &con->g, 2*m, C }, { &con->G, i*m*n, C },
        { &con->gram, i*m*m, C }, { &con->d, on, R + C }, { &con->w, on, s + 1 },
        { &con->rho, m, R + C }, { &con->lu, i*(s + 1), s + 1 }, { &con->y, on, 7*m },
        { &con->G1, 2*m, n }, { &con->gram1, m, m }, { &con->column, m, n + 1 },
        { &con->first, on, m }, { &con->drops, 2*on, m }, { &con->noise, on, m }
    };
    con->C = (int)C;
    con->Q = in->chosen == GVI_MOMENTA;
    for (size_t k = 0; k < sizeof list/sizeof *list; ++k)
        *list[k].to = gvi__take(a, list[k].rows, list[k].width);
}

GVI__COLD gvi_status gvi__constraint_start(gvi_stepper *st, gvi_real t, gvi_real *v)
{
    struct gvi__private *in = &st->in;
    in->con.kept = 0;
    if (!gvi__constrained(st)) return GVI_OK;
    gvi__forget_columns(st);
    const gvi_status status = gvi__project_start(st, t, in->step.q, in->step.p);
    if (status == GVI_OK) gvi__copy((size_t)st->n, in->answer + 2*st->n, v);
    in->con.again = 0;
    return status;
}

// constraints that are switched on have to hold
GVI__COLD gvi_status gvi__constraint_switch(gvi_stepper *st, unsigned was)
{
    struct gvi__private *in = &st->in;
    gvi_status status = GVI_OK;
    if (!(in->con.bits & (in->off ^ was))) return GVI_OK;
    in->con.m = gvi__count_rows(in, gvi__constraints_on(st));
    gvi__forget_columns(st);
    if (in->started && (was & ~in->off)) status = gvi__project_start(st, st->t, st->q, st->p);
    in->con.again = 0;
    if (status != GVI_OK) {
        in->off = was;
        in->con.m = gvi__count_rows(in, gvi__constraints_on(st));
        gvi__forget_columns(st);
        return status;
    }

    in->con.kept = in->con.kept > 0;
    in->predictor.ratio = 0;
    return GVI_OK;
}

// a step failed: is a row wrong already where it starts, or left out there, and cannot be?
GVI__OFFERED int gvi__place_explain(gvi_stepper *st, gvi_status status, gvi_real *v,
                                    gvi_status *start)
{
    if (!gvi__constrained(st)) return 0;

    gvi_real *drops = st->in.con.drops + st->in.con.m;
    *start = gvi__constraints_at(st, st->t, st->q, st->p, v, drops);
    if (*start == GVI_OK) {
        *start = gvi__check_rank(st, GVI__FADES);
        if (*start != GVI_OK) st->in.con.margin = GVI__FADES;
    }
    if (*start != GVI_OK || status != GVI_E_SINGULAR) return 0;
    for (int a = 0; a < st->in.con.m; ++a)
        if (drops[a] > 0) return 1;
    return 0;
}

/* ---- multipliers and projection, for the caller ---- */

/* z := d/de (G v + dg/dt) at (t + e, q + e v, p + e force), e = 0, by a difference to both sides */
GVI__COLD gvi_status gvi__row_rates(gvi_stepper *st, const gvi_real *v, const gvi_real *force,
                                    gvi_real delta, gvi_real *z)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *q = in->answer, *p = q + n, *u = p + n, *G = in->con.G1 + m*n;

    gvi__zero((size_t)m, z);
    for (int side = 0; side < 2; ++side) {
        const gvi_real e = side ? -delta : delta, t = st->t + e;
        gvi__add_scaled(n, e, v, st->q, q);
        gvi__add_scaled(n, e, force, st->p, p);
        gvi__copy((size_t)n, v, u);
        gvi_status status = gvi__velocity(st, t, q, p, u);
        if (status == GVI_OK) status = gvi__evaluate_constraints(st, 1, 1, &t, q, G);
        if (status != GVI_OK) return status;
        (void)gvi__find_columns(st, 1, 1, G);
        for (int a = 0; a < m; ++a) z[a] += (in->con.g[m + a] + gvi__row_dot(st, G, a, u))/(2*e);
    }
    return GVI_OK;
}

// f'M^-1 f of f = F + G'z, which is left in in->answer
GVI__COLD gvi_real gvi__force_norm(gvi_stepper *st, const gvi_real *F, const gvi_real *z)
{
    gvi_real *f = st->in.answer, *d = f + st->n;
    gvi__copy((size_t)st->n, F, f);
    gvi__add_force(st, z, f);
    gvi__copy((size_t)st->n, f, d);
    gvi__over_inertia(st, d, 1, 1);
    return GVI_ABS(gvi__dot(st->n, f, d));
}

/* Richardson's scheme, column by column in con.y: -A^-1 of rates by differences of delta, 5/8 of it
   .., of orders 2 to 12.  z: in, that of the next delta, after k others; out, what that changes. */
static void gvi__richardson(const gvi_stepper *st, int k, gvi_real *z)
{
    const int m = st->in.con.m, last = k < 6 ? k : 6;
    for (int a = 0; a < m; ++a) {
        gvi_real *T = st->in.con.y + m + a, next = z[a], power = 1;
        const gvi_real was = last > 0 ? T[(last - 1)*m] : 0;
        for (int j = 0; j < 6 && j <= k; ++j) {
            const gvi_real old = T[j*m];
            T[j*m] = z[a] = next;
            power *= (gvi_real)2.56;               // (8/5)^2
            next += (next - old)/(power - 1);
        }
        z[a] -= was;
    }
}

// s'A^-1 s, s the terms of each row of G v + dg/dt, with the last G
GVI__COLD gvi_real gvi__rate_terms(gvi_stepper *st, const gvi_real *v)
{
    const int m = st->in.con.m;
    gvi_real *s = st->in.con.rho, *z = s + m;
    for (int a = 0; a < m; ++a)
        s[a] = z[a] = gvi__terms(st, 1, 1, v, st->in.con.G1, st->in.con.g + m, a);
    gvi__solve_constraints(st, st->in.con.gram1, 1, 1, z, 1);
    return GVI_ABS(gvi__dot(m, s, z));
}

/* con.y += the change of lambda with which G v + dg/dt stays 0 along the motion; that rate is
   linear in lambda, its matrix A.  Two changes in a row by shorter differences, since one may be
   small by chance, say how far off the one between is.  It is enough where they are the rounding
   of a difference: eps of the rate's `terms`, and of t and q, eps `time`, as lambda changes by
   them, over delta.  The ratio 5/8 samples no wave at its period again and again, and t + delta is
   exact.  Beyond a domain: nearer.                                                            */
GVI__COLD gvi_status gvi__hold_rate(gvi_stepper *st, const gvi_real *v, const gvi_real *F,
                                    gvi_real terms, gvi_real time, gvi_real delta)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *force = in->con.scratch + n, *z = in->con.rho, *best = z + m, *before = best + m,
             *sum = in->con.y, least = GVI__MAX, last = GVI__MAX;
    gvi_status status = GVI_OK;

    (void)gvi__force_norm(st, F, sum);
    gvi__copy((size_t)n, in->answer, force);
    for (int levels = 0, k = 0; levels < GVI__DIG; ++levels, ++k, delta *= (gvi_real)0.625) {
        status = gvi__row_rates(st, v, force, delta, z);
        for (int a = 0; a < m; ++a) z[a] = -z[a];
        gvi__solve_constraints(st, in->con.gram1, 1, 1, z, 1);
        gvi__richardson(st, k, z);
        const gvi_real *now = sum + (k < 5 ? k + 1 : 6)*m, size = gvi__force_norm(st, in->zeros, z),
                       both = gvi__larger(size, last), eps = GVI__EPS/delta, moved = eps*time;
        if (status != GVI_OK || !gvi__finite(size)) {
            last = GVI__MAX;
            k = -1;
            continue;
        }

        if (both < least) {
            gvi__copy((size_t)m, size > last ? before : now, best);
            least = both;
        }
        const gvi_real whole = least < GVI__MAX ? gvi__force_norm(st, force, now)
                                                  + gvi__force_norm(st, in->zeros, now) : 0;
        if (least <= moved*(moved*whole) + eps*(eps*terms)) break;
        gvi__copy((size_t)m, now, before);
        last = k > 0 ? size : GVI__MAX;
    }

    if (!(least < GVI__MAX))
        return status != GVI_OK ? status : gvi__report_status(st, GVI_E_NON_FINITE);
    gvi__add_scaled(m, 1, best, sum, sum);
    return GVI_OK;
}

/* A time in which much changes is the first delta, a power of 2, times 8 or more: that of the
   rates p'v/|p||q| and (|q||F|/q'M q)^(1/2), by which a body near rest moves, together; or 1.
   d2L/dv2 by differences is not A to rounding, so what it leaves is found twice more.         */
GVI_DEF gvi_status gvi_multipliers(gvi_stepper *st, gvi_real *lambda)
{
    gvi_status status = gvi__ready(st, st && st->in.started);
    if (status != GVI_OK) return status;
    if (!lambda) return gvi__refuse_call(st, "lambda is NULL");
    if (!st->in.con.bits) {
        gvi__report_status(st, GVI_E_FORMULATION);
        st->fault.argument = "gvi_multipliers: no constraint is in the scene";
        return gvi__done(st, GVI_E_FORMULATION);
    }

    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *u = in->answer + 2*n, *v = in->con.scratch, *F = in->step.p, size = 0, work = 0,
             moment = 0;
    const gvi_real *y = in->con.y;
    gvi_points at = gvi__one_point(st, &st->t, st->q);
    gvi__velocity_guess(st, u);
    if (m > 0) status = gvi__constraints_at(st, st->t, st->q, st->p, u, in->con.drops + m);
    gvi__velocity_guess(st, v);
    if (status == GVI_OK) status = gvi__velocity(st, st->t, st->q, st->p, v);
    at.v = v;
    if (status == GVI_OK) status = gvi__evaluate(st, &at, 0, 1);
    gvi__copy((size_t)n, at.f, F);
    gvi__zero((size_t)m, in->con.y);

    const gvi_real terms = m > 0 && status == GVI_OK ? gvi__rate_terms(st, v) : 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real q = GVI_ABS(st->q[i]);
        size += GVI_ABS(st->p[i])*q;
        work += GVI_ABS(F[i])*q;
        moment += gvi__place_inertia(st, i)*q*q;
    }
    const gvi_real moves = size > 0 ? GVI_ABS(gvi__dot(n, st->p, v))/size : 0,
                   falls = moment > 0 ? GVI_SQRT(work/moment) : 0;
    gvi_real time = 1/(moves + falls);
    if (!(time > 0) || !gvi__finite(time)) time = 1;
    int exponent;
    (void)GVI_FREXP(time, &exponent);
    const gvi_real delta = GVI_LDEXP(1, exponent - 4);
    for (int pass = 0; m > 0 && pass < 1 + 2*(in->adds_p > 0) && status == GVI_OK; ++pass)
        status = gvi__hold_rate(st, v, F, terms, time + GVI_ABS(st->t), delta);
    if (status != GVI_OK) return gvi__done(st, status);
    for (int e = 0; e < in->desc.effect_count; ++e)
        for (int a = 0; a < in->desc.effects[e].rows; ++a)
            *lambda++ = gvi__constraints_on(st) >> e & 1u ? *y++ : 0;
    return gvi__done(st, GVI_OK);
}

GVI_DEF gvi_status gvi_curve_multipliers(gvi_stepper *st, gvi_real tau, gvi_real *lambda)
{
    const gvi_status status = gvi__stepped(st);
    if (status != GVI_OK) return status;
    if (!lambda) return gvi__refuse_call(st, "lambda is NULL");
    if (!(tau >= 0 && tau <= 1)) return gvi__refuse_call(st, "tau is not in [0,1]");
    const struct gvi__private *in = &st->in;
    if (in->con.kept < 2) {
        gvi__report_status(st, GVI_E_FORMULATION);
        st->fault.argument = "gvi_curve_multipliers: the last step had no constraint, rows were "
                             "switched since, or it was explicit";
        return gvi__done(st, GVI_E_FORMULATION);
    }

    const int s = st->s, C = in->con.C;
    const gvi_real *node = in->con.d, *row = in->con.last + st->n*C;
    gvi_real *weight = in->set_up, *basis = weight + C;
    gvi_barycentric(s + 1, node, weight);
    gvi_basis(s + 1, node, weight, tau, basis);
    for (int e = 0; e < in->desc.effect_count; ++e)
        for (int a = 0; a < in->desc.effects[e].rows; ++a) {
            gvi_real sum = 0;
            const int on = (int)(gvi__constraints_on(st) >> e & 1u);
            for (int k = 0; on && k <= s; ++k) sum -= basis[k]*row[k];
            *lambda++ = sum;
            row += on*C;
        }
    return gvi__done(st, GVI_OK);
}

/* v := v + M^-1 G'z such that G v + dg/dt = 0, with the last G; once more for the rounding of that.
   Returns z'(G v + dg/dt), which is the square of the way by M.                               */
static gvi_real gvi__project_velocity(gvi_stepper *st, gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *given = in->answer, *d = given + n, *z = in->con.rho, *r = z + m, way = 0;
    gvi__copy((size_t)n, v, given);

    for (int pass = 0; pass < 2; ++pass) {
        for (int a = 0; a < m; ++a)
            z[a] = r[a] = -(in->con.g[m + a] + gvi__row_dot(st, in->con.G1, a, v));
        gvi__solve_constraints(st, in->con.gram1, 1, 1, z, 1);
        if (pass == 0) way = gvi__dot(m, r, z);

        gvi__zero((size_t)n, d);
        gvi__add_force(st, z, d);
        gvi__over_inertia(st, d, 1, 1);
        for (int i = 0; i < n; ++i) {
            v[i] += d[i];
            // all of it was across the constraints: what is left is rounding
            if (GVI_ABS(v[i]) <= GVI__SOLVED*GVI__EPS*GVI_ABS(given[i])) v[i] = 0;
        }
    }

    return way;
}

// q + e; 0 where what is left of a move to it is rounding
static gvi_real gvi__arrived(const gvi_stepper *st, gvi_real q, gvi_real e)
{
    const gvi_real rounding = GVI__GRAIN*(gvi_real)st->in.con.m*GVI__EPS;
    return GVI_ABS(q + e) <= rounding*GVI_ABS(q) ? 0 : q + e;
}

/* One iteration q' = q + e, e = M^-1 G'z with g + G(e_new - e) = 0: (G M^-1 G') z = G e - g at the
   last q'.  So e is normal to the constraints where it ends, and *way = e'M e is z'(G e - g).
   What moves along the constraints is damped, by `share`; g is taken to 0 in any case.  f: M e.
   Returns the work of the forces along the change of e, which has one unit, and is not 0 where M
   alone changes; *size: what that is made of.                                                 */
static gvi_real gvi__approach(gvi_stepper *st, const gvi_real *q, gvi_real share, gvi_real *way,
                              gvi_real *size)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *e = in->step.q, *f = in->step.p, *next = in->answer, *d = next + n,
             *impulse = in->point, *path = impulse + 2*n, *z = in->con.rho, *r = z + m,
             *back = r + m, change = 0;

    for (int a = 0; a < m; ++a) {
        back[a] = -in->con.g[a];
        z[a] = r[a] = gvi__row_dot(st, in->con.G1, a, e) - in->con.g[a];
    }
    gvi__solve_constraints(st, in->con.gram1, 1, 1, z, 1);
    gvi__solve_constraints(st, in->con.gram1, 1, 1, back, 1);
    *way = gvi__dot(m, r, z);
    for (int a = 0; a < m; ++a) z[a] = share*z[a] + (1 - share)*back[a];

    gvi__zero((size_t)n, impulse);
    gvi__add_force(st, z, impulse);
    gvi__copy((size_t)n, impulse, d);
    gvi__over_inertia(st, d, 1, 1);
    *size = 0;
    for (int i = 0; i < n; ++i) {
        change += (GVI_ABS(impulse[i]) + GVI_ABS(f[i]))*GVI_ABS(d[i] - share*e[i]);
        *size += (GVI_ABS(impulse[i]) + GVI_ABS(f[i]))*(GVI_ABS(d[i]) + GVI_ABS(e[i]));
        f[i] = impulse[i] + (1 - share)*f[i];
        e[i] = d[i] + (1 - share)*e[i];
        next[i] = gvi__arrived(st, q[i], e[i]);
        path[i] = GVI_ABS(q[i]) + GVI_ABS(e[i]);
    }
    return change;
}

// to the q' on the constraints, in->answer: iterations until their change is rounding, at u
static gvi_status gvi__find_nearest(gvi_stepper *st, gvi_real t, const gvi_real *q, gvi_real *u,
                                    gvi_real *way)
{
    struct gvi__private *in = &st->in;
    const gvi_real *next = in->answer, *path = in->point + 2*st->n, *z = in->con.rho;
    gvi_real *drops = in->con.drops + in->con.m, change = GVI__MAX, before = 0, size = 0, share = 1;
    // what a d2L/dv2 by differences leaves of a change
    const gvi_real root = GVI_SQRT(GVI__EPS),
                   least = in->adds_p ? GVI__SOLVED*root : GVI_SQRT(GVI__EPS*root);

    for (int k = 0; ; ++k) {
        gvi_status status = gvi__constraints_at(st, t, next, NULL, u, drops);
        gvi_real noise = 0;                        // the work that the rounding of g does
        for (int a = 0; a < in->con.m && k > 0 && status == GVI_OK; ++a)
            noise += GVI__GRAIN*GVI_ABS(z[a])
                     *(GVI_ABS(in->con.g[a])
                       + GVI__EPS*gvi__terms(st, 1, t, path, in->con.G1, in->con.g + in->con.m, a));

        if (k > 1 && !(change < before*GVI__LEAST) && status == GVI_OK
            && change <= least*size + noise) {
            if (gvi__fulfilled(st, t, next, NULL, u, 1) == GVI_OK) return GVI_OK;
            status = gvi__constraints_at(st, t, next, NULL, u, drops);
        }
        if (k > GVI__NEVER && status == GVI_OK) status = GVI_E_CONVERGENCE;
        if (status != GVI_OK) return status;

        before = change;
        change = gvi__approach(st, q, share, way, &size);
        if (change > before && share*(1 << GVI__NEARER) > 1) share /= 2;
    }
}

GVI_DEF gvi_status gvi_project(gvi_stepper *st, gvi_real t, gvi_real *q, gvi_real *v,
                               gvi_real *moved)
{
    gvi_status status = gvi__check_start(st, t, q, v);
    if (status != GVI_OK) return status;
    gvi_real far[2] = { 0, 0 };
    if (!moved) moved = far;
    moved[0] = moved[1] = 0;
    if (!gvi__constrained(st)) return gvi__report_status(st, GVI_OK);

    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m;
    gvi_real *e = in->step.q, *u = in->answer + 2*n, *drops = in->con.drops + m;
    gvi__zero((size_t)n, e);
    gvi__zero((size_t)n, in->step.p);
    gvi__copy((size_t)n, q, in->answer);
    gvi__copy((size_t)n, v, u);
    gvi__forget_columns(st);
    if (gvi__constraints_on(st) & ~in->con.checked) status = gvi__check_derivatives(st, t, q);
    if (status != GVI_OK) return status;
    GVI__LOOK(st, 1);
    status = gvi__find_nearest(st, t, q, u, far);
    GVI__LOOK(st, 0);
    if (status == GVI_OK) far[1] = gvi__project_velocity(st, u);
    // rows that are left out had no part in this
    for (int a = 0; a < m && status == GVI_OK; ++a) {
        const gvi_real slip = in->con.g[m + a] + gvi__row_dot(st, in->con.G1, a, u);
        gvi_real terms = GVI_ABS(in->con.g[m + a]);
        for (int i = 0; i < n; ++i)
            terms += GVI_ABS(in->con.G1[a*n + i])*(GVI_ABS(u[i]) + GVI_ABS(v[i]));
        if (drops[a] > 0 && GVI_ABS(slip) > GVI__HELD*GVI__EPS*terms)
            status = gvi__report_row(st, GVI_E_CONSTRAINT, a, GVI_FAULT_NONE);
    }
    gvi__forget_columns(st);
    if (status == GVI_E_CONVERGENCE)
        st->fault.argument = "gvi_project: no state on the constraints found, too far off";
    if (status == GVI_E_CONSTRAINT)
        st->fault.argument = "gvi_project: a row (fault.coordinate of fault.effect) contradicts "
                             "others";
    if (status != GVI_OK) return st->status = status;
    for (int i = 0; i < n; ++i) q[i] = gvi__arrived(st, q[i], e[i]);
    gvi__copy((size_t)n, u, v);
    for (int k = 0; k < 2; ++k) moved[k] = GVI_SQRT(GVI_ABS(far[k]));
    return gvi__report_status(st, GVI_OK);
}

/* ---- ROLLING: nonholonomic constraints ----

   Rows A(t,q) v + a(t,q) = 0 that no g(t,q) = 0 expresses: wheels, blades, balls.  By the principle
   of Lagrange and d'Alembert the forces are A' lambda, virtual displacements have A dq = 0; that is
   not the stationary action under these rows (vakonomic), whose motion is another.  Multipliers,
   tables and factors are those above, with A for G.  In place of g(D_a) stands what g would have
   gained along the curve,

     psi_a = h sum_j b_j T(c_j, d_a) (A(Q_j) V_j + a(t_j, Q_j))                a = 1..s

   and the step ends on A v + a = 0.  With r = s the row holds at every point.  The order is 2s; the
   map is reversible, not symplectic (docs/theory.md).  Unlike g(D), psi has rounding of the size of
   h V alone, so V or P is judged as in free motion; psi turns with Q and is never linearised. */

// there is no g that its rows could be the derivatives of
GVI__COLD void gvi__rolling_effect(struct gvi__private *in, int e)
{
    in->rolling.bits |= 1u << e;
    in->con.checked |= 1u << e;
}

// rows of an effect that rolls, on at rows a.. of all: A and a at the points, psi to g
static gvi_status gvi__roll(gvi_stepper *st, gvi_points *at, int e, int a)
{
    struct gvi__private *in = &st->in;
    const gvi_effect *effect = in->desc.effects + e;
    const int n = st->n, s = st->s, R = in->R, C = in->con.C,
              rounded = st->formulation != GVI_NEWTON ? n : 0;

    gvi__count(&st->counters.effect[e], st->r);
    const int failed = effect->points(at, effect->user);
    if (failed) return gvi__report_callback(st, failed, e);
    for (int row = 0; row < effect->rows; ++row, ++a) {
        gvi_real *psi = in->con.g + a*C + 1;
        gvi__zero((size_t)s, psi);
        // gvi__constrain subtracts D as rounded to q0 + D, which g(D) has in it, psi has not
        for (int i = gvi__column(st, a, 0); i < rounded; i = gvi__column(st, a, i + 1)) {
            const gvi_real *G = in->con.G + (a*n + i)*C + 1, *q = in->con.at + i*C;
            for (int k = 0; k < s; ++k)
                psi[k] += G[k]*((q[k + 1] - q[0]) - in->con.D[i*R + k]);
        }
        for (int j = 0; j < st->r; ++j) {
            gvi_real slip = at->rate[row*R + j];
            for (int i = gvi__column(st, a, 0); i < n; i = gvi__column(st, a, i + 1))
                slip += at->jacobian[(row*n + i)*R + j]*in->work.V[i*R + j];
            gvi__subtract_row((size_t)s, -in->sized.hb[j]*slip, in->rolling.T + j*R, psi);
        }
    }

    at->g += effect->rows*R;
    at->rate += effect->rows*R;
    at->jacobian += effect->rows*n*R;
    return GVI_OK;
}

GVI__CALLED gvi_status gvi__rolling_values(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int R = in->R, m = gvi__count_rows(in, in->rolling.bits & ~in->off);
    gvi_points at = gvi__points_at(st, st->r, R, in->t, in->work.Q, NULL, NULL);
    gvi_status status = GVI_OK;

    at.jacobian = in->rolling.A;
    at.g = in->rolling.a;
    at.rate = at.g + m*R;
    gvi__zero((size_t)(m*st->n*R), at.jacobian);
    gvi__zero((size_t)(m*R), at.rate);
    for (int e = 0, a = 0; e < in->desc.effect_count && status == GVI_OK; ++e) {
        if (!(gvi__constraints_on(st) >> e & 1u)) continue;
        if (in->rolling.bits >> e & 1u) status = gvi__roll(st, &at, e, a);
        a += in->desc.effects[e].rows;
    }

    return status;
}

// with the layout of constraints
GVI__COLD void gvi__rolling_layout(struct gvi__private *in, gvi__arena *a)
{
    const size_t R = (size_t)GVI__ROW(in->desc.rule.points),
                 m = (size_t)gvi__count_rows(in, in->rolling.bits);
    in->rolling.A = gvi__take(a, m*(size_t)in->desc.n, R);
    in->rolling.a = gvi__take(a, 2*m, R);
    in->rolling.T = gvi__take(a, m > 0 ? (size_t)in->desc.rule.points : 0, R);
}
#else
#define gvi__constrained(st) 0
#define gvi__constraint_mode(st, i, k) ((void)(k), (gvi_real)0)
#define gvi__high_constraint_mode(st, i, end) ((void)(end), (gvi_real)0)
#define gvi__end_impulse(st, z) ((void)(z))
#define gvi__constraint_shift(st) NULL
#define gvi__place_explain(st, status, v, start) 0
#endif /* GVI_NO_CONSTRAINTS */

#if !defined(GVI_NO_NEWTON) && !defined(GVI_NO_CONSTRAINTS)
/* --------------------------------------- CONSTRAINTS BY NEWTON'S METHOD

   Unknown y[s*n + e*m + a] is -lambda_a at D_e, e = 0..s-1, and the rows behind those of (1) are
   -g_a at D_(e+1).  So signed, the determinant of free motion is positive.                    */

static size_t gvi__con_unknowns(const gvi_stepper *st)
{
    return gvi__constrained(st) ? (size_t)st->s*(size_t)st->in.con.m : 0;
}

static int gvi__con_rows(const struct gvi__private *in)
{
    return gvi__count_rows(in, in->con.bits);
}

// g and G at the D that y makes, and the forces of its multipliers
GVI__CALLED gvi_status gvi__con_values(gvi_stepper *st, const gvi__origin *from)
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
    in->con.made = in->con.linear = 0;
    const gvi_status status = gvi__evaluate_at_D(st, from);
    gvi__constraint_forces(st);
    gvi__force_sizes(st, in->con.force + n*R, R, in->con.D);      // nearly dependent rows cancel
    return status;
}

static void gvi__con_force(const gvi_stepper *st, int i, int k, gvi_real *force, gvi_real *size)
{
    const struct gvi__private *in = &st->in;
    const int R = in->R;
    for (int e = 0; e < st->s; ++e) {
        const gvi_real w = (k == 0 ? 1 : 0) - (e > 0 ? in->con.Phi[k*R + e - 1] : 0);
        *force += w*(in->con.hw[e]*in->con.force[i*R + e]);
        *size += GVI_ABS(w*(in->con.hw[e]*in->con.D[i*R + e]));
    }
}

// g, as the momentum that would undo it: its norm, what has moved of it, and what was there
static gvi_real gvi__con_residual(gvi_stepper *st, gvi__descent *p, gvi_real *moved,
                                   gvi_real *before)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, C = in->con.C;
    gvi_real norm = 0;

    for (int k = 0; k < st->s*in->con.m; ++k) {
        const int a = k % in->con.m, e = k/in->con.m + 1;
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
        const gvi_real unit = GVI_ABS(in->sized.h)*GVI_SQRT(inertia);
        norm += GVI_ABS(now)/unit;
        *moved += GVI_ABS(now - *rest)/unit;
        *before += GVI_ABS(*rest)/unit;
        in->newton.dy[st->s*n + k] = *rest = now;
        if (size > 0 && GVI_ABS(now)/size > p->work) p->work = GVI_ABS(now)/size;
    }

    return norm;
}

// multipliers, constraints, and by differences of G the forces G' lambda, which move with D
GVI__CALLED gvi_status gvi__con_matrix(gvi_stepper *st, const gvi__matrix *J)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, s = st->s, R = in->R, C = in->con.C, moves = s > 1 ? n : 0;
    const gvi_real *const Phi = in->con.Phi, *const t = in->con.t;          // at D_e: [e - 1]
    const gvi_real h = in->sized.h;
    gvi_real *force = in->con.force, *base = in->con.free, *at = in->con.at, *was = in->set_up;
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
                    w = (k == 0 ? 1 : 0) - (e > 0 ? Phi[k*R + e - 1] : 0);
                const size_t y = (size_t)(k*n + i);
                J->square[y*size + z] = (gvi_real)(2*k + 1)*w*(in->con.hw[e]*G[0]);
                J->square[z*size + y] = -h*Phi[k*R + e]*G[1];
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
                    const gvi_real w = (k == 0 ? 1 : 0) - Phi[k*R + e - 1];
                    J->square[(size_t)(k*n + i)*size + (size_t)(l*n + j)] -=
                        (gvi_real)(2*k + 1)*w*d*(h*Phi[l*R + e - 1]);
                }
            }
        gvi__copy((size_t)C, was, row);
    }

    if (status == GVI_OK) status = gvi__evaluate_constraints(st, C, s + 1, t, at, in->con.G);
    gvi__constraint_forces(st);
    return status;
}

static gvi_status gvi__con_report(gvi_stepper *st, gvi_status status, int at)
{
    return gvi__report_row(st, status, at % st->in.con.m, GVI_FAULT_NONE);
}

// multipliers, extrapolated
static void gvi__con_guess(const gvi_stepper *st, gvi_real *y)
{
    const struct gvi__private *in = &st->in;
    gvi__predict_constraints(st, 1);
    for (int k = 0, m = in->con.m; k < st->s*m; ++k)
        y[k] = in->con.force[(st->n + k % m)*in->R + k/m];
}

// which rows depend on others at the start?  A matrix that left out others will not do
static gvi_status gvi__con_begin(gvi_stepper *st, const gvi__origin *from, gvi_real *v)
{
    struct gvi__private *in = &st->in;
    gvi_real *drops = in->con.drops, *was = in->con.rho;
    gvi__copy((size_t)in->con.m, drops, was);
    const gvi_status status = gvi__constraints_at(st, from->t, from->q, NULL, v, drops);
    for (int a = 0; a < in->con.m; ++a)
        if ((drops[a] > 0) != (was[a] > 0)) in->newton.h = 0;
    return status;
}

// what the pivot of a row has lost at a point, in units of what is left of it
GVI__COLD gvi_real gvi__loss(const gvi_stepper *st, int row, int point)
{
    const int m = st->in.con.m, C = st->in.con.C;
    const gvi_real *A = st->in.con.gram + point;
    gvi_real lost = 0;
    for (int l = (int)st->in.con.first[row]; l < row; ++l)
        lost += A[(row*m + l)*C]*A[(l*m + row)*C];
    return lost*A[(row*m + row)*C];
}

/* Did the rank of G change between two points of the step?  What those before row j leave of it is
   c G, c the row of L^-1: where that is a small part of row j at a point, has it turned by more
   than 25 degrees at the next?  It passes 0 where the motion branches, and has another direction
   on each branch: the step must not choose.                                                   */
GVI__CALLED gvi_status gvi__con_end(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, m = in->con.m, C = in->con.C;
    gvi_real *now = in->answer, *next = now + n, *c = in->con.y;
    const gvi_points at = gvi__points_at(st, st->r, in->R, in->t, in->work.Q, NULL, NULL);
    gvi_status status = GVI_OK;

    if (in->desc.mass.kind == GVI_MASS_POSITION) status = gvi__factor_mass(st, &at);
    if (status == GVI_OK)
        status = gvi__factor_constraints(st, C, st->s, in->con.G, in->con.gram, in->con.drops);
    if (status != GVI_OK) return status;
    for (int ej = 0; ej < st->s*m; ++ej) {
        const int e = ej/m, j = ej % m;
        const gvi_real *A = in->con.gram + e;
        gvi_real all = 0;
        if (!(gvi__loss(st, j, e) > GVI__LOST*GVI__LOST - 1)) continue;
        gvi__zero(2*(size_t)n, now);
        (void)gvi__combine(st, C, j, A);
        for (int l = j; l >= 0; --l) {
            const gvi_real *G = in->con.G + l*n*C + e;
            for (int i = gvi__column(st, l, 0); i < n; i = gvi__column(st, l, i + 1)) {
                now[i] += c[l]*G[i*C];
                next[i] += c[l]*G[i*C + 1];
                if (l == j) all += G[i*C]*G[i*C];
            }
        }
        const gvi_real part = gvi__dot(n, now, now), there = gvi__dot(n, next, next);
        const int goes_on =
            gvi__dot(n, now, next) > (gvi_real)0.9*GVI_SQRT(part)*GVI_SQRT(there);     // cos 25
        if (GVI__LOST*GVI__LOST*part < all && !goes_on)
            return gvi__report_row(st, GVI_E_SINGULAR, j, e);
    }

    return GVI_OK;
}
#endif

#ifndef GVI_NO_RULES
/* ------------------------------------------------------------- OWN RULES

   Nodes and weights of the caller.  A rule of order u < 2s - 1 is not exact for phi_k^2: the last
   1/Gamma_kk is another (u = 2s - 2), or Gamma is full, and its LU is kept.                    */

GVI__COLD gvi_status gvi__check_own_rule(const struct gvi__private *in, int *order)
{
    const gvi_rule *rule = &in->desc.rule;
    *order = gvi_rule_order(rule->points, rule->nodes, rule->weights);
    if (*order < 0) return GVI_E_NODES;
    if (rule->points < in->desc.degree) return GVI_E_POINTS;
    return *order < in->desc.degree ? GVI_E_ORDER : GVI_OK;
}

/* Of a mode that the rule all but misses, half of the digits would be left: refused.           */
GVI__COLD gvi_status gvi__place_modes(gvi_stepper *st)
{
    const struct gvi__tables *table = &st->in.table;
    const int s = st->s, r = st->r, R = st->in.R;
    gvi_real *gamma = st->in.rules.gamma;

    if (st->in.desc.rule.kind != GVI_OWN) return GVI_OK;
    if (st->order == 2*s - 2) {
        const gvi_real *last = table->phi + (s - 1)*R, sum = gvi__dot3(r, table->b, last, last);
        if (!(GVI_ABS(sum) > GVI_SQRT(GVI__EPS))) return GVI_E_POINTS;
        table->inv_gamma[s - 1] = 1/sum;
    }

    if (!gamma) return GVI_OK;
    for (int k = 0; k < s; ++k)
        for (int l = 0; l < s; ++l)
            gamma[k*s + l] = gvi__dot3(r, table->b, table->phi + k*R, table->phi + l*R);
    if (gvi_lu_factor(s, gamma, gamma + s*s) != GVI_OK) return GVI_E_POINTS;
    if (!(gvi_lu_rcond(s, gamma, gamma + s*s, st->in.set_up) > GVI_SQRT(GVI__EPS)))
        return GVI_E_POINTS;
    return GVI_OK;
}

static int gvi__place_gamma(const gvi_stepper *st, gvi_real *y)
{
    const gvi_real *gamma = st->in.rules.gamma;
    if (!(gvi__parts(&st->in) & GVI__IN_RULES)) return 0;
    gvi_lu_solve(st->s, gamma, gamma + st->s*st->s, y);
    return 1;
}
#endif /* GVI_NO_RULES */

#ifndef GVI_NO_OUTPUT
/* ---------------------------------------------------------------- OUTPUT

   The state at any time within the last step, by a partial step from its nearer end, as exact as a
   step; and the action along its curve.                                                       */

/* Increments of a partial step for a time dt from one end of the last step.  With a clock its h is
   found by Newton's method, the derivative being g, kept inside the step by bisection.       */
static gvi_status gvi__partial_step(gvi_stepper *st, const gvi__origin *from, int query,
                                    gvi_real dt)
{
#ifdef GVI_NO_CLOCK
    return gvi__solve(st, from, dt, query);
#else
    if (!gvi__clock_is_on(st)) return gvi__solve(st, from, dt, query);
    struct gvi__private *in = &st->in;
    gvi_real h = st->h*(dt/(st->t - st->t0)), rate, *q = in->answer;
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
#endif
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
#ifndef GVI_NO_CLOCK
    if (gvi__clock_is_on(st) && in->stepped != 2) return gvi__done(st, GVI_E_STATE);
#endif

    // partial step of length h from the nearer end, or none for a rounding of the whole
    const gvi__origin end = { st->t, st->t_low, st->q, st->q_low, st->p, st->p_low };
    gvi__origin from = { st->t0, 0, in->began.q, in->zeros, in->began.p, in->zeros };
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
    gvi_real *Q = in->answer, *P = Q + n, *V = P + n;
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
    gvi_real V, L, T, *q = in->answer, *v = q + n;

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
    if (!gvi__has_curve(st) || st->in.stepped == 2)
        return gvi__done(st, GVI_E_FORMULATION);
    gvi_real sum;
    gvi__weights_for(st, st->h);
    status = gvi__curve_action(st, NULL, 0, NULL, &sum);
    if (status == GVI_OK) *action = sum;
    return gvi__done(st, status);
}
#endif /* GVI_NO_OUTPUT */

#ifndef GVI_NO_DIAL
/* -------------------------------------------------------------- THE DIAL

   A step is measured by the modes of its curve, and gvi_advance chooses h by that.            */

GVI__COLD const char *gvi__wrong_in_resolution(const gvi_desc *d, int order)
{
    if (order < 2*d->degree) return "resolution: the order of the rule is below twice the degree";
    return NULL;
}

// what the point j gives to the modes K, K - 1 ..: see gvi__resolution, or gvi__coarse_resolution
GVI__COLD void gvi__dial_tables(gvi_stepper *st)
{
    struct gvi__private *in = &st->in;
    const int forces = in->stages == 1, s = st->s, R = in->R;
    const gvi_real *modes = forces ? in->table.Phi : in->table.phi;       // not always both
    in->dial.top = s - !(forces && !gvi__of_kind(in, GVI_CONSTRAINT));
    if (s < 3) in->dial.top = s + 1;
    for (int m = 0; m < 6; ++m)
        for (int j = 0; j < st->r; ++j) {
            const int k = in->dial.top - m;
            gvi_real *to = in->dial.high + 6*j + m;
            *to = 0;
            if (k > 0 && k < s && s > 2)
                *to = in->table.inv_gamma[k]*modes[k*R + j]*in->table.b[j];
            if (k >= s) *to = gvi__mode_of_force(k, in->table.c[j])*in->table.b[j];
        }
    if (s > 2) return;

    gvi_real seen = 0;                            // of P_s, as the rule squares it: none by Gauss
    for (int j = 0; j < st->r; ++j)
        seen += in->dial.high[6*j]*gvi__mode_of_force(s + 1, in->table.c[j])*(gvi_real)(8*s + 4);
    for (int j = 0; j < st->r; ++j)
        in->dial.high[6*j] = seen > GVI__POOR ? in->dial.high[6*j]/seen : 0;
}

static gvi_real gvi__power(gvi_real x, int k)
{
    gvi_real y = 1;
    for (; k > 0; k >>= 1, x *= x)
        if (k & 1) y *= x;
    return y;
}

/* Are the highest modes of coordinate i nothing but rounding?  Of the terms of its row: P and A,
   where V is M^-1 (P - A), and A as large as P.  Or of t and q at its points, which is as large in
   all modes, to a factor of 4 (test_resolution misses either; the factor, in float alone).  all:
   the size of the velocity, or in positions of p.                                             */
static int gvi__modes_end(const gvi_stepper *st, int i, gvi_real high, gvi_real low, gvi_real all)
{
    const struct gvi__private *in = &st->in;
    const int forces = in->stages == 1;
    const gvi_real *row = (forces ? in->work.F : in->work.V) + i*in->R;
    const gvi_real h = GVI_ABS(in->sized.h), inertia = gvi__place_inertia(st, i),
                   p = GVI_ABS(in->state.p[i]), dp = GVI_ABS(in->step.p[i]),
                   first = row[0], last = row[st->r - 1], place = GVI__PLACE*GVI__EPS;
    gvi_real terms = GVI_ABS(first) + GVI_ABS(last), change = GVI_ABS(last - first),
             reach = GVI_ABS(in->state.q[i])/all;
    if (forces) {
        terms *= h;
        change *= h;
        reach *= inertia;
    } else {
        terms += (2*p + dp)/inertia*(in->adds_p ? 2 : 1);
        change += dp/inertia;
    }

    reach = (GVI_ABS(st->t) + reach)/h;
    return high <= place*terms || (low <= 4*high && high <= place*change*reach);
}

/* Mode K of coordinate i by the change of mode K - 1 since the step before; *was: its size there,
   in steps of this length.  Without a step before, for K = s = 3, as the modes y below it fall. */
static gvi_real gvi__mode_since(const gvi_stepper *st, int i, const gvi_real *y, gvi_real *was)
{
    const struct gvi__dial *dial = &st->in.dial;
    const gvi_real h = st->in.sized.h;
    if (!gvi__nonzero(dial->span))
        return st->s == 3 && dial->top == 3 && y[1] > 0 ? y[1]*(y[1]/(y[1] + y[2]))/4 : 0;

    const gvi_real before = dial->before[i]*gvi__power(h/dial->span, dial->top - 1),
                   change = (dial->now[i] - before)*(2*h/(h + dial->span));
    *was = GVI_ABS(before);
    return GVI_ABS(change)/(gvi_real)(4*dial->top - 2);
}

// rho^2 of gvi__resolution by the modes of one step
static gvi_real gvi__mode_fall(int top, const gvi_real *y)
{
    const gvi_real high = y[0] + y[1], low = y[2] + y[3], lower = y[4] + y[5],
                   fall = low > high ? high/low : 1, inside = y[0] < y[1] ? y[0]/y[1] : 1,
                   flat = GVI_SQRT(inside*fall*GVI_SQRT(fall));
    if (top < 6) return gvi__larger(flat, fall);
    if (lower <= high) return 1;

    const gvi_real before = lower > low ? low/lower : 1,
                   one = gvi__larger(GVI__STEADY*gvi__larger(before, fall), flat);
    return gvi__larger(GVI_SQRT(high/lower), one);
}

/* What coordinate i lacks of its velocity, of which y are the modes K, K - 1 .., `ends` at both
   ends and `turn` from end to end.  all: its size.                                            */
static gvi_real gvi__missed(const gvi_stepper *st, int i, const gvi_real *y, gvi_real ends,
                            gvi_real turn, gvi_real *all)
{
    const int top = st->in.dial.top, e = 2*st->s - top,
              stiff = st->formulation == GVI_NEWTON && st->in.chosen != GVI_NEWTON
                      && !gvi__constrained(st);
    gvi_real high = y[0] + y[1], low = y[2] + y[3], since = 0, was = 0;

    *all = ends + high + low;
    if (top < 5) since = gvi__mode_since(st, i, y, &was);
    if (top < 4) {
        high = y[0] + since;                                     // alone, a mode may pass 0
        low = top == 3 ? y[1] + y[2] : turn;
    }
    // next to nothing: a force as simple as the curve, and no shorter step shows more of it
    if (!(high > 0) || gvi__modes_end(st, i, high, low, *all)) return high*GVI__EPS*GVI__EPS;
    if (stiff) return high;                                      // (make hard-measure)

    gvi_real fall = low > high ? high/low : 1;                   // rho^2
    if (top == 2) fall *= GVI_SQRT(fall);                        // from y_1, or nearly
    if (top >= 5) fall = gvi__mode_fall(top, y);
    else {
        const gvi_real half = (y[0] + since)/(2*(y[1] + was));
        fall = gvi__smaller(gvi__larger(half*half, fall), 1);
    }

    gvi_real lacks = gvi__power(fall, e/2)*GVI__MARGIN;
    if (e & 1) lacks *= GVI_SQRT(fall);
    return high*gvi__smaller(lacks, 1);
}

/* The error of a step relative to the motion, as Legendre modes y_k of its velocity tell it: k up
   to K = s where forces make the curve, which lacks that mode, else K = s - 1.  Of a coordinate

     high = |y_K| + |y_(K-1)|     low = |y_(K-2)| + |y_(K-3)|     lower = |y_(K-4)| + |y_(K-5)|
     rho = max((high/lower)^(1/4), 0.8 (high/low)^(1/2), 0.8 (low/lower)^(1/2),
               |y_K/y_(K-1)|^(1/4) (high/low)^(3/8)), at most 1
     high min(1, 10 rho^e)                                        e = 2 s - K

   rho is the fall from mode to mode, last from pair to pair and within the highest: forces that
   bend inside a step leave a tail that is flat there.  The step lacks about y_2s, which its points
   take for modes that they see: high rho^e; ten times that, since a short tail may be flatter than
   it looks.  Stiff forces, for which Newton's method had to take over, turn all of y_s into an
   error: high.  (With constraints it takes over for other reasons.)  Below K = 6 two pairs count;
   below 5 low is a constant force as well, which falls nowhere, and below 4 single modes count.
   There y_(K-1) of the step before, y', says more: |y_(K-1) - y'|/(4 K - 2) is a mode K, too, and
   rho at least half of both over |y_(K-1)| + |y'|.  In positions the modes are those of M v, from
   the forces.  Where motion is far below max |v| + max |q|/h, each times sqrt(M_ii), and below max
   |v| + |q_i|/h, so that neither a light body nor one near the origin counts as at rest, some eps
   of the smaller of these are rounding of forces that cancel.  Under constraints rounding of g over
   h is in every velocity, and is all there is of one that starts from rest: no error of h.     */
static gvi_real gvi__resolution(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int R = in->R, top = in->dial.top, forces = in->stages == 1,
              constrained = gvi__constrained(st),
              pulled = forces & constrained ? top < 6 ? top : 6 : 0;
    const gvi_real *row = forces ? in->work.F : in->work.V;
    const gvi_real h = GVI_ABS(in->sized.h), unit = forces ? h : 1;
    gvi_real *missed = in->answer, *size = missed + st->n, *mass = size + st->n;
    gvi_real fastest = 0, farthest = 0, v = 0, worst = 0;
    for (int i = 0; i < st->n; ++i, row += R) {
        const gvi_real *a = in->dial.high;
        gvi_real y[6] = { 0, 0, 0, 0, 0, 0 }, start = row[0], end = row[st->r - 1];
        for (int j = 0; j < st->r; ++j, a += 6)
            GVI__UNROLL for (int m = 0; m < 6; ++m) y[m] += a[m]*row[j];
        for (int m = 0; m < pulled; ++m)
            y[m] += in->table.inv_gamma[top - m]*gvi__constraint_mode(st, i, top - m);
        in->dial.now[i] = unit*y[1];
        GVI__UNROLL for (int m = 0; m < 6; ++m) y[m] = unit*GVI_ABS(y[m]);
        if (forces) {
            start = in->state.p[i];
            end = start + in->step.p[i];
        }
        mass[i] = GVI_SQRT(gvi__place_inertia(st, i));
        const gvi_real scale = forces ? 1/mass[i] : mass[i];
        missed[i] = scale*gvi__missed(st, i, y, GVI_ABS(start) + GVI_ABS(end),
                                      GVI_ABS(end - start), size + i);
        size[i] *= scale;                         // p over M
        fastest = gvi__larger(size[i], fastest);
        farthest = gvi__larger(GVI_ABS(in->state.q[i])*mass[i], farthest);
        v = gvi__larger(size[i]/mass[i], v);
    }

    const gvi_real whole = fastest + farthest/h, *shift = gvi__constraint_shift(st);
    if (!(whole > 0)) return 0;
    for (int i = 0; i < st->n; ++i) {
        const gvi_real around = gvi__smaller(mass[i]*(v + GVI_ABS(in->state.q[i])/h), whole);
        const int at_rest = size[i] < around/GVI__AT_REST;

        // what rounding makes of it: of g, of forces that cancel, of those of constraint anywhere
        gvi_real rounding = shift ? mass[i]*shift[i]/h : 0;
        if (at_rest || (shift && forces))
            rounding = gvi__larger(GVI__EPS*(shift ? whole : around), rounding);
        if (missed[i] <= GVI__PULLED*rounding) missed[i] *= GVI__EPS*GVI__EPS;
        worst = gvi__larger(missed[i]/size[i], worst);
    }
    return worst;
}

/* Mode s + 1 of coordinate i's velocity, times its inertia; v: (v0 + v1)/2, end: impulse there.
   Explicit steps: v is a parabola, whose y_2 is what v is off dq/h, over 3, with the step's error
   in q.  Else by forces: see gvi__coarse_resolution.                                          */
static gvi_real gvi__coarse_mode(const gvi_stepper *st, int i, gvi_real v, gvi_real end)
{
    const struct gvi__private *in = &st->in;
    const gvi_real *F = in->work.F + i*in->R, *a = in->dial.high, h = GVI_ABS(in->sized.h);
    gvi_real high = 0, low = 0, unseen = 0, was;
    if (in->stages == 0) return gvi__place_inertia(st, i)*(v - in->step.q[i]/in->sized.h)/3;

    for (int j = 0; j < st->r; ++j, a += 6) {
        high += a[0]*F[j];
        low += a[1]*F[j];
    }
    in->dial.now[i] = h*low;
    if (!gvi__nonzero(in->dial.high[0])) unseen = gvi__mode_since(st, i, NULL, &was);
    if (gvi__constrained(st)) high += gvi__high_constraint_mode(st, i, end/h);
    return GVI_ABS(h*high) + unseen;
}

/* Degrees 1 and 2, whose curves have too few modes: by mode s of the forces, F and those of
   constraint, which Lobatto's points have and the curve lacks.  It makes y_(s+1) of the velocity:

     10 |y_(s+1)|/(|p0| + |p1|)         all coordinates together, in the norm of M^-1

   Where the rule does not see that mode of F, as Gauss's with r = s, the change of y_s since the
   step before tells it, as in gvi__resolution.  From rest there is nothing to be relative to: 0. */
static gvi_real gvi__coarse_resolution(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int n = st->n, stride = in->stages > 0 ? in->R : 1;
    const gvi_real *shift = gvi__constraint_shift(st), h = GVI_ABS(in->sized.h);
    gvi_real *end = in->answer, *v = end + n, began = 0, size = 0, far = 0, high = 0, floor = 0;

    gvi__end_impulse(st, end);
    gvi__add_scaled(n, (gvi_real)0.5, in->step.p, in->state.p, v);
    if (in->stages == 0) gvi__over_mass(st, v, 1, 1);
    for (int i = 0; i < n; ++i) {
        const gvi_real m = gvi__place_inertia(st, i), p = in->state.p[i], q = in->state.q[i],
                       all = GVI_ABS(p) + GVI_ABS(p + in->step.p[i]),
                       y = gvi__coarse_mode(st, i, v[i], end[i]),
                       rounding = GVI__EPS*h*GVI_ABS(in->work.F[i*stride])
                                  + (shift ? m*shift[i]/h : 0);
        began += p*p/m;
        size += all*all/m;
        far += q*q*m;
        high += y*y/m;
        floor += rounding*rounding/m;
    }

    const gvi_real whole = GVI_SQRT(size) + GVI_SQRT(far)/h;
    if (size*GVI__AT_REST*GVI__AT_REST < whole*whole) floor += GVI__EPS*GVI__EPS*whole*whole;
    if (!(began > 0) || high <= GVI__SOLVED*GVI__SOLVED*floor) return 0;
    return GVI__MARGIN*GVI_SQRT(high/size);
}

static gvi_status gvi__dial_accept(gvi_stepper *st)
{
    st->resolution = st->s < 3 ? gvi__coarse_resolution(st) : gvi__resolution(st);
    if (st->resolution > st->in.desc.resolution)
        return gvi__report_status(st, GVI_E_RESOLUTION);
    st->counters.worst_resolution = gvi__larger(st->resolution, st->counters.worst_resolution);
    gvi__copy((size_t)st->n, st->in.dial.now, st->in.dial.before);
    st->in.dial.span = st->in.sized.h;
    return GVI_OK;
}

/* ---- the length of the next step ---- */

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

/* How many rungs up, after a step that succeeded.  `room`: up to where the resolution, of order
   2s - 1 in h, or 2 at degree 1, reaches its limit, less a margin.  What was lost of it since the
   step before will be lost again; two octaves are no measure.  From 0 to GVI__BAND rungs h stays.
   Work over time is iterations/h: from GVI__MANY of them on h does not grow, from 5/3 of that on
   it shrinks.                                                                                 */
static gvi_real gvi__rungs_up(gvi_stepper *st, gvi_real at, gvi_real room)
{
    struct gvi__dial *dial = &st->in.dial;
    // by velocities the iteration contracts with h, not h^2
    const int many = st->in.stages == 2 ? GVI__MANY*3/2 : GVI__MANY,
              iterations = st->formulation == GVI_NEWTON ? 0 : st->iterations;
    gvi_real left = room, up = 0;

    if (room < 2*GVI__GROWS && dial->reach - at < 2*GVI__GROWS)
        left -= gvi__larger(dial->reach - (at + room), 0);
    dial->reach = at + room;

    if (left > GVI__BAND) up = gvi__smaller(left - GVI__BAND, GVI__GROWS);
    if (left < 0) up = gvi__larger(left - 1, -2*GVI__GROWS);
    if (iterations >= many) up = gvi__smaller(up, 0);
    if (iterations >= many*5/3) up = gvi__smaller(up, -1);

    dial->wait -= dial->wait > 0;
    if (dial->wait > 0 && up > 0)
        up = gvi__larger(gvi__smaller(up, dial->barrier - 1 - at), 0);
    return up;
}

/* The same after a failure.  The length is barred for a while, longer each time.  Where the fixed
   point failed, shorter steps come first; Newton's method is for where they fail, too, or are far
   shorter than the resolution allows, and then it stays.  (test_resolution has both.)         */
static gvi_real gvi__rungs_down(gvi_stepper *st, gvi_status status, gvi_real at, gvi_real room)
{
    struct gvi__dial *dial = &st->in.dial;

    dial->again = GVI_ABS(at - dial->barrier) > 2 ? 0 : dial->again + (dial->again < 4);
    dial->wait = GVI__WAIT << dial->again;
    dial->barrier = at;
    if (status == GVI_E_RESOLUTION) return gvi__larger(gvi__smaller(room, 0) - 1, -2*GVI__GROWS);

    dial->reach = gvi__larger(dial->reach, at);   // the resolution may have allowed it
    return dial->put_off ? -3 : -2*GVI__GROWS;
}

// st.next after a step of length h, which an end may have made shorter than st.next was
static void gvi__set_next(gvi_stepper *st, gvi_status status, gvi_real h)
{
    const gvi_real seen = gvi__larger(st->resolution, GVI__MIN), at = gvi__rungs(h);
    const gvi_real most = gvi__rungs(st->in.desc.resolution) - gvi__rungs(seen);
    // the modes end at rounding: above GVI__DEEP the resolution falls no faster than there
    const int degree = st->s < GVI__DEEP ? st->s : GVI__DEEP;
    const gvi_real order = (gvi_real)(degree > 1 ? 2*degree - 1 : 2), room = most/order - 1,
                   up = status == GVI_OK ? gvi__rungs_up(st, at, room)
                                         : gvi__rungs_down(st, status, at, room),
                   // half of what was left to an end, doubled, is to be all of it
                   next = gvi__length(up + (up > 0 && h < st->next ? -GVI_FLOOR(-at) : at));
    if (up < 0 || next > st->next) st->next = next;
}

/* A first length: 1/16 of the time in which the forces would make the kinetic energy that there is;
   1/1024 of the way where that is less, or from rest.  Both by what is the same in every gauge:
   v.M v, and how fast v changes with p as the forces drive that.                              */
GVI__COLD gvi_real gvi__first_length(gvi_stepper *st, gvi_real left)
{
    const int n = st->n, inertia = st->in.desc.mass.kind != GVI_MASS_NONE;
    gvi_real *v = st->in.answer, *later = v + n, *p = later + n;
    const gvi_real longest = left/1024;
    gvi_points at = gvi__one_point(st, &st->t, st->q);

    gvi__velocity_guess(st, v);
    gvi_status status = gvi__velocity(st, st->t, st->q, st->p, v);
    at.v = v;
    if (status == GVI_OK) status = gvi__evaluate(st, &at, ~0u, 1);               // M v
    const gvi_real moving = GVI_ABS(gvi__dot(n, inertia ? at.dldv : st->p, v));

    if (status == GVI_OK) status = gvi__evaluate(st, &at, 0, 1);
    for (int i = 0; i < n; ++i) {
        later[i] = v[i];
        p[i] = st->p[i] + longest*at.f[i];
    }
    if (status == GVI_OK) status = gvi__velocity(st, st->t, st->q, p, later);
    for (int i = 0; i < n; ++i) later[i] = (later[i] - v[i])/longest;
    const gvi_real pushing = GVI_ABS(gvi__dot(n, at.f, later)),
                   time = GVI_SQRT(moving/pushing)/16;
    return status == GVI_OK && time > 0 && time < longest ? time : longest;
}

GVI_DEF gvi_status gvi_advance(gvi_stepper *st, gvi_real t_end)
{
    const gvi_status ready = gvi__ready(st, st && st->in.started);
    if (ready != GVI_OK) return ready;
    if (!(st->in.desc.resolution > 0))
        return gvi__refuse_call(st, "gvi_advance needs desc.resolution");
    st->in.failed.status = GVI_OK;                // as in gvi_step
    if (!gvi__finite(t_end) || !gvi__nonzero(t_end - st->t))
        return gvi__refuse_call(st, "t_end is t, NaN or infinite");
    const gvi_real way = (t_end - st->t) - st->t_low, left = gvi__smaller(GVI_ABS(way), GVI__MAX);
    const int clock = gvi__clock_is_on(st);
    if (!(st->next > 0) || !gvi__finite(st->next)) st->next = gvi__first_length(st, left);
    for (int tries = 1; ; ++tries) {
        gvi_real h = st->next;
        if (!clock && left < h*2) h = left/2;
        if (!clock && left < st->next*(gvi_real)1.0625) h = left;
        st->in.dial.put_off = st->formulation != GVI_NEWTON
                              && st->in.dial.reach - gvi__rungs(h) < GVI__SHORTER;
        const gvi_status status = gvi_step(st, way > 0 ? h : -h);
        gvi__set_next(st, status, h);
        st->in.dial.put_off = 0;
        if (status == GVI_OK) {
            if (!clock && h >= left) {
                st->t_low += st->t - t_end;
                st->t = t_end;
            }
            return status;
        }
        if (status == GVI_E_ARGUMENT || status == GVI_E_SINGULAR || tries == st->in.desc.tries
            || !gvi__nonzero(st->t + st->next - st->t)) return status;
    }
}
#endif /* GVI_NO_DIAL */

#ifndef GVI_NO_BOUNDARY
/* ------------------------------------------------------- BOUNDARY VALUES

   The discrete Lagrangian L_d(q0, q1): the curve between two configurations, rows k >= 1 of (1) by
   Newton's method, with its derivatives, discrete forces and conjugate points.                */

/* The curve between the boundary values by degree 1: a chord, point by point, nothing to solve.
   F at its points goes to work.F, and the sum of b_i P_i to p.                                */
GVI__COLD gvi_status gvi__chord(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                const gvi_real *q1, gvi_real *p)
{
    struct gvi__private *in = &st->in;
    const int n = st->n, R = in->R;
    gvi_real *q = in->answer, *v = q + n;

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
        GVI__LOOK(st, 1);
        const gvi_status status = gvi__evaluate(st, &at, 0, 1);
        GVI__LOOK(st, 0);
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
    gvi__descent p = { 0, 0, GVI__MAX, 0, GVI__MAX, 0, GVI__MAX, 0, 0, 0, 0, 0, 0, 0, 0 };
    gvi_real *y = in->newton.y, before = 0, length = 0;

    if (grow > 1 && J->k0 == 0) {
        in->predictor.ratio = 0;
        gvi__fit(st, st->r, in->table.c, in->table.c, 0, grow, 1, in->predictor.one);
        gvi__newton_modes(st, in->work.V, in->newton.P);
    }

    if (J->k0)
        for (int k = n; k < st->s*n; ++k) y[k] *= grow;
    gvi__newton_points(st, from, h);
    for (int k = -bow; k < 2; ++k) {
        gvi_status status = gvi__newton_values(st, from);
        if (status != GVI_OK) return status;
        gvi__residual(st, from, J, &p);
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

// straight from the chord, then with halving
GVI__COLD gvi_status gvi__from_chord(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                     const gvi_real *q1, const gvi__matrix *J)
{
    const int n = st->n;
    gvi_real *y = st->in.newton.y;
    gvi_status status = GVI_OK;
    for (int halves = 0; halves < 2; ++halves) {
        const gvi__matrix plain = { J->square, J->pivot, J->ends, 1, 0, halves, NULL, NULL };
        gvi__zero((size_t)(st->s*n), y);
        for (int i = 0; i < n; ++i) y[i] = (q1[i] - from->q[i])/h;
        status = gvi__newton_solve(st, from, &plain);
        if (status == GVI_OK) break;
    }
    return status;
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
    const gvi__matrix motion = { J->square, J->pivot, NULL, 0, 0, 0, NULL, NULL };
    gvi_real *y = in->newton.y, *end = in->step.q_low;
    gvi_status bowed = GVI_E_NON_FINITE;
    int first = 0, left = 2 + in->desc.max_iterations*2/3;         // pieces, in all

    if (v) {
        first = 4;
        left = GVI__NEVER;
    } else if (any) {                             // whoever wants the index judges for himself
        *status = gvi__from_chord(st, from, h, q1, J);
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
        if (*status == GVI_OK && (!linear || bent < GVI__CLOSE)) return linear;
        if (linear) bowed = *status;
        if ((*status == GVI_E_NON_FINITE && GVI__LOOKS(st)) || left <= 0) break;
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
        GVI__LOOK(st, look);
        linear = gvi__follow(st, from, h, q1, out->guess, out->negative != NULL, J, &status);
        GVI__LOOK(st, 0);
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
    if (in->desc.mass.kind <= GVI_MASS_DENSE && !gvi__with_hessian(in, 0))
        error = GVI__SOLVED*GVI__EPS;
    if (gvi_lu_rcond(size, J->square, J->pivot, in->newton.moved) < error) status = GVI_E_CONJUGATE;
    for (int i = 0; i < n; ++i) p[i] = gvi__dot(st->r, in->table.b, in->newton.P + i*in->R);
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


// what is wrong with boundary values, or no formulation covers them
GVI__COLD gvi_status gvi__check_boundary(gvi_stepper *st, gvi_real t, gvi_real h,
                                         const gvi_real *q0, const gvi_real *q1,
                                         const gvi_discrete *out)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    if (!q0 || !q1 || !out) return gvi__refuse_call(st, "q0, q1 or out is NULL");
    if (gvi__first_non_finite(n, q0) >= 0 || gvi__first_non_finite(n, q1) >= 0 || !gvi__finite(t)
        || (out->guess && gvi__first_non_finite(n, out->guess) >= 0))
        return gvi__refuse_call(st, "t, q0, q1 or the guess is not finite");
    if (!gvi__finite(h) || !gvi__nonzero(h))
        return gvi__refuse_call(st, "h is 0, NaN or infinite");
    if (in->separate) {                            // constraints, a clock
        gvi__report_status(st, GVI_E_FORMULATION);
        gvi__unsolved(in, &st->fault);
        return gvi__done(st, GVI_E_FORMULATION);
    }
    if ((st->s > 1 && !in->newton.covers) || !gvi__has_curve(st))
        return gvi__done(st, GVI_E_FORMULATION);
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
    status = gvi__check_boundary(st, t, h, q0, q1, out);
    if (status != GVI_OK) return status;
    gvi__origin from = { t, 0, q0, in->zeros, in->zeros, in->zeros };
    gvi__matrix J = { NULL, NULL, NULL, 1, 0, 0, NULL, NULL };
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

    gvi__newton_points(st, &from, h);

    gvi_real *p0 = in->step.q, *p1 = in->step.p_low, *minus = in->answer, *plus = minus + n,
             action = 0;
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
        in->step.p[i] = gvi__dot(st->r, hb, F + i*R);
        p1[i] = p0[i] + in->step.p[i];
    }

    // as accurate as a step from (q0, p0) has to be
    const struct gvi__phase state = in->state;
    gvi__copy((size_t)n, q0, in->step.q_low);
    in->state.q = in->step.q_low;
    in->state.p = p0;
    status = gvi__place_accept(st);
    in->state = state;
    if (status == GVI_OK) status = gvi__discrete_forces(st, &J, minus, plus);
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
#endif /* GVI_NO_BOUNDARY */

#ifndef GVI_NO_EXPLAIN
/* ------------------------------------------------------------- DIAGNOSIS

   Which effect was it?  A step that came to NaN or Inf is done once more, looking at what every
   effect returns; what is wrong already at its start is kept apart from what a shorter step may
   mend; and a first start probes the callbacks.                                               */

/* All points of a step at one state, values [n][R] of f and, behind them, dldv; of kicks one. */
GVI__COLD gvi_points gvi__all_points_at(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                        const gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const int n = st->n;
    int R = in->R, count = st->r;
    gvi_real *values = in->work.F;

    if (!gvi__has_curve(st)) R = count = 1;
    if (in->free.values) values = in->free.values;
    gvi_points at = gvi__points_at(st, count, R, in->t, in->work.Q, values, values + n*R);
    at.v = in->work.V;
    for (int k = 0; k < R; ++k) in->t[k] = t;
    for (int i = 0; i < n*R; ++i) {
        in->work.Q[i] = q[i/R];
        if (in->work.V) in->work.V[i] = v[i/R];
    }

    return at;
}

// in the repetition of a step that came to NaN or Inf: each effect alone, which gave it?
GVI__COLD gvi_status gvi__diagnose(gvi_stepper *st, gvi_points *at, unsigned skip,
                                   gvi_real *const *values)
{
    const size_t length = (size_t)at->n*(size_t)at->stride;
    for (int e = 0; e < st->in.desc.effect_count; ++e) {
        if (skip >> e & 1u) continue;
        gvi_real *value = values ? values[st->in.desc.effects[e].kind] : NULL;
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

// every effect that is on, in place of gvi__effects, while it is looked
static gvi_status gvi__explain_effects(gvi_stepper *st, gvi_points *at, unsigned skip,
                                       gvi_real *const *value)
{
    // points that are not finite: the iteration has diverged, and no effect is to blame
    if (gvi__check_rows(st, at, at->q, 0) != GVI_OK || gvi__check_rows(st, at, at->v, 0) != GVI_OK)
        return gvi__report_status(st, GVI_E_CONVERGENCE);
    const gvi_status status = gvi__each_effect(st, at, skip, value);
    if (status != GVI_OK) return status;
    int finite = gvi__check_rows(st, at, at->f, 0) == GVI_OK
                 && gvi__check_rows(st, at, at->dldv, 0) == GVI_OK;
    for (int kind = 0; value && kind <= GVI_LAGRANGIAN; ++kind)
        finite &= !value[kind] || gvi__first_non_finite(at->count, value[kind]) < 0;
    if (finite) return gvi__report_status(st, GVI_OK);
    return gvi__diagnose(st, at, skip | st->in.off | st->in.separate, value);
}

/* Why did a step fail?  What is singular, NaN or infinite already where it starts is reported as
   that: no h helps.  All else is the step's own, and a shorter one may do.                    */
GVI__COLD gvi_status gvi__explain_step(gvi_stepper *st, gvi_status status)
{
    struct gvi__private *in = &st->in;
    const gvi_counters counters = st->counters;
    const gvi_fault fault = st->fault;
    gvi_real *v = in->answer;
    gvi_status start = GVI_OK;

    gvi__velocity_guess(st, v);
    if (in->stages > 0 && !in->desc.mass.velocity)
        start = gvi__velocity(st, st->t, st->q, st->p, v);
    if (start == GVI_OK && gvi__place_explain(st, status, v, &start)) {
        st->counters = counters;
        return status;
    }

    if (start == GVI_OK) {
        gvi_points at = gvi__all_points_at(st, st->t, st->q, v);
        gvi__zero((size_t)(st->n*at.stride), at.f);
        if (in->adds_p) gvi__zero((size_t)(st->n*at.stride), at.dldv);
        else at.dldv = NULL;
        GVI__LOOK(st, 1);
        start = gvi__effects(st, &at, 0, NULL);
        GVI__LOOK(st, 0);
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

static gvi_status gvi__explain_failure(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                       int query, gvi_status status)
{
    if (status == GVI_E_NON_FINITE && st->fault.effect == GVI_FAULT_NONE) {
        GVI__LOOK(st, 1);
        do status = gvi__attempt(st, from, h, query);
        while (gvi__parts(&st->in) && gvi__place_again(st));
        GVI__LOOK(st, 0);
        if (status == GVI_OK || (status == GVI_E_NON_FINITE && st->fault.effect == GVI_FAULT_NONE))
            status = gvi__report_status(st, GVI_E_CONVERGENCE);
    }
    if (query != GVI__STEP) return status;
    if (status == GVI_E_CONVERGENCE || status == GVI_E_SINGULAR || status == GVI_E_NON_FINITE)
        status = gvi__explain_step(st, status);
    return status;
}

/* Where a probe looks, q and v behind it: for point 0 a little past q, where a force that is 0 at
   the start is not; for the others at 31/32 of q and half of v.                               */
static void gvi__probe_state(int n, const gvi_real *q, const gvi_real *v, int other,
                             gvi_real *state)
{
    for (int i = 0; i < n; ++i) {
        const gvi_real ahead = GVI_SQRT(GVI__EPS)*v[i];
        state[i] = other ? q[i] - q[i]/32 + ahead/2 : q[i] + ahead;
        state[n + i] = other ? v[i]/2 : v[i];
    }
}

// effect e at one point alone, with the M(q) that it may use, which comes first, as in a step
static gvi_status gvi__probe_one(gvi_stepper *st, gvi_points *one, int e)
{
    if (st->in.desc.mass.kind == GVI_MASS_POSITION) (void)gvi__evaluate_mass(st, one, NULL, NULL);
    gvi__zero(2*(size_t)st->n, one->f);
    return gvi__effect(st, one, e, NULL);
}

/* Does effect e, at points `at`, give what it gives at each of them alone, to 1/1024 of the largest
   number?  And does it add that?  If not, which slip is it?  It shows in the largest.         */
static const char *gvi__probe_loop(gvi_stepper *st, gvi_points *at, gvi_points *one, int e,
                                   const gvi_real *q, const gvi_real *v)
{
    const int n = st->n, R = at->stride,
              all = st->in.desc.effects[e].kind == GVI_LAGRANGIAN ? 2*n*R : n*R;
    gvi_real *values = at->f, largest = 0, before = 0;
    const char *slip = NULL;
    int unlike = 0, set = 0;

    if (st->in.desc.mass.kind == GVI_MASS_POSITION) (void)gvi__evaluate_mass(st, at, NULL, NULL);
    gvi__zero((size_t)all, values);
    if (gvi__effect(st, at, e, NULL) != GVI_OK) return NULL;
    for (int i = 0; i < all; ++i)
        if (i % R < at->count) largest = gvi__larger(GVI_ABS(values[i]), largest);
    for (int k = 0, known = 1; k < 2 + (at->count > 1) && known; ++k) {
        const int other = k > 1;
        gvi__probe_state(n, q, v, other, st->in.point);
        known = gvi__probe_one(st, one, e) == GVI_OK;
        const gvi_real sum = gvi__norm1(2*n, one->f);
        if (k == 1 && gvi__nonzero(sum - before)) known = 0;      // noise is not to be judged
        before = sum;
        for (int i = 0; i < all/R; ++i) largest = gvi__larger(GVI_ABS(one->f[i]), largest);
        for (int i = 0; i < all && known && k > 0; ++i)
            unlike |= i % R < at->count && (i % R > 0) == other
                      && GVI_ABS(values[i] - one->f[i/R]) > largest/GVI__SURE;
    }

    if (unlike)
        slip = "effect: fills not all points: coordinate i of point k < x->count is at "
               "[i*x->stride + k]";
    for (int i = 0; i < all; ++i) values[i] = GVI__MAX;
    if (gvi__effect(st, at, e, NULL) != GVI_OK) return slip;
    for (int i = 0; i < all; ++i) set |= i % R < at->count && GVI_ABS(values[i]) < GVI__MAX/2;
    if (set && !(largest > GVI__MAX/4))
        slip = "effect: sets f or dldv with =, where it has to add with +=";
    return slip;
}

/* At a first start, finds callbacks whose loop over points is missing or wrong, or that set f and
   dldv with = instead of adding to them.                                                      */
GVI__COLD gvi_status gvi__probe(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    struct gvi__private *in = &st->in;
    const gvi_counters counters = st->counters;          // a probe is no step's work
    gvi_points at = gvi__all_points_at(st, t, q, v), one = gvi__one_point(st, &t, in->point);
    const int n = st->n, R = at.stride;

    for (int other = 0; other < 2; ++other) {
        gvi__probe_state(n, q, v, other, in->point);
        for (int i = 0; i < n*R; ++i) {
            if (i % R >= at.count || (i % R > 0) != other) continue;
            in->work.Q[i] = in->point[i/R];
            if (in->work.V) in->work.V[i] = in->point[n + i/R];
        }
    }

    for (int e = 0; e < in->desc.effect_count; ++e) {
        const int adds_p = in->desc.effects[e].kind == GVI_LAGRANGIAN;
        if ((in->off | in->separate) >> e & 1u) continue;

        // what is wrong at the very start no step mends
        one.q = q;
        one.v = v;
        gvi_status status = gvi__probe_one(st, &one, e);
        if (status == GVI_OK) status = gvi__check_rows(st, &one, one.f, e);
        if (status == GVI_OK && adds_p) status = gvi__check_rows(st, &one, one.dldv, e);
        if (status != GVI_OK) {
            st->counters = counters;
            st->fault.point = GVI_FAULT_NONE;
            return st->status = status;
        }

        one.q = in->point;
        one.v = in->point + n;
        const char *slip = gvi__probe_loop(st, &at, &one, e, q, v);
        if (!slip) continue;
        st->counters = counters;
        return st->status = gvi__refuse(&st->fault, e, GVI_FAULT_NONE, slip);
    }

    st->counters = counters;
    return gvi__report_status(st, GVI_OK);
}
#endif /* GVI_NO_EXPLAIN */

/* ------------------------------------------------------------- SENTENCES */

#ifndef GVI_NO_TEXTS
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
    case GVI_E_STATE:       return "outside the last step, which is from st.t0 to st.t; before "
                                   "gvi_start or the first step; or a clock is on since";
    case GVI_E_CONJUGATE:   return "conjugate points: the ends do not determine the curve";
    case GVI_E_CLOCK:       return "a clock (fault.effect) must be positive: g <= 0";
    case GVI_E_CONSTRAINT:  return "the state is not on a constraint (fault.effect, its row in "
                                   "fault.coordinate): g(t,q) or its rate is not 0";
    case GVI_E_RESOLUTION:  return "the step is not as accurate as desc.resolution wants it: "
                                   "halve h";
    default:                return "unknown status";
    }
}

// with a description or a call that no formulation covers
GVI__COLD const char *gvi__why_no_formulation(const gvi_stepper *st)
{
    const struct gvi__private *in = &st->in;
    const int kicks = (in->desc.rule.kind == GVI_KICKS), clock = gvi__of_kind(in, GVI_CLOCK) != 0,
              ready = in->memory != 0;

    if (gvi__of_kind(in, GVI_CONSTRAINT) | gvi__of_kind(in, GVI_NONHOLONOMIC))
        return "constraints go with no clock, kicks or boundary values; with a formulation "
               "pinned or iterations given, what that covers (GVI_NEWTON: all)";
    if (ready && st->fault.effect >= 0)
        return "under a clock this value (fault.effect) must not change with t: list it as a force";
    if (ready && (kicks || clock)) return "kicks have no curve and no action, clocks no action";
    if (ready) return "needs GVI_NEWTON, or GVI_AUTO with s n <= 1024 and no given iterations";
    if (in->chosen == GVI_NEWTON) return "iterations is given, and this takes Newton's method";
    if (kicks) return "kicks are for constant mass and effects that read only t and q";
    if (clock) return "a clock needs r = s, and a mass or mass.velocity";
    if (in->desc.formulation == GVI_VELOCITIES && in->adds_p)
        return "velocities take no Lagrangian terms: GVI_MOMENTA does where r = s, GVI_NEWTON else";
    if (in->desc.formulation != GVI_AUTO)
        return "the pinned formulation does not cover this scene, or a macro leaves it out";
    return "what this scene needs is left out by a macro GVI_NO_...";
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
        return "a constraint (fault.effect, its row in fault.coordinate) depends on the others, is "
               "about to, or has no gradient: no h helps";
    if (why == GVI_E_CONSTRAINT && in->failed.status == why)
        return "a row (fault.coordinate of fault.effect) that counts as dependent on others is not "
               "fulfilled: they contradict, or masses differ by more than 1e13";
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
    case GVI_VELOCITIES: return "velocities: constant mass, a force reads v";
    case GVI_MOMENTA:    return "momenta: r = s, velocity from momentum at each point";
    case GVI_NEWTON:     return "Newton: no fixed point covers this mass, degree and rule";
    case GVI_AUTO: default: return "not set up";
    }
}
#else
GVI_DEF const char *gvi_status_text(gvi_status status) { return (void)status, ""; }
GVI_DEF const char *gvi_why(const gvi_stepper *st) { return (void)st, ""; }
GVI_DEF const char *gvi_formulation_text(const gvi_stepper *st) { return (void)st, ""; }
#endif /* GVI_NO_TEXTS */

/* ----------------------------------------------------------- SWITCHBOARD

   What happens at each place that several chapters share, in which order.
   GVI__CLOCK(what): done if the scene uses that chapter; GVI__CLOCK_ON, GVI__CONSTRAINTS_ON: if
   the clock, a constraint, is on.                                                             */

#define GVI__IF(chapter, ...) if (gvi__parts(&st->in) & GVI__IN_##chapter) { __VA_ARGS__; }
#ifdef GVI_NO_LAGRANGIAN
#define GVI__LAGRANGIAN(...)
#else
#define GVI__LAGRANGIAN(...) GVI__IF(LAGRANGIAN, __VA_ARGS__)
#endif
#ifdef GVI_NO_MOMENTA
#define GVI__MASS(...)
#define GVI__MOMENTA(...)
#else
#define GVI__MASS(...) GVI__IF(MASS, __VA_ARGS__)
#define GVI__MOMENTA(...) GVI__IF(MOMENTA, __VA_ARGS__)
#endif
#ifdef GVI_NO_CLOCK
#define GVI__CLOCK(...)
#define GVI__CLOCK_ON(...)
#else
#define GVI__CLOCK(...) GVI__IF(CLOCK, __VA_ARGS__)
#define GVI__CLOCK_ON(...) if (gvi__clock_is_on(st)) { __VA_ARGS__; }
#endif
#ifdef GVI_NO_KICKS
#define GVI__KICKS(...)
#else
#define GVI__KICKS(...) GVI__IF(KICKS, __VA_ARGS__)
#endif
#ifdef GVI_NO_NEWTON
#define GVI__NEWTON(...)
#else
#define GVI__NEWTON(...) GVI__IF(NEWTON, __VA_ARGS__)
#endif
#ifdef GVI_NO_CONSTRAINTS
#define GVI__CONSTRAINTS(...)
#define GVI__CONSTRAINTS_ON(...)
#else
#define GVI__CONSTRAINTS(...) GVI__IF(CONSTRAINTS, __VA_ARGS__)
#define GVI__CONSTRAINTS_ON(...) if (gvi__constrained(st)) { __VA_ARGS__; }
#endif

#ifdef __GNUC__                                   // what a place is given, not all of it is used
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-variable"
#endif

/* ---- set-up ---- */

GVI__COLD int gvi__place_effect(struct gvi__private *in, int e, const char **wrong)
{
    const gvi_kind kind = in->desc.effects[e].kind;
#ifndef GVI_NO_LAGRANGIAN
    if (kind == GVI_LAGRANGIAN) {
        in->parts |= GVI__IN_LAGRANGIAN;
        return 1;
    }
#endif
#ifndef GVI_NO_CLOCK
    if (kind == GVI_CLOCK) {
        *wrong = gvi__wrong_in_clock(in, e);
        in->parts |= GVI__IN_CLOCK;
        in->separate |= 1u << e;
        in->time.effect = e;
        return 1;
    }
#endif
#ifndef GVI_NO_CONSTRAINTS
    if (kind >= GVI_CONSTRAINT) {
        *wrong = gvi__wrong_in_constraint(in, e);
        in->parts |= GVI__IN_CONSTRAINTS;
        in->separate |= 1u << e;
        in->con.bits |= 1u << e;
        in->con.m += in->desc.effects[e].rows;
        if (kind == GVI_NONHOLONOMIC) gvi__rolling_effect(in, e);
        return 1;
    }
#endif
    return 0;
}

GVI__COLD int gvi__place_mass(struct gvi__private *in, const char **wrong)
{
    in->parts |= GVI__IN_MASS;
#ifndef GVI_NO_MOMENTA
    *wrong = gvi__wrong_in_varying_mass(&in->desc.mass);
#else
    if (in->desc.mass.kind == GVI_MASS_POSITION || in->desc.mass.velocity) return 0;
#endif
#ifdef GVI_NO_LAGRANGIAN
    if (in->desc.mass.kind == GVI_MASS_NONE) return 0;
#else
    if (in->desc.mass.kind == GVI_MASS_NONE && !in->adds_p)
        *wrong = "mass: none, and no Lagrangian term";
#endif
    return 1;
}

GVI__COLD gvi_status gvi__place_rule(struct gvi__private *in, int *order, gvi_fault *fault)
{
    const gvi_rule *rule = &in->desc.rule;
    gvi_status status = GVI_E_FORMULATION;
    *order = 0;
#ifndef GVI_NO_KICKS
    if (rule->kind == GVI_KICKS) {
        if (in->desc.degree != 1)
            return gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE, "degree: kicks have 1");
        status = gvi__check_kicks(rule);
    }
#endif
#ifndef GVI_NO_RULES
    if (rule->kind == GVI_OWN) status = gvi__check_own_rule(in, order);
    if (status == GVI_OK && *order > 0 && *order < 2*in->desc.degree - 2)
        in->parts |= GVI__IN_RULES;
#endif
    return status == GVI_OK && !gvi__sums_to_1(rule) ? GVI_E_ORDER : status;
}

// what PART I cannot do, and which formulations are chapters
GVI__COLD int gvi__place_covers(struct gvi__private *in, gvi_formulation f)
{
    const gvi_desc *d = &in->desc;
    const int clock = gvi__of_kind(in, GVI_CLOCK) != 0,
              holds = (gvi__of_kind(in, GVI_CONSTRAINT) | gvi__of_kind(in, GVI_NONHOLONOMIC)) != 0,
              kicks = d->rule.kind == GVI_KICKS,
              constant = d->mass.kind <= GVI_MASS_DENSE && !clock && !(holds && in->adds_p);

    if (holds && (clock || kicks)) return 0;
    if (f == GVI_POSITIONS) return GVI__ITERATION && constant && !kicks && !in->reads_v;
    if (f == GVI_VELOCITIES) return GVI__ITERATION && constant && !kicks && !in->adds_p;
#ifndef GVI_NO_KICKS
    if (f == GVI_EXPLICIT) return gvi__kicks_cover(in, constant);
#endif
#ifndef GVI_NO_MOMENTA
    if (f == GVI_MOMENTA) return !kicks && gvi__momenta_cover(in, holds);
#endif
#ifndef GVI_NO_NEWTON
    if (f == GVI_NEWTON) return !kicks && !clock;
#endif
    return 0;
}

GVI__COLD gvi_status gvi__place_chosen(struct gvi__private *in, int order, gvi_fault *fault)
{
    const gvi_desc *d = &in->desc;
    const char *wrong = NULL;
    int matrices = in->adds_p;

    if (in->chosen == GVI_MOMENTA) in->parts |= GVI__IN_MOMENTA;
    if (in->chosen == GVI_EXPLICIT) in->parts |= GVI__IN_KICKS;
    if (in->chosen == GVI_EXPLICIT) in->stages = 0;
#ifndef GVI_NO_NEWTON
    if (in->chosen == GVI_NEWTON && d->iterations > 0) return GVI_E_FORMULATION;
    in->fallback = gvi__newton_follows(in, gvi__con_rows(in));
    in->newton.covers = in->chosen == GVI_NEWTON || in->fallback;
    matrices |= in->newton.covers;
    if (in->chosen == GVI_NEWTON) in->parts |= GVI__IN_NEWTON;
#endif
    if (matrices && d->n > 0x7FFF) wrong = "n is above 32,767, and matrices may be needed";
#ifndef GVI_NO_CONSTRAINTS
    const int widest = d->n > in->con.m ? d->n : in->con.m;                      // of G, or of A
    if (in->con.m > 0x7FFFFFFF/(GVI__ROW(d->degree + 1)*widest))
        wrong = "n, degree and rows of constraints are too large together";
#endif
    if (d->resolution > 0) {
#ifdef GVI_NO_DIAL
        return GVI_E_FORMULATION;
#else
        wrong = gvi__wrong_in_resolution(d, order);
        in->desc.resolution = gvi__larger(d->resolution, GVI__EPS);
#endif
    }

    return wrong ? gvi__refuse(fault, GVI_FAULT_NONE, GVI_FAULT_NONE, wrong) : GVI_OK;
}

GVI__COLD void gvi__place_layout(struct gvi__private *in, gvi__arena *a)
{
#ifndef GVI_NO_RULES
    const size_t s = (size_t)in->desc.degree, full = (in->parts & GVI__IN_RULES) != 0;
    in->rules.gamma = gvi__take(a, full, s*s + s + 1);
#endif
#ifndef GVI_NO_LAGRANGIAN
    if (in->adds_p) gvi__lagrangian_layout(in, a);
#endif
#ifndef GVI_NO_MOMENTA
    gvi__momenta_layout(in, a);
#endif
#ifndef GVI_NO_CLOCK
    if (in->parts & GVI__IN_CLOCK) gvi__clock_layout(in, a);
#endif
#ifndef GVI_NO_KICKS
    if (in->parts & GVI__IN_KICKS) gvi__kicks_layout(in, a);
#endif
#ifndef GVI_NO_CONSTRAINTS
    if (in->con.bits) gvi__layout_constraints(in, a);
    if (in->rolling.bits) gvi__rolling_layout(in, a);
#endif
#ifndef GVI_NO_DIAL
    const size_t R = (size_t)GVI__ROW(in->desc.rule.points), n = (size_t)in->desc.n;
    in->dial.high = gvi__take(a, in->desc.resolution > 0 ? 6 : 0, R);
    in->dial.now = gvi__take(a, in->desc.resolution > 0, n);
    in->dial.before = gvi__take(a, in->desc.resolution > 0, n);
#endif
#ifndef GVI_NO_NEWTON
    if (in->newton.covers) gvi__newton_layout(in, gvi__con_rows(in), a);        // J comes last
#endif
}

GVI__COLD int gvi__place_nodes(gvi_stepper *st)
{
    const gvi_rule *rule = &st->in.desc.rule;
    GVI__KICKS(gvi__kicks_nodes(st); return 1)
    if (rule->kind != GVI_OWN) return 0;
    gvi__copy((size_t)st->r, rule->nodes, st->in.table.c);
    gvi__copy((size_t)st->r, rule->weights, st->in.table.b);
    return 1;
}

GVI__COLD gvi_status gvi__place_tables(gvi_stepper *st)
{
    gvi_status status = GVI_OK;
    GVI__MOMENTA(gvi__momenta_tables(st))
    GVI__CONSTRAINTS(status = gvi__set_constraints(st))
#ifndef GVI_NO_DIAL
    if (st->in.dial.high) gvi__dial_tables(st);
#endif
    return status;
}

/* ---- start ---- */

GVI__COLD gvi_status gvi__place_start(gvi_stepper *st, gvi_real t, gvi_real *v)
{
    GVI__CLOCK(return gvi__clock_start(st, t, v))
    GVI__CONSTRAINTS(return gvi__constraint_start(st, t, v))
    return GVI_OK;
}

GVI__COLD void gvi__place_started(gvi_stepper *st)
{
#ifndef GVI_NO_KICKS
    st->in.kicks.has_force = 0;
#endif
#ifndef GVI_NO_NEWTON
    st->in.newton.left = 0;
    gvi__newton_forget(st);
#endif
#ifndef GVI_NO_DIAL
    st->in.dial.reach = st->in.dial.barrier = -GVI__MAX;
    st->in.dial.span = 0;
    st->in.dial.wait = st->in.dial.again = 0;
#endif
}

GVI__COLD gvi_status gvi__place_switch(gvi_stepper *st, unsigned was)
{
    gvi_status status = GVI_OK;
    GVI__CLOCK(if (st->in.started && st->in.off != was) status = gvi__clock_switch(st, was))
    GVI__CONSTRAINTS(if (status == GVI_OK) status = gvi__constraint_switch(st, was))
    if (status != GVI_OK) return status;
#ifndef GVI_NO_KICKS
    st->in.kicks.has_force = 0;
#endif
#ifndef GVI_NO_NEWTON
    gvi__newton_forget(st);
#endif
    return GVI_OK;
}

/* ---- mass ---- */

static gvi_status gvi__place_velocity(gvi_stepper *st, gvi_real t, const gvi_real *q,
                                      const gvi_real *p, gvi_real *v)
{
    gvi_points at = gvi__one_point(st, &t, q);
    (void)at;
    GVI__MASS(if (st->in.desc.mass.velocity) return gvi__momenta_velocity(st, &at, p, v))
    GVI__LAGRANGIAN(return gvi__legendre_newton(st, &at, p, v))
    GVI__MASS(return gvi__momenta_velocity(st, &at, p, v))
    gvi__copy((size_t)st->n, p, v);
    gvi__over_mass(st, v, 1, 1);
    return GVI_OK;
}

// M_ii; where effects alone make the mass, d2L/dv_i2 if Newton's method knows it, else p_i/v_i
static gvi_real gvi__place_inertia(const gvi_stepper *st, int i)
{
    const struct gvi__private *in = &st->in;
    const gvi_mass_kind kind = in->desc.mass.kind;
    gvi_real m = 1;

    if (kind <= GVI_MASS_DENSE) m = in->mass.matrix[kind == GVI_MASS_DENSE ? i*(st->n + 1) : i];
    GVI__MASS(if (kind == GVI_MASS_POSITION) m = gvi__momenta_inertia(st, i))
    if (kind == GVI_MASS_NONE) {
        const gvi_real *P = NULL;
        GVI__MOMENTA(P = in->momenta.P)
#ifndef GVI_NO_NEWTON
        const gvi_real unit = in->watch.scale[i];
        if (st->formulation == GVI_NEWTON && unit > 0) return 1/(unit*unit);
        if (st->formulation == GVI_NEWTON || !P) P = in->newton.P;
#endif
        if (P) m = P[i*in->R]/in->work.V[i*in->R];
    }

    return gvi__nonzero(m) && gvi__finite(m) ? GVI_ABS(m) : 1;
}

/* ---- solve ---- */

static int gvi__place_solve(gvi_stepper *st, const gvi__origin *from, gvi_real h, int query,
                            gvi_status *status)
{
    GVI__KICKS(*status = gvi__kicks_solve(st, from, h, query); return 1)
    GVI__NEWTON(return gvi__newton_instead(st, from, h, query, status))
    return 0;
}

static gvi_status gvi__place_fallback(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                      int query, gvi_status status)
{
#ifndef GVI_NO_DIAL
    if (st->in.dial.put_off && status == GVI_E_CONVERGENCE) return status;
#endif
#ifndef GVI_NO_NEWTON
    return gvi__newton_turn(st, from, h, query, status);
#else
    return status;
#endif
}

/* ---- the fixed point ---- */

static void gvi__place_stages(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                              struct gvi__stage *stage)
{
    GVI__MOMENTA(gvi__momenta_stages(st, from, stage))
    GVI__CONSTRAINTS(gvi__constraint_stages(st, from, h, stage))
}

static gvi_status gvi__place_predict(gvi_stepper *st, const gvi__origin *from, gvi_real h,
                                     int extrapolate)
{
    gvi_real rate = 1;
    GVI__CLOCK_ON(
        const gvi_status status = gvi__clock_predict(st, from, h, &rate);
        if (status != GVI_OK) return status)
    GVI__CONSTRAINTS_ON(gvi__predict_constraints(st, extrapolate))
    GVI__LAGRANGIAN(gvi__lagrangian_predict(st, extrapolate))
    GVI__MOMENTA(gvi__momenta_predict(st, extrapolate, rate))
    return GVI_OK;
}

static gvi_status gvi__place_evaluate(gvi_stepper *st, const gvi__origin *from, gvi_points *at)
{
    gvi_status status = GVI_OK;
    GVI__MOMENTA(status = gvi__momenta_evaluate(st, from, at))
    if (status != GVI_OK) return status;
    GVI__LAGRANGIAN(
        at->dldv = st->in.lagrangian.A;
        gvi__clear(st->n, st->in.R, st->in.zeros[0], at->dldv))
    GVI__CLOCK_ON(return gvi__clock_evaluate(st, from, at))
    status = gvi__effects(st, at, 0, NULL);
    GVI__CONSTRAINTS_ON(if (status == GVI_OK) status = gvi__constraint_values(st, from))
    GVI__MASS(if (status == GVI_OK && st->in.momenta.mass) status = gvi__mass_gradient(st, at))
    return status;
}

static int gvi__place_rolls(const gvi_stepper *st)
{
    GVI__CONSTRAINTS_ON(return gvi__rolls(st))
    (void)st;
    return 0;
}

// is there more than D shows?
static int gvi__place_moves(const gvi_stepper *st)
{
    GVI__MOMENTA(if (st->in.momenta.moves) return 1)
    GVI__CONSTRAINTS_ON(if (gvi__rolls(st)) return gvi__a_row_falls(st))
    return 0;
}

/* ---- the end of a step ---- */

static int gvi__place_increments(gvi_stepper *st, const gvi__origin *from)
{
    GVI__CLOCK_ON(gvi__clock_increments(st))
    GVI__CONSTRAINTS_ON(gvi__constraint_momenta(st))
    GVI__MOMENTA(
        gvi__sum_rows(st, st->in.work.V, from->q_low, st->in.step.q, st->in.step.q_low);
        return 1)
    return 0;
}

static gvi_status gvi__place_accept(gvi_stepper *st)
{
    gvi_status status = GVI_OK;
#ifndef GVI_NO_DIAL
    if (st->in.desc.resolution > 0) status = gvi__dial_accept(st);
#endif
    return status;
}

static void gvi__place_commit(gvi_stepper *st, gvi_real h)
{
    GVI__CLOCK(gvi__clock_commit(st))
    GVI__CONSTRAINTS(gvi__commit_constraints(st, h))
    GVI__KICKS(gvi__kicks_commit(st))
    GVI__NEWTON(gvi__newton_commit(st))
}

GVI__COLD void gvi__place_failed(gvi_stepper *st)
{
#ifndef GVI_NO_NEWTON
    gvi__newton_forget(st);
#endif
}

#ifdef __GNUC__
#pragma GCC diagnostic pop
#endif
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
