"""Runs twenty bodies and sixty cables on 1, 2, 3 and 4 ranks and checks that their histories agree."""
import json
import shutil
import subprocess
import sys
import time

import numpy as np

from bench import arguments
from ranks import TOLERANCE, Difference, compare, run

RANKS = (1, 2, 3, 4)
# An acceleration has the rounding of a position over the square of the step: 1e-15 m / (4e-3 s)^2 = 1e-10 of 1 m/s2.
END, STEP = 0.4, 4e-3
ROWS, COLUMNS = 4, 5
SCHEMES = {"no scheme named": {}, "generalized_alpha": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}
CORNERS = {"a": [0.2, 0.1, 0.15], "b": [-0.2, 0.12, 0.1], "c": [-0.15, -0.1, -0.12], "d": [0.18, -0.14, -0.1]}
LINK = {"rigid_link": {"axial_stiffness": 1e5}}
BAR = {"bar": {"axial_stiffness": 1e5}}
ROPE = {"mass_per_length": 0.05, "axial_stiffness": 5e3, "axial_damping": 5}


def place(i, above=0.0):
    """The place of body i, or a place above it.  The bodies form four rows that are not straight."""
    row, column = divmod(i, COLUMNS)
    return [float(x) for x in (1.5 * column + 0.2 * np.sin(3 * i), 1.2 * row + 0.2 * np.cos(5 * i),
                               -1.0 * row + 0.3 * np.sin(7 * i) + above)]


def waves(i, sizes):
    """Three numbers that belong to body i."""
    return [float(size * np.sin((k + 2) * i + k)) for k, size in enumerate(sizes)]


def body(i):
    """The keys of body i.  Every fifth body is a point mass, with or without an arm.  Of the others some have Euler
    angles, and some have springs or bars."""
    keys = {"mass": 1 + 0.1 * i, "position": place(i), "velocity": waves(i, (0.5, 0.4, 0.3)),
            "force": waves(i + 1, (1, 2, 3)), "attachments": CORNERS,
            "coupling": LINK if i % 4 == 2 else BAR if i in (0, 4, 13) else "kinematic"}
    if i % 5 == 3:
        return keys if i % 2 else {**keys, "attachments": {name: [0, 0, 0] for name in CORNERS}}
    roll, pitch, yaw = waves(i + 2, (20, 15, 40))
    return {**keys, "inertia": [0.03, 0.04, 0.05, 0.003, -0.002, 0.001 * (i % 4)],
            "orientation": {"roll": roll, "pitch": pitch, "yaw": yaw}, "angular_velocity": waves(i + 3, (2, 1, 3)),
            "torque": [0.01, -0.02, 0.03], "rotation": "euler" if i % 3 == 1 else "quaternion"}


def hangers():
    """Points above the first row of bodies, one of which moves.  Each body of that row hangs on two cables from its
    point.
    @return {name: point}, [(from, to) of each cable]"""
    points = {f"top{i}": {"position": place(i, 1.5), "motion": "fixed"} for i in range(COLUMNS)}
    points["top2"]["motion"] = {"harmonic": {"amplitude": [0.02, 0.03, 0.05], "period": 0.3, "phase": 40}}
    return points, [(f"top{i}", f"b{i}.{corner}") for i in range(COLUMNS) for corner in "ab"]


def network():
    """@return points and cables, the latter as (from, to)"""
    points, ends = hangers()
    for i in range(ROWS * COLUMNS):
        if i % COLUMNS < COLUMNS - 1:
            ends.append((f"b{i}.a", f"b{i + 1}.b"))
        if i + COLUMNS < ROWS * COLUMNS:
            ends += [(f"b{i}.c", f"b{i + COLUMNS}.b"), (f"b{i + COLUMNS}.a", f"b{i}.d")]
    for i in range((ROWS - 1) * COLUMNS, (ROWS - 1) * COLUMNS + 3):
        points[f"tail{i}"] = {"position": place(i, -1.0), "mass": 0.2, "velocity": waves(i, (1, 1, 1))}
        ends.append((f"b{i}.d", f"tail{i}"))
    ends.append(("b7.a", "b7.c"))
    return points, ends


def scene(time_keys):
    points, ends = network()
    bodies = {f"b{i}": body(i) for i in range(ROWS * COLUMNS)}
    cables = {f"c{k}": {"type": "rope", "from": start, "to": end, "elements": 1 + k % 4}
              for k, (start, end) in enumerate(ends)}
    if (len(bodies), len(cables)) != (20, 60):
        sys.exit(f"{len(bodies)} bodies and {len(cables)} cables")
    moving = [name for name in points if name.startswith("tail")]
    return {"cable_types": {"rope": ROPE}, "points": points, "bodies": bodies, "cables": cables,
            "time": {"end": END, "step": STEP, **time_keys},
            "output": {"interval": 5 * STEP, "history": [*bodies, *moving, "top0", *cables], "energy": True}}


def agrees(program, path, folder, ranks, reference):
    """Compares one run with the reference, and prints a line.  @return whether they agree, and the run's history"""
    start, found = time.monotonic(), None
    try:
        found = run(program, path, folder / str(ranks), ranks, ["-cable_most_gained", "2"])   # ropes that go slack
        worst, where = compare(reference or found, found)
        good, text = worst <= TOLERANCE, f"differs by {worst:.1e} ({where})"
    except (Difference, subprocess.TimeoutExpired) as problem:
        good, text = False, str(problem)
    verdict = "" if good else f"FAILED, more than {TOLERANCE}: "
    print(f"{verdict}{folder.name}, {ranks} ranks: {text}, {time.monotonic() - start:.1f} s", flush=True)
    return good, found


def main():
    given = arguments(__doc__)
    failures = 0
    for name, time_keys in SCHEMES.items():
        folder = given.scratch / name.replace(" ", "_")
        folder.mkdir(parents=True)
        path = folder / "scene.yaml"
        path.write_text(json.dumps(scene(time_keys)))   # JSON is YAML
        reference = None
        for ranks in RANKS:
            good, found = agrees(given.program, path, folder, ranks, reference)
            failures += not good
            reference = reference or found
    if failures:
        return 1
    shutil.rmtree(given.scratch)
    return 0


if __name__ == "__main__":
    sys.exit(main())
