"""The picture of error over cost: stored runs of both programs, and today's where there are any."""
import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt   # noqa: E402
from matplotlib.colors import to_rgb   # noqa: E402
from matplotlib.lines import Line2D   # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator   # noqa: E402
from PIL import Image   # noqa: E402

import costs   # noqa: E402
import page   # noqa: E402

BLUE, VERMILION, GREEN, GREY = "#0072b2", "#d55e00", "#009e73", "#777777"   # of Okabe and Ito
PANELS = (("free_fall", "free end", "Free fall: place of the free end"), ("tow_turn", "tail", "Tow and turn: place of the tail"),
          ("chain", "fairlead tension", "Mooring chain in waves: tension"),
          ("buoy", "line tension", "Moored buoy in waves: tension"))
KINDS = (("cpu_stepping", "-", True), ("cpu_whole", ":", False))
LABELS = {"free end": "free fall", "tail": "tow: tail", "tow force": "tow: force", "fairlead tension": "chain: tension",
          "body": "buoy: place", "line tension": "buoy: tension"}
ORIGIN = ("Stored: cablenet 0.1.0 and MoorDyn-C 2.7.1 on the same 2 virtual AMD EPYC cores, 2026-11-30, one core, best of 2-3.\n"
          "Errors are against limits that both programs converge to, and count as at least the mesh's own.\n"
          "Curves: the cheapest runs of all meshes, steps and schemes.")
# One and a quarter times the width of a column of text on GitHub [pixels].
WIDTH = 1100
# The colours that the pictures use, and how each fades into the colour behind it.
PURE = (BLUE, VERMILION, GREEN, GREY, *page.FACES.values())


def palette():
    """An image whose palette has each colour, pure and in steps to white and to black."""
    shades = [[255 - 17 * n] * 3 for n in range(16)]
    for colour in PURE:
        rgb = [255 * part for part in to_rgb(colour)]
        shades += [[round(part + share * (end - part)) for part in rgb] for end, share in
                   ((0, 0), (0, 0.35), (0, 0.7), (255, 0.35), (255, 0.7))]
    image = Image.new("P", (1, 1))
    image.putpalette(sum(shades, []))
    return image


def save(figure, path):
    """A PNG of few colours, which is small."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=200, bbox_inches="tight")
    plt.close(figure)
    image = Image.open(buffer).convert("RGB")
    image = image.resize((WIDTH, round(image.height * WIDTH / image.width)), Image.LANCZOS)
    image.quantize(palette=palette(), dither=Image.NONE).save(path, optimize=True)


def curve(axes, runs, colour, marker):
    for cost, line, filled in KINDS:
        best = costs.front(runs, cost)
        axes.plot([getattr(run, cost) for run in best], [100 * run.error for run in best], line, color=colour, marker=marker,
                  markersize=5, markerfacecolor=colour if filled else "white", linewidth=1.2)


def dress(axes, title):
    axes.set(xscale="log", yscale="log", xlabel="CPU time [s]", ylabel="error [%]")
    axes.set_title(title, fontsize=10, loc="left")
    axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 3)))
    for axis in axes.xaxis, axes.yaxis:
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.minorticks_off()


def runs_panel(axes, stored, fresh, case, measure, title):
    curve(axes, costs.select(stored, case, measure, costs.THEIRS), VERMILION, "s")
    curve(axes, costs.select(stored, case, measure, costs.OURS), BLUE, "o")
    if fresh:
        curve(axes, costs.select(fresh, case, measure, costs.OURS), GREEN, "^")
    dress(axes, title)


def statics_panel(axes, statics):
    for (case, values), marker in zip(statics.items(), "odv"):
        for column, (_, _, filled) in zip((1, 2), KINDS):
            axes.plot([value[column] for value in values], [100 * value[0] for value in values], color=BLUE, marker=marker,
                      linestyle="none", markersize=5, markerfacecolor=BLUE if filled else "white")
    dress(axes, "Statics (cablenet alone)")
    handles = [Line2D([], [], color=BLUE, marker=marker, linestyle="none", label=case) for case, marker in zip(statics, "odv")]
    axes.legend(handles=handles, fontsize=7.5, loc="upper left", frameon=True, framealpha=0.9)


def ratios_panel(axes, runs, whose):
    """For each measure the ratios at each accuracy, stepping above and the whole process below."""
    marks = dict(zip(costs.ACCURACIES, "oD^"))
    keys = list(dict.fromkeys(measure for _, measure, _ in costs.ratios(runs, "cpu_whole")))
    for cost, _, filled in KINDS:
        for (_, measure, accuracy), value in costs.ratios(runs, cost).items():
            axes.plot(value, keys.index(measure) + (-0.17 if filled else 0.17), marks[accuracy], color=BLUE, markersize=6,
                      markerfacecolor=BLUE if filled else "white")
    axes.axvline(1, color=VERMILION, linewidth=1.2)
    axes.set(xscale="log", xlim=(0.2, 400), ylim=(len(keys) - 0.4, -0.6), xlabel="MoorDyn-C's CPU time / cablenet's")
    axes.set_xticks([0.3, 1, 3, 10, 30, 100, 300], ["0.3", "1", "3", "10", "30", "100", "300"])
    axes.minorticks_off()
    axes.set_yticks(range(len(keys)), [LABELS[key] for key in keys])
    axes.grid(True, axis="x", color="#dddddd", linewidth=0.6)
    axes.set_title(f"Times as cheap, {whose} runs", fontsize=10, loc="left")
    handles = [Line2D([], [], color=GREY, marker=mark, linestyle="none", label=f"at {100 * accuracy:g} %")
               for accuracy, mark in marks.items()]
    axes.legend(handles=handles, fontsize=7.5, loc="upper center", bbox_to_anchor=(0.4, -0.2), ncols=3, frameon=False)


def legend(figure, fresh):
    handles = [Line2D([], [], color=VERMILION, marker="s", label="MoorDyn-C 2.7.1"),
               Line2D([], [], color=BLUE, marker="o", label="cablenet 0.1.0")]
    if fresh:
        handles.append(Line2D([], [], color=GREEN, marker="^", label="cablenet, this run, scaled"))
    handles += [Line2D([], [], color=GREY, marker="o", label="filled: stepping alone"),
                Line2D([], [], color=GREY, marker="o", linestyle=":", markerfacecolor="white", label="open: whole process")]
    figure.legend(handles=handles, ncols=len(handles), loc="upper center", bbox_to_anchor=(0.5, 0.985), fontsize=8.5,
                  frameon=False, columnspacing=1.2)


def error_over_cost(stored, statics, fresh, factor, path):
    figure, grid = plt.subplots(3, 2, figsize=(8.5, 10))
    for axes, panel in zip(grid.flat, PANELS):
        runs_panel(axes, stored, fresh, *panel)
    statics_panel(grid[2, 0], statics)
    ratios_panel(grid[2, 1], fresh + costs.peers(stored) if fresh else stored, "this machine's" if fresh else "stored")
    legend(figure, fresh)
    words = ORIGIN
    if fresh:
        words += f"\nThis run's times are multiplied by {factor:.3g}, the hand-written chain's time there over that here; errors are the stored ones."
    figure.text(0.02, 0.002, words, fontsize=8, va="bottom")
    figure.tight_layout(rect=(0, 0.05, 1, 0.965))
    save(figure, path)
