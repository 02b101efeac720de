#!/bin/sh
# run_example.sh BUILD NAME PROGRAM: runs an example and compares what it prints with its opening comment.
build=$1 name=$2 program=$3
mkdir -p "$build/log" "$build/result" build
rm -f "$build/result/$name"
source=$(ls examples/"$name".c examples/"$name".cpp examples/"$name"/main.c 2>/dev/null)

if [ ! -x "$program" ]; then
    printf '  %-28s skipped: no C++ compiler\n' "$name"
    echo 0 >"$build/result/$name"
    exit 0
fi
sh tests/tools/expected.sh "$source" >"$build/log/$name.expected"
"$program" >"$build/log/$name.out"
status=$?
if [ $status -ne 0 ] || [ ! -s "$build/log/$name.expected" ] ||
   ! diff -u "$build/log/$name.expected" "$build/log/$name.out"; then
    echo "FAILED: $name (status $status): its output is not that of its opening comment"
    exit 1
fi
printf '  %-28s as its comment says\n' "$name"
echo 1 >"$build/result/$name"
