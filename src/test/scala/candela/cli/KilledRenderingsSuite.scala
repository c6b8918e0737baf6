package candela.cli

import candela.testing.TempFolder

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Random

@org.scalatest.tags.Slow
class KilledRenderingsSuite extends AnyFunSuite:

  for (i, kills) <- Vector(0 -> 3, 2 -> 2) do
    val integrator = KilledRenderings.integrators(i)
    test(s"a rendering that is killed ends as one that was not: ${integrator.takeWhile(_ != ' ')}"):
      TempFolder.use: folder =>
        val result = KilledRenderings.run(folder, integrator, kills, Random(i), samples = 1500)
        assert(result.isSame && result.kills > 0, result)
