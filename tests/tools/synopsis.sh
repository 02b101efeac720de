#!/bin/sh
# synopsis.sh: copies the program and the output in gvi.h's SYNOPSIS to examples/01_kepler.c and README.md.
set -e
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
awk '/^   SYNOPSIS/ { s = 1 } /^   prints$/ { exit } s && /^     #define/ { on = 1 } on' gvi.h | sed 's/^     //' |
    awk '{ line[++n] = $0; if ($0 != "") last = n } END { for (i = 1; i <= last; ++i) print line[i] }' >"$dir/code"
awk '/^   SYNOPSIS/ { s = 1 } !s { next } p && /^     / { sub(/^     /, ""); print; n = 1; next } p && n { exit } /^   prints$/ { p = 1 }' gvi.h >"$dir/out"

awk -v out="$dir/out" '{ print } /^   prints$/ { print ""; while ((getline line < out) > 0) print "     " line; print "*/"; exit }' \
    examples/01_kepler.c >"$dir/01"
cat "$dir/code" >>"$dir/01"
# the first block of C is the program, the first block after it the output
awk -v code="$dir/code" -v out="$dir/out" '
    /^```c$/ && !k     { k = 1; print; while ((getline line < code) > 0) print line; skip = 1; next }
    /^```$/ && skip    { skip = 0; print; next }
    /^```$/ && k == 1  { k = 2; print; while ((getline line < out) > 0) print line; skip = 1; next }
    !skip' README.md >"$dir/readme"
cmp -s "$dir/01" examples/01_kepler.c || cp "$dir/01" examples/01_kepler.c
cmp -s "$dir/readme" README.md || cp "$dir/readme" README.md
