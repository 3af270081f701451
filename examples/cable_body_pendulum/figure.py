"""figure.py RUN_DIR: draws RUN_DIR/picture.png, the cube's angle about the pin with its rates, and its position, beside
two references; prints the largest differences from them."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "jobs"))
from plot import largest_difference, plt, read_table    # noqa: E402

import numpy                                            # noqa: E402

PANELS = (("theta [deg]", "phi", lambda phi: 90 + numpy.degrees(phi)), ("angular velocity [rad/s]", "omega", None),
          ("angular acceleration [rad/s$^2$]", "alpha", None), ("X [m]", "cube.x", None), ("Y [m]", "cube.z", None))


def add_angle(table):
    """phi from the downward vertical, positive towards +x, and its rates, of the centre of gravity."""
    x, z = table["cube.x"], table["cube.z"]
    vx, vz = table["cube.vx"], table["cube.vz"]
    square = x**2 + z**2
    table["phi"] = numpy.arctan2(x, -z)
    table["omega"] = (x * vz - z * vx) / square
    table["alpha"] = (x * table["cube.az"] - z * table["cube.ax"]) / square - 2 * table["omega"] * (x * vx + z * vz) / square


def main():
    run = pathlib.Path(sys.argv[1])
    history = read_table(run / "history.csv")
    multibody = read_table(HERE / "reference.csv")
    simple = {name: multibody["simple." + name.removeprefix("cube.")] for _, name, _ in PANELS}
    simple["time"] = multibody["time"]
    add_angle(history)

    figure, places = plt.subplots(len(PANELS), 1, sharex=True, figsize=(11, 13))
    for axes, (label, name, shown) in zip(places, PANELS):
        shown = shown or (lambda values: values)
        axes.plot(history["time"], shown(history[name]), label="cablenet")
        axes.plot(multibody["time"], shown(multibody[name]), ".", color="black", markersize=5, label="rod and body, exact")
        axes.plot(simple["time"], shown(simple[name]), "--", linewidth=1, label="simple pendulum, exact")
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
        print(f"{name}: at most {largest_difference(history, multibody, name):.3g} from rod and body, "
              f"{largest_difference(history, simple, name):.3g} from the simple pendulum")
    places[0].legend(loc="upper left", bbox_to_anchor=(1.01, 1))
    places[0].set_title("Cable-body pendulum: the cube's centre of gravity")
    places[-1].set_xlabel("time [s]")
    figure.savefig(run / "picture.png", dpi=110, bbox_inches="tight")
    print(run / "picture.png")


main()
