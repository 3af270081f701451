"""Equilibria of slack ropes, things afloat and nets, and scenes that have none."""
import numpy as np

from statics_support import Catenary, at_rest, fixed, report_number, still
from support import Verification

WATER = {"density": 1025}


def slack_and_taut(v):
    """A mass hangs on two ropes of which one is loose, with and without compression in slack elements."""
    for tension_only in (False, True):
        keys = {"mass_per_length": 0.5, "axial_stiffness": 1e6, "tension_only": tension_only}
        points = {"a": fixed(0, 0, 0), "b": fixed(8, 0, 0), "m": {"position": [1, 0, -1], "mass": 100}}
        cables = {"short": {"from": "a", "to": "m", "length": 5, "elements": 10},
                  "long": {"from": "b", "to": "m", "length": 20, "elements": 80}}
        run = v.run(still(keys, points, cables, ["a", "b", "m", "short", "long"]))
        name = "slack rope, tension only" if tension_only else "slack rope"
        m, a, b = at_rest(run, "m"), at_rest(run, "a", "f"), at_rest(run, "b", "f")
        v.check(f"{name}: forces do not add up to the weight [N]",
                np.abs(a + b - [0, 0, (100 + 0.5 * 25) * 9.81]).max(), 1e-5)
        exact = Catenary(8 - m[0], -m[2], 20, 1e6, 0.5 * 9.81)
        v.check(f"{name}: force off the catenary's from the mass to the support, relative",
                np.hypot(abs(b[0]) - exact.h, b[2] - exact.v) / exact.v, 2e-3)


def buoyant_line(v):
    """A line lighter than water stands up from its anchors as a catenary upside down."""
    density, diameter, length = 500, 0.05, 130
    area = np.pi * diameter**2 / 4
    w = (1025 - density) * area * 9.81
    keys = {"diameter": diameter, "density": density, "axial_stiffness": 1e7}
    points = {"a": fixed(0, 0, -100), "b": fixed(100, 0, -100), "m": {"position": [50, 0, -100]}}
    cables = {"left": {"from": "a", "to": "m", "length": length / 2, "elements": 40},
              "right": {"from": "m", "to": "b", "length": length / 2, "elements": 40}}
    run = v.run(still(keys, points, cables, ["a", "m"], environment={"fluid": WATER}))
    exact = Catenary(100, 0, length, 1e7, w)
    v.close("buoyant line: height [m]", at_rest(run, "m")[2] + 100, -exact.at(length / 2)[1], 1e-3 * length)
    v.close("buoyant line: horizontal force [N]", abs(at_rest(run, "a", "f")[0]), exact.h, 1e-3 * exact.h)


def buoy_at_the_surface(v):
    """A sphere floats half out of the water.  It displaces its own weight and that of its chain in water."""
    volume, mass = 2.0, 1100.0
    radius = (3 * volume / (4 * np.pi))**(1 / 3)
    keys = {"diameter": 0.03, "mass_per_length": 8, "axial_stiffness": 1e7}
    points = {"a": fixed(0, 0, -50), "buoy": {"position": [20, 5, -10], "mass": mass, "volume": volume}}
    cables = {"chain": {"from": "a", "to": "buoy", "length": 60, "elements": 60}}
    run = v.run(still(keys, points, cables, ["a", "buoy", "chain"],
                      environment={"fluid": {**WATER, "surface": 0, "current": {"velocity": [1, 0, 0]}}}))
    z, a = at_rest(run, "buoy")[2], at_rest(run, "a", "f")
    depth = radius - z
    displaced = np.pi * depth**2 * (radius - depth / 3)
    weight = mass + 60 * (8 - 1025 * np.pi * 0.03**2 / 4)
    v.close("buoy at the surface: its middle over its radius", z / radius, -0.5, 0.45)
    v.check("buoy at the surface: vertical forces do not add up, over its displacement",
            abs(a[2] + (1025 * displaced - weight) * 9.81) / (1025 * volume * 9.81), 1e-9)


def on_the_bed(v):
    """A drawn-out line on the bed lies where the bed's pressure is its weight in water, be it hardly heavier than that:
    contact sets in within the outermost fifth of this depth."""
    diameter, stiffness, gravity = 0.05, 2e3, 10
    for density in (1030, 1100, 7800):
        depth = (density - WATER["density"]) * np.pi * diameter**2 / 4 * gravity / (stiffness * diameter)
        keys = {"diameter": diameter, "density": density, "axial_stiffness": 1e4}
        points = {"a": fixed(0, 0, -20 - depth), "b": {"position": [10, 0.1, -20], "force": [50, 0, 0]}}
        cable = {"line": {"from": "a", "to": "b", "elements": 5, "length": 10}}
        run = v.run(still(keys, points, cable, ["b"], gravity,
                          {"fluid": WATER, "seabed": {"level": -20, "stiffness": stiffness, "damping": 0}}))
        v.close(f"line of {density} kg/m3 on the bed: depth in it [m]", -20 - at_rest(run, "b")[2], depth, 1e-8 * depth)


