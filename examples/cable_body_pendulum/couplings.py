"""couplings.py DIR: draws DIR/couplings.png, what the three couplings do in the runs DIR/scene, DIR/link and DIR/bar; prints
how far each is from the exact motion with a hinge, and how much energy.total changes."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "jobs"))
from plot import largest_difference, plt, read_table    # noqa: E402

import numpy                                            # noqa: E402

COUPLINGS = (("scene", "kinematic", "-"), ("link", "rigid_link", "--"), ("bar", "bar", "-"))


def add_angles(table):
    """Of the line from the pin to the centre of gravity, and the turn of the body against it [rad]."""
    table["phi"] = numpy.arctan2(table["cube.x"], -table["cube.z"])
    table["turn"] = -2 * numpy.arctan2(table["cube.qy"], table["cube.qw"]) - table["phi"]


def main():
    folder = pathlib.Path(sys.argv[1])
    exact = read_table(HERE / "reference.csv")
    figure, (angle, turn, energy) = plt.subplots(3, 1, sharex=True, figsize=(11, 9))
    for name, label, style in COUPLINGS:
        run = read_table(folder / name / "history.csv")
        add_angles(run)
        off = run["phi"] - numpy.interp(run["time"], exact["time"], exact["phi"])
        change = run["energy.total"] - run["energy.total"][0]
        at = numpy.isin(numpy.round(run["time"], 6), numpy.round(exact["time"], 6))
        angle.plot(run["time"][at], off[at], style, label=label)
        turn.plot(run["time"], numpy.degrees(run["turn"]), style)
        energy.plot(run["time"], change, style)
        print(f"{label}: phi at most {largest_difference(run, exact, 'phi'):.3g} rad from the hinge's, the body's turn at most "
              f"{numpy.degrees(numpy.abs(run['turn']).max()):.3g} degrees, energy.total changes by up to "
              f"{numpy.abs(change).max():.3g} J")
    angle.set_ylabel("angle less that\nwith a hinge [rad]")
    turn.set_ylabel("turn of the body against\nthe line from the pin [deg]")
    energy.set_ylabel("change of\nenergy.total [J]")
    for axes in (angle, turn, energy):
        axes.grid(alpha=0.3)
    angle.legend(loc="upper left", bbox_to_anchor=(1.01, 1))
    angle.set_title("Cable-body pendulum: three couplings")
    energy.set_xlabel("time [s]")
    figure.savefig(folder / "couplings.png", dpi=110, bbox_inches="tight")
    print(folder / "couplings.png")


main()
