package candela.mitsuba

import candela.base.NumberedNames
import candela.diagnostics.{Code, SourcePos}
import candela.color.Rgb
import candela.math.{Transform, Vec3}
import candela.scenefile.{GraphicsState, MediumDescription, Param, ParamType}

import scala.collection.mutable

/** Translates participating media, each once. */
final class Media(session: Session, colors: Colors):
  private val volumes = Volumes(session)
  private val media = mutable.LinkedHashMap.empty[Plugin, MediumDescription]
  private val numberedNames = NumberedNames()

  def result(): Vector[MediumDescription] = media.values.toVector

  /** The name of a medium, which is defined at its first use. */
  def apply(p: Plugin): String =
    media.getOrElseUpdate(p, session.translate(p)(translated)).name

  private def name(in: Properties): String = numberedNames(in.plugin.id.getOrElse("medium"))

  private def translated(in: Properties): MediumDescription =
    val phase = in.nested("phase").headOption.fold(Phase.Isotropic)(phaseOf)
    in.ignore("sample_emitters", "has_spectral_extinction", "majorant_resolution_factor")
    if in.plugin.isOld then
      in.ignore("method", "step_size", "strategy", "sampling_density", "medium_sampling_weight")
      in.warnUnsupported("all channels are rendered", "channel", "monochromatic")
      for v <- in.objectNamed("orientation") do
        session.warn(
          Code.Unsupported,
          v.pos,
          "orientations of particles are not supported; ignored"
        )
    val scale = in.number("scale", 1).toFloat
    in.plugin.name match
      case "homogeneous" if in.plugin.isOld || in.contains("material") =>
        // Their scale is that of the medium
        val medium = Presets.coefficients(in, colors)
        described(in, medium.sigmaA, medium.sigmaS, phase, 1f)
      case "homogeneous" => uniformExtinction(in, phase, scale)
      case "heterogeneous" =>
        volume(in, "sigma_t").map(v => (v, v.name)) match
          case Some((v, "gridvolume")) =>
            session.translate(v)(grid(in, _, phase, scale)).getOrElse(empty(in))
          case Some((_, "constvolume")) if in.plugin.isOld => uniformExtinction(in, phase, scale)
          case _ if albedoGrid(in).nonEmpty => uniformExtinction(in, phase, scale)
          case volume => boxed(in, volume.map(_._1), phase, scale)
      case _ =>
        Plugins.unsupported(in.plugin, "ignored", session)
        in.ignore(in.plugin.properties.map(_.name)*)
        empty(in)

  /** Of constant extinction. */
  private def uniformExtinction(in: Properties, phase: Phase, scale: Float): MediumDescription =
    albedoGrid(in) match
      case Some(v) => shares(in, v, phase, scale).getOrElse(empty(in))
      case None =>
        homogeneous(in, phase, scale, fixed(in, "albedo", 0.75f), fixed(in, "sigma_t", 1f))

  /** Of constant extinction, which Mitsuba's heterogeneous media have in a box only: that of the
    * volume's unit cube, along the axes of the world.
    */
  private def boxed(
      in: Properties,
      v: Option[Plugin],
      phase: Phase,
      scale: Float
  ): MediumDescription =
    val sigmaT = fixed(in, "sigma_t", 1f)
    val albedo = fixed(in, "albedo", 0.75f)
    val toWorld = v.fold(Transform.Identity)(Properties(_, session).transform("to_world"))
    val corners =
      for x <- Seq(0f, 1f); y <- Seq(0f, 1f); z <- Seq(0f, 1f) yield toWorld.point(Vec3(x, y, z))
    def bound(extremum: Seq[Float] => Float) =
      Array(extremum(corners.map(_.x)), extremum(corners.map(_.y)), extremum(corners.map(_.z)))
    val position = in.pos
    // More cells than one, since pbrt's densities fall to 0 in the outermost
    val density = Array.fill(BoxResolution * BoxResolution * BoxResolution)(1f)
    val gridParams = Seq("nx", "ny", "nz").map(Param.int(_, position, BoxResolution)) ++ Seq(
      Param.floats(ParamType.Point3, "p0", position, bound(_.min)),
      Param.floats(ParamType.Point3, "p1", position, bound(_.max)),
      Param.floats(ParamType.Float, "density", position, density)
    )
    val scattering = coefficients(in, sigmaT * (Rgb.White - albedo), sigmaT * albedo, phase, scale)
    MediumDescription(
      name(in),
      session.declare("Medium", "uniformgrid", position, scattering ++ gridParams),
      GraphicsState.Identity
    )

  /** Cells of such a box along each axis. */
  private val BoxResolution = 8

  private def albedoGrid(in: Properties): Option[Plugin] =
    volume(in, "albedo").filter(_.name == "gridvolume")

  /** A volume, without what keeps a part of it in memory. */
  private def volume(in: Properties, name: String): Option[Plugin] =
    in.objectNamed(name).filter(_.kind == "volume").flatMap: v =>
      if v.name != "volcache" then Some(v)
      else
        session.translate(v): cache =>
          cache.ignore("block_size", "voxel_width", "memory_limit", "step_size_multiplier")
          cache.ignore("to_world")
          cache.nested("volume").headOption

  private def empty(in: Properties): MediumDescription =
    homogeneous(in, Phase.Isotropic, 1f, Rgb.Black, Rgb.Black)

  /** A colour, which may be given as a constant volume. */
  private def fixed(in: Properties, name: String, default: Float): Rgb =
    volume(in, name) match
      case Some(v) if v.name == "constvolume" =>
        colors.everywhere(v, Rgb.gray(default), Role.Unbounded)
      case Some(v) =>
        session.warn(
          Code.Unsupported,
          v.pos,
          s"${v.description} is not supported as `$name`; using $default"
        )
        Rgb.gray(default)
      case None => colors.fixed(in, name, Rgb.gray(default), Role.Reflectance)

  private def homogeneous(in: Properties, phase: Phase, scale: Float, albedo: Rgb, sigmaT: Rgb) =
    // Coefficients may be given instead of albedo and extinction
    val (a, s) =
      if in.contains("sigma_a") || in.contains("sigma_s") then
        (fixed(in, "sigma_a", 0f), fixed(in, "sigma_s", 0f))
      else (sigmaT * (Rgb.White - albedo), sigmaT * albedo)
    described(in, a, s, phase, scale)

  private def described(in: Properties, a: Rgb, s: Rgb, phase: Phase, scale: Float) =
    MediumDescription(
      name(in),
      session.declare("Medium", "homogeneous", in.pos, coefficients(in, a, s, phase, scale)),
      GraphicsState.Identity
    )

  private def coefficients(in: Properties, a: Rgb, s: Rgb, phase: Phase, scale: Float): Seq[Param] =
    val (absorbed, scattered) = phase.reduced(a, s)
    Seq(
      Textures.rgb("sigma_a", absorbed, in.pos),
      Textures.rgb("sigma_s", scattered, in.pos),
      Param.float("scale", in.pos, scale)
    ) ++ phase.params(in.pos)

  /** Extinction by a grid; the albedo may be another. */
  private def grid(
      in: Properties,
      volume: Properties,
      phase: Phase,
      scale: Float
  ): Option[MediumDescription] =
    for
      sigmaT <- volumes(Float.PositiveInfinity)(volume)
      albedo <- albedoGrid(in) match
        case Some(v) => session.translate(v)(volumes(1f)).map(Left(_))
        case None => Some(Right(fixed(in, "albedo", 0.75f)))
    yield
      val file = sigmaT.file
      val position = volume.pos
      val (kind, params) = albedo match
        case Right(a) if file.channels == 1 =>
          val density = Param.floats(ParamType.Float, "density", position, file.values)
          ("uniformgrid", coefficients(in, Rgb.White - a, a, phase, scale) :+ density)
        case _ =>
          val shares = albedo.left.toSeq.flatMap(sigmaT.albedoParams(_, phase.scattered, position))
          ("rgbgrid", cells(in, sigmaT.parted(albedo), position, phase, scale) ++ shares)
      // Beyond a turned grid, Mitsuba goes on to the box along the world's axes
      val fills = Option.when(sigmaT.isTurned)(Param.bool("fillsworldbox", position, true))
      placed(in, kind, params ++ fills, sigmaT, position)

  /** A grid of albedos alone: empty beyond its box, unlike Mitsuba's. */
  private def shares(
      in: Properties,
      v: Plugin,
      phase: Phase,
      scale: Float
  ): Option[MediumDescription] =
    session.translate(v)(volumes(1f)).map: albedo =>
      session.warn(Code.CorrectedValue, v.pos, "the medium ends at the box of its albedos")
      val parted = albedo.sharing(fixed(in, "sigma_t", 1f))
      placed(in, "rgbgrid", cells(in, parted, v.pos, phase, scale), albedo, v.pos)

  private def cells(
      in: Properties,
      coefficients: (Array[Float], Array[Float]),
      at: SourcePos,
      phase: Phase,
      scale: Float
  ): Seq[Param] =
    val share = phase.scattered
    val scattered = coefficients._2.map(_ * share)
    val absorbed = coefficients._1.lazyZip(coefficients._2).map((a, s) => a + s * (1f - share))
    Seq(
      Param.floats(ParamType.Rgb, "sigma_a", at, absorbed),
      Param.floats(ParamType.Rgb, "sigma_s", at, scattered),
      Param.float("scale", in.pos, scale)
    ) ++ phase.params(in.pos)

  private def placed(
      in: Properties,
      kind: String,
      params: Seq[Param],
      grid: PlacedGrid,
      at: SourcePos
  ): MediumDescription =
    MediumDescription(
      name(in),
      session.declare("Medium", kind, in.pos, params ++ grid.params(at)),
      GraphicsState.constant(grid.toWorld)
    )

  private def phaseOf(p: Plugin): Phase =
    Phase.translated(p, session)((in, name) => fixed(in, name, 0.5f).average)
