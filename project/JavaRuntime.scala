package packaging

import java.nio.file.{Files, Path}

import scala.util.Try

/** A Java runtime with the modules that the program uses, made by `jlink`. */
object JavaRuntime {

  /** Those that `jdeps` finds in the jar, those that code asks for by name, and the charsets in
    * which scenes may be written. `packaging/check` compares them with the jar.
    */
  val modules: Vector[String] = Vector(
    "java.base",
    "java.desktop", // PNG and JPEG
    "java.management",
    "java.xml", // Mitsuba's scenes
    "jdk.charsets",
    "jdk.incubator.vector", // SIMD kernels, loaded by VectorModule
    "jdk.management",
    "jdk.unsupported" // signals
  )

  /** The JDK that makes the runtime, or why there is none.
    *
    * @param bestJava the least version of a JDK that nobody named
    */
  def jdk(environment: Map[String, String], own: Path, bestJava: Int): Either[String, Path] =
    environment.get("CANDELA_RUNTIME_JDK").filter(_.nonEmpty) match {
      case Some(named) => fault(Path.of(named)).toLeft(Path.of(named))
      case None =>
        val known = environment.get("JAVA_HOME").filter(_.nonEmpty).map(Path.of(_)).toSeq :+ own
        known.find(home => fault(home).isEmpty && major(home) >= bestJava).toRight(
          s"the zip with Java and the wheel need a JDK $bestJava or newer with jlink, for example " +
            "from https://adoptium.net: install it, and set JAVA_HOME or CANDELA_RUNTIME_JDK to " +
            "its folder"
        )
    }

  private def fault(home: Path): Option[String] = {
    val missing = modules.filterNot(release(home, "MODULES").split(' ').contains)
    if (jlink(home).isEmpty) Some(s"$home has no bin/jlink")
    else if (missing.nonEmpty) Some(s"$home lacks ${missing.mkString(", ")}")
    else None
  }

  def major(home: Path): Int =
    Try(release(home, "JAVA_VERSION").takeWhile(_.isDigit).toInt).getOrElse(0)

  /** A value in the file `release` of a JDK, or "". */
  def release(home: Path, key: String): String = {
    val lines = Try(Files.readString(home.resolve("release"))).getOrElse("").split("\r?\n")
    lines.find(_.startsWith(s"$key=")).fold("")(_.drop(key.length + 1).filter(_ != '"'))
  }

  private def jlink(home: Path): Option[Path] =
    Seq("jlink", "jlink.exe").map(home.resolve("bin").resolve(_)).find(Files.isRegularFile(_))

  /** Makes the runtime in a folder that does not exist yet. */
  def make(home: Path, to: Path): Unit = {
    val command = Seq(
      jlink(home).get.toString,
      "--add-modules",
      modules.mkString(","),
      "--no-header-files",
      "--no-man-pages",
      "--strip-java-debug-attributes",
      "--output",
      to.toString
    )
    val builder = new ProcessBuilder(command: _*).redirectErrorStream(true)
    val process = builder.start()
    val said = new String(process.getInputStream.readAllBytes())
    if (process.waitFor() != 0) sys.error(s"jlink of $home failed: $said")
  }
}
