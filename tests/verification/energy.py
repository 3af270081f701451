"""The accounts of energy are compared with closed forms, and with sums over the steps of a history."""
import re

import numpy as np

from support import HELD, Verification, scene

RHO, GRAVITY = 1025.0, 9.81
ACCOUNTS = ("dissipated", "damping", "water", "bed")
ENERGY_MOMENTUM = {"scheme": "energy_momentum"}
GENERALIZED_ALPHA = {"scheme": "generalized_alpha", "spectral_radius": 0.8}
DIAMETER, MASS, LENGTH = 0.03, 1.6, 10.0
CABLE = {"mass_per_length": MASS, "axial_stiffness": 1e7, "diameter": DIAMETER, "normal_drag": 1.2,
         "tangential_drag": 0.05, "added_mass": 0.9}


def moved(run):
    """What the run says that it has moved [J]."""
    return float(re.search(r"^  moved_J: (\S+)$", run.report, re.MULTILINE)[1])


def check_closed(v, name, run, *filled):
    """The balance closes, and accounts that have nothing to take are empty."""
    v.check(f"{name}: balance over what moves", np.abs(run["energy.balance"]).max() / moved(run), 1e-9)
    total = run["energy.total"] + sum(run[f"energy.{account}"] for account in ACCOUNTS)
    v.check(f"{name}: balance from the columns", np.abs(total - total[0] - run["energy.balance"]).max() / moved(run),
            1e-12)
    for account in ACCOUNTS[1:]:
        if account not in filled:
            v.check(f"{name}: {account} [J]", np.abs(run[f"energy.{account}"]).max(), 0)


def laid(z=0.0, **velocity):
    """The ends of a free horizontal cable."""
    return {"a": {"position": [0, 0, z], **velocity}, "b": {"position": [LENGTH, 0, z], **velocity}}


def in_surroundings(made, gravity=GRAVITY, **keys):
    return {**made, "environment": {"gravity": gravity, **keys}}


def check_falling(v):
    """Drag, added mass and buoyancy take from a cable that falls broadside what its own mass does not get."""
    displaced = RHO * np.pi / 4 * DIAMETER**2
    first = (MASS - displaced) * GRAVITY / (MASS + 0.9 * displaced)
    last = np.sqrt((MASS - displaced) * GRAVITY / (RHO / 2 * 1.2 * DIAMETER))
    for name, keys in (("energy_momentum", ENERGY_MOMENTUM), ("generalized_alpha", GENERALIZED_ALPHA)):
        made = scene(CABLE, laid(), {"from": "a", "to": "b", "elements": 4}, 1.0, 0.01, 0.1, [], energy=True, **keys)
        run = v.run(in_surroundings(made, fluid={"density": RHO}))
        t = run["time"]
        fall, speed = last**2 / first * np.log(np.cosh(first / last * t)), last * np.tanh(first / last * t)
        water = LENGTH * MASS * (GRAVITY * fall - speed**2 / 2)
        v.check(f"falling cable, {name}: water [J]", np.abs(run["energy.water"] - water).max(), 2e-3 * water[-1])
        check_closed(v, f"falling cable, {name}", run, "water")


def check_tow(v):
    """A cable that is pulled along itself gives the water its tangential drag times its way."""
    points = {"tow": {"position": [0, 0, 0], "motion": {"velocity": [2, 0, 0]}}, "tail": {"position": [-LENGTH, 0, 0]}}
    made = scene(CABLE, points, {"from": "tow", "to": "tail", "elements": 8}, 2, 0.05, 0.5, [], energy=True,
                 **ENERGY_MOMENTUM)
    run = v.run({**in_surroundings(made, 0, fluid={"density": RHO}), "initial": "static"})
    drag = RHO / 2 * 0.05 * np.pi * DIAMETER * 2**2 * LENGTH
    v.check("steady tow: water [J]", np.abs(run["energy.water"] - drag * 2 * run["time"]).max(), 1e-4 * drag)
    v.check("steady tow: work [J]", np.abs(run["energy.work"] - run["energy.water"]).max(), 1e-6 * drag)
    check_closed(v, "steady tow", run, "water")


