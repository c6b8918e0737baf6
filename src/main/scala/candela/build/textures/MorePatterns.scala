package candela.build

import candela.color.Rgb
import candela.math.Vec3
import candela.textures.{FloatTexture, RgbTexture}

private val DotsMeaning = "a disk at a random place in about half of all unit squares"
private val DirectionMeaning = "blends two by the surface's direction"

object FloatDots extends Mapped[FloatTexture]("dots", DotsMeaning) with HalfFloat:
  declare(
    floatTexture("inside", "in the dots")(1f),
    floatTexture("outside", "between the dots")(0f)
  )

object RgbDots extends Mapped[RgbTexture]("dots", DotsMeaning) with HalfRgb:
  declare(
    rgbTexture("inside", "in the dots")(Rgb.White),
    rgbTexture("outside", "between the dots")(Rgb.Black)
  )

object RgbUv
    extends Mapped[RgbTexture]("uv", "texture coordinates as red and green", untilV3)
    with HalfRgb

object FloatDirectionMix
    extends Recipe[FloatTexture]("directionmix", DirectionMeaning, onlyV4)
    with HalfFloat:
  declare(
    floatTexture("tex1", "where the normal is along `dir`")(0f),
    floatTexture("tex2", "where it is at right angles")(1f),
    vector("dir", "the direction")(Vec3.Y)
  )

object RgbDirectionMix
    extends Recipe[RgbTexture]("directionmix", DirectionMeaning, onlyV4)
    with HalfRgb:
  declare(
    rgbTexture("tex1", "where the normal is along `dir`")(Rgb.Black),
    rgbTexture("tex2", "where it is at right angles")(Rgb.White),
    vector("dir", "the direction")(Vec3.Y)
  )
