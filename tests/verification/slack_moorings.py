"""Slack moorings with touchdown are found from any drawn shape, and are the ones of least energy."""
import numpy as np

from mooring_scenes import DIAMETER, DRAWN, STIFFNESS, Mooring
from statics_support import fixed, report_number
from support import Verification

# Fourteen draws, three shapes each.  The first ones are lines to fixed fairleads in still water.
FIXED = (34, 38, 48, 69, 123, 191, 273, 348)
OTHERS = (1, 3, 6, 8, 18, 19)
# Cables lie slack on the bed in a current.  They need not end in one shape.
DRIFTING = (54, 74, 117, 121, 133)


class Chain:
    """A line in its plane from (0, 0) on a bed to (x, z), in n straight elements that only pull: the least energy, by
    Newton's method on dense matrices, with steps that are cut until the energy falls."""

    def __init__(self, x, z, length, n, bed, weight):
        self.n, self.l, self.bed, self.end = n, length / n, bed, np.array([x, z])
        share = np.full(n + 1, self.l)
        share[[0, -1]] /= 2
        self.weight, self.contact = weight * share, bed * DIAMETER * share
        self.smoothing = max(0.2 * weight / (bed * DIAMETER), 1e-6 * DIAMETER)
        self.x = np.linspace(0, 1, n + 1)[:, None] * self.end

    def bed_push(self, z):
        """The indentation, its slope and its integral."""
        p, s = -z, self.smoothing
        q = np.clip(p, -s, s) + s
        return (np.where(p > s, p, q**2 / (4 * s)), q / (2 * s),
                q**3 / (12 * s) + np.where(p > s, 0.5 * (p - s) * (p + s), 0))

    def forces(self, x, stiffness):
        """The energy, the forces that the nodes lack, and per element its unit vector, tension and stiffness."""
        d = np.diff(x, axis=0)
        length = np.hypot(*d.T)
        e, strain = d / length[:, None], np.maximum(length / self.l - 1, 0)
        T = stiffness * strain
        P, slope, integral = self.bed_push(x[:, 1])
        lack = np.zeros_like(x)
        lack[1:] += T[:, None] * e
        lack[:-1] -= T[:, None] * e
        lack[:, 1] += self.weight - self.contact * P
        energy = 0.5 * self.l * (T * strain).sum() + (self.weight * x[:, 1]).sum() + (self.contact * integral).sum()
        return energy, lack, e, T / length, np.where(strain > 0, stiffness / self.l, 0), slope

    def solve(self):
        for stiffness in (*np.geomspace(3 * self.weight.sum(), STIFFNESS, 8),):
            self.settle(stiffness)
        return self.forces(self.x, STIFFNESS)[1]

    def settle(self, stiffness, most=400):
        keep = 1e-2
        for _ in range(most):
            energy, lack, e, turning, axial, slope = self.forces(self.x, stiffness)
            free = lack[1:-1].ravel()
            if np.abs(free).max() < 1e-9 * self.weight.sum():
                return
            K = np.zeros((self.n + 1, 2, self.n + 1, 2))
            for i in range(self.n):
                k = axial[i] * np.outer(e[i], e[i]) + turning[i] * (np.eye(2) - np.outer(e[i], e[i]))
                k += keep * self.weight.sum() / self.l * np.eye(2)
                K[i, :, i] += k
                K[i + 1, :, i + 1] += k
                K[i, :, i + 1] -= k
                K[i + 1, :, i] -= k
            K[np.arange(self.n + 1), 1, np.arange(self.n + 1), 1] += self.contact * slope
            size = 2 * (self.n - 1)
            step = -np.linalg.solve(K[1:-1, :, 1:-1].reshape(size, size), free)
            share, down = 1.0, free @ step
            while share > 1e-8:
                x = self.x.copy()
                x[1:-1] += share * step.reshape(-1, 2)
                if self.forces(x, stiffness)[0] <= energy + 1e-4 * share * down + 1e-14 * abs(energy):
                    break
                share /= 2
            self.x = x
            keep = max(keep / 5, 1e-13) if share > 0.9 else min(3 * keep, 1e3)


def on_bed(current, points, cables):
    type_ = {"diameter": 0.05, "mass_per_length": 3, "axial_stiffness": 1e6, "normal_drag": 1.2, "tangential_drag": 0.1}
    return {"environment": {"fluid": {"density": 1025, "current": {"velocity": current}},
                            "seabed": {"level": -20, "stiffness": 3e5, "friction": 0}},
            "cable_types": {"light": type_}, "points": points, "cables": cables, "output": {"history": ["b"]}}


