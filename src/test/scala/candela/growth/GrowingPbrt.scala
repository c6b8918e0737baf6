package candela.growth

import candela.scenefile.Dialect
import candela.testing.{NanoVdb, VdbGrid}

import java.awt.image.BufferedImage
import java.nio.file.{Files, Path}
import javax.imageio.ImageIO

/** Many of what scene files for pbrt consist of, beside statements of each type. */
object GrowingPbrt:
  import Dialect.{V2, V3, V4}
  import Growing.{share, spot}

  def diffuse(dialect: Dialect): String = if dialect == V4 then "diffuse" else "matte"

  private def film(dialect: Dialect): String = if dialect == V4 then "rgb" else "image"

  /** A scene with these lines in its world. */
  def scene(dialect: Dialect, lines: Iterable[String], head: String = ""): String =
    val integrator =
      if dialect == V2 then "SurfaceIntegrator \"path\"" else "Integrator \"volpath\""
    val end = if dialect == V4 then "" else "WorldEnd\n"
    s"""Film "${film(dialect)}" "integer xresolution" 4 "integer yresolution" 4
       |Sampler "halton" "integer pixelsamples" 1
       |$integrator
       |LookAt 0 -5 3  0 0 0  0 0 1
       |Camera "perspective"
       |${head}WorldBegin
       |LightSource "point"
       |Shape "sphere"
       |""".stripMargin + lines.mkString("", "\n", "\n") + end

  private[growth] val Sphere = "Shape \"sphere\" \"float radius\" .02"
  private val Square = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " +
    "\"point3 P\" [0 0 0 .1 0 0 .1 .1 0 0 .1 0] \"point2 uv\" [0 0 1 0 1 1 0 1]"
  private val Patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 .1 0 0 0 .1 0 .1 .1 0]"
  private val Object = s"ObjectBegin \"o\"\n$Square\nObjectEnd\n"

  private[growth] def block(lines: String*): String =
    lines.mkString("AttributeBegin\n", "\n", "\nAttributeEnd")

  /** Something moves from a spot. */
  private def moving(i: Int, count: Int): String =
    s"Translate ${spot(i, count)}\nActiveTransform EndTime\nTranslate .1 0 .1\n" +
      s"Rotate ${90 * share(i, count)} 0 0 1\nActiveTransform All"

  /** A row of statements, each made from its number, of all. */
  private[growth] def row(
      name: String,
      dialect: Dialect = V4,
      size: Int = 250,
      head: String = "",
      isFaulty: Boolean = false
  )(
      line: (Int, Int) => String
  ): Growing =
    Growing(name, dialect, size, isFaulty): (_, count) =>
      scene(dialect, head +: Vector.tabulate(count)(line(_, count)))

  /** One statement of many numbers. */
  private[growth] def numbers(name: String, dialect: Dialect = V4, size: Int = 1000)(
      statement: Int => String
  ): Growing = Growing(name, dialect, size)((_, count) => scene(dialect, Seq(statement(count))))

  private def list(count: Int)(number: Int => Any): String =
    (0 until count).map(number).mkString("[", " ", "]")

  /** A statement that has a file of its own. */
  private[growth] def files(name: String, size: Int = 100)(content: (Int, Int) => (String, String))(
      line: (Int, Int) => String
  ): Growing =
    Growing(name, V4, size): (folder, count) =>
      for i <- 0 until count do
        val (file, text) = content(i, count)
        Files.writeString(folder.resolve(file), text): Unit
      scene(V4, Vector.tabulate(count)(line(_, count)))

  private def picture(folder: Path, name: String, width: Int, height: Int): Unit =
    val image = BufferedImage(width, height, BufferedImage.TYPE_3BYTE_BGR)
    for y <- 0 until height; x <- 0 until width do
      image.setRGB(x, y, (x * 7919 + y * 104_729) * 31 & 0xffffff | 0x404040)
    ImageIO.write(image, "png", folder.resolve(name).toFile): Unit

  /** A scene about one picture of so many pixels. */
  private def pixels(name: String, size: Int = 64 * 64)(line: String): Growing =
    Growing(name, V4, size): (folder, count) =>
      picture(folder, "a.png", 64, count / 64)
      scene(V4, Seq(line))

  /** Statements about one picture. */
  private def pictured(name: String)(line: (Int, Int) => String): Growing =
    Growing(name, V4, 100): (folder, count) =>
      picture(folder, "a.png", 32, 32)
      scene(V4, Vector.tabulate(count)(line(_, count)))

  private def named(i: Int, count: Int): String =
    s"MakeNamedMaterial \"m$i\" \"string type\" \"diffuse\" " +
      s"\"rgb reflectance\" [${share(i, count)} 0 1]"

  private val objects = Vector(
    row("moving shapes")((i, n) => block(moving(i, n), Sphere)),
    row("moving shapes", V3)((i, n) => block(moving(i, n), Sphere)),
    row("moving shapes", V2)((i, n) => block(moving(i, n), Sphere)),
    row("moving shapes, a material each", size = 1000): (i, n) =>
      block(named(i, n), s"NamedMaterial \"m$i\"", moving(i, n), Sphere),
    row("moving meshes")((i, n) => block(moving(i, n), Square)),
    row("moving instances", head = Object)((i, n) => block(moving(i, n), "ObjectInstance \"o\"")),
    row("moving instances", V3, head = Object)((i, n) =>
      block(moving(i, n), "ObjectInstance \"o\"")
    ),
    row("instances", head = Object): (i, n) =>
      block(s"Translate ${spot(i, n)}", "ObjectInstance \"o\""),
    row("objects with an instance"): (i, n) =>
      s"ObjectBegin \"o$i\"\n$Square\nObjectEnd\n" +
        block(s"Translate ${spot(i, n)}", s"ObjectInstance \"o$i\""),
    row("objects with two instances"): (i, n) =>
      s"ObjectBegin \"o$i\"\n$Sphere\nObjectEnd\n" +
        block(s"Translate ${spot(i, n)}", s"ObjectInstance \"o$i\"", s"ObjectInstance \"o$i\""),
    row("unused objects")((i, _) => s"ObjectBegin \"o$i\"\n$Square\nObjectEnd"),
    Growing("shapes of an object", V4): (_, n) =>
      val shapes = Vector.tabulate(n)(i => block(s"Translate ${spot(i, n)}", Sphere))
      val lines = "ObjectBegin \"o\"" +: shapes :+ "ObjectEnd\nObjectInstance \"o\""
      scene(V4, lines :+ block("Translate 1 1 1", "ObjectInstance \"o\""))
    ,
    row("objects of one name", isFaulty = true)((_, _) =>
      s"ObjectBegin \"o\"\n$Square\nObjectEnd\nObjectInstance \"o\""
    )
  )

  private val geometry = Vector(
    numbers("triangles"): n =>
      s"Shape \"trianglemesh\" \"integer indices\" ${list(3 * n)(identity)} " +
        s"\"point3 P\" ${list(3 * n)(i => s"${spot(i / 3, n)} ${i % 2}".drop(1).dropRight(2))}",
    numbers("triangles that emit"): n =>
      s"AreaLightSource \"diffuse\"\nShape \"trianglemesh\" " +
        s"\"integer indices\" ${list(3 * n)(identity)} \"point3 P\" ${list(9 * n)(i =>
            (i * 7 % 101) * .01
          )}",
    numbers("patches"): n =>
      s"Shape \"bilinearmesh\" \"integer indices\" ${list(4 * n)(identity)} " +
        s"\"point3 P\" ${list(12 * n)(i => (i * 7 % 101) * .01)}",
    numbers("points of a height field", V3): n =>
      s"Shape \"heightfield\" \"integer nu\" 20 \"integer nv\" ${n / 20} " +
        s"\"float Pz\" ${list(n)(_ % 7)}",
    numbers("points of a NURBS surface", V3): n =>
      val rows = n / 10
      s"Shape \"nurbs\" \"integer nu\" 10 \"integer nv\" $rows \"integer uorder\" 2 " +
        s"\"integer vorder\" 2 \"float uknots\" ${list(12)(identity)} " +
        s"\"float vknots\" ${list(rows + 2)(identity)} " +
        s"\"point3 P\" ${list(n)(i => s"${i % 10} ${i / 10} ${i % 3}")}"
    ,
    numbers("triangles that are subdivided", size = 200): n =>
      s"Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" " +
        s"${list(n)(i => s"${i + i % 2} ${i + 1 - i % 2} ${i + 2}")} " +
        s"\"point3 P\" ${list(n + 2)(i => s"${i % 2} $i ${i % 3}")}",
    numbers("segments of a curve"): n =>
      s"Shape \"curve\" \"string basis\" \"bspline\" \"float width\" .01 " +
        s"\"point3 P\" ${list(n + 3)(i => s"$i ${i % 2} ${i % 3}")}",
    numbers("fan of a vertex"): n =>
      s"Shape \"loopsubdiv\" \"integer levels\" 1 \"integer indices\" " +
        s"${list(n)(i => s"0 ${i + 1} ${i + 2}")} \"point3 P\" ${list(n + 2)(i =>
            if i == 0 then "0 0 1"
            else s"${Math.cos(6.28 * i / (n + 3))} ${Math.sin(6.28 * i / (n + 3))} 0"
          )}",
    Growing("faces of a PLY file", V4, 1000): (folder, n) =>
      val faces = (0 until n).map(i => s"4 $i ${i + 1} ${i + 2} ${i + 3}")
      val points = (0 until n + 3).map(i => s"${i % 2} ${i * .01} ${i % 3}")
      val header = s"ply\nformat ascii 1.0\nelement vertex ${n + 3}\nproperty float x\n" +
        s"property float y\nproperty float z\nelement face $n\n" +
        "property list uchar int vertex_indices\nend_header"
      val lines = header +: (points ++ faces)
      Files.writeString(folder.resolve("a.ply"), lines.mkString("", "\n", "\n")): Unit
      scene(V4, Seq("Shape \"plymesh\" \"string filename\" \"a.ply\""))
    ,
    files("PLY files")((i, _) => s"$i.ply" -> triangle(i)): (i, n) =>
      block(s"Translate ${spot(i, n)}", s"Shape \"plymesh\" \"string filename\" \"$i.ply\""),
    row("spheres far from the origin"): (i, n) =>
      block("Translate 1e7 0 0", s"Translate ${spot(i, n)}", Sphere),
    row("shapes in one place")((_, _) => Sphere),
    row("nested spheres")((i, n) => s"Shape \"sphere\" \"float radius\" ${share(i, n)}"),
    row("alpha textures", head = "Texture \"a\" \"float\" \"checkerboard\""): (i, n) =>
      block(s"Translate ${spot(i, n)}", s"$Square \"texture alpha\" \"a\"")
  )

  private def triangle(i: Int): String =
    s"""ply
       |format ascii 1.0
       |element vertex 3
       |property float x
       |property float y
       |property float z
       |element face 1
       |property list uchar int vertex_indices
       |end_header
       |0 0 0
       |.1 0 0
       |0 .1 ${i * .001}
       |3 0 1 2
       |""".stripMargin

  private val appearance = Vector(
    row("materials in named use")((i, n) =>
      s"${named(i, n)}\n" + block(s"NamedMaterial \"m$i\"", s"Translate ${spot(i, n)}", Sphere)
    ),
    row("materials without use")(named),
    row("materials of one name", isFaulty = true): (i, n) =>
      s"${named(i, n).replace(s"m$i", "m")}\n" + block("NamedMaterial \"m\"", Sphere),
    row("mixtures of two", head = named(0, 1) + "\n" + named(1, 2)): (i, n) =>
      block(
        s"Material \"mix\" \"string materials\" [\"m0\" \"m1\"] \"float amount\" ${share(i, n)}",
        s"Translate ${spot(i, n)}",
        Sphere
      ),
    row("mixtures of mixtures", head = named(0, 1), size = 125): (i, _) =>
      s"MakeNamedMaterial \"m${i + 1}\" \"string type\" \"mix\" " +
        s"\"string materials\" [\"m$i\" \"m0\"]",
    row("textures of textures", head = "Texture \"t0\" \"spectrum\" \"checkerboard\""): (i, n) =>
      s"Texture \"t${i + 1}\" \"spectrum\" \"scale\" \"texture tex\" \"t${i % 7}\" " +
        s"\"float scale\" ${share(i, n)}\n" +
        block(
          s"Material \"diffuse\" \"texture reflectance\" \"t${i + 1}\"",
          s"Translate ${spot(i, n)}",
          Sphere
        ),
    row(
      "a chain of textures",
      size = 50,
      head = "Texture \"t0\" \"spectrum\" \"checkerboard\""
    ): (i, n) =>
      s"Texture \"t${i + 1}\" \"spectrum\" \"scale\" \"texture tex\" \"t$i\" " +
        s"\"float scale\" ${share(i, n)}",
    row("textures of one name", isFaulty = true): (i, n) =>
      s"Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [${share(i, n)} 0 1]\n" +
        block("Material \"diffuse\" \"texture reflectance\" \"t\"", Sphere),
    row("textures with a place"): (i, n) =>
      block(
        s"Translate ${spot(i, n)}",
        s"Texture \"t$i\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3"
      ) +
        "\n" + block(
          s"Material \"diffuse\" \"texture reflectance\" \"t$i\"",
          s"Translate ${spot(i, n)}",
          Sphere
        ),
    row("spectra"): (i, n) =>
      block(
        s"Material \"diffuse\" \"spectrum reflectance\" [400 ${share(i, n)} 700 .2]",
        s"Translate ${spot(i, n)}",
        Sphere
      ),
    files("spectra in files")((i, n) => s"$i.spd" -> s"400 ${share(i, n)}\n700 .3\n"): (i, n) =>
      block(
        s"Material \"diffuse\" \"spectrum reflectance\" \"$i.spd\"",
        s"Translate ${spot(i, n)}",
        Sphere
      ),
    numbers("numbers of a spectrum"): n =>
      s"Material \"diffuse\" \"spectrum reflectance\" ${list(n)(i =>
          s"${400 + 300.0 * i / n} ${share(i, n)}"
        )}\n$Sphere",
    row("black bodies"): (i, n) =>
      block(s"LightSource \"point\" \"blackbody I\" ${2000 + 4000 * share(i, n)}"),
    pictured("uses of a picture"): (i, n) =>
      s"Texture \"t$i\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" " +
        s"\"float scale\" ${share(i, n)}\n" +
        block(
          s"Material \"diffuse\" \"texture reflectance\" \"t$i\"",
          s"Translate ${spot(i, n)}",
          Square
        ),
    Growing("pictures", V4, 100): (folder, n) =>
      for i <- 0 until n do picture(folder, s"$i.png", 8, 8 + i % 3)
      scene(
        V4,
        Vector.tabulate(n): i =>
          s"Texture \"t$i\" \"spectrum\" \"imagemap\" \"string filename\" \"$i.png\"\n" +
            block(
              s"Material \"diffuse\" \"texture reflectance\" \"t$i\"",
              s"Translate ${spot(i, n)}",
              Square
            )
      )
    ,
    pixels("pixels of a texture")(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\"\n" +
        s"Material \"diffuse\" \"texture reflectance\" \"t\"\n$Square"
    )
  )

  private val lighting = Vector(
    row("area lights"): (i, n) =>
      block(
        s"AreaLightSource \"diffuse\" \"rgb L\" [1 2 ${share(i, n)}]",
        s"Translate ${spot(i, n)}",
        Sphere
      ),
    row("equal area lights"): (i, n) =>
      block("AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]", s"Translate ${spot(i, n)}", Sphere),
    pictured("area lights with a picture"): (i, n) =>
      block(
        s"AreaLightSource \"diffuse\" \"string filename\" \"a.png\"",
        s"Translate ${spot(i, n)}",
        Patch
      ),
    pictured("goniometric lights with a picture"): (i, n) =>
      block(
        s"Translate ${spot(i, n)}",
        "LightSource \"goniometric\" \"string filename\" \"a.png\""
      ),
    pictured("environments of a picture"): (i, n) =>
      block(
        s"Rotate ${share(i, n)} 0 0 1",
        "LightSource \"infinite\" \"string filename\" \"a.png\""
      ),
    Growing("pixels of an environment", V4, 64 * 64): (folder, n) =>
      val side = Math.sqrt(n).round.toInt
      picture(folder, "a.png", side, side)
      scene(V4, Seq("LightSource \"infinite\" \"string filename\" \"a.png\""))
    ,
    Growing("projectors of a picture", V4, 16): (folder, n) =>
      picture(folder, "a.png", 1024, n)
      scene(V4, Vector.fill(n)("LightSource \"projection\" \"string filename\" \"a.png\""))
    ,
    pixels("pixels of a projector")("LightSource \"projection\" \"string filename\" \"a.png\""),
    row("lights that emit textures", V3, head = "Texture \"a\" \"float\" \"checkerboard\""):
      (i, n) =>
        block(
          "AreaLightSource \"diffuse\"",
          s"Translate ${spot(i, n)}",
          s"$Square \"texture alpha\" \"a\""
        )
  )

  private def medium(name: String, i: Int, count: Int): String =
    s"MakeNamedMedium \"$name\" \"string type\" \"homogeneous\" " +
      s"\"rgb sigma_s\" [${share(i, count)} 1 1]"

  private val mediums = Vector(
    row("media of many shapes", head = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\""):
      (i, n) =>
        block(
          "MediumInterface \"m\" \"\"",
          "Material \"interface\"",
          s"Translate ${spot(i, n)}",
          Sphere
        )
    ,
    row("media within each other"): (i, n) =>
      val outside = if i + 1 < n then s"m${i + 1}" else ""
      s"${medium(s"m$i", i, n)}\n" +
        block(
          s"MediumInterface \"m$i\" \"$outside\"",
          "Material \"interface\"",
          s"Shape \"sphere\" \"float radius\" ${share(i, n)}"
        )
    ,
    row("media of one name", isFaulty = true): (i, n) =>
      s"${medium("m", i, n)}\n" +
        block(
          "MediumInterface \"m\" \"\"",
          "Material \"interface\"",
          s"Translate ${spot(i, n)}",
          Sphere
        ),
    row("media without use"): (i, n) =>
      medium(s"m$i", i, n),
    row("lights in media"): (i, n) =>
      s"MakeNamedMedium \"m$i\" \"string type\" \"homogeneous\"\n" +
        block(s"MediumInterface \"\" \"m$i\"", s"Translate ${spot(i, n)}", "LightSource \"point\""),
    Growing("media of a file", V4, 50): (folder, n) =>
      val grid = VdbGrid("density", Vector.tabulate(n)(i => (8 * i, 0, 0) -> 1f).toMap)
      Files.write(folder.resolve("a.nvdb"), NanoVdb.file(Seq(grid))): Unit
      def medium(i: Int) =
        s"MakeNamedMedium \"m$i\" \"string type\" \"nanovdb\" \"string filename\" \"a.nvdb\""
      scene(V4, Vector.tabulate(n)(medium))
    ,
    numbers("numbers of a grid"): n =>
      "MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" " +
        "\"integer nx\" 10 \"integer ny\" 10 " +
        s"\"integer nz\" ${n / 10} \"float density\" ${list(100 * (n / 10))(_ % 5)}\n" +
        block("MediumInterface \"m\" \"\"", "Material \"interface\"", Sphere)
  )

  val rows: Vector[Growing] = objects ++ geometry ++ appearance ++ lighting ++ mediums
