#!/usr/bin/env python3
"""Solids and coupled runs advanced step by step from Python: the bits of the program's runs, closed forms of bars, messages.

    steps_test.py FOLDER_OF_MODULE PROGRAM ROOT

Leaves with status 77, which the tests count as skipped, where the module or numpy is not there.
"""
import csv
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

folder_of_module, program, root = sys.argv[1:4]
scenes = os.path.join(root, "apps/scenes")
sys.path.insert(0, folder_of_module)
try:
    import numpy

    import breccia
except ImportError as missing:
    print(f"skipped: {missing}; ./breccia python builds the module")
    sys.exit(77)

SPHERES = os.path.join(scenes, "beam_and_spheres.prm")
CORE = os.path.join(scenes, "beam_with_core.prm")
BALL = os.path.join(scenes, "hertz_impact.prm")


def rows_of_program(scene, *changes):
    """Series of the program: rows as dictionaries of numbers by the name of the column."""
    with tempfile.TemporaryDirectory() as folder:
        words = [word for change in changes for word in ("-s", change)]
        out = os.path.join(folder, "out")
        subprocess.run([program, "run", scene, "-o", out, *words], check=True, capture_output=True)
        with open(os.path.join(out, "series.csv")) as table:
            names, *rows = csv.reader(line for line in table if not line.startswith("#"))
    names = [re.fullmatch(r"(\S+)(?: \[.*\])?", name).group(1) for name in names]
    return [dict(zip(names, map(float, row))) for row in rows]


