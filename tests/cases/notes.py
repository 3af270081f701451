"""The notes at a run's end: each where it belongs, nowhere else, and alike on any number of ranks."""
import pathlib
import re
import subprocess
import sys

from bench import ENVIRONMENT, arguments

NOTED = pathlib.Path(__file__).resolve().parent / "noted"
EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
PERIODS = "the steps do not resolve this motion: in each of its periods"
RUN = r"^the steps do not resolve this motion: in this run their errors add up.* to some (\S+) % of its way, which is " + (
    r"(\S+) m; steps of (\S+) s would come to 1 %")
failures = []


def expect(truth, text):
    print(("ok    " if truth else "FAIL  ") + text, flush=True)
    if not truth:
        failures.append(text)


def notes(given, scene, *options, ranks=1, status=0):
    """@return what the run noted on stderr; it has to be in run.yaml, too"""
    folder = given.scratch / "run"
    launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
    done = subprocess.run([*launcher, given.program, "run", scene, "-o", folder, *options], env=ENVIRONMENT, text=True,
                          capture_output=True, timeout=280)
    what = f"{scene.parent.name}/{scene.name} {' '.join(options)} on {ranks} ranks"
    expect(done.returncode == status, f"{what}: status {done.returncode}, expected {status}")
    said = [line.removeprefix("cablenet: note: ") for line in done.stderr.splitlines() if line.startswith("cablenet: note: ")]
    said = [note for note in said if not note.startswith(str(scene))]
    report = " ".join((folder / "run.yaml").read_text().split())
    for note in said:
        expect(note in report.replace('\\"', '"'), f"{what}: run.yaml has its note: {note}")
    expect(bool(said) == (" notes:" in report), f"{what}: run.yaml has notes where there are some")
    return said


def number(text):
    """Of a number with a unit that may begin with k or M."""
    value, unit = re.fullmatch(r"([-\d.e+]+) ?([kM]?)\w*", text).groups()
    return float(value) * {"": 1, "k": 1e3, "M": 1e6}[unit]


def only(given, scene, patterns, *options, ranks=(1, 2, 3)):
    """Each pattern fits one note, in their order, and there are no others.  @return the groups"""
    first = notes(given, scene, *options)
    found = [re.search(pattern, note) for pattern, note in zip(patterns, first)]
    expect(len(first) == len(patterns) and all(found), f"{scene.name} {' '.join(options)}: {len(patterns)} notes: {first}")
    for count in ranks[1:]:
        other = notes(given, scene, *options, ranks=count)
        expect(other == first, f"{scene.name} {' '.join(options)}: the same notes on {count} ranks: {other}")
    return [match.groups() if match else () for match in found]


def near(value, expected, share, text):
    expect(abs(value - expected) <= share * abs(expected), f"{text}: {value}, expected {expected}")


def pushes(given):
    # 10 kg on EA/L = 20 kN/m at 2 m/s: sqrt((v sqrt(k m))^2 + (m g)^2) - m g; a sine is below -m g for 46 % of the time.
    [[newtons, seconds]] = only(given, NOTED / "pushes.yaml",
                                [r"^cable rod pushed: (\S+ N) at t = \S+ s, \d+ % of .*, for (\S+) s in all; .*tension_only"])
    near(number(newtons), 802, 0.01, "the push")
    near(float(seconds), 0.465, 0.03, "how long it pushed")
    text = (NOTED / "pushes.yaml").read_text()
    slack = given.scratch / "slack.yaml"
    slack.write_text(text.replace("axial_stiffness: 1.0e5", "axial_stiffness: 1.0e5, tension_only: true"))
    only(given, slack, [], ranks=(1,))
    both = given.scratch / "both.yaml"
    both.write_text(text.replace("-5.005]", "-5.05]"))
    only(given, both, [r"^2 of 2 cables pushed, cable rod the most: "])
    only(given, EXAMPLES / "hanging_chain" / "scene.yaml", [], "-ts_max_steps", "500")
    only(given, EXAMPLES / "free_fall" / "scene.yaml", [r"^cable cable pushed: .* in its element 23 of 24"], ranks=(1,))


