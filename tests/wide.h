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

#endif
