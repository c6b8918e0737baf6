package candela.fuzz

import java.io.ByteArrayOutputStream
import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.util.zip.CRC32C

import candela.cli.{AnyCommand, Captured}

/** Film files with values that no rendering has, and right checksums. */
final class ForgedFilms(place: Place) extends Attempts:
  import ForgedFilms.*
  import place.random

  private val folder = Files.createDirectories(place.folder.resolve("films"))
  private val hostile = Hostile(folder.resolve("hostile"))

  private def file(name: String): String = folder.resolve(name).toString
  private def one[A](all: IndexedSeq[A]): A = all(random.nextInt(all.size))

  /** Film files and scenes, and what they were. */
  private val corpus: Vector[Film] =
    for ((integrator, words), i) <- Renderings.zipWithIndex yield
      val scene = folder.resolve(s"$i.pbrt")
      val _ = Files.writeString(scene, SmallScene.v4(integrator))
      val film = file(s"$i.film")
      val outputs =
        if words.contains("--shard") then Vector("--outfile", film)
        else Vector("--outfile", file(s"$i.exr"), "--checkpoint", film)
      val (code, captured) = Captured.run((scene.toString +: "--quiet" +: words) ++ outputs*)
      require(code == 0, captured.err)
      Film(scene, Files.readAllBytes(Path.of(film)))

  private val parsed = corpus.map(f => FilmValues.of(f.bytes))
  private val scenes = corpus.map(f => Files.readString(f.scene))

  for (film, values) <- corpus.zip(parsed) do
    require(FilmValues.bytes(values).sameElements(film.bytes), "films are not understood")

  private val texts = parsed.flatten.collect { case FilmValue.Text(t) => t }
  private val names = (hostile.finite ++ hostile.others).map(_.toString)

  private def forged(values: Vector[FilmValue]): Vector[FilmValue] =
    // The state is one value of many, but as hostile as all others
    val at = if random.nextInt(3) == 0 then values.size - 1 else random.nextInt(values.size)
    random.nextInt(12) match
      case 0 => values.patch(at, Nil, 1)
      case 1 => values.patch(at, Vector(values(at)), 0)
      case 2 => values.updated(at, one(one(parsed)))
      case _ => values.updated(at, odd(values(at)))

  private def odd(value: FilmValue): FilmValue = value match
    case FilmValue.Number(old) =>
      FilmValue.Number(one(Odd.Ints ++ Vector(old + 1, old - 1, old * 2, random.nextInt())))
    case FilmValue.Real(_) =>
      FilmValue.Real(one(Vector(0f, -0f, 1f, -1f, 1e30f, 1e-45f, Float.NaN, Float.MaxValue) ++
        Vector(Float.PositiveInfinity, Float.NegativeInfinity)))
    case FilmValue.Text(old) =>
      FilmValue.Text(one(Vector(
        "",
        s"$old ",
        old.drop(1),
        s"$old\u0000",
        "\u001b[2J",
        "..",
        "/",
        ForgedFilms.Long,
        "ä\ud83d\ude00",
        "--spp",
        "--seed",
        "--watch",
        "--outfile",
        "--help",
        "4x4",
        one(texts),
        one(names),
        s"${one(names)}.exr",
        file("new.exr"),
        Odd.text("", random)
      )))
    case FilmValue.State(bytes) => FilmValue.State(broken(bytes))

  private def broken(state: Array[Byte]): Array[Byte] =
    val buffer = ByteBuffer.wrap(state.clone).order(LITTLE_ENDIAN)
    val near = if random.nextBoolean() then state.length else state.length.min(80)
    val at = if near < 12 then 0 else random.nextInt((near - 8) / 4) * 4
    random.nextInt(6) match
      case 0 => state.take(at)
      case 1 => state ++ state.drop(at)
      case 2 if state.length >= 8 => buffer.putLong(at, one(Odd.Longs)).array
      case 3 if state.length >= 8 => buffer.putDouble(at, one(Odd.Doubles)).array
      case _ if state.length >= 8 => buffer.putInt(at, one(Odd.Ints)).array
      case _ => state.take(at)

  def next(): Attempt =
    val i = random.nextInt(corpus.size)
    val all = (0 to random.nextInt(3)).foldLeft(parsed(i))((v, _) => forged(v))
    val film = file("forged.film")
    val others = Vector.fill(random.nextInt(3))(file(s"${random.nextInt(corpus.size)}.film"))
    val words = random.nextInt(6) match
      case 0 | 1 => Vector("info", film)
      case 2 => Vector("merge", film, "--outfile", file("merged.exr")) ++ others
      case 3 => Vector("merge", film, "--partial", "--outfile", file("merged.film")) ++ others
      case 4 => Vector("resume", film)
      case _ => Vector("resume", film, "--spp", (1 + random.nextInt(9)).toString)
    val guarded =
      if words.head != "info" && random.nextInt(4) == 0 then words :+ "--sandbox" else words
    Attempt(
      guarded.mkString(" "),
      Vector(Path.of(film)),
      () => judged(guarded, Path.of(film), FilmValues.bytes(all))
    )

  private def judged(words: Vector[String], film: Path, bytes: Array[Byte]): Option[String] =
    val previous = film.resolveSibling("forged.film.previous")
    val _ = Files.deleteIfExists(previous)
    val _ = Files.write(film, bytes)
    val wrong = AnyCommand.wrong(words)
    val changed = corpus.zip(scenes).find((f, text) => Files.readString(f.scene) != text)
    // What is kept of a finding is the forged film
    for _ <- wrong do Files.write(film, bytes)
    wrong.orElse(changed.map((f, _) => s"`${f.scene}` was overwritten"))

