package candela.mitsuba

import candela.color.Rgb
import candela.diagnostics.{Code, SourcePos}
import candela.scenefile.{Param, ParamType}

/** A phase function, as parameters of a medium.
  *
  * @param scattered share of the light that is scattered, not absorbed
  */
final case class Phase(lobes: Vector[Phase.Lobe], scattered: Float = 1f):

  /** Absorption and scattering of a medium that scatters so. */
  def reduced(sigmaA: Rgb, sigmaS: Rgb): (Rgb, Rgb) =
    if scattered == 1f then (sigmaA, sigmaS)
    else (sigmaA + sigmaS * (1f - scattered), sigmaS * scattered)

  def params(at: SourcePos): Seq[Param] = lobes match
    case Vector(Phase.Lobe("hg", _, Vector(g))) => Seq(Param.float("g", at, g))
    case _ =>
      val weights = lobes.map(_.weight).toArray
      val values = lobes.flatMap(_.values).toArray
      Seq(
        Param(ParamType.String, "phases", at, at, strings = lobes.map(_.kind)),
        Param.floats(ParamType.Float, "phaseweights", at, weights),
        Param.floats(ParamType.Float, "phasevalues", at, values)
      )

object Phase:
  /** @param values as [[candela.sampling.PhaseFunction.of]] takes them */
  final case class Lobe(kind: String, weight: Float, values: Vector[Float])

  val Isotropic: Phase = of("hg", Vector(0f))
  private def of(kind: String, values: Vector[Float]): Phase = Phase(Vector(Lobe(kind, 1f, values)))

  /** @param number the value of a constant volume, by property */
  def translated(p: Plugin, session: Session)(number: (Properties, String) => Float): Phase =
    p.name match
      case "isotropic" => Isotropic
      case "hg" => session.translate(p)(in => of("hg", Vector(in.number("g", 0.8).toFloat)))
      case "rayleigh" => of("rayleigh", Vector.empty)
      case "tabphase" => session.translate(p)(tabulated)
      case "blendphase" => session.translate(p)(blended(_, session)(number))
      case "mixturephase" => session.translate(p)(mixed(_, session)(number))
      case "kkay" =>
        Plugins.unsupported(p, "using \"isotropic\" times `kd`, as without orientation", session)
        session.translate(p): in =>
          in.ignore("ks", "exponent")
          Isotropic.copy(scattered = in.number("kd", 0.2).toFloat)
      case _ =>
        Plugins.unsupported(p, "using \"isotropic\"", session)
        Isotropic

  private def tabulated(in: Properties): Phase =
    val numbers = in.text("values").fold(Vector.empty)(Values.numbers(_, in.posOf("values")))
    val values = numbers.map(_.toFloat)
    if values.size > 1 && values.forall(_ >= 0f) && values.exists(_ > 0f) then
      of("tabulated", values.size.toFloat +: values)
    else
      in.session.error(
        Code.ParameterValue,
        in.posOf("values"),
        s"`values` of ${in.plugin.description} must be two numbers or more, at least 0, and " +
          s"not all 0, found ${values.size}: ${values.take(8).mkString(", ")}"
      )
      Isotropic

  private def blended(
      in: Properties,
      session: Session
  )(number: (Properties, String) => Float): Phase =
    val weight = Math.max(0f, Math.min(number(in, "weight"), 1f))
    in.nested("phase").map(translated(_, session)(number)) match
      case Vector(first, second) =>
        val shares = Seq(first -> (1f - weight), second -> weight)
        summed(shares)
      case phases =>
        session.error(
          Code.ParameterValue,
          in.pos,
          s"${in.plugin.description} must have two phase functions, found ${phases.size}"
        )
        Isotropic

  private def summed(shares: Seq[(Phase, Float)]): Phase =
    val scattered = shares.map((phase, share) => phase.scattered * share).sum
    val lobes =
      for
        (phase, share) <- shares.toVector
        lobe <- phase.lobes
      yield lobe.copy(weight = lobe.weight * phase.scattered * share / scattered)
    Phase(lobes, scattered)

  /** What the weights leave of 1 is absorbed. */
  private def mixed(
      in: Properties,
      session: Session
  )(number: (Properties, String) => Float): Phase =
    val phases = in.nested("phase").map(translated(_, session)(number))
    Mixture.weights(in, phases.size, "phase function").fold(Isotropic): weights =>
      summed(phases.zip(weights.map(_.toFloat)))
