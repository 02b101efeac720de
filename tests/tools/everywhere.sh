#!/bin/sh
# everywhere.sh BUILD [--record [FILE]]: gvi.h on every machine that this one can compile for and
# imitate.  On each: compiled without a warning (-O0, -O2; float, double, long double), its own tests,
# and the bits of tests/everywhere/bits.c against those of the native compiler.  Prints two tables;
# --record puts them into FILE (tests/README.md) between its two marks.
# everywhere.sh --deps installs the compilers and emulators (Debian 12).
# JOBS=n: so many at a time.  ONLY="armhf tcc": these targets alone, nothing recorded.
# What has passed since its sources were changed is not run again, so a run goes on where it was broken
# off, and targets can be run one by one; make clean before it where a compiler has changed.
self=tests/tools/everywhere.sh
here=tests/everywhere
all='gcc clang tcc i386-sse i386-x87 i386-clang armhf aarch64 riscv64 ppc64 s390x wasm32 free-gcc free-clang
     cortex-m4 cortex-m0 avr'

# ------------------------------------------------------------------ the targets

# Tests that say what gvi.h computes.  Not here: those of the examples, of the price list and of the
# reference integrators (make test); test_order, test_theorems, test_ncdp, a minute and more each.  test_uncoupled
# takes a quarter of an hour where a processor is imitated.
quick='api effects identities interpolation kicks lu mass newton oracle quadrature queries structure tolerance
       effects:float interpolation:float lu:float newton:float oracle:float'
more='regressions regressions:float hostile uncoupled uncoupled:float mass:float scenes tolerance:float no_trace no_trace:float'
wide='lu:long interpolation:long oracle:long'
quad='interpolation:long oracle:long kicks:long effects:long'
# Some tests are in long double unless told otherwise and mean 64 bits by it: their problems are of
# degree 7 to 10, which does not reach the last digit of 113.  Where there are not 64, these are in double.
# test_lu:long wants a type with more than 113 digits for its residuals.
in_double='kicks queries structure'
strict='-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Wshadow -Wundef -Wfloat-equal -Wvla -Werror'
freestanding='-ffreestanding -nostdlib -fno-pic -fno-stack-protector -DFREESTANDING -DGVI_STATIC'
native=$(uname -m)

# target NAME: label, cc, flags, what is linked behind, how it is run, tests, types, why tests are missing
target() {
    label=$1 flags='' late=-lm run='' tests=$quick types='float double long' less=
    dialect='-std=c99 -ffp-contract=off' warnings=$strict
    case $1 in
    gcc|clang)
        label=$native cc=$1 tests="$quick clock $more $wide" ;;
    tcc)
        # 0.9.27: no vectors, no FLT_EVAL_METHOD; 3*n*e/(1 - 3*n*e)*s*f(x[k]) in long double is NaN
        label=$native cc=tcc flags="-DFLT_EVAL_METHOD=0 -I$here/tcc" dialect=-std=c99 warnings='-Wall -Werror'
        tests='identities regressions hostile quadrature queries structure regressions:float'
        less="clock, interpolation, lu, oracle (tcc's long double gives NaN in their bounds), api, effects, kicks,
            scenes (tcc refuses their initialisers)" ;;
    i386-sse)
        label='i386, SSE2' cc=gcc flags='-m32 -msse2 -mfpmath=sse' tests="$quick clock $more $wide" ;;
    i386-x87)
        label='i386, x87' cc=gcc flags='-m32 -mfpmath=387' tests="$quick clock $more $wide" ;;
    i386-clang)
        # its __float128 comes back from functions as garbage
        label='i386, x87' cc=clang flags='-m32 -mno-sse2 -U__SIZEOF_FLOAT128__'
        tests="$(without "$quick clock $more" oracle:float regressions:float) oracle:long"
        less="oracle in float (results are right, but in such registers Newton needs
            338 iterations with second derivatives and 277 without, and 10 % more are allowed), regressions in float
            (200,000 steps of a fixed point of degree 2 at h omega = 2.7 drift by 6.2e4 eps, and 6e4 are documented)" ;;
    armhf)
        label=ARMv7 cc=arm-linux-gnueabihf-gcc flags=-static run=qemu-arm
        tests="$(without "$quick" lu) quadrature:float"
        less='lu and two of quadrature in double, which compute in more digits than they test: long double is
            double; in float they are run' ;;
    aarch64) label=AArch64 cc=aarch64-linux-gnu-gcc flags=-static run=qemu-aarch64 tests="$quick $quad" ;;
    riscv64) label='RISC-V 64' cc=riscv64-linux-gnu-gcc flags=-static run=qemu-riscv64 tests="$quick $quad" ;;
    ppc64)
        label='PowerPC 64' cc=powerpc64-linux-gnu-gcc flags=-static run=qemu-ppc64 ;;
    s390x)
        # with -std=c99 alone this gcc evaluates float in double (FLT_EVAL_METHOD 1): see the second table
        label=s390x cc=s390x-linux-gnu-gcc flags='-static -fexcess-precision=fast' run=qemu-s390x
        tests="$quick $quad" ;;
    wasm32)
        # no longjmp; compiler-rt 14 divides 1/4 by 1/2 - 2^-114 in long double, as test_interpolation's
        # oracle does, and gets 1 (mended by pull request 119449 of llvm-project); after test_scenes, which
        # has passed by then, node 20 crashes where it has threads
        label=WebAssembly cc=clang run="node --no-warnings --single-threaded $here/wasm/wasi.mjs"
        flags="--target=wasm32-wasi -D_WASI_EMULATED_PROCESS_CLOCKS -I$here/wasm"
        late='-lm -lc-printscan-long-double -lwasi-emulated-process-clocks -Wl,-z,stack-size=1048576 -Wl,--stack-first'
        tests=$(without "$quick clock $more" interpolation interpolation:float)
        less='interpolation (long double divides wrongly, compiler-rt 14)' ;;
    free-gcc|free-clang)
        label="$native, no C library" cc=${1#free-} flags=$freestanding tests='' types='float double' ;;
    cortex-m4)
        label='Cortex-M4F' cc=arm-none-eabi-gcc flags='-mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16'
        tests='' run=none ;;
    cortex-m0) label='Cortex-M0' cc=arm-none-eabi-gcc flags=-mcpu=cortex-m0 tests='' run=none ;;
    avr)       label='AVR, 16-bit int' cc=avr-gcc flags=-mmcu=atmega2560 tests='' run=none types=double ;;
    *)         echo "no target $1" >&2; exit 2 ;;
    esac
}
without() { # LIST WORD...
    list=$1
    shift
    for word in $list; do case " $* " in *" $word "*) ;; *) printf '%s ' "$word" ;; esac; done
}

