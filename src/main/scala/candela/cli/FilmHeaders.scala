package candela.cli

import candela.base.Version
import candela.build.ColorMode
import candela.build.sampling.PointChoice
import candela.film.{Layer, PixelBounds}
import candela.image.Exposure
import candela.render.RenderPlan
import candela.render.storage.FilmHeader
import candela.scenefile.{SceneDescription, SceneFiles}

import java.nio.file.{Files, Path}
import java.security.MessageDigest
import java.util.HexFormat

import scala.util.{Try, Using}

/** Describes renderings for their film files. */
private[cli] object FilmHeaders:

  /** @param film  the film file
    * @param files image files to write
    */
  def of(
      options: Options,
      scene: String,
      loaded: LoadedScene,
      film: Path,
      files: Vector[Path]
  ): FilmHeader =
    val plan = loaded.plan
    val shard = options.film.shard
    FilmHeader(
      Version.current,
      scene,
      relative(film.toAbsolutePath.getParent, here).toString,
      words(options),
      files.map(_.toString),
      digests(loaded.description),
      size(plan),
      plan.sampler.samplesPerPixel,
      done = 0,
      plan.differentialScale,
      Set(shard.index),
      shard.count
    )

  private def here: Path = Path.of("").toAbsolutePath

  /** `to` relative to `from`, or as it is on another drive. */
  private def relative(from: Path, to: Path): Path = Try(from.relativize(to)).getOrElse(to)

  private def size(plan: RenderPlan): String =
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    s"${plan.width}x${plan.height}, pixels $x0 to $x1, $y0 to $y1, " +
      (if plan.sharesSamples then "splatted" else "one pixel each")

  /** Options that shape the image, except the samples per pixel: a command line that selects them.
    */
  def words(o: Options): Vector[String] =
    def one(name: String, value: Option[Any]) =
      value.toVector.flatMap(v => Vector(s"--$name", v.toString))
    def flag(name: String, isSet: Boolean) = Option.when(isSet)(s"--$name").toVector
    val exposure = o.display.exposure match
      case Exposure.Auto => Some("auto")
      case Exposure.Stops(0f) => None
      case Exposure.Stops(n) => Some(n)
    one("seed", Option.when(o.seed != 0)(o.seed)) ++
      flag("quick", o.quick) ++
      one("cropwindow", o.cropWindow.map(w => s"${w.x0},${w.x1},${w.y0},${w.y1}")) ++
      one("aov", Option.when(o.layers.nonEmpty)(o.layers.map(layer(o, _)).mkString(","))) ++
      one("light-groups", o.lightGroups.map(LightGroupWords(_))) ++
      flag("denoise", o.denoise) ++
      one("dialect", o.dialect.map(_.toString.toLowerCase)) ++
      o.defines.toVector.sorted.flatMap((name, value) => Vector("--define", s"$name=$value")) ++
      flag("keep-going", o.keepGoing) ++
      one("color", Option.when(o.color != ColorMode.Auto)(o.color.toString.toLowerCase)) ++
      one("sampler", Option.when(o.points != PointChoice.Best)(o.points.word)) ++
      FireflyTable.words(o.fireflies) ++
      flag("store-time", o.storeTime) ++
      one("tonemap", Option.when(o.display != Options().display)(o.display.curve.word)) ++
      one("exposure", exposure) ++
      flag("falsecolor", o.display.falseColor) ++
      one("bits", Option.when(o.display.bits != 8)(o.display.bits)) ++
      flag("dither", o.display.dithers) ++
      SwitchTable.words(o)

  private def layer(o: Options, layer: Layer): String =
    val precision = o.precisions.collectFirst:
      case (`layer`, isHalf) => if isHalf then ":half" else ":float"
    layer.word + precision.mkString

  /** SHA-256 of the scene's files, by their names relative to the scene's folder. */
  private def digests(scene: SceneDescription): Vector[(String, String)] =
    val files = SceneFiles.of(scene).map(_.toAbsolutePath.normalize)
    val folder = scene.sources.headOption.map(_.toAbsolutePath.normalize.getParent)
    files.map: file =>
      folder.fold(file)(relative(_, file)).toString -> digest(file)

  private def digest(file: Path): String =
    val sum = MessageDigest.getInstance("SHA-256")
    Using.resource(Files.newInputStream(file)): in =>
      val buffer = new Array[Byte](1 << 16)
      var count = in.read(buffer)
      while count >= 0 do
        sum.update(buffer, 0, count)
        count = in.read(buffer)
    HexFormat.of.formatHex(sum.digest)

  /** The digest of a whole rendering, which may have ended by a goal. */
  def digest(header: FilmHeader, goals: FilmOptions): String =
    val ends = goals.time.map("time" -> _) ++ goals.error.map("error" -> _)
    val facts =
      Vector(header.version, header.size, header.samples) ++ header.words ++ header.files ++ ends
    val sum = MessageDigest.getInstance("SHA-256").digest(facts.mkString("\n").getBytes("UTF-8"))
    HexFormat.of.formatHex(sum)
