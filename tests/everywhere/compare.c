/* compare.c - two outputs of bits.c that are the same to rounding, not to the bit

   compare OURS THEIRS: for each scene the largest difference of a number in its lines
   t, q and p, in units of eps times the largest number of the line; eps is 2^-23 or
   2^-52 by the number of digits.  Prints the largest of all in eps and its scene; status
   1 if one is beyond its bound.  Bounds, where N steps round by eps each at random, which
   is sqrt(N) eps in all: a planet that was moved by d is 3/2 v t d/a ahead or behind,
   some 100 d here, so 16 N eps for N = 100; a spring of frequency 64 makes 64 d/|p| of it,
   so 64 N eps.  A table or matrix of N rows: N eps.  Nodes and weights, which are twofold
   but for the registers: 2 eps.                                                 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 16384, NAME = 64 };

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
    if (!strcmp(scene, "newton-stiff")) return 64*100;
    return 16*100;
}

static char our_line[LINE], their_line[LINE], worst_scene[NAME] = "none";
static double worst;

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
    if (isinf(bound)) return 0;
    const double d = difference(&rest, &other);
    if (!(d <= worst)) {
        worst = d;
        snprintf(worst_scene, sizeof worst_scene, "%s", scene);
    }
    if (d <= bound) return 0;
    printf("%s %s: %.3g eps, allowed %.3g\n", scene, what, d, bound);
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
    printf("%.2g eps, %s\n", worst, worst_scene);
    return beyond > 0 || lines == 0;
}
