#!/bin/sh
# chapters.sh BUILD: gvi.h with each chapter left out, each alone on GVI_CORE, with the pairs that know of each other, with
# none, and with GVI_ONLY_EXPLICIT.  Each time (programs and symbols: not the pairs):
#   warnings   none, gcc and clang, C99 and C++11, with and without GVI_STATIC
#   scenes     tests/compile/chapters.c: those that need what is missing are refused, all others have the bits of the whole
#              header; no scene takes more memory than GVI_LENGTH says
#   programs   tests and lessons of tests/compile/chapters.txt that need nothing that is missing pass; one that says it needs a
#              chapter does not pass without it
#   symbols    none of the chapter is left
# The header that `make header` writes, without each chapter and without all: no warning, those scenes to the bit, no name of
# the chapter left (unifdef; skipped where it is not there).
# Then a chapter of its own, tests/compile/chapter.h, is plugged into a copy, in which PART I but for two lines of PARTS
# stays as it is.  The table of sizes is that of docs/embedded.md.
build=$1 dir=$1/chapters count=0
CC=${CC:-cc}
mkdir -p "$dir"
rm -rf "$dir"/*
fail() { echo "FAILED: chapters: $*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }
passed() { count=$((count + 1)); }
strict='-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla -Werror -I.'
bits='-std=c99 -ffp-contract=off -I.'
all='RULES LAGRANGIAN MOMENTA CLOCK KICKS NEWTON CONSTRAINTS OUTPUT DIAL BOUNDARY RESTORE EXPLAIN TEXTS'
# in one's text the other is named, or it is of no use without it
pairs='MOMENTA,CLOCK NEWTON,OUTPUT,BOUNDARY LAGRANGIAN,NEWTON LAGRANGIAN,MOMENTA CLOCK,LAGRANGIAN,MOMENTA CONSTRAINTS,MOMENTA
       CONSTRAINTS,KICKS CONSTRAINTS,NEWTON CONSTRAINTS,NEWTON,LAGRANGIAN,MOMENTA CLOCK,OUTPUT,MOMENTA DIAL,NEWTON'

among() { case " $2 " in *" $1 "*) return 0 ;; esac; return 1; }
closed() {  # chapters: and those that go with them
    out="$*"
    ! among MOMENTA "$out" || among CLOCK "$out" || out="$out CLOCK"
    ! among MOMENTA "$out" || ! among NEWTON "$out" || among LAGRANGIAN "$out" || out="$out LAGRANGIAN"
    ! among NEWTON "$out" && ! among OUTPUT "$out" || among BOUNDARY "$out" || out="$out BOUNDARY"
    echo $out
}
but() { for c in $all; do among $c "$*" || printf '%s ' $c; done; }

# configurations, one a line: name, flags; what is missing
{
    echo "everything||"
    for c in $all; do echo "without $c|-DGVI_NO_$c|$(closed $c)"; done
    echo "core|-DGVI_CORE|$all"
    for p in $all $pairs; do
        parts=$(echo $p | tr ',' ' ') left=$(but $parts)
        echo "core and $(echo $parts | sed 's/ /, /g')|$(for c in $left; do printf -- '-DGVI_NO_%s ' $c; done)|$(closed $left)"
    done
    echo "only explicit|-DGVI_ONLY_EXPLICIT|ITERATION $(closed RULES LAGRANGIAN MOMENTA NEWTON CONSTRAINTS DIAL)"
} >"$dir/configurations"

# ---- warnings ----

while IFS='|' read -r name flags missing; do
    for compiler in 'gcc -xc -std=c99' 'clang -xc -std=c99' 'g++ -xc++ -std=c++11' 'clang++ -xc++ -std=c++11'; do
        have ${compiler%% *} || continue
        $compiler $strict $flags -fsyntax-only tests/compile/implementation.c || fail "$name, $compiler"
        passed
    done
done <"$dir/configurations"

# ---- scenes; with GVI_STATIC, and not optimised, where gcc says most of unused functions ----

scenes() {  # name, flags, missing, type
    $CC $bits -O0 $strict $2 "-DGVI_REAL=$4" tests/compile/chapters.c -o "$dir/scenes" -lm || fail "$1, $4: scenes do not compile"
    "$dir/scenes" >"$dir/scenes.txt" 2>"$dir/memory" || fail "$1, $4: a scene takes $(cat "$dir/memory") of GVI_LENGTH"
    [ -f "$dir/wanted-$4" ] || cp "$dir/scenes.txt" "$dir/wanted-$4"
    awk -v missing="$3" '{
        split(missing, out, " ")
        name = $0; sub(/:.*/, "", name)
        for (k in out) if (" " name " " ~ " " out[k] " ") $0 = name ": refused"
        if (" " missing " " ~ / ITERATION / && name !~ / KICKS/) $0 = name ": refused"
        print }' "$dir/wanted-$4" | diff - "$dir/scenes.txt" || fail "$1, $4: scenes"
    passed
}
while IFS='|' read -r name flags missing; do
    scenes "$name" "$flags" "$missing" double
    case $name in everything | core | only*) scenes "$name" "$flags" "$missing" float ;; esac
