"""Both XDMF readers of ParaView read from cables.xmf, and from bodies.xmf if a run has bodies, exactly what h5py reads
from result.h5.

paraview_read.py RUN                           checks a run
paraview_read.py --program P --scratch DIR     makes one first
"""
import argparse
import pathlib
import shutil
import subprocess
import sys

import numpy

# {index: ({ParaView's name: dataset of a frame}, {ParaView's name: dataset of the mesh})}.
INDICES = {
    "cables.xmf": ({"points": "points", "velocity": "velocity", "tension_node": "tension_node", "tension": "tension",
                    "strain": "strain"},
                   {"cells": "lines", "cable_id": "cable_id", "rank": "rank"}),
    "bodies.xmf": ({"points": "body_position", "velocity": "body_velocity", "quaternion": "body_quaternion",
                    "angular_velocity": "body_angular_velocity"},
                   {"cells": "body_vertices", "body_id": "body_vertices", "box": "body_box",
                    "box_attitude": "body_box_attitude"}),
}
READERS = {"XDMFReader": "FileNames", "Xdmf3ReaderS": "FileName"}
WITH_XVFB = pathlib.Path(__file__).resolve().parents[2] / "jobs" / "with_xvfb.sh"


def make_run(program, scratch, ranks):
    from bench import ENVIRONMENT, SCENES
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    subprocess.run(["mpirun", "-n", str(ranks), program, "run", SCENES / "paraview.yaml", "-o", scratch / "run"],
                   check=True, env=ENVIRONMENT)
    return scratch / "run"


def dump(run, index, target):
    """Writes what h5py reads for an index into one .npz file.  ParaView's process cannot use h5py, because it has an
    HDF5 library of its own."""
    import h5py
    frame_fields, mesh_fields = INDICES[index]
    with h5py.File(run / "result.h5", "r") as result:
        frames = [result["frames"][name] for name in sorted(result["frames"])]
        values = {name: result["mesh"][dataset][()] for name, dataset in mesh_fields.items()}
        values["times"] = numpy.array([frame.attrs["time"] for frame in frames])
        for name, dataset in frame_fields.items():
            values[name] = numpy.stack([frame[dataset][()] for frame in frames])
    if "body_id" in values:
        values["body_id"] = values["body_id"].ravel()        # the cells' column, read as a scalar
    numpy.savez(target, **values)


def check_index(run, index):
    values = run / "paraview_read.npz"
    dump(run, index, values)
    try:
        done = subprocess.run([WITH_XVFB, "pvbatch", __file__, "--compare", values, "--index", index, run],
                              stdout=subprocess.PIPE, text=True, check=False)
    finally:
        values.unlink()
    print(done.stdout, end="")
    # ParaView can crash after the script's end, or end without an error although it has not run the script.
    return done.returncode == 0 and "no difference" in done.stdout


def check(run):
    written = [index for index in INDICES if (run / index).exists()]
    if not written:
        print(f"{run}: neither {' nor '.join(INDICES)}")
    return 0 if written and all([check_index(run, index) for index in written]) else 1


def same(given, expected):
    given = numpy.ascontiguousarray(given)
    return given.shape == expected.shape and given.dtype == expected.dtype and given.tobytes() == expected.tobytes()


def fields_of(grid):
    """{name in the run: array} for all arrays of a grid."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    fields = {"points": vtk_to_numpy(grid.GetPoints().GetData())}
    for data in (grid.GetPointData(), grid.GetCellData()):
        for index in range(data.GetNumberOfArrays()):
            fields[data.GetArrayName(index)] = vtk_to_numpy(data.GetArray(index))
    cells = grid.GetCells()
    ends = vtk_to_numpy(cells.GetOffsetsArray())
    nodes_each = int(ends[1]) if len(ends) > 1 else 1
    if numpy.array_equal(ends, nodes_each * numpy.arange(len(ends))):
        connectivity = vtk_to_numpy(cells.GetConnectivityArray()).astype(numpy.int32)
        fields["cells"] = connectivity.reshape(-1, nodes_each)
    return fields


def differences(reader, expected, constant):
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
            wanted = expected[name] if name in constant else expected[name][step]
            if name not in fields:
                yield f"step {step}: no {name}"
            elif not same(fields[name], wanted):
                yield f"step {step}: {name} differs"


def compare(run, index, values):
    """Compares ParaView's arrays with h5py's.  This part runs inside pvbatch."""
    from paraview import simple
    expected = dict(numpy.load(values))
    count = 0
    for name, file_property in READERS.items():
        path = str(run / index)
        reader = getattr(simple, name)(**{file_property: [path] if name == "XDMFReader" else path})
        found = list(differences(reader, expected, INDICES[index][1]))
        print("\n".join(f"{name}: {text}" for text in found[:20]), end="\n" if found else "")
        count += len(found)
        print(f"{index} by {name}: {len(expected['times'])} steps, {expected['points'].shape[1]} nodes, "
              f"{len(expected['cells'])} cells; compared {', '.join(sorted(expected))}")
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
    parser.add_argument("--index", choices=INDICES, help="likewise")
    given = parser.parse_args()
    if given.compare:
        return compare(given.run, given.index, given.compare)
    if not given.run and not (given.program and given.scratch):
        parser.error("give a run, or --program and --scratch")
    return check(given.run or make_run(given.program, given.scratch, given.ranks))


if __name__ == "__main__":
    sys.exit(main())
