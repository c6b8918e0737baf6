package candela.base

import org.scalatest.funsuite.AnyFunSuite

import java.io.IOException
import java.nio.file.Files

import candela.cli.TempFolder

class WholeFileSuite extends AnyFunSuite:

  test("what is written takes the place of what was there"):
    TempFolder.use: folder =>
      val path = folder.resolve("a")
      WholeFile.write(path, Array[Byte](1, 2))
      WholeFile.write(path, Array[Byte](3))
      assert(Files.readAllBytes(path).sameElements(Array[Byte](3)))
      assert(TempFolder.names(folder) == Set("a"))

  test("a write that fails leaves what was there, and nothing else"):
    TempFolder.use: folder =>
      val path = folder.resolve("a")
      WholeFile.write(path, Array[Byte](1, 2))
      intercept[IOException]:
        WholeFile.write(path): file =>
          val _ = Files.write(file, Array[Byte](3))
          throw IOException("full")
      assert(Files.readAllBytes(path).sameElements(Array[Byte](1, 2)))
      intercept[IOException](WholeFile.write(folder, Array[Byte](1)))
      assert(TempFolder.names(folder) == Set("a"))
