package candela.aov

import org.scalatest.funsuite.AnyFunSuite

import candela.film.ExactSums
import candela.image.Image

final class CryptomatteSuite extends AnyFunSuite:

  test("identifiers are those of the specification's examples"):
    val known = Vector(
      "hello" -> 6.0705627102400005616e-17,
      "cube" -> -4.08461912519e+15,
      "sphere" -> 2.79018604383e+15,
      "plane" -> 3.66557617593e-11
    )
    for (name, value) <- known do
      assert(Math.abs(Cryptomatte.id(name) / value - 1) < 1e-6, name)

  test("no identifier is NaN, infinite, denormal or 0"):
    for i <- 0 until 100000 do
      val id = Cryptomatte.id(i.toString)
      assert(java.lang.Float.isFinite(id) && Math.abs(id) >= java.lang.Float.MIN_NORMAL, i)

  test("identifiers are ranked by coverage of all samples, with the misses"):
    val (a, b, c) = (Cryptomatte.id("a"), Cryptomatte.id("b"), Cryptomatte.id("c"))
    var now = a
    val tally = Cryptomatte.tally(_ => now)
    val sums = ExactSums(tally.size)
    val seen = LayerFilmSuite.nothing
    for (id, weight) <- Vector(a -> 1.0, b -> 3.0, a -> 1.0, c -> 4.0) do
      now = id
      tally.add(sums, 0, weight, candela.color.Rgb.Black, seen)
    val pixel = PixelTally(sums, 0, tally.size, 5, weight = 10, hitWeight = 9, scale = 1)
    val values = Cryptomatte.Ranked(tally)(pixel).toVector
    assert(values.take(6) == Vector[Double](c, 0.4, b, 0.3, a, 0.2))
    assert(values.drop(6) == Vector.fill(6)(0.0))

  test("parts of an image are joined by identifier, whatever their order"):
    var now = 0f
    val tally = Cryptomatte.tally(_ => now)
    val seen = LayerFilmSuite.nothing
    def part(samples: (Float, Double)*) =
      val sums = ExactSums(tally.size)
      for (id, weight) <- samples do
        now = id
        tally.add(sums, 0, weight, candela.color.Rgb.Black, seen)
      sums
    val (first, second) = (part(2f -> 1.0, 3f -> 2.0), part(3f -> 5.0, 4f -> 1.0, 2f -> 3.0))
    tally.join(first, 0, second)
    first.add(second)
    val pixel = PixelTally(first, 0, tally.size, 5, weight = 20, hitWeight = 12, scale = 1)
    val values = Cryptomatte.Ranked(tally)(pixel).toVector
    assert(values.take(6) == Vector(3, 0.35, 2, 0.2, 4, 0.05))

  test("the legend names what occurs in the image"):
    val channels = Cryptomatte.channels("CryptoObject")
    assert(channels.size == 12 && channels.head == "CryptoObject00.R")
    assert(channels.last == "CryptoObject02.A")
    val image =
      Image(1, 1, channels, Array.tabulate(12)(i => if i == 2 then Cryptomatte.id("hello") else 0f))
    val legend = Cryptomatte.metadata("CryptoObject", Vector("cube", "hello"), image).toMap
    val key = legend.keys.head.takeWhile(_ != '/') + "/" + legend.keys.head.split("/")(1)
    assert(legend(s"$key/name") == "CryptoObject")
    assert(legend(s"$key/hash") == "MurmurHash3_32")
    assert(legend(s"$key/conversion") == "uint32_to_float32")
    assert(legend(s"$key/manifest") == "{\"hello\":\"248bfa47\"}")
    val odd = Image(1, 1, channels, Array.fill(12)(Cryptomatte.id("a\"\\\n")))
    val text = Cryptomatte.metadata("CryptoObject", Vector("a\"\\\n"), odd).last._2
    assert(text.startsWith("{\"a\\\"\\\\\\u000a\":"))