def folding(given):
    only(given, NOTED / "folds.yaml",
         ["^cable rope pushed: ", "^cable rope pushed so hard .* it folds, and steps do not resolve how.*other rank counts", RUN],
         "-ts_max_steps", "90")
    # Gravity says to which side it folds, long before rounding could.
    heavy = given.scratch / "heavy.yaml"
    heavy.write_text((NOTED / "folds.yaml").read_text().replace("gravity: 0", "gravity: 9.81"))
    said = notes(given, heavy)
    expect(said and not any("folds" in note for note in said), f"a heavy cable folds by its weight: {said}")


def peaks(given):
    only(given, NOTED / "fall.yaml", [], ranks=(1,))
    [[newtons], _] = only(given, NOTED / "fall.yaml",
                       [r"^the largest tension of cable rope, (\S+ kN) at t = 2\.9 s, lasted one step: it depends on the step",
                        "^the steps do not resolve this motion: in this run"], "-ts_dt", "0.1")
    expect(1e3 < number(newtons) < 5e3, f"a peak of {newtons}")


def long_steps(given):
    # A step of a rigid pendulum turns by (w dt)^3/12 too little, a turn by 2 pi (w dt)^2/12: 0.41 m of 6.1 m.
    start = "^the largest tension of cable rod, 2.. N at t = .* lasted one step.*; 131 N is the largest that lasted longer"
    pendulum = NOTED / "pendulum.yaml"
    only(given, pendulum, [start], ranks=(1,))
    [_, [percent, metres, step, step_of_run]] = only(given, pendulum, [
        start, PERIODS + r" they lead it astray by some (\S+) % of its way, which is (\S+) m; steps of (\S+) s would by 1 %,"
        r" and in this run steps of (\S+) s would$"], "-ts_dt", "0.2")
    near(float(percent), 6.7, 0.1, "percent of a turn")
    near(float(metres), 6.09, 0.02, "metres of a turn")
    near(float(step), 0.077, 0.1, "the step for 1 %")
    only(given, pendulum, [start], "-ts_dt", step_of_run, ranks=(1, 3))
    # Eight turns of 1.7 % each, where a half turn is as far as it gets: 20 s v (w dt)^2/12 of 6.09 m.
    [_, [percent, metres, step]] = only(given, pendulum, [start, RUN], "-ts_dt", "0.1", ranks=(1, 3))
    near(float(percent), 13.6, 0.05, "percent of eight turns")
    near(float(metres), 6.09, 0.02, "metres of eight turns")
    near(float(step), 0.027, 0.15, "the step for 1 % of eight turns")
    adaptive = given.scratch / "adaptive.yaml"
    adaptive.write_text(pendulum.read_text().replace("step: 0.01", "step: 0.2, adaptive: {tolerance: 1}"))
    only(given, adaptive, [start], ranks=(1,))
    pushed = "^3 of 3 cables pushed"
    only(given, NOTED / "tripod.yaml", [pushed], ranks=(1,))
    only(given, NOTED / "tripod.yaml", [pushed, PERIODS], "-ts_dt", "0.025", ranks=(1,))
    for ranks in (2, 3):
        said = notes(given, NOTED / "tripod.yaml", "-ts_dt", "0.025", ranks=ranks)
        expect(any(note.startswith(PERIODS) for note in said), f"the tripod's steps are too long on {ranks} ranks: {said}")
    water = "^the steps do not resolve this motion: each by itself they lead it astray"
    only(given, NOTED / "waves.yaml", ["^cable line pushed"], ranks=(1,))
    only(given, NOTED / "waves.yaml", ["^cable line pushed", "lasted one step"], "-ts_dt", "0.6")
    # Here Newton's method comes near its end, so that rounding has steps rejected on some rank counts.
    for ranks in (1, 2, 3):
        said = notes(given, NOTED / "waves.yaml", "-ts_dt", "0.8", ranks=ranks)
        found = [re.search(water + r" by some (\S+) % of its way, .*; steps of (\S+) s would by 0.1 %", note) for note in said]
        [[percent, step]] = [match.groups() for match in found if match]
        near(float(percent), 2.25, 0.1, f"percent of the way on {ranks} ranks")
        near(float(step), 0.3, 0.2, f"the step for 0.1 % on {ranks} ranks")


