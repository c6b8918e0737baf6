package candela.mitsuba

import candela.base.loop
import candela.color.Rgb
import candela.scenefile.{GraphicsState, MediumDescription, Param, ParamType}

import java.io.IOException
import java.nio.file.Path
import java.nio.ByteOrder

import scala.collection.mutable

/** Translates participating media, each once. */
final class Media(session: Session, colors: Colors):
  private val made = mutable.LinkedHashMap.empty[Plugin, MediumDescription]

  def result(): Vector[MediumDescription] = made.values.toVector

  /** The name of a medium, which is defined at its first use. */
  def apply(p: Plugin): String =
    made.getOrElseUpdate(p, session.of(p)(translated)).name

  private def fresh(in: Asked): String =
    val wanted = in.plugin.id.getOrElse("medium")
    val taken = made.values.map(_.name).toSet
    (Iterator(wanted) ++ Iterator.from(2).map(i => s"$wanted $i")).find(!taken(_)).get

  private def translated(in: Asked): MediumDescription =
    val phase = in.nested("phase").headOption.fold(0f)(asymmetry)
    in.ignore("sample_emitters", "has_spectral_extinction", "majorant_resolution_factor")
    val scale = in.number("scale", 1).toFloat
    in.plugin.name match
      case "homogeneous" =>
        homogeneous(in, phase, scale, fixed(in, "albedo", 0.75f), fixed(in, "sigma_t", 1f))
      case "heterogeneous" =>
        val albedo = fixed(in, "albedo", 0.75f)
        in.objectNamed("sigma_t").filter(_.kind == "volume").map(v => (v, v.name)) match
          case Some((v, "gridvolume")) =>
            session.of(v)(grid(in, _, phase, scale, albedo)).getOrElse(empty(in))
          case _ => homogeneous(in, phase, scale, albedo, fixed(in, "sigma_t", 1f))
      case _ =>
        Plugins.unsupported(in.plugin, "ignored", session)
        in.ignore(in.plugin.properties.map(_.name)*)
        empty(in)

  private def empty(in: Asked): MediumDescription =
    homogeneous(in, 0f, 1f, Rgb.Black, Rgb.Black)

  /** A colour, which may be given as a constant volume. */
  private def fixed(in: Asked, name: String, default: Float): Rgb =
    in.objectNamed(name).filter(_.kind == "volume") match
      case Some(v) if v.name == "constvolume" =>
        session.of(v)(colors.fixed(_, "value", Rgb.gray(default), Role.Plain))
      case Some(v) =>
        session.warn(v.at, s"${v.shown} is not supported as `$name`; using $default")
        Rgb.gray(default)
      case None => colors.fixed(in, name, Rgb.gray(default), Role.Plain)

  private def homogeneous(in: Asked, g: Float, scale: Float, albedo: Rgb, sigmaT: Rgb) =
    // Coefficients may be given instead of albedo and extinction
    val (a, s) =
      if in.has("sigma_a") || in.has("sigma_s") then
        (fixed(in, "sigma_a", 0f), fixed(in, "sigma_s", 0f))
      else (sigmaT * (Rgb.White - albedo), sigmaT * albedo)
    MediumDescription(
      fresh(in),
      session.declare("Medium", "homogeneous", in.at, coefficients(in, a, s, g, scale)),
      GraphicsState.Identity
    )

  private def coefficients(in: Asked, a: Rgb, s: Rgb, g: Float, scale: Float): Seq[Param] = Seq(
    Textures.rgb("sigma_a", a, in.at),
    Textures.rgb("sigma_s", s, in.at),
    Param.float("g", in.at, g),
    Param.float("scale", in.at, scale)
  )

  private def grid(in: Asked, volume: Asked, g: Float, scale: Float, albedo: Rgb) =
    volume.ignore("filter_type", "wrap_mode", "raw", "accel")
    val toWorld = volume.transform("to_world")
    val usesBox = volume.flag("use_grid_bbox", false)
    for
      name <- volume.text("filename").orElse:
        session.error(volume.at, "a gridvolume must have a `filename`")
        None
      path <- session.file(name, volume.atOf("filename"), "skipped")
      file <- session.attempt(VolumeFile.read(path, volume.atOf("filename")))
    yield
      val at = volume.at
      val box = if usesBox then file.bounds else Array(0f, 0f, 0f, 1f, 1f, 1f)
      val params = coefficients(in, Rgb.White - albedo, albedo, g, scale) ++ Seq(
        Param.int("nx", at, file.size(0)),
        Param.int("ny", at, file.size(1)),
        Param.int("nz", at, file.size(2)),
        Param.floats(ParamType.Point3, "p0", at, box.take(3)),
        Param.floats(ParamType.Point3, "p1", at, box.drop(3)),
        Param.floats(ParamType.Float, "density", at, file.values)
      )
      MediumDescription(
        fresh(in),
        session.declare("Medium", "uniformgrid", in.at, params),
        GraphicsState.still(toWorld)
      )

  private def asymmetry(p: Plugin): Float = p.name match
    case "isotropic" => 0f
    case "hg" => session.of(p)(_.number("g", 0.8).toFloat)
    case _ =>
      Plugins.unsupported(p, "using \"isotropic\"", session)
      0f

/** A grid of one channel.
  *
  * @param size   cells along x, y and z
  * @param bounds least and greatest corner
  * @param values x varies fastest
  */
private[mitsuba] final class VolumeFile(
    val size: Array[Int],
    val bounds: Array[Float],
    val values: Array[Float]
)

/** Reads Mitsuba's `.vol` files. */
private[mitsuba] object VolumeFile:
  private val Header = 48

  def read(path: Path, at: candela.base.SourcePos): VolumeFile =
    def fail(why: String) = Values.fail(at, s"can't read the volume `${path.getFileName}`: $why")
    val bytes =
      try MappedFile.read(path)
      catch case e: IOException => fail(Option(e.getMessage).getOrElse(e.toString))
    val in = bytes.order(ByteOrder.LITTLE_ENDIAN)
    if in.remaining < Header || in.get() != 'V' || in.get() != 'O' || in.get() != 'L' then
      fail("it does not begin with VOL")
    if in.get() != 3 then fail("only version 3 is known")
    if in.getInt() != 1 then fail("only 32-bit floats are known")
    val size = Array.fill(3)(in.getInt())
    val channels = in.getInt()
    val bounds = Array.fill(6)(in.getFloat())
    val cells = size.map(_.toLong).product
    if size.exists(n => n < 1 || n > 65536) || cells > in.remaining / 4 then
      fail(s"it is too short for ${size.mkString(" × ")} cells")
    if channels != 1 then fail(s"it has $channels channels; only one is supported")
    val values = new Array[Float](cells.toInt)
    in.asFloatBuffer.get(values)
    loop(values.length)(i => if !(values(i) >= 0f) then values(i) = 0f)
    VolumeFile(size, bounds, values)
