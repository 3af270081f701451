"""Tow points turn, circle, heave or change speed after `initial: static`.  The static start moves with them, so that
nothing happens before they do.  A tow that has become steady again is the static one."""
import re

import numpy as np

from support import Verification, scene

SPEED = 2.0
ROPE = {"diameter": 0.02, "mass_per_length": 0.6, "axial_stiffness": 1e6, "normal_drag": 1.2, "tangential_drag": 0.01,
        "added_mass": 1.0}
SLED = {"position": [-70, 0, -70], "mass": 80, "volume": 0.03, "drag_area": 0.2}
Q = "(t - 20)/40"


def law(x, y="0", z="0"):
    return {"position": [0, 0, 0], "motion": {"expression": {"x": x, "y": y, "z": z}}}


# The tow point moves at 2 m/s until 20 s, and at 3 m/s from 60 s on.
FASTER = law(f"2*t + 40*(({Q})^6 - 3*({Q})^5 + 2.5*({Q})^4)*(step(t - 20) - step(t - 60)) + (t - 40)*step(t - 60)")
# The tow point moves in a circle of 60 m radius to the left from 20 s on.
CIRCLE = law("2*t + (60*sin((t - 20)/30) - 2*(t - 20))*step(t - 20)", "60*(1 - cos((t - 20)/30))*step(t - 20)")


def u_turn():
    """Waypoints every 10 s.  The tow point goes ahead for 120 s, in half a circle of 60 m radius, and back."""
    points = []
    for t in range(0, 401, 10):
        angle = min(max((t - 120) / 30, 0), np.pi)
        ahead = SPEED * min(t, 120) - SPEED * max(t - 120 - 30 * np.pi, 0)
        points.append([t, ahead + 60 * np.sin(angle), 60 * (1 - np.cos(angle)), 0])
    return {"motion": {"waypoints": points}}


def tow(v, ship, end, **more):
    """Runs a tow.  @param more  further tow points, each of which gets a cable and a sled of its own"""
    points = {"ship": ship, "sled": SLED}
    cables = {"cable": {"from": "ship", "to": "sled", "length": 100, "elements": 20}}
    for name, point in more.items():
        points |= {name: point, f"{name}_sled": SLED}
        cables[f"{name}_cable"] = {"from": name, "to": f"{name}_sled", "length": 100, "elements": 20}
    towed = scene(ROPE, points, cables, end, 0.25, 0.5, ["ship", "sled", "cable"], adaptive={"tolerance": 1e-3})
    towed["environment"]["fluid"] = {"density": 1025, "surface": 0}
    return v.run(towed | {"initial": "static"})


def frame(run):
    return np.array([float(word) for word in re.search(r"frame_velocity: \[(.*)\]", run.report)[1].split(",")])


def check_still(v, name, run, until, limit):
    """Seen from the tow point, nothing happens before `until`."""
    before = run["time"] <= until
    tension = run["cable.tension_from"][before]
    place = (run.vectors("sled") - run.vectors("ship"))[before]
    v.check(f"{name}: change of tension before {until} s, over tension", np.ptp(tension) / tension[0], limit)
    v.check(f"{name}: change of place before {until} s, over length", np.ptp(place, axis=0).max() / 100, limit)


def check_end(v, name, run, steady, limit):
    v.close(f"{name}: tension at the end over that of a steady tow",
            run["cable.tension_from"][-1] / steady["cable.tension_from"][0], 1, limit)
    v.close(f"{name}: depth at the end over that of a steady tow", run["sled.z"][-1] / steady["sled.z"][0], 1, limit)


def check_paths(v):
    slow, fast = (tow(v, law(f"{speed}*t"), 20) for speed in (SPEED, 3))
    check_still(v, "straight", slow, 20, 1e-8)
    faster, circle, turn = tow(v, FASTER, 400), tow(v, CIRCLE, 400), tow(v, u_turn(), 400)
    check_still(v, "change of speed", faster, 20, 1e-8)
    check_end(v, "change of speed", faster, fast, 1e-4)
    check_still(v, "circle", circle, 20, 1e-8)
    inside = 1 - np.hypot(circle["sled.x"] - 40, circle["sled.y"] - 60)[-1] / 60
    v.at_least("circle: the sled is inside the tow point's circle by this part of its radius", inside, 0.1)
    v.check("circle: change of depth in the last 50 s, over length", np.ptp(circle["sled.z"][-100:]) / 100, 1e-3)
    check_still(v, "U-turn by waypoints", turn, 20, 1e-3)
    check_end(v, "U-turn by waypoints", turn, slow, 4e-3)   # the limit is wide because the depth still settles


def check_frames(v):
    """The static start moves with the velocity that the tow points have in common."""
    aside = {"position": [0, 40, 0], "motion": {"velocity": [2.02, 0, 0]}}
    for name, run, expected in (
            ("heave", tow(v, law("2*t", z="0.5*sin(0.9*t)"), 100), [2, 0, 0]),
            ("surge", tow(v, law("2*t + 0.2*sin(0.9*t)"), 100), [2, 0, 0]),
            ("circle from the start", tow(v, law("60*sin(t/30)", "60*(1 - cos(t/30))"), 100), [2, 0, 0]),
            ("start from rest", tow(v, law("0.05*t^2"), 20), [0, 0, 0]),
            ("two speeds 1 % apart", tow(v, law("2*t"), 20, aside=aside), [2.01, 0, 0]),
            ("one towed, one held", tow(v, law("2*t"), 20, aside={"position": [0, 40, 0], "motion": "fixed"}), [0, 0, 0])):
        v.check(f"{name}: frame {frame(run)} off {expected} [m/s]", np.abs(frame(run) - expected).max(), 0.1)


def main():
    verification = Verification(__doc__)
    check_paths(verification)
    check_frames(verification)
    verification.finish()


if __name__ == "__main__":
    main()
