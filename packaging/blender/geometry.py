"""What a depsgraph has, as nodes of glTF, and its meshes as objects for Blender's exporter.

The depsgraph is what Cycles reads: modifiers, shape keys, bones, constraints, instances and what is
hidden or excluded are evaluated in it.
"""

from contextlib import contextmanager

import bpy
from mathutils import Matrix

# From z up to y up
UPRIGHT = Matrix(((1, 0, 0, 0), (0, 0, 1, 0), (0, -1, 0, 0), (0, 0, 0, 1)))


def rendered(depsgraph):
    """The instances of objects that are rendered: each is valid until the next."""
    return (each for each in depsgraph.object_instances if each.show_self)


def slots(owner, override=None):
    """The materials of an object, by slot."""
    return [override or slot.material for slot in owner.material_slots]


def numbers(matrix):
    """As glTF has them."""
    return [c for column in matrix.col for c in column]


class Meshes:
    """Those that are rendered, each once.

    :ivar scene: of an object for each
    :ivar names: by the names of their copies
    :ivar places: the object's name, the instance's name and its matrix in glTF
    """

    def __init__(self, depsgraph, override):
        self.scene = bpy.data.scenes.new("Candela")
        self.names, self.places, self._objects = {}, [], {}
        self._depsgraph, self._override = depsgraph, override

    def collect(self):
        for instance in rendered(self._depsgraph):
            # Evaluated curves, texts and metaballs are meshes here, too
            if instance.object.type == "MESH":
                name = self._object(instance.object)
                matrix = UPRIGHT @ instance.matrix_world @ UPRIGHT.inverted()
                self.places.append((name, instance.object.name, numbers(matrix)))

    def _object(self, source):
        materials = slots(source, self._override) or [self._override]
        key = (source.data.as_pointer(), *(m and m.as_pointer() for m in materials))
        if key not in self._objects:
            mesh = bpy.data.meshes.new_from_object(
                source, preserve_all_data_layers=True, depsgraph=self._depsgraph
            )
            for k, material in enumerate(materials):
                material = material and material.original
                if k < len(mesh.materials):
                    mesh.materials[k] = material
                else:
                    mesh.materials.append(material)
            self.names[mesh.name] = source.data.name
            made = bpy.data.objects.new("Candela", mesh)
            self.scene.collection.objects.link(made)
            self._objects[key] = made.name
        return self._objects[key]

    def remove(self):
        bpy.data.batch_remove([each.data for each in self.scene.objects])
        bpy.data.batch_remove(list(self.scene.objects))
        bpy.data.scenes.remove(self.scene)


@contextmanager
def meshes(depsgraph, override=None):
    """The meshes that are rendered, for the time of the export.

    :param override: a material instead of all
    """
    # The exporter shows the scene that it exports
    shown = [(w, w.scene, w.view_layer) for w in bpy.context.window_manager.windows]
    made = Meshes(depsgraph, override)
    try:
        made.collect()
        yield made
    finally:
        for window, scene, view_layer in shown:
            if window.scene != scene:
                window.scene, window.view_layer = scene, view_layer
        made.remove()
