"""Show a run of Breccia in ParaView: specimens of particles, solids, and transfers from one to the other.

In the window:     Macros > Import new macro... (once) > this file. Open a .pvd file of a run, then run the macro.
                   Or start:  BRECCIA_OUTPUT=OUTPUT paraview --script=view_run.py
Without a window:  pvbatch view_run.py OUTPUT [NAME]     writes OUTPUT/view_NAME.png of the last snapshot

What is there is found by itself; NAME (or BRECCIA_VIEW) chooses one of it, otherwise pvbatch draws all and the window shows
the first:

    tension, compression, cell    TEST_particles.pvd and TEST_links.pvd: spheres coloured by damage, links that are gone or have
                                  lost nearly all stiffness as red lines
    solid, continuation_000, ...  solid.pvd: elements coloured by damage (by stress, where nothing can be damaged), displaced
    coupled                       the solid and the particles that touch it, together
    transfer                      transfer.pvd: particles beside the mesh that took over, both coloured by damage
"""

import glob
import os
import sys
import xml.etree.ElementTree

from paraview import simple

# Every array that is shown: kind of file as doc/formats.md lists them, what it belongs to, name.
RADIUS = ("particles", "POINTS", "radius")
PARTICLE_DAMAGE = ("particles", "POINTS", "damage")
LINK_KIND = ("links", "CELLS", "kind")
LINK_DAMAGE = ("links", "CELLS", "damage")
DISPLACEMENT = ("solid", "POINTS", "displacement")
ELEMENT_DAMAGE = ("solid", "CELLS", "damage")
STRESS = ("solid", "POINTS", "stress")
TRANSFERRED_RADIUS = ("transferred particles", "POINTS", "radius")
TRANSFERRED_DAMAGE = ("transferred particles", "POINTS", "damage")

CONTACT = 1  # LINK_KIND
GONE = 0.95  # damage from which a link counts as a crack
RED = [0.80, 0.15, 0.18]
BLACK = [0.0, 0.0, 0.0]


def output_folder():
    """The folder on the command line, in BRECCIA_OUTPUT, or that of the collection which is open."""
    if len(sys.argv) > 1 and os.path.isdir(sys.argv[1]):
        return sys.argv[1]
    if "BRECCIA_OUTPUT" in os.environ:
        return os.environ["BRECCIA_OUTPUT"]
    for source in simple.GetSources().values():
        file_name = str(getattr(source, "FileName", ""))
        if file_name.endswith(".pvd"):
            return os.path.dirname(file_name)
    return os.getcwd()


def wanted_name():
    return sys.argv[2] if len(sys.argv) > 2 else os.environ.get("BRECCIA_VIEW", "")


def views_of(folder):
    """What can be shown: name -> function that shows it in a view, and returns what the camera looks at."""
    views = {}
    for path in sorted(glob.glob(os.path.join(folder, "*_particles.pvd"))):
        name = os.path.basename(path)[: -len("_particles.pvd")]
        views[name] = lambda view, name=name: show_specimen(folder, name, view)
    if os.path.isfile(os.path.join(folder, "transfer.pvd")):
        views["transfer"] = lambda view: show_transfer(folder, view)
    if os.path.isfile(os.path.join(folder, "coupled.pvd")):
        views["coupled"] = lambda view: show_coupled(folder, view)
    if os.path.isfile(os.path.join(folder, "solid.pvd")):
        views["solid"] = lambda view: show_solid(os.path.join(folder, "solid.pvd"), view)
    for path in sorted(glob.glob(os.path.join(folder, "continuation_*", "solid.pvd"))):
        name = os.path.basename(os.path.dirname(path))
        views[name] = lambda view, path=path: show_solid(path, view)
    return views


def open_collection(path):
    name = os.path.splitext(os.path.basename(path))[0]
    source = simple.PVDReader(registrationName=name, FileName=path)
    source.UpdatePipeline(source.TimestepValues[-1] if len(source.TimestepValues) > 0 else 0.0)
    return source


def has(source, field):
    """Whether the file has an array, which solids without damage do not."""
    data = source.CellData if field[1] == "CELLS" else source.PointData
    return field[2] in data.keys()


def array(field):
    return [field[1], field[2]]


def colour_by_damage(display, field, view):
    simple.ColorBy(display, tuple(array(field)))
    colours = simple.GetColorTransferFunction(field[2])
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(0.0, 1.0)
    show_colour_bar(display, colours, "Damage", view)


def show_colour_bar(display, colours, title, view):
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.Title = title
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = BLACK
    bar.WindowLocation = "Any Location"
    bar.Position = [0.88, 0.3]
    bar.ScalarBarLength = 0.4


def show_spheres(particles, radius, damage, opacity, view):
    """Spheres of the true radius, coloured by damage from 0 to 1."""
    display = simple.Show(particles, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.ScaleByArray = 1
    display.SetScaleArray = array(radius)
    display.UseScaleFunction = 0
    display.GaussianRadius = 1.0  # times the array
    display.Opacity = opacity
    colour_by_damage(display, damage, view)


def between(source, field, low, high, outside=False):
    part = simple.Threshold(Input=source)
    part.Scalars = array(field)
    part.ThresholdMethod = "Between"
    part.LowerThreshold = low
    part.UpperThreshold = high
    part.Invert = 1 if outside else 0
    return part


def show_specimen(folder, name, view):
    """Particles, half transparent, and the links that no longer hold, between the present places of their particles."""
    particles = open_collection(os.path.join(folder, name + "_particles.pvd"))
    show_spheres(particles, RADIUS, PARTICLE_DAMAGE, 0.35, view)
    links = open_collection(os.path.join(folder, name + "_links.pvd"))
    bonds = between(links, LINK_KIND, CONTACT - 0.5, CONTACT + 0.5, outside=True)
    gone = between(bonds, LINK_DAMAGE, GONE, 2.0)
    simple.RenameSource("links that no longer hold", gone)
    display = simple.Show(gone, view)
    display.SetRepresentationType("Wireframe")
    display.ColorArrayName = ["POINTS", ""]  # one colour
    display.AmbientColor = RED
    display.DiffuseColor = RED
    display.LineWidth = 3.0
    return particles


def extent_of(source):
    bounds = source.GetDataInformation().GetBounds()
    return [bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]]


