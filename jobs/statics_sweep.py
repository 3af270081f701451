#!/usr/bin/env python3
"""Solves many slack moorings with touchdown, or many networks of every kind, from three drawn shapes each, and counts
how many are found.

usage: statics_sweep.py PROGRAM [--moorings 134 | --networks N] [--first 0] [--ranks N] [--keep FOLDER] [--jobs N]
One row a scene; then how many were found, how many agree from all drawn shapes, and the iterations.  What can have more
than one equilibrium, such as bars, bodies and what lies in a current, need not agree.
"""
import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "verification"))
from mooring_scenes import DRAWN, Mooring   # noqa: E402
from network_scenes import Network   # noqa: E402

SAME = 1e-8   # between drawn shapes, over the largest pull


def solve(program, ranks, folder, draw, drawn):
    """@return (exit status, iterations, CPU seconds, imbalance, the row of the history, what was said)"""
    path = folder / f"{draw.seed}_{drawn}.yaml"
    path.write_text(json.dumps(draw.scene(drawn)))
    output = path.with_suffix("")
    launcher = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks else []
    try:
        done = subprocess.run([*launcher, program, "run", str(path), "-o", str(output)], capture_output=True, text=True,
                              timeout=120)
    except subprocess.TimeoutExpired:
        return 99, 0, 120, 1, {}, "took more than 120 s"
    report, history = output / "run.yaml", output / "history.csv"
    if not report.exists():
        return done.returncode, 0, 0, 1, {}, done.stderr
    text = report.read_text()
    number = lambda key: float(re.search(rf"{key}: (\S+)", text)[1])
    cpu = float(re.search(r"cpu_seconds:\n(?:  .*\n)*?  statics: (\S+)", text)[1])
    names, values = [line.split(",") for line in history.read_text().splitlines()[:2]]
    row = dict(zip(names, map(float, values)))
    return (done.returncode, int(number("iterations")), cpu, number("largest_unbalanced_force_over_load"), row,
            done.stderr)


def pulls(row):
    """Their signs are lost in rounding where a line lies."""
    return np.abs([value for key, value in row.items() if ".tension_" in key])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--moorings", type=int, default=134)
    parser.add_argument("--networks", type=int)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--ranks", type=int)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    folder = options.keep or pathlib.Path(tempfile.mkdtemp())
    folder.mkdir(parents=True, exist_ok=True)
    found, same, noted, iterations, seconds = 0, 0, 0, [], []
    kind, count, shapes = (Network, options.networks, range(3)) if options.networks else (Mooring, options.moorings, DRAWN)
    draws = [kind(seed) for seed in range(options.first, options.first + count)]
    pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
    runs = [pool.map(lambda d, m=m: solve(options.program, options.ranks, folder, m, d), shapes) for m in draws]
    for draw, solutions in zip(draws, runs):
        solutions = list(solutions)
        good = [s for s in solutions if s[0] == 0]
        found += len(good)
        noted += sum("note" in s[5] for s in good)
        iterations += [s[1] for s in solutions]
        seconds += [s[2] for s in solutions]
        spread = np.inf
        if len(good) == len(solutions):
            all_pulls = np.array([pulls(s[4]) for s in good])
            spread = np.ptp(all_pulls, axis=0).max() / np.abs(all_pulls).max() if all_pulls.size else 0
        same += spread <= SAME
        words = " ".join(f"{s[0]}/{s[1]}/{s[3]:.0e}{'n' if 'note' in s[5] else ''}" for s in solutions)
        print(f"{draw.name}: {words}, apart {spread:.1e}{'' if draw.is_convex else ' (need not agree)'}", flush=True)
        for status, *_, said in solutions:
            if status:
                print(f"    {said.strip()[-300:]}", flush=True)
    print(f"found {found} of {3 * len(draws)} ({noted} with a note); {same} of {len(draws)} scenes agree from all "
          f"drawn shapes; iterations: median {np.median(iterations):.0f}, largest {max(iterations)}; CPU: median "
          f"{np.median(seconds):.2g} s, largest {max(seconds):.2g} s")


if __name__ == "__main__":
    main()
