"""A cell of the map: one scene by one method at one step, run and judged."""
import json
import re
import resource
import shutil
import subprocess

import numpy as np

from support import Run

GREEN, AMBER = 0.01, 0.1   # of the motion
# From the best to the worst.
COLOURS = ("green", "amber", "noted", "told", "wrong", "failed")
MEANINGS = {
    "green": "within 1 % of the motion",
    "amber": "within 10 %",
    "noted": "farther off, exit status 0 and a note that says so",
    "told": "ended by exit status 3 and an error that says why",
    "wrong": "farther off than 10 %, exit status 0 and no word about it",
    "failed": "neither an answer nor a clear end: another status, no end in time, or rows missing",
}
NO_ANSWER, OUT_OF_TIME = 3, 99


class Cell:
    """@param status  the exit status   @param error  the largest error over the motion, NaN where there is none
    @param reason  what the run said about its own accuracy, or its error"""

    def __init__(self, case, method, step, status, error, reason):
        self.case, self.method, self.step = case, method, step
        self.status, self.error, self.reason = status, error, reason
        self.colour = colour(status, error, bool(reason))


def colour(status, error, said):
    if status == NO_ANSWER:
        return "told" if said else "failed"
    if status or not np.isfinite(error):
        return "failed"
    if error <= GREEN:
        return "green"
    if error <= AMBER:
        return "amber"
    return "noted" if said else "wrong"


def reason_in(said, status):
    """The error, or the notes that say that the steps lead the motion astray.  Others, such as that cables push, say
    nothing about the answer."""
    words = [re.sub(r"^cablenet: (note|error): ", "", line) for line in said.splitlines()
             if line.startswith("cablenet: error:") or status == 0 and line.startswith("cablenet: note:")]
    words = [re.sub(r" The state at that time is saved as .*", "", text) for text in words]
    return "; ".join(text for text in words if status or re.search("do not resolve|step's formulas", text))


def run(program, folder, key, case, method, step, limit):
    """Runs a cell in a folder of its own. @param limit  the CPU time that it may take [s]"""
    folder.mkdir(parents=True)
    path, results = folder / "scene.yaml", folder / "results"
    path.write_text(json.dumps(method.asked(case.made, step)))   # JSON is YAML
    command = [str(program), "run", str(path), "-o", str(results), *method.options]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=20 * limit,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1)))
        status, said = done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        status, said = OUT_OF_TIME, ""
    error = np.nan
    if status == 0:
        off = case.off(Run(results, 0))
        error = float(off.max()) if np.isfinite(off).all() else np.inf
    shutil.rmtree(folder)
    if status < 0 or status == OUT_OF_TIME:
        return Cell(key, method.key, step, status, error, f"no end within {limit} s of CPU")
    return Cell(key, method.key, step, status, error, reason_in(said, status))
