package candela.api

/** One scene, as a file and in code. */
object LibraryScenes:

  /** @param integrator its quoted name, and parameters */
  def text(integrator: String = "\"path\" \"integer maxdepth\" 5", samples: Int = 8): String =
    s"""Film "rgb" "integer xresolution" 24 "integer yresolution" 16
       |LookAt 0 1 -6  0 0 0  0 1 0
       |Camera "perspective" "float fov" 40
       |Sampler "halton" "integer pixelsamples" $samples
       |PixelFilter "box"
       |Integrator $integrator
       |MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [.01 .02 .03]
       |WorldBegin
       |LightSource "infinite" "rgb L" [.3 .4 .6]
       |Texture "checks" "spectrum" "checkerboard" "rgb tex1" [.8 .2 .1] "rgb tex2" [.1 .2 .8]
       |MakeNamedMaterial "coat" "string type" "coateddiffuse" "texture reflectance" "checks"
       |AttributeBegin
       |NamedMaterial "coat"
       |Translate 0 .25 0
       |Rotate 30 0 1 0
       |Shape "sphere" "float radius" 1.1
       |AttributeEnd
       |AttributeBegin
       |AreaLightSource "diffuse" "rgb L" [4 4 3]
       |Shape "disk" "float height" -3 "float radius" .7
       |AttributeEnd
       |ObjectBegin "stone"
       |Material "conductor" "spectrum eta" "metal-Cu-eta" "float roughness" .2
       |Shape "trianglemesh" "point3 P" [-1 -1 0  1 -1 0  0 .5 0] "integer indices" [0 1 2]
       |ObjectEnd
       |AttributeBegin
       |Translate 2 0 1
       |ObjectInstance "stone"
       |AttributeEnd
       |AttributeBegin
       |Translate -2 0 1
       |Scale .5 .5 .5
       |ObjectInstance "stone"
       |AttributeEnd
       |""".stripMargin

  /** The same. */
  def built(samples: Int = 8): SceneBuilder = Candela.build()
    .film("rgb", Parameters().integer("xresolution", 24).integer("yresolution", 16))
    .lookAt(0, 1, -6, 0, 0, 0, 0, 1, 0)
    .camera("perspective", Parameters().number("fov", 40))
    .sampler("halton", Parameters().integer("pixelsamples", samples))
    .filter("box", Parameters())
    .integrator("path", Parameters().integer("maxdepth", 5))
    .nameMedium("fog", "homogeneous", Parameters().rgb("sigma_a", 0.01, 0.02, 0.03))
    .world()
    .light("infinite", Parameters().rgb("L", 0.3, 0.4, 0.6))
    .texture(
      "checks",
      TextureValues.Spectrum,
      "checkerboard",
      Parameters().rgb("tex1", 0.8, 0.2, 0.1).rgb("tex2", 0.1, 0.2, 0.8)
    )
    .nameMaterial("coat", "coateddiffuse", Parameters().texture("reflectance", "checks"))
    .attributes:
      _.useMaterial("coat").translate(0, 0.25, 0).rotate(30, 0, 1, 0)
        .shape("sphere", Parameters().number("radius", 1.1))
    .attributes:
      _.areaLight("diffuse", Parameters().rgb("L", 4, 4, 3))
        .shape("disk", Parameters().number("height", -3).number("radius", 0.7))
    .define(
      "stone",
      _.material("conductor", Parameters().spectrum("eta", "metal-Cu-eta").number("roughness", 0.2))
        .shape(
          "trianglemesh",
          Parameters().points("P", Array[Float](-1, -1, 0, 1, -1, 0, 0, 0.5f, 0))
            .integer("indices", 0, 1, 2)
        )
    )
    .attributes(_.translate(2, 0, 1).instance("stone"))
    .attributes(_.translate(-2, 0, 1).scale(0.5, 0.5, 0.5).instance("stone"))
