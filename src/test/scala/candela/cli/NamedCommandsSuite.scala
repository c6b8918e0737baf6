package candela.cli

import candela.cli.options.CommandLine
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

/** The commands that messages and help texts tell users to run. */
class NamedCommandsSuite extends AnyFunSuite:

  private val folders =
    Vector(
      "src/core/scala",
      "src/core/resources/candela/problems",
      "src/main/scala",
      "bench/src/main/scala"
    )

  private def files(folder: String): Vector[Path] =
    Using.resource(Files.walk(Path.of(folder)))(_.iterator.asScala.toVector)
      .filter(Files.isRegularFile(_))

  /** Words for the placeholders of texts. */
  private val words = Map(
    "${now.samples}" -> "9",
    "IN" -> "in.pfm",
    "OUT" -> "out.exr",
    "FILE" -> "a.exr",
    "COMMAND" -> "render",
    "CATEGORY" -> "material",
    "TYPE" -> "plastic",
    "PARAMETER" -> "fov",
    "x0,x1,y0,y1" -> "0,9,0,9",
    "$pixels" -> "0,9,0,9",
    "MASTER" -> "local[2]",
    "n" -> "3"
  )

  private def commands: Vector[Vector[String]] =
    val named =
      for
        folder <- folders
        file <- files(folder)
        found <- "`candela ([^`\\n]*)`".r.findAllMatchIn(Files.readString(file)).map(_.group(1))
        if !found.contains("...") && !found.startsWith("$")
      yield found.split(' ').toVector.map: word =>
        words.getOrElse(word, if word.startsWith("$") then "a.film" else word.replace("x,y", "1,2"))
    named.distinct

  test("each is one that the program has, with its options"):
    assert(commands.size > 20)
    for command <- commands do
      val said = CommandLine.parse(command).left.toOption.map(_.err).getOrElse("")
      // What lacks files is a name, not a whole command
      val faults = said.linesIterator.filter(_.contains("error: ")).toVector
      val real = faults.filterNot(f => f.contains("[E0004]") || f.contains("[E0005]"))
      assert(real.isEmpty, command.mkString(" "))

  test("the conversion of an equirectangular image is run as it is written"):
    TempFolder.use: folder =>
      val written = commands.find(_.startsWith(Vector("image", "in.pfm"))).get
      ImageFiles.write(folder.resolve("in.pfm"), Image.rgb(8, 4))
      val placed = written.map(w => if w.contains('.') then s"$folder/$w" else w)
      val (code, said) = Captured.run(placed*)
      assert(code == 0, said.err)
      assert(ImageFiles.read(folder.resolve("out.exr")).height == 8)
