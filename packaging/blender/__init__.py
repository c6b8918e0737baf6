"""Renders the open scene with Candela: a render engine for Blender 4.2 and newer."""

import bpy

from . import engine, panels, settings
from .export import glTF2ExportUserExtension  # noqa: F401  Blender's glTF exporter looks for it

_CLASSES = (*settings.CLASSES, engine.CandelaRenderEngine, *panels.CLASSES)


def register():
    for each in _CLASSES:
        bpy.utils.register_class(each)
    settings.register()
    panels.register()


def unregister():
    from .candela import close

    close()
    panels.unregister()
    settings.unregister()
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
