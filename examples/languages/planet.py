"""planet.py - the planet of the README from Python, by gvi.py

    python3 planet.py                    (an argument: a picture of the orbit, by matplotlib)

prints

ok: q = -0.602737580 0.799997002
energy within 1e-13 of -0.5: True
a name that is missing: NameError, after 1 call; q is as it was: True
x.f = ... in place of x.f -= ...: AttributeError
2 constraint rows of a pendulum as multipliers within 1e-12 of its forces: True
the rule with 5 points has order 10: True
"""
import sys

import numpy as np

import gvi


def attraction(x):
    x.f -= x.q/np.hypot(*x.q)**3


def potential(x):
    x.value -= 1/np.hypot(*x.q)


def fails(effect):
    """the exception in the step where `effect` takes over, its calls, and whether the state stays"""
    calls = []

    def replaced(x):
        calls.append(x.count)
        effect(x)

    acting = [attraction]
    planet = gvi.Stepper(2, [gvi.Effect(lambda x: acting[0](x))])
    planet.start(0, [0.4, 0], [0, 2])
    planet.step(0.1)
    before, acting[0] = planet.q.copy(), replaced
    try:
        planet.step(0.1)
    except Exception as error:
        return type(error).__name__, len(calls), bool((planet.q == before).all()) and planet.t == 0.1
    return "nothing", len(calls), False


def main(picture=None):
    planet = gvi.Stepper(2, [gvi.Effect(attraction, potential)])
    planet.start(0, [0.4, 0], [0, 2])
    track = np.empty((10000, 2))
    for k in range(10000):
        planet.step(0.1)
        track[k] = planet.q
    print(f"{planet.why()}: q = {planet.q[0]:.9f} {planet.q[1]:.9f}")
    print("energy within 1e-13 of -0.5:", abs(planet.energy() + 0.5) < 1e-13)

    def misspelt(x):
        x.f -= x.q/hypot(*x.q)**3                      # noqa: F821

    def assigned(x):
        x.f = -x.q

    name, calls, stays = fails(misspelt)
    print(f"a name that is missing: {name}, after {calls} call; q is as it was: {stays}")
    print(f"x.f = ... in place of x.f -= ...: {fails(assigned)[0]}")

    def weight(x):
        x.f[2] -= 2*9.81

    def wall_and_rod(x):                               # in the plane y = 0, on a rod of 1
        x.g[0] = x.q[1]
        x.jacobian[0, 1] = 1
        x.g[1] = (x.q[0]**2 + x.q[1]**2 + x.q[2]**2 - 1)/2
        x.jacobian[1, :] = x.q

    bob = gvi.Stepper(3, [gvi.Effect(weight), gvi.Effect(wall_and_rod, kind=gvi.CONSTRAINT, rows=2)],
                      mass=gvi.Mass([2, 2, 2]))
    bob.start(0, [0.6, 0, -0.8], [0, 0, 0])
    bob.steps(0.05, 40)
    q, v = bob.q, bob.velocity()                       # m v^2/r is what the rod gives less what gravity takes
    pull = 2*9.81*q[2] - 2*v@v
    print("2 constraint rows of a pendulum as multipliers within 1e-12 of its forces:",
          np.abs(bob.multipliers() - [0, pull]).max() < 1e-12)
    c, b = gvi.plain("gauss", 5, out=(np.empty(5), np.empty(5)))
    print("the rule with 5 points has order 10:", gvi.plain("rule_order", 5, c, b) == 10)
    if picture:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
        plt.plot(track[:, 0], track[:, 1], ".", markersize=1)
        plt.plot(0, 0, "o")
        plt.axis("equal")
        plt.savefig(picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
