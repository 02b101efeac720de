/* everyday.c - the same motion, written otherwise: the same answer at the same cost

   A scene (scenes.h) written in another way (ways.h) has to give the same status, the same end and about the same cost.
   No reference is needed.

     everyday                   all scenes in all ways
     everyday draw SECONDS [SEED]  scenes, ways, rules and lengths drawn by the seed
     everyday show TEXT [TEXT]  the runs of the scenes whose names contain TEXT, in ways that contain the other, one by one */
#define GVI_IMPLEMENTATION
#include "gvi.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <tgmath.h>
#undef I

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
typedef gvi_real real;
#define R(x) ((real)x##L)
#if GVI__KIND == 1
#define KIND 1
#define EPS FLT_EPSILON
#elif GVI__KIND == 2
#define KIND 2
#define EPS DBL_EPSILON
#else
#define KIND 3
#define EPS LDBL_EPSILON
#endif

#include "scenes.h"
#include "ways.h"
#include "run.h"
#include "judge.h"

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (!strcmp(what, "draw")) return draw_for(argc > 2 ? atof(argv[2]) : 3, argc > 3 ? strtoul(argv[3], NULL, 10) : 0);
    if (!strcmp(what, "show")) shown_scene = argc > 2 ? argv[2] : "", shown_way = argc > 3 ? argv[3] : "";
    for (int k = 0; k < SCENES; ++k) all_ways_of(scenes + k);
    return verdict(!shown_scene);
}
