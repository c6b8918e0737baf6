package candela.stability

import java.nio.{ByteBuffer, ByteOrder}
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.build.SceneBuilder
import candela.image.Image
import candela.math.Position
import candela.mitsuba.MitsubaScene
import candela.render.Renderer
import candela.scenefile.{Dialect, SceneDescription}
import candela.settings.RenderSettings
import candela.testing.SceneTexts

/** Scenes at georeferenced coordinates render as at the origin. */
class FarSuite extends AnyFunSuite:
  private val far = Vector(
    Position(1e5, -3e4, 2e4),
    Position(500000, 4200000, 100),
    Position(-1e7, 2e6, 4e5)
  )

  private def render(scene: SceneDescription): Image =
    val (plan, _) = SceneBuilder.build(scene, RenderSettings())
    Renderer.render(plan, threads = 1).image(plan.development)

  private def render(text: String, dialect: Dialect, folder: Path = Path.of("")): Image =
    render(SceneTexts.parse(text, dialect, folder))

  /** The mean absolute difference, over the mean of the first. */
  private def apart(a: Image, b: Image): Double =
    a.data.lazyZip(b.data).map((x, y) => Math.abs(x - y).toDouble).sum /
      a.data.map(_.toDouble).sum

  /** The same random numbers: only paths that rounding sends elsewhere differ. That is one in a
    * hundred at coordinates of some tens; moved meshes of Floats differ in most pixels.
    */
  private val Slack = 0.03

  private def assertSame(near: Image, moved: Image, where: Any): Unit =
    assert(near.data.forall(_.isFinite) && near.data.exists(_ > 0.01f), "a picture")
    val off = apart(near, moved)
    assert(off < Slack, s"$where: $off"): Unit

  for scene <- FarScenes.all do
    test(s"${scene.words} (${scene.dialect}) render far from the origin as at it"):
      val near = render(scene.text(Position.Origin), scene.dialect)
      for p <- far do assertSame(near, render(scene.text(p), scene.dialect), p)

  private def origin(text: String): Option[String] =
    SceneTexts.plan(text, Dialect.V4).features.find(_._1 == "origin").map(_._2)

  private val meshes = FarObjects.shapes.head

  test("a scene at the origin, or of the size of its distance, is built around the origin"):
    assert(origin(meshes.text(Position.Origin)).isEmpty)
    assert(origin(meshes.text(Position(200, -100, 1000))).isEmpty)
    val place = "Translate 20000.0 0.0 0.0"
    val wide = meshes.text(Position(20000, 0, 0)).replace(place, s"$place Scale 2000 2000 2000")
    assert(origin(wide).isEmpty)

  test("a far scene is built around a point that --explain tells, with the reason"):
    val told = origin(meshes.text(far(1))).get
    assert(told.startsWith("499968 4200000 128, because at the camera, 4199995 from"), told)
    assert(told.contains("Floats are 0.50 apart"), told)

  test("all frames of a flight through a far scene are built around one point"):
    val p = far(1)
    val frames = Vector.tabulate(8): i =>
      val eye = s"LookAt ${p.x - 3 + i} ${p.y - 5 - i} ${p.z + 1.6}"
      origin(meshes.text(p).replaceFirst("LookAt \\S+ \\S+ \\S+", eye)).get.takeWhile(_ != ',')
    assert(frames.distinct.size == 1, frames.distinct)

  test("positions of AOVs are the world's"):
    val p = far(1)
    val film = "Film \"gbuffer\" \"string coordinatesystem\" \"world\""
    val image = render(meshes.text(p).replace("Film \"rgb\"", film), Dialect.V4)
    def channel(name: String) = image(10, 8, image.channelNames.indexOf(name)).toDouble
    // The ball's surface, rounded to a Float
    assert(Math.abs(channel("P.X") - p.x) < 1 && Math.abs(channel("P.Y") - p.y) <= 1.5)
    assert(Math.abs(channel("P.Z") - p.z) < 1)

  private def inFolder[A](use: Path => A): A =
    val folder = Files.createTempDirectory("candela-far")
    try use(folder)
    finally
      Files.list(folder).forEach(Files.delete(_))
      Files.delete(folder)

  /** A tent of four faces around a point. */
  private def tent(p: Position): Vector[Vector[Double]] =
    Vector(
      Vector(-.8, -.7, -.3),
      Vector(.9, -.8, -.2),
      Vector(.7, .8, -.3),
      Vector(-.9, .6, -.1),
      Vector(.05, .03, .9)
    ).map(q => Vector(p.x + q(0), p.y + q(1), p.z + q(2)))
  private val faces = Vector(Vector(0, 1, 4), Vector(1, 2, 4), Vector(2, 3, 4), Vector(3, 0, 4))

  private def ply(p: Position, isAscii: Boolean): Array[Byte] =
    val kind = if isAscii then "ascii" else "binary_little_endian"
    val header =
      s"ply\nformat $kind 1.0\nelement vertex 5\nproperty double z\nproperty double y\n" +
        "property double x\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    val vertices = tent(p).map(_.reverse)
    if isAscii then
      (header + (vertices.map(_.mkString(" ")) ++ faces.map(_.mkString(
        "3 ",
        " ",
        ""
      ))).mkString("\n"))
        .getBytes("US-ASCII")
    else
      val out = ByteBuffer.allocate(header.length + 5 * 24 + 4 * 13).order(ByteOrder.LITTLE_ENDIAN)
      out.put(header.getBytes("US-ASCII"))
      vertices.flatten.foreach(out.putDouble)
      for f <- faces do
        out.put(3.toByte)
        f.foreach(out.putInt)
      out.array

  for isAscii <- Seq(true, false) do
    test(
      s"vertices of PLY files keep the digits of doubles (${if isAscii then "text" else "binary"})"
    ):
      inFolder: folder =>
        def image(p: Position) =
          Files.write(folder.resolve("tent.ply"), ply(p, isAscii))
          val scene = FarScene(
            "",
            Dialect.V4,
            _ =>
              "LightSource \"distant\" \"point3 from\" [1 -2 3] \"point3 to\" [0 0 0]\n" +
                "Shape \"plymesh\" \"string filename\" \"tent.ply\""
          )
          render(scene.text(p), Dialect.V4, folder)
        val near = image(Position.Origin)
        for p <- far do assertSame(near, image(p), p)

  private def obj(p: Position): String =
    tent(p).map(_.mkString(
      "v ",
      " ",
      "\n"
    )).mkString + faces.map(_.map(_ + 1).mkString("f ", " ", "\n")).mkString

  private def xml(p: Position, shape: String): String =
    s"""<scene version="3.0.0">
       |<sensor type="perspective"><float name="fov" value="40"/>
       |<transform name="to_world"><lookat origin="${p.x},${p.y - 5},${p.z + 1.6}"
       |  target="${p.x},${p.y},${p.z + .1}" up="0,0,1"/></transform>
       |<film type="hdrfilm"><integer name="width" value="20"/><integer name="height" value="16"/>
       |<rfilter type="box"/></film>
       |<sampler type="independent"><integer name="sample_count" value="8"/></sampler></sensor>
       |<integrator type="path"/>
       |<emitter type="point"><rgb name="intensity" value="30"/>
       |<point name="position" x="${p.x + 1}" y="${p.y - 3}" z="${p.z + 3}"/></emitter>
       |$shape
       |</scene>""".stripMargin

  private def moved(p: Position) =
    s"""<transform name="to_world"><translate x="${p.x}" y="${p.y}" z="${p.z}"/></transform>"""

  private val shapes: Vector[(String, Position => String)] = Vector(
    "an OBJ file of far vertices" -> (_ =>
      """<shape type="obj"><string name="filename" value="tent.obj"/></shape>"""
    ),
    "a PLY file of far vertices" -> (_ =>
      """<shape type="ply"><string name="filename" value="tent.ply"/></shape>"""
    ),
    "moved cubes, rectangles, spheres and cylinders" -> (p =>
      Seq("cube", "rectangle", "sphere", "cylinder")
        .map(t =>
          s"""<shape type="$t">${moved(Position(
              p.x,
              p.y,
              p.z - (if t == "cube" then 1 else 0)
            ))}</shape>"""
        ).mkString
    ),
    "tubes" -> (p =>
      s"""<shape type="bsplinecurve"><string name="filename" value="curve.txt"/>${moved(
          p
        )}</shape>"""
    )
  )

  for (words, shape) <- shapes do
    test(s"$words of Mitsuba's render far from the origin as at it"):
      inFolder: folder =>
        def image(p: Position) =
          Files.writeString(folder.resolve("tent.obj"), obj(p))
          Files.write(folder.resolve("tent.ply"), ply(p, isAscii = false))
          Files.writeString(
            folder.resolve("curve.txt"),
            "-1 0 -1 .2\n-.5 0 0 .2\n.5 0 .5 .2\n1 0 -.5 .2\n2 0 0 .2\n"
          )
          val file = Files.writeString(folder.resolve("scene.xml"), xml(p, shape(p)))
          render(MitsubaScene.readable(file, Map.empty, keepGoing = false))
        val near = image(Position.Origin)
        for p <- far do assertSame(near, image(p), p)
