package candela.convert

import candela.diagnostics.Code
import candela.color.{Rgb, Srgb}
import candela.scenefile.*

import java.util.Locale

/** Textures, from v3 to v4. */
object ToV4Textures:
  import Steps.*

  /** By default v3 decodes PNG and TGA, v4 all 8-bit formats; v4 can override this for PNG only.
    * Other encodings are baked into a new image.
    */
  private val encoding: Step =
    Step("`filename`, `gamma`", "`filename`, `encoding`; or a new image"): s =>
      for p <- s.take("filename") do
        val file = p.strings.headOption.getOrElse("").toLowerCase(Locale.ROOT)
        val (isPng, isTga) = (file.endsWith(".png"), file.endsWith(".tga"))
        val decodes = s.takeBool("gamma", isPng || isTga)
        if decodes == (isPng || isTga) then s.add("filename", p)
        else if isPng then
          s.add("filename", p)
          s.addString("encoding", "linear")
        else
          val decoded = (x: Float, _: Int) => if decodes then Srgb.decode(x) else x
          s.addString("filename", RewrittenImages.baked(s, p, decodes)(decoded))(using p.pos)

  /** v3 decodes the luminance of float textures, v4 takes the mean of what it decodes. */
  private val luminance: Step =
    Step("`filename` of a coloured image", "its luminance, as a new image"): s =>
      for p <- s.peek("filename") do
        val file = p.strings.headOption.getOrElse("").toLowerCase(Locale.ROOT)
        val decodes = s.peek("gamma").flatMap(_.bools.headOption)
          .getOrElse(file.endsWith(".png") || file.endsWith(".tga"))
        def number(stored: Rgb) =
          if decodes then Srgb.decode(stored.luminance) else stored.luminance
        for name <- RewrittenImages.numbers(s, p, decodes)(number) do
          val _ = (s.take("filename"), s.take("gamma"))
          s.addString("filename", name)(using p.pos)

  private val filter: Step = Step("`trilinear`", "`filter`: \"ewa\", or \"trilinear\""): s =>
    s.addString("filter", if s.takeBool("trilinear", false) then "trilinear" else "ewa")

  private val image = Seq(encoding, filter, retain("wrap", "scale", "maxanisotropy"), mapping)

  private def ptex = Rule("ptex" -> "ptex")(
    retain("filename", "scale"),
    Step("`gamma`", "`encoding` \"gamma …\"")(s =>
      s.addString("encoding", s"gamma ${NumberText.of(s.takeNumber("gamma", 2.2f))}")
    )
  )

  private def common(image: Seq[Step]) = Seq(
    Rule("constant" -> "constant")(retain("value")),
    Rule("mix" -> "mix")(retain("tex1", "tex2", "amount")),
    Rule("bilerp" -> "bilerp")(retain("v00", "v01", "v10", "v11"), mapping),
    Rule("imagemap" -> "imagemap")(image*),
    Rule("checkerboard" -> "checkerboard")(
      retain("tex1", "tex2", "dimension"),
      drop("aamode"),
      mapping
    ),
    Rule("dots" -> "dots")(retain("inside", "outside"), mapping),
    ptex
  )

  val floats: Table = Table("float texture", fallback = "constant")(
    ((common(luminance +: image) :+ Rule("scale" -> "scale")(rename(
      "tex1" -> "tex",
      "tex2" -> "scale"
    ))) ++ Noise.rules)*
  )

  /** v4 multiplies a colour by a number. */
  private val scale: Step = Step("`tex1`, `tex2`", "`tex` and scalar `scale`"): s =>
    val factors = Vector("tex1", "tex2").flatMap(s.take)
    def gray(p: Param) = s.colorOf(p).filter(Values.isGray).map(_.r)
    def color(p: Param) = s.colorOf(p)
    factors match
      case Vector(a, b) =>
        val (tex, factor) = if gray(a).nonEmpty && gray(b).isEmpty then (b, a) else (a, b)
        (color(tex), color(factor)) match
          case (Some(x), Some(y)) => s.addRgb("tex", x * y)(using tex.pos)
          case _ =>
            val (base, by) = if color(tex).nonEmpty && gray(factor).isEmpty then (factor, tex)
            else (tex, factor)
            val tinted =
              if gray(by).nonEmpty then None
              else color(by).flatMap(tint(s, base, _)).orElse(product(s))
            if tinted.nonEmpty then s.addTexture("tex", tinted.get)(using base.pos)
            else s.add("tex", base)
            if tinted.isEmpty then
              gray(by) match
                case Some(g) => s.addFloat("scale", g)(using by.pos)
                case None =>
                  s.warn(Code.Inexpressible, by.pos, s"$NoProducts; using the luminance of one")
                  color(by) match
                    case Some(c) => s.addFloat("scale", c.luminance)(using by.pos)
                    case None => s.addTexture("scale", floatTwin(s, by))(using by.pos)
      case single => single.foreach(s.add("tex", _))

  private val NoProducts = "v4 can't multiply two colours"

  private def product(s: Statement): Option[String] =
    BakedTextures.define(s, s.asTexture("spectrum"), NoProducts)()

  /** An image map times a colour, as a new image. */
  private def tint(s: Statement, p: Param, by: Rgb): Option[String] =
    for
      t <- s.run.texture(p.strings.headOption.getOrElse(""), "spectrum")
      if t.texture.name == "imagemap"
      file <- t.texture.param("filename")
    yield
      val name = file.strings.headOption.getOrElse("").toLowerCase(Locale.ROOT)
      val isBytes = name.endsWith(".png") || name.endsWith(".tga")
      val decodes = t.texture.param("gamma").flatMap(_.bools.headOption).getOrElse(isBytes)
      val factors = Array(by.r, by.g, by.b)
      val written = RewrittenImages.baked(s, file, (by, decodes)): (x, c) =>
        factors(c) * (if decodes then Srgb.decode(x) else x)
      val remaining = t.texture.params.filterNot(q => q.name == "gamma" || q.name == "filename")
      val image = Param(ParamType.String, "filename", file.pos, file.pos, strings = Vector(written))
      val d = t.texture.copy(params = image +: remaining)
      val tinted = s.run.convert(d, "spectrum texture").get
      s.run.define(placed(t).copy(name = s"${t.name} tinted", texture = tinted))

  /** A float texture with the luminance of a spectrum texture. */
  def floatTwin(s: Statement, p: Param): String =
    val name = p.strings.head
    val twin =
      for
        t <- s.run.texture(name, "spectrum")
        d <- s.run.convert(grayed(s, t.texture), "float texture")
      yield s.run.define(t.copy(name = s"$name as number", valueType = "float", texture = d))
    s.warn(
      Code.Inexpressible,
      p.pos,
      s"v4 needs a float texture here; using the luminance of \"$name\""
    )
    twin.getOrElse(name)

  private def grayed(s: Statement, d: Declaration): Declaration =
    d.copy(params = d.params.map: p =>
      if p.paramType == ParamType.Rgb || p.paramType == ParamType.Spectrum then
        val c = s.colorOf(p).getOrElse(Rgb.White)
        Param(ParamType.Float, p.name, p.pos, p.valuesAt, floats = Array(c.luminance))
      else p)

  /** Interpolates between black and white by a float texture. */
  private def byNumber(kind: String)(steps: Step*): Rule =
    Rule(kind -> "mix")(
      Step("all", s"a float texture \"$kind\" between black and white"): s =>
        val rule = Rule(kind -> kind)(steps*)
        val number = Statement(s.declaration, s.run, rule).result()
        s.declaration.params.foreach(p => s.take(p.name))
        val numberTexture =
          TextureDescription(s"$kind as number", "float", number, s.run.textureToWorld)
        s.addTexture("amount", s.run.define(numberTexture))
    )

  private val uv = Rule.approximate("uv" -> "bilerp", "does not repeat outside [0, 1]")(
    Step("no colours", "red along u, green along v"): s =>
      BakedTextures.define(s, s.asTexture("spectrum"), "v4 has no \"uv\"")() match
        case Some(name) =>
          s.convertTo("scale")
          s.addTexture("tex", name)
          ("mapping" +: Placement).foreach(s.take)
        case None =>
          for (name, c) <- Seq(
              "v00" -> Rgb(0, 0, 0),
              "v01" -> Rgb(0, 1, 0),
              "v10" -> Rgb(1, 0, 0),
              "v11" -> Rgb(1, 1, 0)
            )
          do s.addRgb(name, c),
    mapping
  )

  val colors: Table = Table("spectrum texture", fallback = "constant")(
    (common(image) ++ Seq(
      Rule("scale" -> "scale")(scale),
      Noise.marble,
      byNumber("fbm")(Noise.octaves),
      byNumber("wrinkled")(Noise.octaves),
      byNumber("windy")(),
      uv
    ))*
  )

  /** v3 has planar mappings in world space, and transforms points in space by the texture's
    * transform instead of its inverse.
    */
  def placed(t: TextureDescription): TextureDescription =
    val d = t.texture
    val isSpatial = Set("fbm", "wrinkled", "windy", "marble")(d.name) ||
      (d.name == "checkerboard" && d.param("dimension").exists(_.ints.headOption.contains(3)))
    val isPlanar = d.param("mapping").exists(_.strings.headOption.contains("planar"))
    if isSpatial then PassRun.inverse(t) else if isPlanar then PassRun.unplaced(t) else t
