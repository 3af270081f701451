"""Forces on points that depend on time, against closed forms and against constant forces."""
import numpy as np

from support import HELD, Verification, energy_drift, scene

ROPE = {"mass_per_length": 0.5, "axial_stiffness": 2e4}
SCHEMES = {"energy_momentum": {"scheme": "energy_momentum"}, "generalized_alpha": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}


def pushed_pair(step, keys, force):
    """Two weights on one element, with one force each, in no gravity."""
    points = {name: {"position": [x, 0, 0], "mass": 1.0, "force": force} for name, x in (("a", 0), ("b", 2))}
    cable = {"from": "a", "to": "b", "elements": 1}
    return scene(ROPE, points, cable, 2.0, step, 0.5, ["a", "b"], 0, energy=True, **keys)


def check_ramp(v):
    """F = t (1, -2, 3) moves the whole pair, of 3 kg, by F t^2/6 times 2/3."""
    slope = np.array([1.0, -2.0, 3.0])
    laws = {"waypoints": {"waypoints": [[0, 0, 0, 0], [2, *(2 * slope)]]},
            "expression": {"expression": {"x": "t", "y": "-2*t", "z": "3*t"}}}
    for name, keys in SCHEMES.items():
        for kind, force in laws.items():
            errors = []
            for step in (2e-2, 1e-2):
                run = v.run(pushed_pair(step, keys, force))
                way = slope * (2 / 3 * run["time"] ** 3 / 6)[:, None]
                errors.append(np.abs(run.vectors("a") - way).max())
            v.check(f"ramp by {kind}, {name}: off the closed form at 1e-2 s [m]", errors[1], 1e-4)
            v.check(f"ramp by {kind}, {name}: order of the error less 2", abs(np.log2(errors[0] / errors[1]) - 2), 0.05)
        work = run["energy.work"] - run["energy.kinetic"] - run["energy.strain"]
        v.check(f"ramp, {name}: work is not the energy gained, relative", np.abs(work).max() / run["energy.work"].max(),
                1e-11 if name == "energy_momentum" else 2e-4)


def pulled_line(force, **keys):
    points = {"top": HELD, "tip": {"position": [3, 0, -1], "mass": 2.0, "force": force}}
    cable = {"from": "top", "to": "tip", "elements": 8, "length": 3.17}
    return scene(ROPE, points, cable, 1.0, 5e-3, 0.1, ["top", "tip", "cable"], 9.81, energy=True,
                 **keys)


def check_constant(v):
    """A law that does not change is the constant force, in time and at rest."""
    constant = v.run(pulled_line([4, 5, 6], scheme="energy_momentum"))
    for name, law in {"waypoints": {"waypoints": [[0, 4, 5, 6], [0.3, 4, 5, 6], [1, 4, 5, 6]]},
                      "expression": {"expression": {"x": "4", "y": "5", "z": "6"}}}.items():
        run = v.run(pulled_line(law, scheme="energy_momentum"))
        worst = max(np.abs(run.vectors("tip", kind) - constant.vectors("tip", kind)).max() for kind in ("", "v"))
        v.check(f"constant {name}: position [m] or velocity [m/s] off that with [4, 5, 6]", worst, 1e-9)
        v.check(f"constant {name}: work off that of [4, 5, 6] [J]",
                np.abs(run["energy.work"] - constant["energy.work"]).max(), 1e-9)
    written = {"expression": {"x": "4", "y": "5*cos(t)", "z": "6 + 2*sin(9*t)"}}
    v.check("a swinging force: drift of the energy", energy_drift(v.run(pulled_line(written, scheme="energy_momentum"))),
            1e-10)


def check_statics(v):
    """A static start is the equilibrium under the force at the start, and a force that then stays leaves it."""
    ends = []
    for force in ([4, 0, -6], {"waypoints": [[0, 4, 0, -6], [1, 4, 0, -6]]}, {"expression": {"x": "4 + 0*t", "z": "-6*cos(0*t)"}}):
        run = v.run({**pulled_line(force, scheme="energy_momentum"), "initial": "static"})
        ends.append(run.vectors("tip"))
        v.check("static start: way in 1 s [m]", np.abs(ends[-1] - ends[-1][0]).max(), 1e-9)
    v.check("static start: off that of the constant force [m]",
            max(np.abs(end[0] - ends[0][0]).max() for end in ends), 1e-10)
    light = {**pulled_line({"waypoints": [[0, 0, 0, -30], [1, 0, 0, -30]]}, scheme="energy_momentum"), "initial": "static"}
    light["points"]["tip"] = {"position": [0, 0, -3], "force": light["points"]["tip"]["force"]}
    run = v.run(light)
    v.check("a free end without mass: tension less the force [N]", np.abs(run["cable.tension_to"] - 30).max(), 1e-6)


def main():
    v = Verification(__doc__)
    check_ramp(v)
    check_constant(v)
    check_statics(v)
    v.finish()


if __name__ == "__main__":
    main()
