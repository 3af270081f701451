"""A level cable falls about its pinned end: order in the time step and in the element size, against independent
solutions."""
import numpy as np

from support import HELD, Verification, orders, read_reference, rows_at, scene

STEEL = {"area": 1.962e-5, "density": 7800, "youngs_modulus": 53e9}
HEAVY = {**STEEL, "density": 0.34 / (1.962e-5 * 1.713)}
ENERGY_MOMENTUM = {"scheme": "energy_momentum"}
MASS, LENGTH, GRAVITY = 0.26215, 1.713, 9.81
STEPS = (2e-3, 1e-3, 5e-4, 2.5e-4)
# The largest errors that are allowed with a step of 1e-3 s [m].
SCHEMES = {
    "energy_momentum": (ENERGY_MOMENTUM, 2e-5),
    "no scheme named": ({}, 2e-5),
    "generalized_alpha 1": ({"scheme": "generalized_alpha", "spectral_radius": 1}, 4e-5),
    "generalized_alpha 0.8": ({"scheme": "generalized_alpha", "spectral_radius": 0.8}, 4e-5),
    "generalized_alpha 0.3": ({"scheme": "generalized_alpha", "spectral_radius": 0.3}, 9e-5),
    "generalized_alpha 0": ({"scheme": "generalized_alpha", "spectral_radius": 0}, 2.3e-4),
    "plain 1": ({"scheme": "plain", "spectral_radius": 1}, 5e-5),
    "plain 0.8": ({"scheme": "plain", "spectral_radius": 0.8}, 5e-5),
    "plain 0.3": ({"scheme": "plain", "spectral_radius": 0.3}, 1e-4),
}


def fall(verification, step, time_keys, elements=24, end=0.5, interval=0.01, steel=STEEL):
    points = {"pin": HELD, "free": {"position": [LENGTH, 0, 0]}}
    cable = {"from": "pin", "to": "free", "length": LENGTH, "elements": elements}
    return verification.run(
        scene(steel, points, cable, end, step, interval, ["free"], GRAVITY, energy=True, **time_keys))


def error(run, reference):
    """The largest distance of the free end from the reference [m]."""
    rows = rows_at(reference["t"], run["time"])
    return np.hypot(run["free.x"] - reference["X"][rows], run["free.z"] - reference["Z"][rows]).max()


def check_order_in_time(verification):
    reference = read_reference("free_fall_A1.csv")
    for name, (time_keys, limit) in SCHEMES.items():
        errors = [error(fall(verification, step, time_keys), reference) for step in STEPS]
        print(f"        {name}: errors {errors} m with steps {STEPS} s, orders {orders(errors)}")
        verification.check(f"{name}: error with the step 1e-3 s [m]", errors[1], limit)
        for order in orders(errors)[-2:]:
            verification.at_least(f"{name}: order in the time step", order, 1.95)


def check_second_density(verification):
    reference = read_reference("free_fall_A2.csv")
    for name in ("energy_momentum", "generalized_alpha 0.3"):
        time_keys, limit = SCHEMES[name]
        run = fall(verification, 1e-3, time_keys, steel=HEAVY)
        verification.check(f"0.34 kg, {name}: error with the step 1e-3 s [m]", error(run, reference), limit)


def check_energy(verification):
    run = fall(verification, 1e-3, ENERGY_MOMENTUM, end=1.0)
    drift = np.abs(run["energy.total"] - run["energy.total"][0]).max() / (MASS * GRAVITY * LENGTH)
    verification.check("energy_momentum: drift of the energy in 1 s over m g L", drift, 1e-12)
    verification.at_least("energy_momentum: kinetic energy reached over m g L",
                          run["energy.kinetic"].max() / (MASS * GRAVITY * LENGTH), 0.45)


def check_order_in_size(verification):
    """The element's error changes its sign at about 0.3 s.  Before that the orders are clean.  After that they are
    clean between fine meshes alone."""
    reference = read_reference("free_fall_continuum.csv")
    meshes = (24, 48, 96, 192)
    early, at_04, time_errors = [], [], []
    for elements in meshes:
        run = fall(verification, 2.5e-4, ENERGY_MOMENTUM, elements, end=0.45, interval=0.025)
        x = run["free.x"][rows_at(run["time"], reference["t"])]
        off = np.abs(x - reference["X_cont"])
        early.append(off[reference["t"] < 0.21].max())
        at_04.append(off[rows_at(reference["t"], [0.4])[0]])
        time_errors.append(np.abs(x - reference[f"X_N{elements}"]).max())
        print(f"        {elements} elements: off the continuum by {dict(zip(reference['t'], off))} m")
    verification.check("time error of these runs, 24 to 192 elements [m]", max(time_errors), 6e-7)
    verification.check("192 elements: off the continuum up to 0.2 s [m]", early[-1], 6e-6)
    verification.check("192 elements: off the continuum at 0.4 s [m]", at_04[-1], 1.2e-5)
    for order in orders(early)[-2:]:
        verification.at_least("order in the element size up to 0.2 s", order, 1.9)
    verification.at_least("order in the element size at 0.4 s, 96 to 192 elements", orders(at_04)[-1], 1.75)


def main():
    verification = Verification(__doc__)
    check_order_in_time(verification)
    check_second_density(verification)
    check_energy(verification)
    check_order_in_size(verification)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
