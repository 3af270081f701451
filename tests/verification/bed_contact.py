"""Points and bodies come to rest on the bed where it carries them, dropped and in statics."""
import copy

import numpy as np

from statics_support import fixed, report_number
from support import Verification

GRAVITY, RHO, LEVEL = 9.81, 1025.0, -50.0
BED = {"level": LEVEL, "stiffness": 3e6, "damping": 3e5, "friction": 0.5}
WIRE = {"diameter": 0.02, "mass_per_length": 1.3, "axial_stiffness": 2e7, "axial_damping": 2e4, "tension_only": True,
        "normal_drag": 1.2, "tangential_drag": 0.05, "added_mass": 1.0}
CLOSE = 1e-4   # to an analytic height [m]


def surrounded(points, cables, end, step, history, bodies=None, **bed):
    """A scene in the water above the bed, at rest as drawn."""
    made = {
        "environment": {"gravity": GRAVITY, "fluid": {"density": RHO, "surface": 0}, "seabed": {**BED, **bed}},
        "cable_types": {"wire": WIRE}, "points": points,
        "cables": {name: {"type": "wire", **keys} for name, keys in cables.items()}, "initial": "rest",
        "time": {"end": end, "step": step}, "output": {"interval": end / 50, "history": history},
    }
    if bodies:
        made["bodies"] = bodies
    return made


def in_statics(v, name, made, weight):
    """The equilibrium of a scene that is drawn above the bed, where `weight` is the largest load on a node.  The bed is
    none.  Friction holds in it."""
    made = copy.deepcopy(made)
    del made["time"]
    made["initial"] = "static"
    run, done = v.attempt(made)
    v.close(f"{name}, in statics: exit status", done.returncode, 0, 0)
    left_out = done.stderr.count("without the bed's friction")
    v.close(f"{name}, in statics: notes that friction is left out", left_out, 0, 0)
    v.close(f"{name}, in statics: largest load [N]", report_number(run, "statics", "largest_load_on_a_node"), weight,
            0.01 * weight)
    return run


CLUMP = {"position": [0, 0, -49], "mass": 20000, "volume": 8.3, "drag_area": 4, "added_mass": 8000}


def clump_on_wires(**keys):
    """A clump between two slack anchor wires below a slack riser."""
    points = {"a1": fixed(-40, 0, LEVEL), "a2": fixed(40, 0, LEVEL), "top": fixed(0, 0, -10),
              "clump": {**CLUMP, **keys}}
    cables = {"w1": {"from": "a1", "to": "clump", "length": 41, "elements": 41},
              "w2": {"from": "a2", "to": "clump", "length": 41, "elements": 41},
              "riser": {"from": "clump", "to": "top", "length": 42, "elements": 42}}
    return surrounded(points, cables, 20, 0.02, ["clump"])


def check_clump(v):
    """A sphere of the volume, or of the given radius, rests where the pressure k depth on pi r^2 carries its weight.
    The wires' weight sinks it by some 1e-6 m."""
    for name, keys in (("clump", {}), ("clump of radius 0.4", {"contact_radius": 0.4})):
        made = clump_on_wires(**keys)
        r = keys.get("contact_radius", (0.75 / np.pi * CLUMP["volume"])**(1 / 3))
        weight = (CLUMP["mass"] - RHO * CLUMP["volume"]) * GRAVITY
        height = LEVEL + r - weight / (BED["stiffness"] * np.pi * r**2)
        dropped, still = v.run(made), in_statics(v, name, made, weight)
        v.close(f"{name}, dropped: z [m]", dropped["clump.z"][-1], height, CLOSE)
        v.close(f"{name}, in statics: z [m]", still["clump.z"][0], height, CLOSE)
        for run, how in ((dropped, "dropped"), (still, "in statics")):
            v.check(f"{name}, {how}: off the middle [m]", np.hypot(run["clump.x"], run["clump.y"])[-1], CLOSE)


SINKER = {"mass": 5000, "inertia": [1200, 1200, 1200], "position": [0, 0, -45], "volume": 2.1,
          "drag": {"quadratic": [800, 800, 800, 50, 50, 50]}, "added_mass": [1000, 1000, 1000, 50, 50, 50],
          "attachments": {"eye": [0, 0, 0.6]}}
SUBMERGED = (SINKER["mass"] - RHO * SINKER["volume"]) * GRAVITY
EDGES = np.sqrt(6 / SINKER["mass"] * (np.sum(SINKER["inertia"]) - 2 * np.array(SINKER["inertia"])))


def lowered(end=20.0, length=60, bed=None, **keys):
    """A sinker on a slack wire, or with other keys."""
    cables = {"wire": {"from": "ship", "to": "sinker.eye", "length": length, "elements": 20, "shape": "catenary"}}
    return surrounded({"ship": fixed(0, 0, 0)}, cables, end, 0.01, ["sinker"], {"sinker": {**SINKER, **keys}},
                      **bed or {})


def rest_height(below, edges=EDGES):
    """Of the centre of gravity, `below` of which four spots carry the weight; a spot has a quarter of the mean face."""
    face = (edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0]) / 3
    return LEVEL + below - SUBMERGED / (BED["stiffness"] * face)


