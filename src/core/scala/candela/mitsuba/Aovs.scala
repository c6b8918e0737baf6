package candela.mitsuba

import candela.diagnostics.{Code, Suggest}

/** The layers of integrators "aov", each as `NAME:QUANTITY`. */
private final class Aovs(session: Session):

  /** @param prefix of the names, with its point */
  def apply(p: Plugin, prefix: String = ""): Vector[String] =
    if p.name != "aov" then Vector.empty
    else
      val properties = Properties(p, session)
      val integrators = properties.named("integrator").zipWithIndex.map:
        case ((name, inner), i) =>
          (if name.isEmpty then s"${prefix}_arg_$i" else prefix + name, inner)
      val listed = properties.text("aovs", "").split("[, ]+").toVector.filter(_.nonEmpty)
        .flatMap(checked(_, properties)).map(prefix + _)
      val inner = integrators.take(1).flatMap: (name, integrator) =>
        s"$name:${Aovs.Colors}" +: apply(integrator, s"$name.")
      val layers = inner ++ listed
      val channels = layers.flatMap: layer =>
        Aovs.components(Aovs.quantity(layer)).map(c => s"${Aovs.name(layer)}.$c")
      for repeated <- channels.diff(channels.distinct).headOption do
        session.error(
          Code.Redefined,
          properties.posOf("aovs"),
          s"two layers have the channel `$repeated`",
          Some("each layer needs a name of its own")
        )
      layers.distinct

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

  /** Last letters of the channels, by quantity. */
  val components: Map[String, String] =
    Seq("position", "geo_normal", "sh_normal", "dp_du", "dp_dv").map(_ -> "XYZ").toMap ++
      Map("albedo" -> "RGB", "depth" -> "T", "uv" -> "UV", Colors -> "RGBA")

  def quantity(layer: String): String = layer.drop(layer.lastIndexOf(':') + 1)
  def name(layer: String): String = layer.take(layer.lastIndexOf(':'))
