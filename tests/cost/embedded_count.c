/* embedded_count.c - instructions of one step on a Cortex-M3 or Cortex-M4F, as qemu counts them

   For tests/tools/embedded_cost.sh, which runs it under `qemu-system-arm -icount shift=0`: every
   instruction then takes 1 ns, and SysTick, at 25 MHz, ticks once in 40 instructions.  EMBEDDED_SCENE
   is the index of the scene; settings that the image cannot run are left out.

   Prints first what it counts of sequences whose length is known:

     known NAME LENGTH COUNTED

   then a line for each setting: the index of the setting, steps, instructions of all of them but the first
   three, the most of one of these, the most of the first three, iterations in all, a hash of the last
   state's bits, and failures:

     row SCENE SETTING STEPS INSTRUCTIONS MOST FIRST ITERATIONS BITS FAILURES                    */
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#include "gvi.h"
#include "embedded_run.h"
#include "board.h"
#include "print.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define SYSTICK_CONTROL   REGISTER(0xe000e010)
#define SYSTICK_RELOAD    REGISTER(0xe000e014)
#define SYSTICK_CURRENT   REGISTER(0xe000e018)
enum { TICK = 40, WRAP = 0x1000000 };

#ifndef STEPS_COUNTED
#define STEPS_COUNTED 500
#endif

/* -------------------------------------------------------------------- text */

static void print_number(uint32_t x)
{
    board_print(" ");
    print_count(x);
}

/* ---------------------------------------------------------------- stopwatch */

/* Waits for a tick: at most 3 instructions after it, counted down to the value returned         */
static inline uint32_t at_tick(void)
{
    uint32_t was, now;
    __asm__ volatile ("ldr %0, [%2]\n1: ldr %1, [%2]\n cmp %0, %1\n beq 1b"
                      : "=&r"(was), "=&r"(now) : "r"(&SYSTICK_CURRENT) : "cc", "memory");
    return now;
}

/* Waits for the next tick and says how many rounds of 4 instructions that took                  */
static inline uint32_t to_tick(uint32_t *rounds)
{
    uint32_t was, now, n = 0;
    __asm__ volatile ("ldr %0, [%3]\n1: adds %2, #1\n ldr %1, [%3]\n cmp %0, %1\n beq 1b"
                      : "=&r"(was), "=&r"(now), "+l"(n) : "r"(&SYSTICK_CURRENT) : "cc", "memory");
    *rounds = n;
    return now;
}

typedef void job(run *r);
static void nothing(run *r) { (void)r; __asm__ volatile (""); }
static void by_gvi(run *r) { gvi_step(&r->st, r->h); }
static void by_hand_step(run *r) { r->step(&drive, &r->hand, r->h); }

/* Instructions of one call, to within 5                                                         */
static int32_t count_raw(job *f, run *r)
{
    uint32_t rounds;
    const uint32_t from = at_tick();
    f(r);
    const uint32_t to = to_tick(&rounds);
    return (int32_t)(((from - to) & (WRAP - 1))*TICK - 4*rounds);
}

static int32_t count(job *volatile f, run *r)
{
    job *volatile empty = nothing;
    return count_raw(f, r) - count_raw(empty, r);
}

/* Ticks of a loop of calls; of so many that 40 instructions more or less are nothing            */
static uint32_t ticks(job *f, run *r, int steps)
{
    const uint32_t from = at_tick();
    for (int k = 0; k < steps; ++k) f(r);
    return (from - SYSTICK_CURRENT) & (WRAP - 1);
}

/* ------------------------------------------------------- sequences of known length */

/* Besides the call, the return and what the compiler makes of an empty function                 */
static void loop(run *r)
{
    uint32_t n = 1000;
    (void)r;
    __asm__ volatile ("1: subs %0, #1\n bne 1b" : "+l"(n) : : "cc");
}
static void straight(run *r) { (void)r; __asm__ volatile (".rept 300\n nop\n .endr"); }

static void loads(run *r)
{
    uint32_t x;
    __asm__ volatile (".rept 200\n ldr %0, [%1]\n .endr" : "=&r"(x) : "r"(r));
}
#ifdef __ARM_FP
static void floats(run *r)
{
    float x = 1.5f;
    __asm__ volatile (".rept 100\n vmul.f32 %0, %0, %0\n vdiv.f32 %0, %0, %0\n vsqrt.f32 %0, %0\n .endr"
                      : "+t"(x));
    (void)r;
}
#endif

static void known(const char *name, uint32_t length, job *volatile f)
{
    board_print("known ");
    board_print(name);
    print_number(length);
    print_number((uint32_t)count(f, NULL));
    board_print("\n");
}

static void known_all(void)
{
    known("loop", 2000, loop);
    known("straight", 300, straight);
    known("loads", 200, loads);
#ifdef __ARM_FP
    known("floats", 300, floats);
#endif
}

/* -------------------------------------------------------------------- rows */

typedef struct found { int32_t most, first; } found;

static int32_t larger(int32_t a, int32_t b) { return a > b ? a : b; }

/* Step by step                                                                                  */
static void count_each(run *r, job *f, found *x)
{
    for (int k = 0; k < STEPS_COUNTED; ++k) {
        run_control(r);
        const int32_t n = count(f, r);
        if (k < STEPS_FIRST) x->first = larger(x->first, n);
        else x->most = larger(x->most, n);
        ++r->k;
    }
}

/* All together, the controller's work taken off                                                 */
static void control(run *r) { run_control(r); ++r->k; }
static void control_by_gvi(run *r) { control(r); by_gvi(r); }
static void control_by_hand(run *r) { control(r); by_hand_step(r); }

static int32_t count_all(run *r, job *volatile f)
{
    job *volatile empty = control;
    for (int k = 0; k < STEPS_FIRST; ++k) f(r);
    const long k = r->k;
    const uint32_t all = ticks(f, r, STEPS_COUNTED - STEPS_FIRST);
    r->k = k;
    return (int32_t)((all - ticks(empty, r, STEPS_COUNTED - STEPS_FIRST))*TICK);
}

static void print_row(const run *r, int index, uint32_t all, const found *x)
{
    const int hand = by_hand_only(r->setting);
    board_print("row");
    print_number(EMBEDDED_SCENE);
    print_number((uint32_t)index);
    print_number(STEPS_COUNTED);
    print_number(all);
    print_number((uint32_t)x->most);
    print_number((uint32_t)x->first);
    print_number(hand ? 0 : (uint32_t)r->st.counters.iterations);
    print_number(run_bits(r));
    print_number(hand ? 0 : (uint32_t)r->st.counters.failures);
    board_print("\n");
}

static void row(int index)
{
    static run r;
    const setting *t = settings + index;
    found x = { 0, 0 };
    if (run_start(&r, scenes + EMBEDDED_SCENE, t, scenes[EMBEDDED_SCENE].h) != 0) return;
    count_each(&r, r.step ? by_hand_step : by_gvi, &x);
    run_start(&r, scenes + EMBEDDED_SCENE, t, scenes[EMBEDDED_SCENE].h);
    const int32_t all = count_all(&r, r.step ? control_by_hand : control_by_gvi);
    print_row(&r, index, (uint32_t)all, &x);
}

int main(void)
{
    SYSTICK_RELOAD = WRAP - 1;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = 5;                           // on, the processor's clock, no interrupt
    known_all();
    for (int k = 0; k < SETTINGS; ++k) row(k);
    return 0;
}
