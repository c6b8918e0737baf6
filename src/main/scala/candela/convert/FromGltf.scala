package candela.convert

import candela.base.loop
import candela.build.media.Interiors
import candela.color.{Cauchy, Rgb}
import candela.diagnostics.{Code, Problem}
import candela.image.{Image, ImageError, ImageFiles, StoredImage}
import candela.io.FileName
import candela.math.{clamp, lerp, square}
import candela.scenefile.{
  Declaration, Dialect, GraphicsState, MaterialRef, Param, ParamType, SceneDescription,
  ShapeDescription, TextureDescription
}

import java.util.Locale
import scala.collection.mutable

/** Replaces what pbrt-v4 lacks in scenes of glTF models: their material, channels of images, and
  * what vertices have beside u, v and normals. Files within the model become files.
  */
private[convert] object FromGltf:
  private val LeftOut = Vector(
    "clearcoat", "sheencolor", "anisotropy", "iridescence", "specular", "specularcolor"
  )

  def converted(scene: SceneDescription, files: SideFiles): Converted =
    val run = Run(scene, files)
    val unclipped = run.unclipped
    (unclipped.shapes ++ unclipped.objects.values.flatten).foreach(run.openedSurface)
    val solid = unclipped.copy(shapes = unclipped.shapes.map(run.solidLight))
    val plain = Declarations.map(solid)(run.plain)
    val named = plain.namedMaterials.flatMap(run.material)
    val result = plain.copy(
      dialect = Dialect.V4,
      textures = plain.textures.filter(_.valueType == "float") ++ run.addedTextures,
      namedMaterials = named
    )
    Converted(result, run.warnings)

  private final class Run(scene: SceneDescription, files: SideFiles) extends ForeignLosses:
    private val textures = scene.textures.map(t => t.name -> t.texture).toMap
    private val added = mutable.LinkedHashMap.empty[String, TextureDescription]
    private val bases = mutable.HashMap.empty[(Float, Float), DielectricBase]
    private val meanAlphas = mutable.HashMap.empty[String, Float]
    def addedTextures: Vector[TextureDescription] = added.values.toVector

    def plain(d: Declaration): Declaration =
      val filed = extracted(d)
      filed.category match
        case "Shape" => shape(filed)
        case "Texture" => texture(filed)
        case "AreaLightSource" => areaLight(filed)
        case "Medium" =>
          for p <- filed.params if p.name.startsWith("sigma_") && p.floats.distinct.length > 1 do
            warn(
              p,
              s"pbrt-v4 takes a spectrum of the color `${p.name}`: what passes has another color"
            )
          filed
        case "LightSource" =>
          if d.name == "spot" && d.param("falloff").isEmpty then
            warn(d, "a \"spot\" fades along another curve in pbrt")
          withoutParams(visibleLight(filed), "", "falloff")
        case _ => filed

    /** The scene with rays that begin at the camera itself. */
    def unclipped: SceneDescription =
      def isClip(p: Param) = p.name == "nearclip" || p.name == "farclip"
      val clips = scene.camera.toVector.flatMap(_.params).filter(isClip)
      for p <- clips do
        val isDistant = p.floats.forall(z => z < 1e-6f || z >= 1e30f)
        // Cameras that were added have no place in the model
        val isWritten = p.pos.line > 0 || p.pos.file.contains('#')
        if isWritten && !isDistant then
          warn(p, s"pbrt's cameras have no `${p.name}`; nothing is clipped")
      def camera(near: Option[Param]) =
        scene.camera.map(c => c.copy(params = c.params.filterNot(isClip) ++ near))
      if clips.isEmpty then scene
      else
        val near = Param.float("nearclip", clips.head.pos, 0f)
        Interiors.aroundCamera(scene.copy(camera = camera(Some(near)))).copy(camera = camera(None))

    def openedSurface(s: ShapeDescription): Unit =
      for alpha <- s.shape.param("alpha") do
        val material = s.material match
          case MaterialRef.Named(name, _) => s" of material `$name`"
          case _ => ""
        if s.insideMedium.nonEmpty then
          warn(alpha, s"pbrt has no medium$material where alpha opens its surface")
        if s.areaLight.nonEmpty then
          warn(alpha, s"pbrt dims the emission$material twice by its alpha")

    /** With the files that are within the model written beside the scene. */
    private def extracted(d: Declaration): Declaration =
      d.copy(params = d.params.map: p =>
        val part = if p.paramType == ParamType.String then p.strings.headOption else None
        part.flatMap(d.folder.part).fold(p): file =>
          val suffix = FileName.suffix(file.path)
          p.withStrings(Vector(relative(d, files.add("image", suffix, file.bytes())))))

    /** A file beside the scene, as the declaration names it. */
    private def relative(d: Declaration, name: String): String =
      val from = d.folder.path.toAbsolutePath.normalize
      from.relativize(files.folder.toAbsolutePath.normalize.resolve(name)).toString
        .replace('\\', '/')

    private def shape(d: Declaration): Declaration =
      for p <- d.param("colors") do warn(p, "pbrt has no colours of vertices; they are left out")
      val cutoff = d.param("alphacutoff").flatMap(_.floats.headOption)
      val cut = cutoff.fold(d)(cutAlpha(d, _))
      withoutParams(
        withoutParams(cut, "it is seen from behind, too", "cullbackfaces"),
        "",
        "colors",
        "uv2",
        "tangents",
        "alphacutoff"
      )

    /** Alpha that is 0 or 1. */
    private def cutAlpha(d: Declaration, from: Float): Declaration =
      d.copy(params = d.params.map: p =>
        if p.name != "alpha" then p
        else if p.paramType != ParamType.Texture then
          Param.float("alpha", p.pos, if p.floats.head >= from then 1f else 0f)
        else
          textures.get(p.strings.head).filter(_.name == "imagemap") match
            case Some(t) =>
              val name = s"${p.strings.head} from ${NumberText.of(from)}"
              add(name, channel(extracted(t), x => if x >= from then 1f else 0f))
              Param.texture("alpha", p.pos, name)
            case None =>
              warn(p, "pbrt has no threshold of this alpha; it is used as it is")
              p)

    private def add(name: String, texture: Declaration, kind: String = "float"): Unit =
      added(name) = TextureDescription(name, kind, texture, GraphicsState.Identity)

    private def texture(d: Declaration): Declaration =
      if d.name == "vertexcolor" then
        Declaration("Texture", "constant", Vector.empty, d.pos, d.folder)
      else
        val single = if d.param("channel").isEmpty then d else channel(d, x => x)
        val first = withoutParams(single, "using the first set of u and v", "uv2")
        upright(withoutParams(first, "the texture is left upright", "uskew", "vskew"))

    private def upright(d: Declaration): Declaration =
      val alike = withoutParams(d, "images are wrapped alike along s and t", "wrapt")
      alike.copy(params = alike.params.map: p =>
        if p.name != "wrap" || !p.strings.contains("mirror") then p
        else
          warn(p, "pbrt has no wrap `mirror`; using `repeat`")
          Param.string("wrap", p.pos, "repeat"))

    /** A channel of an image, as an image of its own. */
    private def channel(d: Declaration, change: Float => Float): Declaration =
      val key = (channelOf(d), change(0.4f) + 2 * change(0.6f))
      val single = rewritten(d, key): stored =>
        val image = stored.toImage
        val data = grays(d, image).map(change)
        Image(image.width, image.height, Vector("Y"), data, image.encoding)
      single.copy(params = single.params.filterNot(_.name == "channel"))

    private def channelOf(d: Declaration): String = d.param("channel").fold("a")(_.strings.head)

    /** The declaration with another image, which is written once for each key. */
    private def rewritten(d: Declaration, key: Any)(change: StoredImage => Image): Declaration =
      val at = d.param("filename").get
      readable(at):
        files.reused((RewrittenImages.file(d.folder, at).path, key)):
          files.add("image", "png", ImageFiles.png(change(load(d, at))))
      .fold(d): name =>
        d.copy(params = d.params.map: p =>
          if p.name == "filename" then Param.string("filename", at.pos, relative(d, name)) else p)

    private def load(d: Declaration, at: Param): StoredImage =
      ImageFiles.load(RewrittenImages.file(d.folder, at))

    /** What is made of an image; none, after a warning, if it can't be read. */
    private def readable[A](at: Param)(use: => A): Option[A] =
      try Some(use)
      catch
        case e: ImageError =>
          problems += Problem.warning(
            Code.UnconvertedImage,
            at.pos,
            s"can't read the image, leaving it unchanged: ${e.getMessage}"
          )
          None

    /** The values of the channel that a texture reads. */
    private def grays(d: Declaration, image: Image): Array[Float] =
      val name = channelOf(d).toUpperCase(Locale.ROOT)
      val channelIndex = image.channelNames.indexOf(name)
      val c = if channelIndex >= 0 || name == "A" then channelIndex else image.colorChannels.head
      val values = new Array[Float](image.width * image.height)
      loop(values.length)(i => values(i) = if c < 0 then 1f else image.data(i * image.channels + c))
      values

    private def areaLight(d: Declaration): Declaration =
      val tinted = d.param("tint").map(rgb).filter(_ != Rgb.White).fold(d): tint =>
        rewritten(d, tint)(_.toReflectances.mapped(_ * tint))
      val placed =
        withoutParams(tinted, "the image is mapped by u and v directly", "imageuv", "uv2")
      for p <-
          Vector("coneangle", "spread").flatMap(d.param).filter(_.floats.headOption.exists(_ < 180))
      do warn(p, "pbrt has no beams of area lights; it shines to all sides")
      val bare = withoutParams(placed, "", "axis", "coneangle", "conedeltaangle", "spread")
      withoutParams(visibleLight(bare), "", "wrap", "wrapt", "filter", "tint")

    /** Lights of material "interface" are black in pbrt-v4. It has lights that no ray hits, and
      * others.
      */
    def solidLight(s: ShapeDescription): ShapeDescription = s.material match
      case MaterialRef.Inline(m) if m.name == "interface" && s.areaLight.isDefined =>
        val isHidden = s.areaLight.flatMap(_.param("inview")).exists(_.bools.contains(false))
        val zero = if isHidden then Some(Param.float("alpha", m.pos, 0f)) else None
        warn(m, if isHidden then "nothing reflects the light" else "the light casts a shadow")
        val black = Param.floats(ParamType.Rgb, "reflectance", m.pos, Array(0f, 0f, 0f))
        s.copy(
          shape = s.shape.copy(params = s.shape.params ++ zero),
          material = MaterialRef.Inline(m.copy(name = "diffuse", params = Vector(black))),
          areaLight = s.areaLight.map(withoutParams(_, "", "inview"))
        )
      case _ => s

    /** A light that the camera sees. */
    private def visibleLight(d: Declaration): Declaration =
      for p <- d.param("inview").filter(_.bools.contains(false)) do
        warn(p, "the camera sees the light")
      withoutParams(d, "", "inview")

    private def rgb(p: Param): Rgb = Rgb(p.floats(0), p.floats(1), p.floats(2))

    /** A material of glTF as one of pbrt's, or as a blend of several. */
    def material(name: String, d: Declaration): Vector[(String, Declaration)] =
      if d.name != "gltf" then Vector(name -> d)
      else
        warn(d, "the material of glTF is approximated by pbrt-v4's")
        for
          p <- FromGltf.LeftOut.flatMap(d.param)
          if !p.floats.forall(x => x == (if p.name.startsWith("specular") then 1f else 0f))
        do warn(p, s"pbrt has no `${p.name}` of \"gltf\"; it is left out")
        val metallic = d.param("metallic")
        metallic.flatMap(_.floats.headOption).orElse(metallic.fold(Some(1f))(_ => None)) match
          case Some(1f) => Vector(name -> metal(d))
          case Some(0f) => dielectric(name, d)
          case _ =>
            val (first, second) = (s"$name, dielectric", s"$name, metal")
            dielectric(first, d) :+ (second -> metal(d)) :+
              (name -> blend(d, first, second, metallic.get.renamed("amount")))

    private def blend(d: Declaration, first: String, second: String, amount: Param): Declaration =
      d.copy(
        name = "mix",
        params = Vector(Param.string("materials", d.pos, first, second), amount)
      )

    private def metal(d: Declaration): Declaration =
      val color = reflectance(d, "of metal", metalColor)
      d.copy(name = "conductor", params = color +: (roughness(d) ++ bumps(d)))

    /** The colour for which pbrt-v4's metal reflects as much light from all sides. */
    private def metalColor(c: Float): Float =
      val x = clamp(c, 0f, 1f) * (metalColors.length - 1)
      val i = Math.min(x.toInt, metalColors.length - 2)
      lerp(x - i, metalColors(i), metalColors(i + 1))

    // By Schlick's approximation, whose weight of grazing incidence has a mean of 1 / 21
    private lazy val metalColors = Array.tabulate(257): i =>
      val c = i / 256f
      ConductorAlbedo.normal(c + (1f - c) / 21f)

    private def dielectric(name: String, d: Declaration): Vector[(String, Declaration)] =
      val passing = d.param("transmission").flatMap(_.floats.headOption).getOrElse(0f)
      val isThin = !d.param("thin").exists(_.bools.contains(false))
      val eta = d.param("eta").filter(_.floats.exists(_ >= 1f)).toVector
      val sheet = d.param("diffusetransmission").flatMap(_.floats.headOption).getOrElse(0f)
      if passing >= 0.5f then
        warn(d, "pbrt's glass has no colour; it is left out")
        if isThin then Vector(name -> d.copy(name = "thindielectric", params = eta))
        else
          val index = dispersed(d, eta)
          Vector(name -> d.copy(name = "dielectric", params = index ++ roughness(d) ++ bumps(d)))
      else if sheet > 0f then Vector(name -> transmitting(d, sheet))
      else
        val index = eta.headOption.fold(1.5f)(_.floats.head)
        val alpha = meanAlpha(d)
        val base = bases.getOrElseUpdate((index, alpha), DielectricBase(index, alpha))
        val brightest = colorOf(d)._2.max
        if base.fitsUnderCoat(brightest) then
          val layer =
            Vector(Param.float("thickness", d.pos, 0f), Param.int("maxdepth", d.pos, 100))
          val color = reflectance(d, s"under a coat of $index, $alpha", base.underCoat)
          Vector(name -> d.copy(
            name = "coateddiffuse",
            params = color +: (eta ++ roughness(d) ++ layer ++ bumps(d))
          ))
        else
          // Rough coats of pbrt lose light that glTF's keep
          val share = base.highlights(brightest)
          val (first, second) = (s"$name, base", s"$name, highlights")
          val color = reflectance(d, s"beside $share", base.beside(share, _))
          val mirror = rgb("reflectance", Rgb.gray(Math.min(base.normal / share, 1f)), d)
          Vector(
            first -> d.copy(name = "diffuse", params = color +: bumps(d)),
            second ->
              d.copy(name = "conductor", params = mirror +: (roughness(d) ++ bumps(d))),
            name -> blend(d, first, second, Param.float("amount", d.pos, share))
          )

    /** The index of refraction at wavelengths, if it differs among them. */
    private def dispersed(d: Declaration, eta: Vector[Param]): Vector[Param] =
      val strength = d.param("dispersion").flatMap(_.floats.headOption).getOrElse(0f)
      if strength == 0f then eta
      else
        val index = Cauchy(eta.headOption.fold(1.5f)(_.floats.head), strength)
        val pairs = index.lambda.zip(index.values).flatMap(_.toList)
        Vector(Param.floats(ParamType.Spectrum, "eta", d.pos, pairs))

    private def transmitting(d: Declaration, share: Float): Declaration =
      warn(d, "pbrt's \"diffusetransmission\" has no highlights; they are left out")
      val sent = d.copy(params =
        d.param("diffusetransmissioncolor").map(_.renamed("color")).toVector
      )
      val params = Vector(
        reflectance(d, s"of ${1f - share}", _ * (1f - share)),
        reflectance(sent, s"of $share", _ * share).renamed("transmittance")
      )
      d.copy(name = "diffusetransmission", params = params ++ bumps(d))

    /** The base colour: an image, if there is one, times a colour. */
    private def colorOf(d: Declaration): (Option[Declaration], Rgb) =
      def factors(p: Param): (Option[Declaration], Rgb) =
        if p.paramType != ParamType.Texture then (None, rgb(p))
        else
          val t = textures(p.strings.head)
          t.name match
            case "imagemap" => (Some(t), Rgb.White)
            case "scale" =>
              t.params.map(factors).reduce((a, b) => (a._1.orElse(b._1), a._2 * b._2))
            case _ => (None, Rgb.White)
      d.param("color").fold((None, Rgb.White))(factors)

    /** The base colour, changed, as a parameter of a material of pbrt.
      *
      * @param label of the change
      */
    private def reflectance(d: Declaration, label: String, change: Float => Float): Param =
      val (image, tint) = colorOf(d)
      image.fold(rgb("reflectance", tint.map(change), d)): t =>
        val name = s"texture ${added.size + 1} $label"
        val result = rewritten(extracted(t), (label, tint)): image =>
          val colors = image.toReflectances
          colors.mapped(c => (c * tint).map(change), colors.data)
        add(name, texture(result), "spectrum")
        Param.texture("reflectance", d.pos, name)

    /** The width of the slopes; of a texture, its mean. */
    private def meanAlpha(d: Declaration): Float =
      d.param("roughness").fold(1f): p =>
        if p.paramType != ParamType.Texture then p.floats.head * p.floats.head
        else
          // Many materials may have one image
          meanAlphas.getOrElseUpdate(
            p.strings.head,
            meanAlphaOf(extracted(textures(p.strings.head)))
          )

    private def meanAlphaOf(t: Declaration): Float =
      val scale = t.param("scale").fold(1f)(_.floats.head)
      val invert = t.param("invert").exists(_.bools.contains(true))
      val at = t.param("filename").get
      readable(at)(load(t, at)).fold(1f): image =>
        val x = grays(t, image.toImage).map(v => square(scale * (if invert then 1f - v else v)))
        x.sum / x.length

    private def bumps(d: Declaration): Vector[Param] =
      for p <- d.param("normalwrap") do
        warn(p, "pbrt repeats normal maps; this one, too")
      for p <- d.param("normalscale") do warn(p, "pbrt has no scale of normal maps; using 1")
      for p <- d.param("normalmapuv") do
        warn(p, "pbrt maps normal maps by u and v directly; the transform of this one is dropped")
      d.param("normalmap").toVector

    /** The width of the slopes is the square of the roughness. */
    private def roughness(d: Declaration): Vector[Param] =
      val squared = d.param("roughness").map: p =>
        if p.paramType != ParamType.Texture then
          Param.float("roughness", p.pos, p.floats.head * p.floats.head)
        else
          val name = s"${p.strings.head} squared"
          val square = Vector("tex", "scale").map(Param.texture(_, p.pos, p.strings.head))
          add(name, Declaration("Texture", "scale", square, p.pos, d.folder))
          Param.texture("roughness", p.pos, name)
      .getOrElse(Param.float("roughness", d.pos, 1f))
      Vector(squared, Param.bool("remaproughness", d.pos, false))
