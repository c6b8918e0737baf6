package candela.cli.options

import candela.cli.{Captured, Main}
import candela.testing.TempFolder

import java.nio.file.Files

import org.scalatest.funsuite.AnyFunSuite

/** Options that have no effect say so. */
class IdleOptionsSuite extends AnyFunSuite:

  private def notes(line: String): Vector[String] =
    CommandLine.parse(line.split(' ').toVector).fold(a => fail(a.err), _.notes)

  private val idle = Vector(
    "a.pbrt --sample 3" -> "--sample has no effect without --debug",
    "a.pbrt --quick --resolution 64x48 --spp 4" ->
      "--quick has no effect beside --resolution and --spp",
    "a.pbrt --checkpoint-every 5s" ->
      "--checkpoint-every has no effect without --checkpoint or --outfile FILE.film",
    "a.pbrt --debug --pixel 1,1 -o x.exr" ->
      "--outfile has no effect: --debug renders no image",
    "a.pbrt --pixelmaterial 1,1 --time 3s" ->
      "--time has no effect: --pixelmaterial renders no image",
    "a.xml --dialect v4" ->
      "--dialect has no effect: Mitsuba scenes have no pbrt dialect",
    "a.pbrt -o x.film --write-partial-images" ->
      "--write-partial-images has no effect: only a film is written",
    "a.pbrt -o x.exr --tonemap aces" ->
      "--tonemap has no effect: .exr files store linear light",
    "a.pbrt -o x.exr,x.pfm --exposure 2" ->
      "--exposure has no effect: .exr and .pfm files store linear light",
    "a.pbrt -o x.exr --dither" -> "--dither has no effect: .exr files store linear light",
    "a.pbrt -o x.jpg --bits 16" -> "--bits has no effect: only .png files may have 16",
    "a.pbrt -o x.png --bits 16 --dither" -> "--dither has no effect on 16 bits",
    "a.pbrt -o x.tga --store-time" -> "--store-time has no effect: .tga files store no metadata",
    "image a.exr -o x.png --half" -> "--half has no effect: only .exr files have it",
    "image a.exr -o x.png --colorspace rec2020" ->
      "--colorspace has no effect: only .exr files have it",
    "compare a.exr b.exr --heatmap-max 3" -> "--heatmap-max has no effect without --heatmap",
    "compare a.exr b.exr --heatmap-metric mse" ->
      "--heatmap-metric has no effect without --heatmap",
    "compare a.exr b.exr --heatmap h.exr --heatmap-max 3" ->
      "--heatmap-max has no effect: the map holds numbers, not colours",
    "describe film --markdown" -> "`film` has no effect: --markdown prints a whole page",
    "describe --pbrt-options --dialect v3" -> "--dialect has no effect with --pbrt-options",
    "bench s.conf --report x.csv --no-pictures" ->
      "--no-pictures has no effect: only .html files have pictures",
    "bench s.conf --references r" -> "--references has no effect: a suite names its own"
  )

  for (line, note) <- idle do
    test(s"`$line` says: $note"):
      assert(notes(line) == Vector(note))

  test("options that have an effect say nothing"):
    val lines = Vector(
      "a.pbrt --tonemap aces --bits 16 --exposure 1",
      "a.pbrt --quick --resolution 64x48",
      "a.pbrt --quick --spp 4",
      "a.pbrt -o x.exr,x.png --tonemap aces --bits 16 --dither",
      "a.pbrt -o x.exr --tonemap aces --thumbnail blocks",
      "a.pbrt -o x.exr --falsecolor --watch",
      "a.pbrt --debug --pixel 1,1 --sample 3",
      "a.pbrt --checkpoint --checkpoint-every 5s",
      "a.pbrt -o x.film --checkpoint-every 5s",
      "a.pbrt b.xml --dialect v3",
      "image a.exr -o x.exr,x.png --half --colorspace rec2020",
      "compare a.exr b.exr --heatmap h.png --heatmap-max 3 --heatmap-metric mse",
      "describe film --dialect v3",
      "view a.exr --tonemap aces"
    )
    for line <- lines do assert(notes(line).isEmpty, line)

  private def warnings(integrator: String, words: String*): Vector[String] =
    TempFolder.use: folder =>
      val scene = Files.writeString(
        folder.resolve("a.pbrt"),
        s"""Film "rgb" "integer xresolution" 2 "integer yresolution" 2
           |Sampler "independent" "integer pixelsamples" 1
           |Camera "perspective"
           |Integrator $integrator
           |WorldBegin
           |LightSource "infinite" "rgb L" [1 1 1]
           |Translate 0 0 5 Shape "sphere"
           |""".stripMargin
      )
      val captured = Captured()
      val all = Vector(scene.toString, "-o", s"$folder/a.exr") ++ words
      assert(Main.run(all, captured.terminal) == 0, captured.err)
      captured.err.linesIterator.filter(_.contains("warning: ")).toVector
        .map(_.split("warning: ", 2)(1).replaceAll(" \\[E\\d{4}\\]$", ""))

  private val mlt = "\"mlt\" \"integer mutationsperpixel\" 1 \"integer bootstrapsamples\" 64"

  test("--guiding is for integrators that can be guided; others say so"):
    val others = Vector("bdpt", "sppm", "simplepath", "randomwalk", "ambientocclusion", "lightpath")
    for name <- others do
      assert(warnings(s"\"$name\"", "--guiding", "on") == Vector(
        s"--guiding has no effect: \"$name\" is not guided; \"path\" and \"volpath\" are"
      ))
    assert(warnings(mlt, "--guiding", "on").exists(_.startsWith("--guiding has no effect")))
    for name <- Vector("path", "volpath") do
      assert(warnings(s"\"$name\"", "--guiding", "on").isEmpty, name)

  test("points of samplers are not for Markov chains, which say so"):
    for option <- Vector(Vector("--sampler", "halton"), Vector("--disable-pixel-jitter")) do
      val note =
        s"${option.head} has no effect: the Markov chains of \"mlt\" take no points of a " +
          "sampler"
      assert(warnings(mlt, option*).contains(note))
      assert(warnings("\"path\"", option*).isEmpty)

  test("wavelengths and displacements that a scene has not are no matter of options"):
    val colors = warnings("\"path\"", "--disable-wavelength-jitter")
    val note = "--disable-wavelength-jitter has no effect: rendering is RGB"
    assert(colors.exists(_.startsWith(note)))
    assert(warnings("\"path\"", "--color", "spectral", "--disable-wavelength-jitter").isEmpty)
    val edges = warnings("\"path\"", "--displacement-edge-scale", "2")
    assert(edges == Vector("--displacement-edge-scale has no effect: no mesh is displaced"))
