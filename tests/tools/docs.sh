#!/bin/sh
# docs.sh BUILD OBJECT: what the documents show is what the files are.
#   1  gvi.h's SYNOPSIS, examples/01_kepler.c and the README: the same program, the same output
#   2  every complete program in README, guide, tools, scenes, embedded and languages: compiled, run, compared with the output below it
#   3  every other piece of C in them stands in an example or in tests/compile
#   4  the version: first line and macro of gvi.h, first entry of the changelog, README
#   5  every relative link leads to a file, and its #anchor to a heading
#   6  the drawing of places is that of the source
#   7  docs/reference.md is what gvi.h says; docs/sheet.md names all that is public
build=$1 object=$2
CC=${CC:-cc}
dir=$build/docs
mkdir -p "$dir"
rm -rf "${dir:?}"/*
fail() { echo "FAILED: docs-check: $*"; exit 1; }
count=0

# -- 1
sh tests/tools/examples.sh code >"$dir/synopsis.c"
sh tests/tools/examples.sh output >"$dir/synopsis.out"
awk 'on; /\*\// { on = 1 }' examples/01_kepler.c >"$dir/kepler.c"
[ -s "$dir/synopsis.c" ] && diff -u "$dir/synopsis.c" "$dir/kepler.c" || fail "SYNOPSIS of gvi.h and examples/01_kepler.c differ"
sh tests/tools/examples.sh expected examples/01_kepler.c | diff -u "$dir/synopsis.out" - || fail "the outputs of SYNOPSIS and examples/01_kepler.c differ"
awk '/^```c$/ { on = 1; next } on && /^```/ { exit } on' README.md | diff -u "$dir/synopsis.c" - || fail "the README's program is not the SYNOPSIS"
count=$((count + 3))

# -- 2 and 3: blocks as files, NAME-k.c and the block after it as NAME-k.out
for page in README.md docs/guide.md docs/tools.md docs/scenes.md docs/embedded.md docs/languages.md; do
    name=$(basename "$page" .md)
    awk -v base="$dir/$name" '
        /^```/ && !on { on = 1; language = substr($0, 4); file = ""
                        if (language == "c" || language == "cpp") { file = sprintf("%s-%02d.%s", base, ++k, language); open = file }
                        else if (language == "" && open != "") { file = open ".out" }
                        if (file != "") printf "" >file
                        next }
        /^```/ && on  { on = 0; if (file ~ /\.out$/) open = ""; next }
        on && file != "" { print >file }' "$page"
done
cat examples/*.c examples/*.cpp examples/bare_metal/*.c examples/scenes/*.c examples/tools/*.h docs/playground/*.h tests/compile/*.c | sed 's/^ *//; s/ *$//' | grep -v '^$' >"$dir/all-code"
for block in "$dir"/*-[0-9][0-9].c "$dir"/*-[0-9][0-9].cpp; do
    [ -f "$block" ] || continue
    if grep -q 'int main' "$block"; then
        [ -f "$block.out" ] || fail "$(basename "$block"): a program without its output"
        $CC -std=c99 -O2 -I. -Iexamples -DGVI_IMPLEMENTED "$block" "$object" -o "$block.run" -lm && "$block.run" >"$block.real" || fail "$block does not run"
        diff -u "$block.out" "$block.real" || fail "$block prints something else"
    else
        sed 's/^ *//; s/ *$//' "$block" | grep -v '^$' >"$block.flat"
        awk 'NR == FNR { part[++n] = $0; next } { text[++m] = $0 }
             END { for (i = 1; i + n - 1 <= m; ++i) { for (j = 1; j <= n && text[i+j-1] == part[j]; ++j) {} if (j > n) exit 0 } exit 1 }' \
            "$block.flat" "$dir/all-code" || { cat "$block"; fail "the lines above stand in no example and not in tests/compile"; }
    fi
    count=$((count + 1))
done

# -- 4
macro=$(sed -n 's/^#define GVI_VERSION "\(.*\)"$/\1/p' gvi.h)
first=$(sed -n '1s/^.* - v\([0-9.]*\) - .*/\1/p' gvi.h)
log=$(sed -n 's/^## \([0-9][0-9.]*\).*/\1/p' docs/changelog.md | head -1)
said=$(sed -n 's/^Version \([0-9.]*\) .*/\1/p; s/^  version = {\(.*\)},$/\1/p' README.md | sort -u)
[ -n "$macro" ] && [ "$macro" = "$first" ] && [ "$macro" = "$log" ] && [ "$macro" = "$said" ] ||
    fail "versions: macro $macro, first line $first, changelog $log, README" $said
count=$((count + 1))

# -- 5; GitHub's anchors: lower case, no punctuation, hyphens for spaces, -1 for the second of a name
anchors() {
    kept=$dir/anchors-$(basename "$1")
    [ -f "$kept" ] || awk '/^ *```/ { on = !on } !on && /^#+ /' "$1" | sed 's/^#* *//; s/\[\([^]]*\)\]([^)]*)/\1/g' | tr 'A-Z ' 'a-z-' |
        tr -d '!"#$%&'"'"'()*+,./:;<=>?@[\\]^`{|}~' | awk '{ print seen[$0]++ ? $0 "-" seen[$0] - 1 : $0 }' >"$kept"
    cat "$kept"
}
for page in README.md docs/*.md; do
    for link in $(sed 's/`[^`]*`//g' "$page" | tr '\n' ' ' | grep -o '](\([^)]*\))' | sed 's/^](//; s/)$//' | grep -v '^[a-z]*:'); do
        file=$page anchor=
        case $link in [!#]*) file=$(dirname "$page")/${link%%#*} ;; esac
        case $link in *#*) anchor=${link#*#} ;; esac
        [ -e "$file" ] || fail "$page links to $link, which does not exist"
        [ -z "$anchor" ] || anchors "$file" | grep -qxF -e "$anchor" || fail "$page links to $link, but there is no such heading"
        count=$((count + 1))
    done
    for image in $(grep -o '<img[^>]* src="[^"]*"' "$page" | sed 's/.* src="//; s/"$//'); do
        [ -e "$(dirname "$page")/$image" ] || fail "$page shows $image, which does not exist"
        count=$((count + 1))
    done
done

# -- 6; the drawing of places is that of the source
if command -v python3 >/dev/null 2>&1; then
    python3 tests/tools/places.py | cmp -s - docs/img/places.svg ||
        fail "docs/img/places.svg is not what gvi.h says: python3 tests/tools/places.py >docs/img/places.svg"
    count=$((count + 1))
fi

# -- 7; the reference is what the header says, and the sheet names each function, status and option
if command -v python3 >/dev/null 2>&1; then
    python3 tests/tools/reference.py | cmp -s - docs/reference.md || fail "docs/reference.md is not what gvi.h says: make reference"
    for name in $(python3 tests/tools/reference.py --names); do
        grep -q "$name" docs/sheet.md || fail "docs/sheet.md does not name $name"
        count=$((count + 1))
    done
fi

echo "docs-check: $count passed, 0 failed"
