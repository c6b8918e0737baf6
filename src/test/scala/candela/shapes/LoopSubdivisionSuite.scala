package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*

class LoopSubdivisionSuite extends AnyFunSuite:
  import LoopMeshes.*

  private def at(values: Array[Float], i: Int): Vec3 =
    Vec3(values(3 * i), values(3 * i + 1), values(3 * i + 2))

  private def subdivided(mesh: Mesh, levels: Int): SubdividedMesh =
    LoopSubdivision.subdivide(levels, mesh.indices, mesh.positions)

  /** Edge by edge, how many faces have it. */
  private def edges(indices: Array[Int]): Map[Set[Int], Int] =
    def sides(f: Array[Int]) = Seq(Set(f(0), f(1)), Set(f(1), f(2)), Set(f(2), f(0)))
    indices.grouped(3).flatMap(sides).toVector.groupMapReduce(identity)(_ => 1)(_ + _)

  private def boundaryEdges(indices: Array[Int]): Seq[Set[Int]] =
    edges(indices).collect { case (edge, 1) => edge }.toSeq

  test("a vertex has its limit position at every level, inside closed surfaces"):
    for (name, mesh) <- closed; levels <- 1 to 5 do
      val (coarse, fine) = (subdivided(mesh, 0), subdivided(mesh, levels))
      for v <- 0 until mesh.vertexCount do
        // both are exact but for the rounding to Float
        val gap = (at(coarse.positions, v) - at(fine.positions, v)).length
        assert(gap < 4e-7f, s"$name, vertex $v, level $levels")

  test("brute-force refinement converges to the limit positions"):
    for (name, mesh) <- closed do
      val limit = subdivided(mesh, 1)
      val refined = (1 to 5).foldLeft(mesh)((m, _) => plainLoop(m))
      for v <- 0 until mesh.vertexCount do
        // the distance to the limit starts below 1 and shrinks by 4 or more a level: 4⁻⁵ ≈ 1e-3
        val gap = (at(limit.positions, v) - at(refined.positions, v)).length
        assert(gap < 1e-3f, s"$name, vertex $v: $gap")

  test("the tetrahedron's limit points keep its symmetry and have the known radius"):
    val radii = (0 until 4).map(v => at(subdivided(tetrahedron, 3).positions, v).length)
    // valence 3: β = 3/16, γ = 1/(3 + 3/(8β)) = 1/5; the ring's mean is −v/3: 2/5 − 3/5 · 1/3 = 1/5
    for r <- radii do assert(abs(r - sqrt(3f) / 5) < 2e-7f)

  test("the Euler characteristic is kept, every level makes four faces of one"):
    for (name, mesh) <- all; levels <- 0 to 3 do
      val fine = subdivided(mesh, levels)
      def characteristic(vertices: Int, indices: Array[Int]) =
        vertices - edges(indices).size + indices.length / 3
      assert(
        characteristic(fine.positions.length / 3, fine.indices) ==
          characteristic(mesh.vertexCount, mesh.indices),
        name
      )
      assert(fine.indices.length == mesh.indices.length << 2 * levels)

  test("triangles keep the winding of the input"):
    for (name, mesh) <- closed do
      val fine = subdivided(mesh, 3)
      for f <- fine.indices.grouped(3) do
        val Seq(a, b, c) = f.toSeq.map(at(fine.positions, _)): @unchecked
        assert((((b - a) cross (c - a)) dot a) > 0f, name)

  test("normals point to the side from which faces wind clockwise, the longest has length 1"):
    for (name, mesh) <- closed; levels <- 0 to 3 do
      val fine = subdivided(mesh, levels)
      val normals = (0 until fine.normals.length / 3).map(at(fine.normals, _))
      for (n, v) <- normals.zipWithIndex do
        val outward = at(fine.positions, v).normalized
        // all these bodies are round: 30° is generous, the wrong side would be −1
        assert((n.normalized dot outward) < -0.86f, s"$name, level $levels, vertex $v")
      assert(abs(normals.map(_.length).max - 1f) < 2e-7f, name)
    val turned = octahedron.indices.grouped(3).flatMap(_.reverse).toArray
    val mirrored = octahedron.copy(indices = turned)
    val fine = subdivided(mirrored, 2)
    for v <- 0 until fine.normals.length / 3 do
      assert((at(fine.normals, v) dot at(fine.positions, v)) > 0f)

  test("normals of the octahedron's corners are its axes"):
    val fine = subdivided(octahedron, 2)
    for v <- 0 until 6 do
      val axis = at(octahedron.positions, v)
      assert((at(fine.normals, v).normalized + axis).length < 1e-6f) // symmetric up to rounding

  test("a flat grid stays flat, its straight edges stay straight, its normals agree"):
    for levels <- 0 to 3 do
      val fine = subdivided(flatGrid, levels)
      val boundary = boundaryEdges(fine.indices)
      assert(boundary.size == 16 << levels)
      for v <- 0 until fine.positions.length / 3 do
        val (p, n) = (at(fine.positions, v), at(fine.normals, v))
        assert(p.z == 0f && n.x == 0f && n.y == 0f && n.z < 0f, s"level $levels, vertex $v")
      for e <- boundary do
        // the corners are rounded off: they reach from 0 to 1 along a side, so look between 1 and 3
        val ends = e.toSeq.map(at(fine.positions, _))
        val between = ends.forall(p => p.x > 1.01f && p.x < 2.99f)
        assert(!between || ends.forall(p => abs(p.y) < 1e-6f || abs(p.y - 4f) < 1e-6f), ends)

  test("a grid's inside is reproduced: limit points of vertices far from edges are the vertices"):
    val limit = subdivided(flatGrid, 0)
    val centre = 12
    assert((at(limit.positions, centre) - at(flatGrid.positions, centre)).length < 1e-6f)

  test("the boundary depends on boundary vertices alone, with weights 1/5, 3/5, 1/5"):
    val limit = subdivided(flatGrid, 0)
    // the corner (0, 0) has the neighbours (1, 0) and (0, 1)
    assert((at(limit.positions, 0) - Vec3(0.2f, 0.2f, 0f)).length < 1e-7f)
    val pushed = flatGrid.positions.clone()
    pushed(3 * 6 + 2) = 5f // an inner vertex, upwards
    val bent = LoopSubdivision.subdivide(2, flatGrid.indices, pushed)
    for e <- boundaryEdges(bent.indices); v <- e do
      assert(at(bent.positions, v).z == 0f)

  test("boundary normals of every valence lie on the side of the inner ones"):
    for faces <- 1 to 8 do
      val fan = fanMesh(faces)
      val limit = subdivided(fan, 0)
      for v <- 0 until fan.vertexCount do
        assert((at(limit.normals, v).normalized - Vec3(0, 0, -1)).length < 1e-6f, s"$faces $v")

  test("an open cap comes out as pbrt-v4 makes it"):
    // position and normal of each vertex; normals divided by the longest one's length
    val expected = Array(
      0.1f, 0.1f, 0.5f, 0.0698026f, 0.0664079f, -0.533857f, //
      1.65f, 0f, 0.0875f, -0.0537382f, 0.0171207f, -0.129507f, //
      0.825f, 1.65f, 0.325f, -0.0132314f, -0.0221341f, -0.129539f, //
      -0.825f, 1.475f, 0f, 0.0725105f, -0.0258022f, -0.141286f, //
      -1.3f, -0.65f, -0.325f, 0.0857313f, 0.0438766f, -0.149619f, //
      0.65f, -1.475f, -0.0875f, 0.0014305f, 0.0679473f, -0.139885f, //
      0.975f, 0.0166667f, 0.369792f, -0.202596f, 0.11632f, -0.823326f, //
      1.425f, 0.95f, 0.2375f, -0.173088f, -0.00961124f, -0.534479f, //
      0.495833f, 0.975f, 0.473958f, -0.0253f, -0.0793174f, -0.825584f, //
      0f, 1.875f, 0.225f, 0.121819f, -0.128942f, -0.549034f, //
      -0.4625f, 0.839583f, 0.302083f, 0.348524f, -0.073365f, -0.86626f, //
      -1.375f, 0.475f, -0.225f, 0.381333f, 0.0070486f, -0.603419f, //
      -0.670833f, -0.327083f, 0.130208f, 0.401531f, 0.221157f, -0.888742f, //
      -0.45f, -1.375f, -0.2375f, 0.199801f, 0.299904f, -0.598699f, //
      0.360417f, -0.80625f, 0.234375f, 0.0413689f, 0.333033f, -0.857216f, //
      1.4f, -0.925f, 0f, -0.151063f, 0.167088f, -0.545102f
    )
    val fine = subdivided(cap, 1)
    assert(fine.indices.take(12).toSeq == Seq(0, 6, 8, 6, 1, 7, 8, 7, 2, 6, 7, 8))
    for v <- 0 until 16; axis <- 0 until 3 do
      // printed with 6 digits; pbrt rounds to Float in between, and normals are products
      assert(abs(fine.positions(3 * v + axis) - expected(6 * v + axis)) < 1e-5f, s"vertex $v")
      assert(abs(fine.normals(3 * v + axis) - expected(6 * v + 3 + axis)) < 1e-5f, s"normal $v")

  test("vertices that no face uses are left out"):
    val extra = Mesh(octahedron.indices.map(_ + 1), Array(9f, 9f, 9f) ++ octahedron.positions)
    val (with0, without) = (subdivided(extra, 2), subdivided(octahedron, 2))
    assert(with0.positions.sameElements(without.positions))
    assert(with0.indices.sameElements(without.indices))

  test("fans that touch in one vertex are accepted"):
    val bowTie = Mesh(
      Array(0, 1, 2, 0, 3, 4),
      Array(0, 0, 0, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0)
    )
    val fine = subdivided(bowTie, 2)
    assert(fine.indices.length == 3 * 2 * 16)
    assert(fine.positions.forall(java.lang.Float.isFinite(_)))

  private def refused(levels: Int, indices: Array[Int], positions: Array[Float]): String =
    intercept[MeshError](LoopSubdivision.subdivide(levels, indices, positions)).getMessage

  test("a third face at an edge ends there, and shares the vertex on the edge"):
    val corners = Array[Float](-1, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0.5f, 1)
    val fine = LoopSubdivision.subdivide(1, Array(0, 1, 2, 1, 0, 3, 0, 1, 4), corners)
    assert(fine.indices.length == 3 * 12)
    // 5 corners and 7 edges
    assert(fine.positions.length == 3 * 12)
    assert(fine.crowded.exists(_.startsWith("the edge between vertices 0 and 1 belongs to 3")))

  test("malformed meshes are refused with the faces and vertices that are wrong"):
    val square = Array[Float](0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 2, 2)
    assert(refused(1, Array(0, 1, 2, 0, 2, 5), square) ==
      "face 1 uses vertex 5; there are 5, counted from 0")
    assert(refused(1, Array(0, 1, -2), square) ==
      "face 0 uses vertex -2; there are 5, counted from 0")
    assert(refused(1, Array(0, 1, 2, 3, 1, 3), square) == "face 1 uses a vertex twice: 3, 1, 3")
    assert(refused(1, Array(0, 1, 2, 0, 1, 3), square) ==
      "faces 0 and 1 wind opposite ways: both run from vertex 0 to vertex 1")
    assert(refused(1, Array(0, 1, 2, 0), square) == "4 indices are not a multiple of 3")
    assert(refused(1, Array(), square) == "the mesh has no faces")
    assert(refused(1, Array(0, 1, 2), square.take(8)) ==
      "8 coordinates are not a multiple of 3")
    assert(refused(-1, Array(0, 1, 2), square) ==
      "levels of subdivision must not be negative, found -1")
    assert(refused(15, Array(0, 1, 2), square) == "15 levels make too many triangles of 1")
    assert(refused(1, Array(0, 1, 2), square.updated(4, Float.NaN)) ==
      "a coordinate of vertex 1 is NaN")
