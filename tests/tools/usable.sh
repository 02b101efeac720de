#!/bin/sh
# usable.sh BUILD: what `make install` puts where, the tools in C and C++20, and the ways into a project that the guide
# names: pkg-config, CMake (the guide's own lines), a C++ sketch beside a C file as the Arduino IDE and PlatformIO compile them.
dir=$1/install
rm -rf "$dir"
mkdir -p "$dir/cmake/third_party/gvi" "$dir/sketch"
fail() { echo "FAILED: usable: $*"; exit 1; }
have() { command -v "$1" >/dev/null 2>&1; }
runs() { "$1" | diff - "$dir/wanted" || fail "$1"; count=$((count + 1)); }
sh tests/tools/examples.sh expected examples/01_kepler.c >"$dir/wanted"
count=1

make -s install DESTDIR="$dir/stage" PREFIX=/opt >/dev/null && cmp gvi.h "$dir/stage/opt/include/gvi.h" || fail "gvi.h"
for tool in examples/tools/*.h; do
    cmp "$tool" "$dir/stage/opt/include/gvi/$(basename "$tool")" || fail "$tool"
    grep -q "^\*\*.*$(basename "$tool")\|^| \[$(basename "$tool")\]" docs/tools.md || fail "docs/tools.md does not list $tool"
    count=$((count + 1))
done
licence=$dir/stage/opt/share/doc/gvi/LICENSE
[ "$(sed -n 1p "$licence")" = 'This software is available under two licences: choose the one you prefer.' ] && grep -q '^A. MIT$' "$licence" &&
    grep -q '^B. Public domain (unlicense.org)$' "$licence" && sed -n '$p' "$licence" | grep -q 'DEALINGS IN THE SOFTWARE\.$' || fail "the licence"
count=$((count + 1))
for compile in "${CC:-cc} -std=c99 -Wall -Wextra -Wpedantic -Werror -xc" "${CXX:-c++} -std=c++20 -Wall -Werror -xc++"; do
    have "${compile%% *}" || { echo "  skipped: no ${compile%% *}"; continue; }
    $compile -O1 -I"$dir/stage/opt/include" tests/compile/tools.c -o "$dir/tools" -lm && "$dir/tools" || fail "tools: $compile"
    count=$((count + 1))
done
make -s mycost BUILD="$dir" FILE=tests/compile/mine.c >"$dir/mycost.out" && grep -q '^degree 8 ' "$dir/mycost.out" &&
    grep -q '^the dial ' "$dir/mycost.out" && [ -s "$dir/mycost.svg" ] || fail "make mycost"
make -s mycost BUILD="$dir" FILE=tests/compile/mycost_orbit.c | grep -q '^degree 8 ' || fail "make mycost, rows of effects.h"
count=$((count + 1))
if have pkg-config; then
    export PKG_CONFIG_PATH="$dir/stage/opt/share/pkgconfig"
    [ "$(pkg-config --modversion gvi)" = "$(sed -n 's/^#define GVI_VERSION "\(.*\)"/\1/p' gvi.h)" ] || fail "version in gvi.pc"
    sed 's/#include "gvi.h"/#include <gvi.h>/' examples/01_kepler.c >"$dir/kepler.c"
    ${CC:-cc} -std=c99 $(pkg-config --define-variable=prefix="$dir/stage/opt" --cflags gvi) "$dir/kepler.c" \
        $(pkg-config --libs gvi) -o "$dir/kepler" || fail "pkg-config"
    runs "$dir/kepler"
else echo "  skipped: no pkg-config"; fi

if have cmake; then
    cp gvi.h "$dir/cmake/third_party/gvi"
    cp examples/01_kepler.c "$dir/cmake"
    { echo 'cmake_minimum_required(VERSION 3.5)'
      echo 'project(app C)'
      sed -n '/^```cmake$/,/^```$/{/^```/!p;}' docs/guide.md
      echo 'add_executable(app 01_kepler.c)'
      echo 'target_link_libraries(app PRIVATE gvi)'; } >"$dir/cmake/CMakeLists.txt"
    { cmake -S "$dir/cmake" -B "$dir/cmake/build" && cmake --build "$dir/cmake/build"; } >"$dir/cmake.log" 2>&1 ||
        { cat "$dir/cmake.log"; fail "cmake"; }
    runs "$dir/cmake/build/app"
    # as installed, and as fetched: the guide's lines
    app() {  # name lines options...
        name=$1 lines=$2
        shift 2
        mkdir -p "$dir/$name"
        sed 's/#include "gvi.h"/#include <gvi.h>/' examples/01_kepler.c >"$dir/$name/kepler.c"
        { echo 'cmake_minimum_required(VERSION 3.14)'
          echo 'project(app C)'
          echo 'add_executable(app kepler.c)'
          printf '%s\n' "$lines"; } >"$dir/$name/CMakeLists.txt"
        { cmake -S "$dir/$name" -B "$dir/$name/build" "$@" && cmake --build "$dir/$name/build"; } >"$dir/$name.log" 2>&1 &&
            runs "$dir/$name/build/app"
    }
    found=$(sed -n '/^    find_package/,/^$/p' docs/guide.md)
    version=$(sed -n 's/^#define GVI_VERSION "\(.*\)"/\1/p' gvi.h)
    app found "$found" "-DCMAKE_PREFIX_PATH=$(pwd)/$dir/stage/opt" || { cat "$dir/found.log"; fail "find_package"; }
    app version "$(echo "$found" | sed "s/gvi REQ/gvi $version REQ/")" "-DCMAKE_PREFIX_PATH=$(pwd)/$dir/stage/opt" || fail "find_package(gvi $version)"
    for other in 0.1 99; do
        ! app "other$other" "$(echo "$found" | sed "s/gvi REQ/gvi $other REQ/")" "-DCMAKE_PREFIX_PATH=$(pwd)/$dir/stage/opt" ||
            fail "find_package(gvi $other) finds $version"
    done
    # to the letter: the clone is beside the project, its branch is main
    lines=$(sed -n '/^    set(GVI_REPOSITORY/,/^$/p' docs/guide.md; echo 'target_link_libraries(app PRIVATE gvi m)')
    rm -rf "$dir/gvi"
    if git clone -q . "$dir/gvi" 2>/dev/null && git -C "$dir/gvi" checkout -q -B main; then
        app fetched "$lines" || { cat "$dir/fetched.log"; fail "FetchContent"; }
    else
        app fetched "$lines" "-DFETCHCONTENT_SOURCE_DIR_GVI=$(pwd)" || { cat "$dir/fetched.log"; fail "FetchContent"; }
    fi
else echo "  skipped: no cmake"; fi

if have "${CXX:-c++}"; then
    { sed -n 's/^    \(extern "C" .*\)/\1/p' docs/guide.md
      echo 'int main() { return pendulum_start() || pendulum_period(); }'; } >"$dir/sketch/sketch.cpp"
    ${CC:-cc} -std=gnu11 -Os -I. -c tests/compile/embedded.c -o "$dir/sketch/pendulum.o" &&
        ${CXX:-c++} -std=gnu++11 "$dir/sketch/sketch.cpp" "$dir/sketch/pendulum.o" -o "$dir/sketch/sketch" -lm &&
        "$dir/sketch/sketch" || fail "a C++ sketch beside a C file"
    count=$((count + 1))
else echo "  skipped: no C++ compiler"; fi
echo "usable: $count passed, 0 failed"
