package candela.photons

import java.util.concurrent.CountDownLatch
import java.util.concurrent.TimeUnit.MILLISECONDS

import org.scalatest.funsuite.AnyFunSuite

import candela.render.Renderer
import candela.testing.{SceneTexts, WatchedSampler}

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

  /** In passes: what is kept of earlier ones would have been overwritten. */
  private val Far = 4
  private val Patience = 300L

  test("no pass is made twice, however slow one tile is"):
    val plan = SceneTexts.plan(scene)
    def rays(threads: Int)(starts: (Int, Int, Int) => Unit): Long =
      Renderer.render(WatchedSampler.watched(plan)(starts), threads).rays
    val alone = rays(1)((_, _, _) => ())
    assert(alone > 12 * 3000)
    // Holds up the first sample of the first tile until others are far ahead, or can't be
    val ahead = CountDownLatch(1)
    val slow = rays(8): (px, py, sample) =>
      if px == 0 && py == 0 && sample == 0 then
        val _ = ahead.await(Patience, MILLISECONDS)
      else if sample >= Far then ahead.countDown()
    assert(slow == alone)
