"""Draws the cables of a run, coloured by tension or strain.  To be run by pvbatch, under jobs/with_xvfb.sh."""
import argparse
import pathlib
import sys

import numpy
from paraview import servermanager
from paraview import simple as pv
from vtkmodules.util.numpy_support import vtk_to_numpy

UNITS = {"tension": "N", "strain": "1"}
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}
FLAT = 0.05        # a structure thinner than this part of its second extent counts as planar
MARGIN = 1.12


def parse():
    parser = argparse.ArgumentParser(prog="pvbatch picture.py", description=__doc__)
    parser.add_argument("run", type=pathlib.Path, help="the folder that a run wrote")
    parser.add_argument("picture", type=pathlib.Path, help="the PNG to write")
    parser.add_argument("--time", default="last", help="seconds, or last (default)")
    parser.add_argument("--times", help="several times, drawn over each other: 0,0.5,last")
    parser.add_argument("--view", default="auto",
                        help="look along x, y, z, or along a vector x,y,z; default: across the plane the cables span, "
                             "obliquely where they span a volume")
    parser.add_argument("--colour", choices=UNITS, default="tension")
    parser.add_argument("--range", help="of the colours: low,high; default: all that occurs in the run")
    parser.add_argument("--width", type=float, default=4, help="of the cables in pixels")
    parser.add_argument("--size", default="1600x900")
    return parser.parse_args()


def nearest(steps, text):
    return steps[-1] if text == "last" else min(steps, key=lambda step: abs(step - float(text)))


def surface_at(reader, time):
    """The cables at one time as a source of their own, and their nodes as an array."""
    surface = pv.ExtractSurface(Input=reader)
    surface.UpdatePipeline(time)
    data = servermanager.Fetch(surface)
    frozen = pv.TrivialProducer()
    frozen.GetClientSideObject().SetOutput(data)
    frozen.UpdatePipeline()
    return frozen, vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def colour_range(reader, steps, field):
    ranges = []
    for step in steps:
        reader.UpdatePipeline(step)
        ranges.append(reader.CellData[field].GetRange())
    low, high = min(r[0] for r in ranges), max(r[1] for r in ranges)
    return (low, high) if high > low else (low - 0.5, low + 0.5)


def look_direction(points, wish):
    """A unit vector from the camera into the picture."""
    if wish in AXES:
        direction = numpy.array(AXES[wish], float)
    elif wish != "auto":
        direction = numpy.array([float(part) for part in wish.split(",")])
    else:
        _, extent, axes = numpy.linalg.svd(points - points.mean(axis=0), full_matrices=False)
        if extent[1] < 1e-6 * extent[0]:                     # one straight line: from the side, level
            direction = numpy.cross(axes[0], AXES["z"])
            if numpy.linalg.norm(direction) < 1e-6:
                direction = numpy.array(AXES["y"], float)
        elif extent[2] < FLAT * extent[1]:
            direction = axes[2]
        else:
            direction = numpy.array([-0.5, 0.75, -0.43])
        if direction @ (-0.3, 1, -0.6) < 0:                  # x to the right, from above rather than from below
            direction = -direction
    return direction / numpy.linalg.norm(direction)


def camera_axes(look):
    """Unit vectors to the right and upwards in the picture."""
    up = numpy.array(AXES["z"] if abs(look[2]) < 0.99 else AXES["y"], float)
    right = numpy.cross(look, up)
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(right, look)


def aim(view, points, look, size):
    """Parallel projection that holds every point; the size of a pixel in metres."""
    right, up = camera_axes(look)
    across, along, depth = points @ right, points @ up, points @ look
    centre = sum(axis * (part.min() + part.max()) / 2
                 for axis, part in ((right, across), (up, along), (look, depth)))
    reach = max(numpy.ptp(across), numpy.ptp(along), numpy.ptp(depth), 1e-9)
    # The colour bar needs the right sixth of the picture, the time the topmost tenth.
    scale = MARGIN * max(numpy.ptp(along) / 2 / 0.9, numpy.ptp(across) / 2 / 0.84 * size[1] / size[0], 1e-3 * reach)
    focus = centre + right * 0.08 * scale * size[0] / size[1] + up * 0.05 * scale
    view.CameraParallelProjection = 1
    view.CameraParallelScale = scale
    view.CameraFocalPoint = list(focus)
    view.CameraPosition = list(focus - 3 * reach * look)
    view.CameraViewUp = list(up)
    return 2 * scale / size[1]


def new_view(size):
    view = pv.CreateView("RenderView")
    view.ViewSize = list(size)
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0, 0, 0]
    return view


def label_format(colours):
    largest = max(abs(value) for value in colours)
    return "%.0f" if 20 <= largest < 1e6 else "%.3g"


def colour_table(view, field, colours):
    table = pv.GetColorTransferFunction(field)
    table.ApplyPreset("Viridis (matplotlib)", True)
    table.AutomaticRescaleRangeMode = "Never"
    table.RescaleTransferFunction(*colours)
    bar = pv.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = f"{field} [{UNITS[field]}]", ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = label_format(colours)
    bar.WindowLocation = "Any Location"
    bar.Position, bar.ScalarBarLength = [0.86, 0.2], 0.6
    return table


def draw(view, source, radius, table, field, colours):
    tube = pv.Tube(Input=source, Radius=radius, NumberofSides=10)
    shown = pv.Show(tube, view)
    pv.ColorBy(shown, ("CELLS", field))
    shown.LookupTable = table
    shown.Specular = 0
    shown.SetScalarBarVisibility(view, True)
    table.RescaleTransferFunction(*colours)                  # showing a part rescales to that part


def write_times(view, times):
    text = "t = " + ", ".join(f"{time:.4g}" for time in times) + " s"
    label = pv.Show(pv.Text(Text=text), view)
    label.Color, label.FontSize = [0, 0, 0], 20
    label.WindowLocation = "Upper Left Corner"


def main():
    options = parse()
    index = options.run / "cables.xmf"
    if not index.is_file():
        sys.exit(f"picture.py: {index} is not there: is {options.run} the folder of a finished run?")
    size = tuple(int(part) for part in options.size.split("x"))
    reader = pv.XDMFReader(FileNames=[str(index.resolve())])
    steps = list(reader.TimestepValues) or [0.0]
    times = [nearest(steps, text) for text in (options.times or options.time).split(",")]

    colours = colour_range(reader, steps, options.colour)
    if options.range:
        colours = tuple(float(part) for part in options.range.split(","))
    surfaces = [surface_at(reader, time) for time in times]
    points = numpy.vstack([nodes for _, nodes in surfaces])
    view = new_view(size)
    pixel = aim(view, points, look_direction(points, options.view), size)
    table = colour_table(view, options.colour, colours)
    for source, _ in surfaces:
        draw(view, source, 0.5 * options.width * pixel, table, options.colour, colours)
    write_times(view, times)
    options.picture.parent.mkdir(parents=True, exist_ok=True)
    pv.SaveScreenshot(str(options.picture), view, ImageResolution=list(size))
    print(f"{options.picture}: {len(points) // len(times)} nodes, "
          f"{options.colour} {colours[0]:.4g} .. {colours[1]:.4g} {UNITS[options.colour]}")


main()
