package candela.base

/** Checks of what code takes for granted. Only a JVM that runs with `-ea` makes them, as that of
  * the tests does. In any other the JIT compiler leaves nothing of them.
  */
object Assertions:
  val areOn: Boolean = getClass.desiredAssertionStatus()
