package candela.film

import candela.io.{CheckedFile, CheckedOutput}
import org.scalatest.funsuite.AnyFunSuite

import candela.color.{ColorBasis, Rgb}
import candela.testing.Draws

import java.nio.file.{Files, Path}

final class SplatFilmSuite extends AnyFunSuite:
  private val box = BoxFilter(0.5f, 0.5f)

  private def film(filter: Filter = box, limits: Vector[SampleLimit] = Vector.empty): SplatFilm =
    SplatFilm(PixelBounds(0, 0, 4, 3), filter, 12.0, ColorBasis.Srgb, limits)

  private def values(film: SplatFilm): Vector[Float] =
    val data = new Array[Float](36)
    film.addTo(data, 1f)
    data.toVector

  /** The film's file. */
  private def saved[A](film: SplatFilm)(use: Path => A): A =
    val file = Files.createTempFile("splats", ".bin")
    try
      CheckedFile.write(file, "splats")((out: CheckedOutput) => film.save(out))
      use(file)
    finally Files.delete(file)

  private def bytes(film: SplatFilm): Vector[Byte] = saved(film)(Files.readAllBytes(_).toVector)

  private def splats(count: Int): Vector[(Float, Float, Rgb)] =
    val draws = Draws(4)
    Vector.fill(count):
      val light = draws.magnitude(1e-12, 1e6)
      (draws.between(-1, 5), draws.between(-1, 4), Rgb(light, light * 0.3f, 0f))

  test("a splat lands in its pixel, over the number of samples and times that of pixels"):
    val f = film()
    f.countSample()
    f.countSample()
    f.add(2.25f, 1.75f, Rgb(1, 2, 3), 0)
    val found = values(f)
    assert(found.slice(18, 21) == Vector(6f, 12f, 18f))
    assert(found.count(_ != 0f) == 3)

  test("the order of splats leaves no trace"):
    val all = splats(2000)
    val filter = GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f)
    val (a, b) = (film(filter), film(filter))
    a.countSample()
    b.countSample()
    all.foreach((x, y, c) => a.add(x, y, c, 0))
    all.reverse.foreach((x, y, c) => b.add(x, y, c, 0))
    assert(values(a) == values(b))
    assert(bytes(a) == bytes(b))

  test("many bright splats are added without any rounding"):
    val f = film()
    f.countSample()
    for _ <- 1 to 5000 do f.add(0.5f, 0.5f, Rgb(100.25f, 127.5f, 129f), 0)
    val read = film()
    saved(f)(CheckedFile.read(_, "splats")(read.load))
    for sums <- Seq(f, read, f.copy(), f.deltaSince(film())) do
      assert(values(sums).take(3) == Vector(6015000f, 7650000f, 7740000f))

  test("splats of several threads at once, across bands of rows, are those of one"):
    val filter = GaussianFilter.ofSigma(2.5f, 2.5f, 0.8f)
    def high = SplatFilm(PixelBounds(0, 0, 8, 40), filter, 320.0, ColorBasis.Srgb, Vector.empty)
    val draws = Draws(9)
    val all = Vector.fill(20000)((draws.between(-1, 9), draws.between(-2, 42)))
    def add(film: SplatFilm, from: Int) =
      for i <- from until all.size by 4 do
        film.countSample()
        film.add(all(i)._1, all(i)._2, Rgb(0.1f * (i % 7), 300f, 1e-8f * i), 0)
    val (together, alone) = (high, high)
    val threads = (0 until 4).map(k => Thread(() => add(together, k)))
    threads.foreach(_.start())
    threads.foreach(_.join())
    (0 until 4).foreach(add(alone, _))
    assert(together.sampleCount == 20000)
    assert(bytes(together) == bytes(alone))

  test("small and large splats keep their digits"):
    val f = film()
    f.countSample()
    f.add(0.5f, 0.5f, Rgb(1e-9f, 1e7f, 3e-14f), 0)
    for _ <- 1 to 1000 do f.add(0.5f, 0.5f, Rgb(1e-9f, 1e-3f, 3e-14f), 0)
    val found = values(f)
    assert(Math.abs(found(0) / (12 * 1.001e-6) - 1) < 1e-5)
    assert(found(1) == 12 * 1.0000001e7f)
    // 3e-14 is 540 units of 2⁻⁵⁴, so rounded by up to 0.1 %
    assert(Math.abs(found(2) / (12 * 1001 * 3e-14) - 1) < 2e-3)

  test("wide filters share a splat out, and nothing of it is lost or gained"):
    for
      filter <- Seq(
        TriangleFilter(1.5f, 1f),
        GaussianFilter.ofSigma(1.5f, 1.5f, 0.5f),
        MitchellFilter(2f, 2f, 1f / 3, 1f / 3)
      )
    do
      val f = SplatFilm(PixelBounds(0, 0, 16, 16), filter, 1.0, ColorBasis.Srgb, Vector.empty)
      val draws = Draws(6)
      for _ <- 1 to 4000 do
        f.countSample()
        f.add(draws.between(5, 10), draws.between(5, 10), Rgb.White, 0)
      val data = new Array[Float](3 * 256)
      f.addTo(data, 1f)
      // Of filters that sum to 1 only on average over where the splats lie
      assert(Math.abs(data.map(_.toDouble).sum / 3 - 1) < 2e-3)

  test("splats that are no light are left out, bright ones scaled to the limit"):
    val f = film(limits = SampleLimit.luminance(1f).toVector)
    f.countSample()
    f.add(0.5f, 0.5f, Rgb(Float.NaN, 0f, 0f), 0)
    f.add(0.5f, 0.5f, Rgb(Float.PositiveInfinity, 0f, 0f), 0)
    assert(values(f).forall(_ == 0f))
    f.add(0.5f, 0.5f, Rgb(100f, 100f, 100f), 0)
    assert(Math.abs(values(f)(0) / 12f - 1f) < 1e-5f)

  test("what was added since a copy can be told"):
    val f = film()
    f.countSample()
    f.add(1.5f, 0.5f, Rgb(1, 2, 3), 0)
    val before = f.copy()
    f.countSample()
    f.add(1.5f, 0.5f, Rgb(5, 5, 5), 0)
    assert(values(f.deltaSince(before)).slice(3, 6) == Vector(60f, 60f, 60f))
    assert(values(before).slice(3, 6) == Vector(12f, 24f, 36f))

  test("the light of strategies is beside the image, and saved with it"):
    def empty =
      SplatFilm(PixelBounds(0, 0, 4, 3), box, 12.0, ColorBasis.Srgb, Vector.empty, strategies = 2)
    val f = empty
    f.countSample()
    f.add(0.5f, 0.5f, Rgb(1, 2, 3), 0)
    f.addStrategy(1.5f, 0.5f, Rgb(5, 5, 5), 1)
    assert(values(f).sum == 12 * 6)
    val read = empty
    saved(f)(CheckedFile.read(_, "splats")(read.load))
    for film <- Seq(f, f.copy(), read); k <- 0 to 1 do
      val data = new Array[Float](36)
      film.addStrategyTo(data, 1f, k)
      assert(data.sum == (if k == 1 then 12 * 15f else 0f))

  test("groups of lights add up to all splats, and each has its own"):
    def filled(groups: Int) =
      val f = SplatFilm(PixelBounds(0, 0, 4, 3), box, 12.0, ColorBasis.Srgb, Vector.empty, groups)
      f.countSample()
      for k <- 0 to 2 do f.add(k + 0.5f, 0.5f, Rgb(1, 2, 3) * (k + 1f), group = k)
      f
    val (one, three) = (filled(1), filled(3))
    assert(values(three) == values(one))
    for k <- 0 to 2 do
      val data = new Array[Float](36)
      three.addTo(data, 1f, k)
      assert(data.indices.filter(data(_) != 0f) == (3 * k until 3 * k + 3))
      assert(data.sum == 12 * 6 * (k + 1f))
    val read = SplatFilm(PixelBounds(0, 0, 4, 3), box, 12.0, ColorBasis.Srgb, Vector.empty, 3)
    saved(three)(CheckedFile.read(_, "splats")(read.load))
    assert(bytes(read) == bytes(three))
