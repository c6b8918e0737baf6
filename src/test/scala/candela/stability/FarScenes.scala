package candela.stability

import candela.math.Position
import candela.scenefile.Dialect

/** Scenes far out: one of each kind of object. */
object FarScenes:
  import Dialect.{V2, V3, V4}
  import FarText.*
  private def inWorld(texture: String)(p: Position) =
    s"""$sky\n$texture\n${translate(p)}\n$emitter\n${ground(origin)}\nShape "sphere" "float """ +
      s"""radius" .7"""

  private val fog = "\"rgb sigma_a\" [.1 .2 .3] \"rgb sigma_s\" [1 .8 .6]"
  private val density = "\"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 " +
    "\"float density\" [.1 1 .4 2 .7 .2 1 .3]"

  val lights: Vector[FarScene] = Vector(
    FarScene(
      "point, spot and distant lights, moved",
      V4,
      p =>
        Seq(
          translate(p),
          "LightSource \"point\" \"rgb I\" [9 9 5] \"point3 from\" [-1 -2 2]",
          "LightSource \"spot\" \"rgb I\" [20 9 9] \"point3 from\" [2 -2 2] \"point3 to\" [0 0 .2]",
          s"""LightSource "distant" "rgb L" [.2 .3 .9] "point3 from" [1 -1 1] "point3 to" """ +
            s"""[0 0 0]""",
          content4
        ).mkString("\n")
    ),
    FarScene(
      "point, spot and distant lights with coordinates far out",
      V4,
      p =>
        Seq(
          s"""LightSource "point" "rgb I" [9 9 5] "point3 from" [${points(p)(-1.1, -2.2, 2.3)}]""",
          s"""LightSource "spot" "rgb I" [20 9 9] "point3 from" [${points(p)(2.1, -2.2, 2.3)}] """ +
            s"\"point3 to\" [${points(p)(.1, 0, .2)}]",
          s"""LightSource "distant" "rgb L" [.2 .3 .9] "point3 from" """ +
            s"""[${points(p)(1.1, -1.2, 1)}] """ +
            s"\"point3 to\" [${points(p)(0, 0, .1)}]",
          translate(p),
          content4
        ).mkString("\n")
    ),
    FarScene(
      "point lights with coordinates far out",
      V3,
      p =>
        s"""LightSource "point" "rgb I" [9 9 5] "point from" [${points(p)(-1.1, -2.2, 2.3)}]\n""" +
          s"${translate(p)}\n$content"
    ),
    FarScene(
      "area lights of all shapes",
      V4,
      p =>
        lit(
          p,
          content4,
          shape(
            "\"disk\" \"float radius\" .5",
            "AreaLightSource \"diffuse\" \"rgb L\" [9 3 3]\nTranslate 1 0 2 Rotate 180 1 0 0"
          ),
          shape(
            s"\"trianglemesh\" $indices \"point3 P\" [0 0 2 1 0 2 1 1 2 0 1 2]",
            "AreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" [3 9 3]"
          ),
          shape(
            "\"bilinearmesh\" \"point3 P\" [0 0 0 .3 0 0 0 .4 .3 .4 .3 .2]",
            "AreaLightSource \"diffuse\" \"bool twosided\" true \"rgb L\" [3 3 9]\nTranslate -2 0 1"
          )
        )
    ),
    FarScene(
      "many emitters, chosen by place",
      V3,
      p =>
        s"${translate(p)}\n" +
          (0 until 12).map(i =>
            s"""LightSource "point" "rgb I" [1 .${i % 10} 1] "point from" [${i * .4 - 2} """ +
              s"""-1 ${1 + i % 3}]"""
          ).mkString("\n") +
          s"\n$content",
      head = "Integrator \"path\" \"string lightsamplestrategy\" \"spatial\""
    ),
    FarScene(
      "projections and goniometric lights",
      V3,
      p =>
        Seq(
          translate(p), "Translate 0 -1 2",
          "LightSource \"goniometric\" \"rgb I\" [9 9 5]", "Translate 0 1 -2", content
        ).mkString("\n")
    )
  )

  val media: Vector[FarScene] = Vector(
    FarScene(
      "homogeneous media and grids",
      V4,
      p =>
        s"""MakeNamedMedium "h" "string type" "homogeneous" """ +
          s"""$fog\n${translate(p)}\n$sky\n$emitter\n""" +
          s"""MakeNamedMedium "g" "string type" "uniformgrid" $fog $density "point3 p0" """ +
          s"""[-1.5 -.5 -.5] "point3 p1" [-.2 .5 .8]\n""" +
          s"$grey4\n${ground(origin)}\nMaterial \"interface\"\n" +
          shape(
            "\"sphere\" \"float radius\" .6",
            "MediumInterface \"h\" \"\"\nTranslate .8 0 0"
          ) + "\n" +
          shape("\"sphere\" \"float radius\" .65", "MediumInterface \"g\" \"\"\nTranslate -.8 0 0")
    ),
    FarScene(
      "grids whose boxes are far out",
      V4,
      p =>
        s"$sky\nMakeNamedMedium \"g\" \"string type\" \"uniformgrid\" $fog $density " +
          s""""point3 p0" [${points(p)(-1.1, -.6, -.5)}] "point3 p1" """ +
          s"""[${points(p)(.9, .6, .8)}]\n""" +
          s"${translate(p)}\n$emitter\n$grey4\n${ground(origin)}\nMaterial \"interface\"\n" +
          shape("\"sphere\" \"float radius\" .9", "MediumInterface \"g\" \"\"")
    ),
    FarScene(
      "volumes of pbrt-v2",
      V2,
      p =>
        lit(p, red, ground(origin)) +
          s"""\nVolume "homogeneous" "color sigma_a" [.2 .3 .4] "color sigma_s" [.6 .5 """ +
          s""".4] "point p0" [-1.5 -1 -.5] "point p1" [0 1 1]\n""" +
          s"""Translate ${-p.x} ${-p.y} ${-p.z}\nVolume "volumegrid" "color sigma_a" [.2 """ +
          s""".3 .4] "color sigma_s" [.6 .5 .4] $density """ +
          s"\"point p0\" [${points(p)(.1, -1, -.5)}] \"point p1\" [${points(p)(1.6, 1, 1)}]",
      head = "VolumeIntegrator \"single\" \"float stepsize\" .2"
    )
  )

  private val checks4 = "\"rgb tex1\" [.9 .2 .1] \"rgb tex2\" [.1 .3 .8]"

  val textures: Vector[FarScene] = Vector(
    FarScene(
      "solid checkerboards of the world",
      V4,
      inWorld(textured(V4, "checkerboard", s"\"integer dimension\" 3 $checks4"))
    ),
    FarScene(
      "solid checkerboards of the world",
      V3,
      inWorld(textured(V3, "checkerboard", s"\"integer dimension\" 3 $checks4"))
    ),
    FarScene(
      "planar checkerboards of the world",
      V4,
      inWorld(textured(V4, "checkerboard", s"\"string mapping\" \"planar\" $checks4"))
    ),
    FarScene(
      "planar checkerboards of the world",
      V3,
      inWorld(textured(
        V3,
        "checkerboard",
        s"\"string mapping\" \"planar\" \"vector v1\" [.5 0 .5] \"float udelta\" .25 $checks4"
      ))
    ),
    FarScene(
      "noise that moves with its shapes",
      V4,
      p =>
        lit(
          p,
          numbered(V4, "wrinkled", "\"integer octaves\" 6"),
          content4.replace(red4, "")
        )
    ),
    FarScene(
      "spherical and cylindrical mappings",
      V4,
      p =>
        lit(
          p,
          "AttributeBegin",
          textured(
            V4,
            "checkerboard",
            s"\"string mapping\" \"spherical\" \"float uscale\" 8 \"float vscale\" 8 $checks4"
          ),
          ground(origin),
          "AttributeEnd",
          textured(
            V4,
            "checkerboard",
            s"\"string mapping\" \"cylindrical\" $checks4"
          ).replace("\"t\"", "\"c\""),
          "Shape \"sphere\" \"float radius\" .6"
        )
    ),
    FarScene(
      "spherical mappings",
      V3,
      p =>
        lit(
          p,
          textured(V3, "checkerboard", s"\"string mapping\" \"spherical\" $checks4"),
          ground(origin)
        )
    )
  )

  val cameras: Vector[FarScene] = Vector(
    FarScene(
      "orthographic cameras",
      V4,
      p => lit(p, content4),
      view = viewed("\"orthographic\" \"float screenwindow\" [-2 2 -1.6 1.6]")
    ),
    FarScene(
      "orthographic cameras a scene away",
      V3,
      p => lit(p, content),
      view = p =>
        s"LookAt ${p.x} ${p.y} ${p.z + 2000} ${p.x} ${p.y} ${p.z} 0 1 0\n" +
          "Camera \"orthographic\" \"float screenwindow\" [-2 2 -1.6 1.6]"
    ),
    FarScene(
      "cameras with a lens",
      V4,
      p => lit(p, content4),
      view =
        viewed("\"perspective\" \"float fov\" 40 \"float lensradius\" .1 \"float focaldistance\" 5")
    ),
    FarScene("spherical cameras", V4, p => lit(p, content4), view = viewed("\"spherical\"")),
    FarScene("environment cameras", V3, p => lit(p, content), view = viewed("\"environment\"")),
    FarScene(
      "moving cameras",
      V4,
      p => lit(p, content4),
      view = p =>
        s"ActiveTransform EndTime\nTranslate .3 .1 0\nActiveTransform All\n${view(p)}"
    ),
    FarScene(
      "moving cameras",
      V2,
      p => lit(p, content),
      view = p =>
        s"ActiveTransform EndTime\nRotate 4 0 1 0\nActiveTransform All\n${view(p)}"
    )
  )

  private val integrators = Vector(
    "bdpt", "mlt", "sppm", "ambientocclusion", "simplepath", "simplevolpath"
  )
    .map(name =>
      FarScene(s"the integrator $name", V4, p => lit(p, content4), s"Integrator \"$name\"")
    )

  private val older = Vector("directlighting", "whitted", "bdpt", "sppm")
    .map(name =>
      FarScene(s"the integrator $name", V3, p => lit(p, content), s"Integrator \"$name\"")
    )

  val all: Vector[FarScene] =
    FarObjects.shapes ++ FarObjects.places ++ lights ++ media ++ textures ++ cameras ++
      integrators ++ older
