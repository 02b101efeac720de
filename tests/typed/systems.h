/* systems.h - Lagrangians as textbooks print them, each with its equations of motion derived by hand and, where there
   is one, its solution in closed form

   Parameters are exact in float.  HAND: accelerations a at (t, q, v).  EXACT: q at t.        */

#define HAND(name)  static void name##_by_hand(wide t, const wide *q, const wide *v, wide *a)
#define EXACT(name) static void name##_exact(wide t, wide *q)

static const double g = 9.8125, m = 1.5, k = 3, l = 0.75, Omega = 0.625;
static const wide G = 9.8125L, M = 1.5L, R = 0.75L, W = 0.625L;              /* by hand */

/* -- one degree of freedom */

LAGRANGIAN(spring, 1) { return m*v[0]*v[0]/2 - k*q[0]*q[0]/2; }
HAND(spring) { a[0] = -3/M*q[0]; }
EXACT(spring) { q[0] = cosl(sqrtl(2)*t) - sinl(sqrtl(2)*t)/(2*sqrtl(2)); }

/* Caldirola, Kanai: friction by a mass that grows */
LAGRANGIAN(damped, 1) { return exp(t/2)*(v[0]*v[0] - 2*q[0]*q[0])/2; }
HAND(damped) { a[0] = -2*q[0] - v[0]/2; }
EXACT(damped)
{
    const wide w = sqrtl(31)/4;
    q[0] = expl(-t/4)*(cosl(w*t) + sinl(w*t)/(4*w));
}

LAGRANGIAN(atwood, 1) { return (m + 1)*v[0]*v[0]/2 + (m - 1)*g*q[0]; }
HAND(atwood) { a[0] = G/5; }
EXACT(atwood) { q[0] = 1 - t/4 + G*t*t/10; }

LAGRANGIAN(simple_pendulum, 1) { return m*l*l*v[0]*v[0]/2 + m*g*l*cos(q[0]); }
HAND(simple_pendulum) { a[0] = -G/R*sinl(q[0]); }

/* Landau, Lifshitz, Mechanics, section 5, problem 3: its support on a circle, moved across, moved up and down */
LAGRANGIAN(on_a_circle, 1) { return m*l*l*v[0]*v[0]/2 + m*l*0.25*4*sin(q[0] - 2*t) + m*g*l*cos(q[0]); }
HAND(on_a_circle) { a[0] = (cosl(q[0] - 2*t) - G*sinl(q[0]))/R; }

LAGRANGIAN(moved_across, 1) { return m*l*l*v[0]*v[0]/2 + m*l*0.25*4*cos(2*t)*sin(q[0]) + m*g*l*cos(q[0]); }
HAND(moved_across) { a[0] = (cosl(2*t)*cosl(q[0]) - G*sinl(q[0]))/R; }

LAGRANGIAN(moved_up, 1)
{
    const number x = l*cos(q[0])*v[0], y = l*sin(q[0])*v[0] - 0.25*2*sin(2*t);
    return m*(x*x + y*y)/2 - m*g*(0.25*cos(2*t) - l*cos(q[0]));
}
HAND(moved_up) { a[0] = -(G - cosl(2*t))/R*sinl(q[0]); }

/* the string gets longer by 1/8 in a unit of time */
LAGRANGIAN(lengthened, 1)
{
    const number r = l + t/8;
    return m*(r*r*v[0]*v[0] + 1/64.0)/2 + m*g*r*cos(q[0]);
}
HAND(lengthened)
{
    const wide r = R + t/8;
    a[0] = -(v[0]/4 + G*sinl(q[0]))/r;
}

LAGRANGIAN(hoop, 1) { return m*l*l*(v[0]*v[0] + 25*sin(q[0])*sin(q[0]))/2 + m*g*l*cos(q[0]); }
HAND(hoop) { a[0] = sinl(q[0])*(25*cosl(q[0]) - G/R); }

LAGRANGIAN(turning_wire, 1) { return m*(v[0]*v[0] + Omega*Omega*q[0]*q[0])/2; }
HAND(turning_wire) { a[0] = W*W*q[0]; }
EXACT(turning_wire) { q[0] = coshl(W*t)/2 + sinhl(W*t)/4/W; }

LAGRANGIAN(parabola, 1) { return m*(1 + 4*q[0]*q[0])*v[0]*v[0]/2 - m*g*q[0]*q[0]; }
HAND(parabola) { a[0] = -(4*v[0]*v[0] + 2*G)*q[0]/(1 + 4*q[0]*q[0]); }

