package candela.stability

import candela.scenefile.Dialect

/** A ball of a material or medium at the end of its parameters, on a floor under an emitter and a
  * sky.
  *
  * @param what  the statements that describe it
  * @param depth maximum number of scattering events
  */
final case class ExtremeBall(
    name: String,
    dialect: Dialect,
    kind: ExtremeBall.Kind,
    what: String,
    depth: Int = 6
):
  import ExtremeBall.*

  def isV4: Boolean = dialect == Dialect.V4
  def hasMedium: Boolean = kind == Kind.Medium

  /** Is a part of the light let through unscattered? */
  def isOpen: Boolean = name.contains("open")

  /** The film is filled by the ball, so that few pixels do. */
  def scene(integrator: String, depth: Int, spp: Int): String =
    val (film, points, matte) =
      if isV4 then ("rgb", "point3", """"diffuse" "rgb reflectance"""")
      else ("image", "point", """"matte" "rgb Kd"""")
    s"""LookAt 0 -5 1.6  0 0 0  0 0 1
       |Camera "perspective" "float fov" 6
       |Film "$film" "integer xresolution" 3 "integer yresolution" 3
       |PixelFilter "box" "float xradius" .5 "float yradius" .5
       |Sampler "${if isV4 then "independent" else "random"}" "integer pixelsamples" $spp
       |Integrator $integrator "integer maxdepth" $depth
       |WorldBegin
       |LightSource "infinite" "rgb L" [.3 .35 .4]
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [8 7 6]
       |Translate -.8 -.8 1.2
       |Shape "sphere" "float radius" .4
       |AttributeEnd
       |Material $matte [.5 .5 .5]
       |Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
       |  "$points P" [-.8 -.8 -.51  .8 -.8 -.51  .8 .8 -.51  -.8 .8 -.51]
       |$what
       |Shape "sphere" "float radius" .5
       |""".stripMargin

object ExtremeBall:
  enum Kind:
    /** Light is scattered in all directions, or in a lobe that is wide. */
    case Wide

    /** The same, and light within it reaches the camera by narrow ways only, if at all. */
    case Narrow

    /** Perfectly specular. */
    case Specular
    case Medium

  import Kind.*

  private def v4(kind: Kind)(all: (String, String)*): Seq[ExtremeBall] =
    for (name, what) <- all
    yield ExtremeBall(s"v4: $name", Dialect.V4, kind, s"Material $what")

  private def v3(kind: Kind)(all: (String, String)*): Seq[ExtremeBall] =
    for (name, what) <- all
    yield ExtremeBall(s"v3: $name", Dialect.V3, kind, s"Material $what")

  private val plain = "\"bool remaproughness\" false \"float roughness\""

  private def surfaces = v4(Wide)(
    "white" -> """"diffuse" "rgb reflectance" [1 1 1]""",
    "a sheet" -> """"diffusetransmission" "rgb reflectance" [.4 .4 .4]
      "rgb transmittance" [.6 .6 .6]""",
    "metal of roughness .5" -> s""""conductor" $plain .5""",
    "metal of roughness 2" -> s""""conductor" $plain 2""",
    "brushed metal" ->
      """"conductor" "bool remaproughness" false "float uroughness" .05 "float vroughness" 1""",
    "metal of reflectance 1" -> s""""conductor" $plain 1 "rgb reflectance" [1 1 1]""",
    "glass of roughness .5" -> s""""dielectric" $plain .5""",
    "glass of roughness 2, index 10" -> s""""dielectric" $plain 2 "float eta" 10""",
    "coat of roughness 1" -> s""""coateddiffuse" $plain 1""",
    "coat of index 1.001" -> s""""coateddiffuse" $plain .3 "float eta" 1.001""",
    "coat of index 5" -> s""""coateddiffuse" $plain .5 "float eta" 5""",
    "coat that scatters on" ->
      s""""coateddiffuse" $plain .3 "float thickness" 9 "float g" .95 "rgb albedo" [1 1 1]""",
    "coat of no thickness" -> s""""coateddiffuse" $plain .3 "float thickness" 0""",
    "coated metal" ->
      """"coatedconductor" "bool remaproughness" false "float interface.roughness" .4
        "float conductor.roughness" .6""",
    "cloudily coated metal" ->
      """"coatedconductor" "bool remaproughness" false "float interface.roughness" 1
        "float conductor.roughness" .3 "float thickness" .5 "rgb albedo" [.8 .8 .8]""",
    "rough hair" ->
      """"hair" "float beta_m" 1 "float beta_n" 1 "float eumelanin" 8 "float alpha" 10""",
    "fair hair" -> """"hair" "float beta_m" .6 "float beta_n" .6 "rgb sigma_a" [.01 .01 .01]""",
    "hair of index 3" -> """"hair" "float beta_m" .5 "float beta_n" .9 "float eta" 3"""
  ) ++ v3(Wide)(
    "clay" -> """"matte" "rgb Kd" [.9 .9 .9] "float sigma" 90""",
    "plastic" -> """"plastic" "rgb Kd" [.4 .4 .4] "rgb Ks" [.5 .5 .5] "float roughness" 1""",
    "varnish" -> """"substrate" "rgb Kd" [.5 .5 .5] "rgb Ks" [.9 .9 .9]
      "float uroughness" .5 "float vroughness" .2""",
    "translucent" -> """"translucent" "float roughness" .4""",
    "uber, half open" ->
      """"uber" "rgb Kd" [.3 .3 .3] "rgb Ks" [.3 .3 .3] "rgb Kr" [0 0 0] "rgb opacity" [.5 .5 .5]
        "float roughness" .5""",
    "disney" ->
      """"disney" "rgb color" [.8 .8 .8] "float metallic" .3 "float sheen" 1 "float clearcoat" 1
        "float roughness" .6 "float anisotropic" .9""",
    "disney, transmissive" ->
      """"disney" "rgb color" [.8 .8 .8] "float spectrans" .8 "float roughness" .6""",
    "disney, thin" ->
      """"disney" "rgb color" [.8 .8 .8] "bool thin" true "float spectrans" .5
        "float difftrans" 1 "float flatness" 1 "float roughness" .7""",
    "dark hair" -> """"hair" "float beta_m" 1 "float beta_n" 1 "float eumelanin" 8"""
  )

  private def lenses = v4(Narrow)(
    "metal of roughness 1e-6" -> s""""conductor" $plain 1e-6""",
    "metal of roughness .01" -> s""""conductor" $plain .01""",
    "glass of roughness .02" -> s""""dielectric" $plain .02""",
    "coat that scatters back" ->
      s""""coateddiffuse" $plain .3 "float thickness" 1 "float g" -.95 "rgb albedo" [.9 .9 .9]""",
    "a smooth coat" -> """"coateddiffuse" "float roughness" 0""",
    "smooth hair" -> """"hair" "float beta_m" .05 "float beta_n" .1 "rgb sigma_a" [.3 .3 .3]""",
    "smoothly coated metal" -> """"coatedconductor" "float interface.roughness" 0"""
  ) ++ v3(Narrow)(
    "a mixture with a mirror" -> """"uber" "rgb Kd" [.4 .4 .4] "rgb Kr" [.5 .5 .5]"""
  )

  private def mirrors = v4(Specular)(
    "mirror" -> """"conductor" "float roughness" 0""",
    "glass of index 1" -> """"dielectric" "float eta" 1""",
    "glass of index 1.0001" -> """"dielectric" "float eta" 1.0001""",
    "glass of index 10" -> """"dielectric" "float eta" 10""",
    "a pane of index 10" -> """"thindielectric" "float eta" 10"""
  ) ++ v3(Specular)("glass" -> """"glass" "rgb Kr" [1 1 1] "rgb Kt" [1 1 1]""")

  private def medium(
      name: String,
      what: String,
      surface: String = "\"interface\"",
      depth: Int = 8
  ) =
    ExtremeBall(
      s"v4: $name",
      Dialect.V4,
      Medium,
      s"""MakeNamedMedium "m" "string type" $what
         |MediumInterface "m" ""
         |Material $surface""".stripMargin,
      depth
    )

  private def homogeneous(
      scattering: String,
      absorption: String,
      g: Float,
      depth: Int = 8
  ): ExtremeBall =
    medium(
      s"scattering $scattering, absorption $absorption, g $g",
      s""""homogeneous" "rgb sigma_s" [$scattering] "rgb sigma_a" [$absorption] "float g" $g""",
      depth = depth
    )

  private val cells = (1 to 8).map(i => (i % 3) * 0.5).mkString(" ")
  private def cube(density: String) =
    s"""$density "point3 p0" [-.5 -.5 -.5] "point3 p1" [.5 .5 .5]
       | "integer nx" 2 "integer ny" 2 "integer nz" 2""".stripMargin

  private def media = Seq(
    homogeneous("1e-9 1e-9 1e-9", "1e-9 1e-9 1e-9", 0f),
    homogeneous("5 5 5", ".1 .1 .1", -0.99f),
    homogeneous("5 5 5", ".1 .1 .1", -0.95f, depth = 40),
    homogeneous("20 20 20", ".1 .1 .1", 0.5f),
    homogeneous("20 20 20", ".1 .1 .1", 0.9f, depth = 40),
    homogeneous("20 20 20", ".1 .1 .1", 0.99f, depth = 40),
    homogeneous("1e6 1e6 1e6", "1e4 1e4 1e4", 0f),
    homogeneous("1e6 1e6 1e6", "1e4 1e4 1e4", -0.99f, depth = 40),
    homogeneous("1e6 1 1e-9", "1e-9 .1 1", 0.3f),
    homogeneous("1e-9 1 9", ".1 .1 1e6", 0.3f),
    homogeneous("0 0 0", "1e6 1e6 1e6", 0f),
    medium(
      "glowing",
      """"homogeneous" "rgb sigma_s" [9 9 9] "rgb sigma_a" [.5 1 100] "rgb Le" [.3 .3 .3]"""
    ),
    medium(
      "a dense grid, backwards",
      s""""uniformgrid" "rgb sigma_s" [50 50 50] "rgb sigma_a" [1 1 1] "float g" -.98
         |${cube(s"\"float density\" [$cells]")}""".stripMargin
    ),
    medium(
      "a coloured grid, forwards",
      s""""uniformgrid" "rgb sigma_s" [100 10 1] "rgb sigma_a" [1 1 9] "float g" .95
         |${cube(s"\"float density\" [$cells]")}""".stripMargin,
      depth = 40
    ),
    medium(
      "a grid of colours",
      s""""rgbgrid" "float scale" 5 "float g" .9
         |${cube(s"\"rgb sigma_s\" [${Seq.fill(8)("1 .5 .2").mkString(" ")}]")}""".stripMargin,
      depth = 40
    ),
    medium(
      "a cloud",
      """"cloud" "float density" 100 "float g" .877 "rgb sigma_s" [1 1 1] "rgb sigma_a" [0 0 0]
        "point3 p0" [-.5 -.5 -.5] "point3 p1" [.5 .5 .5]""",
      depth = 20
    ),
    medium(
      "smoke in rough glass",
      """"homogeneous" "rgb sigma_s" [9 9 9] "rgb sigma_a" [.1 .1 .1] "float g" .9""",
      s""""dielectric" $plain .5"""
    ),
    medium(
      "smoke in smooth glass",
      """"homogeneous" "rgb sigma_s" [9 9 9] "rgb sigma_a" [.1 .1 .1] "float g" -.9""",
      """"dielectric" "float eta" 1.5"""
    ),
    medium(
      "smoke in a coat of hair",
      """"homogeneous" "rgb sigma_s" [9 9 9] "rgb sigma_a" [.1 .1 .1]""",
      """"hair" "float beta_m" .8 "float beta_n" .8"""
    )
  )

  val all: Seq[ExtremeBall] = surfaces ++ lenses ++ mirrors ++ media
