#!/usr/bin/env python3
"""Cells of particles from Python, alone and behind a foreign code that calls them as the Micro Manager of preCICE does.

    cells_test.py FOLDER_OF_MODULE PROGRAM ROOT

Leaves with status 77, which the tests count as skipped, where the module or numpy is not there.
"""
import copy
import csv
import json
import os
import pickle
import re
import subprocess
import sys
import tempfile
import unittest

folder_of_module, program, root = sys.argv[1:4]
sys.path.insert(0, folder_of_module)
try:
    import numpy

    import breccia
    import breccia.micro_manager
except ImportError as missing:
    print(f"skipped: {missing}; ./breccia python builds the module")
    sys.exit(77)

CONSTANTS = {
    "Normal modulus": 25e9,
    "Shear ratio": 0.2,
    "Limit elastic strain": 1e-4,
    "Relative ductility": 10,
    "Cohesion": 3e6,
    "Friction coefficient": 0.8,
}
TOWARDS = numpy.array([4e-4, -0.8e-4, -0.6e-4, 0.5e-4, -0.3e-4, 1e-4])  # many links damage on the way


def setUpModule():
    global FOLDER, PACKING, CELL
    FOLDER = tempfile.TemporaryDirectory()
    PACKING = os.path.join(FOLDER.name, "cell.h5")
    subprocess.run([program, "pack", "--count", "64", "--radius", "1e-3", "-o", PACKING], check=True, capture_output=True)
    CELL = breccia.Cell(PACKING, 1.5, "CPM", CONSTANTS)


def tearDownModule():
    FOLDER.cleanup()


class CellTest(unittest.TestCase):
    def walked(self, steps=5, of=5):
        cell = CELL.copy()
        for k in range(steps):
            cell.begin_step()
            cell.respond((k + 1) / of * TOWARDS)
            cell.commit()
        return cell

    def test_before_damage_the_tangent_is_the_stiffness_of_the_program(self):
        out = os.path.join(FOLDER.name, "moduli")
        words = ["--interaction-ratio", "1.5", "--normal-modulus", "25e9", "--shear-ratio", "0.2", "-o", out]
        subprocess.run([program, "homogenise", PACKING, *words], check=True, capture_output=True)
        with open(os.path.join(out, "homogenised.json")) as text:
            stiffness = numpy.array(json.load(text)["relaxed"]["stiffness"])
        answer = CELL.copy().respond(1e-3 * TOWARDS)
        numpy.testing.assert_allclose(answer.tangent, stiffness, atol=1e-8 * stiffness.max())
        numpy.testing.assert_allclose(answer.stress, stiffness @ (1e-3 * TOWARDS), rtol=1e-7)
        self.assertEqual(CELL.particles, 64)

    def test_tangent_is_the_derivative_of_the_stress(self):
        cell = self.walked(4)
        at = cell.strain + 0.05 * TOWARDS
        found = cell.respond(at)
        self.assertLess(found.tangent[0, 0], 0.95 * CELL.stiffness[0, 0])
        step = 1e-9
        for c in range(6):
            ahead, behind = (cell.respond(at + sign * step * numpy.eye(6)[c], tangent=False).stress for sign in (1, -1))
            numpy.testing.assert_allclose((ahead - behind) / (2 * step), found.tangent[:, c], atol=2e-4 * CELL.stiffness[0, 0])

    def test_work_is_stored_and_dissipated(self):
        coarse, fine = (self.walked(steps, steps).energies for steps in (40, 160))
        self.assertGreater(fine["damage"], 0.05 * fine["external_work"])
        self.assertGreater(fine["friction"], 0.02 * fine["external_work"])
        # What links lose while they slide is counted to first order in the steps.
        self.assertLess(abs(fine["residual"]), 0.01 * fine["external_work"])
        self.assertLess(abs(fine["residual"]), 0.5 * abs(coarse["residual"]))

    def test_state_goes_back_and_elsewhere_to_the_same_bits(self):
        cell = self.walked(3)
        state = pickle.loads(pickle.dumps(cell.state))
        once = cell.respond(TOWARDS).stress
        cell.commit()
        cell.state = state
        self.assertTrue((cell.respond(TOWARDS).stress == once).all())
        elsewhere = copy.deepcopy(CELL)
        elsewhere.state = state
        self.assertTrue((elsewhere.strain == 0.6 * TOWARDS).all())
        self.assertTrue((elsewhere.respond(TOWARDS).stress == once).all())
        self.assertTrue((CELL.strain == 0).all())

    def test_discs_answer_in_their_plane(self):
        scene = os.path.join(root, "meshes", "discs.txt")
        cell = breccia.Cell(scene, 1.5, "CPM", CONSTANTS, thickness=0.01)
        answer = cell.respond([1e-6, 0, 5, 5, 5, 0])
        self.assertGreater(answer.stress[0], 0)
        numpy.testing.assert_allclose(answer.tangent[:, 5], cell.stiffness[:, 5], atol=1e-8 * cell.stiffness[0, 0])
        self.assertTrue((numpy.linalg.eigvalsh(answer.tangent[numpy.ix_([0, 1, 5], [0, 1, 5])]) > 0).all())

    def test_mistakes_are_refused(self):
        with self.assertRaisesRegex(breccia.InputError, "none.h5"):
            breccia.Cell("none.h5", 1.5, "CPM", CONSTANTS)
        with self.assertRaisesRegex(breccia.InputError, "no periodic cell"):
            breccia.Cell(os.path.join(root, "meshes", "cylinder_packing.txt"), 1.5, "CPM", CONSTANTS)
        with self.assertRaisesRegex(breccia.InputError, "Normal modulus"):
            breccia.Cell(PACKING, 1.5, "CPM", {**CONSTANTS, "Normal modulus": -1})
        with self.assertRaisesRegex(breccia.InputError, "interaction_ratio"):
            breccia.Cell(PACKING, 0.5, "CPM", CONSTANTS)
        with self.assertRaisesRegex(breccia.InputError, "tolerance|Tolerance"):
            breccia.Cell(PACKING, 1.5, "CPM", CONSTANTS, tolerance=0)
        cell = CELL.copy()
        with self.assertRaisesRegex(breccia.InputError, "finite"):
            cell.respond([float("nan")] * 6)
        with self.assertRaisesRegex(breccia.InputError, "state: has 7 numbers"):
            cell.state = numpy.zeros(7)