/* the tautochrone: sin(q/2) swings as a spring does */
LAGRANGIAN(cycloid, 1) { return m*l*l*(1 + cos(q[0]))*v[0]*v[0] - m*g*l*(1 - cos(q[0])); }
HAND(cycloid) { a[0] = sinl(q[0])*(v[0]*v[0]/2 - G/(2*R))/(1 + cosl(q[0])); }
EXACT(cycloid) { q[0] = 2*asinl(sinl(0.5L)*cosl(sqrtl(G/(4*R))*t)); }

LAGRANGIAN(duffing, 1) { return v[0]*v[0]/2 + q[0]*q[0]/2 - pow(q[0], 4)/4 + 0.375*q[0]*cos(1.25*t); }
HAND(duffing) { a[0] = q[0] - q[0]*q[0]*q[0] + 0.375L*cosl(1.25L*t); }

LAGRANGIAN(morse, 1) { return m*v[0]*v[0]/2 - 2*pow(1 - exp(-q[0]), 2); }
HAND(morse) { a[0] = -4/M*(1 - expl(-q[0]))*expl(-q[0]); }

/* -- several */

LAGRANGIAN(wedge, 2)
{
    return 2*v[0]*v[0]/2 + m*(v[0]*v[0] + v[1]*v[1] + 2*v[0]*v[1]*0.8125)/2 + m*g*q[1]*0.5;
}
HAND(wedge)
{
    a[1] = G/2/(1 - M*0.8125L*0.8125L/(2 + M));
    a[0] = -M*0.8125L/(2 + M)*a[1];
}
EXACT(wedge)
{
    const wide down = G/2/(1 - M*0.8125L*0.8125L/(2 + M));
    q[1] = down*t*t/2;
    q[0] = -M*0.8125L/(2 + M)*q[1];
}

/* Landau, Lifshitz, section 5, problems 1 and 2: the double pendulum; a support that slides */
LAGRANGIAN(double_pendulum, 2)
{
    return (m + 1)*l*l*v[0]*v[0]/2 + 1*0.5*0.5*v[1]*v[1]/2 + 1*l*0.5*v[0]*v[1]*cos(q[0] - q[1])
           + (m + 1)*g*l*cos(q[0]) + 1*g*0.5*cos(q[1]);
}
HAND(double_pendulum)
{
    const wide c = cosl(q[0] - q[1]), s = sinl(q[0] - q[1]), A = (M + 1)*R*R, B = 0.25L, C = R*0.5L*c,
               x = -R*0.5L*s*v[1]*v[1] - (M + 1)*G*R*sinl(q[0]), y = R*0.5L*s*v[0]*v[0] - G*0.5L*sinl(q[1]);
    a[0] = (B*x - C*y)/(A*B - C*C);
    a[1] = (A*y - C*x)/(A*B - C*C);
}

LAGRANGIAN(sliding_support, 2)
{
    return (1 + m)*v[0]*v[0]/2 + m/2*(l*l*v[1]*v[1] + 2*l*v[0]*v[1]*cos(q[1])) + m*g*l*cos(q[1]);
}
HAND(sliding_support)
{
    const wide s = sinl(q[1]), c = cosl(q[1]);
    a[1] = -(M*R*s*c*v[1]*v[1] + (1 + M)*G*s)/(R*(1 + M*s*s));
    a[0] = M*R*(s*v[1]*v[1] - c*a[1])/(1 + M);
}

LAGRANGIAN(spherical_pendulum, 2)
{
    return m*l*l*(v[0]*v[0] + sin(q[0])*sin(q[0])*v[1]*v[1])/2 + m*g*l*cos(q[0]);
}
HAND(spherical_pendulum)
{
    a[0] = sinl(q[0])*(cosl(q[0])*v[1]*v[1] - G/R);
    a[1] = -2*v[0]*v[1]*cosl(q[0])/sinl(q[0]);
}

LAGRANGIAN(spring_pendulum, 2)
{
    return m*(v[0]*v[0] + q[0]*q[0]*v[1]*v[1])/2 + m*g*q[0]*cos(q[1]) - 40*pow(q[0] - l, 2)/2;
}
HAND(spring_pendulum)
{
    a[0] = q[0]*v[1]*v[1] + G*cosl(q[1]) - 40/M*(q[0] - R);
    a[1] = -(2*v[0]*v[1] + G*sinl(q[1]))/q[0];
}

