"""study.py PROGRAM DIR [--elements N] [--step S]: runs the chain at all 30 radii and periods into DIR, prints how far its
largest forces are from the measured ones, and draws DIR/study.png.  Takes some two minutes."""
import argparse
import pathlib
import resource
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "jobs"))
from plot import plt, read_table    # noqa: E402

import numpy                        # noqa: E402

FIRST, LAST = 7, 12         # cycles that count: 3 have the radius grow, 4 settle
SAMPLES = 250               # of a cycle


def read_options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--elements", type=int, default=66)
    parser.add_argument("--step", type=float, default=2.5e-3)
    return parser.parse_args()


def scene(radius, period, options):
    """The example's own, with other numbers."""
    text = (HERE / "scene.yaml").read_text()
    for old, new in (("elements: 66", f"elements: {options.elements}"), ("step: 2.5e-3", f"step: {options.step}"),
                     ("end: 15 ", f"end: {LAST * period} "), ("interval: 0.005", f"interval: {period / SAMPLES}"),
                     ("1.25", str(period)), ("3.75", str(3 * period)), ("0.2*", f"{radius}*")):
        if old not in text:
            sys.exit(f"study.py: scene.yaml has no {old}")
        text = text.replace(old, new)
    return text


def force(radius, period, options):
    """(cycles that count, SAMPLES + 1) of the force at the upper end."""
    name = options.folder / f"r{radius}_T{period}"
    path = name.with_suffix(".yaml")
    path.write_text(scene(radius, period, options))
    done = subprocess.run([options.program.resolve(), "run", path, "-o", name], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"study.py: {path}: {done.stderr}")
    tension = read_table(name / "history.csv")["chain.tension_to"]
    return numpy.array([tension[c * SAMPLES:(c + 1) * SAMPLES + 1] for c in range(FIRST, LAST)])


def run_all(measured, options):
    """{radius: largest forces over the periods}, {period: cycle at the largest radius}"""
    radii = [name for name in measured if name != "period"]
    maxima, cycles = {name: [] for name in radii}, {}
    for period in measured["period"]:
        for name in radii:
            found = force(float(name), float(period), options)
            maxima[name].append(found.max(axis=1).mean())
            cycles[period] = found[:, :SAMPLES].mean(axis=0)
        print(f"T = {period} s: " + " ".join(f"{maxima[name][-1]:.2f}" for name in radii), flush=True)
    return maxima, cycles


def report(maxima, measured):
    errors = numpy.array([numpy.array(maxima[name]) - measured[name] for name in maxima])
    shares = numpy.abs(errors) / numpy.array([measured[name] for name in maxima])
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{errors.size} largest forces: RMSE {numpy.sqrt((errors**2).mean()):.2f} N, mean error "
          f"{100 * shares.mean():.2f} %, bias {errors.mean():+.2f} N; {used.ru_utime + used.ru_stime:.0f} s of CPU")


def aligned(cycle, record):
    """The cycle at the record's phases, shifted to where it fits best, and the difference's RMS over its range."""
    count = len(record)
    phases = numpy.arange(count) / count * SAMPLES
    closed = numpy.append(cycle, cycle)
    tries = [numpy.interp(phases + shift, numpy.arange(2 * SAMPLES), closed) for shift in range(SAMPLES)]
    rms = [numpy.sqrt(((one - record)**2).mean()) for one in tries]
    best = int(numpy.argmin(rms))
    return tries[best], rms[best] / (record.max() - record.min())


def draw(maxima, cycles, measured, records, folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.8))
    for name, found in maxima.items():
        line, = left.plot(measured["period"], found, label=f"r = {name} m")
        left.plot(measured["period"], measured[name], "o", color=line.get_color(), markersize=4)
    for period in (1.25, 3.5):
        record = records[f"T{period:.2f}"]
        found, error = aligned(cycles[period], record)
        line, = right.plot(records["phase"], found, label=f"T = {period} s")
        right.plot(records["phase"], record, ".", color=line.get_color())
        print(f"force over a cycle, T = {period} s: RMSE {100 * error:.1f} % of its range")
    for axes, label, title in ((left, "period [s]", "mean of the cycles' largest force"),
                               (right, "phase", "force over a cycle, r = 0.2 m")):
        axes.set(xlabel=label, ylabel="force at the upper end [N]", title=title + "; dots: measured")
        axes.grid(alpha=0.3)
        axes.legend(fontsize=9)
    figure.savefig(folder / "study.png", dpi=90, bbox_inches="tight")
    print(folder / "study.png")


def main():
    options = read_options()
    options.folder.mkdir(parents=True, exist_ok=True)
    measured, records = read_table(HERE / "measured.csv"), read_table(HERE / "waveforms.csv")
    maxima, cycles = run_all(measured, options)
    report(maxima, measured)
    draw(maxima, cycles, measured, records, options.folder)


main()
