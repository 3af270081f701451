"""Hard scenes, each with the steps to try and an exact or independent answer.

An error is the largest distance of what is watched from the answer, over how far the answer moves.  A scene ends before
neighbouring motions part, which is where its answer, calculated with half the steps, differs.
"""
import math

import numpy as np

import adaptive
import bed_friction
import hard_scenes
import stiff_pendulum
import tables
from support import HELD, scene

GRAVITY = 9.81


class Case:
    """A scene, how it is answered and what is compared.

    @param off  of a run: its errors, one a row, over the motion
    @param origin  where the answer comes from, in words
    """

    def __init__(self, name, made, steps, off, origin):
        self.name, self.made, self.steps, self.off, self.origin = name, made, steps, off, origin


def against(name, made, steps, watched, exact, origin):
    """A case whose point must follow a path. @param exact  positions (rows, 3)"""
    moved = np.linalg.norm(exact - exact[0], axis=1).max()

    def off(run):
        path = run.vectors(watched)
        if len(path) != len(exact):
            return np.array([np.inf])
        return np.linalg.norm(path - exact, axis=1) / moved

    return Case(name, made, steps, off, origin)


def stored(key, name, made, steps, watched, laws=None, halvings=0):
    """A case whose answer is a table that `tables.py` calculates with the elements of `elements.py`."""
    origin = "the same elements by the explicit Runge-Kutta method of fourth order (elements.py), stored"
    exact = tables.path(key, made, watched, laws, halvings)
    made["time"]["end"] = made["output"]["interval"] * (len(exact) - 1)
    return against(name, made, steps, watched, exact, origin)


def of_motion(name, motion, size, steps):
    """A case of the motions that adaptive steps are verified with. @param size  how far it moves [m]"""
    return Case(name, motion.made, steps, lambda run: motion.off(run) / size,
                "closed form" if "rope" in motion.name and "body" not in motion.name
                else "the equations of motion, extrapolated to order 10")


# -------------------------------------------------------------------------------------------------- closed forms
def stiff():
    """A bar goes round without gravity: Kuhl and Crisfield's pendulum."""
    length, rate = stiff_pendulum.LENGTH, stiff_pendulum.SPEED / stiff_pendulum.LENGTH
    points = {"pin": HELD, "bob": {"position": [0, 0, -length], "velocity": [stiff_pendulum.SPEED, 0, 0]}}
    made = scene(stiff_pendulum.ROD, points, {"from": "pin", "to": "bob", "elements": 1}, 20, 0.01, 0.4, ["bob"], 0)
    angle = rate * 0.4 * np.arange(51)
    exact = length * np.column_stack([np.sin(angle), 0 * angle, -np.cos(angle)])
    return against("stiff pendulum, no gravity, 20 s", made, (0.01, 0.05, 0.1, 0.2), "bob", exact, "closed form")


def bungee():
    return of_motion("load that bounces on a slack rope", adaptive.bungee(), 5, (1e-3, 5e-3, 0.02, 0.05))


def snap():
    return of_motion("mass that snaps a massless rope taut", adaptive.snap(), 1, (1e-3, 5e-3, 0.02, 0.05))


def cone():
    """A bob goes round in a level circle for 1000 s.  Its radius and height are compared, its phase is not."""
    length, stiffness, per_length, mass, radius = 2.0, 5e4, 0.1, 5.0, 1.2
    low, high = 1.0, 3.0
    weight = (mass + per_length * length / 2) * GRAVITY
    for _ in range(200):   # The rod's pull carries the weight at a height that bisection finds.
        height = (low + high) / 2
        chord = math.hypot(radius, height)
        low, high = (height, high) if stiffness * (chord / length - 1) * height / chord < weight else (low, height)
    pull = stiffness * (chord / length - 1)
    rate = math.sqrt(pull / chord / (mass + per_length * length / 3))
    points = {"pin": HELD, "bob": {"position": [radius, 0, -height], "velocity": [0, radius * rate, 0], "mass": mass}}
    made = scene({"mass_per_length": per_length, "axial_stiffness": stiffness}, points,
                 {"from": "pin", "to": "bob", "elements": 1, "length": length}, 1000, 0.01, 10, ["bob"], GRAVITY)

    def off(run):
        level = np.hypot(run["bob.x"], run["bob.y"])
        return np.hypot(level - radius, run["bob.z"] + height) / radius

    return Case("conical pendulum for 1000 s", made, (0.01, 0.05, 0.1), off, "closed form")


