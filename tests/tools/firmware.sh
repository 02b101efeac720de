#!/bin/sh
# firmware.sh BUILD: the programs of examples/bare_metal as images without an operating
# system for Cortex-M4F (float, hardware) and Cortex-M3 (double, in software), built without
# a warning, run in qemu-system-arm, and compared with the same programs on this machine:
# to the bit where both take their sine from sine_own.c, and within rounding (firmware.awk)
# where each has that of its C library.
build=$1
CC=${CC:-cc}
cross=arm-none-eabi-
source=examples/bare_metal
dir=$build/firmware
mkdir -p "$dir"
rm -f "$dir"/*
fail() { echo "FAILED: firmware: $*"; exit 1; }
count=0

missing=
for tool in ${cross}gcc ${cross}nm ${cross}size qemu-system-arm timeout; do
    command -v $tool >/dev/null 2>&1 || missing="$missing $tool"
done
if [ -n "$missing" ]; then echo "skipped: not installed:$missing (make deps-firmware installs them)"; exit 0; fi
echo '#include <math.h>' | ${cross}gcc -fsyntax-only -xc - 2>/dev/null ||
    fail "${cross}gcc has no C library (make deps-firmware installs newlib)"

warnings='-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla'
strict="-std=c99 -ffp-contract=off $warnings -Werror -I."
bare="-mthumb -Os -fno-math-errno -ffunction-sections -fdata-sections --specs=nano.specs
      -nostartfiles -Wl,--gc-sections -T $source/mps2.ld"
flags_m4f='-mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16'
flags_m3='-mcpu=cortex-m3'
unwanted='^_*(malloc|calloc|realloc|free|sbrk|v?s?n?i?printf|puts|putc|fwrite|write|exit)(_r)?$'

# -O0: compiled in a third of the time, and the same bits
on_host() {  # program type: with both sines
    $CC $strict -O0 -DGVI_REAL=$2 -c $source/$1.c -o "$dir/$1.o" || fail "$1 for this machine, $2"
    for sine in own libm; do
        $CC $strict -DGVI_REAL=$2 "$dir/$1.o" $source/print.c $source/sine_$sine.c $source/board_host.c -o "$dir/$1-$sine-$2" -lm &&
            "$dir/$1-$sine-$2" >"$dir/$1-$sine-$2.txt" || fail "$1 on this machine, $2: status $?"
    done
}

build_image() {  # program sine target type: no warning, no heap, no stdio
    eval flags=\$flags_$3
    object=$dir/$1-$3.o
    [ -f "$object" ] || ${cross}gcc $strict $flags $bare -DGVI_REAL=$4 -c $source/$1.c -o "$object" || fail "$object: compilation"
    ${cross}gcc $strict $flags $bare -DGVI_REAL=$4 "$object" $source/print.c $source/sine_$2.c $source/board_mps2.c \
        -o "$image.elf" -lm || fail "$image.elf: compilation"
    out=$(${cross}nm "$image.elf" | awk -v unwanted="$unwanted" '$NF ~ unwanted { print $NF }')
    [ -z "$out" ] || fail "$image.elf: linked with $(echo $out)"
    count=$((count + 1))
}

# an instruction takes 16 ns, time without work is skipped: the same on every machine
run_image() {  # machine
    timeout 100 qemu-system-arm -M "$1" -nographic -monitor none -serial none \
        -icount shift=4,sleep=off -chardev stdio,id=out \
        -semihosting-config enable=on,target=native,chardev=out \
        -kernel "$image.elf" </dev/null >"$image.log" 2>"$image.errors" ||
        fail "$image.elf in qemu: status $?, see $image.log and $image.errors"
    grep -v '^board:' "$image.log" >"$image.txt"
    late=$(grep 'missed: [^0]' "$image.log") && fail "$image.elf: $late"
    count=$((count + 1))
}

board() { sed -n "s/^board: $1: //p" "$image.log"; }

print_image() {
    ${cross}size "$image.elf" | awk -v name="$(basename "$image")" -v stack="$(board 'bytes of stack used')" \
        -v ticks="$(board 'ticks of the busiest period')" 'NR == 2 {
            busy = ticks == "" ? "" : int(ticks*40/16)
            printf "  %-18s %7d %6d %6d   %s\n", name, $1 + $2, $2 + $3 - 4096, stack, busy }'
}

compare() {  # program target type
    here=$dir/$1 eps=1.1920928955078125e-07
    [ $3 = double ] && eps=2.220446049250313e-16
    cmp -s "$here-own-$2.txt" "$here-own-$3.txt" ||
        fail "$1: $2 and this machine differ with the same sine:" \
             "$(diff "$here-own-$2.txt" "$here-own-$3.txt" | head -3)"
    differences=$(awk -v eps=$eps -f tests/tools/firmware.awk "$here-libm-$2.txt" "$here-libm-$3.txt" \
        "$here-libm-float.txt" "$here-libm-double.txt") ||
        fail "$1: $2 and this machine differ by more than rounding, in eps (allowed): $differences"
    echo "    same sine: same bits; sines of two libraries, in eps (allowed):$differences"
    count=$((count + 2))
}

# flash and RAM with start-up code, printing and libm; RAM without the stack, whose use was measured
printf '  %-18s %7s %6s %6s   %s\n' '' flash RAM stack 'instructions of the busiest period'
for program in pendulum arm rods; do
    for type in float double; do on_host $program $type; done
    for target in 'm4f float mps2-an386' 'm3 double mps2-an385'; do
        set -- $target
        for sine in own libm; do
            image=$dir/$program-$sine-$1
            build_image $program $sine $1 $2
            run_image $3
            print_image
        done
        compare $program $1 $2
    done
done
echo "firmware: $count passed, 0 failed"