LAGRANGIAN(swinging_atwood, 2)
{
    return (3 + 1)*v[0]*v[0]/2 + q[0]*q[0]*v[1]*v[1]/2 - 3*g*q[0] + g*q[0]*cos(q[1]);
}
HAND(swinging_atwood)
{
    a[0] = (q[0]*v[1]*v[1] - 3*G + G*cosl(q[1]))/4;
    a[1] = -(2*v[0]*v[1] + G*sinl(q[1]))/q[0];
}

/* inside a cone of half its angle 45 degrees */
LAGRANGIAN(cone, 2) { return m*(2*v[0]*v[0] + q[0]*q[0]*v[1]*v[1])/2 - m*g*q[0]; }
HAND(cone)
{
    a[0] = (q[0]*v[1]*v[1] - G)/2;
    a[1] = -2*v[0]*v[1]/q[0];
}

/* from its pericentre, e = 0.5, a = 1, for one period: back to the start */
LAGRANGIAN(kepler, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + pow(q[0]*q[0] + q[1]*q[1], -0.5); }
HAND(kepler)
{
    const wide r = hypotl(q[0], q[1]);
    for (int i = 0; i < 2; ++i) a[i] = -q[i]/(r*r*r);
}

/* a straight line, in polar coordinates */
LAGRANGIAN(polar, 2) { return m*(pow(v[0], 2) + pow(q[0]*v[1], 2))/2; }
HAND(polar)
{
    a[0] = q[0]*v[1]*v[1];
    a[1] = -2*v[0]*v[1]/q[0];
}
EXACT(polar)
{
    q[0] = hypotl(1 - t/4, t/2);
    q[1] = atan2l(t/2, 1 - t/4);
}

LAGRANGIAN(kepler_polar, 2) { return m*(v[0]*v[0] + q[0]*q[0]*v[1]*v[1])/2 + k/q[0]; }
HAND(kepler_polar)
{
    a[0] = q[0]*v[1]*v[1] - 2/(q[0]*q[0]);
    a[1] = -2*v[0]*v[1]/q[0];
}

LAGRANGIAN(henon_heiles, 2)
{
    const number x = q[0], y = q[1];
    return (v[0]*v[0] + v[1]*v[1])/2 - (x*x + y*y)/2 - x*x*y + y*y*y/3;
}
HAND(henon_heiles)
{
    a[0] = -q[0] - 2*q[0]*q[1];
    a[1] = -q[1] - q[0]*q[0] + q[1]*q[1];
}

/* Foucault; Coriolis: z = x + iy, z'' + 2i Omega z' + w^2 z = 0 */
LAGRANGIAN(foucault, 2)
{
    return (v[0]*v[0] + v[1]*v[1])/2 + Omega*(q[0]*v[1] - q[1]*v[0]) - 9*(q[0]*q[0] + q[1]*q[1])/2;
}
HAND(foucault)
{
    a[0] = 2*W*v[1] - 9*q[0];
    a[1] = -2*W*v[0] - 9*q[1];
}
EXACT(foucault)
{
    const wide w = sqrtl(9 + W*W), x = cosl(w*t), y = W*sinl(w*t)/w;
    q[0] = x*cosl(W*t) + y*sinl(W*t);
    q[1] = y*cosl(W*t) - x*sinl(W*t);
}

LAGRANGIAN(rotating_frame, 2) { return m*(pow(v[0] - Omega*q[1], 2) + pow(v[1] + Omega*q[0], 2))/2; }
HAND(rotating_frame)
{
    a[0] = 2*W*v[1] + W*W*q[0];
    a[1] = -2*W*v[0] + W*W*q[1];
}
EXACT(rotating_frame)      /* in space: (1, Omega t) */
{
    q[0] = cosl(W*t) + W*t*sinl(W*t);
    q[1] = W*t*cosl(W*t) - sinl(W*t);
}

