package candela.gallery

import candela.gallery.Example.Unseen

/** Lights in a dark room and cameras among spheres. */
private object LightExamples:
  val lights: Vector[(String, String)] = Vector(
    "point" -> "LightSource \"point\" \"rgb I\" [12 11 9] \"point3 from\" [1.2 -1 2.4]",
    "spot" ->
      """LightSource "spot" "rgb I" [30 27 24] "point3 from" [1.5 -2 3.5] "point3 to" [0 0 .2]""",
    "goniometric" ->
      """Translate .8 -.6 1.8
        |LightSource "goniometric" "string filename" "textures/dusk-equalarea.exr" "float scale" 20
        |""".stripMargin,
    "projection" ->
      """Translate 0 -4 2
        |Rotate -103 1 0 0
        |LightSource "projection" "string filename" "textures/chart.png" "float fov" 28
        |  "float scale" 90""".stripMargin,
    "distant" ->
      "LightSource \"distant\" \"rgb L\" [2.5 2.4 2.2] \"point3 from\" [2 -2 3]",
    "infinite" ->
      """LightSource "infinite" "string filename" "textures/dusk-equalarea.exr"
        |  "float scale" 2.5""".stripMargin,
    "exinfinite" -> "LightSource \"exinfinite\" \"string mapname\" \"textures/sky-latlong.exr\""
  )

  val unseenLights: Map[String, Example] = Map("sunsky" -> Unseen("of Mitsuba's scenes"))

  val areaLights: Vector[(String, String)] = Vector(
    "diffuse" -> "AreaLightSource \"diffuse\" \"rgb L\" [9 8 6]",
    "area" -> "AreaLightSource \"area\" \"rgb L\" [9 8 6]"
  )

  val cameras: Vector[(String, String)] = Vector(
    "perspective" -> "Camera \"perspective\"",
    "orthographic" ->
      """Identity
        |LookAt 0 -3 3.2  0 1.8 .4  0 0 1
        |Camera "orthographic" "float screenwindow" [-2 2 -1.5 1.5]""".stripMargin,
    "environment" -> "Camera \"environment\"",
    "spherical" -> "Camera \"spherical\"",
    "realistic/v4" ->
      """Identity
        |LookAt -1 -2.2 1.4  .1 2.1 .35  0 0 1
        |Camera "realistic" "string lensfile" "lenses/double-gauss-50mm.dat"
        |  "float aperturediameter" 17.1 "float focusdistance" 3.7""".stripMargin
  )

  val unseenCameras: Map[String, Example] =
    Map("realistic/v2" -> Unseen("only forks of pbrt-v2 have it"))
