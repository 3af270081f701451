"""Which equilibrium statics takes where there are several, what it says of one that would not last, how it gets there,
and how closely."""
import numpy as np

from statics_support import at_rest, fixed, report_number, still
from support import Verification

GRAVITY = 10
BAR = {"mass_per_length": 0.1, "axial_stiffness": 1000}
NOTE = "the equilibrium is not stable"


def solve(v, name, scene, noted):
    """@param noted  whether the note on instability is due"""
    run, done = v.attempt(scene)
    v.close(f"{name}: exit status", done.returncode, 0, 0)
    v.close(f"{name}: notes that it is not stable", done.stderr.count(NOTE), int(noted), 0)
    return run


def mast(height, sideways=0.0):
    """A mass on a bar that would hang at -1.01 m and stands, exactly, at 0.99 m."""
    top = {"position": [sideways, 0, height], "mass": 0.95}
    return still(BAR, {"pin": fixed(0, 0, 0), "top": top},
                 {"bar": {"from": "pin", "to": "top", "elements": 1, "length": 1}}, ["top"], GRAVITY)


def tripod(height):
    """A mass on three legs of 1.25 m that stand 1 m from the middle."""
    feet = {f"foot{i}": fixed(np.cos(angle), np.sin(angle), 0)
            for i, angle in enumerate(2 * np.pi / 3 * np.arange(3))}
    legs = {f"leg{i}": {"from": foot, "to": "top", "elements": 1, "length": 1.25} for i, foot in enumerate(feet)}
    return still({"mass_per_length": 0.01, "axial_stiffness": 1e5},
                 {**feet, "top": {"position": [0, 0, height], "mass": 2}}, legs, ["top"], GRAVITY)


def hung(ropes, body, attachments, keys):
    """A body on ropes from points to attachments: [(point, length, elements)]."""
    points = {f"p{i}": fixed(*place) for i, (place, _, _) in enumerate(ropes)}
    cables = {f"rope{i}": {"from": f"p{i}", "to": f"body.a{i}", "length": length, "elements": n}
              for i, (_, length, n) in enumerate(ropes)}
    body = {**body, "attachments": {f"a{i}": list(place) for i, place in enumerate(attachments)}}
    return still(keys, points, cables, ["body"], GRAVITY, bodies={"body": body})


def standing(v):
    """What stands as drawn is taken, with a note where it would topple; what does not stand hangs."""
    run = solve(v, "mast drawn as it stands", mast(0.99), noted=True)
    v.close("mast drawn as it stands: height [m]", at_rest(run, "top")[2], 0.99, 1e-12)
    for name, scene in {"too long": mast(0.99001), "leaning": mast(0.9, 0.3), "hanging": mast(-1)}.items():
        run = solve(v, f"mast drawn {name}", scene, noted=False)
        v.check(f"mast drawn {name}: off where it hangs [m]",
                np.abs(at_rest(run, "top") - [0, 0, -1.01]).max(), 1e-10)
    # The legs' stiffness and their weight move the top by 2.3e-4 m.
    for name, height, end in (("as it stands", 0.7498, 0.75), ("too low", 0.6, -0.75), ("hanging", -0.7, -0.75)):
        run = solve(v, f"tripod drawn {name}", tripod(height), noted=False)
        v.close(f"tripod drawn {name}: height [m]", at_rest(run, "top")[2], end, 3e-4)


def upside_down(v):
    """A body on two ropes, drawn over them: it comes to hang below, even where nothing tells it on which side."""
    body = {"mass": 2, "inertia": [0.1, 0.1, 0.1]}
    ropes = [((-0.3, 0, 0), 1, 2), ((0.3, 0, 0), 1, 2)]
    low = -(1 + (10.75 + 10.25) / 2 / BAR["axial_stiffness"]) - 0.3
    for roll in (180, 160):
        drawn = {**body, "position": [0.05, 0, -0.5], "orientation": {"roll": roll}}
        run = solve(v, f"body drawn with a roll of {roll}", hung(ropes, drawn, [(-0.3, 0, 0.3), (0.3, 0, 0.3)], BAR),
                    noted=False)
        v.check(f"body drawn with a roll of {roll}: off where it hangs [m]",
                np.abs(at_rest(run, "body") - [0, 0, low]).max(), 1e-8)


def free_to_turn(v):
    """A body on one rope turns freely about it: the tangent is singular, and a shift leads past that."""
    body = {"mass": 2, "inertia": [0.1, 0.1, 0.1], "position": [0.05, 0, -0.5], "orientation": {"roll": 175, "pitch": 3}}
    run = solve(v, "body on one rope", hung([((0, 0, 0), 1, 3)], body, [(-0.3, 0, 0.3)], BAR), noted=False)
    v.check("body on one rope: off where it hangs, across [m]", np.abs(at_rest(run, "body")[:2]).max(), 1e-6)


ATTITUDES = np.random.default_rng(5).normal(size=(8, 4))


def turned(v):
    """From any attitude a body on three ropes comes to one and the same, without detours."""
    angles = 0.3 + 2 * np.pi / 3 * np.arange(3)
    ropes = [((np.cos(a), np.sin(a), 0), length, 4) for a, length in zip(angles, (1.5, 2, 2))]
    attachments = [(0.4 * np.cos(a), 0.4 * np.sin(a), 0.2) for a in angles]
    keys = {"mass_per_length": 0.1, "axial_stiffness": 1e4}
    found, iterations = [], []
    for quaternion in ([1, 0, 0, 0], *ATTITUDES.tolist()):
        body = {"mass": 5, "inertia": [1, 1, 1], "position": [0.5, -0.4, -1], "orientation": {"quaternion": quaternion}}
        run = solve(v, f"body drawn at {np.round(quaternion, 2)}", hung(ropes, body, attachments, keys), noted=False)
        found.append(at_rest(run, "body"))
        iterations.append(report_number(run, "statics", "iterations"))
    print(f"        body drawn in nine attitudes: iterations {iterations}")
    v.check("body drawn in nine attitudes: places apart [m]", np.ptp(found, axis=0).max(), 1e-7)
    v.check("body drawn in nine attitudes: iterations, mean", np.mean(iterations), 50)


def closely(v):
    """What is left is 1e-12 of the loads, or rounding's share."""
    eps, n, stiffness = np.finfo(float).eps, 10, 1e3
    for mass in (1, 2, 3, 5, 7, 10, 20, 50):
        points = {"a": fixed(0, 0, 0), "b": fixed(8, 0, 1), "m": {"position": [3, 1, 0], "mass": mass}}
        cables = {"left": {"from": "a", "to": "m", "length": 5, "elements": n},
                  "right": {"from": "m", "to": "b", "length": 6, "elements": n}}
        run = v.run(still({"mass_per_length": 0.5, "axial_stiffness": stiffness}, points, cables, ["m"], GRAVITY))
        loads = np.full(2 * n - 1, 0.5 * 11 / (2 * n) * GRAVITY)
        loads[n - 1] += mass * GRAVITY
        # 16 times rounding of positions of 8 m in the tension of elements of 0.5 m, root-sum-squares over all.
        rounding = 16 * eps * 8 * 2 * stiffness / 0.5 * np.sqrt(2 * n)
        bound = max(1e-12 * np.linalg.norm(loads), rounding) / loads.max()
        found = report_number(run, "statics", "largest_unbalanced_force_over_load")
        v.check(f"mass of {mass} kg: unbalanced force over the largest load", found, bound)


def main():
    verification = Verification(__doc__)
    for check in (standing, upside_down, free_to_turn, turned, closely):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
