package candela.build.shapes

import candela.io.{CheckedInput, CheckedOutput, PartForm}

/** Files of the meshes that PLY files have, without numbers of other properties. */
private[build] object PlyMeshForm extends PartForm[PlyMesh]("mesh 1"):
  private def floats(mesh: PlyMesh) = Seq(mesh.positions, mesh.normals, mesh.uvs, mesh.rests)
  private def ints(mesh: PlyMesh) = Seq(mesh.indices, mesh.quads)

  def size(mesh: PlyMesh): Long =
    4 * (floats(mesh).map(_.length.toLong) ++ ints(mesh).map(_.length.toLong)).sum

  def write(mesh: PlyMesh, out: CheckedOutput): Unit =
    floats(mesh).foreach(out.floats)
    ints(mesh).foreach(out.ints)

  def read(in: CheckedInput): PlyMesh =
    val (positions, normals, uvs, rests) = (in.floats(), in.floats(), in.floats(), in.floats())
    PlyMesh(positions, normals, uvs, in.ints(), in.ints(), rests = rests)