# The same bits from other options: name, target, further flags.  "differs": must not be the same, or this
# comparison sees nothing; it is then to be the same to rounding.
variants='O0|gcc|-O0|same|gcc, -O0
O3|gcc|-O3 -march=native|same|gcc, -O3 -march=native
clang-O3|clang|-O3 -march=native|same|clang, -O3 -march=native
vsx|ppc64|-O2 -mcpu=power8|same|PowerPC 64 with vectors (-mcpu=power8)
neon|armhf|-O2 -mfpu=neon-vfpv4|same|ARMv7 with -mfpu=neon-vfpv4
z13|s390x|-O2 -march=z13|same|s390x with vectors (-march=z13)
fused|aarch64|-O2 -ffp-contract=fast|differs|AArch64, products and sums fused (-ffp-contract=fast)
excess|s390x|-O2 -fexcess-precision=standard|float differs|s390x with -std=c99 alone: float in double'

# ------------------------------------------------------------------------ jobs

real() { case $1 in long) echo 'long double' ;; *) echo "$1" ;; esac; }
timed() { if command -v timeout >/dev/null 2>&1; then timeout 900 "$@"; else "$@"; fi; }

# compile OUT SOURCE FLAGS...: by the target's compiler, libraries behind
compile() {
    out=$1 source=$2
    shift 2
    $cc $dialect $flags "$@" -I. "$source" -o "$out" $late
}

# warn LEVEL TYPE; a long double of two doubles is refused by design
job_warn() {
    set -- "$1" "$2" "$(real "$2")"
    # shellcheck disable=SC2086
    out=$($cc $dialect $flags $warnings "$1" "-DGVI_REAL=$3" -I. -c tests/compile/implementation.c \
        -o "$dir/warn$1$2.o" 2>&1)
    status=$?
    rm -f "$dir/warn$1$2.o"
    if [ "$2" = long ] && [ "$(cut -d' ' -f2 "$dir/machine" 2>/dev/null)" = 106 ]; then
        if echo "$out" | grep -q 'long double must be one IEEE number'; then
            echo 1 >"$dir/refused"
            return 0
        fi
        echo "a long double of two doubles is not refused: status $status"
        return 1
    fi
    [ $status -eq 0 ] && [ -z "$out" ] && return 0
    echo "$out"
    return 1
}

