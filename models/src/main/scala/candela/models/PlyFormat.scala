package candela.models

import candela.base.{IntBuffer, loop}
import candela.build.shapes.{PlyFile, PlyMesh}
import candela.diagnostics.{Code, SourcePos}
import candela.io.InputFile
import candela.job.SceneFormat
import candela.scenefile.SceneDescription
import candela.settings.UpAxis

/** Models in the polygon file format, as scenes. */
final class PlyFormat extends MeshFormat("PLY", "ply", UpAxis.Z):

  private[models] def surfaces(input: InputFile, session: Session): SceneDescription =
    val ply = PlyFile.read(input, keepsAll = true, isModel = true)
    for name <- ply.omitted do
      session.warn(session.position, s"`$name` is not supported; it is left out")
    val (mesh, pictures) = (PlyFormat.mesh(ply), Pictures(session))
    val isTextured = ply.images.nonEmpty && mesh.uvs.nonEmpty
    if ply.images.nonEmpty && !isTextured then
      session.warn(session.position, "the model has an image, but no texture coordinates")
    val images = if isTextured then PlyFormat.images(ply, pictures, session) else Vector.empty
    MeshFormat.scene(PlyFormat.byImage(mesh, ply, images, session), pictures, session)

private object PlyFormat:
  private val Names =
    Vector("red green blue alpha", "r g b a", "diffuse_red diffuse_green diffuse_blue alpha")
      .map(_.split(' ').toVector)

  /** The number of its image, of a face, as MeshLab writes it. */
  private val ImageNumber = "texnumber"

  private def mesh(ply: PlyMesh): Mesh =
    val count = ply.positions.length / 3
    val plain = Mesh(ply.positions, ply.indices, ply.normals, ply.uvs, rests = ply.rests)
    val ofVertices = colors(ply, ply.ofVertices, count)
    val colored = ofVertices.fold(plain)(c => plain.copy(colors = c))
    val placed =
      if ply.cornerUvs.isEmpty then colored else colored.withCornerUvs(ply.cornerUvs)
    val ofFaces =
      if ofVertices.isEmpty then colors(ply, ply.ofTriangles, ply.indices.length / 3) else None
    ofFaces.fold(placed)(placed.coloredByTriangle)

  private def images(ply: PlyMesh, pictures: Pictures, session: Session): Vector[Picture] =
    ply.images.map: image =>
      // MeshLab's word for the name of the model
      val file = image.text.replace("<this>", SceneFormat.stem(session.file))
      val at = SourcePos(s"${session.file}", image.line, image.column)
      Picture(
        pictures.fileName("", file, at),
        second = false,
        Picture.Upright,
        Wraps("repeat", "repeat"),
        isSmooth = true,
        at
      )

  /** The triangles of each image. */
  private def byImage(
      mesh: Mesh,
      ply: PlyMesh,
      images: Vector[Picture],
      session: Session
  ): Vector[(Mesh, Option[Picture])] =
    val numbers = ply.ofTriangles.collectFirst { case (ImageNumber, values) => values }
    if images.size < 2 || numbers.isEmpty then Vector(mesh -> images.headOption)
    else
      val parts = Vector.fill(images.size + 1)(IntBuffer())
      loop(mesh.indices.length): i =>
        val number = numbers.get(i / 3).toInt
        parts(if images.indices.contains(number) then number else images.size) += mesh.indices(i)
      if parts.last.length > 0 then
        val range = s"0 to ${images.size - 1}"
        val message = s"faces whose `$ImageNumber` is not one of $range have no image"
        session.warn(session.position, message, Code.BrokenMesh)
      parts.zip(images.map(Some(_)) :+ None).collect:
        case (part, image) if part.length > 0 => mesh.copy(indices = part.drain()) -> image

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
