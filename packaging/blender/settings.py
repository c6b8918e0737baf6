"""What a user sets: the program in the preferences, quality in the scene, passes in its layers."""

import os
import shutil

import bpy
from bpy.props import BoolProperty, FloatProperty, IntProperty, PointerProperty, StringProperty


# Before the engine sets it
_NAMED = os.environ.get("CANDELA_PROGRAM")


class CandelaPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(
        name="Program",
        description="The file bin/candela of an unpacked release; if empty, `candela` on the PATH",
        subtype="FILE_PATH",
    )

    def draw(self, context):
        self.layout.prop(self, "program")


class CandelaSettings(bpy.types.PropertyGroup):
    samples: IntProperty(
        name="Samples",
        description="Samples per pixel, rounded up to a power of two; a maximum if there is a "
        "time or error limit",
        default=64,
        min=1,
        soft_max=4096,
    )
    time_limit: FloatProperty(
        name="Time Limit",
        description="End after this rendering time (0: no limit)",
        default=0,
        min=0,
        subtype="TIME_ABSOLUTE",
        unit="TIME_ABSOLUTE",
    )
    error_limit: FloatProperty(
        name="Error Limit",
        description="End when the relative error of the image is below this (0: no limit)",
        default=0,
        min=0,
        max=100,
        subtype="PERCENTAGE",
    )
    seed: IntProperty(name="Seed", description="Random seed", default=0, min=0)
    use_animated_seed: BoolProperty(
        name="Animated Seed", description="Change the seed with the frame", default=False
    )
    use_denoising: BoolProperty(
        name="Denoise", description="Remove noise by Open Image Denoise", default=False
    )


class CandelaLayerSettings(bpy.types.PropertyGroup):
    use_pass_albedo: BoolProperty(
        name="Albedo", description="Deliver the albedo of the first visible surface", default=False
    )


CLASSES = (CandelaPreferences, CandelaSettings, CandelaLayerSettings)


def register():
    bpy.types.Scene.candela = PointerProperty(type=CandelaSettings)
    bpy.types.ViewLayer.candela = PointerProperty(type=CandelaLayerSettings)


def unregister():
    del bpy.types.ViewLayer.candela
    del bpy.types.Scene.candela


class NoProgram(Exception):
    """The program candela was not found."""


def program() -> str:
    """The file that starts candela."""
    addon = bpy.context.preferences.addons.get(__package__)
    chosen = addon.preferences.program if addon else ""
    if chosen:
        path = bpy.path.abspath(chosen)
        if not os.path.isfile(path):
            raise NoProgram(
                f"there is no file {path}: Preferences > Add-ons > Candela > Program must name "
                "bin/candela of an unpacked release"
            )
        return path
    found = _NAMED or shutil.which("candela")
    if not found:
        raise NoProgram(
            "the program candela is not installed: unpack candela-VERSION-PLATFORM.zip, and choose "
            "its bin/candela in Preferences > Add-ons > Candela > Program"
        )
    return found
