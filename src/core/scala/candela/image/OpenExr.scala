package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.io.{IoReason, Scratch, WholeFile}
import org.lwjgl.system.JNI.*
import org.lwjgl.system.MemoryStack.stackPush
import org.lwjgl.system.MemoryUtil

import java.io.IOException
import java.nio.FloatBuffer
import java.nio.file.Path

import scala.util.Using

/** Reads EXR files by the OpenEXR library, version 3, which is loaded at run time: its C interface
  * (`ImfCRgbaFile.h`) returns R, G, B and A, or the luminance, in half precision, of files of any
  * compression, with subsampled channels or as luminance and chroma.
  */
private[image] final class OpenExr private (library: NativeLibrary):
  import library.function

  private val openFile = function("ImfOpenInputFile")
  private val closeFile = function("ImfCloseInputFile")
  private val channelsOf = function("ImfInputChannels")
  private val setFrameBuffer = function("ImfInputSetFrameBuffer")
  private val readPixels = function("ImfInputReadPixels")
  private val toFloats = function("ImfHalfToFloatArray")
  private val errorMessage = function("ImfErrorMessage")

  /** @param part header of the file's only part
    * @param reason why it is read here, for messages
    */
  def read(file: Array[Byte], part: ExrPart, reason: String): Image =
    try
      Using.resource(Scratch.create()): scratch =>
        val copy = scratch.folder.resolve("copy.exr")
        WholeFile.write(copy, file)
        read(copy, part, reason)
    catch
      case e: IOException =>
        throw ImageError(
          Code.UnsupportedImage,
          s"$reason, and no copy can be made for the OpenEXR library: ${IoReason(e)}"
        )

  private def read(copy: Path, part: ExrPart, reason: String): Image =
    val stack = stackPush()
    val halves = MemoryUtil.memAllocShort(4 * part.width * part.height)
    val pixels = MemoryUtil.memAllocFloat(halves.capacity)
    try
      val name = stack.UTF8(copy.toString)
      val opened = invokePP(MemoryUtil.memAddress(name), openFile)
      if opened == 0 then fail(reason)
      try
        // The address of pixel 0, 0, which may be outside of the data window
        val origin = MemoryUtil.memAddress(
          halves
        ) - OpenExr.PixelSize * (part.x.toLong + part.y.toLong * part.width)
        if invokePPPPI(opened, origin, 1L, part.width.toLong, setFrameBuffer) == 0 then fail(reason)
        if invokePI(opened, part.y, part.y + part.height - 1, readPixels) == 0 then fail(reason)
        val (from, to) = (MemoryUtil.memAddress(halves), MemoryUtil.memAddress(pixels))
        invokePPV(pixels.capacity, from, to, toFloats)
        image(pixels, part, invokePI(opened, channelsOf))
      finally
        val _ = invokePI(opened, closeFile)
    finally
      MemoryUtil.memFree(halves)
      MemoryUtil.memFree(pixels)
      stack.close()

  /** Its last error, without the name of the file. */
  private def fail(reason: String): Nothing =
    val message = MemoryUtil.memUTF8(invokeP(errorMessage)).replaceAll("^[^\"]*\"[^\"]*\"\\. *", "")
    throw ImageError(Code.UnsupportedImage, s"$reason, and the OpenEXR library says: $message")

  private def image(pixels: FloatBuffer, part: ExrPart, channels: Int): Image =
    val isGray = (channels & (OpenExr.Luminance | OpenExr.Chroma)) == OpenExr.Luminance
    val color = if isGray then Vector("Y") else Image.RgbNames
    val hasAlpha = (channels & OpenExr.Alpha) != 0
    val names = if hasAlpha then color :+ "A" else color
    val componentIndices = names.indices.map(i => if names(i) == "A" then 3 else i).toArray
    val data = new Array[Float](part.width * part.height * names.size)
    loop(part.width * part.height): pixel =>
      loop(componentIndices.length): c =>
        data(pixel * componentIndices.length + c) = pixels.get(4 * pixel + componentIndices(c))
    Image(part.width, part.height, names, data, colorSpace = part.colorSpace)

private[image] object OpenExr:
  /** Names the library, if the system's loader doesn't find it. */
  val Variable = "CANDELA_OPENEXR"

  val help: String = "save the file with ZIP or PIZ, or install the OpenEXR library " +
    s"($Variable may name it), which reads it"

  // RgbaChannels and the size of ImfRgba
  private val Alpha = 8
  private val Luminance = 16
  private val Chroma = 32
  private val PixelSize = 8L

  private val Names = Vector(
    "libOpenEXR-3_4.so.33", "libOpenEXR-3_3.so.32", "libOpenEXR-3_2.so.31", "libOpenEXR-3_1.so.30",
    "libOpenEXR.so", "/opt/homebrew/lib/libOpenEXR.dylib", "/usr/local/lib/libOpenEXR.dylib",
    "OpenEXR-3_4.dll", "OpenEXR-3_3.dll", "OpenEXR-3_2.dll", "OpenEXR-3_1.dll"
  )

  /** The library, if it is installed. */
  def load(environment: Map[String, String] = sys.env): Option[OpenExr] =
    val named = environment.get(Variable).filter(_.nonEmpty)
    NativeLibrary.loadFirst("OpenEXR 3", named.fold(Names)(Vector(_))).map(OpenExr(_))
