"""An equilibrium is a property of the scene: it depends on no damper, no place on earth, no order in the file and no
number of ranks."""
import copy

import numpy as np

from mooring_scenes import Mooring
from network_scenes import Network
from statics_support import report_number
from support import Verification

# Moorings on fixed fairleads, a buoy and a body, in still water and in a current, of ropes and of bars; trees, loops, nets
# and bodies.
MOORINGS, NETWORKS = (2, 13, 24, 38), (3, 12, 21)
DAMPINGS, RANKS = (0.0, 1e-3, 0.1, 1.0, 10.0), (2, 3, 5, 7)
SHIFT = np.array([5e5, -3e5, 0.0])


def shifted(scene):
    """The same scene 580 km away."""
    far = copy.deepcopy(scene)
    for kind in ("points", "bodies"):
        for thing in far.get(kind, {}).values():
            thing["position"] = [float(c) for c in np.array(thing["position"]) + SHIFT]
    for net in far.get("nets", {}).values():
        net["corners"] = [[float(c) for c in np.array(corner) + SHIFT] for corner in net["corners"]]
    for cable in far.get("cables", {}).values():
        if isinstance(cable.get("shape"), list):
            cable["shape"] = [[float(c) for c in np.array(point) + SHIFT] for point in cable["shape"]]
    return far


def reordered(scene):
    """The same scene with its points, bodies and cables from the last to the first."""
    return {key: dict(reversed(value.items())) if key in ("points", "bodies", "cables") else value
            for key, value in scene.items()}


def damped(scene, share):
    """With so many times the damping at which an element's axial vibration has a ratio of some 1."""
    more = copy.deepcopy(scene)
    for kind in more["cable_types"].values():
        kind["axial_damping"] = share * kind["axial_stiffness"] * 1e-2
        kind["rayleigh"] = {"mass": share, "stiffness": 0.0}
    return more


class Found:
    """@param shift  of what is drawn, which positions are without"""

    def __init__(self, run, done, shift=np.zeros(3)):
        names = [column[:-2] for column in run.columns if column.endswith(".x")]
        self.positions = {name: [run[f"{name}.{axis}"][0] for axis in "xyz"] - shift for name in names}
        self.pulls = {column: abs(run[column][0]) for column in run.columns if ".tension_" in column}
        self.iterations = report_number(run, "statics", "iterations")
        self.notes = done.stderr.count("not stable")

    def apart(self, other):
        """(of positions [m], of pulls over the largest)"""
        largest = max(self.pulls.values(), default=1)
        return (max((np.abs(other.positions[name] - where).max() for name, where in self.positions.items()), default=0),
                max((abs(other.pulls[name] - pull) for name, pull in self.pulls.items()), default=0) / largest)


def compare(v, label, extent, base, other, rounding=1.0):
    positions, pulls = base.apart(other)
    v.check(f"{label}: positions apart, over the extent", positions / extent, 1e-9 * rounding)
    v.check(f"{label}: pulls apart, over the largest", pulls, 1e-8 * rounding)
    v.close(f"{label}: notes of instability", other.notes, base.notes, 0)


def check(v, draw, scene, extent):
    def find(label, changed, ranks=None, shift=np.zeros(3)):
        v.ranks = ranks
        run, done = v.attempt(changed)
        v.ranks = None
        v.close(f"{draw.name}, {label}: exit status", done.returncode, 0, 0)
        return Found(run, done, shift) if done.returncode == 0 else None
    scene = {**scene, "output": {"history": [name for kind in ("points", "bodies", "cables") for name in scene.get(kind, {})]}}
    base = find("as it is", scene)
    if base is None:
        return
    for share in DAMPINGS:
        other = find(f"damping {share}", damped(scene, share))
        compare(v, f"{draw.name}, damping {share}", extent, base, other)
        v.close(f"{draw.name}, damping {share}: iterations", other.iterations, base.iterations, 0.1 * base.iterations)
    compare(v, f"{draw.name}, reordered", extent, base, find("reordered", reordered(scene)))
    for ranks in RANKS:
        compare(v, f"{draw.name}, {ranks} ranks", extent, base, find(f"{ranks} ranks", scene, ranks))
    # There coordinates are rounded to 1e-10 m, and an element's force to EA/L times that.
    far = find("580 km away", shifted(scene), shift=SHIFT)
    compare(v, f"{draw.name}, 580 km away", extent, base, far, 1e3)


def main():
    verification = Verification(__doc__)
    for seed in MOORINGS:
        draw = Mooring(seed)
        check(verification, draw, draw.scene("catenary"), draw.depth)
    for seed in NETWORKS:
        draw = Network(seed)
        check(verification, draw, draw.scene(0), draw.size)
    verification.finish()


if __name__ == "__main__":
    main()
