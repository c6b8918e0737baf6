package candela.convert

import candela.diagnostics.{Code, Problem, SceneError}
import java.nio.file.Path
import java.util.Locale

import scala.collection.mutable

import candela.scenefile.{
  Declaration,
  Dialect,
  MaterialRef,
  Param,
  ParamType,
  SceneDescription,
  ShapeDescription
}

/** A converted scene, and the warnings about what was dropped or approximated. */
final case class Converted(scene: SceneDescription, warnings: Vector[Problem])

object Converter:

  /** @param folder folder of the output scene; files that accompany it are written immediately
    * @param toPly  minimum number of triangles for moving a mesh to a PLY file
    * @param baking how to replace textures that the target dialect lacks by images, if at all
    */
  def convert(
      scene: SceneDescription,
      to: Dialect,
      folder: Path,
      toPly: Option[Int] = None,
      baking: Option[Baking] = None
  ): Converted =
    val files = SideFiles(folder)
    files.completing(convert(scene, to, files, toPly, baking))

  /** As above, with the files that accompany the output scene. */
  def convert(
      scene: SceneDescription,
      to: Dialect,
      files: SideFiles,
      toPly: Option[Int],
      baking: Option[Baking]
  ): Converted =
    if to == Dialect.V2 && Dialect.ofOthers(scene.dialect) then refuse(scene.dialect)
    if toPly.nonEmpty && to == Dialect.V2 then
      throw SceneError(Problem.general(Code.NoConversion, "v2 has no PLY meshes; remove --to-ply"))
    val isOfOthers = Dialect.ofOthers(scene.dialect)
    val from = scene.dialect.base
    val translated =
      if isOfOthers then ofOthers(scene, to, files)
      else if from == Dialect.V2 && to != from then
        Converted(FromV2.prepared(scene), Vector.empty)
      else Converted(scene, Vector.empty)
    val relocated = Declarations.map(translated.scene)(FileNames(files.folder).moved)
    val images =
      if scene.dialect == Dialect.Mitsuba then
        MitsubaInV4.images(MitsubaInV4.luminances(relocated, files), files)
      else if isOfOthers then MitsubaInV4.images(relocated, files)
      else Converted(relocated, Vector.empty)
    val moved = images.scene
    val hasSpaces = to == Dialect.V4 || from != Dialect.V4
    val srgb = if hasSpaces then Converted(moved, Vector.empty) else ColorSpaces.removed(moved)
    val isSpectral = scene.dialect == Dialect.V4 && to != Dialect.V4
    val spectral = Option.when(isSpectral):
      SpectralColors.warning(srgb.scene, program(to), SpectralColors.Plain)
    val based = if isSpectral then srgb.copy(scene = MetalColors.inNumbers(srgb.scene)) else srgb
    val warnings = translated.warnings ++ images.warnings ++ based.warnings ++
      spectral.flatten ++ interfaces(scene, from, to)
    val start = based.copy(warnings = warnings)
    // v2's and v4's marble are the same
    val solid = baking.filter(_ => Seq(from, to).count(_ == Dialect.V3) == 1) match
      case Some(b) =>
        val baked = SolidBaking(start.scene, to, files, b).result
        Converted(baked.scene, start.warnings ++ baked.warnings)
      case None => start
    val leavesV4 = from == Dialect.V4 && to != Dialect.V4
    val started =
      if leavesV4 then solid.copy(scene = InstanceMotions.fromV4(solid.scene)) else solid
    val converted =
      (foreignDeclarations(translated.scene, to) ++ passes(from, to)).foldLeft(started):
        (previous, pass) =>
          val run = PassRun(pass, previous.scene, files, baking, from -> to)
          val result = run.result()
          Converted(result, previous.warnings ++ run.warnings)
    val bounded = withoutBacks(converted)
    val plain = if to == Dialect.V4 then forV4(bounded, from) else bounded
    // Scenes of other formats name theirs when they are read
    val missing = if isOfOthers then Vector.empty else FileNames.missing(scene)
    val named = plain.warnings.flatMap(_.pos).toSet
    Converted(
      toPly.fold(plain.scene)(PlyWriter.extract(plain.scene, _, files)),
      plain.warnings ++ missing.filterNot(_.pos.exists(named))
    )

  private def ofOthers(scene: SceneDescription, to: Dialect, files: SideFiles): Converted =
    val skies = SunskyLights.converted(scene, files)
    val plain =
      if scene.dialect == Dialect.Mitsuba then FromMitsuba.converted(skies.scene)
      else FromGltf.converted(skies.scene, files)
    val warnings = skies.warnings ++ plain.warnings
    if to != Dialect.V4 then plain.copy(warnings = warnings)
    else if scene.dialect == Dialect.Mitsuba then
      val done = MitsubaInV4.converted(plain.scene)
      done.copy(warnings = warnings ++ done.warnings)
    else plain.copy(warnings = warnings ++ SpectralColors.warning(plain.scene, "glTF"))

  /** pbrt has no surfaces that are black from behind. */
  private def withoutBacks(from: Converted): Converted =
    val scene = from.scene
    val oneSided = (scene.shapes ++ scene.objects.values.flatten).filter(_.oneSided)
    def twoSided(shapes: Vector[ShapeDescription]) = shapes.map(_.copy(oneSided = false))
    val warning = oneSided.headOption.map: first =>
      val count = if oneSided.size == 1 then "1 shape is" else s"${oneSided.size} shapes are"
      Problem.warning(
        Code.Inexpressible,
        first.shape.pos,
        s"$count black from behind in Mitsuba, but not in pbrt"
      )
    Converted(
      scene.copy(
        shapes = twoSided(scene.shapes),
        objects = scene.objects.map((name, shapes) => name -> twoSided(shapes))
      ),
      from.warnings ++ warning
    )

  /** Integrators without media differ in what they find behind surfaces without a BSDF. */
  private def interfaces(scene: SceneDescription, from: Dialect, to: Dialect): Option[Problem] =
    val named = scene.namedMaterials.toMap
    def isOpen(s: ShapeDescription) = s.material.declared(named).exists(d => Open(d.name))
    val default = if from == Dialect.V4 then "volpath" else "path"
    val integrator = scene.integrator.fold(default)(_.name)
    for
      first <- (scene.shapes ++ scene.objects.values.flatten).find(isOpen)
      if Set(from, to) == Set(Dialect.V3, Dialect.V4) && !ThroughMedia(integrator)
    yield Problem.warning(
      Code.Inexpressible,
      first.shape.pos,
      s"\"$integrator\" finds other light behind surfaces without a BSDF in pbrt-v3 than in " +
        "pbrt-v4; \"volpath\" finds the same"
    )

  private val Open = Set("", "none", "interface")
  private val ThroughMedia = Set("volpath", "simplevolpath", "bdpt", "mlt")

  private def forV4(converted: Converted, from: Dialect): Converted =
    val clamped = ColorRanges.clamped(converted)
    if from == Dialect.V4 then clamped
    else
      val scene = MetalColors.inSpectra(clamped.scene)
      val spectral = SpectralColors.warning(scene, program(from), SpectralColors.Plain)
      Converted(InstanceMotions.toV4(scene), clamped.warnings ++ spectral)

  private def program(d: Dialect) = s"pbrt-${d.toString.toLowerCase(Locale.ROOT)}"

  /** Declarations of another dialect than the scene's come first: then it is of one dialect. Those
    * of the target's stay as they are.
    */
  private def foreignDeclarations(scene: SceneDescription, to: Dialect): Vector[Pass] =
    var isMixed = false
    val _ = Declarations.map(scene): d =>
      isMixed ||= d.dialect.exists(stated => stated != scene.dialect && stated != to)
      d
    Option.when(isMixed && scene.dialect == Dialect.V4)(ToV4View.pass.forForeign).toVector

  private def passes(from: Dialect, to: Dialect): Vector[Pass] = (from, to) match
    case (a, b) if a == b => Vector.empty
    case (Dialect.V2, Dialect.V3) => Vector(FromV2.pass)
    case (Dialect.V2, Dialect.V4) => Vector(FromV2.pass, ToV4View.pass)
    case (Dialect.V3, Dialect.V4) => Vector(ToV4View.pass)
    case (Dialect.V4, Dialect.V3) => Vector(ToV3View.pass)
    case _ => refuse(from)

  private def refuse(from: Dialect): Nothing =
    val message = s"can't convert a ${from.toString.toLowerCase(Locale.ROOT)} scene to v2"
    throw SceneError(Problem.general(Code.NoConversion, message, Some("use --to v3")))

