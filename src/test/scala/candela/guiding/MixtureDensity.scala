package candela.guiding

import candela.lights.EqualAreaMap
import candela.math.*
import candela.sampling.IndependentSampler

import org.scalatest.Assertions.*

/** Whether a mixture, as seen from one point, samples directions by its density. */
private object MixtureDensity:
  private val Samples = 1 << 16

  /** Its lobes must be wide enough for a grid of 256 × 256 cells. */
  def check(pdf: Vec3 => Float, sample: (Float, Float, MutableVec3) => Unit): Unit =
    val sampler = IndependentSampler(Samples, 1)
    val wi = MutableVec3()
    // Of a grid of 8 × 8 cells on the square: the integral of the density, and the samples' share
    val expected, found = new Array[Double](64)
    for i <- 0 until Samples do
      // The middles of 256 × 256 cells
      val (x, y) = ((i % 256 + 0.5f) / 256f, (i / 256 + 0.5f) / 256f)
      val at = EqualAreaMap.toDirection(x, y)
      expected((x * 8).toInt + 8 * (y * 8).toInt) += pdf(at) * 4.0 * Math.PI / Samples
      sampler.start(0, 0, i)
      sampler.next2D()
      sample(sampler.x, sampler.y, wi)
      assert(Math.abs(wi.length - 1f) < 1e-4f)
      val to = EqualAreaMap.toImage(wi)
      found((to.x * 8).toInt + 8 * (to.y * 8).toInt) += 1.0 / Samples
    assert(Math.abs(expected.sum - 1.0) < 0.01)
    // 65536 samples: deviations are below 0.002
    for (e, f) <- expected.zip(found) do assert(Math.abs(e - f) < 0.01, s"$e $f")
