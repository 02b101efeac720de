#!/usr/bin/env python3
"""One step of the Galerkin variational integrator to 40 digits, the oracle of
tests/test_oracle.c.

    python3 tests/gen/oracle.py > tests/data/oracle.h      (mpmath, a minute)

Nothing here is taken from gvi.h: the curve is given by its values q_j at s + 1
equidistant control points, not by modes of its velocity; the equations are the
nodal ones,

    Q_i = sum_j A_ij q_j      V_i = (1/h) sum_j B_ij q_j      t_i = t0 + c_i h
    p0 [k = 0] + sum_i b_i (h A_ik F_i + B_ik P_i) = 0        k = 0..s-1
    p1 = p0 + h sum_i b_i F_i

and F = dL/dq + f, P = dL/dv come out of L by automatic differentiation.  The
oracle is checked against other ways to say the same; that goes to stderr.
"""
import sys
from mpmath import mp, mpf

mp.dps = 50
DIGITS = 36                     # also enough for a long double of 113 bits
TAUS = (mpf(1)/4, mpf(3)/4)
DEGREES = (1, 2, 3, 4, 5, 8)
MORE_POINTS = (0, 1, 3)         # r - s


# ------------------------------------------------- automatic differentiation

class Jet:
    """A value, its gradient and its Hessian (lower triangle) in N variables."""

    def __init__(self, x, g, h):
        self.x, self.g, self.h = x, g, h

    @staticmethod
    def variables(values):
        N = len(values)
        return [Jet(x, [mpf(i == k) for i in range(N)], [[mpf(0)]*(i + 1) for i in range(N)])
                for k, x in enumerate(values)]

    def function(self, f, f1, f2):
        """f(self), from f and its first two derivatives at self.x"""
        g = [f1*a for a in self.g]
        f2g = [f2*a for a in self.g]
        return Jet(f, g, [[f1*a + (f2g[i]*self.g[j] if f2g[i] and self.g[j] else 0)
                           for j, a in enumerate(row)] for i, row in enumerate(self.h)])

    def __add__(self, o):
        if not isinstance(o, Jet):
            return Jet(self.x + o, self.g, self.h)
        return Jet(self.x + o.x, [a + b for a, b in zip(self.g, o.g)],
                   [[a + b for a, b in zip(r, t)] for r, t in zip(self.h, o.h)])

    def __mul__(self, o):
        if not isinstance(o, Jet):
            return self.function(self.x*o, mpf(o), mpf(0))
        a, b = self, o
        return Jet(a.x*b.x, [a.x*y + b.x*x for x, y in zip(a.g, b.g)],
                   [[a.x*b.h[i][j] + b.x*a.h[i][j] + a.g[i]*b.g[j] + a.g[j]*b.g[i]
                     for j in range(i + 1)] for i in range(len(a.g))])

    __radd__, __rmul__ = __add__, __mul__

    def __neg__(self):
        return self*-1

    def __sub__(self, o):
        return self + o*-1

    def __rsub__(self, o):
        return self*-1 + o


def sin(u):
    s, c = mp.sin(u.x), mp.cos(u.x)
    return u.function(s, c, -s)


def cos(u):
    s, c = mp.sin(u.x), mp.cos(u.x)
    return u.function(c, -s, -c)


def sqrt(u):
    w = mp.sqrt(u.x)
    return u.function(w, 1/(2*w), -1/(4*w*u.x))


# ------------------------------------------------------------------ problems
# Dyadic constants, no two alike in their roles.  lagrangian() returns terms, L
# is their sum: their sizes tell what the action can be compared with.

class Problem:
    v = (0, 0, 0)               # where the search for the first velocity starts

    def force(self, t, q, v):
        return None


class Separable(Problem):       # Henon-Heiles like, two masses
    name, n, t0, h = "separable", 2, 0.5, 0.375
    q0, p0 = (0.375, -0.625), (0.8125, 0.4375)

    def lagrangian(self, t, q, v):
        x, y = q
        return [0.5*(1.25*v[0]*v[0] + 0.75*v[1]*v[1]),
                -(0.5*(x*x + 1.5*y*y) + 1.25*x*x*y - 0.375*y*y*y + 0.625*x*x*x*x + 0.25*x*y)]


