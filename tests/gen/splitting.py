#!/usr/bin/env python3
"""The splitting of order 8 for q'' = a(q) in tests/cost/coefficients.h: proves its order.

    python3 tests/gen/splitting.py      (mpmath; some seconds)

A row of kicks b_j at nodes c_j, with drifts between them, is the Nystroem method

    Q_i = q0 + c_i h v0 + h^2 sum_(j<i) b_j (c_i - c_j) a(Q_j)
    v1 = v0 + h sum b_i a(Q_i)        q1 = q0 + h v0 + h^2 sum b_i (1 - c_i) a(Q_i)

and a tree stands for a derivative of a, with velocities and further such trees put into it.  With Phi_i = c_i^m for
its m velocities, times sum_(j<i) b_j (c_i - c_j) Phi_j for each tree, and the same of the exact solution, phi t^p,

    sum b_i Phi_i = phi/(p + 1)       sum b_i (1 - c_i) Phi_i = phi/((p + 1)(p + 2))

are the conditions of order p + 1 for v and p + 2 for q.  Printed are the largest residuals of all trees, 79 for v
and 43 for q, of orders 1 to 8, and of order 9.  The family is that of Blanes, Casas, Escorihuela-Tomas:
Runge-Kutta-Nystroem symplectic splitting methods of order 8, Appl. Numer. Math. 182, 2022."""
import os
import re
import sys
from functools import lru_cache
from mpmath import mp, mpf, nstr

mp.dps = 80


@lru_cache(None)
def trees(order):
    """(velocities, trees): all with so many: 1 for the root, 1 for each velocity, order + 1 for each tree"""
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


def exact(t):
    e = mpf(1)
    for u in t[1]:
        e *= exact(u)/(order(u)*(order(u) + 1))
    return e


def row(count, half):
    """all of a symmetric row of sum 1 from its first half"""
    given = (count - 1)//2
    assert len(half) == given
    rest = (1 - 2*sum(half))/(1 if count % 2 else 2)
    return [half[min(i, count - 1 - i)] if min(i, count - 1 - i) < given else rest for i in range(count)]


class Table:
    """so many stages, a kick first"""
    def __init__(self, stages, kicks, drifts):
        self.b, self.c, self.known = row(stages + 1, kicks), [mpf(0)], {}
        for a in row(stages, drifts):
            self.c.append(self.c[-1] + a)

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

    def residual(self, k):
        """the largest of order k"""
        of_v = [sum(b*f for b, f in zip(self.b, self.phi(t))) - exact(t)/k for t in trees(k)]
        of_q = [sum(b*(1 - c)*f for b, c, f in zip(self.b, self.c, self.phi(t))) - exact(t)/((k - 1)*k)
                for t in (trees(k - 1) if k > 1 else [])]
        return max(abs(r) for r in of_v + of_q)


def main():
    where = os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'cost', 'coefficients.h')
    with open(where, encoding='utf-8') as f:
        text = f.read()

    def read(name):
        body = re.search(r'\b' + name + r'\[\] = \{(.*?)\}', text, re.S).group(1)
        return [mpf(word.strip().rstrip('L')) for word in body.split(',')]

    table = Table(22, read('splitting8_b'), read('splitting8_a'))
    low = max(table.residual(k) for k in range(1, 9))
    print('largest residual to order 8: ' + nstr(low, 3) + ', of order 9: ' + nstr(table.residual(9), 3))
    return low > mpf(10)**-33


if __name__ == '__main__':
    sys.exit(main())
