package candela.mitsuba

import candela.bsdf.Fresnel
import candela.scenefile.{Declaration, SceneDescription}

/** Surfaces of Mitsuba 0.6 in the sun, against the formulas of its papers. */
final class EarlierSurfacesSuite extends MitsubaPictures:
  override protected def version: String = "0.6.0"

  private type Direction = (Double, Double, Double)
  private def dot(a: Direction, b: Direction) = a._1 * b._1 + a._2 * b._2 + a._3 * b._3
  private def unit(a: Direction): Direction =
    val length = Math.sqrt(dot(a, a))
    (a._1 / length, a._2 / length, a._3 / length)

  private val wo = unit((-2.0, -1.0, 2.0))
  private val wi = unit((1.0, 0.8, 1.6))
  private val behind = unit((1.0, 0.8, -1.6))

  private def sun(w: Direction) =
    "<emitter type=\"directional\"><vector name=\"direction\" " +
      s"x=\"${-w._1}\" y=\"${-w._2}\" z=\"${-w._3}\"/>" +
      "<rgb name=\"irradiance\" value=\"1\"/></emitter>"

  /** Radiance by the value of the BSDF. */
  private def lit(bsdf: String, light: Direction = wi): Float =
    val scene = view(1, 256, from = "-20,-10,20") + s"<shape type=\"rectangle\">$bsdf</shape>"
    mean(scene + sun(light)).g

  /** The view has an angle of 1°: 1 % of most lobes. */
  private def agrees(bsdf: String, expected: Double, light: Direction = wi): Unit =
    val found = lit(bsdf, light)
    val radiance = expected * Math.abs(light._3)
    assert(Math.abs(found / radiance - 1) < 0.01, s"$found instead of $radiance"): Unit

  private def bsdf(kind: String, content: String) = s"<bsdf type=\"$kind\">$content</bsdf>"
  private def float(name: String, x: Double) = s"<float name=\"$name\" value=\"$x\"/>"
  private def spectrum(name: String, x: Double) = s"<spectrum name=\"$name\" value=\"$x\"/>"
  private def diffuse(x: Double) = bsdf("diffuse", spectrum("reflectance", x))
  private val shape = (inner: String) => s"<shape type=\"rectangle\">$inner</shape>"

  private def scene(body: String): SceneDescription = read(view(20, 1) + body)
  private def warnings(body: String) = scene(body).warnings.map(_.message)
  private def errors(body: String) = scene(body).errors.map(_.message)
  private def material(bsdf: String): Declaration =
    val s = scene(shape(bsdf))
    assert(s.errors.isEmpty, s.errors.map(_.message))
    s.shapes.head.material.declared(s.namedMaterials.toMap).get

  private def phong(kd: Double, ks: Double, exponent: Double) =
    val cosine = dot(wi, (-wo._1, -wo._2, wo._3))
    kd / Math.PI + ks * (exponent + 2) / (2 * Math.PI) * Math.pow(Math.max(0, cosine), exponent)

  test("phong is the modified model, with 0.6's defaults"):
    agrees(bsdf("phong", ""), phong(0.5, 0.2, 30))
    agrees(
      bsdf(
        "phong",
        float("exponent", 8) + spectrum("specularReflectance", 0.6) +
          spectrum("diffuseReflectance", 0.1)
      ),
      phong(0.1, 0.6, 8)
    )

  test("reflectances that may add up to more than 1 are scaled to 0.99, unless the scene says no"):
    val bright = spectrum("specularReflectance", 0.7) + spectrum("diffuseReflectance", 0.8)
    agrees(bsdf("phong", bright), phong(0.8, 0.7, 30) * 0.99 / 1.5)
    val message = warnings(shape(bsdf("phong", bright))).mkString
    assert(message.contains("add up to 1.5") && message.contains("0.66"))
    val free = bright + "<boolean name=\"ensureEnergyConservation\" value=\"false\"/>"
    agrees(bsdf("phong", free), phong(0.8, 0.7, 30))
    assert(warnings(shape(bsdf("phong", free))).isEmpty)
    // The largest values of a texture count everywhere
    val texture = "<texture name=\"diffuseReflectance\" type=\"checkerboard\">" +
      spectrum("color0", 0.3) + spectrum("color1", 0.9) + float("uvscale", 0.01) + "</texture>"
    agrees(bsdf("phong", texture), phong(0.3, 0.2, 30) * 0.99 / 1.1)

  test("ward is any of three models"):
    val (u, v) = (0.3, 0.5)
    val h = (wo._1 + wi._1, wo._2 + wi._2, wo._3 + wi._3)
    val bell =
      Math.exp(-(h._1 * h._1 / (u * u) + h._2 * h._2 / (v * v)) / (h._3 * h._3)) / (Math.PI * u * v)
    for
      (variant, factor) <- Seq(
        "ward" -> 0.25 / Math.sqrt(wo._3 * wi._3),
        "ward-duer" -> 0.25 / (wo._3 * wi._3),
        "balanced" -> dot(h, h) / Math.pow(h._3, 4)
      )
    do
      val content =
        s"<string name=\"variant\" value=\"$variant\"/>" + float("alphaU", u) + float("alphaV", v)
      agrees(bsdf("ward", content), 0.5 / Math.PI + 0.2 * bell * factor)
    assert(material(bsdf("ward", "")).param("variant").get.strings == Vector("balanced"))

  test("roughdiffuse is Oren and Nayar's model, or its approximation"):
    val (rho, s2) = (0.8, 0.6 * 0.6 / 2)
    val (thetaO, thetaI) = (Math.acos(wo._3), Math.acos(wi._3))
    val (a, b) = (Math.max(thetaO, thetaI), Math.min(thetaO, thetaI))
    val cosPhi = (wo._1 * wi._1 + wo._2 * wi._2) / (Math.sin(thetaO) * Math.sin(thetaI))
    val c1 = 1 - 0.5 * s2 / (s2 + 0.33)
    val lean = Math.sin(a) - Math.pow(2 * b / Math.PI, 3)
    val c3 = 0.125 * s2 / (s2 + 0.09) * Math.pow(4 * a * b / (Math.PI * Math.PI), 2)
    val once = c1 + cosPhi * 0.45 * s2 / (s2 + 0.09) * lean * Math.tan(b) +
      (1 - Math.abs(cosPhi)) * c3 * Math.tan((a + b) / 2)
    val again = 0.17 * s2 / (s2 + 0.13) * (1 - cosPhi * Math.pow(2 * b / Math.PI, 2))
    val content = spectrum("reflectance", rho) + float("alpha", 0.6)
    agrees(bsdf("roughdiffuse", content), rho * (once + rho * again) / Math.PI)
    val fast = "<boolean name=\"useFastApprox\" value=\"true\"/>"
    // The azimuths are opposite: nothing but the first term
    agrees(bsdf("roughdiffuse", content + fast), rho * c1 / Math.PI)

  test("difftrans transmits, and reflects nothing"):
    agrees(bsdf("difftrans", ""), 0.5 / Math.PI, behind)
    agrees(bsdf("difftrans", spectrum("transmittance", 0.9)), 0.9 / Math.PI, behind)
    assert(lit(bsdf("difftrans", "")) == 0f)

  test("mixturebsdf is a sum by weight, of any number of BSDFs"):
    def mixture(weights: String, inner: String*) =
      bsdf("mixturebsdf", s"<string name=\"weights\" value=\"$weights\"/>${inner.mkString}")
    agrees(mixture("0.5, 0.2; .1", diffuse(0.9), diffuse(0.4), diffuse(0.7)), 0.6 / Math.PI)
    agrees(mixture("0.25", diffuse(0.8)), 0.2 / Math.PI)
    agrees(mixture("1", diffuse(0.8)), 0.8 / Math.PI)
    agrees(mixture("0 0.5 0", diffuse(0.8), diffuse(0.4), diffuse(0.1)), 0.2 / Math.PI)
    agrees(mixture("2 1", diffuse(0.9), diffuse(0.3)), 0.7 / Math.PI)
    assert(warnings(shape(mixture("2 1", diffuse(0.9), diffuse(0.3)))).mkString.contains("scaled"))
    for weights <- Seq("1", "1 -1", "0 0", "") do
      val message = errors(shape(mixture(weights, diffuse(1), diffuse(1)))).mkString
      assert(message.contains("2 numbers"), weights)

  private def fresnel(cosine: Double) = Fresnel.dielectric(cosine.toFloat, 1.5f).toDouble
  private def within(cosine: Double) = Math.sqrt(1 - (1 - cosine * cosine) / 2.25)

  test("a coating is seen through, and absorbs along refracted ways"):
    val indices = float("intIOR", 1.5) + float("extIOR", 1)
    val passed = (1 - fresnel(wo._3)) * (1 - fresnel(wi._3)) / 2.25
    agrees(bsdf("coating", indices + diffuse(0.8)), passed * 0.8 / Math.PI)
    val dimmed = Math.exp(-0.5 * 0.6 * (1 / within(wo._3) + 1 / within(wi._3)))
    val absorbing = indices + float("thickness", 0.5) + spectrum("sigmaA", 0.6) + diffuse(0.8)
    agrees(bsdf("coating", absorbing), passed * dimmed * 0.8 / Math.PI)
    agrees(
      bsdf("roughcoating", absorbing + float("alpha", 0.01) + spectrum("specularReflectance", 0)),
      passed * dimmed * 0.8 / Math.PI
    )
    assert(errors(shape(bsdf("coating", indices))).mkString.contains("must contain a bsdf"))

  test("a rough coating reflects as microfacets do"):
    val inner = float("intIOR", 1.5) + float("extIOR", 1) + float("alpha", 0.5) + diffuse(0)
    val h = unit((wo._1 + wi._1, wo._2 + wi._2, wo._3 + wi._3))
    def masked(cosine: Double) =
      val a = cosine / Math.sqrt(1 - cosine * cosine) / 0.5
      if a >= 1.6 then 1.0
      else (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a)
    val cos2 = h._3 * h._3
    val d = Math.exp(-(1 - cos2) / cos2 / 0.25) / (Math.PI * 0.25 * cos2 * cos2)
    val value = fresnel(dot(wo, h)) * d * masked(wo._3) * masked(wi._3) / (4 * wo._3 * wi._3)
    agrees(bsdf("roughcoating", inner), value)

  test("hk is a layer that scatters once"):
    val content = spectrum("sigmaS", 0.6) + spectrum("sigmaA", 0.2) + float("thickness", 1.5)
    val depth = 0.8 * 1.5
    val (a, b) = (wo._3, wi._3)
    val back = 0.75 / (4 * Math.PI) / (a + b) * (1 - Math.exp(-depth * (1 / a + 1 / b)))
    agrees(bsdf("hk", content), back)
    val through = 0.75 / (4 * Math.PI) * (Math.exp(-depth / a) - Math.exp(-depth / b)) / (a - b)
    agrees(bsdf("hk", content), through, behind)
    val other = spectrum("sigmaT", 0.8) + spectrum("albedo", 0.75) + float("thickness", 1.5)
    agrees(bsdf("hk", other), back)
    val g = "<phase type=\"hg\">" + float("g", 0.5) + "</phase>"
    val cosine = -dot(wo, wi)
    val hg = 0.75 / Math.pow(1.25 - cosine, 1.5)
    agrees(bsdf("hk", content + g), back * hg)

  test("the coefficients of hk may be those of a named medium"):
    val found = material(bsdf("hk", "<string name=\"material\" value=\"Ketchup\"/>"))
    assert(found.param("sigma_s").get.floats.toVector.map(Math.round) == Vector(18, 7, 3))
    assert(found.param("sigma_a").get.floats.toVector.map(Math.round) == Vector(6, 97, 145))

  test("irawan becomes a diffuse surface of the mean colour of its yarns, with a warning"):
    val cloth = "<string name=\"filename\" value=\"w.wv\"/>" + float("repeatU", 10) +
      spectrum("warp_kd", 0.2) + spectrum("weft_kd", 0.4)
    val found = material(bsdf("irawan", cloth))
    assert(
      found.name == "diffuse" && Math.abs(found.param("reflectance").get.floats(0) - 0.3f) < 1e-6
    )
    val message = warnings(shape(bsdf("irawan", cloth))).mkString
    assert(
      message.startsWith("bsdf \"irawan\" is not supported; using a diffuse reflectance of 0.3")
    )

  test("microfacets may have the distribution of Phong, or of Ashikhmin and Shirley"):
    for kind <- Seq("roughconductor", "roughdielectric", "roughplastic"); name <- Seq("phong", "as")
    do
      val found = material(bsdf(kind, s"<string name=\"distribution\" value=\"$name\"/>"))
      assert(found.param("distribution").get.strings == Vector("phong"), kind)

  test("a conductor of 0.6 is copper by default"):
    val copper = bsdf("conductor", "<string name=\"material\" value=\"Cu\"/>")
    assert(material(bsdf("conductor", "")).param("k").get.floats.toVector ==
      material(copper).param("k").get.floats.toVector)

  test("types that were renamed before 0.6 are read by their names then"):
    assert(material(bsdf("lambertian", "")).name == "diffuse")
    assert(material(bsdf("mirror", "")).name == "conductor")
    assert(material(bsdf(
      "roughmetal",
      float("alphaB", 0.3)
    )).param("uroughness").get.floats(0) == 0.3f)
    val bumps =
      "<texture type=\"exrtexture\"><string name=\"filename\" value=\"none.exr\"/></texture>"
    assert(errors(shape(bsdf(
      "bump",
      bumps + diffuse(0.5)
    ))).map(_.take(12)) == Vector("no such file"))

  test("coated and mixed surfaces are black from behind where their parts are, and coats are not"):
    def fromBehind(inner: String) =
      val scene = view(1, 64, from = "20,10,-20") + shape(inner)
      mean(scene + sun(behind)).g
    val indices = float("intIOR", 1.5)
    assert(fromBehind(bsdf("coating", indices + diffuse(0.8))) == 0f)
    val mixture = "<string name=\"weights\" value=\".5 .5\"/>" + diffuse(1)
    assert(fromBehind(bsdf("mixturebsdf", mixture + diffuse(1))) == 0f)
    assert(fromBehind(bsdf("mixturebsdf", mixture + bsdf("difftrans", ""))) == 0f)
    assert(fromBehind(bsdf("twosided", bsdf("phong", ""))) > 0.05f)
    // 4 % of the mirror image of a white sky
    val white = "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"1\"/></emitter>"
    val coat =
      mean(view(1, 64, from = "1,0,-20") + shape(bsdf("coating", indices + diffuse(0))) + white)
    assert(Math.abs(coat.g - 0.04f) < 0.005f, coat)
