package candela.stability

import candela.guiding.GuidingMode
import candela.render.Renderer
import candela.settings.{ColorMode, RenderSettings}
import candela.testing.SceneTexts

/** A way to render a scene. What pbrt's own integrators leave out is not compared:
  *
  *   - `path`, `sppm`, `lightpath` and `directlighting` ignore media;
  *   - `lightpath` sees nothing in mirrors and through smooth glass or coats, and little but noise
  *     by way of narrow lobes; only v4 has it;
  *   - `directlighting` is compared with paths of one event, where nothing is specular; only v3 has
  *     it;
  *   - `whitted` leaves out what is neither direct nor specular, and `ambientocclusion` shows no
  *     light.
  *
  * `sppm` gathers by the rules of both pbrt-v3 and pbrt-v4, but follows narrow lobes of diffuse
  * surfaces, which pbrt leaves out: it sees what `volpath` does.
  *
  * @param spp       samples per pixel, in the table
  * @param blur      share by which the expected value may be off
  * @param mostNoise standard error at which there is nothing to compare, relative to the value
  */
final case class Way(
    name: String,
    statement: String,
    spp: Int,
    mode: GuidingMode = GuidingMode.Off,
    color: ColorMode = ColorMode.Auto,
    blur: Double = 0,
    mostNoise: Double = 0.25
):
  import ExtremeBall.Kind

  def isFor(ball: ExtremeBall): Boolean = name match
    case "path" | "guided path" | "sppm" => !ball.hasMedium
    case "lightpath" => ball.isV4 && ball.kind == Kind.Wide
    case "directlighting" => !ball.isV4 && ball.kind == Kind.Wide && !ball.isOpen
    case "spectral bdpt" | "spectral mlt" => ball.hasMedium
    case _ => true

  /** Scattering events. */
  def depth(ball: ExtremeBall): Int = if name == "directlighting" then 1 else ball.depth

  /** What it is compared with. */
  def reference: Way = if color == ColorMode.Auto then Way.volpath else Way.spectral

  private def scene(ball: ExtremeBall, effort: Double): String =
    val samples = Math.max(1, Math.round(spp * effort).toInt)
    val settings = name match
      // In v4 the sampler sets the number of passes
      case "sppm" if !ball.isV4 => s" \"integer iterations\" $samples"
      case "mlt" | "spectral mlt" =>
        s" \"integer mutationsperpixel\" $samples \"integer bootstrapsamples\" 1500"
      case _ => ""
    ball.scene(statement + settings, depth(ball), samples)

  /** Renderings with other seeds: the means of the pictures, of all colours.
    *
    * @param effort share of the table's samples
    */
  def means(ball: ExtremeBall, effort: Double): Means =
    val text = scene(ball, effort)
    val found = Vector.tabulate(Way.Seeds): seed =>
      val options = RenderSettings(seed = seed, color = color, guiding = Some(mode))
      val plan = SceneTexts.plan(text, ball.dialect, options)
      val rendering = Renderer.render(plan, threads = 1)
      val data = rendering.image(plan.development).data
      (data.map(_.toDouble).sum / data.length, rendering.discarded.fold(0L)(_.count))
    Means(found.map(_._1), found.map(_._2).sum)

object Way:
  /** Enough for the mean of so many values to be about as many deviations off as a normal number.
    */
  val Seeds = 16

  val volpath: Way = Way("volpath", "\"volpath\"", 100)
  val spectral: Way = volpath.copy(name = "spectral volpath", color = ColorMode.Spectral)
  private val bdpt = Way("bdpt", "\"bdpt\"", 24)
  private val mlt = Way("mlt", "\"mlt\" \"integer chains\" 15", 150)

  val all: Seq[Way] = Seq(
    Way("path", "\"path\"", 60),
    bdpt,
    mlt,
    // Photons beyond edges within the radius are lost, and surfaces are not flat there
    Way(
      "sppm",
      "\"sppm\" \"integer photonsperiteration\" 3000 \"float radius\" .1",
      16,
      blur = 0.02
    ),
    Way("lightpath", "\"lightpath\"", 600, mostNoise = 0.6),
    Way("directlighting", "\"directlighting\"", 60),
    Way("guided path", "\"path\"", 40, GuidingMode.On),
    Way("guided volpath", "\"volpath\"", 40, GuidingMode.On),
    bdpt.copy(name = "spectral bdpt", color = ColorMode.Spectral),
    mlt.copy(name = "spectral mlt", color = ColorMode.Spectral)
  )

/** The means of renderings with different seeds.
  *
  * @param discarded samples that were NaN or infinite
  */
final case class Means(all: Vector[Double], discarded: Long):
  val mean: Double = all.sum / all.size

  /** Standard error of the mean. */
  val error: Double =
    Math.sqrt(all.map(x => (x - mean) * (x - mean)).sum / (all.size - 1) / all.size)

  override def toString: String = f"$mean%.5f ± $error%.5f"

/** A way of rendering a ball beside the reference. */
final case class Compared(way: Way, found: Means, right: Means):
  /** Both may be 0. */
  private val noise = Math.hypot(found.error, right.error) + 1e-6
  def deviations: Double =
    val off = Math.abs(found.mean - right.mean) - way.blur * right.mean
    Math.max(0.0, off) / noise
  def isComparable: Boolean = noise <= way.mostNoise * right.mean + 1e-4
  override def toString: String =
    f"${way.name}%-16s $found, not $right: $deviations%.1f deviations"

object IntegratorTable:
  def compare(ball: ExtremeBall, effort: Double): Seq[Compared] =
    val ways = Way.all.filter(_.isFor(ball))
    val references = ways.map(w => (w.reference, w.depth(ball))).distinct
      .map((r, depth) => (r, depth) -> r.means(ball.copy(depth = depth), effort))
      .toMap
    for way <- ways
    yield Compared(way, way.means(ball, effort), references((way.reference, way.depth(ball))))

  /** Prints how all ways of rendering differ from volpath; arguments choose balls by name. */
  def main(args: Array[String]): Unit =
    for ball <- ExtremeBall.all if args.isEmpty || args.exists(ball.name.contains) do
      println(ball.name)
      for row <- compare(ball, 1) do println(s"    $row, ${row.found.discarded} discarded")
