"""The hand-written chain, with which speeds are compared, gives the same result as cablenet in as many iterations."""
import subprocess

from support import HELD, Verification, scene

STEEL = {"area": 1.962e-5, "density": 7800, "youngs_modulus": 53e9}
LENGTH = 1.713
# Elements, step [s], number of steps, axial dissipation.  The steps are so short that none has to be repeated, which
# the yardstick cannot do.
FALLS = ((24, 1e-3, 500, 0), (24, 1e-3, 500, 0.05), (200, 2e-4, 1000, 0))


def with_cablenet(verification, elements, step, steps, dissipation):
    points = {"pin": HELD, "free": {"position": [LENGTH, 0, 0]}}
    cable = {"from": "pin", "to": "free", "length": LENGTH, "elements": elements}
    end = step * steps
    fall = scene(STEEL, points, cable, end, step, end, ["free"], scheme="energy_momentum")
    return verification.run(fall, "-cable_axial_dissipation", dissipation)


def with_yardstick(verification, *arguments):
    command = [verification.options.yardstick, *map(str, arguments)]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return dict(pair.split("=") for pair in printed.split())


def main():
    verification = Verification(__doc__, "yardstick")
    for fall in FALLS:
        elements, step, steps, dissipation = fall
        name = f"{elements} elements, {steps} steps of {step} s, dissipation {dissipation}"
        run, yardstick = with_cablenet(verification, *fall), with_yardstick(verification, *fall)
        x, z = map(float, yardstick["tip"].split(","))
        verification.close(f"{name}: x of the free end [m]", x, run["free.x"][-1], 1e-9)
        verification.close(f"{name}: z of the free end [m]", z, run["free.z"][-1], 1e-9)
        newton = run.counted("newton_iterations")
        verification.close(f"{name}: Newton iterations", int(yardstick["newton"]), newton, 0.2 * newton)
    verification.check("rejected steps in all runs", verification.rejected, 0)
    verification.finish()


if __name__ == "__main__":
    main()
