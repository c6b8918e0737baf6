package candela.models

import candela.color.Rgb
import candela.diagnostics.SourcePos
import candela.geometry.Bounds3
import candela.math.{Transform, Vec3}
import candela.scenefile.{
  Declaration, GraphicsState, MaterialRef, MediumDescription, Param, ParamType, ShapeDescription
}

/** Translates participating media, which fill the meshes of a material or the box of a grid. */
private[models] final class Media(file: GltfFile, session: Session):
  private val named = Vector.newBuilder[MediumDescription]
  private var count = 0

  def result(): Vector[MediumDescription] = named.result()

  /** @return its name */
  private def add(medium: Declaration, toWorld: Transform): String =
    count += 1
    val name = s"medium $count"
    named += MediumDescription(name, medium, GraphicsState.constant(toWorld))
    name

  /** The medium of KHR_materials_volume, which absorbs light. Empty: none. */
  def absorbing(volume: Json): String =
    val color = Materials.rgb(volume, "attenuationColor", Rgb.White)
    val distance = volume.number("attenuationDistance", Double.PositiveInfinity)
    if color == Rgb.White || distance.isInfinite then ""
    else
      if distance <= 0 then volume.fail(s"`attenuationDistance` must be above 0, found $distance")
      val absorption = color.map(c => (-Math.log(Math.max(c, 1e-6)) / distance).toFloat)
      val params = Vector(
        Picture.rgb("sigma_a", absorption, volume.at),
        Picture.rgb("sigma_s", Rgb.Black, volume.at)
      )
      add(session.declare("Medium", "homogeneous", volume.at, params), Transform.Identity)

  /** What a material says of its inside. */
  def extras(material: Json): Option[Extras] =
    Extras.of(material, "materials", "medium", session)(
      (Media.Coefficients ++ Vector("emission", "surface"))*
    )

  /** The medium within meshes. */
  def inside(e: Extras): String =
    val at = e.entry.at
    val (absorption, emission) =
      (e.color("absorption", Rgb.Black), e.color("emission", Rgb.Black))
    // pbrt's emission is that of an opaque medium
    def radiance(e: Float, a: Float) = if a > 0f then e / a else 0f
    val emitted = Rgb(
      radiance(emission.r, absorption.r),
      radiance(emission.g, absorption.g),
      radiance(emission.b, absorption.b)
    )
    for member <- e("emission") if (emission - emitted * absorption).max > 1e-6f * emission.max do
      session.warn(member.at, "a medium emits only colours that it absorbs")
    val light = Option.when(emitted != Rgb.Black)(Picture.rgb("Le", emitted, at))
    val params = coefficients(e) ++ light
    add(session.declare("Medium", "homogeneous", at, params), Transform.Identity)

  private def coefficients(e: Extras): Vector[Param] =
    val at = e.entry.at
    val g = e.number("anisotropy", 0, -Media.MaxAnisotropy, Media.MaxAnisotropy)
    Vector(
      Picture.rgb("sigma_a", e.color("absorption", Rgb.Black), at),
      Picture.rgb("sigma_s", e.color("scattering", Rgb.Black), at),
      Param.float("g", at, g.toFloat)
    )

  /** The box around the grid of a node, if it has one. */
  def apply(p: PlacedNode): Option[ShapeDescription] =
    val memberNames = Media.Coefficients ++ Vector("box", "grid", "uri")
    Extras.of(p.node, "nodes", "medium", session)(memberNames*).map: e =>
      val at = e.entry.at
      val uri = e.entry.required("uri")
      val members = Vector(
        Param.string("filename", uri.at, file.linked(uri)),
        Param.string("gridname", e("grid").fold(at)(_.at), e("grid").fold("density")(_.text))
      )
      val medium = session.declare("Medium", "nanovdb", at, members ++ coefficients(e))
      val corners = bounds(e)
      val name = add(medium, p.toWorld)
      ShapeDescription(
        session.declare("Shape", "trianglemesh", at, mesh(corners, at)),
        GraphicsState.constant(p.toWorld),
        reverseOrientation = false,
        MaterialRef.Inline(session.declare("Material", "interface", at, Nil)),
        None,
        insideMedium = name
      )

  private def mesh(box: Bounds3, at: SourcePos): Vector[Param] =
    val corners = Array.tabulate(8)(box.corner).flatMap(p => Array(p.x, p.y, p.z))
    Vector(
      Param.floats(ParamType.Point3, "P", at, corners),
      Param.int("indices", at, Media.Faces*)
    )

  private def bounds(e: Extras): Bounds3 =
    val box = e.entry.required("box")
    val n = box.numbers(6).map(_.toFloat)
    for i <- 0 until 3 if n(i) >= n(i + 3) do
      box.fail(s"expected the lowest corner and the highest, found ${n.mkString(" ")}")
    Bounds3(Vec3(n(0), n(1), n(2)), Vec3(n(3), n(4), n(5)))

private[models] object Media:
  private val Coefficients = Vector("absorption", "scattering", "anisotropy")
  private val MaxAnisotropy = 0.99

  /** Triangles of [[Bounds3.corner]]s that face outwards. */
  private val Faces = Vector(0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5,
    0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3)
