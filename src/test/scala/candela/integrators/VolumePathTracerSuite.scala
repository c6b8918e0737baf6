package candela.integrators

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.render.Renderer
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

final class VolumePathTracerSuite extends AnyFunSuite:

  private def head(integrator: String, film: String, spp: Int): String =
    s"""LookAt 0 0 3  0 0 0  0 1 0
       |Camera "perspective" "float fov" 20
       |Film "$film" "integer xresolution" 8 "integer yresolution" 8
       |Sampler "halton" "integer pixelsamples" $spp
       |Integrator $integrator
       |WorldBegin
       |LightSource "infinite" "rgb L" [1 1 1]
       |""".stripMargin

  /** A ball of a medium that fills the view, in surroundings of radiance 1. */
  private def furnace(dialect: Dialect, medium: String, spp: Int = 64, depth: Int = 200): String =
    val isV4 = dialect == Dialect.V4
    s"""${head(s""""volpath" "integer maxdepth" $depth""", if isV4 then "rgb" else "image", spp)}
       |MakeNamedMedium "m" $medium
       |MediumInterface "m" ""
       |Material "${if isV4 then "interface" else "none"}"
       |Shape "sphere"
       |${if isV4 then "" else "WorldEnd"}
       |""".stripMargin

  private val grid = """"integer nx" 2 "integer ny" 2 "integer nz" 2
    "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1] "float density" [.2 1 .5 2 0 1 3 .3]"""

  private def isGrey(seen: Rgb, value: Float, tolerance: Float): Assertion =
    assert(Seq(seen.r, seen.g, seen.b).forall(c => Math.abs(c - value) < tolerance), seen)

  test("a grey medium that only scatters can't be seen in a white furnace: exactly, in v4"):
    // The sky is met by chance alone, and nothing on the way has a weight but 1
    for (kind, more) <- Seq("homogeneous" -> "", "uniformgrid" -> grid) do
      val medium = s""""string type" "$kind" "rgb sigma_s" [2 2 2] "rgb sigma_a" [0 0 0]
        "float g" .6 $more"""
      isGrey(SceneTexts.mean(furnace(Dialect.V4, medium, spp = 4), Dialect.V4), 1f, 1e-4f)

  test("nor can a coloured one, whose colours are decided by chance"):
    for (kind, more) <- Seq("homogeneous" -> "", "uniformgrid" -> grid) do
      val medium = s""""string type" "$kind" "rgb sigma_s" [.5 2 4] "rgb sigma_a" [0 0 0] $more"""
      // 4096 paths, each of which is 1 on average over the colours with a deviation below 1: 2 %
      isGrey(SceneTexts.mean(furnace(Dialect.V4, medium), Dialect.V4), 1f, 0.05f)

  test("nor where light is sampled, through the medium's border, in v3"):
    for (kind, more) <- Seq("homogeneous" -> "", "heterogeneous" -> grid.replace("point3", "point"))
    do
      val medium = s""""string type" "$kind" "rgb sigma_s" [1 1 1] "rgb sigma_a" [0 0 0] $more"""
      // 4096 paths that deviate by less than 1, as above: below 1.6 %
      isGrey(SceneTexts.mean(furnace(Dialect.V3, medium)), 1f, 0.03f)

  test("what only absorbs shows the transmittance: exactly, if it is homogeneous"):
    val medium = """"string type" "homogeneous" "rgb sigma_s" [0 0 0] "rgb sigma_a" [.5 1 2]"""
    // A plain slab: chords of the middle of the sphere are 2 but for its curvature, 1 %
    val seen = SceneTexts.mean(
      furnace(Dialect.V3, medium, spp = 16).replace("\"float fov\" 20", "\"float fov\" 2")
    )
    val expected = Rgb(Math.exp(-1).toFloat, Math.exp(-2).toFloat, Math.exp(-4).toFloat)
    for (c, e) <- Seq(seen.r -> expected.r, seen.g -> expected.g, seen.b -> expected.b) do
      assert(Math.abs(c - e) < 0.02f * e, seen)

  test("a medium of no density looks like no medium"):
    val empty = grid.replace("[.2 1 .5 2 0 1 3 .3]", "[0 0 0 0 0 0 0 0]")
    val medium = s""""string type" "uniformgrid" $empty"""
    isGrey(SceneTexts.mean(furnace(Dialect.V4, medium, spp = 1), Dialect.V4), 1f, 1e-5f)

  test("one of immense density is finite, and no brighter than its surroundings"):
    for
      (kind, more) <- Seq("homogeneous" -> "", "uniformgrid" -> grid)
      scale <- Seq("1e4", "1e12", "1e30")
    do
      val medium = s""""string type" "$kind" "rgb sigma_s" [.5 2 1] "rgb sigma_a" [.1 0 1]
        "float scale" $scale $more"""
      val plan = SceneTexts.plan(furnace(Dialect.V4, medium, spp = 2, depth = 20), Dialect.V4)
      val rendering = Renderer.render(plan, threads = 1)
      assert(rendering.discarded.isEmpty, s"$kind $scale")
      val seen = SceneTexts.mean(furnace(Dialect.V4, medium, spp = 2, depth = 20), Dialect.V4)
      assert(seen.max < 1.5f, s"$kind $scale $seen")

  test("a plane is lit through a medium as far as that lets light through"):
    // A distant light from straight above through a slab of depth 0.7, seen through it again
    val text =
      s"""LookAt 0 0 9  0 0 0  0 1 0
         |Camera "orthographic" "float screenwindow" [-.01 .01 -.01 .01]
         |Film "image" "integer xresolution" 4 "integer yresolution" 4
         |Sampler "random" "integer pixelsamples" 1000
         |Integrator "volpath" "integer maxdepth" 1
         |WorldBegin
         |LightSource "distant" "point from" [0 0 1] "point to" [0 0 0] "rgb L" [1 1 1]
         |${LitPlane.matte()}
         |Shape "disk" "float radius" 1000
         |MakeNamedMedium "m" "string type" "homogeneous" "rgb sigma_s" [.1 .3 0]
         |  "rgb sigma_a" [.25 .05 .7]
         |AttributeBegin
         |Material "none"
         |MediumInterface "m" ""
         |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
         |  "point P" [-5 -5 3  5 -5 3  5 5 3  -5 5 3]
         |MediumInterface "" "m"
         |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
         |  "point P" [-5 -5 1  5 -5 1  5 5 1  -5 5 1]
         |AttributeEnd
         |WorldEnd
         |""".stripMargin
    val seen = SceneTexts.mean(text)
    // Of one scattering event the plane's share is albedo/π·T², and the medium's own light σs/4π
    // ∫ exp(−2σt·s) ds
    def expected(s: Double, t: Double) =
      LitPlane.Albedo / Math.PI * Math.exp(-4 * t) +
        s / (4 * Math.PI) * (1 - Math.exp(-4 * t)) / (2 * t)
    val wanted = Seq(expected(0.1, 0.35), expected(0.3, 0.35), expected(0, 0.7))
    for (c, e) <- Seq(seen.r, seen.g, seen.b).zip(wanted) do
      assert(Math.abs(c - e) < 0.03 * e, s"$seen, expected $e")

  /** The mean, by Mitsuba's rules or pbrt's. */
  private def seen(text: String, isMitsubas: Boolean): Float =
    val dialect = if isMitsubas then Dialect.Mitsuba else Dialect.V4
    val scene = SceneTexts.parse(text, Dialect.V4).copy(dialect = dialect)
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    val data = Renderer.render(plan, threads = 1).image(plan.development).data
    data.sum / data.length

  private def pane(z: Float): String =
    s"""AttributeBegin
       |Translate 0 0 $z
       |Material "thindielectric"
       |Shape "disk" "float radius" 9
       |AttributeEnd
       |""".stripMargin

  // Both faces reflect 4 %, and what they reflect between them adds up
  private val passed = 1f - 2 * 0.04f / 1.04f

  test("Mitsuba's paths cross panes without an event, in pbrt's each is one"):
    val panes = head("\"volpath\" \"integer maxdepth\" 0", "rgb", 64) +
      Seq(-1f, 0f, 1f).map(pane).mkString
    assert(seen(panes, isMitsubas = false) == 0f)
    // 4096 paths, each of which is 0 or 1
    assert(Math.abs(seen(panes, isMitsubas = true) - passed * passed * passed) < 0.03f)
    val one = panes.replace("maxdepth\" 0", "maxdepth\" 2")
    assert(seen(one, isMitsubas = false) < 0.1f)

  test("light samples pass Mitsuba's panes"):
    val floor = head("\"volpath\" \"integer maxdepth\" 1", "rgb", 4)
      .replace("\"infinite\"", "\"distant\" \"point3 from\" [9 0 1] \"point3 to\" [0 0 0]") +
      "Material \"diffuse\"\nShape \"disk\" \"float radius\" 9\n"
    val aside = "AttributeBegin\nTranslate 4 0 .4\nRotate 90 0 1 0\n" + pane(0f) +
      "AttributeEnd\n"
    val lit = seen(floor, isMitsubas = true)
    assert(lit > 0f && seen(floor + aside, isMitsubas = false) == 0f)
    // At 6.3° the pane reflects as much as straight on, to 1e-5
    assert(Math.abs(seen(floor + aside, isMitsubas = true) / lit - passed) < 1e-3f)
