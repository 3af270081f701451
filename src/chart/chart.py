"""The chart of a scene, from the check of the scene to the files."""
import contextlib
import fcntl
import os
import shutil
import subprocess
import sys

import yaml

import picture
import records
import table
from choice import Chooser
from files import write_whole
from findings import Findings
from messages import NO_OUTPUT, NO_SOLUTION, Progress, Refusal, percent
from runs import Runner
from scene_text import SceneText
from spread import own_part, run_part
from survey import Survey
from variants import Variants

OUTPUTS = ("chart.png", "chart.svg", "chart.csv", "chart.yaml")
ACCURACIES = (0.1, 0.01, 0.001, 0.0001)


def read_scene(program, path):
    """The scene's text; the program itself says what is wrong with it."""
    named = f"./{path}" if str(path).startswith("-") else str(path)
    done = subprocess.run([program, "check", named], capture_output=True, text=True, errors="replace")
    if done.returncode:
        print(done.stderr, end="", file=sys.stderr)
        raise SystemExit(done.returncode)
    try:
        return SceneText(path.read_text(encoding="utf-8"))
    except UnicodeDecodeError:
        raise Refusal(f"{path} is not in UTF-8: save it as UTF-8") from None
    except yaml.YAMLError as error:
        words = " ".join(str(error).split())
        raise Refusal(f"{path}: Python's reader of YAML does not understand it: {words}") from error


def launcher(program, ranks):
    if ranks == 1:
        return [program]
    if not shutil.which("mpirun"):
        raise Refusal(f"--ranks {ranks} needs mpirun, which is not in the path")
    return ["mpirun", "-n", str(ranks), program]


def check_outputs(given):
    """Refuses before the first run what could not be written after the last one."""
    for name in OUTPUTS:
        if (given.folder / name).is_dir():
            raise Refusal(f"{given.folder / name} is a folder, and the chart writes a file of that name; move it away", NO_OUTPUT)
    if given.write is None:
        return
    if given.write.is_dir():
        raise Refusal(f"--write {given.write} is a folder; name a file", NO_OUTPUT)
    if not (given.write.resolve().parent.is_dir() and os.access(given.write.resolve().parent, os.W_OK)):
        raise Refusal(f"--write {given.write} cannot be written: there is no such folder, or no right to it", NO_OUTPUT)


@contextlib.contextmanager
def own_folder(folder, shared):
    """Makes the chart's folder, and keeps other charts out of it; parts of one chart share it."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = open(folder / ".lock", "w", encoding="utf-8")
    except OSError as error:
        raise Refusal(f"{folder} cannot be written: {error.strerror}", NO_OUTPUT) from None
    with lock:
        try:
            fcntl.flock(lock, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Refusal(f"another chart, or a part of one, is at work in {folder}", NO_OUTPUT) from None
        yield


def make_chart(program, given):
    scene = read_scene(program, given.scene)
    check_outputs(given)
    variants = Variants(scene)
    if variants.is_open:
        raise Refusal(f"{given.scene} leaves elements or the step to `accuracy`, and a chart starts from both: run the scene, "
                      "and give those that its run.yaml names")
    if variants.is_static and not variants.has_meshes:
        raise Refusal(f"{given.scene} has nothing to chart: an equilibrium has no steps, and no cable has more than one "
                      "element" + (" (a net's meshes are its own)" if scene.names("nets") else ""))
    with own_folder(given.folder, shared=given.part is not None):
        progress = Progress()
        runner = Runner(launcher(program, given.ranks), variants, given.folder.resolve(), given.budget, progress,
                        is_part=given.part is not None)
        survey = Survey(runner, variants, given.schemes)
        if given.part:
            return do_part(runner, survey, given, progress)
        try:
            runner.take_of_parts(survey.grid())
            survey.explore()
            wanted = sorted({*ACCURACIES, *filter(None, [given.accuracy])}, reverse=True)
            chooser = Chooser(survey, wanted)
            choices = chooser.choose_all()
            for run in [choice.run for choice in choices if choice.run] + [runner.all[survey.own]]:
                runner.repeat(run)
        finally:
            progress.finish()
        findings = Findings(given, survey, chooser, choices)
        records.write(findings)
        picture.draw(findings)
        print(table.text(findings))
        return write_scene(given, findings) if given.write else 0


def do_part(runner, survey, given, progress):
    with own_part(given.folder, given.part):
        try:
            said = run_part(runner, survey.grid(), given.part)
        finally:
            progress.finish()
        print(said)
    return 0


def write_scene(given, findings):
    choice = findings.choice(given.accuracy)
    if choice.run is None:
        raise Refusal(f"--accuracy {given.accuracy:g}: {findings.why_not(choice)}; {given.write} is not written",
                      NO_SOLUTION)
    head = (f"# By cablenet chart: {percent(choice.error)} of the range of {choice.column}, the worst quantity, "
            f"for {percent(given.accuracy)}.\n")
    text = findings.survey.variants.written_text(choice.run.settings)
    if given.write.exists() and not given.overwrite:
        raise Refusal(f"--write {given.write} has come to be meanwhile; it is left as it is", NO_OUTPUT)
    write_whole(given.write, head + text)
    print(f"{given.write}: the scene with these settings")
    return 0
