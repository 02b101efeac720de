/* A private copy in float; static_double.c has its own, in double. */
#define GVI_REAL float
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"

int float_copy(void);

/* The middle node of three, and the size of the type. */
int float_copy(void)
{
    float c[3], b[3];
    if (gvi_gauss(3, c, b)) return -1;
    return c[1] < 0.51f && c[1] > 0.49f ? (int)sizeof(gvi_real) : -2;
}
