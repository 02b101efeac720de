#!/bin/sh
# cost_record.sh BUILD [--record] [dial | rebound | packages]: with --record the tables of BUILD/cost/table.md go between the marks of
# docs/cost.md, and the pictures to docs/img/cost; or those of dial.md, and its picture; or that of rebound.md or packages.md
[ "$2" = --record ] || exit 0
name=${3:-cost} table=$1/cost/${3:-table}.md
awk -v table="$table" -v begin="<!-- $name: begin -->" -v end="<!-- $name: end -->" '
    $0 == end   { off = 0 }
    !off        { print }
    $0 == begin { off = 1; while ((getline line < table) > 0) print line }
    ' docs/cost.md >"$1/cost/recorded" && cp "$1/cost/recorded" docs/cost.md
case $name in rebound | packages) exit 0 ;; esac
[ "$name" = cost ] || exec cp "$1/cost/$name.svg" docs/img/cost/
for key in $(sed -n 's/^| \[\(P[0-9a-z]*\)\].*/\1/p' "$1/cost/table.md"); do cp "$1/cost/$key.svg" docs/img/cost/; done
