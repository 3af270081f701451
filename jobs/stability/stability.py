#!/usr/bin/env python3
"""Runs hard cases by every scheme at several steps against exact or independent answers, and draws the map."""
import argparse
import concurrent.futures
import pathlib
import subprocess
import sys
import tempfile
from collections import Counter

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "jobs" / "stability"), str(ROOT / "tests" / "verification")]
import cases   # noqa: E402
import cells   # noqa: E402
import methods   # noqa: E402
import tables   # noqa: E402


def chosen(everything, words, parser, option):
    """What a list of words, or parts of them, selects."""
    if not words:
        return everything
    found = {key: value for key, value in everything.items() if any(word in key for word in words.split(","))}
    missing = [word for word in words.split(",") if not any(word in key for key in everything)]
    if missing:
        parser.error(f"{option}: no {', '.join(missing)}; there are {', '.join(everything)}")
    return found


def parse():
    parser = argparse.ArgumentParser(prog="stability.sh", description=__doc__)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "cablenet")
    parser.add_argument("--cases", metavar="WORD,...", help="only cases with one of these words in their key")
    parser.add_argument("--methods", metavar="WORD,...", help="only methods with one of these words in their key")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="runs at a time; 1")
    parser.add_argument("--limit", type=int, default=60, metavar="S", help="CPU seconds that a run may take; 60")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "build" / "stability", metavar="DIR")
    parser.add_argument("--references", action="store_true", help="calculate the stored answers anew: some minutes")
    parser.add_argument("--list", action="store_true", help="list the cases and methods, and run nothing")
    options = parser.parse_args()
    options.cases = chosen(cases.ALL, options.cases, parser, "--cases")
    options.methods = chosen(methods.ALL, options.methods, parser, "--methods")
    if not options.list and not options.program.exists():
        parser.error(f"{options.program} does not exist: build it with bash jobs/setup.sh")
    return options


def wanted(made, picked):
    """(case, method, step) of all cells.  Adaptive steps start at the second of a case's steps."""
    return [(key, method, step) for key, case in made.items() for method in picked.values()
            for step in (case.steps[1:2] if method.adaptive else case.steps)]


def run(program, made, asked, jobs, limit, heard=lambda cell: None):
    """The cells that are asked for. @param heard  is told of each as it ends, in order"""
    found = []
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        running = [pool.submit(cells.run, program.resolve(), pathlib.Path(scratch) / str(n), key, made[key], method, step,
                               limit) for n, (key, method, step) in enumerate(asked)]
        for one in running:
            found.append(one.result())
            heard(found[-1])
    return found


def tell(cell):
    print(f"{cell.colour:7} {cell.case:14} {cell.method:14} {cell.step:<8g} {100 * cell.error:10.3g} %  "
          f"{cell.reason[:90]}", flush=True)


def main():
    options = parse()
    tables.ANEW = options.references
    made = {key: make() for key, make in options.cases.items()}
    if options.list:
        for key, case in made.items():
            print(f"{key:14} {case.name}; steps {', '.join(f'{step:g}' for step in case.steps)} s; {case.origin}")
        print("methods: " + ", ".join(options.methods))
        return
    found = run(options.program, made, wanted(made, options.methods), options.jobs, options.limit, tell)
    from page import write   # matplotlib is wanted for the picture alone
    version = subprocess.run([options.program, "--version"], capture_output=True, text=True).stdout.strip()
    write(options.output, found, made, options.methods, version)
    count = Counter(cell.colour for cell in found)
    print(", ".join(f"{count[colour]} {colour}" for colour in cells.COLOURS) + f" of {len(found)} cells; "
          f"the map is in {options.output}")


if __name__ == "__main__":
    main()
