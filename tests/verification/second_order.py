"""The default scheme and every radius: resolved motion is kept, energy never comes from nowhere, Newton's method arrives.

Closed forms: a load that bounces on a rope, a load that falls into a slack rope, a stiff rod that turns without gravity.
"""
import math

import numpy as np

from support import HELD, Verification, scene

LIGHT = {"mass_per_length": 1e-6, "axial_stiffness": 20000}
ROD = {"mass_per_length": 6.57, "axial_stiffness": 1e10}
STEEL = {"area": 1.962e-5, "density": 7800, "youngs_modulus": 53e9}
RADII = ({}, {"spectral_radius": 0.9}, {"scheme": "energy_momentum", "spectral_radius": 0.5}, {"spectral_radius": 0})


def moved(run):
    """The largest kinetic energy [J]."""
    return run["energy.kinetic"].max()


def gained(run):
    """The largest total energy above that at the start, over what moves."""
    return (run["energy.total"] - run["energy.total"][0]).max() / moved(run)


LOAD = 100.0
RATE = math.sqrt(LIGHT["axial_stiffness"] / 20 / LOAD)   # of the bounce [rad/s]
PERIOD = 2 * math.pi / RATE


def bounce(verification, step, cycles, speed=0.0, **keys):
    """A load on 20 m of rope, released where the rope has no tension: z = -20 - g/w^2 (1 - cos w t); or thrown up from
    where it hangs, at this speed.
    @return the run, its error and the amplitude [m]"""
    sag = 9.81 / RATE**2
    points = {"top": HELD, "load": {"position": [0, 0, -20 - sag * (speed > 0)], "mass": LOAD, "velocity": [0, 0, speed]}}
    cable = {"from": "top", "to": "load", "elements": 2, "length": 20}
    run = verification.run(scene(LIGHT, points, cable, cycles * PERIOD, step, 0, ["load"], energy=True, **keys))
    phase = RATE * run["time"]
    exact = -20 - sag + (speed / RATE * np.sin(phase) if speed > 0 else sag * np.cos(phase))
    return run, run["load.z"] - exact, speed / RATE or sag


def amplitude(run, since):
    """Of the harmonic motion that is nearest to the load's, at whatever rate.  [m]"""
    late = run["time"] > since
    t, z = run["time"][late], run["load.z"][late]

    def fit(rate):
        columns = np.stack([np.cos(rate * t), np.sin(rate * t), np.ones_like(t)], axis=1)
        found, residual, *_ = np.linalg.lstsq(columns, z, rcond=None)
        return residual[0], math.hypot(*found[:2])

    return min(fit(rate) for rate in RATE * np.linspace(0.98, 1, 81))[1]


def check_resolved_motion(verification):
    for speed in (0.0, 3.0):
        for steps, least in ((50, 0.998), (20, 0.97)):
            run, _, started = bounce(verification, PERIOD / steps, 20, speed)
            kept = amplitude(run, 19 * PERIOD) / started
            name = f"default, {steps} steps a period, {'thrown' if speed else 'released'}"
            verification.at_least(f"{name}: amplitude kept over 20 periods", kept, least)
            verification.check(f"{name}: energy gained", gained(run), 1e-12)


def order(errors):
    """Of errors at steps that are halved."""
    return np.log2(np.array(errors[:-1]) / np.array(errors[1:])).min()


def check_bounce_order(verification):
    for keys in RADII:
        errors = [np.abs(bounce(verification, PERIOD / n, 3, **keys)[1]).max() for n in (40, 80, 160, 320)]
        verification.at_least(f"bounce, {keys or 'default'}: order", order(errors), 1.9)


def snap_error(verification, step):
    """A mass falls 0.8 m beside a slack rope of 1 m, is caught, bounces and flies.  The error of its place at 0.9 s,
    when it flies again."""
    mass, stiffness, drop, end = 0.5, 2000.0, 0.8, 0.9
    rope = {"mass_per_length": 1e-9, "axial_stiffness": stiffness, "tension_only": True}
    points = {"pin": HELD, "mass": {"position": [0, 0, drop - 1], "mass": mass}}
    run = verification.run(scene(rope, points, {"from": "pin", "to": "mass", "elements": 1, "length": 1}, end, step, end,
                                 ["mass"]))
    g, w = 9.81, math.sqrt(stiffness / mass)
    speed, fall = math.sqrt(2 * g * drop), math.sqrt(2 * drop / g)
    half = (2 * math.pi - 2 * math.atan2(speed, g / w)) / w   # -l = g/w^2 (1 - cos) + speed/w sin comes back to 0
    flight = end - fall - half
    return abs(run["mass.z"][-1] - (-1 + speed * flight - g / 2 * flight**2))


