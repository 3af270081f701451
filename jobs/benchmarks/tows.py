"""Measures a towed cable of published size in water, straight and in a turn: the CPU time of a simulated second at a
stated accuracy."""
import csv
import math

from .runs import RunFailed, Samples, number

SPEED, RADIUS, STRAIGHT = 3.0, 300.0, 60.0   # speed [m/s], the turn's radius [m], time before the turn [s]
LENGTH = 1000.0
TURNED = STRAIGHT + math.pi * RADIUS / SPEED
END = 600.0
ACCURACY = 1e-3   # of the tail's position over the length, and of the tow force over its mean


def half_turn():
    """The ship goes straight along x, in half a circle to the left, and straight back."""
    rate = SPEED / RADIUS
    turning, back = f"step(t - {STRAIGHT})", f"step(t - {TURNED!r})"
    start = SPEED * STRAIGHT
    return {"expression": {
        "x": f"{SPEED}*t*(1 - {turning}) + ({turning} - {back})*({start} + {RADIUS}*sin({rate}*(t - {STRAIGHT})))"
             f" + {back}*({start} - {SPEED}*(t - {TURNED!r}))",
        "y": f"({turning} - {back})*{RADIUS}*(1 - cos({rate}*(t - {STRAIGHT}))) + {back}*{2 * RADIUS}", "z": "0"}}


def scene(elements, step, turns, interval):
    return {
        "environment": {"fluid": {"density": 1025}},
        "cable_types": {"tow": {"diameter": 0.02, "mass_per_length": 0.5, "axial_stiffness": 1.0e6, "normal_drag": 1.2,
                                "tangential_drag": 0.01, "added_mass": 1.0}},
        "points": {"ship": {"position": [0, 0, 0], "motion": half_turn() if turns else {"velocity": [SPEED, 0, 0]}},
                   "tail": {"position": [-900, 0, -300], "mass": 50, "drag_area": 0.1}},
        "cables": {"cable": {"type": "tow", "from": "ship", "to": "tail", "length": LENGTH, "elements": elements}},
        "initial": "static",
        "time": {"end": END, "step": step},
        "output": {"interval": interval, "history": ["tail", "cable"]},
    }


def history(laboratory):
    with open(laboratory.folder / "results" / "history.csv", encoding="utf-8", newline="") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def errors(rows, exact):
    """The largest errors in a run: of the tail's position over the length, and of the tow force over its mean."""
    mean = sum(row["cable.tension_from"] for row in exact) / len(exact)
    tail = max(math.dist([a[f"tail.{c}"] for c in "xyz"], [b[f"tail.{c}"] for c in "xyz"])
               for a, b in zip(rows, exact, strict=True))
    force = max(abs(a["cable.tension_from"] - b["cable.tension_from"]) for a, b in zip(rows, exact, strict=True))
    return tail / LENGTH, force / mean


def tows(laboratory, page, targets, finest, step, interval):
    """@param targets  {elements: CPU time of a simulated second [s]}
    @param finest  (elements, step) of the run to which the others are compared"""
    page.heading(f"10. A towed cable of {LENGTH:.0f} m in water, {SPEED} m/s, step {step} s, energy_momentum")
    rows = []
    for turns in (False, True):
        way = "half turn" if turns else "straight"
        try:
            laboratory.run(scene(*finest, turns, interval))
            exact = history(laboratory)
            for elements, target in targets.items():
                runs = laboratory.repeat(lambda n=elements: laboratory.run(scene(n, step, turns, interval)))
                tail, force = errors(history(laboratory), exact)
                cost = Samples(run.clock("cpu")["solve"] / END for run in runs)
                statics = Samples(1e3 * run.clock("cpu")["statics"] for run in runs)
                newton = runs[0].report["newton_iterations"] / runs[0].report["steps"]
                rows.append([way, elements, f"{newton:.2f}", f"{tail:.1e}", f"{force:.1e}", number(1e3 * cost.least),
                             number(1e3 * cost.median), f"{100 * cost.spread:.0f} %", number(statics.least)])
                page.target(f"{way}, {elements} elements: CPU of a simulated second [s]", cost.least, target)
                page.target(f"{way}, {elements} elements: larger error of tail and force", max(tail, force), ACCURACY)
        except RunFailed as problem:
            page.missing(f"tow, {way}", problem)
    page.table(["way", "elements", "Newton per step", "tail's error", "tow force's error",
                "CPU of a simulated second [ms] min", "median", "spread", "statics [ms]"], rows)
