package candela.image

import candela.diagnostics.Code
import java.nio.ByteBuffer

/** OpenEXR images, through tinyexr.
  *
  * Reads half, float and integer channels of any names, in scanlines or tiles (the finest level);
  * of a multi-part file, the first part with colour, and beside it the channels of those that have
  * the same pixels, under the names of their parts. The pixels are those of the data window,
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

  /** Whether it has luminance; X, Y and Z may be a position. */
  private def isGray(part: ExrPart): Boolean =
    val names = part.ownNames
    names.contains("Y") && !names.contains("X")

  private def hasRgb(part: ExrPart): Boolean = Image.RgbNames.forall(part.ownNames.contains)

  private def hasColor(part: ExrPart): Boolean = hasRgb(part) || isGray(part)

  /** The first part with red, green and blue, else with luminance, else the first. */
  private def chosen(parts: Vector[ExrPart]): Int =
    Vector(parts.indexWhere(hasRgb), parts.indexWhere(isGray)).find(_ >= 0).getOrElse(0)

  /** The part whose colours are read. */
  def part(file: Array[Byte]): ExrPart =
    val parts = ExrHeader.parts(file)
    parts(chosen(parts))

  /** Which colours of several parts are read, and what is not.
    *
    * @param start of the file
    */
  def remark(start: Array[Byte]): Option[String] =
    try
      val (parts, _) = ExrHeader.ofBeginning(start)
      val part = parts(chosen(parts))
      val colored = parts.count(hasColor)
      val rivals = Option.when(colored > 1):
        s"the colours are those of part `${part.name}`, the first of $colored that have some"
      val unread =
        for p <- parts if !p.covers(part)
        yield s"part `${p.name}` is not read, as it has other pixels than `${part.name}`"
      Option.when(rivals.nonEmpty || unread.nonEmpty)((rivals.toVector ++ unread).mkString("; "))
    catch case _: ImageError => None // reported by the decoder

  private def decoded(file: Array[Byte], parts: Vector[ExrPart], chosen: Int): Image =
    val part = parts(chosen)
    val beside = parts.indices.filter(i => i != chosen && parts(i).covers(part))
    val sources = (chosen +: beside.toVector).map: i =>
      val names = if parts.size == 1 then part.channels.map(_.name) else parts(i).ownNames
      val channels = order(names)
      val apart = i != chosen || parts.size > 1 && !hasColor(part)
      val prefix = if apart && parts(i).name.nonEmpty then s"${parts(i).name}." else ""
      (i, channels.toArray, channels.map(c => prefix + names(c)))
    val names = sources.flatMap(_._3)
    if names.distinct.size < names.size then
      throw ImageError(Code.DamagedImage, "two channels have the same name")
    if part.width.toLong * part.height * names.size > Int.MaxValue - 8 then
      throw ImageError(Code.TooLarge, "its parts are more than fit into memory")
    val data = new Array[Float](part.width * part.height * names.size)
    ExrDecoder.decode(file, parts, sources.map((i, channels, _) => (i, channels)), data)
    Image(part.width, part.height, names, data, colorSpace = part.colorSpace)

  /** The channels by their numbers in the file: R, G, B, A, then the others. */
  private[image] def order(names: Vector[String]): Vector[Int] =
    val leading = (Image.RgbNames :+ "A").map(names.indexOf).filter(_ >= 0)
    leading ++ names.indices.filterNot(leading.contains)

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
