"""The scenes that are measured; dicts as the file would have them.  They end late: runs are cut with -ts_max_steps."""

SPACING = 1.713 / 24   # m, an element of the free fall
STEEL = {"area": 1.962e-5, "density": 7800, "youngs_modulus": 53e9}
BRANCHES = 100


def chain(elements, step, end=None, interval=None, scheme=None):
    """The cable of examples/free_fall, longer with more elements, so that elements stay alike."""
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
    """A square net of twine, held at its top edge and let go with one side lifted, as examples/net."""
    side = 0.2 * meshes
    corners = [[0, 0, 0], [side, 0, 0], [side, side, 0], [0, 0.8 * side, -0.6 * side]]
    return {
        "environment": {"gravity": 9.81},
        "cable_types": {"twine": {"diameter": 2.0e-3, "density": 1140, "youngs_modulus": 1.0e8}},
        "nets": {"panel": {"type": "twine", "corners": corners, "meshes": [meshes, meshes], "fixed": ["top"]}},
        "time": {"end": 100, "step": 0.01},
        "output": {"interval": 100},
    }
