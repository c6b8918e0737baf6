package candela.api

import candela.cli.Captured
import candela.testing.{Pipes, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{FileSystems, Files, Path}
import java.time.Duration
import java.util.concurrent.CancellationException

import scala.util.Using

class ProblemsSuite extends AnyFunSuite:
  private def refused(body: => Any): Problem = intercept[SceneException](body).problems.get(0)

  /** Whether `body` throws that its thread was interrupted, which it then still is. */
  private def isCancelled(body: => Any): Boolean =
    Thread.currentThread.interrupt()
    val isThrown =
      try
        val _ = body
        false
      catch case _: CancellationException => true
    isThrown & Thread.interrupted()

  test("an interrupted thread cancels whatever it calls, and stays interrupted"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.pbrt"), LibraryScenes.text())
      val builder = LibraryScenes.built()
      val scene = builder.scene()
      assert(isCancelled(Candela.read(file)), "read")
      assert(isCancelled(Candela.parse(LibraryScenes.text())), "parse")
      assert(isCancelled(scene.problems), "problems")
      assert(isCancelled(scene.check(RenderSettings())), "check")
      assert(isCancelled(scene.prepare(RenderSettings())), "prepare")
      Using.resource(scene.prepare(RenderSettings(samples = 1), 2)): job =>
        assert(isCancelled(job.render(2)), "render")
        val image = job.render(2).image
        val saved = folder.resolve("a.exr")
        assert(isCancelled(image.save(saved)) && !Files.exists(saved), "save")
        assert(isCancelled(image.bytes("pfm")), "bytes")
      // What was cancelled works later
      assert(scene.problems.isEmpty && !Candela.read(file).hasErrors)

  test("an interrupt while a scene is prepared cancels it"):
    @volatile var thrown = Option.empty[Throwable]
    @volatile var isInterrupted = false
    val spheres = (1 to 20_000).map(i => s"Shape \"sphere\" \"float radius\" $i\n").mkString
    val scene = Candela.parse(LibraryScenes.text() + spheres)
    val thread = Thread: () =>
      try while true do scene.check(RenderSettings()): Unit
      catch
        case e: Throwable =>
          thrown = Some(e)
          isInterrupted = Thread.currentThread.isInterrupted
    thread.start()
    Thread.sleep(50)
    thread.interrupt()
    thread.join(60_000)
    assert(thrown.exists(_.isInstanceOf[CancellationException]) && isInterrupted, thrown)

  test("times that are none are refused, and long ones are taken"):
    for time <- Vector(Duration.ZERO, Duration.ofSeconds(-1)) do
      val told = Vector(
        refused(RenderSettings().withTime(time)),
        refused(ReadSettings().withTimeLimit(time)),
        refused(RenderControl().withFilmInterval(time))
      )
      for p <- told do assert(p.number == "E0003" && p.message.contains("above 0"), p)
    for long <- Vector(Duration.ofDays(400_000), Duration.ofSeconds(Long.MaxValue)) do
      assert(RenderSettings().withTime(long).words.size == 2)
      assert(!s"${RenderControl().withFilmInterval(long)}".isEmpty)
      val how = ReadSettings().withTimeLimit(long)
      val scene = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), how)
      assert(scene.check(RenderSettings()).isEmpty, scene.problems)

  test("options of the program alone are refused, as they would do nothing"):
    for name <- Vector("mse-reference-image", "mse-reference-out") do
      val problem = refused(RenderSettings().withOption(name, "a.exr"))
      assert(problem.number == "E0008" && problem.help.get.contains("RenderListener"), problem)
    for turned <- Vector(
        () => RenderSettings().withOption("turntable", "8"),
        () =>
          ReadSettings().withOption("turntable", "8")
      )
    do assert(refused(turned()).help.get.contains("scene.edit()"))
    val curve = "Option \"string msereferenceimage\" \"a.exr\"\n" +
      "Option \"string msereferenceout\" \"a.txt\"\nCamera \"perspective\"\nWorldBegin\n" +
      "LightSource \"infinite\"\nShape \"sphere\"\n"
    Using.resource(Candela.parse(curve).prepare(RenderSettings(samples = 1), 1)): job =>
      assert(job.problems.stream.anyMatch(p => p.number == "E0008" && p.line == 2), job.problems)

  test("a film of a scene made in code says who continues it"):
    TempFolder.use: folder =>
      val file = Files.writeString(folder.resolve("a.pbrt"), LibraryScenes.text())
      val scenes = Vector(LibraryScenes.built(), Candela.read(file).edit().translate(0, 0, 0))
      for (builder, i) <- scenes.zipWithIndex do
        val film = folder.resolve(s"$i.film")
        val control = RenderControl().withThreads(2).withFilm(film)
        Using.resource(builder.scene().prepare(RenderSettings(samples = 1), 2))(_.render(control))
        val (code, captured) = Captured.run("resume", film.toString, "--spp", "2")
        assert(code == 1 && captured.err.contains("a program has made the scene"), captured.err)
        assert(captured.err.contains("withFilm"), captured.err)

  test("a film that can't be written is refused before the rendering"):
    TempFolder.use: folder =>
      val film = Files.createDirectory(folder.resolve("a.film"))
      val pipe = folder.resolve("b.film")
      val pipes = Option.when(Pipes.make(pipe))(pipe -> "a pipe")
      Using.resource(LibraryScenes.built().scene().prepare(RenderSettings(samples = 1), 2)): job =>
        for (path, what) <- (film -> "a folder") +: pipes.toVector do
          val listener = new RenderListener:
            override def progressed(progress: Progress): Unit = fail("it renders")
          val control = RenderControl().withThreads(2).withFilm(path).withListener(listener)
          val told = Pipes.unblocked(refused(job.render(control)))
          assert(told.message == s"can't write `$path`: it is $what", told)

  test("a goal that is missed is told of, one that is reached is not"):
    val scene = LibraryScenes.built().scene()
    for (error, expected) <- Vector(1e-6 -> Vector("E1104"), 0.9 -> Vector.empty) do
      val settings = RenderSettings().withError(error).withSamples(8)
      val told = Using.resource(scene.prepare(settings, 2))(_.render(2).problems)
      assert(told.stream.map(_.number).toList == java.util.List.of(expected*), told)
    val limited = ReadSettings().withLimit("samples", "8")
    val parsed = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), limited)
    val ended = Using.resource(parsed.prepare(RenderSettings().withError(1e-6), 2))(_.render(2))
    assert(ended.samplesPerPixel == 8 && ended.problems.get(0).help.get.contains("--limit"))

  test("a missing argument is named"):
    def named(body: => Any) = intercept[NullPointerException](body).getMessage
    val none = Parameters()
    assert(named(LibraryScenes.built().shape(null, none)) == "a name or type of Shape")
    assert(named(LibraryScenes.built().nameMaterial(null, "diffuse", none))
      == "a name or type of MakeNamedMaterial")
    assert(named(LibraryScenes.built().shape("sphere", null)) == "parameters")
    assert(named(LibraryScenes.built().option(null)) == "parameters")
    assert(named(Candela.read(null)) == "file")
    assert(named(Candela.read(Path.of("a.pbrt"), null)) == "settings")
    val scene = LibraryScenes.built().scene()
    assert(named(scene.prepare(null)) == "settings" && named(scene.check(null)) == "settings")
    assert(named(RenderControl().withFilm(null)) == "file")
    val image = refused(RenderControl().withFilm(Path.of("img.exr")))
    assert(image.message.contains("must be a name that ends with .film, found `img.exr`"), image)

  test("a path of another file system says what to do instead"):
    TempFolder.use: folder =>
      val zip = java.net.URI.create(s"jar:${folder.resolve("a.zip").toUri}")
      Using.resource(FileSystems.newFileSystem(zip, java.util.Map.of("create", "true"))): system =>
        val path = system.getPath("a.exr")
        val scene = LibraryScenes.built().scene()
        assert(scene.check(RenderSettings()).isEmpty)
        assert(Candela.read(path).problems.get(0).help.get.contains("Candela.parse"))
        Using.resource(scene.prepare(RenderSettings(samples = 1), 2)): job =>
          val saved = refused(job.render(2).image.save(path))
          assert(saved.help.get.contains("`bytes`"), saved)
          val film =
            refused(job.render(RenderControl().withThreads(2).withFilm(system.getPath("a.film"))))
          assert(film.number == saved.number && !film.help.get.contains("parse"), film)
