/* 17 - A checkpoint: stop, and go on later to the same bit

   A stepper and its memory are plain data.  Written to a file, they are a
   checkpoint; gvi_restore puts one into a stepper that was set up for the same
   description.  What follows is the same to the last bit, compensation terms
   and starting values of the iteration included.

   prints

     without a stop:  t = 400, q = 0.104090266 -0.073997961
     from checkpoint: t = 400, the same to the bit
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LENGTH = GVI_LENGTH(2, 6, 6) };

/* Henon and Heiles: V = (x^2 + y^2)/2 + x^2 y - y^3/3                         */
GVI_EACH(henon_heiles, 2, f)
{
    const double X = x->q[0], Y = x->q[1];
    x->f[0] -= X + 2*X*Y;
    x->f[1] -= Y + X*X - Y*Y;
}

static gvi_status advance(gvi_stepper *st, int steps)
{
    for (int k = 0; k < steps; ++k)
        if (gvi_step(st, 0.2) != GVI_OK) break;
    return st->status;
}

int main(void)
{
    static double memory[LENGTH], other_memory[LENGTH], saved_memory[LENGTH];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = henon_heiles } };
    const gvi_desc desc = { .n = 2, .degree = 6, .effects = scene, .effect_count = 1 };
    gvi_stepper st, other, saved;
    FILE *file = tmpfile();
    if (!file) return perror("tmpfile"), 1;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0, 0.1 }, (double[]){ 0.49057789051960615, 0 });
    advance(&st, 1000);

    // the checkpoint: two writes
    fwrite(&st, sizeof st, 1, file);
    fwrite(memory, sizeof memory, 1, file);
    if (advance(&st, 1000)) return puts(gvi_why(&st)), 1;
    printf("without a stop:  t = %g, q = %.9f %.9f\n", st.t, st.q[0], st.q[1]);

    // another process, another day
    rewind(file);
    if (fread(&saved, sizeof saved, 1, file) != 1 || fread(saved_memory, sizeof saved_memory, 1, file) != 1)
        return perror("checkpoint"), 1;
    fclose(file);
    gvi_init(&other, &desc, other_memory, sizeof other_memory);
    gvi_restore(&other, &saved, saved_memory);
    if (advance(&other, 1000)) return puts(gvi_why(&other)), 1;
    int same = !memcmp(st.q, other.q, 2*sizeof *st.q) && !memcmp(st.p, other.p, 2*sizeof *st.p);
    printf("from checkpoint: t = %g, %s\n", other.t, same ? "the same to the bit" : "different");
    return 0;
}
