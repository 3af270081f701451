"""What ParaView reads from cables.xmf, against what h5py reads from result.h5: bit for bit, in both its XDMF readers.

paraview_read.py RUN                           checks a run
paraview_read.py --program P --scratch DIR     makes one first
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

import numpy

NODE_FIELDS = ("velocity", "tension_node")
CELL_FIELDS = ("tension", "strain")
MESH_FIELDS = ("cable_id", "rank")
READERS = {"XDMFReader": "FileNames", "Xdmf3ReaderS": "FileName"}
WITH_XVFB = pathlib.Path(__file__).resolve().parents[2] / "jobs" / "with_xvfb.sh"
SCENE = """
cable_types:
  rope: {mass_per_length: 0.1, axial_stiffness: 1.0e4}
points:
  pin: {position: [0, 0, 0], motion: fixed}
  tip: {position: [2.4, 0, 0]}
  free: {position: [1.2, 1.0, 0]}
cables:
  trunk: {type: rope, from: pin, to: tip, elements: 24}
  branch: {type: rope, from: {cable: trunk, at: 1.2}, to: free, elements: 7}
time: {end: 0.06, step: 1.0e-3}
output: {interval: 0}
"""


def make_run(program, scratch, ranks):
    from bench import ENVIRONMENT
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    (scratch / "scene.yaml").write_text(SCENE)
    subprocess.run(["mpirun", "-n", str(ranks), program, "run", scratch / "scene.yaml", "-o", scratch / "run"],
                   check=True, env=ENVIRONMENT)
    return scratch / "run"


def dump(run, target):
    """The run by h5py as one .npz: ParaView's process has an HDF5 library of its own."""
    import h5py
    with h5py.File(run / "result.h5", "r") as result:
        frames = [result["frames"][name] for name in sorted(result["frames"])]
        values = {name: result["mesh"][name][()] for name in ("lines", *MESH_FIELDS)}
        values["times"] = numpy.array([frame.attrs["time"] for frame in frames])
        for name in ("points", *NODE_FIELDS, *CELL_FIELDS):
            values[name] = numpy.stack([frame[name][()] for frame in frames])
    numpy.savez(target, **values)


def check(run):
    values = run / "paraview_read.npz"
    dump(run, values)
    try:
        done = subprocess.run([WITH_XVFB, "pvbatch", __file__, "--compare", values, run], stdout=subprocess.PIPE,
                              text=True, check=False)
    finally:
        values.unlink()
    print(done.stdout, end="")
    # ParaView can crash after the script's end, or end well without having run it.
    return 0 if done.returncode == 0 and "no difference" in done.stdout else 1


def same(given, expected):
    given = numpy.ascontiguousarray(given)
    return given.shape == expected.shape and given.dtype == expected.dtype and given.tobytes() == expected.tobytes()


def fields_of(grid):
    """Every array of a grid by the name that the run gives it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    fields = {"points": vtk_to_numpy(grid.GetPoints().GetData())}
    for data in (grid.GetPointData(), grid.GetCellData()):
        for index in range(data.GetNumberOfArrays()):
            fields[data.GetArrayName(index)] = vtk_to_numpy(data.GetArray(index))
    cells = grid.GetCells()
    ends = vtk_to_numpy(cells.GetOffsetsArray())
    if numpy.array_equal(ends, 2 * numpy.arange(len(ends))):
        fields["lines"] = vtk_to_numpy(cells.GetConnectivityArray()).astype(numpy.int32).reshape(-1, 2)
    return fields


def differences(reader, expected):
    from paraview import servermanager
    times = numpy.atleast_1d(numpy.array(reader.TimestepValues, dtype=float))
    if not same(times, expected["times"]):
        yield f"times: {times} instead of {expected['times']}"
        return
    for step, time in enumerate(times):
        reader.UpdatePipeline(time)
        fields = fields_of(servermanager.Fetch(reader))
        for name in expected:
            if name == "times":
                continue
            wanted = expected[name] if name in ("lines", *MESH_FIELDS) else expected[name][step]
            if name not in fields:
                yield f"step {step}: no {name}"
            elif not same(fields[name], wanted):
                yield f"step {step}: {name} differs"


def compare(run, values):
    """Inside pvbatch."""
    from paraview import simple
    expected = dict(numpy.load(values))
    count = 0
    for name, file_property in READERS.items():
        reader = getattr(simple, name)(**{file_property: [str(run / "cables.xmf")] if name == "XDMFReader"
                                          else str(run / "cables.xmf")})
        found = list(differences(reader, expected))
        print("\n".join(f"{name}: {text}" for text in found[:20]), end="\n" if found else "")
        count += len(found)
        print(f"{name}: {len(expected['times'])} steps, {expected['points'].shape[1]} nodes, "
              f"{len(expected['lines'])} cells; compared {', '.join(sorted(expected))}")
        simple.Delete(reader)
    print(f"{count} differences" if count else "no difference")
    return 1 if count else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", nargs="?", type=pathlib.Path, help="the folder that a run wrote")
    parser.add_argument("--program")
    parser.add_argument("--scratch", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, default=1, help="of the run it makes")
    parser.add_argument("--compare", type=pathlib.Path, help="for the script itself, inside pvbatch")
    given = parser.parse_args()
    if given.compare:
        return compare(given.run, given.compare)
    if not given.run and not (given.program and given.scratch):
        parser.error("give a run, or --program and --scratch")
    return check(given.run or make_run(given.program, given.scratch, given.ranks))


if __name__ == "__main__":
    sys.exit(main())
