/* typed.cpp - the laws of typed.h in C++: derivatives by dual numbers */
#include "typed.h"

extern "C" {
TYPED(cxx, kepler)
TYPED(cxx, double_pendulum)
TYPED(cxx, charge)
}
