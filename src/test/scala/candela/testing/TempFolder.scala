package candela.testing

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.{Try, Using}

/** A folder that lasts as long as its test. */
object TempFolder:
  def use[A](body: Path => A): A =
    val folder = Files.createTempDirectory("candela-test")
    try body(folder)
    finally delete(folder)

  /** A process that the test has started and left may still write into it for a moment. */
  def delete(folder: Path): Unit =
    def once(): Unit = Using.resource(Files.walk(folder)): files =>
      files.iterator.asScala.toVector.reverse.foreach(f => Files.deleteIfExists(f): Unit)
    val end = System.nanoTime + 5_000_000_000L
    while Try(once()).isFailure && System.nanoTime < end do Thread.sleep(50)
    if Files.exists(folder) then once()

  def names(folder: Path): Set[String] =
    Using.resource(Files.list(folder))(_.iterator.asScala.map(_.getFileName.toString).toSet)
