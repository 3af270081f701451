"""Measures arrays and nets, on one rank and on more."""
from . import scenes
from .runs import RunFailed, Samples, number

MUMPS = ("-ksp_type", "preonly", "-pc_type", "lu", "-pc_factor_mat_solver_type", "mumps")
DEFAULTS, BY_MUMPS = "defaults", "all by MUMPS"
NET_SOLVERS = {DEFAULTS: (), "-snes_lag_jacobian 1": ("-snes_lag_jacobian", 1), BY_MUMPS: MUMPS}
RANKS = (1, 2, 3, 4, 7)


def two_ranks(laboratory, page, counts):
    """@param counts  {elements: (steps, target for the time of one rank over that of two)}"""
    page.heading(f"3. Arrays with {scenes.BRANCHES} branches on two ranks; wall time of a step")
    rows = []
    for elements, (steps, limit) in counts.items():
        scene = scenes.array(elements)
        try:
            pairs = laboratory.repeat(lambda: [laboratory.stepping(scene, steps, ranks=ranks) for ranks in (1, 2)],
                                      2 * laboratory.repetitions)
        except RunFailed as problem:
            page.missing(f"array of {elements} elements on two ranks", problem)
            continue
        one, two = (Samples(1e3 * pair[i].per_step("wall") for pair in pairs) for i in (0, 1))
        ratio = Samples(pair[0].per_step("wall") / pair[1].per_step("wall") for pair in pairs)
        fastest = one.least / two.least
        target = page.target(f"array of {elements} elements: 1 rank over 2, fastest of each", fastest, limit, at_least=True)
        newton = pairs[0][0].newton / pairs[0][0].steps
        rows.append([elements, steps, f"{newton:.2f}", number(one.least), number(two.least), number(fastest),
                     *ratio.cells(), target])
    page.table(["elements", "steps", "Newton per step", "1 rank [ms] min", "2 ranks [ms] min", "ratio of these",
                "ratio in a pair min", "median", "spread", "target"], rows)
    page.write("\nWhoever else uses the machine slows two ranks that wait for each other more than one, so the fastest "
               "runs of each are compared.")


def linear_iterations(laboratory, page, elements):
    page.write(f"\nLinear iterations per Newton iteration, array of {elements} elements:\n")
    row = []
    for ranks in RANKS:
        report = laboratory.run(scenes.array(elements), ranks=ranks, steps=10).report
        row.append(report["linear_iterations"] / report["newton_iterations"])
    page.table([f"{ranks} ranks" if ranks > 1 else "1 rank" for ranks in RANKS], [list(map(number, row))])
    page.target("array: linear iterations per Newton iteration, up to 7 ranks", max(row), 1)


def arrays(laboratory, page, counts):
    two_ranks(laboratory, page, counts)
    linear_iterations(laboratory, page, min(counts))


def factored(stepping):
    """The time of MUMPS alone [s per step]."""
    events = stepping.events()
    return sum(events.get(name, 0) for name in ("MatLUFactorSym", "MatLUFactorNum", "MatSolve")) / stepping.steps


def net_runs(laboratory, page, scene, steps, ranks):
    """@return {kind of solver: runs}.  The kinds run in turns, and one that fails is left out."""
    runs = {kind: [] for kind in NET_SOLVERS}
    for _ in range(min(3, laboratory.repetitions)):
        for kind in list(runs):
            try:
                runs[kind].append(laboratory.stepping(scene, steps, *NET_SOLVERS[kind], ranks=ranks, events=True))
            except RunFailed as problem:
                page.write(f"{kind}: not measured, {problem}")
                del runs[kind]
    return runs


def net(laboratory, page, meshes, steps):
    page.heading(f"4. A net of {meshes} x {meshes} meshes; wall time of a step [s]")
    name, scene = f"net of {meshes} x {meshes}", scenes.net(meshes)
    rows, least = [], {}
    for ranks in (1, 2):
        runs = net_runs(laboratory, page, scene, steps, ranks)
        samples = {kind: Samples(run.per_step("wall") for run in found) for kind, found in runs.items()}
        newton = {kind: f"{found[0].newton / found[0].steps:.2f}" for kind, found in runs.items()}
        alone = Samples(map(factored, runs[BY_MUMPS])) if BY_MUMPS in runs else None
        rows += [[ranks, kind, newton[kind], *samples[kind].cells()] for kind in samples]
        rows += [[ranks, "MUMPS alone", newton[BY_MUMPS], *alone.cells()]] if alone else []
        ratio = f"{name}, {ranks} rank{'s' if ranks > 1 else ''}: step over MUMPS alone"
        if alone and DEFAULTS in samples:
            least[ranks] = samples[DEFAULTS].least
            page.target(ratio, least[ranks] / alone.least, 1.3)
        else:
            page.missing(ratio, "see above")
    page.table(["ranks", "solver", "Newton per step", "min", "median", "spread"], rows)
    page.write("\nMUMPS alone: its factorisations and solutions in the runs that are all by MUMPS, from -log_view.")
    if len(least) == 2:
        page.target(f"{name}: 1 rank over 2", least[1] / least[2], 1, at_least=True)
