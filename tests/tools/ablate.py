#!/usr/bin/env python3
"""ablate.py BUILD [K ...]: each condition of judgement of gvi.h taken out alone, and what notices: the tests near it,
short hard cases, everyday scenes in all types, until two have.  All of these are green before, with gvi.h as it
is.  A condition that nobody misses has to go.  In parts: K, the numbers of those to be run; two minutes of one core each.
--texts: looks for the texts alone; one that does not stand in gvi.h once is a failure."""
import os, subprocess, sys

CONDITIONS = [   # what it is, the tests near it, what stands in gvi.h and what then stands there
    ('the floor: what constraints add, rounding of g', 'convergence constraints constraints_newton loops rolling body resolution',
     [('if (i == 0 && moves) gvi__constraints_moved(st, in->con.scratch);', 'if (i == 0) gvi__zero((size_t)(st->n*in->con.C), in->con.scratch);')]),
    ('the floor: not while a row falls', 'rolling body uncoupled constraints loops',
     [('if (change[row] > place*place && change[row] < fall*before[row]) return 1;', '(void)change, (void)before, (void)place, (void)fall, (void)row;')]),
    ('the floor: units anew after an overshoot', 'uncoupled regressions jumps convergence',
     [('p->rescale = D > GVI__FAR*GVI__FAR || gvi__is_poor(p);', 'p->rescale = 0;')]),
    ('the floor: does the amplitude fall?', 'uncoupled regressions jumps convergence',
     [('p->poor = excess > 1 && excess > p->excess/2 ? p->poor + poor : 0;', 'p->poor = excess > 1 ? p->poor + poor : 0;')]),
    ('slow: errors grew first', 'newton regressions jumps convergence',
     [('slow ? GVI__DIVERGES', '0 ? GVI__DIVERGES')]),
    ('of rows that depend on each other the last is left out', 'constraints constraints_newton loops rolling resolution',
     [('spare = gvi__spare(st, S, i, was, A);', 'spare = i, (void)gvi__spare;')]),
    ('near its root g is taken for linear', 'constraints constraints_newton loops rolling resolution',
     [('in->con.linear = in->con.made > 0;', 'in->con.linear = 0;'), ('    st->in.con.linear |=\n        GVI__DIG', '    st->in.con.linear |= 0 &&\n        GVI__DIG')]),
    ('off a constraint is measured by the move that it takes', 'constraints constraints_newton loops rolling resolution',
     [('for (int k = 0; part > GVI__EPS/GVI__HELD && refused < 0; ++k) {',
       'if (refused < 0) refused = off;\n    for (int k = 0; part > GVI__EPS/GVI__HELD && refused < 0; ++k) {')]),
    ('rows that were nearly one at the start may stay so', 'constraints constraints_newton loops rolling resolution',
     [('st->in.con.near_start = most;', 'st->in.con.near_start = 0;')]),
    ('a row is judged earlier where a step failed', 'constraints constraints_newton loops rolling resolution',
     [('if (*start != GVI_OK) st->in.con.margin = GVI__FADES;', '')]),
    ('what ends of steps were off by is kept', 'constraints constraints_newton loops rolling resolution',
     [('noise[a] = gvi__larger(GVI_ABS(st->in.con.g[a]), before);', 'noise[a] = 0*before;')]),
    ('gvi_project: slow progress', 'constraints constraints_newton loops rolling resolution',
     [('slow = !(size < before/64);', 'slow = 0;')]),
    ("the end of Newton's step: has the rank turned?", 'constraints constraints_newton loops rolling resolution',
     [('for (int ej = 0; ej < st->s*m; ++ej) {\n        const int e = ej/m', 'for (int ej = 0; ej < 0*st->s*m; ++ej) {\n        const int e = ej/m')]),
    ('rank is judged in a step', 'constraints constraints_newton loops rolling resolution',
     [('status = gvi__check_rank(st, start ? 0 : in->con.margin);', 'status = start ? gvi__check_rank(st, 0) : GVI_OK;')]),
    ('gvi_project: part of a change', 'constraints constraints_newton loops rolling resolution',
     [('if (change > before && share*(1 << GVI__NEARER) > 1) share /= 2;', '')]),
    ('rolling: rounding of positions', 'constraints constraints_newton loops rolling resolution',
     [('rounded = st->formulation != GVI_NEWTON ? n : 0;', 'rounded = 0;')]),
    ('units of the multipliers', 'constraints_newton newton loops constraints jumps boundary',
     [('if (diagonal > 0 && column*GVI_SQRT(GVI__EPS) > diagonal)', 'if (0)')]),
    ('changes that make the residual larger are halved', 'constraints_newton newton loops constraints jumps boundary',
     [('if (J->halves && p->halves >= 0 &&', 'if (0 && J->halves && p->halves >= 0 &&')]),
    ('a branch is followed back', 'constraints_newton newton loops constraints jumps boundary',
     [('J.halves = 0;\n        status = gvi__newton_connected(st, from, &J);', 'J.halves = 0; (void)gvi__newton_connected;')]),
    ('the sign of the determinant', 'constraints_newton newton loops constraints jumps boundary',
     [('|| gvi__orientation(&J, all) < 0)) {', '|| 0)) {'), ('&& gvi__orientation(&K, all) == sign;', '&& sign != 5;')]),
    ('the old matrix is tried again', 'constraints_newton newton loops constraints jumps boundary',
     [('if (!old || status != GVI_OK || !(in->newton.bend > far)) break;', 'break;')]),
    ('a difference from rest', 'constraints_newton newton loops constraints jumps boundary',
     [('return by_force > most && (by_v || !(most > GVI__MIN/GVI__EPS)) ? by_force : most;', 'return most;')]),
    ('is d2L/dv2 regular?', 'constraints_newton newton loops constraints jumps boundary',
     [('gvi_status status = gvi__check_regular(st);\n    if (status == GVI_OK) status = gvi__jacobian_exact', 'gvi_status status = GVI_OK; (void)gvi__check_regular;\n    if (status == GVI_OK) status = gvi__jacobian_exact')]),
    ('one ratio by an old matrix may be luck', 'constraints_newton newton loops constraints jumps boundary',
     [('|| change*other <= enough;', '|| 1; (void)other;')]),
    ('stiff: the highest modes as they are', 'resolution loops constraints',
     [('if (stiff) return high;', '')]),
    ('modes that are rounding of t and q', 'resolution loops constraints',
     [('high <= place*change*reach);', 'high < 0*change*reach);')]),
    ('a length that failed is barred', 'resolution loops constraints',
     [('if (dial->wait > 0 && up > 0)', 'if (0)')]),
    ("shorter steps before Newton's method", 'resolution loops constraints',
     [('if (st->in.dial.put_off && status == GVI_E_CONVERGENCE) return status;', '')]),
    ('d2L/dv2 from rest', 'lagrangian mass convergence newton jumps regressions identities uncoupled oracle why constraints_newton',
     [('} else if (at_rest && target > 0 && moved > 16*target) {', '} else if (0) {')]),
    ('d2L/dv2 beside a large p', 'lagrangian mass convergence newton jumps regressions identities uncoupled oracle why constraints_newton',
     [('} else if (moved < target/2 && GVI_ABS(d)/GVI_SQRT(root) < edge) {', '} else if (0 && edge > 0) {')]),
    ('one ratio of the fixed point may be luck', 'uncoupled regressions jumps convergence hostile newton tolerance domains resolution constraints',
     [('if (!(D*other <= limit)) return 0;', '')]),
    ("halfway into a callback's domain", 'uncoupled regressions jumps convergence hostile newton tolerance domains resolution constraints',
     [('&& shorter++ < GVI__NEARER) {', '&& shorter++ < 0) {')]),
    ("an end's velocity by what p was added up from", 'constraints rolling loops constraints_newton lagrangian',
     [(' && !gvi__rates_are_rounding(st, t, q, v)\n        && !(size <= far*far*gvi__energy_of_terms(st, from, p, in->con.scratch)))', ')')]),
]


