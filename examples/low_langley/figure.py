"""figure.py RUNS_DIR: draws RUNS_DIR/tensions.png, the tension at the top in the six runs through time over the reference
curves; prints the largest and the root-mean-square difference of each."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "jobs"))
from plot import plt, read_table    # noqa: E402

import numpy                        # noqa: E402

CASES = ("surge", "sway", "heave", "wave_0", "wave_45", "wave_90")
TENSION = "riser.tension_to"


def main():
    runs = pathlib.Path(sys.argv[1])
    figure, places = plt.subplots(3, 2, figsize=(12, 9), sharex="col", sharey=True, layout="constrained")
    for case, axes in zip(CASES, places.T.ravel()):
        history, reference = read_table(runs / case / "history.csv"), read_table(HERE / "reference" / f"{case}.csv")
        off = numpy.interp(reference["time"], history["time"], history[TENSION]) - reference[TENSION]
        worst = numpy.abs(off).argmax()
        print(f"{case}: at most {abs(off[worst]) / 1e3:.2f} kN from the reference, at {reference['time'][worst]:g} s; root "
              f"mean square {numpy.sqrt(numpy.mean(off**2)) / 1e3:.2f} kN")
        shown = history["time"] >= 0
        axes.plot(reference["time"], reference[TENSION] / 1e3, ".", color="black", markersize=3, label="OrcaFlex, digitised")
        axes.plot(history["time"][shown], history[TENSION][shown] / 1e3, color="tab:orange", label="cablenet")
        axes.set_title(case, fontsize=10)
        axes.grid(alpha=0.3)
    for axes in places[:, 0]:
        axes.set_ylabel("tension at the top [kN]")
    for axes in places[-1]:
        axes.set_xlabel("time [s]")
    places[0, 0].legend(loc="lower right", fontsize=8)
    figure.savefig(runs / "tensions.png", dpi=90)
    print(runs / "tensions.png")


main()
