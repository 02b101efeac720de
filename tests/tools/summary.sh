#!/bin/sh
# summary.sh BUILD NAME STEP...: adds up what the steps counted.
build=$1 name=$2
shift 2
for step in "$@"; do cat "$build/result/$step" || exit 1; done |
    awk -v name="$name" -v result="$build/result/$name" '{ passed += $1; failed += $2; skipped += $3 }
        END { print passed, failed, skipped + 0 >result
              printf "%s: %d passed, %d failed%s\n", name, passed, failed, skipped ? sprintf(", %d skipped", skipped) : ""
              exit failed > 0 }'
