package candela.cli.commands

import candela.base.Figures
import candela.diagnostics.{Code, Problem, SceneError}
import candela.cli.terminal.{ExitCode, Printer}
import candela.geometry.Ray
import candela.math.Vec3
import candela.render.RenderPlan

/** `candela render --pixelmaterial x,y`: prints what the centre of a pixel shows. */
private[cli] object PixelMaterial:
  def run(plan: RenderPlan, x: Int, y: Int, out: Printer): ExitCode =
    if x >= plan.width || y >= plan.height then
      val size = s"${plan.width}x${plan.height}"
      throw SceneError(Problem.general(
        Code.OptionMisfit,
        s"--pixelmaterial $x,$y is outside the image: $size"
      ))
    val layers = plan.layers.getOrElse:
      throw SceneError(Problem.general(
        Code.OptionMisfit,
        "--pixelmaterial needs an integrator with camera samples"
      ))
    val ray = Ray()
    ray.weight = 1f
    for shutter <- plan.shutter do ray.time = shutter.at(0.5f)
    plan.camera.generate(x + 0.5f, y + 0.5f, 0.5f, 0.5f, ray)
    val surface = layers.surface.copy()
    if ray.weight != 0f then surface.trace(ray)
    out.println(s"pixel ($x, $y)")
    if ray.weight == 0f || !surface.isThere then out.println("nothing but the environment")
    else
      val names = layers.names
      val point = surface.point
      val facts = Vector(
        "material" -> names.materials.lift(point.material).getOrElse("unknown"),
        "shape" -> names.objects.lift(surface.scene.objectIndex(surface.hit)).getOrElse("unknown"),
        "point" -> formatted(point.p.toVec3),
        "normal" -> formatted(point.geometricNormal.toVec3),
        "shading normal" -> formatted(point.frame.n),
        "uv" -> s"${number(point.u)} ${number(point.v)}",
        "albedo" -> Vector(
          surface.albedo.r,
          surface.albedo.g,
          surface.albedo.b
        ).map(number).mkString(" "),
        "light" -> (if point.areaLight < 0 then "none" else s"number ${point.areaLight}")
      )
      for (what, value) <- facts do out.println(s"  ${what.padTo(16, ' ')}$value")
    out.flush()
    ExitCode.Done

  private def formatted(v: Vec3): String = Vector(v.x, v.y, v.z).map(number).mkString(" ")
  private def number(x: Float): String = Figures.scientific(x)
