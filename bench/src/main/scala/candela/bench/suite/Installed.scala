package candela.bench.suite

import java.io.File
import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*

/** A renderer that is not there.
  *
  * @param obtain where to get it
  */
final case class Absent(title: String, obtain: String)

/** A renderer that is there, or is said to be.
  *
  * @param words    begin its command
  * @param variable that names it, if one does; reports show it instead of its value
  */
final case class Present(words: Vector[String], variable: Option[String])

/** The other renderers of this machine: named by environment variables, or found on the path.
  *
  * @param environment variables
  */
final class Installed(environment: Map[String, String]):
  import Installed.*

  /** `PBRT_V4` and so on, or a program of this name on the path, or `pbrt`, if its help is that of
    * this version.
    */
  def pbrt(version: Int): Either[Absent, Present] =
    val variable = s"PBRT_V$version"
    def sought = Vector(s"pbrt-v$version", s"pbrt$version").flatMap(onPath).headOption
      .orElse(onPath("pbrt").filter(isVersion(_, version)))
    val hint = s"build it from github.com/mmp/pbrt-v$version and set $variable to its program"
    named(variable).orElse(sought.map(present)).toRight(Absent(s"pbrt-v$version", hint))

  /** `MITSUBA`, or the program of this name on the path or beside Python. */
  def mitsuba: Either[Absent, Present] =
    def sought = onPath("mitsuba").orElse(beside(python, "mitsuba"))
    val hint = "`pip install mitsuba`; or set MITSUBA to its program"
    named("MITSUBA").orElse(sought.map(present)).toRight(Absent("Mitsuba 3", hint))

  /** Mitsuba again, where its LLVM backend is said to work. */
  def mitsubaLlvm: Option[Present] = named("MITSUBA_LLVM")

  /** The Python that renderers of PyPI are packages of. */
  lazy val python: String =
    environment.get(Python).orElse(onPath("python3")).getOrElse("python3")

  /** Nothing if Python has all these packages, else where to get them. */
  def library(title: String, packages: String*): Option[Absent] =
    Option.unless(packages.forall(hasPackage)):
      val names = packages.mkString(" ")
      val install = s"`pip install $names`, for the Python that $Python names or `python3`"
      val missing =
        if installedPackages.isEmpty then s"`$python` is not installed; after that, " else ""
      Absent(title, missing + install)

  private def hasPackage(name: String): Boolean = installedPackages.contains(s"'$name'")

  /** A list of the packages that Python has; empty if it can't be started. */
  private lazy val installedPackages: String =
    val listed = Packages.mkString("['", "', '", "']")
    output(Vector(
      python,
      "-c",
      s"import importlib.util as u; print([x for x in $listed if u.find_spec(x)])"
    ))

  private def present(word: String) = Present(Vector(word), None)

  private def named(variable: String): Option[Present] =
    environment.get(variable).map(_.trim).filter(_.nonEmpty).map: command =>
      Present(command.split("\\s+").toVector, Some(variable))

  /** By the options that its help names. */
  private def isVersion(word: String, version: Int): Boolean =
    val help = output(Vector(word, "--help"))
    val detected =
      if help.contains("--debugstart") then 4 else if help.contains("--ncores") then 2 else 3
    help.contains("pbrt") && detected == version

  private def onPath(name: String): Option[String] =
    environment.getOrElse("PATH", "").split(File.pathSeparatorChar).toVector.filter(_.nonEmpty)
      .map(Path.of(_).resolve(name)).find(Files.isExecutable(_)).map(_.toString)

  private def beside(program: String, name: String): Option[String] =
    val executable = if program.contains('/') then Some(program) else onPath(program)
    executable.map(Path.of(_).resolveSibling(name)).filter(Files.isExecutable(_)).map(_.toString)

object Installed:
  /** The variable that names a Python. */
  val Python = "CANDELA_PYTHON"

  /** Mitsuba's threads, where there are so many processors: with as many or fewer, 3.9.1 hangs when
    * it writes its image.
    */
  def mitsubaThreads(processors: Int): Int = processors + 1

  /** What is asked for in Python. */
  private val Packages = Vector("numpy", "bpy", "pyluxcore", "embreex")

  /** What a program prints; nothing if it can't be started. */
  private def output(words: Vector[String]): String =
    try
      val log = Files.createTempFile("candela", ".txt")
      try
        val process = ProcessBuilder(words.asJava).redirectErrorStream(true)
          .redirectOutput(log.toFile).start()
        process.getOutputStream.close()
        if !process.waitFor(TimeoutSeconds, TimeUnit.SECONDS) then
          process.destroyForcibly().waitFor(): Unit
        String(Files.readAllBytes(log), "UTF-8")
      finally Files.deleteIfExists(log): Unit
    catch case _: java.io.IOException => ""

  /** In seconds. */
  private val TimeoutSeconds = 20L
