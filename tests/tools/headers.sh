#!/bin/sh
# headers.sh BUILD [--quick FLOAT DOUBLE LONG]: gvi.h compiled without a single warning by every compiler that is there; then the
# programs of tests/compile, which link several translation units; then the studies; then what must be refused.
build=$1 quick=$2
[ $# -lt 2 ] || shift 2
objects=$*
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

# Every pair of standard, type and linkage.  Front ends warn without generating code; what gcc sees only in the flow
# of data needs -O1 and -O2, once a type; what it says of unused functions, -O0.
command_line() {  # compiler language standard, flags, type, file
    echo "$1 -x$2 -std=$3 $4 $strict \"-DGVI_REAL=$5\" -c tests/compile/$6.c -o /dev/null"
}
matrix() {  # compiler language standards...
    compiler=$1 language=$2 even=
    shift 2
    for standard in "$@"; do
        if ! accepts "$compiler" "$language" "$standard"; then
            echo "  skipped: $compiler does not know $standard" >&2
            continue
        fi
        for type in float double 'long double'; do
            [ -n "$even" ] && even= || even=-DGVI_STATIC
            command_line "$compiler" "$language" "$standard" "-fsyntax-only $even" "$type" implementation
            command_line "$compiler" "$language" "$standard" -fsyntax-only "$type" declarations
        done
    done
    command_line "$compiler" "$language" "$1" -fsyntax-only double macros
    case $compiler in
    clang*) echo "$compiler -x$language -std=$1 -fsyntax-only $everything -Werror -I. -c tests/compile/implementation.c" ;;
    gcc) for type in float double 'long double'; do command_line gcc c c99 -O2 "$type" implementation; done
         command_line gcc c c99 '-O1 -DGVI_STATIC' double implementation ;;
    g++) command_line g++ c++ c++11 -O2 double implementation
         command_line g++ c++ c++20 '-O0 -DGVI_STATIC' float implementation ;;
    x86*) command_line "$compiler" c c99 -O1 'long double' implementation ;;
    esac
}
if [ "$quick" = --quick ]; then       # one compiler, in C and C++, each type once
    first=${CC:-cc} second=${CXX:-c++}
    for type in float double 'long double'; do
        command_line "$first" c c99 -fsyntax-only "$type" implementation
        command_line "$first" c c99 -fsyntax-only "$type" declarations
        ! have "$second" || command_line "$second" c++ c++11 '-fsyntax-only -DGVI_STATIC' "$type" implementation
    done
    have "$second" || echo "  skipped: no $second" >&2
    command_line "$first" c c99 -fsyntax-only double macros
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
compilers='gcc clang' pairs='gcc,g++ clang,clang++' syntax=
[ "$quick" != --quick ] || compilers=${CC:-cc} pairs= syntax=-fsyntax-only
for compiler in $compilers; do
    have $compiler || continue
    cc="$compiler -std=c99 $strict"
    for type in float double 'long double'; do
        implementation=tests/compile/implementation.c
        [ "$quick" != --quick ] || implementation=${objects%% *} objects=${objects#* }
        $cc "-DGVI_REAL=$type" tests/compile/units_main.c tests/compile/units_other.c $implementation \
            -o "$dir/units" -lm && "$dir/units" || fail "$compiler: two units that share one implementation, $type"
        count=$((count + 1))
    done
    for type in float double; do
        $cc -DCOPY=$type -c tests/compile/static_copy.c -o "$dir/$type.o" || fail "$compiler: static_copy.c, $type"
    done
    $cc tests/compile/static_main.c "$dir/float.o" "$dir/double.o" -o "$dir/static" -lm && "$dir/static" ||
        fail "$compiler: float and double in one program"
    for page in guide embedded; do
        $cc $syntax -c tests/compile/$page.c -o /dev/null || fail "$compiler: tests/compile/$page.c"
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
# the studies, which no test runs: they have to compile all the same; not what includes a board or REBOUND
for file in tests/cost/*.c tests/hard/*.c tests/theorems/*.c; do
    grep -q '^#include "\(board\|rebound\).h"' $file && continue
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

# the parts of fast-math: each is refused, or all that are not give the same bits as none
[ "$quick" = --quick ] || for first in gcc clang; do
    have $first || continue
    taken=
    for flags in -funsafe-math-optimizations -freciprocal-math '-fassociative-math -fno-signed-zeros -fno-trapping-math' \
                 -fno-signed-zeros -ffinite-math-only; do
        if $first -std=c99 -I. $flags -fsyntax-only tests/compile/unsafe.c 2>/dev/null; then taken="$taken $flags"
        else refused 'fast-math' $flags; fi
    done
    for flags in '' "$taken"; do
        $first -std=c99 -O2 -ffp-contract=off -I. -DGVI_STATIC -DGVI_NO_CLOCK -DGVI_NO_CONSTRAINTS $flags tests/compile/unsafe.c \
            -o "$dir/unsafe" -lm 2>/dev/null && "$dir/unsafe" >"$dir/unsafe.${flags:+taken}" || fail "$first $flags"
    done
    cmp "$dir/unsafe." "$dir/unsafe.taken" || fail "$first$taken changes bits"
    count=$((count + 1))
done

echo "headers: $count passed, 0 failed"
