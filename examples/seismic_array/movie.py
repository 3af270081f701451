"""movie.py RUN_DIR OUT.gif: the array from above, cables coloured by tension, tails as dots, one frame per saved time."""
import argparse
import pathlib

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.collections import LineCollection

REACH = 620           # m, of the picture about the array's middle
TRUNK = 0             # its cable_id


def read(run):
    with h5py.File(run / "result.h5") as file:
        lines, ids = file["mesh/lines"][:], file["mesh/cable_id"][:]
        frames = [file["frames"][name] for name in sorted(file["frames"])]
        return lines, ids, [(frame.attrs["time"], frame["points"][:], frame["tension"][:], frame["body_position"][:])
                            for frame in frames]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("movie", type=pathlib.Path)
    parser.add_argument("--every", type=int, default=2, help="saved times per frame")
    options = parser.parse_args()
    lines, ids, frames = read(options.run)
    streamers = ids != TRUNK
    paths = numpy.array([points[lines[~streamers][[0, -1], [0, 1]], :2] for _, points, _, _ in frames])

    figure, axes = plt.subplots(figsize=(6.4, 5.2))
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    for door in range(2):
        axes.plot(*paths[:, door].T, color="0.8", linewidth=1)
    axes.add_collection(trunk := LineCollection([], colors="black", linewidths=1.5))
    largest = max(tension[streamers].max() for time, _, tension, _ in frames if time > 100)
    axes.add_collection(cables := LineCollection([], cmap="viridis", norm=plt.Normalize(0, largest), linewidths=1.5))
    tails, = axes.plot([], [], ".", color="tab:orange", markersize=5)
    figure.colorbar(cables, label="tension of the streamers [N]")

    def draw(frame):
        time, points, tension, bodies = frame
        segments = points[lines][:, :, :2]
        trunk.set_segments(segments[~streamers])
        cables.set_segments(segments[streamers])
        cables.set_array(tension[streamers])
        tails.set_data(bodies[:, 0], bodies[:, 1])
        low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
        middle = (low + high) / 2
        axes.set_xlim(middle[0] - REACH, middle[0] + REACH)
        axes.set_ylim(middle[1] - REACH, middle[1] + REACH)
        axes.set_title(f"t = {time:.0f} s")

    figure.tight_layout()
    FuncAnimation(figure, draw, frames[::options.every], init_func=lambda: None).save(
        options.movie, writer=PillowWriter(fps=10), dpi=75)
    print(options.movie)


if __name__ == "__main__":
    main()
