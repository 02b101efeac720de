/* machine.c - what everywhere.sh wants to know of a machine

   Prints the byte order, the digits of long double and FLT_EVAL_METHOD; empty where
   the compiler does not say.                                                   */
#include <float.h>
#include <math.h>
#include <stdio.h>

int main(void)
{
    union { unsigned whole; unsigned char part[sizeof(unsigned)]; } one = { 1 };
#ifdef FLT_EVAL_METHOD
    const int method = FLT_EVAL_METHOD;
#else
    const int method = 0;
#endif
    printf("%s %d %d\n", one.part[0] ? "little" : "big", LDBL_MANT_DIG, method);
    return sqrt((double)one.whole) < 1;                   /* is there a libm? */
}
