"""What a run and `check` say that a scene could do without: each where it is so, nowhere else, true, and alike on any
number of ranks.  What they say of the examples is followed, and what then comes out is held against what came out."""
import csv
import json
import pathlib
import re
import subprocess
import sys

import numpy as np
import yaml

from bench import ENVIRONMENT, arguments, expect, status

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"

# Those with advice, and others that have none.
ADVISED = ("biomapper/circle", "biomapper/steady", "elastic_catenary/scene", "low_langley/static", "low_langley/heave",
           "seismic_array/scene")
SILENT = ("free_fall/scene", "hanging_chain/scene", "cable_body_pendulum/scene", "conical_pendulum/scene", "tow_fish/scene",
          "hung_body/scene", "spinning_top/scene", "low_langley/wave_45")

WATER = {"density": 1025, "surface": 0}
TOW = {"diameter": 0.02, "density": 1300, "axial_stiffness": 1e6, "normal_drag": 1.2, "tangential_drag": 0.01, "added_mass": 1}
CHAIN = {"diameter": 0.252, "mass_per_length": 390, "axial_stiffness": 1.674e9, "normal_drag": 1.37, "tangential_drag": 0.64,
         "added_mass": 1}
LIGHT, HEAVY = ({"mass_per_length": mass, "axial_stiffness": 2e4} for mass in (1e-4, 1.0))
BALL = {"mass": 5, "inertia": [0.1, 0.2, 0.3], "position": [0, 0, -2], "attachments": {"eye": [0, 0, 0.5], "heart": [0, 0, 0]}}


def scene(types, points, cables, end, step, interval, environment=None, bodies=None, history=(), **more):
    found = {"environment": environment or {}, "cable_types": types, "points": points, "cables": cables,
             "output": {"interval": interval, "history": list(history)}, **more}
    if bodies:
        found["bodies"] = bodies
    if end:
        found["time"] = {"end": end, "step": step}
    return found


def bungee(kind=LIGHT, elements=4, bodies=None, to="load", **environment):
    points = {"top": {"position": [0, 0, 0], "motion": "fixed"}, "load": {"position": [0, 0, -20], "mass": 100}}
    cable = {"type": "rope", "from": "top", "to": to, "elements": elements}
    return scene({"rope": kind}, points, {"rope": cable}, 4, 0.02, 0.04, environment, bodies, ["load", "rope"])


def hung(**keys):
    points = {"top": {"position": [0, 0, 0], "motion": "fixed"}}
    cable = {"type": "rope", "from": "top", "to": "ball.eye", "elements": 1}
    return scene({"rope": HEAVY}, points, {"rope": cable}, 1, 0.01, 0.02, {"gravity": 9.81}, {"ball": {**BALL, **keys}}, ["ball"])


def towed(elements, step=1, **water):
    """A cable behind a ship that goes ever further to one side, with its tail free."""
    way = {"x": "2*t", "y": "80*(t/100)^3", "z": "0"}
    points = {"ship": {"position": [0, 0, -5], "motion": {"expression": way}}, "tail": {"position": [-200, 0, -20]}}
    cable = {"type": "tow", "from": "ship", "to": "tail", "length": 200, "elements": elements}
    return scene({"tow": TOW}, points, {"c": cable}, 100, step, 2, {"fluid": {**WATER, **water}}, None, ["ship", "tail", "c"],
                 initial="static")


def heaved(elements):
    """A chain with touchdown whose upper end is heaved by 5 m."""
    motion = {"harmonic": {"amplitude": [0, 0, 5], "period": 10, "phase": -90}}
    points = {"top": {"position": [0, 0, -9], "motion": motion}, "anchor": {"position": [700, 0, -200], "motion": "fixed"}}
    cable = {"type": "chain", "from": "anchor", "to": "top", "length": 760, "elements": elements, "shape": "catenary"}
    environment = {"fluid": WATER, "seabed": {"level": -200, "stiffness": 1e5, "damping": 1e4, "friction": 0}}
    return scene({"chain": CHAIN}, points, {"c": cable}, 40, 0.02, 0.1, environment, None, ["c"], initial="static")


