package candela.mitsuba

import candela.build.SceneBuilder
import candela.diagnostics.Severity
import candela.image.Image
import candela.render.Renderer
import candela.settings.RenderSettings

/** Layers of integrators "aov". Values are Mitsuba 3.9.1's (`scalar_rgb`), means of 1,024 samples.
  */
final class AovsSuite extends MitsubaPictures:

  private val things =
    """<emitter type="constant"/><shape type="sphere"><transform name="to_world">
      <rotate z="1" angle="30"/><rotate x="1" angle="50"/><scale value="1.2"/></transform>
      <bsdf type="roughplastic"><rgb name="diffuse_reflectance" value=".5 .3 .2"/></bsdf></shape>
      <shape type="rectangle"><transform name="to_world"><scale value="2"/>
      <rotate x="1" angle="-60"/><translate y="-.5"/></transform><bsdf type="null"/></shape>"""

  private def sensor = view(40, 256, from = "1,2,5").replaceFirst("<integrator.*?</integrator>", "")

  private def aov(aovs: String, within: String = "<integrator type=\"path\"/>"): String =
    s"<integrator type=\"aov\"><string name=\"aovs\" value=\"$aovs\"/>$within</integrator>"

  private def image(integrator: String): Image = using(integrator + sensor + things): scene =>
    assert(scene.errors.isEmpty, scene.errors)
    val plan = SceneBuilder.build(scene, RenderSettings())._1
    Renderer.render(plan, threads = 1).image(plan.development)

  private def means(image: Image): Map[String, Double] =
    image.channelNames.zipWithIndex.map: (name, c) =>
      val values = image.data.indices.drop(c).by(image.channels).map(i => image.data(i).toDouble)
      name -> values.sum / values.size
    .toMap

  private def problems(integrator: String): Vector[(Severity, String)] =
    using(integrator + sensor + things): scene =>
      (scene.errors ++ scene.warnings).map(p => (p.severity, p.message))

  test("layers have the names and the values of Mitsuba"):
    val found = means(image(aov(
      "al:albedo, dd.y:depth,pp:position,st:uv,gn:geo_normal,nn:sh_normal,du:dp_du,dv:dp_dv",
      "<integrator type=\"path\" name=\"img\"/>"
    )))
    val expected = Map[String, Double](
      "R" -> 0.8108,
      "G" -> 0.7408,
      "B" -> 0.7058,
      "al.R" -> 0.1992,
      "al.G" -> 0.1195,
      "al.B" -> 0.0797,
      "dd.y.T" -> 3.9903,
      "du.X" -> -0.6546,
      "du.Y" -> 0.2768,
      "du.Z" -> 0.3299,
      "dv.X" -> 0.0536,
      "dv.Y" -> 1.9080,
      "dv.Z" -> -1.9103,
      "gn.X" -> 0.0571,
      "gn.Y" -> 0.4326,
      "gn.Z" -> 0.4638,
      "img.R" -> 0.8108,
      "img.G" -> 0.7408,
      "img.B" -> 0.7058,
      "img.A" -> 1.0000,
      "nn.X" -> 0.0571,
      "nn.Y" -> 0.4326,
      "nn.Z" -> 0.4638,
      "pp.X" -> 0.1414,
      "pp.Y" -> -0.0737,
      "pp.Z" -> 0.3692,
      "st.U" -> 0.2891,
      "st.V" -> 0.3408
    )
    assert(found.keySet == expected.keySet)
    // Derivatives are up to 7 long
    for (name, value) <- expected do
      val noise = if name.startsWith("d") then 0.03 else 0.01
      assert(Math.abs(found(name) - value) < noise, s"$name: ${found(name)}, not $value")

  test("an integrator without a name has that of its place"):
    val names = image(aov("a:depth")).channelNames
    assert(names == Image.RgbNames ++ Vector("R", "G", "B", "A").map("_arg_0." + _) :+ "a.T")

  test("layers within layers have the names of both"):
    val within = s"<integrator type=\"aov\" name=\"b\"><string name=\"aovs\" value=\"c:uv\"/>" +
      "<integrator type=\"path\" name=\"d\"/></integrator>"
    val names = image(aov("a:depth", within)).channelNames
    assert(Set("b.R", "b.d.R", "b.d.A", "b.c.U", "b.c.V", "a.T").subsetOf(names.toSet))

  test("what is no layer, unknown or there twice is an error"):
    assert(problems(aov("depth")) == Vector(
      Severity.Error -> "a layer must be NAME:QUANTITY, found `depth`"
    ))
    assert(problems(aov("a:dept")) == Vector(Severity.Error -> "unknown quantity `dept` of `aovs`"))
    using(aov("a:dept") + sensor + things): scene =>
      assert(scene.errors.head.help.exists(_.contains("`depth`")), scene.errors)
    assert(problems(aov("a:position,a:sh_normal")) == Vector(
      Severity.Error -> "two layers have the channel `a.X`"
    ))

  test("what is not written is a warning, and so is a second integrator"):
    assert(problems(aov("a:depth,i:prim_index")) == Vector(
      Severity.Warning -> "`prim_index` is not supported; `i:prim_index` is not written"
    ))
    assert(problems(aov("a:depth", "<integrator type=\"path\"/><integrator type=\"direct\"/>")) ==
      Vector(Severity.Warning ->
        "only the first integrator of integrator \"aov\" is rendered; this one is ignored"))
