package candela.api;

// In Java: constants of a Scala enum are null to Java if Scala code initialises the enum first.

/** The type of a texture's values. */
public enum TextureValues {
  /** Numbers. */
  Float,

  /** Colours and spectra. */
  Spectrum
}
