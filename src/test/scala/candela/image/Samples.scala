package candela.image

import java.nio.file.{Files, Path}
import scala.jdk.CollectionConverters.*
import scala.util.Random

/** Pictures and folders for the suites of this package. */
object Samples:

  def random(width: Int, height: Int, names: Vector[String], seed: Int): Image =
    val random = Random(seed)
    val data = Array.fill(width * height * names.size)(random.nextFloat() * 3f - 1f)
    Image(width, height, names, data)

  /** Runs `body` in a folder of its own that vanishes afterwards. */
  def inFolder[A](body: Path => A): A =
    val folder = Files.createTempDirectory("candela-image")
    try body(folder)
    finally
      val all = Files.walk(folder)
      try all.iterator.asScala.toVector.reverse.foreach(Files.deleteIfExists(_))
      finally all.close()

  /** What reading gives: the picture or its error; any other exception passes. */
  def attempt(read: => StoredImage): Either[String, StoredImage] =
    try Right(read)
    catch case e: ImageError => Left(e.getMessage)

  /** `count` damaged copies of a file: bytes changed, ends cut off, pieces doubled. */
  def damaged(file: Array[Byte], count: Int, seed: Int): Iterator[Array[Byte]] =
    val random = Random(seed)
    // Most of a header's meaning is in the first bytes; damage there as often as anywhere else.
    def place(length: Int) =
      if random.nextBoolean() then random.nextInt(length) else random.nextInt(Math.min(length, 400))
    Iterator.fill(count):
      random.nextInt(6) match
        case 0 => file.take(place(file.length))
        case 1 =>
          val at = place(file.length)
          file.take(at) ++ file.drop(Math.max(0, at - random.nextInt(20)))
        case _ =>
          val copy = file.clone
          for _ <- 0 to random.nextInt(4) do
            copy(place(copy.length)) = random.nextInt(4) match
              case 0 => 0
              case 1 => -1
              case 2 => 127
              case _ => random.nextInt().toByte
          copy
