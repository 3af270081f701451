"""Points that follow a law: their motion as it is written, the work that they do, and the order of the scheme for a
ball that hangs on them."""
import numpy as np

from support import Verification, energy_drift, orders, rows_at, scene

ENERGY_MOMENTUM = {"scheme": "energy_momentum"}
TABLE = [[0, 0, 0, 0], [0.4, 0.1, 0.05, 0], [1.0, 0.0, 0.1, 0.2], [1.5, -0.1, 0, 0.1], [2.0, 0, 0, 0]]
MOTIONS = {
    "velocity": {"velocity": [0.5, 0.2, 0.1]},
    "harmonic": {"harmonic": {"amplitude": [0.1, 0, 0.05], "period": 0.8, "phase": 30}},
    "waypoints": {"waypoints": TABLE},
    "expression": {"expression": {"x": "0.1*sin(5*t)*t", "y": "0.05*t^2", "z": "0.1*(1-cos(3*t))"}},
}


def natural_spline(table, t):
    """Position, velocity, acceleration (rows, 3) of the C2 cubic spline without curvature at its ends."""
    table = np.array(table, dtype=float)
    knots, values = table[:, 0], table[:, 1:]
    h, n = np.diff(knots), len(knots)
    matrix, right = np.eye(n), np.zeros((n, 3))
    for i in range(1, n - 1):
        matrix[i, i - 1:i + 2] = h[i - 1], 2 * (h[i - 1] + h[i]), h[i]
        right[i] = 6 * ((values[i + 1] - values[i]) / h[i] - (values[i] - values[i - 1]) / h[i - 1])
    curve = np.linalg.solve(matrix, right)
    i = np.clip(np.searchsorted(knots, t, side="right") - 1, 0, n - 2)
    h, c0, c1 = h[i, None], curve[i], curve[i + 1]
    s = t[:, None] - knots[i, None]
    slope = (values[i + 1] - values[i]) / h - h * (2 * c0 + c1) / 6
    jump = (c1 - c0) / h
    return (values[i] + slope * s + c0 * s**2 / 2 + jump * s**3 / 6, slope + c0 * s + jump * s**2 / 2, c0 + jump * s)


def law(kind, t):
    """Displacement, velocity, acceleration (rows, 3) of MOTIONS[kind], by formulas of its own."""
    zero = 0 * t
    if kind == "velocity":
        v = np.tile([0.5, 0.2, 0.1], (len(t), 1))
        return v * t[:, None], v, 0 * v
    if kind == "harmonic":
        amplitude, omega, phase = np.array([0.1, 0, 0.05]), 2 * np.pi / 0.8, np.pi / 6
        s, c = np.sin(omega * t + phase)[:, None], np.cos(omega * t + phase)[:, None]
        return amplitude * s, amplitude * omega * c, -amplitude * omega**2 * s
    if kind == "waypoints":
        return natural_spline(TABLE, t)
    s, c = np.sin(5 * t), np.cos(5 * t)
    return (np.column_stack([0.1 * s * t, 0.05 * t**2, 0.1 * (1 - np.cos(3 * t))]),
            np.column_stack([0.1 * (5 * c * t + s), 0.1 * t, 0.3 * np.sin(3 * t)]),
            np.column_stack([0.1 * (10 * c - 25 * s * t), zero + 0.1, 0.9 * np.cos(3 * t)]))


def hang(v, motion, step, keys, force=(0, 0, 0)):
    rope = {"mass_per_length": 0.2, "axial_stiffness": 5e3}
    points = {"top": {"position": [0, 0, 0], "motion": motion},
              "ball": {"position": [0.8, 0, -0.6], "mass": 0.4, "force": list(force)}}
    cable = {"from": "top", "to": "ball", "elements": 6}
    return v.run(scene(rope, points, cable, 2.0, step, 0.01, ["top", "ball"], energy=True, **keys))


def check_laws(v):
    for kind, motion in MOTIONS.items():
        for name, keys in (("energy_momentum", ENERGY_MOMENTUM), ("generalized_alpha 0.5", {"scheme": "generalized_alpha", "spectral_radius": 0.5})):
            run = hang(v, motion, 2e-3, keys)
            for what, found, exact in zip(("position [m]", "velocity [m/s]", "acceleration [m/s2]"),
                                          (run.vectors("top", letter) for letter in ("", "v", "a")),
                                          law(kind, run["time"])):
                v.check(f"{kind}, {name}: {what} off the law", np.abs(found - exact).max(), 1e-12)


