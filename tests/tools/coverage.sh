#!/bin/sh
# coverage.sh BUILD PROGRAM...: lines and branches of gvi.h that the test programs BUILD/tests/PROGRAM take, which are linked
# with libraries compiled with --coverage -O0, nothing inlined.  Counts of the double and of the long double library are those of
# one text, so a branch that either takes is taken.  BUILD/missing: what none takes, by line.
set -eu
build=$(cd "$1" && pwd)
shift
rm -f "$build"/*.gcda "$build"/gvi-*.gcov
for program in "$@"; do
    nice -n 15 "$build/tests/$program" >"$build/tests/$program.log" 2>&1 || echo "FAILED: $program, see $build/tests/$program.log"
done
for type in double long; do gcov -t -b -c "$build/gvi-$type.gcda" >"$build/gvi-$type.gcov"; done
awk -v missing="$build/missing" '
    function flat(text) { gsub(/^[ \t]+|[ \t]+$/, "", text); return text }
    / 0:Source:/ { ours = /gvi[.]h$/ }
    !ours { next }
    /^ *[-0-9#=*]+: *[0-9]+:/ {
        split($0, part, ":")
        line = part[2] + 0
        n = 0
        source[line] = flat(substr($0, index($0, ":") + length(part[2]) + 2))
        if (flat(part[1]) == "-" || line == 0) next
        lines[line]
        if (part[1] !~ /[#=]/) taken[line]
        next
    }
    /^branch/ {
        ++n
        key = line SUBSEP n
        branches[key]
        if ($3 == "taken" && $4 > 0) took[key]
    }
    END {
        for (l in lines) { ++all; if (l in taken) ++some; else print l ": line: " source[l] | "sort -n >" missing }
        for (k in branches) {
            ++ways
            if (k in took) { ++gone; continue }
            split(k, part, SUBSEP)
            print part[1] ": way " part[2] ": " source[part[1]] | "sort -n >" missing
        }
        printf "coverage of gvi.h: %d of %d lines, %.2f %%; %d of %d branches, %.2f %%\n", some, all, 100*some/all, gone, ways, 100*gone/ways
    }' "$build/gvi-double.gcov" "$build/gvi-long.gcov"
