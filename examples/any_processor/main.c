/* One program for all processors of a kind

   A program that goes to others is compiled for the least of their processors, and on one with AVX-512
   uses a quarter of each register.  So what takes time, forces and gvi.h together, is compiled three
   times, and the program takes the widest form that its processor has.  The orbits of 300 stars in the
   halo of a galaxy, over 2 Gyr; with gcc or clang, in this directory:

     cc -std=c99 -O3 -I../.. -c motion.c
     cc -std=c99 -O3 -I../.. -mavx2 -mfma -DMOTION=motion_avx2 -c motion.c -o motion_avx2.o
     cc -std=c99 -O3 -I../.. -mavx512f -mavx512dq -mavx512vl -mavx512bw -mfma -DMOTION=motion_avx512 \
        -c motion.c -o motion_avx512.o
     cc -std=c99 -O3 main.c motion.o motion_avx2.o motion_avx512.o -lm

   The forms give the same bits with -ffp-contract=off, which gcc's -std=c99 implies.  With an argument
   the program prints the time that each takes, too.

   prints

     300 stars over 2 Gyr: energies to 2e-11
     the same bits in every form that this processor has
*/
#include "motion.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { STARS = 300, STEPS = 600 };

typedef struct form { const char *name; motion *run; int there; } form;

static double energy(const star *s)
{
    const double x = s->q[0], y = s->q[1]/flat_y, z = s->q[2]/flat_z;
    const double v2 = s->v[0]*s->v[0] + s->v[1]*s->v[1] + s->v[2]*s->v[2];
    return 0.5*v2 + 0.5*speed*speed*log(core*core + x*x + y*y + z*z);
}

// between 4 and 14 kpc, at 0.8 to 1 times the speed of a circle, in many directions
static void scatter(star *stars)
{
    for (int i = 0; i < STARS; ++i) {
        const double r = 4 + 10.0*i/STARS, v = speed*(0.8 + 0.2*(7*i % STARS)/STARS), a = 2.4*i, b = 0.7*i;
        const star s = { { r*cos(a), r*sin(a), 0.2*r*sin(b) }, { -v*sin(a)*cos(b), v*cos(a)*cos(b), v*sin(b) } };
        stars[i] = s;
    }
}

int main(int argc, char **argv)
{
    static star start[STARS], end[STARS], first[STARS];
    form forms[3] = { { "plain", motion_plain, 1 }, { "AVX2", NULL, 0 }, { "AVX-512", NULL, 0 } };
    int same = 1;
    double worst = 0;
#ifdef __x86_64__
    forms[1].run = motion_avx2;
    forms[1].there = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    forms[2].run = motion_avx512;
    forms[2].there = forms[1].there && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")
                     && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
#endif
    scatter(start);
    for (int k = 0; k < 3; ++k) {                     // your program takes the last that is there, and no other
        if (!forms[k].there) continue;
        memcpy(end, start, sizeof end);
        const clock_t from = clock();
        if (forms[k].run(STARS, end, 2.0/STEPS, STEPS) > 0) return puts("a step failed"), 1;
        const double seconds = (double)(clock() - from)/CLOCKS_PER_SEC;
        if (argc > 1) printf("%-8s %.0f ns a step\n", forms[k].name, 1e9*seconds/STARS/STEPS);
        if (k == 0) memcpy(first, end, sizeof first);
        same = same && memcmp(first, end, sizeof first) == 0;
    }
    for (int i = 0; i < STARS; ++i) worst = fmax(worst, fabs(energy(end + i)/energy(start + i) - 1));
    printf("%d stars over 2 Gyr: energies to %.0e\n", STARS, worst);
    puts(same ? "the same bits in every form that this processor has" : "other bits in another form");
    return (void)argv, 0;
}
