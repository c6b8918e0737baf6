package candela.render

import candela.film.PixelBounds

import java.util.concurrent.atomic.AtomicLongArray

import org.scalatest.funsuite.AnyFunSuite

class ScheduleSuite extends AnyFunSuite:
  private val crop = PixelBounds(3, 5, 50, 41)

  test("two waves double what there is, up to 64 samples at a time"):
    val schedule = TileSchedule(crop, 300)
    val starts = (0 to schedule.waves).map(schedule.firstSample)
    assert(starts == Vector(0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 300))

  test("waves cover every sample once, for any count"):
    for samples <- 1 to 140 do
      val schedule = TileSchedule(crop, samples)
      val covered = (0 until schedule.waves).flatMap: wave =>
        schedule.firstSample(wave) until schedule.endSample(wave)
      assert(covered == (0 until samples))

  test("samples until an error are as many as its waves have"):
    val schedule = TileSchedule(crop, RenderPlan.Endless)
    assert(Vector(0.5, 1.0, 5.2, 33.0, 64.0, 65.0, 1000.0).map(schedule.wholeWaves) ==
      Vector(1, 1, 6, 48, 64, 96, 1024))
    assert(schedule.wholeWaves(1e300) == Int.MaxValue)

  test("the greatest numbers of samples have waves, without a list of them"):
    val schedule = TileSchedule(crop, Int.MaxValue)
    assert(schedule.firstSample(schedule.waves) == Int.MaxValue)
    assert(schedule.firstSample(schedule.waves - 1) == Int.MaxValue - 63)
    assert(schedule.endSample(schedule.waves) == Int.MaxValue)
    assert(schedule.doublings.take(4) == Vector(1, 2, 4, 6))
    assert(schedule.doublings.last == schedule.waves)
    assert(schedule.doublings.init.map(schedule.firstSample) == (0 to 30).map(1 << _))
    val single = TileSchedule(crop, Int.MaxValue, largestWave = 1, openWaves = 1)
    assert(single.waves == Int.MaxValue)
    val _ = TaskQueue(single, Cancellation())

  test("a chain has the samples of the last wave whose paths are all there"):
    val schedule = ChainSchedule(3, 100, 1000000000, Shard.Whole)
    def done(paths: Long) =
      schedule.samplesDone(AtomicLongArray(Array.tabulate(3)(_ => paths))).min
    for wave <- Vector(0, 1, 5, 9, 1000, schedule.waves) do
      val samples = schedule.firstSample(wave)
      val paths = schedule.paths(0, samples)
      assert(done(paths) == samples)
      assert(wave == 0 || done(paths - 1) == schedule.firstSample(wave - 1))

  test("a wave begins when the pieces of the one before the last are all finished"):
    val schedule = TileSchedule(crop, 5, largestWave = 1, openWaves = 2)
    val queue = TaskQueue(schedule, Cancellation())
    val last = schedule.pieces - 1
    for wave <- 0 until 2; piece <- 0 until last do
      assert(queue.isTurn(piece, wave))
      queue.finish(piece, wave)
    assert(!queue.isTurn(0, 2))
    queue.finish(last, 0)
    assert(queue.isTurn(0, 2) && !queue.isTurn(last, 2))
    queue.finish(0, 2)
    assert(!queue.isTurn(0, 3))

  test("a piece that has finished a wave ahead of the others doesn't wait for it again"):
    val cancellation = Cancellation()
    val queue = TaskQueue(TileSchedule(crop, 64), cancellation)
    queue.start(1)
    // A shortened pass, in which the first piece is at the end of the wave already
    queue.openUntil(wave = 1, samples = 1)
    queue.finish(0, 0)
    // Waiting would end only here
    val late = Thread: () =>
      Thread.sleep(10_000)
      cancellation.request()
    late.setDaemon(true)
    late.start()
    assert(!queue.awaitTurn(0, 0) && !cancellation.isRequested)

  test("tiles cover every pixel of the crop once, and no other"):
    val schedule = TileSchedule(crop, 1)
    val covered =
      for
        i <- 0 until schedule.pieces
        tile = schedule.tiles(i)
        y <- tile.y0 until tile.y1
        x <- tile.x0 until tile.x1
      yield (x, y)
    val wanted = for y <- crop.y0 until crop.y1; x <- crop.x0 until crop.x1 yield (x, y)
    assert(covered.size == wanted.size)
    assert(covered.toSet == wanted.toSet)

  test("an image smaller than a tile is one tile"):
    val schedule = TileSchedule(PixelBounds(7, 7, 8, 9), 4)
    assert(schedule.pieces == 1)
    assert(schedule.tiles(0) == PixelBounds(7, 7, 8, 9))
    assert(schedule.steps == schedule.waves)
