package candela.job

import candela.render.RenderControl
import candela.settings.{BuildControl, RenderSettings}
import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}
import java.util.concurrent.CyclicBarrier
import java.util.concurrent.TimeUnit.SECONDS

class JobsSuite extends AnyFunSuite:
  private def text(integrator: String, texture: String) =
    s"""Camera "perspective" "float fov" 50
       |Film "rgb" "integer xresolution" 24 "integer yresolution" 16
       |Sampler "halton" "integer pixelsamples" 8
       |Integrator $integrator
       |WorldBegin
       |LightSource "infinite" "rgb L" [.3 .4 .6]
       |LightSource "point" "point3 from" [0 2 0]
       |Texture "t" "spectrum" $texture "rgb tex1" [.8 .2 .1] "rgb tex2" [.1 .2 .8]
       |Translate 0 0 4
       |Material "coateddiffuse" "texture reflectance" "t"
       |Shape "sphere" "float radius" 1.5
       |Material "dielectric"
       |Translate 1 1 -1
       |Shape "sphere" "float radius" .5
       |""".stripMargin

  /** All values of the image. */
  private def image(scene: Path, settings: RenderSettings)(atOnce: => Unit): Vector[Float] =
    val prepared = SceneLoader.FromFile.load(scene.toString, settings, BuildControl(threads = 2))
    try
      atOnce
      val rendering = Render.render(prepared, RenderControl(threads = 2))
      assert(rendering.isComplete)
      rendering.image(prepared.plan.development).data.toVector
    finally prepared.close()

  test("two jobs at once make the bytes that they make one after the other"):
    TempFolder.use: folder =>
      val jobs = Vector(
        text("\"path\" \"integer maxdepth\" 5", "\"checkerboard\"") -> RenderSettings(seed = 1),
        text("\"bdpt\" \"integer maxdepth\" 4", "\"dots\"") -> RenderSettings(samples = Some(6))
      ).zipWithIndex.map:
        case ((scene, settings), i) =>
          (Files.writeString(folder.resolve(s"$i.pbrt"), scene), settings)
      val alone = jobs.map((scene, settings) => image(scene, settings)(()))
      assert(alone(0) != alone(1) && alone.forall(_.exists(_ > 0f)))
      val start = CyclicBarrier(jobs.size)
      val together = Array.fill(jobs.size)(Vector.empty[Float])
      val threads = jobs.zipWithIndex.map:
        case ((scene, settings), i) =>
          Thread: () =>
            together(i) = image(scene, settings)(start.await(60, SECONDS): Unit)
      threads.foreach(_.start())
      threads.foreach(_.join(60_000))
      assert(together.toVector == alone)
