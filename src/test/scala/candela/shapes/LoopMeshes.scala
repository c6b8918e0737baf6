package candela.shapes

import candela.math.*

/** Small meshes to subdivide, and Loop's rules in their plainest form to compare with. */
object LoopMeshes:

  final case class Mesh(indices: Array[Int], positions: Array[Float]):
    def vertexCount: Int = positions.length / 3

  // closed bodies around the origin, counter-clockwise seen from outside

  val tetrahedron: Mesh = Mesh(
    Array(0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2),
    Array(1, 1, 1, -1, 1, -1, -1, -1, 1, 1, -1, -1)
  )
  val octahedron: Mesh = Mesh(
    Array(0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5),
    Array(1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1)
  )

  /** Each side is two triangles; corner i has the bits of i as x, y, z. */
  val cube: Mesh =
    val sides = Seq(
      (0, 2, 3, 1),
      (4, 5, 7, 6),
      (0, 1, 5, 4),
      (2, 6, 7, 3),
      (0, 4, 6, 2),
      (1, 3, 7, 5)
    )
    Mesh(
      sides.flatMap((a, b, c, d) => Seq(a, b, c, a, c, d)).toArray,
      (0 until 8).flatMap(i => Seq(i & 1, i >> 1 & 1, i >> 2).map(2f * _ - 1)).toArray
    )

  /** 4 × 4 squares of side 1, in the plane z = 0. */
  val flatGrid: Mesh =
    val squares = for y <- 0 until 4; x <- 0 until 4 yield 5 * y + x
    Mesh(
      squares.flatMap(i => Seq(i, i + 1, i + 6, i, i + 6, i + 5)).toArray,
      (0 until 25).flatMap(i => Seq((i % 5).toFloat, (i / 5).toFloat, 0f)).toArray
    )

  /** A five-sided roof over an uneven rim. */
  val cap: Mesh = Mesh(
    Array(0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 1),
    Array(0, 0, 1, 2, 0, 0, 1, 2, 0.5f, -1, 2, 0, -2, -1, -0.5f, 1, -2, 0)
  )

  /** Faces side by side around vertex 0, over half a turn. */
  def fanMesh(faces: Int): Mesh =
    val rim = (0 to faces).flatMap: i =>
      val angle = Math.PI * i / (faces + 1)
      Seq(Math.cos(angle).toFloat, Math.sin(angle).toFloat, 0f)
    Mesh((1 to faces).flatMap(i => Seq(0, i, i + 1)).toArray, Array(0f, 0f, 0f) ++ rim)

  val closed: Seq[(String, Mesh)] =
    Seq("tetrahedron" -> tetrahedron, "octahedron" -> octahedron, "cube" -> cube)
  val all: Seq[(String, Mesh)] = closed ++ Seq("grid" -> flatGrid, "fan" -> fanMesh(3))

  /** One level of Loop's rules for closed meshes, written straight down: slow, but plain to see. */
  def plainLoop(mesh: Mesh): Mesh =
    val coordinates = mesh.positions
    def point(i: Int) = Vec3(coordinates(3 * i), coordinates(3 * i + 1), coordinates(3 * i + 2))
    val faces = mesh.indices.grouped(3).map(_.toVector).toVector
    val around = scala.collection.mutable.Map[Int, Set[Int]]().withDefaultValue(Set())
    val opposite = scala.collection.mutable.Map[Set[Int], Vector[Int]]().withDefaultValue(Vector())
    for f <- faces; k <- 0 until 3 do
      around(f(k)) ++= f.toSet - f(k)
      opposite(Set(f(k), f((k + 1) % 3))) :+= f((k + 2) % 3)
    val even = (0 until mesh.vertexCount).map: v =>
      val n = around(v).size
      val beta = if n == 3 then 3f / 16 else 3f / (8 * n)
      point(v) * (1 - n * beta) + around(v).map(point).reduce(_ + _) * beta
    val pairs = opposite.keys.toVector
    val number = pairs.zipWithIndex.map((e, i) => e -> (mesh.vertexCount + i)).toMap
    val odd = pairs.map: e =>
      e.map(point).reduce(_ + _) * 0.375f + opposite(e).map(point).reduce(_ + _) * 0.125f
    val split = faces.flatMap: f =>
      val o = Vector(0, 1, 2).map(k => number(Set(f(k), f((k + 1) % 3))))
      Vector(f(0), o(0), o(2), o(0), f(1), o(1), o(2), o(1), f(2), o(0), o(1), o(2))
    Mesh(split.toArray, (even ++ odd).flatMap(p => Seq(p.x, p.y, p.z)).toArray)
