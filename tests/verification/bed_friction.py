"""What lies on a rough bed is held up to Coulomb's force: anchored lines, a chain that is pulled, blocks that slide."""
import pathlib

import numpy as np
from scipy.optimize import brentq

from statics_support import fixed, report_number, still
from support import Verification, read_reference, scene

GROUNDED_CHAIN = pathlib.Path(__file__).resolve().parent.parent / "cases" / "scenes" / "grounded_chain.yaml"
GRAVITY, RHO = 9.81, 1025.0


class RestingLine:
    """The elastic catenary with friction on the bed, from an anchor on the bed to a fairlead `depth` above it.

    Source: Jonkman, Dynamics Modeling and Loads Analysis of an Offshore Floating Wind Turbine, NREL/TP-500-41958
    (2007), eqs. 2-37 and 2-38, which are those of MAP++.  H and V pull at the fairlead, w is the weight per unstretched
    length, B the length on the bed:
      depth = H/w (sqrt(1 + (V/H)^2) - 1) + V^2/(2 EA w),   V = w (length - B)
      x = B + H/w asinh(V/H) + H length/EA + mu w/(2 EA) (-B^2 + (B - H/(mu w)) max(B - H/(mu w), 0))
    and the anchor bears max(H - mu w B, 0).
    @param lifted, resting  the lengths above the bed and on it [m]; H and x follow
    """

    def __init__(self, depth, lifted, resting, w, stiffness, mu):
        self.depth, self.length, self.resting = depth, lifted + resting, resting
        self.v = w * lifted

        def miss(h):
            return (np.hypot(h, self.v) - h) / w + self.v**2 / (2 * stiffness * w) - depth

        self.h = brentq(miss, 1e-9 * self.v, 1e4 * self.v, xtol=1e-12 * self.v, rtol=1e-14)
        unloaded = resting - self.h / (mu * w)
        self.x = (resting + self.h / w * np.arcsinh(self.v / self.h) + self.h * self.length / stiffness
                  + mu * w / (2 * stiffness) * (unloaded * max(unloaded, 0) - resting**2))
        self.anchor = max(self.h - mu * w * resting, 0)
        self.fairlead = np.hypot(self.h, self.v)


# mu, depth [m], EA [N], lengths above the bed and on it over the depth, shape, tension_only.  Above the bed 1.1 depths
# are slack and 6 nearly taut.
LINES = [
    (0.3, 50, 5e8, 1.1, 2.0, "catenary", True),
    (0.3, 50, 5e6, 1.5, 1.0, "straight", True),
    (0.3, 200, 5e8, 3.0, 4.0, "catenary", False),
    (0.3, 200, 5e6, 6.0, 0.5, "straight", False),
    (0.6, 50, 5e8, 6.0, 4.0, "straight", True),
    (0.6, 50, 5e6, 1.2, 2.0, "catenary", False),
    (0.6, 200, 5e8, 2.0, 0.2, "catenary", True),
    (0.6, 200, 5e6, 3.0, 6.0, "straight", True),
    (1.0, 50, 5e8, 2.0, 5.0, "straight", False),
    (1.0, 50, 5e6, 6.0, 3.0, "catenary", True),
    (1.0, 200, 5e8, 1.05, 0.5, "straight", True),
    (1.0, 200, 5e6, 4.0, 1.0, "catenary", False),
]
ELEMENTS = 200
CHAIN = {"diameter": 0.1, "mass_per_length": 120, "axial_stiffness": 5e8}
SUNK = 1e-3   # how deep the chain lies in the bed [m]


def line_scene(line, mu, weight, stiffness, shape, tension_only, elements=ELEMENTS):
    """The bed is so low that what rests lies level with the anchor."""
    bed = {"level": -line.depth + SUNK, "stiffness": weight / (CHAIN["diameter"] * SUNK), "friction": mu}
    points = {"anchor": fixed(0, 0, -line.depth), "fairlead": fixed(line.x, 0, 0)}
    cables = {"line": {"from": "anchor", "to": "fairlead", "length": line.length, "elements": elements, "shape": shape}}
    return still({**CHAIN, "axial_stiffness": stiffness, "tension_only": tension_only}, points, cables,
                 ["line", "anchor", "fairlead"], GRAVITY, {"fluid": {"density": RHO}, "seabed": bed})


def check_lines(v):
    """The anchor's bound is the friction on the half element that hangs on it, beside 0.1 % of the fairlead's."""
    weight = (CHAIN["mass_per_length"] - RHO * np.pi / 4 * CHAIN["diameter"]**2) * GRAVITY
    for mu, depth, stiffness, lifted, resting, shape, tension_only in LINES:
        line = RestingLine(depth, lifted * depth, resting * depth, weight, stiffness, mu)
        run = v.run(line_scene(line, mu, weight, stiffness, shape, tension_only))
        name = f"line, mu {mu}, {depth} m, EA {stiffness:.0e}, {lifted} + {resting} depths, {shape}"
        small = 1e-3 * line.fairlead
        v.close(f"{name}: fairlead [N]", run["line.tension_to"][0], line.fairlead, small)
        half = 0.5 * mu * weight * line.length / ELEMENTS
        v.close(f"{name}: anchor [N]", -run["anchor.fx"][0], line.anchor, small + half)


