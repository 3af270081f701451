"""Cables in water and on a seabed, and points among waves, are compared with closed forms."""
import numpy as np

from support import Verification, orders, scene

RHO, GRAVITY = 1025.0, 9.81
SCHEMES = {"no scheme named": {}, "generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}
DIAMETER, MASS, ADDED, NORMAL, TANGENTIAL = 0.03, 1.6, 0.9, 1.2, 0.05
DISPLACED = RHO * np.pi / 4 * DIAMETER**2
CABLE = {"mass_per_length": MASS, "axial_stiffness": 1e5, "diameter": DIAMETER, "normal_drag": NORMAL,
         "tangential_drag": TANGENTIAL, "added_mass": ADDED}
BED = {"level": -5, "stiffness": 2e4}
DEPTH = (MASS - DISPLACED) * GRAVITY / (BED["stiffness"] * DIAMETER)   # by which the cable sinks into the bed


def surrounded(made, bed=None, **fluid):
    made["environment"] = {"gravity": GRAVITY, "fluid": {"density": RHO, **fluid}}
    if bed is not None:
        made["environment"]["seabed"] = bed
    return made


def laid(z, velocity=(0, 0, 0), direction=(1, 0)):
    """The two points at the ends of a free horizontal cable of 10 m."""
    x, y = direction
    return {"a": {"position": [0, 0, z], "velocity": list(velocity)},
            "b": {"position": [10 * x, 10 * y, z], "velocity": list(velocity)}}


def lengthwise(elements=6):
    return {"from": "a", "to": "b", "elements": elements}


def check_falling(v):
    """A horizontal cable falls with a speed that grows as tanh.  Added mass sets the first acceleration, and drag the
    final speed."""
    first = (MASS - DISPLACED) * GRAVITY / (MASS + DISPLACED * ADDED)
    last = np.sqrt((MASS - DISPLACED) * GRAVITY / (RHO / 2 * NORMAL * DIAMETER))
    for name, keys in SCHEMES.items():
        off = []
        for step in (0.02, 0.01):
            made = scene(CABLE, laid(0, direction=(0.6, 0.8)), lengthwise(), 1.0, step, 0.1, ["a", "b"], **keys)
            run = v.run(surrounded(made))
            exact = -last * np.tanh(first / last * run["time"])
            off.append(max(np.abs(run[f"{end}.vz"] - exact).max() for end in "ab"))
        v.close(f"falling cable, {name}: first acceleration [m/s2]", run["a.az"][0], -first, 1e-10)
        v.check(f"falling cable, {name}: velocity [m/s]", off[1], 1e-3)
        v.at_least(f"falling cable, {name}: order", orders(off)[0], 1.9)
        v.close(f"falling cable, {name}: velocity in the end [m/s]", run["b.vz"][-1], exact[-1], 1e-3)


def check_sliding(v):
    """A cable that moves along itself has no added mass, and no drag but the tangential one."""
    start, k = 2.0, RHO / 2 * TANGENTIAL * np.pi * DIAMETER / MASS
    made = scene(CABLE, laid(0, velocity=(start, 0, 0)), lengthwise(), 2, 0.01, 0.1, ["a"], gravity=0)
    run = v.run({**made, "environment": {"gravity": 0, "fluid": {"density": RHO}}})
    v.check("cable that slides in the water: velocity [m/s]",
            np.abs(run["a.vx"] - start / (1 + k * start * run["time"])).max(), 1e-4)


def check_lying(v):
    """A cable sinks into the bed until the bed carries its weight.  With damping it comes to rest there."""
    made = scene(CABLE, laid(BED["level"]), lengthwise(), 4, 0.01, 0.5, ["a", "b"])
    run = v.run(surrounded(made, {**BED, "damping": 3e3}))
    for end in "ab":
        v.check(f"cable on the bed, end {end}: depth over weight/(stiffness d)",
                abs((BED["level"] - run[f"{end}.z"][-1]) / DEPTH - 1), 1e-6)
    held = {"a": {"position": [0, 0, BED["level"] - DEPTH], "motion": "fixed"},
            "b": {"position": [10, 0, BED["level"] + 0.3], "force": [5, 0, 0]}}
    made = surrounded(scene(CABLE, held, lengthwise(), 1, 0.1, 0.1, ["b"]), BED)
    del made["time"]
    v.check("cable on the bed, statics: depth over weight/(stiffness d)",
            abs((BED["level"] - v.run(made)["b.z"][-1]) / DEPTH - 1), 1e-6)


def check_friction(v):
    """Friction on the bed slows a cable down by mu g', along itself and across.  Across, added mass moves with the
    cable."""
    mu, start, bare = 0.4, 3.0, {**CABLE, "normal_drag": 0, "tangential_drag": 0}
    weight = (MASS - DISPLACED) * GRAVITY
    for axis, mass in ((0, MASS), (1, MASS + ADDED * DISPLACED)):
        velocity = (start * np.eye(3)[axis]).tolist()
        slowing = mu * weight / mass
        end = 0.9 * start / slowing
        made = scene(bare, laid(BED["level"] - DEPTH, velocity), lengthwise(), end, end / 100, end / 20, ["a", "b"])
        run = v.run(surrounded(made, {**BED, "friction": mu, "friction_velocity": 1e-3}))
        for point in "ab":
            what = f"friction along {'xy'[axis]}, end {point}"
            v.check(f"{what}: velocity [m/s]",
                    np.abs(run[f"{point}.v{'xy'[axis]}"] - start + slowing * run["time"]).max(), 1e-5)
            v.check(f"{what}: depth over weight/(stiffness d)",
                    np.abs((BED["level"] - run[f"{point}.z"]) / DEPTH - 1).max(), 1e-6)


def check_profile(v):
    """The force of a current on a taut upright cable is the integral of its pressure."""
    points = {"a": {"position": [0, 0, -10], "motion": "fixed"}, "b": {"position": [0, 0, 0], "motion": "fixed"}}
    stiff = {**CABLE, "axial_stiffness": 1e9}
    made = scene(stiff, points, {**lengthwise(40), "length": 9.99}, 1, 0.1, 0.1, ["a", "b"])
    rows = [[-8, 0.5, 0, 0], [-3, 1.5, 0, 0], [-1, -0.5, 0, 0]]
    surrounded(made, current={"profile": rows})
    del made["time"]
    run = v.run(made)
    z = np.linspace(-10, 0, 200001)
    speed = np.interp(z, [row[0] for row in rows], [row[1] for row in rows])
    exact = np.trapezoid(speed * np.abs(speed), z) if hasattr(np, "trapezoid") else np.trapz(speed * np.abs(speed), z)
    exact *= RHO / 2 * NORMAL * DIAMETER * 9.99 / 10
    reaction = run["a.fx"][-1] + run["b.fx"][-1]
    v.check("current profile: force over the integral", abs(reaction / -exact - 1), 2e-3)


class Airy:
    """A wave's motion by its textbook formulas; k by bisection."""

    def __init__(self, height, period, depth, phase):
        self.a, self.omega, self.depth, self.phase = height / 2, 2 * np.pi / period, depth, np.radians(phase)
        low, high = 1e-6, 1e3
        for _ in range(200):
            self.k = (low + high) / 2
            if GRAVITY * self.k * np.tanh(min(self.k * depth, 50.0)) < self.omega**2:
                low = self.k
            else:
                high = self.k

    def angle(self, s, t):
        return self.k * s - self.omega * t + self.phase

    def elevation(self, s, t):
        return self.a * np.cos(self.angle(s, t))

    def orbit(self, s, z, t):
        """The velocity at a place, along the wave and upwards, and its time derivative there."""
        size, above = self.a * self.omega / np.sinh(self.k * self.depth), self.k * (z + self.depth)
        theta, ch, sh = self.angle(s, t), size * np.cosh(above), size * np.sinh(above)
        return (np.array([ch * np.cos(theta), sh * np.sin(theta)]),
                self.omega * np.array([ch * np.sin(theta), -sh * np.cos(theta)]))


def drift(wave, keys, state, end, parts):
    """The place and velocity (s, z, vs, vz) of a neutral point from `state` on, at parts + 1 times, by the Runge-Kutta
    method."""
    drag, mass = RHO / 2 * keys["drag_area"], keys["mass"] + keys["added_mass"]

    def rate(y, t):
        water, its_rate = wave.orbit(y[0], y[1], t)
        slip = water - y[2:]
        return np.array([*y[2:], *(its_rate + drag / mass * np.hypot(*slip) * slip)])

    states, fine = [np.array(state)], 20
    h = end / parts / fine
    for i in range(parts * fine):
        y, t = states[-1], i * h
        k1 = rate(y, t)
        k2 = rate(y + h / 2 * k1, t + h / 2)
        k3 = rate(y + h / 2 * k2, t + h / 2)
        states.append(y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3, t + h)))
    return np.array(states)[::fine]


