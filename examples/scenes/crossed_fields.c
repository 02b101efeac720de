/* A proton in crossed fields: it drifts across both with speed E/B

   SI units throughout, so that masses of 1e-27 kg, times of 1e-6 s and charges of
   1e-19 C (CODATA 2018) meet: nothing in the library depends on units.
   B = 10 mT along z, E = 100 V/m along y; the drift is 10 km/s along x.       */
#include "scene.h"

static const gvi_real proton_mass[] = { 1.67262192369e-27, 1.67262192369e-27, 1.67262192369e-27 };
static const gvi_real proton_charge[] = { 1.602176634e-19 };
static const struct uniform_field proton_electric = { { 0, 1, 3 }, proton_charge, { 0, 100, 0 } };
static const struct magnetic proton_magnetic = { { 0, 1, 3 }, proton_charge, { 0, 0, 0.01 } };

static void crossed_fields_build(scene_setup *s)
{
    s->v[0] = -2e4;
    s->v[2] = 3e3;
    s->desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = proton_mass };
    scene_add(s, "electric", uniform_field(&proton_electric));
    scene_add(s, "magnetic", magnetic_field(&proton_magnetic));
}

static void crossed_fields_place(const gvi_real *q, const gvi_real *v, double (*xy)[2])
{
    scene_project(100*(double)q[0], 100*(double)q[1], 100*(double)q[2], 0, 1.2, xy[0]);
    (void)v;
}

/* m v_x - e B y and m v_z: the fields are the same everywhere along x and z.  */
static void crossed_fields_quantities(const gvi_real *q, const gvi_real *v, const gvi_real *p, gvi_real *out)
{
    out[0] = proton_mass[0]*v[0] - proton_charge[0]*proton_magnetic.B[2]*q[1];
    out[1] = proton_mass[0]*v[2];
    (void)p;
}

static const double proton_sizes[] = { 6 };

static const scene crossed_fields = {
    .name = "crossed_fields", .title = "A proton in crossed fields", .n = 3, .degree = 8,
    .h = 5e-7, .duration = 5e-5, .build = crossed_fields_build,
    .energy_unit = "eV", .energy_scale = 1/1.602176634e-19, .time_unit = "us", .time_scale = 1e6,
    .conserved = { "m vx - e B y", "m vz" }, .quantities = crossed_fields_quantities,
    .caption = "B towards the eye, E upwards", .unit = "cm", .points = 1, .trails = 1, .samples = 6,
    .place = crossed_fields_place, .sizes = proton_sizes, .seconds = 12,
};