def pulled_chain(end):
    """A chain of 100 m that lies straight on a bed that could hold 133 kN, and a pull of 50 kN at its end."""
    bed = {"level": -100, "stiffness": 3e6, "damping": 3e5, "friction": 1.0}
    chain = {"diameter": 0.064929, "mass_per_length": 138.73, "axial_stiffness": 545e6, "axial_damping": 1e6,
             "tension_only": True, "normal_drag": 1.6, "tangential_drag": 0.1, "added_mass": 1.0}
    points = {"anchor": fixed(0, 0, -100.0068), "end": {"position": [100, 0, -100.0068], "force": [50e3, 0, 0]}}
    made = scene(chain, points, {"from": "anchor", "to": "end", "length": 100, "elements": 50}, end, 0.05, 5,
                 ["cable", "anchor", "end"], initial="rest")
    made["initial"] = made["time"].pop("initial")
    made["environment"] = {"fluid": {"density": 1025, "surface": 0}, "seabed": bed}
    return made


def check_holding(v):
    """Springs hold for ever, where viscous friction would let the pull through to the anchor.  The pull comes at once,
    so that the chain swings through, and some of that stays in it."""
    run = v.run(pulled_chain(600))
    for since, most in ((10, 0.02), (60, 0.01)):
        late = run["time"] >= since
        v.check(f"pulled chain: anchor over the pull from {since} s on", np.abs(run["anchor.fx"][late]).max() / 50e3,
                most)
    half = run["time"] >= 300
    v.check("pulled chain: creep of the end in 300 s [m]", np.ptp(run["end.x"][half]), 1e-6)


def check_held_chain(v):
    """The same pull in statics.  With f = mu w, the springs' travel u and b = sqrt(EA u/f), the chain slips where it
    pulls with more than f b, and from there its travel fades to the anchor as sinh(s/b), its tension as cosh(s/b).  The
    error of an element of length l is some (l/b)^2/12 of 1/b, which is 3e-5 here."""
    made = pulled_chain(1)
    del made["time"]
    made["cables"]["cable"]["elements"] = 400
    chain, pull, length, mu = made["cable_types"]["rope"], 50e3, 100.0, 1.0
    stiffness, diameter = chain["axial_stiffness"], chain["diameter"]
    f = mu * 9.80665 * (chain["mass_per_length"] - 1025 * np.pi / 4 * diameter**2)
    u = mu * 0.007 * diameter
    # In statics springs without a stiffness of their own hold at once.
    made["environment"]["seabed"]["friction_stiffness"] = f / u / diameter
    b = np.sqrt(stiffness * u / f)
    held = length - brentq(lambda slips: pull - f * slips - f * b / np.tanh((length - slips) / b), 0, pull / f)
    anchor = f * b / np.sinh(held / b)
    end = u + (pull - 0.5 * f * (length - held)) * (length - held) / stiffness
    made["initial"] = "static"
    run = v.run(made)
    v.close("held chain: anchor [N]", -run["anchor.fx"][0], anchor, 1e-3 * anchor)
    v.close("held chain: travel of its end [m]", run["end.x"][0] - length, end, 1e-4 * end)


def harmonic(time, tension):
    """The amplitude, with its phase, of the period of 10 s that ends at 20 s, and the range."""
    last = (time > 9.95) & (time < 19.95)
    return np.mean(tension[last] * np.exp(-0.2j * np.pi * time[last])), np.ptp(tension[last])


def check_grounded_chain(v):
    """With viscous friction the anchor's tension lags by 85 degrees."""
    reference, run = read_reference("grounded_chain.csv"), v.run(GROUNDED_CHAIN.read_text())
    theirs = [harmonic(reference["time"], reference[end]) for end in ("fairlead", "anchor")]
    ours = [harmonic(run["time"], run[f"chain.tension_{end}"] / 1e3) for end in ("from", "to")]
    lags = [np.degrees(np.angle(anchor[0] / fairlead[0])) for fairlead, anchor in (ours, theirs)]
    v.close("grounded chain: phase of the anchor to the fairlead [deg]", lags[0], lags[1], 15)
    v.close("grounded chain: range of the anchor [kN]", ours[1][1], theirs[1][1], 0.25 * theirs[1][1])
    v.check("grounded chain: rejected steps", run.counted("rejected_steps"), 0)


# A block rests on a hard bed as a sphere.  What pulls it to the side makes it travel by 0.7 % of its diameter per mu N.
MU, MASS, RADIUS, HARD = 0.5, 100.0, 0.5, 1e6
WEIGHT = MASS * GRAVITY
SINK = WEIGHT / (HARD * np.pi * RADIUS**2)
TRAVEL = MU * 0.007 * 2 * RADIUS


