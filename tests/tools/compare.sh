#!/bin/sh
# compare.sh OLD NEW [FLAGS]: the headers OLD/gvi.h and NEW/gvi.h (folders) side by side
#   lines, bytes; size and compile time of the object that holds the implementation
#   tests/cost/runs.c with either: time of a step and their ratio, iterations, how far apart both end
# FLAGS are -O2, or e.g. "-O3 -march=native -fno-math-errno".  Both programs run in turn, ROUNDS times (10), each run for
# MS milliseconds (10), from a new copy, since where its pages lie can change all times by 1.4; the least time of a run
# counts.  CC may be set; RUN="taskset -c 1" or the like goes before each program.
# Noise: compare.sh OLD OLD.
set -eu
[ $# -ge 2 ] || { echo "compare.sh OLD NEW [FLAGS]" >&2; exit 2; }
tools=$(cd "$(dirname "$0")" && pwd)
old=$1
new=$2
flags=${3:--O2}
CC=${CC:-cc}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
trap 'exit 1' INT TERM
printf '#define GVI_IMPLEMENTATION\n#include "gvi.h"\n' >"$dir/gvi.c"

compile="$CC -std=gnu99 -w $flags"
for which in old new; do
    [ $which = old ] && from=$old || from=$new
    seconds=$( ($compile -I"$from" -c "$dir/gvi.c" -o "$dir/$which.o" && times) | awk 'NR == 2 { split($1, t, /[ms]/); print 60*t[1] + t[2] }')
    $compile -I"$from" "$tools/../cost/runs.c" "$dir/$which.o" -o "$dir/$which" -lm
    echo "$which: $(wc -l <"$from/gvi.h") lines, $(wc -c <"$from/gvi.h") bytes, object $(size "$dir/$which.o" | awk 'NR == 2 { print $1 }') bytes, compiled in $seconds s ($CC $flags)"
done

round=0
while [ $round -lt "${ROUNDS:-10}" ]; do
    for which in old new; do
        cp "$dir/$which" "$dir/$which.$round"
        ${RUN:-} "$dir/$which.$round" "${MS:-10}" >>"$dir/$which.txt" || :
    done
    round=$((round + 1))
done
awk -F'|' '
    FNR == 1 { ++file }
    file == 1 && !($1 in seen) { seen[$1] = 1; name[++count] = $1 }
    $2 == "FAILED" { why[file, $1] = $3; next }
    !((file, $1) in best) || $2 < best[file, $1] { best[file, $1] = $2 }
    { rounds[file, $1] = $3; end[file, $1] = $4 }
    END {
        printf "%-21s %10s %10s %7s %8s %8s  %s\n", "run", "old ns", "new ns", "ratio", "old it", "new it", "apart"
        for (i = 1; i <= count; ++i) {
            r = name[i]
            if (!((1, r) in best) || !((2, r) in best) || (1, r) in why || (2, r) in why) {
                printf "%-21s FAILED: old %s, new %s\n", r, (1, r) in why ? why[1, r] : "ok", (2, r) in why ? why[2, r] : (2, r) in best ? "ok" : "did not run"
                ++failed
                continue
            }
            x = best[2, r]/best[1, r]
            sum += log(x)
            ++m
            if (x > most) { most = x; where = r }
            d = end[2, r] - end[1, r]
            if (d < 0) d = -d
            if (end[1, r] != 0) d /= end[1, r]
            printf "%-21s %10.1f %10.1f %7.2f %8.2f %8.2f  %.1e\n", r, best[1, r], best[2, r], x, rounds[1, r], rounds[2, r], d
        }
        if (m) printf "geometric mean %.3f of %d, largest %.2f (%s), failed %d\n", exp(sum/m), m, most, where, failed + 0
        exit failed > 0
    }' "$dir/old.txt" "$dir/new.txt"