class Pendulum(Problem):        # two arms: the mass depends on q
    name, n, t0, h = "pendulum", 2, 0.0, 0.125
    q0, p0 = (0.75, -0.375), (1.625, -0.3125)

    def lagrangian(self, t, q, v):
        return [0.5*(2.75*v[0]*v[0] + 0.875*v[1]*v[1]), 1.125*v[0]*v[1]*cos(q[0] - q[1]),
                5.5*cos(q[0]) + 1.75*cos(q[1])]


class Magnetic(Problem):        # nonuniform field, unit mass; a step backwards
    name, n, t0, h = "magnetic", 2, 1.0, -0.25
    q0, p0 = (0.625, 0.4375), (-0.75, 1.125)

    def lagrangian(self, t, q, v):
        x, y = q
        return [0.5*(v[0]*v[0] + v[1]*v[1]),
                v[0]*(0.25*x*y*y - 0.75*y) + v[1]*(0.5*x + 0.375*x*x),
                -(x*x + 0.75*y*y + 0.5*x*x*y*y)]


class Relativistic(Problem):    # m = 3/4, c = 5/4: not quadratic in v
    name, n, t0, h = "relativistic", 2, 0.0, 0.25
    q0, p0, v = (0.5, -0.25), (0.875, -0.5), (0.8, -0.45)

    def lagrangian(self, t, q, v):
        x, y = q
        c2 = mpf(1.5625)
        return [-0.75*c2*sqrt(1 - (v[0]*v[0] + v[1]*v[1])*(1/c2)),
                -(0.5*(1.25*x*x + 2.25*y*y) + 0.75*x*y*y)]


class Driven(Problem):          # three coordinates, time in the potential
    name, n, t0, h = "driven", 3, 2.75, 0.25
    q0, p0 = (0.25, -0.5, 0.8125), (0.5, 0.6875, -0.375)

    def lagrangian(self, t, q, v):
        x, y, z = q
        return [0.5*(1.5*v[0]*v[0] + v[1]*v[1] + 1.25*v[2]*v[2])
                + 0.25*v[0]*v[1] + 0.5*v[1]*v[2] - 0.125*v[0]*v[2],
                -(0.5*(x*x + 1.75*y*y + 0.75*z*z) + 0.375*x*y*z + 0.5*(x - y)*(x - y)*z*z),
                -(1.375*x + 0.875*y*y)*mp.cos(2.5*t), 0.625*t*(y - 0.5*z)]


class Damped(Problem):          # dense mass, linear and quadratic drag, a torque
    name, n, t0, h = "damped", 2, -1.5, 0.25
    q0, p0, v = (0.875, -0.25), (1.25, -0.5), (1.25, -1.5)

    def lagrangian(self, t, q, v):
        return [0.5*(1.5*v[0]*v[0] + 0.625*v[1]*v[1]), 0.375*v[0]*v[1],
                2.25*cos(q[0]) + 1.125*cos(q[1]) - 0.25*q[0]*q[1]]

    def force(self, t, q, v):
        speed = sqrt(v[0]*v[0] + v[1]*v[1])
        return [-0.375*v[0] - 0.25*speed*v[0] + 0.75*mp.cos(1.5*t),
                -0.625*v[1] - 0.125*speed*v[1] + 0.5*cos(q[0] + 3*t)]


class Mixed(Pendulum):          # the pendulum with everything at once
    name, t0, h = "mixed", 1.25, 0.125
    q0, p0, v = (0.5, -0.4375), (0.75, -0.25), (0.5, -0.5)

    def lagrangian(self, t, q, v):
        w = v[0]*v[0] + 2*v[1]*v[1]
        return super().lagrangian(t, q, v) + [0.25*t*q[1]*v[0] + 0.375*q[0]*q[1]*v[1], 0.0078125*w*w]

    def force(self, t, q, v):
        return Damped.force(self, t, q, v)


PROBLEMS = [Separable(), Pendulum(), Magnetic(), Relativistic(), Driven(), Damped(), Mixed()]


