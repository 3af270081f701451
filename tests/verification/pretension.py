"""Lengths that are found by tensions: closed forms, the tension asked for in the history, the same equilibrium with the
lengths given, several at once, nets, and what cannot be found."""
import re

import numpy as np

from statics_support import Catenary, fixed, still
from support import Verification

TOLERANCE = 1e-8


def found_of(run, name, key="length_m"):
    return float(re.search(rf"^  {name}: {{{key}: ([^,]+),", run.report, re.MULTILINE)[1])


def tensioned(v, name, scene, *asked):
    """@param asked  (cable, tension)   @return the run, whose history has the tensions"""
    run = v.run(scene)
    for cable, tension in asked:
        v.close(f"{name}: tension of {cable} [N]", run[f"{cable}.tension_from"][0], tension, TOLERANCE * tension)
    return run


def line(tension, elements=40, w=50.0, EA=1e6, to=(100, 0, 20), bed=None, **keys):
    environment = {"seabed": {"level": bed, "stiffness": 1e8}} if bed is not None else {}
    return still({"mass_per_length": w / 10, "axial_stiffness": EA, "diameter": 0.05, "tension_only": True},
                 {"a": fixed(0, 0, 0), "b": fixed(*to)},
                 {"c": {"from": "b", "to": "a", "tension": tension, "elements": elements, **keys}}, ["c", "a"], 10,
                 environment=environment)


def check_lines(v):
    case = still({"mass_per_length": 1e-6, "axial_stiffness": 5e4}, {"a": fixed(0, 0, 0), "b": fixed(3, 4, 0)},
                 {"c": {"from": "a", "to": "b", "tension": 700.0, "elements": 7}}, ["c"], 0)
    run = tensioned(v, "without weight", case, ("c", 700))
    v.close("without weight: length [m]", found_of(run, "c"), 5 / (1 + 700 / 5e4), 1e-9)
    # From hardly sagging to as slack as can be, each from shapes drawn straight and as a catenary.
    for tension in (1e6, 2e4, 6e3, 4.4e3):
        lengths, misses = [], []
        for elements in (40, 80):
            for shape in ("straight", "catenary"):
                run = tensioned(v, f"{tension} N, {elements} elements, {shape}", line(tension, elements, shape=shape), ("c", tension))
                lengths.append(found_of(run, "c"))
            exact = Catenary(100, 20, lengths[-1], 1e6, 50)
            misses.append(abs(np.hypot(exact.h, exact.v) / tension - 1))
        v.check(f"{tension} N: lengths apart by the drawn shape", abs(lengths[0] / lengths[1] - 1) + abs(lengths[2] / lengths[3] - 1), 1e-8)
        v.check(f"{tension} N: off the elastic catenary, 80 elements", misses[1], 2e-3)
        v.check(f"{tension} N: with twice the elements a quarter of that", misses[1], 0.35 * misses[0] + 1e-7)
    # With touchdown, from the fairlead and from the anchor.
    for tension in (4e3, 1.6e3):
        run = tensioned(v, f"on a bed, {tension} N", line(tension, 100, to=(100, 0, 30), bed=0), ("c", tension))
        exact = Catenary(100, 30, found_of(run, "c"), 1e6, 50, True)
        v.close(f"on a bed, {tension} N: the catenary's pull [N]", np.hypot(exact.h, exact.v), tension, 5e-3 * tension)


def check_given(v):
    """The lengths found, given: the same equilibrium."""
    case = line(6e3)
    run = tensioned(v, "a line", case, ("c", 6e3))
    del case["cables"]["c"]["tension"]
    case["cables"]["c"]["length"] = found_of(run, "c")
    again = v.run(case)
    for column in ("c.tension_from", "c.tension_to", "a.fx", "a.fz"):
        v.close(f"with the length given: {column} [N]", again[column][0], run[column][0], 1e-7 * 6e3)


def moorings(tensions, **keys):
    """A buoy on three chains."""
    case = still({"diameter": 0.1, "mass_per_length": 40, "axial_stiffness": 5e7, "tension_only": True, "normal_drag": 1.2},
                 {"buoy": {"position": [0, 0, -2], "mass": 500, "volume": 8},
                  **{f"p{k}": fixed(180 * np.cos(2.1 * k), 180 * np.sin(2.1 * k), -60) for k in range(3)}},
                 {f"c{k}": {"from": "buoy", "to": f"p{k}", "tension": float(T), "elements": 30, "shape": "catenary"}
                  for k, T in enumerate(tensions)}, ["buoy", "c0", "c1", "c2"],
                 environment={"fluid": {"density": 1025, "surface": 0, "current": {"velocity": [0.3, 0, 0]}},
                              "seabed": {"level": -60, "stiffness": 1e6}})
    case.update(keys)
    return case


