package candela.render.storage

import org.scalatest.funsuite.AnyFunSuite

class FilmHeaderSuite extends AnyFunSuite:
  private val shard = FilmHeader(
    "1", "s.pbrt", "", Vector.empty, Vector.empty, Vector.empty, "4x4", 16, 4, 0f, Set(0), 3
  )

  test("a merger is a film of the whole only if it has all shards, and all their samples"):
    val all = shard.copy(shards = Set(0, 1, 2))
    val complete = all.copy(done = all.samples)
    assert(complete.joined == complete.copy(shards = Set(0), count = 1))
    // One shard may be farther than another: a rendering that went on would leave out samples
    assert(all.joined == all)
    val two = complete.copy(shards = Set(0, 1))
    assert(two.joined == two)

  test("a merger is as far as the least of its shards, and has no samples of missing ones"):
    val parts = Vector(shard.copy(done = 16), shard.copy(shards = Set(2)))
    val merged = shard.merging(parts)
    assert(merged.shards == Set(0, 2) && merged.count == 3 && merged.done == 4)
    // (16 + 4 + 0) / 3
    assert(FilmHeader.averageDone(parts) == 6)
