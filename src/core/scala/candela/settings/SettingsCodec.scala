package candela.settings

/** [[RenderSettings]] as words, as film files store them: `--seed 7 --quick`. Each setting has the
  * name that its option has. A setting without words has its default: so a new setting changes
  * neither files nor images' digests of renderings that don't use it.
  */
object SettingsCodec:
  /** All settings. */
  def words(s: RenderSettings): Vector[String] = SettingsTable.all.flatMap(_.words(s))

  /** Those that tell one image from another, but for its number of samples: what was chosen for a
    * goal, too.
    */
  def identity(s: RenderSettings): Vector[String] =
    val chosen = unusual(s)
    SettingsTable.all.filter(_.isIdentity).flatMap(_.words(chosen))

  /** Without the choices that scenes make: films lack them. */
  private def unusual(s: RenderSettings): RenderSettings =
    val choices = s.choices
    def unless[A](usual: A)(mine: A) = Option.when(mine != usual)(mine)
    s.copy(
      points = unless(Choices.OfScene.points)(choices.points),
      guiding = unless(Choices.OfScene.guiding)(choices.guiding),
      caustics = unless(Choices.OfScene.caustics)(choices.caustics)
    )

  /** The settings of these words; or what is wrong with them, as of a forged file. */
  def settings(words: Vector[String]): Either[String, RenderSettings] =
    def parsed(s: RenderSettings, rest: List[String]): Either[String, RenderSettings] = rest match
      case Nil => Right(s)
      case word :: more =>
        SettingsTable.named(word.stripPrefix("--")).filter(_ => word.startsWith("--")) match
          case None => Left(s"unknown setting `$word`")
          case Some(setting) =>
            val (value, left) = if setting.takesValue then more.splitAt(1) else (List(""), more)
            value.headOption.flatMap(setting.read) match
              case Some(change) => parsed(change(s), left)
              case None => Left(s"wrong value of `$word`")
    parsed(RenderSettings(), words.toList)
