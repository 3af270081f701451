"""Hanging cables (inclined, taut, slack, loaded) reach exact polygons from all kinds of drawn shapes.  With more
elements they approach the elastic catenary at second order."""
import numpy as np

from statics_support import TOLERANCE, at_rest, drawn, fixed, report_number, still
from support import Verification, orders, read_reference

SHAPES = ("straight", "catenary", "slack", "up", "crumpled", "nonsense")
FEWER_SHAPES = ("catenary", "nonsense")   # the shapes for the finer polygons; a coarser one is drawn in all shapes
GRAVITY = 10
# Elements of the coarsest of three meshes, for cables with sharp bends: their order does not show with 20 elements.
COARSEST = {"E4_slack_deep": 80, "E5_near_fold": 2560, "E11_steep_down": 160, "E15_uplift_load": 40}


class Case:
    """A cable, which is a row of the reference."""

    def __init__(self, table, row):
        self.values = {key: column[row] for key, column in table.items()}
        self.name, self.model = str(self["name"]), str(self["model"])
        self.end = np.array([self["span"], 0, self["height"]])
        self.load, self.loaded_at = np.zeros(3), None
        if self["load"] != "none":
            given = dict(word.split("=") for word in str(self["load"]).split())
            self.load, self.loaded_at = np.array([float(given["Fx"]), 0, float(given["Fz"])]), float(given["s"])
        elif not np.isnan(self["xload"]):
            self.loaded_at = {"E16_JK_selfweight_only": 125.88,
                              "E18_JK_imperial_selfweight": 125.84695176}.get(self.name)

    def __getitem__(self, key):
        return self.values[key]

    def scene(self, shape, cuts, seed=1):
        """@param cuts  {point's name: (unstretched length up to it, elements up to it)}, in order; "b" is the end"""
        random = np.random.default_rng(seed)
        points, cables, history = {"a": fixed(0, 0, 0), "b": fixed(*self.end)}, {}, ["a"]
        s0, n0, last = 0, 0, "a"
        for name, (s, n) in cuts.items():
            if name != "b":
                points[name] = {"position": list(s / self["L0"] * self.end)}
                if s == self.loaded_at:
                    points[name]["force"] = list(self.load)
            ends = [points[last]["position"], points[name]["position"]]
            cables[f"to_{name}"] = {"from": last, "to": name, "length": s - s0, "elements": n - n0,
                                    "shape": drawn(shape, *ends, s - s0, n - n0, random)}
            history.append(name)
            s0, n0, last = s, n, name
        keys = {"mass_per_length": self["w"] / GRAVITY, "axial_stiffness": self["EA"]}
        return still(keys, points, cables, history, GRAVITY)

    def force_error(self, run):
        """The error of the forces on the ends a and b, over the smaller of the two forces."""
        found = np.array([-at_rest(run, "a", "f"), at_rest(run, "b", "f")])
        expected = np.array([[self["HA"], 0, self["VA"]], [self["HB"], 0, self["VB"]]])
        return np.abs(found - expected).max() / np.linalg.norm(expected, axis=1).min()

    def polygon_cuts(self, n):
        """Cuts at the middle, the lowest and the loaded node of n equal elements, and these nodes' exact places."""
        size, w = self["L0"] / n, self["w"]
        pull = np.array([self["HA"], 0, self["VA"]])
        nodes = [np.zeros(3)]
        loaded = round(self.loaded_at / size) if self.loaded_at else None
        for i in range(n):
            pull = pull - (self.load if i == loaded else 0) + [0, 0, w * size * (0.5 if i == 0 else 1)]
            tension = np.linalg.norm(pull)
            nodes.append(nodes[-1] + size * (1 + tension / self["EA"]) * pull / tension)
        lowest = int(np.argmin([node[2] for node in nodes]))
        places = {"mid": n // 2, "low": lowest, "load": loaded if loaded else n // 2}
        where = {i: (self[f"x{name}"], 0, self[f"z{name}"]) for name, i in places.items()
                 if not np.isnan(self[f"x{name}"])}
        inner = sorted(i for i in where if 0 < i < n)
        cuts = {f"node{i}": (self.loaded_at if i == loaded else i * size, i) for i in inner}
        return {**cuts, "b": (self["L0"], n)}, {f"node{i}": np.array(where[i]) for i in inner}


def check_polygons(v, cases):
    """From every drawn shape the cable comes to the polygon that the forces of the reference give."""
    worst = {}
    for case in cases:
        cuts, where = case.polygon_cuts(int(case.model[len("NPFEM_N"):]))
        for seed, shape in enumerate(SHAPES if case.model != "NPFEM_N20" else FEWER_SHAPES):
            run, done = v.attempt(case.scene(shape, cuts, seed))
            if done.returncode:
                v.close(f"{case.name}, {case.model}, {shape}: exit status", done.returncode, 0, 0)
                print(done.stderr)
                continue
            places = max((np.abs(at_rest(run, name) - place).max() for name, place in where.items()), default=0)
            iterations = int(report_number(run, "statics", "iterations"))
            found = case.force_error(run), places / case["L0"], iterations
            if max(found[:2]) > TOLERANCE:
                print(f"        {case.name}, {case.model}, {shape}: forces {found[0]:.1e}, places {found[1]:.1e}")
            worst[shape] = np.maximum(worst.get(shape, 0), found)
    for shape, (forces, places, iterations) in worst.items():
        v.check(f"polygons, {shape}: forces off over the end's pull", forces, TOLERANCE)
        v.check(f"polygons, {shape}: nodes off over the length", places, TOLERANCE)
        v.check(f"polygons, {shape}: iterations", iterations, 100)


def continuum_errors(v, case, n):
    """The errors of the forces over the pull at an end, and of the place of the middle or the loaded point over the
    length."""
    s = case.loaded_at if case.loaded_at else 0.5 * case["L0"]
    run = v.run(case.scene("straight", {"m": (s, round(n * s / case["L0"])), "b": (case["L0"], n)}))
    name = "load" if case.loaded_at else "mid"
    place = np.linalg.norm(at_rest(run, "m")[::2] - [case[f"x{name}"], case[f"z{name}"]])
    return case.force_error(run), place / case["L0"]


def check_orders(v, cases):
    for case in cases:
        n = COARSEST.get(case.name, 20)
        errors = zip(*(continuum_errors(v, case, k * n) for k in (1, 2, 4)))
        for what, found in zip(("forces", "place"), errors):
            print(f"        {case.name}: {what} off with {n}, {2 * n}, {4 * n} elements: {np.array(found)}")
            for order in orders(found):
                v.close(f"{case.name}: order of the {what}", order, 2, 0.1)


def check_ranks(v, cases):
    """More ranks find the same equilibrium."""
    for case, shape in cases:
        cuts, _ = case.polygon_cuts(int(case.model[len("NPFEM_N"):]))
        for v.ranks in (1, 2, 3):
            run = v.run(case.scene(shape, cuts))
            v.close(f"{case.name}, {shape}: ranks", run.counted("ranks"), v.ranks, 0)
            v.check(f"{case.name}, {shape}, {v.ranks} ranks: forces off", case.force_error(run), TOLERANCE)
    v.ranks = None


def main():
    verification = Verification(__doc__)
    table = read_reference("statics.csv")
    cases = [Case(table, row) for row in range(len(table["name"]))]
    polygons = [case for case in cases if case.model != "continuum"]
    check_polygons(verification, polygons)
    check_orders(verification, [case for case in cases if case.model == "continuum"])
    chosen = {"E4_slack_deep": "straight", "E11_steep_down": "nonsense", "E13_quarter_load_inclined": "up"}
    check_ranks(verification, [(case, chosen[case.name]) for case in polygons
                               if case.name in chosen and case.model == "NPFEM_N20"])
    verification.finish()


if __name__ == "__main__":
    main()
