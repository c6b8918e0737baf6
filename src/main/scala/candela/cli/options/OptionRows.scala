package candela.cli.options

import candela.job.TextForm
import candela.settings.{OutputSettings, ReadSettings, RenderGoal, RenderRegion, RenderSettings}

import scopt.{OParser, Read}

/** Parts of the option tables. */
private[candela] trait OptionRows:
  protected type Row = OParser[?, Options]
  private val b = OParser.builder[Options]

  protected final def file(name: String, text: String): OParser[String, Options] =
    b.arg[String](name).text(text).action((f, o) => o.copy(files = o.files :+ f))

  protected final def positive(option: String)(x: Double): Either[String, Unit] =
    if x > 0 && x < 1e30 then b.success else b.failure(s"--$option must be above 0, found `$x`")

  protected final given read[A](using form: TextForm[A]): Read[A] = reading(form)

  protected final def reading[A](form: TextForm[A]): Read[A] = Read.reads: text =>
    form.read(text).getOrElse(throw IllegalArgumentException(s"expected ${form.expected}"))

  /** The action of a row: it changes what is rendered. */
  protected final def set[A](
      change: (A, RenderSettings) => RenderSettings
  ): (A, Options) => Options = (value, o) => o.setting(change(value, _))

  /** Likewise: how the scene's files are read. */
  protected final def setReading[A](
      change: (A, ReadSettings) => ReadSettings
  ): (A, Options) => Options = set((value, s) => s.copy(reading = change(value, s.reading)))

  /** Likewise: what is written of the image. */
  protected final def setOutput[A](
      change: (A, OutputSettings) => OutputSettings
  ): (A, Options) => Options = set((value, s) => s.copy(output = change(value, s.output)))

  /** Likewise: what ends the rendering. */
  protected final def setGoal[A](change: (A, RenderGoal) => RenderGoal): (A, Options) => Options =
    set((value, s) => s.copy(goal = change(value, s.goal)))

  /** Likewise: the part of the image. */
  protected final def setRegion[R <: RenderRegion]: (R, Options) => Options = (region, o) =>
    o.setting(_.copy(region = region)).copy(regions = o.regions :+ region)

  /** Of a list, as of `,`, nothing may be left. */
  protected final def some(option: String)(all: Seq[?]): Either[String, Unit] =
    if all.nonEmpty then b.success
    else b.failure(s"--$option must be at least one name, found none")

  protected final def atLeast[N](option: String, least: Int)(n: N)(using
      number: Numeric[N]
  ): Either[String, Unit] =
    if number.gteq(n, number.fromInt(least)) then b.success
    else b.failure(s"--$option must be at least $least, found `$n`")
