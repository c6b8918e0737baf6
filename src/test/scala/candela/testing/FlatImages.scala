package candela.testing

import java.nio.file.Path

import candela.image.{Image, ImageFiles}

object FlatImages:
  /** Writes an image of equal pixels; returns its path. */
  def flat(path: Path, value: Float, width: Int = 4, height: Int = 2): String =
    val image = Image.rgb(width, height)
    java.util.Arrays.fill(image.data, value)
    ImageFiles.write(path, image)
    path.toString