done <"$dir/configurations"
! grep -q refused "$dir/wanted-double" || fail "a scene is refused with everything there"
[ "$(grep -c ': 0 ' "$dir/wanted-double")" -ge 25 ] || fail "scenes fail with everything there"

# ---- programs and symbols ----

grep -v '^#' tests/compile/chapters.txt >"$dir/programs"
while read -r program needs; do
    source=$(ls tests/$program.c examples/$program.c 2>/dev/null)
    $CC $bits -O0 -Itests -Iexamples -DGVI_IMPLEMENTED -w $(pkg-config --cflags cmocka 2>/dev/null) \
        -c "$source" -o "$dir/$program.o" || fail "$program does not compile"
done <"$dir/programs"

passes() {  # program
    $CC "$dir/$1.o" "$dir/gvi.o" -o "$dir/program" -lcmocka -lm 2>"$dir/link" || return 1
    case $1 in
    test_*) "$dir/program" >"$dir/out" 2>&1 ;;
    *) "$dir/program" >"$dir/out" 2>&1 && sh tests/tools/examples.sh expected "examples/$1.c" | cmp -s - "$dir/out" ;;
    esac
}
programs() {  # configuration, missing; what needs nothing has been run with the core alone
    run=0
    while read -r program needs; do
        case $1 in "core and "*) [ -n "$needs" ] || continue ;; esac
        absent=
        for c in $needs; do among $c "$2" && absent="$absent $c"; done
        if [ -z "$absent" ]; then
            passes $program || { cat "$dir/link" "$dir/out"; fail "$1: $program fails, and does not say that it needs a chapter"; }
            run=$((run + 1))
        elif [ "$1" = "without ${absent# }" ] && passes $program; then
            fail "$program says that it needs$absent, and passes without"
        fi
    done <"$dir/programs"
    passed
}

# names of functions by which a chapter is known
word() {
    case $1 in
    RULES) echo 'own_rule|make_gamma|rule_order' ;;
    LAGRANGIAN) echo 'gvi__lagrangian|legendre_newton|ty_hessian|over_hessian|factor_hessian|rows_of_A' ;;
    MOMENTA) echo 'gvi__momenta|factor_mass|mass_gradient' ;;
    CLOCK) echo 'clock' ;;
    KICKS) echo 'kick' ;;
    NEWTON) echo 'by_newton|gvi__newton' ;;
    CONSTRAINTS) echo 'constrain|project|multiplier|count_rows' ;;
    OUTPUT) echo 'state_at|action|partial_step' ;;
    DIAL) echo 'dial|advance' ;;
    BOUNDARY) echo 'boundary|discrete|start_configurations|aim|chord' ;;
    RESTORE) echo 'restore' ;;
    EXPLAIN) echo 'gvi__explain|probe|diagnose' ;;
    TEXTS) echo '_why|no_such_word' ;;
    esac
}

m4f='-mthumb -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16 -fno-math-errno -DGVI_REAL=float'
text_of() { ${2}size "$1" | awk 'NR == 2 { print $1 }'; }
: >"$dir/sizes"
while IFS='|' read -r name flags missing; do
    case $name in *,*) continue ;; esac
    $CC $bits -Os $flags -c tests/compile/implementation.c -o "$dir/gvi.o" || fail "$name does not compile"
    case $name in everything | only*) ;; *) programs "$name" "$missing" ;; esac
    for c in $missing; do
        [ $c != ITERATION ] || continue
        left=$(nm "$dir/gvi.o" | grep ' [tT] ' | grep -E "$(word $c)" | grep -vE 'gvi__place_|gvi_(why|status_text|formulation_text)$|gvi_rule_order')
        [ -z "$left" ] || fail "$name: of $c is left" $(echo "$left" | awk '{ print $NF }')
        [ "$name" != "without $c" ] || [ "$c" = TEXTS ] || nm "$dir/everything.o" | grep ' [tT] ' | grep -qE "$(word $c)" ||
            fail "$c is not known by $(word $c)"
    done
    [ "$name" != everything ] || cp "$dir/gvi.o" "$dir/everything.o"
    here=$(text_of "$dir/gvi.o") there=-
    if have arm-none-eabi-gcc; then
        arm-none-eabi-gcc $bits -Os $m4f $flags -c tests/compile/implementation.c -o "$dir/arm.o" || fail "$name, Cortex-M4F"
        there=$(text_of "$dir/arm.o" arm-none-eabi-)
    fi
    echo "$name|$there|$here|$run" >>"$dir/sizes"
done <"$dir/configurations"

