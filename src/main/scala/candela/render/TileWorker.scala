package candela.render

import candela.cameras.Shutter
import candela.film.{Film, FilterSampler}
import candela.geometry.Ray

/** One of several that render the same image: takes tiles from the board, and owns all that it
  * scribbles on.
  */
private[render] final class TileWorker(
    plan: RenderPlan,
    schedule: Schedule,
    board: Board,
    film: Film,
    filterSampler: FilterSampler
) extends Runnable:
  private val camera = plan.camera
  private val sampler = plan.sampler.copy()
  private val integrator = plan.integrator.copy()
  private val ray = Ray()
  private val scratch = Ray()
  private val hasDifferentials = plan.differentialScale > 0f
  private val moves = plan.shutter.isDefined
  private val shutter = plan.shutter.getOrElse(Shutter(0f, 0f))

  // Where the worker is, for the message if something fails.
  private var x, y, sample = 0

  private var refusedCount = 0L
  private var refusedX, refusedY, refusedSample = 0

  def raysTraced: Long = integrator.raysTraced

  def refused: Option[Refused] =
    Option.when(refusedCount > 0)(Refused(refusedCount, refusedX, refusedY, refusedSample))

  def run(): Unit =
    try
      var step = board.takeStep()
      while step >= 0 do
        val wave = (step / schedule.tiles).toInt
        val tile = (step % schedule.tiles).toInt
        if board.awaitTurn(tile, wave) && renderTile(schedule.tile(tile), wave) then
          board.finish(tile, wave)
        step = board.takeStep()
    catch case e: Throwable => throw RenderFailure(x, y, sample, e)

  /** False if it was told to stop on the way. */
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
    sampler.start(x, y, sample)
    sampler.next2D()
    filterSampler.sample(sampler.x, sampler.y)
    sampler.next2D()
    val filmX = x + 0.5f + filterSampler.dx
    val filmY = y + 0.5f + filterSampler.dy
    if moves then
      ray.time = shutter.at(sampler.next1D()) // leaves x and y as they are
      scratch.time = ray.time
    camera.generate(filmX, filmY, sampler.x, sampler.y, ray)
    if hasDifferentials then
      val scale = plan.differentialScale
      camera.differential(filmX, filmY, sampler.x, sampler.y, scale, ray, scratch)
    val radiance = plan.basis.toSrgb(integrator.radiance(ray, sampler))
    if radiance.isFinite then
      val brightest = radiance.max
      val scale = if brightest > plan.maxComponent then plan.maxComponent / brightest else 1f
      val light = radiance * scale
      film.add(x, y, light.r, light.g, light.b, filterSampler.weight)
    else refuse()

  private def refuse(): Unit =
    val comesFirst = sample < refusedSample ||
      (sample == refusedSample && (y < refusedY || (y == refusedY && x < refusedX)))
    if refusedCount == 0 || comesFirst then
      refusedX = x
      refusedY = y
      refusedSample = sample
    refusedCount += 1
