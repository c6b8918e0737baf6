package candela.bidirectional

import java.util.concurrent.CountDownLatch
import java.util.concurrent.TimeUnit.MILLISECONDS

import org.scalatest.funsuite.AnyFunSuite

import candela.render.{Renderer, RenderPlan}
import candela.sampling.Sampler
import candela.testing.SceneTexts

final class PhotonPassesSuite extends AnyFunSuite:
  private val scene =
    """LookAt 0 0 4  0 0 0  0 1 0
      |Camera "perspective" "float fov" 40
      |Film "image" "integer xresolution" 48 "integer yresolution" 48
      |Sampler "random"
      |Integrator "sppm" "integer iterations" 12 "float radius" .2
      |  "integer photonsperiteration" 3000
      |WorldBegin
      |LightSource "point" "point from" [0 0 1] "rgb I" [4 4 4]
      |Material "matte"
      |Shape "sphere" "float radius" 2
      |""".stripMargin

  /** Holds up the first sample of the first tile until others are far ahead, or can't be. */
  private final class SlowCorner(inner: Sampler, ahead: CountDownLatch) extends Sampler:
    def samplesPerPixel: Int = inner.samplesPerPixel
    def copy(): Sampler = SlowCorner(inner.copy(), ahead)
    def start(px: Int, py: Int, sample: Int): Unit =
      if px == 0 && py == 0 && sample == 0 then
        val _ = ahead.await(Patience, MILLISECONDS)
      else if sample >= Far then ahead.countDown()
      inner.start(px, py, sample)
    def next1D(): Float = inner.next1D()
    def next2D(): Unit =
      inner.next2D()
      x = inner.x
      y = inner.y

  /** In passes: what is kept of earlier ones would have been overwritten. */
  private val Far = 4
  private val Patience = 300L

  test("no pass is made twice, however slow one tile is"):
    val plan = SceneTexts.plan(scene)
    def rays(threads: Int, sampler: Sampler): Long =
      val slow = RenderPlan(
        plan.width,
        plan.height,
        plan.crop,
        plan.camera,
        plan.filter,
        sampler,
        plan.method,
        plan.basis,
        plan.limit,
        plan.development,
        plan.filename,
        plan.features
      )
      Renderer.render(slow, threads).rays
    val alone = rays(1, plan.sampler)
    assert(alone > 12 * 3000)
    assert(rays(8, SlowCorner(plan.sampler, CountDownLatch(1))) == alone)
