"""Installs the build into a prefix of its own; what lies there must run without the source and the build folder."""
import pathlib
import shutil
import subprocess
import sys

from bench import ENVIRONMENT, arguments

DOCUMENTS = ("README.md", "LICENSE")


def complaints(build, prefix, folder):
    done = subprocess.run(["cmake", "--install", build, "--prefix", prefix], capture_output=True, text=True)
    if done.returncode:
        yield f"cmake --install fails: {done.stderr}"
        return
    documents = prefix / "share" / "doc" / "cablenet"
    for name in DOCUMENTS:
        if not (documents / name).is_file():
            yield f"{documents / name} is missing"
    scene = documents / "examples" / "elastic_catenary" / "scene.yaml"
    done = subprocess.run([prefix / "bin" / "cablenet", "run", scene, "-o", folder / "run"], cwd=folder, env=ENVIRONMENT,
                          capture_output=True, text=True)
    if done.returncode or not (folder / "run" / "run.yaml").is_file():
        yield f"the installed program exits with {done.returncode} on {scene}: {done.stdout}{done.stderr}"
    done = subprocess.run([prefix / "bin" / "cablenet", "chart", scene, "-o", folder / "chart"], cwd=folder, env=ENVIRONMENT,
                          capture_output=True, text=True)
    if done.returncode or not (folder / "chart" / "chart.png").is_file():
        yield f"the installed program's chart exits with {done.returncode} on {scene}: {done.stdout}{done.stderr}"
    shutil.rmtree(prefix / "share" / "cablenet")
    done = subprocess.run([prefix / "bin" / "cablenet", "chart", scene], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 2 or str(prefix / "share" / "cablenet" / "chart") not in done.stderr:
        yield f"without its Python part the chart exits with {done.returncode} and says {done.stderr}"


def main():
    given = arguments(__doc__)
    found = list(complaints(pathlib.Path(given.program).parent, given.scratch / "prefix", given.scratch))
    print("\n".join(found) or "installed, and runs")
    if not found:
        shutil.rmtree(given.scratch)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
