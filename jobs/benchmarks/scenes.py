"""The scenes that are measured, as dicts with the keys of a scene file.  They end late: -ts_max_steps cuts runs."""
import math

SPACING = 1.713 / 24   # length of an element in examples/free_fall [m]
STEEL = {"area": 1.962e-5, "density": 7800, "youngs_modulus": 53e9}
BRANCHES = 100
ROPE = {"mass_per_length": 0.1, "axial_stiffness": 1.0e5}
BODY = {"mass": 1, "inertia": [0.01, 0.02, 0.02]}
ARM = 0.1   # from a body's centre to an attachment [m]


def chain(elements, step, end=None, interval=None, scheme=None):
    """The cable of examples/free_fall.  It is longer if it has more elements, so that all elements are alike."""
    length = SPACING * elements
    end = end or 1e4 * step
    return {
        "environment": {"gravity": 9.81},
        "cable_types": {"steel": STEEL},
        "points": {"pin": {"position": [0, 0, 0], "motion": "fixed"}, "free": {"position": [length, 0, 0]}},
        "cables": {"cable": {"type": "steel", "from": "pin", "to": "free", "length": length, "elements": elements}},
        "time": {"end": end, "step": step, **(scheme or {"scheme": "energy_momentum"})},
        "output": {"interval": interval or end, "history": ["free", "cable"], "energy": interval is not None},
    }


def array(elements):
    """A towed trunk of half the elements and 100 branches that share the other half."""
    spacing, tow = 0.5, [3, 0, 0]
    in_trunk = elements // 2
    in_branch = in_trunk // BRANCHES
    trunk, branch = spacing * in_trunk, spacing * in_branch
    every = branch
    first = spacing * ((in_branch + 1) // 2)
    return {
        "environment": {"gravity": 9.81},
        "cable_types": {"trunk": {"mass_per_length": 1.12, "axial_stiffness": 1.27e7},
                        "branch": {"mass_per_length": 0.30, "axial_stiffness": 2.0e6}},
        "points": {
            "tow": {"position": [0, 0, 0], "motion": {"velocity": tow}},
            "tail": {"position": [-0.8 * trunk, 0, -0.6 * trunk], "velocity": tow, "mass": 50},
            "tip": {"position": [-0.8 * first - 0.6 * branch, 0.8 * branch, -0.6 * first], "velocity": tow, "mass": 5},
        },
        "cables": {
            "trunk": {"type": "trunk", "from": "tow", "to": "tail", "length": trunk, "elements": in_trunk},
            "branch": {"type": "branch", "from": {"cable": "trunk", "at": first}, "to": "tip", "length": branch,
                       "elements": in_branch,
                       "repeat": {"count": BRANCHES, "every": every, "offset": [-0.8 * every, 0, -0.6 * every]}},
        },
        "time": {"end": 100, "step": 0.002},
        "output": {"interval": 100, "history": ["tail"]},
    }


def net(meshes):
    """A square net of twine that is held at its top edge and let go with one side lifted, as in examples/net."""
    side = 0.2 * meshes
    corners = [[0, 0, 0], [side, 0, 0], [side, side, 0], [0, 0.8 * side, -0.6 * side]]
    return {
        "environment": {"gravity": 9.81},
        "cable_types": {"twine": {"diameter": 2.0e-3, "density": 1140, "youngs_modulus": 1.0e8}},
        "nets": {"panel": {"type": "twine", "corners": corners, "meshes": [meshes, meshes], "fixed": ["top"]}},
        "time": {"end": 100, "step": 0.01},
        "output": {"interval": 100},
    }


def falling(points, bodies, cables):
    """A scene of ropes, point masses and bodies that are let go."""
    return {
        "environment": {"gravity": 9.81},
        "cable_types": {"rope": ROPE},
        "points": points,
        **({"bodies": bodies} if bodies else {}),
        "cables": cables,
        "time": {"end": 100, "step": 1e-3, "scheme": "energy_momentum"},
        "output": {"interval": 100},
    }


def rope(start, to, elements):
    return {"type": "rope", "from": start, "to": to, "elements": elements}


def loaded_chain(masses, elements, rigid):
    """A level chain of cables of 1 m, each of which ends at a mass.  The mass is a body or a point, from which the next
    cable goes on."""
    points, bodies, cables = {"pin": {"position": [0, 0, 0], "motion": "fixed"}}, {}, {}
    start = "pin"
    for i in range(masses):
        name = f"m{i}"
        if rigid:
            attachments = {"in": [-ARM, 0, 0], **({"out": [ARM, 0, 0]} if i + 1 < masses else {})}
            bodies[name] = {**BODY, "position": [(1 + 2 * ARM) * (i + 1) - ARM, 0, 0], "attachments": attachments}
        else:
            points[name] = {"position": [i + 1, 0, 0], "mass": BODY["mass"]}
        cables[f"c{i}"] = rope(start, f"{name}.in" if rigid else name, elements)
        start = f"{name}.out" if rigid else name
    return falling(points, bodies, cables)


def pendulums(masses, elements, rigid):
    """Level cables of 1 m, each from a fixed point of its own to a body or a point mass."""
    points, bodies, cables = {}, {}, {}
    for i in range(masses):
        pin, name = f"p{i}", f"m{i}"
        points[pin] = {"position": [0, i, 0], "motion": "fixed"}
        if rigid:
            bodies[name] = {**BODY, "position": [1 + ARM, i, 0], "attachments": {"in": [-ARM, 0, 0]}}
        else:
            points[name] = {"position": [1, i, 0], "mass": BODY["mass"]}
        cables[f"c{i}"] = rope(pin, f"{name}.in" if rigid else name, elements)
    return falling(points, bodies, cables)


def star(cables, elements):
    """A body that hangs on cables from a ring of fixed points; it is as heavy as its cables are many."""
    rays = [(math.cos(angle), math.sin(angle)) for angle in (2 * math.pi * i / cables for i in range(cables))]
    body = {"mass": 0.2 * cables, "inertia": [0.002 * cables, 0.003 * cables, 0.004 * cables], "position": [0, 0, 0],
            "attachments": {f"a{i}": [ARM * x, ARM * y, 0] for i, (x, y) in enumerate(rays)}}
    points = {f"p{i}": {"position": [3 * x, 3 * y, 2], "motion": "fixed"} for i, (x, y) in enumerate(rays)}
    return falling(points, {"hub": body}, {f"c{i}": rope(f"p{i}", f"hub.a{i}", elements) for i in range(cables)})
