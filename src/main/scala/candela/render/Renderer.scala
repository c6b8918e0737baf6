package candela.render

import candela.film.{Film, FilterSampler, LayerFilm}

/** Turns a plan into an image. */
object Renderer:

  /** Renders with `threads` workers. The image depends on the plan alone, bit for bit: a pixel is
    * in one tile, whose samples are added in the order of their numbers, whoever does it.
    *
    * @param onProgress called about ten times a second, and at the end, in the caller's thread
    * @throws RenderFailure if a sample fails; all workers then stop
    */
  def render(
      plan: RenderPlan,
      threads: Int,
      cancellation: Cancellation = Cancellation(),
      onProgress: Progress => Unit = _ => ()
  ): Rendering =
    require(threads >= 1, s"$threads threads")
    val started = System.nanoTime
    def seconds = (System.nanoTime - started) * 1e-9

    val samplesPerPixel = plan.sampler.samplesPerPixel
    val schedule = Schedule(plan.crop, samplesPerPixel)
    val board = Board(schedule, cancellation)
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val film = Film(x0, y0, x1, y1)
    val layers = plan.layers.map(asked => LayerFilm(x0, y0, x1, y1, asked.layers))
    val filterSampler = new FilterSampler(plan.filter)
    val workers = Vector.fill(Math.min(threads.toLong, schedule.steps).toInt):
      TileWorker(plan, schedule, board, film, layers, filterSampler.copy())

    val total = plan.crop.pixels * samplesPerPixel
    def progress() = onProgress(Progress(board.samplesTaken.sum, total, seconds))
    Workers.run(workers, board)(() => progress())
    progress()

    Rendering(
      film,
      samplesPerPixel,
      board.samplesDone,
      board.samplesTaken.sum,
      workers.map(_.raysTraced).sum,
      seconds,
      firstOf(workers.flatMap(_.refused)),
      layers
    )

  private def firstOf(refused: Vector[Refused]): Option[Refused] =
    refused
      .minByOption(r => (r.sample, r.y, r.x))
      .map(_.copy(count = refused.map(_.count).sum))
