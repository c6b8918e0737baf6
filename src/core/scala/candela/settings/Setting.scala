package candela.settings

/** A setting: an option of command lines, words of film files, and a name for programs.
  *
  * @param name         without dashes
  * @param valueName    of its value in help; empty: it has none
  * @param help         short text
  * @param more         what pages add to it, in Markdown whose links start at `docs`
  * @param texts        its values as text; none: the default
  * @param read         what a value's text changes; None: it is no such value
  * @param wanted       what messages say of such a text, after "must be"
  * @param wrong        the part of such a text that is wrong
  * @param isIdentity   whether two films that differ in it are of different images
  * @param isRepeatable whether command lines may have it several times
  * @param letter       of its short option
  * @param implied      what users change by it, too
  */
final case class Setting private (
    name: String,
    valueName: String,
    help: String,
    texts: RenderSettings => Vector[String],
    read: String => Option[RenderSettings => RenderSettings],
    wanted: String => String,
    wrong: String => String,
    more: String = "",
    isIdentity: Boolean = true,
    isRepeatable: Boolean = false,
    letter: Option[Char] = None,
    implied: RenderSettings => RenderSettings = identity
):
  def takesValue: Boolean = valueName.nonEmpty

  /** What a user changes by a value; None: it is no such value. */
  def change(text: String): Option[RenderSettings => RenderSettings] =
    read(text).map(_.andThen(implied))

  /** As film files store it. */
  def words(s: RenderSettings): Vector[String] =
    if takesValue then texts(s).flatMap(text => Vector(s"--$name", text))
    else texts(s).map(_ => s"--$name")

  private[settings] def explained(more: String): Setting = copy(more = more)

  /** Films that differ only in this setting are of the same image. */
  private[settings] def withoutIdentity: Setting = copy(isIdentity = false)

  private[settings] def repeatable: Setting = copy(isRepeatable = true)

  private[settings] def short(letter: Char): Setting = copy(letter = Some(letter))

  private[settings] def implying(change: RenderSettings => RenderSettings): Setting =
    copy(implied = change)

private[settings] object Setting:
  private type S = RenderSettings
  private val default = RenderSettings()

  /** A setting that has a default. */
  def value[A](name: String, valueName: String, help: String)(of: S => A)(put: (S, A) => S)(using
      form: TextForm[A]
  ): Setting =
    option(name, valueName, help)(s => Option(of(s)).filter(_ != of(default)))(put)

  /** A setting that may be missing. */
  def option[A](name: String, valueName: String, help: String)(of: S => Option[A])(
      put: (S, A) => S
  )(using form: TextForm[A]): Setting =
    list(name, valueName, help)(of(_).toVector)(put)

  def list[A](name: String, valueName: String, help: String)(of: S => Vector[A])(
      put: (S, A) => S
  )(using form: TextForm[A]): Setting =
    def read(text: String) = form.read(text).map(a => put(_: S, a))
    Setting(name, valueName, help, of(_).map(form.format), read, form.wanted, form.wrong)

  def flag(name: String, help: String)(of: S => Boolean)(put: S => S): Setting =
    Setting(name, "", help, s => Option.when(of(s))("").toVector, _ => Some(put), _ => "", identity)

  def region[R <: RenderRegion: TextForm](name: String, valueName: String, help: String)(
      of: PartialFunction[RenderRegion, R]
  ): Setting =
    option(name, valueName, help)(s => of.lift(s.region))((s, r) => s.copy(region = r))

  /** Stands for other settings, as which it is stored. */
  def shorthand[A](name: String, valueName: String, help: String)(put: (S, A) => S)(using
      form: TextForm[A]
  ): Setting =
    list[A](name, valueName, help)(_ => Vector.empty)(put)
