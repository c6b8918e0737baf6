package candela.image

import java.nio.file.Files

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

class NativesSuite extends AnyFunSuite:

  test("native libraries are found beside the program's jar"):
    TempFolder.use: folder =>
      val jar = folder.resolve("candela.jar")
      assert(Natives.beside(jar).isEmpty)
      val place = Files.createDirectories(folder.resolve("natives").resolve(Natives.platform))
      assert(Natives.beside(jar) == Some(place))

  test("missing libraries are told, other errors are not taken for them"):
    val missing = UnsatisfiedLinkError("Failed to locate library: liblwjgl.so")
    val (what, help) = Natives.missing(missing).get
    assert(what.contains("native libraries") && help.contains("org.lwjgl.librarypath=FOLDER"))
    val later = NoClassDefFoundError("Could not initialize class org.lwjgl.stb.STBImage")
    assert(Natives.missing(later).isDefined)
    assert(Natives.missing(NoClassDefFoundError("candela/Foo")).isEmpty)
    // As the JVM says it
    val elsewhere =
      UnsatisfiedLinkError("Native Library /x/liblwjgl.so already loaded in another classloader")
    assert(Natives.missing(elsewhere).get._1.contains("belong to another class loader"))
    assert(Natives.missing(RuntimeException("lwjgl")).isEmpty)

  test("who lacks a native library is told which dependency has it, before LWJGL prints advice"):
    val missing = intercept[MissingNatives](Natives.require("nothing"))
    assert(missing.getMessage.contains(s"lwjgl_nothing for ${Natives.platform}"))
    val classifier = s"natives-${Natives.platform.stripSuffix("-x64")}"
    assert(missing.help.startsWith("add org.lwjgl:lwjgl-nothing:3."))
    assert(missing.help.contains(s"with the classifier $classifier to the dependencies"))
    Vector("", "stb", "tinyexr").foreach(Natives.require)
    assert(Natives.missing(missing).isDefined)
