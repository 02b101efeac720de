#!/usr/bin/env python3
"""mutants.py BUILD [--texts] [K ...]: wrong versions of gvi.h, each of which a test has to notice.

Each entry: the tests that should see it, what stands in gvi.h, once, what stands there instead.  The
library is compiled anew for each; tests are compiled once.  A mutant that no test sees survives; more than
one survivor is a failure, and so is a text that does not stand in gvi.h once, which is named and left
out.  Twenty minutes of one core; not part of CI.  --texts: looks for the texts alone; K: those numbers alone.
"""
import os, resource, subprocess, sys

MUTANTS = [
    # what survived once
    ("clock domains", "GVI_FAULT_NONE, k);\n    }\n\n    if (!GVI__LOOKS(st)) return GVI_OK;\n    return gvi__check_rows(st, x, slope",
              "GVI_FAULT_NONE, k + 1);\n    }\n\n    if (!GVI__LOOKS(st)) return GVI_OK;\n    return gvi__check_rows(st, x, slope"),
    ("clock domains", "    if (status != GVI_OK) {\n        in->off = was;\n        return status;\n    }\n\n    in->time.H = E;", "    if (status != GVI_OK) return status;\n    in->time.H = E;"),
    ("boundary", "in->off |= gvi__of_kind(in, GVI_FORCE);", ""),
    ("identities order", "table->inv_gamma[s - 1] = 1/sum;", "table->inv_gamma[s - 1] = (1 + GVI_SQRT(GVI__EPS))/sum;"),
    ("mass regressions api", "m, at);\n    if (status == GVI_OK) return GVI_OK;\n    return gvi__report(st, status, GVI_FAULT_MASS, at[0], at[1]);",
              "m, at);\n    if (status == GVI_OK) return GVI_OK;\n    return gvi__report(st, status, GVI_FAULT_MASS, at[1], at[0]);"),
    ("newton", "const gvi_real now = -(gvi_real)(2*k + 1)*sum;", "const gvi_real now = -sum;"),
    ("newton", "if (st->formulation == GVI_NEWTON && unit > 0) return 1/(unit*unit);", "(void)unit;"),
    ("newton", "/inertia*(in->adds_p ? 2 : 1);", "/inertia;"),
    ("jumps newton", "from->q[i] + (from->q_low[i] + in->sized.h*Q[j])", "from->q[i] + in->sized.h*Q[j]"),
    ("tangent identities", "if (mirror == most || gvi__nonzero(b[mirror] - b[most])) sized->hb[most]", "if (mirror < r) sized->hb[most]"),
    ("identities structure oracle", "gvi__grid(gvi__coupling(st, Phi, low, i), GVI__EPS/2)", "gvi__grid(gvi__coupling(st, Phi, low, i), GVI__EPS/4)"),
    ("kicks", "sized->hb[j] = gvi__grid(gvi__two_prod(b[j], mantissa), GVI__EPS/2);", "sized->hb[j] = b[j]*mantissa;"),
    # linear algebra, quadrature, interpolation
    ("lu", "if (x > big) {\n                big = x;\n                m = i;", "if (x > big && i == k) {\n                big = x;\n                m = i;"),
    ("lu", "GVI_ABS(a[i*N + k])*pivot[i];", "GVI_ABS(a[i*N + k]);"),
    ("lu", "2*gvi__norm1(n, x)/(3*(gvi_real)n));", "0*gvi__norm1(n, x));"),
    ("mass structure", "b[k] = a[k];\n                a[k] *= d[k];", "b[k] = a[k];\n                a[k] *= d[k]*(1 + GVI__EPS*64);"),
    ("interpolation", "others += l[j];", "others += l[j]*(1 + 256*GVI__EPS);"),
    ("interpolation", "if (GVI_ABS(t - x[j]) < GVI_ABS(t - x[i])) i = j;", ""),
    # scene
    ("convergence effects", "    int failed;\n\n    if (effect->kind == GVI_POTENTIAL) at->v = NULL;", "    int failed;"),
    ("kicks effects", "skip |= st->in.off | st->in.separate;", "skip |= st->in.separate;"),
    ("queries effects", "if (effect->kind == GVI_POTENTIAL) at.v = NULL;\n    at.f", "at.f"),
    ("resolution queries", "*energy = pv/2 + V;", "*energy = pv/2 - V;"),
    ("no_trace", "st->counters.effect[e] -= (unsigned long long)at->count;", ""),
    ("domains", "if (k > 0 && beyond && halves < GVI__NEVER) {", "if (k > 0 && status == GVI_E_NON_FINITE && halves < GVI__NEVER) {"),
    # the step
    ("newton structure no_trace", "if (!gauss || i != j) T = gvi__T(st, i);", "T = gvi__T(st, i)*(1 + (i == j)*GVI__EPS*1024);"),
    ("uncoupled regressions jumps", "if (Di > 2*GVI__EPS*GVI__EPS && Di*Di > limit*was) return 0;", "(void)Di, (void)was;"),
    ("regressions uncoupled jumps", "excess = gvi__larger(change/(eps*size + GVI_SQRT(m)*added), excess);",
              "(void)size, (void)added, (void)change;"),
    ("convergence jumps", "for (int plain = !usable; plain < 2; ++plain) {", "for (int plain = !usable; plain < 1 + !usable; ++plain) {"),
    ("no_trace", "in->step.q_low[i] = gvi__low((q.lo + bend.lo) + (in->free.path_low[i] + from->q_low[i]));", "in->step.q_low[i] = gvi__low(q.lo + bend.lo + in->free.path_low[i]);"),
    ("tangent", "in->free.path_low[i] = gvi__low(path.lo + h*v_low[i]);", "in->free.path_low[i] = gvi__low(path.lo);"),
    ("constraints queries", "in->kept = 1 + (in->kept > 0 && !gvi__nonzero(h - st->h));", "in->kept = 2;"),
    ("kicks api", "st->in.kicks.has_force = !gvi__nonzero(c[0]) && !gvi__nonzero(c[st->r - 1] - 1);", "st->in.kicks.has_force = 1;"),
    ("kicks api", "    if (status != GVI_OK) return status;\n#ifndef GVI_NO_KICKS\n    st->in.kicks.has_force = 0;", "    if (status != GVI_OK) return status;\n#ifndef GVI_NO_KICKS"),
    ("jumps", "status = gvi__newton_step(st, from, GVI__HALVED, query);", ""),
    # the clock
    ("clock", "power[k] *= g[k];", ""),
    ("clock domains", "if (force <= limit) return level;", "return level;"),
    ("clock", "F[k] -= slope[k]*gvi__sure_level(", "F[k] += 0*slope[k]*gvi__sure_level("),
    ("clock", "time->began = time->H;", ""),
    ("clock", "for (int i = 0; i < st->n; ++i) v[i] /= rate;", ""),
    ("domains", "== GVI_OK && gvi__nonzero(then - now))", "== GVI_OK && 0)"),
    # set-up
    ("api regressions", "gvi_real sum = -1, error = 0;", "gvi_real sum = 0, error = 0;"),
    ("identities order", "*order < 2*in->desc.degree - 2)", "*order < 0)"),
    ("api", "newton->pivot = gvi__take(a, 2, N + 1);", "newton->pivot = gvi__take(a, 1, N + 1);"),
    ("why", "if (d->effects && !d->effect_count)", "if (0)"),
    ("api", "    in->skip = own.skip;", ""),
    # Newton's method
    ("newton queries", "fv[j*n + i] : 0, 0);", "fv[i*n + j] : 0, 0);"),
    ("convergence", " && p->ways >= 3);", ");"),
    ("constraints", "gvi_real time = 1/(moves + falls);", "gvi_real time = 1/moves;"),
    ("convergence", "if (!small && p->ways < 4) {\n        p->left = GVI__MAX;", "if (0) {\n        p->left = GVI__MAX;"),
    ("newton jumps", "change > p->least/2, at_floor",
              "change > p->least, at_floor"),
    # queries, boundary values
    ("queries domains", "if (gvi__nonzero(back)) h = back - st->t_low;", "h = back - st->t_low;"),
    ("queries", "if (GVI_ABS(ahead) <= edge) t = st->t0;", "if (0) t = st->t0;"),
    ("boundary", "a[j] *= st->in.watch.scale[j % n];", ""),
    ("boundary", "h*in->watch.scale[i]*gvi__dot3(st->r, hb, Phi + k*R, f + i*R);", "h*gvi__dot3(st->r, hb, Phi + k*R, f + i*R);"),
    ("boundary", "if (*negative && !out->negative) return GVI_E_CONJUGATE;", ""),
    ("boundary", "if (*bent > GVI__CONTRACTS) return", "if (0) return"),
    ("boundary queries", "y[n + i] = length*in->watch.scale[i]/2;", "y[n + i] = 0*length;"),
    ("queries", "minus[i] -= lambda[row]*(by_q0 - by_y0);", "minus[i] -= lambda[row]*by_q0;"),
    # under constraints: V of the last lambda, rank that fades, rounding of g
    ("constraints", "    gvi__copy((size_t)(st->n*in->R), gvi__pushed_velocities(st, stage), in->work.V);\n", "    gvi__copy((size_t)(st->n*in->R), in->con.P, in->work.V);\n"),
    ("loops", "if (*start != GVI_OK) st->in.con.margin = GVI__FADES;", ""),
    ("resolution", "gvi_real rounding = shift ? mass[i]*shift[i]/h : 0;",
              "gvi_real rounding = 0;"),
    ("resolution", "gvi__add_force(st, z, moved);\n        gvi__over_inertia(st, moved, 1, 1);", "gvi__add_force(st, z, moved);"),
    # the dial
    ("resolution", "const gvi_real whole = fastest + farthest/h, *shift", "const gvi_real whole = fastest, *shift"),
    ("resolution", "if (at_rest || (shift && forces))\n            rounding",
              "if (0)\n            rounding"),
    ("resolution", "if (!(high > 0) || gvi__modes_end(st, i, high, low, *all)) return",
              "if (!(high > 0)) return"),
    ("resolution", "return high*gvi__smaller(lacks, 1);", "return high*lacks*gvi__power((gvi_real)0.1, st->s/2);"),
    ("resolution", "const int degree = st->s < GVI__DEEP ? st->s : GVI__DEEP;", "const int degree = st->s;"),
    ("resolution why", "if (order < 2*d->degree) return", "if (0) return"),
    ("resolution", "if (!clock && left < st->next*(gvi_real)1.0625) h = left;", ""),
    ("resolution", "if (!clock && left < h*2) h = left/2;", ""),
    ("resolution api", "st->counters.worst_resolution = gvi__larger(st->resolution, st->counters.worst_resolution);", ""),
    ("resolution", "if (left > GVI__BAND) up = ",
              "if (left > -1) up = "),
    ("resolution", "one = gvi__larger(GVI__STEADY*gvi__larger(before, fall), flat);",
              "one = GVI__STEADY*gvi__larger(before, fall);"),
    ("resolution", "scale = forces ? 1/mass[i] : mass[i];", "scale = mass[i];"),
    # verdicts
    ("tolerance", "falls = D < p->earlier && !(D > GVI__FAR*GVI__FAR);",
              "falls = D < p->earlier;"),
    ("convergence", "if (!(D*other <= limit)) return 0;", ""),
    ("tolerance", "if (!given && gvi__settled(st, p, D))",
              "if (gvi__settled(st, p, D))"),
    ("tolerance api", "if (p->earlier > 0 && D > sure*sure && D > worst*worst*worst*worst*p->earlier)",
              "if (0)"),
    ("why", "in->failed.status = status;\n        in->failed.fault = st->fault;\n        gvi__count", "gvi__count"),
    ("jumps", "end = slow ? GVI__DIVERGES : GVI__ONCE_MORE;",
              "end = GVI__ONCE_MORE + 0*slow;"),
    # constraints
    ("loops", "d[k] = drops[i] > 0 ? 0 : 1/rest;", "d[k] = drops[i] > 0 && count == 1 ? 0 : 1/rest;"),
    ("loops constraints", "if (!gvi__finite(d[k]) || (depends && !(drops[i] > 0)))", "if (!gvi__finite(d[k]))"),
    ("constraints", "/2 + GVI_ABS(middle)/2)/GVI__WRONG", "/2 + GVI_ABS(middle)/2)"),
    ("constraints body", "if (full) gvi__over_inertia(st, scratch, S, count);", ""),
    ("constraints_newton", "for (int z = modes; z < size; ++z) in->newton.dy[z] *= J->unit[z - modes];", ""),
    ("constraints_newton", "if (diagonal > 0 && column*GVI_SQRT(GVI__EPS) > diagonal)", "if (0)"),
    ("constraints", "size += GVI_ABS(G[(a*st->n + i)*S]*q[i*S]);", "size += 0*q[i*S];"),
    ("constraints loops", "if (!in->con.settled && gvi__find_columns(st, C, s + 1, in->con.G)) in->con.made = 0;", ""),
    ("loops constraints_newton", "if (!(gvi__loss(st, j, e) > GVI__LOST*GVI__LOST - 1)) continue;", "continue;"),
    ("constraints effects", "if (!(in->con.bits & (in->off ^ was))) return GVI_OK;\n    in->con.m = gvi__count_rows(in, gvi__constraints_on(st));", "if (!(in->con.bits & (in->off ^ was))) return GVI_OK;"),
    # what a start looks at
    ("mass", "gvi__zero((size_t)(x->n*x->n)*(size_t)x->stride, at.mass);", ""),
    ("why", "if (st->in.desc.mass.kind == GVI_MASS_POSITION) (void)gvi__evaluate_mass(st, at, NULL, NULL);",
              ";"),
    ("why", "if (set && !(largest > GVI__MAX/4))\n        slip", "if (0) slip"),
    ("why", "    if (unlike)\n        slip", "    if (0)\n        slip"),
    ("why newton", "if (start == GVI_E_SINGULAR || start == GVI_E_NON_FINITE) return start;", ""),
    ("constraints why", "if (status == GVI_E_SINGULAR) status = GVI_E_CONVERGENCE;", ""),
    # quadrature, time, queries
    ("structure regressions", "const gvi__two t = gvi__two_sum(st->t, in->dt + st->t_low);", "const gvi__two t = gvi__two_of(st->t + in->dt, 0);"),
    ("quadrature", "if (!(last > GVI__EPS*x.hi)) break;", "if (!(last > GVI_SQRT(GVI__EPS)*x.hi)) break;"),
    ("quadrature", "if (2*j + 1 == n) start = (gvi_real)0.5;", "if (2*j + 1 == n) start = (gvi_real)0.5*(1 - GVI__EPS);"),
    ("quadrature", "if (!(c[i] >= 0 && c[i] <= 1) || !gvi__finite(b[i])) return -1;", ""),
    ("quadrature", "size += GVI_ABS(b[i]);", "size += b[i];"),
    ("queries", "if (GVI_ABS(back) <= GVI_ABS(ahead)) {\n        from = end;", "if (0) {\n        from = end;"),
    ("queries no_trace", "    st->formulation = was;\n    if (status != GVI_OK) return gvi__done(st, status);\n    gvi_real *Q", "    if (status != GVI_OK) return gvi__done(st, status);\n    gvi_real *Q"),
    ("effects constraints why", "        in->off = was;\n        in->con.m = gvi__count_rows(in, gvi__constraints_on(st));\n", "        in->off = was;\n"),
    ("api", "if (index < 0 || index >= in->desc.effect_count)", "if (index < 0)"),
    ("clock", "time->H_low = H.lo;", "time->H_low = 0;"),
    ("resolution", "st->in.dial.put_off = st->formulation != GVI_NEWTON\n                              && ", "st->in.dial.put_off = "),
    ("resolution", "0);\n    dial->reach = at + room;", "0);\n    if (room < 2*GVI__GROWS) dial->reach = at + room;"),
    ("resolution", "for (int m = 0; m < pulled; ++m)", "for (int m = 0; m < 0; ++m)"),
    ("constraints constraints_order", "in->con.y[a - n] /= h*in->con.w[s];", "in->con.y[a - n] /= h;"),
    ("newton", "p.have = kept && !gvi__nonzero(in->newton.h - in->sized.h);", "p.have = kept;"),
    ("newton constraints_newton", "if ((J->square[k*(size + 1)] < 0) != (J->pivot[k] > (gvi_real)k)) sign = -sign;", "if (J->square[k*(size + 1)] < 0) sign = -sign;"),
    # boundary values by the dial, velocities that terms make, projection, multipliers
    ("boundary", "    status = gvi__place_accept(st);\n    in->state = state;", "    in->state = state;"),
    ("convergence", "!(gvi__parts(&st->in) && gvi__place_moves(st)),",
              "1,"),
    ("constraints", "H[i*n + j] = H[j*n + i] = H[i*n + j]/2 + H[j*n + i]/2;", "{ }"),
    ("constraints", "least = in->adds_p ? GVI__SOLVED*root : GVI_SQRT(GVI__EPS*root);", "least = GVI_SQRT(GVI__EPS*root);"),
    ("constraints", "both = gvi__larger(size, last), eps", "both = size, eps"),
    ("constraints", "if (drops[a] > 0 && GVI_ABS(slip) > GVI__HELD*GVI__EPS*terms)", "if (0)"),
    ("why", "if (unlike) wrong = a;", ""),
    # which row is left out; loss
    ("loops", "if (!(part > most)) continue;", "continue;"),
    ("loops constraints", "GVI_ABS(rest)*(GVI__LOST*GVI__LOST) < was; ++j)", "0; ++j)"),
    # starts: nothing of the last motion, looks, rows that are off
    ("api", "    gvi__zero(n, in->state.q_low);\n", ""),
    ("api", "    st->formulation = in->chosen;\n    gvi__place_started(st);", "    gvi__place_started(st);"),
    ("resolution", "st->h = st->resolution = st->next = 0;",
              "st->h = st->resolution = 0;"),
    ("resolution", "    st->in.dial.wait = st->in.dial.again = 0;\n", ""),
    ("queries boundary", "    gvi__copy(n, p, in->step.p);                   // p may be in->step.q\n    gvi__copy(n, q, in->step.q);\n",
                         "    gvi__copy(n, q, in->step.q);\n    gvi__copy(n, p, in->step.p);\n"),
    ("why", "state[i] = other ? q[i] - q[i]/32 + ahead/2 : q[i] + ahead;", "state[i] = q[i] + ahead;"),
    ("constraints", "if (!(part > 0) || (status == GVI_OK && gvi__first_non_finite(m, g) < 0)) break;", "break;"),
    ("why", "if (status == GVI_OK) in->con.checked |= gvi__constraints_on(st);",
            "if (status == GVI_OK) in->con.checked |= in->con.bits;"),
    ("constraints", "            ahead[a] -= A[a*m + l]*ahead[l];\n", ""),
    ("constraints", "if (follows && ahead[a] > 0 && doubt[a] > 0) refused = a;", "if (follows && ahead[a] > 0) refused = a;"),
    # projection: ends of steps, rank, rows that roll
    ("constraints", "size += r[a]*z[a];", "size = r[a]*z[a];"),
    ("constraints", "        in->step.p_low[i] = sum.lo;\n    }\n    return size;",
                    "        in->step.p_low[i] = 0;\n    }\n    return size;"),
    ("constraints", "if (!start && more != 0)", "if (!start && more < 0)"),
    ("constraints", "if (margin > 0) most = gvi__larger(1/root/(gvi_real)margin, GVI__FADES*st->in.con.near_start);",
                    "if (margin > 0) most = 1/root/(gvi_real)margin;"),
    ("loops", "        st->in.con.near_start = most;\n        st->in.con.margin = 1;",
              "        if (most > st->in.con.near_start) st->in.con.near_start = most;\n        st->in.con.margin = 1;"),
    ("constraints", "    if (full) gvi__zero((size_t)(n*S), scratch);\n", ""),
    ("constraints", "power *= (gvi_real)2.56;", "power *= (gvi_real)1.6;"),
    ("loops", "if ((drops[a] > 0) != (was[a] > 0)) in->newton.h = 0;", "{ }"),
    ("resolution", "(gvi_real)(degree > 1 ? 2*degree - 1 : 2)", "(gvi_real)(2*degree - 1)"),
    ("resolution", "(v - in->step.q[i]/in->sized.h)/3", "(v - in->step.q[i]/in->sized.h)/6"),
    ("resolution", "return sum*(gvi_real)s/(gvi_real)(2*s + 1);", "return sum;"),
    ("resolution", "in->dial.high[6*j] = seen > GVI__POOR ? in->dial.high[6*j]/seen : 0;", "in->dial.high[6*j] = 0;"),
    ("resolution", "if (in->dial.high) return 0;", ""),
    ("resolution", "if (!(began > 0) || high", "if (high"),
    ("loops", "c[l] -= A[(j*m + l)*S]*c[j];", "c[l] += A[(j*m + l)*S]*c[j];"),
    ("rolling", "    at->rate += effect->rows*R;\n", ""),
    ("rolling", "    if (gvi__rolls(st)) gvi__zero((size_t)(st->in.con.m*S), at.g);\n", ""),
    ("rolling", "gvi_real slip = at->rate[row*R + j];", "gvi_real slip = 0;"),
    # the measure of the dial, and its lengths
    ("resolution", "one = gvi__larger(GVI__STEADY*gvi__larger(before, fall), flat);",
              "one = gvi__larger(GVI__STEADY*fall, flat);"),
    ("resolution", "end = start + in->step.p[i];", "end = in->step.p[i];"),
    ("resolution", "v = gvi__larger(size[i]/mass[i], v);", "v = gvi__larger(size[i], v);"),
    ("resolution", "        st->in.dial.put_off = 0;\n", ""),
    ("resolution", "if (left < 0) up = gvi__larger(left - 1, -2*GVI__GROWS);", ""),
    ("resolution", "                st->t_low += st->t - t_end;\n", ""),
    ("resolution", "if (status == GVI_E_ARGUMENT || status == GVI_E_SINGULAR || tries == st->in.desc.tries",
                   "if (status == GVI_E_ARGUMENT || tries == st->in.desc.tries"),
]

