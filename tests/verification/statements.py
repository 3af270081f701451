"""Small statements that hold exactly, or in closed form, through the command line."""
import numpy as np

from support import HELD, Verification, energy_drift, orders, scene

ENERGY_MOMENTUM = {"scheme": "energy_momentum"}
GRAVITY = 9.81


def check_free_flight(v):
    """An unstretched element is thrown and turns.  Its middle falls in a parabola; its spin and energy stay."""
    rope = {"mass_per_length": 0.2, "axial_stiffness": 5e3}
    length, down = 1.3, np.array([0, 0, -GRAVITY])
    velocities = np.array([[1.0, 2.0, 3.0], [0.5, -4.0, 5.0]])
    points = {"a": {"position": [0, 0, 0], "velocity": velocities[0].tolist()},
              "b": {"position": [length, 0, 0], "velocity": velocities[1].tolist()}}
    cable = {"from": "a", "to": "b", "elements": 1}
    for name, keys in {"energy_momentum": ENERGY_MOMENTUM, "generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}.items():
        run = v.run(scene(rope, points, cable, 2.0, 2e-3, 0.02, ["a", "b"], GRAVITY, energy=True, **keys))
        t = run["time"][:, None]
        middle = (run.vectors("a") + run.vectors("b")) / 2
        speed = (run.vectors("a", "v") + run.vectors("b", "v")) / 2
        parabola = np.array([length / 2, 0, 0]) + velocities.mean(axis=0) * t + down * t**2 / 2
        v.check(f"free flight, {name}: middle off the parabola [m]", np.abs(middle - parabola).max(), 1e-11)
        v.check(f"free flight, {name}: momentum over mass [m/s]",
                np.abs(speed - velocities.mean(axis=0) - down * t).max(), 3e-11)
        if keys is ENERGY_MOMENTUM:
            arm, turn = run.vectors("b") - run.vectors("a"), run.vectors("b", "v") - run.vectors("a", "v")
            spin = np.cross(arm, turn)   # the angular momentum about the middle, times 12/mass
            v.check(f"free flight, {name}: change of the angular momentum, relative",
                    np.abs(spin - spin[0]).max() / np.linalg.norm(spin[0]), 1e-11)
            v.check(f"free flight, {name}: drift of the energy", energy_drift(run), 1e-11)


def fitted_pole(t, y, guess):
    """The complex s for which Re(A exp(s t)) fits y best, by the Gauss-Newton method."""
    s = guess
    for _ in range(20):
        wave = np.exp(s * t)
        (a, b), *_ = np.linalg.lstsq(np.column_stack([wave.real, -wave.imag]), y, rcond=None)
        slope = (a + 1j * b) * t * wave
        columns = np.column_stack([wave.real, -wave.imag, slope.real, -slope.imag])
        change = np.linalg.lstsq(columns, y, rcond=None)[0][2:]
        s += complex(*change)
    return s


def check_damping(v):
    """A mass on one element is a damped oscillator: k = EA/L, c = (axial_damping + stiffness EA)/L + mass m_c/3."""
    length, stiffness, light, heavy = 1.5, 300.0, 1e-9, 0.3
    cases = {
        "axial_damping": (0.5, light, 1.2, 0, 0),
        "rayleigh stiffness": (0.5, light, 0, 0, 0.004),
        "rayleigh mass": (0, heavy, 0, 1.6, 0),
        "all three": (0.5, heavy, 0.4, 0.7, 0.001),
    }
    for name, (tip, line, axial, beta, gamma) in cases.items():
        spring = {"mass_per_length": line, "axial_stiffness": stiffness, "axial_damping": axial,
                  "rayleigh": {"mass": beta, "stiffness": gamma}}
        mass = tip + line * length / 3
        damping = beta * line * length / 3 + (axial + gamma * stiffness) / length
        rate = damping / (2 * mass)
        pole = complex(-rate, np.sqrt(stiffness / length / mass - rate**2))
        step = 2 * np.pi / pole.imag / 400
        stepped = np.log((1 + pole * step / 2) / (1 - pole * step / 2)) / step   # the pole of the mid-point rule
        points = {"pin": HELD, "ball": {"position": [1.6, 0, 0], "mass": tip}}
        cable = {"from": "pin", "to": "ball", "elements": 1, "length": length}
        for scheme, keys in {"energy_momentum": ENERGY_MOMENTUM, "generalized_alpha 1": {"scheme": "generalized_alpha", "spectral_radius": 1},
                             "plain 0.8": {"scheme": "plain", "spectral_radius": 0.8}}.items():
            run = v.run(scene(spring, points, cable, 2000 * step, step, 5 * step, ["ball"], 0, **keys))
            found = fitted_pole(run["time"], run["ball.x"] - length, stepped)
            what = f"damping by {name}, {scheme}"
            v.close(f"{what}: decay rate [1/s]", -found.real, rate, 1e-4 * rate)
            v.close(f"{what}: frequency [rad/s]", found.imag, pole.imag, 5e-5 * pole.imag)
            if scheme != "plain 0.8":
                v.check(f"{what}: pole off the mid-point rule's, relative", abs(found - stepped) / abs(pole), 1e-9)


def check_axial_dissipation(v):
    """Xi resists the change of the rate of a mass on one element, with and without dampers in the scene; a scene that
    names no scheme has xi = 0.0053, one that does has none.  The steps follow z^n, where
    2 m/dt^2 (z - 1)^2 (z + a) + k (z + 1) ((z + 1) (z + a)/2 + xi (z - 1)^2) = 0,  a = 0.65."""
    length, stiffness, mass, line, step = 1.5, 300.0, 0.5, 1e-9, 0.01
    whole, spring = mass + line * length / 3, stiffness / length
    damper = {"mass_per_length": line, "axial_stiffness": stiffness, "axial_damping": 1}
    for name, keys, options, xi in (("no scheme named", {}, (), 0.0053), ("scheme named", ENERGY_MOMENTUM, (), 0),
                                    ("0.2 asked for", ENERGY_MOMENTUM, ("-cable_axial_dissipation", 0.2), 0.2)):
        z, inertia = np.polynomial.Polynomial([0, 1]), 2 * whole / step**2
        filtered = z + 0.65
        roots = (inertia * filtered * (z - 1)**2
                 + spring * (z + 1) * ((z + 1) * filtered / 2 + xi * (z - 1)**2)).roots()
        stepped = np.log(max(roots, key=lambda root: (abs(root), root.imag)) + 0j) / step
        for beside in (False, True):
            points = {"pin": HELD, "ball": {"position": [1.6, 0, 0], "mass": mass}}
            cables = {"cable": {"from": "pin", "to": "ball", "elements": 1, "length": length}}
            if beside:
                points.update({"post": {"position": [0, 9, 0], "motion": "fixed"}, "end": {"position": [1, 9, 0]}})
                cables["other"] = {"type": "damped", "from": "post", "to": "end", "elements": 1}
            case = scene({"mass_per_length": line, "axial_stiffness": stiffness}, points, cables, 1000 * step, step,
                         step, ["ball"], 0, **keys)
            if beside:
                case["cable_types"]["damped"] = damper
            run = v.run(case, *options)
            late = run["time"] > 100 * step   # the other roots are gone
            found = fitted_pole(run["time"][late], run["ball.x"][late] - length, stepped)
            what = f"axial dissipation, {name}{', beside a damper' if beside else ''}"
            v.check(f"{what}: pole off the recurrence's, relative", abs(found - stepped) / abs(stepped), 1e-9)


def bounce(t, length, slack, mass, stiffness):
    """The height of a ball that falls by `slack` on a string of this length, and bounces again and again."""
    fall, omega, sag = np.sqrt(2 * slack / GRAVITY), np.sqrt(stiffness / mass), mass * GRAVITY / stiffness
    speed = GRAVITY * fall
    contact = 2 * (np.pi - np.arctan(speed / (omega * sag))) / omega
    s = np.mod(t, 2 * fall + contact)
    up = 2 * fall + contact - s
    taut = omega * (s - fall)
    stretch = sag * (1 - np.cos(taut)) + speed / omega * np.sin(taut)
    falling, rising = -length + slack - GRAVITY * s**2 / 2, -length + slack - GRAVITY * up**2 / 2
    return np.where(s < fall, falling, np.where(up < fall, rising, -length - stretch)), fall


def check_tension_only(v):
    mass, stiffness, length = 0.5, 2000.0, 1.0
    string = {"mass_per_length": 1e-12, "axial_stiffness": stiffness, "tension_only": True}
    cable = {"from": "pin", "to": "ball", "elements": 1, "length": length}
    ball = {"position": [0, 0, -0.5], "mass": mass}
    errors = []
    for step in (1e-3, 5e-4, 2.5e-4):
        run = v.run(scene(string, {"pin": HELD, "ball": ball}, cable, 2.0, step, 0.01, ["ball", "cable"], GRAVITY,
                          energy=True, **ENERGY_MOMENTUM))
        exact, fall = bounce(run["time"], length, 0.5, mass, stiffness)
        off, flying = np.abs(run["ball.z"] - exact), run["time"] < fall
        errors.append(off.max())
        v.check(f"slack string, step {step:g} s: fall before the first bounce [m]", off[flying].max(), 2e-10)
        v.check(f"slack string, step {step:g} s: tension before the first bounce [N]",
                np.abs(run["cable.tension_to"][flying]).max(), 1e-11)
        v.check(f"slack string, step {step:g} s: drift of the energy", energy_drift(run), 4e-10)
    print(f"        slack string: errors over three bounces {errors} m, orders {orders(errors)}")
    v.check("slack string, step 2.5e-4 s: three bounces [m]", errors[-1], 2e-5)
    for order in orders(errors):
        v.at_least("slack string: order in the time step", order, 1.95)
    ball = {"position": [0.3, 0, -0.4], "velocity": [1.0, 0.5, 0], "mass": mass}
    run = v.run(scene(string, {"pin": HELD, "ball": ball}, cable, 4.0, 1e-3, 0.01, ["ball"], GRAVITY, energy=True,
                      **ENERGY_MOMENTUM))
    turn = np.cross(run.vectors("ball"), run.vectors("ball", "v"))[:, 2]
    v.check("slack string, thrown sideways: drift of the energy", energy_drift(run), 4e-10)
    v.check("slack string, thrown sideways: change of the angular momentum about the vertical, relative",
            np.abs(turn / turn[0] - 1).max(), 1e-9)
    v.at_least("slack string, thrown sideways: strain energy reached [J]", run["energy.strain"].max(), 1)


def check_rest(v):
    """A chain drawn in its equilibrium stays there; its reactions are its weight."""
    elements, length, tip = 20, 2.0, 0.3
    chain = {"mass_per_length": 0.15, "axial_stiffness": 1e4}
    weight = chain["mass_per_length"] * length * GRAVITY
    tension = weight * (elements - np.arange(elements) - 0.5) / elements + tip * GRAVITY
    z = -np.concatenate([[0], np.cumsum(length / elements * (1 + tension / chain["axial_stiffness"]))])
    shape = [[0, 0, height] for height in z]
    points = {"pin": HELD, "tip": {"position": shape[-1], "mass": tip}}
    cable = {"from": "pin", "to": "tip", "length": length, "elements": elements, "shape": shape}
    for name, keys in {"no scheme named": {}, "generalized_alpha 0.8": {"scheme": "generalized_alpha", "spectral_radius": 0.8}}.items():
        run = v.run(scene(chain, points, cable, 1.0, 1e-3, 0.01, ["pin", "tip", "cable"], GRAVITY, **keys))
        total = weight + tip * GRAVITY
        for column, value in {"pin.fx": 0, "pin.fy": 0, "pin.fz": total, "cable.tension_from": total,
                              "cable.tension_to": tip * GRAVITY}.items():
            off = np.abs(run[column] - value).max()
            v.check(f"at rest, {name}: {column} off {value:.6g} N", off, 1e-9)
        v.check(f"at rest, {name}: motion of the tip in 1 s [m]", np.abs(run.vectors("tip") - shape[-1]).max(), 3e-13)


def check_secant(v):
    """The tangent decides how Newton gets there, not where."""
    rod = {"area": 1e-5, "density": 1300, "youngs_modulus": 7.8e6}
    points = {"pin": HELD, "mass": {"position": [0, 1.7320508075688772, -1], "velocity": [5.42218, 0, 0], "mass": 0.3}}
    cable = {"from": "pin", "to": "mass", "length": 2.0, "elements": 10}
    for name, keys in {"energy_momentum": ENERGY_MOMENTUM, "generalized_alpha 0.7": {"scheme": "generalized_alpha", "spectral_radius": 0.7},
                       "plain 0.7": {"scheme": "plain", "spectral_radius": 0.7}}.items():
        case = scene(rod, points, cable, 1.0, 2e-4, 0.05, ["mass", "cable"], GRAVITY, **keys)
        exact, secant = v.run(case), v.run(case, "-cable_tangent", "secant")
        v.check(f"secant against exact tangent, {name}: positions [m]",
                np.abs(exact.vectors("mass") - secant.vectors("mass")).max(), 1e-7)
        v.check(f"secant against exact tangent, {name}: tension [N]",
                np.abs(exact["cable.tension_from"] - secant["cable.tension_from"]).max(), 1e-6)
        ratio = secant.counted("newton_iterations") / exact.counted("newton_iterations")
        v.at_least(f"secant against exact tangent, {name}: Newton iterations", ratio, 1.0)


def check_output_times(v):
    rope = {"mass_per_length": 0.2, "axial_stiffness": 5e3}
    points = {"a": {"position": [0, 0, 0]}, "b": {"position": [1, 0, 0]}}
    cable = {"from": "a", "to": "b", "elements": 1}
    for start, end, step, interval, steps in ((0, 0.1, 3e-3, 0.01, 40), (0, 0.105, 3e-3, 0.01, 42),
                                              (0, 1, 0.3, 0.1, 10), (2.5, 2.8, 7e-3, 0.03, 50)):
        run = v.run(scene(rope, points, cable, end, step, interval, ["a"], GRAVITY, start=start, **ENERGY_MOMENTUM))
        times = start + interval * np.arange(int((end - start) / interval * (1 + 1e-9)) + 1)
        if end - times[-1] > 1e-9:
            times = np.append(times, end)
        times[-1] = end
        name = f"output every {interval} s from {start} to {end} s, step {step} s"
        v.close(f"{name}: rows", len(run["time"]), len(times), 0)
        late = np.abs(run["time"] - times).max() if len(run["time"]) == len(times) else np.inf
        v.check(f"{name}: times [s]", late, 0)
        v.close(f"{name}: steps", run.counted("steps"), steps, 0)
        v.check(f"{name}: fall [m]", np.abs(run["a.z"] + GRAVITY * (run["time"] - start)**2 / 2).max(), 1e-12)


def main():
    verification = Verification(__doc__)
    check_free_flight(verification)
    check_damping(verification)
    check_axial_dissipation(verification)
    check_tension_only(verification)
    check_rest(verification)
    check_secant(verification)
    check_output_times(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
