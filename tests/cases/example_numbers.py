"""Per example, by its folder's name: the numbers of its README, and what they are in its runs."""
import numpy as np

from example_claims import table


def span(values):
    return values.max() - values.min()


def drift(values):
    return np.abs(values - values[0]).max()


def near_row(c, what, label, values, share=0.0):
    """The first numbers of a table's row; None: not looked at."""
    numbers = c.row(label)
    assert len(numbers) >= len(values), f"the README's row {label} is too short"
    for number, value in zip(numbers, values):
        if value is not None:
            c.near(f"{what}, {label}", number, value, share)


def bergdahl_chain(c):
    run, samples = c.run(), 250
    top = run["chain.tension_to"]
    cycles = [top[samples * k:samples * (k + 1) + 1].max() for k in range(7, 12)]
    # Steps are retried where links touch down, as rounding has it.
    force, _, steps = c.says(r"\| 66 \| 2.5e-3 \| # \| # of # \|")
    c.near("largest force", force, np.mean(cycles), 1e-3)
    c.near("steps", steps, run.counted("steps"), 0.02)


def biomapper(c):
    for speed in ("0.514", "1.028", "2.056", "3.084", "4.112", "5.140"):
        changes = [("[3.084, 0, 0]", f"[{speed}, 0, 0]")]
        if speed == "5.140":
            changes.append(("[-900, 0, -400]", "[-970, 0, -190]"))
        run = c.run("steady.yaml", changes=changes)
        pull = [-run[f"ship.f{axis}"][0] for axis in "xz"]
        # At the sled half an element's loads less than in its last element.
        near_row(c, "steady tow", speed, [-run["sled.z"][0], -run["sled.x"][0], run["tow_cable.tension_from"][0],
                                          np.degrees(np.arctan2(-pull[1], -pull[0])), run["tow_cable.tension_to"][0]])
    run = c.run()
    after, before = run.between(2200), run.between(0, 2200)
    deepest, tight = after["sled.z"].argmin(), after["tow_cable.tension_from"].argmax()
    near_row(c, "circle", "depth at 2200 s [m]", [-after["sled.z"][0]], 1e-5)
    depth, when = c.says(r"largest depth \[m\] \| # at # s")
    c.near("largest depth", depth, -after["sled.z"][deepest], 1e-5)
    c.near("its time", when, after["time"][deepest])
    tension, when = c.says(r"largest tension from 2200 s on \[N\] \| # at # s")
    c.near("largest tension", tension, after["tow_cable.tension_from"][tight], 1e-5)
    c.near("its time", when, after["time"][tight])
    tension, when, rest, least = c.says("reaches # N at # s .# N at rest.; the least on the sled is # N")
    first = before["tow_cable.tension_from"].argmax()
    c.near("tension getting under way", tension, before["tow_cable.tension_from"][first], 1e-4)
    c.near("its time", when, before["time"][first])
    c.near("tension at rest", rest, before["tow_cable.tension_from"][0])
    c.near("least tension on the sled", least, run["tow_cable.tension_to"].min(), 1e-4)
    c.near("steps", c.says("# adaptive steps"), run.counted("steps"), 0.02)


def cable_body_pendulum(c):
    run, reference = c.run(), table(c.example / "reference.csv")
    x, z, vx, vz = (run[f"cube.{name}"] for name in ("x", "z", "vx", "vz"))
    square = x**2 + z**2
    run.columns["phi"] = np.arctan2(x, -z)
    run.columns["omega"] = (x * vz - z * vx) / square
    run.columns["alpha"] = ((x * run["cube.az"] - z * run["cube.ax"]) / square
                            - 2 * run["omega"] * (x * vx + z * vz) / square)
    for label, name in (("angle", "phi"), ("angular velocity", "omega"), ("angular acceleration", "alpha")):
        near_row(c, "off the references", label, [run.off(reference, name),
                                                  run.off(reference, name, column=f"simple.{name}")], 0.1)
    for i, name in enumerate(("x", "z")):
        off, simple = (c.says(r"\| X, Y \| # m, # m \| # m, # m \|")[k] for k in (i, i + 2))
        c.near(f"cube.{name} off rod and body", off, run.off(reference, f"cube.{name}"), 0.1)
        c.near(f"cube.{name} off the simple pendulum", simple,
               run.off(reference, f"cube.{name}", column=f"simple.{name}"))
    turn = np.flatnonzero((run["phi"][:-1] > 0) != (run["phi"][1:] > 0))
    t, phi = run["time"], run["phi"]
    crossings = t[turn] - phi[turn] * (t[turn + 1] - t[turn]) / (phi[turn + 1] - phi[turn])
    c.near("period", c.says("by 0.85 % .# s against"), 2 * np.diff(crossings).mean(), 1e-4)
    c.near("first acceleration", c.says("the first acceleration is # rad/s2"), abs(run["alpha"][0]), 1e-4)
    c.near("kinetic energy", c.says("the kinetic energy reaches # J"), run["energy.kinetic"].max())
    c.near("energy's fall", c.says("`energy.total` falls by # J"), run["energy.total"][0] - run["energy.total"][-1], 0.1)
    for label, scene in (("kinematic", "scene.yaml"), ("rigid_link", "link.yaml"), ("bar", "bar.yaml")):
        run = c.run(scene)
        run.columns["phi"] = np.arctan2(run["cube.x"], -run["cube.z"])
        turn = -2 * np.arctan2(run["cube.qy"], run["cube.qw"]) - run["phi"]
        near_row(c, "couplings", f"`{label}`", [run.off(reference, "phi"), np.degrees(np.abs(turn).max()),
                                                drift(run["energy.total"])], 0.1)


