#!/bin/sh
# run_test.sh BUILD NAME PROGRAM: one test program, one line; everything it says if it fails.
build=$1 name=$2 program=$3
mkdir -p "$build/log" "$build/result"
log=$build/log/$name.log
rm -f "$build/result/$name"

"$program" >"$log" 2>&1
status=$?
passed=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p' "$log" | awk '{ n += $1 } END { print n + 0 }')
failed=$(sed -n 's/^\[  FAILED  \] \([0-9]*\) test.*/\1/p' "$log" | awk '{ n += $1 } END { print n + 0 }')
skipped=$(sed -n 's/^\[  SKIPPED \] \([0-9]*\) test.*/\1/p' "$log" | awk '{ n += $1 } END { print n + 0 }')

if [ $status -ne 0 ] || [ "$failed" -ne 0 ] || [ "$passed" -eq 0 ]; then
    cat "$log"
    echo "FAILED: $name (status $status, $passed passed, $failed failed)"
    exit 1
fi
if [ "$skipped" -ne 0 ]; then note=", $skipped skipped"; fi
printf '  %-28s %3d passed%s\n' "$name" "$passed" "$note"
echo "$passed" >"$build/result/$name"