def check_twins(v):
    """A shape that has a mirror image is the same one on any number of ranks."""
    points = {"a": fixed(0, 0, -20), "b": {"position": [10, 0, -20]}}
    cables = {f"c{n}": {"type": "light", "from": "a", "to": "b", "length": n, "elements": n} for n in (10, 15)}
    ends = []
    for ranks in (1, 2, 3):
        v.ranks = ranks
        run, done = v.attempt(on_bed([0.5, 0, 0], points, cables))
        v.close(f"twins on {ranks} ranks: exit status", done.returncode, 0, 0)
        ends.append(run["b.y"][0])
    v.ranks = 0
    v.check("twins: the end's place across the current, apart by the number of ranks [m]", np.ptp(ends), 1e-6)


def check_weak_current(v):
    """A note says where drag is lost in rounding, and only there."""
    points = {"a": fixed(0, 0, 0), "b": {"position": [20, 3, -20]}}
    cables = {"c": {"type": "light", "from": "a", "to": "b", "length": 60, "elements": 40, "shape": "catenary"}}
    for speed, notes in ((3e-5, 1), (0.3, 0)):
        scene = on_bed([0, speed, 0], points, cables)
        scene["cable_types"]["light"] |= {"tension_only": True, "mass_per_length": 20, "axial_stiffness": 1e7}
        _, done = v.attempt(scene)
        v.close(f"a current of {speed} m/s: exit status", done.returncode, 0, 0)
        v.close(f"a current of {speed} m/s: notes that it is too weak", done.stderr.count("too weak"), notes, 0)


def check_drifting(v, mooring):
    for drawn in DRAWN:
        run, done = v.attempt(mooring.scene(drawn))
        v.close(f"{mooring.name}, {drawn}: exit status", done.returncode, 0, 0)
        if done.returncode:
            print(done.stderr)
            continue
        unbalanced = report_number(run, "statics", "largest_unbalanced_force_over_load")
        if "rounding's share" not in done.stdout:
            v.check(f"{mooring.name}, {drawn}: unbalanced force", unbalanced, 1e-9)
        v.check(f"{mooring.name}, {drawn}: iterations", report_number(run, "statics", "iterations"), 500)


def solve(v, mooring):
    """From all drawn shapes.  @return their pulls at the lines' ends, one row a shape"""
    rows = []
    for drawn in DRAWN:
        run, done = v.attempt(mooring.scene(drawn))
        v.close(f"{mooring.name}, {drawn}: exit status", done.returncode, 0, 0)
        if done.returncode:
            print(done.stderr)
            return None
        pushes = done.stderr.count("push") + done.stderr.count("not stable")
        v.close(f"{mooring.name}, {drawn}: notes that cables push or that it is not stable", pushes, 0, 0)
        unbalanced = report_number(run, "statics", "largest_unbalanced_force_over_load")
        if "rounding's share" not in done.stdout:
            v.check(f"{mooring.name}, {drawn}: unbalanced force", unbalanced, 1e-9)
        v.check(f"{mooring.name}, {drawn}: iterations", report_number(run, "statics", "iterations"), 300)
        # The sign of a pull is lost in rounding where a line lies.
        rows.append([abs(run[name][0]) for name in run.columns if ".tension_" in name])
    rows = np.array(rows)
    v.check(f"{mooring.name}: pulls apart by the drawn shape, over the largest", np.ptp(rows, axis=0).max() / rows.max(),
            1e-8)
    return rows


def check_least_energy(v, mooring, row):
    """Against the independent minimum, of which each line is one of its own."""
    for i in range(mooring.lines):
        across = mooring.fairlead(i) - mooring.anchor(i)
        chain = Chain(np.hypot(*across[:2]), across[2], mooring.length(i), mooring.elements, mooring.bed,
                      mooring.weight())
        lack = chain.solve()
        largest = max(np.linalg.norm(lack[-1]), np.linalg.norm(lack[0]))
        for name, end, column in (("anchor", 0, 2 * i), ("fairlead", -1, 2 * i + 1)):
            v.close(f"{mooring.name}: pull at {name} {i} [N]", row[column], np.linalg.norm(lack[end]), 1e-3 * largest)


def main():
    verification = Verification(__doc__)
    for seed in FIXED + OTHERS:
        mooring = Mooring(seed)
        rows = solve(verification, mooring)
        if seed in FIXED and rows is not None:
            check_least_energy(verification, mooring, rows[0])
    for seed in DRIFTING:
        check_drifting(verification, Mooring(seed))
    check_twins(verification)
    check_weak_current(verification)
    verification.finish()


if __name__ == "__main__":
    main()
