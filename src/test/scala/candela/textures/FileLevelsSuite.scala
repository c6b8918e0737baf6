package candela.textures

import candela.diagnostics.SceneError
import candela.io.{CacheFolder, InputFile}
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.image.ExrLevels
import candela.testing.{Draws, TempFolder, TiledExr}

class FileLevelsSuite extends AnyFunSuite:

  private def opened(file: Path, picked: Int*): FileLevels =
    FileLevels(ExrLevels.of(InputFile.named(file)).get.toOption.get, picked.toVector)

  /** In a memory of a few tiles, and a folder that is never made. */
  private def tiled(levels: FileLevels, wrap: Wrap, folder: Path): Array[MipLevel] =
    val cache = CacheFolder(folder.resolve("none"), Long.MaxValue)
    new TileCache(new TileMemory(1), cache).levels(levels, wrap)

  test("levels of a file have its texels, in memory and in tiles, and nothing is written", Slow):
    TempFolder.use: folder =>
      for
        (w, h, tw, th) <- Seq((128, 64, 16, 16), (256, 256, 40, 24), (8, 64, 64, 64), (1, 1, 9, 9))
        (names, picked) <- Seq(Vector("B", "G", "R") -> Seq(0, 1, 2), Vector("Y") -> Seq(0, 0, 0))
        wrap <- Seq(Wrap.Repeat, Wrap.Black)
      do
        val draws = Draws(w + h + tw)
        val made = TiledExr(w, h, tw, th, names)((_, _, _, _) => draws.unit())
        val file = made.write(folder.resolve(s"$w $h $tw ${names.size} $wrap.exr"))
        val levels = opened(file, picked*)
        val tiles = tiled(levels, wrap, folder)
        for ((lw, lh), k) <- made.sizes.zipWithIndex do
          val texels = levels.texels(k)
          assert((texels.width, texels.height, texels.channels) == (lw, lh, names.size))
          for y <- 0 until lh; x <- 0 until lw; c <- names.indices do
            // The image has red first, the file blue
            assert(texels(y * lw + x, c) == made(k, x, y, names.size - 1 - c))
          val plain = MipLevel(texels, wrap)
          for _ <- 0 until 50 do
            val (s, row) = (draws.between(-1f, 2f), draws.between(-1f, 2f))
            assert(tiles(k).bilinear(s, row) == plain.bilinear(s, row))
            assert(tiles(k).nearest(s, row) == plain.nearest(s, row))
      assert(!Files.exists(folder.resolve("none")))

  test("a damaged tile ends the rendering, with its file and place"):
    TempFolder.use: folder =>
      val made = TiledExr(64, 64, 32, 32)((_, x, y, _) => (x * y).toFloat)
      val file = made.write(folder.resolve("a.exr"))
      val bytes = Files.readAllBytes(file)
      Files.write(file, bytes.patch(made.firstChunk + 20, Array.fill(9)(77.toByte), 9)): Unit
      val levels = tiled(opened(file, 0, 1, 2), Wrap.Repeat, folder)
      val error = intercept[SceneError](levels(0).nearest(0f, 0f))
      assert(error.getMessage.contains(s"$file: tile 0, 0 of level 0"), error.getMessage)
