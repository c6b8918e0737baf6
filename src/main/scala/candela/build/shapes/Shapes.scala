package candela.build.shapes

import candela.accel.{HoleMask, Mask, SolidMask, StochasticMask}
import candela.build.recipe.*
import candela.lights.{HiddenLight, Light, PerforatedLight, SurfaceLight}
import candela.math.Transform
import candela.scenefile.Dialect
import candela.shapes.{Shape, SurfaceSampler}
import candela.textures.{ConstantFloat, FloatTexture}

/** Recipes of shapes. */
object Shapes:
  val all: Recipes[Option[ShapePlan]] =
    Recipes(
      "shape",
      Vector(
        SphereRecipe, CylinderRecipe, DiskRecipe, ConeRecipe, ParaboloidRecipe, HyperboloidRecipe,
        TriangleMeshRecipe, PlyMeshRecipe, BilinearMeshRecipe, LoopSubdivRecipe, CurveRecipe,
        HeightFieldRecipe, NurbsRecipe
      )
    )

/** A shape to be placed.
  *
  * @param mask  where it has holes
  * @param holes how it emits through them, if it is a light
  */
final case class ShapePlan(geometry: ShapeGeometry, mask: Mask, holes: EmitterHoles)

/** How light sampling takes an emitting surface: v2 and v3 forget its holes. */
enum EmitterHoles:
  case Ignored, Everywhere
  case Where(alpha: FloatTexture)

  def light(light: SurfaceLight, surface: SurfaceSampler): Light = this match
    case Ignored => light
    case Everywhere => HiddenLight(light)
    case Where(alpha) => PerforatedLight(light, surface, alpha)

/** What all shapes have.
  *
  * @param alphaIn       the dialects in which the shape can have holes
  * @param shadowAlphaIn those in which it can have holes for shadow rays alone
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
      floatTexture("alpha", "0 where the surface has holes", alphaIn)(1f)
    )
  private val shadowAlpha =
    Option.when(shadowAlphaIn.exists(dialects))(
      floatTexture("shadowalpha", "0 where it casts no shadow", shadowAlphaIn)(1f)
    )

  protected def geometry()(using Site): Option[ShapeGeometry]

  protected final def make()(using site: Site): Option[ShapePlan] =
    geometry().map: geometry =>
      val holes = holesOf(alpha)
      if site.dialect == Dialect.V4 then
        ShapePlan(geometry, holes.fold(SolidMask)(StochasticMask(_)), emitter(holes))
      else
        val inShadow = holesOf(shadowAlpha)
        val mask =
          if holes.isEmpty && inShadow.isEmpty then SolidMask
          else HoleMask(holes.getOrElse(Opaque), inShadow.getOrElse(Opaque))
        ShapePlan(geometry, mask, EmitterHoles.Ignored)

  /** What is left of the surface, where it is not all of it. */
  private def holesOf(field: Option[Field[FloatTexture]])(using site: Site): Option[FloatTexture] =
    val hasHoles = (a: Float) => if site.dialect == Dialect.V4 then a < 1f else a == 0f
    field.map(_()).filter(_.constant.forall(hasHoles))

  private def emitter(holes: Option[FloatTexture]): EmitterHoles = holes match
    case None => EmitterHoles.Ignored
    case Some(alpha) if alpha.constant.exists(_ <= 0f) => EmitterHoles.Everywhere
    case Some(alpha) => EmitterHoles.Where(alpha)

  private val Opaque = ConstantFloat(1f)

/** What meshes have beside. */
abstract class MeshRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends ShapeRecipe(name, meaning, dialects, alphaIn = dialects, shadowAlphaIn = onlyV3)

/** What a shape statement describes, before it is placed in the world. */
enum ShapeGeometry:
  /** Triangles in object space: x y z a vertex, three vertices a triangle; normals (x y z) and uvs
    * may be empty.
    */
  case Triangles(
      positions: Array[Float],
      normals: Array[Float],
      uvs: Array[Float],
      indices: Array[Int]
  )

  /** A single surface, given where it stands and whether its orientation is reversed. */
  case Solid(make: (Transform, Boolean) => Shape)

  /** Many surfaces, likewise.
    *
    * @param emits can they be area lights?
    */
  case Solids(make: (Transform, Boolean) => Vector[Shape], emits: Boolean)

  /** Parts of different kinds. */
  case Several(parts: Vector[ShapeGeometry])
