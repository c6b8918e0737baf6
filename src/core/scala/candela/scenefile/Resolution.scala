package candela.scenefile

/** The size of an image, in pixels, in place of that of the film. */
enum Resolution:
  case Size(width: Int, height: Int)

  /** The height keeps the ratio of both. */
  case Width(width: Int)

  /** Of width and height. */
  case Percent(percentage: Double)

  /** @param width  of the film
    * @param height of the film
    */
  def of(width: Int, height: Int): (Int, Int) = this match
    case Size(w, h) => (w, h)
    case Width(w) => (w, Math.max(1, Math.rint(w.toDouble * height / width).toInt))
    case Percent(p) =>
      def scaled(size: Int) = Math.max(1, (size * p / 100).toInt)
      (scaled(width), scaled(height))
