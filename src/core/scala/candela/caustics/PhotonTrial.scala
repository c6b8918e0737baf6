package candela.caustics

import candela.concurrency.{GivenUp, Parallel}
import candela.film.View
import candela.integrators.{Integrator, PhotonLight}
import candela.math.square
import candela.scene.Scene

/** Estimates by few paths whether photons pay: by how much they reduce variance times rays. Depends
  * on the scene and its camera alone, as [[CausticPilot]].
  *
  * Few paths miss most of what makes a caustic noisy. Light that photons bring, and that none of n
  * paths has found, has at least n times its square as variance.
  *
  * @param choice where photons begin, and how they are gathered
  * @param tracer the camera's paths, without photons or with them
  */
private final class PhotonTrial(
    scene: Scene,
    view: View,
    light: CausticLight,
    choice: PhotonChoice,
    pool: Parallel,
    tracer: Option[PhotonLight] => Integrator
):
  import PhotonTrial.*

  def run(): PilotResult =
    val plain = followed: () =>
      val paths = tracer(None)
      (paths, paths)
    val mapped = withPhotons
    val mean = mapped.meanOfAll
    var plainVariance, mappedVariance = 0.0
    plain.foreach: i =>
      val n = plain.samples(i)
      val mappedMean = mapped.mean(i)
      val missing = Math.max(0.0, mappedMean - plain.mean(i))
      val weight = n / (square(mappedMean) + square(PilotBlocks.Floor * mean))
      plainVariance += weight * Math.max(plain.variance(i), n * square(missing))
      mappedVariance += weight * mapped.variance(i)
    val cost = TimeOfRay * mapped.rays / plain.rays
    // As many samples as pixels, as other pilots reckon
    val unit = view.pixels / (2 * Pairs)
    PilotResult.of(choice, unit * plainVariance, unit * mappedVariance * cost)

  /** As many light paths as samples, as in the rendering. The samples of a pair have maps of their
    * own: those of one map have the same noise.
    */
  private def withPhotons: PilotBlocks =
    // As many photons within the radius as if there was a light path for each pixel
    val wider = Math.sqrt(view.pixels / Pairs)
    val passes = CausticPasses(
      scene,
      light.copy(casters = choice.casters),
      (choice.radius * LaterRadius * wider).toFloat,
      choice.bringsAll,
      CausticPilot.Seed,
      view,
      (_, photons) => tracer(Some(photons)),
      paths = Pairs
    )
    def integrator(pass: Int): Integrator =
      val gatherer = passes.integrator(None)
      gatherer.startPass(pass, GivenUp.Never): Unit
      gatherer
    followed(() => (integrator(0), integrator(1)))

  private def followed(integrators: () => (Integrator, Integrator)): PilotBlocks =
    CameraPairs.followed(view, CausticPilot.Seed + 3, pool, 0, Pairs)(integrators)

private object PhotonTrial:
  /** Pairs of paths, and light paths of each of the two maps. */
  inline val Pairs = 1 << 13

  /** The radius after some 64 passes, relative to the first. */
  inline val LaterRadius = 0.5

  /** Time of a ray with photons, which are stored, sorted and gathered, relative to one without. */
  inline val TimeOfRay = 2.0
