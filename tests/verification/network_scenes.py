"""Networks of every kind, drawn from a seed: trees, loops, nets, floats on pendants and bodies; in still water, in a
current or in air; with a bed or without; slack to taut."""
import numpy as np

from statics_support import fixed

DENSITY, GRAVITY = 1025, 9.81
KINDS = ("tree", "loop", "net", "pendants", "body", "body on lines")


class Network:
    """One draw.  `scene(drawn)` is the scene; `drawn` numbers the drawn shapes, of which 0 is straight."""

    def __init__(self, seed):
        random = self._random = np.random.default_rng(10_000 + seed)
        pick = lambda *of: of[random.integers(len(of))]
        self.seed, self.kind = seed, pick(*KINDS)
        self.water = bool(random.random() < 0.7)
        self.current = bool(self.water and random.random() < 0.4)
        self.bed = bool(random.random() < 0.5)
        self.tension_only = bool(random.random() < 0.6)
        self.size = 10**random.uniform(0.5, 2.5)
        self.depth = self.size * random.uniform(0.3, 2)
        self.stiffness = 10**random.uniform(5, 9)
        self.mass = 10**random.uniform(-0.5, 2)
        self.diameter = 2 * np.sqrt(self.mass / (np.pi * 10**random.uniform(3.2, 3.9)))
        self.bed_stiffness = 10**random.uniform(4, 8)
        self.most_surplus = pick(0.0, 0.02, 0.2, 1.0)
        self.elements = pick(4, 10, 25)
        self.parts = {"points": {}, "cables": {}, "nets": {}, "bodies": {}}
        getattr(self, "_" + self.kind.replace(" ", "_"))()

    @property
    def name(self):
        around = "current" if self.current else "water" if self.water else "air"
        return (f"{self.seed}: {self.kind} of {self.size:.3g} m in {around}, {'bed' if self.bed else 'no bed'}, slack up to "
                f"{100 * self.most_surplus:.0f} %, {'ropes' if self.tension_only else 'bars'}")

    @property
    def is_convex(self):
        """Cables that do not push, under dead loads: one least energy, whatever is drawn."""
        return self.tension_only and not self.current and "body" not in self.kind

    def weight(self):
        """Of a cable where it is.  [N/m]"""
        return (self.mass - self.water * DENSITY * np.pi * self.diameter**2 / 4) * GRAVITY

    def _somewhere(self, depth=(0.1, 0.9)):
        x, y = self._random.uniform(-0.5, 0.5, 2) * self.size
        return np.array([x, y, -self.depth * self._random.uniform(*depth)])

    def _point(self, name, position, **keys):
        self.parts["points"][name] = {"position": [float(c) for c in position], **keys}

    def _hold(self, name, position):
        self.parts["points"][name] = fixed(*map(float, position))

    def _place(self, end):
        if "." in end:
            body, attachment = end.split(".")
            body = self.parts["bodies"][body]
            return np.array(body["position"]) + body["attachments"][attachment]
        return np.array(self.parts["points"][end]["position"])

    def _cable(self, name, start, end, surplus=None):
        surplus = self._random.uniform(0, 1) * self.most_surplus if surplus is None else surplus
        length = float((1 + surplus) * np.linalg.norm(self._place(end) - self._place(start)))
        self.parts["cables"][name] = {"type": "rope", "from": start, "to": end, "length": length, "elements": self.elements}

    def _mass(self):
        """A point's mass: as heavy as a tenth to ten times a cable of the network's size."""
        return float(self.mass * self.size * 10**self._random.uniform(-1, 1))

    def _tree(self):
        self._hold("root", [0, 0, 0])
        names = ["root"]
        for i in range(self._random.integers(2, 9)):
            parent = names[self._random.integers(len(names))]
            self._point(f"p{i}", self._place(parent) + self.size * self._random.uniform([-0.3, -0.3, -0.4], [0.3, 0.3, -0.1]),
                        mass=self._mass())
            self._cable(f"c{i}", parent, f"p{i}")
            names.append(f"p{i}")

    def _loop(self):
        n = int(self._random.integers(3, 8))
        held = set(self._random.permutation(n)[:self._random.integers(2, n)])
        for i in range(n):
            angle = 2 * np.pi * i / n
            place = 0.5 * self.size * np.array([np.cos(angle), np.sin(angle), 0]) - [0, 0, 0.3 * self.depth]
            self._hold(f"p{i}", place) if i in held else self._point(f"p{i}", place, mass=self._mass())
        for i in range(n):
            self._cable(f"c{i}", f"p{i}", f"p{(i + 1) % n}")
        self._point("hub", [0, 0, -0.5 * self.depth], mass=self._mass())
        for i in range(n):
            self._cable(f"s{i}", f"p{i}", "hub")

    def _net(self):
        nx, ny = (int(n) for n in self._random.integers(3, 13, 2))
        side = self.size / nx
        top = -0.2 * self.depth
        turn = self._random.uniform(0, np.pi / 2)
        down = side * ny * np.array([0, np.cos(turn), -np.sin(turn)])
        corners = [np.array([0, 0, top]), np.array([side * nx, 0, top])]
        corners += [corners[1] + down, corners[0] + down]
        by_corners = self._random.random() < 0.4
        self.parts["nets"]["panel"] = {"type": "rope", "corners": [[float(c) for c in p] for p in corners],
                                       "meshes": [nx, ny], "slack": 1 + 0.2 * self.most_surplus}
        if not by_corners:
            self.parts["nets"]["panel"]["fixed"] = [["top"], ["top", "bottom"], ["top", "left"]][self._random.integers(3)]
            return
        nodes = [[0, 0], [nx, 0], [nx, ny], [0, ny]][:2 + 2 * self._random.integers(2)]
        for i, node in enumerate(nodes):
            self._hold(f"p{i}", corners[i] + [0, 0, 0.2 * self.size])
            self.parts["cables"][f"c{i}"] = {"type": "rope", "from": f"p{i}", "to": {"net": "panel", "node": node},
                                             "length": float(0.2 * self.size), "elements": 2}

    def _pendants(self):
        """A line from an anchor to a fairlead, with floats and clumps on pendants that are shorter than what is below."""
        self._hold("a", self._somewhere((1, 1)))
        self._hold("b", self._somewhere((0, 0.2)))
        start, end = self._place("a"), self._place("b")
        n = int(self._random.integers(1, 5))
        names = ["a"]
        for i in range(n):
            middle = start + (i + 1) / (n + 1) * (end - start)
            self._point(f"m{i}", middle)
            floats = self.water and self._random.random() < 0.6
            mass = self._mass()
            room = -middle[2] if floats else self.depth + middle[2]
            up = [0, 0, (1 if floats else -1) * self._random.uniform(0.1, 0.8) * room]
            self._point(f"e{i}", middle + up, mass=mass, volume=2.5 * mass / DENSITY if floats else 0.1 * mass / DENSITY)
            self._cable(f"pendant{i}", f"m{i}", f"e{i}", 0)
            names.append(f"m{i}")
        names.append("b")
        for i, pair in enumerate(zip(names, names[1:])):
            self._cable(f"c{i}", *pair)

    def _add_body(self, centre, attachments, lift):
        """@param lift  the body's buoyancy over its weight"""
        arm = 0.05 * self.size
        mass = 5 * self._mass()
        self.parts["bodies"]["hull"] = {
            "mass": mass, "inertia": [mass * arm**2 * f for f in (0.4, 0.5, 0.6)], "position": [float(c) for c in centre],
            "attachments": {f"a{i}": [float(c) for c in arm * np.array(place)] for i, place in enumerate(attachments)}}
        if self.water:
            self.parts["bodies"]["hull"] |= {"volume": float(lift * mass / DENSITY), "center_of_buoyancy": [0, 0, 0.3 * arm]}

    def _body(self):
        """A body that hangs from one to four held points."""
        n = int(self._random.integers(1, 5))
        rays = [[np.cos(2 * np.pi * i / n), np.sin(2 * np.pi * i / n), 0.5] for i in range(n)] if n > 1 else [[0, 0, 1]]
        self._add_body([0, 0, -0.6 * self.depth], rays, 0.3)
        for i, ray in enumerate(rays):
            self._hold(f"p{i}", 0.4 * self.size * np.array([ray[0], ray[1], 0]) * (n > 1))
            self._cable(f"c{i}", f"p{i}", f"hull.a{i}")

    def _body_on_lines(self):
        """A body that floats under water on lines to the ground, or in air hangs on lines and steadies some."""
        n = int(self._random.integers(3, 6))
        rays = [[np.cos(2 * np.pi * i / n), np.sin(2 * np.pi * i / n), -0.3] for i in range(n)]
        sign = 1 if self.water else -1
        self._add_body([0, 0, -0.5 * self.depth], [[x, y, sign * z] for x, y, z in rays], 3)
        for i, (x, y, _) in enumerate(rays):
            place = 0.4 * self.size * np.array([x, y, 0]) + [0, 0, -self.depth if self.water else 0]
            self._hold(f"p{i}", place)
            self._cable(f"c{i}", f"p{i}", f"hull.a{i}", self._random.uniform(0, 0.1) * self.most_surplus)

    def _shape(self, keys, drawn):
        """0 straight, 1 crumpled, 2 a polyline that hangs aside."""
        ends = keys["from"], keys["to"]
        if drawn == 0 or not all(isinstance(end, str) for end in ends):
            return {}
        a, b = map(self._place, ends)
        random = np.random.default_rng(self.seed)
        shares = np.arange(1, keys["elements"]) / keys["elements"] if drawn == 1 else (0.3, 0.7)
        inner = [a + t * (b - a) + (0.05 if drawn == 1 else 0.2) * keys["length"] * random.uniform(-1, 1, 3) for t in shares]
        return {"shape": [[float(c) for c in p] for p in (a, *inner, b)]}

    def scene(self, drawn=0):
        environment = {"gravity": GRAVITY}
        if self.water:
            environment["fluid"] = {"density": DENSITY}
            if self.current:
                environment["fluid"]["current"] = {"profile": [[-self.depth, 0.05, 0.02, 0], [0, 0.4, 0.1, 0]]}
        if self.bed:
            corners = [corner for net in self.parts["nets"].values() for corner in net["corners"]]
            lowest = min([-self.depth, *(z for *_, z in corners)])   # No edge is held inside the bed.
            environment["seabed"] = {"level": float(1.001 * lowest), "stiffness": self.bed_stiffness / self.diameter}
        rope = {"mass_per_length": self.mass, "axial_stiffness": self.stiffness, "diameter": self.diameter,
                "tension_only": self.tension_only}
        if self.water:
            rope |= {"normal_drag": 1.2, "tangential_drag": 0.05, "added_mass": 1}
        cables = {name: {**keys, **self._shape(keys, drawn)} for name, keys in self.parts["cables"].items()}
        points = {name: {**keys} for name, keys in self.parts["points"].items()}
        rooms = {"nets": self.parts["nets"], "bodies": self.parts["bodies"], "cables": cables, "points": points}
        history = [*cables, *points, *self.parts["bodies"]]
        return {"environment": environment, "cable_types": {"rope": rope}, "output": {"history": history},
                **{name: room for name, room in rooms.items() if room}}
