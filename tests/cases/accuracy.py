"""Scenes that ask for an accuracy: chosen elements and steps reach it, by runs that are finer; what is said of it."""
import sys

import numpy
import yaml

from bench import Bench, arguments, expect, status

WATER = {"gravity": 9.81, "fluid": {"density": 1025, "surface": 0}}
CHAIN = {"diameter": 0.25, "mass_per_length": 390, "axial_stiffness": 1.0e9, "normal_drag": 1.4,
         "tangential_drag": 0.6, "added_mass": 1.0}
ROPE = {"diameter": 0.02, "density": 1300, "axial_stiffness": 1.0e6, "normal_drag": 1.2, "tangential_drag": 0.01,
        "added_mass": 1.0}
MOORING = {
    "environment": {**WATER, "seabed": {"level": -100, "stiffness": 1.0e5, "damping": 1.0e4}},
    "cable_types": {"chain": CHAIN},
    "points": {"anchor": {"position": [300, 0, -100], "motion": "fixed"},
               "top": {"position": [0, 0, -10],
                       "motion": {"expression": {"x": "sin(0.6*t)*(1-exp(-(t/5)^3))",
                                                 "z": "2*sin(0.6*t)*(1-exp(-(t/5)^3))"}}}},
    "cables": {"line": {"type": "chain", "from": "anchor", "to": "top", "length": 330, "shape": "catenary"}},
    "initial": "static",
    "time": {"end": 30}, "output": {"interval": 0.5, "history": ["top", "line"]}}
TOW = {
    "environment": WATER, "cable_types": {"rope": ROPE},
    "points": {"ship": {"position": [0, 0, -5],
                        "motion": {"waypoints": [[0, 0, 0, -5], [20, 60, 0, -5], [40, 115, 25, -5], [60, 150, 70, -5]]}},
               "tail": {"position": [-300, 0, -5], "mass": 20, "drag_area": 0.2}},
    "cables": {"line": {"type": "rope", "from": "ship", "to": "tail", "length": 300},
               "short": {"type": "rope", "from": {"cable": "line", "at": 200}, "to": "end", "length": 40}},
    "time": {"end": 60}, "output": {"interval": 2, "history": ["tail", "line"]}}
TOW["points"]["end"] = {"position": [-240, 0, -5], "mass": 5}
FALL = {
    "environment": {"gravity": 9.81}, "cable_types": {"rope": {"mass_per_length": 0.5, "axial_stiffness": 1.0e4}},
    "points": {"pin": {"position": [0, 0, 0], "motion": "fixed"}, "end": {"position": [2, 0, 0], "mass": 1}},
    "cables": {"line": {"type": "rope", "from": "pin", "to": "end"}},
    "time": {"end": 1}, "output": {"history": ["end"]}}
HANGING = {
    "environment": {"gravity": 9.81}, "cable_types": {"rope": {"mass_per_length": 2, "axial_stiffness": 1.0e5}},
    "points": {"a": {"position": [0, 0, 0], "motion": "fixed"}, "b": {"position": [10, 0, 3], "motion": "fixed"}},
    "cables": {"line": {"type": "rope", "from": "a", "to": "b", "length": 14, "shape": "catenary"}},
    "output": {"history": ["line"]}}
# A sudden start leaves the chain swinging along itself, which coarse steps do not show.
SUDDEN = {**MOORING, "time": {"end": 10}}
SUDDEN["points"] = {**MOORING["points"], "top": {"position": [0, 0, -10],
                                                 "motion": {"harmonic": {"amplitude": [1, 0, 2], "period": 10}}}}
SCENES = {"mooring": MOORING, "tow": TOW, "fall": FALL, "hanging": HANGING, "sudden": SUDDEN}


def write(bench, name, scene):
    (bench.folder / name).write_text(yaml.safe_dump(scene), encoding="utf-8")
    return name


def told(bench, run):
    """What run.yaml says of the accuracy."""
    return yaml.safe_load(bench.report(run))["accuracy"]


