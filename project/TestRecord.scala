import java.io.{File, PrintStream}
import java.util.Locale

import scala.collection.mutable

import sbt.protocol.testing.TestResult
import sbt.testing.{Status, TestSelector}
import sbt.{IO, TestEvent, TestsListener}

/** Keeps how long each test took, in `target/test-times.csv`.
  *
  * A row of the file is a test: suite, name, seconds. Tests that were not run in this session keep
  * the row of the last one that ran them.
  */
final class TestRecord(file: File) extends TestsListener {
  import TestRecord._

  private val seconds = mutable.Map.empty[(String, String), Double]

  def doInit(): Unit = ()
  def startGroup(name: String): Unit = ()

  def testEvent(event: TestEvent): Unit = synchronized {
    for (e <- event.detail) (e.status, e.selector) match {
      case (Status.Success | Status.Failure, test: TestSelector) =>
        seconds((e.fullyQualifiedName, test.testName)) = e.duration / 1000.0
      case _ =>
    }
  }

  def endGroup(name: String, t: Throwable): Unit = ()
  def endGroup(name: String, result: TestResult): Unit = ()

  def doComplete(result: TestResult): Unit = synchronized {
    add(file, seconds.toMap)
    seconds.clear()
  }
}

object TestRecord {
  private val Header = "suite,test,seconds"

  /** How many suites and tests are printed. */
  private val SlowestCount = 20

  /** Of the whole sbt session: seconds of suite and test. */
  private var times = Map.empty[(String, String), Double]

  private def add(file: File, seconds: Map[(String, String), Double]): Unit = synchronized {
    if (seconds.nonEmpty) write(file, read(file) ++ seconds)
    times ++= seconds
  }

  private def read(file: File): Map[(String, String), Double] =
    if (!file.exists) Map.empty
    else
      IO.readLines(file).drop(1).flatMap { line =>
        val (first, last) = (line.indexOf(','), line.lastIndexOf(','))
        if (first < 0 || first == last) None
        else {
          val name = line.substring(first + 1, last).stripPrefix("\"").stripSuffix("\"")
          Some((line.take(first), name.replace("\"\"", "\"")) -> line.substring(last + 1).toDouble)
        }
      }.toMap

  private def write(file: File, rows: Map[(String, String), Double]): Unit =
    IO.writeLines(
      file,
      Header +: rows.toVector.sortBy(_._1).map { case ((suite, test), s) =>
        val name = test.replace("\"", "\"\"").replaceAll("\\s+", " ")
        suite + ",\"" + name + "\"," + decimal(s, 3)
      }
    )

  private def decimal(x: Double, digits: Int): String =
    ("%." + digits + "f").formatLocal(Locale.ROOT, x)

  /** Prints the slowest suites and tests of the session. */
  def report(out: PrintStream): Unit = synchronized {
    def slowest(title: String, rows: Iterable[(String, Double)]): Unit = {
      out.println(title)
      for ((name, s) <- rows.toVector.sortBy(-_._2).take(SlowestCount))
        out.println("%8s s  %s".format(decimal(s, 1), name))
    }
    if (times.size > SlowestCount) {
      val suites = times.groupBy(_._1._1).map { case (suite, of) => suite -> of.values.sum }
      slowest(s"The slowest of ${suites.size} suites:", suites)
      slowest(
        s"The slowest of ${times.size} tests:",
        times.map { case ((suite, test), s) => s"${suite.split('.').last}: $test" -> s }
      )
    }
  }
}
