package candela.growth

import candela.scenefile.Dialect

import java.nio.file.Files

/** Many of what scene files for pbrt consist of, whatever they describe. */
object GrowingLanguage:
  import Dialect.{V2, V3, V4}
  import GrowingPbrt.{Sphere, block, files, numbers, row, scene}
  import Growing.{share, spot}

  val rows: Vector[Growing] = Vector(
    row("coordinate systems"): (i, n) =>
      block(s"Translate ${spot(i, n)}", s"CoordinateSystem \"c$i\"") + "\n" +
        block(s"CoordSysTransform \"c$i\"", Sphere),
    row("transforms")((i, n) => s"Rotate ${share(i, n)} 0 0 1\nTranslate .001 0 0"),
    row("blocks")((i, n) => block(s"Translate ${spot(i, n)}")),
    Growing("nested blocks", V4): (_, n) =>
      scene(
        V4,
        Vector.fill(n)(
          s"AttributeBegin\nTranslate .001 0 0\n$Sphere"
        ) :+ "AttributeEnd\n" * n
      ),
    Growing("nested transform blocks", V3): (_, n) =>
      scene(
        V3,
        Vector.fill(n)(
          s"TransformBegin\nTranslate .001 0 0\n$Sphere"
        ) :+ "TransformEnd\n" * n
      ),
    row("defaults of attributes")((i, n) =>
      s"Attribute \"shape\" \"float radius\" ${share(i, n)}\nShape \"sphere\""
    ),
    files("includes")((i, n) => s"$i.pbrt" -> block(s"Translate ${spot(i, n)}", Sphere))((i, _) =>
      s"Include \"$i.pbrt\""
    ),
    Growing("includes of one file", V4): (folder, n) =>
      Files.writeString(folder.resolve("a.pbrt"), s"$Sphere\n"): Unit
      scene(V4, Vector.fill(n)("Include \"a.pbrt\""))
    ,
    Growing("definitions of names", V4, defines = n => (0 until n).map(i => s"V$i" -> s"$i").toMap):
      (_, n) =>
        scene(V4, Vector.tabulate(n)(i => s"Shape \"sphere\" \"float radius\" $$V$i"))
    ,
    row("comments")((_, _) => "# a comment"),
    row("unknown parameters")((i, _) => s"$Sphere \"float p$i\" 1"),
    numbers("parameters of a statement", size = 500): n =>
      "Shape \"sphere\"\n" + (0 until n).map(i => s"\"float p$i\" $i").mkString("\n"),
    row("repeated parameters")((i, _) => s"$Sphere \"float radius\" .$i"),
    row("unknown directives", isFaulty = true)((i, _) => s"Foo$i"),
    row("unknown names", isFaulty = true)((i, _) => s"NamedMaterial \"x$i\"\n$Sphere"),
    row("unknown media", isFaulty = true)((i, _) =>
      block(s"MediumInterface \"x$i\" \"\"", Sphere)
    ),
    row("unknown textures", isFaulty = true)((i, _) =>
      block(s"Material \"diffuse\" \"texture reflectance\" \"x$i\"", Sphere)
    ),
    row("unknown objects", isFaulty = true)((i, _) => s"ObjectInstance \"x$i\""),
    row("missing files", isFaulty = true)((i, _) =>
      s"Shape \"plymesh\" \"string filename\" \"x$i.ply\""
    ),
    row("materials of older dialects", V4)((i, n) =>
      block(s"Material \"matte\" \"rgb Kd\" [${share(i, n)} 0 0]", Sphere)
    ),
    Growing("options", V4, isFaulty = true): (_, n) =>
      scene(
        V4,
        Seq(Sphere),
        Vector.tabulate(n)(i => s"Option \"float p$i\" 1").mkString("", "\n", "\n")
      ),
    Growing("statements before the world", V4, isFaulty = true): (_, n) =>
      scene(V4, Seq(Sphere), "ReverseOrientation\nCamera \"perspective\"\n" * n),
    Growing("worlds", V2): (_, n) =>
      scene(V2, Vector.fill(n)(s"$Sphere\nWorldEnd\nWorldBegin")),
    numbers("characters of a line", size = 2000)(n => s"# ${"x" * n}\n$Sphere" + " " * n),
    numbers("characters of a name", size = 2000)(n =>
      s"Texture \"${"x" * n}\" \"float\" \"constant\"\n$Sphere"
    )
  )
