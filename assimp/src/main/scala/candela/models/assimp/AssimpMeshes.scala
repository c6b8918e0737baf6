package candela.models.assimp

import candela.base.loop
import candela.diagnostics.Code
import candela.models.{MeshFormat, Session}

import org.lwjgl.assimp.*

import scala.collection.mutable

/** Meshes of Assimp as those of glTF. */
private[assimp] final class AssimpMeshes(scene: AIScene, session: Session, arrays: Arrays):
  val all: Vector[AIMesh] = Arrays.all(scene.mMeshes)(AIMesh.create)
  val entries: mutable.ArrayBuffer[ujson.Obj] = mutable.ArrayBuffer.empty
  private val primitives = mutable.HashMap.empty[Int, Option[ujson.Obj]]
  private val indices = mutable.HashMap.empty[Vector[Int], Option[Int]]

  /** The index of the mesh that consists of several of Assimp's, if any has triangles. */
  def of(parts: Vector[Int]): Option[Int] =
    indices.getOrElseUpdate(
      parts, {
        val described =
          parts.flatMap(i => primitives.getOrElseUpdate(i, primitive(all(i))).map(i -> _))
        Option.when(described.nonEmpty):
          val first = all(described.head._1)
          val entry = ujson.Obj(
            "name" -> first.mName.dataString,
            "primitives" -> ujson.Arr.from(described.map(_._2))
          )
          val weights = Arrays.all(first.mAnimMeshes)(AIAnimMesh.create).map(_.mWeight.toDouble)
          if weights.nonEmpty then entry("weights") = ujson.Arr.from(weights)
          entries += entry
          entries.size - 1
      }
    )

  /** How many morph targets a mesh has. */
  def targets(mesh: Int): Int = entries(mesh).value.get("weights").fold(0)(_.arr.size)

  private def primitive(mesh: AIMesh): Option[ujson.Obj] =
    val at = AssimpScene.position(session, s"mesh ${mesh.mName.dataString}")
    if (mesh.mPrimitiveTypes & Assimp.aiPrimitiveType_TRIANGLE) == 0 then
      session.warn(at, "points and lines have no surface; ignored", Code.BrokenMesh)
      None
    else
      val count = mesh.mNumVertices
      val attributes = ujson.Obj("POSITION" -> arrays.native("VEC3", count, mesh.mVertices.address))
      for n <- Option(mesh.mNormals) do
        attributes("NORMAL") = arrays.native("VEC3", count, n.address)
      val uvs = (0 until Assimp.AI_MAX_NUMBER_OF_TEXTURECOORDS)
        .flatMap(set => Option(mesh.mTextureCoords(set)))
      for (uv, set) <- uvs.take(2).zipWithIndex do
        attributes(s"TEXCOORD_$set") = arrays.native("VEC2", count, uv.address)
      for colors <- Option(mesh.mColors(0)) do
        attributes("COLOR_0") = arrays.floats("VEC4", count, linear(colors))
      if mesh.mNumBones > 0 then joints(mesh, attributes)
      val entry = ujson.Obj(
        "attributes" -> attributes,
        "material" -> mesh.mMaterialIndex,
        "indices" -> arrays.ints("SCALAR", 3 * mesh.mNumFaces, corners(mesh))
      )
      val targets = Arrays.all(mesh.mAnimMeshes)(AIAnimMesh.create).map(target(mesh, _))
      if targets.nonEmpty then entry("targets") = ujson.Arr.from(targets)
      Some(entry)

  private def corners(mesh: AIMesh): Iterator[Int] =
    val faces = mesh.mFaces
    for
      f <- Iterator.range(0, mesh.mNumFaces)
      corners = faces.get(f).mIndices
      c <- Iterator.range(0, 3)
    yield corners.get(c)

  /** Colours of vertices are sRGB's, as in other formats of meshes. */
  private def linear(colors: AIColor4D.Buffer): Iterator[Float] =
    Iterator.range(0, colors.remaining).flatMap: i =>
      val c = colors.get(i)
      Iterator(MeshFormat.linear(c.r), MeshFormat.linear(c.g), MeshFormat.linear(c.b), c.a)

  /** Four joints of each vertex. */
  private def joints(mesh: AIMesh, attributes: ujson.Obj): Unit =
    val joints = new Array[Int](4 * mesh.mNumVertices)
    val weights = new Array[Float](4 * mesh.mNumVertices)
    val counts = new Array[Int](mesh.mNumVertices)
    for (bone, j) <- Arrays.all(mesh.mBones)(AIBone.create).zipWithIndex do
      val all = bone.mWeights
      loop(bone.mNumWeights): k =>
        val v = all.get(k).mVertexId
        if v >= 0 && v < counts.length && counts(v) < 4 then
          joints(4 * v + counts(v)) = j
          weights(4 * v + counts(v)) = all.get(k).mWeight
          counts(v) += 1
    attributes("JOINTS_0") = arrays.ints("VEC4", mesh.mNumVertices, joints.iterator)
    attributes("WEIGHTS_0") = arrays.floats("VEC4", mesh.mNumVertices, weights.iterator)

  /** Assimp has the morphed vertices, glTF what they differ by. */
  private def target(mesh: AIMesh, morphed: AIAnimMesh): ujson.Obj =
    def difference(all: AIVector3D.Buffer | Null, from: AIVector3D.Buffer | Null) =
      for
        a <- Option(all)
        b <- Option(from)
        if a.remaining == b.remaining
      yield
        val values = Iterator.range(0, a.remaining).flatMap: i =>
          val (p, q) = (a.get(i), b.get(i))
          Iterator(p.x - q.x, p.y - q.y, p.z - q.z)
        ujson.Num(arrays.floats("VEC3", a.remaining, values))
    ujson.Obj.from(
      difference(morphed.mVertices, mesh.mVertices).map("POSITION" -> _) ++
        difference(morphed.mNormals, mesh.mNormals).map("NORMAL" -> _)
    )
