"""The scripts of this folder share mpirun's environment, scenes, and the arguments that ctest gives."""
import argparse
import csv
import os
import pathlib
import shutil
import subprocess

# tests/parallel/resume_test.cpp runs these scenes, too.
SCENES = pathlib.Path(__file__).resolve().parent / "scenes"

# mpirun may run as root, with more ranks than cores, on a busy machine.  ctest sets the same variables.
ENVIRONMENT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe", "OMPI_MCA_mpi_yield_when_idle": "1",
               "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "HWLOC_COMPONENTS": "-gl", **os.environ}


def arguments(description):
    """Reads --program and --scratch.  The scratch folder is new and empty."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", type=pathlib.Path, required=True)
    given = parser.parse_args()
    shutil.rmtree(given.scratch, ignore_errors=True)
    given.scratch.mkdir(parents=True)
    return given


failures = []


def expect(truth, text):
    print(("ok    " if truth else "FAIL  ") + text)
    if not truth:
        failures.append(text)


def status():
    """The exit status of a script that has expected all it wants."""
    print(f"{len(failures)} failures")
    return 1 if failures else 0


class Bench:
    """Starts the program in a folder.  bench("run", "scene.yaml", ranks=2)"""

    def __init__(self, program, folder, timeout=60):
        self.program, self.folder, self.timeout = program, folder, timeout

    def __call__(self, *words, ranks=0, **variables):
        launcher = ["mpirun", "-n", str(ranks)] if ranks else []
        return subprocess.run([*launcher, self.program, *map(str, words)], cwd=self.folder, capture_output=True, text=True,
                              timeout=self.timeout, env={**ENVIRONMENT, **variables}, check=False)

    def rows(self, run):
        with open(self.folder / run / "history.csv", encoding="utf-8") as table:
            return list(csv.DictReader(table))

    def report(self, run):
        return (self.folder / run / "run.yaml").read_text(encoding="utf-8")
