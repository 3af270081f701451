"""The verification scripts share scenes, runs, references and checks."""
import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import time

import numpy as np

REFERENCE = pathlib.Path(__file__).resolve().parent / "reference"
HELD = {"position": [0, 0, 0], "motion": "fixed"}


class Run:
    """A finished run.  `run["P.x"]` is a column of history.csv as an array, and `run.report` is run.yaml as text."""

    def __init__(self, folder, seconds):
        self.folder, self.seconds = folder, seconds
        lines = (folder / "history.csv").read_text().splitlines()
        values = np.array([[float(word) for word in line.split(",")] for line in lines[1:]])
        self.columns = dict(zip(lines[0].split(","), values.T))
        self.report = (folder / "run.yaml").read_text()

    def __getitem__(self, column):
        return self.columns[column]

    def vectors(self, name, kind=""):
        """An array (rows, 3) of the position, or with kind "v" the velocity, "a" the acceleration, "f" the reaction."""
        return np.column_stack([self[f"{name}.{kind}{axis}"] for axis in "xyz"])

    def counted(self, key):
        return int(re.search(rf"^{key}: (\d+)$", self.report, re.MULTILINE)[1])


class Verification:
    """Runs the program in the scratch folder and collects what fails."""

    def __init__(self, description, *more_options):
        """@param more_options  names of further options that must be given; `options` has their values"""
        parser = argparse.ArgumentParser(description=description)
        parser.add_argument("--program", required=True)
        parser.add_argument("--scratch", required=True, type=pathlib.Path)
        for name in more_options:
            parser.add_argument(f"--{name}", required=True)
        self.options = parser.parse_args()
        self.program, self.scratch = self.options.program, self.options.scratch.resolve()
        shutil.rmtree(self.scratch, ignore_errors=True)
        self.scratch.mkdir(parents=True)
        self.checked, self.failed, self.started, self.runs = 0, [], time.monotonic(), 0
        self.rejected = 0
        self.ranks = None   # None runs without mpirun

    def run(self, scene, *options):
        """Runs a scene, a dict with the keys of a scene file.  The program must succeed."""
        run, done = self.attempt(scene, *options)
        if done.returncode:
            sys.exit(f"FAILED: exit status {done.returncode}: {' '.join(done.args)}\n{done.stderr}")
        self.rejected += run.counted("rejected_steps")
        return run

    def attempt(self, scene, *options):
        """Runs a scene, a dict or the text of a file, that may fail.  @return the run, or None if there is no history, and the finished process"""
        self.runs += 1
        folder = self.scratch / str(self.runs)
        path = folder.with_suffix(".yaml")
        path.write_text(scene if isinstance(scene, str) else json.dumps(scene))   # JSON is YAML
        launcher = ["mpirun", "-n", str(self.ranks)] if self.ranks else []
        command = [*launcher, self.program, "run", str(path), "-o", str(folder), *map(str, options)]
        started = time.monotonic()
        done = subprocess.run(command, cwd=self.scratch, capture_output=True, text=True)
        run = Run(folder, time.monotonic() - started) if (folder / "history.csv").exists() else None
        shutil.rmtree(folder, ignore_errors=True)
        return run, done

    def _note(self, good, text):
        self.checked += 1
        print(("ok      " if good else "FAILED  ") + text, flush=True)
        if not good:
            self.failed.append(text)

    def check(self, name, value, limit):
        """Requires that `value` is at most `limit`.  NaN fails."""
        self._note(bool(value <= limit), f"{name}: {value:.4g} (at most {limit:.4g})")

    def at_least(self, name, value, limit):
        self._note(bool(value >= limit), f"{name}: {value:.4f} (at least {limit:.4f})")

    def close(self, name, value, expected, tolerance):
        """Requires that |value - expected| is at most `tolerance`."""
        self._note(bool(abs(value - expected) <= tolerance), f"{name}: {value:.12g}, expected {expected:.12g}, "
                   f"difference {value - expected:.2g} (at most {tolerance:.2g})")

    def says(self, name, text, *words):
        """Requires that every one of the words is in the text."""
        missing = [word for word in words if word not in text]
        found = f"no {missing} in: {text.strip()}" if missing else f"says {list(words)}"
        self._note(not missing, f"{name}: {found}")

    def finish(self):
        seconds = time.monotonic() - self.started
        print(f"{self.checked} checks, {len(self.failed)} failures, {self.runs} runs, {seconds:.0f} s")
        for text in self.failed:
            print("failed: " + text)
        sys.exit(1 if self.failed else 0)


def scene(cable_type, points, cables, end, step, interval, history, gravity=9.81, energy=False, **time_keys):
    """A scene.  @param cable_type  keys of the only cable type   @param cables  {name: keys}, or the keys of one cable
    with the name `cable`"""
    if "from" in cables:
        cables = {"cable": cables}
    return {
        "environment": {"gravity": gravity},
        "cable_types": {"rope": cable_type},
        "points": points,
        "cables": {name: {"type": "rope", **keys} for name, keys in cables.items()},
        "time": {"end": end, "step": step, **time_keys},
        "output": {"interval": interval, "history": history, "energy": energy},
    }


def body_scene(bodies, end, step, interval, gravity=0, **time_keys):
    """A scene of bodies that no cable holds.  All are in the history."""
    return {
        "environment": {"gravity": gravity},
        "bodies": bodies,
        "time": {"end": end, "step": step, **time_keys},
        "output": {"interval": interval, "history": list(bodies), "energy": True},
    }


def read_reference(name):
    """A csv file of reference/ as {column: array}, without its `#` lines.  Columns of words stay text."""
    lines = [line for line in (REFERENCE / name).read_text().splitlines() if not line.startswith("#")]
    rows = [line.split(",") for line in lines[1:]]
    columns = {}
    for i, key in enumerate(lines[0].split(",")):
        words = [row[i] for row in rows]
        try:
            columns[key] = np.array(words, dtype=float)
        except ValueError:
            columns[key] = np.array(words)
    return columns


def rows_at(times, wanted):
    """The indices into `times` of the times `wanted`."""
    index = np.searchsorted(times, np.asarray(wanted) - 1e-9)
    if np.max(np.abs(times[index] - wanted)) > 1e-9:
        sys.exit(f"FAILED: times {wanted} are not all among {times[:3]} ... {times[-1]}")
    return index


def orders(errors, ratio=2):
    """The orders between successive errors, where each step is `ratio` times smaller than the one before."""
    errors = np.asarray(errors)
    return np.log(errors[:-1] / errors[1:]) / np.log(ratio)


def energy_drift(run):
    """The largest change of the energy balance over the largest kinetic energy."""
    total = run["energy.total"]
    return np.abs(total - total[0]).max() / run["energy.kinetic"].max()
