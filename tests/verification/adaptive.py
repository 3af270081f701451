"""Adaptive steps meet their tolerance: eight motions at 1e-3, 1e-4 and 1e-5 m against references of their own.

The largest error of a motion may be ten times the tolerance for each of its periods.  Where a body turns, the angle by
which its attitude is off, times its reach, counts as a position's error does.  The references are closed forms, or the
equations of motion of the same elements, integrated here by extrapolation.  The line in water has no such reference: it
is held against the program's own fixed steps, 40 of which go into the shortest period of its adaptive ones.
"""
import math

import numpy as np

from support import HELD, Verification, scene

GRAVITY = 9.81
TOLERANCES = (1e-3, 1e-4, 1e-5)


# ---------------------------------------------------------------------------------------------- integration
def midpoint(rate, y, span, n):
    """Gragg's modified midpoint rule: y after `span`, in n steps.  Its error is a series in (span/n)^2."""
    h = span / n
    before, now = y, y + h * rate(y)
    for _ in range(n - 1):
        before, now = now, before + 2 * h * rate(now)
    return (before + now + h * rate(now)) / 2


def advance(rate, y, span):
    """y after `span`, by extrapolation of the modified midpoint rule to order 10."""
    counts = (2, 4, 6, 8, 10)
    row = []
    for i, n in enumerate(counts):
        new = [midpoint(rate, y, span, n)]
        for k in range(1, i + 1):
            new.append(new[-1] + (new[-1] - row[k - 1]) / ((n / counts[i - k])**2 - 1))
        row = new
    return row[-1]


def integrate(rate, y, times, longest):
    """y at each of the times, which start with that of the given y."""
    result = [np.array(y, float)]
    for a, b in zip(times[:-1], times[1:]):
        n = max(1, math.ceil((b - a) / longest - 1e-9))
        y = result[-1]
        for _ in range(n):
            y = advance(rate, y, (b - a) / n)
        result.append(y)
    return np.array(result)


# ---------------------------------------------------------------------------------------------- references
def bouncing(times, top, slack, stiffness, mass, weight):
    """Height of a mass that falls from `top`, is caught by a rope at -slack and flies up again, over and over."""
    g, w = weight / mass, math.sqrt(stiffness / mass)
    drop = top + slack
    fall, speed, sag = math.sqrt(2 * drop / g), math.sqrt(2 * g * drop), g / w**2
    caught = 2 * (math.pi - math.atan2(speed, w * sag)) / w
    cycle = 2 * fall + caught
    t = np.mod(times, cycle)
    s, flight = t - fall, t - cycle
    taut = -slack - sag * (1 - np.cos(w * s)) - speed / w * np.sin(w * s)
    return np.where(t < fall, top - g / 2 * t**2, np.where(s < caught, taut, top - g / 2 * flight**2)), cycle


def chain_rate(n, length, stiffness, per_length, tip_mass, gravity):
    """Of nodes that hang one below the other from the origin: y = (positions, velocities) of all but the first."""
    element = length / n
    mass = np.zeros((n + 1, n + 1))
    weight = np.zeros((n + 1, 1))
    for i in range(n):
        mass[i:i + 2, i:i + 2] += per_length * element / 6 * np.array([[2, 1], [1, 2]])
        weight[i:i + 2] += per_length * element / 2
    mass[n, n] += tip_mass
    weight[n] += tip_mass
    inverse, load = np.linalg.inv(mass[1:, 1:]), weight[1:] * np.array([0, 0, -gravity])

    def rate(y):
        x, v = y.reshape(2, n, 3)
        chord = np.diff(x, axis=0, prepend=np.zeros((1, 3)))
        size = np.sqrt((chord * chord).sum(axis=1, keepdims=True))
        pull = stiffness * (1 / element - 1 / size) * chord
        force = load - pull
        force[:-1] += pull[1:]
        return np.concatenate([v.ravel(), (inverse @ force).ravel()])

    return rate


def product(p, q):
    return np.concatenate([[p[0] * q[0] - p[1:] @ q[1:]], p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])])


def matrix(q):
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def body_rate(mass, inertia, attachment, length, stiffness, gravity):
    """Of a body on a massless rope from the origin: y = (X, X', q, w), w in body axes.  No rope where stiffness is 0."""
    inertia, attachment = np.array(inertia), np.array(attachment)

    def rate(y):
        X, V, q, w = y[:3], y[3:6], y[6:10], y[10:]
        R = matrix(q)
        end = X + R @ attachment
        pull = stiffness * (1 / length - 1 / np.linalg.norm(end)) * end if stiffness else np.zeros(3)
        torque = np.cross(attachment, -(R.T @ pull))
        dw = (torque - np.cross(w, inertia * w)) / inertia
        return np.concatenate([V, np.array([0, 0, -gravity]) - pull / mass, product(q, np.append(0, w)) / 2, dw])

    return rate


