package candela.render

import candela.aov.{ImageLayer, LayerFilm}
import candela.film.{Fireflies, SpectralBands}
import candela.guiding.{GuideRecords, GuideSettings}

/** Memory of the film and of guiding. */
object FilmSize:

  /** Before the method is known.
    *
    * @param pixels  that are rendered
    * @param samples of each
    */
  def lowerBound(
      pixels: Long,
      samples: Int,
      layers: Vector[ImageLayer],
      bands: Option[SpectralBands]
  ): Cost =
    val layerNumbers = if layers.isEmpty then 0L else LayerFilm.size(layers, None)
    film(pixels, samples, layerNumbers, bands, 0)

  private[render] def of(plan: RenderPlan): Vector[Cost] =
    val pixels = plan.crop.pixels
    val layers = plan.layers.fold(0L)(asked => LayerFilm.size(asked.layers, asked.groups))
    val bands = plan.bands.fold(0)(_.channels.size)
    val colors = plan.splatGroups + plan.strategies.count(_.isSplatted)
    val splats = if plan.method.seesLightPaths then 3 * colors + bands else 0
    // Chains bring splats alone
    val samples = if plan.method.takesCameraSamples then plan.samplesPerPixel else 1
    val sum = sumOf(samples)
    // Samples that pixels share add to a level one by one
    val ofLevel = if plan.sharesSamples then Sum else sum
    val levels = if plan.fireflies == Fireflies.Reweighted then Levels * 3L * ofLevel else 0L
    val borders = if plan.sharesSamples then Border * 4 * sum else 0
    val cost = film(pixels, samples, layers, plan.bands, splats)
    cost.copy(bytes = cost.bytes + pixels * (levels + borders.toLong)) +:
      plan.method.guide.map(guide(plan, _)).toVector

  private def film(
      pixels: Long,
      samples: Int,
      layers: Long,
      bands: Option[SpectralBands],
      splats: Int
  ): Cost =
    val sums = (4L + layers) * sumOf(samples)
    // Several wavelengths of a sample are in one band
    val inBands = bands.fold(0L)(2L * _.channels.size * Sum)
    val channels = 3L + layers
    Cost(CostKind.Film, pixels * (sums + inBands + splats * Sum + channels * 4))

  private def guide(plan: RenderPlan, settings: GuideSettings): Cost =
    val paths = plan.sampled.pixels.toDouble * plan.samplesPerPixel / LastPass
    val records = Math.min(settings.records.toDouble, paths * Events).toLong
    // As threads record them, in one array, and its order
    Cost(CostKind.Guiding, records * (2 * GuideRecords.Bytes + 8))

  /** An exact sum is two Doubles, and of one value the first. */
  private val Sum = 16L
  private def sumOf(samples: Int): Long = if samples == 1 then Sum / 2 else Sum

  /** Pixels beside tiles that samples of a tile contribute to, relative to its own. */
  private val Border = 0.27

  /** Levels of brightness that most tiles have samples of. */
  private val Levels = 4

  /** The last pass has one of so many of the samples. */
  private val LastPass = 4

  /** Events of a path that find light, about. */
  private val Events = 2
