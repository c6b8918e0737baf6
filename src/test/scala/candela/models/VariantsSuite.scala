package candela.models

import candela.diagnostics.{Code, SceneError}
import candela.settings.{ModelSettings, ModelState, ReadSettings}

import org.scalatest.funsuite.AnyFunSuite

class VariantsSuite extends AnyFunSuite, GltfModels:
  private val mappings =
    """"mappings":[{"material":1,"variants":[1]},{"material":2,"variants":[0,2]}]"""
  private val shoe = model(
    s""","mode":5,"material":0,"extensions":{"KHR_materials_variants":{$mappings}}""",
    others = """,
      "materials":[{"name":"grey"},{"name":"red"},{"name":"blue"}],
      "extensionsRequired":["KHR_materials_variants"],
      "extensions":{"KHR_materials_variants":{
        "variants":[{"name":"sea"},{"name":"fire"},{"name":"sky"},{"name":"stone"}]}}"""
  )

  private def shown(variant: Option[String], json: String = shoe) =
    read(json, reading = ReadSettings(model = ModelSettings(state = ModelState(variant = variant))))

  private def materials(variant: Option[String]) =
    val scene = shown(variant)
    assert(scene.errors.isEmpty, scene.errors.map(_.message))
    scene.namedMaterials.map(_._1).filter(Set("grey", "red", "blue"))

  test("a variant changes the materials that are mapped, and no others"):
    assert(materials(Some("sky")) == Vector("blue") && materials(Some("sea")) == Vector("blue"))
    assert(materials(Some("fire")) == Vector("red"))
    assert(materials(Some("stone")) == Vector("grey") && materials(None) == Vector("grey"))

  test("variants are listed if none is asked for, and those that are misspelt suggested"):
    val listed = shown(None).warnings.map(_.message)
    assert(listed.exists(_.contains("`sea`, `fire`, `sky`, `stone`")), listed)
    assert(!shown(Some("sea")).warnings.exists(_.message.contains("variant")))
    val misspelt = intercept[SceneError](shown(Some("stoen"))).problems.head
    assert(misspelt.code == Code.OptionMisfit && misspelt.help.contains("did you mean `stone`?"))
    val none = intercept[SceneError](shown(Some("sea"), model())).problems.head
    assert(none.message.contains("has no variants"))

  test("a mapping of a variant or a material that isn't there is an error"):
    val far = shown(Some("sea"), shoe.replace("[0,2]", "[0,9]")).errors.map(_.pos.get.file)
    assert(
      far.exists(_.endsWith("#/meshes/0/primitives/0/extensions/KHR_materials_variants/" +
        "mappings/1/variants/1")),
      far
    )
