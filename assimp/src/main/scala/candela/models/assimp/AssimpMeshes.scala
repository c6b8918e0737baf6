package candela.models.assimp

import candela.base.loop
import candela.build.shapes.VertexNormals
import candela.diagnostics.Code
import candela.math.Vec3
import candela.models.{MeshFormat, Session}

import org.lwjgl.assimp.*

import scala.collection.mutable

/** Meshes of Assimp as those of glTF. */
private[assimp] final class AssimpMeshes(
    scene: AIScene,
    session: Session,
    suffix: String,
    arrays: Arrays
):
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
          val weights = weightsOf(first)
          if weights.nonEmpty then entry("weights") = ujson.Arr.from(weights)
          entries += entry
          entries.size - 1
      }
    )

  private def weightsOf(mesh: AIMesh): Vector[Double] =
    val weights = Arrays.all(mesh.mAnimMeshes)(AIAnimMesh.create).map(_.mWeight.toDouble)
    // Assimp has 1 for each of FBX, whatever the file says
    if suffix != "fbx" || weights.isEmpty then weights
    else
      val message = "the weights of its morph targets are not read; they are 0, unless --at " +
        "shows an animation that sets them"
      session.warn(AssimpScene.position(session, s"mesh ${mesh.mName.dataString}"), message)
      weights.map(_ => 0.0)

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
      lazy val restNormals = normals(mesh, mesh.mVertices)
      val targets =
        Arrays.all(mesh.mAnimMeshes)(AIAnimMesh.create).map(target(mesh, restNormals, _))
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

  /** Unit normals of a mesh with its vertices at these positions; 0 where there is none. */
  private def normals(mesh: AIMesh, positions: AIVector3D.Buffer): Array[Float] =
    val points = Array.tabulate(3 * positions.remaining): k =>
      val p = positions.get(k / 3)
      if k % 3 == 0 then p.x else if k % 3 == 1 then p.y else p.z
    val sums = VertexNormals.ofVertices(points, corners(mesh).toArray)
    loop(sums.length / 3): i =>
      val length = Vec3(sums(3 * i), sums(3 * i + 1), sums(3 * i + 2)).length
      if length > 0f then loop(3)(k => sums(3 * i + k) /= length)
    sums

  /** Assimp has the morphed vertices, glTF what they differ by.
    *
    * @param restNormals unit normals of the mesh as it is
    */
  private def target(mesh: AIMesh, restNormals: => Array[Float], morphed: AIAnimMesh): ujson.Obj =
    def difference(all: AIVector3D.Buffer | Null, from: AIVector3D.Buffer | Null) =
      for
        a <- Option(all)
        b <- Option(from)
        if a.remaining == b.remaining
      yield Array.tabulate(3 * a.remaining): k =>
        val (p, q) = (a.get(k / 3), b.get(k / 3))
        k % 3 match
          case 0 => p.x - q.x
          case 1 => p.y - q.y
          case _ => p.z - q.z
    val moves = difference(morphed.mVertices, mesh.mVertices)
    // Blender writes zeros, of which Assimp leaves rounding errors
    val written = difference(morphed.mNormals, mesh.mNormals).filter(_.exists(Math.abs(_) > 1e-5f))
    def computed =
      for
        positions <- Option(morphed.mVertices)
        if moves.isDefined && mesh.mNormals != null
      yield normals(mesh, positions).zip(restNormals).map(_ - _)
    val turns = written.orElse(computed)
    def array(values: Array[Float]) =
      ujson.Num(arrays.floats("VEC3", values.length / 3, values.iterator))
    ujson.Obj.from(moves.map("POSITION" -> array(_)) ++ turns.map("NORMAL" -> array(_)))
