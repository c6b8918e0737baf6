package candela.stability

import candela.math.Position
import candela.scenefile.Dialect

/** Scenes far out: shapes, instances and motion. */
object FarObjects:
  import Dialect.{V2, V3, V4}
  import FarText.*
  private val patch = Seq(-1, 0, -.5, 1, 0, -.4, -1, .3, 1, 1, .2, .9)
  private val strand = Seq(-1, 0, -.4, -.5, .2, .8, .4, -.2, .9, 1, 0, -.3)
  private val net =
    for y <- 0 until 3; x <- 0 until 3; k <- 0 until 3
    yield Seq(x - 1.0, y - 1.0, if x == 1 && y == 1 then 1.2 else -.3)(k)
  private val nurbsSides = "\"integer nu\" 3 \"integer uorder\" 3 \"float uknots\" [0 0 0 1 1 1] " +
    "\"integer nv\" 3 \"integer vorder\" 3 \"float vknots\" [0 0 0 1 1 1]"

  private def weighted(p: Position) = net.grouped(3).map: q =>
    s"${2 * (p.x + q(0))} ${2 * (p.y + q(1))} ${2 * (p.z + q(2))} 2"
  .mkString(" ")

  private val corners = "\"integer indices\" [0 1 2 0 3 1 0 2 3 1 3 2]"
  private val tetrahedron = Seq(-.8, -.8, -.5, .8, -.8, -.5, 0, .9, -.5, 0, 0, 1)

  val shapes: Vector[FarScene] = Vector(
    FarScene(
      "meshes",
      V4,
      p => lit(p, grey4, ground(origin), red4, s"Shape \"trianglemesh\" ${ball(origin)}")
    ),
    FarScene(
      "meshes whose vertices are far out",
      V4,
      p =>
        Seq(
          sky,
          translate(p),
          emitter,
          translate(Position(-p.x, -p.y, -p.z)),
          ground(p),
          red4,
          s"Shape \"trianglemesh\" ${ball(p)}"
        ).mkString("\n")
    ),
    FarScene(
      "spheres, disks and cylinders",
      V4,
      p =>
        lit(
          p,
          grey4,
          ground(origin),
          red4,
          shape("\"sphere\" \"float radius\" .6", "Translate -.8 0 0"),
          shape("\"disk\" \"float radius\" .6", "Translate .5 .3 .4 Rotate 60 1 0 0"),
          shape(
            "\"cylinder\" \"float radius\" .3 \"float zmin\" -.5 \"float zmax\" .5",
            "Translate 1.2 0 0"
          )
        )
    ),
    FarScene(
      "cones, paraboloids, hyperboloids and height fields",
      V3,
      p =>
        lit(
          p,
          red,
          ground(origin),
          shape("\"cone\" \"float radius\" .5 \"float height\" 1", "Translate -1 0 -.5"),
          shape("\"paraboloid\" \"float radius\" .5 \"float zmax\" .8", "Translate 0 0 -.3"),
          shape(
            "\"hyperboloid\" \"point p1\" [.4 0 -.5] \"point p2\" [.5 .3 .5]",
            "Translate 1 0 0"
          ),
          shape(
            "\"heightfield\" \"integer nu\" 2 \"integer nv\" 2 \"float Pz\" [0 .4 .2 .5]",
            "Translate 0 1 -.4"
          )
        )
    ),
    FarScene(
      "patches, curves and subdivision surfaces",
      V4,
      p =>
        lit(
          p,
          grey4,
          ground(origin),
          red4,
          shape(s"\"bilinearmesh\" \"point3 P\" [${points(origin)(patch*)}]", "Translate -1 0 0"),
          shape(s"\"curve\" \"float width\" .3 \"point3 P\" [${points(origin)(strand*)}]"),
          shape(
            s"\"loopsubdiv\" $corners \"point3 P\" [${points(origin)(tetrahedron*)}]",
            "Translate 1 0 0"
          )
        )
    ),
    FarScene(
      "patches, curves and subdivision surfaces whose points are far out",
      V4,
      p =>
        Seq(
          sky,
          grey4,
          ground(p),
          red4,
          s"Shape \"bilinearmesh\" \"point3 P\" [${points(p)(patch*)}]",
          s"Shape \"curve\" \"float width\" .3 \"point3 P\" [${points(p)(strand*)}]",
          s"Shape \"loopsubdiv\" $corners \"point3 P\" [${points(p)(tetrahedron*)}]"
        ).mkString("\n")
    ),
    FarScene(
      "NURBS whose points are far out, with and without weights",
      V3,
      p =>
        Seq(
          sky,
          red,
          s"Shape \"nurbs\" $nurbsSides \"point P\" [${points(p)(net*)}]",
          "Translate 0 0 .4",
          s"Shape \"nurbs\" $nurbsSides \"float Pw\" [${weighted(p)}]"
        ).mkString("\n")
    ),
    FarScene(
      "a mesh far out that a transform brings to the world's origin",
      V3,
      p =>
        Seq(
          sky,
          red,
          translate(Position(-p.x, -p.y, -p.z)),
          s"Shape \"trianglemesh\" ${ball(p)}"
        ).mkString("\n"),
      view = _ => view(origin)
    )
  )

  private def thing = s"ObjectBegin \"o\"\nShape \"trianglemesh\" ${ball(origin)}\nObjectEnd"

  val places: Vector[FarScene] = Vector(
    FarScene(
      "instances",
      V4,
      p =>
        s"$red4\n$thing\n" + lit(
          p, grey4, ground(origin),
          "AttributeBegin\nTranslate -1 0 0\nObjectInstance \"o\"\nAttributeEnd",
          "AttributeBegin\nTranslate 1 0 0 Rotate 30 1 1 0\nObjectInstance \"o\"\nAttributeEnd"
        )
    ),
    FarScene(
      "instances of an object that is far out itself",
      V3,
      p =>
        s"""$sky\n$red\nObjectBegin "o"\n${translate(p)}\nShape "trianglemesh" """ +
          s"""${ball(origin)}\n""" +
          s"ObjectEnd\nObjectInstance \"o\"\nTranslate 1 .5 0\nObjectInstance \"o\""
    ),
    FarScene(
      "instances of an object whose vertices are far out, at the world's origin",
      V3,
      p =>
        s"$sky\n$red\nObjectBegin \"o\"\nShape \"trianglemesh\" ${ball(p)}\nObjectEnd\n" +
          s"${translate(Position(-p.x, -p.y, -p.z))}\nObjectInstance \"o\"\nTranslate 1 .5 0\n" +
          "ObjectInstance \"o\"",
      view = _ => view(origin)
    ),
    FarScene(
      "moving shapes",
      V3,
      p =>
        lit(
          p,
          red,
          ground(origin),
          moving("Translate .5 0 0 Rotate 40 0 0 1", s"Shape \"trianglemesh\" ${ball(origin)}")
        )
    ),
    FarScene(
      "moving shapes",
      V4,
      p =>
        lit(
          p,
          red4,
          ground(origin),
          moving(
            "Translate .5 0 0 Rotate 40 0 0 1",
            "Shape \"disk\" \"float radius\" .8 \"float height\" .3"
          )
        )
    ),
    FarScene(
      "moving instances with moving shapes",
      V3,
      p =>
        s"$red\nObjectBegin \"o\"\n" +
          moving("Rotate 30 0 0 1", s"Shape \"trianglemesh\" ${ball(origin)}") + "\nObjectEnd\n" +
          lit(p, ground(origin), moving("Translate .5 0 0", "ObjectInstance \"o\""))
    ),
    FarScene(
      "moving shapes of pbrt-v2",
      V2,
      p =>
        lit(
          p,
          red,
          ground(origin),
          moving("Translate .5 0 .2", s"Shape \"trianglemesh\" ${ball(origin)}")
        )
    )
  )
