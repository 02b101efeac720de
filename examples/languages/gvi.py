"""gvi.py - gvi.h from Python: all of it, by ctypes and numpy, without a build step

    import gvi, numpy as np
    def attraction(x): x.f -= x.q/np.hypot(*x.q)**3          # all points of a step at once
    def potential(x): x.value -= 1/np.hypot(*x.q)
    planet = gvi.Stepper(2, [gvi.Effect(attraction, potential)])
    planet.start(0, [0.4, 0], [0, 2])
    planet.steps(0.1, 1000)
    print(planet.t, planet.q, planet.energy())

L(t, q, v) or H(t, q, p) is typed, and nothing else is needed: gvi.lagrangian, gvi.hamiltonian.

The first stepper compiles gvi.h with $CC (cc) into the user's cache.  The header is $GVI_H, or gvi.h beside this file, or
two folders above it.  What the fields and functions mean is said in gvi.h; their names are the same without `gvi_`.
x.q[i, k] is coordinate i at point k, x.mass[i, j, k], x.jacobian[row, j, k]; x.t[k] and x.value[k].  They are the library's
own memory, like q and p of a stepper: add to f with +=, write mass, g and jacobian with x.g[0] = ...; `x.f = ...` is an error.
A callback returns nothing, or 1: "not here", and the library tries a way round.  An exception ends the step, leaves the
state as it was, and is raised again from step().  A failure is a gvi.Error.
"""
import ast
import ctypes as C
import hashlib
import os
import platform
import re
import subprocess

import numpy as np

POTENTIAL, FORCE, LAGRANGIAN, CLOCK, CONSTRAINT, NONHOLONOMIC = range(6)
UNIT, DIAGONAL, DENSE, POSITION, NONE = range(5)
GAUSS, LOBATTO, OWN, KICKS = range(4)
AUTO, EXPLICIT, POSITIONS, VELOCITIES, MOMENTA, NEWTON = range(6)
real, pointer, whole, address, text = C.c_double, C.POINTER(C.c_double), C.c_int, C.c_void_p, C.c_char_p

def structure(name, fields): return type(name, (C.Structure,), {"_fields_": fields, "__slots__": ()})    # no other names

ARRAYS = {"t": "", "q": "n", "v": "n", "p": "n", "f": "n", "dldv": "n", "value": "", "mass": "nn", "velocity": "n", "g": "m",
          "jacobian": "mn", "rate": "m"}
gvi_points = structure("gvi_points", [(i, whole) for i in ("n", "count", "stride")] + [(a, address) for a in ARRAYS])
points_fn = C.CFUNCTYPE(whole, C.POINTER(gvi_points), address)
hessian_fn = C.CFUNCTYPE(whole, real, *[pointer]*5, address)
gvi_effect = structure("gvi_effect", [("kind", whole), ("points", points_fn), ("point", address), ("value", points_fn),
                                      ("hessian", hessian_fn), ("user", address), ("rows", whole)])
gvi_mass = structure("gvi_mass", [("kind", whole), ("matrix", pointer), ("points", points_fn), ("gradient", points_fn),
                                  ("velocity", points_fn), ("user", address)])
gvi_rule = structure("gvi_rule", [("kind", whole), ("points", whole), ("nodes", pointer), ("weights", pointer)])
gvi_desc = structure("gvi_desc", [
    ("n", whole), ("degree", whole), ("rule", gvi_rule), ("mass", gvi_mass), ("effects", C.POINTER(gvi_effect)),
    ("effect_count", whole), ("formulation", whole), ("tolerance", real), ("max_iterations", whole), ("iterations", whole),
    ("resolution", real), ("tries", whole), ("later", real*8)])     # what later versions add: zeros
gvi_fault = structure("gvi_fault", [("effect", whole), ("coordinate", whole), ("point", whole), ("argument", text)])
gvi_counters = structure("gvi_counters", [(c, C.c_ulonglong) for c in (
    "steps", "failures", "iterations", "newton_iterations", "factorizations", "velocities", "mass")] + [
    ("effect", C.c_ulonglong*16), ("most_iterations", whole), ("worst_contraction", real), ("worst_change", real),
    ("worst_resolution", real)])
