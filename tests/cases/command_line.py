"""The command line keeps its promises on exit statuses, files, PETSc options and help."""
import json
import sys

from bench import SCENES, Bench, arguments, expect, status

SCENE = (SCENES / "command_line.yaml").read_text(encoding="utf-8")
FILES = {"history.csv", "cables.xmf", "mesh.h5", "frames_0000.h5", "result.h5", "run.yaml"}


def runs_and_results(bench):
    done = bench("run", "scene.yaml")
    expect(done.returncode == 0, "a run ends with 0")
    expect({path.name for path in (bench.folder / "scene.out").iterdir()} == FILES, "it writes into SCENE.out what it says")
    rows = bench.rows("scene.out")
    expect([float(row["time"]) for row in rows] == [0, 0.01, 0.02, 0.03, 0.04, 0.05], "rows stand at the output times exactly")
    expect("status: finished" in bench.report("scene.out"), "run.yaml says finished")
    expect(all(float(row["pin.x"]) == 0 for row in rows) and "pin.fz" in rows[0], "a held point has its reaction")


def petsc_options(bench):
    bench("run", "scene.yaml", "-o", "halved", "-ts_dt", "5e-4")
    expect("steps: 100" in bench.report("halved"), "-ts_dt overrides the scene's step")
    bench("run", "-ts_dt", "5e-4", "scene.yaml", "-o", "halved2")
    expect("steps: 100" in bench.report("halved2"), "options may stand before the scene")
    (bench.folder / "petsc.options").write_text("-ts_dt 2.5e-4\n")
    bench("run", "scene.yaml", "-options_file", "petsc.options", "-o", "quartered")
    expect("steps: 200" in bench.report("quartered"), "-options_file is PETSc's, not -o")
    done = bench("run", "scene.yaml", "-o", "iterative", "-ksp_type", "gmres", "-pc_type", "ilu")
    expect(done.returncode == 0 and "gmres + ilu" in bench.report("iterative"), "-ksp_type and -pc_type win")
    done = bench("run", "scene.yaml", "-o", "stopped", "-ts_max_steps", "7")
    expect(done.returncode == 0 and "status: stopped" in bench.report("stopped"), "-ts_max_steps stops")
    expect(abs(float(bench.rows("stopped")[-1]["time"]) - 0.007) < 1e-12, "and saves the state where it stopped")
    done = bench("run", "scene.yaml", "-o", "monitored", "-ts_monitor", "-snes_monitor")
    expect("TS dt" in done.stdout and "SNES Function norm" in done.stdout, "-ts_monitor and -snes_monitor print")
    done = bench("run", "scene.yaml", "-o", "adaptive", "-ts_adapt_type", "basic", "-ts_rtol", "1e-3", "-ts_atol", "1e-3")
    expect(done.returncode == 0 and float(bench.rows("adaptive")[-1]["time"]) == 0.05, "-ts_adapt_type basic works")
    done = bench("run", "scene.yaml", "-o", "misspelt", "-snes_mxa_it", "3")
    expect(done.returncode == 0 and "-snes_mxa_it 3 was not used" in done.stderr, "an option that nothing used is reported")
    bench("run", "scene.yaml", "-o", "radius", "-ts_alpha_radius", "0.6")
    expect("energy_momentum, spectral radius 0.6" in bench.report("radius"), "-ts_alpha_radius is the scheme's radius")
    bench("run", "scene.yaml", "-o", "default")
    expect("network elimination, 1.0 block products a node" in bench.report("default"), "the solver is told, and why")
    done = bench("run", "scene.yaml", "-o", "mumps", "-cable_elimination_limit", "0")
    expect(done.returncode == 0 and "lu (mumps), elimination would take more than 0" in bench.report("mumps"), "beyond the limit MUMPS is taken")
    done = bench("run", "scene.yaml", "-o", "package", "-pc_factor_mat_solver_type", "superlu")
    expect(done.returncode == 0 and "lu (superlu)" in bench.report("package"), "-pc_factor_mat_solver_type wins")
    done = bench("run", "scene.yaml", "-o", "logged", "-log_view")
    expect(all(event in done.stdout for event in ("CableResidual", "CableFactor", "CableSolve")), "-log_view tells a step's parts")
    for option, value in (("-ts_type", "bdf"), ("-ts_alpha_radius", "1.5"), ("-cable_tangent", "wrong"), ("-cable_axial_dissipation", "0.7"),
                          ("-cable_elimination_limit", "-1"), ("-pc_type", "ul"), ("-ksp_type", "gmress"), ("-snes_type", "newton"),
                          ("-snes_linesearch_type", "basics"), ("-mat_type", "baji")):
        done = bench("run", "scene.yaml", "-o", "refused", option, value)
        expect(done.returncode == 2 and option in done.stderr and not (bench.folder / "refused").exists(),
               f"{option} {value} is refused")


