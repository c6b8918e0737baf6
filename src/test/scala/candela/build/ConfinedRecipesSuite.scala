package candela.build

import candela.diagnostics.{Refusal, SceneError}
import candela.io.SceneFolder
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.build.recipe.Support
import candela.scenefile.{Dialect, Parser}
import candela.settings.RenderSettings
import candela.testing.TempFolder

/** Every parameter of every recipe that names a file asks the scene's folder for it. A new string
  * must be one of `Words`, or be refused when it leads out of a confined folder.
  */
class ConfinedRecipesSuite extends AnyFunSuite:
  import ConfinedRecipesSuite.*

  private val asked =
    for
      c <- Language.categories
      r <- c.recipes.all if r.substitute.isEmpty
      f <- r.fields if f.typeName.startsWith("string") && r.support(f) == Support.Used
      d <- Dialect.ofPbrt if r.dialects(d) && f.dialects(d)
      if !Words(f.name) && !Elsewhere((c.name, f.name))
    yield (c.name, r, f, d)

  test("there are such parameters"):
    assert(asked.size > 20, asked.map((c, r, f, _) => s"$c ${r.name} ${f.name}"))

  for (category, recipe, field, dialect) <- asked do
    test(s"$category \"${recipe.name}\" of $dialect reads `${field.name}` through the door"):
      TempFolder.use: folder =>
        val outside = Files.writeString(folder.resolve("outside"), "SECRET")
        val home = Files.createDirectory(folder.resolve("home"))
        val text = scene(category, recipe.name, s"\"string ${field.name}\" \"$outside\"", dialect)
        val file = Files.writeString(home.resolve("s.pbrt"), text)
        val refusal = intercept[Confined](confined(file, dialect))
        assert(refusal.message.contains("expected a file in the scene's folder"), refusal.message)

object ConfinedRecipesSuite:
  /** Strings that are no files. */
  private val Words = Set(
    "aamode", "basis", "coordinatesystem", "distribution", "encoding", "filter", "gridname",
    "lightsampler", "lightsamplestrategy", "mapping", "material", "materials", "method", "name",
    "namedmaterial1", "namedmaterial2", "phases", "preset", "rendercoordsys", "sensor", "strategy",
    "temperaturename", "type", "wrap"
  )

  /** Outputs, and files that need another parameter: [[candela.cli.SandboxSuite]] has them. */
  private val Elsewhere = Set(
    "Film" -> "filename",
    "Camera" -> "aperture",
    "Option" -> "msereferenceimage",
    "Option" -> "msereferenceout"
  )

  private final class Confined(val message: String) extends RuntimeException(message)

  private def confined(file: Path, dialect: Dialect): Unit =
    try
      val folder = SceneFolder.of(file, isConfined = true)
      val scene = Parser.readable(file, Some(dialect), keepGoing = false, within = Some(folder))
      SceneBuilder.build(Parser.validated(scene), RenderSettings()): Unit
    catch
      case r: Refusal => throw Confined(r.problem.message)
      case e: SceneError => throw Confined(e.getMessage)

  private def scene(category: String, name: String, param: String, dialect: Dialect): String =
    val end = if dialect == Dialect.V4 then "" else "WorldEnd\n"
    val (before, world) = category match
      case "Camera" => (s"Camera \"$name\" $param", "")
      case "MakeNamedMedium" =>
        val medium = s"MakeNamedMedium \"m\" \"string type\" \"$name\" $param"
        ("Integrator \"volpath\"", s"$medium\nMediumInterface \"m\" \"\"")
      case "Texture (float)" => ("", s"Texture \"t\" \"float\" \"$name\" $param")
      case "Texture (spectrum)" => ("", s"Texture \"t\" \"spectrum\" \"$name\" $param")
      case statement => ("", s"$statement \"$name\" $param")
    s"$before\nWorldBegin\n$world\nShape \"sphere\"\n$end"
