"""Runs the programs, and reads their results."""
import csv
import json
import shutil
import statistics
import subprocess
import time

import yaml


class RunFailed(Exception):
    """A run ended badly or took too long.  The page leaves its figure out."""


class Samples:
    """One quantity, measured several times."""

    def __init__(self, values):
        self.values = list(values)

    @property
    def least(self):
        return min(self.values)

    @property
    def median(self):
        return statistics.median(self.values)

    @property
    def spread(self):
        return (max(self.values) - self.least) / self.least if self.least > 0 else float("nan")

    def cells(self, digits=3):
        return [number(self.least, digits), number(self.median, digits), f"{100 * self.spread:.0f} %"]


def number(value, digits=3):
    """The value as text with this many significant digits, without an exponent."""
    if value != value:
        return "-"
    return f"{float(f'{value:.{digits}g}'):,.10g}"


class Run:
    """A finished run: run.yaml as a dict, the wall time of the whole process [s], and {event: seconds}."""

    def __init__(self, report, wall, events):
        self.report, self.wall, self.events = report, wall, events

    def clock(self, kind):
        """{phase: seconds}.  @param kind  "cpu" for the CPU time of the busiest rank, or "wall" """
        return {phase: float(seconds) for phase, seconds in self.report[f"{kind}_seconds"].items()}

    @property
    def memory(self):
        """The peak memory of all ranks together [bytes]."""
        return float(self.report["peak_memory_MB"]["all_ranks"]) * 2**20


class Stepping:
    """A long run minus a short one: the cost of steps, without that of what a run does once."""

    def __init__(self, short, long):
        self.short, self.long = short, long
        self.steps = long.report["steps"] - short.report["steps"]
        self.newton = long.report["newton_iterations"] - short.report["newton_iterations"]
        self.unknowns = long.report["unknowns"]
        if long.report["rejected_steps"]:
            raise RunFailed(f"{long.report['rejected_steps']} steps were rejected, which is not what is to be timed")

    def seconds(self, kind="cpu", phase="solve"):
        return self.long.clock(kind)[phase] - self.short.clock(kind)[phase]

    def per_step(self, kind="cpu"):
        return self.seconds(kind) / self.steps

    def per_unknown_iteration(self, seconds):
        """`seconds` per unknown and Newton iteration [ns]."""
        return 1e9 * seconds / (self.newton * self.unknowns)

    def events(self):
        return {name: seconds - self.short.events.get(name, 0) for name, seconds in self.long.events.items()}


def read_events(path):
    """{event: seconds} of a -log_view table, on the slowest rank and in all stages together."""
    by_rank = {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            key = row["Event Name"].strip(), row["Rank"]
            by_rank[key] = by_rank.get(key, 0) + float(row["Time"])
    events = {}
    for (name, _), seconds in by_rank.items():
        events[name] = max(events.get(name, 0), seconds)
    return events


class Laboratory:
    """Makes runs of the programs in a temporary folder, `repetitions` times, for at most `limit` seconds each."""

    def __init__(self, program, yardstick, folder, repetitions, limit):
        self.program, self.yardstick, self.folder = program, yardstick, folder
        self.repetitions, self.limit = repetitions, limit

    def execute(self, command):
        """@return the finished process, with what it printed, and the wall time [s]"""
        started = time.monotonic()
        try:
            done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=self.limit)
        except subprocess.TimeoutExpired:
            raise RunFailed(f"took more than {self.limit:.0f} s: {' '.join(command)}") from None
        if done.returncode:
            last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
            raise RunFailed(f"exit status {done.returncode}: {' '.join(command)}: {' '.join(last)}")
        return done, time.monotonic() - started

    def command(self, scene, *options):
        """Writes the scene and removes an older result.  @return the command that runs the scene"""
        path, results = self.folder / "scene.yaml", self.folder / "results"
        path.write_text(json.dumps(scene), encoding="utf-8")   # JSON is YAML
        shutil.rmtree(results, ignore_errors=True)
        return [str(self.program), "run", str(path), "-o", str(results), *map(str, options)]

    def report(self):
        """run.yaml of the last run, as a dict."""
        return yaml.safe_load((self.folder / "results" / "run.yaml").read_text(encoding="utf-8"))

    def run(self, scene, *options, ranks=1, steps=None, events=False):
        """@param steps  the run ends after so many   @param events  whether to read events from -log_view"""
        log = self.folder / "events.csv"
        more = [*options]
        more += ["-ts_max_steps", steps] if steps else []
        more += ["-log_view", f":{log}:ascii_csv"] if events else []
        launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        _, wall = self.execute([*launcher, *self.command(scene, *more)])
        return Run(self.report(), wall, read_events(log) if events else {})

    def stepping(self, scene, steps, *options, **keywords):
        """The cost of `steps` steps after the first step, as a Stepping."""
        return Stepping(*(self.run(scene, *options, steps=count, **keywords) for count in (1, 1 + steps)))

    def chain(self, elements, step, steps, length):
        """The figures of the hand-written chain, {name: text}."""
        command = [str(self.yardstick), elements, step, steps, 0, length]
        done, _ = self.execute(list(map(str, command)))
        return dict(pair.split("=") for pair in done.stdout.split())

    def repeat(self, measure, repetitions=None):
        return [measure() for _ in range(repetitions or self.repetitions)]
