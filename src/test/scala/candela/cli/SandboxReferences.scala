package candela.cli

/** A way in which a scene names a file.
  *
  * @param name   of the attempt
  * @param suffix of the scene's file: its format
  * @param file   the kind of file, by its suffix
  * @param text   of the scene; FILE stands for the file's name
  */
final case class Reference(name: String, suffix: String, file: String, text: String)

/** Every way in which scenes name files, once per statement of docs/REFERENCE.md. */
object SandboxReferences:

  private def v4(world: String, before: String = ""): String =
    s"""Film "rgb" "integer xresolution" 4 "integer yresolution" 4 "string filename" "o.exr"
       |Sampler "independent" "integer pixelsamples" 1
       |$before
       |WorldBegin
       |$world
       |Shape "sphere"
       |""".stripMargin

  private def v3(world: String, before: String = ""): String =
    s"""Film "image" "integer xresolution" 4 "integer yresolution" 4 "string filename" "o.exr"
       |Sampler "random" "integer pixelsamples" 1
       |Integrator "path"
       |$before
       |WorldBegin
       |$world
       |Shape "sphere"
       |WorldEnd
       |""".stripMargin

  private def v2(world: String): String =
    s"""Film "image" "integer xresolution" 4 "integer yresolution" 4 "string filename" "o.exr"
       |Sampler "random" "integer pixelsamples" 1
       |SurfaceIntegrator "path"
       |WorldBegin
       |$world
       |Shape "sphere"
       |WorldEnd
       |""".stripMargin

  private def xml(body: String): String =
    s"""<scene version="3.0.0"><sensor type="perspective">
       |<film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/>
       |</film></sensor>
       |$body
       |</scene>""".stripMargin

  private def bsdf(kind: String, inner: String): String =
    xml(s"""<shape type="sphere"><bsdf type="$kind">$inner</bsdf></shape>""")

  private def named(name: String): String =
    s"""<texture type="bitmap" name="$name"><string name="filename" value="FILE"/></texture>"""

  private val diffuse = "<bsdf type=\"diffuse\"/>"

  private def xmlShape(kind: String): String =
    xml(s"""<shape type="$kind"><string name="filename" value="FILE"/></shape>""")

  val pbrt: Vector[Reference] = Vector(
    Reference("Include", "pbrt", "pbrt", v4("Include \"FILE\"")),
    Reference("Include before the world", "pbrt", "pbrt", v4("", "Include \"FILE\"")),
    Reference("Include of parameters", "pbrt", "pbrt", v4("Shape \"disk\" Include \"FILE\"")),
    Reference("Import", "pbrt", "pbrt", v4("Import \"FILE\"")),
    Reference(
      "imagemap, colour",
      "pbrt",
      "png",
      v4("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "imagemap, float",
      "pbrt",
      "exr",
      v4("Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"FILE\"")
    ),
    Reference("plymesh", "pbrt", "ply", v4("Shape \"plymesh\" \"string filename\" \"FILE\"")),
    Reference(
      "plymesh, gz",
      "pbrt",
      "ply.gz",
      v4("Shape \"plymesh\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "plymesh, displaced",
      "pbrt",
      "ply",
      v4(
        "Texture \"d\" \"float\" \"constant\"\nShape \"plymesh\" \"string filename\" \"FILE\" " +
          "\"texture displacement\" \"d\""
      )
    ),
    Reference(
      "plymesh in an object",
      "pbrt",
      "ply",
      v4(
        "ObjectBegin \"o\" Shape \"plymesh\" \"string filename\" \"FILE\" ObjectEnd\n" +
          "ObjectInstance \"o\" Translate 1 0 0 ObjectInstance \"o\""
      )
    ),
    Reference(
      "normalmap",
      "pbrt",
      "png",
      v4("Material \"diffuse\" \"string normalmap\" \"FILE\"")
    ),
    Reference(
      "normalmap of a named material",
      "pbrt",
      "png",
      v4(
        "MakeNamedMaterial \"m\" \"string type\" \"dielectric\" \"string normalmap\" \"FILE\"\n" +
          "NamedMaterial \"m\""
      )
    ),
    Reference(
      "measured",
      "pbrt",
      "bsdf",
      v4("Material \"measured\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "nanovdb",
      "pbrt",
      "nvdb",
      v4(
        "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"FILE\"\n" +
          "MediumInterface \"m\" \"\"",
        "Integrator \"volpath\""
      )
    ),
    Reference(
      "infinite",
      "pbrt",
      "exr",
      v4("LightSource \"infinite\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "infinite with a portal",
      "pbrt",
      "exr",
      v4(
        "LightSource \"infinite\" \"string filename\" \"FILE\" \"point3 portal\" " +
          "[0 0 0 1 0 0 1 1 0 0 1 0]"
      )
    ),
    Reference(
      "goniometric image",
      "pbrt",
      "exr",
      v4("LightSource \"goniometric\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "goniometric emitter",
      "pbrt",
      "ies",
      v4("LightSource \"goniometric\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "projection",
      "pbrt",
      "png",
      v4("LightSource \"projection\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "image of an area light",
      "pbrt",
      "png",
      v4("AreaLightSource \"diffuse\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "lens file",
      "pbrt",
      "dat",
      v4("", "Camera \"realistic\" \"string lensfile\" \"FILE\"")
    ),
    Reference(
      "aperture",
      "pbrt",
      "png",
      v4(
        "",
        "Camera \"realistic\" \"string lensfile\" \"lens.dat\" \"string aperture\" \"FILE\""
      )
    ),
    Reference(
      "spectrum of a light",
      "pbrt",
      "spd",
      v4("LightSource \"point\" \"spectrum I\" \"FILE\"")
    ),
    Reference(
      "spectrum of an area light",
      "pbrt",
      "spd",
      v4("AreaLightSource \"diffuse\" \"spectrum L\" \"FILE\"")
    ),
    Reference(
      "spectrum of a metal",
      "pbrt",
      "spd",
      v4("Material \"conductor\" \"spectrum eta\" \"FILE\"")
    ),
    Reference(
      "spectrum of a glass",
      "pbrt",
      "spd",
      v4("Material \"dielectric\" \"spectrum eta\" \"FILE\"")
    ),
    Reference(
      "spectrum of a texture",
      "pbrt",
      "spd",
      v4("Texture \"t\" \"spectrum\" \"constant\" \"spectrum value\" \"FILE\"")
    ),
    Reference(
      "spectrum of a medium",
      "pbrt",
      "spd",
      v4(
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"spectrum sigma_a\" \"FILE\"\n" +
          "MediumInterface \"m\" \"\"",
        "Integrator \"volpath\""
      )
    ),
    Reference(
      "spectrum by Attribute",
      "pbrt",
      "spd",
      v4("Attribute \"light\" \"spectrum I\" \"FILE\"\nLightSource \"point\"")
    ),
    Reference(
      "reference image",
      "pbrt",
      "exr",
      v4("", "Option \"string msereferenceimage\" \"FILE\" Option \"string msereferenceout\" \"e\"")
    ),
    Reference("fourier", "pbrt", "bsdf", v3("Material \"fourier\" \"string bsdffile\" \"FILE\"")),
    Reference(
      "infinite of v3",
      "pbrt",
      "exr",
      v3("LightSource \"infinite\" \"string mapname\" \"FILE\"")
    ),
    Reference(
      "goniometric of v3",
      "pbrt",
      "png",
      v3("LightSource \"goniometric\" \"string mapname\" \"FILE\"")
    ),
    Reference(
      "emitter of v3",
      "pbrt",
      "ies",
      v3("LightSource \"goniometric\" \"string mapname\" \"FILE\"")
    ),
    Reference(
      "projection of v3",
      "pbrt",
      "png",
      v3("LightSource \"projection\" \"string mapname\" \"FILE\"")
    ),
    Reference(
      "measured of v2",
      "pbrt",
      "brdf",
      v2("Material \"measured\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "table of v2",
      "pbrt",
      "merl",
      v2("Material \"measured\" \"string filename\" \"FILE\"")
    ),
    Reference(
      "infinite of v2",
      "pbrt",
      "tga",
      v2("LightSource \"infinite\" \"string mapname\" \"FILE\"")
    ),
    Reference(
      "spectrum of v2",
      "pbrt",
      "spd",
      v2("Material \"metal\" \"spectrum eta\" \"FILE\"")
    )
  )

  val mitsuba: Vector[Reference] = Vector(
    Reference("include", "xml", "xml", xml("<include filename=\"FILE\"/>")),
    Reference("path", "xml", "", xml("<path value=\"FILE\"/>")),
    Reference("bitmap", "xml", "png", bsdf("diffuse", named("reflectance"))),
    Reference(
      "bitmap of a default",
      "xml",
      "png",
      xml("<default name=\"f\" value=\"FILE\"/>").replace(
        "</scene>",
        "<shape type=\"sphere\"><bsdf type=\"diffuse\">" +
          named("reflectance").replace("FILE", "$f") + "</bsdf></shape></scene>"
      )
    ),
    Reference("normalmap", "xml", "png", bsdf("normalmap", named("normalmap") + diffuse)),
    Reference("bumpmap", "xml", "png", bsdf("bumpmap", named("arbitrary") + diffuse)),
    Reference("mask", "xml", "png", bsdf("mask", named("opacity") + diffuse)),
    Reference(
      "measured",
      "xml",
      "bsdf",
      bsdf("measured", "<string name=\"filename\" value=\"FILE\"/>")
    ),
    Reference(
      "envmap",
      "xml",
      "exr",
      xml("<emitter type=\"envmap\"><string name=\"filename\" value=\"FILE\"/></emitter>")
    ),
    Reference(
      "projector",
      "xml",
      "png",
      xml(s"<emitter type=\"projector\">${named("irradiance")}</emitter>")
    ),
    Reference(
      "bitmap of an emitter",
      "xml",
      "png",
      xml(
        s"<shape type=\"rectangle\"><emitter type=\"area\">${named("radiance")}</emitter></shape>"
      )
    ),
    Reference("obj", "xml", "obj", xmlShape("obj")),
    Reference("ply", "xml", "ply", xmlShape("ply")),
    Reference("serialized", "xml", "serialized", xmlShape("serialized")),
    Reference("bsplinecurve", "xml", "txt", xmlShape("bsplinecurve")),
    Reference("linearcurve", "xml", "txt", xmlShape("linearcurve")),
    Reference(
      "spectrum",
      "xml",
      "spd",
      bsdf("diffuse", "<spectrum name=\"reflectance\" filename=\"FILE\"/>")
    ),
    Reference(
      "irregular spectrum",
      "xml",
      "spd",
      bsdf(
        "diffuse",
        "<spectrum type=\"irregular\" name=\"reflectance\"><string name=\"filename\" " +
          "value=\"FILE\"/></spectrum>"
      )
    ),
    Reference(
      "gridvolume",
      "xml",
      "vol",
      xml(
        "<shape type=\"cube\"><bsdf type=\"null\"/><medium type=\"heterogeneous\" " +
          "name=\"interior\"><volume type=\"gridvolume\" name=\"sigma_t\"><string " +
          "name=\"filename\" value=\"FILE\"/></volume></medium></shape>"
      ).replace("<sensor", "<integrator type=\"volpath\"/><sensor")
    )
  )

  val all: Vector[Reference] = pbrt ++ mitsuba.map(r => r.copy(name = s"Mitsuba's ${r.name}"))
