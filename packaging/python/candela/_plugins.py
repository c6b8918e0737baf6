"""Mitsuba's types, by the XML elements that name them. A suite compares this with the reader."""

from __future__ import annotations

from typing import Dict

_TYPES: Dict[str, str] = {
    # Before "bsdf": "hair" is a shape in 0.6 only, and a BSDF in dicts
    "shape": """bsplinecurve cube cylinder deformable disk ellipsoids ellipsoidsmesh hair
        heightfield instance linearcurve merge obj ply rectangle sdfgrid serialized shapegroup
        sphere""",
    "bsdf": """acousticbsdf blendbsdf bumpmap circular coating conductor dielectric difftrans
        diffuse hair hk irawan mask measured measured_polarized mixturebsdf normalmap null phong
        plastic polarizer pplastic principled principledthin retarder roughcoating roughconductor
        roughdielectric roughdiffuse roughplastic thindielectric twosided ward""",
    "emitter": """area collimated constant directional directionalarea envmap point projector sky
        spot sun sunsky timed_sunsky volumelight""",
    "texture": """bitmap checkerboard curvature gridtexture mesh_attribute scale vertexcolors volume
        wireframe""",
    "spectrum": "blackbody d65 irregular rawconstant regular srgb uniform",
    "sensor": """batch distant fluencemeter irradiancemeter orthographic perspective
        perspective_rdist radiancemeter spherical telecentric thinlens""",
    "integrator": """acousticpath adaptive ao aov bdpt depth direct direct_projective emission erpt
        field irrcache mlt moment motion multichannel path photonmapper ppm prb prb_basic
        prb_projective prbvolpath pssmlt ptracer sppm stokes volpath volpath_simple volpathmis
        volprim_rf_basic vpl""",
    "medium": "heterogeneous homogeneous",
    "sampler": """halton hammersley independent ldsampler multijitter orthogonal sobol
        stratified""",
    "rfilter": "box catmullrom gaussian lanczos mitchell tent",
    "film": "hdrfilm ldrfilm mfilm specfilm tiledhdrfilm",
    "phase": "blendphase hg isotropic kkay microflake mixturephase rayleigh sggx tabphase",
    "subsurface": "dipole singlescatter",
    "volume": "constvolume gridvolume hgridvolume volcache",
}

ELEMENTS: Dict[str, str] = {
    name: element for element, names in _TYPES.items() for name in names.split()
}
