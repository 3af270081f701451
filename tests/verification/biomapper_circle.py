"""The Biomapper sled in a ship's full circle (examples/biomapper/circle.yaml, after WHOI Cable's example) against an
independent lumped-mass run that is good to 0.1 %.  Compared are how deep the sled sinks, and the largest tension at the
ship from the circle on."""
import pathlib

import yaml

from support import Verification

SCENE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "biomapper" / "circle.yaml"
BEFORE, DEEPEST, TENSION = 326.5, 942.8, 15192   # depth before the circle [m], largest depth [m], largest tension [N]
CIRCLE = 2200                                     # when the circle begins [s]


def check(v, name, time_keys, elements, limit):
    scene = yaml.safe_load(SCENE.read_text())
    scene["time"] = {"end": 3600, "step": 0.5, **time_keys}
    scene["cables"]["tow_cable"]["elements"] = elements
    run = v.run(scene)
    turning = run["time"] >= CIRCLE
    depth, tension = -run["sled.z"][turning], run["tow_cable.tension_from"][turning]
    v.close(f"{name}: depth before the circle, over the reference's", depth[0] / BEFORE, 1, limit)
    v.close(f"{name}: largest depth, over the reference's", depth.max() / DEEPEST, 1, limit)
    v.close(f"{name}: largest tension, over the reference's", tension.max() / TENSION, 1, limit)


def main():
    verification = Verification(__doc__)
    check(verification, "adaptive, 200 elements", {"adaptive": {"tolerance": 1e-2}}, 200, 1e-3)
    check(verification, "steps of 1 s, 100 elements", {"step": 1.0}, 100, 1e-3)
    check(verification, "generalized_alpha 0.5, 50 elements", {"adaptive": {"tolerance": 1e-2}, "scheme": "generalized_alpha", "spectral_radius": 0.5}, 50,
          2e-3)
    verification.finish()


if __name__ == "__main__":
    main()
