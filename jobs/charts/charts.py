#!/usr/bin/env python3
"""Draws the two pictures that README.md shows: error over cost beside MoorDyn-C 2.7.1, and the stability map."""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "jobs" / "charts"), str(ROOT / "jobs" / "stability"), str(ROOT / "tests" / "verification")]
import costs   # noqa: E402
import pictures   # noqa: E402
import stability_map   # noqa: E402


def parse():
    parser = argparse.ArgumentParser(prog="charts.sh", description=__doc__)
    parser.add_argument("--stored", action="store_true", help="draw from the stored figures alone, in seconds")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "cablenet")
    parser.add_argument("--yardstick", type=pathlib.Path, default=ROOT / "build" / "yardstick_chain",
                        help="the hand-written chain, which tells how fast this machine is")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "build" / "charts", metavar="DIR")
    return parser.parse_args()


def measured(options):
    """The runs of today's program, with their costs on the machine of the stored ones, and the factor between both."""
    import measure   # it runs the program
    pace = measure.pace(options.yardstick)
    factor = costs.STORED_PACE / pace
    print(f"the hand-written chain takes {pace:.3g} us a step of 24 elements here, {costs.STORED_PACE} us there: "
          f"times are multiplied by {factor:.3g}")
    return costs.scaled(measure.runs(options.program, costs.stored_runs()), factor), factor


def main():
    options = parse()
    options.output.mkdir(parents=True, exist_ok=True)
    stored = costs.stored_runs()
    fresh, factor = ([], None) if options.stored else measured(options)
    if fresh:
        costs.write(options.output / "runs.csv", fresh)
    pictures.error_over_cost(stored, costs.stored_statics(), fresh, factor, options.output / "error_over_cost.png")
    stability_map.draw(options.output / "stability.png")
    for line in costs.told(stored, "stored"), costs.told(fresh + costs.peers(stored), "today's") if fresh else "":
        print(line, end="")
    print(f"the pictures are in {options.output}")


if __name__ == "__main__":
    main()
