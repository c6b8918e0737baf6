package candela.convert

import java.nio.file.{Files, Path}

import candela.build.TextureValues
import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.*
import candela.testing.{SceneTexts, TempFolder}
import org.scalatest.funsuite.AnyFunSuite

/** Textures that the other dialect lacks become images of the same values. */
class BakingSuite extends AnyFunSuite:
  private val Size = 128
  private val baking = Baking(Size, TextureValues.last(_).map(f => f(_, _, _)))
  private val square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " +
    "\"point3 P\" [0 0 1 2 0 1 2 2 1 0 2 1] \"float uv\" [0 0 3 0 3 3 0 3]"

  private def converted(text: String, from: Dialect, to: Dialect, folder: Path): Converted =
    val scene = SceneTexts.parse(s"WorldBegin\n$text", from, folder)
    Converter.convert(scene, to, folder, baking = Some(baking))

  private def value(scene: SceneDescription, name: String): TextureValue =
    val t = scene.textures.find(_.name == name).get
    val parts = TextureUses(scene.textures).closure(t)
    baking.values(scene.copy(textures = parts)).get

  /** Name of the texture of a parameter of the first material. */
  private def shown(scene: SceneDescription, param: String): String =
    scene.shapes.head.material match
      case MaterialRef.Inline(d) => d.param(param).get.strings.head
      case other => fail(other.toString)

  private def distance(a: Rgb, b: Rgb) =
    Seq(a.r - b.r, a.g - b.g, a.b - b.b).map(Math.abs).max

  private val colors = "Texture \"a\" \"color\" \"bilerp\" \"rgb v00\" [.1 .2 .3] " +
    "\"rgb v10\" [.9 .2 .5] \"rgb v01\" [.4 1 .2] \"rgb v11\" [.7 .7 .7]\n" +
    "Texture \"b\" \"color\" \"bilerp\" \"rgb v00\" [1 .9 .8] \"rgb v10\" [.2 .3 .9]\n" +
    "Texture \"both\" \"color\" \"scale\" \"texture tex1\" \"a\" \"texture tex2\" \"b\"\n"

  test("the product of two colours is an image of it"):
    TempFolder.use: folder =>
      val made = converted(colors, Dialect.V3, Dialect.V4, folder)
      val before = value(SceneTexts.parse(s"WorldBegin\n$colors", Dialect.V3, folder), "both")
      val after = value(made.scene, "both")
      // The image is constant within half a pixel of its rim
      for k <- 1 to 40 do
        val (u, v) = (0.01f + k * 0.0237f, 0.01f + k * 0.618f % 0.98f)
        assert(distance(before(u, v, Vec3.Zero), after(u, v, Vec3.Zero)) < 2e-3f, (u, v))
      val Vector(warning) = made.warnings.filterNot(_.message.contains("spectra")): @unchecked
      assert(warning.message == "v4 can't multiply two colours; using an image of 128 × 128 " +
        "pixels, which repeats where u or v is not in [0, 1]")

  test("the image shows one period of textures that repeat, in as many places"):
    TempFolder.use: folder =>
      val text = "Texture \"uv\" \"color\" \"uv\" \"float uscale\" 3 \"float vdelta\" .25\n"
      val made = converted(text, Dialect.V3, Dialect.V4, folder)
      val before = value(SceneTexts.parse(s"WorldBegin\n$text", Dialect.V3, folder), "uv")
      val after = value(made.scene, "uv")
      // Within two pixels of where it repeats, the image is blurred
      def isInside(x: Float) = (x + 2) % 1f > 2f / Size && (x + 2) % 1f < 1 - 2f / Size
      for
        k <- 0 to 30
        (u, v) = (k / 15f - 1, k * 13 % 31 / 10f) if isInside(3 * u + 1) && isInside(v + .25f)
      do
        assert(distance(before(u, v, Vec3.Zero), after(u, v, Vec3.Zero)) < 2e-3f, (u, v))
      assert(made.warnings.map(_.message).filterNot(_.contains("spectra")) ==
        Vector("v4 has no \"uv\"; using an image of 128 × 128 pixels"))

  test("of checks, the image shows two by two, however many there are"):
    TempFolder.use: folder =>
      val text = "Texture \"a\" \"color\" \"checkerboard\" \"float uscale\" 6 " +
        "\"float vscale\" 8\n" +
        "Texture \"b\" \"color\" \"scale\" \"texture tex1\" \"a\" \"texture tex2\" \"a\"\n"
      val made = converted(text, Dialect.V3, Dialect.V4, folder).scene
      val image = made.textures.find(_.texture.name == "imagemap").get.texture
      assert(image.param("uscale").get.floats.toVector == Vector(3f))
      assert(image.param("vscale").get.floats.toVector == Vector(4f))

  test("a texture of a roughness becomes one of alpha"):
    TempFolder.use: folder =>
      val text = "Texture \"r\" \"float\" \"bilerp\" \"float v00\" .1 \"float v10\" .5 " +
        "\"float v01\" .1 \"float v11\" .5\n" +
        s"Material \"metal\" \"texture uroughness\" \"r\" \"float vroughness\" .2 $square"
      val made = converted(text, Dialect.V3, Dialect.V4, folder).scene
      val MaterialRef.Inline(metal) = made.shapes.head.material: @unchecked
      assert(metal.param("remaproughness").get.bools == Vector(false))
      def alpha(r: Float) = candela.bsdf.microfacet.Roughness.polynomialAlpha(r)
      assert(metal.param("vroughness").get.floats.head == alpha(.2f))
      val after = value(made, shown(made, "uroughness"))
      for u <- Vector(.1f, .37f, .8f) do
        assert(Math.abs(after(u, .5f, Vec3.Zero).g - alpha(.1f + .4f * u)) < 1e-4f)

  private val marble =
    "Texture \"m\" \"spectrum\" \"marble\" \"float variation\" .5 \"integer octaves\" 2\n"

  test("marble is painted for each shape, by its own u and v"):
    TempFolder.use: folder =>
      val text = s"$marble Material \"diffuse\" \"texture reflectance\" \"m\" Translate 0 0 -1 "
      val scene = SceneTexts.parse(s"WorldBegin\n$text", Dialect.V4, folder)
      val before = value(scene, "m")
      def check(shape: String)(point: (Float, Float) => Vec3) =
        val made = converted(s"$text $shape", Dialect.V4, Dialect.V3, folder)
        assert(made.warnings.exists(_.message.contains("using an image of 128 × 128 pixels")))
        assert(!made.scene.textures.exists(_.texture.name == "marble"))
        val after = value(made.scene, shown(made.scene, "Kd"))
        val off =
          for k <- 1 to 40 yield
            val (u, v) = (0.02f + k * 0.0237f, 0.02f + k * 0.618f % 0.96f)
            distance(before(u, v, point(u, v)), after(u, v, point(u, v)))
        // Marble changes by a few parts within a pixel
        assert(off.max < 0.05f && off.sum / off.size < 0.01f, off)
      val once = square.replace("float uv\" [0 0 3 0 3 3 0 3]", "point2 uv\" [0 0 1 0 1 1 0 1]")
      check(once)((u, v) => Vec3(2 * u, 2 * v, 0))
      check("Shape \"sphere\" \"float radius\" 2"): (u, v) =>
        val (theta, phi) = (Math.PI * (1 - v), 2 * Math.PI * u)
        val r = 2 * Math.sin(theta)
        Vec3(
          (r * Math.cos(phi)).toFloat,
          (r * Math.sin(phi)).toFloat,
          (2 * Math.cos(theta)).toFloat - 1
        )

  test("marble stays, with the reason, where u and v do not tell points apart"):
    TempFolder.use: folder =>
      val twice = square.replace("[0 0 3 0 3 3 0 3]", "[0 0 1 0 1 1 1 0]")
      for shape <- Vector(twice, "Shape \"loopsubdiv\"") do
        val text = s"$marble Material \"diffuse\" \"texture reflectance\" \"m\" $shape"
        val made = converted(text, Dialect.V4, Dialect.V3, folder)
        assert(made.warnings.exists(_.message.contains("its points do not have distinct u and v")))
        assert(shown(made.scene, "Kd") == "m")

  test("v2's marble is v4's, so nothing is said or painted"):
    TempFolder.use: folder =>
      val text = marble.replace("spectrum", "color") +
        "Material \"matte\" \"texture Kd\" \"m\" Shape \"sphere\""
      val made = converted(text, Dialect.V2, Dialect.V4, folder)
      assert(made.warnings.isEmpty && shown(made.scene, "reflectance") == "m")
      assert(converted(text, Dialect.V2, Dialect.V3, folder).warnings.size == 1)

  test("a conversion that fails leaves none of its files, and those of others"):
    TempFolder.use: folder =>
      val others = SideFiles(folder).add("mesh", "ply", Array[Byte](1))
      val files = SideFiles(folder)
      val _ = intercept[IllegalStateException]:
        files.completing:
          val _ = files.add("mesh", "ply", Array[Byte](1))
          val _ = files.add("mesh", "ply", Array[Byte](2))
          throw IllegalStateException()
      assert(TempFolder.names(folder) == Set(others))
      assert(Files.size(folder.resolve(others)) == 1)
