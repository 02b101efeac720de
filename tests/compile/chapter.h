/* chapter.h - a chapter written for a test alone: counts the steps and evaluations of a scene, and how often it makes stages.
   chapters.sh plugs it into a copy of gvi.h, as follows: what stands behind `@` is the place, the rest its line. */
#if 0
@ TYPES                      struct gvi__tally { gvi_real *count; };   /* [3] in the caller's memory */
@ gvi__private               struct gvi__tally tally;
@ GVI__CHAPTERS              GVI__IN_TALLY = 256,
@ GVI__CHAPTERS |            | GVI__IN_TALLY
@ gvi__place_chosen          in->parts |= GVI__IN_TALLY;
@ gvi__place_layout          gvi__tally_layout(in, a);
@ gvi__place_stages          GVI__IF(TALLY, gvi__tally_count(st, GVI__TALLY_STAGES))
@ gvi__place_evaluate        GVI__IF(TALLY, gvi__tally_count(st, GVI__TALLY_EVALUATIONS))
@ gvi__place_commit          GVI__IF(TALLY, gvi__tally_count(st, GVI__TALLY_STEPS))
#endif

enum { GVI__TALLY_STEPS, GVI__TALLY_STAGES, GVI__TALLY_EVALUATIONS, GVI__TALLIES };

GVI__COLD void gvi__tally_layout(struct gvi__private *in, gvi__arena *a)
{
    in->tally.count = gvi__take(a, GVI__TALLIES, 1);
}

static void gvi__tally_count(const gvi_stepper *st, int what) { st->in.tally.count[what] += 1; }