def at_point(P, t, Q, V):
    """The terms of L, F and dL/dv, and the derivatives of both by (q, v)."""
    n = P.n
    x = Jet.variables(list(Q) + list(V))
    terms = P.lagrangian(t, x[:n], x[n:])
    L = sum(terms[1:], terms[0])
    H = lambda i, j: L.h[max(i, j)][min(i, j)]
    F, dF = L.g[:n], [[H(i, j) for j in range(2*n)] for i in range(n)]
    f = P.force(t, x[:n], x[n:])
    if f:
        F = [a + b.x for a, b in zip(F, f)]
        dF = [[a + b for a, b in zip(row, fi.g)] for row, fi in zip(dF, f)]
    return [u.x for u in terms], F, L.g[n:], dF, [[H(n + i, j) for j in range(2*n)] for i in range(n)]


# ----------------------------------------------- quadrature and control points

def legendre(n, x):
    """P_n and P_n'"""
    a, b = mpf(1), mpf(x)
    if n == 0:
        return mpf(1), mpf(0)
    for k in range(1, n):
        a, b = b, ((2*k + 1)*x*b - k*a)/(k + 1)
    return b, n*(a - x*b)/(1 - x*x)


def zero(x, ratio):
    """Newton's method; ratio = f/f'"""
    for _ in range(8):
        x -= ratio(x)
    return x


def rule(kind, r):
    if kind == "gauss":
        def ratio(z):
            P, dP = legendre(r, z)
            return P/dP
        x = [zero(mp.cos(mp.pi*(4*i + 3)/(4*r + 2)), ratio) for i in range(r)]
        w = [2/((1 - z*z)*legendre(r, z)[1]**2) for z in x]
    else:
        m = r - 1

        def ratio(z):           # P'/P'', by Legendre's differential equation
            P, dP = legendre(m, z)
            return dP*(1 - z*z)/(2*z*dP - m*r*P)
        inner = [zero(mp.cos(mp.pi*i/m), ratio) for i in range(1, m)]
        x = [mpf(1)] + inner + [mpf(-1)]
        w = [mpf(2)/(m*r)] + [2/(m*r*legendre(m, z)[0]**2) for z in inner] + [mpf(2)/(m*r)]
    c, b = [(1 + z)/2 for z in x[::-1]], [z/2 for z in w[::-1]]
    for k in range(2*r if kind == "gauss" else 2*r - 2):
        assert abs(sum(w*z**k for z, w in zip(c, b)) - mpf(1)/(k + 1)) < mpf(10)**-45
    return c, b


def basis(d, tau):
    """Lagrange polynomials on d, and their derivatives, as products say."""
    l, dl = [], []
    for j, dj in enumerate(d):
        others = [x for x in d if x != dj]
        l.append(mp.fprod((tau - x)/(dj - x) for x in others))
        dl.append(mp.fsum(mp.fprod((tau - x)/(dj - x) for x in others if x != y)/(dj - y)
                          for y in others))
    return l, dl


# ------------------------------------------------------------------ the step

