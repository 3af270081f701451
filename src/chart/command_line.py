"""cablenet chart SCENE [options]: reads the command line, and refuses what makes no sense."""
import argparse
import dataclasses
import pathlib

from messages import Refusal

SCHEMES = ("energy_momentum", "generalized_alpha", "plain")

ABOUT = """Charts the cost of a scene over its accuracy: runs it with more and fewer elements, longer and shorter steps,
and tells the cheapest settings for 10, 1, 0.1 and 0.01 % of the range of each history quantity."""

END = """Finished runs are kept in DIR and not done again. Exit status: 0 done, 2 the scene or the command line is
wrong, or the budget too small, 3 no settings reach what was asked for, 4 output could not be written, 5 stopped by a
signal."""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Refusal(f"{message}; see cablenet chart --help")


def number(kind, is_allowed, expected):
    """Reads a number, or says what is allowed."""
    def read(text):
        try:
            value = kind(text)
        except ValueError:
            value = None
        if value is None or not is_allowed(value):
            raise argparse.ArgumentTypeError(f"{text} is not allowed; expected {expected}")
        return value
    return read


SECONDS = number(float, lambda value: 0 < value < float("inf"), "a number of seconds > 0")
SHARE = number(float, lambda value: 0 < value < 1, "a share of the range between 0 and 1, as 0.01")
RANKS = number(int, lambda value: value >= 1, "an integer >= 1")


def schemes(text):
    names = text.split(",")
    for name in names:
        if name not in SCHEMES:
            raise argparse.ArgumentTypeError(f"{name or 'nothing'} is not a scheme; expected {', '.join(SCHEMES)}, with "
                                             "commas between")
    return list(dict.fromkeys(names))


@dataclasses.dataclass(frozen=True)
class Part:
    number: int
    count: int

    @property
    def text(self):
        return f"{self.number} of {self.count}"


def part(text):
    number, mark, count = text.partition("/")
    if not (mark and number.isdecimal() and count.isdecimal() and 1 <= int(number) <= int(count)):
        raise argparse.ArgumentTypeError(f"{text} is not allowed; expected I/N, two integers with 1 <= I <= N, as 2/8")
    return Part(int(number), int(count))


def parse(words):
    parser = Parser(prog="cablenet chart", description=ABOUT, epilog=END, allow_abbrev=False)
    parser.add_argument("scene", metavar="SCENE", type=pathlib.Path, help="the scene, a YAML file")
    parser.add_argument("-o", metavar="DIR", dest="folder", type=pathlib.Path,
                        help="folder for the runs and the chart; default: SCENE's name with .chart, where you are")
    parser.add_argument("--budget", metavar="S", type=SECONDS, default=50.0,
                        help="CPU seconds for all runs together, those that are kept included; ladders are cut from "
                        "their dear end (default: 50)")
    parser.add_argument("--accuracy", metavar="A", type=SHARE, help="one more row of the table, as 0.01 for 1 %%")
    parser.add_argument("--write", metavar="SCENE2", type=pathlib.Path,
                        help="write the scene with the cheapest settings for --accuracy")
    parser.add_argument("--overwrite", action="store_true", help="let --write replace a file")
    parser.add_argument("--schemes", metavar="NAME,...", type=schemes, default=[],
                        help="chart these schemes, too, with commas between: " + ", ".join(SCHEMES))
    parser.add_argument("--ranks", metavar="N", type=RANKS, default=1, help="ranks of each run, started by mpirun")
    parser.add_argument("--part", metavar="I/N", type=part, help="do part I of N of the runs, and no chart: the parts may "
                        "run side by side, as a Slurm array; the same command without --part then makes the chart. "
                        "--budget is that of each part")
    given = parser.parse_args(words)
    if given.part and given.write:
        parser.error("--part makes no chart, so that there is nothing to --write")
    if given.write and given.accuracy is None:
        parser.error("--write needs --accuracy, which says what settings are wanted")
    if given.write and given.write.exists() and given.scene.exists() and given.write.samefile(given.scene):
        parser.error(f"--write {given.write} is the scene itself; name another file")
    if given.write and given.write.is_file() and not given.overwrite:
        parser.error(f"--write {given.write} is there already; name another file, or give --overwrite")
    if given.folder is None:
        given.folder = pathlib.Path(given.scene.stem + ".chart")
    return given
