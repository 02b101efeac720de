#!/bin/sh
# under.sh valgrind PROGRAM         any error fails
# under.sh fuzz BUILD SECONDS       libFuzzer on descriptions and calls, tests/fuzz/fuzz_scene.c
# under.sh sanitizer COMPILER FLAG  can it link and run with the sanitizers?  Says so if not; a compiler that is
#                                   missing is no hindrance: what it would compile is skipped anyway
have() { command -v "$1" >/dev/null 2>&1; }
case $1 in
valgrind)
    have valgrind || { echo "skipped: no valgrind"; exit 0; }
    exec valgrind -q --error-exitcode=9 --leak-check=full "$2" ;;
fuzz)
    dir=$2/fuzz
    have clang || { echo "skipped: no clang"; exit 0; }
    mkdir -p "$dir/corpus"
    clang -std=c99 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -Wall -Wextra -Wno-float-equal \
        -I. tests/fuzz/fuzz_scene.c -o "$dir/fuzz_scene" -lm || exit 1
    exec "$dir/fuzz_scene" -max_total_time="$3" -max_len=800 -timeout=10 -artifact_prefix="$dir/" "$dir/corpus" ;;
sanitizer)
    have "$2" || exit 0
    probe=$(mktemp)
    trap 'rm -f "$probe"' EXIT
    echo 'int main(void) { return 0; }' | $2 "$3" -fsanitize=address,undefined -o "$probe" - 2>/dev/null && "$probe" && exit
    echo "  skipped: $2 has no address or undefined behaviour sanitizer here"
    exit 1 ;;
esac
