"""Small free vibrations of strings, chains and bars: frequencies from time histories against closed forms and
eigenvalues of the same mesh."""
import numpy as np

from support import HELD, Verification, read_reference, scene

ELEMENTS, PERIODS, STEPS_PER_PERIOD = 40, 4, 400
STRING = {"mass_per_length": 0.1, "axial_stiffness": 1e5}
CHAIN = {"mass_per_length": 0.153036, "axial_stiffness": 1039860}
CHAIN_LENGTH, TIP_MASS, GRAVITY = 1.713, 0.3, 9.81


def fitted_frequency(t, y):
    """Fits a constant and one harmonic by least squares.  @return (frequency [Hz], rest over amplitude)"""
    y = y - y.mean()
    turn = np.flatnonzero(y[:-1] * y[1:] < 0)
    crossings = t[turn] - y[turn] * (t[turn + 1] - t[turn]) / (y[turn + 1] - y[turn])
    omega = np.pi * (len(crossings) - 1) / (crossings[-1] - crossings[0])
    for _ in range(20):
        cosine, sine = np.cos(omega * t), np.sin(omega * t)
        harmonic = np.column_stack([cosine, sine, np.ones_like(t)])
        (a, b, c), *_ = np.linalg.lstsq(harmonic, y, rcond=None)
        slope = t * (b * cosine - a * sine)
        (*_, change), *_ = np.linalg.lstsq(np.column_stack([harmonic, slope]), y, rcond=None)
        omega += change
    rest = y - harmonic @ [a, b, c]
    return omega / (2 * np.pi), np.sqrt(np.mean(rest**2) * 2) / np.hypot(a, b)


def mode_from_pin(stiffness, mass, tip_mass, number):
    """Mode `number` (from 1) of a chain of springs that is held at node 0.  The mode is 1 at the free end.
    @param mass  of an element"""
    n = len(stiffness)
    K, M = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1))
    for i, k in enumerate(stiffness):
        K[i:i + 2, i:i + 2] += k * np.array([[1, -1], [-1, 1]])
        M[i:i + 2, i:i + 2] += mass / 6 * np.array([[2, 1], [1, 2]])
    M[n, n] += tip_mass
    root = np.linalg.inv(np.linalg.cholesky(M[1:, 1:]))
    _, vectors = np.linalg.eigh(root @ K[1:, 1:] @ root.T)
    mode = root.T @ vectors[:, number - 1]
    return np.concatenate([[0], mode / mode[-1]])


