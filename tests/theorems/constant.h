/* constant.h - the leading term of L_d - L_exact as docs/theory.md has it, for f = 0:

     u < 2s - 2   -kappa^2 X h^(2 sigma + 1) P^(sigma) . M^-1 P^(sigma)/2            (weakness() in rules.h)
     u > 2s       (s!)^2/(2 (2s)!^2 (2s + 1)) h^(2s + 1) q^(s+1) . M q^(s+1)

   with derivatives of the solution, from the reference, in the middle of the step. */
#ifndef CONSTANT_H
#define CONSTANT_H

#include "bench.h"

static MAYBE real leading_term(const problem *pb, const own_rule *rule, int s, int start, real h)
{
    const int sigma = velocity_expected(s, rule->u), strong = rule->u > 2*s;
    real d[2*MAX_N], power = h;
    derivative_in_time(pb, start, strong ? s + 1 : sigma, d);
    for (int k = 0; k < 2*sigma; ++k) power *= h;
    if (!strong) return -weakness(rule, s)*power*inverse_mass_of(pb, start, d + pb->n)/2;
    const real part = factorial(s)/factorial(2*s);
    return part*part*power*mass_of(pb, start, d)/(2*(2*s + 1));
}

/* Measured over predicted, of the start where they differ most */
static MAYBE real constant_seen(const problem *pb, const own_rule *rule, int s, real h)
{
    const method m = { s, rule_or_own(GVI_OWN, rule->r, rule) };
    real worst = 1;
    for (int start = 0; start < STARTS; ++start) {
        const real seen = lagrangian_excess(pb, &m, start, h)/leading_term(pb, rule, s, start, h);
        if (!(fabs(seen - 1) <= fabs(worst - 1))) worst = seen;
    }
    return worst;
}

#endif
