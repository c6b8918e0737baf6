package candela.fuzz

import java.nio.file.Files

import candela.cli.AnyCommand

/** Long chains of what names each other, and nodes that many name: paths through them are
  * exponentially many.
  */
final class Chains(place: Place) extends Attempts:
  import Chains.*
  import place.random

  private val folder = Files.createDirectories(place.folder.resolve("chains"))

  private def one[A](all: IndexedSeq[A]): A = all(random.nextInt(all.size))

  /** Of any magnitude; seldom of the largest, which take the time of hundreds of others. */
  private def upTo(most: Int): Int =
    val usual = if random.nextInt(100) == 0 then most else Math.min(most, Usual)
    Math.pow(usual, random.nextDouble()).toInt

  /** The number of a node that node `i` names: mostly the one before. */
  private def before(i: Int): Int =
    random.nextInt(8) match
      case 0 => random.nextInt(i)
      case 1 if random.nextInt(200) == 0 => i + random.nextInt(3) // itself, or none that exists yet
      case _ => i - 1

  private def lines(count: Int)(line: Int => String): String = (1 to count).map(line).mkString("\n")

  private def number: String = random.nextFloat().toString

  private def mixes(count: Int): String =
    "MakeNamedMaterial \"m0\" \"string type\" \"diffuse\"\n" + lines(count)(i =>
      s"MakeNamedMaterial \"m$i\" \"string type\" \"mix\" \"string materials\" " +
        s"[ \"m${before(i)}\" \"m${before(i)}\" ] \"float amount\" $number"
    ) + s"\nNamedMaterial \"m$count\""

  private def oldMixes(count: Int): String =
    "MakeNamedMaterial \"m0\" \"string type\" \"matte\"\n" + lines(count)(i =>
      s"MakeNamedMaterial \"m$i\" \"string type\" \"mix\" \"string namedmaterial1\" " +
        s"\"m${before(i)}\" \"string namedmaterial2\" \"m${before(i)}\" \"rgb amount\" " +
        s"[ $number $number $number ]"
    ) + s"\nNamedMaterial \"m$count\""

  private def textures(count: Int, kinds: Vector[(String, String, String)], last: String): String =
    def texture(i: Int) =
      val (kind, a, b) = one(kinds)
      s"Texture \"t$i\" \"$last\" \"$kind\" \"texture $a\" \"t${before(i)}\" " +
        s"\"texture $b\" \"t${before(i)}\""
    val first = one(Vector("constant", "checkerboard", "fbm", "bilerp"))
    s"Texture \"t0\" \"$last\" \"$first\"\n${lines(count)(texture)}\n"

  private val newKinds = Vector(
    ("scale", "tex", "scale"),
    ("mix", "tex1", "tex2"),
    ("checkerboard", "tex1", "tex2"),
    ("dots", "inside", "outside"),
    ("directionmix", "tex1", "tex2")
  )
  private val oldKinds = Vector(
    ("scale", "tex1", "tex2"),
    ("mix", "tex1", "tex2"),
    ("checkerboard", "tex1", "tex2"),
    ("dots", "inside", "outside")
  )

  private def objects(count: Int): String =
    "ObjectBegin \"o0\" Shape \"sphere\" ObjectEnd\n" + lines(count)(i =>
      s"ObjectBegin \"o$i\" Shape \"disk\" ObjectInstance \"o${before(i)}\" Translate 1 0 0 " +
        s"ObjectInstance \"o${before(i)}\" ObjectEnd"
    ) + s"\nObjectInstance \"o$count\""

  private def media(count: Int): String =
    "CoordinateSystem \"c0\" MakeNamedMedium \"m0\" \"string type\" \"homogeneous\"\n" +
      lines(count)(i =>
        s"MakeNamedMedium \"m$i\" \"string type\" \"homogeneous\" MediumInterface \"m$i\" " +
          s"\"m${before(i)}\" CoordinateSystem \"c$i\" CoordSysTransform \"c${before(i)}\""
      )

  private def nested(count: Int): String =
    val pair = one(Vector("Attribute", "Transform"))
    s"${pair}Begin " * count + "Shape \"disk\" " + s"${pair}End " * (count - random.nextInt(2))

  /** Files that include each other; the first is included by the scene. */
  private def files(suffix: String, depth: Int)(text: (String => String, Int) => String): Unit =
    // How often files are read in all: the bounds of includes take seconds to be reached
    val most: Double = random.nextInt(5000) match
      case 0 => 1e9
      case n => if n < 50 then 3000.0 else Usual.toDouble
    var reached = 1.0
    for i <- 0 to depth do
      val fan = 1 + random.nextInt(3)
      val count = if reached * fan * (depth - i) > most then 1 else fan
      reached *= count
      def next(statement: String => String) =
        if i == depth then "" else statement(s"part-${i + 1}.$suffix") * count
      val whole = text(s => next(n => s.replace("FILE", n)), i)
      val _ = Files.writeString(folder.resolve(s"part-$i.$suffix"), whole)

  private def includes(): String =
    files("pbrt", upTo(300)): (next, _) =>
      "Shape \"sphere\"\n" + next(one(Vector("Include \"FILE\"\n", "Import \"FILE\"\n")))
    "Include \"part-0.pbrt\""

  private def xmlIncludes(): String =
    files("xml", upTo(40)): (next, i) =>
      val value = "$v" * (1 + random.nextInt(3))
      s"<scene version='3.0.0'><default name='v' value='$value$i'/>" +
        next("<include filename='FILE'/>") + "</scene>"
    "<include filename='part-0.xml'/>"

  private def defaults(count: Int): String =
    "<default name='v0' value='1'/>" + lines(count)(i =>
      s"<default name='v$i' value='${s"$$v${before(i)}" * (1 + random.nextInt(4))}'/>"
    ) + s"<shape type='sphere'><float name='radius' value='$$v$count'/></shape>"

  private val surfaces = Vector("twosided", "mask", "bumpmap", "normalmap", "blendbsdf")

  private def open(kind: String): String =
    val weight = if kind == "blendbsdf" then "<float name='weight' value='0.3'/>" else ""
    s"<bsdf type='$kind'>$weight"

  private def nestedSurfaces(count: Int): String =
    val kinds = Vector.fill(count)(one(surfaces))
    val inner = kinds.map: kind =>
      open(kind) + (if kind == "blendbsdf" then "<bsdf type='diffuse'/>" else "")
    "<shape type='sphere'>" + inner.mkString + "<bsdf type='diffuse'/>" + "</bsdf>" * count +
      "</shape>"

  private def sharedSurfaces(count: Int): String =
    def surface(i: Int) =
      val kind = one(surfaces)
      val second = if kind == "blendbsdf" then s"<ref id='b${before(i)}'/>" else ""
      open(kind).replace("<bsdf ", s"<bsdf id='b$i' ") + s"<ref id='b${before(i)}'/>$second</bsdf>"
    s"<bsdf type='diffuse' id='b0'/>${lines(count)(surface)}" +
      s"<shape type='sphere'><ref id='b$count'/></shape>"

  private def sharedTextures(count: Int): String =
    "<texture type='checkerboard' id='t0'/>" + lines(count)(i =>
      s"<texture type='checkerboard' id='t$i'><ref name='color0' id='t${before(i)}'/>" +
        s"<ref name='color1' id='t${before(i)}'/></texture>"
    ) + s"<shape type='sphere'><bsdf type='diffuse'><ref name='reflectance' id='t$count'/></bsdf>" +
      "</shape>"

  private def groups(count: Int): String =
    "<shape type='shapegroup' id='g0'><shape type='sphere'/></shape>" + lines(count)(i =>
      s"<shape type='shapegroup' id='g$i'>" +
        s"<shape type='instance'><ref id='g${before(i)}'/></shape>" * 2 + "</shape>"
    ) + s"<shape type='instance'><ref id='g$count'/></shape>"

  private def nestedElements(count: Int): String =
    val kind = one(Vector("shape type='merge'", "shape type='shapegroup'", "texture type='bitmap'"))
    s"<$kind>" * count + s"</${kind.takeWhile(_ != ' ')}>" * count

  private def aliases(count: Int): String =
    "<bsdf type='diffuse' id='b0'/>" +
      lines(count)(i => s"<alias id='b${before(i)}' as='b$i'/>") +
      s"<shape type='sphere'><ref id='b$count'/></shape>"

  private def scene(): (String, String) =
    def v4(world: String) = ("pbrt", SmallScene.v4("path", world))
    def v3(world: String) = ("pbrt", SmallScene.v3("path", world))
    def xml(body: String) = ("xml", SmallScene.xml(body))
    val color = "Material \"diffuse\" \"texture reflectance\" \"tN\""
    random.nextInt(17) match
      case 0 => v4(mixes(upTo(8000)))
      case 1 => v3(oldMixes(upTo(8000)))
      case 2 =>
        val n = upTo(8000)
        v4(textures(n, newKinds, "spectrum") + color.replace("tN", s"t$n"))
      case 3 =>
        val n = upTo(8000)
        v3(textures(n, oldKinds, "color") + s"Material \"matte\" \"texture Kd\" \"t$n\"")
      case 4 =>
        val n = upTo(8000)
        val kinds = newKinds.filter(_._1 != "directionmix")
        v4(textures(n, kinds, "float") + s"Material \"diffuse\" \"texture displacement\" \"t$n\"")
      case 5 => v4(objects(upTo(3000)))
      case 6 => v3(objects(upTo(3000)))
      case 7 => v4(media(upTo(3000)))
      case 8 => if random.nextBoolean() then v4(nested(upTo(8000))) else v3(nested(upTo(8000)))
      case 9 => v4(includes())
      case 10 => xml(xmlIncludes())
      case 11 => xml(defaults(upTo(60)))
      case 12 => xml(nestedSurfaces(upTo(3000)))
      case 13 => xml(sharedSurfaces(upTo(3000)))
      case 14 => xml(sharedTextures(upTo(3000)))
      case 15 => xml(if random.nextBoolean() then groups(upTo(1000)) else aliases(upTo(3000)))
      case _ => xml(nestedElements(upTo(3000)))

  def next(): Attempt =
    val (suffix, text) = scene()
    val file = folder.resolve(s"self.$suffix")
    val converted = Vector("--outfile", folder.resolve("o.pbrt").toString)
    val command = one(Vector(
      Vector("check"),
      Vector("render", "--quiet", "--outfile", folder.resolve("o.exr").toString),
      "convert" +: converted,
      Vector("convert", "--to", one(Vector("v3", "v4"))) ++ converted
    ))
    val sandbox = if random.nextInt(4) == 0 then Vector("--sandbox") else Vector.empty
    val words = (command ++ sandbox) :+ file.toString
    val written = Files.writeString(file, text)
    Attempt(words.mkString(" "), Vector(written), () => AnyCommand.wrong(words))

private object Chains:
  /** Nodes of all but a few chains, at most. */
  private val Usual = 200
