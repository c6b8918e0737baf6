package candela.cli

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** A folder that lasts as long as its test. */
object TempFolder:
  def use[A](body: Path => A): A =
    val folder = Files.createTempDirectory("candela-test")
    try body(folder)
    finally delete(folder)

  def delete(folder: Path): Unit =
    Using.resource(Files.walk(folder)): files =>
      files.iterator.asScala.toVector.reverse.foreach(Files.delete)

  def names(folder: Path): Set[String] =
    Using.resource(Files.list(folder))(_.iterator.asScala.map(_.getFileName.toString).toSet)
