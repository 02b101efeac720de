/* print.h: numbers through board_print, nothing of the C library but memcpy.   */
#include "print.h"
#include "board.h"
#include <stdint.h>
#include <string.h>

/* The digits of x before end, at least `least` of them; returns the first.     */
static char *digits(char *end, uint32_t x, unsigned base, int least)
{
    for (; least > 0 || x > 0; --least, x /= base) *--end = "0123456789abcdef"[x%base];
    return end;
}

/* float as it is; anything wider as double                                     */
static char *bits(char *end, GVI_REAL x)
{
    const float f = (float)x;
    const double d = (double)x;
    uint32_t half = 0;
    uint64_t whole = 0;
    memcpy(&half, &f, sizeof f);
    memcpy(&whole, &d, sizeof d);
    if (sizeof x == sizeof f) return digits(end, half, 16, 8);
    return digits(digits(end, (uint32_t)whole, 16, 8), (uint32_t)(whole >> 32), 16, 8);
}

/* Right-aligned; 0 of a number that is not one or does not fit                 */
static char *decimals(char *end, GVI_REAL x)
{
    const GVI_REAL size = x < 0 ? -x : x;
    const uint32_t millionths = size < 1000 ? (uint32_t)(size*1000000 + (GVI_REAL)0.5) : 0;
    char *p = digits(end, millionths%1000000, 10, 6);
    *--p = '.';
    p = digits(p, millionths/1000000, 10, 1);
    if (x < 0) *--p = '-';
    while (end - p < 12) *--p = ' ';
    return p;
}

void print_real(GVI_REAL x)
{
    char text[40], *p = text + sizeof text;
    *--p = 0;
    p = decimals(p, x);
    p = bits(p, x);
    *--p = ' ';
    board_print(p);
}

void print_count(unsigned x)
{
    char text[12], *p = text + sizeof text;
    *--p = 0;
    board_print(digits(p, x, 10, 1));
}

/* What a board does then is its own affair; the state is that before the step.  */
int print_failure(int status)
{
    board_print("failed with status -");
    print_count((unsigned)-status);
    board_print("\n");
    return 1;
}
