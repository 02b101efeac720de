#!/usr/bin/env python3
"""Splittings of order 8 for q'' = a(q): proves the tables of tests/cost/coefficients.h, or finds them again.

    python3 tests/gen/splitting.py [--derive]      (mpmath; some seconds)

A row of kicks b_j at nodes c_j, with drifts between them, is the Nystroem method

    Q_i = q0 + c_i h v0 + h^2 sum_(j<i) b_j (c_i - c_j) a(Q_j)
    v1 = v0 + h sum b_i a(Q_i)        q1 = q0 + h v0 + h^2 sum b_i (1 - c_i) a(Q_i)

and a tree stands for a derivative of a, with velocities and further such trees put into it.  With Phi_i = c_i^m for
its m velocities, times sum_(j<i) b_j (c_i - c_j) Phi_j for each tree, and the same of the exact solution, phi t^p,

    sum b_i Phi_i = phi/(p + 1)       sum b_i (1 - c_i) Phi_i = phi/((p + 1)(p + 2))

are the conditions of order p + 1 for v and p + 2 for q.

  residuals   of all trees, 79 for v and 43 for q, for orders 1 to 8
  order 9     the largest residual, and the Euclidean norm of what multiplies h^9 and the elementary differentials:
              residuals divided by the trees' symmetries.  Efficiency is stages times norm^(1/8): to compare with
              Kahan and Li's composition of order 8, which is printed too.
  order seen  on Kepler's ellipse, e = 0.3, over a quarter of a revolution: 24 and 48 steps

A symmetric row of even order fulfils the conditions of even order by itself, and a symplectic one those for q, and
only one for each tree without root: 2 + 4 + 10 are left for orders 3, 5, 7.  --derive has as many unknowns, by Newton's
method from 4 decimals; the other coefficients are free, chosen for small errors, and have the few digits that they
have here.  The family is that of Blanes, Casas, Escorihuela-Tomas: Runge-Kutta-Nystroem symplectic splitting methods
of order 8, Appl. Numer. Math. 182, 2022."""
import os
import re
import sys
from functools import lru_cache
from itertools import groupby
from math import factorial
from mpmath import cos, findroot, log, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 80

# name, stages, drift first; where to start: kicks and drifts of the first half, those in quotes are kept
TABLES = [
    ('splitting8', 22, 0,
     [0.0226, 0.1075, 0.0334, '-0.02079', '-0.03742', 0.0542, -0.0227, 0.1609, 0.4474, '0.01473', '-0.3303'],
     [0.0689, 0.2306, -0.127, 0.1104, -0.1698, '-0.04837', 0.1583, 0.1287, -0.024, 0.0192]),
]


# ---------------------------------------------------------------- trees: (velocities, trees)

@lru_cache(None)
def trees(order):
    """all with so many: 1 for the root, 1 for each velocity, order + 1 for each tree"""
    found = set()

    def fill(left, most, branches):
        found.add((left, tuple(sorted(branches))))
        for k in range(1, left):
            for t in trees(k):
                if (k, t) <= most:
                    fill(left - k - 1, (k, t), branches + [t])
    fill(order - 1, (order, ()), [])
    return sorted(found)


def order(t):
    return 1 + t[0] + sum(order(u) + 1 for u in t[1])


def symmetry(t):
    s = factorial(t[0])
    for u, same in groupby(t[1]):
        k = len(list(same))
        s *= factorial(k)*symmetry(u)**k
    return s


def exact(t):
    e = mpf(1)
    for u in t[1]:
        e *= exact(u)/(order(u)*(order(u) + 1))
    return e


def unrooted(t):
    """the least of all trees that differ from t only in which node is the root"""
    found = []

    def go(t, rest):
        found.append((t[0], tuple(sorted(t[1] + rest))))
        for i, u in enumerate(t[1]):
            go(u, ((t[0], tuple(sorted(t[1][:i] + t[1][i+1:] + rest))),))
    go(t, ())
    return min(found)


# ---------------------------------------------------------------- tables

def row(count, half):
    """all of a symmetric row of sum 1 from its first half"""
    given = (count - 1)//2
    assert len(half) == given
    rest = (1 - 2*sum(half))/(1 if count % 2 else 2)
    return [half[min(i, count - 1 - i)] if min(i, count - 1 - i) < given else rest for i in range(count)]


class Table:
    def __init__(self, stages, drift_first, kicks, drifts):
        self.stages, self.drift_first = stages, drift_first
        self.b = row(stages + 1 - drift_first, kicks)
        self.a = row(stages + drift_first, drifts)
        self.c, at = [], mpf(0)
        for i in range(len(self.b)):
            if i or drift_first:
                at += self.a[i - 1 + drift_first]
            self.c.append(at)
        self.known = {}

    def phi(self, t):
        if t not in self.known:
            value = [c**t[0] for c in self.c]
            for u in t[1]:
                s0 = s1 = mpf(0)
                for i, (b, c, f) in enumerate(zip(self.b, self.c, self.phi(u))):
                    value[i] *= c*s0 - s1
                    s0 += b*f
                    s1 += b*c*f
            self.known[t] = value
        return self.known[t]

    def residual_v(self, t):
        return sum(b*f for b, f in zip(self.b, self.phi(t))) - exact(t)/order(t)

    def residual_q(self, t):
        return sum(b*(1 - c)*f for b, c, f in zip(self.b, self.c, self.phi(t))) - exact(t)/(order(t)*(order(t) + 1))

    def residuals(self, k):
        return [self.residual_v(t) for t in trees(k)] + ([self.residual_q(t) for t in trees(k - 1)] if k > 1 else [])

    def terms(self, k):
        return sqrt(sum((self.residual_v(t)/symmetry(t))**2 for t in trees(k))
                    + sum((self.residual_q(t)/symmetry(t))**2 for t in trees(k - 1)))

    def step(self, h, q, v):
        kicks, drifts = list(self.b), list(self.a)
        for i in range(2*self.stages + 1):
            if (i + self.drift_first) % 2:
                q = [x + h*drifts[0]*y for x, y in zip(q, v)]
                del drifts[0]
            else:
                r = (q[0]**2 + q[1]**2)**mpf(1.5)
                v = [y - h*kicks[0]*x/r for x, y in zip(q, v)]
                del kicks[0]
        return q, v


