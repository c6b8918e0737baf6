package candela.cli.rendering

import candela.cli.Captured
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** `--report`, from the scene's text to the files. */
class ReportingSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run(args*)

  private val scene =
    """LookAt 0 0 -4  0 0 0  0 1 0
      |Camera "perspective" "float fov" 40
      |Film "rgb" "integer xresolution" 24 "integer yresolution" 16 "string filename" "s.exr"
      |Sampler "independent" "integer pixelsamples" 4
      |Integrator "path" "integer maxdepth" 3
      |WorldBegin
      |LightSource "infinite" "rgb L" [ 0.2 0.3 0.4 ]
      |Shape "sphere" "float radius" 1
      |""".stripMargin

  private def withScene[A](body: (Path, String) => A): A =
    TempFolder.use: folder =>
      body(folder, Files.writeString(folder.resolve("s.pbrt"), scene).toString)

  test("the image is the same with and without a report, bit for bit"):
    withScene: (folder, file) =>
      val (a, b, c) = (folder.resolve("a.exr"), folder.resolve("b.exr"), folder.resolve("c.exr"))
      assert(run(file, "--outfile", a.toString)._1 == 0)
      val reports = Vector("html", "json", "csv").map(e => folder.resolve(s"r.$e"))
      val (code, captured) = run(file, "--outfile", b.toString, "--report", reports.mkString(","))
      assert(code == 0)
      val judged = Vector("--report", s"$folder/x.csv", "--reference", s"$a")
      assert(run(Vector(file, "--outfile", c.toString) ++ judged*)._1 == 0)
      for other <- Vector(b, c) do
        assert(ImageFiles.read(a).data.sameElements(ImageFiles.read(other).data))
      assert(captured.out.linesIterator.toVector.tail == reports.map(r => s"wrote $r"))
      val csv = Files.readAllLines(reports(2))
      // Estimates begin with the second sample; there is nobody to say what the mean should be.
      assert(csv.size == 3 && csv.get(1).startsWith("2,"))
      val last = csv.get(2).split(",", -1)
      assert(last.slice(4, 10).forall(_.isEmpty))
      // The limits of the relative MSE; of so few pixels there may be no upper one
      assert(last(10).toDouble < last(3).toDouble)
      assert(last(11).toDoubleOption.forall(_ > last(3).toDouble))
      val known = Files.readAllLines(folder.resolve("x.csv"))
      assert(known.get(3).split(',')(2).toDouble < rounding)
      assert(known.size == 4 && known.get(3).startsWith("4,"))

  /** Images of v4 have 16 bits: they are off by 2⁻¹¹ of their values. */
  private val rounding = 1e-6

  test("a reference of another size, and files of another kind, are said before rendering"):
    withScene: (folder, file) =>
      ImageFiles.write(folder.resolve("small.exr"), Image.rgb(3, 2))
      val report = Vector("--report", s"$folder/r.json")
      val (code, small) = run(Vector(file, "--reference", s"$folder/small.exr") ++ report*)
      assert(code == 1)
      assert(small.err.contains("small.exr` must be 24×16 pixels, found 3×2"))
      val (_, kind) = run(file, "--report", s"$folder/r.pdf")
      assert(kind.err.contains("reports are written as .html, .json or .csv"))
      val (_, nowhere) = run(file, "--report", s"$folder/none/r.html")
      assert(nowhere.err.contains("no such folder"))
      assert(TempFolder.names(folder) == Set("s.pbrt", "small.exr"))

  test("a file that can't be written prevents no other one, and fails the command"):
    withScene: (folder, file) =>
      assume(Files.exists(Path.of("/dev/full")), "needs a device that is always full")
      def full(name: String) =
        Files.createSymbolicLink(folder.resolve(name), Path.of("/dev/full")).toString
      def fails(names: String*)(words: String*) =
        val (code, captured) = run(words*)
        assert(code == 1)
        for name <- names do
          val why = s"can't write `$folder/$name`: No space left on device"
          assert(captured.err.contains(why), captured.err)
        captured
      val first = s"$folder/a.exr"
      assert(run(file, "--outfile", first)._1 == 0)
      val (csv, log) = (full("r.csv"), full("log"))
      val reports = s"$csv,$folder/r.html,$folder/r.json"
      val errors = Vector("--mse-reference-image", first, "--mse-reference-out", log)
      val words = Vector(file, "--outfile", s"$folder/b.exr", "--report", reports) ++ errors
      val captured = fails("r.csv", "log")(words*)
      assert(captured.out.endsWith(s"\nwrote $folder/r.html\nwrote $folder/r.json\n"))
      val (a, b) = (ImageFiles.read(Path.of(first)), ImageFiles.read(folder.resolve("b.exr")))
      assert(a.data.sameElements(b.data))
      val picture = full("p.png")
      def outputs(name: String) = Vector("--outfile", s"$picture,$folder/$name.png")
      fails("p.png")(Vector("view", first) ++ outputs("view")*)
      fails("p.png")(Vector("image", first) ++ outputs("image")*)
      fails("p.png")(Vector("average", first, first) ++ outputs("average")*)
      val map = s"$folder/map.png"
      fails("p.png")("compare", first, first, "--difference", picture, "--heatmap", map)
      val written = TempFolder.names(folder)
      for name <- Vector("r.html", "r.json", "view.png", "image.png", "average.png", "map.png") do
        assert(written(name), name)

  test("of a cropped rendering the reference is cropped, too"):
    withScene: (folder, file) =>
      val (whole, part) = (folder.resolve("w.exr"), folder.resolve("p.exr"))
      assert(run(file, "--outfile", whole.toString)._1 == 0)
      val words = Vector(file, "--outfile", s"$part", "--cropwindow", "0.25,0.75,0.5,1") ++
        Vector("--reference", s"$whole", "--report", s"$folder/r.csv")
      assert(run(words*)._1 == 0)
      val last = Files.readAllLines(folder.resolve("r.csv")).get(3).split(',')
      assert(last(0) == "4" && last(2).toDouble < rounding)
