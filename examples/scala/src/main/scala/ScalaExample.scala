import candela.api.*

import java.nio.file.Path

import scala.util.Using

/** Renders a scene that is made here, and one of a file; prints their means and errors. */
object ScalaExample:

  def main(args: Array[String]): Unit =
    println(s"built: ${measured(ball)}")
    println(s"read: ${measured(read(Path.of(args(0))))}")

  /** A red ball under a grey sky. */
  def ball: Scene = Candela.build()
    .film("rgb", Parameters().integer("xresolution", 64).integer("yresolution", 48))
    .lookAt(0, 1, -5, 0, 0, 0, 0, 1, 0)
    .camera("perspective", Parameters().number("fov", 40))
    .sampler("zsobol", Parameters().integer("pixelsamples", 16))
    .integrator("volpath", Parameters().integer("maxdepth", 5))
    .world()
    .light("infinite", Parameters().rgb("L", 0.5, 0.5, 0.5))
    .material("diffuse", Parameters().rgb("reflectance", 0.8, 0.2, 0.1))
    .shape("sphere", Parameters().number("radius", 1))
    .scene()

  /** A scene that has no errors. */
  def read(file: Path): Scene =
    val scene = Candela.read(file)
    scene.problems.forEach(problem => System.err.println(problem))
    if scene.hasErrors then sys.exit(1)
    scene

  def measured(scene: Scene): String =
    Using.resource(scene.prepare(RenderSettings(samples = 16))): job =>
      val result = job.render(RenderControl().withThreads(2).withErrorEstimates)
      f"mean ${result.image.mean("R")}%.4f, error ${100 * result.error.getAsDouble}%.2f %%"
