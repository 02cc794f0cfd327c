#!/usr/bin/env python3
"""The Python module: answers to the bits of the program, entries as a dictionary, messages, callbacks, interrupts.

    module_test.py FOLDER_OF_MODULE PROGRAM ROOT

Leaves with status 77, which the tests count as skipped, where the module, numpy or pandas is not there.
"""
import csv
import json
import os
import pathlib
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
    import pandas  # noqa: F401

    import breccia
except ImportError as missing:
    print(f"skipped: {missing}; ./breccia python builds the module")
    sys.exit(77)

BALL = os.path.join(scenes, "bouncing_sphere.prm")
PRISM = os.path.join(scenes, "quick_uniaxial.prm")
SOLID = os.path.join(scenes, "cantilever.prm")


def program_refuses(*arguments):
    """What the program says of what it does not take."""
    done = subprocess.run([program, *arguments], capture_output=True, text=True)
    assert done.returncode == 2, done
    return done.stderr


def plain(text):
    """Without how a terminal breaks lines."""
    return " ".join(text.split())


class SceneTest(unittest.TestCase):
    def test_entries_are_a_dictionary(self):
        scene = breccia.Scene(PRISM)
        self.assertEqual(scene["Material/CPM/Cohesion"], 3e6)
        self.assertEqual(scene["Specimen/Box size"], (0.03, 0.03, 0.07))
        self.assertEqual(scene["Kind"], "uniaxial")
        self.assertIs(scene["Loading/Grip lateral motion blocked"], True)
        self.assertEqual(scene.unit("Material/CPM/Cohesion"), "Pa")
        scene["Material/CPM/Cohesion"] = 1e7 / 3  # every bit of it
        scene["Specimen/Box size"] = numpy.array([0.01, 0.02, 0.03])
        self.assertEqual(scene["Material/CPM/Cohesion"], 1e7 / 3)
        scene["Material/CPM/Cohesion"] = "2e6 Pa"
        self.assertEqual(scene["Material/CPM/Cohesion"], 2e6)
        self.assertEqual(scene["Specimen/Box size"], (0.01, 0.02, 0.03))
        del scene["Material/CPM/Cohesion"]
        self.assertEqual(scene["Material/CPM/Cohesion"], 3e6)
        self.assertIn("Time/Damping", scene)
        self.assertNotIn("Time/Dampings", scene)

    def test_mistakes_are_refused_in_the_words_of_the_terminal(self):
        scene = breccia.Scene(PRISM)
        for path, value in [("Material/CPM/Cohesion", -1), ("Material/CPM/Cohesoin", 3e6), ("Specimen/Source", "moon")]:
            scene[path] = value
            with self.assertRaises(breccia.InputError) as refused:
                scene.check()
            said = program_refuses("check", PRISM, "-s", f"{path}={value}")
            self.assertIn(plain(str(refused.exception)), plain(said))
            del scene[path]
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "wrong.prm"
            file.write_text(pathlib.Path(BALL).read_text().replace("= 2500", "= -2500"))
            with self.assertRaises(breccia.InputError) as refused:
                breccia.Scene(file)
            self.assertRegex(str(refused.exception), r"wrong\.prm:\d+: .*Density = -2500")
            self.assertIsInstance(refused.exception, ValueError)
            with self.assertRaisesRegex(breccia.InputError, "none.prm"):
                breccia.Scene(pathlib.Path(folder) / "none.prm")