class Frequencies:
    def __init__(self, verification):
        self.verification = verification
        self.reference = read_reference("frequencies.csv")

    def value(self, case, kind, model, number):
        r = self.reference
        row = (r["case"] == case) & (r["kind"] == kind) & (r["model"] == model) & (r["n"] == number)
        return float(r["f_Hz"][row].item())

    def check(self, case, kind, number, cable_type, points, cables, gravity, column, exact_kind=None):
        """Lets the drawn shape go and compares the frequency of a history column."""
        mesh = self.value(case, kind, f"NPFEM_N{ELEMENTS}", number)
        exact = self.value(case, exact_kind or kind, "continuum", number)
        step = 1 / (mesh * STEPS_PER_PERIOD)
        name = f"{case} {kind} {number}"
        run = self.verification.run(scene(cable_type, points, cables, PERIODS / mesh, step, 0, [column.split(".")[0]],
                                          gravity, scheme="energy_momentum"))
        found, rest = fitted_frequency(run["time"], run[column])
        stepped = np.arctan(np.pi * mesh * step) / (np.pi * step)
        print(f"        {name}: {found:.9g} Hz; over the continuum's {found / exact - 1:.2e}, the mesh's "
              f"{found / mesh - 1:.2e}, the mesh's with this step {found / stepped - 1:.2e}; not in the fit {rest:.1e}")
        self.verification.check(f"{name}: frequency, relative to the continuum", abs(found / exact - 1), 4e-3)
        self.verification.check(f"{name}: frequency, relative to the mesh", abs(found / mesh - 1), 4e-5)
        self.verification.check(f"{name}: frequency, relative to mesh and step", abs(found / stepped - 1), 1e-5)

    def string(self, kind, number):
        """The string is observed at a quarter of its length, where modes 1 to 3 all move."""
        length, stretch, quarter = 10.0, 1 + 200 / 1e5, ELEMENTS // 4
        arc = np.linspace(0, stretch * length, ELEMENTS + 1)
        wave = np.sin(number * np.pi * arc / arc[-1])
        wave[-1] = 0
        x, z = (arc + 1e-4 * wave, 0 * arc) if kind == "axial" else (arc, 1e-3 / number * wave)
        shape = np.column_stack([x, 0 * arc, z]).tolist()
        points = {"pin": HELD, "end": {"position": shape[-1], "motion": "fixed"}, "probe": {"position": shape[quarter]}}
        cables = {"first": {"from": "pin", "to": "probe", "length": length / 4, "elements": quarter,
                            "shape": shape[:quarter + 1]},
                  "second": {"from": "probe", "to": "end", "length": 0.75 * length,
                             "elements": ELEMENTS - quarter, "shape": shape[quarter:]}}
        column = "probe.x" if kind == "axial" else "probe.z"
        self.check("H1_string", kind, number, STRING, points, cables, 0, column)

    def hanging_chain(self, case, tip_mass, number):
        """The chain starts with every element as long as its static tension makes it."""
        L = CHAIN_LENGTH / ELEMENTS
        weight = CHAIN["mass_per_length"] * L * GRAVITY
        tension = weight * (ELEMENTS - np.arange(ELEMENTS) - 0.5) + tip_mass * GRAVITY
        lengths = L * (1 + tension / CHAIN["axial_stiffness"])
        u = 5e-3 / number**2 * mode_from_pin(tension / lengths, CHAIN["mass_per_length"] * L, tip_mass, number)
        z = -np.concatenate([[0], np.cumsum(np.sqrt(lengths**2 - np.diff(u)**2))])
        shape = np.column_stack([u, 0 * u, z]).tolist()
        points = {"pin": HELD, "tip": {"position": shape[-1], "mass": tip_mass}}
        cable = {"from": "pin", "to": "tip", "length": CHAIN_LENGTH, "elements": ELEMENTS, "shape": shape}
        self.check(case, "transverse_elastic", number, CHAIN, points, cable, GRAVITY, "tip.x",
                   "transverse_elastic" if tip_mass == 0 else "transverse_inextensible")

    def bar_with_tip_mass(self):
        L = CHAIN_LENGTH / ELEMENTS
        stiffness = np.full(ELEMENTS, CHAIN["axial_stiffness"] / L)
        u = mode_from_pin(stiffness, CHAIN["mass_per_length"] * L, TIP_MASS, 1)
        shape = [[x, 0, 0] for x in np.linspace(0, CHAIN_LENGTH, ELEMENTS + 1) + 1e-4 * u]
        points = {"pin": HELD, "tip": {"position": shape[-1], "mass": TIP_MASS}}
        cable = {"from": "pin", "to": "tip", "length": CHAIN_LENGTH, "elements": ELEMENTS, "shape": shape}
        self.check("H3_axial_fixed_tipmass", "axial", 1, CHAIN, points, cable, 0, "tip.x")


def main():
    verification = Verification(__doc__)
    frequencies = Frequencies(verification)
    for number in (1, 2, 3):
        frequencies.string("transverse", number)
    frequencies.string("axial", 1)
    for number in (1, 2, 3):
        frequencies.hanging_chain("H2_hanging_chain", 0, number)
    frequencies.hanging_chain("H4_chain_tipmass", TIP_MASS, 1)
    frequencies.bar_with_tip_mass()
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
