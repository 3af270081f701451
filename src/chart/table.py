"""What a chart prints: the table of the cheapest settings, where the scene stands, and what a reader has to know."""
from findings import USUAL
from messages import counted, listed, multiple, percent, seconds, stepping_text
from runs import FAILS, TOO_DEAR


def rows(findings):
    yield ("accuracy", "elements", "step", "scheme", "CPU", "Newton", "error", "of")
    for choice in findings.choices:
        run = choice.run
        if run is None:
            yield (percent(choice.accuracy), findings.why_not(choice))
            continue
        factor = "" if run.settings.mesh == 1 else f" ({multiple(run.settings.mesh)})"
        step = stepping_text(run.settings.stepping).removeprefix("step ")
        cost = seconds(findings.chooser.cost(run))
        yield (percent(choice.accuracy), f"{run.elements}{factor}", step, findings.scheme_text(run.settings), cost,
               str(run.newton), findings.error_text(run, choice.error, choice.column), worst_text(findings, choice))


def worst_text(findings, choice):
    """The worst quantity, and how many were looked at where some cannot tell of this accuracy."""
    count = len(findings.reference.columns)
    known = count - len(choice.left_out)
    return f"{choice.column} (covers {known} of {count})" if known < count else choice.column


def table(lines):
    """Rows in columns; a row of two words goes over all of them."""
    lines = list(lines)
    widths = [max(len(line[place]) for line in lines if len(line) > 2) for place in range(len(lines[0]))]
    for line in lines:
        if len(line) == 2:
            yield f"{line[0]:{widths[0]}}  {line[1]}"
        else:
            yield "  ".join(f"{word:{width}}" for word, width in zip(line, widths)).rstrip()


def own_line(findings):
    """Where the scene as written stands, and what would do."""
    wanted = findings.choice(findings.given.accuracy or USUAL)
    text = f"yours: {own_text(findings, findings.own)}"
    if wanted.run is None:
        return text
    if wanted.run is findings.own:
        return f"{text}; for {percent(wanted.accuracy)} that is the cheapest"
    return (f"{text}; for {percent(wanted.accuracy)}: {findings.settings_text(wanted.run.settings)}, "
            f"{seconds(findings.chooser.cost(wanted.run))}")


def own_text(findings, own):
    if own.status == TOO_DEAR:
        return f"not run, it would take some {seconds(findings.runner.expected_cpu(own.settings))} of CPU"
    if not own.is_finished:
        return f"{own.status}: {own.message}"
    cost, told, count = seconds(findings.chooser.cost(own)), len(findings.told), len(findings.reference.columns)
    if not told:
        return f"{cost}, with an error that these runs do not tell"
    judged = f" (of {told} of {count} quantities)" if told < count else ""
    return f"{cost}, {percent(findings.error(own)[0])}{judged}"


def reference_line(findings):
    finest = [finest_text(findings, ladder) for ladder in findings.reference.ladders]
    orders = [f"{order:.1f} in the {kind}" for kind, order in findings.reference.orders().items()]
    return (f"reference: {' and '.join(finest)}"
            + (f", observed orders {' and '.join(orders)}" if orders else "")
            + (f"; known to {percent(findings.doubt)}" if findings.told else "; no quantity is known to 10 % by it"))


def finest_text(findings, ladder):
    """The end of a ladder, and whether the truth is its limit or the finest run itself."""
    settings = ladder.runs[-1].settings
    end = f"elements {multiple(settings.mesh)}" if ladder.kind == "mesh" else stepping_text(settings.stepping)
    extrapolated, moved = findings.reference.extrapolated(ladder)
    if extrapolated == 0:
        return f"{end} as it is"
    return f"extrapolated from {end}" + (f" in {extrapolated} of {moved} quantities" if extrapolated < moved else "")


