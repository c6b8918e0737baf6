package candela.build.film

import candela.build.recipe.*

/** Recipes of the film. */
object Films:
  val all: Recipes[FilmSettings] =
    Recipes("film", Vector(ImageFilmRecipe, RgbFilmRecipe, GBufferFilmRecipe, SpectralFilmRecipe))