def tilt(run, name, row=-1):
    """The angle of the body's axis that is nearest to the vertical.  [deg]"""
    w, x, y, z = (run[f"{name}.q{i}"][row] for i in "wxyz")
    third = np.array([2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)])   # the world's z, body axes
    return np.degrees(np.arccos(min(np.abs(third).max(), 1)))


def check_body(v):
    """The slack wire's weight on the eye, 1 kN at most, presses the box by some 1e-5 m more."""
    corners = rest_height(EDGES[2] / 2)
    for name, keys in (("body", {}), ("body dropped at a tilt", {"orientation": {"roll": 20, "pitch": 12}})):
        run = v.run(lowered(**keys))
        v.close(f"{name}: z [m]", run["sinker.z"][-1], corners, CLOSE)
        v.check(f"{name}: tilt [deg]", tilt(run, "sinker"), 0.1)
        v.check(f"{name}: speed [m/s]", np.linalg.norm(run.vectors("sinker", "v")[-1]), 1e-4)
    still = in_statics(v, "body", lowered(), SUBMERGED)
    v.close("body in statics: z [m]", still["sinker.z"][0], corners, CLOSE)
    v.check("body in statics: tilt [deg]", tilt(still, "sinker"), 0.1)
    feet = [[x, y, -0.9] for x in (-0.7, 0.7) for y in (-0.6, 0.6)]
    run = v.run(lowered(contact=feet))
    v.close("body on four feet: z [m]", run["sinker.z"][-1], rest_height(0.9), CLOSE)


def check_sphere_body(v):
    """A body that does not turn touches as a sphere of its volume."""
    keys = {key: value for key, value in SINKER.items() if key not in ("inertia", "attachments")}
    points = {"ship": fixed(0, 0, 0), "dummy": fixed(1, 0, 0)}
    cables = {"idle": {"from": "ship", "to": "dummy", "elements": 1}}
    keys["drag"] = {"quadratic": [800, 800, 800, 0, 0, 0]}
    keys["added_mass"] = [1000, 1000, 1000, 0, 0, 0]
    r = (0.75 / np.pi * SINKER["volume"])**(1 / 3)
    run = v.run(surrounded(points, cables, 20, 0.01, ["ball"], {"ball": keys}))
    v.close("body without inertia: z [m]", run["ball.z"][-1],
            LEVEL + r - SUBMERGED / (BED["stiffness"] * np.pi * r**2), CLOSE)


def check_no_contact(v):
    """They sink into the bed until their wires lie on it."""
    run = v.run(lowered(contact=[]))
    v.check("body without contact: z [m]", run["sinker.z"][-1], LEVEL - 0.6)
    points = {"top": fixed(0, 0, -40), "clump": {**CLUMP, "contact_radius": 0}}
    cables = {"riser": {"from": "clump", "to": "top", "length": 20, "elements": 10}}
    made = surrounded(points, cables, 20, 0.02, ["clump"])
    v.check("clump without contact: z [m]", v.run(made)["clump.z"][-1], LEVEL - 0.6)


def slid(pull, hold, travel, mass, t):
    """The way at the time t of what a pull sets off from rest, on springs that hold up to `hold` at their `travel`."""
    omega = np.sqrt(hold / travel / mass)
    slips = np.arccos(1 - hold / pull) / omega
    speed, gain = np.sqrt((2 * pull - hold) * travel / mass), (pull - hold) / mass
    return travel + speed * (t - slips) + 0.5 * gain * (t - slips)**2


def check_pushed_body(v):
    """A body that stands on the bed is held against a push below mu W, and slides above.  A push that comes at once
    goes as far as twice the springs' travel, and slips a little there.  The wire adds some 0.1 % to the weight."""
    keys = {"position": [0, 0, rest_height(EDGES[2] / 2)], "drag": {"quadratic": [0] * 6}}
    hold, travel, end = BED["friction"] * SUBMERGED, BED["friction"] * 0.007 * EDGES.max(), 5.0
    runs = {share: v.run(lowered(end, force=[share * hold, 0, 0], **keys)) for share in (0.8, 1.2)}
    v.check("body that is pushed by 0.8 mu W: way [m]", np.abs(runs[0.8]["sinker.x"]).max(), 4 * travel)
    # The damper beside the spring lets friction reach mu W sooner than the spring alone, and later than at once.
    mass = SINKER["mass"] + SINKER["added_mass"][0]
    most, least = slid(1.2 * hold, hold, travel, mass, end), 0.1 * hold / mass * end**2
    v.close("body that is pushed by 1.2 mu W: way [m]", runs[1.2]["sinker.x"][-1], (most + least) / 2,
            (most - least) / 2 + 0.001 * most)


def main():
    verification = Verification(__doc__)
    check_clump(verification)
    check_body(verification)
    check_sphere_body(verification)
    check_no_contact(verification)
    check_pushed_body(verification)
    verification.finish()


if __name__ == "__main__":
    main()
