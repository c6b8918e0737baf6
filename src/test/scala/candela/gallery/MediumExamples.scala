package candela.gallery

/** Media with about the size of the unit cube. */
private object MediumExamples:
  private def inBall(medium: String): String =
    s"""$medium
       |MediumInterface "shown" ""
       |Material "interface"
       |Translate 0 0 .95
       |Shape "sphere" "float radius" .9""".stripMargin

  private val numbers = Vector.tabulate(27)(i => (i * 7 % 5) * 2).mkString(" ")
  private val place = "\"point3 p0\" [-.9 -.9 0] \"point3 p1\" [.9 .9 1.9]"
  private val grid = s"\"integer nx\" 3 \"integer ny\" 3 \"integer nz\" 3"
  private val thin = "\"rgb sigma_a\" [.1 .1 .1] \"rgb sigma_s\" [1 1 1]"

  private def v4(name: String, rest: String) =
    name -> inBall(s"MakeNamedMedium \"shown\" \"string type\" \"$name\" $rest")

  val media: Vector[(String, String)] = Vector(
    v4("homogeneous", thin),
    "heterogeneous" -> inBall(
      "MakeNamedMedium \"shown\" \"string type\" \"heterogeneous\" " +
        s"$thin $grid ${place.replace("point3", "point")} \"float density\" [$numbers]"
    ).replace("Material \"interface\"", "Material \"none\""),
    v4("uniformgrid", s"$thin $grid $place \"float density\" [$numbers]"),
    v4(
      "rgbgrid",
      s"$grid $place \"rgb sigma_s\" [${Vector.tabulate(81)(i => i * 5 % 4).mkString(" ")}]"
    ),
    v4("cloud", s"$thin $place \"float density\" 4"),
    v4("nanovdb", s"$thin \"float scale\" 8 \"string filename\" \"volumes/smoke.nvdb\"")
  )

  private val box = "\"point p0\" [-.9 -.9 0] \"point p1\" [.9 .9 1.9]"
  private def volume(name: String, rest: String) = name -> s"Volume \"$name\" $box $thin $rest"

  val volumes: Vector[(String, String)] = Vector(
    volume("homogeneous", ""),
    volume("volumegrid", s"$grid \"float density\" [$numbers]"),
    volume("exponential", "\"float b\" 2")
  )
