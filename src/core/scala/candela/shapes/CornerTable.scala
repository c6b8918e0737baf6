package candela.shapes

import candela.base.loop
import scala.collection.mutable

/** Connectivity of a triangle mesh in flat arrays. Corner 3f + k is vertex k of face f, and also
  * represents the edge from that vertex to the face's next vertex.
  *
  * Source: Rossignac, Safonova, Szymczak, "3D compression made simple: Edgebreaker on a corner
  * table", SMI 2001.
  *
  * @param vertices vertex at each corner
  * @param twins    the same edge in the adjacent face, or −1 on the boundary
  * @param start    a corner of each vertex, where the traversal of its one-ring begins
  * @param crowded  a corner on an edge of more than two faces, if there is one
  */
private[shapes] final class CornerTable(
    val vertices: Array[Int],
    val twins: Array[Int],
    val start: Array[Int],
    val crowded: Option[Int] = None
):
  import CornerTable.{next, previous}

  def vertexCount: Int = start.length

  /** Writes the one-ring of `vertex` into `ring`: clockwise from an arbitrary neighbour for an
    * interior vertex (if faces wind counter-clockwise), counter-clockwise from edge to edge for a
    * boundary vertex.
    *
    * @return the number of neighbours, negated on the boundary
    */
  def ring(vertex: Int, ring: Array[Int]): Int =
    val first = start(vertex)
    var corner = first
    var count = 0
    while
      ring(count) = vertices(next(corner))
      count += 1
      val across = twins(corner)
      if across >= 0 then corner = next(across)
      across >= 0 && corner != first
    do ()
    if twins(corner) >= 0 then count
    else
      ring(0) = vertices(next(corner))
      count = 1
      while corner >= 0 do
        ring(count) = vertices(previous(corner))
        count += 1
        corner = twins(previous(corner))
      -count

  /** Upper bound of the one-ring size. */
  def longestRing: Int =
    val corners = new Array[Int](vertexCount)
    vertices.foreach(v => corners(v) += 1)
    corners.max + 1

private[shapes] object CornerTable:

  inline def next(corner: Int): Int = if corner % 3 == 2 then corner - 2 else corner + 1
  inline def previous(corner: Int): Int = if corner % 3 == 0 then corner + 2 else corner - 1

  /** Computes the adjacency of all faces.
    *
    * The first two faces at an edge are neighbours, so are the next two.
    *
    * @throws MeshError if two neighbours run along their edge the same way
    */
  def of(vertices: Array[Int], vertexCount: Int): CornerTable =
    val open = mutable.LongMap[Int]()
    val closed = mutable.LongMap[Unit]()
    val twins = Array.fill(vertices.length)(-1)
    val start = Array.fill(vertexCount)(-1)
    var crowded = Option.empty[Int]
    loop(vertices.length): corner =>
      val from = vertices(corner)
      val to = vertices(next(corner))
      val edge = key(Math.min(from, to), Math.max(from, to))
      start(from) = corner
      val twin = open.getOrElse(edge, -1)
      if twin < 0 then
        if closed.contains(edge) then crowded = crowded.orElse(Some(corner))
        open(edge) = corner
      else if vertices(twin) == from then throw MeshError(opposed(vertices, corner, twin))
      else
        twins(corner) = twin
        twins(twin) = corner
        open.subtractOne(edge)
        closed(edge) = ()
    CornerTable(vertices, twins, start, crowded)

  /** Unique key of an edge. The factor scrambles it: the map folds the halves together, and
    * those of the plain key are alike in most edges.
    */
  private def key(from: Int, to: Int): Long = (from.toLong << 32 | to) * 0x9e3779b97f4a7c15L

  private def opposed(vertices: Array[Int], corner: Int, twin: Int): String =
    s"faces ${twin / 3} and ${corner / 3} wind opposite ways: both run from vertex " +
      s"${vertices(corner)} to vertex ${vertices(next(corner))}"

  /** What is said of a corner on an edge of more than two faces.
    *
    * @param vertices of the input
    */
  def described(corner: Int, vertices: Array[Int]): String =
    val (from, to) = (vertices(corner), vertices(next(corner)))
    val faces = vertices.indices.filter: c =>
      val ends = Set(vertices(c), vertices(next(c)))
      ends == Set(from, to)
    .map(_ / 3)
    s"the edge between vertices $from and $to belongs to ${faces.size} faces " +
      s"(${faces.take(8).mkString(", ")}); the first two are neighbours, the others end there"