def block(end, step, interval, **keys):
    """A scene needs a cable: a slack thread without weight."""
    thread = {"mass_per_length": 1e-12, "diameter": 1e-9, "axial_stiffness": 1.0, "tension_only": True}
    points = {"pin": fixed(0, 0, 10),
              "block": {"position": [0, 0, RADIUS - SINK], "mass": MASS, "contact_radius": RADIUS, **keys}}
    made = scene(thread, points, {"from": "pin", "to": "block", "length": 1e4, "elements": 1}, end, step, interval,
                 ["block"], GRAVITY, True)
    made["environment"]["seabed"] = {"level": 0, "stiffness": HARD, "damping": HARD / 10, "friction": MU}
    return made


def check_held_block(v):
    """A pull below mu N that grows smoothly in 20 s stretches the spring.  The spring's vibration that is left is some
    1e-5 of its stretch."""
    share, grow = 0.9, 20
    size = f"{share * MU * WEIGHT}*(1 - step({grow} - t)*(0.5 + 0.5*cos(pi*t/{grow})))"
    run = v.run(block(120, 0.02, 0.5, force={"expression": {"x": f"0.6*{size}", "y": f"0.8*{size}", "z": "0"}}))
    held = run["time"] >= grow
    for axis, part in (("x", 0.6), ("y", 0.8)):
        v.check(f"held block, {axis}: travel from what the springs give [m]",
                np.abs(run[f"block.{axis}"][held] - part * share * TRAVEL).max(), 1e-6)
    v.check("held block: balance over what moved", np.abs(run["energy.balance"]).max() / run["energy.work"].max(), 1e-9)


def check_pulled_block(v):
    """A pull above mu N accelerates the block by what friction leaves."""
    pull, rows = 1.2 * MU * WEIGHT, slice(10, None)
    run = v.run(block(2, 0.01, 0.1, force=[pull, 0, 0]))
    gained = (run["block.vx"] - run["block.vx"][10])[rows]
    exact = (pull - MU * WEIGHT) / MASS * (run["time"] - run["time"][10])[rows]
    v.check("pulled block: speed gained after 1 s [m/s]", np.abs(gained - exact).max(), 1e-9)
    v.check("pulled block: balance over the work", np.abs(run["energy.balance"]).max() / run["energy.work"].max(), 1e-9)


def check_thrown_block(v):
    """It stops after v^2/(2 mu g), and by up to half the spring's travel later where steps are so short that they see
    friction grow.  A step takes away up to mu g h of the speed, so that a wrong step leads astray by mu g h^2.
    What goes farther in a step than its spring's travel loses mu N times its way, springs and all."""
    speed, step = 5.0, 0.01
    way = speed**2 / (2 * MU * GRAVITY)
    run = v.run(block(4, step, 0, velocity=[0.6 * speed, 0.8 * speed, 0]))
    x = np.hypot(run["block.x"], run["block.y"])
    v.close("thrown block: way [m]", x.max(), way + TRAVEL / 4, TRAVEL / 4 + MU * GRAVITY * step**2)
    v.check("thrown block: off its line [m]", np.abs(0.8 * run["block.x"] - 0.6 * run["block.y"]).max(), 1e-9)
    sliding = run["time"] < 0.9 * speed / (MU * GRAVITY)
    v.check("thrown block: bed's energy less mu N times the way, over all",
            np.abs(run["energy.bed"] - MU * WEIGHT * x)[sliding].max() / (0.5 * MASS * speed**2), 1e-9)
    v.check("thrown block: balance over the energy",
            np.abs(run["energy.balance"]).max() / (0.5 * MASS * speed**2), 1e-9)
    stopped = run["time"] > 1.1 * speed / (MU * GRAVITY)
    v.check("thrown block: way after it stopped, over twice the travel", np.ptp(x[stopped]) / (2 * TRAVEL), 1)


def check_ranks(v):
    """The grips of springs are laid by elements that other ranks have, and move with those of this one."""
    made = pulled_chain(10)
    made["initial"] = "static"
    made["points"]["end"]["position"] = [99, 0, -98]
    made["points"]["end"]["motion"] = {"harmonic": {"amplitude": [0.5, 0, 0.5], "period": 5}}
    del made["points"]["end"]["force"]
    runs = []
    for v.ranks in (None, 3):
        runs.append(v.run(made))
    v.ranks = None
    for name in ("cable.tension_from", "cable.tension_to"):
        apart = np.abs(runs[1][name] - runs[0][name]).max() / np.abs(runs[0][name]).max()
        v.check(f"one rank and three: {name}", apart, 1e-6)


def main():
    verification = Verification(__doc__)
    check_lines(verification)
    check_holding(verification)
    check_held_chain(verification)
    check_grounded_chain(verification)
    check_held_block(verification)
    check_pulled_block(verification)
    check_thrown_block(verification)
    check_ranks(verification)
    verification.finish()


if __name__ == "__main__":
    main()
