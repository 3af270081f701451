"""Runs scenes on 1, 2, 3, 4 and 7 ranks and with PETSc's own solvers, and checks that their histories agree."""
import csv
import shutil
import subprocess
import sys
import time

from bench import ENVIRONMENT, SCENES, arguments

TOLERANCE = 1e-9      # of a quantity's scale: its largest value in the run
# In `array` elements go slack and taut, and some steps are cut to dt = 0.02 s/16.  Newton's method ends within 8 times the
# residual's rounding there, eps x (K + 3.8/dt^2 M)/alpha_f, with the largest coordinate x = 12.2 m, the elements' norms
# K = 4e5 N/m and M = 2.4 kg, alpha_f = 1/1.7.  Two runs may thus differ by 2 x 8 x 2.2e-16 x 12.2 x 6.2e6 x 1.7 N in forces
# and, over the tips' 1 kg, by as many m/s^2 in accelerations.  Which part of it is seen depends on the BLAS.
RESIDUALS = {"array": 4.5e-7}
FORCES = {"ax", "ay", "az", "fx", "fy", "fz", "tension_from", "tension_to"}
LIMIT = 120           # s for one run

# {scene in SCENES: numbers of ranks}.  Nothing in them lies in a plane: each quantity then has a scale of its own.
RANKS = {"chain": (2, 3, 4, 7), "array": (2, 3, 4, 7), "taut_array": (2, 3, 4, 7), "two_cables": (2, 3, 4, 7),
         "net": (2, 3, 4, 7), "more_ranks_than_nodes": (2, 7)}


class Difference(Exception):
    pass


# {label: (scenes, options)} of other solvers of the same systems, which run on one rank.  Kept and lagged tangents
# leave out `array`: its elements go slack and taut within Newton's iterations, which then end within rounding of the
# solution but not in the same place.
SOLVERS = {
    "lu": (set(RANKS), ("-pc_type", "lu")),
    "gmres": (set(RANKS), ("-ksp_type", "gmres")),
    "baij": (set(RANKS), ("-mat_type", "baij", "-pc_type", "lu")),
    "mumps with kept tangents": (set(RANKS) - {"array"}, ("-cable_elimination_limit", "0")),
    "lagged tangents": ({"chain"}, ("-snes_lag_jacobian", "2")),
}


def run(program, scene, folder, ranks, options=()):
    """@return the history's columns and rows"""
    command = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    done = subprocess.run([*command, program, "run", scene, "-o", folder, *options], env=ENVIRONMENT, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LIMIT)
    if done.returncode != 0:
        raise Difference(f"status {done.returncode}: {done.stdout}")
    with open(folder / "history.csv", newline="") as file:
        columns, *rows = csv.reader(file)
    return columns, [[float(cell) for cell in row] for row in rows]


def scales(columns, rows):
    """{column: its largest value}.  The energies share one scale, because they balance each other."""
    largest = [max(abs(row[i]) for row in rows) for i in range(len(columns))]
    energy = max((value for name, value in zip(columns, largest) if name.startswith("energy.")), default=0)
    return [energy if name.startswith("energy.") else value for name, value in zip(columns, largest)]


def compare(reference, other, residuals=0):
    """@return the largest difference over its quantity's scale, and where it is; of FORCES only what is beyond `residuals`
    counts"""
    columns, rows = reference
    if other[0] != columns:
        raise Difference("other columns")
    if len(other[1]) != len(rows):
        raise Difference(f"{len(other[1])} rows instead of {len(rows)}")
    worst = (0, "nowhere")
    for mine, theirs in zip(rows, other[1]):
        for name, scale, a, b in zip(columns, scales(columns, rows), mine, theirs):
            beyond = abs(a - b)
            if name.split(".")[-1] in FORCES and beyond <= residuals:
                beyond = 0
            difference = beyond / scale if scale > 0 else beyond
            if not difference <= worst[0]:
                worst = (difference, f"{name} at t = {mine[0]}")
    return worst


def variants(name, numbers):
    """(label, ranks, options); the first one is what the others are compared with"""
    yield "1 rank", 1, ()
    for ranks in numbers:
        yield f"{ranks} ranks", ranks, ()
    for label, (scenes, options) in SOLVERS.items():
        if name in scenes:
            yield label, 1, options


def main():
    given = arguments(__doc__)
    failures = 0
    for name, numbers in RANKS.items():
        folder = given.scratch / name
        folder.mkdir(parents=True)
        scene = SCENES / f"{name}.yaml"
        reference = None
        for label, ranks, options in variants(name, numbers):
            start = time.monotonic()
            try:
                found = run(given.program, scene, folder / label.replace(" ", "_"), ranks, options)
                reference = reference or found
                worst, where = compare(reference, found, RESIDUALS.get(name, 0))
                verdict = "" if worst <= TOLERANCE else f": more than {TOLERANCE}"
                text = f"{len(found[1])} rows, differs by {worst:.1e} ({where}){verdict}"
            except (Difference, subprocess.TimeoutExpired) as problem:
                verdict = text = str(problem)
            failures += bool(verdict)
            print(f"{name}, {label}: {text}, {time.monotonic() - start:.1f} s", flush=True)
            if reference is None:
                break
    if failures:
        return 1
    shutil.rmtree(given.scratch)
    return 0


if __name__ == "__main__":
    sys.exit(main())
