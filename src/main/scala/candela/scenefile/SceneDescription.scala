package candela.scenefile

import candela.base.{Problem, SourcePos}
import candela.math.Transform

/** An object-to-world transform at the start and the end of the shutter; mostly both are one
  * object.
  */
final case class AnimatedTransform(start: Transform, end: Transform):
  def isAnimated: Boolean = start != end

/** Which material a shape has. */
enum MaterialRef:
  /** None was given: the dialect's default. */
  case Default

  /** `Material "type" …`. */
  case Inline(declaration: Declaration)

  /** `NamedMaterial "name"`; what it means is in [[SceneDescription.namedMaterials]]. */
  case Named(name: String, at: SourcePos)

/** What holds at a `Shape` statement. */
final case class ShapeDescription(
    shape: Declaration,
    objectToWorld: AnimatedTransform,
    reverseOrientation: Boolean,
    material: MaterialRef,
    areaLight: Option[Declaration],
    insideMedium: String = "",
    outsideMedium: String = ""
)

/** @param medium the name of the one that the light shines in; empty: none */
final case class LightDescription(
    light: Declaration,
    lightToWorld: AnimatedTransform,
    medium: String = ""
)

/** `MakeNamedMedium "name" …`; the transform places what varies in space. */
final case class MediumDescription(
    name: String,
    medium: Declaration,
    mediumToWorld: AnimatedTransform
)

final case class InstanceDescription(
    name: String,
    at: SourcePos,
    instanceToWorld: AnimatedTransform
)

/** `Texture "name" "valueType" "class" …`.
  *
  * @param valueType "float" or "spectrum" ("color" is folded into the latter)
  */
final case class TextureDescription(
    name: String,
    valueType: String,
    texture: Declaration,
    textureToWorld: AnimatedTransform
)

/** Everything a scene file said, nothing it implied: what is None was not said.
  *
  * @param integrator     v2's `SurfaceIntegrator`, v3's and v4's `Integrator`
  * @param worldToCamera  the transform at the `Camera` statement
  * @param cameraMedium   the name of the medium around the camera; empty: none
  * @param textures       in the order of their statements (a texture may use only earlier ones)
  * @param namedMaterials in the order of their statements. Every name here (and of textures and
  *                       objects) is unique: where a file defines one again, [[Scope]] renames the
  *                       new one and its uses
  * @param objects        shapes by the name of their `ObjectBegin`, in the order of these
  * @param transformTimes the times at which the start and the end of an [[AnimatedTransform]] hold
  * @param warnings       what was noticed on the way
  * @param errors         of statements that could not be read: the rest can be checked, but not
  *                       rendered
  * @param lost           what those statements may have given names to
  */
final case class SceneDescription(
    dialect: Dialect,
    camera: Option[Declaration] = None,
    worldToCamera: AnimatedTransform = AnimatedTransform(Transform.Identity, Transform.Identity),
    cameraMedium: String = "",
    film: Option[Declaration] = None,
    sampler: Option[Declaration] = None,
    filter: Option[Declaration] = None,
    integrator: Option[Declaration] = None,
    accelerator: Option[Declaration] = None,
    renderer: Option[Declaration] = None,
    volumeIntegrator: Option[Declaration] = None,
    options: Vector[Param] = Vector.empty,
    textures: Vector[TextureDescription] = Vector.empty,
    namedMaterials: Vector[(String, Declaration)] = Vector.empty,
    lights: Vector[LightDescription] = Vector.empty,
    shapes: Vector[ShapeDescription] = Vector.empty,
    objects: Map[String, Vector[ShapeDescription]] = Map.empty,
    instances: Vector[InstanceDescription] = Vector.empty,
    media: Vector[MediumDescription] = Vector.empty,
    volumes: Vector[LightDescription] = Vector.empty,
    transformTimes: (Float, Float) = (0f, 1f),
    warnings: Vector[Problem] = Vector.empty,
    errors: Vector[Problem] = Vector.empty,
    lost: Set[NameKind] = Set.empty
)

/** What a statement can give a name to, for others to use. */
enum NameKind:
  case Texture, Material, Object, Medium

object NameKind:

  /** What a statement may have named that could not be read; of another file nobody knows. */
  def madeBy(directive: String): Set[NameKind] = directive match
    case "Texture" => Set(Texture)
    case "MakeNamedMaterial" => Set(Material)
    case "MakeNamedMedium" => Set(Medium)
    case "ObjectBegin" => Set(Object)
    case "Include" | "Import" => values.toSet
    case _ => Set.empty
