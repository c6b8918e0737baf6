package candela.film

import candela.base.loop
import candela.io.{CheckedFile, CheckedOutput}
import candela.render.ThreadPool
import candela.testing.Draws

import java.math.BigDecimal
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

class ExactSumsSuite extends AnyFunSuite:

  /** Of very different magnitudes, with both signs. */
  private def values(count: Int, least: Double, most: Double): Vector[Double] =
    val draws = Draws(7)
    Vector.fill(count)(draws.magnitude(least, most) * (if draws.between(0, 1) < 0.4f then -1
                                                       else 1))

  private def sumOf(values: Seq[Double]): ExactSums =
    val sums = ExactSums(1)
    values.foreach(sums.add(0, _))
    sums

  test("what is not finite does not count"):
    val odd = Vector(Double.PositiveInfinity, Double.NegativeInfinity, Double.NaN, Double.MaxValue)
    assert(sumOf(Vector(1.0) ++ odd ++ Vector(Double.MaxValue))(0) == Double.MaxValue)
    assert(sumOf(Vector(1.0) ++ odd.take(3) ++ Vector(2.0))(0) == 3.0)

  private def bytes(sums: ExactSums): Vector[Byte] =
    val file = Files.createTempFile("sums", ".bin")
    try
      CheckedFile.write(file, "sums")(sums.save)
      Files.readAllBytes(file).toVector
    finally Files.delete(file)

  private val ranges = Vector((0.1, 10.0), (1e-12, 1e6), (1e-30, 1e30))

  test("a sum is that of arbitrary precision, rounded once, in any order"):
    for (least, most) <- ranges do
      val all = values(3000, least, most)
      val exact = all.map(BigDecimal(_)).reduce(_.add(_))
      for order <- Vector(all, all.reverse, all.sorted, all.sortBy(Math.abs)) do
        val sum = sumOf(order)
        assert(sum(0) == exact.doubleValue)
        val left = exact.subtract(BigDecimal(exact.doubleValue)).doubleValue
        assert(sum.remainder(0) == left)

  test("sums of parts are the sum of the whole, and are saved as the same bytes"):
    for (least, most) <- ranges do
      val all = values(999, least, most)
      val whole = sumOf(all)
      for parts <- Vector(2, 5, 111) do
        val added = ExactSums(1)
        all.zipWithIndex.groupMap(_._2 % parts)(_._1).values.foreach(v => added.add(sumOf(v)))
        assert(added(0) == whole(0))
        assert(bytes(added) == bytes(whole), s"$least to $most, $parts parts")

  test("what is subtracted is gone without a trace"):
    for (least, most) <- ranges do
      val sums = sumOf(values(100, least, most) :+ 0.1)
      sums.add(sumOf(values(100, least, most)), isNegative = true)
      assert(sums(0) == 0.1 && sums.remainder(0) == 0.0)

  test("a saved sum is the same sum"):
    for (least, most) <- ranges do
      val sums = sumOf(values(1000, least, most))
      val file = Files.createTempFile("sums", ".bin")
      try
        CheckedFile.write(file, "sums")((out: CheckedOutput) => sums.save(out))
        val read = ExactSums(1)
        CheckedFile.read(file, "sums")(read.load)
        assert(bytes(read) == bytes(sums))
        read.add(sums, isNegative = true)
        assert(read(0) == 0.0)
      finally Files.delete(file)

  test("second parts take memory only where sums have rounding errors"):
    val sums = ExactSums(5000)
    loop(5000)(i => sums.add(i, 0.1 * i))
    assert(sums.memory == 8 * 5000)
    sums.add(4500, 1e-9)
    assert(sums.memory == 8 * 5000 + 8 * (5000 - 4096))
    assert(sums(4500) == BigDecimal(0.1 * 4500).add(BigDecimal(1e-9)).doubleValue)
    assert(sums.remainder(4500) != 0 && sums.remainder(4499) == 0)
    val twice = ExactSums(5000)
    twice.add(sums)
    assert(twice.memory == sums.memory && bytes(twice) == bytes(sums))

  test("workers get second parts of sums beside each other at the same time"):
    val pool = ThreadPool(4)
    try
      for
        (least, most) <- ranges
        all = values(200, least, most)
        _ <- 1 to 20
      do
        val sums = ExactSums(64)
        pool.forEach(64)(at => all.foreach(sums.add(at, _)))
        assert((0 until 64).forall(at => sums(at) == sumOf(all)(0)))
        assert((0 until 64).forall(at => sums.remainder(at) == sumOf(all).remainder(0)))
    finally pool.close()
