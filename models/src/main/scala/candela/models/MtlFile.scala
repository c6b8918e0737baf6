package candela.models

import candela.diagnostics.{Code, SourcePos, Suggest}
import candela.io.InputFile
import candela.scenefile.{LineReader, PlacedText, Source}

import java.nio.file.Path
import java.util.Locale

import scala.collection.mutable

/** An image that a material names.
  *
  * @param file    as the library names it
  * @param scale   of u and v
  * @param offset  of u and v, after the scale
  * @param wrap    beyond 0 to 1
  * @param bump    multiplier of relief
  * @param channel of the image that is used, if the library says
  * @param second  whether by the second set of u and v
  */
private[models] final case class MtlMap(
    file: String,
    scale: (Float, Float) = (1f, 1f),
    offset: (Float, Float) = (0f, 0f),
    wrap: Wraps = Wraps("repeat", "repeat"),
    bump: Float = 1f,
    channel: Option[String] = None,
    second: Boolean = false,
    at: SourcePos
)

/** A material of a library: its statements, by their names in lower case.
  *
  * @param folder of the library, from the model's
  */
private[models] final case class MtlMaterial(
    name: String,
    at: SourcePos,
    folder: String,
    numbers: Map[String, Vector[Float]],
    maps: Map[String, MtlMap]
):
  def number(statement: String): Option[Float] = numbers.get(statement).flatMap(_.headOption)
  def firstMap: Option[SourcePos] = maps.values.map(_.at).headOption

/** The libraries of a model. */
private[models] final class MtlLibraries(session: Session):
  private val materials = mutable.LinkedHashMap.empty[String, MtlMaterial]
  private var hasMissing = false

  def named(name: String): Option[MtlMaterial] = materials.get(name)
  def names: Iterable[String] = materials.keys

  /** Whether all libraries were read: materials are then missing for no other reason. */
  def areComplete: Boolean = !hasMissing

  /** Reads what `mtllib` names: one file whose name may have spaces, or several. */
  def read(names: PlacedText, at: SourcePos): Unit =
    val fullName = names.text
    val all =
      if session.folder.locate(fullName, Some(at)).isDefined then Vector(fullName)
      else
        // `\ ` is a space within a name
        val words = fullName.split("(?<!\\\\)\\s+").toVector.filter(_.nonEmpty)
          .map(_.replace("\\ ", " "))
        if words.size > 1 && words.exists(session.folder.locate(_, Some(at)).isDefined) then words
        else Vector(fullName)
    all.foreach(readOne(_, at))

  private def readOne(name: String, at: SourcePos): Unit =
    session.folder.locate(name, Some(at)) match
      case Some(file) =>
        session.note(file.path)
        Source.read(file) match
          case Right(source) =>
            try parse(file, source, name)
            finally source.close()
          case Left(why) => absent(s"can't read the materials `$name`: $why", None, at)
      case None =>
        val (message, help) =
          session.folder.absence(name, Some(at), s"no such file: `$name`")
        absent(message, help, at)

  private def absent(message: String, help: Option[String], at: SourcePos): Unit =
    hasMissing = true
    session.warn(at, s"$message; faces have the material of none", Code.NoSuchFile, help)

  private def parse(file: InputFile, source: Source, name: String): Unit =
    val parent = Option(Path.of(name.replace('\\', '/')).getParent).fold("")(p => s"$p/")
    val parser = MtlParser(file, source, parent, session)
    for m <- parser.read() if !materials.contains(m.name) do materials(m.name) = m

/** Source: Ramey et al., "MTL material format (Lightwave, OBJ)", Alias|Wavefront, 1995; the
  * statements of physically based materials are those of Clara.io that Blender writes.
  */