/** Traverses the declarations of a description. */
object Declarations:

  /** The scene with `change` applied to every declaration; a declaration shared by several shapes
    * is changed once and stays shared.
    */
  def map(scene: SceneDescription)(change: Declaration => Declaration): SceneDescription =
    val materials = mutable.HashMap.empty[Declaration, Declaration]
    def shared(d: Declaration) = materials.getOrElseUpdate(d, change(d))
    def shape(s: ShapeDescription) = s.copy(
      shape = change(s.shape),
      material = s.material match
        case MaterialRef.Inline(d) => MaterialRef.Inline(shared(d))
        case other => other
      ,
      areaLight = s.areaLight.map(shared)
    )
    scene.copy(
      camera = scene.camera.map(change),
      film = scene.film.map(change),
      sampler = scene.sampler.map(change),
      filter = scene.filter.map(change),
      integrator = scene.integrator.map(change),
      accelerator = scene.accelerator.map(change),
      renderer = scene.renderer.map(change),
      volumeIntegrator = scene.volumeIntegrator.map(change),
      textures = scene.textures.map(t => t.copy(texture = change(t.texture))),
      namedMaterials = scene.namedMaterials.map((name, d) => (name, change(d))),
      lights = scene.lights.map(l => l.copy(light = change(l.light))),
      shapes = scene.shapes.map(shape),
      objects = scene.objects.map((name, shapes) => name -> shapes.map(shape)),
      media = scene.media.map(m => m.copy(medium = change(m.medium))),
      volumes = scene.volumes.map(v => v.copy(light = change(v.light)))
    )

