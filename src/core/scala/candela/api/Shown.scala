package candela.api

import candela.scenefile.SceneDescription

import java.util.Locale

/** Objects of the library as text. */
private[api] object Shown:

  /** As `Scene(scene.pbrt, 3 shapes)`. */
  def apply(kind: String, details: String*): String =
    details.filter(_.nonEmpty).mkString(s"$kind(", ", ", ")")

  def count(n: Long, what: String): String = s"$n $what${if n == 1 then "" else "s"}"

  def perPixel(samples: Int): String = s"${count(samples, "sample")} per pixel"

  /** A number, rounded. */
  def rounded(x: Double): String = String.format(Locale.ROOT, "%.3g", x)

  /** What a scene has. */
  def contents(name: String, scene: SceneDescription): Vector[String] =
    val shapes = scene.shapes.size + scene.objects.values.map(_.size).sum
    Vector(name, count(shapes, "shape")) ++
      Option.when(scene.instances.size > 0)(count(scene.instances.size, "instance")) :+
      count(scene.lights.size + scene.shapes.count(_.areaLight.nonEmpty), "light")
