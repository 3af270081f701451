"""The papers' bar between a cable's end and a body's centre of gravity, on their own pendulum and beside the other couplings."""
import numpy as np

from attitude import Turning
from body_pendulum import ANGLE, ARM, CUBE, LENGTH, ROD
from statics_support import hung_by_soft_links
from support import HELD, Verification, orders, read_reference, rows_at, scene

GRAVITY, MASS, INERTIA = 9.81, CUBE["mass"], CUBE["inertia"][1]
ROD_MASS = ROD["density"] * ROD["area"] * LENGTH
RIGID = 1e9   # N; the rod has 1.04e7 N
SOFT = (10, 100, 1000)
VARIANTS = {"no scheme named": ({}, {}), "euler": ({"rotation": "euler"}, {}),
            "generalized_alpha 0.8": ({}, {"spectral_radius": 0.8, "scheme": "generalized_alpha"})}


def rates(y):
    """Of the angles of a rigid rod, a rigid bar without mass and the body, from the downward vertical, and their rates.

    The bar carries the body as a point mass.  Its tension T turns the body by |r| T sin(bar - body).
    """
    rod, bar, body, w_rod, w_bar, w_body = y
    s, c = np.sin(rod - bar), np.cos(rod - bar)
    # Rows of M w' = F.
    m11, m12 = (ROD_MASS / 3 + MASS) * LENGTH**2, MASS * LENGTH * ARM * c
    m22 = MASS * ARM**2
    f1 = -MASS * LENGTH * ARM * s * w_bar**2 - (ROD_MASS / 2 + MASS) * GRAVITY * LENGTH * np.sin(rod)
    f2 = MASS * LENGTH * ARM * s * w_rod**2 - MASS * GRAVITY * ARM * np.sin(bar)
    det = m11 * m22 - m12**2
    a_rod, a_bar = (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det
    tension = MASS * (GRAVITY * np.cos(bar) + LENGTH * (w_rod**2 * c + a_rod * s) + ARM * w_bar**2)
    a_body = ARM * tension * np.sin(bar - body) / INERTIA
    return np.array([w_rod, w_bar, w_body, a_rod, a_bar, a_body])


def exact(end, interval, step=2e-4):
    """Times, the angle of the line from the pin to the centre of gravity, and that of the body; by Runge and Kutta."""
    y, rows, each = np.array([ANGLE] * 3 + [0.0] * 3), [], round(interval / step)
    for i in range(round(end / step) + 1):
        if i % each == 0:
            rows.append([i * step, *y[:3]])
        k1 = rates(y)
        k2 = rates(y + step / 2 * k1)
        k3 = rates(y + step / 2 * k2)
        k4 = rates(y + step * k3)
        y = y + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    times, rod, bar, body = np.array(rows).T
    x, z = LENGTH * np.sin(rod) + ARM * np.sin(bar), LENGTH * np.cos(rod) + ARM * np.cos(bar)
    return times, np.arctan2(x, z), body


def swing(v, coupling, step, end=10, body_keys={}, time_keys={}, options=()):
    cable = {"from": "pin", "to": "cube.top", "length": LENGTH, "elements": 1}
    case = scene(ROD, {"pin": HELD}, cable, end, step, 0.05, ["cube"], GRAVITY, energy=True, **time_keys)
    return v.run({**case, "bodies": {"cube": {**CUBE, "coupling": coupling, **body_keys}}}, *options)


def bar(stiffness):
    return {"bar": {"axial_stiffness": stiffness}}


def link(stiffness):
    return {"rigid_link": {"axial_stiffness": stiffness}}


def angles(run):
    """Of the line from the pin to the centre of gravity, and of the body."""
    q = Turning(run, "cube").q
    return np.arctan2(run["cube.x"], -run["cube.z"]), -2 * np.arctan2(q[:, 2], q[:, 0])


def off(run, reference):
    """The largest differences of both angles from reference = times, phi_cg, phi_body."""
    rows = rows_at(run["time"], reference[0])
    return [np.abs(found[rows] - wanted).max() for found, wanted in zip(angles(run), reference[1:])]


def until(end, reference):
    return [column[reference[0] < end + 1e-9] for column in reference]


def check_pendulum(v, reference):
    for name, keys in VARIANTS.items():
        errors = [off(swing(v, bar(RIGID), step, 3, *keys), until(3, reference)) for step in (1e-3, 5e-4)]
        for quantity, found in zip(("phi_cg", "phi_body"), zip(*errors)):
            print(f"        {name}: {quantity} errors {found}, orders {orders(found)}")
            v.at_least(f"bar, {name}: order of {quantity} in the time step", orders(found)[0], 1.9)
        for quantity, found, limit in zip(("phi_cg", "phi_body"), off(swing(v, bar(RIGID), 1e-3, 10, *keys), reference),
                                          (5e-6, 1e-4)):
            v.check(f"bar, {name}, step 1e-3 s: {quantity} in 10 s [rad]", found, limit)


def check_published(v, reference):
    """A hinge at the body's top is another mechanism, whose exact motion is published.  No stiffness takes one to the other."""
    table = read_reference("body_pendulum_N1.csv")
    hinge = [table[key] for key in ("t", "phi_cg", "phi_body")]
    rows = rows_at(hinge[0], reference[0])
    apart = [np.abs(one - other[rows]).max() for one, other in zip(reference[1:], hinge[1:])]
    print(f"        the exact motions of bar and hinge are apart by {apart[0]:.4g} rad (phi_cg) and {apart[1]:.4g} rad (phi_body)")
    run = swing(v, bar(RIGID), 1e-3)
    for quantity, found, expected in zip(("phi_cg", "phi_body"), off(run, hinge), apart):
        v.close(f"bar: {quantity} off the hinge's motion in 10 s [rad]", found, expected, 0.02 * expected)
    for name, coupling in (("kinematic", "kinematic"), ("rigid_link", link(RIGID))):
        for quantity, found, limit in zip(("phi_cg", "phi_body"), off(swing(v, coupling, 1e-3), hinge), (5e-6, 5e-5)):
            v.check(f"{name}: {quantity} off the hinge's motion in 10 s [rad]", found, limit)


def check_stiffness(v, reference):
    """A link goes to the hinge, a bar to the rigid bar, both with 1/EA."""
    table, step, end = read_reference("body_pendulum_N1.csv"), 2.5e-4, 2
    hinge, rigid = until(end, [table[key] for key in ("t", "phi_cg", "phi_body")]), until(end, reference)
    kinematic = off(swing(v, "kinematic", step, end), hinge)
    print(f"        kinematic: off the hinge's motion in {end} s by {kinematic} rad")
    for name, coupling, limit in (("rigid_link", link, hinge), ("bar", bar, rigid)):
        found = [off(swing(v, coupling(EA), step, end), limit) for EA in (*SOFT, RIGID)]
        for quantity, values in zip(("phi_cg", "phi_body"), zip(*found)):
            print(f"        {name}: {quantity} off its limit by {values} rad with {(*SOFT, RIGID)} N")
            v.close(f"{name}: order of {quantity} in 1/EA", orders(values[1:3], 10)[0], 1, 0.15)
            v.check(f"{name}: {quantity} off its limit with {RIGID:g} N [rad]", values[-1], 1e-6)


def check_energy(v):
    """Positions keep their energy, as the bar's tension has a potential.  What the moment r x F does is not in it."""
    body = {**CUBE, "inertia": [1.698e-5, 2e-5, 1e-5], "velocity": [0.1, 0.3, 0], "angular_velocity": [1, -2, 3]}
    for EA in (1e3, RIGID):
        run = swing(v, bar(EA), 1e-3, 2, body, options=("-cable_axial_dissipation", 0))
        turning = Turning(run, "cube").energy(np.diag(body["inertia"]))
        total, largest = run["energy.total"], run["energy.kinetic"].max()
        v.check(f"bar of {EA:g} N: change of the energy without turning over the kinetic one",
                np.ptp(total - turning) / largest, 1e-9)
        v.at_least(f"bar of {EA:g} N: change of energy.total over the kinetic one",
                   np.abs(total - total[0]).max() / largest, 1e-3)


def check_hanging(v):
    """A soft bar turns the attachment above the centre of gravity."""
    for arm, run in hung_by_soft_links(v, "bar"):
        q = Turning(run, "body").q[0]
        up = arm + 2 * np.cross(q[1:], np.cross(q[1:], arm) + q[0] * np.array(arm))
        lean = np.linalg.norm(up[:2]) / np.linalg.norm(arm)
        v.check(f"hung by a soft bar at {arm}: lean of the attachment [rad]", lean, 1e-7)


def main():
    verification = Verification(__doc__)
    check_hanging(verification)
    reference = exact(10, 0.05)
    check_pendulum(verification, reference)
    check_published(verification, reference)
    check_stiffness(verification, reference)
    check_energy(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
