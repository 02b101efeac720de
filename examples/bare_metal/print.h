/* Numbers as text, without stdio: first their bits in hexadecimal, then six
   decimals.  GVI_REAL as for gvi.h.                                            */
#ifndef PRINT_H
#define PRINT_H

#ifndef GVI_REAL
#define GVI_REAL double
#endif

void print_real(GVI_REAL x);       /* " 3f800000    1.000000", |x| below 1000   */
void print_count(unsigned x);
int  print_failure(int status);    /* of a call of gvi.h; returns 1               */

#endif
