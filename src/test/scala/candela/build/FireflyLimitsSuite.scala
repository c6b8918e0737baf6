package candela.build

import candela.film.Fireflies
import candela.scenefile.Dialect
import candela.settings.RenderSettings
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class FireflyLimitsSuite extends AnyFunSuite:
  private def scene(integrator: String): String =
    s"""Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |Integrator "$integrator"
       |WorldBegin
       |LightSource "infinite"
       |Shape "sphere"
       |""".stripMargin

  private def problems(integrator: String, fireflies: Fireflies) =
    messages(integrator, RenderSettings(fireflies = fireflies))

  private def messages(integrator: String, options: RenderSettings) =
    SceneTexts.problems(scene(integrator), Dialect.V4, options = options).map(_.message)

  private def plan(options: RenderSettings) = SceneTexts.plan(scene("path"), Dialect.V4, options)

  private val clamped = Fireflies.Clamped(2)

  test("paths allow all, without a warning"):
    for integrator <- Vector("path", "volpath"); fireflies <- Vector(Fireflies.Reweighted, clamped)
    do assert(problems(integrator, fireflies).isEmpty)

  test("what has no samples of its own refuses"):
    val chains = "Markov chains visit light by its brightness: no sample is too bright"
    assert(problems("mlt", Fireflies.Reweighted) == Vector(s"--fireflies reweight: $chains"))
    assert(problems("mlt", clamped) == Vector(s"--fireflies clamp: $chains"))
    assert(problems("sppm", Fireflies.Reweighted) == Vector(
      "--fireflies reweight: a photon brightens many samples alike, none of which is an outlier"
    ))
    for integrator <- Vector("bdpt", "ambientocclusion", "sppm") do
      assert(problems(integrator, clamped) == Vector(
        "--fireflies clamp: this integrator does not separate indirect light; \"path\" and " +
          "\"volpath\" do"
      ))

  test("splats of light paths stay, with a warning"):
    assert(problems("bdpt", Fireflies.Reweighted) == Vector(
      "--fireflies reweight leaves light paths that reach the camera as they are"
    ))

  test("nothing is said, nor done, unless asked; previews have no fireflies"):
    for integrator <- Vector("path", "mlt", "sppm", "bdpt") do
      assert(problems(integrator, Fireflies.Kept).isEmpty)
    val preview = RenderSettings(fireflies = clamped, preview = true)
    assert(messages("mlt", preview).isEmpty)
    assert(plan(preview).fireflies == Fireflies.Kept)
    assert(!plan(RenderSettings()).features.exists(_._1 == "fireflies"))

  test("--explain says what is done"):
    val limited = plan(RenderSettings(fireflies = clamped))
    assert(limited.features.contains(
      "fireflies" -> "indirect light of samples is limited to 2.0; the image is biased"
    ))
    assert(limited.indirectLimit.exists(_.maximum == 2f))
    val reweighted = plan(RenderSettings(fireflies = Fireflies.Reweighted))
    assert(reweighted.features.exists((what, how) =>
      what == "fireflies" && how.contains("48 bytes")
    ))
    assert(reweighted.indirectLimit.isEmpty)
