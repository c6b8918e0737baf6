package candela.cli.options

import candela.guiding.GuidingMode
import candela.integrators.CausticsMode
import candela.settings.{RenderSettings, SettingsCodec}

import org.scalatest.funsuite.AnyFunSuite

class FilmHeadersSuite extends AnyFunSuite:

  /** Options of `render` that shape the image, with examples. */
  private val shaping: Map[String, Vector[String]] = Map(
    "seed" -> Vector("7", "-3"),
    "quick" -> Vector(""),
    "cropwindow" -> Vector("0,0.5,0.25,1", "0.00001,1,0,1"),
    "aov" -> Vector("depth", "albedo,normal", "depth:half,albedo,normal:float"),
    "light-groups" -> Vector("type", "statement", "key=point_3+spot_4,sky=infinite"),
    "film" -> Vector("gbuffer", "rgba"),
    "dialect" -> Vector("v3"),
    "define" -> Vector("spp=16"),
    "keep-going" -> Vector(""),
    "sensor" -> Vector("0", "3", "all"),
    "resolution" -> Vector("640x360", "640", "50%"),
    "light" -> Vector("studio", "sky", "a b.exr"),
    "background" -> Vector("none", "0.5,0,1"),
    "turntable" -> Vector("1", "36"),
    "at" -> Vector("1.5", "0s", "0:0.5:2"),
    "animation" -> Vector("Walk", "1"),
    "variant" -> Vector("red shoe"),
    "camera" -> Vector("a b.pbrt"),
    "up" -> Vector("y", "z"),
    "color" -> Vector("rgb", "spectral"),
    "sampler" -> Vector("scene", "progressive", "halton", "stratified"),
    "fireflies" -> Vector("reweight", "clamp:2.5"),
    "store-time" -> Vector(""),
    "tonemap" -> Vector("filmic", "aces"),
    "exposure" -> Vector("auto", "-2", "1.5"),
    "falsecolor" -> Vector(""),
    "bits" -> Vector("16"),
    "dither" -> Vector(""),
    "denoise" -> Vector(""),
    "pixelbounds" -> Vector("3,9,-2,5"),
    "pixel" -> Vector("7,8"),
    "disable-pixel-jitter" -> Vector(""),
    "disable-texture-filtering" -> Vector(""),
    "disable-image-textures" -> Vector(""),
    "disable-wavelength-jitter" -> Vector(""),
    "force-diffuse" -> Vector(""),
    "caustics" -> CausticsMode.values.toVector.filter(_ != CausticsMode.Off)
      .map(_.toString.toLowerCase),
    "guiding" -> GuidingMode.values.toVector.filter(_ != GuidingMode.Off)
      .map(_.toString.toLowerCase),
    "sky" -> Vector("show", "hide"),
    "displacement-edge-scale" -> Vector("2.5")
  )

  /** Saved by themselves, or without an effect on the image. */
  private val others = Set("spp", "outfile", "shard") ++
    Set(
      "nthreads", "pixelmaterial", "sample", "debug", "mse-reference-image", "mse-reference-out",
      "write-partial-images", "report", "reference", "explain", "quiet", "verbose"
    ) ++
    Set(
      "spark", "shards", "checkpoint", "checkpoint-every", "frames", "skip-done", "time", "error",
      "thumbnail", "watch", "watch-after", "display-server", "sandbox", "limit",
      "texture-memory", "texture-cache", "texture-cache-size", "scene-cache"
    )

  test("every option of render is known to shape the image or not to"):
    assert(CommandTable.of(Command.Render).names.toSet == shaping.keySet ++ others)

  private def options(words: Vector[String]) =
    CommandLine.parse("render" +: words :+ "s.pbrt").toOption.get

  test("the options that shape the image are saved, and read again as they were"):
    for (name, values) <- shaping; value <- values do
      val asked = options(s"--$name" +: Option(value).filter(_.nonEmpty).toVector).settings
      val saved = SettingsCodec.identity(asked)
      assert(saved.nonEmpty, name)
      assert(SettingsCodec.settings(saved) == Right(asked), saved)

  test("saved settings are the words of the options that ask for them"):
    for (name, values) <- shaping; value <- values do
      val asked = options(s"--$name" +: Option(value).filter(_.nonEmpty).toVector).settings
      assert(options(SettingsCodec.identity(asked)).settings == asked, name)

  test("without options nothing is saved"):
    assert(SettingsCodec.identity(RenderSettings()).isEmpty)
