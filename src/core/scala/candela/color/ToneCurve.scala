package candela.color

/** Maps scene-referred linear sRGB to display-referred linear sRGB in [0, 1].
  *
  * @param word    command-line name
  * @param meaning one line for the help
  */
enum ToneCurve(val word: String, val meaning: String):
  /** Light as it is; brighter than 1 is clipped. */
  case Linear extends ToneCurve("linear", "clipped at 1")

  /** A fit of film's response, per channel.
    *
    * Source: Hable, "Uncharted 2: HDR Lighting", Game Developers Conference 2010: operator, white
    * point 11.2 and exposure bias 2.
    */
  case Filmic extends ToneCurve("filmic", "Hable's film response")

  /** A fit of the ACES reference rendering and sRGB output transforms.
    *
    * Source: Hill, in Pettineo and Neubelt, "Baking Lab", 2016, ACES.hlsl.
    */
  case Aces extends ToneCurve("aces", "Hill's fit of ACES")

  /** Bright saturated colours fade to white without changing their hue much.
    *
    * Sources: Sobotka, "AgX", 2022; its sigmoid as fitted by Wrensch, "Minimal AgX Implementation",
    * 2023.
    */
  case Agx extends ToneCurve("agx", "Sobotka's AgX, as fitted by Wrensch")

  /** NaN stays NaN. */
  def apply(c: Rgb): Rgb = this match
    case Linear => c
    case _ =>
      val bounded = c.map(v => Math.min(Math.max(v, 0f), ToneCurve.Brightest))
      mixing match
        case None => bounded.map(channel)
        case Some((before, after)) =>
          val mixed = ToneCurve.times(after, ToneCurve.times(before, bounded).map(channel))
          val unit = mixed.map(v => Math.min(Math.max(v, 0f), 1f))
          if power == 1.0 then unit else unit.map(v => Math.pow(v.toDouble, power).toFloat)

  /** What it does to each channel; to mixtures of channels if it is [[mixing]]. */
  def channel(v: Float): Float = this match
    case Linear => v
    case Filmic => ToneCurve.filmic(v)
    case Aces => ToneCurve.aces(v)
    case Agx => ToneCurve.agx(v)

  /** Matrices before and after, row by row, if it mixes channels. */
  def mixing: Option[(Vector[Float], Vector[Float])] = this match
    case Linear | Filmic => None
    case Aces => Some((ToneCurve.acesIn, ToneCurve.acesOut))
    case Agx => Some((ToneCurve.agxIn, ToneCurve.agxOut))

  /** Exponent of the channels at last. */
  def power: Double = if this == Agx then 2.2 else 1.0

object ToneCurve:
  /** Beyond it the quotients would overflow. */
  private val Brightest = 1e6f

  private val White = 11.2f
  private val Bias = 2f

  private def filmic(v: Float): Float = Math.min(1f, hable(v * Bias) / hable(White))

  private def hable(x: Float): Float =
    val (a, b, c, d, e, f) = (0.15f, 0.5f, 0.1f, 0.2f, 0.02f, 0.3f)
    (x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f

  /** From sRGB to ACES' AP1 primaries, desaturated. */
  private val acesIn = Vector(
    0.59719f, 0.35458f, 0.04823f, //
    0.07600f, 0.90834f, 0.01566f, //
    0.02840f, 0.13383f, 0.83777f
  )
  private val acesOut = Vector(
    1.60475f, -0.53108f, -0.07367f, //
    -0.10208f, 1.10813f, -0.00605f, //
    -0.00327f, -0.07276f, 1.07602f
  )

  private def aces(v: Float): Float =
    (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f)

  private val agxIn = Vector(
    0.842479062f, 0.0784336f, 0.0792237451f, //
    0.0423282422f, 0.878468636f, 0.0791661274f, //
    0.0423756549f, 0.0784336f, 0.879142973f
  )
  private val agxOut = Matrix3(agxIn.map(_.toDouble)).inverse.toFloats.toVector

  // Range of the logarithm, in stops about 1
  private val Darkest = -12.47393
  private val Lightest = 4.026069

  private def agx(v: Float): Float =
    val stops = Math.log(Math.max(v, 1e-10f).toDouble) / Math.log(2)
    val x = (Math.min(Math.max(stops, Darkest), Lightest) - Darkest) / (Lightest - Darkest)
    val fit = ((((15.5 * x - 40.14) * x + 31.96) * x - 6.868) * x + 0.4298) * x
    ((fit + 0.1191) * x - 0.00232).toFloat

  private def times(m: Vector[Float], c: Rgb): Rgb = Rgb(
    m(0) * c.r + m(1) * c.g + m(2) * c.b,
    m(3) * c.r + m(4) * c.g + m(5) * c.b,
    m(6) * c.r + m(7) * c.g + m(8) * c.b
  )
