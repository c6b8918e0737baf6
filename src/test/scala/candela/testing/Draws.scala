package candela.testing

/** The random numbers of tests: those with which the program tests itself. */
type Draws = candela.bench.robustness.Draws
object Draws:
  def apply(seed: Long): Draws = candela.bench.robustness.Draws(seed)
