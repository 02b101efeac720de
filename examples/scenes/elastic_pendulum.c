/* An elastic pendulum: 1 kg on a spring, tuned so that bouncing and swinging
   exchange their energy

   At rest the spring is 1 m long; k/m = 4 g/l makes the bounce twice as fast as
   the swing, the resonance of Vitt and Gorelik (1933).                        */
#include "scene.h"

static const gvi_real elastic_mass[] = { 1 };
static const struct uniform_field elastic_weight = { { 0, 1, 2 }, elastic_mass, { 0, -9.81, 0 } };
static const struct tether elastic_spring[] = { { 0, 4*9.81, 0.75, { 0, 0, 0 } } };
static const struct tethers elastic_springs = { { 0, 1, 2 }, elastic_spring, 1, 2 };

static void elastic_pendulum_build(scene_setup *s)
{
    s->q[0] = 0.04;
    s->q[1] = -1.14;
    scene_add(s, "weight", uniform_field(&elastic_weight));
    scene_add(s, "spring", tethers(&elastic_springs));
}

static void elastic_pendulum_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    xy[0][0] = xy[0][1] = 0;
    scene_place_plane(1, q, xy + 1);
    (void)v;
}

/* Energy of the linear motion across and along.                               */
static void elastic_pendulum_curves(const gvi_real *q, const gvi_real *v, double *out)
{
    const double x = (double)q[0], y = (double)q[1] + 1, u = (double)v[0], w = (double)v[1];
    out[0] = (u*u + 9.81*x*x)/2;
    out[1] = (w*w + 4*9.81*y*y)/2;
}

static const double elastic_sizes[] = { 4, 10 };

static const scene elastic_pendulum = {
    .name = "elastic_pendulum", .title = "Elastic pendulum in resonance", .n = 2, .degree = 8,
    .h = 0.1, .duration = 40, .build = elastic_pendulum_build,
    .energy_unit = "J", .energy_scale = 1, .time_unit = "s", .time_scale = 1,
    .caption = "", .unit = "m", .points = 2, .trail_first = 1, .trails = 1, .samples = 2,
    .place = elastic_pendulum_place, .sizes = elastic_sizes, .lines = { { 0, 1, 2 } },
    .seconds = 30, .view = { -0.75, 0.75, -1.4, 0.1 },
    .curves_title = "energy, J", .curve_names = { "swing", "bounce" }, .curves = elastic_pendulum_curves,
};
