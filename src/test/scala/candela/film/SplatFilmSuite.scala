package candela.film

import org.scalatest.funsuite.AnyFunSuite

import candela.color.{ColorBasis, Rgb}
import candela.testing.Draws

final class SplatFilmSuite extends AnyFunSuite:
  private val box = BoxFilter(0.5f, 0.5f)

  private def film(filter: Filter = box, limit: Option[SampleLimit] = None): SplatFilm =
    SplatFilm(0, 0, 4, 3, filter, 12.0, ColorBasis.Srgb, limit)

  private def values(film: SplatFilm): Vector[Float] =
    val data = new Array[Float](36)
    film.addTo(data, 1f)
    data.toVector

  private def splats(count: Int): Vector[(Float, Float, Rgb)] =
    val draws = Draws(4)
    Vector.fill(count):
      val light = draws.magnitude(1e-12, 1e6)
      (draws.between(-1, 5), draws.between(-1, 4), Rgb(light, light * 0.3f, 0f))

  test("a splat lands in its pixel, over the number of paths and times that of pixels"):
    val f = film()
    f.begin()
    f.begin()
    f.add(2.25f, 1.75f, Rgb(1, 2, 3))
    val found = values(f)
    assert(found.slice(18, 21) == Vector(6f, 12f, 18f))
    assert(found.count(_ != 0f) == 3)

  test("the order of splats leaves no trace"):
    val all = splats(2000)
    val filter = GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f)
    val (a, b) = (film(filter), film(filter))
    a.begin()
    b.begin()
    all.foreach((x, y, c) => a.add(x, y, c))
    all.reverse.foreach((x, y, c) => b.add(x, y, c))
    assert(values(a) == values(b))

  test("small and large splats keep their digits"):
    val f = film()
    f.begin()
    f.add(0.5f, 0.5f, Rgb(1e-9f, 1e7f, 3e-14f))
    for _ <- 1 to 1000 do f.add(0.5f, 0.5f, Rgb(1e-9f, 1e-3f, 3e-14f))
    val found = values(f)
    assert(Math.abs(found(0) / (12 * 1.001e-6) - 1) < 1e-5)
    assert(found(1) == 12 * 1.0000001e7f)
    assert(Math.abs(found(2) / (12 * 1001 * 3e-14) - 1) < 2e-3)

  test("wide filters share a splat out, and nothing of it is lost or gained"):
    for
      filter <- Seq(
        TriangleFilter(1.5f, 1f),
        GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
        MitchellFilter(2f, 2f, 1f / 3, 1f / 3)
      )
    do
      val f = SplatFilm(0, 0, 16, 16, filter, 1.0, ColorBasis.Srgb, None)
      val draws = Draws(6)
      for _ <- 1 to 4000 do
        f.begin()
        f.add(draws.between(5, 10), draws.between(5, 10), Rgb.White)
      val data = new Array[Float](3 * 256)
      f.addTo(data, 1f)
      // Of filters that sum to 1 only on average over where the splats lie
      assert(Math.abs(data.map(_.toDouble).sum / 3 - 1) < 2e-3)

  test("splats that are no light are left out, bright ones scaled to the limit"):
    val f = film(limit = SampleLimit.luminance(1f))
    f.begin()
    f.add(0.5f, 0.5f, Rgb(Float.NaN, 0f, 0f))
    f.add(0.5f, 0.5f, Rgb(Float.PositiveInfinity, 0f, 0f))
    assert(values(f).forall(_ == 0f))
    f.add(0.5f, 0.5f, Rgb(100f, 100f, 100f))
    assert(Math.abs(values(f)(0) / 12f - 1f) < 1e-3f)

  test("what was added since a copy can be told"):
    val f = film()
    f.begin()
    f.add(1.5f, 0.5f, Rgb(1, 2, 3))
    val before = f.copy()
    f.begin()
    f.add(1.5f, 0.5f, Rgb(5, 5, 5))
    assert(values(f.since(before)).slice(3, 6) == Vector(60f, 60f, 60f))
    assert(values(before).slice(3, 6) == Vector(12f, 24f, 36f))
