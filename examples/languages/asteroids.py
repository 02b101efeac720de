"""asteroids.py - by gvi.py: the perihelia of an asteroid, and 1,000 asteroids on all processors

    python3 asteroids.py                 (an argument: a picture of the orbits, by matplotlib)

Days and astronomical units.  The first part has an orbit like Apophis's about the Sun alone, so that Kepler's third law
says when it is at its perihelia.  In the second one, Jupiter moves on a circle, and the Jacobi constant of an asteroid
stays.  A stepper takes 50 of them at once, with 150 coordinates: a callback in Python costs about as much as for one.

prints

2029-01-01 is the first perihelion, 2029-11-20, 2030-10-10, 2031-08-30 the next three
as Kepler says, within 1e-9 days: True
1000 asteroids over 1000 days: Jacobi constants within 1e-12: True
"""
import datetime
import multiprocessing
import sys

import numpy as np

import gvi

SUN, JUPITER, RADIUS = 0.01720209895**2, 0.01720209895**2/1047.3486, 5.2026
TURN = np.sqrt((SUN + JUPITER)/RADIUS**3)              # of Jupiter, in a day


def perihelia(count):
    """their times, and where the asteroid was on the way"""
    a, e = 0.9226, 0.1914

    def attraction(x):
        x.f -= SUN*x.q/np.hypot(*x.q)**3

    asteroid = gvi.Stepper(2, [gvi.Effect(attraction)], resolution=1e-14)
    asteroid.start(0, [a*(1 - e), 0], [0, np.sqrt(SUN/a*(1 + e)/(1 - e))])
    times, track = [], []
    while len(times) < count:
        asteroid.advance(2000)
        track.append(asteroid.q.copy())
        nearing = asteroid.q@asteroid.velocity() < 0
        t = asteroid.event(lambda t, q, v: q@v)
        if t is not None and t > 1 and not nearing:    # it starts at one
            times.append(t)
    return np.array(times), np.array(track), 2*np.pi*np.sqrt(a**3/SUN)


def attractions(x):
    """of the Sun and Jupiter, with their centre of mass at rest, on 50 asteroids at all points"""
    q, f = x.q.reshape(-1, 3, x.count), x.f.reshape(-1, 3, x.count)
    way = np.array([np.cos(TURN*x.t), np.sin(TURN*x.t), 0*x.t])*RADIUS/(SUN + JUPITER)
    for gm, centre in ((SUN, -JUPITER*way), (JUPITER, SUN*way)):
        d = q - centre
        f -= gm*d/np.sum(d*d, axis=1, keepdims=True)**1.5


def jacobi(t, q, v):
    way = np.array([np.cos(TURN*t), np.sin(TURN*t), 0])*RADIUS/(SUN + JUPITER)
    return ((v**2).sum(1)/2 - TURN*(q[:, 0]*v[:, 1] - q[:, 1]*v[:, 0])
            - SUN/np.linalg.norm(q + JUPITER*way, axis=1) - JUPITER/np.linalg.norm(q - SUN*way, axis=1))


def group(seed):
    """50 asteroids of the main belt after 1,000 days, and how far their Jacobi constants are off"""
    random = np.random.default_rng(seed)
    a, angle, tilt = random.uniform(2.1, 3.3, 50), random.uniform(0, 2*np.pi, 50), random.normal(0, 0.1, 50)
    e = random.uniform(0, 0.2, 50)
    q = np.stack([np.cos(angle), np.sin(angle), 0*a], 1)*(a*(1 - e))[:, None]
    v = np.stack([-np.sin(angle)*np.cos(tilt), np.cos(angle)*np.cos(tilt), np.sin(tilt)], 1)
    v *= np.sqrt(SUN/a*(1 + e)/(1 - e))[:, None]
    belt = gvi.Stepper(150, [gvi.Effect(attractions)])
    belt.start(0, q.ravel(), v.ravel())
    belt.steps(40, 25)
    before, after = jacobi(0, q, v), jacobi(belt.t, belt.q.reshape(-1, 3), belt.velocity().reshape(-1, 3))
    return belt.q.reshape(-1, 3).copy(), np.abs(after/before - 1).max()


def main(picture=None):
    times, track, period = perihelia(3)
    first = datetime.date(2029, 1, 1)
    print(first, "is the first perihelion,", ", ".join(str(first + datetime.timedelta(t)) for t in times), "the next three")
    print("as Kepler says, within 1e-9 days:", np.abs(times - period*np.arange(1, 4)).max() < 1e-9)
    with multiprocessing.Pool() as pool:
        places, off = zip(*pool.map(group, range(20)))
    places = np.concatenate(places)
    print(len(places), "asteroids over 1000 days: Jacobi constants within 1e-12:", max(off) < 1e-12)
    if picture:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        plt.plot(places[:, 0], places[:, 1], ".", markersize=2)
        plt.plot(track[:, 0], track[:, 1], linewidth=1)
        plt.plot(0, 0, "o")
        plt.axis("equal")
        plt.savefig(picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
