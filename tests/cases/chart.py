"""cablenet chart on a small scene: its orders, its choices against finer runs of this script's own, its budget, and that
nothing is run twice."""
import csv
import os
import pathlib
import re
import resource
import subprocess
import sys

import numpy
import yaml

from bench import ENVIRONMENT, Bench, arguments, expect, status

# A weight on a chain in still water, drawn aside and back at the top, without a jolt.
SCENE = """# The comment stays.
environment: {{fluid: {{density: 1025}}}}
cable_types:
  chain: {{diameter: 0.05, mass_per_length: 14, axial_stiffness: 1.0e6, normal_drag: 1.2, tangential_drag: 0.1, added_mass: 1.0}}
points:
  top: {{position: [0, 0, 0], motion: {{expression: {{x: "(1-cos(2*pi*t/8))^2"}}}}}}
  foot: {{position: [0, 0, -20], mass: 100}}
cables:
  chain: {{type: chain, from: top, to: foot, length: 20, elements: {elements}}}   # as many as one likes
initial: static
time: {{end: 8, step: {step}}}
output: {{interval: 0.1, history: [foot, chain]}}
"""
ELEMENTS, STEP = 12, 0.02
FINE = 8
BUDGET = 8.0
JOB = pathlib.Path(__file__).resolve().parents[2] / "jobs" / "chart.sh"
# The largest error that a chosen run may have over the accuracy that it was chosen for.
SLACK = 2.0


class ChartBench(Bench):
    def history(self, name, elements, step):
        """A run of this script's own: {column: values}."""
        (self.folder / f"{name}.yaml").write_text(SCENE.format(elements=elements, step=step))
        done = self("run", f"{name}.yaml", "-o", name)
        expect(done.returncode == 0, f"{name}: {elements} elements and steps of {step:.4g} s are solved")
        return self.columns(name)

    def start(self, *words, **variables):
        """A task of a Slurm job."""
        return subprocess.Popen([JOB, *words], cwd=self.folder, env={**ENVIRONMENT, "CABLENET": self.program, **variables}, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)

    def columns(self, run):
        rows = self.rows(run)
        return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}

    def result(self, folder="scene.chart"):
        return yaml.safe_load((self.folder / folder / "chart.yaml").read_text(encoding="utf-8"))


def worst(columns, truth, scales):
    """The error of the worst column: the root of its mean square over time, by the chart's scale."""
    return max(float(numpy.sqrt(numpy.mean((columns[name] - truth[name])[1:] ** 2))) / scale for name, scale in scales.items())


def still(elements):
    """An equilibrium of the scene."""
    moving = 'motion: {expression: {x: "(1-cos(2*pi*t/8))^2"}}'
    text = SCENE.format(elements=elements, step=STEP).replace(moving, "motion: fixed")
    return text.split("time:")[0] + "output: {history: [foot, chain]}\n"


def first_chart(bench):
    (bench.folder / "scene.yaml").write_text(SCENE.format(elements=ELEMENTS, step=STEP))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = bench("chart", "scene.yaml", "--budget", BUDGET, "--accuracy", "0.02", "--write", "chosen.yaml")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(done.stdout + done.stderr)
    bench.said = done.stdout
    expect(done.returncode == 0, "a chart ends with 0")
    expect(all((bench.folder / "scene.chart" / name).stat().st_size > 0 for name in
               ("chart.png", "chart.svg", "chart.csv", "chart.yaml")), "it writes a picture twice, a table and all it knows")
    chart = bench.result()
    expect(all(abs(chart["orders"][kind] - 2) < 0.3 for kind in ("mesh", "step")), f"it observes orders near 2: {chart['orders']}")
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    # Python itself and its drawing take some seconds.
    expect(chart["cpu_s"] <= BUDGET and used <= BUDGET + 10, f"it stays within its budget: {chart['cpu_s']:.1f} s, {used:.1f} s in all")
    expect(len(re.findall(r"^cablenet: run \d+, ", done.stderr, re.MULTILINE)) >= 10, "it tells of each run")
    expect("yours: " in done.stdout and "; for 2 %: elements " in done.stdout, "it says where the scene stands")


