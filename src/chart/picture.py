"""chart.png and chart.svg: error over cost, and the errors of mesh and step apart."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib import ticker

import labels
from choice import family_of
from messages import percent, seconds, stepping_text

# Okabe and Ito's colours, which all eyes tell apart; each family has a marker of its own, too.
LOOKS = (("#0072B2", "o"), ("#D55E00", "s"), ("#009E73", "^"), ("#CC79A7", "D"), ("#E69F00", "v"), ("#56B4E9", "P"))
GREY = "#666666"
LEAST_DRAWN = 1e-7
MOST_TICKS = 6


def front(points):
    """Of (cost, error) those that no other beats in both, cheapest first."""
    found = []
    for cost, error in sorted(points):
        if not found or error < found[-1][1]:
            found.append((cost, error))
    return found


def family_name(findings, family):
    run = next(run for run in findings.runner.all.values() if family_of(run.settings) == family)
    return findings.scheme_text(run.settings) + (", adaptive" if family and family[1] else "")


def looks(findings):
    families = list(findings.survey.ladders) or [None]
    return {family: LOOKS[place % len(LOOKS)] for place, family in enumerate(families)}


def percent_axis(axis):
    axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{100 * value:g} %"))
    axis.set_minor_formatter(ticker.NullFormatter())


def place_axis(axes, places):
    """A logarithmic axis of sizes, with the sizes themselves on it where a decade would hardly be."""
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:.3g}"))
    axes.xaxis.set_minor_formatter(ticker.NullFormatter())
    if max(places) < 100 * min(places):
        shown = sorted(set(places), reverse=True)
        axes.xaxis.set_major_locator(ticker.FixedLocator(shown[::1 + len(shown) // MOST_TICKS]))
        axes.xaxis.set_minor_locator(ticker.NullLocator())


def draw_costs(axes, findings):
    chaos = findings.reference.chaos
    is_chaotic = chaos < findings.reference.times[-1]
    until = f" until t = {chaos:.4g} s, beyond which the motion is chaotic" if is_chaotic else ""
    axes.set_title(f"Accuracy and its cost{until}", loc="left")
    if not findings.told:
        return say(axes, "no quantity is known to 10 %\nby these runs")
    for family, (colour, marker) in looks(findings).items():
        runs = [run for run in findings.runner.finished if family_of(run.settings) == family]
        points = [(findings.chooser.cost(run), max(findings.error(run)[0], LEAST_DRAWN)) for run in runs]
        if not points:
            continue
        axes.plot(*zip(*points), marker, color=colour, markerfacecolor="none", markersize=5, alpha=0.5)
        mark_bounds(axes, findings, runs)
        axes.plot(*zip(*front(points)), marker=marker, color=colour, markersize=6, label=family_name(findings, family))
    axes.set_xscale("log")
    axes.set_yscale("log")
    set_limits(axes, findings)
    if findings.own.is_finished:
        place = (findings.chooser.cost(findings.own), max(findings.error(findings.own)[0], LEAST_DRAWN))
        axes.plot(*place, "*", color="black", markersize=15, markeredgecolor="white", zorder=5,
                  label="the scene as written")
    axes.axhspan(LEAST_DRAWN / 10, findings.doubt, color="#dddddd", zorder=0,
                 label=f"not known: the truth is known to {percent(findings.doubt)}, ▽ errs by less")
    axes.set_xlabel("cost: CPU seconds of solving")
    told, count = len(findings.told), len(findings.reference.columns)
    worst = "of the worst quantity" if told == count else f"of the worst of {told} of {count} quantities"
    axes.set_ylabel(f"error: rms over time / range, {worst}")
    percent_axis(axes.yaxis)
    axes.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: seconds(value)))
    axes.legend(fontsize=8, loc="upper right", framealpha=0.9)


def mark_bounds(axes, findings, runs):
    """A triangle below what errs by less than can be told."""
    for run in runs:
        error, column = findings.error(run)
        if findings.errs_by_less(run, column):
            axes.annotate("▽", (findings.chooser.cost(run), max(error, LEAST_DRAWN)), xytext=(0, -6), fontsize=7, ha="center",
                          va="top", color=GREY, textcoords="offset points")


def set_limits(axes, findings):
    """Room for all points, and for words beside them."""
    points = [(findings.chooser.cost(run), findings.error(run)[0]) for run in findings.runner.finished]
    costs, errors = zip(*points)
    bottom, top = 0.3 * max(min(errors), findings.doubt, LEAST_DRAWN), 3 * min(1.0, max(errors))
    axes.set_ylim(bottom, top * (top / bottom) ** 0.2)
    axes.set_xlim(0.3 * min(costs), 3 * max(costs) * (max(costs) / min(costs)) ** 0.2)


def mark_choices(axes, findings):
    """The cheapest settings for each accuracy, in words that keep clear of points, lines and each other."""
    axes.figure.draw_without_rendering()      # lays the axes out, for good
    axes.figure.set_layout_engine("none")
    taken = labels.obstacles(axes)
    marks = {}
    for choice in findings.choices:
        if choice.run is not None:
            axes.axhline(choice.accuracy, color=GREY, linewidth=0.8, linestyle=":", zorder=0)
            marks.setdefault(choice.run.settings, (choice.run, []))[1].append(percent(choice.accuracy))
    for run, accuracies in marks.values():
        point = (findings.chooser.cost(run), max(findings.error(run)[0], LEAST_DRAWN))
        labels.place(axes, f"{', '.join(accuracies)}: {settings_words(run)}", point, taken)


def settings_words(run):
    way = stepping_text(run.settings.stepping)
    return f"{run.elements} el." + ("" if run.settings.stepping is None else f", {way}")


def say(axes, words):
    axes.text(0.5, 0.5, words, ha="center", va="center", transform=axes.transAxes)
    axes.set_xticks([])
    axes.set_yticks([])


def draw_meshes(axes, findings):
    ladder = findings.survey.mesh_ladder
    axes.set_title("Error of the mesh alone", loc="left")
    if ladder is None:
        return say(axes, "no cable has more\nthan one element")
    colour = next(iter(looks(findings).values()))[0]
    draw_ladder(axes, findings, ladder, ladder, [run.elements for run in ladder.runs], colour, "o", None)
    mark_fails(axes, findings, lambda run: run.settings.stepping == findings.survey.stepping,
               lambda run: findings.own.elements * float(run.settings.mesh))
    axes.set_xlabel("elements")


def draw_steps(axes, findings):
    main = findings.survey.step_ladder
    axes.set_title("Error of the step alone", loc="left")
    if main is None:
        return say(axes, "an equilibrium\nhas no steps")
    span = findings.reference.times[-1] - findings.reference.times[0]
    for family, (colour, marker) in looks(findings).items():
        ladder = findings.survey.ladders[family]
        draw_ladder(axes, findings, main, ladder, [span / run.steps for run in ladder.runs], colour, marker,
                    family_name(findings, family))
    fixed = lambda run: run.settings.mesh == findings.survey.mesh and run.settings.stepping.tolerance is None
    mark_fails(axes, findings, fixed, lambda run: run.settings.stepping.step)
    axes.set_xlabel("mean step [s]")


def draw_ladder(axes, findings, main, ladder, places, colour, marker, label):
    """The errors of a ladder's rungs against the limit of the main one, and the slope of the second order."""
    drawn = [(place, findings.share(main, run)) for place, run in zip(places, ladder.runs)]
    drawn = [(place, error) for place, error in drawn if error > LEAST_DRAWN / 10]
    if not drawn:
        return
    axes.plot(*zip(*drawn), color=colour, marker=marker, label=label)
    axes.set_yscale("log")
    percent_axis(axes.yaxis)
    if ladder is main:
        place_axis(axes, places)
        draw_slope(axes, drawn, -2 if main is findings.survey.mesh_ladder else 2)


