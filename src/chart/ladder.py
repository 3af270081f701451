"""A ladder: runs that differ in one size, from coarse to fine.  Its limit is Richardson's.

    u(s) = u(0) + C s^p,   d_k = u_k+1 - u_k,   p = log(|d_k-1| / |d_k|) / log r,   u(0) = u_n + d_n-1 / (r^p - 1)

where r is the ratio of two sizes.  |.| is the root of the mean square over time.
"""
import numpy

# A ladder whose differences fall by less than this order does not converge, and is not extrapolated.
LEAST_ORDER = {"mesh": 0.7, "step": 0.7, "tolerance": 0.25}

# Its differences are taken to fall at least by this share from rung to rung.
LEAST_FALL = 0.1

# The order of the method; what seems to be more is chance.  A tolerance is for the error of a step, which is of third
# order, and steps add up to an error of second order, so that the error goes with its power of 2/3 up to 1.
ORDER = {"mesh": 2.0, "step": 2.0, "tolerance": 1.0}


def rms(values):
    return float(numpy.sqrt(numpy.mean(values**2))) if values.size else 0.0


class Ladder:
    def __init__(self, kind, sizes, runs):
        """@param kind  mesh, step or tolerance   @param sizes  of the finished runs, falling"""
        self.kind, self.sizes, self.runs = kind, list(sizes), list(runs)
        self.last = len(self.runs) - 1

    def __len__(self):
        return len(self.runs)

    def has_size_of(self, rung, run):
        """Whether a run of two sizes has that of a rung in this ladder."""
        if self.kind == "mesh":
            return rung.settings.mesh == run.settings.mesh
        return rung.settings.stepping == run.settings.stepping

    def rung(self, place, column):
        return self.runs[place].columns[column]

    def step_to(self, place, column):
        """What the rung at `place` differs by from the coarser one: a series."""
        return self.rung(place, column) - self.rung(place - 1, column)

    def log_ratio(self, place):
        return float(numpy.log(self.sizes[place - 1] / self.sizes[place]))

    def order(self, column, mask, last=None):
        """What the three rungs that end at `last`, or with the finest, show.  None where nothing shows."""
        last = self.last if last is None else last
        if last < 2:
            return None
        coarse, fine = (rms(self.step_to(place, column)[mask]) for place in (last - 1, last))
        if fine <= 0 or coarse <= 0:
            return None
        return 2 * float(numpy.log(coarse / fine)) / (self.log_ratio(last - 1) + self.log_ratio(last))

    def _taken_order(self, column, mask):
        """The order by which the limit is taken; where none shows it is the method's."""
        order = self.order(column, mask)
        return ORDER[self.kind] if order is None else min(order, ORDER[self.kind])

    def is_extrapolated(self, column, mask):
        """Whether the limit is more than the finest rung."""
        return self.last > 0 and self._taken_order(column, mask) >= LEAST_ORDER[self.kind]

    def correction(self, column, mask, last=None):
        """From the rung at `last`, or the finest, to the limit: a series."""
        last = self.last if last is None else last
        order = self._taken_order(column, mask)
        if last < 1 or order < LEAST_ORDER[self.kind]:
            return numpy.zeros_like(self.rung(last, column))
        return self.step_to(last, column) / (numpy.exp(order * self.log_ratio(last)) - 1)

    def limit(self, column, mask):
        return self.rung(self.last, column) + self.correction(column, mask)

    def doubt(self, column, mask):
        """How far the limit may be off: by half of what the finest rung has moved it, or a tenth of what it adds.  Where the
        order is too low for a limit, by the rest of the geometric series of the rungs' differences."""
        if self.last < 1:
            return 0.0
        added = rms(self.correction(column, mask)[mask])
        if self.last < 2:
            return added
        order = self.order(column, mask)
        if order is not None and order < LEAST_ORDER[self.kind]:
            left = max(float(numpy.exp(order * self.log_ratio(self.last))) - 1, LEAST_FALL)
            return rms(self.step_to(self.last, column)[mask]) / left
        before = self.rung(self.last - 1, column) + self.correction(column, mask, self.last - 1)
        return max(0.1 * added, 0.5 * rms((self.limit(column, mask) - before)[mask]))
