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
  private val onProgress = () => beat()
  private val planSampler = plan.sampler.copy()
  private var sampler = planSampler
  private val rays = CameraRays(camera, plan.shutter, plan.differentialScale, plan.hidesSky)
  private val ray = rays.ray
  private val weighs = camera.weighs
  private val weighsLast = weighs && !plan.weighsFirst
  private val limit: SampleLimit | Null = plan.limit.orNull
  private val layerFilm: LayerFilm | Null = layers.orNull
  private val bands: BandFilm | Null = film.bands.orNull
  private val visible: VisibleSurface | Null = plan.layers.map(_.surface.copy()).orNull
  private val indirectLimit: SampleLimit | Null = plan.indirectLimit.orNull
  private val lightParts: LightParts | Null =
    if indirectLimit != null || plan.layers.exists(_.groups.isDefined) then integrator.lightParts
    else null
  if visible != null then visible.lightParts = lightParts

  private val firstSamples: FirstSamples | Null = plan.adaptive.map(FirstSamples(_)).orNull
  private var isTrial = false // whether samples go to `firstSamples`
  private val isColorOnly = layerFilm == null && bands == null

  // Accumulators of samples shared by several pixels
  private val levels: LevelPass | Null = film.levels.map(_.pass()).orNull
  private val sampleWindow: PixelBounds | Null = plan.sampleWindow.orNull
  private val shares: SharedPass | Null = film.shares.map(_.pass(Option(levels))).orNull
  private var filmX, filmY = 0f
  private var waveWeight = 1f

  // Current position, for error messages.
  private var x, y, sample = 0
  private var tile = schedule.tiles(0)

  private var discardedCount = 0L
  private var discardedX, discardedY, discardedSample, discardedMaterial = 0

  def raysTraced: Long = integrator.raysTraced

  def discarded: Option[DiscardedSamples] =
    Option.when(discardedCount > 0):
      DiscardedSamples(discardedCount, discardedX, discardedY, discardedSample, discardedMaterial)

  /** Takes one sample of the first tile, independent of the schedule. */
  def traceSample(x: Int, y: Int, sample: Int): Unit =
    this.x = x
    this.y = y
    this.sample = sample
    waveWeight = beginWave(sample, onProgress)
    beginTile(0)
    takeSample()
    if shares != null then shares.end()

  protected def failure(cause: Throwable): RenderFailure = RenderFailure(x, y, sample, cause)

  protected def work(tile: Int, wave: Int): Boolean =
    val first = schedule.firstSample(wave)
    val end = schedule.endSample(wave)
    val last = Math.min(end, queue.endSample)
    var begun = false
    var next = Math.max(first, queue.progress.get(tile).toInt)
    var isWhole = true
    while next < last && isWhole && queue.goesOn() && !queue.isAbandoned do
      sample = next
      if takes(tile, sample) then
        if !begun then waveWeight = beginWave(first, onProgress)
        begun = true
        isWhole = waveWeight != TileWorker.Stopped && renderSample(tile)
      if isWhole then
        next += schedule.atOnce
        queue.progress.set(tile, next)
    next >= end

  /** Takes a sample of each pixel of the tile, or all that are taken at once; false if it was left
    * before the last one.
    */
  private def renderSample(number: Int): Boolean =
    beginTile(number)
    val begun = queue.begun.remove(number)
    val trial = firstSamples
    val end = tile.pixels * schedule.atOnce
    var done = 0
    if begun != null then
      done = begun.done
      if shares != null then shares.resume(begun.sums)
    while done < end && !queue.isAbandoned do
      val i = done / schedule.atOnce
      x = tile.x0 + i % tile.width
      y = tile.y0 + i / tile.width
      if trial == null then
        takeSample()
        beat()
        done += 1
      else done = i * schedule.atOnce + takePixel(trial, done % schedule.atOnce)
    val isWhole = done == end
    if !queue.isLost then
      if isWhole then
        if shares != null then shares.end()
        if trial == null then queue.samplesTaken.add(tile.pixels)
      else if done > 0 then
        val sums = if shares == null then Array.emptyDoubleArray else shares.suspend()
        queue.begun.put(number, BegunPiece(done, sums)): Unit
    isWhole

  /** Takes the first samples of a pixel or, if these differ, all others instead.
    *
    * @param from how many of the others there are already
    * @return how many there are now; all, if no more are needed
    */
  private def takePixel(trial: FirstSamples, from: Int): Int =
    val all = schedule.atOnce
    if from == 0 && !tryOut(trial) then 0
    else if from == 0 && !trial.differ then
      addFirst(trial)
      queue.samplesTaken.add(trial.count)
      queue.samplesSpared.add(all - trial.count)
      all
    else
      sample = from
      while sample < all && !queue.isAbandoned do
        takeSample()
        beat()
        sample += 1
      queue.samplesTaken.add(sample - from)
      sample

  /** Traces the first samples of a pixel; false if it was left before the last one. */
  private def tryOut(trial: FirstSamples): Boolean =
    trial.clear()
    isTrial = true
    sampler = trial.sampler
    sample = 0
    while sample < trial.count && !queue.isAbandoned do
      takeSample()
      beat()
      sample += 1
    isTrial = false
    sampler = planSampler
    sample == trial.count

  /** Adds them to the film. What it needs beside their colours is traced again. */
  private def addFirst(trial: FirstSamples): Unit =
    sampler = trial.sampler
    sample = 0
    var traced = 0
    while sample < trial.count do
      if isPlaced() then
        if isColorOnly then
          val light = trial.light(traced)
          if !queue.isLost then if light.isFinite then add(light) else discard()
        else follow()
        traced += 1
      sample += 1
    sampler = planSampler

  private def beginTile(number: Int): Unit =
    tile = schedule.tiles(number)
    if shares != null then shares.selectTile(number, waveWeight)
    if levels != null then levels.selectTile(number)
    if visible != null then visible.weight = waveWeight

  private def takeSample(): Unit = if isPlaced() then follow()

  /** Places the sample on the film; false if no pixel needs it. */
  private def isPlaced(): Boolean =
    val shared = shares
    if shared == null then
      sampler.start(x, y, sample)
      sampler.next2D()
      filterSampler.sample(sampler.x, sampler.y)
      filmX = x + 0.5f + filterSampler.dx
      filmY = y + 0.5f + filterSampler.dy
      sampleWindow == null || sampleWindow.contains(filmX, filmY)
    else
      // Samplers cover the image only; pixels outside wrap around to the opposite side
      sampler.start(Math.floorMod(x, plan.width), Math.floorMod(y, plan.height), sample)
      sampler.next2D()
      filmX = x + sampler.x
      filmY = y + sampler.y
      shared.reaches(filmX, filmY)

  /** Traces the camera ray at the sampled film position. */
  private def follow(): Unit =
    val weight = rays.next(filmX, filmY, sampler)
    val trial = firstSamples
    if isTrial && trial != null then
      if weight == 0f then trial.addBlocked()
      else
        trial.traceFirstHit(ray)
        trial.add(limited(inSrgb(integrator.radiance(ray, sampler), weight), weight))
    else if weight == 0f then
      add(Rgb.Black)
      if layerFilm != null then layerFilm.miss(x, y, ownWeight)
    else
      if visible != null then visible.trace(ray, sample)
      val estimate = integrator.radiance(ray, sampler)
      if !queue.isLost then record(estimate, weight)

  private def record(estimate: Rgb, weight: Float): Unit =
    val radiance = inSrgb(estimate, weight)
    val light = limited(radiance, weight)
    if light.isFinite then
      add(light)
      if bands != null then addTo(bands, weight)
      if layerFilm != null && visible != null then
        if lightParts != null then develop(lightParts, radiance, light)
        layerFilm.add(x, y, light, ownWeight, visible)
    else discard()

  /** The radiance in sRGB, its indirect part limited. */
  private def inSrgb(estimate: Rgb, weight: Float): Rgb =
    val srgb = plan.basis.toSrgb(estimate)
    if lightParts != null && !plan.basis.isSrgb then lightParts.convert(lightParts, plan.basis)
    if indirectLimit != null && lightParts != null then lightParts.limit(indirectLimit, weight)
    else srgb

  /** The light that the film gets of it. */
  private def limited(radiance: Rgb, weight: Float): Rgb =
    val scaled = if weighs then weighed(radiance, weight) else radiance
    if limit != null && !weighsLast then scaled * limit.scale(scaled) else scaled

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

  private def discard(): Unit =
    val comesFirst = sample < discardedSample ||
      (sample == discardedSample && (y < discardedY || (y == discardedY && x < discardedX)))
    if discardedCount == 0 || comesFirst then
      discardedX = x
      discardedY = y
      discardedSample = sample
      discardedMaterial = integrator.lastMaterial
    discardedCount += 1

private[render] object TileWorker:
  type BeginWave = (Int, () => Unit) => Float

  val Unweighted: BeginWave = (_, _) => 1f

  /** No weight of samples. */
  val Stopped: Float = 0f
