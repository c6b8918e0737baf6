package candela.site

import java.nio.file.{Files, Path}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** Looks whether each link of the site leads to a file, and to an element of it. */
object Links:
  private val link = "(?:href|src)=\"([^\"]+)\"".r
  private val id = "(?:id|name)=\"([^\"]+)\"".r

  /** What is wrong, one line for each link. */
  def broken(site: Path, pages: Vector[Page]): Vector[String] =
    val texts = pages.map(p => site.resolve(p.address)).map(f => f -> Files.readString(f)).toMap
    val ids = texts.view.mapValues(id.findAllMatchIn(_).map(_.group(1)).toSet).toMap
    for
      (page, text) <- texts.toVector.sortBy(_._1)
      target <- link.findAllMatchIn(text).map(_.group(1)).toVector.distinct
      if !target.matches("[a-z]+:.*")
      (name, anchor) = target.span(_ != '#')
      file = if name.isEmpty then page else page.getParent.resolve(name).normalize
      problem <-
        if !Files.isRegularFile(file) then Some("no such file")
        else
          ids.get(file).filter(known => anchor.length > 1 && !known(anchor.drop(1))).map(_ =>
            "no such heading"
          )
    yield s"${site.relativize(page)}: $target: $problem"

  /** Files that pages load from other hosts; links to them are fine. */
  def foreign(site: Path): Vector[String] =
    val loads = "(?:src|@import|<link[^>]*href)=?\\s*[\"'(]*(https?:[^\"') ]+)".r
    val files = Using.resource(Files.walk(site))(_.iterator.asScala.toVector)
    for
      file <- files if file.toString.matches(".*\\.(html|css|js)")
      load <- loads.findAllMatchIn(Files.readString(file)).map(_.group(1))
    yield s"${site.relativize(file)}: loads $load"
