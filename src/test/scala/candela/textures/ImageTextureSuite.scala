package candela.textures

import candela.color.{Encoding, Rgb, Srgb}
import candela.geometry.ShadingPoint
import candela.image.{ByteImage, Image, ImageBands, StoredImage}
import org.scalatest.funsuite.AnyFunSuite

class ImageTextureSuite extends AnyFunSuite:

  private def made(
      way: (ImageBands, Float => Float) => TexelBands,
      image: StoredImage,
      decode: Float => Float
  ): Texels = way(ImageBands.of(image), decode).inMemory

  private val linear: Float => Float = x => x

  /** Gray, rows from the top: 0 1 2 / 10 11 12. */
  private val rows = Image(3, 2, Vector("Y"), Array(0f, 1f, 2f, 10f, 11f, 12f))

  private val Bilinear = true
  private val Point = false

  private def lookup(
      image: Image,
      interpolates: Boolean,
      wrap: Wrap = Wrap.Repeat,
      bottomUp: Boolean = true
  ) =
    LevelLookup(
      MipMap.plain(wrap)(() => made(Texels.color, image, linear)),
      interpolates,
      bottomUp,
      true
    )

  extension (lookup: LevelLookup)
    private def color(c: TexCoord): Rgb = lookup.color(UvMapping(1f, 1f, 0f, 0f), at(c.s, c.t))
    private def value(c: TexCoord): Float = lookup.color(c).r

  private def at(u: Float, v: Float): ShadingPoint =
    val point = ShadingPoint()
    point.u = u
    point.v = v
    point

  // Sums of four Floats up to 12.
  private def near(a: Float, b: Float) = Math.abs(a - b) < 1e-5f

  test("texel centres give their texel, v counted from the bottom"):
    for filter <- Seq(Point, Bilinear); x <- 0 until 3; y <- 0 until 2 do
      val place = TexCoord((x + 0.5f) / 3, 1f - (y + 0.5f) / 2)
      assert(near(lookup(rows, filter).value(place), 10f * y + x), s"$filter")

  test("slopes are those of the bilinear patch around the point"):
    val image = Image(3, 3, Vector("Y"), Array(0f, 1f, 5f, 10f, 11f, 12f, -3f, 4f, 2f))
    val wide = Image(4, 2, Vector("Y"), Array(0f, 1f, 5f, 2f, 10f, 11f, 12f, 4f))
    val map = AffineUvMapping(1f, 0.5f, 0f, -0.25f, 1f, 0.1f)
    val d = 1f / 64
    def isWithin(c: TexCoord, of: Image) =
      Seq(c.s * of.width, c.t * of.height).forall: x =>
        val place = x - 0.5f
        Math.abs(place - Math.round(place)) > 1.5f * of.width * d
    var found = 0
    for of <- Seq(image, wide); bottomUp <- Seq(true, false); i <- 0 until 20; j <- 0 until 20 do
      val (u, v) = (i / 20f, j / 20f)
      if isWithin(map(at(u, v)), of) then
        found += 1
        val source = lookup(of, Bilinear, bottomUp = bottomUp)
        val texture = FloatImageTexture(map, source, scale = 2f)
        val slopes = texture.slopes(at(u, v)).nn
        // Of second degree within a patch: central differences are exact, but for rounding
        def along(du: Float, dv: Float) =
          (texture(at(u + du, v + dv)) - texture(at(u - du, v - dv))) / (2 * d)
        assert(Math.abs(slopes.byU - along(d, 0f)) < 2e-3f, s"$u $v")
        assert(Math.abs(slopes.byV - along(0f, d)) < 2e-3f, s"$u $v"): Unit
    assert(found > 400)
    val uv = UvMapping(1f, 1f, 0f, 0f)
    assert(FloatImageTexture(uv, lookup(image, Point)).slopes(at(0.4f, 0.6f)).nn.byU == 0f)
    val levels = Pyramid.of(FloatTexels(2, 2, 1, Array(0f, 1f, 2f, 3f)), Wrap.Repeat, 9f)
    val filtered =
      LevelLookup(MipMap.of(levels), interpolates = true, bottomUp = true, turned = true)
    assert(FloatImageTexture(uv, filtered).slopes(at(0.4f, 0.6f)) == null)

  test("v counted from the top turns the picture over"):
    val down = lookup(rows, Bilinear, bottomUp = false)
    for x <- 0 until 3; y <- 0 until 2 do
      assert(near(down.value(TexCoord((x + 0.5f) / 3, (y + 0.5f) / 2)), 10f * y + x))

  test("halfway between centres, bilinear is the mean and point is one of them"):
    val place = TexCoord(2 / 6f + 1e-6f, 0.5f)
    assert(near(lookup(rows, Bilinear).value(place), 5.5f))
    assert(Set(0f, 1f, 10f, 11f)(lookup(rows, Point).value(place)))

  test("beyond the border, the wrap mode decides what is blended in"):
    val corner = TexCoord(0f, 1f)
    def value(wrap: Wrap) = lookup(rows, Bilinear, wrap).value(corner)
    assert(near(value(Wrap.Repeat), (0f + 2f + 10f + 12f) / 4))
    assert(near(value(Wrap.Clamp), 0f))
    assert(near(lookup(rows, Bilinear, Wrap.Black).value(TexCoord(1f, 0.25f)), 6f))
    assert(lookup(rows, Point, Wrap.Black).value(TexCoord(-0.1f, 0.5f)) == 0f)
    assert(lookup(rows, Point).value(TexCoord(-0.1f, 2.9f)) == 2f)

  test("colours blend channel by channel"):
    val image = Image(2, 1, Image.RgbNames, Array(1f, 2f, 4f, 3f, 6f, 0f))
    for wrap <- Vector(Wrap.Clamp, Wrap.Repeat) do
      val color = lookup(image, Bilinear, wrap).color(TexCoord(0.5f, 0.5f))
      assert(near(color.r, 2f) && near(color.g, 4f) && near(color.b, 2f))
    assert(lookup(image, Point).color(TexCoord(0.9f, 0.1f)) == Rgb(3f, 6f, 0f))

  test("bytes decode by their table, and stay bytes"):
    val codes = Array.tabulate(256 * 3)(i => (i * 7).toByte)
    val stored = ByteImage(16, 16, Image.RgbNames, codes, Encoding.Srgb)
    val texels = made(Texels.color, stored, stored.encoding.decode)
    assert(texels.isInstanceOf[ByteTexels])
    for i <- 0 until 256; c <- 0 until 3 do
      assert(texels(i, c) == Srgb.decode((codes(3 * i + c) & 0xff) / 255f))

  test("alpha is dropped and gray kept in one channel"):
    val gray = Array[Byte](7, 7, 7, 1, 9, 9, 9, 2)
    val texels =
      made(Texels.color, ByteImage(2, 1, Image.RgbNames :+ "A", gray, Encoding.Srgb), linear)
    assert(texels.channels == 1)
    assert(texels(0, 0) == 7 / 255f && texels(1, 0) == 9 / 255f)

  test("numbers from colours: luminance of the stored ones, or the mean of the decoded"):
    val image = Image(1, 1, Image.RgbNames, Array(0.2f, 0.5f, 0.8f))
    val squared: Float => Float = x => x * x
    val y = 0.212671f * 0.2f + 0.715160f * 0.5f + 0.072169f * 0.8f
    assert(near(made(Texels.luminance, image, squared)(0, 0), y * y))
    assert(near(made(Texels.meanOrAlpha, image, squared)(0, 0), (0.04f + 0.25f + 0.64f) / 3))

  test("numbers from pictures with alpha: the alpha, unless it is 1 everywhere"):
    def texels(alpha: Float) =
      val data = Array(0.5f, 0.5f, 0.5f, alpha, 0.5f, 0.5f, 0.5f, 1f)
      made(Texels.meanOrAlpha, Image(2, 1, Image.RgbNames :+ "A", data), linear)
    assert(texels(0.25f)(0, 0) == 0.25f && texels(0.25f)(1, 0) == 1f)
    assert(texels(1f)(0, 0) == 0.5f)

  test("scale multiplies; invert takes from 1 and stops at 0"):
    val source = lookup(Image(1, 1, Vector("Y"), Array(0.25f)), Bilinear)
    val uv = UvMapping(1f, 1f, 0f, 0f)
    assert(FloatImageTexture(uv, source, 2f)(at(0.3f, 0.3f)) == 0.5f)
    assert(FloatImageTexture(uv, source, 2f, invert = true)(at(0.3f, 0.3f)) == 0.5f)
    assert(FloatImageTexture(uv, source, 8f, invert = true)(at(0.3f, 0.3f)) == 0f)
    assert(RgbImageTexture(uv, source, 2f, invert = true)(at(0.3f, 0.3f)) == Rgb.gray(0.5f))
    assert(RgbImageTexture(uv, source)(at(0.3f, 0.3f)) == Rgb.gray(0.25f))

  test("the mapping is applied"):
    val source = lookup(rows, Bilinear)
    val texture = FloatImageTexture(UvMapping(1f, 1f, 1 / 3f, 0f), source)
    assert(near(texture(at(0.5f / 3, 0.75f)), 1f))

  test("wild coordinates give a value between the texels'"):
    val wild = Vector(1e30f, -1e30f, Float.PositiveInfinity, Float.NaN, 2.2e9f, -2.2e9f)
    for wrap <- WrapSuite.All; filter <- Seq(Point, Bilinear); s <- wild; t <- wild do
      val value = lookup(rows, filter, wrap).value(TexCoord(s, t))
      assert(value >= 0f && value <= 12f, s"$wrap, bilinear: $filter, at ($s, $t)")
