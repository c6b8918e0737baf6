package candela.api

import candela.testing.TempFolder

import java.net.URI
import java.nio.file.{FileSystems, Files, Path}
import java.time.Duration

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Using

/** What programs have that command lines have not. */
class HostsSuite extends AnyFunSuite:

  private def numbers(problems: java.util.List[Problem]) =
    Vector.tabulate(problems.size)(problems.get(_).number)

  private def inFile(text: String)(body: Path => Any): Any =
    TempFolder.use(folder => body(Files.writeString(folder.resolve("s.pbrt"), text)))

  test("a world that the file has not is an error; the first is read with a warning of others"):
    def world(width: Int) = s"""Film "image" "integer xresolution" $width "integer yresolution" 2
      |Camera "perspective"
      |WorldBegin
      |LightSource "infinite"
      |WorldEnd
      |""".stripMargin
    inFile(world(3) + world(5)): file =>
      def read(n: Int) = Candela.read(file, ReadSettings().withWorld(n))
      def width(scene: Scene) = Using.resource(scene.prepare(RenderSettings(), 1))(_.width)
      assert(width(read(0)) == 3 && width(read(1)) == 5 && numbers(read(1).problems).isEmpty)
      val first = Candela.read(file)
      assert(numbers(first.problems) == Vector("E0208") && width(first) == 3)
      assert(read(2).hasErrors && read(99).hasErrors)
      val message = intercept[SceneException](width(read(2))).getMessage
      assert(message.contains("has no world 2; the last one is 1"), message)
      assert(
        intercept[SceneException](ReadSettings().withWorld(-1)).getMessage.contains("found -1")
      )

  test("a film whose error is low enough already gets no more samples"):
    TempFolder.use: folder =>
      val settings = RenderSettings().withError(0.2)
      val control = RenderControl().withThreads(2).withFilm(folder.resolve("a.film"))
      def samples() =
        val scene = Candela.parse(LibraryScenes.text(samples = 4096))
        Using.resource(scene.prepare(settings, 2))(_.render(control)).samplesPerPixel
      val first = samples()
      assert(first < 4096 && samples() == first && samples() == first)

  test("a goal ends at the limit of samples"):
    val how = ReadSettings().withLimit("samples", "2")
    val scene = Candela.parse(LibraryScenes.text(), Path.of("a.pbrt"), how)
    val goal = RenderSettings().withError(1e-9).withTime(Duration.ofSeconds(20))
    val result = Using.resource(scene.prepare(goal, 2))(_.render(2))
    assert(result.samplesPerPixel == 2 && result.isComplete)

  test("a path of another file system is refused, and not looked for on the disk"):
    inFile(LibraryScenes.text()): file =>
      val zip = URI.create("jar:" + file.resolveSibling("a.zip").toUri)
      Using.resource(FileSystems.newFileSystem(zip, java.util.Map.of("create", "true"))): inside =>
        val path = inside.getPath(file.toString)
        def refusal(body: => Any) = intercept[SceneException](body).getMessage
        val reading = Candela.read(path)
        assert(reading.hasErrors && reading.problems.get(0).message.contains("default file system"))
        Using.resource(Candela.read(file).prepare(RenderSettings(), 1)): job =>
          val image = job.render(1).image
          assert(refusal(image.save(inside.getPath("a.png"))).contains("default file system"))
          val control = RenderControl().withFilm(inside.getPath("a.film"))
          assert(refusal(job.render(control)).contains("default file system"))

  test("models are read whatever classes the first thread sees"):
    val thread = Thread.currentThread
    val own = thread.getContextClassLoader
    thread.setContextClassLoader(ClassLoader.getPlatformClassLoader)
    try
      val formats = candela.base.Services.installed(classOf[candela.job.SceneFormat]).toVector
      assert(formats.map(_.name).contains("glTF"))
    finally thread.setContextClassLoader(own)

  test("an interrupt, or a listener that throws, leaves the film"):
    TempFolder.use: folder =>
      val scene = LibraryScenes.built(samples = 64).scene()
      def atSample4(name: String)(body: => Unit): Int =
        val film = folder.resolve(name)
        val listener = new RenderListener:
          override def wantsPasses: Boolean = true
          override def passed(pass: Pass): Unit = if pass.samples == 4 then body
        val control = RenderControl().withThreads(2).withFilm(film)
        Using.resource(scene.prepare(RenderSettings(), 2)): job =>
          assertThrows[RuntimeException](job.render(control.withListener(listener)))
          Thread.interrupted(): Unit
          job.render(control).earlierSamplesPerPixel
      assert(atSample4("thrown.film")(throw RuntimeException("enough")) == 4)
      assert(atSample4("interrupted.film")(Thread.currentThread.interrupt()) >= 4)

  test("services of another copy of the program are none"):
    val thread = Thread.currentThread
    val own = thread.getContextClassLoader
    val paths = System.getProperty("java.class.path").split(java.io.File.pathSeparator)
    val urls = paths.map(Path.of(_).toUri.toURL)
    Using.resource(java.net.URLClassLoader(urls, ClassLoader.getPlatformClassLoader)): copy =>
      thread.setContextClassLoader(copy)
      try
        val formats = candela.base.Services.installed(classOf[candela.job.SceneFormat]).toVector
        assert(formats.map(_.name).contains("glTF"))
        assert(!Candela.parse(LibraryScenes.text()).hasErrors)
      finally thread.setContextClassLoader(own)
