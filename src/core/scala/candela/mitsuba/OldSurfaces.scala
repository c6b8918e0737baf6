package candela.mitsuba

/** Names of surfaces, textures and media that Mitsuba changed until 0.6. */
private[mitsuba] object OldSurfaces:

  private val Types: Map[(String, String), String] = Map(
    ("bsdf", "lambertian") -> "diffuse",
    ("bsdf", "microfacet") -> "roughplastic",
    ("bsdf", "mirror") -> "conductor",
    ("bsdf", "roughmetal") -> "roughconductor",
    ("bsdf", "roughglass") -> "roughdielectric",
    ("bsdf", "composite") -> "mixturebsdf",
    ("bsdf", "bump") -> "bumpmap",
    ("texture", "exrtexture") -> "bitmap",
    ("texture", "ldrtexture") -> "bitmap"
  )

  private val Names: Map[String, String] = Map(
    "alpha_b" -> "alpha",
    "alpha_x" -> "alpha_u",
    "alpha_y" -> "alpha_v",
    "bright_color" -> "color0",
    "dark_color" -> "color1",
    "density_multiplier" -> "scale",
    "size_multiplier" -> "scale"
  )

  def typeOf(tag: String, name: String): String = Types.getOrElse((tag, name), name)

  /** A name in snake case, as it is today. */
  def renamed(tag: String, name: String): String =
    if (tag == "volume" || tag == "ref") && name == "density" then "sigma_t"
    else Names.getOrElse(name, name)

  /** What an element needs, too, to mean the same today. */
  def added(e: Element): Vector[Element] =
    if e.tag != "bsdf" || !e("type").contains("mirror") then Vector.empty
    else
      val chrome = Map("name" -> "material", "value" -> "Cr")
      Vector(Element("string", chrome, Vector.empty, e.pos))
