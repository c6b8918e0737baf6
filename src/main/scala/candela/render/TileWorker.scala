package candela.render

import candela.cameras.CameraRays
import candela.color.Rgb
import candela.film.*
import candela.integrators.Integrator

/** Renders tiles, pixel by pixel.
  *
  * @param beginWave receives the first sample number of each wave of a tile
  */
private[render] final class TileWorker(
    plan: RenderPlan,
    schedule: TileSchedule,
    board: Board,
    film: Film,
    layers: Option[LayerFilm],
    filterSampler: FilterSampler,
    integrator: Integrator,
    beginWave: Int => Unit = _ => ()
) extends Worker(schedule, board):
  private val camera = plan.camera
  private val sampler = plan.sampler.copy()
  private val rays = CameraRays(camera, plan.shutter, plan.differentialScale)
  private val ray = rays.ray
  private val weighs = camera.weighs
  private val weighsLast = weighs && !plan.weighsFirst
  private val limit: SampleLimit | Null = plan.limit.orNull
  private val layerFilm: LayerFilm | Null = layers.orNull
  private val visible: VisibleSurface | Null = plan.layers.map(_.surface.copy()).orNull

  // Accumulators of samples shared by several pixels: the block of the tile
  private val shares: SampleShares | Null = film.shares.orNull
  private var block: SharedBlock | Null = null
  private var filmX, filmY = 0f

  // Current position, for error messages.
  private var x, y, sample = 0

  private var refusedCount = 0L
  private var refusedX, refusedY, refusedSample, refusedMaterial = 0

  def raysTraced: Long = integrator.raysTraced

  def refused: Option[Refused] =
    Option.when(refusedCount > 0):
      Refused(refusedCount, refusedX, refusedY, refusedSample, refusedMaterial)

  /** Takes one sample of the first tile, independent of the schedule. */
  def take(x: Int, y: Int, sample: Int): Unit =
    this.x = x
    this.y = y
    this.sample = sample
    begin(0, sample)
    takeSample()

  protected def failure(cause: Throwable): RenderFailure = RenderFailure(x, y, sample, cause)

  protected def work(tile: Int, wave: Int): Boolean =
    begin(tile, schedule.firstSample(wave))
    renderTile(schedule.tiles(tile), wave)

  private def begin(tile: Int, firstSample: Int): Unit =
    if shares != null then block = shares.block(tile)
    beginWave(firstSample)

  /** False if cancelled on the way. */
  private def renderTile(tile: PixelBounds, wave: Int): Boolean =
    val first = schedule.firstSample(wave)
    val end = schedule.endSample(wave)
    y = tile.y0
    while y < tile.y1 && !board.isStopped do
      x = tile.x0
      while x < tile.x1 do
        sample = first
        while sample < end do
          takeSample()
          sample += 1
        x += 1
      board.samplesTaken.add(tile.width.toLong * (end - first))
      y += 1
    y == tile.y1

  private def takeSample(): Unit =
    val shared = block
    if shared == null then
      sampler.start(x, y, sample)
      sampler.next2D()
      filterSampler.sample(sampler.x, sampler.y)
      filmX = x + 0.5f + filterSampler.dx
      filmY = y + 0.5f + filterSampler.dy
      follow()
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
      if layerFilm != null then layerFilm.miss(x, y, filterSampler.weight)
    else
      if visible != null then visible.look(ray)
      val radiance = plan.basis.toSrgb(integrator.radiance(ray, sampler))
      val seen = if weighs then weighed(radiance, weight) else radiance
      val light = if limit != null && !weighsLast then seen * limit.scale(seen) else seen
      if light.isFinite then
        add(light)
        if layerFilm != null && visible != null then
          layerFilm.add(x, y, light, filterSampler.weight, visible)
      else refuse()

  private def add(light: Rgb): Unit =
    val shared = block
    if shared == null then film.add(x, y, light.r, light.g, light.b, filterSampler.weight)
    else shared.add(filmX, filmY, light.r, light.g, light.b)

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
