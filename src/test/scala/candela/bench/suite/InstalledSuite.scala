package candela.bench.suite

import candela.testing.TempFolder

import java.nio.file.{Files, Path}
import java.nio.file.attribute.PosixFilePermissions

import org.scalatest.funsuite.AnyFunSuite

/** Programs of the shell stand for renderers. */
class InstalledSuite extends AnyFunSuite:

  private def script(file: Path, text: String): Path =
    Files.writeString(file, s"#!/bin/sh\n$text\n"): Unit
    Files.setPosixFilePermissions(file, PosixFilePermissions.fromString("rwxr-xr-x"))

  test("a variable may hold a command of several words, and comes before the path"):
    TempFolder.use: folder =>
      script(folder.resolve("pbrt-v3"), ""): Unit
      val path = "PATH" -> folder.toString
      assert(Installed(Map(path, "PBRT_V3" -> " nice  pbrt ")).pbrt(3) ==
        Right(Present(Vector("nice", "pbrt"), Some("PBRT_V3"))))
      assert(Installed(Map(path)).pbrt(3) ==
        Right(Present(Vector(folder.resolve("pbrt-v3").toString), None)))

  test("a variable that is empty names nothing"):
    val none = Installed(Map("PATH" -> "", "PBRT_V4" -> " ", "MITSUBA_LLVM" -> ""))
    assert(none.pbrt(4).left.map(_.title) == Left("pbrt-v4"))
    assert(none.mitsubaLlvm.isEmpty)

  test("pbrt is told by the options that its help names"):
    TempFolder.use: folder =>
      script(folder.resolve("pbrt"), "echo usage: pbrt --ncores"): Unit
      val all = Installed(Map("PATH" -> folder.toString))
      assert(Vector(2, 3, 4).map(all.pbrt(_).isRight) == Vector(true, false, false))

  test("Mitsuba is found beside Python, and a library by its packages"):
    TempFolder.use: folder =>
      val python = script(folder.resolve("python"), "echo \"['numpy', 'embreex']\"")
      val mitsuba = script(folder.resolve("mitsuba"), "")
      val all = Installed(Map("PATH" -> "", Installed.Python -> python.toString))
      assert(all.mitsuba == Right(Present(Vector(mitsuba.toString), None)))
      assert(all.library("Embree", "embreex", "numpy").isEmpty)
      assert(all.library("Cycles", "bpy", "numpy").get.obtain.contains("`pip install bpy numpy`"))
