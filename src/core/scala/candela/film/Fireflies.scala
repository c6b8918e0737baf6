package candela.film

/** Treatment of fireflies, samples much brighter than their neighbours. It trades noise for bias.
  */
enum Fireflies(val word: String):

  /** Nothing. */
  case Kept extends Fireflies("keep")

  /** Light of brightness levels with too few samples is left out; see [[FireflyWeights]]. */
  case Reweighted extends Fireflies("reweight")

  /** Light scattered more than once is limited, sample by sample.
    *
    * @param most maximum red, green or blue, in the units of the image
    */
  case Clamped(most: Float) extends Fireflies("clamp")
