/* known.h - faults that are known: what is refused rightly, and what is not mended

   A fault is known if the texts of a row stand in its scene, its way, its degree, rule and length, and in what is said of it.  In a
   run of everything, more of a row than `most` is a failure; so is none, since then the row has to go.  Of what is not
   mended, docs/hard-cases.md has the reason.                                          */
#ifndef EVERYDAY_KNOWN_H
#define EVERYDAY_KNOWN_H

enum { REFUSED, WRONG, DEAR, UNLIKE, FAULTS };
typedef struct known {
    const char *scene, *way, *how, *said;
    int fault, right;
    long most[3];                       /* float, double, long double                                      */
    const char *reason;
    long seen;
} known;

#define NEAR_0 "a row of constraints whose own terms vanish"
#define NEWTON_FLOOR "Newton's method goes on where nothing but rounding is left"
#define CLOCK_FLOOR "a clock's rounding, far from the origin"
#define UNLIKE_COPIES "rods of two copies, eleven decades apart: the larger one's rounding is the floor of both"
#define EXACT_0 "rows that are exactly 0 in one frame take two iterations less"
#define DIAL_FLOOR "by the dial: rounding of rows from rest in a frame that moves, or of p beside A, taken for the curve's"

static known known_faults[] = {
    { "three bodies, restricted, at rest", "", "h 0.125", "no solution", REFUSED, 1, { 0, 1, 0 }, "falls into a primary within four such steps", 0 },
    { "three bodies, restricted, at rest", "plain", "degree 3 gauss", "no solution", REFUSED, 1, { 1, 1, 1 }, "falls into a primary", 0 },
    { "three bodies, restricted, at rest", "drawn", "", "no solution", REFUSED, 1, { 0, 0, 0 }, "falls into a primary", 0 },
    { "three bodies, restricted", "drawn", "degree 1 ", "no solution", REFUSED, 1, { 0, 0, 0 }, "passes a primary in one step", 0 },
    { "three bodies, restricted, at rest", "drawn", "", "", WRONG, 1, { 0, 0, 0 }, "falls into a primary, which stretches a change more than `growth` says", 0 },
    { "floor through 0", "drawn", "degree 1 lobatto", "formulation 1", DEAR, 0, { 0, 0, 0 }, NEAR_0, 0 },
    { "", "two unlike copies", "", "no solution", REFUSED, 0, { 0, 0, 0 }, UNLIKE_COPIES, 0 },
    { "triangle of rods", "drawn: starts at 0", "", "not on a constraint", REFUSED, 0, { 0, 0, 0 }, NEAR_0, 0 },
    { "", "starts at 0", "", "no solution", REFUSED, 0, { 0, 4, 2 }, NEAR_0, 0 },
    { "", "starts at 0", "", "", DEAR, 0, { 17, 16, 2 }, NEAR_0, 0 },
    { "", "", "", "formulation 5", DEAR, 0, { 18, 6, 2 }, NEWTON_FLOOR, 0 },
    { "", "all as terms", "", "no solution", REFUSED, 0, { 1, 0, 0 }, "rows and a mass of terms alone: Newton's floor of g", 0 },
    { "", "", "dial", "never ends", REFUSED, 0, { 1, 0, 2 }, DIAL_FLOOR, 0 },
    { "", "", "dial", "as accurate", REFUSED, 0, { 1, 0, 0 }, DIAL_FLOOR, 0 },
    { "", "", "dial", "steps, the best", DEAR, 0, { 7, 8, 2 }, DIAL_FLOOR, 0 },
    { "", "", "", "formulation 2", DEAR, 0, { 25, 12, 5 }, EXACT_0, 0 },
    { "", "", "", "formulation 3", DEAR, 0, { 2, 3, 1 }, EXACT_0, 0 },
    { "", "pinned", "", "no solution", REFUSED, 0, { 1, 0, 0 }, NEWTON_FLOOR, 0 },
    { "", "drawn", "", "formulation 4", DEAR, 0, { 0, 0, 0 }, "the fixed point of momenta goes on where nothing but rounding is left", 0 },
    { "with a clock", "drawn", "", "no solution", REFUSED, 0, { 0, 0, 0 }, CLOCK_FLOOR, 0 },
    { "heavy top", "drawn", "", "no solution", REFUSED, 0, { 0, 0, 0 }, NEWTON_FLOOR, 0 },
    { "charge", "measures", "", "", UNLIKE, 0, { 1, 7, 0 }, "contraction and resolution of what is rounding, beside a term A.v", 0 },
};

static long most_of(const known *k) { return k->most[KIND - 1]; }

static known *known_fault(const char *of, const char *by, const char *how, const char *said, int fault)
{
    for (int k = 0; k < COUNT(known_faults); ++k) {
        known *a = known_faults + k;
        if (a->fault == fault && strstr(of, a->scene) && strstr(by, a->way) && strstr(how, a->how) && strstr(said, a->said)) return a;
    }
    return NULL;
}

/* How many rows are wrong themselves */
static long print_known(void)
{
    long wrong = 0;
    for (int k = 0; k < COUNT(known_faults); ++k) {
        const known *a = known_faults + k;
        const int bad = a->seen > most_of(a) || (most_of(a) && !a->seen);
        wrong += bad;
        if (!a->seen && !bad) continue;
        printf("%s %4ld of %4ld: %s, %s, %s, \"%s\": %s\n", bad ? "FAILED" : a->right ? "right " : "known ", a->seen, most_of(a), a->scene, a->way,
               a->how, a->said, a->reason);
    }
    return wrong;
}

#endif
