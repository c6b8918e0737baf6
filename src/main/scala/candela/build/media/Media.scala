package candela.build.media

import candela.build.recipe.*
import candela.media.{Medium, Region}

/** Recipes of participating media: v3's and v4's. They make none where there would be nothing. */
object Media:
  val all: Recipes[Option[Medium]] = Recipes(
    "medium",
    Vector(
      HomogeneousRecipe, HeterogeneousRecipe, UniformGridRecipe, RgbGridRecipe, CloudRecipe,
      NanoVdbRecipe
    )
  )

/** Recipes of v2's volumes, which fill a box. */
object Volumes:
  val all: Recipes[Option[Region]] =
    Recipes("volume", Vector(HomogeneousVolumeRecipe, VolumeGridRecipe, ExponentialVolumeRecipe))