def check_several(v):
    for tensions in ((4e4, 4e4, 4.3e4), (6e4, 5e4, 5.5e4)):
        asked = [(f"c{k}", T) for k, T in enumerate(tensions)]
        first = tensioned(v, f"three chains, {tensions}", moorings(tensions), *asked)
        for v.ranks in (2, 3):
            run = tensioned(v, f"three chains on {v.ranks} ranks", moorings(tensions), *asked)
            for k in range(3):
                v.close(f"length of c{k} on {v.ranks} ranks [m]", found_of(run, f"c{k}"), found_of(first, f"c{k}"), 1e-6)
        v.ranks = None
    # Two in line: only their sum is known, and each is changed alike.
    case = still({"mass_per_length": 1e-6, "axial_stiffness": 1e4}, {"a": fixed(0, 0, 0), "m": {"position": [4, 0, 0]}, "b": fixed(10, 0, 0)},
                 {"one": {"from": "a", "to": "m", "tension": 300.0, "elements": 4},
                  "two": {"from": "m", "to": "b", "tension": 300.0, "elements": 4}}, ["one", "two"], 0)
    run = tensioned(v, "two in line", case, ("one", 300), ("two", 300))
    v.close("two in line: length of both [m]", found_of(run, "one") + found_of(run, "two"), 10 / 1.03, 1e-8)
    # A run goes on from the equilibrium.
    case = moorings((4e4, 4e4, 4.3e4), initial="static", time={"end": 2, "step": 0.05})
    run = v.run(case)
    for k, T in enumerate((4e4, 4e4, 4.3e4)):
        v.check(f"in a run c{k} keeps its tension", np.abs(run[f"c{k}.tension_from"] / T - 1).max(), 1e-6)


def net(fixed_edges, gravity, **keys):
    return {"environment": {"gravity": gravity}, "cable_types": {"twine": {"mass_per_length": 0.1, "axial_stiffness": 1e4}},
            "points": {"p": fixed(3, 1, 0), "q": {"position": [1.5, 1, 0], "mass": 1}},
            "cables": {"load": {"type": "twine", "from": "p", "to": "q", "elements": 2}},
            "nets": {"net": {"type": "twine", "corners": [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]], "meshes": [6, 4],
                             "fixed": fixed_edges, **keys}},
            "output": {"history": ["load"]}}


def check_nets(v):
    run = v.run(net(["top", "right", "bottom", "left"], 0, prestress=250.0))
    v.close("a net in its frame: slack", found_of(run, "net", "slack"), 1 / 1.025, 1e-9)
    run = v.run(net(["top", "right", "bottom", "left"], 10, prestress=40.0))
    slack = found_of(run, "net", "slack")
    v.check("a net that sags is longer: slack", slack, 1)
    v.check("a net that sags is shorter than drawn by its stretch at most", 1 / 1.004 - slack, 1 / 1.004)
    v.says("it is told", v.attempt(net(["top", "left", "right", "bottom"], 10, prestress=40.0))[1].stdout, "net net: slack", "for a mean tension of 40 N")


def check_impossible(v):
    for name, case, words in (
            # The least tension at b is some 0.83 of the weight of a cable as long as the way.
            ("too slack", line(1e3), ["cable c", "in place of 1000 N", "length"]),
            ("by its weight", still({"mass_per_length": 1, "axial_stiffness": 1e6},
                                    {"a": fixed(0, 0, 0), "m": {"position": [0, 0, -5], "mass": 3}},
                                    {"c": {"from": "m", "to": "a", "tension": 200.0, "elements": 5}}, ["c"]),
             ["cable c", "in place of 200 N"])):
        run, done = v.attempt(case)
        v.close(f"{name}: exit status", done.returncode, 3, 0)
        v.says(name, done.stderr, "no unstretched lengths were found", "or give length", *words)
        if name != "too slack":
            continue
        told = re.search(r"has (\S+) N at its start .*that is about the least it can have", done.stderr)
        pulls = [np.hypot(c.h, c.v) for c in (Catenary(100, 20, length, 1e6, 50) for length in np.linspace(110, 150, 401))]
        v.close("the least tension that is told, over that of catenaries", told and float(told[1]) / min(pulls), 1, 3e-3)


def main():
    verification = Verification(__doc__)
    for check in (check_lines, check_given, check_several, check_nets, check_impossible):
        check(verification)
    verification.finish()


if __name__ == "__main__":
    main()
