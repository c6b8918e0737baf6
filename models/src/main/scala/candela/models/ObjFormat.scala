package candela.models

import candela.build.shapes.{ObjFile, ObjMesh}
import candela.diagnostics.{Code, Limit, SourcePos, Suggest}
import candela.io.InputFile
import candela.scenefile.{Dialect, PlacedText, SceneDescription}
import candela.settings.UpAxis

import scala.collection.mutable

/** Models in Wavefront's OBJ format with materials in MTL, as scenes. */
final class ObjFormat extends MeshFormat("OBJ", "obj", UpAxis.Y):

  private[models] def surfaces(input: InputFile, session: Session): SceneDescription =
    def at(line: Int, column: Int) = SourcePos(s"${session.file}", line, column)
    val mesh = ObjFile.read(input): (line, column, message) =>
      Session.fail(at(line, column), message)
    session.folder.allowance.check(Limit.Triangles, mesh.faces, Some(session.position)):
      s"the model has ${mesh.faces} faces"
    ObjScene(mesh, session).result()

private object ObjFormat:
  /** Statements that are understood and left out. */
  val Unsupported: Map[String, String] =
    Map("p" -> "points", "l" -> "lines", "usemap" -> "texture maps", "call" -> "other files") ++
      ("vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con bzp bsp cdc cdp " +
        "res ctech stech").split(' ').map(_ -> "free-form curves and surfaces")

  /** Statements that no picture depends on. */
  val Meaningless: Set[String] =
    "mg bevel c_interp d_interp lod shadow_obj trace_obj maplib mgl csh".split(' ').toSet

  private val Known =
    Vector("v", "vt", "vn", "f", "g", "o", "s", "usemtl", "mtllib") ++ Unsupported.keys

  def near(keyword: String): Option[String] = Suggest.help(keyword, Known)

private final class ObjScene(obj: ObjMesh, session: Session):
  private val pictures = Pictures(session)
  private val libraries = MtlLibraries(session)
  private val materials = MtlMaterials(session, pictures)
  private val meshes = ObjMeshes(obj)

  private def at(p: PlacedText) = SourcePos(s"${session.file}", p.line, p.column)

  def result(): SceneDescription =
    obj.omitted.foreach(warn)
    for library <- obj.libraries do libraries.read(library, at(library))
    val hasColors = obj.colors.nonEmpty
    val facesOf = mutable.LinkedHashMap.empty[Option[MtlMaterial], mutable.ArrayBuffer[Range]]
    for (run, i) <- obj.runs.zipWithIndex do
      facesOf.getOrElseUpdate(run.material.flatMap(material), mutable.ArrayBuffer.empty) +=
        obj.facesOf(i)
    val shapes = facesOf.toVector.flatMap: (material, ranges) =>
      val mesh = meshes.of(ranges.toVector)
      val surface = material.fold(
        MeshFormat.plain(hasColors, pictures, session.position, session)
      )(materials(_, hasColors))
      if mesh.uvs.isEmpty then
        for m <- material; p <- m.firstMap do
          session.warn(p, s"the faces of `${m.name}` have no texture coordinates")
      Option.when(mesh.indices.nonEmpty):
        MeshFormat.shape(mesh, surface, material.fold(session.position)(_.at), session)
    SceneDescription(
      Dialect.Gltf,
      textures = pictures.result(),
      namedMaterials = materials.result(),
      shapes = shapes
    )

  private val reported = mutable.HashSet.empty[String]

  /** What `usemtl` names; a material that is missing is reported once. */
  private def material(name: PlacedText): Option[MtlMaterial] =
    val result = libraries.named(name.text)
    if result.isEmpty && libraries.areComplete && reported.add(name.text) then
      val message = s"no material `${name.text}`; its faces have none"
      session.warn(at(name), message, Code.Undefined, Suggest.help(name.text, libraries.names))
    result

  private def warn(statement: PlacedText): Unit =
    val word = statement.text
    ObjFormat.Unsupported.get(word) match
      case Some(what) =>
        session.warn(at(statement), s"`$word`: $what are not supported; left out")
      case None if ObjFormat.Meaningless(word) => ()
      case None if word.contains(' ') => // no statement
        session.warn(at(statement), s"$word are left out", Code.BrokenMesh)
      case None =>
        session.warn(
          at(statement),
          s"unknown statement `$word`; left out",
          Code.UnknownDirective,
          ObjFormat.near(word)
        )