class Case:
    """Runs scenes of one program."""

    def __init__(self, given):
        self.given = given

    def start(self, command, given, *words, ranks=1):
        path = given
        if isinstance(given, dict):
            path = self.given.scratch / "scene.yaml"
            path.write_text(json.dumps(given))
        launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        done = subprocess.run([*launcher, self.given.program, command, path, *words], env=ENVIRONMENT, text=True,
                              capture_output=True, timeout=280, check=False)
        expect(done.returncode == 0, f"{command} on {ranks} ranks: status {done.returncode} {done.stderr[-300:]}")
        return [line.removeprefix("economy: ") for line in done.stdout.splitlines() if line.startswith("economy: ")]

    def run(self, given, ranks=1):
        """@return sentences, {cable: elements that it needs}, {column: values}"""
        folder = self.given.scratch / "run"
        said = self.start("run", given, "-o", folder, ranks=ranks)
        found = yaml.safe_load((folder / "run.yaml").read_text()).get("economy", {})
        expect(found.get("sentences", []) == said, f"run.yaml has what was printed: {said}")
        with open(folder / "history.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        values = dict(zip(rows[0], np.array(rows[1:], float).T))
        return said, found.get("elements_for_1_percent", {}), values

    def says(self, given, *patterns, ranks=(1, 2, 3), command="run"):
        """Each pattern fits one sentence, in their order, and there are no others.  @return the groups of the first"""
        all_said = [self.run(given, ranks=count)[0] if command == "run" else self.start(command, given) for count in ranks]
        said = all_said[0]
        found = [re.search(pattern, sentence) for pattern, sentence in zip(patterns, said)]
        expect(len(said) == len(patterns) and all(found), f"{len(patterns)} sentences {patterns}: {said}")
        expect(all(other == said for other in all_said), f"they are the same on {ranks} ranks")
        return found[0].groups() if found and found[0] else ()


def error(found, truth):
    """The largest error of any column of positions and forces: the root mean square over time, by the column's range, or
    by the tenth of its vector's where that is more; what hardly changes and all of an equilibrium by its size."""
    worst = 0.0
    for name, values in truth.items():
        kind = re.search(r"\.([xyz]|f[xyz]|tension_\w+)$", name)
        if not kind:
            continue
        vector = [truth[other] for other in truth if re.sub(r"[xyz]$", "", other) == re.sub(r"[xyz]$", "", name)]
        size = max(np.abs(other).max() for other in vector)
        scale = size if len(values) == 1 else max(np.ptp(values), 0.1 * max(map(np.ptp, vector)), 0.05 * size)
        rows = min(len(values), len(found[name]))
        worst = max(worst, float(np.sqrt(np.mean((found[name][:rows] - values[:rows])**2))) / max(scale, 1e-12))
    return worst


def straight(case):
    [metres] = case.says(bungee(), r"^elements: 1 would do for rope \(4\), whose nodes stayed within (\S+) m of the line")
    expect(float(metres) < 0.02, f"it hangs straight: {metres} m")
    truth, fewer = case.run(bungee())[2], case.run(bungee(elements=1))[2]
    expect(error(fewer, truth) < 0.01, f"one element does: {error(fewer, truth):.2g}")
    # A rope of a fifth of the load has waves of tension; a blow from the side bends it.
    case.says(bungee(kind=HEAVY), ranks=(1,))
    swinging = bungee(kind={"mass_per_length": 0.5, "axial_stiffness": 2e4}, elements=12)
    swinging["points"]["load"]["velocity"] = [5, 0, 0]
    case.says(swinging, ranks=(1,))
    many = bungee()
    many["points"] |= {f"p{i}": {"position": [i, 0, 0], "motion": "fixed"} for i in range(1, 6)}
    many["points"] |= {f"q{i}": {"position": [i, 0, -20], "mass": 100} for i in range(1, 6)}
    many["cables"] |= {f"c{i}": {"type": "rope", "from": f"p{i}", "to": f"q{i}", "elements": 3} for i in range(1, 6)}
    case.says(many, r"^elements: 1 would do for rope \(4\), c1 \(3\), c2 \(3\) and 3 more, whose nodes")


def fewer(case):
    [needs] = case.says(towed(150), r"^elements that 1 % needs by the cables' bends: c (\d+) \(has 150\)$")
    expect(10 <= int(needs) <= 40, f"{needs} elements")
    truth = case.run(towed(150))[2]
    worse = error(case.run(towed(int(needs)))[2], truth)
    expect(worse < 0.01, f"with {needs} elements the error is {worse:.2g}")
    case.says(towed(int(needs) + 5), ranks=(1,))
    # Out of the water vibration lasts, and on the bed it is not bends alone that count.
    case.says(towed(150, surface=-300), r"^no environment.fluid would do", ranks=(1,))


def more(case):
    [needs] = case.says(heaved(8), r"^too few elements for 1 % by the cables' bends, which want about: c (\d+) \(has 8\)$")
    truth = case.run(heaved(160))[2]
    needs = int(needs)
    errors = {elements: error(case.run(heaved(elements))[2], truth) for elements in (8, needs // 2, 2 * needs)}
    expect(errors[8] > 0.02 and errors[needs // 2] > 0.01 > errors[2 * needs], f"a factor of two about {needs}: {errors}")
    case.says(heaved(60), ranks=(1,))


def bodies(case):
    case.says(hung(), "^no inertia would do for ball, which never turned by more than 0.1 degrees")
    truth = case.run(hung())[2]
    point = hung()
    del point["bodies"]["ball"]["inertia"]
    point = case.run(point)[2]
    expect(max(np.abs(point[f"ball.{k}"] - truth[f"ball.{k}"]).max() for k in "xyz") < 1e-9, "a point mass goes the same way")
    case.says(hung(velocity=[0.5, 0, 0]), ranks=(1,))
    spinning = hung(angular_velocity=[0, 0, 1])
    case.says(spinning, ranks=(1,))
    # In an equilibrium it counts how far it has turned from what is drawn.
    tilted = hung(orientation={"pitch": 1})
    del tilted["time"]
    case.says(tilted, ranks=(1,))
    del tilted["bodies"]["ball"]["orientation"]
    case.says(tilted, "^no inertia would do for ball", ranks=(1,))


def surroundings(case):
    waves = [{"height": 2, "period": 8, "direction": 0, "phase": 0}, {"height": 1e-3, "period": 9, "direction": 0, "phase": 0},
             {"height": 2, "period": 2, "direction": 30, "phase": 0}]
    sea = {"depth": 100, "waves": waves}
    faint = r"^1 of 3 waves adds less than 0.1 % of the water's motion at the surface: leave out wave 2$"
    case.says(towed(20, **sea), faint, command="check", ranks=(1,))
    case.says(towed(20, **{**sea, "waves": waves[::2]}), command="check", ranks=(1,))
    deep = towed(20, **sea)
    for point in deep["points"].values():
        point["position"][2] = -60
    deep["time"]["end"] = 10
    case.says(deep, r"^2 of 3 waves together add less than 0.1 % .* at the highest node, z = -60 m: leave out waves 2 and 3$")
    rope = {**HEAVY, "diameter": 0.01}
    dry = bungee(kind=rope, fluid={"density": 1025, "surface": -50})
    [metres] = case.says(dry, r"^no environment.fluid would do: no node came lower than (\S+) m above the surface$")
    expect(10 < float(metres) < 30, f"{metres} m above the surface")
    case.says(bungee(kind=rope, fluid={"density": 1025, "surface": -21}), ranks=(1,))
    bed = {"stiffness": 1e5, "damping": 1e4}
    [metres] = case.says(bungee(kind=rope, seabed={"level": -60, **bed}),
                         r"^no environment.seabed would do: nothing came nearer to it than (\S+) m$")
    expect(10 < float(metres) < 40, f"{metres} m above the bed")
    case.says(bungee(kind=rope, seabed={"level": -20.1, **bed}), ranks=(1,))


def steps(case):
    fine = r"^steps of (\S+) s would do for 1 %: those of 0.02 s err by less than 0.01 %$"
    [good] = case.says(towed(20, step=0.02), fine, ranks=(1, 2))
    truth = case.run(towed(20, step=0.02))[2]
    worse = error(case.run(towed(20, step=float(good)))[2], truth)
    expect(worse < 0.01, f"with steps of {good} s the error is {worse:.2g}")
    case.says(towed(20, step=float(good)), ranks=(1,))


def checks(case):
    def wire(gravity=0, end=(10, 0, 0), elements=20, motion="fixed", **keys):
        points = {"a": {"position": [0, 0, 0], "motion": "fixed"}, "b": {"position": list(end), "motion": motion}}
        points["c"] = {"position": [0, 0, 5]}
        cables = {"wire": {"type": "rope", "from": "a", "to": "b", "elements": elements, **keys},
                  "other": {"type": "rope", "from": "a", "to": "c", "elements": 2}}
        return scene({"rope": HEAVY}, points, cables, 1, 0.01, 0.1, {"gravity": gravity})

    case.says(wire(), r"^elements: 1 does for wire \(20\): without gravity, water and bed nothing bends it$", command="check",
              ranks=(1,))
    for other in (wire(gravity=9.81), wire(elements=1), wire(length=10.5), wire(motion={"velocity": [0, 1, 0]}),
                  wire(length=9, shape=[[0, 0, 0], [5, 0.1, 0], [10, 0, 0]]),
                  wire(motion={"expression": {"x": "0", "y": "step(t-0.4)*(t-0.4)^3", "z": "0"}})):
        case.says(other, command="check", ranks=(1,))
    alone = wire()
    del alone["cables"]["other"], alone["points"]["c"]
    case.says(alone, command="check", ranks=(1,))
    central = hung()
    central["cables"]["rope"]["to"] = "ball.heart"
    case.says(central, "^no inertia is needed for ball: cables pull at the centre of gravity", command="check", ranks=(1,))
    case.says(hung(), command="check", ranks=(1,))
    central["bodies"]["ball"]["torque"] = [0, 0, 1]
    case.says(central, command="check", ranks=(1,))


def examples(case):
    for name in ADVISED:
        path = EXAMPLES / f"{name}.yaml"
        text = path.read_text()
        said, needs, truth = case.run(path)
        expect(said and needs, f"{name}: {said}")
        of = {cable.partition("[")[0]: elements for cable, elements in needs.items()}
        # The key stands once in each cable, in the cables' order.
        cables = iter(yaml.safe_load(text)["cables"])
        followed = case.given.scratch / "followed.yaml"
        followed.write_text(re.sub(r"elements: (\d+)", lambda old: f"elements: {of.get(next(cables), old[1])}", text))
        worse = error(case.run(followed)[2], truth)
        expect(worse < 0.01, f"{name}: with {of} the error is {worse:.2g}")
    for name in SILENT:
        said = case.run(EXAMPLES / f"{name}.yaml")[0]
        expect(not said, f"{name}: {said}")


PARTS = (straight, fewer, more, bodies, surroundings, steps, checks, examples)


def main():
    case = Case(arguments(__doc__))
    for part in PARTS:
        part(case)
    return status()


if __name__ == "__main__":
    sys.exit(main())
