"""The camera of a scene, as a node of glTF: docs/MODELS.md."""

import math


def fields(scene, camera, warn):
    """The camera of glTF, and `extras.candela.camera` of its node.

    The view is its frame one unit before the camera: `sensor_fit` and shift are in it.
    """
    data = camera.data
    corners = data.view_frame(scene=scene)
    is_perspective = data.type == "PERSP"
    depth = -corners[0].z if is_perspective else 1.0
    xs = [c.x / depth for c in corners]
    ys = [c.y / depth for c in corners]
    width, height = max(xs) - min(xs), max(ys) - min(ys)
    clips = {"znear": data.clip_start, "zfar": data.clip_end}
    if is_perspective:
        view = {"yfov": 2 * math.atan(height / 2), "aspectRatio": width / height, **clips}
        described = {"type": "perspective", "perspective": view}
    else:
        view = {"xmag": width / 2, "ymag": height / 2, **clips}
        described = {"type": "orthographic", "orthographic": view}
    more = {"shift": [(max(xs) + min(xs)) / 2 / width, (max(ys) + min(ys)) / 2 / height]}
    dof = data.dof
    if dof.use_dof and dof.aperture_fstop > 0:
        length = data.lens / 1000 if is_perspective else 1.0
        more["apertureRadius"] = length / (2 * dof.aperture_fstop)
        more["focusDistance"] = max(1e-5, _focus(camera))
        if dof.aperture_blades > 2 or dof.aperture_ratio != 1:
            warn(f"the aperture of camera '{data.name}' is round in Candela")
    return {"name": data.name, **described}, more


def _focus(camera):
    dof = camera.data.dof
    if dof.focus_object is None:
        return dof.focus_distance
    target = dof.focus_object.matrix_world
    if dof.focus_subtarget and dof.focus_object.type == "ARMATURE":
        bone = dof.focus_object.pose.bones.get(dof.focus_subtarget)
        target = target @ bone.matrix if bone else target
    place = camera.matrix_world.normalized()
    return abs((place.inverted() @ target.translation).z)
