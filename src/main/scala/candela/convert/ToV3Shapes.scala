package candela.convert

import candela.diagnostics.Code
import candela.scenefile.*

/** Shapes, from v4 to v3. */
object ToV3Shapes:
  import Steps.*

  /** v3 has no alpha on quadrics. */
  private val opaque = unsupported("alpha", "opaque")(isNumber(1f))

  /** In v3, a number between 0 and 1 must be a texture. */
  private val alpha = Step("`alpha`", "`alpha`, a texture if it is a number between 0 and 1"): s =>
    for p <- s.take("alpha") do
      s.numberOf(p).filter(_ => p.paramType != ParamType.Texture) match
        case Some(x) if x > 0f && x < 1f =>
          s.warn(
            Code.Inexpressible,
            p.pos,
            "v3 treats only `alpha` 0 as transparent; the shape is opaque"
          )
        case Some(x) => s.addFloat("alpha", x)(using p.pos)
        case None =>
          s.warn(
            Code.Inexpressible,
            p.pos,
            "v3 treats only `alpha` 0 as transparent; values above are opaque"
          )
          s.add("alpha", p)

  val table: Table = Table("Shape")(
    Rule("sphere" -> "sphere")(retain("radius", "zmin", "zmax", "phimax"), opaque),
    Rule("cylinder" -> "cylinder")(retain("radius", "zmin", "zmax", "phimax"), opaque),
    Rule("disk" -> "disk")(retain("height", "radius", "innerradius", "phimax"), opaque),
    Rule("trianglemesh" -> "trianglemesh")(
      retain("P", "N", "S", "uv", "indices", "faceIndices"),
      alpha
    ),
    Rule("plymesh" -> "plymesh")(
      retain("filename"),
      alpha,
      unsupported("displacement", "undisplaced mesh"),
      drop("edgelength")
    ),
    Rule("loopsubdiv" -> "loopsubdiv")(retain("levels", "P", "indices", "scheme"), opaque),
    Rule("curve" -> "curve")(
      retain("P", "N", "type", "basis", "degree", "width", "width0", "width1", "splitdepth"),
      opaque
    )
  )

  /** v3 turns reversed meshes with normals over for rays, but not for samples of lights. */
  def placed(s: ShapeDescription, run: PassRun): Vector[ShapeDescription] =
    val meshed =
      if s.shape.name != "bilinearmesh" then s
      else
        run.warn(
          Code.Inexpressible,
          s.shape.pos,
          "v3 has no \"bilinearmesh\"; using \"trianglemesh\", finely tessellated " +
            "where it is curved"
        )
        s.copy(shape = BilinearPatches.triangles(s.shape))
    val turned =
      if meshed.reverseOrientation && Meshes.hasNormals(meshed.shape) then
        if meshed.shape.name == "plymesh" then
          if s.areaLight.nonEmpty then run.warn(Code.Inexpressible, s.shape.pos, Meshes.OtherSide)
          meshed
        else meshed.copy(shape = reversed(meshed.shape), reverseOrientation = false)
      else meshed
    for loss <- EmittingShapes.loss(s) do run.warn(Code.Inexpressible, s.shape.pos, loss)
    Vector(ToV3Lights.powered(turned))

  /** The mesh with its normals flipped; for a subdivision surface, its vertex order reversed. */
  private def reversed(d: Declaration): Declaration =
    val isSubdivided = d.name == "loopsubdiv"
    d.copy(params = d.params.map: p =>
      if isSubdivided && p.name == "indices" then
        val turned = p.ints.grouped(3).toArray.flatMap(_.reverse)
        Param(p.paramType, p.name, p.pos, p.valuesAt, ints = turned)
      else if !isSubdivided && p.name == "N" then
        Param(p.paramType, p.name, p.pos, p.valuesAt, floats = p.floats.map(-_))
      else p)
