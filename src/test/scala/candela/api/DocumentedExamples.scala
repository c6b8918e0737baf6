package candela.api

import java.nio.file.Path
import java.time.Duration

import scala.util.Using

/** The Scala examples of docs/LIBRARY.md and of the library's comments, as they stand there;
  * [[ExamplesSuite]] compares them, and runs them.
  */
object DocumentedExamples:
  private def update(part: Double): Unit = assert(part >= 0 && part <= 1)

  def shortest(file: String, image: String): Unit =
    val scene = Candela.read(Path.of(file))
    Using.resource(scene.prepare(RenderSettings(samples = 64))): job =>
      job.render(threads = 8).image.save(Path.of(image))

  def first(file: String, image: String): Unit =
    val scene = Candela.read(Path.of(file))
    scene.problems.forEach(problem => System.err.println(problem))
    Using.resource(scene.prepare(RenderSettings(samples = 64))): job =>
      val result = job.render(threads = 8, progress => update(progress.part))
      result.image.save(Path.of(image))

  def parameters: Parameters =
    Parameters().rgb("reflectance", 0.8, 0.2, 0.1).number("roughness", 0.3)

  def built: Scene =
    val scene = Candela.build()
      .film("rgb", Parameters().integer("xresolution", 64).integer("yresolution", 48))
      .lookAt(0, 1, -5, 0, 0, 0, 0, 1, 0)
      .camera("perspective", Parameters().number("fov", 40))
      .world()
      .light("infinite", Parameters().rgb("L", 0.4, 0.5, 0.6))
      .material("diffuse", Parameters().rgb("reflectance", 0.8, 0.2, 0.1))
      .shape("sphere", Parameters().number("radius", 1))
      .scene()
    scene

  def changed(scene: Scene): Scene =
    val small = scene.edit()
      .change(SceneSetting.Film, Parameters().integer("xresolution", 320))
      .attributes(_.translate(0, 2, 0).shape("sphere", Parameters().number("radius", 0.5)))
      .scene()
    small

  def cancelled(job: Job): RenderResult =
    val stop = Cancellation()
    val control = RenderControl().withThreads(4).withCancellation(stop)
    val watch = Thread: () =>
      Thread.sleep(5000)
      stop.cancel()
    watch.start()
    val result = job.render(control)
    result

  def goal(scene: Scene, film: Path): RenderResult =
    val settings = RenderSettings().withError(0.01).withTime(Duration.ofMinutes(10))
    Using.resource(scene.prepare(settings)): job =>
      job.render(RenderControl().withFilm(film))
