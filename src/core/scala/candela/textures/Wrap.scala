package candela.textures

import candela.math.clamp

/** Wrap mode of an image texture outside the unit square. */
enum Wrap:
  case Repeat, Black, Clamp

  /** Every other copy of the image is mirrored (Mitsuba). */
  case Mirror

  /** The square is an octahedral map of the sphere: crossing an edge leads to the edge adjacent on
    * the sphere.
    */
  case OctahedralSphere

  /** Modes that differ: across, and down the image. Each is `Repeat`, `Clamp` or `Mirror`. */
  case Axes(across: Wrap, down: Wrap)

  /** Index of texel (`x`, `y`) in row order, for any integers; −1 for black. */
  def index(x: Int, y: Int, width: Int, height: Int): Int =
    if x >= 0 && y >= 0 && x < width && y < height then y * width + x
    else
      this match
        case Black => -1
        case OctahedralSphere => Wrap.octahedral(x, y, width, height)
        case Axes(across, down) => down.along(y, height) * width + across.along(x, width)
        case _ => along(y, height) * width + along(x, width)

  /** The texel along one axis. */
  private def along(i: Int, size: Int): Int = this match
    case Clamp => clamp(i, 0, size - 1)
    case Mirror => Wrap.mirrored(i, size)
    case _ => Math.floorMod(i, size)

  /** Whether the first row follows the last. */
  def repeatsDown: Boolean = this match
    case Repeat => true
    case Axes(_, down) => down.repeatsDown
    case _ => false

object Wrap:

  /** The mode of two axes. */
  def of(across: Wrap, down: Wrap): Wrap = if across == down then across else Axes(across, down)

  private def mirrored(x: Int, size: Int): Int =
    val inside = Math.floorMod(x, size)
    if (Math.floorDiv(x, size) & 1) == 0 then inside else size - 1 - inside

  /** Each crossing of an edge reflects about it and about the midpoint of the other axis.
    *
    * Source: Clarberg, "Fast equal-area mapping of the (hemi)sphere using SIMD", JGT 13(3), 2008.
    */
  private def octahedral(x: Int, y: Int, width: Int, height: Int): Int =
    val acrossX = (Math.floorDiv(x, width) & 1) != 0
    val acrossY = (Math.floorDiv(y, height) & 1) != 0
    val inX = Math.floorMod(x, width)
    val inY = Math.floorMod(y, height)
    // Either crossing reflects both axes, so two crossings cancel.
    if acrossX != acrossY then (height - 1 - inY) * width + (width - 1 - inX)
    else inY * width + inX
