package candela.cli.guide

import candela.cli.Main
import candela.cli.options.{CommandTable, PbrtOptions}
import candela.testing.TempFolder

import java.io.{ByteArrayOutputStream, PrintStream}
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** What docs/guide tells its readers to do works. */
class GuideSuite extends AnyFunSuite:
  private val pages = GuidePage.all
  private val chapters = pages.filter(_.name != "README.md")

  private def run(room: GuideRoom, command: String): Unit =
    val (out, err) = (ByteArrayOutputStream(), ByteArrayOutputStream())
    val code = Main.run(room.arguments(command), PrintStream(out, true), PrintStream(err, true))
    assert(code == 0, s"$command\n$out$err"): Unit

  for page <- chapters do
    test(s"${page.name}: its commands succeed, in their order, and write what they say"):
      TempFolder.use: folder =>
        val room = GuideRoom(folder, pages, small = true)
        for block <- page.blocks if block.language == "sh" do
          block.comment match
            case s"not run: $reason" =>
              info(s"skipped, line ${block.line}: $reason")
              reason match
                case s"$_; $to is a copy of $from" => room.copy(from, to)
                case _ => ()
            case _ =>
              for command <- block.commands do
                assert(command.startsWith("candela "), s"${page.name}:${block.line}")
                run(room, command)
                val words = room.arguments(command)
                val outputs = words.zip(words.drop(1)).collect { case ("--outfile", o) => o }
                for file <- outputs.flatMap(_.split(",")) if !file.contains("%") do
                  assert(Files.exists(folder.resolve(file)), command)

  test("every picture has the command that makes it, and is small"):
    for page <- pages do
      val shown = "!\\[[^\\]]*\\]\\(([^)]*)\\)".r.findAllMatchIn(page.text).map(_.group(1)).toSet
      assert(shown == page.pictures.map(_(0)).toSet, page.name)
      for file <- shown do assert(Files.size(GuidePage.Folder.resolve(file)) <= 60_000, file)

  test("chapters have at most 900 words, numbers, and a place in the index"):
    val index = pages.find(_.name == "README.md").get
    for (page, i) <- chapters.zipWithIndex do
      assert(page.words <= 900, s"${page.name}: ${page.words}")
      assert(page.name.startsWith(f"${i + 1}%02d-") && index.text.contains(s"](${page.name})"))
      assert(page.text.startsWith(s"# ${i + 1}. "), page.name)

  test("options in the text are the program's, or pbrt's"):
    val known = (CommandTable.rows.flatMap(_.names) ++ PbrtOptions.all.map(_.name)).toSet
    for page <- pages do
      val named = "`--([a-z][a-z-]*)".r.findAllMatchIn(page.text).map(_.group(1)).toSet
      assert(named.subsetOf(known), page.name)
