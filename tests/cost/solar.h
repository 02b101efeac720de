/* solar.h - Sun, Jupiter, Saturn, Uranus, Neptune, Pluto: Hairer, Lubich, Wanner, Geometric numerical
   integration, I.2.4; astronomical units and days                                             */
#ifndef SOLAR_H
#define SOLAR_H

/* Masses times the constant of gravitation, one for each coordinate: 2.95912208286e-4 times
   1.00000597682, 9.54786104043e-4, 2.85583733151e-4, 4.37273164546e-5, 5.17759138449e-5, 1/1.3e8 */
#define THRICE(a) a, a, a
static const double solar_mass[18] = {
    THRICE(0x1.3649cda6c4954p-12), THRICE(0x1.2f5e0adcea3e9p-22), THRICE(0x1.6af5369599412p-24),
    THRICE(0x1.bc9893d604ea6p-27), THRICE(0x1.073705365b3cdp-26), THRICE(0x1.405a77e6ee075p-39) };
static const double solar_q[18] = {
    0, 0, 0, -3.5023653, -3.8169847, -1.5507963, 9.0755314, -3.0458353, -1.6483708,
    8.3101420, -16.2901086, -7.2521278, 11.4707666, -25.7294829, -10.8169456,
    -15.5387357, -25.2225594, -3.1902382 };
static const double solar_v[18] = {
    0, 0, 0, 0.00565429, -0.00412490, -0.00190589, 0.00168318, 0.00483525, 0.00192462,
    0.00354178, 0.00137102, 0.00055029, 0.00288930, 0.00114527, 0.00039677,
    0.00276725, -0.00170702, -0.00136504 };

#endif
