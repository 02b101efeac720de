#!/bin/sh
# ensemble.sh BUILD: examples/32_ensemble.c by one thread, by two, by one MPI process and by three: the same
# numbers to the last bit.  Without OpenMP or MPI (make deps-ensemble) what needs them is skipped.
build=$1
CC=${CC:-cc}
dir=$build/ensemble
mkdir -p "$dir"
rm -f "$dir"/*
fail() { echo "FAILED: ensemble: $*"; exit 1; }
count=0

warnings='-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla'
compile() {  # program, compiler and flags
    to=$dir/$1
    shift
    "$@" -std=c99 -O2 -ffp-contract=off $warnings -Werror -I. -Iexamples examples/32_ensemble.c -o "$to" -lm
}
agrees() {  # name command...: its numbers are those of one thread
    name=$1
    shift
    "$@" 30 "$dir/$name.csv" >"$dir/$name.out" || { cat "$dir/$name.out"; fail "$name ended with status $?"; }
    cmp "$dir/one.csv" "$dir/$name.csv" && cmp "$dir/one.out" "$dir/$name.out" || fail "$name: other numbers"
    count=$((count + 1))
}

compile serial $CC || fail 'compilation for one thread'
"$dir/serial" 30 "$dir/one.csv" >"$dir/one.out" || fail 'one thread'
[ "$(wc -l <"$dir/one.csv")" -gt 600 ] || fail 'one thread: orbits are missing'

openmp=
if echo 'int main(void) { return 0; }' | $CC -fopenmp -xc - -o "$dir/probe" 2>/dev/null; then
    openmp=-fopenmp
    compile threads $CC $openmp || fail 'compilation with OpenMP'
    agrees two-threads env OMP_NUM_THREADS=2 "$dir/threads"
else
    echo "skipped: $CC has no OpenMP"
fi

if echo '#include <mpi.h>' | mpicc -x c -fsyntax-only - 2>/dev/null && command -v mpirun >/dev/null 2>&1; then
    export OMPI_CC="$CC" MPICH_CC="$CC" OMP_NUM_THREADS=1
    # more processes than processors, and as root, as in a container: for Open MPI
    export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    compile ranks mpicc $openmp -DUSE_MPI || fail 'compilation with MPI'
    agrees one-rank mpirun -n 1 "$dir/ranks"
    agrees three-ranks mpirun -n 3 "$dir/ranks"
    [ -z "$openmp" ] || agrees two-ranks-of-two-threads env OMP_NUM_THREADS=2 mpirun -n 2 "$dir/ranks"
else
    echo 'skipped: no mpicc (make deps-ensemble installs it)'
fi
echo "ensemble: $count passed, 0 failed"
