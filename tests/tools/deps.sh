#!/bin/sh
# Installs what the tests need, with the package manager that is there.
# deps.sh: cmocka, which is all that `make test` needs
# deps.sh --check: clang, g++, valgrind, for `make check`; what cannot be had is skipped there
# deps.sh --cmocka only says whether cmocka can be compiled against; deps.sh --compare installs the
# libraries that `make cost-peers` compares with; deps.sh --firmware the compilers for small machines
# and the emulator that `make firmware size` needs; deps.sh --ensemble an MPI.

CC=${CC:-cc}

have_cmocka() {
    printf '#include <setjmp.h>\n#include <stdarg.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <cmocka.h>\n' |
        $CC $(pkg-config --cflags cmocka 2>/dev/null) -x c -fsyntax-only - 2>/dev/null
}
have() { command -v "$1" >/dev/null 2>&1; }

if [ "$1" = --cmocka ]; then
    have_cmocka && exit 0
    echo "The tests need cmocka, which $CC does not find.  \"make deps\" installs it." >&2
    exit 1
fi

# names: cmocka clang g++ valgrind, - for what does not exist or comes with the system
if   have apt-get; then manager=apt-get; names='libcmocka-dev clang g++ valgrind'
elif have dnf;     then manager=dnf;     names='libcmocka-devel clang gcc-c++ valgrind'
elif have pacman;  then manager=pacman;  names='cmocka clang gcc valgrind'
elif have apk;     then manager=apk;     names='cmocka-dev clang g++ valgrind'
elif have brew;    then manager=brew;    names='cmocka - - -'
else                    manager=none;    names='cmocka clang g++ valgrind'
fi
compare=no check=no
[ "$1" = --check ] && check=yes
if [ "$1" = --compare ]; then
    compare=yes
    case $manager in
    apt-get) libraries='libgsl-dev libsundials-dev libboost-dev g++' ;;
    dnf)     libraries='gsl-devel sundials-devel boost-devel gcc-c++' ;;
    pacman)  libraries='gsl sundials boost gcc' ;;
    brew)    libraries='gsl sundials boost' ;;
    *)       echo "deps: please install by hand: GSL, SUNDIALS, Boost, a C++ compiler" >&2; exit 1 ;;
    esac
fi
if [ "$1" = --firmware ]; then
    compare=yes
    case $manager in
    apt-get) libraries='gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
                        gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf gcc-avr avr-libc' ;;
    dnf)     libraries='arm-none-eabi-gcc-cs arm-none-eabi-newlib qemu-system-arm avr-gcc avr-libc' ;;
    pacman)  libraries='arm-none-eabi-gcc arm-none-eabi-newlib qemu-system-arm avr-gcc avr-libc' ;;
    brew)    libraries='gcc-arm-embedded qemu coreutils' ;;
    *)       echo "deps: please install by hand: arm-none-eabi-gcc with newlib, qemu-system-arm" >&2; exit 1 ;;
    esac
fi
if [ "$1" = --ensemble ]; then
    have mpicc && have mpirun && { echo "deps: mpicc is there"; exit 0; }
    compare=yes
    case $manager in
    apt-get) libraries=libopenmpi-dev ;;
    dnf)     libraries=openmpi-devel ;;
    apk)     libraries='openmpi openmpi-dev' ;;
    pacman|brew) libraries=openmpi ;;
    *)       echo "deps: please install by hand: Open MPI or MPICH" >&2; exit 1 ;;
    esac
fi
set -- $names
needed=; welcome=
have_cmocka || needed=$1
if [ $check = yes ]; then
    have clang || welcome="$welcome $2"
    have g++ || welcome="$welcome $3"
    have valgrind || welcome="$welcome $4"
fi
welcome=$(echo $welcome | tr ' ' '\n' | grep -v '^-$' | tr '\n' ' ')

if [ $compare = no ] && [ -z "$needed" ] && [ -z "$(echo $welcome)" ]; then
    echo "deps: everything is there"
    exit 0
fi

# root, or sudo, or nothing
sudo=
if [ "$manager" != brew ] && [ "$(id -u)" != 0 ]; then
    if have sudo; then sudo=sudo; else manager=none; fi
fi
install() {
    case $manager in
    apt-get) $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" ;;
    dnf)     $sudo dnf install -y "$@" ;;
    pacman)  $sudo pacman -S --noconfirm --needed "$@" ;;
    apk)     $sudo apk add "$@" ;;
    brew)    brew install "$@" ;;
    *)       return 1 ;;
    esac
}

if [ $compare = yes ]; then
    if [ "$manager" = apt-get ]; then $sudo apt-get update || true; fi
    install $libraries
    exit
fi

if [ "$manager" = none ]; then
    if [ -z "$needed" ]; then
        echo "deps: cmocka is there; not there, and what needs it will be skipped: $welcome"
        exit 0
    fi
    echo "deps: cannot install anything: no known package manager, or neither root nor sudo." >&2
    echo "deps: please install by hand: cmocka (needed); welcome: $welcome" >&2
    exit 1
fi

echo "deps: installing with $manager: $needed $welcome"
case $manager in
apt-get) $sudo apt-get update || echo "deps: apt-get update failed, trying with the lists that are there" ;;
pacman)  $sudo pacman -Sy --noconfirm ;;
esac
if [ -n "$needed" ]; then
    install "$needed"
    if ! have_cmocka; then
        echo "deps: cmocka could not be installed" >&2
        exit 1
    fi
fi
for package in $welcome; do
    install "$package" || echo "deps: $package could not be installed; what needs it will be skipped"
done
echo "deps: done"
