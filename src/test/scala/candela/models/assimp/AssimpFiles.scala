package candela.models.assimp

/** Small models of the formats that Assimp reads. */
private[assimp] object AssimpFiles:
  /** A triangle in centimetres, with z up.
    *
    * @param material  its properties
    * @param texture   an image of its colour, if any
    * @param lights    further objects, and their connections
    */
  def fbx(material: String, texture: String = "", lights: (String, String) = ("", "")): String =
    val image =
      if texture.isEmpty then ""
      else s"""Texture: 4, "Texture::t", "" { FileName: "$texture" RelativeFilename: "$texture" }"""
    val connected = if texture.isEmpty then "" else """C: "OP",4,3, "DiffuseColor""""
    s"""; FBX 7.4.0 project file
       |FBXHeaderExtension:  { FBXVersion: 7400 }
       |GlobalSettings:  { Version: 1000
       |  Properties70:  {
       |    P: "UpAxis", "int", "Integer", "",2
       |    P: "UpAxisSign", "int", "Integer", "",1
       |    P: "FrontAxis", "int", "Integer", "",1
       |    P: "FrontAxisSign", "int", "Integer", "",-1
       |    P: "CoordAxis", "int", "Integer", "",0
       |    P: "CoordAxisSign", "int", "Integer", "",1
       |    P: "UnitScaleFactor", "double", "Number", "",1
       |  }
       |}
       |Objects:  {
       |  Geometry: 1, "Geometry::g", "Mesh" {
       |    Vertices: *9 { a: 0,0,0,100,0,0,0,0,100 }
       |    PolygonVertexIndex: *3 { a: 0,1,-3 }
       |    LayerElementUV: 0 {
       |      MappingInformationType: "ByVertice"
       |      ReferenceInformationType: "Direct"
       |      UV: *6 { a: 0,0,1,0,0,1 }
       |    }
       |    LayerElementMaterial: 0 {
       |      MappingInformationType: "AllSame"
       |      ReferenceInformationType: "IndexToDirect"
       |      Materials: *1 { a: 0 }
       |    }
       |    Layer: 0 {
       |      LayerElement:  { Type: "LayerElementUV" TypedIndex: 0 }
       |      LayerElement:  { Type: "LayerElementMaterial" TypedIndex: 0 }
       |    }
       |  }
       |  Model: 2, "Model::Sail", "Mesh" {
       |    Properties70:  { P: "Lcl Translation", "Lcl Translation", "", "A",0,0,200 }
       |  }
       |  Material: 3, "Material::Cloth", "" { ShadingModel: "phong" Properties70:  { $material } }
       |  $image
       |  ${lights._1}
       |}
       |Connections:  {
       |  C: "OO",2,0
       |  C: "OO",1,2
       |  C: "OO",3,2
       |  $connected
       |  ${lights._2}
       |}
       |""".stripMargin

  /** A morph target that raises the triangle by a metre, with a weight of 1/4. */
  val morphed: (String, String) = (
    """Geometry: 10, "Geometry::raised", "Shape" { Version: 100
      |  Indexes: *3 { a: 0,1,2 }
      |  Vertices: *9 { a: 0,0,100,0,0,100,0,0,100 }
      |  Normals: *9 { a: 0,0,0,0,0,0,0,0,0 }
      |}
      |Deformer: 11, "Deformer::d", "BlendShape" { Version: 100 }
      |Deformer: 12, "SubDeformer::raised", "BlendShapeChannel" { Version: 100
      |  DeformPercent: 25
      |  FullWeights: *1 { a: 100 }
      |}""".stripMargin,
    """C: "OO",10,12
      |C: "OO",12,11
      |C: "OO",11,1""".stripMargin
  )

  def color(name: String, r: Double, g: Double, b: Double): String =
    s"""P: "$name", "Color", "", "A",$r,$g,$b\n"""
  def numeric(name: String, x: Double): String = s"""P: "$name", "Number", "", "A",$x\n"""

  private def source(id: String, each: Int, numbers: String, names: String = "X"): String =
    val count = numbers.trim.split("\\s+").length
    val (kind, of) = if each == 16 then ("float4x4", "float") else ("float", "float")
    s"""<source id="$id"><float_array id="$id-a" count="$count">$numbers</float_array>
       |<technique_common><accessor source="#$id-a" count="${count / each}" stride="$each">
       |${
        if each == 16 then s"""<param name="TRANSFORM" type="$kind"/>"""
        else Seq.fill(each)(names).map(n => s"""<param name="$n" type="$of"/>""").mkString
      }
       |</accessor></technique_common></source>""".stripMargin

  private val positions = source("p", 3, "0 0 0  1 0 0  0 1 0")

  private val mesh =
    s"""<library_geometries><geometry id="g" name="Sail"><mesh>$positions
       |<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
       |<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
       |<p>0 1 2</p>
       |</triangles></mesh></geometry></library_geometries>""".stripMargin

  private def dae(body: String): String =
    s"""<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
       |version="1.4.1"><asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
       |$body<scene><instance_visual_scene url="#s"/></scene></COLLADA>""".stripMargin

  /** A triangle twice, a point light of this attenuation, and a camera. */
  def collada(attenuation: String): String = dae(
    s"""$mesh<library_lights><light id="l"><technique_common><point><color>1 2 4</color>$attenuation
       |</point></technique_common></light></library_lights>
       |<library_cameras><camera id="c"><optics><technique_common><perspective><xfov>60</xfov>
       |<aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective>
       |</technique_common></optics></camera></library_cameras>
       |<library_visual_scenes><visual_scene id="s">
       |<node id="a" name="a"><instance_geometry url="#g"/></node>
       |<node id="b" name="b"><translate>2 0 0</translate><instance_geometry url="#g"/></node>
       |<node id="lamp" name="lamp"><translate>0 3 0</translate><instance_light url="#l"/></node>
       |<node id="eye" name="eye"><translate>0 0 5</translate><instance_camera url="#c"/></node>
       |</visual_scene></library_visual_scenes>""".stripMargin
  )

  /** A triangle that follows a joint, which rises by 4 within 2 seconds. */
  val skinned: String = dae(
    s"""$mesh<library_controllers><controller id="k"><skin source="#g">
       |<source id="j"><Name_array id="j-a" count="1">joint</Name_array><technique_common>
       |<accessor source="#j-a" count="1" stride="1"><param name="JOINT" type="name"/></accessor>
       |</technique_common></source>
       |${source("i", 16, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")}${source("w", 1, "1", "WEIGHT")}
       |<joints><input semantic="JOINT" source="#j"/>
       |<input semantic="INV_BIND_MATRIX" source="#i"/></joints>
       |<vertex_weights count="3"><input semantic="JOINT" source="#j" offset="0"/>
       |<input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 1 1</vcount><v>0 0 0 0 0 0</v>
       |</vertex_weights></skin></controller></library_controllers>
       |<library_animations><animation id="up">${source("t", 1, "0 2", "TIME")}
       |${source("o", 3, "0 0 0 0 4 0")}
       |<source id="n"><Name_array id="n-a" count="2">LINEAR LINEAR</Name_array><technique_common>
       |<accessor source="#n-a" count="2" stride="1"><param name="INTERPOLATION" type="name"/>
       |</accessor></technique_common></source>
       |<sampler id="x"><input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/>
       |<input semantic="INTERPOLATION" source="#n"/></sampler>
       |<channel source="#x" target="joint/move"/></animation></library_animations>
       |<library_visual_scenes><visual_scene id="s">
       |<node id="joint" sid="joint" name="joint" type="JOINT">
       |<translate sid="move">0 0 0</translate>
       |</node><node id="body" name="body"><instance_controller url="#k"><skeleton>#joint</skeleton>
       |</instance_controller></node></visual_scene></library_visual_scenes>""".stripMargin
  )

  val off: String = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n"

  val ac: String =
    """AC3Db
      |MATERIAL "red" rgb 0.9 0.1 0.1  amb 0 0 0  emis 0 0 0  spec 0.5 0.5 0.5  shi 10  trans 0
      |OBJECT world
      |kids 1
      |OBJECT poly
      |name "sail"
      |numvert 4
      |0 0 0
      |1 0 0
      |1 1 0
      |0 1 0
      |numsurf 1
      |SURF 0x10
      |mat 0
      |refs 4
      |0 0 0
      |1 1 0
      |2 1 1
      |3 0 1
      |kids 0
      |""".stripMargin

  val x3d: String =
    """<?xml version="1.0" encoding="UTF-8"?><X3D profile="Interchange" version="3.2"><Scene><Shape>
      |<Appearance><Material diffuseColor="0.2 0.4 0.6"/></Appearance>
      |<IndexedFaceSet coordIndex="0 1 2 -1">
      |<Coordinate point="0 0 0 1 0 0 0 1 0"/></IndexedFaceSet>
      |</Shape></Scene></X3D>""".stripMargin
