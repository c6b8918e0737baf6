package candela.render

import candela.aov.*
import candela.cameras.CameraRays
import candela.color.Rgb
import candela.film.*
import candela.integrators.Integrator

/** Renders tiles, pixel by pixel.
  *
  * @param takes     whether to take this sample of this tile
  * @param beginWave receives the first sample number of each wave of a tile, and what to call while
  *   it works; returns the weight of the wave's samples, or [[TileWorker.Stopped]] if the rendering
  *   is stopped meanwhile
  */
private[render] final class TileWorker(
    plan: RenderPlan,
    schedule: TileSchedule,
    queue: TaskQueue,
    film: Film,
    layers: Option[LayerFilm],
    filterSampler: FilterSampler,
    integrator: Integrator,
    takes: (Int, Int) => Boolean,
    beginWave: TileWorker.BeginWave = TileWorker.Unweighted
) extends Worker(schedule, queue):
  private val camera = plan.camera
  private val getsOn = () => beat()
  private val sampler = plan.sampler.copy()
  private val rays = CameraRays(camera, plan.shutter, plan.differentialScale, plan.hidesSky)
  private val ray = rays.ray
  private val weighs = camera.weighs
  private val weighsLast = weighs && !plan.weighsFirst
  private val limit: SampleLimit | Null = plan.limit.orNull
  private val layerFilm: LayerFilm | Null = layers.orNull
  private val bands: BandFilm | Null = film.bands.orNull
  private val visible: VisibleSurface | Null = plan.layers.map(_.surface.copy()).orNull
  private val dimmer: SampleLimit | Null = plan.indirectLimit.orNull
  private val lightParts: LightParts | Null =
    if dimmer != null || plan.layers.exists(_.groups.isDefined) then integrator.lightParts else null
  if visible != null then visible.lightParts = lightParts

  // Accumulators of samples shared by several pixels
  private val levels: LevelPass | Null = film.levels.map(_.pass()).orNull
  private val sampleWindow: PixelBounds | Null = plan.sampleWindow.orNull
  private val shares: SharedPass | Null = film.shares.map(_.pass(Option(levels))).orNull
  private var filmX, filmY = 0f
  private var waveWeight = 1f

  // Current position, for error messages.
  private var x, y, sample = 0
  private var tile = schedule.tiles(0)

  private var refusedCount = 0L
  private var refusedX, refusedY, refusedSample, refusedMaterial = 0

  def raysTraced: Long = integrator.raysTraced

  def refused: Option[Refused] =
    Option.when(refusedCount > 0):
      Refused(refusedCount, refusedX, refusedY, refusedSample, refusedMaterial)

  /** Takes one sample of the first tile, independent of the schedule. */
  def traceSample(x: Int, y: Int, sample: Int): Unit =
    this.x = x
    this.y = y
    this.sample = sample
    waveWeight = beginWave(sample, getsOn)
    beginTile(0)
    takeSample()
    if shares != null then shares.end()

  protected def failure(cause: Throwable): RenderFailure = RenderFailure(x, y, sample, cause)

  protected def work(tile: Int, wave: Int): Boolean =
    val first = schedule.firstSample(wave)
    val end = schedule.endSample(wave)
    val last = Math.min(end, queue.endSample)
    var begun = false
    sample = Math.max(first, queue.progress.get(tile).toInt)
    var isWhole = true
    while sample < last && isWhole && queue.goesOn() && !queue.isAbandoned do
      if takes(tile, sample) then
        if !begun then waveWeight = beginWave(first, getsOn)
        begun = true
        isWhole = waveWeight != TileWorker.Stopped && renderSample(tile)
      if isWhole then
        sample += 1
        queue.progress.set(tile, sample)
    sample >= end

  /** Takes a sample of each pixel of the tile; false if it was left before the last one. */
  private def renderSample(number: Int): Boolean =
    beginTile(number)
    val begun = queue.begun.remove(number)
    var i = 0
    if begun != null then
      i = begun.done
      if shares != null then shares.resume(begun.sums)
    while i < tile.pixels && !queue.isAbandoned do
      x = tile.x0 + i % tile.width
      y = tile.y0 + i / tile.width
      takeSample()
      beat()
      i += 1
    val isWhole = i == tile.pixels
    if !queue.isLost then
      if isWhole then
        if shares != null then shares.end()
        queue.samplesTaken.add(tile.pixels)
      else if i > 0 then
        val sums = if shares == null then Array.emptyDoubleArray else shares.suspend()
        queue.begun.put(number, BegunPiece(i, sums)): Unit
    isWhole

  private def beginTile(number: Int): Unit =
    tile = schedule.tiles(number)
    if shares != null then shares.selectTile(number, waveWeight)
    if levels != null then levels.selectTile(number)
    if visible != null then visible.weight = waveWeight

  private def takeSample(): Unit =
    val shared = shares
    if shared == null then
      sampler.start(x, y, sample)
      sampler.next2D()
      filterSampler.sample(sampler.x, sampler.y)
      filmX = x + 0.5f + filterSampler.dx
      filmY = y + 0.5f + filterSampler.dy
      if sampleWindow == null || sampleWindow.contains(filmX, filmY) then follow()
    else
      // Samplers cover the image only; pixels outside wrap around to the opposite side
      sampler.start(Math.floorMod(x, plan.width), Math.floorMod(y, plan.height), sample)
      sampler.next2D()
      filmX = x + sampler.x
      filmY = y + sampler.y
      if shared.reaches(filmX, filmY) then follow()

  /** Traces the camera ray at the sampled film position. */
  private def follow(): Unit =
    val weight = rays.next(filmX, filmY, sampler)
    if weight == 0f then
      add(Rgb.Black)
      if layerFilm != null then layerFilm.miss(x, y, ownWeight)
    else
      if visible != null then visible.trace(ray, sample)
      val estimate = integrator.radiance(ray, sampler)
      if !queue.isLost then record(estimate, weight)

  private def record(estimate: Rgb, weight: Float): Unit =
    val srgb = plan.basis.toSrgb(estimate)
    if lightParts != null && !plan.basis.isSrgb then lightParts.convert(lightParts, plan.basis)
    val radiance =
      if dimmer != null && lightParts != null then lightParts.limit(dimmer, weight) else srgb
    val scaled = if weighs then weighed(radiance, weight) else radiance
    val light = if limit != null && !weighsLast then scaled * limit.scale(scaled) else scaled
    if light.isFinite then
      add(light)
      if bands != null then addTo(bands, weight)
      if layerFilm != null && visible != null then
        if lightParts != null then develop(lightParts, radiance, light)
        layerFilm.add(x, y, light, ownWeight, visible)
    else refuse()

  /** Divides `light` as `radiance` is: the camera's weight and the limit scale all parts alike. */
  private def develop(parts: LightParts, radiance: Rgb, light: Rgb): Unit =
    val largest = radiance.largest
    if largest != 0f then parts.scale(light.largest / largest)

  private def addTo(bands: BandFilm, weight: Float): Unit =
    val basis = integrator.lastWavelengths
    if basis != null then
      val light = integrator.lastComponents
      bands.add(x, y, basis, if weighs then light * weight else light, ownWeight)

  private def add(light: Rgb): Unit =
    val shared = shares
    if levels != null then levels.sample(light.r, light.g, light.b)
    if shared == null then
      film.add(x, y, light.r, light.g, light.b, ownWeight)
      if levels != null then levels.add((y - tile.y0) * tile.width + x - tile.x0, ownWeight)
    else shared.add(filmX, filmY, light.r, light.g, light.b)

  /** Of the sample in its own pixel. */
  private def ownWeight: Float = waveWeight * filterSampler.weight

  private def weighed(radiance: Rgb, weight: Float): Rgb =
    if limit != null && weighsLast then radiance * (limit.scale(radiance) * weight)
    else radiance * weight

  private def refuse(): Unit =
    val comesFirst = sample < refusedSample ||
      (sample == refusedSample && (y < refusedY || (y == refusedY && x < refusedX)))
    if refusedCount == 0 || comesFirst then
      refusedX = x
      refusedY = y
      refusedSample = sample
      refusedMaterial = integrator.lastMaterial
    refusedCount += 1

private[render] object TileWorker:
  type BeginWave = (Int, () => Unit) => Float

  val Unweighted: BeginWave = (_, _) => 1f

  /** No weight of samples. */
  val Stopped: Float = 0f
