package candela.image

import candela.diagnostics.Code
import candela.color.{ColorSpace, Rgb}
import candela.render.ThreadPool
import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

class ExrSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  private def resource(name: String): Array[Byte] =
    getClass.getResourceAsStream(s"/exr/$name.exr").readAllBytes()

  /** What the files in src/test/resources/exr hold; see README.md there. */
  private def expected(channel: Int, x: Int, y: Int): Float =
    (channel + 1) * (x / 4 - 2 * (y / 4)) / 8f

  private def assertHolds(image: Image, order: Vector[(String, Int)]): Unit =
    assert((image.width, image.height) == (37, 21))
    assert(image.channelNames == order.map(_(0)))
    for y <- 0 until 21; x <- 0 until 37; ((name, number), c) <- order.zipWithIndex do
      assert(image(x, y, c) == expected(number, x, y), s"$name at $x, $y")

  private val rgb = Vector("R" -> 0, "G" -> 1, "B" -> 2)

  for name <- Vector(
      "half-none", "half-rle", "half-zips", "half-zip", "half-piz", "half-pxr24", "half-b44",
      "half-b44a", "float-zip", "float-piz", "float-pxr24", "tiled", "tiled-window", "window",
      "decreasing"
    )
  do
    test(s"$name.exr, written by another library, is read exactly"):
      assertHolds(Exr.read(resource(name)), rgb)

  test("threads that encode strips write the file of the whole image"):
    val random = java.util.Random(2)
    val names = Image.RgbNames :+ "depth"
    val data = Array.fill(37 * 75 * 4)(if random.nextInt(3) == 0 then 1f else random.nextFloat)
    val image = Image(37, 75, names, data, colorSpace = ColorSpace.named("rec2020").get)
    val texts = Vector("scene" -> "a.pbrt", "manifest" -> "x" * 100_000)
    val pool = ThreadPool(3)
    def file(rows: Int, window: Option[ImageWindow]) =
      val parts = ExrEncoder.encode(image, texts, _ != "depth", pool, window, 37 * rows)
      parts.toArray.flatMap(part => Array.tabulate(part.remaining)(part.get(_)))
    try
      for window <- Vector(None, Some(ImageWindow(5, 60, 50, 200))) do
        val whole = file(80, window)
        for rows <- Vector(1, 16, 33, 48, 64) do
          assert(java.util.Arrays.equals(file(rows, window), whole), s"$rows rows")
        assert(Exr.read(whole)(36, 74, 3) == data.last)
        for library <- OpenExr.load() do
          val part = ExrHeader.parts(whole).head
          assert(Math.abs(library.read(whole, part, "")(36, 74, 2) - image(36, 74, 2)) < 1e-3f)
    finally pool.close()

  test("of several parts the one with colour is read"):
    assertHolds(Exr.read(resource("multipart")), rgb :+ ("depth.Z" -> 6))
    // The depth before it has floats
    assert(Exr.part(resource("multipart")).precision == "half")

  test("parts with the same pixels are read beside it, under names of their own"):
    val beside = Vector("normal.N.X" -> 4, "normal.N.Y" -> 5, "shadow.R" -> 0, "shadow.depth" -> 6)
    assertHolds(Exr.read(resource("parts")), rgb ++ beside)

  test("channels of any name come after R, G, B and A"):
    val others = Vector("A" -> 3, "N.X" -> 4, "N.Y" -> 5, "depth" -> 6)
    assertHolds(Exr.read(resource("many")), rgb ++ others)

  test("a luminance picture is gray"):
    val image = Exr.read(resource("luminance"))
    assertHolds(image, Vector("Y" -> 0))
    val gray = image.toRgb
    assert(gray.channelNames == Image.RgbNames)
    assert((0 until 3).forall(c => gray(9, 2, c) == expected(0, 9, 2)))

  test("integer channels become floats"):
    val image = Exr.read(resource("integer"))
    val id = image.channelNames.indexOf("id")
    // 16000 times the number of the pixel is a multiple of 128 below 2^31: exact in Float.
    for y <- 0 until 21; x <- 0 until 37 do assert(image(x, y, id) == 16000f * (37 * y + x))

  private val noLibrary = Map(OpenExr.Variable -> "/nowhere/libOpenEXR.so")

  test("what the decoder can't do right is refused by name, without the OpenEXR library"):
    def refusal(name: String) =
      Samples.attempt(Exr.read(resource(name), noLibrary)).swap.toOption.get
    assert(refusal("half-dwaa").contains("or install the OpenEXR library (CANDELA_OPENEXR"))
    assert(refusal("luminance-chroma").contains("channel `BY` is subsampled"))
    assert(refusal("float-b44").contains("B44 is read for half channels only"))
    assert(refusal("half-dwaa").contains("DWAA is not supported"))
    assert(refusal("half-dwab").contains("DWAB is not supported"))
    assert(refusal("half-htj2k").contains("HTJ2K256 is not supported"))

  private def withLibrary(read: => Unit): Unit =
    assume(OpenExr.load().isDefined, "OpenEXR is not installed")
    read

  test("with the OpenEXR library, files of other codings are read"):
    withLibrary:
      assertHolds(Exr.read(resource("float-b44")), rgb)
      for name <- Vector("half-dwaa", "half-dwab") do
        val (image, exact) = (Exr.read(resource(name)), Exr.read(resource("half-zip")))
        assert((image.width, image.height, image.channelNames) == (37, 21, Image.RgbNames))
        // A lossy coding
        assert(image.data.zip(exact.data).forall((a, b) => Math.abs(a - b) < 0.05f), name)

  test("with the OpenEXR library, luminance and chroma become colours"):
    withLibrary:
      val image = Exr.read(resource("luminance-chroma"))
      assert(image.channelNames == Image.RgbNames)
      // Chroma has half the resolution, and luminance a step between columns 17 and 18
      for x <- Vector(3, 33); y <- 0 until 21; (value, c) <- Vector(0.6f, 0.4f, 0.2f).zipWithIndex
      do
        val wanted = if x < 18 then value / 2 else value
        assert(Math.abs(image(x, y, c) - wanted) < 2e-3f, s"$x $y")

  test("a coding that the library doesn't know either is named"):
    withLibrary:
      for message <- Samples.attempt(Exr.read(resource("half-htj2k"))).left do
        assert(message.startsWith("EXR compression HTJ2K256 is not supported, and the OpenEXR"))
        assert(!message.contains(".exr")): Unit

  test("every finite float, infinity and NaN comes back bit for bit"):
    val sizes = for w <- Gen.choose(1, 40); h <- Gen.choose(1, 40) yield (w, h)
    val names = Gen.oneOf(Image.RgbNames, Vector("Y"), Vector("B", "G", "R", "A", "z", "Albedo.R"))
    forAll(sizes, names, Gen.long): (size, names, seed) =>
      val random = scala.util.Random(seed)
      val data = Array.fill(size(0) * size(1) * names.size):
        java.lang.Float.intBitsToFloat(random.nextInt())
      val image = Image(size(0), size(1), names, data)
      val back = Exr.read(Exr.write(image, Vector.empty))
      assert((back.width, back.height) == size)
      assert(back.channelNames.toSet == names.toSet)
      for y <- 0 until size(1); x <- 0 until size(0); (name, c) <- names.zipWithIndex do
        val value = back(x, y, back.channelNames.indexOf(name))
        assert(
          java.lang.Float.floatToRawIntBits(value) ==
            java.lang.Float.floatToRawIntBits(image(x, y, c))
        )

  test("metadata is stored as text attributes"):
    val texts = Vector("scene" -> "küche.pbrt", "candela.samples" -> "16", "empty" -> "")
    val file = Exr.write(Samples.random(5, 4, Image.RgbNames, 1), texts)
    val plain = String(file, "UTF-8")
    for (name, text) <- texts do
      val size = text.getBytes("UTF-8").length.toChar
      assert(plain.contains(s"$name\u0000string\u0000$size\u0000\u0000\u0000$text"))
    assert(Exr.read(file).width == 5)

  test("metadata names that the format can't hold are refused"):
    val image = Image.rgb(1, 1)
    assert(Samples.attempt { Exr.write(image, Vector("" -> "x")); image }.isLeft)
    assert(Samples.attempt { Exr.write(image, Vector("x" * 256 -> "x")); image }.isLeft)

  test("primaries come back with the colours, by name if they have one"):
    val colors = Array(0.5f, 1f, -0.25f)
    def stored(space: ColorSpace) =
      Exr.write(Image(1, 1, Image.RgbNames, colors, colorSpace = space), Vector.empty)
    for space <- ColorSpace.all do
      val image = Exr.read(stored(space))
      assert((image.colorSpace eq space) && image.data.sameElements(colors))
    // Deep: negative in sRGB, and not clipped
    val rec2020 = ColorSpace.named("rec2020").get
    val srgb = Exr.read(stored(rec2020)).toRgb
    val wanted = rec2020.toSrgb * Rgb(0.5f, 1f, -0.25f)
    assert(srgb.colorSpace.isSrgb && srgb(0, 0, 2) == wanted.b && wanted.b < 0f)

  test("primaries that make no colours are refused"):
    val space = ColorSpace.named("rec2020").get
    val file =
      Exr.write(Image(1, 1, Image.RgbNames, Array(1f, 1f, 1f), colorSpace = space), Vector.empty)
    val text = String(file, java.nio.charset.StandardCharsets.ISO_8859_1)
    val at = text.indexOf("chromaticities", text.indexOf("chromaticities") + 1) + 15 + 4
    java.util.Arrays.fill(file, at, at + 32, 0.toByte)
    val message = intercept[ImageError](Exr.read(file)).getMessage
    assert(message == "attribute `chromaticities` is damaged")

  test("another signature is an error, for which the decoder has no message"):
    val file = resource("tiled")
    file(0) = 0
    assert(Samples.attempt(Exr.read(file)).left.exists(_.contains("EXR error")))

  test("damaged files are read or refused, never anything else"):
    val names =
      Vector("half-piz", "half-rle", "half-b44a", "float-pxr24", "tiled", "multipart", "many")
    val outcomes = names.flatMap: name =>
      Samples.damaged(resource(name), 60, seed = name.hashCode).map: file =>
        Samples.attempt(if file.length < 8 then throw ImageError(Code.DamagedImage, "short")
        else Exr.read(file))
    assert(outcomes.exists(_.isLeft))
    assert(outcomes.exists(_.isRight))

  test("parts that begin their channels' names with their own give them up"):
    val named = Vector("R" -> 0, "G" -> 1, "B" -> 2, "Layer.Depth.Z" -> 6)
    assertHolds(Exr.read(resource("parts-named")), named)
    val nowhere = Vector("first.X" -> 4, "second.X" -> 5)
    assertHolds(Exr.read(resource("parts-without-colour")), nowhere)

  test("parts that are not read, and other colours, are a remark"):
    assert(Exr.remark(resource("parts")).contains(
      "part `small` is not read, as it has other pixels than `beauty`"
    ))
    assert(Exr.remark(resource("parts-colours")).contains(
      "the colours are those of part `albedo`, the first of 2 that have some"
    ))
    for name <- Vector("multipart", "parts-named", "tiled") do
      assert(Exr.remark(resource(name)).isEmpty, name)
    assert(Exr.remark(resource("parts").take(60)).isEmpty)

  test("a wrong number of chunks is refused, which the decoder would not survive"):
    val file = resource("multipart")
    val at = file.indexOfSlice("chunkCount".getBytes) + "chunkCount\u0000int\u0000".length + 4
    for value <- Vector[Byte](-1, 0x7f) do
      val damaged = file.clone
      damaged(at + 3) = value
      val message = intercept[ImageError](Exr.read(damaged)).getMessage
      assert(message == "attribute `chunkCount` is damaged")

  test("layers written in 16 or 32 bits are read back"):
    val names = Image.RgbNames ++ Vector("Albedo.R", "P.X", "samples")
    val data = Array.tabulate(6 * 35)(i => (i - 70) * 1.000123f)
    data(4) = 1e6f
    data(5) = Float.PositiveInfinity
    data(6) = -1e6f
    data(7) = Float.NegativeInfinity
    val image = Image(7, 5, names, data)
    val whole = Exr.read(Exr.write(image, Vector.empty))
    assert(whole.channelNames == names && whole.data.sameElements(data))
    val file = Exr.write(image, Vector.empty, WriteOptions(isHalf = true))
    assert(ExrHeader.parts(file).head.channels.forall(_.pixelType == ExrHeader.HalfFloat))
    val half = Exr.read(file)
    assert(half.channelNames == names)
    assert(half.data(4) == 65504f && half.data(5) == Float.PositiveInfinity)
    assert(half.data(6) == -65504f && half.data(7) == Float.NegativeInfinity)
    // Eleven bits, rounded
    for i <- 8 until data.length do
      assert(Math.abs(half.data(i) - data(i)) <= Math.abs(data(i)) / 2048 + 1e-7f): Unit

  test("a crop is stored with its place in the whole image, and is read by itself"):
    val image = Samples.random(7, 35, Image.RgbNames :+ "Z", 1)
    val options = WriteOptions(window = Some(ImageWindow(100, 20, 640, 360)))
    val file = Exr.write(image, Vector("dataWindow of" -> "nothing"), options)
    val part = ExrHeader.parts(file).head
    assert((part.x, part.y, part.width, part.height) == (100, 20, 7, 35))
    assert(part.coding.toMap.apply("window") == "x 100 to 107, y 20 to 55 of 640x360")
    val back = Exr.read(file)
    assert(back.data.sameElements(image.data))
    for library <- OpenExr.load() do
      val halves = library.read(file, part, "")
      // The library reads half floats: of values up to 2, they are off by up to 5e-4
      assert(Math.abs(halves(3, 30, 1) - image(3, 30, 1)) < 2e-3f): Unit

  test("channels may have a precision of their own"):
    val image = Image(1, 1, Image.RgbNames :+ "Z", Array(0.1f, 0.2f, 0.3f, 0.4f))
    def types(options: WriteOptions) =
      ExrHeader.parts(Exr.write(image, Vector.empty, options)).head.channels
        .map(c => c.name -> (c.pixelType == ExrHeader.HalfFloat)).toMap
    val floatDepth = types(WriteOptions(isHalf = true, others = Map("Z" -> false)))
    assert(floatDepth == Map("R" -> true, "G" -> true, "B" -> true, "Z" -> false))
    val halfDepth = types(WriteOptions(others = Map("Z" -> true)))
    assert(halfDepth == Map("R" -> false, "G" -> false, "B" -> false, "Z" -> true))
    val file =
      Exr.write(image, Vector.empty, WriteOptions(isHalf = true, others = Map("Z" -> false)))
    assert(Exr.read(file).data(3) == 0.4f)

  test("tiles are counted over all levels"):
    // By hand, for 37×21 pixels in tiles of 16×8: 3·3, halved to 18×10: 2·2, 9×5: 1, 4×2, 2×1, 1×1.
    assert(ExrTiling(16, 8, 0, roundsUp = false).tiles(37, 21) == 9)
    assert(ExrTiling(16, 8, 1, roundsUp = false).tiles(37, 21) == 9 + 4 + 1 + 1 + 1 + 1)
    // Rounding up: 19×11, 10×6, 5×3, 3×2, 2×1, 1×1.
    assert(ExrTiling(16, 8, 1, roundsUp = true).tiles(37, 21) == 9 + 4 + 1 + 1 + 1 + 1 + 1)
    assert(
      ExrTiling(16, 8, 1, roundsUp = true).sizes(37, 21) ==
        Vector((37, 21), (19, 11), (10, 6), (5, 3), (3, 2), (2, 1), (1, 1))
    )
    assert(
      ExrTiling(16, 8, 1, roundsUp = false).sizes(37, 21) ==
        Vector((37, 21), (18, 10), (9, 5), (4, 2), (2, 1), (1, 1))
    )
    // Across 3+2+1+1+1+1, down 3+2+1+1+1.
    assert(ExrTiling(16, 8, 2, roundsUp = false).tiles(37, 21) == 9 * 8)

  test("a size that the file can't hold is refused before memory is asked for"):
    val file = resource("half-zip")
    val at = file.indexOfSlice("dataWindow".getBytes) + "dataWindow\u0000box2i\u0000".length + 4
    // The window's last column, little-endian: 2^24 columns.
    file(at + 11) = 1
    assert(intercept[ImageError](Exr.read(file)).getMessage.contains("can't be in a file of"))
