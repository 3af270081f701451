"""The mooring chain of Bergdahl et al. (2016), partly on the bed and partly dry: its pretension against an elastic
catenary, and the measured forces while its upper end goes in circles."""
import math

import numpy as np

from support import HELD, Verification, read_reference

LENGTH, MASS, STIFFNESS, GRAVITY = 33, 0.0818, 1e4, 9.81
TOP, SURFACE, BAR = (32.554, 3.3), 3.0, 2.2e-3
AREA = MASS / 7800
DRY = MASS * GRAVITY
WET = DRY - 1000 * AREA * GRAVITY
BED = 3e9
RAMP, SETTLED, CYCLES, SAMPLES = 3, 5, 7, 250


def arc(H, V, weight, length):
    """(dx, dz, vertical force at the end) of an elastic catenary whose vertical force at the start is V."""
    end = V + weight * length
    slack = math.asinh(end / H) - math.asinh(V / H)
    dx = H / weight * slack + H * length / STIFFNESS
    dz = (math.hypot(H, end) - math.hypot(H, V)) / weight + (end**2 - V**2) / (2 * weight * STIFFNESS)
    return dx, dz, end


def root(gaps, x, h=1e-6):
    """The x at which `gaps` is zero, by Newton's method from the given x."""
    x = np.array(x, float)
    for _ in range(30):
        tangent = np.array([(gaps(x + h * unit) - gaps(x - h * unit)) / (2 * h) for unit in np.eye(len(x))]).T
        x -= np.linalg.solve(tangent, gaps(x))
    return x


def pretension():
    """The tension (at the anchor, at the top) of a chain on a frictionless bed, wet below the surface and dry above."""
    def gaps(unknowns):
        H, wet, dry = unknowns
        x1, z1, V = arc(H, 0, WET, wet)
        x2, z2, _ = arc(H, V, DRY, dry)
        lying = (LENGTH - wet - dry) * (1 + H / STIFFNESS)
        return np.array([lying + x1 + x2 - TOP[0], z1 - SURFACE, z2 - TOP[1] + SURFACE])

    H, wet, dry = root(gaps, (20, 13, 1))
    return H, math.hypot(H, WET * wet + DRY * dry)


def circle(radius, period):
    """The motion of the top in a circle whose radius grows smoothly over the first cycles."""
    ramp = RAMP * period
    s = f"(t/{ramp})"
    share = f"(1 - step({ramp} - t)*(1 - {s}^3*(10 - 15*{s} + 6*{s}^2)))"
    return {"expression": {"x": f"{radius}*sin(2*pi*t/{period})*{share}", "y": "0",
                           "z": f"{radius}*cos(2*pi*t/{period})*{share}"}}


def chain(elements, stiffness=BED, motion="fixed", shape="catenary"):
    damping = 2 * math.sqrt(stiffness * MASS / BAR)
    return {
        "environment": {"gravity": GRAVITY, "fluid": {"density": 1000, "surface": SURFACE},
                        "seabed": {"level": 0, "stiffness": stiffness, "damping": damping, "friction": 0.3,
                                   "friction_velocity": 0.01}},
        "cable_types": {"chain": {"area": AREA, "diameter": BAR, "mass_per_length": MASS, "axial_stiffness": STIFFNESS,
                                  "normal_drag": 2.5, "tangential_drag": 0.5, "added_mass": 3.8,
                                  "tension_only": True}},
        "points": {"anchor": HELD, "top": {"position": [TOP[0], 0, TOP[1]], "motion": motion}},
        "cables": {"chain": {"type": "chain", "from": "anchor", "to": "top", "length": LENGTH, "elements": elements,
                             "shape": shape}},
        "output": {"history": ["chain"]},
    }


def check_pretension(verification):
    """The pretension is right however hard the bed is and wherever the chain is drawn."""
    anchor, top = pretension()
    for elements, stiffness, shape, limit in ((66, 3e5, "straight", 1e-3), (66, BED, "straight", 1e-3),
                                              (330, BED, "catenary", 1e-4)):
        run = verification.run(chain(elements, stiffness, shape=shape))
        name = f"{elements} elements, {shape}, bed of {stiffness:.0e} Pa/m"
        verification.close(f"pretension at the top, {name}", run["chain.tension_to"][0], top, limit * top)
        verification.close(f"pretension at the anchor, {name}", run["chain.tension_from"][0], anchor, limit * anchor)
        verification.check(f"iterations to equilibrium, {name}", run.counted("  iterations"), 60)


def largest_force(verification, radius, period, step, **keys):
    """The largest force at the top in a cycle, averaged over the cycles after the start."""
    scene = chain(66, motion=circle(radius, period))
    scene.update({"initial": "static", "time": {"end": CYCLES * period, "step": step, **keys}})
    scene["output"]["interval"] = period / SAMPLES
    run = verification.run(scene)
    name = f"r = {radius} m, T = {period} s, steps of {step} s"
    verification.check(f"rejected steps, {name}", run.counted("rejected_steps"), 0.01 * run.counted("steps"))
    cycles = run["chain.tension_to"][SETTLED * SAMPLES:CYCLES * SAMPLES].reshape(-1, SAMPLES)
    return cycles.max(axis=1).mean()


def check_forces(verification):
    measured = read_reference("bergdahl_maxima.csv")
    for radius, period in ((0.2, 1.25), (0.125, 2.0), (0.2, 3.5)):
        expected = measured[str(radius)][measured["period"] == period][0]
        found = largest_force(verification, radius, period, 5e-3)
        verification.close(f"largest force, r = {radius} m, T = {period} s", found, expected, 0.05 * expected)
    check_quarter_step(verification)


def check_quarter_step(verification):
    """At 5 ms axial waves ring on after the chain snaps taut.  By default they are in the peaks, with a radius not."""
    for keys, limit in (({}, 0.03), ({"spectral_radius": 0.5}, 5e-3)):
        found, finer = (largest_force(verification, 0.2, 1.25, step, **keys) for step in (5e-3, 1.25e-3))
        verification.close(f"largest force with a quarter of the step, {keys or 'default'}", found, finer, limit * finer)


def main():
    verification = Verification(__doc__)
    check_pretension(verification)
    check_forces(verification)
    verification.finish()


if __name__ == "__main__":
    main()
