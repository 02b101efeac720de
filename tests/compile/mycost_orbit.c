/* A file for `make mycost`: a satellite of rows of effects.h. */
#include "tools/effects.h"

static const double orbit_mass[] = { 1, 1, 1 };
static const struct central_gravity earth = { { 0, 1, 3 }, orbit_mass, 1, { 0, 0, 0 } };
static const struct oblateness bulge = { { 0, 1, 3 }, orbit_mass, 1, 1, 1.08262668e-3 };

static gvi_desc mine(void)
{
    static gvi_effect rows[2];
    rows[0] = central_gravity(&earth);
    rows[1] = oblateness(&bulge);
    return (gvi_desc){ .n = 3, .effects = rows, .effect_count = 2 };
}
static const double mine_q[] = { 1.1, 0, 0 }, mine_v[] = { 0, 0.7, 0.7 };
static const double mine_horizon = 20, mine_h = 0.2;
