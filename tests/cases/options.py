"""PETSc's and the program's options: help, what they show while solving, prefixes, and which were not used."""
import sys

from bench import arguments
from command_line import SCENE, Bench

OWN = ("cable_axial_dissipation", "cable_tangent", "cable_elimination_limit", "cable_statics_monitor",
       "cable_statics_time_limit", "cable_most_gained")
# It hangs on nothing, so that there is no equilibrium: the last resort, settling in time, is tried too.
SETTLING = """
environment: {gravity: 9.81}
cable_types: {rope: {mass_per_length: 0.5, axial_stiffness: 2000}}
points: {a: {position: [0, 0, 0]}, b: {position: [3, 0, 0], mass: 1}}
cables: {cable: {type: rope, from: a, to: b, elements: 3}}
"""
failures = []


def expect(truth, text):
    print(("ok    " if truth else "FAIL  ") + text)
    if not truth:
        failures.append(text)


def help_shows_them(bench):
    for words in (("run", "-help"), ("run", "--help")):
        text = bench(*words).stdout
        for name in OWN:
            lines = [line for line in text.splitlines() if f"-{name}" in line]
            expect(lines, f"{' '.join(words)} shows -{name}")
    text = bench("run", "-help").stdout
    for name in OWN:
        line = next((line for line in text.splitlines() if f"-{name}" in line), "")
        expect("now" in line and len(line.split(">: ")[-1]) > 40, f"with its default and what it does: {line.strip()}")
    for name in ("ts_alpha_radius", "snes_max_it", "ksp_type"):
        expect(f"-{name}" in text, f"-help shows PETSc's -{name}")
    text = bench("run", "scene.yaml", "-o", "helped", "-help").stdout
    for name in ("cable_tangent", "cable_elimination_limit", "ts_alpha_radius"):
        expect(f"-{name}" in text, f"-help with a scene shows -{name}")


def what_is_shown_while_solving(bench):
    """PETSc looks these up in each solve; none may be lost by what spares the look-ups."""
    steps = 50
    shown = {
        ("-ksp_view",): ("KSP Object", steps),
        ("-ksp_view_rhs",): ("Vec Object", steps),
        ("-ksp_converged_reason",): ("Linear solve converged", steps),
        ("-ksp_monitor", "-ksp_type", "gmres"): ("KSP Residual norm", steps),
        ("-ksp_monitor_true_residual", "-ksp_type", "gmres"): ("true resid norm", steps),
        ("-snes_view",): ("SNES Object", steps),
        ("-snes_view_solution",): ("Vec Object", steps),
        ("-snes_converged_reason",): ("Nonlinear solve converged", steps),
        ("-snes_monitor",): ("SNES Function norm", steps),
        ("-snes_linesearch_monitor", "-snes_linesearch_type", "bt"): ("Line search", steps),
        ("-snes_test_jacobian",): ("Testing Jacobian", steps),
        ("-snes_compare_explicit",): ("Finite difference Jacobian", steps),
        ("-ts_view",): ("TS Object", 1),
        ("-ts_monitor",): ("TS dt", steps),
        ("-ts_adapt_monitor",): ("TSAdapt", 0),
        ("-mat_view", "::ascii_info"): ("Mat Object", 2),
    }
    for words, (text, times) in shown.items():
        done = bench("run", "scene.yaml", "-o", "shown", *words)
        expect(done.returncode == 0 and done.stdout.count(text) >= times,
               f"{' '.join(words)} prints `{text}` {done.stdout.count(text)} times, of {times}")
        expect("was not used" not in done.stderr or words[0] == "-ts_adapt_monitor", f"{words[0]} counts as used")
    for words in (("-options_file", "view.options"),):
        (bench.folder / "view.options").write_text("-snes_view\n")
        expect("SNES Object" in bench("run", "scene.yaml", "-o", "shown", *words).stdout, "also from a file")


def results_do_not_depend_on_what_is_shown(bench):
    bench("run", "scene.yaml", "-o", "plain")
    for words in (("-snes_view",), ("-snes_converged_reason",), ("-ksp_converged_reason",), ("-snes_monitor",)):
        bench("run", "scene.yaml", "-o", "shown", *words)
        expect(bench.rows("shown") == bench.rows("plain"), f"{words[0]} leaves the numbers alone")
    for words in (("-snes_lag_jacobian", "2"), ("-snes_type", "newtontr"), ("-snes_fd",), ("-snes_test_jacobian",),
                  ("-snes_lag_preconditioner", "2"), ("-snes_ksp_ew",), ("-snes_ksp_ew", "-ksp_type", "gmres")):
        done = bench("run", "scene.yaml", "-o", "other", *words)
        last = [float(bench.rows(run)[-1]["tip.z"]) for run in ("plain", "other")]
        expect(done.returncode == 0 and abs(last[1] - last[0]) < 1e-6, f"{' '.join(words)} comes to the same: {last}")


