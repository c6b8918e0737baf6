package candela.models.assimp

import candela.diagnostics.SourcePos
import candela.models.{GltfFile, Json, MeshFormat, Session}
import candela.settings.UpAxis

import org.lwjgl.assimp.*

import scala.collection.mutable

/** The scene that Assimp has read, as glTF: its nodes, meshes, cameras, lights and animations. The
  * materials are MTL's.
  *
  * @param suffix of the file
  * @param up     axis that points up in Assimp's scene
  */
private[assimp] final class AssimpScene(
    scene: AIScene,
    session: Session,
    suffix: String,
    up: UpAxis
):
  private val arrays = Arrays()
  private val materials = AssimpMaterials(scene, session, suffix)
  private val meshes = AssimpMeshes(scene, session, suffix, arrays)
  private val views = AssimpViews(scene, session, suffix)
  private val nodes = mutable.ArrayBuffer.empty[ujson.Obj]

  /** Of each name, the first node. */
  private val named = mutable.LinkedHashMap.empty[String, Int]
  private val skins = mutable.ArrayBuffer.empty[(AIMesh, Int)]
  private val animations = AssimpAnimations(scene, session, arrays)

  /** What a JSON pointer leads to, by its name. */
  def label(pointer: String): String = pointer.split('/') match
    case Array("", list, index, _*) =>
      def nameOf(all: collection.Seq[ujson.Obj]) =
        index.toIntOption.flatMap(all.lift).flatMap(_.value.get("name")).fold(index)(_.str)
      list match
        case "nodes" => s"node ${nameOf(nodes)}"
        case "meshes" => s"mesh ${nameOf(meshes.entries)}"
        case "materials" =>
          s"material ${index.toIntOption.flatMap(materials.all.lift).fold(index)(_.name)}"
        case "animations" => s"animation ${nameOf(animations.entries)}"
        case _ => s"$list $index"
    case _ => ""

  lazy val file: GltfFile =
    session.folder = session.folder.withParts(materials.images)
    val top = ujson.Obj("name" -> "root", "matrix" -> ujson.Arr.from(world))
    nodes += top
    top("children") = ujson.Arr(add(scene.mRootNode))
    for (name, child) <- views.loose(named.contains) do
      session.warn(session.position, s"there is no node `$name`, of a camera or a light")
      append(top, child)
    val morphed =
      for
        (node, i) <- nodes.zipWithIndex.toVector
        mesh <- node.value.get("mesh")
        targets = meshes.targets(mesh.num.toInt)
        if targets > 0
      yield (node("name").str, (i, targets))
    animations.read(named.toMap, morphed.groupMap(_._1)(_._2))
    val skinned = skins.toVector.map((mesh, node) => skin(mesh, node))
    val members = Seq[(String, ujson.Value)](
      "asset" -> ujson.Obj("version" -> "2.0"),
      "scenes" -> ujson.Arr(ujson.Obj("nodes" -> ujson.Arr(0))),
      "nodes" -> ujson.Arr.from(nodes),
      "meshes" -> ujson.Arr.from(meshes.entries),
      "skins" -> ujson.Arr.from(skinned.flatten),
      "materials" -> ujson.Arr.from(materials.all.map(m => ujson.Obj("name" -> m.name))),
      "animations" -> ujson.Arr.from(animations.entries)
    ) ++ views.members ++ arrays.members
    GltfFile(session, Json(ujson.Obj.from(members), "", session), arrays.buffer, materials.all)

  /** From Assimp's axes and units to a model's: those of FBX are centimetres. */
  private def world: Vector[Double] =
    val scale = AssimpScene.unit(suffix)
    val turn = if up == UpAxis.Y then candela.math.Transform.Identity else MeshFormat.Upright
    Vector.tabulate(16): i =>
      val (column, row) = (i / 4, i % 4)
      turn.m(4 * row + column) * (if column < 3 then scale else 1.0)

  private def append(parent: ujson.Obj, child: ujson.Obj): Int =
    nodes += child
    val index = nodes.size - 1
    val children = parent.value.getOrElseUpdate("children", ujson.Arr())
    children.arr += ujson.Num(index)
    index

  /** The index of a node and those below it; parents before children. */
  private def add(root: AINode): Int =
    val first = nodes.size
    val waiting = mutable.Stack((root, Option.empty[ujson.Obj]))
    while waiting.nonEmpty do
      val (node, parent) = waiting.pop()
      val name = node.mName.dataString
      val entry = ujson.Obj("name" -> name)
      val index = parent match
        case None =>
          nodes += entry
          first
        case Some(p) => append(p, entry)
      // The placement of what is animated consists of parts
      if animations.moves(name) then entry.value ++= AssimpAnimations.parts(node.mTransformation)
      else entry("matrix") = ujson.Arr.from(AssimpScene.columns(node.mTransformation))
      if !named.contains(name) then
        named(name) = index
        for child <- views.of(name) do append(entry, child): Unit
      addMeshes(node, entry)
      for child <- Arrays.all(node.mChildren)(AINode.create).reverse do
        waiting.push((child, Some(entry)))
    first

  private def addMeshes(node: AINode, entry: ujson.Obj): Unit =
    val indices = Option(node.mMeshes).fold(Vector.empty)(m =>
      Vector.tabulate(m.remaining)(m.get(_))
    )
    val (rigid, skinned) = indices.partition(meshes.all(_).mNumBones == 0)
    for mesh <- meshes.of(rigid) do entry("mesh") = mesh
    for i <- skinned; mesh <- meshes.of(Vector(i)) do
      val child = ujson.Obj("name" -> entry("name"), "mesh" -> mesh)
      skins += ((meshes.all(i), append(entry, child)))

  /** The skin of a mesh, whose node refers to it then. */
  private def skin(mesh: AIMesh, node: Int): Option[ujson.Obj] =
    val bones = Arrays.all(mesh.mBones)(AIBone.create)
    val joints = bones.map(b => named.get(b.mName.dataString))
    joints.indexOf(None) match
      case -1 =>
        val inverses = bones.iterator.flatMap(b => AssimpScene.columns(b.mOffsetMatrix))
        nodes(node)("skin") = skinCount
        skinCount += 1
        Some(ujson.Obj(
          "joints" -> ujson.Arr.from(joints.flatten),
          "inverseBindMatrices" -> arrays.floats("MAT4", bones.size, inverses.map(_.toFloat))
        ))
      case i =>
        val name = bones(i).mName.dataString
        session.warn(session.at(s"/nodes/$node"), s"there is no joint `$name`; it is not skinned")
        None

  private var skinCount = 0

private[assimp] object AssimpScene:
  /** The length of a unit, in metres. */
  def unit(suffix: String): Double = if suffix == "fbx" then 0.01 else 1.0

  def columns(m: AIMatrix4x4): Vector[Double] = Vector(
    m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4
  ).map(_.toDouble)

  def position(session: Session, what: String): SourcePos =
    SourcePos(s"${session.file}#$what", 0, 0)
