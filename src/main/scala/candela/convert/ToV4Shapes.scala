package candela.convert

import candela.diagnostics.Code
import candela.scenefile.*

/** Shapes, from v3 to v4. */
object ToV4Shapes:
  import Steps.*

  /** v3 treats only `alpha` 0 as transparent; v4 interprets alpha as opacity, stochastically. */
  private val alpha: Step = Step("`alpha`", "`alpha`, 1 where not 0, if known"): s =>
    for p <- s.take("alpha") do
      if p.paramType == ParamType.Texture then
        val t = s.run.texture(p.strings.headOption.getOrElse(""), "float")
        val values = t.toVector.flatMap(_.texture.params).filter(q => Amounts.contains(q.name))
        val numbers = values.map(s.numberOf)
        val isPlain = t.exists(x => Plain(x.texture.name)) && numbers.forall(_.nonEmpty)
        if isPlain && numbers.flatten.exists(x => x != 0f && x != 1f) then
          s.addTexture("alpha", allOrNothing(s, t.get))(using p.pos)
        else
          s.add("alpha", p)
          if !isPlain then
            s.warn(
              Code.Inexpressible,
              p.pos,
              "v3 treats only `alpha` 0 as transparent, v4 all values below 1"
            )
      else s.numberOf(p).foreach(x => s.addFloat("alpha", if x == 0f then 0f else 1f)(using p.pos))

  private val Plain = Set("constant", "checkerboard", "dots")
  private val Amounts = Set("value", "tex1", "tex2", "inside", "outside")

  private def allOrNothing(s: Statement, t: TextureDescription): String =
    val params = t.texture.params.map: q =>
      if !Amounts.contains(q.name) then q
      else
        val x = if s.numberOf(q).contains(0f) then 0f else 1f
        Param(ParamType.Float, q.name, q.pos, q.valuesAt, floats = Array(x))
    val cutout = s.run.convert(t.texture.copy(params = params), "float texture").get
    s.run.define(ToV4Textures.placed(t).copy(name = s"${t.name} cutout", texture = cutout))

  private val shadow = unsupported("shadowalpha", "shadows use `alpha`")(isNumber(1f))

  /** v2 and v3 also accept texture coordinates as plain numbers, by either name. */
  private val uv: Step = Step("`uv`, `st`", "`point2 uv`"): s =>
    val (uv, st) = (s.take("uv"), s.take("st"))
    for p <- uv.orElse(st) do s.add("uv", Values.typed(p, ParamType.Point2))

  val table: Table = Table("Shape")(
    Rule("sphere" -> "sphere")(retain("radius", "zmin", "zmax", "phimax")),
    Rule("cylinder" -> "cylinder")(retain("radius", "zmin", "zmax", "phimax")),
    Rule("disk" -> "disk")(retain("height", "radius", "innerradius", "phimax")),
    Rule("trianglemesh" -> "trianglemesh")(
      retain("P", "N", "S", "indices", "faceIndices"),
      uv,
      alpha,
      shadow,
      drop("discarddegenerateUVs")
    ),
    Rule("plymesh" -> "plymesh")(retain("filename"), alpha, shadow),
    Rule("loopsubdiv" -> "loopsubdiv")(
      rename("nlevels" -> "levels"),
      retain("levels", "P", "indices", "scheme")
    ),
    Rule("curve" -> "curve")(
      retain("P", "N", "type", "basis", "degree", "width", "width0", "width1", "splitdepth")
    )
  )

  /** Tessellates shapes that v4 lacks. In v3, meshes with normals that emit light and have
    * `ReverseOrientation` are seen on one side and light the other.
    */
  def placed(s: ShapeDescription, run: PassRun): Vector[ShapeDescription] =
    val isMirrored = EmittingShapes.isMirrored(s)
    Tessellation.of(s.shape, isMirrored) match
      case Some(mesh) =>
        val method =
          if s.shape.name == "heightfield" then "same triangles" else "finely tessellated"
        run.warn(
          Code.Inexpressible,
          s.shape.pos,
          s"v4 has no \"${s.shape.name}\"; using \"trianglemesh\", $method"
        )
        for name <- Seq("alpha", "shadowalpha"); p <- s.shape.param(name) if !p.isDefault do
          run.ignore(p, s.shape.name)
        if isMirrored && s.areaLight.nonEmpty && s.shape.name != "heightfield" then
          val message = "a mirrored quadric that emits is seen on one side in v3, and lights the " +
            "other; in v4 it lights the side that is seen"
          run.warn(Code.Inexpressible, s.shape.pos, message)
        if Tessellation.isLoose(s.shape) then
          val message = "v3's hyperboloids that are narrowest elsewhere than at z = 0 have the " +
            "normals of another surface; where the two face apart, v4 shades it otherwise"
          run.warn(Code.Inexpressible, s.shape.pos, message)
        Vector(s.copy(shape = mesh))
      case None =>
        if s.reverseOrientation && s.areaLight.nonEmpty && Meshes.hasNormals(s.shape) then
          run.warn(Code.Inexpressible, s.shape.pos, Meshes.OtherSide)
        for loss <- EmittingShapes.loss(s) do run.warn(Code.Inexpressible, s.shape.pos, loss)
        Vector(s)
