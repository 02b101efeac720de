/* Sine and cosine of a GVI_REAL.  sine_libm.c takes those of the C library, which
   differ in their last bit from machine to machine; sine_own.c is the same to the
   bit on all of them, and so is then every trajectory: what a board has logged can
   be run again on a desk.  Errors are below eps.                                */
#ifndef SINE_H
#define SINE_H

#ifndef GVI_REAL
#define GVI_REAL double
#endif

GVI_REAL sine(GVI_REAL x);
GVI_REAL cosine(GVI_REAL x);

#endif
