"""Runs all parts on which water and a seabed act on 1, 2, 3 and 4 ranks, and checks that the histories agree."""
import json
import shutil
import subprocess
import sys
import time

from bench import arguments
from ranks import Difference, compare, run

RANKS = (1, 2, 3, 4)
TOLERANCE = 1e-8   # of a quantity's scale: its largest value in the run
# An acceleration has the rounding of a position over the square of the step.
ACCELERATION_TOLERANCE = 1e-6

FLUID = {"density": 1025, "surface": 0, "depth": 12,
         "current": {"profile": [[-12, 0.1, 0.05, 0], [-5, 0.3, -0.1, 0], [0, 0.6, 0.2, 0]]},
         "waves": [{"height": 0.6, "period": 4.0, "direction": 20, "phase": 40},
                   {"height": 0.2, "period": 2.5, "direction": -50}]}
TYPES = {"chain": {"mass_per_length": 4.0, "axial_stiffness": 2e5, "diameter": 0.03, "normal_drag": 1.2,
                   "tangential_drag": 0.1, "added_mass": 1.0, "axial_damping": 200},
         "rope": {"mass_per_length": 0.6, "axial_stiffness": 3e4, "diameter": 0.02, "tension_only": True,
                  "normal_drag": 1.1, "tangential_drag": 0.02, "added_mass": 1.0, "axial_damping": 50}}
POINTS = {"anchor": {"position": [7, -0.5, -12], "motion": "fixed"},
          "pole": {"position": [22, -1, -11.5], "motion": "fixed"},
          "crane": {"position": [16, 3, 1.5], "motion": {"harmonic": {"amplitude": [0.05, 0.04, 0.1], "period": 3}}},
          "load": {"position": [16.4, 3.2, -5], "mass": 30, "volume": 5e-3, "drag_area": 0.05, "added_mass": 4},
          "lead": {"position": [8, 1.2, -8.4], "mass": 6, "volume": 1e-3, "drag_area": 0.02, "added_mass": 1}}
WATER = {"volume": 0.3, "center_of_buoyancy": [0, 0.01, 0.12],
         "drag": {"linear": [20, 30, 60, 9, 8, 7], "quadratic": [90, 120, 200, 6, 5, 4]},
         "added_mass": [40, 50, 90, 4, 5, 3]}
BODIES = {"float": {"mass": 90, "inertia": [6, 7, 8, 0.2, 0.1, -0.1], "position": [9, 0.5, -2], **WATER,
                    "attachments": {"under": [0.05, 0, -0.3], "aft": [0.4, 0.1, -0.1]}},
          "fish": {"mass": 160, "inertia": [5, 9, 8], "position": [14, 1.5, -4], "rotation": "euler", **WATER,
                   "volume": 0.1, "attachments": {"nose": [-0.4, 0, 0.1], "tail": [0.5, 0.05, 0]}},
          "bob": {"mass": 40, "position": [19, 0.4, -5], "volume": 0.02, "added_mass": [9, 9, 9, 0, 0, 0],
                  "drag": {"quadratic": [30, 30, 30, 0, 0, 0]}, "attachments": {"top": [0, 0, 0.2]}}}
CABLES = {"mooring": {"type": "chain", "from": "anchor", "to": "float.under", "length": 9.9, "elements": 10},
          "between": {"type": "rope", "from": "float.aft", "to": "fish.nose", "length": 6, "elements": 6},
          "stern": {"type": "chain", "from": "fish.tail", "to": "pole", "length": 13, "elements": 10},
          "hanger": {"type": "rope", "from": "crane", "to": "load", "length": 6.5, "elements": 6},
          "weight": {"type": "rope", "from": {"cable": "mooring", "at": 6}, "to": "lead", "length": 2, "elements": 2},
          "line": {"type": "rope", "from": {"cable": "stern", "at": 3.9}, "to": "bob.top", "length": 3.2,
                   "elements": 3}}
BED = {"level": -12, "stiffness": 1e3, "damping": 100, "friction": 0.3, "friction_velocity": 0.05}


def scene(bodies, cables):
    ends = json.dumps(cables)
    points = {name: keys for name, keys in POINTS.items() if f'"{name}"' in ends}
    moving = [name for name in points if name not in ("anchor", "pole")]
    return {"environment": {"gravity": 9.81, "fluid": FLUID, "seabed": BED}, "cable_types": TYPES, "points": points,
            "bodies": bodies, "cables": cables,
            "output": {"interval": 0.05, "history": [*moving, *bodies, *cables], "energy": True}}


def variants():
    """Scenes by name.  From rest everything turns that may; statics is given what surely has an equilibrium nearby."""
    everything = scene(BODIES, CABLES)
    turning = ("inertia", "rotation", "center_of_buoyancy")
    heavy = scene({name: {key: value for key, value in keys.items() if key not in turning}
                   for name, keys in BODIES.items()}, CABLES)
    buoy = scene({"float": BODIES["float"]}, {name: CABLES[name] for name in ("mooring", "weight", "hanger")})
    fixed = {"end": 0.3, "step": 0.01}
    adaptive = {"step": 0.005, "adaptive": {"tolerance": 1e-4}}
    return {"from rest": {**everything, "time": fixed},
            "adaptive": {**everything, "time": {"end": 0.3, **adaptive}},
            "statics alone": heavy,
            "from statics": {**heavy, "initial": "static", "time": {**fixed, "scheme": "generalized_alpha", "spectral_radius": 0.8}},
            "buoy from statics": {**buoy, "initial": "static",
                                  "time": {"start": 1.0, "end": 1.3, "spectral_radius": 0.6, **adaptive}}}


def part(found, accelerations):
    """The columns of accelerations, or all other columns.  Both have the time."""
    columns, rows = found
    chosen = [i for i, name in enumerate(columns)
              if name == "time" or (name[-3:] in (".ax", ".ay", ".az")) == accelerations]
    return [columns[i] for i in chosen], [[row[i] for i in chosen] for row in rows]


def verdict(reference, found):
    """@return whether they agree, and how well"""
    rest, where = compare(part(reference, False), part(found, False))
    fast, there = compare(part(reference, True), part(found, True))
    good = rest <= TOLERANCE and fast <= ACCELERATION_TOLERANCE
    return good, f"{len(found[1])} rows, differs by {rest:.1e} ({where}), accelerations by {fast:.1e} ({there})"


def main():
    given = arguments(__doc__)
    failures = 0
    for name, scene_keys in variants().items():
        folder = given.scratch / name.replace(" ", "_")
        folder.mkdir(parents=True)
        path = folder / "scene.yaml"
        path.write_text(json.dumps(scene_keys))   # JSON is YAML
        reference = None
        for ranks in RANKS:
            start = time.monotonic()
            try:
                found = run(given.program, path, folder / str(ranks), ranks)
                reference = reference or found
                good, text = verdict(reference, found)
            except (Difference, subprocess.TimeoutExpired) as problem:
                good, text = False, str(problem)
            failures += not good
            print(f"{'' if good else 'FAILED: '}{name}, {ranks} ranks: {text}, {time.monotonic() - start:.1f} s",
                  flush=True)
    if failures:
        return 1
    shutil.rmtree(given.scratch)
    return 0


if __name__ == "__main__":
    sys.exit(main())
