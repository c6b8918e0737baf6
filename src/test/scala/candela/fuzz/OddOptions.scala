package candela.fuzz

import java.nio.file.Files

import candela.cli.{AnyCommand, Captured}
import candela.image.{Image, ImageFiles}

/** Command lines with odd options and values. */
final class OddOptions(place: Place) extends Attempts:
  import OddOptions.*
  import place.random

  private val folder = Files.createDirectories(place.folder.resolve("options"))
  private val hostile = Hostile(folder.resolve("hostile"))

  private def file(name: String): String = folder.resolve(name).toString
  private def one[A](all: IndexedSeq[A]): A = all(random.nextInt(all.size))

  Files.writeString(folder.resolve("s.pbrt"), SmallScene.v4("path"))
  Files.writeString(folder.resolve("old.pbrt"), SmallScene.v3("path"))
  Files.writeString(folder.resolve("m.xml"), SmallScene.document)
  for name <- Vector("a.exr", "b.exr", "a.png") do
    ImageFiles.write(folder.resolve(name), Image.rgb(4, 4))
  private val film =
    val words = Vector(file("s.pbrt"), "--quiet", "--outfile", file("a.film"))
    val (code, captured) = Captured.run(words*)
    require(code == 0, captured.err)
    Files.readAllBytes(folder.resolve("a.film"))

  /** Names of files, none of which is outside of the folder. */
  private def path(): String =
    val stem = random.nextInt(6) match
      case 0 => one(hostile.devices ++ hostile.others).toString
      case 1 => file(one(Vector("a\nb", "\u001b[2J", "ä\ud83d\ude00", "y" * 250, "a b", "'", "-")))
      case 2 => s"$folder/a\u0000b"
      case 3 => one(Vector(file("s"), file("a"), file("missing/a"), folder.toString))
      case _ => file("o")
    if random.nextInt(5) == 0 then stem else stem + one(Suffixes)

  private def inputs(command: String): Vector[String] = command match
    case "render" | "check" | "convert" | "preview" =>
      Vector(file(one(Vector("s.pbrt", "s.pbrt", "old.pbrt", "m.xml"))))
    case "resume" | "merge" => Vector(file("a.film"))
    case "compare" => Vector(file("a.exr"), file("b.exr"))
    case "bench" => Vector(file("missing.conf"))
    case "describe" => one(Vector(Vector.empty, Vector("shape"), Vector("shape", "sphere")))
    case "explain" => one(Vector(Vector.empty, Vector("E0201"), Vector("E9999", "201")))
    case "completion" => Vector(one(Vector("bash", "zsh", "fish", "powershell", "sh")))
    case _ => Vector(file(one(Vector("a.exr", "a.png"))))

  private def output(command: String): Vector[String] =
    val name = command match
      case "convert" => "o.pbrt"
      case "describe" => "o.md"
      case "view" | "preview" => "o.png"
      case "render" | "merge" | "image" | "average" => "o.exr"
      case _ => ""
    if name.isEmpty then Vector.empty else Vector("--outfile", file(name))

  private def value(name: String, wanted: String): String =
    // Never what another machine is asked for
    if name == "--display-server" || name == "--watch" then one(Addresses)
    else if Vector("FILE", "FOLDER", "DIR").exists(wanted.contains) then path()
    else Odd.text(wanted, random)

  private def odd(command: String): Vector[String] =
    val all = AnyCommand.options(command).filterNot(o => Waiting(o.word))
    if all.isEmpty then Vector.empty
    else
      val o = one(all)
      val name = if random.nextInt(20) == 0 then o.word.drop(1).toUpperCase else o.word
      o.value match
        case None if random.nextInt(10) > 0 => Vector(name)
        case None => Vector(s"$name=${Odd.text("", random)}")
        case Some(wanted) =>
          random.nextInt(8) match
            case 0 => Vector(s"$name=${value(o.word, wanted)}")
            // Without its value, other words may become names of files
            case 1 if !wanted.contains("FILE") => Vector(name)
            case _ => Vector(name, value(o.word, wanted))

  def next(): Attempt =
    val command = one(Commands)
    val count = 1 + random.nextInt(4) * random.nextInt(2)
    val odds = Vector.fill(count)(odd(command)).flatten
    val usual = output(command) ++ inputs(command)
    val words = command +: (if random.nextBoolean() then odds ++ usual else usual ++ odds)
    Attempt(shown(words), Vector.empty, () => judged(words))

  private def judged(words: Vector[String]): Option[String] =
    val _ = Files.write(folder.resolve("a.film"), film)
    AnyCommand.wrong(words)

  private def shown(words: Vector[String]): String =
    words.map(w => if w.length > 200 then s"${w.take(20)}…(${w.length})" else w)
      .map(w => s"'${w.flatMap(c => if c < ' ' then f"\\u${c.toInt}%04x" else c.toString)}'")
      .mkString(" ")

private object OddOptions:
  private val Commands = AnyCommand.options.keys.toVector.sorted

  private val Suffixes =
    Vector(".exr", ".exr", ".png", ".film", ".pbrt", ".html", ".json", ".csv", ".jpg", ".txt", ".")

  /** Options that wait for people. */
  private val Waiting = Set("--watch-after")

  private val Addresses = Vector(
    "", "0", "-1", "65536", "nan", ":", "127.0.0.1:", "127.0.0.1:1", "127.0.0.1:0",
    "127.0.0.1:65536", "127.0.0.1:-1", "[::1]:1", "[::1", "127.0.0.1:nan", "127.0.0.1:1:2"
  )
