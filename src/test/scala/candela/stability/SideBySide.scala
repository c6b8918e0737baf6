package candela.stability

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import candela.build.SceneBuilder
import candela.convert.{Converter, SceneText}
import candela.image.{Image, ImageError, ImageFiles}
import candela.render.Renderer
import candela.scenefile.{Dialect, Parser}
import candela.settings.RenderSettings

/** A program that renders a scene.
  *
  * @param render into the folder; Left: why there is no picture
  */
final class Renders(val title: String)(val render: (String, Path) => Either[String, Image])

/** Renders the scenes of `docs/stability` with Candela and with the programs that the variables
  * `PBRT_V3`, `PBRT_V4` and `MITSUBA` name, and writes the table and the pictures of
  * `docs/STABILITY.md`: `./sbt "Test/runMain candela.stability.SideBySide"`. With words behind it
  * only the lines and pictures of those scenes whose names contain one of them.
  */
object SideBySide:
  private val Page = Path.of("docs", "STABILITY.md")
  private val (begin, end) = ("<!-- side by side: begin -->", "<!-- side by side: end -->")
  private val threads = Runtime.getRuntime.availableProcessors
  private val Minutes = 5L

  def main(arguments: Array[String]): Unit =
    val folder = Files.createTempDirectory("candela-stability")
    val programs = Seq(candela, pbrt3, pbrt4, mitsuba)
    val rows =
      HardScenes.all.filter(s => arguments.isEmpty || arguments.exists(s.name.contains)).map:
        scene =>
          val row = SideBySideRow(scene, programs, folder)
          println(row.line)
          row
    rows.foreach(_.writePicture())
    val text = Files.readString(Page)
    val made =
      if arguments.isEmpty then
        val (before, after) = (text.indexOf(begin) + begin.length, text.indexOf(end))
        text.take(before) + section(programs, rows) + text.drop(after)
      else
        rows.foldLeft(text): (page, row) =>
          page.linesIterator.map(row.inPlaceOf).mkString("", "\n", "\n")
    val _ = Files.writeString(Page, made)

  private def section(programs: Seq[Renders], rows: Seq[SideBySideRow]): String =
    val titles = "scene" +: "expected" +: programs.map(_.title)
    val head = Seq(titles.mkString("| ", " | ", " |"), "|---" * titles.size + "|")
    val off = rows.filter(_.hasPicture)
    val pictures = off.flatMap: row =>
      Seq(
        "",
        s"![${row.scene.name}](stability/${row.scene.name}.png)",
        "",
        s"`${row.scene.name}`: ${row.scene.words}"
      )
    val legend = "Where they differ, " + programs.map(_.title).mkString(", ") +
      " from left to right; below, what is brighter than expected is red, what is darker blue, " +
      "in full from a half on. An empty place: no picture."
    val lines = Seq("", "") ++ head ++ rows.map(_.line) ++ Seq("", legend) ++ pictures
    lines.mkString("", "\n", "\n\n")

  private def candela = Renders("Candela"): (name, _) =>
    val scene = Parser.parse(HardScenes.Folder.resolve(s"$name.pbrt"), Some(Dialect.V3))
    val (plan, _) = SceneBuilder.build(scene, RenderSettings())
    Right(Renderer.render(plan, threads).image(plan.development))

  private def pbrt3 = program("pbrt-v3", "PBRT_V3"): (command, name, folder, out) =>
    val file = HardScenes.Folder.resolve(s"$name.pbrt")
    Some(command ++ Seq(
      "--quiet",
      s"--nthreads=$threads",
      s"--logdir=$folder",
      s"--outfile=$out",
      s"$file"
    ))

  private def pbrt4 = program("pbrt-v4", "PBRT_V4"): (command, name, folder, out) =>
    val source = HardScenes.Folder.resolve(s"$name.pbrt").toAbsolutePath
    val scene = Parser.parse(source, Some(Dialect.V3))
    val file = folder.resolve("v4.pbrt")
    val writer = Files.newBufferedWriter(file)
    try SceneText.write(Converter.convert(scene, Dialect.V4, folder).scene, writer)
    finally writer.close()
    Some(command ++ Seq("--quiet", "--nthreads", s"$threads", "--outfile", s"$out", s"$file"))

  /** With one thread more than processors: with as many or fewer, 3.9.1 hangs when it writes. */
  private def mitsuba = program("Mitsuba 3", "MITSUBA"): (command, name, _, out) =>
    val file = HardScenes.Folder.resolve(s"$name.xml")
    Option.when(Files.exists(file)):
      command ++
        Seq("-m", "scalar_rgb", "-t", s"${threads + 1}", "-o", s"$out", s"$file")

  private def program(title: String, variable: String)(
      command: (Seq[String], String, Path, Path) => Option[Seq[String]]
  ): Renders = Renders(title): (name, folder) =>
    Option(System.getenv(variable)).filter(_.nonEmpty) match
      case None => Left("not run")
      case Some(words) =>
        val out = folder.resolve(s"$title.exr".replace(' ', '-'))
        val _ = Files.deleteIfExists(out)
        command(words.split(' ').toSeq, name, folder, out).fold(Left("has no such shape")):
          run(_, folder, out)

  private def run(command: Seq[String], folder: Path, out: Path): Either[String, Image] =
    val log = folder.resolve("log.txt").toFile
    val process =
      ProcessBuilder(command*).redirectErrorStream(true).redirectOutput(log).start()
    if !process.waitFor(Minutes, TimeUnit.MINUTES) then
      process.destroyForcibly().waitFor()
      Left("**hangs**")
    else if process.exitValue != 0 then Left(s"**crash** (exit code ${process.exitValue})")
    else
      try Right(ImageFiles.read(out))
      catch case e: ImageError => Left(s"**no picture** (${e.getMessage})")
