/* What the tests use of <tgmath.h>, which tcc does not have and glibc's leaves to gcc. */
#ifndef GVI_EVERYWHERE_TGMATH_H
#define GVI_EVERYWHERE_TGMATH_H

#include <math.h>

#define OF_TYPE(name, x) _Generic((x), float: name##f, long double: name##l, default: name)
#define ceil(x)     OF_TYPE(ceil, x)(x)
#define cos(x)      OF_TYPE(cos, x)(x)
#define exp(x)      OF_TYPE(exp, x)(x)
#define fabs(x)     OF_TYPE(fabs, x)(x)
#define floor(x)    OF_TYPE(floor, x)(x)
#define log(x)      OF_TYPE(log, x)(x)
#define log2(x)     OF_TYPE(log2, x)(x)
#define sin(x)      OF_TYPE(sin, x)(x)
#define sqrt(x)     OF_TYPE(sqrt, x)(x)
#define fmax(x, y)  OF_TYPE(fmax, (x) + (y))(x, y)
#define fmod(x, y)  OF_TYPE(fmod, (x) + (y))(x, y)
#define hypot(x, y) OF_TYPE(hypot, (x) + (y))(x, y)
#define pow(x, y)   OF_TYPE(pow, (x) + (y))(x, y)

#endif
