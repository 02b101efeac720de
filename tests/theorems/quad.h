/* quad.h - long double as IEEE quadruple precision, where the compiler has it

   gcc and clang on x86-64 do with -mlong-double-128, but glibc keeps the names
   of the 80-bit functions; its quadruple ones end in f128.  Given to the
   compiler with -include, before any other header.  printf does not know this
   type: the studies print doubles.  gvi.h takes its functions from here too: the
   compiler's own __builtin_sqrtl would be called as the 80-bit sqrtl.  Where long
   double has 113 bits anyway (aarch64), nothing of this is needed.           */
#if defined(__x86_64__) && __LDBL_MANT_DIG__ == 113
#define sqrtl  sqrtf128
#define floorl floorf128
#define ceill  ceilf128
#define ldexpl ldexpf128
#define frexpl frexpf128
#define sinl   sinf128
#define cosl   cosf128
#define acosl  acosf128
#define powl   powf128
#define logl   logf128
#define log2l  log2f128
#define fabsl  fabsf128
#define cbrtl  cbrtf128
#define fminl  fminf128
#define fmaxl  fmaxf128
#define atanl  atanf128
#define expl   expf128
#include <math.h>
#define GVI_SQRT(x)      sqrtl(x)
#define GVI_ABS(x)       fabsl(x)
#define GVI_FLOOR(x)     floorl(x)
#define GVI_LDEXP(x, e)  ldexpl(x, e)
#define GVI_FREXP(x, pe) frexpl(x, pe)
#endif
