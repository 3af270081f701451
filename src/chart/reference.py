"""What the true history is taken to be, where it can be told, and how far a run is off.

    u* = limit of meshes + limit of steps - u(the run that both ladders have)

The error of a column is that of a run against u*, over the instants at which u* can be told, by the column's scale.
"""
import dataclasses

import numpy

import history
from ladder import rms

# A history is looked at in so many windows of time.
WINDOWS = 20

# Where the two finest runs differ by more than this, and do not come nearer to each other, a single motion cannot be
# told; by the second, where that is a jump by this factor from what they differed by before.  So it is in most windows
# from then on.
UNPREDICTABLE, LOST, JUMP, MOST = 0.1, 0.02, 5.0, 0.7

# A shape that is drawn, and not in equilibrium with other elements, settles: a start is left out from which differences
# fall to this share, or to this share of the range.
SETTLED, SETTLED_LEVEL = 0.1, 0.01

# Nothing can be told of a column if less than this share of the time is left.
LEAST_SHARE = 0.3

# A column whose reference is known to less than this is not converged.
MOST_DOUBT = 0.1

# An accuracy is not judged by less than this share of the columns.
LEAST_TOLD = 0.5

# Where one of these cannot be predicted any more, the whole motion is chaotic.
MOTIONS = ("position", "attitude", "velocity", "angular velocity")

# What no ladder changes by more than this is what the scene prescribes.
UNCHANGED = 1e-9


@dataclasses.dataclass
class Judged:
    """From when to when a column is judged."""
    start: float
    end: float
    is_short: bool = False

    def end_by(self, end, times):
        self.end = min(self.end, end)
        self.is_short = self.end - self.start < 0.999 * LEAST_SHARE * (times[-1] - times[0])


def settling(levels):
    """How many windows a start takes; 0 where differences do not fall, but stay or grow."""
    peak = int(numpy.argmax(levels))
    rough = numpy.flatnonzero(levels > max(SETTLED_LEVEL, SETTLED * levels[peak]))
    if not rough.size or peak > WINDOWS // 2 or rough[-1] + 1 > (1 - LEAST_SHARE) * WINDOWS:
        return 0
    return int(rough[-1]) + 1


def prediction(first, levels, stays):
    """The first window from `first` on that cannot be told any more; WINDOWS where there is none."""
    for place in range(first, WINDOWS):
        before = levels[first:place]
        limit = LOST if before.size and levels[place] > JUMP * numpy.median(before) else UNPREDICTABLE
        bad = stays & (levels > limit)
        if bad[place] and numpy.mean(bad[place:]) >= MOST:
            return place
    return WINDOWS


