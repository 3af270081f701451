"""The scene with other elements, steps and schemes: what a run of the ladder solves."""
import dataclasses
import fractions
import json

import numpy

from scene_text import children

# So few and so many instants of a history are compared.
FEWEST_ROWS, MOST_ROWS = 50, 250

# A scene without a history is looked at in so many places.
MOST_PROBES = 12

SCENE_SCHEME = "energy_momentum"


@dataclasses.dataclass(frozen=True)
class Stepping:
    """How time is stepped: steps of one length, or adaptive ones of a tolerance."""
    scheme: str = ""                     # empty: that of the scene
    step: float = 0.0                    # s; the first one where it is adaptive
    tolerance: float | None = None       # m

    @property
    def size(self):
        """What a ladder of steppings is a ladder of."""
        return self.step if self.tolerance is None else self.tolerance

    @property
    def family(self):
        return (self.scheme, self.tolerance is not None)


@dataclasses.dataclass(frozen=True)
class Settings:
    mesh: fractions.Fraction             # factor of each cable's elements
    stepping: Stepping | None            # None: the scene has no time


def number_text(value):
    """A number as all readers of YAML take it for one."""
    text = f"{value:.12g}"
    mantissa, mark, exponent = text.partition("e")
    return f"{mantissa if '.' in mantissa else mantissa + '.0'}e{exponent}" if mark else text


def scaled(elements, factor):
    """A cable of one element is a bar, and stays one."""
    return elements if elements == 1 else max(1, round(elements * factor))


def sampling(scene):
    """The time between the rows that are compared [s]: the scene's interval, a part of it, or a multiple."""
    start, end = scene.number("time", "start", default=0.0), scene.number("time", "end")
    interval = scene.number("output", "interval", default=(end - start) / 100)
    rows = (end - start) / interval if interval > 0 else numpy.inf
    if rows == numpy.inf:
        return (end - start) / MOST_ROWS
    if rows < FEWEST_ROWS:
        return interval / int(numpy.ceil(FEWEST_ROWS / rows))
    return interval * max(1, int(rows / MOST_ROWS)) if rows > MOST_ROWS else interval


def probes(scene):
    """What a history should hold where the scene asks for none: bodies, free points, then cables."""
    copied = {key for _, cable in children(scene.find("cables") or ()) for key in repeated(cable)}
    free = [name for name in scene.names("points") if scene.find("points", name, "motion") is None]
    cables = [name for name in scene.names("cables") if scene.find("cables", name, "repeat") is None]
    names = [name for name in [*scene.names("bodies"), *free] if name not in copied] + cables
    return names[:MOST_PROBES]


def repeated(cable):
    """The points and bodies that are repeated with a cable: histories do not name them by themselves."""
    keys = dict(children(cable))
    if "repeat" not in keys:
        return []
    return [keys[end].value.split(".")[0] for end in ("from", "to") if end in keys and isinstance(keys[end].value, str)]


class Variants:
    """Makes scenes of one scene."""

    def __init__(self, scene):
        self.scene = scene
        self.elements = scene.elements()
        self.is_static = scene.find("time") is None
        self.starts_static = scene.value("initial", default="rest") == "static"
        self.own_scheme = scene.value("time", "scheme", default="")
        self.has_history = bool(scene.value("output", "history"))
        self.probes = [] if self.has_history else probes(scene)
        self.interval = None if self.is_static else sampling(scene)
        # Steps that divide this land on the rows of a chart's runs and on those of the user's.
        self.unit = None if self.is_static else min(self.interval, scene.number("output", "interval") or self.interval)

    @property
    def is_open(self):
        """Whether `accuracy` chooses some elements or the step."""
        without = [name for name in self.scene.names("cables") if self.scene.find("cables", name, "elements") is None]
        return bool(without) or not (self.is_static or self.scene.find("time", "step"))

    @property
    def start(self):
        return self.scene.number("time", "start", default=0.0)

    @property
    def end(self):
        return self.scene.number("time", "end")

    @property
    def has_meshes(self):
        return any(number > 1 for number in self.elements.values())

    def own(self):
        """The settings of the scene as written."""
        if self.is_static:
            return Settings(fractions.Fraction(1), None)
        stepping = Stepping(step=self.scene.number("time", "step"),
                            tolerance=self.scene.number("time", "adaptive", "tolerance"))
        return Settings(fractions.Fraction(1), stepping)

    def count(self, mesh):
        """The elements of the file's cables together; a cable that is repeated counts once."""
        return sum(scaled(number, mesh) for number in self.elements.values())

    def settings_edits(self, settings):
        edits = {path: str(scaled(number, settings.mesh)) for path, number in self.elements.items()}
        edits |= dict(self._rows_of_nodes(settings.mesh))
        # A run of a ladder errs by what it errs by.
        if self.scene.find("accuracy") is not None:
            edits["accuracy",] = None
        stepping = settings.stepping
        if stepping is None:
            return edits
        edits["time", "step"] = number_text(stepping.step)
        if stepping.scheme:
            edits["time", "scheme"] = stepping.scheme
            # A radius is meant for the scheme that it stands beside.
            if stepping.scheme != (self.own_scheme or SCENE_SCHEME):
                edits["time", "spectral_radius"] = None
        if stepping.tolerance is None:
            edits["time", "adaptive"] = None
        elif self.scene.find("time", "adaptive") is not None:
            edits["time", "adaptive", "tolerance"] = number_text(stepping.tolerance)
        else:
            edits["time", "adaptive"] = f"{{tolerance: {number_text(stepping.tolerance)}}}"
        return edits

    def _rows_of_nodes(self, mesh):
        """Keys that have a row for each node, with rows for the new nodes: evenly between those of the file.
        A shape whose rows are as many as the nodes says how each element is stretched, which is to stay so."""
        for path, number in self.elements.items():
            count = scaled(number, mesh)
            for key in ("node_velocity", "shape"):
                node = self.scene.find(*path[:-1], key)
                if count == number or node is None or len(children(node)) != number + 1:
                    continue
                rows = numpy.array([[float(part.value) for part in row.value] for row in node.value])
                places = numpy.linspace(0, number, count + 1)
                columns = [numpy.interp(places, numpy.arange(number + 1), column) for column in rows.T]
                yield (*path[:-1], key), json.dumps(numpy.array(columns).T.tolist())

    def run_text(self, settings):
        """The scene of a run of the ladder, which lies in another folder."""
        edits = self.settings_edits(settings)
        if self.interval is not None:
            edits["output", "interval"] = number_text(self.interval)
        if self.probes:
            edits["output", "history"] = json.dumps(self.probes)
        elif not self.has_history:
            edits["output", "energy"] = "true"
        return self.scene.edited(edits)

    def written_text(self, settings):
        """The user's scene with these settings."""
        return self.scene.edited(self.settings_edits(settings))