# What the tests that are named do not see meets all of these.
ALL = """why resolution convergence quadrature constraints loops constraints_newton no_trace padding effects api kicks domains boundary newton mass uncoupled queries tangent control regressions
         tolerance oracle identities structure hostile jumps clock ncdp"""
SLOW = "newton clock structure theorems order jumps oracle regressions tolerance uncoupled"


def run(command, **more):
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **more).returncode


def main(build):
    text, cc = open("gvi.h").read(), os.environ.get("CC", "cc")
    room = os.path.join(build, "mutants")
    os.makedirs(room, exist_ok=True)
    tests = sorted({t for names, _, _ in MUTANTS for t in (names + " " + ALL).split()})
    for t in [t for t in tests if not os.path.exists("tests/test_%s.c" % t)]:
        print("FAILED: there is no test_%s" % t)
        tests.remove(t)
    lost = [old for _, old, _ in MUTANTS if text.count(old) != 1]
    for old in lost:
        print("FAILED: %d times in gvi.h: %s" % (text.count(old), old.replace("\n", "\\n")))
    if "--texts" in sys.argv:
        return print("mutants: %d of %d texts stand in gvi.h once" % (len(MUTANTS) - len(lost), len(MUTANTS))) or bool(lost)
    for t in tests:
        if run([cc, "-std=c99", "-O1", "-I.", "-Itests", "-Iexamples", "-DGVI_IMPLEMENTED", "-c",
                "tests/test_%s.c" % t, "-o", "%s/%s.o" % (room, t)]):
            return print("FAILED: test_%s does not compile" % t) or 1

    real = {t: "long double" if "define GVI_REAL long double" in open("tests/test_%s.c" % t).read()
            else "double" for t in tests}

    def seen(header, names):
        open(room + "/gvi.h", "w").write(header)
        made = set()
        for t in sorted(names, key=SLOW.find):       # quick ones first
            library = "%s/gvi-%s.o" % (room, real[t].split()[0])
            if real[t] not in made and run([cc, "-std=c99", "-O1", "-ffp-contract=off", "-DGVI_REAL=" + real[t],
                                            "-I" + room, "-c", "tests/compile/implementation.c", "-o", library]):
                return "does not compile"
            made.add(real[t])
            if run([cc, "%s/%s.o" % (room, t), library, "-o", room + "/test", "-lcmocka", "-lm"]):
                return "does not link"
            try:
                if run([room + "/test"], timeout=600):
                    return "seen by test_" + t
            except subprocess.TimeoutExpired:
                return "seen by test_%s, which did not end" % t
        return None

    alone = [int(k) for k in sys.argv[2:] if k.isdigit()]
    if not alone and seen(text, tests):
        return print("FAILED: gvi.h itself: " + seen(text, tests)) or 1
    survivors = 0
    for k, (names, old, new) in enumerate(MUTANTS):
        if old in lost or (alone and k not in alone):
            continue
        names = [t for t in names.split() if t in tests]
        how = seen(text.replace(old, new), names)
        if how is None:
            how = seen(text.replace(old, new), [t for t in ALL.split() if t not in names])
        if how and how.startswith("does not"):
            return print("FAILED: mutant %d %s: %s" % (k, how, old)) or 1
        survivors += how is None
        print("%2d %-28s %s" % (k, how or "SURVIVES", old.split("\n")[0].strip()[:70]), flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print("mutants: %d of %d survive; %.0f CPU minutes" % (survivors, len(alone or MUTANTS) - len(lost), (used.ru_utime + used.ru_stime)/60))
    return survivors > 1 or bool(lost)


sys.exit(main(sys.argv[1]))
