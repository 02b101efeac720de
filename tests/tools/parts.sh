#!/bin/sh
# parts.sh BUILD: each macro that leaves code out, alone: the scenes that need what it leaves out are refused,
# all others come out to the bit as with everything compiled; and the code gets smaller.  Without GVI_STATIC
# too, what is left out leaves no function behind.  In float, which small machines use; no macro knows the type, and
# in double GVI_NO_CONSTRAINTS alone, which touches all loops.
build=$1 dir=$1/parts
mkdir -p "$dir"
CC=${CC:-cc}
fail() { echo "FAILED: parts: $*"; exit 1; }
flags='-std=c99 -Os -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla -Werror -I.'

make_one() {  # name flags...
    name=$1
    shift
    $CC $flags "$@" -c tests/compile/parts.c -o "$dir/$name.o" && $CC "$dir/$name.o" -o "$dir/$name" -lm &&
        "$dir/$name" >"$dir/$name.txt" || fail "$name does not compile or run"
}
code() { size "$1" | awk 'NR == 2 { print $1 }'; }

count=0
part() {  # type macro, scenes that are refused
    name=$2-$1
    make_one "$name" "-DGVI_REAL=$1" "-D$2"
    for refused in $3; do sed -i "s/^$refused[ :].*/$refused refused/" "$dir/wanted.txt"; done
    diff "$dir/wanted.txt" "$dir/$name.txt" || fail "$2, $1"
    [ "$(code "$dir/$name.o")" -lt "$(code "$dir/all-$1.o")" ] || fail "$2 does not make the code smaller"
    cp "$dir/all-$1.txt" "$dir/wanted.txt"
    count=$((count + 1))
}

for type in float double; do
    make_one "all-$type" "-DGVI_REAL=$type"
    grep -q refused "$dir/all-$type.txt" && fail "$type: a scene was refused with everything there"
    grep -v '^broken: an effect (fault.effect) gave NaN or Inf: halve h, effect 1,' "$dir/all-$type.txt" | grep -cv ' ok ' | grep -q '^0$' || fail "$type: a scene failed with everything there"
    cp "$dir/all-$type.txt" "$dir/wanted.txt"
    part $type GVI_NO_CONSTRAINTS 'held'
    [ $type = float ] || break
    part $type GVI_ONLY_EXPLICIT   'positions given point velocities few broken momenta newton lagrangian clock dense own held'
    part $type GVI_ONLY_POSITIONS  'explicit velocities few broken momenta newton lagrangian clock'
    part $type GVI_ONLY_VELOCITIES 'explicit positions given point momenta newton clock dense own held'
    part $type GVI_ONLY_MOMENTA    'explicit positions given point velocities few broken newton lagrangian dense own held'
    part $type GVI_ONLY_NEWTON     'explicit positions given point velocities few broken momenta lagrangian clock dense own held'
    part $type GVI_NO_CLOCK        'clock'
    part $type GVI_NO_RULES        'positions given lagrangian own held'
done

# functions that some scene could reach, if the compiler did not see that none is left
gone() {  # functions, flags...
    left=$1
    shift
    printf '#define GVI_IMPLEMENTATION\n#include "gvi.h"\n' >"$dir/gone.c"
    $CC $flags "$@" -c "$dir/gone.c" -o "$dir/gone.o" || fail "$* does not compile"
    ! nm "$dir/gone.o" | grep -E " gvi__($left)" || fail "$* leaves these functions behind"
    count=$((count + 1))
}
gone 'clock|rate|transform' -DGVI_ONLY_MOMENTA -DGVI_NO_CLOCK
gone 'constrain|project|report_row|count_rows' -DGVI_NO_CONSTRAINTS
echo "parts: $count passed, 0 failed"
