package candela.convert

import candela.base.loop
import candela.build.SceneBuilder
import candela.color.Rgb
import candela.image.{Image, ImageFiles}
import candela.render.Renderer
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.{SceneTexts, TempFolder}

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class FromGltfSuite extends AnyFunSuite:

  /** A ball in uniform light, seen from afar: its mean is that over all directions. */
  private def ball(material: String, textures: String = ""): String =
    s"""Transform [ 1 0 0 0  0 1 0 0  0 0 -1 0  0 0 5 1 ]
       |Camera "orthographic" "float screenwindow" [-1 1 -1 1]
       |Film "rgb" "integer xresolution" 16 "integer yresolution" 16
       |PixelFilter "box"
       |WorldBegin
       |LightSource "infinite" "rgb L" [1 1 1]
       |$textures
       |MakeNamedMaterial "surface" "string type" "gltf" $material
       |NamedMaterial "surface"
       |Shape "sphere"""".stripMargin

  private def mean(scene: SceneDescription): Rgb =
    val settings = RenderSettings(samples = Some(256), quick = true, color = ColorMode.Rgb)
    val (plan, _) = SceneBuilder.build(scene, settings)
    val image = Renderer.render(plan, 1).image(plan.development).toRgb
    var sum = Rgb.Black
    loop(image.width * image.height): i =>
      sum += Rgb(image.data(3 * i), image.data(3 * i + 1), image.data(3 * i + 2))
    sum * (1f / (image.width * image.height))

  /** Coats colour light by spectra in pbrt-v4, and by three numbers in glTF. */
  private val Tolerance = 0.04f

  private def assertAlike(text: String, folder: Path): Unit =
    val parsed = SceneTexts.parse(text, Dialect.V4, folder)
    // Products of colours are pbrt-v3's, as the reader writes them
    val scene = parsed.copy(
      dialect = Dialect.Gltf,
      textures = parsed.textures.map: t =>
        if t.texture.name == "scale" then
          t.copy(texture = t.texture.copy(dialect = Some(Dialect.V3)))
        else t
    )
    val converted = Converter.convert(scene, Dialect.V4, folder).scene
    val again = Descriptions.read(Descriptions.text(converted), folder)
    val (before, after) = (mean(scene), mean(again))
    for (a, b) <- Vector(before.r -> after.r, before.g -> after.g, before.b -> after.b) do
      assert(Math.abs(b / a - 1f) < Tolerance, s"$before, $after")

  for roughness <- Vector(0.0, 0.25, 0.5, 1.0); metallic <- Vector(0, 1) do
    test(s"colours are as bright at roughness $roughness, metallic $metallic"):
      val color = """"rgb color" [0.8 0.4 0.1]"""
      val numbers = s""""float roughness" $roughness "float metallic" $metallic"""
      TempFolder.use(folder => assertAlike(ball(s"$color $numbers"), folder))

  test("images are as bright, times the colour"):
    TempFolder.use: folder =>
      val image = Image.rgb(2, 1)
      Array(0.9f, 0.2f, 0.5f, 0.1f, 0.6f, 0.5f).copyToArray(image.data): Unit
      Files.write(folder.resolve("a.png"), ImageFiles.png(image)): Unit
      val textures = """Texture "a" "spectrum" "imagemap" "string filename" "a.png"
                       |Texture "b" "spectrum" "scale" "texture tex1" "a" "rgb tex2" [1 0.5 0.9]
                       |""".stripMargin
      val material = """"texture color" "b" "float roughness" 0.7 "float metallic" 0.2"""
      assertAlike(ball(material, textures), folder)

  test("lights without a shadow become those that pbrt-v4 has"):
    TempFolder.use: folder =>
      def converted(inView: Boolean) =
        val text =
          s"""WorldBegin
             |Material "interface"
             |AreaLightSource "diffuse" "rgb L" [1 1 1] "bool inview" $inView
             |  "float spread" 60 "vector3 axis" [0 0 1]
             |Shape "sphere"
             |""".stripMargin
        val scene = SceneTexts.parse(text, Dialect.V4, folder).copy(dialect = Dialect.Gltf)
        Converter.convert(scene, Dialect.V4, folder)
      val hidden = converted(inView = false)
      val shape = hidden.scene.shapes.head
      assert(shape.shape.param("alpha").get.floats.toVector == Vector(0f))
      assert(shape.areaLight.get.params.map(_.name) == Vector("L"))
      assert(shape.material.declared(Map.empty).get.name == "diffuse")
      assert(hidden.warnings.exists(_.message.contains("beams")))
      assert(converted(inView = true).scene.shapes.head.shape.param("alpha").isEmpty)

  /** Declarations of the materials that a material of glTF becomes. */
  private def converted(material: String, textures: String = "") =
    TempFolder.use: folder =>
      val scene = SceneTexts.parse(ball(material, textures), Dialect.V4, folder)
      val result = Converter.convert(scene.copy(dialect = Dialect.Gltf), Dialect.V4, folder)
      (result.scene.namedMaterials.map(_._2), result.warnings.map(_.message))

  test("glass that disperses has an index at each wavelength"):
    val glass = """"float metallic" 0 "float transmission" 1 "bool thin" false "float eta" 1.6"""
    val (Vector(plain), _) = converted(glass): @unchecked
    assert(plain.param("eta").get.floats.toVector == Vector(1.6f))
    val (Vector(d), _) = converted(s"""$glass "float dispersion" 2"""): @unchecked
    val eta = d.param("eta").get.floats.grouped(2).map(p => p(0) -> p(1)).toMap
    assert(eta(400f) > eta(590f) && eta(590f) > eta(700f) && Math.abs(eta(590f) - 1.6f) < 1e-3f)

  test("what transmits diffusely becomes a \"diffusetransmission\""):
    val (Vector(d), warnings) = converted(
      """"float metallic" 0 "rgb color" [.8 .4 .2] "float diffusetransmission" 0.25
        |"rgb diffusetransmissioncolor" [.4 .8 .2]""".stripMargin
    ): @unchecked
    assert(d.name == "diffusetransmission" && warnings.exists(_.contains("no highlights")))
    def numbers(name: String) = d.param(name).get.floats.map(x => Math.rint(1e6 * x) / 1e6).toVector
    assert(numbers("reflectance") == Vector(0.6, 0.3, 0.15))
    assert(numbers("transmittance") == Vector(0.1, 0.2, 0.05))

  test("films and wraps that pbrt lacks are named"):
    val texture = """Texture "a" "spectrum" "imagemap" "string filename" "none.png"
                    |"string wrap" "repeat" "string wrapt" "clamp"""".stripMargin
    val warnings = converted(""""float iridescence" 1""", texture)._2
    assert(warnings.exists(_.contains("`iridescence`")) && warnings.exists(_.contains("`wrapt`")))

  test("clip planes and media behind alpha are warnings, and the camera's medium is at itself"):
    TempFolder.use: folder =>
      val parsed = SceneTexts.parse(
        """Camera "perspective" "float nearclip" 3 "float farclip" 9
          |WorldBegin
          |MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [1 2 3]
          |MediumInterface "fog" ""
          |MakeNamedMaterial "glass" "string type" "dielectric"
          |NamedMaterial "glass"
          |Shape "trianglemesh" "point3 P" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1
          |  1 -1 1 -1 1 1 1 1 1]
          |  "integer indices" [0 2 3 0 3 1 4 5 7 4 7 6 0 4 6 0 6 2
          |  1 3 7 1 7 5 0 1 5 0 5 4 2 6 7 2 7 3]
          |  "float alpha" 0.5""".stripMargin,
        Dialect.V4,
        folder
      )
      val scene = parsed.copy(dialect = Dialect.Gltf, cameraMedium = "")
      val result = Converter.convert(scene, Dialect.V4, folder)
      assert(result.scene.cameraMedium == "fog")
      val messages = result.warnings.map(_.message)
      assert(messages.count(_.startsWith("pbrt-v4 takes a spectrum of the color `sigma_")) == 1)
      for name <- Vector("nearclip", "farclip") do
        assert(messages.contains(s"pbrt's cameras have no `$name`; nothing is clipped"), messages)
      assert(
        messages.contains("pbrt has no medium of material `glass` where alpha opens its surface")
      )
