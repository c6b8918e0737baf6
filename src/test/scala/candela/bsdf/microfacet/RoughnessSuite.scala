package candela.bsdf.microfacet

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Directions
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, FloatTexture}

class RoughnessSuite extends AnyFunSuite:
  private object FromU extends FloatTexture:
    def apply(at: ShadingPoint): Float = at.u

  test("PBRT 3's polynomial is the published fit, flat below a thousandth"):
    for r <- Seq(0.001, 0.01, 0.1, 0.5, 1.0) do
      val x = Math.log(r)
      val expected = 1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x +
        0.000640711 * x * x * x * x
      // Terms near 10 cancel to a twentieth at the low end.
      assert(Math.abs(Roughness.polynomialAlpha(r.toFloat) - expected) < 5e-6)
    assert(Roughness.polynomialAlpha(0f) == Roughness.polynomialAlpha(0.001f))

  test("each model reads the number in its own way"):
    import RoughnessModel.*
    def alpha(model: RoughnessModel) = model.trowbridgeReitz(0.25f, 0.01f).alphaX
    assert(alpha(SquareRootAlpha) == 0.5f)
    assert(alpha(PlainAlpha) == 0.25f && alpha(BoundedAlpha) == 0.25f)
    assert(alpha(PolynomialAlpha) == Roughness.polynomialAlpha(0.25f))
    assert(BoundedAlpha.trowbridgeReitz(0f, 0f).alphaX == 0.001f)
    assert(PlainAlpha.trowbridgeReitz(0f, 0f).isSmooth)
    assert(!BoundedAlpha.trowbridgeReitz(0f, 0f).isSmooth)
    val m = Directions.at(20, 45)
    assert(BlinnExponent.distribution(0.25f, 0.01f).d(m) == CosinePower(4f).d(m))
    val both = AnisotropicExponents.distribution(0.25f, 0.125f).d(m)
    assert(both == new CosinePower(4f, 8f).d(m))
    assert(BlinnExponent.distribution(0f, 0f).d(m) == CosinePower(10000f).d(m))

  test("it follows its textures, and is made once if they are constant"):
    val constant = ConstantFloat(0.25f)
    val fixed = Roughness(constant, constant, RoughnessModel.PlainAlpha)
    val here = ShadingPoint()
    assert(fixed.isConstant && (fixed(here) eq fixed(here)))
    val varying = Roughness(FromU, constant, RoughnessModel.PlainAlpha)
    here.u = 0.5f
    assert(!varying.isConstant)
    assert(varying(here).d(Vec3.Z) == TrowbridgeReitz(0.5f, 0.25f).d(Vec3.Z))
    here.u = 0.125f
    assert(varying(here).d(Vec3.Z) == TrowbridgeReitz(0.125f, 0.25f).d(Vec3.Z))

  test("glass of PBRT 3 is smooth at roughness 0, and rough above"):
    def glass(r: Float) =
      val texture = ConstantFloat(r)
      Roughness(texture, texture, RoughnessModel.PolynomialAlpha, smoothAtZero = true)
    assert(glass(0f)(ShadingPoint()).isSmooth && !glass(0.0001f)(ShadingPoint()).isSmooth)
