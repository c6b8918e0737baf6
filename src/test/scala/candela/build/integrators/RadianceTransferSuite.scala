package candela.build.integrators

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.scenefile.Dialect
import candela.testing.SceneTexts

/** pbrt-v2's `diffuseprt` and `glossyprt`, by the surfaces that they see. */
class RadianceTransferSuite extends AnyFunSuite:

  private def mean(integrator: String, material: String): Rgb =
    SceneTexts.mean(
      s"""Film "image" "integer xresolution" 12 "integer yresolution" 12
         |Sampler "lowdiscrepancy" "integer pixelsamples" 64
         |SurfaceIntegrator $integrator
         |WorldBegin
         |LightSource "infinite" "color L" [1 1 1]
         |Material $material
         |Translate 0 0 4 Shape "disk" "float radius" 20""".stripMargin,
      Dialect.V2
    )

  private def same(a: Rgb, b: Rgb): Unit =
    assert(Math.abs(a.r - b.r) < 1e-6f && Math.abs(a.g - b.g) < 1e-6f && a.g > 0f, s"$a, $b"): Unit

  test("glossyprt sees one plastic, whatever the materials"):
    val given_ = "\"color Kd\" [.1 .2 .3] \"color Ks\" [.5 .5 .5] \"float roughness\" .2"
    same(
      mean(s"\"glossyprt\" $given_", "\"mirror\""),
      mean("\"directlighting\"", s"\"plastic\" $given_")
    )
    same(
      mean("\"glossyprt\"", "\"matte\""),
      mean("\"directlighting\"", "\"plastic\" \"color Kd\" [.5 .5 .5]")
    )

  test("diffuseprt sees what materials reflect, as diffuse light"):
    val white = mean("\"directlighting\"", "\"matte\" \"color Kd\" [1 1 1]")
    val mirror = mean("\"diffuseprt\"", "\"mirror\" \"color Kr\" [.5 .5 .5]")
    assert(Math.abs(mirror.g / white.g - 0.5f) < 0.01f)
    // Of glass, what it reflects at normal incidence alone
    val glass = mean("\"diffuseprt\"", "\"glass\"")
    assert(glass.g > 0.02f * white.g && glass.g < 0.15f * white.g, s"$glass")
