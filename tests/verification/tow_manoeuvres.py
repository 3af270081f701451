"""The tow force of a long cable in water, while the ship turns and while it changes its speed, against the same tow with
many more elements.  It is that of jobs/benchmark.sh, section 10, with smaller elements near the tail, where the cable
bends within metres.  Steps are alike in all runs, so that only the elements differ."""
import pathlib
import sys

import numpy as np

from support import Verification, orders

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "jobs"))
from benchmarks import tows  # noqa: E402

BEND = 40.0                       # length of the cable's part near the tail that has a tenth of the elements [m]
COUNTS, FINEST = (50, 100, 200), 800
ALLOWED = {50: 1e-3, 200: 1e-4}   # of the tow force's error over its mean
Q = "(t - 60)/100"
# The ship moves at 2 m/s until 60 s, and at 3 m/s from 160 s on.
FASTER = f"2*t + 100*(({Q})^6 - 3*({Q})^5 + 2.5*({Q})^4)*(step(t - 60) - step(t - 160)) + (t - 110)*step(t - 160)"
WAYS = {"half turn": tows.half_turn(), "change of speed": {"expression": {"x": FASTER, "y": "0", "z": "0"}}}


def scene(elements, motion):
    made = tows.scene(elements, 1.0, True, 2)
    made["points"]["ship"]["motion"] = motion
    made["points"]["joint"] = {"position": [part * (1 - BEND / tows.LENGTH) for part in made["points"]["tail"]["position"]]}
    cable = made["cables"].pop("cable")
    made["cables"] = {
        "cable": {**cable, "to": "joint", "length": tows.LENGTH - BEND, "elements": elements * 9 // 10},
        "bend": {**cable, "from": "joint", "length": BEND, "elements": elements // 10}}
    return made


def main():
    v = Verification(__doc__)
    for way, motion in WAYS.items():
        exact = v.run(scene(FINEST, motion))["cable.tension_from"]
        found = [v.run(scene(n, motion))["cable.tension_from"] for n in COUNTS]
        off = {n: np.abs(force - exact).max() / exact.mean() for n, force in zip(COUNTS, found)}
        print(f"        {way}: error of the tow force over its mean: {off}")
        v.at_least(f"{way}: largest change of the tow force over its mean", np.ptp(exact) / exact.mean(), 0.1)
        for n, limit in ALLOWED.items():
            v.check(f"{way}, {n} elements: error of the tow force over its mean", off[n], limit)
        for order in orders(list(off.values())):
            v.at_least(f"{way}: order in the elements' length", order, 1.9)
    v.check("rejected steps in all runs", v.rejected, 0)
    v.finish()


if __name__ == "__main__":
    main()
