package candela.cluster

import candela.io.{Keep, Scratch}
import candela.job.ShardRenderer

import java.nio.file.{Files, Path}

import scala.collection.mutable
import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** The scenes that an executor has unpacked and built, for all of its tasks. */
object ExecutorScenes:
  private lazy val root: Path =
    val scratch = Scratch.create()
    val cleanUp: Runnable = () => scratch.close()
    Runtime.getRuntime.addShutdownHook(Thread(cleanUp))
    scratch.folder

  // Frames of a sequence have most in common
  private val cache = Keep()

  // By bundle; the latest last. Others wait while one is built.
  private val scenes = mutable.LinkedHashMap.empty[String, ShardRenderer]

  def renderer(work: Assignment): ShardRenderer = synchronized:
    val key = s"${work.digest} ${work.header.words} ${work.header.samples}"
    val cached = scenes.remove(key)
    val renderer = cached.getOrElse:
      val folder = newFolder()
      // The scene is in memory once it is built.
      try ShardRenderer(work.header, work.bundle.value.unpack(folder), work.threads, cache)
      finally delete(folder)
    scenes += key -> renderer
    // A sequence renders a few at a time.
    while scenes.size > MaxScenes do
      val (oldest, its) = scenes.head
      scenes -= oldest
      its.close()
    renderer

  def newFolder(): Path = Files.createTempDirectory(root, "work")

  /** Name of a new file in a new folder. */
  def newFile(): Path = newFolder().resolve("shard.film")

  private val MaxScenes = 2

  private def delete(folder: Path): Unit =
    val _ = Try:
      Using.resource(Files.walk(folder))(_.iterator.asScala.toVector.reverse.foreach(Files.delete))