class Step:
    def __init__(self, P, s, c, b, h=None):
        self.P, self.s, self.c, self.b = P, s, c, b
        self.h, self.t0 = mpf(P.h if h is None else h), mpf(P.t0)
        self.d = [mpf(j)/s for j in range(s + 1)]
        AB = [basis(self.d, x) for x in c]
        self.A, self.B = [a for a, _ in AB], [x for _, x in AB]
        self.q0, self.p0 = [mpf(x) for x in P.q0[:P.n]], [mpf(x) for x in P.p0[:P.n]]
        self.solve()

    def at(self, l, dl):
        n, h = self.P.n, self.h
        return ([mp.fdot(l, [x[i] for x in self.q]) for i in range(n)],
                [mp.fdot(dl, [x[i] for x in self.q])/h for i in range(n)])

    def points(self):
        return [at_point(self.P, self.t0 + x*self.h, *self.at(a, d))
                for x, a, d in zip(self.c, self.A, self.B)]

    def residual(self, pts):
        n, h = self.P.n, self.h
        return [(self.p0[i] if k == 0 else 0)
                + sum(w*(h*a[k]*x[1][i] + d[k]*x[2][i])
                      for w, a, d, x in zip(self.b, self.A, self.B, pts))
                for k in range(self.s) for i in range(n)]

    def jacobian(self, pts):
        """d residual[k, i] / d q_j[l], j = 1..s"""
        n, s, h = self.P.n, self.s, self.h
        J = mp.zeros(s*n)
        for w, A, B, (_, _, _, dF, dP) in zip(self.b, self.A, self.B, pts):
            for j in range(1, s + 1):
                for i in range(n):
                    for l in range(n):
                        f = w*(h*A[j]*dF[i][l] + B[j]*dF[i][n + l])
                        g = w*(A[j]*dP[i][l] + B[j]*dP[i][n + l]/h)
                        for k in range(s):
                            J[k*n + i, (j - 1)*n + l] += A[k]*f + B[k]*g
        return J

    def solve(self):
        n, s, h = self.P.n, self.s, self.h
        self.q = [[x + h*d*v for x, v in zip(self.q0, self.P.v)] for d in self.d]
        for _ in range(30):
            pts = self.points()
            dx = mp.lu_solve(self.jacobian(pts), mp.matrix(self.residual(pts)))
            for k in range(s*n):
                self.q[1 + k//n][k % n] -= dx[k]
            if mp.norm(dx, mp.inf) < mpf(10)**-26:      # quadratic: the next is nothing
                break
        else:
            sys.exit("no convergence: " + self.P.name)
        self.pts = self.points()
        assert max(abs(x) for x in self.residual(self.pts)) < mpf(10)**-43
        self.q1 = self.q[s]
        self.p1 = [self.p0[i] + h*sum(w*x[1][i] for w, x in zip(self.b, self.pts)) for i in range(n)]
        self.action = h*sum(w*sum(x[0]) for w, x in zip(self.b, self.pts))

    def curve(self, tau):
        return self.at(*basis(self.d, tau))[0]


# ------------------------------------------------------ checks of the oracle

def distance(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def midpoint_defect(P):
    """s = 1, Gauss 1: q1 = q0 + h v, p1 = p0 + h F, dL/dv = (p0 + p1)/2 halfway"""
    S = Step(P, 1, *rule("gauss", 1))
    v = [(a - b)/S.h for a, b in zip(S.q1, S.q0)]
    _, F, p, _, _ = at_point(P, S.t0 + S.h/2, [(a + b)/2 for a, b in zip(S.q0, S.q1)], v)
    return max(distance(p, [(a + b)/2 for a, b in zip(S.p0, S.p1)]),
               distance(S.p1, [a + S.h*f for a, f in zip(S.p0, F)]))


def velocity(P, t, Q, p, v):
    """v at which dL/dv = p, by Newton's method from v"""
    n = P.n
    for _ in range(20):
        _, _, dLdv, _, dP = at_point(P, t, Q, v)
        dv = mp.lu_solve(mp.matrix([row[n:] for row in dP]), mp.matrix([a - b for a, b in zip(p, dLdv)]))
        v = [a + b for a, b in zip(v, dv)]
        if mp.norm(dv, mp.inf) < mpf(10)**-26:
            return v
    sys.exit("no velocity")


def collocation(P, s):
    """Gauss collocation of q' = v(q,p), p' = F as a Runge-Kutta method, a_ij as
    integrals of Lagrange polynomials, by plain iteration"""
    c, b = rule("gauss", s)
    h, n = mpf(P.h), P.n
    a = [[mp.quad(lambda x: basis(c, x)[0][j], [0, ci]) for j in range(s)] for ci in c]
    q0, p0 = [mpf(x) for x in P.q0[:n]], [mpf(x) for x in P.p0[:n]]
    V, F = [[mpf(x) for x in P.v[:n]]]*s, [[mpf(0)]*n]*s
    for _ in range(200):
        old = sum(V + F, [])
        Q = [[q0[i] + h*sum(a[k][j]*V[j][i] for j in range(s)) for i in range(n)] for k in range(s)]
        p = [[p0[i] + h*sum(a[k][j]*F[j][i] for j in range(s)) for i in range(n)] for k in range(s)]
        t = [P.t0 + x*h for x in c]
        V = [velocity(P, t[k], Q[k], p[k], V[k]) for k in range(s)]
        F = [at_point(P, t[k], Q[k], V[k])[1] for k in range(s)]
        if distance(old, sum(V + F, [])) < mpf(10)**-44:
            break
    return ([q0[i] + h*sum(w*x[i] for w, x in zip(b, V)) for i in range(n)] +
            [p0[i] + h*sum(w*x[i] for w, x in zip(b, F)) for i in range(n)])


def local_order(P, kind, s, r):
    """log2 of the ratio of errors of one step at h and h/2"""
    e = []
    for h in (mpf(P.h)/8, mpf(P.h)/16):
        exact, S = Step(P, 8, *rule("gauss", 8), h), Step(P, s, *rule(kind, r), h)
        e.append(distance(S.q1 + S.p1, exact.q1 + exact.p1))
    return mp.log(e[0]/e[1], 2)


def check():
    say = lambda *a: print(*a, file=sys.stderr)
    for P in PROBLEMS:
        m = midpoint_defect(P)
        g = [distance((lambda S: S.q1 + S.p1)(Step(P, s, *rule("gauss", s))), collocation(P, s))
             for s in (2, 3)]
        say("%-13s midpoint rule %.0e  collocation s=2 %.0e s=3 %.0e" % (P.name, m, g[0], g[1]))
        assert max([m] + g) < mpf(10)**-40
        for kind, s, r in (("gauss", 1, 1), ("gauss", 2, 2), ("gauss", 3, 4), ("gauss", 3, 3),
                           ("lobatto", 2, 2), ("lobatto", 3, 3), ("lobatto", 3, 4)):
            want = min(2*s, 2*r if kind == "gauss" else 2*r - 2) + 1
            got = local_order(P, kind, s, r)
            say("    %-8s s=%d r=%d  local error of order %.2f, should be %d" % (kind, s, r, got, want))
            assert abs(got - want) < 0.5


# ------------------------------------------------------------------- writing

HEADER = """\
/* One step of the Galerkin variational integrator on seven problems, made by
   tests/gen/oracle.py (mpmath, {dps} digits, control points, automatic
   differentiation): do not edit.  Problems in the order of that file.         */
struct oracle_problem {{
    const char *name;
    int n;
    double t0, h, q0[3], p0[3];         /* dyadic: exact in any gvi_real        */
    double q, p, action;                /* magnitudes: errors are relative to these */
}};
struct oracle_case {{
    int problem, lobatto, s, r;
    long double q1[3], p1[3], quarter[3], three_quarters[3], action; /* curve at tau = 1/4, 3/4 */
}};
"""


def number(x):
    return mp.nstr(x, DIGITS, min_fixed=-5, max_fixed=5, strip_zeros=True) + "L"


def vector(x):
    return "{" + ",".join(number(a) for a in x) + "}"


def plain(x):
    return "{ " + ", ".join(repr(float(a)) for a in x) + " }"


def main():
    check()
    cases, problems = [], []
    for index, P in enumerate(PROBLEMS):
        size_q = size_p = size_a = mpf(0)
        for kind in ("gauss", "lobatto"):
            for s in DEGREES:
                for r in (s + m for m in MORE_POINTS):
                    if kind == "lobatto" and r < 2:
                        continue
                    S = Step(P, s, *rule(kind, r))
                    cases.append("  {%d,%d,%d,%d,%s,%s},\n" % (
                        index, kind == "lobatto", s, r,
                        ",".join(vector(x) for x in [S.q1, S.p1] + [S.curve(t) for t in TAUS]),
                        number(S.action)))
                    size_q = max([size_q] + [abs(x) for x in S.q0 + S.q1])
                    size_p = max([size_p] + [abs(x) for x in S.p0 + S.p1])
                    size_a = max([size_a] + [abs(S.h)*sum(abs(u) for u in x[0]) for x in S.pts])
        problems.append('  { "%s", %d, %r, %r, %s, %s, %.3g, %.3g, %.3g },\n' % (
            P.name, P.n, P.t0, P.h, plain(P.q0), plain(P.p0), size_q, size_p, size_a))
        print(P.name, len(cases), "cases", file=sys.stderr)
    print(HEADER.format(dps=mp.dps))
    print("static const struct oracle_problem oracle_problems[] = {\n" + "".join(problems) + "};\n")
    print("static const struct oracle_case oracle_cases[] = {\n" + "".join(cases) + "};")


if __name__ == "__main__":
    main()
