"""Draws the cables of a run, coloured by tension or strain, and its bodies as boxes.
pvbatch runs this script, under jobs/with_xvfb.sh."""
import argparse
import pathlib
import sys

import numpy
from paraview import servermanager
from paraview import simple as pv
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

UNITS = {"tension": "N", "strain": "1"}
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}
FLAT = 0.05        # a structure counts as planar if its third extent is less than this part of its second
MARGIN = 1.12
BODY_COLOUR = (0.91, 0.55, 0.26)       # viridis, the cables' colour map, does not have this colour
BODY_EDGE_COLOUR = (0.25, 0.13, 0.05)
SEEN = 0.015       # the longest edge of the largest body is at least this part of the picture's height
CORNERS = numpy.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))     # outward normals


def parse():
    parser = argparse.ArgumentParser(prog="pvbatch picture.py", description=__doc__)
    parser.add_argument("run", type=pathlib.Path, help="the folder that a run wrote")
    parser.add_argument("picture", type=pathlib.Path, help="the PNG to write")
    parser.add_argument("--time", default="last", help="seconds, or last (default)")
    parser.add_argument("--times", help="several times, drawn over each other: 0,0.5,last")
    parser.add_argument("--view", default="auto",
                        help="look along x, y, z, or along a vector x,y,z; default: across the plane that cables and "
                             "bodies span, obliquely where they span a volume")
    parser.add_argument("--colour", choices=UNITS, default="tension")
    parser.add_argument("--range", help="of the colours: low,high; default: all that occurs in the run")
    parser.add_argument("--width", type=float, default=4, help="of the cables in pixels")
    parser.add_argument("--bodies", type=float, metavar="SCALE",
                        help="enlarges the bodies; default: true size, or what it takes to see the largest")
    parser.add_argument("--size", default="1600x900")
    return parser.parse_args()


def nearest(steps, text):
    return steps[-1] if text == "last" else min(steps, key=lambda step: abs(step - float(text)))


def frozen(data):
    """A ParaView source that gives these data at any time."""
    source = pv.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def surface_at(reader, time):
    """The cables at one time as a ParaView source, and the positions of their nodes [m], (nodes, 3)."""
    surface = pv.ExtractSurface(Input=reader)
    surface.UpdatePipeline(time)
    data = servermanager.Fetch(surface)
    return frozen(data), vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def product(left, right):
    """The products of quaternions w x y z, row by row."""
    w, x = left[:, :1], left[:, 1:]
    v, y = right[:, :1], right[:, 1:]
    return numpy.hstack([w * v - numpy.sum(x * y, axis=1, keepdims=True), w * y + v * x + numpy.cross(x, y)])


def turned(quaternion, vectors):
    """Turns the vectors of each body, (bodies, 8, 3), from its own axes to the world's."""
    w, x = quaternion[:, None, :1], quaternion[:, None, 1:]
    return vectors + 2 * numpy.cross(x, numpy.cross(x, vectors) + w * vectors)


class Bodies:
    """The boxes of all bodies at one time."""
    def __init__(self, reader, time):
        reader.UpdatePipeline(time)
        data = servermanager.Fetch(reader)
        fields = {name: vtk_to_numpy(data.GetPointData().GetArray(name)).astype(float)
                  for name in ("quaternion", "box", "box_attitude")}
        self.centres = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        self.edges = fields["box"]
        attitude = product(fields["quaternion"], fields["box_attitude"])
        self.from_centres = turned(attitude, CORNERS * self.edges[:, None, :])

    def corners(self, scale):
        return (self.centres[:, None, :] + scale * self.from_centres).reshape(-1, 3)

    def surface(self, scale):
        """The boxes as a ParaView source, enlarged by `scale`."""
        faces = numpy.array(FACES)[None] + 8 * numpy.arange(len(self.centres))[:, None, None]
        cells = numpy.insert(faces.reshape(-1, 4), 0, 4, axis=1).ravel()
        points, polygons, boxes = vtkPoints(), vtkCellArray(), vtkPolyData()
        points.SetData(numpy_to_vtk(self.corners(scale), deep=True))
        polygons.ImportLegacyFormat(numpy_to_vtkIdTypeArray(cells, deep=True))
        boxes.SetPoints(points)
        boxes.SetPolys(polygons)
        return frozen(boxes)


