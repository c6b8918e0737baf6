package candela.mitsuba

import candela.diagnostics.{Code, SourcePos, Suggest}

/** The layers of integrators "aov" and "multichannel", each as `NAME:QUANTITY`.
  *
  * @param film names the channels of a "multichannel"
  */
private final class Aovs(session: Session, film: Option[Plugin]):

  /** @param prefix of the names, with its point */
  def apply(p: Plugin, prefix: String = ""): Vector[String] = p.name match
    case "multichannel" => distinct(fields(Properties(p, session).nested("integrator")), p.pos)
    case "aov" =>
      val properties = Properties(p, session)
      val integrators = properties.named("integrator").zipWithIndex.map:
        case ((name, inner), i) =>
          (if name.isEmpty then s"${prefix}_arg_$i" else prefix + name, inner)
      val listed = properties.text("aovs", "").split("[, ]+").toVector.filter(_.nonEmpty)
        .flatMap(checked(_, properties)).map(prefix + _)
      val inner = integrators.take(1).flatMap: (name, integrator) =>
        s"$name:${Aovs.Colors}" +: apply(integrator, s"$name.")
      distinct(inner ++ listed, properties.posOf("aovs"))
    case _ => Vector.empty

  private def distinct(layers: Vector[String], pos: SourcePos): Vector[String] =
    val channels = layers.flatMap: layer =>
      val quantity = Aovs.quantity(layer)
      (Aovs.components ++ Aovs.fieldComponents)(quantity).map(c => s"${Aovs.name(layer)}.$c")
    for repeated <- channels.diff(channels.distinct).headOption do
      session.error(
        Code.Redefined,
        pos,
        s"two layers have the channel `$repeated`",
        Some("each layer needs a name of its own")
      )
    layers.distinct

  /** 0.6's integrators "field", and the one beside them whose image is rendered. */
  private def fields(integrators: Vector[Plugin]): Vector[String] =
    val names = film.fold("")(Properties(_, session).text("channel_names", ""))
      .split("[, ]+").filter(_.nonEmpty)
    val image = integrators.indexWhere(_.name != "field")
    integrators.zipWithIndex.flatMap: (integrator, i) =>
      val quantity =
        if integrator.name == "field" then field(integrator)
        else Option.when(i == image && names.nonEmpty)(Aovs.Colors)
      quantity.map(q => s"${names.lift(i).getOrElse(s"_arg_$i")}:$q")

  private def field(p: Plugin): Option[String] =
    val in = Properties(p, session)
    if in.property("undefined").exists(p => !Aovs.isZero(p.value)) then
      in.warnUnsupported("samples without a surface count as 0", "undefined")
    val name = in.word("field", "", Aovs.Fields.keys.toSeq.sorted*)
    val quantity = Aovs.Fields.get(name).flatten
    if quantity.isEmpty && Aovs.Fields.contains(name) then
      in.warnUnsupported(s"`$name` is not written", "field")
    in.finish()
    quantity.map(q => s"field_$q")

  /** The layer, if it exists and can be written. */
  private def checked(layer: String, properties: Properties): Option[String] =
    val pos = properties.posOf("aovs")
    val quantity = Aovs.quantity(layer)
    if layer.count(_ == ':') != 1 || quantity.isEmpty || layer.startsWith(":") then
      session.error(Code.ParameterValue, pos, s"a layer must be NAME:QUANTITY, found `$layer`")
      None
    else if Aovs.Missing.contains(quantity) then
      session.warn(Code.Unsupported, pos, s"`$quantity` is not supported; `$layer` is not written")
      None
    else if !Aovs.components.contains(quantity) then
      val quantities = Aovs.components.keySet - Aovs.Colors ++ Aovs.Missing
      session.error(
        Code.UnknownType,
        pos,
        s"unknown quantity `$quantity` of `aovs`",
        Suggest.help(quantity, quantities)
      )
      None
    else Some(layer)

private object Aovs:
  /** Of the colours of an integrator within. */
  val Colors = "colors"

  /** Footprints of textures, which nothing filters, and numbers of triangles and shapes. */
  val Missing: Set[String] = Set("duv_dx", "duv_dy", "prim_index", "shape_index")

  /** Quantities by the names of 0.6's integrator "field". */
  val Fields: Map[String, Option[String]] =
    Map(
      "position" -> "position",
      "distance" -> "depth",
      "geoNormal" -> "geo_normal",
      "shNormal" -> "sh_normal",
      "uv" -> "uv",
      "albedo" -> "albedo"
    ).map((name, quantity) => name -> Some(quantity)) ++
      Seq("relPosition", "shapeIndex", "primIndex").map(_ -> None)

  private def isZero(value: Value): Boolean = value match
    case Value.Number(x) => x == 0
    case Value.Text(t) => t.split("[, ]+").forall(_.toDoubleOption.contains(0))
    case _ => false

  /** Last letters of the channels, by quantity. */
  val components: Map[String, String] =
    Seq("position", "geo_normal", "sh_normal", "dp_du", "dp_dv").map(_ -> "XYZ").toMap ++
      Map("albedo" -> "RGB", "depth" -> "T", "uv" -> "UV", Colors -> "RGBA")

  /** The same of 0.6's integrator "field", whose values are colours. */
  val fieldComponents: Map[String, String] =
    Fields.values.flatten.map(q => s"field_$q" -> (if q == "depth" then "Y" else "RGB")).toMap

  def quantity(layer: String): String = layer.drop(layer.lastIndexOf(':') + 1)
  def name(layer: String): String = layer.take(layer.lastIndexOf(':'))
