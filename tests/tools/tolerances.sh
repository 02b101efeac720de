#!/bin/sh
# tolerances.sh BUILD [NAME | LINE:NUMBER ...]: each constant of gvi.h's section TOLERANCES and each number without a name that
# constants.py lists, or those given, by half and by two: iterations and Newton's iterations of the fixed runs of
# tests/cost/runs.c, in per cent of those with the constant as it is, and the tests that fail.  One for which nothing changes
# has room, and no test here.  Half an hour of CPU time.
build=$1 dir=$1/tolerances
shift
CC=${CC:-cc}
TESTS=${TESTS-constraints_newton resolution boundary}
mkdir -p "$dir"
cp gvi.h "$dir/base.h"
flags='-std=c99 -w -O1 -ffp-contract=off -Itests -Iexamples'
for t in $TESTS; do
    $CC $flags -I. -DGVI_IMPLEMENTED -c "tests/test_$t.c" -o "$dir/$t.o" || exit 1
done
$CC $flags -I. -DGVI_IMPLEMENTED -c tests/cost/runs.c -o "$dir/runs.o" || exit 1

# SED: the header so changed; prints iterations and the tests that fail
outcome() {
    sed "$1" "$dir/base.h" >"$dir/gvi.h"
    $CC $flags "-I$dir" -c tests/compile/implementation.c -o "$dir/gvi.o" 2>&1 || { echo 0 does-not-compile; return; }
    $CC "$dir/runs.o" "$dir/gvi.o" -o "$dir/runs" -lm
    "$dir/runs" --counts | awk -v runs="$runs" '{ n += $4 } END { printf "%d", n; if (NR < runs) printf " runs-that-end-early" }'
    for t in $TESTS; do
        $CC "$dir/$t.o" "$dir/gvi.o" -o "$dir/test" -lcmocka -lm
        timeout 120 "$dir/test" 2>&1 | sed -n 's/^\[  FAILED  \] \([a-z_0-9]*\)$/\1/p' | sort -u | sed 's/^/ /' | tr -d '\n'
    done
    echo
}

runs=$(grep -vc '^\(#\|compiler\)' tests/data/instructions.txt)
base=$(outcome '')
echo "as it is: $base"
[ $# -gt 0 ] || set -- $(sed -n '/- TOLERANCES$/,/- BLOCKS/s/^#define \(GVI__[A-Z_]*\) .*/\1/p' gvi.h) \
                       $(python3 tests/tools/constants.py --numbers)
for name; do
    for by in /2 '*2'; do
        case $name in
        *:*) change="${name%:*}s#\([^][A-Za-z0-9_.]\)${name#*:}\([^][A-Za-z0-9_.]\)#\1(${name#*:}$by)\2#" ;;
        *)   change="/^#define $name /{ s# *//.*##; s#^\(.define $name\) *\(.*\)#\1 ((\2)$by)#; }" ;;
        esac
        outcome "$change" >"$dir/found"
        printf '%-20s %s %s\n' "$name" "$by" "$(awk -v base="${base%% *}" '{ $1 = sprintf("%+.2f %%", 100*($1/base - 1)); print }' "$dir/found")"
    done
done