def choices_hold(bench):
    truth = bench.history("truth", FINE * ELEMENTS, STEP / FINE)
    chart = bench.result()
    columns = chart["columns"]
    told = [choice for choice in chart["cheapest"] if choice["settings"]]
    expect([choice["accuracy"] for choice in told][:3] == [0.1, 0.02, 0.01], f"{len(told)} accuracies have settings")
    for place, choice in enumerate(told):
        settings = choice["settings"]
        scales = {name: columns[name]["scale"] for name in columns if name not in choice["left_out"]}
        if settings["tolerance_m"] is None:
            found = bench.history(f"chosen_{place}", settings["elements"], settings["step_s"])
            error = worst(found, truth, scales)
            expect(error <= SLACK * choice["accuracy"], f"the settings for {choice['accuracy']} err by {error:.2g}")
    yours = worst(bench.history("yours", ELEMENTS, STEP), truth, {name: columns[name]["scale"] for name in columns})
    expect(abs(yours / chart["yours"]["error_rms"] - 1) < 0.5, f"the scene as written errs by {yours:.2g}, as the chart says")


def written_scene(bench):
    text = (bench.folder / "chosen.yaml").read_text()
    expect("# The comment stays." in text and "# as many as one likes" in text, "the written scene keeps its comments")
    done = bench("check", "chosen.yaml")
    expect(done.returncode == 0 and "valid" in done.stdout, "the written scene is valid")
    expect(bench("run", "chosen.yaml", "-o", "chosen").returncode == 0, "and is solved")
    scales = {name: column["scale"] for name, column in bench.result()["columns"].items()}
    error = worst(bench.columns("chosen"), bench.columns("truth"), scales)
    expect(error <= SLACK * 0.02, f"and errs by {error:.2g} where 0.02 was asked for")


def second_chart(bench):
    runs = bench.folder / "scene.chart" / "runs"
    before = {path: path.stat().st_mtime_ns for path in runs.rglob("*")}
    first = bench.result()
    table = (bench.folder / "scene.chart" / "chart.csv").read_bytes()
    done = bench("chart", "scene.yaml", "--budget", BUDGET, "--accuracy", "0.02")
    expect(done.returncode == 0 and "cablenet: run " not in done.stderr, "a second chart runs nothing")
    expect(before == {path: path.stat().st_mtime_ns for path in runs.rglob("*")}, "and leaves the runs as they are")
    expect(bench.result()["cheapest"] == first["cheapest"], "and finds the same")
    expect((bench.folder / "scene.chart" / "chart.csv").read_bytes() == table, "with the same table of runs")
    kept = min(runs.iterdir(), key=lambda path: path.name)
    (kept / "cost.yaml").unlink()
    done = bench("chart", "scene.yaml", "--budget", BUDGET, "--accuracy", "0.02")
    expect(done.returncode == 0 and len(re.findall("^cablenet: run ", done.stderr, re.MULTILINE)) in (1, 2, 3),
           "a run that is not complete is done again, and no other")


def rows_say_what_they_cover(bench):
    """A row that leaves quantities out names all of them; no error is told to be less than its truth is known to."""
    said = bench.said
    chart = bench.result()
    count = len(chart["columns"])
    for choice in chart["cheapest"]:
        if choice["settings"] and choice["left_out"]:
            left = [line for line in said.splitlines() if line.startswith(f"note: the row of {100 * choice['accuracy']:g} %")]
            expect(len(left) == 1 and f"covers {count - len(choice['left_out'])} of {count}" in left[0]
                   and all(name in left[0] for name in list(choice["left_out"])[:6]), f"the row of {choice['accuracy']} says what it leaves out")
    with open(bench.folder / "scene.chart" / "chart.csv", encoding="utf-8", newline="") as file:
        runs = [row for row in csv.DictReader(file) if row["status"] == "finished"]
    least = {name: min(float(row[f"error_rms {name}"]) for row in runs) for name in chart["columns"]}
    expect(all(least[name] >= 0.999 * column["known_to"] for name, column in chart["columns"].items()), "no run errs by less than is known")


