package candela.convert

import candela.scenefile.*

/** Shapes, from v3 to v4. */
object ToV4Shapes:
  import Steps.*

  private val alpha = keep("alpha")
  private val shadow = lose("shadowalpha", "shadows follow `alpha`")(isNumber(1f))

  /** v2 and v3 take texture coordinates as plain numbers too, by either name. */
  private val uv: Step = Step("`uv`, `st`", "`point2 uv`"): s =>
    val (uv, st) = (s.take("uv"), s.take("st"))
    for p <- uv.orElse(st) do s.add("uv", Values.typed(p, ParamType.Point2))

  val table: Table = Table("Shape")(
    Rule("sphere" -> "sphere")(keep("radius", "zmin", "zmax", "phimax"), alpha, shadow),
    Rule("cylinder" -> "cylinder")(keep("radius", "zmin", "zmax", "phimax"), alpha, shadow),
    Rule("disk" -> "disk")(keep("height", "radius", "innerradius", "phimax"), alpha, shadow),
    Rule("trianglemesh" -> "trianglemesh")(
      keep("P", "N", "S", "indices", "faceIndices"),
      uv,
      alpha,
      shadow,
      drop("discarddegenerateUVs")
    ),
    Rule("plymesh" -> "plymesh")(keep("filename"), alpha, shadow),
    Rule("loopsubdiv" -> "loopsubdiv")(
      rename("nlevels" -> "levels"),
      keep("levels", "P", "indices", "scheme"),
      alpha,
      shadow
    ),
    Rule("curve" -> "curve")(
      keep("P", "N", "type", "basis", "degree", "width", "width0", "width1", "splitdepth"),
      alpha,
      shadow
    )
  )

  /** Shapes that v4 has no more become meshes; and where a mesh has normals, v3 does not look at
    * `ReverseOrientation`, while v4 turns them.
    */
  def placed(s: ShapeDescription, run: PassRun): Vector[ShapeDescription] =
    Tessellation.of(s.shape) match
      case Some(mesh) =>
        val how = if s.shape.name == "heightfield" then "the same triangles" else "a fine mesh"
        run.warn(s.shape.at, s"v4 has no \"${s.shape.name}\": a trianglemesh stands in, $how")
        Vector(s.copy(shape = mesh))
      case None if s.reverseOrientation && Meshes.hasNormals(s.shape) =>
        Vector(s.copy(reverseOrientation = false))
      case None => Vector(s)
