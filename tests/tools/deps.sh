#!/bin/sh
# Installs, with the package manager that is there, what a target needs.
# deps.sh             cmocka, which is all that `make test` needs
# deps.sh --check     also what `make check` uses if it can be had, and skips if not
# deps.sh --firmware  the compilers and the emulator of `make firmware size`
# deps.sh --ensemble  the MPI of `make ensemble`
# deps.sh --header    the unifdef of `make header`, the cppcheck of `make misra`
# deps.sh --cmocka    installs nothing: can cmocka be compiled against?

have() { command -v "$1" >/dev/null 2>&1; }
have_cmocka() {
    printf '#include <setjmp.h>\n#include <stdarg.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <cmocka.h>\n' |
        ${CC:-cc} $(pkg-config --cflags cmocka 2>/dev/null) -x c -fsyntax-only - 2>/dev/null
}
if [ "$1" = --cmocka ]; then
    have_cmocka && exit
    echo "The tests need cmocka, which ${CC:-cc} does not find.  \"make deps\" installs it." >&2
    exit 1
fi

cmocka=none
if have apt-get; then
    manager=apt-get install='env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends'
    cmocka=libcmocka-dev mingw=gcc-mingw-w64-x86-64 cxx=g++ mpi=libopenmpi-dev numpy=python3-numpy
    firmware='gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm gcc-riscv64-unknown-elf
              picolibc-riscv64-unknown-elf gcc-avr avr-libc simavr'
elif have dnf; then
    manager=dnf install='dnf install -y' cmocka=libcmocka-devel mingw=mingw64-gcc cxx=gcc-c++ mpi=openmpi-devel numpy=python3-numpy
    firmware='arm-none-eabi-gcc-cs arm-none-eabi-newlib qemu-system-arm avr-gcc avr-libc'
elif have pacman; then
    manager=pacman install='pacman -S --noconfirm --needed' cmocka=cmocka mingw=mingw-w64-gcc cxx=gcc mpi=openmpi numpy=python-numpy
    firmware='arm-none-eabi-gcc arm-none-eabi-newlib qemu-system-arm avr-gcc avr-libc'
elif have apk; then
    manager=apk install='apk add' cmocka=cmocka-dev mingw=mingw-w64-gcc cxx=g++ mpi='openmpi openmpi-dev' numpy=py3-numpy
elif have brew; then
    manager=brew install='brew install' cmocka=cmocka mingw=mingw-w64 mpi=open-mpi
    firmware='gcc-arm-embedded qemu coreutils'
fi
welcome=
case $1 in
--firmware) needed=${firmware:-none} by_hand='arm-none-eabi-gcc with newlib, qemu-system-arm' ;;
--ensemble) needed=${mpi:-none} by_hand='Open MPI or MPICH'
            if echo '#include <mpi.h>' | mpicc -x c -fsyntax-only - 2>/dev/null && have mpirun; then needed=; fi ;;
--header)   needed='unifdef cppcheck' by_hand='unifdef, cppcheck'
            if have unifdef && have cppcheck; then needed=; fi ;;
*)          needed=$cmocka by_hand=cmocka
            if have_cmocka; then needed=; fi ;;
esac
if [ "$1" = --check ]; then
    for pair in clang:clang g++:$cxx unifdef:unifdef valgrind:valgrind cmake:cmake pkg-config:pkg-config x86_64-w64-mingw32-gcc:$mingw; do
        have ${pair%%:*} || welcome="$welcome ${pair#*:}"
    done
    { have /usr/bin/python3 && /usr/bin/python3 -c 'import numpy' 2>/dev/null; } || welcome="$welcome ${numpy:-}"
fi
if [ -z "$needed$welcome" ]; then
    echo "deps: everything is there"
    exit
fi
sudo=
if [ "$(id -u)" != 0 ] && [ "$manager" != brew ]; then
    if have sudo; then sudo=sudo; else manager=; fi
fi
if [ -z "$manager" ] || [ "$needed" = none ]; then
    echo "deps: no known package manager, or neither root nor sudo.  Please install by hand: ${needed:+$by_hand (needed)}$welcome" >&2
    [ -z "$needed" ]
    exit
fi
echo "deps: installing with $manager:" $needed $welcome
case $manager in
apt-get) $sudo apt-get update || echo "deps: apt-get update failed, trying with the lists that are there" ;;
pacman)  $sudo pacman -Sy --noconfirm ;;
esac
if [ -n "$needed" ]; then $sudo $install $needed || exit; fi
for package in $welcome; do
    $sudo $install $package || echo "deps: $package could not be installed; what needs it will be skipped"
done
case $1 in ''|--check) have_cmocka || { echo "deps: cmocka could not be installed" >&2; exit 1; } ;; esac