gvi_stepper = structure("gvi_stepper", [                  # what follows is the library's
    ("n", whole), ("s", whole), ("r", whole), ("status", whole), ("formulation", whole), ("t", real), ("t_low", real),
    ("q", pointer), ("p", pointer), ("q_low", pointer), ("p_low", pointer), ("h", real), ("t0", real), ("fault", gvi_fault),
    ("order", whole), ("iterations", whole), ("resolution", real), ("next", real), ("counters", gvi_counters)])
gvi_discrete = structure("gvi_discrete", [(d, pointer) for d in (
    "lagrangian", "d1", "d2", "minus", "plus", "p0", "p1")] + [("negative", C.POINTER(whole)), ("guess", pointer)])

def beside():
    """gvi.h: $GVI_H, or the one beside this file, or two folders above it"""
    here = os.path.dirname(os.path.abspath(__file__))
    places = os.environ.get("GVI_H"), here + "/gvi.h", here + "/../../gvi.h"
    return next(h for h in places if h and (os.path.exists(h) or h == places[-1]))

def made(source, *read, objects=None):
    """a C source that includes the files it reads, compiled once by $CC (cc) into the user's cache: an object, or if there
    are objects to link it with, a library"""
    cc, windows = os.environ.get("CC", "cc").split(), platform.system() == "Windows"
    key = hashlib.sha256(repr((source, cc, platform.machine(), objects)).encode())
    for file in read:
        with open(file, "rb") as f:
            key.update(f.read())
    cache = os.environ.get("XDG_CACHE_HOME") or windows and os.environ.get("LOCALAPPDATA") or os.path.expanduser("~/.cache")
    kind = "o" if objects is None else "dll" if windows else "so"
    name = f"{cache}/gvi/libgvi-{key.hexdigest()[:16]}.{kind}"
    if not os.path.exists(name):
        os.makedirs(cache + "/gvi", exist_ok=True)
        new = f"{name}.{os.getpid()}"                      # several processes may do it at once
        options = ["-O2", "-c" if objects is None else "-shared", *([] if windows else ["-fPIC"])]
        options += ["-I" + os.path.dirname(file) for file in read]
        subprocess.run([*cc, *options, *(objects or ()), "-xc", "-", "-o", new, "-lm"], input=source.encode(), check=True)
        os.replace(new, name)
    return name

def load(library=None, source="", *read):
    """the library at that path, or the one made of gvi.h and a source that uses it"""
    if not library:
        library = made(source, *read, objects=[made('#define GVI_IMPLEMENTATION\n#include "gvi.h"\n', beside())])
    lib = C.CDLL(library)
    lib.gvi_size.restype = lib.gvi_stepper_size.restype = C.c_size_t
    lib.gvi_why.restype = lib.gvi_status_text.restype = lib.gvi_formulation_text.restype = text
    for name in ("gvi_interpolate", "gvi_interpolate_derivative", "gvi_lu_rcond"):
        getattr(lib, name).restype = real
    return lib

class Error(ArithmeticError):                             # .effect, .coordinate, .point as in gvi_fault
    def __init__(self, why, status, effect=-1, coordinate=-1, point=-1):
        super().__init__(why)
        self.status, self.effect, self.coordinate, self.point = status, effect, coordinate, point

def given(x): return None if x is None else x.ctypes.data_as(pointer)

def numbers(x, shape=None):
    a = np.ascontiguousarray(x, dtype=float)
    if shape is not None and a.shape != shape:
        raise ValueError(f"{shape} numbers are wanted, {a.shape} are given")
    return a

def view(at, shape, stride=None):
    """numpy's view of memory: rows of `stride` numbers, of which the first shape[-1] count"""
    rows = *shape[:-1], stride or shape[-1]
    flat = (real*int(np.prod(rows))).from_address(at if isinstance(at, int) else C.addressof(at.contents))
    return np.frombuffer(flat).reshape(rows)[..., :shape[-1]]