def derive(stages, drift_first, kicks, drifts):
    """Newton's method with the free ones kept"""
    start = kicks + drifts
    x = [mpf(str(z)) for z in start]
    moving = [i for i, z in enumerate(start) if not isinstance(z, str)]
    conditions = [t for k in (3, 5, 7) for t in trees(k) if t == unrooted(t)]
    assert len(moving) == len(conditions) == 16

    def residuals(x):
        table = Table(stages, drift_first, x[:len(kicks)], x[len(kicks):])
        return matrix([table.residual_v(t)/exact(t) for t in conditions])
    for turn in range(40):
        r = residuals(x)
        J = matrix(16, 16)
        for k, i in enumerate(moving):
            e = mpf(10)**-30
            J[:, k] = (residuals(x[:i] + [x[i] + e] + x[i+1:]) - residuals(x[:i] + [x[i] - e] + x[i+1:]))/(2*e)
        d = lu_solve(J, -r)
        for k, i in enumerate(moving):
            x[i] += d[k]
        if max(abs(z) for z in d) < mpf(10)**-45:
            return x[:len(kicks)], x[len(kicks):]
    raise SystemExit('Newton did not converge')


# ---------------------------------------------------------------- prints

def show(name, numbers):
    print(f'static const long double {name}[] = {{')
    words = [nstr(z, 36, strip_zeros=False, min_fixed=-3) + 'L' for z in numbers]
    for i in range(0, len(words), 2):
        print('    ' + ', '.join(words[i:i+2]) + (',' if i + 2 < len(words) else ' };'))


def order_seen(table):
    e = mpf(3)/10
    q, v, end = [1 - e, mpf(0)], [mpf(0), sqrt((1 + e)/(1 - e))], pi/2
    E = findroot(lambda E: E - e*sin(E) - end, 1.8)
    errors = []
    for steps in (24, 48):
        x, y = q, v
        for k in range(steps):
            x, y = table.step(end/steps, x, y)
        errors.append(sqrt((x[0] - cos(E) + e)**2 + (x[1] - sqrt(1 - e*e)*sin(E))**2))
    return errors, log(errors[0]/errors[1], 2)


def report(name, table):
    low = [max(abs(r) for r in table.residuals(k)) for k in range(1, 9)]
    high = max(abs(r) for r in table.residuals(9))
    norm = table.terms(9)
    errors, seen = order_seen(table)
    print(f'{name}: {table.stages} stages, {"drift" if table.drift_first else "kick"} first')
    print('  worst residual to order 8   ' + nstr(max(low), 3))
    print('  of order 9                  ' + nstr(high, 3) + '   norm ' + nstr(norm, 4)
          + '   efficiency ' + nstr(table.stages*norm**(mpf(1)/8), 4))
    print('  sum |kicks|, |drifts|       ' + nstr(sum(map(abs, table.b)), 4) + ', ' + nstr(sum(map(abs, table.a)), 4)
          + '   largest ' + nstr(max(map(abs, table.a + table.b)), 4))
    print('  order seen                  ' + nstr(seen, 4)
          + '   errors ' + nstr(errors[0], 3) + ', ' + nstr(errors[1], 3))
    return max(low)


def main():
    where = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'cost', 'coefficients.h')
    with open(where, encoding='utf-8') as f:
        text = f.read()

    def read(name):
        body = re.search(r'\b' + name + r'\[\] = \{(.*?)\}', text, re.S).group(1)
        return [mpf(word.strip().rstrip('L')) for word in body.split(',')]

    bad = False
    for name, stages, drift_first, kicks, drifts in TABLES:
        b, a = read(name + '_b'), read(name + '_a')
        if '--derive' in sys.argv[1:]:
            B, A = derive(stages, drift_first, kicks, drifts)
            show(name + '_b', B)
            show(name + '_a', A)
            apart = max(abs(x - y) for x, y in zip(A + B, a + b))
            print('  from the digits of coefficients.h they differ by ' + nstr(apart, 3))
            bad |= apart > mpf(10)**-35
            b, a = B, A
        bad |= report(name, Table(stages, drift_first, b, a)) > mpf(10)**-33
    gamma = row(17, read('kahan_li8'))
    composed = Table(17, 0, [gamma[0]/2] + [(gamma[i-1] + gamma[i])/2 for i in range(1, 8)], gamma[:8])
    report('kahan_li8', composed)
    return int(bad)


if __name__ == '__main__':
    sys.exit(main())
