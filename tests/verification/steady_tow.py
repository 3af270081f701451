"""Cables towed steadily against the exact curves: as a current past a fixed point, as a ship that moves, and going on
from equilibrium in time."""
import re

import numpy as np

from statics_support import TOLERANCE, at_rest, fixed, report_number, still
from support import Verification, orders, read_reference

GRAVITY, INEXTENSIBLE = 9.80665, 1e11
TAILS = {"down": [0, 0, -1000], "ahead": [-900, 10, -20], "slack": [300, 20, -10]}


def tow_scene(case, n, moving, tail=(800, 0, -600)):
    stiffness = case["EA"] if case["EA"] > 0 else INEXTENSIBLE
    keys = {"diameter": case["d"], "mass_per_length": case["w"] / GRAVITY + case["rho"] * np.pi * case["d"]**2 / 4,
            "axial_stiffness": stiffness, "normal_drag": case["Cn"], "tangential_drag": case["Ct"]}
    fluid = {"density": case["rho"]}
    tow = {"position": [0, 0, 0], "motion": {"velocity": [-case["U"], 0, 0]}}
    if not moving:
        tow = fixed(0, 0, 0)
        fluid["current"] = {"velocity": [case["U"], 0, 0]}
    points = {"tow": tow, "tail": {"position": list(tail), "mass": case["Wd"] / GRAVITY, "drag_area": case["CdA"]}}
    cables = {"cable": {"from": "tow", "to": "tail", "length": case["L"], "elements": n}}
    return still(keys, points, cables, ["tow", "tail", "cable"], GRAVITY, {"fluid": fluid})


def errors(case, run):
    """The error of the tail's place over the length, and the relative error of the force on the tow point."""
    tail = at_rest(run, "tail") - [case["tail_x"], 0, case["tail_z"]]
    pull = -at_rest(run, "tow", "f") - [case["tow_Tx"], 0, case["tow_Tz"]]
    return np.linalg.norm(tail) / case["L"], np.linalg.norm(pull) / case["tow_T"]


def check_exact(v, case):
    found = [errors(case, v.run(tow_scene(case, n, moving=False))) for n in (50, 100, 200)]
    for what, values in zip(("tail", "force"), np.array(found).T):
        print(f"        {case['name']}: {what} off with 50, 100, 200 elements: {values}")
        v.check(f"{case['name']}: {what} off, relative", values[-1], 1e-3)
        for order in orders(values):
            v.close(f"{case['name']}: order of the {what}", order, 2, 0.1)


def check_ways(v, case):
    """A moving ship and other drawn shapes give the same equilibrium."""
    expected = v.run(tow_scene(case, 200, moving=False))
    ways = {"moving": tow_scene(case, 200, moving=True)}
    ways.update({name: tow_scene(case, 200, False, tail) for name, tail in TAILS.items()})
    for name, scene in ways.items():
        run = v.run(scene)
        off = np.abs(at_rest(run, "tail") - at_rest(expected, "tail")).max() / case["L"]
        v.check(f"{case['name']}, {name}: tail off the same tow otherwise", off, TOLERANCE)
        pull = np.abs(at_rest(run, "tow", "f") - at_rest(expected, "tow", "f")).max() / case["tow_T"]
        v.check(f"{case['name']}, {name}: force off the same tow otherwise", pull, TOLERANCE)
        print(f"        {name}: {report_number(run, 'statics', 'iterations'):.0f} iterations")


def check_stays(v, case):
    """In the first 20 s from equilibrium on, nothing moves in the ship's frame."""
    for moving in (False, True):
        scene = tow_scene(case, 100, moving)
        scene.update({"initial": "static", "time": {"end": 20, "step": 0.1}})
        scene["output"]["interval"] = 1
        run = v.run(scene)
        frame = np.outer(run["time"], [-case["U"] if moving else 0, 0, 0])
        tail = run.vectors("tail") - frame
        name = f"{case['name']}, {'moving ship' if moving else 'current'}"
        v.check(f"{name}: tail's drift in 20 s [m]", np.abs(tail - tail[0]).max(), 1e-6)
        tension = run["cable.tension_from"]
        v.check(f"{name}: tension's drift in 20 s, relative", np.ptp(tension) / tension[0], 1e-8)