class Points:
    """what a callback gets; arrays that it may not read or that are not wanted are None"""
    def __init__(self, at, rows, views):
        self.__dict__.update(_at=at, _rows=rows, _views=views)

    def __getattr__(self, name):
        at = getattr(self._at, name)
        if name not in ARRAYS or not at:
            return at if name in ("n", "count", "stride") else None
        key = name, at, self._rows, self._at.count, self._at.stride
        if key not in self._views:
            shape = *({"n": self._at.n, "m": self._rows}[d] for d in ARRAYS[name]), self._at.count
            array = self._views[key] = view(at, shape, self._at.stride)
            array.flags.writeable = name not in ("t", "q", "v", "p")
        return self._views[key]

    def __setattr__(self, name, value):
        if value is not getattr(self, name):              # what x.f -= ... ends with
            raise AttributeError(f"x.{name} = ... would change nothing: write x.{name} += ... or x.{name}[:] = ...")

class Effect:
    """points(x) and value(x) of a gvi.Points, hessian(t, q, v, fq, fv, pv); or functions of a C library, with `user`"""
    def __init__(self, points, value=None, kind=POTENTIAL, hessian=None, rows=0, user=None):
        self.points, self.value, self.kind, self.hessian, self.rows, self.user = points, value, kind, hessian, rows, user

class Mass:
    """matrix: [n] or [n, n]; or points, gradient and velocity, functions of a gvi.Points; or kind = NONE"""
    def __init__(self, matrix=None, points=None, gradient=None, velocity=None, kind=None):
        self.matrix = None if matrix is None else numbers(matrix)
        self.points, self.gradient, self.velocity = points, gradient, velocity
        self.kind = kind if kind is not None else POSITION if points else UNIT if matrix is None else self.matrix.ndim

