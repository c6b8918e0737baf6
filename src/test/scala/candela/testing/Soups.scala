package candela.testing

import candela.math.*
import candela.shapes.{Disk, Shape, Sphere}

/** Triangles and shapes to test with, made from a few words. */
object Soups:

  export candela.bench.robustness.Solids.{
    randomTriangles, icosphere, indexed, of, sphere, Empty, Triangle
  }

  /** Quads across the given axis, their corners on a lattice of `cells` per unit. */
  def latticeQuads(draws: Draws, count: Int, cells: Int)(axis: => Int): Seq[Triangle] =
    Seq.fill(count)(axis).flatMap: k =>
      val at = Seq.fill(3)(draws.below(cells))
      def corner(a: Int, b: Int) =
        val i = at.updated((k + 1) % 3, at((k + 1) % 3) + a)
          .updated((k + 2) % 3, at((k + 2) % 3) + b)
        Vec3(i(0).toFloat / cells, i(1).toFloat / cells, i(2).toFloat / cells)
      Seq(
        (corner(0, 0), corner(1, 0), corner(1, 1)),
        (corner(0, 0), corner(1, 1), corner(0, 1))
      )

  /** Spheres and disks, whole and in parts, stretched and mirrored, of about `size`. */
  def shapes(draws: Draws, count: Int, size: Float)(centre: => Vec3): Seq[Shape] =
    Seq.tabulate(count): i =>
      val c = centre
      val toWorld = Transform.translate(c.x, c.y, c.z) * draws.rotation() * draws.stretch()
      val r = size * draws.between(0.1f, 0.5f)
      i % 4 match
        case 0 => sphere(toWorld, r)
        case 1 => Sphere(toWorld, r, -0.5f * r, 0.7f * r, draws.between(1, TwoPi), false)
        case 2 => Disk(toWorld, 0.1f * r, r, 0f, TwoPi, false)
        case _ => Disk(toWorld, -0.2f * r, r, 0.4f * r, draws.between(1, TwoPi), true)
