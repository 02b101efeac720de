/* stability.h - one step on the oscillator as a 2 x 2 matrix, from the library and
   from theory.  Half its trace says what many steps do: up to 1 in size they turn,
   beyond it they grow.                                                        */
#ifndef STABILITY_H
#define STABILITY_H

#include "bench.h"
#include "rules.h"

/* From two starts of the library's step, omega = 1 */
static MAYBE real half_trace(const method *m, real h)
{
    real M[2] = { 0, 0 };
    for (int k = 0; k < 2; ++k) {
        const real y[2] = { 1 - k, k };
        gvi_stepper *st = bench(&oscillator, m, 0, y);
        if (st->status != GVI_OK || gvi_step(st, h) != GVI_OK) return (real)NAN;
        M[k] = k ? st->p[0] : st->q[0];
    }
    return (M[0] + M[1])/2;
}

/* Gauss s is collocation: its stability function is the diagonal Pade approximant
   R(ih) = N(ih)/N(-ih), N = sum a_j z^j, a_j = a_(j-1) (s-j+1)/((2s-j+1) j), a turn
   by the angle 2 arg N(ih); half the trace is its cosine.                      */
static MAYBE real gauss_half_trace(int s, real h)
{
    real re = 0, im = 0, a = 1, power = 1;
    for (int j = 0; j <= s; ++j) {
        if (j) { a *= (real)(s - j + 1)/((2*s - j + 1)*j); power *= h; }
        if (j%2) im += (j%4 == 1 ? 1 : -1)*a*power;
        else re += (j%4 == 0 ? 1 : -1)*a*power;
    }
    return (re*re - im*im)/(re*re + im*im);
}

/* Lobatto IIIA-IIIB with r stages, from its definition: Q = q + h A P and
   P = p - h Ahat Q, so (1 + h^2 A Ahat) Q = q + h A 1 p; then the step.        */
static MAYBE real lobatto_half_trace(int r, real h)
{
    own_rule rule = lobatto(r);
    real A[MAX_R*MAX_R], B[MAX_R*MAX_R], trace = 0;
    collocation(&rule, A);
    partner(&rule, A, B);
    for (int start = 0; start < 2; ++start) {
        real S[MAX_R*MAX_R], Q[MAX_R], q = 1 - start, p = start;
        for (int i = 0; i < r; ++i) {
            Q[i] = q + h*rule.c[i]*p;
            for (int j = 0; j < r; ++j) {
                S[i*r + j] = i == j;
                for (int k = 0; k < r; ++k) S[i*r + j] += h*h*A[i*r + k]*B[k*r + j];
            }
        }
        solve(r, S, Q);
        if (start) {
            for (int i = 0; i < r; ++i) p -= h*rule.b[i]*Q[i];
            trace += p;
        } else {
            for (int i = 0; i < r; ++i) {
                real P = 0;
                for (int j = 0; j < r; ++j) P -= h*B[i*r + j]*Q[j];
                q += h*rule.b[i]*P;
            }
            trace += q;
        }
    }
    return trace/2;
}

#endif