# test NAME[:TYPE]
job_test() {
    name=${1%:*} type=${1#"$name"}
    type=${type#:}
    case " $in_double " in *" $name "*)
        [ -n "$type" ] || [ "$(cut -d' ' -f2 "$dir/machine")" = 64 ] || type=double ;;
    esac
    program=$dir/$(echo "$1" | tr : -)
    level=-O2
    [ -z "$run" ] || level=-O1                  # half the time of compilation; bits are at -O2 everywhere
    set -- $level -w -I$here -Itests -Iexamples
    [ -z "$type" ] || set -- "$@" "-DGVI_REAL=$(real "$type")"
    source=tests/test_$name.c
    if [ "$cc" = tcc ]; then
        source=$program.c
        { cat "tests/test_$name.c"; echo 'static void register_tests(void) {'
          sed -n 's/^TEST(\([a-zA-Z0-9_]*\)).*/    \1_registers();/p' "tests/test_$name.c"; echo '}'; } >"$source"
    fi
    compile "$program" "$source" "$@" || return 1
    timed $run "$program" >"$program.log" 2>&1
    status=$?
    rm -f "$program"
    [ $status -eq 0 ] && passed "$program.log" && return 0
    tail -n 30 "$program.log"
    echo "status $status"
    return 1
}
passed() { sed -n 's/^\[  PASSED  \] \([1-9][0-9]*\) test.*/\1/p' "$1" | grep .; }

# bits TYPE [FLAGS...], to $dir/$bits.txt
job_bits() {
    type=$1 program=$dir/$bits
    rm -f "$program.txt"
    shift
    [ $# -gt 0 ] || set -- -O2
    case " $flags " in
    *-DFREESTANDING*) link_freestanding "$type" "$program" || return 1 ;;
    *) compile "$program" $here/bits.c $warnings "$@" "-DGVI_REAL=$type" -I$here || return 1 ;;
    esac
    timed $run "$program" >"$program.txt" || { grep failed "$program.txt"; return 1; }
    rm -f "$program"
}

# An object that imports nothing but what compilers may ask for, and a program around it.
link_freestanding() {
    # shellcheck disable=SC2086
    $cc $dialect $warnings $flags -O2 "-DGVI_REAL=$1" -I. -I$here -c $here/bits.c -o "$2.o" || return 1
    imports=$(nm -u "$2.o" | awk '{ print $NF }' | grep -v -x -e bits_put -e memcpy -e memset -e memmove)
    [ -z "$imports" ] || { echo "imports" $imports; return 1; }
    $cc -no-pie "$2.o" $here/driver.c -o "$2"
}

# variant NAME TYPE
job_variant() {
    bits=$1-$2 warnings=-w
    job_bits "$2" $(echo "$variants" | awk -F'|' -v name="$1" '$1 == name { print $3 }')
}

if [ "$1" = --job ]; then
    build=$2 kind=$3 name=$4
    target "$name"
    dir=$build/everywhere/$name
    shift 4
    bits=bits-$1 log=$dir/$kind-$1${2:+-$2}
    sources="gvi.h $here tests/gvi_test.h tests/problems.h tests/compile examples"
    [ "$kind" != test ] || sources="$sources tests/data tests/cost tests/hard tests/theorems tests/fuzz tests/test_${1%:*}.c"
    # shellcheck disable=SC2086
    [ -f "$log.out" ] && [ -z "$(find $sources -type f -newer "$log.out")" ] && exit 0
    rm -f "$log.out" "$log.bad"
    result=bad
    job_"$kind" "$@" >"$log.now" 2>&1 && result=out
    mv "$log.now" "$log.$result"
    times >"$log.times"
    exit 0
fi

# ------------------------------------------------------------------------ deps

if [ "$1" = --deps ]; then
    command -v apt-get >/dev/null 2>&1 || { echo 'deps-everywhere: this list is for Debian 12' >&2; exit 1; }
    sudo=
    [ "$(id -u)" = 0 ] || sudo=sudo
    $sudo apt-get update || true
    # gcc-multilib excludes the cross compilers; gcc-12-multilib does not
    for package in gcc clang tcc "gcc-$(gcc -dumpversion 2>/dev/null || echo 12)-multilib" qemu-user nodejs \
        'gcc-arm-linux-gnueabihf libc6-dev-armhf-cross' 'gcc-aarch64-linux-gnu libc6-dev-arm64-cross' \
        'gcc-riscv64-linux-gnu libc6-dev-riscv64-cross' 'gcc-powerpc64-linux-gnu libc6-dev-ppc64-cross' \
        'gcc-s390x-linux-gnu libc6-dev-s390x-cross' 'lld wasi-libc libclang-rt-14-dev-wasm32' \
        'gcc-arm-none-eabi libnewlib-arm-none-eabi' 'gcc-avr avr-libc'; do
        # shellcheck disable=SC2086
        $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $package ||
            echo "deps-everywhere: $package could not be installed; what needs it will be \"not here\""
    done
    exit 0
