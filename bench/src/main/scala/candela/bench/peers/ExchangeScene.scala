package candela.bench.peers

import candela.diagnostics.SourcePos
import candela.io.SceneFolder
import candela.convert.SideFiles
import candela.math.{Transform, Vec3}
import candela.scenefile.*

import java.nio.charset.StandardCharsets.UTF_8

import scala.collection.mutable

/** What a scene has that not all programs can render, in words. */
final class Inexpressible(val reasons: Vector[String])

/** Writes a scene of pbrt-v4's statements as a file of Mitsuba's, in the few elements that the
  * scripts for Cycles and LuxCore read, too: emitters by red, green and blue, triangles and whole
  * spheres in world space, and surfaces whose formulas the programs share.
  *
  * Colours are multiplied by red, green and blue in all programs that read it.
  */
final class ExchangeScene(scene: SceneDescription, files: SideFiles):
  private val reasons = mutable.LinkedHashSet.empty[String]
  private val values = ExchangeValues(reason => reasons += reason)
  private val materials = ExchangeMaterials(scene, files, values)
  private val meshes = ExchangeMeshes(files, values)

  /** The text, or what the file can't express.
    *
    * @param depth number of surfaces at which a path scatters, at most
    */
  def text(depth: Int): Either[Inexpressible, String] =
    val shapes = placed.map(shape)
    val depths = s"""<integer name="max_depth" value="${depth + 1}"/>"""
    val parts = Vector(
      s"""  <integrator type="path">$depths</integrator>""",
      sensor
    ) ++ materials.elements ++ shapes ++ lights
    for m <- scene.media.headOption do values.reject(s"medium `${m.name}`")
    if reasons.nonEmpty then Left(Inexpressible(reasons.toVector))
    else
      val start = "<scene version=\"3.0.0\">\n  <default name=\"spp\" value=\"16\"/>\n" +
        "  <default name=\"seed\" value=\"0\"/>\n"
      Right(parts.mkString(start, "\n", "\n</scene>\n"))

  /** All shapes in the world, those of instances included. */
  private def placed: Vector[ShapeDescription] =
    scene.shapes ++ scene.instances.flatMap: use =>
      if use.instanceToWorld.isAnimated then values.reject("motion")
      val to = use.instanceToWorld.start
      scene.objects.getOrElse(use.name, Vector.empty).map: s =>
        if s.areaLight.isDefined then values.reject("area lights on instances")
        val toWorld = to * staticTransform(s.objectToWorld)
        s.copy(objectToWorld = AnimatedTransform(toWorld, toWorld))

  private def staticTransform(t: AnimatedTransform): Transform =
    if t.isAnimated then values.reject("motion")
    t.start

  private def shape(s: ShapeDescription): String =
    val toWorld = staticTransform(s.objectToWorld)
    if s.shape.param("alpha").nonEmpty then values.reject("alpha cutouts")
    if s.oneSided then values.reject("surfaces that are black from behind")
    val material = materials.of(s.material)
    val emitter = s.areaLight.fold("")(areaLight)
    val inner = s"""<ref id="${material.id}"/>$emitter"""
    meshes.element(s.shape, toWorld, s.reverseOrientation, material.mapping, inner)

  private def areaLight(d: Declaration): String =
    values.rejectOthers(d, "L", "scale", "twosided")
    if d.param("twosided").exists(_.bools.contains(true)) then
      values.reject("two-sided area lights")
    s"""<emitter type="area">${values.rgbElement("radiance", values.light(d, "L"))}</emitter>"""

  private def lights: Vector[String] = scene.lights.map: l =>
    val d = l.light
    val toWorld = staticTransform(l.lightToWorld)
    def point(name: String, default: Vec3): Vec3 =
      d.param(name).map(_.floats) match
        case Some(Array(x, y, z)) => Vec3(x, y, z)
        case _ => default
    d.name match
      case "point" =>
        values.rejectOthers(d, "I", "scale", "from")
        val p = toWorld.point(point("from", Vec3.Zero))
        s"""  <emitter type="point"><point name="position" x="${p.x}" y="${p.y}" z="${p.z}"/>""" +
          values.rgbElement("intensity", values.light(d, "I")) + "</emitter>"
      case "distant" =>
        values.rejectOthers(d, "L", "scale", "from", "to")
        val w = toWorld.vector(point("to", Vec3.Z) - point("from", Vec3.Zero)).normalized
        s"""  <emitter type="directional"><vector name="direction" x="${w.x}" y="${w.y}" """ +
          s"""z="${w.z}"/>${values.rgbElement("irradiance", values.light(d, "L"))}</emitter>"""
      case "infinite" => environment(d, toWorld)
      case other =>
        values.reject(s"light \"$other\"")
        ""

  private def environment(d: Declaration, toWorld: Transform): String =
    values.rejectOthers(d, "L", "scale", "filename")
    d.param("filename") match
      case None =>
        val radiance = values.rgbElement("radiance", values.light(d, "L"))
        s"""  <emitter type="constant">$radiance</emitter>"""
      case Some(p) =>
        val name = ExchangeImages.sky(d, p, files, values)
        val scale = d.param("scale").flatMap(_.floats.headOption).getOrElse(1f)
        // pbrt's poles are ±z, Mitsuba's ±y, and pbrt's azimuth begins at x, Mitsuba's at −z
        val axes = Transform.fromRows(Vector(0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, 0, 1)).get
        s"""  <emitter type="envmap"><string name="filename" value="$name"/>""" +
          s"""<float name="scale" value="$scale"/>${matrix(toWorld * axes.inverse)}</emitter>"""

  private def sensor: String =
    val camera = scene.camera.getOrElse(ExchangeScene.plain("Camera", "perspective"))
    val film = scene.film.getOrElse(ExchangeScene.plain("Film", "rgb"))
    if camera.name != "perspective" then values.reject(s"camera \"${camera.name}\"")
    values.rejectOthers(camera, "fov", "lensradius", "focaldistance", "shutteropen", "shutterclose")
    values.rejectOthers(film, "xresolution", "yresolution", "filename", "diagonal", "savefp16")
    def number(d: Declaration, name: String, default: Float) =
      d.param(name).flatMap(_.floats.headOption).getOrElse(default)
    def count(name: String, default: Int) =
      film.param(name).flatMap(_.ints.headOption).getOrElse(default)
    val cameraToWorld = staticTransform(scene.worldToCamera).inverse
    val lens = number(camera, "lensradius", 0f)
    val focus = number(camera, "focaldistance", 1e6f)
    val thin =
      if lens > 0f then
        s"""<float name="aperture_radius" value="$lens"/>""" +
          s"""<float name="focus_distance" value="$focus"/>"""
      else ""
    // Mitsuba's x points left, pbrt's right
    val toWorld = cameraToWorld * Transform.scale(-1, 1, 1).get
    val far = 2 * meshes.reach(cameraToWorld.point(Vec3.Zero))
    s"""  <sensor type="${if lens > 0f then "thinlens" else "perspective"}">
       |    <string name="fov_axis" value="smaller"/>
       |    <float name="fov" value="${number(camera, "fov", 90f)}"/>$thin
       |    <float name="near_clip" value="${far * 1e-5f}"/><float name="far_clip" value="$far"/>
       |    ${matrix(toWorld)}
       |    <sampler type="independent"><integer name="sample_count" value="$$spp"/>
       |      <integer name="seed" value="$$seed"/></sampler>
       |    <film type="hdrfilm"><integer name="width" value="${count("xresolution", 1280)}"/>
       |      <integer name="height" value="${count("yresolution", 720)}"/>
       |      <string name="pixel_format" value="rgb"/>
       |      <string name="component_format" value="float32"/><rfilter type="box"/></film>
       |  </sensor>""".stripMargin

  private def matrix(t: Transform): String =
    s"""<transform name="to_world"><matrix value="${t.m.mkString(" ")}"/></transform>"""

object ExchangeScene:
  private[peers] def plain(category: String, name: String): Declaration =
    Declaration(category, name, Vector.empty, SourcePos.Nowhere, SceneFolder.Nowhere)

  /** Writes the file `scene.xml` and what belongs to it.
    *
    * @return what it can't express, if anything
    */
  def write(scene: SceneDescription, depth: Int, files: SideFiles): Option[Inexpressible] =
    ExchangeScene(scene, files).text(depth) match
      case Left(reasons) => Some(reasons)
      case Right(text) =>
        candela.io.WholeFile.write(files.folder.resolve("scene.xml"), text.getBytes(UTF_8))
        None
