/* lucky.c - a million random steps with terms linear in v: does one end with GVI_OK before it has converged?

   See ../lucky.h.  A single small ratio of changes must not end an iteration that does not contract, nor are changes that
   only fall, or only grow, rounding.

     lucky [first seed, 1]                                                                                     */
#include "hard.h"
#include "../lucky.h"

int main(int argc, char **argv)
{
    lucky_found found;
    if (argc > 1) lucky_seed = strtoull(argv[1], NULL, 10);
    lucky_run(1000000, &found);
    printf("  %ld steps, %ld of them found\n", found.steps, found.ok);
    expect("share of steps that are found", 0.5, (double)found.ok/(double)found.steps, 1);
    expect("steps with GVI_OK that are wrong", 0, (double)found.wrong, 0);
    expect("worst error / what rounding explains", 0, (double)found.worst, 200);
    return verdict("lucky");
}
