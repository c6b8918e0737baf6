package candela.growth

import candela.testing.TempFolder

import java.lang.management.ManagementFactory
import java.util.function.BiFunction

import org.scalatest.Outcome
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tags.Slow

/** Each kind of thing of which a scene can have many is parsed, built and converted in about linear
  * time and memory: by the operations that are counted and the bytes that are allocated, not by the
  * clock.
  */
@Slow
final class GrowthSuite extends AnyFunSuite:
  private val loader = CountingLoader(getClass.getClassLoader)
  private val threads = ManagementFactory.getThreadMXBean match
    case bean: com.sun.management.ThreadMXBean => bean
    case _ => cancel("this JVM does not count the bytes of threads")

  /** Services, such as the formats of other modules, are classes of the same loader. */
  override protected def withFixture(test: NoArgTest): Outcome =
    val thread = Thread.currentThread
    val previous = thread.getContextClassLoader
    thread.setContextClassLoader(loader)
    try super.withFixture(test)
    finally thread.setContextClassLoader(previous)

  private def entry(name: String): BiFunction[Array[String], Integer, Runnable] =
    loader.loadClass(name).getDeclaredConstructor().newInstance()
      .asInstanceOf[BiFunction[Array[String], Integer, Runnable]] // as both loaders know it

  private lazy val growth = entry("candela.growth.GrowthEntry")

  /** Operations and bytes of a run. */
  private def costs(run: Runnable): (Long, Long) =
    val (operations, bytes) = (Operations.count, threads.getCurrentThreadAllocatedBytes)
    run.run()
    (Operations.count - operations, threads.getCurrentThreadAllocatedBytes - bytes)

  /** The exponent of operations, by what doubling a number adds, and that of all bytes. */
  private def exponents(size: Int)(run: Int => Runnable): (Double, Double) =
    costs(run(size)): Unit // makes what all share
    val results = Vector(size, 2 * size, 4 * size).map(count => costs(run(count)))
    val Vector(single, double, fourfold) = results.map(_._1.toDouble): @unchecked
    def log2(x: Double) = Math.log(x) / Math.log(2)
    val operations = log2(Math.max(fourfold - double, 1) / Math.max(double - single, 1))
    (operations, log2(results.last._2.toDouble / results.head._2) / 2)

  private def isLinear(measured: (Double, Double)): Boolean =
    measured._1 < GrowthSuite.Linear && measured._2 < GrowthSuite.Linear

  /** What looks superlinear is measured at four times the size, where it is more so: a step, such
    * as the next level of a hierarchy eight wide, is not.
    */
  private def assertLinear(name: String, size: Int)(run: Int => Runnable): Unit =
    val small = exponents(size)(run)
    if !isLinear(small) then
      val large = exponents(4 * size)(run)
      val (operations, bytes) = large
      assert(
        isLinear(large),
        f"$name grows with the exponents $operations%.2f in operations, $bytes%.2f in bytes"
      ): Unit

  for scene <- Growing.rows; action <- GrowingUse.values do
    test(s"$action: ${scene.name}, ${scene.dialect}"):
      TempFolder.use: folder =>
        val words = Array(scene.name, scene.dialect.toString, action.toString, folder.toString)
        assertLinear(scene.name, scene.size)(growth(words, _))

  test("a search through all for each is noticed, and a copy of all"):
    val planted = entry("candela.growth.PlantedGrowth")
    for
      (kind, expected) <- Seq("search" -> false, "copy" -> false, "set" -> true);
      size <- Seq(500, 2000)
    do
      val measured = exponents(size)(planted(Array(kind), _))
      assert((measured._1 < GrowthSuite.Linear) == expected, s"$kind, $size: $measured"): Unit

object GrowthSuite:
  /** n log n is 1.15 at a thousand. */
  private val Linear = 1.2

/** What grows linearly, and what does not. */
final class PlantedGrowth extends BiFunction[Array[String], Integer, Runnable]:
  def apply(words: Array[String], count: Integer): Runnable = () =>
    val numbers = Vector.range(0, count.intValue)
    words.head match
      case "search" => numbers.count(i => numbers.indexOf(i) == i): Unit
      case "copy" => numbers.foldLeft(Array.empty[Int])((array, i) => array :+ i): Unit
      case _ => numbers.toSet.size: Unit
