package candela.build

import candela.bidirectional.SpectralChainPaths
import candela.color.Wavelengths
import candela.film.{Splats, View}
import candela.integrators.{ConvertedSplats, Integrator, SpectralIntegrator, SpectralPasses}
import candela.render.RenderMethod

/** The render method of spectral rendering, made of those of the single bases. */
private[build] object SpectralMethod:

  /** @param parts of the same kind, at least one */
  def apply(parts: Vector[(Wavelengths, RenderMethod)]): RenderMethod =
    val bases = parts.map(_._1).toArray
    val methods = parts.map(_._2)
    def converted(view: View, basis: Wavelengths) =
      view.copy(splats = ConvertedSplats(view.splats, basis))
    def ofView(integrators: Vector[View => Integrator])(view: View): Integrator =
      val made = integrators.zip(bases).map((make, basis) => make(converted(view, basis)))
      SpectralIntegrator(made.toArray, bases)
    methods.head match
      case RenderMethod.Tiles(_) =>
        val made = methods.collect { case RenderMethod.Tiles(i) => i }
        RenderMethod.Tiles(SpectralIntegrator(made.toArray, bases))
      case RenderMethod.Guided(_, settings, _) =>
        val made = methods.collect { case g: RenderMethod.Guided => g }
        def all(integrators: Vector[Integrator]) = SpectralIntegrator(integrators.toArray, bases)
        RenderMethod.Guided(
          all(made.map(_.unguided)),
          settings,
          shared => all(made.map(_.integrator(shared)))
        )
      case RenderMethod.SplattedTiles(_) =>
        RenderMethod.SplattedTiles(ofView(methods.collect {
          case RenderMethod.SplattedTiles(make) => make
        }))
      case RenderMethod.Passes(_) =>
        val made = methods.collect { case RenderMethod.Passes(make) => make }
        RenderMethod.Passes(view => SpectralPasses(made.map(_(view)), bases))
      case RenderMethod.Chains(_, chains, _) =>
        val made = methods.collect { case RenderMethod.Chains(paths, _, single) => (paths, single) }
        def paths(view: View, splats: Splats) =
          val each = made.zip(bases).map: (of, basis) =>
            of._1(view, ConvertedSplats(splats, basis))
          SpectralChainPaths(each.toArray, bases)
        RenderMethod.Chains(paths, chains, ofView(made.map(_._2)))
