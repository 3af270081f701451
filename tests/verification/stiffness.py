"""The stiffness in an equilibrium: against closed forms, against differences of equilibria, and alike on 1, 2 and 3 ranks."""
import csv
import json
import subprocess
import sys

import numpy as np

from statics_support import Catenary, fixed, still
from support import Verification

TOLERANCE = 1e-5   # of differences of equilibria


def matrices(v, scene, ranks=None):
    """name -> matrix, from stiffness.csv, and what was said.  run.yaml must hold the same numbers."""
    path, folder = v.scratch / "scene.yaml", v.scratch / "results"
    path.write_text(json.dumps(scene))
    launcher = ["mpirun", "-n", str(ranks)] if ranks else []
    done = subprocess.run([*launcher, v.program, "run", path, "-o", folder], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"FAILED: exit status {done.returncode}: {done.stderr}")
    found, report = {}, (folder / "run.yaml").read_text()
    for row in csv.DictReader((folder / "stiffness.csv").open()):
        numbers = [row[key] for key in ("x", "y", "z", "rx", "ry", "rz") if row[key]]
        found.setdefault(row["name"], []).append(list(map(float, numbers)))
        v.says(f"run.yaml, row {row['response']} of {row['name']}", report, *numbers)
    return {name: np.array(rows) for name, rows in found.items()}, done.stderr


def moored(**changes):
    """A buoy body on two chains with touchdown, a tap with a float, in a current: nothing is symmetric."""
    scene = still(
        {"chain": {"diameter": 0.1, "mass_per_length": 60, "axial_stiffness": 4e7, "tension_only": True, "normal_drag": 1.6,
                   "tangential_drag": 0.1},
         "rope": {"diameter": 0.05, "mass_per_length": 3, "axial_stiffness": 1e6, "normal_drag": 1.2}},
        {"a": fixed(-170, 0, -50), "b": fixed(150, 60, -50), "end": {"position": [30, -40, -20], "volume": 0.3, "mass": 50}},
        {"one": {"from": "a", "to": "buoy.left", "length": 190, "elements": 30, "type": "chain", "shape": "catenary"},
         "two": {"from": "b", "to": "buoy.right", "length": 180, "elements": 30, "type": "chain", "shape": "catenary"},
         "side": {"from": {"cable": "one", "at": 152}, "to": "end", "length": 40, "elements": 8, "type": "rope"}},
        ["a", "end", "buoy"],
        environment={"fluid": {"density": 1025, "surface": 0, "current": {"velocity": [0.8, 0.3, 0]}},
                     "seabed": {"level": -50, "stiffness": 3e5}},
        bodies={"buoy": {"mass": 3000, "inertia": [4000, 5000, 6000], "position": [0, 0, -2], "volume": 20,
                         "center_of_buoyancy": [0, 0, 0.8], "drag": {"quadratic": [500, 500, 800, 0, 0, 0]},
                         "attachments": {"left": [-1, 0, -1.5], "right": [1, 0.4, -1.5]}}})
    scene["output"]["stiffness"] = ["a", "end", "buoy"]
    for path, value in changes.items():
        place = scene
        for key in path.split("__")[:-1]:
            place = place[key]
        place[path.split("__")[-1]] = value
    return scene


def report_of(v, name, K, expected, share=TOLERANCE):
    v.check(f"{name}: K apart from differences, over the largest", np.abs(K - expected).max() / np.abs(expected).max(), share)


def held_point(v, K):
    """The reaction of a held point, by its displacement."""
    at, h = np.array([-170, 0, -50]), 1e-3
    def reaction(dx):
        run = v.run(moored(points__a__position=list(at + dx)))
        return run.vectors("a", "f")[0]
    columns = [(reaction(h * e) - reaction(-h * e)) / (2 * h) for e in np.eye(3)]
    report_of(v, "a held end of a chain on the bed", K, np.column_stack(columns))


def free_point(v, K):
    """The inverse of how a free point follows a force."""
    def place(force):
        return v.run(moored(points__end__force=list(force))).vectors("end")[0]
    f = 0.5
    flexibility = np.column_stack([(place(f * e) - place(-f * e)) / (2 * f) for e in np.eye(3)])
    report_of(v, "a free end afloat", K, np.linalg.inv(flexibility))


def turned_by(q, base):
    """The small rotation vector in the world's axes from attitude `base` to q."""
    w, x, y, z = base
    conjugate = np.array([w, -x, -y, -z])
    def product(a, b):
        return np.array([a[0] * b[0] - a[1:] @ b[1:], *(a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:]))])
    return 2 * product(q, conjugate)[1:] * np.sign(product(q, conjugate)[0])


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def body(v, K):
    """The inverse of how a body follows a force and a torque.  The scene's torques are in body axes."""
    def state(**load):
        run = v.run(moored(**{f"bodies__buoy__{key}": list(map(float, value)) for key, value in load.items()}))
        return run.vectors("buoy")[0], np.array([run[f"buoy.q{c}"][0] for c in "wxyz"])
    _, base = state()
    R = rotation(base)
    columns = []
    for key, size, axes in (("force", 20.0, np.eye(3)), ("torque", 20.0, R.T)):
        for k in range(3):
            (x1, q1), (x0, q0) = state(**{key: size * axes[:, k]}), state(**{key: -size * axes[:, k]})
            columns.append(np.concatenate([x1 - x0, turned_by(q1, base) - turned_by(q0, base)]) / (2 * size))
    report_of(v, "a body", K, np.linalg.inv(np.column_stack(columns)), 3 * TOLERANCE)


