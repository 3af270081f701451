"""A body hung up by four cables swings and turns for 100 s: what `energy_momentum` does to its energy."""
import numpy as np

from support import Verification, scene

CORNERS = ((1, 1), (-1, 1), (-1, -1), (1, -1))
MASS, GRAVITY, STIFFNESS = 10.0, 9.81, 2e4
RISE, DISTANCE = 1.9, np.sqrt(2 * 0.7**2 + 1.9**2)   # of one cable
TENSION = MASS * GRAVITY / 4 * DISTANCE / RISE
BOX = {"mass": MASS, "inertia": [0.5, 0.7, 0.9, 0.1, 0.02, -0.05], "position": [0, 0, 0],
       "attachments": {f"a{i}": [0.3 * x, 0.3 * y, 0.1] for i, (x, y) in enumerate(CORNERS)}}
QUIET = {"angular_velocity": [0.02, 0.06, 0.1], "velocity": [0.1, 0.04, 0]}
LIVELY = {"angular_velocity": [0.1, 0.2, 0.4], "velocity": [0.2, 0.1, 0]}
# Keys of the body, elements per cable, step [s], and the limit of the change of energy over the initial kinetic energy.
CASES = {
    "lively": (LIVELY, 2, 5e-3, 2e-6),
    "quiet": (QUIET, 3, 1e-2, 2e-6),
    "quiet, euler": ({**QUIET, "rotation": "euler"}, 2, 1e-2, 1e-5),
}


def hung(v, keys, elements, step):
    rope = {"mass_per_length": 0.05, "axial_stiffness": STIFFNESS}
    points = {f"p{i}": {"position": [x, y, 2], "motion": "fixed"} for i, (x, y) in enumerate(CORNERS)}
    length = DISTANCE / (1 + TENSION / STIFFNESS)
    cables = {f"c{i}": {"from": f"p{i}", "to": f"box.a{i}", "length": length, "elements": elements} for i in range(4)}
    case = scene(rope, points, cables, 100, step, 0.05, ["box", *cables], GRAVITY, energy=True,
                 scheme="energy_momentum")
    return v.run({**case, "bodies": {"box": {**BOX, **keys}}})


def main():
    v = Verification(__doc__)
    for name, (keys, elements, step, limit) in CASES.items():
        run = hung(v, keys, elements, step)
        off = np.abs(run["energy.total"] - run["energy.total"][0]) / run["energy.kinetic"][0]
        first, second = (half.max() for half in np.array_split(off, 2))
        v.check(f"{name}: change of the energy over the initial kinetic energy", off.max(), limit)
        v.check(f"{name}: its largest in the second half over that in the first", second / first, 1.5)
        v.at_least(f"{name}: smallest tension [N]", min(run[f"c{i}.tension_to"].min() for i in range(4)), 5)
        v.at_least(f"{name}: excursion [m]", np.abs(run["box.x"]).max(), 0.01)
    v.check("rejected steps in all runs", v.rejected, 0)
    v.finish()


if __name__ == "__main__":
    main()
