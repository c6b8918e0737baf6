package candela.mitsuba

import candela.color.Rgb
import candela.diagnostics.Code
import candela.scenefile.Param

/** Translates BSDFs of Mitsuba 0.6 that contain no others, and that Mitsuba 3 lacks. */
private[mitsuba] final class EarlierSurfaces(
    session: Session,
    colors: Colors,
    textures: Textures,
    basic: BasicSurfaces
):
  def apply(in: Properties): Surface = in.plugin.name match
    case "phong" => phong(in)
    case "ward" => ward(in)
    case "roughdiffuse" => roughDiffuse(in)
    case "difftrans" => diffuseTransmitter(in)
    case "hk" => scatteringLayer(in)
    case _ => cloth(in)

  private def phong(in: Properties): Surface =
    basic.surface(in, "phong", isOneSided = true)(
      (textures.number("exponent", in, "exponent", 30) +: glossed(in))*
    )

  private def ward(in: Properties): Surface =
    val variant = in.word("variant", "balanced", "balanced", "ward", "ward-duer")
    val alphas =
      for (axis, name) <- Vector("u" -> "alpha_u", "v" -> "alpha_v") yield
        val property = if in.contains(name) then name else "alpha"
        textures.number(s"${axis}roughness", in, property, 0.1)
    basic.surface(in, "ward", isOneSided = true)(
      ((Param.string("variant", in.posOf("variant"), variant) +: alphas) ++ glossed(in))*
    )

  private def glossed(in: Properties): Vector[Param] =
    val conserves = in.flag("ensure_energy_conservation", true)
    val shades = Seq("diffuse_reflectance" -> 0.5f, "specular_reflectance" -> 0.2f).map:
      (name, default) => colors.shade(in, name, Rgb.gray(default), Role.Reflectance)
    val constants = shades.flatMap(_.constant)
    if conserves && constants.size == 2 then
      val total = constants.reduce(_ + _).max
      if total > 1f then
        session.warn(
          Code.CorrectedValue,
          in.pos,
          s"the reflectances of ${in.plugin.description} add up to $total; both are scaled by " +
            s"${0.99f / total}, as in Mitsuba 0.6"
        )
    val names = Vector("reflectance" -> "diffuse_reflectance", "specular" -> "specular_reflectance")
    names.zip(shades).map { case ((ours, theirs), shade) =>
      textures.color(ours, shade, in.posOf(theirs))
    } :+ Param.bool("conserveenergy", in.pos, conserves)

  private def roughDiffuse(in: Properties): Surface =
    basic.surface(in, "roughdiffuse", isOneSided = true)(
      basic.color(in, basic.reflectance(in), 0.5f, "reflectance"),
      textures.number("roughness", in, "alpha", 0.2),
      Param.bool("fast", in.posOf("use_fast_approx"), in.flag("use_fast_approx", false))
    )

  private def diffuseTransmitter(in: Properties): Surface =
    val name = "diffuse_transmittance"
    val transmittance = if in.contains(name) then name else "transmittance"
    basic.surface(in, "diffusetransmission", isOneSided = false)(
      Textures.rgb("reflectance", Rgb.Black, in.pos),
      basic.color(in, transmittance, 0.5f, "transmittance")
    )

  private def scatteringLayer(in: Properties): Surface =
    val phase = in.nested("phase").headOption.fold(Phase.Isotropic): p =>
      Phase.translated(p, session)((in, name) => in.number(name, 0.5).toFloat)
    val shades =
      for name <- Vector("sigma_a", "sigma_s")
      yield name -> colors.givenShade(in, name, Role.Unbounded)
    val isTextured = shades.exists(_._2.exists(_.constant.isEmpty))
    val coefficients =
      if !isTextured then
        val medium = Presets.coefficients(in, colors)
        val (a, s) = phase.reduced(medium.sigmaA, medium.sigmaS)
        Vector(Textures.rgb("sigma_a", a, in.pos), Textures.rgb("sigma_s", s, in.pos))
      else
        for (name, shade) <- shades
        yield textures.color(name, shade.getOrElse(Shade.Constant(Rgb.Black)), in.posOf(name))
    val thickness = in.number("thickness", 1).toFloat
    basic.surface(in, "scatteringlayer", isOneSided = false)(
      (coefficients ++ phase.params(in.pos) :+
        Param.float("thickness", in.posOf("thickness"), thickness))*
    )

  /** A diffuse surface of the mean colour of the yarns, as far as the scene tells it. */
  private def cloth(in: Properties): Surface =
    val names = in.plugin.properties.map(_.name)
    val yarns = names.filter(_.endsWith("kd")).distinct
      .map(colors.fixed(in, _, Textures.Fallback, Role.Reflectance))
    val color =
      if yarns.isEmpty then Textures.Fallback else yarns.reduce(_ + _) * (1f / yarns.size)
    session.warn(
      Code.Unsupported,
      in.pos,
      s"${in.plugin.description} is not supported; using a diffuse reflectance of " +
        s"${color.r}, ${color.g}, ${color.b}"
    )
    in.ignore(names*)
    basic.surface(in, "diffuse", isOneSided = true)(Textures.rgb("reflectance", color, in.pos))

private[mitsuba] object EarlierSurfaces:
  val types: Set[String] = Set("difftrans", "hk", "irawan", "phong", "roughdiffuse", "ward")
