package candela.growth

import candela.scenefile.Dialect

import java.nio.file.{Files, Path}

/** Many of what Mitsuba's scenes consist of. */
object GrowingMitsuba:
  import Growing.{share, spot}

  private def scene(lines: Iterable[String]): String =
    s"""<scene version="3.0.0">
       |<integrator type="volpath"/>
       |<sensor type="perspective">
       |<transform name="to_world"><lookat origin="0,-5,3" target="0,0,0" up="0,0,1"/></transform>
       |<sampler type="independent"><integer name="sample_count" value="1"/></sampler>
       |<film type="hdrfilm">
       |<integer name="width" value="4"/><integer name="height" value="4"/>
       |</film>
       |</sensor>
       |<emitter type="constant"/>
       |""".stripMargin + lines.mkString("", "\n", "\n</scene>\n")

  private def row(
      name: String,
      size: Int = 250,
      head: String = "",
      isFaulty: Boolean = false
  )(line: (Int, Int) => String) =
    Growing(s"Mitsuba: $name", Dialect.Mitsuba, size, isFaulty): (_, count) =>
      scene(head +: Vector.tabulate(count)(line(_, count)))

  private def translated(i: Int, count: Int): String =
    s"<transform name=\"to_world\">${moved(spot(i, count))}</transform>"

  private def moved(spot: String): String = s"<translate value=\"${spot.replace(' ', ',')}\"/>"

  private def tag(kind: String, plugin: String, name: String = "")(inside: String*): String =
    val attribute = if name.isEmpty then "" else s" name=\"$name\""
    s"<$kind type=\"$plugin\"$attribute>${inside.mkString}</$kind>"

  private def text(name: String, value: String) = s"<string name=\"$name\" value=\"$value\"/>"

  private def chart =
    text("filename", Path.of("scenes/textures/chart.png").toAbsolutePath.toString)

  private def ball(i: Int, count: Int, inside: String = ""): String =
    s"<shape type=\"sphere\"><float name=\"radius\" value=\".02\"/>" +
      s"${translated(i, count)}$inside</shape>"

  private def color(name: String, i: Int, count: Int): String =
    s"<rgb name=\"$name\" value=\"${share(i, count)}, .2, .3\"/>"

  private def diffuse(i: Int, count: Int, id: String = ""): String =
    s"<bsdf type=\"diffuse\"$id>${color("reflectance", i, count)}</bsdf>"

  private def curves(name: String, file: String, kind: String, size: Int = 250)(
      content: Int => Iterator[String]
  ) =
    Growing(s"Mitsuba: $name", Dialect.Mitsuba, size): (folder, count) =>
      Files.writeString(folder.resolve(file), content(count).mkString("", "\n", "\n")): Unit
      scene(Seq(s"<shape type=\"$kind\"><string name=\"filename\" value=\"$file\"/></shape>"))

  private val attributes =
    Growing("Mitsuba: colours of faces", Dialect.Mitsuba, 250): (folder, count) =>
      val header = s"ply\nformat ascii 1.0\nelement vertex ${count + 2}\nproperty float x\n" +
        s"property float y\nproperty float z\nelement face $count\n" +
        "property list uchar int vertex_indices\nproperty float r\nproperty float g\n" +
        "property float b\nend_header\n"
      val vertices = Iterator.tabulate(count + 2)(i => s"$i ${i % 2} 0")
      val faces = Iterator.tabulate(count)(i => s"3 $i ${i + 1} ${i + 2} ${share(i, count)} 0 0")
      Files.writeString(
        folder.resolve("a.ply"),
        header + (vertices ++ faces).mkString("", "\n", "\n")
      ): Unit
      val texture = s"<texture type=\"mesh_attribute\" name=\"reflectance\">" +
        s"${text("name", "face_color")}</texture>"
      val bsdf = s"<bsdf type=\"diffuse\">$texture</bsdf>"
      scene(Seq(s"<shape type=\"ply\">${text("filename", "a.ply")}$bsdf</shape>"))

  private def surface(kind: String)(inside: (Int, Int) => String) =
    row(s"bsdf $kind"): (i, n) =>
      ball(i, n, s"<bsdf type=\"$kind\">${inside(i, n)}</bsdf>")

  private def number(name: String, value: Double) = s"<float name=\"$name\" value=\"$value\"/>"

  private val surfaces = Vector(
    surface("diffuse")(color("reflectance", _, _)),
    surface("conductor")(color("specular_reflectance", _, _)),
    surface("roughconductor")((i, n) => number("alpha", share(i, n))),
    surface("dielectric")((i, n) => number("int_ior", 1 + share(i, n))),
    surface("roughdielectric")((i, n) => number("alpha", share(i, n))),
    surface("thindielectric")((i, n) => number("int_ior", 1 + share(i, n))),
    surface("plastic")(color("diffuse_reflectance", _, _)),
    surface("roughplastic")(color("diffuse_reflectance", _, _)),
    surface("pplastic")(color("diffuse_reflectance", _, _)),
    surface("principled")(color("base_color", _, _)),
    surface("principledthin")(color("base_color", _, _)),
    surface("hair")((i, n) => number("longitudinal_roughness", .1 + .8 * share(i, n))),
    surface("phong")(color("diffuse_reflectance", _, _)),
    surface("ward")(color("diffuse_reflectance", _, _)),
    surface("difftrans")(color("transmittance", _, _)),
    surface("twosided")((i, n) => diffuse(i, n)),
    surface("mask")((i, n) => number("opacity", share(i, n)) + diffuse(i, n)),
    surface("blendbsdf")((i, n) => number("weight", share(i, n)) + diffuse(i, n) + diffuse(0, n)),
    surface("bumpmap")((i, n) => "<texture type=\"checkerboard\"/>" + diffuse(i, n)),
    surface("coating")((i, n) => number("thickness", share(i, n)) + diffuse(i, n)),
    surface("null")((_, _) => "")
  )

  private def textured(kind: String)(inside: (Int, Int) => String) =
    row(s"texture $kind"): (i, n) =>
      ball(
        i,
        n,
        tag("bsdf", "diffuse")(tag("texture", kind, "reflectance")(inside(i, n)))
      )

  private def placed(kind: String, steps: String): String =
    tag("shape", "sphere")(s"<$kind name=\"to_world\">$steps</$kind>")

  private def key(time: Double, x: Double): String =
    s"<transform time=\"$time\"><translate x=\"$x\"/></transform>"

  private def triangle = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nf 1 2 3\n"

  val rows: Vector[Growing] = surfaces ++ Vector(
    attributes,
    textured("checkerboard")(color("color0", _, _)),
    row("spectra")((i, n) =>
      ball(
        i,
        n,
        tag("bsdf", "diffuse")(
          s"<spectrum name=\"reflectance\" value=\"400:${share(i, n)}, 700:.2\"/>"
        )
      )
    ),
    row("spheres")((i, n) => ball(i, n)),
    row("cubes")((i, n) => s"<shape type=\"cube\">${translated(i, n)}</shape>"),
    row("rectangles")((i, n) => s"<shape type=\"rectangle\">${translated(i, n)}</shape>"),
    row("disks")((i, n) => s"<shape type=\"disk\">${translated(i, n)}</shape>"),
    row("cylinders")((i, n) => s"<shape type=\"cylinder\">${translated(i, n)}</shape>"),
    row("materials by id"): (i, n) =>
      diffuse(i, n, s" id=\"m$i\"") + "\n" + ball(i, n, s"<ref id=\"m$i\"/>"),
    row("uses of a material", head = diffuse(0, 1, " id=\"m\""))((i, n) =>
      ball(i, n, "<ref id=\"m\"/>")
    ),
    row("textures by id"): (i, n) =>
      s"<texture type=\"checkerboard\" id=\"t$i\">${color("color0", i, n)}</texture>\n" +
        ball(i, n, s"<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t$i\"/></bsdf>"),
    row("media by id"): (i, n) =>
      s"<medium type=\"homogeneous\" id=\"m$i\">${number("scale", share(i, n))}</medium>\n" +
        ball(i, n, s"<bsdf type=\"null\"/><ref name=\"interior\" id=\"m$i\"/>"),
    row("media"): (i, n) =>
      ball(
        i,
        n,
        tag("bsdf", "null")() +
          tag("medium", "homogeneous", "interior")(number("scale", share(i, n)))
      ),
    row("aliases", head = diffuse(0, 1, " id=\"m\"")): (i, n) =>
      s"<alias id=\"m\" as=\"a$i\"/>\n" + ball(i, n, s"<ref id=\"a$i\"/>"),
    row("shapegroups"): (i, n) =>
      s"<shape type=\"shapegroup\" id=\"g$i\">${ball(i, n)}</shape>\n" +
        s"<shape type=\"instance\"><ref id=\"g$i\"/>${translated(i, n)}</shape>",
    row("shapegroups without id"): (i, n) =>
      tag("shape", "instance")(tag("shape", "shapegroup")(ball(i, n)), translated(i, n)),
    row("instances", head = s"<shape type=\"shapegroup\" id=\"g\">${ball(0, 1)}</shape>"): (i, n) =>
      s"<shape type=\"instance\"><ref id=\"g\"/>${translated(i, n)}</shape>",
    Growing("Mitsuba: shapes of a group", Dialect.Mitsuba): (_, n) =>
      scene(Vector.tabulate(n)(ball(_, n)).mkString(
        "<shape type=\"shapegroup\" id=\"g\">",
        "\n",
        "</shape>"
      ) +:
        Vector("<shape type=\"instance\"><ref id=\"g\"/></shape>")),
    Growing("Mitsuba: merged shapes", Dialect.Mitsuba): (_, n) =>
      scene(Vector(Vector.tabulate(n)(ball(
        _,
        n
      )).mkString("<shape type=\"merge\">", "\n", "</shape>"))),
    row("area emitters"): (i, n) =>
      ball(i, n, s"<emitter type=\"area\">${color("radiance", i, n)}</emitter>"),
    row("point emitters"): (i, n) =>
      s"<emitter type=\"point\">${color("intensity", i, n)}${translated(i, n)}</emitter>",
    row("spot emitters"): (i, n) =>
      s"<emitter type=\"spot\">${color("intensity", i, n)}${translated(i, n)}</emitter>",
    row("directional emitters"): (i, n) =>
      val direction = "<vector name=\"direction\" x=\"0\" y=\"0\" z=\"-1\"/>"
      tag("emitter", "directional")(color("irradiance", i, n), direction)
    ,
    row("bitmaps"): (i, n) =>
      ball(
        i,
        n,
        tag("bsdf", "diffuse")(tag("texture", "bitmap", "reflectance")(chart))
      ),
    row("defaults"): (i, n) =>
      s"<default name=\"d$i\" value=\"${share(i, n)}\"/>\n" +
        tag("shape", "sphere")(s"<float name=\"radius\" value=\"$$d$i\"/>"),
    Growing(
      "Mitsuba: definitions",
      Dialect.Mitsuba,
      defines = n => (0 until n).map(i => s"V$i" -> s"$i").toMap
    ): (_, n) =>
      scene(Vector.tabulate(n)(i =>
        s"<shape type=\"sphere\"><float name=\"radius\" value=\"$$V$i\"/></shape>"
      )),
    Growing("Mitsuba: includes", Dialect.Mitsuba, 100): (folder, n) =>
      for i <- 0 until n do
        Files.writeString(
          folder.resolve(s"$i.xml"),
          s"<scene version=\"3.0.0\">${ball(i, n)}</scene>"
        ): Unit
      scene(Vector.tabulate(n)(i => s"<include filename=\"$i.xml\"/>"))
    ,
    Growing("Mitsuba: OBJ files", Dialect.Mitsuba, 200): (folder, n) =>
      for i <- 0 until n do Files.writeString(folder.resolve(s"$i.obj"), triangle): Unit
      scene(Vector.tabulate(n)(i =>
        s"<shape type=\"obj\"><string name=\"filename\" value=\"$i.obj\"/></shape>"
      ))
    ,
    curves("triangles of an OBJ file", "a.obj", "obj")(n =>
      (0 until n + 2).iterator.map(i => s"v $i ${i % 2} ${i % 3}") ++ (1 to n).iterator.map(i =>
        s"f $i ${i + 1} ${i + 2}"
      )
    ),
    curves("B-splines", "a.txt", "bsplinecurve", 10)(n =>
      (0 until n).iterator.flatMap(i =>
        Iterator.tabulate(4)(k => s"$i ${k % 2} $k .01") ++ Iterator("")
      )
    ),
    curves("points of a B-spline", "a.txt", "bsplinecurve", 25)(n =>
      Iterator.tabulate(n)(i => s"$i ${i % 2} ${i % 3} .01")
    ),
    curves("linear curves", "a.txt", "linearcurve", 10)(n =>
      (0 until n).iterator.flatMap(i =>
        Iterator.tabulate(4)(k => s"$i ${k % 2} $k .01") ++ Iterator("")
      )
    ),
    curves("points of a linear curve", "a.txt", "linearcurve", 25)(n =>
      Iterator.tabulate(n)(i => s"$i ${i % 2} ${i % 3} .01")
    ),
    curves("hairs", "a.hair", "hair")(n =>
      (0 until n).iterator.flatMap(i =>
        Iterator.tabulate(4)(k => s"$i ${k % 2} $k") ++ Iterator("")
      )
    ),
    curves("points of a hair", "a.hair", "hair")(n =>
      Iterator.tabulate(n)(i => s"$i ${i % 2} ${i % 3}")
    ),
    Growing("Mitsuba: curves of hair BSDFs", Dialect.Mitsuba): (folder, n) =>
      val lines = (0 until n).iterator.flatMap(i =>
        Iterator.tabulate(4)(k => s"$i ${k % 2} $k .01") ++ Iterator("")
      )
      Files.writeString(folder.resolve("a.txt"), lines.mkString("", "\n", "\n")): Unit
      scene(Seq(
        tag("shape", "bsplinecurve")(text("filename", "a.txt"), tag("bsdf", "hair")())
      ))
    ,
    row("unknown ids", isFaulty = true)((i, n) => ball(i, n, s"<ref id=\"x$i\"/>")),
    row("unknown properties")((i, n) => ball(i, n, number(s"p$i", 1))),
    row("unknown types", isFaulty = true)((i, _) => s"<shape type=\"x$i\"/>"),
    row("nested transforms")((_, _) =>
      placed("transform", "<scale value=\"1.1\"/>" * 5)
    ),
    Growing("Mitsuba: steps of a transform", Dialect.Mitsuba): (_, n) =>
      scene(Seq(
        placed("transform", "<rotate z=\"1\" angle=\"1\"/>" * n)
      )),
    Growing("Mitsuba: keys of a motion", Dialect.Mitsuba): (_, n) =>
      val keys = (0 until n).map(i =>
        key(share(i, n), i)
      )
      scene(Seq(placed("animation", keys.mkString)))
    ,
    row("moving shapes"): (i, n) =>
      placed("animation", key(0, 0) + key(1, share(i, n)))
  )