def body_scale(bodies, wish, height):
    """The factor by which bodies are enlarged, in a picture whose height stands for `height` [m]."""
    if wish:
        return wish
    longest = max((instant.edges.max() for instant in bodies), default=0)
    return max(1.0, SEEN * height / longest) if longest > 0 else 1.0


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
        if extent[1] < 1e-6 * extent[0]:                     # one straight line is seen from the side, level
            direction = numpy.cross(axes[0], AXES["z"])
            if numpy.linalg.norm(direction) < 1e-6:
                direction = numpy.array(AXES["y"], float)
        elif extent[2] < FLAT * extent[1]:
            direction = axes[2]
        else:
            direction = numpy.array([-0.5, 0.75, -0.43])
        if direction @ (-0.3, 1, -0.6) < 0:                  # x points to the right, and the camera looks downwards
            direction = -direction
    return direction / numpy.linalg.norm(direction)


def camera_axes(look):
    """Unit vectors to the right and upwards in the picture."""
    up = numpy.array(AXES["z"] if abs(look[2]) < 0.99 else AXES["y"], float)
    right = numpy.cross(look, up)
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(right, look)


def aim(view, points, look, size):
    """Sets a parallel projection that shows every point.  @return the size of a pixel [m]"""
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
    table.RescaleTransferFunction(*colours)                  # because pv.Show rescales to the part that it shows


def draw_bodies(view, source):
    shown = pv.Show(source, view)
    shown.Representation = "Surface With Edges"
    shown.AmbientColor = shown.DiffuseColor = list(BODY_COLOUR)
    shown.EdgeColor, shown.LineWidth = list(BODY_EDGE_COLOUR), 2
    shown.Interpolation, shown.Ambient = "Flat", 0.3
    shown.Specular = 0


def write_times(view, times):
    text = "t = " + ", ".join(f"{time:.4g}" for time in times) + " s"
    label = pv.Show(pv.Text(Text=text), view)
    label.Color, label.FontSize = [0, 0, 0], 20
    label.WindowLocation = "Upper Left Corner"


def open_index(path):
    return pv.XDMFReader(FileNames=[str(path.resolve())]) if path.is_file() else None


def fit(view, surfaces, bodies, options, size):
    """Aims the camera at cables and bodies.
    @return the size of a pixel [m], and the factor by which bodies are enlarged"""
    def seen(scale):
        return numpy.vstack([nodes for _, nodes in surfaces] + [instant.corners(scale) for instant in bodies])
    look = look_direction(seen(1.0), options.view)
    scale = body_scale(bodies, options.bodies, size[1] * aim(view, seen(1.0), look, size))
    return aim(view, seen(scale), look, size), scale


def draw_cables(view, reader, surfaces, pixel, options):
    colours = colour_range(reader, list(reader.TimestepValues) or [0.0], options.colour)
    if options.range:
        colours = tuple(float(part) for part in options.range.split(","))
    table = colour_table(view, options.colour, colours)
    for source, _ in surfaces:
        draw(view, source, 0.5 * options.width * pixel, table, options.colour, colours)
    return (f"{len(surfaces[0][1])} nodes, "
            f"{options.colour} {colours[0]:.4g} .. {colours[1]:.4g} {UNITS[options.colour]}")


def main():
    options = parse()
    cables, boxes = (open_index(options.run / name) for name in ("cables.xmf", "bodies.xmf"))
    if not (cables or boxes):
        sys.exit(f"picture.py: {options.run / 'cables.xmf'} is not there: "
                 f"is {options.run} the folder of a finished run?")
    size = tuple(int(part) for part in options.size.split("x"))
    steps = list((cables or boxes).TimestepValues) or [0.0]
    times = [nearest(steps, text) for text in (options.times or options.time).split(",")]
    surfaces = [surface_at(cables, time) for time in times] if cables else []
    bodies = [Bodies(boxes, time) for time in times] if boxes else []

    view = new_view(size)
    pixel, scale = fit(view, surfaces, bodies, options, size)
    drawn = [draw_cables(view, cables, surfaces, pixel, options)] if cables else []
    for instant in bodies:
        draw_bodies(view, instant.surface(scale))
    if boxes:
        count = len(bodies[0].centres)
        drawn.append(f"{count} {'body' if count == 1 else 'bodies'} at {scale:.3g} times true size")
    write_times(view, times)
    options.picture.parent.mkdir(parents=True, exist_ok=True)
    pv.SaveScreenshot(str(options.picture), view, ImageResolution=list(size))
    print(f"{options.picture}: {', '.join(drawn)}")


main()
