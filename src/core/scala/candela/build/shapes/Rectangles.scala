package candela.build.shapes

import candela.math.{Transform, Vec3}
import candela.shapes.RectangleSampler

/** Finds meshes whose triangles form rectangles, two by two: most emitters do. */
private[build] object Rectangles:

  /** The rectangles in world space, in the order of the triangles; none if a triangle is left over.
    */
  def of(mesh: ShapeGeometry.Triangles, toWorld: Transform): Vector[RectangleSampler.Corners] =
    val triangles = mesh.indices.length / 3
    if triangles == 0 || triangles % 2 != 0 then Vector.empty
    else
      val points = SoupBuilder.points(mesh.positions, toWorld)
      def vector(data: Array[Float], i: Int) = Vec3(data(3 * i), data(3 * i + 1), data(3 * i + 2))
      def corners(t: Int, data: Array[Float]) =
        Vector.tabulate(3)(k => vector(data, mesh.indices(3 * t + k)))

      /** By vertex: does the normal there turn the triangle over? */
      def turns(t: Int): Vector[Boolean] =
        val Vector(a, b, c) = corners(t, mesh.positions): @unchecked
        val facet = (b - a) cross (c - a)
        if mesh.normals.length == 0 then Vector(false)
        else corners(t, mesh.normals).map(n => (facet dot n) < 0f)

      val rectangles = Iterator.range(0, triangles, 2).map: t =>
        RectangleSampler
          .of(corners(t, points), corners(t + 1, points))
          .filter(_ => (turns(t) ++ turns(t + 1)).distinct.size == 1)
      val samplers = rectangles.takeWhile(_.isDefined).flatten.toVector
      if 2 * samplers.size == triangles then samplers else Vector.empty
