package candela.io

import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_16LE}
import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class ForeignFileSuite extends AnyFunSuite:

  private def what(name: String, start: String): Option[String] =
    ForeignFile.of(Path.of(name), start.getBytes(ISO_8859_1)).map(_.what)

  private val known = Vector(
    ("x.pbrt", "\u0076\u002f\u0031\u0001\u0002\u0000", "an OpenEXR image"),
    ("x.pbrt", "\u0089PNG\r\n\u001a\n", "a PNG image"),
    ("x", "\u00ff\u00d8\u00ff\u00e0", "a JPEG image"),
    ("x", "#?RADIANCE\nFORMAT=", "a Radiance HDR image"),
    ("x", "PF\n2 2\n-1\n", "a PFM image"),
    ("x", "P6\n2 2\n255\n", "a portable map"),
    ("x", "BM\u0036\u0000\u0000\u0000\u0000\u0000\u0000\u0000\u0036", "a BMP image"),
    ("x.tga", "\u0000\u0000\u0002\u0000", "a TGA image"),
    ("x", "ply\nformat ascii 1.0\n", "a PLY mesh"),
    ("x.obj", "# Blender\nmtllib a.mtl\nv 0 0 0\n", "an OBJ mesh"),
    ("x", "solid cube\n facet normal 0 0 1\n", "an STL mesh"),
    ("x.glb", "glTF\u0002\u0000\u0000\u0000", "a glTF model"),
    ("x", "{\n  \"asset\": {\"version\": \"2.0\"}", "a glTF model"),
    ("x.blend", "BLENDER-v300", "a Blender file"),
    ("x.usdc", "PXR-USDC", "a USD file"),
    ("x.usda", "#usda 1.0\n", "a USD file"),
    ("x.fbx", "Kaydara FBX Binary  \u0000", "an FBX file"),
    ("x.zip", "PK\u0003\u0004\u0014", "a ZIP archive"),
    ("x.tar", "scene.pbrt" + "\u0000" * 247 + "ustar", "a TAR archive"),
    ("x.nvdb", "NanoVDB0", "a NanoVDB volume"),
    ("x.serialized", "\u001c\u0004\u0004\u0000", "a Mitsuba mesh file"),
    ("x.pbrt", "<?xml version=\"1.0\"?>\n<scene version=\"3.0.0\">", "a Mitsuba scene"),
    ("x.dae", "<?xml version=\"1.0\"?>\n<COLLADA>", "a COLLADA file"),
    ("x.html", "<!doctype html>\n<html>", "an HTML page"),
    ("x.json", "{\"a\": 1}", "a JSON file"),
    ("x.bin", "abc\u0000\u0001\u0002\u0003\u0004", "a binary file")
  )

  for (name, start, expected) <- known do
    test(s"a file that begins like $expected is one ($name)"):
      assert(what(name, start) == Some(expected))

  test("scenes are no foreign files, however they begin"):
    val scenes = Vector(
      "",
      "# BM\nLookAt 0 0 5  0 0 0  0 1 0",
      "\u00ef\u00bb\u00bfWorldBegin",
      "PixelFilter \"box\"",
      "Material \"matte\"",
      "# \u0001 odd comment of some length, as exporters write them\nCamera \"perspective\"",
      "MakeNamedMaterial \"m\""
    )
    for text <- scenes do assert(what("x.pbrt", text).isEmpty, text)
    assert(what("x.xml", "<?xml version=\"1.0\"?><scene version=\"3.0.0\">").isEmpty)
    val wide = "\ufeffCamera".getBytes(UTF_16LE)
    assert(ForeignFile.of(Path.of("x.pbrt"), wide).isEmpty) // has a message of its own
