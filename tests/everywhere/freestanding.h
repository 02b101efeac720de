/* The mathematics of a program without a C library, given to gvi.h by its macros,
   in the type of GVI_REAL, float or double in IEEE format:
     sqrt         correctly rounded: the root of an integer, digit by digit
     floor, ldexp, frexp   exact, by the bits of the number                       */
#ifndef GVI_FREESTANDING_H
#define GVI_FREESTANDING_H

#include <stdint.h>

#define OWN_FLOAT_float     1
#define OWN_FLOAT_double    0
#define OWN_PASTE2(a, b)    a##b
#define OWN_PASTE(a, b)     OWN_PASTE2(a, b)
#if OWN_PASTE(OWN_FLOAT_, GVI_REAL)
typedef float  own_real;
typedef uint32_t own_word;
#define OWN_FRACTION 23                           /* bits behind the point */
#define OWN_BIAS     127
#else
typedef double own_real;
typedef uint64_t own_word;
#define OWN_FRACTION 52
#define OWN_BIAS     1023
#endif
#define OWN_ONE  ((own_word)1 << OWN_FRACTION)
#define OWN_LAST (2*OWN_BIAS + 1)                 /* exponent of Inf and NaN */

typedef union own_both { own_real value; own_word bits; } own_both;

static own_real own_abs(own_real x)
{
    own_both z;
    z.value = x;
    z.bits &= ~((own_word)1 << (8*sizeof(own_word) - 1));
    return z.value;
}

static int own_exponent(own_real x)               /* 0: zero and subnormals */
{
    own_both z;
    z.value = x;
    return (int)(z.bits >> OWN_FRACTION) & OWN_LAST;
}

static own_real own_power(int e)                  /* 2^e, normal */
{
    own_both z;
    z.bits = (own_word)(e + OWN_BIAS) << OWN_FRACTION;
    return z.value;
}

static own_real own_frexp(own_real x, int *e)
{
    own_both z;
    *e = 0;
    if (!(own_abs(x) > 0) || own_exponent(x) == OWN_LAST) return x;
    int lift = own_exponent(x) ? 0 : OWN_FRACTION + 1;
    z.value = lift ? x*own_power(lift) : x;
    *e = own_exponent(z.value) - OWN_BIAS + 1 - lift;
    z.bits = (z.bits & ~((own_word)OWN_LAST << OWN_FRACTION)) | (own_word)(OWN_BIAS - 1) << OWN_FRACTION;
    return z.value;
}

/* One rounding: all factors but the last are exact */
static own_real own_ldexp(own_real x, int e)
{
    const int most = OWN_BIAS, least = OWN_FRACTION + 2 - OWN_BIAS;
    for (; e > most; e -= most) x *= own_power(most);
    for (; e < 1 - OWN_BIAS; e -= least) x *= own_power(least);
    return x*own_power(e);
}

static own_real own_floor(own_real x)
{
    own_both z;
    const int places = OWN_FRACTION + OWN_BIAS - own_exponent(x);         /* bits behind the point of x */
    if (places <= 0) return x;
    z.value = x;
    if (places > OWN_FRACTION) z.value = 0;
    else z.bits &= ~(((own_word)1 << places) - 1);
    return z.value > x ? z.value - 1 : z.value;
}

/* x = m 4^k with 1/4 <= m < 1; the root of m digit by digit from two digits of m each,
   one more than fits, and a last one for what is left: the conversion rounds.     */
static own_real own_sqrt(own_real x)
{
    const int places = (OWN_FRACTION + 3)/2*2;
    int e;
    if (!(x > 0) || own_exponent(x) == OWN_LAST) return x < 0 ? (x - x)/(x - x) : x;
    own_real m = own_frexp(x, &e);
    if (e & 1) m /= 2, ++e;
    own_word digits = (own_word)(m*own_power(places)), rest = 0, root = 0;
    for (int k = 1; k <= OWN_FRACTION + 2; ++k) {
        const int place = places - 2*k;
        rest = rest << 2 | (place >= 0 ? digits >> place & 3u : 0);
        root <<= 1;
        if (rest > 2*root) rest -= 2*root + 1, root += 1;
    }
    root = root << 1 | (rest > 0);
    return own_ldexp((own_real)root, e/2 - OWN_FRACTION - 3);
}

#define GVI_SQRT(x)     own_sqrt(x)
#define GVI_ABS(x)      own_abs(x)
#define GVI_FLOOR(x)    own_floor(x)
#define GVI_LDEXP(x, e) own_ldexp(x, e)
#define GVI_FREXP(x, e) own_frexp(x, e)

#endif
