/* The board of board.h on Arm's MPS2 with a Cortex-M3 or Cortex-M4F, as
   qemu-system-arm has it (mps2-an385, mps2-an386): vector table, reset, text by
   semihosting, periods by SysTick.  On a board of your own keep its start-up
   code; gvi.h needs nothing of it but the floating-point unit switched on.
   At the end it prints how much of the stack was ever used, and of a period (in
   ticks of 40 ns).                                                             */
#include "board.h"
#include "print.h"
#include <stdint.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define SYSTICK_CONTROL   REGISTER(0xe000e010)
#define SYSTICK_RELOAD    REGISTER(0xe000e014)
#define SYSTICK_CURRENT   REGISTER(0xe000e018)
#define INTERRUPT_CONTROL REGISTER(0xe000ed04)
#define FPU_ACCESS        REGISTER(0xe000ed88)

#define TICK_PENDING (1u << 26)
#define TICK_CLEAR   (1u << 25)
#define PROCESSOR_HZ 25000000u
#define UNUSED       0x5aa5c33cu     /* what the stack is filled with             */

/* from mps2.ld */
extern uint32_t data_load[], data_start[], data_end[], bss_start[], bss_end[], stack_start[], stack_end[];

int main(void);
void reset(void);

/* Semihosting: the debugger, here qemu, does what r0 says with r1 (Arm, "Semihosting
   for AArch32 and AArch64": 0x04 writes text, 0x20 ends with a status).         */
static void semihost(uint32_t operation, const void *argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile ("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void board_print(const char *text) { semihost(0x04, text); }

static void end(int status)
{
    const uint32_t exited[2] = { 0x20026, (uint32_t)status };
    semihost(0x20, exited);
    for (;;) {}
}

/* The tick stays pending and interrupts are off: it wakes the processor, nothing more. */
void board_every(unsigned hertz)
{
    __asm__ volatile ("cpsid i");
    SYSTICK_RELOAD = PROCESSOR_HZ/hertz - 1;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = 7;
    INTERRUPT_CONTROL = TICK_CLEAR;
}

static uint32_t busiest;             /* ticks from the begin of a period to board_wait */

int board_wait(void)
{
    const uint32_t used = SYSTICK_RELOAD - SYSTICK_CURRENT;
    const int late = (INTERRUPT_CONTROL & TICK_PENDING) != 0;
    if (!late && used > busiest) busiest = used;
    while (!(INTERRUPT_CONTROL & TICK_PENDING)) __asm__ volatile ("wfi");
    INTERRUPT_CONTROL = TICK_CLEAR;
    return late;
}

static void print_line(const char *what, unsigned x)
{
    board_print("board: ");
    board_print(what);
    print_count(x);
    board_print("\n");
}

static unsigned stack_used(void)
{
    const uint32_t *p = stack_start;
    while (p < stack_end && *p == UNUSED) ++p;
    return (unsigned)(stack_end - p)*4;
}

static void run(void)
{
    const int status = main();
    print_line("bytes of stack used: ", stack_used());
    if (busiest > 0) print_line("ticks of the busiest period: ", busiest);
    end(status);
}

/* Nothing here may use floating point before the unit is on.                    */
void reset(void)
{
    const uint32_t *from = data_load, *top;
    __asm__ ("mov %0, sp" : "=r"(top));
    for (uint32_t *to = data_start; to < data_end; ++to) *to = *from++;
    for (uint32_t *to = bss_start; to < bss_end; ++to) *to = 0;
    for (volatile uint32_t *to = stack_start; to < top; ++to) *to = UNUSED;
#ifdef __ARM_FP
    FPU_ACCESS |= 0xfu << 20;
    __asm__ volatile ("dsb\n isb");
#endif
    run();
}

/* A fault, such as a stack that has grown below memory, or an unexpected interrupt. */
static void fault(void)
{
    board_print("board: fault\n");
    end(3);
}

typedef void handler(void);

static const struct { uint32_t *stack; handler *handlers[15]; } vectors
__attribute__((section(".vectors"), used)) = {
    stack_end, { reset, fault, fault, fault, fault, fault, 0, 0, 0, 0, fault, fault, 0, fault, fault }
};
