"""Tests of the installed module: python -m unittest packaging/test_candela.py"""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path

import numpy as np

import candela

SCENE = """
Camera "perspective" "float fov" 40
Sampler "independent" "integer pixelsamples" 4
Film "rgb" "integer xresolution" 24 "integer yresolution" 16
WorldBegin
LightSource "distant" "rgb L" [ 2 2 2 ]
Material "diffuse" "rgb reflectance" [ 0.2 0.4 0.6 ]
Translate 0 0 5
Shape "sphere"
"""


class Scenes(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory(prefix="candela test ")
        self.folder = Path(self._folder.name)
        self.addCleanup(self._folder.cleanup)

    def scene(self, text=SCENE, name="a scene.pbrt"):
        path = self.folder / name
        path.write_text(text)
        return path

    def test_arrays_have_the_image_and_its_layers(self):
        image = candela.render(self.scene(), spp=8, aov=["albedo", "depth"])
        self.assertEqual((image.height, image.width), (16, 24))
        self.assertEqual(image.rgb.shape, (16, 24, 3))
        self.assertEqual(image.rgb.dtype, np.float32)
        self.assertEqual(np.asarray(image).shape, (16, 24, 3))
        np.testing.assert_allclose(image["albedo"][8, 12], [0.2, 0.4, 0.6], rtol=0.05)
        self.assertAlmostEqual(float(image["depth"][8, 12]), 4, delta=0.1)
        self.assertEqual(image.metadata["samplesPerPixel"], "8")
        self.assertIn("albedo", image)
        with self.assertRaisesRegex(KeyError, "the layers are rgb"):
            image["nothing"]

    def test_the_same_pixels_are_in_an_image_file(self):
        pfm = self.folder / "x.pfm"
        image = candela.render(self.scene(), spp=2, outfile=pfm)
        data = pfm.read_bytes()
        values = np.frombuffer(data[-4 * image.rgb.size :], "<f4").reshape(image.rgb.shape)
        np.testing.assert_array_equal(values[::-1], image.rgb)

    def test_options_are_those_of_the_program(self):
        scene = self.scene()
        a = candela.render(scene, spp=1, seed=1)
        b = candela.render(scene, spp=1, seed=1, nthreads=1, sampler=None)
        c = candela.render(scene, spp=1, seed=2, cropwindow=(0, 0.5, 0, 1))
        np.testing.assert_array_equal(a.rgb, b.rgb)
        self.assertEqual(c.width, 12)
        self.assertEqual(c.window, (0, 0, 24, 16))

    def test_errors_have_message_and_place(self):
        scene = self.scene(SCENE + 'Shape "spere"\n')
        with self.assertRaises(candela.SceneError) as caught:
            candela.render(scene)
        error = caught.exception
        self.assertIn("spere", str(error))
        self.assertEqual(error.line, 1 + SCENE.count("\n"))
        self.assertEqual(Path(error.file), scene)
        self.assertEqual(error.problems[0].severity, "error")
        self.assertEqual(error.problems[0].number, "E0401")
        self.assertEqual(candela.check(scene)[0].line, error.line)
        with self.assertRaises(candela.SceneError) as caught:
            candela.render(self.folder / "missing.pbrt")
        self.assertIn("missing.pbrt", str(caught.exception))

    def test_options_that_do_not_exist_are_usage_errors(self):
        with self.assertRaisesRegex(candela.UsageError, "sppp"):
            candela.render(self.scene(), sppp=3)
        with self.assertRaises(candela.UsageError):
            candela.render(self.scene(), debug=True)

    def test_warnings_are_pythons(self):
        scene = self.scene(SCENE.replace('"float fov" 40', '"float fov" 40 "float fow" 1'))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            candela.render(scene, spp=1)
        self.assertTrue(any("fow" in str(w.message) for w in caught))
        self.assertTrue(all(w.category is candela.CandelaWarning for w in caught))

    def test_progress_is_told_and_may_end_the_rendering(self):
        scene = self.scene(SCENE.replace("24", "480").replace("16", "320"))
        seen = []

        class Enough(Exception):
            pass

        def listener(progress):
            seen.append(progress.done)
            if progress.done > 0:
                raise Enough

        with self.assertRaises(Enough):
            candela.render(scene, spp=10_000, progress=listener)
        self.assertEqual(seen, sorted(seen))
        self.assertTrue(0 < seen[-1] < 1)

    @unittest.skipIf(os.name == "nt", "signals")
    def test_keyboard_interrupt_ends_the_program(self):
        scene = self.scene(SCENE.replace("24", "480").replace("16", "320"))
        timer = threading.Timer(4, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        started = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            candela.render(scene, spp=10_000_000)
        self.assertLess(time.monotonic() - started, 30)

    @unittest.skipIf(os.name == "nt", "signals")
    def test_a_killed_process_takes_the_program_with_it(self):
        scene = self.scene(SCENE.replace("24", "480").replace("16", "320"))
        image = Path(scene).with_name("killed.exr")
        render = f"candela.run({str(scene)!r}, '--spp', '10000000', '--outfile', {str(image)!r})"
        parent = subprocess.Popen([sys.executable, "-c", f"import candela; {render}"])

        def alive():
            listed = subprocess.run(["ps", "-eo", "args"], capture_output=True, text=True).stdout
            # The program, not the parent
            return any(str(image) in line and "-cp" in line for line in listed.splitlines())

        self.addCleanup(parent.kill)
        deadline = time.monotonic() + 60
        while not alive() and time.monotonic() < deadline:
            time.sleep(0.2)
        self.assertTrue(alive())
        parent.kill()
        parent.wait()
        while alive() and time.monotonic() < deadline:
            time.sleep(0.2)
        self.assertFalse(alive())

    def test_the_command_is_the_program(self):
        command = [sys.executable, "-m", "candela", "--version"]
        out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        self.assertEqual(out.rstrip("\n"), candela.version())
        self.assertTrue(out.startswith("candela "))


if __name__ == "__main__":
    unittest.main()