def friction():
    """A block is thrown on a rough bed.  The bed's grip gives way by some of its travel, so that a little is allowed."""
    speed, rate = 5.0, bed_friction.MU * bed_friction.GRAVITY
    made = bed_friction.block(2, 0.01, 0.1, velocity=[0.6 * speed, 0.8 * speed, 0])
    del made["output"]["energy"]
    t = np.minimum(0.1 * np.arange(21), speed / rate)
    exact = np.outer(speed * t - rate * t**2 / 2, [0.6, 0.8, 0])
    exact[:, 2] = bed_friction.RADIUS - bed_friction.SINK
    return against("block that slides and stops by friction", made, (2e-3, 0.01, 0.05, 0.1), "block", exact, "closed form")


# -------------------------------------------------------------------------------------------------- integrated anew
def cone_released():
    return of_motion("soft conical pendulum, let go slack", adaptive.conical(), 3, (1e-3, 5e-3, 0.02, 0.05))


def chain():
    return of_motion("hanging chain that swings", adaptive.chain(), 3.5, (5e-3, 0.02, 0.05, 0.1))


def spinning():
    return of_motion("free body at 100 rad/s", adaptive.spinning(), 3.2, (1e-3, 5e-3, 0.01, 0.05))


def hung():
    return of_motion("body pendulum on a stiff rope", adaptive.hung(), 0.6, (1e-3, 5e-3, 0.02, 0.05))


def tripod():
    made = hard_scenes.tripod(1e-3)
    made["time"]["end"] = 1
    exact = hard_scenes.explicit_tripod(0.05 * np.arange(21))
    return against("snap-through of a shallow tripod, 1 s", made, (2.5e-4, 1e-3, 5e-3, 0.025), "mass", exact,
                   "explicit solution of order 8")


# -------------------------------------------------------------------------------------------------- stored tables
def whip():
    steel = {"mass_per_length": 7800 * 1.962e-5, "axial_stiffness": 53e9 * 1.962e-5}
    points = {"pin": HELD, "tip": {"position": [1.713, 0, 0]}}
    made = scene(steel, points, {"from": "pin", "to": "tip", "elements": 24}, 1.2, 1e-3, 0.04, ["tip"])
    return stored("whip", "cable that falls about its pin", made, (5e-4, 2e-3, 5e-3, 0.02), "tip")


def dropped():
    """A mass falls from the side and pulls a sagging rope taut."""
    rope = {"mass_per_length": 0.05, "axial_stiffness": 1e5, "tension_only": True}
    points = {"pin": HELD, "mass": {"position": [4.5, 0, 0], "mass": 10}}
    shape = [[0.45 * k, 0, -0.9 * math.sin(math.pi * k / 10)] for k in range(11)]
    cable = {"from": "pin", "to": "mass", "elements": 10, "length": 5.4, "shape": shape}
    made = scene(rope, points, cable, 1.2, 1e-3, 0.04, ["mass"])
    return stored("dropped", "mass dropped on a slack rope", made, (1e-3, 2e-3, 0.01, 0.04), "mass", halvings=2)


def hawser():
    """A tug leaves at 1 m/s and snaps the hawser of a barge that floats without gravity taut."""
    hemp = {"mass_per_length": 2.0, "axial_stiffness": 2e6, "tension_only": True}
    points = {"tug": {"position": [9.8, 0, 0], "velocity": [1, 0, 0], "motion": {"velocity": [1, 0, 0]}},
              "barge": {"position": [0, 0, 0], "mass": 2000}}
    shape = [[9.8 * k / 6, 0.35 * math.sin(math.pi * k / 6), 0] for k in range(7)]
    speeds = [[k / 6, 0, 0] for k in range(7)]
    cable = {"from": "barge", "to": "tug", "elements": 6, "length": 10, "shape": shape, "node_velocity": speeds}
    made = scene(hemp, points, cable, 1.5, 1e-3, 0.05, ["barge"], 0)
    laws = {"tug": lambda t: (np.array([9.8 + t, 0, 0]), np.array([1.0, 0, 0]), np.zeros(3))}
    del points["tug"]["velocity"]
    return stored("hawser", "hawser that snaps taut", made, (1e-3, 5e-3, 0.02, 0.05), "barge", laws, halvings=1)