def two_points(keys, places, velocity, end, step):
    """A scene of points that a thread joins.  The thread is too soft and too light to matter."""
    points = {name: {"position": place, "velocity": velocity, **keys} for name, place in places.items()}
    thread = {"mass_per_length": 1e-9, "axial_stiffness": 1e-6, "diameter": 1e-6}
    return scene(thread, points, {"from": "a", "to": "b", "elements": 1}, end, step, end / 60, list(places))


def check_orbit(v):
    """A neutral point moves with the water, in waves of any direction that feel the bottom."""
    wave, along, depth, level = Airy(1.0, 6.0, 8.0, 30), np.radians(25), 8.0, -2.5
    direction = np.array([np.cos(along), np.sin(along)])
    across = np.array([-direction[1], direction[0]])
    place = {"a": [*(3 * direction).tolist(), level], "b": [*(3 * direction + across).tolist(), level]}
    (u, w), _ = wave.orbit(3.0, level - 1.0, 0.0)
    keys = {"mass": RHO * 1e-3, "volume": 1e-3, "drag_area": 0.5, "added_mass": 0.5}
    exact = drift(wave, keys, [3.0, level - 1.0, u, w], 6.0, 60)
    off = []
    for step in (0.02, 0.01):
        made = two_points(keys, place, [*(u * direction).tolist(), float(w)], 6.0, step)
        run = v.run(surrounded(made, surface=1.0, depth=depth,
                               waves=[{"height": 1.0, "period": 6.0, "direction": 25, "phase": 30}]))
        x, moving = run.vectors("a"), run.vectors("a", "v")
        found = np.column_stack([x[:, :2] @ direction, x[:, 2] - 1.0, moving[:, :2] @ direction, moving[:, 2]])
        off.append(np.abs(found - exact).max())
    water, _ = wave.orbit(found[:, 0], found[:, 1], run["time"])
    v.check("orbit: off that of Runge and Kutta [m], [m/s]", off[1], 2e-5)
    v.at_least("orbit: order in the time step", orders(off)[0], 1.8)
    slip = np.abs(found[:, 2:] - water.T).max() / np.abs(water).max()
    v.check("orbit: velocity off the water's over that", slip, 0.03)
    v.check("orbit: velocity across the wave [m/s]", np.abs(moving[:, :2] @ across).max(), 1e-9)


