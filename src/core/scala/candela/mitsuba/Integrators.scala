package candela.mitsuba

import candela.diagnostics.{Code, Limit, SourcePos}
import candela.scenefile.{Declaration, Param}

/** Translates integrators.
  *
  * @param sampleCount samples per pixel of the sensor
  */
final class Integrators(session: Session, sampleCount: => Int):

  def apply(p: Plugin): Declaration = session.translate(p): in =>
    // Read to be checked only: roulette starts where it does in all dialects, with the same mean
    val roulette = in.integer("rr_depth", 5)
    if roulette < 1 then
      session.warn(
        Code.IdleParameter,
        in.posOf("rr_depth"),
        s"`rr_depth` must be at least 1, found $roulette; it is ignored"
      )
    in.ignore("emitter_samples", "bsdf_samples", "shading_samples", "block_size",
      "samples_per_pass", "timeout", "use_nee", "sampling_integrator")
    in.ignore(Integrators.Effort.getOrElse(p.name, Vector.empty)*)
    if in.flag("strict_normals", false) then
      in.warnUnsupported("light may leak at shading normals", "strict_normals")
    p.name match
      case "path" | "prb" | "prb_basic" => limited(in, "path", hiding(in)*)
      case "volpath" | "volpathmis" | "prbvolpath" | "volpath_simple" =>
        limited(in, "volpath", hiding(in)*)
      case "photonmapper" | "ppm" | "sppm" | "vpl" =>
        instead(in, "\"volpath\", whose image has no bias")
        limited(in, "volpath", hiding(in)*)
      case "bdpt" =>
        if in.flag("show_weighted", false) then
          in.warnUnsupported("only the image is rendered", "show_weighted")
        limited(in, "bdpt")
      case "mlt" | "pssmlt" | "erpt" => metropolis(in)
      case "ao" =>
        val position = in.posOf("ray_length")
        val distance = Param.float("maxdistance", position, in.number("ray_length", -1).toFloat)
        session.declare("Integrator", "ambientocclusion", in.pos, Seq(distance))
      case "adaptive" | "irrcache" => innerIntegrator(in)
      case "ptracer" =>
        in.warnUnsupported("area lights are visible", "hide_emitters")
        limited(in, "lightpath")
      case "direct" => session.declare(
          "Integrator",
          "path",
          in.pos,
          Param.int("maxdepth", in.pos, 1) +: hiding(in)
        )
      case "aov" | "moment" | "multichannel" | "stokes" =>
        in.ignore("aovs")
        val integrators = in.nested("integrator").filter(_.name != "field")
        for surplus <- integrators.drop(1) do
          session.warn(
            Code.Unsupported,
            surplus.pos,
            s"only the first integrator of ${p.description} is rendered; this one is ignored"
          )
        integrators.headOption.fold(Integrators.default(session, in.pos))(apply)
      case _ =>
        val fallback = "using \"path\""
        Plugins.unsupported(p, fallback, session)
        in.ignore(p.properties.map(_.name)*)
        Integrators.default(session, in.pos)

  private def instead(in: Properties, what: String): Unit =
    val message = s"${in.plugin.description} is not supported; using $what"
    session.warn(Code.Unsupported, in.pos, message)

  /** pbrt's Metropolis light transport, which mutates random numbers. */
  private def metropolis(in: Properties): Declaration =
    if in.plugin.name != "pssmlt" then
      instead(in, "\"pssmlt\": paths are mutated by their random numbers")
    val large = in.number("p_large", 0.3)
    if !(large > 0 && large <= 1) then
      session.error(Code.ParameterValue, in.posOf("p_large"), "`p_large` must be from 0 to 1")
    limited(
      in,
      "mlt",
      Param.int("mutationsperpixel", in.pos, sampleCount),
      Param.float("largestepprobability", in.posOf("p_large"), large.toFloat),
      Param.int(
        "bootstrapsamples",
        in.posOf("luminance_samples"),
        in.integer("luminance_samples", 100000)
      )
    )

  private def innerIntegrator(in: Properties): Declaration =
    val help = in.plugin.name match
      case "adaptive" => "--error ends a rendering at an error"
      case _ => "the integrator within has no bias"
    val message = s"${in.plugin.description} is not supported; using the integrator within"
    session.warn(Code.Unsupported, in.pos, message, Some(help))
    in.ignore(in.plugin.properties.map(_.name).filter(_.nonEmpty)*)
    in.nested("integrator").find(_.name != "field")
      .fold(Integrators.default(session, in.pos))(apply)

  /** Mitsuba counts the edges of a path, pbrt the surfaces between. */
  private def limited(in: Properties, name: String, extra: Param*): Declaration =
    val depth = in.integer("max_depth", -1)
    val edges = if depth < 0 then Integrators.unlimited(session) else Math.max(0, depth - 1)
    if depth < -1 then
      session.warn(
        Code.CorrectedValue,
        in.posOf("max_depth"),
        s"`max_depth` must be at least 0, or -1 for no limit, found $depth; using -1"
      )
    if depth == 0 then
      session.warn(
        Code.DarkScene,
        in.posOf("max_depth"),
        "paths of depth 0 see nothing; the image is black"
      )
    session.declare(
      "Integrator",
      name,
      in.pos,
      Param.int("maxdepth", in.posOf("max_depth"), edges) +: extra
    )

  private def hiding(in: Properties): Seq[Param] =
    val position = in.posOf("hide_emitters")
    Option.when(in.flag("hide_emitters", false))(Param.bool("hideemitters", position, true)).toSeq

