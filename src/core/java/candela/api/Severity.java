package candela.api;

// In Java: constants of a Scala enum are null to Java if Scala code initialises the enum first.

/** Severity of a {@link Problem}. */
public enum Severity {
  /** The scene is rendered nevertheless. */
  Warning,

  /** The scene is not rendered. */
  Error
}
