package candela.testing

/** Waits for what another thread, process or page does. How long that takes decides nothing: the
  * two minutes only end a test that would wait for ever.
  */
object Eventually:

  /** The first result, tried again and again. */
  def eventually[A](what: String)(found: => Option[A]): A =
    val tries = Iterator.continually:
      val result = found
      if result.isEmpty then Thread.sleep(50)
      result
    val end = System.nanoTime + 120_000_000_000L
    tries.takeWhile(_ => System.nanoTime < end).flatten.nextOption
      .getOrElse(throw IllegalStateException(s"no $what within two minutes"))
