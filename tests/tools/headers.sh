#!/bin/sh
# headers.sh BUILD [--quick]: gvi.h compiled without a single warning by every compiler
# that is there, in every standard, type and linkage; then the programs of
# tests/compile, which link several translation units; then the studies; then what must be refused.
build=$1 quick=$2
dir=$build/headers
mkdir -p "$dir"
rm -f "$dir"/*

strict='-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla -Werror -I.'
# everything that clang warns of, less the style of this code: declarations where they are needed, casts of C, commas, NULL
everything='-Weverything -Wno-padded -Wno-comma -Wno-conditional-uninitialized -Wno-covered-switch-default
 -Wno-declaration-after-statement -Wno-c++98-compat-pedantic -Wno-old-style-cast -Wno-reserved-identifier
 -Wno-reserved-macro-identifier -Wno-zero-as-null-pointer-constant -Wno-unsafe-buffer-usage -Wno-pre-c11-compat
 -Wno-switch-default -Wno-unknown-warning-option'
everything=$(echo $everything)
have() { command -v "$1" >/dev/null 2>&1; }
fail() { echo "FAILED: headers: $*"; exit 1; }
accepts() { echo 'int main(void) { return 0; }' | $1 -x$2 -std=$3 -fsyntax-only - 2>/dev/null; }

# the matrix: -O0 for all standards, -O2 for the first and, extern, the last, -O1 for the first in double alone
matrix() {  # compiler language standards...
    compiler=$1 language=$2
    shift 2
    for standard in "$@"; do
        if ! accepts "$compiler" "$language" "$standard"; then
            echo "  skipped: $compiler does not know $standard" >&2
            continue
        fi
        case $standard in c99|c2x|c++11|c++20) levels='-O0 -O1 -O2' ;; *) levels=-O0 ;; esac
        for level in $levels; do for type in float double 'long double'; do for linkage in extern static; do
            static=; [ $linkage = static ] && static=-DGVI_STATIC
            case $level$standard$linkage in -O2c2xstatic|-O2c++20static) continue ;; esac
            [ $level = -O1 ] && case $standard$type$linkage in c99doubleextern|c++11doubleextern) ;; *) continue ;; esac
            echo "$compiler -x$language -std=$standard $level $static $strict \"-DGVI_REAL=$type\" -c tests/compile/implementation.c -o /dev/null"
            [ $level = -O0 ] && [ $linkage = extern ] &&
                echo "$compiler -x$language -std=$standard $level $strict \"-DGVI_REAL=$type\" -c tests/compile/declarations.c -o /dev/null"
        done; done; done
        case $standard in c99|c++11) echo "$compiler -x$language -std=$standard $strict -c tests/compile/macros.c -o /dev/null" ;; esac
    done
    case $compiler in clang*) echo "$compiler -x$language -std=$1 $everything -Werror -I. -c tests/compile/implementation.c -o /dev/null" ;; esac
}
if [ "$quick" = --quick ]; then       # one compiler, in C and C++, each type once
    first=${CC:-cc} second=${CXX:-c++}
    for type in float double 'long double'; do
        echo "$first -std=c99 -O0 $strict \"-DGVI_REAL=$type\" -c tests/compile/implementation.c -o /dev/null"
        echo "$first -std=c99 -O0 $strict \"-DGVI_REAL=$type\" -c tests/compile/declarations.c -o /dev/null"
        ! have "$second" || echo "$second -xc++ -std=c++11 -O0 -DGVI_STATIC $strict \"-DGVI_REAL=$type\" -c tests/compile/implementation.c -o /dev/null"
    done
    have "$second" || echo "  skipped: no $second" >&2
    echo "$first -std=c99 $strict -c tests/compile/macros.c -o /dev/null"
else
    for compiler in gcc clang; do
        if have $compiler; then matrix $compiler c c99 c11 c17 c2x
        else echo "  skipped: no $compiler" >&2; fi
    done
    for compiler in g++ clang++; do
        if have $compiler; then matrix $compiler c++ c++11 c++14 c++17 c++20
        else echo "  skipped: no $compiler" >&2; fi
    done
    if ! have gcc && ! have clang; then matrix cc c c99 c11 c17; fi
    if have x86_64-w64-mingw32-gcc; then matrix x86_64-w64-mingw32-gcc c c99
    else echo "  skipped: no x86_64-w64-mingw32-gcc" >&2; fi
fi >"$dir/matrix"
jobs=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
tr '\n' '\0' <"$dir/matrix" |
    xargs -0 -n 1 -P "$jobs" sh -c 'out=$(eval "$1" 2>&1) || { echo "$1"; echo "$out"; exit 255; }' sh ||
    fail "the command above"
count=$(wc -l <"$dir/matrix")
printf '  %-28s %3d clean\n' 'compilations' "$count"

# several translation units
compilers='gcc clang' pairs='gcc,g++ clang,clang++'
[ "$quick" != --quick ] || compilers=${CC:-cc} pairs=
for compiler in $compilers; do
    have $compiler || continue
    cc="$compiler -std=c99 $strict"
    for type in float double 'long double'; do
        $cc "-DGVI_REAL=$type" tests/compile/units_main.c tests/compile/units_other.c tests/compile/implementation.c \
            -o "$dir/units" -lm && "$dir/units" || fail "$compiler: two units that share one implementation, $type"
        count=$((count + 1))
    done
    $cc tests/compile/static_main.c tests/compile/static_float.c tests/compile/static_double.c \
        -o "$dir/static" -lm && "$dir/static" || fail "$compiler: float and double in one program"
    for page in guide embedded; do
        $cc -c tests/compile/$page.c -o /dev/null || fail "$compiler: tests/compile/$page.c"
    done
    count=$((count + 3))
done
for pair in $pairs; do
    set -- ${pair%,*} ${pair#*,}
    have $1 && have $2 || continue
    $1 -std=c99 $strict -c tests/compile/implementation.c -o "$dir/implementation.o" &&
    $2 -std=c++11 -xc++ $strict -c tests/compile/units_main.c -o "$dir/units_main.o" &&
    $2 -std=c++11 -xc++ $strict -c tests/compile/units_other.c -o "$dir/units_other.o" &&
    $2 "$dir"/units_main.o "$dir"/units_other.o "$dir"/implementation.o -o "$dir/mixed" -lm && "$dir/mixed" ||
        fail "$2: C++ units with an implementation in C"
    count=$((count + 1))
done

if [ "$quick" != --quick ]; then
# the studies, which no test runs: they have to compile all the same; not what includes a board
for file in tests/cost/*.c tests/hard/*.c tests/theorems/*.c; do
    grep -q '^#include "board.h"' $file && continue
    ${CC:-cc} -std=c99 -fsyntax-only -I. -Itests -Iexamples $file || fail "$file"
    count=$((count + 1))
done

fi
# what must be refused, with a sentence that says why
refused() {  # sentence flags...
    sentence=$1
    shift
    if out=$(${first} -std=c99 -I. "$@" -c tests/compile/implementation.c -o /dev/null 2>&1); then
        fail "$* was accepted"
    fi
    echo "$out" | grep -q "$sentence" || fail "$*: the message is not \"$sentence\""
    count=$((count + 1))
}
for first in gcc clang cc; do have $first && break; done
refused 'GVI_REAL must be' -DGVI_REAL=int
refused 'fast-math' -O2 -ffast-math

# the parts of fast-math, each alone: refused, or the same bits as without
unsafe=$(mktemp -d)
for first in gcc clang; do
    have $first || continue
    bits() { $first -std=c99 -O2 -ffp-contract=off -I. "$@" tests/compile/unsafe.c -o "$unsafe/run" -lm 2>/dev/null && "$unsafe/run"; }
    plain=$(bits)
    for flags in -funsafe-math-optimizations -freciprocal-math '-fassociative-math -fno-signed-zeros -fno-trapping-math' \
                 -fno-signed-zeros -ffinite-math-only; do
        out=$(bits $flags) || { refused 'fast-math' $flags; continue; }
        [ "$out" = "$plain" ] || fail "$first $flags changes bits"
        count=$((count + 1))
    done
done
rm -r "$unsafe"

echo "headers: $count passed, 0 failed"
