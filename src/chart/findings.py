"""What a chart has found, and how settings are named."""
from messages import multiple, percent, stepping_text
from variants import SCENE_SCHEME

# The picture, chart.csv and the line on the scene as written go by the columns that tell of the first of these.
PICTURED = (0.003, 0.01, 0.03, 0.1)

# The accuracy that the scene as written is compared by, unless another one is asked for.
USUAL = 0.01


class Findings:
    def __init__(self, given, survey, chooser, choices):
        self.given, self.survey, self.chooser, self.choices = given, survey, chooser, choices
        self.reference, self.runner, self.variants = survey.reference, survey.runner, survey.variants
        self.own = self.runner.all[survey.own]
        self.pictured = next((accuracy for accuracy in PICTURED if self.reference.knows(accuracy)), PICTURED[-1])
        self.told = self.reference.told(self.pictured)

    def choice(self, accuracy):
        return next(choice for choice in self.choices if choice.accuracy == accuracy)

    def with_status(self, status):
        return [run for run in self.runner.all.values() if run.status == status]

    def error(self, run):
        """(error, column) by which a run is drawn."""
        return self.chooser.measured(run, self.pictured)

    def largest_error(self, run):
        errors = self.reference.errors(run)
        return max((errors[name][1] for name in self.told), default=float("nan"))

    def share(self, ladder, run):
        """What a run errs by in the size of a ladder alone."""
        shares = self.reference.share(ladder, run)
        return max((self.reference.share_error(ladder, name, shares[name]) for name in self.told), default=float("nan"))

    def errs_by_less(self, run, column):
        """Whether the error that is told of a run is only a bound."""
        return bool(column) and self.reference.is_bound(run, column)

    def error_text(self, run, error, column):
        return ("< " if self.errs_by_less(run, column) else "") + percent(error)

    @property
    def doubt(self):
        """How well the truth is known; of the columns that runs are drawn by."""
        return max((self.reference.doubt[name] for name in self.told), default=float("nan"))

    def why_not(self, choice):
        """Why an accuracy has no settings."""
        if choice.best is None:
            count = len(self.reference.columns)
            return (f"cannot be judged: these runs know {count - len(choice.left_out)} of {count} quantities to "
                    f"{percent(choice.accuracy)}")
        return f"no run reaches it; the best has {percent(choice.error)} ({self.settings_text(choice.best.settings)})"

    def settings_text(self, settings):
        parts = []
        if self.variants.has_meshes:
            parts.append("elements as they are" if settings.mesh == 1 else f"elements {multiple(settings.mesh)}")
        if settings.stepping is not None:
            parts.append(stepping_text(settings.stepping))
        if settings.stepping and settings.stepping.scheme:
            parts.append(settings.stepping.scheme)
        return ", ".join(parts)

    def scheme_text(self, settings):
        """The scheme.  energy_momentum by name is another than without a name, which damps axial vibration a little."""
        if settings.stepping is None:
            return "static"
        if settings.stepping.scheme == SCENE_SCHEME and not self.variants.own_scheme:
            return f"{SCENE_SCHEME} by name"
        return settings.stepping.scheme or self.variants.own_scheme or SCENE_SCHEME
