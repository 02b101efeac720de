#!/bin/sh
# float.sh BUILD: with GVI_REAL float nothing in gvi.h is computed in double: no call of a double
# helper or of a double function of libm, no double instruction, on Cortex-M4F (single precision
# unit), M7 (double too), M0 (none) and x86-64.  64-bit integer helpers are named, and allowed.
# Control: a product in double must be found out by each check.
build=$1
dir=$build/float
mkdir -p "$dir"
rm -f "$dir"/*
fail() { echo "FAILED: float: $*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }
count=0

echo 'float control(float x); float control(float x) { return (float)((double)x*1.1); }' >"$dir/control.c"

# run-time ABI of ARM, and the names of libgcc and compiler-rt everywhere else
helpers='^__aeabi_(c?d[a-z0-9]+|[a-z]+2d)$|^__[a-z]+df[23]?$|^__[a-z]+df[sdt][fi]2?$'
# functions of math.h without their f
libm='^(sqrt|floor|ldexp|frexp|sin|cos|fabs|scalbn|fma|fmod|rint|round|trunc|ceil|pow|exp|log)$'
integers='^__aeabi_(u?l[a-z]|u?l2f|f2u?lz)|^__[a-z]*(mul|div|mod|shl|shr|cmp)di[23]$'
# what computes, compares or converts; moves and bitwise operations of 64 bits do not
arm='^v?f?[a-z]+\.f64|\.f64\.[a-z0-9]+$|^v[a-z]+\.[a-z0-9]+\.f64$'
x86='^v?(add|sub|mul|div|sqrt|min|max|u?comi|round|rndscale|hadd|hsub|addsub|dp|scalef|reduce|range)(sd|pd)$'
x86="$x86|^v?cmp[a-z_]*(sd|pd)\$|^v?fn?m(add|sub|addsub|subadd)[0-9]*(sd|pd)\$"
x86="$x86|^v?cvt[a-z0-9]*(sd|pd)[a-z0-9]*\$"
x86="$x86|^f(ld|ild|st|stp|add|sub|mul|div|sqrt|com|ucom|chs|abs)[a-z]*\$"

# object: the double operations found, one name a line
doubles() {  # nm objdump pattern object
    "$1" -u "$4" | awk '{ print $NF }' | grep -E "$helpers|$libm"
    "$2" -d --no-show-raw-insn "$4" | awk -F '\t' 'NF > 1 { split($2, a, " "); print a[1] }' |
        grep -E "$3" | grep -v '^vmov\|^vldr\|^vstr' | sort -u
}

check() {  # name nm objdump pattern compiler flags...
    name=$1 nm=$2 objdump=$3 pattern=$4
    shift 4
    if ! have "$1" || ! have "$nm" || ! have "$objdump"; then echo "  skipped: $name, no $1"; return; fi
    "$@" -std=c99 -I. -DGVI_REAL=float -c tests/compile/implementation.c -o "$dir/gvi.o" ||
        fail "$name: compilation"
    "$@" -std=c99 -c "$dir/control.c" -o "$dir/control.o" || fail "$name: compilation"
    out=$(doubles "$nm" "$objdump" "$pattern" "$dir/gvi.o")
    [ -z "$out" ] || fail "$name: in double:" $out
    out=$(doubles "$nm" "$objdump" "$pattern" "$dir/control.o")
    [ -n "$out" ] || fail "$name: the control is not found out"
    whole=$("$nm" -u "$dir/gvi.o" | awk '{ print $NF }' | grep -E "$integers")
    printf '  %-28s nothing; control: %s; 64-bit integers: %s\n' "$name" "$(echo $out)" \
        "$(echo ${whole:-none})"
    count=$((count + 2))
}

# Each level once on each kind of processor: with more optimisation there is less in double, not more, but for what
# vectors bring.
arm() {  # name level flags
    name=$1
    shift
    check "$name $1" arm-none-eabi-nm arm-none-eabi-objdump "$arm" arm-none-eabi-gcc -mthumb "$@"
}
arm Cortex-M4F -Os -mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16
arm 'Cortex-M7, double unit' -O1 -mcpu=cortex-m7 -mfloat-abi=hard -mfpu=fpv5-d16
arm Cortex-M0 -O1 -mcpu=cortex-m0
if [ "$(uname -m)" = x86_64 ]; then
    check "x86-64 gcc -O1" nm objdump "$x86" gcc -O1
    check "x86-64 gcc -O3 -march=native" nm objdump "$x86" gcc -O3 -march=native
    check "x86-64 clang -O2" nm objdump "$x86" clang -O2
else
    echo "  skipped: x86-64, this is $(uname -m)"
fi
echo "float: $count passed, 0 failed"
