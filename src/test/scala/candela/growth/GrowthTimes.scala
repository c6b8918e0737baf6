package candela.growth

import candela.diagnostics.SceneError
import candela.testing.TempFolder

import java.lang.management.ManagementFactory
import java.util.Locale

/** Measures the processor time of scenes that grow, and the memory that they keep. Arguments: a
  * regular expression of use and name, seconds to reach, and the largest number.
  */
object GrowthTimes:
  private val threads = ManagementFactory.getThreadMXBean

  def main(words: Array[String]): Unit =
    val pattern = words.headOption.getOrElse(".*").r
    val goal = words.lift(1).fold(0.5)(_.toDouble)
    val limit = words.lift(2).fold(100_000)(_.toInt)
    println("thing; dialect; use; number; seconds; exponents; µs each; MB")
    for
      scene <- Growing.rows
      action <- GrowingUse.values if pattern.matches(s"$action: ${scene.name}")
    do
      try println(measured(scene, action, goal, limit))
      catch case e: Throwable => println(s"${scene.name}; $action; $e")

  private def measured(scene: Growing, action: GrowingUse, goal: Double, limit: Int): String =
    TempFolder.use: folder =>
      def run(count: Int) = action.prepare(scene, scene.write(folder, count), count)
      val smallest = run(scene.size)
      for e <- Option(smallest()).collect { case e: SceneError if !scene.isFaulty => e } do throw e
      var count = scene.size
      var times = List(seconds(smallest()))
      while (times.head < goal || times.size < 3) && count < limit do
        count *= 2
        val runCount = run(count)
        val elapsed = seconds(runCount())
        times ::= (if elapsed < 2 then Math.min(elapsed, seconds(runCount())) else elapsed)
      val exponents = times.lazyZip(times.drop(1)).map((a, b) => Math.log(a / b) / Math.log(2))
      val megabytes = if times.head > 5 then 0 else retained(run(count))
      "%s; %s; %s; %d; %.2f; %.2f %.2f; %.1f; %.0f".formatLocal(
        Locale.ROOT,
        scene.name,
        scene.dialect,
        action,
        count,
        times.head,
        exponents(1),
        exponents(0),
        times.head / count * 1e6,
        megabytes
      )

  private def seconds(body: => AnyRef): Double =
    val start = threads.getCurrentThreadCpuTime
    body: Unit
    (threads.getCurrentThreadCpuTime - start) * 1e-9

  private def retained(build: () => AnyRef): Double =
    def usedBytes =
      System.gc()
      Runtime.getRuntime.totalMemory - Runtime.getRuntime.freeMemory
    val base = usedBytes
    val scene = build()
    val bytes = usedBytes
    java.lang.ref.Reference.reachabilityFence(scene)
    (bytes - base) * 1e-6
