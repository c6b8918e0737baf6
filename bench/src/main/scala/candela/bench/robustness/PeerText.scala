package candela.bench.robustness

/** A [[PeerScene]] in the language of pbrt-v3. */
object PeerText:

  def v3(s: PeerScene): String =
    val v = s.view
    val camera = v.width.fold(s"\"perspective\" \"float fov\" ${v.fov}"): w =>
      s"\"orthographic\" \"float screenwindow\" [${-w} $w ${-w} $w]"
    val head = Vector(
      s"LookAt ${v.from.words}  ${v.to.words}  ${v.up.words}",
      s"Camera $camera",
      s"Film \"image\" \"integer xresolution\" ${s.side} \"integer yresolution\" ${s.side} " +
        "\"string filename\" \"x.exr\"",
      "PixelFilter \"box\"",
      s"Sampler \"random\" \"integer pixelsamples\" ${s.spp}",
      s"Integrator \"path\" \"integer maxdepth\" ${s.depth}",
      "WorldBegin"
    )
    val sky = Option.when(s.sky > 0)(s"LightSource \"infinite\" \"rgb L\" ${gray(s.sky)}")
    val sun = s.sun.map: from =>
      s"LightSource \"distant\" \"rgb L\" ${gray(Math.PI)} \"point from\" [${from.words}] " +
        "\"point to\" [0 0 0]"
    (head ++ sky ++ sun ++ s.things.flatMap(shapeText) :+ "WorldEnd").mkString("", "\n", "\n")

  private def gray(x: Double): String = s"[$x $x $x]"

  private def shapeText(form: Form, surface: Surface): Vector[String] =
    val material = surface match
      case Surface.Matte(albedo) => Vector(s"Material \"matte\" \"rgb Kd\" ${gray(albedo)}")
      case Surface.Mirror => Vector("Material \"mirror\" \"rgb Kr\" [1 1 1]")
      case Surface.Glass(index) => Vector(s"Material \"glass\" \"float index\" $index")
      case Surface.Light(radiance) => Vector(
          "Material \"matte\" \"rgb Kd\" [0 0 0]",
          s"AreaLightSource \"diffuse\" \"rgb L\" ${gray(radiance)} \"bool twosided\" \"true\""
        )
    val shape = form match
      case Form.Ball(c, radius) =>
        Vector(s"Translate ${c.words}", s"Shape \"sphere\" \"float radius\" $radius")
      case Form.Tube(radius, low, high) => Vector(
          s"Shape \"cylinder\" \"float radius\" $radius \"float zmin\" $low \"float zmax\" $high"
        )
      case Form.Facets(corners, triangles, normals) =>
        val n =
          if normals.isEmpty then "" else s" \"normal N\" [${normals.map(_.words).mkString("  ")}]"
        Vector(
          s"Shape \"trianglemesh\" \"integer indices\" [${triangles.mkString(" ")}] " +
            s"\"point P\" [${corners.map(_.words).mkString("  ")}]$n"
        )
    ("AttributeBegin" +: material) ++ shape :+ "AttributeEnd"

/** A [[PeerScene]] in Mitsuba's language, with a mesh file beside it for each mesh. */
object PeerXml:

  /** The scene, and the contents of the files that it names. */
  def of(s: PeerScene): (String, Map[String, String]) =
    val meshes = s.things.zipWithIndex.collect:
      case ((mesh: Form.Facets, _), k) => s"mesh-$k.obj" -> obj(mesh)
    val things = s.things.zipWithIndex.map { case ((form, surface), k) =>
      shapeXml(form, surface, k)
    }
    val sky = Option.when(s.sky > 0):
      s"""<emitter type="constant"><rgb name="radiance" value="${s.sky}"/></emitter>"""
    val sun = s.sun.map: from =>
      s"""<emitter type="directional"><vector name="direction" value="${(from * -1).listed}"/>
         |<rgb name="irradiance" value="${Math.PI}"/></emitter>""".stripMargin
    val lines = Vector(
      """<scene version="3.0.0">""",
      s"""<integrator type="path"><integer name="max_depth" value="${s.depth + 1}"/>""",
      """<integer name="rr_depth" value="2000"/></integrator>""",
      sensor(s)
    ) ++ sky ++ sun ++ things :+ "</scene>"
    (lines.mkString("", "\n", "\n"), meshes.toMap)

  private def sensor(s: PeerScene): String =
    val v = s.view
    val reach = Math.sqrt(Seq(v.from.x - v.to.x, v.from.y - v.to.y, v.from.z - v.to.z)
      .map(d => d * d).sum)
    val (kind, width) = v.width.fold(("perspective", 1.0))(w => ("orthographic", w))
    val fov =
      if v.width.isDefined then "" else s"""<float name="fov" value="${v.fov}"/>"""
    s"""<sensor type="$kind">$fov
       |<float name="near_clip" value="${1e-3 * reach}"/>
       |<float name="far_clip" value="${1e4 * reach}"/>
       |<transform name="to_world"><scale x="${-width}" y="$width"/>
       |<lookat origin="${v.from.listed}" target="${v.to.listed}" up="${v.up.listed}"/></transform>
       |<sampler type="independent"><integer name="sample_count" value="${s.spp}"/></sampler>
       |<film type="hdrfilm"><integer name="width" value="${s.side}"/>
       |<integer name="height" value="${s.side}"/><string name="pixel_format" value="rgb"/>
       |<string name="component_format" value="float32"/><rfilter type="box"/></film>
       |</sensor>""".stripMargin

  private def shapeXml(form: Form, surface: Surface, k: Int): String =
    def matte(albedo: Double) =
      s"""<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="$albedo"/>
         |</bsdf></bsdf>""".stripMargin
    val material = surface match
      case Surface.Matte(albedo) => matte(albedo)
      case Surface.Mirror =>
        """<bsdf type="conductor"><string name="material" value="none"/></bsdf>"""
      case Surface.Glass(index) =>
        s"""<bsdf type="dielectric"><float name="int_ior" value="$index"/>
           |<float name="ext_ior" value="1"/></bsdf>""".stripMargin
      case Surface.Light(radiance) => matte(0) +
          s"""<emitter type="area"><rgb name="radiance" value="$radiance"/></emitter>"""
    val shape = form match
      case Form.Ball(c, radius) =>
        s"""<shape type="sphere"><point name="center" x="${c.x}" y="${c.y}" z="${c.z}"/>
           |<float name="radius" value="$radius"/>""".stripMargin
      case Form.Tube(radius, low, high) =>
        s"""<shape type="cylinder"><point name="p0" x="0" y="0" z="$low"/>
           |<point name="p1" x="0" y="0" z="$high"/>
           |<float name="radius" value="$radius"/>""".stripMargin
      case Form.Facets(_, _, normals) =>
        s"""<shape type="obj"><string name="filename" value="mesh-$k.obj"/>
           |<boolean name="face_normals" value="${normals.isEmpty}"/>""".stripMargin
    s"$shape$material</shape>"

  private def obj(mesh: Form.Facets): String =
    val hasNormals = mesh.normals.nonEmpty
    val corners = mesh.corners.map(p => s"v ${p.words}")
    val normals = mesh.normals.map(n => s"vn ${n.words}")
    val faces = mesh.triangles.grouped(3).map: t =>
      t.map(i => if hasNormals then s"${i + 1}//${i + 1}" else s"${i + 1}").mkString("f ", " ", "")
    (corners ++ normals ++ faces).mkString("", "\n", "\n")