def history(bench, run):
    rows = bench.rows(run)
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def error(coarse, fine):
    """The largest error of a column that is no acceleration, in root mean squares over its range or a tenth of its vector's."""
    if len(fine["time"]) == 1:
        return max(abs(coarse[name][0] / fine[name][0] - 1) for name in fine if "tension" in name)
    worst = 0.0
    for name, values in fine.items():
        stem, ending = name.rpartition(".")[::2]
        if name == "time" or ending in ("ax", "ay", "az"):
            continue
        vector = [stem + "." + ending[:-1] + axis for axis in "xyz"] if ending[-1:] in "xyz" else [name]
        share = 1.0 if ending[0] == "f" else 0.1
        scale = max(numpy.ptp(values), share * max(numpy.ptp(fine[part]) for part in vector))
        if scale > 0:
            worst = max(worst, numpy.sqrt(numpy.mean((coarse[name] - values)[1:] ** 2)) / scale)
    return worst


def finer(scene, found, factor):
    """The scene with sizes that are so many times finer than those that were found."""
    scene = yaml.safe_load(yaml.safe_dump(scene))
    for name, number in found["elements"].items():
        scene["cables"][name]["elements"] = factor * number
    if "time" in scene:
        words = found["steps"].split()
        scene["time"]["step"] = 0.002 if "adaptive" in words else float(words[2]) / factor
    return scene


def reaches(bench, name, accuracy):
    scene = {**SCENES[name], "accuracy": accuracy}
    done = bench("run", write(bench, f"{name}.yaml", scene), "-o", name)
    expect(done.returncode == 0, f"{name}: status {done.returncode}: {done.stderr}")
    found = told(bench, name)
    done = bench("run", write(bench, f"{name}_fine.yaml", finer(SCENES[name], found, 4)), "-o", f"{name}_fine")
    expect(done.returncode == 0, f"{name}, finer: status {done.returncode}: {done.stderr}")
    off = error(history(bench, name), history(bench, f"{name}_fine"))
    expect(off <= 2 * accuracy, f"{name}: {found}: off by {off:.5f}, wanted {accuracy}")
    expect(0.2 * off <= float(found["estimated"]) <= 1.5 * accuracy, f"{name}: estimated {found['estimated']}, really {off:.5f}")


def same_on_ranks(bench, name):
    alone = history(bench, name)
    for ranks in (2, 3):
        done = bench("run", f"{name}.yaml", "-o", f"{name}_{ranks}", ranks=ranks)
        expect(done.returncode == 0, f"{name} on {ranks} ranks: status {done.returncode}: {done.stderr}")
        same = [told(bench, run)[key] for run in (name, f"{name}_{ranks}") for key in ("elements", "steps")]
        expect(same[:2] == same[2:], f"{name} on {ranks} ranks: {same[2:]}, and {same[:2]} on one")
        off = error(history(bench, f"{name}_{ranks}"), alone)
        expect(off <= 1e-6, f"{name} on {ranks} ranks: off by {off:.2g}")


def refused(bench, scene, texts, *options):
    done = bench("run", write(bench, "refused.yaml", scene), "-o", "refused", *options)
    expect(done.returncode == 2 and all(text in done.stderr for text in texts), f"refused: {done.returncode} {done.stderr}")
    expect(not (bench.folder / "refused").exists(), "nothing is written")


