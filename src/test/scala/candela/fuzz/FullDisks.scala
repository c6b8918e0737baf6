package candela.fuzz

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit
import scala.util.Try

import candela.cli.Captured

/** Disks that get full while files are written: what was there stays, or the new file is whole. */
final class FullDisks private (place: Place, disk: Path) extends Attempts:
  import place.random

  private val jobs = Job.all(place.folder.resolve("disks"), disk)
  private val filler = disk.resolve("filler")

  override def close(): Unit = FullDisks.run("umount", "-l", disk.toString): Unit

  def next(): Attempt =
    val job = jobs(random.nextInt(jobs.size))
    val exists = random.nextInt(4) > 0
    val free = random.nextInt(job.versions(1).length + 20000)
    Attempt(
      s"${job.words(2).mkString(" ")}, with $free bytes free",
      Vector.empty,
      () => judged(job, Option.when(exists)(job.versions(0)), free)
    )

  private def judged(job: Job, before: Option[Array[Byte]], free: Int): Option[String] =
    val _ = Files.deleteIfExists(filler)
    jobs.foreach(j => Files.deleteIfExists(j.file))
    before.foreach(Files.write(job.file, _))
    val room = Files.getFileStore(disk).getUsableSpace
    val _ = Files.write(filler, new Array[Byte]((room - free).max(0).toInt))
    val (code, captured) = Captured.run(job.words(2)*)
    val isNew = Files.exists(job.file) && Files.readAllBytes(job.file).sameElements(job.versions(1))
    val said = captured.err
    val wrong =
      if code == 0 then Option.unless(isNew)("exit code 0, but the file is not written")
      else if code != 1 then Some(s"exit code $code: $said")
      else
        Option.unless(said.contains("No space left") && said.contains(job.file.toString)):
          s"the message names neither reason nor file: $said"
    val _ = Files.delete(filler)
    wrong.orElse(job.broken(before)).orElse(job.next())

object FullDisks:
  def start(place: Place): Either[String, Attempts] =
    val disk = Files.createDirectories(place.folder.resolve("disk"))
    if !run("mount", "-t", "tmpfs", "-o", "size=2m", "none", disk.toString) then
      Left("this user can mount no small disk")
    else
      try Right(new FullDisks(place, disk))
      catch
        case e: Throwable =>
          val _ = run("umount", "-l", disk.toString)
          throw e

  private def run(words: String*): Boolean = Try:
    val process = ProcessBuilder(words*).redirectErrorStream(true).start()
    process.getInputStream.readAllBytes(): Unit
    process.waitFor(10, TimeUnit.SECONDS) && process.exitValue == 0
  .getOrElse(false)
