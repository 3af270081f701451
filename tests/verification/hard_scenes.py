"""Small scenes that other schemes fail at: a snap, a soft pendulum, a shallow tripod, a stiff one over 1000 steps.

The default is held against energy_momentum at a quarter of the step, and the tripod against an explicit solution.
"""
import math

import numpy as np
from scipy.integrate import solve_ivp

from support import HELD, Verification, scene

CONSERVING = {"scheme": "energy_momentum"}
FEET = [np.array([math.cos(a), math.sin(a), 0]) for a in (0.1 + 2 * math.pi * k / 3 for k in range(3))]
APEX, VELOCITY, MASS = np.array([0, 0, 0.25]), np.array([0.02, 0, -9.0]), 2.0


def snap(step, **keys):
    rope = {"mass_per_length": 1e-12, "axial_stiffness": 200, "tension_only": True}
    points = {"pin": HELD, "mass": {"position": [0, 0, -0.2], "mass": 0.5}}
    return scene(rope, points, {"from": "pin", "to": "mass", "length": 1, "elements": 1}, 5, step, 0.05, ["mass"], **keys)


def soft_pendulum(step, **keys):
    rod = {"area": 1.2e-5, "density": 1100, "youngs_modulus": 5e6}
    points = {"pin": HELD, "mass": {"position": [0, 1.0606601717798214, -1.0606601717798214], "velocity": [3, 0, 0],
                                    "mass": 0.12}}
    return scene(rod, points, {"from": "pin", "to": "mass", "length": 1.5, "elements": 8}, 5, step, 0.05, ["mass"], **keys)


def tripod(step, **keys):
    """A mass shoots through the plane of its three bars' feet."""
    bar = {"mass_per_length": 0.1, "axial_stiffness": 2e4}
    points = {"mass": {"position": APEX.tolist(), "velocity": VELOCITY.tolist(), "mass": MASS}}
    points |= {f"p{k}": {"position": foot.tolist(), "motion": "fixed"} for k, foot in enumerate(FEET)}
    bars = {f"c{k}": {"from": f"p{k}", "to": "mass", "elements": 1} for k in range(3)}
    return scene(bar, points, bars, 2, step, 0.05, ["mass"], **keys)


def apart(one, other):
    """The largest distance of the mass, over the motion."""
    a, b = one.vectors("mass"), other.vectors("mass")
    return np.linalg.norm(a - b, axis=1).max() / np.linalg.norm(b - b[0], axis=1).max()


def check_against_a_quarter(verification):
    for make, step in ((snap, 1e-3), (soft_pendulum, 1e-3), (tripod, 1e-3)):
        default, fine = verification.run(make(step)), verification.run(make(step / 4, **CONSERVING))
        verification.check(f"{make.__name__}, default at {step} s off energy_momentum at a quarter", apart(default, fine),
                           0.01)


def explicit_tripod(times):
    lengths = [np.linalg.norm(APEX - foot) for foot in FEET]
    inertia, weight = MASS + 0.1 * sum(lengths) / 3, (MASS + 0.1 * sum(lengths) / 2) * 9.81

    def rates(_, y):
        force = np.array([0, 0, -weight])
        for foot, length in zip(FEET, lengths):
            chord = y[:3] - foot
            now = np.linalg.norm(chord)
            force -= 2e4 * (now / length - 1) * chord / now
        return np.concatenate([y[3:], force / inertia])

    start = np.concatenate([APEX, VELOCITY])
    return solve_ivp(rates, (0, times[-1]), start, "DOP853", t_eval=times, rtol=1e-12, atol=1e-12).y[:3].T


def check_tripod(verification):
    """As long as neighbouring motions stay together: a later one depends on the step's every digit."""
    for step, limit in ((1e-3, 0.03), (2.5e-4, 0.002)):
        run = verification.run(tripod(step))
        early = run["time"] <= 1
        exact = explicit_tripod(run["time"])[early]
        off = np.linalg.norm(run.vectors("mass")[early] - exact, axis=1).max() / np.ptp(exact[:, 2])
        verification.check(f"tripod at {step} s off the explicit solution to 1 s", off, limit)


def check_long_stiff_pendulum(verification):
    """A rod of EA 1e8 N falls from the horizontal 100 times, at 10 steps of its small swings' period / 0.85."""
    rod = {"mass_per_length": 1e-12, "axial_stiffness": 1e8}
    points = {"pin": HELD, "mass": {"position": [1, 0, 0], "mass": 1}}
    cable = {"from": "pin", "to": "mass", "length": 1, "elements": 1}
    step = 0.23678419475762369
    for interval in (0, step, 10 * step):
        run = verification.run(scene(rod, points, cable, 1000 * step, step, interval, ["mass"], energy=True))
        total, name = run["energy.total"], f"long stiff pendulum, output every {interval:.3g} s"
        verification.check(f"{name}: energy off [J]", np.abs(total - total[0]).max(), 1e-5 * 9.81)
        verification.check(f"{name}: rejected steps", run.counted("rejected_steps"), 0)


def check_radii(verification):
    """A radius below 1 brings no energy in, not even what the first acceleration holds.  generalized_alpha at radius 0
    stood at its rounding until its steps were 4e-15 s."""
    for radius in (0.9, 0.8, 0.5, 0):
        for step in (1e-3, 5e-3, 0.025):
            case = tripod(step, spectral_radius=radius)
            case["output"].update(energy=True, interval=0)
            run = verification.run(case)
            gained = (run["energy.total"] - run["energy.total"][0]).max() / run["energy.kinetic"].max()
            verification.check(f"tripod, radius {radius}, {step} s: energy gained", gained, 1e-9)
    run = verification.run(tripod(1e-3, scheme="generalized_alpha", spectral_radius=0))
    verification.check("tripod, generalized_alpha at radius 0: rejected steps", run.counted("rejected_steps"), 0)


def main():
    verification = Verification(__doc__.splitlines()[0])
    for check in (check_against_a_quarter, check_tripod, check_long_stiff_pendulum, check_radii):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