class RunTest(unittest.TestCase):
    def test_answers_are_those_of_the_program_to_the_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "run", BALL, "-o", folder], check=True, capture_output=True)
            with open(os.path.join(folder, "series.csv")) as table:
                rows = list(csv.reader(line for line in table if not line.startswith("#")))
            with open(os.path.join(folder, "summary.json")) as text:
                summary = json.load(text)
        result = breccia.Scene(BALL).run()
        self.assertTrue(result.complete)
        self.assertEqual(result.folder, "")
        for c, header in enumerate(rows[0]):
            name, unit = re.fullmatch(r"(\S+)(?: \[(.*)\])?", header).groups("")
            self.assertEqual(result.series[name].tolist(), [float(row[c]) for row in rows[1:]])
            self.assertEqual(result.series.attrs["units"][name], unit)
        self.assertEqual(result.summary["figures"], summary["figures"])
        for path, figure in result.figures.items():
            self.assertEqual(figure, result.figure(path))
        self.assertLess(result.balance_error, 1e-3)
        with self.assertRaisesRegex(breccia.InputError, "there is no figure"):
            result.figure("height of the moon")

    def test_arrays_are_views_that_outlive_the_result(self):
        result = breccia.Scene(BALL).run()
        times = result.columns["time"]
        self.assertFalse(times.flags.writeable)
        self.assertFalse(times.flags.owndata)
        last = float(result.series["time"].iloc[-1])
        del result
        self.assertEqual(times[-1], last)

    def test_particles_of_the_end(self):
        scene = breccia.Scene(PRISM, {"Loading/Tests": "tension", "Output/Snapshots": 0})
        result = scene.run()
        particles = result.particles(-1)
        n = len(particles.radius)
        self.assertEqual(particles.position.shape, (n, 3))
        self.assertGreater(n, 500)
        self.assertAlmostEqual(particles.radius.max(), scene["Specimen/Generator/Particle radius"], delta=1e-12)
        # Each broken link has two ends.
        self.assertEqual(particles.broken_links.sum(), 2 * result.series["broken_links"].iloc[-1])
        self.assertGreater(particles.damage.max(), 0.5)
        with self.assertRaises(IndexError):
            result.particles(0)
        links = result.links()
        last = result.series.iloc[-1]
        self.assertEqual((links.kind == 2).sum() + (links.kind == 0).sum(), result.series["links"].max())
        self.assertEqual((links.kind == 1).sum(), last["contacts"])
        self.assertLess(links.ends.max(), n)
        self.assertTrue((links.ends[:, 0] != links.ends[:, 1]).all())
        bonds = links.kind == 0
        # A particle's damage is the mean of those of its links; and what bonds have lost, the account has.
        self.assertGreater(links.damage[bonds].max(), 0.9)
        self.assertAlmostEqual(links.dissipated.sum() / last["energy_damage"], 1, delta=1e-9)
        self.assertIsNone(breccia.Scene(SOLID).run().links())

    def test_callback_sees_every_row_and_stops_the_run(self):
        rows = []
        whole = breccia.Scene(BALL).run(on_sample=rows.append)
        self.assertEqual([row["time"] for row in rows], whole.series["time"].tolist())
        stopped = breccia.Scene(BALL).run(on_sample=lambda row: row["time"] >= rows[5]["time"])
        self.assertFalse(stopped.complete)
        self.assertEqual(len(stopped.series), 6)
        with tempfile.TemporaryDirectory() as folder:
            scene = breccia.Scene(BALL)
            part = scene.run(folder, on_sample=lambda row: row["time"] >= rows[5]["time"])
            self.assertIn("--resume", part.go_on)
            self.assertTrue(scene.run(folder, resume=True).series.equals(whole.series))

        def fails(row):
            raise KeyError("in the callback")

        with self.assertRaisesRegex(KeyError, "in the callback"):
            breccia.Scene(BALL).run(on_sample=fails)

    def test_other_threads_go_on_while_it_computes(self):
        counted, over = [0], threading.Event()

        def count():
            while not over.is_set():
                counted[0] += 1
                time.sleep(0.001)

        beside = threading.Thread(target=count)
        scene = breccia.Scene(PRISM, {"Loading/Tests": "tension", "Output/Snapshots": 0})
        scene.run()  # its packing is kept from now on
        beside.start()
        before = counted[0]
        scene.run()
        during = counted[0] - before
        over.set()
        beside.join()
        self.assertGreater(during, 20)

    def test_interrupt_saves_and_the_run_goes_on_to_the_same_bits(self):
        scene = breccia.Scene(PRISM, {"Loading/Tests": "tension", "Output/Snapshots": 0})
        whole = scene.run()
        with tempfile.TemporaryDirectory() as folder:

            def interrupts(row, seen=[]):
                seen.append(row)
                if len(seen) == 5:
                    os.kill(os.getpid(), signal.SIGINT)

            with self.assertRaisesRegex(KeyboardInterrupt, "--resume"):
                scene.run(folder, on_sample=interrupts)
            self.assertTrue(scene.run(folder, resume=True).series.equals(whole.series))

    def test_solid_runs_too(self):
        result = breccia.Scene(SOLID).run()
        self.assertGreater(result.figure("largest_displacement").value, 0)
        self.assertIsNone(result.particles())


