"""Draws the stability map from the cells that jobs/stability.sh has found and that are stored here."""
import csv
import pathlib
from types import SimpleNamespace

import methods
import page
from cells import Cell

from pictures import save

STORED = pathlib.Path(__file__).resolve().parent / "stability.csv"
CAPTION = "cablenet 0.1.0, 2026-12-01, bash jobs/stability.sh"


def read(path=STORED):
    """The cells, and {key: case} with the names and steps that the map shows."""
    found, made = [], {}
    with open(path, encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            step = float(row["step"])
            case = made.setdefault(row["case"], SimpleNamespace(name=row["name"], steps=[]))
            if step not in case.steps:
                case.steps.append(step)
            found.append(Cell(row["case"], methods.ALL[row["method"]].key, step, int(row["exit_status"]),
                              float(row["error"]), "said" if row["said"] == "yes" else ""))
    return found, made


def draw(path):
    found, made = read()
    figure = page.figure_of(found, made, methods.ALL)
    figure.axes[0].set_title(CAPTION, loc="left", fontsize=9, y=1.15)
    save(figure, path)