def caught(given):
    # The contact lasts 1.4 steps, four times in 160: looks at one step in eight alone see nothing of it.
    bungee = given.scratch / "caught.yaml"
    bungee.write_text((NOTED / "bungee.yaml").read_text().replace("spectral_radius: 0", "scheme: energy_momentum"))
    [_, [percent, _, _]] = only(given, bungee, ["lasted one step", RUN], "-ts_dt", "0.05", ranks=(1, 2))
    expect(5 <= float(percent) < 20, f"16 % astray, and {percent} % are told")
    only(given, bungee, [], "-ts_dt", "0.005", ranks=(1,))
    # What is lost makes the motion late: a quarter of the part that is lost, for each of nine ways.
    damped = given.scratch / "damped.yaml"
    damped.write_text((NOTED / "bungee.yaml").read_text().replace("spectral_radius: 0", "spectral_radius: 0.5"))
    [[percent, _, _]] = only(given, damped, [RUN.replace("add up.*", "add up, most of it by what their formulas take .*")],
                             ranks=(1, 2))
    near(float(percent), 17, 0.15, "percent of the way at radius 0.5")


def turning(given):
    only(given, NOTED / "spins.yaml", [], ranks=(1,))
    only(given, NOTED / "spins.yaml", [PERIODS], "-ts_dt", "0.005", ranks=(1, 2))


def bending(given):
    pushed, bent = "^cable line pushed: ", (
        r"^cable line pushed in all its elements, so that it bends, .*: the steps do not resolve this motion.*; try steps or a"
        r" tolerance that are (\S+) times as long$")
    [_, [shorter]] = only(given, NOTED / "bends.yaml", [pushed, bent], "-ts_dt", "0.0005", ranks=(1, 2))
    expect(0.002 < float(shorter) < 0.2, f"steps {shorter} times as long")
    only(given, NOTED / "bends.yaml", [pushed], "-ts_dt", "1e-5", ranks=(1,))
    adaptive = given.scratch / "bends.yaml"
    adaptive.write_text((NOTED / "bends.yaml").read_text().replace("step: 1.0e-4", "step: 5.0e-4, adaptive: {tolerance: 1e-3}"))
    only(given, adaptive, [pushed, bent], ranks=(1,))


def dissipation(given):
    took = r"^the step's formulas took (\S+) % of the energy that moved.*shorter steps take less"
    [[percent], _] = only(given, NOTED / "bungee.yaml", [took, RUN], ranks=(1, 2))
    near(float(percent), 57, 0.1, "percent of the energy at radius 0")
    only(given, NOTED / "bungee.yaml", [], "-ts_dt", "0.001", ranks=(1,))
    # It is said to who does not ask for energies, too, but not where water takes some.
    unasked = given.scratch / "unasked.yaml"
    unasked.write_text((NOTED / "bungee.yaml").read_text().replace("energy: true", "energy: false"))
    [[of_looks], _] = only(given, unasked, [took, RUN], ranks=(1, 2))
    near(float(of_looks), float(percent), 0.1, "percent of the energy by looks")
    wet = given.scratch / "wet.yaml"
    wet.write_text(unasked.read_text().replace("gravity: 9.81", "gravity: 9.81, fluid: {density: 1}").replace(
        "tension_only", "diameter: 0.01, tension_only"))
    only(given, wet, [], ranks=(1,))


def rejected(given):
    for ranks in (1, 3):
        said = notes(given, NOTED / "rejected.yaml", ranks=ranks, status=3)
        failed = [re.match(r"(\d+) of (\d+) attempts at steps failed", note) for note in said]
        failed = [match for match in failed if match]
        expect(len(failed) == 1 and 2 < int(failed[0][1]) < int(failed[0][2]) and
               any("other rank counts may give other results" in note for note in said),
               f"on {ranks} ranks rejected steps are noted: {said}")


def main():
    given = arguments(__doc__)
    for case in (pushes, folding, peaks, long_steps, caught, turning, bending, dissipation, rejected):
        case(given)
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
