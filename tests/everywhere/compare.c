/* compare.c - two outputs of bits.c that are the same to rounding, not to the bit

   compare OURS THEIRS: for each scene the largest difference of a number in its lines
   t, q and p, in units of eps times the largest number of the line; eps is 2^-23 or
   2^-52 by the number of digits.  Prints the largest of all in eps and its scene; status
   1 if one is beyond its bound.  Bounds, where N steps round by eps each at random, which
   is sqrt(N) eps in all: a planet that was moved by d is 3/2 v t d/a ahead or behind,
   some 100 d here, so 16 N eps for N = 100.  A table or matrix of N rows: N eps.  Nodes and
   weights, which are twofold but for the registers: 2 eps.

   The stiff spring, K = 4096, is kicked by the rounding of its own force: a step of h = 0.1
   is wrong by 0.44 K eps h sqrt(sum b^2) in p, rms (tests/test_newton.c says why), which is
   67 eps, 10 times that in N = 100 steps, sqrt(2) less as kicks turn with the spring, sqrt(2)
   more as both outputs are wrong, so 670 eps of 1: with |p| = 1/3, 2000 eps of it.  One orbit
   may be off by three times that, so the median of 64 is compared; in it half of the orbits are
   nearer than 0.67 of the rms.                                                  */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 16384, NAME = 64, ORBITS = 64, ORBITS_BOUND = 2000 };

static double number(const char *digits)
{
    union { uint64_t bits; double value; } wide;
    union { uint32_t bits; float value; } narrow;
    wide.bits = strtoull(digits, NULL, 16);
    narrow.bits = (uint32_t)wide.bits;
    return strlen(digits) == 8 ? (double)narrow.value : wide.value;
}

/* the numbers of two lines, split at blanks already begun; NaN where they do not match */
static double difference(char **rest, char **other)
{
    double worst = 0, size = 0, eps = 1;
    for (;;) {
        const char *a = strtok_r(NULL, " \n", rest), *b = strtok_r(NULL, " \n", other);
        if (!a != !b) return NAN;
        if (!a) return worst > 0 ? worst/(size*eps) : 0;
        const double x = number(a), y = number(b);
        eps = strlen(a) == 8 ? ldexp(1, -23) : ldexp(1, -52);
        worst = fmax(worst, fabs(x - y));
        size = fmax(size, fabs(y));
        if (isnan(x - y)) return NAN;
    }
}

/* infinite for what is not compared: what depends on these, each in its own way */
static double bound_of(const char *scene, const char *what)
{
    if (!strcmp(what, "nodes") || (!strcmp(what, "weights") && strcmp(scene, "interpolation"))) return 2;
    if (!strcmp(scene, "interpolation")) return 12;
    if (!strcmp(scene, "lu")) return 20;
    if (strcmp(what, "t") && strcmp(what, "q") && strcmp(what, "p")) return HUGE_VAL;
    if (!strcmp(scene, "newton-stiff") || !strcmp(scene, "springs")) return HUGE_VAL;
    return 16*100;
}

static char our_line[LINE], their_line[LINE], worst_scene[NAME] = "none";
static double worst, orbits[ORBITS];
static int orbit_count;

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void note(const char *scene, double d)
{
    if (d <= worst) return;
    worst = d;                                           /* also a NaN */
    snprintf(worst_scene, sizeof worst_scene, "%s", scene);
}

/* 1: beyond the bound, or not the same thing */
static int compare_line(void)
{
    char *rest, *other;
    const char *scene = strtok_r(our_line, " \n", &rest), *scene2 = strtok_r(their_line, " \n", &other);
    const char *what = strtok_r(NULL, " \n", &rest), *what2 = strtok_r(NULL, " \n", &other);
    if (!scene || !what || !scene2 || !what2 || strcmp(scene, scene2) || strcmp(what, what2)) {
        printf("%s and %s: not the same lines\n", scene ? scene : "nothing", scene2 ? scene2 : "nothing");
        return 1;
    }
    const double bound = bound_of(scene, what);
    if (!strcmp(scene, "springs") && orbit_count < ORBITS) {
        const double d = difference(&rest, &other);
        orbits[orbit_count++] = isnan(d) ? HUGE_VAL : d;
    }
    if (isinf(bound)) return 0;
    const double d = difference(&rest, &other);
    note(scene, d);
    if (d <= bound) return 0;
    printf("%s %s: %.3g eps, allowed %.3g\n", scene, what, d, bound);
    return 1;
}

/* 1: the median of the springs is beyond its bound, or one of them is missing */
static int compare_springs(void)
{
    if (orbit_count != ORBITS) return 1;
    qsort(orbits, ORBITS, sizeof *orbits, by_size);
    const double median = (orbits[ORBITS/2 - 1] + orbits[ORBITS/2])/2;
    note("springs", median);
    if (median <= ORBITS_BOUND) return 0;
    printf("springs p: %.3g eps in the median, allowed %d\n", median, ORBITS_BOUND);
    return 1;
}

int main(int argc, char **argv)
{
    FILE *ours = argc == 3 ? fopen(argv[1], "r") : NULL, *theirs = argc == 3 ? fopen(argv[2], "r") : NULL;
    int beyond = 0, lines = 0;
    if (!ours || !theirs) return 2;
    for (;; ++lines) {
        const char *more = fgets(our_line, LINE, ours), *further = fgets(their_line, LINE, theirs);
        if (!more != !further) printf("one ends after %d lines\n", lines), ++beyond;
        if (!more || !further) break;
        beyond += compare_line();
    }
    beyond += compare_springs();
    printf("%.2g eps, %s\n", worst, worst_scene);
    return beyond > 0 || lines == 0;
}
