"""Runs whose scheme brings in energy from nowhere are ended, and those that are right go on."""
import pathlib
import re
import subprocess
import sys

from bench import ENVIRONMENT, arguments

WATCHED = pathlib.Path(__file__).resolve().parent / "watched"
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
failures = []


def expect(truth, text):
    print(("ok    " if truth else "FAIL  ") + text, flush=True)
    if not truth:
        failures.append(text)


def run(given, scene, name, ranks=1, *options):
    """@return the finished process, the report's text and the times of the history's rows"""
    folder = given.scratch / name
    launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    done = subprocess.run([*launcher, given.program, "run", scene, "-o", folder, *options], env=ENVIRONMENT, text=True,
                          capture_output=True, timeout=280)
    rows = (folder / "history.csv").read_text().splitlines()[1:]
    return done, (folder / "run.yaml").read_text(), [float(row.split(",")[0]) for row in rows]


def ended(given, scene, ranks):
    done, report, times = run(given, scene, f"{scene.stem}_{ranks}", ranks)
    what = f"{scene.stem} on {ranks} ranks"
    expect(done.returncode == 3, f"{what} ends with status {done.returncode}, expected 3")
    said = re.search(r"at t = (\S+) s the step's formulas have brought in (\S+) J from nowhere, (\S+) % of the (\S+) J",
                     done.stderr)
    expect(said, f"{what} says when and how much: {done.stderr.strip()[:200]}")
    expect("energy_momentum" in done.stderr and "smaller time.step" in done.stderr, f"{what} says what helps")
    if said:
        time, gained, percent, moved = map(float, said.groups())
        expect(abs(times[-1] - time) < 1e-6, f"{what} has saved the state at t = {time} s")
        expect(gained > 0.05 * moved, f"{what} has gained {gained} J of {moved} J")
    expect("status: failed" in report and "gained_J" in report, f"{what} has said so in run.yaml")


def gone_on(given, scene, *options):
    done, report, _ = run(given, scene, f"{scene.parent.name}_{scene.stem}_on", 1, *options)
    expect(done.returncode == 0, f"{scene.parent.name}/{scene.name} {' '.join(options)}: status {done.returncode}, "
           f"expected 0 {done.stderr.strip()[:200]}")
    return done


def main():
    given = arguments(__doc__)
    for scene in sorted(WATCHED.glob("*.yaml")):
        ended(given, scene, 1)
    ended(given, WATCHED / "whip.yaml", 3)
    # The same whip with the cure, with a limit that lets everything pass, and a scheme that nobody has to watch.
    whip = (WATCHED / "whip.yaml").read_text()
    cured = given.scratch / "cured.yaml"
    cured.write_text(re.sub(r"  spectral_radius: \S+\n", "", whip).replace("generalized_alpha", "energy_momentum"))
    done = gone_on(given, cured)
    expect("energy: " in done.stdout, "the cured whip says where its energy went")
    gone_on(given, WATCHED / "whip.yaml", "-cable_most_gained", "2")
    unasked = given.scratch / "unasked.yaml"
    unasked.write_text(cured.read_text().replace("  energy: true\n", ""))
    done = gone_on(given, unasked)
    expect("energy: " not in done.stdout, "what conserves is not watched where nobody asks")
    gone_on(given, EXAMPLES / "free_fall" / "scene.yaml")
    # Who asks for no energy is watched, too.
    for name in ("whip", "tension_only_array", "surface_line"):
        unasked = given.scratch / f"{name}_unasked.yaml"
        unasked.write_text((WATCHED / f"{name}.yaml").read_text().replace("  energy: true\n", ""))
        ended(given, unasked, 1)
    ended(given, given.scratch / "whip_unasked.yaml", 3)
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
