"""Answers that take too long to calculate each time are stored in references/ and calculated anew by `--references`.

A table's first line says how it was calculated, and by how much half its step moves it, over the motion.  A table ends
where that is more than a third of what is called accurate: beyond, neighbouring motions part.
"""
import pathlib

import numpy as np

from elements import Elements

FOLDER = pathlib.Path(__file__).resolve().parent / "references"
APART = 0.003  # of the motion
ANEW = False   # calculate all tables anew


def path(key, made, watched, laws, halvings):
    """The positions (rows, 3) of a point at the instants of its output."""
    file = FOLDER / f"{key}.csv"
    if ANEW or not file.exists():
        calculate(file, made, watched, laws, halvings)
    return np.loadtxt(file, delimiter=",", skiprows=2)[:, 1:]


def calculate(file, made, watched, laws, halvings):
    """@param halvings  how often the longest stable step is halved: kinks, where ropes go slack, want it shorter"""
    elements = Elements(made, laws)
    end, interval = made["time"]["end"], made["output"]["interval"]
    times = interval * np.arange(round(end / interval) + 1)
    most = min(elements.longest(), interval / 4) / 2**halvings
    coarse, fine = (elements.motion(times, watched, step) for step in (most, most / 2))
    moved = np.linalg.norm(fine - fine[0], axis=1).max()
    off = np.linalg.norm(fine - coarse, axis=1) / moved
    apart = np.flatnonzero(~(off <= APART))
    if apart.size:
        times, fine, off = times[:apart[0]], fine[:apart[0]], off[:apart[0]]
    print(f"{file.stem}: half the step moves it by {off.max():.1e} of the motion, up to {times[-1]:.3g} s", flush=True)
    head = (f"explicit Runge-Kutta of fourth order, steps of {most / 2:.3g} s; twice that is off by {off.max():.1e} of the "
            f"motion\ntime,{watched}.x,{watched}.y,{watched}.z")
    FOLDER.mkdir(exist_ok=True)
    np.savetxt(file, np.column_stack([times, fine]), "%.9g", ",", header=head, comments="# ")
