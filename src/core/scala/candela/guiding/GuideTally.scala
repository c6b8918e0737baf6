package candela.guiding

/** Bounces that one worker counted. Mutable. */
final class GuideTally:
  /** Off surfaces that are not specular. */
  var bounces = 0L

  /** Of these, those that were guided. */
  var guided = 0L

  /** By how much the second moments of light met by way of specular surfaces are below those that
    * unguided paths would have.
    */
  var saving = 0.0
