package candela.cli

import candela.diagnostics.{Code, ProblemExample, ProblemGuide}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite

/** The numbers of problems, and what explains them. */
class ProblemGuideSuite extends AnyFunSuite:

  test("each problem has its own number and an entry with title, meaning and cure"):
    assert(Code.values.map(_.number).distinct.length == Code.values.length)
    for e <- ProblemGuide.all do
      assert(e.title.nonEmpty && e.meaning.nonEmpty && e.cure.nonEmpty, e.code)
      for text <- Vector(e.meaning, e.cure) do assert(text.endsWith("."), e.code)

  test("docs/PROBLEMS.md is what the entries say"):
    val help = "./sbt \"run describe --problems --outfile docs/PROBLEMS.md\""
    val (code, said) = Captured.run("describe", "--problems")
    assert(code == 0)
    assert(Files.readString(Path.of("docs/PROBLEMS.md")) == said.out, help)

  test("each number is given by some message"):
    val folders = Vector("src/core/scala", "src/main/scala", "bench/src/main/scala")
    val sources = folders.flatMap: folder =>
      Using.resource(Files.walk(Path.of(folder))): all =>
        all.iterator.asScala.filter(_.toString.endsWith(".scala")).map(Files.readString).toVector
    val used = sources.flatMap("\\bCode\\.(\\w+)".r.findAllMatchIn(_).map(_.group(1))).toSet
    assert(Code.values.map(_.toString).filterNot(used).isEmpty)

  for e <- ProblemGuide.all; example <- e.example do
    test(s"the example of ${e.code.word} has this problem: ${e.title}"):
      TempFolder.use: folder =>
        val words = example match
          case ProblemExample.Command(words) => words.split(' ').toVector
          case ProblemExample.Scene(text) =>
            val scene = Files.writeString(folder.resolve("scene.pbrt"), text + "\n")
            Vector("check", scene.toString)
        val (_, said) = Captured.run(words*)
        assert(said.err.contains(s"[${e.code.word}]"), said.err)

  test("explain prints the entry of a number, in any spelling"):
    val (code, said) = Captured.run("explain", "E0201")
    assert(code == 0)
    assert(said.out.startsWith("E0201: Unknown directive\n"))
    assert(said.out.contains("\n    Tranlate 0 0 5\n") && said.out.contains("\nCure: "))
    for word <- Vector("e0201", "201", "0201") do
      assert(Captured.run("explain", word)._2.out == said.out)

  test("explain without a number lists all, and an unknown number gets the nearest"):
    val all = Captured.run("explain")._2.out
    for c <- Code.values do assert(all.contains(c.word))
    val (code, said) = Captured.run("explain", "E0219")
    assert(code == 1 && said.err.contains("no problem is called `E0219`"))
    assert(said.err.contains("did you mean `E02"))