def nets(v):
    """A net that is held at its sides sags under its weight, and nets hang or stand in a current.  No point lies in
    them, so only the balance of forces is checked."""
    flat = [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]]
    upright = [[0, 0, 0], [10, 0, 0], [10, 0, -10], [0, 0, -10]]
    around = ["top", "right", "bottom", "left"]
    keys = {"diameter": 0.004, "density": 1140, "axial_stiffness": 1e4, "tension_only": True, "normal_drag": 1.2,
            "tangential_drag": 0.01}
    fluid = {"fluid": {**WATER, "current": {"velocity": [0, 0.5, 0]}}}
    for name, corners, edges, environment in (("sagging", flat, around, {}),
                                              ("hanging in a current", upright, around[:1], fluid),
                                              ("spread against a current", upright, around, fluid)):
        panel = {"type": "rope", "corners": corners, "meshes": [12, 12], "slack": 1.05, "fixed": edges}
        run = v.run(still(keys, {}, {}, [], environment=environment, nets={"panel": panel}))
        v.check(f"net, {name}: unbalanced force over the largest load",
                report_number(run, "statics", "largest_unbalanced_force_over_load"), 1e-9)


def strangers(v):
    """Cables of 40 to 160 elements that are not joined have the same shape in one scene as each has alone."""
    points, cables = {}, {}
    for i, n in enumerate((40, 80, 160)):
        points.update({f"a{i}": fixed(0, i, 0), f"b{i}": fixed(100, i, 0), f"m{i}": {"position": [50, i, 0]}})
        for ends in (("a", "m"), ("m", "b")):
            cables["".join(ends) + str(i)] = {"from": f"{ends[0]}{i}", "to": f"{ends[1]}{i}", "length": 150,
                                              "elements": n}
    run = v.run(still({"mass_per_length": 1, "axial_stiffness": 1e6}, points, cables, ["m0", "m1", "m2"], 10))
    for i, sag in enumerate((133.540650690704,) * 3):
        v.close(f"three slack cables: sag {i} [m]", -at_rest(run, f"m{i}")[2], sag, 0.1 / 4**i)


def none(v):
    """A scene without equilibrium ends with exit status 3 and a message that names the place, and claims no result."""
    keys = {"diameter": 0.02, "density": 7800, "axial_stiffness": 1e6}
    ends = {"a": {"position": [0, 0, 0]}, "b": {"position": [10, 0, 0]}}
    cable = {"loose": {"from": "a", "to": "b", "elements": 5}}
    held = {"p": fixed(0, 5, 0), "q": fixed(10, 5, 0)}
    moored = {"held": {"from": "p", "to": "q", "length": 11, "elements": 5}}
    sinker = {"sinker": {"mass": 100, "inertia": [1, 1, 1], "position": [0, 0, -5], "volume": 0.05}}
    for name, scene, places in (
            ("a cable fixed nowhere", still(keys, ends, cable, ["a"]), ("loose",)),
            ("it beside one that is fixed", still(keys, {**ends, **held}, {**cable, **moored}, ["a"]), ("loose",)),
            ("it in a current", still(keys, ends, cable, ["a"], environment={
                "fluid": {**WATER, "current": {"velocity": [1, 0, 0]}}}), ("loose",)),
            ("a body that sinks", still(keys, held, moored, ["sinker"], environment={"fluid": WATER},
                                        bodies=sinker), ("sinker",)),
            ("it in a vacuum", still(keys, held, moored, ["sinker"], bodies={
                "sinker": {"mass": 100, "inertia": [1, 1, 1], "position": [0, 0, -5]}}), ("sinker",))):
        _, done = v.attempt(scene)
        v.close(f"{name}: exit status", done.returncode, 3, 0)
        v.says(name, done.stderr, "no equilibrium", *places)
        v.close(f"{name}: errors told", done.stderr.count("error:"), 1, 0)


def main():
    verification = Verification(__doc__)
    for check in (slack_and_taut, buoyant_line, buoy_at_the_surface, on_the_bed, nets, strangers, none):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
