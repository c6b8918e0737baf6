package candela.site

import java.nio.file.{Files, Path, StandardCopyOption}

import scala.jdk.CollectionConverters.*
import scala.util.Using

/** Makes the site: the repository's pages as static HTML with search, and nothing from other hosts.
  * `./sbt site/run` writes it to `target/site`, and fails if a link is broken.
  */
object Site:
  private val target = Path.of("target", "site")

  def main(args: Array[String]): Unit =
    val repository = Path.of("")
    emptied(target)
    val pages = Page.all(repository)
    val html = Html(repository, pages)
    pages.foreach(html(_): Unit) // finds the listings
    val all = pages ++ html.listings.toVector.map(listing(repository, _, pages))
    val whole = Html(repository, all)
    val frame = Frame(all)
    for page <- all do write(page.address, frame(page, whole(page)))
    for file <- whole.files if Files.isRegularFile(repository.resolve(file)) do
      val to = target.resolve(file)
      val _ = Files.createDirectories(to.getParent)
      val _ = Files.copy(repository.resolve(file), to, StandardCopyOption.REPLACE_EXISTING)
    write("search-index.js", Search.index(all))
    for name <- Vector("search.js", "site.css") do
      Using.resource(getClass.getResourceAsStream(s"/candela/site/$name")): in =>
        write(name, String(in.readAllBytes(), "UTF-8"))
    val wrong = Links.broken(target, all) ++ Links.foreign(target)
    wrong.foreach(println)
    println(s"wrote $target: ${all.size} pages, ${whole.files.size} other files")
    if wrong.nonEmpty then sys.exit(1)

  /** A page that lists the pages of a folder, or its files if it has no pages. */
  private def listing(repository: Path, folder: Path, pages: Vector[Page]): Page =
    val inside = pages.filter(_.path.getParent == folder)
    val files =
      if inside.nonEmpty then Vector.empty
      else
        Using
          .resource(Files.list(repository.resolve(folder)))(_.iterator.asScala.toVector.sorted)
          .filter(Files.isRegularFile(_))
          .map(_.getFileName.toString)
    val lines = inside.map(p => s"- [${p.title}](${p.path.getFileName})") ++
      files.map(f => s"- [$f]($f)")
    val title = folder.getFileName.toString.capitalize
    Page.of(folder.resolve("README.md"), s"# $title\n\n${lines.mkString("\n")}\n")

  private def write(name: String, text: String): Unit =
    val to = target.resolve(name)
    val _ = Files.createDirectories(to.getParent)
    val _ = Files.writeString(to, text)

  private def emptied(folder: Path): Unit =
    if Files.exists(folder) then
      val files = Using.resource(Files.walk(folder))(_.iterator.asScala.toVector)
      files.reverse.foreach(Files.delete)
    val _ = Files.createDirectories(folder)
