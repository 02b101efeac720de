#!/bin/sh
# size.sh BUILD [--detail]: how large gvi.h is on small machines, with GVI_REAL float and -Os:
# code and constants of gvi.h alone, what it takes of libm and libgcc, the deepest stack; then
# RAM.  Rows: every function; then gvi_init, gvi_start and gvi_step with all chapters, with none (core), with the
# explicit formulation alone, and with chapters on top of the core.  --detail: also the largest functions and the deepest
# chain of calls.
build=$1 detail=$2
CC=${CC:-cc}
dir=$build/size
mkdir -p "$dir"
rm -f "$dir"/*
fail() { echo "FAILED: size: $*"; exit 1; }
explicit='-DGVI_CORE -DGVI_ONLY_EXPLICIT'
entries='size_init size_start size_step'
cc_flags='-std=c99 -Os -fno-math-errno -ffp-contract=off -ffunction-sections -fdata-sections
          -DGVI_REAL=float -I.'

echo 'int main(void) { return 0; }' >"$dir/empty.c"
printf '#define GVI_IMPLEMENTATION\n#include "gvi.h"\n' >"$dir/everything.c"

# frames and calls as stack.awk reads them: from gcc's frames and the disassembled image, which
# also shows where a call comes last and leaves no frame of the caller ("jump")
calls_of() {  # file.su image
    tab=$(printf '\t')
    sed "s/^[^$tab]*:\([^:$tab]*\)$tab\([0-9]*\).*/frame \1 \2/; s/\.[0-9][0-9]*//g" "$1"
    ${prefix}objdump -d "$2" | awk '
        function name(text) { gsub(/[<>:]/, "", text); gsub(/\.[0-9]+/, "", text); return text }
        /^[0-9a-f]+ <.*>:$/ { f = name($2); next }
        /\t(blx\tr|blx\t[sfil]|jalr|e?icall)/ { print "call", f, "__indirect_call"; next }
        /\t(bx\tr|jr\t|e?ijmp)/ { print "jump", f, "__indirect_call"; next }
        $NF !~ /^<[^+]*>$/ { next }
        /\t(bl|r?call|jal)\t/ { print "call", f, name($NF); next }
        /\t(b[a-z]*(\.[nw])?|j|r?jmp)\t/ && name($NF) != f { print "jump", f, name($NF) }'
}

# code is measured in the image, where the linker has shortened calls
code_of() {  # object image
    { ${prefix}nm "$1"; ${prefix}nm -S -t d "$2"; } | awk '
        NF == 3 && $2 ~ /[tT]/ { own[$3] = 1 }
        NF == 4 && $3 ~ /[tT]/ && ($4 in own) { n += $2 }
        END { print n + 0 }'
}
constants_of() { ${prefix}size -A "$1" | awk '$1 ~ /^\.s?(ro)?data/ { n += $2 } END { print n + 0 }'; }
whole() { ${prefix}size "$1" | awk 'NR == 2 { print $1 + $2 }'; }

link_object() {  # object roots: an image with these functions and nothing else
    $compiler $link "$dir/empty.c" "$1.o" $(for f in $2; do echo "-Wl,-u,$f"; done) -lm -o "$1.elf"
}

stack_of() {  # object roots: bytes, under a callback, under a library function, the chain
    calls_of "$1.su" "$1.elf" >"$1.calls"
    awk -v roots="$2" -f tests/tools/stack.awk "$1.calls" >"$1.stack"
}

row() {  # name source roots flags...
    name=$1 source=$2 roots=$3
    shift 3
    object=$dir/$target-$(echo "$name" | tr -d ' ' | tr ',' '-')
    $compiler $cc_flags -fstack-usage "$@" -c "$source" -o "$object.o" ||
        fail "$target, $name: compilation"
    [ -n "$roots" ] || roots=$(${prefix}nm "$object.o" | awk '$2 == "T" { printf "%s ", $3 }')
    link_object "$object" "$roots" || fail "$target, $name: linking"
    stack_of "$object" "$roots" || fail "$target, $name: stack"
    read -r stack callback library chain <"$object.stack"
    code=$(code_of "$object.o" "$object.elf")
    constants=$(constants_of "$object.o")
    libraries=$(($(whole "$object.elf") - $(whole "$dir/$target-empty.elf") - code - constants))
    printf '  %-22s %7d %7d %10d %7d %9d %8d\n' "$name" $code $constants $libraries $stack $callback $library
    [ "$detail" = --detail ] || return 0
    echo "      deepest chain: $chain"
    echo "      largest:" $(${prefix}nm -S --size-sort -t d "$object.o" |
        awk '$3 ~ /[tT]/ { print $4, $2 + 0 }' | tail -10)
}

