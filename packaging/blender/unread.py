"""What changes Cycles' picture and has no effect here: it is named."""


class _From:
    """Numbers from this one on, or 0 if that means no limit."""

    def __init__(self, least, zero=False):
        self._least, self._zero = least, zero

    def __eq__(self, value):
        return value >= self._least or self._zero and value == 0

    __hash__ = None


# Paths of properties, and the values that leave the picture as it is here
_SCENE = {
    "render.use_motion_blur": False,
    "render.use_multiview": False,
    "render.use_freestyle": False,
    "cycles.max_bounces": _From(12),
    "cycles.diffuse_bounces": _From(4),
    "cycles.glossy_bounces": _From(4),
    "cycles.transmission_bounces": _From(12),
    "cycles.transparent_max_bounces": _From(8),
    "cycles.sample_clamp_direct": 0,
    "cycles.sample_clamp_indirect": _From(10, zero=True),
    "cycles.caustics_reflective": True,
    "cycles.caustics_refractive": True,
    "cycles.use_fast_gi": False,
    "cycles.volume_biased": False,
    "cycles.film_transparent_glass": False,
    "cycles.pixel_filter_type": "BLACKMAN_HARRIS",
    "cycles.filter_width": 1.5,
}
_SIMPLIFIED = {
    "cycles.use_camera_cull": False,
    "cycles.use_distance_cull": False,
    "cycles.texture_limit_render": "OFF",
}
_LAYER = {"use_solid": True, "use_volumes": True}
_COLLECTION = {"holdout": False, "indirect_only": False}
_WORLD = {
    "cycles.max_bounces": _From(16),
    "cycles_visibility.diffuse": True,
    "cycles_visibility.glossy": True,
    "cycles_visibility.transmission": True,
    "cycles_visibility.scatter": True,
}
_VISIBILITY = {
    "visible_diffuse": True,
    "visible_glossy": True,
    "visible_transmission": True,
    "visible_volume_scatter": True,
    "light_linking.receiver_collection": None,
    "light_linking.blocker_collection": None,
}
_OBJECT = {
    "visible_camera": True,
    "visible_shadow": True,
    **_VISIBILITY,
    "is_holdout": False,
    "is_shadow_catcher": False,
    "cycles.use_adaptive_subdivision": False,  # before Blender 5
}
_LIGHT = {
    "use_shadow": True,
    "cycles.max_bounces": _From(16),
    "cycles.use_multiple_importance_sampling": True,
}
_MODIFIER = {"use_adaptive_subdivision": False}
_READ = {"MESH", "LIGHT", "VOLUME"}
_INVISIBLE = {"EMPTY", "CAMERA", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"}
# Without a surface: with one they are meshes
_BARE = {"CURVE", "SURFACE", "FONT", "META"}


def check(scene, view_layer, world, depsgraph, warn):
    """Names what is set otherwise than here, by the thing's name."""
    simplified = _SIMPLIFIED if scene.render.use_simplify else {}
    _check("scene", scene, _SCENE | simplified, warn)
    if scene.render.pixel_aspect_x != scene.render.pixel_aspect_y:
        warn("pixels that are not square are not supported; the picture is stretched")
    _check("view layer", view_layer, _LAYER, warn)
    for layer in _collections(view_layer.layer_collection):
        _check("collection", layer, _COLLECTION, warn)
    if world is not None:
        _check("world", world, _WORLD, warn)
    seen = set()
    for instance in depsgraph.object_instances:
        if instance.show_particles:
            _check_hair(instance.object, seen, warn)
        if not instance.show_self:
            continue
        for each in (instance.object, instance.parent if instance.is_instance else None):
            key = each and (each.original, each.type)
            if key and key not in seen:
                seen.add(key)
                _check_object(each, warn)


def _collections(top):
    for layer in top.children:
        if not layer.exclude:
            yield layer
            yield from _collections(layer)


def _check_hair(each, seen, warn):
    key = (each.original, "HAIR")
    systems = [m.particle_system for m in each.modifiers if m.type == "PARTICLE_SYSTEM"]
    kinds = [(system.settings.type, system.settings.render_type) for system in systems]
    if key not in seen and ("HAIR", "PATH") in kinds:
        seen.add(key)
        warn(f"the hair of object '{each.original.name}' is not supported; left out")


def _check_object(each, warn):
    name, kind = each.original.name, each.type
    if kind not in _READ | _INVISIBLE | _BARE:
        warn(f"object '{name}' ({kind.lower().replace('_', ' ')}) is not supported; left out")
    for modifier in each.original.modifiers:
        if modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN":
            warn(f"the fluid of object '{name}' is not supported; left out")
        if modifier.show_render:
            _check("modifier", modifier, _MODIFIER, warn)
    if kind == "LIGHT":
        _check("light", each.original.data, _LIGHT, warn)
    if kind not in _INVISIBLE or each.original.is_instancer:
        _check("object", each.original, _VISIBILITY if kind == "LIGHT" else _OBJECT, warn)


def _check(kind, owner, usual, warn):
    texts = []
    for path, value in usual.items():
        found, label = _value(owner, path.split("."))
        if label is not None and not value == found:
            texts.append(f"{label} {_word(found)}")
    if texts:
        warn(f"{kind} '{owner.name}': not supported: {', '.join(texts)}")


def _value(owner, path):
    """The value of a property and its name, or None and None if there is none."""
    *above, last = path
    for name in above:
        owner = getattr(owner, name, None)
    described = owner.bl_rna.properties.get(last) if owner is not None else None
    if described is None:
        return None, None
    # Some have no name of their own
    is_named = described.name != last
    label = described.name if is_named else last.removeprefix("use_").replace("_", " ").title()
    return getattr(owner, last), label


def _word(value):
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, float):
        return f"{value:g}"
    return f"'{value.name}'" if hasattr(value, "name") else str(value)
