package candela.gallery

import candela.gallery.Example.Unseen

/** Textures, and materials of a sphere, with defaults if these are distinguishable. */
private object SurfaceExamples:
  val materials: Vector[(String, String)] = Vector(
    "matte" -> "Material \"matte\" \"rgb Kd\" [.6 .3 .2]",
    "translucent" -> "Material \"translucent\" \"rgb Kd\" [.3 .5 .2]",
    "diffuse" -> "Material \"diffuse\" \"rgb reflectance\" [.6 .3 .2]",
    "diffusetransmission" ->
      """Material "diffusetransmission" "rgb reflectance" [.2 .3 .1]
        |  "rgb transmittance" [.4 .6 .2]""".stripMargin,
    "plastic" -> "Material \"plastic\" \"rgb Kd\" [.1 .25 .5]",
    "substrate" -> "Material \"substrate\" \"rgb Kd\" [.5 .1 .1]",
    "uber" -> "Material \"uber\" \"rgb Kd\" [.15 .3 .15] \"rgb Kr\" [.1 .1 .1]",
    "disney" -> "Material \"disney\" \"rgb color\" [.5 .2 .4] \"float clearcoat\" 1",
    "coateddiffuse" -> "Material \"coateddiffuse\" \"rgb reflectance\" [.15 .3 .5]",
    "shinymetal" -> "Material \"shinymetal\" \"rgb Ks\" [.45 .3 .1] \"rgb Kr\" [.35 .25 .1]",
    "conductor" -> "Material \"conductor\" \"float roughness\" .1",
    "subsurface" -> "Material \"subsurface\" \"float scale\" 4",
    "kdsubsurface" -> "Material \"kdsubsurface\" \"rgb Kd\" [.7 .45 .3] \"rgb mfp\" [.2 .1 .05]",
    "hair" -> HairExample.text,
    "measured/v2" -> "Material \"measured\" \"string filename\" \"geometry/orange-paint.brdf\"",
    "mix" ->
      """MakeNamedMaterial "one" "string type" "diffuse" "rgb reflectance" [.7 .3 .1]
        |MakeNamedMaterial "two" "string type" "conductor"
        |Material "mix" "string materials" ["one" "two"]""".stripMargin
  )

  private val foreign = "input files are produced by other programs"
  private val clear = "invisible: rays pass through unscattered"
  val unseen: Map[String, Example] = Map(
    "gltf" -> Unseen("of glTF models"),
    "principled" -> Unseen("of Mitsuba's scenes"),
    "roughplastic" -> Unseen("of Mitsuba's scenes"),
    "twosided" -> Unseen("of Mitsuba's scenes"),
    "coating" -> Unseen("of Mitsuba's scenes"),
    "phong" -> Unseen("of Mitsuba's scenes"),
    "roughdiffuse" -> Unseen("of Mitsuba's scenes"),
    "scatteringlayer" -> Unseen("of Mitsuba's scenes"),
    "ward" -> Unseen("of Mitsuba's scenes"),
    "nested" -> Unseen("of Mitsuba's scenes"),
    "measured/v4" -> Unseen(foreign),
    "fourier" -> Unseen(foreign),
    "" -> Unseen(clear),
    "none" -> Unseen(clear),
    "interface" -> Unseen(clear)
  )

  private val image =
    "\"string filename\" \"textures/chart.png\" \"float uscale\" 2 \"float vscale\" 2"
  private val many = "\"float uscale\" 6 \"float vscale\" 6"
  private val solid = "\"integer octaves\" 6"

  /** Float textures, which blend two colours. */
  val floats: Vector[(String, String)] = Vector(
    "constant" -> "\"float value\" .3",
    "scale" -> "\"float scale\" .6 \"float tex\" .8",
    "mix" -> "\"float amount\" .3",
    "directionmix" -> "\"vector3 dir\" [0 0 1]",
    "bilerp" -> "",
    "checkerboard" -> many,
    "dots" -> many,
    "imagemap" -> image,
    "fbm" -> solid,
    "wrinkled" -> solid,
    "windy" -> ""
  )

  /** Spectrum textures. */
  val colors: Vector[(String, String)] = Vector(
    "constant" -> "\"rgb value\" [.2 .5 .4]",
    "scale" -> "\"rgb tex\" [.8 .5 .2] \"float scale\" .7",
    "mix" -> "\"rgb tex1\" [.8 .2 .1] \"rgb tex2\" [.1 .2 .8]",
    "directionmix" -> "\"rgb tex1\" [.8 .2 .1] \"rgb tex2\" [.1 .2 .8] \"vector3 dir\" [0 0 1]",
    "bilerp" ->
      "\"rgb v00\" [.8 .1 .1] \"rgb v01\" [.1 .6 .1] \"rgb v10\" [.1 .2 .8] \"rgb v11\" [.9 .8 .2]",
    "checkerboard" -> s"$many \"rgb tex1\" [.8 .6 .2] \"rgb tex2\" [.1 .2 .5]",
    "dots" -> s"$many \"rgb inside\" [.8 .2 .1] \"rgb outside\" [.8 .8 .7]",
    "imagemap" -> image,
    "fbm" -> solid,
    "wrinkled" -> solid,
    "windy" -> "",
    "marble" -> "\"float scale\" 4 \"float variation\" .4",
    "uv" -> ""
  )
