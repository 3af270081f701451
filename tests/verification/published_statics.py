"""Equilibria with published numbers: a cable under a load, a heated one, a stayed frame, moorings, small nets."""
import numpy as np

from statics_support import Catenary, at_rest, fixed, report_number, still
from support import Verification

FOOT, KIP = 0.3048, 4448.2216152605


def michalos_birnstiel(v):
    """Compares places of the load point with Jayaraman & Knudson, Computers & Structures 14 (1981) 301, in feet."""
    keys = {"mass_per_length": 3.16 * KIP / 1000 / FOOT, "axial_stiffness": 0.85 * 19000 * KIP}
    left, right = 412.8837 * FOOT, 613.0422 * FOOT
    places = []
    for load in (0, 8 * KIP):
        points = {"a": fixed(0, 0, 0), "b": fixed(1000 * FOOT, 0, 0),
                  "m": {"position": [400 * FOOT, 0, 0], "force": [0, 0, -load]}}
        cables = {"left": {"from": "a", "to": "m", "length": left, "elements": 40},
                  "right": {"from": "m", "to": "b", "length": right, "elements": 60}}
        run = v.run(still(keys, points, cables, ["a", "m"], 1))
        places.append(at_rest(run, "m") / FOOT)
    sag, displacement = -places[0][2], places[1] - places[0]
    v.close("loaded cable: sag under its weight [ft]", sag, 96.0495, 5e-4 * 96.0495)
    v.close("loaded cable: vertical displacement [ft]", displacement[2], -18.45675, 0.01)
    v.close("loaded cable: horizontal displacement [ft]", displacement[0], -2.81944, 0.005)
    pull = -at_rest(run, "a", "f") / KIP
    v.close("loaded cable: horizontal force [kip]", pull[0], 20.1072, 1e-3 * 20.1072)
    v.close("loaded cable: vertical force [kip]", -pull[2], 6.45109, 1e-3 * 6.45109)


def heated_cable(v):
    """Code_Aster SSNL114 (V6.02.114): a cable of 325 m over 325 m, cold and heated by 39.26 K; Richardson's z."""
    area = 2.2783e-4
    for heating, published, closed in ((0, -6.352, -6.352161), (39.26, -8.1955, -8.195452)):
        length = 325 * (1 + 2.3e-5 * heating)
        z = []
        for n in (20, 40):
            keys = {"mass_per_length": area * 2844.23, "axial_stiffness": 5.70e10 * area}
            points = {"a": fixed(0, 0, 0), "b": fixed(325, 0, 0), "m": {"position": [162.5, 0, 0]}}
            cables = {"left": {"from": "a", "to": "m", "length": length / 2, "elements": n},
                      "right": {"from": "m", "to": "b", "length": length / 2, "elements": n}}
            z.append(at_rest(v.run(still(keys, points, cables, ["m"])), "m")[2])
        limit = z[1] + (z[1] - z[0]) / 3
        v.close(f"heated cable, {heating} K: z [m]", z[1], published, 1e-3)
        v.close(f"heated cable, {heating} K: extrapolated z [m]", limit, closed, 1e-6 * abs(closed))


def two_spans(v):
    """Code_Aster SSNL100 without its pulleys: 105 m of cable in each span of 100 m."""
    points = {"o": fixed(0, 0, 0), "p": fixed(100, 0, 0), "q": fixed(200, 0, 0),
              "m": {"position": [50, 0, 0]}, "n": {"position": [150, 0, 0]}}
    half = {"length": 52.5, "elements": 40}
    cables = {"om": {"from": "o", "to": "m", **half}, "mp": {"from": "m", "to": "p", **half},
              "pn": {"from": "p", "to": "n", **half}, "nq": {"from": "n", "to": "q", **half}}
    run = v.run(still({"mass_per_length": 30, "axial_stiffness": 5e7}, points, cables, ["o", "p", "m", "n"], 1))
    for name in "mn":
        v.close(f"two spans: sag at {name} [m]", -at_rest(run, name)[2], 13.9392, 2e-4 * 13.9392)
    v.close("two spans: horizontal force [N]", -at_rest(run, "o", "f")[0], 2757.11, 1e-3 * 2757.11)
    v.check("two spans: horizontal force on the inner support [N]", abs(at_rest(run, "p", "f")[0]), 1e-5)


