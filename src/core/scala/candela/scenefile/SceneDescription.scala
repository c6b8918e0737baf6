package candela.scenefile

import candela.diagnostics.{Problem, SourcePos}
import candela.io.SceneFolder
import candela.math.Transform

import java.nio.file.Path

/** Object-to-world transform at shutter open and close; usually the same object twice. */
final case class AnimatedTransform(start: Transform, end: Transform):
  def isAnimated: Boolean = (start ne end) && start != end

  /** Applies `first`, then this. */
  def after(first: AnimatedTransform): AnimatedTransform =
    val composedStart = start * first.start
    if isAnimated || first.isAnimated then AnimatedTransform(composedStart, end * first.end)
    else AnimatedTransform(composedStart, composedStart)

/** The material of a shape. */
enum MaterialRef:
  /** Not specified: the dialect's default. */
  case Default

  /** `Material "type" …`. */
  case Inline(declaration: Declaration)

  /** `NamedMaterial "name"`, defined in [[SceneDescription.namedMaterials]]. */
  case Named(name: String, at: SourcePos)

  /** Its statement, if there is one. */
  def declared(named: Map[String, Declaration]): Option[Declaration] = this match
    case Default => None
    case Inline(declaration) => Some(declaration)
    case Named(name, _) => named.get(name)

/** A `Shape` statement with the graphics state that applies to it.
  *
  * @param oneSided whether it is black from behind, unless light passes through it: pbrt has no
  *   such surfaces, Mitsuba has
  * @param inObject whether it is of an instanced object, whose area lights are seen only
  * @param copied the instance whose copy it is; included in `objectToWorld`
  */
final case class ShapeDescription(
    shape: Declaration,
    objectToWorld: AnimatedTransform,
    reverseOrientation: Boolean,
    material: MaterialRef,
    areaLight: Option[Declaration],
    insideMedium: String = "",
    outsideMedium: String = "",
    oneSided: Boolean = false,
    inObject: Boolean = false,
    copied: Option[Transform] = None
)

/** @param medium name of the medium around the light; empty: none */
final case class LightDescription(
    light: Declaration,
    lightToWorld: AnimatedTransform,
    medium: String = ""
)

/** `MakeNamedMedium "name" …`; the transform places spatially varying properties. */
final case class MediumDescription(
    name: String,
    medium: Declaration,
    mediumToWorld: AnimatedTransform
)

final case class InstanceDescription(
    name: String,
    pos: SourcePos,
    instanceToWorld: AnimatedTransform
)

/** `Texture "name" "valueType" "class" …`.
  *
  * @param valueType "float" or "spectrum" (which includes "color")
  */
final case class TextureDescription(
    name: String,
    valueType: String,
    texture: Declaration,
    textureToWorld: AnimatedTransform
)

/** The contents of a scene file, without defaults: None if not specified.
  *
  * @param integrator v2's `SurfaceIntegrator`, v3's and v4's `Integrator`
  * @param worldToCamera transform at the `Camera` statement
  * @param cameraMedium name of the medium around the camera; empty: none
  * @param textures in statement order (a texture may use only earlier ones)
  * @param namedMaterials in statement order. All names here (and of textures and objects) are
  *   unique: [[Scope]] renames redefinitions and their uses
  * @param objects shapes by the name of their `ObjectBegin`, in statement order
  * @param transformTimes times of the start and the end of each [[AnimatedTransform]]
  * @param warnings warnings of the parser
  * @param errors errors of statements that could not be parsed: the rest can be checked, but not
  *   rendered
  * @param failedKinds kinds of names that those statements may have defined
  * @param sources the scene file and the files that it includes
  * @param clues what the dialect was estimated from; see [[DialectGuess]]
  * @param dialectReason why it is that dialect, for the user
  * @param additions     what a model lacked and was given, for the user
  * @param isFollowed whether the file has another world, another image, after this one
  * @param folder the folder of the scene file, through which its files are opened
  * @param text what was read instead of a file
  * @param idleMaterials materials that are written in place, and names that were undefined where
  *                      they stand, that no shape has
  * @param unfiled SHA-256 of its parts that are in no file, by name
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
    instances: InstanceList = InstanceList.Empty,
    media: Vector[MediumDescription] = Vector.empty,
    volumes: Vector[LightDescription] = Vector.empty,
    transformTimes: (Float, Float) = (0f, 1f),
    warnings: Vector[Problem] = Vector.empty,
    errors: Vector[Problem] = Vector.empty,
    failedKinds: Set[NameKind] = Set.empty,
    sources: Vector[Path] = Vector.empty,
    clues: Vector[DialectClue] = Vector.empty,
    dialectReason: String = "",
    additions: Option[String] = None,
    isFollowed: Boolean = false,
    folder: SceneFolder = SceneFolder.Nowhere,
    unfiled: Vector[(String, String)] = Vector.empty,
    text: Option[NamedText] = None,
    idleMaterials: Vector[MaterialRef] = Vector.empty
):
  /** Whether the camera sees no area lights and no sky. */
  def hidesEmitters: Boolean =
    dialect == Dialect.Mitsuba && integrator.exists(
      _.param("hideemitters").exists(_.bools.contains(true))
    )

/** A scene that is no file.
  *
  * @param name in messages; file names in the text are relative to its folder
  */
final case class NamedText(name: String, content: String)

/** Kinds of names that statements define. */
enum NameKind:
  case Texture, Material, Object, Medium

object NameKind:

  /** Kinds of names that an unreadable statement may have defined; an included file may define any.
    */
  def definedBy(directive: String): Set[NameKind] = directive match
    case "Texture" => Set(Texture)
    case "MakeNamedMaterial" => Set(Material)
    case "MakeNamedMedium" => Set(Medium)
    case "ObjectBegin" => Set(Object)
    case "Include" | "Import" => values.toSet
    case _ => Set.empty
