#!/bin/sh
# header.sh FILE CHAPTER...: writes gvi.h without these chapters, or with none of them (CORE), to FILE.  What is left of gvi.h
# is its own text: unifdef takes the lines away that GVI_NO_... would hide from the compiler.
file=$1
shift
all='RULES LAGRANGIAN MOMENTA CLOCK KICKS NEWTON CONSTRAINTS OUTPUT DIAL BOUNDARY RESTORE EXPLAIN TEXTS'
among() { case " $2 " in *" $1 "*) return 0 ;; esac; return 1; }

command -v unifdef >/dev/null 2>&1 || {
    echo "header: this needs unifdef (https://dotat.at/prog/unifdef), which is not there.  \"make deps-header\" installs it." >&2
    exit 1
}
out=$*
[ $# -gt 0 ] || { echo "header: say what is left out: WITHOUT=\"NEWTON DIAL\", of $all; or CORE=1: all of them" >&2; exit 1; }
for chapter in $out; do
    among "$chapter" "$all CORE" || { echo "header: no chapter is called $chapter; there are $all" >&2; exit 1; }
done

# what goes with others, as in gvi.h
! among CORE "$out" || out=$all
! among MOMENTA "$out" || among CLOCK "$out" || out="$out CLOCK"
! among MOMENTA "$out" || ! among NEWTON "$out" || among LAGRANGIAN "$out" || out="$out LAGRANGIAN"
{ ! among NEWTON "$out" && ! among OUTPUT "$out"; } || among BOUNDARY "$out" || out="$out BOUNDARY"

symbols=
for chapter in $out; do symbols="$symbols -DGVI_NO_$chapter"; done
! among KICKS "$out" || symbols="$symbols -UGVI_ONLY_EXPLICIT"
[ "$out" != "$all" ] || symbols="$symbols -UGVI_CORE"

# a comment that ends where #ifndef GVI_NO_... begins, up to an #endif before an empty line, is about what stands between
# them, and goes with it
trap 'rm -f "$file.1" "$file.2"' EXIT
awk '
    { line[NR] = $0 }
    function about(k,    first, depth, j) {
        if (line[k] !~ /^#ifndef GVI_NO_/ || line[k - 1] !~ /\*\/$|^\/\//) return 0
        for (j = k + 1; j <= NR && depth >= 0; ++j) {
            if (line[j] ~ /^#if/) ++depth
            if (line[j] ~ /^#endif/) --depth
            if (line[j] ~ /^#el/ && depth == 0) return 0
        }
        if (line[j] != "") return 0
        for (first = k - 1; line[first] !~ /^\/[*\/]/; --first) {}
        while (line[first] ~ /^\/\// && line[first - 1] ~ /^\/\//) --first
        return line[first - 1] == "" ? first : 0
    }
    END {
        for (k = 1; k <= NR; ++k) if (about(k)) { at[about(k)] = k; gone[k] = 1 }
        for (k = 1; k <= NR; ++k) { if (k in at) print line[at[k]]; if (!(k in gone)) print line[k] }
    }' gvi.h >"$file.1"

unifdef -k $symbols "$file.1" >"$file.2"
[ $? -le 1 ] || { echo "header: unifdef does not understand gvi.h" >&2; exit 1; }
awk -v out="$out" 'NR == 2 { print "   Made to order, without " out "." } { print }' "$file.2" | cat -s >"$file"
echo "$file: $(wc -l <"$file") lines, $(wc -c <"$file") bytes; without $out"
