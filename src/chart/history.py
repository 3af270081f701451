"""The quantities of a run's history, and what their errors are scaled by."""
import csv

import numpy

# The columns of one vector, by the end of their names.  Those that are not here stand alone.
VECTORS = {"position": ("x", "y", "z"), "velocity": ("vx", "vy", "vz"), "acceleration": ("ax", "ay", "az"),
           "force": ("fx", "fy", "fz"), "attitude": ("qw", "qx", "qy", "qz"), "angular velocity": ("wx", "wy", "wz")}
KIND = {ending: kind for kind, endings in VECTORS.items() for ending in endings}

# A component that moves less than this share of its vector's largest one is scaled by the share.
LEAST_COMPONENT = 0.1

# What hardly changes is scaled by this share of its size: its range would be rounding's.
LEAST_CHANGE = 1e-3


def read(path):
    """@returns times, and {column: its values}.  Quaternions are without jumps of sign."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    values = numpy.array(rows[1:], float).reshape(-1, len(rows[0]))
    columns = {name: values[:, place] for place, name in enumerate(rows[0])}
    times = columns.pop("time")
    for body in [name.removesuffix(".qw") for name in columns if name.endswith(".qw")]:
        smooth_attitude(columns, [f"{body}.{ending}" for ending in VECTORS["attitude"]])
    return times, columns


def smooth_attitude(columns, names):
    """A quaternion and its opposite are one attitude: takes the one that is nearer to that before."""
    quaternion = numpy.array([columns[name] for name in names])
    turns = numpy.sign(numpy.sum(quaternion[:, 1:] * quaternion[:, :-1], axis=0))
    signs = numpy.cumprod(numpy.concatenate([[1.0 if quaternion[0, 0] >= 0 else -1.0], numpy.where(turns < 0, -1, 1)]))
    for name, values in zip(names, quaternion * signs):
        columns[name] = values


def kind_of(column):
    name, _, ending = column.rpartition(".")
    return "energy" if name == "energy" else KIND.get(ending, ending)


def group_of(column):
    """The vector that a column belongs to; all energies are one."""
    return (column.rpartition(".")[0], kind_of(column))


def scales(columns, is_static):
    """{column: what its error is divided by}; 0 where nothing changes.
    @param columns  of the reference"""
    size = {name: numpy.abs(values).max() for name, values in columns.items()}
    extent = {name: numpy.ptp(values) for name, values in columns.items()}
    if is_static:
        extent = static_extents(columns, size)
    groups = {}
    for name in columns:
        groups.setdefault(group_of(name), []).append(name)
    result = {}
    for (_, kind), names in groups.items():
        largest = max(extent[name] for name in names)
        if kind not in ("position", "attitude"):
            largest = max(largest, LEAST_CHANGE * max(size[name] for name in names))
        share = LEAST_COMPONENT if kind in VECTORS else 1.0
        for name in names:
            scale = max(extent[name], share * largest)
            result[name] = scale if scale > 1e-12 * size[name] else 0.0
    return result


def static_extents(columns, size):
    """An equilibrium has no range: forces are scaled by their size, positions by the extent of all of them."""
    positions = [name for name in columns if kind_of(name) == "position"]
    places = {ending: [columns[name][0] for name in positions if name.endswith(ending)] for ending in "xyz"}
    extent = max((numpy.ptp(values) for values in places.values() if values), default=0.0)
    return {name: extent if kind_of(name) == "position" else size[name] for name in columns}
