package candela.integrators

import candela.cameras.{Camera, Shutter}

/** An [[Integrator]] that finds a picture by chains of paths, each path much like the one before,
  * rather than pixel by pixel. What it finds goes to [[Splats]] alone.
  */
trait Chained extends Splatting:
  /** All chains of one rendering, none of them begun. */
  def chains(view: View): Chains

/** What chains make a picture of.
  *
  * @param x0     with `y0`, `x1` and `y1` the part of the film that light is looked for on, in
  *               pixels of the full image, which has `pixels` of them
  * @param shutter when it is open, if anything moves
  * @param differentialScale of camera rays' differentials; 0: nothing in the scene asks for them
  */
final case class View(
    camera: Camera,
    splats: Splats,
    x0: Float,
    y0: Float,
    x1: Float,
    y1: Float,
    pixels: Double,
    shutter: Option[Shutter],
    differentialScale: Float
)

/** The chains of one rendering, shared by all workers. */
abstract class Chains:
  def count: Int

  /** Work space of one worker. */
  def walker(): ChainWalker

/** Takes chains on; mutable, one per worker. A chain may be handed from one to another, but not be
  * walked by two at a time.
  */
abstract class ChainWalker:
  /** Takes a chain on by so many paths. */
  def advance(chain: Int, paths: Long): Unit

  /** Where on the film, in pixels, the path is that was tried last. */
  def x: Int
  def y: Int

  /** Paths that were no light (NaN or infinite), and so were left out. */
  def refused: Long
  def raysTraced: Long
  def lastMaterial: Int
