package candela.mitsuba

import candela.base.loop
import candela.diagnostics.{Code, SourcePos}
import candela.io.{InputFile, IoReason}
import java.io.IOException
import java.nio.ByteOrder

/** A grid of one or three channels.
  *
  * @param size   cells along x, y and z
  * @param bounds least and greatest corner
  * @param values channels of a cell are adjacent, then x varies fastest; at least 0
  * @param lowest of the file's values
  */
private[mitsuba] final class VolumeFile(
    val size: Array[Int],
    val channels: Int,
    val bounds: Array[Float],
    val values: Array[Float],
    val lowest: Float
)

/** Reads Mitsuba's `.vol` files. */
private[mitsuba] object VolumeFile:
  private val Header = 48

  /** The encoding of Mitsuba 0.6 in bytes: 255 is 1. */
  private val Bytes = 3

  /** A larger value is damage. */
  private val MaxValue = 1e9f

  def read(file: InputFile, at: SourcePos): VolumeFile =
    def fail(why: String) =
      Values.fail(Code.DamagedVolume, at, s"can't read the volume `${file.path.getFileName}`: $why")
    val bytes =
      try file.map()
      catch case e: IOException => fail(IoReason(e))
    val input = bytes.order(ByteOrder.LITTLE_ENDIAN)
    if input.remaining < Header || input.get() != 'V' || input.get() != 'O' || input.get() != 'L'
    then
      fail("it does not begin with VOL")
    if input.get() != 3 then fail("only version 3 is known")
    val encoding = input.getInt()
    if encoding != 1 && encoding != Bytes then fail("only 32-bit floats and bytes are known")
    val size = Array.fill(3)(input.getInt())
    val channels = input.getInt()
    val bounds = Array.fill(6)(input.getFloat())
    if channels != 1 && channels != 3 then
      fail(s"it has $channels channels; only one or three are supported")
    val room = input.remaining / (if encoding == Bytes then 1 else 4) / channels
    val cells = size.map(_.toLong).product
    if size.exists(n => n < 1 || n > 65536) || cells > room then
      fail(s"it is too short for ${size.mkString(" × ")} cells")
    val values = new Array[Float](cells.toInt * channels)
    if encoding == Bytes then loop(values.length)(i => values(i) = (input.get() & 0xff) / 255f)
    else input.asFloatBuffer.get(values)
    var lowest = 0f
    loop(values.length): i =>
      if !(values(i) <= MaxValue) then fail(s"its value ${values(i)} is damaged")
      lowest = Math.min(lowest, values(i))
      values(i) = Math.max(0f, values(i))
    VolumeFile(size, channels, bounds, values, lowest)
