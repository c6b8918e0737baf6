package candela.models

import candela.base.{indexWhere, loop}
import candela.diagnostics.Code
import candela.math.{Transform, Vec3}
import candela.scenefile.{Declaration, Param}

/** Numbers of a primitive's vertices; each array but the positions may be empty. */
private[models] final case class Vertices(
    positions: Array[Float],
    normals: Array[Float],
    tangents: Array[Float]
)

/** How vertices follow joints: four joints and weights each, or multiples of that. */
private[models] final case class Skin(joints: Vector[Transform])

/** Reads primitives of meshes.
  *
  * Source: glTF 2.0 specification, §3.7.
  */
private[models] final class Primitives(file: GltfFile, session: Session):
  private val accessors = Accessors(file, session)

  /** Whether its vertices have colours. */
  def hasColors(primitive: Json): Boolean = attribute(primitive, "COLOR_0").isDefined

  private def attribute(primitive: Json, name: String): Option[Json] =
    primitive.required("attributes")(name)

  /** The shape of a primitive; None if it has no surface.
    *
    * @param weights of its morph targets
    */
  def shape(
      primitive: Json,
      weights: Vector[Double],
      skin: Option[Skin],
      extra: Vector[Param]
  ): Option[Declaration] =
    for
      e <- primitive("extensions"); name <- e.names
      if name != Variants.Name && name != Primitives.Draco
    do
      session.warn(e.at, s"`$name` of a primitive is not supported; ignored")
    val position = attribute(primitive, "POSITION")
    for e <- primitive.extension(Primitives.Draco) do
      // Accessors may have the mesh uncompressed, too
      if !position.exists(p => accessors.entry(p)("bufferView").isDefined) then
        val message = "meshes compressed by Draco are not supported"
        Session.fail(e.at, message, Code.Unsupported, Remedies.of(Primitives.Draco))
    val mode = primitive.size("mode", Primitives.Triangles)
    if position.isEmpty then
      session.warn(primitive.at, "a primitive without positions is ignored")
      None
    else if mode < Primitives.Triangles then
      session.warn(primitive.at, "points and lines have no surface; ignored")
      None
    else
      // Read first: a count that is too large is an error before anything else is made of it
      val count = accessors.floats(position.get, 3).length / 3
      val corners = triangles(primitive, mode, count)
      Option.when(corners.nonEmpty):
        val placed = skinned(primitive, morphed(primitive, count, weights), count, skin)
        declare(primitive, placed, count, corners, extra)

  private def declare(
      primitive: Json,
      v: Vertices,
      count: Int,
      corners: Array[Int],
      extra: Vector[Param]
  ): Declaration =
    val at = primitive.at
    def uvs(set: Int) = vertexFloats(primitive, s"TEXCOORD_$set", count, 2).map(upright)
    val mesh = Mesh(
      v.positions,
      corners,
      v.normals,
      uvs(0).getOrElse(Array.emptyFloatArray),
      colors(primitive, count).getOrElse(Array.emptyFloatArray),
      tangents = v.tangents,
      secondUvs = uvs(1).getOrElse(Array.emptyFloatArray)
    )
    session.declare("Shape", "trianglemesh", at, mesh.params(at) ++ extra)

  /** v begins at the bottom of images. */
  private def upright(uvs: Array[Float]): Array[Float] =
    val out = uvs.clone
    loop(out.length / 2)(i => out(2 * i + 1) = 1f - out(2 * i + 1))
    out

  private def colors(primitive: Json, count: Int): Option[Array[Float]] =
    attribute(primitive, "COLOR_0").map: index =>
      val componentCount = accessors.components(index)
      if componentCount == 4 then counted(index, count, 4)
      else
        val rgb = counted(index, count, 3)
        Array.tabulate(4 * count)(i => if i % 4 == 3 then 1f else rgb(i / 4 * 3 + i % 4))

  private def vertexFloats(
      primitive: Json,
      name: String,
      count: Int,
      each: Int
  ): Option[Array[Float]] =
    attribute(primitive, name).map(counted(_, count, each))

  /** Numbers for so many vertices. */
  private def counted(index: Json, count: Int, each: Int): Array[Float] =
    val numbers = accessors.floats(index, each)
    if numbers.length != count * each then
      index.fail(s"expected values for $count vertices, found ${numbers.length / each}")
    numbers

  /** Three vertices of each triangle. */
  private def triangles(primitive: Json, mode: Int, vertices: Int): Array[Int] =
    val order = primitive("indices") match
      case Some(index) =>
        val all = accessors.ints(index)
        indexWhere(all.length)(i => all(i) < 0 || all(i) >= vertices) match
          case -1 => all
          case i => index.fail(s"expected indices of $vertices vertices, found ${all(i)}")
      case None => Array.range(0, vertices)
    val count = order.length
    mode match
      case Primitives.Triangles => if count % 3 == 0 then order else order.take(count - count % 3)
      case Primitives.Strip =>
        val out = new Array[Int](3 * Math.max(0, count - 2))
        loop(count - 2): i =>
          out(3 * i) = order(i)
          out(3 * i + 1) = order(i + 1 + i % 2)
          out(3 * i + 2) = order(i + 2 - i % 2)
        out
      case Primitives.Fan =>
        val out = new Array[Int](3 * Math.max(0, count - 2))
        loop(count - 2): i =>
          out(3 * i) = order(i + 1)
          out(3 * i + 1) = order(i + 2)
          out(3 * i + 2) = order(0)
        out
      case other => primitive.required("mode").fail(s"expected a mode from 0 to 6, found $other")

  private def morphed(primitive: Json, count: Int, weights: Vector[Double]): Vertices =
    val normals = vertexFloats(primitive, "NORMAL", count, 3)
    // Without normals, surfaces are flat, and tangents mean nothing
    val tangents = normals.flatMap(_ => vertexFloats(primitive, "TANGENT", count, 4))
    val start = Vertices(
      vertexFloats(primitive, "POSITION", count, 3).get,
      normals.getOrElse(Array.emptyFloatArray),
      tangents.getOrElse(Array.emptyFloatArray)
    )
    primitive.list("targets").zip(weights).filter(_._2 != 0).foldLeft(start):
      case (v, (target, weight)) =>
        for name <- target.names if !Primitives.Morphed(name) do
          session.warn(target.at, s"`$name` of a morph target is not supported; ignored")
        def changed(values: Array[Float], each: Int, name: String) =
          target(name).filter(_ => values.nonEmpty).fold(values): index =>
            val delta = counted(index, count, 3)
            val out = values.clone
            loop(count): i =>
              loop(3)(c => out(each * i + c) += (weight * delta(3 * i + c)).toFloat)
            out
        Vertices(
          changed(v.positions, 3, "POSITION"),
          changed(v.normals, 3, "NORMAL"),
          changed(v.tangents, 4, "TANGENT")
        )

  private def skinned(primitive: Json, v: Vertices, count: Int, skin: Option[Skin]): Vertices =
    val sets = Iterator.from(0).takeWhile(k => attribute(primitive, s"JOINTS_$k").isDefined)
      .map(k => (joints(primitive, k, count), vertexFloats(primitive, s"WEIGHTS_$k", count, 4)))
      .collect { case (indices, Some(weights)) => (indices, weights) }.toVector
    if skin.isEmpty || sets.isEmpty then v
    else
      val bones = skin.get.joints
      val index = primitive.required("attributes")
      for
        (joints, _) <- sets
        i = indexWhere(joints.length)(i => joints(i) < 0 || joints(i) >= bones.size) if i >= 0
      do index.fail(s"expected joints of a skin of ${bones.size}, found ${joints(i)}")
      val (p, n, t) = (v.positions.clone, v.normals.clone, v.tangents.clone)
      loop(count): i =>
        var (position, normal, tangent) = (Vec3.Zero, Vec3.Zero, Vec3.Zero)
        def triple(values: Array[Float], at: Int) = Vec3(values(at), values(at + 1), values(at + 2))
        var total = 0f
        for (indices, weights) <- sets do
          loop(4): k =>
            val w = weights(4 * i + k)
            if w != 0f then
              val bone = bones(indices(4 * i + k))
              total += w
              position = position + bone.point(triple(v.positions, 3 * i)) * w
              if n.nonEmpty then normal = normal + bone.normal(triple(v.normals, 3 * i)) * w
              if t.nonEmpty then tangent = tangent + bone.vector(triple(v.tangents, 4 * i)) * w
        def store(values: Array[Float], at: Int, x: Vec3): Unit =
          values(at) = x.x
          values(at + 1) = x.y
          values(at + 2) = x.z
        if total > 0f then
          store(p, 3 * i, position * (1f / total))
          if n.nonEmpty then store(n, 3 * i, normal)
          if t.nonEmpty then store(t, 4 * i, tangent)
      Vertices(p, n, t)

  private def joints(primitive: Json, set: Int, count: Int): Array[Int] =
    val index = attribute(primitive, s"JOINTS_$set").get
    val all = accessors.ints(index)
    if all.length != 4 * count then index.fail(s"expected joints of $count vertices")
    all

  /** Matrices of an accessor, by columns. */
  def matrices(index: Json): Vector[Array[Float]] = accessors.floats(index, 16).grouped(16).toVector

  /** Translations, rotations and scales of instances. */
  def instanceNumbers(attributes: Json, name: String, each: Int): Option[Array[Float]] =
    attributes(name).map: index =>
      // Zeros that are in no buffer would be millions of instances in a file of some bytes
      if accessors.entry(index)("bufferView").isEmpty then
        index.fail("numbers of instances must be in a buffer view")
      accessors.floats(index, each)

private[models] object Primitives:
  private val Draco = "KHR_draco_mesh_compression"
  private val Triangles = 4
  private val Strip = 5
  private val Fan = 6
  private val Morphed = Set("POSITION", "NORMAL", "TANGENT")
