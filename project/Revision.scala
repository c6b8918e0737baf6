package packaging

import java.io.File
import java.nio.file.Files

import scala.util.Try

/** Which sources these are.
  *
  * @param release number of the release, or of the next one
  * @param version the same, or with `-SNAPSHOT` where the sources are no release
  * @param commit  of git, with `+` if files differ from it; "" if unknown
  */
final case class Revision(release: String, version: String, commit: String)

object Revision {
  private val Tag = "v(\\d+\\.\\d+\\.\\d+)".r
  private val Digits = 12

  /** By git; or, of sources without it, by what `git archive` has written into `project/commit`.
    *
    * @param next number of the next release
    */
  def of(folder: File, next: String): Revision = {
    val top = git(folder, "rev-parse", "--show-toplevel")
    if (top.exists(path => new File(path).getCanonicalFile == folder.getCanonicalFile)) {
      val isClean = git(folder, "status", "--porcelain").contains("")
      val tags = git(folder, "tag", "--points-at", "HEAD").getOrElse("").split('\n')
      val commit = git(folder, "rev-parse", "HEAD").getOrElse("")
      told(next, if (isClean) tags.toSeq else Nil, commit, if (isClean) "" else "+")
    } else {
      val file = new File(new File(folder, "project"), "commit").toPath
      val words = Try(Files.readString(file)).getOrElse("").trim.split(' ').toSeq
      told(next, words.drop(1), words.head.filter(_ != '$'), "")
    }
  }

  private def told(next: String, tags: Seq[String], commit: String, mark: String): Revision = {
    val hash = commit.take(Digits)
    val known =
      if (hash.nonEmpty && hash.forall(c => "0123456789abcdef".indexOf(c) >= 0)) hash + mark else ""
    tags.collectFirst { case Tag(number) => number } match {
      case Some(number) => Revision(number, number, known)
      case None => Revision(next, s"$next-SNAPSHOT", known)
    }
  }

  private def git(folder: File, words: String*): Option[String] = Try {
    val builder = new ProcessBuilder(("git" +: words): _*).directory(folder)
    val process = builder.redirectError(ProcessBuilder.Redirect.DISCARD).start()
    process.getOutputStream.close()
    val out = new String(process.getInputStream.readAllBytes()).trim
    if (process.waitFor() == 0) Some(out) else None
  }.toOption.flatten
}
