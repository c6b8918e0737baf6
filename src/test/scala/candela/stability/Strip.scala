package candela.stability

import candela.image.Image

/** Pictures side by side, each over its difference from what is right. */
private final class Strip(pairs: Seq[Option[(Image, Image)]], scene: HardScene):
  private val (size, gap, zoom) = (64, 2, 2)
  private val (width, height) = (pairs.size * (size + gap) - gap, 2 * size + gap)

  val image: Image =
    val data = Array.fill(3 * zoom * zoom * width * height)(1f)
    for
      case (Some((found, right)), k) <- pairs.zipWithIndex
      y <- 0 until size
      x <- 0 until size
    do
      val (a, b) = (value(found, x, y), value(right, x, y))
      val light = Math.min(1f, Math.max(0f, (0.3 * a / scene.unit(right)).toFloat))
      val off = Math.max(-1.0, Math.min(1.0, 2 * (a - b) / scene.unit(right))).toFloat
      val isLow = y < scene.from * size
      val left = k * (size + gap) + x
      put(data, left, y, light, light, light)
      if !isLow then
        put(
          data,
          left,
          size + gap + y,
          1f + Math.min(0f, off),
          1f - Math.abs(off),
          1f - Math.max(0f, off)
        )
    Image(zoom * width, zoom * height, Image.RgbNames, data)

  private def value(i: Image, x: Int, y: Int): Double =
    i(x, y, i.channelNames.indexOf("G")).toDouble

  private def put(to: Array[Float], x: Int, y: Int, r: Float, g: Float, b: Float): Unit =
    for dy <- 0 until zoom; dx <- 0 until zoom do
      val at = 3 * ((y * zoom + dy) * zoom * width + x * zoom + dx)
      to(at) = r
      to(at + 1) = g
      to(at + 2) = b