HARD = "eccentric flyby corners pythagorean random:5 roots:6 measure rest:60 rolling:16384".split()       # the short forms of make check


class Broken(Exception):
    pass


def run(command, seconds=600):
    try:
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=seconds).returncode
    except subprocess.TimeoutExpired:
        return 1


def must(command, what):
    if run(command):
        raise Broken(what)


class Trial:
    """Programs are compiled once, against gvi.h as it is; the library alone is compiled without the condition."""
    def __init__(self, build):
        self.build, self.room, self.libraries = build, os.path.join(build, "ablate"), {}
        self.flags = [os.environ.get("CC", "cc"), "-std=c99", "-O1", "-w", "-ffp-contract=off", "-Itests", "-Iexamples"]
        os.makedirs(self.room, exist_ok=True)

    def header(self, text):
        self.libraries = {}
        open(self.room + "/gvi.h", "w").write(text)

    def library(self, real):
        if real not in self.libraries:
            made = "%s/%s.o" % (self.room, real.split()[0])
            must(self.flags + ["-DGVI_REAL=" + real, "-I" + self.room, "-c", "tests/compile/implementation.c", "-o", made],
                 "the library does not compile")
            self.libraries[real] = made
        return self.libraries[real]

    def program(self, source, real, more=()):
        name = "%s/%s-%s" % (self.room, os.path.basename(source)[:-2], real.split()[0])
        newest = max(os.path.getmtime(f) for f in (source, "gvi.h"))
        if not os.path.exists(name + ".o") or os.path.getmtime(name + ".o") < newest:
            must(self.flags + ["-DGVI_REAL=" + real, "-I.", "-DGVI_IMPLEMENTED", "-c", source, "-o", name + ".o"], source + " does not compile")
        must([self.flags[0], name + ".o", *more, self.library(real), "-o", name, "-lcmocka", "-lm"], source + " is not linked")
        return name

    def test(self, name):
        source = "tests/test_%s.c" % name
        return run([self.program(source, "long double" if "define GVI_REAL long double" in open(source).read() else "double")])

    def everyday(self, real):
        """As make builds it: laws typed in C and in C++, and known.h says what is known."""
        typed = "%s/everyday/typed-%s.o" % (self.build, real.split()[0])
        must(["make", "-s", typed], typed + " is not made")
        return run([self.program("tests/everyday/everyday.c", real, [typed])])

    def hard(self, name):
        name, _, size = name.partition(":")
        return run([self.program("tests/hard/%s.c" % name, "double")] + ([size] if size else []))

    def trials(self, tests):
        for t in tests.split():
            yield "test_" + t, lambda t=t: self.test(t)
        for h in HARD:
            yield "hard-" + h.split(":")[0], lambda h=h: self.hard(h)
        yield "everyday", lambda: self.everyday("double")
        yield "everyday in float", lambda: self.everyday("float")
        yield "everyday in long double", lambda: self.everyday("long double")

    def noticed_by(self, tests, enough):
        """The first `enough` that notice."""
        found = []
        for name, trial in self.trials(tests):
            if len(found) < enough and trial():
                found.append(name)
        return found


