"""Which runs are done: a ladder of steps at one mesh, a ladder of meshes at one step, and ladders of other families.

Each ladder is climbed from its cheap end, until its own error is small, it ends, or its part of the budget is used.
"""
import fractions
import itertools

import numpy

import history
from ladder import LEAST_ORDER, Ladder, rms
from messages import NO_SOLUTION, Refusal, counted, seconds
from reference import Reference
from runs import TOO_DEAR
from variants import Settings, Stepping

MESHES = [fractions.Fraction(1, 4), fractions.Fraction(1, 2), fractions.Fraction(1), fractions.Fraction(2),
          fractions.Fraction(4)]
FINER_MESHES = [fractions.Fraction(8), fractions.Fraction(16)]
COARSEST_MESH = fractions.Fraction(1, 32)
FINEST_STEP = -3                       # a power of 2 of the scene's step
TOLERANCES = range(3, -4, -1)          # powers of 4 of the scene's tolerance
RELATIVE_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)      # of the largest range of a position

# A ladder of fewer rungs does not show whether it converges well.
ENOUGH_RUNGS = 4

# Shares of the budget: of each of the two ladders that lead to the reference, of the run that checks it, and of each
# other family, of a mesh that is finer than those of the grid.
LADDER_SHARE, CHECK_SHARE, FAMILY_SHARE, FINER_SHARE = 0.3, 0.1, 0.08, 0.08

# Meshes are compared at a step that errs by no more than this, or by the second where that is too dear.  A ladder ends
# where it errs by the third.
GOOD_STEP, FAIR_STEP, SMALL = 1e-3, 0.01, 3e-5
COARSE = 0.1


# A chart of the least use takes so many times what its cheapest run does.
CHART_OF_RUN = 40


def rounded_up(value):
    """With two digits."""
    unit = 10.0 ** max(0, numpy.floor(numpy.log10(value)) - 1)
    return numpy.ceil(value / unit) * unit


