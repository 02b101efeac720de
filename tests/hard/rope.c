/* rope.c - a rope of 60 beads in a game: what halving the step guards against, and what it does not

   A rope of 3 m, 60 beads of 20 g on rods of 5 cm, falls from level rest and cracks like a whip.  A game runs it at 240 Hz
   for 10 s and halves a step that is refused, down to 1/1024 of it.  Refused is what fails, or with desc.resolution also
   what is not accurate; by the dial gvi_advance chooses the steps of each sixtieth of a second.  Energy may neither grow
   nor, without friction, fall: the table shows the largest |E - E0|, which the fall of the rope makes comparable.

     rope [seconds, 10] [beads, 60]                                                                                    */
#include "rope.h"

enum { FRAMES = 60, PARTS = RATE/FRAMES };
static real *room;

typedef struct run { int refused, steps, failed; double off, worst, sum, end; } run;

/* h, or both halves of it */
static gvi_status halving(gvi_stepper *st, real h, int deep, run *r)
{
    if (gvi_step(st, h) == GVI_OK) return r->steps += 1, GVI_OK;
    r->refused += 1;
    if (deep == DEEPEST) return st->status;
    const gvi_status status = halving(st, h/2, deep + 1, r);
    return status == GVI_OK ? halving(st, h/2, deep + 1, r) : status;
}

static gvi_status frame(gvi_stepper *st, int k, int dial, run *r)
{
    const real end = (real)(k + 1)/FRAMES;
    gvi_status status = GVI_OK;
    for (int part = 0; part < PARTS && !dial && status == GVI_OK; ++part)
        status = halving(st, (real)1/(FRAMES*PARTS), 0, r);
    while (dial && status == GVI_OK && st->t < end) {
        status = gvi_advance(st, end);
        r->steps += status == GVI_OK;
    }
    return status;
}

static run rope(int degree, real resolution, int dial, double seconds)
{
    real E0, E;
    run r = { 0 };
    gvi_stepper st;
    hang(&st, degree, resolution, room);
    must(gvi_energy(&st, &E0));
    const int frames = (int)(seconds*FRAMES);
    for (int k = 0; k < frames && !r.failed; ++k) {
        const clock_t from = clock();
        r.failed = frame(&st, k, dial, &r) != GVI_OK;
        const double ms = 1e3*(double)(clock() - from)/CLOCKS_PER_SEC;
        if (ms > r.worst) r.worst = ms;
        r.sum += ms/frames;
        r.end = (double)st.t;
        if (gvi_energy(&st, &E) != GVI_OK) r.failed = 1;
        if (!(fabs((double)(E - E0)) <= r.off)) r.off = fabs((double)(E - E0));
    }
    if (r.failed) printf("      %s\n", gvi_why(&st));
    return r;
}

int main(int count, char **words)
{
    static const struct { const char *name; double resolution; int dial; } ways[] = {
        { "halving what fails", 0, 0 }, { "and above .1", .1, 0 }, { "and above .01", .01, 0 },
        { "the dial, .1", .1, 1 }, { "the dial, .01", .01, 1 } };
    const double seconds = count > 1 ? atof(words[1]) : 10;
    if (count > 2) beads = atoi(words[2]);
    if (beads < 1 || beads > MOST) return 1;
    room = malloc(ROOM);
    const double fall = (double)(bead*weight_of*rod)*beads*(beads + 1)/2;
    printf("  %d beads, %.0f s, %.2f J to fall\n  degree                      largest |E - E0|     steps   refused  "
           "ms a frame: mean    worst\n", beads, seconds, fall);
    for (int degree = 1; degree <= 4; degree *= 2)
        for (int k = 0; k < COUNT(ways); ++k) {
            const run r = rope(degree, (real)ways[k].resolution, ways[k].dial, seconds);
            printf("  %d  %-20s %13.2e J %9d %9d %18.2f %8.2f%s\n", degree, ways[k].name, r.off, r.steps, r.refused, r.sum,
                   r.worst, r.failed ? "   stopped" : "");
            fflush(stdout);
            // what nobody sees: a third of the fall, or at .01 a tenth
            if (ways[k].resolution > 0) misses += r.failed || r.off > fall/(ways[k].resolution < .05 ? 10 : 3);
            else if (degree == 1) misses += !r.failed && r.off < fall;
        }
    free(room);
    return verdict("rope");
}