# the sizes of the chapters: what goes with one, and what it adds to the core
awk -F'|' '
    function more(size, a) { return size[a] > size["core"] ? "+" size[a] - size["core"] : "" }
    { arm[$1] = $2; x86[$1] = $3; runs[$1] = $4; if ($1 ~ /^without/) { sub(/without /, "", $1); name[++n] = $1 } }
    END {
        print "| | Cortex-M4F, float | x86-64, double |"
        print "|---|---:|---:|"
        split("everything,core,only explicit", whole, ",")
        for (k = 1; k <= 3; ++k) printf "| %s | %d | %d |\n", whole[k], arm[whole[k]], x86[whole[k]]
        print "\n| chapter | Cortex-M4F: left out | alone on the core | x86-64: left out | alone on the core |"
        print "|---|---:|---:|---:|---:|"
        for (k = 1; k <= n; ++k) {
            w = "without " name[k]; a = "core and " name[k]
            printf "| `GVI_NO_%s` | -%d | %s | -%d | %s |\n", name[k], arm["everything"] - arm[w], more(arm, a),
                x86["everything"] - x86[w], more(x86, a)
        }
        printf "\nprograms that passed: %d with the core alone;", runs["core"]
        for (k = 1; k <= n; ++k) printf " %s %d+%d", name[k], runs["without " name[k]], runs["core and " name[k]]
        print " (without the chapter + with it alone)"
    }' "$dir/sizes"

# ---- headers made to order: the same scenes, with nothing defined but what tells chapters.c which calls are not there ----

made=$dir/made
mkdir -p "$made"
made_to_order() {  # chapters
    sh tests/tools/header.sh "$made/gvi.h" "$@" >"$dir/made.txt" || fail "header $*"
    without=$(sed 's/.*; without //' "$dir/made.txt") flags=
    for c in $without; do
        flags="$flags -DGVI_NO_$c"
        ! grep -nE "^ *#ifn?def GVI_NO_$c\b" "$made/gvi.h" || fail "header $*: GVI_NO_$c is still asked"
    done
    for compiler in 'gcc -xc -std=c99' 'clang -xc -std=c99' 'g++ -xc++ -std=c++11'; do
        have ${compiler%% *} || continue
        $compiler -I"$made" $(echo $strict | sed 's/-I\.//') -fsyntax-only tests/compile/implementation.c || fail "header $*, $compiler"
    done
    $CC -std=c99 -O0 -ffp-contract=off -w -I"$made" $flags tests/compile/chapters.c -o "$dir/scenes" -lm &&
        "$dir/scenes" 2>/dev/null >"$dir/scenes.txt" || fail "header $*: scenes"
    awk -v missing="$without" '{
        split(missing, out, " ")
        name = $0; sub(/:.*/, "", name)
        for (k in out) if (" " name " " ~ " " out[k] " ") $0 = name ": refused"
        print }' "$dir/wanted-double" | diff - "$dir/scenes.txt" || fail "header $*: other bits"
    passed
}
if have unifdef; then
    for c in $all 'NEWTON CONSTRAINTS' CORE; do made_to_order $c; done
else
    echo "headers made to order: skipped, unifdef is not there (make deps-header)"
fi

# ---- a chapter of one's own ----

plugged=$dir/plugged
mkdir -p "$plugged"
awk -f tests/tools/plug.awk tests/compile/chapter.h gvi.h >"$plugged/gvi.h" || fail "chapter.h finds no place"
part_1() { awk '/^\/\* =* PART II/ { exit } /^\/\* =* PART I:/ { on = 1 } on' "$1"; }
places() { awk '/^\/\* -* PARTS/ { on = 1 } /^\/\* -* SCENE/ { on = 0 } on'; }
for of in gvi.h "$plugged/gvi.h"; do
    part_1 "$of" >"$dir/part"
    places <"$dir/part" | sed '/GVI__IN_TALLY/d' >"$dir/places.$(basename "$(dirname "$of")")"
    awk '/^\/\* -* PARTS/ { off = 1 } /^\/\* -* SCENE/ { off = 0 } !off' "$dir/part" >"$dir/part.$(basename "$(dirname "$of")")"
done
[ "$(wc -l <"$dir/part..")" -gt 1500 ] && cmp "$dir/part.." "$dir/part.plugged" && cmp "$dir/places.." "$dir/places.plugged" ||
    fail "chapter.h changes PART I"
$CC -std=c99 -O1 -ffp-contract=off $(echo $strict | sed 's/-I\.//') -I"$plugged" -Itests/compile tests/compile/chapter.c -o "$dir/chapter" -lm &&
    "$dir/chapter" || fail "the chapter of chapter.h has not counted what the counters say"
$CC -std=c99 -O0 -ffp-contract=off -w -I"$plugged" -Itests/compile tests/compile/chapters.c -o "$dir/scenes" -lm &&
    "$dir/scenes" 2>/dev/null | diff "$dir/wanted-double" - || fail "chapter.h changes bits"
count=$((count + 3))
echo "chapters: $count passed, 0 failed"