SCENE = """
set Kind = continuum
subsection Model
  set Dimension = 3
end
subsection Mesh
  set Source = box
  subsection Box
    set Size        = 0.1, 0.1, 0.1
    set Divisions x = 2
    set Divisions y = 2
    set Divisions z = 2
  end
end
subsection Materials
  subsection solid
    set Law = cells
    subsection cells
      set When localised = go on
      subsection Specimen
        set Source            = file
        set File              = {packing}
        set Interaction ratio = 1.5
      end
      subsection Material
        set Law = CPM
        subsection CPM
          {constants}
        end
      end
    end
  end
end
subsection Boundary conditions
  {faces}
end
subsection Control
  set End          = 1
  set First step   = 0.2
  set Largest step = 0.2
end
"""


class MacroDouble:
    """A foreign code and the Micro Manager between, in one process: a block in homogeneous strain whose points are micro simulations.

    Every step is solved several times, as implicit coupling does: state kept, solved with a first guess of the strain, taken back, solved again.
    """

    def __init__(self, micro_class, points):
        self.points = [micro_class(number) for number in range(points)]
        self.first = [point.initialize() for point in self.points]

    def step(self, data, dt):
        kept = [pickle.loads(pickle.dumps(point.get_state())) for point in self.points]
        for point, guess in zip(self.points, (0.3, 1.4)):  # iterations that are taken back
            point.solve({name: guess * value for name, value in data.items()}, dt)
        for point, state in zip(self.points, kept):
            point.set_state(state)
        return [point.solve(data, dt) for point in self.points]


