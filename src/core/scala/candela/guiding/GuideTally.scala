package candela.guiding

/** Bounces that one worker counted. Mutable. */
final class GuideTally:
  /** Off surfaces that are not specular. */
  var bounces = 0L

  /** Of these, those that were guided. */
  var guided = 0L
