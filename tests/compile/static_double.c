/* A private copy in double; static_float.c has its own, in float. */
#define GVI_REAL double
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"

int double_copy(void);

/* The middle node of three, and the size of the type. */
int double_copy(void)
{
    double c[3], b[3];
    if (gvi_gauss(3, c, b)) return -1;
    return c[1] < 0.51 && c[1] > 0.49 ? (int)sizeof(gvi_real) : -2;
}
