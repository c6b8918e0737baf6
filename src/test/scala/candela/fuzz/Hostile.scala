package candela.fuzz

import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import candela.image.{Image, ImageFiles}

/** What may stand where a file is expected, in a folder of its own: no real device is in reach. */
private[fuzz] final class Hostile(val folder: Path):
  Files.createDirectories(folder)

  private def made(words: String*): Boolean =
    try
      val process = ProcessBuilder(words*).redirectErrorStream(true).start()
      process.getInputStream.readAllBytes(): Unit
      process.waitFor(10, TimeUnit.SECONDS) && process.exitValue == 0
    catch case _: java.io.IOException => false

  /** Devices like those of /dev, or links to them where only an administrator makes devices. */
  val devices: Vector[Path] =
    for
      (name, number) <- Vector("null" -> 3, "zero" -> 5, "full" -> 7)
      file = folder.resolve(name)
      if Files.exists(file) || made("mknod", file.toString, "c", "1", number.toString) ||
        (Files.exists(Path.of(s"/dev/$name")) &&
          Files.exists(Files.createSymbolicLink(file, Path.of(s"/dev/$name"))))
    yield file

  /** Those that have an end, of the others commands read as much as fits into the memory. */
  def finite: Vector[Path] = devices.filter(_.endsWith("null"))

  /** A pipe that nobody writes to, if there are pipes. */
  val pipes: Vector[Path] =
    val file = folder.resolve("pipe")
    if Files.exists(file) || made("mkfifo", file.toString) then Vector(file) else Vector.empty

  private def link(name: String, to: String): Path =
    val file = folder.resolve(name)
    if !Files.isSymbolicLink(file) then
      val _ = Files.createSymbolicLink(file, Path.of(to))
    file

  val others: Vector[Path] = Vector(
    Files.createDirectories(folder.resolve("folder")),
    link("loop-a", "loop-b"),
    link("loop-b", "loop-a"),
    link("nowhere", "missing"),
    link("out", ".."),
    Files.write(folder.resolve("empty"), Array.emptyByteArray),
    Files.write(folder.resolve("zeros"), new Array[Byte](5000)),
    folder.resolve("missing"),
    folder.resolve("missing/too"),
    folder.resolve("x" * 300)
  )

  val picture: Path =
    val file = folder.resolve("picture.png")
    ImageFiles.write(file, Image.rgb(4, 4))
    file

  /** A picture that is cut. */
  val cut: Path = Files.write(folder.resolve("cut.png"), Files.readAllBytes(picture).dropRight(20))
