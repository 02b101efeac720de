#!/bin/sh
# sanitizer.sh COMPILER [FLAG]: does it exist, and can it link and run with the sanitizers?  Says so if not.
# A missing compiler is no hindrance: what it would compile is skipped anyway.
compiler=$1 flag=${2:--xc}
command -v $compiler >/dev/null 2>&1 || exit 0
probe=$(mktemp)
if echo 'int main(void) { return 0; }' | $compiler $flag -fsanitize=address,undefined -o "$probe" - 2>/dev/null &&
   "$probe"; then
    rm -f "$probe"
    exit 0
fi
rm -f "$probe"
echo "  skipped: $compiler has no address or undefined behaviour sanitizer here"
exit 1
