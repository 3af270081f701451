"""Scenes that once had no equilibrium, or a wrong one: each now has the right one, on any number of ranks."""
import pathlib

import numpy as np

from slack_moorings import Chain
from statics_support import at_rest, report_number
from support import Verification

SCENES = pathlib.Path(__file__).resolve().parent.parent / "cases" / "scenes" / "at_rest"
UNSTABLE, PUSHES = "is not stable", "some cables push"


def solve(v, name, text=None, notes=(), ranks=(None,)):
    """Every rank count must find it, without other notes than these.  @return the last run"""
    for v.ranks in ranks:
        run, done = v.attempt(text if text is not None else (SCENES / f"{name}.yaml").read_text())
        label = name if v.ranks is None else f"{name}, {v.ranks} ranks"
        v.close(f"{label}: exit status", done.returncode, 0, 0)
        if done.returncode:
            print(done.stderr)
        for note in (UNSTABLE, PUSHES):
            v.close(f"{label}: notes that it {note}", done.stderr.count(note), int(note in notes), 0)
        if "rounding's share" not in done.stdout:
            v.check(f"{label}: unbalanced force over the largest load",
                    report_number(run, "statics", "largest_unbalanced_force_over_load"), 1e-9)
    v.ranks = None
    return run


def chains(v):
    """On the bed and under a buoy, in a current too."""
    text = (SCENES / "slack_chain_on_bed.yaml").read_text()
    run = solve(v, "slack_chain_on_bed", text.replace("friction: 0.5", "friction: 0"), ranks=(1, 2, 3))
    lack = Chain(148.5, 57.5, 200, 60, 3e6, (48 - 1025 * np.pi * 0.05**2 / 4) * 9.81).solve()
    for end, column in ((0, "line1.tension_from"), (-1, "line1.tension_to")):
        pull = np.linalg.norm(lack[end])
        v.close(f"slack_chain_on_bed: {column} [N]", abs(run[column][0]), pull, 1e-5 * pull)
    rough = solve(v, "slack_chain_on_bed", ranks=(1, 2, 3))
    # Friction can hold ten times the pull at touchdown.  The anchor then bears half an element that hangs on it.
    weight = (48 - 1025 * np.pi * 0.05**2 / 4) * 9.81 * 200 / 60 / 2
    v.check("slack_chain_on_bed, friction: horizontal pull at the anchor [N]",
            max(rough["line1.tension_from"][0]**2 - weight**2, 0)**0.5, 100)
    pull = run["line1.tension_to"][0]
    v.close("slack_chain_on_bed, friction: pull at the fairlead [N]", rough["line1.tension_to"][0], pull, 1e-3 * pull)
    solve(v, "buoy_three_slack_chains")
    solve(v, "one_line_too_long")
    text = (SCENES / "one_line_too_long.yaml").read_text()
    run = solve(v, "one_line_too_long", text.replace("friction: 0.5", "friction: 0"))
    # The two lines of 165 m are 140 m and more from their anchors, and leave the buoy no other place.
    v.close("one_line_too_long: place of the buoy [m]", at_rest(run, "buoy")[0], -59.2, 0.5)


def drag(v):
    """Damping changes no equilibrium, and a far start none either."""
    text = (SCENES / "mussel_regular.yaml").read_text()
    undamped = text.replace("axial_damping: 5e3, ", "").replace("axial_damping: 500, ", "")
    damped, free = (solve(v, f"mussel_regular, {name}", scene) for name, scene in (("damped", text),
                                                                                  ("undamped", undamped)))
    v.check("mussel_regular: iterations", report_number(damped, "statics", "iterations"), 100)
    pulls = [[run[c][0] for c in run.columns if ".tension_" in c] for run in (damped, free)]
    v.check("mussel_regular: pulls apart by damping, over the largest", np.ptp(pulls, axis=0).max() / np.max(pulls), 1e-9)
    solve(v, "static_start_far_off")


