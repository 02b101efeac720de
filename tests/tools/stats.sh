#!/bin/sh
# stats.sh BUILD [FOLDER]: what there is of gvi.h, that of FOLDER or of this one; COMPILE=no leaves out what takes longer than a second
#   functions           definitions in what the preprocessor leaves
#   preprocessor lines  directives with the lines that continue them
#   private members     of struct gvi__private: a struct within counts as one; then its members instead
#   CC FLAGS            object: text and constants of a file with GVI_IMPLEMENTATION alone, as size counts them; time of the compiler
set -eu
build=$1
from=${2:-.}
CC=${CC:-cc}
dir=$build/stats
mkdir -p "$dir"
printf '#define GVI_IMPLEMENTATION\n#include "gvi.h"\n' >"$dir/gvi.c"
row() { printf '%-23s %s\n' "$1" "$2"; }

awk '
    { directive = continued || /^#/; continued = directive && /\\$/; n += directive }
    length($0) > 100 { ++wide }
    END { printf "%-23s %d\n%-23s %d\n%-23s %d\n", "lines", NR, "over 100 columns", wide, "preprocessor lines", n }' "$from/gvi.h"

# Comments, directives and what other headers bring are gone; texts and characters go here
$CC -std=gnu99 -E -I"$from" "$dir/gvi.c" | LC_ALL=C awk '
    /^# [0-9]+ "/ { own = $3 ~ /gvi\.h"$/; next }
    own && !/^#/ { gsub(/"([^"\\]|\\.)*"|\047([^\047\\]|\\.)*\047/, "0"); print }' >"$dir/text"
tr '\n' ' ' <"$dir/text" | awk '{ gsub(/[{};]/, "\n&\n"); print }' | LC_ALL=C awk '
    /^[{]$/ {
        if (depth == 0 && last ~ /\)[ \t]*$/) ++functions
        if (depth == 0 && last ~ /struct[ \t]+gvi__private[ \t]*$/) inside = 1
        if (inside && depth > 0) { outer[depth] = 1; nested = 1 }
        ++depth; last = ""; next
    }
    /^[}]$/ { if (--depth == 0) inside = 0; last = "}"; next }
    /^;$/ {
        if (inside) {
            n = declarators(last)
            if (depth == 1) members += n
            if (!(depth in outer)) leaves += n
            delete outer[depth]
        }
        last = ""; next
    }
    { last = (last == "}" ? "} " : "") $0 }
    function declarators(text,    k) {
        if (text ~ /^[ \t]*$/) return 0
        while (sub(/\([^()]*\)/, "", text)) {}
        return gsub(/,/, "", text) + 1
    }
    END {
        printf "%-23s %d\n%-23s %d, %d with those of structs within\n", "functions", functions, "private members", members, leaves
    }'

[ "${COMPILE:-}" = no ] && exit 0
other=$(command -v clang || :)
[ "$(basename "$CC")" = clang ] && other=
for cc in "$CC" ${other:+clang}; do
    for flags in -O2 -O3 '-O3 -march=native' -Os; do
        seconds=$( ($cc -std=gnu99 -w $flags -I"$from" -c "$dir/gvi.c" -o "$dir/gvi.o" && times) |
            awk 'NR == 2 { split($1, t, /[ms]/); print 60*t[1] + t[2] }')
        row "$cc $flags" "$(size "$dir/gvi.o" | awk 'NR == 2 { printf "%.1f KB", $1/1000 }'), $seconds s"
    done
done
