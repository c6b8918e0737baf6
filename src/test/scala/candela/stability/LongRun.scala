package candela.stability

/** The cases of the stability suites with their long counts, which take minutes to hours:
  * `./sbt "Test/runMain candela.stability.LongRun --case words of its name --count 1000000"`.
  * Without `--case` all are run; without `--count` each as often as it says.
  */
object LongRun:
  private val groups: Seq[Group] =
    Seq(SelfIntersection, Intersections, Scattering, Lighting, Accumulation, Sampling)

  def main(args: Array[String]): Unit =
    def option(name: String) =
      val at = args.indexOf(name)
      Option.when(at >= 0)(args.drop(at + 1).takeWhile(!_.startsWith("--")).mkString(" "))
    val wanted = option("--case").getOrElse("")
    val count = option("--count").map(_.toLong)
    val chosen =
      groups.flatMap(_.cases).filter(c => c.name.contains(wanted) || c.kind.contains(wanted))
    val failures = chosen.count(c => !holds(c, count.getOrElse(c.long)))
    println(s"${chosen.size - failures} passed, $failures failed")
    if failures > 0 then throw IllegalStateException(s"$failures cases failed")

  private def holds(c: Case, count: Long): Boolean =
    val started = System.nanoTime
    val failure =
      try
        c.check(count)
        None
      catch case e: org.scalatest.exceptions.TestFailedException => Some(e.getMessage)
    val seconds = (System.nanoTime - started) / 1000000000L
    println(s"${failure.fold("ok    ")(_ => "FAILED")} ${c.name}: $count trials, $seconds s")
    failure.foreach(message => println(s"       $message"))
    failure.isEmpty