def bodies(v):
    """They hang below what holds them, whatever was drawn."""
    for name, body, low in (("inverted_body_air", "b", -3.3), ("unstable_body_upright", "fish", -3.0),
                            ("body_two_ropes_one_unstable_direction", "b", -3.3)):
        run = solve(v, name)
        v.close(f"{name}: height [m]", at_rest(run, body)[2], low, 0.01)
        w, x, y, z = (run[f"{body}.q{axis}"][0] for axis in "wxyz")
        v.close(f"{name}: cosine between its axis and the vertical", 1 - 2 * (x * x + y * y), -1, 1e-9)


def bars(v):
    """A tripod hangs wherever it is, and a bar without loads is unstressed."""
    heights = [at_rest(solve(v, name), "apex")[2] for name in ("tripod_at_origin", "tripod_500_km_away")]
    v.close("tripod at the origin: height [m]", heights[0], -3.17458318, 1e-7)
    v.close("tripod 500 km away: height [m]", heights[1], heights[0], 1e-8)
    run = solve(v, "zero_g_slack_bar")
    v.check("zero_g_slack_bar: force over EA", abs(run["c1.tension_from"][0]) / 1e5, 1e-9)


def net(v):
    run = solve(v, "net_statics_100x50")
    v.close("net of 100 x 50 meshes: least energy [J]", run["energy.strain"][0] + run["energy.gravity"][0], -343.3956,
            1e-4)
    v.check("net of 100 x 50 meshes: iterations", report_number(run, "statics", "iterations"), 180)


def loop(v):
    """Two slack ropes of 1000 elements between two pins 2 m apart; each hangs as it would alone."""
    def rope(length, side):
        k = np.linspace(0, 1, 1001)
        shape = np.column_stack([2 * k, side * np.sin(np.pi * k), 0 * k]).tolist()
        return {"type": "rope", "from": "a", "to": "c", "length": length, "elements": 1000, "shape": shape}
    both = {"one": rope(3, 0.5), "other": rope(4, -0.8)}
    pulls = {}
    for cables in (both, {"one": both["one"]}, {"other": both["other"]}):
        scene = {"environment": {"gravity": 9.81},
                 "cable_types": {"rope": {"mass_per_length": 1, "axial_stiffness": 1e5, "tension_only": True}},
                 "points": {"a": {"position": [0, 0, 0], "motion": "fixed"},
                            "c": {"position": [2, 0, 0], "motion": "fixed"}},
                 "cables": cables, "output": {"history": list(cables)}}
        run = solve(v, f"loop of {len(cables)}", scene)
        v.check(f"loop of {len(cables)}: iterations", report_number(run, "statics", "iterations"), 100)
        for name in cables:
            pulls.setdefault(name, []).append(run[f"{name}.tension_from"][0])
    for name, (together, alone) in pulls.items():
        v.close(f"loop, {name}: pull [N]", together, alone, 1e-5 * alone)


def touchdown(v):
    """What lies on the bed over less than an element is told."""
    text = (SCENES / "slack_chain_on_bed.yaml").read_text()
    for length, elements, told in ((162, 10, 1), (200, 60, 0), (160, 10, 0)):
        scene = text.replace("length: 200, elements: 60", f"length: {length}, elements: {elements}")
        _, done = v.attempt(scene)
        v.close(f"line of {length} m, {elements} elements: notes that less than an element lies on the bed",
                done.stderr.count("shorter than an element is what lies on the bed of: line1"), told, 0)


def limited(v):
    """The time limit ends the search with exit status 3."""
    _, done = v.attempt((SCENES / "net_statics_100x50.yaml").read_text(), "-cable_statics_time_limit", "0.01")
    v.close("time limit: exit status", done.returncode, 3, 0)
    v.says("time limit", done.stderr, "the time limit of 0.01 s is over")
    _, done = v.attempt((SCENES / "tripod_at_origin.yaml").read_text(), "-cable_statics_monitor")
    v.says("monitor", done.stdout, "statics 0, exact: residual")


def main():
    verification = Verification(__doc__)
    for check in (chains, drag, bodies, bars, net, loop, touchdown, limited):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
