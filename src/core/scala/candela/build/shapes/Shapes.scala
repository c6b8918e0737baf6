package candela.build.shapes

import candela.accel.{FrontMask, HoleMask, Mask, SolidMask, StochasticMask}
import candela.build.recipe.*
import candela.lights.{HiddenLight, Light, PerforatedLight, SurfaceLight}
import candela.math.{Position, Transform}
import candela.scenefile.Dialect
import candela.shapes.{BezierCurve, Shape, SurfaceSampler, VertexAttributes}
import candela.textures.{ConstantFloat, FloatTexture, StepFloat}

/** Recipes of shapes. */
object Shapes:
  val all: Recipes[Option[ShapePlan]] =
    Recipes(
      "shape",
      Vector(
        SphereRecipe, CylinderRecipe, DiskRecipe, ConeRecipe, ParaboloidRecipe, HyperboloidRecipe,
        TriangleMeshRecipe, PlyMeshRecipe, BilinearMeshRecipe, LoopSubdivRecipe, CurveRecipe,
        HeightFieldRecipe, HeightMapRecipe, NurbsRecipe
      )
    )

/** A shape before placement.
  *
  * @param mask  alpha cutouts
  * @param holes emission of the cutouts, if the shape is a light
  */
final case class ShapePlan(geometry: ShapeGeometry, mask: Mask, holes: EmitterHoles)

/** Light sampling of an alpha-masked emitter: v2 and v3 ignore its cutouts. */
enum EmitterHoles:
  case Ignored, Everywhere
  case Where(alpha: FloatTexture, scalesHits: Boolean)

  def light(light: SurfaceLight, surface: SurfaceSampler): Light = this match
    case Ignored => light
    case Everywhere => HiddenLight(light)
    case Where(alpha, scalesHits) => PerforatedLight(light, surface, alpha, scalesHits)

/** Base of shape recipes.
  *
  * @param alphaIn       dialects with alpha cutouts
  * @param shadowAlphaIn dialects with alpha cutouts for shadow rays only
  */
abstract class ShapeRecipe(
    name: String,
    meaning: String,
    dialects: Set[Dialect] = every,
    alphaIn: Set[Dialect] = onlyV4,
    shadowAlphaIn: Set[Dialect] = Set.empty
) extends Recipe[Option[ShapePlan]](name, meaning, dialects):
  private val alpha =
    Option.when(alphaIn.exists(dialects))(
      floatTexture("alpha", "alpha cutout; 0: transparent", alphaIn)(1f)
    )
  private val shadowAlpha =
    Option.when(shadowAlphaIn.exists(dialects))(
      floatTexture(
        "shadowalpha",
        "alpha cutout for shadow rays; 0: casts no shadow",
        shadowAlphaIn
      )(1f)
    )
  private val cutoff =
    Option.when(alphaIn.exists(dialects))(
      float(
        "alphacutoff",
        "alpha from which on the surface is opaque; below, it is open",
        onlyGltf
      )(
        0f
      )
    )

  protected def geometry()(using Site): Option[ShapeGeometry]

  /** Do rays from behind pass? */
  protected def isOpenBehind()(using Site): Boolean = false

  protected final def create()(using site: Site): Option[ShapePlan] =
    geometry().map: geometry =>
      val holes = holesOf(alpha)
      if site.dialect == Dialect.V4 then
        val mask = holes.fold(SolidMask)(StochasticMask(_, site.rules.coversByAlpha))
        ShapePlan(geometry, if isOpenBehind() then FrontMask(mask) else mask, emitter(holes))
      else
        val inShadow = holesOf(shadowAlpha)
        val mask =
          if holes.isEmpty && inShadow.isEmpty then SolidMask
          else HoleMask(holes.getOrElse(Opaque), inShadow.getOrElse(Opaque))
        ShapePlan(geometry, mask, EmitterHoles.Ignored)

  /** Alpha texture, unless fully opaque. */
  private def holesOf(field: Option[Field[FloatTexture]])(using site: Site): Option[FloatTexture] =
    val hasHoles = (a: Float) => if site.dialect == Dialect.V4 then a < 1f else a == 0f
    field.map(f => cut(f())).filter(_.constant.forall(hasHoles))

  private def cut(alpha: FloatTexture)(using Site): FloatTexture =
    val minAlpha = cutoff.fold(0f)(_())
    if minAlpha > 0f then StepFloat.of(alpha, minAlpha) else alpha

  private def emitter(holes: Option[FloatTexture])(using site: Site): EmitterHoles = holes match
    case None => EmitterHoles.Ignored
    case Some(alpha) if site.rules.coversByAlpha => EmitterHoles.Where(alpha, scalesHits = false)
    case Some(alpha) if alpha.constant.exists(_ <= 0f) => EmitterHoles.Everywhere
    case Some(alpha) => EmitterHoles.Where(alpha, scalesHits = true)

  private val Opaque = ConstantFloat(1f)

/** Base of triangle meshes. */
abstract class MeshRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends ShapeRecipe(name, meaning, dialects, alphaIn = dialects, shadowAlphaIn = onlyV3)

/** Geometry of a shape statement, before placement in the world. */
enum ShapeGeometry:
  /** Triangles in object space: x y z per vertex, three vertex indices per triangle; normals
    * (x y z) and uvs may be empty.
    *
    * @param content tells these positions and indices from others, if it is known
    * @param attributes what else vertices have
    */
  case Triangles(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int],
      content: Option[String] = None,
      attributes: VertexAttributes = VertexAttributes.Empty
  )

  /** A single surface, created from its transform and whether its orientation is reversed.
    *
    * @param turned whether rays see the other side of it than light sampling does
    */
  case Solid(make: (Transform, Boolean) => Shape, turned: Boolean = false)

  /** Many surfaces, created as above. */
  case Solids(make: (Transform, Boolean) => Vector[Shape])

  /** Curves, as they are drawn. They can't be area lights. */
  case Curves(strand: Strand, all: IndexedSeq[BezierCurve])

  /** A part whose points are relative to one in object space. */
  case Around(origin: Position, part: ShapeGeometry)

  /** Several parts of different kinds. */
  case Several(parts: Vector[ShapeGeometry])
