#!/bin/sh
# cost_record.sh BUILD [--record]: with --record the tables of BUILD/cost/table.md go between the marks of docs/cost.md,
# and the pictures to docs/img/cost
[ "$2" = --record ] || exit 0
awk -v table="$1/cost/table.md" '
    /^<!-- cost: end -->$/   { off = 0 }
    !off                     { print }
    /^<!-- cost: begin -->$/ { off = 1; while ((getline line < table) > 0) print line }
    ' docs/cost.md >"$1/cost/recorded" && cp "$1/cost/recorded" docs/cost.md
for key in $(sed -n 's/^| \[\(P[0-9a-z]*\)\].*/\1/p' "$1/cost/table.md"); do cp "$1/cost/$key.svg" docs/img/cost/; done
