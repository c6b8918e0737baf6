package candela.gallery

/** Curves that hang from a ball. */
private object HairExample:
  private val Strands = 500

  val text: String =
    s"""Material "diffuse" "rgb reflectance" [.3 .2 .12]
       |Translate 0 0 1.1
       |Shape "sphere" "float radius" .5
       |Material "hair" "float eumelanin" .3
       |${Vector.tabulate(Strands)(strand).mkString("\n")}""".stripMargin

  /** Roots are in a spiral, at the golden angle from each other, down to the ears. */
  private def strand(i: Int): String =
    val turn = i * 2.399963
    val height = 1 - 1.15 * (i + 0.5) / Strands
    val across = Math.sqrt(1 - height * height)
    val wave = 0.06 * Math.sin(1.7 * i)
    def point(outward: Double, z: Double) =
      Vector(outward * Math.cos(turn), outward * Math.sin(turn), z)
    val points = Vector(
      point(0.5 * across, 0.5 * height),
      point(0.8 * across, 0.8 * height),
      point(0.75 + 0.1 * across + wave, 0.8 * height - 0.25),
      point(0.7 + 0.15 * across - wave, 0.5 * height - 0.85 + wave)
    ).flatten.map(v => Math.round(v * 1000) / 1000.0)
    s"Shape \"curve\" \"point3 P\" [${points.mkString(" ")}] " +
      "\"float width0\" .045 \"float width1\" .02 \"float splitdepth\" 5"