class MicroManagerTest(unittest.TestCase):
    def program_under(self, towards):
        """Stress (6) at the end of each step of the program, all faces of a block driven in homogeneous strain."""
        xx, yy, zz, yz, zx, xy = (repr(float(value)) for value in towards)
        motion = {
            "x": f"t*({xx}*x + {xy}*y)",  # the engineering shears, all in one of the two gradients
            "y": f"t*({yy}*y + {yz}*z)",
            "z": f"t*({zz}*z + {zx}*x)",
        }
        faces = "\n".join(
            f"subsection {face}\n" + "\n".join(f"set Displacement {axis} = {motion[axis]}" for axis in "xyz") + "\nend"
            for face in ("left", "right", "bottom", "top", "back", "front")
        )
        constants = "\n".join(f"set {name} = {value!r}" for name, value in CONSTANTS.items())
        scene, out = os.path.join(FOLDER.name, "block.prm"), os.path.join(FOLDER.name, "block")
        with open(scene, "w") as text:
            text.write(SCENE.format(packing=PACKING, constants=constants, faces=faces))
        done = subprocess.run([program, "run", scene, "-o", out], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(out, "series.csv")) as table:
            names, *rows = csv.reader(line for line in table if not line.startswith("#"))
        return [re.sub(r" \[.*", "", name) for name in names], [list(map(float, row)) for row in rows]

    def test_the_foreign_code_finds_the_work_of_the_programs_own_cells(self):
        # The work of the stress on the block: of the program, by its reactions; of the double, by stresses of its micro simulations.
        names, rows = self.program_under(TOWARDS)
        work = [row[names.index("energy_internal")] for row in rows]
        self.assertEqual(len(work), 5)
        double = MacroDouble(breccia.micro_manager.simulation_of(CELL), 2)
        volume, found, before = 0.1**3, 0.0, numpy.zeros(6)
        for k in range(5):
            strain = (k + 1) / 5 * TOWARDS
            answers = double.step({"strains1to3": strain[:3], "strains4to6": strain[3:]}, 1.0)
            stress = numpy.concatenate([answers[0]["stresses1to3"], answers[0]["stresses4to6"]])
            self.assertTrue((stress == numpy.concatenate([answers[1]["stresses1to3"], answers[1]["stresses4to6"]])).all())
            found += 0.5 * (stress + before) @ TOWARDS / 5 * volume
            before = stress
            self.assertAlmostEqual(found / work[k], 1, delta=1e-6)
        elastic = 0.5 * TOWARDS @ CELL.stiffness @ TOWARDS * volume
        self.assertLess(found, 0.9 * elastic)  # it has been damaged

    def test_iterations_that_are_taken_back_leave_no_trace(self):
        double = MacroDouble(breccia.micro_manager.simulation_of(CELL), 1)
        alone = CELL.copy()
        for k in range(3):
            strain = (k + 1) / 5 * TOWARDS
            (answer,) = double.step({"strains1to3": strain[:3], "strains4to6": strain[3:]}, 1.0)
            alone.begin_step()
            expected = alone.respond(strain)
            alone.commit()
            numpy.testing.assert_array_equal(numpy.concatenate([answer["stresses1to3"], answer["stresses4to6"]]), expected.stress)
            symmetric = 0.5 * (expected.tangent + expected.tangent.T)
            numpy.testing.assert_array_equal(breccia.micro_manager.tangent_of(answer), symmetric)

    def test_mandels_order_of_another_code_is_the_same_tensor(self):
        order = ("xx", "yy", "zz", "xy", "xz", "yz")
        other = breccia.micro_manager.simulation_of(CELL, order=order, mandel=True, strains="Strains", stresses="Stresses", tangent="Cmat")(7)
        root2 = 2**0.5
        xx, yy, zz, yz, zx, xy = TOWARDS
        mandel = numpy.array([xx, yy, zz, xy / root2, zx / root2, yz / root2])
        answer = other.solve({"Strains1to3": mandel[:3], "Strains4to6": mandel[3:]}, 1.0)
        expected = CELL.copy().respond(TOWARDS)
        numpy.testing.assert_allclose(answer["Stresses1to3"], expected.stress[:3], rtol=1e-9)
        numpy.testing.assert_allclose(answer["Stresses4to6"] / root2, expected.stress[[5, 4, 3]], rtol=1e-9)
        # stress power is the same number in both notations
        stress = numpy.concatenate([answer["Stresses1to3"], answer["Stresses4to6"]])
        self.assertAlmostEqual(stress @ mandel / (expected.stress @ TOWARDS), 1, delta=1e-12)
        # and so is the second variation by the tangent
        matrix = breccia.micro_manager.tangent_of(answer, "Cmat")
        self.assertAlmostEqual(mandel @ matrix @ mandel / (TOWARDS @ expected.tangent @ TOWARDS), 1, delta=1e-9)
        self.assertEqual(other.get_global_id(), 7)

    def test_mistakes_are_refused(self):
        with self.assertRaisesRegex(breccia.InputError, "expected each of"):
            breccia.micro_manager.simulation_of(CELL, order=("xx", "yy", "zz", "xy", "xy", "yz"))
        data = breccia.micro_manager.simulation_of(CELL, tangent="")(0).initialize()
        self.assertEqual(set(data), {"stresses1to3", "stresses4to6"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
