package candela.base

import java.util.Locale

/** Sizes in memory, for people. */
object ByteCount:
  /** `950 bytes`, `1.2 kB`, `38 MB`, `4.5 GB`: two digits or more. */
  def format(bytes: Long): String =
    if bytes < 1000 then s"$bytes bytes"
    else
      val power = Math.min(3, (Math.log10(bytes.toDouble) / 3 + 1e-9).toInt)
      val value = bytes / Math.pow(1000, power)
      val digits = if value < 9.95 then 1 else 0
      s"${s"%.${digits}f".formatLocal(Locale.ROOT, value)} ${Units(power)}"

  private val Units = Vector("bytes", "kB", "MB", "GB")