class Reference:
    def __init__(self, ladders, common, is_static):
        """@param ladders  those of meshes and steps, of finished runs
        @param common  the run that all of them have"""
        self.ladders, self.common = ladders, common
        self.times = common.times
        self.whole = self.times > self.times[0] if len(self.times) > 1 else numpy.full(len(self.times), True)
        finest = {name: self._sum(name, self.whole) for name in common.columns}
        self.scale = history.scales(finest, is_static)
        # Accelerations are means over the last step, so that they lag behind by half of it.
        self.columns = [name for name, scale in self.scale.items()
                        if scale > 0 and history.kind_of(name) != "acceleration" and self._is_computed(name)]
        self.judged = {name: self._judged(name) for name in self.columns}
        self.chaos = min((self.judged[name].end for name in self.columns if history.kind_of(name) in MOTIONS),
                         default=self.times[-1])
        for judged in self.judged.values():
            judged.end_by(self.chaos, self.times)
        self.mask = {name: self.whole & (self.times >= judged.start) & (self.times <= judged.end)
                     for name, judged in self.judged.items()}
        self.truth = {name: self._sum(name, self.mask[name]) for name in self.columns}
        self.doubt = {name: sum(ladder.doubt(name, self.mask[name]) for ladder in ladders) / self.scale[name]
                      for name in self.columns}

    def _is_computed(self, column):
        return any(numpy.abs(ladder.step_to(place, column)).max() > UNCHANGED * self.scale[column]
                   for ladder in self.ladders for place in range(1, len(ladder)))

    def check(self, run):
        """Raises doubt by what a run differs from the truth and the errors of its mesh and of its step together."""
        for name in self.columns:
            shares = 0.0
            for ladder in self.ladders:
                same = next(rung for rung in ladder.runs if ladder.has_size_of(rung, run))
                shares = shares + self.share(ladder, same)[name]
            left = self.error(name, run.columns[name] - self.truth[name] - shares)[0]
            self.doubt[name] = max(self.doubt[name], left)

    def _sum(self, column, mask):
        common = self.common.columns[column]
        return common + sum(ladder.limit(column, mask) - common for ladder in self.ladders)

    def _levels(self, column, before):
        """The differences of the two finest runs in each window, by the scale.
        @param before  1: of the next coarser pair"""
        edges = numpy.linspace(self.times[0], self.times[-1], WINDOWS + 1)
        levels = numpy.zeros(WINDOWS)
        for ladder in self.ladders:
            place = ladder.last - before
            if place < 1:
                continue
            difference = ladder.step_to(place, column) / self.scale[column]
            levels = numpy.maximum(levels, [rms(difference[(self.times > a) & (self.times <= b)])
                                            for a, b in zip(edges[:-1], edges[1:])])
        return edges, levels

    def _judged(self, column):
        if len(self.times) < 2 * WINDOWS:
            return Judged(self.times[0], self.times[-1])
        edges, levels = self._levels(column, 0)
        stays = levels > 0.6 * self._levels(column, 1)[1]
        first = settling(numpy.where(stays, levels, 0.0))
        return Judged(edges[first], edges[prediction(first, levels, stays)])

    def can_tell(self, column, accuracy):
        """Whether an error that is measured as the accuracy is one of twice of it at most."""
        return not self.judged[column].is_short and self.doubt[column] <= accuracy

    def told(self, accuracy):
        """The columns by which an accuracy is judged."""
        return [name for name in self.columns if self.can_tell(name, accuracy)]

    def knows(self, accuracy):
        """Whether enough columns tell of an accuracy for it to be judged."""
        return len(self.told(accuracy)) >= max(1, LEAST_TOLD * len(self.columns))

    def error(self, column, values):
        """(rms, largest) of a series of errors, by the scale."""
        inside = values[self.mask[column]] / self.scale[column]
        return rms(inside), float(numpy.abs(inside).max(initial=0.0))

    def errors(self, run):
        """{column: (rms, largest)} of a run.  No error is told to be less than what the truth is known to."""
        found = {name: self.error(name, run.columns[name] - self.truth[name]) for name in self.columns}
        return {name: (max(mean, self.doubt[name]), max(largest, self.doubt[name])) for name, (mean, largest) in found.items()}

    def is_bound(self, run, column):
        """Whether a run errs by less than what the truth is known to, so that the told error is a bound."""
        return self.error(column, run.columns[column] - self.truth[column])[0] <= self.doubt[column]

    def share_error(self, ladder, column, share):
        """What a share of an error is by the scale, and at least what the ladder's limit is known to."""
        doubt = ladder.doubt(column, self.mask[column]) / self.scale[column]
        return max(self.error(column, share)[0], doubt)

    def share(self, ladder, run):
        """{column: series}: what a run with all else as on a ladder errs by in the ladder's size."""
        return {name: run.columns[name] - ladder.limit(name, self.mask[name]) for name in self.columns}

    def worst(self, errors, accuracy):
        """(error, column) of the worst column that tells of this accuracy; (nan, "") where none does."""
        return max(((errors[name][0], name) for name in self.told(accuracy)), default=(numpy.nan, ""))

    def orders(self):
        """{kind of ladder: the median order of the columns that it changes}; of ladders with three rungs."""
        found = {}
        for ladder in self.ladders:
            moved = [name for name in self.told(MOST_DOUBT) if self._moves(ladder, name)]
            orders = [ladder.order(name, self.mask[name]) for name in moved if ladder.last > 1]
            if orders:
                found[ladder.kind] = float(numpy.median(orders))
        return found

    def extrapolated(self, ladder):
        """(of how many columns the limit is extrapolated, how many the ladder changes); of those that tell of anything."""
        moved = [name for name in self.told(MOST_DOUBT) if self._moves(ladder, name)]
        return sum(ladder.is_extrapolated(name, self.mask[name]) for name in moved), len(moved)

    def _moves(self, ladder, column):
        steps = [rms(ladder.step_to(place, column)[self.mask[column]]) for place in range(1, len(ladder))]
        return bool(steps) and min(steps) > UNCHANGED * self.scale[column]

    def statistics(self, run, column):
        """Mean, deviation, least and largest value over the time in which single motions cannot be told."""
        values = run.columns[column][self.whole & (self.times > self.judged[column].end)]
        return numpy.array([values.mean(), values.std(), values.min(), values.max()]) if values.size else None

    def spread(self, column):
        """How far the statistics of the finest three runs of each ladder lie apart, by the scale: (mean, extremes)."""
        rows = [self.statistics(run, column) for ladder in self.ladders for run in ladder.runs[-3:]]
        rows = numpy.array([row for row in rows if row is not None])
        if not rows.size:
            return None
        apart = numpy.ptp(rows, axis=0) / self.scale[column]
        return float(apart[0]), float(max(apart[2:]))
