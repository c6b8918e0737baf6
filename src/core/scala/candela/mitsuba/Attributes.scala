package candela.mitsuba

import candela.diagnostics.{Code, Problem, Suggest}

/** The attributes that Mitsuba 3's elements may have. */
private[mitsuba] object Attributes:
  private val axes = Set("value", "x", "y", "z")
  private val ofObjects = Set("id", "name", "type")
  private val ofValues: Map[String, Set[String]] = Map(
    "animation" -> Set("name"),
    "blackbody" -> Set("name", "scale", "temperature", "value"),
    "lookat" -> Set("origin", "target", "up"),
    "matrix" -> Set("value"),
    "point" -> (axes + "name"),
    "ref" -> Set("id", "name"),
    "rotate" -> (axes + "angle"),
    "scale" -> axes,
    "spectrum" -> (ofObjects ++ Set("filename", "value")),
    "transform" -> Set("name", "time"),
    "translate" -> axes,
    "vector" -> (axes + "name")
  )
  private val ofNumbers = Set("boolean", "float", "integer", "rgb", "string")

  /** Warnings of attributes that are ignored; files of 0.6 have others, and get none. */
  def ignored(e: Element): Vector[Problem] =
    if e.isOld then Vector.empty else ofElement(e) ++ e.children.flatMap(ignored)

  private def ofElement(e: Element): Vector[Problem] =
    val allowed = ofValues.get(e.tag)
      .orElse(Option.when(Values.Kinds(e.tag))(ofObjects))
      .orElse(Option.when(ofNumbers(e.tag))(Set("name", "value")))
    val usable = allowed.map(a => if e("value").isEmpty then a else a -- Vector("x", "y", "z"))
    for
      names <- usable.toVector
      name <- e.attributes.keys.toVector.sorted if !names(name)
      reason = if allowed.exists(_(name)) then "has no effect beside `value`" else "is ignored"
    yield Problem.warning(
      Code.IdleParameter,
      e.pos,
      s"`$name` is not an attribute of <${e.tag}>; it $reason"
    ).withHelp(Suggest.help(name, names -- e.attributes.keys))
