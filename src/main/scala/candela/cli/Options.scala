package candela.cli

import candela.film.Layer
import candela.scenefile.Dialect

enum Command(val word: String):
  case Render extends Command("render")
  case Check extends Command("check")
  case Compare extends Command("compare")
  case Bench extends Command("bench")
  case Describe extends Command("describe")
  case Convert extends Command("convert")

/** The part of the image to render: fractions of its width and height, 0 to 1. */
final case class CropWindow(x0: Float, x1: Float, y0: Float, y1: Float)

/** A command line, understood; what is None was not said.
  *
  * @param files     the scenes; for `compare`, the image and its reference; for `describe`, what to
  *                  describe
  * @param outfiles  where to write the image, instead of the scene's file name
  * @param pixel     with `sample`, what `debug` looks at instead of rendering an image
  * @param markdown  whether `describe` writes the whole reference
  * @param to        the dialect that `convert` writes
  * @param out       where it writes the scene
  * @param toPly     meshes of at least as many triangles go into PLY files
  * @param layers    what images hold beside colours and what the scene asks for
  * @param reference what reports judge the image by
  * @param reports   where to write them
  * @param bench     what `bench` is asked for
  * @param compare   what `compare` is asked for
  */
final case class Options(
    command: Command = Command.Render,
    files: Vector[String] = Vector.empty,
    outfiles: Vector[String] = Vector.empty,
    threads: Option[Int] = None,
    spp: Option[Int] = None,
    seed: Int = 0,
    quick: Boolean = false,
    quiet: Boolean = false,
    verbose: Boolean = false,
    explain: Boolean = false,
    cropWindow: Option[CropWindow] = None,
    pixel: Option[(Int, Int)] = None,
    sample: Int = 0,
    debug: Boolean = false,
    dialect: Option[Dialect] = None,
    keepGoing: Boolean = false,
    layers: Vector[Layer] = Vector.empty,
    reference: Option[String] = None,
    reports: Vector[String] = Vector.empty,
    compare: CompareOptions = CompareOptions(),
    bench: BenchOptions = BenchOptions(),
    markdown: Boolean = false,
    to: Option[Dialect] = None,
    toPly: Option[Int] = None
):
  /** As many threads as were asked for, or else as there are processors. */
  def threadCount: Int = threads.getOrElse(Runtime.getRuntime.availableProcessors)
