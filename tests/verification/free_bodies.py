"""Rigid bodies that nothing holds, against exact solutions and closed forms."""
import numpy as np

from attitude import Turning, about, angle_between, inverse, matrix, product, six, turned
from support import Verification, body_scene, energy_drift, orders, read_reference, rows_at

INERTIA = np.diag([0.01, 0.02, 0.03])
TUMBLING = {"mass": 1.0, "inertia": [0.01, 0.02, 0.03], "position": [0, 0, 0], "angular_velocity": [1e-3, 6, 1e-3]}
SCHEMES = {"no scheme named": {}, "generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}


def tumble(v, end, step, **time_keys):
    run = v.run(body_scene({"top": TUMBLING}, end, step, 0.1, **time_keys))
    return run, Turning(run, "top")


def against_reference(turning):
    """The differences of the quaternions' components from the reference, row by row."""
    reference = read_reference("torque_free_D1.csv")
    rows = rows_at(reference["t"], turning.time)
    exact = np.column_stack([reference[f"q{i}"] for i in range(4)])[rows]
    return np.abs(turning.q - exact).max(axis=1)


def check_tumbling(v):
    run, turning = tumble(v, 10, 1e-3)
    v.check("tumbling, step 1e-3 s: quaternion in 10 s", against_reference(turning).max(), 1e-4)
    energy = turning.energy(INERTIA)
    v.check("tumbling, step 1e-3 s: energy from q and w, relative", np.abs(energy / energy[0] - 1).max(), 1e-9)
    v.check("tumbling, step 1e-3 s: energy.kinetic against that, relative",
            np.abs(run["energy.kinetic"] / energy - 1).max(), 1e-12)
    spin = turning.angular_momentum(INERTIA)
    v.check("tumbling, step 1e-3 s: angular momentum, relative",
            np.abs(spin - spin[0]).max() / np.linalg.norm(spin[0]), 1e-9)
    v.check("tumbling, step 1e-3 s: quaternions off unit length", turning.off_unit(), 1e-12)
    v.check("tumbling, step 1e-3 s: motion of the centre of gravity [m]", np.abs(run.vectors("top")).max(), 1e-12)


def check_order(v):
    for name, end in {"no scheme named": 6, "generalized_alpha 0.8": 4}.items():
        errors = [against_reference(tumble(v, end, step, **SCHEMES[name])[1]).max() for step in (4e-3, 2e-3, 1e-3)]
        print(f"        tumbling, {name}: errors in {end} s {errors}, orders {orders(errors)}")
        for order in orders(errors):
            v.at_least(f"tumbling, {name}: order in the time step", order, 1.9)


def check_turned_axes(v):
    """A body that is described in other body axes moves in the same way."""
    place = product(about([1, 2, -3], 1.1), about([0, 1, 0], 0.7))   # the new axes in the old ones
    inertia = matrix(place).T @ INERTIA @ matrix(place)
    spin = turned(inverse(place), TUMBLING["angular_velocity"])
    other = {**TUMBLING, "inertia": six(inertia), "angular_velocity": spin.tolist(),
             "orientation": {"quaternion": place.tolist()}}
    for name, keys in SCHEMES.items():
        run = v.run(body_scene({"old": TUMBLING, "new": other}, 5, 2e-3, 0.05, **keys))
        old, new = Turning(run, "old"), Turning(run, "new")
        v.check(f"turned body axes, {name}: attitude [rad]",
                angle_between(old.q, product(new.q, inverse(place))).max(), 1e-9)
        v.check(f"turned body axes, {name}: angular velocity [rad/s]",
                np.abs(turned(place, new.w) - old.w).max(), 1e-8)


def check_constant_torque(v):
    """A torque about a principal axis turns a body at rest by t^2/2 torque/inertia.  Its work is kinetic energy."""
    body = {"mass": 2.0, "inertia": [0.01, 0.02, 0.03], "position": [1, 2, 3], "torque": [0, 0.02, 0]}
    for name, keys in SCHEMES.items():
        off = []
        for step in (1e-2, 5e-3) if "spectral_radius" in keys else (1e-2,):
            run = v.run(body_scene({"wheel": body}, 10, step, 0.1, **keys))
            turning, t = Turning(run, "wheel"), run["time"]
            exact = about([0, 1, 0], t**2 / 2)
            off.append([np.abs(turning.w - np.outer(t, [0, 1, 0])).max(), np.abs(turning.q - exact).max(),
                        np.abs(run["energy.work"] - run["energy.kinetic"]).max(),
                        np.abs(run["energy.kinetic"] - 0.01 * t**2).max()])
            v.check(f"constant torque, {name}: turn about other axes", np.abs(turning.q[:, [1, 3]]).max(), 1e-12)
        for what, *values in zip(("angular velocity [rad/s]", "quaternion, its sign too",
                                  "energy.work off the kinetic energy [J]", "kinetic energy off 0.01 t^2 [J]"), *off):
            if len(values) == 1:
                v.check(f"constant torque, {name}: {what}", values[0], 1e-10)
            for order in orders(values):
                v.at_least(f"constant torque, {name}: {what}: order in the time step", order, 1.9)


def check_constant_force(v):
    """Under a constant force bodies move in a parabola: one that turns, one that does not, and a point mass."""
    mass, gravity, force = 2.5, 9.81, np.array([1.0, -2.0, 30.0])
    start, speed = np.array([1.0, -2.0, 0.5]), np.array([0.3, 0.1, -0.2])
    load = {"mass": mass, "position": start.tolist(), "velocity": speed.tolist(), "force": force.tolist()}
    turning = {"inertia": [0.15, 0.2, 0.25, 0.01, 0.02, -0.03], "angular_velocity": [1, 2, 3]}
    bodies = {"bob": load, "still": {**load, "inertia": [0.1, 0.2, 0.3]}, "turning": {**load, **turning},
              "angles": {**load, **turning, "rotation": "euler"}}
    pull = force / mass - [0, 0, gravity]
    for name, keys in SCHEMES.items():
        run = v.run(body_scene(bodies, 1, 5e-3, 0.05, gravity, **keys))
        t = run["time"][:, None]
        for body in bodies:
            what = f"constant force, {name}, {body}"
            v.check(f"{what}: off the parabola [m]",
                    np.abs(run.vectors(body) - start - speed * t - pull * t**2 / 2).max(), 1e-11)
            v.check(f"{what}: velocity [m/s]", np.abs(run.vectors(body, "v") - speed - pull * t).max(), 3e-11)
            v.check(f"{what}: acceleration [m/s2]", np.abs(run.vectors(body, "a") - pull).max(), 1e-9)
        v.check(f"constant force, {name}: balance of the energy", energy_drift(run), 1e-6)
        fall = 4 * mass * gravity * run.vectors("bob")[:, 2]
        v.check(f"constant force, {name}: energy.gravity off m g z [J]",
                np.abs(np.diff(run["energy.gravity"]) - np.diff(fall)).max(), 1e-9)


def check_precession(v):
    """The axis of a spinning symmetric body goes round its angular momentum L at the rate |L|/I1, and the body also
    turns about its own axis."""
    across, along, end, step = 0.02, 0.035, 4.0, 1e-3
    w = np.array([2.0, 0, 9.0])
    start = product(about([1, 1, 0], 0.8), about([0, 0, 1], -0.4))
    body = {"mass": 1.0, "inertia": [across, across, along], "position": [0, 0, 0], "angular_velocity": w.tolist(),
            "orientation": {"quaternion": start.tolist()}}
    momentum = turned(start, w * [across, across, along])
    own = w[2] * (1 - along / across)
    for name, keys in SCHEMES.items():
        off = []
        for half in (step, step / 2):
            run = v.run(body_scene({"top": body}, end, half, 0.02, **keys))
            turning, t = Turning(run, "top"), run["time"]
            exact = product(product(about(momentum, np.linalg.norm(momentum) / across * t), start),
                            about([0, 0, 1], own * t))
            off.append(np.abs(turning.q - exact).max())
        what = f"free precession, {name}, step {step:g} s"
        v.check(f"{what}: quaternion, its sign too", off[0], 1e-4)
        v.at_least(f"{what}: order in the time step", orders(off)[0], 1.95)
        v.check(f"{what}: quaternion's change from row to row", np.abs(np.diff(turning.q, axis=0)).max(), 0.2)
        v.check(f"{what}: quaternions off unit length", turning.off_unit(), 1e-12)
        body_spin = np.column_stack([w[0] * np.cos(own * t), -w[0] * np.sin(own * t), np.full_like(t, w[2])])
        v.check(f"{what}: angular velocity [rad/s]", np.abs(turning.w - body_spin).max(), 1e-3)


def check_half_turn(v):
    """A step in which a body would turn by half a turn or more is refused: its ends do not tell how far it has turned,
    and a shorter one is taken instead; where none may be, the run ends and says why."""
    step, end = 0.1, 0.4
    for turns in (0.6, 0.9, 1.3, 1.9):
        rate = 2 * np.pi * turns / step
        case = body_scene({"wheel": {"mass": 1.0, "inertia": [1, 2, 2.5], "position": [0, 0, 0],
                                     "angular_velocity": [rate, 0, 0]}}, end, step, step)
        run, _ = v.attempt(case)
        turning, angle = Turning(run, "wheel"), rate * run["time"] / 2
        exact = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle, 0 * angle])
        what = f"{turns} turns in a step"
        v.at_least(f"{what}: rejected steps", run.counted("rejected_steps"), 1)
        v.check(f"{what}: quaternion, its sign too", np.abs(turning.q - exact).max(), 1e-11)
        # The option's name in older and newer PETSc; the one that the version does not know is only noted.
        _, done = v.attempt(case, "-ts_max_reject", 0, "-ts_max_step_rejections", 0)
        v.close(f"{what}, none rejected: exit status", done.returncode, 3, 0)
        v.says(f"{what}, none rejected", done.stderr, "at body wheel: it turns by half a turn within a step")


def main():
    verification = Verification(__doc__)
    check_half_turn(verification)
    check_tumbling(verification)
    check_order(verification)
    check_turned_axes(verification)
    check_constant_torque(verification)
    check_constant_force(verification)
    check_precession(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
