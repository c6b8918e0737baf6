package candela.integrators

import candela.geometry.Ray
import candela.math.Vec3
import candela.media.{Medium, MediumBorder, MediumWork, PathWeights, SceneMedia}
import candela.sampling.{HenyeyGreenstein, PhaseFunction}

import org.scalatest.funsuite.AnyFunSuite

final class MediumSegmentSuite extends AnyFunSuite:

  /** A segment of length 2 through a medium that attenuates so, and what it changes. */
  private def segment(shadow: PathWeights => Unit): (MediumSegment, MediumWork) =
    val medium = new Medium:
      val phase: PhaseFunction = HenyeyGreenstein(0f)
      def follow(ray: Ray, first: Float, emits: Boolean, work: MediumWork): Float = -1f
      def attenuate(ray: Ray, work: MediumWork): Unit = shadow(work.shadow)
      def isChromatic = true
      def isEmissive = false
      def describe = "a stub"
    val borders = Array(MediumBorder(-1, -1))
    val media = SceneMedia(Array(medium), borders, camera = 0, Array.empty, Vec3.Zero, reach = 9f)
    val work = MediumWork()
    work.start(hero = 1)
    work.weights.startSegment(0.5f)
    val ray = Ray()
    ray.set(Vec3.Zero, Vec3.Z, 2f)
    val made = MediumSegment(media, work)
    made.start(ray, 0)
    (made, work)

  test("a path that goes straight passes as densely as a light sample, in each colour"):
    val (made, work) = segment: s =>
      s.scale(.2f, .3f, .4f)
      s.scaleLight(.5f, 1f, 2f)
    assert(made.goTo(2f))
    made.attenuate()
    val w = work.weights
    for (u, l) <- Seq((w.ur, w.lr), (w.ug, w.lg), (w.ub, w.lb)) do
      assert(Math.abs(l - 2f * u) < 1e-6f, s"$l, $u")
    // Of a mean of 1
    assert(Math.abs(w.ur + w.ug + w.ub - 3f) < 1e-6f)
    assert(Math.abs(w.ub / w.ur - 4f) < 1e-5f && Math.abs(w.b / w.r - 2f) < 1e-5f)

  test("light that is lost on the way to the path makes the sample none"):
    val (made, work) = segment: s =>
      s.discard()
      s.scaleLight(0f, 0f, 0f)
    made.goTo(1f): Unit
    assert(!work.weights.isLost)
    made.add(0f, 0f, -1f, 1f, 1f, 1f)
    assert(work.weights.isLost)
