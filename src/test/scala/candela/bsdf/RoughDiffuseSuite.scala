package candela.bsdf

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb}

class RoughDiffuseSuite extends BsdfLaws:
  obeysLaws("usual", RoughDiffuse(Rgb(0.3f, 0.6f, 0.9f), 0.14f))
  // The fit of the paper diverges where both directions are grazing
  obeysLaws("rough", RoughDiffuse(Rgb(0.3f, 0.6f, 0.9f), 0.7f), isPassive = false)

  test("the value is that of Oren and Nayar's equations 30 to 36"):
    val (albedo, sigma) = (0.8, 0.35)
    val (thetaO, thetaI, phi) = (Math.toRadians(35), Math.toRadians(65), Math.toRadians(130))
    val (a, b, s2) = (thetaI, thetaO, sigma * sigma)
    val c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    val c2 = 0.45 * s2 / (s2 + 0.09) * (Math.sin(a) - Math.pow(2 * b / Math.PI, 3))
    val c3 = 0.125 * s2 / (s2 + 0.09) * Math.pow(4 * a * b / (Math.PI * Math.PI), 2)
    val once = c1 + Math.cos(phi) * c2 * Math.tan(b) +
      (1 - Math.abs(Math.cos(phi))) * c3 * Math.tan((a + b) / 2)
    val again = 0.17 * s2 / (s2 + 0.13) * (1 - Math.cos(phi) * Math.pow(2 * b / Math.PI, 2))
    val expected = (albedo * once + albedo * albedo * again) / Math.PI
    val found = RoughDiffuse(Rgb.gray(albedo.toFloat), sigma.toFloat)
      .f(Directions.at(35, 0), Directions.at(65, 130)).g
    assert(Math.abs(found / expected - 1) < 1e-5)

  test("alpha is √2 times the standard deviation, in either form"):
    def material(isFast: Boolean) =
      RoughDiffuseMaterial(ConstantRgb(Rgb.gray(0.5f)), ConstantFloat(0.5f), isFast)
        .bsdf(ShadingPoint())
    val (wo, wi) = (Directions.at(50, 0), Directions.at(70, 20))
    val sigma = 0.5f / sqrt(2f)
    val full = RoughDiffuse(Rgb.gray(0.5f), sigma).f(wo, wi).g
    val fast = OrenNayar(Rgb.gray(0.5f), Math.toDegrees(sigma).toFloat).f(wo, wi).g
    assert(material(isFast = false).f(wo, wi).g == full && material(isFast =
      true
    ).f(wo, wi).g == fast)
    assert(full != fast)
