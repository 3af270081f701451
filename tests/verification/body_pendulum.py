"""A body hinged to the end of a rod that swings, against the exact motion of rigid links."""
import numpy as np

from attitude import Turning
from support import HELD, Verification, orders, read_reference, rows_at, scene

ROD = {"area": 1.962e-4, "density": 3.215, "youngs_modulus": 5.3e10}
LENGTH, ARM, ANGLE = 1.713, 0.0503, np.radians(-4)
CENTRE = (LENGTH + ARM) * np.array([np.sin(ANGLE), 0, -np.cos(ANGLE)])
CUBE = {"mass": 0.01, "inertia": [1.698e-5] * 3, "position": CENTRE.tolist(), "orientation": {"pitch": 4},
        "attachments": {"top": [0, 0, ARM]}}
DEFAULT = {"no scheme named": ({}, {})}
VARIANTS = {**DEFAULT, "euler": ({"rotation": "euler"}, {}),
            "generalized_alpha 0.8": ({}, {"scheme": "generalized_alpha", "spectral_radius": 0.8})}


def swing(v, elements, step, body_keys, time_keys, end=10):
    cable = {"from": "pin", "to": "cube.top", "length": LENGTH, "elements": elements}
    case = scene(ROD, {"pin": HELD}, cable, end, step, 0.05, ["cube", "cable"], 9.81, energy=True, **time_keys)
    return v.run({**case, "bodies": {"cube": {**CUBE, **body_keys}}})


def off_reference(run, elements):
    """The differences of phi_cg and phi_body from the reference, row by row."""
    reference, turning = read_reference(f"body_pendulum_N{elements}.csv"), Turning(run, "cube")
    rows = rows_at(reference["t"], run["time"])
    phi_cg = np.arctan2(run["cube.x"], -run["cube.z"])
    phi_body = -2 * np.arctan2(turning.q[:, 2], turning.q[:, 0])
    return np.abs(phi_cg - reference["phi_cg"][rows]), np.abs(phi_body - reference["phi_body"][rows])


def check_plane(v, what, run):
    turning = Turning(run, "cube")
    v.check(f"{what}: motion out of the plane [m]", np.abs(run["cube.y"]).max(), 1e-12)
    v.check(f"{what}: turn out of the plane", np.abs(turning.q[:, [1, 3]]).max(), 1e-10)


def check_accuracy(v, elements, variants, limits, drift):
    for name, keys in variants.items():
        what = f"{elements} element(s), {name}, step 1e-3 s"
        run = swing(v, elements, 1e-3, *keys)
        cg, body = off_reference(run, elements)
        v.check(f"{what}: phi_cg in 10 s [rad]", cg.max(), limits[0])
        v.check(f"{what}: phi_body in 10 s [rad]", body.max(), limits[1])
        total = run["energy.total"]
        v.check(f"{what}: change of energy.total [J]", np.abs(total - total[0]).max(), drift)
        check_plane(v, what, run)


def check_order(v):
    for name, keys in VARIANTS.items():
        errors = [off_reference(swing(v, 1, step, *keys), 1)[0].max() for step in (1e-2, 5e-3, 2.5e-3)]
        print(f"        1 element(s), {name}: phi_cg errors {errors}, orders {orders(errors)}")
        for order in orders(errors):
            v.at_least(f"1 element(s), {name}: order of phi_cg in the time step", order, 1.9)


def main():
    verification = Verification(__doc__)
    check_accuracy(verification, 1, VARIANTS, (5e-6, 5e-5), 1e-8)
    check_accuracy(verification, 10, DEFAULT, (5e-6, 1e-4), 1e-8)
    check_order(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
