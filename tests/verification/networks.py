"""Networks of every kind are found from any drawn shape.  Where cables do not push, all shapes give the same pulls."""
import numpy as np

from network_scenes import Network
from statics_support import report_number
from support import Verification

SEEDS = [seed for seed in range(2, 33) if seed != 19] + [69, 137, 261]


def solve(v, network, drawn):
    """@return the pulls at the cables' ends"""
    run, done = v.attempt(network.scene(drawn))
    v.close(f"{network.name}, shape {drawn}: exit status", done.returncode, 0, 0)
    if done.returncode:
        print(done.stderr)
        return None
    unbalanced = report_number(run, "statics", "largest_unbalanced_force_over_load")
    if "rounding's share" not in done.stdout:
        v.check(f"{network.name}, shape {drawn}: unbalanced force", unbalanced, 1e-9)
    if network.tension_only:
        v.close(f"{network.name}, shape {drawn}: notes that cables push", done.stderr.count("push"), 0, 0)
    return np.abs([run[name][0] for name in run.columns if ".tension_" in name])


def main():
    verification = Verification(__doc__)
    for seed in SEEDS:
        network = Network(seed)
        rows = [solve(verification, network, drawn) for drawn in ((0, 1) if network.is_convex else (0,))]
        if len(rows) == 2 and all(row is not None and row.size for row in rows):
            verification.check(f"{network.name}: pulls apart by the drawn shape, over the largest",
                               np.ptp(rows, axis=0).max() / np.max(rows), 1e-8)
    verification.finish()


if __name__ == "__main__":
    main()