def chaos_lines(findings):
    """Until when single motions can be predicted."""
    reference = findings.reference
    end, chaos = reference.times[-1], reference.chaos
    if chaos < end:
        yield (f"the motion is chaotic: single motions can be predicted until t = {chaos:.4g} s, by which the table "
               f"goes. After it only statistics tell: {statistics_text(reference, reference.columns)}")
    early = {name: judged.end for name, judged in reference.judged.items() if judged.end < chaos}
    if early:
        until = listed(f"{name} after t = {time:.4g} s" for name, time in early.items())
        yield (f"finer runs do not come nearer to each other, and only statistics tell, of {until}: "
               f"{statistics_text(reference, early)}")


def statistics_text(reference, columns):
    """How well the statistics of the worst column agree."""
    spreads = [spread for spread in map(reference.spread, columns) if spread]
    means, extremes = (max(values) for values in zip(*spreads))
    return f"over the finest runs means agree to {percent(means)} and extremes to {percent(extremes)} of the range"


def left_out_lines(findings):
    """What is not judged, and where."""
    reference = findings.reference
    late = [f"{name} from t = {judged.start:.4g} s" for name, judged in reference.judged.items()
            if judged.start > reference.times[0] and not judged.is_short]
    if late:
        advice = "" if findings.variants.starts_static else "; `initial: static` may help"
        yield (f"the start is not converged, and is left out: {listed(late)}. What moves when a run begins settles "
               f"otherwise with other elements or steps{advice}")
    unknown = [name for name in reference.columns if name not in reference.told(0.1)]
    if unknown:
        yield f"not converged, and covered by no row: {listed(unknown)}"
    for choice in findings.choices:
        left = [name for name in choice.left_out if name not in unknown]
        if choice.run is not None and left:
            errors = reference.errors(choice.run)
            each = listed(f"{name} ({findings.error_text(choice.run, errors[name][0], name)})" for name in left)
            yield (f"the row of {percent(choice.accuracy)} covers {len(reference.columns) - len(choice.left_out)} of "
                   f"{len(reference.columns)} quantities. Not covered, because known to less, with what they err by: {each}")


def scene_lines(findings):
    """What was not changed, or was added."""
    variants, ladder = findings.variants, findings.survey.step_ladder
    if variants.probes:
        yield f"the scene's output.history is empty; looked at: {', '.join(variants.probes)}"
    elif not variants.has_history:
        yield "the scene's output.history is empty, and there is no body, free point or cable; looked at: the energies"
    if not variants.has_meshes:
        yield "no cable has more than one element, so that elements are not changed"
    if variants.scene.names("nets"):
        yield ("nets are as written in all runs: the side of a mesh is one element. What nets err by for that is in no "
               "row; halve the meshes of a net and its twines' thickness to see it")
    if ladder is not None and ladder.kind == "step" and ladder.sizes[0] >= 0.999 * variants.unit:
        yield f"steps are no longer than the time between rows of the history, {variants.unit:.4g} s here"


def run_lines(findings):
    for status, words in ((FAILS, "failed"), (TOO_DEAR, "cut off by the budget")):
        runs = findings.with_status(status)
        if runs:
            why = f": {runs[0].message}" if status == FAILS else "; --budget S allows more"
            yield f"{counted(len(runs), 'run')} {words}, {'as' if len(runs) > 1 else 'that with'} {findings.settings_text(runs[0].settings)}{why}"


def notes(findings):
    return [line for part in (chaos_lines, left_out_lines, scene_lines, run_lines) for line in part(findings)]


def text(findings):
    done, spent = len(findings.runner.finished), seconds(findings.runner.spent)
    lines = [f"{findings.given.scene}: {counted(done, 'run')}, {spent} of CPU; results in {findings.given.folder}",
             "error: root of the mean square over time, by the quantity's range; of the worst quantity",
             reference_line(findings), "", *table(rows(findings)), "", own_line(findings)]
    return "\n".join(lines + [f"note: {line}" for line in notes(findings)])
