package candela.measure

import candela.base.loop
import candela.diagnostics.Code
import candela.image.{Image, ImageError}

import org.apache.commons.statistics.distribution.TDistribution

/** What a program makes of a scene, with what is needed to know its noise. */
enum Renderings:
  /** Images of independent seeds. */
  case Seeds(images: Vector[TileSums])

  /** One image, and the variance of each value.
    *
    * @param squares of the variances
    * @param freedom degrees of freedom of each variance
    * @param correlation sum of a pixel's correlations with all pixels, its own 1 included
    */
  case Known(
      image: TileSums,
      variance: TileSums,
      squares: TileSums,
      freedom: Double,
      correlation: Double
  )

  private[measure] def tileSums: Vector[TileSums] = this match
    case Seeds(images) => images
    case Known(image, variance, squares, _, _) => Vector(image, variance, squares)

  private[measure] def first: TileSums = tileSums.head

object Renderings:
  /** @throws ImageError if they are too few, of several sizes or channels, or the same */
  def seeds(images: Vector[TileSums]): Renderings =
    def fail(what: String) = throw ImageError(Code.DifferentImages, what)
    if images.sizeIs < 2 then fail("a set needs at least two images, found one")
    for image <- images.tail do BiasTest.alike(image, images.head)
    // Of one seed, or of a program that has none
    for Vector(i, j) <- images.indices.toVector.combinations(2) if images(i).isSame(images(j)) do
      fail(s"images ${i + 1} and ${j + 1} are identical; use different seeds")
    Seeds(images)

  /** @param variance of each value of the image
    * @param freedom degrees of freedom of each
    * @param correlation sum of a pixel's correlations with all pixels, its own 1 included
    */
  def withVariance(
      image: Image,
      variance: Image,
      freedom: Double,
      correlation: Double = 1
  ): Renderings =
    val squares = Image(
      variance.width,
      variance.height,
      variance.channelNames,
      variance.data.map(v => v * v)
    )
    Known(TileSums.of(image), TileSums.of(variance), TileSums.of(squares), freedom, correlation)

/** A region of the image, in one channel.
  *
  * @param a, b     mean of each program
  * @param error    standard error of a − b
  * @param p        chance that noise alone makes them differ at least so
  * @param adjusted the same for the most different of all regions that were tested
  */
final case class BiasRegion(
    window: PixelWindow,
    channel: String,
    a: Double,
    b: Double,
    error: Double,
    p: Double,
    adjusted: Double
)

/** Whether two programs render the same expected image, from few samples.
  *
  * The means of a square of pixels are compared by Welch's t-test, channel by channel, where the
  * images of independent seeds are the sample. Jung et al. test tiles of one size. Here squares of
  * 8, 16, 32, … pixels up to the whole image are tested, those above 8 in steps of half their size:
  * small ones show a wrong highlight, large ones a bias of a fraction of a percent. The chance of a
  * false alarm is divided among the sizes equally, and among the regions of a size (Bonferroni),
  * which holds however they are correlated. Where one program has fewer images, its variance is no
  * less than the other's: of skewed noise few images seem to have too little.
  *
  * Sources: Jung, Hanika, Dachsbacher, "Detecting Bias in Monte Carlo Renderers using Welch's
  * t-test", Journal of Computer Graphics Techniques 9(2), 2020; Welch, "The generalization of
  * Student's problem", Biometrika 34, 1947.
  *
  * @param worst regions by their adjusted p-value, the least first: the least one of each size
  * @param fullImage the whole image, by channel
  * @param tiles p-values of the smallest tiles, of all channels that have noise
  * @param map of each pixel and channel, the least adjusted p-value of the regions that have it,
  *   of the size at which the programs differ most clearly
  * @param skipped tiles with NaN or infinite values
  */
final class BiasTest private (
    val worst: Vector[BiasRegion],
    val fullImage: Vector[BiasRegion],
    val tiles: Array[Double],
    val map: Image,
    val skipped: Int
):
  /** −log₁₀ of the least p-value of each pixel's channels, for false colours. */
  def powers: Image =
    val n = map.channels
    val data = Array.tabulate(map.width * map.height): pixel =>
      val p = (0 until n).map(c => map.data(pixel * n + c)).min
      -Math.log10(Math.max(p, 1e-30f).toDouble).toFloat
    Image(map.width, map.height, Vector("Y"), data)

  /** Chance that noise alone makes two unbiased programs differ as much. */
  def p: Double = worst.headOption.fold(1.0)(_.adjusted)

  /** Share of the smallest tiles with a p-value below this, which is so by chance alone. */
  def shareBelow(level: Double): Double =
    if tiles.isEmpty then 0 else tiles.count(_ < level).toDouble / tiles.length

  /** Shares of the tiles' p-values in tenths of [0, 1]: a tenth each by chance. */
  def histogram: Vector[Double] = Vector.tabulate(10): i =>
    shareBelow((i + 1) / 10.0 + (if i == 9 then 1e-9 else 0)) - shareBelow(i / 10.0)

