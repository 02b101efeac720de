/* sine.h by the C library.                                                     */
#include "sine.h"
#include <math.h>

GVI_REAL sine(GVI_REAL x)
{
    if (sizeof x == sizeof(float)) return (GVI_REAL)sinf((float)x);
    return sizeof x == sizeof(double) ? (GVI_REAL)sin((double)x) : (GVI_REAL)sinl((long double)x);
}

GVI_REAL cosine(GVI_REAL x)
{
    if (sizeof x == sizeof(float)) return (GVI_REAL)cosf((float)x);
    return sizeof x == sizeof(double) ? (GVI_REAL)cos((double)x) : (GVI_REAL)cosl((long double)x);
}
