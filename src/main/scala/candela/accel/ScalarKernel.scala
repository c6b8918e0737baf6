package candela.accel

import candela.geometry.{Hit, Ray}

/** Walks a [[WideTree]] in plain Scala: for JVMs without the Vector API, and as long as the vectors
  * of [[VectorKernel]] are not compiled.
  */
private[accel] object ScalarKernel extends WideKernel:
  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean = walk(tree, ray, hit, false)
  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean = walk(tree, ray, hit, true)
  def name: String = "scalar"

  private inline def walk(tree: WideTree, ray: Ray, hit: Hit, inline anyHit: Boolean): Boolean =
    val b = tree.nodes
    val width = tree.width
    val ox = ray.ox
    val oy = ray.oy
    val oz = ray.oz
    val ix = ray.invX
    val iy = ray.invY
    val iz = ray.invZ
    // Where in a node the near plane of each axis stands, and the far one
    val nx = width * (if ix < 0f then 3 else 0)
    val ny = width * (if iy < 0f then 4 else 1)
    val nz = width * (if iz < 0f then 5 else 2)
    val fx = 3 * width - nx
    val fy = 5 * width - ny
    val fz = 7 * width - nz
    val begins = ray.lanes
    WideWalk.walk(
      tree,
      width,
      tree.lanes,
      ray,
      hit,
      anyHit,
      (node, limit) =>
        var hits = 0
        var k = 0
        while k < width do
          var near = bits((b(node + nx + k) - ox) * ix)
          var far = bits((b(node + fx + k) - ox) * ix)
          val nearY = bits((b(node + ny + k) - oy) * iy)
          val farY = bits((b(node + fy + k) - oy) * iy)
          val nearZ = bits((b(node + nz + k) - oz) * iz)
          val farZ = bits((b(node + fz + k) - oz) * iz)
          if nearY > near then near = nearY
          if farY < far then far = farY
          if nearZ > near then near = nearZ
          if farZ < far then far = farZ
          if near < 0 then near = 0
          begins(k) = near
          if near <= far + WideWalk.Slack && near <= limit then hits |= 1 << k
          k += 1
        hits
      ,
      _ => -1
    )

  private inline def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)