class ParticlesTest(unittest.TestCase):
    """The ball of 10 mm on its way to the anvil, 5 mm below: particle 1 of the packing."""

    changes = {"Time/Damping": 0}

    def ball(self):
        particles = breccia.Scene(BALL, self.changes).particles()
        return particles, particles.number.tolist().index(1)

    def test_steps_give_the_bits_of_a_run_and_views_follow(self):
        rows = breccia.Scene(BALL).run().series
        particles, ball = self.ball()
        self.assertEqual(len(particles.links().kind), 0)
        height = particles.position
        self.assertFalse(height.flags.owndata)
        for row in range(1, 60, 7):
            while particles.time < rows["time"][row]:
                particles.advance()
            self.assertEqual(height[ball, 2], rows["height"][row])

    def test_force_from_outside_holds_a_ball_and_does_its_work(self):
        particles, ball = self.ball()
        weight = particles.mass[ball] * 9.81
        particles.add_force(1, (0, 0, weight))
        particles.advance(500)
        self.assertAlmostEqual(particles.velocity[ball, 2], 0, delta=1e-15)
        particles.clear_forces()
        particles.add_force(1, (2 * weight, 0, 0))
        start = particles.time
        particles.advance(500)
        # F = 2 m g from rest: x = g t^2, less or more half a step at either end; its work is F x.
        passed = particles.time - start
        self.assertAlmostEqual(particles.position[ball, 0] / (9.81 * passed**2), 1, delta=3e-3)
        self.assertAlmostEqual(
            particles.energies["external_work"] / (2 * weight * particles.position[ball, 0]), 1, delta=5e-3
        )
        self.assertLess(particles.energies["balance_error"], 1e-9)

    def test_impulse_throws_and_held_group_moves_as_prescribed(self):
        particles, ball = self.ball()
        particles.apply_impulse(1, (3, 0, 0))
        particles.advance(200)
        self.assertAlmostEqual(particles.position[ball, 0] / (3 * particles.time), 1, delta=1e-12)
        group = particles.hold([1])
        particles.set_velocity(group, (0, 0, 0.5))
        before, start = particles.position[ball].copy(), particles.time
        particles.advance(100)
        moved = particles.position[ball] - before
        self.assertAlmostEqual(moved[2], 0.5 * (particles.time - start), delta=1e-15)
        self.assertEqual(moved[0], 0)
        self.assertAlmostEqual(particles.reaction(group)[2] / (particles.mass[ball] * 9.81), 1, delta=1e-9)

    def test_saved_state_goes_on_to_the_same_bits_again(self):
        particles, ball = self.ball()
        with self.assertRaisesRegex(RuntimeError, "no state"):
            particles.restore()
        particles.advance(3000)
        particles.save()
        particles.advance(1500)
        once = particles.position.copy()
        particles.restore()
        self.assertNotEqual(particles.position[ball, 2], once[ball, 2])
        particles.advance(1500)
        self.assertTrue(numpy.array_equal(particles.position, once))
        particles.hold([1])
        with self.assertRaisesRegex(RuntimeError, "held since"):
            particles.restore()
        with self.assertRaises(IndexError):
            particles.add_force(2, (0, 0, 1))
        with self.assertRaises(IndexError):
            particles.hold([0, 2])
        with self.assertRaisesRegex(IndexError, "group 17"):
            particles.set_velocity(17, (0, 0, 1))
        with self.assertRaisesRegex(breccia.InputError, "kind particles"):
            breccia.Scene(SOLID).particles()

    def test_wrong_arguments_are_refused_with_what_was_found_and_is_expected(self):
        particles, nan = self.ball()[0], float("nan")
        for words, mistake in {
            r"force = \(0, 1\): expected three finite numbers": lambda: particles.add_force(0, (0, 1)),
            r"force = \(nan, 0, 0\): expected three finite": lambda: particles.add_force(0, (nan, 0, 0)),
            r"couple = 'abc': expected three finite": lambda: particles.add_force(0, (0, 0, 1), "abc"),
            r"change = 3: expected three finite": lambda: particles.apply_impulse(0, 3),
            r"particle = -1: expected a whole number from 0 on": lambda: particles.add_force(-1, (0, 0, 1)),
            r"particle = 1.5: expected a whole number": lambda: particles.apply_impulse(1.5, (0, 0, 1)),
            r"particles = 0: expected a list": lambda: particles.hold(0),
            r"along = \(True,\): expected 6 of True or False": lambda: particles.hold([0], (True,)),
            r"steps = -1: expected a whole number": lambda: particles.advance(-1),
            r"steps = '3': expected a whole number": lambda: particles.advance("3"),
            r"time_step = 'a': expected a finite number": lambda: setattr(particles, "time_step", "a"),
            r"changes = \['a=b'\]: expected a dictionary": lambda: breccia.Scene(BALL, ["a=b"]),
            r"on_sample = 5: expected a function": lambda: breccia.Scene(BALL).run(on_sample=5),
        }.items():
            with self.subTest(words), self.assertRaisesRegex(breccia.InputError, words):
                mistake()
        scene = breccia.Scene(BALL)
        with self.assertRaisesRegex(KeyError, "no entry Time/End tim. Did you mean Time/End time?"):
            scene["Time/End tim"]
        with self.assertRaisesRegex(KeyError, "has not been changed"):
            del scene["Time/End time"]
        self.assertNotIn("Time/End tim", scene)


