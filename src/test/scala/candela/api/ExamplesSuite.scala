package candela.api

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import java.net.URLClassLoader
import java.nio.file.{Files, Path}
import javax.tools.ToolProvider

import scala.jdk.CollectionConverters.*
import scala.util.Using

class ExamplesSuite extends AnyFunSuite:
  private val scalaFile = Path.of("examples/scala/src/main/scala/ScalaExample.scala")
  private val scalaText = Files.readString(scalaFile)
  private val javaFile = Path.of("examples/java/src/main/java/JavaExample.java")
  private val kotlinText = Files.readString(Path.of("examples/kotlin/src/main/kotlin/Example.kt"))
  private val scene = "examples/scene.pbrt"

  /** Without indentation, empty lines, and the names of files. */
  private def plain(code: String): String =
    code.linesIterator.map(_.trim.stripPrefix("* ").trim).filter(_.nonEmpty)
      .map(_.replaceAll(raw"Path\.of\([^)]*\)", "Path.of(FILE)")).mkString("\n")

  private def blocks(text: String, begin: String, end: String): Vector[String] =
    text.split(java.util.regex.Pattern.quote(begin), -1).toVector.drop(1).map: rest =>
      rest.take(rest.indexOf(end))

  test("every example of the documentation is one that is compiled"):
    val page = Files.readString(Path.of("docs/LIBRARY.md"))
    val own = Files.readString(Path.of("src/test/scala/candela/api/DocumentedExamples.scala"))
    val sources = Using.resource(Files.list(Path.of("src/core/scala/candela/api"))): files =>
      files.iterator.asScala.toVector.sorted.map(Files.readString)
    val inComments = sources.flatMap(blocks(_, "{{{\n", "}}}"))
    val inScala = blocks(page, "```scala\n", "```")
    assert(inComments.size >= 3 && inScala.size >= 4)
    for block <- inComments ++ inScala do
      assert(plain(own + scalaText).contains(plain(block).stripSuffix("*").trim), block)
    for
      (language, source) <- Vector("java" -> Files.readString(javaFile), "kotlin" -> kotlinText)
      found = blocks(page, s"```$language\n", "```")
      block <- found
    do assert(found.nonEmpty && plain(source).contains(plain(block)), block)

  test("the examples of the documentation run"):
    TempFolder.use: folder =>
      val image = folder.resolve("image.exr").toString
      DocumentedExamples.shortest(scene, image)
      val once = Files.readAllBytes(Path.of(image)).toVector
      DocumentedExamples.first(scene, image)
      assert(Files.readAllBytes(Path.of(image)).toVector == once)
      val built = DocumentedExamples.built
      assert(!built.hasErrors && !DocumentedExamples.changed(built).hasErrors)
      val film = folder.resolve("image.film")
      val few = built.edit().change(SceneSetting.Film, Parameters().integer("xresolution", 8))
        .change(SceneSetting.Film, Parameters().integer("yresolution", 8)).scene()
      assert(DocumentedExamples.goal(few, film).isComplete && Files.exists(film))
      Using.resource(few.prepare(RenderSettings(samples = 4))): job =>
        assert(DocumentedExamples.cancelled(job).isComplete)

  test("the examples in Scala and in Java have the same results", Slow):
    TempFolder.use: folder =>
      val compiler = ToolProvider.getSystemJavaCompiler
      val words = Vector("-d", folder.toString, "-Xlint:all,-path", "-Werror", "-classpath",
        sys.props("java.class.path"), javaFile.toString)
      assert(compiler.run(null, null, null, words*) == 0)
      Using.resource(URLClassLoader(Array(folder.toUri.toURL), getClass.getClassLoader)): loader =>
        def results(name: String) =
          val example = Class.forName(name, true, loader)
          def call(method: String, arguments: AnyRef*) =
            val found = example.getDeclaredMethods.find(_.getName == method).get
            found.setAccessible(true)
            found.invoke(null, arguments*)
          Vector(call("ball"), call("read", Path.of(scene))).map(call("measured", _))
        val inScala = results("ScalaExample")
        assert(inScala == results("JavaExample") && inScala(0) == inScala(1))
        assert(inScala(0).toString.matches(raw"mean 0\.4\d+, error \d\.\d\d %"), inScala(0))

  test("no promised class has a private companion: MiMa would overlook both"):
    val sources = Using.resource(Files.list(Path.of("src/core/scala/candela/api"))): files =>
      files.iterator.asScala.toVector.map(Files.readString).mkString("\n")
    def names(pattern: String) =
      pattern.r.findAllMatchIn(sources).map(_.group(1)).toSet
    val hidden = names(raw"(?m)^private(?:\[api\])? object (\w+)")
    val promised = names(raw"(?m)^(?:final class|trait|class|enum) (\w+)")
    assert(hidden.nonEmpty && promised.size > 10 && hidden.intersect(promised).isEmpty)
