#!/usr/bin/env python3
"""Particles and solids as participants of preCICE, against a double of its interface in this process, which holds them to its rules.

    precice_test.py FOLDER_OF_MODULE PROGRAM ROOT

Leaves with status 77, which the tests count as skipped, where the module or numpy is not there.
"""
import importlib.util
import os
import subprocess
import sys
import unittest

folder_of_module, program, root = sys.argv[1:4]
sys.path.insert(0, folder_of_module)
try:
    import numpy

    import breccia
    import breccia.precice
except ImportError as missing:
    print(f"skipped: {missing}; ./breccia python builds the module")
    sys.exit(77)

BALL = os.path.join(root, "apps/scenes/bouncing_sphere.prm")
ROD = os.path.join(root, "apps/scenes/bar_impact.prm")


class Double:
    """The calls of preCICE 3 that an adapter makes, and another code behind it: answer(data, time) gives the data that the adapter reads next.

    iterations > 1: implicit coupling; each window is taken back until it has been solved so often. What preCICE forbids raises.
    """

    def __init__(self, answer, first, window, end, iterations=1, dimensions=3, wants_initial=False):
        self.answer, self.readable, self.window, self.end = answer, first, window, end
        self.iterations, self.dimensions, self.wants_initial = iterations, dimensions, wants_initial
        self.time, self.iteration, self.written, self.state = 0.0, 0, {}, "new"
        self.initial, self.windows, self.calls = None, [], 0
        self.must_write = self.must_read = False

    def get_mesh_dimensions(self, mesh):
        assert mesh == "Mesh"
        return self.dimensions

    def set_mesh_vertices(self, mesh, places):
        assert self.state == "new" and places.shape[1] == self.dimensions
        self.places = numpy.array(places)
        return numpy.arange(len(places)) + 100

    def requires_initial_data(self):
        assert self.state == "new"
        return self.wants_initial

    def initialize(self):
        assert self.state == "new" and bool(self.written) == self.wants_initial
        self.initial, self.written, self.state = self.written, {}, "running"
        self.must_write = self.iterations > 1

    def is_coupling_ongoing(self):
        assert self.state == "running"
        return self.time < self.end * (1 - 1e-9)

    def get_max_time_step_size(self):
        return self.window

    def requires_writing_checkpoint(self):
        needed, self.must_write = self.must_write, False
        return needed

    def requires_reading_checkpoint(self):
        needed, self.must_read = self.must_read, False
        return needed

    def read_data(self, mesh, name, ids, relative_time):
        assert self.state == "running" and mesh == "Mesh" and 0 <= relative_time <= self.window
        assert list(ids) == list(range(100, 100 + len(self.places)))
        assert not self.must_write and not self.must_read
        return numpy.array(self.readable[name])

    def write_data(self, mesh, name, ids, values):
        assert mesh == "Mesh" and len(ids) == len(self.places) and values.shape == self.places.shape
        self.written[name] = numpy.array(values)

    def advance(self, step):
        assert self.state == "running" and step == self.window and self.written
        assert not self.must_write and not self.must_read
        self.calls += 1
        self.iteration += 1
        used = self.readable
        self.readable = self.answer(self.written, self.time + self.window)
        if self.iteration < self.iterations:
            self.must_read = True
        else:
            self.iteration = 0
            self.time += self.window
            self.windows.append((used, self.written))
            self.must_write = self.iterations > 1 and self.is_coupling_ongoing()
        self.written = {}

    def finalize(self):
        assert self.state == "running" and not self.is_coupling_ongoing()
        self.state = "over"


def ball(velocity=(0.3, 0, 0)):
    """The ball of the scene without weight, on its way along x."""
    particles = breccia.Scene(BALL, {"Time/Damping": 0, "Gravity/Acceleration": (0, 0, 0)}).particles()
    particles.apply_impulse(1, velocity)
    return particles, particles.number.tolist().index(1)


