"""Counts what each feature of a scene adds to a step: one scene, and one feature at a time."""
import copy
import shutil

from .instructions import collected

ELEMENTS, LENGTH, STEP = 100, 50.0, 0.01


def base():
    """A rope with a load hangs from a point that is driven to and fro."""
    motion = {"harmonic": {"amplitude": [1, 0, 0], "period": 5, "phase": 0}}
    return {
        "environment": {"gravity": 9.81},
        "cable_types": {"rope": {"mass_per_length": 1.0, "axial_stiffness": 1e6, "diameter": 0.02}},
        "points": {"top": {"position": [0, 0, 0], "motion": motion}, "load": {"position": [0, 0, -LENGTH], "mass": 20}},
        "cables": {"rope": {"type": "rope", "from": "top", "to": "load", "length": LENGTH, "elements": ELEMENTS}},
        "initial": "static",
        "time": {"end": 1e4, "step": STEP},
        "output": {"interval": 1e4, "history": ["load", "rope"]},
    }


def rope(scene):
    return scene["cable_types"]["rope"]


def weightless(scene):
    scene["environment"]["gravity"] = 0
    scene["points"]["load"]["force"] = [0, 0, -400]


def damped(scene):
    rope(scene)["rayleigh"] = {"mass": 0.02, "stiffness": 1e-3}


def tension_only(scene):
    rope(scene)["tension_only"] = True


def water(scene, **fluid):
    rope(scene).update(normal_drag=1.2, tangential_drag=0.01, added_mass=1.0)
    scene["environment"]["fluid"] = {"density": 1025, **fluid}


def surface(scene, **fluid):
    water(scene, surface=20.0, **fluid)


def current(scene):
    water(scene, current={"velocity": [0.3, 0, 0]})


def waves(scene, count=1):
    sea = [{"height": 0.5, "period": 6 + 0.1 * i, "direction": 0, "phase": 37 * i} for i in range(count)]
    surface(scene, depth=100, waves=sea)


def bed(scene, level=-200.0, **more):
    scene["environment"]["seabed"] = {"level": level, "stiffness": 1e5, "damping": 1e4, **more}


def lying(scene, **more):
    """The rope's lower half lies on the bed."""
    del scene["points"]["load"]["mass"]
    scene["points"]["load"]["position"] = [30, 0, -25]
    scene["cables"]["rope"]["shape"] = "catenary"
    bed(scene, -25.0, **more)


def body(scene):
    del scene["points"]["load"]
    scene["bodies"] = {"load": {"mass": 20, "inertia": [1, 1, 2], "position": [0, 0, -LENGTH - 0.5],
                                "attachments": {"eye": [0, 0, 0.5]}}}
    scene["cables"]["rope"]["to"] = "load.eye"


def adaptive(scene):
    scene["time"]["adaptive"] = {"tolerance": 1e-4}


def accounts(scene):
    scene["output"]["energy"] = True


def written(scene):
    scene["output"]["interval"] = STEP


FEATURES = [
    ("the rope with a load", lambda scene: None), ("no gravity, a force instead", weightless), ("Rayleigh damping", damped),
    ("`tension_only`", tension_only), ("water: drag, added mass, buoyancy", water), ("water with a surface", surface),
    ("water with a current", current), ("water with a wave", waves), ("water with 20 waves", lambda scene: waves(scene, 20)),
    ("a bed that nothing touches", bed), ("half of it on the bed, no friction", lambda scene: lying(scene, friction=0)),
    ("half of it on the bed, friction", lambda scene: lying(scene, friction=0.5)), ("a body instead of the load", body),
    ("adaptive steps", adaptive), ("`output.energy`", accounts), ("a row and a frame every step", written)]


def counted(laboratory, scene, few, many):
    """Unknowns, Newton iterations a step, instructions a step, of the steps after `few`."""
    instructions, newton = [], []
    for steps in (few, many):
        instructions.append(collected(laboratory, scene, steps))
        report = laboratory.report()
        newton.append(report["newton_iterations"])
    return report["unknowns"], (newton[1] - newton[0]) / (many - few), (instructions[1] - instructions[0]) / (many - few)


def features(laboratory, page, few, many):
    page.heading(f"11. What a feature adds to a step: a rope of {ELEMENTS} elements, steps {few} to {many} of {STEP} s")
    if not shutil.which("valgrind"):
        page.write("not measured: valgrind is not installed")
        return
    rows, plain = [], None
    for name, change in FEATURES:
        scene = copy.deepcopy(base())
        change(scene)
        unknowns, newton, instructions = counted(laboratory, scene, few, many)
        plain = plain or instructions
        rows.append([name, unknowns, f"{newton:.2f}", f"{instructions:,.0f}".replace(",", " "),
                     f"{instructions / newton:,.0f}".replace(",", " "), f"{instructions / plain:.2f}"])
    page.table(["scene", "unknowns", "Newton a step", "instructions a step", "an iteration", "over the first"], rows)