def unused_options(bench):
    done = bench("run", "scene.yaml", "-o", "used")
    expect("was not used" not in done.stderr, "without options none is unused")
    for words, unused in ((("-snes_vew",), "-snes_vew"), (("-snes_view", "-ksp_veiw"), "-ksp_veiw"),
                          (("-cable_axial_disipation", "0.1"), "-cable_axial_disipation 0.1"),
                          (("-cable_statics_monitor",), "-cable_statics_monitor"),
                          (("-relax_ts_max_steps", "3"), "-relax_ts_max_steps 3")):
        done = bench("run", "scene.yaml", "-o", "unused", *words)
        notes = [line for line in done.stderr.splitlines() if "was not used" in line]
        expect(len(notes) == 1 and f"option {unused} was" in notes[0], f"{' '.join(words)}: {unused} alone is reported unused")
    done = bench("run", "scene.yaml", "-o", "unused", "-options_left", "-snes_vew")
    expect("-options_left" not in done.stderr and "snes_vew" in done.stdout, "-options_left is PETSc's, and tells of -snes_vew too")


def prefixes(bench):
    """With relax_ an option reaches the solvers that let a network settle in time, and only those."""
    (bench.folder / "settling.yaml").write_text(SETTLING)
    plain = bench("run", "settling.yaml", "-o", "settled", "-relax_snes_monitor")
    expect(plain.returncode == 3 and "SNES Function norm" in plain.stdout,
           f"-relax_snes_monitor prints where a network settles in time: status {plain.returncode}, {plain.stderr[-300:]}")
    expect("SNES Function norm" not in bench("run", "settling.yaml", "-o", "settled", "-snes_monitor").stdout, "-snes_monitor does not")
    done = bench("run", "settling.yaml", "-o", "settled", "-relax_ts_monitor", "-relax_ts_max_steps", "3")
    times = [line.split() for line in done.stdout.splitlines() if " TS dt " in line]
    expect(times and max(int(words[0]) for words in times) == 3, "-relax_ts_max_steps stops it")
    done = bench("run", "settling.yaml", "-o", "settled", "-relax_pc_type", "lu", "-relax_ksp_view")
    expect("type: lu" in done.stdout and "shell" not in done.stdout, "-relax_pc_type is heeded")
    done = bench("run", "settling.yaml", "-o", "settled", "-pc_type", "lu", "-relax_ksp_view")
    expect("network elimination" in done.stdout, "-pc_type is not its")
    done = bench("run", "settling.yaml", "-o", "settled", "-relax_cable_elimination_limit", "0", "-relax_ksp_view")
    expect("type: mumps" in done.stdout, "-relax_cable_elimination_limit leads to MUMPS")
    done = bench("run", "settling.yaml", "-o", "settled", "-relax_cable_elimination_limit", "0", "-relax_ksp_view",
                 "-relax_mat_mumps_icntl_7", "0")
    expect("INFOG(7) (ordering option effectively used after analysis): 0" in done.stdout, "-relax_mat_mumps_icntl_7 wins")
    expect("was not used" not in done.stderr, "all of these count as used")
    for option, value in (("-relax_ksp_type", "gmress"), ("-relax_cable_elimination_limit", "-1")):
        done = bench("run", "settling.yaml", "-o", "refused", option, value)
        expect(done.returncode == 2 and option in done.stderr, f"{option} {value} is refused")


def mumps(bench):
    chosen = "INFOG(7) (ordering option effectively used after analysis): 0"
    for words in ((), ("-mat_mumps_icntl_7", "0")):
        done = bench("run", "scene.yaml", "-o", "mumps", "-cable_elimination_limit", "0", "-ksp_view", *words)
        expect((chosen in done.stdout) == bool(words), f"MUMPS is ordered as the user says: {' '.join(words)}")
        expect("was not used" not in done.stderr, "and no option is unused")


def main():
    given = arguments(__doc__)
    (given.scratch / "scene.yaml").write_text(SCENE)
    bench = Bench(given.program, given.scratch)
    for part in (help_shows_them, what_is_shown_while_solving, results_do_not_depend_on_what_is_shown, unused_options, mumps, prefixes):
        part(bench)
    print(f"{len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
