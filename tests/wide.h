/* wide.h - what a test expects in twice the digits of gvi_real, or as many as there are; after gvi_test.h

   WIDEST defined before it: the most digits there are for double too, at the price of time. */
#ifndef TESTS_WIDE_H
#define TESTS_WIDE_H

#ifdef __clang__
#pragma clang diagnostic ignored "-Wdouble-promotion"    /* widening is the purpose here */
#endif

#if defined(__SIZEOF_FLOAT128__) && (GVI__KIND == 3 || defined(WIDEST))
__extension__ typedef __float128 wide;
#define WIDE_DIG 113
#define WIDE_EPS 1.9e-34L
#else
typedef long double wide;
#define WIDE_DIG LDBL_MANT_DIG
#define WIDE_EPS LDBL_EPSILON
#endif
#define WIDE_IS_WIDER (WIDE_DIG > DIG)
#define UNIT ((wide)EPS/2)                      /* unit roundoff */

static wide wide_abs(wide x) { return x < 0 ? -x : x; }

/* Equal once both are rounded to gvi_real, which registers may put off (x87). */
static int same(gvi_real one, gvi_real other)
{
    volatile gvi_real u = one, v = other;
    return u <= v && u >= v;
}

static unsigned long long seed;
static __attribute__((unused)) unsigned random_bits(void)
{
    seed = seed*6364136223846793005ULL + 1442695040888963407ULL;
    return (unsigned)(seed >> 32);
}
static __attribute__((unused)) gvi_real random_unit(void)               /* in (-1,1) */
{
    return (gvi_real)(((long double)random_bits() - 2147483647.5L)/2147483648.0L);
}

#endif