def apart(q, p):
    """The angles between attitudes, rows of quaternions.  [rad]"""
    cosine = np.abs((q * p).sum(axis=1)) / np.linalg.norm(q, axis=1) / np.linalg.norm(p, axis=1)
    sine = np.sqrt(np.maximum(0, 1 - cosine**2))
    return 2 * np.arctan2(sine, cosine)


# ---------------------------------------------------------------------------------------------- the eight motions
class Motion:
    """A scene without adaptive steps, what it should do, and how many periods it has.

    @param off  of a run: its errors, one a row [m]
    """

    def __init__(self, name, made, periods, off):
        self.name, self.made, self.periods, self.off = name, made, periods, off

    def scene(self, tolerance):
        return {**self.made, "time": {**self.made["time"], "adaptive": {"tolerance": tolerance}}}


def rows(end, interval):
    return interval * np.arange(round(end / interval) + 1)


def height_motion(name, rope, mass, top, length, end, interval):
    """A mass above or beside a slack rope of one element."""
    per_length, stiffness = rope["mass_per_length"], rope["axial_stiffness"]
    points = {"pin": HELD, "load": {"position": [0, 0, top], "mass": mass}}
    made = scene({**rope, "tension_only": True}, points, {"from": "pin", "to": "load", "elements": 1, "length": length}, end,
                 0.005, interval, ["load"])
    # Half of the element's weight is the load's, and a third of its mass.
    exact, cycle = bouncing(rows(end, interval), top, length, stiffness / length, mass + per_length * length / 3,
                            (mass + per_length * length / 2) * GRAVITY)
    return Motion(name, made, end / cycle, lambda run: np.abs(run["load.z"] - exact))


def bungee():
    return height_motion("a load that bounces on a slack rope", {"mass_per_length": 0.05, "axial_stiffness": 1e5}, 10, -1, 5,
                         8, 0.1)


def snap():
    return height_motion("a mass that snaps a rope without mass taut", {"mass_per_length": 1e-12, "axial_stiffness": 200},
                         0.5, -0.2, 1, 5, 0.05)


def chain_motion(name, rope, nodes, velocity, length, tip_mass, end, interval, period, gravity=GRAVITY):
    """A chain from the origin, drawn at `nodes`.  Its free end is watched."""
    nodes, elements = np.array(nodes, float), len(nodes) - 1
    velocities = np.linspace([0, 0, 0], velocity, elements + 1)
    points = {"pin": HELD, "tip": {"position": nodes[-1].tolist(), "velocity": list(velocity), "mass": tip_mass}}
    cable = {"from": "pin", "to": "tip", "elements": elements, "length": length, "shape": nodes.tolist()}
    made = scene(rope, points, cable, end, 0.005, interval, ["tip"], gravity)
    rate = chain_rate(elements, length, rope["axial_stiffness"], rope["mass_per_length"], tip_mass, gravity)
    fastest = math.sqrt(12 * rope["axial_stiffness"] / rope["mass_per_length"]) * elements / length
    start = np.concatenate([nodes[1:].ravel(), velocities[1:].ravel()])
    exact = integrate(rate, start, rows(end, interval), 3 / fastest)[:, 3 * elements - 3:3 * elements]
    return Motion(name, made, end / period, lambda run: np.linalg.norm(run.vectors("tip") - exact, axis=1))


def conical():
    """It is released without tension, so that it bounces more than it goes round."""
    stiffness, length, mass, s = 60, 1.5, 0.12, 1.5 / math.sqrt(2)
    rope = {"mass_per_length": 0.0132, "axial_stiffness": stiffness}
    return chain_motion("a soft conical pendulum", rope, [[0, 0, 0], [0, s / 2, -s / 2], [0, s, -s]], (3.0, 0, 0), length,
                        mass, 5, 0.05, 2 * math.pi * math.sqrt(mass * length / stiffness))


def stiff():
    rope, length, speed = {"mass_per_length": 6.57, "axial_stiffness": 3.0443e6}, 3.0443, 7.72
    return chain_motion("a stiff pendulum", rope, [[0, 0, 0], [0, 0, -length]], (speed, 0, 0), length, 0, 20, 0.1,
                        2 * math.pi * length / speed, gravity=0)


