"""Each example's own run line works, and reaches the number that its README gives."""
import csv
import pathlib
import re
import subprocess
import sys

from bench import ENVIRONMENT, arguments

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Columns that are held against reference.csv, until when, and the largest difference allowed: a little above what was measured.
REFERENCES = {"free_fall": (("free.x", "free.z"), 1.7, 3e-3), "conical_pendulum": (("mass.x", "mass.y", "mass.z"), 10, 1.3e-4),
              "hanging_chain": (("tip.x",), 10, 1.4e-6), "cable_body_pendulum": (("cube.x", "cube.z"), 10, 1.6e-6),
              "spinning_top": (("top.x", "top.y", "top.z"), 3.15, 2.4e-6)}
STATIC = ("elastic_catenary", "low_langley")      # the first command's result is an equilibrium: one row
LONG = {"towed_array": 20, "net": 3, "seismic_array": 40}      # steps that stand for the whole


def table(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def run_line(example):
    """The README's first command."""
    return re.search(r"```bash\n(mpirun .*)\n", (example / "README.md").read_text())[1].split()


def largest_difference(found, reference, columns, end):
    at = {round(float(row["time"]), 9): row for row in reference}
    pairs = [(row, at[round(float(row["time"]), 9)]) for row in found
             if float(row["time"]) <= end and round(float(row["time"]), 9) in at]
    assert len(pairs) > 10, "reference.csv has other times"
    return max(abs(float(a[name]) - float(b[name])) for a, b in pairs for name in columns)


def check(example, program, scratch):
    name = example.name
    words = run_line(example)
    words[words.index("build/cablenet")] = program
    words[words.index("-o") + 1] = str(scratch / name)
    if name in LONG:
        words += ["-ts_max_steps", str(LONG[name])]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, env=ENVIRONMENT, check=False)
    if done.returncode:
        return f"exit status {done.returncode}: {done.stderr}"
    found = table(scratch / name / "history.csv")
    if name not in REFERENCES:
        return "" if len(found) >= (1 if name in STATIC else 2) else "no rows"
    columns, end, limit = REFERENCES[name]
    worst = largest_difference(found, table(example / "reference.csv"), columns, end)
    print(f"{name}: {worst:.3g} from the reference until {end} s, allowed {limit}")
    return "" if worst <= limit else "too far from the reference"


def main():
    given = arguments(__doc__)
    examples = sorted(path.parent for path in (ROOT / "examples").glob("*/README.md"))
    wrong = {example.name: text for example in examples if (text := check(example, given.program, given.scratch))}
    print("\n".join(f"FAIL {name}: {text}" for name, text in wrong.items()) or f"{len(examples)} examples run")
    return 1 if wrong or not examples else 0


if __name__ == "__main__":
    sys.exit(main())