private object ForgedFilms:
  private val Long = "a" * 100000

  /** Every kind of state: integrators, and options. */
  private val Renderings = Vector(
    "path" -> Vector.empty,
    "path" -> Vector("--shard", "1/3"),
    "path" -> Vector("--aov", "albedo,normal,depth,variance"),
    "path" -> Vector("--guiding", "on", "--spp", "8"),
    "path" -> Vector("--fireflies", "reweight"),
    "path" -> Vector("--color", "spectral"),
    "bdpt" -> Vector.empty,
    "mlt" -> Vector.empty,
    "sppm" -> Vector.empty
  )

  final case class Film(scene: Path, bytes: Array[Byte])

/** A value of a film file. */
private[candela] enum FilmValue:
  case Number(value: Int)
  case Real(value: Float)
  case Text(value: String)

  /** What was rendered. */
  case State(bytes: Array[Byte])

/** The format of film files, as far as their headers go: said again, so that it can be broken. */
private[candela] object FilmValues:
  import FilmValue.*

  /** Bytes of length and checksum. */
  private val Trailer = 16

  def of(file: Array[Byte]): Vector[FilmValue] =
    val in = ByteBuffer.wrap(file.dropRight(Trailer)).order(LITTLE_ENDIAN)
    val all = Vector.newBuilder[FilmValue]
    def number(): Int =
      val n = in.getInt()
      all += Number(n)
      n
    def text(): Unit =
      val bytes = new Array[Byte](in.getInt())
      in.get(bytes)
      all += Text(String(bytes, UTF_8)): Unit
    // Mark, version, scene, folder, size
    for _ <- 0 until 5 do text()
    for _ <- 0 until 3; _ <- 0 until number() do text()
    // Samples, those done, size of the footprint, number of shards, and which
    for _ <- 0 until 2 do number()
    all += Real(in.getFloat())
    number()
    for _ <- 0 until number() do number()
    // The error, the scene's text
    for _ <- 0 until 2 do text()
    val rest = new Array[Byte](in.remaining)
    in.get(rest)
    all += State(rest)
    all.result()

  /** The file, with length and checksum. */
  def bytes(values: Vector[FilmValue]): Array[Byte] =
    val all = ByteArrayOutputStream()
    values.foreach(v => all.write(bytes(v)))
    val body = all.toByteArray
    val sum = CRC32C()
    sum.update(body)
    val end = ByteBuffer.allocate(Trailer).order(LITTLE_ENDIAN)
    body ++ end.putLong(body.length.toLong).putLong(sum.getValue).array

  private def bytes(value: FilmValue): Array[Byte] =
    def four = ByteBuffer.allocate(4).order(LITTLE_ENDIAN)
    value match
      case Number(n) => four.putInt(n).array
      case Real(x) => four.putFloat(x).array
      case State(all) => all
      case Text(text) =>
        val all = text.getBytes(UTF_8)
        four.putInt(all.length).array ++ all