def magnification(solid):
    """Round number that shows the largest displacement as a twentieth of the body; 1 where it is larger already."""
    if not has(solid, DISPLACEMENT):
        return 1.0
    largest = solid.PointData[DISPLACEMENT[2]].GetRange(-1)[1]
    wished = 0.05 * max(extent_of(solid)) / largest if largest > 0 else 1.0
    if wished <= 1.0:
        return 1.0
    digits = "%e" % wished
    return float(digits[0] + "e" + digits.split("e")[1])


def show_mesh(mesh, view):
    display = simple.Show(mesh, view)
    display.SetRepresentationType("Surface With Edges")
    display.EdgeColor = [0.45, 0.45, 0.45]
    if has(mesh, ELEMENT_DAMAGE):
        colour_by_damage(display, ELEMENT_DAMAGE, view)
    else:
        simple.ColorBy(display, (STRESS[1], STRESS[2], "Magnitude"))
        display.RescaleTransferFunctionToDataRange(False, True)
        show_colour_bar(display, simple.GetColorTransferFunction(STRESS[2]), "Size of the stress tensor [Pa]", view)


def show_solid(path, view, factor=None):
    """Elements, displaced and magnified, or by a factor."""
    solid = open_collection(path)
    warped = simple.WarpByVector(Input=solid)
    warped.Vectors = array(DISPLACEMENT)
    warped.ScaleFactor = factor or magnification(solid)
    simple.RenameSource("displacements x %g" % warped.ScaleFactor, warped)
    warped.UpdatePipeline()
    show_mesh(warped, view)
    return warped


def show_coupled(folder, view):
    """Both sides where they are."""
    solid = show_solid(os.path.join(folder, "solid.pvd"), view, 1.0)
    show_specimen(folder, "particles", view)
    return solid


def parts_of(path):
    """The files of a collection by the name of their part, in time."""
    parts = {}
    for entry in xml.etree.ElementTree.parse(path).iter("DataSet"):
        parts.setdefault(entry.get("name"), []).append(os.path.join(os.path.dirname(path), entry.get("file")))
    return parts


def show_transfer(folder, view):
    """The last state handed over: particles, and beside them the mesh that took over."""
    parts = parts_of(os.path.join(folder, "transfer.pvd"))
    particles = simple.XMLPolyDataReader(registrationName="particles", FileName=parts["particles"][-1:])
    particles.UpdatePipeline()
    show_spheres(particles, TRANSFERRED_RADIUS, TRANSFERRED_DAMAGE, 1.0, view)
    if "mesh" not in parts:
        return particles
    mesh = simple.XMLUnstructuredGridReader(registrationName="mesh", FileName=parts["mesh"][-1:])
    mesh.UpdatePipeline()
    aside = [0.0, 0.0, 0.0]
    size = extent_of(mesh)
    across = min(range(3), key=lambda c: size[c] if size[c] > 0 else max(size))  # beside its longest side
    aside[across] = -1.4 * size[across]
    moved = simple.Transform(registrationName="mesh, moved aside", Input=mesh)
    moved.Transform.Translate = aside
    moved.UpdatePipeline()
    show_mesh(moved, view)
    return moved


def look_at(body, view):
    """The whole body: a plane one from the front, another with z upwards from the front, the right and a little above."""
    view.ViewSize = [1200, 1000]
    size = extent_of(body)
    is_plane = size[2] < 1e-6 * max(size)
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraPosition = [0.0, 0.0, 1.0] if is_plane else [0.5, -1.0, 0.35]
    view.CameraViewUp = [0.0, 1.0, 0.0] if is_plane else [0.0, 0.0, 1.0]
    simple.ResetCamera(view)
    simple.GetActiveCamera().Zoom(0.9)  # spheres are larger than their centres


def prepare(view):
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = BLACK


def go_to_end():
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()


def main():
    folder = output_folder()
    views = views_of(folder)
    if not views:
        sys.exit("view_run: " + folder + " holds no .pvd files of a run. Name its output folder.")
    if wanted_name() and wanted_name() not in views:
        sys.exit("view_run: there is no " + wanted_name() + ", but " + ", ".join(views) + ".")
    chosen = [wanted_name()] if wanted_name() else list(views)
    is_batch = len(sys.argv) > 1
    for name in chosen if is_batch else chosen[:1]:
        view = simple.CreateView("RenderView") if is_batch else simple.GetActiveViewOrCreate("RenderView")
        prepare(view)
        simple.SetActiveView(view)
        body = views[name](view)
        go_to_end()
        look_at(body, view)
        simple.Render(view)
        if is_batch:
            simple.SaveScreenshot(os.path.join(folder, "view_" + name + ".png"), view)
            simple.Delete(view)
    print("view_run: this run has " + ", ".join(views) + "; the name of one after the folder, or BRECCIA_VIEW, chooses it.")


main()
