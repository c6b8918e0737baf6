package candela.film

import candela.io.CheckedFile
import candela.image.Image

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class FireflyWeightsSuite extends AnyFunSuite:
  private val side = 12
  private val tiles = Vector(PixelBounds(5, 3, 12, 15), PixelBounds(12, 3, 17, 15))

  private def emptyFilm(): Film =
    Film(PixelBounds(5, 3, 17, 15), levels = Some(BrightnessLevels(tiles)))

  /** A film with `samples` of each pixel. */
  private def film(samples: Int)(light: (Int, Int, Int) => Float): Film =
    fill(emptyFilm(), 0 until samples)(light)

  private def fill(film: Film, samples: Range)(light: (Int, Int, Int) => Float): Film =
    val pass = film.levels.get.pass()
    for (tile, i) <- tiles.zipWithIndex; sample <- samples do
      pass.selectTile(i)
      for y <- tile.y0 until tile.y1; x <- tile.x0 until tile.x1 do
        val value = light(x, y, sample)
        film.add(x, y, value, value / 2, value / 4, 1f)
        pass.sample(value, value / 2, value / 4)
        pass.add((y - tile.y0) * tile.width + x - tile.x0, 1.0)
    film

  private def red(image: Image, x: Int, y: Int): Float = image.data(3 * ((y - 3) * side + x - 5))

  /** Values from 0.5 to 1.5, the same for the same arguments. */
  private def noise(x: Int, y: Int, sample: Int): Float =
    0.5f + scala.util.Random(x * 7919 + y * 104729 + sample * 31L).nextFloat()

  private def isOne(x: Int, y: Int, sample: Int): Boolean = x == 11 && y == 8 && sample == 5

  test("without outliers an image is kept, bit for bit"):
    for n <- Vector(4, 64) do
      val f = film(n)(noise)
      assert(f.toImage(2f).data.sameElements(f.toImage(2f, isWhole = true).data))
      assert(f.leftOut == 0)

  test("a lone firefly is left out; its pixel keeps the other samples, in their colour"):
    for brightness <- Vector(1e3f, 3e5f, 1e9f) do
      val f = film(16): (x, y, sample) =>
        if isOne(x, y, sample) then brightness else noise(x, y, sample)
      val clean = film(16): (x, y, sample) =>
        if isOne(x, y, sample) then 0f else noise(x, y, sample)
      val (found, wanted) = (f.toImage(1f), clean.toImage(1f))
      val own = 3 * ((8 - 3) * side + 11 - 5)
      for i <- found.data.indices do
        val change = Math.abs(found.data(i) - wanted.data(i))
        // What is left changes the pixel by no more than a tenth of those around, for two levels
        if i / 3 == own / 3 then assert(change < 0.3) else assert(change == 0)
      assert(red(f.toImage(1f, isWhole = true), 11, 8) > brightness / 17)
      assert(f.leftOut > 0.2)

  test("what is bright for all samples is kept: an emitter of one pixel, an edge"):
    val emitter = film(16)((x, y, s) => if x == 9 && y == 9 then 5000 * noise(x, y, s) else 0.1f)
    val edge = film(16)((x, _, s) => if x > 9 || (x == 9 && s == 3) then 5000f else 0.1f)
    for f <- Vector(emitter, edge) do
      assert(f.toImage(1f).data.sameElements(f.toImage(1f, isWhole = true).data))

  test("light found by few samples comes back with more of them"):
    def share(samples: Int): Double = film(samples): (x, y, s) =>
      if scala.util.Random(x * 7919 + y * 104729L + s * 31).nextInt(64) == 0 then 200f else 0.1f
    .leftOut
    assert(share(4) > 0.2)
    assert(share(64) < 0.05)
    assert(share(512) == 0)

  test("a firefly that is splatted is left out of all pixels under the filter"):
    for filter <- Vector(GaussianFilter.ofSigma(2f, 2f, 0.8f), MitchellFilter(2f, 2f, 0.3f, 0.3f))
    do
      val shares = SampleShares(PixelBounds(5, 3, 17, 15), FilterReach(filter), tiles)
      val levels = BrightnessLevels(shares.reached)
      val film =
        Film(
          PixelBounds(5, 3, 17, 15),
          shares = Some(shares),
          levels = Some(levels),
          volume = filter.integral
        )
      val level = levels.pass()
      val pass = shares.pass(Some(level))
      for (tile, i) <- tiles.zipWithIndex; sample <- 0 until 32 do
        pass.selectTile(i)
        level.selectTile(i)
        for y <- tile.y0 until tile.y1; x <- tile.x0 until tile.x1 do
          // Next to the border of the tiles
          val value = if isOne(x, y, sample) then 1e4f else 1f
          level.sample(value, value, value)
          pass.add(x + 0.3f, y + 0.6f, value, value, value)
        pass.end()
      assert(film.toImage(1f, isWhole = true).data.max > 20, filter)
      for v <- film.toImage(1f).data do assert(Math.abs(v - 1) < 0.25, s"$filter: $v")

  test("films add up, whatever the order, and the image is the same, bit for bit"):
    def light(x: Int, y: Int, s: Int) =
      if scala.util.Random(x * 17 + y * 1009L + s * 31).nextInt(90) == 0 then 1e3f
      else noise(x, y, s)
    val whole = film(16)(light)
    val parts = Vector(9 until 16, 0 until 2, 2 until 9).map(fill(emptyFilm(), _)(light))
    val file = Files.createTempFile("candela-levels", ".film")
    try
      val sum = emptyFilm()
      for part <- parts do
        CheckedFile.write(file, "levels")(part.save)
        CheckedFile.read(file, "levels")(sum.load)
      assert(sum.toImage(1f).data.sameElements(whole.toImage(1f).data))
      assert(sum.leftOut > 0)
    finally Files.delete(file)

  test("black, faint and huge light leaves finite values"):
    val values = Vector(0f, Float.MinPositiveValue, 1e-30f, 1e-7f, 1f, 1e11f, 1e30f, 3e38f)
    val f = film(8)((x, y, s) => values((x * 5 + y * 3 + s * s) % values.size))
    assert(f.toImage(1f).data.forall(v => v >= -1e33f && v < Float.PositiveInfinity))
    assert(film(3)((_, _, _) => 0f).toImage(1f).data.forall(_ == 0f))
    assert(emptyFilm().toImage(1f).data.forall(_ == 0f))
    assert(emptyFilm().leftOut == 0)

  test("negative light is left as it is"):
    val f = film(8)((x, _, s) => if x == 7 && s == 2 then -3f else 1f)
    assert(f.toImage(1f).data.sameElements(f.toImage(1f, isWhole = true).data))

  test("levels take memory only where they have samples"):
    val dim = film(4)((_, _, _) => 1f)
    val bytes = 24L * side * side
    assert(dim.levels.get.memory == bytes)
    // An emitter in the smaller tile, between two levels
    val lit = film(4)((x, _, _) => if x == 15 then 100f else 1f)
    assert(lit.levels.get.memory == bytes + 2 * 24L * 5 * side)