def failures_are_told(bench):
    for ranks in (0, 2):
        done = bench("run", "scene.yaml", "-o", "failed", "-snes_max_it", "1", "-ts_max_reject", "0", ranks=ranks)
        expect(done.returncode == 3, f"a solver that cannot go on ends with 3 ({ranks} ranks)")
        expect(done.stderr.count("cablenet: error: at t = ") == 1 and "cable, element" in done.stderr,
               "and says when and where, once")
        last = bench.rows("failed")[-1]
        expect(f"at t = {float(last['time']):.9g} s" in done.stderr, "the last row is the last good state")
        expect("status: failed" in bench.report("failed"), "run.yaml says failed")
        (bench.folder / "blocked").write_text("a file where a folder is wanted")
        done = bench("run", "scene.yaml", "-o", "blocked", ranks=ranks)
        expect(done.returncode == 4 and done.stderr.count("cablenet: error: ") == 1, f"unwritable results end with 4 ({ranks} ranks)")
    done = bench("run", "absent.yaml", ranks=2)
    expect(done.returncode == 2 and done.stderr.count("cablenet: error: ") == 1, "wrong input ends with 2 on two ranks, said once")


def help_and_check(bench):
    before = sorted(bench.folder.iterdir())
    for words in (("--help",), ("run", "--help"), ("check", "--help"), ("schema", "--help"), ("schema",),
                  ("schema", "--markdown"), ("--version",), ("run", "-help")):
        done = bench(*words)
        expect(done.returncode == 0 and done.stdout, " ".join(words) + " prints")
    done = bench("check", "scene.yaml")
    expect(done.returncode == 0 and all(part in done.stdout for part in ("25 nodes", "24 elements", "0 bodies", "72 unknowns")),
           "check counts")
    expect(sorted(bench.folder.iterdir()) == before, "and writes nothing")
    schema = json.loads(bench("schema", ranks=2).stdout)
    expect(schema["properties"]["environment"]["properties"]["gravity"]["default"] == 9.80665,
           "the schema is printed once on two ranks")
    done = bench("schema", "-ts_dt", "1e-3")
    expect(done.returncode == 2 and "schema takes no option -ts_dt" in done.stderr, "schema takes no PETSc options")
    expect("schema" in bench("--help").stdout, "--help tells of the schema")


def stale_results(bench):
    (bench.folder / "mine.txt").write_text("")
    (bench.folder / "scene.out" / "mine.txt").write_text("kept")
    bench("run", "scene.yaml", "-ts_max_steps", "2")
    expect((bench.folder / "scene.out" / "mine.txt").read_text() == "kept", "a second run leaves strangers' files alone")
    expect(len(bench.rows("scene.out")) == 2, "and replaces its own")


def main():
    given = arguments(__doc__)
    (given.scratch / "scene.yaml").write_text(SCENE)
    bench = Bench(given.program, given.scratch)
    for part in (runs_and_results, petsc_options, failures_are_told, help_and_check, stale_results):
        part(bench)
    return status()


if __name__ == "__main__":
    sys.exit(main())
