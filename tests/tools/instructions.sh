#!/bin/sh
# instructions.sh BUILD [--record]: what fixed runs cost, against tests/data/instructions.txt.
# Points and iterations must be those recorded, with any compiler; instructions, which callgrind
# counts from the first step to the last, within 2 % either way, where the compiler is the recorded
# one.  With another one, or without valgrind, they are printed, or said to be skipped.
# --record writes the file anew.
build=$1 record=$2
CC=${CC:-cc}
file=tests/data/instructions.txt
dir=$build/instructions
program=$dir/instructions
mkdir -p "$dir"
fail() { echo "FAILED: instructions: $*" >&2; exit 1; }

# no flag but these: vector registers beyond the common ones are not known to every valgrind
$CC -std=c99 -O2 -ffp-contract=off -I. tests/cost/instructions.c -o "$program" -lm || fail "compilation"
compiler=$("$program" --compiler)
"$program" --counts >"$dir/counts" || fail "a run ended early"

counted=no
command -v valgrind >/dev/null 2>&1 && counted=yes
while read -r name steps points iterations; do
    n=-
    if [ $counted = yes ]; then
        n=$(sh tests/tools/collected.sh "$program" "$name") && [ "${n:-0}" -gt 0 ] || fail "$name under callgrind"
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
