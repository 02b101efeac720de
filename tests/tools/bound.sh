#!/bin/sh
# bound.sh BUILD: the bound on the operations of a step (gvi.h, paragraph work) against operations counted
# one by one, float and double, for speed and for size; left out, visibly, where there is no C++ compiler.
build=$1
CXX=${CXX:-g++}
mkdir -p "$build/cost"
command -v "$CXX" >/dev/null 2>&1 || { echo "skipped: no $CXX"; exit 0; }
count=0
for type in 'float 1 -O1' 'double 2 -O1' 'float 1 -Os' 'double 2 -Os'; do
    set -- $type
    out=embedded_bound-$1$3
    $CXX -std=c++11 "$3" -U__SSE2__ -U__ARM_NEON -DREAL="$1" -DDIGITS="$2" -I. -Itests/cost tests/cost/embedded_bound.cpp \
        -o "$build/cost/$out" && "$build/cost/$out" >"$build/cost/$out.txt" ||
        { cat "$build/cost/$out.txt"; echo "FAILED: bound, $1 $3"; exit 1; }
    sed "s/^/  $1 $3:/" "$build/cost/$out.txt"
    count=$((count + $(grep -c cases "$build/cost/$out.txt")))
done
echo "bound: $count passed, 0 failed"
