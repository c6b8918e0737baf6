package candela.image

import candela.io.InputFile
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.testing.{Draws, TempFolder, TiledExr}

class ExrLevelsSuite extends AnyFunSuite:

  private def opened(file: Path): ExrLevels = ExrLevels.of(InputFile.named(file)) match
    case Some(Right(levels)) => levels
    case other => fail(s"$other")

  test(
    "tiles have the texels that were written, of all levels, kinds of numbers and compressions",
    Slow
  ):
    TempFolder.use: folder =>
      for
        (w, h) <- Seq((64, 32), (8, 128), (1, 1))
        (tw, th) <- Seq((16, 16), (32, 8), (64, 64))
        names <- Seq(Vector("B", "G", "R"), Vector("Y"), Vector("A", "B", "G", "R"))
        isHalf <- Seq(true, false)
        coding <- Seq(0, 3, 4, 5)
      do
        val draws = Draws(w + tw)
        // Numbers that halves have
        val made = TiledExr(w, h, tw, th, names, isHalf, coding)((_, _, _, _) =>
          draws.below(1000) / 256f
        )
        val levels = opened(made.write(folder.resolve("a.exr")))
        assert(levels.sizes == made.sizes)
        assert((levels.tileWidth, levels.tileHeight) == (tw, th))
        assert(levels.channelNames.toSet == names.toSet)
        for (size, k) <- made.sizes.zipWithIndex; y <- 0 until size._2; x <- 0 until size._1 do
          val tile = levels.tile(k, x / tw, y / th)
          for (name, c) <- tile.channelNames.zipWithIndex do
            val expected = made(k, x, y, names.indexOf(name))
            assert(tile(x % tw, y % th, c) == expected, s"level $k, $x $y $name")

  test("the finest level is what the decoder reads from the whole file"):
    TempFolder.use: folder =>
      val draws = Draws(3)
      val made = TiledExr(32, 16, 8, 8)((_, _, _, _) => draws.unit())
      val file = made.write(folder.resolve("a.exr"))
      val whole = ImageFiles.load(InputFile.named(file)).toImage
      val levels = opened(file)
      for y <- 0 until 16; x <- 0 until 32; c <- 0 until 3 do
        assert(levels.tile(0, x / 8, y / 8)(x % 8, y % 8, c) == whole(x, y, c))

  test("levels that can't be read one by one have a reason; files without levels have none"):
    TempFolder.use: folder =>
      def reason(made: TiledExr) =
        ExrLevels.of(InputFile.named(made.write(folder.resolve("a.exr")))).map(_.left.toOption)
      def black(w: Int, h: Int, tile: Int = 16, mode: Int = 1) =
        TiledExr(w, h, tile, tile, mode = mode)((_, _, _, _) => 0f)
      assert(reason(black(30, 20)).flatten.exists(_.contains("30×20 texels are no powers of two")))
      assert(reason(black(16, 16, mode = 2)).flatten.exists(_.contains("RIP map")))
      assert(reason(black(1024, 1, tile = 512)).flatten.exists(_.contains("512×512")))
      assert(reason(black(16, 16, mode = 0)).isEmpty)
      assert(reason(black(16, 16)).contains(None))

  test("a tile that is damaged or elsewhere is an ImageError, a table that is damaged no levels"):
    TempFolder.use: folder =>
      val made = TiledExr(32, 32, 16, 16)((_, x, y, c) => (x + y * c).toFloat)
      val file = made.write(folder.resolve("a.exr"))
      val bytes = Files.readAllBytes(file)
      def changed(at: Int, by: Int = 1) =
        Files.write(file, bytes.updated(at, (bytes(at) + by).toByte)): Unit
      val first = made.firstChunk
      for at <- Seq(0, 4, 8, 12, 19, 20) do
        changed(first + at)
        intercept[ImageError](opened(file).tile(0, 0, 0)): Unit
      changed(made.table + 7)
      assert(ExrLevels.of(InputFile.named(file)).isEmpty)
      Files.write(file, bytes.take(first)): Unit
      assert(ExrLevels.of(InputFile.named(file)).isEmpty)
