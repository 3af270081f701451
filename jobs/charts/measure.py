"""Runs today's program with settings of stored runs, and takes its costs as theirs were taken."""
import os
import pathlib
import subprocess
import tempfile
from dataclasses import replace

import yaml

import costs

SCENES = pathlib.Path(__file__).resolve().parent / "scenes"
REPETITIONS = 3


def pace(yardstick):
    """The hand-written chain's CPU time of a step of 24 elements [us]."""
    def once():
        said = subprocess.run([yardstick, "24", "1e-4", "5000"], capture_output=True, text=True, check=True).stdout
        return float(dict(pair.split("=") for pair in said.split())["us_per_step"])
    return min(once() for _ in range(REPETITIONS))


def run(program, case, scheme, elements, step):
    """The CPU time of the stepping and of the whole process [s]."""
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
    whole = after.children_user + after.children_system - before.children_user - before.children_system
    return report["cpu_seconds"]["solve"], whole


def chosen(stored):
    """The cheapest stored runs with the default scheme."""
    ours = [run for run in stored if run.program == costs.OURS and run.scheme in ("default", "default adaptive")]
    return list(dict.fromkeys(run for key in costs.measures(ours) for cost in ("cpu_stepping", "cpu_whole")
                              for run in costs.front(costs.select(ours, *key, costs.OURS), cost)))


def runs(program, stored):
    """Stored runs with costs measured anew.  Their errors are kept: the limits that they are taken against are not stored."""
    found, timed = [], {}
    for one in chosen(stored):
        setting = one.case, one.scheme, one.elements, one.step
        if setting not in timed:
            tries = [run(program, *setting) for _ in range(REPETITIONS)]
            timed[setting] = [min(times) for times in zip(*tries)]
        found.append(replace(one, cpu_stepping=timed[setting][0], cpu_whole=timed[setting][1]))
    return found
