"""40 cells of the stability map are not worse than the table of their colours says.

The table's rows are those of map.csv, as jobs/stability.sh writes it, of cells whose error is not near a limit.
"""
import csv
import pathlib
import sys

from support import REFERENCE, Verification

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "jobs" / "stability"))
import cases  # noqa: E402
import cells  # noqa: E402
import methods  # noqa: E402
import stability  # noqa: E402

TABLE = REFERENCE / "stability_colours.csv"
LIMIT = 30   # s of CPU that a cell may take


def main():
    verification = Verification(__doc__.splitlines()[0])
    with open(TABLE, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    made = {key: cases.ALL[key]() for key in dict.fromkeys(row["case"] for row in rows)}
    asked = [(row["case"], methods.ALL[row["method"]], float(row["step"])) for row in rows]
    found = stability.run(pathlib.Path(verification.program), made, asked, 1, LIMIT)
    verification.runs = len(found)
    for row, cell in zip(rows, found, strict=True):
        print(f"        {100 * cell.error:.3g} % off {cell.reason}")
        verification.check(f"{cell.case}, {cell.method}, {cell.step:g} s: {cell.colour}, was {row['colour']}; rank",
                           cells.COLOURS.index(cell.colour), cells.COLOURS.index(row["colour"]))
    verification.finish()


if __name__ == "__main__":
    main()
