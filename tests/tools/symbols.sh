#!/bin/sh
# symbols.sh BUILD FLOAT DOUBLE LONG: what the compiled library exports and imports, in each type:
# only gvi_ functions out, only libm and the copying of memory in, no variable
# of any kind; no stack array of variable length, no recursion.
build=$1
shift
CC=${CC:-cc}
dir=$build/symbols
mkdir -p "$dir"
rm -f "$dir"/*
fail() { echo "FAILED: symbols: $*"; exit 1; }
count=0

if ! command -v nm >/dev/null 2>&1; then
    echo "  skipped: no nm"
    exit 0
fi

# of math.h, these and no others; f or l is appended for the type
math='sqrt floor ldexp frexp sin cos sincos fabs'
# the compiler's own: copying of memory, position independence, stack guard
other='memcpy memset memmove memcmp _GLOBAL_OFFSET_TABLE_ __stack_chk_fail __stack_chk_guard'

for type in float double 'long double'; do
    case $type in float) suffix=f ;; double) suffix= ;; *) suffix=l ;; esac
    object=$1
    shift
    nm "$object" | awk '{ print $(NF-1), $NF }' | sed 's/ _\(gvi_\)/ \1/' >"$dir/list"

    out=$(awk '$1 == "T" && $2 !~ /^gvi_[a-z]/' "$dir/list")
    [ -z "$out" ] || fail "$type: exports what is not gvi_: $out"
    out=$(awk '$1 ~ /^[BbCDdGgSs]$/' "$dir/list")
    [ -z "$out" ] || fail "$type: has variables: $out"
    allowed=" $other"
    for f in $math; do allowed="$allowed $f$suffix"; done
    out=$(awk -v allowed="$allowed " '$1 == "U" { s = $2; if (!index(allowed, " " s " ")) { sub(/^_/, "", s); if (!index(allowed, " " s " ")) print s } }' "$dir/list")
    [ -z "$out" ] || fail "$type: imports $(echo $out)"
    awk '$1 == "T"' "$dir/list" | wc -l >"$dir/exported"
    printf '  %-28s %d functions exported, imports: %s\n' "$type" "$(cat "$dir/exported")" \
        "$(awk '$1 == "U" { printf "%s ", $2 }' "$dir/list")"
    count=$((count + 3))
done

# gcc alone: every stack frame has a bound (it may be aligned for vectors), and the graph of calls has no loop
if $CC -std=c99 -O0 -I. -fstack-usage -fcallgraph-info -c tests/compile/implementation.c -o "$dir/graph.o" 2>/dev/null &&
   [ -f "$dir/graph.su" ] && [ -f "$dir/graph.ci" ]; then
    out=$(awk '$NF != "static" && $NF != "dynamic,bounded"' "$dir/graph.su")
    [ -z "$out" ] || fail "stack frames without a bound: $out"
    sed -n 's/^edge: { sourcename: "\([^"]*\)" targetname: "\([^"]*\)".*/\1 \2/p' "$dir/graph.ci" |
        grep -v __indirect_call >"$dir/calls"
    out=$(awk '$1 == $2' "$dir/calls")
    [ -z "$out" ] || fail "recursion: $out"
    out=$(tsort "$dir/calls" 2>&1 >/dev/null)
    [ -z "$out" ] || fail "recursion: $out"
    printf '  %-28s %s calls, no recursion; largest frame %s bytes at -O0\n' 'call graph' "$(wc -l <"$dir/calls")" \
        "$(awk '{ if ($(NF-1) > m) m = $(NF-1) } END { print m }' "$dir/graph.su")"
    count=$((count + 2))
else
    echo "  skipped: stack and recursion, for which $CC has no -fcallgraph-info"
fi
echo "symbols: $count passed, 0 failed"