/** Rewrites file names in parameters, relative to the folder of the scene, for a scene in another
  * folder.
  */
final class FileNames(to: Path):

  private val target = to.toAbsolutePath.normalize

  def moved(d: Declaration): Declaration =
    val oldFolder = d.folder.path.toAbsolutePath.normalize
    val newFolder = d.folder.at(to)
    if oldFolder == target || !d.params.exists(FileNames.isFile(d, _)) then
      d.copy(folder = newFolder)
    else
      val params = d.params.map: p =>
        if FileNames.isFile(d, p) then p.withStrings(p.strings.map(name(oldFolder, _))) else p
      d.copy(params = params, folder = newFolder)

  private def name(from: Path, written: String): String =
    try
      val file = Path.of(written.replace('\\', '/'))
      if written.isEmpty || file.isAbsolute then written
      else target.relativize(from.resolve(file).normalize).toString.replace('\\', '/')
    catch
      // Such a name refers to nothing in either folder; or the folders have no common root.
      case _: IllegalArgumentException => written

object FileNames:
  private val Names =
    Set("filename", "mapname", "bsdffile", "lensfile", "emissionfilename", "normalmap", "aperture")

  /** These name output files, which are left to the user. */
  private val Outputs = Set("Film", "Integrator", "SurfaceIntegrator", "Renderer")

  private def isFile(d: Declaration, p: Param): Boolean = p.paramType match
    case ParamType.String => Names(p.name) && !Outputs(d.category) && isNoWord(p, d)
    case ParamType.Spectrum => p.strings.exists(exists(d, _))
    case _ => false

  /** Warnings of files that the scene names, and that are not there. */
  def missing(scene: SceneDescription): Vector[Problem] =
    val warnings = Vector.newBuilder[Problem]
    val _ = Declarations.map(scene): d =>
      for
        p <- d.params if isFile(d, p)
        name <- p.strings if name.nonEmpty && !exists(d, name)
      do
        val message = s"no file `$name`; its name stays"
        warnings += Problem.warning(Code.NoSuchFile, p.pos, message)
      d
    warnings.result()

  /** An aperture may also be a keyword such as "star"; all other values are files. */
  private def isNoWord(p: Param, d: Declaration): Boolean =
    p.name != "aperture" || p.strings.exists(exists(d, _))

  private def exists(d: Declaration, name: String): Boolean = d.folder.belonging(name).nonEmpty
