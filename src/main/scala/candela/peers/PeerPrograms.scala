package candela.peers

import candela.base.WholeFile
import candela.suite.{Edit, Program}

import java.io.File
import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.util.Using

/** A renderer that may be installed.
  *
  * @param obtain where to get it
  */
final case class Absent(title: String, obtain: String)

/** Finds other renderers on this machine.
  *
  * @param environment variables that name programs
  * @param folder receives the scripts for Cycles and LuxCore
  */
final class PeerPrograms(environment: Map[String, String], folder: Path):
  import PeerPrograms.*

  /** All that are installed, Candela first, and the others. */
  def found: (Vector[Program], Vector[Absent]) =
    val peers = Vector(pbrt4, pbrt3, pbrt2, mitsuba, mitsubaLlvm, cycles, luxCore).flatten
    val present = peers.collect { case Right(p) => p }
    val needed = present.flatMap(_.counterpart).toSet
    val own = plain +: Vector(rgb).filter(p => needed(p.name))
    (own ++ present, peers.collect { case Left(a) => a })

  private val threads = Runtime.getRuntime.availableProcessors

  private def program(
      name: String,
      title: String,
      command: Vector[String],
      format: String,
      color: Int,
      counterpart: Option[String]
  ): Program =
    Program(
      name,
      title,
      command,
      Vector(format),
      threads,
      Vector.empty,
      isSeeded = true,
      color,
      isThin = false,
      counterpart = counterpart
    )

  private val arguments =
    Vector("{scene}", "--spp", "{spp}", "--seed", "{seed}", "--nthreads", "{threads}", "--outfile",
      "{out}")

  private def plain: Program =
    program("candela", "Candela", Vector("{candela}") ++ arguments :+ "--quiet", "v4", 0, None)

  private def rgb: Program = plain.copy(
    name = "candela-rgb",
    title = "Candela, RGB",
    kinds = Vector(PeerScenes.Rgb),
    isThin = true
  )

  private type Peer = Option[Either[Absent, Program]]

  private def pbrt4: Peer = pbrt(4): word =>
    val command = Vector(word, "--quiet", "--nthreads", "{threads}", "--spp", "{spp}", "--seed",
      "{seed}", "--outfile", "{out}", "{scene}")
    program("pbrt-v4", "pbrt-v4", command, "v4", 1, Some("candela"))

  /** Takes neither samples nor seeds from its command line. */
  private def pbrt3: Peer = pbrt(3): word =>
    val command =
      Vector(word, "--quiet", "--nthreads", "{threads}", "--outfile", "{out}", "{scene}")
    unseeded(program("pbrt-v3", "pbrt-v3", command, "v3", 3, Some("candela-rgb")))

  private def pbrt2: Peer = pbrt(2): word =>
    val command = Vector(word, "--quiet", "--ncores", "{threads}", "--outfile", "{out}", "{scene}")
    unseeded(program("pbrt-v2", "pbrt-v2", command, "v2", 7, Some("candela-rgb")))

  private def unseeded(p: Program): Program =
    val samples = Edit(
      "\"integer (pixelsamples)\" *\\[? *\\d+ *\\]?".r,
      "\"integer $1\" {spp}"
    )
    p.copy(isSeeded = false, edits = Vector(samples))

  private def pbrt(version: Int)(make: String => Program): Peer =
    val variable = s"PBRT_V$version"
    val word = environment.get(variable).orElse:
      Vector(s"pbrt-v$version", s"pbrt$version").flatMap(onPath).headOption
        .orElse(onPath("pbrt").filter(isVersion(_, version)))
    val where = s"build it from github.com/mmp/pbrt-v$version and set $variable to its program"
    Some(word.map(make(_).copy(needs = named(variable))).toRight(Absent(s"pbrt-v$version", where)))

  /** By the options that its help names. */
  private def isVersion(word: String, version: Int): Boolean =
    val help = output(Vector(word, "--help"))
    val found =
      if help.contains("--debugstart") then 4 else if help.contains("--ncores") then 2 else 3
    help.contains("pbrt") && found == version

  private def mitsuba: Peer =
    val word = environment.get("MITSUBA").orElse(onPath("mitsuba"))
      .orElse(beside(python, "mitsuba"))
    val where = "`pip install mitsuba`; or set MITSUBA to its program"
    Some(word.map(mitsubaOf(_, "scalar_rgb", "mitsuba", 5, "MITSUBA"))
      .toRight(Absent("Mitsuba 3", where)))

  /** Where its LLVM backend is said to work. */
  private def mitsubaLlvm: Peer = environment.get("MITSUBA_LLVM").map: word =>
    Right(mitsubaOf(word, "llvm_ad_rgb", "mitsuba-llvm", 6, "MITSUBA_LLVM"))

  private def mitsubaOf(
      word: String,
      variant: String,
      name: String,
      color: Int,
      variable: String
  ): Program =
    val command = Vector(word, "-m", variant, "-t", "{threads}", "-D", "spp={spp}", "-D",
      "seed={seed}", "-o", "{out}", "{scene}")
    program(name, s"Mitsuba 3, $variant", command, PeerScenes.Exchange, color, Some("candela-rgb"))
      // One thread more than processors: with as many or fewer, 3.9.1 hangs at its image
      .copy(threads = threads + 1, ownFamily = Some("mitsuba"), needs = named(variable))

  private def cycles: Peer = Some(script("cycles", "Cycles", "bpy", 4))
  private def luxCore: Peer = Some(script("luxcore", "LuxCore", "pyluxcore", 8))

  private val python: String =
    environment.get(Python).orElse(onPath("python3")).getOrElse("python3")

  /** Packages that Python has; that it has NumPy is a condition of both. */
  private lazy val packages: Set[String] =
    val asked = Vector("numpy", "bpy", "pyluxcore")
    val code =
      s"import importlib.util as u; print([x for x in ${asked.mkString("['", "', '", "']")} " +
        "if u.find_spec(x)])"
    val told = output(Vector(python, "-c", code))
    asked.filter(x => told.contains(s"'$x'")).toSet

  private def script(name: String, title: String, library: String, color: Int) =
    if packages(library) && packages("numpy") then
      for file <- Vector("exchange.py", s"render_$name.py") do
        WholeFile.write(folder.resolve(file), PeerResources.bytes(file))
      val command = Vector(python, folder.resolve(s"render_$name.py").toString) ++ arguments
      Right(program(name, title, command, PeerScenes.Exchange, color, Some("candela-rgb"))
        .copy(needs = named(Python), ownFamily = Some(name)))
    else
      val where = s"`pip install $library numpy`, for the Python that $Python names or `python3`"
      Left(Absent(title, where))

  /** Only of variables that are set; reports show the variable instead of its value. */
  private def named(variable: String) = Vector(variable).filter(environment.contains)

  private def onPath(name: String): Option[String] =
    environment.getOrElse("PATH", "").split(File.pathSeparatorChar).toVector.filter(_.nonEmpty)
      .map(Path.of(_).resolve(name)).find(Files.isExecutable(_)).map(_.toString)

  private def beside(program: String, name: String): Option[String] =
    val there = if program.contains('/') then Some(program) else onPath(program)
    there.map(Path.of(_).resolveSibling(name)).filter(Files.isExecutable(_)).map(_.toString)

object PeerPrograms:
  /** The variable that names the Python of Cycles and LuxCore. */
  val Python = "CANDELA_PYTHON"

  /** What a program prints; nothing if it can't be started. */
  private def output(words: Vector[String]): String =
    import scala.jdk.CollectionConverters.*
    try
      val log = Files.createTempFile("candela", ".txt")
      try
        val process = ProcessBuilder(words.asJava).redirectErrorStream(true)
          .redirectOutput(log.toFile).start()
        process.getOutputStream.close()
        if !process.waitFor(Patience, TimeUnit.SECONDS) then
          process.destroyForcibly().waitFor(): Unit
        String(Files.readAllBytes(log), "UTF-8")
      finally Files.deleteIfExists(log): Unit
    catch case _: java.io.IOException => ""

  private val Patience = 20L

/** Files of this package's resources. */
private[peers] object PeerResources:
  def bytes(name: String): Array[Byte] =
    Using.resource(getClass.getResourceAsStream(s"/candela/peers/$name"))(_.readAllBytes)