# all that leaves out but these chapters; a clock needs momenta
on_core() {
    for c in RULES LAGRANGIAN MOMENTA CLOCK KICKS NEWTON CONSTRAINTS OUTPUT DIAL BOUNDARY RESTORE EXPLAIN TEXTS; do
        case "$1 $c" in "$c $c" | 'CLOCK MOMENTA') ;; *) echo -DGVI_NO_$c ;; esac
    done
}

stepper() {  # flags: bytes of a gvi_stepper
    $compiler $cc_flags "$@" -c tests/tools/size.c -o "$dir/stepper.o" ||
        fail "$target: stepper"
    ${prefix}nm -S -t d "$dir/stepper.o" | awk '$NF == "size_stepper" { print $2 + 0 }'
}

table() {  # target title prefix flags link-flags
    target=$1 prefix=$3 compiler="$3gcc $4" link="-Os -Wl,--gc-sections $5"
    if ! command -v ${prefix}gcc >/dev/null 2>&1; then
        echo "$2: skipped, no ${prefix}gcc (make deps-firmware installs it)"
        return
    fi
    $compiler $link "$dir/empty.c" -o "$dir/$target-empty.elf" || fail "$target: linking"
    echo "$2, gcc $(${prefix}gcc -dumpfullversion -dumpversion), bytes"
    printf '  %-22s %7s %7s %10s %7s %9s %8s\n' '' code const libraries stack callback library
    row everything "$dir/everything.c" ''
    row 'step, all chapters' tests/tools/size.c "$entries"
    row explicit tests/tools/size.c "$entries" $explicit
    row core tests/tools/size.c "$entries" -DGVI_CORE
    for c in KICKS RULES LAGRANGIAN MOMENTA CLOCK NEWTON CONSTRAINTS DIAL; do
        row "core, $(echo $c | tr A-Z a-z)" tests/tools/size.c "$entries" $(on_core $c)
    done
    echo "$target $(stepper) $(stepper -DGVI_CORE) $(stepper $explicit -DGVI_EFFECTS=4)" >>"$dir/steppers"
}

# a scene needs as many numbers on every machine; the stepper is pointers and counters
ram() {
    $CC -std=c99 -DSIZE_SCENES -DGVI_REAL=float -I. tests/tools/size.c -o "$dir/scenes" -lm &&
        "$dir/scenes" >"$dir/scenes.txt" || fail 'scenes'
    echo 'RAM, bytes: gvi_size of a scene, in brackets the bound for any scene of that size, with all chapters;'
    echo 'then the bytes of a gvi_stepper: with all chapters, with the core, explicit with GVI_EFFECTS 4'
    awk -F'|' '{ printf "    %-36s %5d (%5d)\n", $1, 4*$2, 4*$3 }' "$dir/scenes.txt"
    while read -r target full core small; do
        echo "  $target: stepper $full, $core, $small"
    done <"$dir/steppers"
}

arm='--specs=nano.specs -nostartfiles -Wl,-e,main'
m4f='-mthumb -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16'
table m0  Cortex-M0  arm-none-eabi- '-mthumb -mcpu=cortex-m0' "$arm"
table m4f Cortex-M4F arm-none-eabi- "$m4f" "$arm"
table rv  'RISC-V 32 (rv32imc)' riscv64-unknown-elf- '-march=rv32imc -mabi=ilp32 --specs=picolibc.specs' -Wl,--defsym=__flash_size=0x40000
table avr 'AVR (ATmega1284P)' avr- -mmcu=atmega1284p -Wl,--defsym=__TEXT_REGION_LENGTH__=0x40000
[ -f "$dir/steppers" ] || fail 'no compiler for a small machine (make deps-firmware installs some)'
echo 'libraries: of libm and libgcc, arithmetic in software included'
echo 'stack: of gvi.h alone; so much of it, last columns, lies under a callback and a library function'
ram
