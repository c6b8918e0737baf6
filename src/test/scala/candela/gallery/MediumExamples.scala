package candela.gallery

/** Media with about the size of the unit cube. */
private object MediumExamples:
  private def inBall(medium: String): String =
    s"""$medium
       |MediumInterface "shown" ""
       |Material "interface"
       |Translate 0 0 .95
       |Shape "sphere" "float radius" .9""".stripMargin

  // Lumps of different sizes
  private val numbers = Vector.tabulate(125)(i => if i * i * i % 11 < 4 then 8 else 0).mkString(" ")
  private val colors = Vector.tabulate(81)(i => i * 5 % 4 * 2).mkString(" ")
  private val place = "\"point3 p0\" [-.9 -.9 0] \"point3 p1\" [.9 .9 1.9]"
  private val grid = "\"integer nx\" 5 \"integer ny\" 5 \"integer nz\" 5"
  private val coarse = "\"integer nx\" 3 \"integer ny\" 3 \"integer nz\" 3"
  private val thin = "\"rgb sigma_a\" [.1 .1 .1] \"rgb sigma_s\" [1 1 1]"
  private val amber = "\"rgb sigma_a\" [.02 .2 .6] \"rgb sigma_s\" [1.6 1.6 1.6]"

  private def v4(name: String, rest: String) =
    name -> inBall(s"MakeNamedMedium \"shown\" \"string type\" \"$name\" $rest")

  val media: Vector[(String, String)] = Vector(
    v4("homogeneous", amber),
    "heterogeneous" -> inBall(
      "MakeNamedMedium \"shown\" \"string type\" \"heterogeneous\" " +
        s"$thin $grid ${place.replace("point3", "point")} \"float density\" [$numbers]"
    ).replace("Material \"interface\"", "Material \"none\""),
    v4("uniformgrid", s"$thin $grid $place \"float density\" [$numbers]"),
    v4("rgbgrid", s"$coarse $place \"rgb sigma_s\" [$colors]"),
    // Its noise thins out along y
    "cloud" -> inBall(
      """AttributeBegin
        |Translate -1 1 0
        |Scale 2 2 2
        |Rotate 90 1 0 0
        |MakeNamedMedium "shown" "string type" "cloud" "rgb sigma_a" [0 0 0]
        |  "rgb sigma_s" [8 8 8]
        |AttributeEnd""".stripMargin
    ),
    "nanovdb" -> inBall(
      s"""AttributeBegin
         |Translate 0 0 -.4
         |Scale 2 2 2
         |MakeNamedMedium "shown" "string type" "nanovdb" $thin "float scale" 8
         |  "string filename" "volumes/smoke.nvdb"
         |AttributeEnd""".stripMargin
    )
  )

  private val box = "\"point p0\" [-.9 -.9 0] \"point p1\" [.9 .9 1.9]"
  private def volume(name: String, rest: String) = name -> s"Volume \"$name\" $box $rest"

  val volumes: Vector[(String, String)] = Vector(
    volume("homogeneous", amber),
    volume("volumegrid", s"$thin $grid \"float density\" [$numbers]"),
    volume("exponential", s"$amber \"float a\" 3 \"float b\" 2 \"vector updir\" [0 0 1]")
  )
