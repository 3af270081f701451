"""The cheapest settings for an accuracy: guessed from the ladders, then run.

A guess adds the error of the mesh and that of the step, as series.  Its cost is that of the Newton iterations of both
rungs with the elements of the mesh's:  iterations (a + b elements), with a and b fitted to what was measured.
"""
import dataclasses

import numpy

from runs import TOO_DEAR, Run
from variants import Settings

# So many guesses are run for an accuracy and a family, and so much may a guess err by more than is asked for.
TRIALS, HOPE = 4, 1.3

# From what reaches an accuracy, cheaper neighbours are tried at most so many times.
DESCENTS = 4

# What takes less is too short to be measured well, and is told by the fit [s].
SHORTEST = 0.05

# No machine takes less for an element in an iteration [s], and clocks of CPU time may show nothing for a short run.
LEAST_RATE = 2e-8

# Another family than the scene's is tried, and taken, where it is cheaper by this factor.
WORTH = 1.2


@dataclasses.dataclass
class Choice:
    accuracy: float
    run: Run | None                                 # None: nothing that was run reaches it
    error: float = numpy.nan
    column: str = ""                                # the worst
    left_out: list = dataclasses.field(default_factory=list)      # columns that cannot tell of this accuracy
    best: Run | None = None                         # where nothing reaches it: the run with the least error


