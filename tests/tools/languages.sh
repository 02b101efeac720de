#!/bin/sh
# languages.sh BUILD: the examples of docs/languages.md, each where its tool is there; all print what the README's
# program prints.  Python's structures have the layout of the C compiler's.
build=$1
dir=$build/languages from=$(pwd)/examples/languages count=0
CC=${CC:-cc}
mkdir -p "$dir"
rm -rf "${dir:?}"/*
fail() { echo "FAILED: languages: $*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }
wanted='ok: q = -0.602737580 0.799997002'
prints() {  # name output
    [ "$(echo "$2" | sed -n 1p)" = "$wanted" ] || fail "$1 prints: $2"
    echo "  $1"
    count=$((count + 1))
}

$CC -O2 -fPIC -DGVI_IMPLEMENTATION -xc -c gvi.h -o "$dir/gvi.o" || fail "gvi.o"
python=
for p in /usr/bin/python3 python3; do
    if [ -z "$python" ] && have $p && $p -c 'import numpy' 2>/dev/null; then python=$p; fi
done
if [ -n "$python" ]; then
    export XDG_CACHE_HOME="$dir/cache" PYTHONPATH="$from" PYTHONDONTWRITEBYTECODE=1
    [ "$(wc -l <"$from/gvi.py")" -le 400 ] || fail "gvi.py: more than 400 lines"
    $python -c 'if 1:
        import ctypes, gvi
        for name, s in vars(gvi).items():
            if isinstance(s, type) and issubclass(s, ctypes.Structure):
                for field, _ in s._fields_:
                    if field != "later": print(name, field, getattr(s, field).offset)' >"$dir/layout.python" || fail "gvi.py: layout"
    { printf '#include "gvi.h"\n#include <stdio.h>\nint main(void)\n{\n'
      sed 's/\(.*\) \(.*\) .*/    printf("\1 \2 %d\\n", (int)offsetof(\1, \2));/' "$dir/layout.python"
      printf '    return 0;\n}\n'; } >"$dir/layout.c"
    $CC -I. "$dir/layout.c" -o "$dir/layout" && "$dir/layout" | diff - "$dir/layout.python" || fail "the layout of gvi.py"
    # every function of gvi.h is called from gvi.py: by "name", or as gvi_name; those of its last part by plain()
    for name in $(sed -n 's/^GVI_DEF .*[ *]gvi_\([a-z_]*\)(.*/\1/p' gvi.h | sed '/^gauss$/,$d'); do
        grep -q "\"$name\"\|gvi_$name\b" "$from/gvi.py" || fail "gvi.py has no gvi_$name"
    done
    count=$((count + 3))
    agrees() {  # name program: prints what its opening comment says
        $python "$from/$2" >"$dir/$2.out" 2>"$dir/$2.err" || { cat "$dir/$2.err"; fail "$2"; }
        awk '/^prints$/ { on = 1; getline; next } /^"""$/ { exit } on' "$from/$2" | diff - "$dir/$2.out" || fail "$2"
        echo "  $1"
        count=$((count + 1))
    }
    agrees "Python, gvi.py" planet.py
    agrees "Python, 1,000 asteroids" asteroids.py
    # to the letter: gvi.py, gvi.h and the tools in a folder of their own
    mkdir -p "$dir/alone/tools" && cp gvi.h $from/gvi.py $from/lagrangian.py "$dir/alone" && cp examples/tools/lagrangian.h "$dir/alone/tools"
    from=$dir/alone PYTHONPATH=$dir/alone
    agrees "Python, a Lagrangian" lagrangian.py
    # what docs/languages.md shows first, and what it says of it
    awk '/^```python$/ && !k++ { on = 1; next } /^```$/ { on = 0 } on' docs/languages.md >"$dir/page.py"
    said=$(sed -n 's/.*pendulum prints `\(.*\)`:.*/\1/p' docs/languages.md)
    [ -n "$said" ] && [ "$($python "$dir/page.py")" = "$said" ] || fail "docs/languages.md: the first snippet does not print $said"
    from=$(pwd)/examples/languages PYTHONPATH=$from
    if $python -c 'import matplotlib' 2>/dev/null; then
        for name in planet asteroids lagrangian; do
            $python $from/$name.py "$dir/$name.png" >/dev/null && [ -s "$dir/$name.png" ] || fail "$name.png"
            count=$((count + 1))
        done
    else echo "  skipped: no matplotlib"; fi
else echo "  skipped: no python3 with numpy"; fi

if have rustc && rustc --version >/dev/null 2>&1; then
    ar rcs "$dir/libgvi.a" "$dir/gvi.o" &&
        rustc -O -A dead_code $from/planet.rs -L "$dir" -l static=gvi -l m -o "$dir/planet-rs" || fail "planet.rs"
    prints "Rust" "$("$dir/planet-rs")"
else echo "  skipped: no rustc"; fi

if have clang && have node && echo '#include <math.h>
int x;' | clang --target=wasm32-wasi -mexec-model=reactor -xc - -o "$dir/probe.wasm" 2>/dev/null; then
    clang --target=wasm32-wasi -mexec-model=reactor -O1 -I. $from/planet.c -o "$dir/planet.wasm" || fail "planet.c"
    prints "JavaScript, WebAssembly" "$(node $from/planet.mjs "$dir/planet.wasm")"
else echo "  skipped: no clang for wasm32-wasi, or no node"; fi

if have mkoctfile && have octave-cli; then
    (root=$(pwd); cd "$dir" && mkoctfile --mex "-I$root" "$from/gvi_run.c" -o gvi_run.mex) >"$dir/mex.log" 2>&1 || { cat "$dir/mex.log"; fail "gvi_run.c"; }
    prints "Octave (MATLAB's MEX)" "$(cd "$dir" && octave-cli --norc -q "$from/planet.m" 2>&1)"
else echo "  skipped: no octave with mkoctfile"; fi
echo "languages: $count passed, 0 failed"