object BiasTest:
  /** Powers of ten down to the p-value of the last colour of a map. */
  val UsualPowers = 4.0

  /** Relative differences below are rounding: of floats, summed in any order, and of half floats.
    */
  private val FloatRounding = 1e-5
  private val HalfRounding = 1.0 / (1 << 12)

  /** @param allowance relative difference that is no bias
    * @throws ImageError if they have not the same size and channels
    */
  def of(a: Renderings, b: Renderings, allowance: Double = 0): BiasTest =
    alike(a.first, b.first)
    Pyramid(a, b, allowance).result

  private[measure] def alike(a: TileSums, b: TileSums): Unit =
    def fail(what: String) = throw ImageError(Code.DifferentImages, what)
    if a.width != b.width || a.height != b.height then
      fail(s"image sizes differ: ${a.width}×${a.height} and ${b.width}×${b.height} pixels")
    if a.channels != b.channels then
      fail(s"image channels differ: ${a.channels.mkString(", ")} and ${b.channels.mkString(", ")}")

  /** Squares of so many tiles along a side, at these places. */
  private final case class Level(size: Int, columns: Vector[Int], rows: Vector[Int])

  private final class Pyramid(a: Renderings, b: Renderings, allowance: Double):
    private val image = a.first
    private val (columns, rows) = (image.columns, image.rows)
    private val isSound = Array.tabulate(columns * rows): tile =>
      (a.tileSums ++ b.tileSums).forall(_.isFinite(tile))
    private val skipped = isSound.count(!_)
    private val rounding =
      if (a.tileSums.take(1) ++ b.tileSums.take(1)).exists(_.isHalf) then HalfRounding
      else FloatRounding
    private val pixels = PrefixSums(columns, rows, tile => if isSound(tile) then area(tile) else 0)

    private def area(tile: Int): Double =
      val (x, y) = (tile % columns * TileSums.Size, tile / columns * TileSums.Size)
      val across = Math.min(TileSums.Size, image.width - x)
      across.toDouble * Math.min(TileSums.Size, image.height - y)

    private val levels: Vector[Level] =
      val sizes = Iterator.iterate(1)(_ * 2).takeWhile(_ < Math.max(columns, rows) * 2).toVector
      sizes.map(size => Level(size, offsets(size, columns), offsets(size, rows)))

    /** Steps of half a size, up to the one that reaches the end. */
    private def offsets(size: Int, all: Int): Vector[Int] =
      val step = Math.max(1, size / 2)
      (0 until all by step).toVector.takeWhile(x => x == 0 || x + size - step < all)

    def result: BiasTest =
      val tested = levels.map(of)
      val corrected =
        for regions <- tested if regions.nonEmpty yield
          val trials = levels.size.toDouble * regions.size
          regions.map(r => r.copy(adjusted = Math.min(1, trials * r.p)))
      val tiles = tested.head.map(_.p).toArray
      val worst = corrected.map(_.minBy(_.p)).sortBy(r => (r.adjusted, r.p))
      val clearest = corrected.minByOption(all => all.map(r => (r.adjusted, r.p)).min)
      new BiasTest(worst, tested.last, tiles, map(clearest.getOrElse(Vector.empty)), skipped)

    /** All regions of a level that have noise, or differ. */
    private def of(level: Level): Vector[BiasRegion] =
      image.channels.indices.toVector.flatMap: c =>
        val (ofA, ofB) = (Estimates.of(a, c, isSound), Estimates.of(b, c, isSound))
        for
          y <- level.rows
          x <- level.columns
          region <- region(x, y, level.size, c, ofA, ofB)
        yield region

    private def region(
        x: Int,
        y: Int,
        size: Int,
        channel: Int,
        ofA: Estimates,
        ofB: Estimates
    ): Option[BiasRegion] =
      val (x1, y1) = (Math.min(columns, x + size), Math.min(rows, y + size))
      val n = pixels(x, x1, y, y1)
      Option.when(n > 0)(Estimate.pair(ofA(x, x1, y, y1, n), ofB(x, x1, y, y1, n))).flatMap:
        case (p, q) => compared(p, q, x, x1, y, y1, channel)

    private def compared(
        p: Estimate,
        q: Estimate,
        x: Int,
        x1: Int,
        y: Int,
        y1: Int,
        channel: Int
    ): Option[BiasRegion] =
      val scale = Math.max(Math.abs(p.mean), Math.abs(q.mean))
      val apart = Math.max(0, Math.abs(p.mean - q.mean) - allowance * scale)
      val isEqual = p.variance + q.variance == 0 && apart <= rounding * scale
      Option.unless(isEqual):
        val floor = Math.pow(rounding * scale, 2)
        val variance = p.variance + q.variance
        // Welch and Satterthwaite, of the noise alone: with rounding, a few images that happen to
        // agree would have a noise that is known well
        val welch =
          if variance == 0 then Double.PositiveInfinity
          else
            val share = p.variance / variance
            1 / (share * share / p.freedom + (1 - share) * (1 - share) / q.freedom)
        val freedom = Math.min(welch, Estimate.maxFreedom(p, q))
        val error = Math.sqrt(variance + floor)
        val chance = 2 * TDistribution.of(freedom).survivalProbability(apart / error)
        val window = PixelWindow(
          x * TileSums.Size,
          Math.min(image.width, x1 * TileSums.Size),
          y * TileSums.Size,
          Math.min(image.height, y1 * TileSums.Size)
        )
        BiasRegion(window, image.channels(channel), p.mean, q.mean, error, chance, chance)

    private def mark(least: Array[Float], r: BiasRegion): Unit =
      if r.adjusted < 1 then
        val c = image.channels.indexOf(r.channel)
        val w = r.window
        for
          y <- w.y0 / TileSums.Size to (w.y1 - 1) / TileSums.Size
          x <- w.x0 / TileSums.Size to (w.x1 - 1) / TileSums.Size
        do
          val index = (y * columns + x) * image.channels.size + c
          least(index) = Math.min(least(index), r.adjusted.toFloat)

    private def map(regions: Vector[BiasRegion]): Image =
      val count = image.channels.size
      val minima = Array.fill(columns * rows * count)(1f)
      regions.foreach(mark(minima, _))
      val data = new Array[Float](image.width * image.height * count)
      loop(image.height): y =>
        loop(image.width): x =>
          val tile = y / TileSums.Size * columns + x / TileSums.Size
          System.arraycopy(minima, tile * count, data, (y * image.width + x) * count, count)
      Image(image.width, image.height, image.channels, data)

  /** A mean, its variance, and the degrees of freedom of that.
    *
    * @param images of which it is the mean; 0: of one, whose pixels tell the variance
    */
  private final case class Estimate(mean: Double, variance: Double, freedom: Double, images: Int):
    /** A few images may all lack the rare bright paths that many show: their variance is then no
      * less than that of the many.
      */
    def beside(other: Estimate): Estimate =
      val minVariance = other.variance * other.images / Math.max(1, images)
      if images == 0 || images >= other.images || variance >= minVariance then this
      else copy(variance = minVariance, freedom = other.freedom)

  private object Estimate:
    def pair(a: Estimate, b: Estimate): (Estimate, Estimate) = (a.beside(b), b.beside(a))

    /** Beside a single image, whose variance is known well, a few images that happen to agree would
      * have the degrees of freedom of that one, and no noise: they keep their own.
      */
    def maxFreedom(a: Estimate, b: Estimate): Double =
      if a.images > 0 && b.images > 0 then Double.PositiveInfinity
      else Math.min(a.freedom, b.freedom)

  /** What one program finds in regions, in one channel. */
  private abstract class Estimates:
    /** @param pixels of the region */
    def apply(x0: Int, x1: Int, y0: Int, y1: Int, pixels: Double): Estimate

  private object Estimates:
    def of(renderings: Renderings, channel: Int, isSound: Array[Boolean]): Estimates =
      def prefix(t: TileSums) =
        PrefixSums(t.columns, t.rows, tile => if isSound(tile) then t(tile, channel) else 0)
      renderings match
        case Renderings.Seeds(images) => OfSeeds(images.map(prefix).toArray)
        case Renderings.Known(image, variance, squares, freedom, correlation) =>
          OfKnown(prefix(image), prefix(variance), prefix(squares), freedom, correlation)

    private final class OfSeeds(images: Array[PrefixSums]) extends Estimates:
      private val n = images.length

      def apply(x0: Int, x1: Int, y0: Int, y1: Int, pixels: Double): Estimate =
        val means = new Array[Double](n)
        var sum = 0.0
        loop(n): i =>
          means(i) = images(i)(x0, x1, y0, y1) / pixels
          sum += means(i)
        val mean = sum / n
        var squares = 0.0
        loop(n)(i => squares += (means(i) - mean) * (means(i) - mean))
        Estimate(mean, squares / (n - 1) / n, n - 1, n)

    private final class OfKnown(
        image: PrefixSums,
        variance: PrefixSums,
        squares: PrefixSums,
        freedom: Double,
        correlation: Double
    ) extends Estimates:
      def apply(x0: Int, x1: Int, y0: Int, y1: Int, pixels: Double): Estimate =
        def of(sums: PrefixSums) = sums(x0, x1, y0, y1)
        val sum = Math.max(0, of(variance))
        // The square of an estimated variance expects 1 + 2 / freedom times the true square
        val effective = sum * sum / Math.max(of(squares), 1e-300) * (1 + 2 / freedom) * freedom /
          correlation
        val degrees = Math.max(freedom, effective)
        Estimate(of(image) / pixels, correlation * sum / (pixels * pixels), degrees, images = 0)
