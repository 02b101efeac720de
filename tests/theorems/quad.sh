#!/bin/sh
# Prints the flags that turn long double into quadruple precision (quad.h), where
# the compiler $CC has them and what it makes computes; else nothing.
here=$(dirname "$0")
dir=$(mktemp -d) || exit 0
trap 'rm -rf "$dir"' EXIT
cat > "$dir/probe.c" <<'END'
#include <math.h>
int main(int argc, char **argv)
{
    long double two = 1 + argc, root = sqrtl(two), wave = sinl(two)*sinl(two) + cosl(two)*cosl(two);
    (void)argv;
    return !(fabsl(root*root - two) < 1e-32L && fabsl(wave - 1) < 1e-32L
             && fabsl(logl(expl(two)) - two) < 1e-32L);
}
END
flags="-mlong-double-128 -include $here/quad.h"
if ${CC:-cc} -std=c99 $flags "$dir/probe.c" -o "$dir/probe" -lm 2>/dev/null && "$dir/probe"; then
    echo "$flags"
fi