def stayed_frame(v):
    """Code_Aster SSNL105: four bars around two ropes that carry no compression, 1000 N at a corner.

    Corners 1 and 4 stand as there: 1 fixed, 4 free along x, held in z by a bar 20 m long.  Further bars 20 m long hold
    the corners in their plane, where they carry nothing.  Corner 3 is drawn 1 mm off: as the frame stands there,
    neither rope resists, and it is a mechanism.
    """
    stiffness, far = 2.1e8, 20
    corner = {1: [0, 0, 0], 2: [0, 0, 1], 3: [1, 0, 1], 4: [1, 0, 0]}
    points = {f"n{i}": {"position": place} for i, place in corner.items()}
    points["n1"]["motion"] = "fixed"
    points["n3"] = {"position": [1.001, 0, 1], "force": [1000, 0, 0]}
    points["above"] = fixed(1, 0, far)
    cables = {f"bar{i}{j}": {"type": "bar", "from": f"n{i}", "to": f"n{j}", "elements": 1, "length": 1}
              for i, j in ((1, 2), (2, 3), (3, 4), (4, 1))}
    for i, j in ((1, 3), (4, 2)):
        cables[f"rope{i}{j}"] = {"type": "rope", "from": f"n{i}", "to": f"n{j}", "elements": 1,
                                  "length": float(np.sqrt(2))}
    cables["hold"] = {"type": "guide", "from": "above", "to": "n4", "elements": 1}
    for i in (2, 3, 4):
        points[f"beside{i}"] = fixed(corner[i][0], far, corner[i][2])
        cables[f"guide{i}"] = {"type": "guide", "from": f"beside{i}", "to": f"n{i}", "elements": 1,
                                "length": far}
    types = {"bar": {"mass_per_length": 1, "axial_stiffness": stiffness},
             "rope": {"mass_per_length": 1, "axial_stiffness": stiffness, "tension_only": True},
             "guide": {"mass_per_length": 1, "axial_stiffness": far * stiffness}}
    run = v.run(still(types, points, cables, list(cables), 0))
    tension = {name: run[f"{name}.tension_from"][0] for name in cables}
    v.close("stayed frame: taut diagonal [N]", tension["rope13"], 1000 * np.sqrt(2), 1e-5 * 1414)
    v.close("stayed frame: compressed bar [N]", tension["bar34"], -1000, 1e-2)
    v.close("stayed frame: slack diagonal [N]", tension["rope42"], 0, 0)
    for name in ("bar12", "bar23", "bar41", "guide2", "guide3", "guide4"):
        v.close(f"stayed frame: {name} [N]", tension[name], 0, 0.05)
    v.close("stayed frame: what holds corner 4 [N]", tension["hold"], 1000, 1e-2)


BED_STIFFNESS = 1e6   # [Pa/m]; the line sinks in by 8 mm, which changes the forces by 4e-5

# x, z, length, EA, w, on the bed, fAH, fAV, fBH, fBV, length on the bed: MoorPy's tests/test_catenary.py with no or the
# least friction.
MOORINGS = ((400, 200, 500, 7.51e12, 800, True, 96643.42815934008, 0, -96643.42815934008, -237751.75535996316,
             202.81030580004602),
            (400, 200, 500, 7.51e12, 200, False, 43694.580989249596, -22365.599350216216, -43694.580989249596,
             -77634.40064978378, 0),
            (89.9, 59.2, 130, 7.51e8, 881.05, False, 31373.229006023103, -26650.341270116318, -31373.229006023103,
             -87886.15872988368, 0))
# fBH, fBV of the first with friction 0.1 and 5.  Its fAH is 80418.6 and 0 by rigid friction.  So stiff a line hardly
# moves along the bed, and springs hold less.
RUBBED = {0.1: (-96643.42877136687, -237751.75577183915), 5: (-96643.43501616362, -237751.75997440016)}


def moor(v, x, z, length, stiffness, w, on_bed, elements, friction=0):
    """The forces (fAH, fAV, fBH, fBV) of the cable's ends on their points, as MoorPy gives them.

    The bed lies so much lower than the anchor that the line rests at the anchor's height.
    """
    keys = {"diameter": 0.1, "mass_per_length": w, "axial_stiffness": stiffness}
    bed = {"level": w / (0.1 * BED_STIFFNESS), "stiffness": BED_STIFFNESS, "damping": 0, "friction": friction}
    cables = {"line": {"from": "a", "to": "b", "length": length, "elements": elements}}
    run = v.run(still(keys, {"a": fixed(0, 0, 0), "b": fixed(x, 0, z)}, cables, ["a", "b"], 1,
                      {"seabed": bed} if on_bed else {}))
    print(f"        {report_number(run, 'statics', 'iterations'):.0f} iterations")
    a, b = -at_rest(run, "a", "f"), -at_rest(run, "b", "f")
    return np.array([a[0], a[2], b[0], b[2]])


def moorings(v):
    for row in MOORINGS:
        given, expected = row[:6], np.array(row[6:10])
        found = [moor(v, *given, n) for n in (250, 500)]
        limit = found[1] + (found[1] - found[0]) / 3
        name = f"mooring {row[0]} m, {row[4]} N/m"
        print(f"        {name}: off by {found[1] - expected} N, extrapolated {limit - expected} N")
        if row[5]:
            v.check(f"{name}: vertical force on the anchor over the line's weight", abs(limit[1]) / 4e5, 1e-5)
            limit = np.delete(limit, 1)
            expected = np.delete(expected, 1)
        v.check(f"{name}: forces off, relative", np.abs(limit / expected - 1).max(), 1e-4 if row[5] else 1e-5)
    for friction, (h, vertical) in RUBBED.items():
        found = moor(v, *MOORINGS[0][:6], 500, friction)
        print(f"        friction {friction}: off by {found[2:] - [h, vertical]} N; at the anchor {found[0]} N")
        v.check(f"mooring, friction {friction}: forces at the upper end off, relative",
                np.abs(found[2:] / [h, vertical] - 1).max(), 1e-4)
    soft = Catenary(400, 200, 500, 1e7, 800, on_bed=True)
    found = moor(v, 400, 200, 500, 1e7, 800, True, 500)
    v.check("mooring, EA = 1e7 N: forces at the upper end off, relative",
            np.abs(found[2:] / [-soft.h, -soft.v] - 1).max(), 1e-4)


