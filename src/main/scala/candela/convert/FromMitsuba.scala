package candela.convert

import candela.base.loop
import candela.diagnostics.{Code, Problem}
import candela.io.SceneFolder
import scala.collection.mutable
import scala.util.Try

import candela.bsdf.Fresnel
import candela.color.Rgb
import candela.image.ImageFiles
import candela.scenefile.{
  Declaration, Dialect, GraphicsState, MaterialRef, Param, ParamType, SceneDescription,
  TextureDescription
}

/** Replaces the materials that pbrt lacks in scenes of Mitsuba, and reports lights that differ. */
object FromMitsuba:

  def converted(scene: SceneDescription): Converted =
    val run = Run(scene.namedMaterials.toMap)
    run.disks(scene)
    run.thinDielectrics(scene)
    val plain = Declarations.map(scene)(run.plain)
    val converted = plain.copy(
      dialect = Dialect.V4,
      textures = plain.textures ++ run.addedTextures,
      shapes = run.withoutHeightMaps(plain.shapes).map(EmittingShapes.unmirrored),
      objects = plain.objects.map((name, shapes) => name -> run.withoutHeightMaps(shapes))
    )
    Converted(exposed(converted), run.warnings)

  /** pbrt-v4 integrates over the time that the shutter is open, and has no instant. */
  private def exposed(scene: SceneDescription): SceneDescription =
    def time(name: String) =
      scene.camera.flatMap(_.param(name)).flatMap(_.floats.headOption).getOrElse(0f)
    val duration = time("shutterclose") - time("shutteropen")
    if duration > 0f then
      def iso(film: Declaration) = Param.float("iso", film.pos, 100f / duration)
      scene.copy(film = scene.film.map(film => film.copy(params = film.params :+ iso(film))))
    else
      val isTime = Set("shutteropen", "shutterclose")
      scene.copy(camera =
        scene.camera.map(c => c.copy(params = c.params.filterNot(p => isTime(p.name))))
      )

  private final class Run(named: Map[String, Declaration]) extends ForeignLosses:
    private val added = mutable.LinkedHashMap.empty[String, TextureDescription]
    def addedTextures: Vector[TextureDescription] = added.values.toVector

    def plain(d: Declaration): Declaration =
      if d.category == "LightSource" then light(d)
      else if d.category == "AreaLightSource" then areaLight(d)
      else if d.category == "Texture" then texture(d)
      else if d.category == "Camera" then
        withoutParams(d, "nothing is clipped", "nearclip", "farclip")
      else if d.category == "Film" then
        val opaque = withoutParams(d, "no alpha is written", "alpha")
        withoutParams(
          withoutParams(opaque, "the layers of Mitsuba's \"aov\" are not written", "aovs"),
          "",
          "sampleborder",
          "exposure"
        )
      else if d.category == "Integrator" then
        integrator(withoutParams(d, "area lights and sky are visible", "hideemitters"))
      else if d.category == "Shape" then
        withoutParams(d, "the inside of open tubes is visible", "cullbackfaces")
      else if d.category == "Medium" then
        if d.name.endsWith("grid") then
          warn(d, "pbrt's densities fall to 0 along the border of a grid, Mitsuba's do not")
        val ended = withoutParams(d, "the medium ends at its grid", "fillsworldbox")
        val product = "pbrt interpolates the product of extinction and albedo, Mitsuba both"
        phased(
          withoutParams(withoutParams(ended, product, "albedo"), "", "albedosize", "albedoplace")
        )
      else if d.category != "Material" then d
      else
        for p <- d.param("normalmapuv") do
          warn(p, "pbrt maps normal maps by u and v directly; `to_uv` of this one is dropped")
        for p <- d.params if FromMitsuba.BumpParams(p.name) && isSoft(d) do
          warn(p, "pbrt does not darken the edge of the shadow on bumps, as Mitsuba does")
        val mapped = withoutParams(d, "", "normalmapuv", "softedges", "turnednormals")
        if d.dialect.isDefined then mapped else spelled(material(mapped))

    private def spelled(d: Declaration): Declaration =
      def inV3(p: Param) = if p.name == "displacement" then p.renamed("bumpmap") else p
      if d.dialect.isEmpty then d else d.copy(params = d.params.map(inV3))

    private def isSoft(d: Declaration): Boolean =
      !d.param("softedges").exists(_.bools.contains(false))

    /** pbrt's images end with their border; only a mapping or a filter shows much of that. */
    private def areaLight(d: Declaration): Declaration =
      val isFiltered = d.param("filter").exists(_.strings.contains("point"))
      val filtered = withoutParams(d, if isFiltered then "it is smooth" else "", "filter")
      withoutParams(
        withoutParams(filtered, "the image is mapped by u and v directly", "imageuv"),
        "",
        "wrap"
      )

    private def material(d: Declaration): Declaration =
      d.name match
        case "roughplastic" => plastic(isotropic(d))
        case "conductor" => conductor(isotropic(d))
        case "twosided" | "nested" => front(d)
        case "dielectric" => dielectric(isotropic(d))
        case "phong" | "ward" => glossed(d)
        case "roughdiffuse" => rough(d)
        case "coating" =>
          warn(d, "pbrt has no coats on other materials; this one is left out")
          front(d)
        case "scatteringlayer" =>
          warn(d, "\"hk\" is approximated by pbrt-v4's \"diffusetransmission\"")
          d.copy(name = "diffusetransmission", params = bumpsOf(d))
        case "hair" =>
          warn(
            d,
            if d.param("ribbon").isDefined then
              "highlights of pbrt's hair are on the side away from the light"
            else "pbrt has hair on curves alone, by their v"
          )
          withoutParams(d, "", "ribbon")
        case "thindielectric" => withoutParams(d, "using 1", "reflectance", "transmittance")
        case "principled" if d.param("thin").exists(_.bools.contains(true)) => sheet(d)
        case "principled" =>
          warn(d, "\"principled\" is approximated by pbrt-v3's \"disney\"")
          d.copy(name = "disney", dialect = Some(Dialect.V3))
        case _ => d

    private def bumpsOf(d: Declaration) = d.params.filter(p => FromMitsuba.BumpParams(p.name))

    /** The peak of a power of the cosine is as that of facets of this roughness. */
    private def glossed(d: Declaration): Declaration =
      warn(d, s"\"${d.name}\" is approximated by pbrt-v3's \"substrate\"")
      val exponent = d.param("exponent").flatMap(_.floats.headOption).getOrElse(30f)
      val alpha = Math.sqrt(1 / (2.0 * exponent + 1)).toFloat
      val axes = Vector("uroughness", "vroughness")
      val roughness =
        if d.name == "ward" then axes.flatMap(d.param) else axes.map(Param.float(_, d.pos, alpha))
      val colors = Vector("reflectance" -> "Kd", "specular" -> "Ks")
        .flatMap((from, to) => d.param(from).map(_.renamed(to)))
      val params = colors ++ roughness :+ Param.bool("remaproughness", d.pos, false)
      d.copy(name = "substrate", params = params ++ bumpsOf(d), dialect = Some(Dialect.V3))

    /** A standard deviation in degrees. */
    private def rough(d: Declaration): Declaration =
      warn(d, "\"roughdiffuse\" is approximated by pbrt-v3's \"matte\"")
      val degrees = Math.toDegrees(Math.sqrt(0.5)).toFloat
      val sigma = d.param("roughness").toVector.map: p =>
        val renamed = p.renamed("sigma")
        if p.paramType == ParamType.Texture then times(renamed, "float", degrees)
        else Param.float("sigma", p.pos, p.floats.head * degrees)
      val color = d.param("reflectance").toVector.map(_.renamed("Kd"))
      d.copy(name = "matte", params = color ++ sigma ++ bumpsOf(d), dialect = Some(Dialect.V3))

    private def light(d: Declaration): Declaration =
      d.name match
        case "infinite" =>
          for p <- d.param("mapname") do
            problems += Problem.warning(
              Code.Inexpressible,
              p.pos,
              "pbrt's environment maps begin and end half a row beyond Mitsuba's, whose first " +
                "and last rows are centred on the poles; using pbrt's"
            )
        case "spot" if !d.param("conedeltaangle").exists(_.floats.contains(0f)) =>
          warn(
            d,
            "a \"spot\" fades linearly in Mitsuba, along a smooth curve in pbrt; using pbrt's"
          )
        case _ =>
      if d.name == "projection" then projection(d)
      else if d.name == "spot" then withoutParams(d, "the light is as in white parts", "mapname")
      else d

    /** pbrt's field of view is the shorter side's, not the width's. */
    private def projection(d: Declaration): Declaration =
      warn(d, "pbrt's projected images darken towards the edges, Mitsuba's do not")
      val sizes = d.param("mapname").flatMap(p => d.folder.locate(p.strings.head, Some(p.valuesAt)))
        .flatMap(file => Try(ImageFiles.load(file)).toOption).map(i => i.width.toFloat / i.height)
      val narrow = Math.max(1f, sizes.getOrElse(1f))
      d.copy(params = d.params.map: p =>
        if p.name != "fov" then p
        else
          val halfWidth = Math.tan(Math.toRadians(p.floats.head) / 2) / narrow
          Param.float("fov", p.pos, Math.toDegrees(2 * Math.atan(halfWidth)).toFloat))

    private def texture(d: Declaration): Declaration =
      d.name match
        case "grid" => gridMean(d)
        case "lines" =>
          warn(d, "pbrt has no textures of lines; using the value between them")
          d.copy(name = "constant", params = d.param("tex1").toVector.map(_.renamed("value")))
        case _ => plainTexture(d)

    private def gridMean(d: Declaration): Declaration =
      def cells(axis: String) = d.param(axis).fold(1)(_.ints.headOption.getOrElse(1))
      val values = d.param("values").fold(Array.emptyFloatArray)(_.floats)
      val channels = values.length / Math.max(1, cells("nx") * cells("ny") * cells("nz"))
      val mean = Array.tabulate(channels): c =>
        val channel = values.indices.by(channels).map(i => values(i + c).toDouble)
        (channel.sum / channel.size).toFloat
      warn(d, "pbrt has no grid or mesh attribute textures; using their mean")
      val kind = if channels == 3 then ParamType.Rgb else ParamType.Float
      d.copy(name = "constant", params = Vector(Param.floats(kind, "value", d.pos, mean)))

    private def plainTexture(d: Declaration): Declaration =
      val upright = withoutParams(d, "the texture is left upright", "uskew", "vskew")
      upright.copy(params = upright.params.map: p =>
        if p.name != "wrap" || !p.strings.contains("mirror") then p
        else
          problems += Problem.warning(
            Code.Inexpressible,
            p.pos,
            "pbrt has no wrap `mirror`; using `repeat`"
          )
          Param.string("wrap", p.pos, "repeat"))

    /** u and v of disks differ. */
    def disks(scene: SceneDescription): Unit =
      val named = scene.namedMaterials.toMap
      for s <- (scene.shapes ++ scene.objects.values.flatten) if s.shape.name == "disk" do
        if s.material.declared(named).exists(_.params.exists(_.paramType == ParamType.Texture)) then
          warn(s.shape, "pbrt maps textures on disks differently than Mitsuba; using pbrt's")

    /** pbrt counts transmission through thin glass as an event, Mitsuba's "volpath" does not. */
    def thinDielectrics(scene: SceneDescription): Unit =
      val inlineMaterials = scene.shapes.map(_.material).collect { case MaterialRef.Inline(d) => d }
      for
        i <- scene.integrator if i.name == "volpath"
        depth <- i.param("maxdepth") if depth.ints.exists(_ < FromMitsuba.Deep)
        thinDielectric <-
          (inlineMaterials ++ scene.namedMaterials.map(_._2)).find(_.name == "thindielectric")
      do
        problems += Problem.warning(
          Code.Inexpressible,
          depth.pos,
          "what thin glass transmits is a scattering event in pbrt, not in Mitsuba's volumetric " +
            s"path tracing; `maxdepth` ${depth.ints.head} may be too low",
          Some(s"the thin glass is at ${thinDielectric.pos}")
        )

    /** pbrt has one distribution. Half the microfacets of a Beckmann distribution, or of a smooth
      * one of Phong, are steeper than α √(ln 2), half those of GGX than α.
      */
    private def isotropic(d: Declaration): Declaration =
      val remaining = withoutParams(d, "", "distribution")
      d.param("distribution").filterNot(_.strings.contains("ggx")).fold(remaining): p =>
        problems += Problem.warning(
          Code.Inexpressible,
          p.pos,
          s"pbrt has no distribution `${p.strings.head}`; using `ggx` of equal median slope"
        )
        val factor = Math.sqrt(Math.log(2)).toFloat
        remaining.copy(params = remaining.params.map: q =>
          if q.name != "uroughness" && q.name != "vroughness" then q
          else if q.paramType == ParamType.Texture then times(q, "float", factor)
          else Param.float(q.name, q.pos, q.floats.head * factor))

    /** A texture times a number. */
    private def times(p: Param, valueType: String, factor: Float): Param =
      val name = s"${p.strings.head} times ${NumberText.of(factor)}"
      val scale = Declaration(
        "Texture",
        "scale",
        Vector(Param.texture("tex", p.pos, p.strings.head), Param.float("scale", p.pos, factor)),
        p.pos,
        SceneFolder.Nowhere
      )
      added.getOrElseUpdate(
        name,
        TextureDescription(name, valueType, scale, GraphicsState.Identity)
      )
      Param.texture(p.name, p.pos, name)

    private def color(d: Declaration, name: String): Option[Rgb] =
      d.param(name).map(_.floats).collect { case Array(r, g, b) => Rgb(r, g, b) }

    private def conductor(d: Declaration): Declaration =
      val isMirror = color(d, "eta").contains(Rgb.Black) && color(d, "k").contains(Rgb.White)
      if !isMirror then metal(d)
      else
        val isSmooth = d.param("uroughness").isEmpty
        val remaining = withoutParams(d, "", "scale", "eta", "k").params
        val name = if isSmooth then "Kr" else "reflectance"
        val tint = d.param("scale").fold(rgb(name, Rgb.White, d))(_.renamed(name))
        if isSmooth then
          d.copy(name = "mirror", params = tint +: remaining, dialect = Some(Dialect.V3))
        else d.copy(params = tint +: remaining)

    /** A metal whose reflection is scaled becomes one of equal albedo. */
    private def metal(d: Declaration): Declaration =
      (d.param("scale"), color(d, "eta"), color(d, "k")) match
        case (Some(tint), Some(eta), Some(k)) =>
          val albedo = ConductorAlbedo.ofIndex(eta, k)
          val reflectance = color(d, "scale") match
            case Some(c) => rgb("reflectance", (albedo * c).map(ConductorAlbedo.normal), d)
            case None =>
              val name = tint.renamed("reflectance")
              times(name, "spectrum", ConductorAlbedo.normal(albedo.luminance))
          problems += Problem.warning(
            Code.Inexpressible,
            tint.pos,
            "pbrt has no `scale` of \"conductor\"; using a `reflectance` of equal albedo"
          )
          val remaining = withoutParams(d, "", "scale", "eta", "k")
          remaining.copy(params = reflectance +: remaining.params)
        case _ => withoutParams(d, "using 1", "scale")

    /** v3's glass has colours. */
    private def dielectric(d: Declaration): Declaration =
      val tints = Vector("reflectance" -> "Kr", "transmittance" -> "Kt")
        .flatMap((from, to) => d.param(from).map(_.renamed(to)))
      if tints.isEmpty then d
      else
        val remaining = withoutParams(d, "", "reflectance", "transmittance").params
        d.copy(name = "glass", params = tints ++ remaining, dialect = Some(Dialect.V3))

    /** A coat on a diffuse base. Without `nonlinear`, Mitsuba leaves out that light which the coat
      * reflects back is coloured by the base again: a coated base of another colour looks so.
      */
    private def plastic(d: Declaration): Declaration =
      val isNonlinear = d.param("nonlinear").exists(_.bools.contains(true))
      val isOnce = d.param("interreflection").exists(_.bools.contains(false))
      val remaining =
        withoutParams(withoutParams(d, "using 1", "specular"), "", "nonlinear", "interreflection")
      if isOnce then
        warn(
          d,
          "light returns to the base of pbrt's coats: using the base that is as bright under a " +
            "smooth coat; under a rough one it is darker, by up to a quarter"
        )
      val eta = d.param("eta").flatMap(_.floats.headOption).getOrElse(1.49f)
      val inner = diffuseReflectance(eta)
      // The reflectance that gives the same light with interreflection
      def equalReflectance(r: Float) =
        if isOnce then r * eta * eta / (1 + r * eta * eta * inner)
        else r / (1 - inner + r * inner)
      val params = remaining.params.map: p =>
        if p.name != "reflectance" || isNonlinear then p
        else
          color(d, "reflectance") match
            case Some(c) => rgb("reflectance", c.map(equalReflectance), d)
            case None =>
              warn(
                d,
                if isOnce then "a textured \"pplastic\" becomes darker"
                else
                  "the colour of a textured \"plastic\" becomes that of `nonlinear`: less " +
                    "saturated colours become darker"
              )
              p
      val layer = Seq(Param.float("thickness", d.pos, 0f), Param.int("maxdepth", d.pos, 100))
      d.copy(name = "coateddiffuse", params = params ++ layer)

    /** pbrt's surfaces look the same from behind. */
    private def front(d: Declaration): Declaration =
      val names = d.param("materials").orElse(d.param("material")).get.strings
      if names.distinct.length > 1 then
        warn(d, "pbrt has no separate material for the back; using that of the front for both")
      val bumps = bumpsOf(d)
      val front = named(names.head)
      val takesBumps =
        front.name != "mix" && !front.params.exists(p => FromMitsuba.BumpParams(p.name))
      if bumps.nonEmpty && !takesBumps then
        warn(d, "pbrt has no bump maps on blended or bump-mapped materials; these are dropped")
      material(if takesBumps then front.copy(params = front.params ++ bumps) else front)

    /** A sheet that transmits as much, but spreads all of it. */
    private def sheet(d: Declaration): Declaration =
      warn(d, "\"principledthin\" is approximated by pbrt-v4's \"diffusetransmission\"")
      def number(name: String) = d.param(name).flatMap(_.floats.headOption).getOrElse(0f)
      val clear = number("spectrans")
      val reflected = (1f - clear) * (1f - 0.5f * number("difftrans"))
      val colors = Vector("reflectance" -> reflected, "transmittance" -> (1f - reflected)).map:
        (name, fraction) =>
          color(d, "color") match
            case Some(c) => rgb(name, c * fraction, d)
            case None => times(d.param("color").get.renamed(name), "spectrum", fraction)
      d.copy(name = "diffusetransmission", params = colors ++ bumpsOf(d))

  private val BumpParams = Set("displacement", "bumpmap", "normalmap")

  /** Events of paths that hardly any light reaches. */
  private val Deep = 100

  /** Fraction of diffuse light that the inside of an interface reflects. */
  private def diffuseReflectance(eta: Float): Float =
    val steps = 2000
    var sum = 0.0
    loop(steps): i =>
      val cos = (i + 0.5) / steps
      sum += cos * Fresnel.dielectric(cos.toFloat, 1 / eta)
    (2 * sum / steps).toFloat
