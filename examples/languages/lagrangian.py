"""lagrangian.py - L or H typed in Python, and nothing else

    python3 lagrangian.py                (an argument: a picture of planet and moon, by matplotlib)

The text is Python's syntax; it is compiled once, derivatives included, into the user's cache.  Beside this file there
are gvi.py, gvi.h and tools/lagrangian.h, or it is where it is in a clone.

prints

double pendulum: ok: q = 0.631257632 0.436538384
L is v'M(t,q)v/2 - V(t,q), energy within 1e-12: True
planet with moon: 1000 days, energy within 1e-12: True
a bead on a hoop that stands: g = 0 to rounding: True
damped oscillator against its formula, within 1e-12: True
two vortices on their circle, within 1e-12: True
refused: v[0]**2/2 - k*q[0]**2: k is missing
refused: q[0]*v[1] - q[1]*v[0]: L is linear in v: its equations are of first order; give H(t,q,p) to gvi.hamiltonian
"""
import sys

import numpy as np

import gvi


def double_pendulum():
    run = gvi.lagrangian("v[0]**2 + v[1]**2/2 + v[0]*v[1]*cos(q[0] - q[1]) + 2*g*cos(q[0]) + g*cos(q[1])", n=2, g=9.81)
    run.start(0, [0.8, 0.5], [0, 0])
    energy = run.energy()
    run.steps(1/16, 1600)
    print(f"double pendulum: {run.why()}: q = {run.q[0]:.9f} {run.q[1]:.9f}")
    print(f"L is {run.text}, energy within 1e-12:", abs(run.energy() - energy) < 1e-12)


def planet_with_moon():
    """au, days, solar masses; the sun is at the origin"""
    run = gvi.lagrangian("""
x = q[2] - q[0]; y = q[3] - q[1]
M*(v[0]**2 + v[1]**2)/2 + m*(v[2]**2 + v[3]**2)/2 + k*M/hypot(q[0], q[1]) + k*m/hypot(q[2], q[3]) + k*M*m/hypot(x, y)""",
                         n=4, k=2.9591220828559e-4, M=3.0034896e-6, m=3.69431e-8, resolution=1e-13)
    run.start(0, [1, 0, 1.00257, 0], [0, 0.0172021, 0, 0.0172021 + 0.00058932])
    energy, track = run.energy(), []
    while run.t < 1000:
        run.advance(1000)
        track.append(run.q.copy())
    print(f"planet with moon: {run.t:.0f} days, energy within 1e-12:", abs(run.energy()/energy - 1) < 1e-12)
    return np.array(track)


def hoop():
    run = gvi.lagrangian("(v[0]**2 + v[1]**2)/2 - g*q[1]", n=2, holds="q[0]**2 + q[1]**2 - r**2", g=9.81, r=2)
    run.start(0, [2, 0], [0, 0])
    run.steps(0.02, 500)
    print("a bead on a hoop that stands: g = 0 to rounding:", abs(run.q@run.q - 4) < 1e-13)


def damped():
    """x'' = -x - x'/5: exp(-t/10) (cos(w t) + sin(w t)/(10 w)), w^2 = 1 - 1/100"""
    run = gvi.lagrangian("v[0]**2/2 - q[0]**2/2", n=1, F="b*v[0]**2/2", b=0.2)
    run.start(0, [1], [0])
    run.steps(0.25, 40)
    w = np.sqrt(0.99)
    exact = np.exp(-1)*(np.cos(10*w) + np.sin(10*w)/(10*w))
    print("damped oscillator against its formula, within 1e-12:", abs(run.q[0] - exact) < 1e-12)


def vortices():
    """of strengths 1 and 2, q = x and p = strength times y; a distance of 1 turns at the rate 3/(2 pi)"""
    run = gvi.hamiltonian("-2*log((q[0] - q[1])**2 + (p[0] - p[1]/2)**2)/(4*pi)", n=2)
    run.start(0, [-2/3, 1/3], [0, 0])
    run.steps(0.1, 100)
    x, y = run.q, run.p/[1, 2]
    angle = 30/(2*np.pi)
    off = np.hypot(x - np.cos(angle)*np.array([-2/3, 1/3]), y - np.sin(angle)*np.array([-2/3, 1/3]))
    print("two vortices on their circle, within 1e-12:", off.max() < 1e-12)


def main(picture=None):
    double_pendulum()
    track = planet_with_moon()
    hoop()
    damped()
    vortices()
    text = "v[0]**2/2 - k*q[0]**2"
    try:
        gvi.lagrangian(text, n=1)
    except ValueError as why:
        print(f"refused: {text}: k is missing" if str(why).startswith("k:") else why)
    text = "q[0]*v[1] - q[1]*v[0]"
    try:
        gvi.lagrangian(text, n=2).start(0, [1, 2], [1, 1])
    except ValueError as why:
        print(f"refused: {text}: {why}")
    if picture:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        far = 30*(track[:, 2:] - track[:, :2])             # the moon's distance, 30 times
        plt.plot(*track[:, :2].T)
        plt.plot(*(track[:, :2] + far).T)
        plt.axis("equal")
        plt.savefig(picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
