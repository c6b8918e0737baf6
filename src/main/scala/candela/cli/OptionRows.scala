package candela.cli

import scopt.OParser

/** Parts of the option tables. */
private[cli] trait OptionRows:
  protected type Row = OParser[?, Options]
  private val b = OParser.builder[Options]

  protected final def positive(option: String)(x: Double): Either[String, Unit] =
    if x > 0 && x < 1e30 then b.success else b.failure(s"--$option must be above 0, found `$x`")

  /** Of a list, as of `,`, nothing may be left. */
  protected final def some(option: String)(all: Seq[?]): Either[String, Unit] =
    if all.nonEmpty then b.success
    else b.failure(s"--$option must be at least one name, found none")

  protected final def atLeast[N](option: String, least: Int)(n: N)(using
      number: Numeric[N]
  ): Either[String, Unit] =
    if number.gteq(n, number.fromInt(least)) then b.success
    else b.failure(s"--$option must be at least $least, found `$n`")
