/* Macros that a program may have before gvi.h: students' and embedded names, those of <windows.h>. */
#define N 3
#define g 9.81
#define T 300
#define E 2.1e11
#define m 1.5
#define R 8.314
#define h 0.01
#define M 4
#define K 100
#define near
#define far
#define small char
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#include "gvi.h"
#include "implementation.c"

int kept[N == 3 && T == 300 && M == 4 && K == 100 ? 1 : -1];
double product(void);
double product(void)
{
    far small letter = 'a';
    return E*R*m*g*h*letter;
}