def parts(bench):
    """Parts do the grid side by side; the chart takes their runs, and its budget does not count them."""
    (bench.folder / "still.yaml").write_text(still(ELEMENTS))
    # As Slurm starts the tasks of --array=3-7:4.
    started = [bench.start("still.yaml", SLURM_ARRAY_TASK_ID=task, SLURM_ARRAY_TASK_MIN="3", SLURM_ARRAY_TASK_STEP="4",
                           SLURM_ARRAY_TASK_COUNT="2") for task in ("3", "7")]
    said = [one.communicate(timeout=60)[0] for one in started]
    expect(all(one.returncode == 0 for one in started) and "part 1 of 2: 3 of 3 runs" in said[0] and "part 2 of 2: 2 of 2 runs" in said[1],
           "two parts do the five meshes of an equilibrium")
    expect(not (bench.folder / "still.chart" / "chart.yaml").exists(), "and make no chart")
    before = {path.name for path in (bench.folder / "still.chart" / "runs").iterdir()}
    done = bench("chart", "still.yaml", "--budget", "5")
    expect(done.returncode == 0 and not any(f"run {n}, " in line and "x 4" in line for n in range(1, 4) for line in done.stderr.splitlines()[:1])
           and len(before) == 5, "the chart then takes their runs")
    new = [path for path in (bench.folder / "still.chart" / "runs").iterdir() if path.name not in before]
    spent = sum(sum(yaml.safe_load((path / "cost.yaml").read_text())["process_cpu"]) for path in new)
    repeated = sum(sum(yaml.safe_load((bench.folder / "still.chart" / "runs" / name / "cost.yaml").read_text())["process_cpu"][1:]) for name in before)
    expect(abs(bench.result("still.chart")["cpu_s"] - spent - repeated) < 1e-6, "and its budget does not count them")


def nets(bench):
    (bench.folder / "net.yaml").write_text("""cable_types: {twine: {diameter: 0.01, mass_per_length: 0.1, axial_stiffness: 1.0e4}}
nets: {panel: {type: twine, corners: [[0, 0, 0], [1, 0, 0], [1, 0, -1], [0, 0, -1]], meshes: [2, 2], fixed: [top]}}
points: {top: {position: [2, 0, 0], motion: fixed}, foot: {position: [2, 0, -1], mass: 1}}
cables: {rope: {type: twine, from: top, to: foot, length: 1, elements: 8}}
initial: static
output: {history: [foot, rope]}
""")
    done = bench("chart", "net.yaml", "--budget", "5")
    expect("note: nets are as written in all runs" in done.stdout, f"a chart with a net says that its meshes stay {done.stderr if done.returncode else ''}")


def signals(bench):
    """A chart that is ended keeps what it has, and leaves no run behind."""
    chart = subprocess.Popen([bench.program, "chart", "scene.yaml", "-o", "ended"], cwd=bench.folder, stderr=subprocess.PIPE, text=True,
                             env=ENVIRONMENT)
    while "run 4," not in chart.stderr.readline():
        pass
    chart.terminate()
    said = chart.communicate(timeout=60)[1]
    expect(chart.returncode == 5 and said.count("cablenet: error: stopped; the finished runs are kept") == 1, "a chart that is ended says so")
    runs = list((bench.folder / "ended" / "runs").iterdir())
    expect(len([run for run in runs if (run / "cost.yaml").exists()]) >= 3, "its finished runs are kept, three at least")


def small_budgets(bench):
    done = bench("chart", "scene.yaml", "-o", "tiny", "--budget", "0.3")
    expect(done.returncode == 2 and done.stderr.count("cablenet: error: a budget of 0.3 s is too small") == 1
           and "--budget" in done.stderr, "a budget that is too small is told, with one that is not")
    advised = done.stderr.rsplit("--budget ", 1)[1].split()[0]
    done = bench("chart", "scene.yaml", "-o", "tiny", "--budget", advised)
    expect(done.returncode == 0 and re.search(r"^10 %  +\d", done.stdout, re.MULTILINE), f"with the advised {advised} s there is a chart")
    done = bench("chart", "still.yaml", "--budget", "5", "--accuracy", "1e-9", "--write", "none.yaml")
    expect(done.returncode == 3 and not (bench.folder / "none.yaml").exists(), "settings that nothing reaches are not written")
    budget = 0.6 * bench.result()["cpu_s"]
    done = bench("chart", "scene.yaml", "-o", "cut", "--budget", budget)
    expect(done.returncode == 0 and bench.result("cut")["cpu_s"] <= budget and "cut off by the budget" in done.stdout,
           f"a small budget cuts ladders off, holds, and is told {done.stderr if done.returncode else ''}")


