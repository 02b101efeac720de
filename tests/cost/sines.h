#ifndef SINES_H
#define SINES_H

#define INLINE static inline __attribute__((always_inline))

/* sin and cos without a branch or a call, the same for one point and for many: x = k pi/2 + r, pi/2 in
   33 + 53 bits, and Taylor's series on |r| <= pi/4, cut where the next term is below 1e-19.
   Error below 1.5 ulp for |x| < 1e5 (largest seen in 2e7 arguments).  Adding and taking away 3/2 2^52 rounds to
   a whole number, a quarter less rounds down what has no more than a half behind the point.   */
INLINE double whole(double x) { return (x + 0x1.8p52) - 0x1.8p52; }

INLINE void sine_and_cosine(double x, double *sine, double *cosine)
{
    double k = whole(x*0x1.45f306dc9c883p-1), h = 0.5*k, g = whole(h - 0.25), e = 0.5*g;
    double r = (x - k*0x1.921fb544p+0) - k*0x1.0b4611a626331p-34, z = r*r, z2 = z*z, z4 = z2*z2;
    double s = ((-1/6.0 + z/120) + z2*(-1/5040.0 + z*(1/362880.0)))
             + z4*((-1/39916800.0 + z*(1/6227020800.0)) + z2*(-1/1307674368e3 + z*(1/355687428096e3)));
    double c = ((1/24.0 - z*(1/720.0)) + z2*(1/40320.0 - z*(1/3628800.0)))
             + z4*((1/479001600.0 - z*(1/87178291200.0)) + z2*(1/20922789888e3));
    s = r + r*z*s;
    c = 1 - (0.5*z - z2*c);
    double odd = 2*(h - g), less = 1 - 4*(e - whole(e - 0.25));     // k odd: 1; sign of sin: 1 or -1
    double a = odd > 0.5 ? c : s, b = odd > 0.5 ? -s : c;
    *sine = less*a;
    *cosine = less*b;
}

#endif
