#!/bin/sh
# watch.sh FROM_L: by how much the watch of lagrangian.h makes a step longer, in instructions (make from-l)
command -v valgrind >/dev/null || { echo '  skipped: valgrind is not there'; exit; }

count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect=gvi_step "$@" 2>&1 |
        sed -n 's/.*Collected : //p'
}

for name in planet 'five bodies' charge 'double pendulum' 'lesson 41' 'relativistic planet'; do
    without=$(count "$1" "$name" 0)
    with=$(count "$1" "$name" 1)
    awk "BEGIN { printf \"%-22s watch %.1f %%\n\", \"$name\", 100*($with/$without - 1) }"
done
