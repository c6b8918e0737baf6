package candela.photons

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.render.Renderer
import candela.scenefile.Dialect
import candela.testing.SceneTexts

final class PhotonMapperSuite extends AnyFunSuite:

  private def room(integrator: String, material: String): String =
    s"""LookAt 0 -5 2.5  0 0 .6  0 0 1
       |Camera "perspective" "float fov" 35
       |Film "image" "integer xresolution" 16 "integer yresolution" 16
       |Sampler "random" "integer pixelsamples" 64
       |PixelFilter "box"
       |Integrator $integrator
       |WorldBegin
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [8 6 4]
       |Translate -.5 0 2.2
       |Shape "sphere" "float radius" .4
       |AttributeEnd
       |LightSource "infinite" "rgb L" [.2 .2 .3]
       |Material "matte" "rgb Kd" [.6 .5 .4]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7]
       |  "point P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0  -2 2 0  2 2 0  2 2 3  -2 2 3]
       |$material
       |Translate .3 .4 .6
       |Shape "sphere" "float radius" .6
       |""".stripMargin

  private val sppm =
    "\"sppm\" \"integer iterations\" 64 \"float radius\" .12 \"integer photonsperiteration\" 2000"

  for
    material <- Seq(
      """Material "matte" "rgb Kd" [.5 .5 .5]""",
      """Material "glass"""",
      """Material "metal" "float roughness" .02""",
      """Material "glass" "float uroughness" .3 "float vroughness" .3""",
      // As in pbrt, followed until the last event: photons would light hair from behind
      """Material "hair" "float beta_m" 1 "float beta_n" 1 "float eumelanin" 8""",
      """Material "uber" "rgb Kr" [.3 .3 .3] "float roughness" .1"""
    )
  do
    test(s"the mean is that of path tracing: $material"):
      val found = SceneTexts.mean(room(sppm, material))
      val expected = SceneTexts.mean(room("\"path\" \"integer maxdepth\" 5", material))
      // Noise of some 1 %, and a little light is lost beyond edges within the radius
      assert(Math.abs(found.g / expected.g - 1f) < 0.04f, s"$found, expected $expected")

  test("light of a point by way of glass is seen in a mirror: no other integrator finds it"):
    def text(integrator: String, glass: String, mirror: Boolean, dialect: Dialect) =
      val place = if mirror then "-3 0 1  0 0 8" else "-1.71 0 4  0 0 0"
      val name = if dialect == Dialect.V2 then "SurfaceIntegrator" else "Integrator"
      s"""LookAt $place  0 1 0
         |Camera "orthographic" "float screenwindow" [-.05 .05 -.05 .05]
         |Film "image" "integer xresolution" 4 "integer yresolution" 4
         |Sampler "random" "integer pixelsamples" 100
         |$name $integrator
         |WorldBegin
         |LightSource "point" "point from" [0 0 1] "rgb I" [4 4 4]
         |AttributeBegin
         |Material "mirror" "rgb Kr" [1 1 1]
         |Translate -1.71 0 4
         |Shape "disk" "float radius" .5
         |AttributeEnd
         |Material "matte" "rgb Kd" [.5 .5 .5]
         |Shape "disk" "float radius" 1
         |Translate 0 0 1
         |$glass
         |""".stripMargin
    val glass = """Material "glass" "float eta" 1.5 "float index" 1.5
      Shape "sphere" "float radius" .3"""
    val path = "\"path\" \"integer maxdepth\" 8"
    for dialect <- Seq(Dialect.V2, Dialect.V3) do
      val expected = SceneTexts.mean(text(path, "", mirror = true, dialect), dialect)
      assert(expected.g > 0.5f)
      val method =
        if dialect == Dialect.V2 then "\"photonmap\" \"float maxdist\" .2"
        else
          "\"sppm\" \"integer maxdepth\" 8 \"float radius\" .1 \"integer iterations\" 100 " +
            "\"integer photonsperiteration\" 2000"
      // v2 sends out as many photons as there are pixels, of which some 300 arrive, v3 has three
      // times as many there
      val tolerance = if dialect == Dialect.V2 then 0.3f else 0.15f
      val picture = text(method, glass, mirror = true, dialect)
      val large =
        if dialect == Dialect.V3 then picture
        else
          picture.replace(
            "resolution\" 4",
            "resolution\" 32"
          ).replace("samples\" 100", "samples\" 30")
      val found = SceneTexts.mean(large, dialect)
      assert(Math.abs(found.g / expected.g - 1f) < tolerance, s"$found, expected $expected")
    val lost = text("\"bdpt\" \"integer maxdepth\" 8", glass, mirror = true, Dialect.V3)
    assert(SceneTexts.mean(lost).largest == 0f)

  test("v2's map without photons of a kind lacks that light"):
    def text(integrator: String) =
      s"""LookAt 3 0 3  0 0 0  0 1 0
         |Camera "orthographic" "float screenwindow" [-.2 .2 -.2 .2]
         |Film "image" "integer xresolution" 16 "integer yresolution" 16
         |Sampler "random" "integer pixelsamples" 16
         |SurfaceIntegrator "photonmap" "float maxdist" .2 $integrator
         |WorldBegin
         |LightSource "point" "point from" [0 0 1] "rgb I" [4 4 4]
         |Material "matte" "rgb Kd" [.5 .5 .5]
         |Shape "disk" "float radius" 1
         |Material "glass"
         |Translate 0 0 1
         |Shape "sphere" "float radius" .3
         |""".stripMargin
    def seen(integrator: String) = SceneTexts.mean(text(integrator), Dialect.V2).g
    assert(seen("") > 0.1f && seen("\"integer indirectphotons\" 0") > 0.1f)
    // Only what the floor sends back into the glass returns once more
    assert(seen("\"integer causticphotons\" 0") < 0.05f)

  test("the image is the same bit for bit by one thread and by three"):
    val text = room(sppm.replace("iterations\" 64", "iterations\" 5"), "Material \"glass\"")
    val images = Seq(1, 3).map: threads =>
      val plan = SceneTexts.plan(text)
      assert(plan.sampler.samplesPerPixel == 5)
      Renderer.render(plan, threads).image(plan.development).data.toVector
    assert(images(0) == images(1) && images(0).exists(_ > 0f))

  test("a light with holes lights what is matte, glossy or behind glass as in path tracing", Slow):
    def text(integrator: String, material: String) =
      s"""LookAt 0 -5 2.5  0 0 .6  0 0 1
         |Camera "perspective" "float fov" 35
         |Film "rgb" "integer xresolution" 16 "integer yresolution" 16
         |Sampler "independent" "integer pixelsamples" 64
         |PixelFilter "box"
         |Integrator $integrator
         |WorldBegin
         |Texture "sieve" "float" "checkerboard" "float uscale" 4 "float vscale" 4
         |  "float tex1" 1 "float tex2" .2
         |AttributeBegin
         |AreaLightSource "diffuse" "rgb L" [8 6 4]
         |Translate -.5 0 2.2
         |Rotate 180 1 0 0
         |Shape "disk" "float radius" .8 "texture alpha" "sieve"
         |AttributeEnd
         |Material "diffuse" "rgb reflectance" [.6 .5 .4]
         |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3  4 5 6 4 6 7]
         |  "point3 P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0  -2 2 0  2 2 0  2 2 3  -2 2 3]
         |$material
         |Translate .3 .4 .6
         |Shape "sphere" "float radius" .6
         |""".stripMargin
    for
      material <- Seq(
        """Material "diffuse"""",
        """Material "conductor" "float roughness" .1""",
        """Material "dielectric""""
      )
    do
      val found = SceneTexts.mean(
        text("\"sppm\" \"float radius\" .12 \"integer photonsperiteration\" 2000", material),
        Dialect.V4
      )
      val expected =
        SceneTexts.mean(text("\"path\" \"integer maxdepth\" 5", material), Dialect.V4)
      // Noise as above, and that of the holes
      assert(Math.abs(found.g / expected.g - 1f) < 0.05f, s"$found, expected $expected")

  test("a radius of nothing is an error"):
    val text = room("\"sppm\" \"float radius\" 0", "")
    assert(SceneTexts.problems(text).exists(_.message.contains("`radius` must be at least")))