class BarTest(unittest.TestCase):
    """A steel rod without lateral contraction: 0.5 m long, 60 elements."""

    scene = os.path.join(scenes, "bar_impact.prm")
    young, density, length = 200e9, 7850.0, 0.5
    speed = (young / density) ** 0.5

    def rod(self, **changes):
        slim = {
            "Mesh/Refinements": 0,
            "Mesh/Cylinder/Divisions": 200,
            "Materials/solid/isotropic elastic/Poisson ratio": 0,
            "Motion/Initial velocity x": 0,
        }
        return breccia.Scene(self.scene, {**slim, **changes}).solid()

    def test_steps_give_the_bits_of_a_run(self):
        changes = ["Mesh/Refinements=0", "Motion/End time=1e-4", "Output/Samples=20", "Output/Snapshots=0"]
        rows = rows_of_program(self.scene, *changes)
        solid = breccia.Scene(self.scene, dict(change.split("=") for change in changes)).solid()
        run = breccia.Scene(self.scene, dict(change.split("=") for change in changes)).run()
        per_sample = max(1, int(run.summary["cost"]["steps"]) // 20)
        for row in rows[:20]:
            solid.advance(per_sample)
            self.assertEqual(solid.values, {name: value for name, value in row.items() if name != "time"})
            self.assertAlmostEqual(solid.time / row["time"], 1, delta=1e-12)
        self.assertEqual(solid.units["reaction_left_x"], "N")

    def test_deformed_solid_gives_the_bits_of_a_run(self):
        changes = ["Mesh/Refinements=0", "Mesh/Cylinder/Divisions=20", "Model/Large displacement=true", "Motion/End time=1e-4",
                   "Output/Samples=5", "Output/Snapshots=0"]
        rows = rows_of_program(self.scene, *changes)
        solid = breccia.Scene(self.scene, dict(change.split("=") for change in changes)).solid()
        for k, row in enumerate(rows):
            solid.advance_to(1e-4 * ((k + 1) / 5))
            self.assertEqual(solid.time_step, solid.longest_step)
            self.assertEqual(solid.values, {name: value for name, value in row.items() if name != "time"})

    def test_steps_of_a_deformed_solid_are_as_long_as_is_stable(self):
        solid = self.rod(**{"Model/Large displacement": True, "Mesh/Cylinder/Divisions": 20})
        solid.advance()
        self.assertEqual(solid.time, solid.longest_step)

    def test_force_on_the_free_end_sends_the_wave_of_the_closed_form(self):
        # d'Alembert: sigma = F/A travels at c; behind its front the rod moves with v = sigma / (rho c), and the end has gone v t.
        solid = self.rod()
        solid.advance()  # central differences count what begins at the start itself for half a step
        end = solid.nodes("right")
        area = solid.mass.sum() / (self.density * self.length)  # of the mesh: a polygon for the circle
        stress = 1e6
        share = solid.mass[end] / solid.mass[end].sum()
        for node, part in zip(end, share):
            solid.add_force(int(node), (stress * area * part, 0, 0))
        solid.advance(int(0.7 * self.length / self.speed / solid.time_step))
        v = stress / (self.density * self.speed)
        self.assertAlmostEqual(solid.displacement[end, 0].mean() / (v * solid.time), 1, delta=0.01)
        behind = (solid.places[:, 0] > 0.45 * self.length) & (solid.places[:, 0] < 0.9 * self.length)
        ahead = solid.places[:, 0] < 0.2 * self.length
        self.assertAlmostEqual(solid.velocity[behind, 0].mean() / v, 1, delta=0.02)
        self.assertLess(abs(solid.velocity[ahead, 0]).max(), 0.01 * v)
        # Half of what the force has worked moves, half is stored.
        work = stress * area * solid.displacement[end, 0].mean()
        self.assertAlmostEqual(solid.values["energy_external"] / work, 1, delta=1e-2)
        self.assertAlmostEqual(solid.values["energy_kinetic"] / work, 0.5, delta=0.01)
        self.assertLess(solid.values["energy_balance_error"], 1e-9)

    def test_held_end_that_moves_is_held_by_rho_c_v_a(self):
        solid = self.rod()
        end = solid.nodes("right")
        group = solid.hold(end, (True, False, False))
        solid.set_velocity(group, (2.0, 0, 0))
        area = solid.mass.sum() / (self.density * self.length)
        found = []
        while solid.time < 0.8 * self.length / self.speed:
            solid.advance(5)
            found.append(solid.reaction(group)[0])
        held = numpy.mean(found[len(found) // 4 :])  # past the overshoot of the front
        self.assertAlmostEqual(held / (self.density * self.speed * 2.0 * area), 1, delta=0.01)
        numpy.testing.assert_allclose(solid.displacement[end, 0], 2.0 * solid.time, rtol=1e-12)
        self.assertTrue((solid.velocity[end, 0] == 2.0).all())

    def test_impulse_is_the_momentum_that_comes(self):
        solid = self.rod()
        node = int(solid.nodes("right")[0])
        solid.apply_impulse(node, (3.0, 0, 0))
        self.assertEqual(solid.velocity[node, 0], 3.0)
        given = 3.0 * solid.mass[node]
        solid.advance(3)
        self.assertAlmostEqual((solid.mass * solid.velocity[:, 0]).sum() / given, 1, delta=1e-9)  # the wall is far

    def test_saved_state_goes_on_to_the_same_bits_again(self):
        solid = self.rod()
        with self.assertRaisesRegex(RuntimeError, "no state"):
            solid.restore()
        node = int(solid.nodes("right")[0])
        solid.add_force(node, (100.0, 0, 0))
        solid.advance(50)
        solid.save()
        solid.advance(30)
        once, steps = solid.displacement, solid.steps
        solid.clear_forces()
        solid.restore()
        self.assertFalse(numpy.array_equal(solid.displacement, once))
        solid.advance(30)
        self.assertTrue(numpy.array_equal(solid.displacement, once))
        self.assertEqual(solid.steps, steps)
        solid.hold([node])
        with self.assertRaisesRegex(RuntimeError, "held since"):
            solid.restore()

    def test_mistakes_are_refused(self):
        solid = self.rod()
        with self.assertRaisesRegex(breccia.InputError, "middel.*left"):
            solid.nodes("middel")
        with self.assertRaisesRegex(IndexError, "from 0"):
            solid.add_force(10**6, (1, 0, 0))
        with self.assertRaisesRegex(IndexError, "no such group"):
            solid.reaction(3)
        with self.assertRaisesRegex(breccia.InputError, "prescribes its displacement along x"):
            solid.hold(solid.nodes("left"))
        with self.assertRaisesRegex(breccia.InputError, "stable up to"):
            solid.time_step = 1.0
        solid.time_step = 0.5 * solid.longest_step
        before = solid.time
        solid.advance()
        self.assertEqual(solid.time - before, 0.5 * solid.longest_step)
        with self.assertRaisesRegex(breccia.InputError, "Model/Analysis = static: only a solid in motion"):
            breccia.Scene(os.path.join(scenes, "cantilever.prm")).solid()
        with self.assertRaisesRegex(breccia.InputError, "Contacts"):
            breccia.Scene(os.path.join(scenes, "three_balls.prm")).solid()
        with self.assertRaisesRegex(breccia.InputError, "kind continuum"):
            breccia.Scene(SPHERES).solid()
        with self.assertRaisesRegex(breccia.InputError, "kind coupled"):
            breccia.Scene(self.scene).start()

    def test_other_threads_go_on_and_an_interrupt_ends_after_a_step(self):
        solid = self.rod()
        threading.Timer(0.4, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            solid.advance(10**9)
        self.assertLess(time.monotonic() - began, 5)
        steps = solid.steps
        self.assertEqual(solid.advance(2), 2)
        self.assertEqual(solid.steps, steps + 2)


class CoupledRunTest(unittest.TestCase):
    def compare_with_program(self, scene, changes, windows):
        rows = rows_of_program(scene, *(f"{path}={value}" for path, value in changes.items()))
        motion = breccia.Scene(scene, changes).start()
        self.assertEqual(motion.row, rows[0])
        while not motion.over:
            taken = motion.step(windows)
            self.assertTrue(taken == windows or motion.over)
        result = motion.result()
        self.assertTrue(result.complete)
        self.assertEqual(result.series.to_dict("records"), rows)
        self.assertGreater(motion.windows, len(rows))
        return motion, rows

    def test_surface_coupling_gives_the_bits_of_a_run(self):
        changes = {"Time/End time": 0.12, "Output/Samples": 24, "Output/Snapshots": 0}
        motion, rows = self.compare_with_program(SPHERES, changes, 7)
        forces = motion.interface_forces
        self.assertGreater(len(forces), 0)
        for name, force in forces.items():
            for axis, value in zip("xyz", force):
                self.assertEqual(value, rows[-1][f"{name.replace(' ', '_')}_force_{axis}"])

    def test_force_on_the_solid_is_what_particles_lose(self):
        motion = breccia.Scene(SPHERES, {"Output/Snapshots": 0, "Time/End time": 0.15}).start()
        motion.advance_to(0.08)  # nothing touches yet
        momentum, time, impulse = motion.particles.mass @ motion.particles.velocity, motion.time, 0
        while not motion.over:
            motion.step()
            impulse = impulse + motion.interface_forces["beam"] * (motion.time - time)
            time = motion.time
        lost = momentum - motion.particles.mass @ motion.particles.velocity
        self.assertGreater(lost[0], 100)
        numpy.testing.assert_allclose(impulse, lost, atol=1e-9 * lost[0])

    def test_volume_coupling_gives_the_bits_of_a_run(self):
        self.compare_with_program(CORE, {"Time/End time": 1e-4, "Output/Samples": 10, "Output/Snapshots": 0}, 3)

    def test_forces_from_outside_move_both_sides(self):
        # Before anything touches: F = m a of a sphere; the momentum of all is the impulse of the force.
        motion = breccia.Scene(SPHERES, {"Output/Snapshots": 0}).start()
        first = motion.particles.number.tolist().index(0)
        before = dict(motion.row)
        velocity, mass = motion.particles.velocity[first].copy(), motion.particles.mass[first]
        motion.add_force(0, (0, 0, 5 * mass))
        node = int(motion.nodes("front")[0])
        motion.add_node_force(node, (0, 0, 20.0))
        start = motion.time
        motion.advance_to(0.01)
        passed = motion.time - start
        self.assertAlmostEqual(motion.particles.velocity[first, 2] - velocity[2], 5 * passed, delta=5 * 1.01 * passed / 50)
        # The clamped end takes nothing yet: waves are slow in this soft beam.
        self.assertGreater(motion.displacement[node, 2], 0)
        gained = motion.row["momentum_z"] - before["momentum_z"]
        self.assertAlmostEqual(gained / (5 * mass * passed), 1, delta=0.05)
        motion.clear_forces()
        fast = motion.particles.velocity[first, 2]
        motion.step(5)
        self.assertAlmostEqual(motion.particles.velocity[first, 2] / fast, 1, delta=0.05)
        motion.apply_impulse(0, (0, 0, 1.5))
        kicked = motion.particles.velocity[first, 2]
        motion.step()
        self.assertAlmostEqual(motion.particles.velocity[first, 2], kicked, delta=1e-12)
        self.assertLess(abs(motion.row["energy_residual"]), 1e-6 * before["energy_particles_kinetic"])

    def test_stopped_run_goes_on_from_its_folder_to_the_same_bits(self):
        changes = {"Time/End time": 0.1, "Output/Samples": 10, "Output/Snapshots": 0}
        whole = breccia.Scene(SPHERES, changes).run()
        with tempfile.TemporaryDirectory() as folder:
            motion = breccia.Scene(SPHERES, changes).start(folder)
            motion.step(30)
            part = motion.stop()
            self.assertFalse(part.complete)
            self.assertIn("--resume", part.go_on)
            self.assertIs(motion.stop(), part)
            self.assertEqual(motion.step(), 0)
            again = breccia.Scene(SPHERES, changes).start(folder, resume=True)
            self.assertEqual(again.windows, 30)
            self.assertTrue(again.result().series.equals(whole.series))
            self.assertTrue(os.path.exists(os.path.join(folder, "summary.json")))

    def test_interrupt_leaves_the_run_where_it_can_go_on(self):
        motion = breccia.Scene(SPHERES, {"Output/Snapshots": 0}).start()
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            motion.result()
        self.assertFalse(motion.over)
        windows = motion.windows
        self.assertEqual(motion.step(3), 3)
        self.assertEqual(motion.windows, windows + 3)

    def test_interpreter_leaves_in_peace_with_all_of_them_in_its_variables(self):
        words = f"""
import sys
sys.path.insert(0, {folder_of_module!r})
import breccia
short = {{"Time/End time": 0.01, "Output/Snapshots": 0}}
result = breccia.Scene({SPHERES!r}, short).run()
motion = breccia.Scene({SPHERES!r}, short).start()
stopped = breccia.Scene({SPHERES!r}, short).start()
part = stopped.stop()
views = motion.particles
solid = breccia.Scene({BarTest.scene!r}).solid()
solid.advance()
"""
        done = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_mistakes_are_refused(self):
        motion = breccia.Scene(SPHERES).start()
        with self.assertRaisesRegex(IndexError, "particle 99"):
            motion.add_force(99, (0, 0, 1))
        with self.assertRaisesRegex(IndexError, "from 0"):
            motion.add_node_force(10**6, (0, 0, 1))
        with self.assertRaisesRegex(breccia.InputError, "nowhere"):
            motion.nodes("nowhere")
        with self.assertRaisesRegex(breccia.InputError, r"beam_and_spheres.prm|command line"):
            breccia.Scene(SPHERES, {"Time/End time": -1})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
