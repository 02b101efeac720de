"""lagrangian.py - a Lagrangian typed in Python, and nothing else: complex numbers carry the derivatives

    cc -O2 -shared -fPIC -I. -Iexamples examples/languages/lagrangian.c -o libgvi_l.so -lm
    python3 lagrangian.py ./libgvi_l.so

L gets t, q and v, arrays of complex numbers: q[0] is the first coordinate at all points of a step, so that one call of
L computes them all.  Functions are those of numpy that take complex numbers; not abs, not comparisons.
lagrangian_init looks at L and finds out what it is, as in C.

prints

ok: q = 0.631257632 0.436538384
L is v'M(t,q)v/2 - V(t,q), energy within 1e-12: True
refused: dL/dq[0] is 0 by numbers, -22.238 by differences: is a variable in L a double that has to be a number?
"""
import ctypes as C
import sys

import numpy as np

import gvi
from gvi import pointer, real, view


class Wanted(C.Structure):
    _fields_ = [("x", C.POINTER(gvi.gvi_points)), ("w", pointer), ("one", C.c_int), ("times", real), ("scale", real),
                ("least", real), ("value", pointer), ("by_q", pointer), ("by_w", pointer), ("first", C.c_int), ("end", C.c_int),
                ("apart", C.c_int), ("along", pointer), ("by_along", pointer), ("user", C.c_void_p)]


add_fn = C.CFUNCTYPE(None, C.POINTER(Wanted))
STEP = 2.0**-332


def adds(L):
    """what lagrangian.h asks for, from a function L(t, q, v)"""
    def add(wanted):
        a = wanted.contents
        x = a.x.contents
        n, count, stride = x.n, x.count, x.stride
        z = np.zeros((2*n, count), dtype=complex)
        z[:n] = view(x.q, (n, count), stride)
        if a.w:
            z[n:] = a.times*view(a.w, (n, count), stride)
        elif a.one >= 0:
            z[n + a.one] = a.times
        t = view(x.t, (count,))
        one = np.eye(2*n)
        directions = [(one[i], a.by_q, i*stride) for i in range(n) if a.by_q]
        directions += [(one[n + i], a.by_w, i*a.apart) for i in range(a.first, a.end) if a.by_w]
        directions += [(view(a.along, (2*n,)), a.by_along, 0)] if a.along else []
        value = None
        for direction, out, at in directions:
            value = L(t, *np.split(z + 1j*STEP*direction[:, None], 2))
            slope = np.imag(value)/STEP
            slope = np.where(np.abs(slope) <= a.least*np.abs(np.real(value)), 0, slope)
            view(out, (at + count,))[at:] += a.scale*slope
        if a.value:
            value = L(t, z[:n], z[n:]) if value is None else value
            view(a.value, (count,))[:] += a.scale*np.real(value)
    return add


class Typed(gvi.Stepper):
    """a stepper from L(t, q, v) alone; ValueError says why L is refused"""

    def __init__(self, library, n, L, t, q, v, degree=8):
        lib = self.lib = gvi.load(library)
        lib.typed_size.restype = C.c_size_t
        lib.typed_init.restype = lib.typed_text.restype = C.c_char_p
        at = [gvi.numbers(z, (n,)) for z in (q, v)]
        self.error, self.views, self.rows = None, {}, 0
        self.L, self.add = C.create_string_buffer(lib.typed_size()), add_fn(self.guard(adds(L)))
        wrong = lib.typed_init(self.L, n, self.add, real(t), *map(gvi.given, at))
        if self.error:
            raise self.error
        if wrong:
            raise ValueError(wrong.decode())
        self.effect, mass = (gvi.gvi_effect*1)(), gvi.gvi_mass()
        lib.typed_scene(self.L, self.effect, C.byref(mass))
        self.open(gvi.gvi_desc(n=n, degree=degree, mass=mass, effects=self.effect, effect_count=1))
        self.start(t, q, v)


def pendulum(t, q, v):
    g = 9.81
    return v[0]**2 + v[1]**2/2 + v[0]*v[1]*np.cos(q[0] - q[1]) + 2*g*np.cos(q[0]) + g*np.cos(q[1])


def trap(t, q, v):
    return v[0]**2/2 + v[1]**2/2 + 31*np.cos(q[0].real)


def main(library):
    run = Typed(library, 2, pendulum, 0, [0.8, 0.5], [0, 0])
    energy = run.energy()
    for _ in range(1600):
        run.step(1/16)
    print(f"{run.why()}: q = {run.q[0]:.9f} {run.q[1]:.9f}")
    print(f"L is {run.lib.typed_text(run.L).decode()}, energy within 1e-12:", abs(run.energy() - energy) < 1e-12)
    try:
        Typed(library, 2, trap, 0, [0.8, 0.5], [0, 0])
    except ValueError as why:
        print("refused:", why)


if __name__ == "__main__":
    main(*sys.argv[1:])
