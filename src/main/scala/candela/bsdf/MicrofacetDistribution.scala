package candela.bsdf

import candela.math.*

/** How the normals of the tiny mirrors of a rough surface are spread, and how these hide one
  * another.
  *
  * `m` is a unit microfacet normal with `m.z` > 0. Of `wo` and `wi` only the sizes of the cosines
  * count: the distribution looks the same from below.
  *
  * Source of the names: Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
  * EGSR 2007.
  */
abstract class MicrofacetDistribution:

  /** Area of facets with normal `m`, per unit of surface and solid angle of normals. */
  def d(m: Vec3): Float

  /** G / (4 |cos θo cos θi|): the share of the facets of normal `m` that both directions see, in
    * the form that stays finite at grazing angles wherever the model does.
    */
  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float

  /** The density, per solid angle of normals, with which `sample` returns `m`. */
  def pdf(wo: Vec3, m: Vec3): Float

  /** Draws a normal for a `wo` with `wo.z` ≥ 0; not all models see to it that it faces `wo`. */
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3

  /** d · G · (wo·m) / (|cos θo| · pdf): what is left of f·cos/pdf when a sampled facet reflects or
    * refracts `wo` to `wi` without loss.
    */
  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float

  /** So smooth that it should be treated as a perfect mirror. */
  def isSmooth: Boolean

  /** That of [[Bsdf.regularized]]. Those which only older versions of PBRT have stay as they are:
    * no integrator of theirs asks.
    */
  def regularized: MicrofacetDistribution = this