private final class MtlParser(
    file: InputFile,
    source: Source,
    folder: String,
    session: Session
):
  import MtlParser.*

  private val in = LineReader(source, continues = true, file.isShown, fail)
  private val all = Vector.newBuilder[MtlMaterial]
  private var material = Option.empty[MtlMaterial]

  private def fail(line: Int, column: Int, message: String): Nothing =
    Session.fail(at(line, column), message, Code.Arguments)

  /** A line that is not to be shown has no place, for an excerpt would show it. */
  private def at(line: Int, column: Int): SourcePos =
    if file.isShown then SourcePos(s"${file.path}", line, column)
    else SourcePos(s"${file.path}", 0, 0)

  def read(): Vector[MtlMaterial] =
    while in.advance() do
      if in.hasNext then
        val position = at(in.line, in.column)
        statement(in.word(), position)
    all ++= material
    all.result()

  private def statement(word: String, at: SourcePos): Unit =
    val key = word.toLowerCase(Locale.ROOT)
    if key == "newmtl" then
      all ++= material
      material = Some(MtlMaterial(in.remainder().text, at, folder, Map.empty, Map.empty))
    else if Meaningless(key) then ()
    else if material.isEmpty then
      val message = s"${in.quoted(word)} belongs to no material; ignored"
      session.warn(at, message, Code.UnknownDirective)
    else if Numbers.contains(key) then numbers(word, at)
    else if Maps.contains(key) then
      for m <- map(at) do
        material = material.map(x => x.copy(maps = x.maps.updated(Maps(key), m)))
    else if Unsupported(key) then session.warn(at, s"`$word` is not supported; ignored")
    else
      val help = if file.isShown then Suggest.help(word, Spellings) else None
      val message = s"unknown statement ${in.quoted(word)}; ignored"
      session.warn(at, message, Code.UnknownDirective, help)

  private def numbers(word: String, at: SourcePos): Unit =
    val key = word.toLowerCase(Locale.ROOT)
    val start = in.mark
    val form = in.word()
    if form == "spectral" || form == "xyz" then
      session.warn(at, s"colours as `$form` are not supported; ignored")
    else
      // `d -halo 0.5`: the halo is a look of the borders
      if form != "-halo" then in.moveTo(start)
      val first = in.finite()
      // A single number is grey
      val values =
        if Numbers(key) == 1 then Vector(first)
        else if !in.hasNext then Vector.fill(3)(first)
        else Vector(first, in.finite(), in.finite())
      // With the digits of the file
      val limited = Ranges.get(key).fold(values): limits =>
        limits(word, values.map(_.toString.toDouble), at, session).map(_.toFloat)
      material = material.map(x => x.copy(numbers = x.numbers.updated(key, limited)))

  /** The options of an image, and its name, which may have spaces. */
  private def map(at: SourcePos): Option[MtlMap] =
    var m = MtlMap("", at = at)
    var isOption = true
    while isOption do
      val start = if in.hasNext then in.mark else -1
      val word = if start >= 0 then in.word() else ""
      word.toLowerCase(Locale.ROOT) match
        case "-s" => m = m.copy(scale = pair(1f))
        case "-o" => m = m.copy(offset = pair(0f))
        case "-bm" => m = m.copy(bump = in.finite())
        case "-clamp" => if in.word() == "on" then m = m.copy(wrap = Wraps("clamp", "clamp"))
        case "-imfchan" => m = m.copy(channel = Some(in.word().toLowerCase(Locale.ROOT)))
        case "-mm" =>
          val (base, gain) = (in.finite(), in.finite())
          if base != 0f || gain != 1f then unsupported("-mm", at)
        case "-t" =>
          val (u, v) = pair(0f)
          if u != 0f || v != 0f then unsupported("-t", at)
        case "-cc" => if in.word() == "on" then unsupported("-cc", at)
        case "-type" => if in.word() != "sphere" then () else unsupported("-type", at)
        case "-colorspace" =>
          in.word(): Unit
          unsupported("-colorspace", at)
        case "-blendu" | "-blendv" | "-texres" | "-boost" => in.word(): Unit
        case _ =>
          isOption = false
          if start >= 0 then in.moveTo(start)
    val name = in.remainder().text
    if name.isEmpty then session.warn(at, "the image has no name; ignored", Code.MissingParameter)
    Option.when(name.nonEmpty)(m.copy(file = name))

  private def unsupported(option: String, at: SourcePos): Unit =
    session.warn(at, s"the option `$option` of an image is not supported; ignored")

  /** One to three numbers, of which the third is for solid textures. */
  private def pair(usual: Float): (Float, Float) =
    val first = in.finite()
    def another() =
      val isNumber = in.hasNext && {
        val start = in.mark
        val isOne = in.word().toFloatOption.isDefined
        in.moveTo(start)
        isOne
      }
      if isNumber then in.finite() else usual
    val second = another()
    val _ = another()
    (first, second)

private object MtlParser:
  /** How many numbers each statement has. */
  val Numbers: Map[String, Int] =
    "ka kd ks ke tf".split(' ').map(_ -> 3).toMap ++
      "ns ni d tr illum pr pm ps pc pcr aniso anisor".split(' ').map(_ -> 1)

  /** The range of the numbers of each statement that has one. */
  val Ranges: Map[String, Limits] =
    "ka kd tf d tr pr pm ps pcr aniso".split(' ').map(_ -> Limits.Unit).toMap ++ Map(
      "ks" -> Limits.NonNegative,
      "ke" -> Limits.NonNegative,
      "ns" -> Limits(0, MtlMaterials.MaxExponent),
      "ni" -> Limits(1),
      "pc" -> Limits(0, 1 / MtlMaterials.CoatOfThickness)
    )

  /** What each image is of. */
  val Maps: Map[String, String] = Map(
    "map_kd" -> "color",
    "map_ke" -> "emission",
    "map_d" -> "opacity",
    "map_ks" -> "specular",
    "map_ns" -> "roughness",
    "map_pr" -> "roughness",
    "map_pm" -> "metallic",
    "map_ps" -> "sheen",
    "map_bump" -> "relief",
    "bump" -> "relief",
    "norm" -> "normals"
  )

  /** No ambient light is traced; the others serve antialiasing. */
  val Meaningless: Set[String] = Set("map_ka", "sharpness", "map_aat")
  val Unsupported: Set[String] =
    Set(
      "kt", "disp", "decal", "refl", "map_refl", "map_tr", "map_pc", "map_pcr", "map_orm", "map_rma"
    )

  val Spellings: Vector[String] =
    ("newmtl Ka Kd Ks Ke Tf Ns Ni d Tr illum Pr Pm Ps Pc Pcr aniso anisor map_Kd map_Ke map_d " +
      "map_Ks map_Ns map_Pr map_Pm map_Ps map_Bump bump norm").split(" ").toVector
