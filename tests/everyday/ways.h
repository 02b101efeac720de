/* ways.h - the table of ways to write a scene otherwise */
#ifndef EVERYDAY_WAYS_H
#define EVERYDAY_WAYS_H

#include "written.h"

typedef struct way {
    const char *name;
    void (*change)(written *w);         /* how it is written                                               */
    int (*fits)(const scene *s);        /* NULL: every scene                                               */
    int frame;                          /* of units, origin, axes: the list of effects stays               */
} way;

#define WAY(name) static void name(written *w)
#define FITS(name) static int name(const scene *s)

/* In float M l^2/T^2 and what is made of it have to stay within 1e-31 to 1e38. */
static real unit_of(int power) { return (real)pow(10.0, KIND == 1 ? power/3 : power); }

WAY(plain) { (void)w; }
WAY(large) { w->length = unit_of(6); }
WAY(small) { w->length = unit_of(-9); }
WAY(quick) { w->time = unit_of(-6); }
WAY(slow) { w->time = unit_of(9); }
WAY(light) { w->mass = unit_of(-27); }
WAY(planets) { w->length = R(1.5)*unit_of(11); w->time = R(3)*unit_of(7); w->mass = R(6)*unit_of(24); }
WAY(electrons) { w->length = unit_of(-10); w->time = R(2.4)*unit_of(-17); w->mass = R(9.1)*unit_of(-31); }
WAY(moved) { for (int i = 0; i < N; ++i) w->origin[i] = i & 1 ? -7 : 5; }
WAY(far_away) { for (int i = 0; i < N; ++i) w->origin[i] = 1000; }
WAY(on_axis) { for (int i = 0; i < w->scene->n; ++i) w->origin[i] = -w->scene->q[i]; }  /* starts at 0 */
WAY(permuted)
{
    const int n = w->scene->n;
    memset(w->R, 0, sizeof w->R);
    for (int i = 0; i < n; ++i) w->R[i][(i + 1)%n] = i & 1 ? -1 : 1;
}
WAY(axes)                               /* a reflection that mixes all                                     */
{
    const int n = w->scene->n;
    real u[N], u2 = 0;
    for (int i = 0; i < n; ++i) u[i] = 1 + R(.37)*(real)i, u2 += u[i]*u[i];
    for (int i = 0; i < n; ++i) for (int j = 0; j < n; ++j) w->R[i][j] = (real)(i == j) - 2*u[i]*u[j]/u2;
}
WAY(all_of_it)
{
    axes(w);
    w->length = R(.001);
    w->time = 50;
    w->mass = 3;
    for (int i = 0; i < N; ++i) w->origin[i] = (real)i;
}
/* A frame that moves makes L read t: never at a late date, whose places are coarse */
WAY(boosted) { for (int i = 0; i < N && w->date == 0; ++i) w->speed[i] = (i & 1 ? R(-.7) : 1)/w->scene->period; }
WAY(boosted_to_rest) { for (int i = 0; i < w->scene->n && w->date == 0; ++i) w->speed[i] = -w->scene->v[i]; }
WAY(dated) { if (!(sum_of_squares(N, w->speed) > 0)) w->date = KIND == 1 ? 1000 : 10000000; }

WAY(reversed) { w->reversed = 1; }
WAY(split) { w->split = 1; }
WAY(idle) { w->idle = 1; }
WAY(gauged) { w->gauge = 1; }
WAY(as_term) { w->potential_as_term = 1; }
WAY(dense) { w->inertia = AS_DENSE; }
WAY(by_position) { w->inertia = AS_POSITION; }
WAY(kinetic_term) { w->inertia = AS_TERM; }
WAY(rows_twice) { w->doubled = 1; }
WAY(two_copies) { w->copies = 2; }
WAY(unlike_copies) { w->copies = 2; w->copy_length = unit_of(-6); w->copy_mass = unit_of(12); }
WAY(all_terms) { w->inertia = AS_TERM; w->potential_as_term = 1; axes(w); moved(w); }

FITS(has_many) { return s->n > 1; }
FITS(has_constant_mass) { return !s->mass && !s->massless; }
FITS(can_lose_its_mass) { return !s->massless && !has_clock(s); }
FITS(can_move) { return !s->mass && !has_clock(s); }
FITS(can_move_by_v) { return can_move(s) && sum_of_squares(s->n, s->v) > 0; }
FITS(has_no_date) { return !(s->tags & TIMED); }
FITS(has_no_clock) { return !has_clock(s); }
FITS(has_many_parts) { return parts_of(s) > 1; }
FITS(has_part) { return parts_of(s) > 0 && s->parts[0].kind <= GVI_LAGRANGIAN; }
FITS(has_potential) { return has_kind(s, GVI_POTENTIAL); }
FITS(all_as_terms) { return can_lose_its_mass(s) && has_potential(s); }
FITS(has_few_rows)                      /* twice as many are at most n                                     */
{
    int rows = 0;
    for (int e = 0; e < parts_of(s); ++e) if (s->parts[e].kind >= GVI_CONSTRAINT) rows += s->parts[e].rows;
    return rows > 0 && 2*rows <= s->n;
}

static const way ways[] = {
    { "plain", plain, NULL, 1 },
    { "length 1e6", large, NULL, 1 },
    { "length 1e-9", small, NULL, 1 },
    { "time 1e-6", quick, NULL, 1 },
    { "time 1e9", slow, NULL, 1 },
    { "mass 1e-27", light, NULL, 1 },
    { "units of planets", planets, NULL, 1 },
    { "units of electrons", electrons, NULL, 1 },
    { "origin", moved, NULL, 1 },
    { "origin 1e3", far_away, NULL, 1 },
    { "starts at 0", on_axis, NULL, 1 },
    { "permuted", permuted, has_many, 1 },
    { "axes", axes, has_many, 1 },
    { "axes, origin, units", all_of_it, NULL, 1 },
    { "speed", boosted, can_move, 1 },
    { "speed, starts at rest", boosted_to_rest, can_move_by_v, 1 },
    { "date 1e7", dated, has_no_date, 1 },
    { "reversed", reversed, has_many_parts, 0 },
    { "split", split, has_part, 0 },
    { "one off", idle, NULL, 0 },
    { "gauge", gauged, has_no_clock, 0 },
    { "potential as term", as_term, has_potential, 0 },
    { "mass dense", dense, has_constant_mass, 0 },
    { "mass as M(q)", by_position, has_constant_mass, 0 },
    { "mass as term", kinetic_term, can_lose_its_mass, 0 },
    { "rows twice", rows_twice, has_few_rows, 0 },
    { "two copies", two_copies, has_no_clock, 0 },
    { "two unlike copies", unlike_copies, has_no_clock, 0 },
    { "all as terms, axes, origin", all_terms, all_as_terms, 0 },
};
#define WAYS COUNT(ways)

#endif