class ParticlesTest(unittest.TestCase):
    def oscillate(self, windows_in_a_period, iterations=1):
        """A ball on the spring of another code: half a period. Displacements by the windows, and those of the closed form."""
        particles, row = ball()
        mass, period = particles.mass[row], 2e-3
        omega = 2 * numpy.pi / period
        stiffness = mass * omega**2
        interface = Double(
            lambda data, time: {"Force": -stiffness * data["Displacement"]},
            {"Force": numpy.zeros((1, 3))},
            period / windows_in_a_period,
            0.5 * period,
            iterations,
        )
        times = []
        breccia.precice.couple(interface, particles, "Mesh", [1], {"Force": "force"},
                               {"Displacement": "displacement", "Velocity": "velocity"}, lambda body: times.append(body.time))
        self.assertEqual(interface.state, "over")
        found = numpy.array([written["Displacement"][0] for _, written in interface.windows])
        return interface, numpy.array(times), found, 0.3 / omega * numpy.sin(omega * numpy.array(times)), particles

    def test_ball_on_a_spring_of_another_code_swings_as_in_closed_form(self):
        errors = []
        for windows in (400, 800):
            interface, times, found, exact, particles = self.oscillate(windows)
            self.assertLess(interface.window, particles.longest_step)
            self.assertEqual(len(times), windows // 2)
            errors.append(abs(found[:, 0] - exact).max() / exact.max())
            self.assertTrue((found[:, 1:] == 0).all())
        self.assertLess(errors[1], 1e-4)
        self.assertAlmostEqual(errors[0] / errors[1], 4, delta=0.1)  # a step a window: central differences

    def test_impulse_of_what_was_read_is_the_momentum_gained(self):
        interface, *_, particles = self.oscillate(200)
        row = particles.number.tolist().index(1)
        read = sum(used["Force"][0] for used, _ in interface.windows) * interface.window
        gained = particles.mass[row] * (particles.velocity[row] - (0.3, 0, 0))
        # velocities are half an own step back, and forces half a step short at both ends
        self.assertAlmostEqual(gained[0] / read[0], 1, delta=1e-3)

    def test_iterations_leave_what_the_last_of_them_was_and_nothing_else(self):
        interface, _, found, _, _ = self.oscillate(100, iterations=4)
        self.assertEqual(interface.calls, 4 * len(interface.windows))
        kept = [used["Force"] for used, _ in interface.windows]
        # The same forces without any iteration: the same bits.
        particles, _ = ball()
        forces = iter(kept[1:] + [kept[-1]])
        again = Double(lambda data, time: {"Force": next(forces)}, {"Force": kept[0]}, interface.window, interface.end)
        breccia.precice.couple(again, particles, "Mesh", [1], {"Force": "force"}, {"Displacement": "displacement"})
        once = numpy.array([written["Displacement"][0] for _, written in again.windows])
        self.assertTrue(numpy.array_equal(once, found))

    def test_led_ball_is_where_the_other_code_wants_it_and_says_what_that_takes(self):
        particles, row = ball((0, 0, 0))
        wanted = iter([[[1e-4 * k, 0, 0]] for k in range(2, 12)])
        interface = Double(lambda data, time: {"Displacement": next(wanted)}, {"Displacement": [[1e-4, 0, 0]]}, 1e-4, 1e-3, wants_initial=True)
        start = particles.position[row, 0]
        breccia.precice.couple(interface, particles, "Mesh", [1], {"Displacement": "displacement"}, {"Force": "force"})
        self.assertAlmostEqual((particles.position[row, 0] - start) / 1e-3, 1, delta=1e-9)
        self.assertTrue((interface.windows[-1][1]["Force"] == 0).all())  # nothing resists, and inertia does not count
        self.assertIn("Force", interface.initial)


class SolidTest(unittest.TestCase):
    young, density, length = 200e9, 7850.0, 0.5
    speed = (young / density) ** 0.5

    def rod(self):
        return breccia.Scene(ROD, {
            "Mesh/Refinements": 0,
            "Mesh/Cylinder/Divisions": 100,
            "Materials/solid/isotropic elastic/Poisson ratio": 0,
            "Motion/Initial velocity x": 0,
        }).solid()

    def test_led_end_takes_rho_c_v_a_and_iterations_do_not_matter(self):
        forces = []
        for iterations in (1, 3):
            solid = self.rod()
            end = solid.nodes("right")
            area = solid.mass.sum() / (self.density * self.length)
            velocity = {"Velocity": numpy.tile([2.0, 0, 0], (len(end), 1))}
            interface = Double(lambda data, time: velocity, velocity, 2e-6, 60e-6, iterations)
            breccia.precice.couple(interface, solid, "Mesh", end, {"Velocity": "velocity"}, {"Force": "force"})
            forces.append([written["Force"].sum(axis=0)[0] for _, written in interface.windows])
        self.assertAlmostEqual(numpy.mean(forces[0][10:]) / (-self.density * self.speed * 2.0 * area), 1, delta=0.01)
        self.assertEqual(forces[0], forces[1])

    def test_forces_on_nodes_keep_their_sum(self):
        solid = self.rod()
        end = solid.nodes("right")
        shares = solid.mass[end] / solid.mass[end].sum()
        force = {"Force": numpy.outer(shares, [1000.0, 0, 0])}
        interface = Double(lambda data, time: force, force, 2e-6, 60e-6)
        breccia.precice.couple(interface, solid, "Mesh", end, {"Force": "force"}, {"Velocity": "velocity", "Displacement": "displacement"})
        gained = (solid.mass * solid.velocity[:, 0]).sum()
        self.assertAlmostEqual(gained / (1000.0 * (solid.time - 0.5 * solid.time_step)), 1, delta=1e-6)  # the wall is far
        self.assertTrue((interface.places == solid.places[end]).all())

    def test_mpi_may_be_used_by_others_once_the_solid_is_made(self):
        make = f"import breccia; solid = breccia.Scene({ROD!r}).solid()"
        words = "import sys; sys.path.insert(0, {!r}); {}; {}".format
        env = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_plm": "isolated"}

        def left_by(first, then):
            return subprocess.run([sys.executable, "-c", words(folder_of_module, first, then)], capture_output=True, text=True, env=env)

        if importlib.util.find_spec("mpi4py") is None:
            self.skipTest("mpi4py is not here (Debian package python3-mpi4py)")
        after = left_by(make, "from mpi4py import MPI; solid.advance()")
        self.assertEqual((after.returncode, after.stderr), (0, ""))
        before = left_by("from mpi4py import MPI", make)
        self.assertEqual(before.returncode, 1)
        self.assertIn("InputError: MPI: has been started by another part", before.stderr)

    def test_mistakes_are_refused(self):
        solid = self.rod()
        for words, (reads, writes, carriers, body) in {
            "Read .force. and write": ({"F": "force"}, {"G": "force"}, [0], solid),
            "reads .heat. and writes nothing": ({"F": "heat"}, {}, [0], solid),
            "no carriers": ({"F": "force"}, {}, [], solid),
            "found dict": ({"F": "force"}, {}, [0], {}),
        }.items():
            with self.subTest(words), self.assertRaisesRegex(breccia.InputError, f"Mesh: .*{words}"):
                breccia.precice.couple(Double(None, {}, 1, 1), body, "Mesh", carriers, reads, writes)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
