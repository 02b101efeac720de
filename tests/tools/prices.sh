#!/bin/sh
# prices.sh BUILD: what an effect that is not listed costs, in instructions (valgrind's callgrind).
# A net in two builds: one that knows drag, and does not list it, and one in which there is no drag
# at all.  The step must take the same number of instructions, to 1 %, and the second build must
# not contain the function.  For comparison: drag listed but switched off, and drag at work.
build=$1
CC=${CC:-cc}
dir=$build/prices
mkdir -p "$dir"
fail() { echo "FAILED: prices: $*"; exit 1; }

if ! command -v valgrind >/dev/null 2>&1; then
    echo 'skipped: no valgrind'
    exit 0
fi

cat >"$dir/net.c" <<'END'
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 4, KNOTS = SIDE*SIDE, N = 3*KNOTS };

static void pull(const gvi_points *x, int a, int b)
{
    const int d = x->stride;
    const double *p = x->q + 3*a*d, *q = x->q + 3*b*d;
    double *f = x->f + 3*a*d, *g = x->f + 3*b*d;
    for (int k = 0; k < x->count; ++k) {
        double u = q[k] - p[k], v = q[d+k] - p[d+k], w = q[2*d+k] - p[2*d+k];
        double s = 40*(1 - 0.09/sqrt(u*u + v*v + w*w));
        f[k] += s*u;  f[d+k] += s*v;  f[2*d+k] += s*w;
        g[k] -= s*u;  g[d+k] -= s*v;  g[2*d+k] -= s*w;
    }
}

static int springs(const gvi_points *x, void *user)
{
    for (int i = 0; i < KNOTS; ++i) {
        if (i % SIDE < SIDE - 1) pull(x, i, i + 1);
        if (i/SIDE < SIDE - 1) pull(x, i, i + SIDE);
    }
    return (void)user, 0;
}

static int weight(const gvi_points *x, void *user)
{
    for (int i = 0; i < KNOTS; ++i)
        for (int k = 0; k < x->count; ++k) x->f[(3*i+2)*x->stride + k] -= 9.81*0.005;
    return (void)user, 0;
}

#ifdef DRAG
static int drag(const gvi_points *x, void *user)
{
    for (int i = 0; i < N; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= 0.01*x->v[i*x->stride + k];
    return (void)user, 0;
}
#endif

int main(int argc, char **argv)
{
    static double mass[N], q[N], v[N];
    static const gvi_effect effects[] = {
        { .kind = GVI_POTENTIAL, .points = springs }, { .kind = GVI_POTENTIAL, .points = weight },
#ifdef DRAG
        { .kind = GVI_FORCE, .points = drag },
#endif
    };
    const long steps = argc > 1 ? atol(argv[1]) : 0, listed = argc > 2 ? atol(argv[2]) : 2;
    const int off = argc > 3;
    gvi_desc desc = { .n = N, .degree = 6, .effects = effects, .effect_count = (int)listed,
                      .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
    gvi_stepper st;
    for (int i = 0; i < N; ++i) {
        mass[i] = 0.005;
        q[i] = i % 3 == 2 ? 0.02*(i % 7) : 0.1*(i % 3 ? i/3/SIDE : i/3 % SIDE);
    }
    double *memory = malloc(gvi_size(&desc));
    gvi_init(&st, &desc, memory, gvi_size(&desc));
    if (off) gvi_switch(&st, 2, 0);
    gvi_start(&st, 0, q, v);
    for (long k = 0; k < steps && st.status == GVI_OK; ++k) gvi_step(&st, 0.005);
    printf("%d %.17g\n", (int)st.status, st.q[N-1]);
    return st.status != GVI_OK;
}
END
$CC -std=c99 -O2 -I. "$dir/net.c" -o "$dir/plain" -lm || fail "the plain net does not compile"
$CC -std=c99 -O2 -I. -DDRAG "$dir/net.c" -o "$dir/drag" -lm || fail "the net with drag does not compile"
$CC -std=c99 -O2 -g -I. -c "$dir/net.c" -o "$dir/plain.o" || fail "the plain net does not compile"

# count PROGRAM ARGUMENTS: instructions of 100 steps
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$@" 2>&1 >"$dir/out" |
        sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}
count() {
    program=$1
    shift
    many=$(instructions "$program" 110 "$@")
    cp "$dir/out" "$dir/result.$(basename "$program")$#"
    few=$(instructions "$program" 10 "$@")
    [ -n "$many" ] && [ -n "$few" ] && [ "$many" -gt "$few" ] || fail "$program cannot be counted"
    echo $(((many - few)/100))
}

plain=$(count "$dir/plain" 2) || { echo "$plain"; exit 1; }
unlisted=$(count "$dir/drag" 2) || { echo "$unlisted"; exit 1; }
cmp -s "$dir/result.plain1" "$dir/result.drag1" || fail "the two nets end in different places"
off=$(count "$dir/drag" 3 off) || { echo "$off"; exit 1; }
at_work=$(count "$dir/drag" 3) || { echo "$at_work"; exit 1; }
printf '  instructions a step of a net of %s knots\n' 16
printf '    %-36s %9d\n' 'no drag in the program' "$plain" 'drag in the program, not listed' "$unlisted" \
    'drag listed, switched off' "$off" 'drag at work' "$at_work"

more=$((unlisted - plain))
[ ${more#-} -le $((plain/100)) ] || fail "drag that is not listed costs $more instructions of $plain"
[ "$at_work" -gt $((plain + plain/100)) ] || fail "drag at work costs nothing: this test sees nothing"
if nm "$dir/plain.o" | grep -i -q drag; then fail "drag is in a program without it"; fi
nm "$dir/drag" | grep -q ' t drag$' || fail "drag is not in the program that has it"
printf '  unlisted drag: %+d of %d instructions a step\n' "$more" "$plain"
echo "prices: 4 passed, 0 failed"
