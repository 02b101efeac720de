/* motion.h - what motion.c and main.c have in common */
#ifndef MOTION_H
#define MOTION_H

typedef struct star { double q[3], v[3]; } star;      // kpc, kpc/Gyr

// each of the stars over `steps` steps of h; returns how many of them failed
typedef int motion(int count, star *stars, double h, int steps);

motion motion_plain, motion_avx2, motion_avx512;

/* A galaxy's halo: V = speed^2/2 log(core^2 + x^2 + (y/flat_y)^2 + (z/flat_z)^2), after Binney and
   Tremaine, Galactic Dynamics, 2.3.2; 220 km/s                                                   */
static const double speed = 225, core = 0.2, flat_y = 0.9, flat_z = 0.8;

#endif
