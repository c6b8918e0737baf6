package candela.cli.options

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** Every option that the parser knows is explained to people. */
class OptionTableSuite extends AnyFunSuite:
  private val known: Set[(String, String)] =
    Command.values.toSet.flatMap(c => CommandTable.of(c).names.map(c.word -> _))

  test("the help of each command says what each of its options means"):
    val sections = Command.values.map: c =>
      c.word -> CommandLine.parse(Seq("help", c.word)).left.toOption.get.out
    .toMap
    for (command, option) <- known do
      // The meaning stands behind the option, or below if that is long
      val row = s"(?m)^  (-\\w, )?--$option( \\S+)? *\\n? {2,}(\\w.+)".r
      assert(row.findFirstIn(sections(command)).isDefined, s"candela $command --$option")

  test("the page of layers has every layer with its first channel"):
    val text = Files.readString(Path.of("docs/LAYERS.md"))
    for layer <- candela.aov.Layer.values do
      assert(text.contains(s"`${layer.word}`"), layer)
      val channel = layer.channelsOf(Vector("GROUP")).head
      assert(text.contains(s"`$channel`"), channel)
