"""Runs today's program on the stored scenes, and takes its errors and costs as the stored ones were taken."""
import csv
import os
import pathlib
import subprocess
import tempfile

import numpy as np
import yaml

import costs

SCENES = pathlib.Path(__file__).resolve().parent / "scenes"
REPETITIONS = 3
# The two meshes and the step that a limit is extrapolated from, and the time from which errors count [s].
LIMITS = {"free_fall": ((192, 384), 2e-4, 0.5), "tow_turn": ((500, 1000), 0.2, 0), "chain": ((152, 304), 0.02, 30),
          "buoy": ((100, 200), 0.05, 30)}
COLUMNS = {"free end": ("free.x", "free.z"), "tail": ("tail.x", "tail.y", "tail.z"), "tow force": ("c.tension_from",),
           "fairlead tension": ("c.tension_to",), "body": ("buoy.x", "buoy.y", "buoy.z"), "line tension": ("c0.tension_to",)}
LENGTHS = {"free end": 1.713, "tail": 1000}


def pace(yardstick):
    """The hand-written chain's CPU time of a step of 24 elements [us]."""
    def once():
        said = subprocess.run([yardstick, "24", "1e-4", "5000"], capture_output=True, text=True, check=True).stdout
        return float(dict(pair.split("=") for pair in said.split())["us_per_step"])
    return min(once() for _ in range(REPETITIONS))


def run(program, case, scheme, elements, step):
    """The history as {column: values}, and the CPU time of the stepping and of the whole process [s]."""
    scene = yaml.safe_load((SCENES / f"{case}.yaml").read_text(encoding="utf-8"))
    for cable in scene["cables"].values():
        cable["elements"] = elements
    scene["time"].update({"adaptive": {"tolerance": step}} if "adaptive" in scheme else {"step": step})
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "scene.yaml").write_text(yaml.safe_dump(scene), encoding="utf-8")
        before = os.times()
        subprocess.run([program.resolve(), "run", "scene.yaml", "-o", "results"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = os.times()
        report = yaml.safe_load((folder / "results" / "run.yaml").read_text(encoding="utf-8"))
        with open(folder / "results" / "history.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
    whole = after.children_user + after.children_system - before.children_user - before.children_system
    return ({key: np.array([float(row[key]) for row in rows]) for key in rows[0]}, report["cpu_seconds"]["solve"], whole)


def values(history, case, measure):
    late = history["time"] >= LIMITS[case][2] - 1e-9
    return np.array([history[column][late] for column in COLUMNS[measure]])


def limit(program, case, measures):
    """What meshes converge to, by their order of two."""
    meshes, step, _ = LIMITS[case]
    coarse, fine = (run(program, case, "default", elements, step)[0] for elements in meshes)
    return {measure: (4 * values(fine, case, measure) - values(coarse, case, measure)) / 3 for measure in measures}


def error(found, exact, measure):
    off = np.sqrt(np.mean(np.sum((found - exact) ** 2, axis=0)))
    if measure in LENGTHS:
        return off / LENGTHS[measure]
    if measure == "tow force":
        return off / np.mean(exact)
    return off / np.sqrt(np.sum(np.ptp(exact, axis=1) ** 2))


def runs(program, stored):
    """The cheapest settings of the stored runs with the default scheme, run anew."""
    found = []
    for case in costs.CASES:
        measures = [measure for key, measure in costs.measures(stored) if key == case]
        settings = {(run.scheme, run.elements, run.step) for measure in measures for cost in ("cpu_stepping", "cpu_whole")
                    for run in costs.front([run for run in costs.select(stored, case, measure, costs.OURS)
                                            if run.scheme in ("default", "default adaptive")], cost)}
        exact = limit(program, case, measures)
        for setting in sorted(settings):
            tries = [run(program, case, *setting) for _ in range(REPETITIONS)]
            history = tries[0][0]
            found += [costs.Cost(case, measure, costs.OURS, *setting, error(values(history, case, measure), exact[measure],
                                 measure), min(one[1] for one in tries), min(one[2] for one in tries)) for measure in measures]
    return found