LAGRANGIAN(three_bodies_restricted, 2)
{
    const double mu = 0.125;
    const number x = q[0], y = q[1];
    return (pow(v[0] - y, 2) + pow(v[1] + x, 2))/2 + (1 - mu)/hypot(x + mu, y) + mu/hypot(x - 1 + mu, y);
}
HAND(three_bodies_restricted)
{
    const wide mu = 0.125L, x = q[0], y = q[1], A = (1 - mu)/powl(hypotl(x + mu, y), 3), B = mu/powl(hypotl(x - 1 + mu, y), 3);
    a[0] = 2*v[1] + x - A*(x + mu) - B*(x - 1 + mu);
    a[1] = -2*v[0] + y - (A + B)*y;
}

/* a charge in crossed fields, in Landau's gauge */
LAGRANGIAN(crossed_fields, 2) { return m*(v[0]*v[0] + v[1]*v[1])/2 + 3*q[0]*v[1] + 2*q[0]; }
HAND(crossed_fields)
{
    a[0] = (3*v[1] + 2)/M;
    a[1] = -3*v[0]/M;
}
EXACT(crossed_fields)
{
    q[0] = (1 - cosl(2*t))/3;
    q[1] = -2*t/3 + sinl(2*t)/3;
}

/* Larmor: the charge of a uniform field in a trap, in polar coordinates */
LAGRANGIAN(larmor, 2) { return (v[0]*v[0] + q[0]*q[0]*v[1]*v[1])/2 + q[0]*q[0]*v[1] - 1.5*q[0]*q[0]; }
HAND(larmor)
{
    a[0] = q[0]*(v[1]*v[1] + 2*v[1] - 3);
    a[1] = -2*v[0]*(v[1] + 1)/q[0];
}
EXACT(larmor)              /* turning with -1: an oscillator of frequency 2, from (1, 0) with (0, 1) */
{
    q[0] = hypotl(cosl(2*t), sinl(2*t)/2);
    q[1] = atan2l(sinl(2*t)/2, cosl(2*t)) - t;
}

/* -- near the speed of light */

LAGRANGIAN(hyperbolic, 1) { return -4*sqrt(1 - v[0]*v[0]/4) + q[0]; }
HAND(hyperbolic) { a[0] = powl(1 - v[0]*v[0]/4, 1.5L); }
EXACT(hyperbolic) { q[0] = 4*(sqrtl(1 + t*t/4) - 1); }

LAGRANGIAN(relativistic_spring, 1) { return -4*sqrt(1 - v[0]*v[0]/4) - q[0]*q[0]/2; }
HAND(relativistic_spring) { a[0] = -q[0]*powl(1 - v[0]*v[0]/4, 1.5L); }

LAGRANGIAN(synchrotron, 2)
{
    return -4*sqrt(1 - (v[0]*v[0] + v[1]*v[1])/4) + 2*(q[0]*v[1] - q[1]*v[0])/2;
}
HAND(synchrotron)
{
    const wide w = 2*sqrtl(1 - (v[0]*v[0] + v[1]*v[1])/4);
    a[0] = w*v[1];
    a[1] = -w*v[0];
}
EXACT(synchrotron)
{
    const wide w = 2*sqrtl(1 - 1.5625L/4);
    q[0] = (1 - cosl(w*t))*1.25L/w;
    q[1] = sinl(w*t)*1.25L/w;
}

/* -- geodesics */

LAGRANGIAN(sphere, 2) { return (v[0]*v[0] + sin(q[0])*sin(q[0])*v[1]*v[1])/2; }
HAND(sphere)
{
    a[0] = sinl(q[0])*cosl(q[0])*v[1]*v[1];
    a[1] = -2*v[0]*v[1]*cosl(q[0])/sinl(q[0]);
}
EXACT(sphere)              /* a great circle, from q = (1, 0) with v = (0, 1) */
{
    const wide s = sinl(1)*t;
    q[0] = acosl(cosl(1)*cosl(s));
    q[1] = atan2l(sinl(s), sinl(1)*cosl(s));
}

LAGRANGIAN(half_plane, 2) { return (v[0]*v[0] + v[1]*v[1])/(2*q[1]*q[1]); }
HAND(half_plane)
{
    a[0] = 2*v[0]*v[1]/q[1];
    a[1] = (v[1]*v[1] - v[0]*v[0])/q[1];
}
EXACT(half_plane)
{
    q[0] = tanhl(t);
    q[1] = 1/coshl(t);
}

LAGRANGIAN(torus, 2) { return (v[0]*v[0] + pow(2 + cos(q[0]), 2)*v[1]*v[1])/2; }
HAND(torus)
{
    a[0] = -(2 + cosl(q[0]))*sinl(q[0])*v[1]*v[1];
    a[1] = 2*sinl(q[0])*v[0]*v[1]/(2 + cosl(q[0]));
}

