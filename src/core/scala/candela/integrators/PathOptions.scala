package candela.integrators

/** What a path tracer does beside the steps of every path.
  *
  * @param regularizes   roughen BSDFs after the first non-specular bounce
  * @param subsurface    does light travel beneath surfaces?
  * @param samplesLights does light sampling look for lights, too?
  * @param crossesPanes  do paths and light samples through media pass panes without a scattering
  *   event, as they pass interfaces?
  * @param hidesEmitters does the camera see through area lights, and no sky?
  * @param interfaces    what interfaces are to light sampling; in media they are open
  * @param countsPassed  is passing an interface one of the events that a path may have?
  * @param caustics      weights against light paths, if there are any
  * @param photons       what photons bring in place of paths, if anything
  */
final case class PathOptions(
    regularizes: Boolean = false,
    subsurface: Boolean = false,
    samplesLights: Boolean = true,
    crossesPanes: Boolean = false,
    hidesEmitters: Boolean = false,
    interfaces: Interfaces = Interfaces.Open,
    countsPassed: Boolean = false,
    caustics: Option[CausticWeights] = None,
    photons: Option[PhotonLight] = None
):
  /** Does any of these need [[PathTechniques]]? */
  private[integrators] def extendsPaths: Boolean =
    regularizes || subsurface || hidesEmitters || caustics.isDefined || photons.isDefined
