#!/usr/bin/env python3
"""The numbers of Gauss with r = s = 1..4 that gvi.h has as constants (GVI_NO_RULES).

    python3 tests/gen/few.py      (mpmath; prints the array as it stands in gvi.h)

For r = 1..4, one after the other: weights; Phi_k and phi_k at node i, row by row of k; and
    S_ij = sum_k (2k+1) Phi_k(c_i) Phi_k(c_j)   i <= j < r      T_ij = sum_k (2k+1) phi_k(c_i) Phi_k(c_j)   i < j < r
Phi_0 = c and S are to be rounded to multiples of eps/2, T to multiples of eps, in any type: what lies between 1/2
and 1 is, by being stored; for less, x - 1 is written; for T, which is about 1, T + 1/2."""
from mpmath import legendre, mp, mpf, polyroots, taylor

mp.dps = 60


def rule(r):
    """nodes on [0,1] and weights 1/sum (2k+1) P_k^2"""
    x = sorted(polyroots(list(reversed(taylor(lambda z: legendre(r, z), 0, r))), maxsteps=200, extraprec=200))
    c = [(1 + z)/2 for z in x]
    b = [1/sum((2*k + 1)*legendre(k, 1 - 2*z)**2 for k in range(r)) for z in c]
    assert abs(sum(b) - 1) < mpf(10)**-50
    return c, b


def modes(r, c):
    P = [[mpf(1)]*r] + [[legendre(k, 1 - 2*z) for z in c] for k in range(r + 1)]      # P_(-1) = 1 first
    phi = P[1:r + 1]
    Phi = [[(P[k][i] - P[k + 2][i])/(4*k + 2) for i in range(r)] for k in range(r)]
    return phi, Phi


def half(x):
    return x if x >= mpf(1)/2 else x - 1


def show(numbers):
    """as many digits as a double, rounded once, needs; floats go by way of it"""
    words = [repr(float(z) if abs(z) > mpf(10)**-40 else 0.0) for z in numbers]
    rows = [f"    GVI__4({', '.join(words[k:k + 4])})" for k in range(0, len(words), 4)]
    rows = [row if len(row) < 100 else row.replace(', ', ',') for row in rows]
    print('static const gvi_real gvi__few_numbers[] = {\n' + ',\n'.join(rows) + '\n};')


def main():
    weights, Phis, phis, S, T = [], [], [], [], []
    for r in range(1, 5):
        c, b = rule(r)
        phi, Phi = modes(r, c)
        weights += b
        for k in range(r):
            Phis += [half(x) for x in Phi[k]] if k == 0 else Phi[k]
            phis += phi[k]
        for j in range(r):
            S += [half(sum((2*k + 1)*Phi[k][i]*Phi[k][j] for k in range(r))) for i in range(j + 1)]
            T += [mpf(1)/2 + sum((2*k + 1)*phi[k][i]*Phi[k][j] for k in range(r)) for i in range(j)]
    show(weights + Phis + phis + S + T)


main()
