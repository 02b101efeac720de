#!/bin/sh
# embedded_cost.sh BUILD: what accuracy costs on a small processor.  Builds tests/cost/embedded_count.c for
# Cortex-M4F (float) and Cortex-M3 (double in software), one image a scene and formulation, counts the
# instructions of their steps under qemu, and prints the tables of docs/embedded.md; picture in
# docs/img/cost/embedded.svg.  Fails if a sequence of known length is counted wrongly, if a count differs
# from that of an instruction trace, if states differ from this machine's by a bit, or if a step takes
# more operations than the bound allows.
build=$1
CC=${CC:-cc} CXX=${CXX:-c++} LEVEL=${LEVEL:--O2}
cross=arm-none-eabi-
dir=$build/embedded
board=examples/bare_metal
mkdir -p "$dir" docs/img/cost
rm -rf "$dir"/*
fail() { echo "FAILED: embedded_cost: $*" >&2; exit 1; }

missing=
for tool in ${cross}gcc ${cross}objdump qemu-system-arm timeout "$CXX"; do
    command -v $tool >/dev/null 2>&1 || missing="$missing $tool"
done
[ -z "$missing" ] || fail "not installed:$missing"

strict='-std=c99 -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion
        -Wshadow -Wundef -Wfloat-equal -Wvla -Werror -Itests/cost -Iexamples'
small=-DGVI_NO_CLOCK
bare="-mthumb -ffunction-sections -fdata-sections -nostartfiles -Wl,--gc-sections -T $board/mps2.ld -I$board
      -Wno-type-limits"
m4f='-mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16 -DGVI_REAL=float -DSTEPS_COUNTED=500'
m3='-mcpu=cortex-m3 -DGVI_REAL=double -DSTEPS_COUNTED=100'
# scene, formulation
images='0-POSITIONS 0-EXPLICIT 1-VELOCITIES 2-POSITIONS 2-EXPLICIT 3-MOMENTA 4-MOMENTA'

image() {  # name, scene-formulation, folder of gvi.h, flags
    name=$dir/$1.elf where=$2 header=$3
    shift 3
    ${cross}gcc $strict -I$header $bare $small -DEMBEDDED_SCENE=${where%-*} -DGVI_ONLY_${where#*-} "$@" \
        tests/cost/embedded_count.c $board/board_mps2.c $board/print.c -o "$name" -lm ||
        fail "$name: compilation"
}

# an instruction takes 1 ns
emulate() {  # name, machine, more of qemu's options
    name=$1 machine=$2
    shift 2
    timeout 300 qemu-system-arm -M "$machine" -nographic -monitor none -serial none -icount shift=0 \
        -chardev stdio,id=out -semihosting-config enable=on,target=native,chardev=out "$@" \
        -kernel "$dir/$name.elf" </dev/null 2>"$dir/$name.errors" || fail "$name in qemu: status $?"
}

# the call and what is loaded before a loop are up to 8 instructions
check_known() {
    awk '/^known/ { ++n; if ($4 - $3 < -8 || $4 - $3 > 8) { print $2 ": " $4 " instead of " $3; bad = 1 } }
         END { exit bad || !n }' "$1" >"$1.known" || fail "known sequences: $(cat "$1.known")"
}

count_all() {  # label, machine, folder of gvi.h, flags
    label=$1 machine=$2 folder=$3
    shift 3
    : >"$dir/$label.counts"
    for i in $images; do
        image "$label-$i" $i "$folder" "$@"
        emulate "$label-$i" $machine >"$dir/$label-$i.txt"
        check_known "$dir/$label-$i.txt"
        grep '^row' "$dir/$label-$i.txt" >>"$dir/$label.counts" || fail "$label-$i: no rows"
    done
}

host() {  # name, folder of gvi.h, type
    $CC $strict -O2 -I$2 -DGVI_REAL=$3 tests/cost/embedded.c -o "$dir/$1" -lm || fail "$1: compilation"
}

# An instruction trace of one setting: cycles by Arm's tables, functions; and the same count?
trace() {  # scene-formulation, index of the setting
    image trace $1 . $LEVEL $m4f -USTEPS_COUNTED -DSTEPS_COUNTED=40 -DEMBEDDED_ONE=$2
    emulate trace mps2-an386 -singlestep -d exec,nochain -D "$dir/trace.log" >"$dir/trace.txt"
    ${cross}objdump -d "$dir/trace.elf" >"$dir/trace.list"
    awk -f tests/tools/embedded_trace.awk "$dir/trace.list" "$dir/trace.txt" "$dir/trace.log" ||
        fail "trace of $1, setting $2"
    rm -f "$dir/trace.log"
}

echo 'Operations of a step, counted one by one, against the bound (float, then double):'
echo
for type in 'float 1' 'double 2'; do
    set -- $type
    $CXX -std=c++11 -O1 -U__SSE2__ -U__ARM_NEON -DREAL=$1 -DDIGITS=$2 -I. -Itests/cost \
        tests/cost/embedded_bound.cpp -o "$dir/bound-$1" || fail "embedded_bound: compilation"
    "$dir/bound-$1" || fail "the bound does not hold, $1"
done

host embedded-float . float
host embedded-double . double
count_all float mps2-an386 . $LEVEL $m4f
count_all double mps2-an385 . $LEVEL $m3
echo
echo "Cortex-M4F, float, $LEVEL"
"$dir/embedded-float" --table "$dir/float.counts" || fail "table, float"
echo
echo "Cortex-M3, double, $LEVEL"
"$dir/embedded-double" --table "$dir/double.counts" || fail "table, double"

echo
echo 'The cheapest setting (Cortex-M4F), and what gvi.h costs over a step by hand, also with a dearer force'
"$dir/embedded-float" --choice docs/img/cost/embedded.svg "$dir/float.counts" || fail "choice"

echo
echo 'The same in double (Cortex-M3)'
"$dir/embedded-double" --choice "$dir/double.svg" "$dir/double.counts" || fail "choice, double"

echo
echo 'A million steps in float'
echo
echo '| scene | setting | rounding | instructions | drift | error of q at the end |'
echo '|---|---|---|---|---|---|'
"$dir/embedded-float" --rounding "$dir/float.counts" compensated || fail "rounding"

# of RK4, carried; s = 2, N = 2; s = 3, N = 2 (their places in embedded_run.h), orbit and arm
level() {
    for i in 2-POSITIONS 3-MOMENTA; do
        image level-$i $i . $1 $m4f
        emulate level-$i mps2-an386
    done | awk -v level=$1 '$1 == "row" { mean[$2 " " $3] = $5/($4 - 3) }
        END { printf "| %s |", level
              for (s = 2; s < 4; ++s)
                  printf " %.0f | %.0f | %.0f |", mean[s " 3"], mean[s " 13"], mean[s " 19"]
              printf "\n" }'
}
echo
echo 'Instructions of a step and the level of optimisation (Cortex-M4F; orbit, then arm)'
echo
echo '| | RK4 | s = 2, N = 2 | s = 3, N = 2 | RK4 | s = 2, N = 2 | s = 3, N = 2 |'
echo '|---|---|---|---|---|---|---|'
for l in -Os -O2 -O3; do level $l; done

echo
echo 'Instructions and cycles of a step, from a trace (Cortex-M4F, no wait states)'
echo
for i in 2-POSITIONS/3 2-POSITIONS/13 2-POSITIONS/20 3-MOMENTA/3 3-MOMENTA/13 3-MOMENTA/20; do
    trace ${i%/*} ${i#*/}
done