def conical_pendulum(c):
    run, reference = c.run(), table(c.example / "reference.csv")
    at = np.searchsorted(run["time"], reference["time"] - 1e-9)
    off = np.linalg.norm([run[f"mass.{axis}"][at] - reference[f"mass.{axis}"] for axis in "xyz"], axis=0)
    c.near("mass off the reference", c.says("the mass stays within # m of it"), off.max(), 0.1)
    energy, fall = c.says("the energy, # J, falls by less than # J")
    c.near("energy", energy, run["energy.total"][0])
    c.near("its fall", fall, drift(run["energy.total"]), 0.1)


def elastic_catenary(c):
    x, z, level, upward = c.says(r"the weight at .#, #. m, .* horizontal force of # N, a vertical one of # N")
    exact, scene = [float(number.replace(" ", "")) for number in (x, z, level)], c.run()
    for label, elements in (("25", 25), ("50", 50), ("100, the scene", 100), ("200", 200), ("400", 400), ("800", 800)):
        changes = [("elements: 40", f"elements: {elements * 2 // 5}"), ("elements: 60", f"elements: {elements * 3 // 5}")]
        run = c.run("scene.yaml", changes=changes) if elements != 100 else scene
        found = [run["load.x"][0], run["load.z"][0], abs(run["left.fx"][0])]
        near_row(c, "off the exact solution", label, np.subtract(found, exact)[:2], 0.02)
        c.near(f"force off the exact solution, {label}", c.row(label)[2], found[2] - exact[2], 0.02, 5e-4)
    c.near("vertical force", upward, run["left.fz"][0], 1e-6)
    c.near("iterations", c.says("# iterations of statics"), scene.counted("iterations"), 0.1)


def free_fall(c):
    reference = table(c.example / "reference.csv")
    for label, options in (("1e-3 s (`scene.yaml`)", ()), ("1e-4 s (`-ts_dt 1e-4`)", ("-ts_dt", 1e-4))):
        run = c.run("scene.yaml", *options) if options else c.run()
        at = np.searchsorted(run["time"], reference["time"] - 1e-9)
        off = np.hypot(run["free.x"][at] - reference["free.x"], run["free.z"][at] - reference["free.z"])
        near_row(c, "free end off the reference", label,
                 [off[reference["time"] <= end + 1e-9].max() for end in (0.5, 1.0, 1.7, 2.0, 2.8)], 0.1)


def hanging_chain(c):
    run, reference = c.run(), table(c.example / "reference.csv")
    c.near("tip off linear theory", c.says("the tip stays within # m of it"), run.off(reference, "tip.x"), 0.1)
    c.rounding("energy's drift", c.says("keeps the energy to # J"), drift(run["energy.total"]))
    t, x = run["time"], run["tip.x"]
    turn = np.flatnonzero(x[:-1] * x[1:] < 0)
    crossings = t[turn] - x[turn] * (t[turn + 1] - t[turn]) / (x[turn + 1] - x[turn])
    c.near("frequency", c.says("It swings at # Hz"), 0.5 / np.diff(crossings).mean(), 1e-4)


