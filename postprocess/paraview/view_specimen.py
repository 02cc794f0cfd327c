"""Show a run of Breccia in ParaView: particles as spheres coloured by damage, broken links as red lines.

In the window:     open OUTPUT/particles.pvd, then Macros > Import new macro... (once) > this file; run it.
                   Or start:  BRECCIA_OUTPUT=OUTPUT paraview --script=view_specimen.py
Without a window:  pvbatch view_specimen.py OUTPUT      writes OUTPUT/specimen.png of the last snapshot
"""

import os
import sys

from paraview import simple


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


def open_collection(folder, name):
    path = os.path.join(folder, name + ".pvd")
    if not os.path.isfile(path):
        sys.exit("view_specimen: there is no " + path + ". Name the output folder of a run.")
    return simple.PVDReader(registrationName=name, FileName=path)


def show_particles(particles, view):
    """Spheres of the true radius, coloured by damage from 0 to 1."""
    display = simple.Show(particles, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    display.ScaleByArray = 1
    display.SetScaleArray = ["POINTS", "radius"]
    display.UseScaleFunction = 0
    display.GaussianRadius = 1.0  # times the array
    simple.ColorBy(display, ("POINTS", "damage"))
    colours = simple.GetColorTransferFunction("damage")
    colours.ApplyPreset("Viridis (matplotlib)", True)
    colours.RescaleTransferFunction(0.0, 1.0)
    show_colour_bar(display, colours, view)
    display.Opacity = 0.35  # so that the cracks inside are seen


def show_colour_bar(display, colours, view):
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.Title = "Damage"
    bar.ComponentTitle = ""
    bar.TitleColor = bar.LabelColor = [0.0, 0.0, 0.0]
    bar.LabelFormat = bar.RangeLabelFormat = "%.1f"
    bar.WindowLocation = "Any Location"
    bar.Position = [0.9, 0.3]
    bar.ScalarBarLength = 0.4


def show_broken_links(links, view):
    """The links that broke, between the present places of their particles."""
    broken = simple.Threshold(registrationName="broken links", Input=links)
    broken.Scalars = ["CELLS", "broken"]
    broken.ThresholdMethod = "Between"
    broken.LowerThreshold = 0.5
    broken.UpperThreshold = 1.5
    display = simple.Show(broken, view)
    display.SetRepresentationType("Wireframe")
    display.ColorArrayName = ["POINTS", ""]  # one colour
    display.AmbientColor = [0.80, 0.15, 0.18]
    display.DiffuseColor = [0.80, 0.15, 0.18]
    display.LineWidth = 3.0


def look_from_above(view):
    """The whole specimen, z upwards, seen from the front, the right and a little above."""
    view.ViewSize = [1200, 1000]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraPosition = [0.5, -1.0, 0.35]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.ResetCamera(view)


def main():
    folder = output_folder()
    particles = open_collection(folder, "particles")
    links = open_collection(folder, "links")

    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = [0.0, 0.0, 0.0]
    show_particles(particles, view)
    show_broken_links(links, view)

    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    look_from_above(view)
    simple.Render(view)
    if len(sys.argv) > 1:
        simple.SaveScreenshot(os.path.join(folder, "specimen.png"), view)


main()
