"""With growing stiffness, stiff links between cables and a body approach the kinematic coupling."""
import numpy as np

from attitude import Turning, angle_between
from statics_support import hung_by_soft_links
from support import Verification, energy_drift, orders, scene

ROPE = {"mass_per_length": 0.02, "axial_stiffness": 1000.0, "axial_damping": 3.0}
POINTS = {"left": {"position": [-0.6, 0.1, 1.2], "motion": "fixed"},
          "right": {"position": [0.7, -0.1, 1.1], "motion": "fixed"}}
BODY = {"mass": 2.0, "inertia": [0.02, 0.03, 0.025, 0.002, -0.001, 0.003], "position": [0, 0, 0],
        "velocity": [0.2, 0.5, 0], "angular_velocity": [0.5, -0.5, 1.0], "orientation": {"roll": 20},
        "attachments": {"a": [-0.15, 0.05, 0.1], "b": [0.2, -0.05, 0.08]}}
# The cables are shorter than the distance between their ends, so that they stay taut.
CABLES = {"one": {"from": "left", "to": "body.a", "length": 1.16, "elements": 3},
          "two": {"from": "body.b", "to": "right", "length": 1.1, "elements": 3}}
SCHEMES = {"generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}, "energy_momentum": {"scheme": "energy_momentum"}}
END, STEP = 0.4, 2.5e-4
CONVERGING = {"quaternion": (1e2, 1e3, 1e4), "euler": (1e3, 1e4)}   # stiffnesses of the link over the rope's EA
STIFF = (1e8, 1e10)


def swing(v, rotation, time_keys, times_stiffer=None, step=STEP, end=END, rope=ROPE):
    """@return the run, or None if it did not come to its end"""
    body = {**BODY, "rotation": rotation}
    if times_stiffer:
        body["coupling"] = {"rigid_link": {"axial_stiffness": times_stiffer * rope["axial_stiffness"]}}
    case = scene(rope, POINTS, CABLES, end, step, 0.02, ["body", "one", "two"], 9.81, energy=True, **time_keys)
    run, done = v.attempt({**case, "bodies": {"body": body}})
    if done.returncode:
        v.close(f"{rotation}, {time_keys}, link of {times_stiffer} EA: exit status", done.returncode, 0, 0)
        print(done.stderr)
        return None
    v.rejected += run.counted("rejected_steps")
    return run


def differences(kinematic, linked):
    """The differences of the body's position [m] and attitude [rad] at the end; infinite if a run ended early."""
    if kinematic is None or linked is None:
        return np.inf, np.inf
    position = np.linalg.norm(linked.vectors("body")[-1] - kinematic.vectors("body")[-1])
    return position, angle_between(Turning(kinematic, "body").q, Turning(linked, "body").q)[-1]


def check_convergence(v, name, rotation):
    """The difference is of first order in 1/stiffness, until only that between two second-order methods is left."""
    kinematic = swing(v, rotation, SCHEMES[name])
    factors = CONVERGING[rotation] + STIFF
    found = [differences(kinematic, swing(v, rotation, SCHEMES[name], factor)) for factor in factors]
    for quantity, off in zip(("position [m]", "attitude [rad]"), zip(*found)):
        what = f"{name}, {rotation}: {quantity}"
        print(f"        {what}: differences {np.array(off)} with {factors} EA")
        for factor, order in zip(factors[1:], orders(off[:-len(STIFF)], 10)):
            v.close(f"{what}: order in 1/stiffness to {factor:g} EA", order, 1, 0.1)
        for factor, value in zip(STIFF, off[-len(STIFF):]):
            v.check(f"{what}: difference with {factor:g} EA", value, 1e-5)


def check_remainder(v, name, rotation):
    """The difference that is left between a very stiff link and none falls with the square of the time step."""
    off = [differences(swing(v, rotation, SCHEMES[name], None, step), swing(v, rotation, SCHEMES[name], 1e8, step))
           for step in (1e-3, 5e-4)]
    for quantity, values in zip(("position [m]", "attitude [rad]"), zip(*off)):
        what = f"{name}, {rotation}: {quantity} with 1e8 EA"
        v.close(f"{what}: order in the time step", orders(values)[0], 2, 0.2)
        v.check(f"{what}: difference at step 1e-3 s", values[0], 5e-5)


def check_energy(v):
    """Ropes and links are undamped, and a longer run keeps its energy however stiff the link is."""
    rope = {**ROPE, "axial_damping": 0}
    for rotation in CONVERGING:
        for factor in (None, *STIFF):
            run = swing(v, rotation, SCHEMES["energy_momentum"], factor, 1e-3, 2, rope)
            drift = energy_drift(run) if run else np.inf
            link = f"link of {factor:g} EA" if factor else "kinematic"
            v.check(f"energy_momentum, {rotation}, {link}: drift of the energy in 2 s", drift, 1e-5)


def main():
    verification = Verification(__doc__)
    hung_by_soft_links(verification, "rigid_link")
    for name in SCHEMES:
        for rotation in CONVERGING:
            check_convergence(verification, name, rotation)
        check_remainder(verification, name, "quaternion")
    check_energy(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
