package candela.cluster

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import java.io.IOException
import java.nio.file.{Files, Path}

class BundleSuite extends AnyFunSuite:

  private def write(folder: Path, name: String, size: Int): Path =
    val file = folder.resolve(name)
    val _ = Files.createDirectories(file.getParent)
    Files.write(file, Array.tabulate(size)(i => (i * 7 + name.length).toByte))

  test("a bundle becomes the same files, in folders that relate as before"):
    TempFolder.use: folder =>
      val scene = write(folder, "a/b/s.pbrt", 100)
      val others = Vector(write(folder, "a/b/t/x.png", 40_000_000), write(folder, "a/c/y.ply", 0))
      val bundle = Bundle.of(scene, scene +: others)
      assert(bundle.parts.size == 3 && bundle.scene == "b/s.pbrt")
      val copy = bundle.unpack(folder.resolve("copy"))
      assert(Files.mismatch(copy, scene) == -1)
      assert(Files.mismatch(copy.resolveSibling("t/x.png"), others(0)) == -1)
      assert(Files.mismatch(copy.getParent.resolve("../c/y.ply"), others(1)) == -1)

  test("equal files are equal bundles, and a wrong byte is noticed"):
    TempFolder.use: folder =>
      val scene = write(folder, "a/s.pbrt", 1000)
      val other = write(folder, "b/s.pbrt", 1000)
      val bundle = Bundle.of(scene, Vector(scene))
      assert(Bundle.of(other, Vector(other)).digest == bundle.digest)
      bundle.parts.head(500) = (bundle.parts.head(500) + 1).toByte
      val failure = intercept[IOException](bundle.unpack(folder.resolve("copy")))
      assert(failure.getMessage == "the bundle of s.pbrt is damaged")

  test("films travel in chunks, in any order"):
    TempFolder.use: folder =>
      val sizes = Vector(10_000_000, 5)
      val chunks = sizes.zipWithIndex.flatMap: (size, i) =>
        FilmChunks.read(i, write(folder, s"$i.film", size)).toVector
      assert(chunks.size == 4 && !Files.exists(folder.resolve("0.film")))
      val into = Files.createDirectories(folder.resolve("into"))
      val films = FilmChunks.write(chunks.reverseIterator, into)
      for (film, i) <- films.zipWithIndex do
        assert(Files.mismatch(film, write(folder, s"$i.film", sizes(i))) == -1)
