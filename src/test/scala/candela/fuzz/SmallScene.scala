package candela.fuzz

/** Scenes that take a millisecond. */
private[fuzz] object SmallScene:

  def v4(integrator: String, world: String = "", name: String = "s.exr"): String =
    s"""LookAt 0 0 -4  0 0 0  0 1 0
       |Camera "perspective" "float fov" 40
       |Film "rgb" "integer xresolution" 4 "integer yresolution" 4 "string filename" "$name"
       |Sampler "independent" "integer pixelsamples" 2
       |Integrator "$integrator" "integer maxdepth" 2 ${more(integrator)}
       |WorldBegin
       |LightSource "point" "point3 from" [ 3 4 -5 ] "rgb I" [ 40 40 40 ]
       |$world
       |Shape "sphere"
       |""".stripMargin

  def v3(integrator: String, world: String = ""): String =
    s"""LookAt 0 0 -4  0 0 0  0 1 0
       |Camera "perspective" "float fov" 40
       |Film "image" "integer xresolution" 4 "integer yresolution" 4 "string filename" "s.exr"
       |Sampler "random" "integer pixelsamples" 2
       |Integrator "$integrator" "integer maxdepth" 2
       |WorldBegin
       |LightSource "point" "point from" [ 3 4 -5 ] "rgb I" [ 40 40 40 ]
       |$world
       |Shape "sphere"
       |WorldEnd
       |""".stripMargin

  def document: String = xml("<shape type=\"sphere\"/>")

  def xml(body: String): String =
    s"""<scene version="3.0.0"><sensor type="perspective"><sampler type="independent">
       |<integer name="sample_count" value="2"/></sampler><film type="hdrfilm">
       |<integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
       |<emitter type="constant"/>
       |$body
       |</scene>
       |""".stripMargin

  private def more(integrator: String): String = integrator match
    case "mlt" => "\"integer bootstrapsamples\" 50 \"integer chains\" 4"
    case "sppm" => "\"float radius\" 0.3"
    case _ => ""
