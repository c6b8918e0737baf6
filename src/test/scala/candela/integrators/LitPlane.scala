package candela.integrators

/** Scenes in pbrt's language that look, under 45°, at one point of a plane z = 0 around the
  * origin.
  */
object LitPlane:

  val Albedo = 0.5f

  /** @param pixels of the side of a square image */
  def view(integrator: String, spp: Int, pixels: Int = 4): String =
    s"""LookAt 3 0 3  0 0 0  0 1 0
       |Camera "orthographic" "float screenwindow" [-1e-3 1e-3 -1e-3 1e-3]
       |Film "image" "integer xresolution" $pixels "integer yresolution" $pixels
       |Sampler "random" "integer pixelsamples" $spp
       |Integrator $integrator
       |""".stripMargin

  def matte(albedo: Float = Albedo): String =
    s"""Material "matte" "rgb Kd" [$albedo $albedo $albedo]"""

  def scene(
      integrator: String,
      spp: Int,
      lights: String,
      material: String = matte(),
      pixels: Int = 4
  ): String =
    s"""${view(integrator, spp, pixels)}
       |WorldBegin
       |$lights
       |$material
       |Shape "disk" "float radius" 1000
       |WorldEnd
       |""".stripMargin
