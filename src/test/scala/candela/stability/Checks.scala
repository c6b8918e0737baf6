package candela.stability

import candela.bench.robustness.Tally
import org.scalatest.Assertions.fail

/** An assertion that costs nothing while it holds. ScalaTest's makes its words, and a record of
  * what it compares, in every call: most of the time of ten million trials.
  */
private object Checks:
  inline def assert(inline condition: Boolean, inline words: String = "it doesn't hold"): Unit =
    if !condition then fail(words)

  /** Whether no trial failed. */
  def holds(tally: Tally): Unit =
    for words <- tally.first do fail(s"${tally.faults} of ${tally.trials}: $words")