def chain():
    """It is released at rest from a straight line at 40 degrees, stretched as its weight stretches it there."""
    angle, elements, length = math.radians(40), 6, 3
    rope = {"mass_per_length": 0.5, "axial_stiffness": 1000}
    below = (elements - 0.5 - np.arange(elements)) * rope["mass_per_length"] * length / elements
    stretched = length / elements * (1 + below * GRAVITY * math.cos(angle) / rope["axial_stiffness"])
    way = np.concatenate([[0], np.cumsum(stretched)])
    nodes = np.outer(way, [math.sin(angle), 0, -math.cos(angle)])
    # The slowest period of a hanging chain.
    return chain_motion("a hanging chain that swings", rope, nodes, (0, 0, 0), length, 0, 6, 0.1,
                        2 * math.pi / 1.2024 * math.sqrt(length / GRAVITY))


def body_motion(name, body, rope_length, stiffness, end, interval, periods, gravity, rotation):
    """A body, at the end of a rope without mass where `stiffness` is not 0."""
    arm = body["attachments"]["eye"]
    reach = max(np.linalg.norm(arm), math.sqrt(max(body["inertia"]) / body["mass"]))
    made = {"environment": {"gravity": gravity}, "bodies": {"body": {**body, "rotation": rotation}},
            "time": {"end": end, "step": 0.005}, "output": {"interval": interval, "history": ["body"]}}
    if stiffness:
        made["cable_types"] = {"rope": {"mass_per_length": 1e-9, "axial_stiffness": stiffness}}
        made["points"] = {"pin": HELD}
        made["cables"] = {"rope": {"type": "rope", "from": "pin", "to": "body.eye", "elements": 1, "length": rope_length}}
    y = np.concatenate([body["position"], np.zeros(3), [1, 0, 0, 0], body["angular_velocity"]])
    exact = integrate(body_rate(body["mass"], body["inertia"], arm, rope_length, stiffness, gravity), y, rows(end, interval),
                      0.005)

    def off(run):
        attitude = np.column_stack([run[f"body.q{axis}"] for axis in "wxyz"])
        place = np.linalg.norm(run.vectors("body") - exact[:, :3], axis=1)
        return np.maximum(place, reach * apart(attitude, exact[:, 6:10]))

    return Motion(f"{name}, {rotation}", made, periods, off)


def spinning(rotation="quaternion"):
    body = {"mass": 1, "inertia": [1.0, 2.0, 2.5], "position": [0, 0, 0], "angular_velocity": [100, 2, 1],
            "attachments": {"eye": [0, 0, 0]}}
    return body_motion("a free body at 100 rad/s", body, 1, 0, 2, 0.1, 2 * 100 / (2 * math.pi), 0, rotation)


def hung(rotation="quaternion"):
    """It hangs at rest, is given a turn, and swings about its eye."""
    stiffness, length, mass = 1e5, 3, 20
    height = -length * (1 + mass * GRAVITY / stiffness) - 0.3
    body = {"mass": mass, "inertia": [1.0, 3.0, 3.5], "position": [0, 0, height], "angular_velocity": [0.3, 2, 0.2],
            "attachments": {"eye": [0, 0, 0.3]}}
    return body_motion("a body pendulum on a rope", body, length, stiffness, 6, 0.1,
                       6 / (2 * math.pi * math.sqrt(3.0 / (mass * GRAVITY * 0.3))), GRAVITY, rotation)


def towed(verification):
    """A line in water whose top is moved to and fro.  The reference is a run at fixed steps of 2 ms."""
    end, period = 24, 6
    rope = {"mass_per_length": 1.0, "axial_stiffness": 2e4, "diameter": 0.03, "normal_drag": 1.2, "tangential_drag": 0.02,
            "added_mass": 1.0}
    motion = {"harmonic": {"amplitude": [1.5, 0, 0.3], "period": period}}
    points = {"top": {"position": [0, 0, 0], "motion": motion}, "tip": {"position": [0, 0, -20], "mass": 5}}
    made = scene(rope, points, {"from": "top", "to": "tip", "elements": 10}, end, 0.002, 0.5, ["tip"])
    made["environment"]["fluid"] = {"density": 1025, "current": {"velocity": [0.3, 0.1, 0]}}
    exact = verification.run(made).vectors("tip")
    made["time"]["step"] = 0.05
    return Motion("a line in water with a moved top", made, end / period,
                  lambda run: np.linalg.norm(run.vectors("tip") - exact, axis=1))


def check(verification, motion):
    for tolerance in TOLERANCES:
        run = verification.run(motion.scene(tolerance))
        worst = np.nanmax(motion.off(run)) if np.isfinite(run["time"]).all() else np.nan
        verification.check(f"{motion.name}, tolerance {tolerance:g} m, {run.counted('steps')} steps: largest error [m]", worst,
                           10 * tolerance * motion.periods)


def main():
    verification = Verification(__doc__.splitlines()[0])
    for motion in (bungee(), conical(), stiff(), snap(), spinning(), hung(), chain(), towed(verification)):
        check(verification, motion)
    verification.finish()


if __name__ == "__main__":
    main()