fi

# ------------------------------------------------------------------------ what is here

build=$1
base=$build/everywhere
rm -f "$build/result/everywhere"
mkdir -p "$base" "$build/result"
chosen=${ONLY:-$all}

# present NAME: does its compiler make a program, and does that run?  yes, compiled (cannot be run), no
present() {
    target "$1"
    dir=$base/$1
    command -v "$cc" >/dev/null 2>&1 || { echo no; return; }
    mkdir -p "$dir"
    options="$cc $dialect $flags $late $run"
    [ "$(cat "$dir/options" 2>/dev/null)" = "$options" ] || rm -rf "${dir:?}"/*
    echo "$options" >"$dir/options"
    if [ "$run" = none ]; then
        if echo 'int main(void) { return 0; }' | $cc $flags -x c -c - -o "$dir/probe" 2>/dev/null
        then echo compiled; else echo no; fi
        return
    fi
    case " $flags " in *-DFREESTANDING*) flags= ;; esac
    compile "$dir/probe" $here/machine.c 2>"$dir/probe.log" || { echo no; return; }
    timed $run "$dir/probe" >"$dir/machine" 2>/dev/null && echo yes || echo linked
}
for name in $chosen; do
    present "$name" >"$base/$name.here"
    here_is=$(cat "$base/$name.here")
    target "$name"
    [ "$here_is" != no ] || continue
    for type in $types; do
        case $name in
        free-*) ;;
        *) for level in -O0 -O2; do echo "warn $name $level $type"; done ;;
        esac
        [ "$here_is" = yes ] && [ "$type" != long ] && echo "bits $name $type"
    done
    [ "$here_is" = yes ] || continue
    for test in $tests; do echo "test $name $test"; done
    echo "$variants" | awk -F'|' -v name="$name" '
        $2 == name { print "variant", name, $1, "float"; print "variant", name, $1, "double" }'
done >"$base/jobs"

# what is not asked any more
awk '{ print $2 "/" $1 "-" $3 (NF > 3 ? "-" $4 : "") }' "$base/jobs" >"$base/logs"
for name in $chosen; do
    for log in "$base/$name"/*.out "$base/$name"/*.bad; do
        grep -qxF "$name/$(basename "${log%.*}")" "$base/logs" || rm -f "$log"
    done
done

echo "  $(grep -c . "$base/jobs") jobs" >&2
jobs=${JOBS:-$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)}
xargs -P "$jobs" -L 1 sh $self --job "$build" <"$base/jobs"

# ------------------------------------------------------------------------ results

${CC:-cc} -D_POSIX_C_SOURCE=200809L -std=c99 -O2 $here/compare.c -o "$base/compare" -lm ||
    { echo 'FAILED: everywhere: compare.c'; exit 1; }
reference=
for name in tcc clang gcc; do
    if [ -s "$base/$name/bits-double.txt" ] && [ -s "$base/$name/bits-float.txt" ]; then reference=$base/$name; fi
done
if [ -z "$reference" ]; then
    reference=$base/reference
    mkdir -p "$reference"
    for type in float double; do
        ${CC:-cc} -std=c99 -O2 -ffp-contract=off "-DGVI_REAL=$type" -I. $here/bits.c -o "$reference/bits" -lm &&
            "$reference/bits" >"$reference/bits-$type.txt" || { echo 'FAILED: everywhere: bits.c here'; exit 1; }
    done
fi
bad=0
total=0

# against FILE TYPE WANTED: same, or by how much; "x" before what must not be
against() {
    [ -s "$1" ] || { echo 'x none'; return; }
    if [ "$1" = "$reference/bits-$2.txt" ]; then
        echo reference
    elif cmp -s "$1" "$reference/bits-$2.txt"; then
        if [ "$3" = differs ]; then echo 'x same'; else echo same; fi
    elif out=$("$base/compare" "$1" "$reference/bits-$2.txt") && [ "$3" = differs ]; then
        echo "to $out" | sed 's/,.*//'
    else
        echo "x $(echo "$out" | tail -n 1)"
    fi
}
cell() { case $1 in x*) echo "**${1#x }**" ;; *) echo "$1" ;; esac; }
count() { case $1 in x*) bad=$((bad + 1)) ;; same|to*) total=$((total + 1)) ;; esac; }

