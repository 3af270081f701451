"""Measures single chains: the free fall, sizes beside the hand-written chain, a million elements, memory."""
from . import scenes
from .runs import RunFailed, Samples, number

PETSC_LU = ("-ksp_type", "preonly", "-pc_type", "lu", "-pc_factor_mat_ordering_type", "natural")
STEP = 1e-3
# The events of each phase.  The first kind of events that took any time counts: PETSc's serve where cablenet has none.
PHASES = {
    "residual": (("CableResidual",), ("SNESFunctionEval",)),
    "tangent": (("CableTangent",), ("SNESJacobianEval",)),
    "factor": (("CableFactor",), ("MatLUFactorSym", "MatLUFactorNum")),
    "solve": (("CableSolve",), ("MatSolve",)),
    "exchange": (("CableExchange",),),
}


def free_fall(laboratory, page):
    page.heading("1. Free fall, 24 elements, energy_momentum")
    rows = []
    for step, end, limit in ((1e-3, 2.8, 25), (1e-4, 0.7, 15)):
        scene = scenes.chain(24, step, end, 0.02)
        runs = laboratory.repeat(lambda: laboratory.run(scene))
        steps = runs[0].report["steps"]
        solve = Samples(1e6 * run.clock("cpu")["solve"] / steps for run in runs)
        both = Samples(1e6 * (run.clock("cpu")["solve"] + run.clock("cpu")["output"]) / steps for run in runs)
        target = page.target(f"free fall, step {step:g} s: CPU of a step", solve.least, limit, " us")
        newton = runs[0].report["newton_iterations"] / steps
        rows.append([f"{step:g}", steps, f"{newton:.2f}", *solve.cells(), number(both.least), target])
    page.table(["step [s]", "steps", "Newton per step", "solve [us/step] min", "median", "spread", "with output, min",
                "target"], rows)


def phases(stepping):
    """{phase: ns per unknown and Newton iteration}.  Events that are not in the log count 0."""
    events = stepping.events()
    seconds = {}
    for phase, kinds in PHASES.items():
        sums = [sum(events.get(name, 0) for name in kind) for kind in kinds]
        seconds[phase] = next((value for value in sums if value > 0), 0)
    known = sum(seconds.values())
    whole = stepping.seconds("wall")
    vectors = sum(value for name, value in events.items() if name.startswith("Vec"))
    if events.get("TSStep", 0) > 0:
        vectors = events["TSStep"] - known
    seconds["vectors"] = vectors
    seconds["output"] = stepping.seconds("wall", "output")
    seconds["rest"] = whole - known - vectors
    return {phase: stepping.per_unknown_iteration(value) for phase, value in seconds.items()}


def one_size(laboratory, page, elements, steps):
    """@return a row of sizes, a row of phases, and ns per unknown and iteration"""
    scene = scenes.chain(elements, STEP)
    length = scenes.SPACING * elements
    repetitions = laboratory.repetitions if elements < 1e6 else min(2, laboratory.repetitions)
    mine, theirs, petsc, logged = [], [], [], []
    for _ in range(repetitions):
        mine.append(laboratory.stepping(scene, steps))
        theirs.append(laboratory.chain(elements, STEP, 1 + steps, length))
        petsc.append(laboratory.stepping(scene, steps, *PETSC_LU))
        logged.append(laboratory.stepping(scene, steps, events=True))
    unit = Samples(run.per_unknown_iteration(run.seconds()) for run in mine)
    hand = Samples(float(line["ns_per_unknown_iteration"]) for line in theirs)
    hand_step = Samples(1e-6 * float(line["us_per_step"]) for line in theirs)
    ratio = min(run.per_step() for run in mine) / hand_step.least
    lu = Samples(run.per_unknown_iteration(run.seconds()) for run in petsc)
    if elements in (1000, 100000):
        page.target(f"chain of {elements} elements: step over the hand-written one's", ratio, 3)
    newton = mine[0].newton / mine[0].steps
    hand_newton = int(theirs[0]["newton"]) / int(theirs[0]["steps"])
    row = [elements, mine[0].steps, f"{newton:.2f}", *unit.cells(), f"{hand_newton:.2f}", number(hand.least),
           number(ratio), number(lu.least)]
    return row, phases(min(logged, key=lambda run: run.seconds("wall"))), unit.least


def sizes(laboratory, page, counts):
    """@param counts  {elements: steps}.  The target is for the largest chain of at most 1e5 elements, to which the
    others are compared."""
    page.heading("2. Chains, step 1e-3 s; CPU of whole steps, ns per unknown and Newton iteration")
    rows, splits, units = [], {}, {}
    for elements, steps in counts.items():
        try:
            row, splits[elements], units[elements] = one_size(laboratory, page, elements, steps)
            rows.append(row)
        except RunFailed as problem:
            page.missing(f"chain of {elements} elements", problem)
    page.table(["elements", "steps", "Newton per step", "min", "median", "spread", "hand-written: Newton per step",
                "ns", "step over hand-written", "with PETSc's LU"], rows)
    if not splits:
        return
    page.write("\nBy phase, from the fastest run with -log_view (wall time):\n")
    names = list(next(iter(splits.values())))
    page.table(["elements", *names], [[elements, *(f"{split[name]:.1f}" for name in names)]
                                      for elements, split in splits.items()])
    reference = max(elements for elements in units if elements <= 1e5)
    page.target(f"chain of {reference} elements: unknown and iteration", units[reference], 90, " ns")
    linear = splits[reference]["factor"] + splits[reference]["solve"]
    page.target(f"chain of {reference} elements: factor and solve", linear, 25, " ns")
    for elements in units:
        if elements != reference:
            page.target(f"chain of {elements} elements over {reference}", units[elements] / units[reference], 1.5)


def large(laboratory, page, elements, steps):
    page.heading(f"5. A chain of {elements} elements; wall time from the program's start")
    scene = scenes.chain(elements, STEP)
    rows = []
    for count in (1, steps):
        repetitions = 1 if count > 1 else min(2, laboratory.repetitions)
        runs = laboratory.repeat(lambda: laboratory.run(scene, steps=count), repetitions)
        wall = Samples(run.wall for run in runs)
        memory = max(run.memory for run in runs) / elements
        rows.append([count, *wall.cells(), *(number(runs[0].clock("wall")[phase]) for phase in
                                             ("set_up", "solve", "output")), number(memory / 1000)])
        if count == 1:
            page.target(f"{elements} elements: the first step done", wall.least, 15, " s")
            page.target(f"{elements} elements: memory of one", memory / 1000, 2.5, " kB")
    page.table(["steps", "wall [s] min", "median", "spread", "set-up", "solve", "output", "kB per element"], rows)


def memory(laboratory, page, elements):
    page.heading(f"6. Memory at the peak, {elements} elements")
    small = laboratory.run(scenes.chain(24, STEP), steps=1).memory
    run = laboratory.run(scenes.chain(elements, STEP), steps=3)
    beyond = (run.memory - small) / elements / 1000
    target = page.target(f"{elements} elements: memory of one", run.memory / elements / 1000, 2.5, " kB")
    page.table(["elements", "MB", "kB per element", "beyond the free fall's", "target"],
               [[elements, number(run.memory / 1e6), number(run.memory / elements / 1000), number(beyond), target]])
