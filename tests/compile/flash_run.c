/* flash_run.c - flash.c, 100 steps, and the angle's bits: on an AVR (simavr shows what goes to the serial port) and here */
#define main forever
#include "flash.c"
#undef main
#include <string.h>

#ifdef __AVR__
#include <avr/io.h>
#include <avr/sleep.h>
extern unsigned char _end;
static void put(char c) { UDR0 = (unsigned char)c; }
#else
#include <stdio.h>
static void put(char c) { putchar(c); }
#endif

int main(void)
{
    static const float q[1] = { 1 }, v[1] = { 0 };
    uint32_t bits;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 100 && st.status == GVI_OK; ++k) gvi_step(&st, 0.01f);
    memcpy(&bits, st.q, sizeof bits);
    for (int k = 28; k >= 0; k -= 4) put("0123456789abcdef"[bits >> k & 15]);
    put(st.status == GVI_OK ? '.' : '!');
    put('\n');
#ifdef __AVR__
    sleep_enable();
    sleep_cpu();                          // without interrupts simavr ends here
#else
    (void)forever;
#endif
    return st.status;
}