/* light and planets near a mass of 1: t, r, phi; its metric is not definite */
LAGRANGIAN(schwarzschild, 3)
{
    const number f = 1 - 2/q[1];
    return (-f*v[0]*v[0] + v[1]*v[1]/f + q[1]*q[1]*v[2]*v[2])/2;
}
HAND(schwarzschild)
{
    const wide r = q[1], f = 1 - 2/r;
    a[0] = -2/(r*r*f)*v[0]*v[1];
    a[1] = -f/(r*r)*v[0]*v[0] + v[1]*v[1]/(r*r*f) + r*f*v[2]*v[2];
    a[2] = -2/r*v[1]*v[2];
}

/* -- three and more */

/* Lagrange's top: theta, phi, psi */
LAGRANGIAN(top, 3)
{
    return 2*(v[0]*v[0] + pow(sin(q[0])*v[1], 2))/2 + 1*pow(v[2] + v[1]*cos(q[0]), 2)/2 - m*g*l*cos(q[0]);
}
HAND(top)
{
    const wide s = sinl(q[0]), c = cosl(q[0]), w = v[2] + v[1]*c;
    a[0] = s*c*v[1]*v[1] - w*v[1]*s/2 + M*G*R*s/2;
    a[1] = (w/2 - 2*v[1]*c)*v[0]/s;
    a[2] = -a[1]*c + v[1]*s*v[0];
}

LAGRANGIAN(toda, 3)
{
    return (v[0]*v[0] + v[1]*v[1] + v[2]*v[2])/2 - exp(q[0] - q[1]) - exp(q[1] - q[2]) - exp(q[2] - q[0]);
}
HAND(toda)
{
    for (int i = 0; i < 3; ++i) a[i] = expl(q[(i + 2)%3] - q[i]) - expl(q[i] - q[(i + 1)%3]);
}

/* two masses between three springs: sums and differences swing by themselves */
LAGRANGIAN(three_springs, 2)
{
    return m*(v[0]*v[0] + v[1]*v[1])/2 - k*(q[0]*q[0] + pow(q[0] - q[1], 2) + q[1]*q[1])/2;
}
HAND(three_springs)
{
    a[0] = 2*(q[1] - 2*q[0]);
    a[1] = 2*(q[0] - 2*q[1]);
}
EXACT(three_springs)
{
    q[0] = (cosl(sqrtl(2)*t) + cosl(sqrtl(6)*t))/2;
    q[1] = (cosl(sqrtl(2)*t) - cosl(sqrtl(6)*t))/2;
}

/* two circuits, coupled by their coils */
LAGRANGIAN(circuits, 2) { return 2*v[0]*v[0]/2 + v[1]*v[1]/2 + 0.5*v[0]*v[1] - q[0]*q[0]/(2*0.5) - q[1]*q[1]/(2*0.25); }
HAND(circuits)
{
    a[0] = (-2*q[0] + 2*q[1])/1.75L;
    a[1] = (q[0] - 8*q[1])/1.75L;
}

/* three equal masses in the plane */
LAGRANGIAN(three_bodies, 6)
{
    number L = 0;
    for (int i = 0; i < 3; ++i) {
        L += (v[2*i]*v[2*i] + v[2*i+1]*v[2*i+1])/2;
        for (int j = 0; j < i; ++j) L += 1/sqrt(pow(q[2*i] - q[2*j], 2) + pow(q[2*i+1] - q[2*j+1], 2));
    }
    return L;
}
HAND(three_bodies)
{
    for (int i = 0; i < 3; ++i) {
        a[2*i] = a[2*i+1] = 0;
        for (int j = 0; j < 3; ++j) {
            const wide x = q[2*j] - q[2*i], y = q[2*j+1] - q[2*i+1], r = hypotl(x, y);
            if (i == j) continue;
            a[2*i] += x/(r*r*r);
            a[2*i+1] += y/(r*r*r);
        }
    }
}

