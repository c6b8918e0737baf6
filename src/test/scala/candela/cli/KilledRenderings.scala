package candela.cli

import candela.testing.TempFolder

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*
import scala.util.{Random, Try}

/** Kills renderings at random moments, resumes them, and compares the images with those of
  * renderings that were not disturbed.
  *
  * Usage: `./sbt "Test/runMain candela.cli.KilledRenderings --kills 50"`; more in CONTRIBUTING.md.
  */
object KilledRenderings:

  def main(args: Array[String]): Unit =
    val options = args.grouped(2).collect { case Array(key, value) => key -> value }.toMap
    val kills = options.get("--kills").fold(50)(_.toInt)
    val seed = options.get("--seed").fold(1)(_.toInt)
    val each = Math.max(1, kills / integrators.size)
    val only = options.get("--method")
    for (integrator, i) <- integrators.zipWithIndex if only.forall(integrator.contains) do
      val count = if i == 0 then kills - each * (integrators.size - 1) else each
      TempFolder.use: folder =>
        val result = run(folder, integrator, count, Random(seed + i), samples = 2000 * (count + 3))
        println(s"$integrator: $result")
        if !result.isSame then sys.exit(1)

  val integrators: Vector[String] = Vector(
    "\"path\" \"integer maxdepth\" 3",
    "\"bdpt\" \"integer maxdepth\" 3",
    "\"mlt\" \"integer maxdepth\" 3 \"integer bootstrapsamples\" 500",
    "\"sppm\" \"integer maxdepth\" 3 \"float radius\" 0.3"
  )

  /** @param kills of renderings that were still running
    * @param early kills before there was a checkpoint
    * @param torn  kills that left an unfinished copy behind
    */
  final case class Result(isSame: Boolean, kills: Int, early: Int, torn: Int)

  def run(folder: Path, integrator: String, kills: Int, random: Random, samples: Int): Result =
    val scene = folder.resolve("s.pbrt")
    val _ = Files.writeString(scene, FilmFilesSuite.text(integrator, "independent"))
    val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\" \"float radius\" 3\n")
    val (film, whole, image) =
      (folder.resolve("a.film"), folder.resolve("b.exr"), folder.resolve("a.exr"))
    val render = Vector("s.pbrt", "--spp", samples.toString)
    finished(candela(folder, render ++ Vector("--outfile", "b.exr")))
    val every = Vector("--checkpoint-every", "0.05s", "--quiet")
    val first = render ++ Vector("--outfile", "a.exr", "--checkpoint", "a.film") ++ every
    var killed, early, torn = 0
    for _ <- 0 until kills do
      val exists = Files.exists(film)
      val before = stamp(film)
      val process = candela(folder, if exists then Vector("resume", "a.film") ++ every else first)
      // Some die while they start; the others when they have written something, or soon after
      if random.nextInt(8) == 0 then Thread.sleep(random.nextInt(600))
      else
        while process.isAlive && stamp(film) == before do Thread.sleep(1)
        Thread.sleep(random.nextInt(300))
      if process.isAlive then killed += 1
      process.destroyForcibly().waitFor()
      if !Files.exists(film) then early += 1
      if TempFolder.names(folder).exists(_.endsWith(".tmp")) then torn += 1
    finished(candela(folder, if Files.exists(film) then Vector("resume", "a.film") else first))
    val isSame = Files.readAllBytes(image).sameElements(Files.readAllBytes(whole))
    Result(isSame, killed, early, torn)

  private def stamp(file: Path): Option[Any] =
    Try(Files.getLastModifiedTime(file)).toOption

  private def finished(process: Process): Unit =
    val err = String(process.getErrorStream.readAllBytes())
    if !process.waitFor(300, TimeUnit.SECONDS) || process.exitValue != 0 then
      throw IllegalStateException(s"exit code ${process.exitValue}: $err")

  /** The program, in a process of its own. */
  def candela(folder: Path, words: Vector[String]): Process =
    ProcessBuilder(command(words).asJava).directory(folder.toFile).start()

  /** What starts the program. */
  def command(words: Vector[String]): Vector[String] =
    val java = ProcessHandle.current.info.command.orElse("java")
    val classes = System.getProperty("java.class.path")
    Vector(java, "-XX:TieredStopAtLevel=1", "-cp", classes, "candela.cli.Main") ++ words
