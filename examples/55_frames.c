/* 55 - A game by the dial: so many attempts a frame, and no more

   A comet falls past its sun, at 60 frames a second.  The dial shortens its steps there and refuses
   some, but a frame has its time.  With desc.tries = 1 a call of gvi_advance is one attempt, of no
   more than max_iterations, and a frame makes at most eight.  What they have reached is st.t: a frame
   that is late draws that, and the next ones catch up.  A refused attempt leaves the state as it was
   and st.next shorter, so the next call goes on from there.

   prints

     late, 4 frames in 100 at most: yes, by 0.04 s, on time again 4 frames later
     within 1e-6 of the same run without frames: yes
     evaluations in a frame, at most 8 times those of a step: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

enum { FRAMES = 1200, ATTEMPTS = 8, ITERATIONS = 16, DEGREE = 6 };
enum { MOST = 4*(ITERATIONS + 5)*DEGREE };        /* evaluations of a fixed point's step (docs/embedded.md) */

GVI_EACH(attraction, 2, f)
{
    const double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2));
    x->f[0] += w*X;
    x->f[1] += w*Y;
}

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };

static gvi_stepper start(int tries, double *memory, size_t size)
{
    static const double q[] = { 1, 0 }, v[] = { 0, 0.1 };
    const gvi_desc desc = { .n = 2, .degree = DEGREE, .effects = scene, .effect_count = 1, .formulation = GVI_POSITIONS,
                            .resolution = 1e-7, .tries = tries, .max_iterations = ITERATIONS };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, size);
    gvi_start(&st, 0, q, v);
    return st;
}

int main(void)
{
    static double memory[2][GVI_LENGTH(2, DEGREE, DEGREE)];
    gvi_stepper st = start(1, memory[0], sizeof memory[0]), free = start(0, memory[1], sizeof memory[1]);
    int late = 0, row = 0, longest = 0;
    double behind = 0;
    unsigned long long most = 0;
    for (int frame = 1; frame <= FRAMES; ++frame) {
        const double now = frame/60.0;
        const unsigned long long before = st.counters.effect[0];
        for (int k = 0; k < ATTEMPTS && st.t < now; ++k) gvi_advance(&st, now);
        /* here the frame is drawn, from st.q */
        row = st.t < now ? row + 1 : 0;
        late += st.t < now;
        longest = row > longest ? row : longest;
        behind = fmax(behind, now - st.t);
        if (st.counters.effect[0] - before > most) most = st.counters.effect[0] - before;
    }
    while (free.status == GVI_OK && free.t < st.t) gvi_advance(&free, st.t);
    printf("late, 4 frames in 100 at most: %s, by %.2f s, on time again %d frames later\n",
           late > 0 && 100*late <= 4*FRAMES ? "yes" : "no", behind, longest);
    printf("within 1e-6 of the same run without frames: %s\n",
           free.t >= st.t && hypot(st.q[0] - free.q[0], st.q[1] - free.q[1]) < 1e-6 ? "yes" : "no");
    printf("evaluations in a frame, at most %d times those of a step: %s\n", ATTEMPTS, most <= ATTEMPTS*MOST ? "yes" : "no");
    return 0;
}
