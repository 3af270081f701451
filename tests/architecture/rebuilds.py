"""The rebuild rule: after the edit of a physics kernel, few files are compiled.  Any file may include data headers."""
import argparse
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
FILES = 15


def included_files(path, headers):
    """The project's files that a file names in its own include lines."""
    for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        for target in (path.parent / name, *(top / name for top in headers)):
            if target.is_file():
                yield target.resolve()
                break


def reachable(path, headers, known):
    """All files of the project that the compiler reads when it compiles `path`."""
    found, waiting = set(), [path.resolve()]
    while waiting:
        file = waiting.pop()
        if file in found:
            continue
        found.add(file)
        if file not in known:
            known[file] = list(included_files(file, headers))
        waiting += known[file]
    return found


def users_of_headers(root):
    """{header: sources that are compiled anew when it changes}, for all sources under src/ and tests/."""
    headers = [root / "include", root / "tests"]
    users, known = {}, {}
    for source in sorted([*(root / "src").rglob("*.cpp"), *(root / "tests").rglob("*.cpp")]):
        for file in reachable(source, headers, known):
            users.setdefault(file, []).append(source.relative_to(root))
    return users


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--rooms", nargs="+", required=True, help="whose headers are kernels, but for those of --data")
    parser.add_argument("--data", nargs="+", required=True, help="headers as room/name.hpp")
    options = parser.parse_args()
    root = options.root.resolve()
    top = root / "include" / "cablenet"
    users, bad = users_of_headers(root), 0
    data = {top / name for name in options.data}
    kernels = [path for room in options.rooms for path in sorted((top / room).glob("*.hpp")) if path not in data]
    for path in kernels:
        sources = users.get(path, [])
        good = len(sources) <= FILES
        bad += not good
        print(f"{'ok      ' if good else 'FAILED  '}{path.relative_to(top)}: {len(sources)} files (at most {FILES})")
        if not good:
            print("".join(f"          {source}\n" for source in sources), end="")
    for path in sorted(path for path in data if not path.is_file()):
        bad += 1
        print(f"FAILED  {path.relative_to(top)}: there is no such header")
    print(f"{len(kernels)} kernels, {bad} complaints")
    return 1 if bad or not kernels else 0


if __name__ == "__main__":
    sys.exit(main())
