#!/bin/sh
# embedded_cost.sh BUILD: what accuracy costs on a small processor.  Builds tests/cost/embedded_count.c for
# Cortex-M4F (float) and Cortex-M3 (double in software), one image a scene and formulation, counts the
# instructions of their steps under qemu, and prints the tables of docs/embedded.md.  Fails if a sequence of known
# length is counted wrongly, or if states differ from this machine's by a bit.
build=$1
CC=${CC:-cc} LEVEL=${LEVEL:--O2}
cross=arm-none-eabi-
dir=$build/embedded
board=examples/bare_metal
mkdir -p "$dir"
rm -rf "$dir"/*
fail() { echo "FAILED: embedded_cost: $*" >&2; exit 1; }

missing=
for tool in ${cross}gcc qemu-system-arm timeout; do
    command -v $tool >/dev/null 2>&1 || missing="$missing $tool"
done
[ -z "$missing" ] || fail "not installed:$missing"

strict='-std=c99 -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion
        -Wshadow -Wundef -Wfloat-equal -Wvla -Werror -Itests/cost -Iexamples'
bare="-mthumb -ffunction-sections -fdata-sections -nostartfiles -Wl,--gc-sections -T $board/mps2.ld -I$board
      -Wno-type-limits"
m4f='-mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16 -DGVI_REAL=float -DSTEPS_COUNTED=500'
m3='-mcpu=cortex-m3 -DGVI_REAL=double -DSTEPS_COUNTED=100'
# scene, formulation
images='0-POSITIONS 0-EXPLICIT 1-VELOCITIES 2-POSITIONS 2-EXPLICIT 3-MOMENTA 4-MOMENTA'

chapters() {  # formulation: what is compiled
    case $1 in
    EXPLICIT) echo -DGVI_CORE -DGVI_ONLY_EXPLICIT ;;
    MOMENTA) for c in RULES LAGRANGIAN CLOCK KICKS NEWTON CONSTRAINTS OUTPUT DIAL RESTORE EXPLAIN TEXTS; do echo -DGVI_NO_$c; done ;;
    *) echo -DGVI_CORE ;;
    esac
}

# NAME SCENE-FORMULATION MACHINE FLAGS: an instruction takes 1 ns; the call and what is loaded before a loop of
# known length are up to 8 instructions
count() {
    name=$1 where=$2 machine=$3
    shift 3
    ${cross}gcc $strict -I. $bare $(chapters ${where#*-}) -DEMBEDDED_SCENE=${where%-*} "$@" \
        tests/cost/embedded_count.c $board/board_mps2.c $board/print.c -o "$dir/$name.elf" -lm ||
        fail "$name: compilation"
    timeout 300 qemu-system-arm -M "$machine" -nographic -monitor none -serial none -icount shift=0 \
        -chardev stdio,id=out -semihosting-config enable=on,target=native,chardev=out \
        -kernel "$dir/$name.elf" </dev/null >"$dir/$name.txt" 2>"$dir/$name.errors" || fail "$name in qemu: status $?"
    awk '/^known/ { ++n; if ($4 - $3 < -8 || $4 - $3 > 8) { print $2 ": " $4 " instead of " $3; bad = 1 } }
         END { exit bad || !n }' "$dir/$name.txt" >"$dir/$name.known" || fail "known sequences: $(cat "$dir/$name.known")"
    grep '^row' "$dir/$name.txt" >>"$dir/${name%%-*}.counts" || fail "$name: no rows"
}

for table in 'float mps2-an386 Cortex-M4F' 'double mps2-an385 Cortex-M3'; do
    set -- $table
    [ $1 = float ] && flags=$m4f || flags=$m3
    $CC $strict -O2 -I. -DGVI_REAL=$1 tests/cost/embedded.c -o "$dir/$1" -lm || fail "$1: compilation"
    : >"$dir/$1.counts"
    for i in $images; do count $1-$i $i $2 $LEVEL $flags; done
    printf '\n%s, %s, %s\n' $3 $1 "$LEVEL"
    "$dir/$1" "$dir/$1.counts" || fail "$1"
done