def check_differences(v):
    found, _ = matrices(v, moored())
    v.says("rows and columns of a point and of a body", str([found["a"].shape, found["buoy"].shape]), "[(3, 3), (6, 6)]")
    asymmetry = max(np.abs(K - K.T).max() / np.abs(K).max() for K in found.values())
    v.check("in a current it is unsymmetric: 1 over how much", 1e-6 / asymmetry, 1)
    held_point(v, found["a"])
    free_point(v, found["end"])
    body(v, found["buoy"])
    for ranks in (2, 3):
        other, _ = matrices(v, moored(), ranks)
        for name, K in found.items():
            v.check(f"{name} on {ranks} ranks", np.abs(other[name] - K).max() / np.abs(K).max(), 1e-7)


def check_closed_forms(v):
    # A taut bar of two elements between held ends and a mass in its middle: EA/l along, T/l across, each to both sides.
    EA, L, length = 1e5, 2.0, 1.9
    T = EA * (L / length - 1)
    case = still({"mass_per_length": 1e-9, "axial_stiffness": EA}, {"a": fixed(-L, 0, 0), "m": {"position": [0, 0, 0]},
                                                                  "b": fixed(L, 0, 0)},
                 {"one": {"from": "a", "to": "m", "length": length, "elements": 1},
                  "two": {"from": "m", "to": "b", "length": length, "elements": 1}}, ["m"], gravity=0)
    case["output"]["stiffness"] = ["m", "a"]
    found, _ = matrices(v, case)
    expected = np.diag([2 * EA / length, 2 * T / L, 2 * T / L])
    v.check("a mass between two bars", np.abs(found["m"] - expected).max() / expected.max(), 1e-9)
    # Held at a, the two are one bar: half as stiff along; across it turns as a whole about b.
    expected = np.diag([0.5 * EA / length, 0.5 * T / L, 0.5 * T / L])
    v.check("an end of two bars in line", np.abs(found["a"] - expected).max() / expected.max(), 1e-9)
    # A hanging chain, and one that comes down to a bed 60 m below: the slope of the elastic catenary's pull.
    for on_bed, length in ((False, 290), (True, 290)):
        errors = [chain_error(v, on_bed, length, elements) for elements in (100, 200)]
        if on_bed:   # where it comes down it touches node by node, some 1.3 m of 120 m that hang
            v.check("a chain on a bed of 200 elements", errors[1], 0.03)
        else:
            v.at_least("a hanging chain: order", np.log2(errors[0] / errors[1]), 1.9)
            v.check("a hanging chain of 200 elements", errors[1], 1e-3)


def chain_error(v, on_bed, length, elements):
    """Of K in the chain's plane, over its largest value."""
    w, EA, h = 500.0, 1e8, 1e-3
    bed = {"seabed": {"level": 0, "stiffness": 1e9}} if on_bed else {}
    case = still({"mass_per_length": w / 10, "axial_stiffness": EA, "diameter": 0.1, "tension_only": True},
                 {"p": fixed(0, 0, 0), "q": fixed(250, 0, 60)},
                 {"c": {"from": "p", "to": "q", "length": length, "elements": elements, "shape": "catenary"}}, ["q"], 10,
                 environment=bed)
    case["output"]["stiffness"] = ["q"]
    K = matrices(v, case)[0]["q"]

    def pull(x, z):
        cable = Catenary(x, z, length, EA, w, on_bed)
        return np.array([cable.h, cable.v])
    slope = np.column_stack([(pull(250 + h, 60) - pull(250 - h, 60)) / (2 * h),
                             (pull(250, 60 + h) - pull(250, 60 - h)) / (2 * h)])
    v.check(f"a chain of {elements} elements, across: pull over distance", abs(K[1, 1] / pull(250, 60)[0] * 250 - 1), 0.02)
    return np.abs(K[np.ix_([0, 2], [0, 2])] - slope).max() / np.abs(slope).max()


def check_loose(v):
    # Nothing holds the hanging end but the held one: where that goes all goes along, and only its weight resists turning.
    case = still({"mass_per_length": 1, "axial_stiffness": 1e6}, {"a": fixed(0, 0, 0), "m": {"position": [0, 0, -5], "mass": 3}},
                 {"c": {"from": "a", "to": "m", "elements": 5}}, ["a"])
    case["output"]["stiffness"] = ["a", "m"]
    found, said = matrices(v, case)
    v.check("what hangs from one place follows it", np.abs(found["a"]).max(), 1e-6 * 1e6 / 5)
    v.close("notes that there is none", said.count("no stiffness"), 0, 0)
    # A part that lies slack without any pull does not matter.
    case = still({"mass_per_length": 10, "axial_stiffness": 1e7, "diameter": 0.1, "tension_only": True},
                 {"p": fixed(0, 0, 0), "q": fixed(20, 0, 30)},
                 {"c": {"from": "p", "to": "q", "length": 60, "elements": 24, "shape": "catenary"}}, ["q"],
                 environment={"seabed": {"level": 0, "stiffness": 1e6}})
    case["output"]["stiffness"] = ["q"]
    K = matrices(v, case)[0]["q"]
    v.check("an upright chain on a bed bears no push sideways", abs(K[0, 0]) + abs(K[1, 1]), 100)


def main():
    verification = Verification(__doc__)
    check_closed_forms(verification)
    check_differences(verification)
    check_loose(verification)
    verification.finish()


if __name__ == "__main__":
    main()
