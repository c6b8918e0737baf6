package candela.testing

/** The random numbers of tests: those with which the program tests itself. */
type Draws = candela.robustness.Draws
object Draws:
  def apply(seed: Long): Draws = candela.robustness.Draws(seed)
