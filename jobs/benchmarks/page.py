"""The page that is printed has Markdown tables, and the list of targets at its end."""
from .runs import number


class Page:
    """Prints at once what it is given, and keeps it to write it to a file."""

    def __init__(self):
        self.lines, self.targets = [], []

    def write(self, text=""):
        print(text, flush=True)
        self.lines.append(text)

    def heading(self, text):
        self.write(f"\n## {text}\n")

    def table(self, head, rows):
        cells = [list(map(str, row)) for row in [head, *rows]]
        widths = [max(len(row[i]) for row in cells) for i in range(len(head))]
        lines = ["| " + " | ".join(cell.ljust(width) for cell, width in zip(row, widths)) + " |" for row in cells]
        lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
        for line in lines:
            self.write(line)

    def target(self, name, value, limit, unit="", at_least=False):
        """Notes whether `value` keeps to `limit`.  @return the limit as text"""
        met = value >= limit if at_least else value <= limit
        text = f"{'>=' if at_least else '<='} {number(limit)}{unit}"
        self.targets.append((name, f"{number(value)}{unit}", text, "met" if met else "not met"))
        return text

    def missing(self, name, why):
        self.targets.append((name, "-", "-", "not measured"))
        self.write(f"{name}: not measured, {why}")

    def conclude(self):
        self.heading("Targets")
        met = sum(target[3] == "met" for target in self.targets)
        self.table(["what", "measured", "target", "verdict"], self.targets)
        self.write(f"\n{met} of {len(self.targets)} met")
