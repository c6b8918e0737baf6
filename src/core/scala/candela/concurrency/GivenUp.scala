package candela.concurrency

import scala.util.control.ControlThrowable

/** Ends work that nobody waits for any more. */
final class GivenUp private () extends ControlThrowable

object GivenUp:
  val Never: () => Boolean = () => false

  /** @throws GivenUp if the work is to end */
  def check(isStopped: () => Boolean): Unit = if isStopped() then throw new GivenUp()

  /** For the `i`-th of many small steps. */
  inline def check(isStopped: () => Boolean, i: Int): Unit =
    if (i & 0xffff) == 0 then check(isStopped)
