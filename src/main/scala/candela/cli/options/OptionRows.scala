package candela.cli.options

import candela.settings.{RenderSettings, Setting, SettingsTable, TextForm}

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
    form.read(text).getOrElse(throw UsageErrors.unread(form.wanted(text), form.wrong(text)))

  /** The row of a setting.
    *
    * @param help instead of that of the table
    */
  protected final def setting(name: String, help: String = ""): Row =
    row(SettingsTable.named(name).get, help)

  protected final def settings(names: String*): Vector[Row] = names.toVector.map(setting(_))

  protected final def row(of: Setting, help: String = ""): Row =
    val text = if help.isEmpty then OptionText(of.help, of.more) else help
    if of.takesValue then
      val read: Read[RenderSettings => RenderSettings] = Read.reads: value =>
        of.change(value).getOrElse(throw UsageErrors.unread(of.wanted(value), of.wrong(value)))
      val plain = b.opt[RenderSettings => RenderSettings](of.name)(using read)
        .valueName(of.valueName).text(text).action((change, o) => o.setting(change))
      val lettered = of.letter.fold(plain)(letter => plain.abbr(letter.toString))
      if of.isRepeatable then lettered.unbounded() else lettered
    else b.opt[Unit](of.name).text(text).action((_, o) => of.change("").fold(o)(o.setting))

  /** Of files, which commas separate; a comma behind no suffix belongs to a name. */
  protected final val fileNames: Read[Seq[String]] = Read.reads: text =>
    text.split(",").foldLeft(Vector.empty[String]): (names, part) =>
      if names.isEmpty || names.last.matches(".*\\.[A-Za-z]+") then names :+ part
      else names.init :+ s"${names.last},$part"

  /** Of a list, as of `,`, nothing may be left. */
  protected final def nonEmpty(option: String)(all: Seq[?]): Either[String, Unit] =
    if all.nonEmpty then b.success
    else b.failure(s"--$option must be at least one name, found none")

  protected final def atLeast[N](option: String, least: Int)(n: N)(using
      number: Numeric[N]
  ): Either[String, Unit] =
    if number.gteq(n, number.fromInt(least)) then b.success
    else b.failure(s"--$option must be at least $least, found `$n`")
