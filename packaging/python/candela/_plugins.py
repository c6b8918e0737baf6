"""Mitsuba's types, by the XML elements that name them. A suite compares this with the reader."""

from __future__ import annotations

from typing import Dict

_TYPES: Dict[str, str] = {
    "bsdf": """acousticbsdf blendbsdf bumpmap circular coating conductor dielectric difftrans
        diffuse hair hk irawan mask measured measured_polarized mixturebsdf normalmap null phong
        plastic polarizer pplastic principled principledthin retarder roughcoating roughconductor
        roughdielectric roughdiffuse roughplastic thindielectric twosided ward""",
    "shape": """bsplinecurve cube cylinder disk ellipsoids ellipsoidsmesh instance linearcurve merge
        obj ply rectangle sdfgrid serialized shapegroup sphere""",
    "emitter": """area constant directional directionalarea envmap point projector spot sunsky
        timed_sunsky volumelight""",
    "texture": """bitmap checkerboard curvature gridtexture mesh_attribute scale vertexcolors volume
        wireframe""",
    "spectrum": "blackbody d65 irregular rawconstant regular srgb uniform",
    "sensor": """batch distant irradiancemeter orthographic perspective radiancemeter thinlens""",
    "integrator": """acousticpath aov depth direct direct_projective emission moment path prb
        prb_basic prb_projective prbvolpath ptracer stokes volpath volpathmis volprim_rf_basic""",
    "medium": "heterogeneous homogeneous",
    "sampler": "independent ldsampler multijitter orthogonal stratified",
    "rfilter": "box catmullrom gaussian lanczos mitchell tent",
    "film": "hdrfilm ldrfilm specfilm",
    "phase": "blendphase hg isotropic kkay microflake mixturephase rayleigh sggx tabphase",
    "subsurface": "dipole singlescatter",
    "volume": "constvolume gridvolume hgridvolume volcache",
}

ELEMENTS: Dict[str, str] = {
    name: element for element, names in _TYPES.items() for name in names.split()
}