/* name, kind, T, steps, q, v at the start; S has a solution in closed form */
#define SYSTEMS(N, S)                                                                           \
    S(spring, POTENTIAL, 8, 64, LIST(1), LIST(-.5))                                             \
    S(damped, MASS, 8, 64, LIST(1), LIST(0))                                                    \
    S(atwood, POTENTIAL, 4, 16, LIST(1), LIST(-.25))                                            \
    N(simple_pendulum, POTENTIAL, 8, 128, LIST(2.5), LIST(0))                                   \
    N(on_a_circle, POTENTIAL, 8, 128, LIST(.5), LIST(1))                                        \
    N(moved_across, POTENTIAL, 8, 128, LIST(.5), LIST(1))                                       \
    N(moved_up, LINEAR, 8, 128, LIST(.5), LIST(1))                                              \
    N(lengthened, MASS, 8, 128, LIST(1), LIST(.5))                                              \
    N(hoop, POTENTIAL, 8, 128, LIST(.5), LIST(.25))                                             \
    S(turning_wire, POTENTIAL, 4, 32, LIST(.5), LIST(.25))                                      \
    N(parabola, MASS, 8, 256, LIST(1), LIST(.5))                                                \
    S(cycloid, MASS, 8, 128, LIST(1), LIST(0))                                                  \
    N(duffing, POTENTIAL, 16, 128, LIST(1), LIST(.25))                                          \
    N(morse, POTENTIAL, 8, 128, LIST(.5), LIST(1))                                              \
    S(wedge, POTENTIAL, 2, 16, LIST(0, 0), LIST(0, 0))                                          \
    N(double_pendulum, MASS, 4, 128, LIST(1, .5), LIST(0, .25))                                 \
    N(sliding_support, MASS, 4, 128, LIST(0, 1), LIST(.25, 0))                                  \
    N(spherical_pendulum, MASS, 8, 256, LIST(1, 0), LIST(.25, 2))                               \
    N(spring_pendulum, MASS, 4, 128, LIST(1, .5), LIST(0, .25))                                 \
    N(swinging_atwood, MASS, 2, 128, LIST(1, 1.5), LIST(0, 0))                                  \
    N(cone, MASS, 4, 128, LIST(1, 0), LIST(0, 3.5))                                             \
    N(kepler, POTENTIAL, 6.25, 128, LIST(.5, 0), LIST(0, 1.75))                                 \
    S(polar, MASS, 4, 64, LIST(1, 0), LIST(-.25, .5))                                           \
    N(kepler_polar, MASS, 8, 128, LIST(1, 0), LIST(.25, 1.5))                                   \
    N(henon_heiles, POTENTIAL, 16, 128, LIST(.25, .125), LIST(.25, .25))                        \
    S(foucault, LINEAR, 8, 128, LIST(1, 0), LIST(0, 0))                                         \
    S(rotating_frame, LINEAR, 4, 64, LIST(1, 0), LIST(0, 0))                                    \
    N(three_bodies_restricted, LINEAR, 4, 256, LIST(-.75, 0), LIST(0, -.5))                    \
    S(crossed_fields, LINEAR, 8, 64, LIST(0, 0), LIST(0, 0))                                    \
    S(larmor, MASS_LINEAR, 1, 64, LIST(1, 0), LIST(0, 0))                                       \
    S(hyperbolic, GENERAL, 4, 64, LIST(0), LIST(0))                                             \
    N(relativistic_spring, GENERAL, 8, 128, LIST(1.5), LIST(0))                                 \
    S(synchrotron, GENERAL, 4, 64, LIST(0, 0), LIST(0, 1.25))                                    \
    S(sphere, MASS, 1.5, 64, LIST(1, 0), LIST(0, 1))                                            \
    S(half_plane, MASS, 2, 64, LIST(0, 1), LIST(1, 0))                                          \
    N(torus, MASS, 8, 128, LIST(1, 0), LIST(.25, .5))                                           \
    N(schwarzschild, MASS, 32, 64, LIST(0, 8, 0), LIST(1.25, -.0625, .0625))                    \
    N(top, MASS, 4, 128, LIST(.5, 0, 0), LIST(0, 0, 16))                                        \
    N(toda, POTENTIAL, 8, 128, LIST(.5, -.25, 0), LIST(.5, 0, -.5))                             \
    S(three_springs, POTENTIAL, 8, 128, LIST(1, 0), LIST(0, 0))                                 \
    N(circuits, POTENTIAL, 8, 128, LIST(1, .5), LIST(0, .25))                                   \
    N(three_bodies, POTENTIAL, 4, 512, LIST(1, 0, -.5, .75, -.25, -1), LIST(0, .5, -.5, -.25, .5, -.25))