def main():
    given = arguments(__doc__)
    bench = Bench(given.program, given.scratch, timeout=120)
    for name in ("mooring", "tow", "fall", "hanging"):
        reaches(bench, name, 0.01)
    reaches(bench, "fall", 0.001)
    same_on_ranks(bench, "fall")
    same_on_ranks(bench, "tow")

    done = bench("check", write(bench, "open.yaml", {**TOW, "accuracy": 0.01}))
    expect(done.returncode == 0 and "accuracy" in done.stdout, f"check: {done.returncode} {done.stdout} {done.stderr}")
    done = bench("chart", "open.yaml")
    expect(done.returncode == 2 and "run.yaml" in done.stderr, f"chart: {done.returncode} {done.stderr}")
    refused(bench, FALL, ["time.step: is missing", "accuracy"])
    refused(bench, {**FALL, "time": {"end": 1, "step": 0.01}}, ["elements: is missing", "accuracy"])
    refused(bench, {**FALL, "accuracy": 2}, ["accuracy: 2", "0.0001..0.1"])
    for scene in (FALL, {**FALL, "time": {"end": 1, "step": 0.01}}):
        refused(bench, {**scene, "accuracy": 0.01}, ["-ts_dt", "time.step"], "-ts_dt", "0.02")

    done = bench("run", write(bench, "sudden.yaml", {**SUDDEN, "accuracy": 0.01}), "-o", "sudden")
    found = told(bench, "sudden")
    bench("run", write(bench, "sudden_fine.yaml", finer(SUDDEN, found, 2)), "-o", "sudden_fine")
    off = error(history(bench, "sudden"), history(bench, "sudden_fine"))
    estimated = float(found["estimated"])
    expect(estimated >= 0.2 * off, f"a sudden start: estimated {estimated}, really {off:.5f}")
    expect((estimated > 0.015) == ("is not reached" in done.stderr), f"a sudden start: {estimated}: {done.stderr}")

    # Nets have their own meshes, and a cable on one no length that is known before it is laid.
    net = {"type": "rope", "corners": [[0, 0, 0], [4, 0, 0], [4, 0, -3], [0, 0, -3]], "meshes": [4, 3], "fixed": ["top"]}
    scene = {**FALL, "nets": {"net": net}, "accuracy": 0.02, "time": {"end": 0.5}}
    scene["cables"] = {"line": {"type": "rope", "from": {"net": "net", "node": [2, 3]}, "to": "end"}}
    scene["points"] = {"end": {"position": [2, 1, -4], "mass": 1}}
    done = bench("run", write(bench, "net.yaml", scene), "-o", "net")
    expect(done.returncode == 0 and "what nets err by is not in it" in done.stdout, f"net: {done.stdout} {done.stderr}")
    expect(told(bench, "net")["elements"]["line"] >= 4, f"net: {told(bench, 'net')}")
    del scene["cables"], scene["points"], scene["output"]
    done = bench("run", write(bench, "alone.yaml", scene), "-o", "alone")
    expect(done.returncode == 0 and "energy" in told(bench, "alone")["worst_quantity"], f"a net alone: {done.stdout} {done.stderr}")
    drifting = {**FALL, "initial": "static", "accuracy": 0.01, "environment": {"gravity": 0},
                "points": {"pin": {"position": [0, 0, 0], "mass": 1, "force": [1, 0, 0]}, "end": {"position": [2, 0, 0], "mass": 1}}}
    done = bench("run", write(bench, "drifting.yaml", drifting), "-o", "drifting")
    expect(done.returncode == 3 and "no equilibrium" in done.stderr, f"no equilibrium: {done.returncode} {done.stderr}")
    expect(done.stdout.count("looked at") <= 8, f"no equilibrium: {done.stdout}")

    # What is given is kept, and what it errs by is said.
    coarse = finer(FALL, {"elements": {"line": 4}, "steps": "steps of 0.04 s"}, 1)
    done = bench("run", write(bench, "coarse.yaml", {**coarse, "accuracy": 0.001}), "-o", "coarse")
    note = "the accuracy of 0.1 % is not reached"
    expect(done.returncode == 0 and note in done.stderr, f"given sizes: {done.returncode} {done.stderr}")
    off = error(history(bench, "coarse"), history(bench, "fall_fine"))
    estimated = float(told(bench, "coarse")["estimated"])
    expect(0.3 * off <= estimated <= 3 * off, f"given sizes: estimated {estimated}, really {off:.5f}")
    done = bench("run", write(bench, "half.yaml", {**TOW, "time": {"end": 60, "step": 0.5}, "accuracy": 0.01}), "-o", "half")
    expect(done.returncode == 0 and "as time.step is given" in done.stdout, f"a step is given: {done.stdout} {done.stderr}")
    return status()


if __name__ == "__main__":
    sys.exit(main())
