#!/bin/sh
# examples.sh run BUILD NAME PROGRAM   runs an example and compares what it prints with its opening comment
# examples.sh expected FILE            that output: what stands five columns in, between a line "   prints" (or
#                                      "   prints, ...") and the end of the comment
# examples.sh code | output            the program in gvi.h's SYNOPSIS, and what it prints
# examples.sh synopsis                 copies both to examples/01_kepler.c and README.md
expected() {
    awk '/\*\// { exit }
         shown  { sub(/^     /, ""); lines[++n] = $0; if ($0 != "") last = n }
         /^   prints(,.*)?$/ { shown = 1 }
         END { for (i = 1; i <= last; ++i) if (i > 1 || lines[i] != "") print lines[i] }' "$1"
}
code() {
    awk '/^   SYNOPSIS/ { s = 1 } /^   prints$/ { exit } s && /^     #define/ { on = 1 } on' gvi.h | sed 's/^     //' |
        awk '{ line[++n] = $0; if ($0 != "") last = n } END { for (i = 1; i <= last; ++i) print line[i] }'
}
output() {
    awk '/^   SYNOPSIS/ { s = 1 } !s { next } p && /^     / { sub(/^     /, ""); print; n = 1; next }
         p && n { exit } /^   prints$/ { p = 1 }' gvi.h
}

case $1 in
code)     code ;;
output)   output ;;
expected) expected "$2" ;;
run)
    mkdir -p build
    [ -x "$4" ] || { echo "skipped: no C++ compiler"; exit 0; }
    expected "$(ls examples/"$3".c examples/"$3".cpp examples/"$3"/main.c 2>/dev/null)" >"$4.expected"
    "$4" >"$4.out"
    status=$?
    if [ $status -ne 0 ] || [ ! -s "$4.expected" ] || ! diff -u "$4.expected" "$4.out"; then
        echo "FAILED: $3 (status $status): its output is not that of its opening comment"
        exit 1
    fi ;;
synopsis)
    set -e
    dir=$(mktemp -d)
    trap 'rm -rf "$dir"' EXIT
    code >"$dir/code"
    output >"$dir/out"
    awk -v out="$dir/out" '{ print } /^   prints$/ { print ""; while ((getline line < out) > 0) print "     " line; print "*/"; exit }' \
        examples/01_kepler.c | cat - "$dir/code" >"$dir/01"
    # the first block of C is the program, the first block after it the output
    awk -v code="$dir/code" -v out="$dir/out" '
        /^```c$/ && !k     { k = 1; print; while ((getline line < code) > 0) print line; skip = 1; next }
        /^```$/ && skip    { skip = 0; print; next }
        /^```$/ && k == 1  { k = 2; print; while ((getline line < out) > 0) print line; skip = 1; next }
        !skip' README.md >"$dir/readme"
    cmp -s "$dir/01" examples/01_kepler.c || cp "$dir/01" examples/01_kepler.c
    cmp -s "$dir/readme" README.md || cp "$dir/readme" README.md ;;
esac
