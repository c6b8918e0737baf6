package candela.cli.options

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*

import org.scalatest.funsuite.AnyFunSuite

/** Every option that the parser knows is explained to people. */
class OptionTableSuite extends AnyFunSuite:
  private val known: Set[(String, String)] =
    Command.values.toSet.flatMap(c => OptionTable.names(c.word).map(c.word -> _))

  test("the help of each command says what each of its options means"):
    val sections = Command.values.map: c =>
      c.word -> CommandLine.parse(Seq("help", c.word)).left.toOption.get.out
    .toMap
    for (command, option) <- known do
      // The meaning stands behind the option, or below if that is long
      val row = s"(?m)^  (-\\w, )?--$option( \\S+)? *\\n? {2,}(\\w.+)".r
      assert(row.findFirstIn(sections(command)).isDefined, s"candela $command --$option")

  private val page = Files.readAllLines(Path.of("README.md")).asScala.toVector

  /** Command and option of each row of README's table; a row without name goes on with the last. */
  private def told: Set[(String, String)] =
    val table = page.dropWhile(!_.startsWith("| option |")).drop(2).takeWhile(_.startsWith("|"))
    val cells = table.map(_.split("(?<!\\\\)\\|", -1).map(_.trim).toVector)
    val names = cells.map(_(1)).scanLeft("")((last, name) => if name.isEmpty then last else name)
    val pairs =
      for
        (row, name) <- cells.zip(names.tail)
        command <- row(2).split(", ") if command.nonEmpty
        option <- "--([a-z][a-z-]*)".r.findAllMatchIn(s"$name ${row(3)}").map(_.group(1))
      yield command -> option
    pairs.toSet

  test("README's table has every option, with the commands that know it"):
    assert((known -- told).isEmpty, "missing")
    assert((told -- known).isEmpty, "unknown to the program")

  test("the page of layers has every layer with its first channel"):
    val text = Files.readString(Path.of("docs/LAYERS.md"))
    for layer <- candela.layers.Layer.values do
      assert(text.contains(s"`${layer.word}`"), layer)
      val channel = layer.channelsOf(Vector("GROUP")).head
      assert(text.contains(s"`$channel`"), channel)
