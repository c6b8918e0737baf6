package candela.models

import candela.build.SceneBuilder
import candela.render.Renderer
import candela.scenefile.Resolution
import candela.settings.{ReadSettings, RenderSettings}

import org.scalatest.funsuite.AnyFunSuite

/** Alpha as how much of a surface is there. */
class CoverageSuite extends AnyFunSuite, GltfModels:

  test("a surface that is there in part has that part of its light"):
    val others = """,
      "materials":[{"alphaMode":"BLEND","doubleSided":true,"extensions":{"KHR_materials_unlit":{}},
        "pbrMetallicRoughness":{"baseColorFactor":[0.8,0.8,0.8,0.25]}}],
      "extensionsUsed":["KHR_materials_unlit"],
      "cameras":[{"type":"orthographic",
        "orthographic":{"xmag":0.1,"ymag":0.1,"znear":0.1,"zfar":9}}]"""
    val camera = """{"camera":0,"translation":[0.5,0.5,3]}"""
    val fan = ""","mode":6,"material":0"""
    val json = model(fan, nodes = s"""{"mesh":0},$camera""", roots = "0,1", others = others)
    val small = ReadSettings(resolution = Some(Resolution.Size(8, 8)))
    val settings = RenderSettings(samples = Some(64), reading = small)
    val (plan, _) = SceneBuilder.build(read(json, reading = small), settings)
    val image = Renderer.render(plan, threads = 1).image(plan.development)
    val mean = image.data.sum / image.data.length
    // 4,096 samples that show 0.8 by a chance of a quarter have a standard error of 0.0055
    assert(Math.abs(mean - 0.2) < 0.025, mean)
