"""Measures rigid bodies: their cost beside that of point masses, a body with many cables, and two ranks."""
import re

from . import scenes
from .runs import RunFailed, Samples, number

KINDS = {"chain": scenes.loaded_chain, "each on a cable of its own": scenes.pendulums}


def newton(stepping):
    return f"{stepping.newton / stepping.steps:.2f}"


def products(stepping):
    """Products of two 3x3 blocks per node in a factorisation, as in the run's first line.  It is a dash where MUMPS
    solved."""
    found = re.search(r"([\d.]+) block products a node", stepping.long.report["linear_solver"])
    return found[1] if found else "-"


def beside_points(laboratory, page, masses, elements, steps):
    page.write(f"{masses} bodies and as many cables of {elements} elements, beside point masses, {steps} steps; CPU of "
               "a step:\n")
    rows = []
    for name, scene in KINDS.items():
        bodies, points = scene(masses, elements, rigid=True), scene(masses, elements, rigid=False)
        try:
            pairs = laboratory.repeat(lambda: [laboratory.stepping(each, steps) for each in (bodies, points)])
        except RunFailed as problem:
            page.missing(f"bodies, {name}", problem)
            continue
        body, point = (Samples(1e3 * pair[i].per_step() for pair in pairs) for i in (0, 1))
        first = pairs[0]
        rows.append([name, *map(newton, first), *map(products, first), *body.cells(), *point.cells(),
                     number(body.least / point.least), number(1e3 * (body.least - point.least) / masses)])
    page.table(["scene", "Newton per step, bodies", "points", "products a node, bodies", "points",
                "bodies [ms] min", "median", "spread", "points [ms] min", "median", "spread", "ratio, fastest of each",
                "a body beyond a point [us]"], rows)


def many_cables(laboratory, page, counts, elements, steps):
    page.write(f"\nOne body on cables of {elements} elements, {steps} steps; CPU of a step:\n")
    rows, each = [], {}
    for cables in counts:
        scene = scenes.star(cables, elements)
        try:
            runs = laboratory.repeat(lambda: laboratory.stepping(scene, steps))
        except RunFailed as problem:
            page.missing(f"a body with {cables} cables", problem)
            continue
        cost = Samples(1e9 * run.per_step() / (cables * elements) for run in runs)
        each[cables] = cost.least * steps / runs[0].newton
        rows.append([cables, cables * elements, newton(runs[0]), number(1e-6 * cost.least * cables * elements),
                     *cost.cells(), number(each[cables]), products(runs[0])])
    page.table(["cables", "elements", "Newton per step", "step [ms] min", "ns per element min", "median",
                "spread", "ns per element and iteration", "products a node"], rows)
    if len(each) > 1:
        few, many = min(each), max(each)
        page.target(f"a body with {many} cables over {few}: element and iteration", each[many] / each[few], 1.5)


def two_ranks(laboratory, page, masses, elements, steps):
    page.write(f"\nThe chain of {masses} bodies, and that of point masses, on two ranks; wall time of a step:\n")
    rows = []
    for name, rigid in (("bodies", True), ("points", False)):
        scene = scenes.loaded_chain(masses, elements, rigid)
        try:
            pairs = laboratory.repeat(lambda: [laboratory.stepping(scene, steps, ranks=ranks) for ranks in (1, 2)],
                                      2 * laboratory.repetitions)
        except RunFailed as problem:
            page.missing(f"chain of {name} on two ranks", problem)
            continue
        one, two = (Samples(1e3 * pair[i].per_step("wall") for pair in pairs) for i in (0, 1))
        rows.append([name, *one.cells(), *two.cells(), number(one.least / two.least), *map(products, pairs[0])])
    page.table(["chain", "1 rank [ms] min", "median", "spread", "2 ranks [ms] min", "median", "spread",
                "1 rank over 2, fastest of each", "products a node, 1 rank", "2 ranks"], rows)


def bodies(laboratory, page, masses, elements, steps, cables, per_cable):
    """@param masses  number of bodies, each with a cable of `elements` elements
    @param cables  how many cables one body has, in each measurement, with `per_cable` elements each"""
    page.heading("9. Rigid bodies, step 1e-3 s, energy_momentum")
    beside_points(laboratory, page, masses, elements, steps)
    many_cables(laboratory, page, cables, per_cable, steps)
    two_ranks(laboratory, page, masses, elements, steps)
