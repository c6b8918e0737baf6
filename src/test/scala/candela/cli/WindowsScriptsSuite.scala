package candela.cli

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** The scripts for Windows, which no test can run here: what can be seen by reading them. */
class WindowsScriptsSuite extends AnyFunSuite:
  private def text(file: String): String = Files.readString(Path.of(file))

  private def found(file: String, pattern: String): String =
    pattern.r.findFirstMatchIn(text(file)).fold(fail(s"$file has no $pattern"))(_.group(1))

  private val scripts = Seq("sbt.bat", "src/universal/bin/candela.bat")

  test("sbt and sbt.bat fetch the launcher of the build's sbt, and expect the same file"):
    val version = found("project/build.properties", "sbt.version=(\\S+)")
    assert(found("sbt", "(?m)^version=(\\S+)") == version)
    assert(found("sbt.bat", "\"VERSION=(.+?)\"") == version)
    assert(found("sbt", "(?m)^sha256=(\\w+)") == found("sbt.bat", "\"SHA256=(\\w+)\""))

  test("sbt and sbt.bat give sbt's JVM the same options"):
    def options(file: String) =
      "-X[\\w:+=]+|--enable-native-access=\\S+|--sun-misc\\S+?(?=[\" ])".r.findAllIn(
        text(file)
      ).toSet
    assert(options("sbt.bat") == options("sbt"))

  test("lines end as Windows wants them, where labels are sought"):
    for script <- scripts do
      val lines = text(script).split("\n", -1).toVector
      assert(lines.init.forall(_.endsWith("\r")), script)

  test("what is called is there"):
    for script <- scripts do
      val called = "call :(\\w+)".r.findAllMatchIn(text(script)).map(_.group(1)).toSet
      val labels = "(?m)^:(\\w+)$".r.findAllMatchIn(text(script)).map(_.group(1)).toSet
      assert(called == labels && called.nonEmpty, script)

  test("each JDK gets the options that it knows, as by the other launcher"):
    val launcher = text("src/universal/bin/candela")
    val limit =
      "\"\\$best\" -lt (\\d+) \\] \\|\\| options=\\$options-25".r.findFirstMatchIn(launcher)
    assert(limit.map(_.group(1)).contains("25"))
    assert(text(
      "src/universal/bin/candela.bat"
    ).contains("if %BEST% GEQ 25 set \"OPTIONS=%LIB%\\options-25\""))

  test("a collector that is asked for replaces ours in both"):
    def collectors(file: String, pattern: String) =
      pattern.r.findAllMatchIn(text(file)).map(_.group(1)).toSet
    val ours = collectors("src/universal/bin/candela", "UseParallelGC|-XX:\\+Use(\\w+?)GC")
    val theirs = found("src/universal/bin/candela.bat", "for %%C in \\((.+?)\\)").split(' ').toSet
    assert(theirs == ours.filter(_ != null))
