"""The map as a picture (png, svg), a table (csv) and a page (md) with the reason of each cell that is not green."""
import csv
from collections import Counter

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt   # noqa: E402
import numpy as np   # noqa: E402

from cells import COLOURS, MEANINGS   # noqa: E402

# Colours of Okabe and Ito, which the colour-blind can tell apart, and a mark for those who see none.
FACES = {"green": "#7fcfb4", "amber": "#f5d77a", "noted": "#e69f00", "told": "#9cc9ea", "wrong": "#a01c1c",
         "failed": "#333333"}
MARKS = {"green": "", "amber": "", "noted": "N", "told": "T", "wrong": "!!", "failed": "F"}


def percent(error):
    """Two digits of an error in per cent."""
    if not np.isfinite(error):
        return ""
    value = 100 * error
    return "<.01" if value < 0.01 else f"{value:.1g}" if value < 1 else f"{value:.0f}" if value < 1000 else ">999"


def label(cell):
    return f"{MARKS[cell.colour]} {percent(cell.error) if cell.colour != 'told' else ''}".strip()


def figure_of(found, made, picked):
    keys, columns = list(made), list(picked)
    first = dict(zip(keys, np.cumsum([0] + [len(made[key].steps) for key in keys])))
    rows = sum(len(made[key].steps) for key in keys)
    figure, axes = plt.subplots(figsize=(3.5 + 0.47 * len(columns), 2.6 + 0.2 * rows))
    for cell in found:
        steps = made[cell.case].steps
        height = len(steps) if picked[cell.method].adaptive else 1
        x, y = columns.index(cell.method), first[cell.case] + (0 if height > 1 else steps.index(cell.step))
        axes.add_patch(plt.Rectangle((x, y), 1, height, facecolor=FACES[cell.colour], edgecolor="white", linewidth=0.8))
        dark = cell.colour in ("wrong", "failed")
        axes.text(x + 0.5, y + height / 2 + 0.04, label(cell), ha="center", va="center", fontsize=8.5,
                  color="white" if dark else "black", fontweight="bold" if dark else "normal")
    name_axes(axes, made, picked, first, rows)
    legend(axes, found, rows)
    return figure


def draw(folder, found, made, picked):
    figure = figure_of(found, made, picked)
    for end in ("png", "svg"):
        figure.savefig(folder / f"map.{end}", dpi=110, bbox_inches="tight")
    plt.close(figure)


def name_axes(axes, made, picked, first, rows):
    axes.set(xlim=(0, len(picked)), ylim=(rows, 0))
    axes.xaxis.tick_top()
    axes.set_xticks(np.arange(len(picked)) + 0.5, [name_of(method) for method in picked.values()], rotation=60, ha="left",
                    rotation_mode="anchor", fontsize=9)
    steps = [step for case in made.values() for step in case.steps]
    axes.set_yticks(np.arange(rows) + 0.5, [f"{step:g} s" for step in steps], fontsize=8)
    axes.tick_params(length=0)
    for key, case in made.items():
        axes.axhline(first[key], color="black", linewidth=0.8)
        axes.text(-1.25, first[key] + len(case.steps) / 2, "\n".join(wrapped(case.name)), ha="right", va="center",
                  fontsize=9)
    for spine in axes.spines.values():
        spine.set_linewidth(0.8)


def wrapped(name, width=26):
    lines = [""]
    for word in name.split():
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] = f"{lines[-1]} {word}".strip()
    return lines


def legend(axes, found, rows):
    count = Counter(cell.colour for cell in found)
    handles = [plt.Rectangle((0, 0), 1, 1, facecolor=FACES[colour]) for colour in COLOURS]
    words = [f"{MARKS[colour]} {MEANINGS[colour]}: {count[colour]} cells".strip() for colour in COLOURS]
    axes.legend(handles, words, loc="upper center", bbox_to_anchor=(0.35, -0.3 / rows), ncols=1, fontsize=9, frameon=False,
                title="Number: largest error, % of the motion. Adaptive steps have one cell a case.", title_fontsize=9)


def table(folder, found, picked):
    with open(folder / "map.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("case", "method", "step", "colour", "error", "exit_status", "reason"))
        for cell in found:
            writer.writerow((cell.case, cell.method, f"{cell.step:g}", cell.colour, f"{cell.error:.3g}", cell.status,
                             cell.reason))


def name_of(method):
    return method.name.replace("\n", " ")


def counts(found, picked):
    yield "| method | " + " | ".join(COLOURS) + " |"
    yield "|---" * (len(COLOURS) + 1) + "|"
    for key, method in picked.items():
        count = Counter(cell.colour for cell in found if cell.method == key)
        yield f"| {name_of(method)} | " + " | ".join(str(count[colour]) for colour in COLOURS) + " |"
    count = Counter(cell.colour for cell in found)
    yield "| all | " + " | ".join(str(count[colour]) for colour in COLOURS) + " |"


def alone(cell, found):
    """Why the cell of the shortest step is not green."""
    best = min((other for other in found if other.case == cell.case and other.step == cell.step
                and np.isfinite(other.error)), key=lambda other: other.error)
    if best.colour == "green":
        return "not told; the scheme: others have less at this step"
    return f"not told; all schemes err here, by {100 * best.error:.2g} % at least: neighbouring motions part"


def why(cell, found, picked):
    """What the run said, or what the cells of other steps show."""
    if cell.reason:
        return cell.reason
    method = picked[cell.method]
    shorter = [other for other in found if other.case == cell.case and np.isfinite(other.error)
               and (picked[other.method].adaptive and other.method > cell.method if method.adaptive
                    else other.method == cell.method and other.step < cell.step)]
    if not shorter:
        return alone(cell, found)
    nearest = shorter[0] if method.adaptive else shorter[-1]
    what = f"with {name_of(picked[nearest.method])}" if method.adaptive else f"with steps of {nearest.step:g} s"
    kind = "the tolerance" if method.adaptive else "the step"
    if nearest.error < 0.7 * cell.error:
        return f"not told; {kind}: {100 * nearest.error:.2g} % {what}"
    return f"not told; not {kind}: {100 * nearest.error:.2g} % {what}, too, as neighbouring motions part"


def reasons(found, made, picked):
    for key, case in made.items():
        yield f"\n### {case.name}\n"
        yield f"Answer: {case.origin}. To {case.made['time']['end']:.3g} s.\n"
        bad = [cell for cell in found if cell.case == key and cell.colour != "green"]
        if not bad:
            yield "All cells are green."
            continue
        yield "| method | step [s] | colour | error [%] | reason: what the run said, or what other steps show |"
        yield "|---|---|---|---|---|"
        for cell in bad:
            error = percent(cell.error).replace("<", "less than ").replace(">", "more than ") or "none"
            reason = why(cell, found, picked).replace("|", "\\|")
            yield f"| {name_of(picked[cell.method])} | {cell.step:g} | {cell.colour} | {error} | {reason} |"


def write(folder, found, made, picked, version):
    folder.mkdir(parents=True, exist_ok=True)
    draw(folder, found, made, picked)
    table(folder, found, picked)
    lines = [f"# Stability map, {version}\n", "![map](map.png)\n", "| colour | mark | what it means |", "|---|---|---|"]
    lines += [f"| {colour} | {MARKS[colour] or 'none'} | {MEANINGS[colour]} |" for colour in COLOURS]
    lines += ["\nAn error is the largest distance from the answer, over how far the answer moves.\n", *counts(found, picked)]
    lines += ["\n## Reasons of cells that are not green", *reasons(found, made, picked)]
    (folder / "map.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
