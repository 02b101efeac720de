/* scenes.c - the list of scenes, each from a file of its own

   Compile it with the program that uses scene.h, or include it there.         */
#include "scene.h"

#include "outer_solar_system.c"
#include "satellite.c"
#include "arenstorf.c"
#include "figure_eight.c"
#include "double_pendulum.c"
#include "elastic_pendulum.c"
#include "lagrange_top.c"
#include "robot_arm.c"
#include "fput.c"
#include "net.c"
#include "crossed_fields.c"
#include "duffing.c"
#include "hanging_chain.c"
#include "peaucellier.c"

const scene *const scenes[] = {
    &outer_solar_system, &satellite, &arenstorf, &figure_eight, &double_pendulum, &elastic_pendulum,
    &lagrange_top, &robot_arm, &fput, &net, &crossed_fields, &duffing,
    &hanging_chain, &peaucellier,
};
const int scene_count = (int)(sizeof scenes/sizeof *scenes);
