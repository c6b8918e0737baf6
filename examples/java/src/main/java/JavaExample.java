import candela.api.Candela;
import candela.api.Parameters;
import candela.api.RenderControl;
import candela.api.RenderSettings;
import candela.api.Scene;

import java.nio.file.Path;
import java.util.Locale;

/** Renders a scene that is made here, and one of a file; prints their means and errors. */
public final class JavaExample {

  public static void main(String[] args) {
    System.out.println("built: " + measured(ball()));
    System.out.println("read: " + measured(read(Path.of(args[0]))));
  }

  /** A red ball under a grey sky. */
  static Scene ball() {
    return Candela.build()
        .film("rgb", with().integer("xresolution", 64).integer("yresolution", 48))
        .lookAt(0, 1, -5, 0, 0, 0, 0, 1, 0)
        .camera("perspective", with().number("fov", 40))
        .sampler("zsobol", with().integer("pixelsamples", 16))
        .integrator("volpath", with().integer("maxdepth", 5))
        .world()
        .light("infinite", with().rgb("L", 0.5, 0.5, 0.5))
        .attributes(ball -> ball
            .material("diffuse", with().rgb("reflectance", 0.8, 0.2, 0.1))
            .shape("sphere", with().number("radius", 1)))
        .scene();
  }

  private static Parameters with() {
    return Parameters.create();
  }

  /** A scene that has no errors. */
  static Scene read(Path file) {
    Scene scene = Candela.read(file);
    scene.problems().forEach(System.err::println);
    if (scene.hasErrors()) System.exit(1);
    return scene;
  }

  static String measured(Scene scene) {
    var settings = RenderSettings.create().withSamples(16);
    try (var job = scene.prepare(settings)) {
      var result = job.render(RenderControl.create().withThreads(2).withErrorEstimates());
      double mean = result.image().mean("R");
      double error = 100 * result.error().getAsDouble();
      return String.format(Locale.ROOT, "mean %.4f, error %.2f %%", mean, error);
    }
  }
}
