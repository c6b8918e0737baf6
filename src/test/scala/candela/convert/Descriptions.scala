package candela.convert

import java.io.StringWriter
import java.nio.file.Path

import candela.scenefile.*

/** Descriptions as text and back, and what two of them differ in. */
object Descriptions:

  def text(scene: SceneDescription): String =
    val out = StringWriter()
    SceneText.write(scene, out)
    out.toString

  def read(text: String, folder: Path, dialect: Option[Dialect] = None): SceneDescription =
    Parser.parseText("written.pbrt", text, folder, dialect)

  /** All that a description says, one line for each statement, without places in files. */
  def facts(s: SceneDescription): Vector[String] =
    Vector(
      s"dialect ${s.dialect}",
      s"camera ${s.camera.map(fact)} ${matrix(s.worldToCamera)} in ${s.cameraMedium}",
      s"film ${s.film.map(fact)}",
      s"sampler ${s.sampler.map(fact)}",
      s"filter ${s.filter.map(fact)}",
      s"integrator ${s.integrator.map(fact)}",
      s"accelerator ${s.accelerator.map(fact)}",
      s"renderer ${s.renderer.map(fact)}",
      s"volume integrator ${s.volumeIntegrator.map(fact)}",
      s"options ${s.options.map(fact)}",
      s"times ${s.transformTimes}"
    ) ++
      s.textures.map(t =>
        s"texture ${t.name} ${t.valueType} ${fact(t.texture)} ${matrix(t.textureToWorld)}"
      ) ++
      s.namedMaterials.map((name, d) => s"material $name ${fact(d)}") ++
      s.media.map(m => s"medium ${m.name} ${fact(m.medium)} ${matrix(m.mediumToWorld)}") ++
      (s.lights ++ s.volumes).map(l =>
        s"light ${fact(l.light)} ${matrix(l.lightToWorld)} in ${l.medium}"
      ) ++
      s.objects.toVector.flatMap((name, shapes) => s"object $name" +: shapes.map(fact)) ++
      s.shapes.map(fact) ++
      s.instances.indices.map: k =>
        val i = s.instances(k)
        val toWorld =
          if s.instances.isPlain(k) then Statements.rounded(i.instanceToWorld.start).mkString(" ")
          else matrix(i.instanceToWorld)
        s"instance ${i.name} $toWorld"

  private def fact(s: ShapeDescription): String =
    val material = s.material match
      case MaterialRef.Default => "default"
      case MaterialRef.Inline(d) => fact(d)
      case MaterialRef.Named(name, _) => s"named $name"
    s"shape ${fact(s.shape)} ${matrix(s.objectToWorld)} reversed ${s.reverseOrientation} " +
      s"material $material light ${s.areaLight.map(fact)} in ${s.insideMedium}|${s.outsideMedium}"

  private def fact(d: Declaration): String =
    val params = d.params.map(fact).sorted.mkString("; ")
    s"${d.category} ${d.name} in ${d.colorSpace} ($params)"

  private def fact(p: Param): String =
    val numbers = p.floats.toVector.map(java.lang.Float.floatToRawIntBits)
    s"${p.paramType} ${p.name} $numbers ${p.ints.toVector} ${p.bools} ${p.strings} " +
      s"${p.isDefault} ${p.colorSpace}"

  private def matrix(t: AnimatedTransform): String =
    if t.isAnimated then s"${t.start} ${t.end}" else t.start.toString
