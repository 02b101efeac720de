/* sine.h by sums and products alone, each of them rounded as IEEE 754 says: the
   same bits everywhere with -ffp-contract=off.  Float and double, |x| to 8000.  */
#include "sine.h"

#define OVER(k) (GVI_REAL)(1.0/((k)*((k) + 1)))

static const GVI_REAL over[] = { 0,       OVER(1),  OVER(2),  OVER(3),  OVER(4),  OVER(5),  OVER(6),
                                 OVER(7), OVER(8),  OVER(9),  OVER(10), OVER(11), OVER(12), OVER(13),
                                 OVER(14), OVER(15), OVER(16), OVER(17), OVER(18) };

/* 1 - r^2/(k(k+1)) (1 - r^2/((k+2)(k+3)) (1 - ...)): cosine from k = 1, sine/r from 2.
   What is left out of 9 terms is below 1e-17 for |r| <= pi/4.                   */
static GVI_REAL series(GVI_REAL r, int k)
{
    GVI_REAL sum = 1;
    for (int j = k + 16; j >= k; j -= 2) sum = 1 - r*r*over[j]*sum;
    return sum;
}

/* x = r + turns pi/2.  Of the pieces of pi/2 the first two have 8 and 11 bits, so
   that their products with turns are exact.                                     */
static GVI_REAL shifted_sine(GVI_REAL x, int turns)
{
    const GVI_REAL half = (GVI_REAL)0.5, at = x*(GVI_REAL)0.63661977236758134308;
    const int nearest = (int)(at < 0 ? at - half : at + half);
    const GVI_REAL whole = (GVI_REAL)nearest;
    const GVI_REAL r = ((x - whole*(GVI_REAL)1.5703125) - whole*(GVI_REAL)4.83751296997070312e-4)
                     - whole*(GVI_REAL)7.54978995489188211e-8;
    turns += nearest;
    const GVI_REAL y = turns & 1 ? series(r, 1) : r*series(r, 2);
    return turns & 2 ? -y : y;
}

GVI_REAL sine(GVI_REAL x) { return shifted_sine(x, 0); }

GVI_REAL cosine(GVI_REAL x) { return shifted_sine(x, 1); }
