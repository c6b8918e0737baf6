package candela.api;

// In Java: constants of a Scala enum are null to Java if Scala code initialises the enum first.

/** A statement that a scene has once. */
public enum SceneSetting {
  Camera,
  Film,
  Sampler,
  Filter,
  Integrator
}