class Chooser:
    def __init__(self, survey, accuracies):
        self.accuracies = accuracies
        self.survey, self.runner, self.reference = survey, survey.runner, survey.reference

    def fitted_cost(self, newton, elements):
        """Of so many iterations with so many elements [s]; the fit is to relative errors of all families."""
        runs = [run for run in self.runner.finished if run.newton]
        # A run that is hardly measured counts little.
        weight = numpy.array([1 / (run.first_cost + 0.2 * SHORTEST) for run in runs])
        counts = numpy.array([[run.newton, run.newton * run.elements] for run in runs], float)
        cost = numpy.array([run.first_cost for run in runs])
        (fixed, growing), *_ = numpy.linalg.lstsq(counts * weight[:, None], cost * weight, rcond=None)
        if fixed < 0 or growing < LEAST_RATE:
            fixed, growing = 0.0, max(LEAST_RATE, float(numpy.median(cost / counts[:, 1])))
        return newton * (fixed + growing * elements)

    def cost(self, run):
        """CPU seconds of statics and steps, as measured, or fitted where they are too short."""
        return self._cost(run, run.cost)

    def _cost(self, run, measured):
        fitted = self.fitted_cost(run.newton, run.elements)
        return measured if max(measured, fitted) > SHORTEST else fitted

    def rank(self, run):
        """The cost by which runs are chosen."""
        return self._cost(run, run.first_cost)

    def _finished(self, family):
        return [run for run in self.runner.finished if family_of(run.settings) == family]

    def measured(self, run, accuracy):
        return self.reference.worst(self.reference.errors(run), accuracy)

    def _levels(self, accuracy):
        """The accuracies that a run must have: more quantities may tell of a lower one, and it must have that, too."""
        return [level for level in self.accuracies if level >= accuracy and self.reference.knows(level)]

    def _reaches(self, run, accuracy):
        return all(self.measured(run, level)[0] <= level for level in self._levels(accuracy))

    def choose_all(self):
        """The choices for all accuracies; what was run for one of them may be cheaper for another."""
        for accuracy in self.accuracies:
            self._choose(accuracy, TRIALS)
        return [self._choose(accuracy, 0) for accuracy in self.accuracies]

    def _choose(self, accuracy, trials):
        told = self.reference.told(accuracy)
        left_out = [name for name in self.reference.columns if name not in told]
        if not self.reference.knows(accuracy):
            return Choice(accuracy, None, left_out=left_out)
        best = None
        for family in self._families():
            best = self._try(family, accuracy, best, trials)
        if best is not None and trials:
            best = self._descend(best, accuracy)
        if best is None:
            nearest = min(self.runner.finished, key=lambda run: self.measured(run, accuracy)[0])
            return Choice(accuracy, None, *self.measured(nearest, accuracy), left_out, nearest)
        return Choice(accuracy, best, *self.measured(best, accuracy), left_out)

    def _descend(self, best, accuracy):
        """Goes from a run to its cheaper neighbours, as long as they reach the accuracy: errors of mesh and step do not
        quite add up.  @returns the last that does"""
        for _ in range(DESCENTS):
            tried = [self.runner.run(settings) for settings in self._coarser(best.settings)]
            better = [run for run in tried if run.is_finished and self.rank(run) < self.rank(best)
                      and self._reaches(run, accuracy)]
            if not better:
                break
            best = min(better, key=self.rank)
        return best

    def _coarser(self, settings):
        """Settings with the next two longer steps, and with the next two coarser meshes."""
        steps, meshes = self.survey.ladders.get(family_of(settings)), self.survey.mesh_ladder
        steppings = [run.settings.stepping for run in steps.runs] if steps else []
        factors = [run.settings.mesh for run in meshes.runs] if meshes else []
        yield from (Settings(settings.mesh, stepping) for stepping in before(steppings, settings.stepping))
        yield from (Settings(mesh, settings.stepping) for mesh in before(factors, settings.mesh))

    def _families(self):
        return list(self.survey.ladders) or [None]

    def _try(self, family, accuracy, best, trials):
        """Runs guesses, from the cheapest on, until one reaches the accuracy.  @returns the cheapest that does"""
        is_wanted = family == self._families()[0] or family[0] in self.survey.schemes
        for cost, settings in self._guesses(family, accuracy):
            if trials == 0 or (not is_wanted and best is not None and cost > self.rank(best)):
                break
            trials -= settings not in self.runner.all
            run = self.runner.run(settings)
            if run.status == TOO_DEAR or (run.is_finished and self._reaches(run, accuracy)):
                break
        reach = [run for run in self._finished(family) if self._reaches(run, accuracy)]
        found = min(reach, key=self.rank, default=best)
        return found if best is None or self.rank(found) * WORTH < self.rank(best) else best

    def _guesses(self, family, accuracy):
        """(cost, settings) of what may reach the accuracy, cheapest first."""
        steps, meshes = self.survey.ladders.get(family), self.survey.mesh_ladder
        step_runs, mesh_runs = ([None] if ladder is None else ladder.runs for ladder in (steps, meshes))
        step_shares = [self._share(self.survey.step_ladder, run) for run in step_runs]
        mesh_shares = [self._share(meshes, run) for run in mesh_runs]
        levels = self._levels(accuracy)
        found = [(self._guessed_cost(step_run, mesh_run), self._settings(step_run, mesh_run))
                 for step_run, step_share in zip(step_runs, step_shares)
                 for mesh_run, mesh_share in zip(mesh_runs, mesh_shares)
                 if all(self._guess([step_share, mesh_share], level) <= HOPE * level for level in levels)]
        return sorted(found, key=lambda pair: pair[0])

    def _share(self, ladder, run):
        return self.reference.share(ladder, run) if run else None

    def _guess(self, shares, accuracy):
        """The error of a step and a mesh together."""
        shares = [share for share in shares if share]
        return max(self.reference.error(name, sum(share[name] for share in shares))[0]
                   for name in self.reference.told(accuracy))

    def _settings(self, step_run, mesh_run):
        mesh = mesh_run.settings.mesh if mesh_run else self.survey.mesh
        return Settings(mesh, step_run.settings.stepping if step_run else None)

    def _guessed_cost(self, step_run, mesh_run):
        """With the iterations of the step's rung, more or less by what the mesh changes at its ladder's step."""
        newton, common = (step_run or mesh_run).newton, self.reference.common.newton
        if step_run and mesh_run and common:
            newton *= mesh_run.newton / common
        return self.fitted_cost(newton, (mesh_run or step_run).elements)


def before(items, item):
    """The two of a list that stand before one of them."""
    place = items.index(item) if item in items else 0
    return items[max(0, place - 2):place]


def family_of(settings):
    return settings.stepping.family if settings.stepping else None
