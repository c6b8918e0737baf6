package candela.noise

/** The scenes of this repository that noise is measured on. */
private[noise] object NoiseScenes:
  val all: Vector[String] = Vector(
    "bench/scenes/grey-room.v4.pbrt",
    "bench/scenes/lamps.v4.pbrt",
    "scenes/v3-glass.pbrt",
    "scenes/v4-environment-map.pbrt",
    "scenes/v3-matte-directlighting.pbrt"
  )

  /** The name of a scene, in tables. */
  def name(file: String): String =
    file.split('/').takeRight(2).filter(_ != "scenes").mkString("/").stripSuffix(".pbrt")