def check_snap(verification):
    errors = [np.mean([snap_error(verification, 0.9 / n) for n in range(base, base + base // 8, base // 128)])
              for base in (512, 2048)]
    verification.at_least("a mass caught by a slack rope: order, of the mean over steps that meet the rope differently",
                          order(errors) / 2, 1.9)


def turn(verification, stiffness, step, end, **keys):
    rod = {**ROD, "axial_stiffness": stiffness}
    points = {"pin": HELD, "bob": {"position": [0, 0, -3.0443], "velocity": [7.72, 0, 0]}}
    cable = {"from": "pin", "to": "bob", "elements": 1, "length": 3.0443}
    return verification.run(scene(rod, points, cable, end, step, 0, ["bob", "cable"], 0, energy=True, **keys))


def check_stiff_pendulum(verification):
    period = 2 * math.pi * 3.0443 / 7.72
    for stiffness in (1e7, 1e10):
        for part in (0.1, 0.02):
            run = turn(verification, stiffness, part * period, 100 * period)
            name = f"stiff pendulum, EA {stiffness:g} N, {part} of a period, 100 periods"
            total = run["energy.total"]
            # At rest in the rotating frame the rod stores this part of its energy.
            steady = 6.57 * 7.72**2 / 3 / stiffness
            verification.check(f"{name}: energy lost", 1 - total[-1] / total[0], 1e-3)
            verification.check(f"{name}: energy gained", gained(run), 2e-3)
            verification.check(f"{name}: strain energy", run["energy.strain"].max() / total[0], 1e-3 + 4 * steady)
            verification.check(f"{name}: rejected steps", run.counted("rejected_steps"), 0)
    run = turn(verification, 1e10, 0.05, 20)
    late, force = run["time"] > 10, 6.57 * 7.72**2 / 3
    error = np.abs(run["cable.tension_to"][late])
    verification.check("stiff pendulum at 0.05 s: tension at the free end [N]", error.max(), 1e-3 * force)
    tension = 1e10 * (np.linalg.norm(run.vectors("bob"), axis=1) / 3.0443 - 1)
    verification.check("stiff pendulum at 0.05 s: tension off by", np.abs(tension[late] / force - 1).max(), 1e-3)


def whip(verification, elements, step, end, kind=None, **keys):
    points = {"pin": HELD, "free": {"position": [1.713, 0, 0]}}
    cable = {"from": "pin", "to": "free", "elements": elements, "length": 1.713}
    return verification.run(scene({**STEEL, **(kind or {})}, points, cable, end, step, 0, ["free"], energy=True, **keys))


def check_no_energy_from_nowhere(verification):
    slack = {"tension_only": True}
    for keys in (*RADII, {"scheme": "energy_momentum"}):
        for elements, step, kind in ((24, 0.002, {}), (24, 0.02, {}), (24, 0.01, slack), (96, 0.002, {})):
            run = whip(verification, elements, step, 1.2, kind, **keys)
            name = f"whip of {elements} elements, {step} s, {keys or 'default'}{', tension_only' if kind else ''}"
            verification.check(f"{name}: energy gained", gained(run), 1e-6)
            verification.check(f"{name}: rejected steps", run.counted("rejected_steps"), 2)


def fallen(verification, step):
    """Where the free end is every 0.04 s until 0.48 s."""
    run = whip(verification, 24, step, 0.48)
    rows = [np.argmin(np.abs(run["time"] - 0.04 * k)) for k in range(1, 13)]
    return run.vectors("free")[rows]


def check_fall_order(verification):
    """At steps that resolve the motion and not the axial waves: below 2 ms these rule the error of any scheme."""
    exact = fallen(verification, 0.00025)
    errors = [np.sqrt(((fallen(verification, step) - exact)**2).sum(axis=1).mean()) for step in (8e-3, 2e-3)]
    verification.at_least("free fall of 24 elements to 0.48 s, from 8 to 2 ms: order", order(errors) / 2, 1.9)


def net(verification):
    """A net of 24 x 24 meshes of twine that also pushes, held along its top edge and let go."""
    return verification.run({
        "cable_types": {"twine": {"diameter": 2e-3, "density": 1140, "youngs_modulus": 1e8}},
        "nets": {"panel": {"type": "twine", "corners": [[0, 0, 0], [5, 0, 0], [5, 5, 0], [0, 4, -3]], "meshes": [24, 24],
                           "fixed": ["top"]}},
        "points": {"corner": {"position": [-1, 0, 0], "motion": "fixed"}},
        "time": {"end": 2.4, "step": 0.02}, "output": {"interval": 2.4, "history": ["corner"]}})


def check_newton(verification):
    """Against the iterations with the exact tangent and the step's plain first guess."""
    for elements, before, part in ((96, 763, 0.40), (192, 1062, 0.30)):
        now = whip(verification, elements, 0.01, 0.5).counted("newton_iterations")
        verification.check(f"fall of {elements} elements at 10 ms: iterations over {before}", now / before, part)
    run = whip(verification, 24, 1e-4, 0.1)
    verification.check("fall of 24 elements at 0.1 ms: iterations a step", run.counted("newton_iterations") / 1000, 1.05)
    verification.check("fall of 24 elements at 0.1 ms: balance over what moves",
                       np.abs(run["energy.balance"]).max() / run["energy.kinetic"].max(), 1e-9)
    now = turn(verification, 1e10, 0.2, 20).counted("newton_iterations")
    verification.check("stiff pendulum at 0.2 s: iterations over 1095", now / 1095, 0.35)
    now = net(verification).counted("newton_iterations")
    verification.check("net whose tangents are kept: iterations over 1403", now / 1403, 0.75)


def check_adaptive(verification):
    for tolerance in (1e-3, 1e-4, 1e-5):
        _, errors, _ = bounce(verification, 0.01, 10, adaptive={"tolerance": tolerance})
        verification.check(f"bounce, tolerance {tolerance:g} m: largest error over 10 times that of 10 periods",
                           np.abs(errors).max() / (10 * tolerance * 10), 1)


def main():
    verification = Verification(__doc__.splitlines()[0])
    for check in (check_resolved_motion, check_bounce_order, check_snap, check_stiff_pendulum, check_no_energy_from_nowhere,
                  check_fall_order, check_newton, check_adaptive):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
