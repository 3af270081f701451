"""Draws columns of a run's history.csv over time, with a reference where one is given."""
import argparse
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy


def read_table(path):
    """The table as {column: values}.  Lines that begin with # are comments."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))
    values = numpy.array(rows[1:], float).reshape(-1, len(rows[0]))
    return {name: values[:, column] for column, name in enumerate(rows[0])}


def column_of(table, name, path):
    if name not in table:
        sys.exit(f"plot.py: {path} has no column {name}; it has {', '.join(table)}")
    return table[name]


def largest_difference(history, reference, name):
    """The largest difference at the reference's times that the history reaches; linear between history rows."""
    reached = reference["time"] <= history["time"][-1]
    times = reference["time"][reached]
    difference = numpy.interp(times, history["time"], history[name]) - reference[name][reached]
    return numpy.abs(difference).max() if times.size else numpy.nan


def draw_panel(axes, panel, history, reference, path):
    label, _, names = panel.partition("=")
    for name in names.split(","):
        curve, = axes.plot(history["time"], column_of(history, name, path), label=name)
        if name in reference:
            axes.plot(reference["time"], reference[name], ".", color=curve.get_color(), markersize=5,
                      markeredgecolor="black", markeredgewidth=0.4, label=f"{name}, reference")
            print(f"{name}: at most {largest_difference(history, reference, name):.3g} from the reference")
    axes.set_ylabel(label)
    axes.grid(alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), fontsize=9)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("history", type=pathlib.Path, help="history.csv of a run")
    parser.add_argument("picture", type=pathlib.Path, help="the PNG to write")
    parser.add_argument("--panel", action="append", required=True, metavar="LABEL=COLUMN,COLUMN",
                        help="one diagram; may be given several times")
    parser.add_argument("--reference", type=pathlib.Path, help="a table with columns of the same names")
    parser.add_argument("--title", default="")
    options = parser.parse_args()
    for path in filter(None, (options.history, options.reference)):
        if not path.is_file():
            sys.exit(f"plot.py: {path} is not there")
    history = read_table(options.history)
    reference = read_table(options.reference) if options.reference else {}

    count = len(options.panel)
    figure, axes = plt.subplots(count, 1, sharex=True, squeeze=False, figsize=(11, 1.5 + 2.6 * count))
    for panel, place in zip(options.panel, axes[:, 0]):
        draw_panel(place, panel, history, reference, options.history)
    axes[-1, 0].set_xlabel("time [s]")
    axes[0, 0].set_title(options.title)
    figure.savefig(options.picture, dpi=110, bbox_inches="tight")
    print(options.picture)


if __name__ == "__main__":
    main()
