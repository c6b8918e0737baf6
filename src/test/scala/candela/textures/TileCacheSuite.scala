package candela.textures

import candela.concurrency.Parallel
import candela.diagnostics.{Code, SceneError}
import candela.io.CacheFolder
import java.nio.file.{Files, Path}
import java.util.concurrent.atomic.AtomicInteger

import scala.util.Using

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.color.{Encoding, Rgb}
import candela.image.{ImageBands, ImageError}
import candela.render.ThreadPool
import candela.testing.{Draws, TempFolder}

class TileCacheSuite extends AnyFunSuite:

  private def bytes(w: Int, h: Int, channels: Int, seed: Int): Texels =
    val draws = Draws(seed)
    val codes = Array.fill(w * h * channels)((256 * draws.unit()).toInt.toByte)
    ByteTexels(w, h, channels, codes, Array.tabulate(256)(i => Encoding.Srgb.decode(i / 255f)))

  private def floats(w: Int, h: Int, channels: Int, seed: Int): Texels =
    val draws = Draws(seed)
    FloatTexels(w, h, channels, Array.fill(w * h * channels)(draws.unit()))

  private val colors = Vector(Rgb(0.25f, 0.5f, 1f))

  /** What is written of levels, of which the first has been enlarged or not. */
  private def made(levels: Array[Texels], from: Option[Texels] = None) =
    val most = Option.when(levels.length > 1)(1f)
    val bands = TexelBands.of(from.getOrElse(levels(0)))
    val choice = ColorChoice(1 << 20, 1, _ => colors)
    MadeTexels(bands, most, Encoding.Srgb, Option.when(bands.channels == 3)(choice))

  private def pyramid(texels: Texels, wrap: Wrap) =
    Pyramid.levels(texels, wrap, 1f, Parallel.Alone)

  /** The same in bands of few rows, as of a file that is read so. */
  private def inBands(texels: Texels): TexelBands =
    new TexelBands(texels.width, texels.height, texels.channels, texels.meaning):
      def visit(from: Int)(band: (Int, Texels) => Unit): Unit =
        for y <- 0 until height by ImageBands.Rows; end = Math.min(height, y + ImageBands.Rows) do
          if end > from then
            val size = width * (end - y) * channels
            val part =
              if isBytes then
                val codes = Array.tabulate(size)(i => texels.code(y * width * channels + i).toByte)
                ByteTexels(width, end - y, channels, codes, meaning)
              else
                val values = new Array[Float](size)
                val row = new Array[Float](width * channels)
                for k <- y until end do
                  texels.row(k, row)
                  System.arraycopy(row, 0, values, (k - y) * row.length, row.length)
                FloatTexels(width, end - y, channels, values)
            band(y, part)

  /** As little memory as there can be. */
  private def cache(folder: Path, memory: Long = 1, most: Long = Long.MaxValue) =
    new TileCache(new TileMemory(memory), CacheFolder(folder, most))

  private def never(): MadeTexels = fail("the texels are made again")

  private def assertSame(tiles: Array[MipLevel], texels: Array[Texels], wrap: Wrap): Unit =
    val plain = texels.map(MipLevel(_, wrap))
    assert(tiles.length == plain.length)
    val draws = Draws(5)
    for (a, b) <- tiles.zip(plain) do
      assert((a.width, a.height, a.isGray) == (b.width, b.height, b.isGray))
      for _ <- 0 until 60 do
        val (s, row) = (draws.between(-1.5f, 2.5f), draws.between(-1.5f, 2.5f))
        assert(a.bilinear(s, row) == b.bilinear(s, row))
        assert(a.nearest(s, row) == b.nearest(s, row))
    if texels.length > 1 then
      def ewa(levels: Array[MipLevel]) =
        EwaLookup(MipMap.of(levels), 8f, bottomUp = false, turned = false)
      val (a, b) = (ewa(tiles), ewa(plain))
      for _ <- 0 until 60 do
        val size = draws.magnitude(1e-3, 0.1)
        val Seq(x, y, z, w) = Seq.fill(4)(draws.between(-size, size)): @unchecked
        val (s, row) = (draws.unit(), draws.unit())
        assert(a.filtered(s, row, x, y, z, w) == b.filtered(s, row, x, y, z, w))

  private def files(folder: Path): Vector[Path] =
    TempFolder.names(folder).toVector.sorted.map(folder.resolve(_))

  /** Changes some bytes of a file. */
  private def damage(file: Path)(change: Array[Byte] => Array[Byte]): Unit =
    val _ = Files.write(file, change(Files.readAllBytes(file)))

  test("images in tiles have the texels of those in memory, whatever their size, wrap and kind"):
    TempFolder.use: folder =>
      val kinds = Seq((256, 128, 3), (130, 70, 1), (300, 5, 3), (64, 64, 1), (1, 1, 3), (7, 200, 1))
      for ((w, h, channels), i) <- kinds.zipWithIndex do
        val wrap = WrapSuite.All(i % WrapSuite.All.length)
        for texels <- Seq(bytes(w, h, channels, i), floats(w, h, channels, i)) do
          val (whole, plain) = (pyramid(texels, wrap), Array(texels))
          for levels <- Seq(whole, plain) do
            val key = s"$i ${texels.getClass} ${levels.length}"
            val first = cache(folder).image(key, wrap)(() => made(levels, Some(texels)))
            assertSame(first.levels, levels, wrap)
            val second = cache(folder).image(key, wrap)(() => never())
            assertSame(second.levels, levels, wrap)
            assert(second.encoding == Encoding.Srgb)
            assert(second.facts.colors == (if channels == 3 then colors else Vector.empty))

  test("the first texel that is no number is known, in tiles and in memory, and once more"):
    TempFolder.use: folder =>
      val values = Array.fill(130 * 200 * 3)(0.5f)
      values(3 * (150 * 130 + 7) + 1) = Float.NegativeInfinity
      values(3 * (170 * 130 + 2)) = Float.PositiveInfinity
      val texels = FloatTexels(130, 200, 3, values)
      val odd = Some(OddTexel(7, 150, Float.NegativeInfinity))
      for (levels, i) <- Seq(pyramid(texels, Wrap.Repeat), Array[Texels](texels)).zipWithIndex do
        val way = made(levels, Some(texels)).copy(bands = inBands(texels))
        assert(cache(folder).image(s"$i", Wrap.Repeat)(() => way).facts.odd == odd)
        assert(cache(folder).image(s"$i", Wrap.Repeat)(() => never()).facts.odd == odd)
        assert(way.inMemory(Wrap.Repeat, Parallel.Alone)._2.odd == odd)
      // Of bytes, a meaning that none of them has does not count
      val meaning = Array.tabulate(256)(i => if i == 9 then Float.PositiveInfinity else i / 255f)
      val codes = Array.fill[Byte](12)(8)
      assert(ByteTexels(4, 3, 1, codes, meaning).odd.isEmpty)
      codes(6) = 9
      assert(ByteTexels(4, 3, 1, codes, meaning).odd.contains(
        OddTexel(2, 1, Float.PositiveInfinity)
      ))

  test("nothing is left of an image whose file changes while it is read"):
    TempFolder.use: folder =>
      val texels = floats(70, 70, 3, 1)
      val way = made(Array(texels)).copy(confirm =
        () => throw ImageError(Code.Unreadable, "it has changed")
      )
      val error = intercept[ImageError](cache(folder).image("a", Wrap.Repeat)(() => way))
      assert(error.getMessage.contains("it has changed") && files(folder).isEmpty)

  test("an image that is read in bands is in the same file as one in memory", Slow):
    TempFolder.use: folder =>
      val sizes =
        Seq((256, 128), (130, 200), (128, 67), (5, 300), (64, 3), (1, 70), (200, 1), (3, 2))
      for
        ((w, h), i) <- sizes.zipWithIndex
        channels <- Seq(1, 3)
        texels <- Seq(bytes(w, h, channels, i), floats(w, h, channels, i))
        wrap <- WrapSuite.All
      do
        val key = s"$i $channels ${texels.getClass} $wrap"
        val own = folder.resolve(key)
        val levels = pyramid(texels, wrap)
        val whole = made(levels, Some(texels))
        val first = cache(own).image(key, wrap)(() => whole)
        val Vector(file) = files(own): @unchecked
        val content = Files.readAllBytes(file).toVector
        Files.delete(file)
        cache(own).image(key, wrap)(() => whole.copy(bands = inBands(texels))): Unit
        assert(Files.readAllBytes(file).toVector == content, key)
        assertSame(first.levels, levels, wrap)

  test("colours that stand for all are among those that are looked at, band by band"):
    val texels = floats(37, 150, 3, 9)
    val choice = ColorChoice(101, 99, identity)
    var seen = Vector.empty[Rgb]
    inBands(texels).visit(0)((y, band) => seen ++= choice.candidates(band, y.toLong * 37))
    assert(seen == choice.select(texels) && seen.size == (37 * 150 + 100) / 101)

  test("many threads see the same texels in a memory that is much too small"):
    TempFolder.use: folder =>
      val levels = pyramid(bytes(512, 512, 3, 1), Wrap.Repeat)
      val tiles = cache(folder).image("a", Wrap.Repeat)(() => made(levels)).levels
      val plain = levels.map(MipLevel(_, Wrap.Repeat))
      def ewa(of: Array[MipLevel]) = EwaLookup(MipMap.of(of), 8f, bottomUp = true, turned = false)
      val (inTiles, inMemory) = (ewa(tiles), ewa(plain))
      val wrong = AtomicInteger()
      Using.resource(ThreadPool(4)): pool =>
        pool.forEach(8): i =>
          val draws = Draws(i)
          for _ <- 0 until 3000 do
            val (k, s, row) = ((3 * draws.unit()).toInt, draws.unit(), draws.unit())
            if tiles(k).bilinear(s, row) != plain(k).bilinear(s, row) then
              wrong.incrementAndGet(): Unit
            def wide(of: EwaLookup) = of.filtered(s, row, 0.02f, 0.01f, 0.005f, 0.02f)
            if wide(inTiles) != wide(inMemory) then wrong.incrementAndGet(): Unit
      assert(wrong.get == 0)

  test("a damaged tile is found, and its file made again"):
    TempFolder.use: folder =>
      val levels = pyramid(floats(128, 128, 3, 2), Wrap.Clamp)
      cache(folder).image("a", Wrap.Clamp)(() => made(levels)): Unit
      val Vector(file) = files(folder): @unchecked
      val whole = Files.readAllBytes(file).toVector
      for at <- Seq(whole.size - 3, whole.size / 2) do
        damage(file)(all => all.updated(at, (all(at) ^ 1).toByte))
        val again = AtomicInteger()
        val image = cache(folder).image("a", Wrap.Clamp): () =>
          again.incrementAndGet(): Unit
          made(levels)
        assertSame(image.levels, levels, Wrap.Clamp)
        assert(again.get == 1)
        assert(Files.readAllBytes(file).toVector == whole)

  test("a file that is cut, empty, or begins with other bytes is made again"):
    TempFolder.use: folder =>
      val levels = Array(bytes(90, 40, 1, 3))
      cache(folder).image("a", Wrap.Repeat)(() => made(levels)): Unit
      val Vector(file) = files(folder): @unchecked
      val whole = Files.readAllBytes(file).toVector
      val changes = Seq[Array[Byte] => Array[Byte]](
        _.dropRight(1),
        _.take(5),
        _ => Array.emptyByteArray,
        all => all.updated(0, 7.toByte),
        all => all.updated(30, (all(30) ^ 4).toByte),
        all => all ++ all
      )
      for change <- changes do
        damage(file)(change)
        val image = cache(folder).image("a", Wrap.Repeat)(() => made(levels))
        assertSame(image.levels, levels, Wrap.Repeat)
        assert(Files.readAllBytes(file).toVector == whole)

  test("where a damaged tile's image can't be read again, the rendering ends with the reason"):
    TempFolder.use: folder =>
      cache(folder).image("a", Wrap.Repeat)(() => made(Array(bytes(9, 9, 3, 4)))): Unit
      damage(files(folder).head): all =>
        all.updated(all.length - 9, (all(all.length - 9) ^ 1).toByte)
      val image = cache(folder).image("a", Wrap.Repeat): () =>
        throw ImageError(Code.NoSuchFile, "x.png: there is no such file")
      val error = intercept[SceneError](image.levels(0).bilinear(0.5f, 0.5f))
      assert(error.getMessage.contains("x.png: there is no such file"), error.getMessage)

  test("two caches that share a folder make a file once, and one may lose its files"):
    TempFolder.use: folder =>
      val levels = pyramid(bytes(256, 256, 3, 6), Wrap.Repeat)
      val first = cache(folder).image("a", Wrap.Repeat)(() => made(levels))
      val second = cache(folder).image("a", Wrap.Repeat)(() => never())
      // Open files last; where they don't, they can't be deleted
      files(folder).foreach(f => scala.util.Try(Files.delete(f)): Unit)
      assertSame(first.levels, levels, Wrap.Repeat)
      assertSame(second.levels, levels, Wrap.Repeat)

  test("an image whose file can't be written is in memory, and the reason is kept"):
    TempFolder.use: folder =>
      val file = Files.write(folder.resolve("file"), Array.emptyByteArray)
      val levels = pyramid(bytes(64, 32, 3, 7), Wrap.Repeat)
      val images = cache(file)
      assertSame(images.image("a", Wrap.Repeat)(() => made(levels)).levels, levels, Wrap.Repeat)
      assert(images.trouble.exists(_.contains(s"$file")), images.trouble)

  test("the files that were used least recently go when the folder is full"):
    TempFolder.use: folder =>
      val levels = Array(bytes(64, 64, 3, 8))
      for (key, i) <- Vector("a", "b", "c").zipWithIndex do
        val before = TempFolder.names(folder)
        cache(folder).image(key, Wrap.Repeat)(() => made(levels)): Unit
        for name <- TempFolder.names(folder) -- before do
          val time = java.nio.file.attribute.FileTime.fromMillis(1_000_000_000L * (i + 1))
          Files.setLastModifiedTime(folder.resolve(name), time): Unit
      cache(folder).image("a", Wrap.Repeat)(() => never()): Unit
      val size = Files.size(files(folder).head)
      cache(folder, most = 7 * size / 2).image("d", Wrap.Repeat)(() => made(levels)): Unit
      assert(files(folder).size == 3)
      for key <- Vector("a", "c", "d") do
        cache(folder).image(key, Wrap.Repeat)(() => never()): Unit
