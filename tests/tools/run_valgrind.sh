#!/bin/sh
# run_valgrind.sh PROGRAM: a program under valgrind; any error fails.
command -v valgrind >/dev/null 2>&1 || { echo "skipped: no valgrind"; exit 0; }
exec valgrind -q --error-exitcode=9 --leak-check=full "$1"
