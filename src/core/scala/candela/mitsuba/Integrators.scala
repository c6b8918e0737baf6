package candela.mitsuba

import candela.diagnostics.{Code, Limit, SourcePos}
import candela.scenefile.{Declaration, Param}

/** Translates integrators. */
final class Integrators(session: Session):

  def apply(p: Plugin): Declaration = session.translate(p): in =>
    // Read to be checked only: roulette starts where it does in all dialects, with the same mean
    val roulette = in.integer("rr_depth", 5)
    if roulette < 1 then
      session.warn(
        Code.IdleParameter,
        in.atOf("rr_depth"),
        s"`rr_depth` must be at least 1, found $roulette; it is ignored"
      )
    in.ignore("emitter_samples", "bsdf_samples", "shading_samples", "block_size",
      "samples_per_pass", "timeout", "use_nee", "sampling_integrator")
    p.name match
      case "path" | "prb" | "prb_basic" => limited(in, "path", hiding(in)*)
      case "volpath" | "volpathmis" | "prbvolpath" => limited(in, "volpath", hiding(in)*)
      case "ptracer" =>
        in.warnUnsupported("area lights are visible", "hide_emitters")
        limited(in, "lightpath")
      case "direct" => session.declare(
          "Integrator",
          "path",
          in.at,
          Param.int("maxdepth", in.at, 1) +: hiding(in)
        )
      case "aov" | "moment" | "stokes" =>
        in.ignore("aovs")
        val within = in.nested("integrator")
        for surplus <- within.drop(1) do
          session.warn(
            Code.Unsupported,
            surplus.at,
            s"only the first integrator of ${p.description} is rendered; this one is ignored"
          )
        within.headOption.fold(Integrators.default(session, in.at))(apply)
      case _ =>
        val fallback = "using \"path\""
        Plugins.unsupported(p, fallback, session)
        in.ignore(p.properties.map(_.name)*)
        Integrators.default(session, in.at)

  /** Mitsuba counts the edges of a path, pbrt the surfaces between. */
  private def limited(in: Properties, name: String, extra: Param*): Declaration =
    val depth = in.integer("max_depth", -1)
    val edges = if depth < 0 then Integrators.unlimited(session) else Math.max(0, depth - 1)
    if depth < -1 then
      session.warn(
        Code.CorrectedValue,
        in.atOf("max_depth"),
        s"`max_depth` must be at least 0, or -1 for no limit, found $depth; using -1"
      )
    if depth == 0 then
      session.warn(
        Code.DarkScene,
        in.atOf("max_depth"),
        "paths of depth 0 see nothing; the image is black"
      )
    session.declare(
      "Integrator",
      name,
      in.at,
      Param.int("maxdepth", in.atOf("max_depth"), edges) +: extra
    )

  private def hiding(in: Properties): Seq[Param] =
    val position = in.atOf("hide_emitters")
    Option.when(in.flag("hide_emitters", false))(Param.bool("hideemitters", position, true)).toSeq

object Integrators:
  /** Whether its paths have no edge: they see nothing, not even lights. */
  def isBlack(p: Plugin): Boolean = p.properties.exists: q =>
    q.value match
      case Value.Number(x) => q.name == "max_depth" && x == 0
      case Value.Nested(inner) => inner.kind == "integrator" && isBlack(inner)
      case _ => false

  /** Russian roulette ends paths long before. */
  private val Unlimited = 10_000

  private def unlimited(session: Session) = session.allowance.most(Limit.Depth, Unlimited)

  def default(session: Session, at: SourcePos): Declaration =
    session.declare("Integrator", "path", at, Seq(Param.int("maxdepth", at, unlimited(session))))