def net():
    """A net of twine hangs from its upper edge, drawn askew and let go."""
    twine = {"mass_per_length": 3.6e-3, "axial_stiffness": 300, "tension_only": True}
    mesh, across, down = 0.25, 4, 4
    points, cables = {}, {}
    for i in range(across + 1):
        for j in range(down + 1):
            place = [i * mesh, 0.1 * mesh * j, -0.99 * j * mesh]
            points[f"n{i}_{j}"] = {"position": place, "motion": "fixed"} if j == 0 else {"position": place, "mass": 0.01}
            for there, before in ((f"h{i}_{j}", (i - 1, j)), (f"v{i}_{j}", (i, j - 1))):
                if min(before) >= 0 and not (there[0] == "h" and j == 0):
                    cables[there] = {"from": f"n{before[0]}_{before[1]}", "to": f"n{i}_{j}", "elements": 1,
                                     "length": mesh}
    made = scene(twine, points, cables, 1.5, 1e-3, 0.05, ["n2_4"])
    return stored("net", "hung net let go askew", made, (1e-3, 5e-3, 0.02, 0.05), "n2_4", halvings=3)


def pushed():
    """A moved end shortens a line of bars, which buckle."""
    bar = {"mass_per_length": 0.2, "axial_stiffness": 1e5}
    side = [math.sin(math.pi * k / 8) for k in range(9)]
    points = {"pin": HELD, "end": {"position": [2, 0, 0], "motion": {"velocity": [-0.5, 0, 0]}},
              "half": {"position": [1, 0.02, -0.03]}}
    shape = [[0.25 * k, 0.02 * s, -0.03 * s] for k, s in enumerate(side)]
    speeds = [[-0.0625 * k, 0, 0] for k in range(9)]
    points["half"]["velocity"] = speeds[4]
    cables = {"a": {"from": "pin", "to": "half", "elements": 4, "length": 1, "shape": shape[:5], "node_velocity": speeds[:5]},
              "b": {"from": "half", "to": "end", "elements": 4, "length": 1, "shape": shape[4:], "node_velocity": speeds[4:]}}
    laws = {"end": lambda t: (np.array([2 - 0.5 * t, 0, 0]), np.array([-0.5, 0, 0]), np.zeros(3))}
    made = scene(bar, points, cables, 0.1, 1e-4, 0.01, ["half"])
    return stored("pushed", "bars that are pushed and buckle", made, (1e-4, 5e-4, 1e-3, 5e-3), "half", laws, halvings=2)


def contrast():
    """A hard and a soft part, EA 1e4 apart."""
    points = {"pin": HELD, "mid": {"position": [1, 0, 0]}, "tip": {"position": [1.8, 0, 0], "mass": 0.5}}
    cables = {"steel": {"from": "pin", "to": "mid", "elements": 2}, "rubber": {"from": "mid", "to": "tip", "elements": 4}}
    made = scene({"mass_per_length": 0.15, "axial_stiffness": 100}, points, cables, 2, 1e-3, 0.1, ["tip"])
    made["cable_types"]["hard"] = {"mass_per_length": 0.15, "axial_stiffness": 1e6}
    made["cables"]["steel"]["type"] = "hard"
    return stored("contrast", "steel and rubber, EA 1e4 apart", made, (1e-3, 5e-3, 0.02, 0.05), "tip")


