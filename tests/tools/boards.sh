#!/bin/sh
# boards.sh BUILD: gvi.h where its users compile it, each where the compiler is there:
#   Windows   a program with <windows.h> before and after, by mingw; clang's parser in the dialect of MSVC, /W4
#   boards    flash and RAM of the least program of each formulation, as one writes it and with GVI_CORE and what the scene needs;
#             on AVR the latter run by simavr: the bits are those of this machine.  A C++ sketch beside a C file.
# The table is that of docs/embedded.md.
build=$1
dir=$build/boards count=0
CC=${CC:-cc}
mkdir -p "$dir"
rm -f "$dir"/*
fail() { echo "FAILED: boards: $*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }
strict='-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I.'

if have x86_64-w64-mingw32-gcc; then
    for before in -DBEFORE -DAFTER; do
        x86_64-w64-mingw32-gcc $strict -O0 $before tests/compile/windows.c -o "$dir/windows.exe" || fail "mingw, $before"
        ! have wine || wine "$dir/windows.exe" 2>/dev/null || fail "wine, $before"
        count=$((count + 1))
    done
else echo "  skipped: no x86_64-w64-mingw32-gcc"; fi

# its own headers are not here: the five functions are given, so <math.h> is not wanted
if have clang; then
    for type in float double; do for language in TC TP; do
        clang --driver-mode=cl --target=x86_64-pc-windows-msvc /Zs /W4 /WX /$language "/DGVI_REAL=$type" \
            '/DGVI_SQRT(x)=((gvi_real)__builtin_sqrt(x))' '/DGVI_ABS(x)=((gvi_real)__builtin_fabs(x))' \
            '/DGVI_FLOOR(x)=((gvi_real)__builtin_floor(x))' '/DGVI_LDEXP(x,e)=((gvi_real)__builtin_ldexp(x,e))' \
            '/DGVI_FREXP(x,e)=((gvi_real)__builtin_frexp(x,e))' /I. tests/compile/implementation.c >"$dir/cl" 2>&1 ||
            { cat "$dir/cl"; fail "clang as cl, $language, $type"; }
        count=$((count + 1))
    done; done
else echo "  skipped: no clang"; fi

row() {  # board, flash, RAM, prefix of the tools, flags
    board=$1 flash=$2 ram=$3 prefix=$4 flags=$5
    if ! have ${prefix}gcc; then
        echo "  skipped: no ${prefix}gcc for $board"
        return
    fi
    set -- $(program 2 0)               # has all formulations, whichever is used
    plain=$1 plain_ram=$2
    for f in 1:explicit 2:positions 3:velocities 4:momenta; do
        set -- $(program ${f%:*} 1)
        [ $# = 2 ] && [ -n "$plain" ] || fail "$board, ${f#*:}"
        fits=no                         # 512 bytes of RAM at least are the stack's
        [ "$1" -gt "$flash" ] || [ $(($2 + 512)) -gt "$ram" ] || fits='with the macros'
        [ "$plain" -gt "$flash" ] || [ $((plain_ram + 512)) -gt "$ram" ] || fits=yes
        [ $f != 1:explicit ] || [ "$fits" != no ] || fail "$board: the explicit formulation does not fit, $1 and $2 bytes"
        echo "| $board | ${f#*:} | $1 | $2 | $plain | $plain_ram | $fits |"
        count=$((count + 1))
    done
}
program() {  # formulation, least: flash and RAM
    ${prefix}gcc $flags -std=c99 -Os -ffp-contract=off -fno-math-errno -ffunction-sections -fdata-sections -Wl,--gc-sections \
        -DFORMULATION=$1 -DLEAST=$2 -I. tests/compile/flash.c -o "$dir/a.elf" -lm &&
        ${prefix}size "$dir/a.elf" | awk 'NR == 2 { print $1 + $2, $2 + $3 }'
}
echo '| board | formulation | flash, with the macros | RAM | flash, plain | RAM | fits |'
room=-Wl,--defsym=__TEXT_REGION_LENGTH__=0x40000,--defsym=__DATA_REGION_LENGTH__=0x8000
arm='--specs=nano.specs -nostartfiles -Wl,-e,main'
row 'Arduino Uno (ATmega328P)' 32256 2048 avr- "-mmcu=atmega328p $room"
row 'Arduino Mega (ATmega2560)' 253952 8192 avr- "-mmcu=atmega2560 $room"
row 'Cortex-M0, 64 KB' 65536 8192 arm-none-eabi- "-mthumb -mcpu=cortex-m0 $arm"
row 'Cortex-M4F, 256 KB' 262144 65536 arm-none-eabi- "-mthumb -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16 $arm"

if have avr-gcc; then
    for f in 1:atmega328p 2:atmega2560 3:atmega2560 4:atmega2560; do
        have simavr || { echo "  skipped: no simavr"; break; }
        flags="-std=c99 -Os -ffp-contract=off -DFORMULATION=${f%:*} -DLEAST=1 -I."
        avr-gcc $flags -mmcu=${f#*:} -ffunction-sections -Wl,--gc-sections tests/compile/flash_run.c -o "$dir/run.elf" -lm &&
            $CC $flags tests/compile/flash_run.c -o "$dir/run" -lm || fail "flash_run.c, $f"
        there=$(timeout 60 simavr -m ${f#*:} -f 16000000 "$dir/run.elf" 2>&1 | grep -o '[0-9a-f]\{8\}[.!]' | head -1) here=$("$dir/run")
        [ "$there" = "$here" ] || fail "${f#*:}, formulation ${f%:*}: $there there, $here here"
        case $here in *.) ;; *) fail "formulation ${f%:*}: a step fails" ;; esac
        echo "  ${f#*:} runs formulation ${f%:*}: $there, the same bits as here"
        count=$((count + 1))
    done
    # the program of docs/embedded.md beside a C++ sketch
    if have avr-g++; then
        { sed -n 's/^    \(extern "C" .*\)/\1/p' docs/guide.md
          echo 'int main() { return pendulum_start() || pendulum_period(); }'; } >"$dir/sketch.cpp"
        avr-gcc -std=gnu11 -Os -mmcu=atmega2560 -I. -c tests/compile/embedded.c -o "$dir/pendulum.o" &&
            avr-g++ -std=gnu++11 -Os -mmcu=atmega2560 "$dir/sketch.cpp" "$dir/pendulum.o" -o "$dir/sketch.elf" -lm || fail "sketch, AVR"
        count=$((count + 1))
    fi
fi
if have arm-none-eabi-gcc; then
    arm-none-eabi-gcc -std=c99 -Os -mthumb -mcpu=cortex-m0 -Wall -Wextra -Werror -I. -c tests/compile/embedded.c -o "$dir/m0.o" &&
        printf 'int pendulum_start(void);\nint pendulum_period(void);\nint main(void) { return pendulum_start() || pendulum_period(); }\n' >"$dir/m0.c" &&
        arm-none-eabi-gcc -Os -mthumb -mcpu=cortex-m0 $arm "$dir/m0.c" "$dir/m0.o" -o "$dir/m0.elf" -lm || fail "sketch, Cortex-M0"
    count=$((count + 1))
fi
echo "boards: $count passed, 0 failed"