class Stepper:
    """a scene of n coordinates and its state; options are the other fields of gvi_desc"""
    def __init__(self, n, effects=(), degree=0, mass=Mass(), rule=GAUSS, points=0, nodes=None, weights=None, library=None,
                 **options):
        self.lib, self.error, self.kept, self.views, self.rows = load(library), None, [], {}, sum(e.rows for e in effects)
        rows = (gvi_effect*max(len(effects), 1))(*(gvi_effect(
            e.kind, self.callback(e.points, e.rows), None, self.callback(e.value, e.rows), self.hessian(e.hessian, n),
            e.user, e.rows) for e in effects))
        nodes, weights = (None if x is None else numbers(x) for x in (nodes, weights))
        self.kept += rows, nodes, weights
        self.open(gvi_desc(
            n, degree, gvi_rule(rule, points or (0 if nodes is None else len(nodes)), given(nodes), given(weights)),
            gvi_mass(mass.kind, given(mass.matrix), *map(self.callback, (mass.points, mass.gradient, mass.velocity))),
            rows if effects else None, len(effects), **options))

    def open(self, desc):
        size = self.lib.gvi_size(C.byref(desc))
        self.memory = np.zeros(max(size//8, 1))
        self.bytes = C.create_string_buffer(self.lib.gvi_stepper_size())
        self.st = gvi_stepper.from_buffer(self.bytes)
        self.call("init", C.byref(desc), given(self.memory), C.c_size_t(size))

    def guard(self, function):
        """returns 1 for an exception and, until the call ends, ever after"""
        def guarded(*x):
            if self.error:
                return 1
            try:
                answer = function(*x)
                if answer not in (None, 0, 1):
                    raise TypeError("a callback adds to its arrays and returns nothing, or 1: not here")
                return answer or 0
            except BaseException as error:
                self.error = error
                return 1
        return guarded

    def callback(self, f, rows=0):
        guarded = self.guard(lambda x, user: f(Points(x.contents, rows, self.views)))
        self.kept.append(points_fn() if not f else C.cast(f, points_fn) if isinstance(f, C._CFuncPtr) else points_fn(guarded))
        return self.kept[-1]

    def hessian(self, f, n):
        shapes = [(n,)]*2 + [(n, n)]*3
        guarded = self.guard(lambda t, *x: f(t, *(view(a, s) if a else None for a, s in zip(x, shapes))))
        self.kept.append(hessian_fn(guarded) if f else hessian_fn())
        return self.kept[-1]

    def call(self, name, *arguments):
        status = getattr(self.lib, "gvi_" + name)(self.bytes, *arguments)
        error, self.error = self.error, None
        if error:
            raise error
        if status:
            fault = self.st.fault
            raise Error(self.why(), status, fault.effect, fault.coordinate, fault.point)

    def part(self, of): return self.memory[(C.addressof(getattr(self.st, of).contents) - self.memory.ctypes.data)//8:][:self.n]
    def take(self, *arrays): return (None if x is None else given(numbers(x, (self.n,))) for x in arrays)

    def out(self, name, *arguments, shapes):
        arrays = [np.empty(shape) for shape in shapes]
        self.call(name, *arguments, *map(given, arrays))
        return arrays[0] if len(arrays) == 1 else tuple(arrays)

    n, t, h, t0, counters = (property(lambda self, of=of: getattr(self.st, of)) for of in ("n", "t", "h", "t0", "counters"))
    q, p, q_low, p_low = (property(lambda self, of=of: self.part(of)) for of in ("q", "p", "q_low", "p_low"))

    def start(self, t, q, v): self.call("start", real(t), *self.take(q, v))
    def start_momentum(self, t, q, p): self.call("start_momentum", real(t), *self.take(q, p))
    def start_configurations(self, t, h, a, b): self.call("start_configurations", real(t), real(h), *self.take(a, b))
    def step(self, h): self.call("step", real(h))
    def steps(self, h, count): self.call("steps", real(h), count)
    def advance(self, t_end): self.call("advance", real(t_end))
    def switch(self, index, on): self.call("switch", index, int(on))
    def velocity(self): return self.out("velocity", shapes=[self.n])
    def energy(self): return float(self.out("energy", shapes=[()]))
    def multipliers(self): return self.out("multipliers", shapes=[self.rows])
    def curve(self, tau): return self.out("curve", real(tau), shapes=[self.n]*2)
    def curve_multipliers(self, tau): return self.out("curve_multipliers", real(tau), shapes=[self.rows])
    def state_at(self, t): return self.out("state_at", real(t), shapes=[self.n]*3)
    def action(self): return float(self.out("action", shapes=[()]))
    def why(self): return self.lib.gvi_why(self.bytes).decode()
    def formulation(self): return self.lib.gvi_formulation_text(self.bytes).decode()
    def save(self): return self.bytes.raw, self.memory.copy()
    def restore(self, saved): self.call("restore", C.create_string_buffer(*saved[:1]), given(saved[1]))

    def project(self, t, q, v):
        """the nearest q and v that fulfil the constraints, and how far they are"""
        q, v, moved = numbers(q, (self.n,)).copy(), numbers(v, (self.n,)).copy(), np.empty(2)
        self.call("project", real(t), *map(given, (q, v, moved)))
        return q, v, moved

    def discrete_lagrangian(self, t, h, q0, q1, want=("lagrangian", "d1", "d2", "p0", "p1"), guess=None):
        """a dict of what is wanted, by the names of gvi_discrete"""
        out = {w: np.zeros((), np.intc) if w == "negative" else np.zeros(() if w == "lagrangian" else self.n) for w in want}
        q0, q1, guess = self.take(q0, q1, guess)
        wanted = gvi_discrete(guess=guess, **{w: a.ctypes.data_as(dict(gvi_discrete._fields_)[w]) for w, a in out.items()})
        self.call("discrete_lagrangian", real(t), real(h), q0, q1, C.byref(wanted))
        return {w: a if a.shape else a.item() for w, a in out.items()}

    def event(self, g):
        """the time in the last step at which g(t, q, v) changes its sign, by bisection; None: it does not"""
        def sign(t): return g(t, *self.state_at(t)[:2]) > 0
        a, b, first = self.t0, self.t, sign(self.t0)
        if sign(b) == first:
            return None
        while a < (a + b)/2 < b or b < (a + b)/2 < a:
            a, b = ((a + b)/2, b) if sign((a + b)/2) == first else (a, (a + b)/2)
        return b

TYPED = """#include "gvi.h"
#include "lagrangian.h"
static inline number power(number x, int k) { number y = 1; while (k-- > 0) y *= x; return y; }
%(parts)s
size_t typed_size(void) { return sizeof(%(of)s); }
const char *typed_init(%(of)s *L, void *user, double t, const double *q, const double *v, gvi_effect *rows, gvi_mass *mass,
                       const char **what)
{
    const char *wrong = %(of)s_init(L, typed_L, user, t, q, v);
    if (wrong) return wrong;
    *what = %(what)s;
    *rows++ = %(of)s_effect(L);
    *mass = %(of)s_mass(L);
%(rows)s    return NULL;
}
"""
IN_PYTHON = (r"by HAMILTONIAN", "to gvi.hamiltonian"), (r"as a row, by HOLDS.*", "as holds="), (       # what sentences say of C
    r"set L\.kind = LAGRANGIAN_(\w+) after lagrangian_init", r'give kind="\1"')
FUNCTIONS = "sqrt cbrt exp log sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh atan2 hypot fabs".split()
SIGNS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.UAdd: "+", ast.USub: "-"}

class InC:
    """Python's syntax to C: q[i], v[i] or p[i], t, pi, parameters, + - * / **, the functions above, `name = ...` before the last"""
    def __init__(self, n, parameters, letter):
        self.n, self.letter, self.names = n, letter, {**parameters, "t": "t", "pi": "3.14159265358979323846"}

    def body(self, text):
        *before, last = ast.parse(text.strip() or "nothing").body
        lines, names = [], self.names
        self.names = dict(names)
        for line in before:
            if not isinstance(line, ast.Assign) or not isinstance(line.targets[0], ast.Name):
                raise ValueError(f"{ast.unparse(line)}: before the last expression there may be `name = ...`")
            name = line.targets[0].id
            lines.append(f"const number local_{name} = {self.term(line.value)};")
            self.names[name] = "local_" + name
        if not isinstance(last, ast.Expr):
            raise ValueError(f"{ast.unparse(last)}: the last has to be an expression")
        value, self.names = self.term(last.value), names
        return " ".join(lines), value

    def term(self, e):
        if isinstance(e, ast.Constant) and type(e.value) in (int, float):
            return repr(float(e.value))                    # 1/2 is 0.5, as in Python
        if isinstance(e, ast.Name) and e.id in self.names:
            return self.names[e.id]
        if isinstance(e, ast.Subscript) and isinstance(e.value, ast.Name) and e.value.id in ("q", self.letter):
            i = getattr(e.slice, "value", None)
            if type(i) is int and 0 <= i < self.n:
                return f"{e.value.id}[{i}]"
            raise ValueError(f"{ast.unparse(e)}: n is {self.n}")
        if isinstance(e, ast.BinOp) and isinstance(e.op, ast.Pow):
            k = getattr(e.right, "value", None)
            whole_k = type(k) is int and 0 <= k <= 64
            return f"power({self.term(e.left)}, {k})" if whole_k else f"pow({self.term(e.left)}, {self.term(e.right)})"
        if isinstance(e, ast.BinOp) and type(e.op) in SIGNS:
            return f"({self.term(e.left)} {SIGNS[type(e.op)]} {self.term(e.right)})"
        if isinstance(e, ast.UnaryOp) and type(e.op) in SIGNS:
            return f"({SIGNS[type(e.op)]}{self.term(e.operand)})"
        if isinstance(e, ast.Call) and isinstance(e.func, ast.Name) and e.func.id in FUNCTIONS and not e.keywords:
            return f"{e.func.id}({', '.join(map(self.term, e.args))})"
        raise ValueError(f"{ast.unparse(e)}: not known; there are q[i], {self.letter}[i], t, pi, parameters, + - * / ** and "
                         + " ".join(FUNCTIONS))

class lagrangian(Stepper):
    """a scene from L alone; F is Rayleigh's function, friction's f = -dF/dv; holds are g(t, q) = 0, rolls A v + a = 0

        pendulum = gvi.lagrangian("v[0]**2/2 + g*cos(q[0])", n=1, g=9.81, F="0.1*v[0]**2/2")
        pendulum.start(0, [1], [0])

    Fields of gvi_desc are options, all other names parameters: those of pendulum["g"] = 3.7 may change between steps.
    ValueError says why L is refused; .text says, after start, what it was found to be, or what kind="MASS", say, sets."""
    of, letter, what = "lagrangian", "v", "lagrangian_text(L)"

    def __init__(self, L, n, F=None, holds=(), rolls=(), kind=None, **options):
        self.options = {name: options.pop(name) for name, _ in gvi_desc._fields_ if name in options}
        self.names, self.values = list(options), numbers(list(options.values()) or [0])
        c, header = InC(n, {name: f"((const double *)user)[{k}]" for k, name in enumerate(options)}, self.letter), beside()
        what = f"(L->kind = LAGRANGIAN_{kind}, {self.what})" if kind else self.what
        parts, rows, folder = ["%s(typed_L, %d) { %s return %s; }" % (self.of.upper(), n, *c.body(L))], "", os.path.dirname(header)
        if F:
            parts.append("DISSIPATION(typed_F, %d) { %s return %s; }" % (n, *c.body(F)))
            rows += "    *rows++ = (gvi_effect){ .kind = GVI_FORCE, .points = typed_F, .user = user };\n"
        for macro, kind, given_rows in (("HOLDS", "CONSTRAINT", holds), ("ROLLS", "NONHOLONOMIC", rolls)):
            for k, row in enumerate([given_rows] if isinstance(given_rows, str) else given_rows):
                parts.append("%s(typed_%s%d, %d, 1) { %s row[0] = %s; }" % (macro, macro, k, n, *c.body(row)))
                rows += f"    *rows++ = (gvi_effect){{ .kind = GVI_{kind}, .points = typed_{macro}{k}, .user = user, .rows = 1 }};\n"
        tools = (folder + place + "lagrangian.h" for place in ("/", "/tools/", "/gvi/", "/examples/tools/"))
        tool = next((h for h in tools if os.path.exists(h)), None)
        if not tool:
            raise FileNotFoundError(f"lagrangian.h is neither beside {header} nor in a folder tools there")
        self.lib = load(None, TYPED % dict(of=self.of, parts="\n".join(parts), what=what, rows=rows), header, tool)
        self.lib.typed_size.restype, self.lib.typed_init.restype = C.c_size_t, text
        self.error, self.views, self.size, self.count, self.rows = None, {}, n, rows.count("*rows++") + 1, rows.count(".rows = 1")
        self.L = C.create_string_buffer(self.lib.typed_size())

    def __setitem__(self, name, value): self.values[self.names.index(name)] = value
    def __getitem__(self, name): return float(self.values[self.names.index(name)])

    def start(self, t, q, v):
        q, v = numbers(q, (self.size,)), numbers(v, (self.size,))
        self.effects, mass, what = (gvi_effect*self.count)(), gvi_mass(), text()
        wrong = self.lib.typed_init(self.L, given(self.values), real(t), given(q), given(v), self.effects, C.byref(mass),
                                    C.byref(what))
        if wrong:
            raise ValueError(self.said(wrong.decode()))
        self.text = what.value.decode()
        self.open(gvi_desc(n=self.size, mass=mass, effects=self.effects, effect_count=self.count, **self.options))
        (self.start_momentum if self.letter == "p" else super().start)(t, q, v)

    def why(self): return self.said(super().why())
    def said(self, sentence):
        for c, python in IN_PYTHON:
            sentence = re.sub(c, python, sentence)
        return sentence

class hamiltonian(lagrangian):
    """a scene from H(t, q, p) alone, without friction and constraints

        pair = gvi.hamiltonian("-log((q[0] - q[1])**2 + (p[0] - p[1])**2)/(4*pi)", n=2)     # two vortices
        pair.start(0, [0, 0], [0.5, -0.5])                                                  # q and p

    Parameters and options are those of gvi.lagrangian."""
    of, letter, what = "hamiltonian", "p", '"H(t,q,p)"'

    def __init__(self, H, n, **options):
        if options.keys() & {"F", "holds", "rolls", "kind"}:
            raise ValueError("F, holds, rolls and kind are for gvi.lagrangian: H stands alone")
        super().__init__(H, n, formulation=MOMENTA, **options)

def plain(name, *x, out=()):
    """gvi_`name`(*x, *out), a function without a stepper; returns `out`, or what it returns: plain("gauss", 3,
    out=(c, b)), plain("rule_order", 3, c, b), plain("interpolate", n, x, w, f, real(t)), plain("lu_solve", n, lu, pivot, out=(y,))"""
    lib = load()
    answer = getattr(lib, "gvi_" + name)(*(given(a) if isinstance(a, np.ndarray) else a for a in (*x, *out)))
    if out and answer < 0 and not name.startswith(("basis", "lu_solve")):
        raise Error(lib.gvi_status_text(answer).decode(), answer)
    return out or answer