def rows_of_program(command, constants, path):
    """What a driver of the terminal answers to a path, as rows of texts."""
    with tempfile.TemporaryDirectory() as folder:
        table, answer = os.path.join(folder, "path.csv"), os.path.join(folder, "answer.csv")
        with open(table, "w") as text:
            text.write(",".join(path) + "\n")
            text.writelines(",".join(map(repr, row)) + "\n" for row in zip(*(c.tolist() for c in path.values())))
        words = [word for name, value in constants.items() for word in ("-s", f"{name}={value!r}")]
        subprocess.run([program, *command, *words, "--path", table, "-o", answer], check=True)
        with open(answer) as text:
            return list(csv.reader(text))


def compare_with_rows(test, found, rows):
    test.assertEqual(len(found.columns), len(rows[0]))
    for c, name in enumerate(found.columns):
        unit = found.attrs["units"][name]
        test.assertEqual(rows[0][c], f"{name} [{unit}]" if unit else name)
        test.assertEqual(found[name].tolist(), [float(row[c]) for row in rows[1:]])


class LinkTest(unittest.TestCase):
    constants = {
        "Normal modulus": 25e9,
        "Shear ratio": 0.2,
        "Limit elastic strain": 1e-4,
        "Relative ductility": 30,
        "Cohesion": 3e6,
        "Friction coefficient": 0.8,
    }

    def test_answers_are_those_of_the_program_to_the_bit(self):
        self.compare_with_program(self.constants, 0)

    def test_rows_in_time_are_those_of_the_program_to_the_bit(self):
        lagging = {**self.constants, "Damage time": 100.0, "Damage rate exponent": 0.5}
        slow, quick = self.compare_with_program(lagging, 0), self.compare_with_program(lagging, 1e-2)
        self.assertGreater(quick["normal_stress"].max(), 1.05 * slow["normal_stress"].max())

    def compare_with_program(self, constants, row_time):
        path = {"normal_strain": numpy.linspace(0, 2e-3, 41), "shear_strain_1": numpy.linspace(0, 1e-4, 41)}
        found = breccia.link_test("CPM", constants, path, row_time=row_time)
        words = ["--row-time", repr(row_time)] if row_time > 0 else []
        compare_with_rows(self, found, rows_of_program(["link-test", "--law", "CPM", *words], constants, path))
        return found

    def test_mistakes_are_refused(self):
        with self.assertRaisesRegex(breccia.InputError, "CPM"):
            breccia.link_test("CPN", self.constants, {"normal_strain": [0.0]})
        with self.assertRaisesRegex(breccia.InputError, "Normal modulus"):
            breccia.link_test("CPM", {**self.constants, "Normal modulus": -1}, {"normal_strain": [0.0]})
        with self.assertRaisesRegex(breccia.InputError, "normal_strain"):
            breccia.link_test("CPM", self.constants, {"normal_strian": [0.0]})
        with self.assertRaisesRegex(breccia.InputError, "as many"):
            breccia.link_test("CPM", self.constants, {"normal_strain": [0.0], "shear_strain_1": [0.0, 1.0]})
        with self.assertRaisesRegex(breccia.InputError, "expected finite numbers"):
            breccia.link_test("CPM", self.constants, {"normal_strain": [0.0, float("nan")]})


