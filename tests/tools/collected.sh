#!/bin/sh
# collected.sh PROGRAM RUN: the instructions of a run of tests/cost/instructions.c from its first step to its last
valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=run_steps "$1" "$2" 2>&1 >/dev/null |
    sed -n 's/.*Collected *: *\([0-9][0-9]*\).*/\1/p'
