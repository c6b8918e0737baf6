package candela.cli.options

import candela.job.SceneFormat
import candela.render.Shard
import candela.render.storage.FilmFile
import candela.settings.TextForm

import java.nio.file.{Files, Path}

import scala.util.Try

import scopt.{OParser, Read}

/** Options of saved renderings.
  *
  * @param checkpoint film file to save to; empty: beside the image
  * @param every      seconds between two checkpoints
  * @param shard      part of the samples to take
  * @param partial    whether to merge although shards are missing
  * @param frames     numbers for the scene's name
  * @param skipDone   whether to skip scenes whose images exist already
  */
final case class FilmOptions(
    checkpoint: Option[String] = None,
    every: Option[Double] = None,
    shard: Shard = Shard.Whole,
    partial: Boolean = false,
    frames: Option[Range] = None,
    skipDone: Boolean = false
)

object FilmOptions:
  /** All of them are listed. */
  private[cli] val MaxFrames = 1_000_000

  def isFilm(name: String): Boolean = FilmFile.isName(name)

  /** Whether the rendering is to be saved. */
  private[cli] def asksForFilm(o: Options): Boolean =
    o.film.checkpoint.isDefined || o.outfiles.exists(isFilm)

  /** Gives `--checkpoint` an empty value if another option or a scene follows it. */
  def withValues(args: Seq[String]): Seq[String] =
    args.zipWithIndex.flatMap: (word, i) =>
      val isAlone = word == "--checkpoint" && args.lift(i + 1).forall(isNoFile)
      if isAlone then Seq(word, "") else Seq(word)

  private def isNoFile(word: String): Boolean =
    word.startsWith("-") || !isFilm(word) && isScene(word)

  /** Whether it may be a scene: it is there, or has the name of one. */
  private def isScene(word: String): Boolean =
    Try(Path.of(word)).toOption.forall(p => Files.exists(p) || SceneFormat.named(p).isDefined)

/** Rows of the option table. Each call makes new rows: scopt gives a row one parent. */
private[cli] object FilmTable extends OptionRows:
  private val b = OParser.builder[Options]
  import b.{failure, opt, success}

  private val seconds = reading(TextForm.seconds)

  private given Read[Shard] = Read.reads: text =>
    text.split("/", -1).map(_.trim.toIntOption) match
      case Array(Some(i), Some(n)) if i >= 0 && i < n => Shard(i, n)
      case _ => throw IllegalArgumentException("expected i/n with 0 <= i < n, e.g. 0/4")

  private val Frames = raw"\s*(\d+)\s*(?:-\s*(\d+)\s*(?:x(\d+))?)?".r

  private object Number:
    def unapply(digits: String): Option[Int] = Option(digits).flatMap(_.toIntOption)

  private given Read[Range] = Read.reads: text =>
    text match
      case Frames(Number(first), null, _) => first to first
      case Frames(Number(first), Number(last), null) if first <= last => first to last
      case Frames(Number(first), Number(last), Number(step)) if first <= last && step > 0 =>
        first to last by step
      case _ =>
        throw IllegalArgumentException(
          "expected first-last or first-lastxstep, with first <= last, e.g. 0-350x10"
        )

  private def change(o: Options)(f: FilmOptions => FilmOptions): Options = o.copy(film = f(o.film))

  private[options] def every: Row = opt[Double]("checkpoint-every")(using seconds).valueName("TIME")
    .text("time between two checkpoints, e.g. 10s or 5m (default 60s)")
    .action((s, o) => change(o)(_.copy(every = Some(s))))

  def render: Vector[Row] = Vector(
    opt[String]("checkpoint").valueName("[FILE.film]")
      .text(OptionText(
        "save the rendering every 60 s, by default beside the image; see resume",
        "[Film files](FILMS.md)."
      ))
      .validate: f =>
        if f.isEmpty || FilmOptions.isFilm(f) then success
        else failure(s"--checkpoint needs a name that ends with .film, found `$f`")
      .action((f, o) => change(o)(_.copy(checkpoint = Some(f)))),
    every,
    opt[Shard]("shard").valueName("I/N")
      .text(OptionText(
        "render part I of N of the samples, 0 <= I < N; needs --outfile FILE.film",
        "`merge` combines the parts: [several machines](FILMS.md#several-machines)."
      ))
      .action((s, o) => change(o)(_.copy(shard = s))),
    opt[Range]("frames").valueName("FIRST-LAST[xSTEP]")
      .text(OptionText(
        "render a sequence: %d, or %04d, is the number in the names of files and the values of -D",
        "`0-350x10` are 0, 10, … 350. It implies `--skip-done`: [sequences](FILMS.md#sequences)."
      ))
      .validate: r =>
        // Java has no range so long
        val size = (r.end.toLong - r.start) / r.step + 1
        if size <= FilmOptions.MaxFrames then success
        else failure(s"--frames must be at most ${FilmOptions.MaxFrames} frames, found `$size`")
      .action((r, o) => change(o)(_.copy(frames = Some(r), skipDone = true))),
    opt[Unit]("skip-done")
      .text("skip scenes whose complete image, with the same options, exists")
      .action((_, o) => change(o)(_.copy(skipDone = true)))
  )

  def merge: Vector[Row] = Vector(
    opt[Unit]("partial")
      .text("merge the valid films, without missing, damaged, duplicate and foreign ones")
      .action((_, o) => change(o)(_.copy(partial = true)))
  ) ++ LimitTable.options

  /** Whether the frames of a sequence differ in their scenes, and have files of their own. */
  private def isNumbered(o: Options): Boolean =
    val scenes = o.files ++ o.settings.reading.defines.values
    scenes.exists(FrameNames.hasNumber) && o.outfiles.forall(FrameNames.hasNumber)

  /** What is wrong with the options of `render`, if anything. */
  def problem(o: Options): Option[String] =
    val films = o.outfiles.filter(FilmOptions.isFilm)
    val film = o.film
    if films.size > 1 then Some("--outfile must name at most one .film file, found several")
    else if !film.shard.isWhole && (films.isEmpty || o.outfiles.size > 1) then
      Some("--shard needs --outfile FILE.film, and nothing else")
    else if films.nonEmpty && film.checkpoint.isDefined then
      Some("--outfile FILE.film is the checkpoint: omit --checkpoint")
    else if film.checkpoint.exists(_.nonEmpty) && o.files.size > 1 then
      Some("--checkpoint FILE needs a single scene, found several")
    else if film.frames.isDefined && o.files.size != 1 then
      Some("--frames needs a single scene name, found several, or none")
    else if film.frames.isDefined && !isNumbered(o) then
      Some("--frames needs %d, or %04d, for the number: in the names of the output files, and in " +
        "that of the scene or a value of -D")
    else if !film.shard.isWhole && o.settings.goal.isGiven then
      Some("--shard can't end by --time or --error: all shards need the same samples")
    else None
