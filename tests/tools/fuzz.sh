#!/bin/sh
# fuzz.sh BUILD SECONDS: libFuzzer on descriptions and calls, tests/fuzz/fuzz_scene.c.
dir=$1/fuzz seconds=$2
command -v clang >/dev/null 2>&1 || { echo "skipped: no clang"; exit 0; }
mkdir -p "$dir/corpus"
clang -std=c99 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -Wall -Wextra -Wno-float-equal \
    -I. tests/fuzz/fuzz_scene.c -o "$dir/fuzz_scene" -lm || exit 1
"$dir/fuzz_scene" -max_total_time="$seconds" -max_len=800 -timeout=10 -artifact_prefix="$dir/" "$dir/corpus"
