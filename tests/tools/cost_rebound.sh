#!/bin/sh
# cost_rebound.sh BUILD REBOUND: compiles a copy of REBOUND/src by its own Makefile, links tests/cost/rebound.c with it and
# BUILD/cost/problems.o, and runs that: BUILD/cost/rebound.md
set -e
build=$1 rebound=$2 copy=$1/rebound
CC=${CC:-cc}
[ -f "$rebound/src/rebound.h" ] || { echo "cost-rebound: $rebound/src/rebound.h is not there"; exit 1; }
rm -rf "$copy" && mkdir -p "$copy" && cp -R "$rebound/src" "$copy/"
make -s -C "$copy/src" >"$copy/log" 2>&1 || { tail "$copy/log"; exit 1; }
version=$(sed -n 's/.*reb_version_str = "\([^"]*\)".*/\1/p' "$copy/src/rebound.c")
commit=$(git -C "$rebound" rev-parse --short HEAD 2>/dev/null || echo "commit unknown")
flags=$(make -s -n -B -C "$copy/src" rebound.o 2>/dev/null | grep -o -e ' -O[0-9s] ' | head -1 | tr -d ' ')
$CC -std=gnu11 -O2 -Wall -Wextra -I. -isystem "$copy/src" tests/cost/rebound.c "$build/cost/problems.o" \
    "$copy/src/librebound.so" -Wl,-rpath,"$(cd "$copy/src" && pwd)" -o "$build/cost/rebound" -lm
"$build/cost/rebound" "$build/cost/rebound.md" "$version, $commit, its $flags"
