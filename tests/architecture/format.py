"""The format rule: clang-format would change nothing in include, src and tests."""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys

SKIPPED = 77
STYLED_BY = 14


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    root = parser.parse_args().root
    program = shutil.which("clang-format")
    if not program:
        print("skipped: clang-format is not installed")
        return SKIPPED
    version = re.search(r"version (\d+)", subprocess.run([program, "--version"], capture_output=True, text=True).stdout)
    if not version or int(version[1]) != STYLED_BY:
        print(f"skipped: the sources are laid out by clang-format {STYLED_BY}; other versions differ in details")
        return SKIPPED
    files = sorted(str(path) for top in ("include", "src", "tests") for suffix in ("hpp", "cpp")
                   for path in (root / top).rglob(f"*.{suffix}"))
    command = [program, "--style=file", "--dry-run", "--Werror"]
    result = subprocess.run([*command, *files], capture_output=True, text=True)
    places = re.findall(r"^(.+?:\d+):\d+: error:", result.stderr, re.MULTILINE)
    print("\n".join(dict.fromkeys(places)) or result.stderr)
    print(f"{len(files)} files; to mend: clang-format -i FILE")
    return 1 if result.returncode or not files else 0


if __name__ == "__main__":
    sys.exit(main())
