package candela.build.recipe

import candela.scenefile.Dialect

/** Names of types in other dialects, for messages. */
private[build] object OtherNames:
  /** Category, old name and the nearest type of v4. */
  private val Pairs = Vector(
    ("material", "matte", "diffuse"),
    ("material", "plastic", "coateddiffuse"),
    ("material", "metal", "conductor"),
    ("material", "mirror", "conductor"),
    ("material", "glass", "dielectric"),
    ("material", "substrate", "coateddiffuse"),
    ("material", "uber", "coateddiffuse"),
    ("material", "translucent", "diffusetransmission"),
    ("material", "kdsubsurface", "subsurface"),
    ("material", "fourier", "measured"),
    ("material", "none", "interface"),
    ("camera", "environment", "spherical"),
    ("film", "image", "rgb"),
    ("sampler", "random", "independent"),
    ("sampler", "lowdiscrepancy", "paddedsobol"),
    ("sampler", "02sequence", "paddedsobol"),
    ("integrator", "directlighting", "path"),
    ("integrator", "whitted", "path"),
    ("area light", "area", "diffuse")
  )

  /** Parameters of v2 and v3, each with the one of v4. */
  private val Parameters = Vector(
    "Kd" -> "reflectance",
    "Kr" -> "reflectance",
    "Kt" -> "transmittance",
    "index" -> "eta",
    "bumpmap" -> "displacement"
  )

  /** The name in `names` of another dialect's parameter. */
  def parameter(name: String, names: Iterable[String]): Option[String] =
    Parameters.collectFirst:
      case (`name`, modern) if names.exists(_ == modern) => s"did you mean `$modern`?"
      case (old, `name`) if names.exists(_ == old) => s"did you mean `$old`?"

  /** Of types that only Mitsuba's scenes have. */
  private val Mitsubas = Map(
    "coating" -> "coateddiffuse",
    "phong" -> "plastic",
    "principled" -> "disney",
    "roughdiffuse" -> "matte",
    "roughplastic" -> "plastic",
    "scatteringlayer" -> "translucent",
    "sunsky" -> "infinite",
    "twosided" -> "mix",
    "ward" -> "substrate"
  )

  /** The name in this dialect of a type of another one. */
  def hint(category: String, name: String, dialect: Dialect): Option[String] =
    val equivalent =
      if dialect == Dialect.V4 then
        Pairs.collectFirst { case (`category`, `name`, modern) => modern }
      else Pairs.collectFirst { case (`category`, old, `name`) => old }
    equivalent.map(o => s"in ${Dialects.name(dialect)}, write \"$o\"")

  /** As above, of Mitsuba's types. */
  def ofMitsubas(name: String): Option[String] =
    for nearest <- Mitsubas.get(name)
    yield s"\"$name\" is a type of Mitsuba's scenes; pbrt's nearest is \"$nearest\""
