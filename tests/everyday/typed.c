/* typed.c - the laws of typed.h in C: derivatives by complex steps */
#include "typed.h"

TYPED(c, kepler)
TYPED(c, double_pendulum)
TYPED(c, charge)
