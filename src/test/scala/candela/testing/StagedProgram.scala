package candela.testing

import java.nio.file.attribute.PosixFilePermissions
import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*

/** The launcher in a staged program of its own, with JDKs that only write down how they were
  * called; so tests are about the launcher alone, whatever is on the machine.
  *
  * @param folder for all of it
  * @param name   of the program's folder
  */
final class StagedProgram(folder: Path, name: String = "stage"):
  val launcher: Path = folder.resolve(name).resolve("bin").resolve("candela")
  val lib: Path = Files.createDirectories(folder.resolve(name).resolve("lib"))
  val home: Path = Files.createDirectories(folder.resolve("home"))

  /** Where the program's own Java runtime would be. */
  val runtime: Path = folder.resolve(name).resolve("runtime")
  private val calls = folder.resolve("calls")
  private val CallEnd = "= end of call ="

  Files.createDirectories(launcher.getParent)
  Files.copy(Path.of("src/universal/bin/candela"), launcher)
  Files.writeString(lib.resolve("candela.jar"), "jar")
  Files.writeString(lib.resolve("options"), "")
  Files.createDirectory(lib.resolve("start-up"))
  Files.writeString(lib.resolve("start-up").resolve("a.pbrt"), "")

  /** A JDK where people keep theirs; the real ones of this machine are older than 90. */
  def jdk(
      version: String,
      in: String = "home/.jdks",
      java: String = "",
      modules: String = "java.base"
  ): Path =
    val jdk = Files.createDirectories(folder.resolve(in).resolve(s"jdk $version"))
    val text = s"IMPLEMENTOR=\"X\"\nJAVA_VERSION=\"$version\"\nMODULES=\"$modules\"\n"
    val _ = Files.writeString(jdk.resolve("release"), text)
    val program = Files.createDirectories(jdk.resolve("bin")).resolve("java")
    val _ = Files.writeString(program, s"$record\n$java\n")
    val _ = Files.setPosixFilePermissions(program, PosixFilePermissions.fromString("rwx------"))
    jdk

  /** One word a line, and a line behind each call; what is asked for as archive gets made. */
  private def record: String =
    s"""#!/bin/sh
       |{ printf '%s\\n' "$$0" "$$@" "pid $$$$" "$CallEnd"; } >>"$calls"
       |for word; do case $$word in
       |  -XX:AOTCacheOutput=* | -XX:ArchiveClassesAtExit=*) echo classes >"$${word#*=}" ;;
       |esac; done""".stripMargin

  /** The words of each start of a Java until now. */
  def starts: Vector[Vector[String]] =
    if !Files.exists(calls) then Vector.empty
    else Files.readString(calls).split(s"$CallEnd\n").toVector.map(_.linesIterator.toVector)

  def archives(in: Path): Vector[Path] =
    if !Files.isDirectory(in) then Vector.empty
    else
      val files = Files.walk(in)
      try files.iterator.asScala.filter(_.toString.matches(".*\\.(aot|jsa)")).toVector
      finally files.close()

  final case class Ended(code: Int, out: String, err: String, pid: Long)

  def start(
      args: Seq[String] = Nil,
      env: Map[String, String] = Map("CANDELA_ARCHIVE" -> "none"),
      as: Path = launcher,
      without: Set[String] = Set.empty
  ): Process =
    val builder = ProcessBuilder((as.toString +: args).asJava)
    val variables = builder.environment
    for name <- Seq("CANDELA_JAVA", "JAVA_HOME", "JAVA_OPTS", "XDG_CACHE_HOME") do
      val _ = variables.remove(name)
    val _ = variables.put("HOME", home.toString)
    for (name, value) <- env do
      val _ = variables.put(name, value)
    for name <- without do
      val _ = variables.remove(name)
    builder.directory(folder.toFile).start()

  def ended(process: Process): Ended =
    val out = String(process.getInputStream.readAllBytes())
    val err = String(process.getErrorStream.readAllBytes())
    if !process.waitFor(60, TimeUnit.SECONDS) then throw IllegalStateException("it does not end")
    Ended(process.exitValue, out, err, process.pid)

  def run(
      args: Seq[String] = Nil,
      env: Map[String, String] = Map("CANDELA_ARCHIVE" -> "none"),
      as: Path = launcher,
      without: Set[String] = Set.empty
  ): Ended = ended(start(args, env, as, without))
