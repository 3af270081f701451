"""Bodies whose pitch passes 90 degrees.  Quaternions take no notice.  With Euler angles the run stops and says why."""
import re

import numpy as np

from attitude import Turning, about, angle_between, pitch, product
from support import Verification, body_scene, read_reference, rows_at

MOMENTS = [0.01, 0.02, 0.03]
STEP, INTERVAL = 1e-3, 0.04
SCHEMES = {"no scheme named": {}, "generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}


def plain_turn(angle):
    def attitude(t):
        return about([0, 1, 0], angle(t))
    return attitude


def from_reference(name):
    reference = read_reference(name)
    q = np.column_stack([reference[f"q{i}"] for i in range(4)])
    return lambda t: q[rows_at(reference["t"], t)]


def cases():
    """{name: (keys of the body, attitude as a function of times, when the pitch passes or nearly reaches 90 deg)}"""
    first = read_reference("torque_free_D3c.csv")
    start = {"orientation": {"quaternion": [first[f"q{i}"][0] for i in range(4)]},
             "angular_velocity": [first[f"w{i}"][0] for i in (1, 2, 3)]}
    return {
        "uniform turn": ({"angular_velocity": [0, 1, 0]}, plain_turn(lambda t: t), np.pi / 2),
        "turn under torque": ({"torque": [0, 0.02, 0]}, plain_turn(lambda t: t**2 / 2), np.sqrt(np.pi)),
        "close to 90 degrees": ({"angular_velocity": [1e-3, 1, 1e-3]}, from_reference("torque_free_D3b.csv"),
                                np.pi / 2),
        "exactly 90 degrees": (start, from_reference("torque_free_D3c.csv"), 2.0),
    }


def body(keys, **more):
    return {"mass": 1.0, "inertia": MOMENTS, "position": [0, 0, 0], **keys, **more}


def label(kind, name):
    """The name of a body."""
    return f"{kind}_{name}".replace(" ", "_")


def turned_start(keys, turn):
    """The keys of a body that moves in the same way in a turned world."""
    start = keys.get("orientation", {"quaternion": [1, 0, 0, 0]})["quaternion"]
    return {**keys, "orientation": {"quaternion": product(turn, np.array(start)).tolist()}}


def check_quaternions(v):
    """The error is as large as in a world that is turned so that the pitch stays small."""
    turn = about([1, 0, 0], np.pi / 2)   # the pitch then is what was the yaw
    bodies = {label(place, name): body(keys if place == "here" else turned_start(keys, turn))
              for name, (keys, *_) in cases().items() for place in ("here", "away")}
    for scheme, time_keys in SCHEMES.items():
        run = v.run(body_scene(bodies, 4, STEP, INTERVAL, **time_keys))
        for name, (_, attitude, _) in cases().items():
            here, away = (Turning(run, label(place, name)) for place in ("here", "away"))
            exact = attitude(run["time"])
            off, off_away = angle_between(exact, here.q), angle_between(product(turn, exact), away.q)
            what = f"{name}, {scheme}"
            v.at_least(f"{what}: largest pitch [deg]", pitch(here.q).max(), 88)
            v.check(f"{what}: largest pitch in the turned world [deg]", np.abs(pitch(away.q)).max(), 30)
            v.check(f"{what}: error in 4 s [rad]", off.max(), 1e-5)
            v.check(f"{what}: error off that in the turned world [rad]", np.abs(off - off_away).max(), 1e-10)
            v.check(f"{what}: quaternion, its sign too", np.abs(exact - here.q).max(), 1e-5)


def check_angles_before(v):
    """As long as the pitch is below 60 degrees, Euler angles are as accurate as quaternions."""
    bodies = {label(rotation, name): body(keys, rotation=rotation)
              for name, (keys, *_) in cases().items() for rotation in ("quaternion", "euler")}
    for scheme, time_keys in SCHEMES.items():
        run = v.run(body_scene(bodies, 0.96, STEP, INTERVAL, **time_keys))
        for name, (_, attitude, _) in cases().items():
            exact = attitude(run["time"])
            off, limit = (angle_between(exact, Turning(run, label(rotation, name)).q).max()
                          for rotation in ("euler", "quaternion"))
            v.check(f"{name}, {scheme}: error of euler in 0.96 s [rad]", off, 10 * limit + 1e-9)


def check_angles_stop(v):
    for name, (keys, attitude, passage) in cases().items():
        if name == "close to 90 degrees":
            continue
        for scheme, time_keys in SCHEMES.items():
            what = f"euler to 90 degrees, {name}, {scheme}"
            run, done = v.attempt(body_scene({"spinner": body(keys, rotation="euler")}, 4, STEP, INTERVAL, **time_keys))
            v.close(f"{what}: exit status", done.returncode, 3, 0)
            v.says(what, done.stderr, "spinner", "pitch", "90 degrees", "rotation: quaternion")
            if run is None or done.returncode != 3:
                v.says(f"{what}: history", "none", "history.csv")
                continue
            named = re.search(r"at t = ([-+.0-9e]+) s", done.stderr)
            end = run["time"][-1]
            v.close(f"{what}: time named [s]", float(named[1]) if named else np.nan, end, 1e-6)
            v.close(f"{what}: time of the stop [s]", end, passage, 0.1)
            check_states(v, what, run, attitude, keys)


def check_states(v, what, run, attitude, keys):
    """Every row before the stop is on the exact motion.  The last row is at a time that the solver chose, and has the
    right energy."""
    turning, moments = Turning(run, "spinner"), np.diag(MOMENTS)
    exact = attitude(run["time"][:-1])
    v.check(f"{what}: error before the stop [rad]", angle_between(exact, turning.q[:-1]).max(), 1e-6)
    step = angle_between(turning.q[-2:-1], turning.q[-1:])[0]
    time = run["time"][-1] - run["time"][-2]
    v.close(f"{what}: turn in the last row [rad]", step, time * np.linalg.norm(turning.w[-1]), 1e-4 + 0.1 * time**2)
    energy = turning.energy(moments)
    work = np.asarray(keys.get("torque", [0, 0, 0])) @ [0, 1, 0] * run["time"]**2 / 2
    v.check(f"{what}: energy, relative to its largest", np.abs(energy - energy[0] - work).max() / energy.max(), 1e-3)
    v.check(f"{what}: energy.total, relative to the largest kinetic energy",
            np.abs(run["energy.total"] - run["energy.total"][0]).max() / run["energy.kinetic"].max(), 1e-3)
    v.check(f"{what}: energy.kinetic off that of q and w, relative",
            np.abs(run["energy.kinetic"] - energy).max() / energy.max(), 1e-9)
    v.check(f"{what}: quaternions off unit length", turning.off_unit(), 1e-12)


def main():
    verification = Verification(__doc__)
    check_quaternions(verification)
    check_angles_before(verification)
    check_angles_stop(verification)
    verification.check("rejected steps in the runs that went on", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
