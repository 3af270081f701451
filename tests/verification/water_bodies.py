"""Bodies and points in water are compared with closed forms, one effect at a time."""
import numpy as np

from attitude import Turning, about, angle_between, product, turned
from support import Verification, body_scene, orders

RHO, GRAVITY = 1025.0, 9.81
SCHEMES = {"no scheme named": {}, "generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}
TURNED = product(about([1, 2, -3], 1.1), about([0, 1, 0], 0.4))   # pitch and roll are far from singular
KINDS = {"quaternion": {"inertia": [0.4, 0.5, 0.6]}, "euler": {"inertia": [0.4, 0.5, 0.6], "rotation": "euler"},
         "point_mass": {}}


def wet(scene, gravity=GRAVITY, **keys):
    scene["environment"] = {"gravity": gravity, "fluid": {"density": RHO, **keys}}
    return scene


def kinds(**keys):
    return {name: {"mass": 20.0, "position": [0, 0, 0], "orientation": {"quaternion": TURNED.tolist()}, **kind, **keys}
            for name, kind in KINDS.items()}


def in_body_axes(vectors):
    return turned(TURNED * [1, -1, -1, -1], vectors)


def check_added_mass(v):
    """A constant force moves mass and added mass, axis by axis of the body."""
    added, force = np.array([5.0, 20.0, 60.0]), np.array([30.0, -20.0, 50.0])
    exact = turned(TURNED, in_body_axes(force) / (20.0 + added))
    for name, keys in SCHEMES.items():
        bodies = kinds(force=force.tolist(), added_mass=[*added, 0.1, 0.2, 0.3])
        run = v.run(wet(body_scene(bodies, 1, 0.02, 0.1, **keys), 0))
        t = run["time"][:, None]
        for body in bodies:
            what = f"added mass, {name}, {body}"
            v.check(f"{what}: first acceleration [m/s2]", np.abs(run.vectors(body, "a")[0] - exact).max(), 1e-11)
            v.check(f"{what}: off the parabola [m]", np.abs(run.vectors(body) - exact * t**2 / 2).max(), 1e-10)
            v.check(f"{what}: turn [rad]", angle_between(TURNED, Turning(run, body).q).max(), 1e-9)


def check_added_inertia(v):
    """A top with inertia and added inertia turns as one that has their sum in a vacuum."""
    top = {"mass": 1.0, "position": [0, 0, 0], "angular_velocity": [0.3, 6, 0.2]}
    for name, keys in SCHEMES.items():
        off = []
        for step in (4e-3, 2e-3):
            sums = body_scene({"top": {**top, "inertia": [0.015, 0.024, 0.035]}}, 2, step / 4, 0.1, **keys)
            parts = body_scene({"top": {**top, "inertia": [0.01, 0.02, 0.025],
                                        "added_mass": [1, 2, 3, 0.005, 0.004, 0.01]}}, 2, step, 0.1, **keys)
            run = v.run(wet(parts))
            dry, inside = Turning(v.run(sums), "top"), Turning(run, "top")
            off.append(angle_between(dry.q, inside.q).max())
        v.check(f"added inertia, {name}: attitude off the heavier top's [rad]", off[1], 1e-3)
        falling, spinning = (run.vectors("top", "v")**2).sum(axis=1) / 2, inside.energy(np.diag([0.01, 0.02, 0.025]))
        own = np.abs(run["energy.kinetic"] - falling - spinning)
        v.check(f"added inertia, {name}: energy.kinetic off the top's own [J]", own.max(), 1e-12)
        v.at_least(f"added inertia, {name}: order in the time step", orders(off)[0], 1.9)


def check_linear_drag(v):
    """With linear drag the speed decays, or under a force tends to a terminal one, and the spin about each axis
    decays."""
    linear, start = np.array([30.0, 60.0, 90.0]), np.array([0.5, -0.4, 0.3])
    force, current = np.array([20.0, 30.0, -10.0]), np.array([0.2, -0.1, 0.3])
    rate = linear / 20.0
    for name, keys in SCHEMES.items():
        off = []
        for step in (0.02, 0.01):
            bodies = kinds(force=force.tolist(), velocity=start.tolist(), drag={"linear": [*linear, 0, 0, 0]})
            run = v.run(wet(body_scene(bodies, 5, step, 0.1, **keys), 0, current={"velocity": current.tolist()}))
            last = in_body_axes(force) / linear
            relative = last + (in_body_axes(start - current) - last) * np.exp(-rate * run["time"][:, None])
            exact = current + turned(TURNED, relative)
            off.append([np.abs(run.vectors(body, "v") - exact).max() for body in bodies])
        for body, errors in zip(bodies, zip(*off)):
            v.check(f"linear drag, {name}, {body}: velocity [m/s]", errors[1], 1e-4)
            v.at_least(f"linear drag, {name}, {body}: order", orders(errors)[0], 1.9)
            v.check(f"linear drag, {name}, {body}: terminal velocity [m/s]",
                    np.abs(run.vectors(body, "v")[-1] - current - turned(TURNED, last)).max(), 1e-3)


def check_quadratic_drag(v):
    """With quadratic drag the speed along each axis is v0/(1 + k v0 t), where k includes added mass."""
    quadratic, added, start = np.array([30.0, 60.0, 90.0]), np.array([5.0, 10.0, 20.0]), np.array([0.9, -1.4, 1.1])
    v0 = in_body_axes(start)
    for name, keys in SCHEMES.items():
        off = []
        for step in (0.02, 0.01):
            bodies = kinds(velocity=start.tolist(), drag={"quadratic": [*quadratic, 0, 0, 0]},
                           added_mass=[*added, 0, 0, 0])
            run = v.run(wet(body_scene(bodies, 2, step, 0.1, **keys), 0))
            k = quadratic / (20.0 + added) * np.abs(v0)
            exact = turned(TURNED, v0 / (1 + k * run["time"][:, None]))
            off.append([np.abs(run.vectors(body, "v") - exact).max() for body in bodies])
        for body, errors in zip(bodies, zip(*off)):
            v.check(f"quadratic drag, {name}, {body}: velocity [m/s]", errors[1], 5e-4)
            v.at_least(f"quadratic drag, {name}, {body}: order", orders(errors)[0], 1.8)


def check_spin_drag(v):
    """Rotational drag acts about each principal axis, each tested on its own body.  A current does not turn a body."""
    inertia, added, spin = [0.4, 0.5, 0.6], [0.1, 0.2, 0.3], 2.0
    for rotation in ("quaternion", "euler"):
        for axis in range(3):
            still = {"mass": 3.0, "inertia": inertia, "rotation": rotation,
                     "angular_velocity": (spin * np.eye(3)[axis]).tolist()}
            if rotation == "euler" and axis == 1:
                still["angular_velocity"] = [0, 0.8, 0]   # the whole turn stays below 90 degrees
            moments = np.add(inertia, added)[axis]
            bodies = {"slow": {**still, "position": [0, 0, 0], "added_mass": [0, 0, 0, *added],
                               "drag": {"linear": [0, 0, 0, 0.8, 0.9, 1.0]}},
                      "square": {**still, "position": [9, 0, 0], "added_mass": [0, 0, 0, *added],
                                 "drag": {"quadratic": [0, 0, 0, 0.8, 0.9, 1.0]}}}
            run = v.run(wet(body_scene(bodies, 2, 0.01, 0.1), 0, current={"velocity": [1, 2, 3]}))
            w0, t, c = still["angular_velocity"][axis], run["time"], 0.8 + 0.1 * axis
            exact = {"slow": w0 * np.exp(-c / moments * t), "square": w0 / (1 + c / moments * w0 * t)}
            for body, w in exact.items():
                found = Turning(run, body).w
                v.check(f"spin about {'xyz'[axis]}, {rotation}, {body} drag: rate [rad/s]",
                        np.abs(found[:, axis] - w).max(), 3e-4)
                v.check(f"spin about {'xyz'[axis]}, {rotation}, {body} drag: about other axes [rad/s]",
                        np.abs(np.delete(found, axis, 1)).max(), 1e-9)


def check_buoyancy(v):
    """A body rises with the acceleration (rho V - m) g over the sum of mass and added mass."""
    volume, added = 0.05, 30.0
    exact = [0, 0, (RHO * volume - 20.0) * GRAVITY / (20.0 + added)]
    bodies = kinds(volume=volume, added_mass=[added] * 3 + [0, 0, 0])
    run = v.run(wet(body_scene(bodies, 1, 0.02, 0.1)))
    for body in bodies:
        v.check(f"buoyancy, {body}: acceleration [m/s2]", np.abs(run.vectors(body, "a") - exact).max(), 1e-9)
    for body in ("quaternion", "euler"):
        v.check(f"buoyancy at the CG, {body}: turn [rad]", angle_between(TURNED, Turning(run, body).q).max(), 1e-9)


def check_righting(v):
    """A neutral body whose centre of buoyancy lies h above its centre of gravity swings about x and about y with the
    period 2 pi sqrt((I + Ia)/(rho V g h))."""
    mass, h, small = 50.0, 0.08, 0.5
    for rotation in ("quaternion", "euler"):
        for angle, axis, moment in (("roll", 0, 2.0 + 0.7), ("pitch", 1, 3.0 + 0.4)):
            body = {"mass": mass, "inertia": [2.0, 3.0, 4.0], "added_mass": [0, 0, 0, 0.7, 0.4, 0.1],
                    "volume": mass / RHO, "center_of_buoyancy": [0, 0, h], "position": [0, 0, 0],
                    "rotation": rotation, "orientation": {angle: small}}
            period = 2 * np.pi * np.sqrt(moment / (mass * GRAVITY * h))
            run = v.run(wet(body_scene({"float": body}, 2 * period, period / 400, period / 80)))
            turning, t = Turning(run, "float"), run["time"]
            found = 2 * np.degrees(turning.q[:, 1 + axis])
            what = f"righting, {rotation}, {angle}"
            v.check(f"{what}: angle [deg]", np.abs(found - small * np.cos(2 * np.pi / period * t)).max(), 2e-3)
            v.check(f"{what}: motion of the CG [m]", np.abs(run.vectors("float")).max(), 1e-9)


def cap_depth(part):
    """The depth of the middle of a sphere of radius 1 of which this part is wet."""
    s = max(np.roots([-2, 3, 0, -part]), key=lambda root: -abs(root - 0.5) - 9 * abs(np.imag(root)))
    return 2 * np.real(s) - 1


def check_draft(v):
    """In statics, a floating sphere on a thread that hardly pulls displaces a cap of water as heavy as the sphere."""
    for part in (0.2, 0.5, 0.85):
        volume = 0.1
        radius = (0.75 / np.pi * volume)**(1 / 3)
        body = {"mass": part * RHO * volume, "inertia": [1, 1, 1], "volume": volume, "position": [0.3, 0, 0.2],
                "center_of_buoyancy": [0, 0, 0.05], "attachments": {"eye": [0, 0, -0.2]}}
        scene = {"bodies": {"ball": body}, "points": {"anchor": {"position": [0, 0, -5], "motion": "fixed"}},
                 "cable_types": {"thread": {"mass_per_length": 1e-6, "axial_stiffness": 1e-3, "diameter": 1e-6}},
                 "cables": {"mooring": {"type": "thread", "from": "anchor", "to": "ball.eye", "length": 4,
                                        "elements": 1}},
                 "output": {"history": ["ball"]}}
        run = v.run(wet(scene, surface=0.5))
        v.check(f"draft, {part} wet: height of the sphere's middle, the centre of buoyancy [m]",
                abs(run["ball.z"][-1] + 0.05 - (0.5 - radius * cap_depth(part))), 1e-5)
        v.check(f"draft, {part} wet: tilt [rad]", abs(1 - abs(run["ball.qw"][-1])), 1e-9)


def points_scene(keys, end, step, **time_keys):
    """Two equal points side by side that a massless thread joins: each moves as one alone."""
    return {"environment": {"gravity": GRAVITY},
            "points": {"one": {"position": [0, 0, 0], **keys}, "other": {"position": [0, 1, 0], **keys}},
            "cable_types": {"thread": {"mass_per_length": 1e-9, "axial_stiffness": 10, "diameter": 1e-6}},
            "cables": {"thread": {"type": "thread", "from": "one", "to": "other", "elements": 1}},
            "time": {"end": end, "step": step, **time_keys}, "output": {"interval": 0.1, "history": ["one"]}}


def check_points(v):
    """A point with buoyancy, added mass and drag rises with a speed that grows as tanh."""
    mass, volume, added, area = 3.0, 0.005, 2.5, 0.08
    lift, drag = (RHO * volume - mass) * GRAVITY, RHO / 2 * area
    first, last = lift / (mass + added), np.sqrt(lift / drag)
    keys = {"mass": mass, "volume": volume, "added_mass": added, "drag_area": area}
    for name, time_keys in SCHEMES.items():
        off = []
        for step in (0.01, 0.005):
            run = v.run(wet(points_scene(keys, 1, step, **time_keys)))
            off.append(np.abs(run["one.vz"] - last * np.tanh(first / last * run["time"])).max())
        v.close(f"rising point, {name}: first acceleration [m/s2]", run["one.az"][0], first, 1e-7)
        v.check(f"rising point, {name}: velocity [m/s]", off[1], 1e-3)
        v.at_least(f"rising point, {name}: order", orders(off)[0], 1.9)


def check_start(v):
    """The first acceleration belongs to the waves of the time at which the run starts."""
    mass, volume, added, start = 3.0, 0.005, 40.0, 2.0
    keys = {"mass": mass, "volume": volume, "added_mass": added}
    scene = points_scene(keys, start + 0.01, 0.01)
    scene["time"]["start"] = start
    run = v.run(wet(scene, surface=0, depth=50, waves=[{"height": 0.4, "period": 8, "phase": 90}]))
    # At the start, theta = -pi/2 + pi/2 at the origin: a crest is 0.2 m above and the points are wet.  At t = 0 half of
    # them would be wet.
    water = np.array([0, 0, -0.2 * (2 * np.pi / 8)**2])
    force = RHO * volume * (water + [0, 0, GRAVITY]) - [0, 0, mass * GRAVITY] + added * water
    v.check("start among waves: first acceleration [m/s2]",
            np.abs(run.vectors("one", "a")[0] - force / (mass + added)).max(), 1e-6)


def main():
    verification = Verification(__doc__)
    for check in (check_added_mass, check_added_inertia, check_linear_drag, check_quadratic_drag, check_spin_drag,
                  check_buoyancy, check_righting, check_draft, check_points, check_start):
        check(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