def check_bed(v):
    """Friction takes all motion of a cable that slides along itself.  Damping takes what a cable had that fell flat."""
    bed = {"level": 0, "stiffness": 2e4, "damping": 2e3, "friction": 0.3}
    depth = MASS * GRAVITY / (bed["stiffness"] * DIAMETER)
    made = scene(CABLE, laid(-depth, velocity=[1.5, 0, 0]), {"from": "a", "to": "b", "elements": 4}, 1.0, 0.002, 0.1, [],
                 energy=True, **ENERGY_MOMENTUM)
    run = v.run(in_surroundings(made, seabed=bed))
    first = 0.5 * MASS * LENGTH * 1.5**2
    v.close("sliding cable: friction takes [J]", run["energy.bed"][-1], first, 1e-3 * first)
    v.check("sliding cable: formulas take [J]", np.abs(run["energy.dissipated"]).max(), 1e-9 * first)
    check_closed(v, "sliding cable", run, "bed")
    bed = {"level": 0, "stiffness": 2e4, "damping": 6e3}
    made = scene(CABLE, laid(0.5), {"from": "a", "to": "b", "elements": 4}, 3.0, 0.001, 0.1, [], energy=True,
                 **ENERGY_MOMENTUM)
    run = v.run(in_surroundings(made, seabed=bed))
    lost = MASS * LENGTH * GRAVITY * (0.5 + depth)
    v.close("fallen cable: the bed takes [J]", run["energy.bed"][-1], lost, 1e-6 * lost)
    check_closed(v, "fallen cable", run, "bed")


def check_axial_dissipation(v):
    """One element on a line: EA/L xi q Dl in each step, q = Dl - s, s' = Dl + 0.65 q in the next, no s in the first."""
    stiffness, length, xi = 2000.0, 1.0, 0.2
    points = {"pin": HELD, "bob": {"position": [1.1, 0, 0], "mass": 1}}
    cable = {"from": "pin", "to": "bob", "elements": 1, "length": length}
    made = scene({"mass_per_length": 0.5, "axial_stiffness": stiffness}, points, cable, 0.5, 0.005, 0, ["bob"], 0,
                 energy=True, **ENERGY_MOMENTUM)
    run = v.run(made, "-cable_axial_dissipation", xi)
    grown = np.diff(run["bob.x"])
    q = np.copy(grown)
    for i in range(1, len(q)):
        q[i] = grown[i] - (grown[i - 1] + 0.65 * q[i - 1])
    taken = stiffness / length * xi * np.cumsum(q * grown)
    off = np.abs(run["energy.dissipated"][1:] - taken).max() / taken[-1]
    v.check("axial dissipation: off EA/L xi q Dl, of what it takes", off, 1e-9)
    check_closed(v, "axial dissipation", run)


def check_words(v):
    """What a run says at its end, and what run.yaml keeps of it."""
    points = {"pin": HELD, "bob": {"position": [1.1, 0, 0], "mass": 1}}
    cable = {"from": "pin", "to": "bob", "elements": 2, "length": 1}
    for damping in (0, 5):
        made = scene({"mass_per_length": 0.5, "axial_stiffness": 2000, "axial_damping": damping}, points, cable, 0.5,
                     0.005, 0.1, ["bob"], energy=True, **ENERGY_MOMENTUM)
        run, done = v.attempt(made)
        line = next((line for line in done.stdout.splitlines() if line.startswith("energy: ")), "")
        v.says("last words", line, "J moved", "the step's formulas", "the balance closes to",
               *(["damping took"] if damping else []))
        v.says("run.yaml", run.report, "energy:", "moved_J", "dissipated_J", "damping_J", "water_J", "bed_J",
               "balance_over_moved")
        v.check("words of what is not there", float("water" in line or "bed" in line or (not damping and
                                                                                        "damping" in line)), 0)
    run, done = v.attempt({**made, "output": {"interval": 0.1, "history": ["bob"]}})
    v.check("words that nobody asked for", float("energy:" in done.stdout + run.report), 0)


def main():
    v = Verification(__doc__)
    for check in (check_falling, check_tow, check_bed, check_axial_dissipation, check_words):
        check(v)
    v.finish()


if __name__ == "__main__":
    main()
