"""How the numbers that an example's README gives are compared with runs of its scenes."""
import re
import shutil
import subprocess

import numpy as np

from bench import ENVIRONMENT

NUMBER = r"[-+]?\d+(?: \d{3})*(?:\.\d+)?(?:e[-+]?\d+)?"


def table(path):
    """{column: values}; lines that begin with # are comments."""
    lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
    values = np.array([[float(word) for word in line.split(",")] for line in lines[1:]])
    return dict(zip(lines[0].split(","), values.T))


class Result:
    """A finished run: `result["P.x"]` is a column of history.csv, `result.after(t)["P.x"]` its rows from t on."""

    def __init__(self, columns, report, output):
        self.columns, self.report, self.output = columns, report, output

    def __getitem__(self, name):
        return self.columns[name]

    def counted(self, key):
        return float(re.search(rf"^ *{key}: (\d+)$", self.report, re.MULTILINE)[1])

    def between(self, first, last=np.inf):
        rows = (self["time"] >= first - 1e-9) & (self["time"] <= last + 1e-9)
        return Result({name: values[rows] for name, values in self.columns.items()}, self.report, self.output)

    def off(self, reference, name, last=np.inf, column=None):
        """The largest difference from a reference, linear between rows, until `last`."""
        reached = reference["time"] <= min(last, self["time"][-1]) + 1e-9
        found = np.interp(reference["time"][reached], self["time"], self[name])
        return np.abs(found - reference[column or name][reached]).max()


class Claims:
    """The README of one example, runs of its scenes, and what does not agree."""

    def __init__(self, example, program, scratch):
        self.example, self.program, self.scratch = example, program, scratch / example.name
        self.scratch.mkdir()
        text = (example / "README.md").read_text(encoding="utf-8")
        self.command = re.search(r"```bash\n(mpirun .*)\n", text)[1].split()
        self.lines, self.text = text.splitlines(), " ".join(text.split())
        self.wrong, self.compared, self.count = [], 0, 0

    def run(self, scene=None, *options, changes=(), status=0):
        """Runs a scene of the example, the README's first command without one; `changes`: (old, new) of its text."""
        self.count += 1
        path, folder = scene and self.example / scene, self.scratch / str(self.count)
        if changes:
            text = path.read_text(encoding="utf-8")
            for old, new in changes:
                assert old in text, f"{path} has no {old}"
                text = text.replace(old, new)
            path = folder.with_suffix(".yaml")
            path.write_text(text, encoding="utf-8")
        words = list(self.command) if scene is None else ["build/cablenet", "run", str(path), "-o", "DIR"]
        words[words.index("build/cablenet")], words[words.index("-o") + 1] = str(self.program), str(folder)
        done = subprocess.run(words + [str(word) for word in options], cwd=self.example.parents[1], capture_output=True,
                              text=True, env=ENVIRONMENT, check=False)
        assert done.returncode == status, f"exit status {done.returncode}: {' '.join(words)}\n{done.stderr}"
        result = Result(table(folder / "history.csv"), (folder / "run.yaml").read_text(encoding="utf-8"), done.stderr)
        shutil.rmtree(folder)
        return result

    def says(self, pattern):
        """The numbers that the README gives where the pattern, with `#` for each of them, fits; as written."""
        found = re.search(pattern.replace("#", f"({NUMBER})"), self.text)
        assert found, f"the README does not say: {pattern}"
        return found.groups() if len(found.groups()) > 1 else found[1]

    def row(self, label):
        """The first numbers in the cells of a table's row that begins with this label; None in cells without."""
        rows = [line for line in self.lines if line.startswith(f"| {label} |")]
        assert rows, f"the README has no row: {label}"
        cells = [re.search(NUMBER, cell) for cell in rows[0].split("|")[2:-1]]
        return [cell and cell[0] for cell in cells]

    def _note(self, good, what, value, number):
        self.compared += 1
        if not good:
            self.wrong.append(f"{what}: {value:.6g}, the README says {number}")

    def near(self, what, number, value, share=0.0, slack=0.0):
        """To three quarters of the number's last digit, or to a share of it where rounding decides on steps, contacts or
        the way to equilibrium; `slack` comes on top, of a reference that has few digits."""
        number = number.replace(" ", "")
        mantissa, _, exponent = number.partition("e")
        digit = 10.0**(int(exponent or 0) - len(mantissa.partition(".")[2]))
        self._note(abs(value - float(number)) <= max(0.75 * digit, share * abs(float(number))) + slack, what, value, number)

    def rounding(self, what, number, value):
        """What rounding does: not more than ten times as much."""
        self._note(abs(value) <= 10 * float(number), what, value, number)