def check_energy(v):
    """The energy balance of energy_momentum is exact where a point is at rest or moves evenly.  On a curved path the
    error of the work is of second order."""
    for kind, motion, force in (("fixed with a constant force", "fixed", (3, 1, 2)),
                                ("velocity", MOTIONS["velocity"], (0, 0, 0))):
        run = hang(v, motion, 1e-3, ENERGY_MOMENTUM, force)
        v.check(f"{kind}: drift of the energy", energy_drift(run), 1e-10)
        v.at_least(f"{kind}: work done over the largest kinetic energy",
                   np.ptp(run["energy.work"]) / run["energy.kinetic"].max(), 0.3)
    for kind, limit in {"harmonic": 1e-8, "waypoints": 2e-9, "expression": 2e-9}.items():
        drifts = [energy_drift(hang(v, MOTIONS[kind], step, ENERGY_MOMENTUM)) for step in (2e-3, 5e-4)]
        print(f"        {kind}: drifts of the energy {drifts} with steps 2e-3 and 5e-4 s")
        v.check(f"{kind}: drift of the energy with the step 5e-4 s", drifts[-1], limit)
        v.at_least(f"{kind}: order of that drift in the time step", orders(drifts, 4)[0], 1.8)


SHAKEN = {"expression": {"x": "0.2*sin(5*t)", "z": "0.1*(1-cos(7*t))"}}
SOFT, TIP, SHAKEN_GRAVITY = {"mass_per_length": 0.5, "axial_stiffness": 500}, 0.1, 9.81


def shaken_reference(times, step):
    """Positions of the ball by the classical Runge-Kutta method, with two elements.
    @param times  multiples of `step`"""
    half = 0.5   # the unstretched length of an element
    m = SOFT["mass_per_length"] * half
    mass = np.array([[4 * m / 6, m / 6], [m / 6, 2 * m / 6 + TIP]])
    inverse, weight = np.linalg.inv(mass), SHAKEN_GRAVITY * np.array([[0, 0, m], [0, 0, m / 2 + TIP]])
    coupling = np.array([[m / 6], [0]])

    def top(t):
        return np.array([0.2 * np.sin(5 * t), 0, 0.1 * (1 - np.cos(7 * t))])

    def top_acceleration(t):
        return np.array([-5 * np.sin(5 * t), 0, 4.9 * np.cos(7 * t)])

    def pull(d):
        length = np.sqrt(d @ d)
        return SOFT["axial_stiffness"] * (1 / half - 1 / length) * d

    def rate(t, y):
        upper, lower = pull(y[0] - top(t)), pull(y[1] - y[0])
        force = np.array([lower - upper, -lower]) - weight - coupling * top_acceleration(t)
        return np.concatenate([y[2:], inverse @ force])

    y = np.array([[0.4, 0, -0.3], [0.8, 0, -0.6], [0.5, 0, 0], [0, 0, 0]])   # the rope's velocity is linear
    t, found = 0.0, {0: y[1]}
    for i in range(round(times[-1] / step)):
        t = i * step
        k1 = rate(t, y)
        k2 = rate(t + step / 2, y + step / 2 * k1)
        k3 = rate(t + step / 2, y + step / 2 * k2)
        k4 = rate(t + step, y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        found[i + 1] = y[1]
    return np.array([found[round(time / step)] for time in times])


def check_order(v):
    """A ball hangs on a heavy soft rope below a shaken point."""
    points = {"top": {"position": [0, 0, 0], "motion": SHAKEN}, "ball": {"position": [0.8, 0, -0.6], "mass": TIP}}
    cable = {"from": "top", "to": "ball", "elements": 2}
    times = 0.02 * np.arange(51)
    exact = shaken_reference(times, 2e-4)
    print(f"        own error of the reference: {np.abs(exact - shaken_reference(times, 4e-4)).max() / 15:.1e} m")
    steps = (1e-3, 5e-4, 2.5e-4)
    schemes = {"energy_momentum": (ENERGY_MOMENTUM, 2.5e-4), "generalized_alpha 1": ({"scheme": "generalized_alpha", "spectral_radius": 1}, 2.5e-4),
               "generalized_alpha 0.8": ({"scheme": "generalized_alpha", "spectral_radius": 0.8}, 3e-4),
               "generalized_alpha 0.3": ({"scheme": "generalized_alpha", "spectral_radius": 0.3}, 6e-4),
               "plain 0.3": ({"scheme": "plain", "spectral_radius": 0.3}, 6e-4)}
    for name, (keys, limit) in schemes.items():
        runs = [v.run(scene(SOFT, points, cable, 1.0, step, 0.02, ["ball"], SHAKEN_GRAVITY, energy=True, **keys))
                for step in steps]
        errors = [np.abs(run.vectors("ball")[rows_at(run["time"], times)] - exact).max() for run in runs]
        drifts = [energy_drift(run) for run in runs]
        print(f"        shaken, {name}: errors {errors} m, orders {orders(errors)}; drifts of the energy {drifts}, "
              f"orders {orders(drifts)}")
        v.check(f"shaken, {name}: error with the step 1e-3 s [m]", errors[0], limit)
        v.at_least(f"shaken, {name}: order in the time step", orders(errors)[-1], 1.9)
        v.at_least(f"shaken, {name}: order of the energy balance", orders(drifts)[-1], 1.9)


def main():
    verification = Verification(__doc__)
    check_laws(verification)
    check_energy(verification)
    check_order(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
