import candela.api.Candela
import candela.api.Parameters
import candela.api.RenderControl
import candela.api.RenderSettings
import candela.api.Scene
import java.nio.file.Path
import java.util.Locale
import kotlin.system.exitProcess

/** Renders a scene that is made here, and one of a file; prints their means and errors. */
fun main(args: Array<String>) {
    println("built: " + measured(ball()))
    println("read: " + measured(read(Path.of(args[0]))))
}

private fun with(): Parameters = Parameters.create()

/** A red ball under a grey sky. */
fun ball(): Scene = Candela.build()
    .film("rgb", with().integer("xresolution", 64).integer("yresolution", 48))
    .lookAt(0.0, 1.0, -5.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    .camera("perspective", with().number("fov", 40.0))
    .sampler("zsobol", with().integer("pixelsamples", 16))
    .integrator("volpath", with().integer("maxdepth", 5))
    .world()
    .light("infinite", with().rgb("L", 0.5, 0.5, 0.5))
    .attributes {
        it.material("diffuse", with().rgb("reflectance", 0.8, 0.2, 0.1))
            .shape("sphere", with().number("radius", 1.0))
    }
    .scene()

/** A scene that has no errors. */
fun read(file: Path): Scene {
    val scene = Candela.read(file)
    scene.problems().forEach { System.err.println(it) }
    if (scene.hasErrors()) exitProcess(1)
    return scene
}

fun measured(scene: Scene): String =
    scene.prepare(RenderSettings.create().withSamples(16)).use { job ->
        val result = job.render(RenderControl.create().withThreads(2).withErrorEstimates())
        val error = 100 * result.error().asDouble
        "mean %.4f, error %.2f %%".format(Locale.ROOT, result.image().mean("R"), error)
    }
