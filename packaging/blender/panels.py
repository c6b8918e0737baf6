"""Panels of the render engine, and Blender's own that apply to it."""

import bpy

ENGINE = "CANDELA"


class _Panel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {ENGINE}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class RENDER_PT_candela_sampling(_Panel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_context = "render"

    def draw(self, context):
        layout, own = self.layout, context.scene.candela
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(own, "samples")
        layout.prop(own, "time_limit")
        layout.prop(own, "error_limit")
        layout.prop(own, "use_denoising")
        layout.prop(own, "seed")
        layout.prop(own, "use_animated_seed")


class RENDER_PT_candela_film(_Panel, bpy.types.Panel):
    bl_label = "Film"
    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.render, "film_transparent", text="Transparent")


class VIEWLAYER_PT_candela_passes(_Panel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        layout, layer = self.layout, context.view_layer
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(layer, "use_pass_z", text="Depth")
        layout.prop(layer, "use_pass_normal", text="Normal")
        layout.prop(layer.candela, "use_pass_albedo")


CLASSES = (RENDER_PT_candela_sampling, RENDER_PT_candela_film, VIEWLAYER_PT_candela_passes)

# Those of other engines that show what this one reads
_SHARED = {
    "DATA_PT_EEVEE_light",
    "DATA_PT_EEVEE_light_distance",
    "DATA_PT_camera_dof",
    "DATA_PT_camera_dof_aperture",
    "EEVEE_MATERIAL_PT_context_material",
    "EEVEE_MATERIAL_PT_settings",
    "EEVEE_MATERIAL_PT_surface",
    "EEVEE_WORLD_PT_surface",
}
_UNUSED = {"RENDER_PT_simplify", "RENDER_PT_freestyle", "VIEWLAYER_PT_filter"}


def _panels():
    """Those of Blender that every engine shows, and the shared ones."""
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", set())
        name = panel.__name__
        if name in _SHARED or "BLENDER_RENDER" in engines and name not in _UNUSED:
            yield engines


def register():
    for engines in _panels():
        engines.add(ENGINE)


def unregister():
    for engines in _panels():
        engines.discard(ENGINE)
