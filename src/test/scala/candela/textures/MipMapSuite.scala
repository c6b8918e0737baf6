package candela.textures

import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

class MipMapSuite extends AnyFunSuite:

  private def image(width: Int, height: Int): Texels =
    FloatTexels(width, height, 1, Array.tabulate(width * height)(_.toFloat))

  test("an image has as many levels as its pyramid"):
    for width <- 1 to 20; height <- Seq(1, 2, 3, 7, 8, 33) do
      val made = Pyramid.of(image(width, height), Wrap.Repeat, 1f)
      assert(Pyramid.size(width, height) == made.length, s"$width×$height")

  test("levels are made when one is first looked up, once, by whatever thread"):
    var count = 0
    val map = MipMap.ofImage(5, 3, Wrap.Clamp, Float.PositiveInfinity, Parallel.Alone): () =>
      count += 1
      image(5, 3)
    assert(map.size == 4 && count == 0)
    val threads = Vector.fill(4)(Thread(() => map(0): Unit))
    threads.foreach(_.start())
    threads.foreach(_.join())
    val whole = Pyramid.of(image(5, 3), Wrap.Clamp, Float.PositiveInfinity)
    assert((0 until 4).forall(i => map(i)(0, 0) == whole(i)(0, 0)))
    assert(count == 1)

  test("the mean is the last level, and an image as it is has one"):
    val all = MipMap.of(Pyramid.of(image(4, 4), Wrap.Repeat, Float.PositiveInfinity))
    assert(MipMap.ofMean(all).size == 1 && MipMap.ofMean(all)(0)(0, 0) == 7.5f)
    val plain = MipMap.plain(Wrap.Repeat)(() => image(4, 4))
    assert(plain.size == 1 && plain(0)(5, 0) == 5f)
