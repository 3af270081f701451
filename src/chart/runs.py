"""Runs of the ladder: each has a folder, is run once, and is kept.  The budget counts all of them."""
import dataclasses
import hashlib
import math
import os
import pathlib
import resource
import shutil
import signal
import subprocess

import yaml

import history
import messages
from files import write_whole
from scene_text import LOADER

FINISHED, FAILS, REFUSED, TOO_DEAR = "finished", "fails", "refused", "too dear"

# A run's time of computing is measured so often where it is short [s].
REPETITIONS, SHORT = 3, 1.5

# What a chart does not need of a run's results.
FRAMES = ("*.h5", "*.xmf")


@dataclasses.dataclass
class Run:
    settings: object
    folder: pathlib.Path
    status: str
    message: str = ""
    # s, of each repetition: of the whole process on all ranks, and of statics and steps on the slowest rank
    process_cpu: list = dataclasses.field(default_factory=list)
    solve_cpu: list = dataclasses.field(default_factory=list)
    newton: int = 0
    steps: int = 0
    elements: int = 0
    is_of_part: bool = False                        # a part of the grid was spread, and the budget does not count it
    times: object = None
    columns: dict = dataclasses.field(default_factory=dict)

    @property
    def is_finished(self):
        return self.status == FINISHED

    # What is decided goes by first measurements: a chart that goes on decides alike, whatever was repeated at its end.
    @property
    def first_cost(self):
        return self.solve_cpu[0]

    @property
    def cost(self):
        """The least time that was measured [s]; less than half of the median is an error of the machine's clock."""
        times = sorted(self.solve_cpu)
        return next(value for value in times if value >= 0.5 * times[len(times) // 2])


class Runner:
    """Does runs, and knows what they have cost.
    @param program  words that start cablenet, mpirun's before them"""

    def __init__(self, program, variants, folder, budget, progress, is_part=False):
        self.program, self.variants, self.folder = program, variants, folder
        self.budget, self.progress, self.is_part = budget, progress, is_part
        self.all = {}
        built = os.stat(program[-1])
        self.version = f"{built.st_size} bytes of {built.st_mtime_ns}"
        # An array of threads in BLAS would cost more CPU than it saves.
        self.environment = {"OMP_NUM_THREADS": "1", **os.environ}

    def _counted(self, run):
        """What the budget counts of a run: [s] of each repetition."""
        return run.process_cpu[1:] if run.is_of_part and not self.is_part else run.process_cpu

    @property
    def spent(self):
        return sum(sum(self._counted(run)) for run in self.all.values())

    @property
    def left(self):
        """For new runs.  Repetitions come after them, so that a chart that goes on with both decides as before."""
        return self.budget - sum(sum(self._counted(run)[:1]) for run in self.all.values())

    @property
    def finished(self):
        return [run for run in self.all.values() if run.is_finished]

    def expected_cpu(self, settings):
        """What a run will take [s]: the time of the run with the next less work, and more by the ratio of the work.
        Nothing is known before the first run."""
        known = sorted((self.work(run.settings), run.process_cpu[0]) for run in self.finished)
        if not known:
            return 0.0
        start = max(0.0, min(run.process_cpu[0] - run.first_cost for run in self.finished))
        work = self.work(settings)
        done, cpu = max((pair for pair in known if pair[0] <= work), default=known[0])
        return start + (cpu - start) * max(1.0, work / done)

    def work(self, settings):
        """Elements times steps; a tolerance's steps are those of its order, 2."""
        elements = max(1, self.variants.count(settings.mesh))
        stepping = settings.stepping
        if stepping is None:
            return elements
        if stepping.tolerance is not None:
            own = [run for run in self.finished if run.settings.stepping.tolerance is not None]
            if own:
                near = min(own, key=lambda run: run.settings.stepping.tolerance)
                return elements * near.steps * max(1.0, near.settings.stepping.tolerance / stepping.tolerance) ** 0.5
        return elements * (self.variants.end - self.variants.start) / stepping.step

    def run(self, settings, limit=math.inf):
        """The run with these settings, done now or kept.
        @param limit  what it may take [s]; one that takes more, or more than is left, is TOO_DEAR and not done"""
        before = self.all.get(settings)
        if before is not None and (before.status != TOO_DEAR or before.process_cpu):
            return before
        text = self.variants.run_text(settings)
        folder = self.folder / "runs" / name_of(settings)
        found = self._kept(settings, folder, text)
        if found is None:
            found = Run(settings, folder, TOO_DEAR)
            if self.expected_cpu(settings) <= min(limit, self.left):
                self._start(found, text)
        self.all[settings] = found
        return found

    def take_of_parts(self, grid):
        """Takes the runs of a grid that parts have left."""
        for settings in grid:
            run = self._kept(settings, self.folder / "runs" / name_of(settings), self.variants.run_text(settings))
            if run is not None and run.is_of_part:
                self.all[settings] = run

    def repeat(self, run):
        """Measures a short run's time again, while the budget has room."""
        if not run.is_finished:
            return
        first = run.process_cpu[0]
        while len(run.process_cpu) < REPETITIONS and first < SHORT and 2 * first < self.budget - self.spent:
            self._start(run, self.variants.run_text(run.settings))

    def _start(self, run, text):
        messages.Signals.obey()
        self.progress.show(self.spent, self.budget, describe(run.settings))
        shutil.rmtree(run.folder, ignore_errors=not run.folder.exists())
        run.folder.mkdir(parents=True)
        (run.folder / "scene.yaml").write_text(text, encoding="utf-8")
        limit = self._limit()
        with open(run.folder / "log.txt", "w", encoding="utf-8") as log:
            process = subprocess.Popen(
                [*self.program, "run", "scene.yaml", "-o", "."], cwd=run.folder, stdout=log, stderr=log,
                env=self.environment, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
            status, used = wait_for(process)
        run.process_cpu.append(round(used.ru_utime + used.ru_stime, 4))
        self._conclude(run, status)
        for pattern in FRAMES:
            for path in run.folder.glob(pattern):
                path.unlink()
        self._keep(run, text)

    def _limit(self):
        """What the system lets a run take [s]; it counts whole seconds."""
        return max(1, int(self.left))

    def _conclude(self, run, status):
        """Takes what a run has left behind."""
        run.status = {0: FINISHED, 2: REFUSED, 3: FAILS}.get(status, TOO_DEAR if status < 0 else None)
        if run.status != FINISHED:
            run.message = error_in(run.folder / "log.txt")
        if run.status is None:
            raise messages.Refusal(f"{run.message or f'a run ends with status {status}'} (see {run.folder}/log.txt)",
                                   messages.NO_OUTPUT if status == 4 else messages.NO_SOLUTION)
        if run.status == FINISHED:
            report = yaml.load((run.folder / "run.yaml").read_text(encoding="utf-8"), Loader=LOADER)
            run.solve_cpu.append(sum(computing_time(report, phase) for phase in ("statics", "solve")))
            run.newton, run.steps, run.elements = report["newton_iterations"], report["steps"], report["elements"]
            if report["scheme"] == "static":
                run.newton = report["statics"]["iterations"]
            run.times, run.columns = history.read(run.folder / "history.csv")

    def _keep(self, run, text):
        run.is_of_part = run.is_of_part or self.is_part
        kept = {**self._identity(text), "status": run.status, "message": run.message, "process_cpu": run.process_cpu,
                "solve_cpu": run.solve_cpu, "part": run.is_of_part}
        write_whole(run.folder / "cost.yaml", yaml.safe_dump(kept))

    def _identity(self, text):
        """What a kept run must have in common with one that is wanted."""
        scene = hashlib.sha256(text.encode()).hexdigest()
        return {"program": self.version, "command": self.program[:-1], "scene": scene}

    def _kept(self, settings, folder, text):
        """The run that an earlier chart has left in this folder; None where it is another one, or unfinished."""
        try:
            kept = yaml.safe_load((folder / "cost.yaml").read_text(encoding="utf-8"))
        except (OSError, yaml.YAMLError):
            return None
        wanted = self._identity(text)
        if not isinstance(kept, dict) or {key: kept.get(key) for key in wanted} != wanted:
            return None
        if kept["status"] == TOO_DEAR and kept["process_cpu"][0] < 0.9 * self._limit():
            return None
        run = Run(settings, folder, kept["status"], kept["message"], kept["process_cpu"], is_of_part=kept.get("part", False))
        if run.is_finished:
            self._conclude(run, 0)
            run.solve_cpu = kept["solve_cpu"]
        return run


def wait_for(process):
    """@returns the exit status, negative where a signal has ended it, and what it has used"""
    try:
        _, status, used = os.wait4(process.pid, 0)
    except KeyboardInterrupt:
        process.send_signal(signal.SIGTERM)
        os.wait4(process.pid, 0)
        raise
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used


def computing_time(report, phase):
    """CPU seconds of a phase; where it is so short that their clock shows nothing, seconds of the wall's clock."""
    return float(report["cpu_seconds"][phase]) or float(report["wall_seconds"][phase])


def describe(settings):
    return f"elements {messages.multiple(settings.mesh)}, {messages.stepping_text(settings.stepping)}" + (
        f", {settings.stepping.scheme}" if settings.stepping and settings.stepping.scheme else "")


def name_of(settings):
    """The name of a run's folder."""
    mesh = f"elements_{float(settings.mesh):.6g}"
    stepping = settings.stepping
    if stepping is None:
        return mesh
    way = f"step_{stepping.step:.8g}" if stepping.tolerance is None else f"tolerance_{stepping.tolerance:.8g}"
    return "_".join(filter(None, (mesh, way, stepping.scheme)))


def error_in(path):
    """What the program said of its failure."""
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    mark = "cablenet: error: "
    found = next((line for line in lines if line.startswith(mark)), None)
    return found.removeprefix(mark).split(". ")[0] if found else (lines[-1] if lines else "")
