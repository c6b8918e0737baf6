package candela.integrators

import candela.diagnostics.Severity
import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** Openings that can be written down. */
final class AmbientOcclusionSuite extends AnyFunSuite:

  private def scene(dialect: Dialect, parameters: String, world: String, spp: Int = 64): String =
    val name = if dialect == Dialect.V2 then "SurfaceIntegrator" else "Integrator"
    val film = if dialect == Dialect.V4 then "rgb" else "image"
    val sampler = if dialect == Dialect.V4 then "independent" else "random"
    s"""LookAt 3 0 3  0 0 0  0 1 0
       |Camera "orthographic" "float screenwindow" [-1e-3 1e-3 -1e-3 1e-3]
       |Film "$film" "integer xresolution" 4 "integer yresolution" 4
       |Sampler "$sampler" "integer pixelsamples" $spp
       |$name "ambientocclusion" $parameters
       |WorldBegin
       |$world
       |Shape "disk" "float radius" 1000
       |""".stripMargin

  private def value(dialect: Dialect, parameters: String, world: String): Float =
    val found = SceneTexts.mean(scene(dialect, parameters, world), dialect)
    assert(Math.abs(found.r - found.g) < 1e-5f && Math.abs(found.r - found.b) < 1e-5f)
    found.r

  private val methods = Seq(
    (Dialect.V2, "\"integer nsamples\" 16", 1f),
    (Dialect.V3, "\"integer nsamples\" 16", Pi),
    (Dialect.V3, "\"integer nsamples\" 16 \"bool cossample\" \"false\"", Pi),
    (Dialect.V4, "", 1f),
    (Dialect.V4, "\"bool cossample\" false", 1f)
  )

  // 1024 points; 16 rays from each but in v4, where one ray is off by 0.58 of the mean if its
  // cosine counts: 1.8 %
  private val tolerance = 0.06f

  for (dialect, parameters, open) <- methods do
    test(s"an open plane is $open in $dialect with $parameters"):
      assert(Math.abs(value(dialect, parameters, "") / open - 1f) < tolerance)

    test(s"a disk of radius r at height h hides its part in $dialect with $parameters"):
      // Of the solid angle 1 − h / √(r² + h²) where all rays count the same, of cosines
      // r² / (r² + h²)
      val hidden = if dialect == Dialect.V2 then 1f - 1f / sqrt(1.49f) else 0.49f / 1.49f
      val found =
        value(dialect, parameters, "Shape \"disk\" \"float height\" 1 \"float radius\" .7")
      assert(Math.abs(found / (open * (1f - hidden)) - 1f) < tolerance)

  for (dialect, name) <- Seq((Dialect.V2, "maxdist"), (Dialect.V4, "maxdistance")) do
    test(s"what is farther than `$name` hides nothing in $dialect"):
      val world = "Shape \"disk\" \"float height\" 4 \"float radius\" 1000"
      assert(Math.abs(value(dialect, s"\"float $name\" 3.9", world) - 1f) < tolerance)
      assert(value(dialect, s"\"float $name\" 100", world) < 0.2f)

  test("v2 shows the sky behind all, the others do not"):
    for (dialect, seen) <- Seq(Dialect.V2 -> 0.5f, Dialect.V3 -> 0f, Dialect.V4 -> 0f) do
      val text = scene(dialect, "", "LightSource \"infinite\" \"rgb L\" [.5 .5 .5]")
        .replace("Shape \"disk\" \"float radius\" 1000", "")
      assert(Math.abs(SceneTexts.mean(text, dialect).r - seen) < 1e-5f)

  test("a scene without lights is no mistake"):
    val text = scene(Dialect.V3, "", "") + "WorldEnd\n"
    assert(!SceneTexts.problems(text).exists(_.severity == Severity.Warning))
