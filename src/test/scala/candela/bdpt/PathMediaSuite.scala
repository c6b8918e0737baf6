package candela.bdpt

import candela.color.Rgb
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** Bidirectional paths through media see the light that paths from the camera see, and more. */
final class PathMediaSuite extends AnyFunSuite:

  private val coloured = """"homogeneous" "rgb sigma_s" [4 .8 .1] "rgb sigma_a" [.1 .2 .3]"""
  private val cells = (1 to 8).map(i => f"${(i % 3) * 0.5}%.1f").mkString(" ")
  private val cloudy = s""""uniformgrid" "integer nx" 2 "integer ny" 2 "integer nz" 2
    "float density" [$cells] "rgb sigma_s" [2 2 2] "rgb sigma_a" [.2 .3 .4]
    "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1]"""
  private val glowing = s"""$coloured "rgb Le" [.3 .2 .1]"""

  private val emitter = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [8 6 4]
    Translate -.5 0 2.6
    Shape "sphere" "float radius" .4
    AttributeEnd"""
  private val inside = """AttributeBegin
    AreaLightSource "diffuse" "rgb L" [8 6 4]
    MediumInterface "" "m"
    Translate .3 0 1
    Shape "sphere" "float radius" .25
    AttributeEnd"""
  private val point = """LightSource "point" "point3 from" [-1 -1 2.5] "rgb I" [9 9 9]"""
  private val enclosed = """LightSource "point" "point3 from" [.3 0 1.1] "rgb I" [4 4 4]"""
  private val sky = """LightSource "infinite" "rgb L" [1 1 1]"""

  private def scene(integrator: String, medium: String, light: String, spp: Int, depth: Int) =
    s"""LookAt 0 -5 2.5  0 0 .6  0 0 1
       |Camera "perspective" "float fov" 35
       |Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "independent" "integer pixelsamples" $spp
       |Integrator $integrator "integer maxdepth" $depth
       |WorldBegin
       |MakeNamedMedium "m" "string type" $medium "float g" .3
       |$light
       |Material "diffuse" "rgb reflectance" [.6 .5 .4]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7]
       |  "point3 P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0  -2 2 0  2 2 0  2 2 3  -2 2 3]
       |AttributeBegin
       |Material "interface"
       |MediumInterface "m" ""
       |Translate .3 0 1
       |Shape "sphere" "float radius" .9
       |AttributeEnd
       |""".stripMargin

  private def color(text: String): Rgb = SceneTexts.mean(text, Dialect.V4)
  private def mean(text: String): Float = color(text).g

  private val cases = Seq(
    ("coloured smoke, an emitter", coloured, emitter),
    ("an emitter inside the smoke", coloured, inside),
    ("a cloud of cells, a point", cloudy, point),
    ("glowing gas, a sky", glowing, sky)
  )

  for (what, medium, light) <- cases; depth <- Seq(1, 3) do
    test(s"bdpt sees what volpath sees: $what, depth $depth", Slow):
      val bdpt = color(scene("\"bdpt\"", medium, light, 1000, depth))
      val path = color(scene("\"volpath\"", medium, light, 4000, depth))
      // 64,000 and 256,000 paths, whose deviations are up to five times the mean: 2 %; blue, which
      // is scattered least, has more
      for (b, p) <- Seq(bdpt.r -> path.r, bdpt.g -> path.g) do
        assert(p > 0.01f && Math.abs(b - p) < 0.04f * p, s"$bdpt, volpath $path")

  test("around a point in smoke volpath, of no finite variance there, sees a little less", Slow):
    val bdpt = mean(scene("\"bdpt\"", coloured, enclosed, 1000, 3))
    val path = mean(scene("\"volpath\"", coloured, enclosed, 4000, 3))
    assert(bdpt > 0.97f * path && bdpt < 1.12f * path, s"$bdpt, volpath $path")

  test("the chains of mlt see it, too", Slow):
    val metropolis = "\"mlt\" \"integer mutationsperpixel\" 2000 \"integer chains\" 50"
    val mlt = mean(scene(metropolis, coloured, emitter, 1, 3))
    val path = mean(scene("\"volpath\"", coloured, emitter, 4000, 3))
    assert(Math.abs(mlt - path) < 0.05f * path, s"$mlt, volpath $path") // brightness, 0.3 %; noise

  test("light of a point goes through a ball of glass into smoke, which volpath can't see"):
    def caustic(integrator: String) =
      val glass = """AttributeBegin
        Material "dielectric" "float eta" 1.4
        MediumInterface "m" ""
        Translate .3 0 1
        Shape "sphere" "float radius" .9
        AttributeEnd"""
      val text = scene(integrator, coloured, point, 500, 4)
      val ball = text.indexOf("AttributeBegin\nMaterial \"interface\"")
      mean(text.take(ball) + glass)
    val (bdpt, path) = (caustic("\"bdpt\""), caustic("\"volpath\""))
    assert(bdpt > 1.05f * path, s"$bdpt, volpath $path")

  /** The camera, the lights and the ball are in fog without end. */
  private def inFog(text: String) =
    val fog = "\"homogeneous\" \"rgb sigma_s\" [.02 .1 .15] \"rgb sigma_a\" [.02 .02 .02]"
    text
      .replace(
        "LookAt",
        s"MakeNamedMedium \"f\" \"string type\" $fog\nMediumInterface \"\" \"f\"\nLookAt"
      )
      .replace("MediumInterface \"m\" \"\"", "MediumInterface \"m\" \"f\"")

  test("bdpt sees what volpath sees from within fog without end", Slow):
    val bdpt = color(inFog(scene("\"bdpt\"", coloured, emitter, 1000, 3)))
    val path = color(inFog(scene("\"volpath\"", coloured, emitter, 4000, 3)))
    // As above
    for (b, p) <- Seq(bdpt.r -> path.r, bdpt.g -> path.g, bdpt.b -> path.b) do
      assert(p > 0.01f && Math.abs(b - p) < 0.04f * p, s"$bdpt, volpath $path")

  test("a point light is in the medium declared around it, whatever side the ground shows it"):
    def overGround(integrator: String, spp: Int) =
      val text = inFog(scene(integrator, coloured, point, spp, 1))
      text
        .take(text.indexOf("AttributeBegin\nMaterial \"interface\""))
        .replace("[.6 .5 .4]\nShape", "[0 0 0]\nReverseOrientation\nShape")
    val bdpt = color(overGround("\"bdpt\"", 1000))
    val path = color(overGround("\"volpath\"", 4000))
    // As above
    for (b, p) <- Seq(bdpt.g -> path.g, bdpt.b -> path.b) do
      assert(p > 0.01f && Math.abs(b - p) < 0.04f * p, s"$bdpt, volpath $path")

  test("media agree from within a ball of smoke, too, under a sky", Slow):
    val medium = s"MakeNamedMedium \"m\" \"string type\" $coloured \"float g\" .3\n"
    def within(integrator: String, spp: Int) =
      scene(integrator, coloured, sky, spp, 3)
        .replace(medium, "")
        .replace("LookAt 0 -5 2.5", s"${medium}MediumInterface \"\" \"m\"\nLookAt .3 -.6 1")
        .replace("WorldBegin", "MediumInterface \"\" \"\"\nWorldBegin")
    val bdpt = color(within("\"bdpt\"", 1000))
    val path = color(within("\"volpath\"", 4000))
    // As in the first test: 2 % of 64,000 and 256,000 paths
    for (b, p) <- Seq(bdpt.r -> path.r, bdpt.g -> path.g, bdpt.b -> path.b) do
      assert(p > 0.01f && Math.abs(b - p) < 0.04f * p, s"$bdpt, volpath $path")

  test("what is not supported is said: light from infinity in fog without end"):
    val said =
      SceneTexts.problems(inFog(scene("\"bdpt\"", coloured, sky, 1, 3)), Dialect.V4).map(_.message)
    assert(said.exists(_.contains("light from infinity in a medium without end yet")), said)
    val outside = scene("\"bdpt\"", coloured, emitter, 1, 3)
    assert(SceneTexts.problems(outside, Dialect.V4, options = RenderSettings()).isEmpty)

  test("an emitter's own surface says what is around it, where nothing else on the way does"):
    // A foggy room, whose borders are the emitter and a window before the camera
    def room(integrator: String) = s"""
      LookAt 0 -5 2.5  0 0 .6  0 0 1
      Camera "perspective" "float fov" 35
      Film "rgb" "integer xresolution" 8 "integer yresolution" 8
      Sampler "independent" "integer pixelsamples" 1024
      Integrator $integrator "integer maxdepth" 1
      WorldBegin
      MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_s" [1 1 1] "rgb sigma_a" [.2 .2 .2]
      AttributeBegin
      AreaLightSource "diffuse" "rgb L" [3200 2400 1600]
      MediumInterface "" "m"
      Translate 0 0 3
      Shape "sphere" "float radius" .02
      AttributeEnd
      Material "diffuse" "rgb reflectance" [.6 .5 .4]
      Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
        "point3 P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0]
      Material "interface"
      MediumInterface "m" ""
      Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
        "point3 P" [-9 -2.2 -9  9 -2.2 -9  9 -2.2 9  -9 -2.2 9]
      """
    val paths = mean(room("\"volpath\""))
    // Both have errors of a percent; without the fog on its way, light paths bring 17 % more
    assert(Math.abs(mean(room("\"bdpt\"")) / paths - 1f) < 0.04f)
