/* embedded_bound.h - floating-point operations of one step, as the opening comment of gvi.h bounds
   them: + - * / and roots, without those of the callbacks; no clock, no Lagrangian terms        */
#ifndef EMBEDDED_BOUND_H
#define EMBEDDED_BOUND_H

/* Rows as long as r, or a multiple of 8 from 5 on                                               */
static double flops_row(int r) { return r < 5 ? r : (r + 7)/8*8; }

/* A step as long as the one before, N iterations.  A set of rows takes n R sums of r products in each
   iteration and at the start, and K sets are to be found: positions, or with them velocities, or
   momenta.  M^-1 full: its solutions for each row.  M(q): L D L' and two solutions at each point.  */
static double flops_of_step(gvi_formulation f, gvi_mass_kind mass, int n, int r, int N)
{
    const double R = flops_row(r), K = f == GVI_POSITIONS ? 1 : 2;
    double all = (N + 2)*(K*n*R*(2*r + 20) + 30) + 30*K*n*r + 120*n;
    if (f == GVI_EXPLICIT) return 10*n*(r + 1) + 32*n + 8*r + 16;
    if (mass == GVI_MASS_DENSE) all += 2*n*n*((N + 2)*K*R + 3) + 8*(N + 2)*K*n*R;
    if (mass == GVI_MASS_POSITION) all += (N + 1)*R*(n*n*n/2.0 + 6*n*n + 4*n);
    return all;
}

/* What a new h costs besides, in the step that has it and the next two                          */
static inline double flops_of_new_h(gvi_formulation f, int r)
{
    return f == GVI_EXPLICIT ? 1800*r : 6*r*r*r + 4*(r + 10)*r*flops_row(r) + 70*r + 60;
}

#endif
