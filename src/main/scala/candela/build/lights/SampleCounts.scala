package candela.build.lights

import candela.build.recipe.*

/** The parameters that say how often v2's and v3's direct lighting samples a light. */
trait SampleCounts extends Fields:
  private val nsamples = integer("nsamples", "light samples of directlighting", untilV3)(1)
  private val samples =
    integer("samples", "another name of `nsamples`", onlyV3, shown = "nsamples")(1)

  protected def sampleCount()(using Site): Int =
    Math.max(1, samples.given_().getOrElse(nsamples()))
