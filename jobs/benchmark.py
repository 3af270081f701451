"""Measures cablenet's speed and memory and prints them beside their targets.  A missed target is no failure."""
import argparse
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time
from functools import partial

from benchmarks import bodies, chains, features, instructions, networks, scaling, tows
from benchmarks.page import Page
from benchmarks.runs import Laboratory, RunFailed

ROOT = pathlib.Path(__file__).resolve().parent.parent

# The sections by number.  {elements: steps} is chosen so that most runs take some seconds.
FULL = {
    1: chains.free_fall,
    2: partial(chains.sizes, counts={10**3: 1000, 10**4: 100, 10**5: 10, 10**6: 10}),
    3: partial(networks.arrays, counts={10**3: (400, 1.3), 10**4: (80, 1.7), 10**5: (10, 1.8)}),
    4: partial(networks.net, meshes=200, steps=5),
    5: partial(chains.large, elements=10**6, steps=100),
    6: partial(chains.memory, elements=10**5),
    7: partial(instructions.free_fall, few=200, many=700),
    8: partial(scaling.model, counts={10**3: 200, 10**4: 40, 10**5: 10}, sizes=((10**5, 0), (10**5, 100), (10**6, 1000)),
               large=(10**7, 10**4, (64, 1024, 16384)), elements=10**8),
    9: partial(bodies.bodies, masses=1000, elements=10, steps=200, cables=(50, 100, 200, 400), per_cable=50),
    10: partial(tows.tows, targets={100: 0.002, 500: 0.008, 1000: 0.016}, finest=(1000, 0.05), step=1, interval=2),
    11: partial(features.features, few=20, many=120),
}
QUICK = {
    1: chains.free_fall,
    2: partial(chains.sizes, counts={10**3: 200, 10**4: 20}),
    3: partial(networks.arrays, counts={10**3: (100, 1.3)}),
    4: partial(networks.net, meshes=30, steps=5),
    5: partial(chains.large, elements=10**5, steps=10),
    6: partial(chains.memory, elements=10**4),
    7: partial(instructions.free_fall, few=100, many=200),
    8: partial(scaling.model, counts={10**3: 50, 10**4: 10}, sizes=((10**4, 0), (10**4, 10)),
               large=(10**5, 100, (16, 64)), elements=10**8),
    9: partial(bodies.bodies, masses=100, elements=10, steps=200, cables=(50, 100), per_cable=50),
    10: partial(tows.tows, targets={100: 0.002}, finest=(200, 0.2), step=1, interval=2),
    11: partial(features.features, few=20, many=40),
}


def parse():
    parser = argparse.ArgumentParser(prog="benchmark.sh", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="small versions of all, to try it out")
    parser.add_argument("--output", type=pathlib.Path, metavar="FILE", help="write the page here, too")
    parser.add_argument("--instructions", action="store_true", help="also sections 7 and 11, with callgrind")
    parser.add_argument("--scaling", action="store_true", help="also section 8: many ranks, by a model")
    parser.add_argument("--sections", metavar="N,N", help="only these, such as 1,2")
    parser.add_argument("--repetitions", type=int, help="of each timing; 5, with --quick 2")
    parser.add_argument("--limit", type=float, default=600, help="seconds that one run may take; 600")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", help="where the programs are")
    options = parser.parse_args()
    if options.sections and not re.fullmatch(r"([1-9]|1[01])(,([1-9]|1[01]))*", options.sections):
        parser.error("--sections: expected numbers from 1 to 11, such as 1,2")
    if options.repetitions is not None and options.repetitions < 1:
        parser.error("--repetitions: expected at least 1")
    options.build = options.build.resolve()
    return options


def chosen(options):
    if options.sections:
        return sorted({int(word) for word in options.sections.split(",")})
    return [1, 2, 3, 4, 5, 6] + [7] * options.instructions + [8] * options.scaling + [9, 10] + [11] * options.instructions


def processor():
    try:
        return re.search(r"model name\s*:\s*(.+)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))[1]
    except (OSError, TypeError):
        return platform.machine()


def commit():
    found = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], capture_output=True, text=True)
    return found.stdout.strip() or "unknown"


def introduce(page, laboratory, options):
    page.write(f"# cablenet {commit()}: speed and memory{', small versions' if options.quick else ''}")
    page.write(f"\n{processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f} at the start; "
               f"{time.strftime('%Y-%m-%d %H:%M')}; {laboratory.repetitions} repetitions, spread = (max - min)/min.")


def main():
    options = parse()
    laboratory = Laboratory(options.build / "cablenet", options.build / "yardstick_chain", None,
                            options.repetitions or (2 if options.quick else 5), options.limit)
    for program in (laboratory.program, laboratory.yardstick):
        if not program.is_file():
            sys.exit(f"benchmark.py: {program} is not there; bash jobs/setup.sh builds it")
    page = Page()
    introduce(page, laboratory, options)
    with tempfile.TemporaryDirectory(prefix="benchmark_", dir=options.build) as folder:
        laboratory.folder = pathlib.Path(folder)
        for section in chosen(options):
            try:
                (QUICK if options.quick else FULL)[section](laboratory, page)
            except RunFailed as problem:
                page.missing(f"section {section}", problem)
    page.conclude()
    if options.output:
        options.output.write_text("\n".join(page.lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
