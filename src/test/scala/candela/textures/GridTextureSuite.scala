package candela.textures

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.ShadingPoint
import candela.math.*

class GridTextureSuite extends AnyFunSuite:
  private val mapping = Mapping3D(Transform.translate(-1f, 0f, 0f))
  private def grid(values: Float*) =
    TrilinearGrid(values.length, 1, 1, values.toArray, GridEdge.Clamped)

  private def at(x: Float): ShadingPoint =
    val point = ShadingPoint()
    point.p = Vec3(x, 0.5f, 0.5f)
    point

  test("numbers are interpolated between the centres of cells, constant beyond"):
    val texture = FloatGridTexture(GridPlace.InSpace(mapping), grid(1f, 3f))
    for (x, value) <- Seq(1.25f -> 1f, 1.5f -> 2f, 1.625f -> 2.5f, 9f -> 3f, -9f -> 1f) do
      assert(Math.abs(texture(at(x)) - value) < 1e-6f, x)

  test("colours have a grid each"):
    val texture =
      RgbGridTexture(GridPlace.InSpace(mapping), grid(0f, 1f), grid(1f, 0f), grid(0.5f, 0.5f))
    val found = texture(at(1.375f))
    assert(Seq(found.r - 0.25f, found.g - 0.75f, found.b - 0.5f).forall(Math.abs(_) < 1e-6f))
