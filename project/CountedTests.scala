import java.io.{FileDescriptor, FileOutputStream, PrintStream}

import sbt.{Logger, TestResult, TestResultLogger, Tests}

/** Adds up the tests of the whole sbt session, and ends its output with one plain line:
  * `12 passed, 0 failed`, with `, 1 skipped` behind it if there are any.
  *
  * Only a shutdown hook comes after sbt's own closing lines. Success and failure stay as they were.
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
    // A suite that could not be made, or a JVM that died, fails without a test that did
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
    // not Console: by now sbt has taken its own away
    val out = new PrintStream(new FileOutputStream(FileDescriptor.out))
    val rest = if (skipped > 0) s", $skipped skipped" else ""
    out.println(s"$passed passed, $failed failed$rest")
    out.flush()
  }
}
