#!/bin/sh
# prices.sh BUILD: what an effect that is not listed costs, in instructions (valgrind's callgrind).
# A net in two programs, tests/cost/instructions.c: one that knows drag, and does not list it, and one in which
# there is no drag at all.  The step must take the same number of instructions, to 1 %, and the second program
# must not contain the function.  For comparison: drag listed but switched off, and drag at work.
dir=$1/prices
CC=${CC:-cc}
mkdir -p "$dir"
fail() { echo "FAILED: prices: $*"; exit 1; }
command -v valgrind >/dev/null 2>&1 || { echo 'skipped: no valgrind'; exit 0; }

compile() { $CC -std=c99 -O2 -g -I. -Itests tests/cost/instructions.c "$@" -lm || fail "compilation: $*"; }
compile -o "$dir/drag"
compile -DNO_DRAG -o "$dir/plain"
for program in plain drag; do "$dir/$program" --ends | grep '^net ends' >"$dir/$program.end"; done
cmp -s "$dir/plain.end" "$dir/drag.end" || fail "the two nets end in different places"

instructions() {  # program run: of a step
    n=$(sh tests/tools/collected.sh "$dir/$1" "$2") && [ "${n:-0}" -gt 0 ] || fail "$1 $2 cannot be counted"
    echo $((n/100))
}
plain=$(instructions plain net) && unlisted=$(instructions drag net) && off=$(instructions drag net-off) &&
    at_work=$(instructions drag net-drag) || { echo "$plain $unlisted $off $at_work"; exit 1; }
printf '  instructions a step of a net of %s knots\n' 16
printf '    %-36s %9d\n' 'no drag in the program' "$plain" 'drag in the program, not listed' "$unlisted" \
    'drag listed, switched off' "$off" 'drag at work' "$at_work"

more=$((unlisted - plain))
[ ${more#-} -le $((plain/100)) ] || fail "drag that is not listed costs $more instructions of $plain"
[ "$at_work" -gt $((plain + plain/100)) ] || fail "drag at work costs nothing: this test sees nothing"
if nm "$dir/plain" | grep -q ' t drag$'; then fail "drag is in a program without it"; fi
nm "$dir/drag" | grep -q ' t drag$' || fail "drag is not in the program that has it"
echo "prices: 4 passed, 0 failed"
