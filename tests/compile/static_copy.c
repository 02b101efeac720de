/* A private copy of the library in the type COPY, float or double, for static_main.c */
#define GVI_REAL COPY
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"

#define NAMED(type) type##_copy
#define NAME(type)  NAMED(type)
int NAME(COPY)(void);

/* The middle node of three, and the size of the type. */
int NAME(COPY)(void)
{
    COPY c[3], b[3];
    if (gvi_gauss(3, c, b)) return -1;
    return c[1] < (COPY)0.51 && c[1] > (COPY)0.49 ? (int)sizeof(gvi_real) : -2;
}