def hung_body(c):
    """Each jerk multiplies small differences, so that what comes of it is known to a share."""
    run = c.run()
    ropes = [run[f"c{i}.tension_{end}"] for i in range(1, 5) for end in ("from", "to")]
    c.near("swing", c.says("It swings out by # m"), np.abs(run["box.x"]).max())
    c.near("largest tension", c.says("some # N in a rope"), max(rope.max() for rope in ropes), 0.25)
    change, energy, steps, passed, strain = c.says(
        "stays within # J of its # J over # steps, while # J pass between motion and height and some # J in and out")
    c.rounding("energy's change", change, drift(run["energy.total"]))
    c.near("energy", energy, run["energy.total"][0])
    c.near("steps", steps, run.counted("steps"))
    c.near("energy that passes", passed, span(run["energy.gravity"]), 0.03)
    c.near("strain energy", strain, run["energy.strain"].max(), 0.2)
    for what, keys in (("with `rotation: euler` within # J", "rotation: euler"),
                       ("with a rigid link of 1e6 N within # J", "coupling: {rigid_link: {axial_stiffness: 1.0e6}}")):
        other = c.run("scene.yaml", changes=[("  box:\n", f"  box:\n    {keys}\n")])
        c.rounding(f"energy's change, {keys}", c.says(what), drift(other["energy.total"]))
    damped = c.run("scene.yaml", changes=[("energy_momentum", "generalized_alpha\n  spectral_radius: 0.3")])
    loss = damped["energy.total"][0] - damped["energy.total"][-1]
    c.near("loss at radius 0.3", c.says("at radius 0.3 loses some # J"), loss, 0.5)


def low_langley(c):
    run = c.run()
    for label, names in (("tension", ("riser.tension_to", "riser.tension_from")), ("vertical", ("top.fz", "bottom.fz"))):
        for number, name in zip(c.says(label + r" at the top, at the bottom \| #, # \|"), names):
            c.near(f"at rest, {name}", number, run[name][0] / 1e3)
    c.near("at rest, horizontal", c.row("horizontal")[0], run["top.fx"][0] / 1e3)
    for case in ("surge", "sway", "heave", "wave_0", "wave_45", "wave_90"):
        run, reference = c.run(f"{case}.yaml"), table(c.example / "reference" / f"{case}.csv")
        found = np.interp(reference["time"], run["time"], run["riser.tension_to"])
        off = np.abs(found - reference["riser.tension_to"]) / 1e3
        good = np.abs(reference["time"] - 1.3) > 1e-6 if case == "wave_45" else np.full(len(off), True)
        near_row(c, "off the curves", case, [off[good].max(), np.sqrt(np.mean(off**2)), run.counted("steps")])
        if not good.all():
            c.near("off the curve where that is astray", c.says(r"\| wave_45 \| #, and # at 1.3 s")[1], off[~good].max())


def net(c):
    """The first tenth, for the whole takes half a minute."""
    when, kinetic, taken = c.says("After # s the kinetic energy is # J, and # J are taken")
    run = c.run(None, "-ts_max_time", when)
    elements, unknowns = c.says("# elements, # unknowns")
    c.near("elements", elements, run.counted("elements"))
    c.near("unknowns", unknowns, run.counted("unknowns"))
    c.near("kinetic energy", kinetic, run["energy.kinetic"][-1])
    c.near("energy taken", taken, run["energy.total"][0] - run["energy.total"][-1])


def seismic_array(c):
    run = c.run()
    elements, unknowns, least, most = c.says("# elements and twelve bodies: # unknowns, # to # adaptive steps")
    c.near("elements", elements, run.counted("elements"))
    c.near("unknowns", unknowns, run.counted("unknowns"))
    least, most = float(least), float(most)
    c.near("steps", f"{(least + most) / 2:.1f}", run.counted("steps"), (most - least) / (most + least))
    c.near("iterations", c.says("moves with the doors, # iterations"), run.counted("iterations"), 0.1)
    t, straight, after = run["time"], int(np.searchsorted(run["time"], 300)), run.between(301)
    inner, outer = after["trunk.tension_from"], after["trunk.tension_to"]
    steady, least, when = c.says(r"port .inner. door \| # kN \| down to # kN at # s")
    c.near("inner door, straight", steady, run["trunk.tension_from"][straight] / 1e3)
    c.near("inner door, least", least, inner.min() / 1e3)
    c.near("its time", when, after["time"][inner.argmin()])
    steady, most, when = c.says(r"starboard .outer. door \| # kN \| up to # kN at # s")
    c.near("outer door, straight", steady, run["trunk.tension_to"][straight] / 1e3)
    c.near("outer door, most", most, outer.max() / 1e3)
    c.near("its time", when, after["time"][outer.argmax()])
    names = [f"{side}{{}}[{i}]" for side in ("port", "starboard") for i in range(6)]
    heads = np.array([run[f"{name.format('')}.tension_from"] for name in names]) / 1e3
    first, last, low, high, when = c.says(r"port to starboard \| # to # kN \| # to # kN at # s")
    turn = int(np.searchsorted(t, float(when)))
    for number, value in zip((first, last, low, high),
                             (heads[0, straight], heads[-1, straight], heads[:, turn].min(), heads[:, turn].max())):
        c.near("heads", number, value)
    slackest, when = c.says(r"`port\[0\]`: # N at its head at # s")
    c.near("slackest head", slackest, heads[0].min() * 1e3, 1e-3)
    c.near("its time", when, t[heads[0].argmin()])
    tails = np.array([[run[f"{name.format('_tail')}.{axis}"] for axis in "xyz"] for name in names])
    apart = np.linalg.norm(np.diff(tails, axis=0), axis=1)
    even, least, most = c.says(r"neighbouring tails \| # m \| # to # m")
    c.near("tails apart, straight", even, apart[:, straight].mean())
    c.near("tails apart, least", least, apart.min())
    c.near("tails apart, most", most, apart.max())
    high, low, deep = c.says("are # to # m deep going straight and sink to # m")
    for what, number, value in (("tails, straight", high, -tails[:, 2, straight].max()),
                                ("tails, straight", low, -tails[:, 2, straight].min()),
                                ("tails, deepest", deep, -tails[:, 2].min())):
        c.near(what, number, value)
    ahead, outwards = c.says("about # kN ahead and # kN outwards")
    c.near("door's force ahead", ahead, run["port_door.fx"][straight] / 1e3)
    c.near("door's force outwards", outwards, run["port_door.fy"][straight] / 1e3)