object Integrators:
  /** Parameters of Mitsuba 0.6 that have an effect on time and noise, or bias, alone. */
  private val Effort: Map[String, Vector[String]] =
    val photons = Vector("granularity", "auto_cancel_gathering")
    val progressive =
      photons ++ Vector("initial_radius", "alpha", "photon_count", "max_passes")
    val mutations = Vector(
      "bidirectional_mutation", "lens_perturbation", "caustic_perturbation",
      "multi_chain_perturbation", "manifold_perturbation", "prob_factor", "lambda",
      "direct_samples", "two_stage", "first_stage", "first_stage_size_reduction", "work_units"
    )
    Map(
      "bdpt" -> Vector("light_image", "sample_direct"),
      "ptracer" -> Vector("granularity", "brute_force"),
      "photonmapper" -> (photons ++ Vector(
        "direct_samples", "glossy_samples",
        "max_specular_depth", "global_photons", "caustic_photons", "volume_photons",
        "global_lookup_radius", "caustic_lookup_radius", "lookup_size", "global_lookup_size",
        "caustic_lookup_size", "volume_lookup_size", "gather_locally"
      )),
      "ppm" -> progressive,
      "sppm" -> progressive,
      "vpl" -> Vector("shadow_map_resolution", "clamping"),
      "mlt" -> mutations,
      "erpt" -> (mutations ++ Vector("num_chains", "max_chains", "chain_length",
        "avg_angle_change_surface", "avg_angle_change_medium")),
      "pssmlt" -> (mutations ++ Vector("bidirectional", "kelemen_style_weights",
        "direct_sampling", "mutation_size_low", "mutation_size_high"))
    )

  /** Whether its paths have no edge: they see nothing, not even lights. */
  def isBlack(p: Plugin): Boolean = p.properties.exists: q =>
    q.value match
      case Value.Number(x) => q.name == "max_depth" && x == 0
      case Value.Nested(inner) => inner.kind == "integrator" && isBlack(inner)
      case _ => false

  /** Russian roulette ends paths long before. */
  private val Unlimited = 10_000

  private def unlimited(session: Session) = session.allowance.capped(Limit.Depth, Unlimited)

  def default(session: Session, at: SourcePos): Declaration =
    session.declare("Integrator", "path", at, Seq(Param.int("maxdepth", at, unlimited(session))))