TOWS = {   # velocities of two tow points: that of the frame
    "together": ([2, 1, 0], [2, 1, 0], [2, 1, 0]),
    "one slower": ([2, 1, 0], [1.6, 1.2, 0], [1.8, 1.1, 0]),
    "one much slower": ([2, 1, 0], [1.4, 1.2, 0], [0, 1.1, 0]),
    "apart": ([2, 1, 0], [-2, 1, 0], [0, 1, 0]),
    "one stays": ([2, 1, 0], [0, 0, 0], [0, 0, 0]),
    "never": ([2, 1, 0.5], [4, -1, 0.1], [0, 0, 0]),
}


def check_frames(v):
    """Two tow points: where they differ by more than a quarter of their mean, nothing moves that way."""
    keys = {"mass_per_length": 1, "axial_stiffness": 1e5}
    for name, (one, other, frame) in TOWS.items():
        points = {"a": {"position": [0, 0, 0], "motion": {"velocity": one}},
                  "b": {"position": [10, 0, 0], "motion": {"velocity": other}}}
        cable = {"line": {"from": "a", "to": "b", "elements": 8, "length": 11}}
        for time in ({}, {"initial": "static", "time": {"end": 0.1, "step": 0.01}}):
            case = still(keys, points, cable, ["a"], **time)
            run = v.run(case)
            found = re.search(r"frame_velocity: \[(.*)\]", run.report)[1].split(", ")
            v.check(f"tow points, {name}, {'going on' if time else 'still'}: frame's velocity [m/s]",
                    np.abs(np.array(found, float) - frame).max(), 1e-6)


# knots: depth [m], layback [m], T at the ship [N], angle there from the horizontal [deg]
BIOMAPPER = {1: (988.412, 145.680, 15467.65, 77.1792), 2: (860.859, 477.074, 14410.38, 49.3908),
             4: (503.544, 835.500, 12047.87, 22.8394), 6: (329.565, 928.920, 12114.18, 15.1158),
             8: (241.608, 962.394, 13788.90, 11.3520), 10: (190.353, 977.558, 16753.04, 9.0901)}
DRAWN_SLED = ([950, 0, -190], [700, 0, -700], [0, 0, -1000])
# The same at 6 knots, but with loads per unstretched length as in cablenet.  The curve was integrated from the sled
# upwards by scipy's DOP853 to 1e-12, with the stretch in the shape.
UNSTRETCHED = {"depth": 329.681306, "layback": 928.875553, "tension at the ship": 12113.218681}


def biomapper(v, knots, drawn):
    """WHOI Cable's towed sled.  The cable's area follows from its mass and its weight in water."""
    density, gravity, mass, weight, size = 1025, 9.81, 1.12, 8.89, 0.736
    keys = {"diameter": 0.0173, "area": mass / density - weight / (density * gravity), "mass_per_length": mass,
            "axial_stiffness": 1.2717e7, "normal_drag": 1.5, "tangential_drag": 0.01}
    points = {"ship": fixed(0, 0, 0),
              "sled": {"position": drawn, "mass": 1135, "volume": 4448 / (density * gravity),
                       "drag_area": 0.77 * np.pi * size**2 / 4}}
    cables = {"cable": {"from": "ship", "to": "sled", "length": 1000, "elements": 200}}
    fluid = {"fluid": {"density": density, "current": {"velocity": [0.514 * knots, 0, 0]}}}
    run = v.run(still(keys, points, cables, ["ship", "sled", "cable"], gravity, fluid))
    sled, pull = at_rest(run, "sled"), -at_rest(run, "ship", "f")
    return {"depth": -sled[2], "layback": sled[0], "tension at the ship": np.linalg.norm(pull),
            "angle at the ship": np.degrees(np.arctan2(-pull[2], pull[0]))}


def check_biomapper(v):
    for knots, expected in BIOMAPPER.items():
        for drawn in DRAWN_SLED:
            found = biomapper(v, knots, drawn)
            for (what, value), reference in zip(found.items(), expected):
                v.close(f"sled at {knots} kn, drawn at {drawn}: {what}", value, reference, 3e-3 * reference)
    found = biomapper(v, 6, DRAWN_SLED[0])
    for what, reference in UNSTRETCHED.items():
        v.close(f"sled at 6 kn, loads per unstretched length: {what}", found[what], reference, 1e-4 * reference)


def main():
    verification = Verification(__doc__)
    table = read_reference("towed_steady.csv")
    cases = [{key: column[row] for key, column in table.items()} for row in range(len(table["name"]))]
    for case in cases:
        check_exact(verification, case)
    check_ways(verification, cases[1])
    check_stays(verification, cases[1])
    check_frames(verification)
    check_biomapper(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
