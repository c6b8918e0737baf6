import java.io.{FileDescriptor, FileOutputStream, PrintStream}

import sbt.{Logger, TestResult, TestResultLogger, Tests}

/** Counts the tests of the whole sbt session and prints the totals as its last line: `12 passed, 0
  * failed`, followed by `, 1 skipped` if any; before it, the slowest of [[TestRecord]].
  *
  * Uses a shutdown hook, because nothing else runs after sbt's own closing lines. Success and
  * failure of the session are unchanged.
  */
object CountedTests {
  private var passed, failed, skipped = 0
  private var hooked = false

  def apply(plain: TestResultLogger): TestResultLogger =
    new TestResultLogger {
      def run(log: Logger, results: Tests.Output, taskName: String): Unit = {
        add(results)
        plain.run(log, results, taskName)
      }
    }

  private def add(results: Tests.Output): Unit = synchronized {
    val suites = results.events.values
    val failures = suites.map(s => s.failureCount + s.errorCount).sum
    // A suite that can't be instantiated, or a crashed JVM, fails without a failed test.
    val unseen = if (failures == 0 && results.overall != TestResult.Passed) 1 else 0
    passed += suites.map(_.passedCount).sum
    failed += failures + unseen
    skipped += suites.map(s => s.skippedCount + s.ignoredCount).sum
    skipped += suites.map(s => s.canceledCount + s.pendingCount).sum
    if (!hooked) {
      hooked = true
      sys.addShutdownHook(report())
    }
  }

  private def report(): Unit = {
    // Not Console: sbt has already restored its own.
    val out = new PrintStream(new FileOutputStream(FileDescriptor.out))
    TestRecord.report(out)
    val rest = if (skipped > 0) s", $skipped skipped" else ""
    out.println(s"$passed passed, $failed failed$rest")
    out.flush()
  }
}