class PointTest(unittest.TestCase):
    material = "damage-plastic concrete"
    constants = {
        "Young modulus": 30e9,
        "Poisson ratio": 0.2,
        "Compressive strength": 30e6,
        "Tensile strength": 3e6,
        "Fracture energy": 100,
        "Element size": 0.1,
    }
    uniaxial = {f"stress_{component}": numpy.zeros(41) for component in ("yy", "zz", "yz", "zx", "xy")}

    def test_answers_are_those_of_the_program_to_the_bit(self):
        path = {"strain_xx": numpy.linspace(0, 1e-3, 41), **self.uniaxial}
        found = breccia.point_test(self.material, self.constants, path)
        rows = rows_of_program(["point-test", "--material", self.material], self.constants, path)
        compare_with_rows(self, found, rows)
        self.assertAlmostEqual(found["stress_xx"].max() / 3e6, 1, delta=0.05)
        self.assertLess(found["stress_xx"].iloc[-1], 1.5e6)

    def test_an_elastic_point_obeys_hooke(self):
        constants = {"Young modulus": 30e9, "Poisson ratio": 0.2}
        found = breccia.point_test("isotropic elastic", constants, {"stress_xx": [1e6, 2e6], "stress_yy": [0, 0]})
        # without strain along z: plane strain
        numpy.testing.assert_allclose(found["strain_xx"], (1 - 0.2**2) / 30e9 * numpy.array([1e6, 2e6]), rtol=1e-12)
        numpy.testing.assert_allclose(found["stress_zz"], 0.2 * numpy.array([1e6, 2e6]), rtol=1e-12)
        self.assertEqual(found.attrs["units"]["stress_zz"], "Pa")

    def test_mistakes_are_refused(self):
        path = {"strain_xx": [1e-5]}
        for words, (material, constants, path) in {
            "damage-plastic concrete": ("damage-plastic concrte", self.constants, path),
            "Young modulus": (self.material, {**self.constants, "Young modulus": -1}, path),
            "Did you mean .strain_xx": (self.material, self.constants, {"strian_xx": [1e-5]}),
            "cannot both be given": (self.material, self.constants, {**path, "stress_xx": [0.0]}),
            "as many": (self.material, self.constants, {**path, "strain_yy": [0.0, 1.0]}),
            "expected finite numbers": (self.material, self.constants, {"strain_xx": [float("nan")]}),
            "path: .*no columns": (self.material, self.constants, {}),
        }.items():
            with self.subTest(words), self.assertRaisesRegex(breccia.InputError, words):
                breccia.point_test(material, constants, path)


class HomogeniseTest(unittest.TestCase):
    def test_stiffness_is_that_of_the_program_to_the_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            packing = os.path.join(folder, "cell.h5")
            subprocess.run([program, "pack", "--count", "300", "--radius", "1e-3", "-o", packing], check=True, capture_output=True)
            words = ["--interaction-ratio", "1.5", "--normal-modulus", "25e9", "--shear-ratio", "0.2"]
            out = os.path.join(folder, "out")
            subprocess.run([program, "homogenise", packing, *words, "-o", out], check=True, capture_output=True)
            with open(os.path.join(out, "homogenised.json")) as text:
                expected = json.load(text)
            found = breccia.homogenise(packing, 1.5, 25e9, 0.2)
            for way in ("statistics", "affine", "relaxed"):
                self.assertEqual(found[way]["E"], expected[way]["E"])
                self.assertEqual(found[way]["stiffness"].tolist(), expected[way]["stiffness"])
            self.assertLess(found["relaxed"]["E"], found["affine"]["E"])
            with self.assertRaisesRegex(breccia.InputError, "or a law"):
                breccia.homogenise(packing, 1.5)
            with self.assertRaisesRegex(breccia.InputError, "none.h5"):
                breccia.homogenise(os.path.join(folder, "none.h5"), 1.5, 25e9, 0.2)


class PageTest(unittest.TestCase):
    def names_of_example(self, page):
        """What the first example of a page leaves behind, which has fifteen lines at most."""
        example = re.search(r"```python\n(.*?)```", pathlib.Path(root, page).read_text(), re.S).group(1)
        self.assertLessEqual(len([line for line in example.splitlines() if line.strip()]), 15)
        found = {}
        with tempfile.TemporaryDirectory() as folder:
            here = os.getcwd()
            os.chdir(folder)
            os.symlink(os.path.join(root, "apps"), "apps")
            try:
                exec(compile(example, page, "exec"), found)
            finally:
                os.chdir(here)
        return found

    def test_examples_of_the_page_and_of_the_readme_run_in_fifteen_lines(self):
        strengths = self.names_of_example("doc/tutorials/python.md")["strengths"]
        self.assertEqual(list(strengths), [2e6, 3e6, 4e6])
        self.assertLess(strengths[2e6], strengths[4e6])
        self.assertEqual(self.names_of_example("README.md")["result"].figure("tensile_strength").value, strengths[3e6])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
