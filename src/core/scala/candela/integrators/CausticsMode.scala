package candela.integrators

/** What looks for caustics beside the camera's paths: nothing; light paths, for the light that
  * these find, too, with more noise; light paths, for all light; or photons, which blur it a
  * little.
  */
enum CausticsMode:
  case Off, Auto, On, Photons
