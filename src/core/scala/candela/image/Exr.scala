package candela.image

import candela.diagnostics.Code
import java.nio.ByteBuffer

/** OpenEXR images, through tinyexr.
  *
  * Reads half, float and integer channels of any names, in scanlines or tiles (the finest level);
  * of a multi-part file, the first part with colour, and beside it the channels of others that have
  * the same pixels. The pixels are those of the data window,
  * whatever the display window is, as in pbrt. What the decoder does not support or decodes wrongly
  * is read by [[OpenExr]], if that is installed: DWA, HTJ2K, B44 with float channels, subsampled
  * channels such as those of luminance and chroma. Rejects deep pixels.
  */
private[image] object Exr extends OutputFormat("exr", Contents.Channels):

  /** Channels are returned in the order R, G, B, A, then the others as in the file. Integers above
    * 2^24 lose their lowest bits.
    *
    * @param admit receives width and height before the pixels are decoded
    */
  def read(
      file: Array[Byte],
      environment: Map[String, String] = sys.env,
      admit: (Int, Int) => Unit = (_, _) => ()
  ): Image =
    val parts = ExrHeader.parts(file)
    val chosen = this.chosen(parts)
    val part = parts(chosen)
    admit(part.width, part.height)
    parts.flatMap(_.obstacle).headOption match
      case None => decoded(file, parts, chosen)
      case Some(reason) =>
        if parts.size > 1 then
          throw ImageError(Code.UnsupportedImage, s"$reason in files of several parts")
        OpenExr.load(environment).getOrElse(throw ImageError(
          Code.UnsupportedImage,
          s"$reason; ${OpenExr.help}"
        ))
          .read(file, part, reason)

  /** The first part with colour, else the first. */
  private def chosen(parts: Vector[ExrPart]): Int =
    val hasColor = parts.map(p => p.channels.map(_.name).toSet).map: names =>
      names("Y") || Image.RgbNames.forall(names)
    Math.max(0, hasColor.indexOf(true))

  /** Which of several parts is read.
    *
    * @param start of the file
    */
  def remark(start: Array[Byte]): Option[String] =
    try
      val (parts, _) = ExrHeader.ofBeginning(start)
      Option.when(parts.size > 1):
        s"the image has ${parts.size} parts, of which part ${chosen(parts) + 1} is read"
    catch case _: ImageError => None // reported by the decoder

  private def decoded(file: Array[Byte], parts: Vector[ExrPart], chosen: Int): Image =
    val part = parts(chosen)
    val beside = parts.indices.filter(i => i != chosen && parts(i).covers(part))
    val sources = (chosen +: beside.toVector).map(i => i -> order(parts(i)).toArray)
    val names = sources.foldLeft(Vector.empty[String]): (taken, source) =>
      val p = parts(source._1)
      val inPart = source._2.toVector.map(p.channels(_).name)
      taken ++ inPart.map(n => if taken.contains(n) then s"${p.name}.$n" else n)
    if names.distinct.size < names.size then
      throw ImageError(Code.DamagedImage, "two channels have the same name")
    if part.width.toLong * part.height * names.size > Int.MaxValue - 8 then
      throw ImageError(Code.TooLarge, "its parts are more than fit into memory")
    val data = new Array[Float](part.width * part.height * names.size)
    ExrDecoder.decode(file, parts, sources, data)
    Image(part.width, part.height, names, data, colorSpace = part.colorSpace)

  /** The channels of an image, by their numbers in the file: R, G, B, A, then the others. */
  private[image] def order(part: ExrPart): Vector[Int] =
    val inFile = part.channels.map(_.name)
    val leading = (Image.RgbNames :+ "A").map(inFile.indexOf).filter(_ >= 0)
    leading ++ inFile.indices.filterNot(leading.contains)

  override def keepsTexts: Boolean = true

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    ExrHeader.parts(file) match
      case Vector(part) if part.tiling.isEmpty =>
        ExrWindow.end(file, ExrHeader.chunks(part).toInt) == file.length
      case _ => true // not of ours

  /** ZIP compression; every channel under its own name. Encoded images are decoded first. */
  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val pieces = buffers(image, metadata, options)
    val size = pieces.map(_.remaining.toLong).sum
    if size > Int.MaxValue - 8 then
      throw ImageError(Code.TooLarge, "an EXR file of more than 2 GB in memory")
    val file = ByteBuffer.allocate(size.toInt)
    pieces.foreach(file.put(_))
    file.array

  private[image] override def buffers(
      image: Image,
      metadata: Vector[(String, String)],
      options: WriteOptions
  ): Vector[ByteBuffer] =
    for (name, _) <- metadata if name.isEmpty || name.getBytes("UTF-8").length > 255 do
      throw ImageError(
        Code.UnsupportedImage,
        s"metadata `$name`: the name must have 1 to 255 bytes"
      )
    ExrEncoder.encode(
      image.linear,
      metadata,
      options.others.getOrElse(_, options.isHalf),
      options.pool,
      options.window
    )