row() {
    name=$1
    dir=$base/$name
    target "$name"
    order=- digits=- warned=none tests_cell=- float=- double=-
    shown=$cc
    case $run in qemu*) shown="$cc, $run" ;; node*) shown="$cc, node" ;; esac
    case $(cat "$base/$name.here") in
    no)       echo "| $label | $cc | not here | | | | | |"; return ;;
    compiled) shown="$cc, compiled only" ;;
    linked)   shown="$cc, linked, not run: no ${run%% *}" ;;
    esac
    if [ -s "$dir/machine" ]; then
        order=$(cut -d' ' -f1 "$dir/machine")
        digits="$(cut -d' ' -f2 "$dir/machine") bits"
        [ ! -f "$dir/refused" ] || digits='two doubles: refused'
        [ "$(cut -d' ' -f3 "$dir/machine")" = 2 ] && wanted=differs || wanted=same
        float=$(against "$dir/bits-float.txt" float $wanted)
        double=$(against "$dir/bits-double.txt" double $wanted)
    fi
    warned=$(ls "$dir" | grep -c '^warn.*bad$')
    passed=$(cat "$dir"/test-*.out 2>/dev/null | awk '{ n += $1 } END { print n + 0 }')
    failed=$(ls "$dir" | grep -c '^test-.*bad$')
    [ -z "$tests" ] || tests_cell=$passed
    [ "$failed" = 0 ] || tests_cell="**$passed, $failed programs fail**"
    count "$float"
    count "$double"
    total=$((total + passed + $(ls "$dir" | grep -c '^warn.*out$')))
    bad=$((bad + warned + failed))
    [ "$warned" = 0 ] || warned="**$warned**"
    echo "| $label | $shown | $order | $digits | $warned | $tests_cell |" \
        "$(cell "$float") | $(cell "$double") |"
}

variant_row() {
    name=$(echo "$1" | cut -d'|' -f1) on=$(echo "$1" | cut -d'|' -f2) wanted=$(echo "$1" | cut -d'|' -f4)
    label=$(echo "$1" | cut -d'|' -f5)
    case " $chosen " in *" $on "*) ;; *) return ;; esac
    if [ "$(cat "$base/$on.here" 2>/dev/null)" != yes ]; then
        echo "| $label | not here | |"
        return
    fi
    in_float=$wanted in_double=$wanted
    if [ "$wanted" = 'float differs' ]; then in_float=differs in_double=same; fi
    float=$(against "$base/$on/$name-float.txt" float $in_float)
    double=$(against "$base/$on/$name-double.txt" double $in_double)
    count "$float"
    count "$double"
    echo "| $label | $(cell "$float") | $(cell "$double") |"
}

{
    echo '| machine | compiler | bytes | long double | warnings | tests passed | bits, float | bits, double |'
    echo '|---|---|---|---|---|---|---|---|'
    for name in $chosen; do row "$name"; done
    echo
    for name in $chosen; do
        target "$name"
        # shellcheck disable=SC2086
        [ -z "$less" ] || echo "- $label, $cc, without" $less
    done
    echo
    echo '| compiled otherwise | bits, float | bits, double |'
    echo '|---|---|---|'
    echo "$variants" | { while read -r line; do variant_row "$line"; done; echo "$bad $total" >"$base/sums"; }
} >"$base/table.md"
cat "$base/table.md"
bad=$(cut -d' ' -f1 "$base/sums") total=$(cut -d' ' -f2 "$base/sums")
for name in $chosen; do
    for log in "$base/$name"/*.bad; do
        [ -f "$log" ] || continue
        echo "FAILED: everywhere: ${log#"$base"/}"
        head -n 40 "$log"
    done
done

if [ "$2" = --record ] && [ -z "$ONLY" ]; then
    file=${3:-tests/README.md}
    grep -q '^<!-- everywhere: begin -->$' "$file" && grep -q '^<!-- everywhere: end -->$' "$file" ||
        { echo "FAILED: everywhere: $file has no marks"; exit 1; }
    awk -v table="$base/table.md" '
        /^<!-- everywhere: end -->$/   { off = 0 }
        !off                           { print }
        /^<!-- everywhere: begin -->$/ { off = 1; while ((getline line < table) > 0) print line }
        ' "$file" >"$base/recorded" && cp "$base/recorded" "$file"
fi
[ "$bad" -eq 0 ] || { echo "everywhere: $total passed, $bad failed"; exit 1; }
echo "$total" >"$build/result/everywhere"
echo "everywhere: $total passed, 0 failed"
