package candela.models

import candela.diagnostics.SceneError
import candela.image.{Image, ImageFiles}
import candela.models.MeshFormats.*
import candela.scenefile.{Declaration, SceneDescription}
import candela.testing.TempFolder

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** The expected numbers are those of the nodes that Blender 5.0.1 makes of the same materials. */
class MtlMaterialsSuite extends AnyFunSuite:
  private val Obj =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\n"

  /** An image of two rows, which is grey if all rows are. */
  private def png(pixels: (Float, Float, Float)*): Array[Byte] =
    TempFolder.use: folder =>
      val file = folder.resolve("x.png")
      val image = Image.rgb(pixels.size, 1)
      for ((r, g, b), i) <- pixels.zipWithIndex do
        image.data(3 * i) = r
        image.data(3 * i + 1) = g
        image.data(3 * i + 2) = b
      ImageFiles.write(file, image)
      Files.readAllBytes(file)

  private val normals = png((0.5f, 0.5f, 1f), (0.4f, 0.5f, 1f))
  private val grey = png((0.5f, 0.5f, 0.5f), (0.4f, 0.4f, 0.4f))

  private def scene(statements: String): SceneDescription = read(Seq(
    "m.obj" -> bytes(Obj),
    "m.mtl" -> bytes("newmtl a\n" + statements),
    "my x.png" -> normals,
    "grey.png" -> grey
  ))

  private def of(statements: String): Declaration = material(scene(statements), 0)

  private def has(d: Declaration, values: (String, Double)*): Unit =
    for (name, value) <- values do
      val found = number(d, name)
      assert(found.exists(x => Math.abs(x - value) < 1e-4), s"$name: $found, not $value")

  test("Phong's exponent is roughness, and the mean of Ks the level of reflection"):
    has(of("Kd 0.5 0.4 0.3\n"), "roughness" -> 1, "metallic" -> 0, "specular" -> 0, "eta" -> 1.5)
    val usual = of("Ka 0.2 0.2 0.2\nKd 0.5 0.4 0.3\nKs 0.5 0.3 0.1\nNs 100\nillum 2\n")
    has(usual, "roughness" -> 0.6838, "metallic" -> 0, "specularcolor" -> 0.6)
    assert(floats(usual, "color") == Vector(0.5f, 0.4f, 0.3f))
    has(of("illum 2\n"), "roughness" -> 0, "specularcolor" -> 2, "color" -> 0.8)

  test("surfaces that reflect are metal by Ka"):
    has(
      of("Ka 0.2 0.2 0.2\nKs 0.5 0.5 0.5\nNs 10\nillum 3\n"),
      "metallic" -> 0.2,
      "roughness" -> 0.9
    )
    has(of("illum 7\nKs 0 0 0\n"), "metallic" -> 1, "eta" -> 1)
    has(of("illum 4\n"), "eta" -> 1.5)

  test("physically based statements come before the classic ones"):
    val d =
      of("Kd 0.5 0.4 0.3\nNs 10\nPr 0.3\nPm 0.7\nPs 0.4\nPc 0.5\nPcr 0.1\naniso 0.3\nanisor 0.25\n")
    has(
      d,
      "roughness" -> 0.3,
      "metallic" -> 0.7,
      "sheencolor" -> 0.4,
      "sheenroughness" -> 0.5,
      "clearcoat" -> 0.125,
      "clearcoatroughness" -> 0.1,
      "anisotropy" -> 0.3,
      "anisotropyrotation" -> Math.PI / 2
    )

  test("d is coverage, and comes before Tr"):
    def alpha(s: String) = number(scene(s).shapes.head.shape, "alpha")
    assert(alpha("d 1\n").isEmpty && alpha("d 0.25\nTr 0.5\n").contains(0.25f))
    assert(alpha("Tr 0.25\n").contains(0.75f) && alpha("d -halo 0.5\n").contains(0.5f))

  test("Tf lets light through where illum says so"):
    has(of("illum 7\nTf 0.8 0.9 1\n"), "transmission" -> 0.9)
    assert(number(of("illum 2\nTf 1 1 1\n"), "transmission").isEmpty)
    assert(scene("illum 2\nTf 1 1 1\n").warnings.isEmpty)
    assert(scene("illum 2\nTf 0.5 0.5 0.5\n").warnings.size == 1)

  test("Ke emits light from both sides"):
    val light = scene("Ke 1 2 3\n").shapes.head.areaLight.get
    assert(floats(light, "L") == Vector(1f, 2f, 3f) && light.param("twosided").isDefined)

  test("images have options, and names with spaces or quotes"):
    for name <- Vector("my x.png", "\"my x.png\"") do
      val s = scene(s"Kd 0.5 0.5 0.5\nmap_Kd -s 2 3 1 -o 0.1 0.2 -clamp on -blendu on $name\n")
      val t = s.textures.head.texture
      assert(t.param("filename").get.strings.head == "my x.png" && s.textures.size == 1)
      assert(Vector("uscale", "vscale", "udelta", "vdelta").map(number(t, _).get) ==
        Vector(2f, 3f, 0.1f, 0.2f))
      assert(t.param("wrap").get.strings.head == "clamp")

  test("an image of another computer is looked for beside the library"):
    val s = scene("map_Kd C:\\work\\my x.png\n")
    assert(s.textures.head.texture.param("filename").get.strings.head == "my x.png")
    assert(s.warnings.map(told) ==
      Vector("m.mtl:2:1: no such file: `C:/work/my x.png`; using `my x.png`"))

  test("data of images is not decoded, and colours are"):
    val s = scene("map_Kd grey.png\nmap_Pr grey.png\nmap_Pm -imfchan g grey.png\nmap_d grey.png\n")
    val encodings = s.textures.map(t => (t.valueType, t.texture.param("encoding").get.strings.head))
    assert(encodings.toSet == Set(("spectrum", "sRGB"), ("float", "linear")))
    val channels = s.textures.flatMap(_.texture.param("channel")).map(_.strings.head)
    assert(channels.toSet == Set("all", "g", "opacity"))

  test("images of relief are normal maps, but those of heights are left out"):
    val d = of("map_Bump -bm 0.4 my x.png\n")
    assert(d.param("normalmap").get.strings.head == "my x.png")
    has(d, "normalscale" -> 0.4)
    assert(of("norm grey.png\n").param("normalmap").isDefined)
    val heights = scene("bump grey.png\n")
    assert(material(heights, 0).param("normalmap").isEmpty && heights.warnings.size == 1)

  test("a library outside of the model's folder is not quoted"):
    val files = Seq(
      "a/m.obj" -> bytes("mtllib ../secret\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
      "secret" -> bytes("SECRET:1\nnewmtl a\nSECRET:2\nKd 1 SECRET:3\n")
    )
    val e = intercept[SceneError](read(files))
    assert(e.problems.map(_.message) == Vector("expected a number, found text that is not shown"))
    val warned = read(files.init :+ "secret" -> bytes("SECRET:1\nnewmtl a\nSECRET:2\n"))
    assert(warned.warnings.size == 2)
    assert(!warned.warnings.exists(w => s"${w.message} ${w.excerpt}".contains("SECRET")))

  test("numbers out of range have the nearer limit, with a warning at their line"):
    val s = scene("Kd 2 0 -0.1\nd 3\nNs 99999\nNi 0.5\nillum 2\nKs 0 0 0\n")
    assert(s.warnings.map(told) == Vector(
      "m.mtl:2:1: `Kd` must be from 0 to 1, found 2 0 -0.1; using 1 0 0",
      "m.mtl:3:1: `d` must be from 0 to 1, found 3; using 1",
      "m.mtl:4:1: `Ns` must be from 0 to 1000, found 99999; using 1000",
      "m.mtl:5:1: `Ni` must be at least 1, found 0.5; using 1"
    ))
    val d = material(s, 0)
    assert(floats(d, "color") == Vector(1f, 0f, 0f))
    has(d, "roughness" -> 0, "eta" -> 1)
    for statement <- "Ke Ks Ka Tf Tr Pr Pm Ps Pc Pcr aniso".split(' ') do
      val warnings = scene(s"$statement -1\n").warnings
      assert(warnings.size == 1 && warnings.head.message.startsWith(s"`$statement` must be"))

  test("unknown statements are warnings with the nearest name"):
    val s = scene("Kdd 1 0 0\ndisp grey.png\nKs spectral a.rfl\n")
    assert(s.warnings.map(told) == Vector(
      "m.mtl:2:1: unknown statement `Kdd`; ignored",
      "m.mtl:3:1: `disp` is not supported; ignored",
      "m.mtl:4:1: colours as `spectral` are not supported; ignored"
    ))
    assert(s.warnings.head.help.contains("did you mean `Kd`?"))
    assert(error(scene("Kd\n")) == "m.mtl:2:3: expected a number, found the end of the line")
