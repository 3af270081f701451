"""The program refuses every scene in broken/ with exit status 2 and one message that names the line, and writes
nothing.

A scene's first line is its expectation: `# expect: LINE | TEXT | TEXT ...`.
"""
import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys

BROKEN = pathlib.Path(__file__).resolve().parent / "broken"
NOISE = ("PETSC ERROR", "terminate called", "MPI_ABORT", "Segmentation", "Traceback")


def run(program, arguments, folder):
    """The finished process, started in `folder`, which is new and empty."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=60)


def complaints(done, folder, parts, most_lines):
    """A list of texts that say what is wrong with a refusal."""
    lines = [line for line in done.stderr.splitlines() if line.strip()]
    found = []
    if done.returncode != 2:
        found.append(f"exit status {done.returncode}, not 2")
    if not 1 <= len(lines) <= most_lines:
        found.append(f"{len(lines)} lines on stderr, not 1..{most_lines}")
    if done.stdout.strip():
        found.append(f"stdout says {done.stdout.strip()[:200]!r}")
    found += [f"no {part!r}" for part in parts if part not in done.stderr]
    found += [f"stderr holds {noise!r}" for noise in NOISE if noise in done.stderr]
    found += [f"{path.name} was written" for path in folder.iterdir()]
    return found


def expectation(scene):
    """The texts that the message about `scene` must hold."""
    head = scene.read_text().split("\n", 1)[0]
    assert head.startswith("# expect: "), f"{scene.name}: the first line is no expectation"
    line, *parts = head[len("# expect: "):].split(" | ")
    return ["cablenet: error: ", f"{scene.name}:{int(line)}: ", *parts]


def scene_cases():
    for scene in sorted(BROKEN.glob("*.yaml")):
        parts = expectation(scene)
        yield f"run {scene.name}", ["run", str(scene), "-o", "out"], parts, 1
        yield f"check {scene.name}", ["check", str(scene)], parts, 1


def command_line_cases():
    yield "no such file", ["run", "absent.yaml"], ["absent.yaml"], 3
    yield "no such file to check", ["check", "absent.yaml"], ["absent.yaml"], 3
    yield "a directory", ["run", str(BROKEN)], [BROKEN.name], 3
    yield "a directory to check", ["check", str(BROKEN)], [BROKEN.name], 3
    yield "no command", [], [], 3
    yield "unknown command", ["walk", str(BROKEN / "absent.yaml")], [], 3
    yield "no scene", ["run"], [], 3


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--scratch", required=True, type=pathlib.Path)
    options = parser.parse_args()
    cases = [*scene_cases(), *command_line_cases()]
    assert len(cases) >= 90, f"only {len(cases)} cases found in {BROKEN}"

    def refused(case):
        number, (name, arguments, parts, most_lines) = case
        folder = options.scratch.resolve() / str(number)
        done = run(options.program, arguments, folder)
        return [f"{name}: {text}\n    {done.stderr.strip()[:600]}"
                for text in complaints(done, folder, parts, most_lines)]

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failures = [text for texts in pool.map(refused, enumerate(cases)) for text in texts]
    print("\n".join(failures))
    print(f"{len(cases)} cases, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
