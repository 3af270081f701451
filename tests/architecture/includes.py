"""The include rule: a file includes its own room and rooms to its left."""
import argparse
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]')
MACHINERY_HEADER = re.compile(r"(.*/)?(mpi|petsc\w*|parmetis|metis|hdf5\w*|H5\w*)\.h|petsc/.*")
BANNED_PAIRS = {("solve", "output"): "solve does not know output: app hands it observers"}
SUFFIXES = {".hpp", ".h", ".cpp", ".cc", ".c"}


def source_files(top):
    return sorted(path for path in top.rglob("*") if path.suffix in SUFFIXES) if top.is_dir() else []


def room_of(path, top):
    """The room of a file, which is the first folder under top; None for a file that lies in no room."""
    parts = path.relative_to(top).parts
    return parts[0] if len(parts) > 1 else None


def included_room(kind, name, path, top):
    """The room that an include leads to; None for a header of another project."""
    if name.startswith("cablenet/"):
        parts = name.split("/")
        return parts[1] if len(parts) > 2 else ""
    if kind == '"':
        target = (path.parent / name).resolve()
        if target.is_relative_to(top.resolve()):
            return room_of(target, top.resolve()) or ""
    return None


def complaint_about(kind, name, path, top, room, physics, rooms):
    if room in physics and MACHINERY_HEADER.fullmatch(name):
        return f"<{name}>: the physics rooms ({' '.join(physics)}) know no MPI, PETSc, METIS or HDF5"
    target = included_room(kind, name, path, top)
    if target is None or target == room:
        return None
    if target not in rooms:
        return f"{name}: '{target}' is no room; the rooms are {' '.join(rooms)}"
    if rooms.index(target) > rooms.index(room):
        return f"{name}: room {room} lies left of {target}; a file includes its own room and rooms to its left"
    if (room, target) in BANNED_PAIRS:
        return f"{name}: {BANNED_PAIRS[room, target]}"
    return None


def complaints_in(path, top, physics, rooms):
    room = room_of(path, top)
    if room not in rooms:
        yield f"{path}: lies in no known room; the rooms are {' '.join(rooms)}"
        return
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            complaint = complaint_about(match[1], match[2], path, top, room, physics, rooms)
            if complaint:
                yield f"{path}:{number}: {complaint}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--physics", nargs="+", required=True, help="rooms without MPI and PETSc, left to right")
    parser.add_argument("--machinery", nargs="+", required=True, help="the rooms to their right, left to right")
    options = parser.parse_args()
    rooms = options.physics + options.machinery
    tops = [options.root / "include" / "cablenet", options.root / "src"]
    files = [(path, top) for top in tops for path in source_files(top)]
    complaints = [text for path, top in files for text in complaints_in(path, top, options.physics, rooms)]
    print("\n".join(complaints + [f"{len(files)} files, {len(complaints)} complaints"]))
    return 1 if complaints or not files else 0


if __name__ == "__main__":
    sys.exit(main())
