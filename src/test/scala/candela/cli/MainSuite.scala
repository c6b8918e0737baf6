package candela.cli

import candela.testing.TempFolder

import java.io.File
import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import scala.jdk.CollectionConverters.*

class MainSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run(args*)

  test("--help and --version print to standard output and exit with 0"):
    for option <- Vector("--help", "--version") do
      val (code, captured) = run(option)
      assert(code == 0)
      assert(captured.out.contains("candela"))
      assert(captured.err.isEmpty)

  test("bad usage prints to standard error and exits with 2"):
    val (code, captured) = run("--spq", "4", "a.pbrt")
    assert(code == 2)
    val message = "error: `candela render` has no option `--spq`; did you mean `--spp`? [E0002]\n"
    assert(captured.err.startsWith(message))
    assert(captured.out.isEmpty)

  test("more threads than any machine has processors are refused"):
    for n <- Vector("4097", "2147483647") do
      val (code, captured) = run("-j", n, "a.pbrt")
      assert(code == 2)
      val message = s"error: --nthreads must be at most 4096, found `$n` [E0003]\n"
      assert(captured.err.startsWith(message))

  test("a missing scene exits with 1 and offers the nearest one"):
    TempFolder.use: folder =>
      val _ = Files.createFile(folder.resolve("bunny.pbrt"))
      for command <- Vector("render", "check") do
        val (code, captured) = run(command, s"$folder/buny.pbrt")
        assert(code == 1)
        assert(captured.err.linesIterator.toVector == Vector(
          s"error: no such scene file: `$folder/buny.pbrt` [E0101]",
          s" did you mean `$folder/bunny.pbrt`?"
        ))

  test("a folder in place of a scene exits with 1 and names the scenes in it"):
    TempFolder.use: folder =>
      for name <- Vector("b.pbrt", "a.pbrt", "c.exr") do
        val _ = Files.createFile(folder.resolve(name))
      val (code, captured) = run(folder.toString)
      assert(code == 1)
      assert(captured.err.linesIterator.toVector == Vector(
        s"error: `$folder` is a folder [E0101]",
        " name a scene file in it: a.pbrt, b.pbrt"
      ))
    assert(run("")._2.err == "error: the name of the scene is empty [E0101]\n")

  test("a mistake in a scene exits with 1 and is shown in its place"):
    TempFolder.use: folder =>
      val scene = folder.resolve("a.pbrt")
      val _ = Files.writeString(scene, "LookAt 0 0 5  0 0 0  0 1 0\nTranlate 0 0 5\n")
      val (code, captured) = run("check", scene.toString)
      assert(code == 1)
      assert(captured.err.startsWith(s"$scene:2:1: error: "))
      assert(captured.err.contains(" 2 | Tranlate 0 0 5"))
      assert(captured.err.contains("did you mean `Translate`?"))
      assert(!captured.err.contains("\tat "))

  private val classPath = System.getProperty("java.class.path").split(File.pathSeparator).toVector

  /** The exit code of a process, and what it prints. */
  private def started(classPath: Vector[String], words: String*): (Int, String) =
    val java = ProcessHandle.current.info.command.orElse("java")
    val path = classPath.mkString(File.pathSeparator)
    val all = Vector(java, "-XX:TieredStopAtLevel=1", "-cp", path, "candela.cli.Main") ++ words
    val process = ProcessBuilder(all.asJava).redirectErrorStream(true).start()
    val printed = String(process.getInputStream.readAllBytes)
    (process.waitFor(), printed)

  test("Java adds no warnings of its own", Slow):
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("a.pbrt"), "WorldBegin Shape \"sphere\"")
      val (code, printed) = started(classPath, "check", scene.toString)
      assert(code == 0 && !printed.contains("WARNING"), printed)

  test("without the module of benchmarks their commands tell what is missing", Slow):
    val alone = classPath.filterNot(_.replace('\\', '/').contains("target/bench/"))
    assert(alone.size == classPath.size - 1)
    for words <- Vector("bench x.conf", "help robustness") do
      val (code, printed) = started(alone, words.split(' ').toVector*)
      assert(code == 2 && printed.contains("needs the module candela-bench"), printed)
      assert(printed.contains("candela-bench.jar"), printed)
    val (code, printed) = started(alone, "help")
    assert(code == 0 && printed.contains("  render ") && !printed.contains("  bench "), printed)
