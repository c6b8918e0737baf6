package candela.bsdf.subsurface

import candela.bsdf.{BsdfLaws, Directions}
import candela.math.*

class NormalizedFresnelSuite extends BsdfLaws:
  for eta <- Seq(1.33f, 1.8f) do
    // Light gets in from all directions and goes on in one
    obeysLaws(s"of index $eta", NormalizedFresnel(eta), isReciprocal = false)

    test(s"of index $eta, all light that gets in is counted"):
      val f = NormalizedFresnel(eta)
      val sum = Directions.integrals(1, 1, fine = 600)(w => f.f(Vec3.Z, w).g * Math.abs(w.z)).sum
      assert(Math.abs(sum - 1) < 1e-3, sum) // of the grid
