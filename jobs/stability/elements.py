"""The motion of two-node elements with a consistent mass, by the explicit method of Runge and Kutta of fourth order.

It reads the same scene as the program and shares no line with it: bars or ropes, point masses, weight, Morison's drag and
added mass of what is wholly in the water, and points that are fixed or follow a law.  With N nodes the mass is a dense
matrix, so that it serves for small scenes alone.
"""
import math

import numpy as np


class Elements:
    """The elements of a scene.

    @param laws  {point: function of the time that returns position, velocity and acceleration}
    """

    def __init__(self, made, laws=None):
        environment = made["environment"]
        fluid = environment.get("fluid", {})
        self.gravity, self.density = environment.get("gravity", 9.80665), fluid.get("density", 0.0)
        self.current = np.array(fluid.get("current", {}).get("velocity", [0, 0, 0]), float)
        points = made["points"]
        self.names, self.laws = list(points), dict(laws or {})
        self.positions = [np.array(keys["position"], float) for keys in points.values()]
        self.velocities = [np.array(keys.get("velocity", [0, 0, 0]), float) for keys in points.values()]
        self.masses = [keys.get("mass", 0.0) for keys in points.values()]
        self.ends, self.kinds, self.lengths = [], [], []
        for keys in made["cables"].values():
            self._lay(keys, made["cable_types"][keys["type"]])
        for name, keys in points.items():
            if keys.get("motion") == "fixed":
                self.laws[name] = lambda _, x=np.array(keys["position"], float): (x, 0 * x, 0 * x)
        self._gather()

    def _lay(self, keys, kind):
        first, last = (self.names.index(keys[end]) for end in ("from", "to"))
        n = keys["elements"]
        shape = np.array(keys.get("shape", np.linspace(self.positions[first], self.positions[last], n + 1)), float)
        speeds = keys.get("node_velocity", np.linspace(self.velocities[first], self.velocities[last], n + 1))
        length = keys.get("length", np.linalg.norm(np.diff(shape, axis=0), axis=1).sum())
        nodes = [first, *range(len(self.positions), len(self.positions) + n - 1), last]
        for k in range(1, n):
            self.positions.append(shape[k])
            self.velocities.append(np.array(speeds[k], float))
            self.masses.append(0.0)
        self.ends += list(zip(nodes[:-1], nodes[1:]))
        self.lengths += [length / n] * n
        self.kinds += [kind] * n

    def _gather(self):
        """Turns the lists into arrays, one row an element or a node."""
        self.x, self.v = np.array(self.positions), np.array(self.velocities)
        self.i, self.j = np.array(self.ends).T
        self.length = np.array(self.lengths)
        of = lambda key, absent=0.0: np.array([float(kind.get(key, absent)) for kind in self.kinds])
        self.stiffness, self.pushes, diameter = of("axial_stiffness"), of("tension_only") == 0, of("diameter")
        displaced = self.density * math.pi / 4 * diameter**2
        self.across = 0.5 * self.density * diameter * of("normal_drag")
        self.along = 0.5 * self.density * math.pi * diameter * of("tangential_drag")
        self.added = displaced * of("added_mass")
        per_length = of("mass_per_length")
        self.mass, self.load = np.diag(self.masses).astype(float), np.zeros_like(self.x)
        self.load[:, 2] = -self.gravity * np.array(self.masses)
        for i, j, m, w in zip(self.i, self.j, per_length * self.length, (per_length - displaced) * self.length):
            self.mass[np.ix_((i, j), (i, j))] += m / 6 * np.array([[2, 1], [1, 2]])
            self.load[[i, j], 2] -= self.gravity * w / 2
        self.moved = [self.names.index(name) for name in self.laws]
        self.free = np.setdiff1d(np.arange(len(self.x)), self.moved)
        self.inverse = np.linalg.inv(self.mass[np.ix_(self.free, self.free)])
        nodes, rows = len(self.x), np.arange(len(self.i))
        self.sum = np.zeros((nodes, len(rows)))   # adds an element's force to its ends
        self.sum[self.i, rows], self.sum[self.j, rows] = 1, -1

    def _drag(self, x, v, u):
        """The water's force on each node: half of what is taken at the element's middle, and half of the couple by which
        drag slows a turning rod. @param u  the elements' directions"""
        past = self.current - (v[self.i] + v[self.j]) / 2
        slide = (past * u).sum(axis=1, keepdims=True)
        cross = past - slide * u
        push = (self.across[:, None] * np.linalg.norm(cross, axis=1, keepdims=True) * cross
                + self.along[:, None] * np.abs(slide) * slide * u) * self.length[:, None] / 2
        apart = v[self.j] - v[self.i]
        apart -= (apart * u).sum(axis=1, keepdims=True) * u
        couple = (self.across * self.length / 24)[:, None] * np.linalg.norm(cross, axis=1, keepdims=True) * apart
        return np.abs(self.sum) @ push + self.sum @ couple

    def _accelerations(self, x, v, given):
        chord = x[self.j] - x[self.i]
        size = np.sqrt((chord * chord).sum(axis=1))
        tension = self.stiffness * (size / self.length - 1)
        tension = np.where(self.pushes, tension, np.maximum(tension, 0))
        u = chord / size[:, None]
        force = self.load + self.sum @ (tension[:, None] * u)
        if self.across.any() or self.along.any():
            force += self._drag(x, v, u)
        a = np.zeros_like(x)
        a[self.moved] = given
        if self.added.any():
            return self._with_added_mass(force, a, u)
        a[self.free] = self.inverse @ (force - self.mass @ a)[self.free]
        return a

    def _with_added_mass(self, force, a, u):
        """Water moves with an element across it, which couples the axes."""
        nodes = len(a)
        mass = np.einsum("ij,ab->iajb", self.mass, np.eye(3))
        for i, j, m, d in zip(self.i, self.j, self.added * self.length, u):
            across = m / 6 * (np.eye(3) - np.outer(d, d))
            mass[i, :, i] += 2 * across
            mass[j, :, j] += 2 * across
            mass[i, :, j] += across
            mass[j, :, i] += across
        mass = mass.reshape(3 * nodes, 3 * nodes)
        rest = force.ravel() - mass @ a.ravel()
        free = (3 * self.free[:, None] + np.arange(3)).ravel()
        a = a.copy()
        a[self.free] = np.linalg.solve(mass[np.ix_(free, free)], rest[free]).reshape(-1, 3)
        return a

    def _rates(self, t, x, v):
        x, v, given = x.copy(), v.copy(), np.zeros((len(self.moved), 3))
        for k, (node, law) in enumerate(zip(self.moved, self.laws.values())):
            x[node], v[node], given[k] = law(t)
        return v, self._accelerations(x, v, given)

    def motion(self, times, watched, most):
        """The positions (times, 3) of a point. @param most  the longest step [s]"""
        x, v, node, rows = self.x.copy(), self.v.copy(), self.names.index(watched), [self.x[self.names.index(watched)]]
        for start, end in zip(times[:-1], times[1:]):
            steps = math.ceil((end - start) / most - 1e-9)
            h = (end - start) / steps
            for k in range(steps):
                t = start + k * h
                v1, a1 = self._rates(t, x, v)
                v2, a2 = self._rates(t + h / 2, x + h / 2 * v1, v + h / 2 * a1)
                v3, a3 = self._rates(t + h / 2, x + h / 2 * v2, v + h / 2 * a2)
                v4, a4 = self._rates(t + h, x + h * v3, v + h * a3)
                x, v = x + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            rows.append(x[node])
        return np.array(rows)

    def longest(self):
        """The longest stable step of dry elements, with a margin of two [s]."""
        heavy = self.mass[np.ix_(self.free, self.free)]
        size = np.zeros_like(self.mass)
        for i, j, k in zip(self.i, self.j, self.stiffness / self.length):
            size[np.ix_((i, j), (i, j))] += k * np.array([[1, -1], [-1, 1]])
        fastest = np.linalg.eigvals(np.linalg.solve(heavy, size[np.ix_(self.free, self.free)])).real.max()
        return 1.4 / math.sqrt(fastest)
