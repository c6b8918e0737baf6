package candela.gallery

/** Shapes with about the size of the unit sphere. */
private object ShapeExamples:
  val all: Vector[(String, String)] = Vector(
    "sphere" -> "Shape \"sphere\"",
    "cylinder" -> "Scale .7 .7 1\nShape \"cylinder\"",
    "disk" -> "Rotate 35 1 0 0\nShape \"disk\"",
    "cone" -> "Translate 0 0 -1\nScale 1 1 1.8\nShape \"cone\"",
    "paraboloid" -> "Translate 0 0 -.7\nScale 1 1 1.5\nShape \"paraboloid\"",
    "hyperboloid" ->
      "Shape \"hyperboloid\" \"point p1\" [.4 .8 -1] \"point p2\" [.4 -.8 1]",
    "trianglemesh" ->
      """Shape "trianglemesh" "integer indices" [0 1 2 0 2 3 0 3 4 0 4 1 5 2 1 5 3 2 5 4 3 5 1 4]
        |  "point3 P" [0 0 1.2  .9 0 0  0 .9 0  -.9 0 0  0 -.9 0  0 0 -1]""".stripMargin,
    "plymesh" ->
      "Scale 1.8 1.8 1.8\nShape \"plymesh\" \"string filename\" \"geometry/torus-le.ply\"",
    "bilinearmesh" ->
      "Shape \"bilinearmesh\" \"point3 P\" [-.9 -.9 .7  .9 -.9 -.7  -.9 .9 -.7  .9 .9 .9]",
    "loopsubdiv" ->
      """Shape "loopsubdiv" "integer levels" 4
        |  "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  2 3 7 2 7 6  1 2 6 1 6 5
        |    0 4 7 0 7 3]
        |  "point3 P" [-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1]
        |""".stripMargin,
    "curve" ->
      """Shape "curve" "string type" "cylinder" "float width" .28
        |  "point3 P" [-1 0 -.7  -.6 -.8 1.6  .6 .8 -1.9  1 0 .7]""".stripMargin,
    "heightfield" ->
      """Translate -1 -1 -.7
        |Scale 2 2 1.2
        |Shape "heightfield" "integer nu" 5 "integer nv" 4 "float Pz" [
        |  0 .1 .3 .1 0  .2 .5 .9 .4 .1  .1 .4 .6 .7 .3  0 .1 .2 .5 .2]""".stripMargin,
    "nurbs" ->
      """Shape "nurbs" "integer nu" 4 "integer uorder" 4 "float uknots" [0 0 0 0 1 1 1 1]
        |  "integer nv" 3 "integer vorder" 3 "float vknots" [0 0 0 1 1 1]
        |  "point P" [-1 -.9 .2  -.4 -.9 1.6  .4 -.9 -1.4  1 -.9 .2
        |    -1 0 -.4  -.4 0 1  .4 0 -1  1 0 .8  -1 .9 .2  -.4 .9 .9  .4 .9 -.6  1 .9 0]
        |""".stripMargin
  )
