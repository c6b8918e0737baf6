package candela.cli

import candela.image.ImageFiles
import candela.testing.Eventually.eventually
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*
import scala.util.Try

/** Ctrl-C before, during and after the rendering itself, in processes of their own. */
@org.scalatest.tags.Slow
class EarlyInterruptSuite extends AnyFunSuite:

  /** What a background job's children ignore, they must be told to obey. */
  private val obeying = Vector("env", "--default-signal=INT")
  private lazy val canObey = Try(run(obeying :+ "true") == 0).getOrElse(false)

  private def run(words: Vector[String]): Int = ProcessBuilder(words.asJava).start().waitFor()

  private final case class Ended(code: Int, err: String, seconds: Double)

  private final class Running(
      folder: Path,
      words: Seq[String],
      settings: Map[String, String] = Map.empty
  ):
    private val java = ProcessHandle.current.info.command.orElse("java")
    private val classes = System.getProperty("java.class.path")
    private val errors = folder.resolve("errors")
    private val process =
      val command =
        obeying ++ Vector(java, "-XX:TieredStopAtLevel=1", "-cp", classes, "candela.cli.Main") ++
          words
      val builder = ProcessBuilder(command.asJava).directory(folder.toFile)
        .redirectError(errors.toFile).redirectOutput(folder.resolve("output").toFile)
      settings.foreach(builder.environment.put(_, _): Unit)
      builder.start()

    def endInput(): Unit = process.getOutputStream.close()

    def isAlive: Boolean = process.isAlive
    def err: String = Files.readString(errors)
    def awaits(text: String): Unit = while isAlive && !err.contains(text) do Thread.sleep(5)
    def interrupt(): Unit = run(Vector("kill", "-INT", process.pid.toString)): Unit

    /** By a command of the shell, which starts no process between. */
    def interruptTwice(): Unit =
      val kill = s"kill -INT ${process.pid}"
      run(Vector("sh", "-c", s"$kill; $kill")): Unit

    /** Its end, which must be soon, and leave no stack trace and no half of a file. */
    def ended(): Ended =
      val started = System.nanoTime
      try
        // A second, and more for a busy machine
        assert(process.waitFor(15, TimeUnit.SECONDS), s"it goes on: $err")
        for word <- Vector("Exception", "\tat ", "Shutdown in progress", "bug in Candela") do
          assert(!err.contains(word), err)
        val names = TempFolder.names(folder)
        assert(!names.exists(_.endsWith(".tmp")), names)
        for name <- names if name.endsWith(".exr") do
          assert(ImageFiles.read(folder.resolve(name)).width == 24, name)
        Ended(process.exitValue, err, (System.nanoTime - started) * 1e-9)
      finally process.destroyForcibly(): Unit

  private def inFolder(test: Path => Any): Any =
    assume(canObey, "needs env --default-signal")
    TempFolder.use: folder =>
      val text = FilmFilesSuite.text(FilmFilesSuite.Paths, "independent")
      val _ = Files.writeString(folder.resolve("s.pbrt"), text)
      val _ = Files.writeString(folder.resolve("part.pbrt"), "Shape \"disk\"\n")
      test(folder)

  private def pipe(folder: Path, name: String): Path =
    val file = folder.resolve(name)
    assert(run(Vector("mkfifo", file.toString)) == 0)
    file

  private val endless = Seq("s.pbrt", "--spp", "1000000000", "--outfile", "a.exr")

  test("a program that belongs to another one ends when that one is gone, and only then"):
    inFolder: folder =>
      for setting <- Vector("stdin", "none") do
        val running = Running(folder, endless :+ "--checkpoint", Map("CANDELA_PARENT" -> setting))
        eventually("film"):
          Option.when(Files.exists(folder.resolve(".a.film.lock")) || !running.isAlive)(())
        assert(running.isAlive, running.err)
        running.endInput()
        if setting == "none" then
          Thread.sleep(500)
          assert(running.isAlive, running.err)
          running.interrupt()
        assert(running.ended().code == 130)
        Files.deleteIfExists(folder.resolve("a.film")): Unit

  test("an interrupt at any early moment ends the program, at once and silently"):
    inFolder: folder =>
      for milliseconds <- Vector(0, 60, 150, 300, 500) do
        val running = Running(folder, endless)
        Thread.sleep(milliseconds)
        running.interrupt()
        val ended = running.ended()
        assert(ended.code == 130, ended)
        val stopping = "stopping; Ctrl-C again quits and writes nothing\n"
        assert(Set("", "interrupted\n", stopping)(ended.err), ended)

  test("an interrupt while a scene is read says so, and writes nothing"):
    inFolder: folder =>
      val scene = pipe(folder, "slow.pbrt")
      val running = Running(folder, Seq("slow.pbrt", "--outfile", "a.exr"))
      // It opens when it is read
      val writer = Files.newOutputStream(scene)
      try
        writer.write("Camera ".getBytes)
        writer.flush()
        Thread.sleep(50)
        running.interrupt()
        val ended = running.ended()
        assert(ended.code == 130 && ended.err == "interrupted\n", ended)
        assert(!Files.exists(folder.resolve("a.exr")))
      finally Try(writer.close()): Unit

  test("an interrupt when the scene is built, or soon after, ends with what there is, or nothing"):
    inFolder: folder =>
      val running = Running(folder, endless :+ "--explain")
      running.awaits("integrator")
      running.interrupt()
      assert(running.ended().code == 130)

  test("an interrupt while the image is written does not lose it; a second one quits"):
    inFolder: folder =>
      val _ = pipe(folder, "a.png")
      val words = Seq("s.pbrt", "--spp", "1", "--outfile", "b.exr,a.png", "--explain")
      val running = Running(folder, words)
      // Nobody reads the pipe: it waits there, after b.exr
      running.awaits("integrator")
      while running.isAlive && !Files.exists(folder.resolve("b.exr")) do Thread.sleep(5)
      Thread.sleep(100)
      running.interrupt()
      running.awaits("stopping")
      assert(running.isAlive)
      Thread.sleep(100)
      running.interrupt()
      assert(running.ended().code == 130)
      assert(Files.exists(folder.resolve("b.exr")))

  test("interrupts twice in a row quit at once"):
    inFolder: folder =>
      val running = Running(folder, endless :+ "--explain")
      running.awaits("integrator")
      Thread.sleep(300)
      running.interrupt()
      Thread.sleep(100)
      running.interrupt()
      assert(running.ended().code == 130)

  test("an interrupt that comes twice at once, as from timeout, is one"):
    inFolder: folder =>
      val running = Running(folder, endless :+ "--explain")
      running.awaits("integrator")
      Thread.sleep(300)
      running.interruptTwice()
      assert(running.ended().code == 130)
      assert(Files.exists(folder.resolve("a.exr")))

  test("an interrupt while it renders ends a page that stays, too"):
    inFolder: folder =>
      val running = Running(folder, endless ++ Seq("--watch", "0", "--watch-after"))
      running.awaits("watch at")
      Thread.sleep(300)
      running.interrupt()
      val ended = running.ended()
      assert(ended.code == 130 && ended.err.contains("stopping"), ended)
      assert(Files.exists(folder.resolve("a.exr")))

  test("a reference interrupted in its first run goes on with its own options alone"):
    inFolder: folder =>
      val film = folder.resolve("a.run-1.film")
      def reference(options: String*) =
        Running(folder, Seq("reference", "s.pbrt", "--outfile", "a.exr") ++ options)
      def interrupted() =
        val running = reference("--spp", "1000000", "--error", "0.5%")
        eventually("lock"):
          Option.when(Files.exists(folder.resolve(".a.run-1.film.lock")) || !running.isAlive)(())
        Thread.sleep(500)
        running.interrupt()
        running.ended()
      assert(interrupted().code == 130)
      val kept = Files.readAllBytes(film)
      for samples <- Vector("4", "2000000") do
        val running = reference("--spp", samples, "--error", "50%", "--time", "1s")
        val other = running.ended()
        assert(other.code == 1 && other.err.contains("[E1002]"), other)
        assert(other.err.contains("`a.run-1.film`") && other.err.contains("remove it"), other)
        assert(Files.readAllBytes(film).sameElements(kept))
      assert(!Files.exists(folder.resolve("a.exr")))
      assert(interrupted().code == 130)
