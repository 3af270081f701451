"""The scripts about equilibria share scenes without `time`, drawn shapes and an elastic catenary."""
import re

import numpy as np

TOLERANCE = 1e-8   # between two solutions of one discrete problem: rounding spoils the 1e-12 that the solver asks for


def still(cable_types, points, cables, history, gravity=9.81, environment=(), **rooms):
    """A scene that is solved for its equilibrium; one cable type of the name `rope` may be given by its keys alone."""
    if "axial_stiffness" in cable_types:
        cable_types = {"rope": cable_types}
    only = next(iter(cable_types))
    cables = {name: {"type": only, **keys} for name, keys in cables.items()}
    return {
        "environment": {"gravity": gravity, **dict(environment)},
        "cable_types": cable_types,
        "points": points,
        "cables": cables,
        "output": {"history": history},
        **rooms,
    }


def fixed(*position):
    return {"position": list(position), "motion": "fixed"}


def at_rest(run, name, kind=""):
    """A vector in the only row of a run."""
    return run.vectors(name, kind)[0]


def report_number(run, section, key):
    return float(re.search(rf"^{section}:\n(?:  .*\n)*?  {key}: (\S+)$", run.report, re.MULTILINE)[1])


def drawn(shape, a, b, length, elements, random):
    """The key `shape` of a cable from a to b: one of two words, or a polyline that is far from any equilibrium."""
    a, b = np.array(a, float), np.array(b, float)
    if isinstance(shape, str) and shape in ("straight", "catenary"):
        return shape
    middle = 0.5 * (a + b)
    if shape == "slack":
        inner = [middle + [0, 0, -0.4 * length]]
    elif shape == "up":
        inner = [middle + [0, 0.05 * length, 0.4 * length]]
    elif shape == "crumpled":
        along = np.linspace(0, 1, elements + 1)[1:-1, None]
        inner = a + along * (b - a) + 0.05 * length * random.uniform(-1, 1, (elements - 1, 3))
    else:
        inner = length * random.uniform(-1, 1, (elements - 1, 3))
    return [list(map(float, p)) for p in (a, *inner, b)]


class Catenary:
    """The elastic catenary from (0, 0) to (x, z) in its plane: engineering strain, w > 0 per unstretched length.

    The end at (x, z) is held by (h, v), that at (0, 0) by (-h, w length - v); on a bed at z = 0 by (-h, 0).
    Source: Irvine, Cable Structures (1981), ch. 2; the bed after Jonkman, NREL/EL-500-41958 (2007), ch. 2.7.
    """

    def __init__(self, x, z, length, stiffness, w, on_bed=False):
        self.x, self.z, self.length, self.stiffness, self.w, self.on_bed = x, z, length, stiffness, w, on_bed
        slack = np.sqrt(max(length**2 - z**2, x**2 * (1 + 1e-9)) / x**2 - 1)
        h = w * x / (2 * np.sqrt(6 * max(slack / 2, 1e-3)))
        unknowns = np.array([np.log(h), 0.5 * w * (length + z / np.tanh(max(slack, 0.3)))])
        for _ in range(200):
            miss = self._miss(unknowns)
            slope = np.column_stack([(self._miss(unknowns + d) - self._miss(unknowns - d)) / (2 * d.max())
                                     for d in np.diag([1e-6, 1e-6 * w * length])])
            step = np.linalg.solve(slope, -miss)
            unknowns += step / max(1, abs(step[0]) / 0.5, abs(step[1]) / (0.5 * w * length))
            if np.abs(self._miss(unknowns)).max() < 1e-12 * length:
                break
        else:
            raise RuntimeError("the catenary's equations are not solved")
        self.h, self.v = np.exp(unknowns[0]), unknowns[1]

    def _at(self, s, h, v0):
        """(x, z) at the unstretched length s from the place where the cable's pull is (h, v0)."""
        v = v0 + self.w * s
        x = h / self.w * (np.arcsinh(v / h) - np.arcsinh(v0 / h)) + h * s / self.stiffness
        z = (np.hypot(h, v) - np.hypot(h, v0)) / self.w + (v0 * s + 0.5 * self.w * s**2) / self.stiffness
        return np.array([x, z])

    def _miss(self, unknowns):
        h, v = np.exp(unknowns[0]), unknowns[1]
        if not self.on_bed:
            return self._at(self.length, h, v - self.w * self.length) - [self.x, self.z]
        lifted = v / self.w
        resting = self.length - lifted
        return self._at(lifted, h, 0) + [resting * (1 + h / self.stiffness), 0] - [self.x, self.z]

    def at(self, s):
        return self._at(s, self.h, self.v - self.w * self.length)

    @property
    def resting(self):
        """The length that lies on the bed."""
        return self.length - self.v / self.w


def hung_by_soft_links(v, kind):
    """A body hangs on a rope and a soft link of EA and the length |r|, for two attachments r.  The link stretches by
    F |r|/EA and keeps F^2 |r|/(2 EA).  @param kind  of the link, a key of `coupling`   @return [(r, run)]"""
    gravity, mass, line, rope_stiffness, stiffness = 10, 2.0, 0.1, 1000.0, 50.0
    force, pull, runs = mass * gravity, (mass + line / 2) * gravity, []
    for arm in ([0.09, -0.12, 0.2], [0.3, 0, 0.4]):
        r = np.linalg.norm(arm)
        body = {"mass": mass, "inertia": [0.1, 0.1, 0.1], "position": [0.1, 0, -2], "attachments": {"top": arm},
                "coupling": {kind: {"axial_stiffness": stiffness}}}
        case = still({"mass_per_length": line, "axial_stiffness": rope_stiffness}, {"pin": fixed(0, 0, 0)},
                     {"rope": {"from": "pin", "to": "body.top", "elements": 1, "length": 1}}, ["body"], gravity,
                     bodies={"body": body})
        case["output"]["energy"] = True
        run = v.run(case)
        length = 1 + pull / rope_stiffness + force * r / stiffness + r
        strain = 0.5 * pull**2 / rope_stiffness + 0.5 * force**2 * r / stiffness
        # Forces balance to 1e-9 of the load at least.
        v.close(f"hung by a soft {kind} at {arm}: height [m]", at_rest(run, "body")[2], -length,
                1e-9 * force * (1 / rope_stiffness + r / stiffness))
        v.close(f"hung by a soft {kind} at {arm}: strain energy [J]", run["energy.strain"][0], strain, 2e-9 * strain)
        runs.append((arm, run))
    return runs
