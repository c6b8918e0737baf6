package candela.convert

import candela.base.Decimal
import candela.diagnostics.Code
import candela.color.{Rgb, Srgb}
import candela.math.pow
import candela.scenefile.*

import java.util.Locale

/** Textures, from v4 to v3. */
object ToV3Textures:
  import Steps.*

  /** v3 supports sRGB's curve only, and no inversion: other encodings are baked into a new image,
    * as are formats that it can't read.
    */
  private val file: Step =
    Step("`filename`, `encoding`, `invert`", "`filename`, `gamma`; or a new image as EXR"): s =>
      val (encoding, inverts) = (s.takeString("encoding", "sRGB"), s.takeBool("invert", false))
      for p <- s.take("filename") do
        val name = fileName(p)
        val isPng = name.endsWith(".png")
        val isKnown = Seq(".png", ".tga", ".exr", ".pfm").exists(name.endsWith)
        val decode = decoding(name, encoding)
        val isBaked = isPng && encoding.startsWith("gamma") ||
          name.endsWith(".exr") && RewrittenImages.hasOtherPrimaries(s, p)
        if isKnown && !inverts && !isBaked then
          s.add("filename", p)
          if isPng && encoding == "linear" then s.addBool("gamma", false)
        else
          val decoded = (x: Float, _: Int) => if inverts then 1f - decode(x) else decode(x)
          s.addString("filename", RewrittenImages.baked(s, p, (encoding, inverts))(decoded))(using
            p.pos
          )

  private def fileName(p: Param) = p.strings.headOption.getOrElse("").toLowerCase(Locale.ROOT)

  private def decoding(name: String, encoding: String): Float => Float =
    val isPng = name.endsWith(".png")
    encoding.split(' ') match
      case _ if Seq(".exr", ".pfm", ".hdr").exists(name.endsWith) => identity
      case Array("linear") if isPng => identity
      case Array("gamma", g) if isPng && Decimal.float(g).nonEmpty => pow(_, g.toFloat)
      case _ => Srgb.decode(_)

  /** v4 takes the mean of what it decodes, v3 decodes the luminance of float textures. */
  private val mean: Step =
    Step("`filename` of a coloured image", "the mean of its channels, as a new image"): s =>
      for p <- s.peek("filename") do
        def word(name: String) = s.peek(name).flatMap(_.strings.headOption)
        val encoding = word("encoding").getOrElse("sRGB")
        val inverts = s.peek("invert").exists(_.bools.contains(true))
        val decode = decoding(fileName(p), encoding)
        def number(stored: Rgb) =
          val mean = (decode(stored.r) + decode(stored.g) + decode(stored.b)) / 3f
          if inverts then 1f - mean else mean
        for name <- RewrittenImages.numbers(s, p, (encoding, inverts))(number) do
          Seq("filename", "encoding", "invert").foreach(s.take)
          s.addString("filename", name)(using p.pos)

  private val filter: Step = Step("`filter`", "`trilinear`, for all but \"ewa\""): s =>
    val p = s.take("filter")
    val kind = p.flatMap(_.strings.headOption).getOrElse("bilinear").toLowerCase(Locale.ROOT)
    if kind != "ewa" then s.addBool("trilinear", true)
    for q <- p if kind == "point" do
      s.warn(
        Code.Inexpressible,
        q.pos,
        "v3 does not support \"point\" filtering; using \"trilinear\""
      )

  private val wrap: Step = Step("`wrap`", "`wrap`; \"octahedralsphere\" is dropped"): s =>
    for p <- s.take("wrap") do
      if p.strings.headOption.contains("octahedralsphere") then
        s.warn(
          Code.Inexpressible,
          p.pos,
          "v3 does not support wrap \"octahedralsphere\"; using \"repeat\""
        )
      else s.add("wrap", p)

  private val image = Seq(file, filter, wrap, retain("scale", "maxanisotropy"), mapping)

  private def common(image: Seq[Step]) = Seq(
    Rule("constant" -> "constant")(retain("value")),
    Rule("mix" -> "mix")(retain("tex1", "tex2", "amount")),
    Rule("bilerp" -> "bilerp")(retain("v00", "v01", "v10", "v11"), mapping),
    Rule("imagemap" -> "imagemap")(image*),
    Rule("checkerboard" -> "checkerboard")(retain("tex1", "tex2", "dimension"), mapping),
    Rule("dots" -> "dots")(retain("inside", "outside"), mapping),
    Rule("ptex" -> "ptex")(
      retain("filename"),
      unsupported("scale", "unscaled")(isNumber(1f)),
      Step("`encoding`", "`gamma`, of \"gamma …\"")(s =>
        val words = s.takeString("encoding", "gamma 2.2").split(' ')
        words.lastOption.flatMap(Decimal.float).foreach(s.addFloat("gamma", _))
      )
    ),
    Rule.approximate("directionmix" -> "mix", "the average of both")(
      retain("tex1", "tex2"),
      drop("dir"),
      otherwise("amount", "`amount` 0.5")(_.addFloat("amount", 0.5f))
    )
  )

  /** v3 has planar mappings in world space: the transform moves into their numbers. */
  def placed(t: TextureDescription): TextureDescription =
    val isPlanar = t.texture.param("mapping").exists(_.strings.headOption.contains("planar"))
    val toTexture = t.textureToWorld.start.inverseM
    def axis(vector: String, delta: String, default: Vector[Float]) =
      def numbers(name: String) = t.texture.param(name).fold(Vector.empty)(_.floats.toVector)
      val v = Some(numbers(vector)).filter(_.length == 3).getOrElse(default)
      def times(column: Int) = (0 to 2).map(row => toTexture(4 * row + column) * v(row)).sum.toFloat
      val at = t.texture.param(vector).fold(t.texture.pos)(_.pos)
      Vector(
        Param.floats(ParamType.Vector3, vector, at, Array.tabulate(3)(times)),
        Param.float(delta, at, numbers(delta).headOption.getOrElse(0f) + times(3))
      )
    if !isPlanar || t.textureToWorld.start.isIdentity then ToV4Textures.placed(t)
    else
      val inWorld = axis("v1", "udelta", Vector(1, 0, 0)) ++ axis("v2", "vdelta", Vector(0, 1, 0))
      val names = inWorld.map(_.name).toSet
      val params = t.texture.params.filterNot(p => names(p.name)) ++ inWorld
      ToV4Textures.placed(t.copy(texture = t.texture.copy(params = params)))

  val floats: Table = Table("float texture", fallback = "constant")(
    ((common(mean +: image) :+ Rule("scale" -> "scale")(rename(
      "tex" -> "tex1",
      "scale" -> "tex2"
    ))) ++ Noise.rules)*
  )

  /** v3 multiplies two colours, so a float texture is converted to gray by mixing black and white.
    */
  private val scale: Step = Step("`tex`, `scale`", "`tex1`, `tex2`"): s =>
    for p <- s.take("tex") do s.add("tex1", p)
    for p <- s.take("scale") do
      s.numberOf(p) match
        case Some(x) => s.addRgb("tex2", Rgb.gray(x))(using p.pos)
        case None =>
          val amount = Param(ParamType.Texture, "amount", p.pos, p.pos, strings = p.strings)
          val d = Declaration("Texture", "mix", Vector(amount), p.pos, s.declaration.folder)
          val name = s"${p.strings.head} as colour"
          val gray = TextureDescription(name, "spectrum", d, GraphicsState.Identity)
          s.addTexture("tex2", s.run.define(gray))(using p.pos)

  val colors: Table = Table("spectrum texture", fallback = "constant")(
    (common(image) ++ Seq(
      Rule("scale" -> "scale")(scale),
      Noise.marble
    ))*
  )
