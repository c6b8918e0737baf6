package candela.bench.peers

import candela.diagnostics.SceneError
import candela.io.WholeFile
import candela.convert.{Converter, SceneText, SideFiles}
import candela.job.Render
import candela.scenefile.*
import candela.settings.{BuildControl, ReadSettings}

import java.io.StringWriter
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.util.Locale

/** The files of a scene, by the formats of programs, and why it has none of the other formats.
  *
  * @param isSame whether the scene's own filter and integrator are those of these files
  */
final case class PeerFiles(
    files: Map[String, Path],
    failures: Map[String, String],
    isSame: Boolean
)

/** Writes a scene for each program in its own format, with the same film, filter and depth of
  * paths: a box filter of one pixel, and a path tracer.
  */
object PeerScenes:
  /** Formats of scenes; [[Rgb]] is one of the others in which colours are red, green and blue. */
  val Exchange = "exchange"
  val Rgb = "rgb"

  /** @param folder receives the files
    * @throws SceneError if the scene can't be read
    */
  def of(source: Path, folder: Path): PeerFiles =
    val read = Parser.validated(Render.read(source, ReadSettings(), BuildControl()))
    val dialect = read.dialect.base
    val scene = normal(read)
    Files.createDirectories(folder): Unit
    val attempts = Vector(Dialect.V2, Dialect.V3, Dialect.V4).map: to =>
      name(to) -> written(scene, to, folder)
    val succeeded = attempts.collect { case (format, Right((file, _))) => format -> file }.toMap
    val failed = attempts.collect { case (format, Left(why)) => format -> why }.toMap
    val exchange = attempts.collectFirst:
      case ("v4", Right((_, converted))) => exchanged(converted, folder)
    .getOrElse(Left(failed("v4")))
    val rgb = exchange.toOption.orElse(succeeded.get(name(Dialect.V3)))
    val plain = if dialect == Dialect.V4 then rgb else succeeded.get(name(dialect))
    PeerFiles(
      succeeded ++ exchange.toOption.map(Exchange -> _) ++ plain.map(Rgb -> _),
      failed ++ exchange.left.toOption.map(Exchange -> _),
      isSame(read)
    )

  private def name(d: Dialect): String = d.toString.toLowerCase(Locale.ROOT)

  /** The file and its scene, or why it can't be written. */
  private def written(
      scene: SceneDescription,
      to: Dialect,
      folder: Path
  ): Either[String, (Path, SceneDescription)] =
    try
      val files = SideFiles(folder)
      files.completing:
        val converted =
          Converter.convert(scene, to, files, Option.when(to != Dialect.V2)(LargeMesh), None)
        val text = StringWriter()
        SceneText.write(filtered(converted.scene), text)
        val file = folder.resolve(s"scene.${name(to)}.pbrt")
        WholeFile.write(file, text.toString.getBytes(UTF_8))
        Right(file -> converted.scene)
    catch case e: SceneError => Left(e.problems.head.message)

  private val LargeMesh = 100

  private def exchanged(scene: SceneDescription, folder: Path): Either[String, Path] =
    val exchangeFolder = folder.resolve(Exchange)
    Files.createDirectories(exchangeFolder): Unit
    val files = SideFiles(exchangeFolder)
    val moved =
      candela.convert.Declarations.map(scene)(candela.convert.FileNames(exchangeFolder).moved)
    try
      files.completing:
        ExchangeScene.write(moved, depth(scene), files) match
          case None => Right(exchangeFolder.resolve("scene.xml"))
          case Some(inexpressible) =>
            val listed = inexpressible.reasons.take(MaxReasons).mkString(", ")
            val remaining = inexpressible.reasons.size - MaxReasons
            Left(s"not converted: $listed${if remaining > 0 then s" and $remaining more" else ""}")
    catch case e: SceneError => Left(e.problems.head.message)

  private val MaxReasons = 3

  /** Rendered by paths, of as many bounces as the scene says. */
  private def normal(scene: SceneDescription): SceneDescription =
    val category = scene.integrator.fold("Integrator")(_.category)
    val hasMedia = scene.media.nonEmpty || scene.volumes.nonEmpty
    val kind = if hasMedia && scene.dialect.base != Dialect.V2 then "volpath" else "path"
    val params = Vector(Param.int("maxdepth", position(scene), depth(scene)))
    val integrator = declaration(scene, category, kind, params)
    filtered(scene.copy(integrator = Some(integrator), renderer = None))

  private def filtered(scene: SceneDescription): SceneDescription =
    val (x, y) =
      if scene.dialect.base == Dialect.V4 then ("xradius", "yradius") else ("xwidth", "ywidth")
    val params = Vector(x, y).map(Param.float(_, position(scene), 0.5f))
    scene.copy(filter = Some(declaration(scene, "PixelFilter", "box", params)))

  private def declaration(
      scene: SceneDescription,
      category: String,
      name: String,
      params: Vector[Param]
  ): Declaration =
    ExchangeScene.plain(category, name).copy(params = params, folder = scene.folder)

  private def position(scene: SceneDescription) =
    scene.camera.fold(candela.diagnostics.SourcePos.Nowhere)(_.pos)

  /** Number of surfaces at which a path scatters, at most. */
  private def depth(scene: SceneDescription): Int =
    scene.integrator.flatMap(_.param("maxdepth")).flatMap(_.ints.headOption).getOrElse(UsualDepth)

  /** pbrt's default. */
  private val UsualDepth = 5

  private def isSame(scene: SceneDescription): Boolean =
    val isOld = scene.dialect.base != Dialect.V4
    val isBox = scene.filter match
      case None => isOld
      case Some(f) =>
        val radii = Seq("xradius", "yradius", "xwidth", "ywidth").flatMap(f.param).map(_.floats)
        f.name == "box" && radii.forall(_.headOption.contains(0.5f))
    val isPath = scene.integrator match
      case None => scene.dialect != Dialect.V2
      case Some(i) => i.name == "path" || i.name == "volpath"
    isBox && isPath
