"""Tests of the installed module: python -m unittest packaging/test_candela.py"""

import contextlib
import copy
import io
import os
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from pathlib import Path
from unittest import mock
from xml.etree import ElementTree

import numpy as np

import candela
from candela import Transform

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


XML = """<scene version="3.0.0">
  <!-- a ball under a sky -->
  <sensor type="perspective">
    <transform name="to_world"><lookat origin="0, 0, -5" target="0, 0, 0" up="0, 1, 0"/></transform>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/></film>
  </sensor>
  <bsdf type="diffuse" id="red"><rgb name="reflectance" value="0.8, 0.2, 0.1"/></bsdf>
  <shape type="sphere" id="ball"><ref id="red"/></shape>
  <emitter type="constant"/>
</scene>
"""


# Where a volume fills Mitsuba's cube
UNIT_CUBE = candela.Transform().translate([-1, -1, -1]).scale(2)


def mitsuba():
    """The scene of XML, as Mitsuba's load_dict takes it."""
    return {
        "type": "scene",
        "sensor": {
            "type": "perspective",
            "to_world": Transform().look_at(origin=[0, 0, -5], target=[0, 0, 0], up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": 24, "height": 16},
        },
        "red": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.8, 0.2, 0.1]}},
        "ball": {"type": "sphere", "bsdf": {"type": "ref", "id": "red"}},
        "sky": {"type": "constant"},
    }