class Survey:
    def __init__(self, runner, variants, schemes):
        self.runner, self.variants = runner, variants
        self.own = variants.own()
        self.mesh = fractions.Fraction(1)             # of the ladders of steps
        self.stepping = self.own.stepping             # of the ladder of meshes
        self.ladders = {}                             # {family: ladder of steps}; that of the scene comes first
        self.mesh_ladder = self.step_ladder = None
        self.schemes = schemes
        self.planned = {}                             # {kind of ladder: its rungs}, whether there is a budget or not
        self.reference = None

    def grid(self):
        """The settings of all meshes with all steppings that are known without a run."""
        if self.variants.is_static:
            steppings = [None]
        else:
            own = self.own.stepping
            steppings = self._tolerances() if own.tolerance else self._steps(own.step, "")
            steppings += [one for scheme in self.schemes for one in self._steps(own.step, scheme)]
        meshes = MESHES if self.variants.has_meshes else [fractions.Fraction(1)]
        return [Settings(mesh, stepping) for mesh in meshes for stepping in steppings]

    def explore(self):
        if not self.variants.is_static:
            self._climb_steps()
        self.mesh_ladder = self._climb_meshes()
        main = [ladder for ladder in (self.mesh_ladder, self.step_ladder) if ladder is not None]
        common = self.runner.run(Settings(self.mesh, self.stepping))
        self._demand(common, main)
        self.reference = Reference(main, common, self.variants.is_static)
        if len(main) == 2:
            self._check()
        self.runner.run(self.own)
        if not self.variants.is_static:
            self._climb_families()

    def _check(self):
        """Runs a fine step with a fine mesh, to see whether their errors add up; the finest that is not too dear."""
        pairs = [Settings(mesh.settings.mesh, step.settings.stepping)
                 for mesh in self.mesh_ladder.runs for step in self.step_ladder.runs]
        pairs = [pair for pair in pairs if pair.mesh != self.mesh and pair.stepping != self.stepping]
        allowed = CHECK_SHARE * self.runner.budget
        for pair in sorted(pairs, key=self.runner.expected_cpu, reverse=True):
            if self.runner.expected_cpu(pair) <= allowed and self.runner.run(pair, allowed).is_finished:
                self.reference.check(self.runner.run(pair))
                return

    def _demand(self, common, ladders):
        """Refuses where there is nothing to tell the truth by."""
        if common.is_finished and all(len(ladder) > 1 for ladder in ladders):
            return
        done, finished = list(self.runner.all.values()), len(self.runner.finished)
        if any(run.status == TOO_DEAR for run in done):
            if not finished:
                least = max(run.process_cpu[0] / max(self._progress(run), 1e-3) for run in done if run.process_cpu)
                raise Refusal(f"a budget of {self.runner.budget:.4g} s is too small: the cheapest run takes some "
                              f"{seconds(least)}, and a chart {CHART_OF_RUN} times of that; "
                              f"give it --budget {rounded_up(CHART_OF_RUN * least):.0f}")
            raise Refusal(f"a budget of {self.runner.budget:.4g} s is too small: {seconds(self.runner.spent)} of CPU "
                          f"went into {counted(finished, 'run')} that are kept, and a chart needs three in each ladder; "
                          f"give it --budget {rounded_up(self._enough()):.0f}")
        why = next((f": {run.message}" for run in done if run.message), "")
        raise Refusal(f"{finished} of {counted(len(done), 'run')} got through, too few for a chart{why}", NO_SOLUTION)

    def _enough(self):
        """A budget with which each ladder gets four rungs [s]."""
        expected = [sum(self.runner.expected_cpu(rung) for rung in rungs[:4]) for rungs in self.planned.values()]
        return max(1.5 * max(expected, default=0.0) / LADDER_SHARE, 2 * self.runner.budget)

    def _progress(self, run):
        """Which share of its time a run that was cut off has got through."""
        path = run.folder / "history.csv"
        if self.variants.is_static or not path.exists():
            return 0.0
        times, _ = history.read(path)
        return (times[-1] - times[0]) / (self.variants.end - self.variants.start) if len(times) else 0.0

    # Ladders.

    def _climb(self, kind, settings, size, share):
        """@param settings  of all rungs, coarse to fine   @param size  of a run"""
        # Where there are no meshes to compare, their part of the budget is free.
        allowance = share * self.runner.budget * (1 if self.variants.has_meshes else 2)
        self.planned[kind] = settings
        runs, spent = [], 0.0
        for rung in settings:
            is_new = rung not in self.runner.all
            run = self.runner.run(rung, allowance - spent)
            spent += run.process_cpu[0] if is_new and run.process_cpu and not run.is_of_part else 0.0
            if run.status == TOO_DEAR:
                break
            if run.is_finished and runs and kind == "tolerance" and run.steps <= runs[-1].steps:
                runs[-1] = run                       # the longest step that is allowed anyway
            elif run.is_finished and (not runs or size(run) < size(runs[-1])):
                runs.append(run)
            if len(runs) > 2 and self._error(Ladder(kind, map(size, runs), runs), len(runs) - 1) < SMALL:
                break
        return Ladder(kind, map(size, runs), runs)

    def _error(self, ladder, place):
        """What a rung errs by in its ladder's size, by the ladder alone; of all columns that converge."""
        if ladder.last < 2:
            return numpy.inf
        run = ladder.runs[-1]
        scale = history.scales(run.columns, self.variants.is_static)
        mask = numpy.arange(len(run.times)) > (0 if len(run.times) > 1 else -1)
        worst = 0.0
        for column in (name for name in run.columns if scale[name] > 0 and history.kind_of(name) != "acceleration"):
            order = ladder.order(column, mask)
            if order is None or order >= LEAST_ORDER[ladder.kind]:
                worst = max(worst, rms((ladder.limit(column, mask) - ladder.rung(place, column))[mask]) / scale[column])
            elif rms(ladder.step_to(ladder.last, column)[mask]) > SMALL * scale[column] and place == ladder.last:
                return numpy.inf
        return worst

    def _distance(self, run, other):
        """How far two runs lie apart, in their worst column."""
        scale = history.scales(other.columns, self.variants.is_static)
        return max((rms(run.columns[name] - other.columns[name]) / scale[name] for name in other.columns
                    if scale[name] > 0 and history.kind_of(name) != "acceleration"), default=0.0)

    def _climb_steps(self):
        rungs = self._tolerances() if self.own.stepping.tolerance else self._steps(self.own.stepping.step, "")
        kind = "tolerance" if self.own.stepping.tolerance else "step"
        for self.mesh in self._meshes_of_steps(rungs):
            settings = [Settings(self.mesh, rung) for rung in rungs]
            ladder = self._climb(kind, settings, self._step_size(kind), LADDER_SHARE)
            if len(ladder) >= min(ENOUGH_RUNGS, len(rungs)):
                break
        self.ladders[self.own.stepping.family] = self.step_ladder = ladder
        if not len(ladder):
            return
        self.stepping = self._step_of_meshes(ladder).settings.stepping

    def _step_of_meshes(self, ladder):
        """The longest step that hardly errs; a longer one where the finest mesh would be too dear with it."""
        apart = [self._distance(run, ladder.runs[-1]) for run in ladder.runs]
        good = next(place for place, value in enumerate(apart) if value <= GOOD_STEP)
        fair = next(place for place, value in enumerate(apart) if value <= FAIR_STEP)
        allowed = 0.6 * LADDER_SHARE * self.runner.budget
        while good > fair and self.runner.expected_cpu(
                Settings(MESHES[-1], ladder.runs[good].settings.stepping)) > allowed:
            good -= 1
        return ladder.runs[good]

    def _meshes_of_steps(self, rungs):
        """The meshes that are tried for the ladder of steps, fine to coarse.  With a coarse mesh steps err by more, as
        where single nodes hit the bed."""
        if not self.variants.has_meshes:
            return [fractions.Fraction(1)]
        return itertools.chain((mesh for mesh in MESHES[:0:-1] if self._is_within(mesh, rungs)), MESHES[:1])

    def _is_within(self, mesh, rungs):
        """Whether the ladder's middle is within its part of the budget with a mesh, by what the longest step takes."""
        first, middle = (Settings(mesh, rungs[place]) for place in (0, min(ENOUGH_RUNGS, len(rungs)) - 1))
        allowed = 0.5 * LADDER_SHARE * self.runner.budget
        self.runner.run(Settings(MESHES[0], rungs[0]))
        if self.runner.expected_cpu(first) > allowed / 2:
            return False
        return self.runner.run(first).status != TOO_DEAR and self.runner.expected_cpu(middle) <= allowed

    def _step_size(self, kind):
        span = self.variants.end - self.variants.start
        return (lambda run: span / run.steps) if kind == "step" else (lambda run: run.settings.stepping.tolerance)

    def _steps(self, step, scheme):
        """Steps that divide the time between outputs, by factors of 2 around `step`, long to short."""
        unit = self.variants.unit
        count = int(numpy.ceil(unit / step * (1 - 1e-9)))
        found = {}
        for power in range(int(numpy.log2(count)) + 1, FINEST_STEP - 1, -1):
            divisor = max(1, round(count * 2.0**-power))
            found[divisor] = Stepping(scheme, step if power == 0 else unit / divisor)
        return list(found.values())

    def _tolerances(self):
        own = self.own.stepping
        return [Stepping(own.scheme, own.step, own.tolerance * 4.0**power) for power in TOLERANCES]

    def _climb_meshes(self):
        if not self.variants.has_meshes:
            return None
        rungs = [Settings(mesh, self.stepping) for mesh in MESHES]
        size = lambda run: 1 / run.elements
        ladder = self._climb("mesh", rungs, size, LADDER_SHARE)
        if ladder.runs and ladder.runs[-1].settings.mesh == MESHES[-1]:
            ladder = self._climb_higher(ladder, size)
        while len(ladder) > 2 and self._error(ladder, 0) < COARSE:
            coarser = ladder.runs[0].settings.mesh / 2
            if coarser < COARSEST_MESH or self.variants.count(coarser) == self.variants.count(2 * coarser):
                break
            run = self.runner.run(Settings(coarser, self.stepping))
            if not run.is_finished:
                break
            ladder = Ladder("mesh", [size(run), *ladder.sizes], [run, *ladder.runs])
        return ladder

    def _climb_higher(self, ladder, size):
        """Finer meshes than those of the grid, where they cost little and something is not known well yet."""
        for mesh in FINER_MESHES:
            settings = Settings(mesh, self.stepping)
            if len(ladder) < 3 or self._error(ladder, ladder.last) < SMALL:
                break
            run = self.runner.run(settings, FINER_SHARE * self.runner.budget)
            if not run.is_finished or size(run) >= ladder.sizes[-1]:
                break
            longer = Ladder("mesh", [*ladder.sizes, size(run)], [*ladder.runs, run])
            # A step may be too long for shorter elements, which then vibrate from step to step.
            if self._digits(longer) <= self._digits(ladder):
                break
            ladder = longer
        return ladder

    def _digits(self, ladder):
        """How many digits of all columns together a ladder's limit is known to."""
        scale = history.scales(ladder.runs[-1].columns, self.variants.is_static)
        mask = numpy.full(len(ladder.runs[-1].times), True)
        doubts = [ladder.doubt(name, mask) / scale[name] for name in scale
                  if scale[name] > 0 and history.kind_of(name) != "acceleration"]
        return -numpy.log10(numpy.clip(doubts, SMALL, 1.0)).sum()

    # Other families.

    def _climb_families(self):
        own = self.own.stepping
        if own.tolerance is None:
            length = self._length()
            rungs = [Stepping(own.scheme, own.step, share * length) for share in RELATIVE_TOLERANCES]
            self._climb_family("tolerance", rungs)
        else:
            self._climb_family("step", self._steps(self._step_size("step")(self.step_ladder.runs[-1]), own.scheme))
        for scheme in self.schemes:
            base = self.variants.unit / 8 if own.tolerance else own.step
            self._climb_family("step", self._steps(base, scheme))

    def _climb_family(self, kind, rungs):
        if kind == "tolerance" and self.variants.has_meshes:
            # How many steps a tolerance takes is not known before the first run.
            self.runner.run(Settings(MESHES[0], rungs[0]), FAMILY_SHARE * self.runner.budget)
        ladder = self._climb(kind, [Settings(self.mesh, rung) for rung in rungs], self._step_size(kind), FAMILY_SHARE)
        if rungs:
            self.ladders[rungs[0].family] = ladder

    def _length(self):
        """The largest range of a position, or else the longest cable [m]: what tolerances are shares of."""
        scale = self.reference.scale
        ranges = [scale[name] for name in self.reference.columns if history.kind_of(name) == "position"]
        lengths = [self.variants.scene.number("cables", name, "length", default=0.0)
                   for name in self.variants.scene.names("cables")]
        return max(ranges, default=0.0) or max(lengths, default=0.0) or 1.0
