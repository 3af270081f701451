"""Parts of a chart's runs, for machines that do many at once: the grid of all meshes and steps, dealt out.

Each part does its share from the cheap end, within a budget of its own.  A chart in the same folder then takes what it needs.
"""
import contextlib
import fcntl

from messages import NO_OUTPUT, Refusal, counted
from runs import TOO_DEAR


@contextlib.contextmanager
def own_part(folder, part):
    """Keeps a second start of the same part out."""
    with open(folder / f".lock_part_{part.number}_of_{part.count}", "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Refusal(f"part {part.text} is at work in {folder} already", NO_OUTPUT) from None
        yield


def run_part(runner, grid, part):
    """Does the runs of a part; the next dearer ones are in other parts, so that all take about as long."""
    mine = sorted(grid, key=runner.work)[part.number - 1::part.count]
    for settings in mine:
        if runner.run(settings).status == TOO_DEAR:
            break
    done = len(runner.finished)
    return (f"part {part.text}: {done} of {counted(len(mine), 'run')}, {runner.spent:.3g} s of CPU, in {runner.folder}; "
            "when all parts have ended, the same command without --part makes the chart")
