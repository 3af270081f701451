"""Words beside points of a picture, where they cross least."""
import itertools

import numpy
from matplotlib.text import Text
from matplotlib.transforms import Bbox

# Where words may stand from their point [points of print], nearest first; then which of their corners is there.
DISTANCES = (8, 20, 36, 56)
DIRECTIONS = ((1, 0.5, "left", "bottom"), (1, -0.5, "left", "top"), (-1, 0.5, "right", "bottom"), (-1, -0.5, "right", "top"),
              (0, 1, "center", "bottom"), (0, -1, "center", "top"))
SHIFT = {"left": 0.0, "center": 0.5, "right": 1.0, "bottom": 0.0, "top": 1.0}
MARKER, PADDING = 7, 3

# How much it matters what words cross: a sample of a line, a point, other words.
LINE, POINT, WORDS = 1, 5, 50
SAMPLES = 40


def obstacles(axes):
    """(box on the screen, what it matters) of all points, of the lines between them, and of the legend."""
    found = [(axes.get_legend().get_window_extent(), WORDS)]
    for line in axes.get_lines():
        places = axes.transData.transform(line.get_xydata()) if line.get_transform() == axes.transData else []
        found += [(Bbox.from_extents(x - MARKER, y - MARKER, x + MARKER, y + MARKER), POINT) for x, y in places]
        if line.get_linestyle() not in ("None", "", " "):
            for start, end in itertools.pairwise(places):
                found += [(Bbox.from_extents(*point, *(point + 1)), LINE) for point in numpy.linspace(start, end, SAMPLES)]
    return found


def place(axes, words, point, taken):
    """Writes words near a point, and adds their box to those that are taken."""
    text = axes.annotate(words, point, xytext=(0, 0), textcoords="offset points", fontsize=8, zorder=6,
                         bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.5},
                         arrowprops={"arrowstyle": "-", "color": "#666666", "linewidth": 0.6, "shrinkB": 3})
    renderer = axes.figure.canvas.get_renderer()
    text.update_positions(renderer)
    size = Text.get_window_extent(text, renderer).size
    start, unit = axes.transData.transform(point), axes.figure.dpi / 72

    def box(choice):
        distance, (x, y, horizontal, vertical) = choice
        corner = start + distance * unit * numpy.array([x, y]) - size * (SHIFT[horizontal], SHIFT[vertical])
        return Bbox.from_bounds(*corner, *size).padded(PADDING)

    best = min(itertools.product(DISTANCES, DIRECTIONS), key=lambda choice: crossings(axes, box(choice), taken))
    distance, (x, y, horizontal, vertical) = best
    text.xyann = (distance * x, distance * y)
    text.set(horizontalalignment=horizontal, verticalalignment=vertical)
    taken.append((box(best), WORDS))


def crossings(axes, box, taken):
    """What words cross; leaving the axes is worse than all of that."""
    frame = axes.get_window_extent()
    inside = frame.x0 <= box.x0 and box.x1 <= frame.x1 + 10 and frame.y0 <= box.y0 and box.y1 <= frame.y1
    return sum(weight for other, weight in taken if box.overlaps(other)) + (0 if inside else 10000)
