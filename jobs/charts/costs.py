"""Reads runs with their errors and costs, and compares the cheapest runs of two programs at an accuracy."""
import csv
import pathlib
from dataclasses import asdict, dataclass, fields, replace

FOLDER = pathlib.Path(__file__).resolve().parent
OURS, THEIRS = "cablenet", "MoorDyn-C"
# CPU time of a step of the hand-written chain with 24 elements on the machine of the stored figures [us].
STORED_PACE = 2.95
ACCURACIES = (0.01, 0.001, 0.0001)
CASES = {"free_fall": "free fall", "tow_turn": "tow and turn", "chain": "mooring chain in waves", "buoy": "moored buoy"}


@dataclass(frozen=True)
class Cost:
    """@param step  in seconds, or the tolerance of adaptive steps in metres   @param error  relative
    @param cpu_stepping  CPU time of the steps alone, cpu_whole of the process [s]"""
    case: str
    measure: str
    program: str
    scheme: str
    elements: int
    step: float
    error: float
    cpu_stepping: float
    cpu_whole: float


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return [Cost(row["case"], row["measure"], row["program"], row["scheme"], int(row["elements"]),
                     float(row["step"] or "nan"), *(float(row[key]) for key in ("error", "cpu_stepping", "cpu_whole")))
                for row in csv.DictReader(file)]


def write(path, runs):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, [field.name for field in fields(Cost)], lineterminator="\n")
        writer.writeheader()
        for run in runs:
            writer.writerow({key: f"{value:.5g}" if isinstance(value, float) else value
                             for key, value in asdict(run).items()})


def stored_runs():
    return without_luck(read(FOLDER / "runs.csv"))


def without_luck(runs):
    """The runs with no less error than the same mesh and scheme has with its finest steps.  Where the error of long steps
    and that of a coarse mesh cancel, nobody could have known."""
    finest = {}
    for run in sorted(runs, key=lambda run: -run.step):
        finest[mesh_of(run)] = run.error
    return [replace(run, error=max(run.error, finest[mesh_of(run)])) for run in runs]


def mesh_of(run):
    return run.case, run.measure, run.program, run.scheme, run.elements


def stored_statics():
    """{case: [(error, cpu_statics, cpu_whole)]}.  An error is the distance from the value that two meshes of the stored
    ones extrapolate to, over that value."""
    with open(FOLDER / "statics.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    found = {}
    for row in rows:
        value = float(row["joint_z"] or row["force_x"])
        found.setdefault(row["case"], []).append(
            (int(row["elements"]), value, float(row["cpu_statics"]), float(row["cpu_whole"])))
    return {case: errors_of(sorted(values)) for case, values in found.items()}


def errors_of(values):
    (coarse, second, *_), (fine, last, *_) = values[-2:]
    limit = last + (last - second) / ((fine / coarse) ** 2 - 1)
    return [(abs(value / limit - 1), statics, whole) for _, value, statics, whole in values[:-1]]


def scaled(runs, factor):
    """The runs with their costs as on a machine that takes `factor` times as long."""
    return [replace(run, cpu_stepping=run.cpu_stepping * factor, cpu_whole=run.cpu_whole * factor) for run in runs]


def peers(runs):
    return [run for run in runs if run.program != OURS]


def select(runs, case, measure, program):
    return [run for run in runs if (run.case, run.measure, run.program) == (case, measure, program)]


def measures(runs):
    """The pairs of case and measure, in the order of the table."""
    return list(dict.fromkeys((run.case, run.measure) for run in runs))


def front(runs, cost):
    """The runs that none has less error at less cost than, from the cheapest on."""
    best = []
    for run in sorted(runs, key=lambda run: (getattr(run, cost), run.error)):
        if not best or run.error < best[-1].error:
            best.append(run)
    return best


def cheapest(runs, accuracy, cost):
    """None where no run is as accurate."""
    return min((getattr(run, cost) for run in runs if run.error <= accuracy), default=None)


def ratio(runs, case, measure, accuracy, cost):
    """The other program's cheapest over ours; None where one of them has no run as accurate as that."""
    ours, theirs = (cheapest(select(runs, case, measure, program), accuracy, cost) for program in (OURS, THEIRS))
    return theirs / ours if ours and theirs else None


def ratios(runs, cost):
    """{(case, measure, accuracy): ratio} of what was measured; nothing is extrapolated."""
    found = {(*key, accuracy): ratio(runs, *key, accuracy, cost) for key in measures(runs) for accuracy in ACCURACIES}
    return {key: value for key, value in found.items() if value}


def told(runs, whose):
    """The ratios as a table."""
    stepping, whole = (ratios(runs, cost) for cost in ("cpu_stepping", "cpu_whole"))
    lines = [f"{THEIRS}'s CPU time over cablenet's, {whose} runs", f"{'case':40} accuracy  stepping  whole process"]
    lines += [f"{CASES[case] + ', ' + measure:40} {100 * accuracy:6g} %  {stepping[case, measure, accuracy]:8.3g}  {value:8.3g}"
              for (case, measure, accuracy), value in whole.items()]
    return "\n".join(lines) + "\n"
