package candela.render

import candela.film.PixelBounds

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
