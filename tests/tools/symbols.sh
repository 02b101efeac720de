#!/bin/sh
# symbols.sh BUILD FLOAT DOUBLE LONG: what the compiled library exports and imports, in each type:
# only gvi_ functions out, with type and GVI_EFFECTS in their names unless it is double and 16, only libm and
# the copying of memory in, no variable of any kind; no stack array of variable length, no recursion.  A program
# does not link with the library of another type or GVI_EFFECTS, and two of these fit in one program.
build=$1
shift
float=$1 double=$2 long=$3
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
    out=$(awk -v type="${type%% *}" '$1 == "T" && ($2 ~ /_[a-z]+_16$/) != (type != "double") ||
                                     $1 == "T" && type != "double" && $2 !~ "_" type "_16$" { print $2 }' "$dir/list")
    [ -z "$out" ] || fail "$type: names without it: $out"
    out=$(awk '$1 ~ /^[BbCDdGgSs]$/' "$dir/list")
    [ -z "$out" ] || fail "$type: has variables: $out"
    allowed=" $other"
    for f in $math; do allowed="$allowed $f$suffix"; done
    out=$(awk -v allowed="$allowed " '$1 == "U" { s = $2; if (!index(allowed, " " s " ")) { sub(/^_/, "", s); if (!index(allowed, " " s " ")) print s } }' "$dir/list")
    [ -z "$out" ] || fail "$type: imports $(echo $out)"
    awk '$1 == "T"' "$dir/list" | wc -l >"$dir/exported"
    printf '  %-28s %d functions exported, imports: %s\n' "$type" "$(cat "$dir/exported")" \
        "$(awk '$1 == "U" { printf "%s ", $2 }' "$dir/list")"
    count=$((count + 4))
done

# every wrong pair of a user (in C, in C++) and a library, every right one, then two libraries in one program
few=$dir/few.o compile="$CC -std=c99 -O0 -I. -DGVI_EFFECTS=8 -c tests/compile/implementation.c"
$compile -fstack-usage -fcallgraph-info -o "$few" 2>/dev/null || $compile -o "$few" || fail "GVI_EFFECTS=8"
languages="$CC -std=c99 -xc"
! command -v "${CXX:-c++}" >/dev/null 2>&1 || languages="$languages
${CXX:-c++} -std=c++11 -xc++"
use() { $compile -I. "-DGVI_REAL=$type" -DGVI_EFFECTS=$effects "$@" -c tests/compile/linked.c; }
echo "$languages" >"$dir/languages"
while read -r compile; do
    for user in 'float 16' 'double 16' 'long double 16' 'double 8'; do
        type=${user% *} effects=${user##* }
        use -o "$dir/user.o" || fail "tests/compile/linked.c: $user"
        case $user in float*) own=$float ;; long*) own=$long ;; *16) own=$double ;; *) own=$few ;; esac
        for library in "$float" "$double" "$long" "$few"; do
            if $CC "$dir/user.o" "$library" -o "$dir/linked" -lm 2>"$dir/linker"; then
                [ "$library" = "$own" ] && "$dir/linked" || fail "a user with $user links with $library, or fails"
            else
                [ "$library" != "$own" ] && grep -q gvi_init "$dir/linker" || fail "a user with $user and $library: $(cat "$dir/linker")"
            fi
            count=$((count + 1))
        done
    done
    type=float effects=16 && use -DNEXT -o "$dir/user.o" && type=double && use -DOTHER -o "$dir/other.o" || fail "tests/compile/linked.c"
    $CC "$dir/user.o" "$dir/other.o" "$float" "$double" -o "$dir/linked" -lm && "$dir/linked" ||
        fail "two libraries in one program"
    count=$((count + 1))
done <"$dir/languages"

# gcc alone: every stack frame has a bound (it may be aligned for vectors), and the graph of calls has no loop
if [ -f "$dir/few.su" ] && [ -f "$dir/few.ci" ]; then
    out=$(awk '$NF != "static" && $NF != "dynamic,bounded"' "$dir/few.su")
    [ -z "$out" ] || fail "stack frames without a bound: $out"
    sed -n 's/^edge: { sourcename: "\([^"]*\)" targetname: "\([^"]*\)".*/\1 \2/p' "$dir/few.ci" |
        grep -v __indirect_call >"$dir/calls"
    out=$(awk '$1 == $2' "$dir/calls")
    [ -z "$out" ] || fail "recursion: $out"
    out=$(tsort "$dir/calls" 2>&1 >/dev/null)
    [ -z "$out" ] || fail "recursion: $out"
    printf '  %-28s %s calls, no recursion; largest frame %s bytes at -O0\n' 'call graph' "$(wc -l <"$dir/calls")" \
        "$(awk '{ if ($(NF-1) > m) m = $(NF-1) } END { print m }' "$dir/few.su")"
    count=$((count + 2))
else
    echo "  skipped: stack and recursion, for which $CC has no -fcallgraph-info"
fi
echo "symbols: $count passed, 0 failed"
