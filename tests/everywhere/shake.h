/* Sines that are off by SHAKE units in the last place, in the type of GVI_REAL; the
   other functions as they are.  For bits.c: do the last digits of sin matter?    */
#include <math.h>

#define SHAKE_FLOAT_float   1
#define SHAKE_FLOAT_double  0
#define SHAKE_PASTE2(a, b)  a##b
#define SHAKE_PASTE(a, b)   SHAKE_PASTE2(a, b)
#if SHAKE_PASTE(SHAKE_FLOAT_, GVI_REAL)
#define GVI_SQRT(x)         sqrtf(x)
#define GVI_SIN(x)          (sinf(x)*(1 + (SHAKE)*0x1p-23f))
#define GVI_ABS(x)          fabsf(x)
#define GVI_FLOOR(x)        floorf(x)
#define GVI_LDEXP(x, e)     ldexpf(x, e)
#define GVI_FREXP(x, e)     frexpf(x, e)
#else
#define GVI_SQRT(x)         sqrt(x)
#define GVI_SIN(x)          (sin(x)*(1 + (SHAKE)*0x1p-52))
#define GVI_ABS(x)          fabs(x)
#define GVI_FLOOR(x)        floor(x)
#define GVI_LDEXP(x, e)     ldexp(x, e)
#define GVI_FREXP(x, e)     frexp(x, e)
#endif
