package candela.job

import candela.diagnostics.{Code, Problem, SceneError}
import candela.io.Keep
import candela.render.{RenderControl, Rendering}
import candela.render.storage.{FilmFile, FilmHeader}
import candela.settings.BuildControl

import java.io.IOException
import java.nio.file.Path

import scala.util.Try

/** Renders and merges shards of one rendering, on any machine that has its scene. Thread-safe.
  *
  * @param header  describes the whole
  * @param scene   the scene file on this machine
  * @param threads of each shard
  * @param keep    has what other scenes of the process have made
  * @throws SceneError if the scene here is not what the header describes
  */
final class ShardRenderer(
    header: FilmHeader,
    scene: Path,
    threads: Int,
    keep: Keep = Keep.Nothing
) extends AutoCloseable:
  private val settings = FilmHeaders.settings(header)
  private val prepared =
    Render.prepare(
      scene.toString,
      settings,
      BuildControl(threads = threads, cache = keep)
    )

  def close(): Unit = prepared.close()

  for difference <- header.difference(FilmHeaders.of(settings, header.scene, prepared, scene)) do
    val help = "all files must be in one folder or below it, named relative to the scene"
    val message = s"the scene is not the same on every machine: $difference"
    throw SceneError(Problem.general(Code.Cluster, message, Some(help)))

  /** Renders a shard to a film file.
    *
    * @param control but for its threads
    */
  def render(to: Path, control: RenderControl): Rendering =
    prepared.shard(header, to, control.copy(threads = threads))

  /** Adds up films of different shards; leaves out those that are damaged.
    *
    * @return the shards that are in the result; none: nothing was written
    */
  def merge(films: Vector[Path], to: Path): Set[Int] =
    val (good, shards) = ShardRenderer.distinct(films)
    if good.nonEmpty then
      prepared.gather: state =>
        good.foreach(_.load(state))
        Prepared.write(header.merging(good.map(_.header)), state, to)
      : Unit
    shards

object ShardRenderer:

  /** The readable films among `files` that have no shard in common, and their shards. */
  def distinct(files: Vector[Path]): (Vector[FilmFile], Set[Int]) =
    files.foldLeft((Vector.empty[FilmFile], Set.empty[Int])):
      case ((films, taken), file) =>
        Try(FilmFile.open(file)).toOption.filter(f => (f.header.shards & taken).isEmpty) match
          case Some(film) => (films :+ film, taken ++ film.header.shards)
          case None => (films, taken)

  /** The shards of a film file; none if it is damaged. */
  def shards(file: Path): Set[Int] =
    try FilmFile.open(file).header.shards
    catch case _: IOException => Set.empty
