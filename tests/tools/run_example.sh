#!/bin/sh
# run_example.sh BUILD NAME PROGRAM: runs an example and compares what it prints with its opening comment.
build=$1 name=$2 program=$3
mkdir -p build
source=$(ls examples/"$name".c examples/"$name".cpp examples/"$name"/main.c 2>/dev/null)

if [ ! -x "$program" ]; then
    echo "skipped: no C++ compiler"
    exit 0
fi
sh tests/tools/expected.sh "$source" >"$program.expected"
"$program" >"$program.out"
status=$?
if [ $status -ne 0 ] || [ ! -s "$program.expected" ] || ! diff -u "$program.expected" "$program.out"; then
    echo "FAILED: $name (status $status): its output is not that of its opening comment"
    exit 1
fi
