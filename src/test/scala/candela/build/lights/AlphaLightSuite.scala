package candela.build.lights

import candela.scenefile.Dialect
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

class AlphaLightSuite extends AnyFunSuite:
  private def scene(alpha: String): String =
    s"""Film "rgb" "integer xresolution" 8 "integer yresolution" 8
       |PixelFilter "box"
       |Sampler "independent" "integer pixelsamples" 256
       |Integrator "path" "integer maxdepth" 1
       |LookAt 0 0 3  0 0 0  0 1 0
       |Camera "perspective" "float fov" 20
       |WorldBegin
       |AreaLightSource "diffuse" "rgb L" [1 1 1]
       |Shape "trianglemesh" "point3 P" [-9 -9 0  9 -9 0  0 9 0] "integer indices" [0 1 2]
       |  "float alpha" $alpha
       |""".stripMargin

  for (alpha, expected) <- Seq(".5" -> .25, ".75" -> .5625) do
    test(s"rays that meet a light of alpha $alpha see its square, as in pbrt-v4"):
      val seen = SceneTexts.mean(scene(alpha), Dialect.V4)
      // 16,384 samples: a standard deviation of 0.003 at most
      assert(Math.abs(seen.g - expected) < 0.012)
