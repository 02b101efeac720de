#!/bin/sh
# run_valgrind.sh BUILD NAME PROGRAM: a program under valgrind; any error fails.
build=$1 name=$2 program=$3
mkdir -p "$build/log" "$build/result"
rm -f "$build/result/valgrind-$name"

if ! command -v valgrind >/dev/null 2>&1; then
    printf '  %-28s skipped: no valgrind\n' "$name"
    echo 0 >"$build/result/valgrind-$name"
    exit 0
fi
log=$build/log/valgrind-$name.log
if ! valgrind -q --error-exitcode=9 --leak-check=full "$program" >"$log" 2>&1; then
    cat "$log"
    echo "FAILED: $name under valgrind"
    exit 1
fi
printf '  %-28s clean under valgrind\n' "$name"
echo 1 >"$build/result/valgrind-$name"
