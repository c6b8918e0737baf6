package candela.bdpt

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.color.Rgb
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.{RenderRegion, RenderSettings}
import candela.testing.SceneTexts

/** All strategies together find the light that each path tracer finds, and light that no path from
  * the camera does.
  */
final class BidirectionalPathTracerSuite extends AnyFunSuite:
  private val room = """Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7]
    "point3 P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0  -2 2 0  2 2 0  2 2 3  -2 2 3]"""
  private val ball = """AttributeBegin
    Translate .3 .4 .6
    Shape "sphere" "float radius" .6
    AttributeEnd"""
  private val emitter = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [8 6 4]
    Translate -.5 0 2.2
    Shape "sphere" "float radius" .4
    AttributeEnd"""

  private def scene(
      integrator: String,
      lights: String,
      materials: (String, String),
      dialect: Dialect,
      camera: String,
      spp: Int
  ): String =
    val isV4 = dialect == Dialect.V4
    val world = if isV4 then room else room.replace("point3", "point")
    s"""LookAt 0 -5 2.5  0 0 .6  0 0 1
       |Camera $camera
       |Film "${if isV4 then "rgb" else "image"}" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "${if isV4 then "independent" else "random"}" "integer pixelsamples" $spp
       |PixelFilter "triangle"
       |Integrator $integrator
       |WorldBegin
       |$lights
       |${materials._1}
       |$world
       |${materials._2}
       |$ball
       |""".stripMargin

  private val perspective = """"perspective" "float fov" 35"""
  private val matte = """Material "matte" "rgb Kd" [.6 .5 .4]"""
  private val diffuse = """Material "diffuse" "rgb reflectance" [.6 .5 .4]"""
  private val point = """LightSource "point" "point from" [-1 -1 2.5] "rgb I" [9 9 9]"""

  private val cases: Seq[(String, String, (String, String), Dialect, String)] = Seq(
    ("a point", point, (matte, matte), Dialect.V3, perspective),
    (
      "parallel light",
      """LightSource "distant" "point from" [1 -2 3] "rgb L" [2 2 2]""",
      (matte, matte),
      Dialect.V3,
      perspective
    ),
    (
      "a spot",
      """LightSource "spot" "point from" [-1 -1 2.5] "point to" [0 0 0] "rgb I" [19 9 9]""",
      (matte, matte),
      Dialect.V3,
      perspective
    ),
    ("an emitter", emitter, (matte, matte), Dialect.V3, perspective),
    (
      "a sky",
      """LightSource "infinite" "rgb L" [1 1 1]""",
      (matte, matte),
      Dialect.V3,
      perspective
    ),
    (
      "an emitter, a point and a sky",
      emitter + "\n" + point + """
      LightSource "infinite" "rgb L" [.3 .3 .5]""",
      (matte, """Material "plastic" "float roughness" .2"""),
      Dialect.V3,
      perspective
    ),
    (
      "rough glass",
      emitter,
      (matte, """Material "glass" "float uroughness" .4 "float vroughness" .4"""),
      Dialect.V3,
      perspective
    ),
    ("smooth glass", emitter, (matte, """Material "glass""""), Dialect.V3, perspective),
    (
      "rough glass of v4",
      emitter,
      (diffuse, """Material "dielectric" "float roughness" .4"""),
      Dialect.V4,
      perspective
    ),
    (
      "a layered surface",
      emitter,
      (diffuse, """Material "coateddiffuse" "float roughness" .3"""),
      Dialect.V4,
      perspective
    ),
    (
      "a lens",
      emitter,
      (matte, matte),
      Dialect.V3,
      perspective + """ "float lensradius" .3 "float focaldistance" 4"""
    ),
    (
      "parallel projection",
      point,
      (matte, matte),
      Dialect.V3,
      """"orthographic" "float screenwindow" [-2 2 -2 2]"""
    ),
    ("a camera without light paths", point, (matte, matte), Dialect.V3, perspective)
  )

  private val Seeds = 8

  /** Means of the image, by a few independent renderings. */
  private def means(text: String, dialect: Dialect): Seq[Double] =
    (1 to Seeds).map: seed =>
      val plan = SceneTexts.plan(text, dialect, RenderSettings(seed = seed))
      val image = Renderer.render(plan, threads = 1).image(plan.development)
      image.data.map(_.toDouble).sum / image.data.length

  private def meanAndVariance(values: Seq[Double]): (Double, Double) =
    val mean = values.sum / values.size
    (mean, values.map(v => square(v - mean)).sum / (values.size - 1) / values.size)

  private def square(x: Double): Double = x * x

  for (name, lights, materials, dialect, camera) <- cases do
    test(s"$name: the mean is that of path tracing", Slow):
      def found(integrator: String) =
        val text = scene(integrator, lights, materials, dialect, camera, spp = 24)
        // Light paths do not know yet where a camera that moves sees them
        val moves = "ActiveTransform EndTime\nTranslate .1 0 0\nActiveTransform All\nCamera"
        val seen = if name.startsWith("a camera") then text.replace("Camera", moves) else text
        meanAndVariance(means(seen, dialect))
      val (a, va) = found("\"bdpt\" \"integer maxdepth\" 4")
      val (b, vb) = found("\"path\" \"integer maxdepth\" 4")
      val apart = Math.abs(a - b) / Math.sqrt(va + vb)
      // Student's distribution with some 10 degrees of freedom: beyond 5 once in 2,000 times
      assert(apart < 5, s"$a, expected $b")
      assert(Math.sqrt(va + vb) < 0.05 * b, "too much noise to tell")

  test("bumps under a sky: the mean is that of path tracing, which samples one side only", Slow):
    val sky = """LightSource "infinite" "rgb L" [1 1 1]"""
    val bumps = """Texture "w" "float" "wrinkled"
      Texture "bumps" "float" "scale" "texture tex1" "w" "float tex2" .5
      Material "matte" "rgb Kd" [.9 .9 .9] "texture bumpmap" "bumps""""
    def found(integrator: String) =
      val text = scene(integrator, sky, (bumps, ""), Dialect.V3, perspective, spp = 240)
      meanAndVariance(means(text, Dialect.V3))
    val (a, va) = found("\"bdpt\" \"integer maxdepth\" 4")
    val (b, vb) = found("\"path\" \"integer maxdepth\" 4")
    // Five deviations, as above
    assert(Math.abs(a - b) / Math.sqrt(va + vb) < 5, s"$a, expected $b")
    assert(Math.sqrt(va + vb) < 0.005 * b, "too much noise to tell")

  test(
    "roulette for minor connections keeps the mean, where most are minor: in a bright ball",
    Slow
  ):
    def found(integrator: String) =
      val text = s"""Integrator $integrator
        |Camera "perspective" "float fov" 60
        |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
        |Sampler "paddedsobol" "integer pixelsamples" 256
        |WorldBegin
        |Material "diffuse" "rgb reflectance" [.9 .9 .9]
        |Shape "sphere" "float radius" 1
        |AreaLightSource "diffuse" "rgb L" [1 1 1]
        |Translate .4 .5 -.4
        |Shape "sphere" "float radius" .3
        |""".stripMargin
      meanAndVariance(means(text, Dialect.V4))
    val (a, va) = found("\"bdpt\" \"integer maxdepth\" 12")
    val (b, vb) = found("\"path\" \"integer maxdepth\" 12")
    // Five deviations, as above
    assert(Math.abs(a - b) / Math.sqrt(va + vb) < 5, s"$a, expected $b")
    assert(Math.sqrt(va + vb) < 0.002 * b, "too much noise to tell")

  test("a point in the middle of a glass ball lights as it does without: no path finds it", Slow):
    // All of the light leaves along the radius at last, however often it is reflected
    def text(integrator: String, glass: String, camera: String, space: String) =
      s"""$space
         |LookAt 3 0 1.5  0 0 0  0 1 0
         |Camera $camera
         |Film "image" "integer xresolution" 4 "integer yresolution" 4
         |Sampler "random" "integer pixelsamples" 6000
         |Integrator $integrator "integer maxdepth" 8
         |WorldBegin
         |LightSource "point" "point from" [0 0 1] "rgb I" [4 4 4]
         |Material "matte" "rgb Kd" [.5 .5 .5]
         |Shape "disk" "float radius" 1
         |AttributeBegin
         |Translate 0 0 1
         |$glass
         |AttributeEnd
         |""".stripMargin
    val glass = "Material \"glass\" \"float eta\" 1.5\nShape \"sphere\" \"float radius\" .3"
    val cameras = Seq(
      """"orthographic" "float screenwindow" [-.4 .4 -.4 .4]""",
      """"perspective" "float fov" 14""",
      """"perspective" "float fov" 14 "float lensradius" .2 "float focaldistance" 3"""
    )
    val spaces = Seq(
      "Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1]",
      "Transform [.866 .5 0 0  -.5 .866 0 0  0 0 1 0  0 0 0 1]",
      "Scale 1 1.3 .7",
      "Transform [1 .3 .2 0  .4 1 .1 0  0 0 1 0  0 0 0 1]"
    )
    // Noise of about 1 %; a determinant that was left out would show as 9 %
    for camera <- cameras; space <- spaces do
      def mean(integrator: String, glass: String) =
        SceneTexts.mean(text(integrator, glass, camera, space))
      assert(mean("\"path\"", glass).largest == 0f)
      val expected = mean("\"path\"", "")
      val found = mean("\"bdpt\"", glass)
      assert(Math.abs(found.g / expected.g - 1f) < 0.045f, s"$camera $space $found, not $expected")

  test("so it does in pbrt-v2, whose refraction leaves radiance as it is", Slow):
    def text(integrator: String, glass: String) =
      s"""LookAt 3 0 3  0 0 0  0 1 0
         |Camera "orthographic" "float screenwindow" [-.2 .2 -.2 .2]
         |Film "image" "integer xresolution" 4 "integer yresolution" 4
         |Sampler "random" "integer pixelsamples" 2000
         |$integrator
         |WorldBegin
         |LightSource "point" "point from" [0 0 1] "rgb I" [4 4 4]
         |Material "matte" "rgb Kd" [.5 .5 .5]
         |Shape "disk" "float radius" 1
         |AttributeBegin
         |Translate 0 0 1
         |$glass
         |AttributeEnd
         |""".stripMargin
    val glass = "Material \"glass\" \"float index\" 1.5\nShape \"sphere\" \"float radius\" .3"
    val expected = SceneTexts.mean(text("SurfaceIntegrator \"path\"", ""), Dialect.V2)
    for integrator <- Seq("SurfaceIntegrator \"photonmap\"", "Renderer \"metropolis\"") do
      val found = SceneTexts.mean(text(integrator, glass), Dialect.V2)
      // Of light paths 2 % reach the view: of 32,000 photons that leaves 4 %, of 100,000 paths 2 %
      assert(Math.abs(found.g / expected.g - 1f) < 0.04f, s"$found, expected $expected")

  test("the image is the same bit for bit by one thread and by three"):
    val text =
      scene(
        "\"bdpt\"",
        emitter + "\n" + point,
        (matte, "Material \"glass\""),
        Dialect.V3,
        perspective,
        4
      )
    val images = Seq(1, 3).map: threads =>
      val plan = SceneTexts.plan(text)
      Renderer.render(plan, threads).image(plan.development).data.toVector
    assert(images(0) == images(1) && images(0).exists(_ > 0f))

  test("light that is seen at once is all that depth 0 shows"):
    val text = scene(
      "\"bdpt\" \"integer maxdepth\" 0",
      emitter,
      (matte, matte),
      Dialect.V3,
      perspective,
      16
    ).replace("\"triangle\"", "\"box\"") // the same samples for both: none is shared by pixels
    val same = text.replace("bdpt", "path")
    assert((SceneTexts.mean(text) - SceneTexts.mean(same)).largest < 1e-5f)
    assert(SceneTexts.mean(text) != Rgb.Black)

  test("a crop window shows what the whole image shows there"):
    val text = scene("\"bdpt\"", point, (matte, matte), Dialect.V3, perspective, 2000)
    val plan = SceneTexts.plan(text)
    val whole = Renderer.render(plan, threads = 2).image(plan.development)
    val right = RenderRegion.Window(0.25f, 0.75f, 0.5f, 1f)
    val cut = RenderSettings(region = right, samples = Some(8000))
    val part = SceneTexts.plan(text, options = cut)
    val crop = Renderer.render(part, threads = 2).image(part.development)
    val (a, b) = (
      (for y <- 4 until 8; x <- 2 until 6 yield whole(x, y, 1)).sum,
      (for y <- 0 until 4; x <- 0 until 4 yield crop(x, y, 1)).sum
    )
    // 32,000 paths of the whole and 128,000 of the crop: at deviations of 2, 1.1 and 0.6 %
    assert(Math.abs(a / b - 1f) < 0.03f)
