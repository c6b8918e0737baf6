package candela.fuzz

import java.nio.file.{Files, Path}

import candela.cli.{AnyCommand, Reference, SandboxReferences}

/** Devices, pipes, folders, circles of links, and cut files, wherever a scene names a file. */
final class Devices private (place: Place, hostile: Hostile) extends Attempts:
  import place.random

  private val folder = hostile.folder

  private def one[A](all: IndexedSeq[A]): A = all(random.nextInt(all.size))

  // One of them would write beside the folder
  private val references = SandboxReferences.all.filterNot(_.text.contains("msereferenceout"))

  private val targets =
    hostile.devices ++ hostile.pipes ++ hostile.others ++ Vector(hostile.picture, hostile.cut)

  Files.writeString(folder.resolve("lens.dat"), "35 20 1.5 10\n0 0 0 5\n-35 0 1 10\n")

  /** What a scene names: the file itself, or a link to it that has the suffix of what is expected.
    */
  private def name(reference: Reference): Path =
    val target = one(targets)
    if random.nextBoolean() || reference.file.isEmpty then target
    else
      val link = folder.resolve(s"link.${reference.file}")
      val _ = Files.deleteIfExists(link)
      Files.createSymbolicLink(link, target)

  private def commands(scene: Path, isXml: Boolean): Vector[String] =
    val out = folder.resolve("o.exr").toString
    random.nextInt(6) match
      case 0 | 1 => Vector("check", scene.toString)
      case 2 => Vector("check", scene.toString, "--keep-going")
      case 3 => Vector("convert", scene.toString, "--outfile", folder.resolve("o.pbrt").toString)
      case 4 if !isXml => Vector("preview", scene.toString, "--outfile", out.replace("exr", "png"))
      case _ => Vector("render", scene.toString, "--quiet", "--spp", "1", "--outfile", out)

  /** Commands on files that people name: none of them is a pipe, for which they may wait, and
    * seldom one without end, of which they read as much as fits.
    */
  private def asked(): Vector[String] =
    val isEndless = random.nextInt(500) == 0
    val devices = if isEndless then hostile.devices else hostile.finite
    val files = devices ++ hostile.others :+ hostile.cut
    def file = one(files).toString
    val o = folder.resolve("p.png").toString
    one(Vector(
      Vector("info", file),
      Vector("view", file, "--outfile", o),
      Vector("image", file, "--outfile", o),
      Vector("average", file, file, "--outfile", o),
      Vector("compare", file, hostile.picture.toString),
      Vector("compare", hostile.picture.toString, file),
      Vector("resume", file),
      Vector("merge", file, file, "--outfile", o),
      Vector("check", file),
      Vector("convert", file, "--outfile", folder.resolve("p.pbrt").toString),
      Vector("render", file, "--outfile", folder.resolve("p.exr").toString)
    ))

  def next(): Attempt =
    val base =
      if random.nextInt(4) == 0 then asked()
      else
        val reference = one(references)
        val text = reference.text.replace("FILE", name(reference).toString)
        val scene = Files.writeString(folder.resolve(s"s.${reference.suffix}"), text)
        commands(scene, reference.suffix == "xml")
    val takesSandbox = AnyCommand.options(base.head).exists(_.word == "--sandbox")
    val words = if takesSandbox && random.nextBoolean() then base :+ "--sandbox" else base
    val links = Vector("pbrt", "xml").map(s => folder.resolve(s"s.$s")).filter(Files.exists(_))
    Attempt(words.mkString(" "), links, () => AnyCommand.wrong(words))

object Devices:
  def start(place: Place): Either[String, Attempts] =
    val hostile = Hostile(place.folder.resolve("devices"))
    if hostile.devices.isEmpty || hostile.pipes.isEmpty then Left("there are no devices and pipes")
    else Right(new Devices(place, hostile))