def wrong_words(bench):
    (bench.folder / "file").write_text("")
    (bench.folder / "crowded" / "chart.svg").mkdir(parents=True)
    (bench.folder / "wrong.yaml").write_text(SCENE.format(elements=0, step=STEP))
    (bench.folder / "bars.yaml").write_text(still(1))
    for words, status, part in ((("bars.yaml",), 2, "nothing to chart"), (("scene.yaml", "--budget", "-1"), 2, "--budget"), (("scene.yaml", "--budget", "much"), 2, "--budget"),
                                (("scene.yaml", "--accuracy", "2"), 2, "--accuracy"), (("scene.yaml", "--ranks", "0"), 2, "--ranks"),
                                (("scene.yaml", "--write", "x.yaml"), 2, "--accuracy"), (("--schemes", "euler", "scene.yaml"), 2, "euler"), (("--schemes", "plain,", "scene.yaml"), 2, "--schemes"),
                                (("scene.yaml", "--part", "3/2"), 2, "--part"), (("scene.yaml", "--part", "1/2", "--accuracy", "0.1", "--write", "x.yaml"), 2, "--part"),
                                (("scene.yaml", "--accuracy", "0.1", "--write", "chosen.yaml"), 2, "--overwrite"), (("scene.yaml", "-o", "crowded"), 4, "chart.svg"),
                                (("scene.yaml", "--accuracy", "0.1", "--write", "scene.yaml"), 2, "the scene itself"),
                                (("scene.yaml", "-ts_dt", "1"), 2, "-ts_dt"), ((), 2, "SCENE"), (("absent.yaml",), 2, "absent.yaml"),
                                (("wrong.yaml",), 2, "elements"), (("scene.yaml", "-o", "file"), 4, "file"),
                                (("scene.yaml", "--accuracy", "0.1", "--write", "no/x.yaml"), 4, "no/x.yaml")):
        before = sorted(bench.folder.iterdir())
        done = bench("chart", *words)
        expect(done.returncode == status and part in done.stderr and done.stderr.count("cablenet: error: ") == 1
               and "Traceback" not in done.stderr, f"chart {' '.join(words)} ends with {status} and one message")
        expect(sorted(bench.folder.iterdir()) == before, "and writes nothing")
    done = bench("chart", "scene.yaml", CABLENET_PYTHON="/nowhere/python3")
    expect(done.returncode == 2 and "/nowhere/python3" in done.stderr and "CABLENET_PYTHON" in done.stderr, "a missing Python is told")
    poor = bench.folder / "poor"
    poor.write_text(f"#!/bin/sh\nexec {sys.executable} -S \"$@\"\n")
    poor.chmod(0o755)
    done = bench("chart", "scene.yaml", CABLENET_PYTHON=str(poor))
    expect(done.returncode == 2 and done.stderr.count("\n") == 1 and "Python's module" in done.stderr, "a missing module is told")
    done = bench("chart", "scene.yaml", PMIX_RANK="0")
    expect(done.returncode == 2 and "--ranks N" in done.stderr, "a chart that mpirun starts is refused")
    expect("--budget" in bench("chart", "--help").stdout and "chart" in bench("--help").stdout, "help tells of it")


def main():
    given = arguments(__doc__)
    bench = ChartBench(given.program, given.scratch, timeout=300)
    os.environ.setdefault("MPLCONFIGDIR", str(given.scratch / "matplotlib"))
    for part in (first_chart, rows_say_what_they_cover, choices_hold, written_scene, second_chart, parts, nets, signals, small_budgets, wrong_words):
        part(bench)
    return status()


if __name__ == "__main__":
    sys.exit(main())
