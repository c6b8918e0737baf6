package candela.report

import candela.measure.CurvePoint

/** A rectangle of pixels of the image, as half-open ranges. */
final case class Frame(x0: Int, y0: Int, x1: Int, y1: Int)

/** How far a rendering is. */
enum Stage(val word: String):
  case Rendering extends Stage("rendering")
  case Stopping extends Stage("stopping")
  case Stopped extends Stage("stopped")
  case Done extends Stage("done")

/** An image that the live page can show.
  *
  * @param name    in the server's addresses
  * @param title   for readers
  * @param meaning empty if the title says it
  */
final case class LiveLayer(name: String, title: String, meaning: String)

/** What the live page shows beside the image.
  *
  * @param version of the image; changes whenever the image does
  * @param frame   rendered pixels of the full image
  * @param layers  the images that the page can show
  * @param samples that every pixel has at least, of `planned`, if their number is known
  * @param part    of the work that is done, in [0, 1]
  * @param left    remaining seconds, if known
  * @param rate    camera samples per second
  * @param tiles   that workers render at the moment
  * @param points  of the error curve so far
  * @param keepsOn whether it goes on beyond the planned samples; None: it can't
  * @param stays   whether the page remains when rendering has ended
  * @param saved   files written on request, most recently
  * @param files   written at the end; None: not yet
  * @param camera  that viewers move, if they do
  */
final case class LiveState(
    run: String,
    version: Int,
    stage: Stage,
    frame: Frame,
    layers: Vector[LiveLayer],
    samples: Int,
    planned: Option[Int],
    part: Double,
    seconds: Double,
    left: Option[Double],
    rate: Double,
    tiles: Vector[Frame],
    points: Vector[CurvePoint],
    viewers: Int,
    keepsOn: Option[Boolean],
    stays: Boolean,
    saved: Option[String],
    files: Option[Vector[String]],
    camera: Option[LiveCamera] = None
):
  /** Whether nothing will change any more. */
  def isFinal: Boolean = files.isDefined

/** The camera that viewers move.
  *
  * @param statements that place and describe it
  * @param native     the same in the format of the scene, with its title, if that is another
  * @param fov        in degrees, if it has one that can be changed; so are the others
  * @param lens       radius of the aperture
  * @param focus      distance in focus
  * @param remarks    on what can't be changed, and what is lost
  * @param file       where it can be written
  * @param problem    why it could not be rendered
  */
final case class LiveCamera(
    statements: String,
    native: Option[(String, String)],
    fov: Option[Double],
    lens: Option[Double],
    focus: Option[Double],
    remarks: Vector[String],
    file: String,
    problem: Option[String]
)

/** Formats the live page's data. */
object LiveData:

  def state(s: LiveState): String =
    ujson.write(
      ujson.Obj(
        "run" -> s.run,
        "version" -> s.version,
        "stage" -> s.stage.word,
        "x0" -> s.frame.x0,
        "y0" -> s.frame.y0,
        "width" -> (s.frame.x1 - s.frame.x0),
        "height" -> (s.frame.y1 - s.frame.y0),
        "layers" -> ujson.Arr.from(s.layers.map: l =>
          ujson.Obj("name" -> l.name, "title" -> l.title, "meaning" -> l.meaning)),
        "samples" -> s.samples,
        "planned" -> s.planned.fold(ujson.Null: ujson.Value)(ujson.Num(_)),
        "part" -> s.part,
        "seconds" -> s.seconds,
        "left" -> s.left.fold(ujson.Null: ujson.Value)(ujson.Num(_)),
        "rate" -> s.rate,
        "tiles" -> ujson.Arr.from(s.tiles.map(t => ujson.Arr(t.x0, t.y0, t.x1, t.y1))),
        "error" -> s.points.lastOption.fold(ujson.Null: ujson.Value): p =>
          RenderData.number(Math.sqrt(p.errors.relativeMse)),
        "points" -> s.points.size,
        "viewers" -> s.viewers,
        "keepsOn" -> s.keepsOn.fold(ujson.Null: ujson.Value)(ujson.Bool(_)),
        "stays" -> s.stays,
        "saved" -> s.saved.fold(ujson.Null: ujson.Value)(ujson.Str(_)),
        "files" -> s.files.fold(ujson.Null: ujson.Value)(ujson.Arr.from(_)),
        "camera" -> s.camera.fold(ujson.Null: ujson.Value)(camera)
      )
    )

  private def camera(c: LiveCamera): ujson.Value =
    def number(x: Option[Double]) = x.fold(ujson.Null: ujson.Value)(ujson.Num(_))
    ujson.Obj(
      "statements" -> c.statements,
      "native" -> c.native.fold(ujson.Null: ujson.Value)((title, text) =>
        ujson.Obj("title" -> title, "text" -> text)
      ),
      "fov" -> number(c.fov),
      "lens" -> number(c.lens),
      "focus" -> number(c.focus),
      "remarks" -> ujson.Arr.from(c.remarks),
      "file" -> c.file,
      "problem" -> c.problem.fold(ujson.Null: ujson.Value)(ujson.Str(_))
    )

  /** The error curves, as part of the page. */
  def charts(points: Vector[CurvePoint], isEstimated: Boolean): String =
    ErrorCharts(points, isEstimated).allCharts.render

  /** One pixel: the values of each layer, channel by channel. */
  def pixel(values: Vector[(String, Vector[(String, Float)])]): String =
    ujson.write(ujson.Arr.from(values.map: (layer, channels) =>
      ujson.Obj(
        "layer" -> layer,
        "channels" -> ujson.Arr.from(channels.map(_._1)),
        "values" -> ujson.Arr.from(channels.map((_, value) => RenderData.number(value.toDouble)))
      )))
