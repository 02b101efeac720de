#!/bin/sh
# instructions.sh BUILD [--record]: what fixed runs cost, against tests/data/instructions.txt.
# Points and iterations must be those recorded, with any compiler; instructions, which callgrind
# counts from the first step to the last, within 2 % either way, where the compiler is the recorded
# one.  With another one, or without valgrind, they are printed, or said to be skipped.
# --record writes the file anew.
# instructions.sh BUILD --prices: what an effect that is not listed costs.  A net in two programs: one that knows
# drag, and does not list it, and one in which there is no drag at all.  The step must take the same number of
# instructions, to 1 %, and the second program must not contain the function.  For comparison: drag listed but
# switched off, and drag at work.
build=$1 record=$2
CC=${CC:-cc}
file=tests/data/instructions.txt
dir=$build/instructions
program=$dir/instructions
mkdir -p "$dir"
fail() { echo "FAILED: instructions: $*" >&2; exit 1; }
# PROGRAM RUN: the instructions of a run from its first step to its last
collected() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=run_steps "$1" --count "$2" 2>&1 >/dev/null |
        sed -n 's/.*Collected *: *\([0-9][0-9]*\).*/\1/p'
}

if [ "$record" = --prices ]; then
    command -v valgrind >/dev/null 2>&1 || { echo 'skipped: no valgrind'; exit 0; }

    compile() { $CC -std=c99 -O2 -g -I. -Itests -DGVI_IMPLEMENTATION tests/cost/runs.c "$@" -lm || fail "compilation: $*"; }
    compile -o "$dir/drag"
    compile -DNO_DRAG -o "$dir/plain"
    for program in plain drag; do "$dir/$program" --ends | grep '^net ends' >"$dir/$program.end"; done
    cmp -s "$dir/plain.end" "$dir/drag.end" || fail "the two nets end in different places"

    instructions() {  # program run: of a step
        n=$(collected "$dir/$1" "$2") && [ "${n:-0}" -gt 0 ] || fail "$1 $2 cannot be counted"
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
    if nm "$dir/plain" | grep -q ' t net_drag$'; then fail "drag is in a program without it"; fi
    nm "$dir/drag" | grep -q ' t net_drag$' || fail "drag is not in the program that has it"
    echo "prices: 4 passed, 0 failed"
    exit
fi

# no flag but these: vector registers beyond the common ones are not known to every valgrind
$CC -std=c99 -O2 -ffp-contract=off -I. -DGVI_IMPLEMENTATION tests/cost/runs.c -o "$program" -lm || fail "compilation"
compiler=$("$program" --compiler)
"$program" --counts >"$dir/counts" || fail "a run ended early"

counted=no
command -v valgrind >/dev/null 2>&1 && counted=yes
while read -r name steps points iterations; do
    n=-
    if [ $counted = yes ]; then
        n=$(collected "$program" "$name") && [ "${n:-0}" -gt 0 ] || fail "$name under callgrind"
    fi
    echo "$name $steps $points $iterations $n"
done <"$dir/counts" >"$dir/found"

if [ "$record" = --record ]; then
    [ $counted = yes ] || fail "nothing to record without valgrind"
    {
        echo "# Made by tests/tools/instructions.sh --record: run, steps, points evaluated, iterations,"
        echo "# instructions from the first step to the last, with -O2 -ffp-contract=off and the compiler"
        echo "compiler $compiler"
        cat "$dir/found"
    } >"$file"
    cat "$file"
    exit 0
fi

recorded=$(sed -n 's/^compiler //p' "$file")
same=no
[ "$compiler" = "$recorded" ] && same=yes
awk -v same=$same -v counted=$counted '
    NR == FNR { if ($1 !~ /^(#|compiler)/) { was[$1] = $0; ++runs }; next }
    {
        ++seen
        if (!($1 in was)) { print "  " $1 ": not recorded"; bad = 1; next }
        split(was[$1], w, " ")
        exact = $2 == w[2] && $3 == w[3] && $4 == w[4]
        per = counted == "yes" ? sprintf("%.0f instructions a step", $5/$2) : "instructions not counted"
        change = counted == "yes" ? ($5/w[5] - 1)*100 : 0
        off = same == "yes" && counted == "yes" && (change > 2 || change < -2)
        note = same == "yes" && counted == "yes" ? sprintf(", %+.2f %%", change) : ""
        printf "  %-12s %8.3f points, %6.3f iterations, %s%s\n", $1, $3/$2, $4/$2, per, note
        if (!exact) printf "  %-12s recorded: %d steps, %d points, %d iterations; found: %d, %d, %d\n", "",
                           w[2], w[3], w[4], $2, $3, $4
        if (!exact || off) bad = 1
    }
    END { exit bad || seen != runs || seen == 0 }
' "$file" "$dir/found" || fail "the work has changed; if that is meant: make instructions RECORD=--record"

passed=$(awk 'END { print NR }' "$dir/found")
if [ $counted = no ]; then
    echo "  instructions skipped: no valgrind"
elif [ $same = no ]; then
    echo "  instructions not compared: recorded with $recorded, this is $compiler"
else
    passed=$((2*passed))
fi
echo "instructions: $passed passed, 0 failed"
