package candela.models

import candela.base.loop
import candela.build.shapes.{PlyFile, PlyMesh}
import candela.io.InputFile
import candela.scenefile.SceneDescription
import candela.settings.UpAxis

/** Models in the polygon file format, as scenes. */
final class PlyFormat extends MeshFormat("PLY", "ply", UpAxis.Z):

  private[models] def surfaces(input: InputFile, session: Session): SceneDescription =
    val ply = PlyFile.read(input, keepsAll = true, cutsEars = true)
    for name <- ply.omitted do
      session.warn(session.position, s"`$name` is not supported; it is left out")
    MeshFormat.scene(PlyFormat.mesh(ply), session)

private object PlyFormat:
  private val Names =
    Vector("red green blue alpha", "r g b a", "diffuse_red diffuse_green diffuse_blue alpha")
      .map(_.split(' ').toVector)

  private def mesh(ply: PlyMesh): Mesh =
    val count = ply.positions.length / 3
    val plain = Mesh(ply.positions, ply.indices, ply.normals, ply.uvs, rests = ply.rests)
    colors(ply, ply.ofVertices, count) match
      case Some(colors) => plain.copy(colors = colors)
      case None =>
        colors(ply, ply.ofTriangles, ply.indices.length / 3).fold(plain)(plain.coloredByTriangle)

  /** Colours of so many vertices or triangles, in sRGB as Blender and MeshLab take them. */
  private def colors(
      ply: PlyMesh,
      properties: Vector[(String, Array[Float])],
      count: Int
  ): Option[Array[Float]] =
    val byName = properties.toMap
    Names.find(_.take(3).forall(byName.contains)).map: names =>
      val channels = names.map(byName.get)
      val result = new Array[Float](4 * count)
      loop(4): c =>
        val unit = ply.wholes.getOrElse(names(c), 1f)
        channels(c) match
          case Some(values) =>
            loop(count): i =>
              val x = values(i) / unit
              result(4 * i + c) =
                if c < 3 then MeshFormat.linear(x) else Math.max(0f, Math.min(x, 1f))
          case None => loop(count)(i => result(4 * i + c) = 1f)
      result