def spinning_top(c):
    reference = table(c.example / "reference.csv")
    for label, step in (("8e-4 s", "8e-4"), ("4e-4 s", "4e-4"), ("2e-4 s (`scene.yaml`)", "2.0e-4"), ("1e-4 s", "1e-4")):
        run = c.run("scene.yaml", changes=[("step: 2.0e-4", f"step: {step}")])
        w, x, y, z = (run[f"top.q{part}"] for part in "wxyz")
        rate = np.polyfit(run["time"], np.unwrap(np.arctan2(-run["top.x"], run["top.y"])), 1)[0]
        tilt = np.degrees(np.abs(np.arcsin(2 * (y * z + w * x)))).max()
        faster, level = c.says(rf"\| {label.replace('(', '.').replace(')', '.')} \| 4 \+ # rad/s \| # degrees")
        c.near(f"rate over 4 rad/s, {label}", faster, rate - 4, 0.1)
        c.near(f"axis off the level, {label}", level, tilt, 0.1)
    run = c.run()
    place, attitude = c.says("they are at most # m and # away")
    c.near("place", place, max(run.off(reference, f"top.{axis}") for axis in "xyz"), 0.1)
    c.near("quaternion", attitude, max(run.off(reference, f"top.q{part}") for part in "wxyz"), 0.1)
    c.rounding("energy's drift", c.says("keeps to # J"), drift(run["energy.total"]))
    stopped = c.run("euler.yaml", status=3)
    c.near("euler: its end", c.says("at t = # s the solver"), stopped["time"][-1])
    assert "its pitch comes to 90 degrees" in stopped.output, stopped.output


def tow_fish(c):
    two, one = c.run(), c.run("scene.yaml")
    apart = max(np.abs(two[f"fish.{axis}"] - one[f"fish.{axis}"]).max() for axis in "xyz")
    c.rounding("ranks apart", c.says("one rank and two agree to # m"), apart)
    fall, first = c.says("`energy.total` falls by # J, of which # J in the first second")
    c.near("energy's fall", fall, two["energy.total"][0] - two["energy.total"][-1])
    c.near("energy's fall in a second", first, two["energy.total"][0] - two.between(0, 1)["energy.total"][-1])
    c.near("jerk", c.says("with a jerk of # N"), two["trunk.tension_from"].max())
    c.near("tension", c.says("to rest near # N"), two.between(1, 2)["trunk.tension_from"].mean(), 0.02)
    c.near("kinetic energy", c.says("The kinetic energy reaches # J"), two["energy.kinetic"].max())
    c.near("unknowns", c.says("# unknowns, on two ranks"), two.counted("unknowns"))
    w, x, y, z = (two[f"fish.q{part}"] for part in "wxyz")
    c.near("pitch", c.says("It pitches by up to # degrees"), np.degrees(np.abs(np.arcsin(2 * (w * y - z * x)))).max())
    c.near("sideways", c.says("swing by # m sideways"), np.abs(two["fish.y"] - two["tow.y"]).max())


def towed_array(c):
    run = c.run()
    elements, unknowns = c.says("# elements, # unknowns")
    c.near("elements", elements, run.counted("elements"))
    c.near("unknowns", unknowns, run.counted("unknowns"))
    c.near("largest tension", c.says("reaches # kN at the tow point"), run["trunk.tension_from"].max() / 1e3)
    taken, kinetic = c.says("takes # J in 14 s, while the kinetic energy reaches # MJ")
    c.near("energy taken", taken, run["energy.total"][0] - run["energy.total"][-1], 0.05)
    c.near("kinetic energy", kinetic, run["energy.kinetic"].max() / 1e6)
