package candela.build.shapes

import scala.collection.mutable
import scala.util.Random

import org.scalatest.funsuite.AnyFunSuite

class CornerVerticesSuite extends AnyFunSuite:
  test("equal combinations have one number, in the order in which they come"):
    val random = Random(3)
    val (vertices, expected) = (CornerVertices(), mutable.LinkedHashMap.empty[(Int, Int, Int), Int])
    for _ <- 0 until 20000 do
      val key = (random.nextInt(20) - 1, random.nextInt(20) - 1, random.nextInt(20) - 1)
      val number = expected.getOrElseUpdate(key, expected.size)
      assert(vertices(key._1, key._2, key._3) == number)
    assert(vertices.size == expected.size)
    for ((a, b, c), i) <- expected do
      assert((vertices.first(i), vertices.second(i), vertices.third(i)) == (a, b, c))