def small_nets(v):
    """Feron, Latteur & Almeida, Arch. Comput. Methods Eng. (2024): prestress by shorter cables."""
    ends = {0: (0, 0, 1), 1: (0, 0, 0), 2: (4, 0, 0)}
    stiffness = 70e9 * 50.265e-6
    for name, shortened, tensions, place in (
            ("turning", {0: 52.110e-3}, (1823.48, 5365.62, 7037.17), (1.999524, 0, 0.118795)),
            ("slack", {1: 7.984e-3}, (0, 7037.17, 7037.17), (1.996, 0, 0))):
        points = {f"n{i}": fixed(*end) for i, end in ends.items()}
        points["n3"] = {"position": [2, 0, 0]}
        cables = {f"c{i}": {"from": f"n{i}", "to": "n3", "elements": 1,
                            "length": float(np.linalg.norm(np.array(end) - [2, 0, 0])) - shortened.get(i, 0)}
                  for i, end in ends.items()}
        keys = {"mass_per_length": 1, "axial_stiffness": stiffness, "tension_only": True}
        run = v.run(still(keys, points, cables, ["n3", *cables], 0))
        for i, tension in enumerate(tensions):
            v.close(f"three cables, {name}: tension {i} [N]", run[f"c{i}.tension_from"][0], tension, 0.2)
        v.check(f"three cables, {name}: node off [m]", np.abs(at_rest(run, "n3") - place).max(), 1e-6)
    for load, published, tension in ((5109, 75.0e-3, 34043), (9988, 105.0e-3, 47487)):
        length, stiffness = 1 - 3.984e-3, 50e-6 * 100e9
        points = {"a": fixed(0, 0, 0), "b": fixed(2, 0, 0), "m": {"position": [1, 0, 0], "force": [0, 0, -load]}}
        cables = {"left": {"from": "a", "to": "m", "length": length, "elements": 1},
                  "right": {"from": "m", "to": "b", "length": length, "elements": 1}}
        keys = {"mass_per_length": 1, "axial_stiffness": stiffness}
        run = v.run(still(keys, points, cables, ["m", "left"], 0))
        sag, found = -at_rest(run, "m")[2], run["left.tension_from"][0]
        v.close(f"tight rope, {load} N: sag [m]", sag, published, 0.01 * published)
        v.close(f"tight rope, {load} N: tension [N]", found, tension, 0.01 * tension)
        side = np.hypot(1, sag)
        v.close(f"tight rope, {load} N: tension of that stretch [N]", found, stiffness * (side / length - 1), 1e-6)
        v.close(f"tight rope, {load} N: its pull upwards [N]", 2 * found * sag / side, load, 1e-6)


def joined_lines(v):
    """Two lines of 500 m joined at a point that is drawn 50 m off, against the catenary of 1000 m over 900 m."""
    exact = Catenary(900, 0, 1000, 1e8, 98.1)
    z, seconds = [], []
    for n in (100, 200):
        points = {"a": fixed(0, 0, 0), "b": fixed(900, 0, 0), "m": {"position": [450, 50, -50]}}
        half = {"length": 500, "elements": n}
        cables = {"one": {"from": "a", "to": "m", **half}, "two": {"from": "m", "to": "b", **half}}
        run = v.run(still({"mass_per_length": 10, "axial_stiffness": 1e8}, points, cables, ["a", "m"]))
        place, pull = at_rest(run, "m"), -at_rest(run, "a", "f")
        seconds.append(report_number(run, "cpu_seconds", "statics"))
        print(f"        joined lines, {n} elements each: off by {place - [450, 0, exact.at(500)[1]]} m, horizontal "
              f"force off by {pull[0] - exact.h:.3g} N; {report_number(run, 'statics', 'iterations'):.0f} iterations, "
              f"{seconds[-1]:.4f} s")
        z.append(place[2])
        v.check(f"joined lines, {n} elements each: joint off sideways [m]", np.abs(place[:2] - [450, 0]).max(), 1e-6)
        v.check(f"joined lines, {n} elements each: joint off in z [m]", abs(z[-1] - exact.at(500)[1]), 40 / n**2)
    v.close("joined lines: extrapolated z [m]", z[1] + (z[1] - z[0]) / 3, exact.at(500)[1], 1e-5)


def main():
    verification = Verification(__doc__)
    for check in (michalos_birnstiel, heated_cable, two_spans, stayed_frame, moorings, small_nets, joined_lines):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
