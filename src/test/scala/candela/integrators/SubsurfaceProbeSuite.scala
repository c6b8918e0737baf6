package candela.integrators

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** Under an even sky, a large translucent plane shows what its medium sends back; so does whatever
  * hides the same plane in another way.
  */
final class SubsurfaceProbeSuite extends AnyFunSuite:
  // The index of air: all light gets in and out
  private val even = "LightSource \"infinite\" \"rgb L\" [1 1 1]"
  private val medium =
    "Material \"kdsubsurface\" \"rgb Kd\" [.3 .6 .9] \"rgb mfp\" [.2 .3 .1] \"float eta\" 1.0001"
  private val disk = "Shape \"disk\" \"float radius\" 1000"

  private def seen(world: String, integrator: String = "\"path\" \"integer maxdepth\" 1") =
    SceneTexts.mean(
      s"""${LitPlane.view(integrator, 1024, 8)}
         |WorldBegin
         |$even
         |$world
         |WorldEnd
         |""".stripMargin
    )

  private def shows(world: String, tolerance: Float = 0.015f): Unit =
    val found = seen(world)
    // A place is found by one of three axes and as one of three channels: the weight's deviation
    // is about 1, so of 65536 samples the mean's is 0.4 %; of each profile a thousandth is left out
    for (value, right) <- Seq((found.r, 0.3f), (found.g, 0.6f), (found.b, 0.9f)) do
      assert(Math.abs(value - right) < tolerance * right, s"$found")

  test("a plane shows the albedo of its medium"):
    shows(s"$medium $disk")

  test("a plane shows it, too, where others of another material are below"):
    val other = "Material \"matte\" Translate 0 0 -.02 Shape \"disk\" \"float radius\" 1000"
    shows(s"$medium $disk AttributeBegin $other AttributeEnd")

  test("a plane above two others that touch all over"):
    val square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " +
      "\"point P\" [-99 -99 0 99 -99 0 99 99 0 -99 99 0]"
    shows(s"Material \"matte\" $square $square Translate 0 0 .01 $medium $disk")

  test("a plane of Disney's material, without gloss"):
    val disney = """Material "disney" "rgb color" [.3 .6 .9] "rgb scatterdistance" [1 2 .5]
                   |"float eta" 1.0001 "float roughness" 0""".stripMargin
    // Gloss, which is black here, takes half of the samples
    shows(s"$disney $disk", tolerance = 0.03f)

  test("a plane that an instance brings, turned and stretched"):
    shows(
      s"""ObjectBegin "it" $medium Shape "disk" ObjectEnd
         |AttributeBegin Scale 900 800 2 Rotate 30 0 0 1 ObjectInstance "it" AttributeEnd
         |""".stripMargin
    )

  test("a plane with holes sends back what enters between them"):
    // Squares and holes are far smaller than light travels, so that half is lost; the square that
    // is seen is not
    val holes =
      """Texture "holes" "float" "checkerboard" "string aamode" "none" "string mapping" "planar"
        |  "vector v1" [40 0 0] "vector v2" [0 40 0] "float udelta" .5 "float vdelta" .5
        |  "float tex1" 1 "float tex2" 0
        |""".stripMargin
    val square = """Shape "trianglemesh" "point P" [-99 -99 0 99 -99 0 99 99 0 -99 99 0]
                   |"integer indices" [0 1 2 0 2 3] "texture alpha" "holes" """.stripMargin
    val holed = seen(s"$holes $medium $square")
    for (value, right) <- Seq((holed.r, 0.3f), (holed.g, 0.6f), (holed.b, 0.9f)) do
      assert(value > 0.4f * right && value < 0.62f * right, holed)

  test("directlighting and whitted see what is behind, as through glass"):
    for integrator <- Seq("\"directlighting\"", "\"whitted\"") do
      // An index of 1.0001 changes the radiance that enters by 2e-4
      assert(Math.abs(seen(s"$medium $disk", integrator).g - 1f) < 1e-3f)

  test("v4's path sees glass, its volpath the medium"):
    def v4(integrator: String) =
      SceneTexts.mean(
        s"""${LitPlane.view(s"\"$integrator\" \"integer maxdepth\" 1", 256, 8)}
           |WorldBegin
           |$even
           |Material "subsurface" "rgb reflectance" [.5 .5 .5] "float eta" 1.0001
           |$disk
           |""".stripMargin.replace(
          "\"image\"",
          "\"rgb\""
        ).replace("\"random\"", "\"independent\""),
        Dialect.V4
      )
    // As above, and 16,384 paths that deviate by 1: 0.8 %
    assert(Math.abs(v4("path").g - 1f) < 1e-3f)
    assert(Math.abs(v4("volpath").g - 0.5f) < 0.02f)

  test("pbrt-v2 shows what it has beneath by \"dipolesubsurface\" alone"):
    def v2(integrator: String) =
      SceneTexts.mean(
        s"""${LitPlane.view("", 1024, 8).replace(
            "Integrator",
            s"SurfaceIntegrator \"$integrator\""
          )}
           |WorldBegin
           |LightSource "infinite" "color L" [1 1 1]
           |Material "kdsubsurface" "color Kd" [.3 .6 .9] "color Kr" [0 0 0] "float index" 1.3
           |$disk
           |WorldEnd
           |""".stripMargin,
        Dialect.V2
      )
    val found = v2("dipolesubsurface")
    // Of diffuse light a part of 0.555 leaves, at 45° one of 0.976; 0.49 of the surface counts, and
    // this one, which has no inside, is lit from both sides
    val counted = 0.49f * 0.976f * 0.555f * 2f
    for (value, right) <- Seq((found.r, 0.3f), (found.g, 0.6f), (found.b, 0.9f)) do
      assert(Math.abs(value / (right * counted) - 1f) < 0.05f, s"$found")
    assert(v2("path").max == 0f)
