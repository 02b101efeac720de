#!/usr/bin/env python3
"""Gauss-Legendre and Gauss-Lobatto rules on [0,1] to 40 digits, for the tests.

    python3 tests/gen/nodes.py > tests/data/nodes.h      (mpmath; about 1 minute)

Shares nothing with gvi.h:
  nodes    Roots of P_n (Gauss) or of P_n - P_(n-2), which is a multiple of
           (1 - x^2) P'_(n-1) (Lobatto).  Newton in 60 digits from a guess
           refined in floating point.  Each root is proved by a change of sign
           within 1e-45 of it; n such intervals that are disjoint hold all roots.
  weights  Reciprocal of the Christoffel function, a sum of positive terms, not
           from the derivative at the node:
             1/b = sum_{k<n} (2k+1) P_k(x)^2                               Gauss
             1/b = sum_{k<n-1} (2k+1) P_k(x)^2 + (n-1) P_(n-1)(x)^2        Lobatto
           (the Lobatto rule takes P_(n-1) to have the norm 1/(n-1)).
  check    The rule integrates P_0 .. P_m to 1e-40, m = 2n-1 or 2n-3, the even
           ones explicitly and the odd ones by symmetry, and not P_(m+1).

Only nodes c <= 1/2 are written: c[n-1-i] = 1 - c[i], b[n-1-i] = b[i]."""
import math
import sys
from mpmath import mp, mpf, nstr

mp.dps = 60
SIZES = list(range(1, 18)) + [24, 25, 32, 64, 100, 128, 1024]


class Recurrence:
    """k P_k = (2k-1) x P_(k-1) - (k-1) P_(k-2), coefficients made once."""
    def __init__(self, degree, number):
        self.a = [number(0), number(1)] + [number(2*k - 1)/k for k in range(2, degree + 1)]
        self.b = [number(0), number(0)] + [number(k - 1)/k for k in range(2, degree + 1)]

    def values(self, x, degree):
        p = [x*0 + 1, x]
        for k in range(2, degree + 1):
            p.append(self.a[k]*x*p[k - 1] - self.b[k]*p[k - 2])
        return p[:degree + 1]


TOP = 2*max(SIZES)
EXACT, ROUGH = Recurrence(TOP, mpf), Recurrence(TOP, float)


def function_and_slope(rule, n, x, recurrence):
    """A function with roots at the nodes, and its derivative."""
    p = recurrence.values(x, n)
    if rule == "gauss":
        return p[n], n*(x*p[n] - p[n - 1])/(x*x - 1)
    return p[n] - p[n - 2], (2*n - 1)*p[n - 1]


def guess(rule, n, i):
    if rule == "gauss":
        x = -math.cos(math.pi*(i + 0.75)/(n + 0.5))
    else:
        x = -math.cos(math.pi*(i + 0.25)/(n - 1) - 3/(8*math.pi*(n - 1)*(i + 0.25)))
    for _ in range(6):
        f, slope = function_and_slope(rule, n, x, ROUGH)
        x -= f/slope
    return x


def node(rule, n, i):
    """Node i of the lower half, on [-1,1]."""
    if rule == "lobatto" and i == 0:
        return mpf(-1)
    if 2*i + 1 == n:
        return mpf(0)
    x = mpf(guess(rule, n, i))
    for _ in range(2):                                   # 15 -> 30 -> 60 digits
        f, slope = function_and_slope(rule, n, x, EXACT)
        x -= f/slope
    gap = mpf(10)**-45
    below, _ = function_and_slope(rule, n, x - gap, EXACT)
    above, _ = function_and_slope(rule, n, x + gap, EXACT)
    assert below*above < 0, (rule, n, i)
    return x


def weight(rule, n, x):
    p = EXACT.values(x, n - 1)
    last = 2*n - 1 if rule == "gauss" else n - 1
    return 1/(sum((2*k + 1)*p[k]**2 for k in range(n - 1)) + last*p[n - 1]**2)


def check(rule, n, x, b):
    assert all(x[i + 1] - x[i] > mpf(10)**-40 for i in range(len(x) - 1))
    degree = 2*n - 1 if rule == "gauss" else 2*n - 3
    sums = [mpf(0)]*(degree + 2)
    for i in range(len(x)):
        p = EXACT.values(x[i], degree + 1)
        both = 1 if 2*i + 1 == n else 2
        for k in range(0, degree + 2, 2):
            sums[k] += both*b[i]*p[k]
    assert abs(sums[0] - 1) < mpf(10)**-40, (rule, n)
    assert all(abs(s) < mpf(10)**-40 for s in sums[1:degree + 1]), (rule, n)
    assert abs(sums[degree + 1]) > mpf(10)**-3, (rule, n)


def make(rule, n):
    x = [node(rule, n, i) for i in range((n + 1)//2)]
    b = [weight(rule, n, y) for y in x]
    check(rule, n, x, b)
    return [((1 + y)/2, v) for y, v in zip(x, b)]


def literal(value):
    return nstr(value, 28, min_fixed=0, max_fixed=0) + "L" if value else "0.0L"


def main():
    print("/* Made by tests/gen/nodes.py, not to be edited.  Gauss and Lobatto rules on\n"
          "   [0,1], nodes c <= 1/2 and their weights: rounded to 28 digits from 60,\n"
          "   checked to 40 by signs at the nodes and by moments.                      */\n"
          "#ifndef TEST_NODES_H\n#define TEST_NODES_H\n\n"
          "struct node { long double c, b; };\n"
          "struct node_rule { int n, first; };     /* index of its first node */\n")
    for rule in ("gauss", "lobatto"):
        index, rows = [], []
        for n in SIZES:
            if rule == "lobatto" and n < 2:
                continue
            index.append("{%d,%d}" % (n, len(rows)))
            rows += ["{%s,%s}" % (literal(c), literal(b)) for c, b in make(rule, n)]
            print(rule, n, file=sys.stderr)
        print("static const struct node_rule %s_rules[] = {" % rule)
        print(",\n".join(",".join(index[i:i + 50]) for i in range(0, len(index), 50)) + "\n};")
        print("static const struct node %s_nodes[] = {" % rule)
        print(",\n".join(",".join(rows[i:i + 16]) for i in range(0, len(rows), 16)) + "\n};\n")
    print("#endif")


main()
