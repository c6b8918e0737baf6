package candela.fuzz

import java.nio.file.{Files, Path}
import scala.util.Random

import candela.cli.Captured
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

/** A command that writes a file, of which there are two versions.
  *
  * @param words of a version
  */
private[fuzz] final case class Job(file: Path, words: Int => Vector[String]):
  /** Both versions, as they are without disturbance. */
  val versions: Vector[Array[Byte]] = Vector(1, 2).map: i =>
    val (code, captured) = Captured.run(words(i)*)
    require(code == 0, captured.err)
    Files.readAllBytes(file)

  /** What is wrong with the file, if it is: it is neither as it was, nor the new version. */
  def broken(before: Option[Array[Byte]]): Option[String] =
    val now = Option.when(Files.exists(file))(Files.readAllBytes(file))
    def is(other: Option[Array[Byte]]) = now.map(_.toVector) == other.map(_.toVector)
    Option.unless(is(before) || is(Some(versions(1)))):
      s"`$file` is broken: ${now.fold("missing")(n => s"${n.length} bytes")}"

  /** What is wrong when the command is run again, undisturbed. */
  def next(): Option[String] =
    val (code, captured) = Captured.run(words(2)*)
    val left = TempFolder.names(file.getParent).filter(_.startsWith(".candela-"))
    if code != 0 then Some(s"the next run fails: ${captured.err}")
    else if left.nonEmpty then Some(s"the next run leaves ${left.mkString(", ")}")
    else
      Option.unless(Files.readAllBytes(file).sameElements(versions(1))):
        "the next run writes another file"

private[fuzz] object Job:

  /** Commands that write each kind of file.
    *
    * @param inputs folder of what they read
    * @param output folder of what they write
    */
  def all(inputs: Path, output: Path): Vector[Job] =
    val _ = Files.createDirectories(inputs)
    val _ = Files.createDirectories(output)
    def input(name: String) = inputs.resolve(name).toString
    def job(name: String)(words: Int => Vector[String]) =
      val file = output.resolve(name)
      Job(file, i => words(i) ++ Vector("--outfile", file.toString))
    for i <- 1 to 2 do
      val random = Random(i)
      val data = Array.fill(64 * 64 * 3)(random.nextFloat())
      ImageFiles.write(inputs.resolve(s"$i.exr"), Image(64, 64, Image.RgbNames, data))
      val points = Vector.fill(3000)(random.nextFloat()).mkString(" ")
      val mesh = s"Shape \"trianglemesh\" \"point3 P\" [ $points ] \"integer indices\" [ 0 1 2 ]"
      val _ = Files.writeString(inputs.resolve(s"$i.pbrt"), SmallScene.v4("path", mesh))
      val film = Vector(input(s"$i.pbrt"), "--quiet", "--aov", "albedo,normal,variance")
      require(Captured.run(film ++ Vector("--outfile", input(s"$i.film"))*)._1 == 0)
    Vector(
      job("o.exr")(i => Vector(input("1.pbrt"), "--seed", s"$i")),
      job("o.png")(i => Vector("view", input(s"$i.exr"))),
      job("i.exr")(i => Vector("image", input(s"$i.exr"))),
      job("i.pfm")(i => Vector("image", input(s"$i.exr"))),
      job("c.pbrt")(i => Vector("convert", input(s"$i.pbrt"))),
      job("m.film")(i => Vector("merge", input(s"$i.film"))),
      job("m.exr")(i => Vector("merge", input(s"$i.film"))),
      job("d.md")(_ => Vector("describe", "--markdown"))
    )
