package candela.cluster

import candela.job.ClusterFailure

import org.scalatest.funsuite.AnyFunSuite

class JavaReleaseSuite extends AnyFunSuite:

  test("an executor of another Java says so, and both releases reach the user"):
    val failure = intercept[ClusterFailure](JavaRelease.check(driver = 25, executor = 17))
    // As Spark passes it on
    val passed = s"Job aborted\nLost task 0.3: $failure\n\tat org.apache.spark"
    val reason = SparkRun.reason(passed)
    assert(reason.startsWith("an executor runs on Java 17, the program on Java 25"))
    assert(reason.contains("set JAVA_HOME"))

  test("an executor of the same Java renders"):
    JavaRelease.check(driver = JavaRelease.current)