def check_riding(v):
    """A light float rises and falls with long waves."""
    wave, volume = Airy(0.6, 10.0, 15.0, 0), 1e-3
    keys = {"mass": RHO * volume / 2, "volume": volume, "drag_area": 0.02}
    places = {"a": [0, 0, wave.elevation(0, 0)], "b": [0, 1, wave.elevation(0, 0)]}
    run = v.run(surrounded(two_points(keys, places, [0, 0, 0], 20.0, 0.02), surface=0, depth=15,
                           waves=[{"height": 0.6, "period": 10}]))
    surface = wave.elevation(run["a.x"], run["time"])
    v.check("float: off the surface [m]", np.abs(run["a.z"] - surface)[5:].max(), 0.01)


def check_equilibrium(v):
    """Statics leaves waves out, in the shape and in the forces that it reports."""
    fluid = {"density": RHO, "surface": 0, "depth": 60}
    line = {"mass_per_length": 2, "axial_stiffness": 1e4, "diameter": 0.02, "normal_drag": 1.2}
    ends = {name: {"position": [x, 0, -1], "motion": "fixed"} for name, x in (("a", 0), ("b", 4))}
    runs = []
    for waves in ({}, {"waves": [{"height": 1, "period": 5}]}):
        runs.append(v.run({
            "environment": {"fluid": {**fluid, **waves}}, "cable_types": {"line": line}, "points": ends,
            "cables": {"c": {"type": "line", "from": "a", "to": "b", "elements": 2, "length": 4.2, "shape": "catenary"}},
            "initial": "static", "output": {"history": ["a", "b", "c"]}}))
    calm, wavy = runs
    v.check("equilibrium: any column in waves off that in calm water",
            max(np.abs(wavy[name] - calm[name]).max() for name in calm.columns), 0)
    v.check("equilibrium: pull of the two ends along the line together [N]", abs(wavy["a.fx"] + wavy["b.fx"]).max(), 1e-9)


def main():
    verification = Verification(__doc__)
    for check in (check_falling, check_sliding, check_lying, check_friction, check_profile, check_orbit,
                  check_riding, check_equilibrium):
        check(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
