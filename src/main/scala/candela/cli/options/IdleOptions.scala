package candela.cli.options

import candela.image.{Contents, DisplayTransform, Exposure, OutputFormat}
import candela.job.SceneFormat

import java.nio.file.Path

import scala.util.Try

/** Options that can have no effect beside the others of a command line. What depends on the scene
  * is reported when it is built.
  */
private[candela] object IdleOptions:

  /** A remark for each. */
  def of(o: Options): Vector[String] = o.command match
    case Command.Render => scenes(o) ++ rendering(o) ++ pictures(o)
    case Command.Preview => scenes(o) ++ pictures(o)
    case Command.Check | Command.Convert | Command.Reference | Command.Move => scenes(o)
    case Command.View | Command.Image | Command.Average => pictures(o) ++ halves(o)
    case Command.Resume => interval(o, isFilm = true)
    case Command.Compare => compared(o.compare)
    case Command.Describe => described(o)
    case Command.Bench | Command.Robustness => CommandService.of(o.command).idle(o)
    case Command.Merge | Command.Info | Command.Explain | Command.Completion | Command.Session =>
      Vector.empty

  def idle(option: String, why: String)(isSo: Boolean): Vector[String] =
    Option.when(isSo)(s"--$option has no effect$why").toVector

  private def scenes(o: Options): Vector[String] =
    val formats = o.files.flatMap(f => Try(SceneFormat.of(Path.of(f))).toOption).distinct
    val names = formats.map(_.name).mkString(" and ")
    idle("dialect", s": $names scenes have no pbrt dialect")(
      formats.nonEmpty && !formats.exists(_.hasDialects) && o.settings.reading.dialect.isDefined
    )

  private def rendering(o: Options): Vector[String] =
    val printed =
      if o.debug then Some("debug") else o.pixelMaterial.map(_ => "pixelmaterial")
    val unwritten = Vector(
      "outfile" -> o.outfiles.nonEmpty,
      "checkpoint" -> o.film.checkpoint.isDefined,
      "report" -> o.reports.nonEmpty,
      "watch" -> o.watch.isDefined,
      "display-server" -> o.displayServer.isDefined,
      "time" -> o.settings.goal.time.isDefined,
      "error" -> o.settings.goal.error.isDefined,
      "denoise" -> o.settings.output.denoise,
      "thumbnail" -> o.thumbnail.isDefined
    )
    val idleOutputs = printed.toVector.flatMap: name =>
      unwritten.flatMap((option, isGiven) => idle(option, s": --$name renders no image")(isGiven))
    val isFilm = FilmOptions.asksForFilm(o)
    val formats = o.outfiles.flatMap(format)
    val isFilmAlone = o.outfiles.nonEmpty && o.outfiles.forall(FilmOptions.isFilm)
    idleOutputs ++ interval(o, isFilm) ++
      idle("write-partial-images", ": only a film is written")(o.partialImages && isFilmAlone) ++
      idle("quick", " beside --resolution and --spp")(
        o.settings.quick && o.settings.reading.resolution.isDefined && o.settings.samples.isDefined
      ) ++
      idle("sample", " without --debug")(o.sample != 0 && !o.debug) ++
      idle("store-time", s": ${listed(formats)} files store no metadata")(
        o.settings.output.storeTime && formats.nonEmpty && formats.forall(!_.keepsTexts)
      )

  private def interval(o: Options, isFilm: Boolean): Vector[String] =
    idle("checkpoint-every", " without --checkpoint or --outfile FILE.film")(
      o.film.every.isDefined && !isFilm
    )

  /** Options of pictures, where none is written or shown. */
  private def pictures(o: Options): Vector[String] =
    val formats = o.outfiles.flatMap(format)
    val isShown = o.thumbnail.isDefined || o.watch.isDefined || o.displayServer.isDefined
    val hasPicture = formats.isEmpty || isShown || formats.exists(_.contents == Contents.Display)
    val plain = DisplayTransform.Plain
    val d = o.display
    val reason = s": ${listed(formats)} files store linear light"
    def unseen(option: String, isGiven: Boolean) = idle(option, reason)(!hasPicture && isGiven)
    unseen("tonemap", d.curve != plain.curve) ++
      unseen("exposure", d.exposure != Exposure.Stops(0f)) ++
      unseen("falsecolor", d.falseColor) ++
      idle("bits", s": only .${OutputFormat.preview.suffix} files may have 16")(
        d.bits == 16 && formats.nonEmpty && !formats.contains(OutputFormat.preview)
      ) ++
      unseen("dither", d.dithers) ++
      idle("dither", " on 16 bits")(
        d.dithers && d.bits == 16 && formats.nonEmpty && formats.forall(_ == OutputFormat.preview)
      )

  private def halves(o: Options): Vector[String] =
    val formats = o.outfiles.flatMap(format)
    val exr = OutputFormat.default
    def exrOnly(option: String, isGiven: Boolean) =
      idle(option, s": only .${exr.suffix} files have it")(isGiven && !formats.contains(exr))
    if formats.isEmpty then Vector.empty
    else exrOnly("half", o.image.isHalf) ++ exrOnly("colorspace", o.image.colorSpace.isDefined)

  private def compared(c: CompareOptions): Vector[String] =
    val isColored =
      c.heatMap.flatMap(format).exists(_.contents == Contents.Display)
    idle("heatmap-metric", " without --heatmap")(
      c.heatMap.isEmpty && c.heatMapMetric != CompareOptions().heatMapMetric
    ) ++ idle("heatmap-metric", ": --bias maps p-values")(
      c.bias && c.heatMap.isDefined && c.heatMapMetric != CompareOptions().heatMapMetric
    ) ++ idle("significance", " without --bias")(
      !c.bias && c.significance != CompareOptions().significance
    ) ++ idle("per-channel", ": --bias tests each channel")(c.bias && c.perChannel) ++ idle(
      "heatmap-max",
      " without --heatmap"
    )(c.heatMap.isEmpty && c.heatMapMax.isDefined) ++
      idle("heatmap-max", ": the map holds numbers, not colours")(
        c.heatMap.isDefined && !isColored && c.heatMapMax.isDefined
      )

  private def described(o: Options): Vector[String] =
    val page = o.pages.lastOption
    val fixedPage =
      page.filter(_ => o.settings.reading.dialect.isDefined).filter(_ != Page.Reference)
    fixedPage.toVector.flatMap(p => idle("dialect", s" with --${p.option}")(true)) ++
      page.toVector.flatMap: p =>
        o.pages.distinct.filter(_ != p).flatMap: other =>
          idle(other.option, s" with --${p.option}, which prints a page of its own")(true)
      ++ page.filter(_ => o.files.nonEmpty).map: p =>
        s"`${o.files.mkString(" ")}` has no effect: --${p.option} prints a whole page"

  private def format(name: String): Option[OutputFormat] =
    Try(Path.of(name)).toOption.flatMap(OutputFormat.of)

  private def listed(formats: Vector[OutputFormat]): String =
    formats.distinct.map(f => s".${f.suffix}").mkString(" and ")
