"""planet.py - gvi.h from Python: ctypes, numpy, no package and no copies

    cc -O2 -shared -fPIC -DGVI_IMPLEMENTATION -xc gvi.h -o libgvi.so -lm
    python3 planet.py ./libgvi.so                    (a second argument: a picture of the orbit, by matplotlib)

A callback gets all points of a step as numpy arrays that are the library's own memory: q[i, k] is coordinate i at
point k, and what is added to f is added there.  The structures below are those of gvi.h; `planet.py --layout` prints
where their fields are, and `make languages` compares that with the C compiler's.

prints

ok: q = -0.602737580 0.799997002
energy within 1e-13 of -0.5: True
"""
import ctypes as C
import sys

import numpy as np

real, pointer = C.c_double, C.POINTER(C.c_double)


class Points(C.Structure):
    _fields_ = [("n", C.c_int), ("count", C.c_int), ("stride", C.c_int), ("t", pointer), ("q", pointer), ("v", pointer),
                ("p", pointer), ("f", pointer), ("dldv", pointer), ("value", pointer), ("mass", pointer),
                ("velocity", pointer), ("g", pointer), ("jacobian", pointer), ("rate", pointer)]

    def rows(self, name, count=None):
        """the array `name` as [rows, points], or None: not wanted, or not to be read"""
        address = getattr(self, name)
        if not address:
            return None
        return np.ctypeslib.as_array(address, (count or self.n, self.stride))[:, :self.count]


points_fn = C.CFUNCTYPE(C.c_int, C.POINTER(Points), C.c_void_p)


class Effect(C.Structure):
    _fields_ = [("kind", C.c_int), ("points", points_fn), ("point", C.c_void_p), ("value", points_fn),
                ("hessian", C.c_void_p), ("user", C.c_void_p), ("rows", C.c_int)]


class Mass(C.Structure):
    _fields_ = [("kind", C.c_int), ("matrix", pointer), ("points", points_fn), ("gradient", points_fn),
                ("velocity", points_fn), ("user", C.c_void_p)]


class Rule(C.Structure):
    _fields_ = [("kind", C.c_int), ("points", C.c_int), ("nodes", pointer), ("weights", pointer)]


class Desc(C.Structure):
    _fields_ = [("n", C.c_int), ("degree", C.c_int), ("rule", Rule), ("mass", Mass), ("effects", C.POINTER(Effect)),
                ("effect_count", C.c_int), ("formulation", C.c_int), ("tolerance", real), ("max_iterations", C.c_int),
                ("iterations", C.c_int), ("later", real*8)]           # what later versions add: zeros


class Stepper(C.Structure):
    """the first fields; what follows is the library's, gvi_stepper_size() bytes in all"""
    _fields_ = [("n", C.c_int), ("s", C.c_int), ("r", C.c_int), ("status", C.c_int), ("formulation", C.c_int),
                ("t", real), ("t_low", real), ("q", pointer), ("p", pointer), ("q_low", pointer), ("p_low", pointer),
                ("h", real), ("t0", real)]


def layout():
    names = {Points: "gvi_points", Effect: "gvi_effect", Mass: "gvi_mass", Rule: "gvi_rule", Desc: "gvi_desc",
             Stepper: "gvi_stepper"}
    return [f"{name} {field} {getattr(structure, field).offset}" for structure, name in names.items()
            for field, _ in structure._fields_ if field != "later"]


class Run:
    """a scene of n coordinates: effects are (kind, points) or (kind, points, value), functions of a Points"""

    def __init__(self, library, n, effects, degree=8):
        self.lib = C.CDLL(library)
        self.lib.gvi_size.restype = self.lib.gvi_stepper_size.restype = C.c_size_t
        self.lib.gvi_why.restype = C.c_char_p
        keep = [[points_fn(lambda x, user, f=f: f(x.contents) or 0) for f in e[1:]] for e in effects]
        rows = (Effect*len(effects))(*(Effect(kind=e[0], points=k[0], value=k[1] if k[1:] else points_fn())
                                       for e, k in zip(effects, keep)))
        desc = Desc(n=n, degree=degree, effects=rows, effect_count=len(effects))
        size = self.lib.gvi_size(C.byref(desc))
        self.memory = np.zeros(max(size//8, 1))
        self.bytes = C.create_string_buffer(self.lib.gvi_stepper_size())
        self.st = Stepper.from_buffer(self.bytes)
        self.kept = keep, rows                        # as long as the stepper is used
        self.lib.gvi_init(self.bytes, C.byref(desc), self.memory.ctypes.data_as(pointer), C.c_size_t(size))

    def start(self, t, q, v):
        a, b = (np.ascontiguousarray(x, dtype=float) for x in (q, v))
        return self.lib.gvi_start(self.bytes, real(t), a.ctypes.data_as(pointer), b.ctypes.data_as(pointer))

    def step(self, h):
        return self.lib.gvi_step(self.bytes, real(h))

    def energy(self):
        out = real()
        self.lib.gvi_energy(self.bytes, C.byref(out))
        return out.value

    def why(self):
        return self.lib.gvi_why(self.bytes).decode()

    @property
    def q(self):
        return np.ctypeslib.as_array(self.st.q, (self.st.n,))


def attraction(x):
    q, f, value = x.rows("q"), x.rows("f"), x.rows("value", 1)
    d = np.hypot(q[0], q[1])
    if f is not None:
        f -= q/d**3
    if value is not None:
        value -= 1/d


def main(library, picture=None):
    run = Run(library, 2, [(0, attraction, attraction)])
    run.start(0, [0.4, 0], [0, 2])
    track = np.empty((10000, 2))
    k = 0
    while k < 10000 and run.st.status == 0:
        run.step(0.1)
        track[k] = run.q
        k += 1
    print(f"{run.why()}: q = {run.q[0]:.9f} {run.q[1]:.9f}")
    print("energy within 1e-13 of -0.5:", abs(run.energy() + 0.5) < 1e-13)
    if picture:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        plt.plot(track[:, 0], track[:, 1], ".", markersize=1)
        plt.plot(0, 0, "o")
        plt.axis("equal")
        plt.savefig(picture)


if sys.argv[1:] == ["--layout"]:
    print("\n".join(layout()))
elif __name__ == "__main__":
    main(*sys.argv[1:])
