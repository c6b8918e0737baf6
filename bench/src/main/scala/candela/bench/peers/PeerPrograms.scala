package candela.bench.peers

import candela.io.WholeFile
import candela.bench.suite.{Absent, Commands, Edit, Installed, Present, Program}

import java.nio.file.Path

import scala.util.Using

/** The other renderers of this machine, as programs of suites.
  *
  * @param environment variables that name programs
  * @param folder receives the scripts for Cycles and LuxCore
  */
final class PeerPrograms(environment: Map[String, String], folder: Path):
  private val installed = Installed(environment)

  /** All that are installed, Candela first, and the others. */
  def detect: (Vector[Program], Vector[Absent]) =
    val peers = Vector(pbrt4, pbrt3, pbrt2, mitsuba, mitsubaLlvm, cycles, luxCore).flatten
    val present = peers.collect { case Right(p) => p }
    val needed = present.flatMap(_.counterpart).toSet
    val selfPrograms = plain +: Vector(rgb).filter(p => needed(p.name))
    (selfPrograms ++ present, peers.collect { case Left(a) => a })

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
    program("candela", "Candela", Vector(Commands.Self) ++ arguments :+ "--quiet", "v4", 0, None)

  private def rgb: Program = plain.copy(
    name = "candela-rgb",
    title = "Candela, RGB",
    kinds = Vector(PeerScenes.Rgb),
    isThin = true
  )

  private type Peer = Option[Either[Absent, Program]]

  private def pbrt4: Peer = pbrt(4): words =>
    val command = words ++ Vector("--quiet", "--nthreads", "{threads}", "--spp", "{spp}", "--seed",
      "{seed}", "--outfile", "{out}", "{scene}")
    program("pbrt-v4", "pbrt-v4", command, "v4", 1, Some("candela"))

  /** Takes neither samples nor seeds from its command line. */
  private def pbrt3: Peer = pbrt(3): words =>
    val command =
      words ++ Vector("--quiet", "--nthreads", "{threads}", "--outfile", "{out}", "{scene}")
    unseeded(program("pbrt-v3", "pbrt-v3", command, "v3", 3, Some("candela-rgb")))

  private def pbrt2: Peer = pbrt(2): words =>
    val command =
      words ++ Vector("--quiet", "--ncores", "{threads}", "--outfile", "{out}", "{scene}")
    unseeded(program("pbrt-v2", "pbrt-v2", command, "v2", 7, Some("candela-rgb")))

  private def unseeded(p: Program): Program =
    val samples = Edit(
      "\"integer (pixelsamples)\" *\\[? *\\d+ *\\]?".r,
      "\"integer $1\" {spp}"
    )
    p.copy(isSeeded = false, edits = Vector(samples))

  private def pbrt(version: Int)(create: Vector[String] => Program): Peer =
    Some(installed.pbrt(version).map(present =>
      create(present.words).copy(needs = present.variable.toVector)
    ))

  private def mitsuba: Peer =
    Some(installed.mitsuba.map(mitsubaOf(_, "scalar_rgb", "mitsuba", 5)))

  private def mitsubaLlvm: Peer =
    installed.mitsubaLlvm.map(present =>
      Right(mitsubaOf(present, "llvm_ad_rgb", "mitsuba-llvm", 6))
    )

  private def mitsubaOf(present: Present, variant: String, name: String, color: Int): Program =
    val command = present.words ++ Vector("-m", variant, "-t", "{threads}", "-D", "spp={spp}", "-D",
      "seed={seed}", "-o", "{out}", "{scene}")
    program(name, s"Mitsuba 3, $variant", command, PeerScenes.Exchange, color, Some("candela-rgb"))
      .copy(
        threads = Installed.mitsubaThreads(threads),
        ownFamily = Some("mitsuba"),
        needs = present.variable.toVector
      )

  private def cycles: Peer = Some(script("cycles", "Cycles", "bpy", 4))
  private def luxCore: Peer = Some(script("luxcore", "LuxCore", "pyluxcore", 8))

  private def script(name: String, title: String, library: String, color: Int) =
    installed.library(title, library, "numpy").toLeft:
      for file <- Vector("exchange.py", s"render_$name.py") do
        WholeFile.write(folder.resolve(file), PeerResources.bytes(file))
      val renders = folder.resolve(s"render_$name.py").toString
      val command = Vector(installed.python, renders) ++ arguments
      // Reports show the variable instead of its value
      program(name, title, command, PeerScenes.Exchange, color, Some("candela-rgb")).copy(
        needs = Vector(Installed.Python).filter(environment.contains),
        ownFamily = Some(name)
      )

/** Files of this package's resources. */
private[peers] object PeerResources:
  def bytes(name: String): Array[Byte] =
    Using.resource(getClass.getResourceAsStream(s"/candela/bench/peers/$name"))(_.readAllBytes)
