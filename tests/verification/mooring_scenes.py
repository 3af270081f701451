"""Slack moorings with touchdown, drawn from a seed: one to six lines from anchors on the bed to fairleads that are fixed,
or on a buoy, or on a body."""
import numpy as np

from statics_support import fixed

GRAVITY, DENSITY = 9.81, 1025
DIAMETER, MASS, STIFFNESS = 0.05, 48.0, 2e8
DRAWN = ("straight", "catenary", "polyline")
HOLDERS = ("fixed", "buoy", "body")


class Mooring:
    """One draw.  All numbers that matter are attributes, so that a test can compute the same by other means."""

    def __init__(self, seed, friction=0.0):
        self.friction = friction
        random = np.random.default_rng(seed)
        pick = lambda *of: of[random.integers(len(of))]
        self.seed = seed
        self.holder = pick(*HOLDERS)
        self.lines = pick(1, 3, 4, 6) if self.holder != "body" else pick(3, 4, 6)
        self.elements = pick(20, 20, 60, 60, 200)
        self.bed = 10**random.uniform(np.log10(3e5), np.log10(3e9))
        self.tension_only = bool(random.integers(2))
        self.current = bool(random.integers(2))
        self.depth = random.uniform(20, 150)
        self.reach = self.depth * 10**random.uniform(-1, 0.6)
        self.clump = self.holder == "fixed" and random.random() < 0.25
        self.floats = self.holder == "fixed" and not self.clump and random.random() < 0.2
        self.turn = random.uniform(0, 2 * np.pi)
        self.surplus = [10**random.uniform(np.log10(0.005), np.log10(1.5)) for _ in range(self.lines)]
        if self.holder != "fixed":   # what floats is held by all lines alike, but for one that may be longer
            self.surplus = [self.surplus[0]] * self.lines
            if random.random() < 0.3:
                self.surplus[0] = 10**random.uniform(np.log10(0.005), np.log10(1.5))
        self.noise = random.uniform(0.02, 0.2)

    @property
    def name(self):
        extra = "+clump" if self.clump else "+float" if self.floats else ""
        return (f"{self.seed}: {self.lines} lines of {self.elements} to {self.holder}{extra}, x{1 + self.surplus[0]:.3g}, "
                f"depth {self.depth:.0f}, reach {self.reach:.0f}, bed {self.bed:.1e}, "
                f"{'ropes' if self.tension_only else 'bars'}{', current' if self.current else ''}")

    @property
    def is_convex(self):
        """Cables hang from what is fixed, or from a buoy, in still water: one least energy, whatever is drawn."""
        return self.holder != "body" and not self.current

    def fairlead(self, i):
        """Where line i ends as drawn.  It is 3 m below the surface."""
        angle = self.turn + 2 * np.pi * i / self.lines
        radius = {"fixed": 1.5, "buoy": 0, "body": 1.5}[self.holder]
        return np.array([radius * np.cos(angle), radius * np.sin(angle), 0.0 if self.holder == "buoy" else -3.0])

    def anchor(self, i):
        angle = self.turn + 2 * np.pi * i / self.lines
        return np.array([self.reach * np.cos(angle), self.reach * np.sin(angle), -self.depth])

    def length(self, i):
        return float((1 + self.surplus[i]) * np.linalg.norm(self.anchor(i) - self.fairlead(i)))

    def weight(self):
        """Of a line in water.  [N/m]"""
        return (MASS - DENSITY * np.pi * DIAMETER**2 / 4) * GRAVITY

    def _shape(self, drawn, a, b, length):
        if drawn != "polyline":
            return drawn
        random = np.random.default_rng(self.seed)
        inner = [a + t * (b - a) + self.noise * length * random.uniform(-1, 1, 3) for t in (0.2, 0.4, 0.6, 0.8)]
        return [[float(c) for c in p] for p in (a, *inner, b)]

    def scene(self, drawn):
        points, cables, rooms, history = {}, {}, {}, []
        pull = self.lines * self.weight() * max(self.depth, self.length(0))
        for i in range(self.lines):
            a, b = self.anchor(i), self.fairlead(i)
            points[f"anchor{i}"] = fixed(*map(float, a))
            end = {"fixed": f"fairlead{i}", "buoy": "buoy", "body": f"float.f{i}"}[self.holder]
            if self.holder == "fixed":
                points[end] = fixed(*map(float, b))
            cuts = [f"anchor{i}", end]
            if self.clump or self.floats:
                middle = a + 0.6 * (b - a)
                points[f"middle{i}"] = {"position": [float(c) for c in middle], "mass": 500.0 if self.clump else 50.0,
                                        "volume": 0.065 if self.clump else 0.6}
                cuts.insert(1, f"middle{i}")
            parts = len(cuts) - 1
            for k in range(parts):
                share = (0.6, 0.4)[k] if parts == 2 else 1
                n = max(2, round(share * self.elements))
                ends = [np.array(points[c]["position"] if c in points else b) for c in cuts[k:k + 2]]
                cables[f"line{i}" + "ab"[k] * (parts == 2)] = {
                    "type": "chain", "from": cuts[k], "to": cuts[k + 1], "length": share * self.length(i), "elements": n,
                    "shape": self._shape(drawn, *ends, share * self.length(i))}
        history = [f"anchor{i}" for i in range(self.lines)] + list(cables)
        if self.holder == "buoy":
            volume = 2 * pull / (DENSITY * GRAVITY)
            points["buoy"] = {"position": [0, 0, 0], "mass": 0.2 * volume * DENSITY, "volume": volume,
                              "drag_area": 0.5 * volume**(2 / 3)}
            history.append("buoy")
        if self.holder == "body":
            volume = 2 * pull / (DENSITY * GRAVITY)
            m, d2 = 0.3 * volume * DENSITY, volume**(2 / 3)
            rooms["bodies"] = {"float": {
                "mass": m, "inertia": [0.5 * m * d2, 0.5 * m * d2, 0.5 * m * d2], "position": [0, 0, -1.5],
                "volume": volume, "center_of_buoyancy": [0, 0, 0.6],
                "attachments": {f"f{i}": [float(c) for c in self.fairlead(i) + [0, 0, 1.5]] for i in range(self.lines)},
                "drag": {"linear": [0] * 6, "quadratic": [500 * d2, 500 * d2, 500 * d2, 100, 100, 100]}}}
            history.append("float")
        fluid = {"density": DENSITY, "surface": 0}
        if self.current:
            fluid["current"] = {"profile": [[-self.depth, 0.1, 0, 0], [0, 0.6, 0.1, 0]]}
        return {
            "environment": {"gravity": GRAVITY, "fluid": fluid,
                            "seabed": {"level": -self.depth, "stiffness": self.bed, "damping": 0.1 * self.bed,
                                       "friction": self.friction}},
            "cable_types": {"chain": {"diameter": DIAMETER, "mass_per_length": MASS, "axial_stiffness": STIFFNESS,
                                      "normal_drag": 2.0, "tangential_drag": 0.4, "added_mass": 1.0,
                                      "tension_only": self.tension_only}},
            "points": points, "cables": cables, "output": {"history": history}, **rooms}
