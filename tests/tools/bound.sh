#!/bin/sh
# bound.sh BUILD: the bound on the operations of a step (gvi.h, paragraph work) against operations counted
# one by one, float and double; left out, visibly, where there is no C++ compiler.
build=$1
CXX=${CXX:-g++}
mkdir -p "$build/result" "$build/cost"
rm -f "$build/result/bound"
command -v "$CXX" >/dev/null 2>&1 || { echo 0 >"$build/result/bound"; echo "bound: skipped, no $CXX"; exit 0; }
count=0
for type in 'float 1' 'double 2'; do
    set -- $type
    $CXX -std=c++11 -O1 -U__SSE2__ -U__ARM_NEON -DREAL="$1" -DDIGITS="$2" -I. -Itests/cost tests/cost/embedded_bound.cpp \
        -o "$build/cost/embedded_bound-$1" && "$build/cost/embedded_bound-$1" >"$build/cost/bound-$1.txt" ||
        { cat "$build/cost/bound-$1.txt"; echo "FAILED: bound, $1"; exit 1; }
    sed "s/^/  $1:/" "$build/cost/bound-$1.txt"
    count=$((count + $(grep -c cases "$build/cost/bound-$1.txt")))
done
echo "$count" >"$build/result/bound"
echo "bound: $count passed, 0 failed"
