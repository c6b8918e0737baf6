package candela.mitsuba

import candela.build.SceneBuilder
import candela.color.Rgb
import candela.render.Renderer
import candela.scenefile.SceneDescription
import candela.settings.RenderSettings

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** Means of small images, for comparison with Mitsuba's. */
abstract class MitsubaPictures extends AnyFunSuite:
  protected def read(body: String): SceneDescription = using(body)(identity)

  /** Of the files. */
  protected def version: String = "3.0.0"

  protected def using[A](body: String)(use: SceneDescription => A): A =
    val folder = Files.createTempDirectory("candela-surfaces")
    val scene = Files.writeString(
      folder.resolve("scene.xml"),
      s"""<scene version="$version">$body</scene>"""
    )
    try use(MitsubaScene.readable(scene, Map.empty, keepGoing = false))
    finally
      Files.delete(scene)
      Files.delete(folder)

  protected def view(
      fov: Int,
      samples: Int,
      integrator: String = "path",
      from: String = "0,0,5"
  ): String =
    s"<integrator type=\"$integrator\"><integer name=\"max_depth\" value=\"6\"/></integrator>" +
      s"<sensor type=\"perspective\"><float name=\"fov\" value=\"$fov\"/>" +
      s"<transform name=\"to_world\"><lookat origin=\"$from\" target=\"0,0,0\" up=\"0,1,0\"/>" +
      "</transform><sampler type=\"independent\">" +
      s"<integer name=\"sample_count\" value=\"$samples\"/></sampler><film type=\"hdrfilm\">" +
      "<integer name=\"width\" value=\"8\"/><integer name=\"height\" value=\"6\"/>" +
      "<rfilter type=\"box\"/></film></sensor>"

  protected def mean(body: String): Rgb = using(body): scene =>
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    val data = Renderer.render(plan, threads = 1).image(plan.development).data
    val sums = Array(0.0, 0.0, 0.0)
    for i <- data.indices do sums(i % 3) += data(i)
    val Array(r, g, b) = sums.map(s => (s * 3 / data.length).toFloat)
    Rgb(r, g, b)
