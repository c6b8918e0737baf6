package candela.integrators

/** What looks for caustics beside the camera's paths: nothing; light paths or photons, where they
  * pay, for the light that the camera's paths find, too; light paths, for all light; or photons,
  * which blur it a little.
  */
enum CausticsMode:
  case Off, Auto, On, Photons
