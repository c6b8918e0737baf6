package candela.build.recipe

import candela.image.ImageBands
import candela.lights.Fade
import candela.math.GridEdge
import candela.scenefile.Dialect
import candela.shapes.DiskU
import candela.textures.{TexelBands, Texels}

/** How a program renders what scenes of its dialect say, where the programs differ and the words
  * don't: one value for each dialect. Mitsuba's and glTF's hold for all statements of their scenes.
  *
  * @param dialect   whose rules these are
  * @param program   the name of the program, in messages
  * @param isSpectral whether spectra are multiplied, rather than three numbers
  * @param typed     whether parameters of another type than expected are not found
  * @param filters   whether textures are filtered over the footprints of rays
  * @param toNumber  reads the numbers of an image from its colours
  * @param decodesAll whether `encoding` holds for all images of 8 bits, not for PNG alone
  * @param decodesNormals whether normal maps of 8 bits are decoded, but for PNG
  * @param decodesLights whether images of lights are decoded
  * @param flatMaps  whether the pixels of environment maps are even in latitude, not in area
  * @param bumps     how normals are perturbed
  * @param separates whether microfacets mask and shadow separately
  * @param plainMetals whether the indices of metals are three numbers, where colours are
  * @param gains     whether a diffuse reflectance may be above 1
  * @param clips     whether cameras clip
  * @param diskU     what u of a disk follows
  * @param gridEdge  the values beyond a grid's outermost cells
  * @param fade      of spotlights, towards the edge of the cone
  * @param fovOfWidth whether the field of view of a projected image is that of its width
  * @param glows     whether a shape that is only a border of media may emit
  * @param facesEmitters whether samples of emitters lie on the side that rays see
  * @param passes    whether light passes panes and openings of masks unscattered, and what it meets
  *                  there counts as passed
  * @param opens     whether light passes interfaces of media, also where integrators ignore media
  * @param goesBeneath whether `path` follows light beneath surfaces
  * @param skyCovers whether the sky is opaque
  * @param coversByAlpha whether alpha is how much of a surface is there: a ray passes each by a
  *   chance of its own, and light of the surface is scaled once
  * @param defaultsToIndependent whether independent samples are what scenes have that don't choose
  */
final case class Rules(
    dialect: Dialect,
    program: String,
    isSpectral: Boolean = false,
    typed: Boolean = true,
    filters: Boolean = true,
    toNumber: (ImageBands, Float => Float) => TexelBands = Texels.luminance,
    decodesAll: Boolean = false,
    decodesNormals: Boolean = true,
    decodesLights: Boolean = false,
    flatMaps: Boolean = false,
    bumps: Bumps = Bumps.Displaced,
    separates: Boolean = false,
    plainMetals: Boolean = false,
    gains: Boolean = false,
    clips: Boolean = false,
    diskU: DiskU = DiskU.Angle,
    gridEdge: GridEdge = GridEdge.Zero,
    fade: Fade = Fade.Quartic,
    fovOfWidth: Boolean = false,
    glows: Boolean = true,
    facesEmitters: Boolean = false,
    passes: Boolean = false,
    opens: Boolean = false,
    goesBeneath: Boolean = false,
    skyCovers: Boolean = false,
    coversByAlpha: Boolean = false,
    defaultsToIndependent: Boolean = false
)

/** How bumps and normal maps perturb normals. */
enum Bumps:
  /** As if the surface were displaced, on the side of the geometric normal: pbrt. */
  case Displaced

  /** By the slopes at the point; normals that face away are turned, and light close to the surface
    * fades: Mitsuba.
    */
  case Sloped

object Rules:
  def of(dialect: Dialect): Rules = dialect match
    case Dialect.V2 => v2
    case Dialect.V3 => v3
    case Dialect.V4 => v4
    case Dialect.Mitsuba => mitsuba
    case Dialect.Gltf => gltf

  private val v2 = Rules(Dialect.V2, "pbrt-v2", gridEdge = GridEdge.Clamped)
  private val v3 = Rules(Dialect.V3, "pbrt-v3", goesBeneath = true)

  private val v4 = Rules(
    Dialect.V4,
    "pbrt-v4",
    isSpectral = true,
    toNumber = Texels.meanOrAlpha,
    decodesLights = true,
    fade = Fade.Cubic,
    glows = false
  )

  private val mitsuba = Rules(
    Dialect.Mitsuba,
    "Mitsuba",
    typed = false,
    filters = false,
    toNumber = Texels.decodedLuminance,
    decodesAll = true,
    decodesNormals = false,
    decodesLights = true,
    flatMaps = true,
    bumps = Bumps.Sloped,
    separates = true,
    plainMetals = true,
    gains = true,
    clips = true,
    diskU = DiskU.Radius,
    gridEdge = GridEdge.Clamped,
    fade = Fade.Linear,
    fovOfWidth = true,
    facesEmitters = true,
    passes = true,
    goesBeneath = true,
    skyCovers = true,
    coversByAlpha = true,
    defaultsToIndependent = true
  )

  private val gltf = Rules(
    Dialect.Gltf,
    "glTF",
    filters = false,
    toNumber = Texels.decodedLuminance,
    decodesAll = true,
    decodesNormals = false,
    decodesLights = true,
    bumps = Bumps.Sloped,
    plainMetals = true,
    clips = true,
    fade = Fade.Square,
    facesEmitters = true,
    opens = true,
    coversByAlpha = true
  )
