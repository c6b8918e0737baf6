package candela.cli

import candela.render.*
import candela.render.storage.{FilmFile, FilmHeader, FilmWriter}

import java.io.IOException
import java.nio.file.Path

import scala.util.Try

/** Renders and merges shards of one rendering, on any machine that has its scene. Thread-safe.
  *
  * @param header  describes the whole
  * @param scene   the scene file on this machine
  * @param threads of each shard
  * @throws SceneError if the scene here is not what the header describes
  */
final class ShardRenderer(header: FilmHeader, scene: Path, threads: Int):
  private val options = FilmInput.options(header, scene.toString).copy(threads = Some(threads))
  private val loaded = SceneLoader.FromFile.load(scene.toString, options)
  private val plan = loaded.plan

  for
    difference <- header.difference(FilmHeaders.of(options, header.scene, loaded, scene, Vector()))
  do
    val help = "all files must be in one folder or below it, named relative to the scene"
    FilmInput.fail(s"the scene is not the same on every machine: $difference", help)

  /** Renders a shard to a film file. */
  def render(
      shard: Shard,
      to: Path,
      cancellation: Cancellation,
      onProgress: Progress => Unit
  ): Rendering =
    val checkpointer = new Checkpointer:
      def restore(state: RenderState): Unit = ()
      def isDue: Boolean = false
      def save(state: RenderState): Unit = write(Set(shard.index), shard.count, state, to)
      def lose(): Unit = ()
      def finish(): Unit = ()
    Renderer.render(
      plan, threads, cancellation, onProgress, shard = shard, checkpointer = Some(checkpointer)
    )

  /** Adds up films of different shards; leaves out those that are damaged.
    *
    * @return the shards that are in the result; none: nothing was written
    */
  def merge(films: Vector[Path], to: Path): Set[Int] =
    val (good, shards) = ShardRenderer.distinct(films)
    if good.nonEmpty then
      Renderer.gather(
        plan,
        state =>
          good.foreach(_.load(state))
          write(shards, good.head.header.count, state, to)
      ): Unit
    shards

  private def write(shards: Set[Int], count: Int, state: RenderState, to: Path): Unit =
    val part = header.copy(shards = shards, count = count, done = state.samplesDone)
    val writer = FilmWriter(to)
    writer.write(part, state)
    writer.commit()

object ShardRenderer:

  /** The readable films among `files` that have no shard in common, and their shards. */
  private[cli] def distinct(files: Vector[Path]): (Vector[FilmFile], Set[Int]) =
    files.foldLeft((Vector.empty[FilmFile], Set.empty[Int])):
      case ((films, taken), file) =>
        Try(FilmFile.open(file)).toOption.filter(f => (f.header.shards & taken).isEmpty) match
          case Some(film) => (films :+ film, taken ++ film.header.shards)
          case None => (films, taken)

  /** The shards of a film file; none if it is damaged. */
  def shards(file: Path): Set[Int] =
    try FilmFile.open(file).header.shards
    catch case _: IOException => Set.empty
