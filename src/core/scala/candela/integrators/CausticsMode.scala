package candela.integrators

/** What looks for caustics beside the camera's paths. */
enum CausticsMode:
  /** Nothing. */
  case Off

  /** Light paths or photons, where they pay, for the light that the camera's paths find, too. */
  case Auto

  /** Light paths, for all light, also that of delta lights: unbiased. */
  case On

  /** Photons, which blur caustics a little: biased, but consistent. */
  case Photons