def draw_slope(axes, points, power):
    """The slope of the second order, from the finest point on, as high as the points are."""
    (x, y), top = points[-1], 2 * max(error for _, error in points)
    end = points[0][0] if y * (points[0][0] / x) ** power <= top else x * (top / y) ** (1 / power)
    axes.plot([x, end], [y, y * (end / x) ** power], "--", color=GREY, linewidth=1, zorder=0)
    axes.annotate("order 2", (end, y * (end / x) ** power), fontsize=8, color=GREY, xytext=(3, 3),
                  textcoords="offset points")


def mark_fails(axes, findings, belongs, place):
    places = [place(run) for run in findings.runner.all.values() if run.status == "fails" and belongs(run)]
    for x in places:
        axes.plot(x, 0.96, "x", color="black", markersize=7, transform=axes.get_xaxis_transform(), clip_on=False)
        axes.annotate("fails", (x, 0.92), xycoords=axes.get_xaxis_transform(), fontsize=8, ha="center", va="top")


def draw(findings):
    plt.rcParams.update({"font.size": 10, "text.parse_math": False, "axes.grid": True, "grid.alpha": 0.25, "svg.fonttype": "none",
                         "axes.spines.top": False, "axes.spines.right": False})
    figure = plt.figure(figsize=(11, 6), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1.7, 1))
    costs = figure.add_subplot(grid[:, 0])
    draw_costs(costs, findings)
    draw_meshes(figure.add_subplot(grid[0, 1]), findings)
    draw_steps(figure.add_subplot(grid[1, 1]), findings)
    title = findings.survey.variants.scene.value("title", default="") or findings.given.scene.name
    figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
    if costs.get_legend():
        mark_choices(costs, findings)
    for ending in ("png", "svg"):
        part = findings.given.folder / f".chart.tmp.{ending}"
        figure.savefig(part, dpi=120)
        part.replace(findings.given.folder / f"chart.{ending}")
    plt.close(figure)