class InMemory(unittest.TestCase):
    """Scenes that are no files."""

    def test_a_dict_and_a_text_are_the_same_scene(self):
        a = candela.load_dict(mitsuba()).render(spp=4)
        b = candela.load_string(XML).render(spp=4)
        np.testing.assert_allclose(a.rgb, b.rgb, rtol=1e-5)
        self.assertEqual(a.rgb.shape, (16, 24, 3))

    def test_a_text_in_pbrts_format_is_that_of_a_file(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            file = Path(folder) / "a.pbrt"
            file.write_text(SCENE)
            np.testing.assert_array_equal(
                candela.load_string(SCENE).render().rgb, candela.load_file(file).render().rgb
            )

    def test_names_of_a_text_have_the_values_of_define(self):
        scene = candela.load_string(SCENE.replace("0.2 0.4 0.6", "$red 0.4 $blue"))
        a = scene.render(spp=1, define={"red": 0.2, "blue": 0.6})
        np.testing.assert_array_equal(a.rgb, candela.load_string(SCENE).render(spp=1).rgb)
        b = scene.render(spp=1, define={"red": 0.4, "blue": 0.6})
        (problem,) = candela.check(scene, define={"blue": 0.6})
        self.assertIn("found `$red`, which has no value (define={'red': …} sets it)", problem.text)
        # Colours become spectra: other channels change a little
        self.assertGreater(b.rgb[8, 12, 0], 1.5 * a.rgb[8, 12, 0])
        np.testing.assert_allclose(b.rgb[8, 12, 1:], a.rgb[8, 12, 1:], rtol=0.02)

    def test_files_that_a_text_names_are_of_its_folder(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            (Path(folder) / "ball.pbrt").write_text('Shape "sphere"\n')
            text = SCENE.replace('Shape "sphere"', 'Include "ball.pbrt"')
            a = candela.load_string(text, folder=folder).render(spp=1)
            np.testing.assert_array_equal(a.rgb, candela.load_string(SCENE).render(spp=1).rgb)
            with self.assertRaisesRegex(candela.SceneError, "ball.pbrt"):
                candela.load_string(text).render(spp=1)

    def test_changed_values_are_rendered(self):
        of_text = candela.load_string(XML)
        for scene in (candela.load_dict(mitsuba()), of_text):
            before = scene.render(spp=4).rgb
            values = candela.traverse(scene)
            self.assertEqual(values["red.reflectance.value"], [0.8, 0.2, 0.1])
            values["red.reflectance.value"] = [0.1, 0.2, 0.8]
            values["sensor.film.width"] = 36
            values.update()
            after = scene.render(spp=4).rgb
            self.assertEqual(after.shape, (16, 36, 3))
            middle = after[8, 18] / before[8, 12]
            np.testing.assert_allclose(middle, [0.125, 1, 8], rtol=1e-3)
            values["red.reflectance"] = 0.5  # Mitsuba's suffix may be left out
            grey = scene.render(spp=4).rgb[8, 18]
            np.testing.assert_allclose(grey, grey[0], rtol=1e-6)

    def test_files_are_changed_in_memory_alone(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            file = Path(folder) / "a.xml"
            text = '<?xml version="1.0" encoding="utf-8"?>\n' + XML.replace('"24"', '"$width"')
            file.write_text(text)
            scene = candela.load_file(file)
            self.assertEqual(scene.parameters()["sensor.film.width"], "$width")
            scene.parameters()["red.reflectance"] = [0.1, 0.2, 0.8]
            image = scene.render(spp=4, define="width=36")
            self.assertEqual(image.rgb.shape, (16, 36, 3))
            self.assertGreater(image.rgb[8, 18, 2], 2 * image.rgb[8, 18, 0])
            self.assertEqual(file.read_text(), text)

    def test_a_text_that_is_no_scene_is_a_problem_with_its_line(self):
        for text in ("", "nonsense", "<scene", "<scene version='3.0.0'></scen>"):
            with self.assertRaises(candela.SceneError, msg=text):
                candela.load_string(text).render()
            self.assertTrue(candela.load_string(text).check(), text)
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_string("<scene version='3.0.0'>\n</scen>").parameters()
        self.assertEqual((caught.exception.line, caught.exception.file), (2, "scene.xml"))
        with self.assertRaises(candela.UsageError):
            candela.load_string(SCENE).parameters()

    def test_objects_without_id_have_names(self):
        text = """<scene version="3.0.0">
          <default name="emitter" value="1"/>
          <shape type="sphere"><float name="radius" value="1"/></shape>
          <shape type="sphere"><float name="radius" value="2"/></shape>
          <shape type="sphere" id="shape"><float name="radius" value="3"/></shape>
          <shape type="sphere" id="shape_1"><float name="radius" value="4"/>
            <bsdf type="blendbsdf">
              <ref id="red"/><bsdf type="diffuse"><float name="reflectance" value="0.5"/></bsdf>
            </bsdf>
          </shape>
          <shape type="sphere" id="shape.bsdf"><float name="radius" value="5"/></shape>
          <bsdf type="diffuse" id="red"><float name="reflectance" value="0.6"/></bsdf>
          <emitter type="point"><float name="intensity" value="1"/></emitter>
          <emitter type="point"><float name="intensity" value="2"/></emitter>
        </scene>"""
        values = candela.load_string(text).parameters()
        expected = {
            "shape_2.radius": 1,
            "shape_3.radius": 2,
            "shape.radius": 3,
            "shape_1.radius": 4,
            "shape_1.bsdf.bsdf_1.reflectance": 0.5,
            "shape.bsdf.radius": 5,
            "red.reflectance": 0.6,
            "emitter.intensity": 1,
            "emitter_1.intensity": 2,
        }
        self.assertEqual(dict(values), expected)
        del values["shape_2.radius"], values["emitter"]
        values["shape_2"] = {"type": "sphere", "radius": 7}
        self.assertEqual((values["shape_2.radius"], values["emitter_1.intensity"]), (7, 2))
        values["emitter"] = {"type": "point", "intensity": 3}
        self.assertEqual(dict(values), {**expected, "shape_2.radius": 7, "emitter.intensity": 3})

    def test_values_may_be_transforms_and_objects(self):
        scene = candela.load_string(XML)
        values = scene.parameters()
        seen = values["sensor.to_world"]
        np.testing.assert_allclose(seen.matrix, mitsuba()["sensor"]["to_world"].matrix, atol=1e-12)
        values["sensor.to_world"] = Transform().translate([100, 0, 0]) @ seen
        values["red.reflectance"] = {"type": "checkerboard", "color0": 0.1, "color1": 0.9}
        self.assertIn("red.reflectance.color0", values)
        np.testing.assert_array_equal(scene.render(spp=1).rgb, np.ones((16, 24, 3)))  # the sky

    def test_a_value_that_is_taken_out_may_be_set_again(self):
        for scene in (candela.load_dict(mitsuba()), candela.load_string(XML)):
            before = scene.render(spp=1).rgb
            del scene.parameters()["red.reflectance"]
            self.assertNotIn("red.reflectance", scene.parameters())
            self.assertGreater(abs(scene.render(spp=1).rgb - before).max(), 0.01)
            for _ in range(2):
                scene.parameters()["red.reflectance"] = [0.8, 0.2, 0.1]
            self.assertEqual(len(scene.parameters()), len(set(scene.parameters())))
            np.testing.assert_array_equal(scene.render(spp=1).rgb, before)

    def test_mitsubas_colours_are_colours(self):
        color = type("Color3f", (list,), {"__module__": "mitsuba"})
        scene = mitsuba()
        scene["red"]["reflectance"] = color([0.8, 0.2, 0.1])
        loaded = candela.load_dict(scene)
        self.assertEqual(loaded.parameters()["red.reflectance.value"], [0.8, 0.2, 0.1])
        loaded.parameters()["red.reflectance"] = color([0.1, 0.2, 0.8])
        self.assertEqual(loaded.parameters()["red.reflectance.value"], [0.1, 0.2, 0.8])
        scene["red"]["reflectance"] = [0.8, 0.2, 0.1]
        (problem,) = candela.check(scene)
        self.assertIn('a colour is {"type": "rgb", "value": […]}', problem.text)
        scene["red"]["reflectance"], scene["ball"]["center"] = 0.5, [0, 0]
        (problem,) = candela.check(scene)
        self.assertIn("must be 3 numbers, found 2 numbers", problem.text)

    def test_an_object_takes_the_place_of_another_any_number_of_times(self):
        pixels = np.full((2, 2, 3), [0.1, 0.2, 0.8])
        checkerboard = {"type": "checkerboard", "color0": 0.3, "color1": 0.3}
        blue = {"type": "rgb", "value": [0.1, 0.2, 0.8]}
        values = [blue, checkerboard, 0.3, {"type": "bitmap", "data": pixels}, [0.1, 0.2, 0.8]]
        of_dict = mitsuba()
        of_dict["red"]["reflectance"] = checkerboard
        for scene in (candela.load_dict(of_dict), candela.load_string(XML)):
            parameters = scene.parameters()
            for first in values:
                for second in values:
                    parameters["red.reflectance"] = first
                    parameters["red.reflectance"] = second
            for name in ("red.reflectance", "red.reflectance.value"):
                seen = []
                for value in values:
                    parameters[name] = value
                    seen.append(scene.render(spp=1).rgb[8, 12])
                np.testing.assert_allclose(seen[1], seen[2], rtol=1e-5)
                for other in (3, 4):
                    np.testing.assert_allclose(seen[other], seen[0], rtol=0.01)
                self.assertGreater(seen[0][2], 2 * seen[1][2])
            del parameters["red.reflectance"], parameters["red"]
            parameters["red"] = {"type": "diffuse"}
            with self.assertRaises(KeyError):  # no longer that of the one before
                parameters["red.reflectance"] = blue
            parameters["red"] = {"type": "diffuse", "reflectance": blue}
            np.testing.assert_allclose(scene.render(spp=1).rgb[8, 12], seen[0], rtol=0.01)

    def test_what_takes_the_place_of_an_object_is_of_its_kind(self):
        scene = mitsuba()
        scene["ball"]["bsdf"] = {"type": "diffuse", "id": "inner"}
        scene["other"] = {"type": "sphere", "radius": 0.1, "bsdf": {"type": "ref", "id": "inner"}}
        of_objects = candela.load_dict(scene)
        values = of_objects.parameters()
        for value in ({"type": "sphere"}, 0.5, [1, 2, 3], {"type": "rgb", "value": 1}):
            with self.assertRaisesRegex(candela.SceneError, "ball.bsdf: error: expected `bsdf`, f"):
                values["ball.bsdf"] = value
        for _ in range(2):
            for value in ({"type": "conductor"}, {"type": "ref", "id": "red"}):
                values["other.bsdf"] = value
        for kind in ("conductor", "plastic"):
            values["ball.bsdf"] = {"type": kind}
        values["other.bsdf"] = {"type": "ref", "id": "inner"}
        self.assertEqual(of_objects.check(), [])
        values["ball.bsdf"] = values["other.bsdf"] = {"type": "ref", "id": "red"}
        self.assertEqual(of_objects.check(), [])
        loaded = candela.load_dict(mitsuba())
        loaded.parameters()["ball"] = {"type": "cylinder"}
        loaded.parameters()["sensor.film"] = {"type": "hdrfilm", "width": 8, "height": 4}
        self.assertEqual(loaded.render(spp=1).shape, (4, 8, 3))
        with self.assertRaisesRegex(KeyError, "'ball' is no value"):
            values["ball"]
        with self.assertRaisesRegex(KeyError, "ive it where the scene is made"):
            values["ball.radius"] = 2

    def test_meshes_are_made_of_arrays(self):
        vertices = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
        faces, uv = np.array([[0, 1, 2], [0, 2, 3]]), np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        up = np.tile([0.0, 0, 1], (4, 1))
        scene = mitsuba()
        turn = Transform().rotate([0, 1, 0], 180)
        scene["ball"].update(type="rectangle", to_world=turn)
        scene["sky"] = {"type": "directional", "direction": [0.3, 0.2, 1]}
        checkerboard = {"type": "checkerboard", "to_uv": Transform().scale([4, 2, 1])}
        scene["red"]["reflectance"] = checkerboard
        whole = candela.render(scene, spp=16).rgb
        self.assertGreater(whole.max(), 0.05)
        bsdf = {"type": "ref", "id": "red"}
        for arrays in ((vertices, faces, up, uv), (vertices, faces.tolist(), None, uv)):
            scene["ball"] = {**candela.mesh(*arrays), "bsdf": bsdf, "to_world": turn}
            loaded = candela.load_dict(scene)
            np.testing.assert_allclose(loaded.render(spp=16).rgb, whole, atol=0.01)
        loaded.parameters()["ball"] = {**candela.mesh(100 * vertices, faces), "bsdf": bsdf}
        self.assertFalse(np.allclose(loaded.render(spp=1).rgb, whole))
        for wrong, message in (
            ((vertices.T, faces), "vertices must be n × 3 numbers, found an array of 3 × 4 int64"),
            ((vertices, faces * 1.0), "faces must be n × 3 integers, found an array of 2 × 3 f"),
            ((vertices, faces + 1), "faces need indices from 0 to 3, found 1 to 4"),
            ((vertices, faces, up[1:]), "normals must be 4 × 3 numbers, found an array of 3 × 3"),
            ((vertices * np.nan, faces), r"vertices\[0, 0\] must be a finite float32, found nan"),
            ((vertices * 1e300, faces), r"vertices\[\d, \d\] must be a finite float32, found "),
            ((vertices, faces, up * np.inf), r"normals\[0, \d\] must be a finite float32, found "),
            ((vertices, faces, None, up), "texcoords must be 4 × 2 numbers, found an array of 4"),
        ):
            with self.assertRaisesRegex(ValueError, message):
                candela.mesh(*wrong)

    def test_textures_are_made_of_arrays(self):
        scene = mitsuba()
        grey = {"type": "rgb", "value": [0.21586] * 3}  # 128 of sRGB
        scene["red"]["reflectance"] = grey
        whole = candela.render(scene, spp=4).rgb
        bits = np.full((4, 2, 3), 128, "u1")
        floats = np.full((4, 2, 3), 0.21586)
        for array in (bits, bits[..., :1], bits[..., 0], floats, floats[..., 0].astype("f2")):
            for name in ("data", "bitmap"):
                scene["red"]["reflectance"] = {"type": "bitmap", name: array}
                np.testing.assert_allclose(candela.render(scene, spp=4).rgb, whole, rtol=2e-3)
        loaded = candela.load_dict(scene)
        values = loaded.parameters()
        np.testing.assert_array_equal(values["red.reflectance.data"], array)
        values["red.reflectance.data"] = 2 * floats
        self.assertGreater(loaded.render(spp=4).rgb[8, 12, 0], 1.5 * whole[8, 12, 0])
        values["red.reflectance"] = {"type": "bitmap", "data": bits, "raw": True}
        raw = loaded.render(spp=4).rgb
        values["red.reflectance"] = 128 / 255
        np.testing.assert_allclose(raw, loaded.render(spp=4).rgb, rtol=2e-3)
        scene["red"]["reflectance"] = grey
        for data in (2 * floats, bits):
            scene["sky"] = {"type": "envmap", "bitmap": data}
            sky = candela.render(scene, spp=4).rgb
            expected = 0.21586 if data is bits else 0.43172
            np.testing.assert_allclose(sky[0, 0], expected, rtol=2e-3)
        values["red.reflectance"] = {"type": "bitmap", "data": floats}
        with self.assertRaisesRegex(candela.SceneError, "found an array of 4 × 2 × 3 int64"):
            values["red.reflectance.data"] = bits.astype("i8")

    def test_volumes_are_made_of_arrays(self):
        fog = {"type": "homogeneous", "sigma_t": 2.0, "albedo": 0.5}
        scene = mitsuba()
        scene["integrator"] = {"type": "volpath"}
        scene["ball"] = {"type": "cube", "bsdf": {"type": "null"}, "interior": fog}
        even = candela.render(scene, spp=64).rgb.mean()
        for array in (np.full((2, 3, 4), 2.0), np.full((2, 3, 4, 1), 2.0, "f4")):
            for name in ("data", "grid"):
                grid = {"type": "gridvolume", name: array, "to_world": UNIT_CUBE}
                scene["ball"]["interior"] = {**fog, "type": "heterogeneous", "sigma_t": grid}
                self.assertAlmostEqual(candela.render(scene, spp=64).rgb.mean() / even, 1, 1)
        loaded = candela.load_dict(scene)
        values = loaded.parameters()
        key = "ball.interior.sigma_t.data"
        np.testing.assert_array_equal(values[key], array)
        values[key] = np.zeros((2, 2, 2))
        self.assertGreater(abs(loaded.render(spp=64).rgb.mean() / even - 1), 0.1)
        for wrong, found in ((np.ones((2, 2)), "2 × 2"), (np.full((1, 1, 1), np.nan), "nan")):
            with self.assertRaisesRegex(candela.SceneError, f"{key}.*found.* {found}"):
                values[key] = wrong

    def test_albedos_of_a_volume_are_interpolated_by_themselves(self):
        step = np.zeros((2, 2, 2))
        step[..., 1] = 1
        scene = mitsuba()
        del scene["red"], scene["ball"]
        scene["sky"] = {"type": "constant"}
        scene["integrator"] = {"type": "volpath", "max_depth": 8}
        view = Transform().look_at(origin=[1, 2, 5], target=[0, 0, 0], up=[0, 1, 0])
        scene["sensor"].update(fov=40, to_world=view)
        scene["sensor"]["film"].update(width=24, height=24)
        for albedo, expected in ((step, 0.918), (1 - step, 0.8194)):  # Mitsuba 3.9.1's
            volume = {"type": "heterogeneous", "scale": 3.0}
            for name, data in (("sigma_t", step), ("albedo", albedo)):
                volume[name] = {"type": "gridvolume", "data": data, "to_world": UNIT_CUBE}
            scene["fog"] = {"type": "cube", "bsdf": {"type": "null"}, "interior": volume}
            # The noise of 128 samples
            mean = candela.render(scene, spp=128).rgb.mean()
            self.assertAlmostEqual(mean, expected, delta=0.004)
        volume["sigma_t"]["data"], volume["albedo"]["data"] = step - 0.5, step * 3
        texts = [p.text for p in candela.check(scene)]
        self.assertTrue(any("at least 0, found -0.5" in text for text in texts), texts)
        self.assertTrue(any("at most 1, found 3" in text for text in texts), texts)

    def test_a_value_of_a_define_is_set_back(self):
        text = XML.replace('value="24"', 'value="$w"', 1)
        self.assertNotEqual(text, XML)
        scene = candela.load_string(text)
        values = scene.parameters()
        before = dict(values)
        self.assertEqual(before["sensor.film.width"], "$w")
        values["sensor.film.width"] = 8
        self.assertEqual(scene.render(spp=1).shape[1], 8)
        values.update(before)
        self.assertEqual(scene.render(spp=1, define={"w": 12}).shape[1], 12)

    def test_an_object_with_an_id_is_found_by_its_key_too(self):
        scene = mitsuba()
        plain = candela.render(scene, spp=4).rgb
        scene["red"]["id"] = "paint"
        for name in ("red", "paint"):
            scene["ball"]["bsdf"] = {"type": "ref", "id": name}
            np.testing.assert_array_equal(candela.render(scene, spp=4).rgb, plain)

    def test_a_file_name_may_have_a_dollar(self):
        scene = mitsuba()
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "a$b.ply")
            shutil.copyfile(candela.mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])["filename"], name)
            scene["ball"] = {"type": "ply", "filename": name}
            with self.assertRaisesRegex(candela.SceneError, r"\$file.*define=\{'file': …\}"):
                candela.render(scene, spp=1)
            scene["ball"]["filename"] = "$file"
            candela.render(scene, spp=1, define={"file": name})

    def test_arrays_are_saved_with_the_scene_and_their_files_removed_after_it(self):
        mesh = candela.mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
        scene = mitsuba()
        scene["red"]["reflectance"] = {"type": "bitmap", "data": np.full((2, 2), 0.5)}
        scene["ball"] = {**mesh, "bsdf": {"type": "twosided", "b": {"type": "ref", "id": "red"}}}
        loaded = candela.load_dict(scene)
        image = loaded.render(spp=2).rgb
        paths = [file.path for file in candela._xml.arrays(loaded._tree)]
        self.assertEqual([os.path.exists(path) for path in paths], [True, True])
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            file = Path(folder) / "scene.xml"
            with self.assertRaisesRegex(candela.UsageError, "scene.save"):
                loaded.render(spp=1, outfile=Path(folder) / "x.film")
            for _ in range(2):
                loaded.save(file)
            self.assertEqual(len(list(Path(folder).iterdir())), 3)
            del loaded, scene, mesh
            self.assertEqual([os.path.exists(path) for path in paths], [False, False])
            np.testing.assert_array_equal(candela.render(file, spp=2).rgb, image)

    def test_a_saved_scene_is_the_same(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            for i, scene in enumerate([candela.load_dict(mitsuba()), candela.load_string(SCENE)]):
                file = Path(folder) / ("a.xml", "a.pbrt")[i]
                scene.save(file)
                candela.load_file(file).save(file)
                np.testing.assert_array_equal(
                    candela.render(file, spp=1).rgb, scene.render(spp=1).rgb
                )
                with self.assertRaisesRegex(candela.UsageError, f"ends with {file.suffix}"):
                    scene.save(Path(folder) / ("a.pbrt", "a.xml")[i])

    def test_a_scene_that_is_saved_elsewhere_names_the_same_files(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            old, below, apart = Path(folder, "a"), Path(folder, "a", "b"), Path(folder, "c & d")
            for each in (below, apart):
                each.mkdir(parents=True)
            for name, level in (("a/grey.exr", 0.25), ("a/b/grey.exr", 0.9), ("c & d/grey.exr", 0.7)):
                candela.Image(np.full((2, 2, 3), level, "f4")).save(Path(folder, name))
            (old / "metal.spd").write_text("400 0.1 500 0.5 700 0.9")
            (old / "lamp.xml").write_text(
                '<scene version="3.0.0"><emitter type="envmap"><string name="filename" '
                'value="grey.exr"/></emitter></scene>'
            )
            (old / "inc").mkdir()
            (old / "inc" / "paint.pbrt").write_text(
                'Texture "grey" "spectrum" "imagemap" # "string filename" "x"\n'
                '"string filename" [ "grey.exr" ] "bool invert" false\n'
                'Include "ball.pbrt"\n'
            )
            (old / "inc" / "ball.pbrt").write_text('Material "diffuse" "texture reflectance" "grey"\n')
            mesh = candela.mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
            (old / "mesh.ply").write_bytes(Path(mesh["filename"]).read_bytes())
            of_dict = mitsuba()
            of_dict["red"]["reflectance"] = {"type": "bitmap", "filename": "$name"}
            of_dict["ball"] = {"type": "ply", "filename": "mesh.ply", "bsdf": {"type": "ref", "id": "red"}}
            xml = XML.replace('<rgb name="reflectance" value="0.8, 0.2, 0.1"/>', """
                <spectrum name="reflectance" filename="metal.spd"/>""")
            xml = xml.replace('<emitter type="constant"/>', '<include filename="lamp.xml"/>')
            pbrt = SCENE.replace('Material', 'Include "inc/paint.pbrt"\n#Material').replace(
                '"rgb L" [ 2 2 2 ]', '"spectrum L" "metal.spd"').replace(
                '24', '24 "bool savefp16" true "string filename" "out.exr"')
            before = os.getcwd()
            self.addCleanup(os.chdir, before)
            os.chdir(old)
            texts = ((of_dict, {"define": {"name": "grey.exr"}}), (xml, {}), (pbrt, {}))
            for i, (given, options) in enumerate(texts):
                is_dict = isinstance(given, dict)
                scene = candela.load_dict(given) if is_dict else candela.load_string(given)
                suffix = ".pbrt" if given is pbrt else ".xml"
                image = scene.render(spp=2, **options).rgb
                for at in (".", "b", "../c & d", "b"):
                    file = os.path.join(at, f"s{i}{suffix}")
                    scene.save(file)
                    scene = candela.load_file(file)  # and saved from there
                    np.testing.assert_array_equal(scene.render(spp=2, **options).rgb, image)
                    self.assertEqual("out.exr" in Path(file).read_text(), given is pbrt)
            self.assertIn('<path value=".."/>', Path("b/s1.xml").read_text())

    def test_a_scene_keeps_its_folder_and_its_text(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            here, there = Path(folder, "a"), Path(folder, "b")
            for each, level in ((here, 0.25), (there, 0.9)):
                each.mkdir()
                candela.Image(np.full((2, 2, 3), level, "f4")).save(each / "grey.exr")
            of_dict = mitsuba()
            of_dict["red"]["reflectance"] = {"type": "bitmap", "filename": "grey.exr"}
            before = os.getcwd()
            self.addCleanup(os.chdir, before)
            os.chdir(here)
            Path("s.pbrt").write_text(SCENE)
            candela.load_dict(of_dict).save("s.xml")
            (there / "s.xml").write_text(XML)
            (there / "s.pbrt").write_text(SCENE.replace("0.2 0.4 0.6", "0.9 0.9 0.9"))
            scenes = [candela.load_dict(of_dict), candela.load_string(Path("s.xml").read_text())]
            scenes += [candela.load_file("s.xml"), candela.load_file("s.pbrt")]
            images = [scene.render(spp=1).rgb for scene in scenes]
            os.chdir(there)
            for scene, image in zip(scenes, images):
                np.testing.assert_array_equal(scene.render(spp=1).rgb, image)
            (here / "s.xml").write_text(XML)  # it has been read
            np.testing.assert_array_equal(scenes[2].render(spp=1).rgb, images[2])
            scenes[2].parameters()["red.reflectance.filename"] = "grey.exr"
            np.testing.assert_array_equal(scenes[2].render(spp=1).rgb, images[2])
            for missing in ("t.xml", "t.pbrt", "t.gltf"):
                with self.assertRaises(candela.MissingFileError) as caught:
                    candela.load_file(missing)
                self.assertEqual(caught.exception.file, missing)
            os.chdir(before)
            candela.close()

    def test_values_that_have_no_text_are_told_of(self):
        class Broken:
            def __repr__(self):
                raise RuntimeError("internal error")

            def __iter__(self):
                raise RuntimeError("internal error")

        class TensorXf(Broken):
            def __array__(self, dtype=None, copy=None):
                return np.zeros(0)

        TensorXf.__module__ = "drjit.scalar"
        scene = mitsuba()
        scene["red"]["reflectance"] = {"type": "bitmap", "data": TensorXf()}
        scene["ball"]["radius"] = Broken()
        scene["sky"]["radiance"] = []
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_dict(scene)
        told = {p.key: p.message for p in caught.exception.problems}
        self.assertIn("the tensor is empty", told["red.reflectance.data"])
        self.assertIn("Broken", told["ball.radius"])
        self.assertIn("found []", told["sky.radiance"])
        with self.assertRaisesRegex(ValueError, "Broken"):
            candela.mesh(Broken(), [[0, 1, 2]])

    def test_what_contains_itself_is_a_fault_with_its_key(self):
        scene, endless = mitsuba(), []
        scene["red"]["nested"] = scene["red"]
        endless.append(endless)
        scene["ball"]["center"] = endless
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_dict(scene)
        told = {p.key: p.message for p in caught.exception.problems}
        self.assertEqual(set(told), {"red", "ball"})
        self.assertIn("contains itself", told["red"])
        with self.assertRaisesRegex(candela.SceneError, "red.reflectance: error: it contains"):
            candela.load_dict(mitsuba()).parameters()["red.reflectance"] = scene["red"]

    def test_problems_of_a_dict_name_no_text_and_no_temporary_files(self):
        scene = mitsuba()
        pixels = np.full((2, 2, 3), np.nan, "f4")
        scene["red"]["reflectance"] = {"type": "bitmap", "data": pixels}
        scene["ball"]["bsdf"] = {"type": "diffuse", "id": "sky"}
        scene["other"] = {"type": "sphere", "radius": "$r", "bsdf": {"type": "ref", "id": "red"}}
        undefined = candela.check(scene)
        problems = undefined + candela.check(scene, define={"r": 1})
        scene["other"]["radius"], scene["ball"]["bsdf"]["id"] = 1, "green"
        problems += candela.check(scene)
        texts = "\n".join(p.text for p in problems)
        for word in ("scene.xml", "candela-", "<", "-D"):
            self.assertNotIn(word, texts)
        self.assertIn("define={'r': …}", texts)
        self.assertIn("`scene.parameters()` sets numbers", texts)
        self.assertRegex(texts, "the id `sky` is repeated; the first is at `(sky|ball.bsdf)`")
        self.assertIn("red.reflectance.data: warning: texels are NaN", texts)

    def test_an_invalid_angle_is_told_once(self):
        for fov in (-5, 180, 400):
            scene = mitsuba()
            scene["sensor"]["fov"] = fov
            self.assertEqual([p.key for p in candela.check(scene)], ["sensor.fov"])

    def test_models_have_no_parameters(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            file = Path(folder) / "a.gltf"
            file.write_text("{}")
            with self.assertRaisesRegex(candela.UsageError, "a.gltf` has no parameters: Mitsuba"):
                candela.load_file(file).parameters()

    def test_names_of_scenes_are_no_options(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            before = os.getcwd()
            self.addCleanup(os.chdir, before)
            os.chdir(folder)
            for name, text in (("-x.xml", XML), ("--y.pbrt", SCENE)):
                Path(name).write_text(text)
                image = candela.render(name, spp=1).rgb
                np.testing.assert_array_equal(candela.load_file(name).render(spp=1).rgb, image)
            os.chdir(before)
            candela.close()

    def test_missing_files_are_named(self):
        for options in ({"outfile": os.path.join("no folder", "x.png")}, {}):
            scene = candela.load_string(XML) if options else "nope.pbrt"
            with self.assertRaises(candela.MissingFileError) as caught:
                candela.render(scene, spp=1, **options)
            self.assertEqual(caught.exception.file, options.get("outfile", "nope.pbrt"))
            self.assertEqual(caught.exception.problems[0].file, caught.exception.file)
        for call in (candela.load_file, candela.render):
            with self.assertRaisesRegex(candela.MissingFileError, r"file: `nope.pbrt` \[E0101\]"):
                call("nope.pbrt")
        with self.assertRaises(candela.MissingFileError) as caught:
            candela.run("resume", "nope.film")
        self.assertEqual(caught.exception.file, "nope.film")

    def test_what_is_no_scene_is_told_when_it_is_loaded(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            names = [Path(folder) / name for name in ("a.xml", "b.xml", "c", "d.xml", "e")]
            names[0].write_text('<scene version="3.0.0"><shape></scene>')
            candela.Image(np.ones((2, 2, 3))).save(Path(folder) / "x.png")
            for name in names[1:3]:
                shutil.copy(Path(folder) / "x.png", name)
            for name in names[3:]:
                name.mkdir()
            for name in names:
                with self.assertRaises(candela.SceneError) as rendered:
                    candela.render(name)
                with self.assertRaises(candela.SceneError, msg=name) as loaded:
                    candela.load_file(name)
                self.assertEqual(str(loaded.exception), str(rendered.exception))
            self.assertNotIsInstance(rendered.exception, FileNotFoundError)  # it is a folder
            self.assertEqual(rendered.exception.file, str(names[4]))
        for call in (candela.render, candela.check, candela.load_file):
            for text in (SCENE, XML, "<scene/>"):
                with self.assertRaisesRegex(candela.UsageError, "candela.load_string reads it"):
                    call(text)

    def test_faults_of_whole_files_are_problems(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            empty, cut = Path(folder) / "e.obj", Path(folder) / "a.stl"
            empty.write_text("# nothing\n")
            cut.write_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n")
            for file in (empty, cut):
                (problem,) = candela.check(file)
                self.assertEqual((problem.severity, problem.file), ("error", str(file)))
                with self.assertRaises(candela.SceneError) as caught:
                    candela.render(file)
                self.assertEqual(caught.exception.problems[0].text, problem.text)
            empty.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
            missing = os.path.join(folder, "nope.exr")
            with self.assertRaises(candela.MissingFileError) as caught:
                candela.render(empty, light=missing)
            self.assertEqual(caught.exception.file, missing)

    def test_wrong_kinds_of_arguments_are_named(self):
        with self.assertRaisesRegex(TypeError, "progress must be a function of a Progress, found 3"):
            candela.render(mitsuba(), progress=3)
        with self.assertRaisesRegex(KeyError, "expected the name of a value, found 3"):
            candela.load_dict(mitsuba()).parameters()[3]
        with self.assertRaisesRegex(candela.MissingFileError, "file: `x.pbrt`"):
            candela.render(b"x.pbrt")
        vertices, faces = np.eye(3), np.zeros((0, 3), int)
        with self.assertRaisesRegex(ValueError, "faces must be n × 3 integers, found none"):
            candela.mesh(vertices, faces)

    def test_sets_of_numbers_have_no_order(self):
        scene = candela.load_dict(mitsuba())
        with self.assertRaisesRegex(TypeError, "a set have no order: write a list"):
            scene.parameters()["red.reflectance.value"] = {0.8, 0.2, 0.1}
        with self.assertRaisesRegex(ValueError, "a translation needs three numbers, found {"):
            candela.Transform().translate({3, 1, 2})
        ball = {"type": "scene", "ball": {"type": "sphere", "center": {2, 0, 1}}}
        with self.assertRaisesRegex(candela.SceneError, "ball.center: error: numbers in a set"):
            candela.load_dict(ball).render(spp=1)
        image = candela.render(mitsuba(), spp=1, aov={"albedo", "depth"})
        self.assertIn("depth", image)

    def test_wrong_transforms_are_value_errors(self):
        base, up = candela.Transform(), [0, 1, 0]
        for make, message in (
            (lambda: base.look_at([0, 0], up, up), "`origin` needs three numbers, found"),
            (lambda: base.look_at(None, up, up), "`origin` needs three numbers, found None"),
            (lambda: base.rotate(up, None), "angle of a rotation needs a number, found None"),
            (lambda: base.rotate(up, float("nan")), "angle of a rotation needs a number, found nan"),
            (lambda: candela.Transform(np.full((4, 4), np.nan)), "a transform needs numbers"),
            (lambda: base @ [1, 2], "a point needs three numbers"),
        ):
            with self.assertRaisesRegex(ValueError, message):
                make()

    def test_a_limit_of_compare_keeps_the_figures(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            files = [os.path.join(folder, name) for name in ("a.exr", "b.exr")]
            for seed, file in enumerate(files):
                candela.render(mitsuba(), spp=1, seed=seed).save(file)
            with self.assertRaises(candela.CandelaError) as caught:
                candela.run("compare", *files, "--max-mse", 1e-9)
            self.assertNotIsInstance(caught.exception, candela.SceneError)
            self.assertIn("RMSE", caught.exception.output)

    def test_images_without_colours_have_no_picture(self):
        planes = {name: np.zeros((4, 4), "f4") for name in "uv"}
        image = candela.Image(planes, channels={name: [name] for name in "uv"})
        self.assertFalse(hasattr(image, "rgb"))
        self.assertIsNone(image._repr_png_())
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            with self.assertRaisesRegex(candela.SceneError, "the image: no channels R, G"):
                image.save(os.path.join(folder, "x.png"))

    def test_a_command_line_in_one_piece_is_told_how_to_separate_it(self):
        for words in (["compare", "a.exr", "b.exr"], "compare a.exr b.exr", ("compare", "a.exr")):
            with self.assertRaisesRegex(candela.UsageError, r'candela.run\("compare", "a.exr"'):
                candela.run(words)

    def test_a_word_of_an_explanation_is_not_suggested_again(self):
        with self.assertRaises(candela.UsageError) as caught:
            candela.load_dict(mitsuba()).render(sensor="sensor")
        self.assertNotIn("did you mean", str(caught.exception))

    def test_what_is_no_text_of_a_scene_is_told_at_once(self):
        with self.assertRaisesRegex(TypeError, "takes a text, found b'abc'"):
            candela.load_string(b"abc")
        for name in ("scene.xml", "a folder/b.PBRT.gz", "c.glb"):
            with self.assertRaisesRegex(candela.UsageError, f"`{name}` is .* candela.load_file"):
                candela.load_string(name)
        for text in ('Include "a.pbrt"', "# a.pbrt", "Shape\na.pbrt"):
            self.assertIsInstance(candela.load_string(text), candela.Scene)
        with self.assertRaisesRegex(candela.SceneError, "the name of the scene is empty"):
            candela.render("")

    def test_words_are_those_of_the_call(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            scene, film, image = (Path(folder) / name for name in ("a.xml", "a.film", "a.exr"))
            scene.write_text(XML)
            candela.run("render", scene, "--spp", 2, "--shard", "0/2", "--outfile", film)
            with self.assertRaisesRegex(candela.SceneError, "\n --partial merges the others"):
                candela.run("merge", film, "--outfile", image)
            command = "`candela merge --partial` merges the others"
            with self.assertRaisesRegex(candela.SceneError, command):
                candela.load(film)

    def test_arrays_are_described_by_their_sizes(self):
        pixels = {"type": "bitmap", "data": np.zeros((3, 4, 3))}
        scene = candela.load_dict({"type": "scene", "red": {"type": "diffuse", "reflectance": pixels}})
        self.assertIn(
            "'red.reflectance.data': an array of 3 × 4 × 3 float64", repr(scene.parameters())
        )

    def test_values_that_the_scene_has_not_are_told_of(self):
        values = candela.load_string(XML).parameters()
        with self.assertRaisesRegex(KeyError, "did you mean 'red.reflectance.value'"):
            values["red.reflectanc"] = 1
        self.assertNotIn("red.reflectanc", values)
        with self.assertRaisesRegex(candela.SceneError, "red.reflectance.value: error: expected"):
            values["red.reflectance.value"] = None

    def test_transforms_are_mitsubas(self):
        t = Transform().translate([1, 2, 3]).rotate([0, 0, 1], 90).scale(2)
        # The last acts first: (1, 0, 0) is scaled, turned and moved
        moved = np.array(t.matrix) @ [1, 0, 0, 1]
        np.testing.assert_allclose(moved, [1, 4, 3, 1], atol=1e-12)
        scene = mitsuba()
        scene["sensor"]["to_world"] = np.array(scene["sensor"]["to_world"].matrix)
        a = candela.load_dict(scene).render(spp=1)
        np.testing.assert_array_equal(a.rgb, candela.load_dict(mitsuba()).render(spp=1).rgb)
        with self.assertRaises(ValueError):
            Transform([[1, 2], [3, 4]])
        np.testing.assert_allclose(t.inverse() @ t, np.eye(4), atol=1e-12)
        np.testing.assert_allclose(t @ [1, 0, 0], [1, 4, 3], atol=1e-12)
        np.testing.assert_allclose(t @ np.array([1.0, 0, 0]), [1, 4, 3], atol=1e-12)
        self.assertEqual(Transform(np.array(t)[:3]), t)
        for wrong, message in (
            (lambda: Transform(np.diag([1, 1, 1, 2])), "needs the last row 0, 0, 0, 1"),
            (lambda: Transform().scale([1, 0, 1]).inverse(), "no inverse"),
            (lambda: Transform().rotate([0, 0, 0], 30), "axis of a rotation has length 0"),
            (lambda: Transform().look_at([0, 0, 1], [0, 0, 1], [0, 1, 0]), "target equals origin"),
        ):
            with self.assertRaisesRegex(ValueError, message):
                wrong()

    def test_a_matrix_of_3_rows_is_the_upper_left_of_a_transform(self):
        turn = Transform().rotate([0, 0, 1], 30)
        small = Transform(np.array(turn.matrix)[:3, :3])
        self.assertEqual(small.translate([1, 2, 3]), turn.translate([1, 2, 3]))
        matrix = '<transform name="to_world"><matrix value="2 0 0 0 2 0 0 0 2"/></transform>'
        values = candela.load_string(XML.replace('<ref id="red"/>', matrix)).parameters()
        self.assertEqual(values["ball.to_world"], Transform().scale(2))
        # As Mitsuba's ScalarTransform3f has it
        moved = mock.Mock(spec=["matrix"], matrix=np.array([[1, 0, 0.25], [0, 1, 0.5], [0, 0, 1]]))
        self.assertEqual(Transform(moved), Transform().translate([0.25, 0.5, 0]))

    def test_what_takes_files_alone_says_how_to_save_a_scene(self):
        for scene in (mitsuba(), candela.load_string(XML)):
            with self.assertRaisesRegex(candela.UsageError, r"`shard` .* scene.save\('scene.xml'\)"):
                candela.render(scene, shard="0/2")
            with self.assertRaisesRegex(candela.UsageError, r"save the scene"):
                candela.run("render", scene, "--shard", "0/2")

    def test_the_version_is_that_of_the_package(self):
        self.assertRegex(candela.__version__, r"^\d")

    def test_numpys_values_are_values(self):
        scene = mitsuba()
        scene["red"]["reflectance"]["value"] = np.array([0.8, 0.2, 0.1])
        scene["ball"].update(radius=np.float32(1), center=np.zeros(3), flip_normals=np.bool_(False))
        scene["sensor"]["film"]["width"] = np.int64(24)
        a = candela.load_dict(scene).render(spp=1)
        np.testing.assert_array_equal(a.rgb, candela.load_dict(mitsuba()).render(spp=1).rgb)

    def test_numpys_values_and_paths_are_options(self):
        scene = candela.load_string(XML.replace('"24"', '"$width"'))
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            image = scene.render(
                spp=np.float64(2),
                seed=np.array(3),
                nthreads=np.uint8(1),
                exposure=np.float32(0.5),
                quick=np.bool_(False),
                aov=np.array(["albedo"]),
                cropwindow=np.array([0, 0.5, 0, 1]),
                define={"width": np.int16(24)},
                report=Path(folder) / "x.html",
                outfile=[Path(folder) / "x.exr", Path(folder) / "x.png"],
            )
            self.assertTrue((Path(folder) / "x.html").exists())
            self.assertIn("24x16", candela.run("info", Path(folder) / "x.exr"))
            printed = candela.run("render", "--help", np.int64(3))
        self.assertEqual(image.rgb.shape, (16, 12, 3))
        self.assertEqual(image.metadata["seed"], "3")
        self.assertIn("candela render", printed)
        with self.assertRaisesRegex(candela.UsageError, "cropwindow can't be <object"):
            scene.render(cropwindow=object())

    def test_numpys_values_make_the_same_scene(self):
        T = Transform()
        plain = T.look_at([0, 0, -5], [0, 0, 0], [0, 1, 0]).scale(2).translate([1, 2, 3])
        a = T.look_at(np.array([0, 0, -5]), np.zeros(3), np.array([0, 1, 0]))
        a = a.scale(np.array(2)) @ np.array(T.translate(np.array([1, 2, 3])).matrix)
        self.assertEqual(a, plain)
        self.assertEqual(Transform([np.array(row) for row in plain.matrix]), plain)
        scene = mitsuba()
        scene["sensor"]["to_world"] = [np.array(row) for row in scene["sensor"]["to_world"].matrix]
        scene["red"]["reflectance"]["value"] = np.array(0.5)
        scene["ball"]["radius"] = np.array([1.0])
        values = candela.load_dict(scene).parameters()
        self.assertEqual(values["red.reflectance.value"], [0.5, 0.5, 0.5])
        self.assertEqual(values["ball.radius"], 1)
        self.assertEqual(values["sensor.to_world"], mitsuba()["sensor"]["to_world"])
        values["red.reflectance"] = np.array([0.8, 0.2, 0.1])
        self.assertEqual(values["red.reflectance.value"], [0.8, 0.2, 0.1])

        class Point(list):
            matrix = [1, 1, 1]  # Mitsuba's have an attribute of any letters

        scene["ball"]["center"] = Point([0, 0, 1])
        self.assertEqual(candela.load_dict(scene).parameters()["ball.center"], [0, 0, 1])
        scene["ball"]["to_world"] = np.zeros((2, 2))
        with self.assertRaisesRegex(candela.SceneError, "ball.to_world: error: a transform needs"):
            candela.load_dict(scene)

    def test_one_of_several_sensors_is_rendered(self):
        scene = mitsuba()
        scene["other"] = {**scene["sensor"], "film": {"type": "hdrfilm", "width": 8, "height": 8}}
        sensor = XML[XML.index("<sensor") : XML.index("<bsdf")].replace('"24"', '"8"')
        text = XML.replace("<bsdf", f"{sensor}<bsdf", 1)
        for loaded in (candela.load_dict(scene), candela.load_string(text)):
            with self.assertWarnsRegex(candela.CandelaWarning, "sensor=1 the second"):
                self.assertEqual(loaded.render(spp=1).width, 24)
            self.assertEqual([loaded.render(spp=1, sensor=i).width for i in (0, 1)], [24, 8])
            with self.assertWarnsRegex(candela.CandelaWarning, "sensor=0 renders the first"):
                loaded.render(spp=1)
            with self.assertRaisesRegex(candela.SceneError, "there is no sensor 2"):
                loaded.render(spp=1, sensor=2)
            with self.assertRaisesRegex(candela.UsageError, "returns one image"):
                loaded.render(sensor="all")

    def test_films_of_scenes_in_memory_go_on(self):
        scene = candela.load_dict(mitsuba())
        whole = scene.render(spp=8).rgb
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            film, image = Path(folder) / "x.film", Path(folder) / "x.exr"
            scene.render(spp=4, outfile=[film, image])
            with self.assertRaisesRegex(candela.SceneError, "`candela resume .* --spp 8` adds"):
                scene.render(spp=8, outfile=film)
            candela.run("resume", film, "--spp", 8)
            pfm = Path(folder) / "x.pfm"
            candela.run("merge", film, "--outfile", pfm)
            self.assertNotIn("candela-", candela.run("info", film).replace(folder, ""))
            values = np.frombuffer(pfm.read_bytes()[-4 * whole.size :], "<f4")
            np.testing.assert_array_equal(values.reshape(whole.shape)[::-1], whole)
            np.testing.assert_array_equal(candela.load(film).rgb, whole)
            np.testing.assert_array_equal(scene.render(spp=8, outfile=film).rgb, whole)

    def test_what_the_program_prints_is_printed(self):
        scene = mitsuba()
        scene["red"]["reflectanc"] = 0.5

        def printed(**options):
            with contextlib.redirect_stderr(io.StringIO()) as err, warnings.catch_warnings(
                record=True
            ) as caught:
                warnings.simplefilter("always")
                candela.load_dict(scene).render(spp=1, **options)
            self.assertEqual(len(caught), 1)
            self.assertNotIn("integrator", str(caught[0].message))
            return err.getvalue()

        self.assertEqual(printed(), "")
        self.assertIn("  integrator ", printed(explain=True))
        self.assertIn("parse ", printed(verbose=True))
        self.assertRegex(printed(watch=True), "watch at http://")
        with contextlib.redirect_stderr(io.StringIO()) as err:
            candela.load_dict(scene).check(explain=True)
        self.assertIn("  integrator ", err.getvalue())
        for refused in ({"thumbnail": "blocks"}, {"checkpoint": True}, {"sample": 3}, {"turntable": 4}):
            with self.assertRaisesRegex(candela.UsageError, "does not go with"):
                candela.load_dict(scene).render(**refused)

    def test_faults_of_a_dict_are_all_told_with_their_keys(self):
        scene = mitsuba()
        scene["red"]["type"] = "difuse"
        scene["ball"]["radius"] = None
        scene["sky"]["radiance"] = {"value": 1}
        scene["width"] = 3
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_dict(scene)
        keys = [p.key for p in caught.exception.problems]
        self.assertEqual(keys, ["red", "ball.radius", "sky.radiance", "width"])
        self.assertEqual(candela.check(scene), list(caught.exception.problems))
        self.assertIn("did you mean `diffuse`?", str(caught.exception))

    def test_arrays_and_names_that_no_scene_takes_are_faults(self):
        scene = mitsuba()
        scene["red"]["reflectance"] = {"type": "bitmap", "data": np.ones((2, 2, 5))}
        scene["ball"]["vertex_positions"] = np.ones((1000, 3))
        scene["ball"]["to_world"] = np.ones((1000, 3))
        scene["ball"]["center"] = [np.ones(3)] * 1000
        scene["ball"][1] = 2
        scene[3] = {"type": "sphere"}
        with self.assertRaises(candela.SceneError) as caught:
            candela.render(scene)
        told = {p.key: p.message for p in caught.exception.problems}
        self.assertIn("found an array of 2 × 2 × 5 float64", told["red.reflectance.data"])
        self.assertNotIn("red.reflectance", told)
        self.assertIn("candela.mesh(vertices, faces)", told["ball.vertex_positions"])
        self.assertIn("found an array of 1000 × 3 float64", told["ball.to_world"])
        self.assertIn("found a list of 1000 values", told["ball.center"])
        with self.assertRaises(candela.UsageError) as caught:
            candela.render(mitsuba(), cropwindow=np.zeros(1000))
        self.assertLess(len(str(caught.exception)), 400)
        self.assertEqual(told["ball.1"], "a name must be a text, found 1")
        self.assertEqual(told["3"], "a name must be a text, found 3")

    def test_wrong_types_and_wrong_values_of_a_dict_are_told_at_once(self):
        scene = mitsuba()
        scene["red"]["type"] = "difuse"
        scene["red"]["reflectance"]["value"] = [2, "x"]
        scene["ball"]["radius"] = -1
        scene["sensor"]["film"]["width"] = "wide"
        scene["thing"] = {"type": "zzz"}
        scene["other"] = {"type": "sphere", "bsdf": {"type": "ref", "id": "thing"}}
        scene["sky"]["scale"] = {"type": "rgb"}
        scene["lost"] = {"type": "sphere", "bsdf": {"type": "ref", "id": "nobody"}}
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_dict(scene)
        keys = {p.key for p in caught.exception.problems}
        self.assertLessEqual({"red", "red.reflectance", "thing", "sensor.film.width"}, keys)
        self.assertNotIn("other.bsdf", keys)
        self.assertIn("lost.bsdf", keys)

    def test_what_the_renderer_finds_in_a_dict_has_a_key_and_no_line(self):
        warned, wrong = mitsuba(), mitsuba()
        warned["red"]["reflectanc"] = 0.5
        wrong["ball"]["bsdf"]["id"] = "green"
        problems = candela.load_dict(warned).check()
        self.assertEqual([(p.key, p.severity) for p in problems], [("red.reflectanc", "warning")])
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_dict(wrong).render()
        problems += caught.exception.problems
        self.assertEqual([(p.key, p.severity) for p in problems[1:]], [("ball.bsdf", "error")])
        self.assertTrue(all(p.line is None and "scene.xml" not in p.text for p in problems))

    def test_progress_has_numbers(self):
        seen = []
        candela.load_dict(mitsuba()).render(spp=4, progress=seen.append)
        self.assertEqual((seen[-1].done, seen[-1].samples), (1, 24 * 16 * 4))
        self.assertGreater(seen[-1].seconds, 0)
        self.assertIn("samples/s", seen[-1].line)
        seen.clear()
        candela.load_dict(mitsuba()).render(spp=100_000, error="5%", progress=seen.append)
        for p in seen:
            self.assertEqual(p.done is None, p.seconds_left is None)

    def test_a_progress_that_renders_is_told_so(self):
        scene = candela.load_string(XML)
        with self.assertRaisesRegex(candela.UsageError, "progress"):
            scene.render(spp=4, progress=lambda p: scene.render(spp=1))
        scene.render(spp=1)

    def test_problems_of_a_model_have_its_pointer(self):
        with tempfile.TemporaryDirectory() as folder:
            model = Path(folder, "model.gltf")
            model.write_text('{"asset": {"version": "1.0"}}')
            (problem,) = candela.check(str(model))
        self.assertEqual(problem.severity, "error")
        self.assertEqual(problem.file, str(model))
        self.assertEqual((problem.key, problem.line), ("/asset/version", None))

    def test_messages_have_keywords(self):
        with self.assertRaises(candela.UsageError) as caught:
            candela.load_dict(mitsuba()).render(spp=-1)
        self.assertIn("error: spp must be at least 1", str(caught.exception))
        self.assertNotIn("--", str(caught.exception))
        with self.assertWarnsRegex(candela.CandelaWarning, "effect: `image.rgb` is linear light"):
            candela.load_dict(mitsuba()).render(spp=1, exposure=2)
        (problem,) = candela.check({"type": "scene"})
        self.assertIn('add "sensor": {"type": "perspective"}', problem.text)

    def test_warnings_are_of_the_line_that_renders(self):
        scene = mitsuba()
        scene["red"]["reflectanc"] = 0.5
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            candela.load_dict(scene).render(spp=1)
        self.assertEqual([w.filename for w in caught], [__file__])


    def test_commands_have_the_warnings_of_their_scenes(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            file, image = Path(folder) / "a.xml", Path(folder) / "a.exr"
            file.write_text(XML.replace('"red">', '"red"><float name="alpah" value="1"/>'))
            for words in (["check", file], ["render", file, "--spp", 1, "--outfile", image]):
                with self.assertWarnsRegex(candela.CandelaWarning, "`alpah`") as caught:
                    candela.run(*words)
                self.assertEqual(caught.filename, __file__)
            file.write_text(XML)
            with contextlib.redirect_stderr(io.StringIO()) as printed:
                candela.run("render", file, "--spp", 1, "--outfile", image, "--verbose")
            self.assertIn("triangles ", printed.getvalue())


class Named(unittest.TestCase):
    """Values of the repository's scenes. Mitsuba 0.6's animation, blackbody and srgb are none, nor
    are declarations: alias, default, include and path."""

    TAGS = set("float integer boolean string vector point rgb spectrum transform".split())

    def scenes(self):
        folder = Path(__file__).parent.parent / "scenes" / "mitsuba"
        if not folder.is_dir():
            self.skipTest(f"no folder {folder}")
        return sorted(folder.glob("mi-*.xml"))

    def elements(self, text):
        tree = ElementTree.fromstring(text)
        return [
            e for e in tree.iter() if e.tag in self.TAGS and "name" in e.attrib and "type" not in e.attrib
        ]

    def texts(self, file):
        elements = self.elements(file.read_text())
        return [" ".join(ElementTree.tostring(e, encoding="unicode").split()) for e in elements]

    def test_every_value_has_one_key(self):
        for file in self.scenes():
            elements = self.elements(file.read_text())
            names = ["value" if e.tag in ("rgb", "spectrum") else e.get("name") for e in elements]
            keys = [key.rpartition(".")[2] for key in candela.load_file(file).parameters()]
            self.assertCountEqual(keys, names, file.name)

    def test_a_change_is_of_one_value(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            for file in self.scenes():
                source, saved = (Path(folder) / name for name in (file.name, "saved.xml"))
                source.write_text(file.read_text())
                scene = candela.load_file(source)
                values = scene.parameters()
                scene.save(saved)
                before = self.texts(saved)
                changed = set()
                for key in values:
                    values[key] = other = self.other(values[key])
                    scene.save(saved)
                    after = self.texts(saved)
                    places = [i for i, (a, b) in enumerate(zip(before, after)) if a != b]
                    self.assertEqual((len(places), len(after)), (1, len(before)), key)
                    changed.update(places)
                    again = candela.load_file(saved).parameters()
                    self.assertEqual(list(again), list(values), key)
                    self.assertEqual(str(again[key]), str(other), key)
                    before = after
                self.assertEqual(len(changed), len(before))

    def other(self, value):
        if isinstance(value, Transform):
            return Transform([[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, 3, 0], [0, 0, 0, 1]])
        if isinstance(value, list):
            return [x + 0.5 for x in value]
        if isinstance(value, bool):
            return not value
        if isinstance(value, str):
            return 7 if value.startswith("$") else f"{value}, 800:1" if ":" in value else f"{value}-0"
        return value + 1


class Kept(unittest.TestCase):
    """Values of scenes that are changed, copied and taken from other modules."""

    def scene(self, reflectance=0.5):
        return candela.load_dict({
            "type": "scene",
            "integrator": {"type": "path"},
            "sensor": {
                "type": "perspective",
                "to_world": candela.Transform().look_at([0, 0, -4], [0, 0, 0], [0, 1, 0]),
                "film": {"type": "hdrfilm", "width": 4, "height": 4, "rfilter": {"type": "box"}},
            },
            "sky": {"type": "constant"},
            "red": {"type": "diffuse", "reflectance": reflectance},
            "ball": {"type": "sphere", "radius": 1.0, "bsdf": {"type": "ref", "id": "red"}},
            "lamp": {"type": "point", "position": [0, 0, -5], "intensity": 20.0},
        })

    def test_a_value_of_another_kind_is_refused_and_spoils_nothing(self):
        scene = self.scene({"type": "rgb", "value": [0.1, 0.2, 0.3]})
        values = scene.parameters()
        for name, wrong, right in (
            ("red.reflectance.value", True, [0.5, 0.5, 0.5]),
            ("ball.radius", "big", 2.0),
            ("lamp.position", 0.5, [0, 0, 5]),
        ):
            with self.assertRaises(candela.SceneError) as caught:
                values[name] = wrong
            self.assertIn("expected", str(caught.exception))
            values[name] = right
            self.assertEqual(values[name], right)
        with self.assertRaises(TypeError):
            values["red.reflectance.value"][0] = 0

    def test_values_that_no_scene_takes_are_refused_at_once(self):
        scene = mitsuba()
        scene["ball"]["center"] = [0, 0, 1]
        scene["lamp"] = {"type": "point", "intensity": {"type": "spectrum", "value": 2.0}}
        scene["sensor"]["fov"], scene["sky"]["radiance"] = 40, 1
        for lost in (scene, "scene.xml"):
            with self.assertRaisesRegex(candela.UsageError, "its changes would be lost"):
                candela.traverse(lost)
        values = candela.load_dict(scene).parameters()
        before, nan = dict(values), float("nan")
        color, light = "red.reflectance.value", "lamp.intensity.value"
        for key, value, message in (
            (color, "blue", "expected three numbers, found 'blue'"),
            (color, nan, "expected three numbers, found nan"),
            (color, [nan, 1, 1], "expected three numbers"),
            (color, [1, 1], "expected three numbers"),
            (color, True, "expected a number, a colour or a texture, found True"),
            (light, {"type": "spectrum", "value": "400:1, 500"}, "pairs of wavelength and value"),
            (light, {"type": "spectrum", "value": [(400, nan)]}, "pairs of wavelength and value"),
            (light, {"type": "spectrum", "value": ""}, "pairs of wavelength and value"),
            ("ball.center", [nan, 0, 0], "expected finite numbers"),
            ("sensor.film.width", True, "expected a number, found True"),
            ("sensor.fov", "40", "expected a number, found '40'"),
            ("sensor.fov", [1, 0, 0], r"expected a number, found \[1, 0, 0\]"),
            ("red", {"type": "diffuse", "a.b": 1}, "`a.b` has a `.`, which separates names"),
        ):
            with self.assertRaisesRegex(candela.SceneError, message, msg=f"{key} = {value}"):
                values[key] = value
            with self.assertRaises(candela.SceneError):
                values.update({"sensor.fov": 30, "sky": {"type": "constant"}, key: value})
            self.assertEqual(dict(values), before)
        with self.assertRaises(KeyError):
            values.update({"sensor.fov": 30, "typo": 1})
        self.assertEqual(dict(values), before)
        values.update([("sensor.fov", 30)])
        for value in ("#ff8000", "$x", "0.1 0.2 0.3", 1, [0.1, 0.2, 0.3]):
            values[color] = value
        for value in ("400:1, 500:2", [(400, 1), (500, 2)], 3):
            values["lamp.intensity"] = {"type": "spectrum", "value": value}
        self.assertEqual(dict(values), {**before, "sensor.fov": 30, color: [0.1, 0.2, 0.3], light: 3})
        dotted = {"type": "scene", "a.b": {"type": "sphere"}, "c": {"type": "sphere", "x.y": 1}}
        with self.assertRaises(candela.SceneError) as caught:
            candela.load_dict(dotted)
        self.assertEqual([p.key for p in caught.exception.problems], ["a.b", "c.x.y"])

    def test_a_number_after_a_spectrum_is_the_number(self):
        scene = self.scene()
        values = scene.parameters()
        values["lamp.intensity"] = {"type": "spectrum", "value": 20.0}
        values["lamp.intensity.value"] = 10.0
        self.assertIn("<spectrum", scene.source()[1])
        values["lamp.intensity"] = 20.0
        self.assertNotIn("<spectrum", scene.source()[1])

    def test_scenes_with_arrays_are_copied_and_pickled(self):
        pixels = np.full((2, 2, 3), 0.25, "f4")
        scene = self.scene({"type": "bitmap", "data": pixels})
        image = scene.render(spp=2)
        copied, unpickled = copy.deepcopy(scene), pickle.loads(pickle.dumps(scene))
        del scene
        for other in (copied, unpickled):
            self.assertTrue((other.render(spp=2).rgb == image.rgb).all())
            self.assertIn("red.reflectance.data", other.parameters())

    def test_a_bitmap_says_whether_it_is_encoded(self):
        class Bitmap:
            def __init__(self, values, gamma):
                self.values, self.gamma = values, gamma

            def srgb_gamma(self):
                return self.gamma

            def __array__(self, dtype=None, copy=None):
                return self.values

        grey, half = np.full((2, 2, 3), 128, np.uint8), np.full((2, 2, 3), 0.5, "f4")
        for values, gamma, expected in (
            (grey, False, 128 / 255),
            (grey, True, 0.21586),
            (half, True, 0.21404),
            (half, False, 0.5),
            (np.full((2, 2, 4), 32768, np.uint16), False, 32768 / 65535),
            (np.full((2, 2, 2), 128, np.uint8), True, 0.21586),
        ):
            scene = self.scene({"type": "bitmap", "data": Bitmap(values, gamma)})
            albedo = scene.render(spp=1, aov=["albedo"])["albedo"]
            self.assertAlmostEqual(float(albedo[1, 1, 0]), expected, 3)

    def test_a_texture_brighter_than_its_light_is_a_warning(self):
        pixels, glow = np.full((2, 2, 3), 0.5), {"type": "ref", "id": "glow"}
        scene = candela.load_dict(
            {
                **mitsuba(),
                "red": {"type": "diffuse", "reflectance": {"type": "bitmap", "data": pixels}},
                "pixels": {"type": "bitmap", "data": pixels},
                "raw": {"type": "bitmap", "data": pixels, "raw": True},
                "lit": {"type": "sphere", "light": {"type": "area", "radiance": glow}},
                "glow": {"type": "bitmap", "data": 2 * pixels},
            }
        )
        values = scene.parameters()
        self.assertEqual(scene.check(), [])
        for key in ("red.reflectance.data", "pixels.data"):
            for factor, found in ((400, "200 to 200"), (-1, "-0.5 to -0.5")):
                values[key] = factor * pixels
                message = f"{key}: warning: values from {found}, expected 0 to 1 [E0304]"
                self.assertEqual([p.text for p in scene.check()], [message])
                with self.assertWarns(candela.CandelaWarning) as caught:
                    scene.render(spp=1)
                self.assertEqual(str(caught.warning), message)
                self.assertEqual(caught.filename, __file__)
            values[key] = np.float32([[[0.1 * 10]]]) + 1e-7
        values["raw.data"] = 400 * pixels
        self.assertEqual(scene.check(), [])

    def test_films_of_other_channels_have_colours(self):
        scene = self.scene({"type": "rgb", "value": [0.8, 0.1, 0.1]})
        expected = scene.render(spp=4).rgb
        scene = self.scene({"type": "rgb", "value": [0.8, 0.1, 0.1]})
        dict_text = scene.source()[1].replace(
            '<film type="hdrfilm" name="film">',
            '<film type="hdrfilm" name="film"><string name="pixel_format" value="xyz"/>',
        )
        image = candela.load_string(dict_text).render(spp=4, aov=["depth"])
        self.assertTrue(np.allclose(image.rgb, expected, atol=2e-3))
        self.assertEqual(image["depth"].shape[:2], (4, 4))
        self.assertEqual(np.ndim(np.squeeze(image["depth"])), 2)

    def test_the_axis_of_a_rotation_is_taken_as_it_is(self):
        turned = candela.Transform().rotate([1, 1, 0], 45).matrix[0][:3]
        self.assertTrue(np.allclose(turned, [1, 0.2928932, 0.7071068]))
        for wrong in (lambda t: t.rotate(45, [0, 1, 0]), lambda t: t.scale([1, 2])):
            with self.assertRaises(ValueError):
                wrong(candela.Transform())

    def test_setting_colours_drops_the_denoised_ones(self):
        image = candela.Image(np.zeros((2, 2, 3), "f4"))
        image.layers["Denoised"] = image.rgb
        image.rgb = np.ones((2, 2, 3), "f4")
        self.assertNotIn("Denoised", image.layers)


class Images(unittest.TestCase):
    def test_files_have_what_the_image_has(self):
        image = candela.load_dict(mitsuba()).render(
            spp=4, aov=["albedo", "depth"], cropwindow=(0.25, 0.75, 0, 1)
        )
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            npz, exr, png = (Path(folder) / f"x.{suffix}" for suffix in ("npz", "exr", "png"))
            for path in (npz, exr, png):
                image.save(path)
            again = candela.load(npz)
            self.assertEqual((again.window, again.metadata), (image.window, image.metadata))
            of_exr = candela.load(exr)
            self.assertEqual(of_exr.window, image.window)
            self.assertEqual({**of_exr.metadata, **image.metadata}, of_exr.metadata)
            for name, values in image.layers.items():
                np.testing.assert_array_equal(again[name], values)
                np.testing.assert_array_equal(of_exr[name], values)
            self.assertEqual(np.load(npz)["rgb"].shape, (16, 12, 3))
            self.assertEqual(candela.load(png).rgb.shape, (16, 12, 3))
            self.assertIn("12x16", candela.run("info", exr))
            self.assertIn("Albedo.G", candela.run("info", exr))
            pfm = Path(folder) / "x.pfm"
            candela.run("image", exr, "--outfile", pfm)
            values = np.frombuffer(pfm.read_bytes()[-4 * image.rgb.size :], "<f4")
            np.testing.assert_array_equal(values.reshape(image.rgb.shape)[::-1], image.rgb)
            for picture in (png.read_bytes(), image._repr_png_()):
                self.assertTrue(picture.startswith(b"\x89PNG"))
            npz.write_bytes(npz.read_bytes()[:-100])
            with self.assertRaisesRegex(candela.CandelaError, "can't read .*x.npz: .*not a zip"):
                candela.load(npz)
            np.savez(npz, x=np.ones(3))
            with self.assertRaisesRegex(candela.CandelaError, r"candela.Image\(array\)"):
                candela.load(npz)
            absent = Path(folder) / "absent"
            for missing in (
                lambda: candela.load(absent.with_suffix(".npz")),
                lambda: candela.render(absent.with_suffix(".xml")),
                lambda: candela.traverse(candela.load_file(absent.with_suffix(".xml"))),
                lambda: candela.load_dict(mitsuba()).save(absent / "x.xml"),
                lambda: image.save(absent / "x.npz"),
                lambda: image.save(absent / "x.png"),
            ):
                with self.assertRaises(FileNotFoundError) as caught:
                    missing()
                self.assertIsInstance(caught.exception, candela.SceneError)
                self.assertIn("absent", caught.exception.problems[0].text)
            for save in (image.save, lambda file: candela.render(mitsuba(), spp=1, outfile=file)):
                with self.assertRaisesRegex(candela.UsageError, "x.tiff"):
                    save(Path(folder) / "x.tiff")

    def test_names_may_begin_with_a_dash(self):
        image, folder = candela.Image(np.ones((2, 3, 3))), os.getcwd()
        with tempfile.TemporaryDirectory(prefix="candela test ") as other:
            os.chdir(other)
            try:
                for name in ("-x.exr", "--help.png", "-x.npz"):
                    image.save(name)
                    self.assertEqual(candela.load(name).shape, (2, 3, 3))
            finally:
                os.chdir(folder)

    def test_images_are_made_of_arrays_and_are_arrays(self):
        array = np.linspace(0, 1, 60).reshape(5, 3, 4)
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            for values in (array, array[..., :3]):
                image = candela.Image(values)
                for suffix in ("exr", "npz"):
                    image.save(Path(folder) / f"x.{suffix}")
                    again = candela.load(Path(folder) / f"x.{suffix}")
                    np.testing.assert_array_equal(again.rgb, array[..., :3].astype("f4"))
                    self.assertEqual(again.alpha is None, values.shape[2] == 3)
        self.assertEqual(image.shape, (5, 3, 3))
        self.assertTrue((image == candela.Image(array)).all() and not (image != image.rgb).any())
        self.assertTrue((image > -1).all() and not (image < 0).any())
        np.testing.assert_allclose(-image + image**2, image.rgb * (image.rgb - 1), atol=1e-6)
        np.testing.assert_array_equal(image[1:, :, 0], image.rgb[1:, :, 0])
        np.testing.assert_array_equal(image - image, np.zeros((5, 3, 3)))
        image.rgb = 2 * image.rgb
        np.testing.assert_allclose(image[4, 2], 2 * array[4, 2, :3])
        for wrong in (array[0], np.ones((5, 3, 3), "u1"), array):
            with self.assertRaisesRegex(ValueError, "needs an array of .* found an array of "):
                image.rgb = wrong

    def test_layers_of_ones_own_are_saved_and_loaded(self):
        sizes = {"rgb": [3], "alpha": [], "mask": [], "a.b": [], "pair": [2], "c.d": [3], "four": [4]}
        sizes.update({"eleven": [11], "maské": [], 40 * "n": [], "Z": []})
        values = np.arange(4 * 5 * 11, dtype="f4").reshape(4, 5, 11)
        arrays = {n: values[..., : size[0]] if size else values[..., 7] for n, size in sizes.items()}
        image = candela.Image({"rgb": arrays["rgb"]})
        image.layers.update(arrays)
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            for saved, suffix in ((image, "exr"), (candela.Image(arrays), "npz")):
                file = Path(folder) / f"x.{suffix}"
                saved.save(file)
                again = candela.load(file)
                self.assertEqual(set(again.layers), set(arrays))
                for name, array in arrays.items():
                    np.testing.assert_array_equal(again.layers[name], array, f"{name} of {suffix}")
            self.assertEqual(again.channels["mask"], ["mask"])
            self.assertEqual(again.channels["four"], [f"four.{c}" for c in "RGBA"])
            one = values[..., 0]
            for wrong in ({}, {"R": one}, {"": one}, {3: one}, {"m": one[0]}, {"m": 3}, {"m": "a"},
                          {"rgb": one}, {"alpha": values}, {"m": values[..., :0]}, {"m": one[:0]},
                          {"m": one, "n": one[1:]}, {"m": np.full((4, 5), "a")}):
                with self.assertRaisesRegex(ValueError, "layer.* needs|needs at least one layer"):
                    candela.Image(wrong)
            image.layers["mask"] = one[1:]
            for suffix in ("exr", "npz", "png"):
                with self.assertRaisesRegex(ValueError, "'mask' needs numbers of 4 × 5 or 4 × 5 × "):
                    image.save(Path(folder) / f"y.{suffix}")

    def test_images_are_added_and_multiplied(self):
        values = np.arange(1, 13, dtype="f4").reshape(2, 2, 3)
        i = candela.Image(values)
        for image, array in (
            (i + i, 2 * values), (1 + i, values + 1), (i - 1, values - 1), (1 - i, 1 - values),
            (i * 2, 2 * values), (values * i, values**2), (i / i, values / values), (1 / i, 1 / values),
        ):
            np.testing.assert_array_equal(image, array)
        self.assertEqual((i.mean(), np.mean(i)), (6.5, 6.5))
        np.testing.assert_array_equal(i.mean(axis=(0, 1)), [5.5, 6.5, 7.5])

    def test_pictures_show_the_denoised_image_and_alpha(self):
        rgb, alpha = np.full((2, 2, 3), 0.25, "f4"), np.full((2, 2), 0.5, "f4")
        layers = {"rgb": rgb, "Denoised": 2 * rgb, "alpha": alpha}
        channels = {"rgb": [*"RGB"], "alpha": ["A"]}
        channels["Denoised"] = [f"Denoised.{c}" for c in "RGB"]
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            for names, value in ((["rgb"], 0.25), (["rgb", "Denoised"], 0.5), (layers, 0.5)):
                image = candela.Image({name: layers[name] for name in names}, {}, channels)
                for suffix in ("png", "tga"):
                    file = Path(folder) / f"x.{suffix}"
                    image.save(file)
                    shown = candela.load(file)  # multiplied by alpha, as a rendering
                    np.testing.assert_allclose(shown.rgb, value, atol=0.01)
                    self.assertEqual(shown.alpha is None, image.alpha is None)
                file = Path(folder) / "y.png"
                file.write_bytes(image._repr_png_())
                np.testing.assert_allclose(candela.load(file).rgb, value, atol=0.01)

    def test_without_numpy_images_are_memoryviews(self):
        code = f"""
import sys
sys.modules["numpy"] = None
import candela
image = candela.load_string({XML!r}).render(spp=1)
assert image.rgb.shape == (16, 24, 3) and image.rgb.format == "f"
assert image._repr_png_().startswith(b"\\x89PNG")
print(image.rgb[8, 12, 0])
arrays = [
    lambda: image.mean(), lambda: 2 * image, lambda: image - image, lambda: 1 / image,
    lambda: image[:, :, 0], lambda: candela.Image([[[1.0, 1.0, 1.0]]]), lambda: candela.mesh([], []),
    lambda: setattr(image, "rgb", 1),
    lambda: candela.load_dict({{"type": "scene", "t": {{"type": "bitmap", "data": [[1.0]]}}}}),
]
for each in arrays:
    try:
        each()
    except candela.UsageError as e:
        assert str(e) == "arrays need NumPy, which is not installed"
    else:
        raise AssertionError
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = candela.load_string(XML).render(spp=1).rgb[8, 12, 0]
        self.assertAlmostEqual(float(done.stdout), float(expected), places=6)


    def test_equal_images_are_equal_files(self):
        image = candela.load_dict(mitsuba()).render(spp=1)
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            for suffix in ("exr", "png", "jpg", "npz", "pfm", "tga", "qoi"):
                files = [Path(folder) / f"{name}.{suffix}" for name in "ab"]
                image.save(files[0])
                with mock.patch("time.time", return_value=2e9):
                    image.save(files[1])
                self.assertEqual(files[0].read_bytes(), files[1].read_bytes(), suffix)


class Processes(unittest.TestCase):
    """The Java process that stays."""

    def pid(self):
        return candela._session.session().pid

    def test_it_is_one(self):
        candela.load_string(XML).render(spp=1)
        pid = self.pid()
        candela.load_dict(mitsuba()).render(spp=1)
        with self.assertRaises(candela.UsageError):
            candela.load_dict(mitsuba()).render(sppp=1)
        self.assertEqual(self.pid(), pid)
        candela.close()
        candela.load_string(XML).render(spp=1)
        self.assertNotEqual(self.pid(), pid)

    @unittest.skipIf(os.name == "nt", "signals")
    def test_one_that_is_killed_is_an_exception_and_the_next_call_starts_another(self):
        scene = candela.load_string(XML)
        scene.render(spp=1)
        pid = self.pid()

        def kill(progress):
            os.kill(pid, signal.SIGKILL)

        with self.assertRaisesRegex(candela.InternalError, "ended by signal 9; the next call"):
            scene.render(spp=100_000_000, progress=kill)
        scene.render(spp=1)
        pid = self.pid()
        os.kill(pid, signal.SIGKILL)
        while candela._session._session.is_usable:
            time.sleep(0.01)
        scene.render(spp=1)
        self.assertNotEqual(self.pid(), pid)

    @unittest.skipUnless(hasattr(os, "fork"), "fork")
    def test_a_fork_renders_while_a_thread_of_its_parent_does(self):
        scene, started = candela.load_string(XML), threading.Event()

        def render():
            with contextlib.suppress(candela.InternalError):
                scene.render(spp=100_000_000, progress=lambda p: started.set())

        thread = threading.Thread(target=render)
        thread.start()
        started.wait()
        pid = self.pid()
        child = os.fork()
        if child == 0:
            result = 1
            try:
                scene.render(spp=1)
                result = int(self.pid() == pid)
                candela.close()
            finally:
                os._exit(result)
        status = None
        deadline = time.monotonic() + 100
        while status is None and time.monotonic() < deadline:
            ended, code = os.waitpid(child, os.WNOHANG)
            status = code if ended else None
            time.sleep(0.1)
        if status is None:
            os.kill(child, signal.SIGKILL)
        self.assertEqual((status, self.pid()), (0, pid))
        candela.close()
        thread.join()

    def test_the_current_folder_is_pythons(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        candela.load_string(XML).render(spp=1)
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            os.chdir(folder)
            Path("here.xml").write_text(XML)
            candela.render("here.xml", spp=1, outfile="here.png")
            self.assertTrue(Path("here.png").exists())
            os.chdir(before)
        candela.close()

    def test_closing_ends_a_rendering_of_another_thread(self):
        scene = candela.load_string(XML)
        started, caught = threading.Event(), []

        def render():
            try:
                scene.render(spp=100_000_000, progress=lambda p: started.set())
            except candela.InternalError as e:
                caught.append(str(e))

        thread = threading.Thread(target=render)
        thread.start()
        started.wait()
        candela.close()
        thread.join()
        self.assertIn("by candela.close(); the next call starts another one", caught[0])
        with self.assertRaisesRegex(candela.InternalError, "the next call"):
            scene.render(spp=100_000_000, progress=lambda p: candela.close())
        scene.render(spp=1)

    def test_an_image_is_saved_by_several_threads(self):
        image = candela.load_string(XML).render(spp=1)
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            files = [Path(folder) / f"{i}.png" for i in range(4)]
            threads = [threading.Thread(target=image.save, args=(file,)) for file in files]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(len({file.read_bytes() for file in files}), 1)

    def test_the_program_has_the_packages_of_this_python(self):
        with mock.patch("subprocess.Popen") as popen:
            candela._session.start(["--version"])
        self.assertEqual(popen.call_args[1]["env"]["VIRTUAL_ENV"], sys.prefix)

    def test_python_ends_though_a_daemon_renders(self):
        code = f"""
import threading, candela
started = threading.Event()
def render():
    candela.load_string({XML!r}).render(spp=100_000_000, progress=lambda p: started.set())
threading.Thread(target=render, daemon=True).start()
started.wait()
"""
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0)

    def test_threads_wait_for_each_other(self):
        scene, images = candela.load_string(XML), {}

        def render(seed):
            images[seed] = scene.render(spp=1, seed=seed).rgb

        threads = [threading.Thread(target=render, args=(seed,)) for seed in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for seed, image in images.items():
            np.testing.assert_array_equal(image, scene.render(spp=1, seed=seed).rgb)

    @unittest.skipIf(os.name == "nt", "ps")
    def test_it_ends_with_python(self):
        for end in ("", "os.kill(os.getpid(), 9)"):
            code = f"""
import os, candela
candela.load_string({XML!r}).render(spp=1)
print(candela._session.session().pid, flush=True)
{end}
"""
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
            deadline = time.monotonic() + 30
            while is_running(done.stdout) and time.monotonic() < deadline:
                time.sleep(0.1)
            self.assertFalse(is_running(done.stdout))


def is_running(pid):
    done = subprocess.run(["ps", "-o", "stat=", "-p", pid.strip()], capture_output=True, text=True)
    return done.stdout.strip()[:1] not in ("", "Z")


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
        for wrong, right in (("albdo", "albedo"), ("dept", "depth"), ("Alph", "alpha")):
            if right in image:
                with self.assertRaisesRegex(KeyError, f"did you mean '{right}'"):
                    image[wrong]

    def test_layers_have_the_names_of_the_option(self):
        words = """albedo position gradient normal shadingnormal uv variance relativevariance depth
            samples motion emission background direct indirect lights denoisingalbedo
            denoisingnormal cryptoobject cryptomaterial alpha""".split()
        image = candela.render(self.scene(), spp=2, aov=words)
        sizes = {"depth": 0, "samples": 0, "alpha": 0, "uv": 2, "gradient": 2, "motion": 2}
        sizes.update(cryptoobject=12, cryptomaterial=12)
        for word in words:
            size = sizes.get(word, 3)
            shape = (16, 24, size) if size else (16, 24)
            self.assertIn(word, image)
            self.assertEqual(image[word].shape, shape, word)
        np.testing.assert_array_equal(image["uv"][..., 1], image["v"])
        np.testing.assert_array_equal(image["CryptoObject01"], image["cryptoobject"][..., 4:8])

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

    def test_a_resolution_takes_the_place_of_the_films(self):
        for resolution, shape in [((12, 20), (20, 12)), (12, (8, 12)), ("50%", (8, 12))]:
            image = candela.load_string(SCENE).render(spp=1, resolution=resolution)
            self.assertEqual(image.rgb.shape[:2], shape)

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
        # Python has no handler where its parent ignores the signal, as shells do for background jobs
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)
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

    @unittest.skipIf(os.name == "nt", "scripts")
    def test_a_command_that_the_variable_names_does_not_start_itself(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            inner = Path(folder) / "candela" / "program" / "bin"
            shutil.copytree(Path(candela.__file__).parent, inner.parents[1])
            inner.mkdir(parents=True)
            bundled, command = inner / "candela", Path(folder) / "command"
            bundled.write_text('#!/bin/sh\necho "bundled $*"\n')
            command.write_text(
                f"#!{sys.executable}\nimport sys\nsys.path.insert(0, {folder!r})\n"
                "from candela.__main__ import main\nsys.exit(main())\n"
            )
            bundled.chmod(0o755)
            command.chmod(0o755)
            with mock.patch.dict(os.environ, {"CANDELA_PROGRAM": str(command)}):
                self.assertEqual(candela.run("a"), "bundled a\n")
                done = subprocess.run([command, "b"], capture_output=True, text=True, timeout=60)
                self.assertEqual(done.stdout, "bundled b\n")

    @unittest.skipIf(os.name == "nt", "modes of files")
    def test_a_program_that_cannot_be_started_is_told(self):
        with tempfile.TemporaryDirectory(prefix="candela test ") as folder:
            file = Path(folder) / "candela"
            file.write_text("no program")
            with mock.patch.dict(os.environ, {"CANDELA_PROGRAM": str(file)}):
                for mode, why in ((0o644, "Permission denied"), (0o755, "Exec format error")):
                    file.chmod(mode)
                    for call in (lambda: candela.run("--version"), candela.version):
                        with self.assertRaisesRegex(candela.UsageError, f"can't start .*: {why}"):
                            call()
                    command = [sys.executable, "-m", "candela"]
                    done = subprocess.run(command, capture_output=True, text=True)
                    self.assertRegex(done.stderr, f"^candela: .*{why}")
                    self.assertEqual(done.returncode, 1)

    def test_the_command_is_the_program(self):
        command = [sys.executable, "-m", "candela", "--version"]
        out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        self.assertEqual(out.rstrip("\n"), candela.version())
        self.assertTrue(out.startswith("candela "))


if __name__ == "__main__":
    unittest.main()