def chosen(arguments):
    alone = [int(k) for k in arguments if k.isdigit()]
    return [(k, c) for k, c in enumerate(CONDITIONS) if not alone or k in alone]


def main(build, arguments):
    text = open("gvi.h").read()
    lost = [name for name, _, edits in CONDITIONS if any(text.count(old) != 1 for old, _ in edits)]
    for name in lost:
        print("FAILED: not once in gvi.h: " + name)
    if "--texts" in arguments:
        return print("ablate: %d of %d conditions stand in gvi.h" % (len(CONDITIONS) - len(lost), len(CONDITIONS))) or bool(lost)

    trial, missed = Trial(build), 0
    trial.header(text)
    untouched = trial.noticed_by(" ".join(sorted({t for _, (_, tests, _) in chosen(arguments) for t in tests.split()})), 99)
    if untouched:
        return print("FAILED: red with gvi.h as it is: " + " ".join(untouched)) or 1
    for k, (name, tests, edits) in chosen(arguments):
        if name in lost:
            continue
        header = text
        for old, new in edits:
            header = header.replace(old, new)
        trial.header(header)
        try:
            noticed = trial.noticed_by(tests, 2)
        except Broken as what:
            return print("FAILED: without %s: %s" % (name, what)) or 1
        missed += not noticed
        print("%2d %-58s %s" % (k, name, " ".join(noticed) or "NOBODY NOTICES"), flush=True)
    print("ablate: %d conditions that nobody misses" % missed)
    return missed > 0 or bool(lost)


sys.exit(main(sys.argv[1], sys.argv[2:]))
