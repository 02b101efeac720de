#!/bin/sh
# step.sh BUILD NAME COMMAND...: one step of `make test` or `make check`.  What the command says goes to
# BUILD/log/NAME.log; one line tells how far the run is, how much passed and how long it took.  If it fails,
# the line is the log.  BUILD/result/NAME: passed, failed, skipped.
# A command says what it counted as cmocka does, or in a last line "...: N passed, M failed"; else it is one.
# Alone, outside of such a run, the command just runs.
# step.sh BUILD --sum NAME STEP...: adds up what the steps counted.
build=$1 name=$2
shift 2
if [ "$name" = --sum ]; then
    name=$1
    shift
    for step in "$@"; do cat "$build/result/$step" || exit 1; done |
        awk -v name="$name" -v result="$build/result/$name" '{ passed += $1; failed += $2; skipped += $3 }
            END { print passed, failed, skipped + 0 >result
                  printf "%s: %d passed, %d failed%s\n", name, passed, failed, skipped ? sprintf(", %d skipped", skipped) : ""
                  exit failed > 0 }'
    exit
fi
[ -n "$PROGRESS" ] || exec "$@"
mkdir -p "$build/log" "$build/result"
log=$build/log/$name.log result=$build/result/$name
rm -f "$result"

begin=$(date +%s)
"$@" >"$log" 2>&1
status=$?
set -- $(awk -v status=$status '
    /^\[  (PASSED|FAILED|SKIPPED) *\] +[0-9]+ test/ { sub(/^\[  /, ""); sub(/\]/, ""); n[$1] += $2; next }
    /^[a-z_-]+: [0-9]+ passed, [0-9]+ failed/ { n["PASSED"] += $2; n["FAILED"] += $4 }
    /^ *skipped:/ || / skipped: / { ++n["SKIPPED"] }
    END {
        if (!status && !n["PASSED"] && !n["FAILED"] && !n["SKIPPED"]) n["PASSED"] = 1
        if (status && !n["FAILED"]) n["FAILED"] = 1
        print n["PASSED"] + 0, n["FAILED"] + 0, n["SKIPPED"] + 0
    }' "$log")
echo "$@" >"$result"

echo "$name" >>"$PROGRESS"
at=$(printf '[%2d/%d]' "$(wc -l <"$PROGRESS")" "$STEPS")
if [ $status -ne 0 ] || [ "$2" -ne 0 ]; then
    cat "$log"
    echo "$at FAILED: $name: $1 passed, $2 failed, status $status"
    exit 1
fi
note=
[ "$3" -eq 0 ] || note=", $3 skipped"
printf '%s %-28s %3d passed%s, %d s\n' "$at" "$name" "$1" "$note" $(($(date +%s) - begin))
