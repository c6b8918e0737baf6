package candela.film

import candela.render.ThreadPool

import org.scalatest.funsuite.AnyFunSuite

class FilmSuite extends AnyFunSuite:

  test("a pixel is the weighted mean of its samples, times the scale"):
    val film = Film(PixelBounds(10, 20, 13, 22))
    film.add(11, 21, 1f, 2f, 3f, 1f)
    film.add(11, 21, 5f, 6f, 7f, 3f)
    val image = film.toImage(2f)
    assert((image.width, image.height) == (3, 2))
    assert((0 until 3).map(image(1, 1, _)) == Vector(8f, 10f, 12f))

  test("the weights of the image's pixels are those of its samples"):
    val film = Film(PixelBounds(0, 0, 2, 2))
    film.add(1, 0, 1f, 1f, 1f, 0.5f)
    film.add(0, 1, 1f, 1f, 1f, 1f)
    film.add(0, 1, 1f, 1f, 1f, 2f)
    val weights = new Array[Float](4)
    val _ = film.toImage(1f, Some(weights))
    assert(weights.toVector == Vector(0f, 0.5f, 3f, 0f))

  test("pixels without samples, or with weights that cancel, are black"):
    val film = Film(PixelBounds(0, 0, 2, 1))
    film.add(0, 0, 4f, 4f, 4f, 1f)
    film.add(0, 0, 4f, 4f, 4f, -1f)
    assert(film.toImage(1f).data.forall(_ == 0f))

  test("negative weights count with their sign"):
    val film = Film(PixelBounds(0, 0, 1, 1))
    film.add(0, 0, 1f, 1f, 1f, 1.5f)
    film.add(0, 0, 2f, 0f, 1f, -0.5f)
    assert(film.toImage(1f).data.toVector == Vector(0.5f, 1.5f, 1f))

  test("threads that share the rows develop the image that one does"):
    val random = java.util.Random(1)
    val bounds = PixelBounds(3, 5, 40, 76)
    val tiles =
      for y <- 0 until 80 by 16; x <- 0 until 48 by 16 yield PixelBounds(x, y, x + 16, y + 16)
    val shares =
      SampleShares(
        PixelBounds(3, 5, 40, 76),
        FilterReach(TriangleFilter(1.5f, 1.5f)),
        tiles.toVector
      )
    val pass = shares.pass()
    for (tile, i) <- tiles.zipWithIndex do
      pass.selectTile(i)
      for _ <- 1 to 100 do
        val (x, y) = (tile.x0 + 16 * random.nextFloat, tile.y0 + 16 * random.nextFloat)
        if pass.reaches(x, y) then pass.add(x, y, random.nextFloat, -random.nextFloat, 0.3f)
      pass.end()
    val shared = Film(bounds, shares = Some(shares))
    val own = Film(bounds)
    for _ <- 1 to 5000 do
      val (x, y) = (3 + random.nextInt(37), 5 + random.nextInt(71))
      own.add(x, y, random.nextFloat, -random.nextFloat, 0.3f, random.nextFloat)
    val how =
      Development(2f, balance = Some(Array(1, 2, 0, 0, 1, 3, 0, 1, 1)), clipsNegative = true)
    val pool = ThreadPool(3)
    try
      for film <- Vector(shared, own) do
        val (one, three) = (new Array[Float](37 * 71), new Array[Float](37 * 71))
        val alone = how(film, Some(one)).data
        val together = how(film, Some(three), pool = pool).data
        assert(alone.exists(_ > 0f) && together.sameElements(alone) && three.sameElements(one))
    finally pool.close()

  test("a million equal samples keep their value"):
    val film = Film(PixelBounds(0, 0, 1, 1))
    for _ <- 0 until 1000000 do film.add(0, 0, 0.1f, 0.2f, 0.3f, 0.7f)
    assert(film.toImage(1f).data.toVector == Vector(0.1f, 0.2f, 0.3f))

  test("finite samples are taken however large"):
    val film = Film(PixelBounds(0, 0, 1, 1))
    film.add(0, 0, Float.MaxValue, Float.MaxValue, 1f, 2f)
    assert(film.toImage(1f).data.toVector == Vector(Float.MaxValue, Float.MaxValue, 1f))

  test("what was added since a copy is seen alone"):
    val film = Film(PixelBounds(0, 0, 2, 1))
    film.add(0, 0, 4f, 4f, 4f, 1f)
    val before = film.copy()
    film.add(0, 0, 1f, 2f, 3f, 0.5f)
    film.add(1, 0, 8f, 8f, 8f, 1f)
    assert(before.toImage(1f).data.toVector == Vector(4f, 4f, 4f, 0f, 0f, 0f))
    assert(film.deltaSince(before).toImage(1f).data.toVector == Vector(1f, 2f, 3f, 8f, 8f, 8f))