def bob():
    points = {"pin": HELD, "bob": {"position": [3, 0, 0], "mass": 1000}}
    made = scene({"mass_per_length": 0.01, "axial_stiffness": 2e5}, points, {"from": "pin", "to": "bob", "elements": 3},
                 4, 5e-3, 0.2, ["bob"])
    return stored("bob", "bob 3e4 times as heavy as its wire", made, (5e-3, 0.02, 0.05, 0.2), "bob")


# -------------------------------------------------------------------------------------------------- in water
def hose():
    """A hose as heavy as water, in a current."""
    water = {"density": 1025, "current": {"velocity": [2.0, 0.5, 0]}}
    kind = {"mass_per_length": 1025 * math.pi / 4 * 0.05**2, "axial_stiffness": 1e5, "diameter": 0.05, "normal_drag": 1.5,
            "tangential_drag": 0.01, "added_mass": 1.0}
    points = {"pin": HELD, "tip": {"position": [0, 0, -20]}}
    made = scene(kind, points, {"from": "pin", "to": "tip", "elements": 10}, 20, 0.1, 0.5, ["tip"])
    made["environment"]["fluid"] = water
    return stored("hose", "neutral hose in a strong current", made, (0.02, 0.1, 0.25, 0.5), "tip")


def light():
    """Drag is 1e3 times a line's inertia."""
    kind = {"mass_per_length": 1025 * math.pi / 4 * 0.002**2, "axial_stiffness": 5e3, "tension_only": True,
            "diameter": 0.002, "normal_drag": 1.5, "tangential_drag": 0.02}
    points = {"pin": HELD, "tip": {"position": [-4, 0, -3]}}
    made = scene(kind, points, {"from": "pin", "to": "tip", "elements": 10}, 4, 0.02, 0.1, ["tip"])
    made["environment"]["fluid"] = {"density": 1025, "current": {"velocity": [1.0, 0, 0]}}
    return stored("light", "light line turned by a current", made, (5e-3, 0.02, 0.05, 0.1), "tip")


def turn():
    """A ship tows a weighted cable and turns about in half a circle."""
    speed, radius, straight = 3.0, 30.0, 5.0
    end = straight + math.pi * radius / speed
    kind = {"diameter": 0.02, "mass_per_length": 0.5, "axial_stiffness": 1e5, "normal_drag": 1.2, "tangential_drag": 0.01,
            "added_mass": 1.0}
    on, back = f"step(t - {straight})", f"step(t - {end!r})"
    angle = f"{speed / radius}*(t - {straight})"
    x = (f"{speed}*t*(1 - {on}) + ({on} - {back})*({speed * straight} + {radius}*sin({angle}))"
         f" + {back}*({speed * straight} - {speed}*(t - {end!r}))")
    y = f"({on} - {back})*{radius}*(1 - cos({angle})) + {back}*{2 * radius}"
    points = {"ship": {"position": [0, 0, 0], "motion": {"expression": {"x": x, "y": y, "z": "0"}}},
              "tail": {"position": [-92, 0, -39], "velocity": [speed, 0, 0], "mass": 5}}
    cable = {"from": "ship", "to": "tail", "length": 100, "elements": 10, "node_velocity": [[speed, 0, 0]] * 11}
    made = scene(kind, points, cable, 60, 0.2, 1, ["tail"])
    made["environment"]["fluid"] = {"density": 1025}

    def law(t):
        if t < straight or t > end:
            way = 1 if t < straight else -1
            place = [speed * t, 0, 0] if way > 0 else [speed * straight - speed * (t - end), 2 * radius, 0]
            return np.array(place), np.array([way * speed, 0, 0]), np.zeros(3)
        a = speed / radius * (t - straight)
        turned = np.array([math.sin(a), -math.cos(a), 0])
        return (np.array([speed * straight, radius, 0]) + radius * turned,
                speed * np.array([math.cos(a), math.sin(a), 0]), -speed**2 / radius * turned)

    return stored("turn", "tow in a half turn", made, (0.05, 0.2, 0.5, 1), "tail", {"ship": law})


ALL = {make.__name__: make for make in (
    stiff, bungee, snap, cone, cone_released, chain, bob, whip, dropped, hawser, net, pushed, contrast, tripod, spinning,
    hung, friction, hose, light, turn)}
