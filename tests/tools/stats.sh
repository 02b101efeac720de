#!/bin/sh
# stats.sh BUILD [FOLDER]: what there is of gvi.h, that of FOLDER or of this one; COMPILE=no leaves out what takes longer than a second
#   functions           definitions in what the preprocessor leaves: those that a macro makes count each, branches that this
#                       compiler does not take do not.  By ctags, where it is: the other way round
#   preprocessor lines  directives with the lines that continue them
#   private members     of struct gvi__private: a struct within counts as one; then its members instead, if it is written out there
#   prose               a line of whose characters, blanks apart, half or more are comment; of all lines that are not empty.
#                       commented: a line with any comment
#   conditionals        ?: in 100 lines of code of the implementation, and statements that hold two or more; of the for loops,
#                       those whose condition holds an &&
#   CC FLAGS            object: text and constants of a file with GVI_IMPLEMENTATION alone, as size counts them; time of the compiler
set -eu
build=$1
from=${2:-.}
CC=${CC:-cc}
dir=$build/stats
mkdir -p "$dir"
printf '#define GVI_IMPLEMENTATION\n#include "gvi.h"\n' >"$dir/gvi.c"
row() { printf '%-23s %s\n' "$1" "$2"; }

LC_ALL=C awk '
    function row(name, text) { printf "%-23s %s\n", name, text }
    function solid(text) { gsub(/[ \t]/, "", text); return length(text) }
    # comment characters of a line; within: in a comment that a line before began
    function comment(line,    n, k, c) {
        n = 0
        while (line != "") {
            if (within) {
                k = index(line, "*/")
                if (!k) return n + solid(line)
                n += solid(substr(line, 1, k + 1))
                line = substr(line, k + 2)
                within = 0
                continue
            }
            if (!match(line, /["\047]|\/\*|\/\//)) return n
            c = substr(line, RSTART, 2)
            line = substr(line, RSTART)
            if (c == "//") return n + solid(line)
            if (c == "/*") {
                n += 2
                line = substr(line, 3)
                within = 1
            }
            else line = match(line, /^"([^"\\]|\\.)*"|^\047([^\047\\]|\\.)*\047/) ? substr(line, RLENGTH + 1) : substr(line, 2)
        }
        return n
    }
    {
        bytes += length($0) + 1
        if (length($0) > longest) { longest = length($0); where = NR }
        if (length($0) > 100) ++wide
        all = solid($0)
        directive = continued || (!within && $0 ~ /^[ \t]*#/)
        said = comment($0)
        if (directive) ++directives
        continued = directive && $0 ~ /\\$/
        if (all) {
            ++full
            if (2*said >= all) ++prose
            if (said) ++commented
        }
    }
    END {
        row("lines", NR)
        row("bytes", bytes)
        row("longest line", longest " (line " where ")")
        row("over 100 columns", wide + 0)
        row("preprocessor lines", directives)
        row("prose", sprintf("%.1f %% of %d lines that are not empty", 100*prose/full, full))
        row("commented", sprintf("%.1f %%", 100*commented/full))
    }' "$from/gvi.h"

sed -n '/^#if defined(GVI_IMPLEMENTATION)/,$p' "$from/gvi.h" | LC_ALL=C awk '
    { gsub(/"([^"\\]|\\.)*"/, "text"); sub(/\/\/.*/, ""); gsub(/\/\*[^*]*\*\//, "") }
    within { if (!sub(/.*\*\//, "")) next; within = 0 }
    /\/\*/ { sub(/\/\*.*/, ""); within = 1 }
    /^[ \t]*#/ || !/[^ \t]/ { next }
    {
        ++code
        conditionals += gsub(/\?/, "?")
        if (/for \(/) { ++loops; if (/for \([^;]*;[^;]*&&/) ++folded }
        statement = statement $0
        while (match(statement, /[;{}]/)) {
            one = substr(statement, 1, RSTART)
            if (gsub(/\?/, "?", one) > 1) ++nested
            statement = substr(statement, RSTART + 1)
        }
    }
    END {
        printf "%-23s %.1f in 100 lines of code, %d nested\n", "conditionals", 100*conditionals/code, nested
        printf "%-23s %d of %d for loops, %.0f %%\n", "folded loops", folded, loops, 100*folded/loops
    }'

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

if ctags --version 2>/dev/null | grep -q Universal; then
    row "functions, by ctags" "$(ctags -x --languages=C --langmap=C:.h --c-kinds=f "$from/gvi.h" | wc -l)"
fi

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
