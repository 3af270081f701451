"""The charts of README.md: stored figures are read, scaled and compared, and both pictures are drawn from them alone."""
import pathlib
import subprocess
import sys

from bench import arguments, expect, status

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "jobs" / "charts")]
import costs   # noqa: E402

MOST_BYTES = 150000


def cost(program, elements, step, error, cpu):
    return costs.Cost("tow_turn", "tail", program, "default", elements, step, error, cpu, 2 * cpu)


def check_figures():
    ours = [cost(costs.OURS, 10, 1, 0.0001, 1), cost(costs.OURS, 10, 0.1, 0.005, 3), cost(costs.OURS, 20, 0.1, 0.0005, 4)]
    runs = costs.without_luck(ours + [cost(costs.THEIRS, 10, 0.1, 0.0009, 40)])
    expect(runs[0].error == 0.005, "an error that is smaller by luck counts as that of its mesh")
    expect(costs.ratio(runs, "tow_turn", "tail", 0.001, "cpu_stepping") == 10, "the cheapest runs at 0.1 % are compared")
    expect(costs.ratio(runs, "tow_turn", "tail", 0.0001, "cpu_stepping") is None, "nothing is extrapolated")
    half = costs.scaled(runs, 0.5)
    expect([run.cpu_whole for run in half] == [run.cpu_whole / 2 for run in runs], "costs are scaled")
    expect([run.elements for run in costs.front(runs[:3], "cpu_stepping")] == [10, 20], "a front has ever less error")


def check_pictures(folder):
    done = subprocess.run(["bash", ROOT / "jobs" / "charts.sh", "--stored", "-o", folder], capture_output=True, text=True)
    expect(done.returncode == 0, f"charts.sh --stored ends well {done.stderr[-500:]}")
    for name in "error_over_cost.png", "stability.png":
        shown = ROOT / "jobs" / "charts" / name
        drawn = (folder / name).read_bytes() if (folder / name).exists() else b""
        expect(drawn[:8] == b"\x89PNG\r\n\x1a\n" and 20000 < len(drawn) <= MOST_BYTES, f"{name} has {len(drawn)} bytes")
        expect(shown.stat().st_size <= MOST_BYTES, f"the stored {name} is small")


given = arguments(__doc__)
check_figures()
check_pictures(given.scratch)
sys.exit(status())
